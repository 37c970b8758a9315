//! Figures as drawings for CAD programs (DXF).

use crate::figure::mechanism::mechanism as draw_mechanism;
use crate::notation::Notation;
use crate::paper::extent::translate;
use crate::paper::item::{Figure, FigureItem, Shape};
use crate::paper::style::Style;
use crate::render::dxf::{drawn, dxf};
use crate::scene::{DiagramKind, Scene};
use crate::worked::Worked;

/// Returns the kinematic diagram in the millimetres of the scene, with the origin of the scene's
/// coordinates in the origin of the drawing.
pub fn mechanism(scene: &Scene, worked: &Worked, style: &Style, notation: &Notation) -> String {
    let items = draw_mechanism(style, scene, worked, notation).items;
    let metres = worked.scale(DiagramKind::Plane).unwrap_or(1e-3);
    dxf(&drawn(&items, metres * 1e3, layer))
}

/// Returns a figure in the millimetres of its paper, with the pole of its first polygon in the
/// origin of the drawing, if it has one.
pub fn drawing(figure: &Figure) -> String {
    let mut items = figure.items.clone();
    let pole = figure.marks().find(|m| m.names.iter().any(|name| name.starts_with("pole-")));
    if let Some(pole) = pole {
        translate(&mut items, -pole.at.to_vec2());
    }
    dxf(&drawn(&items, 1.0, layer))
}

/// The layer of an item, by its meaning.
fn layer(item: &FigureItem) -> &'static str {
    if matches!(item.shape, Shape::Label { .. } | Shape::Turned { .. }) {
        return "TEXT";
    }
    let has = |word: &str| item.class.split_whitespace().any(|w| w == word);
    if has("leader") {
        return "TEXT";
    }
    if has("construction") || has("image") {
        return "CONSTRUCTION";
    }
    match item.class.split_whitespace().find(|w| !w.starts_with("step-")) {
        Some("mechanism") if has("pin") || has("pivot") || has("dot") => "JOINTS",
        Some("mechanism") if has("ground") => "GROUND",
        Some("mechanism") if has("driver") || has("force") || has("couple") => "GIVEN",
        Some("mechanism") => "LINKS",
        Some("velocity") => "VELOCITY",
        Some("acceleration") => "ACCELERATION",
        Some("force") => "FORCE",
        _ => "DRAWING",
    }
}
