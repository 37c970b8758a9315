//! All forces of an instant, as the free-body solutions fill them and questions look them up.

use crate::model::{GuideId, LinkId, PointId};
use crate::rolling::RollingId;
use hodograph_base::geom::Vec2;
use hodograph_base::kind::Kind;
use hodograph_base::number::Real;

/// A force and its couple about a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench<N = f64> {
    /// The force (N).
    pub force: Vec2<N>,
    /// The couple (N·m), positive counter-clockwise.
    pub couple: N,
}

impl Wrench {
    /// Converts the wrench to another number type.
    pub fn lift<N: Real>(self) -> Wrench<N> {
        Wrench { force: self.force.lift(), couple: N::from_f64(self.couple) }
    }
}

impl<N: Real> Wrench<N> {
    /// Returns the zero wrench.
    pub fn zero() -> Self {
        Wrench { force: Vec2::zero(), couple: N::from_f64(0.0) }
    }

    /// Returns the sum of two wrenches about the same place.
    pub fn plus(self, other: Wrench<N>) -> Self {
        Wrench { force: self.force + other.force, couple: self.couple + other.couple }
    }

    /// Returns the negative.
    pub fn reversed(self) -> Self {
        Wrench { force: -self.force, couple: -self.couple }
    }

    /// Returns the wrench about another place, from which the present one has the position vector
    /// `arm`: M + arm × F.
    pub fn seen_at(self, arm: Vec2<N>) -> Self {
        Wrench { force: self.force, couple: self.couple + arm.cross(self.force) }
    }
}

/// All forces of an instant.
#[derive(Clone, Debug, PartialEq)]
pub struct Forces<N = f64> {
    /// Force of a pin on a link (N).
    pub pins: Vec<(PointId, LinkId, Vec2<N>)>,
    /// Force of the link that carries a guide on the body in the guide, with the couple about the
    /// place of that body.
    pub guides: Vec<(GuideId, Wrench<N>)>,
    /// Force of the first link of a rolling pair on the second at their contact.
    pub rolling: Vec<(RollingId, Vec2<N>)>,
    /// Balancing moment (N·m) or force (N) of each driver, positive in its positive sense.
    pub drivers: Vec<N>,
    /// Balancing moment or force, if the scene gives its place.
    pub balance: Option<N>,
    /// Inertia force −m a_S and inertia couple −J α of each link with mass or moment of inertia.
    pub inertia: Vec<(LinkId, Wrench<N>)>,
    /// Power (W) of the balancing moment or force.
    pub power: N,
    /// Power (W) that the load needs without friction; `None` without friction in the scene.
    pub smooth: Option<N>,
    /// Largest force among loads and reactions (N), the reference for rounding errors.
    pub largest: f64,
    /// Largest moment of a force about a point of the mechanism (N·m).
    pub largest_moment: f64,
    /// Power (W) of the largest force at the speed of the drivers.
    pub largest_power: f64,
    /// True if reactions are determined. They are not if a link or a pair is a redundant
    /// constraint.
    pub determinate: bool,
}

impl<N: Real> Forces<N> {
    /// Returns empty forces.
    pub fn none() -> Self {
        Forces {
            pins: Vec::new(),
            guides: Vec::new(),
            rolling: Vec::new(),
            drivers: Vec::new(),
            balance: None,
            inertia: Vec::new(),
            power: N::from_f64(0.0),
            smooth: None,
            largest: 0.0,
            largest_moment: 0.0,
            largest_power: 0.0,
            determinate: true,
        }
    }

    /// Returns the efficiency: M_b0/M_b of a driver that drives, M_b/M_b0 if the load drives. Zero
    /// or less: the mechanism is self-locking.
    pub fn efficiency(&self) -> Option<N> {
        let smooth = self.smooth?;
        Some(if smooth.approx() < 0.0 { self.power / smooth } else { smooth / self.power })
    }
}

impl<N> Forces<N> {
    /// Returns the size (SI) that is the reference for rounding errors of a kind; `None` for kinds
    /// other than forces.
    pub fn size(&self, kind: Kind) -> Option<f64> {
        match kind {
            Kind::Force => Some(self.largest),
            Kind::Moment => Some(self.largest_moment),
            Kind::Power => Some(self.largest_power),
            Kind::Length
            | Kind::Angle
            | Kind::Velocity
            | Kind::Acceleration
            | Kind::Omega
            | Kind::Alpha
            | Kind::Time
            | Kind::Number => None,
        }
    }
}
