//! Tasks of design.

use super::{Answer, Answered, Kind, Lesson, Look, Options, Pictures, Solved};
use crate::diag::{Both, Diagnostic, Faults, Warned, both};
use crate::figure::list::Pages;
use crate::figure::{fit, sheet, synthesis as figure};
use crate::lesson::design as lesson;
use crate::report::synthesis as report;
use crate::scene::Lang;
use crate::synthesis::{self, Design, DesignCandidate, Task};
use crate::worksheet::{self, Document, WorksheetSides, WorksheetTask};
use hodograph_base::json;
use serde_json::Value as Json;

/// The construction of a candidate as text and for programs.
#[derive(Debug)]
struct CandidateSteps {
    steps: Both,
    json: Json,
}

/// A task with its candidates.
#[derive(Debug)]
struct Designed {
    task: Task,
    design: Design,
    picked: usize,
    /// The construction; `None` if it does not close on paper.
    construction: Option<CandidateSteps>,
}

pub(super) fn solve(task: &Task, options: &Options) -> Result<Solved, Faults> {
    let design = synthesis::solve(task)?;
    let (picked, count) = (options.candidate, design.candidates.len());
    if picked >= count {
        let message = both!("there is no candidate {}: there are {count}", picked + 1);
        return Err(Diagnostic::error("no-candidate", message).into());
    }
    let candidate = &design.candidates[picked];
    let construction = figure::to_scale(task, candidate)?.map(|board| {
        let [en, zh] = [Lang::En, Lang::Zh].map(|lang| report::steps(candidate, &board, lang));
        CandidateSteps { steps: Both { en, zh }, json: report::construction(&board) }
    });
    let notes = design.notes.clone();
    Ok(Solved {
        notes,
        answered: Box::new(Designed { task: task.clone(), design, picked, construction }),
    })
}

/// Replaces the name of a scene file in a task (`"scene": "linkage.json"`) by the file's text;
/// returns any other text unchanged. `file` reads a file by its name.
///
/// # Errors
/// The errors of `file`, at the place of the name.
pub fn included(
    source: Vec<u8>,
    mut file: impl FnMut(&str) -> Result<Vec<u8>, Diagnostic>,
) -> Result<Vec<u8>, Faults> {
    if !synthesis::is_task(&source) {
        return Ok(source);
    }
    let Ok((text, root)) = json::parse(&source, &mut Faults::default()) else { return Ok(source) };
    let json::NodeKind::Object(members) = &root.kind else { return Ok(source) };
    let named = members.iter().find_map(|(key, node)| match &node.kind {
        json::NodeKind::Text(name) if key.text == "scene" && name.ends_with(".json") => {
            Some((name, node.span))
        }
        _ => None,
    });
    let Some((name, span)) = named else { return Ok(source) };
    let scene = file(name).map_err(|d| d.at(span))?;
    let mut out = text.to_owned();
    out.replace_range(span.start..span.end, &String::from_utf8_lossy(&scene));
    Ok(out.into_bytes())
}

/// The message for a construction that does not close on paper.
fn no_construction() -> Both {
    both!(
        "This design does not close on paper: its construction with ruler and compasses cannot be drawn."
    )
}

impl Designed {
    fn lang(&self, look: &Look) -> Lang {
        look.lang.or(self.task.language).unwrap_or_default()
    }

    fn candidate(&self) -> &DesignCandidate {
        &self.design.candidates[self.picked]
    }
}

impl Answered for Designed {
    fn answers(&self, _: &Look) -> Vec<Answer> {
        Vec::new()
    }

    fn text(&self, look: &Look, steps: bool) -> String {
        let lang = self.lang(look);
        let text = report::text(&self.task, &self.design, lang);
        match &self.construction {
            _ if !steps => text,
            Some(construction) => text + lang.of(&construction.steps),
            None => text + &format!("\n{}\n", lang.of(&no_construction())),
        }
    }

    fn kind(&self) -> Kind {
        Kind::Task
    }

    fn json(&self, _: &Look, steps: bool, _: &[Diagnostic]) -> Json {
        let mut all = report::json(&self.task, &self.design);
        if steps {
            all["construction"] = self.construction.as_ref().map_or(Json::Null, |c| c.json.clone());
        }
        all
    }

    fn figures(&self, pictures: &Pictures, look: &Look) -> Result<Warned<Pages>, Faults> {
        let all = figure::figures(&self.task, self.candidate(), &look.style, self.lang(look))?;
        let mut pages: Pages =
            all.into_iter().map(|(name, figure)| (name.to_owned(), figure)).collect();
        if pictures.steps {
            let Some(at) = pages.iter().position(|p| p.0 == "construction") else {
                let d = Diagnostic::error("no-construction", no_construction());
                return Err(d.help(both!("leave --steps out")).into());
            };
            pages = figure::growing(&pages[at].1);
        }
        if let Some(format) = &pictures.page {
            pages = fit::placed(pages, format, pictures.steps)?;
        }
        Ok(Warned { value: pages, notes: Vec::new() })
    }

    fn worksheet(
        &self,
        sides: WorksheetSides,
        _: WorksheetTask,
        look: &Look,
    ) -> Result<Document, Faults> {
        let sheet = sheet::SheetOptions {
            style: look.style.clone(),
            ..sheet::SheetOptions::of_language(self.lang(look))
        };
        worksheet::design(
            &self.task,
            &self.design,
            self.picked,
            &worksheet::WorksheetOptions { sheet, sides },
        )
    }

    fn lesson(&self, _: &Lesson, look: &Look) -> Result<Warned<String>, Faults> {
        let options = lesson::DesignOptions { lang: self.lang(look), style: look.style.clone() };
        let value = lesson::lesson(&self.task, self.candidate(), &options)?;
        Ok(Warned { value, notes: Vec::new() })
    }

    fn design(&self) -> Option<&Design> {
        Some(&self.design)
    }
}
