//! Mechanisms that have no program: Newton's method solves all their equations together, each
//! position from the one before it (natural continuation with step control), and the loop equations
//! answer the questions there.

use super::chains::{Chains, Follow, ValueFunction};
use super::step::{TravelPose, foretold, is_followed};
use crate::PlacedScene;
use crate::chunks::SweepRows;
use crate::compile::ask;
use crate::general::{self, General};
use crate::limit::{Event, EventKind};
use crate::station::{Stations, position_now};
use crate::train::AngleTrain;
use hodograph_base::diag::{Diagnostic, Faults, both};
use hodograph_mechanism::mechanism::{Core, Mechanism};
use hodograph_mechanism::position::Configuration;
use hodograph_mechanism::position::fold::fold;
use hodograph_mechanism::position::newton::{self, DriverValues};
use hodograph_mechanism::position::toggle::Toggle;
use hodograph_scene::{driver_position, with_driver_at};
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::ops::Range;

/// The greatest step of the fastest wheel: an eighth of a turn. With gears, turns are distinct, and
/// a step of the driver must not be taken for one in the other sense.
const PART_OF_A_TURN: f64 = std::f64::consts::FRAC_PI_4;

/// The number of steps through such a part of a turn, or of the mechanism's size, after which the
/// way counts as blocked.
const MOST_STEPS: usize = 200;

/// A mechanism moved by one of its drivers.
pub(crate) struct DrivenMechanism<'a> {
    placed: &'a PlacedScene<'a>,
    driver: usize,
    /// The position of the driver at the instant.
    now: f64,
    /// The drivers' values at the instant, as Newton's method counts them.
    drivers: DriverValues,
    /// The ratio of the fastest wheel's angular velocity to the driver's, and the number of turns
    /// after which the pose recurs; 0 if it never does.
    wheels: (f64, u64),
}

/// The greatest ratio of a step to the one before it for a prediction: beyond it the secant is
/// rounding.
const FARTHEST: f64 = 2.0;

/// The configuration at a value of the driver, which is the pose's travel, and at the step before.
#[derive(Clone)]
pub(crate) struct PoseHistory {
    now: TravelPose,
    before: Option<TravelPose>,
}

impl PoseHistory {
    fn first(value: f64, at: &Configuration) -> PoseHistory {
        PoseHistory { now: TravelPose { travel: value, configuration: at.clone() }, before: None }
    }

    /// The predicted configuration.
    fn ahead(&self, value: f64) -> Configuration {
        let step = |from: &TravelPose, to: f64| (to - from.travel).abs();
        let near = |before: &&TravelPose| {
            step(&self.now, value) <= FARTHEST * step(before, self.now.travel)
        };
        foretold(self.before.as_ref().filter(near), &self.now, value)
    }

    fn on(self, to: TravelPose) -> PoseHistory {
        PoseHistory { before: Some(self.now), now: to }
    }
}

impl<'a> DrivenMechanism<'a> {
    /// Prepares a mechanism in its pose of the instant.
    pub fn new(placed: &'a PlacedScene<'a>, driver: usize) -> DrivenMechanism<'a> {
        let now = position_now(placed.scene, &placed.at, driver);
        let train = AngleTrain::of(placed.scene, placed.mechanism, &placed.at);
        let wheels = (train.fastest(), train.turns());
        DrivenMechanism {
            placed,
            driver,
            now,
            wheels,
            drivers: newton::driver_values(placed.scene, &placed.at),
        }
    }

    /// Prepares its course through `count` values.
    pub fn course(
        placed: &'a PlacedScene<'a>,
        driver: usize,
        count: usize,
        values: ValueFunction,
    ) -> Chains<DrivenMechanism<'a>> {
        let moved = DrivenMechanism::new(placed, driver);
        let now = moved.now;
        Chains::new(moved, now, count, values)
    }

    /// The drivers' values when this driver has a value.
    fn holding(&self, value: f64) -> DriverValues {
        let mut drivers = self.drivers.clone();
        drivers.0[self.driver] += value - self.now;
        let here = self.placed.scene;
        if here.has_laws(self.driver) {
            let there = with_driver_at(here, self.driver, value);
            for led in (0..here.drivers.len()).filter(|d| here.is_led(*d)) {
                let gone = driver_position(&there, led).zip(driver_position(here, led));
                drivers.0[led] += gone.map_or(0.0, |(there, here)| there - here);
            }
        }
        drivers
    }

    fn is_turning(&self) -> bool {
        self.placed.scene.drivers[self.driver].kind.turns()
    }

    /// True if the mechanism may have another pose after a turn of the driver, as with gears.
    pub fn counts_turns(&self) -> bool {
        self.is_turning() && !self.placed.scene.rolling.is_empty()
    }

    /// Returns the limit next to a pose, as exactly as the equations give it, and the toggle there.
    /// `None` if no limit is near by.
    pub fn limit(&self, value: f64, near: &Configuration) -> Option<Event> {
        let p = self.placed;
        let (there, at) = fold(p.scene, p.mechanism, near, &self.holding(value), self.driver)?;
        Some(event(p.mechanism, self.now + (there - self.drivers.0[self.driver]), &at))
    }

    /// Returns the configuration at a value, which may be many turns away; for callers that need
    /// single positions.
    pub fn standing(&self, value: f64) -> Result<Configuration, Faults> {
        let mut way = value - self.now;
        if self.wheels.1 > 0 {
            let period = TAU * self.wheels.1 as f64;
            way -= period * libm::trunc(way / period);
        }
        let ends = &self.placed.ends;
        if let Some(why) = ends.of(self.driver, way) {
            return Err(why);
        }
        let first = PoseHistory::first(self.now, &self.placed.at);
        self.advance(&first, self.now + way).map(|s| s.now.configuration).map_err(|last| {
            let why = self.stopped(Some(&last), value);
            ends.note(self.driver, last.now.travel - self.now, way < 0.0, &why);
            why
        })
    }

    /// Returns the limit at which a state is the last on its way.
    pub fn end(&self, last: &PoseHistory) -> Option<Event> {
        self.limit(last.now.travel, &last.now.configuration)
    }
}

/// The event that stops a mechanism in the pose of a limit.
pub(crate) fn event(m: &Mechanism, value: f64, at: &Configuration) -> Event {
    // A group without a closed form, or a group on three legs with a rolling one, holds the driver,
    // unless legs are known to hold one another.
    let followed = || m.groups.iter().find(|g| g.core == Core::Higher || g.class() == Some("III"));
    // If no joint is found to lock, the last group that the driver moves is named, so that the
    // message always names one.
    let last = || m.groups.iter().rev().find(|g| g.class().is_some());
    let toggle = Toggle::at(m, at)
        .or_else(|| followed().or_else(last).map(|g| Toggle::Open(g.links.clone())));
    let links = toggle.as_ref().map_or_else(Vec::new, Toggle::links);
    Event { value, kind: EventKind::Limit, links, pin: None, joint: None, toggle }
}

impl Follow for DrivenMechanism<'_> {
    type State = PoseHistory;

    fn start(&self) -> Option<PoseHistory> {
        Some(PoseHistory::first(self.now, &self.placed.at))
    }

    /// Advances in steps that each converge near by.
    fn advance(&self, from: &PoseHistory, to: f64) -> Result<PoseHistory, PoseHistory> {
        let p = self.placed;
        let part = if self.is_turning() {
            PART_OF_A_TURN / self.wheels.0
        } else {
            PART_OF_A_TURN * p.at.extent()
        };
        // The number of steps starts anew for every part of the way, so that no end is out of reach
        // because it is far.
        let (mut state, mut left) = (from.clone(), MOST_STEPS);
        let mut gone = 0.0;
        let most = if self.counts_turns() { PART_OF_A_TURN / self.wheels.0 } else { f64::INFINITY };
        let mut step = to - from.now.travel;
        let extent = p.at.extent();
        while left > 0 {
            let reached = libm::floor(((state.now.travel - from.now.travel) / part).abs());
            if reached > gone {
                (gone, left) = (reached, MOST_STEPS);
            }
            left -= 1;
            step = step.max(-most).min(most);
            let value = state.now.travel;
            if value == to {
                return Ok(state);
            }
            let next = if (to - value).abs() <= step.abs() { to } else { value + step };
            let guess = state.ahead(next);
            let at = |guess: &Configuration, value: f64| {
                newton::moved(p.scene, p.mechanism, guess, &self.holding(value))
            };
            let from = &state.now.configuration;
            let half_way = |mean: &Configuration| at(mean, 0.5 * (value + next));
            match at(&guess, next).filter(|c| is_followed([from, &guess, c], extent, half_way)) {
                Some(configuration) => {
                    (state, step) =
                        (state.on(TravelPose { travel: next, configuration }), step * 1.5)
                }
                None => step = 0.5 * (next - value),
            }
        }
        if state.now.travel == to { Ok(state) } else { Err(state) }
    }

    fn stopped(&self, last: Option<&PoseHistory>, toward: f64) -> Faults {
        let words = |value| general::driver_words(self.placed.scene, self.driver, value);
        let message = match last.map(|last| (last, self.end(last))) {
            Some((_, Some(limit))) => {
                both!("the mechanism cannot be assembled beyond {}", words(limit.value))
            }
            Some((last, None)) => {
                both!("the mechanism cannot be followed beyond {}", words(last.now.travel))
            }
            None => both!("the mechanism cannot be followed to {}", words(toward)),
        };
        Diagnostic::error("limit", message).into()
    }

    fn turns(&self) -> bool {
        self.is_turning() && (!self.counts_turns() || self.wheels.1 == 1)
    }
}

/// Some rows of a course. `row` gives the row of the stations for a position of the course. Returns
/// `None` if `stop` asks to stop.
pub(crate) fn rows(
    course: &mut Chains<DrivenMechanism>,
    general: &General,
    part: Range<usize>,
    stations: &Stations,
    values: ValueFunction,
    row: &dyn Fn(usize) -> usize,
    stop: &dyn Fn() -> bool,
) -> Option<SweepRows> {
    let scene = general.scene();
    let n = stations.len();
    let mut columns: Vec<Vec<f64>> =
        scene.find.iter().flat_map(ask::names).map(|_| vec![f64::NAN; n]).collect();
    let mut missing = BTreeMap::new();
    let done = course.states(part, values, stop, &mut |position, state| {
        let i = row(position);
        let there = |state: &PoseHistory| general.ways(stations, i, Some(&state.now.configuration));
        match state.map_err(Clone::clone).and_then(there) {
            Ok(ways) => columns.iter_mut().zip(&ways[0]).for_each(|(c, v)| c[i] = *v),
            Err(why) => drop(missing.insert(i, why)),
        }
    });
    done.then_some(SweepRows { columns, missing, open: Vec::new() })
}

/// One note for each limit that a course meets.
pub(crate) fn ends(course: &Chains<DrivenMechanism>) -> Vec<Diagnostic> {
    let moved = course.follow();
    let limits = course.ended().filter_map(|last| moved.end(last));
    limits.map(|e| general::limit_note(moved.placed.scene, moved.driver, &e)).collect()
}

/// All rows of stations in any order, and one note for each limit on the way to them.
pub(crate) fn follow(
    placed: &PlacedScene,
    driver: usize,
    stations: &Stations,
) -> (SweepRows, Vec<Diagnostic>) {
    let order = stations.ascending();
    let values = |position: usize| stations.values[order[position]];
    let mut course = DrivenMechanism::course(placed, driver, order.len(), &values);
    let general = General::new(placed, driver);
    let all = 0..order.len();
    let rows =
        rows(&mut course, &general, all, stations, &values, &|position| order[position], &|| false);
    (rows.unwrap_or_default(), ends(&course))
}
