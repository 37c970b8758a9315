//! Reports of an opened file as text: the limits of its motion, its mobility, its motion cycle, its
//! cams.

use crate::file::OpenFile;
use crate::words::{failed, look};
use hodograph::diag::{Diagnostic, Faults, both};
use hodograph::mechanism::Mechanism;
use hodograph::problem::cams::SurveyedCam;
use hodograph::problem::whole_motion;
use hodograph::report::{limits, mobility};
use hodograph::scene::{self, Scene, Swept};
use hodograph::sweep::extreme;
use serde_json::{Value as Json, json};

impl OpenFile {
    /// Answers `report`: the text of `limits`, `mobility`, `cycle` or `cam`, as the program prints it.
    pub fn report(&self, message: &Json) -> Json {
        match self.reported(message) {
            Ok(text) => json!({"ok": true, "text": text}),
            Err(faults) => failed(&faults, &self.text),
        }
    }

    fn reported(&self, message: &Json) -> Result<String, Faults> {
        let (lang, _) = look(message).of(self.scene().and_then(|s| s.language), None);
        match (message["of"].as_str().unwrap_or_default(), self.scene(), self.swept) {
            ("mobility", Some(_), _) => {
                let scene = scene::read_topology(&self.text)?.value;
                let (survey, checked) = mobility::surveyed(&scene);
                Ok(mobility::text(&scene, &survey, &checked, lang))
            }
            ("limits", Some(scene), Some(Swept::Driver(driver))) => {
                let scene = whole_motion(scene.clone()).value;
                let mechanism = Mechanism::new(&scene)?.value;
                let found = extreme::limits(&scene, &mechanism, driver)?;
                Ok(limits::text(&scene, driver, &found, lang))
            }
            ("cycle", Some(_), _) => Ok(self.cycle()?.value.text(lang)),
            ("cam", Some(_), _) => {
                let text = |cams: &[SurveyedCam], _: &Scene| {
                    cams.iter().map(|cam| cam.text(lang)).collect::<Vec<_>>().join("\n")
                };
                Ok(self.with_cams(message, text)?.value)
            }
            (of, ..) => {
                let message = both!("there is no report `{of}` of this file");
                Err(Diagnostic::error("format", message).into())
            }
        }
    }
}
