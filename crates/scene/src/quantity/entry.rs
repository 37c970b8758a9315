//! A row of the table of quantities: the properties that all quantities with this row share.

use super::{Frame, Level, Need};
use crate::model::{OnLink, PointId};
use crate::{Lang, LinkId};
use hodograph_base::kind::Kind;

/// The form of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ValueForm {
    /// A number; positive counter-clockwise.
    Scalar,
    /// A vector.
    Vector,
    /// A place in the plane.
    Point,
}

impl ValueForm {
    /// Returns the endings of its columns in a table: a number has one column, a vector its
    /// components and its magnitude, a place its coordinates.
    pub fn columns(self) -> &'static [&'static str] {
        match self {
            ValueForm::Scalar => &[""],
            ValueForm::Vector => &[".x", ".y", ""],
            ValueForm::Point => &[".x", ".y"],
        }
    }
}

/// The sign above the letter of a symbol.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OverSign {
    /// No sign.
    Nothing,
    /// This sign.
    Sign(&'static str),
    /// The sign of sliding in the notation at hand.
    Sliding,
    /// The sign of sliding in the notation at hand, with a mark for the part.
    SlidingPart(&'static str),
    /// The sign of the Coriolis acceleration in the notation at hand.
    Coriolis,
}

/// The object of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    /// A point.
    Point(OnLink),
    /// A point relative to another.
    Points(OnLink, OnLink),
    /// A link.
    Link(LinkId),
    /// A link relative to another.
    Links(LinkId, LinkId),
    /// The line between two points.
    Line(PointId, PointId),
    /// A point observed from a frame.
    Seen(OnLink, Frame),
    /// The mechanism as a whole.
    Mechanism,
}

impl Of {
    /// Returns the motions that must be known at a level.
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

/// A row of the table of quantities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// The symbol before the `_` in `find`, in Latin letters.
    pub symbol: &'static str,
    /// An example of a question.
    pub example: &'static str,
    /// The kind, which determines the unit.
    pub kind: Kind,
    /// The level of motion.
    pub level: Level,
    /// The form of the value.
    pub form: ValueForm,
    /// Its letter in the label language.
    pub letter: &'static str,
    /// The sign above the letter.
    pub over: OverSign,
    /// True if the value is measured from a chosen place or direction: then its size has no
    /// meaning, nor has an error relative to it.
    pub from_origin: bool,
    /// Name in English and in Chinese.
    pub(super) name: [&'static str; 2],
    /// Plural name in English and in Chinese.
    pub(super) several: Option<[&'static str; 2]>,
}

impl Entry {
    /// Returns a row of the table. The default level is that of the kind, the default letter the
    /// symbol. `name` is in English and in Chinese.
    pub(super) const fn new(
        symbol: &'static str,
        example: &'static str,
        kind: Kind,
        form: ValueForm,
        name: [&'static str; 2],
    ) -> Entry {
        let level = kind.level();
        Entry {
            symbol,
            example,
            kind,
            level,
            form,
            letter: symbol,
            over: OverSign::Nothing,
            from_origin: matches!(form, ValueForm::Point),
            name,
            several: None,
        }
    }

    /// Returns the row with this letter and the sign above it.
    pub(super) const fn printed(self, letter: &'static str, over: OverSign) -> Entry {
        Entry { letter, over, ..self }
    }

    /// Returns the row with a plural name, for quantities whose symbols include their objects.
    pub(super) const fn several_are(self, several: [&'static str; 2]) -> Entry {
        Entry { several: Some(several), ..self }
    }

    /// Returns the row with this level, if the kind does not determine it.
    pub(super) const fn at_level(self, level: Level) -> Entry {
        Entry { level, ..self }
    }

    /// Returns the row of a quantity measured from a chosen place or direction.
    pub(super) const fn counted_from_origin(self) -> Entry {
        Entry { from_origin: true, ..self }
    }

    /// Returns its name in a language: `normal acceleration`.
    pub fn name(&self, lang: Lang) -> &'static str {
        lang.pick(self.name)
    }

    /// Returns its plural name: `angular velocities of the links`.
    pub fn several(&self, lang: Lang) -> Option<&'static str> {
        self.several.map(|words| lang.pick(words))
    }
}
