//! Page formats of figures: sheets of paper, slides, columns of a book.

use crate::raw::RawQuantity;
use crate::resolve::{self, SHEETS};
use hodograph_base::diag::{Diagnostic, Faults, Span, both};
use std::ops::Range;

/// The space for one page of a figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PageFormat {
    /// The width of the page (mm).
    pub width_mm: f64,
    /// The greatest height of the page (mm); infinite if it is free.
    pub height_mm: f64,
    /// True if every page has exactly this height, false if a page is as high as its content.
    pub whole: bool,
    /// The size of the type (points, 1/72 in); `None` for the style's own, which becomes smaller
    /// with the drawings.
    pub type_pt: Option<f64>,
    /// The strip along the edges that stays empty (mm).
    pub border_mm: f64,
}

/// Size of the type in print (points): that of figures in textbooks.
const PRINT_PT: f64 = 9.0;
/// Size of the type on a slide (points): legible from the last row.
const PROJECTED_PT: f64 = 18.0;
/// Greatest height of a column (mm): that of the type area of an A4 page.
const COLUMN_MM: f64 = 240.0;
/// Border of a page in a column of a book (mm).
const COLUMN_BORDER_MM: f64 = 2.0;
/// Border of a sheet of paper (mm): the strip that a printer cannot reach.
pub const SHEET_BORDER_MM: f64 = 8.0;
/// Slides by the ratio of their sides, in the sizes of the usual programs for slides (mm).
const SLIDES: [(&str, [f64; 2]); 2] = [("16:9", [338.0, 190.0]), ("4:3", [254.0, 190.0])];

impl PageFormat {
    /// Returns a column of a book: a width (mm) and a free height, in the style's own type.
    pub fn column(width_mm: f64) -> PageFormat {
        let (height_mm, border_mm) = (f64::INFINITY, COLUMN_BORDER_MM);
        PageFormat { width_mm, height_mm, whole: false, type_pt: None, border_mm }
    }

    /// Returns a whole sheet of paper with these sides (mm), in the style's own type.
    pub fn paper([width_mm, height_mm]: [f64; 2]) -> PageFormat {
        let (type_pt, border_mm) = (None, SHEET_BORDER_MM);
        PageFormat { width_mm, height_mm, whole: true, type_pt, border_mm }
    }

    /// Returns width and height between the borders (mm).
    pub fn inner_mm(&self) -> [f64; 2] {
        [self.width_mm, self.height_mm].map(|mm| mm - 2.0 * self.border_mm)
    }

    /// Returns the sides (mm) of the page around content of this height.
    pub fn sides_mm(&self, content_mm: f64) -> [f64; 2] {
        let height = if self.whole { self.height_mm } else { content_mm + 2.0 * self.border_mm };
        [self.width_mm, height]
    }
}

/// Reads a page format: `a4`, `a4-landscape` and the other ISO sheets, `16:9`, `4:3`, a width such
/// as `80mm`, or a width and a greatest height such as `80mm x 120mm`.
///
/// # Errors
/// `paper` if there is no such format, or a side is not 20 mm to 5000 mm long; the errors of a
/// length.
///
/// ```
/// let page = hodograph_scene::page("a4-landscape").unwrap();
/// assert_eq!((page.width_mm, page.height_mm), (297.0, 210.0));
/// assert_eq!(hodograph_scene::page("80mm").unwrap().width_mm, 80.0);
/// assert!(hodograph_scene::page("a44").is_err());
/// ```
pub fn page(text: &str) -> Result<PageFormat, Faults> {
    let word = text.trim().to_lowercase();
    let whole = |sides, type_pt| PageFormat { type_pt: Some(type_pt), ..PageFormat::paper(sides) };
    if let Some((_, sides)) = SLIDES.iter().find(|(name, _)| *name == word) {
        return Ok(whole(*sides, PROJECTED_PT));
    }
    let (name, landscape) = match word.strip_suffix("landscape") {
        Some(name) => (name.trim_end_matches([' ', '-']), true),
        None => (word.as_str(), false),
    };
    if let Some((_, [w, h])) = SHEETS.iter().find(|(sheet, _)| sheet.to_lowercase() == name) {
        return Ok(whole(if landscape { [*h, *w] } else { [*w, *h] }, PRINT_PT));
    }
    if !word.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '.' | '+' | '-')) {
        let known: Vec<String> = SHEETS.iter().map(|(name, _)| name.to_lowercase()).collect();
        let known = known.join(", ");
        return Err(Diagnostic::error(
            "paper",
            both!("there is no page format `{text}`"),
        )
        .at(Span::new(0, text.len()))
        .help(both!(
            "write one of {known}, also with -landscape; 16:9 or 4:3 for slides; a width such as 80mm, or with the greatest height 80mmx120mm"
        ))
        .into());
    }
    // The x between two lengths; no unit of length has one.
    let (width, height) = match text.split_once(['x', '×']) {
        Some((width, height)) => (width, Some(height)),
        None => (text, None),
    };
    let height_mm = match height {
        Some(height) => side(text, text.len() - height.len()..text.len())?,
        None => COLUMN_MM,
    };
    let column = PageFormat::column(side(text, 0..width.len())?);
    Ok(PageFormat { height_mm, type_pt: Some(PRINT_PT), ..column })
}

/// Reads the width of a page, such as `80 mm`; returns mm.
///
/// # Errors
/// Text that is not a length, or a length outside the limits for a side of the paper; places count
/// in `text`.
///
/// ```
/// assert_eq!(hodograph_scene::width("80 mm").unwrap(), 80.0);
/// assert!(hodograph_scene::width("1 mm").is_err());
/// ```
pub fn width(text: &str) -> Result<f64, Faults> {
    side(text, 0..text.len())
}

/// Reads the side of a page in a part of the text; returns mm.
fn side(text: &str, part: Range<usize>) -> Result<f64, Faults> {
    let mut faults = Faults::default();
    let span = Span::new(part.start, part.end);
    let quantity = RawQuantity { text: text[part].trim().to_owned(), span, bare: true };
    let read = resolve::width(&quantity, text, &mut faults);
    read.filter(|_| !faults.has_errors()).ok_or(faults)
}
