//! The equations with their tables, alone.

use crate::sheet;
use hodograph_base::lang::each;

use super::{FigureEntry, page};

/// The equations.
pub const ENTRY: FigureEntry = FigureEntry {
    name: "equations",
    about: each!("The equations with their tables"),
    draw: |w| page(ENTRY.name, sheet::equations(w.scene, w.worked, w.options)),
};
