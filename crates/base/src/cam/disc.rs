//! A disc cam with its follower: the follower's place, the profile by inversion 反转法, pressure angle and radius of curvature at any angle.
//!
//! The follower's coordinate q is, of a translating one, the way of its point (or of its face) along the direction of the lift, counted from the
//! foot of the perpendicular from the centre of the cam; of an oscillating one the angle of its arm (or face) from the line pivot–centre, growing
//! outward. The lift s is q less its least value on the base circle.

use super::jet::{Jet, Plane};
use super::outline::Segment;
use super::{Program, Side, in_half_turns};
use crate::geom::Vec2;

/// How the follower moves. The origin is the centre of the cam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Follower {
    /// Along a straight guide 直动.
    Translating {
        /// Unit vector of the lift.
        direction: Vec2,
        /// Distance of the line of the follower's point from the centre (m), to the right of the direction 偏距.
        offset: f64,
    },
    /// About a pivot 摆动.
    Oscillating {
        /// The pivot (m).
        pivot: Vec2,
        /// From the pivot to the follower's point (m); of no meaning for a flat face.
        arm: f64,
        /// +1 where the arm turns counter-clockwise as it goes out, −1 otherwise.
        sense: f64,
    },
}

impl Follower {
    /// Direction pivot → centre of the cam.
    fn centre_line(pivot: Vec2) -> f64 {
        (Vec2::ZERO - pivot).angle()
    }

    /// The follower's point at a coordinate; of a translating face its point on the line of the guide.
    pub fn point(&self, q: Jet) -> Plane {
        match *self {
            Follower::Translating { direction, offset } => Plane::constant(direction.perp() * -offset) + Plane::constant(direction) * q,
            Follower::Oscillating { pivot, arm, sense } => {
                let u = Plane::direction(q * sense + Jet::constant(Follower::centre_line(pivot)));
                Plane::constant(pivot) + u * Jet::constant(arm)
            }
        }
    }

    /// The outward normal of a flat face: away from the cam. A translating face stands square to its guide.
    pub fn normal(&self, q: Jet) -> Plane {
        match *self {
            Follower::Translating { direction, .. } => Plane::constant(direction),
            Follower::Oscillating { pivot, sense, .. } => {
                Plane::direction(q * sense + Jet::constant(Follower::centre_line(pivot))).perp() * Jet::constant(sense)
            }
        }
    }

    /// Direction in which the follower's point goes out.
    fn outward(&self, q: f64) -> Vec2 {
        match *self {
            Follower::Translating { direction, .. } => direction,
            Follower::Oscillating { .. } => self.normal(Jet::constant(q)).order(0),
        }
    }

    /// The coordinate at which the follower's point keeps a distance from K; less than zero: K lies beyond it.
    pub(super) fn at_distance(&self, k: Plane, distance: f64) -> Jet {
        let (square, way) = (Jet::constant(distance * distance), distance.signum());
        match *self {
            Follower::Translating { direction, offset } => {
                let d = Plane::constant(direction);
                let aside = Jet::constant(offset) + k.dot(d.perp());
                k.dot(d) + (square - aside * aside).sqrt() * way
            }
            Follower::Oscillating { pivot, arm, sense } => {
                let pk = k - Plane::constant(pivot);
                let apart = pk.dot(pk);
                let cosine = (apart + Jet::constant(arm * arm) - square) * (apart.sqrt() * (2.0 * arm)).recip();
                let at = pk.angle() + cosine.arc_cosine() * (sense * way);
                Follower::from_centre_line(at, pivot, sense)
            }
        }
    }

    /// The coordinate at which a flat face, `lever` out from its pivot, keeps a distance from K.
    pub(super) fn faced(&self, k: Plane, distance: f64, lever: f64) -> Jet {
        match *self {
            Follower::Translating { direction, .. } => k.dot(Plane::constant(direction)) + Jet::constant(distance),
            Follower::Oscillating { pivot, sense, .. } => {
                let pk = k - Plane::constant(pivot);
                let sine = Jet::constant(lever - distance) * pk.dot(pk).sqrt().recip();
                Follower::from_centre_line(pk.angle() - sine.arc_sine() * sense, pivot, sense)
            }
        }
    }

    /// The coordinate at which the follower's point lies on the line with this normal, so far from the origin.
    pub(super) fn along_line(&self, normal: Jet, distance: f64) -> Jet {
        let n = Plane::direction(normal);
        match *self {
            Follower::Translating { direction, offset } => {
                let (d, aside) = (Plane::constant(direction), Plane::constant(direction.perp() * -offset));
                let slope = d.dot(n);
                if slope.value() <= 0.0 {
                    return Jet::constant(f64::NAN);
                }
                (Jet::constant(distance) - aside.dot(n)) * slope.recip()
            }
            Follower::Oscillating { pivot, arm, sense } => {
                let cosine = (Jet::constant(distance) - Plane::constant(pivot).dot(n)) * (1.0 / arm);
                Follower::from_centre_line(normal - cosine.arc_cosine() * sense, pivot, sense)
            }
        }
    }

    /// The coordinate of a direction of the arm.
    fn from_centre_line(at: Jet, pivot: Vec2, sense: f64) -> Jet {
        let mut q = (at - Jet::constant(Follower::centre_line(pivot))) * sense;
        q.0[0] = in_half_turns(q.0[0]);
        q
    }
}

/// With what the follower touches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Touch {
    /// A round end about the follower's point: a roller 滚子, an arc (mushroom), or with radius 0 a knife edge 尖顶.
    Point {
        /// Radius (m).
        radius: f64,
    },
    /// A flat face 平底.
    Flat {
        /// How far out from the pivot of an oscillating follower the face lies (m); of no meaning for a translating one.
        lever: f64,
    },
}

/// What moves the follower.
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// A law; the profile follows from it.
    Law {
        /// Radius of the base circle of the profile (m) 基圆.
        base: f64,
        /// The stages.
        program: Program,
    },
    /// A profile; the motion follows from it.
    Profile(Vec<Segment>),
}

/// A cam and its follower.
#[derive(Clone, Debug, PartialEq)]
pub struct Disc {
    /// How the follower moves.
    pub follower: Follower,
    /// With what it touches.
    pub touch: Touch,
    /// What moves it.
    pub motion: Motion,
    /// +1 where φ grows counter-clockwise, −1 where the cam turns clockwise.
    pub sense: f64,
}

/// What is known at one angle of the cam. Points and directions are in the frame of the cam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// The angle (rad).
    pub phi: f64,
    /// The coordinate of the follower, with its derivatives.
    pub q: Jet,
    /// The follower's point on the pitch curve 理论廓线; of a flat face its foot: the point of the face on the line of the guide or pivot.
    pub pitch: Vec2,
    /// The contact, on the profile 实际廓线.
    pub contact: Vec2,
    /// The outward normal there.
    pub normal: Vec2,
    /// Radius of curvature of the profile (m), convex plus.
    pub rho: f64,
    /// That of the pitch curve (m); of a flat face that of the profile.
    pub rho_pitch: f64,
    /// Pressure angle (rad): from the direction in which the follower goes to the normal, plus in the sense in which the cam turns 压力角.
    pub pressure: f64,
}

impl Station {
    /// The centre of curvature of the profile.
    pub fn centre(&self) -> Vec2 {
        self.contact - self.normal * self.rho
    }
}

/// Step (rad) beside a joint at which it is told which piece comes next: larger than the rounding of a joint's place, and far smaller than a
/// piece.
pub(super) const BESIDE: f64 = 1e-9;

impl Disc {
    /// Radius of the circle about the centre that the follower's point touches on the base circle, or the face.
    fn reach(&self, base: f64) -> f64 {
        match self.touch {
            Touch::Point { radius } => base + radius,
            Touch::Flat { .. } => base,
        }
    }

    /// The coordinate on a base circle of this radius; not a number where the follower cannot touch it.
    pub fn rest(&self, base: f64) -> f64 {
        let reach = self.reach(base);
        let centre = Plane::constant(Vec2::ZERO);
        match self.touch {
            Touch::Point { .. } => self.follower.at_distance(centre, reach),
            Touch::Flat { lever } => self.follower.faced(centre, reach, lever),
        }
        .value()
    }

    /// Which piece of the profile is touched; of several, that which holds the follower farthest out. `None` for a law, and where none is.
    pub fn touched(&self, phi: f64, side: Side) -> Option<usize> {
        let Motion::Profile(segments) = &self.motion else { return None };
        let beside = match side {
            Side::Before => phi - BESIDE,
            Side::After => phi + BESIDE,
        };
        // Where the follower leaves its cam nothing is touched beside the pose on that side, but in the pose.
        self.farthest(segments, self.sense * beside).or_else(|| self.farthest(segments, self.sense * phi))
    }

    /// The piece that holds the follower farthest out, the cam turned by so much.
    fn farthest(&self, segments: &[Segment], turn: f64) -> Option<usize> {
        let mut best: Option<(usize, f64)> = None;
        for (i, segment) in segments.iter().enumerate() {
            let q = segment.coordinate(&self.follower, &self.touch, Jet::constant(turn)).value();
            if q.is_finite() && segment.holds(&self.follower, &self.touch, turn, q) && best.is_none_or(|b| q > b.1) {
                best = Some((i, q));
            }
        }
        best.map(|b| b.0)
    }

    /// The follower's coordinate with its derivatives by φ; `None` where it touches nothing.
    pub fn coordinate(&self, phi: f64, side: Side) -> Option<Jet> {
        let q = match &self.motion {
            Motion::Law { base, program } => program.lift(phi, side) + Jet::constant(self.rest(*base)),
            Motion::Profile(segments) => {
                let turn = Jet::variable(phi) * self.sense;
                segments[self.touched(phi, side)?].coordinate(&self.follower, &self.touch, turn)
            }
        };
        q.0.iter().all(|x| x.is_finite()).then_some(q)
    }

    /// Everything at one angle.
    pub fn station(&self, phi: f64, side: Side) -> Option<Station> {
        let q = self.coordinate(phi, side)?;
        let back = Jet::variable(phi) * -self.sense;
        let outward = self.follower.outward(q.value());
        let (pitch, contact, normal, rho, rho_pitch) = match self.touch {
            Touch::Point { radius } => {
                let b = self.follower.point(q).turned(back);
                let (pitch, w, z) = (b.order(0), b.order(1), b.order(2));
                // Seen from the cam the follower goes round against its sense: a convex curve bends that way.
                let bend = -self.sense * w.cross(z);
                let speed = w.norm();
                let normal = w.perp() * (self.sense / speed);
                let rho_pitch = speed * speed * speed / bend;
                let rho = if rho_pitch.is_finite() { rho_pitch - radius } else { rho_pitch };
                (pitch, pitch - normal * radius, normal, rho, rho_pitch)
            }
            Touch::Flat { lever } => {
                let m = self.follower.normal(q);
                // Support function: the distance of the face from the centre, over the direction of its normal in the cam.
                let distance = match self.follower {
                    Follower::Translating { .. } => q,
                    Follower::Oscillating { pivot, .. } => m.dot(Plane::constant(pivot)) + Jet::constant(lever),
                };
                let normal = m.turned(back);
                let rate = self.normal_rate(q);
                let slope = distance.derivative() * rate.recip();
                let rho = distance.value() + slope.0[1] / rate.value();
                let n = normal.order(0);
                let contact = n * distance.value() + n.perp() * slope.value();
                let foot = match self.follower {
                    Follower::Translating { .. } => self.follower.point(q).turned(back).order(0),
                    Follower::Oscillating { pivot, .. } => Plane::constant(pivot).turned(back).order(0) + n * lever,
                };
                (foot, contact, n, rho, rho)
            }
        };
        let out = Plane::constant(outward).turned(Jet::constant(back.value())).order(0);
        let against = |way: Vec2| self.sense * libm::atan2(way.cross(normal), way.dot(normal));
        let pressure = match (self.touch, self.follower) {
            // A flat face is pushed along its own normal; where it passes through its pivot that is the way the contact goes.
            (Touch::Flat { .. }, Follower::Translating { .. }) => 0.0,
            (Touch::Flat { lever: 0.0 }, Follower::Oscillating { .. }) => 0.0,
            (Touch::Flat { .. }, Follower::Oscillating { pivot, sense, .. }) => {
                against((contact - Plane::constant(pivot).turned(back).order(0)).perp() * sense)
            }
            (Touch::Point { .. }, _) => against(out),
        };
        Some(Station { phi, q, pitch, contact, normal, rho, rho_pitch, pressure })
    }

    /// By how much the normal of a flat face turns in the cam as φ grows.
    fn normal_rate(&self, q: Jet) -> Jet {
        let turning = match self.follower {
            Follower::Translating { .. } => Jet::constant(0.0),
            Follower::Oscillating { sense, .. } => q.derivative() * sense,
        };
        turning - Jet::constant(self.sense)
    }

    /// Angles of the cam at which pieces of its law or of its profile meet, from 0 on.
    pub fn corners(&self) -> Vec<f64> {
        match &self.motion {
            Motion::Law { program, .. } => program.corners(),
            Motion::Profile(segments) if segments.len() > 1 => self.changes(segments),
            Motion::Profile(_) => Vec::new(),
        }
    }
}

/// Angles of the cam from 0 to a whole turn: equal steps and, at every joint, both sides.
pub fn round(disc: &Disc, steps: usize) -> Vec<(f64, Side)> {
    let tau = std::f64::consts::TAU;
    let corners = disc.corners();
    // A step that meets a joint but for rounding is the joint.
    let apart = |phi: f64| corners.iter().all(|c| (c - phi).abs() > 1e-7);
    let even = (0..steps).map(|k| tau * k as f64 / steps as f64).filter(|phi| *phi == 0.0 || apart(*phi)).map(|phi| (phi, Side::After));
    let joints = corners.iter().flat_map(|phi| [(*phi, Side::Before), (*phi, Side::After)]);
    let mut all: Vec<(f64, Side)> = even.chain(joints).chain([(tau, Side::Before)]).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1 == Side::After).cmp(&(b.1 == Side::After))));
    all.dedup_by(|a, b| a.1 == b.1 && (a.0 - b.0).abs() < 1e-9);
    // The turn begins after its start and ends before it.
    let outside = |(phi, side): &(f64, Side)| match side {
        Side::Before => *phi < 1e-9,
        Side::After => *phi > tau - 1e-9,
    };
    all.retain(|station| !outside(station));
    all
}

impl Disc {
    /// Points round the profile, in the frame of the cam; closed.
    pub fn outline(&self, steps: usize) -> Vec<Vec2> {
        match &self.motion {
            Motion::Profile(segments) => {
                let most = std::f64::consts::TAU / steps as f64;
                segments.iter().flat_map(|s| s.points(most)).collect()
            }
            Motion::Law { .. } => {
                round(self, steps).into_iter().filter_map(|(phi, side)| self.station(phi, side)).map(|s| s.contact).collect()
            }
        }
    }

    /// The radius of the base circle (m): of a profile the least distance from the centre at which it is touched.
    pub fn base(&self) -> f64 {
        match &self.motion {
            Motion::Law { base, .. } => *base,
            Motion::Profile(_) => {
                let near = round(self, 720).into_iter().filter_map(|(phi, side)| self.station(phi, side));
                near.map(|s| s.contact.norm()).fold(f64::INFINITY, f64::min)
            }
        }
    }
}
