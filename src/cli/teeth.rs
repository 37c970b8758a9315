//! `hodograph teeth`: numbers of teeth for a ratio.

use super::args::TeethArgs;
use super::{CommandResult, files, lang};
use crate::problem::teeth::{TeethList, TeethRequest};

/// Runs the command.
pub fn run(a: &TeethArgs) -> CommandResult {
    let found = TeethList::of(&TeethRequest {
        ratio: &a.ratio,
        within: &a.within,
        teeth: &a.teeth,
        distance: a.distance.as_deref(),
        modules: &a.module,
        shifts: &a.shifts,
        helix: &a.helix,
        stages: a.stages,
        taper: a.taper,
        count: a.count,
    })?;
    if a.json {
        files::print(&format!("{:#}\n", found.json()))
    } else {
        files::print(&found.text(lang::now()))
    }
}
