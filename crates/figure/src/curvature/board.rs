//! Draws lines, circles and curves over a mechanism, cut at the edge of the paper; places off the
//! paper get an arrow with their distance.

use crate::centres::rays::{clipped, holds};
use hodograph_base::geom::{Point, Vec2};
use hodograph_paper::paper::drawing::Drawing;
use hodograph_paper::paper::extent::Rect;
use hodograph_paper::paper::item::{LineStroke, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::style::Style;
use hodograph_paper::paper::symbols as sym;
use std::f64::consts::TAU;

/// Places closer than this share one dot and one label.
const SAME_MM: f64 = 0.6;
/// Length of the arrow to a place off the paper.
const ARROW_MM: f64 = 14.0;
/// Length of a circle's chords: their sag is invisible.
const CHORD_MM: f64 = 1.0;
/// Maximum number of chords: a page holds no longer arc.
const CHORDS: usize = 2000;

/// Paper over a mechanism; all positions are in mm.
pub struct CurvatureBoard<'a> {
    /// The style of lines and labels.
    pub style: &'a Style,
    /// The drawing.
    pub d: Drawing,
    /// The part of the paper that is used.
    pub window: Rect,
    /// Named places, drawn at the end.
    spots: Vec<NamedSpot>,
}

struct NamedSpot {
    name: String,
    label: Label,
    at: Point,
    /// True if a joint's circle is drawn at this place.
    joint: bool,
    /// The step that names the place.
    step: Option<usize>,
}

impl<'a> CurvatureBoard<'a> {
    /// Creates a board over a drawing.
    pub fn new(style: &'a Style, d: Drawing, window: Rect) -> CurvatureBoard<'a> {
        CurvatureBoard { style, d, window, spots: Vec::new() }
    }

    /// True if the paper holds a point.
    pub fn holds(&self, p: Point) -> bool {
        holds(self.window, p)
    }

    /// The part of a line on the paper; `None` if the line misses the paper.
    pub fn across(&self, through: Point, along: Vec2) -> Option<[Point; 2]> {
        let u = along.unit()?;
        let [low, high] = clipped(self.window, through, u)?;
        Some([through + u * low, through + u * high])
    }

    /// The part of a segment on the paper.
    pub fn cut(&self, a: Point, b: Point) -> Option<[Point; 2]> {
        let u = (b - a).unit()?;
        let [low, high] = clipped(self.window, a, u)?;
        let (low, high) = (low.max(0.0), high.min(a.distance(b)));
        (low < high).then(|| [a + u * low, a + u * high])
    }

    /// Draws a line between two points behind the mechanism; returns its owner for labels (0 if
    /// `ends` is `None`).
    pub fn line(
        &mut self,
        name: &str,
        class: &str,
        ends: Option<[Point; 2]>,
        stroke: LineStroke,
    ) -> u32 {
        let Some([from, to]) = ends else { return 0 };
        let mut owner = 0;
        self.d.behind(|d| owner = d.shape(name, class, Shape::Line { from, to, stroke }));
        owner
    }

    /// Draws a circle as far as the paper holds it; returns a chord in the middle of its longest
    /// arc.
    pub fn circle(
        &mut self,
        name: &str,
        class: &str,
        centre: Point,
        radius_mm: f64,
        stroke: LineStroke,
    ) -> Option<(Point, Point)> {
        let mut longest: Option<(Point, Point)> = None;
        let arcs = arcs(self.window, centre, radius_mm);
        if arcs.is_empty() {
            return None;
        }
        let style = arcs.iter().map(|[from, to]| to - from).fold(0.0, f64::max);
        for [from, to] in &arcs {
            let n = (((to - from) * radius_mm / CHORD_MM).ceil() as usize).clamp(8, CHORDS);
            let at = |k: usize| {
                centre + Vec2::from_angle(from + (to - from) * k as f64 / n as f64) * radius_mm
            };
            let whole = to - from >= TAU;
            if to - from == style {
                longest = Some((at(n / 2), at(n / 2 + 1)));
            }
            let shape = if whole {
                Shape::Circle { centre, radius_mm, stroke: Some(stroke), fill: None }
            } else {
                Shape::Polyline {
                    points: (0..=n).map(at).collect(),
                    closed: false,
                    stroke: Some(stroke),
                    fill: None,
                }
            };
            self.d.behind(|d| {
                d.shape(name, class, shape);
            });
        }
        longest
    }

    /// Names a place; several names at one place share dot and label.
    pub fn spot(&mut self, name: &str, label: Label, at: Point, joint: bool) {
        let step = self.d.step();
        self.spots.push(NamedSpot { name: name.to_owned(), label, at, joint, step });
    }

    /// Draws all named places on the paper.
    pub fn spots(&mut self) {
        let mut places: Vec<(Point, Vec<NamedSpot>)> = Vec::new();
        for spot in std::mem::take(&mut self.spots) {
            if !self.holds(spot.at) {
                continue;
            }
            match places.iter_mut().find(|(p, _)| p.distance(spot.at) < SAME_MM) {
                Some((_, members)) => members.push(spot),
                None => places.push((spot.at, vec![spot])),
            }
        }
        for (at, members) in places {
            let joint = members.iter().any(|s| s.joint);
            let name = members[0].name.clone();
            self.d.at_step(members.iter().filter_map(|s| s.step).min());
            if !joint {
                self.d.draw(&name, "curvature spot", sym::dot(self.style, at));
            }
            let clear = if joint { self.style.pin_radius_mm } else { self.style.dot_radius_mm };
            let label = members
                .into_iter()
                .map(|s| s.label)
                .reduce(|all, one| all.then(Label::text(", ")).then(one));
            let Some(label) = label else { continue };
            self.d.label(
                &name,
                "curvature spot",
                LabelRequest::at_point(label, self.style.small_mm, at, clear),
            );
        }
    }

    /// Draws the end of a line towards a place off the paper, with its name.
    pub fn arrow(
        &mut self,
        name: &str,
        label: Label,
        from: Point,
        toward: Vec2,
        stroke: LineStroke,
    ) {
        let Some(u) = toward.unit() else { return };
        let Some([_, high]) = clipped(self.window, from, u) else { return };
        let tip = from + u * high;
        let base = tip - u * ARROW_MM.min(high.max(0.0));
        let back = tip - u * (self.style.thin_head.length_mm * 1.5);
        let owner = self.d.shape(
            name,
            "curvature far",
            Shape::Arrow { from: back, to: tip, stroke, head: self.style.thin_head },
        );
        self.d.label(
            name,
            "curvature far",
            LabelRequest::along(label, self.style.small_mm, base, tip, stroke.width_mm / 2.0)
                .owned(owner),
        );
    }
}

/// The arcs of a circle within a window, as pairs of angles.
fn arcs(window: Rect, centre: Point, radius: f64) -> Vec<[f64; 2]> {
    let mut angles: Vec<f64> = Vec::new();
    for x in [window.min.x, window.max.x] {
        let c = (x - centre.x) / radius;
        if c.abs() <= 1.0 {
            let s = (1.0 - c * c).sqrt();
            angles.extend([Vec2::new(c, s).angle(), Vec2::new(c, -s).angle()]);
        }
    }
    for y in [window.min.y, window.max.y] {
        let s = (y - centre.y) / radius;
        if s.abs() <= 1.0 {
            let c = (1.0 - s * s).sqrt();
            angles.extend([Vec2::new(c, s).angle(), Vec2::new(-c, s).angle()]);
        }
    }
    angles.sort_by(f64::total_cmp);
    let inside = |angle: f64| holds(window, centre + Vec2::from_angle(angle) * radius);
    let Some(first) = angles.first().copied() else {
        return if inside(0.0) { vec![[0.0, TAU]] } else { Vec::new() };
    };
    angles.push(first + TAU);
    angles
        .windows(2)
        .map(|w| [w[0], w[1]])
        .filter(|[a, b]| b > a && inside(0.5 * (a + b)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn circles_are_cut_at_the_edge_of_the_paper() {
        let window = Rect::new(Point::ORIGIN, Point::new(10.0, 10.0));
        assert_eq!(arcs(window, Point::new(5.0, 5.0), 3.0), [[0.0, TAU]]);
        assert!(arcs(window, Point::new(5.0, 5.0), 30.0).is_empty());
        // A window with a corner at the circle's centre holds a quarter.
        let quarter = arcs(window, Point::ORIGIN, 4.0);
        let total: f64 = quarter.iter().map(|[a, b]| b - a).sum();
        assert!((total - TAU / 4.0).abs() < 1e-12, "{quarter:?}");
        // A circle so large that it appears as a straight line.
        let flat = arcs(window, Point::new(5.0, 1e7 + 5.0), 1e7);
        let length: f64 = flat.iter().map(|[a, b]| (b - a) * 1e7).sum();
        assert!((length - 10.0).abs() < 1e-6, "{flat:?}");
    }
}
