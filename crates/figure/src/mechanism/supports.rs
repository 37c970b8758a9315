//! Chooses the side of a fixed pivot for its support.

use hodograph_base::geom::{Point, Vec2};
use hodograph_paper::paper::extent::Rect;
use hodograph_scene::PointId;

use super::{MechanismDraft, form};

/// A link nearer to the direction of a support's triangle than this (cosine) would cover it.
const OVER_SUPPORT: f64 = 0.6;
/// Costs of a side for a support, in decreasing order: a link over the triangle, another support's
/// hatching, a plate behind it, the arc of a given angle across it, and any side but below, where
/// readers look for the ground.
const LINK_COST: f64 = 4.0;
const HATCHING_COST: f64 = 3.5;
const PLATE_COST: f64 = 3.0;
const ANGLE_COST: f64 = 2.0;
const OTHER_COST: f64 = 1.0;
/// Pivots farther apart than this have space for two supports side by side.
const NEAR_MM: f64 = 22.0;
/// The direction in which readers look for the ground.
const DOWN: Vec2 = Vec2::new(0.0, -1.0);

/// The side of a pivot for its support that costs least: of equal ones down, up, left or right, in
/// this order.
pub(crate) fn cheapest_side(cost: impl Fn(&Vec2) -> f64) -> Vec2 {
    let sides = [DOWN, Vec2::new(0.0, 1.0), Vec2::new(-1.0, 0.0), Vec2::new(1.0, 0.0)];
    sides.into_iter().min_by(|a, b| cost(a).total_cmp(&cost(b))).unwrap_or(DOWN)
}

/// True if a line that leaves a pivot in this direction would cover a support on a side.
pub(crate) fn is_over_support(leaving: Vec2, side: Vec2) -> bool {
    leaving.dot(side) > OVER_SUPPORT
}

impl MechanismDraft<'_> {
    /// The direction from a fixed pivot to its ground: down, unless something is in the way and
    /// another side is freer.
    pub(super) fn support_side(&self, p: PointId) -> Vec2 {
        self.course.supports.get(p.0).or_else(|| self.supports.get(p.0)).copied().unwrap_or(DOWN)
    }

    /// The side of each point's support, in the order of the scene: of neighbouring pivots the
    /// first ones keep their side.
    pub(super) fn support_sides(&self) -> Vec<Vec2> {
        let mut boxes: Vec<(Point, Rect)> = Vec::new();
        (0..self.scene.points.len())
            .map(PointId)
            .map(|p| {
                let Some(at) = self.point(p).filter(|_| self.is_fixed_pivot(p)) else {
                    return DOWN;
                };
                let before: Vec<Rect> =
                    boxes.iter().filter(|(o, _)| o.distance(at) < NEAR_MM).map(|b| b.1).collect();
                let side = self.freest_side(p, at, &before);
                boxes.push((at, self.support_box(at, side)));
                side
            })
            .collect()
    }

    fn freest_side(&self, p: PointId, at: Point, before: &[Rect]) -> Vec2 {
        let leaving = self.leaving(p);
        let given = self.given_angles(p);
        let cost = |u: &Vec2| {
            let link = leaving.iter().any(|v| is_over_support(*v, *u));
            let foot = at + *u * self.style.pivot_height_mm;
            let plate = self.forms.iter().flatten().any(|f| form::inside(foot, &f.plate));
            let angle = given.iter().any(|(from, sweep)| form::sweeps(*from, *sweep, u.angle()));
            let over = before.iter().any(|b| b.overlap_mm2(self.support_box(at, *u)) > 0.0);
            [
                (link, LINK_COST),
                (over, HATCHING_COST),
                (plate, PLATE_COST),
                (angle, ANGLE_COST),
                (*u != DOWN, OTHER_COST),
            ]
            .iter()
            .filter(|c| c.0)
            .map(|c| c.1)
            .sum::<f64>()
        };
        cheapest_side(cost)
    }

    /// The box around the ground line and the hatching of a support.
    fn support_box(&self, at: Point, down: Vec2) -> Rect {
        let style = self.style;
        let foot = at + down * style.pivot_height_mm;
        let half = down.perp() * (style.ground_half_mm + style.hatch_depth_mm);
        Rect::new(foot + half, foot - half)
            .union(Rect::new(foot, foot + down * style.hatch_depth_mm))
    }
}
