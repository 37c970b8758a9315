//! `hodograph synth`: a synthesis file to candidates, as a table or JSON, and one of them as a scene file.

use super::{Failure, Run, args, edit, files, lang, values};
use crate::diag::{Diagnostic, Faults, Warned, both};
use crate::json;
use crate::report::synthesis as report;
use crate::scene;
use crate::synthesis::{self, Design, Task};
use std::path::Path;
use std::process::ExitCode;

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
        let (name, mut bytes) = files::scene(path).map_err(|d| Failure::input(d, path, ""))?;
        // A text that cannot be changed has a fault, which the reader tells with its place.
        if let Ok(text) = std::str::from_utf8(&bytes)
            && edit::with_parameters(text, &[]).is_ok()
        {
            bytes = values::with_values(set, |values| edit::with_parameters(text, values))?.into_bytes();
        }
        bytes = with_scene(path, bytes)?;
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

    /// Says what is to be known of the task.
    pub fn say_notes(&self) {
        let list = self.notes.iter().chain(&self.design.notes).cloned().collect();
        files::say_faults(&Faults { list }, &self.name, &self.source);
    }
}

/// Runs the command.
pub fn run(a: args::Synth) -> Run {
    let solved = Solved::read(&a.file, &a.set)?;
    let picked = solved.picked(a.pick)?;
    let lang = lang::asked().or(solved.task.language).unwrap_or_default();
    if let Some(path) = &a.output {
        files::write(Path::new(path), solved.design.candidates[picked].scene_text().as_bytes())?;
    }
    if a.json {
        files::print(&format!("{:#}\n", report::json(&solved.task, &solved.design)))?;
    } else if let Some(path) = &a.output {
        files::print_names(&format!("{path}\n"))?;
    } else {
        files::print(&report::text(&solved.task, &solved.design, lang))?;
    }
    solved.say_notes();
    Ok(ExitCode::SUCCESS)
}
