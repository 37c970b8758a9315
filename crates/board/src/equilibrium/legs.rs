//! The equilibrium of a link on three legs, with all its legs in one polygon.
//!
//! A leg presses along one line, along its bar or square to its guide, except for the part due to
//! its own loads. Moments of the whole group about the crossing of two such lines give the force
//! along the third line; the polygon crosses the other two.

use super::answers::reaction;
use super::joints::{DyadJoint, Hinge, Joints, OuterJoint, too_many, turns_on};
use super::methods::carries;
use super::scribe::{ActingForce, Polygon, Scribe, square_to};
use super::{About, ForceTerm, MomentResult, Party, ReactionComponent};
use crate::construction::{Base, Direction, Key, Line, MarkId, Name, Number, NumberId, Op};
use hodograph_base::diag::{Both, both};
use hodograph_base::geom::{Point, Vec2};
use hodograph_mechanism::position::{Configuration, Path};
use hodograph_scene::quantity::parties;
use hodograph_scene::{GuideId, LinkId, PointId};

/// A leg of the link.
#[derive(Clone, Copy)]
struct Leg {
    kind: LegSupport,
    /// The joint at its far end, or the joint between leg and link.
    outer: OuterJoint,
    /// A point on its line of action.
    at: PointId,
    /// The direction of the line of action.
    line: Base,
    /// The direction in numbers, used to choose the lines that cross.
    along: Option<Vec2>,
}

#[derive(Clone, Copy)]
enum LegSupport {
    /// A bar, pinned to the link or sliding on it along an arc.
    Bar { link: LinkId, near: Hinge },
    /// A slider in a guide outside the group, pinned to the link.
    Block { link: LinkId, near: Hinge },
    /// A pinned block that slides on the link, or a block in which the link slides.
    Sleeve { link: LinkId, guide: GuideId },
    /// A pin in a slot, teeth, or a cylinder.
    Touch,
}

/// A leg with its loads.
struct LoadedLeg {
    leg: Leg,
    loads: Vec<ActingForce>,
    /// The force of the far pin square to the bar: its term, its magnitude, and the bar.
    across: Option<(ForceTerm, NumberId, Base)>,
    /// The loads of the pin between leg and link.
    on_pin: Vec<ActingForce>,
}

/// The ends of a leg's forces in the polygon.
#[derive(Clone, Copy)]
struct LegEnds {
    /// The reaction of its far joint.
    whole: [MarkId; 2],
    /// The reaction of the link on the leg.
    inner: [MarkId; 2],
    /// The reaction of the pin on the link.
    opposite: [MarkId; 2],
}

impl Leg {
    fn link(&self) -> Option<LinkId> {
        match self.kind {
            LegSupport::Bar { link, .. }
            | LegSupport::Block { link, .. }
            | LegSupport::Sleeve { link, .. } => Some(link),
            LegSupport::Touch => None,
        }
    }

    /// Returns the hinge between leg and link.
    fn near(&self) -> Option<Hinge> {
        match self.kind {
            LegSupport::Bar { near, .. } | LegSupport::Block { near, .. } => Some(near),
            LegSupport::Sleeve { .. } | LegSupport::Touch => None,
        }
    }

    /// Returns the place at the far end.
    fn far(&self) -> Hinge {
        if let OuterJoint::Pin { hinge, .. } = self.outer { hinge } else { self.at.into() }
    }
}

impl LoadedLeg {
    /// Returns the force along the line of action.
    fn axial(&self, scribe: &Scribe) -> Option<ForceTerm> {
        if self.across.is_some() {
            reaction(&self.leg.outer, ReactionComponent::Normal)
        } else {
            scribe.pressing(&self.leg.outer)
        }
    }
}

impl Scribe<'_> {
    /// Writes the equilibrium of a link on three legs.
    ///
    /// # Errors
    /// A group of another kind.
    pub(super) fn on_three_legs(
        &mut self,
        links: &[LinkId],
        joints: &Joints,
        at: &Configuration,
    ) -> Result<(), Both> {
        let (core, legs) =
            self.legs(links, joints, at).ok_or_else(|| joints.no_method(self.scene, links))?;
        for leg in &legs {
            if matches!(leg.outer, OuterJoint::Slot { .. } | OuterJoint::Cylinder { .. })
                && parties(self.scene, leg.at) > 2
            {
                return Err(too_many(self.scene, leg.at));
            }
            if let LegSupport::Sleeve { link, .. } = leg.kind
                && self.all_on(link, &[leg.far()]).iter().any(|a| a.force.is_some())
            {
                let name = self.scene.link_name(link);
                return Err(both!("the sliding block {name} has loads of its own"));
            }
        }
        let sine = |[i, j, _]: &[usize; 3]| {
            let unit = |k: usize| legs[k].along.and_then(Vec2::unit);
            unit(*i).zip(unit(*j)).map_or(0.0, |(a, b)| a.cross(b).abs())
        };
        let orders = [[0, 1, 2], [0, 2, 1], [1, 2, 0]];
        let [i, j, k] =
            orders.into_iter().max_by(|a, b| sine(a).total_cmp(&sine(b))).unwrap_or([0, 1, 2]);
        self.three_legs(links, core, [legs[i], legs[j], legs[k]]);
        Ok(())
    }

    /// Returns the link that three legs hold, and the legs.
    fn legs(
        &self,
        links: &[LinkId],
        joints: &Joints,
        at: &Configuration,
    ) -> Option<(LinkId, [Leg; 3])> {
        let has = |pair: &DyadJoint, l: LinkId| match *pair {
            DyadJoint::Pin(hinge) => turns_on(self.scene, l, hinge),
            DyadJoint::Slide { slider, on, .. } => slider == l || on == l,
        };
        let inner = |l: LinkId| joints.inner.iter().filter(move |p| has(p, l));
        let outer = |l: LinkId| joints.outer.iter().filter(move |o| carries(o) == Some(l));
        let touches = |o: &OuterJoint| {
            matches!(
                o,
                OuterJoint::Slot { .. } | OuterJoint::Mesh { .. } | OuterJoint::Cylinder { .. }
            )
        };
        let core = links
            .iter()
            .copied()
            .find(|l| inner(*l).count() + outer(*l).count() == 3 && outer(*l).all(touches))?;
        let place = |p: PointId| at.points[p.0];
        let square = |guide: GuideId, p: PointId| {
            let along = match at.guides[guide.0] {
                Some(Path::Line { direction, .. }) => Some(direction.perp()),
                Some(Path::Arc { centre, .. }) => place(p).map(|p: Point| p - centre),
                None => None,
            };
            (Base::Normal(Key::of(guide.0), self.mark(p)), along)
        };
        let between = |from: PointId, to: PointId| {
            let along = place(from).zip(place(to)).map(|(a, b)| b - a);
            (Base::Arm { from: self.mark(from), to: self.mark(to), known: false }, along)
        };
        let mut legs = Vec::new();
        for pair in inner(core) {
            let link = links.iter().copied().find(|l| *l != core && has(pair, *l))?;
            let (mut held, mut joined) = (outer(link), inner(link));
            let (Some(held), None, Some(_), None) =
                (held.next(), held.next(), joined.next(), joined.next())
            else {
                return None;
            };
            let (kind, at, (line, along)) = match (*pair, *held) {
                (DyadJoint::Pin(near), OuterJoint::Pin { hinge, .. }) => {
                    (LegSupport::Bar { link, near }, hinge.at, between(near.at, hinge.at))
                }
                (DyadJoint::Pin(near), OuterJoint::Slide { at, guide, .. })
                    if Some(at) == near.pin() =>
                {
                    (LegSupport::Block { link, near }, at, square(guide, at))
                }
                (DyadJoint::Slide { guide, .. }, OuterJoint::Pin { hinge, .. }) => {
                    (LegSupport::Sleeve { link, guide }, hinge.at, square(guide, hinge.at))
                }
                _ => return None,
            };
            legs.push(Leg { kind, outer: *held, at, line, along });
        }
        for touch in outer(core) {
            let (at, (line, along)) = match *touch {
                OuterJoint::Slot { guide, at, .. } => (at, square(guide, at)),
                OuterJoint::Mesh { rolling, at: place, .. } => (
                    place,
                    (self.line_of_action(rolling), at.normal(self.scene, rolling).map(Vec2::perp)),
                ),
                OuterJoint::Cylinder { at, far, .. } => (at, between(far, at)),
                OuterJoint::Pin { .. }
                | OuterJoint::Slide { .. }
                | OuterJoint::Turn { .. }
                | OuterJoint::Balance { .. }
                | OuterJoint::Push { .. } => return None,
            };
            legs.push(Leg { kind: LegSupport::Touch, outer: *touch, at, line, along });
        }
        (legs.len() == links.len() - 1 + outer(core).count()).then_some(())?;
        Some((core, legs.try_into().ok()?))
    }

    fn three_legs(&mut self, links: &[LinkId], core: LinkId, legs: [Leg; 3]) {
        let held: Vec<Hinge> = legs.iter().map(|leg| leg.near().unwrap_or(leg.at.into())).collect();
        let own = self.all_on(core, &held);
        let (mut ops, mut found) = (Vec::new(), Vec::new());
        let legs = legs.map(|leg| self.loaded(&mut ops, &mut found, leg, core));
        let size = self.third(&mut ops, &mut found, (links, &own), &legs);
        self.on_plane(ops);
        let [one, two, three] = &legs;
        let mut p = self.polygon();
        p.moments = found;
        let start = p.last;
        self.square(&mut p, one);
        let first = p.last;
        self.lay_all(&mut p, &one.loads);
        let inner_one = p.last;
        self.lay_all(&mut p, &one.on_pin);
        let third = p.last;
        if let Some(term) = three.axial(self) {
            self.laid(&mut p, (term, three.leg.at), Direction::of(three.leg.line).unit(), size);
        }
        self.square(&mut p, three);
        let reacted = p.last;
        self.lay_all(&mut p, &three.loads);
        let inner_three = p.last;
        self.lay_all(&mut p, &three.on_pin);
        let after_three = p.last;
        self.lay_all(&mut p, &own);
        let before_two = p.last;
        self.lay_all(&mut p, &two.on_pin);
        let inner_two = p.last;
        self.lay_all(&mut p, &two.loads);
        let second = p.last;
        self.square(&mut p, two);
        let end = p.last;
        let lines = [
            self.line(&mut p, start, Direction::of(one.leg.line)),
            self.line(&mut p, end, Direction::of(two.leg.line)),
        ];
        let x = self.meet(&mut p, lines);
        for (leg, ends, is_first) in [(one, [x, start], true), (two, [end, x], false)] {
            if let Some(term) = leg.axial(self) {
                self.side(&mut p, (term, leg.leg.at), ends, is_first);
            }
        }
        let ends = [
            (one, LegEnds { whole: [x, first], inner: [inner_one, x], opposite: [x, third] }),
            (two, LegEnds { whole: [second, x], inner: [x, inner_two], opposite: [before_two, x] }),
            (
                three,
                LegEnds {
                    whole: [third, reacted],
                    inner: [inner_three, third],
                    opposite: [third, after_three],
                },
            ),
        ];
        for (leg, ends) in ends {
            self.leg_answers(&mut p, core, leg, ends);
        }
        self.finish(p, links, "III");
    }

    /// Returns a leg with its loads, and the force square to its bar.
    fn loaded(
        &mut self,
        ops: &mut Vec<Op>,
        found: &mut Vec<super::Moments>,
        leg: Leg,
        core: LinkId,
    ) -> LoadedLeg {
        let held: Vec<Hinge> = leg.near().into_iter().chain([leg.far()]).collect();
        let loads = leg.link().map_or_else(Vec::new, |link| self.all_on(link, &held));
        let on_pin = leg
            .near()
            .and_then(Hinge::pin)
            .map_or_else(Vec::new, |near| self.pin_loads(near, core));
        let across = match (leg.kind, reaction(&leg.outer, ReactionComponent::Tangential)) {
            (LegSupport::Bar { link, near }, Some(term)) if !loads.is_empty() => {
                let of = self.moments(
                    ops,
                    &[link],
                    &loads,
                    About::Point(near.at),
                    MomentResult::Force(term, leg.at),
                );
                self.across(ops, found, of, leg.line).map(|value| (term, value, leg.line))
            }
            _ => None,
        };
        LoadedLeg { leg, loads, across, on_pin }
    }

    /// Returns the force along the third leg's line, by moments about the crossing of the other two
    /// lines.
    fn third(
        &mut self,
        ops: &mut Vec<Op>,
        found: &mut Vec<super::Moments>,
        (links, own): (&[LinkId], &[ActingForce]),
        legs: &[LoadedLeg; 3],
    ) -> NumberId {
        let [one, two, three] = legs;
        let lines = [one, two].map(|l| {
            let line = Line {
                on: self.plane,
                through: self.mark(l.leg.at),
                along: Direction::of(l.leg.line),
                moved: false,
                carries: Vec::new(),
            };
            let line = self.c.line(line);
            ops.push(Op::Rule(line));
            line
        });
        let number = self.crossings;
        self.crossings += 1;
        let crossing = self.c.mark(self.plane, Name::Image(Key::of(number)));
        ops.push(Op::Meet { lines, to: crossing });
        // The loads of a block act on its pin; its guide takes their couple.
        let mut all = own.to_vec();
        for l in legs {
            let at_pin = |a: &ActingForce| match l.leg.kind {
                LegSupport::Block { near, .. } => ActingForce {
                    force: a.force.map(|(force, _)| (force, near.at)),
                    couple: None,
                    ..*a
                },
                LegSupport::Bar { .. } | LegSupport::Sleeve { .. } | LegSupport::Touch => *a,
            };
            all.extend(l.loads.iter().map(at_pin));
            all.extend(&l.on_pin);
        }
        let (Some(a), Some(b), Some(given)) = (one.axial(self), two.axial(self), three.axial(self))
        else {
            return self.one;
        };
        let about = About::Crossing { at: crossing, of: [a, b] };
        let mut moments =
            self.moments(ops, links, &all, about, MomentResult::Force(given, three.leg.at));
        for l in legs {
            if let Some((term, value, bar)) = l.across {
                // The arm of a unit force square to the bar is the component of the connecting
                // vector along the bar.
                let arm = self
                    .number(ops, Number::Along(crossing, self.mark(l.leg.at), Direction::of(bar)));
                moments.of.push((term, l.leg.at, self.number(ops, Number::Product(value, arm))));
            }
        }
        let turning = self.balancing(ops, &moments);
        moments.value =
            self.by_arm(ops, turning, three.leg.line, self.mark(three.leg.at), crossing);
        let size = moments.value;
        found.push(moments);
        size
    }

    /// Lays off the force square to a leg's bar.
    fn square(&mut self, p: &mut Polygon, leg: &LoadedLeg) {
        if let Some((term, value, bar)) = leg.across {
            self.laid(p, (term, leg.leg.at), square_to(bar), value);
        }
    }

    /// Adds the reactions of a leg to the answers, and to the loads of the parts on its other side.
    fn leg_answers(&mut self, p: &mut Polygon, core: LinkId, l: &LoadedLeg, ends: LegEnds) {
        let leg = &l.leg;
        if let (true, Some(term)) =
            (l.across.is_some(), reaction(&leg.outer, ReactionComponent::Whole))
        {
            self.diagonal(p, (term, leg.at), ends.whole);
        }
        if let (Some(near), Some(link)) = (leg.near(), leg.link()) {
            self.inner_side(p, near, [link, core], ends.inner);
            self.inner_side(p, near, [core, link], ends.opposite);
        }
        match leg.kind {
            LegSupport::Bar { link, .. } => self.pinned(p, leg.far(), link, ends.whole),
            LegSupport::Block { link, near } => {
                let force = self.measured(p, ends.inner[0], ends.inner[1]);
                let term = ForceTerm::Reaction {
                    of: Party::Link(core),
                    on: link,
                    part: ReactionComponent::Whole,
                };
                let inside = ActingForce {
                    term,
                    force: Some((Base::Measured(force), near.at)),
                    couple: None,
                };
                let all: Vec<ActingForce> = l.loads.iter().copied().chain([inside]).collect();
                self.offset(p, leg.outer, &all, ends.whole);
            }
            LegSupport::Sleeve { link, guide } => {
                let place = self.reference(guide).unwrap_or(leg.at);
                let [from, to] = ends.whole;
                for (on, other, ends) in [(link, core, [to, from]), (core, link, [from, to])] {
                    self.diagonal(
                        p,
                        (
                            ForceTerm::Reaction {
                                of: Party::Link(other),
                                on,
                                part: ReactionComponent::Whole,
                            },
                            place,
                        ),
                        ends,
                    );
                }
                self.pinned(p, leg.far(), link, ends.whole);
                self.inner_guide(p, guide, link, (leg.at, place), &l.loads, [to, from]);
            }
            LegSupport::Touch => self.touched(p, &leg.outer, ends.whole),
        }
    }
}
