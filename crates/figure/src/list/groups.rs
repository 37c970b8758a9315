//! The Assur groups drawn apart.

use crate::groups;
use hodograph_base::diag::{Faults, Warned};
use hodograph_base::lang::each;

use super::{FigureEntry, FigureInput, Pages, page};

/// The driven part with the ground, and every group in its pose.
pub const ENTRY: FigureEntry =
    FigureEntry { name: "groups", about: each!("The Assur groups drawn apart"), draw };

fn draw(w: &FigureInput) -> Result<Warned<Pages>, Faults> {
    let FigureInput { scene, worked, options, .. } = w;
    let figure = groups::figure(scene, worked, &options.style, &options.notation, options.lang)?;
    page(ENTRY.name, Some(figure))
}
