//! Files of motions without a mechanism: `solve`, `draw`, `worksheet` and `lesson` take them as they take scenes.

use super::worksheet::Files;
use super::{Failure, Run, args, draw, errors, files, lang, values};
use crate::diag::{Diagnostic, Faults, Warned, both};
use crate::figure::fit;
use crate::figure::particle as figure;
use crate::figure::sheet;
use crate::lesson::motion;
use crate::paper::item::Figure;
use crate::paper::style::{Marks, Style};
use crate::particle::board::Drawn;
use crate::particle::{self, Problem, Solved, Value, board};
use crate::plan::notation::Notation;
use crate::report::particle as report;
use crate::scene::{self, Lang};
use crate::worksheet::{Options, Sides};
use std::path::Path;
use std::process::ExitCode;

/// A file, read and solved.
struct Input {
    name: String,
    source: String,
    problem: Problem,
    solved: Solved,
    board: Vec<Drawn>,
    notes: Vec<Diagnostic>,
}

/// Whether a file that can be looked at is one of motions without a mechanism.
pub fn is_problem(path: &str) -> bool {
    files::scene(path).is_ok_and(|(_, bytes)| particle::is_problem(&bytes))
}

/// What a command on scenes says of such a file.
pub fn no_scene() -> Diagnostic {
    let d = Diagnostic::error(
        "not-a-scene",
        both!("this file has motions without a mechanism: there are no links", "此文件是无机构的运动：没有构件"),
    );
    d.help(both!("`solve`, `draw`, `worksheet` and `lesson` take it", "请用 `solve`、`draw`、`worksheet`、`lesson`"))
}

impl Input {
    fn read(common: &args::Common) -> Result<Input, Failure> {
        let (name, bytes) = values::file(&common.scene, &common.set)?;
        let source = String::from_utf8_lossy(&bytes).into_owned();
        scene::language_of(&bytes).into_iter().for_each(lang::take);
        let failed = |f: Faults| Failure::input(f, &name, &source);
        let Warned { value: problem, notes } = particle::read(&bytes).map_err(failed)?;
        let solved = particle::solve(&problem).map_err(failed)?;
        let board = board::draw(&problem).map_err(|d| failed(d.into()))?;
        let notes = notes.into_iter().chain(board.iter().filter_map(|d| d.unread.clone())).collect();
        Ok(Input { name, source, problem, solved, board, notes })
    }

    fn lang(&self) -> Lang {
        lang::asked().or(self.problem.language).unwrap_or_default()
    }

    fn failed(&self, faults: impl Into<Faults>) -> Failure {
        Failure::input(faults.into(), &self.name, &self.source)
    }

    fn say(&self, more: Vec<Diagnostic>) {
        let list = self.notes.iter().cloned().chain(more).collect();
        errors::tell(&Faults { list }, &self.name, &self.source);
    }

    /// 3 where drawing and analysis disagree, 4 where an answer does not exist, else 0.
    fn verdict(&self) -> ExitCode {
        let off = |a: &particle::Answer| {
            let drawn = report::drawn(&self.board, self.problem.find[a.find].what);
            let size = report::largest(&self.problem, &self.solved, self.problem.find[a.find].what);
            drawn.and_then(|d| report::apart(&a.value, d, size)).is_some_and(|off| off > 1e-9)
        };
        if self.solved.answers.iter().any(off) {
            return ExitCode::from(3);
        }
        let none = self.solved.answers.iter().any(|a| matches!(a.value, Value::None(_)));
        if none { ExitCode::from(4) } else { ExitCode::SUCCESS }
    }
}

/// Refuses an option that is of scenes.
fn not_of_these(option: &str) -> Failure {
    let d = Diagnostic::error(
        "not-a-scene",
        both!("{option} is of mechanisms, and this file has none", "{option} 只用于机构，而此文件没有机构"),
    );
    Failure::argument(option, "", d.help(both!("leave {option} out", "请去掉 {option}")))
}

/// The notation that the command line names.
fn named(common: &args::Common) -> Option<Notation> {
    common.notation.as_deref().and_then(Notation::named)
}

/// A style with the marks of the notation that the command line names beside its own.
fn marked(style: Style, common: &args::Common) -> Style {
    let marks = named(common).map(|notation| Marks::of(style.marks.over(&notation)));
    Style { marks: marks.unwrap_or_else(|| style.marks.clone()), ..style }
}

/// The answers.
pub fn solve(a: &args::Solve) -> Run {
    if a.drafting.is_some() {
        return Err(not_of_these("--drafting"));
    }
    let input = Input::read(&a.common)?;
    if a.json {
        files::print(&format!("{:#}\n", report::json(&input.problem, &input.solved, &input.board, a.digits, &input.notes)))?;
        if errors::as_json() {
            input.say(Vec::new());
        }
        return Ok(input.verdict());
    }
    let notation = named(&a.common).unwrap_or_else(|| Notation::of_language(input.lang()));
    let steps = a.steps.then_some(&notation);
    files::print(&report::text(&input.problem, &input.solved, &input.board, a.digits, steps, input.lang()))?;
    input.say(Vec::new());
    Ok(input.verdict())
}

/// The figures.
pub fn draw(a: &args::Draw, style: &Style) -> Run {
    for (given, option) in
        [(a.steps, "--steps"), (a.drafting.is_some(), "--drafting"), (a.poses > 0, "--poses"), (!a.path.is_empty(), "--path")]
    {
        if given {
            return Err(not_of_these(option));
        }
    }
    let input = Input::read(&a.common)?;
    let style = marked(style.clone(), &a.common);
    let mut figures: Vec<(String, Figure)> =
        figure::figures(&input.problem, &input.solved, &input.board, &style, input.lang()).map_err(|d| input.failed(d))?;
    if figures.is_empty() {
        let message = both!(
            "there is nothing to draw: no point pursues another one or moves on a plate",
            "没有可画的图：没有追踪运动，也没有在平板上运动的点"
        );
        let help = both!(
            "`hodograph solve` answers what is asked of laws alone; with \"links\" and the points \"on\" the ground it is a scene, which is drawn",
            "仅由运动规律求得的量请用 `hodograph solve`；写出 \"links\" 并令各点在机架上运动（\"on\"），即成为可作图的机构文件"
        );
        return Err(input.failed(Diagnostic::error("no-figure", message).help(help)));
    }
    if let Some(width_mm) = draw::width(a.width.as_deref())? {
        figures = fit::placed(figures, fit::Room::Column(width_mm)).map_err(|f| input.failed(f))?;
    }
    let notes = draw::put(a, &input.name, figures, |f| input.failed(f))?;
    input.say(notes);
    Ok(input.verdict())
}

/// The lesson of a motion: the construction step by step, at an instant that is moved.
pub fn lesson(a: &args::Lesson, style: Style) -> Run {
    if a.reveal {
        return Err(not_of_these("--reveal"));
    }
    let input = Input::read(&a.common)?;
    let options = motion::Options {
        lang: input.lang(),
        style: marked(style, &a.common),
        positions: a.positions as usize,
        motion: a.driver.map_or(0, |number| number as usize - 1),
    };
    let page = motion::lesson(&input.problem, &options).map_err(|f| input.failed(f))?;
    let path = a.output.clone().unwrap_or_else(|| format!("{}.html", files::stem(&input.name, "lesson")));
    files::write(Path::new(&path), page.as_bytes())?;
    files::print_names(&format!("{path}\n"))?;
    input.say(Vec::new());
    Ok(input.verdict())
}

/// Problem and solution.
pub fn worksheet(a: &args::Worksheet, style: Style, sides: Sides, to: &Files) -> Run {
    if a.find_the_mistake.is_some() {
        return Err(not_of_these("--find-the-mistake"));
    }
    let input = Input::read(&a.common)?;
    let options = Options {
        sheet: sheet::Options { style: marked(style, &a.common), digits: a.digits, ..sheet::Options::of_language(input.lang()) },
        sides,
    };
    let document = crate::worksheet::particle(&input.problem, &input.solved, &input.board, &options).map_err(|d| input.failed(d))?;
    let notes = to.write(&document, |f| input.failed(f))?;
    input.say(notes);
    Ok(input.verdict())
}
