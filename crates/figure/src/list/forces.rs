//! The force polygons of all groups, alone, and Zhukovsky's lever.

use crate::forces::{forces, lever};
use hodograph_base::lang::each;

use super::{FigureEntry, page};

/// Free bodies, force polygons, equations of equilibrium.
pub const ENTRY: FigureEntry = FigureEntry {
    name: "forces",
    about: each!("Each group's free bodies, force polygon and equations"),
    draw: |w| page(ENTRY.name, forces(w.scene, w.worked, w.options)),
};

/// Zhukovsky's lever.
pub const LEVER: FigureEntry = FigureEntry {
    name: "lever",
    about: each!("Zhukovsky's lever: the loads on the turned velocity polygon"),
    draw: |w| page(LEVER.name, lever(w.scene, w.worked, w.options)),
};
