//! The instantaneous centres: the mechanism with all of them and the lines that find them, and the circle diagram (点元法).
//!
//! [`diagram`] draws over the mechanism, [`rays`] says which lines it needs and how far they go, [`circle`] draws the diagram of links and
//! centres with its list.

mod circle;
mod diagram;
mod rays;

use crate::centres::{Centres, Pair, centres};
use crate::diag::{Faults, Warned};
use crate::geom::Point;
use crate::mechanism::Level;
use crate::plan::names::name_label;
use crate::scene::Scene;

use super::arrange::Tree;
use super::drawing::Part;
use super::item::Figure;
use super::label::Label;
use super::list::{Entry, Pages, Wanted, page};
use super::sheet::Maker;

/// All centres with the circle diagram.
pub const ENTRY: Entry = Entry {
    name: "centres",
    about: ["The instantaneous centres, with the circle diagram", "速度瞬心及点元图"],
    draw,
};

fn draw(w: &Wanted) -> Result<Warned<Pages>, Faults> {
    let Warned { value: found, notes } = centres(w.scene)?;
    // What is to be said of the pose is said of the scene's own questions already.
    let notes = notes.into_iter().filter(|d| d.code.starts_with("centre-")).collect();
    let pages = page(ENTRY.name, Some(figure(w, &found)))?;
    Ok(Warned { value: pages.value, notes })
}

/// The figure: both drawings side by side, or one below the other where the mechanism is wide.
fn figure(w: &Wanted, found: &Centres) -> Figure {
    let maker = Maker { scene: w.scene, worked: w.worked, options: w.options, certified: Vec::new() };
    let words = maker.words();
    let (_, mu) = maker.caption(Level::Position);
    let first = maker.titled(diagram::part(w, found), Label::text(format!("(a) {}", words.centres)), &mu, "centres");
    let second = maker.titled(circle::part(w, found), Label::text(format!("(b) {}", words.circle_diagram)), "", "circle");
    let wide = first.bounds.width_mm() > 1.6 * first.bounds.height_mm();
    let children = vec![Tree::Leaf(0), Tree::Leaf(1)];
    let tree = if wide { Tree::column(children) } else { Tree::row(children) };
    let mut parts = [first, second];
    tree.put(&mut parts, Point::ORIGIN);
    let mut figure = maker.alone(Part::of(parts.into_iter().flat_map(|p| p.items).collect()));
    figure.desc = format!("{} {}", words.centres, crate::report::centres::places(found, w.options.lang));
    figure
}

/// The name of a centre in the label language: `P_{24}`.
fn symbol(scene: &Scene, pair: Pair) -> String {
    format!("P_{{{}}}", name_label(&pair.indices(scene)))
}
