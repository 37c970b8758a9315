//! `hodograph curves`: displacements, velocities and accelerations over the position of the driver,
//! as line diagrams.

use super::args::CurvesArgs;
use super::draw::style_of;
use super::places::places;
use super::sweep::{STEPS, ask, stations, swept_of, through, within};
use super::values::FigureFormat;
use super::{CommandResult, Failure, SceneInput, choices, files};
use crate::diag::{Diagnostic, Faults, Warned, both};
use crate::figure::curves::{self, CurveDiagram};
use crate::mechanism::Mechanism;
use crate::position::Path;
use crate::scene::quantity::Meaning;
use crate::scene::{LinkId, OnLink, PointId, Scene, Swept};
use crate::sweep::pieces::gather;
use crate::sweep::{self, PlacedScene, Table, Width};
use std::process::ExitCode;

/// Largest number of steps of a diagram: its lines are drawn point by point, and no paper shows
/// more than a few thousand of them side by side.
const MOST_STEPS: usize = 100_000;

/// Runs the command.
pub fn run(a: CurvesArgs) -> CommandResult {
    let places = places(&a.output, &a.format, FigureFormat::Svg)?;
    let style = style_of(&a.look)?;
    let mut input = SceneInput::read(&a.common)?.drawn_in(&style);
    let find = match &a.range.find {
        Some(find) => find.clone(),
        None => with_positions(&input)?.join(","),
    };
    ask(&mut input, Some(&find))?;
    input.over_a_table();
    // Displacements were added to the scene's questions: they have no place in a file for a
    // diagnostic.
    input.file.asked = a.range.find.clone();
    let mechanism = sweep::mechanism(&input.scene).map_err(|f| input.failed(f))?;
    let swept = swept_of(&input.scene, a.range.over.as_deref())?;
    let placed = PlacedScene::new(&input.scene, &mechanism).map_err(|f| input.failed(f))?;
    let steps = within(a.range.steps.unwrap_or(STEPS), MOST_STEPS, both!("a diagram", "线图"))?;
    let timed;
    let swept_at: Box<dyn Fn(Vec<f64>) -> Option<Table>>;
    let table = match swept {
        Swept::Driver(driver) => {
            let stations = stations(&input, &placed, driver, &a.range, steps)?;
            let placed = &placed;
            swept_at = Box::new(move |values| sweep::of_values(placed, driver, values));
            sweep::run(placed, driver, &stations, Width::Widest).map_err(|f| input.failed(f))?
        }
        Swept::Time => {
            let range;
            (timed, range) = through(&placed, &a.range)?;
            swept_at = Box::new(|times| Some(timed.table(times)));
            gather(&mut timed.steps(range, steps))
        }
    };
    if table.rows() < 2 {
        let d = Diagnostic::error(
            "no-motion",
            both!(
                "fewer than two positions of the driver can be assembled: there is no curve",
                "原动件可装配的位置不足两个：没有曲线"
            ),
        );
        let mut faults: Faults = d
            .help(both!(
                "choose another range with --from and --to",
                "请用 --from 和 --to 另选范围"
            ))
            .into();
        faults.list.extend(table.notes);
        return Err(input.failed(faults));
    }
    let (lang, notation) = choices(&input.scene, &a.common);
    let notation = style.marks.over(&notation);
    let nothing = |table: Table| {
        let d = Diagnostic::error(
            "no-curve",
            both!("nothing that is asked has a curve", "所求各量均无曲线可画"),
        );
        let mut faults: Faults = d
            .help(both!("ask for other quantities with --find", "请用 --find 另选所求的量"))
            .into();
        faults.list.extend(table.notes);
        faults
    };
    let Warned { value: names, notes } = if a.polar {
        let figure = curves::polar(&input.scene, swept, &table, &style, &notation, lang);
        let Some(figure) = figure else { return Err(input.failed(nothing(table))) };
        files::figure_or_pages(|| figure.clone(), || vec![figure.clone()], &places)?
    } else {
        let diagram = CurveDiagram::swept(&input.scene, swept, &table, &*swept_at, &notation);
        if diagram.is_empty() {
            return Err(input.failed(nothing(table)));
        }
        let (one, pages) = (
            || curves::figure(&input.scene, &diagram, &style, lang),
            || curves::pages(&input.scene, &diagram, &style, lang),
        );
        files::figure_or_pages(one, pages, &places)?
    };
    input.file.notes.extend(notes);
    files::print_names(&names)?;
    input.file.notes.extend(table.notes);
    input.file.say_notes();
    Ok(ExitCode::SUCCESS)
}

/// Returns the scene's questions, each preceded by its displacement: the angle of a link, or the
/// coordinates in which a slider on the ground moves. A point that moves freely has no such
/// coordinate.
fn with_positions(input: &SceneInput) -> Result<Vec<String>, Failure> {
    let scene = &input.scene;
    let mechanism = Mechanism::new(scene).map_err(|f| input.failed(f))?.value;
    let placed = PlacedScene::new(scene, &mechanism).map_err(|f| input.failed(f))?;
    // A gear train without given centres has no angles.
    let somewhere = input.file.notes.iter().all(|n| n.code != "free-centre");
    let mut words: Vec<String> = Vec::new();
    for find in &scene.find {
        let meaning = find.what.meaning(scene);
        if let Some(l) = meaning.and_then(Meaning::turning_of)
            && somewhere
            && has_line(scene, l)
        {
            words.push(format!("phi_{}", scene.link_name(l)));
        }
        if let Some(OnLink { point, link: None }) = meaning.and_then(Meaning::vector_of) {
            let axes = axes(&placed, point);
            words.extend(axes.iter().map(|axis| format!("{axis}_{}", scene.point_name(point))));
        }
        words.push(find.text.clone());
    }
    let mut seen: Vec<String> = Vec::new();
    for word in words {
        if !seen.contains(&word) {
            seen.push(word);
        }
    }
    Ok(seen)
}

/// Returns true if a link has an angle of its own; a wheel that consists of its centre alone has
/// none.
fn has_line(scene: &Scene, link: LinkId) -> bool {
    let guided = scene
        .guides
        .iter()
        .any(|g| g.rolling.is_none() && (g.on == link || g.slider == Some(link)));
    guided || scene.links[link.0].points.len() >= 2
}

/// Largest deviation (sine) of a guide from an axis that counts as rounding of its angle.
const ALONG: f64 = 1e-9;

/// Returns the coordinates in which a pin on a straight guide of the ground moves.
fn axes(placed: &PlacedScene, point: PointId) -> &'static [&'static str] {
    let guides = placed.scene.guides.iter().zip(&placed.at.guides);
    let on_ground = guides.filter(|(g, _)| g.pin == Some(point) && g.on == placed.scene.ground);
    match on_ground.map(|(_, path)| path).next() {
        Some(Some(Path::Line { direction, .. })) if direction.y.abs() < ALONG => &["x"],
        Some(Some(Path::Line { direction, .. })) if direction.x.abs() < ALONG => &["y"],
        Some(Some(Path::Line { .. })) => &["x", "y"],
        _ => &[],
    }
}
