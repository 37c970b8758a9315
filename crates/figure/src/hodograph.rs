//! Draws a hodograph: the curve traced by the tip of a vector from a fixed pole through a whole
//! motion.
//!
//! This module draws the axes with their ticks, selects the part of an unbounded curve on the
//! paper, and marks the numbered positions. The vectors come from [`hodograph_sweep::points`].

use hodograph_base::digits::{inked, shortest};
use hodograph_base::geom::{Point, Vec2};
use hodograph_board::construct::scale;
use hodograph_scene::{Book, DiagramKind};

use super::plot::over;
use hodograph_paper::paper::drawing::{Drawing, DrawingPart};
use hodograph_paper::paper::item::{Colour, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::shown::{ShownQuantity, question_id};
use hodograph_paper::paper::style::Style;
use hodograph_paper::paper::symbols as sym;

/// Minimum distance of the ticks, so that their numbers stay apart.
const TICK_MM: f64 = 15.0;
/// Half the length of a tick.
const TICK_HALF_MM: f64 = 0.9;
/// Extension of an axis beyond the curve.
const BEYOND_MM: f64 = 7.0;
/// Colour of the axes in the background of the curve.
const AXIS: Colour = Colour::grey(120);
/// A shorter vector is a dot at the pole.
const SHORTEST_MM: f64 = 0.6;

/// The vector of one point through a motion.
pub struct Hodograph<'a> {
    /// The diagram of the vector: velocities, accelerations or forces.
    pub on: DiagramKind,
    /// The vector in the notation of `find`.
    pub quantity: &'a str,
    /// The pole's letter.
    pub pole: &'a str,
    /// The link of the point.
    pub link: Option<usize>,
    /// The vector (SI units) at each pose in order; `None` if it has no value.
    pub curve: &'a [Option<Vec2>],
    /// True if the first pose follows the last one.
    pub closed: bool,
    /// The vectors at the numbered positions.
    pub marks: &'a [Option<Vec2>],
    /// Limit (SI units) beyond which vectors leave the paper.
    pub most: f64,
    /// The scale (SI units per mm).
    pub mu: f64,
    /// Units of the numbers at the axes.
    pub book: &'a Book,
}

/// Returns the runs of a curve on the paper (SI units), and true if any part leaves the paper; a
/// run ends at the edge where the curve leaves.
pub fn runs(curve: &[Option<Vec2>], closed: bool, most: f64) -> (Vec<Vec<Vec2>>, bool) {
    let inside = |v: &Option<Vec2>| v.filter(|v| v.norm() <= most);
    let n = curve.len();
    let Some(start) = (0..n).find(|&k| inside(&curve[k]).is_none()) else {
        // The whole curve: a closed one returns to its first place.
        let all = curve.iter().flatten().copied();
        let again = curve.first().copied().flatten().filter(|_| closed);
        return (vec![all.chain(again).collect()], false);
    };
    // A closed curve is cut where it is off the paper, so that no run is cut at the first pose.
    let order: Vec<usize> =
        if closed { (0..=n).map(|k| (start + k) % n).collect() } else { (0..n).collect() };
    let mut out: Vec<Vec<Vec2>> = Vec::new();
    let mut run: Vec<Vec2> = Vec::new();
    for w in 0..order.len() {
        let here = curve[order[w]];
        let before = w.checked_sub(1).and_then(|b| curve[order[b]]);
        match (inside(&before), inside(&here)) {
            (None, Some(v)) => {
                run.extend(before.map(|outer| edge(v, outer, most)));
                run.push(v);
            }
            (Some(_), Some(v)) => run.push(v),
            (Some(v), None) => {
                run.extend(here.map(|outer| edge(v, outer, most)));
                out.push(std::mem::take(&mut run));
            }
            (None, None) => {}
        }
    }
    out.push(run);
    out.retain(|r| r.len() > 1);
    (out, true)
}

/// Point between a vector on the paper and one beyond it at which the length equals the limit.
fn edge(inner: Vec2, outer: Vec2, most: f64) -> Vec2 {
    let d = outer - inner;
    let (a, b, c) = (d.norm2(), inner.dot(d), inner.norm2() - most * most);
    let root = (b * b - a * c).max(0.0).sqrt();
    let t = if a > 0.0 { ((root - b) / a).clamp(0.0, 1.0) } else { 0.0 };
    inner + d * t
}

/// Draws a hodograph with the pole at the origin.
pub fn hodograph(style: &Style, h: &Hodograph) -> DrawingPart {
    let mut d = Drawing::new("hodograph", style.clone());
    let key = question_id(h.quantity);
    let (runs, _) = runs(h.curve, h.closed, h.most);
    let paper = |v: Vec2| (v * (1.0 / h.mu)).to_point();
    axes(&mut d, style, h, &runs);
    d.of_link(h.link);
    for (k, run) in runs.iter().enumerate() {
        let points: Vec<Point> = run.iter().map(|v| paper(*v)).collect();
        let shape =
            Shape::Polyline { points, closed: false, stroke: Some(style.vector), fill: None };
        d.shape(&format!("{key}-curve-{k}"), "curve", shape);
    }
    for (k, v) in h.marks.iter().enumerate() {
        let Some(v) = v.filter(|v| v.norm() <= h.most) else { continue };
        let tip = paper(v);
        let name = format!("{key}-{}", k + 1);
        if tip.to_vec2().norm() > SHORTEST_MM {
            let shape = Shape::Arrow {
                from: Point::ORIGIN,
                to: tip,
                stroke: style.thin,
                head: style.thin_head,
            };
            d.vector(
                &name,
                "vector",
                shape,
                ShownQuantity::vector(h.quantity, Point::ORIGIN, tip, h.mu),
            );
        }
        d.draw(&name, "position", sym::dot(style, tip));
        let request = LabelRequest::at_point(
            Label::math((k + 1).to_string()),
            style.small_mm,
            tip,
            style.dot_radius_mm,
        );
        d.label(&name, "position", LabelRequest { prefer: v.unit(), ..request });
    }
    d.of_link(None);
    d.draw(&format!("{key}-pole"), "pole", sym::dot(style, Point::ORIGIN));
    let middle = runs.iter().flatten().fold(Vec2::ZERO, |s, v| s + *v);
    d.label_at(
        &format!("{key}-pole"),
        "pole",
        h.pole,
        Point::ORIGIN,
        style.dot_radius_mm,
        (-middle).unit(),
    );
    d.finish()
}

/// Draws the axes through the pole, with ticks at equal steps.
fn axes(d: &mut Drawing, style: &Style, h: &Hodograph, runs: &[Vec<Vec2>]) {
    let kind = h.on.kind();
    let step = scale::choose_in(h.book.size(kind), [TICK_MM * h.mu, 0.0], [1.0, 1.0]);
    let stroke = style.thin.coloured(AXIS);
    let unit = h.book.upright(kind);
    let letter = h.on.letter();
    for (axis, along) in [("x", Vec2::new(1.0, 0.0)), ("y", Vec2::new(0.0, 1.0))] {
        let parts = || runs.iter().flatten().map(|v| v.dot(along));
        let (lo, hi) = (parts().fold(0.0, f64::min), parts().fold(0.0, f64::max));
        let (first, last) =
            (libm::ceil(lo / step - 1e-9) as i64, libm::floor(hi / step + 1e-9) as i64);
        let (from, to) = (
            (along * (lo / h.mu - BEYOND_MM)).to_point(),
            (along * (hi / h.mu + BEYOND_MM)).to_point(),
        );
        let name = format!("{}-axis-{axis}", question_id(h.quantity));
        let owner =
            d.shape(&name, "axis", Shape::Arrow { from, to, stroke, head: style.thin_head });
        let label = Label::math(over(&format!("{letter}_{axis}"), &unit));
        let side = if axis == "x" { Vec2::new(0.0, -1.0) } else { Vec2::new(1.0, 0.0) };
        d.label(
            &name,
            "axis",
            LabelRequest::at_point(label, style.small_mm, to, 0.4).owned(owner).towards(side),
        );
        for tick in (first..=last).filter(|k| *k != 0) {
            let value = tick as f64 * step;
            let at = (along * (value / h.mu)).to_point();
            let across = along.perp() * TICK_HALF_MM;
            let line = Shape::Line { from: at - across, to: at + across, stroke };
            let owner = d.shape(&format!("{name}-tick"), "tick", line);
            let request = LabelRequest::at_point(
                Label::math(inked(&shortest(h.book.value(kind, value)))),
                style.small_mm,
                at,
                TICK_HALF_MM,
            );
            // A number may be omitted at the curve: its neighbours show the step.
            d.label(
                &format!("{name}-{tick}"),
                "tick",
                request.owned(owner).towards(-along.perp()).optional(true),
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_that_leaves_the_paper_ends_at_its_edge() {
        let v = |x: f64, y: f64| Some(Vec2::new(x, y));
        // Out along x beyond 2, and back after a gap.
        let curve = [v(0.0, 1.0), v(1.0, 0.0), v(3.0, 0.0), None, v(0.0, -1.0)];
        let (open, cut) = runs(&curve, false, 2.0);
        assert!(cut);
        assert_eq!(open.len(), 1);
        assert_eq!(open[0].last(), Some(&Vec2::new(2.0, 0.0)));
        // In a closed curve the first pose follows the last.
        let (closed, _) = runs(&curve, true, 2.0);
        assert_eq!(closed.len(), 1);
        assert_eq!((closed[0][0], closed[0].len()), (Vec2::new(0.0, -1.0), 4));
        let (whole, cut) = runs(&curve[..2], true, 2.0);
        assert_eq!((whole[0].len(), cut), (3, false));
    }
}
