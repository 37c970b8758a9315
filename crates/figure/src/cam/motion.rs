//! Plots s, v and a of the follower over a turn of the cam, one above the other, with stages
//! separated, jumps dashed and shocks marked.

use super::super::plot::{Plot, PlotAxis, over};
use super::{heading, words_at};
use crate::sheet::painted;
use hodograph_base::cam::{Follower, PieceSide, Shock, in_turn, round};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::{say, tr};
use hodograph_paper::paper::drawing::DrawingPart;
use hodograph_paper::paper::extent::Rect;
use hodograph_paper::paper::item::{Anchor, Colour, Dash, Figure, FigureItem, Shape, tag};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::style::Style;
use hodograph_paper::paper::text;
use hodograph_report::amount::number;
use hodograph_report::cam::{Report, dwell};
use hodograph_scene::{Book, Kind, Lang};

/// Size of a plot and the space around it (mm).
const PLOT_MM: [f64; 2] = [160.0, 58.0];
const LEFT_MM: f64 = 28.0;
const RIGHT_MM: f64 = 10.0;
const BETWEEN_MM: f64 = 13.0;
const ABOVE_MM: f64 = 26.0;
const BELOW_MM: f64 = 20.0;
/// Steps of a line over a turn: one for each half degree.
const STEPS: usize = 720;
/// Significant digits of the extremes.
const DIGITS: usize = 4;

/// One plot: the order of the derivative, its symbol and unit, and the factor that converts to this
/// unit.
struct DerivativePlot {
    order: usize,
    symbol: &'static str,
    unit: String,
    factor: f64,
}

/// Draws the diagrams.
pub fn figure(report: &Report, style: &Style, lang: Lang) -> Figure {
    let height_mm = ABOVE_MM + 3.0 * PLOT_MM[1] + 2.0 * BETWEEN_MM + BELOW_MM;
    let title = heading(report.scene, tr!(lang, "motion of the follower"), lang);
    // A long title widens the paper.
    let title_mm = text::set(&Label::text(title.as_str()).in_fonts(&style.fonts)).width_em
        * style.caption_mm
        * 4.0
        / 3.0
        + 2.0 * RIGHT_MM;
    let width_mm = (LEFT_MM + PLOT_MM[0] + RIGHT_MM).max(title_mm);
    let left = LEFT_MM + (width_mm - LEFT_MM - PLOT_MM[0] - RIGHT_MM) / 2.0;
    let mut items = vec![words_at(
        "title",
        Point::new(width_mm / 2.0, height_mm - 9.0),
        Label::text(title.as_str()),
        style.caption_mm * 4.0 / 3.0,
        Anchor::Middle,
        style,
    )];
    let mut said = Vec::new();
    for (k, kept) in panels(report).iter().enumerate() {
        let top = height_mm - ABOVE_MM - k as f64 * (PLOT_MM[1] + BETWEEN_MM);
        let frame =
            Rect::new(Point::new(left, top - PLOT_MM[1]), Point::new(left + PLOT_MM[0], top));
        let marked = [k == 2, k == 0];
        items.extend(panel(report, style, lang, (kept, marked), (frame, 12), &mut said));
    }
    let desc = say!(
        lang,
        "Displacement, velocity and acceleration of the follower over a turn of the cam. {}.",
        said.join(lang.semicolon())
    );
    painted(style, lang, [width_mm, height_mm], [title, desc], items)
}

/// Size of a diagram that is shown alone (mm).
const ALONE_MM: [f64; 2] = [92.0, 50.0];

/// The diagrams, each as a drawing of its own in a step of its own from `first` on.
pub(super) fn stepped(
    report: &Report,
    style: &Style,
    lang: Lang,
    first: usize,
) -> [DrawingPart; 3] {
    let panels = panels(report);
    [0, 1, 2].map(|k| {
        let frame = Rect::new(Point::ORIGIN, Point::ORIGIN + Vec2::new(ALONE_MM[0], ALONE_MM[1]));
        let mut items =
            panel(report, style, lang, (&panels[k], [true, k == 0]), (frame, 6), &mut Vec::new());
        tag(&mut items, &format!("step-{}", first + k));
        DrawingPart::of(items)
    })
}

/// One of the diagrams in its frame, with at most so many intervals of angles; with the symbol of
/// the angle and with the stages if the flags are set.
fn panel(
    report: &Report,
    style: &Style,
    lang: Lang,
    (kept, [named, staged]): (&DerivativePlot, [bool; 2]),
    (frame, intervals): (Rect, usize),
    said: &mut Vec<String>,
) -> Vec<FigureItem> {
    let x = PlotAxis::of(&[0.0, 360.0], true, intervals);
    let mut plot = Plot::new(format!("cam-{}", kept.symbol), style, frame, [x, axis(report, kept)]);
    let below = named.then(|| Label::math(over("\\varphi", "\\degree")));
    plot.axes(below, Label::math(over(kept.symbol, &kept.unit)));
    if staged {
        stages(&mut plot, report, lang);
    }
    line(&mut plot, report, kept);
    shocks(&mut plot, report, kept, lang, said);
    extremes(&mut plot, report, kept, said);
    let bounds =
        Rect::new(frame.min - Vec2::new(0.0, 1.0), frame.max + Vec2::new(0.0, BETWEEN_MM / 2.0));
    plot.finish(bounds)
}

/// The three plots; s′ and s″ if the cam has no angular velocity.
fn panels(report: &Report) -> [DerivativePlot; 3] {
    let swings = matches!(report.turning.disc.follower, Follower::Oscillating { .. });
    let book: &Book = &report.scene.book;
    let omega = report.omega();
    let one = |kind: Kind| (format!("\\text{{{}}}", book.name(kind)), book.value(kind, 1.0));
    let lift = if swings {
        ("\\degree".to_owned(), 180.0 / std::f64::consts::PI)
    } else {
        match book.chosen(Kind::Length) {
            Some(unit) => (format!("\\text{{{}}}", unit.name()), unit.of(1.0)),
            None => {
                let unit = report.scene.length_unit;
                (format!("\\text{{{}}}", unit.name), unit.denominator / unit.numerator)
            }
        }
    };
    let kinds =
        if swings { [Kind::Omega, Kind::Alpha] } else { [Kind::Velocity, Kind::Acceleration] };
    let [v, a] = kinds.map(one);
    let kept = |order, symbol, (unit, factor)| DerivativePlot { order, symbol, unit, factor };
    if omega == 0.0 {
        let per = |power: &str| (format!("{}/\\text{{rad}}{power}", lift.0), lift.1);
        let (ds, dds) = (per(""), per("^2"));
        return [kept(0, "s", lift), kept(1, "s′", ds), kept(2, "s″", dds)];
    }
    let names = if swings { ["ψ", "ω", "α"] } else { ["s", "v", "a"] };
    [
        kept(0, names[0], lift),
        kept(1, names[1], (v.0, v.1 * omega)),
        kept(2, names[2], (a.0, a.1 * omega * omega)),
    ]
}

impl DerivativePlot {
    /// The value at a cam angle.
    fn at(&self, report: &Report, phi: f64, side: PieceSide) -> Option<f64> {
        Some(report.survey.lift(&report.turning.disc, phi, side)?[self.order] * self.factor)
    }
}

fn axis(report: &Report, kept: &DerivativePlot) -> PlotAxis {
    let samples = round(&report.turning.disc, STEPS);
    let mut values: Vec<f64> = samples
        .into_iter()
        .filter_map(|(phi, side)| kept.at(report, phi, side))
        .chain([0.0])
        .collect();
    let most = values.iter().fold(0.0f64, |m, v| m.max(v.abs()));
    // Values within rounding error are zero.
    values.iter_mut().filter(|v| v.abs() < 1e-12 * most).for_each(|v| *v = 0.0);
    PlotAxis::of(&values, kept.unit == "\\degree", 6)
}

/// Draws the line, broken at jumps.
fn line(plot: &mut Plot, report: &Report, kept: &DerivativePlot) {
    let mut run: Vec<Point> = Vec::new();
    let jumps: Vec<f64> = report
        .survey
        .jumps
        .iter()
        .filter(|j| order(j.shock) == kept.order)
        .map(|j| in_turn(j.phi))
        .collect();
    let mut runs = Vec::new();
    for (phi, side) in round(&report.turning.disc, STEPS) {
        let Some(value) = kept.at(report, phi, side) else {
            runs.push(std::mem::take(&mut run));
            continue;
        };
        let jumps_here = jumps.iter().any(|j| {
            (in_turn(phi) - j).abs() < 1e-9
                || (in_turn(phi) - j).abs() > std::f64::consts::TAU - 1e-9
        });
        if jumps_here && side == PieceSide::After && !run.is_empty() {
            let last = run[run.len() - 1];
            runs.push(std::mem::take(&mut run));
            let here = plot.at(phi.to_degrees(), value);
            if (last.x - here.x).abs() < 0.1 {
                plot.line("jump", last, here, plot.style.thin.dashed(Dash::Dashed));
            }
        }
        run.push(plot.at(phi.to_degrees(), value));
    }
    runs.push(run);
    // A jump at the start of the turn is drawn at both ends.
    let ends = [(0.0, PieceSide::After), (std::f64::consts::TAU, PieceSide::Before)]
        .map(|(phi, side)| kept.at(report, phi, side));
    if let ([Some(first), Some(last)], true) = (ends, jumps.iter().any(|j| *j < 1e-9)) {
        plot.line(
            "jump",
            plot.at(0.0, first),
            plot.at(0.0, last),
            plot.style.thin.dashed(Dash::Dashed),
        );
    }
    let stroke = plot.style.vector;
    for points in runs.into_iter().filter(|r| r.len() > 1) {
        plot.draw(
            "curve",
            Shape::Polyline { points, closed: false, stroke: Some(stroke), fill: None },
            Some(report.cam.follower.0),
        );
    }
}

/// The order of the derivative that jumps.
fn order(shock: Shock) -> usize {
    match shock {
        Shock::Rigid => 1,
        Shock::Soft => 2,
    }
}

/// Marks the shocks in the plot of the acceleration: a soft shock at the middle of its jump, a
/// rigid one (infinite acceleration) by an arrow from the zero line.
fn shocks(
    plot: &mut Plot,
    report: &Report,
    kept: &DerivativePlot,
    lang: Lang,
    said: &mut Vec<String>,
) {
    if kept.order != 2 {
        return;
    }
    let style = plot.style;
    for j in &report.survey.jumps {
        let phi = in_turn(j.phi).to_degrees();
        let (at, text) = match j.shock {
            Shock::Soft => {
                let values = j.sides.map(|s| s * kept.factor);
                (plot.at(phi, 0.5 * (values[0] + values[1])), tr!(lang, "soft"))
            }
            Shock::Rigid => {
                let up = j.sides[1] > j.sides[0];
                let zero = plot.at(phi, 0.0);
                let end = Point::new(
                    zero.x,
                    if up { plot.frame.max.y - 1.0 } else { plot.frame.min.y + 1.0 },
                );
                plot.draw(
                    "shock",
                    Shape::Arrow { from: zero, to: end, stroke: style.thin, head: style.thin_head },
                    None,
                );
                (end, if up { tr!(lang, "rigid: +∞") } else { tr!(lang, "rigid: −∞") })
            }
        };
        said.push(format!("{text} {}°", number(phi, DIGITS)));
        let dot = Shape::Circle {
            centre: at,
            radius_mm: 1.3 * style.dot_radius_mm,
            stroke: Some(style.outline),
            fill: Some(Colour::WHITE),
        };
        plot.draw("shock", dot, None);
        plot.label(
            LabelRequest::at_point(
                Label::text(text),
                style.small_mm,
                at,
                1.6 * style.dot_radius_mm,
            ),
            None,
        );
    }
}

/// Writes an angle, rounded to 1e-4 degree, in the shortest form.
fn shortest(degrees: f64) -> String {
    hodograph_base::digits::shortest((degrees * 1e4).round() / 1e4)
}

/// Marks the least and the greatest value.
fn extremes(plot: &mut Plot, report: &Report, kept: &DerivativePlot, said: &mut Vec<String>) {
    let style = plot.style;
    let s = report.survey;
    let found: Vec<(f64, f64)> = match kept.order {
        0 => Vec::new(),
        1 => s.velocity.to_vec(),
        _ => s.acceleration.to_vec(),
    };
    let mut marks: Vec<(f64, f64)> =
        found.into_iter().map(|(phi, v)| (phi.to_degrees(), v * kept.factor)).collect();
    if kept.order == 0 {
        // The stroke, marked at the end of the rise.
        let top = s.phases.iter().find(|p| p.way == 1).map_or(0.0, |p| p.to);
        marks.push((in_turn(top).to_degrees(), s.stroke * kept.factor));
    }
    marks.dedup();
    for (phi, value) in marks {
        let at = plot.at(phi, value);
        said.push(format!(
            "{} = {} ({}°)",
            kept.symbol,
            number(value, DIGITS),
            number(phi, DIGITS)
        ));
        let dot = Shape::Circle {
            centre: at,
            radius_mm: style.dot_radius_mm,
            stroke: None,
            fill: Some(Colour::BLACK),
        };
        plot.draw("extreme", dot, None);
        let text = if kept.order == 0 {
            format!("h = {}", number(value, DIGITS))
        } else {
            number(value, DIGITS)
        };
        plot.label(
            LabelRequest::at_point(Label::math(text), style.small_mm, at, style.dot_radius_mm),
            None,
        );
    }
}

/// Writes the angles of the stages above the uppermost plot.
fn stages(plot: &mut Plot, report: &Report, lang: Lang) {
    let style = plot.style;
    let y = plot.frame.max.y + 5.0;
    for p in &report.survey.phases {
        let name = match (p.way, p.out) {
            (1, _) => "Φ",
            (-1, _) => "Φ′",
            (_, true) => "Φ_s",
            (_, false) => "Φ′_s",
        };
        let words = match (p.way, lang) {
            (1, _) => tr!(lang, "rise"),
            (-1, _) => tr!(lang, "return"),
            (_, Lang::En) => "dwell",
            (_, Lang::Zh) => dwell(p.out, lang),
        };
        // A stage across the start of the turn has its text at its longer piece.
        let turn = std::f64::consts::TAU;
        let (from, to) = (p.from, p.to);
        let pieces =
            if to > turn + 1e-9 { vec![(from, turn), (0.0, to - turn)] } else { vec![(from, to)] };
        let longest = pieces.iter().copied().max_by(|a, b| (a.1 - a.0).total_cmp(&(b.1 - b.0)));
        for &(from, to) in &pieces {
            let [a, b] = [from, to].map(|phi| Point::new(plot.at(phi.to_degrees(), 0.0).x, y));
            plot.line("stage", a, b, style.thin);
            for end in [a, b] {
                plot.line(
                    "stage",
                    end - Vec2::new(0.0, 1.5),
                    end + Vec2::new(0.0, 1.5),
                    style.thin,
                );
            }
            if longest == Some((from, to)) {
                let degrees = shortest((p.to - p.from).to_degrees());
                let wide = b.x - a.x;
                let text = Label::math(format!("{name} = {degrees}\\degree"));
                let middle = Point::new(0.5 * (a.x + b.x), y + 1.6);
                let formula = hodograph_paper::paper::text::set(&text).width_em * style.small_mm;
                if wide > formula + 14.0 {
                    plot.words(
                        "stage",
                        middle,
                        text.then(Label::text(format!("  {words}"))),
                        style.small_mm,
                        Anchor::Middle,
                    );
                } else if wide > formula + 2.0 {
                    plot.words("stage", middle, text, style.small_mm, Anchor::Middle);
                } else if wide > 6.0 {
                    plot.words("stage", middle, Label::math(name), style.small_mm, Anchor::Middle);
                }
            }
        }
    }
}
