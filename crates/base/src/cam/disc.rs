//! A disc cam with its follower: the follower's position, the profile by inversion 反转法, pressure
//! angle and radius of curvature at any angle.
//!
//! The coordinate q of a translating follower is the displacement of its point (or face) along the
//! direction of the lift, measured from the foot of the perpendicular from the cam's centre. The
//! coordinate q of an oscillating follower is the angle of its arm (or face) from the line
//! pivot–centre, positive outward. The lift s is q less its least value on the base circle.

use super::jet::{CamJet, Plane};
use super::outline::ProfileSegment;
use super::{PieceSide, PreparedDisc, StageProgram, in_half_turns};
use crate::geom::Vec2;
use crate::number::Real;

/// The motion of the follower. The origin is the centre of the cam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Follower<N = f64> {
    /// Along a straight guide 直动.
    Translating {
        /// Unit vector of the lift.
        direction: Vec2<N>,
        /// Distance of the path of the follower's point from the centre (m), positive to the right
        /// of the direction 偏距.
        offset: N,
    },
    /// About a pivot 摆动.
    Oscillating {
        /// The pivot (m).
        pivot: Vec2<N>,
        /// Length from the pivot to the follower's point (m); without meaning for a flat face.
        arm: N,
        /// +1 if the arm turns counter-clockwise as it goes out, −1 otherwise.
        sense: f64,
    },
}

impl<N: Real> Follower<N> {
    /// Returns the angle of the direction from the pivot to the centre of the cam (rad).
    fn centre_line(pivot: Vec2<N>) -> N {
        (-pivot).angle()
    }

    /// Returns the follower's point at a coordinate; for a translating face, its point on the line
    /// of the guide.
    pub fn point(&self, q: CamJet<N>) -> Plane<N> {
        match *self {
            Follower::Translating { direction, offset } => {
                Plane::constant(direction.perp() * -offset) + Plane::constant(direction) * q
            }
            Follower::Oscillating { pivot, arm, sense } => {
                let u = Plane::direction(
                    q.signed(sense) + CamJet::constant(Follower::centre_line(pivot)),
                );
                Plane::constant(pivot) + u * CamJet::constant(arm)
            }
        }
    }

    /// Returns the outward normal of a flat face: away from the cam. A translating face is square
    /// to its guide.
    pub fn normal(&self, q: CamJet<N>) -> Plane<N> {
        match *self {
            Follower::Translating { direction, .. } => Plane::constant(direction),
            Follower::Oscillating { pivot, sense, .. } => {
                Plane::direction(q.signed(sense) + CamJet::constant(Follower::centre_line(pivot)))
                    .perp()
                    .signed(sense)
            }
        }
    }

    /// Returns the direction in which the follower's point moves outward.
    fn outward(&self, q: N) -> Vec2<N> {
        match *self {
            Follower::Translating { direction, .. } => direction,
            Follower::Oscillating { .. } => self.normal(CamJet::constant(q)).order(0),
        }
    }

    /// Returns the coordinate at which the follower's point has a given distance from K; a negative
    /// distance means that K lies beyond it.
    pub(super) fn at_distance(&self, k: Plane<N>, distance: N) -> CamJet<N> {
        let (square, way) = (
            CamJet::constant(distance * distance),
            if distance.approx() < 0.0 { -1.0 } else { 1.0 },
        );
        match *self {
            Follower::Translating { direction, offset } => {
                let d = Plane::constant(direction);
                let aside = CamJet::constant(offset) + k.dot(d.perp());
                k.dot(d) + (square - aside * aside).sqrt().signed(way)
            }
            Follower::Oscillating { pivot, arm, sense } => {
                let pk = k - Plane::constant(pivot);
                let apart = pk.dot(pk);
                let twice = N::from_f64(2.0) * arm;
                let cosine =
                    (apart + CamJet::constant(arm * arm) - square) * (apart.sqrt() * twice).recip();
                let at = pk.angle() + cosine.arc_cosine().signed(sense * way);
                Follower::from_centre_line(at, pivot, sense)
            }
        }
    }

    /// Returns the coordinate at which a flat face, offset by `lever` from its pivot, has a given
    /// distance from K.
    pub(super) fn faced(&self, k: Plane<N>, distance: N, lever: N) -> CamJet<N> {
        match *self {
            Follower::Translating { direction, .. } => {
                k.dot(Plane::constant(direction)) + CamJet::constant(distance)
            }
            Follower::Oscillating { pivot, sense, .. } => {
                let pk = k - Plane::constant(pivot);
                let sine = CamJet::constant(lever - distance) * pk.dot(pk).sqrt().recip();
                Follower::from_centre_line(pk.angle() - sine.arc_sine().signed(sense), pivot, sense)
            }
        }
    }

    /// Returns the coordinate at which the follower's point lies on the line with this normal at
    /// this distance from the origin.
    pub(super) fn along_line(&self, normal: CamJet<N>, distance: N) -> CamJet<N> {
        let n = Plane::direction(normal);
        match *self {
            Follower::Translating { direction, offset } => {
                let (d, aside) =
                    (Plane::constant(direction), Plane::constant(direction.perp() * -offset));
                let slope = d.dot(n);
                if slope.value().approx() <= 0.0 {
                    return CamJet::constant(N::from_f64(f64::NAN));
                }
                (CamJet::constant(distance) - aside.dot(n)) * slope.recip()
            }
            Follower::Oscillating { pivot, arm, sense } => {
                let cosine = (CamJet::constant(distance) - Plane::constant(pivot).dot(n))
                    * (N::from_f64(1.0) / arm);
                Follower::from_centre_line(normal - cosine.arc_cosine().signed(sense), pivot, sense)
            }
        }
    }

    /// Returns the coordinate that belongs to a direction of the arm.
    fn from_centre_line(at: CamJet<N>, pivot: Vec2<N>, sense: f64) -> CamJet<N> {
        let mut q = (at - CamJet::constant(Follower::centre_line(pivot))).signed(sense);
        q.0[0] = in_half_turns(q.0[0]);
        q
    }
}

/// The end of the follower that touches the cam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FollowerTip<N = f64> {
    /// A round end about the follower's point: a roller 滚子, an arc (mushroom), or with radius 0 a
    /// knife edge 尖顶.
    Point {
        /// Radius (m).
        radius: N,
    },
    /// A flat face 平底.
    Flat {
        /// Offset of the face from the pivot of an oscillating follower, outward (m); without
        /// meaning for a translating follower.
        lever: N,
    },
}

/// The source of the follower's motion.
#[derive(Clone, Debug, PartialEq)]
pub enum CamMotion<N = f64> {
    /// A law; the profile follows from it.
    Law {
        /// Radius of the base circle of the profile (m) 基圆.
        base: N,
        /// The stages.
        program: StageProgram<N>,
    },
    /// A profile; the motion follows from it.
    Profile(Vec<ProfileSegment<N>>),
}

/// A cam with its follower.
#[derive(Clone, Debug, PartialEq)]
pub struct Disc<N = f64> {
    /// The motion of the follower.
    pub follower: Follower<N>,
    /// The end of the follower.
    pub touch: FollowerTip<N>,
    /// The source of the motion.
    pub motion: CamMotion<N>,
    /// +1 if φ grows counter-clockwise, −1 if the cam turns clockwise.
    pub sense: f64,
}

/// The formula that applies at an angle of the cam, valid between two joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Branch {
    /// A stage of the law and a piece of its motion law.
    Stage(usize, usize),
    /// A piece of the profile.
    Piece(usize),
}

/// The state of the cam at one angle. Points and directions are in the frame of the cam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CamStation<N = f64> {
    /// The angle (rad).
    pub phi: N,
    /// The coordinate of the follower, with its derivatives.
    pub q: CamJet<N>,
    /// The follower's point on the pitch curve 理论廓线; for a flat face its foot: the point of the
    /// face on the line of the guide or pivot.
    pub pitch: Vec2<N>,
    /// The point of contact, on the profile 实际廓线.
    pub contact: Vec2<N>,
    /// The outward normal at the contact.
    pub normal: Vec2<N>,
    /// Radius of curvature of the profile (m), convex positive.
    pub rho: N,
    /// Radius of curvature of the pitch curve (m); for a flat face that of the profile.
    pub rho_pitch: N,
    /// Derivative of the radius of curvature by φ.
    pub rho_slope: N,
    /// Pressure angle (rad) from the follower's direction of motion to the normal, positive in the
    /// cam's sense of rotation 压力角.
    pub pressure: N,
    /// Derivative of the pressure angle by φ, for a round end.
    pub pressure_slope: N,
}

impl<N: Real> CamStation<N> {
    /// Returns the centre of curvature of the profile.
    pub fn centre(&self) -> Vec2<N> {
        self.contact - self.normal * self.rho
    }
}

/// Step (rad) beside a joint at which the next piece is determined: larger than the rounding error
/// of a joint's angle, and far smaller than a piece.
pub(super) const BESIDE: f64 = 1e-9;

/// The contact as computed from the follower's end.
struct ContactGeometry<N> {
    pitch: Vec2<N>,
    contact: Vec2<N>,
    normal: Vec2<N>,
    /// Rate at which the normal turns in the cam as φ grows.
    turning: N,
    rho: N,
    rho_pitch: N,
    rho_slope: N,
}

impl<N: Real> Disc<N> {
    /// Returns the radius of the circle about the centre on which the follower's point lies when it
    /// is on the base circle, or which the face touches.
    fn reach(&self, base: N) -> N {
        match self.touch {
            FollowerTip::Point { radius } => base + radius,
            FollowerTip::Flat { .. } => base,
        }
    }

    /// Returns the coordinate on a base circle of this radius; undecided if the follower cannot
    /// touch it.
    pub fn rest(&self, base: N) -> N {
        let reach = self.reach(base);
        let centre = Plane::constant(Vec2::zero());
        match self.touch {
            FollowerTip::Point { .. } => self.follower.at_distance(centre, reach),
            FollowerTip::Flat { lever } => self.follower.faced(centre, reach, lever),
        }
        .value()
    }

    fn signed(&self, x: N) -> N {
        if self.sense < 0.0 { -x } else { x }
    }

    /// Returns the follower's coordinate with its derivatives by φ, by the formula of a branch.
    pub fn coordinate_on(&self, branch: Branch, phi: N) -> Option<CamJet<N>> {
        let q = match (&self.motion, branch) {
            (CamMotion::Law { base, program }, Branch::Stage(stage, piece)) => {
                program.lift_in((stage, piece), phi)? + CamJet::constant(self.rest(*base))
            }
            (CamMotion::Profile(segments), Branch::Piece(piece)) => segments
                .get(piece)?
                .coordinate(&self.follower, &self.touch, CamJet::variable(phi).signed(self.sense)),
            (CamMotion::Law { .. }, Branch::Piece(_))
            | (CamMotion::Profile(_), Branch::Stage(..)) => return None,
        };
        q.0.iter().all(|x| x.is_decided()).then_some(q)
    }

    /// Returns the state at one angle, by the formula of a branch.
    pub fn station_on(&self, branch: Branch, phi: N) -> Option<CamStation<N>> {
        let station = self.station_of(self.coordinate_on(branch, phi)?, phi);
        let (CamMotion::Profile(segments), Branch::Piece(piece)) = (&self.motion, branch) else {
            return Some(station);
        };
        // The curvature of a given profile is known and is not recomputed from the motion.
        let (rho, rho_slope) = (segments.get(piece)?.radius(), N::from_f64(0.0));
        let rho_pitch = match self.touch {
            FollowerTip::Point { radius } => rho + radius,
            FollowerTip::Flat { .. } => rho,
        };
        Some(CamStation { rho, rho_pitch, rho_slope, ..station })
    }

    /// Returns the state at an angle with the follower at a coordinate.
    pub(super) fn station_of(&self, q: CamJet<N>, phi: N) -> CamStation<N> {
        let back = CamJet::variable(phi).signed(-self.sense);
        let ContactGeometry { pitch, contact, normal, turning, rho, rho_pitch, rho_slope } =
            match self.touch {
                FollowerTip::Point { radius } => self.round_end(q, back, radius),
                FollowerTip::Flat { lever } => self.flat_end(q, back, lever),
            };
        let standing = CamJet::constant(back.value());
        let out = Plane::constant(self.follower.outward(q.value())).turned(standing).order(0);
        let against = |way: Vec2<N>| self.signed(way.cross(normal).atan2(way.dot(normal)));
        let zero = N::from_f64(0.0);
        let pressure = match (self.touch, self.follower) {
            // A flat face is pushed along its own normal. If it passes through its pivot, that is
            // the direction in which the contact point moves.
            (FollowerTip::Flat { .. }, Follower::Translating { .. }) => zero,
            (FollowerTip::Flat { lever }, Follower::Oscillating { pivot, sense, .. }) => {
                if lever == zero {
                    zero
                } else {
                    let way = (contact - Plane::constant(pivot).turned(standing).order(0)).perp();
                    against(if sense < 0.0 { -way } else { way })
                }
            }
            (FollowerTip::Point { .. }, _) => against(out),
        };
        let pressure_slope = self.signed(turning - self.normal_rate(q).value());
        CamStation {
            phi,
            q,
            pitch,
            contact,
            normal,
            rho,
            rho_pitch,
            rho_slope,
            pressure,
            pressure_slope,
        }
    }

    /// Computes the contact of a round end.
    fn round_end(&self, q: CamJet<N>, back: CamJet<N>, radius: N) -> ContactGeometry<N> {
        let b = self.follower.point(q).turned(back);
        let w = b.derivative();
        let z = w.derivative();
        // Seen from the cam, the follower rotates against the cam's sense: a convex curve bends
        // that way.
        let turn = w.cross(z);
        let bend = turn.signed(-self.sense);
        let (along, across) = (w.order(0), z.order(0));
        let speed = along.norm();
        let normal = along.perp() * (self.signed(N::from_f64(1.0)) / speed);
        let square = speed * speed;
        let rho_pitch = square * speed / bend.value();
        // The pitch curve of a straight flank is straight too: its infinite radius is kept.
        let rho = if rho_pitch.is_decided() { rho_pitch - radius } else { rho_pitch };
        let rho_slope =
            (N::from_f64(3.0) * speed * along.dot(across) - rho_pitch * bend.0[1]) / bend.value();
        let pitch = b.order(0);
        ContactGeometry {
            pitch,
            contact: pitch - normal * radius,
            normal,
            turning: turn.value() / square,
            rho,
            rho_pitch,
            rho_slope,
        }
    }

    /// Computes the contact of a flat face.
    fn flat_end(&self, q: CamJet<N>, back: CamJet<N>, lever: N) -> ContactGeometry<N> {
        let m = self.follower.normal(q);
        // Support function: the distance of the face from the centre, as a function of the
        // direction of its normal in the cam.
        let distance = match self.follower {
            Follower::Translating { .. } => q,
            Follower::Oscillating { pivot, .. } => {
                m.dot(Plane::constant(pivot)) + CamJet::constant(lever)
            }
        };
        let normal = m.turned(back);
        let rate = self.normal_rate(q);
        let slope = distance.derivative() * rate.recip();
        let rho = distance + slope.derivative() * rate.recip();
        let n = normal.order(0);
        let contact = n * distance.value() + n.perp() * slope.value();
        let foot = match self.follower {
            Follower::Translating { .. } => self.follower.point(q).turned(back).order(0),
            Follower::Oscillating { pivot, .. } => {
                Plane::constant(pivot).turned(back).order(0) + n * lever
            }
        };
        let (rho, rho_slope) = (rho.0[0], rho.0[1]);
        ContactGeometry {
            pitch: foot,
            contact,
            normal: n,
            turning: rate.value(),
            rho,
            rho_pitch: rho,
            rho_slope,
        }
    }

    /// Returns the rate at which a direction of the follower, the normal of its flat face, turns in
    /// the cam as φ grows.
    fn normal_rate(&self, q: CamJet<N>) -> CamJet<N> {
        let turning = match self.follower {
            Follower::Translating { .. } => CamJet::constant(N::from_f64(0.0)),
            Follower::Oscillating { sense, .. } => q.derivative().signed(sense),
        };
        turning - CamJet::constant(N::from_f64(self.sense))
    }
}

impl Disc {
    /// Returns the piece of the profile that is touched; among several, the one that holds the
    /// follower farthest out. `None` for a law, and if no piece is touched.
    pub fn touched(&self, phi: f64, side: PieceSide) -> Option<usize> {
        PreparedDisc::bare(self).touched(phi, side)
    }

    /// Returns the formula that applies at an angle; `None` if nothing is touched.
    pub fn branch(&self, phi: f64, side: PieceSide) -> Option<Branch> {
        PreparedDisc::bare(self).branch(phi, side)
    }

    /// Returns the follower's coordinate with its derivatives by φ; `None` if it touches nothing.
    pub fn coordinate(&self, phi: f64, side: PieceSide) -> Option<CamJet> {
        PreparedDisc::bare(self).coordinate(phi, side)
    }

    /// Returns the state at one angle; for many angles see [`PreparedDisc`].
    pub fn station(&self, phi: f64, side: PieceSide) -> Option<CamStation> {
        PreparedDisc::bare(self).station(phi, side)
    }
    /// Returns the stretches of a turn in which one piece is touched; see
    /// [`PreparedDisc::stretches`].
    pub fn stretches(&self) -> Vec<(f64, Option<usize>)> {
        PreparedDisc::of(self).stretches()
    }
}
