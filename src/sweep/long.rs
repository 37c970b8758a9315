//! Long sweeps, piece by piece: the rows of [`super::run()`], in the memory of a piece.

use super::chunks::run_parts;
use super::general::{self, Gap, General};
use super::limit::Event;
use super::program::Program;
use super::{Placed, Stations, Steps, Width, beside, change_points, compile, ends, span, stretches};
use crate::diag::Diagnostic;
use std::ops::Range;

/// A sweep under way.
pub struct Long<'a> {
    placed: &'a Placed<'a>,
    driver: usize,
    steps: Steps,
    program: Program,
    general: General<'a>,
    /// The ends of the whole way.
    reach: Stations,
    now: f64,
    changes: [Vec<Event>; 2],
    gaps: Vec<Gap>,
}

impl<'a> Long<'a> {
    /// Begins a sweep; `None` where the rows hang on one another, because links are followed from one position to the next, and where
    /// the mechanism has no program.
    pub fn new(placed: &'a Placed<'a>, driver: usize, steps: Steps) -> Option<Long<'a>> {
        let scene = placed.scene;
        let program = compile(scene, placed.mechanism, &placed.at, Some(driver), &scene.find).ok().filter(|p| p.tracks.is_empty())?;
        let [first, last] = [0, steps.steps].map(|i| steps.part(i..i + 1).values[0]);
        let reach = Stations::of_values(vec![first, last], 0.0);
        let (now, bounds) = span(placed, driver, &reach);
        let changes = change_points(&program, placed, driver, now, bounds);
        let general = General::new(placed, driver);
        Some(Long { placed, driver, steps, program, general, reach, now, changes, gaps: Vec::new() })
    }

    /// Name and unit of each column, the driver's first.
    pub fn columns(&self) -> Vec<(String, &'static str)> {
        let own = self.program.columns.iter().map(|c| (c.name.clone(), c.unit));
        std::iter::once(general::driver_name(self.placed.scene, self.driver)).chain(own).collect()
    }

    /// The numbers of the rows of these stations, as far as they are there, a column after the other. Pieces are asked for in order.
    pub fn piece(&mut self, rows: Range<usize>) -> Vec<Vec<f64>> {
        let stations = self.steps.part(rows.clone());
        let parts = stretches(self.program.clone(), self.now, &self.changes, &stations);
        let mut numbers = run_parts(&parts, self.placed, self.driver, &stations, Width::Widest);
        numbers.complete(&self.general, &stations, &|row| beside(&self.program, self.placed, self.driver, stations.values[row]));
        numbers.explain(&self.general, &stations);
        for gap in general::runs(&numbers.missing, rows.start) {
            match self.gaps.last_mut().filter(|g| g.rows.end == gap.rows.start) {
                Some(last) => last.rows.end = gap.rows.end,
                None => self.gaps.push(gap),
            }
        }
        numbers.there(stations.values)
    }

    /// What the rows cannot say, of all pieces so far.
    pub fn notes(&self) -> Vec<Diagnostic> {
        let scene = self.placed.scene;
        let mut notes: Vec<_> = self.changes.iter().flatten().map(|c| general::change_note(scene, self.driver, c)).collect();
        if !self.gaps.is_empty() {
            notes.extend(ends(&self.program, self.placed, self.driver, &self.reach));
        }
        let words = |k: usize| general::driver_words(scene, self.driver, self.steps.part(k..k + 1).values[0]);
        notes.extend(general::gap_notes(&words, &self.gaps));
        notes
    }
}
