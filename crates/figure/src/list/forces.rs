//! The force polygons of all groups, alone, and Zhukovsky's lever.

use crate::forces::{forces, lever};

use super::{FigureEntry, page};

/// Free bodies, force polygons, equations of equilibrium.
pub const ENTRY: FigureEntry = FigureEntry {
    name: "forces",
    about: [
        "Each group's free bodies, force polygon and equations",
        "各杆组的分离体、力多边形和力平衡方程",
    ],
    draw: |w| page(ENTRY.name, forces(w.scene, w.worked, w.options)),
};

/// Zhukovsky's lever.
pub const LEVER: FigureEntry = FigureEntry {
    name: "lever",
    about: [
        "Zhukovsky's lever: the loads on the turned velocity polygon",
        "茹可夫斯基杠杆：转向速度多边形上的各载荷",
    ],
    draw: |w| page(LEVER.name, lever(w.scene, w.worked, w.options)),
};
