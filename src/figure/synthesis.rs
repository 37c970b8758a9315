//! Figures of a synthesis: the construction with numbered steps, the linkage in its wanted positions, wanted against real.

use super::extent::{Rect, bounds, translate};
use super::item::{Anchor, Colour, Dash, Figure, Item, PLACED, Shape, Stroke, tag};
use super::label::Label;
use super::place::{LabelRequest, Obstacles, place};
use super::plot::{Axis, Plot};
use super::style::Style;
use super::text;
use super::words::words;
use crate::construct::scale::choose;
use crate::diag::Faults;
use crate::digits::{inked, shortest, significant};
use crate::geom::{Point, Vec2};
use crate::paper::phrase::tr;
use crate::report::synthesis::{positions, traced};
use crate::scene::Lang;
use crate::synthesis::board::{Board, Stroke as Drawn, Weight};
use crate::synthesis::{Candidate, Task, construct};
use icu_segmenter::LineSegmenter;
use icu_segmenter::options::LineBreakOptions;

/// Room of a drawing (mm): an A4 sheet with its margins, and text below.
const ROOM_MM: [f64; 2] = [150.0, 120.0];
const MARGIN_MM: f64 = 10.0;
/// Construction lines go on for so much beyond what is marked.
const BEYOND_MM: f64 = 14.0;
/// Width of the text below.
const TEXT_MM: f64 = 165.0;
/// Widths of the three kinds of stroke: given strong, construction thin, result like a vector.
const THIN: Stroke = Stroke::new(0.13);

/// All figures of a candidate, each with the word that names its file.
///
/// # Errors
/// Drawing and formula disagree.
pub fn figures(task: &Task, candidate: &Candidate, style: &Style, lang: Lang) -> Result<Vec<(&'static str, Figure)>, Faults> {
    let mut out = Vec::new();
    if let Some(board) = to_scale(task, candidate)? {
        out.push(("construction", construction(task, candidate, &board, style, lang)));
    }
    out.push(("positions", in_positions(task, candidate, style, lang)));
    if !candidate.draft.deviation.is_empty() {
        out.push(("deviation", deviation(task, candidate, style, lang)));
    }
    Ok(out)
}

/// The construction to a round scale that fits the paper, or to the scale that the file asks for.
///
/// # Errors
/// Drawing and formula disagree.
pub fn to_scale(task: &Task, candidate: &Candidate) -> Result<Option<Board>, Faults> {
    if let Some(mu_l) = task.paper.mu_l {
        return construct(task, candidate, mu_l);
    }
    // A first drawing in millimetres tells how large it is.
    let Some(board) = construct(task, candidate, 1e-3)? else { return Ok(None) };
    let Some(window) = window(&board) else { return Ok(None) };
    construct(task, candidate, choose([window.width_mm() * 1e-3, window.height_mm() * 1e-3], ROOM_MM))
}

/// A picture for each step of a construction: later steps are not there yet.
pub fn growing(construction: &Figure) -> Vec<(String, Figure)> {
    let last = construction.items.iter().flat_map(Item::steps).max().unwrap_or(0);
    let at = |k: usize| {
        let mut figure = construction.clone();
        figure.items.retain(|item| item.steps().all(|step| step <= k));
        (format!("step-{:02}", k + 1), figure)
    };
    (0..=last).map(at).collect()
}

/// What is marked, and the lines of the linkage.
fn window(board: &Board) -> Option<Rect> {
    let marks = board.steps.iter().flat_map(|s| s.marks.iter().map(|m| m.1));
    let ends = board.steps.iter().flat_map(|s| &s.strokes).filter(|(_, w)| *w != Weight::Thin).flat_map(|(stroke, _)| match *stroke {
        Drawn::Line(p, q) => vec![p, q],
        Drawn::Circle(c, r) | Drawn::Arc(c, r, _) => vec![c - Vec2::new(r, r), c + Vec2::new(r, r)],
    });
    around(marks.chain(ends))
}

fn around(points: impl Iterator<Item = Point>) -> Option<Rect> {
    points.map(|p| Rect::new(p, p)).reduce(Rect::union)
}

/// The part of a chain of points within a window, in pieces.
fn clipped(points: &[Point], window: Rect) -> Vec<Vec<Point>> {
    let inside = |p: &Point| p.x >= window.min.x && p.x <= window.max.x && p.y >= window.min.y && p.y <= window.max.y;
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

/// A stroke as chains of points: fine enough that no corner shows.
fn chain(stroke: &Drawn) -> Vec<Point> {
    const STEPS: usize = 720;
    match *stroke {
        Drawn::Line(p, q) => (0..=STEPS).map(|k| p + (q - p) * (k as f64 / STEPS as f64)).collect(),
        Drawn::Arc(c, r, middle) => {
            let at = |k: usize| c + Vec2::from_angle(middle + ARC * (k as f64 / 20.0 - 1.0)) * r;
            (0..=40).map(at).collect()
        }
        Drawn::Circle(c, r) => (0..=STEPS).map(|k| c + Vec2::from_angle(std::f64::consts::TAU * k as f64 / STEPS as f64) * r).collect(),
    }
}

fn construction(task: &Task, candidate: &Candidate, board: &Board, style: &Style, lang: Lang) -> Figure {
    let window = window(board).unwrap_or(Rect::new(Point::ORIGIN, Point::ORIGIN)).grown(BEYOND_MM);
    let mut items = Vec::new();
    let mut wanted: Vec<(LabelRequest, usize)> = Vec::new();
    let label = |text: &str| Label::math(text).in_fonts(&style.fonts);
    for (k, step) in board.steps.iter().enumerate() {
        let stroke_of = |weight: Weight| match weight {
            Weight::Given => style.outline,
            Weight::Thin => THIN.coloured(Colour::grey(90)),
            Weight::Result => style.vector,
        };
        let class = format!("step-{k} construction");
        let mut numbered = false;
        for (stroke, weight) in &step.strokes {
            for points in clipped(&chain(stroke), window) {
                // The number of the step stands at its first stroke.
                if !numbered && points.len() > 4 {
                    let at = points.len() / 3;
                    let number = Label::text(format!("({})", k + 1)).in_fonts(&style.fonts);
                    wanted.push((
                        LabelRequest::along(number, style.small_mm * 0.8, points[at], points[at + points.len() / 6], 0.3).optional(true),
                        k,
                    ));
                    numbered = true;
                }
                let points = match stroke {
                    Drawn::Line(..) => [points.first(), points.last()].into_iter().flatten().copied().collect(),
                    Drawn::Circle(..) | Drawn::Arc(..) => points,
                };
                let shape = Shape::Polyline { points, closed: false, stroke: Some(stroke_of(*weight)), fill: None };
                items.push(Item::new(class.clone(), shape));
            }
        }
        for (name, at) in &step.marks {
            let shape = Shape::Circle { centre: *at, radius_mm: 0.55, stroke: None, fill: Some(Colour::BLACK) };
            items.push(Item::new(class.clone(), shape));
            wanted.push((LabelRequest::at_point(label(name), style.small_mm, *at, 0.9), k));
        }
    }
    let room = window.grown(6.0);
    let (requests, brought): (Vec<LabelRequest>, Vec<usize>) = wanted.into_iter().unzip();
    let placed = place(&requests, &Obstacles::of(&items), room);
    for ((request, at), k) in requests.iter().zip(&placed).zip(brought) {
        let mut labels = at.items(request, PLACED, style.thin);
        tag(&mut labels, &format!("step-{k}"));
        items.extend(labels);
    }
    let mut lines: Vec<Label> = Vec::new();
    for (k, step) in board.steps.iter().enumerate() {
        lines.extend(wrapped(&format!("({}) {}", k + 1, lang.of(&step.text)), style));
    }
    let readings = board.readings.iter().filter_map(|r| {
        let formula = candidate.number(&r.name)?.abs();
        Some(match r.angle {
            true => format!("{} = {}° ({}°)", r.name, significant(board.value(r).to_degrees(), 5), significant(formula.to_degrees(), 5)),
            false => format!(
                "{} = {} mm × μ = {} mm ({} mm)",
                r.name,
                significant(r.measured, 4),
                significant(board.value(r) * 1e3, 5),
                significant(formula * 1e3, 5)
            ),
        })
    });
    let read = tr(lang, "Measured, in brackets the closed formula: ", "图上量得（括号内为公式值）：");
    lines.extend(wrapped(&format!("{read}{}", readings.collect::<Vec<_>>().join("; ")), style));
    let scale = format!("\\mu_l = {}\\,\\text{{m/mm}}", inked(&shortest(board.mu_l)));
    let part = tr(lang, "construction", "作图");
    page(task, part, items, room, (Some(Label::math(scale)), lines), style, lang)
}

/// Lines of a sentence, where Unicode's rules allow a break.
fn wrapped(sentence: &str, style: &Style) -> Vec<Label> {
    let segmenter = LineSegmenter::new_for_non_complex_scripts(LineBreakOptions::default());
    let ends: Vec<usize> = segmenter.segment_str(sentence).collect();
    let wide = |s: &str| text::set(&Label::text(s).in_fonts(&style.fonts)).width_em * style.small_mm;
    let (mut out, mut here) = (Vec::new(), String::new());
    for piece in ends.windows(2).map(|w| &sentence[w[0]..w[1]]) {
        if !here.is_empty() && wide(format!("{here}{piece}").trim_end()) > TEXT_MM {
            out.push(std::mem::take(&mut here));
        }
        here.push_str(piece);
    }
    out.push(here);
    out.iter().map(|l| Label::text(l.trim_end()).in_fonts(&style.fonts)).collect()
}

/// A figure with title, drawing, caption and text.
fn page(
    task: &Task,
    part: &str,
    mut items: Vec<Item>,
    room: Rect,
    (caption, lines): (Option<Label>, Vec<Label>),
    style: &Style,
    lang: Lang,
) -> Figure {
    let title = match lang {
        Lang::En => format!("{}: {part}", lang.of(&task.heading.title)),
        Lang::Zh => format!("{}：{part}", lang.of(&task.heading.title)),
    };
    let (small, large) = (style.small_mm, style.caption_mm * 1.15);
    let heading = Label::text(title.as_str()).in_fonts(&style.fonts);
    let wide = text::set(&heading).width_em * large;
    let text_mm = if lines.is_empty() { 0.0 } else { TEXT_MM };
    let width_mm = room.width_mm().max(wide).max(text_mm) + 2.0 * MARGIN_MM;
    let line = small * 1.5;
    let below = lines.len() as f64 * line + if caption.is_some() { 9.0 } else { 0.0 } + 4.0;
    let height_mm = MARGIN_MM + below + room.height_mm() + 14.0;
    let centre = room.centre();
    translate(&mut items, Vec2::new(width_mm / 2.0 - centre.x, MARGIN_MM + below - room.min.y));
    let words_at = |class: &str, at: Point, label: Label, size_mm: f64, anchor: Anchor| {
        let label = label.in_fonts(&style.fonts);
        Item::new(class, Shape::Label { at, label, size_mm, anchor, colour: Colour::BLACK })
    };
    items.push(words_at("title", Point::new(width_mm / 2.0, height_mm - 10.0), heading, large, Anchor::Middle));
    let mut y = MARGIN_MM + below - 4.0;
    if let Some(caption) = caption {
        items.push(words_at("mu_l", Point::new(width_mm / 2.0, y), caption, small, Anchor::Middle));
        y -= 9.0;
    }
    let left = (width_mm - text_mm) / 2.0;
    for l in lines {
        items.push(words_at("step", Point::new(left, y), l, small, Anchor::Start));
        y -= line;
    }
    for (k, item) in items.iter_mut().enumerate() {
        item.id = format!("synthesis-{k}");
    }
    let mut figure = Figure { width_mm, height_mm, desc: title.clone(), title, lang: words(lang).tag.into(), paper: Colour::WHITE, items };
    style.palette.paint(&mut figure);
    figure
}

/// The linkage in all wanted positions, the first in full ink, and the path of E against its places.
fn in_positions(task: &Task, candidate: &Candidate, style: &Style, lang: Lang) -> Figure {
    let all = positions(candidate);
    let path = traced(candidate, "E");
    let points = all.iter().flat_map(|p| p.links.iter().flat_map(|l| l.1.iter().map(|x| x.1)));
    let extent = around(points.chain(path.iter().flatten().copied()).chain(candidate.draft.targets.iter().copied()));
    let extent = extent.unwrap_or(Rect::new(Point::ORIGIN, Point::new(1.0, 1.0)));
    let mu = choose([extent.width_mm(), extent.height_mm()], ROOM_MM);
    let at = |p: Point| (p.to_vec2() * (1.0 / mu)).to_point();
    let mut items = Vec::new();
    let mut wanted = Vec::new();
    for piece in path.iter().filter(|p| p.len() > 2) {
        let points = piece.iter().map(|p| at(*p)).collect();
        let shape = Shape::Polyline { points, closed: false, stroke: Some(style.thin.dashed(Dash::DashDot)), fill: None };
        items.push(Item::new("path", shape));
    }
    for (k, p) in all.iter().enumerate().rev() {
        let stroke = if k == 0 { style.link } else { style.thin };
        for (link, points) in &p.links {
            let places: Vec<Point> = points.iter().map(|x| at(x.1)).collect();
            let closed = places.len() > 2;
            let shape = Shape::Polyline { points: places, closed, stroke: Some(stroke), fill: None };
            items.push(Item { link: Some(*link), ..Item::new(format!("position-{k}"), shape) });
        }
        for (name, x) in p.links.iter().flat_map(|l| &l.1) {
            if k == 0 && !p.fixed.iter().any(|f| f.0 == *name) {
                items.extend(super::symbols::pin(style, at(*x)));
            }
        }
        let mut named: Vec<&(String, Point)> =
            p.links.iter().flat_map(|l| &l.1).filter(|(n, _)| !p.fixed.iter().any(|f| f.0 == *n)).collect();
        named.dedup_by(|a, b| a.0 == b.0);
        for (name, x) in named {
            let seen = format!("{name}_{}", k + 1);
            let request =
                LabelRequest::at_point(Label::math(seen).in_fonts(&style.fonts), style.small_mm * 0.9, at(*x), 1.4).optional(k > 0);
            if !wanted.contains(&request) {
                wanted.push(request);
            }
        }
    }
    for (name, x) in all.first().into_iter().flat_map(|p| &p.fixed) {
        items.extend(super::symbols::fixed_pivot(style, at(*x), Vec2::new(0.0, -1.0)));
        wanted.push(LabelRequest::at_point(Label::math(name.as_str()).in_fonts(&style.fonts), style.label_mm, at(*x), 2.2));
    }
    for target in &candidate.draft.targets {
        items.push(Item::new("target", Shape::Circle { centre: at(*target), radius_mm: 0.8, stroke: Some(style.outline), fill: None }));
    }
    let room = bounds(&items).unwrap_or(Rect::new(Point::ORIGIN, Point::ORIGIN)).grown(8.0);
    let placed = place(&wanted, &Obstacles::of(&items), room);
    for (request, at) in wanted.iter().zip(&placed) {
        items.extend(at.items(request, PLACED, style.thin));
    }
    let scale = format!("\\mu_l = {}\\,\\text{{m/mm}}", inked(&shortest(mu)));
    let part = tr(lang, "the wanted positions", "各预定位置");
    page(task, part, items, room, (Some(Label::math(scale)), Vec::new()), style, lang)
}

/// The deviation of the output over the function's range, its extremes marked.
fn deviation(task: &Task, candidate: &Candidate, style: &Style, lang: Lang) -> Figure {
    let data: Vec<[f64; 2]> = candidate.draft.deviation.iter().map(|[x, e]| [*x, e.to_degrees()]).collect();
    let (xs, ys): (Vec<f64>, Vec<f64>) = data.iter().map(|p| (p[0], p[1])).unzip();
    let frame = Rect::new(Point::ORIGIN, Point::new(ROOM_MM[0], 80.0));
    let axes = [Axis::of(&xs, false, 10), Axis::of(&ys, false, 8)];
    let mut plot = Plot::new("deviation".to_owned(), style, frame, axes);
    plot.axes(Some(Label::math("x").in_fonts(&style.fonts)), Label::math("\\Delta\\psi\\,/\\degree"));
    let points = data.iter().map(|p| plot.at(p[0], p[1])).collect();
    plot.draw("curve", Shape::Polyline { points, closed: false, stroke: Some(style.vector), fill: None }, None);
    for k in 0.. {
        let (Some(x), Some(e)) = (candidate.number(&format!("x_{k}")), candidate.number(&format!("error_{k}"))) else { break };
        let at = plot.at(x, e.to_degrees());
        plot.draw("extreme", Shape::Circle { centre: at, radius_mm: 0.7, stroke: None, fill: Some(Colour::BLACK) }, None);
        let text = format!("{}\\degree", inked(&significant(e.to_degrees(), 3)));
        plot.label(LabelRequest::at_point(Label::math(text), style.small_mm, at, 1.0), None);
    }
    let room = frame.grown(16.0);
    let items = plot.finish(room);
    page(task, tr(lang, "structural error", "结构误差"), items, room, (None, Vec::new()), style, lang)
}
