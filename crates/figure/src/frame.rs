//! A sheet to draw on: the given mechanism to scale, the pole and the scales of each polygon with
//! the space that its solution needs; and the solution as an overlay, with the same pole and scales in
//! the same places, for marking by laying it over.
//!
//! Both are one drawing, laid out once and then divided: what is given goes to the sheet, the
//! vectors and letters of the polygons to the overlay.

use hodograph_base::diag::{Diagnostic, Faults, both};
use hodograph_base::geom::{Point, Vec2};
use hodograph_scene::{DiagramKind, PageFormat};

use super::arrange::{SheetPieces, arrange_on};
use super::fit::{first_that_fits, on_page};
use super::list::FigureInput;
use super::sheet::SheetDrafter;
use hodograph_paper::paper::drawing::DrawingPart;
use hodograph_paper::paper::item::{Anchor, Colour, Figure, FigureItem, LineStroke, Shape};
use hodograph_paper::paper::label::Label;

/// Free space around the solution, for lines drawn too far.
const ROOM_MM: f64 = 10.0;
/// Weight and colour of the frame around the space to draw in.
const FRAME: LineStroke = LineStroke::new(0.13).coloured(Colour::grey(150));
/// Ink of the overlay.
const OVERLAY: Colour = Colour::rgb(200, 0, 0);
/// Distance of the register marks from the edges of the page, and half of their size.
const REGISTER_MM: [f64; 2] = [6.0, 2.0];

/// Start of the line for the name, from the left and the upper edge of the page.
const NAME_MM: [f64; 2] = [14.0, 7.0];

/// A page of the sheet, and of its overlay.
#[derive(Clone, Debug, PartialEq)]
pub struct FramePage {
    /// The page to draw on.
    pub blank: Figure,
    /// The solution, of the same size, with nothing painted between its lines.
    pub overlay: Figure,
}

/// Draws the sheet on pages of a format: on one page if drawings of nearly full size fit there.
///
/// # Errors
/// `no-figure` if the scene's questions call for no polygon; `paper-too-small`.
pub fn working_frame(w: &FigureInput, format: &PageFormat) -> Result<Vec<FramePage>, Faults> {
    let any = |on: &DiagramKind| w.worked.construction.polygon(*on).is_some();
    if !DiagramKind::POLYGONS.iter().any(any) {
        let message = both!("there is no polygon to draw");
        let help = both!("ask for velocities or accelerations in \"find\"");
        return Err(Diagnostic::error("no-figure", message).help(help).into());
    }
    // One page of legible type comes before larger drawings on several pages.
    let mut several = None;
    let found = first_that_fits("frame", w, format, true, |w, small| {
        if small && let Some(pages) = several.take() {
            return Ok(Ok(pages));
        }
        Ok(match laid_out(w, format) {
            Ok(pages) if !small && pages.len() > 1 => {
                several.get_or_insert(pages);
                Err(format.inner_mm())
            }
            made => made,
        })
    });
    found.or_else(|faults| several.ok_or(faults))
}

/// Pages, or the size (mm) of a drawing that is larger than a page.
type LaidOut = Result<Vec<FramePage>, [f64; 2]>;

fn laid_out(w: &FigureInput, format: &PageFormat) -> LaidOut {
    let (scene, worked, options) = (w.scene, w.worked, w.options);
    let maker = SheetDrafter { scene, worked, options, certified: Vec::new() };
    let mut letters = ["(a) ", "(b) ", "(c) "].into_iter();
    let mut letter = || letters.next().unwrap_or_default();
    let mut drawings =
        vec![maker.captioned(given(maker.mechanism()), letter(), DiagramKind::Plane)];
    for on in DiagramKind::POLYGONS {
        if let Some(p) = worked.construction.polygon(on) {
            let part = maker.polygon(p, format.inner_mm()[0] - 2.0 * ROOM_MM);
            drawings.push(maker.captioned(framed(part), letter(), on));
        }
    }
    let [width_mm, height_mm] = format.inner_mm();
    let nothing = DrawingPart::of(Vec::new());
    let title = maker.page_title(width_mm, 1, 1);
    let (equations, forces) = (Vec::new(), Vec::new());
    let pieces = SheetPieces { title, drawings, equations, results: nothing, forces };
    let pages =
        arrange_on(pieces, [width_mm, height_mm], |k, of| maker.page_title(width_mm, k, of))?;
    let several = pages.len() > 1;
    let page = |(items, size)| {
        let figure = on_page(format, maker.figure(items, size), several)?;
        let mut page = divided(figure);
        page.blank.items.push(name(w, format));
        Ok(page)
    };
    pages.into_iter().map(page).collect()
}

/// The mechanism without what a construction adds to it.
fn given(mut part: DrawingPart) -> DrawingPart {
    part.items.retain(|item| !has(item, "special") && !has(item, "direction"));
    part
}

/// A polygon in its space, with a frame around it.
fn framed(mut part: DrawingPart) -> DrawingPart {
    part.bounds = part.bounds.grown(ROOM_MM);
    let (low, high) = (part.bounds.min, part.bounds.max);
    let points = vec![low, Point::new(high.x, low.y), high, Point::new(low.x, high.y)];
    let shape = Shape::Polyline { points, closed: true, stroke: Some(FRAME), fill: None };
    part.items.push(FigureItem::new("frame", shape));
    part
}

fn has(item: &FigureItem, word: &str) -> bool {
    item.class.split_whitespace().any(|w| w == word)
}

/// True for the parts of a polygon.
fn is_solution(item: &FigureItem) -> bool {
    DiagramKind::POLYGONS.iter().any(|on| has(item, on.word()))
}

/// True for the pole of a polygon with its letter and its mark.
fn is_pole(item: &FigureItem) -> bool {
    let marked = |name: &String| name.starts_with("pole-");
    has(item, "pole") || item.shown.as_ref().is_some_and(|s| s.names.iter().any(marked))
}

fn divided(figure: Figure) -> FramePage {
    let marks = register(figure.width_mm, figure.height_mm);
    let all = |keep: &dyn Fn(&FigureItem) -> bool| -> Vec<FigureItem> {
        figure.items.iter().filter(|item| keep(item)).cloned().chain(marks.clone()).collect()
    };
    let blank = all(&|item| !is_solution(item) || is_pole(item));
    let mut overlay = all(&|item| is_solution(item) || has(item, "title"));
    overlay.iter_mut().for_each(ink);
    FramePage {
        overlay: Figure { items: overlay, paper: Colour::WHITE, ..figure.clone() },
        blank: Figure { items: blank, ..figure },
    }
}

/// A line for the name, above the border of the page.
fn name(w: &FigureInput, format: &PageFormat) -> FigureItem {
    let text = w.options.lang.of(&both!("Name: {}", "_".repeat(30))).to_owned();
    let shape = Shape::Label {
        at: Point::new(NAME_MM[0], format.height_mm - NAME_MM[1]),
        label: Label::text(text).in_fonts(&w.options.style.fonts),
        size_mm: w.options.style.small_mm,
        anchor: Anchor::Start,
        colour: Colour::BLACK,
    };
    FigureItem::new("name", shape)
}

/// Crosses in the corners of a page.
fn register(width_mm: f64, height_mm: f64) -> Vec<FigureItem> {
    let [from_edge, half] = REGISTER_MM;
    let corners = [from_edge, width_mm - from_edge]
        .into_iter()
        .flat_map(|x| [from_edge, height_mm - from_edge].map(|y| Point::new(x, y)));
    let arms = [Vec2::new(half, 0.0), Vec2::new(0.0, half)];
    let cross = |at: Point| {
        arms.map(|arm| {
            let (from, to, stroke) = (at - arm, at + arm, LineStroke::new(0.13));
            FigureItem::new("register", Shape::Line { from, to, stroke })
        })
    };
    corners.flat_map(cross).collect()
}

/// Gives an item the ink of the overlay; the white behind letters is left out.
fn ink(item: &mut FigureItem) {
    let filled = |fill: &mut Option<Colour>| {
        *fill = fill.filter(|c| *c != Colour::WHITE).map(|_| OVERLAY);
    };
    match &mut item.shape {
        Shape::Line { stroke, .. }
        | Shape::Arc { stroke, .. }
        | Shape::Arrow { stroke, .. }
        | Shape::ArcArrow { stroke, .. } => stroke.colour = OVERLAY,
        Shape::Polyline { stroke, fill, .. }
        | Shape::Path { stroke, fill, .. }
        | Shape::Circle { stroke, fill, .. } => {
            if let Some(stroke) = stroke {
                stroke.colour = OVERLAY;
            }
            filled(fill);
        }
        Shape::Turned { colour, .. } | Shape::Label { colour, .. } => *colour = OVERLAY,
        // Shapes of later versions keep their ink.
        _ => {}
    }
}
