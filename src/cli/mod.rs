//! The command line: the only place that reads arguments and files, prints, and decides exit codes.
//!
//! Exit codes: 0 done; 1 a file could not be written, or the figures of `diff` differ; 2 bad input; 3 drawing and analysis disagree, which is an error of
//! ours; 4 done, but for answers that do not exist in the pose (dead centres); 130 interrupted while a file was written.

mod animate;
mod args;
mod attempts;
mod batch;
mod cam;
mod centres;
mod composite;
mod curvature;
mod curves;
mod diff;
mod draw;
mod files;
mod help;
mod ids;
mod inversions;
mod journal;
mod lang;
mod long;
mod mobility;
mod part;
mod particle;
mod path;
mod plan;
mod readings;
mod spool;
mod stop;
mod sweep;
mod synth;
mod tables;
mod target;
mod template;
mod together;
mod values;
mod worksheet;

use crate::certified::{certify, steps};
use crate::diag::{Both, Diagnostic, Faults, Span, Warned, both};
use crate::effort::Work;
use crate::effort::ways;
use crate::figure::sheet;
use crate::paper::font::own::Fonts;
use crate::paper::style::Style;
use crate::plan::notation::Notation;
use crate::plan::text::Writer;
use crate::report::{answers, construction, diagnostics, drafting as tolerances, plan as plan_text, plan_json, price, statement, trains};
use crate::scene::{self, Lang, Scene, Swept};
use crate::sweep::follow::course;
use crate::worked::{NoAnswer, Scope, Unanswered, Worked, instant, work};
use args::{Args, Command, Common};
use clap::FromArgMatches;
use draw::style_of;
use std::ffi::OsString;
use std::process::ExitCode;
use std::time::{Duration, Instant};

/// Runs the program.
pub fn main() -> ExitCode {
    let given: Vec<OsString> = std::env::args_os().collect();
    let asked = help::asked(&given);
    asked.into_iter().for_each(lang::ask);
    let of_help = asked.unwrap_or_else(help::of_the_machine);
    let args = match help::command(of_help).try_get_matches_from(given).and_then(|m| Args::from_arg_matches(&m)) {
        Ok(args) => args,
        Err(e) => return usage(&e, of_help),
    };
    args.lang.into_iter().for_each(|l| lang::ask(l.into()));
    let result = match args.command {
        Command::Draw(a) => draw::run(a),
        Command::Lesson(a) => lesson(a),
        Command::Solve(a) => solve(a),
        Command::Plan(a) => plan::run(a),
        Command::Worksheet(a) => worksheet::run(a),
        Command::Accuracy(a) => accuracy(a),
        Command::Sweep(a) => sweep::sweep(a),
        Command::Batch(a) => batch::batch(a),
        Command::Curves(a) => curves::run(a),
        Command::Path(a) => path::run(a),
        Command::Animate(a) => animate::run(a),
        Command::Cam(a) => cam::run(a),
        Command::Limits(a) => sweep::limits(a),
        Command::Mobility(a) => mobility::run(a),
        Command::Centres(a) => centres::run(a),
        Command::Inversions(a) => inversions::run(a),
        Command::Curvature(a) => curvature::run(a),
        Command::Composite(a) => composite::run(a),
        Command::Attempts(a) => attempts::run(a),
        Command::Synth(a) => synth::run(a),
        Command::Readings(a) => readings::run(a),
        Command::Diff(a) => diff::run(a),
        Command::New { template, set, output } => template::new(template.as_deref(), &set, output.as_deref()),
        Command::Templates => template::list(),
        Command::Schema { synthesis: true, .. } => files::print(crate::synthesis::schema::schema()),
        Command::Schema { motions: true, .. } => files::print(crate::particle::schema::schema()),
        Command::Schema { .. } => files::print(scene::schema::schema()),
    };
    result.unwrap_or_else(Failure::say)
}

/// Help and version, or what is wrong with the arguments.
fn usage(e: &clap::Error, of_help: Lang) -> ExitCode {
    let code = u8::try_from(e.exit_code()).unwrap_or(2);
    let plain = help::said(e, of_help);
    // An argument is quoted as it was given; what a terminal would obey is not, and then the colours are gone too.
    // The colours go with the English of the library.
    if diagnostics::visible(&plain) != plain || of_help != Lang::En && e.use_stderr() {
        files::say(&plain);
        return ExitCode::from(code);
    }
    if of_help != Lang::En {
        return files::print(&plain).unwrap_or_else(Failure::say);
    }
    match e.print() {
        Err(io) if !e.use_stderr() && io.kind() != std::io::ErrorKind::BrokenPipe => {
            Failure::Output(both!("standard output: {}", "标准输出：{}", files::reason(&io))).say()
        }
        _ => ExitCode::from(code),
    }
}

/// Why a run ended early.
enum Failure {
    /// Something is wrong with a scene, an argument, or a file that was named.
    Input(Vec<Told>),
    /// A file could not be written.
    Output(Both),
    /// The user asked to stop; what is left of the work.
    Interrupted(Both),
}

/// Faults, and the text in which their places count.
struct Told {
    faults: Faults,
    name: String,
    source: String,
}

impl Told {
    /// Faults of an argument, each at its place there; what has no place is about all of it.
    fn argument(option: &str, text: &str, faults: impl Into<Faults>) -> Told {
        let whole = (!text.is_empty()).then(|| Span::new(0, text.len()));
        let mut faults = faults.into();
        for d in &mut faults.list {
            d.span = d.span.filter(|s| s.end <= text.len()).or(whole);
        }
        Told { faults, name: option.into(), source: text.into() }
    }
}

impl Failure {
    /// Faults of a file.
    fn input(faults: impl Into<Faults>, name: &str, source: &str) -> Failure {
        Failure::Input(vec![Told { faults: faults.into(), name: name.into(), source: source.into() }])
    }

    /// Faults of an argument.
    fn argument(option: &str, text: &str, faults: impl Into<Faults>) -> Failure {
        Failure::Input(vec![Told::argument(option, text, faults)])
    }

    /// Says it; returns the exit code that is due, whether anybody could hear it or not.
    fn say(self) -> ExitCode {
        match self {
            Failure::Input(all) => {
                all.iter().for_each(|t| files::say_faults(&t.faults, &t.name, &t.source));
                ExitCode::from(2)
            }
            Failure::Output(message) => {
                files::say(lang::of(&both!("error: {}\n", "错误：{}\n", message)));
                ExitCode::from(1)
            }
            Failure::Interrupted(message) => {
                files::say(lang::of(&both!("interrupted: {}\n", "已中断：{}\n", message)));
                ExitCode::from(stop::INTERRUPTED)
            }
        }
    }
}

type Run = Result<ExitCode, Failure>;

/// How a file's bytes become a scene.
type Reader<'a> = &'a dyn Fn(&[u8]) -> Result<Warned<Scene>, Faults>;

/// A scene file, read.
struct Input {
    name: String,
    source: String,
    scene: Scene,
    notes: Vec<Diagnostic>,
    /// The author's fonts that its figures are set in.
    fonts: Fonts,
    /// The questions of the command line, which replace those of the scene.
    asked: Option<String>,
}

impl Input {
    /// The scene that the command line names; one without a rate where nothing that it asks depends on it.
    fn read(common: &Common) -> Result<Input, Failure> {
        Ok(Input::read_by(common, &|bytes| scene::read_at_any_rate(bytes))?.going_on())
    }

    /// The same for what does not depend on rates.
    fn read_at_rest(common: &Common) -> Result<Input, Failure> {
        Input::read_by(common, &|bytes| scene::read_at_rest(bytes))
    }

    /// Its links and pairs; the rest may be missing.
    fn read_topology(common: &Common) -> Result<Input, Failure> {
        Input::read_by(common, &|bytes| scene::read_topology(bytes))
    }

    /// The scene that the command line names, with its parameters.
    fn read_by(common: &Common, read: Reader) -> Result<Input, Failure> {
        let (name, bytes) = values::file(&common.scene, &common.set)?;
        let source = String::from_utf8_lossy(&bytes).into_owned();
        scene::language_of(&bytes).into_iter().for_each(lang::take);
        if crate::synthesis::is_task(&bytes) {
            return Err(Failure::input(synth::no_scene(), &name, &source));
        }
        if crate::particle::is_problem(&bytes) {
            return Err(Failure::input(particle::no_scene(), &name, &source));
        }
        match read(&bytes) {
            Ok(Warned { value, .. }) if statement::faults(&value).has_errors() => {
                Err(Failure::input(statement::faults(&value), &name, &source))
            }
            Ok(Warned { value, notes }) => Ok(Input { name, source, scene: value, notes, fonts: Fonts::default(), asked: None }),
            Err(faults) => Err(Failure::input(faults, &name, &source)),
        }
    }

    /// Diagnostics of the scene, each in the text in which its place counts: the file, or the questions of the command line.
    fn told(&self, faults: Faults) -> Vec<Told> {
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
        let file = Told { faults: of_file, name: self.name.clone(), source: self.source.clone() };
        let asked = self.asked.iter().map(|text| Told::argument("--find", text, std::mem::take(&mut of_asked)));
        std::iter::once(file).chain(asked).filter(|t| !t.faults.list.is_empty()).collect()
    }

    /// The end of a run with faults of the scene.
    fn failed(&self, faults: Faults) -> Failure {
        Failure::Input(self.told(faults))
    }

    /// The same, its figures to be drawn in a style.
    fn drawn_in(self, style: &Style) -> Input {
        Input { fonts: style.fonts.clone(), ..self }
    }

    /// At a joint of two pieces of a cam's profile, on the piece that follows.
    fn going_on(mut self) -> Input {
        let Warned { value, notes } = instant(self.scene);
        self.scene = value;
        self.notes.extend(notes);
        self
    }

    /// For its whole motion: cams whose equivalent linkage is right at the instant only move their followers by what their profiles make.
    fn over_a_turn(&mut self) {
        self.scene = course::over_a_turn(&self.scene);
        let kept: Vec<Diagnostic> = self
            .scene
            .kept_cams()
            .map(|c| {
                let (cam, follower) = (self.scene.link_name(c.cam), self.scene.link_name(c.follower));
                let message = both!(
                    "beyond the instant, cam `{cam}` is taken to go on with the piece of its profile that `{follower}` touches now",
                    "在此瞬时之外，凸轮 `{cam}` 仍按从动件 `{follower}` 此刻所接触的廓线段计算"
                );
                let warning = Diagnostic::warning("cam-piece", message).at(c.span);
                if c.posed.is_some() {
                    return warning;
                }
                warning.help(both!(
                    "give the face a line of the follower that begins in its pivot, such as \"line\": \"CF\": then the contact goes from piece to piece",
                    "请给出平底在从动件上的直线（自转轴起），如 \"line\": \"CF\"，则接触点随廓线逐段移动"
                ))
            })
            .collect();
        kept.into_iter().for_each(|d| self.notes.push(d));
    }

    /// The scene worked through, its notes added.
    fn work(&mut self, scope: Scope) -> Result<Worked, Failure> {
        match work(&self.scene, scope) {
            Ok(Warned { value, notes }) => {
                self.notes.extend(notes);
                Ok(value)
            }
            Err(faults) => Err(self.failed(faults)),
        }
    }

    /// Takes the pencil of the command line; whether tolerances are asked for.
    fn pencil(&mut self, drafting: Option<&str>) -> Result<bool, Failure> {
        if let Some(text) = drafting.filter(|t| !t.is_empty()) {
            let mm = scene::pencil(text).map_err(|faults| Failure::argument("--drafting", text, faults))?;
            self.scene.paper.pencil_mm = Some(mm);
        }
        Ok(drafting.is_some())
    }

    /// Says what is to be known of the work, and what the author's fonts did not have.
    fn say_notes(&self) {
        let list: Vec<_> = self.notes.iter().cloned().chain(self.fonts.lacking()).collect();
        self.told(Faults { list }).iter().for_each(|t| files::say_faults(&t.faults, &t.name, &t.source));
    }
}

/// Language and notation: the command line's, else the scene's, else English and its profile.
fn choices(scene: &Scene, common: &Common) -> (Lang, Notation) {
    let lang = lang::asked().or(scene.language).unwrap_or_default();
    let notation = common.notation.as_deref().or(scene.notation.as_deref()).and_then(Notation::named);
    (lang, notation.unwrap_or_else(|| Notation::of_language(lang)))
}

/// 3 where drawing and analysis disagree, 4 where an answer does not exist in the pose, else 0; that a radius is infinite is an answer.
fn verdict(worked: &Worked) -> ExitCode {
    let infinite = |u: &Unanswered| matches!(u.why, NoAnswer::Infinite(_));
    match (agrees(worked), worked.unanswered.iter().all(infinite)) {
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
    if let Some(path) = a.output.as_deref().filter(|p| files::ending(p).is_some_and(|e| !LESSONS.contains(&e.as_str()))) {
        let d = Diagnostic::error("output", both!("{path} does not end in .html", "{path} 不以 .html 结尾"))
            .help(both!("write -o lesson.html", "请写 -o lesson.html"));
        return Err(Failure::argument("-o", path, d));
    }
    let style = style_of(&a.look)?;
    ids::of_lesson(&a)?;
    if synth::is_task(&a.common.scene) {
        return synth::lesson(&a, style);
    }
    synth::no_pick(a.pick)?;
    if particle::is_problem(&a.common.scene) {
        return particle::lesson(&a, style);
    }
    let mut input = Input::read(&a.common)?.drawn_in(&style);
    if !a.reveal {
        input.over_a_turn();
    }
    let worked = input.work(Scope::Figure)?;
    let (lang, notation) = choices(&input.scene, &a.common);
    let notation = style.marks.over(&notation);
    let made = if a.reveal {
        let options = sheet::Options { notation, style, ..sheet::Options::of_language(lang) };
        crate::lesson::reveal(&input.scene, &worked, &options)
    } else {
        let swept = match a.driver {
            Some(number) => Swept::Driver(number as usize - 1),
            None => sweep::swept_of(&input.scene, a.moves.over.as_deref())?,
        };
        let options = crate::lesson::Options { lang, notation, positions: a.positions as usize, swept, style };
        crate::lesson::of_worked(&input.scene, &worked, &options)
    };
    let Warned { value, notes } = made.map_err(|faults| input.failed(faults))?;
    input.notes.extend(notes);
    let path = a.output.unwrap_or_else(|| format!("{}.html", files::stem(&input.name, "lesson")));
    files::write(std::path::Path::new(&path), ids::put_before(&value).as_bytes())?;
    files::print_names(&format!("{path}\n"))?;
    input.say_notes();
    Ok(verdict(&worked))
}

fn solve(a: args::Solve) -> Run {
    if particle::is_problem(&a.common.scene) {
        return particle::solve(&a);
    }
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
    files::print(&trains::text(&input.scene, &worked, lang))?;
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

fn accuracy(a: args::Accuracy) -> Run {
    let style = style_of(&a.look)?;
    let mut input = Input::read(&a.common)?.drawn_in(&style);
    let worked = input.work(Scope::Questions)?;
    let (lang, _) = choices(&input.scene, &a.common);
    let start = Instant::now();
    let watch = ways::Watch { now: &|| start.elapsed(), patience: Duration::from_millis(a.patience) };
    let measured = ways::measure(&input.scene, &worked, watch).map_err(|f| input.failed(f))?;
    let series = if a.toward_toggle { ways::toward_toggle(&input.scene, watch).map_err(|f| input.failed(f))? } else { Vec::new() };
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
