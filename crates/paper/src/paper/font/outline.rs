//! Outlines of glyphs: contours and their bounding boxes.

use skrifa::outline::{DrawSettings, OutlinePen};
use skrifa::prelude::{LocationRef, Size};
use skrifa::{FontRef, GlyphId, MetadataProvider};

use super::MOST_EM;

/// Largest number of segments of a glyph; a damaged font may describe endless outlines.
const MOST_SEGMENTS: usize = 20_000;

/// The contours of a glyph.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// Segments in em, y up, with the glyph's origin at 0; filled by the non-zero rule.
    pub segments: Vec<OutlineSegment<f64>>,
    /// The box around the segments.
    pub ink: Ink,
}

/// A box around ink, in em: the box of the control points, which the curves of the embedded fonts
/// touch at their extremes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ink {
    /// Left and lower edge.
    pub min: [f64; 2],
    /// Right and upper edge; smaller than `min` if there is no ink.
    pub max: [f64; 2],
}

impl Ink {
    /// The empty box.
    pub const NONE: Ink = Ink { min: [f64::INFINITY; 2], max: [f64::NEG_INFINITY; 2] };

    /// Returns true if there is ink.
    pub fn any(&self) -> bool {
        self.min[0] <= self.max[0]
    }

    /// Returns the box around both.
    pub fn union(self, other: Ink) -> Ink {
        let each =
            |a: [f64; 2], b: [f64; 2], f: fn(f64, f64) -> f64| [f(a[0], b[0]), f(a[1], b[1])];
        Ink { min: each(self.min, other.min, f64::min), max: each(self.max, other.max, f64::max) }
    }

    /// Returns the box scaled, then moved.
    pub fn placed(self, scale: f64, dx: f64, dy: f64) -> Ink {
        let at = |[x, y]: [f64; 2]| [dx + x * scale, dy + y * scale];
        Ink { min: at(self.min), max: at(self.max) }
    }
}

/// A segment of a glyph's outline, in em, y up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OutlineSegment<T> {
    /// Starts a contour.
    Move([T; 2]),
    /// A straight line to a point.
    Line([T; 2]),
    /// A quadratic curve: control point, end.
    Quad([T; 2], [T; 2]),
    /// A cubic curve: two control points, end.
    Cubic([T; 2], [T; 2], [T; 2]),
    /// Closes the contour.
    Close,
}

impl<T: Copy> OutlineSegment<T> {
    /// Returns the segment with each of its points mapped.
    pub fn map<U>(self, mut f: impl FnMut([T; 2]) -> [U; 2]) -> OutlineSegment<U> {
        match self {
            OutlineSegment::Move(a) => OutlineSegment::Move(f(a)),
            OutlineSegment::Line(a) => OutlineSegment::Line(f(a)),
            OutlineSegment::Quad(a, b) => OutlineSegment::Quad(f(a), f(b)),
            OutlineSegment::Cubic(a, b, c) => OutlineSegment::Cubic(f(a), f(b), f(c)),
            OutlineSegment::Close => OutlineSegment::Close,
        }
    }
}

impl Outline {
    /// Returns the outline of a glyph in a font of `em` units per em; `None` if it is damaged.
    pub(super) fn of(font: &FontRef, glyph: GlyphId, em: f64) -> Option<Outline> {
        let mut sink = Sink { segments: Vec::new(), ink: Ink::NONE, em };
        if let Some(outline) = font.outline_glyphs().get(glyph) {
            outline
                .draw(DrawSettings::unhinted(Size::unscaled(), LocationRef::default()), &mut sink)
                .ok()?;
        }
        let reach =
            sink.ink.min.iter().chain(&sink.ink.max).fold(0.0_f64, |most, v| most.max(v.abs()));
        let sound = sink.segments.len() <= MOST_SEGMENTS && (!sink.ink.any() || reach <= MOST_EM);
        sound.then_some(Outline { segments: sink.segments, ink: sink.ink })
    }
}

struct Sink {
    segments: Vec<OutlineSegment<f64>>,
    ink: Ink,
    em: f64,
}

impl Sink {
    fn at(&mut self, x: f32, y: f32) -> [f64; 2] {
        let p = [f64::from(x) / self.em, f64::from(y) / self.em];
        self.ink = self.ink.union(Ink { min: p, max: p });
        p
    }

    fn push(&mut self, segment: OutlineSegment<f64>) {
        if self.segments.len() <= MOST_SEGMENTS {
            self.segments.push(segment);
        }
    }
}

impl OutlinePen for Sink {
    fn move_to(&mut self, x: f32, y: f32) {
        let to = self.at(x, y);
        self.push(OutlineSegment::Move(to));
    }
    fn line_to(&mut self, x: f32, y: f32) {
        let to = self.at(x, y);
        self.push(OutlineSegment::Line(to));
    }
    fn quad_to(&mut self, cx0: f32, cy0: f32, x: f32, y: f32) {
        let (control, to) = (self.at(cx0, cy0), self.at(x, y));
        self.push(OutlineSegment::Quad(control, to));
    }
    fn curve_to(&mut self, cx0: f32, cy0: f32, cx1: f32, cy1: f32, x: f32, y: f32) {
        let (one, other, to) = (self.at(cx0, cy0), self.at(cx1, cy1), self.at(x, y));
        self.push(OutlineSegment::Cubic(one, other, to));
    }
    fn close(&mut self) {
        self.push(OutlineSegment::Close);
    }
}
