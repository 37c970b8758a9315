//! An interface for programs: the quantities that items show, ids in ASCII, and access to the
//! vectors and marks of a figure by name.

use std::fmt::Write as _;

use super::item::{Figure, FigureItem, Shape};
use hodograph_base::geom::Point;

/// The quantity that an item shows.
#[derive(Clone, Debug, PartialEq)]
pub struct ShownQuantity {
    /// The names of the quantity as `find` writes them: `v_B`. A vector on paper that shows several
    /// quantities has all their names; the id uses the first.
    pub names: Vec<String>,
    /// The length of a vector on paper and its value; `None` for marks.
    pub length: Option<ShownLength>,
}

/// A vector's length on paper and its value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShownLength {
    /// Length on paper in mm, as drawn.
    pub mm: f64,
    /// Value in SI units.
    pub si: f64,
}

impl ShownQuantity {
    /// Returns the quantity of a vector with one name, drawn from one point to another at a scale
    /// of `mu` SI units per mm.
    pub fn vector(name: impl Into<String>, from: Point, to: Point, mu: f64) -> ShownQuantity {
        let mm = from.distance(to);
        ShownQuantity { names: vec![name.into()], length: Some(ShownLength { mm, si: mm * mu }) }
    }

    /// Returns the quantity of a mark.
    pub fn mark(name: impl Into<String>) -> ShownQuantity {
        ShownQuantity { names: vec![name.into()], length: None }
    }
}

/// A vector of a figure.
#[derive(Clone, Debug, PartialEq)]
pub struct ShownVector<'a> {
    /// Id of its element in the SVG.
    pub id: &'a str,
    /// The names as `find` writes them.
    pub names: &'a [String],
    /// Tail, in mm of the paper, y up.
    pub from: Point,
    /// Tip, in mm of the paper.
    pub to: Point,
    /// Length on paper.
    pub mm: f64,
    /// Value in SI units: m/s, m/s².
    pub si: f64,
}

/// A mark of a figure: a point for measuring lengths.
#[derive(Clone, Debug, PartialEq)]
pub struct ShownMark<'a> {
    /// Id of its element in the SVG.
    pub id: &'a str,
    /// The names: the vector from the pole that ends at the mark (`v_B`), the part that ends there
    /// (`an_CB`), `pole-v`, `pole-a`.
    pub names: &'a [String],
    /// Position, in mm of the paper, y up.
    pub at: Point,
}

impl Figure {
    /// Returns the vectors of the figure, in drawing order.
    pub fn vectors(&self) -> impl Iterator<Item = ShownVector<'_>> {
        self.items.iter().filter_map(vector)
    }

    /// Returns the first vector with a name as `find` writes it: a vector of a polygon before those
    /// of its insets.
    ///
    /// ```
    /// use hodograph_base::geom::Point;
    /// use hodograph_paper::paper::arrow::ArrowHead;
    /// use hodograph_paper::paper::item::{Colour, Figure, FigureItem, Shape, LineStroke};
    /// use hodograph_paper::paper::shown::ShownQuantity;
    /// let (from, to) = (Point::ORIGIN, Point::new(30.0, 40.0));
    /// let arrow = FigureItem::new("velocity edge", Shape::Arrow { from, to, stroke: LineStroke::new(0.4), head: ArrowHead::VECTOR });
    /// // To a scale of 0.02 (m/s)/mm.
    /// let items = vec![arrow.with_id("vel-abs-B").showing(ShownQuantity::vector("v_B", from, to, 0.02))];
    /// let figure = Figure { width_mm: 50.0, height_mm: 50.0, title: "v".into(), desc: String::new(), lang: "en".into(), paper: Colour::WHITE, items };
    /// let b = figure.vector("v_B").unwrap();
    /// assert_eq!((b.id, b.mm, b.si), ("vel-abs-B", 50.0, 1.0));
    /// ```
    pub fn vector(&self, name: &str) -> Option<ShownVector<'_>> {
        let named =
            |i: &&FigureItem| i.shown.as_ref().is_some_and(|s| s.names.iter().any(|n| n == name));
        let inset = |i: &&FigureItem| i.class.split(' ').any(|word| word == "inset");
        let all = || self.items.iter().filter(named);
        all().filter(|i| !inset(i)).find_map(vector).or_else(|| all().find_map(vector))
    }

    /// Returns the marks of the figure, in drawing order.
    pub fn marks(&self) -> impl Iterator<Item = ShownMark<'_>> {
        self.items.iter().filter_map(mark)
    }

    /// Returns the mark with a name: `v_B` is the tip of v_B, `pole-v` the pole of the velocity
    /// polygon.
    pub fn mark(&self, name: &str) -> Option<ShownMark<'_>> {
        self.marks().find(|m| m.names.iter().any(|n| n == name))
    }
}

fn vector(item: &FigureItem) -> Option<ShownVector<'_>> {
    let (Some(shown), Shape::Arrow { from, to, .. }) = (&item.shown, &item.shape) else {
        return None;
    };
    let ShownLength { mm, si } = shown.length?;
    // A thin vector may be broken at a label: the tail is computed as if without the break.
    let from = (*from - *to).unit().map_or(*from, |back| *to + back * mm);
    Some(ShownVector { id: &item.id, names: &shown.names, from, to: *to, mm, si })
}

fn mark(item: &FigureItem) -> Option<ShownMark<'_>> {
    let (Some(shown), Shape::Circle { centre, .. }) = (&item.shown, &item.shape) else {
        return None;
    };
    Some(ShownMark { id: &item.id, names: &shown.names, at: *centre })
}

/// Escapes a name for ids in ASCII: letters, digits and `-` are kept, a comma becomes `__`, and
/// every other UTF-16 unit becomes `_` with its four hexadecimal digits.
///
/// Names of a scene contain letters, digits, `'` and `_`, and those of coincident points may have a
/// comma before the link: different names have different results.
///
/// ```
/// use hodograph_paper::paper::shown::escaped;
/// assert_eq!(["normal-C-B", "O2,3", "A'", "B_1", "杆"].map(escaped), ["normal-C-B", "O2__3", "A_0027", "B_005f1", "_6746"]);
/// ```
pub fn escaped(name: &str) -> String {
    let mut out = String::with_capacity(name.len());
    for c in name.chars() {
        match c {
            '-' => out.push('-'),
            c if c.is_ascii_alphanumeric() => out.push(c),
            ',' => out.push_str("__"),
            c => c.encode_utf16(&mut [0; 2]).iter().for_each(|unit| {
                let _ = write!(out, "_{unit:04x}");
            }),
        }
    }
    out
}

/// Returns a question as a part of an id: its `_` becomes `-`, all other characters are escaped as
/// in [`escaped`].
///
/// ```
/// assert_eq!(hodograph_paper::paper::shown::question_id("an_CB"), "an-CB");
/// ```
pub fn question_id(text: &str) -> String {
    // A hyphen is a comma in `find`; in ids it separates words.
    let parts: Vec<String> =
        text.split('_').map(|part| escaped(part).replace('-', "_002d")).collect();
    parts.join("-")
}
