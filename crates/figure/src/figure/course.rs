//! What the drawings of a series have in common: how far each runner goes in its guide, and on which side the ground lies.
//!
//! Decided here: that the ground stands still. Not decided here: which side is best in one pose.

use rayon::prelude::*;

use crate::plan::notation::Notation;
use crate::position::{Path, Pose};
use crate::scene::{GuideId, LinkId, Scene};
use crate::worked::Worked;

use super::mechanism::Course;
use crate::paper::style::Style;

/// The course of each pose.
pub fn courses(poses: &[(&Scene, &Worked)], style: &Style, notation: &Notation) -> Vec<Course> {
    let alone: Vec<Course> = poses.par_iter().map(|(scene, worked)| Course::of_one(style, scene, worked, notation)).collect();
    let Some((scene, _)) = poses.first() else { return Vec::new() };
    let supports: Vec<_> = (0..scene.points.len()).filter_map(|p| usual(alone.iter().filter_map(|c| c.supports.get(p).copied()))).collect();
    let hatched: Vec<_> =
        (0..scene.guides.len()).map(|g| usual(alone.iter().filter_map(|c| c.hatched.get(g).copied().flatten()))).collect();
    let ways: Vec<Vec<Option<f64>>> = (0..scene.guides.len()).map(|g| way(poses, GuideId(g))).collect();
    (0..poses.len())
        .map(|k| {
            let travel_mm = ways.iter().map(|way| travel(way, k)).collect();
            Course { travel_mm, supports: supports.clone(), hatched: hatched.clone() }
        })
        .collect()
}

/// The value that most poses have; of equals the first.
fn usual<T: PartialEq + Copy>(values: impl Iterator<Item = T>) -> Option<T> {
    let mut counts: Vec<(T, usize)> = Vec::new();
    for v in values {
        match counts.iter_mut().find(|(known, _)| *known == v) {
            Some((_, n)) => *n += 1,
            None => counts.push((v, 1)),
        }
    }
    let most = counts.iter().map(|c| c.1).max()?;
    counts.into_iter().find(|c| c.1 == most).map(|c| c.0)
}

/// From the least to the greatest place, seen from that of pose `k`.
fn travel(way: &[Option<f64>], k: usize) -> [f64; 2] {
    let Some(here) = way[k] else { return [0.0, 0.0] };
    let known = way.iter().flatten();
    [known.clone().fold(here, |a, b| a.min(*b)) - here, known.fold(here, |a, b| a.max(*b)) - here]
}

/// Where a guide's runner is along it in each pose, in mm of paper.
fn way(poses: &[(&Scene, &Worked)], g: GuideId) -> Vec<Option<f64>> {
    let mut last: Option<f64> = None;
    let places = poses.iter().map(|(scene, worked)| {
        let (s, round) = place(scene, worked, g)?;
        // On a circle the place goes on where the angle begins anew.
        let s = match (last, round) {
            (Some(last), Some(round)) => s + ((last - s) / round).round() * round,
            _ => s,
        };
        last = Some(s);
        Some(s)
    });
    places.collect()
}

/// A runner's place along its guide, and the way once round on a circle (mm).
fn place(scene: &Scene, worked: &Worked, g: GuideId) -> Option<(f64, Option<f64>)> {
    let at = &worked.configuration;
    let guide = &scene.guides[g.0];
    let pose = |l: LinkId| if l == scene.ground { Some(Pose::GROUND) } else { at.poses[l.0] };
    let runner = match guide.pin {
        Some(p) => at.points[p.0]?,
        None => pose(guide.slider?)?.origin,
    };
    let path = at.shapes.guides[g.0]?;
    let mm = 1.0 / worked.construction.diagram.mu_l;
    let s = path.coordinate_of(pose(guide.on)?.to_local(runner)) * mm;
    Some(match path {
        Path::Line { .. } => (s, None),
        Path::Arc { radius, .. } => (s, Some(std::f64::consts::TAU * radius * mm)),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn travel_is_seen_from_the_pose() {
        let way = [Some(3.0), None, Some(-1.0), Some(5.0)];
        assert_eq!((travel(&way, 0), travel(&way, 1), travel(&way, 3)), ([-4.0, 2.0], [0.0, 0.0], [-6.0, 0.0]));
        assert_eq!(usual([1, 2, 2, 1, 3].into_iter()), Some(1));
    }
}
