//! Runs a program over all stations of a sweep, chunk after chunk into columns, on one thread or on
//! all, and records which rows exist.

use super::follow::compiled::{self, States};
use super::fuse::Fused;
use super::general::{self, General};
use super::kernel::Reg;
use super::lane::Width;
use super::limit::{SUSPECT, dense};
use super::pieces::{Gaps, StopSignal};
use super::positions::Stood;
use super::program::{INPUTS, SweepProgram};
use super::run::{Buffer, CHUNK};
use super::table::{Column, Table};
use super::{PlacedScene, Stations, branches, compile};
use hodograph_base::budget::{here, spend};
use hodograph_base::diag::{Diagnostic, Faults};
use hodograph_mechanism::position::Configuration;
use rayon::prelude::*;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::ops::{DerefMut, Range};
use std::sync::atomic::{AtomicBool, Ordering};

/// The rows of a sweep in progress: the numbers of all columns, and the rows that exist.
#[derive(Default)]
pub(super) struct SweepRows<C = Vec<f64>> {
    /// The numbers, column after column.
    pub columns: Vec<C>,
    /// The missing rows, with their reasons.
    pub missing: BTreeMap<usize, Faults>,
    /// The rows with numbers that are not finite, in order, before the reason is known.
    pub open: Vec<usize>,
}

/// The numbers next to a row.
type NearbyRow<'a> = &'a (dyn Fn(usize) -> Option<Vec<f64>> + Sync);

impl<C: DerefMut<Target = [f64]>> SweepRows<C> {
    /// Hands the open rows to the general solver. Where it finds several ways on, the one nearest
    /// to the numbers of `near` is taken. Stops early and returns `false` if `stop` asks for it.
    pub fn complete(
        &mut self,
        general: &General,
        stations: &Stations,
        stop: StopSignal,
        near: NearbyRow,
    ) -> bool {
        let open = std::mem::take(&mut self.open);
        if open.is_empty() {
            return true;
        }
        let laid = Stood::beyond_change_points(general, stations, &open);
        let solve = |i: usize, at: Option<&Configuration>| {
            general.ways(stations, i, at).map(|ways| pick_way(ways, || near(i)))
        };
        let here = here();
        let one = |(&i, at): (&usize, &Option<Configuration>)| {
            (!stop()).then(|| here.enter(|| solve(i, at.as_ref())))
        };
        let solved: Option<Vec<_>> = open.par_iter().zip(&laid).map(one).collect();
        let Some(solved) = solved else { return false };
        for (i, row) in open.into_iter().zip(solved) {
            match row {
                Ok(row) => self.columns.iter_mut().zip(row).for_each(|(c, v)| c[i] = v),
                Err(why) => drop(self.missing.insert(i, why)),
            }
        }
        true
    }

    /// Asks the general solver for the reason why the first of each run of missing rows is missing,
    /// if it is not yet known.
    pub fn explain(&mut self, general: &General, stations: &Stations) {
        let mut last = None;
        for (&i, why) in &mut self.missing {
            let first = i == 0 || last != Some(i - 1);
            last = Some(i);
            if first && why.list.is_empty() {
                *why = general.solve(stations, i).err().unwrap_or_default();
            }
        }
    }
}

impl SweepRows {
    /// Returns the rows with the numbers copied to other columns.
    pub fn copied_to<C: DerefMut<Target = [f64]>>(self, mut columns: Vec<C>) -> SweepRows<C> {
        columns.iter_mut().zip(&self.columns).for_each(|(c, v)| c.copy_from_slice(v));
        SweepRows { columns, missing: self.missing, open: self.open }
    }

    /// Returns the numbers of the rows that exist, the driver's values first.
    pub fn there(self, values: Vec<f64>) -> Vec<Vec<f64>> {
        let mut columns: Vec<Vec<f64>> = std::iter::once(values).chain(self.columns).collect();
        if !self.missing.is_empty() {
            for column in &mut columns {
                let mut row = 0..;
                column.retain(|_| row.next().is_some_and(|i| !self.missing.contains_key(&i)));
            }
        }
        columns
    }

    pub fn into_table(
        self,
        placed: &PlacedScene,
        driver: usize,
        stations: &Stations,
        values: Vec<f64>,
        mut notes: Vec<Diagnostic>,
    ) -> Table {
        let words = |k: usize| general::driver_words(placed.scene, driver, stations.values[k]);
        let mut gaps = Gaps::of(placed.scene);
        gaps.see_all(&self, 0);
        notes.extend(gaps.notes(&words));
        let heads = std::iter::once(placed.scene.driver_column(driver))
            .chain(placed.scene.find.iter().flat_map(compile::ask::names));
        let columns = heads.zip(self.there(values)).map(|((name, unit), values)| Column {
            name,
            unit,
            values,
        });
        Table { columns: columns.collect(), notes }
    }
}

/// The way on that is nearest to a row; the first if there is only one, or nothing to compare it
/// with.
fn pick_way(mut ways: Vec<Vec<f64>>, near: impl Fn() -> Option<Vec<f64>>) -> Vec<f64> {
    if ways.len() > 1
        && let Some(near) = near()
    {
        let off = |row: &Vec<f64>| {
            row.iter()
                .zip(&near)
                .map(|(a, b)| (a - b).abs() / (a.abs() + b.abs() + f64::MIN_POSITIVE))
                .sum::<f64>()
        };
        ways.sort_by(|a, b| off(a).total_cmp(&off(b)));
    }
    ways.swap_remove(0)
}

/// Runs the program of each stretch over its stations.
pub(super) fn run_parts(
    parts: &[(SweepProgram, Vec<usize>)],
    placed: &PlacedScene,
    driver: usize,
    stations: &Stations,
    width: Width,
) -> SweepRows {
    if let [(program, _)] = parts {
        return run_program(program, placed, driver, stations, width);
    }
    let mut whole = SweepRows { columns: Vec::new(), missing: BTreeMap::new(), open: Vec::new() };
    for (program, rows) in parts {
        let part = run_program(program, placed, driver, &stations.pick(rows), width);
        whole.columns.resize_with(part.columns.len(), || vec![f64::NAN; stations.len()]);
        for (column, numbers) in whole.columns.iter_mut().zip(&part.columns) {
            rows.iter().zip(numbers).for_each(|(&i, v)| column[i] = *v);
        }
        whole.missing.extend(part.missing.into_iter().map(|(k, why)| (rows[k], why)));
        whole.open.extend(part.open.into_iter().map(|k| rows[k]));
    }
    whole.open.sort_unstable();
    whole
}

/// Runs a program over all stations.
pub(super) fn run_program(
    program: &SweepProgram,
    placed: &PlacedScene,
    driver: usize,
    stations: &Stations,
    width: Width,
) -> SweepRows {
    let states = states(program, placed, driver, stations);
    run_in(program, states.as_ref(), stations, width, Vec::new())
}

/// The states of a program's followed links, if it has any.
fn states(
    program: &SweepProgram,
    placed: &PlacedScene,
    driver: usize,
    stations: &Stations,
) -> Option<States> {
    (!program.tracks.is_empty()).then(|| compiled::follow(program, placed, driver, stations))
}

/// Runs a program over all stations, with the given states of its followed links, in the memory of
/// `used`.
pub(super) fn run_in(
    program: &SweepProgram,
    states: Option<&States>,
    stations: &Stations,
    width: Width,
    used: Vec<Vec<f64>>,
) -> SweepRows {
    let columns = sized(used, program, stations);
    fill(program, program.fused(), states, stations, width, columns, |_, _| {})
}

/// Columns for a program's answers at all stations, in the memory of `used`.
pub(super) fn sized(
    used: Vec<Vec<f64>>,
    program: &SweepProgram,
    stations: &Stations,
) -> Vec<Vec<f64>> {
    let mut columns = used;
    columns.resize_with(program.columns.len(), Vec::new);
    columns.iter_mut().for_each(|c| c.resize(stations.len(), 0.0));
    columns
}

/// The greatest number of stations for which watching for change points during the run costs less
/// than searching for them beforehand.
const WATCHED: usize = 4096;

/// Runs a program over all stations, on the other branches of its joints beyond change points;
/// returns one note for each of these.
pub(super) fn run_on_branches<C: DerefMut<Target = [f64]>>(
    program: &SweepProgram,
    placed: &PlacedScene,
    driver: usize,
    stations: &Stations,
    width: Width,
    columns: Vec<C>,
) -> (SweepRows<C>, Vec<Diagnostic>) {
    if program.tracks.is_empty() && program.suspects().next().is_none() {
        return (
            fill(program, program.fused(), None, stations, width, columns, |_, _| {}),
            Vec::new(),
        );
    }
    let watch = stations.len() <= WATCHED
        && program.tracks.is_empty()
        && dense(program, placed, driver, stations);
    let ran = if watch {
        let (rows, near) = run_watched(program, stations, width, columns);
        if !near {
            return (rows, Vec::new());
        }
        Ok(rows)
    } else {
        Err(columns)
    };
    let (parts, notes) = branches(program.clone(), placed, driver, stations);
    let rows = match (&parts[..], ran) {
        ([_], Ok(rows)) => rows,
        ([(program, _)], Err(columns)) => {
            let states = states(program, placed, driver, stations);
            fill(program, program.fused(), states.as_ref(), stations, width, columns, |_, _| {})
        }
        (parts, ran) => {
            let columns = ran.map_or_else(|columns| columns, |rows| rows.columns);
            run_parts(parts, placed, driver, stations, width).copied_to(columns)
        }
    };
    (rows, notes)
}

/// Runs a program on the branches of the instant and watches the crossings of the joints that may
/// have a change point: most mechanisms come nowhere near one and need no search. Returns `true` if
/// there may be one.
fn run_watched<C: DerefMut<Target = [f64]>>(
    program: &SweepProgram,
    stations: &Stations,
    width: Width,
    columns: Vec<C>,
) -> (SweepRows<C>, bool) {
    let near = AtomicBool::new(false);
    let fused = program.fused_watched();
    let watched: Vec<Reg> = program.suspects().filter_map(|c| fused.place(c)).collect();
    let seen = |buffer: &Buffer, n: usize| {
        let clear = |reg: &Reg| {
            buffer.numbers(*reg, n).iter().fold(true, |clear, c| clear & (*c > SUSPECT))
        };
        if !watched.iter().all(clear) {
            near.store(true, Ordering::Relaxed);
        }
    };
    let rows = fill(program, fused, None, stations, width, columns, seen);
    (rows, near.into_inner())
}

/// The count of numbers in registers (some hundred microseconds) below which a sweep runs on one
/// thread: waking others takes as long.
const ALONE: usize = 1 << 19;

/// The number of chunks that a thread takes at once.
const STRETCH: usize = 16;

thread_local! {
    /// The registers of the last sweep on this thread, so that the next one needs no new memory.
    static REGISTERS: RefCell<Buffer> = RefCell::default();
}

/// Runs a program in one of its forms over all stations into columns of their length. `states` are
/// its followed links at each station. `seen` receives the registers of each chunk and its number
/// of positions.
pub(super) fn fill<C: DerefMut<Target = [f64]>>(
    program: &SweepProgram,
    fused: &Fused,
    states: Option<&States>,
    stations: &Stations,
    width: Width,
    mut columns: Vec<C>,
    seen: impl Fn(&Buffer, usize) + Sync,
) -> SweepRows<C> {
    let n = stations.len();
    let mut missing = BTreeMap::new();
    for (row, state) in states.into_iter().flatten().enumerate() {
        if let Err(why) = state {
            missing.insert(row, why.clone());
        }
    }
    let together = fused.positions();
    let found: Vec<Option<Reg>> = program.columns.iter().map(|c| fused.place(*c)).collect();
    let [straight, copied] = [true, false].map(|straight| fused.answers(&found, straight));
    // True if nothing has to be filled in and no answer is an input.
    let whole = states.is_none() && !found.iter().flatten().any(|r| INPUTS.contains(r));
    let alone = n * fused.registers < ALONE || rayon::current_num_threads() == 1;
    // The parts of the columns that one thread fills at a time.
    let stretch = if alone { n.max(1) } else { STRETCH * together };
    let mut parts: Vec<Vec<&mut [f64]>> =
        (0..n.div_ceil(stretch)).map(|_| Vec::with_capacity(columns.len())).collect();
    for column in &mut columns {
        parts.iter_mut().zip(column.chunks_mut(stretch)).for_each(|(part, c)| part.push(c));
    }
    let run = |fused: &Fused, buffer: &mut Buffer, rows: &Range<usize>| {
        fused.load(buffer, stations, rows.clone());
        if let Some(states) = states {
            for (i, state) in states[rows.clone()].iter().enumerate() {
                if let Ok(state) = state {
                    program.show(state, fused, buffer, i);
                }
            }
        }
        fused.run(buffer, width);
    };
    // The lost rows of a stretch, each with `true` if the loss is certain.
    let one_stretch = |buffer: &mut Buffer,
                       (number, part): (usize, &mut Vec<&mut [f64]>)|
     -> Vec<(usize, bool)> {
        let mut lost = Vec::new();
        let (first, end) = (number * stretch, n.min((number + 1) * stretch));
        for from in (first..end).step_by(together) {
            spend();
            let rows = from..end.min(from + together);
            let here = rows.start - first..rows.end - first;
            let answers = if whole && rows.len() == CHUNK {
                fused.run_there(
                    buffer,
                    (stations, rows.start),
                    &straight,
                    places(part, &here),
                    width,
                );
                &straight
            } else {
                run(fused, buffer, &rows);
                &copied
            };
            seen(buffer, rows.len());
            if buffer.hand_out(answers, places(part, &here), width) {
                continue;
            }
            // A row that misses its closure by more than rounding certainly has no position: the
            // general solver is not asked. A program of answers alone does not hold the closures;
            // they are computed again, for the lost rows only.
            let closures = program.fused_crossings();
            let mut looked = closures.buffer();
            run(closures, &mut looked, &rows);
            let gone = |row: &usize| part.iter().any(|numbers| !numbers[*row - first].is_finite());
            lost.extend(
                rows.clone()
                    .filter(gone)
                    .map(|row| (row, closures.misses(program, &looked, row - rows.start))),
            );
        }
        lost
    };
    let lost: Vec<Vec<(usize, bool)>> = if alone {
        let mut buffer = fused.buffer_in(REGISTERS.take());
        let lost =
            parts.iter_mut().enumerate().map(|part| one_stretch(&mut buffer, part)).collect();
        REGISTERS.set(buffer);
        lost
    } else {
        let here = here();
        parts
            .par_iter_mut()
            .enumerate()
            .map_init(|| fused.buffer(), |buffer, part| here.enter(|| one_stretch(buffer, part)))
            .collect()
    };
    let mut open = Vec::new();
    for (row, sure) in lost.into_iter().flatten() {
        match sure {
            true => drop(missing.entry(row).or_default()),
            false if missing.contains_key(&row) => {}
            false => open.push(row),
        }
    }
    SweepRows { columns, missing, open }
}

/// The given rows of a part's columns.
fn places<'a>(
    part: &'a mut [&mut [f64]],
    rows: &Range<usize>,
) -> impl Iterator<Item = &'a mut [f64]> {
    part.iter_mut().map(|numbers| &mut numbers[rows.clone()])
}

#[cfg(test)]
mod tests {
    use super::*;
    use hodograph_mechanism::mechanism::Mechanism;
    use hodograph_scene::{Angle, edit, read, templates};

    /// A four-bar that cannot turn certainly does not close over a part of the turn: the general
    /// solver is not asked there, even if the program contains other groups.
    #[test]
    fn what_surely_misses_is_not_solved_again() {
        let text = templates::instantiate("crank-rocker", &[("l_AB", "240")]).unwrap();
        for find in [&["v_C", "a_C"][..], &["x_C"], &["v_B", "v_C"]] {
            let scene = read(edit::with_find(&text, find).unwrap()).unwrap().value;
            let m = Mechanism::new(&scene).unwrap().value;
            let placed = PlacedScene::new(&scene, &m).unwrap();
            let stations = Stations::turned(Angle::Deg(0.0), Angle::Deg(360.0), 10_000);
            let program =
                super::super::compile(&scene, &m, &placed.at, Some(0), &scene.find).unwrap();
            let rows = run_program(&program, &placed, 0, &stations, Width::Widest);
            assert!(
                rows.missing.len() > 1000 && rows.open.len() < 10,
                "{find:?}: {} missing, {} open",
                rows.missing.len(),
                rows.open.len()
            );
        }
    }
}
