//! Draws the instantaneous centres: the mechanism with all centres and the lines that find them,
//! and the circle diagram (瞬心多边形).
//!
//! [`diagram`] draws over the mechanism, [`rays`] selects the lines and their lengths, [`circle`]
//! draws the circle diagram with its list.

mod circle;
mod diagram;
pub(super) mod rays;

use hodograph_base::diag::{Faults, Warned};
use hodograph_base::geom::Point;
use hodograph_board::plan::names::name_label;
use hodograph_methods::centres::{CentreMethod, Centres, LinkPair, centres};
use hodograph_scene::{DiagramKind, Scene};

use rays::CentrePlate;

use super::arrange::{AIM_MM, Tree};
use super::list::{FigureEntry, FigureInput, Pages, page};
use super::sheet::{MARGIN_MM, SheetDrafter};
use crate::scales::DrawingScales;
use hodograph_paper::paper::drawing::DrawingPart;
use hodograph_paper::paper::item::Figure;
use hodograph_paper::paper::label::Label;

/// Maximum number of centres found by lines in a single drawing: those of a six-bar.
const MOST: usize = 12;
/// Centres per drawing if there are more.
const PER_PLATE: usize = 5;

/// All centres with the circle diagram.
pub const ENTRY: FigureEntry = FigureEntry {
    name: "centres",
    about: ["The instantaneous centres, with the circle diagram", "速度瞬心及瞬心多边形"],
    draw,
};

fn draw(w: &FigureInput) -> Result<Warned<Pages>, Faults> {
    let Warned { value: found, notes } = centres(w.scene)?;
    // The notes about the pose already appear with the scene's own questions.
    let notes = notes.into_iter().filter(|d| d.code.starts_with("centre-")).collect();
    let plates = plates(&found);
    let pages = if plates.len() > 1 {
        parted(w, &found, plates)
    } else {
        page(ENTRY.name, Some(figure(w, &found)))?.value
    };
    Ok(Warned { value: pages, notes })
}

/// The mechanism with its centres within `reach_mm` around it, and the circle diagram. The class of
/// each item of a centre names the centre's place in the order of finding (`step-2`).
pub fn stepped(w: &FigureInput, found: &Centres, reach_mm: f64) -> [DrawingPart; 2] {
    [diagram::stepped(w, found, reach_mm), circle::stepped(w, found)]
}

/// The centres that are found by lines, in their order, with only as many per drawing as keep its
/// lines distinct.
fn plates(found: &Centres) -> Vec<CentrePlate> {
    let by_lines =
        |how: &CentreMethod| matches!(how, CentreMethod::Lines(_) | CentreMethod::Velocities);
    // The list is in the order of finding.
    let order: Vec<usize> =
        (0..found.list.len()).filter(|k| by_lines(&found.list[*k].step.how)).collect();
    if order.len() <= MOST {
        return vec![CentrePlate::default()];
    }
    let count = order.len().div_ceil(PER_PLATE);
    order
        .chunks(order.len().div_ceil(count))
        .map(|c| CentrePlate { found: Some(c.to_vec()) })
        .collect()
}

/// A page for each plate, and one for the circle diagram with the order of finding.
fn parted(w: &FigureInput, found: &Centres, plates: Vec<CentrePlate>) -> Pages {
    let maker = SheetDrafter {
        scene: w.scene,
        worked: w.worked,
        options: w.options,
        certified: Vec::new(),
    };
    let words = maker.words();
    let (_, mu) = maker.caption(DiagramKind::Plane);
    let mut pages = Pages::new();
    let mut first = 1;
    for (k, plate) in plates.iter().enumerate() {
        let last = first + plate.found.as_ref().map_or(0, Vec::len) - 1;
        let caption = format!("{} {first} – {last}", words.centres);
        let part =
            maker.titled(diagram::part(w, found, plate), Label::text(caption), &mu, "centres");
        pages.push((
            format!("{}-{}", ENTRY.name, k + 1),
            described(maker.alone(part), w, found, words.centres),
        ));
        first = last + 1;
    }
    let circle = maker.titled(
        circle::part(w, found),
        Label::text(words.circle_diagram),
        &DrawingScales::default(),
        "circle",
    );
    pages.push((
        format!("{}-{}", ENTRY.name, plates.len() + 1),
        described(maker.alone(circle), w, found, words.circle_diagram),
    ));
    pages
}

fn described(mut figure: Figure, w: &FigureInput, found: &Centres, title: &str) -> Figure {
    figure.desc = format!("{title} {}", hodograph_report::centres::places(found, w.options.lang));
    figure
}

/// The figure: both drawings side by side, or one below the other.
fn figure(w: &FigureInput, found: &Centres) -> Figure {
    let maker = SheetDrafter {
        scene: w.scene,
        worked: w.worked,
        options: w.options,
        certified: Vec::new(),
    };
    let words = maker.words();
    let (_, mu) = maker.caption(DiagramKind::Plane);
    let first = maker.titled(
        diagram::part(w, found, &CentrePlate::default()),
        Label::text(format!("(a) {}", words.centres)),
        &mu,
        "centres",
    );
    let second = maker.titled(
        circle::part(w, found),
        Label::text(format!("(b) {}", words.circle_diagram)),
        &DrawingScales::default(),
        "circle",
    );
    let mut parts = [first, second];
    let trees = [
        Tree::row(vec![Tree::Leaf(0), Tree::Leaf(1)]),
        Tree::column(vec![Tree::Leaf(0), Tree::Leaf(1)]),
    ];
    // The arrangement that fills a page best, portrait or landscape.
    let fits = |[w, h]: [f64; 2]| {
        let [a, b] = AIM_MM.map(|mm| mm - 2.0 * MARGIN_MM);
        (a / w).min(b / h).max((b / w).min(a / h))
    };
    let [row, column] = trees.each_ref().map(|t| fits(t.size(&parts)));
    trees[usize::from(column > row)].put(&mut parts, Point::ORIGIN);
    described(
        maker.alone(DrawingPart::of(parts.into_iter().flat_map(|p| p.items).collect())),
        w,
        found,
        words.centres,
    )
}

/// The name of a centre in the label language: `P_{24}`.
fn symbol(scene: &Scene, pair: LinkPair) -> String {
    format!("P_{{{}}}", name_label(&pair.indices(scene)))
}
