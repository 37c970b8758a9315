//! Draws the Assur groups apart 拆杆组: the driven part with the ground, then every group in its
//! pose with its class, from left to right in solving order. The number in front counts from the
//! far end, in the order in which groups are removed.

use super::mechanism::{MechanismPiece, apart};
use super::sheet::painted;
use hodograph_base::diag::{Both, Faults};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::{say, tr};
use hodograph_base::notation::Notation;
use hodograph_mechanism::mechanism::Assur;
use hodograph_paper::paper::drawing::DrawingPart;
use hodograph_paper::paper::extent::translate;
use hodograph_paper::paper::item::{Anchor, Colour, Figure, FigureItem, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::style::Style;
use hodograph_paper::paper::text;
use hodograph_report::plan::{dyad, grade};
use hodograph_scene::{Lang, Scene};
use hodograph_worked::worked::{Worked, work_replaced};

/// Gap between parts, and around them.
const GAP_MM: f64 = 16.0;
/// Distance from a part to its name.
const NAME_MM: f64 = 9.0;
/// Maximum width of a row with more than one part: A4 landscape without its margins.
const WIDE_MM: f64 = 281.0;
/// Border of the figure.
const MARGIN_MM: f64 = 8.0;
/// Distance of the lines below the parts.
const LINE_MM: f64 = 6.0;

/// Draws the figure; `worked` must hold all positions. A mechanism with cams is taken apart with a
/// link in place of each contact ([`Scene::replaced`]).
///
/// # Errors
/// The errors of [`work_replaced`].
pub fn figure(
    scene: &Scene,
    worked: &Worked,
    style: &Style,
    notation: &Notation,
    lang: Lang,
) -> Result<Figure, Faults> {
    let linkage = work_replaced(scene, worked)?;
    let (scene, worked) = linkage.as_ref().map_or((scene, worked), |(r, w)| (&r.scene, w));
    let parts = apart(style, scene, worked, notation);
    let groups =
        parts.iter().filter(|(piece, _)| matches!(piece, MechanismPiece::Group(_))).count();
    let mut number = groups;
    let mut named = Vec::new();
    for (piece, drawing) in parts {
        let name = match piece {
            MechanismPiece::Driven => tr!(lang, "driver and ground").to_owned(),
            MechanismPiece::Group(g) => {
                number -= 1;
                format!("{}. {}", number + 1, group_name(&g, lang))
            }
            MechanismPiece::Repeats => tr!(lang, "virtual constraint").to_owned(),
        };
        named.push((drawing.finish(), name));
    }
    let heading = match &linkage {
        Some(_) => tr!(lang, "Groups drawn apart, higher pairs replaced by lower ones"),
        None => tr!(lang, "Groups drawn apart"),
    };
    let about =
        say!(lang, "What is driven with the ground, and {groups} groups, each in its pose.");
    Ok(side_by_side(scene, named, (heading, &about, &[]), style, lang))
}

/// Draws parts side by side, each with its name below, with a heading above and lines below; `about`
/// is the description after the title.
pub(super) fn side_by_side(
    scene: &Scene,
    parts: Vec<(DrawingPart, String)>,
    (heading, about, lines): (&str, &str, &[String]),
    style: &Style,
    lang: Lang,
) -> Figure {
    let mut named = Vec::new();
    for (of, (drawing, name)) in parts.into_iter().enumerate() {
        let (mut part, baseline) = with_name(drawing, &name, style);
        // A pair between two parts is shown in both, with separate ids.
        part.items.iter_mut().for_each(|i| i.id = format!("part-{of}-{}", i.id));
        named.push((part, baseline));
    }
    let (mut items, drawn_mm, height_mm) = rows(named);
    let written = |text: &str, size_mm: f64| {
        let label = Label::text(text).in_fonts(&style.fonts);
        (text::set(&label).width_em * size_mm + 2.0 * MARGIN_MM, label)
    };
    let (heading_mm, _) = written(heading, style.caption_mm);
    let lines_mm = lines.iter().map(|line| written(line, style.small_mm).0);
    let width_mm = lines_mm.fold(drawn_mm.max(heading_mm), f64::max);
    let below_mm = LINE_MM * lines.len() as f64;
    translate(&mut items, Vec2::new((width_mm - drawn_mm) / 2.0, below_mm));
    let height_mm = height_mm + below_mm;
    let words_at = |id: &str, y: f64, (_, label): (f64, Label), size_mm: f64| {
        let at = Point::new(width_mm / 2.0, y);
        let (anchor, colour) = (Anchor::Middle, Colour::BLACK);
        let shape = Shape::Label { at, label, size_mm, anchor, colour };
        FigureItem::new(id, shape).with_id(id)
    };
    let top = height_mm - MARGIN_MM - style.caption_mm;
    items.insert(0, words_at("heading", top, written(heading, style.caption_mm), style.caption_mm));
    for (k, line) in lines.iter().enumerate() {
        let y = MARGIN_MM + below_mm - LINE_MM * (k + 1) as f64;
        let of = written(line, style.small_mm);
        items.push(FigureItem {
            id: format!("line-{}", k + 1),
            ..words_at("line", y, of, style.small_mm)
        });
    }
    let title = match lang.of(&scene.title) {
        "" => heading.to_owned(),
        title => format!("{title}{}{heading}", tr!(lang, ": ")),
    };
    let desc = match lang {
        Lang::En => format!("{title}. {about}"),
        Lang::Zh => format!("{title}。{about}"),
    };
    painted(style, lang, [width_mm, height_mm], [title, desc], items)
}

fn group_name(g: &Assur, lang: Lang) -> String {
    let kind = dyad(g).map_or(String::new(), |kind| format!(" {kind}"));
    let class = g.class().unwrap_or_default();
    say!(lang, "class {}{kind}", Both { en: class.to_owned(), zh: grade(class).to_owned() })
}

/// The part with its name below, and the baseline of the name.
fn with_name(part: DrawingPart, name: &str, style: &Style) -> (DrawingPart, f64) {
    let label = Label::text(name).in_fonts(&style.fonts);
    let at = Point::new(part.bounds.centre().x, part.bounds.min.y - NAME_MM);
    let shape = Shape::Label {
        at,
        label,
        size_mm: style.small_mm,
        anchor: Anchor::Middle,
        colour: Colour::BLACK,
    };
    let mut items = part.items;
    items.push(FigureItem::new("caption", shape).with_id("caption"));
    (DrawingPart::of(items), at.y)
}

/// Arranges the parts side by side, their names on one line, in as many rows as needed; returns the
/// items and the size of the figure.
fn rows(parts: Vec<(DrawingPart, f64)>) -> (Vec<FigureItem>, f64, f64) {
    let mut lines: Vec<Vec<(DrawingPart, f64)>> = Vec::new();
    let mut width = f64::INFINITY;
    for part in parts {
        let own = part.0.bounds.width_mm();
        let wider = width + GAP_MM + own;
        if wider > WIDE_MM {
            lines.push(Vec::new());
            width = own;
        } else {
            width = wider;
        }
        lines.last_mut().expect("a line was begun").push(part);
    }
    let width_of = |line: &Vec<(DrawingPart, f64)>| {
        line.iter().map(|p| p.0.bounds.width_mm() + GAP_MM).sum::<f64>() - GAP_MM
    };
    let widest = lines.iter().map(width_of).fold(0.0, f64::max);
    let (mut items, mut y) = (Vec::new(), MARGIN_MM);
    for line in lines.into_iter().rev() {
        let mut x = MARGIN_MM + (widest - width_of(&line)) / 2.0;
        let height = line.iter().map(|(p, baseline)| p.bounds.max.y - baseline).fold(0.0, f64::max);
        for (mut part, baseline) in line {
            let by: Vec2 = Point::new(x, y) - Point::new(part.bounds.min.x, baseline);
            part.translate(by);
            x += part.bounds.width_mm() + GAP_MM;
            items.extend(part.items);
        }
        y += height + GAP_MM;
    }
    (items, widest + 2.0 * MARGIN_MM, y + MARGIN_MM)
}
