//! Compares two figures: vectors that moved, items that were added or removed, texts that changed,
//! pixels beyond a tolerance.
//!
//! SVG files are compared by the ids of their elements, which are a contract (docs/svg.md), and by
//! their pixels; PNG files by their pixels only. The input must be figures written by this library:
//! elements that could take unbounded time or memory, such as filters and nested uses, are
//! rejected.

mod elements;
mod picture;
mod raster;

use elements::{Geometry, SvgDocument, SvgElement};
use hodograph_base::diag::{Both, Diagnostic, both};
pub use picture::picture;
pub use raster::Raster;

/// Tolerances of a comparison.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Items that moved no farther than this are unchanged.
    pub tolerance_mm: f64,
    /// Pixels of which no channel differs by more than this are equal.
    pub channel: u8,
    /// Number of other differing pixels that is accepted; with `None`, pixels are counted but do
    /// not decide.
    pub pixels: Option<usize>,
}

impl Default for Options {
    /// Returns the default tolerances: 0.01 mm, a fifteenth of the thinnest line; one step of a
    /// channel, the rounding difference between machines; no other pixel.
    fn default() -> Options {
        Options { tolerance_mm: 0.01, channel: 1, pixels: Some(0) }
    }
}

/// A figure in the form in which it is compared.
#[derive(Clone, Debug)]
pub enum Picture {
    /// The text of an SVG.
    Svg(String),
    /// The pixels of a PNG.
    Png(Raster),
}

impl Picture {
    /// Reads a file and detects its type by its first bytes.
    ///
    /// # Errors
    /// `diff-input` for a file that is neither an SVG of this library nor a PNG, or is too large.
    pub fn read(bytes: Vec<u8>) -> Result<Picture, Diagnostic> {
        if bytes.starts_with(raster::SIGNATURE) {
            return Ok(Picture::Png(Raster::of_png(&bytes)?));
        }
        let text = String::from_utf8(bytes)
            .map_err(|_| refused(both!("it is neither an SVG nor a PNG")))?;
        SvgDocument::read(&text)?;
        Ok(Picture::Svg(text))
    }
}

/// A vector that moved or has another value.
#[derive(Clone, Debug, PartialEq)]
pub struct Vector {
    /// Id of the vector.
    pub id: String,
    /// Names of the vector.
    pub name: String,
    /// Distances by which its tail and its tip moved.
    pub moved_mm: [f64; 2],
    /// Lengths on paper, before and after, if given.
    pub mm: Option<[f64; 2]>,
    /// Values in SI, before and after, if given.
    pub si: Option<[f64; 2]>,
}

/// An item that moved.
#[derive(Clone, Debug, PartialEq)]
pub struct Moved {
    /// Id of the item.
    pub id: String,
    /// Distance by which its farthest point moved; `None` if it consists of other lines.
    pub mm: Option<f64>,
}

/// A text that changed.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    /// Id of the label; `<title>` and `<desc>` for those of the figure.
    pub id: String,
    /// Text before.
    pub old: String,
    /// Text after.
    pub new: String,
}

/// The pixel comparison of two figures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Pixels {
    /// Number of pixels that differ by more than the tolerance in some channel.
    pub over: usize,
    /// Largest difference of a channel.
    pub largest: u8,
    /// The box around these pixels: left, top, right, bottom, the last two excluded.
    pub bounds: Option<[u32; 4]>,
    /// Widths and heights, before and after.
    pub sizes: [[u32; 2]; 2],
}

/// Differences between two figures.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Difference {
    /// Changed vectors.
    pub vectors: Vec<Vector>,
    /// Other changed items.
    pub moved: Vec<Moved>,
    /// Items with other lines or colours: width, pattern, colour.
    pub restyled: Vec<String>,
    /// Items in the second figure only.
    pub added: Vec<String>,
    /// Items in the first figure only.
    pub removed: Vec<String>,
    /// Changed texts.
    pub texts: Vec<Text>,
    /// Pixel comparison.
    pub pixels: Pixels,
    /// True if more pixels differ than accepted.
    pub pixels_differ: bool,
}

impl Difference {
    /// Returns true if the figures are equal within the tolerances.
    pub fn is_empty(&self) -> bool {
        let lists = [
            self.vectors.len(),
            self.moved.len(),
            self.restyled.len(),
            self.added.len(),
            self.removed.len(),
            self.texts.len(),
        ];
        lists.iter().all(|n| *n == 0) && !self.pixels_differ
    }

    /// Returns the differences in words, one line each.
    pub fn lines(&self) -> Vec<Both> {
        let mut out = Vec::new();
        let mm = super::number::mm;
        for v in &self.vectors {
            let mut line = both!(
                "vector {} ({}): tail moved {} mm, tip {} mm",
                v.id,
                v.name,
                mm(v.moved_mm[0]),
                mm(v.moved_mm[1])
            );
            if let Some([old, new]) = v.si.filter(|[a, b]| a != b) {
                let (old, new) = (super::number::si(old), super::number::si(new));
                line = both!("{}; value {old}, now {new}", line);
            }
            out.push(line);
        }
        for m in &self.moved {
            out.push(match m.mm {
                Some(by) => both!("moved {}: {} mm", m.id, mm(by)),
                None => both!("redrawn {}", m.id),
            });
        }
        out.extend(self.restyled.iter().map(|id| both!("restyled {id}")));
        out.extend(self.removed.iter().map(|id| both!("removed {id}")));
        out.extend(self.added.iter().map(|id| both!("added {id}")));
        out.extend(
            self.texts.iter().map(|Text { id, old, new }| both!("text {id}: `{old}`, now `{new}`")),
        );
        let Pixels { over, largest, bounds, sizes: [old, new] } = self.pixels;
        if old != new {
            let ([a, b], [c, d]) = (old, new);
            out.push(both!("size: {a} by {b} pixels, now {c} by {d}"));
        }
        if let Some([left, top, right, bottom]) = bounds {
            out.push(both!(
                "pixels: {over} differ, by {largest} at most, from ({left}, {top}) to ({right}, {bottom})"
            ));
        }
        out
    }
}

/// Compares two figures of one kind.
///
/// # Errors
/// `diff-kinds` for an SVG and a PNG; otherwise the errors of reading and drawing an SVG.
///
/// ```
/// use hodograph_paper::render::diff::{Options, Picture, compare};
/// let svg = |y: f64| Picture::Svg(format!(r#"<svg xmlns="http://www.w3.org/2000/svg" width="9mm" height="9mm" viewBox="0 0 9 9">
///     <line id="link" x1="1" y1="1" x2="8" y2="{y}" stroke="black"/></svg>"#));
/// assert!(compare(&svg(5.0), &svg(5.0), &Options::default())?.is_empty());
/// let moved = compare(&svg(5.0), &svg(6.5), &Options::default())?;
/// assert_eq!((moved.moved[0].id.as_str(), moved.moved[0].mm), ("link", Some(1.5)));
/// # Ok::<(), hodograph_base::diag::Diagnostic>(())
/// ```
pub fn compare(old: &Picture, new: &Picture, options: &Options) -> Result<Difference, Diagnostic> {
    let ([a, b], documents) = rasters(old, new)?;
    let mut found =
        documents.map_or_else(Difference::default, |[a, b]| by_elements(&a, &b, options));
    found.pixels = raster::compare(&a, &b, options.channel);
    let resized = found.pixels.sizes[0] != found.pixels.sizes[1];
    found.pixels_differ = resized || options.pixels.is_some_and(|most| found.pixels.over > most);
    Ok(found)
}

/// Returns the pixels of two figures of one kind; SVG files at one resolution and with their
/// elements.
fn rasters(
    old: &Picture,
    new: &Picture,
) -> Result<([Raster; 2], Option<[SvgDocument; 2]>), Diagnostic> {
    match (old, new) {
        (Picture::Svg(a), Picture::Svg(b)) => {
            let documents = [SvgDocument::read(a)?, SvgDocument::read(b)?];
            let dpi = raster::dpi(&documents.each_ref().map(|d| d.size_mm));
            Ok(([Raster::of_svg(a, dpi)?, Raster::of_svg(b, dpi)?], Some(documents)))
        }
        (Picture::Png(a), Picture::Png(b)) => Ok(([a.clone(), b.clone()], None)),
        (Picture::Svg(_), Picture::Png(_)) | (Picture::Png(_), Picture::Svg(_)) => {
            Err(Diagnostic::error("diff-kinds", both!("an SVG and a PNG cannot be compared"))
                .help(both!("name two files of one kind")))
        }
    }
}

fn by_elements(old: &SvgDocument, new: &SvgDocument, options: &Options) -> Difference {
    let mut out = Difference::default();
    for (what, a, b) in [("<title>", &old.title, &new.title), ("<desc>", &old.desc, &new.desc)] {
        if a != b {
            out.texts.push(Text { id: what.into(), old: a.clone(), new: b.clone() });
        }
    }
    for a in &old.elements {
        match new.find(&a.id) {
            Some(b) => element(a, b, options, &mut out),
            None => out.removed.push(a.id.clone()),
        }
    }
    out.added =
        new.elements.iter().filter(|b| old.find(&b.id).is_none()).map(|b| b.id.clone()).collect();
    out
}

/// Compares one element before and after.
fn element(a: &SvgElement, b: &SvgElement, options: &Options, out: &mut Difference) {
    let id = || a.id.clone();
    if a.text != b.text {
        let text = |e: &SvgElement| e.text.clone().unwrap_or_default();
        out.texts.push(Text { id: id(), old: text(a), new: text(b) });
    }
    if a.paint != b.paint {
        out.restyled.push(id());
    }
    match (&a.geometry, &b.geometry) {
        (Geometry::Arrow(p), Geometry::Arrow(q)) => {
            let moved_mm = [0, 1].map(|k| libm::hypot(p[k][0] - q[k][0], p[k][1] - q[k][1]));
            let si = a.si.zip(b.si).map(|(a, b)| [a, b]);
            // Values are written with six digits.
            let other = si.is_some_and(|[a, b]| (a - b).abs() > 2e-5 * a.abs().max(b.abs()));
            if other || moved_mm.iter().any(|mm| *mm > options.tolerance_mm) {
                let mm = a.mm.zip(b.mm).map(|(a, b)| [a, b]);
                out.vectors.push(Vector { id: id(), name: a.name.clone(), moved_mm, mm, si });
            }
        }
        (Geometry::Lines(form, p), Geometry::Lines(other, q))
            if form == other && p.len() == q.len() =>
        {
            let mm = p.iter().zip(q).map(|(p, q)| (p - q).abs()).fold(0.0, f64::max);
            if mm > options.tolerance_mm {
                out.moved.push(Moved { id: id(), mm: Some(mm) });
            }
        }
        // The positions of letters depend on their text.
        (Geometry::Arrow(_) | Geometry::Lines(..), Geometry::Arrow(_) | Geometry::Lines(..)) => {
            out.moved.extend((a.text == b.text).then(|| Moved { id: id(), mm: None }));
        }
    }
}

fn refused(why: Both) -> Diagnostic {
    Diagnostic::error("diff-input", why)
        .help(both!("figures are SVG as `hodograph` writes them, or PNG"))
}
