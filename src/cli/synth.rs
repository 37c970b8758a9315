//! `hodograph synth`: a synthesis file to candidates, as a table or JSON, and one of them as a scene file.

use super::worksheet::Files;
use super::{Failure, Run, args, draw, errors, files, lang, places, values};
use crate::diag::{Both, Diagnostic, Faults, Warned, both};
use crate::digits::significant;
use crate::figure::fit;
use crate::figure::sheet;
use crate::figure::synthesis as figure;
use crate::json;
use crate::paper::style::Style;
use crate::report::synthesis as report;
use crate::scene;
use crate::synthesis::{self, Design, Task};
use crate::worksheet::{Options, Sides};
use clap::Args as ClapArgs;
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

/// The arguments of the command.
#[derive(ClapArgs, Debug)]
#[command(
    after_help = "Start: hodograph new time-ratio > wish.json && hodograph synth wish.json; the construction: hodograph draw wish.json -o out/; problem and solution: hodograph worksheet wish.json -o sheet.pdf"
)]
pub struct Synth {
    /// The synthesis file; `-` reads standard input
    #[arg(value_name = "FILE")]
    pub file: String,
    /// Give a parameter of the file another value: NAME=VALUE; a bare number keeps the unit
    #[arg(long, value_name = "NAME=VALUE")]
    pub set: Vec<String>,
    /// The candidate that is meant, counted from 1 in the order of the table
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub pick: Option<u64>,
    /// Write the scene of the candidate to this file or to `-`, standard output (default: of the first one)
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<String>,
    /// The candidates as JSON, in SI, with their scenes
    #[arg(long)]
    pub json: bool,
    /// The construction with ruler and paper too, step by step, with the lengths measured
    #[arg(long)]
    pub steps: bool,
    /// Of a search: how long it took, and how many positions it evaluated a second (on standard error)
    #[arg(long)]
    pub speed: bool,
}

/// A synthesis file, read and solved.
pub struct Solved {
    /// Its name.
    pub name: String,
    /// Its text, in which places count.
    pub source: String,
    /// What it says.
    pub task: Task,
    /// What it comes to.
    pub design: Design,
    notes: Vec<Diagnostic>,
}

/// The task with the scene file that it names (`"scene": "linkage.json"`, beside the task) put in its place.
fn with_scene(path: &str, bytes: Vec<u8>) -> Result<Vec<u8>, Failure> {
    let Ok((text, root)) = json::parse(&bytes, &mut Faults::default()) else { return Ok(bytes) };
    let json::Kind::Object(members) = &root.kind else { return Ok(bytes) };
    let named = members.iter().find_map(|(key, node)| match &node.kind {
        json::Kind::Text(name) if key.text == "scene" && name.ends_with(".json") => Some((name, node.span)),
        _ => None,
    });
    let Some((name, span)) = named else { return Ok(bytes) };
    let beside = Path::new(path).parent().filter(|_| path != "-").unwrap_or(Path::new("")).join(name);
    let (_, scene) = files::scene(&beside.to_string_lossy()).map_err(|d| Failure::input(d.at(span), path, text))?;
    let mut out = text.to_owned();
    out.replace_range(span.start..span.end, &String::from_utf8_lossy(&scene));
    Ok(out.into_bytes())
}

impl Solved {
    /// Reads and solves.
    pub fn read(path: &str, set: &[String]) -> Result<Solved, Failure> {
        let (name, bytes) = values::file(path, set)?;
        let bytes = with_scene(path, bytes)?;
        let source = String::from_utf8_lossy(&bytes).into_owned();
        scene::language_of(&bytes).into_iter().for_each(lang::take);
        let Warned { value: task, notes } = synthesis::read(&bytes).map_err(|f| Failure::input(f, &name, &source))?;
        let design = synthesis::solve(&task).map_err(|f| Failure::input(f, &name, &source))?;
        Ok(Solved { name, source, task, design, notes })
    }

    /// The candidate that is meant, counted from 0.
    pub fn picked(&self, pick: Option<u64>) -> Result<usize, Failure> {
        let (wanted, count) = (pick.unwrap_or(1), self.design.candidates.len());
        if wanted >= 1 && wanted <= count as u64 {
            return Ok(wanted as usize - 1);
        }
        let d = Diagnostic::error(
            "no-candidate",
            both!("there is no candidate {wanted}: there are {count}", "没有第 {wanted} 个方案：共有 {count} 个"),
        );
        Err(Failure::argument("--pick", &wanted.to_string(), d))
    }

    fn failed(&self, faults: Faults) -> Failure {
        Failure::input(faults, &self.name, &self.source)
    }

    /// Says what is to be known of the task.
    pub fn say_notes(&self) {
        let list = self.notes.iter().chain(&self.design.notes).cloned().collect();
        errors::tell(&Faults { list }, &self.name, &self.source);
    }
}

/// Runs the command.
pub fn run(a: Synth) -> Run {
    places::no_report_beside(a.output.as_deref(), a.json)?;
    let start = Instant::now();
    let solved = Solved::read(&a.file, &a.set)?;
    let took = start.elapsed().as_secs_f64();
    let picked = solved.picked(a.pick)?;
    let lang = lang::asked().or(solved.task.language).unwrap_or_default();
    if a.speed {
        let told = speed(&solved.design, took);
        errors::tell_line(&Diagnostic::note("speed", told.clone()), &format!("{}\n", lang::of(&told)));
    }
    if let Some(path) = &a.output {
        files::write(Path::new(path), solved.design.candidates[picked].scene_text().as_bytes())?;
    }
    let candidate = &solved.design.candidates[picked];
    if a.json {
        let mut all = report::json(&solved.task, &solved.design);
        if a.steps {
            let board = figure::to_scale(&solved.task, candidate).map_err(|f| solved.failed(f))?;
            all["construction"] = board.map_or(serde_json::Value::Null, |board| report::construction(&board));
        }
        files::print(&format!("{all:#}\n"))?;
    } else if let Some(path) = &a.output {
        files::print_names(&format!("{path}\n"))?;
    } else {
        let mut text = report::text(&solved.task, &solved.design, lang);
        if a.steps {
            match figure::to_scale(&solved.task, candidate).map_err(|f| solved.failed(f))? {
                Some(board) => text += &report::steps(candidate, &board, lang),
                None => text += &format!("\n{}\n", lang.of(&no_construction())),
            }
        }
        files::print(&text)?;
    }
    solved.say_notes();
    Ok(ExitCode::SUCCESS)
}

/// How fast the search was; other kinds have nothing to count.
fn speed(design: &Design, seconds: f64) -> Both {
    let took = significant(seconds, 3);
    match design.numbers.iter().find(|n| n.name == "evaluations") {
        Some(n) => both!(
            "{} positions in {took} s: {} a second",
            "{} 个位置，用时 {took} s：每秒 {} 个",
            n.value,
            significant(n.value / seconds.max(1e-9), 3)
        ),
        None => both!("solved in {took} s", "用时 {took} s"),
    }
}

/// What is said where the construction does not close on paper.
fn no_construction() -> Both {
    both!(
        "This design does not close on paper: its construction with ruler and compasses cannot be drawn.",
        "此设计在图纸上不能装配，无法画出作图步骤。"
    )
}

/// Whether a file that can be looked at is a synthesis file.
pub fn is_task(path: &str) -> bool {
    files::scene(path).is_ok_and(|(_, bytes)| synthesis::is_task(&bytes))
}

/// What a command on scenes says of a synthesis file.
pub fn no_scene() -> Diagnostic {
    let d = Diagnostic::error(
        "not-a-scene",
        both!(
            "this is a synthesis file: it says what a linkage is to do, and is no linkage yet",
            "这是综合文件：只说明机构应实现的运动，还不是机构"
        ),
    );
    d.help(both!(
        "`hodograph synth FILE -o scene.json` makes the scene; `draw`, `worksheet` and `lesson` take the file itself",
        "请用 `hodograph synth FILE -o scene.json` 生成机构文件；`draw`、`worksheet`、`lesson` 可直接用综合文件"
    ))
}

/// Refuses a choice among candidates where there are none.
pub fn no_pick(pick: Option<u64>) -> Result<(), Failure> {
    let Some(pick) = pick else { return Ok(()) };
    let d = Diagnostic::error(
        "no-candidate",
        both!("a scene has no candidates: they are of synthesis files", "机构文件没有方案可选：只有综合文件才有"),
    );
    Err(Failure::argument("--pick", &pick.to_string(), d.help(both!("leave --pick out", "请去掉 --pick"))))
}

/// What a command cannot do with a synthesis file.
fn not_of_tasks(option: &str) -> Failure {
    let d = Diagnostic::error(
        "not-a-scene",
        both!("{option} is of scenes, and this is a synthesis file", "{option} 只用于机构文件，而这是综合文件"),
    );
    let help = both!(
        "leave it out, or make a scene first: `hodograph synth FILE -o scene.json`",
        "请去掉它，或先生成机构文件：`hodograph synth FILE -o scene.json`"
    );
    Failure::argument(option, "", d.help(help))
}

/// The worksheet of a candidate: problem, construction, proof, the linkage, all candidates.
pub fn worksheet(a: &args::Worksheet, style: Style, sides: Sides, to: &Files) -> Run {
    if a.find_the_mistake.is_some() {
        return Err(not_of_tasks("--find-the-mistake"));
    }
    if a.mobility {
        return Err(not_of_tasks("--mobility"));
    }
    let solved = Solved::read(&a.common.scene, &a.common.set)?;
    let picked = solved.picked(a.pick)?;
    let lang = lang::asked().or(solved.task.language).unwrap_or_default();
    let options = Options { sheet: sheet::Options { style, ..sheet::Options::of_language(lang) }, sides };
    let document = crate::worksheet::design(&solved.task, &solved.design, picked, &options).map_err(|f| solved.failed(f))?;
    let list = to.write(&document, |f| solved.failed(f))?;
    solved.say_notes();
    errors::tell(&Faults { list }, &solved.name, &solved.source);
    Ok(ExitCode::SUCCESS)
}

/// The lesson of a candidate: the construction step by step beside the linkage that goes to its wanted positions.
pub fn lesson(a: &args::Lesson, style: Style) -> Run {
    if a.reveal {
        return Err(not_of_tasks("--reveal"));
    }
    let solved = Solved::read(&a.common.scene, &a.common.set)?;
    let picked = solved.picked(a.pick)?;
    let lang = lang::asked().or(solved.task.language).unwrap_or_default();
    let options = crate::lesson::design::Options { lang, style };
    let page = crate::lesson::design::lesson(&solved.task, &solved.design.candidates[picked], &options).map_err(|f| solved.failed(f))?;
    let path = a.output.clone().unwrap_or_else(|| format!("{}.html", files::stem(&solved.name, "lesson")));
    files::write(Path::new(&path), page.as_bytes())?;
    files::print_names(&format!("{path}\n"))?;
    solved.say_notes();
    Ok(ExitCode::SUCCESS)
}

/// The figures of a candidate: construction, wanted positions, deviation; with `--steps` the construction alone grows, a picture for each
/// step.
pub fn draw(a: &args::Draw, style: &Style) -> Run {
    let solved = Solved::read(&a.common.scene, &a.common.set)?;
    let lang = lang::asked().or(solved.task.language).unwrap_or_default();
    let candidate = &solved.design.candidates[solved.picked(a.pick)?];
    let all = figure::figures(&solved.task, candidate, style, lang).map_err(|f| solved.failed(f))?;
    let mut figures: Vec<(String, crate::paper::item::Figure)> = all.into_iter().map(|(n, f)| (n.to_owned(), f)).collect();
    if a.steps {
        let Some(at) = figures.iter().position(|f| f.0 == "construction") else {
            let d = Diagnostic::error("no-construction", no_construction());
            return Err(solved.failed(d.help(both!("leave --steps out", "请去掉 --steps")).into()));
        };
        figures = figure::growing(&figures[at].1);
    }
    if let Some(width_mm) = draw::width(a.width.as_deref())? {
        let room = fit::Room::Column(width_mm);
        figures = if a.steps { fit::placed_alike(figures, room) } else { fit::placed(figures, room) }.map_err(|f| solved.failed(f))?;
    }
    let notes = draw::put(a, &solved.name, figures, |f| solved.failed(f))?;
    solved.say_notes();
    errors::tell(&Faults { list: notes }, &solved.name, &solved.source);
    Ok(ExitCode::SUCCESS)
}
