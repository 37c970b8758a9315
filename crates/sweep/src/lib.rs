//! Sweeps over a whole motion: the scene is compiled into a straight list of operations, which run
//! over all positions of a driver.
//!
//! [`run()`] is the entry point: it turns a placed scene, the driver and its stations into a
//! [`Table`]. A [`Sweep`] is compiled once for many runs. [`compile()`] makes the
//! [`program::SweepProgram`], with one operation for each group and effect ([`closure`], [`carry`],
//! [`rows`] and [`reading`] are the kernels). [`fuse`] combines operations that belong together,
//! and [`run`](mod@run) runs them over chunks of positions, four side by side where the machine can
//! ([`lane`]). [`suspect`] finds the joints that may change their branch during the motion. The
//! angles of rolling links follow from the ratios of their [`train`], counted in whole [`turns`].
//! Class III groups, and whole mechanisms that have no program, are followed from one position to
//! the next ([`follow`]). Positions at which the formulas have no value (a dead centre, a change
//! point) are handed to the general solver one by one. Positions that cannot be assembled are left
//! out, with the reason in the notes.
//!
//! [`long`] sweeps, sweeps of parameters ([`vary`]) and sweeps through time ([`timed`]) run piece
//! by piece ([`pieces`]), [`batch`]es block by block. [`positions`] answers questions that have no
//! kernel in mechanisms whose positions have a program. [`follow`] returns whole configurations
//! instead of columns, for drawings; [`zoom`] finds extremes between stations.
//!
//! This crate decides neither what a question means ([`hodograph_mechanism::answer`]) nor how a
//! single position is solved for drawing ([`hodograph_mechanism::position`],
//! [`hodograph_analytic`]); both serve as the check of this crate.

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// clippy.toml lists the functions of f64 whose last bit depends on the platform; tests may use
// them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// The maps link to private modules too; `cargo doc --document-private-items` resolves those links.
#![allow(rustdoc::private_intra_doc_links)]

pub mod batch;
mod carry;
mod changes;
mod chunks;
mod closure;
mod compile;
pub mod energy;
pub mod extreme;
pub mod follow;
mod fuse;
mod general;
mod kernel;
mod lane;
mod led;
pub mod limit;
pub mod long;
pub mod pieces;
pub mod points;
mod positions;
mod program;
mod reading;
#[cfg(test)]
mod rolling_tests;
mod rows;
mod run;
mod sampled;
pub mod station;
mod suspect;
mod swing;
pub mod table;
pub mod timed;
mod train;
mod turns;
pub mod vary;
mod work;
pub mod zeros;
pub mod zoom;

use pieces::never;

pub use compile::compile;
pub use lane::Width;
pub use run::CHUNK;
pub use station::{StationSteps, Stations};
pub use table::{Column, Table};

use changes::Changes;
use chunks::{run_on_branches, run_parts, sized};
use general::General;
use hodograph_base::diag::{Diagnostic, Faults, both};
use hodograph_mechanism::mechanism::{Demand, Mechanism};
use hodograph_mechanism::position::{self, Configuration};
use hodograph_scene::Scene;
use limit::Probe;
use positions::Stood;
use program::SweepProgram;
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

// Compiled again when its Chinese texts change.
const _: &str = include_str!("../po/zh.po");

/// A scene placed at its instant, ready to be swept.
pub struct PlacedScene<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Its topology.
    pub mechanism: &'a Mechanism,
    /// The required parts of the solution.
    pub demand: Demand,
    /// The configuration at the instant.
    pub at: Configuration,
    /// The known ends of travel, from following to single positions.
    pub ends: TravelEnds,
}

/// Ends of travel up to which drivers can be followed from the instant, each with its reason.
/// Values beyond a known end are not tried again. The key is the driver, and `true` for backward
/// travel.
#[derive(Debug, Default)]
pub struct TravelEnds(Mutex<BTreeMap<(usize, bool), (f64, Faults)>>);

impl TravelEnds {
    /// Returns the reason why a driver cannot travel so far (rad or m), if it is known.
    fn of(&self, driver: usize, way: f64) -> Option<Faults> {
        let known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        known
            .get(&(driver, way < 0.0))
            .filter(|(end, _)| way.abs() > *end)
            .map(|(_, why)| why.clone())
    }

    /// Records that a driver can be followed as far as `way`, and no farther in this direction.
    fn note(&self, driver: usize, way: f64, backward: bool, why: &Faults) {
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        known.entry((driver, backward)).or_insert_with(|| (way.abs(), why.clone()));
    }
}

impl<'a> PlacedScene<'a> {
    /// Places a scene for its own questions.
    ///
    /// # Errors
    /// The errors of [`position::configure`], and of [`position::redundant::check`] for a pair that
    /// locks the mechanism.
    pub fn new(scene: &'a Scene, mechanism: &'a Mechanism) -> Result<PlacedScene<'a>, Faults> {
        position::redundant::check(scene, mechanism)?;
        let demand = Demand::of(scene, mechanism);
        let at = position::configure(scene, mechanism, &demand)?.value;
        Ok(PlacedScene { scene, mechanism, demand, at, ends: TravelEnds::default() })
    }
}

/// Returns the answers to the scene's questions at all stations of a driver.
///
/// The table has a row for each station that can be assembled, in the order of the stations; see
/// [`Table`]. The result does not depend on the number of threads, on the width or on how the
/// stations are cut into chunks.
///
/// # Errors
/// A driver that the scene does not have; a sampled position that is not the scene's.
pub fn run(
    placed: &PlacedScene,
    driver: usize,
    stations: &Stations,
    width: Width,
) -> Result<Table, Faults> {
    let sweep = Sweep::new(placed, driver)?;
    sampled::proved(placed, driver, stations.len(), |i| stations.values[i])?;
    Ok(sweep.run(stations, width, Table::default()))
}

/// Returns the answers at given values of a driver (rad or m); `None` for a driver that the scene
/// does not have.
pub fn of_values(placed: &PlacedScene, driver: usize, values: Vec<f64>) -> Option<Table> {
    let per_value = station::angle_per_value(placed.scene, &placed.at, driver);
    run(placed, driver, &Stations::of_values(values, per_value), Width::Widest).ok()
}

/// A scene compiled for one of its drivers, for repeated sweeps.
pub struct Sweep<'a> {
    placed: &'a PlacedScene<'a>,
    driver: usize,
    /// The program, or the reason why there is none.
    program: Result<SweepProgram, Diagnostic>,
}

impl<'a> Sweep<'a> {
    /// Compiles a placed scene.
    ///
    /// # Errors
    /// A driver that the scene does not have.
    pub fn new(placed: &'a PlacedScene<'a>, driver: usize) -> Result<Sweep<'a>, Faults> {
        let scene = placed.scene;
        if driver >= scene.drivers.len() {
            return Err(Diagnostic::error(
                "no-driver",
                both!("the scene has no driver {}", driver + 1),
            )
            .into());
        }
        let program = compiled(placed, driver);
        Ok(Sweep { placed, driver, program })
    }

    /// Returns the answers at all stations, equal to those of [`run()`], in the memory of a table
    /// that is free to be reused: fresh memory costs more than the numbers in it.
    pub fn run(&self, stations: &Stations, width: Width, used: Table) -> Table {
        let Sweep { placed, driver, program } = self;
        let mut stock: Vec<Vec<f64>> = used.columns.into_iter().map(|c| c.values).collect();
        let mut first = stock.pop().unwrap_or_default();
        let mut notes = Vec::new();
        let general = General::new(placed, *driver);
        let rows = match program {
            Ok(program) => {
                let columns = sized(stock, program, stations);
                let (mut rows, changes) =
                    run_on_branches(program, placed, *driver, stations, width, columns);
                notes.extend(changes);
                rows.complete(&general, stations, &never, &|row| {
                    beside(program, placed, *driver, stations.values[row])
                });
                rows.explain(&general, stations);
                if !rows.missing.is_empty() {
                    notes.extend(ends(program, placed, *driver, stations));
                }
                rows
            }
            Err(note) => {
                let (rows, told) = without_program(&general, stations, note);
                notes.extend(told);
                rows
            }
        };
        first.clear();
        first.extend_from_slice(&stations.values);
        rows.into_table(placed, *driver, stations, first, notes)
    }
}

/// The way to make the rows of questions that have no program.
enum FallbackMethod {
    /// The general solver solves each row: followers of cams move by laws, or the scene is read
    /// again for each row.
    Each,
    /// The positions have a program.
    Stood(Box<Stood>),
    /// The whole mechanism is followed.
    Whole,
}

impl FallbackMethod {
    fn of(placed: &PlacedScene, driver: usize) -> FallbackMethod {
        let laws = placed.scene.has_laws(driver);
        if General::new(placed, driver).is_read_again()
            || laws && General::new(placed, driver).is_closed_everywhere()
        {
            return FallbackMethod::Each;
        }
        match Stood::of(placed, driver) {
            Some(stood) => FallbackMethod::Stood(Box::new(stood)),
            None if laws => FallbackMethod::Each,
            None => FallbackMethod::Whole,
        }
    }
}

/// All rows of questions that have no program, for the given reason, and the notes on them.
fn without_program(
    general: &General,
    stations: &Stations,
    why: &Diagnostic,
) -> (chunks::SweepRows, Vec<Diagnostic>) {
    let (placed, driver) = (general.placed(), general.driver());
    let mut notes = vec![why.clone()];
    let rows = match FallbackMethod::of(placed, driver) {
        FallbackMethod::Each => return (each(general, stations), Vec::new()),
        FallbackMethod::Stood(stood) => {
            let (parts, changes) = branches(stood.program.clone(), placed, driver, stations);
            notes.extend(changes);
            let rows = stood.rows(&parts, general, stations, &never).unwrap_or_default();
            if !rows.missing.is_empty() {
                notes.extend(ends(&stood.program, placed, driver, stations));
            }
            rows
        }
        FallbackMethod::Whole => {
            let (rows, limits) = follow::whole::follow(placed, driver, stations);
            notes.extend(limits);
            rows
        }
    };
    (rows, notes)
}

/// The topology of a scene for its whole motion ([`follow::course::over_a_turn`]). Questions about
/// the contact of a cam are allowed if the scene defines them where it is read, although a driver
/// replaces the contact.
///
/// # Errors
/// The errors of [`Mechanism::new`].
pub fn mechanism(scene: &Scene) -> Result<Mechanism, Faults> {
    let own = Mechanism::new(scene);
    match own {
        Err(_) if scene.source.is_some() && (0..scene.drivers.len()).any(|d| scene.is_led(d)) => {
            Mechanism::new(&scene.read_again(&|_| None)?)?;
            Ok(Mechanism::new(&Scene { find: Vec::new(), ..scene.clone() })?.value)
        }
        own => Ok(own?.value),
    }
}

/// Compiles the program of a driver.
fn compiled(placed: &PlacedScene, driver: usize) -> Result<SweepProgram, Diagnostic> {
    if General::new(placed, driver).is_read_again()
        && let Some(cam) = placed.scene.kept_cams().next()
    {
        let (cam, follower) =
            (placed.scene.link_name(cam.cam), placed.scene.link_name(cam.follower));
        let message = both!(
            "the contact of cam {} with {} has no compiled form: each position is solved by itself",
            cam,
            follower
        );
        return Err(Diagnostic::note("no-kernel", message));
    }
    compile(placed.scene, placed.mechanism, &placed.at, Some(driver), &placed.scene.find)
}

/// All rows by the general solver, each by itself.
fn each(general: &General, stations: &Stations) -> chunks::SweepRows {
    let width = general.scene().find.iter().flat_map(compile::ask::names).count();
    let columns = vec![vec![f64::NAN; stations.len()]; width];
    let mut rows =
        chunks::SweepRows { columns, open: (0..stations.len()).collect(), ..Default::default() };
    rows.complete(general, stations, &never, &|_| None);
    rows.explain(general, stations);
    rows
}

/// The numbers next to a station: the mean of two positions a thousandth of the reach to either
/// side, each on its own side of a change point.
fn beside(program: &SweepProgram, placed: &PlacedScene, driver: usize, x: f64) -> Option<Vec<f64>> {
    let off = 1e-3 * limit::reach(placed, driver);
    let sides = Stations::of_values(
        vec![x - off, x + off],
        station::angle_per_value(placed.scene, &placed.at, driver),
    );
    let (parts, _) = branches(program.clone(), placed, driver, &sides);
    let rows = run_parts(&parts, placed, driver, &sides, Width::One);
    let mean: Vec<f64> = rows.columns.iter().map(|c| 0.5 * (c[0] + c[1])).collect();
    mean.iter().all(|v| v.is_finite()).then_some(mean)
}

/// The driver's position in the scene, and the lowest and highest value of the stations and that
/// position.
fn span(placed: &PlacedScene, driver: usize, stations: &Stations) -> (f64, [f64; 2]) {
    let now = station::position_now(placed.scene, &placed.at, driver);
    let low = stations.values.iter().copied().fold(now, f64::min);
    let high = stations.values.iter().copied().fold(now, f64::max);
    (now, [low, high])
}

/// One note for each limit of the driver within the span of the stations.
fn ends(
    program: &SweepProgram,
    placed: &PlacedScene,
    driver: usize,
    stations: &Stations,
) -> Vec<Diagnostic> {
    let (now, span) = span(placed, driver, stations);
    let end = |until: f64| {
        (until != now).then(|| Probe::of(program.clone(), placed, driver).walk(until).0).flatten()
    };
    span.into_iter()
        .filter_map(end)
        .map(|e| general::limit_note(placed.scene, driver, &e))
        .collect()
}

/// The program of each stretch between change points, with its stations, and one note for each
/// change point.
fn branches(
    program: SweepProgram,
    placed: &PlacedScene,
    driver: usize,
    stations: &Stations,
) -> (Vec<(SweepProgram, Vec<usize>)>, Vec<Diagnostic>) {
    let (now, span) = span(placed, driver, stations);
    let changes = change_points(&program, placed, driver, now, span);
    let notes = change_notes(placed, driver, &changes, span);
    (stretches(program, now, &changes, stations), notes)
}

/// One note for each change point of the driver's travel, and one if they recur on further turns.
fn change_notes(
    placed: &PlacedScene,
    driver: usize,
    changes: &[Changes; 2],
    span: [f64; 2],
) -> Vec<Diagnostic> {
    let mut notes = Vec::new();
    for (changes, until) in changes.iter().zip(span) {
        let (met, more) = changes.met(until);
        notes.extend(met.iter().map(|c| general::change_note(placed.scene, driver, c)));
        notes.extend(more.then(|| general::again_note(placed.scene, driver, until)));
    }
    notes
}

/// The change points of the driver's travel from its position in the scene, downward and upward.
fn change_points(
    program: &SweepProgram,
    placed: &PlacedScene,
    driver: usize,
    now: f64,
    span: [f64; 2],
) -> [Changes; 2] {
    let mut changes = [Changes::default(), Changes::default()];
    if program.tracks.is_empty() && program.suspects().next().is_some() {
        // Both directions share one compiled program.
        program.fused_crossings();
        for (changes, until) in changes.iter_mut().zip(span).filter(|(_, until)| *until != now) {
            *changes = Probe::of(program.clone(), placed, driver).walk(until).1;
        }
    }
    changes
}

/// The program of each stretch between change points, with its stations.
fn stretches(
    program: SweepProgram,
    now: f64,
    changes: &[Changes; 2],
    stations: &Stations,
) -> Vec<(SweepProgram, Vec<usize>)> {
    let all: Vec<usize> = (0..stations.len()).collect();
    if changes.iter().all(|c| c.events.is_empty()) {
        return vec![(program, all)];
    }
    let [down, up] = changes;
    let mut rows: [Vec<Vec<usize>>; 2] =
        [vec![Vec::new(); down.stretches()], vec![Vec::new(); up.stretches()]];
    for i in all {
        let value = stations.values[i];
        if value < now {
            rows[0][down.stretch(value, -1.0)].push(i)
        } else {
            rows[1][up.stretch(value, 1.0)].push(i)
        }
    }
    let mut parts: Vec<(SweepProgram, Vec<usize>)> = Vec::new();
    for (changes, rows) in changes.iter().zip(rows) {
        let mut program = program.clone();
        for (k, rows) in rows.into_iter().enumerate() {
            if !rows.is_empty() {
                parts.push((program.clone(), rows));
            }
            if let Some(joint) = changes.events.get(k).and_then(|c| c.joint) {
                program.flip(joint);
            }
        }
    }
    parts
}
