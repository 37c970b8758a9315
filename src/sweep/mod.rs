//! A whole motion at once: the scene compiled into a straight list of operations and run over all positions of a driver.
//!
//! [`run()`] is the way in: a placed scene, the driver and its stations to a [`Table`]. [`compile()`] makes the [`program::Program`], one
//! operation for each group and effect ([`closure`], [`carry`], [`rows`], [`reading`] are the kernels). [`fuse`] makes one operation of
//! those that belong together, and [`run`](mod@run) runs them over chunks of positions, four side by side where the machine can
//! ([`lane`]); class III groups are followed ([`track`]), and mechanisms that have no program as a whole ([`moved`]), both on a [`course`]. Positions at
//! which the formulas have no value (a dead centre, a change point) are handed to the general solver one by one; those that
//! cannot be assembled are left out, with the reason in the notes.
//! [`long`] sweeps, and those of parameters ([`vary`]), go piece by piece ([`pieces`]). [`follow`] gives whole configurations instead of columns, for drawings; [`zoom`] finds extremes between stations.
//!
//! Not decided here: what a question means ([`crate::answer`]) and how a single position is solved for drawing
//! ([`crate::position`], [`crate::analytic`]); both are the check of this room.

pub mod batch;
pub mod carry;
pub mod closure;
pub mod compile;
mod course;
pub mod extreme;
pub mod follow;
pub mod fuse;
mod general;
pub mod kernel;
pub mod lane;
pub mod limit;
pub mod long;
mod moved;
pub mod pieces;
pub mod points;
pub mod program;
pub mod reading;
pub mod rows;
pub mod run;
pub mod station;
pub mod table;
pub mod track;
mod tracked;
pub mod vary;
mod walked;
pub mod zoom;

pub use compile::compile;
pub use lane::Width;
pub use station::{Stations, Steps};
pub use table::{Column, Table};

use crate::diag::{Diagnostic, Faults};
use crate::mechanism::{Demand, Mechanism};
use crate::position::{self, Configuration};
use crate::scene::Scene;
use general::General;
pub use general::driver_name;
use kernel::Reg;
use limit::{Event, Probe};
use program::{COS, Program, SIN, VALUE};
use rayon::prelude::*;
use run::{Buffer, CHUNK};

/// A scene placed at its instant, ready to be swept.
pub struct Placed<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Its topology.
    pub mechanism: &'a Mechanism,
    /// What is called for.
    pub demand: Demand,
    /// Where everything is at the instant.
    pub at: Configuration,
}

impl<'a> Placed<'a> {
    /// Places a scene for its own questions.
    ///
    /// # Errors
    /// Those of [`position::configure`].
    pub fn new(scene: &'a Scene, mechanism: &'a Mechanism) -> Result<Placed<'a>, Faults> {
        let demand = Demand::of(scene, mechanism);
        let at = position::configure(scene, mechanism, &demand)?.value;
        Ok(Placed { scene, mechanism, demand, at })
    }
}

/// The answers to the scene's questions at all stations of a driver.
///
/// A row for each station that can be assembled, in the order of the stations; see [`Table`]. The result does not depend on
/// the number of threads, on the width or on how the stations are cut into chunks.
///
/// # Errors
/// A driver that the scene does not have.
pub fn run(placed: &Placed, driver: usize, stations: &Stations, width: Width) -> Result<Table, Faults> {
    let scene = placed.scene;
    if driver >= scene.drivers.len() {
        return Err(Diagnostic::error("no-driver", format!("the scene has no driver {}", driver + 1)).into());
    }
    let mut notes = Vec::new();
    let general = General::new(placed, driver);
    let rows = match compile(scene, placed.mechanism, &placed.at, Some(driver), &scene.find) {
        Ok(program) => {
            let (parts, changes) = branches(program.clone(), placed, driver, stations);
            notes.extend(changes);
            let mut rows = run_parts(&parts, placed, driver, stations, width);
            rows.complete(&general, stations, &|row| beside(&program, placed, driver, stations.values[row]));
            rows.explain(&general, stations);
            if rows.missing.iter().any(Option::is_some) {
                notes.extend(ends(&program, placed, driver, stations));
            }
            rows
        }
        Err(note) => {
            notes.push(note);
            let (rows, limits) = moved::follow(placed, driver, stations);
            notes.extend(limits);
            rows
        }
    };
    Ok(rows.into_table(placed, driver, stations, notes))
}

/// The rows of a sweep under way: numbers of all columns, and which rows are there.
#[derive(Default)]
pub(crate) struct Rows {
    /// Name and unit of each column.
    pub names: Vec<(String, &'static str)>,
    /// The numbers, a column after the other.
    pub columns: Vec<Vec<f64>>,
    /// Why a row is missing, if it is.
    pub missing: Vec<Option<Faults>>,
}

impl Rows {
    /// Hands the rows whose numbers are not all finite to the general solver; where it finds several ways on, the one that goes
    /// with what is `near` is meant.
    fn complete(&mut self, general: &General, stations: &Stations, near: &(dyn Fn(usize) -> Option<Vec<f64>> + Sync)) {
        let open: Vec<usize> =
            (0..stations.len()).filter(|&i| self.missing[i].is_none() && self.columns.iter().any(|c| !c[i].is_finite())).collect();
        let solved: Vec<_> = open.par_iter().map(|&i| general.solve(stations, i).map(|ways| pick_way(ways, || near(i)))).collect();
        for (i, row) in open.into_iter().zip(solved) {
            match row {
                Ok(row) => self.columns.iter_mut().zip(row).for_each(|(c, v)| c[i] = v),
                Err(why) => self.missing[i] = Some(why),
            }
        }
    }

    /// Asks the general solver why the first of each run of missing rows is missing, where nobody has said it yet.
    fn explain(&mut self, general: &General, stations: &Stations) {
        for i in 0..stations.len() {
            let silent = self.missing[i].as_ref().is_some_and(|why| why.list.is_empty());
            if silent && (i == 0 || self.missing[i - 1].is_none()) {
                self.missing[i] = Some(general.solve(stations, i).err().unwrap_or_default());
            }
        }
    }

    /// The numbers of the rows that are there, the driver's values first.
    fn there(self, stations: &Stations) -> Vec<Vec<f64>> {
        let there: Vec<usize> = (0..stations.len()).filter(|&i| self.missing[i].is_none()).collect();
        // A long table is not copied for nothing.
        let whole = there.len() == stations.len();
        let pick = |values: Vec<f64>| if whole { values } else { there.iter().map(|&i| values[i]).collect() };
        std::iter::once(stations.values.clone()).chain(self.columns).map(pick).collect()
    }

    fn into_table(self, placed: &Placed, driver: usize, stations: &Stations, mut notes: Vec<Diagnostic>) -> Table {
        let words = |k: usize| general::driver_words(placed.scene, driver, stations.values[k]);
        notes.extend(general::gaps(&words, &self.missing));
        let heads: Vec<_> = std::iter::once(general::driver_name(placed.scene, driver)).chain(self.names.iter().cloned()).collect();
        let columns = heads.into_iter().zip(self.there(stations)).map(|((name, unit), values)| Column { name, unit, values });
        Table { columns: columns.collect(), notes }
    }
}

/// The way on that is nearest to a row; the first where there is but one, or nothing to compare with.
fn pick_way(mut ways: Vec<Vec<f64>>, near: impl Fn() -> Option<Vec<f64>>) -> Vec<f64> {
    if ways.len() > 1
        && let Some(near) = near()
    {
        let off = |row: &Vec<f64>| row.iter().zip(&near).map(|(a, b)| (a - b).abs() / (a.abs() + b.abs() + f64::MIN_POSITIVE)).sum::<f64>();
        ways.sort_by(|a, b| off(a).total_cmp(&off(b)));
    }
    ways.swap_remove(0)
}

/// The numbers next to a station: the mean of a thousandth of the reach to either side, each on its own side of a change point.
fn beside(program: &Program, placed: &Placed, driver: usize, x: f64) -> Option<Vec<f64>> {
    let off = 1e-3 * Probe::of(program.clone(), placed, driver).reach();
    let sides = Stations::of_values(vec![x - off, x + off], station::angle_per_value(placed.scene, &placed.at, driver));
    let (parts, _) = branches(program.clone(), placed, driver, &sides);
    let rows = run_parts(&parts, placed, driver, &sides, Width::One);
    let mean: Vec<f64> = rows.columns.iter().map(|c| 0.5 * (c[0] + c[1])).collect();
    mean.iter().all(|v| v.is_finite()).then_some(mean)
}

/// Lowest and highest of the stations and of where the driver stands.
fn span(placed: &Placed, driver: usize, stations: &Stations) -> (f64, [f64; 2]) {
    let now = station::position_now(placed.scene, &placed.at, driver);
    let low = stations.values.iter().copied().fold(now, f64::min);
    let high = stations.values.iter().copied().fold(now, f64::max);
    (now, [low, high])
}

/// A note for each limit of the driver within the span of the stations.
fn ends(program: &Program, placed: &Placed, driver: usize, stations: &Stations) -> Vec<Diagnostic> {
    let (now, span) = span(placed, driver, stations);
    let end = |until: f64| (until != now).then(|| Probe::of(program.clone(), placed, driver).walk(until).0).flatten();
    span.into_iter().filter_map(end).map(|e| general::limit_note(placed.scene, driver, &e)).collect()
}

/// The program of each stretch between change points, with its stations; and a note for each change point.
fn branches(program: Program, placed: &Placed, driver: usize, stations: &Stations) -> (Vec<(Program, Vec<usize>)>, Vec<Diagnostic>) {
    let (now, span) = span(placed, driver, stations);
    let changes = change_points(&program, placed, driver, now, span);
    let notes = changes.iter().flatten().map(|c| general::change_note(placed.scene, driver, c)).collect();
    (stretches(program, now, &changes, stations), notes)
}

/// The change points of the driver's way from where it stands downward, and those upward.
fn change_points(program: &Program, placed: &Placed, driver: usize, now: f64, span: [f64; 2]) -> [Vec<Event>; 2] {
    let mut changes = [Vec::new(), Vec::new()];
    if program.tracks.is_empty() && !program.joints.is_empty() {
        // Both ways are searched by one program.
        program.fused_margins();
        for (changes, until) in changes.iter_mut().zip(span).filter(|(_, until)| *until != now) {
            *changes = Probe::of(program.clone(), placed, driver).walk(until).1;
        }
    }
    changes
}

/// The program of each stretch between change points, with its stations.
fn stretches(program: Program, now: f64, changes: &[Vec<Event>; 2], stations: &Stations) -> Vec<(Program, Vec<usize>)> {
    let all: Vec<usize> = (0..stations.len()).collect();
    if changes.iter().all(Vec::is_empty) {
        return vec![(program, all)];
    }
    // How many change points lie between the instant and a station, downward or upward.
    let passed = |value: f64| {
        let [down, up] = changes;
        if value < now { (0, down.iter().filter(|c| c.value > value).count()) } else { (1, up.iter().filter(|c| c.value < value).count()) }
    };
    let mut parts: Vec<(Program, Vec<usize>)> = Vec::new();
    for (way, changes) in changes.iter().enumerate() {
        let mut program = program.clone();
        for k in 0..=changes.len() {
            let rows: Vec<usize> = all.iter().copied().filter(|&i| passed(stations.values[i]) == (way, k)).collect();
            parts.push((program.clone(), rows));
            if let Some(joint) = changes.get(k).and_then(|c| c.joint) {
                program.flip(joint);
            }
        }
    }
    parts.retain(|(_, rows)| !rows.is_empty());
    parts
}

fn run_parts(parts: &[(Program, Vec<usize>)], placed: &Placed, driver: usize, stations: &Stations, width: Width) -> Rows {
    if let [(program, _)] = parts {
        return run_program(program, placed, driver, stations, width);
    }
    let mut whole: Option<Rows> = None;
    for (program, rows) in parts {
        let part = run_program(program, placed, driver, &stations.pick(rows), width);
        let n = stations.len();
        let whole = whole.get_or_insert_with(|| Rows {
            names: part.names.clone(),
            columns: vec![vec![f64::NAN; n]; part.columns.len()],
            missing: vec![None; n],
        });
        for (k, &i) in rows.iter().enumerate() {
            whole.columns.iter_mut().zip(&part.columns).for_each(|(c, p)| c[i] = p[k]);
            whole.missing[i].clone_from(&part.missing[k]);
        }
    }
    whole.unwrap_or(Rows { names: Vec::new(), columns: Vec::new(), missing: Vec::new() })
}

/// Below this many rows a sweep is not worth other threads.
const ALONE: usize = 16 * CHUNK;

fn run_program(program: &Program, placed: &Placed, driver: usize, stations: &Stations, width: Width) -> Rows {
    let states = (!program.tracks.is_empty()).then(|| tracked::follow(program, placed, driver, stations));
    run_with(program, states, stations, width)
}

/// Runs a program whose followed links, if it has any, are where `states` says.
fn run_with(program: &Program, states: Option<tracked::States>, stations: &Stations, width: Width) -> Rows {
    let n = stations.len();
    let names = program.columns.iter().map(|c| (c.name.clone(), c.unit)).collect();
    let mut columns: Vec<Vec<f64>> = program.columns.iter().map(|_| vec![0.0; n]).collect();
    let mut missing: Vec<Option<Faults>> = vec![None; n];
    for (gap, state) in missing.iter_mut().zip(states.iter().flatten()) {
        if let Err(why) = state {
            *gap = Some(why.clone());
        }
    }
    let fused = program.fused();
    let together = fused.positions();
    // Where each column is found, and the part of it that each chunk fills.
    let found: Vec<Option<Reg>> = program.columns.iter().map(|c| fused.place(c.reg)).collect();
    let mut parts: Vec<Vec<&mut [f64]>> = (0..n.div_ceil(together)).map(|_| Vec::with_capacity(columns.len())).collect();
    for column in &mut columns {
        parts.iter_mut().zip(column.chunks_mut(together)).for_each(|(part, c)| part.push(c));
    }
    let one_chunk = |buffer: &mut Buffer, (chunk, part): (usize, &mut Vec<&mut [f64]>)| -> Vec<usize> {
        let rows = chunk * together..n.min((chunk + 1) * together);
        buffer.fill(VALUE, &stations.values[rows.clone()]);
        buffer.fill(COS, &stations.cosines[rows.clone()]);
        buffer.fill(SIN, &stations.sines[rows.clone()]);
        if let Some(states) = &states {
            for (i, state) in states[rows.clone()].iter().enumerate() {
                if let Ok(state) = state {
                    program.show(state, fused, buffer, i);
                }
            }
        }
        fused.run(buffer, width);
        let mut lost = [false; CHUNK];
        for (numbers, reg) in part.iter_mut().zip(&found) {
            if let Some(reg) = reg {
                numbers.copy_from_slice(buffer.numbers(*reg, rows.len()));
            }
            lost.iter_mut().zip(numbers.iter()).for_each(|(lost, v)| *lost |= !v.is_finite());
        }
        // What misses by more than rounding needs nobody's second opinion.
        (0..rows.len()).filter(|&row| lost[row] && fused.misses(program, buffer, row)).collect()
    };
    let missed: Vec<Vec<usize>> = if n <= ALONE {
        let mut buffer = fused.buffer();
        parts.iter_mut().enumerate().map(|part| one_chunk(&mut buffer, part)).collect()
    } else {
        parts.par_iter_mut().enumerate().map_init(|| fused.buffer(), |buffer, part| one_chunk(buffer, part)).collect()
    };
    for (chunk, missed) in missed.into_iter().enumerate() {
        for row in missed {
            missing[chunk * together + row].get_or_insert_default();
        }
    }
    Rows { names, columns, missing }
}
