//! Line diagrams: the results of a sweep against the position of the driver. There is one panel for
//! each kind of quantity; all are one above the other with a common axis below and their extremes
//! marked.
//!
//! This module places panels, names and marks. [`diagram`] selects the content,
//! [`plot`](super::plot) draws a plot.

mod diagram;
mod polar;

pub use diagram::{CurveDiagram, CurveLegend, DiagramCurve, Panel};
pub use polar::polar;

use super::plot::{Plot, PlotAxis, over};
use crate::sheet::painted;
use diagram::DEGREE;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::{say, tr};
use hodograph_paper::paper::extent::Rect;
use hodograph_paper::paper::item::{Anchor, Colour, Dash, Figure, FigureItem, LineStroke, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::phrase::formula;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::style::Style;
use hodograph_report::amount::number;
use hodograph_scene::{Lang, Scene};

/// Size of a panel's plot (mm).
const PLOT_MM: [f64; 2] = [150.0, 62.0];
/// Space for the numbers of the vertical axis, and for names on the right of the plot.
const LEFT_MM: f64 = 30.0;
const RIGHT_MM: f64 = 24.0;
/// Space between panels, above the first and below the last.
const BETWEEN_MM: f64 = 12.0;
const ABOVE_MM: f64 = 18.0;
const BELOW_MM: f64 = 18.0;
/// Dash patterns that distinguish the lines of one panel without colour.
const DASHES: [Dash; 4] = [Dash::Solid, Dash::Dashed, Dash::DashDot, Dash::Dotted];
/// Zero is near a panel's values if its distance from them is less than this part of their range.
const ZERO_NEAR: f64 = 0.5;
/// Extremes closer than this are one point of the diagram (mm).
const SAME_MM: f64 = 0.3;
/// Digits of the extremes: more than a diagram can be read to, fewer than a sweep in `f64` has.
const DIGITS: usize = 4;

/// A4 portrait, and the number of panels on it.
const A4_MM: [f64; 2] = [210.0, 297.0];
const ON_A4: usize = 3;

/// Distance between the lines of the legend, and the length of its samples (mm).
const LEGEND_MM: f64 = 5.5;
const SAMPLE_MM: f64 = 14.0;

/// Draws a diagram as one figure, all panels one above the other.
pub fn figure(scene: &Scene, diagram: &CurveDiagram, style: &Style, lang: Lang) -> Figure {
    let n = diagram.panels.len().max(1) as f64;
    let size_mm = [
        LEFT_MM + PLOT_MM[0] + RIGHT_MM,
        above_mm(diagram) + n * PLOT_MM[1] + (n - 1.0) * BETWEEN_MM + BELOW_MM,
    ];
    page(scene, diagram, &diagram.panels, size_mm, style, lang)
}

/// Returns the space above the first panel (mm): that of title and legend.
fn above_mm(diagram: &CurveDiagram) -> f64 {
    let lines = diagram.legend.as_ref().map_or(0, |l| l.names.len());
    let gap = if lines > 0 { LEGEND_MM / 2.0 } else { 0.0 };
    ABOVE_MM + lines as f64 * LEGEND_MM + gap
}

/// Draws a diagram as pages of A4, as many panels on each as have space: three without a legend.
pub fn pages(scene: &Scene, diagram: &CurveDiagram, style: &Style, lang: Lang) -> Vec<Figure> {
    let free = A4_MM[1] - above_mm(diagram) - BELOW_MM + BETWEEN_MM;
    let on_page = (libm::floor(free / (PLOT_MM[1] + BETWEEN_MM)) as usize).clamp(1, ON_A4);
    diagram
        .panels
        .chunks(on_page)
        .map(|panels| page(scene, diagram, panels, A4_MM, style, lang))
        .collect()
}

/// Draws some panels of a diagram one above the other, below a title.
fn page(
    scene: &Scene,
    diagram: &CurveDiagram,
    panels: &[Panel],
    [width_mm, height_mm]: [f64; 2],
    style: &Style,
    lang: Lang,
) -> Figure {
    let left_mm = LEFT_MM + (width_mm - LEFT_MM - PLOT_MM[0] - RIGHT_MM) / 2.0;
    let x = PlotAxis::of(&diagram.places, diagram.driver[1] == DEGREE, 12);
    let heading = match (&diagram.legend, lang.of(&scene.title)) {
        (Some(legend), _) => legend.heading.clone(),
        (None, "") => tr!(lang, "Motion").to_owned(),
        (None, title) => title.to_owned(),
    };
    let mut items = Vec::new();
    let title = Shape::Label {
        at: Point::new(width_mm / 2.0, height_mm - 10.0),
        label: Label::text(heading.as_str()).in_fonts(&style.fonts),
        size_mm: style.caption_mm * 4.0 / 3.0,
        anchor: Anchor::Middle,
        colour: Colour::BLACK,
    };
    items.push(FigureItem::new("title", title));
    let names = diagram.legend.iter().flat_map(|l| &l.names).enumerate();
    for (k, name) in names {
        let y = height_mm - ABOVE_MM - k as f64 * LEGEND_MM;
        items.extend(legend_line(Point::new(left_mm, y), k, name, style));
    }
    let mut said = Vec::new();
    for (k, panel) in panels.iter().enumerate() {
        let top = height_mm - above_mm(diagram) - k as f64 * (PLOT_MM[1] + BETWEEN_MM);
        let frame =
            Rect::new(Point::new(left_mm, top - PLOT_MM[1]), Point::new(left_mm + PLOT_MM[0], top));
        let mut values: Vec<f64> = panel
            .curves
            .iter()
            .flat_map(|c| c.values.iter().copied())
            .filter(|v| v.is_finite())
            .collect();
        let (lo, hi) = values
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), v| (lo.min(*v), hi.max(*v)));
        // Zero is included if it is near: it shows the changes of sign. A distant zero would
        // flatten the lines.
        if lo.max(-hi) < ZERO_NEAR * (hi - lo) {
            values.push(0.0);
        }
        let y = PlotAxis::of(&values, panel.unit == DEGREE, 6);
        let mut plot = Plot::new(format!("panel-{k}"), style, frame, [x.clone(), y]);
        let last = k + 1 == panels.len();
        let [driver, unit] = &diagram.driver;
        plot.axes(
            last.then(|| Label::math(over(driver, unit))),
            Label::math(over(&panel.quantity(), &panel.unit)),
        );
        curves(&mut plot, panel, diagram, &mut said);
        items.extend(plot.finish(Rect::new(
            frame.min - Vec2::new(0.0, 1.0),
            frame.max + Vec2::new(RIGHT_MM, BETWEEN_MM / 2.0),
        )));
    }
    let desc = say!(
        lang,
        "Diagrams against {}. {}.",
        formula(&diagram.driver[0]),
        said.join(lang.semicolon())
    );
    painted(style, lang, [width_mm, height_mm], [heading, desc], items)
}

/// Returns the stroke of the k-th curve of a panel; lines beyond the available dash patterns are
/// thin.
fn stroke(k: usize, style: &Style) -> LineStroke {
    let line = if k < DASHES.len() { style.vector } else { style.thin };
    line.dashed(DASHES[k % DASHES.len()])
}

/// Returns a line of the legend: a sample of the k-th curve, and its name.
fn legend_line(at: Point, k: usize, name: &str, style: &Style) -> [FigureItem; 2] {
    let (middle, size_mm) = (Vec2::new(0.0, 0.33 * style.caption_mm), style.caption_mm);
    let to = at + Vec2::new(SAMPLE_MM, 0.0);
    let sample = Shape::Line { from: at + middle, to: to + middle, stroke: stroke(k, style) };
    let words = Shape::Label {
        at: to + Vec2::new(3.0, 0.0),
        label: Label::text(name).in_fonts(&style.fonts),
        size_mm,
        anchor: Anchor::Start,
        colour: Colour::BLACK,
    };
    [("legend-line", sample), ("legend-name", words)].map(|(class, shape)| FigureItem {
        link: Some(k),
        ..FigureItem::new(class, shape).with_id(format!("{class}-{k}"))
    })
}

/// Draws lines with their names, and their extremes with their values.
fn curves(plot: &mut Plot, panel: &Panel, diagram: &CurveDiagram, said: &mut Vec<String>) {
    let (style, places) = (plot.style, &diagram.places);
    // A value that several curves share at one point is written once.
    let mut marked: Vec<(Point, String)> = Vec::new();
    for (k, curve) in panel.curves.iter().enumerate() {
        let stroke = stroke(k, style);
        let known: Vec<(f64, f64)> = places
            .iter()
            .copied()
            .zip(curve.values.iter().copied())
            .filter(|(_, v)| v.is_finite())
            .collect();
        let usual = known.windows(2).map(|w| w[1].0 - w[0].0).fold(f64::INFINITY, f64::min);
        let apart = |w: &(f64, f64), v: &(f64, f64)| v.0 - w.0 <= 1.5 * usual;
        for run in known.chunk_by(apart).filter(|r| r.len() > 1) {
            let points: Vec<Point> = run.iter().map(|(x, y)| plot.at(*x, *y)).collect();
            let shape = Shape::Polyline { points, closed: false, stroke: Some(stroke), fill: None };
            plot.draw("curve", shape, curve.link);
        }
        let texts: Vec<String> = curve
            .extremes
            .iter()
            .map(|(x, y)| {
                format!(
                    "{} = {}\\,{} ({}\\,{})",
                    curve.symbol,
                    number(*y, DIGITS),
                    panel.unit,
                    number(*x, DIGITS),
                    diagram.driver[1]
                )
            })
            .collect();
        said.extend(texts.iter().map(|t| Label::math(t.as_str()).plain()));
        for &(x, y) in &curve.extremes {
            let at = plot.at(x, y);
            let (value, near) = (number(y, DIGITS), |(p, text): &(Point, String)| {
                p.distance(at) < SAME_MM && *text == number(y, DIGITS)
            });
            if marked.iter().any(near) {
                continue;
            }
            marked.push((at, value.clone()));
            let dot = Shape::Circle {
                centre: at,
                radius_mm: style.dot_radius_mm,
                stroke: None,
                fill: Some(Colour::BLACK),
            };
            plot.draw("extreme", dot, curve.link);
            let label = Label::math(value);
            let request = LabelRequest::at_point(label, style.small_mm, at, style.dot_radius_mm);
            plot.label(request, curve.link);
        }
        for &[from, to] in &curve.zeros {
            said.push(zero_words(curve, [from, to], &diagram.driver[1]));
            let at = plot.at(0.5 * (from + to), 0.0);
            if from != to || marked.iter().any(|(p, _)| p.distance(at) < SAME_MM) {
                continue;
            }
            let ring = Shape::Circle {
                centre: at,
                radius_mm: style.dot_radius_mm,
                stroke: Some(style.thin),
                fill: Some(Colour::WHITE),
            };
            plot.draw("zero", ring, curve.link);
            let place = place_words(from, &diagram.driver[1]);
            marked.push((at, place.clone()));
            let radius_mm = style.dot_radius_mm;
            let request = LabelRequest::at_point(Label::math(place), style.small_mm, at, radius_mm);
            plot.label(request.optional(true), curve.link);
        }
        // The name is beside the line's highest lobe, where it is read first.
        let Some(&(x, y)) =
            known.get(known.len() / 5 + (k * known.len() / 7) % known.len().max(1) / 2)
        else {
            continue;
        };
        plot.label(
            LabelRequest::at_point(
                Label::math(curve.symbol.as_str()),
                style.label_mm,
                plot.at(x, y),
                0.4,
            ),
            curve.link,
        );
    }
}

/// Returns a zero in words: `v_C = 0 (90 °)`; a stretch has both its ends.
fn zero_words(curve: &DiagramCurve, [from, to]: [f64; 2], unit: &str) -> String {
    let [from, to] = [from, to].map(|x| place_words(x, unit));
    let place = if from == to { from } else { format!("{from} … {to}") };
    Label::math(format!("{} = 0 ({place})", curve.symbol)).plain()
}

/// Returns a place of the driver with its unit, in the label language.
fn place_words(x: f64, unit: &str) -> String {
    let gap = if unit == DEGREE { "" } else { "\\," };
    format!("{}{gap}{unit}", number(x, DIGITS))
}
