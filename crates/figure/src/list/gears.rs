//! Each gear pair with its teeth.

use crate::gears::pairs;
use crate::sheet::SheetDrafter;
use hodograph_base::diag::{Faults, Warned};
use hodograph_base::lang::each;
use hodograph_worked::certified::certify;

use super::{FigureEntry, FigureInput, Pages};

/// Gear pairs: flanks, circles, line of action, table.
pub const ENTRY: FigureEntry = FigureEntry {
    name: "gears",
    about: each!("Gear pairs with teeth, line of action and contact ratio"),
    draw,
};

fn draw(w: &FigureInput) -> Result<Warned<Pages>, Faults> {
    let certified = certify(w.scene, w.worked, w.options.digits);
    pairs(&SheetDrafter { scene: w.scene, worked: w.worked, options: w.options, certified })
}
