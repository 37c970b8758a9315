//! The results, alone.

use crate::sheet;
use hodograph_base::lang::each;

use super::{FigureEntry, page};

/// The results.
pub const ENTRY: FigureEntry = FigureEntry {
    name: "results",
    about: each!("The results"),
    draw: |w| page(ENTRY.name, Some(sheet::results(w.scene, w.worked, w.options))),
};
