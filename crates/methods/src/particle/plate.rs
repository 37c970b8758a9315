//! The plate that turns in space: the place of its point and the parts of its motion, in any kind
//! of number.
//!
//! u is the direction in the plate square to the axis, n the plate's normal (to the side of
//! positive rotation), k the axis: the point is r u + e n + z k. The absolute motion is the
//! derivative of the coordinates; the parts come from the theorem of composite motion, so that
//! their sum proves both.

use super::law::{PlateAngle, jet};
use super::{ParticleMotion, ParticleMotionKind, ParticleProblem, Plate};
use hodograph_base::diag::Diagnostic;
use hodograph_base::number::{Jet, Real};

/// A vector in space, by its x, y, z components.
pub type Space<N> = [N; 3];

/// A part of the motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlateComponent {
    /// v_e.
    TransportVelocity,
    /// v_r.
    RelativeVelocity,
    /// a_e.
    Transport,
    /// a_eⁿ, toward the axis.
    TransportNormal,
    /// a_eᵗ, square to a_eⁿ.
    TransportTangential,
    /// a_r.
    Relative,
    /// a_rⁿ, square to the path on the plate.
    RelativeNormal,
    /// a_rᵗ, along the path.
    RelativeTangential,
    /// a_k = 2ω v_r sin θ, square to the plate.
    Coriolis,
}

impl PlateComponent {
    /// All parts, with their symbols in questions.
    pub const ALL: [(&'static str, PlateComponent); 9] = [
        ("ve", PlateComponent::TransportVelocity),
        ("vr", PlateComponent::RelativeVelocity),
        ("ae", PlateComponent::Transport),
        ("aen", PlateComponent::TransportNormal),
        ("aet", PlateComponent::TransportTangential),
        ("ar", PlateComponent::Relative),
        ("arn", PlateComponent::RelativeNormal),
        ("art", PlateComponent::RelativeTangential),
        ("ak", PlateComponent::Coriolis),
    ];

    /// True for a part of the velocity.
    pub fn is_velocity(self) -> bool {
        matches!(self, PlateComponent::TransportVelocity | PlateComponent::RelativeVelocity)
    }
}

/// The state of plate and point at a time.
#[derive(Clone, Copy, Debug)]
pub struct PlateState<N> {
    /// The rotation of the plate.
    pub turn: PlateAngle<N>,
    /// The distance of the point from the axis along the plate.
    pub r: Jet<N>,
    /// The height of the point along the axis.
    pub z: Jet<N>,
    /// The distance of the plate from the axis.
    pub e: N,
    order: [usize; 3],
}

impl<N: Real> PlateState<N> {
    /// Returns the state of a motion on a plate at a time; `None` for other motions.
    ///
    /// # Errors
    /// If a law has no value.
    pub fn of(
        problem: &ParticleProblem,
        motion: &ParticleMotion,
        t: N,
    ) -> Result<Option<PlateState<N>>, Diagnostic> {
        let ParticleMotionKind::OnPlate(k, way) = &motion.kind else { return Ok(None) };
        let Plate { axis, turning, offset, .. } = &problem.plates[*k];
        let [r, z] = way.at(t)?;
        let e = offset
            .as_ref()
            .map(|law| jet(law, t))
            .transpose()?
            .map_or(N::from_f64(0.0), |j| j.0[0]);
        Ok(Some(PlateState { turn: turning.at(t)?, r, z, e, order: axis.order() }))
    }

    /// Returns a vector as x, y, z, from its components along the two axes square to the rotation
    /// axis and along that axis.
    fn space(&self, [one, two, along]: [N; 3]) -> Space<N> {
        let mut out = [along; 3];
        for (place, value) in self.order.into_iter().zip([one, two, along]) {
            out[place] = value;
        }
        out
    }

    /// Returns a vector as x, y, z, from its components along u, n, k.
    pub fn of_plate(&self, [u, n, k]: [N; 3]) -> Space<N> {
        let (s, c) = (self.turn.sin.0[0], self.turn.cos.0[0]);
        self.space([u * c - n * s, u * s + n * c, k])
    }

    /// Returns place, velocity and acceleration, by differentiation of the coordinates.
    pub fn absolute(&self) -> [Space<N>; 3] {
        let (s, c, e) = (self.turn.sin, self.turn.cos, Jet::constant(self.e));
        let one = self.r * c - e * s;
        let two = self.r * s + e * c;
        [0, 1, 2].map(|k| self.space([one.0[k], two.0[k], self.z.0[k]]))
    }

    /// Returns a part of the motion.
    pub fn part(&self, part: PlateComponent) -> Space<N> {
        let zero = N::from_f64(0.0);
        let PlateAngle { omega: w, alpha, .. } = self.turn;
        let ([r, r1, r2], [_, z1, z2], e) = (self.r.0, self.z.0, self.e);
        let normal = [-(w * w * r), -(w * w * e), zero];
        let tangential = [-(alpha * e), alpha * r, zero];
        // The component of a_r along v_r; for a point momentarily at rest, all of a_r.
        let v2 = r1 * r1 + z1 * z1;
        let along = if v2.approx() == 0.0 {
            [r2, zero, z2]
        } else {
            [r1, zero, z1].map(|x| x * ((r1 * r2 + z1 * z2) / v2))
        };
        self.of_plate(match part {
            PlateComponent::TransportVelocity => [-(w * e), w * r, zero],
            PlateComponent::RelativeVelocity => [r1, zero, z1],
            PlateComponent::Transport => [0, 1, 2].map(|k| normal[k] + tangential[k]),
            PlateComponent::TransportNormal => normal,
            PlateComponent::TransportTangential => tangential,
            PlateComponent::Relative => [r2, zero, z2],
            PlateComponent::RelativeNormal if v2.approx() == 0.0 => [zero; 3],
            // Across v_r: (r₂z₁ − z₂r₁)(z₁, −r₁)/v².
            PlateComponent::RelativeNormal => {
                [z1, zero, -r1].map(|x| x * ((r2 * z1 - z2 * r1) / v2))
            }
            PlateComponent::RelativeTangential => along,
            PlateComponent::Coriolis => [zero, N::from_f64(2.0) * w * r1, zero],
        })
    }
}
