//! The equations with their tables, alone.

use crate::sheet;

use super::{FigureEntry, page};

/// The equations.
pub const ENTRY: FigureEntry = FigureEntry {
    name: "equations",
    about: ["The equations with their tables", "矢量方程及其表格"],
    draw: |w| page(ENTRY.name, sheet::equations(w.scene, w.worked, w.options)),
};
