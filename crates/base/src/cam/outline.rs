//! A profile of arcs and lines, in the frame of the cam: its contact with the follower, and the
//! follower's coordinate on each piece.
//!
//! A follower with a round end keeps its centre at the distance ρ + r from the centre of an arc, or
//! on the parallel of a line at the distance r; the centre of an arc keeps the distance ρ from a
//! flat face. These are the equivalent linkages 高副低代. They are exact on the whole piece,
//! including every derivative.

use super::disc::{Follower, FollowerTip};
use super::jet::{CamJet, Plane};
use super::{in_half_turns, in_turn, whole_turns};
use crate::geom::Vec2;
use crate::number::Real;
use std::f64::consts::TAU;

/// A piece of a profile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ProfileSegment<N = f64> {
    /// An arc.
    Arc {
        /// The centre.
        centre: Vec2<N>,
        /// Radius (m): negative on a hollow flank, zero at a corner.
        radius: N,
        /// Directions of the outward normal at the beginning and the end, counter-clockwise round
        /// the profile (rad); a whole turn apart on a circle.
        normals: [N; 2],
    },
    /// A straight flank.
    Line {
        /// Direction of the outward normal (rad).
        normal: N,
        /// Distance of the line from the origin (m).
        distance: N,
        /// Beginning and end, measured along the normal turned by +90° (m).
        ends: [N; 2],
    },
}

/// Relative tolerance at the ends of a piece: joints are computed from both sides.
const ON: f64 = 1e-12;

impl<N: Real> ProfileSegment<N> {
    /// Returns the radius of curvature, convex positive; a line has an infinite radius.
    pub fn radius(&self) -> N {
        match self {
            ProfileSegment::Arc { radius, .. } => *radius,
            ProfileSegment::Line { .. } => N::from_f64(f64::INFINITY),
        }
    }

    /// Returns the follower's coordinate (see [`super::Disc`]) in contact with this piece, with the
    /// cam turned by `turn`; undecided if no contact is possible.
    pub fn coordinate(
        &self,
        follower: &Follower<N>,
        touch: &FollowerTip<N>,
        turn: CamJet<N>,
    ) -> CamJet<N> {
        let nothing = || CamJet::constant(N::from_f64(f64::NAN));
        match (self, *touch) {
            (ProfileSegment::Arc { centre, radius, .. }, FollowerTip::Point { radius: r }) => {
                let k = Plane::constant(*centre).turned(turn);
                follower.at_distance(k, *radius + r)
            }
            (ProfileSegment::Arc { centre, radius, .. }, FollowerTip::Flat { lever }) => {
                if radius.approx() < 0.0 {
                    return nothing();
                }
                follower.faced(Plane::constant(*centre).turned(turn), *radius, lever)
            }
            (ProfileSegment::Line { normal, distance, .. }, FollowerTip::Point { radius }) => {
                follower.along_line(turn + CamJet::constant(*normal), *distance + radius)
            }
            // Two lines touch only at their ends, which are corners.
            (ProfileSegment::Line { .. }, FollowerTip::Flat { .. }) => nothing(),
        }
    }
}

impl ProfileSegment {
    /// Returns true if the follower at this coordinate touches within the piece.
    pub fn holds(
        &self,
        follower: &Follower,
        touch: &FollowerTip,
        turn: f64,
        coordinate: f64,
    ) -> bool {
        let back = CamJet::constant(-turn);
        let q = CamJet::constant(coordinate);
        match *touch {
            FollowerTip::Flat { .. } => self.faces(follower.normal(q).turned(back).angle().value()),
            FollowerTip::Point { radius } => {
                let b = follower.point(q).turned(back).order(0);
                match self {
                    ProfileSegment::Arc { centre, radius: rho, .. } => {
                        let n = (b - *centre) * (1.0 / (rho + radius));
                        self.faces(libm::atan2(n.y, n.x))
                    }
                    ProfileSegment::Line { normal, ends: [from, to], .. } => {
                        let along = Vec2::from_angle(*normal).perp().dot(b);
                        let slack = ON * (to - from).abs().max(b.norm());
                        (from - slack..=to + slack).contains(&along)
                    }
                }
            }
        }
    }

    /// Returns the gap between a round end about a point and the piece (m), with the point in the
    /// frame of the cam; `None` if the point lies beyond the piece's ends.
    pub fn missed_by(&self, end: Vec2, radius: f64) -> Option<f64> {
        match self {
            ProfileSegment::Arc { centre, radius: rho, .. } => {
                let (way, length) = (end - *centre, rho + radius);
                let outward = if length < 0.0 { -way } else { way };
                self.faces(outward.angle()).then(|| way.norm() - length.abs())
            }
            ProfileSegment::Line { normal, distance, ends: [from, to] } => {
                let n = Vec2::from_angle(*normal);
                let along = n.perp().dot(end);
                let slack = ON * (to - from).abs().max(end.norm());
                (from - slack..=to + slack).contains(&along).then(|| n.dot(end) - distance - radius)
            }
        }
    }

    /// Returns the amounts by which the contact of a round end about a point lies beyond the
    /// beginning and beyond the end of the piece, with the point in the frame of the cam: angles of
    /// the normal (rad) on an arc, fractions of the length on a line; negative within the piece.
    pub fn beyond(&self, end: Vec2, radius: f64) -> [f64; 2] {
        match self {
            ProfileSegment::Arc { centre, radius: rho, .. } => {
                let way = end - *centre;
                self.beyond_facing((if rho + radius < 0.0 { -way } else { way }).angle())
            }
            ProfileSegment::Line { normal, ends: [from, to], .. } => {
                let along = Vec2::from_angle(*normal).perp().dot(end);
                [(from - along) / (to - from), (along - to) / (to - from)]
            }
        }
    }

    /// Returns the amounts by which the contact of a flat face lies beyond the beginning and the
    /// end of the piece, as angles of the normal (rad), for a direction of the normal in the cam;
    /// infinite for a line.
    pub fn beyond_facing(&self, direction: f64) -> [f64; 2] {
        match self {
            ProfileSegment::Arc { normals: [from, to], .. } => {
                let way = in_half_turns(direction - 0.5 * (from + to)) * (to - from).signum();
                let half = 0.5 * (to - from).abs();
                [-way - half, way - half]
            }
            ProfileSegment::Line { .. } => [f64::INFINITY; 2],
        }
    }

    /// Returns true if an arc has an outward normal of this direction.
    pub fn faces(&self, direction: f64) -> bool {
        match self {
            ProfileSegment::Arc { normals: [from, to], .. } => {
                let (low, high) = (from.min(*to), from.max(*to));
                high - low >= TAU - ON
                    || in_half_turns(direction - 0.5 * (low + high)).abs()
                        <= 0.5 * (high - low) + ON
            }
            ProfileSegment::Line { .. } => false,
        }
    }

    /// Returns points along the piece, for drawing; `most` is the largest angle of an arc between
    /// two of them.
    pub fn points(&self, most: f64) -> Vec<Vec2> {
        match *self {
            ProfileSegment::Arc { centre, radius, normals: [from, to] } => {
                let count = libm::ceil((to - from).abs() / most).max(1.0) as usize;
                let at = |k: usize| {
                    centre + Vec2::from_angle(from + (to - from) * k as f64 / count as f64) * radius
                };
                (0..=count).map(at).collect()
            }
            ProfileSegment::Line { normal, distance, ends } => {
                let n = Vec2::from_angle(normal);
                ends.iter().map(|t| n * distance + n.perp() * *t).collect()
            }
        }
    }
}

/// A part of a profile in a scene: a circle, or the piece between two circles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ProfilePart<N = f64> {
    /// An arc about a centre with a radius; zero makes a corner.
    Circle(Vec2<N>, N),
    /// The outer tangent of the preceding and the following circle.
    Tangent,
    /// An arc of this radius that touches the preceding and the following circle; a negative radius
    /// is hollow.
    Flank(N),
}

/// The reason why the parts do not form a profile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Broken {
    /// There is no circle, or a tangent or flank is alone.
    NoCircle,
    /// This tangent or flank has no circle on one of its sides.
    NoNeighbour(usize),
    /// This part cannot touch both its neighbours: their centres are too near or too far.
    Apart(usize),
}

/// Returns the pieces of a closed profile, counter-clockwise, one for each part. The second of two
/// adjacent circles begins at their point of contact or intersection.
///
/// # Errors
/// The first part that does not fit between its neighbours.
pub fn segments<N: Real>(parts: &[ProfilePart<N>]) -> Result<Vec<ProfileSegment<N>>, Broken> {
    let n = parts.len();
    if let [ProfilePart::Circle(centre, radius)] = parts {
        return Ok(vec![ProfileSegment::Arc {
            centre: *centre,
            radius: *radius,
            normals: [N::from_f64(0.0), whole_turns(1.0)],
        }]);
    }
    let circle = |i: usize| match parts[i % n] {
        ProfilePart::Circle(c, r) => Some((c, r)),
        ProfilePart::Tangent | ProfilePart::Flank(_) => None,
    };
    if n == 0 || (0..n).all(|i| circle(i).is_none()) {
        return Err(Broken::NoCircle);
    }
    // Beginning and end of each circle.
    let mut ends = vec![[N::from_f64(0.0); 2]; n];
    let mut made: Vec<Option<ProfileSegment<N>>> = vec![None; n];
    for i in 0..n {
        let next = (i + 1) % n;
        match parts[i] {
            ProfilePart::Circle(a, ra) => {
                // A circle directly after this one.
                let Some((b, rb)) = circle(next).filter(|_| next != i) else { continue };
                let [from, to] = crossing(a, ra, b, rb).ok_or(Broken::Apart(next))?;
                (ends[i][1], ends[next][0]) = (from, to);
            }
            ProfilePart::Tangent | ProfilePart::Flank(_) => {
                let before = (i + n - 1) % n;
                let ((a, ra), (b, rb)) =
                    circle(before).zip(circle(next)).ok_or(Broken::NoNeighbour(i))?;
                let (segment, from, to) = match parts[i] {
                    ProfilePart::Flank(radius) => flank(a, ra, b, rb, radius),
                    ProfilePart::Tangent | ProfilePart::Circle(..) => tangent(a, ra, b, rb),
                }
                .ok_or(Broken::Apart(i))?;
                (ends[before][1], ends[next][0], made[i]) = (from, to, Some(segment));
            }
        }
    }
    let one = |i: usize| match parts[i] {
        ProfilePart::Circle(centre, radius) => {
            let [from, to] = ends[i];
            // Counter-clockwise, less than a turn.
            Some(ProfileSegment::Arc {
                centre,
                radius,
                normals: [from, from + counter_clockwise(to - from)],
            })
        }
        ProfilePart::Tangent | ProfilePart::Flank(_) => made[i],
    };
    (0..n).map(one).collect::<Option<Vec<_>>>().ok_or(Broken::NoCircle)
}

/// Returns an angle reduced to [0, 2π).
fn counter_clockwise<N: Real>(angle: N) -> N {
    let nearest = angle.approx();
    angle + whole_turns(libm::rint((in_turn(nearest) - nearest) / TAU))
}

/// Returns the outer tangent on the right of the direction from one centre to the other, and the
/// direction of its normal, twice.
fn tangent<N: Real>(a: Vec2<N>, ra: N, b: Vec2<N>, rb: N) -> Option<(ProfileSegment<N>, N, N)> {
    let way = b - a;
    let cosine = (ra - rb) / way.norm();
    if !cosine.is_decided() || cosine.approx().abs() > 1.0 {
        return None;
    }
    let normal = way.angle() - CamJet::constant(cosine).arc_cosine().value();
    let n = Vec2::from_angle(normal);
    let along = n.perp();
    Some((
        ProfileSegment::Line {
            normal,
            distance: a.dot(n) + ra,
            ends: [a.dot(along), b.dot(along)],
        },
        normal,
        normal,
    ))
}

/// Returns an arc of a radius that touches two circles on the right of the direction from one
/// centre to the other.
fn flank<N: Real>(
    a: Vec2<N>,
    ra: N,
    b: Vec2<N>,
    rb: N,
    radius: N,
) -> Option<(ProfileSegment<N>, N, N)> {
    let way = b - a;
    let (d, la, lb) = (way.norm(), radius - ra, radius - rb);
    let foot = (d * d + la * la - lb * lb) / (N::from_f64(2.0) * d);
    let height = (la * la - foot * foot).sqrt();
    if !height.is_decided() {
        return None;
    }
    let u = way * (N::from_f64(1.0) / d);
    let convex = radius.approx() > 0.0;
    // The centre of a convex flank lies on the opposite side of the line of centres, that of a
    // hollow flank on the same side.
    let centre = a + u * foot + u.perp() * if convex { height } else { -height };
    let normal = |of: Vec2<N>| if convex { (of - centre).angle() } else { (centre - of).angle() };
    // A circle larger than the flank would be touched from inside.
    if convex && (radius.approx() <= ra.approx() || radius.approx() <= rb.approx()) {
        return None;
    }
    let (from, to) = (normal(a), normal(b));
    Some((
        ProfileSegment::Arc { centre, radius, normals: [from, from + in_half_turns(to - from)] },
        from,
        to,
    ))
}

/// Returns the directions of the normals of two circles at their intersection on the right of the
/// direction between their centres.
fn crossing<N: Real>(a: Vec2<N>, ra: N, b: Vec2<N>, rb: N) -> Option<[N; 2]> {
    let way = b - a;
    let d = way.norm();
    let foot = (d * d + ra * ra - rb * rb) / (N::from_f64(2.0) * d);
    let square = ra * ra - foot * foot;
    // The distance of touching circles is inexact by rounding.
    if !square.is_decided() || square.approx() < -1e-9 * ra.approx() * ra.approx() {
        return None;
    }
    let u = way * (N::from_f64(1.0) / d);
    let at = a + u * foot - u.perp() * square.sqrt_or_zero();
    let direction =
        |of: Vec2<N>, r: N| if r.approx() > 0.0 { (at - of).angle() } else { way.angle() };
    Some([direction(a, ra), direction(b, rb)])
}
