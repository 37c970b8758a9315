//! Links on a pivot each that bars join in a ring: two with parallel bars (class IV), three and more (class VI).
//!
//! The force along one bar is taken twice, as zero and as a handy amount. Moments of each link with the bar to the next about its pivot give the force along that bar, link after
//! link; those of the last link leave a remainder, which is linear in the first force. Then the polygon of each link with its bar closes with the reaction of its pivot.

use super::answers::reaction;
use super::joints::{Hinge, Joints, Outer, Pair, too_many, turns_on};
use super::scribe::{Acting, Scribe, square_to};
use super::{About, Gives, Moments, Part, Party, Term};
use crate::construction::{Base, Direction, Number, NumberId, Op};
use hodograph_base::diag::Both;
use hodograph_scene::LinkId;

/// A link of the ring with its pivot and the bar to the next link.
#[derive(Clone, Copy)]
struct Core {
    link: LinkId,
    outer: Outer,
    pivot: Hinge,
    bar: LinkId,
    /// The pins of the bar: on the link, on the next link.
    pins: [Hinge; 2],
}

/// What is known of a link with its bar before the force along any bar.
struct Known {
    /// Loads of the link, and of its bar.
    loads: [Vec<Acting>; 2],
    /// The force of the next link square to the bar, by moments of the bar.
    across: Option<NumberId>,
    /// The moment of the bar.
    of_bar: Vec<Moments>,
    /// Moments about the pivot of all but the forces along bars, and their sum with the sign reversed.
    moments: Moments,
    turning: NumberId,
    /// Arms (m) of unit forces along the bar before, on the link, and along its own bar.
    arms: [NumberId; 2],
}

impl Scribe<'_> {
    /// Writes the equilibrium of links that bars join in a ring.
    ///
    /// # Errors
    /// A group of another kind; a further group at one of the pins.
    pub(super) fn on_a_ring(&mut self, links: &[LinkId], joints: &Joints) -> Result<(), Both> {
        let ring = self.ring(links, joints).ok_or_else(|| joints.no_method(self.scene, links))?;
        if let Some(pin) = ring.iter().flat_map(|core| core.pins).find(|p| !self.pin_loads(p.at, links[0]).is_empty()) {
            return Err(too_many(self.scene, pin.at));
        }
        let mut ops = Vec::new();
        let count = ring.len();
        let before = |i: usize| (i + count - 1) % count;
        let across: Vec<(Vec<Acting>, Option<NumberId>, Vec<Moments>)> =
            (0..count).map(|i| self.square_to_bar(&mut ops, &ring[i], ring[(i + 1) % count].link)).collect();
        let known: Vec<Known> = (0..count)
            .map(|i| {
                let next = ring[(i + 1) % count].link;
                self.known(&mut ops, ([&ring[before(i)], &ring[i]], next), [&across[before(i)], &across[i]])
            })
            .collect();
        let handy = libm::exp10(libm::floor(libm::log10(self.largest.clamp(1.0, 1e9))));
        let tried = [0, handy as i32].map(|amount| self.number(&mut ops, Number::Plain(amount)));
        let left = tried.map(|amount| self.remainder(&mut ops, &known, amount));
        let back = self.number(&mut ops, Number::Negative(left[1]));
        let change = self.number(&mut ops, Number::Sum(left[0], back));
        let share = self.number(&mut ops, Number::Quotient(left[0], change));
        let first = self.number(&mut ops, Number::Product(tried[1], share));
        // The force of each bar on the next link, along the bar.
        let mut pushes = vec![first; count];
        let mut found = Vec::new();
        for i in 1..count {
            let k = &known[i];
            let (along, turned) = self.passed_on(&mut ops, k, pushes[i - 1]);
            let term = Term::Reaction { of: Party::Link(ring[i - 1].bar), on: ring[i].link, part: Part::Normal };
            let mut of = k.moments.clone();
            of.of.push((term, ring[i - 1].pins[1].at, turned));
            of.value = along;
            found.push(of);
            pushes[i] = self.number(&mut ops, Number::Negative(along));
        }
        self.on_plane(ops);
        let term = Term::Reaction { of: Party::Link(ring[0].bar), on: ring[1 % count].link, part: Part::Normal };
        let gives = Gives::Trial { force: term, tried, left };
        let about = About::Point(ring[0].pivot.at);
        let all: Vec<LinkId> = ring.iter().map(|core| core.link).collect();
        let trial = Moments { links: all, about, of: Vec::new(), couples: Vec::new(), gives, value: first };
        let kind = if count == 2 { "IV" } else { "VI" };
        for i in (1..count).chain([0]) {
            let mut moments = known[i].of_bar.clone();
            if i == 1 % count {
                moments.push(trial.clone());
            }
            moments.extend(i.checked_sub(1).map(|k| found[k].clone()));
            let pair = [(&ring[before(i)], &known[before(i)], pushes[before(i)]), (&ring[i], &known[i], pushes[i])];
            self.link_and_bar(pair, ring[(i + 1) % count].link, moments, kind);
        }
        Ok(())
    }

    fn ring(&self, links: &[LinkId], joints: &Joints) -> Option<Vec<Core>> {
        let pivots: Vec<(LinkId, Outer, Hinge)> = joints
            .outer
            .iter()
            .map(|o| if let Outer::Pin { on, hinge, .. } = *o { Some((on, *o, hinge)) } else { None })
            .collect::<Option<_>>()?;
        let pins: Vec<Hinge> = joints
            .inner
            .iter()
            .map(|pair| if let Pair::Pin(hinge) = *pair { (hinge == Hinge::from(hinge.at)).then_some(hinge) } else { None })
            .collect::<Option<_>>()?;
        let count = pivots.len();
        (count > 1 && links.len() == 2 * count && pins.len() == 2 * count).then_some(())?;
        let core = |l: LinkId| pivots.iter().find(|(on, ..)| *on == l);
        let mut bars: Vec<LinkId> = links.iter().copied().filter(|l| core(*l).is_none()).collect();
        let mut out = Vec::new();
        let mut at = pivots[0];
        for _ in 0..count {
            let here = |bar: &LinkId| pins.iter().copied().find(|p| turns_on(self.scene, *bar, *p) && turns_on(self.scene, at.0, *p));
            let k = bars.iter().position(|bar| here(bar).is_some())?;
            let bar = bars.remove(k);
            let near = here(&bar)?;
            let far = pins.iter().copied().find(|p| *p != near && turns_on(self.scene, bar, *p))?;
            out.push(Core { link: at.0, outer: at.1, pivot: at.2, bar, pins: [near, far] });
            at = *pivots.iter().find(|(on, ..)| *on != at.0 && turns_on(self.scene, *on, far))?;
        }
        (at.0 == pivots[0].0 && bars.is_empty()).then_some(out)
    }

    fn along_bar(&self, core: &Core) -> Base {
        Base::Arm { from: self.mark(core.pins[0].at), to: self.mark(core.pins[1].at), known: false }
    }

    /// The loads of a bar, and the force of the next link square to it.
    fn square_to_bar(&mut self, ops: &mut Vec<Op>, core: &Core, next: LinkId) -> (Vec<Acting>, Option<NumberId>, Vec<Moments>) {
        let loads = self.all_on(core.bar, &core.pins);
        let mut found = Vec::new();
        let term = Term::Reaction { of: Party::Link(next), on: core.bar, part: Part::Tangential };
        let of = self.moments(ops, &[core.bar], &loads, About::Point(core.pins[0].at), Gives::Force(term, core.pins[1].at));
        let across = self.across(ops, &mut found, of, self.along_bar(core));
        (loads, across, found)
    }

    fn known(
        &mut self,
        ops: &mut Vec<Op>,
        ([before, core], next): ([&Core; 2], LinkId),
        across: [&(Vec<Acting>, Option<NumberId>, Vec<Moments>); 2],
    ) -> Known {
        let (pivot, about) = (self.mark(core.pivot.at), About::Point(core.pivot.at));
        let own = self.all_on(core.link, &[core.pivot, core.pins[0], before.pins[1]]);
        let loads = [own, across[1].0.clone()];
        let by_next = Term::Reaction { of: Party::Link(next), on: core.bar, part: Part::Normal };
        let mut moments = self.moments(ops, &[core.link, core.bar], &loads.concat(), about, Gives::Force(by_next, core.pins[1].at));
        for (k, on) in [before, core].into_iter().enumerate() {
            let Some(value) = across[k].1 else { continue };
            // A unit force square to the bar turns by the part of its arm along the bar; the bar before presses the other way.
            let arm = self.number(ops, Number::Along(pivot, self.mark(on.pins[1].at), Direction::of(self.along_bar(on))));
            let turned = self.number(ops, Number::Product(value, arm));
            let (turned, of, to) =
                if k == 0 { (self.number(ops, Number::Negative(turned)), before.bar, core.link) } else { (turned, next, core.bar) };
            moments.of.push((Term::Reaction { of: Party::Link(of), on: to, part: Part::Tangential }, on.pins[1].at, turned));
        }
        let turning = self.balancing(ops, &moments);
        let arms = [before, core].map(|on| {
            let line = self.along_bar(on);
            let unit = self.number(ops, Number::Moment { force: line, at: self.mark(on.pins[1].at), about: pivot });
            let length = self.c.number(Number::Length(line));
            self.number(ops, Number::Quotient(unit, length))
        });
        Known { loads, across: across[1].1, of_bar: across[1].2.clone(), moments, turning, arms }
    }

    /// The force of the next link along the bar of a link on which the bar before pushes, and the moment of that push.
    fn passed_on(&mut self, ops: &mut Vec<Op>, known: &Known, push: NumberId) -> (NumberId, NumberId) {
        let turned = self.number(ops, Number::Product(push, known.arms[0]));
        let back = self.number(ops, Number::Negative(turned));
        let sum = self.number(ops, Number::Sum(known.turning, back));
        (self.number(ops, Number::Quotient(sum, known.arms[1])), turned)
    }

    /// The moment that is left on the first link of the ring where its bar pushes the next one with a force.
    fn remainder(&mut self, ops: &mut Vec<Op>, known: &[Known], amount: NumberId) -> NumberId {
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

    /// The polygon of a link and its bar: the bar before, the next link and the loads, closed by the reaction of the pivot.
    fn link_and_bar(
        &mut self,
        [(before, known_before, push), (core, known, own_push)]: [(&Core, &Known, NumberId); 2],
        next: LinkId,
        moments: Vec<Moments>,
        kind: &'static str,
    ) {
        let mut p = self.polygon();
        p.moments = moments;
        let start = p.last;
        self.lay_all(&mut p, &known.loads[0]);
        let pushed = p.last;
        let on_link = |part| Term::Reaction { of: Party::Link(before.bar), on: core.link, part };
        let line = self.along_bar(before);
        self.laid(&mut p, (on_link(Part::Normal), before.pins[1].at), Direction::of(line).unit(), push);
        if let Some(value) = known_before.across {
            let back = self.number(&mut p.ops, Number::Negative(value));
            self.laid(&mut p, (on_link(Part::Tangential), before.pins[1].at), square_to(line), back);
        }
        let middle = p.last;
        self.diagonal(&mut p, (on_link(Part::Whole), before.pins[1].at), [pushed, middle]);
        self.lay_all(&mut p, &known.loads[1]);
        let held = p.last;
        let on_bar = |part| Term::Reaction { of: Party::Link(next), on: core.bar, part };
        let line = self.along_bar(core);
        let along = self.number(&mut p.ops, Number::Negative(own_push));
        self.laid(&mut p, (on_bar(Part::Normal), core.pins[1].at), Direction::of(line).unit(), along);
        if let Some(value) = known.across {
            self.laid(&mut p, (on_bar(Part::Tangential), core.pins[1].at), square_to(line), value);
        }
        let end = p.last;
        if let Some(term) = reaction(&core.outer, Part::Whole) {
            self.side(&mut p, (term, core.pivot.at), [end, start], false);
        }
        self.pinned(&mut p, core.pivot, core.link, [end, start]);
        self.inner_side(&mut p, core.pins[0], [core.bar, core.link], [end, middle]);
        self.inner_side(&mut p, core.pins[0], [core.link, core.bar], [middle, end]);
        self.inner_side(&mut p, core.pins[1], [core.bar, next], [held, end]);
        self.inner_side(&mut p, core.pins[1], [next, core.bar], [end, held]);
        self.finish(p, &[core.link, core.bar], kind);
    }
}
