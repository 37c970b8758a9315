//! Draws belts and chains as strands, tangent to successive wheels, and ropes from their drum to
//! the load. The wheels are circles like those of other pairs ([`super::wheels`]).

use super::MechanismDraft;
use hodograph_base::geom::{Point, Vec2};
use hodograph_mechanism::position::{Path, belt};
use hodograph_paper::paper::item::Shape;
use hodograph_scene::{Contours, GuideId, Rolling};

/// A wheel in its belt, on paper; its radius is negative if the belt runs round it
/// counter-clockwise.
struct BeltWheel {
    centre: Point,
    radius_mm: f64,
}

impl MechanismDraft<'_> {
    /// Draws the strands of all belts and chains with visible wheels.
    pub(super) fn belts(&mut self) {
        let scene = self.scene;
        let mut strands: Vec<&Rolling> =
            scene.rolling.iter().filter(|p| p.belt().is_some()).collect();
        while let Some(first) = strands.first().copied() {
            let own: Vec<&Rolling> = strands.extract_if(.., |p| p.belt() == first.belt()).collect();
            let stroke = self.contour_stroke(first);
            let all_shown =
                own.iter().flat_map(|p| p.links).all(|l| l == scene.ground || self.shows(l));
            let Some(wheels) = self.wheels_of(&own).filter(|_| all_shown) else { continue };
            let id = format!("belt-{}", scene.point_name(first.at[0]));
            let next = wheels.iter().cycle().skip(1);
            for (from, to) in wheels.iter().zip(next) {
                if let Some([from, to]) = tangent(from, to) {
                    self.d.shape(&id, "belt", Shape::Line { from, to, stroke });
                }
            }
        }
    }

    /// Draws a rope, from the drum to its load.
    pub(super) fn rope(&mut self, pair: &Rolling, guide: GuideId) {
        let (Some(at), Some(Path::Line { direction, .. })) =
            (self.point(pair.at[0]), self.guide(guide))
        else {
            return;
        };
        let held = self.scene.links[pair.links[0].0].points.iter().filter_map(|p| self.point(*p));
        let foot = |p: Point| at + direction * (p - at).dot(direction);
        let Some(p) = held.max_by(|p, q| foot(*q).distance(*q).total_cmp(&foot(*p).distance(*p)))
        else {
            return;
        };
        let id = format!("rope-{}", self.scene.point_name(pair.at[0]));
        let stroke = self.style.outline;
        for (from, to) in [(at, foot(p)), (foot(p), p)]
            .into_iter()
            .filter(|(from, to)| from.distance(*to) > super::SAME_MM)
        {
            self.d.shape(&id, "belt", Shape::Line { from, to, stroke });
        }
    }

    /// The wheels of a belt, in their order along it.
    fn wheels_of(&self, strands: &[&Rolling]) -> Option<Vec<BeltWheel>> {
        let mut wheels: Vec<BeltWheel> = Vec::with_capacity(strands.len() + 1);
        for pair in strands {
            let Contours::Belt { centres: [a, b], crossed, right, .. } = pair.contours else {
                return None;
            };
            let wheel = |k: usize, centre, sense: f64| -> Option<BeltWheel> {
                let centre = self.point(centre)?;
                Some(BeltWheel {
                    centre,
                    radius_mm: sense * centre.distance(self.point(pair.at[k])?),
                })
            };
            if wheels.is_empty() {
                wheels.push(wheel(0, a, if right { -1.0 } else { 1.0 })?);
            }
            let before = wheels.last().map_or(1.0, |w| w.radius_mm.signum());
            wheels.push(wheel(1, b, if crossed { -before } else { before })?);
        }
        Some(wheels)
    }
}

/// The ends of the strand from one wheel to another.
fn tangent(from: &BeltWheel, to: &BeltWheel) -> Option<[Point; 2]> {
    let line = to.centre - from.centre;
    let [cos, sin] = belt::normal([from.radius_mm, -to.radius_mm], line.norm())?;
    let m = Vec2::new(cos, sin).rotate_by(line.unit()?);
    Some([from.centre + m * from.radius_mm, to.centre + m * to.radius_mm])
}
