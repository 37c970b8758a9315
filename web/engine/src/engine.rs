//! The messages, and the opened files.

use crate::file::OpenFile;
use crate::plane;
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
    pub fn answer(&mut self, message: &[u8]) -> Vec<u8> {
        let told = match serde_json::from_slice(message) {
            Ok(message) => self.told(&message),
            Err(e) => refused(&e.to_string()),
        };
        told.to_string().into_bytes()
    }

    fn told(&mut self, message: &Json) -> Json {
        let text = message["text"].as_str().unwrap_or_default();
        match message["do"].as_str().unwrap_or_default() {
            "open" => return self.open(text, message),
            "trial" => return trial(text, message),
            "templates" => return list(),
            "template" => {
                let name = message["name"].as_str().unwrap_or_default();
                return match templates::text(name, &[]) {
                    Ok(text) => json!({"ok": true, "text": text}),
                    Err(faults) => failed(&faults, ""),
                };
            }
            "schema" => return schemas(),
            "values" => {
                let wanted = message["of"].as_array().map_or(&[][..], Vec::as_slice);
                return json!({"ok": true, "values": plane::values(text, wanted)});
            }
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
            "report" => file.report(message),
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
        match OpenFile::read(text, pick.unwrap_or_default(), None) {
            Ok(file) => {
                let mut told = file.told(&look(message));
                self.last += 1;
                told["handle"] = json!(self.last);
                self.files.insert(self.last, file);
                told
            }
            Err(faults) => {
                let mut told = failed(&faults, text);
                told["names"] = plane::names_of(text);
                told
            }
        }
    }
}

/// Answers `trial`: the frame of a text that is not kept.
fn trial(text: &str, message: &Json) -> Json {
    match OpenFile::read(text, 0, message["mu"].as_f64()) {
        Ok(file) => {
            let mut wanted = message.clone();
            wanted["mu"] = Json::Null;
            file.frame(&wanted)
        }
        Err(faults) => failed(&faults, text),
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
    json!({"ok": true, "scene": of(Kind::Scene), "task": of(Kind::Task), "motion": of(Kind::Motion), "equation": of(Kind::Equation)})
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ask(engine: &mut Engine, message: Json) -> Json {
        serde_json::from_slice(&engine.answer(message.to_string().as_bytes())).unwrap()
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
        for form in [
            "html",
            "md",
            "typ",
            "lesson",
            "csv",
            "text",
            "json",
            "dxf",
            "tikz",
            "pylinkage",
            "pmks",
        ] {
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
        let mut new: Vec<u16> =
            templates::text("crank-rocker", &[]).unwrap().encode_utf16().collect();
        let insert = place["edit"]["insert"].as_str().unwrap().encode_utf16();
        new.splice(at("from")..at("to"), insert);
        let new = String::from_utf16(&new).unwrap();
        let again = ask(&mut engine, json!({"do": "open", "text": new}));
        let position = |told: &Json| told["drivers"][0]["position"].as_f64().unwrap();
        assert!((position(&again) - position(&told) - 0.1).abs() < 1e-5, "{place}");
    }

    #[test]
    fn the_mechanism_is_told_in_its_plane() {
        let (mut engine, told) = opened("geared-five-bar");
        let told = ask(
            &mut engine,
            json!({"do": "frame", "handle": told["handle"], "what": ["mechanism"], "plane": true}),
        );
        let plane = &told["plane"];
        let b = plane["points"].as_array().unwrap().iter().find(|p| p["name"] == "B").unwrap();
        assert_eq!(b["links"], json!(["2", "3"]));
        assert!((b["at"][0].as_f64().unwrap() - 0.025 / 2f64.sqrt()).abs() < 1e-12, "{plane}");
        // Both pivots are where the picture has them.
        let (paper, svg) = (&told["figures"][0]["paper"], told["figures"][0]["svg"].as_str());
        let [x, y] = [0, 1].map(|k| paper["origin"][k].as_f64().unwrap());
        let e = x + 0.09 * paper["scale"].as_f64().unwrap();
        for [x, y] in [[x, y], [e, y]] {
            let circle =
                format!("cx=\"{}\" cy=\"{}\"", (x * 1e3).round() / 1e3, (y * 1e3).round() / 1e3);
            assert!(svg.unwrap().contains(&circle), "{circle}");
        }
    }

    #[test]
    fn a_trial_is_drawn_in_a_scale_and_not_kept() {
        let mut engine = Engine::default();
        let text = templates::text("crank-rocker", &[]).unwrap();
        let trial = json!({"do": "trial", "text": text, "what": ["mechanism"], "mu": 0.003});
        let told = ask(&mut engine, trial);
        assert_eq!(told["figures"][0]["paper"]["scale"], 1.0 / 0.003, "{told}");
        let (mut opened, file) = opened("crank-rocker");
        let scaled =
            json!({"do": "frame", "handle": file["handle"], "what": ["mechanism"], "mu": 0.003});
        assert_eq!(ask(&mut opened, scaled)["figures"], told["figures"]);
        assert!(engine.files.is_empty());
    }

    #[test]
    fn what_cannot_be_solved_has_its_names_and_quantities() {
        let mut engine = Engine::default();
        let text = r#"{"parameters": {"d": "2*r", "r": "30 mm"}, "links": {"1": ["A", "D"], "2": ["A", "B"]}, "ground": "1"}"#;
        let told = ask(&mut engine, json!({"do": "open", "text": text}));
        assert_eq!(told["names"]["links"], json!(["1", "2"]), "{told}");
        let of = json!(["d/2", "90 deg", 0, "none"]);
        let told = ask(&mut engine, json!({"do": "values", "text": text, "of": of}));
        assert_eq!(told["values"], json!([0.03, std::f64::consts::FRAC_PI_2, 0.0, null]));
        assert_eq!(ask(&mut engine, json!({"do": "open", "text": "{"}))["names"], Json::Null);
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
        assert!(String::from_utf8(engine.answer(b"{")).unwrap().contains("false"));
    }
}
