//! The rigid form of each link in its own frame, from lengths, local coordinates, or the coordinates of the pose.
//!
//! The frame: the plane's own where two of the link's points have coordinates (and for ground); else origin in the first
//! point of a pair whose distance is given, x toward the second; else origin in the link's only point, with a direction
//! that its guide or its pose gives.

use super::Path;
use super::kernel::{Locus, Miss, meet};
use crate::diag::{Diagnostic, Faults};
use crate::geom::{Point, Vec2};
use crate::mechanism::Mechanism;
use crate::scene::{Direction, GuideId, GuidePath, LinkId, Place, PointId, Scene, Through};
use crate::trig;

/// How far a link's frame is fixed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Frame {
    /// The frame is the plane's own at the instant.
    Plane,
    /// Fixed in the link by two of its points.
    Body,
    /// Only the origin is fixed (one point, or none): the direction is whatever the pose makes it.
    Loose,
}

pub(super) struct LinkShape {
    pub points: Vec<(PointId, Point)>,
    pub frame: Frame,
}

impl LinkShape {
    pub fn local(&self, p: PointId) -> Option<Point> {
        self.points.iter().find(|(q, _)| *q == p).map(|(_, at)| *at)
    }
}

/// Given coordinates of a point in the plane.
pub(super) fn given_at(scene: &Scene, p: PointId) -> Option<Point> {
    match &scene.points[p.0].place {
        Place::At([x, y]) => Some(Point::new(x.value, y.value)),
        _ => None,
    }
}

fn given_length(scene: &Scene, a: PointId, b: PointId) -> Option<f64> {
    scene.lengths.iter().find(|l| (l.a, l.b) == (a, b) || (l.a, l.b) == (b, a)).map(|l| l.value.value)
}

/// The form of one link.
pub(super) fn of_link(scene: &Scene, l: LinkId, faults: &mut Faults) -> LinkShape {
    let all = &scene.links[l.0].points;
    let at: Vec<(PointId, Point)> = all.iter().filter_map(|p| given_at(scene, *p).map(|x| (*p, x))).collect();
    let ground = l == scene.ground;
    let (mut points, frame) = if at.len() >= 2 || (ground && !at.is_empty()) {
        (at, Frame::Plane)
    } else if let Some((a, b, d)) = base_pair(scene, all) {
        (vec![(a, Point::ORIGIN), (b, Point::new(d, 0.0))], if ground { Frame::Plane } else { Frame::Body })
    } else if let Some(p) = all.iter().find(|p| is_free(scene, **p)).or(all.first()) {
        (vec![(*p, Point::ORIGIN)], if ground { Frame::Plane } else { Frame::Loose })
    } else {
        (Vec::new(), if ground { Frame::Plane } else { Frame::Loose })
    };
    let mut open: Vec<PointId> = all.iter().copied().filter(|p| !points.iter().any(|(q, _)| q == p)).collect();
    loop {
        let before = open.len();
        open.retain(|&p| match place_point(scene, l, &points, p) {
            Some(Ok(at)) => {
                points.push((p, at));
                false
            }
            Some(Err(d)) => {
                faults.push(d);
                // Reported once: placed anywhere, so that what hangs on it is not reported too.
                points.push((p, Point::ORIGIN));
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
        points.push((p, Point::ORIGIN));
    }
    check_given_lengths(scene, l, &points, faults);
    LinkShape { points, frame }
}

/// Whether a point hangs on no base of its own.
fn is_free(scene: &Scene, p: PointId) -> bool {
    matches!(scene.points[p.0].place, Place::Unknown | Place::At(_))
}

fn base_pair(scene: &Scene, all: &[PointId]) -> Option<(PointId, PointId, f64)> {
    for (i, &a) in all.iter().enumerate() {
        for &b in &all[i + 1..] {
            if let Some(d) = given_length(scene, a, b) {
                return Some((a, b, d));
            }
        }
    }
    None
}

/// Places a point of a link from those already placed; `None` where the data do not (yet) suffice.
fn place_point(scene: &Scene, l: LinkId, points: &[(PointId, Point)], p: PointId) -> Option<Result<Point, Diagnostic>> {
    let local = |q: PointId| points.iter().find(|(r, _)| *r == q).map(|(_, at)| *at);
    match &scene.points[p.0].place {
        Place::InLink { base, xy } => {
            let (o, x) = (local(base.0)?, (local(base.1)? - local(base.0)?).unit()?);
            return Some(Ok(o + Vec2::new(xy[0].value, xy[1].value).rotate_by(x)));
        }
        Place::Polar { base, length, angle } => {
            let (o, x) = (local(base.0)?, (local(base.1)? - local(base.0)?).unit()?);
            let (s, c) = trig::sin_cos(angle.value);
            return Some(Ok(o + Vec2::new(length.value * c, length.value * s).rotate_by(x)));
        }
        Place::At(_) | Place::Unknown => {}
    }
    let known: Vec<(PointId, Point, f64)> = points.iter().filter_map(|(q, at)| given_length(scene, *q, p).map(|d| (*q, *at, d))).collect();
    let [(qa, a, ra), (qb, b, rb), ..] = known[..] else { return None };
    Some(match meet(Locus::Circle { centre: a, radius: ra }, Locus::Circle { centre: b, radius: rb }) {
        Ok(two) => Ok(pick_side(scene, p, (qa, a), (qb, b), &two)),
        Err(miss) => Err(impossible_triangle(scene, l, p, qa, qb, miss)),
    })
}

/// Of the two mirror places of a point, the one the scene means: side, then sketch, then the left of the base.
fn pick_side(scene: &Scene, p: PointId, a: (PointId, Point), b: (PointId, Point), two: &[Point]) -> Point {
    let sketch = |q: PointId| scene.points[q.0].sketch.map(|s| Point::new(s[0], s[1])).or(given_at(scene, q));
    for s in scene.sides.iter().filter(|s| s.point == p) {
        let left = if (s.from, s.to) == (a.0, b.0) {
            s.left
        } else if (s.from, s.to) == (b.0, a.0) {
            !s.left
        } else {
            continue;
        };
        return two[if left { 0 } else { 1 }];
    }
    if let (Some(sa), Some(sb), Some(sp)) = (sketch(a.0), sketch(b.0), sketch(p)) {
        let area = (sb - sa).cross(sp - sa);
        return two[if area >= 0.0 { 0 } else { 1 }];
    }
    two[0]
}

fn impossible_triangle(scene: &Scene, l: LinkId, p: PointId, a: PointId, b: PointId, miss: Miss) -> Diagnostic {
    let (p, a, b) = (scene.point_name(p), scene.point_name(a), scene.point_name(b));
    let by = match miss {
        Miss::TooFar(x) => format!("{a}{p} + {p}{b} is shorter than {a}{b} by {}", crate::quantity::metres(x)),
        Miss::TooNear(x) => format!("one of {a}{p}, {p}{b} is longer than the two other sides together by {}", crate::quantity::metres(x)),
        Miss::Parallel(_) => format!("{a} and {b} coincide"),
    };
    Diagnostic::error("impossible-triangle", format!("the lengths of link {} make no triangle {a}{b}{p}: {by}", scene.link_name(l)))
        .at(scene.links[l.0].span)
}

fn missing_length(scene: &Scene, l: LinkId, points: &[(PointId, Point)], p: PointId) -> Diagnostic {
    let name = scene.point_name(p);
    let given: Vec<PointId> = points.iter().map(|(q, _)| *q).filter(|q| given_length(scene, *q, p).is_some()).collect();
    let missing: Vec<String> =
        points.iter().filter(|(q, _)| !given.contains(q)).map(|(q, _)| format!("{}{name}", scene.point_name(*q))).collect();
    let wanted = if points.len() >= 2 { "two lengths to points of the link" } else { "its length" };
    Diagnostic::error(
        "missing-length",
        format!("point {name} of link {} is not placed: give {wanted} ({})", scene.link_name(l), missing.join(", ")),
    )
    .at(scene.links[l.0].span)
    .help(format!("or its coordinates in \"points\", such as \"{name}\": {{\"base\": ..., \"x\": ..., \"y\": ...}}"))
}

/// Two descriptions of one length must agree to what a person writes.
const SAME_LENGTH: f64 = 1e-9;

fn check_given_lengths(scene: &Scene, l: LinkId, points: &[(PointId, Point)], faults: &mut Faults) {
    if faults.has_errors() {
        return;
    }
    for given in &scene.lengths {
        let find = |p: PointId| points.iter().find(|(q, _)| *q == p).map(|(_, at)| *at);
        let (Some(a), Some(b)) = (find(given.a), find(given.b)) else { continue };
        let d = a.distance(b);
        if (d - given.value.value).abs() > SAME_LENGTH * d.max(given.value.value) {
            faults.push(
                Diagnostic::error(
                    "contradictory-length",
                    format!(
                        "{}{} is given as {}, but the other data of link {} make it {}",
                        scene.point_name(given.a),
                        scene.point_name(given.b),
                        given.value.text,
                        scene.link_name(l),
                        crate::quantity::metres(d)
                    ),
                )
                .at(given.value.span)
                .help("leave one of the two out; rough coordinates belong in \"sketch\""),
            );
        }
    }
}

/// A guide's path in the frame of its link, as far as the link's form alone gives it. `None`: it needs the pose.
pub(super) fn guide_in_link(scene: &Scene, m: &Mechanism, shape: &LinkShape, g: GuideId) -> Option<Path> {
    let guide = &scene.guides[g.0];
    let plane = shape.frame == Frame::Plane || (m.never_turns[guide.on.0] && shape.frame == Frame::Loose);
    match &guide.path {
        GuidePath::Arc { centre, radius } => Some(Path::Arc { centre: shape.local(*centre)?, radius: radius.as_ref()?.value }),
        GuidePath::Line { through, direction, offset } => {
            let direction = match direction {
                Direction::Instant(angle) if plane => {
                    let (s, c) = trig::sin_cos(angle.value);
                    Vec2::new(c, s)
                }
                Direction::Instant(_) => return None,
                Direction::Along(a, b, angle) => {
                    let base = (shape.local(*b)? - shape.local(*a)?).unit()?;
                    match angle {
                        Some(angle) => {
                            let (s, c) = trig::sin_cos(angle.value);
                            Vec2::new(c, s).rotate_by(base)
                        }
                        None => base,
                    }
                }
                Direction::Own => Vec2::new(1.0, 0.0),
            };
            let through = match through {
                Through::Point(p) => shape.local(*p)?,
                Through::At([x, y]) if plane => Point::new(x.value, y.value),
                // A slider without a pin of its own keeps whatever distance it has: the line may lie anywhere.
                Through::Pin if guide.pin.is_none() => Point::ORIGIN,
                // The runner's own place: known in the link only where the link's frame is the plane's and the pin is given.
                Through::Pin if shape.frame == Frame::Plane => given_at(scene, guide.pin?)?,
                Through::At(_) | Through::Pin => return None,
            };
            let offset = offset.as_ref().map_or(0.0, |o| o.value);
            Some(Path::Line { through: through + direction.perp() * offset, direction })
        }
    }
}
