//! Writes figures as SVG: millimetres, letters as outlines, y turned over.
//!
//! There is no `<text>`, no `<marker>` and no `<style>`: all programs draw the remaining elements
//! alike. A letter's outline is defined once, in `<defs>`, and used wherever the letter occurs (by
//! `xlink:href`, which older programs also know). Its name contains its font, number and size, so
//! that several figures can be combined in one page: the same name is the same outline. Attributes
//! are sorted by name (by the `svg` crate), elements are in the order of the items: the same figure
//! gives the same bytes.
//!
//! Ids, classes and the attributes `data-name`, `data-mm` and `data-si` are a versioned contract
//! ([`CONTRACT`]), described in docs/svg.md.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use ::svg::Document;
use ::svg::node::element::{Circle, Definitions, Description, Group, Line, Path, Rectangle, Title};
use ::svg::node::{Blob, Node, Text};

use crate::paper::arrow;
use crate::paper::extent::{anchor_shift_em, on_circle};
use crate::paper::item::{Cap, Colour, Figure, FigureItem, LineStroke, PathPiece, Shape};
use crate::paper::label::Label;
use crate::paper::text::{self, Typeset};
use hodograph_base::diag::{Faults, Warned, both};
use hodograph_base::geom::Point;

use super::not_finite;
use super::number::{mm, si};
use letters::{LetterGlyph, LetterKey, editable, letters, outline_data, scale};

mod letters;
mod live;
mod prefix;

pub use live::{Delta, LiveFigure, PreparedFigure};
pub use prefix::IdPrefix;

/// The version of the contract of ids, classes and data attributes, which the root element states
/// in `data-hodograph`.
pub const CONTRACT: &str = "svg/1";

/// Writes a figure.
///
/// Warnings: `missing-glyph` for a character that no font has.
///
/// # Errors
///
/// `label-syntax` for a label that cannot be read, `not-finite` for an item with a coordinate that
/// is not finite, all of them in the order of the items.
///
/// ```
/// use hodograph_paper::paper::item::{Colour, Figure, FigureItem, Shape, LineStroke};
/// use hodograph_base::geom::Point;
/// use hodograph_paper::render::svg;
/// let edge = Shape::Line { from: Point::ORIGIN, to: Point::new(4.0, 3.0), stroke: LineStroke::new(0.4) };
/// let items = vec![FigureItem::new("link", edge).with_id("crank")];
/// let figure = Figure { width_mm: 10.0, height_mm: 10.0, title: "A link".into(), desc: String::new(), lang: "en".into(), paper: Colour::WHITE, items };
/// // y up on the paper, down in the file: 3 mm above the lower edge is 7 mm below the upper one.
/// assert!(svg::write(&figure)?.value.contains(r#"x2="4" y1="10" y2="7""#));
/// # Ok::<(), hodograph_base::diag::Faults>(())
/// ```
pub fn write(figure: &Figure) -> Result<Warned<String>, Faults> {
    document(figure, LetterForm::Used)
}

/// Writes a figure with labels as text, which drawing programs can edit; its appearance depends on
/// the fonts of the viewer's machine.
///
/// # Errors
/// As [`write()`].
pub fn write_editable(figure: &Figure) -> Result<Warned<String>, Faults> {
    document(figure, LetterForm::Text)
}

fn document(figure: &Figure, writing: LetterForm) -> Result<Warned<String>, Faults> {
    let mut writer = SvgWriter { writing, data: true, ..SvgWriter::new(figure.height_mm) };
    let mut document = root(figure)?;
    let mut items: Vec<Box<dyn Node>> = Vec::with_capacity(figure.items.len());
    for item in &figure.items {
        items.extend(writer.finite(item));
    }
    if !writer.letters.is_empty() {
        document = with_letters(document, writer.definitions());
    }
    for item in items {
        document.append(item);
    }
    if writer.faults.has_errors() {
        return Err(writer.faults);
    }
    let mut value = document.to_string();
    value.push('\n');
    Ok(Warned { value, notes: writer.faults.list.into_iter().chain(figure.remarks()).collect() })
}

/// The document of a figure without its items.
fn root(figure: &Figure) -> Result<Document, Faults> {
    if !(figure.width_mm.is_finite() && figure.height_mm.is_finite()) {
        return Err(not_finite(both!(
            "the paper is {} mm by {} mm",
            figure.width_mm,
            figure.height_mm
        ))
        .into());
    }
    let (w, h) = (mm(figure.width_mm), mm(figure.height_mm));
    let mut document = Document::new()
        .set("width", format!("{w}mm"))
        .set("height", format!("{h}mm"))
        .set("viewBox", format!("0 0 {w} {h}"))
        .set("role", "img")
        .set("lang", figure.lang.as_str())
        .set("data-hodograph", CONTRACT)
        .add(Title::new(figure.title.as_str()))
        .add(Description::new().add(Text::new(figure.desc.as_str())));
    if figure.paper != Colour::WHITE {
        let paper = Rectangle::new()
            .set("width", w.as_str())
            .set("height", h.as_str())
            .set("class", "paper")
            .set("fill", hex(figure.paper));
        document = document.add(paper);
    }
    Ok(document)
}

/// Adds the outlines of letters.
fn with_letters(document: Document, outlines: impl Into<Box<dyn Node>>) -> Document {
    let mut document = document.set("xmlns:xlink", "http://www.w3.org/1999/xlink");
    document.append(outlines);
    document
}

/// Items as elements, one string each, for pages that assemble documents themselves. They have no
/// data attributes, because the numbers of moving items differ between frames.
pub struct Elements {
    writer: SvgWriter,
}

impl Elements {
    /// Returns a writer for documents of this height.
    pub fn new(height_mm: f64) -> Elements {
        Elements { writer: SvgWriter::new(height_mm) }
    }

    /// Returns the elements of these items, one for each.
    ///
    /// # Errors
    /// As [`write()`].
    pub fn of(&mut self, items: &[FigureItem]) -> Result<Vec<String>, Faults> {
        let list = items
            .iter()
            .map(|item| self.writer.finite(item).map(|node| node.to_string()).unwrap_or_default())
            .collect();
        if self.writer.faults.has_errors() {
            Err(std::mem::take(&mut self.writer.faults))
        } else {
            Ok(list)
        }
    }

    /// Returns the outlines that all these elements use.
    pub fn letters<'a>(all: impl IntoIterator<Item = &'a Elements>) -> String {
        let letters = all
            .into_iter()
            .flat_map(|e| &e.writer.letters)
            .map(|(key, kept)| (*key, kept.clone()))
            .collect();
        SvgWriter { letters, ..SvgWriter::new(0.0) }.definitions().to_string()
    }
}

/// The form of letters in a document.
#[derive(Clone, Copy, PartialEq, Eq)]
enum LetterForm {
    /// By reference; the outlines are in `<defs>`.
    Used,
    /// Text in the fonts of the viewer.
    Text,
}

struct SvgWriter {
    height_mm: f64,
    writing: LetterForm,
    /// True if vectors and marks have data attributes.
    data: bool,
    /// The letters used, each with its name in the definitions.
    letters: BTreeMap<LetterKey, (LetterGlyph, String)>,
    faults: Faults,
}

impl SvgWriter {
    fn new(height_mm: f64) -> SvgWriter {
        SvgWriter {
            height_mm,
            writing: LetterForm::Used,
            data: false,
            letters: BTreeMap::new(),
            faults: Faults::default(),
        }
    }

    /// Converts a y coordinate from y up to y down.
    fn y(&self, y: f64) -> String {
        mm(self.height_mm - y)
    }

    fn xy(&self, p: Point) -> String {
        format!("{} {}", mm(p.x), self.y(p.y))
    }

    /// Returns the item's element; a number that is not finite is an error, because every viewer
    /// would silently drop the whole path.
    fn finite(&mut self, item: &FigureItem) -> Option<Box<dyn Node>> {
        if item.is_finite() {
            return Some(self.item(item));
        }
        let name = if item.id.is_empty() { &item.class } else { &item.id };
        self.faults.push(not_finite(both!("item `{name}` has a coordinate that is not a number")));
        None
    }

    fn item(&mut self, item: &FigureItem) -> Box<dyn Node> {
        match &item.shape {
            Shape::Line { from, to, stroke } => self.line(*from, *to, stroke, item).into(),
            Shape::Polyline { points, closed, stroke, fill } => {
                let mut d = String::new();
                for (i, p) in points.iter().enumerate() {
                    let _ = write!(d, "{}{}", if i == 0 { "M" } else { "L" }, self.xy(*p));
                }
                self.path(d, *closed, stroke.as_ref(), *fill, item).into()
            }
            Shape::Path { start, pieces, closed, stroke, fill } => {
                let mut d = format!("M{}", self.xy(*start));
                for piece in pieces {
                    match *piece {
                        PathPiece::Move(p) => {
                            let _ = write!(d, "M{}", self.xy(p));
                        }
                        PathPiece::Line(p) => {
                            let _ = write!(d, "L{}", self.xy(p));
                        }
                        PathPiece::Arc { centre, radius_mm, from_rad, to_rad } => {
                            d += &self.arc_to(centre, radius_mm, from_rad, to_rad)
                        }
                    }
                }
                self.path(d, *closed, stroke.as_ref(), *fill, item).into()
            }
            Shape::Circle { centre, radius_mm, stroke, fill } => {
                let mut circle = Circle::new()
                    .set("cx", mm(centre.x))
                    .set("cy", self.y(centre.y))
                    .set("r", mm(*radius_mm));
                self.named(&mut circle, item);
                painted(&mut circle, stroke.as_ref(), *fill);
                if fill.is_none() {
                    circle.assign("fill", "none");
                }
                circle.into()
            }
            Shape::Arc { centre, radius_mm, from_rad, to_rad, stroke } => self
                .path(
                    self.arc(*centre, *radius_mm, *from_rad, *to_rad),
                    false,
                    Some(stroke),
                    None,
                    item,
                )
                .into(),
            Shape::Arrow { from, to, stroke, head } => {
                let parts = arrow::straight(*from, *to, *head);
                let mut group = Group::new();
                self.named(&mut group, item);
                let nameless = FigureItem::new("", item.shape.clone());
                group
                    .add(self.line(*from, parts.shaft_end, stroke, &nameless))
                    .add(self.head(&parts.head, stroke.colour))
                    .into()
            }
            Shape::ArcArrow { centre, radius_mm, from_rad, to_rad, stroke, head } => {
                let parts = arrow::bent(*centre, *radius_mm, *from_rad, *to_rad, *head);
                let mut group = Group::new();
                self.named(&mut group, item);
                let nameless = FigureItem::new("", item.shape.clone());
                let shaft = self.arc(*centre, *radius_mm, *from_rad, parts.shaft_end_rad);
                group
                    .add(self.path(shaft, false, Some(stroke), None, &nameless))
                    .add(self.head(&parts.head, stroke.colour))
                    .into()
            }
            Shape::Label { at, label, size_mm, anchor, colour } => {
                let set = text::set(label);
                let left = at.x - anchor_shift_em(*anchor, set.width_em) * size_mm;
                self.lettering(
                    item,
                    &format!("translate({} {})", mm(left), self.y(at.y)),
                    label,
                    &set,
                    *size_mm,
                    *colour,
                )
            }
            Shape::Turned { at, angle_rad, label, size_mm, colour } => {
                let set = text::set(label);
                let turn = format!(
                    "rotate({})translate({} 0)",
                    mm(-angle_rad.to_degrees()),
                    mm(-set.width_em * size_mm / 2.0)
                );
                self.lettering(
                    item,
                    &format!("translate({} {}){turn}", mm(at.x), self.y(at.y)),
                    label,
                    &set,
                    *size_mm,
                    *colour,
                )
            }
        }
    }

    /// Returns a label whose line starts at the origin of `place`; with y down, angles have the
    /// opposite sign.
    fn lettering(
        &mut self,
        item: &FigureItem,
        place: &str,
        label: &Label,
        set: &Typeset,
        size_mm: f64,
        colour: Colour,
    ) -> Box<dyn Node> {
        let (transform, content) = match self.writing {
            LetterForm::Used => (format!("{place}scale({})", scale(size_mm)), self.used(set)),
            LetterForm::Text => (place.to_owned(), editable(set, size_mm)),
        };
        let spoken = Group::new().set("aria-label", label.plain()).set("data-text", label.source());
        let mut node = spoken.set("transform", transform).add(Blob::new(content));
        self.named(&mut node, item);
        if colour != Colour::BLACK {
            node.assign("fill", hex(colour));
        }
        self.faults.list.extend(set.faults.iter().cloned());
        node.into()
    }

    /// Returns the letters of a label, each used from the definitions.
    fn used(&mut self, set: &Typeset) -> String {
        let mut out = String::new();
        for (letter, [x, y]) in letters(set) {
            let (_, name) = self.letters.entry(letter.key()).or_insert_with(|| {
                let name = letter.name();
                (letter, name)
            });
            let _ = write!(out, "<use xlink:href=\"#{name}\"");
            for (axis, at) in [("x", x), ("y", -y)] {
                if at != 0 {
                    let _ = write!(out, " {axis}=\"{at}\"");
                }
            }
            out.push_str("/>");
        }
        out
    }

    /// Returns the outlines of all letters used.
    fn definitions(&self) -> Definitions {
        let mut out = String::new();
        for (letter, name) in self.letters.values() {
            let _ = write!(out, "<path id=\"{name}\" d=\"{}\"/>", outline_data(letter.contours()));
        }
        Definitions::new().add(Blob::new(out))
    }

    fn line(&self, from: Point, to: Point, stroke: &LineStroke, item: &FigureItem) -> Line {
        let mut line = Line::new()
            .set("x1", mm(from.x))
            .set("y1", self.y(from.y))
            .set("x2", mm(to.x))
            .set("y2", self.y(to.y));
        self.named(&mut line, item);
        painted(&mut line, Some(stroke), None);
        line
    }

    fn path(
        &self,
        mut d: String,
        closed: bool,
        stroke: Option<&LineStroke>,
        fill: Option<Colour>,
        item: &FigureItem,
    ) -> Path {
        if closed {
            d.push('Z');
        }
        let mut path = Path::new().set("d", d);
        self.named(&mut path, item);
        painted(&mut path, stroke, fill);
        if fill.is_none() {
            path.assign("fill", "none");
        }
        path
    }

    fn named(&self, node: &mut impl Node, item: &FigureItem) {
        if !item.id.is_empty() {
            node.assign("id", item.id.as_str());
        }
        if !item.class.is_empty() {
            node.assign("class", item.class.as_str());
        }
        let Some(shown) = item.shown.as_ref().filter(|_| self.data) else { return };
        node.assign("data-name", shown.names.join(" "));
        if let Some(length) = shown.length {
            node.assign("data-mm", mm(length.mm));
            node.assign("data-si", si(length.si));
        }
    }

    fn head(&self, corners: &[Point], colour: Colour) -> Path {
        let mut d = String::new();
        for (i, p) in corners.iter().enumerate() {
            let _ = write!(d, "{}{}", if i == 0 { "M" } else { "L" }, self.xy(*p));
        }
        d.push('Z');
        let mut path = Path::new().set("d", d).set("class", "head");
        painted(&mut path, None, Some(colour));
        path
    }

    fn arc(&self, centre: Point, radius_mm: f64, from_rad: f64, to_rad: f64) -> String {
        format!(
            "M{}{}",
            self.xy(on_circle(centre, radius_mm, from_rad)),
            self.arc_to(centre, radius_mm, from_rad, to_rad)
        )
    }

    /// Adds an arc in pieces of at most a third of a turn: the large-arc flag is never needed, full
    /// circles close, and the rounding of the ends cannot move the centre (with half a turn it
    /// moves by the square root of the rounding: 0.2 mm for a radius of 30 mm).
    fn arc_to(&self, centre: Point, radius_mm: f64, from_rad: f64, to_rad: f64) -> String {
        let sweep = to_rad - from_rad;
        let pieces = (sweep.abs() / (std::f64::consts::TAU / 3.0)).ceil().max(1.0) as usize;
        // Counter-clockwise with y up is sweep-flag 0 with y down.
        let flag = u8::from(sweep < 0.0);
        let r = mm(radius_mm);
        let mut d = String::new();
        for k in 1..=pieces {
            let end = on_circle(centre, radius_mm, from_rad + sweep * k as f64 / pieces as f64);
            let _ = write!(d, "A{r} {r} 0 0 {flag} {}", self.xy(end));
        }
        d
    }
}

fn painted(node: &mut impl Node, stroke: Option<&LineStroke>, fill: Option<Colour>) {
    if let Some(s) = stroke {
        node.assign("stroke", hex(s.colour));
        node.assign("stroke-width", mm(s.width_mm));
        if s.cap == Cap::Round {
            node.assign("stroke-linecap", "round");
            node.assign("stroke-linejoin", "round");
        }
        let pattern = s.dash.pattern_mm();
        if !pattern.is_empty() {
            node.assign(
                "stroke-dasharray",
                pattern.iter().map(|&d| mm(d)).collect::<Vec<_>>().join(" "),
            );
        }
    }
    if let Some(c) = fill {
        node.assign("fill", hex(c));
    }
}

/// Returns a colour as in markup: `#1a2b3c`.
pub fn hex(c: Colour) -> String {
    format!("#{:02x}{:02x}{:02x}", c.r, c.g, c.b)
}

#[cfg(test)]
mod tests;
