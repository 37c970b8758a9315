//! Writes figures as a PDF: one page each, lines as vectors, letters as text in embedded subsets of
//! the figures' fonts.
//!
//! The file has the same bytes on every run (it contains no date and no random name). Letters keep
//! their characters, so that mathematics and Chinese can be searched and copied; a page tells
//! screen readers the roles of its parts ([`Kind`]), as PDF/UA-1 (ISO 14289-1) requires. Positions
//! are decided elsewhere.

mod structure;

use std::collections::BTreeMap;

use krilla::color::{luma, rgb};
use krilla::configure::{Accessibility, ConfigurationBuilder};
use krilla::error::KrillaResult;
use krilla::geom::{PathBuilder, Point as At, Transform};
use krilla::metadata::Metadata;
use krilla::num::NormalizedF32;
use krilla::outline::{Outline, OutlineNode};
use krilla::page::PageSettings;
use krilla::paint::{Fill, LineCap, LineJoin, Paint, Stroke as Pen, StrokeDash};
use krilla::surface::Surface;
use krilla::tagging::{
    Artifact, ArtifactType, ContentTag, Identifier, Node, Tag, TagGroup, TagTree,
};
use krilla::text::{Font, GlyphId, KrillaGlyph};
use krilla::{Data, Document, SerializeSettings};

use self::structure::OpenList;
use super::pages::{Kind, Page};
use crate::paper::arrow;
use crate::paper::extent::{anchor_shift_em, on_circle};
use crate::paper::font::FaceKey;
use crate::paper::item::{Cap, Colour, Figure, FigureItem, LineStroke, PathPiece, Shape};
use crate::paper::label::Label;
use crate::paper::text;
use hodograph_base::diag::{Diagnostic, Faults, Warned, both};
use hodograph_base::geom::{Point, Vec2};

/// Points per millimetre: PDF measures in 1/72 inch.
const POINTS_PER_MM: f32 = 72.0 / 25.4;
/// Largest side of a page: 14 400 points (PDF 1.7, annex C.2).
const SIDE_MAX_MM: f64 = 14_400.0 / 72.0 * 25.4;
/// The mitre limit of SVG, for the same picture in both formats.
const MITRE: f32 = 4.0;

/// Writes figures, one per page, each page as large as its figure. Title and language are those of
/// the first.
///
/// Warnings and errors are those of [`document`].
///
/// ```
/// use hodograph_paper::paper::item::{Colour, Figure, FigureItem, Shape, LineStroke};
/// use hodograph_base::geom::Point;
/// use hodograph_paper::render::pdf;
/// let edge = Shape::Line { from: Point::ORIGIN, to: Point::new(4.0, 3.0), stroke: LineStroke::new(0.4) };
/// let items = vec![FigureItem::new("link", edge)];
/// let (title, lang) = ("A link".into(), "en".into());
/// let figure = Figure { width_mm: 10.0, height_mm: 10.0, title, desc: String::new(), lang, paper: Colour::WHITE, items };
/// let file = pdf::pdf(&[figure])?.value;
/// assert!(file.starts_with(b"%PDF-1.7"));
/// # Ok::<(), hodograph_base::diag::Faults>(())
/// ```
pub fn pdf(figures: &[Figure]) -> Result<Warned<Vec<u8>>, Faults> {
    let pages: Vec<Page> = figures.iter().map(Page::of).collect();
    let (title, lang) = figures.first().map_or(("", "en"), |f| (f.title.as_str(), f.lang.as_str()));
    let mut file = document(&pages, title, lang)?;
    file.notes.extend(figures.iter().flat_map(Figure::remarks));
    Ok(file)
}

/// Writes a document; `lang` is a language tag such as `en` or `zh`.
///
/// Warnings: `missing-glyph` for a character that no font has; `pdf-ua` if the file does not meet
/// PDF/UA-1 because of such a character, a missing title or a picture without a description.
///
/// # Errors
/// `page-size` for a page without size or above 5080 mm, `not-finite` for an item with a coordinate
/// that is not finite, `label-syntax` for a label that cannot be read, `pdf` if the file cannot be
/// made (a limit of PDF).
pub fn document(pages: &[Page], title: &str, lang: &str) -> Result<Warned<Vec<u8>>, Faults> {
    let mut faults = Faults::default();
    let mut faces = BTreeMap::new();
    for page in pages {
        let (w, h) = (page.width_mm, page.height_mm);
        if !(w > 0.0 && h > 0.0 && w <= SIDE_MAX_MM && h <= SIDE_MAX_MM) {
            let help = both!("a page of a PDF is at most {SIDE_MAX_MM} mm long and wide");
            faults.push(
                Diagnostic::error("page-size", both!("the page is {w} mm by {h} mm")).help(help),
            );
        }
        for item in page.parts.iter().flat_map(|p| &p.items) {
            if !item.is_finite() {
                let name = if item.id.is_empty() { &item.class } else { &item.id };
                faults.push(Diagnostic::error(
                    "not-finite",
                    both!("item `{name}` has a coordinate that is not a number"),
                ));
            }
            if let Shape::Label { label, .. } | Shape::Turned { label, .. } = &item.shape {
                let set = text::set(label);
                faults.list.extend(set.faults.iter().cloned());
                faces.extend(set.runs.iter().map(|r| (r.face.key(), r.face.clone())));
            }
        }
    }
    let mut fonts = BTreeMap::new();
    for (key, face) in faces {
        match Font::new(Data::from(face.bytes()), 0) {
            Some(font) => drop(fonts.insert(key, font)),
            None => {
                let d =
                    Diagnostic::error("font", both!("the font {face:?} cannot be put into a PDF"));
                faults.push(d.help(both!("write an SVG or a PNG, or give another font")));
            }
        }
    }
    if faults.has_errors() {
        return Err(faults);
    }
    let accessible =
        ConfigurationBuilder::new().with_accessibility_validator(Accessibility::UA1).finish();
    let settings = SerializeSettings {
        configuration: accessible.expect("PDF 1.7 has PDF/UA-1"),
        ..SerializeSettings::default()
    };
    let made = written(pages, title, lang, &fonts, settings).or_else(|e| {
        let told = both!("the PDF does not meet PDF/UA-1: {e}");
        faults.push(Diagnostic::warning("pdf-ua", told));
        written(pages, title, lang, &fonts, SerializeSettings::default())
    });
    match made {
        Ok(value) => Ok(Warned { value, notes: faults.list }),
        Err(e) => Err(Diagnostic::error("pdf", both!("the PDF cannot be made: {e}")).into()),
    }
}

fn written(
    pages: &[Page],
    title: &str,
    lang: &str,
    fonts: &BTreeMap<FaceKey, Font>,
    settings: SerializeSettings,
) -> KrillaResult<Vec<u8>> {
    let mut writer = PdfWriter { fonts, tags: Vec::new(), list: None, outline: Outline::new() };
    let mut file = Document::new_with(settings);
    for (n, page) in pages.iter().enumerate() {
        writer.page(&mut file, n, page);
    }
    writer.end_list();
    file.set_metadata(
        Metadata::new()
            .title(title.to_owned())
            .language(lang.to_owned())
            .creator("hodograph".to_owned()),
    );
    file.set_outline(writer.outline);
    file.set_tag_tree(TagTree::from(writer.tags).with_lang(Some(lang.to_owned())));
    file.finish().map(without_suspects)
}

/// Removes the catalog's `/Suspects false`, which is the default value (PDF 1.7, table 321):
/// Poppler accepts no `false` there and reports a syntax error. Blanks preserve the offsets of the
/// cross-reference table.
fn without_suspects(mut file: Vec<u8>) -> Vec<u8> {
    const ENTRY: &[u8] = b"/Suspects false";
    // The catalog is among the last objects.
    if let Some(at) = file.windows(ENTRY.len()).rposition(|w| w == ENTRY) {
        file[at..at + ENTRY.len()].fill(b' ');
    }
    file
}

struct PdfWriter<'a> {
    /// The fonts of all labels.
    fonts: &'a BTreeMap<FaceKey, Font>,
    tags: Vec<Node>,
    list: Option<OpenList>,
    outline: Outline,
}

impl PdfWriter<'_> {
    fn page(&mut self, file: &mut Document, number: usize, page: &Page) {
        let [w, h] = [page.width_mm, page.height_mm].map(|mm| mm as f32 * POINTS_PER_MM);
        let settings = PageSettings::from_wh(w, h).expect("the size has been checked");
        let mut sheet = file.start_page_with(settings);
        let mut surface = sheet.surface();
        surface.push_transform(&Transform::from_scale(POINTS_PER_MM, POINTS_PER_MM));
        for part in &page.parts {
            let paper = PdfPaper { height_mm: page.height_mm };
            let alt = |words: &String| Some(words.clone()).filter(|w| !w.is_empty());
            let mut group = match &part.kind {
                Kind::Artifact => {
                    self.artifact(&mut surface, paper, &part.items);
                    continue;
                }
                Kind::List { numbered, members } => {
                    self.list(&mut surface, paper, &part.items, *numbered, members);
                    continue;
                }
                Kind::Table(cells) => {
                    let table = self.table(&mut surface, paper, &part.items, cells);
                    self.end_list();
                    self.tags.push(table.into());
                    continue;
                }
                Kind::Heading { level, title } => {
                    let top = crate::paper::extent::bounds(&part.items)
                        .map_or(0.0, |b| paper.down(b.max).y);
                    let place = krilla::destination::XyzDestination::new(
                        number,
                        At::from_xy(0.0, top * POINTS_PER_MM),
                    );
                    self.outline.push_child(OutlineNode::new(title.clone(), place));
                    let level =
                        std::num::NonZeroU16::new(*level).unwrap_or(std::num::NonZeroU16::MIN);
                    TagGroup::new(Tag::Hn(level, Some(title.clone())))
                }
                Kind::Paragraph => TagGroup::new(Tag::P),
                Kind::Formula(words) => TagGroup::new(Tag::Formula(alt(words))),
                Kind::Figure(words) => TagGroup::new(Tag::Figure(alt(words))),
            };
            group.push(self.content(&mut surface, paper, &part.items));
            self.end_list();
            self.tags.push(group.into());
        }
        surface.pop();
        surface.finish();
        sheet.finish();
    }

    /// Draws items as one content for a tag.
    fn content(&self, surface: &mut Surface, paper: PdfPaper, items: &[FigureItem]) -> Identifier {
        let identifier = surface.start_tagged(ContentTag::Other);
        items.iter().for_each(|i| self.item(surface, paper, i));
        surface.end_tagged();
        identifier
    }

    fn artifact(&self, surface: &mut Surface, paper: PdfPaper, items: &[FigureItem]) {
        surface
            .start_tagged(ContentTag::Artifact(Artifact::with_kind(ArtifactType::PaginationOther)));
        items.iter().for_each(|i| self.item(surface, paper, i));
        surface.end_tagged();
    }

    fn item(&self, surface: &mut Surface, paper: PdfPaper, item: &FigureItem) {
        let mut path = Trace { paper, builder: PathBuilder::new() };
        match &item.shape {
            Shape::Line { from, to, stroke } => {
                path.chain(&[*from, *to], false);
                path.ink(surface, Some(stroke), None);
            }
            Shape::Polyline { points, closed, stroke, fill } => {
                path.chain(points, *closed);
                path.ink(surface, stroke.as_ref(), *fill);
            }
            Shape::Path { start, pieces, closed, stroke, fill } => {
                path.move_to(*start);
                for piece in pieces {
                    match *piece {
                        PathPiece::Move(p) => path.move_to(p),
                        PathPiece::Line(p) => path.line_to(p),
                        PathPiece::Arc { centre, radius_mm, from_rad, to_rad } => {
                            path.arc_to(centre, radius_mm, from_rad, to_rad)
                        }
                    }
                }
                if *closed {
                    path.builder.close();
                }
                path.ink(surface, stroke.as_ref(), *fill);
            }
            Shape::Circle { centre, radius_mm, stroke, fill } => {
                path.arc(*centre, *radius_mm, 0.0, std::f64::consts::TAU);
                path.builder.close();
                path.ink(surface, stroke.as_ref(), *fill);
            }
            Shape::Arc { centre, radius_mm, from_rad, to_rad, stroke } => {
                path.arc(*centre, *radius_mm, *from_rad, *to_rad);
                path.ink(surface, Some(stroke), None);
            }
            Shape::Arrow { from, to, stroke, head } => {
                let parts = arrow::straight(*from, *to, *head);
                path.chain(&[*from, parts.shaft_end], false);
                path.ink(surface, Some(stroke), None);
                paper.head(surface, &parts.head, stroke.colour);
            }
            Shape::ArcArrow { centre, radius_mm, from_rad, to_rad, stroke, head } => {
                let parts = arrow::bent(*centre, *radius_mm, *from_rad, *to_rad, *head);
                path.arc(*centre, *radius_mm, *from_rad, parts.shaft_end_rad);
                path.ink(surface, Some(stroke), None);
                paper.head(surface, &parts.head, stroke.colour);
            }
            Shape::Turned { at, angle_rad, label, size_mm, colour } => {
                let centre = paper.down(*at);
                // With y down, angles have the opposite sign.
                surface.push_transform(&Transform::from_rotate_at(
                    -angle_rad.to_degrees() as f32,
                    centre.x,
                    centre.y,
                ));
                let left = at.x - text::set(label).width_em * size_mm / 2.0;
                self.label(surface, paper, Point::new(left, at.y), label, *size_mm, *colour);
                surface.pop();
            }
            Shape::Label { at, label, size_mm, anchor, colour } => {
                let left = at.x - anchor_shift_em(*anchor, text::set(label).width_em) * size_mm;
                self.label(surface, paper, Point::new(left, at.y), label, *size_mm, *colour);
            }
        }
    }

    fn label(
        &self,
        surface: &mut Surface,
        paper: PdfPaper,
        at: Point,
        label: &Label,
        size_mm: f64,
        colour: Colour,
    ) {
        surface.set_stroke(None);
        surface.set_fill(Some(fill(colour)));
        for run in &text::set(label).runs {
            let glyph = |g: &crate::paper::font::Glyph| {
                let [dx, dy] = g.offset_em.map(|v| v as f32);
                KrillaGlyph::new(
                    GlyphId::new(g.id),
                    g.advance_em as f32,
                    dx,
                    dy,
                    0.0,
                    g.text.clone(),
                    None,
                )
            };
            let glyphs: Vec<KrillaGlyph> = run.glyphs.iter().map(glyph).collect();
            let origin = paper.down(at + Vec2::new(run.x_em, run.y_em) * size_mm);
            surface.draw_glyphs(
                origin,
                &glyphs,
                self.fonts[&run.face.key()].clone(),
                &run.text,
                (run.size_em * size_mm) as f32,
                false,
            );
        }
    }
}

/// The paper of a page; converts from y up to y down.
#[derive(Clone, Copy)]
struct PdfPaper {
    height_mm: f64,
}

impl PdfPaper {
    /// Returns a position in the file, to 0.001 mm as in SVG: the same text on platforms that
    /// differ in the last bits.
    fn down(self, p: Point) -> At {
        let milli = |v: f64| ((v * 1000.0).round() / 1000.0 + 0.0) as f32;
        At::from_xy(milli(p.x), milli(self.height_mm - p.y))
    }

    fn head(self, surface: &mut Surface, corners: &[Point], colour: Colour) {
        let mut path = Trace { paper: self, builder: PathBuilder::new() };
        path.chain(corners, true);
        path.ink(surface, None, Some(colour));
    }
}

/// A path under construction.
struct Trace {
    paper: PdfPaper,
    builder: PathBuilder,
}

impl Trace {
    fn move_to(&mut self, p: Point) {
        let q = self.paper.down(p);
        self.builder.move_to(q.x, q.y);
    }

    fn line_to(&mut self, p: Point) {
        let q = self.paper.down(p);
        self.builder.line_to(q.x, q.y);
    }

    fn chain(&mut self, points: &[Point], closed: bool) {
        for (i, p) in points.iter().enumerate() {
            if i == 0 { self.move_to(*p) } else { self.line_to(*p) }
        }
        if closed && !points.is_empty() {
            self.builder.close();
        }
    }

    fn arc(&mut self, centre: Point, radius_mm: f64, from_rad: f64, to_rad: f64) {
        self.move_to(on_circle(centre, radius_mm, from_rad));
        self.arc_to(centre, radius_mm, from_rad, to_rad);
    }

    /// Adds an arc as cubic curves of at most a quarter turn, which deviate from the circle by at
    /// most 0.03 % of its radius.
    ///
    /// # Source
    /// The handle of a piece of angle θ is 4/3 · tan(θ/4) long: M. Goldapp, *Approximation of
    /// circular arcs by cubic polynomials*, Computer Aided Geometric Design 8 (1991).
    fn arc_to(&mut self, centre: Point, radius_mm: f64, from_rad: f64, to_rad: f64) {
        let sweep = to_rad - from_rad;
        let pieces = (sweep.abs() / std::f64::consts::FRAC_PI_2).ceil().max(1.0) as usize;
        let step = sweep / pieces as f64;
        let handle = 4.0 / 3.0 * libm::tan(step / 4.0) * radius_mm;
        for k in 0..pieces {
            let angles = [k, k + 1].map(|k| from_rad + step * k as f64);
            let [start, end] = angles.map(|a| on_circle(centre, radius_mm, a));
            let [out, back] = angles.map(|a| Vec2::from_angle(a).perp() * handle);
            let [a, b, c] = [start + out, end - back, end].map(|p| self.paper.down(p));
            self.builder.cubic_to(a.x, a.y, b.x, b.y, c.x, c.y);
        }
    }

    /// Draws the path; a path without extent, such as the shaft of a vector of length zero, leaves
    /// no ink.
    fn ink(self, surface: &mut Surface, stroke: Option<&LineStroke>, area: Option<Colour>) {
        let Some(path) = self.builder.finish() else { return };
        if stroke.is_none() && area.is_none() {
            return;
        }
        surface.set_fill(area.map(fill));
        surface.set_stroke(stroke.map(pen));
        surface.draw_path(&path);
    }
}

fn fill(colour: Colour) -> Fill {
    Fill { paint: paint(colour), opacity: NormalizedF32::ONE, ..Fill::default() }
}

fn pen(s: &LineStroke) -> Pen {
    let dash: Vec<f32> = s.dash.pattern_mm().iter().map(|mm| *mm as f32).collect();
    let (line_cap, line_join) = match s.cap {
        Cap::Round => (LineCap::Round, LineJoin::Round),
        Cap::Butt => (LineCap::Butt, LineJoin::Miter),
    };
    Pen {
        paint: paint(s.colour),
        width: s.width_mm as f32,
        miter_limit: MITRE,
        line_cap,
        line_join,
        opacity: NormalizedF32::ONE,
        dash: (!dash.is_empty()).then_some(StrokeDash { array: dash, offset: 0.0 }),
    }
}

/// Returns a grey in the grey colour space, so that a printer uses black ink alone.
fn paint(c: Colour) -> Paint {
    if c.r == c.g && c.g == c.b {
        luma::Color::new(c.r).into()
    } else {
        rgb::Color::new(c.r, c.g, c.b).into()
    }
}
