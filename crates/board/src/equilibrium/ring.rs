//! Links, each on a pivot, that bars or sliding blocks join to a ring: two with parallel bars or a
//! block (class IV), three and more (class VI).
//!
//! The force along one bar, or of one block square to its guide, is assumed twice, as zero and as a
//! handy magnitude. Moments of each link with its bar about its pivot give the force along that
//! bar, link after link; the moments of the last link leave a remainder, which is linear in the
//! first force. Then the polygon of each link with its bar closes with the reaction of its pivot.

use super::answers::reaction;
use super::joints::{DyadJoint, Hinge, Joints, OuterJoint, too_many, turns_on};
use super::scribe::{ActingForce, Scribe, square_to};
use super::{About, ForceTerm, MomentResult, Moments, Party, ReactionComponent};
use crate::construction::{Base, Direction, Key, Number, NumberId, Op};
use hodograph_base::diag::Both;
use hodograph_scene::{GuideId, LinkId, PointId};

/// A link of the ring with its pivot, and the bar or block between it and the next link.
#[derive(Clone, Copy)]
struct RingLink {
    link: LinkId,
    outer: OuterJoint,
    pivot: Hinge,
    bar: LinkId,
    /// The hinge between bar and link.
    near: Hinge,
    far: FarJoint,
    next: LinkId,
}

/// The joint of a bar or block with the next link.
#[derive(Clone, Copy)]
enum FarJoint {
    /// The pin of a bar.
    Pin(PointId),
    /// The guide of a block.
    Slide(GuideId),
}

/// A bar with its loads.
struct RingBar {
    loads: Vec<ActingForce>,
    /// The force of the next link square to the bar.
    across: Option<NumberId>,
    /// The couple of the guide on the block.
    couple: Option<NumberId>,
    moments: Vec<Moments>,
}

/// A link with its bar, before the forces along the bars are known.
struct RingMoments {
    loads: Vec<ActingForce>,
    /// The moments about the pivot without the forces along the bars, and their sum with the sign
    /// reversed.
    moments: Moments,
    turning: NumberId,
    /// The arms (m) of the previous bar and of the link's own bar.
    arms: [NumberId; 2],
}

impl RingLink {
    /// Returns a point on the line of the bar at which the next link presses on it.
    fn touch(&self) -> PointId {
        if let FarJoint::Pin(p) = self.far { p } else { self.near.at }
    }

    /// Returns the force of the next link on the bar.
    fn on_bar(&self, part: ReactionComponent) -> ForceTerm {
        ForceTerm::Reaction { of: Party::Link(self.next), on: self.bar, part }
    }

    /// Returns the force of the bar on the next link.
    fn on_next(&self, part: ReactionComponent) -> ForceTerm {
        ForceTerm::Reaction { of: Party::Link(self.bar), on: self.next, part }
    }

    /// Returns the part of these forces along the line: the whole force if a guide presses.
    fn axial(&self) -> ReactionComponent {
        if matches!(self.far, FarJoint::Pin(_)) {
            ReactionComponent::Normal
        } else {
            ReactionComponent::Whole
        }
    }
}

impl Scribe<'_> {
    /// Writes the equilibrium of links in a ring.
    ///
    /// # Errors
    /// A group of another kind; a further group at one of the pins.
    pub(super) fn on_a_ring(&mut self, links: &[LinkId], joints: &Joints) -> Result<(), Both> {
        let reversed: Vec<LinkId> = links.iter().rev().copied().collect();
        let ring = self.ring(links, joints).or_else(|| self.ring(&reversed, joints));
        let ring = ring.ok_or_else(|| joints.no_method(self.scene, links))?;
        let pins = ring.iter().flat_map(|core| [core.near.at, core.touch()]);
        if let Some(pin) = pins.into_iter().find(|p| !self.pin_loads(*p, links[0]).is_empty()) {
            return Err(too_many(self.scene, pin));
        }
        let mut ops = Vec::new();
        let count = ring.len();
        let before = |i: usize| (i + count - 1) % count;
        let bars: Vec<RingBar> = ring.iter().map(|core| self.bar(&mut ops, core)).collect();
        let known: Vec<RingMoments> = (0..count)
            .map(|i| {
                self.known(&mut ops, [&ring[before(i)], &ring[i]], [&bars[before(i)], &bars[i]])
            })
            .collect();
        let handy = libm::exp10(libm::floor(libm::log10(self.largest.clamp(1.0, 1e9))));
        let tried = [0, handy as i32].map(|amount| self.number(&mut ops, Number::Plain(amount)));
        let left = tried.map(|amount| self.remainder(&mut ops, &known, amount));
        let back = self.number(&mut ops, Number::Negative(left[1]));
        let change = self.number(&mut ops, Number::Sum(left[0], back));
        let share = self.number(&mut ops, Number::Quotient(left[0], change));
        let first = self.number(&mut ops, Number::Product(tried[1], share));
        let gives = MomentResult::Trial { force: ring[0].on_next(ring[0].axial()), tried, left };
        let about = About::Point(ring[0].pivot.at);
        let all: Vec<LinkId> = ring.iter().map(|core| core.link).collect();
        let trial =
            Moments { links: all, about, of: Vec::new(), couples: Vec::new(), gives, value: first };
        // The force of each bar on the next link, along the bar.
        let mut pushes = vec![first; count];
        let mut moments: Vec<Vec<Moments>> = bars.iter().map(|bar| bar.moments.clone()).collect();
        for i in 1..count {
            let (along, turned) = self.passed_on(&mut ops, &known[i], pushes[i - 1]);
            let last = &ring[i - 1];
            let mut of = known[i].moments.clone();
            of.of.push((last.on_next(last.axial()), last.touch(), turned));
            of.value = along;
            moments[i].extend((i == 1).then(|| trial.clone()));
            moments[i].push(of);
            pushes[i] = self.number(&mut ops, Number::Negative(along));
        }
        self.on_plane(ops);
        for i in (1..count).chain([0]) {
            let sides = [
                (&ring[before(i)], &bars[before(i)], pushes[before(i)]),
                (&ring[i], &bars[i], pushes[i]),
            ];
            self.link_and_bar(
                sides,
                &known[i].loads,
                std::mem::take(&mut moments[i]),
                if count == 2 { "IV" } else { "VI" },
            );
        }
        Ok(())
    }

    /// Returns the ring, with the first bars in the order of the links that close it.
    fn ring(&self, links: &[LinkId], joints: &Joints) -> Option<Vec<RingLink>> {
        let pivots: Vec<(LinkId, OuterJoint, Hinge)> = joints
            .outer
            .iter()
            .map(|o| {
                if let OuterJoint::Pin { on, hinge, .. } = *o {
                    Some((on, *o, hinge))
                } else {
                    None
                }
            })
            .collect::<Option<_>>()?;
        let count = pivots.len();
        (count > 1 && links.len() == 2 * count && joints.inner.len() == 2 * count).then_some(())?;
        let is_core = |l: LinkId| pivots.iter().any(|(on, ..)| *on == l);
        let mut bars: Vec<LinkId> = links.iter().copied().filter(|l| !is_core(*l)).collect();
        let joins = |pair: &DyadJoint, a: LinkId, b: LinkId| match *pair {
            DyadJoint::Pin(hinge) => {
                hinge == hinge.at.into()
                    && turns_on(self.scene, a, hinge)
                    && turns_on(self.scene, b, hinge)
            }
            DyadJoint::Slide { slider, on, .. } => (slider, on) == (a, b),
        };
        let mut out: Vec<RingLink> = Vec::new();
        let mut at = pivots[0];
        for _ in 0..count {
            let near = |bar: LinkId| {
                joints
                    .inner
                    .iter()
                    .find(|pair| matches!(pair, DyadJoint::Pin(_)) && joins(pair, bar, at.0))
            };
            let bar = bars.remove(bars.iter().position(|bar| near(*bar).is_some())?);
            let Some(DyadJoint::Pin(hinge)) = near(bar) else { return None };
            let far = |(on, ..): &&(LinkId, OuterJoint, Hinge)| {
                *on != at.0 && joints.inner.iter().any(|pair| joins(pair, bar, *on))
            };
            let next = *pivots.iter().find(far)?;
            let far = match joints.inner.iter().find(|pair| joins(pair, bar, next.0))? {
                DyadJoint::Pin(hinge) => FarJoint::Pin(hinge.at),
                DyadJoint::Slide { guide, .. } => FarJoint::Slide(*guide),
            };
            out.push(RingLink {
                link: at.0,
                outer: at.1,
                pivot: at.2,
                bar,
                near: *hinge,
                far,
                next: next.0,
            });
            at = next;
        }
        (at.0 == pivots[0].0 && bars.is_empty()).then_some(out)
    }

    /// Returns the line of a bar, from the link to the next one; for a block, square to its guide.
    fn line_of_bar(&self, core: &RingLink) -> Base {
        match core.far {
            FarJoint::Pin(p) => {
                Base::Arm { from: self.mark(core.near.at), to: self.mark(p), known: false }
            }
            FarJoint::Slide(guide) => Base::Normal(Key::of(guide.0), self.mark(core.near.at)),
        }
    }

    fn bar(&mut self, ops: &mut Vec<Op>, core: &RingLink) -> RingBar {
        let held: Vec<Hinge> = [core.near, core.touch().into()].into();
        let loads = self.all_on(core.bar, &held);
        let mut moments = Vec::new();
        let gives = MomentResult::Force(core.on_bar(ReactionComponent::Tangential), core.touch());
        let of = self.moments(ops, &[core.bar], &loads, About::Point(core.near.at), gives);
        let (mut across, mut couple) = (None, None);
        match core.far {
            FarJoint::Pin(_) => across = self.across(ops, &mut moments, of, self.line_of_bar(core)),
            FarJoint::Slide(_) if of.of.is_empty() && of.couples.is_empty() => {}
            FarJoint::Slide(_) => couple = Some(self.balancing(ops, &of)),
        }
        RingBar { loads, across, couple, moments }
    }

    fn known(
        &mut self,
        ops: &mut Vec<Op>,
        [before, core]: [&RingLink; 2],
        bars: [&RingBar; 2],
    ) -> RingMoments {
        let (pivot, about) = (self.mark(core.pivot.at), About::Point(core.pivot.at));
        let loads = self.all_on(core.link, &[core.pivot, core.near, before.touch().into()]);
        let gives = MomentResult::Force(core.on_bar(core.axial()), core.touch());
        let all = [&loads[..], &bars[1].loads].concat();
        let mut moments = self.moments(ops, &[core.link, core.bar], &all, about, gives);
        // The previous bar presses on the link, opposite to the force on the bar.
        for (on, bar, reversed) in [(before, bars[0], true), (core, bars[1], false)] {
            let mut signed = |s: &mut Self, value| {
                if reversed { s.number(ops, Number::Negative(value)) } else { value }
            };
            let term = |part| if reversed { on.on_next(part) } else { on.on_bar(part) };
            if let Some(couple) = bar.couple {
                moments.couples.push((term(ReactionComponent::Whole), signed(self, couple)));
            }
            if let Some(value) = bar.across {
                // The arm of a unit force square to the bar is the component of the connecting
                // vector along the bar.
                let value = signed(self, value);
                let arm = self.number(
                    ops,
                    Number::Along(
                        pivot,
                        self.mark(on.touch()),
                        Direction::of(self.line_of_bar(on)),
                    ),
                );
                moments.of.push((
                    term(ReactionComponent::Tangential),
                    on.touch(),
                    self.number(ops, Number::Product(value, arm)),
                ));
            }
        }
        let turning = self.balancing(ops, &moments);
        let arms = [before, core].map(|on| {
            let line = self.line_of_bar(on);
            let unit = self.number(
                ops,
                Number::Moment { force: line, at: self.mark(on.touch()), about: pivot },
            );
            let length = self.c.number(Number::Length(line));
            self.number(ops, Number::Quotient(unit, length))
        });
        RingMoments { loads, moments, turning, arms }
    }

    /// Returns the force of the next link along a link's bar from the push of the previous bar on
    /// the link, and the moment of that push.
    fn passed_on(
        &mut self,
        ops: &mut Vec<Op>,
        known: &RingMoments,
        push: NumberId,
    ) -> (NumberId, NumberId) {
        let turned = self.number(ops, Number::Product(push, known.arms[0]));
        let back = self.number(ops, Number::Negative(turned));
        let sum = self.number(ops, Number::Sum(known.turning, back));
        (self.number(ops, Number::Quotient(sum, known.arms[1])), turned)
    }

    /// Returns the remaining moment on the first link of the ring, if its bar pushes the next link
    /// with a given force.
    fn remainder(
        &mut self,
        ops: &mut Vec<Op>,
        known: &[RingMoments],
        amount: NumberId,
    ) -> NumberId {
        let mut push = amount;
        for k in &known[1..] {
            let (along, _) = self.passed_on(ops, k, push);
            push = self.number(ops, Number::Negative(along));
        }
        let [a, b] = known[0].arms;
        let last = self.number(ops, Number::Product(push, a));
        let own = self.number(ops, Number::Product(amount, b));
        let own = self.number(ops, Number::Negative(own));
        let bars = self.number(ops, Number::Sum(last, own));
        let loads = self.number(ops, Number::Negative(known[0].turning));
        self.number(ops, Number::Sum(loads, bars))
    }

    /// Writes the polygon of a link and its bar: the previous bar, the next link and the loads,
    /// closed by the reaction of the pivot.
    fn link_and_bar(
        &mut self,
        [(before, bar_before, push), (core, bar, own_push)]: [(&RingLink, &RingBar, NumberId); 2],
        loads: &[ActingForce],
        moments: Vec<Moments>,
        kind: &'static str,
    ) {
        let mut p = self.polygon();
        p.moments = moments;
        let start = p.last;
        self.lay_all(&mut p, loads);
        let pushed = p.last;
        let line = Direction::of(self.line_of_bar(before)).unit();
        self.laid(&mut p, (before.on_next(before.axial()), before.touch()), line, push);
        if let Some(value) = bar_before.across {
            let back = self.number(&mut p.ops, Number::Negative(value));
            self.laid(
                &mut p,
                (before.on_next(ReactionComponent::Tangential), before.touch()),
                square_to(self.line_of_bar(before)),
                back,
            );
        }
        let middle = p.last;
        self.lay_all(&mut p, &bar.loads);
        let held = p.last;
        let along = self.number(&mut p.ops, Number::Negative(own_push));
        let line = Direction::of(self.line_of_bar(core)).unit();
        self.laid(&mut p, (core.on_bar(core.axial()), core.touch()), line, along);
        if let Some(value) = bar.across {
            self.laid(
                &mut p,
                (core.on_bar(ReactionComponent::Tangential), core.touch()),
                square_to(self.line_of_bar(core)),
                value,
            );
        }
        let end = p.last;
        if let Some(term) = reaction(&core.outer, ReactionComponent::Whole) {
            self.side(&mut p, (term, core.pivot.at), [end, start], false);
        }
        self.pinned(&mut p, core.pivot, core.link, [end, start]);
        if matches!(before.far, FarJoint::Pin(_)) {
            self.diagonal(
                &mut p,
                (before.on_next(ReactionComponent::Whole), before.touch()),
                [pushed, middle],
            );
        }
        self.inner_pin(&mut p, core.near, [core.bar, core.link], [end, middle, end]);
        match core.far {
            FarJoint::Pin(pin) => {
                self.inner_pin(&mut p, pin.into(), [core.bar, core.next], [held, end, held])
            }
            FarJoint::Slide(guide) => {
                let place = self.reference(guide).unwrap_or(core.near.at);
                self.inner_guide(
                    &mut p,
                    guide,
                    core.bar,
                    (core.near.at, place),
                    &bar.loads,
                    [held, end],
                );
            }
        }
        self.finish(p, &[core.link, core.bar], kind);
    }
}
