//! A mechanism with cams beside the linkage in place of it.

use crate::replaced;
use hodograph_base::diag::{Faults, Warned};
use hodograph_base::lang::each;

use super::{FigureEntry, FigureInput, Pages, page};

/// The mechanism, and the linkage of lower pairs in place of it.
pub const ENTRY: FigureEntry = FigureEntry {
    name: "replaced",
    about: each!("Cams: the linkage of lower pairs in place of the contact"),
    draw,
};

fn draw(w: &FigureInput) -> Result<Warned<Pages>, Faults> {
    page(ENTRY.name, Some(replaced::figure(w.scene, w.worked, w.options)?))
}
