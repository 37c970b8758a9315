//! `hodograph curves`: displacements, velocities and accelerations over the position of the driver,
//! as line diagrams.

use super::args::CurvesArgs;
use super::draw::style_of;
use super::places::places;
use super::sweep::{ask, stations, within};
use super::values::FigureFormat;
use super::{CommandResult, Failure, SceneInput, choices, files};
use crate::diag::{Diagnostic, Faults, Warned, both};
use crate::figure::curves::{self, CurveDiagram};
use crate::problem::range::{swept_of, through};
use crate::problem::whole::{STEPS, no_curve, with_positions};
use crate::scene::Swept;
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
    ask_for_motion(&mut input, a.range.find.as_deref())?;
    let mechanism = sweep::mechanism(&input.scene).map_err(|f| input.failed(f))?;
    let swept = swept_of(&input.scene, a.range.over.as_deref())?;
    let placed = PlacedScene::new(&input.scene, &mechanism).map_err(|f| input.failed(f))?;
    let steps = within(a.range.steps.unwrap_or(STEPS), MOST_STEPS, both!("a diagram"))?;
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
            (timed, range) =
                through(&placed, &a.range.swept()).map_err(|f| input.out_of_range(f))?;
            swept_at = Box::new(|times| Some(timed.table(times)));
            gather(&mut timed.steps(range, steps))
        }
    };
    if table.rows() < 2 {
        let d = Diagnostic::error(
            "no-motion",
            both!("fewer than two positions of the driver can be assembled: there is no curve"),
        );
        let mut faults: Faults = d.help(both!("choose another range with --from and --to")).into();
        faults.list.extend(table.notes);
        return Err(input.failed(faults));
    }
    let (lang, notation) = choices(&input.scene, &a.common);
    let notation = style.marks.over(&notation);
    let nothing = |table: Table| {
        let mut faults: Faults =
            no_curve().help(both!("ask for other quantities with --find")).into();
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

/// Asks for the quantities of `--find`, else for the scene's own with their displacements, over its
/// whole motion.
pub fn ask_for_motion(input: &mut SceneInput, find: Option<&str>) -> Result<(), Failure> {
    let asked = match find {
        Some(find) => find.to_owned(),
        None => {
            let somewhere = input.file.notes.iter().all(|n| n.code != "free-centre");
            with_positions(&input.scene, somewhere).map_err(|f| input.failed(f))?.join(",")
        }
    };
    ask(input, Some(&asked))?;
    input.over_a_table();
    // Displacements were added to the scene's questions: they have no place in a file for a
    // diagnostic.
    input.file.asked = find.map(str::to_owned);
    Ok(())
}
