//! The arrangement of a figure that is drawn again while something moves.
//!
//! A [`Style`](super::style::Style) with a memory makes a drawing one of a series: its labels keep
//! their places, each part of the paper keeps its space, and everything that is only worth its time
//! in a single figure is left out.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use super::drawing::{DrawingPart, Habits};
use super::extent::Rect;
use hodograph_base::geom::Vec2;

/// Largest part for which the next figures keep space, if the first is not larger: beside a singular
/// pose a polygon grows without bound.
const LARGEST_MM: f64 = 400.0;
/// Width of the strip around a part's space into which the next part may reach: less than the air
/// around it. A label at the edge does not shift everything.
const STRIP_MM: f64 = 5.0;

/// The places of the labels, the spaces of the parts and the ground of one figure; clones share them.
#[derive(Clone, Debug, Default)]
pub struct LabelMemory(Arc<Mutex<Places>>);

/// The parts of one kind in a figure are distinguished by their order.
#[derive(Debug, Default)]
struct Places {
    parts: BTreeMap<(&'static str, usize), PartMemory>,
    counts: BTreeMap<&'static str, usize>,
    sides: BTreeMap<String, Vec2>,
    spans: BTreeMap<String, [f64; 2]>,
}

#[derive(Debug, Default)]
struct PartMemory {
    habits: Habits,
    /// The longer side of the first part (mm), and the box of all.
    space: Option<(f64, Rect)>,
}

impl LabelMemory {
    /// Begins the figure again.
    pub fn restart(&self) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).counts.clear();
    }

    /// Returns the side of an object of the ground in the first figure; `side` is that of this one.
    pub fn first_side(&self, name: &str, side: Vec2) -> Vec2 {
        let mut places = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        *places.sides.entry(name.to_owned()).or_insert(side)
    }

    /// Returns the least and the greatest coordinate of a moving object in all figures; `at` is that
    /// of this one, plus any number of periods, if it has a `period`.
    pub fn span(&self, name: &str, at: f64, period: Option<f64>) -> [f64; 2] {
        let mut places = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let span = places.spans.entry(name.to_owned()).or_insert([at; 2]);
        let middle = 0.5 * (span[0] + span[1]);
        let turns = period.map_or(0.0, |round| ((middle - at) / round).round() * round);
        *span = [span[0].min(at + turns), span[1].max(at + turns)];
        span.map(|s| s - turns)
    }

    /// Gives a part the space of all parts of its kind and order in the figures before.
    pub fn hold(&self, kind: &'static str, part: &mut DrawingPart) {
        self.with_next(kind, |of| of.hold(part));
    }

    /// Finishes the next drawing of a kind with the places of its labels and the space of the
    /// figures before.
    pub(super) fn next(
        &self,
        kind: &'static str,
        finish: impl FnOnce(&mut Habits) -> DrawingPart,
    ) -> DrawingPart {
        self.with_next(kind, |of| {
            let mut part = finish(&mut of.habits);
            of.hold(&mut part);
            part
        })
    }

    fn with_next<T>(&self, kind: &'static str, act: impl FnOnce(&mut PartMemory) -> T) -> T {
        let mut places = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let count = places.counts.entry(kind).or_default();
        *count += 1;
        let key = (kind, *count);
        act(places.parts.entry(key).or_default())
    }
}

impl PartMemory {
    fn hold(&mut self, part: &mut DrawingPart) {
        let side = |r: Rect| r.width_mm().max(r.height_mm());
        let (first, space) = *self.space.get_or_insert((side(part.bounds), part.bounds));
        let strip = space.grown(STRIP_MM);
        let all = if strip.union(part.bounds) == strip { space } else { space.union(part.bounds) };
        if side(all) <= LARGEST_MM.max(first) {
            self.space = Some((first, all));
        }
        part.bounds = all;
    }
}

/// Memories are equal if they are the same one.
impl PartialEq for LabelMemory {
    fn eq(&self, other: &LabelMemory) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}
