//! The messages, and the opened files.

use crate::file::OpenFile;
use crate::words::{failed, look};
use hodograph::problem::{Kind, schema, templates};
use serde_json::{Value as Json, json};
use std::collections::BTreeMap;

/// The opened files by their handles.
#[derive(Default)]
pub struct Engine {
    files: BTreeMap<u64, OpenFile>,
    last: u64,
}

impl Engine {
    /// Answers a message, a JSON object with its name in `do`; the answer has `ok`.
    pub fn answer(&mut self, message: &str) -> String {
        let message = match serde_json::from_str(message) {
            Ok(message) => message,
            Err(e) => return refused(&e.to_string()).to_string(),
        };
        self.told(&message).to_string()
    }

    fn told(&mut self, message: &Json) -> Json {
        let text = message["text"].as_str().unwrap_or_default();
        match message["do"].as_str().unwrap_or_default() {
            "open" => return self.open(text, message),
            "templates" => return list(),
            "template" => {
                let name = message["name"].as_str().unwrap_or_default();
                return match templates::text(name, &[]) {
                    Ok(text) => json!({"ok": true, "text": text}),
                    Err(faults) => failed(&faults, ""),
                };
            }
            "schema" => return schemas(),
            _ => {}
        }
        let Some(handle) = message["handle"].as_u64() else { return refused("no handle") };
        let Some(file) = self.files.get_mut(&handle) else { return refused("no such handle") };
        match message["do"].as_str().unwrap_or_default() {
            "frame" => file.frame(message),
            "move" => file.move_to(message),
            "steps" => file.steps(message),
            "motion" => file.motion(),
            "place" => file.place(message["travel"].as_f64().unwrap_or_default()),
            "export" => file.export(message),
            "close" => {
                self.files.remove(&handle);
                json!({"ok": true})
            }
            // For the test that the page survives it.
            #[cfg(target_family = "wasm")]
            "trap" => core::arch::wasm32::unreachable(),
            other => refused(other),
        }
    }

    fn open(&mut self, text: &str, message: &Json) -> Json {
        let pick = message["pick"].as_u64().and_then(|n| usize::try_from(n).ok());
        match OpenFile::read(text, pick.unwrap_or_default()) {
            Ok(file) => {
                let mut told = file.told(&look(message));
                self.last += 1;
                told["handle"] = json!(self.last);
                self.files.insert(self.last, file);
                told
            }
            Err(faults) => failed(&faults, text),
        }
    }
}

/// The answer to a message that is none.
fn refused(why: &str) -> Json {
    json!({"ok": false, "refused": why, "diagnostics": []})
}

fn list() -> Json {
    let one = |t: templates::Template| json!({"name": t.name, "kind": t.kind.word(), "title": t.title.json()});
    json!({"ok": true, "templates": templates::all().into_iter().map(one).collect::<Vec<_>>()})
}

fn schemas() -> Json {
    let of = |kind| serde_json::from_str::<Json>(schema(kind)).unwrap_or_default();
    json!({"ok": true, "scene": of(Kind::Scene), "task": of(Kind::Task), "motion": of(Kind::Motion)})
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ask(engine: &mut Engine, message: Json) -> Json {
        serde_json::from_str(&engine.answer(&message.to_string())).unwrap()
    }

    fn opened(name: &str) -> (Engine, Json) {
        let mut engine = Engine::default();
        let text = templates::text(name, &[]).unwrap();
        let told = ask(&mut engine, json!({"do": "open", "text": text}));
        assert_eq!(told["ok"], true, "{told}");
        (engine, told)
    }

    #[test]
    fn a_file_is_opened_drawn_moved_and_written() {
        let (mut engine, told) = opened("crank-rocker");
        let handle = &told["handle"];
        assert_eq!(told["drivers"][0]["name"], "phi_1");
        let mut ask = |message| ask(&mut engine, message);
        let drawn =
            ask(json!({"do": "frame", "handle": handle, "what": ["mechanism"], "answers": true}));
        assert!(drawn["figures"][0]["svg"].as_str().unwrap().starts_with("<svg"));
        let moved = ask(
            json!({"do": "move", "handle": handle, "what": ["velocity"], "travel": 0.3, "answers": true}),
        );
        assert!(moved["figures"][0]["svg"].as_str().unwrap().starts_with("<svg"));
        let further =
            ask(json!({"do": "move", "handle": handle, "what": ["velocity"], "travel": 0.31}));
        let delta = &further["figures"][0]["delta"];
        assert!(
            delta["changed"].as_array().unwrap().len() > 3 && delta["size"].is_null(),
            "{further}"
        );
        assert_ne!(moved["answers"], drawn["answers"]);
        let motion = ask(json!({"do": "motion", "handle": handle}));
        assert!(motion["full"] == true && motion["poses"].as_array().unwrap().len() >= 72);
        for form in ["html", "md", "typ", "lesson", "csv", "text", "json"] {
            let made = ask(json!({"do": "export", "handle": handle, "form": form}));
            assert!(made["files"][0]["text"].as_str().unwrap().len() > 100, "{form}: {made}");
        }
        assert_eq!(ask(json!({"do": "close", "handle": handle}))["ok"], true);
        assert_eq!(ask(json!({"do": "motion", "handle": handle}))["ok"], false);
    }

    #[test]
    fn the_place_of_the_driver_is_an_edit_of_the_text() {
        let (mut engine, told) = opened("crank-rocker");
        let place =
            ask(&mut engine, json!({"do": "place", "handle": told["handle"], "travel": 0.1}));
        let at = |key: &str| place["edit"][key].as_u64().unwrap() as usize;
        let mut new = templates::text("crank-rocker", &[]).unwrap();
        new.replace_range(at("from")..at("to"), place["edit"]["insert"].as_str().unwrap());
        let again = ask(&mut engine, json!({"do": "open", "text": new}));
        let position = |told: &Json| told["drivers"][0]["position"].as_f64().unwrap();
        assert!((position(&again) - position(&told) - 0.1).abs() < 1e-5, "{place}");
    }

    #[test]
    fn faults_have_their_places() {
        let mut engine = Engine::default();
        let told = ask(&mut engine, json!({"do": "open", "text": "{\"títle\": 1}"}));
        assert_eq!(told["ok"], false);
        let all = told["diagnostics"].as_array().unwrap();
        let key = all.iter().find(|d| d["code"] == "unknown-key").unwrap();
        // é is two bytes and one unit of UTF-16.
        assert_eq!(key["place"], json!({"from": 1, "to": 8}), "{told}");
        assert_eq!(engine.answer("{").contains("false"), true);
    }
}
