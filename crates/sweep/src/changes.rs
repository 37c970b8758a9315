//! The change points of a driver's travel, found once for each period.
//!
//! While its joints keep their branches, a program has the period of the driver's turn (of several
//! turns with rolling links). After a period without an event no further turn has one. If all
//! branches are the same as some whole turns before, the same change points recur for ever. Travel
//! of a million turns is therefore searched as fast as travel of a few.

use super::limit::{Event, EventKind, Probe};
use super::program::{Op, SweepProgram};

/// Change points on the travel from the driver's position, in the order in which they are met.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Changes {
    /// The change points found: all of them, or up to the first that recurs.
    pub events: Vec<Event>,
    again: Option<Recurrence>,
}

/// A recurrence: the last event repeats an earlier one, some turns later.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Recurrence {
    /// The index of the earlier event.
    first: usize,
    /// The distance between the two, in the direction of travel (rad).
    after: f64,
}

/// The greatest difference between recurrences of one change point that are whole turns apart: the
/// rounding of their positions, which is that of the root of a double zero. Different change points
/// differ by more, or cannot be distinguished.
const SAME: f64 = 1e-6;

impl Changes {
    /// The number of programs for the travel: one for each stretch between change points.
    pub fn stretches(&self) -> usize {
        self.events.len() + 1
    }

    /// The index of the stretch that contains a value; `sense` is 1 for travel upward and −1
    /// downward.
    pub fn stretch(&self, value: f64, sense: f64) -> usize {
        let mut value = value;
        if let (Some(Recurrence { after, .. }), Some(last)) = (self.again, self.events.last()) {
            let beyond = sense * (value - last.value);
            if beyond > 0.0 {
                value -= sense * after * (beyond / after).ceil();
            }
        }
        self.events.iter().filter(|e| sense * (value - e.value) > 0.0).count()
    }

    /// The change points up to a value, each of them once, and `true` if they recur on further
    /// turns.
    pub fn met(&self, until: f64) -> (&[Event], bool) {
        let after_last = |Recurrence { first, after }: Recurrence| {
            let [one, last] = [self.events.get(first)?, self.events.last()?].map(|e| e.value);
            let sense = (last - one).signum();
            // Changes repeat with the period: the next one follows the last by the distance found
            // one period earlier.
            let next = self.events.get(first + 1)?.value + sense * after;
            Some(sense * (until - next) >= 0.0)
        };
        let more = self.again.and_then(after_last).unwrap_or(false);
        (&self.events[..self.events.len() - usize::from(more)], more)
    }

    /// Records whether the last event repeats an earlier one on a further turn, and returns `true`
    /// if so; `signs` are the branches behind each event.
    fn close(&mut self, period: f64, signs: &[Vec<bool>]) -> bool {
        let (Some(last), Some(after)) = (self.events.last(), signs.last()) else { return false };
        let earlier = self.events.iter().zip(signs).take(self.events.len() - 1).enumerate();
        let comes_again = |(first, (event, behind)): (usize, (&Event, &Vec<bool>))| {
            let way = (last.value - event.value).abs();
            let turns = libm::rint(way / period);
            let same = event.joint == last.joint
                && behind == after
                && turns >= 1.0
                && (way - turns * period).abs() < SAME;
            same.then_some(Recurrence { first, after: turns * period })
        };
        self.again = earlier.rev().find_map(comes_again);
        self.again.is_some()
    }
}

impl Probe<'_> {
    /// Searches the travel from the driver's position to `until`; returns the limit that ends it,
    /// if any, and its change points. Each change point turns the sign of its joint for the rest of
    /// the travel.
    pub fn walk(&mut self, until: f64) -> (Option<Event>, Changes) {
        let mut changes = Changes::default();
        if !self.program.tracks.is_empty() {
            return (self.walk_tracks(until), changes);
        }
        let turning = self.program.angular;
        let period = self.program.period();
        let mut signs = Vec::new();
        let mut from = self.now;
        // The search goes on half a step behind a change point; there are no more change points
        // than steps.
        loop {
            let to = if turning && (until - from).abs() > self.span() {
                from + self.span().copysign(until - from)
            } else {
                until
            };
            let xs = self.samples(from, to);
            let step = xs[1] - xs[0];
            match self.first_event(&xs) {
                // After a whole period without an event all further periods have none.
                None if to == until || period.is_some() => return (None, changes),
                None => from = to,
                Some(event) if (event.value - until) * step > 0.0 => return (None, changes),
                Some(limit) if limit.kind == EventKind::Limit => return (Some(limit), changes),
                Some(change) => {
                    from = change.value + 0.5 * step;
                    self.program.flip(change.joint.unwrap_or(0));
                    changes.events.push(change);
                    signs.push(self.program.signs());
                    if (until - from) * step <= 0.0
                        || period.is_some_and(|period| turning && changes.close(period, &signs))
                    {
                        return (None, changes);
                    }
                }
            }
        }
    }
}

impl SweepProgram {
    /// The branch of each joint.
    fn signs(&self) -> Vec<bool> {
        let sign = |step: usize| match &self.steps[0][step].op {
            Op::Circles(k) => k.sign > 0.0,
            Op::CircleLine(k) => k.sign > 0.0,
            Op::SlotLever(k) => k.sign > 0.0,
            _ => true,
        };
        self.joints.iter().map(|j| sign(j.step)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{PlacedScene, Stations, Table, Width, compile, run};
    use hodograph_mechanism::mechanism::Mechanism;
    use hodograph_scene::{Angle, edit, read, templates};
    use std::f64::consts::TAU;

    fn with<T>(phi: &str, see: impl FnOnce(&PlacedScene) -> T) -> T {
        let text = templates::instantiate("parallelogram", &[("phi_1", phi)]).unwrap();
        let scene = read(edit::with_find(&text, &["x_C", "y_C", "v_C", "a_E", "omega_3"]).unwrap())
            .unwrap()
            .value;
        let m = Mechanism::new(&scene).unwrap().value;
        see(&PlacedScene::new(&scene, &m).unwrap())
    }

    /// Every tenth degree of a turn, including positions in line, `turns` turns on.
    fn turn(placed: &PlacedScene, turns: f64) -> Table {
        let [from, to] = [10.0, 370.0].map(|deg| Angle::Deg(deg + 360.0 * turns));
        run(placed, 0, &Stations::turned(from, to, 36), Width::Widest).unwrap()
    }

    #[test]
    fn further_turns_are_the_first_one_again() {
        let first = with("60 deg", |placed| turn(placed, 0.0));
        assert_eq!(first.rows(), 37);
        for (phi, turns) in [
            ("60 deg", 1.0),
            ("60 deg", -3.0),
            ("60 deg", 5000.0),
            ("60 deg", -10_000.0),
            ("10000100 deg", 0.0),
            ("-99999 deg", 12.0),
        ] {
            let far = with(phi, |placed| turn(placed, turns));
            assert_eq!(far.rows(), 37, "{phi}, {turns} turns on: {:?}", far.notes);
            for (a, b) in first.columns.iter().zip(&far.columns).skip(1) {
                let size = a.values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
                let off =
                    a.values.iter().zip(&b.values).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!(off <= 1e-9 * size, "{phi}, {turns} turns on: {} is off by {off}", a.name);
            }
            assert!(far.notes.len() < 12, "{:?}", far.notes);
        }
    }

    /// The search takes as many steps as for a few turns, however many there are, and finds the
    /// branch changes on the last of them.
    #[test]
    fn a_million_turns_are_searched_as_soon_as_a_few() {
        with("60 deg", |placed| {
            let program =
                compile(placed.scene, placed.mechanism, &placed.at, Some(0), &placed.scene.find)
                    .unwrap();
            for sense in [1.0, -1.0] {
                let now = 60f64.to_radians();
                let (end, changes) =
                    Probe::of(program.clone(), placed, 0).walk(now + sense * 1e6 * TAU);
                assert!(end.is_none() && changes.events.len() <= 4, "{changes:?}");
                // Two change points a turn, each leading into the other's stretch.
                let at = |turns: f64, deg: f64| {
                    changes.stretch(now + sense * (turns * TAU + f64::to_radians(deg)), sense)
                };
                let kinds = |turns: f64| [at(turns, 90.0), at(turns, 200.0), at(turns, 330.0)];
                assert_eq!(kinds(7.0), kinds(999_999.0), "{changes:?}");
                assert!(kinds(7.0)[1] != kinds(7.0)[2], "{changes:?}");
                let (met, more) = changes.met(now + sense * 1e6 * TAU);
                assert!(more && met.len() == 2, "{met:?}");
                assert!(!changes.met(now + sense * 0.9 * TAU).1);
            }
        });
    }
}
