//! Which of the closures of a group is meant: by the sides the scene names, by its sketch, else by a stated default.

use super::Pose;
use super::shape::given_at;
use crate::diag::Diagnostic;
use crate::geom::Point;
use crate::number::Real;
use crate::scene::{LinkId, PointId, Scene};

/// One closure of a group: where its pins and links (and the points on them) would be.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Trial<N> {
    /// All points placed by this closure: pins first, then the points of the links.
    pub points: Vec<(PointId, Point<N>)>,
    /// The links' poses.
    pub poses: Vec<(LinkId, Pose<N>)>,
}

impl<N: Real> Trial<N> {
    fn at(&self, p: PointId) -> Option<Point<N>> {
        self.points.iter().find(|(q, _)| *q == p).map(|(_, at)| *at)
    }
}

/// Whether all closures lie so close together, relative to the size of the mechanism, that rounding may have hidden from
/// `f64` which is which: near a limit they differ by the root of the distance from it, and `f64` leaves of that root some 1e-8 in doubt.
pub(super) fn alike<N: Real>(trials: &[Trial<N>], extent: f64) -> bool {
    const CLOSE: f64 = 1e-7;
    let near = |t: &Trial<N>| t.points.iter().zip(&trials[0].points).all(|(a, b)| (a.1 - b.1).approx().norm() <= CLOSE * extent);
    trials.len() > 1 && trials.iter().all(near)
}

/// Picks one of several closures. `placed` are the points known before the group. The note tells when nothing in the
/// scene decided.
pub(super) fn choose<N: Real>(
    scene: &Scene,
    placed: &[Option<Point<N>>],
    trials: &[Trial<N>],
    link_names: &dyn Fn() -> String,
) -> Result<(usize, Option<Diagnostic>), Diagnostic> {
    if trials.len() < 2 || trials.iter().all(|t| t.points == trials[0].points && t.poses == trials[0].poses) {
        return Ok((0, None));
    }
    let mut left: Vec<usize> = (0..trials.len()).collect();
    let mut decided = false;
    for side in &scene.sides {
        let mine = |t: &Trial<N>, p: PointId| t.at(p).or(placed[p.0]);
        let concerns = [side.point, side.from, side.to].iter().any(|p| trials[0].at(*p).is_some());
        let known = |t: &Trial<N>| Some((mine(t, side.point)?, mine(t, side.from)?, mine(t, side.to)?));
        if !concerns || known(&trials[0]).is_none() {
            continue;
        }
        let kept: Vec<usize> = left
            .iter()
            .copied()
            .filter(|&i| {
                // Numbers that know their error must be sure of the side.
                let area = known(&trials[i]).map(|(p, a, b)| (b - a).cross(p - a));
                area.is_some_and(|area| area.approx() * if side.left { 1.0 } else { -1.0 } > area.radius())
            })
            .collect();
        if kept.is_empty() {
            return Err(Diagnostic::error(
                "side-impossible",
                format!(
                    "in none of the {} assemblies of link{} does {} lie to the {} of {}{}",
                    trials.len(),
                    link_names(),
                    scene.point_name(side.point),
                    if side.left { "left" } else { "right" },
                    scene.point_name(side.from),
                    scene.point_name(side.to)
                ),
            )
            .at(side.span));
        }
        decided |= kept.len() < left.len();
        left = kept;
    }
    let sketch = |p: PointId| scene.points[p.0].sketch.map(|s| Point::new(s[0], s[1])).or(given_at(scene, p));
    if left.len() > 1 {
        // The sum of squared distances to all sketched points of the group.
        let cost = |i: usize| {
            let off = trials[i].points.iter().filter_map(|(p, at)| sketch(*p).map(|s| (s.lift() - *at).norm2()));
            off.fold(N::from_f64(0.0), |sum, x| sum + x)
        };
        if trials[0].points.iter().any(|(p, _)| sketch(*p).is_some()) {
            let best = left.iter().copied().min_by(|a, b| (cost(*a) - cost(*b)).approx().total_cmp(&0.0)).expect("at least two are left");
            return Ok((best, None));
        }
    }
    let note = (!decided && left.len() > 1).then(|| {
        let moved = trials[left[0]].points.iter().find_map(|(p, at)| {
            let other = trials[left[1]].at(*p).map(Point::approx).filter(|o| *o != at.approx())?;
            Some((scene.point_name(*p), at.approx(), other))
        });
        let (which, hint) = match moved {
            Some((p, at, other)) => (
                format!("the one with {p} at {} was taken, not the one with {p} at {}", place(at), place(other)),
                format!("a rough place of {p} in \"sketch\""),
            ),
            None => ("the first was taken".to_string(), "rough places in \"sketch\"".to_string()),
        };
        Diagnostic::note(
            "assembly-by-default",
            format!("link{} can be assembled in {} ways and the scene does not say which: {which}", link_names(), left.len()),
        )
        .help(format!("say it with \"side\" or {hint}"))
    });
    Ok((left[0], note))
}

fn place(p: Point) -> String {
    format!("({}, {})", crate::quantity::metres(p.x), crate::quantity::metres(p.y))
}
