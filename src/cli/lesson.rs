//! `hodograph lesson`: one page with the construction step by step, or a fragment for slides, or the
//! page with the engine inside.

use super::draw::{style_of, width};
use super::page::{CONNECT, PageText};
use super::{CommandResult, Failure, InputFile, args, files, granted, ids, look_of, verdict};
use crate::diag::{Diagnostic, Warned, both};
use crate::problem::{self, Lesson, Look, Options, Problem, Wish};
use crate::scene::Swept;
use base64::{Engine as _, prelude::BASE64_STANDARD};

/// The valid endings of a lesson's file.
const LESSONS: [&str; 2] = ["html", "htm"];

/// Runs the command.
pub fn run(a: args::LessonArgs) -> CommandResult {
    if let Some(path) = a
        .output
        .as_deref()
        .filter(|p| files::ending(p).is_some_and(|e| !LESSONS.contains(&e.as_str())))
    {
        let d = Diagnostic::error("output", both!("{path} does not end in .html"))
            .help(both!("write -o lesson.html"));
        return Err(Failure::argument("-o", path, d));
    }
    let width_mm = width(a.width.as_deref())?;
    let style = style_of(&a.look)?;
    ids::of_lesson(&a)?;
    let mut file = InputFile::open(&a.common.scene, &a.common.set)?;
    file.fonts = style.fonts.clone();
    let problem = file.read(|bytes| problem::read(bytes))?;
    granted(
        problem.kind(),
        &[
            (a.pick.map(|n| n.to_string()), Wish::Candidate),
            (a.reveal.then(String::new), Wish::Reveal),
            (a.method.map(|_| String::new()), Wish::Method),
        ],
    )?;
    if a.live {
        return live(a, file, &problem);
    }
    let candidate = a.pick.map_or(0, |n| n as usize - 1);
    let options = Options { whole_motion: !a.reveal, candidate, ..Options::with_figures() };
    let solved = file.solve(&problem, &options)?;
    let swept = match (a.driver, solved.mechanism()) {
        (Some(number), _) => Swept::Driver(number as usize - 1),
        (None, Some((scene, _))) => problem::range::swept_of(scene, a.moves.over.as_deref())?,
        (None, None) => Swept::Driver(0),
    };
    let (positions, reveal, method) = (a.positions as usize, a.reveal, a.method);
    let wanted = Lesson { positions, swept, reveal, width_mm, method };
    let look = look_of(&a.common, style, Look::default().digits);
    let Warned { value, notes } =
        solved.lesson(&wanted, &look).map_err(|faults| file.failed(faults))?;
    file.notes.extend(notes);
    write(a.output, &file, &ids::put_before(&value))?;
    file.say_notes();
    Ok(verdict(solved.verdict()))
}

/// Writes the page with the file inside.
fn live(a: args::LessonArgs, mut file: InputFile, problem: &Problem) -> CommandResult {
    let solved = file.solve(problem, &Options::with_figures())?;
    let page = PageText::read(a.page.as_deref())?;
    let text = page.knowing("lesson", &BASE64_STANDARD.encode(&file.source), CONNECT);
    write(a.output, &file, &text)?;
    file.say_notes();
    Ok(verdict(solved.verdict()))
}

fn write(output: Option<String>, file: &InputFile, text: &str) -> Result<(), Failure> {
    let path = output.unwrap_or_else(|| format!("{}.html", files::stem(&file.name, "lesson")));
    files::write(std::path::Path::new(&path), text.as_bytes())?;
    files::print_names(&format!("{path}\n")).map(drop)
}
