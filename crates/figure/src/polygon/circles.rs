//! Draws image circles: a circle that rolls on the mechanism is also a circle in the polygon.
//!
//! By the image theorem the image of a link's pitch circle is a circle about the image point of its
//! centre through the image point of its contact. Its radius is |ω| r/μ_v, and r √(α² + ω⁴)/μ_a. In
//! the velocity polygon the circles of a pair touch in the image point of the contact, because its
//! two points have the same velocity; in the acceleration polygon they need not touch, because only
//! the components along the common tangent agree.

use std::f64::consts::TAU;

use crate::tables::found_by;
use hodograph_base::geom::{Point, Vec2};
use hodograph_paper::paper::drawing::Drawing;
use hodograph_paper::paper::item::{Dash, Shape};
use hodograph_paper::paper::style::Style;
use hodograph_scene::{LinkId, PointId};

use super::{PolygonDraft, SAME_MM};

/// A smaller circle is hidden by the letters at its centre.
const LEAST_MM: f64 = 4.0;
/// Maximum diameter of a complete circle, relative to the polygon: a circle about the pole through
/// the farthest image point is twice as large as the polygon, and would leave the vectors, which
/// are to be read, in a corner of the paper. Of a larger circle only the arc at the contact is
/// drawn.
const LARGEST: f64 = 1.5;
/// Half the angle of the arc drawn of a circle that is too large: on either side of the contact it
/// deviates from its tangent by an eighth of the arc's length.
const ARC_RAD: f64 = 0.5;

/// The image of a pitch circle, on paper.
pub(super) struct Circle {
    pub centre: Point,
    /// The image point of the contact.
    pub through: Point,
    link: LinkId,
    /// The index of the action after which both are known.
    step: usize,
    /// True if there is space for the complete circle.
    whole: bool,
}

impl Circle {
    fn radius_mm(&self) -> f64 {
        self.centre.distance(self.through)
    }

    /// Returns the corners of the box around the drawn part: for an arc its ends and its middle.
    pub fn corners(&self) -> Vec<Point> {
        let r = self.radius_mm();
        if self.whole {
            let half = Vec2::new(r, r);
            return vec![self.centre - half, self.centre + half];
        }
        let along = (self.through - self.centre).angle();
        [-ARC_RAD, 0.0, ARC_RAD].map(|a| self.centre + Vec2::from_angle(along + a) * r).to_vec()
    }
}

impl PolygonDraft<'_> {
    /// The image circles of a polygon, each once.
    pub(super) fn image_circles(&self) -> Vec<Circle> {
        let scene = self.w.scene;
        let mut all: Vec<Circle> = Vec::new();
        for pair in &scene.rolling {
            for (link, centre) in pair.links.into_iter().zip(pair.centres()) {
                let (Some(centre), true) = (centre, link != scene.ground) else { continue };
                let (Some((centre, a)), Some((through, b))) =
                    (self.image_of(centre, link), self.image_of(pair.at_of(link), link))
                else {
                    continue;
                };
                let circle = Circle { centre, through, link, step: a.max(b), whole: true };
                let same = |c: &Circle| {
                    c.link == link
                        && c.centre.distance(centre) < SAME_MM
                        && (c.radius_mm() - circle.radius_mm()).abs() < SAME_MM
                };
                if circle.radius_mm() >= LEAST_MM && !all.iter().any(same) {
                    all.push(circle);
                }
            }
        }
        let size = self.size_mm();
        all.iter_mut().for_each(|c| c.whole = 2.0 * c.radius_mm() <= LARGEST * size);
        all
    }

    /// The image point of a point of a link, and the index of the action that finds it.
    fn image_of(&self, p: PointId, link: LinkId) -> Option<(Point, usize)> {
        let (scene, plan) = (self.w.scene, self.w.plan);
        if scene.links[scene.ground.0].points.contains(&p) {
            return Some((Point::ORIGIN, 0));
        }
        let v =
            plan.find_vertex(scene, p, Some(link)).or_else(|| plan.find_vertex(scene, p, None))?;
        Some((self.p.images[v.0]?, found_by(self.p, v).unwrap_or(0)))
    }

    /// The longer side of the box around the image points.
    fn size_mm(&self) -> f64 {
        let all = || self.letters.iter().map(|l| l.at);
        let side = |of: fn(Point) -> f64| {
            all().map(of).fold(f64::NEG_INFINITY, f64::max)
                - all().map(of).fold(f64::INFINITY, f64::min)
        };
        side(|p| p.x).max(side(|p| p.y))
    }

    /// Draws the image circles behind the vectors.
    pub(super) fn circles(&self, d: &mut Drawing, style: &Style) {
        for c in self.image_circles() {
            let along = (c.through - c.centre).angle();
            let (from_rad, to_rad) =
                if c.whole { (along, along + TAU) } else { (along - ARC_RAD, along + ARC_RAD) };
            let stroke = style.thin.dashed(Dash::DashDot);
            let shape =
                Shape::Arc { centre: c.centre, radius_mm: c.radius_mm(), from_rad, to_rad, stroke };
            d.of_link(Some(c.link.0));
            d.shape(
                &format!("circle-{}", self.w.scene.link_name(c.link)),
                &format!("circle step-{}", c.step),
                shape,
            );
        }
        d.of_link(None);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hodograph_base::notation::Notation;
    use hodograph_board::plan::text::PlanWriter;
    use hodograph_scene::{DiagramKind, Lang, read};
    use hodograph_worked::worked::{Scope, work};

    /// A planet on a sun that turns, inside a ring that turns: all circles except that of the arm.
    const DIFFERENTIAL: &str = r#"{"units": {"length": "mm", "angle": "deg"},
        "links": {"1": ["O"], "2": ["O", "Q"], "3": ["Q"], "4": ["O"], "5": ["O"]}, "ground": "1", "points": {"O": [0, 0], "Q": [42, 56]},
        "gears": [{"links": ["4", "3"], "centres": ["O", "Q"], "radii": [40, 30], "at": "K"},
                  {"links": ["3", "5"], "centres": ["Q", "O"], "radii": [30, 100], "ring": "5", "at": "E"}],
        "driver": [{"link": "4", "omega": "7 rad/s", "alpha": "-3 rad/s^2"}, {"link": "5", "omega": "-2 rad/s", "alpha": "4 rad/s^2"}],
        "find": ["omega_2", "omega_3", "alpha_2", "alpha_3", "a_K3", "a_K4", "a_E3", "a_E5"]}"#;

    /// For each circle of a polygon: link, centre, image point of the contact, radius; and the
    /// polygon's scale.
    fn circles(text: &str, on: DiagramKind) -> (Vec<(String, Circle)>, f64) {
        let scene = read(text).unwrap().value;
        let worked = work(&scene, Scope::Figure).unwrap().value;
        let notation = Notation::of_language(Lang::En);
        let w =
            PlanWriter { scene: &scene, plan: &worked.plan, notation: &notation, lang: Lang::En };
        let p = worked.construction.polygon(on).unwrap();
        let all = PolygonDraft::of(&w, p).image_circles();
        (all.into_iter().map(|c| (scene.link_name(c.link).to_owned(), c)).collect(), p.mu)
    }

    #[test]
    fn radii_are_those_of_the_motion() {
        let (r, omega, alpha) =
            ([0.04, 0.03, 0.1], [7.0_f64, -8.0, -2.0], [-3.0_f64, 26.0 / 3.0, 4.0]);
        let index = |name: &str| ["4", "3", "5"].iter().position(|n| *n == name).unwrap();
        for on in DiagramKind::POLYGONS {
            let (all, mu) = circles(DIFFERENTIAL, on);
            assert_eq!(all.len(), 3, "sun, planet (once for two contacts), ring");
            for (name, c) in all {
                let k = index(&name);
                let rate = if on == DiagramKind::Velocity {
                    omega[k].abs()
                } else {
                    (alpha[k].powi(2) + omega[k].powi(4)).sqrt()
                };
                let wanted = rate * r[k] / mu;
                assert!(
                    (c.radius_mm() - wanted).abs() < 1e-9 * wanted,
                    "{name} at {on:?}: {} and not {wanted}",
                    c.radius_mm()
                );
            }
        }
    }

    #[test]
    fn in_velocities_those_of_a_pair_touch() {
        let (all, _) = circles(DIFFERENTIAL, DiagramKind::Velocity);
        let of = |name: &str| {
            all.iter().find(|(n, _)| n == name).map(|(_, c)| (c.centre, c.radius_mm())).unwrap()
        };
        let ((o, sun), (q, planet), (_, ring)) = (of("4"), of("3"), of("5"));
        let apart = o.distance(q);
        // Two circles touch externally or internally, depending on the angular velocities.
        let touch = |a: f64, b: f64| {
            (apart - a - b).abs().min((apart - (a - b).abs()).abs()) < 1e-9 * (a + b)
        };
        assert!(touch(sun, planet) && touch(planet, ring), "{apart} {sun} {planet} {ring}");
    }

    #[test]
    fn a_circle_that_would_swamp_the_polygon_is_an_arc() {
        let (all, _) = circles(DIFFERENTIAL, DiagramKind::Velocity);
        assert!(
            all.iter().any(|(_, c)| c.whole)
                && all
                    .iter()
                    .all(|(_, c)| c.whole || 2.0 * c.radius_mm() > c.radius_mm() * LARGEST)
        );
    }
}
