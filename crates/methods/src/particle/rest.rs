//! Points of the plane with a place and no motion: they are at rest. A problem contains such a
//! point if a pursuer runs toward it or a question names it: a buoy, a radar station.

use super::law::PathLaw;
use super::{ParticleMotion, ParticleMotionKind, ParticleProblem, ask};
use hodograph_base::diag::Span;
use hodograph_base::json::Word;
use hodograph_scene::front::Law;

/// A place with its name.
pub(super) type RestPoint = (Word, [Law; 2]);

/// Returns a point at rest.
pub(super) fn still((name, place): &RestPoint) -> ParticleMotion {
    ParticleMotion {
        point: name.text.clone(),
        kind: ParticleMotionKind::Fixed(PathLaw::Free(place.clone())),
    }
}

/// Returns the places that questions name, as points at rest.
pub(super) fn asked<'a>(
    problem: &ParticleProblem,
    places: impl Iterator<Item = &'a RestPoint>,
    questions: &[&str],
) -> Vec<ParticleMotion> {
    let mut all = problem.clone();
    let moved = all.motions.len();
    all.motions.extend(places.map(still));
    let found = questions.iter().filter_map(|text| ask::meaning(&all, text, Span::new(0, 0)).ok());
    let named: Vec<usize> = found.flat_map(|f| f.what.motions()).collect();
    all.motions
        .into_iter()
        .enumerate()
        .skip(moved)
        .filter(|(k, _)| named.contains(k))
        .map(|(_, m)| m)
        .collect()
}
