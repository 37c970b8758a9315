//! `hodograph lesson`: one page with the construction step by step, or a fragment for slides.

use super::draw::{style_of, width};
use super::{Failure, Input, Run, args, choices, files, particle, sweep, synth, verdict};
use crate::diag::{Diagnostic, Warned, both};
use crate::figure::sheet;
use crate::scene::Swept;
use crate::worked::Scope;

/// The endings that a lesson's file may have.
const LESSONS: [&str; 2] = ["html", "htm"];

/// Runs the command.
pub fn run(a: args::Lesson) -> Run {
    if let Some(path) = a.output.as_deref().filter(|p| files::ending(p).is_some_and(|e| !LESSONS.contains(&e.as_str()))) {
        let d = Diagnostic::error("output", both!("{path} does not end in .html", "{path} 不以 .html 结尾"))
            .help(both!("write -o lesson.html", "请写 -o lesson.html"));
        return Err(Failure::argument("-o", path, d));
    }
    let width_mm = width(a.width.as_deref())?;
    let style = style_of(&a.look)?;
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
        match width_mm {
            Some(mm) => crate::lesson::reveal_in(&input.scene, &worked, &options, mm),
            None => crate::lesson::reveal(&input.scene, &worked, &options),
        }
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
    files::write(std::path::Path::new(&path), value.as_bytes())?;
    files::print_names(&format!("{path}\n"))?;
    input.say_notes();
    Ok(verdict(&worked))
}
