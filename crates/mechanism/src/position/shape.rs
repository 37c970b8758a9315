//! The rigid shape of each link in its own frame, from lengths, local coordinates, or the
//! coordinates of the pose.
//!
//! The frame is the plane's own if two of the link's points have coordinates (and for ground);
//! otherwise its origin is the first point of a pair with a given distance, with x toward the
//! second; otherwise its origin is the link's only point, with a direction from its guide or its
//! pose.

use super::Path;
use super::kernel::{Locus, Miss, meet};
use crate::mechanism::Mechanism;
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_scene::exact::Inputs;
use hodograph_scene::{
    GivenQuantity, GuideDirection, GuideId, GuidePath, LinkId, PointId, PointPlace, Scene, Through,
};

/// The way in which a link's frame is fixed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FrameAnchor {
    /// The frame is the plane's own at the instant.
    Plane,
    /// Fixed in the link by two of its points.
    Body,
    /// Only the origin is fixed (one point, or none): the pose gives the direction.
    Loose,
}

pub(super) struct LinkShape<N> {
    pub points: Vec<(PointId, Point<N>)>,
    pub frame: FrameAnchor,
}

impl<N: Real> LinkShape<N> {
    pub fn local(&self, p: PointId) -> Option<Point<N>> {
        self.points.iter().find(|(q, _)| *q == p).map(|(_, at)| *at)
    }
}

/// Returns the given coordinates of a point in the plane.
pub(super) fn given_at(scene: &Scene, p: PointId) -> Option<Point> {
    match &scene.points[p.0].place {
        PointPlace::At([x, y]) => Some(Point::new(x.value, y.value)),
        PointPlace::Unknown | PointPlace::InLink { .. } | PointPlace::Polar { .. } => None,
    }
}

/// Returns the given coordinates of a point in the numbers of an assembly.
pub(super) fn given_place<N: Real>(
    scene: &Scene,
    inputs: &Inputs<N>,
    p: PointId,
) -> Option<Point<N>> {
    match &scene.points[p.0].place {
        PointPlace::At([x, y]) => Some(Point::new(inputs.number(x), inputs.number(y))),
        PointPlace::Unknown | PointPlace::InLink { .. } | PointPlace::Polar { .. } => None,
    }
}

fn given_length(scene: &Scene, a: PointId, b: PointId) -> Option<&GivenQuantity> {
    scene.lengths.iter().find(|l| (l.a, l.b) == (a, b) || (l.a, l.b) == (b, a)).map(|l| &l.value)
}

/// Returns the shape of one link.
///
/// If `check` is set, values given twice must agree within the accuracy of `f64`.
pub(super) fn of_link<N: Real>(
    scene: &Scene,
    inputs: &Inputs<N>,
    l: LinkId,
    check: bool,
    faults: &mut Faults,
) -> LinkShape<N> {
    let all = &scene.links[l.0].points;
    let at: Vec<(PointId, Point<N>)> =
        all.iter().filter_map(|p| given_place(scene, inputs, *p).map(|x| (*p, x))).collect();
    let ground = l == scene.ground;
    let (mut points, frame) = if at.len() >= 2 || (ground && !at.is_empty()) {
        (at, FrameAnchor::Plane)
    } else if let Some((a, b, d)) = base_pair(scene, all) {
        (
            vec![(a, Point::origin()), (b, Point::new(inputs.number(d), N::from_f64(0.0)))],
            if ground { FrameAnchor::Plane } else { FrameAnchor::Body },
        )
    } else if let Some(p) = all.iter().find(|p| is_free(scene, **p)).or(all.first()) {
        (vec![(*p, Point::origin())], if ground { FrameAnchor::Plane } else { FrameAnchor::Loose })
    } else {
        (Vec::new(), if ground { FrameAnchor::Plane } else { FrameAnchor::Loose })
    };
    // All points of a ground with given pivots are placed.
    let placed = points.len() == all.len();
    let is_open = |p: &PointId| !placed && !points.iter().any(|(q, _)| q == p);
    let mut open: Vec<PointId> = all.iter().copied().filter(is_open).collect();
    loop {
        let before = open.len();
        open.retain(|&p| match place_point(scene, inputs, l, &points, p) {
            Some(Ok(at)) => {
                points.push((p, at));
                false
            }
            Some(Err(d)) => {
                faults.push(d);
                // Reported once: placed anywhere, so that points that depend on it are not reported
                // too.
                points.push((p, Point::origin()));
                false
            }
            None => true,
        });
        if open.is_empty() || open.len() == before {
            break;
        }
    }
    for p in open {
        faults.push(missing_length(scene, l, &points, p));
        points.push((p, Point::origin()));
    }
    if check {
        check_given_lengths(scene, l, &points, faults);
    }
    LinkShape { points, frame }
}

/// Returns true if a point depends on no base of its own.
fn is_free(scene: &Scene, p: PointId) -> bool {
    matches!(scene.points[p.0].place, PointPlace::Unknown | PointPlace::At(_))
}

fn base_pair<'a>(
    scene: &'a Scene,
    all: &[PointId],
) -> Option<(PointId, PointId, &'a GivenQuantity)> {
    for (i, &a) in all.iter().enumerate() {
        for &b in &all[i + 1..] {
            if let Some(d) = given_length(scene, a, b) {
                return Some((a, b, d));
            }
        }
    }
    None
}

/// Places a point of a link from those already placed; `None` if the data do not (yet) suffice.
fn place_point<N: Real>(
    scene: &Scene,
    inputs: &Inputs<N>,
    l: LinkId,
    points: &[(PointId, Point<N>)],
    p: PointId,
) -> Option<Result<Point<N>, Diagnostic>> {
    let local = |q: PointId| points.iter().find(|(r, _)| *r == q).map(|(_, at)| *at);
    match &scene.points[p.0].place {
        PointPlace::InLink { base, xy } => {
            let (o, x) = (local(base.0)?, (local(base.1)? - local(base.0)?).unit()?);
            return Some(Ok(
                o + Vec2::new(inputs.number(&xy[0]), inputs.number(&xy[1])).rotate_by(x)
            ));
        }
        PointPlace::Polar { base, length, angle } => {
            let (o, x) = (local(base.0)?, (local(base.1)? - local(base.0)?).unit()?);
            let (s, c) = inputs.sin_cos(angle);
            let length = inputs.number(length);
            return Some(Ok(o + Vec2::new(length * c, length * s).rotate_by(x)));
        }
        PointPlace::At(_) | PointPlace::Unknown => {}
    }
    let known: Vec<(PointId, Point<N>, N)> = points
        .iter()
        .filter_map(|(q, at)| given_length(scene, *q, p).map(|d| (*q, *at, inputs.number(d))))
        .collect();
    let [(qa, a, ra), (qb, b, rb), ..] = known[..] else { return None };
    Some(
        match meet(Locus::Circle { centre: a, radius: ra }, Locus::Circle { centre: b, radius: rb })
        {
            Ok(two) => Ok(two[pick_side(scene, p, qa, qb)]),
            Err(miss) => Err(impossible_triangle(scene, l, p, qa, qb, miss)),
        },
    )
}

/// Returns the index of the mirror position of a point (0 left of a→b, 1 right of it) that the
/// scene selects: by side, then sketch, then left.
fn pick_side(scene: &Scene, p: PointId, a: PointId, b: PointId) -> usize {
    let sketch = |q: PointId| {
        scene.points[q.0].sketch.map(|s| Point::new(s[0], s[1])).or(given_at(scene, q))
    };
    for s in scene.sides.iter().filter(|s| s.point == p) {
        let left = if (s.from, s.to) == (a, b) {
            s.left
        } else if (s.from, s.to) == (b, a) {
            !s.left
        } else {
            continue;
        };
        return usize::from(!left);
    }
    if let (Some(sa), Some(sb), Some(sp)) = (sketch(a), sketch(b), sketch(p)) {
        let area = (sb - sa).cross(sp - sa);
        return usize::from(area < 0.0);
    }
    0
}

fn impossible_triangle(
    scene: &Scene,
    l: LinkId,
    p: PointId,
    a: PointId,
    b: PointId,
    miss: Miss,
) -> Diagnostic {
    let (p, a, b) = (scene.point_name(p), scene.point_name(a), scene.point_name(b));
    let by = match miss {
        Miss::TooFar(x) => {
            both!("{a}{p} + {p}{b} is shorter than {a}{b} by {}", scene.length_words(x))
        }
        Miss::TooNear(x) => both!(
            "one of {a}{p}, {p}{b} is longer than the two other sides together by {}",
            scene.length_words(x)
        ),
        Miss::Parallel(_) => both!("{a} and {b} coincide"),
    };
    Diagnostic::error(
        "impossible-triangle",
        both!("the lengths of link {} make no triangle {a}{b}{p}: {}", scene.link_name(l), by),
    )
    .at(scene.links[l.0].span)
}

fn missing_length<N: Real>(
    scene: &Scene,
    l: LinkId,
    points: &[(PointId, Point<N>)],
    p: PointId,
) -> Diagnostic {
    let name = scene.point_name(p);
    let given: Vec<PointId> =
        points.iter().map(|(q, _)| *q).filter(|q| given_length(scene, *q, p).is_some()).collect();
    let missing: Vec<String> = points
        .iter()
        .filter(|(q, _)| !given.contains(q))
        .map(|(q, _)| format!("{}{name}", scene.point_name(*q)))
        .collect();
    let wanted = if points.len() >= 2 {
        both!("two lengths to points of the link")
    } else {
        both!("its length")
    };
    Diagnostic::error(
        "missing-length",
        both!(
            "point {name} of link {} is not placed: give {} ({})",
            scene.link_name(l),
            wanted,
            Both::names(&missing)
        ),
    )
    .at(scene.links[l.0].span)
    .help(both!(
        "or its coordinates in \"points\", such as \"{name}\": {{\"base\": ..., \"x\": ..., \"y\": ...}}"
    ))
}

/// Relative difference up to which two descriptions of one length agree, as typed by a person.
const SAME_LENGTH: f64 = 1e-9;

fn check_given_lengths<N: Real>(
    scene: &Scene,
    l: LinkId,
    points: &[(PointId, Point<N>)],
    faults: &mut Faults,
) {
    if faults.has_errors() {
        return;
    }
    for given in &scene.lengths {
        let find = |p: PointId| points.iter().find(|(q, _)| *q == p).map(|(_, at)| at.approx());
        let (Some(a), Some(b)) = (find(given.a), find(given.b)) else { continue };
        let d = a.distance(b);
        if (d - given.value.value).abs() > SAME_LENGTH * d.max(given.value.value) {
            faults.push(
                Diagnostic::error(
                    "contradictory-length",
                    both!(
                        "{}{} is given as {}, but the other data of link {} make it {}",
                        scene.point_name(given.a),
                        scene.point_name(given.b),
                        given.value.text,
                        scene.link_name(l),
                        scene.length_words(d)
                    ),
                )
                .at(given.value.span)
                .help(both!("leave one of the two out; rough coordinates belong in \"sketch\"")),
            );
        }
    }
}

/// Returns a guide's path in the frame of its link, as far as the link's shape alone determines it;
/// `None` if the path depends on the pose.
pub(super) fn guide_in_link<N: Real>(
    scene: &Scene,
    inputs: &Inputs<N>,
    m: &Mechanism,
    shape: &LinkShape<N>,
    g: GuideId,
) -> Option<Path<N>> {
    let guide = &scene.guides[g.0];
    let plane = shape.frame == FrameAnchor::Plane
        || (m.never_turns[guide.on.0] && shape.frame == FrameAnchor::Loose);
    match &guide.path {
        GuidePath::Arc { centre, radius } => Some(Path::Arc {
            centre: shape.local(*centre)?,
            radius: inputs.number(radius.as_ref()?),
        }),
        GuidePath::Line { through, direction, offset } => {
            let direction = match direction {
                GuideDirection::Instant(angle) if plane => {
                    let (s, c) = inputs.sin_cos(angle);
                    Vec2::new(c, s)
                }
                GuideDirection::Instant(_) => return None,
                GuideDirection::Along(a, b, angle) => {
                    let base = (shape.local(*b)? - shape.local(*a)?).unit()?;
                    match angle {
                        Some(angle) => {
                            let (s, c) = inputs.sin_cos(angle);
                            Vec2::new(c, s).rotate_by(base)
                        }
                        None => base,
                    }
                }
                GuideDirection::Own => Vec2::unit_x(),
                // Its frame is aligned with the guide in which it slides.
                GuideDirection::Slid(angle) if shape.frame == FrameAnchor::Loose => {
                    let (s, c) = inputs.sin_cos(angle);
                    Vec2::new(c, s)
                }
                GuideDirection::Slid(_) => return None,
            };
            let through = match through {
                Through::Point(p) => shape.local(*p)?,
                Through::At([x, y]) if plane => Point::new(inputs.number(x), inputs.number(y)),
                // A slider without a pin keeps any distance that it has: the line is arbitrary.
                Through::Pin if guide.pin.is_none() => Point::origin(),
                // The position of the runner: known in the link only if the link's frame is the
                // plane's and the pin is given.
                Through::Pin if shape.frame == FrameAnchor::Plane => {
                    given_place(scene, inputs, guide.pin?)?
                }
                Through::At(_) | Through::Pin => return None,
            };
            let through =
                offset.as_ref().map_or(through, |o| through + direction.perp() * inputs.number(o));
            Some(Path::Line { through, direction })
        }
    }
}
