//! Polar diagrams: each vector of a sweep is drawn from one pole, and its tip traces a curve, such
//! as the force on a bearing or the hodograph of a velocity.
//!
//! This module chooses scales, numbered positions and captions.
//! [`hodograph`](super::super::hodograph) draws one curve.

use super::diagram::DEGREE;
use crate::arrange::{Tree, put_together};
use crate::hodograph::{Hodograph, hodograph, runs};
use crate::scales::DrawingScales;
use crate::sheet::{MARGIN_MM, painted, swept_symbol, titled};
use hodograph_base::digits::{inked, shortest};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::{say, tr};
use hodograph_base::notation::Notation;
use hodograph_board::construct::scale;
use hodograph_paper::paper::drawing::DrawingPart;
use hodograph_paper::paper::item::{Anchor, Colour, Figure, FigureItem, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::phrase::Phrase;
use hodograph_paper::paper::shown::question_id;
use hodograph_paper::paper::style::Style;
use hodograph_report::amount::symbol;
use hodograph_scene::{DiagramKind, Lang, Scene, Swept};
use hodograph_sweep::{Table, points::bounded};

/// Space for one curve.
const BOX_MM: [f64; 2] = [100.0, 100.0];
/// Numbered positions of a sweep.
const POSITIONS: usize = 12;
/// Number of curves side by side.
const IN_ROW: usize = 2;

/// Draws the polar diagrams of all vectors of a sweep; `None` if it has no vectors.
pub fn polar(
    scene: &Scene,
    swept: Swept,
    table: &Table,
    style: &Style,
    notation: &Notation,
    lang: Lang,
) -> Option<Figure> {
    let places = &table.columns.first()?.values;
    let last = places.len().checked_sub(1)?;
    // Positions at equal steps without the last row, which repeats the first in a sweep over a full
    // turn.
    let marked: Vec<usize> =
        (0..POSITIONS.min(last)).map(|k| k * last / POSITIONS.min(last)).collect();
    let usual = places.windows(2).map(|w| (w[1] - w[0]).abs()).fold(f64::INFINITY, f64::min);
    let mut drawings = Vec::new();
    for find in &scene.find {
        let column = |axis: &str| table.column(&format!("{}.{axis}", find.text));
        let (Some(x), Some(y)) = (column("x"), column("y")) else { continue };
        let on = find.what.diagram();
        let vector = |k: usize| Some(Vec2::new(x.values[k], y.values[k])).filter(|v| v.is_finite());
        let mut curve: Vec<Option<Vec2>> = Vec::new();
        for k in 0..places.len() {
            // Nothing is known between rows that are far apart.
            if k > 0 && (places[k] - places[k - 1]).abs() > 1.5 * usual {
                curve.push(None);
            }
            curve.push(vector(k));
        }
        let Some(most) = bounded(
            curve.iter().flatten().map(|v| v.norm()).collect(),
            0.0,
            on == DiagramKind::Force,
        ) else {
            continue;
        };
        let (shown, _) = runs(&curve, false, most);
        let ends = shown.iter().flatten().map(|v| v.to_point()).chain([Point::ORIGIN]);
        let mu = scale::fitted(&scene.paper, on.kind(), scale::extent(ends), BOX_MM);
        let pole = if on == DiagramKind::Force {
            "O".to_owned()
        } else {
            format!("{}{}", notation.pole, on.prime())
        };
        let link = find
            .what
            .points(scene)
            .first()
            .and_then(|p| p.link.or(scene.mover(p.point)))
            .map(|l| l.0);
        let marks: Vec<Option<Vec2>> = marked.iter().map(|k| vector(*k)).collect();
        let h = Hodograph {
            on,
            quantity: &find.text,
            pole: &pole,
            link,
            curve: &curve,
            closed: false,
            marks: &marks,
            most,
            mu,
            book: &scene.book,
        };
        let caption = say!(lang, "Polar diagram of ${}$", symbol(find, notation));
        let caption = Phrase::new(&caption).label();
        drawings.push(titled(
            style,
            hodograph(style, &h),
            caption,
            &DrawingScales::of(&scene.book, on, mu),
            &question_id(&find.text),
        ));
    }
    if drawings.is_empty() {
        return None;
    }
    let said =
        positions(scene, swept, &marked.iter().map(|k| places[*k]).collect::<Vec<_>>(), lang);
    let line = |id: &str, label: Label, size_mm: f64| {
        let label = label.in_fonts(&style.fonts);
        let shape = Shape::Label {
            at: Point::ORIGIN,
            label,
            size_mm,
            anchor: Anchor::Start,
            colour: Colour::BLACK,
        };
        DrawingPart::of(vec![FigureItem::new(id, shape).with_id(id)])
    };
    let heading = lang.of(&scene.title);
    let count = drawings.len();
    let rows = (0..count).collect::<Vec<_>>();
    let mut tree: Vec<Tree> = rows
        .chunks(IN_ROW)
        .map(|row| Tree::row(row.iter().map(|k| Tree::Leaf(*k)).collect()))
        .collect();
    tree.push(Tree::Leaf(count));
    drawings.push(line("positions", Phrase::new(&said).label(), style.small_mm));
    if !heading.is_empty() {
        tree.insert(0, Tree::Leaf(count + 1));
        drawings.push(line("title", Label::text(heading), style.caption_mm * 4.0 / 3.0));
    }
    let mut all = put_together(Tree::column(tree), drawings);
    let [width_mm, height_mm] =
        [all.bounds.width_mm() + 2.0 * MARGIN_MM, all.bounds.height_mm() + 2.0 * MARGIN_MM];
    all.stand_at(Point::new(MARGIN_MM, height_mm - MARGIN_MM));
    let title = if heading.is_empty() { tr!(lang, "Polar diagrams") } else { heading }.to_owned();
    let desc = Phrase::new(&said).plain();
    Some(painted(style, lang, [width_mm, height_mm], [title, desc], all.items))
}

/// The driver's places at the numbered positions, in words.
fn positions(scene: &Scene, swept: Swept, places: &[f64], lang: Lang) -> String {
    let (driver, kind) = swept_symbol(scene, swept);
    let (unit, factor) = scene.book.fine(kind);
    let parts = scene.book.parts(kind, 100.0);
    let degree = unit == DEGREE;
    let number = |x: &f64| {
        format!(
            "{}{}",
            inked(&shortest((x * factor * parts).round() / parts)),
            if degree { DEGREE } else { "" }
        )
    };
    let list: Vec<String> = places.iter().map(|x| format!("${}$", number(x))).collect();
    let unit = if degree { String::new() } else { format!(" ${unit}$") };
    let list = list.join(lang.comma());
    say!(lang, "Positions 1 to {}: ${driver}$ = {list}{unit}", places.len())
}
