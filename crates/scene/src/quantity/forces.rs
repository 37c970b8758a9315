//! All forces of an instant, as the free-body solutions fill them and questions look them up.

use crate::model::{GuideId, LinkId, PointId};
use crate::rolling::RollingId;
use hodograph_base::geom::Vec2;
use hodograph_base::kind::Kind;
use hodograph_base::number::Real;

/// A force with its couple about a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench<N = f64> {
    /// The force (N).
    pub force: Vec2<N>,
    /// The couple (N·m), counter-clockwise plus.
    pub couple: N,
}

impl<N: Real> Wrench<N> {
    /// Nothing.
    pub fn zero() -> Self {
        Wrench { force: Vec2::zero(), couple: N::from_f64(0.0) }
    }

    /// The sum of two about one place.
    pub fn plus(self, other: Wrench<N>) -> Self {
        Wrench { force: self.force + other.force, couple: self.couple + other.couple }
    }

    /// Its negative.
    pub fn reversed(self) -> Self {
        Wrench { force: -self.force, couple: -self.couple }
    }

    /// About another place, from which the present one is seen at `arm`: M + arm × F.
    pub fn seen_at(self, arm: Vec2<N>) -> Self {
        Wrench { force: self.force, couple: self.couple + arm.cross(self.force) }
    }
}

/// All forces of an instant.
#[derive(Clone, Debug, PartialEq)]
pub struct Forces<N = f64> {
    /// Force of a pin on a link (N).
    pub pins: Vec<(PointId, LinkId, Vec2<N>)>,
    /// Force of the link that carries a guide on what runs in it, its couple about the place of what runs there.
    pub guides: Vec<(GuideId, Wrench<N>)>,
    /// Force of the first link of a rolling pair on the second at their contact.
    pub rolling: Vec<(RollingId, Vec2<N>)>,
    /// Balancing moment (N·m) or force (N) of each driver, positive in its positive sense.
    pub drivers: Vec<N>,
    /// Balancing moment or force where the scene names its place.
    pub balance: Option<N>,
    /// Inertia force −m a_S and inertia couple −J α of each link that has them.
    pub inertia: Vec<(LinkId, Wrench<N>)>,
    /// Power (W) of the balancing moment or force.
    pub power: N,
    /// Power (W) that the load takes without friction; `None` where nothing rubs.
    pub smooth: Option<N>,
    /// Largest force among loads and reactions (N): what rounding is measured against.
    pub largest: f64,
    /// Largest moment of a force about a point of the mechanism (N·m).
    pub largest_moment: f64,
    /// Power (W) of the largest force at the speed of the drivers.
    pub largest_power: f64,
    /// True if reactions are determined: they are not where a link or a pair repeats what the others hold.
    pub determinate: bool,
}

impl<N: Real> Forces<N> {
    /// No forces.
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

    /// Efficiency: M_b0/M_b of a driver that drives, M_b/M_b0 where the load drives. Zero or less: the mechanism locks itself.
    pub fn efficiency(&self) -> Option<N> {
        let smooth = self.smooth?;
        Some(if smooth.approx() < 0.0 { self.power / smooth } else { smooth / self.power })
    }
}

impl<N> Forces<N> {
    /// The size (SI) beside which a quantity of a kind is rounding; `None` of a kind that is none of forces.
    pub fn size(&self, kind: Kind) -> Option<f64> {
        match kind {
            Kind::Force => Some(self.largest),
            Kind::Moment => Some(self.largest_moment),
            Kind::Power => Some(self.largest_power),
            Kind::Length | Kind::Angle | Kind::Velocity | Kind::Acceleration | Kind::Omega | Kind::Alpha | Kind::Time | Kind::Number => {
                None
            }
        }
    }
}
