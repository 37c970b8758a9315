//! The motion of one link relative to another at an instant, up to third order, and the quantities
//! that follow by formulas: pole, inflection circle, pole velocity, acceleration pole, Bresse's
//! circle, Ball's point, curvature of paths.
//!
//! With P the pole, w = z − P, D = a_P/ω²: v = iω w, a = a_P + (iα − ω²) w. A path has no curvature
//! if v × a = 0, |w|² = w·D (the inflection circle over PJ, J = P + D). A point has no tangential
//! acceleration if v · a = 0, |w|² = w·(i a_P/α) (Bresse's circle). The pole velocity is u = i
//! a_P/ω.
//!
//! # Source
//! O. Bottema, B. Roth, *Theoretical Kinematics*, ch. VIII; J. Bresse, 1853; R. Ball, 1871.

use hodograph_base::geom::{Point, Vec2};

/// The motion of a plane, given at one of its places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneMotion {
    /// The place (m).
    pub at: Point,
    /// Its velocity (m/s).
    pub v: Vec2,
    /// ω (rad/s).
    pub omega: f64,
    /// Its acceleration (m/s²).
    pub a: Vec2,
    /// α (rad/s²).
    pub alpha: f64,
    /// The third derivatives of place and angle, if they are known.
    pub third: Option<(Vec2, f64)>,
    /// The size of the mechanism (m).
    pub size: f64,
    /// The largest of ω and v/size of all links (rad/s): the reference for rounding errors.
    pub largest: f64,
}

/// The kind of motion at the instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PlaneState {
    /// Nothing moves.
    Rest,
    /// All points have this velocity: the pole is at infinity, square to it.
    Translation(Vec2),
    /// The plane turns about a pole.
    Turning(PoleMotion),
}

/// The quantities of a pole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoleMotion {
    /// P (m).
    pub pole: Point,
    /// PJ = a_P/ω²; zero if the pole is stationary.
    pub normal: Vec2,
    /// The pole velocity u (m/s), along the pole tangent.
    pub pole_velocity: Vec2,
    /// The acceleration pole: the place without acceleration (m).
    pub acceleration_pole: Point,
    /// The vector from the pole across Bresse's circle; `None` if α = 0: the circle is then the
    /// line through P and J.
    pub bresse: Option<Vec2>,
    /// Ball's point: its path is straight up to third order. `None` if the third derivatives are
    /// not known, or if the two circles that cross in it coincide.
    pub ball: Option<Point>,
}

impl PoleMotion {
    /// Returns J, the inflection pole.
    pub fn inflection_pole(&self) -> Point {
        self.pole + self.normal
    }

    /// Returns the diameter of the inflection circle (m).
    pub fn diameter(&self) -> f64 {
        self.normal.norm()
    }

    /// True if the pole is stationary: to this order, all paths are circles about it.
    pub fn stands(&self) -> bool {
        self.normal == Vec2::ZERO
    }
}

/// The curvature of a point's path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bend {
    /// The path curves about a centre (m), with a radius (m).
    About(Point, f64),
    /// The path has no curvature: the point lies on the inflection circle.
    Straight,
    /// The point is the pole: its path has a cusp there, or stops.
    AtPole,
    /// Nothing moves.
    Rest,
}

/// Relative motions below this fraction of the largest are rounding errors.
const RESTING: f64 = 1e-11;
/// The limit below which the sine of the angle from v to a counts as zero curvature, and a length
/// relative to the mechanism's size as zero.
const NONE: f64 = 1e-11;

impl PlaneMotion {
    /// Returns the velocity of the plane's point at a place.
    pub fn velocity(&self, place: Point) -> Vec2 {
        self.v + (place - self.at).perp() * self.omega
    }

    /// Returns the acceleration of the plane's point at a place.
    pub fn acceleration(&self, place: Point) -> Vec2 {
        let r = place - self.at;
        self.a + r.perp() * self.alpha - r * (self.omega * self.omega)
    }

    /// Returns the third derivative of the plane's point at a place.
    fn third(&self, place: Point) -> Option<Vec2> {
        let ((j, turning), r, omega) = (self.third?, place - self.at, self.omega);
        Some(j + r.perp() * (turning - omega * omega * omega) - r * (3.0 * omega * self.alpha))
    }

    /// Returns the kind of motion with its quantities.
    pub fn state(&self) -> PlaneState {
        let still = RESTING * self.largest;
        if self.omega.abs() <= still {
            return if self.v.norm() <= still * self.size {
                PlaneState::Rest
            } else {
                PlaneState::Translation(self.v)
            };
        }
        let omega = self.omega;
        let pole = self.at + self.v.perp() * (1.0 / omega);
        let a = self.acceleration(pole);
        let normal = a * (1.0 / (omega * omega));
        let far = self.size.max((pole - self.at).norm());
        if normal.norm() <= NONE * far {
            let bresse = None;
            let (normal, pole_velocity) = (Vec2::ZERO, Vec2::ZERO);
            return PlaneState::Turning(PoleMotion {
                pole,
                normal,
                pole_velocity,
                acceleration_pole: pole,
                bresse,
                ball: None,
            });
        }
        let acceleration_pole = pole + a.divide_by(Vec2::new(omega * omega, -self.alpha));
        let bresse =
            (self.alpha.abs() > NONE * omega * omega).then(|| a.perp() * (1.0 / self.alpha));
        PlaneState::Turning(PoleMotion {
            pole,
            normal,
            pole_velocity: a.perp() * (1.0 / omega),
            acceleration_pole,
            bresse,
            ball: self.ball(pole, a),
        })
    }

    /// Returns the crossing, other than P, of the inflection circle with v × d³z/dt³ = 0, which is
    /// also a circle through P: w·(3α a_P − ω j_P) = 0.
    fn ball(&self, pole: Point, a: Vec2) -> Option<Point> {
        let j = self.third(pole)?;
        let across = a * (3.0 * self.alpha) - j * self.omega;
        let scale = a.norm() * self.omega * self.omega;
        if across.norm() <= NONE * scale {
            return None;
        }
        let along = across.perp().unit()?;
        Some(pole + along * (along.dot(a) / (self.omega * self.omega)))
    }

    /// Returns the curvature of the path of the plane's point at a place: ρ = v³/(v × a).
    pub fn bend(&self, place: Point) -> Bend {
        let (v, a) = (self.velocity(place), self.acceleration(place));
        let speed = v.norm();
        if speed <= RESTING * self.largest * self.size {
            return if matches!(self.state(), PlaneState::Rest) {
                Bend::Rest
            } else {
                Bend::AtPole
            };
        }
        let turn = v.cross(a);
        // Reference for small accelerations: accelerations at the size of the mechanism.
        let usual = a.norm().max(speed * self.largest);
        if turn.abs() <= NONE * speed * usual {
            return Bend::Straight;
        }
        let centre = place + v.perp() * (speed * speed / turn);
        Bend::About(centre, (speed * speed * speed / turn).abs())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a wheel of radius 1 that rolls on the x axis with ω = −1: cycloids. Its inflection
    /// circle reaches from the contact to the centre, and its pole moves with the centre's speed.
    fn wheel() -> PlaneMotion {
        let (v, third) = (Vec2::new(1.0, 0.0), Some((Vec2::ZERO, 0.0)));
        PlaneMotion {
            at: Point::new(0.0, 1.0),
            v,
            omega: -1.0,
            a: Vec2::ZERO,
            alpha: 0.0,
            third,
            size: 1.0,
            largest: 1.0,
        }
    }

    #[test]
    fn a_rolling_wheel() {
        let PlaneState::Turning(t) = wheel().state() else { panic!("it turns") };
        assert_eq!(
            (t.pole, t.inflection_pole(), t.acceleration_pole),
            (Point::ORIGIN, Point::new(0.0, 1.0), Point::new(0.0, 1.0))
        );
        assert_eq!((t.pole_velocity, t.bresse), (Vec2::new(1.0, 0.0), None));
        // The centre runs permanently straight.
        assert_eq!(t.ball, Some(Point::new(0.0, 1.0)));
        // The top of a cycloid has the radius 4; the centre runs straight.
        assert_eq!(wheel().bend(Point::new(0.0, 2.0)), Bend::About(Point::new(0.0, -2.0), 4.0));
        assert_eq!(wheel().bend(Point::new(0.0, 1.0)), Bend::Straight);
        assert_eq!(wheel().bend(Point::ORIGIN), Bend::AtPole);
    }

    #[test]
    fn states_without_a_pole() {
        let translating = PlaneMotion { omega: 0.0, ..wheel() };
        assert_eq!(translating.state(), PlaneState::Translation(Vec2::new(1.0, 0.0)));
        assert_eq!(PlaneMotion { v: Vec2::ZERO, ..translating }.state(), PlaneState::Rest);
        // Rotation about a fixed pin: circles about it.
        let crank = PlaneMotion { v: Vec2::ZERO, ..wheel() };
        let PlaneState::Turning(t) = crank.state() else { panic!("it turns") };
        assert!(t.stands() && t.acceleration_pole == Point::new(0.0, 1.0));
        assert_eq!(crank.bend(Point::new(3.0, 1.0)), Bend::About(Point::new(0.0, 1.0), 3.0));
    }
}
