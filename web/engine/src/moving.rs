//! Figures that move with the driver: their documents, and the changes from one to the next.

use crate::file::{OpenFile, answers, prefix, verdict, wanted};
use crate::words::{diagnostics, failed, look};
use hodograph::diag::Faults;
use hodograph::figure::list::FigureEntry;
use hodograph::problem::{Live, Look, Options, PageDelta, Pictures, whole};
use hodograph::render::svg::{Delta, IdPrefix};
use serde_json::{Value as Json, json};

/// Enlargement of type and symbols: with space for the whole motion, a figure is small on the screen.
const LARGER: f64 = 1.4;

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
    /// Answers `move`: the figures `what`, as far as the file calls for them, after a `travel` of
    /// the driver, with space for the whole motion. Each page has its document in `svg` if it is
    /// new or the message asks for the `whole`, else its changes in `delta`.
    pub fn move_to(&mut self, message: &Json) -> Json {
        match self.moved(message) {
            Ok(told) => told,
            Err(faults) => failed(&faults, &self.text),
        }
    }

    fn moved(&mut self, message: &Json) -> Result<Json, Faults> {
        let swept = whole::usual(&self.problem.clone().into_scene()?)?;
        let (look, asked) = (look(message), asked(message));
        let figures = wanted(message);
        let known = self.moving.take().filter(|moving| moving.asked == asked);
        let whole = known.is_none() || message["whole"] == json!(true);
        let MovingFigures { live, .. } = match known {
            Some(known) => self.moving.insert(known),
            None => {
                let is_there = |entry: &&'static FigureEntry| {
                    self.drawn(&self.solved, entry, &look).is_ok_and(|pages| !pages.is_empty())
                };
                let there: Vec<_> = figures.iter().copied().filter(is_there).collect();
                let pictures = Pictures { figures: &there, ..Pictures::default() };
                let larger = Look { style: look.style.enlarged(LARGER), ..look.clone() };
                let mut live = Live::new(&self.problem, &Options::default(), &pictures, &larger)?;
                live.reserve(swept)?;
                self.moving.insert(MovingFigures { live, asked })
            }
        };
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
