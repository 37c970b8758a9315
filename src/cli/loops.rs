//! `hodograph loops`: the analytic method written out.

use super::{CommandResult, SceneInput, args, choices, files};
use crate::diag::{Both, Diagnostic, Warned, both};
use crate::loops;
use crate::report::loops as report;
use crate::report::replaced::replaced_words;
use crate::scene::Scene;
use crate::worked::{Scope, work_replaced};
use std::process::ExitCode;

/// Runs the command.
pub fn run(a: &args::LoopsArgs) -> CommandResult {
    let mut input = SceneInput::read(&a.common)?;
    let (lang, _) = choices(&input.scene, &a.common);
    let replaced = if input.scene.cams.is_empty() {
        None
    } else {
        let worked = input.work(Scope::Figure)?;
        work_replaced(&input.scene, &worked).map_err(|f| input.failed(f))?
    };
    let scene = replaced.as_ref().map_or(&input.scene, |(of, _)| &of.scene);
    let Warned { value, notes } = loops::loops(scene).map_err(|f| input.failed(f))?;
    let mut told: Vec<Diagnostic> = replaced_words(&input.scene).into_iter().map(linkage).collect();
    told.extend(
        (value.groups.is_empty() && value.motion.points.is_empty()).then(|| nothing(scene)),
    );
    if a.json {
        files::print(&format!("{:#}\n", report::json(scene, &value)))?;
    } else {
        files::print(&report::LoopWords::new(scene, &value, lang).text())?;
    }
    input.file.notes.extend(notes);
    input.file.notes.extend(told);
    if a.json {
        input.file.say_notes_beside_json();
    } else {
        input.file.say_notes();
    }
    Ok(ExitCode::SUCCESS)
}

/// The note on a link that is in place of the contact of a cam.
fn linkage(words: Both) -> Diagnostic {
    Diagnostic::note("loops", both!("higher pairs are replaced by lower ones: {}", words))
}

/// The warning that a mechanism has no loop of vectors, with the pin or the links on which it lacks.
fn nothing(scene: &Scene) -> Diagnostic {
    let bare = scene.guides.iter().filter(|g| g.slider.is_none()).filter_map(|g| g.pin);
    let free = bare.map(|p| (p, scene.carriers(p).next())).find(|(_, link)| link.is_none());
    let moved: Vec<&str> =
        scene.drivers.iter().filter_map(|d| Some(scene.link_name(d.kind.turned()?.0))).collect();
    let message = match free {
        Some((pin, _)) => both!(
            "pin {} is on no link: it runs in two guides, and no vector leads to it along a body; no loop is written",
            scene.point_name(pin)
        ),
        None => both!(
            "no joint closes a loop: the drivers move each link directly ({}), and nothing is unknown",
            Both::names(&moved)
        ),
    };
    Diagnostic::warning("loops", message).help(both!(
        "`hodograph solve` answers the questions; `hodograph sweep` writes x(t), y(t) as a table"
    ))
}
