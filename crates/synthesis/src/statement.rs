//! The text of a worksheet for a task: givens, unknowns, and the closed formula with its numbers as
//! the proof of the drawing.
//!
//! Sentences have formulas between dollar signs; formulas are in the label language, with
//! `\frac{a}{b}` and `\sqrt{a}` on their top level. Lengths and angles in them are in SI between ⦃
//! and ⦄ ([`length`], [`angle`], [`place`]) until [`Statement::written`] and [`Proof::written`]
//! convert them to the units of the file. This module defines the structure and the format of
//! numbers; the text itself is in the file of each kind.

use super::candidate::{DesignNumber, Draft};
use hodograph_base::diag::{Both, both};
use hodograph_base::digits::{inked, significant};
use hodograph_base::geom::Point;
use hodograph_scene::{Book, Kind};

/// The task as a problem.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Statement {
    /// The linkage to design.
    pub task: Both,
    /// The givens, one per line.
    pub given: Vec<Both>,
    /// The unknowns, one per line.
    pub wanted: Vec<Both>,
    /// The number of leading construction steps that show givens only.
    pub open_steps: usize,
}

/// A piece of the proof: a sentence, then formulas on lines of their own.
#[derive(Clone, Debug, PartialEq)]
pub struct Proof {
    /// The sentence.
    pub what: Both,
    /// The formulas.
    pub formulas: Vec<String>,
}

impl Proof {
    /// A sentence and its formulas.
    pub fn new(what: Both, formulas: impl IntoIterator<Item = String>) -> Proof {
        Proof { what, formulas: formulas.into_iter().collect() }
    }

    /// The proof with its quantities in the units of a file.
    #[must_use]
    pub fn written(&self, book: &Book) -> Proof {
        Proof {
            what: both_written(&self.what, book),
            formulas: self.formulas.iter().map(|f| written(f, book)).collect(),
        }
    }
}

impl Statement {
    /// The statement with its quantities in the units of a file.
    #[must_use]
    pub fn written(&self, book: &Book) -> Statement {
        let all = |list: &[Both]| list.iter().map(|b| both_written(b, book)).collect();
        Statement {
            task: both_written(&self.task, book),
            given: all(&self.given),
            wanted: all(&self.wanted),
            open_steps: self.open_steps,
        }
    }
}

/// Delimiters of a quantity in SI: `⦃0.05⦄` a length, `⦃a1.2⦄` an angle, `⦃b0.05⦄` a length without
/// its unit, `⦃u⦄` the unit of lengths.
const QUANTITY: [char; 2] = ['\u{2983}', '\u{2984}'];

fn both_written(text: &Both, book: &Book) -> Both {
    Both { en: written(&text.en, book), zh: written(&text.zh, book) }
}

/// A text with its quantities in the units of a file: in millimetres and degrees if it names none.
fn written(text: &str, book: &Book) -> String {
    let [open, close] = QUANTITY;
    let mut out = String::with_capacity(text.len());
    for (k, piece) in text.split(open).enumerate() {
        match piece.split_once(close).filter(|_| k > 0) {
            Some((quantity, rest)) => {
                out += &quantity_written(quantity, book);
                out += rest;
            }
            None => out += piece,
        }
    }
    out
}

fn quantity_written(text: &str, book: &Book) -> String {
    let chosen = book.chosen(Kind::Length).is_some();
    let in_unit = |si: f64| number(if chosen { book.value(Kind::Length, si) } else { si * 1e3 });
    let value = |digits: &str| digits.parse::<f64>().unwrap_or(f64::NAN);
    if text == "u" {
        return if chosen { book.name(Kind::Length).to_owned() } else { "mm".to_owned() };
    }
    if let Some(angle) = text.strip_prefix('a') {
        return book.label(Kind::Angle, &number(book.value(Kind::Angle, value(angle))));
    }
    if let Some(bare) = text.strip_prefix('b') {
        return in_unit(value(bare));
    }
    let told = in_unit(value(text));
    if chosen { book.label(Kind::Length, &told) } else { format!("{told} mm") }
}

/// Significant digits of numbers in a proof.
const DIGITS: usize = 6;

/// A number in the label language: rounded, without trailing zeros if that is exact, else with all
/// its digits.
pub fn number(value: f64) -> String {
    let rounded = significant(value + 0.0, DIGITS);
    let exact = rounded.parse::<f64>().is_ok_and(|r| (r - value).abs() <= 1e-13 * value.abs());
    let text = match exact && rounded.contains('.') && !rounded.contains('e') {
        true => rounded.trim_end_matches('0').trim_end_matches('.'),
        false => rounded.as_str(),
    };
    inked(text)
}

/// A length in the label language.
pub fn length(value_m: f64) -> String {
    let [open, close] = QUANTITY;
    format!("{open}{value_m:e}{close}")
}

/// An angle in the label language.
pub fn angle(value_rad: f64) -> String {
    let [open, close] = QUANTITY;
    format!("{open}a{value_rad:e}{close}")
}

/// A number that is subtracted, with its sign: `− 0.5`; `+ 0.5` for a negative number.
pub fn subtracted(value: f64) -> String {
    format!("{} {}", if value < 0.0 { "+" } else { "−" }, number(value.abs()))
}

/// A place in the label language.
pub fn place(at: Point) -> String {
    let [open, close] = QUANTITY;
    let bare = |v: f64| format!("{open}b{:e}{close}", if v.abs() < 1e-15 { 0.0 } else { v });
    format!("({},\\, {})\\,\\text{{{open}u{close}}}", bare(at.x), bare(at.y))
}

/// The value of a number of a design by its name; NaN, which is printed as a dash, if there is
/// none.
pub fn of(draft: &Draft, name: &str) -> f64 {
    draft.numbers.iter().find(|n: &&DesignNumber| n.name == name).map_or(f64::NAN, |n| n.value)
}

/// The lengths of a four-bar as unknowns.
pub fn four_bar_wanted() -> Both {
    both!("the lengths $l_{{AB}}$ (crank), $l_{{BC}}$ (coupler), $l_{{CD}}$ (follower)")
}

/// The time ratio and the angle that follows from it.
pub fn angle_of_limits(k: f64, theta: f64) -> Proof {
    Proof::new(
        both!("The crank angle between the limit positions follows from the time ratio:"),
        [format!(
            "\\theta = 180\\degree \\times \\frac{{K − 1}}{{K + 1}} = 180\\degree \\times \\frac{{{0} − 1}}{{{0} + 1}} = {1}",
            number(k),
            angle(theta)
        )],
    )
}

/// Crank and coupler from the distances of the limits of C from A.
pub fn half_difference(ac: [f64; 2], ab: f64, bc: f64) -> Proof {
    let far = usize::from(ac[1] > ac[0]);
    let (long, short) = (ac[far], ac[1 - far]);
    let (l, s) = (far + 1, 2 - far);
    Proof::new(
        both!(
            "In its limit positions crank and coupler lie in line: $l_{{AC_{l}}} = l_{{BC}} + l_{{AB}}$ and $l_{{AC_{s}}} = l_{{BC}} − l_{{AB}}$."
        ),
        [
            format!("l_{{AC_{l}}} = {} ,\\quad l_{{AC_{s}}} = {}", length(long), length(short)),
            format!("l_{{AB}} = \\frac{{l_{{AC_{l}}} − l_{{AC_{s}}}}}{{2}} = {}", length(ab)),
            format!("l_{{BC}} = \\frac{{l_{{AC_{l}}} + l_{{AC_{s}}}}}{{2}} = {}", length(bc)),
        ],
    )
}

/// The centre of the circle through three places, as two linear equations and their solution.
pub fn centre_of_three(what: Both, places: [Point; 3], sought: &str, found: Point) -> Proof {
    let mm = |v: f64| v * 1e3;
    let equation = |p: Point, q: Point| {
        let (u, v) = (mm(q.x - p.x), mm(q.y - p.y));
        let right =
            (mm(q.x) * mm(q.x) + mm(q.y) * mm(q.y) - mm(p.x) * mm(p.x) - mm(p.y) * mm(p.y)) / 2.0;
        let sign = if v < 0.0 { "−" } else { "+" };
        format!(
            "{}\\,x_{{{sought}}} {sign} {}\\,y_{{{sought}}} = {}",
            number(u),
            number(v.abs()),
            number(right)
        )
    };
    Proof::new(
        what,
        [
            format!(
                "{} ,\\quad {}",
                equation(places[0], places[1]),
                equation(places[0], places[2])
            ),
            format!("{sought} = {}", place(found)),
        ],
    )
}
