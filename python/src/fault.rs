//! Faults as exceptions of the package.

use hodograph::diag::{Both, Diagnostic, Faults, json};
use hodograph::problem::range::{RangeFault, WrongValue};
use hodograph::report::diagnostics;
use hodograph::scene::{self, Lang};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

/// Faults with the text to which their places refer, and its name.
pub struct PlacedFaults {
    faults: Faults,
    name: String,
    source: String,
}

/// The options of the program that remedies name, with the arguments in Python.
const ARGUMENTS: [(&str, &str); 7] = [
    ("alpha-back", "alpha_back"),
    ("figure", "name"),
    ("from", "start"),
    ("module", "modules"),
    ("pick", "candidate"),
    ("point", "path"),
    ("to", "stop"),
];

impl PlacedFaults {
    /// Returns the faults with the names of arguments in Python.
    fn in_python(self) -> PlacedFaults {
        let words = |text: Both| Both { en: in_python(&text.en), zh: in_python(&text.zh) };
        let one =
            |d: Diagnostic| Diagnostic { message: words(d.message), help: d.help.map(words), ..d };
        let name = argument(&self.name).to_owned();
        let list = self.faults.list.into_iter().map(one).collect();
        PlacedFaults { faults: Faults { list }, name, ..self }
    }
}

/// Returns the argument of Python for an option of the program.
fn argument(option: &str) -> &str {
    ARGUMENTS.iter().find(|(name, _)| *name == option).map_or(option, |(_, of)| of)
}

/// Returns a sentence in which options of the program, such as `--from`, are arguments of Python.
/// Whole commands of the program remain.
fn in_python(text: &str) -> String {
    let part = |part: &str| {
        if part.starts_with("hodograph ") { part.to_owned() } else { with_arguments(part) }
    };
    text.split('`').map(part).collect::<Vec<_>>().join("`")
}

fn with_arguments(text: &str) -> String {
    let mut parts = text.split("--");
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let end = part.find(|c: char| !c.is_ascii_lowercase() && c != '-').unwrap_or(part.len());
        let (option, rest) = part.split_at(end);
        let begins = !out.ends_with(|c: char| c.is_ascii_alphanumeric() || c == '-');
        if option.is_empty() || !begins {
            out += "--";
            out += part;
            continue;
        }
        out += argument(option);
        out += rest;
    }
    out
}

/// The reason why there is no result.
pub struct Refusal(Vec<PlacedFaults>);

impl Refusal {
    /// Returns the refusal for faults without a text.
    pub fn of(faults: impl Into<Faults>) -> Refusal {
        Refusal::in_text(faults, "", "")
    }

    /// Returns the refusal for faults of a text.
    pub fn in_text(faults: impl Into<Faults>, name: &str, source: &str) -> Refusal {
        let [name, source] = [name, source].map(str::to_owned);
        Refusal(vec![PlacedFaults { faults: faults.into(), name, source }])
    }

    /// Returns the refusal for faults of a scene with other questions than its file has.
    pub fn asked(faults: Faults, (name, source): (&str, &str), asked: Option<&str>) -> Refusal {
        let Some(asked) = asked else { return Refusal::in_text(faults, name, source) };
        let place = |d: &Diagnostic| d.span.and_then(scene::place_in_asked);
        let (of_asked, of_file): (Vec<_>, Vec<_>) =
            faults.list.into_iter().partition(|d| place(d).is_some());
        let of_asked = of_asked.into_iter().map(|d| Diagnostic { span: place(&d), ..d }).collect();
        let all = [
            Refusal::in_text(Faults { list: of_file }, name, source),
            Refusal::in_text(Faults { list: of_asked }, "find", asked),
        ];
        let Refusal(mut all) = Refusal::all(all.into_iter());
        all.retain(|p| !p.faults.list.is_empty());
        Refusal(all)
    }

    /// Returns the refusal for faults of values of a request.
    pub fn values(all: Vec<WrongValue>) -> Refusal {
        let one = |WrongValue { of, text, faults }| PlacedFaults {
            faults,
            name: of.to_owned(),
            source: text,
        };
        Refusal(all.into_iter().map(one).collect())
    }

    /// Returns several refusals as one.
    pub fn all(all: impl Iterator<Item = Refusal>) -> Refusal {
        Refusal(all.flat_map(|refusal| refusal.0).collect())
    }

    /// Returns the refusal for a range.
    pub fn range(fault: RangeFault, file: (&str, &str), asked: Option<&str>) -> Refusal {
        match fault {
            RangeFault::Scene(faults) => Refusal::asked(faults, file, asked),
            RangeFault::Values(all) => Refusal::values(all),
        }
    }

    /// Returns the exception of the package: its document, and its text in both languages.
    pub fn raised(self, py: Python) -> PyErr {
        let all: Vec<PlacedFaults> = self.0.into_iter().map(PlacedFaults::in_python).collect();
        let list = all.iter().flat_map(|p| p.faults.json(&p.name, &p.source)).collect();
        let text = |lang| -> String {
            let one =
                |p: &PlacedFaults| diagnostics::render_in(&p.faults, &p.name, &p.source, lang);
            all.iter().map(one).collect()
        };
        let told = (json::document(list).to_string(), text(Lang::En), text(Lang::Zh));
        let made = py.import("hodograph._errors").and_then(|m| m.getattr("made")?.call1(told));
        made.map_or_else(|e| e, PyErr::from_value)
    }
}

impl From<Faults> for Refusal {
    fn from(faults: Faults) -> Refusal {
        Refusal::of(faults)
    }
}

impl From<Diagnostic> for Refusal {
    fn from(d: Diagnostic) -> Refusal {
        Refusal::of(d)
    }
}

/// Returns remarks as JSON with their places in a text.
pub fn notes(list: &[Diagnostic], name: &str, source: &str) -> String {
    let list = list.iter().map(|d| d.json(name, source)).collect();
    json::document(list).to_string()
}

/// Returns the exception for an error of the library.
pub fn internal(py: Python, message: &str) -> PyErr {
    let text = format!("an error of hodograph, please report it: {message}");
    let made =
        py.import("hodograph._errors").and_then(|m| m.getattr("InternalError")?.call1((&text,)));
    made.map_or_else(|_| PyRuntimeError::new_err(text), PyErr::from_value)
}
