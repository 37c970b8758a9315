//! Draws the linkage in its prescribed positions with the path of its point, and the structural
//! error of a function.

use super::{ROOM_MM, Set, around, laid_out, page, scale_of};
use crate::plot::{Plot, PlotAxis};
use hodograph_base::digits::{inked, significant};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::tr;
use hodograph_board::construct::scale::choose;
use hodograph_paper::paper::extent::{Rect, bounds};
use hodograph_paper::paper::item::{Anchor, Colour, Dash, Figure, FigureItem, PLACED, Shape, tag};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::{LabelRequest, Obstacles, place};
use hodograph_paper::paper::style::Style;
use hodograph_paper::paper::symbols as sym;
use hodograph_report::synthesis::{LinkagePosition, positions, traced};
use hodograph_synthesis::{Compared, DesignCandidate, Task};

/// Draws the linkage in all prescribed positions, the first one in full ink, and the path of E with
/// its target points.
pub fn linkage(task: &Task, candidate: &DesignCandidate, set: Set) -> Figure {
    scaled(task, candidate, set).figure
}

/// Length of a sample of a curve in the diagram of a function (mm).
const SAMPLE_MM: f64 = 12.0;

/// The class of items that belong to the first position only, and would move in an animation.
pub const MOVES: &str = "moves";

/// The figure of the linkage, with the map from the plane to its paper.
pub struct Scaled {
    /// The figure.
    pub figure: Figure,
    /// Metres per millimetre of paper.
    pub mu_l: f64,
    shift: Vec2,
}

impl Scaled {
    /// Returns the position of a point (m) on the paper (mm, y up).
    pub fn place(&self, at: Point) -> Point {
        (at.to_vec2() * (1.0 / self.mu_l)).to_point() + self.shift
    }
}

/// Draws the linkage in all prescribed positions; returns it with its scale and its position on the
/// paper.
pub fn scaled(task: &Task, candidate: &DesignCandidate, set: Set) -> Scaled {
    let Set { style, lang, .. } = set;
    let all = positions(candidate);
    let path = traced(candidate, "E");
    let points = all.iter().flat_map(|p| p.links.iter().flat_map(|l| l.1.iter().map(|x| x.1)));
    let extent = around(
        points.chain(path.iter().flatten().copied()).chain(candidate.draft.targets.iter().copied()),
    );
    let extent = extent.unwrap_or(Rect::new(Point::ORIGIN, Point::new(1.0, 1.0)));
    let mu = choose([extent.width_mm(), extent.height_mm()], ROOM_MM);
    let at = |p: Point| (p.to_vec2() * (1.0 / mu)).to_point();
    let mut items = Vec::new();
    let mut wanted = Vec::new();
    for piece in path.iter().filter(|p| p.len() > 2) {
        let points = piece.iter().map(|p| at(*p)).collect();
        let shape = Shape::Polyline {
            points,
            closed: false,
            stroke: Some(style.thin.dashed(Dash::DashDot)),
            fill: None,
        };
        items.push(FigureItem::new("path", shape));
    }
    for (k, p) in all.iter().enumerate().rev() {
        let stroke = if k == 0 { style.link } else { style.thin };
        for (link, points) in &p.links {
            let places: Vec<Point> = points.iter().map(|x| at(x.1)).collect();
            let closed = places.len() > 2;
            let shape =
                Shape::Polyline { points: places, closed, stroke: Some(stroke), fill: None };
            let moves = if k == 0 { MOVES } else { "" };
            items.push(FigureItem {
                link: Some(*link),
                ..FigureItem::new(format!("position-{k} {moves}").trim_end(), shape)
            });
        }
        for (name, x) in p.links.iter().flat_map(|l| &l.1) {
            if k == 0 && !p.fixed.iter().any(|f| f.0 == *name) {
                let mut pin = sym::pin(style, at(*x));
                tag(&mut pin, MOVES);
                items.extend(pin);
            }
        }
        let mut named: Vec<&(String, Point)> = p
            .links
            .iter()
            .flat_map(|l| &l.1)
            .filter(|(n, _)| !p.fixed.iter().any(|f| f.0 == *n))
            .collect();
        named.dedup_by(|a, b| a.0 == b.0);
        for (name, x) in named {
            let seen = format!("{name}_{}", k + 1);
            let request = LabelRequest::at_point(
                Label::math(seen).in_fonts(&style.fonts),
                style.small_mm * 0.9,
                at(*x),
                1.4,
            )
            .optional(k > 0);
            if !wanted.contains(&request) {
                wanted.push(request);
            }
        }
    }
    items.extend(sliders(&all, &at, style));
    for (name, x) in all.first().into_iter().flat_map(|p| &p.fixed) {
        items.extend(sym::fixed_pivot(style, at(*x), Vec2::new(0.0, -1.0)));
        wanted.push(LabelRequest::at_point(
            Label::math(name.as_str()).in_fonts(&style.fonts),
            style.label_mm,
            at(*x),
            2.2,
        ));
    }
    for target in &candidate.draft.targets {
        items.push(FigureItem::new(
            "target",
            Shape::Circle {
                centre: at(*target),
                radius_mm: 0.8,
                stroke: Some(style.outline),
                fill: None,
            },
        ));
    }
    let room = bounds(&items).unwrap_or(Rect::new(Point::ORIGIN, Point::ORIGIN)).grown(8.0);
    let placed = place(&wanted, &Obstacles::of(&items), room);
    for (request, at) in wanted.iter().zip(&placed) {
        items.extend(at.items(request, PLACED, style.thin));
    }
    let part = tr!(lang, "the wanted positions");
    let (figure, shift) = laid_out(task, part, items, room, (Some(scale_of(mu)), Vec::new()), set);
    Scaled { figure, mu_l: mu, shift }
}

/// Draws the deviation of the output over the range of the function, with its extremes marked;
/// `None` if the task is no function.
pub fn deviation(task: &Task, candidate: &DesignCandidate, set: Set) -> Option<Figure> {
    let Set { style, lang, .. } = set;
    let data: Vec<[f64; 2]> =
        candidate.draft.course.iter().map(|c| [c.x, c.deviation().to_degrees()]).collect();
    if data.is_empty() {
        return None;
    }
    let (xs, ys): (Vec<f64>, Vec<f64>) = data.iter().map(|p| (p[0], p[1])).unzip();
    let frame = Rect::new(Point::ORIGIN, Point::new(ROOM_MM[0], 80.0));
    let axes = [PlotAxis::of(&xs, false, 10), PlotAxis::of(&ys, false, 8)];
    let mut plot = Plot::new("deviation".to_owned(), style, frame, axes);
    plot.axes(
        Some(Label::math("x").in_fonts(&style.fonts)),
        Label::math("\\Delta\\varphi/(\\degree)"),
    );
    let points = data.iter().map(|p| plot.at(p[0], p[1])).collect();
    plot.draw(
        "curve",
        Shape::Polyline { points, closed: false, stroke: Some(style.vector), fill: None },
        None,
    );
    for k in 0.. {
        let (Some(x), Some(e)) =
            (candidate.number(&format!("x_{k}")), candidate.number(&format!("error_{k}")))
        else {
            break;
        };
        let at = plot.at(x, e.to_degrees());
        plot.draw(
            "extreme",
            Shape::Circle { centre: at, radius_mm: 0.7, stroke: None, fill: Some(Colour::BLACK) },
            None,
        );
        let text = format!("{}\\degree", inked(&significant(e.to_degrees(), 3)));
        plot.label(LabelRequest::at_point(Label::math(text), style.small_mm, at, 1.0), None);
    }
    let room = frame.grown(16.0);
    let items = plot.finish(room);
    Some(page(task, tr!(lang, "structural error"), items, room, (None, Vec::new()), set))
}

/// Draws the wanted and the actual output angle over the range of a function, with its precision
/// points; `None` if the task is no function.
pub fn generated(task: &Task, candidate: &DesignCandidate, set: Set) -> Option<Figure> {
    let Set { style, lang, .. } = set;
    let course = &candidate.draft.course;
    if course.is_empty() {
        return None;
    }
    let xs: Vec<f64> = course.iter().map(|c| c.x).collect();
    let angles: Vec<f64> =
        course.iter().flat_map(|c| [c.wanted, c.real]).map(f64::to_degrees).collect();
    let frame = Rect::new(Point::ORIGIN, Point::new(ROOM_MM[0], 100.0));
    let axes = [PlotAxis::of(&xs, false, 10), PlotAxis::of(&angles, true, 8)];
    let mut plot = Plot::new("function".to_owned(), style, frame, axes);
    plot.axes(
        Some(Label::math("x").in_fonts(&style.fonts)),
        Label::math("(\\varphi_0 + \\varphi)/(\\degree)"),
    );
    let words = [tr!(lang, "generated function"), tr!(lang, "wanted function")];
    let strokes = [style.thin, style.vector.dashed(Dash::Dashed)];
    for (k, (stroke, word)) in strokes.into_iter().zip(words).enumerate() {
        let value = |c: &Compared| if k == 0 { c.real } else { c.wanted };
        let points = course.iter().map(|c| plot.at(c.x, value(c).to_degrees())).collect();
        let curve = Shape::Polyline { points, closed: false, stroke: Some(stroke), fill: None };
        plot.draw("curve", curve, None);
        // The samples are in the corner that a rising or a falling curve leaves free.
        let rises = course.last().map(|c| c.wanted) > course.first().map(|c| c.wanted);
        let x = if rises { SAMPLE_MM } else { frame.max.x - 60.0 };
        let from = Point::new(x, frame.max.y - 8.0 - 6.0 * k as f64);
        plot.line("sample", from, from + Vec2::new(SAMPLE_MM, 0.0), stroke);
        let at = from + Vec2::new(SAMPLE_MM + 2.0, -0.33 * style.small_mm);
        let label = Label::text(word).in_fonts(&style.fonts);
        plot.words("sample-name", at, label, style.small_mm, Anchor::Start);
    }
    for wanted in &candidate.draft.wanted {
        // Between the places of the table the curve is as good as straight.
        let part = |w: &[Compared]| (wanted.driver - w[0].input) / (w[1].input - w[0].input);
        let within = |w: &&[Compared]| (-1e-9..=1.0 + 1e-9).contains(&part(w));
        let Some(w) = course.windows(2).find(within) else { continue };
        let at = |of: fn(&Compared) -> f64| of(&w[0]) + part(w) * (of(&w[1]) - of(&w[0]));
        let centre = plot.at(at(|c| c.x), at(|c| c.wanted).to_degrees());
        let dot = Shape::Circle {
            centre,
            radius_mm: style.dot_radius_mm,
            stroke: Some(style.thin),
            fill: Some(Colour::WHITE),
        };
        plot.draw("precision-point", dot, None);
    }
    let room = frame.grown(16.0);
    let items = plot.finish(room);
    let part = tr!(lang, "wanted and generated function");
    Some(page(task, part, items, room, (None, Vec::new()), set))
}

/// Blocks of the first position, with fixed guides under all their positions.
fn sliders(all: &[LinkagePosition], at: &dyn Fn(Point) -> Point, style: &Style) -> Vec<FigureItem> {
    let mut items = Vec::new();
    for (k, slider) in all.first().into_iter().flat_map(|p| &p.sliders).enumerate() {
        let (place, way) = (at(slider.at), slider.direction);
        if slider.fixed {
            let far: Vec<f64> = all
                .iter()
                .filter_map(|p| p.sliders.get(k))
                .map(|s| way.dot(at(s.at) - place))
                .collect();
            let low = far.iter().copied().fold(0.0, f64::min);
            let high = far.iter().copied().fold(0.0, f64::max);
            let length = high - low + 3.0 * style.block_length_mm;
            // Hatched below, like the ground.
            let along = if way.x < 0.0 { -way } else { way };
            items.extend(sym::guide(
                style,
                place + way * ((low + high) / 2.0),
                along.angle(),
                length,
                sym::GuideForm::OneSided,
            ));
        }
        let mut block = sym::block(style, place, way.angle(), !slider.fixed);
        block.extend(sym::pin(style, place));
        tag(&mut block, MOVES);
        items.extend(block);
    }
    items
}
