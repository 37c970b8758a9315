//! Designs: the scene as written, its numbers, its requirements and the remarks on it.
//!
//! A kind of task makes a [`Draft`]; judging adds the results of sweeping the finished scene and
//! makes it a [`DesignCandidate`].

use super::judge::Judged;
use hodograph_base::diag::{Both, Diagnostic};
use hodograph_base::geom::Point;
use hodograph_scene::Kind;
use serde_json::{Value as Json, json};

/// A number of a design, with its name and description.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignNumber {
    /// A short name for programs and tables: `AB`, `theta`, `gamma`.
    pub name: String,
    /// The description.
    pub what: Both,
    /// Its value (SI).
    pub value: f64,
    /// The kind of quantity; `None` for a pure number.
    pub kind: Option<Kind>,
}

impl DesignNumber {
    /// A length (m).
    pub fn length(name: &str, what: Both, value: f64) -> DesignNumber {
        DesignNumber { name: name.to_owned(), what, value, kind: Some(Kind::Length) }
    }

    /// An angle (rad).
    pub fn angle(name: &str, what: Both, value: f64) -> DesignNumber {
        DesignNumber { name: name.to_owned(), what, value, kind: Some(Kind::Angle) }
    }

    /// A pure number.
    pub fn ratio(name: &str, what: Both, value: f64) -> DesignNumber {
        DesignNumber { name: name.to_owned(), what, value, kind: None }
    }
}

/// Required places of points at a position of the driver.
#[derive(Clone, Debug, PartialEq)]
pub struct WantedPosition {
    /// The position of the driver (rad), as the scene counts it.
    pub driver: f64,
    /// The points by name, each with its required place (m).
    pub places: Vec<(String, Point)>,
}

/// A requirement on the whole motion of the scene, beside positions.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Demand {
    /// The time ratio of an output, whichever stroke is the slow one.
    TimeRatio(f64),
    /// The stroke of a sliding output (m).
    Stroke(f64),
    /// The swing of a rotating output (rad).
    Swing(f64),
    /// The driver turns fully.
    FullTurn,
}

/// Wanted and actual output angle at a value of a function's variable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compared {
    /// The variable of the function.
    pub x: f64,
    /// The crank angle (rad).
    pub input: f64,
    /// The wanted output angle (rad).
    pub wanted: f64,
    /// The actual output angle (rad).
    pub real: f64,
}

impl Compared {
    /// The deviation: actual minus wanted angle (rad).
    pub fn deviation(&self) -> f64 {
        self.real - self.wanted
    }
}

/// A design as the formula gives it.
#[derive(Clone, Debug, PartialEq)]
pub struct Draft {
    /// The description that tells this solution from the others.
    pub which: Both,
    /// The scene.
    pub scene: Json,
    /// Lengths and other numbers of the design, in the order of printing.
    pub numbers: Vec<DesignNumber>,
    /// The required positions. The scene is drawn in the first.
    pub wanted: Vec<WantedPosition>,
    /// The requirements on the whole motion.
    pub demands: Vec<Demand>,
    /// True if the required positions are meant in the order of the driver's motion: then an order
    /// that reverses is a defect.
    pub ordered: bool,
    /// The error of an approximation, in the measure of its kind of task; 0 for an exact solution.
    pub error: f64,
    /// Wanted against actual: the places that a point approximates (m).
    pub targets: Vec<Point>,
    /// Wanted against actual: the output angle over the range of a function.
    pub course: Vec<Compared>,
    /// True if the file states the step of `course`, so that tables have all its rows.
    pub whole_course: bool,
    /// Remarks on the design.
    pub remarks: Vec<Diagnostic>,
}

impl Draft {
    /// Returns a design that meets its requirements exactly, in any order, without demands on the
    /// whole motion.
    pub fn new(
        which: Both,
        scene: Json,
        numbers: Vec<DesignNumber>,
        wanted: Vec<WantedPosition>,
    ) -> Draft {
        Draft {
            which,
            scene,
            numbers,
            wanted,
            demands: Vec::new(),
            ordered: false,
            error: 0.0,
            targets: Vec::new(),
            course: Vec::new(),
            whole_course: false,
            remarks: Vec::new(),
        }
    }
}

/// A design with the results of its finished scene.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignCandidate {
    /// The design.
    pub draft: Draft,
    /// The results of sweeping the scene.
    pub judged: Judged,
}

impl DesignCandidate {
    /// The text of the scene.
    pub fn scene_text(&self) -> String {
        scene_text(&self.draft.scene)
    }

    /// The value of a number by its name.
    pub fn number(&self, name: &str) -> Option<f64> {
        self.draft.numbers.iter().find(|n| n.name == name).map(|n| n.value)
    }

    /// Remarks and defects.
    pub fn notes(&self) -> impl Iterator<Item = &Diagnostic> {
        self.judged.defects.iter().chain(&self.draft.remarks).chain(&self.judged.remarks)
    }
}

/// The letters of a number's name and its index: `phi0` → `φ`, `0`.
pub fn letters(name: &str) -> (String, &str) {
    const GREEK: [(&str, &str); 9] = [
        ("length", "l"),
        ("deviation", "Δ"),
        ("delta", "δ"),
        ("theta", "θ"),
        ("psi", "ψ"),
        ("beta", "β"),
        ("alpha", "α"),
        ("phi", "φ"),
        ("gamma", "γ"),
    ];
    let (word, index) = name.split_at(name.trim_end_matches(|c: char| c.is_ascii_digit()).len());
    let word = word.trim_end_matches('_');
    (GREEK.iter().find(|g| g.0 == word).map_or(word, |g| g.1).to_owned(), index)
}

/// The symbol of a number in the label language: a length by its ends, the others by their letters.
pub fn symbol(name: &str) -> String {
    match letters(name) {
        (word, "") if word.len() > 1 && word.bytes().all(|b| b.is_ascii_uppercase()) => {
            format!("l_{{{word}}}")
        }
        (word, "") => word,
        (word, index) => format!("{word}_{{{index}}}"),
    }
}

/// A scene as a file: one key a line.
pub fn scene_text(scene: &Json) -> String {
    let Json::Object(members) = scene else { return format!("{scene}\n") };
    let lines: Vec<String> =
        members.iter().map(|(k, v)| format!("  {}: {}", json!(k), spaced(v))).collect();
    format!("{{\n{}\n}}\n", lines.join(",\n"))
}

/// A JSON value in one line, with spaces after separators.
fn spaced(value: &Json) -> String {
    match value {
        Json::Array(items) => {
            format!("[{}]", items.iter().map(spaced).collect::<Vec<_>>().join(", "))
        }
        Json::Object(members) => {
            let all: Vec<String> =
                members.iter().map(|(k, v)| format!("{}: {}", json!(k), spaced(v))).collect();
            format!("{{{}}}", all.join(", "))
        }
        Json::String(_) | Json::Number(_) | Json::Bool(_) | Json::Null => value.to_string(),
    }
}

/// A length for a scene's text: millimetres with all digits of the number.
pub fn mm(value_m: f64) -> Json {
    Json::String(format!("{} mm", value_m * 1e3 + 0.0))
}

/// An angle for a scene's text: degrees with all digits of the number.
pub fn deg(value_rad: f64) -> Json {
    Json::String(format!("{} deg", value_rad.to_degrees() + 0.0))
}

/// A place for a scene's text.
pub fn place(at: Point) -> Json {
    Json::Array(vec![mm(at.x), mm(at.y)])
}
