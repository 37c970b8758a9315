//! `hodograph teeth`: numbers of teeth for a ratio, or of a gear in a scene.

use super::args::TeethArgs;
use super::{CommandResult, InputFile, files, lang};
use crate::diag::Warned;
use crate::problem::teeth::{GearList, TeethList, TeethRequest, wanted_gear};

/// Runs the command.
pub fn run(a: &TeethArgs) -> CommandResult {
    if let Some(scene) = &a.scene {
        return in_scene(a, scene);
    }
    let found = TeethList::of(&TeethRequest {
        ratio: a.ratio.as_deref().unwrap_or_default(),
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

/// Finds the teeth of a gear in a scene.
fn in_scene(a: &TeethArgs, scene: &str) -> CommandResult {
    let [gear, want] = [&a.gear, &a.want].map(|text| text.as_deref().unwrap_or_default());
    let wish = wanted_gear(gear, want, &a.teeth, &a.within)?;
    let mut file = InputFile::open(scene, &[])?;
    let found = file.read(|bytes| {
        Ok(Warned { value: GearList::of(bytes, wish, a.count)?, notes: Vec::new() })
    })?;
    if a.json {
        files::print(&format!("{:#}\n", found.json()))
    } else {
        files::print(&found.text(lang::now()))
    }
}
