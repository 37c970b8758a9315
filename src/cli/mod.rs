//! The command line: the only module that reads arguments and files, prints, and decides exit
//! codes.
//!
//! Exit codes: 0 done; 1 a file could not be written, the figures of `diff` differ, or
//! `shards verify` finds missing or damaged parts; 2 bad input;
//! 3 drawing and analysis disagree, which is an error of this program; 4 done, but some answers do
//! not exist in the pose (dead centres); 130 interrupted while a file was written.

mod animate;
mod args;
mod attempts;
mod batch;
mod cam;
mod centres;
mod compare;
mod composite;
mod curvature;
mod curves;
mod cycle;
mod diff;
mod draw;
mod edit;
mod errors;
mod explain;
mod export;
mod files;
mod help;
mod ids;
mod inversions;
mod journal;
mod lang;
mod lesson;
mod long;
mod loops;
mod mark;
mod mobility;
mod page;
mod part;
pub mod parts;
mod path;
mod places;
mod plan;
mod readings;
mod shards;
mod spool;
mod stop;
mod sweep;
mod synth;
mod tables;
mod target;
mod teeth;
mod template;
mod together;
mod values;
mod variants;
mod worksheet;

use crate::diag::{Both, Diagnostic, Faults, Span, Warned, both};
use crate::effort::ways;
use crate::notation::Notation;
use crate::paper::font::own::Fonts;
use crate::paper::style::Style;
use crate::problem::{self, Extent, Kind, Look, Problem, Solved, Verdict, Wish};
use crate::report::{diagnostics, price};
use crate::scene::{self, Lang, Scene};
use crate::worked::{Scope, Worked, work};
use args::{Args, Command, CommonArgs};
use clap::FromArgMatches;
use draw::style_of;
use parts::PartFault;
use std::ffi::OsString;
use std::process::ExitCode;
use std::time::{Duration, Instant};
use values::FaultFormat;

/// Runs the program.
pub fn main() -> ExitCode {
    stop::own();
    let code = run();
    errors::finish();
    code
}

fn run() -> ExitCode {
    let given: Vec<OsString> = std::env::args_os().collect();
    // Faults of the arguments have the same form.
    if help::given(&given, "--errors", FaultFormat::named) == Some(FaultFormat::Json) {
        errors::collect();
    }
    let asked = help::given(&given, "--lang", Lang::named);
    asked.into_iter().for_each(lang::ask);
    let of_help = asked.unwrap_or_else(help::of_the_machine);
    let args = match help::command(of_help)
        .try_get_matches_from(given)
        .and_then(|m| Args::from_arg_matches(&m))
    {
        Ok(args) => args,
        Err(e) => return usage(&e, of_help),
    };
    args.lang.into_iter().for_each(|l| lang::ask(l.into()));
    let result = match args.command {
        Command::Draw(a) => draw::run(a),
        Command::Lesson(a) => lesson::run(a),
        Command::Solve(a) => solve(a),
        Command::Plan(a) => plan::run(a),
        Command::Worksheet(a) => worksheet::run(a),
        Command::Variants(a) => variants::run(a),
        Command::Mark(a) => mark::run(&a),
        Command::Accuracy(a) => accuracy(a),
        Command::Sweep(a) => sweep::sweep(a),
        Command::Batch(a) => batch::batch(a),
        Command::Shards(a) => shards::run(&a),
        Command::Curves(a) => curves::run(a),
        Command::Path(a) => path::run(a),
        Command::Animate(a) => animate::run(a),
        Command::Cam(a) => cam::run(a),
        Command::Compare(a) => compare::run(a),
        Command::Cycle(a) => cycle::run(a),
        Command::Limits(a) => sweep::limits(a),
        Command::Mobility(a) => mobility::run(a),
        Command::Centres(a) => centres::run(a),
        Command::Inversions(a) => inversions::run(a),
        Command::Curvature(a) => curvature::run(a),
        Command::Composite(a) => composite::run(a),
        Command::Loops(a) => loops::run(&a),
        Command::Teeth(a) => teeth::run(&a),
        Command::Attempts(a) => attempts::run(a),
        Command::Synth(a) => synth::run(a),
        Command::Readings(a) => readings::run(a),
        Command::Diff(a) => diff::run(a),
        Command::Edit(a) => edit::run(a),
        Command::Export(a) => export::export(a),
        Command::Import(a) => export::import(&a),
        Command::Mdbook { asked, renderer } => {
            export::mdbook(asked.as_deref(), renderer.as_deref())
        }
        Command::New { template, set, output } => {
            template::new(template.as_deref(), &set, output.as_deref())
        }
        Command::Explain(a) => explain::run(a),
        Command::Templates => template::list(),
        Command::Schema { synthesis: true, .. } => files::print(problem::schema(Kind::Task)),
        Command::Schema { motions: true, .. } => files::print(problem::schema(Kind::Motion)),
        Command::Schema { equation: true, .. } => files::print(problem::schema(Kind::Equation)),
        Command::Schema { solved: true, .. } => files::print(include_str!("schema/solved.json")),
        Command::Schema { diagnostics: true, .. } => {
            files::print(include_str!("schema/errors.json"))
        }
        Command::Schema { .. } => files::print(problem::schema(Kind::Scene)),
    };
    result.unwrap_or_else(Failure::report)
}

/// Prints help and version, or the faults of the arguments.
fn usage(e: &clap::Error, of_help: Lang) -> ExitCode {
    let code = u8::try_from(e.exit_code()).unwrap_or(2);
    if errors::as_json() && e.use_stderr() {
        errors::tell(&help::diagnostic(e).into(), "", "");
        return ExitCode::from(code);
    }
    let plain = help::said(e, of_help);
    // Arguments are quoted as given, without control characters; the colours are then lost too.
    // Texts other than the English of the library have no colours.
    if diagnostics::visible(&plain) != plain || of_help != Lang::En && e.use_stderr() {
        files::write_stderr(&plain);
        return ExitCode::from(code);
    }
    if of_help != Lang::En {
        return files::print(&plain).unwrap_or_else(Failure::report);
    }
    match e.print() {
        Err(io) if !e.use_stderr() && io.kind() != std::io::ErrorKind::BrokenPipe => {
            Failure::Output(both!("standard output: {}", files::reason(&io))).report()
        }
        _ => ExitCode::from(code),
    }
}

/// The reason for which a run ended early.
enum Failure {
    /// A fault in a scene, an argument, or a named file.
    Input(Vec<SourceFaults>),
    /// A file could not be written.
    Output(Both),
    /// The user asked to stop; the text describes the remaining work.
    Interrupted(Both),
}

/// Faults, with the text that their places refer to.
struct SourceFaults {
    faults: Faults,
    name: String,
    source: String,
}

impl SourceFaults {
    /// Faults of an argument, each at its place in it; a fault without a place refers to the whole
    /// argument.
    fn argument(option: &str, text: &str, faults: impl Into<Faults>) -> SourceFaults {
        let whole = (!text.is_empty()).then(|| Span::new(0, text.len()));
        let mut faults = faults.into();
        for d in &mut faults.list {
            d.span = d.span.filter(|s| s.end <= text.len()).or(whole);
        }
        SourceFaults { faults, name: option.into(), source: text.into() }
    }
}

impl Failure {
    /// Returns the failure for faults of a file.
    fn input(faults: impl Into<Faults>, name: &str, source: &str) -> Failure {
        Failure::Input(vec![SourceFaults {
            faults: faults.into(),
            name: name.into(),
            source: source.into(),
        }])
    }

    /// Returns the failure for faults of an argument.
    fn argument(option: &str, text: &str, faults: impl Into<Faults>) -> Failure {
        Failure::Input(vec![SourceFaults::argument(option, text, faults)])
    }

    /// Returns the failure as faults of texts; options are named without their dashes.
    fn told(self) -> Vec<PartFault> {
        let alone = |d: Diagnostic| {
            vec![PartFault { name: String::new(), text: String::new(), faults: d.into() }]
        };
        let one = |t: SourceFaults| PartFault {
            name: t.name.trim_start_matches('-').to_owned(),
            text: t.source,
            faults: t.faults,
        };
        match self {
            Failure::Input(all) => all.into_iter().map(one).collect(),
            Failure::Output(message) => alone(Diagnostic::error("cannot-write", message)),
            Failure::Interrupted(message) => alone(Diagnostic::error("interrupted", message)),
        }
    }

    /// Reports the failure; returns its exit code, even if the report cannot be written.
    fn report(self) -> ExitCode {
        match self {
            Failure::Input(all) => {
                all.iter().for_each(|t| errors::tell(&t.faults, &t.name, &t.source));
                ExitCode::from(2)
            }
            Failure::Output(message) => {
                let line = both!("error: {}\n", message);
                errors::tell_line(&Diagnostic::error("cannot-write", message), lang::of(&line));
                ExitCode::from(1)
            }
            Failure::Interrupted(message) => {
                interrupted(&message);
                ExitCode::from(stop::INTERRUPTED)
            }
        }
    }
}

/// Reports the work that an interrupted run has left undone.
fn interrupted(message: &Both) {
    let line = both!("interrupted: {}\n", message);
    errors::tell_line(&Diagnostic::error("interrupted", message.clone()), lang::of(&line));
}

type CommandResult = Result<ExitCode, Failure>;

/// The file given to a command, with the notes on it.
struct InputFile {
    name: String,
    source: String,
    notes: Vec<Diagnostic>,
    /// The author's fonts of its figures.
    fonts: Fonts,
    /// The questions of the command line, which replace those of the scene.
    asked: Option<String>,
}

impl InputFile {
    /// Opens the file that the command line names, with its parameters.
    fn open(path: &str, set: &[String]) -> Result<InputFile, Failure> {
        let (name, bytes) = values::file(path, set)?;
        let source = String::from_utf8_lossy(&bytes).into_owned();
        let beside = |other: &str| {
            std::path::Path::new(path)
                .parent()
                .filter(|_| path != "-")
                .unwrap_or("".as_ref())
                .join(other)
        };
        let bytes =
            problem::included(bytes, |other| Ok(files::scene(&beside(other).to_string_lossy())?.1))
                .map_err(|faults| Failure::input(faults, &name, &source))?;
        scene::language_of(&bytes).into_iter().for_each(lang::take);
        Ok(InputFile::of(name, String::from_utf8_lossy(&bytes).into_owned()))
    }

    /// A file whose text is known.
    fn of(name: String, source: String) -> InputFile {
        InputFile { name, source, notes: Vec::new(), fonts: Fonts::default(), asked: None }
    }

    /// Reads the file; its notes are kept.
    fn read<T>(
        &mut self,
        read: impl FnOnce(&[u8]) -> Result<Warned<T>, Faults>,
    ) -> Result<T, Failure> {
        let Warned { value, notes } =
            read(self.source.as_bytes()).map_err(|faults| self.failed(faults))?;
        self.notes.extend(notes);
        Ok(value)
    }

    /// Solves a problem.
    fn solve(&mut self, problem: &Problem, options: &problem::Options) -> Result<Solved, Failure> {
        let solved = problem::solve(problem, options).map_err(|faults| {
            match faults.list.iter().any(|d| d.code == "no-candidate") {
                true => Failure::argument("--pick", &(options.candidate + 1).to_string(), faults),
                false => self.failed(faults),
            }
        })?;
        self.notes.extend(solved.notes.iter().cloned());
        Ok(solved)
    }

    /// Diagnostics of the file, each with the text that its place refers to: the file, or the
    /// questions of the command line.
    fn with_sources(&self, faults: Faults) -> Vec<SourceFaults> {
        let (mut of_file, mut of_asked) = (Faults::default(), Faults::default());
        for mut d in faults.list {
            match (d.span.and_then(scene::place_in_asked), &self.asked) {
                (Some(place), Some(_)) => of_asked.push(d.at(place)),
                (Some(_), None) => {
                    d.span = None;
                    of_file.push(d);
                }
                (None, _) => of_file.push(d),
            }
        }
        let file =
            SourceFaults { faults: of_file, name: self.name.clone(), source: self.source.clone() };
        let asked = self
            .asked
            .iter()
            .map(|text| SourceFaults::argument("--find", text, std::mem::take(&mut of_asked)));
        std::iter::once(file).chain(asked).filter(|t| !t.faults.list.is_empty()).collect()
    }

    /// Returns the failure for faults of the file.
    fn failed(&self, faults: Faults) -> Failure {
        Failure::Input(self.with_sources(faults))
    }

    /// Reports the notes if faults are written as JSON; the answers as JSON contain them too.
    fn say_notes_beside_json(&self) {
        if errors::as_json() {
            self.say_notes();
        }
    }

    /// Reports the notes, and the letters that the author's fonts lack.
    fn say_notes(&self) {
        let list: Vec<_> = self.notes.iter().cloned().chain(self.fonts.lacking()).collect();
        self.with_sources(Faults { list })
            .iter()
            .for_each(|t| errors::tell(&t.faults, &t.name, &t.source));
    }
}

/// A scene file that has been read.
struct SceneInput {
    file: InputFile,
    scene: Scene,
}

impl SceneInput {
    /// Reads the scene that the command line names; it may lack a rate on which no question
    /// depends.
    fn read(common: &CommonArgs) -> Result<SceneInput, Failure> {
        SceneInput::of(common, Extent::Motion)
    }

    /// Reads the scene for questions that do not depend on rates.
    fn read_at_rest(common: &CommonArgs) -> Result<SceneInput, Failure> {
        SceneInput::of(common, Extent::Pose)
    }

    fn of(common: &CommonArgs, extent: Extent) -> Result<SceneInput, Failure> {
        SceneInput::of_file(InputFile::open(&common.scene, &common.set)?, extent)
    }

    /// Reads the scene of an open file.
    fn of_file(mut file: InputFile, extent: Extent) -> Result<SceneInput, Failure> {
        let problem = file.read(|bytes| {
            Kind::of(bytes).grants(Wish::Mechanism)?;
            problem::read_as(bytes, extent)
        })?;
        let scene = problem.into_scene().map_err(|d| file.failed(d.into()))?;
        Ok(SceneInput { file, scene })
    }

    /// Reads its links and pairs; all else may be missing.
    fn read_topology(common: &CommonArgs) -> Result<SceneInput, Failure> {
        let mut file = InputFile::open(&common.scene, &common.set)?;
        let scene = file.read(|bytes| {
            Kind::of(bytes).grants(Wish::Mechanism)?;
            scene::read_topology(bytes)
        })?;
        Ok(SceneInput { file, scene })
    }

    /// Returns the failure for faults of the scene.
    fn failed(&self, faults: Faults) -> Failure {
        self.file.failed(faults)
    }

    /// Sets the style of its figures.
    fn drawn_in(mut self, style: &Style) -> SceneInput {
        self.file.fonts = style.fonts.clone();
        self
    }

    /// Changes the scene to its whole motion.
    fn over_a_turn(&mut self) {
        let Warned { value, notes } = problem::whole_motion(self.scene.clone());
        self.scene = value;
        self.file.notes.extend(notes);
    }

    /// Solves the scene and adds its notes.
    fn work(&mut self, scope: Scope) -> Result<Worked, Failure> {
        match work(&self.scene, scope) {
            Ok(Warned { value, notes }) => {
                self.file.notes.extend(notes);
                Ok(value)
            }
            Err(faults) => Err(self.failed(faults)),
        }
    }
}

/// Returns the pencil error of the command line (mm), if given.
fn pencil(drafting: Option<&str>) -> Result<Option<f64>, Failure> {
    let read =
        |text| scene::pencil(text).map_err(|faults| Failure::argument("--drafting", text, faults));
    drafting.filter(|t| !t.is_empty()).map(read).transpose()
}

/// Refuses options that files of a kind do not offer; each comes with its value if the command line
/// has it.
fn granted(kind: Kind, wishes: &[(Option<String>, Wish)]) -> Result<(), Failure> {
    for (value, wish) in wishes.iter().filter_map(|(value, wish)| Some((value.as_ref()?, *wish))) {
        kind.grants(wish).map_err(|d| Failure::argument(wish.option(), value, d))?;
    }
    Ok(())
}

/// Returns language and notation of the command line, else those of the file, with a style and
/// digits.
fn look_of(common: &CommonArgs, style: Style, digits: usize) -> Look {
    Look {
        lang: lang::asked(),
        notation: common.notation.as_deref().and_then(Notation::named),
        style,
        digits,
    }
}

/// Returns language and notation: the command line's, else the scene's, else English and its
/// profile.
fn choices(scene: &Scene, common: &CommonArgs) -> (Lang, Notation) {
    look_of(common, Style::default(), 0).of(scene.language, scene.notation.as_deref())
}

/// Returns 3 if drawing and analysis disagree, 4 if an answer does not exist in the pose, else 0;
/// an infinite radius counts as an answer.
fn verdict(verdict: Verdict) -> ExitCode {
    match verdict {
        Verdict::Answered => ExitCode::SUCCESS,
        Verdict::Disagree => ExitCode::from(3),
        Verdict::Unanswered => ExitCode::from(4),
    }
}

fn solve(a: args::SolveArgs) -> CommandResult {
    let mut file = InputFile::open(&a.common.scene, &a.common.set)?;
    let problem = file.read(|bytes| {
        Kind::of(bytes).grants(Wish::Answers)?;
        problem::read(bytes)
    })?;
    granted(problem.kind(), &[(a.drafting.clone(), Wish::Drafting)])?;
    let pencil_mm = pencil(a.drafting.as_deref())?;
    let options = problem::Options {
        drafting: a.drafting.is_some(),
        pencil_mm,
        ..problem::Options::default()
    };
    let solved = file.solve(&problem, &options)?;
    let look = look_of(&a.common, Style::default(), a.digits);
    if a.json {
        files::print(&format!("{:#}\n", solved.json(&look, false, &file.notes)))?;
        file.say_notes_beside_json();
        return Ok(verdict(solved.verdict()));
    }
    files::print(&solved.text(&look, a.steps))?;
    file.say_notes();
    Ok(verdict(solved.verdict()))
}

fn accuracy(a: args::AccuracyArgs) -> CommandResult {
    places::no_report_beside(a.output.as_deref(), a.json)?;
    let places = a
        .output
        .as_deref()
        .map(|output| places::places(output, &a.format, values::FigureFormat::Svg))
        .transpose()?;
    let style = style_of(&a.look)?;
    let mut input = SceneInput::read(&a.common)?.drawn_in(&style);
    let worked = input.work(Scope::Questions)?;
    let (lang, _) = choices(&input.scene, &a.common);
    let start = Instant::now();
    let watch =
        ways::Watch { now: &|| start.elapsed(), patience: Duration::from_millis(a.patience) };
    let measured = ways::measure(&input.scene, &worked, watch).map_err(|f| input.failed(f))?;
    let series = if a.toward_toggle {
        ways::toward_toggle(&input.scene, watch).map_err(|f| input.failed(f))?
    } else {
        Vec::new()
    };
    if let Some(places) = &places {
        let figure = crate::figure::price::figure(&input.scene, &measured, &series, &style, lang);
        input.file.notes.extend(files::figure(&figure, places)?.notes);
    }
    if a.json {
        files::print(&format!("{:#}\n", price::json(&measured, &series)))?;
    } else {
        files::print(&price::text(&input.scene, &measured, lang))?;
        if !series.is_empty() {
            files::print(&format!("\n{}", price::series_text(&series, lang)))?;
        }
    }
    input.file.say_notes();
    Ok(ExitCode::SUCCESS)
}
