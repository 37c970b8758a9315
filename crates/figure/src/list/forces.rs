//! The force polygons of all groups, alone.

use crate::forces::forces;

use super::{Entry, page};

/// Free bodies, force polygons, equations of equilibrium.
pub const ENTRY: Entry = Entry {
    name: "forces",
    about: ["Each group's free bodies, force polygon and equations", "各杆组的分离体、力多边形和力平衡方程"],
    draw: |w| page(ENTRY.name, forces(w.scene, w.worked, w.options)),
};
