//! Ways by laws of time: where a point is on its plane, and how a plate turns, with rate and second derivative, in any number.
//!
//! A way gives two coordinates: x and y on the fixed plane, distance from the axis and height along it on a plate. Nothing is
//! differentiated by hand: the laws are evaluated in jets of time ([`crate::number::Jet`]).

use crate::diag::Diagnostic;
use crate::number::{Jet, Real};
use crate::scene::front::Law;

/// Two coordinates and their derivatives.
pub type Pair<N> = [Jet<N>; 2];

/// Along what a point moves, and by which law.
#[derive(Clone, Debug)]
pub enum Way {
    /// A straight line from a place; the angle counts from the first coordinate's direction to the second's, or from the second's to the
    /// first's (from the axis of a plate).
    Line {
        /// The place at s = 0.
        from: [Law; 2],
        /// Its direction.
        angle: Law,
        /// Whether the angle is that from the axis.
        from_axis: bool,
        /// The law.
        s: Law,
    },
    /// A circle; s is the arc, counter-clockwise from the angle.
    Circle {
        /// Its centre.
        centre: [Law; 2],
        /// Its radius.
        radius: Law,
        /// Where s is 0.
        angle: Option<Law>,
        /// The law.
        s: Law,
    },
    /// Distance from a pole and direction, each by a law.
    Polar {
        /// The pole.
        pole: [Law; 2],
        /// The distance.
        r: Law,
        /// The angle from the first coordinate's direction to the second's.
        phi: Law,
    },
    /// Coordinates, each by a law of its own.
    Free([Law; 2]),
}

/// The value of a law.
///
/// # Errors
/// Where it has none.
pub fn jet<N: Real>(law: &Law, t: N) -> Result<Jet<N>, Diagnostic> {
    law.at(t).map(|v| v.si())
}

/// Sine and cosine of the angle of a law, which may be written in degrees.
///
/// # Errors
/// Where it has no value.
pub fn sine_cosine<N: Real>(law: &Law, t: N) -> Result<(Jet<N>, Jet<N>), Diagnostic> {
    law.at(t).map(|v| v.sin_cos())
}

fn pair<N: Real>(laws: &[Law; 2], t: N) -> Result<Pair<N>, Diagnostic> {
    Ok([jet(&laws[0], t)?, jet(&laws[1], t)?])
}

impl Way {
    /// The coordinates at a time.
    ///
    /// # Errors
    /// Where a law has no value.
    pub fn at<N: Real>(&self, t: N) -> Result<Pair<N>, Diagnostic> {
        match self {
            Way::Line { from, angle, from_axis, s } => {
                let ([x, y], s, (sine, cosine)) = (pair(from, t)?, jet(s, t)?, sine_cosine(angle, t)?);
                let (along, up) = if *from_axis { (sine, cosine) } else { (cosine, sine) };
                Ok([x + s * along, y + s * up])
            }
            Way::Circle { centre, radius, angle, s } => {
                let ([x, y], r, s) = (pair(centre, t)?, jet(radius, t)?, jet(s, t)?);
                let (sine, cosine) = (s / r).sin_cos();
                let (s0, c0) = match angle {
                    Some(angle) => sine_cosine(angle, t)?,
                    None => (Jet::from_f64(0.0), Jet::from_f64(1.0)),
                };
                Ok([x + r * (cosine * c0 - sine * s0), y + r * (sine * c0 + cosine * s0)])
            }
            Way::Polar { pole, r, phi } => {
                let ([x, y], r, (sine, cosine)) = (pair(pole, t)?, jet(r, t)?, sine_cosine(phi, t)?);
                Ok([x + r * cosine, y + r * sine])
            }
            Way::Free(laws) => pair(laws, t),
        }
    }

    /// The laws in it, with the names of their keys.
    pub fn laws(&self) -> Vec<(&'static str, &Law)> {
        match self {
            Way::Line { angle, s, from_axis, .. } => vec![(if *from_axis { "to_axis" } else { "angle" }, angle), ("s", s)],
            Way::Circle { radius, angle, s, .. } => {
                let mut all = vec![("radius", radius)];
                all.extend(angle.as_ref().map(|a| ("angle", a)));
                all.push(("s", s));
                all
            }
            Way::Polar { r, phi, .. } => vec![("r", r), ("phi", phi)],
            Way::Free([x, y]) => vec![("x", x), ("y", y)],
        }
    }
}

/// How a plate turns.
#[derive(Clone, Debug)]
pub enum Turning {
    /// By a law of its angle.
    Law(Law),
    /// Its angle at the instant, and its rates then: what it does at other times is not said.
    Now {
        /// From the axis that follows in x, y, z, x.
        angle: Law,
        /// Rate.
        omega: Law,
        /// Second derivative, if it is not zero.
        alpha: Option<Law>,
    },
}

/// Sine and cosine of the angle of a plate with their derivatives, and its rates ω and α.
#[derive(Clone, Copy, Debug)]
pub struct Turn<N> {
    /// sin φ.
    pub sin: Jet<N>,
    /// cos φ.
    pub cos: Jet<N>,
    /// ω.
    pub omega: N,
    /// α.
    pub alpha: N,
}

impl Turning {
    /// The turn so much later (s): a law is the same; rates of an instant go on with α as it is there.
    ///
    /// # Errors
    /// Where a law has no value.
    pub fn later(&self, dt: f64) -> Result<Turning, Diagnostic> {
        Ok(match self {
            Turning::Law(law) => Turning::Law(law.clone()),
            Turning::Now { .. } if dt == 0.0 => self.clone(),
            Turning::Now { angle, omega, alpha } => {
                let value = |law: &Law| jet(law, 0.0).map(|j| j.0[0]);
                let (w, second) = (value(omega)?, alpha.as_ref().map(value).transpose()?.unwrap_or(0.0));
                let (sine, cosine) = sine_cosine(angle, 0.0)?;
                let start = libm::atan2(sine.0[0], cosine.0[0]);
                Turning::Now {
                    angle: Law::number(start + w * dt + second * dt * dt / 2.0),
                    omega: Law::number(w + second * dt),
                    alpha: alpha.clone(),
                }
            }
        })
    }

    /// The turn at a time; of a plate whose rates are given at the instant, at the instant.
    ///
    /// # Errors
    /// Where a law has no value.
    pub fn at<N: Real>(&self, t: N) -> Result<Turn<N>, Diagnostic> {
        match self {
            Turning::Law(law) => {
                let [_, omega, alpha] = jet(law, t)?.0;
                let (sin, cos) = sine_cosine(law, t)?;
                Ok(Turn { sin, cos, omega, alpha })
            }
            Turning::Now { angle, omega, alpha } => {
                let value = angle.at(t)?;
                let (s, c) = (value.sin_cos().0.0[0], value.sin_cos().1.0[0]);
                let omega = jet(omega, t)?.0[0];
                let alpha = alpha.as_ref().map(|a| jet(a, t)).transpose()?.map_or(N::from_f64(0.0), |a| a.0[0]);
                let square = omega * omega;
                let (sin, cos) = (Jet([s, c * omega, c * alpha - s * square]), Jet([c, -(s * omega), -(s * alpha) - c * square]));
                Ok(Turn { sin, cos, omega, alpha })
            }
        }
    }
}
