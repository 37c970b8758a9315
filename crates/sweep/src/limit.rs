//! Limits and change points of a driver, and the smallest transmission angles.
//!
//! Every closed form gives sin² of the angle under which its two loci cross
//! ([`super::closure::Margin::crossing`]), a smooth function of the driver's position that
//! continues past the limit. Its simple zeros are the limits, its double zeros the change points,
//! its smallest value gives the smallest transmission angle. All are located by Newton's method
//! with exact derivatives, kept between bounds by halving; for class III groups by Newton's method
//! on the legs' equations together with their determinant.

use super::PlacedScene;
use super::follow::triad::FollowedState;
use super::kernel::Reg;
use super::lane::{Dual, Width};
use super::program::{Op, SweepProgram};
use super::station::{Stations, angle_per_value, position_now};
use hodograph_mechanism::position::toggle::Toggle;
use hodograph_scene::{LinkId, PointId};
use std::cell::RefCell;
use std::collections::VecDeque;
use std::f64::consts::TAU;
use std::rc::Rc;

/// The event of a group at a position of the driver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EventKind {
    /// The group cannot be assembled beyond.
    Limit,
    /// The group comes into line and passes through: its branch changes sign.
    ChangePoint,
}

/// A position at which a group is in line.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// The position of the driver (rad or m).
    pub value: f64,
    /// The kind of event.
    pub kind: EventKind,
    /// The links of the group.
    pub links: Vec<LinkId>,
    /// The pin at which they meet; `None` if the core of the group is a link.
    pub pin: Option<PointId>,
    /// The index of the joint in the program; `None` for a class III group.
    pub joint: Option<usize>,
    /// The legs that hold one another there, if the event concerns legs.
    pub toggle: Option<Toggle>,
}

/// The range of a driver from its position in the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct DriverRange {
    /// The driver's position in the scene.
    pub now: f64,
    /// The ends downward and upward; `None` where the driver turns fully (or nothing stops it
    /// within twice the mechanism's size).
    pub ends: [Option<Event>; 2],
    /// The change points within the range.
    pub changes: Vec<Event>,
    /// The distance searched to either side.
    pub reach: f64,
}

impl DriverRange {
    /// The range in numbers: `[low, high]`.
    pub fn bounds(&self) -> [f64; 2] {
        let end = |i: usize, far: f64| self.ends[i].as_ref().map_or(far, |e| e.value);
        [end(0, self.now - self.reach), end(1, self.now + self.reach)]
    }

    /// True if the driver has no end: a crank turns fully.
    pub fn full(&self) -> bool {
        self.ends.iter().all(Option::is_none)
    }

    /// True if a joint is on its other branch at the end of a range without ends: it met an odd
    /// number of change points.
    pub(super) fn flipped(&self) -> bool {
        let met = |joint: usize| self.changes.iter().filter(|c| c.joint == Some(joint)).count();
        self.changes.iter().filter_map(|c| c.joint).any(|joint| met(joint) % 2 == 1)
    }
}

/// A program with its driver, for evaluation at any position.
pub struct Probe<'a> {
    /// The program.
    pub program: SweepProgram,
    placed: &'a PlacedScene<'a>,
    driver: usize,
    per_value: f64,
    /// The driver's position in the scene.
    pub now: f64,
    start: Option<FollowedState>,
}

/// The number of steps of a search over the whole reach: two degrees, or the same part of the
/// travel.
const STEPS: usize = 180;

/// The crossing (sin²) below which a smallest sample is examined more closely: within a degree of a
/// double zero the crossing is less, unless the joint turns twenty times as fast as the driver.
pub(super) const SUSPECT: f64 = 0.1;

/// True if these stations, with crossings of more than [`SUSPECT`] at each, leave no gap in which a
/// limit or a change point goes unnoticed: they are no farther apart than the samples of a search,
/// and their span includes the driver's position in the scene.
pub(super) fn dense(
    program: &SweepProgram,
    placed: &PlacedScene,
    driver: usize,
    stations: &Stations,
) -> bool {
    let step = reach(placed, driver) / (STEPS as f64 * program.finer());
    let now = position_now(placed.scene, &placed.at, driver);
    let ends = stations.values.first().zip(stations.values.last());
    // The fold tests all of them, without a branch at each.
    let close =
        || stations.values.windows(2).fold(true, |close, w| close & ((w[1] - w[0]).abs() <= step));
    ends.is_some_and(|(a, b)| (now - a) * (now - b) <= 0.0) && close()
}

/// The number of reaches after which a sliding driver is searched in growing steps; [`GROWTH`] is
/// the factor from one to the next.
const FAR: f64 = 4.0;
const GROWTH: f64 = 1.05;

/// The crossing (sin²) up to which a zero is a change point: a double zero is met to the rounding
/// of its two factors. At 1e-7 rad from being in line, sin² is 1e-14; a mechanism with lengths that
/// miss a change point by less than that cannot be distinguished from one that has it.
const TOUCHING: f64 = 1e-14;

/// A part of a step of a search within which two limits are one: roots of rounding.
const CLOSE: f64 = 1e-9;

/// The greatest number of turns searched for limits: the pose of gears without a common factor in
/// their numbers of teeth recurs after hundreds.
const MOST_TURNS: u64 = 1000;

/// The number of turns searched where the pose of a mechanism never recurs.
const SOME_TURNS: f64 = 100.0;

/// The ratio of a wheel's to the driver's angular velocity above which the search becomes no finer.
const FASTEST: f64 = 16.0;

/// A turn, or twice the mechanism's size.
pub(super) fn reach(placed: &PlacedScene, driver: usize) -> f64 {
    if placed.scene.drivers[driver].kind.turns() { TAU } else { 2.0 * placed.at.extent() }
}

impl<'a> Probe<'a> {
    /// Prepares a program and the driver's position.
    pub fn of(program: SweepProgram, placed: &'a PlacedScene<'a>, driver: usize) -> Probe<'a> {
        let mut probe = Probe {
            program,
            placed,
            driver,
            per_value: angle_per_value(placed.scene, &placed.at, driver),
            now: position_now(placed.scene, &placed.at, driver),
            start: None,
        };
        probe.start = probe.program.start(probe.now, &|x| probe.turn(x));
        probe
    }

    fn turn(&self, x: f64) -> (f64, f64, f64) {
        (libm::cos(x * self.per_value), libm::sin(x * self.per_value), self.per_value)
    }

    /// Returns a turn, or twice the mechanism's size.
    pub fn reach(&self) -> f64 {
        reach(self.placed, self.driver)
    }

    /// Returns the distance to search to either side of the driver's position: until the pose
    /// recurs, or twice the mechanism's size.
    pub fn span(&self) -> f64 {
        match self.program.angular {
            true => self.program.period().unwrap_or(SOME_TURNS * TAU),
            false => self.reach(),
        }
    }

    /// The crossing (sin²) of a joint at a driver position, with its derivative.
    fn crossing(&self, joint: usize, x: f64) -> Dual {
        let (cos, sin, per_value) = self.turn(x);
        let mut registers = self.program.inputs(x, cos, sin, per_value);
        let joint = &self.program.joints[joint];
        self.program.derive_steps(0..joint.step, &mut registers);
        registers[joint.crossing.0 as usize]
    }

    /// The positions to examine on a travel: in equal steps, and one beyond its end, so that an
    /// event at the very end is seen too.
    ///
    /// A sliding driver leaves the mechanism behind after some times its size; from there on the
    /// steps grow with the travel, so that neither their number nor the gap that contains a limit
    /// grows out of proportion.
    pub(super) fn samples(&self, from: f64, until: f64) -> Vec<f64> {
        let way = until - from;
        let near = FAR * self.reach();
        let equal = |way: f64| {
            let steps = (way.abs() / self.reach() * STEPS as f64 * self.program.finer())
                .ceil()
                .clamp(1.0, 2e7) as usize;
            let step = way / steps as f64;
            (0..=steps + 1).map(move |i| from + step * i as f64)
        };
        if self.per_value != 0.0 || way.abs() <= near || near == 0.0 {
            return equal(way).collect();
        }
        let mut xs: Vec<f64> = equal(near.copysign(way)).collect();
        let mut gone = xs[xs.len() - 1] - from;
        while gone.abs() <= way.abs() {
            gone *= GROWTH;
            xs.push(from + gone);
        }
        xs
    }

    /// The end of a travel with followed links.
    pub(super) fn walk_tracks(&self, until: f64) -> Option<Event> {
        let mut state = self.start.clone()?;
        let xs = self.samples(self.now, until);
        for &x in &xs[1..xs.len() - 1] {
            let x = if (x - until) * (until - self.now) > 0.0 { until } else { x };
            let reached = self.program.advance(&state, x, &|x| self.turn(x));
            let last = match &reached {
                Ok(last) | Err(last) => last.clone(),
            };
            if self.missed(&last).is_some() {
                return self.missed_between(state, last);
            }
            if reached.is_err() {
                return Some(self.fold(&last, until));
            }
            state = last;
        }
        None
    }

    /// The first joint that does not close with the followed links in a state.
    fn missed(&self, state: &FollowedState) -> Option<usize> {
        let registers = self.program.placed(state, &|x| self.turn(x));
        let crossing = |c: Reg| registers[c.0 as usize].value;
        self.program.joints.iter().position(|joint| crossing(joint.crossing) < -TOUCHING)
    }

    /// The limit between a state in which all joints close and one in which a joint does not.
    fn missed_between(&self, mut inside: FollowedState, outside: FollowedState) -> Option<Event> {
        let mut joint = self.missed(&outside)?;
        let mut outside = outside.value;
        loop {
            let middle = 0.5 * (inside.value + outside);
            // No double remains between.
            if middle == inside.value || middle == outside {
                return Some(self.event(joint, EventKind::Limit, inside.value));
            }
            match self.program.advance(&inside, middle, &|x| self.turn(x)) {
                Ok(there) => match self.missed(&there) {
                    Some(first) => (joint, outside) = (first, middle),
                    None => inside = there,
                },
                Err(_) => outside = middle,
            }
        }
    }

    /// The crossings at many positions, joint by joint.
    fn sampled(&self, xs: &[f64]) -> Vec<Vec<f64>> {
        let fused = self.program.fused_crossings();
        let found: Vec<Option<Reg>> = self.program.crossings().map(|c| fused.place(c)).collect();
        let mut out = vec![Vec::with_capacity(xs.len()); found.len()];
        let mut buffer = fused.buffer();
        let stations = sampled_at(xs, self.per_value);
        for from in (0..xs.len()).step_by(fused.positions()) {
            let rows = from..xs.len().min(from + fused.positions());
            fused.load(&mut buffer, &stations, rows.clone());
            fused.run(&mut buffer, Width::Widest);
            for (reg, out) in found.iter().zip(&mut out) {
                match reg {
                    Some(reg) => out.extend_from_slice(buffer.numbers(*reg, rows.len())),
                    None => out.resize(out.len() + rows.len(), f64::NAN),
                }
            }
        }
        out
    }

    /// The first limit or change point on a travel.
    pub(super) fn first_event(&self, xs: &[f64]) -> Option<Event> {
        let c = self.sampled(xs);
        for i in 0..xs.len() {
            for j in 0..c.len() {
                let here = c[j][i];
                // Closures of groups upstream come first in the list; where one of them misses,
                // this one has no meaning.
                let meaning = |i: usize| c[..j].iter().all(|u| u[i] >= -TOUCHING);
                if i > 0 && c[j][i - 1] > TOUCHING && here < -TOUCHING && meaning(i) {
                    return Some(self.first_limit(j, self.root(j, xs[i - 1], xs[i]), xs[i - 1]));
                }
                let lowest = i > 0
                    && i + 1 < xs.len()
                    && here < SUSPECT
                    && here < c[j][i - 1]
                    && here <= c[j][i + 1];
                if lowest && meaning(i + 1) {
                    let (at, least) = self.least(j, xs[i - 1], xs[i + 1]);
                    if least.abs() <= TOUCHING {
                        return Some(self.event(j, EventKind::ChangePoint, at));
                    }
                    if least < 0.0 {
                        return Some(self.first_limit(j, self.root(j, xs[i - 1], at), xs[i - 1]));
                    }
                }
            }
        }
        None
    }

    /// The limit of a joint, or that of a later one which is met before it: from a position in which
    /// all close.
    fn first_limit(&self, joint: usize, value: f64, from: f64) -> Event {
        let mut first = (joint, value);
        for other in joint + 1..self.program.joints.len() {
            // Before the limit of the earlier joint the later one has its meaning.
            let before = first.1 + (from - first.1) * CLOSE;
            if self.crossing(other, before).value < -TOUCHING {
                first = (other, self.root(other, from, before));
            }
        }
        self.event(first.0, EventKind::Limit, first.1)
    }

    fn event(&self, joint: usize, kind: EventKind, value: f64) -> Event {
        let j = &self.program.joints[joint];
        let group = &self.placed.mechanism.groups[j.group];
        let toggle = Toggle::of(group, || false).filter(|t| matches!(t, Toggle::Line { .. }));
        Event { value, kind, links: j.links.clone(), pin: j.pin, joint: Some(joint), toggle }
    }

    /// A zero of a joint's crossing between a position where it is positive and one where it is
    /// negative (or has no value).
    fn root(&self, joint: usize, inside: f64, outside: f64) -> f64 {
        let (mut inside, mut outside) = (inside, outside);
        let mut x = 0.5 * (inside + outside);
        for _ in 0..200 {
            let c = self.crossing(joint, x);
            if c.value > 0.0 {
                inside = x;
            } else {
                outside = x;
            }
            let newton = x - c.value / c.slope;
            let within = (newton - inside) * (newton - outside) < 0.0;
            let next = if within { newton } else { 0.5 * (inside + outside) };
            // No double remains between the bounds, or Newton's method makes no progress.
            if next == x || next == inside || next == outside {
                return next;
            }
            x = next;
        }
        x
    }

    /// The position and value of a joint's smallest crossing between two positions: the zero of its
    /// derivative, by halving and secants (the derivative is smooth too).
    fn least(&self, joint: usize, a: f64, b: f64) -> (f64, f64) {
        let at = |x: f64| self.crossing(joint, x);
        let (mut a, mut b) = ((a, at(a).slope), (b, at(b).slope));
        // Slopes of one sign: the smallest value is at an end.
        let mut best =
            if a.1 * (b.0 - a.0) > 0.0 { (a.0, at(a.0).value) } else { (b.0, at(b.0).value) };
        if a.1 * b.1 >= 0.0 {
            return best;
        }
        for i in 0..80 {
            let secant = (a.0 * b.1 - b.0 * a.1) / (b.1 - a.1);
            let inside = (secant - a.0) * (secant - b.0) < 0.0;
            let x = if inside && i % 3 != 2 { secant } else { 0.5 * (a.0 + b.0) };
            if x == a.0 || x == b.0 {
                break;
            }
            let c = at(x);
            best = (x, c.value);
            if c.slope == 0.0 {
                break;
            }
            if c.slope.signum() == a.1.signum() { a = (x, c.slope) } else { b = (x, c.slope) }
        }
        best
    }

    /// The limit next to a state from which a class III group cannot go on: its fold, or a limit
    /// upstream.
    fn fold(&self, stuck: &FollowedState, until: f64) -> Event {
        let dets = self.program.determinants(stuck);
        // The group with the smallest determinant, relative to its own size, is the one that folds.
        let track = dets
            .iter()
            .enumerate()
            .min_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
            .map_or(0, |t| t.0);
        // A joint that closes before the group may be at its limit instead.
        let step = (until - stuck.value).signum() * 1e-6 * self.reach();
        let (cos, sin, per_value) = self.turn(stuck.value + step);
        let mut beyond = self.program.inputs(stuck.value + step, cos, sin, per_value);
        self.program.derive_steps(0..self.program.tracks[track].step, &mut beyond);
        for (j, joint) in self
            .program
            .joints
            .iter()
            .enumerate()
            .filter(|(_, j)| j.step < self.program.tracks[track].step)
        {
            if beyond[joint.crossing.0 as usize].value < 0.0 {
                return self.event(
                    j,
                    EventKind::Limit,
                    self.root(j, stuck.value, stuck.value + step),
                );
            }
        }
        let value = self.program.fold(track, stuck, &|x| self.turn(x)).unwrap_or(stuck.value);
        let group = &self.placed.mechanism.groups[self.program.tracks[track].group];
        let toggle = Toggle::of(group, || self.program.parallel(track, stuck, &|x| self.turn(x)));
        Event {
            value,
            kind: EventKind::Limit,
            links: group.links.clone(),
            pin: None,
            joint: None,
            toggle,
        }
    }

    /// Returns the smallest transmission angle of each joint over a range (rad, at most 90°) and
    /// its driver position, in the order (position, angle); empty with class III groups.
    pub fn transmission(&self, low: f64, high: f64) -> Vec<(f64, f64)> {
        if !self.program.tracks.is_empty() {
            return Vec::new();
        }
        let turns = if self.program.angular { ((high - low) / TAU).max(1.0) } else { 1.0 };
        let steps = (STEPS as f64 * turns * self.program.finer() - 1e-6).ceil() as usize;
        let xs: Vec<f64> =
            (0..=steps).map(|i| low + (high - low) * (i as f64 / steps as f64)).collect();
        let angle = |sin2: f64| libm::asin(sin2.clamp(0.0, 1.0).sqrt());
        let worst = |(j, c): (usize, &Vec<f64>)| {
            let i = (0..c.len()).filter(|&i| c[i] >= 0.0).min_by(|&a, &b| c[a].total_cmp(&c[b]))?;
            let (at, least) = self.least(j, xs[i.saturating_sub(1)], xs[(i + 1).min(steps)]);
            let (at, least) = if least < c[i] { (at, least) } else { (xs[i], c[i]) };
            Some((at, angle(least)))
        };
        self.sampled(&xs)
            .iter()
            .enumerate()
            .map(|w| worst(w).unwrap_or((f64::NAN, f64::NAN)))
            .collect()
    }
}

/// Cosines and sines at the positions of a search. The last ones are kept: thousands of mechanisms
/// of a batch are searched at the same positions.
fn sampled_at(xs: &[f64], per_value: f64) -> Rc<Stations> {
    thread_local! {
        static LAST: RefCell<VecDeque<(f64, Rc<Stations>)>> = const { RefCell::new(VecDeque::new()) };
    }
    LAST.with_borrow_mut(|last| {
        if let Some((_, kept)) = last.iter().find(|(p, s)| *p == per_value && s.values == xs) {
            return kept.clone();
        }
        let new = Rc::new(Stations::of_values(xs.to_vec(), per_value));
        // One for each direction of the search.
        last.truncate(1);
        last.push_front((per_value, new.clone()));
        new
    })
}

/// The range of a driver from its position, for a program that holds the relevant groups.
pub fn range(program: SweepProgram, placed: &PlacedScene, driver: usize) -> DriverRange {
    let mut probe = Probe::of(program.clone(), placed, driver);
    let (now, reach) = (probe.now, probe.span());
    let (up, changes) = probe.walk(now + reach);
    let mut changes = changes.events;
    if up.is_none() && program.angular && program.period().is_some() {
        return DriverRange { now, ends: [None, None], changes, reach };
    }
    let (down, others) = Probe::of(program, placed, driver).walk(now - reach);
    changes.extend(others.events);
    DriverRange { now, ends: [down, up], changes, reach }
}

impl SweepProgram {
    /// Returns the driver's angle after which the pose recurs (rad); `None` if it never does, or
    /// after too many turns to search.
    pub(super) fn period(&self) -> Option<f64> {
        (1..=MOST_TURNS).contains(&self.turns).then_some(TAU * self.turns as f64)
    }

    /// Returns the factor on the number of steps that makes a search fine enough for the fastest
    /// wheel.
    pub(super) fn finer(&self) -> f64 {
        self.fastest.min(FASTEST).ceil()
    }

    /// Turns a joint to its other branch.
    pub fn flip(&mut self, joint: usize) {
        match &mut self.steps[0][self.joints[joint].step].op {
            Op::Circles(k) => k.sign = -k.sign,
            Op::CircleLine(k) => k.sign = -k.sign,
            Op::SlotLever(k) => k.sign = -k.sign,
            _ => {}
        }
        self.runs = Default::default();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compile;
    use hodograph_mechanism::mechanism::Mechanism;
    use hodograph_scene::{read, templates};

    /// A very long travel ends at the same limit as one of the mechanism's own size.
    #[test]
    fn a_limit_is_where_it_is_however_far_the_way_goes() {
        for name in ["excavator", "oscillating-cylinder", "scotch-yoke", "robot-arm"] {
            let scene = read(templates::get(name).unwrap()).unwrap().value;
            let m = Mechanism::new(&scene).unwrap().value;
            let placed = PlacedScene::new(&scene, &m).unwrap();
            let program = compile(&scene, &m, &placed.at, Some(0), &scene.find).unwrap();
            for sign in [1.0, -1.0] {
                let end = |until: f64| Probe::of(program.clone(), &placed, 0).walk(until).0;
                let probe = Probe::of(program.clone(), &placed, 0);
                if probe.per_value != 0.0 {
                    continue;
                }
                let near = end(probe.now + sign * probe.reach());
                for far in [1e3, 1e13, 1e80] {
                    let there = end(probe.now + sign * far);
                    match (&near, &there) {
                        (Some(a), Some(b)) => assert!(
                            (a.value - b.value).abs() <= 1e-12 * a.value.abs(),
                            "{name}: {a:?}, {b:?}"
                        ),
                        (None, None) => {}
                        _ => panic!("{name} to {far:e}: {near:?}, {there:?}"),
                    }
                }
            }
        }
    }
}
