//! Places of a cam and its follower, as numbers and as the texts of the same numbers.
//!
//! This file handles cams whose follower is carried by the same link ([`super::carrier`]): the cam
//! on a pivot of the ground or of a moving link, the follower on a guide or pivot of that link; all
//! places are in its axes. If different links carry the two, the coordinates of the pose place them
//! ([`super::by_pose`]), or the position solver does, which needs no choice of a piece for one
//! circle.

use super::super::model::*;
use hodograph_base::cam::Follower;
use hodograph_base::geom::Vec2;

/// A number and its text, with a unit.
#[derive(Clone, Debug)]
pub(super) struct NumberText {
    pub value: f64,
    pub text: String,
}

impl NumberText {
    pub fn length(given: &GivenQuantity) -> NumberText {
        // A bare zero has no unit in a sum.
        NumberText {
            value: given.value,
            text: if given.value == 0.0 { "0 mm".into() } else { given.text.clone() },
        }
    }

    pub fn angle(given: &GivenQuantity<Angle>) -> NumberText {
        let value = given.value.radians();
        NumberText { value, text: if value == 0.0 { "0 deg".into() } else { given.text.clone() } }
    }
}

/// A point with coordinates.
#[derive(Clone, Debug)]
pub(super) struct PointTexts {
    pub x: NumberText,
    pub y: NumberText,
}

impl PointTexts {
    pub fn of(xy: &[GivenQuantity; 2]) -> PointTexts {
        PointTexts { x: NumberText::length(&xy[0]), y: NumberText::length(&xy[1]) }
    }

    pub fn at(&self) -> Vec2 {
        Vec2::new(self.x.value, self.y.value)
    }

    /// Returns the texts of the vector to another point; only components written as zero are
    /// omitted.
    pub fn way_to(&self, other: &PointTexts) -> [String; 2] {
        let part = |a: &NumberText, b: &NumberText| match (a.value == 0.0, b.value == 0.0) {
            (true, true) => "(0 mm)".to_owned(),
            (true, false) => format!("({})", b.text),
            (false, true) => format!("(-({}))", a.text),
            (false, false) => format!("(({})-({}))", b.text, a.text),
        };
        [part(&self.x, &other.x), part(&self.y, &other.y)]
    }
}

/// A cam on a pivot of the link that carries it and its follower.
#[derive(Clone, Debug)]
pub(super) struct OnPivot {
    /// The carrying link.
    pub frame: LinkId,
    pub pivot: PointId,
    pub spot: PointTexts,
    pub driver: usize,
    /// Ratio of the cam's rotation in the carrying link to the driver's.
    pub way: f64,
    /// Angle of the cam at driver position 0 (rad).
    pub from: f64,
    /// Angle of the cam's first two points.
    pub angle: NumberText,
    pub rate: f64,
    pub rate_text: String,
    pub acceleration: f64,
    pub acceleration_text: String,
    /// Its points in the frame of the cam: origin at the pivot, x along its first two points.
    pub local: Vec<(PointId, Vec2)>,
}

/// A follower on the link that carries the cam.
#[derive(Clone, Debug)]
pub(super) enum CarriedFollower {
    /// On a straight guide at this angle through this point, with its point on the guide.
    Guide { through: PointTexts, angle: NumberText, pin: PointId },
    /// On a pivot.
    Pivot { pivot: PointId, spot: PointTexts },
}

/// Returns the coordinates of a point, if it has them.
pub(super) fn spot(scene: &Scene, p: PointId) -> Option<PointTexts> {
    match &scene.points[p.0].place {
        PointPlace::At(xy) => Some(PointTexts::of(xy)),
        PointPlace::Unknown | PointPlace::InLink { .. } | PointPlace::Polar { .. } => None,
    }
}

/// Returns the text of the direction from one point to another.
pub(super) fn direction(from: &PointTexts, to: &PointTexts) -> String {
    let (way, [x, y]) = (to.at() - from.at(), from.way_to(to));
    if way.x == 0.0 {
        return if way.y < 0.0 { "-90 deg" } else { "90 deg" }.to_owned();
    }
    if way.y == 0.0 {
        return if way.x < 0.0 { "180 deg" } else { "0 deg" }.to_owned();
    }
    // The same branch of the angle as that of the computed number.
    let turned = match (way.x < 0.0, way.y < 0.0) {
        (true, true) => "-180 deg",
        (true, false) => "+180 deg",
        (false, _) => "",
    };
    format!("atan({y}/{x}){turned}")
}

/// Returns the text of the distance of two points with coordinates.
pub(super) fn distance(from: &PointTexts, to: &PointTexts) -> String {
    let (way, [x, y]) = (to.at() - from.at(), from.way_to(to));
    match (way.x == 0.0, way.y == 0.0) {
        (_, true) => format!("abs({x})"),
        (true, false) => format!("abs({y})"),
        (false, false) => format!("sqrt({x}^2+{y}^2)"),
    }
}

/// Returns the distance of two points of a link, with its text: a given length, or from coordinates
/// in the fixed plane or in the link.
pub(super) fn apart(scene: &Scene, a: PointId, b: PointId) -> Option<NumberText> {
    let given = scene.lengths.iter().find(|l| (l.a, l.b) == (a, b) || (l.a, l.b) == (b, a));
    if let Some(l) = given {
        return Some(NumberText::length(&l.value));
    }
    if let (Some(p), Some(q)) = (spot(scene, a), spot(scene, b)) {
        return Some(NumberText { value: (q.at() - p.at()).norm(), text: distance(&p, &q) });
    }
    [(a, b), (b, a)].into_iter().find_map(|(p, origin)| match &scene.points[p.0].place {
        PointPlace::InLink { base, xy } if base.0 == origin => {
            let [x, y] = [0, 1].map(|i| NumberText::length(&xy[i]));
            Some(NumberText {
                value: libm::hypot(x.value, y.value),
                text: format!("sqrt(({})^2+({})^2)", x.text, y.text),
            })
        }
        PointPlace::Polar { base, length, .. } if base.0 == origin => {
            Some(NumberText::length(length))
        }
        PointPlace::Unknown
        | PointPlace::At(_)
        | PointPlace::InLink { .. }
        | PointPlace::Polar { .. } => None,
    })
}

/// Returns the points of a link in its own frame, with the origin at the pivot; points without a
/// place are omitted.
pub(super) fn locals(
    scene: &Scene,
    link: LinkId,
    pivot: PointId,
    angle: f64,
) -> Option<Vec<(PointId, Vec2)>> {
    let points = &scene.links[link.0].points;
    let mut known: Vec<(PointId, Vec2)> = Vec::new();
    if link == scene.ground {
        known.extend(points.iter().filter_map(|p| Some((*p, spot(scene, *p)?.at()))));
    } else if let Some(spots) = points.iter().map(|p| spot(scene, *p)).collect::<Option<Vec<_>>>() {
        let back = Vec2::from_angle(-angle);
        known.extend(points.iter().zip(spots).map(|(p, s)| (*p, s.at().rotate_by(back))));
    } else {
        let [first, second, ..] = points.as_slice() else { return None };
        known.push((*first, Vec2::ZERO));
        known.push((*second, Vec2::new(apart(scene, *first, *second)?.value, 0.0)));
        // Each pass places at least one point.
        for _ in 2..points.len() {
            for p in points {
                let at = |q: PointId, known: &[(PointId, Vec2)]| {
                    known.iter().find(|(k, _)| *k == q).map(|(_, at)| *at)
                };
                if at(*p, &known).is_none()
                    && let Some(found) = local(scene, *p, &|q| at(q, &known), points)
                {
                    known.push((*p, found));
                }
            }
        }
    }
    let origin = known.iter().find(|(p, _)| *p == pivot)?.1;
    Some(known.into_iter().map(|(p, at)| (p, at - origin)).collect())
}

/// Returns a point of a link from the known ones.
fn local(
    scene: &Scene,
    p: PointId,
    at: &dyn Fn(PointId) -> Option<Vec2>,
    points: &[PointId],
) -> Option<Vec2> {
    let base = |(a, b): (PointId, PointId)| {
        let (a, b) = (at(a)?, at(b)?);
        Some((a, (b - a).unit()?))
    };
    match &scene.points[p.0].place {
        PointPlace::InLink { base: ab, xy } => {
            base(*ab).map(|(a, u)| a + u * xy[0].value + u.perp() * xy[1].value)
        }
        PointPlace::Polar { base: ab, length, angle } => base(*ab)
            .map(|(a, u)| a + u.rotate_by(Vec2::from_angle(angle.value.radians())) * length.value),
        PointPlace::Unknown | PointPlace::At(_) => {
            let mut reach = points
                .iter()
                .filter(|q| **q != p)
                .filter_map(|q| Some((*q, at(*q)?, apart(scene, p, *q)?.value)));
            let ((i, a, ra), (j, b, rb)) = (reach.next()?, reach.next()?);
            let way = b - a;
            let d = way.norm();
            let foot = (d * d + ra * ra - rb * rb) / (2.0 * d);
            let height = (ra * ra - foot * foot).max(0.0).sqrt();
            let said = scene
                .sides
                .iter()
                .find(|s| s.point == p && [(i, j), (j, i)].contains(&(s.from, s.to)));
            let left = said.is_none_or(|s| s.left == (s.from == i));
            let u = way * (1.0 / d);
            Some(a + u * foot + u.perp() * if left { height } else { -height })
        }
    }
}

/// Returns the coordinates of a point, or else its place in the sketch.
pub(super) fn coordinates_or_sketch(scene: &Scene, p: PointId) -> Option<Vec2> {
    spot(scene, p).map(|s| s.at()).or(scene.points[p.0].sketch.map(|[x, y]| Vec2::new(x, y)))
}

/// Returns the outward sense of an arm: from `side`, else from the sketch or coordinates, else
/// counter-clockwise. `spots` are the places of pivot and centre, `told` that of the point, all in
/// one link.
pub(super) fn sense(
    scene: &Scene,
    [pivot, centre, point]: [PointId; 3],
    spots: [Vec2; 2],
    told: Option<Vec2>,
) -> f64 {
    let said = scene
        .sides
        .iter()
        .find(|s| s.point == point && [(pivot, centre), (centre, pivot)].contains(&(s.from, s.to)));
    if let Some(s) = said {
        return if s.left == (s.from == pivot) { 1.0 } else { -1.0 };
    }
    let [p, o] = spots;
    match told.map(|b| (o - p).cross(b - p)) {
        Some(turn) if turn < 0.0 => -1.0,
        Some(_) | None => 1.0,
    }
}

/// Returns the follower for the geometry of a cam whose pivot is at `centre`: `sense` is +1 if it
/// moves outward along its guide, or counter-clockwise.
pub(super) fn geometry(carried: &CarriedFollower, centre: Vec2, arm: f64, sense: f64) -> Follower {
    match carried {
        CarriedFollower::Guide { through, angle, .. } => {
            let direction = Vec2::from_angle(angle.value) * sense;
            Follower::Translating {
                direction,
                offset: -(through.at() - centre).dot(direction.perp()),
            }
        }
        CarriedFollower::Pivot { spot, .. } => {
            Follower::Oscillating { pivot: spot.at() - centre, arm, sense }
        }
    }
}

/// Returns the follower's own coordinate at the zero of the cam's geometry, and +1 if the two grow
/// together, else −1.
pub(super) fn origin(carried: &CarriedFollower, centre: Vec2, follower: &Follower) -> (f64, f64) {
    let start = match carried {
        CarriedFollower::Guide { through, angle, .. } => {
            (centre - through.at()).dot(Vec2::from_angle(angle.value))
        }
        CarriedFollower::Pivot { spot, .. } => (centre - spot.at()).angle(),
    };
    (start, outward(carried, follower))
}

/// Returns the outward sense of the follower: +1 along the direction of its guide, or
/// counter-clockwise about its pivot, else −1.
pub(super) fn outward(carried: &CarriedFollower, follower: &Follower) -> f64 {
    match (carried, follower) {
        (CarriedFollower::Guide { angle, .. }, Follower::Translating { direction, .. }) => {
            direction.dot(Vec2::from_angle(angle.value)).signum()
        }
        (_, Follower::Oscillating { sense, .. }) => *sense,
        (CarriedFollower::Pivot { .. }, Follower::Translating { .. }) => 1.0,
    }
}
