//! A line of the table of quantities: what is told of all that share it.

use super::{Frame, Level, Need};
use crate::model::{OnLink, PointId};
use crate::{Lang, LinkId};
use hodograph_base::kind::Kind;

/// What a value is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Form {
    /// A number; counter-clockwise plus.
    Scalar,
    /// A vector.
    Vector,
    /// A place in the plane.
    Point,
}

impl Form {
    /// Endings of its columns in a table: a number has one column, a vector its components and its length, a place its coordinates.
    pub fn columns(self) -> &'static [&'static str] {
        match self {
            Form::Scalar => &[""],
            Form::Vector => &[".x", ".y", ""],
            Form::Point => &[".x", ".y"],
        }
    }
}

/// What stands over the letter of a symbol.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Over {
    /// Nothing.
    Nothing,
    /// This sign.
    Sign(&'static str),
    /// The sign of sliding in the notation at hand.
    Sliding,
    /// The same, and which part of it.
    SlidingPart(&'static str),
    /// The sign of the Coriolis acceleration in the notation at hand.
    Coriolis,
}

/// What a quantity is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    /// A point.
    Point(OnLink),
    /// A point, seen from another.
    Points(OnLink, OnLink),
    /// A link.
    Link(LinkId),
    /// A link, seen from another.
    Links(LinkId, LinkId),
    /// The line between two points.
    Line(PointId, PointId),
    /// A point, seen from a frame.
    Seen(OnLink, Frame),
    /// The mechanism as a whole.
    Mechanism,
}

impl Of {
    /// What must be known of it at a level.
    pub(super) fn needs(self, level: Level) -> Vec<(Need, Level)> {
        let at = |p: OnLink| (Need::Point(p.point, p.link), level);
        let end = |p: PointId| (Need::Point(p, None), level);
        match self {
            Of::Point(p) => vec![at(p)],
            Of::Points(a, b) => vec![at(a), at(b)],
            Of::Link(l) => vec![(Need::Turning(l), level)],
            Of::Links(a, b) => vec![(Need::Turning(a), level), (Need::Turning(b), level)],
            Of::Line(a, b) => vec![end(a), end(b)],
            Of::Seen(p, frame) => vec![at(p), at(frame.transport_point(p))],
            Of::Mechanism => Vec::new(),
        }
    }
}

/// A line of the table of quantities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// How `find` writes it before the `_`, in Latin letters.
    pub symbol: &'static str,
    /// A question, as an example.
    pub example: &'static str,
    /// What it is, and hence its unit.
    pub kind: Kind,
    /// How deep it asks.
    pub level: Level,
    /// What its value is.
    pub form: Form,
    /// Its letter in the label language.
    pub letter: &'static str,
    /// What stands over the letter.
    pub over: Over,
    /// Whether it is counted from a place or direction that was chosen: its size says nothing, and an error relative to it neither.
    pub from_origin: bool,
    /// In English, in Chinese.
    pub(super) name: [&'static str; 2],
    /// The same of several.
    pub(super) several: Option<[&'static str; 2]>,
}

impl Entry {
    /// A line of the table; its level is that of its kind, and its letter its symbol, where the family does not say otherwise. `name`: in
    /// English, in Chinese.
    pub(super) const fn new(symbol: &'static str, example: &'static str, kind: Kind, form: Form, name: [&'static str; 2]) -> Entry {
        let level = kind.level();
        Entry {
            symbol,
            example,
            kind,
            level,
            form,
            letter: symbol,
            over: Over::Nothing,
            from_origin: matches!(form, Form::Point),
            name,
            several: None,
        }
    }

    /// With its letter, and what stands over it.
    pub(super) const fn printed(self, letter: &'static str, over: Over) -> Entry {
        Entry { letter, over, ..self }
    }

    /// With the name of several of its quantities whose symbols say of what they are.
    pub(super) const fn several_are(self, several: [&'static str; 2]) -> Entry {
        Entry { several: Some(several), ..self }
    }

    /// As deep as this, where its kind alone does not say it.
    pub(super) const fn at_level(self, level: Level) -> Entry {
        Entry { level, ..self }
    }

    /// Counted from a chosen place or direction.
    pub(super) const fn counted_from_origin(self) -> Entry {
        Entry { from_origin: true, ..self }
    }

    /// Its name, in the label language: `normal acceleration`.
    pub fn name(&self, lang: Lang) -> &'static str {
        in_words(self.name, lang)
    }

    /// The name of several: `angular velocities of the links`.
    pub fn several(&self, lang: Lang) -> Option<&'static str> {
        self.several.map(|words| in_words(words, lang))
    }
}

fn in_words([en, zh]: [&'static str; 2], lang: Lang) -> &'static str {
    match lang {
        Lang::En => en,
        Lang::Zh => zh,
    }
}
