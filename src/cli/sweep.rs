//! The commands `sweep` (all positions of a driver, or of a parameter, into a file) and `limits` (what the motion comes to).

use super::args::{Limits, Range, Sweep};
use super::{Failure, Input, Run, choices, files, tables};
use crate::diag::{Diagnostic, Faults, Warned};
use crate::mechanism::Mechanism;
use crate::report::limits as report;
use crate::scene::{self, DriverKind, Scene, edit};
use crate::sweep::extreme;
use crate::sweep::long::Long;
use crate::sweep::pieces::Pieces;
use crate::sweep::station::{self, Way};
use crate::sweep::vary::{Span, Variation, Varied};
use crate::sweep::{self, Placed, Stations, Steps};
use std::process::ExitCode;

/// Steps of a sweep unless the command line says otherwise: one for each degree of a turn.
pub const STEPS: usize = 360;

pub fn sweep(a: Sweep) -> Run {
    let mut input = Input::read(&a.common.scene)?;
    if let Some(path) = a.output.as_deref() {
        tables::ending(path, &tables::ALL)?;
    }
    ask(&mut input, a.range.find.as_deref())?;
    let notes = sweep_into(&input, &a)?;
    input.notes.extend(notes);
    input.say_notes();
    Ok(ExitCode::SUCCESS)
}

/// Writes the table to where it belongs; returns its notes.
fn sweep_into(input: &Input, a: &Sweep) -> Result<Vec<Diagnostic>, Failure> {
    let failed = |faults: Faults| Failure::Input(faults, input.name.clone(), input.source.clone());
    let title = input.scene.title.get(choices(&input.scene, &a.common).0);
    let scene = &input.scene;
    let mechanism = Mechanism::new(scene).map_err(failed)?.value;
    let parameter = a.range.over.as_deref().filter(|o| *o != "driver" && driver_named(scene, o).is_none());
    if let Some(name) = parameter {
        let variation = Variation::new(scene, &[name]).map_err(failed)?;
        let span = values(scene, &variation, name, a).map_err(failed)?;
        return write(&mut Varied::new(scene, &mechanism, &variation, span), title, a.output.as_deref());
    }
    let driver = driver_of(scene, a.range.over.as_deref()).map_err(failed)?;
    let placed = Placed::new(scene, &mechanism).map_err(failed)?;
    let steps = steps(&placed, driver, &a.range, a.range.steps.unwrap_or(STEPS)).map_err(failed)?;
    write(&mut Long::new(&placed, driver, steps), title, a.output.as_deref())
}

fn write(sweep: &mut dyn Pieces, title: &str, path: Option<&str>) -> Result<Vec<Diagnostic>, Failure> {
    match path {
        Some(path) => tables::write(sweep, title, path)?,
        None => files::print_with(|out| tables::print(sweep, out))?,
    }
    Ok(sweep.notes())
}

/// The command `limits`: what the motion as a whole comes to.
pub fn limits(a: Limits) -> Run {
    let input = Input::read(&a.common.scene)?;
    let (lang, _) = choices(&input.scene, &a.common);
    let failed = |faults: Faults| Failure::Input(faults, input.name.clone(), input.source.clone());
    let mechanism = Mechanism::new(&input.scene).map_err(failed)?.value;
    let driver = driver_of(&input.scene, a.over.as_deref()).map_err(failed)?;
    let limits = extreme::limits(&input.scene, &mechanism, driver).map_err(failed)?;
    if a.json {
        files::print(&format!("{:#}\n", report::json(&input.scene, driver, &limits)))?;
    } else {
        files::print(&report::text(&input.scene, driver, &limits, lang))?;
    }
    input.say_notes();
    Ok(ExitCode::SUCCESS)
}

/// The driver that `--over` names; the first where it names none.
pub fn driver_of(scene: &Scene, over: Option<&str>) -> Result<usize, Faults> {
    let Some(name) = over.filter(|o| *o != "driver") else { return Ok(0) };
    driver_named(scene, name).ok_or_else(|| {
        let names: Vec<String> = (0..scene.drivers.len()).map(|d| sweep::driver_name(scene, d).0).collect();
        let d = Diagnostic::error("no-driver", format!("the scene has no driver `{name}`"));
        d.help(format!("its drivers are {}", names.join(", "))).into()
    })
}

/// Puts other questions in the place of the scene's.
pub fn ask(input: &mut Input, find: Option<&str>) -> Result<(), Failure> {
    let Some(find) = find else { return Ok(()) };
    let words: Vec<&str> = find.split(',').map(str::trim).filter(|w| !w.is_empty()).collect();
    let (name, source) = (input.name.clone(), input.source.clone());
    let text = edit::with_find(&source, &words).map_err(|f| Failure::Input(f, name, source))?;
    match scene::read(&text) {
        Ok(Warned { value, notes }) => {
            (input.scene, input.notes, input.source) = (value, notes, text);
            Ok(())
        }
        Err(faults) => Err(Failure::Input(faults, input.name.clone(), text)),
    }
}

/// The values of a parameter between the bounds of the command line.
fn values(scene: &Scene, variation: &Variation, name: &str, a: &Sweep) -> Result<Span, Faults> {
    let (from, to) = (bound(a.range.from.as_deref(), "--from")?, bound(a.range.to.as_deref(), "--to")?);
    variation.span(scene, name, &from, &to, a.range.steps.unwrap_or(STEPS))
}

fn bound(text: Option<&str>, name: &str) -> Result<String, Faults> {
    text.map(str::to_owned).ok_or_else(|| {
        Diagnostic::error("range", format!("{name} is missing")).help("a parameter has no natural range: give --from and --to").into()
    })
}

/// A driver by the name of its column: `phi_1`, `s_B`, `l_BC`; `driver` and `driver2` count.
pub fn driver_named(scene: &Scene, name: &str) -> Option<usize> {
    (0..scene.drivers.len()).find(|&d| sweep::driver_name(scene, d).0 == name || name == format!("driver{}", d + 1))
}

/// The stations of a driver between two values as the scene would write them; without them a full turn where it turns, and as far
/// as it goes where it slides.
pub fn stations(placed: &Placed, driver: usize, range: &Range, count: usize) -> Result<Stations, Faults> {
    Ok(steps(placed, driver, range, count)?.all())
}

fn steps(placed: &Placed, driver: usize, range: &Range, steps: usize) -> Result<Steps, Faults> {
    let (from, to) = (range.from.as_deref(), range.to.as_deref());
    let Some(d) = placed.scene.drivers.get(driver) else {
        return Err(Diagnostic::error("no-driver", "the scene has no driver").into());
    };
    if let DriverKind::Turn { .. } = d.kind {
        let [from, to] = edit::angles(from.unwrap_or("0"), to.unwrap_or("360"))?;
        return Ok(Steps { way: Way::Turn(from, to), steps });
    }
    let per_value = station::angle_per_value(placed.scene, &placed.at, driver);
    let [from, to] = match (from, to) {
        (Some(from), Some(to)) => [edit::length(from)?, edit::length(to)?],
        _ => {
            let [low, high] = extreme::limits(placed.scene, placed.mechanism, driver)?.range.bounds();
            let given = |text: Option<&str>, default: f64| text.map_or(Ok(default), edit::length);
            [given(from, low)?, given(to, high)?]
        }
    };
    Ok(Steps { way: Way::Slide { from, to, per_value }, steps })
}
