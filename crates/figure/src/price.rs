//! The work-precision figure: error against time for every method of solution, and error against
//! the distance from a toggle position. Both axes are logarithmic; a lower error in less time is
//! lower and farther left.

use super::plot::{Plot, PlotAxis};
use super::sheet::painted;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::{say, tr};
use hodograph_paper::paper::extent::Rect;
use hodograph_paper::paper::item::{Anchor, Colour, Dash, Figure, FigureItem, LineStroke, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::style::Style;
use hodograph_report::price::name;
use hodograph_scene::{Lang, Scene};
use hodograph_worked::accuracy::Rung;
use hodograph_worked::effort::ways::{AnswerMethod, MethodMeasurement, TogglePose};

/// Size of a plot (mm).
const PLOT_MM: [f64; 2] = [150.0, 110.0];
/// Space for the numbers and titles of the axes on the left, for the legend on the right, and above
/// and below.
const LEFT_MM: f64 = 24.0;
const RIGHT_MM: f64 = 62.0;
const ABOVE_MM: f64 = 14.0;
const BELOW_MM: f64 = 20.0;
/// Logarithm of the error below which points are drawn at the lower edge: no figure needs to
/// distinguish them.
const FLOOR: f64 = -42.0;
/// Stroke of the lines that join the points of a family: thinner than the outlines of their
/// symbols.
const JOINED: LineStroke = LineStroke::new(0.2);

/// A family of methods: one symbol, one line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum MethodFamily {
    Drawing,
    Closed,
    Loops,
    Differences,
    Certified,
}

impl MethodFamily {
    const ALL: [MethodFamily; 5] = [
        MethodFamily::Drawing,
        MethodFamily::Closed,
        MethodFamily::Certified,
        MethodFamily::Loops,
        MethodFamily::Differences,
    ];

    fn of(way: AnswerMethod) -> Option<MethodFamily> {
        Some(match way {
            AnswerMethod::Paper(_) => return None,
            AnswerMethod::DrawingSingle | AnswerMethod::Drawing => MethodFamily::Drawing,
            AnswerMethod::ClosedSingle
            | AnswerMethod::Closed
            | AnswerMethod::ClosedDouble
            | AnswerMethod::ClosedLong(_) => MethodFamily::Closed,
            AnswerMethod::Loops(_) => MethodFamily::Loops,
            AnswerMethod::Differences(_) => MethodFamily::Differences,
            AnswerMethod::Certified(_) => MethodFamily::Certified,
        })
    }

    fn words(self, lang: Lang) -> &'static str {
        match self {
            MethodFamily::Drawing => tr!(lang, "drawing board"),
            MethodFamily::Closed => tr!(lang, "closed form, group by group"),
            MethodFamily::Loops => tr!(lang, "loop equations, Newton"),
            MethodFamily::Differences => tr!(lang, "finite differences"),
            MethodFamily::Certified => tr!(lang, "certified (bound)"),
        }
    }

    /// The symbol of a family; symbols differ in shape, so that they stay distinct in a grey print.
    fn symbol(self, at: Point) -> Shape {
        const R: f64 = 1.1;
        let line = Some(LineStroke::new(0.35));
        let corners = |list: &[(f64, f64)], fill| Shape::Polyline {
            points: list.iter().map(|(x, y)| at + Vec2::new(x * R, y * R)).collect(),
            closed: true,
            stroke: line,
            fill: Some(fill),
        };
        let disc =
            |fill| Shape::Circle { centre: at, radius_mm: R, stroke: line, fill: Some(fill) };
        match self {
            MethodFamily::Drawing => disc(Colour::WHITE),
            MethodFamily::Closed => disc(Colour::BLACK),
            MethodFamily::Loops => {
                corners(&[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)], Colour::WHITE)
            }
            MethodFamily::Differences => {
                corners(&[(-1.1, -0.8), (1.1, -0.8), (0.0, 1.2)], Colour::WHITE)
            }
            MethodFamily::Certified => {
                corners(&[(-1.2, 0.0), (0.0, -1.2), (1.2, 0.0), (0.0, 1.2)], Colour::grey(150))
            }
        }
    }
}

/// The label beside a point.
fn short(way: AnswerMethod) -> Label {
    match way {
        AnswerMethod::Paper(mm) => Label::text(format!("{mm} mm")),
        AnswerMethod::DrawingSingle | AnswerMethod::ClosedSingle => Label::text("f32"),
        AnswerMethod::Drawing | AnswerMethod::Closed | AnswerMethod::Certified(Rung::Double) => {
            Label::text("f64")
        }
        AnswerMethod::ClosedDouble | AnswerMethod::Certified(Rung::DoubleDouble) => {
            Label::text("dd")
        }
        AnswerMethod::ClosedLong(bits) | AnswerMethod::Certified(Rung::Long(bits)) => {
            Label::text(format!("{bits} bit"))
        }
        AnswerMethod::Loops(x) | AnswerMethod::Differences(x) => {
            Label::math(format!("10^{{−{}}}", -libm::log10(x).round() as i32))
        }
    }
}

/// The error shown: of the accelerations if they are computed, otherwise of the velocities.
fn shown(m: &MethodMeasurement) -> Option<f64> {
    m.errors[1].or(m.errors[0]).filter(|e| e.is_finite())
}

fn log_error(e: f64) -> f64 {
    if e > 0.0 { libm::log10(e).clamp(FLOOR, 1.0) } else { FLOOR }
}

/// Draws the figure of all methods, and below it the figure of the series of poses, if there is
/// one.
pub fn figure(
    scene: &Scene,
    ways: &[MethodMeasurement],
    series: &[TogglePose],
    style: &Style,
    lang: Lang,
) -> Figure {
    let panels = if series.iter().any(|n| !n.ways.is_empty()) { 2.0 } else { 1.0 };
    let panel_mm = PLOT_MM[1] + ABOVE_MM + BELOW_MM;
    let heading_mm = 10.0;
    let width_mm = LEFT_MM + PLOT_MM[0] + RIGHT_MM;
    let height_mm = panels * panel_mm + heading_mm;
    let title = lang.of(&scene.title);
    let subject = if ways.iter().any(|m| m.errors[1].is_some()) {
        tr!(lang, "accelerations")
    } else {
        tr!(lang, "velocities")
    };
    let heading = say!(
        lang,
        "What accuracy costs{}{title}",
        if title.is_empty() { "" } else { lang.pick([": ", "："]) }
    );
    let label = Shape::Label {
        at: Point::new(LEFT_MM, height_mm - 8.0),
        label: Label::text(heading.as_str()).in_fonts(&style.fonts),
        size_mm: style.caption_mm,
        anchor: Anchor::Start,
        colour: Colour::BLACK,
    };
    let mut items = vec![FigureItem::new("heading", label)];
    let corner = Point::new(LEFT_MM, height_mm - heading_mm - ABOVE_MM - PLOT_MM[1]);
    let frame = Rect::new(corner, corner + Vec2::new(PLOT_MM[0], PLOT_MM[1]));
    let error = say!(lang, "relative error of the {subject}");
    let look = PriceStyle { style, error: Label::text(error), lang };
    items.extend(look.against_time(frame, ways));
    if panels > 1.0 {
        let below = Vec2::new(0.0, -panel_mm);
        items
            .extend(look.against_distance(Rect::new(frame.min + below, frame.max + below), series));
    }
    let desc = say!(
        lang,
        "Relative error of the {subject} against time on logarithmic axes, for every way to the answer."
    );
    painted(style, lang, [width_mm, height_mm], [heading, desc], items)
}

/// The common features of both plots.
struct PriceStyle<'a> {
    style: &'a Style,
    /// The name of the vertical axis.
    error: Label,
    lang: Lang,
}

impl PriceStyle<'_> {
    fn against_time(&self, frame: Rect, ways: &[MethodMeasurement]) -> Vec<FigureItem> {
        let logs = ways.iter().filter_map(|m| m.seconds).map(libm::log10);
        let (lo, hi) =
            logs.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), t| (a.min(t), b.max(t)));
        let errors = ways.iter().filter_map(shown);
        let axes = [PlotAxis::powers(libm::floor(lo), libm::ceil(hi)), errors_axis(errors)];
        let mut plot = Plot::new("time".into(), self.style, frame, axes);
        plot.axes(
            Some(Label::text(tr!(self.lang, "time of a whole solution / s"))),
            self.error.clone(),
        );
        let mut pencils = Vec::new();
        for m in ways.iter().filter(|m| matches!(m.way, AnswerMethod::Paper(_))) {
            let Some(e) = shown(m) else { continue };
            let [from, to] = [plot.axes[0].from, plot.axes[0].to].map(|t| plot.at(t, e));
            plot.line("paper", from, to, LineStroke::new(0.3).dashed(Dash::Dashed));
            pencils.push((to, Label::text(name(m.way, self.lang))));
        }
        plot.names(pencils);
        for family in MethodFamily::ALL {
            let of_family = ways.iter().filter(|m| MethodFamily::of(m.way) == Some(family));
            let points: Vec<(Point, AnswerMethod)> =
                of_family.filter_map(|m| Some((plot.at(m.seconds?, shown(m)?), m.way))).collect();
            joined(&mut plot, family, &points.iter().map(|p| p.0).collect::<Vec<_>>());
            for (at, way) in points {
                plot.label(
                    LabelRequest::at_point(short(way), self.style.small_mm * 0.85, at, 1.4),
                    None,
                );
            }
        }
        self.legend(&mut plot);
        plot.finish(frame)
    }

    /// Draws the legend below the names of the pencils, which are at their lines.
    fn legend(&self, plot: &mut Plot) {
        let small = self.style.small_mm;
        for (k, family) in MethodFamily::ALL.into_iter().enumerate() {
            let at =
                Point::new(plot.frame.max.x + 5.0, plot.frame.centre().y - 2.0 * small * k as f64);
            plot.draw("way", family.symbol(at), None);
            plot.words(
                "legend",
                at + Vec2::new(3.5, -small * 0.33),
                Label::text(family.words(self.lang)),
                small,
                Anchor::Start,
            );
        }
    }

    fn against_distance(&self, frame: Rect, series: &[TogglePose]) -> Vec<FigureItem> {
        let logs: Vec<f64> = series.iter().map(|n| libm::log10(n.distance)).collect();
        let (far, near) = (
            logs.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            logs.iter().copied().fold(f64::INFINITY, f64::min),
        );
        let errors = series.iter().flat_map(|n| &n.ways).filter_map(shown);
        let mut plot = Plot::new(
            "distance".into(),
            self.style,
            frame,
            [PlotAxis::powers(far, near), errors_axis(errors)],
        );
        let below = tr!(self.lang, "distance of the driver from its limit, rad (m)");
        plot.axes(Some(Label::text(below)), self.error.clone());
        let ways: Vec<AnswerMethod> = series
            .iter()
            .find(|n| !n.ways.is_empty())
            .iter()
            .flat_map(|n| &n.ways)
            .map(|m| m.way)
            .collect();
        let mut ends = Vec::new();
        for (k, way) in ways.into_iter().enumerate() {
            let Some(family) = MethodFamily::of(way) else { continue };
            let points: Vec<Point> = series
                .iter()
                .filter_map(|n| Some(plot.at(n.distance, shown(n.ways.get(k)?)?)))
                .collect();
            joined(&mut plot, family, &points);
            ends.extend(points.last().map(|last| (*last, Label::text(name(way, self.lang)))));
        }
        plot.names(ends);
        plot.finish(frame)
    }
}

/// The axis from a power of ten below all errors to ten.
fn errors_axis(errors: impl Iterator<Item = f64>) -> PlotAxis {
    PlotAxis::powers(libm::floor(errors.map(log_error).fold(0.0, f64::min)), 1.0)
}

/// Draws symbols joined by a thin line.
fn joined(plot: &mut Plot, family: MethodFamily, points: &[Point]) {
    if points.len() > 1 {
        let line = Shape::Polyline {
            points: points.to_vec(),
            closed: false,
            stroke: Some(JOINED),
            fill: None,
        };
        plot.draw("curve", line, None);
    }
    for at in points {
        plot.draw("way", family.symbol(*at), None);
    }
}
