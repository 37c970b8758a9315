//! Features that the drawings of a series share: the travel of each runner in its guide, and the
//! side of the ground.
//!
//! This module keeps the ground the same in all drawings. It does not choose the best side for one
//! pose.

use hodograph_base::budget::here;
use rayon::prelude::*;
use std::collections::BTreeMap;

use hodograph_base::geom::Vec2;
use hodograph_base::notation::Notation;
use hodograph_mechanism::position::{Path, Pose};
use hodograph_scene::{Guide, LinkId, Scene};
use hodograph_worked::worked::Worked;

use super::mechanism::SeriesFeatures;
use hodograph_paper::paper::memory::LabelMemory;
use hodograph_paper::paper::style::Style;

/// Returns the course of each pose.
pub fn courses(
    poses: &[(&Scene, &Worked)],
    style: &Style,
    notation: &Notation,
) -> Vec<SeriesFeatures> {
    let here = here();
    let of_one = |(scene, worked): &(&Scene, &Worked)| {
        here.enter(|| SeriesFeatures::of_one(style, scene, worked, notation))
    };
    let alone: Vec<SeriesFeatures> = poses.par_iter().map(of_one).collect();
    let (mut supports, mut guides) = (BTreeMap::new(), BTreeMap::new());
    for ((scene, _), course) in poses.iter().zip(&alone) {
        for (point, side) in scene.points.iter().zip(&course.supports) {
            supports.entry(point.name.as_str()).or_insert_with(Vec::new).push(*side);
        }
        for (guide, side) in scene.guides.iter().zip(&course.hatched) {
            guides.entry(Runs::of(scene, guide)).or_insert_with(Vec::new).extend(*side);
        }
    }
    let supports: BTreeMap<&str, Vec2> = supports
        .into_iter()
        .filter_map(|(name, sides)| Some((name, usual(sides.into_iter())?)))
        .collect();
    let guides: BTreeMap<Runs, _> = guides
        .into_iter()
        .map(|(runs, sides)| (runs, (way(poses, runs), usual(sides.into_iter()))))
        .collect();
    let of_pose = |(k, (scene, _)): (usize, &(&Scene, &Worked))| SeriesFeatures {
        travel_mm: scene.guides.iter().map(|g| travel(&guides[&Runs::of(scene, g)].0, k)).collect(),
        supports: scene.points.iter().map(|p| supports[p.name.as_str()]).collect(),
        hatched: scene.guides.iter().map(|g| guides[&Runs::of(scene, g)].1).collect(),
    };
    poses.iter().enumerate().map(of_pose).collect()
}

/// Returns the features of the next pose of a series that is not known beforehand: the sides of its
/// first pose, the travel so far.
pub fn remembered(
    memory: &LabelMemory,
    style: &Style,
    scene: &Scene,
    worked: &Worked,
    notation: &Notation,
) -> SeriesFeatures {
    let alone = SeriesFeatures::of_one(style, scene, worked, notation);
    let named = |guide: &Guide| {
        let Runs { pin, slider, on } = Runs::of(scene, guide);
        format!("guide {pin:?} {slider:?} {on:?}")
    };
    let travel = |guide: &Guide| {
        let Some((s, round)) = place(scene, worked, Runs::of(scene, guide)) else {
            return [0.0; 2];
        };
        memory.span(&named(guide), s, round).map(|end| end - s)
    };
    let hatched = |(guide, side): (&Guide, &Option<Vec2>)| {
        side.map(|side| memory.first_side(&named(guide), side))
    };
    SeriesFeatures {
        travel_mm: scene.guides.iter().map(travel).collect(),
        supports: std::iter::zip(&scene.points, &alone.supports)
            .map(|(point, side)| memory.first_side(&point.name, *side))
            .collect(),
        hatched: scene.guides.iter().zip(&alone.hatched).map(hatched).collect(),
    }
}

/// Pin and block of a guide, and the link that carries it: together they identify the guide in
/// every pose. The contact of a cam is a guide in some poses only.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Runs<'a> {
    pin: Option<&'a str>,
    slider: Option<LinkId>,
    on: LinkId,
}

impl<'a> Runs<'a> {
    fn of(scene: &'a Scene, guide: &Guide) -> Runs<'a> {
        Runs { pin: guide.pin.map(|p| scene.point_name(p)), slider: guide.slider, on: guide.on }
    }
}

/// The most frequent value; the first one among equals.
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

/// The least and the greatest position along the guide, relative to that of pose `k`.
fn travel(way: &[Option<f64>], k: usize) -> [f64; 2] {
    let Some(here) = way[k] else { return [0.0, 0.0] };
    let known = way.iter().flatten();
    [known.clone().fold(here, |a, b| a.min(*b)) - here, known.fold(here, |a, b| a.max(*b)) - here]
}

/// Position of a guide's runner along the guide in each pose (mm of paper).
fn way(poses: &[(&Scene, &Worked)], runs: Runs) -> Vec<Option<f64>> {
    let mut last: Option<f64> = None;
    let places = poses.iter().map(|(scene, worked)| {
        let (s, round) = place(scene, worked, runs)?;
        // On a circle the position continues past a full turn.
        let s = match (last, round) {
            (Some(last), Some(round)) => s + ((last - s) / round).round() * round,
            _ => s,
        };
        last = Some(s);
        Some(s)
    });
    places.collect()
}

/// Position of a runner along its guide, and the circumference if the guide is a circle (mm).
fn place(scene: &Scene, worked: &Worked, runs: Runs) -> Option<(f64, Option<f64>)> {
    let at = &worked.configuration;
    let (g, guide) = scene.guides.iter().enumerate().find(|(_, g)| Runs::of(scene, g) == runs)?;
    let pose = |l: LinkId| if l == scene.ground { Some(Pose::GROUND) } else { at.poses[l.0] };
    let runner = match guide.pin {
        Some(p) => at.points[p.0]?,
        None => pose(guide.slider?)?.origin,
    };
    let path = at.shapes.guides[g]?;
    let mm = 1.0 / worked.construction.diagram.mu;
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
        assert_eq!(
            (travel(&way, 0), travel(&way, 1), travel(&way, 3)),
            ([-4.0, 2.0], [0.0, 0.0], [-6.0, 0.0])
        );
        assert_eq!(usual([1, 2, 2, 1, 3].into_iter()), Some(1));
    }
}
