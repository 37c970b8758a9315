//! The results, alone.

use crate::sheet;

use super::{FigureEntry, page};

/// The results.
pub const ENTRY: FigureEntry = FigureEntry {
    name: "results",
    about: ["The results", "结果"],
    draw: |w| page(ENTRY.name, Some(sheet::results(w.scene, w.worked, w.options))),
};
