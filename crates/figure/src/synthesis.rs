//! Figures of a synthesis: the construction with numbered steps, the linkage in its prescribed
//! positions, and the comparison of required and actual function.

mod positions;

pub use positions::{MOVES, Scaled, deviation, generated, linkage, scaled};

use crate::mechanism::supports::{cheapest_side, is_over_support};
use crate::sheet::painted;
use hodograph_base::diag::Faults;
use hodograph_base::digits::{inked, shortest, significant};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::tr;
use hodograph_board::construct::scale::choose;
use hodograph_paper::paper::extent::{Rect, translate};
use hodograph_paper::paper::item::{
    Anchor, Colour, Figure, FigureItem, LineStroke, PLACED, Shape, distinct, tag,
};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::lines::wrapped;
use hodograph_paper::paper::phrase::Phrase;
use hodograph_paper::paper::place::{LabelRequest, Obstacles, place};
use hodograph_paper::paper::shown::escaped;
use hodograph_paper::paper::style::Style;
use hodograph_paper::paper::symbols as sym;
use hodograph_paper::paper::text;
use hodograph_report::symbols::symbols;
use hodograph_report::synthesis::positions;
use hodograph_scene::{Kind, Lang};
use hodograph_synthesis::board::{PaperAngle, PaperStroke as Drawn, SynthesisBoard, Weight};
use hodograph_synthesis::candidate::symbol;
use hodograph_synthesis::{DesignCandidate, Task, construct};

/// Space for a drawing (mm): an A4 sheet with its margins, and text below.
const ROOM_MM: [f64; 2] = [150.0, 120.0];
const MARGIN_MM: f64 = 10.0;
/// Extension of construction lines beyond the marked points.
const BEYOND_MM: f64 = 14.0;
/// Width of the text below.
const TEXT_MM: f64 = 165.0;
/// Width of construction strokes, the thinnest of three kinds: givens have the width of an outline,
/// results that of a link.
const THIN: LineStroke = LineStroke::new(0.13);
/// Radius of the innermost arc of an angle, and distance of the next one outside.
const ANGLE_MM: f64 = 9.0;
const ANGLE_STEP_MM: f64 = 4.5;
/// A shorter arc of an angle is not drawn.
const LEAST_ANGLE_MM: f64 = 0.8;
/// Two places nearer than this are one.
const SAME_MM: f64 = 1e-2;

/// The settings of a figure.
#[derive(Clone, Copy, Debug)]
pub struct Set<'a> {
    /// Line widths, sizes, fonts, colours.
    pub style: &'a Style,
    /// The language of the words.
    pub lang: Lang,
    /// True for a self-contained figure, with its title and the sentences of the steps below;
    /// otherwise the surrounding document contains them.
    pub whole: bool,
}

/// Draws all figures of a candidate, each with the word for its file name.
///
/// # Errors
/// Drawing and formula disagree.
pub fn figures(
    task: &Task,
    candidate: &DesignCandidate,
    style: &Style,
    lang: Lang,
) -> Result<Vec<(&'static str, Figure)>, Faults> {
    let set = Set { style, lang, whole: true };
    let mut out = Vec::new();
    if let Some(board) = to_scale(task, candidate)? {
        out.push(("construction", construction(task, candidate, &board, set)));
    }
    out.push(("positions", linkage(task, candidate, set)));
    out.extend(generated(task, candidate, set).map(|f| ("function", f)));
    out.extend(deviation(task, candidate, set).map(|f| ("deviation", f)));
    Ok(out)
}

/// Constructs to a round scale that fits the paper, or to the scale given in the file.
///
/// # Errors
/// Drawing and formula disagree.
pub fn to_scale(
    task: &Task,
    candidate: &DesignCandidate,
) -> Result<Option<SynthesisBoard>, Faults> {
    if let Some(mu) = task.paper.scales.get(Kind::Length) {
        return construct(task, candidate, mu);
    }
    // A first drawing in millimetres gives the size.
    let Some(board) = construct(task, candidate, 1e-3)? else { return Ok(None) };
    let Some(window) = window(&board) else { return Ok(None) };
    construct(
        task,
        candidate,
        choose([window.width_mm() * 1e-3, window.height_mm() * 1e-3], ROOM_MM),
    )
}

/// Returns a figure for each step of a construction, without the later steps.
pub fn growing(construction: &Figure) -> Vec<(String, Figure)> {
    let last = construction.items.iter().flat_map(FigureItem::steps).max().unwrap_or(0);
    let at = |k: usize| {
        let mut figure = construction.clone();
        figure.items.retain(|item| item.steps().all(|step| step <= k));
        (format!("step-{:02}", k + 1), figure)
    };
    (0..=last).map(at).collect()
}

/// The box around the marks and the lines of the linkage.
fn window(board: &SynthesisBoard) -> Option<Rect> {
    let marks = board.steps.iter().flat_map(|s| s.marks.iter().map(|m| m.1));
    let ends =
        board.steps.iter().flat_map(|s| &s.strokes).filter(|(_, w)| *w != Weight::Thin).flat_map(
            |(stroke, _)| match *stroke {
                Drawn::Line(p, q) => vec![p, q],
                Drawn::Circle(c, r) | Drawn::Arc(c, r, _) => {
                    vec![c - Vec2::new(r, r), c + Vec2::new(r, r)]
                }
            },
        );
    let own = around(marks.chain(ends))?;
    // The places where the compasses strike are included if they enlarge the drawing only a little.
    let struck =
        board.steps.iter().flat_map(|s| &s.strokes).filter_map(|(stroke, _)| match *stroke {
            Drawn::Arc(c, r, at) => Some(c + Vec2::from_angle(at) * r),
            Drawn::Line(..) | Drawn::Circle(..) => None,
        });
    let room = |grown: Rect| {
        grown.width_mm().max(grown.height_mm()) <= MORE * own.width_mm().max(own.height_mm())
    };
    Some(struck.fold(own, |window, at| {
        Some(window.union(Rect::new(at, at))).filter(|w| room(*w)).unwrap_or(window)
    }))
}

/// Maximum enlargement of a drawing to show where the compasses strike.
const MORE: f64 = 1.2;

fn around(points: impl Iterator<Item = Point>) -> Option<Rect> {
    points.map(|p| Rect::new(p, p)).reduce(Rect::union)
}

/// The part of a chain of points within a window, in pieces.
fn clipped(points: &[Point], window: Rect) -> Vec<Vec<Point>> {
    let inside = |p: &Point| {
        p.x >= window.min.x && p.x <= window.max.x && p.y >= window.min.y && p.y <= window.max.y
    };
    let mut out: Vec<Vec<Point>> = vec![Vec::new()];
    for p in points {
        match out.last_mut() {
            Some(piece) if inside(p) => piece.push(*p),
            Some(piece) if !piece.is_empty() => out.push(Vec::new()),
            _ => {}
        }
    }
    out.retain(|piece| piece.len() > 1);
    out
}

/// Half the angle of the arc that the compasses strike at a crossing (rad).
const ARC: f64 = 0.2;

/// Converts a stroke to a chain of points, fine enough to show no corners.
fn chain(stroke: &Drawn) -> Vec<Point> {
    const STEPS: usize = 720;
    match *stroke {
        Drawn::Line(p, q) => (0..=STEPS).map(|k| p + (q - p) * (k as f64 / STEPS as f64)).collect(),
        Drawn::Arc(c, r, middle) => {
            let at = |k: usize| c + Vec2::from_angle(middle + ARC * (k as f64 / 20.0 - 1.0)) * r;
            (0..=40).map(at).collect()
        }
        Drawn::Circle(c, r) => (0..=STEPS)
            .map(|k| c + Vec2::from_angle(std::f64::consts::TAU * k as f64 / STEPS as f64) * r)
            .collect(),
    }
}

/// Draws the construction with its steps numbered.
pub fn construction(
    task: &Task,
    candidate: &DesignCandidate,
    board: &SynthesisBoard,
    set: Set,
) -> Figure {
    let Set { style, lang, whole } = set;
    let window = window(board).unwrap_or(Rect::new(Point::ORIGIN, Point::ORIGIN)).grown(BEYOND_MM);
    let mut items = Vec::new();
    let mut wanted: Vec<(LabelRequest, usize, String)> = Vec::new();
    let mut vertices: Vec<Point> = Vec::new();
    let pivots: Vec<String> =
        positions(candidate).into_iter().take(1).flat_map(|p| p.fixed).map(|f| f.0).collect();
    let is_pivot = |mark: &&(String, Point)| pivots.contains(&mark.0);
    let grounded = |at: Point| {
        let mut marks = board.steps.iter().flat_map(|s| &s.marks);
        marks.any(|m| is_pivot(&m) && m.1.distance(at) < SAME_MM)
    };
    let label = |text: &str| Label::math(text).in_fonts(&style.fonts);
    for (k, step) in board.steps.iter().enumerate() {
        let stroke_of = |weight: Weight| match weight {
            Weight::Given => style.outline,
            Weight::Thin => THIN.coloured(Colour::grey(90)),
            Weight::Result => style.link,
        };
        let class = format!("step-{k} construction");
        let mut numbered = false;
        for (stroke, weight) in &step.strokes {
            let whole = chain(stroke);
            let pieces = clipped(&whole, window);
            // A piece of an arc at the edge would be meaningless: the arc is drawn completely or
            // not at all.
            let cut = matches!(stroke, Drawn::Arc(..))
                && pieces.iter().map(Vec::len).sum::<usize>() < whole.len();
            for points in pieces.into_iter().filter(|_| !cut) {
                // The number of the step is at its first stroke.
                if !numbered && points.len() > 4 {
                    let at = points.len() / 3;
                    let number = Label::text(format!("({})", k + 1)).in_fonts(&style.fonts);
                    wanted.push((
                        LabelRequest::along(
                            number,
                            style.small_mm * 0.8,
                            points[at],
                            points[at + points.len() / 6],
                            0.3,
                        )
                        .optional(true),
                        k,
                        format!("label-step-{}", k + 1),
                    ));
                    numbered = true;
                }
                let points = match stroke {
                    Drawn::Line(..) => {
                        [points.first(), points.last()].into_iter().flatten().copied().collect()
                    }
                    Drawn::Circle(..) | Drawn::Arc(..) => points,
                };
                let shape = Shape::Polyline {
                    points,
                    closed: false,
                    stroke: Some(stroke_of(*weight)),
                    fill: None,
                };
                items.push(
                    FigureItem::new(class.clone(), shape).with_id(stroke_id(stroke, *weight)),
                );
            }
        }
        for angle in &step.angles {
            let inside = vertices.iter().filter(|at| **at == angle.at).count();
            vertices.push(angle.at);
            if let Some((shape, request)) = angle_mark(angle, inside, style) {
                items.push(FigureItem::new(class.clone(), shape).with_id("angle"));
                wanted.push((request, k, "label-angle".into()));
            }
        }
        for (name, at) in &step.marks {
            let shape = Shape::Circle {
                centre: *at,
                radius_mm: 0.55,
                stroke: None,
                fill: Some(Colour::BLACK),
            };
            let plain = name.replace(['_', '{', '}'], "");
            items.push(
                FigureItem::new(class.clone(), shape).with_id(format!("mark-{}", escaped(&plain))),
            );
            wanted.push((
                LabelRequest::at_point(label(name), style.small_mm, *at, 0.9),
                k,
                format!("label-{}", escaped(&plain)),
            ));
        }
        for (stroke, _) in step.strokes.iter().filter(|s| s.1 == Weight::Result) {
            for end in ends(stroke).filter(|end| !grounded(*end)) {
                let mut pin = sym::pin(style, end);
                tag(&mut pin, &class);
                items.extend(pin);
            }
        }
        for (_, at) in step.marks.iter().filter(|m| is_pivot(m)) {
            let mut support = sym::fixed_pivot(style, *at, free_side(board, *at));
            tag(&mut support, &class);
            items.extend(support);
        }
    }
    let room = window.grown(6.0);
    let (requests, named): (Vec<LabelRequest>, Vec<(usize, String)>) =
        wanted.into_iter().map(|(r, k, id)| (r, (k, id))).unzip();
    let placed = place(&requests, &Obstacles::of(&items), room);
    for ((request, at), (k, id)) in requests.iter().zip(&placed).zip(named) {
        let mut labels = at.items(request, PLACED, style.thin);
        tag(&mut labels, &format!("step-{k}"));
        labels.iter_mut().for_each(|item| item.id.clone_from(&id));
        items.extend(labels);
    }
    let lines = if whole { sentences(candidate, board, set) } else { Vec::new() };
    let part = tr!(lang, "construction");
    page(task, part, items, room, (Some(scale_of(board.mu_l)), lines), set)
}

/// The ends of a straight stroke.
fn ends(stroke: &Drawn) -> impl Iterator<Item = Point> {
    let ends = match *stroke {
        Drawn::Line(p, q) => Some([p, q]),
        Drawn::Circle(..) | Drawn::Arc(..) => None,
    };
    ends.into_iter().flatten()
}

/// The side of a pivot for its support: down, or the first of up, left and right that fewer lines
/// take.
fn free_side(board: &SynthesisBoard, at: Point) -> Vec2 {
    let leaving: Vec<Vec2> = board
        .steps
        .iter()
        .flat_map(|s| &s.strokes)
        .map(|(stroke, _)| ends(stroke).collect::<Vec<_>>())
        .filter(|ends| ends.iter().any(|end| end.distance(at) < SAME_MM))
        .flat_map(|ends| ends.into_iter().filter_map(|end| (end - at).unit()))
        .collect();
    cheapest_side(|side| leaving.iter().filter(|u| is_over_support(**u, *side)).count() as f64)
}

/// The arc of an angle and the request of its name; `None` for an angle too small to be seen. Arcs
/// at one vertex lie outside each other, and `inside` of them are inside this one.
fn angle_mark(angle: &PaperAngle, inside: usize, style: &Style) -> Option<(Shape, LabelRequest)> {
    let [from, to] = angle.legs.map(|leg| leg - angle.at);
    let sweep = libm::atan2(from.cross(to), from.dot(to));
    let shorter = libm::sqrt(from.norm2().min(to.norm2()));
    let radius_mm = (ANGLE_MM + ANGLE_STEP_MM * inside as f64).min(0.7 * shorter);
    if radius_mm * sweep.abs() < LEAST_ANGLE_MM {
        return None;
    }
    let (from_rad, to_rad) = (from.angle(), from.angle() + sweep);
    let shape = Shape::Arc { centre: angle.at, radius_mm, from_rad, to_rad, stroke: style.thin };
    let name = Label::math(angle.name.as_str()).in_fonts(&style.fonts);
    let request =
        LabelRequest::along_arc(name, style.small_mm, angle.at, radius_mm, [from_rad, to_rad], 0.4);
    Some((shape, request))
}

/// The id of a stroke: `given-line`, `construction-arc`, `result-circle`.
fn stroke_id(stroke: &Drawn, weight: Weight) -> String {
    let weight = match weight {
        Weight::Given => "given",
        Weight::Thin => "construction",
        Weight::Result => "result",
    };
    let form = match stroke {
        Drawn::Line(..) => "line",
        Drawn::Circle(..) => "circle",
        Drawn::Arc(..) => "arc",
    };
    format!("{weight}-{form}")
}

/// A scale as a caption.
fn scale_of(mu_l: f64) -> Label {
    Label::math(format!("\\mu_l = {}\\,\\text{{m/mm}}", inked(&shortest(mu_l))))
}

/// The instruction of each step, and the values read off the paper.
fn sentences(
    candidate: &DesignCandidate,
    board: &SynthesisBoard,
    Set { style, lang, .. }: Set,
) -> Vec<Label> {
    let mut lines: Vec<Label> = Vec::new();
    let mut add = |sentence: &str| {
        lines.extend(wrapped(&Phrase::new(sentence), TEXT_MM, style.small_mm, &style.fonts))
    };
    for (k, step) in board.steps.iter().enumerate() {
        add(&symbols(&format!("({}) {}", k + 1, lang.of(&step.text))));
    }
    let (open, close) = (tr!(lang, " ("), tr!(lang, ")"));
    let readings = board.readings.iter().filter_map(|r| {
        let formula = candidate.number(&r.name)?.abs();
        let name = format!("${}$", symbol(&r.name));
        Some(match r.angle {
            true => {
                format!(
                    "{} = {}°{open}{}°{close}",
                    name,
                    significant(board.value(r).to_degrees(), 5),
                    significant(formula.to_degrees(), 5)
                )
            }
            false => format!(
                "{} = {} mm × $\\mu_l$ = {} mm{open}{} mm{close}",
                name,
                significant(r.measured, 4),
                significant(board.value(r) * 1e3, 5),
                significant(formula * 1e3, 5)
            ),
        })
    });
    let read = tr!(lang, "Measured, in brackets the closed formula: ");
    add(&format!("{read}{}", readings.collect::<Vec<_>>().join(lang.semicolon())));
    lines
}

/// A figure with title, drawing, caption and text.
fn page(
    task: &Task,
    part: &str,
    items: Vec<FigureItem>,
    room: Rect,
    text: (Option<Label>, Vec<Label>),
    set: Set,
) -> Figure {
    laid_out(task, part, items, room, text, set).0
}

/// A figure with title, drawing, caption and text, and the displacement of all items.
fn laid_out(
    task: &Task,
    part: &str,
    mut items: Vec<FigureItem>,
    room: Rect,
    (caption, lines): (Option<Label>, Vec<Label>),
    Set { style, lang, whole }: Set,
) -> (Figure, Vec2) {
    let title = match lang {
        Lang::En => format!("{}: {part}", lang.of(&task.heading.title)),
        Lang::Zh => format!("{}：{part}", lang.of(&task.heading.title)),
    };
    let (small, large) = (style.small_mm, style.caption_mm * 1.15);
    let heading = Label::text(title.as_str()).in_fonts(&style.fonts);
    let wide = if whole { text::set(&heading).width_em * large } else { 0.0 };
    let text_mm = if lines.is_empty() { 0.0 } else { TEXT_MM };
    // Inside a document the margins are those of the document.
    let (margin, head) = if whole { (MARGIN_MM, 14.0) } else { (1.0, 1.0) };
    let width_mm = room.width_mm().max(wide).max(text_mm) + 2.0 * margin;
    let line = small * 1.5;
    let below = lines.len() as f64 * line
        + if caption.is_some() { 9.0 } else { 0.0 }
        + if whole { 4.0 } else { 0.0 };
    let height_mm = margin + below + room.height_mm() + head;
    let centre = room.centre();
    let shift = Vec2::new(width_mm / 2.0 - centre.x, margin + below - room.min.y);
    translate(&mut items, shift);
    let words_at = |class: &str, at: Point, label: Label, size_mm: f64, anchor: Anchor| {
        let label = label.in_fonts(&style.fonts);
        FigureItem::new(class, Shape::Label { at, label, size_mm, anchor, colour: Colour::BLACK })
    };
    if whole {
        items.push(words_at(
            "title",
            Point::new(width_mm / 2.0, height_mm - 10.0),
            heading,
            large,
            Anchor::Middle,
        ));
    }
    let mut y = margin + below - 4.0;
    if let Some(caption) = caption {
        items.push(
            words_at("mu_l", Point::new(width_mm / 2.0, y), caption, small, Anchor::Middle)
                .with_id("scale"),
        );
        y -= 9.0;
    }
    let left = (width_mm - text_mm) / 2.0;
    for (k, l) in lines.into_iter().enumerate() {
        items.push(
            words_at("step", Point::new(left, y), l, small, Anchor::Start)
                .with_id(format!("sentence-{}", k + 1)),
        );
        y -= line;
    }
    distinct(&mut items);
    let words = [title.clone(), title];
    (painted(style, lang, [width_mm, height_mm], words, items), shift)
}
