//! Draws the inversions of a chain side by side: the same pose with a different ground in each,
//! with type and rotating links below.

use hodograph_base::diag::{Faults, Warned};
use hodograph_base::geom::Point;
use hodograph_base::lang::each;
use hodograph_methods::inversions::{Inversion, inversions};
use hodograph_report::inversions as report;
use hodograph_scene::DiagramKind;

use super::arrange::{caption_y, joined};
use super::composite::named;
use super::list::{FigureEntry, FigureInput, Pages};
use super::mechanism;
use super::sheet::SheetDrafter;
use crate::scales::DrawingScales;
use hodograph_paper::paper::drawing::DrawingPart;
use hodograph_paper::paper::item::Figure;
use hodograph_paper::paper::label::Label;

/// All inversions.
pub const ENTRY: FigureEntry = FigureEntry {
    name: "inversions",
    about: each!("Each link of the chain as ground in turn"),
    draw,
};

/// Gap between drawings.
const GAP_MM: f64 = 14.0;
/// Maximum number of drawings on a page. If there are more, each page has fewer: such chains have
/// many links and need the space.
const PER_PAGE: usize = 6;
const FEWER: usize = 4;
/// Drawings per row: four in rows of two, six in rows of three.
const PER_ROW: [usize; 2] = [2, 3];

fn draw(w: &FigureInput) -> Result<Warned<Pages>, Faults> {
    let Warned { value: all, notes } = inversions(w.scene)?;
    let numbered: Vec<(usize, &Inversion)> = all.iter().enumerate().collect();
    // Pages of equal size: twelve drawings as three pages of four.
    let count = numbered.len().div_ceil(PER_PAGE).max(1);
    let count = if count > 1 { numbered.len().div_ceil(FEWER) } else { count };
    let mut pages = Pages::new();
    for (k, some) in numbered.chunks(numbered.len().div_ceil(count).max(1)).enumerate() {
        let name =
            if count > 1 { format!("{}-{}", ENTRY.name, k + 1) } else { ENTRY.name.to_owned() };
        pages.push((name, sheet(w, some)));
    }
    Ok(Warned { value: pages, notes })
}

/// Draws some of the inversions on a page.
fn sheet(w: &FigureInput, some: &[(usize, &Inversion)]) -> Figure {
    let parts: Vec<DrawingPart> = some.iter().map(|(k, i)| part(w, i, *k)).collect();
    let columns = PER_ROW[usize::from(parts.len() > 4)];
    let lines: Vec<String> = some.iter().map(|(_, i)| report::line(i, w.options.lang)).collect();
    in_rows(w, parts, columns, lines.join("; "))
}

/// Returns the figure of drawings in rows, with its description.
pub(super) fn in_rows(
    w: &FigureInput,
    mut parts: Vec<DrawingPart>,
    columns: usize,
    desc: String,
) -> Figure {
    stand(&mut parts, columns);
    let maker = SheetDrafter {
        scene: w.scene,
        worked: w.worked,
        options: w.options,
        certified: Vec::new(),
    };
    Figure { desc, ..maker.alone(joined(parts)) }
}

/// Draws one inversion, with its name.
fn part(w: &FigureInput, i: &Inversion, k: usize) -> DrawingPart {
    let maker = SheetDrafter {
        scene: &i.scene,
        worked: &i.worked,
        options: w.options,
        certified: Vec::new(),
    };
    let drawing =
        mechanism::numbered(&w.options.style, &i.scene, &i.worked, &w.options.notation).finish();
    let (_, mu) = maker.caption(DiagramKind::Plane);
    let caption = format!("({}) {}", k + 1, report::heading(i, w.options.lang));
    let words = format!("\\text{{{}}}", report::words(i, w.options.lang));
    let below = DrawingScales::words(words).and(mu);
    named(maker.titled(drawing, Label::text(caption), &below, "inversion"), "inversion", k)
}

/// Arranges parts in rows: captions of a row on one line, columns as wide as their widest part.
fn stand(parts: &mut [DrawingPart], columns: usize) {
    let width = |k: usize| {
        parts.iter().skip(k).step_by(columns).map(|p| p.bounds.width_mm()).fold(0.0, f64::max)
    };
    let widths: Vec<f64> = (0..columns).map(width).collect();
    let line = |p: &DrawingPart| caption_y(p).unwrap_or(p.bounds.min.y);
    let above = |p: &DrawingPart| p.bounds.max.y - line(p);
    let below = |p: &DrawingPart| line(p) - p.bounds.min.y;
    let mut y = 0.0;
    for row in parts.chunks_mut(columns) {
        let high = row.iter().map(above).fold(0.0, f64::max);
        let low = row.iter().map(below).fold(0.0, f64::max);
        let mut x = 0.0;
        for (part, wide) in row.iter_mut().zip(&widths) {
            let at = [x + (wide - part.bounds.width_mm()) / 2.0, y - (high - above(part))];
            part.stand_at(Point::new(at[0], at[1]));
            x += wide + GAP_MM;
        }
        y -= high + low + GAP_MM;
    }
}
