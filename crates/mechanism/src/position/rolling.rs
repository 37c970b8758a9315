//! Rolling pairs in a pose: their points of contact, and their rolling.
//!
//! Two circles touch on the line of their centres, a straight track at the foot of the wheel's
//! centre. Rolling keeps ρ₁(φ₁ − β) + ρ₂(φ₂ − β) constant (β: angle of the line of centres from the
//! first to the second; a hollow circle's ρ is negative), and s + ρ(φ₂ − φ₁) on a straight track,
//! with s measured along it.

use super::assemble::Assembly;
use super::belt;
use super::finish::same_place;
use super::kernel::Locus;
use super::shape::{FrameAnchor, given_place};
use super::{Configuration, Path, Pose, Shapes};
use crate::mechanism::{Group, Hold};
use hodograph_base::diag::{Diagnostic, both};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_base::trig::turns_of;
use hodograph_scene::{
    Driver, GuideId, LinkId, Normal, PointId, Relation, Rolling, RollingId, Scene, Touch,
};
use std::f64::consts::TAU;

impl<N: Real> Configuration<N> {
    /// Returns the unit normal n at a contact, from the first link's contour to the second's: the
    /// centres of curvature are Q − ρ₁n and Q + ρ₂n. `None` if the pair is not placed, or if it has
    /// no contact.
    pub fn normal(&self, scene: &Scene, pair: RollingId) -> Option<Vec2<N>> {
        let (r, [r1, r2]) = (&scene.rolling[pair.0], self.shapes.rolling[pair.0]);
        let n = normal(r, &self.points, &self.guides)?;
        Some(if (r1 + r2).approx() < 0.0 { -n } else { n })
    }
}

/// Returns the normal from the first centre toward the second; square to a straight track, toward
/// the wheel.
fn normal<N: Real>(
    pair: &Rolling,
    points: &[Option<Point<N>>],
    guides: &[Option<Path<N>>],
) -> Option<Vec2<N>> {
    match pair.touch() {
        Touch::Point(Normal::Centres([a, b])) => (points[b.0]? - points[a.0]?).unit(),
        Touch::Point(Normal::Square { guide, .. }) => match guides[guide.0]? {
            Path::Line { direction, .. } => Some(direction.perp()),
            Path::Arc { .. } => None,
        },
        Touch::Strand { .. } => None,
    }
}

/// Returns the point of contact on either link.
pub(super) fn contact<N: Real>(
    pair: &Rolling,
    sizes: [N; 2],
    points: &[Option<Point<N>>],
    guides: &[Option<Path<N>>],
) -> Option<[Point<N>; 2]> {
    let [r1, r2] = sizes;
    match pair.touch() {
        Touch::Point(Normal::Centres([a, b])) => {
            let (a, b) = (points[a.0]?, points[b.0]?);
            Some([a + (b - a) * (r1 / (r1 + r2)); 2])
        }
        Touch::Point(Normal::Square { centre, .. }) => {
            Some([points[centre.0]? + normal(pair, points, guides)? * -r2; 2])
        }
        Touch::Strand { centres: [a, b], right, .. } => {
            belt::strand(sizes, right, points[a.0]?, points[b.0]?)
        }
    }
}

/// The rolling of a pair since the scene's instant: angles of more than a turn result from counting
/// from pose to pose.
#[derive(Clone, Debug, PartialEq)]
pub struct RollingRecord {
    /// The pair at the instant.
    start: RollingPose,
    /// Rotation of each link and of the line of centres since the instant (rad), including whole
    /// turns.
    turned: [f64; 3],
}

/// A rolling pair in a pose: the axes of both links, and the line from the first centre to the
/// second; for a track the displacement along it and the distance from it instead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct RollingPose {
    axes: [Vec2; 2],
    line: Vec2,
}

impl RollingRecord {
    /// Returns the record at the instant.
    pub(super) fn begin(start: RollingPose) -> RollingRecord {
        RollingRecord { start, turned: [0.0; 3] }
    }

    /// Returns the rotation of each link and of the line of centres (rad).
    pub(super) fn turned(&self) -> [f64; 3] {
        self.turned
    }

    /// Returns the record in a pose close to this one: no rotation between the two reaches half a
    /// turn.
    pub(super) fn on(&self, now: &RollingPose) -> RollingRecord {
        let wrapped = [
            now.axes[0].divide_by(self.start.axes[0]).angle(),
            now.axes[1].divide_by(self.start.axes[1]).angle(),
            now.line.divide_by(self.start.line).angle(),
        ];
        // Angles since the instant, not sums of steps: errors do not accumulate over many turns.
        let turned = std::array::from_fn(|i| {
            wrapped[i] + TAU * libm::round((self.turned[i] - wrapped[i]) / TAU)
        });
        RollingRecord { start: self.start, turned }
    }

    /// Returns the deviation of a pose close to this one from rolling without slip, as an angle of
    /// the second link.
    pub(super) fn slip(&self, pair: &Rolling, [r1, r2]: [f64; 2], now: &RollingPose) -> f64 {
        let [a, b, line] = self.on(now).turned;
        match pair.relation() {
            Relation::Turnings(_) => (b - line) + (a - line) * (r1 / r2),
            Relation::Slide { .. } => (now.line.x - self.start.line.x) / r2 + (b - a),
        }
    }
}

/// Returns a rolling pair in a pose; the line of a track is measured from the track's origin, in
/// the frame of its link.
pub(super) fn seen(
    pair: &Rolling,
    shapes: &Shapes,
    pose: &dyn Fn(LinkId) -> Option<Pose>,
    place: &dyn Fn(LinkId, PointId) -> Option<Point>,
) -> Option<RollingPose> {
    let [a, b] = pair.links;
    let axes = [pose(a)?.axis, pose(b)?.axis];
    let line = match pair.relation() {
        Relation::Turnings([p, q]) => place(b, q)? - place(a, p)?,
        Relation::Slide { centre, guide } => match shapes.guides[guide.0]? {
            Path::Line { through, direction } => {
                let local = pose(a)?.to_local(place(b, centre)?) - through;
                Vec2::new(direction.dot(local), direction.cross(local))
            }
            Path::Arc { .. } => return None,
        },
    };
    Some(RollingPose { axes, line })
}

/// Returns the records of all pairs in a pose close to one with the records `before`; at the
/// instant there are none before.
pub(super) fn counted<N: Real>(
    scene: &Scene,
    c: &Configuration<N>,
    before: &[Option<RollingRecord>],
) -> Vec<Option<RollingRecord>> {
    if scene.rolling.is_empty() {
        return Vec::new();
    }
    let c = c.approx();
    let pose = |l: LinkId| if l == scene.ground { Some(Pose::GROUND) } else { c.poses[l.0] };
    let place = |_: LinkId, p: PointId| c.points[p.0];
    let all = scene.rolling.iter().enumerate().map(|(r, pair)| {
        let now = seen(pair, &c.shapes, &pose, &place)?;
        Some(
            before
                .get(r)
                .and_then(Option::as_ref)
                .map_or_else(|| RollingRecord::begin(now), |b| b.on(&now)),
        )
    });
    all.collect()
}

/// Returns the slip of a pair since the instant (m of its second contour); `None` if it is not
/// placed.
pub(super) fn slipped_m(scene: &Scene, c: &Configuration, r: RollingId) -> Option<f64> {
    let pair = &scene.rolling[r.0];
    let pose = |l: LinkId| if l == scene.ground { Some(Pose::GROUND) } else { c.poses[l.0] };
    let now = seen(pair, &c.shapes, &pose, &|_, p| c.points[p.0])?;
    let turned = c.rolled.get(r.0)?.as_ref()?.slip(pair, c.shapes.rolling[r.0], &now);
    let second_m = match pair.touch() {
        Touch::Point(Normal::Centres([a, b])) => {
            let [r1, r2] = c.shapes.rolling[r.0];
            c.points[a.0]?.distance(c.points[b.0]?) * (r2 / (r1 + r2)).abs()
        }
        Touch::Point(Normal::Square { .. }) | Touch::Strand { .. } => {
            c.shapes.rolling[r.0][1].abs()
        }
    };
    Some(turned * second_m)
}

/// Returns the deviation of a pair from the phase in the scene, as an angle of the second link of
/// half a turn at most; `None` if no phase is given.
pub(super) fn out_of_phase(
    scene: &Scene,
    shapes: &Shapes,
    r: RollingId,
    now: &RollingPose,
) -> Option<f64> {
    let (pair, [r1, r2]) = (&scene.rolling[r.0], shapes.rolling[r.0]);
    let phase = pair.phase.as_ref().filter(|_| pair.round().is_some())?;
    let line = now.line.unit()?;
    let mark = |l: LinkId| mark(scene, l, |p| shapes.local(l, p));
    let from_line =
        |i: usize| Some(mark(pair.links[i])?.rotate_by(now.axes[i]).divide_by(line).angle());
    let off = from_line(1)? + from_line(0)? * (r1 / r2) - phase.value.radians();
    Some(off - TAU * libm::round(off / TAU))
}

/// Returns the line of a link from which its angle is measured, in its frame: a unit vector. For
/// the ground it is the x axis, whatever pivots the ground has.
fn mark<N: Real>(
    scene: &Scene,
    l: LinkId,
    local: impl Fn(PointId) -> Option<Point<N>>,
) -> Option<Vec2<N>> {
    match &scene.links[l.0].points[..] {
        [p, q, ..] if l != scene.ground => (local(*q)? - local(*p)?).unit(),
        _ => Some(Vec2::unit_x()),
    }
}

/// Returns an angle known up to whole turns, close to an approximate value.
pub(super) fn whole<N: Real>(wrapped: N, near: f64) -> N {
    wrapped + N::from_f64(libm::round((near - wrapped.approx()) / TAU)) * (N::pi() + N::pi())
}

impl<N: Real> Assembly<'_, N> {
    /// Returns the pose of a link that rolls on a known one, as far as data determine it:
    /// coordinates of its points, the phase of the pair, or nothing if the link has no line.
    pub(super) fn poses_of_rolling(
        &self,
        link: LinkId,
        pivot: Option<PointId>,
        holds: &[Hold],
    ) -> Result<Vec<Pose<N>>, Diagnostic> {
        let shape = &self.shapes[link.0];
        let mut placed = shape.points.iter().filter_map(|(p, local)| {
            let at = if pivot == Some(*p) {
                self.points[p.0]
            } else {
                given_place(self.scene, &self.inputs, *p)
            };
            Some((*local, at?))
        });
        let (first, second) = (placed.next(), placed.next());
        let rolls = holds.iter().find_map(|h| {
            if let Hold::Rolls { pair, other, .. } = *h { Some((pair, other)) } else { None }
        });
        let Some((local, at)) = first else { return Err(self.no_closure(link)) };
        if let Some((far, far_at)) = second
            && self.instant.is_none()
        {
            let pose = Pose::from_point_and_direction(local, far - local, at, far_at - at);
            return Ok(pose.into_iter().collect());
        }
        let axis = match rolls.and_then(|(pair, other)| self.rolled(link, pair, other, at)) {
            Some(axis) => axis,
            None if shape.frame == FrameAnchor::Loose && self.instant.is_none() => Vec2::unit_x(),
            None => {
                return Err(rolls
                    .and_then(|(pair, _)| self.no_line(pair))
                    .unwrap_or_else(|| self.no_phase(link)));
            }
        };
        Ok(vec![Pose { origin: at - local.to_vec2().rotate_by(axis), axis }])
    }

    /// Returns the pose of a link from coordinates at the instant: the whole pose, or, for a wheel
    /// without a line, the position of its centre.
    pub(super) fn given_pose(
        &self,
        link: LinkId,
        given: &[(PointId, Point<N>)],
    ) -> Option<Pose<N>> {
        let shape = &self.shapes[link.0];
        let place = |p: PointId| {
            given.iter().find(|(q, _)| *q == p).map(|(_, at)| *at).or(self.points[p.0])
        };
        let loose = || {
            // At the instant the frame of a link with one point is arbitrary, unless a guide that
            // gives its direction runs over a pin.
            let rolls = self.scene.rolling.iter().any(|r| r.links.contains(&link));
            let turned = |d: &Driver| {
                d.kind.turned().is_some_and(|(l, _)| l == link) && d.kind.angle().is_some()
            };
            let alone = shape.frame == FrameAnchor::Loose
                && self.instant.is_none()
                && (rolls || !self.scene.drivers.iter().any(turned));
            let (own, local, at) = shape
                .points
                .iter()
                .filter(|_| alone)
                .find_map(|(p, local)| Some((*p, *local, place(*p)?)))?;
            let guides = self.scene.guides.iter().enumerate().filter(|(_, g)| g.on == link);
            let shown = guides
                .filter_map(|(g, guide)| {
                    Some((GuideId(g), guide.pin.filter(|p| *p != own && place(*p).is_some())?))
                })
                .next();
            match shown {
                Some((guide, pin)) if self.points[own.0].is_some() => {
                    self.poses_of_lever(link, own, pin, guide).ok()?.into_iter().next()
                }
                Some(_) => None,
                None => Some(Pose { origin: at - local.to_vec2(), axis: Vec2::unit_x() }),
            }
        };
        self.poses[link.0].or_else(loose)
    }

    /// Returns the pins of a group with coordinates, and those on a link with coordinates of two
    /// points.
    pub(super) fn given_pins_of(
        &self,
        group: &Group,
        mut given: Vec<(PointId, Point<N>)>,
    ) -> Vec<(PointId, Point<N>)> {
        for &p in &group.pins {
            let told = given.iter().any(|(q, _)| *q == p);
            let on_link = |l: &LinkId| {
                (self.shapes[l.0].frame == FrameAnchor::Plane).then(|| self.world(*l, p)).flatten()
            };
            given.extend(
                (!told).then(|| group.links.iter().find_map(on_link)).flatten().map(|at| (p, at)),
            );
        }
        given
    }

    /// Returns the direction of the frame of a rolling link with its wheel's centre at `at`, from
    /// the pose at the instant, or from the phase of the pair.
    fn rolled(&self, link: LinkId, id: RollingId, other: LinkId, at: Point<N>) -> Option<Vec2<N>> {
        let pair = &self.scene.rolling[id.0];
        let Some(centres) = pair.round() else { return self.rolled_on_track(link, id, at) };
        let own = usize::from(pair.links[1] == link);
        let [r1, r2] = pair.sizes(&self.inputs);
        // The sizes of this link, and of the one on which it rolls.
        let (mine, its) = if own == 1 { (r2, r1) } else { (r1, r2) };
        let line = {
            let d = at - self.points[centres[1 - own].0]?;
            if own == 1 { d } else { -d }
        };
        let other_axis = self.poses[other.0]?.axis;
        if let Some(then) = self.instant {
            let (before, was) = (
                then.points[centres[1].0]? - then.points[centres[0].0]?,
                then.poses[other.0]?.axis,
            );
            let meant = self.turned_as_meant(id);
            let line = whole(line.divide_by(before).angle(), meant[2]);
            let its_turn = whole(other_axis.divide_by(was).angle(), meant[1 - own]);
            let rolled = line - (its_turn - line) * (its / mine);
            return then.poses[link.0]?.axis.rotate_by(Vec2::from_angle(rolled)).unit();
        }
        // ρ₁(φ₁ − β) + ρ₂(φ₂ − β) = ρ₂·phase, with the angles of the links' lines.
        let written = pair.phase.as_ref()?;
        let (s, c) = self.inputs.sin_cos(written);
        // The whole turns of the phase do not belong to the first link.
        let phase = whole(Vec2::new(c, s).angle(), written.value.radians());
        let line = line.unit()?;
        let others = self.mark(other)?.rotate_by(other_axis).divide_by(line).angle();
        let near = others.approx() - turns_of(others.approx()) * TAU;
        let others =
            whole(others, self.written(other).map_or(near, |angle| angle - line.angle().approx()));
        let angle = (if own == 1 { phase } else { phase * (r2 / r1) }) - others * (its / mine);
        line.rotate_by(Vec2::from_angle(angle)).divide_by(self.mark(link)?).unit()
    }

    /// Returns the direction of a wheel on a straight track, or of the track's link on a wheel, at
    /// a later time: the displacement along the track turns the wheel.
    fn rolled_on_track(&self, link: LinkId, id: RollingId, at: Point<N>) -> Option<Vec2<N>> {
        let (pair, then) = (&self.scene.rolling[id.0], self.instant?);
        let [on, wheel] = pair.links;
        if link != wheel {
            return None;
        }
        let Relation::Slide { centre, guide } = pair.relation() else { return None };
        let Path::Line { through, direction } = self.guides[guide.0]? else { return None };
        let way = |pose: &Pose<N>, centre: Point<N>| direction.dot(pose.to_local(centre) - through);
        let (now, before) = (self.poses[on.0]?, then.poses[on.0]?);
        let gone = way(&now, at) - way(&before, then.points[centre.0]?);
        let turned = whole(now.axis.divide_by(before.axis).angle(), self.turned_as_meant(id)[0]);
        let [_, radius] = pair.sizes(&self.inputs);
        then.poses[wheel.0]?.axis.rotate_by(Vec2::from_angle(turned - gone / radius)).unit()
    }

    /// Returns the line, square to the track, on which a wheel that has rolled keeps the origin of
    /// a rack of known direction; `None` at the instant, when the rack may be anywhere.
    pub(super) fn origin_of_rack(
        &self,
        link: LinkId,
        axis: Vec2<N>,
        id: RollingId,
    ) -> Option<Locus<N>> {
        let (pair, then) = (&self.scene.rolling[id.0], self.instant?);
        let ([on, wheel], Relation::Slide { centre, guide }) = (pair.links, pair.relation()) else {
            return None;
        };
        let Path::Line { direction, .. } = self.guides[guide.0]? else { return None };
        if link != on {
            return None;
        }
        let (before, [_, radius]) = (then.poses[on.0]?, pair.sizes(&self.inputs));
        let meant = self.turned_as_meant(id);
        let of = |i: usize, l: LinkId, axis: Vec2<N>| {
            Some(whole(axis.divide_by(then.poses[l.0]?.axis).angle(), meant[i]))
        };
        let turned = of(1, wheel, self.poses[wheel.0]?.axis)? - of(0, on, axis)?;
        // t·(K − O) + ρ(φ₂ − φ₁) is constant.
        let way = direction.dot(before.turn_back(then.points[centre.0]? - before.origin))
            - radius * turned;
        let along = direction.rotate_by(axis);
        Some(Locus::Line {
            through: self.points[centre.0]? + along * -way,
            direction: along.perp(),
        })
    }

    /// Returns the rotations of links and line of a pair since the instant in the known pose, which
    /// is close to this one.
    fn turned_as_meant(&self, id: RollingId) -> [f64; 3] {
        self.meant.and_then(|m| m.rolled.get(id.0)?.as_ref()).map_or([0.0; 3], |r| r.turned)
    }

    pub(super) fn mark(&self, l: LinkId) -> Option<Vec2<N>> {
        mark(self.scene, l, |p| self.shapes[l.0].local(p))
    }

    /// Returns the angle of a link's line as a driver gives it, including whole turns.
    fn written(&self, l: LinkId) -> Option<f64> {
        let own = |d: &&Driver| {
            d.kind.turned() == Some((l, self.scene.ground)) && d.kind.lines()[0].is_none()
        };
        self.scene.drivers.iter().filter(own).find_map(|d| Some(d.kind.angle()?.value.radians()))
    }

    /// Returns the fault of a pair with coincident centres.
    fn no_line(&self, id: RollingId) -> Option<Diagnostic> {
        let pair = &self.scene.rolling[id.0];
        let [p, q] = pair.round()?;
        let (at, other) = (self.points[p.0]?.approx(), self.points[q.0]?.approx());
        (at.distance(other) == 0.0).then(|| coincident(self.scene, pair, [p, q]))
    }

    fn no_phase(&self, link: LinkId) -> Diagnostic {
        Diagnostic::error(
            "phase-needed",
            both!("nothing says at which angle wheel {} stands", self.scene.link_name(link)),
        )
        .at(self.scene.links[link.0].span)
        .help(both!(
            "give the coordinates of two of its points at the instant in \"points\", or \"phase\" with the pair"
        ))
    }
}

/// Returns the fault of the radii of two circles: their sum (for a ring their difference) must be
/// the distance of the centres.
pub(super) fn misfit(scene: &Scene, pair: &Rolling, c: &Configuration) -> Option<Diagnostic> {
    let centres @ [p, q] = match pair.touch() {
        Touch::Point(Normal::Centres(centres)) => centres,
        Touch::Point(Normal::Square { guide, .. }) => return belt::slack(scene, pair, guide, c),
        Touch::Strand { centres, .. } => {
            return belt::misfit(scene, pair, centres, pair.radii()?, c);
        }
    };
    let (at, other) = (c.points[p.0]?, c.points[q.0]?);
    let Some([a, b]) = pair.radii() else {
        return (at.distance(other) <= same_place(c.extent(), at))
            .then(|| coincident(scene, pair, centres));
    };
    let hollow = pair.hollow();
    let (given, distance) = (
        if hollow.is_some() { (a.value - b.value).abs() } else { a.value + b.value },
        at.distance(other),
    );
    if (given - distance).abs() <= same_place(c.extent().max(a.value.max(b.value)), at) {
        return None;
    }
    let (p, q) = (scene.point_name(p), scene.point_name(q));
    let (given, distance) = (scene.length_words(given), scene.length_words(distance));
    Some(
        Diagnostic::error(
            "gear-radii",
            match hollow {
                None => both!(
                    "the radii make the centres {given} apart, but {p}{q} is {distance}"
                ),
                Some(_) => both!(
                    "the radii make the centres {given} apart (one runs inside the other), but {p}{q} is {distance}"
                ),
            },
        )
        .at(pair.span)
        .help(if pair.kind.meshes() {
            both!(
                "correct a radius or a centre; \"teeth\" without \"module\" divide whatever distance there is; \"ring\" names an internal gear"
            )
        } else {
            both!(
                "correct a radius or a centre; \"inside\": true lets a wheel roll inside its track"
            )
        }),
    )
}

/// Returns the fault of two gears with coincident centres, which touch nowhere.
fn coincident(scene: &Scene, pair: &Rolling, [p, q]: [PointId; 2]) -> Diagnostic {
    let (p, q) = (scene.point_name(p), scene.point_name(q));
    Diagnostic::error(
        "no-contact",
        both!("{p} and {q} lie in one place: the two gears touch nowhere"),
    )
    .at(pair.span)
    .help(both!("place the centres apart from one another"))
}

#[cfg(test)]
mod tests;
