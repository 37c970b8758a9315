//! The places of the labels in all drawings of a figure that is drawn again while something moves.
//!
//! A [`Style`](super::style::Style) with a memory makes a drawing one of a series: its labels keep
//! their places, and everything that is only worth its time in a single figure is left out.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use super::drawing::Habits;

/// The places of the labels of one figure; clones share them.
#[derive(Clone, Debug, Default)]
pub struct LabelMemory(Arc<Mutex<Places>>);

/// The drawings of one kind in a figure are distinguished by their order.
#[derive(Debug, Default)]
struct Places {
    drawings: BTreeMap<(&'static str, usize), Habits>,
    counts: BTreeMap<&'static str, usize>,
}

impl LabelMemory {
    /// Begins the figure again.
    pub fn restart(&self) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).counts.clear();
    }

    /// Finishes the next drawing of a kind with the places of its labels in the figure before.
    pub(super) fn next<T>(&self, kind: &'static str, finish: impl FnOnce(&mut Habits) -> T) -> T {
        let mut places = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let count = places.counts.entry(kind).or_default();
        *count += 1;
        let key = (kind, *count);
        finish(places.drawings.entry(key).or_default())
    }
}

/// Memories are equal if they are the same one.
impl PartialEq for LabelMemory {
    fn eq(&self, other: &LabelMemory) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}
