//! `hodograph curvature`: pole, inflection circle and centres of curvature of a link's paths, by
//! drawing and by analysis.

use super::{CommandResult, Failure, SceneInput, SourceFaults, args, choices, files, pencil};
use crate::curvature::{CurvatureRequest, centrodes, couplers, curvature};
use crate::diag::{Diagnostic, Faults, Warned, both};
use crate::problem::points_named;
use crate::report::{curvature as report, curvature_json};
use crate::scene::{LinkId, Scene};
use hodograph_base::json::fields::suggest;
use std::process::ExitCode;

/// Runs the command.
pub fn run(a: args::CurvatureArgs) -> CommandResult {
    // The curvature of a path does not depend on the driver's speed.
    let mut input = SceneInput::read_at_rest(&a.common)?;
    let (lang, _) = choices(&input.scene, &a.common);
    let asked = asked(&input.scene, &a)?;
    if let Some(mm) = pencil(a.drafting.as_deref())? {
        input.scene.paper.pencil_mm = Some(mm);
    }
    let Warned { value, notes } = curvature(&input.scene, &asked).map_err(|f| input.failed(f))?;
    input.file.notes.extend(notes);
    let value = if a.drafting.is_some() { value.with_drafting() } else { value };
    if a.json {
        let mut paths = Vec::new();
        for of in value.list.iter().filter(|_| a.centrodes) {
            let path = centrodes::centrodes(
                &value.scene,
                &value.worked,
                of.link,
                value.against,
                centrodes::STEPS,
            );
            paths.push(path.map_err(|f| input.failed(f))?);
        }
        files::print(&format!("{:#}\n", curvature_json::json(&value, &paths, &input.file.notes)))?;
        input.file.say_notes_beside_json();
        return Ok(ExitCode::SUCCESS);
    }
    files::print(&report::text(&value, a.steps, lang))?;
    input.file.say_notes();
    Ok(ExitCode::SUCCESS)
}

/// Returns the links and points of the command line; reports all that do not exist at once.
fn asked(scene: &Scene, a: &args::CurvatureArgs) -> Result<CurvatureRequest, Failure> {
    let (links, points) = (
        links_named(scene, &a.link, "--link"),
        points_named(scene, &a.point, "point").map_err(SourceFaults::from),
    );
    let against: Vec<String> = a.against.iter().cloned().collect();
    let against = links_named(scene, &against, "--against").map(|all| all.first().copied());
    let (links, points, against) = match (links, points, against) {
        (Ok(links), Ok(points), Ok(against)) => (links, points, against),
        (links, points, against) => {
            return Err(Failure::Input(
                [links.err(), points.err(), against.err()].into_iter().flatten().collect(),
            ));
        }
    };
    let frame = against.unwrap_or(scene.ground);
    if links.contains(&frame) {
        let name = scene.link_name(frame);
        let message = both!("link {name} does not move, seen from itself");
        let d = Diagnostic::error("link", message).help(both!("name a moving link"));
        return Err(Failure::argument("--link", name, d));
    }
    if !links.is_empty() {
        return Ok(CurvatureRequest { links, against, points });
    }
    // For named points, only the links that carry them.
    let carries = |l: &LinkId| {
        points.is_empty() || points.iter().any(|p| scene.links[l.0].points.contains(p))
    };
    let mut links: Vec<LinkId> = couplers(scene).into_iter().filter(carries).collect();
    if links.is_empty() {
        links.extend(points.iter().filter_map(|p| scene.mover(*p)));
        links.dedup();
    }
    links.retain(|l| *l != frame);
    Ok(CurvatureRequest { links, against, points })
}

/// Returns the links with these names.
///
/// # Errors
/// `unknown-link` for each name that the scene does not have.
pub fn links_named(
    scene: &Scene,
    names: &[String],
    option: &str,
) -> Result<Vec<LinkId>, SourceFaults> {
    let mut faults = Faults::default();
    let mut out = Vec::new();
    for name in names {
        match scene.links.iter().position(|l| l.name == *name) {
            Some(l) => out.push(LinkId(l)),
            None => {
                let d = Diagnostic::error("unknown-link", both!("the scene has no link `{name}`"));
                let all = scene.links.iter().map(|l| l.name.as_str());
                faults.push(d.help(suggest(name, all, both!("the links are"))));
            }
        }
    }
    if faults.list.is_empty() {
        Ok(out)
    } else {
        Err(SourceFaults::argument(option, &names.join(","), faults))
    }
}
