//! The mechanism alone, with its overlays, and each polygon alone.

use crate::sheet::{diagram, drawing};
use hodograph_base::diag::{Faults, Warned};
use hodograph_base::lang::each;
use hodograph_scene::DiagramKind;

use super::{FigureEntry, FigureInput, Pages, page};

/// The mechanism.
pub const MECHANISM: FigureEntry =
    FigureEntry { name: "mechanism", about: each!("The kinematic diagram"), draw: mechanism };
/// The velocity polygon.
pub const VELOCITY: FigureEntry = FigureEntry {
    name: "velocity",
    about: each!("The velocity polygon"),
    draw: |w| page(VELOCITY.name, drawing(w.scene, w.worked, w.options, DiagramKind::Velocity)),
};
/// The acceleration polygon.
pub const ACCELERATION: FigureEntry = FigureEntry {
    name: "acceleration",
    about: each!("The acceleration polygon"),
    draw: |w| {
        page(ACCELERATION.name, drawing(w.scene, w.worked, w.options, DiagramKind::Acceleration))
    },
};

fn mechanism(w: &FigureInput) -> Result<Warned<Pages>, Faults> {
    let figure = if w.extras.any() {
        Some(diagram(w.scene, w.worked, w.options, &w.extras.overlay(w.scene, w.worked)))
    } else {
        drawing(w.scene, w.worked, w.options, DiagramKind::Plane)
    };
    page(MECHANISM.name, figure)
}
