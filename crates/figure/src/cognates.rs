//! Draws the cognates of a four-bar over it: parallelograms, the three similar triangles, the third
//! pivot, and the common coupler curve.

use hodograph_base::diag::{Diagnostic, Faults, Warned};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::{each, tr};
use hodograph_scene::DiagramKind;
use hodograph_synthesis::cognates::Cognates;
use std::f64::consts::TAU;

use super::list::{FigureEntry, FigureInput, Pages, page};
use super::mechanism;
use super::sheet::SheetDrafter;
use hodograph_paper::paper::item::{Cap, Dash, LineStroke, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::symbols as sym;

/// The cognates.
pub const ENTRY: FigureEntry = FigureEntry {
    name: "cognates",
    about: each!("The cognates of a four-bar with a coupler point, with their construction"),
    draw,
};

/// Chords of the coupler curve.
const STEPS: usize = 360;

fn draw(w: &FigureInput) -> Result<Warned<Pages>, Faults> {
    let at = &w.worked.configuration;
    let found = Cognates::of_scene(w.scene, at, w.extras.points.first().copied())
        .map_err(|d: Diagnostic| Faults::from(d))?;
    let diagram = &w.worked.construction.diagram;
    let to_paper = |p: Point| ((p - diagram.origin) * (1.0 / diagram.mu)).to_point();
    let style = &w.options.style;
    let mut d = mechanism::numbered(style, w.scene, w.worked, &w.options.notation);
    let [a, e, f] = [found.given.a, found.e, found.f].map(to_paper);
    let pivot = to_paper(found.given.d);
    let [a1, p1] = found.left.map(to_paper);
    let [d1, p2] = found.right.map(to_paper);
    let link = LineStroke {
        width_mm: style.link.width_mm * 0.6,
        dash: Dash::Solid,
        cap: Cap::Round,
        ..style.link
    };
    let cognates =
        [("left", [a, a1, p1, f], [a1, p1, e]), ("right", [pivot, d1, p2, f], [d1, p2, e])];
    d.behind(|d| {
        for (name, _, triangle) in cognates {
            let shape = Shape::Polyline {
                points: triangle.to_vec(),
                closed: true,
                stroke: Some(link),
                fill: Some(style.plate),
            };
            d.shape(name, "cognate plate", shape);
        }
    });
    // Behind the outlines of the plates, and over their areas.
    d.behind(|d| {
        for points in curve(&found, &to_paper) {
            let stroke = Some(style.thin.dashed(Dash::DashDot));
            d.shape(
                "path",
                "cognate path",
                Shape::Polyline { points, closed: false, stroke, fill: None },
            );
        }
        // The parallelograms, and the frame of the three pivots: a triangle similar to the coupler.
        for (from, to) in [(a, f), (f, pivot)] {
            d.shape(
                "parallel",
                "cognate construction",
                Shape::Line { from, to, stroke: style.thin.dashed(Dash::Dashed) },
            );
        }
        for (name, chain, _) in cognates {
            for pair in [[chain[0], chain[1]], [chain[2], chain[3]]] {
                d.shape(
                    name,
                    "cognate link",
                    Shape::Line { from: pair[0], to: pair[1], stroke: link },
                );
            }
        }
    });
    for (name, at) in [("A_{1}", a1), ("P_{1}", p1), ("D_{1}", d1), ("P_{2}", p2)] {
        d.draw(name, "cognate", sym::pin(style, at));
        d.label(
            name,
            "cognate",
            LabelRequest::at_point(Label::math(name), style.label_mm, at, style.pin_radius_mm),
        );
    }
    d.draw("F", "cognate", sym::fixed_pivot(style, f, Vec2::new(0.0, -1.0)));
    d.label(
        "F",
        "cognate",
        LabelRequest::at_point(Label::math("F"), style.label_mm, f, style.pin_radius_mm),
    );
    let maker = SheetDrafter {
        scene: w.scene,
        worked: w.worked,
        options: w.options,
        certified: Vec::new(),
    };
    let (_, mu) = maker.caption(DiagramKind::Plane);
    let words = tr!(w.options.lang, "Cognates (Roberts–Chebyshev): ");
    let caption =
        Label::text(words).then(Label::math("ABCD,\\quad AA_{1}P_{1}F,\\quad DD_{1}P_{2}F"));
    let figure = maker.alone(maker.titled(d.finish(), caption, &mu, "cognates"));
    page(ENTRY.name, Some(figure))
}

/// The path of the coupler point, in several pieces if the crank does not turn fully.
fn curve(found: &Cognates, to_paper: &dyn Fn(Point) -> Point) -> Vec<Vec<Point>> {
    let given = &found.given;
    let start = (given.b - given.a).angle();
    let place = |k: usize| {
        let (b, c) = given.at(start + TAU * k as f64 / STEPS as f64)?;
        Some(to_paper(given.coupler_point(b, c)?))
    };
    let all: Vec<Option<Point>> = (0..=STEPS).map(place).collect();
    all.split(Option::is_none)
        .map(|run| run.iter().flatten().copied().collect::<Vec<_>>())
        .filter(|r| r.len() > 1)
        .collect()
}
