//! Rolling pairs in a pose: where they touch, and how far one has rolled on the other.
//!
//! Two circles touch on the line of their centres, a straight track at the foot of the wheel's centre. Rolling keeps
//! ρ₁(φ₁ − β) + ρ₂(φ₂ − β) (β: angle of the line of centres from the first to the second; a hollow circle's ρ is negative), on a straight
//! track s + ρ(φ₂ − φ₁) with s counted along it: between two poses these change by nothing.

use super::assemble::Assembly;
use super::finish::same_place;
use super::shape::{Frame, given_place};
use super::{Configuration, Path, Pose, Shapes};
use crate::diag::{Diagnostic, both};
use crate::geom::{Point, Vec2};
use crate::mechanism::Hold;
use crate::number::Real;
use crate::scene::{Contours, LinkId, PointId, Rolling, RollingId, Scene, Sizes};

impl<N: Real> Configuration<N> {
    /// The unit normal at a contact, from the first link's contour toward the second's centre of curvature (of a wheel inside a ring:
    /// toward the wheel's centre where that lies beyond the ring's, else away from it); `None` where it is not placed.
    pub fn normal(&self, scene: &Scene, pair: RollingId) -> Option<Vec2<N>> {
        normal(&scene.rolling[pair.0], &self.points, &self.guides)
    }
}

/// From the first centre toward the second; square to a straight track, toward the wheel.
fn normal<N: Real>(pair: &Rolling, points: &[Option<Point<N>>], guides: &[Option<Path<N>>]) -> Option<Vec2<N>> {
    match pair.contours {
        Contours::Circles { centres: [a, b], .. } => (points[b.0]? - points[a.0]?).unit(),
        Contours::Track { .. } => match guides[pair.guide?.0]? {
            Path::Line { direction, .. } => Some(direction.perp()),
            Path::Arc { .. } => None,
        },
    }
}

/// The place of contact.
pub(super) fn contact<N: Real>(pair: &Rolling, sizes: [N; 2], points: &[Option<Point<N>>], guides: &[Option<Path<N>>]) -> Option<Point<N>> {
    let [r1, r2] = sizes;
    match pair.contours {
        Contours::Circles { centres: [a, b], .. } => {
            let (a, b) = (points[a.0]?, points[b.0]?);
            Some(a + (b - a) * (r1 / (r1 + r2)))
        }
        Contours::Track { centre, .. } => Some(points[centre.0]? + normal(pair, points, guides)? * -r2),
    }
}

/// How far the second link has rolled on the first between two poses of both (their frames, and the line from the first centre, or a point
/// of the track, to the second), beyond what rolling without slip lets it; in the unit of the sizes.
pub(super) struct Rolled {
    pub axes: [Vec2; 2],
    pub line: Vec2,
}

/// What a pose says of a rolling pair; the line of a track is that from the track's origin, in the frame of its link.
pub(super) fn seen(
    pair: &Rolling,
    shapes: &Shapes,
    pose: &dyn Fn(LinkId) -> Option<Pose>,
    place: &dyn Fn(LinkId, PointId) -> Option<Point>,
) -> Option<Rolled> {
    let [a, b] = pair.links;
    let axes = [pose(a)?.axis, pose(b)?.axis];
    let line = match pair.contours {
        Contours::Circles { centres: [p, q], .. } => place(b, q)? - place(a, p)?,
        Contours::Track { centre, .. } => match shapes.guides[pair.guide?.0]? {
            Path::Line { through, direction } => {
                let local = pose(a)?.to_local(place(b, centre)?) - through;
                Vec2::new(direction.dot(local), direction.cross(local))
            }
            Path::Arc { .. } => return None,
        },
    };
    Some(Rolled { axes, line })
}

/// By how much the pose `now` misses what rolling without slip makes of `then`, as an angle of the second link.
pub(super) fn slip(pair: &Rolling, [r1, r2]: [f64; 2], then: &Rolled, now: &Rolled) -> f64 {
    let turned = |i: usize| now.axes[i].divide_by(then.axes[i]).angle();
    match pair.contours {
        Contours::Circles { .. } => {
            let line = now.line.divide_by(then.line).angle();
            (turned(1) - line) + (turned(0) - line) * (r1 / r2)
        }
        Contours::Track { .. } => (now.line.x - then.line.x) / r2 + (turned(1) - turned(0)),
    }
}

impl<N: Real> Assembly<'_, N> {
    /// The pose of a link that rolls on a known one, as far as something tells it: coordinates of its points, the phase of the pair, or
    /// nothing where it has no line of its own.
    pub(super) fn poses_of_rolling(&self, link: LinkId, pivot: Option<PointId>, holds: &[Hold]) -> Result<Vec<Pose<N>>, Diagnostic> {
        let shape = &self.shapes[link.0];
        let mut placed = shape.points.iter().filter_map(|(p, local)| {
            let at = if pivot == Some(*p) { self.points[p.0] } else { given_place(self.scene, &self.inputs, *p) };
            Some((*local, at?))
        });
        let (first, second) = (placed.next(), placed.next());
        let rolls = holds.iter().find_map(|h| if let Hold::Rolls { pair, other, .. } = *h { Some((pair, other)) } else { None });
        let Some((local, at)) = first else { return Err(self.no_closure(link)) };
        if let Some((far, far_at)) = second
            && self.instant.is_none()
        {
            let pose = Pose::from_point_and_direction(local, far - local, at, far_at - at);
            return Ok(pose.into_iter().collect());
        }
        let axis = match rolls.and_then(|(pair, other)| self.rolled(link, pair, other, at)) {
            Some(axis) => axis,
            None if shape.frame == Frame::Loose && self.instant.is_none() => Vec2::unit_x(),
            None => return Err(self.no_phase(link)),
        };
        Ok(vec![Pose { origin: at - local.to_vec2().rotate_by(axis), axis }])
    }

    /// The direction that rolling gives the frame of a link whose wheel has its centre at `at`, from the pose at the instant, or from the
    /// phase of the pair.
    fn rolled(&self, link: LinkId, id: RollingId, other: LinkId, at: Point<N>) -> Option<Vec2<N>> {
        let pair = &self.scene.rolling[id.0];
        let Contours::Circles { centres, .. } = pair.contours else { return None };
        let own = usize::from(pair.links[1] == link);
        let [r1, r2] = pair.sizes(&self.inputs);
        // Of this link, and of the one on which it rolls.
        let (mine, its) = if own == 1 { (r2, r1) } else { (r1, r2) };
        let line = {
            let d = at - self.points[centres[1 - own].0]?;
            if own == 1 { d } else { -d }
        };
        let other_axis = self.poses[other.0]?.axis;
        if let Some(then) = self.instant {
            let (before, was) = (then.points[centres[1].0]? - then.points[centres[0].0]?, then.poses[other.0]?.axis);
            let turned = line.divide_by(before).angle();
            let rolled = turned - (other_axis.divide_by(was).angle() - turned) * (its / mine);
            return then.poses[link.0]?.axis.rotate_by(Vec2::from_angle(rolled)).unit();
        }
        // ρ₁(φ₁ − β) + ρ₂(φ₂ − β) = ρ₂·phase, with the angles of the links' lines.
        let (s, c) = self.inputs.sin_cos(pair.phase.as_ref()?);
        let phase = Vec2::new(c, s).angle();
        let mark = |l: LinkId| match &self.scene.links[l.0].points[..] {
            [p, q, ..] => self.shapes[l.0].local(*p).zip(self.shapes[l.0].local(*q)).map(|(p, q)| q - p),
            _ => Some(Vec2::unit_x()),
        };
        let others = mark(other)?.unit()?.rotate_by(other_axis).divide_by(line.unit()?).angle();
        let angle = (if own == 1 { phase } else { phase * (r2 / r1) }) - others * (its / mine);
        let direction = line.unit()?.rotate_by(Vec2::from_angle(angle));
        direction.divide_by(mark(link)?.unit()?).unit()
    }

    fn no_phase(&self, link: LinkId) -> Diagnostic {
        Diagnostic::error(
            "phase-needed",
            both!("nothing says at which angle wheel {} stands", "没有说明轮 {} 的角度", self.scene.link_name(link)),
        )
        .at(self.scene.links[link.0].span)
        .help(both!(
            "give the coordinates of two of its points at the instant in \"points\", or \"phase\" with the pair",
            "请在 \"points\" 中给出其上两点在该时刻的坐标，或在该副中给出 \"phase\""
        ))
    }
}

/// What is wrong with the radii of two circles: their sum (of a ring their difference) is the distance of the centres.
pub(super) fn misfit(scene: &Scene, pair: &Rolling, c: &Configuration) -> Option<Diagnostic> {
    let Contours::Circles { centres: [p, q], sizes: Sizes::Radii([a, b]), hollow } = &pair.contours else { return None };
    let (at, other) = (c.points[p.0]?, c.points[q.0]?);
    let (given, distance) = (if hollow.is_some() { (a.value - b.value).abs() } else { a.value + b.value }, at.distance(other));
    if (given - distance).abs() <= same_place(c.extent().max(a.value.max(b.value)), at) {
        return None;
    }
    let (p, q) = (scene.point_name(*p), scene.point_name(*q));
    let (given, distance) = (scene.length_words(given), scene.length_words(distance));
    Some(
        Diagnostic::error(
            "gear-radii",
            match hollow {
                None => both!(
                    "the radii make the centres {given} apart, but {p}{q} is {distance}",
                    "按半径两圆心相距 {given}，而 {p}{q} 为 {distance}"
                ),
                Some(_) => both!(
                    "the radii make the centres {given} apart (one runs inside the other), but {p}{q} is {distance}",
                    "按半径两圆心相距 {given}（内切），而 {p}{q} 为 {distance}"
                ),
            },
        )
        .at(pair.span)
        .help(both!(
            "correct a radius or a centre; \"teeth\" without \"module\" divide whatever distance there is; \"ring\" names an internal gear",
            "请改正半径或圆心；只给 \"teeth\" 而不给 \"module\" 时按实际中心距分配；内齿轮用 \"ring\" 写明"
        )),
    )
}
