//! The followed links of a program through the positions of a driver.

use super::chains::{Chains, Follow, ValueFunction};
use super::triad::FollowedState;
use crate::PlacedScene;
use crate::general::driver_words;
use crate::program::SweepProgram;
use crate::station::{Stations, angle_per_value, position_now};
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use std::ops::Range;

/// A program with followed links.
pub(crate) struct Compiled<'a> {
    program: SweepProgram,
    placed: &'a PlacedScene<'a>,
    driver: usize,
    per_value: f64,
}

/// The followed links at each station, or the reason why they have no position there.
pub(crate) type States = Vec<Result<FollowedState, Faults>>;

impl<'a> Compiled<'a> {
    /// Prepares the course of a program's links through `count` values.
    pub fn course(
        program: SweepProgram,
        placed: &'a PlacedScene<'a>,
        driver: usize,
        count: usize,
        values: ValueFunction,
    ) -> Chains<Compiled<'a>> {
        let tracked = Compiled {
            program,
            placed,
            driver,
            per_value: angle_per_value(placed.scene, &placed.at, driver),
        };
        Chains::new(tracked, position_now(placed.scene, &placed.at, driver), count, values)
    }

    /// The program.
    pub fn program(&self) -> &SweepProgram {
        &self.program
    }

    fn turn(&self, x: f64) -> (f64, f64, f64) {
        (libm::cos(x * self.per_value), libm::sin(x * self.per_value), self.per_value)
    }
}

impl Follow for Compiled<'_> {
    type State = FollowedState;

    fn start(&self) -> Option<FollowedState> {
        self.program
            .start(position_now(self.placed.scene, &self.placed.at, self.driver), &|x| self.turn(x))
    }

    fn advance(&self, from: &FollowedState, value: f64) -> Result<FollowedState, FollowedState> {
        self.program.advance(from, value, &|x| self.turn(x))
    }

    fn stopped(&self, last: Option<&FollowedState>, _toward: f64) -> Faults {
        let scene = self.placed.scene;
        let names: Vec<_> = self.program.tracks.iter().map(|t| scene.link_name(t.link)).collect();
        let until = last.map_or(Both::default(), |last| {
            both!(" beyond {}", driver_words(scene, self.driver, last.value))
        });
        Diagnostic::error(
            "limit",
            both!("the group of link {} cannot be assembled{}", Both::names(&names), until),
        )
        .into()
    }

    fn turns(&self) -> bool {
        self.program.angular && self.program.turns == 1
    }
}

/// The states of some positions of a course; `row` gives the row of each. `None` if `stop` asks to
/// stop.
pub(crate) fn states(
    course: &mut Chains<Compiled>,
    part: Range<usize>,
    values: ValueFunction,
    row: &dyn Fn(usize) -> usize,
    stop: &dyn Fn() -> bool,
) -> Option<States> {
    let mut states: States = vec![Err(Faults::default()); part.len()];
    let show = &mut |position, state: Result<&FollowedState, &Faults>| {
        states[row(position)] = state.cloned().map_err(Clone::clone)
    };
    course.states(part, values, stop, show).then_some(states)
}

/// The states at stations in any order.
pub(crate) fn follow(
    program: &SweepProgram,
    placed: &PlacedScene,
    driver: usize,
    stations: &Stations,
) -> States {
    let order = stations.ascending();
    let values = |position: usize| stations.values[order[position]];
    let mut course = Compiled::course(program.clone(), placed, driver, order.len(), &values);
    states(&mut course, 0..order.len(), &values, &|position| order[position], &|| false)
        .unwrap_or_default()
}
