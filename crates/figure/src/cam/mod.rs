//! Figures of a disc cam: the motion of its follower over a turn ([`motion`]) and its profile by
//! inversion ([`inversion`]).

pub mod inversion;
pub mod motion;

use hodograph_base::geom::Point;
use hodograph_paper::paper::item::{Anchor, Colour, FigureItem, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::style::Style;
use hodograph_scene::{Lang, Scene};

/// The title of a figure: the scene's title, if any, and the kind of figure.
fn heading(scene: &Scene, otherwise: &str, lang: Lang) -> String {
    let title = scene.title.get(lang);
    match (title.is_empty(), lang) {
        (true, _) => otherwise.to_owned(),
        (false, Lang::En) => format!("{title}: {otherwise}"),
        (false, Lang::Zh) => format!("{title}：{otherwise}"),
    }
}

/// Text at a given point.
fn words_at(
    class: &str,
    at: Point,
    label: Label,
    size_mm: f64,
    anchor: Anchor,
    style: &Style,
) -> FigureItem {
    FigureItem::new(
        class,
        Shape::Label {
            at,
            label: label.in_fonts(&style.fonts),
            size_mm,
            anchor,
            colour: Colour::BLACK,
        },
    )
}
