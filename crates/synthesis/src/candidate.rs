//! A design: the scene as written, what it is made of, what it is to do, and what is to be said of it.
//!
//! A kind of task makes a [`Draft`]; judging adds what only the finished scene can tell and makes it a [`Candidate`].

use super::judge::Judged;
use hodograph_base::diag::{Both, Diagnostic};
use hodograph_base::geom::Point;
use hodograph_scene::Kind;
use serde_json::{Value as Json, json};

/// A number of a design, with its name and what it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Number {
    /// A short name for programs and tables: `AB`, `theta`, `gamma`.
    pub name: String,
    /// What it is, in words.
    pub what: Both,
    /// Its value (SI).
    pub value: f64,
    /// What kind of quantity; none for a pure number.
    pub kind: Option<Kind>,
}

impl Number {
    /// A length (m).
    pub fn length(name: &str, what: Both, value: f64) -> Number {
        Number { name: name.to_owned(), what, value, kind: Some(Kind::Length) }
    }

    /// An angle (rad).
    pub fn angle(name: &str, what: Both, value: f64) -> Number {
        Number { name: name.to_owned(), what, value, kind: Some(Kind::Angle) }
    }

    /// A pure number.
    pub fn ratio(name: &str, what: Both, value: f64) -> Number {
        Number { name: name.to_owned(), what, value, kind: None }
    }
}

/// Where points are to be at a position of the driver.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    /// Position of the driver (rad), as the scene counts it.
    pub driver: f64,
    /// Points by name, each with its place (m).
    pub places: Vec<(String, Point)>,
}

/// What the whole motion of the scene is to have, beside positions.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Demand {
    /// The time ratio of an output, whichever stroke is the slow one.
    TimeRatio(f64),
    /// The stroke of an output that slides (m).
    Stroke(f64),
    /// The swing of an output that turns (rad).
    Swing(f64),
    /// The driver turns fully.
    FullTurn,
}

/// The output's angle at a place of a function's range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compared {
    /// The variable of the function.
    pub x: f64,
    /// The crank's angle (rad).
    pub input: f64,
    /// The output's angle that is wanted (rad).
    pub wanted: f64,
    /// The output's angle as it is (rad).
    pub real: f64,
}

impl Compared {
    /// Real less wanted (rad).
    pub fn deviation(&self) -> f64 {
        self.real - self.wanted
    }
}

/// A design as its formula gives it.
#[derive(Clone, Debug, PartialEq)]
pub struct Draft {
    /// Which of the solutions it is, in words.
    pub which: Both,
    /// The scene.
    pub scene: Json,
    /// Lengths and other numbers of the design, in the order in which they are told.
    pub numbers: Vec<Number>,
    /// The positions that it is to take. The first is where the scene stands.
    pub wanted: Vec<Wanted>,
    /// What its whole motion is to have.
    pub demands: Vec<Demand>,
    /// Whether the wanted positions lie in the order of the driver's motion by wish: then an order that goes to and fro is a defect.
    pub ordered: bool,
    /// How far it misses what was wanted by design, for approximations (in whatever the task counts); 0 for what is met exactly.
    pub error: f64,
    /// Wanted against real: the places that a point is to come near to (m).
    pub targets: Vec<Point>,
    /// Wanted against real: the output's angle over the range of a function.
    pub course: Vec<Compared>,
    /// What is to be said of it.
    pub remarks: Vec<Diagnostic>,
}

impl Draft {
    /// A design that meets its wish exactly, in any order, of which nothing else is demanded.
    pub fn new(which: Both, scene: Json, numbers: Vec<Number>, wanted: Vec<Wanted>) -> Draft {
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
            remarks: Vec::new(),
        }
    }
}

/// A design with what its finished scene does.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// The design.
    pub draft: Draft,
    /// What sweeping its scene shows.
    pub judged: Judged,
}

impl Candidate {
    /// The text of its scene.
    pub fn scene_text(&self) -> String {
        scene_text(&self.draft.scene)
    }

    /// A number by its name.
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
        (word, "") if word.len() > 1 && word.bytes().all(|b| b.is_ascii_uppercase()) => format!("l_{{{word}}}"),
        (word, "") => word,
        (word, index) => format!("{word}_{{{index}}}"),
    }
}

/// A scene as a file: one key a line.
pub fn scene_text(scene: &Json) -> String {
    let Json::Object(members) = scene else { return format!("{scene}\n") };
    let lines: Vec<String> = members.iter().map(|(k, v)| format!("  {}: {}", json!(k), spaced(v))).collect();
    format!("{{\n{}\n}}\n", lines.join(",\n"))
}

/// A value in one line, with spaces as people write them.
fn spaced(value: &Json) -> String {
    match value {
        Json::Array(items) => format!("[{}]", items.iter().map(spaced).collect::<Vec<_>>().join(", ")),
        Json::Object(members) => {
            let all: Vec<String> = members.iter().map(|(k, v)| format!("{}: {}", json!(k), spaced(v))).collect();
            format!("{{{}}}", all.join(", "))
        }
        Json::String(_) | Json::Number(_) | Json::Bool(_) | Json::Null => value.to_string(),
    }
}

/// A length of a scene's text: millimetres with all digits of the number.
pub fn mm(value_m: f64) -> Json {
    Json::String(format!("{} mm", value_m * 1e3 + 0.0))
}

/// An angle of a scene's text: degrees with all digits of the number.
pub fn deg(value_rad: f64) -> Json {
    Json::String(format!("{} deg", value_rad.to_degrees() + 0.0))
}

/// A place of a scene's text.
pub fn place(at: Point) -> Json {
    Json::Array(vec![mm(at.x), mm(at.y)])
}
