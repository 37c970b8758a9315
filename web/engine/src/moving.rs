//! Figures that move with the driver: their documents, and the changes from one to the next.

use crate::file::{OpenFile, answers, prefix, verdict, wanted};
use crate::words::{diagnostics, failed, look};
use hodograph::diag::{Diagnostic, Faults, both};
use hodograph::problem::{Live, Options, PageDelta, Pictures};
use hodograph::render::svg::{Delta, IdPrefix};
use serde_json::{Value as Json, json};

/// The figures in motion of an opened file.
pub struct MovingFigures {
    live: Live,
    /// The fields of the message on which the figures depend.
    asked: [Json; 4],
}

/// The fields of a message on which figures depend.
fn asked(message: &Json) -> [Json; 4] {
    ["what", "lang", "notation", "style"].map(|key| message[key].clone())
}

impl OpenFile {
    /// Answers `move`: the figures `what` after a `travel` of the driver, with room for the whole
    /// motion. Each page has its document in `svg` if it is new or the message asks for the `whole`,
    /// else its changes in `delta`.
    pub fn move_to(&mut self, message: &Json) -> Json {
        match self.moved(message) {
            Ok(told) => told,
            Err(faults) => failed(&faults, &self.text),
        }
    }

    fn moved(&mut self, message: &Json) -> Result<Json, Faults> {
        let Some(swept) = self.swept else { return Err(no_driver()) };
        let (look, asked) = (look(message), asked(message));
        let figures = wanted(message);
        let begins = self.moving.as_ref().is_none_or(|m| m.asked != asked);
        let whole = begins || message["whole"] == json!(true);
        if begins {
            let pictures = Pictures { figures: &figures, ..Pictures::default() };
            let mut live = Live::new(&self.problem, &Options::default(), &pictures, &look)?;
            live.make_room(swept)?;
            self.moving = Some(MovingFigures { live, asked });
        }
        let Some(MovingFigures { live, .. }) = &mut self.moving else { return Err(no_driver()) };
        let changes = live.redraw_after(swept, message["travel"].as_f64().unwrap_or_default())?;
        let page = |change: &PageDelta| {
            let PageDelta { name, delta, .. } = change;
            let prefix = prefix(name);
            let figure = match figures.as_slice() {
                [only] => only.name,
                _ => name.as_str(),
            };
            let mut page = json!({"name": name, "figure": figure, "notes": diagnostics(&delta.notes, &self.text)});
            if whole || change.begins {
                let svg = live.svg(name).unwrap_or_default();
                page["svg"] = json!(prefix.put_before(&svg));
            } else {
                page["delta"] = written(delta, &prefix);
            }
            page
        };
        let solved = live.solved();
        Ok(json!({
            "ok": true,
            "figures": changes.iter().map(page).collect::<Vec<_>>(),
            "missing": [],
            "answers": if message["answers"] == json!(true) { answers(solved, &look) } else { Json::Null },
            "verdict": verdict(solved),
        }))
    }
}

/// Returns the changes of a document whose ids have a prefix.
fn written(delta: &Delta, prefix: &IdPrefix) -> Json {
    let marked = |list: &[(usize, String)]| -> Vec<Json> {
        list.iter().map(|(k, text)| json!([k, prefix.put_before(text)])).collect()
    };
    json!({
        "size": delta.size_mm,
        "desc": delta.desc,
        "letters": delta.letters.as_ref().map(|text| prefix.put_before(text)),
        "removed": delta.removed,
        "added": marked(&delta.added),
        "changed": marked(&delta.changed),
        "moved": delta.moved,
    })
}

/// The fault of a file without anything that moves.
pub fn no_driver() -> Faults {
    Diagnostic::error("no-driver", both!("the scene has no driver", "机构文件没有原动件")).into()
}
