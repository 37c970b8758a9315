//! Selection of the closure of a group: by the sides in the scene, by its sketch, otherwise by a
//! stated default.

use super::Pose;
use super::shape::given_at;
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::digits::{direction_degrees, significant};
use hodograph_base::geom::Point;
use hodograph_base::number::Real;
use hodograph_scene::{LinkId, PointId, Scene, Side};

/// One closure of a group: positions of its pins, links and points.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct GroupClosure<N> {
    /// All points placed by this closure: pins first, then the points of the links.
    pub points: Vec<(PointId, Point<N>)>,
    /// Poses of the links.
    pub poses: Vec<(LinkId, Pose<N>)>,
}

impl<N: Real> GroupClosure<N> {
    pub(super) fn at(&self, p: PointId) -> Option<Point<N>> {
        self.points.iter().find(|(q, _)| *q == p).map(|(_, at)| *at)
    }
}

/// Returns true if all closures are so close together, relative to the size of the mechanism, that
/// `f64` may not distinguish them: near a limit they differ by the square root of the distance from
/// it, and rounding in `f64` makes some 1e-8 of that root uncertain.
pub(super) fn alike<N: Real>(trials: &[GroupClosure<N>], extent: f64) -> bool {
    const CLOSE: f64 = 1e-7;
    let near = |t: &GroupClosure<N>| {
        t.points
            .iter()
            .zip(&trials[0].points)
            .all(|(a, b)| (a.1 - b.1).approx().norm() <= CLOSE * extent)
    };
    trials.len() > 1 && trials.iter().all(near)
}

/// The selected closure.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct ClosureChoice {
    /// Its index.
    pub pick: usize,
    /// Number of closures from which it is selected if nothing in the scene decides; otherwise 0.
    pub open: usize,
    /// A note for the reader: nothing in the scene decides, or a side does not.
    pub note: Option<Diagnostic>,
}

/// Selects one of several closures. `placed` contains the points known before the group. If nothing
/// in the scene decides, the remaining closure with the index `instead` is taken, with a note.
pub(super) fn choose<N: Real>(
    scene: &Scene,
    placed: &[Option<Point<N>>],
    trials: &[GroupClosure<N>],
    instead: usize,
    link_names: &dyn Fn() -> Both,
) -> Result<ClosureChoice, Diagnostic> {
    if trials.len() < 2
        || trials.iter().all(|t| t.points == trials[0].points && t.poses == trials[0].poses)
    {
        return Ok(ClosureChoice::default());
    }
    let mut left: Vec<usize> = (0..trials.len()).collect();
    // The last side that concerns this group but excludes no closure.
    let mut idle: Option<&Side> = None;
    for side in &scene.sides {
        let mine = |t: &GroupClosure<N>, p: PointId| t.at(p).or(placed[p.0]);
        let concerns = [side.point, side.from, side.to].iter().any(|p| trials[0].at(*p).is_some());
        let known = |t: &GroupClosure<N>| {
            Some((mine(t, side.point)?, mine(t, side.from)?, mine(t, side.to)?))
        };
        if !concerns || known(&trials[0]).is_none() {
            continue;
        }
        let kept: Vec<usize> = left
            .iter()
            .copied()
            .filter(|&i| {
                // Enclosures decide a side only if zero is outside them.
                let area = known(&trials[i]).map(|(p, a, b)| (b - a).cross(p - a));
                area.is_some_and(|area| {
                    area.approx() * if side.left { 1.0 } else { -1.0 } > area.radius()
                })
            })
            .collect();
        if kept.is_empty() {
            return Err(Diagnostic::error(
                "side-impossible",
                both!(
                    "in none of the {} assemblies of link{} does {} lie to the {} of {}{}",
                    trials.len(),
                    link_names(),
                    scene.point_name(side.point),
                    turned(side),
                    scene.point_name(side.from),
                    scene.point_name(side.to)
                ),
            )
            .at(side.span));
        }
        // Three points of one link describe the shape of the link, not its position.
        let of_one_link = scene
            .links
            .iter()
            .any(|l| [side.point, side.from, side.to].iter().all(|p| l.points.contains(p)));
        if kept.len() == left.len() && !of_one_link {
            idle = Some(side);
        }
        left = kept;
    }
    let stands = |p: PointId| trials[0].at(p).or(placed[p.0]).map(Point::approx);
    // A point held by a cam on a moving link has an approximate position on it.
    let held = |p: PointId| {
        scene
            .cams
            .iter()
            .filter_map(|c| c.disc.as_ref())
            .find_map(|t| t.rough_in_plane(scene, p, &stands))
    };
    let sketch = |p: PointId| {
        scene.points[p.0]
            .sketch
            .map(|s| Point::new(s[0], s[1]))
            .or(given_at(scene, p))
            .or_else(|| held(p))
    };
    if left.len() > 1 {
        // The sum of squared distances to all sketched points of the group.
        let cost = |i: usize| {
            let off = trials[i]
                .points
                .iter()
                .filter_map(|(p, at)| sketch(*p).map(|s| (s.lift() - *at).norm2()));
            off.fold(N::from_f64(0.0), |sum, x| sum + x)
        };
        if trials[0].points.iter().any(|(p, _)| sketch(*p).is_some()) {
            let pick = left
                .iter()
                .copied()
                .min_by(|a, b| (cost(*a) - cost(*b)).approx().total_cmp(&0.0))
                .expect("at least two are left");
            let note = idle.map(|side| {
                let message = both!(
                    "{}; \"sketch\" decides",
                    fits_all(scene, side, left.len(), &link_names())
                );
                Diagnostic::note("side-undecided", message).at(side.span)
            });
            return Ok(ClosureChoice { pick, open: 0, note });
        }
    }
    if left.len() == 1 {
        return Ok(ClosureChoice { pick: left[0], open: 0, note: None });
    }
    // Assemblies with two coincident joints come last: they are rarely intended.
    left.sort_by_key(|&i| falls_together(placed, &trials[i]));
    let (pick, other) = (left[instead % left.len()], left[(instead + 1) % left.len()]);
    let note = {
        let moved = trials[pick].points.iter().find_map(|(p, at)| {
            let other = trials[other].at(*p).map(Point::approx).filter(|o| *o != at.approx())?;
            Some((scene.point_name(*p), at.approx(), other))
        });
        let (which, hint) = match moved {
            Some((p, at, other)) => (
                both!(
                    "the one with {p} at {} was taken, not the one with {p} at {}",
                    place(scene, at),
                    place(scene, other)
                ),
                both!("a rough place of {p} in \"sketch\""),
            ),
            None => {
                // The assembly of a link known by one pin is described by its direction alone.
                let turned = trials[pick].poses.iter().find_map(|(l, pose)| {
                    let there = trials[other].poses.iter().find(|(k, _)| k == l)?.1.axis.approx();
                    let [mine, there] = [pose.axis.approx(), there]
                        .map(|u| significant(direction_degrees(u.angle()), 5));
                    (mine != there).then(|| (scene.link_name(*l), mine, there))
                });
                let which = match turned {
                    Some((l, mine, there)) => both!(
                        "the one with link {l} at {mine}° was taken, not the one with link {l} at {there}°"
                    ),
                    None => both!("the first was taken"),
                };
                (which, both!("rough places in \"sketch\""))
            }
        };
        match idle {
            Some(side) => {
                let message =
                    both!("{}: {}", fits_all(scene, side, left.len(), &link_names()), which);
                Diagnostic::note("side-undecided", message)
                    .at(side.span)
                    .help(both!("name another line in \"side\", or {}", hint))
            }
            None => {
                let all = both!("link{} can be assembled in {} ways", link_names(), left.len());
                Diagnostic::note(
                    "assembly-by-default",
                    both!("{} and the scene does not say which: {}", all, which),
                )
                .help(both!("say it with \"side\" or {}", hint))
            }
        }
    };
    Ok(ClosureChoice { pick, open: left.len(), note: Some(note) })
}

/// Returns true if a closure puts a point where another one is.
fn falls_together<N: Real>(placed: &[Option<Point<N>>], trial: &GroupClosure<N>) -> bool {
    /// Relative distance below which two positions are one: the rounding of typed numbers.
    const SAME: f64 = 1e-9;
    let size = |p: Point| p.to_vec2().norm();
    let there = placed.iter().enumerate().filter_map(|(q, at)| Some((q, at.as_ref()?.approx())));
    let there: Vec<(usize, Point)> = there.collect();
    let largest = there
        .iter()
        .map(|(_, at)| size(*at))
        .chain(trial.points.iter().map(|(_, at)| size(at.approx())))
        .fold(0.0, f64::max);
    trial.points.iter().any(|(p, at)| {
        there.iter().any(|(q, other)| *q != p.0 && at.approx().distance(*other) <= SAME * largest)
    })
}

/// Returns the word for a side, left or right.
fn turned(side: &Side) -> Both {
    if side.left { both!("left") } else { both!("right") }
}

fn fits_all(scene: &Scene, side: &Side, ways: usize, links: &Both) -> Both {
    let [point, from, to] = [side.point, side.from, side.to].map(|p| scene.point_name(p));
    both!(
        "{point} lies to the {0} of {from}{to} in all {ways} assemblies of link{1}: this side does not decide",
        turned(side),
        links
    )
}

fn place(scene: &Scene, p: Point) -> String {
    format!("({}, {})", scene.length_words(p.x), scene.length_words(p.y))
}
