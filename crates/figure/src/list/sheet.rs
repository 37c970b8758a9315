//! The whole sheet; with positions, the sheet of their table.

use crate::{poses, sheet};
use hodograph_base::diag::{Faults, Warned};
use hodograph_base::lang::each;

use super::{FigureEntry, FigureInput, Pages, page};
use hodograph_scene::Swept;

/// The whole sheet.
pub const ENTRY: FigureEntry = FigureEntry { name: "sheet", about: each!("The whole sheet"), draw };

fn draw(w: &FigureInput) -> Result<Warned<Pages>, Faults> {
    if w.extras.poses == 0 {
        return page("", Some(sheet::sheet(w.scene, w.worked, w.options)?));
    }
    let wanted = poses::PosesContent {
        count: w.extras.poses,
        swept: Swept::usual(w.scene),
        points: w.extras.points.clone(),
    };
    let Warned { value, notes } = poses::sheets(w.scene, w.worked, w.options, &wanted)?;
    let one = value.len() == 1;
    let word = |page: usize| if one { "poses".to_owned() } else { format!("poses-{}", page + 1) };
    Ok(Warned {
        value: value.into_iter().enumerate().map(|(page, f)| (word(page), f)).collect(),
        notes,
    })
}
