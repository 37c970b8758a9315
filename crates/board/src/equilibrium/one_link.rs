//! A link in equilibrium by itself: a driver, or a link with a pivot or a guide and one line of
//! action.

use super::answers::reaction;
use super::joints::{Hinge, OuterJoint};
use super::methods::{normal, tangent};
use super::scribe::{ActingForce, Polygon, Scribe};
use super::{About, ForceTerm, MomentResult, ReactionComponent};
use crate::construction::{Base, Direction, Key, MarkId, Number, NumberId, Op};
use hodograph_scene::{GuideId, LinkId, PointId};

impl Scribe<'_> {
    /// Writes a link on a pivot that a driver turns.
    pub(super) fn driven(&mut self, link: LinkId, hinge: Hinge, driver: usize, against: LinkId) {
        let pivot = hinge.at;
        let acting = self.all_on(link, &[hinge]);
        let mut ops = Vec::new();
        let mut moments = self.moments(
            &mut ops,
            &[link],
            &acting,
            About::Point(pivot),
            MomentResult::Driver(driver),
        );
        let balance = self.balancing(&mut ops, &moments);
        moments.value = balance;
        self.on_plane(ops);
        let mut p = self.polygon();
        p.moments.push(moments);
        let start = p.last;
        self.lay_all(&mut p, &acting);
        let end = p.last;
        let of = super::joints::party(self.scene, hinge, link);
        self.side(
            &mut p,
            (ForceTerm::Reaction { of, on: link, part: ReactionComponent::Whole }, pivot),
            [end, start],
            false,
        );
        self.pinned(&mut p, hinge, link, [end, start]);
        self.answers.drivers.push((driver, balance));
        self.answers.balance = self.scene.loads.balance.as_ref().map(|_| balance);
        p.drivers.push((driver, balance));
        self.turned(&mut p, against, link, balance);
        self.finish(p, &[link], "driver");
    }

    /// Returns the line along which a driver pushes a slider, and its point.
    pub(super) fn push_along(&self, guide: GuideId) -> Option<(Base, PointId)> {
        let at = self.reference(guide)?;
        Some((Base::Tangent(Key::of(guide.0), Some(Key::of(at.0))), at))
    }

    /// Returns the line of action of a joint that presses along one line, and a point on it.
    fn line_of(&self, touch: &OuterJoint) -> Option<(Base, PointId)> {
        match *touch {
            OuterJoint::Slot { guide, at, .. } => {
                Some((Base::Normal(Key::of(guide.0), self.mark(at)), at))
            }
            OuterJoint::Cylinder { at, far, .. } => {
                Some((Base::Arm { from: self.mark(far), to: self.mark(at), known: false }, at))
            }
            OuterJoint::Mesh { rolling, at, .. } => Some((self.line_of_action(rolling), at)),
            OuterJoint::Balance { at, .. } => Some((Base::Given(self.balance), at)),
            OuterJoint::Push { guide, .. } => self.push_along(guide),
            OuterJoint::Pin { .. } | OuterJoint::Slide { .. } | OuterJoint::Turn { .. } => None,
        }
    }

    /// Writes a link on a pivot with one line of action.
    pub(super) fn on_a_pivot(&mut self, link: LinkId, pin: OuterJoint, touch: OuterJoint) {
        let (OuterJoint::Pin { hinge, .. }, Some((line, at)), Some(term)) =
            (pin, self.line_of(&touch), self.pressing(&touch))
        else {
            return;
        };
        let pivot = hinge.at;
        let mut acting = self.all_on(link, &[hinge, at.into()]);
        let own = acting.len();
        acting.extend(self.pin_loads_beside(&touch, at, link));
        let mut ops = Vec::new();
        let mut moments = self.moments(
            &mut ops,
            &[link],
            &acting,
            About::Point(pivot),
            MomentResult::Force(term, at),
        );
        let turning = self.balancing(&mut ops, &moments);
        let size = self.by_arm(&mut ops, turning, line, self.mark(at), self.mark(pivot));
        moments.value = size;
        if let OuterJoint::Balance { driver, .. } = touch {
            // The moment of the force about the pivot gives the power.
            let pushed = hinge.arc().and_then(|guide| self.push_along(guide));
            let of_driver = pushed.map_or(turning, |(line, at)| {
                self.by_arm(&mut ops, turning, line, self.mark(at), self.mark(pivot))
            });
            self.answers.drivers.push((driver, of_driver));
            self.answers.balance = Some(size);
        }
        self.on_plane(ops);
        let mut p = self.polygon();
        p.moments.push(moments);
        let start = p.last;
        self.lay_all(&mut p, &acting[..own]);
        let before = p.last;
        self.lay_all(&mut p, &acting[own..]);
        let loaded = p.last;
        self.laid(&mut p, (term, at), Direction::of(line).unit(), size);
        let end = p.last;
        if matches!(touch, OuterJoint::Slot { .. } | OuterJoint::Cylinder { .. })
            && self.scene.links[link.0].points.contains(&at)
        {
            self.held_at(&mut p, at, link, [before, end]);
        }
        if let Some(term) = reaction(&pin, ReactionComponent::Whole) {
            self.side(&mut p, (term, pivot), [end, start], false);
        }
        self.pinned(&mut p, hinge, link, [end, start]);
        self.touched(&mut p, &touch, [loaded, end]);
        self.finish(
            p,
            &[link],
            if matches!(touch, OuterJoint::Balance { .. } | OuterJoint::Push { .. }) {
                "driver"
            } else {
                "RH"
            },
        );
    }

    /// Returns the forces of other links on a pin at which a slot, a cylinder or a balancing force
    /// acts on the link.
    fn pin_loads_beside(
        &mut self,
        touch: &OuterJoint,
        at: PointId,
        link: LinkId,
    ) -> Vec<ActingForce> {
        let pinned = self.scene.links[link.0].points.contains(&at);
        let counts = matches!(
            touch,
            OuterJoint::Slot { .. }
                | OuterJoint::Cylinder { .. }
                | OuterJoint::Balance { .. }
                | OuterJoint::Push { .. }
        );
        if pinned && counts { self.pin_loads(at, link) } else { Vec::new() }
    }

    /// Returns the force along a line through a mark that has a given moment about another mark.
    pub(super) fn by_arm(
        &mut self,
        ops: &mut Vec<Op>,
        turning: NumberId,
        line: Base,
        at: MarkId,
        about: MarkId,
    ) -> NumberId {
        let unit = self.number(ops, Number::Moment { force: line, at, about });
        let length = self.c.number(Number::Length(line));
        let arm = self.c.number(Number::Quotient(unit, length));
        self.number(ops, Number::Quotient(turning, arm))
    }

    /// Adds the force of a joint that presses along one line to the answers, and to the loads of
    /// the part on its other side.
    pub(super) fn touched(&mut self, p: &mut Polygon, touch: &OuterJoint, ends: [MarkId; 2]) {
        match *touch {
            OuterJoint::Slot { guide, at, on, by } => self.slotted(p, guide, on, by, at, ends),
            OuterJoint::Mesh { rolling, at, on, by } => self.meshed(p, rolling, [on, by], at, ends),
            OuterJoint::Cylinder { driver, at, far, on } => {
                self.pushed(p, driver, on, [at, far], ends)
            }
            OuterJoint::Push { driver, guide, on, by } => {
                self.pushed_along(p, (driver, guide), [on, by], ends)
            }
            OuterJoint::Pin { .. }
            | OuterJoint::Slide { .. }
            | OuterJoint::Turn { .. }
            | OuterJoint::Balance { .. } => {}
        }
    }

    /// Writes a link in a guide with one more line of action.
    pub(super) fn in_a_guide(&mut self, link: LinkId, slide: OuterJoint, touch: OuterJoint) {
        let (OuterJoint::Slide { guide, at: counted, .. }, Some((line, at))) =
            (slide, self.line_of(&touch))
        else {
            return;
        };
        let moved = matches!(touch, OuterJoint::Push { .. } | OuterJoint::Balance { .. });
        let held = if moved { vec![] } else { vec![at.into()] };
        let mut acting = self.all_on(link, &held);
        let own = acting.len();
        if matches!(touch, OuterJoint::Slot { .. } | OuterJoint::Cylinder { .. }) {
            acting.extend(self.pin_loads_beside(&touch, at, link));
        }
        let mut p = self.polygon();
        let start = p.last;
        self.lay_all(&mut p, &acting[..own]);
        let before = p.last;
        self.lay_all(&mut p, &acting[own..]);
        let end = p.last;
        let lines =
            [self.line(&mut p, start, normal(guide)), self.line(&mut p, end, Direction::of(line))];
        let x = self.meet(&mut p, lines);
        if let Some(term) = reaction(&slide, ReactionComponent::Whole) {
            self.side(&mut p, (term, counted), [x, start], true);
        }
        let mut all = acting.clone();
        if let Some(term) = self.pressing(&touch) {
            self.side(&mut p, (term, at), [end, x], false);
            let force = self.measured(&mut p, end, x);
            all.push(ActingForce { term, force: Some((Base::Measured(force), at)), couple: None });
        }
        if matches!(touch, OuterJoint::Slot { .. } | OuterJoint::Cylinder { .. })
            && self.scene.links[link.0].points.contains(&at)
        {
            self.held_at(&mut p, at, link, [before, x]);
        }
        if let OuterJoint::Balance { driver, .. } = touch {
            self.answers.balance =
                Some(self.number(&mut p.ops, Number::Along(end, x, Direction::of(line))));
            let along =
                self.number(&mut p.ops, Number::Along(end, x, Direction::of(tangent(guide))));
            self.answers.drivers.push((driver, along));
        }
        self.touched(&mut p, &touch, [end, x]);
        self.offset(&mut p, slide, &all, [x, start]);
        self.finish(p, &[link], if moved { "driver" } else { "PH" });
    }
}
