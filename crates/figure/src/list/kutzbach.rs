//! Kutzbach's plan of each gear train, with Willis' table.

use crate::kutzbach::plans;
use crate::sheet::SheetDrafter;
use hodograph_base::diag::{Faults, Warned};
use hodograph_base::lang::each;
use hodograph_worked::certified::certify;

use super::{FigureEntry, FigureInput, Pages};

/// Gear trains: velocities over the line of centres, angular velocities, and the table.
pub const ENTRY: FigureEntry = FigureEntry {
    name: "kutzbach",
    about: each!("Gear trains: Kutzbach's plan and Willis' table"),
    draw,
};

fn draw(w: &FigureInput) -> Result<Warned<Pages>, Faults> {
    let certified = certify(w.scene, w.worked, w.options.digits);
    let maker = SheetDrafter { scene: w.scene, worked: w.worked, options: w.options, certified };
    let pages = plans(&maker)
        .into_iter()
        .map(|(name, figure)| (format!("{}{name}", ENTRY.name), figure))
        .collect();
    Ok(Warned { value: pages, notes: Vec::new() })
}
