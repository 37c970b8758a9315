//! On which side of a fixed pivot its support stands.

use crate::figure::extent::Rect;
use crate::geom::{Point, Vec2};
use crate::scene::PointId;

use super::{Draft, form};

/// A link this near to the direction of a support's triangle (cosine) would be drawn over it.
const OVER_SUPPORT: f64 = 0.6;
/// What speaks against a side for a support, most gravely first: a link over the triangle, another support's hatching, a plate behind it, a given
/// angle's arc across it, and that it is not below, where readers look for the ground.
const LINK_COST: f64 = 4.0;
const HATCHING_COST: f64 = 3.5;
const PLATE_COST: f64 = 3.0;
const ANGLE_COST: f64 = 2.0;
const OTHER_COST: f64 = 1.0;
/// Pivots farther apart than this have room for two supports side by side.
const NEAR_MM: f64 = 22.0;

impl Draft<'_> {
    /// From a fixed pivot to its ground: down, unless something is in the way and another side is freer.
    pub(super) fn support_side(&self, p: PointId) -> Vec2 {
        if let Some(side) = self.course.supports.get(p.0) {
            return *side;
        }
        let down = Vec2::new(0.0, -1.0);
        let Some(at) = self.point(p) else { return down };
        let leaving = self.leaving(p);
        let given = self.given_angles(p);
        // Supports of pivots near by that come first in the scene keep their side.
        let near = |q: &PointId| self.is_fixed_pivot(*q) && self.point(*q).is_some_and(|o| o.distance(at) < NEAR_MM);
        let before: Vec<Rect> =
            (0..p.0).map(PointId).filter(near).filter_map(|q| Some(self.support_box(self.point(q)?, self.support_side(q)))).collect();
        let cost = |u: &Vec2| {
            let link = leaving.iter().any(|v| v.dot(*u) > OVER_SUPPORT);
            let foot = at + *u * self.style.pivot_height_mm;
            let plate = self.forms.iter().flatten().any(|f| form::inside(foot, &f.plate));
            let angle = given.iter().any(|(from, sweep)| form::sweeps(*from, *sweep, u.angle()));
            let over = before.iter().any(|b| b.overlap_mm2(self.support_box(at, *u)) > 0.0);
            [(link, LINK_COST), (over, HATCHING_COST), (plate, PLATE_COST), (angle, ANGLE_COST), (*u != down, OTHER_COST)]
                .iter()
                .filter(|c| c.0)
                .map(|c| c.1)
                .sum::<f64>()
        };
        let sides = [down, Vec2::new(0.0, 1.0), Vec2::new(-1.0, 0.0), Vec2::new(1.0, 0.0)];
        sides.into_iter().min_by(|a, b| cost(a).total_cmp(&cost(b))).unwrap_or(down)
    }

    /// The box around the ground line and the hatching of a support.
    fn support_box(&self, at: Point, down: Vec2) -> Rect {
        let style = self.style;
        let foot = at + down * style.pivot_height_mm;
        let half = down.perp() * (style.ground_half_mm + style.hatch_depth_mm);
        Rect::new(foot + half, foot - half).union(Rect::new(foot, foot + down * style.hatch_depth_mm))
    }
}
