//! Long sweeps, piece by piece: the rows of [`super::run()`], in the memory of a piece.

use super::changes::Changes;
use super::chunks::{SweepRows, run_in, run_parts};
use super::follow::chains::{Chains, STRIDE};
use super::follow::compiled::{self, Compiled};
use super::follow::whole::{self, DrivenMechanism};
use super::general::{self, General};
use super::pieces::{Gaps, StopSignal, SweepPieces};
use super::positions::Stood;
use super::program::SweepProgram;
use super::sampled::proved;
use super::{
    FallbackMethod, PlacedScene, StationSteps, Stations, Width, beside, change_notes,
    change_points, compile, compiled, each, ends, span, stretches,
};
use hodograph_base::diag::{Diagnostic, Faults};
use std::ops::Range;

/// A sweep of a driver in progress.
pub struct LongSweep<'a> {
    placed: &'a PlacedScene<'a>,
    driver: usize,
    steps: StationSteps,
    /// True if the driver's values descend.
    descending: bool,
    way: RowMethod<'a>,
    general: General<'a>,
    gaps: Gaps,
    /// The memory of the stations of the piece before, without their values.
    spare: Stations,
}

/// The way to make the rows.
enum RowMethod<'a> {
    /// Each row by itself.
    Free {
        program: Box<SweepProgram>,
        /// The ends of the whole travel.
        reach: Stations,
        now: f64,
        changes: [Changes; 2],
    },
    /// With followed links.
    Compiled { course: Box<Chains<Compiled<'a>>>, reach: Stations },
    /// Each row by the general solver: followers of cams move by laws.
    Each,
    /// Each row by the loop equations; the positions have a program, the questions have none, for
    /// the reason `why`.
    Stood { stood: Box<Stood>, reach: Stations, now: f64, changes: [Changes; 2], why: Diagnostic },
    /// The whole mechanism is followed; there is no program, for the reason `why`.
    Whole { course: Box<Chains<DrivenMechanism<'a>>>, why: Diagnostic },
}

impl<'a> LongSweep<'a> {
    /// Begins a sweep of a driver that the scene has.
    ///
    /// # Errors
    /// A sampled position that is not the scene's.
    pub fn new(
        placed: &'a PlacedScene<'a>,
        driver: usize,
        steps: StationSteps,
    ) -> Result<LongSweep<'a>, Faults> {
        proved(placed, driver, steps.steps + 1, |i| steps.value(i))?;
        let [first, last] = [0, steps.steps].map(|i| steps.value(i));
        let (descending, count) = (last < first, steps.steps + 1);
        let values = |position| steps.value(flipped(position, descending, count));
        let way = match compiled(placed, driver) {
            Ok(program) => {
                let reach = Stations::of_values(vec![first, last], 0.0);
                if program.tracks.is_empty() {
                    let (now, bounds) = span(placed, driver, &reach);
                    let changes = change_points(&program, placed, driver, now, bounds);
                    RowMethod::Free { program: Box::new(program), reach, now, changes }
                } else {
                    RowMethod::Compiled {
                        course: Box::new(Compiled::course(program, placed, driver, count, &values)),
                        reach,
                    }
                }
            }
            Err(why) => match FallbackMethod::of(placed, driver) {
                FallbackMethod::Each => RowMethod::Each,
                FallbackMethod::Stood(stood) => {
                    let reach = Stations::of_values(vec![first, last], 0.0);
                    let (now, bounds) = span(placed, driver, &reach);
                    let changes = change_points(&stood.program, placed, driver, now, bounds);
                    RowMethod::Stood { stood, reach, now, changes, why }
                }
                FallbackMethod::Whole => RowMethod::Whole {
                    course: Box::new(DrivenMechanism::course(placed, driver, count, &values)),
                    why,
                },
            },
        };
        Ok(LongSweep {
            placed,
            driver,
            steps,
            descending,
            way,
            general: General::new(placed, driver),
            gaps: Gaps::of(placed.scene),
            spare: Stations::default(),
        })
    }

    fn rows(
        &mut self,
        rows: Range<usize>,
        stations: &Stations,
        used: Vec<Vec<f64>>,
        stop: StopSignal,
    ) -> Option<SweepRows> {
        let (placed, driver, steps, general) =
            (self.placed, self.driver, &self.steps, &self.general);
        let (descending, count) = (self.descending, steps.steps + 1);
        let values = |position| steps.value(flipped(position, descending, count));
        let part = if descending { count - rows.end..count - rows.start } else { rows.clone() };
        let row = |position| flipped(position, descending, count) - rows.start;
        let (program, mut numbers) = match &mut self.way {
            RowMethod::Free { program, now, changes, .. } => {
                let parts = stretches((**program).clone(), *now, changes, stations);
                let rows = match &parts[..] {
                    [(alone, _)] => run_in(alone, None, stations, Width::Widest, used),
                    _ => run_parts(&parts, placed, driver, stations, Width::Widest),
                };
                (&**program, rows)
            }
            RowMethod::Compiled { course, .. } => {
                let states = compiled::states(course, part, &values, &row, stop)?;
                let program = course.follow().program();
                (program, run_in(program, Some(&states), stations, Width::Widest, used))
            }
            RowMethod::Each => return Some(each(general, stations)),
            RowMethod::Stood { stood, now, changes, .. } => {
                let parts = stretches(stood.program.clone(), *now, changes, stations);
                return stood.rows(&parts, general, stations, stop);
            }
            RowMethod::Whole { course, .. } => {
                return whole::rows(course, general, part, stations, &values, &row, stop);
            }
        };
        if !numbers.complete(general, stations, stop, &|row| {
            beside(program, placed, driver, stations.values[row])
        }) {
            return None;
        }
        numbers.explain(general, stations);
        Some(numbers)
    }
}

/// The row of a position: positions of a course ascend, rows may descend.
fn flipped(i: usize, descending: bool, count: usize) -> usize {
    if descending { count - 1 - i } else { i }
}

impl SweepPieces for LongSweep<'_> {
    fn columns(&self) -> Vec<(String, &'static str)> {
        let scene = self.placed.scene;
        std::iter::once(scene.driver_column(self.driver))
            .chain(scene.find.iter().flat_map(compile::ask::names))
            .collect()
    }

    fn count(&self) -> usize {
        self.steps.steps + 1
    }

    fn at_once(&self) -> usize {
        match self.way {
            RowMethod::Free { .. } => 1 << 16,
            // As many positions as are repeated from one state.
            RowMethod::Compiled { .. }
            | RowMethod::Whole { .. }
            | RowMethod::Each
            | RowMethod::Stood { .. } => STRIDE,
        }
    }

    fn piece(
        &mut self,
        rows: Range<usize>,
        used: Vec<Vec<f64>>,
        stop: StopSignal,
    ) -> Option<Vec<Vec<f64>>> {
        let mut used = used.into_iter();
        let values = used.next().unwrap_or_default();
        let spare = Stations { values, ..std::mem::take(&mut self.spare) };
        let stations = self.steps.part_in(rows.clone(), spare);
        let numbers = self.rows(rows.clone(), &stations, used.collect(), stop)?;
        self.gaps.see_all(&numbers, rows.start);
        let Stations { values, cosines, sines } = stations;
        self.spare = Stations { values: Vec::new(), cosines, sines };
        Some(numbers.there(values))
    }

    fn notes(&self) -> Vec<Diagnostic> {
        let scene = self.placed.scene;
        let lost = !self.gaps.is_empty();
        let limits = |program: &SweepProgram, reach| {
            if lost { ends(program, self.placed, self.driver, reach) } else { Vec::new() }
        };
        let mut notes = match &self.way {
            RowMethod::Free { program, reach, changes, .. } => {
                let mut notes = change_notes(
                    self.placed,
                    self.driver,
                    changes,
                    span(self.placed, self.driver, reach).1,
                );
                notes.extend(limits(program, reach));
                notes
            }
            RowMethod::Each => Vec::new(),
            RowMethod::Stood { stood, reach, changes, why, .. } => {
                let mut notes = vec![why.clone()];
                notes.extend(change_notes(
                    self.placed,
                    self.driver,
                    changes,
                    span(self.placed, self.driver, reach).1,
                ));
                notes.extend(limits(&stood.program, reach));
                notes
            }
            RowMethod::Compiled { course, reach } => limits(course.follow().program(), reach),
            RowMethod::Whole { course, why } => {
                std::iter::once(why.clone()).chain(whole::ends(course)).collect()
            }
        };
        notes.extend(
            self.gaps.notes(&|k| general::driver_words(scene, self.driver, self.steps.value(k))),
        );
        notes
    }
}
