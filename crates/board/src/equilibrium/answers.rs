//! The answers that a polygon gives, and the loads that a group puts on the links that hold it.

use super::joints::{Hinge, HingeKind, OuterJoint, party, sides};
use super::scribe::{ActingForce, OnPin, Polygon, Scribe, square_to};
use super::{ForceTerm, Party, ReactionComponent};
use crate::construction::{Base, Direction, Key, MarkId, Number, NumberId};
use hodograph_scene::quantity::parties;
use hodograph_scene::{GuideId, LinkId, PointId, RollingId};

impl Scribe<'_> {
    /// Adds the force of a hinge on a link to the answers, and puts the opposite force on the
    /// holding link or pin.
    pub fn pinned(&mut self, p: &mut Polygon, hinge: Hinge, on: LinkId, [from, to]: [MarkId; 2]) {
        let (own, back, at) = (self.measured(p, from, to), self.measured(p, to, from), hinge.at);
        let by = match hinge.kind {
            HingeKind::Pin => {
                self.answers.pins.push((at, on, own));
                if let Party::Link(other) = party(self.scene, hinge, on) {
                    self.answers.pins.push((at, other, back));
                }
                self.at_pin[at.0].push(OnPin { of: Party::Link(on), force: back });
                return;
            }
            HingeKind::Arc(guide) => {
                let slider = self.scene.guides[guide.0].slider == Some(on);
                self.on_arc(p, hinge, if slider { own } else { back });
                sides(self.scene, guide).and_then(|sides| sides.into_iter().find(|l| *l != on))
            }
            HingeKind::Driven { guide, driver } => {
                let slot = self.scene.guides[guide.0].on;
                if slot == on {
                    self.along_slot(p, (guide, driver), [to, from]);
                } else {
                    // The pin transmits the forces of slot, driver and the other links.
                    self.held_at(p, at, on, [from, to]);
                    let loads = self.pin_loads(at, on);
                    let (last, sides) = (std::mem::replace(&mut p.last, from), p.sides.len());
                    self.lay_all(p, &loads);
                    p.diagonals.extend(p.sides.split_off(sides));
                    let loaded = std::mem::replace(&mut p.last, last);
                    self.along_slot(p, (guide, driver), [loaded, to]);
                }
                if slot == on && parties(self.scene, at) > 2 {
                    self.at_pin[at.0].push(OnPin { of: Party::Link(on), force: back });
                    return;
                }
                if slot == on { self.scene.carriers(at).next() } else { Some(slot) }
            }
        };
        if let Some(by) = by.filter(|by| *by != self.scene.ground) {
            let term =
                ForceTerm::Reaction { of: Party::Link(on), on: by, part: ReactionComponent::Whole };
            self.acting[by.0].push(ActingForce {
                term,
                force: Some((Base::Measured(back), at)),
                couple: None,
            });
        }
    }

    /// Resolves the force on a pin that a driver moves along a slot: the driver pushes along it,
    /// the slot presses square to it.
    fn along_slot(
        &mut self,
        p: &mut Polygon,
        (guide, driver): (GuideId, usize),
        [from, to]: [MarkId; 2],
    ) {
        let Some((along, at)) = self.push_along(guide) else { return };
        let Some(runner) = self.scene.carriers(at).next() else { return };
        let lines = [self.line(p, from, Direction::of(along)), self.line(p, to, square_to(along))];
        let corner = self.meet(p, lines);
        let slot = self.scene.guides[guide.0].on;
        self.diagonal(
            p,
            (
                ForceTerm::Reaction {
                    of: Party::Driver(driver),
                    on: runner,
                    part: ReactionComponent::Whole,
                },
                at,
            ),
            [from, corner],
        );
        self.diagonal(
            p,
            (
                ForceTerm::Reaction {
                    of: Party::Link(slot),
                    on: runner,
                    part: ReactionComponent::Whole,
                },
                at,
            ),
            [corner, to],
        );
        let pressed = self.measured(p, corner, to);
        self.answers.guides.push((guide, pressed, None));
        let size = self.number(&mut p.ops, Number::Along(from, corner, Direction::of(along)));
        self.answers.drivers.push((driver, size));
        p.drivers.push((driver, size));
    }

    /// Adds the force of a curved guide on its slider; its line of action passes through the centre
    /// of the arc.
    fn on_arc(&mut self, p: &mut Polygon, hinge: Hinge, force: NumberId) {
        let Some((guide, place)) =
            hinge.arc().and_then(|guide| Some((guide, self.reference(guide)?)))
        else {
            return;
        };
        let moment = Number::Moment {
            force: Base::Measured(force),
            at: self.mark(hinge.at),
            about: self.mark(place),
        };
        let couple = self.number(&mut p.ops, moment);
        self.answers.guides.push((guide, force, Some(couple)));
    }

    /// Adds the force of an inner hinge on both links.
    pub fn inner_pin(
        &mut self,
        p: &mut Polygon,
        hinge: Hinge,
        links: [LinkId; 2],
        [m1, x, m2]: [MarkId; 3],
    ) {
        for (sides, ends) in [(links, [m1, x]), ([links[1], links[0]], [x, m2])] {
            self.inner_side(p, hinge, sides, ends);
        }
    }

    /// Adds the force of an inner hinge on the first of two links.
    pub fn inner_side(
        &mut self,
        p: &mut Polygon,
        hinge: Hinge,
        [link, other]: [LinkId; 2],
        ends: [MarkId; 2],
    ) {
        let id = self.measured(p, ends[0], ends[1]);
        let at = hinge.at;
        let of = match hinge.kind {
            HingeKind::Pin => {
                self.answers.pins.push((at, link, id));
                if parties(self.scene, at) == 2 { Party::Link(other) } else { Party::Pin(at) }
            }
            HingeKind::Arc(guide) => {
                if self.scene.guides[guide.0].slider == Some(link) {
                    self.on_arc(p, hinge, id);
                }
                Party::Link(other)
            }
            HingeKind::Driven { guide, driver } => {
                if self.scene.guides[guide.0].on == link {
                    self.along_slot(p, (guide, driver), [ends[1], ends[0]]);
                } else {
                    self.held_at(p, at, link, ends);
                }
                Party::Pin(at)
            }
        };
        self.diagonal(
            p,
            (ForceTerm::Reaction { of, on: link, part: ReactionComponent::Whole }, at),
            ends,
        );
    }

    /// Adds the force and couple of a guide on a link of the group to the answers, and to the loads
    /// of the other link.
    pub fn guided(
        &mut self,
        p: &mut Polygon,
        slide: OuterJoint,
        ends: [MarkId; 2],
        couple: NumberId,
    ) {
        let OuterJoint::Slide { guide, on, by, at } = slide else { return };
        let (own, back) = (self.measured(p, ends[0], ends[1]), self.measured(p, ends[1], ends[0]));
        let opposite = self.number(&mut p.ops, Number::Negative(couple));
        let of_slider = self.scene.guides[guide.0].slider == Some(on);
        self.answers.guides.push(if of_slider {
            (guide, own, Some(couple))
        } else {
            (guide, back, Some(opposite))
        });
        if by != self.scene.ground {
            let term =
                ForceTerm::Reaction { of: Party::Link(on), on: by, part: ReactionComponent::Whole };
            self.acting[by.0].push(ActingForce {
                term,
                force: Some((Base::Measured(back), at)),
                couple: Some(opposite),
            });
        }
    }

    /// Adds the force of a slot on a link of the group, or of a pin on the link's slot.
    pub fn slotted(
        &mut self,
        p: &mut Polygon,
        guide: GuideId,
        on: LinkId,
        by: Party,
        at: PointId,
        ends: [MarkId; 2],
    ) {
        let (own, back) = (self.measured(p, ends[0], ends[1]), self.measured(p, ends[1], ends[0]));
        let runner = if self.scene.guides[guide.0].on == on { back } else { own };
        self.answers.guides.push((guide, runner, None));
        match by {
            Party::Link(by) if by != self.scene.ground => {
                let term = ForceTerm::Reaction {
                    of: Party::Link(on),
                    on: by,
                    part: ReactionComponent::Whole,
                };
                self.acting[by.0].push(ActingForce {
                    term,
                    force: Some((Base::Measured(back), at)),
                    couple: None,
                });
            }
            Party::Pin(at) => self.at_pin[at.0].push(OnPin { of: Party::Link(on), force: back }),
            Party::Link(_) | Party::Cylinder(_) | Party::Driver(_) => {}
        }
    }

    /// Adds the force of a pin that a slot or a cylinder holds, on the last of its links; the pin
    /// also has the forces of the others.
    pub fn held_at(&mut self, p: &mut Polygon, at: PointId, on: LinkId, ends: [MarkId; 2]) {
        if parties(self.scene, at) > 2 {
            let own = self.measured(p, ends[0], ends[1]);
            self.answers.pins.push((at, on, own));
        }
    }

    /// Returns the line of action of teeth as a given vector, in the sense of the force on the
    /// second link.
    pub fn line_of_action(&self, rolling: RollingId) -> Base {
        Base::Given(Key::of(self.balance.index() + 1 + rolling.0))
    }

    /// Adds the force of a rolling pair on a link of the group, and its opposite on the other link.
    pub fn meshed(
        &mut self,
        p: &mut Polygon,
        rolling: RollingId,
        [on, by]: [LinkId; 2],
        at: PointId,
        ends: [MarkId; 2],
    ) {
        let (own, back) = (self.measured(p, ends[0], ends[1]), self.measured(p, ends[1], ends[0]));
        self.answers
            .rolling
            .push((rolling, if self.scene.rolling[rolling.0].links[1] == on { own } else { back }));
        if by != self.scene.ground {
            let term =
                ForceTerm::Reaction { of: Party::Link(on), on: by, part: ReactionComponent::Whole };
            self.acting[by.0].push(ActingForce {
                term,
                force: Some((Base::Measured(back), at)),
                couple: None,
            });
        }
    }

    /// Adds the force of a cylinder on a link, and its opposite at the far pin.
    pub fn pushed(
        &mut self,
        p: &mut Polygon,
        driver: usize,
        on: LinkId,
        [at, far]: [PointId; 2],
        ends: [MarkId; 2],
    ) {
        let (own, back) = (self.measured(p, ends[0], ends[1]), self.measured(p, ends[1], ends[0]));
        let kind = &self.scene.drivers[driver].kind;
        let parts = kind.parts().to_vec();
        for part in parts {
            let here = kind.ends_of(part).is_some_and(|[first, _]| first == at);
            self.answers.pins.push(if here { (at, part, back) } else { (far, part, own) });
        }
        if parties(self.scene, at) == 2 {
            self.answers.pins.push((at, on, own));
        }
        // A cylinder pushes its second end away from its first.
        let [a, b] = kind.ends().unwrap_or([far, at]);
        let along = Direction::of(Base::Arm { from: self.mark(a), to: self.mark(b), known: false });
        let [from, to] = if at == b { ends } else { [ends[1], ends[0]] };
        let size = self.number(&mut p.ops, Number::Along(from, to, along));
        self.answers.drivers.push((driver, size));
        p.drivers.push((driver, size));
        self.at_pin[far.0].push(OnPin { of: Party::Cylinder(driver), force: back });
    }

    /// Adds the force of a driver along its guide on a link, and its opposite on the link that
    /// holds it.
    pub fn pushed_along(
        &mut self,
        p: &mut Polygon,
        (driver, guide): (usize, GuideId),
        [on, by]: [LinkId; 2],
        ends: [MarkId; 2],
    ) {
        // The force is positive on the sliding part, in the sense of the guide.
        let [from, to] =
            if self.scene.guides[guide.0].on == on { [ends[1], ends[0]] } else { ends };
        let Some((along, at)) = self.push_along(guide) else { return };
        let size = self.number(&mut p.ops, Number::Along(from, to, Direction::of(along)));
        self.answers.drivers.push((driver, size));
        p.drivers.push((driver, size));
        if by != self.scene.ground {
            let back = self.measured(p, ends[1], ends[0]);
            let term = ForceTerm::Reaction {
                of: Party::Driver(driver),
                on: by,
                part: ReactionComponent::Whole,
            };
            self.acting[by.0].push(ActingForce {
                term,
                force: Some((Base::Measured(back), at)),
                couple: None,
            });
        }
    }

    /// Adds the reaction of a driver's moment, a couple on the link to which the driven link's
    /// motion is relative.
    pub fn turned(&mut self, p: &mut Polygon, against: LinkId, of: LinkId, moment: NumberId) {
        if against != self.scene.ground {
            let opposite = self.number(&mut p.ops, Number::Negative(moment));
            let term = ForceTerm::Reaction {
                of: Party::Link(of),
                on: against,
                part: ReactionComponent::Whole,
            };
            self.acting[against.0].push(ActingForce { term, force: None, couple: Some(opposite) });
        }
    }

    /// Returns the force of a joint that presses along one line. For a wheel on its track, the
    /// friction and the force of the guiding path are parts of one force.
    pub fn pressing(&self, outer: &OuterJoint) -> Option<ForceTerm> {
        if let OuterJoint::Mesh { rolling, on, by, .. } = *outer
            && self.m.path_of(self.scene, rolling).is_some()
        {
            return Some(ForceTerm::Reaction {
                of: Party::Link(by),
                on,
                part: ReactionComponent::Tangential,
            });
        }
        if let OuterJoint::Slot { guide, on, .. } = *outer
            && let Some(rolling) = self.scene.guides[guide.0].rolling
        {
            let [track, wheel] = self.scene.rolling[rolling.0].links;
            let (of, on) = if on == track { (wheel, track) } else { (track, wheel) };
            return Some(ForceTerm::Reaction {
                of: Party::Link(of),
                on,
                part: ReactionComponent::Normal,
            });
        }
        reaction(outer, ReactionComponent::Whole)
    }
}

/// Returns the part of a reaction that an outer joint puts on its link.
pub(super) fn reaction(outer: &OuterJoint, part: ReactionComponent) -> Option<ForceTerm> {
    let (of, on) = match *outer {
        OuterJoint::Pin { on, by, .. } | OuterJoint::Slot { on, by, .. } => (by, on),
        OuterJoint::Slide { on, by, .. } | OuterJoint::Mesh { on, by, .. } => (Party::Link(by), on),
        OuterJoint::Cylinder { driver, on, .. } => (Party::Cylinder(driver), on),
        OuterJoint::Balance { driver, on, .. } | OuterJoint::Push { driver, on, .. } => {
            (Party::Driver(driver), on)
        }
        OuterJoint::Turn { .. } => return None,
    };
    Some(ForceTerm::Reaction { of, on, part })
}
