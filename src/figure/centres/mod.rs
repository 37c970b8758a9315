//! The instantaneous centres: the mechanism with all of them and the lines that find them, and the circle diagram (点元法).
//!
//! [`diagram`] draws over the mechanism, [`rays`] says which lines it needs and how far they go, [`circle`] draws the diagram of links and
//! centres with its list.

mod circle;
mod diagram;
pub(super) mod rays;

use crate::centres::{Centres, Pair, centres};
use crate::diag::{Faults, Warned};
use crate::geom::Point;
use crate::mechanism::Level;
use crate::plan::names::name_label;
use crate::scene::Scene;

use super::arrange::{AIM_MM, Tree};
use super::drawing::Part;
use super::item::Figure;
use super::label::Label;
use super::list::{Entry, Pages, Wanted, page};
use super::sheet::{MARGIN_MM, Maker};

/// All centres with the circle diagram.
pub const ENTRY: Entry =
    Entry { name: "centres", about: ["The instantaneous centres, with the circle diagram", "速度瞬心及点元图"], draw };

fn draw(w: &Wanted) -> Result<Warned<Pages>, Faults> {
    let Warned { value: found, notes } = centres(w.scene)?;
    // What is to be said of the pose is said of the scene's own questions already.
    let notes = notes.into_iter().filter(|d| d.code.starts_with("centre-")).collect();
    let pages = page(ENTRY.name, Some(figure(w, &found)))?;
    Ok(Warned { value: pages.value, notes })
}

/// The figure: both drawings side by side, or one below the other.
fn figure(w: &Wanted, found: &Centres) -> Figure {
    let maker = Maker { scene: w.scene, worked: w.worked, options: w.options, certified: Vec::new() };
    let words = maker.words();
    let (_, mu) = maker.caption(Level::Position);
    let first = maker.titled(diagram::part(w, found), Label::text(format!("(a) {}", words.centres)), &mu, "centres");
    let second = maker.titled(circle::part(w, found), Label::text(format!("(b) {}", words.circle_diagram)), "", "circle");
    let mut parts = [first, second];
    let trees = [Tree::row(vec![Tree::Leaf(0), Tree::Leaf(1)]), Tree::column(vec![Tree::Leaf(0), Tree::Leaf(1)])];
    // The one that fills a page best, upright or across.
    let fits = |[w, h]: [f64; 2]| {
        let [a, b] = AIM_MM.map(|mm| mm - 2.0 * MARGIN_MM);
        (a / w).min(b / h).max((b / w).min(a / h))
    };
    let [row, column] = trees.each_ref().map(|t| fits(t.size(&parts)));
    trees[usize::from(column > row)].put(&mut parts, Point::ORIGIN);
    let mut figure = maker.alone(Part::of(parts.into_iter().flat_map(|p| p.items).collect()));
    figure.desc = format!("{} {}", words.centres, crate::report::centres::places(found, w.options.lang));
    figure
}

/// The name of a centre in the label language: `P_{24}`.
fn symbol(scene: &Scene, pair: Pair) -> String {
    format!("P_{{{}}}", name_label(&pair.indices(scene)))
}
