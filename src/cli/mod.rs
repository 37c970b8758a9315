//! The command line: the only place that reads arguments and files, prints, and decides exit codes.
//!
//! Exit codes: 0 done; 1 a file could not be written; 2 bad input; 3 drawing and analysis disagree, which is an error of
//! ours; 4 done, but for answers that do not exist in the pose (dead centres); 130 interrupted while a file was written.

mod args;
mod batch;
mod curves;
mod draw;
mod files;
mod long;
mod part;
mod path;
mod spool;
mod stop;
mod sweep;
mod tables;
mod values;
mod worksheet;

use crate::accuracy::{certify, steps, ways};
use crate::diag::{Diagnostic, Faults, Warned};
use crate::effort::Work;
use crate::figure::font::own::Fonts;
use crate::figure::sheet;
use crate::figure::style::Style;
use crate::plan::notation::Notation;
use crate::plan::text::Writer;
use crate::report::{answers, construction, diagnostics, drafting as tolerances, plan as plan_text, plan_json, price};
use crate::scene::{self, Lang, Scene, edit, templates};
use crate::worked::{Scope, Worked, work};
use args::{Args, Command, Common};
use clap::Parser;
use draw::style_of;
use std::process::ExitCode;
use std::time::Duration;

/// Runs the program.
pub fn main() -> ExitCode {
    let args = Args::parse();
    let result = match args.command {
        Command::Draw(a) => draw::run(a),
        Command::Lesson(a) => lesson(a),
        Command::Solve(a) => solve(a),
        Command::Plan(a) => plan(a),
        Command::Worksheet(a) => worksheet::run(a),
        Command::Accuracy(a) => accuracy(a),
        Command::Sweep(a) => sweep::sweep(a),
        Command::Batch(a) => batch::batch(a),
        Command::Curves(a) => curves::run(a),
        Command::Path(a) => path::run(a),
        Command::Limits(a) => sweep::limits(a),
        Command::New { template, set, output } => new(&template, &set, output.as_deref()),
        Command::Templates => list_templates(),
        Command::Schema => files::print(scene::schema::schema()),
    };
    match result {
        Ok(code) => code,
        Err(Failure::Input(faults, name, source)) => {
            eprint!("{}", diagnostics::render(&faults, &name, &source));
            ExitCode::from(2)
        }
        Err(Failure::Output(message)) => {
            eprintln!("error: {message}");
            ExitCode::from(1)
        }
        Err(Failure::Interrupted(message)) => {
            eprintln!("interrupted: {message}");
            ExitCode::from(stop::INTERRUPTED)
        }
    }
}

/// Why a run ended early.
enum Failure {
    /// Faults in a scene: the faults, the file's name, its text.
    Input(Faults, String, String),
    /// A file could not be written.
    Output(String),
    /// The user asked to stop; what is left of the work.
    Interrupted(String),
}

type Run = Result<ExitCode, Failure>;

/// A scene file, read.
struct Input {
    name: String,
    source: String,
    scene: Scene,
    notes: Vec<Diagnostic>,
    /// The author's fonts that its figures are set in.
    fonts: Fonts,
}

impl Input {
    fn read(common: &Common) -> Result<Input, Failure> {
        Input::read_as(common, |text| Ok(text.to_owned()))
    }

    /// The scene that the command line names, with its parameters, its text changed.
    fn read_as(common: &Common, change: impl Fn(&str) -> Result<String, Faults>) -> Result<Input, Failure> {
        let path = common.scene.as_str();
        let (name, mut bytes) = files::read(path).map_err(|d| Failure::Input(d.into(), path.into(), String::new()))?;
        if !common.set.is_empty() {
            let values = values::assignments(&common.set).map_err(|f| Failure::Input(f, "--set".into(), String::new()))?;
            // What is no text is told by the reader.
            if let Ok(text) = std::str::from_utf8(&bytes) {
                let text = edit::with_parameters(text, &values).map_err(|f| Failure::Input(f, name.clone(), String::new()))?;
                bytes = text.into_bytes();
            }
        }
        // A text that cannot be changed has a fault, which the reader tells with its place.
        if let Some(changed) = std::str::from_utf8(&bytes).ok().and_then(|text| change(text).ok()) {
            bytes = changed.into_bytes();
        }
        let source = String::from_utf8_lossy(&bytes).into_owned();
        match scene::read(&bytes) {
            Ok(Warned { value, notes }) => Ok(Input { name, source, scene: value, notes, fonts: Fonts::default() }),
            Err(faults) => Err(Failure::Input(faults, name, source)),
        }
    }

    /// The same, its figures to be drawn in a style.
    fn drawn_in(self, style: &Style) -> Input {
        Input { fonts: style.fonts.clone(), ..self }
    }

    /// The scene worked through, its notes added.
    fn work(&mut self, scope: Scope) -> Result<Worked, Failure> {
        match work(&self.scene, scope) {
            Ok(Warned { value, notes }) => {
                self.notes.extend(notes);
                Ok(value)
            }
            Err(faults) => Err(Failure::Input(faults, self.name.clone(), self.source.clone())),
        }
    }

    /// Takes the pencil of the command line; whether tolerances are asked for.
    fn pencil(&mut self, drafting: Option<&str>) -> Result<bool, Failure> {
        if let Some(text) = drafting.filter(|t| !t.is_empty()) {
            let mm = scene::pencil(text).map_err(|faults| Failure::Input(faults, "--drafting".into(), text.into()))?;
            self.scene.paper.pencil_mm = Some(mm);
        }
        Ok(drafting.is_some())
    }

    /// Says what is to be known of the work, and what the author's fonts did not have.
    fn say_notes(&self) {
        let list: Vec<_> = self.notes.iter().cloned().chain(self.fonts.lacking()).collect();
        if !list.is_empty() {
            eprint!("{}", diagnostics::render(&Faults { list }, &self.name, &self.source));
        }
    }
}

/// Language and notation: the command line's, else the scene's, else English and its profile.
fn choices(scene: &Scene, common: &Common) -> (Lang, Notation) {
    let lang = common.lang.map(Lang::from).or(scene.language).unwrap_or_default();
    let notation = common.notation.as_deref().or(scene.notation.as_deref()).and_then(Notation::named);
    (lang, notation.unwrap_or_else(|| Notation::of_language(lang)))
}

/// 3 where drawing and analysis disagree, 4 where an answer does not exist in the pose, else 0.
fn verdict(worked: &Worked) -> ExitCode {
    match (agrees(worked), worked.unanswered.is_empty()) {
        (false, _) => ExitCode::from(3),
        (true, false) => ExitCode::from(4),
        (true, true) => ExitCode::SUCCESS,
    }
}

/// Whether drawing and analysis agree on every answer.
fn agrees(worked: &Worked) -> bool {
    worked.results.iter().all(|r| r.agreement.is_none_or(|a| a.holds()))
}

/// The endings that a lesson's file may have.
const LESSONS: [&str; 2] = ["html", "htm"];

fn lesson(a: args::Lesson) -> Run {
    if let Some(path) = a.output.as_deref().filter(|p| files::ending(p).is_some_and(|e| !LESSONS.contains(&e))) {
        let d = Diagnostic::error("output", format!("{path} does not end in .html")).help("write -o lesson.html");
        return Err(Failure::Input(d.into(), path.into(), String::new()));
    }
    let style = style_of(&a.look)?;
    let mut input = Input::read(&a.common)?.drawn_in(&style);
    let (lang, notation) = choices(&input.scene, &a.common);
    let notation = style.marks.over(&notation);
    let failed = |faults: Faults| Failure::Input(faults, input.name.clone(), input.source.clone());
    let made = if a.reveal {
        let Warned { value: worked, notes } = work(&input.scene, Scope::Figure).map_err(failed)?;
        input.notes.extend(notes);
        let options = sheet::Options { notation, style, ..sheet::Options::of_language(lang) };
        crate::lesson::reveal(&input.scene, &worked, &options)
    } else {
        let options = crate::lesson::Options { lang, notation, positions: a.positions as usize, driver: a.driver as usize - 1, style };
        crate::lesson::lesson(&input.scene, &options)
    };
    let Warned { value, notes } = made.map_err(|faults| Failure::Input(faults, input.name.clone(), input.source.clone()))?;
    input.notes.extend(notes);
    let path = a.output.unwrap_or_else(|| format!("{}.html", files::stem(&input.name, "lesson")));
    files::write(std::path::Path::new(&path), value.as_bytes())?;
    files::print(&format!("{path}\n"))?;
    input.say_notes();
    Ok(ExitCode::SUCCESS)
}

fn solve(a: args::Solve) -> Run {
    let mut input = Input::read(&a.common)?;
    let drafting = input.pencil(a.drafting.as_deref())?;
    let mut worked = input.work(Scope::Questions)?;
    if drafting {
        worked = worked.with_drafting(&input.scene);
    }
    let (lang, notation) = choices(&input.scene, &a.common);
    let certified = certify(&input.scene, &worked, a.digits);
    if a.json {
        let value = answers::json(&input.scene, &worked, &certified, a.digits, &input.notes);
        files::print(&format!("{value:#}\n"))?;
        return Ok(verdict(&worked));
    }
    files::print(&answers::text(&input.scene, &worked, &certified, a.digits, lang))?;
    let w = Writer { scene: &input.scene, plan: &worked.plan, notation: &notation, lang };
    if drafting || a.steps {
        let steps = steps(&input.scene, &worked, worked.drafting.as_ref().map(|d| d.pencil_mm));
        if drafting {
            files::print(&format!("\n{}", tolerances::text(&w, &worked, &steps)))?;
        }
        if a.steps {
            files::print(&format!("\n{}", construction::text(&w, &worked.construction, &steps)))?;
        }
    }
    input.say_notes();
    Ok(verdict(&worked))
}

fn plan(a: args::Plan) -> Run {
    let input = Input::read(&a.common)?;
    let (lang, notation) = choices(&input.scene, &a.common);
    if a.json {
        return plan_for_programs(input, lang, &notation, a.figure);
    }
    let (mechanism, mut notes) = match crate::mechanism::Mechanism::new(&input.scene) {
        Ok(Warned { value, notes }) => (value, notes),
        Err(faults) => return Err(Failure::Input(faults, input.name, input.source)),
    };
    let demand = crate::mechanism::Demand::of(&input.scene, &mechanism);
    let plan = crate::plan::plan(&input.scene, &mechanism, &demand);
    let w = Writer { scene: &input.scene, plan: &plan, notation: &notation, lang };
    files::print(&plan_text::text(&input.scene, &mechanism, &w))?;
    notes.extend(input.notes);
    if !notes.is_empty() {
        eprint!("{}", diagnostics::render(&Faults { list: notes }, &input.name, &input.source));
    }
    Ok(ExitCode::SUCCESS)
}

/// The plan and what was done for it. A plan needs no numbers: where the pose cannot be solved it stands alone, and the
/// notes say why.
fn plan_for_programs(mut input: Input, lang: Lang, notation: &Notation, figure: bool) -> Run {
    let fail = |input: &Input, faults| Failure::Input(faults, input.name.clone(), input.source.clone());
    let mut code = ExitCode::SUCCESS;
    let document = match work(&input.scene, if figure { Scope::Figure } else { Scope::Questions }) {
        Ok(Warned { value: worked, notes }) => {
            input.notes.extend(notes);
            // What has no answer in the pose is no fault of the plan.
            code = if agrees(&worked) { code } else { verdict(&worked) };
            let certified = certify(&input.scene, &worked, answers::DIGITS);
            let mut done = Work::of(&worked).with_certified(&certified);
            if figure {
                let options = sheet::Options { notation: notation.clone(), ..sheet::Options::of_language(lang) };
                done = done.with_figure(&sheet::sheet(&input.scene, &worked, &options).map_err(|f| fail(&input, f))?);
            }
            let w = Writer { scene: &input.scene, plan: &worked.plan, notation, lang };
            plan_json::json(&worked.mechanism, &worked.demand, &w, Some((&worked, done)), &input.notes)
        }
        Err(faults) => {
            let mechanism = crate::mechanism::Mechanism::new(&input.scene).map_err(|f| fail(&input, f))?.value;
            let demand = crate::mechanism::Demand::of(&input.scene, &mechanism);
            let plan = crate::plan::plan(&input.scene, &mechanism, &demand);
            let w = Writer { scene: &input.scene, plan: &plan, notation, lang };
            input.notes.extend(faults.list);
            plan_json::json(&mechanism, &demand, &w, None, &input.notes)
        }
    };
    files::print(&format!("{document:#}\n"))?;
    Ok(code)
}

fn accuracy(a: args::Accuracy) -> Run {
    let style = style_of(&a.look)?;
    let mut input = Input::read(&a.common)?.drawn_in(&style);
    let worked = input.work(Scope::Questions)?;
    let (lang, _) = choices(&input.scene, &a.common);
    let patience = Duration::from_millis(a.patience);
    let failed = |faults: Faults| Failure::Input(faults, input.name.clone(), input.source.clone());
    let measured = ways::measure(&input.scene, &worked, patience).map_err(failed)?;
    let series = if a.toward_toggle { ways::toward_toggle(&input.scene, patience).map_err(failed)? } else { Vec::new() };
    if let Some(path) = &a.output {
        let figure = crate::figure::price::figure(&input.scene, &measured, &series, &style, lang);
        input.notes.extend(files::figure(&figure, path)?);
    }
    if a.json {
        files::print(&format!("{:#}\n", price::json(&measured, &series)))?;
    } else {
        files::print(&price::text(&input.scene, &measured, lang))?;
        if !series.is_empty() {
            files::print(&format!("\n{}", price::series_text(&series, lang)))?;
        }
    }
    input.say_notes();
    Ok(ExitCode::SUCCESS)
}

fn new(template: &str, set: &[String], output: Option<&str>) -> Run {
    let bad = |faults: Faults| Failure::Input(faults, template.to_string(), String::new());
    let values = values::assignments(set).map_err(bad)?;
    let text = templates::instantiate(template, &values).map_err(bad)?;
    match output {
        Some(path) => files::write(std::path::Path::new(path), text.as_bytes())?,
        None => {
            files::print(&text)?;
        }
    }
    Ok(ExitCode::SUCCESS)
}

fn list_templates() -> Run {
    let mut out = String::new();
    for t in templates::list() {
        out.push_str(&format!("{}\n    {} · {}\n", t.name, t.title.en, t.title.zh));
        let parameters: Vec<String> = t.parameters.iter().map(|(n, v)| format!("{n}={v}")).collect();
        if !parameters.is_empty() {
            out.push_str(&format!("    {}\n", parameters.join("  ")));
        }
    }
    files::print(&out)
}
