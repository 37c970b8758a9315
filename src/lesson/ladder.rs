//! The scales of a polygon over all positions: one for the usual ones, smaller drawings where the vectors are much longer.
//!
//! One scale shows by the eye where a mechanism is fast. Where it is many times as fast in a few positions as in most, that scale
//! would leave the usual polygons too small to be read: then those few are drawn to a coarser scale, and the page says so.

use crate::construct::scale::{self, Boxes, coarser};
use crate::figure::series::{Scales, ends, size};
use crate::geom::Point;
use crate::mechanism::Level;
use crate::scene::Paper;
use crate::worked::Worked;

/// While the longest polygon is no more than so many times the usual one, one scale serves all.
const EVEN: f64 = 1.6;
/// The usual polygon is that of the scene's own pose, with which a lesson begins and which is printed; it is not taken for smaller
/// than this part of what half of all poses have.
const OF_HALF: f64 = 0.5;
/// How much larger a part of their paper the usual polygons must become by a second scale to be worth it.
const GAIN: f64 = 1.3;
/// From one scale to the next a drawing becomes at least so many times smaller: not every position is to have its own.
const STEP: f64 = 2.0;

/// The scales of one polygon.
#[derive(Clone, Debug, PartialEq)]
pub struct Ladder {
    level: Level,
    boxes: Boxes,
    /// From the usual one to the coarsest (SI/mm).
    pub mu: Vec<f64>,
    /// The largest polygon on the paper (in boxes of a millimetre), where there is more than one scale.
    largest: f64,
}

impl Ladder {
    /// The scales of a polygon that `common` has one scale for; `None` where there is no such polygon. Poses come with the
    /// driver's travel; the one nearest to the scene's own has the first scale.
    pub fn of(paper: &Paper, poses: &[(f64, &Worked)], common: &Scales, level: Level, boxes: Boxes) -> Option<Ladder> {
        let later = level == Level::Acceleration;
        let one = common.mu[usize::from(later)]?;
        let alone = Ladder { level, boxes, mu: vec![one], largest: f64::INFINITY };
        let on_paper = |w: &&Worked| common.holds(w, level);
        let sized = |w: &Worked| size(w, level, &boxes).unwrap_or(0.0);
        let mut sizes: Vec<f64> = poses.iter().map(|p| p.1).filter(on_paper).map(sized).collect();
        sizes.sort_by(f64::total_cmp);
        let own = poses.iter().min_by(|a, b| a.0.abs().total_cmp(&b.0.abs())).map_or(0.0, |p| sized(p.1));
        let usual = own.max(OF_HALF * sizes.get(sizes.len() / 2).copied().unwrap_or(0.0));
        let most = sizes.last().copied().unwrap_or(0.0);
        let fixed = if later { paper.mu_a } else { paper.mu_v };
        if fixed.is_some() || usual == 0.0 || most <= EVEN * usual {
            return Some(alone);
        }
        // The pole stands still, and polygons reach from it to all sides: the paper holds them all, the longer ones shortened.
        let room = |longest: f64| {
            let held = poses.iter().map(|p| p.1).filter(on_paper).flat_map(|w| {
                let part = (longest / sized(w)).min(1.0);
                ends(w, level).map(move |p| (p.to_vec2() * part).to_point())
            });
            scale::extent(held.chain([Point::ORIGIN]))
        };
        let [all, shortened] = [room(most), room(usual)];
        let needed = |[w, h]: [f64; 2]| (w / boxes.polygon[0]).max(h / boxes.polygon[1]);
        if needed(all) < GAIN * needed(shortened) {
            return Some(alone);
        }
        let unit = paper.unit(level as usize);
        let mut mu = vec![scale::choose_in(unit, shortened, boxes.polygon)];
        // Divided alike when a place is looked for, so that the usual polygon itself is held.
        let largest = usual / mu[0];
        while most / mu[mu.len() - 1] > largest {
            mu.push(coarser(unit, mu[mu.len() - 1], STEP));
        }
        Some(Ladder { level, boxes, mu, largest })
    }

    /// Which of the scales a pose's polygon has: the finest that holds it.
    pub fn place(&self, worked: &Worked) -> usize {
        let size = size(worked, self.level, &self.boxes).unwrap_or(0.0);
        self.mu.iter().position(|mu| size / mu <= self.largest).unwrap_or(self.mu.len() - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{self, Scene, templates};
    use crate::scene::{driver_position, with_driver_at};
    use crate::worked::{Scope, work};

    fn poses(scene: &Scene) -> Vec<(f64, Worked)> {
        let start = driver_position(scene, 0).unwrap();
        let at = |travel: f64| (travel, work(&with_driver_at(scene, 0, start + travel), Scope::Figure).unwrap().value);
        (0..24).map(|k| at(f64::from(k) * std::f64::consts::TAU / 24.0)).collect()
    }

    fn ladder(scene: &Scene, poses: &[(f64, Worked)]) -> Ladder {
        let poses: Vec<(f64, &Worked)> = poses.iter().map(|(t, w)| (*t, w)).collect();
        let common = Scales::of(&scene.paper, &poses, true, Boxes::default());
        Ladder::of(&scene.paper, &poses, &common, Level::Acceleration, Boxes::default()).unwrap()
    }

    #[test]
    fn every_polygon_has_the_finest_scale_that_holds_it() {
        let mut scene = scene::read(templates::get("whitworth").unwrap()).unwrap().value;
        let poses = poses(&scene);
        let all = ladder(&scene, &poses);
        assert!(all.mu.len() > 1 && all.mu.windows(2).all(|m| m[1] >= STEP * m[0]), "{:?}", all.mu);
        assert_eq!(all.place(&poses[0].1), 0, "the given position has the first");
        let part = |k: usize| {
            let place = all.place(&poses[k].1);
            (place, size(&poses[k].1, Level::Acceleration, &Boxes::default()).unwrap() / all.mu[place] / all.largest)
        };
        for (k, _) in poses.iter().enumerate() {
            let (place, part) = part(k);
            // From one scale of the series to the next it is 2 or 2.5.
            assert!(part <= 1.0 && (place == 0 || part > 0.4 * (1.0 - 1e-12)), "{k}: {place}, {part}");
        }
        scene.paper.mu_a = Some(3.0);
        assert_eq!(ladder(&scene, &poses).mu, [3.0], "what the scene fixes stays");
    }

    #[test]
    fn where_all_are_of_a_size_one_scale_serves() {
        let scene = scene::read(templates::get("scotch-yoke").unwrap()).unwrap().value;
        assert_eq!(ladder(&scene, &poses(&scene)).mu.len(), 1);
    }
}
