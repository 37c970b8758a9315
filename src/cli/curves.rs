//! `hodograph curves`: displacements, velocities and accelerations against the position of the driver, as line diagrams.

use super::args::Curves;
use super::draw::read_style;
use super::sweep::{ask, driver_named, stations, unknown_driver};
use super::{Failure, Input, Run, choices, files};
use crate::answer::level_of;
use crate::diag::{Diagnostic, Faults};
use crate::figure::curves::{Diagram, figure};
use crate::mechanism::{Level, Mechanism};
use crate::scene::{Asked, Scene};
use crate::sweep::{self, Placed, Width, zoom};
use std::process::ExitCode;

/// Runs the command.
pub fn run(a: Curves) -> Run {
    let style = read_style(&a.style)?;
    let mut input = Input::read(&a.common.scene)?;
    let find = match &a.find {
        Some(find) => find.clone(),
        None => with_positions(&input.scene).join(","),
    };
    ask(&mut input, Some(&find))?;
    let failed = |faults: Faults| Failure::Input(faults, input.name.clone(), input.source.clone());
    let mechanism = Mechanism::new(&input.scene).map_err(failed)?.value;
    let driver = match a.over.as_deref() {
        None | Some("driver") => 0,
        Some(name) => driver_named(&input.scene, name).ok_or_else(|| failed(unknown_driver(&input.scene, name)))?,
    };
    let placed = Placed::new(&input.scene, &mechanism).map_err(failed)?;
    let stations = stations(&placed, driver, a.from.as_deref(), a.to.as_deref(), a.steps).map_err(failed)?;
    let table = sweep::run(&placed, driver, &stations, Width::Widest).map_err(failed)?;
    if table.rows() < 2 {
        let d = Diagnostic::error("no-motion", "fewer than two positions of the driver can be assembled: there is no curve");
        let mut faults: Faults = d.help("choose another range with --from and --to").into();
        faults.list.extend(table.notes);
        return Err(failed(faults));
    }
    let (lang, notation) = choices(&input.scene, &a.common);
    let located = |column: &str, range: [f64; 2], highest: bool| zoom::extreme(&placed, driver, column, range, highest);
    let diagram = Diagram::of(&input.scene, &table, &style.marks.over(&notation), &located);
    files::figure(&figure(&input.scene, &diagram, &style, lang), &a.output)?;
    files::print(&format!("{}\n", a.output))?;
    input.notes.extend(table.notes);
    input.say_notes();
    Ok(ExitCode::SUCCESS)
}

/// The scene's questions, and the positions whose rates they ask for: where a point moves both ways only its rates, as there no
/// coordinate is its displacement.
fn with_positions(scene: &Scene) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    for find in &scene.find {
        let position = match find.what {
            Asked::Omega(l) | Asked::Alpha(l) => Some(format!("phi_{}", scene.link_name(l))),
            Asked::Velocity(p) | Asked::Acceleration(p) if p.link.is_none() => {
                slides(scene, p.point).map(|axis| format!("{axis}_{}", scene.point_name(p.point)))
            }
            _ => None,
        };
        words.extend(position);
        if level_of(&find.what) >= Level::Position {
            words.push(find.text.clone());
        }
    }
    let mut seen = Vec::new();
    words.retain(|w| {
        !seen.contains(w) && {
            seen.push(w.clone());
            true
        }
    });
    words
}

/// Along which axis a point of a slider on the ground moves.
fn slides(scene: &Scene, point: crate::scene::PointId) -> Option<&'static str> {
    use crate::scene::GuidePath;
    let guide = scene.guides.iter().find(|g| g.pin == Some(point) && g.on == scene.ground)?;
    match &guide.path {
        GuidePath::Line { .. } => Some("x"),
        GuidePath::Arc { .. } => None,
    }
}
