//! `hodograph sweep` (all positions of a driver, or values of a parameter, into a file) and
//! `hodograph limits` (results of the whole motion).

use super::args::{LimitsArgs, RangeArgs, SweepArgs};
use super::places::OutputPlace;
use super::values::TableFormat;
use super::{CommandResult, Failure, SceneInput, SourceFaults, choices, files, lang, tables};
use crate::diag::{Both, Diagnostic, Warned, both};
use crate::mechanism::Mechanism;
use crate::problem::listed;
use crate::problem::range::{self, RangeFault, SweptRange, WrongValue, driver_of};
use crate::problem::whole::{balanced, over_a_table};
use crate::report::limits as report;
use crate::report::table::TableHead;
use crate::scene;
use crate::sweep::pieces::{ScaledPieces, SweepPieces};
use crate::sweep::{PlacedScene, Stations, extreme};
use std::process::ExitCode;

pub fn sweep(a: SweepArgs) -> CommandResult {
    let mut input = SceneInput::read(&a.common)?;
    // Without a name and a format, the table is printed.
    let asked = a.output.as_deref().or((!a.format.is_empty()).then_some("-"));
    let place =
        asked.map(|output| tables::place(output, &a.format, TableFormat::Csv)).transpose()?;
    ask(&mut input, a.range.find.as_deref())?;
    input.over_a_table();
    let notes = sweep_into(&input, &a, place.as_ref())?;
    input.file.notes.extend(notes);
    input.file.say_notes();
    Ok(ExitCode::SUCCESS)
}

impl SceneInput {
    /// Changes the scene to its whole motion for a table.
    pub(super) fn over_a_table(&mut self) {
        let Warned { value, notes } = over_a_table(self.scene.clone());
        self.scene = value;
        self.file.notes.extend(notes);
    }
}

/// Writes the table to its place; returns its notes.
fn sweep_into(
    input: &SceneInput,
    a: &SweepArgs,
    place: Option<&OutputPlace<TableFormat>>,
) -> Result<Vec<Diagnostic>, Failure> {
    let title = choices(&input.scene, &a.common).0.of(&input.scene.title);
    let scene = &input.scene;
    range::rows(scene, &a.range.swept(), |pieces| {
        let head = TableHead::new(title, pieces.columns()).in_language(lang::now());
        let Some(list) = &a.units else { return write(pieces, head, place) };
        let (units, factors): (Vec<String>, Vec<f64>) =
            range::listed_units(scene, list, &pieces.columns())?.into_iter().unzip();
        write(&mut ScaledPieces { rows: pieces, factors }, head.in_units(units), place)
    })
    .map_err(|f| input.out_of_range(f))?
}

fn write(
    sweep: &mut dyn SweepPieces,
    head: TableHead,
    place: Option<&OutputPlace<TableFormat>>,
) -> Result<Vec<Diagnostic>, Failure> {
    match place {
        Some(place) => tables::write(sweep, head, place)?,
        None => files::print_with(|out| tables::print(sweep, head, out))?,
    }
    Ok(sweep.notes())
}

/// Runs the command `limits` for quantities: their extremes and zeros.
fn quantities(a: &LimitsArgs, find: &str) -> CommandResult {
    let mut input = SceneInput::read(&a.common)?;
    ask(&mut input, Some(find))?;
    input.over_a_table();
    let (lang, notation) = choices(&input.scene, &a.common);
    let over = a.over.as_deref();
    let diagram =
        listed::listed(&input.scene, over, &notation).map_err(|f| input.out_of_range(f))?;
    let driver = input.scene.driver_name(driver_of(&input.scene, over)?).0;
    if a.json {
        files::print(&format!("{:#}\n", listed::json(&diagram, &driver)))?;
    } else {
        files::print(&listed::text(&input.scene, &diagram, &driver, lang))?;
    }
    input.file.say_notes();
    Ok(ExitCode::SUCCESS)
}

/// Runs the command `limits`.
pub fn limits(a: LimitsArgs) -> CommandResult {
    if let Some(find) = &a.find {
        return quantities(&a, find);
    }
    // The limits of the motion do not depend on the driver's speed.
    let mut input = SceneInput::read_at_rest(&a.common)?;
    input.over_a_turn();
    let (lang, _) = choices(&input.scene, &a.common);
    let mechanism = Mechanism::new(&input.scene).map_err(|f| input.failed(f))?.value;
    let driver = driver_of(&input.scene, a.over.as_deref())?;
    let limits = extreme::limits(&input.scene, &mechanism, driver).map_err(|f| input.failed(f))?;
    if a.ranges {
        let all = report::ranges::of(&limits).map_err(|d| input.failed(d.into()))?;
        if a.json {
            files::print(&format!("{:#}\n", report::ranges::json(&all)))?;
        } else {
            files::print(&report::ranges::text(&input.scene, &all, lang))?;
        }
    } else {
        let energy = balanced(&input.scene, &input.file.source, driver, a.flywheel.as_deref())
            .map_err(|f| input.out_of_range(f))?;
        if a.json {
            let mut json = report::json(&input.scene, driver, &limits);
            json["energy"] = energy.map(|e| e.json()).into();
            files::print(&format!("{json:#}\n"))?;
        } else {
            files::print(&report::text(&input.scene, driver, &limits, lang))?;
            if let Some(energy) = energy {
                files::print(&energy.text(&input.scene, driver, &limits, lang))?;
            }
        }
    }
    input.file.say_notes();
    Ok(ExitCode::SUCCESS)
}

/// Replaces the scene's questions by those of `--find`; faults point to the argument.
pub fn ask(input: &mut SceneInput, find: Option<&str>) -> Result<(), Failure> {
    let Some(find) = find else { return Ok(()) };
    input.file.asked = Some(find.to_owned());
    let read = scene::read_asking(&input.file.source, find);
    let Warned { value, notes } = read.map_err(|faults| input.failed(faults))?;
    (input.scene, input.file.notes) = (value, notes);
    Ok(())
}

impl RangeArgs {
    /// Returns the range without its questions.
    pub fn swept(&self) -> SweptRange<'_> {
        let RangeArgs { over, from, to, steps, .. } = self;
        SweptRange {
            over: over.as_deref(),
            from: from.as_deref(),
            to: to.as_deref(),
            steps: *steps,
        }
    }
}

impl SceneInput {
    /// Returns the failure for a range that cannot be swept.
    pub(super) fn out_of_range(&self, fault: RangeFault) -> Failure {
        match fault {
            RangeFault::Scene(faults) => self.failed(faults),
            RangeFault::Values(all) => Failure::of_values(all),
        }
    }
}

impl From<WrongValue> for SourceFaults {
    fn from(WrongValue { of, text, faults }: WrongValue) -> SourceFaults {
        SourceFaults { faults, name: format!("--{of}"), source: text }
    }
}

impl Failure {
    /// Returns the failure for faults of arguments.
    pub(super) fn of_values(all: Vec<WrongValue>) -> Failure {
        Failure::Input(all.into_iter().map(Into::into).collect())
    }
}

impl From<WrongValue> for Failure {
    fn from(wrong: WrongValue) -> Failure {
        Failure::of_values(vec![wrong])
    }
}

/// Returns the stations of a driver in a range, in a given number of steps.
pub fn stations(
    input: &SceneInput,
    placed: &PlacedScene,
    driver: usize,
    range: &RangeArgs,
    count: usize,
) -> Result<Stations, Failure> {
    let swept = SweptRange { steps: Some(count), ..range.swept() };
    let steps = range::steps(placed, driver, &swept).map_err(|f| input.out_of_range(f))?;
    Ok(steps.all())
}

/// Checks that the number of steps is not larger than `what` allows.
pub fn within(steps: usize, most: usize, what: Both) -> Result<usize, Failure> {
    if steps <= most {
        return Ok(steps);
    }
    let d =
        Diagnostic::error("too-many", both!("--steps {steps}: {} has at most {most} steps", what));
    let d = d.help(both!(
        "write --steps {most} or fewer; `sweep` writes tables of up to ten million rows"
    ));
    Err(Failure::argument("--steps", &steps.to_string(), d))
}
