//! Positions one by one, by the general solvers: where a program has no value, and for mechanisms that have no program.

use super::Placed;
use super::chunks::Rows;
use super::compile::ask;
use super::limit::Event;
use super::program::Program;
use super::station::{Stations, angle_per_value, position_now};
use super::track::State;
use crate::accuracy::toggle::with_driver_at;
use crate::analytic::{self, Solution};
use crate::answer::{Value, evaluate};
use crate::diag::{Diagnostic, Faults};
use crate::position::{self, Configuration, newton};
use crate::quantity::{metres, significant};
use crate::scene::{DriverKind, Lang, LinkId, Scene};
use std::collections::BTreeMap;
use std::ops::Range;

/// The general way to single rows of a sweep.
pub(super) struct General<'a> {
    placed: &'a Placed<'a>,
    driver: usize,
}

impl<'a> General<'a> {
    pub fn new(placed: &'a Placed<'a>, driver: usize) -> General<'a> {
        General { placed, driver }
    }

    /// One row by the position solver, with the closures of the instant, and the loop equations; at a change point one for
    /// each way on.
    pub fn solve(&self, stations: &Stations, row: usize) -> Result<Vec<Vec<f64>>, Faults> {
        let p = self.placed;
        let scene = with_driver_at(p.scene, self.driver, stations.values[row]);
        let at = position::recompute::<f64>(&scene, p.mechanism, &p.demand, &p.at)?;
        self.answers(&scene, &at)
    }

    fn answers(&self, scene: &Scene, at: &Configuration) -> Result<Vec<Vec<f64>>, Faults> {
        let p = self.placed;
        let solution = analytic::solve(scene, p.mechanism, at, &p.demand)?;
        let others = solution.singular.iter().filter_map(|s| s.other.as_deref());
        std::iter::once(&solution).chain(others).map(|s| self.row(scene, at, s)).collect()
    }

    fn row(&self, scene: &Scene, at: &Configuration, solution: &Solution) -> Result<Vec<f64>, Faults> {
        let mut row = Vec::new();
        for f in &scene.find {
            let value = evaluate(scene, at, solution, &f.what)
                .ok_or_else(|| Diagnostic::error("cannot-answer", format!("{} cannot be answered here", f.text)).at(f.span))?;
            match value {
                Value::Scalar(s) => row.push(s),
                Value::Vector(v) => row.extend([v.x, v.y, v.norm()]),
            }
        }
        match row.iter().all(|v| v.is_finite()) {
            true => Ok(row),
            false => Err(Diagnostic::error("overflow", "a number is out of range").into()),
        }
    }

    /// All rows by Newton's method on the whole mechanism, each from the one before it.
    pub fn follow(&self, stations: &Stations) -> Rows {
        let p = self.placed;
        let n = stations.len();
        let mut columns: Vec<Vec<f64>> = p.scene.find.iter().flat_map(ask::names).map(|_| vec![f64::NAN; n]).collect();
        let mut missing = BTreeMap::new();
        let start = position_now(p.scene, &p.at, self.driver);
        for order in outward(start, &stations.values) {
            let mut last = p.at.clone();
            let mut value = start;
            let mut stopped: Option<Faults> = None;
            for i in order {
                if stopped.is_none() {
                    match self.move_to(&last, value, stations.values[i]) {
                        Some(at) => (last, value) = (at, stations.values[i]),
                        None => stopped = Some(self.end_of_the_way()),
                    }
                }
                let scene = with_driver_at(p.scene, self.driver, stations.values[i]);
                match stopped.clone().map_or_else(|| self.answers(&scene, &last), Err) {
                    Ok(ways) => columns.iter_mut().zip(&ways[0]).for_each(|(c, v)| c[i] = *v),
                    Err(why) => drop(missing.insert(i, why)),
                }
            }
        }
        Rows { columns, missing, open: Vec::new() }
    }

    /// Moves the mechanism to another driver value in steps that each converge near by.
    fn move_to(&self, from: &Configuration, value: f64, to: f64) -> Option<Configuration> {
        let p = self.placed;
        let mut at = from.clone();
        let (mut value, mut step) = (value, to - value);
        let extent = p.at.extent();
        let offset = newton::driver_values(p.scene, from).0[self.driver] - value;
        for _ in 0..MOST_STEPS {
            let next = if (to - value).abs() <= step.abs() { to } else { value + step };
            let mut drivers = newton::driver_values(p.scene, &at);
            drivers.0[self.driver] = next + offset;
            let near = |c: &Configuration| {
                let moved = c.points.iter().zip(&at.points).filter_map(|(a, b)| Some(a.as_ref()?.distance((*b)?)));
                moved.fold(0.0, f64::max) < NEAR * extent
            };
            match newton::moved(p.scene, p.mechanism, &at, &drivers).filter(near) {
                Some(moved) => {
                    (at, value, step) = (moved, next, step * 1.5);
                    if value == to {
                        return Some(at);
                    }
                }
                None => step = 0.5 * (next - value),
            }
        }
        None
    }

    fn end_of_the_way(&self) -> Faults {
        let (name, _) = driver_name(self.placed.scene, self.driver);
        Diagnostic::error("limit", format!("the mechanism cannot be followed so far with {name}")).into()
    }
}

/// In one step of the whole mechanism no joint moves farther than this part of its size: a longer step may end on another
/// assembly.
const NEAR: f64 = 0.05;

/// Steps between two stations before the way counts as blocked.
const MOST_STEPS: usize = 200;

/// The rows from a start value outward: upward in order of their values, then downward.
pub(super) fn outward(start: f64, values: &[f64]) -> [Vec<usize>; 2] {
    let mut up: Vec<usize> = (0..values.len()).filter(|&i| values[i] >= start).collect();
    let mut down: Vec<usize> = (0..values.len()).filter(|&i| values[i] < start).collect();
    up.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    down.sort_by(|&a, &b| values[b].total_cmp(&values[a]));
    [up, down]
}

/// The followed links of a program at each station, from the instant outward; why not, where the way is blocked.
pub(super) fn follow_tracks(program: &Program, placed: &Placed, driver: usize, stations: &Stations) -> Vec<Result<State, Faults>> {
    let start = position_now(placed.scene, &placed.at, driver);
    let per_value = angle_per_value(placed.scene, &placed.at, driver);
    let turn = |x: f64| (libm::cos(x * per_value), libm::sin(x * per_value), per_value);
    let blocked = |value: Option<f64>| -> Faults {
        let names: Vec<_> = program.tracks.iter().map(|t| placed.scene.link_name(t.link)).collect();
        let until = value.map_or(String::new(), |v| format!(" beyond {}", driver_words(placed.scene, driver, v)));
        Diagnostic::error("limit", format!("the group of link {} cannot be assembled{until}", names.join(", "))).into()
    };
    let mut out: Vec<Result<State, Faults>> = vec![Err(blocked(None)); stations.len()];
    let Some(first) = program.start(start, &turn) else { return out };
    let mut open: Vec<usize> = Vec::new();
    for order in outward(start, &stations.values) {
        open.extend(pursue(program, &first, order.into_iter().map(|i| (i, stations.values[i])), &turn, &blocked, &mut out));
    }
    // A crank that is stopped on one way round may come there on the other.
    if program.angular && !open.is_empty() {
        let around: Vec<(usize, f64)> = open
            .iter()
            .map(|&i| (i, stations.values[i]))
            .map(|(i, v)| (i, if v > start { v - std::f64::consts::TAU } else { v + std::f64::consts::TAU }))
            .collect();
        let values: Vec<f64> = around.iter().map(|a| a.1).collect();
        for order in outward(start, &values) {
            pursue(program, &first, order.into_iter().map(|k| around[k]), &turn, &blocked, &mut out);
        }
    }
    out
}

/// Follows the links through stations in order; returns those that were not reached.
fn pursue(
    program: &Program,
    first: &State,
    order: impl Iterator<Item = (usize, f64)>,
    turn: &dyn Fn(f64) -> (f64, f64, f64),
    blocked: &dyn Fn(Option<f64>) -> Faults,
    out: &mut [Result<State, Faults>],
) -> Vec<usize> {
    let mut state = first.clone();
    let mut end: Option<Faults> = None;
    let mut open = Vec::new();
    for (i, value) in order {
        if end.is_none() {
            match program.advance(&state, value, turn) {
                Ok(reached) => {
                    out[i] = Ok(reached.clone());
                    state = reached;
                    continue;
                }
                Err(last) => end = Some(blocked(Some(last.value))),
            }
        }
        if let Some(end) = &end {
            out[i] = Err(end.clone());
            open.push(i);
        }
    }
    open
}

/// Name and unit of a driver's column.
pub fn driver_name(scene: &Scene, driver: usize) -> (String, &'static str) {
    let point = |p: crate::scene::PointId| scene.point_name(p);
    match &scene.drivers[driver].kind {
        DriverKind::Turn { link, against, .. } if *against == scene.ground => (format!("phi_{}", scene.link_name(*link)), "rad"),
        DriverKind::Turn { link, against, .. } => (format!("phi_{}/{}", scene.link_name(*link), scene.link_name(*against)), "rad"),
        DriverKind::Slide { guide, .. } => {
            let g = &scene.guides[guide.0];
            (format!("s_{}", g.pin.map_or_else(|| g.slider.map_or("", |s| scene.link_name(s)), point)), "m")
        }
        DriverKind::Cylinder { a, b, .. } => (format!("l_{}{}", point(*a), point(*b)), "m"),
    }
}

/// A driver's value for people: `phi_1 = 92.5°`.
pub(super) fn driver_words(scene: &Scene, driver: usize, value: f64) -> String {
    let (name, unit) = driver_name(scene, driver);
    match unit {
        "rad" => format!("{name} = {}°", significant(value.to_degrees(), 6)),
        _ => format!("{name} = {}", metres(value)),
    }
}

/// The links of an event for a sentence: `links 2, 3`.
pub(super) fn links_words(scene: &Scene, links: &[LinkId]) -> String {
    let names: Vec<_> = links.iter().map(|l| scene.link_name(*l)).collect();
    match names[..] {
        [one] => format!("link {one}"),
        _ => format!("links {}", names.join(", ")),
    }
}

/// What a change point is told as.
pub(super) fn change_note(scene: &Scene, driver: usize, change: &Event) -> Diagnostic {
    let (links, at) = (links_words(scene, &change.links), driver_words(scene, driver, change.value));
    Diagnostic::note(
        "change-point",
        format!("at {at} {links} lie in line (a change point); the motion is carried on smoothly to the other side"),
    )
}

/// What a limit of the driver is told as.
pub(super) fn limit_note(scene: &Scene, driver: usize, limit: &Event) -> Diagnostic {
    let at = driver_words(scene, driver, limit.value);
    let what = limit.toggle.as_ref().map_or_else(
        || {
            let pin = limit.pin.map_or(String::new(), |p| format!(" at {}", scene.point_name(p)));
            format!("{} come into line{pin}", links_words(scene, &limit.links))
        },
        |t| t.words(scene, Lang::En),
    );
    Diagnostic::note("limit", format!("the driver goes no farther than {at}: there {what}"))
}

/// A run of missing rows, and why the first of them is missing.
pub(super) struct Gap {
    pub rows: Range<usize>,
    pub why: String,
}

/// The runs of missing rows, the first row of all being the `first` of the sweep.
pub(super) fn runs(missing: &BTreeMap<usize, Faults>, first: usize) -> Vec<Gap> {
    let mut gaps: Vec<Gap> = Vec::new();
    for (i, why) in missing {
        let row = first + i;
        match gaps.last_mut().filter(|g| g.rows.end == row) {
            Some(gap) => gap.rows.end = row + 1,
            None => gaps.push(Gap { rows: row..row + 1, why: why.list.first().map_or(String::new(), |d| d.message.clone()) }),
        }
    }
    gaps
}

/// One note for each run of missing rows; `words` names a row by its swept value.
pub(super) fn gap_notes(words: &dyn Fn(usize) -> String, gaps: &[Gap]) -> Vec<Diagnostic> {
    let note = |Gap { rows, why }: &Gap| {
        let (count, range) = match rows.len() {
            1 => ("1 row is".to_owned(), format!("at {}", words(rows.start))),
            n => (format!("{n} rows are"), format!("from {} to {}", words(rows.start), words(rows.end - 1))),
        };
        Diagnostic::warning("no-position", format!("{count} missing {range}: {why}"))
    };
    gaps.iter().map(note).collect()
}

/// [`gap_notes`] of the rows of a whole sweep.
pub(super) fn gaps(words: &dyn Fn(usize) -> String, missing: &BTreeMap<usize, Faults>) -> Vec<Diagnostic> {
    gap_notes(words, &runs(missing, 0))
}
