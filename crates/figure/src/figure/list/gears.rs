//! Each gear pair with its teeth.

use crate::certified::certify;
use crate::diag::{Faults, Warned};
use crate::figure::gears::pairs;
use crate::figure::sheet::Maker;

use super::{Entry, Pages, Wanted};

/// Gear pairs: flanks, circles, line of action, table.
pub const ENTRY: Entry =
    Entry {
        name: "gears", about: ["Gear pairs with teeth, line of action and contact ratio", "齿轮副：齿廓、啮合线和重合度"], draw
    };

fn draw(w: &Wanted) -> Result<Warned<Pages>, Faults> {
    let certified = certify(w.scene, w.worked, w.options.digits);
    pairs(&Maker { scene: w.scene, worked: w.worked, options: w.options, certified })
}
