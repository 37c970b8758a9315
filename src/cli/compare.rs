//! `hodograph compare`: several designs in one table and one diagram.

use super::args::{CommonArgs, CompareArgs};
use super::curves::ask_for_motion;
use super::draw::style_of;
use super::places::{no_report_beside, places};
use super::values::{ComparisonFormat, FigureFormat};
use super::{CommandResult, Failure, InputFile, SceneInput, choices, files};
use crate::diag::{Diagnostic, Warned, both};
use crate::figure::curves;
use crate::problem::Extent;
use crate::problem::compare::{ComparedScene, compare};
use crate::problem::range::RangeFault;
use crate::problem::whole::no_curve;
use std::path::Path;
use std::process::ExitCode;

/// Largest number of scenes that one table has.
const MOST: usize = 12;

/// Runs the command.
pub fn run(a: CompareArgs) -> CommandResult {
    no_report_beside(a.output.as_deref(), a.json)?;
    let places = match &a.output {
        Some(output) => places(output, &a.format, ComparisonFormat::Svg)?,
        None => Vec::new(),
    };
    let style = style_of(&a.look)?;
    if a.scenes.len() > MOST {
        let message = both!("a comparison has at most {MOST} scenes");
        let d = Diagnostic::error("too-many", message);
        return Err(Failure::argument("SCENE", &a.scenes[MOST], d));
    }
    let mut inputs: Vec<SceneInput> = Vec::new();
    for path in &a.scenes {
        let file = InputFile::open(path, &a.set)?;
        let mut input = SceneInput::of_file(file, Extent::Motion)?.drawn_in(&style);
        ask_for_motion(&mut input, a.find.as_deref())?;
        inputs.push(input);
    }
    let Some(first) = inputs.first() else { return Ok(ExitCode::SUCCESS) };
    let common = CommonArgs { scene: String::new(), set: Vec::new(), notation: a.notation };
    let (lang, notation) = choices(&first.scene, &common);
    let notation = style.marks.over(&notation);
    let scenes: Vec<ComparedScene> = inputs
        .iter()
        .map(|i| ComparedScene { file: i.file.name.clone(), scene: i.scene.clone() })
        .collect();
    let over = a.over.as_deref();
    let (table, diagram) = compare(&scenes, over, lang, &notation).map_err(|(k, fault)| {
        let one = inputs.get(k);
        one.map_or_else(|| Failure::Input(Vec::new()), |input| input.out_of_range(fault))
    })?;
    let of = |format: ComparisonFormat| places.iter().filter(move |(f, _)| *f == format);
    let drawn: Vec<(FigureFormat, String)> = places
        .iter()
        .filter_map(|(format, path)| Some((format.of_figure()?, path.clone())))
        .collect();
    if !drawn.is_empty() && diagram.is_empty() {
        return Err(first.out_of_range(RangeFault::Scene(no_curve().into())));
    }
    let one = || curves::figure(&first.scene, &diagram, &style, lang);
    let pages = || curves::pages(&first.scene, &diagram, &style, lang);
    let Warned { value: mut names, notes } = files::figure_or_pages(one, pages, &drawn)?;
    for (_, path) in of(ComparisonFormat::Csv) {
        files::write(Path::new(path), table.csv().as_bytes())?;
        names += &format!("{path}\n");
    }
    for (_, path) in of(ComparisonFormat::Json) {
        files::write(Path::new(path), format!("{:#}\n", table.json()).as_bytes())?;
        names += &format!("{path}\n");
    }
    if a.json {
        files::print(&format!("{:#}\n", table.json()))?;
    } else if a.output.is_none() {
        files::print(&table.text(lang))?;
    } else {
        files::print_names(&names)?;
    }
    if let Some(input) = inputs.first_mut() {
        input.file.notes.extend(notes);
    }
    inputs.iter().for_each(|input| input.file.say_notes());
    Ok(ExitCode::SUCCESS)
}
