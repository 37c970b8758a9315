//! Motions by laws of time: the place of a point on its plane, and the rotation of a plate, with
//! first and second derivative, in any kind of number.
//!
//! A way gives two coordinates: x and y on the fixed plane, or the distance from the axis and the
//! height along it on a plate. Derivatives are not written by hand: the laws are evaluated in jets
//! of time ([`hodograph_base::number::Jet`]).

use hodograph_base::diag::Diagnostic;
use hodograph_base::number::{Jet, Real};
use hodograph_scene::folded::Folded;
use hodograph_scene::front::Law;

/// Two coordinates and their derivatives.
pub type JetPair<N> = [Jet<N>; 2];

/// The path of a point with its law of motion: laws as written, or folded for one kind of number
/// ([`Folded`]).
#[derive(Clone, Debug)]
pub enum PathLaw<L = Law> {
    /// A straight line from a place; the angle is measured from the direction of the first
    /// coordinate to that of the second, or in the opposite order (from the axis of a plate).
    Line {
        /// The place at s = 0.
        from: [L; 2],
        /// The direction.
        angle: L,
        /// True if the angle is measured from the axis.
        from_axis: bool,
        /// The law of the distance s.
        s: L,
    },
    /// A circle; s is the arc, counter-clockwise from the angle.
    Circle {
        /// The centre.
        centre: [L; 2],
        /// The radius.
        radius: L,
        /// The angle at which s is 0.
        angle: Option<L>,
        /// The law of the arc s.
        s: L,
    },
    /// The distance from a pole and the direction, each by a law.
    Polar {
        /// The pole.
        pole: [L; 2],
        /// The distance.
        r: L,
        /// The angle from the first coordinate's direction to the second's.
        phi: L,
    },
    /// Two coordinates, each by a separate law.
    Free([L; 2]),
}

/// Returns the value of a law with its derivatives.
///
/// # Errors
/// If the law has no value.
pub fn jet<N: Real>(law: &Law, t: N) -> Result<Jet<N>, Diagnostic> {
    law.at(t).map(|v| v.si())
}

/// Returns sine and cosine of the angle of a law, which may be written in degrees.
///
/// # Errors
/// If the law has no value.
pub fn sine_cosine<N: Real>(law: &Law, t: N) -> Result<(Jet<N>, Jet<N>), Diagnostic> {
    law.at(t).map(|v| v.sin_cos())
}

impl<N: Real> PathLaw<Folded<N>> {
    /// Returns the coordinates at a time.
    ///
    /// # Errors
    /// If a law has no value.
    pub fn at(&self, t: N) -> Result<JetPair<N>, Diagnostic> {
        let value = |law: &Folded<N>| law.at(t).map(|v| v.si());
        let pair = |[x, y]: &[Folded<N>; 2]| Ok([value(x)?, value(y)?]);
        match self {
            PathLaw::Line { from, angle, from_axis, s } => {
                let ([x, y], s, (sine, cosine)) = (pair(from)?, value(s)?, angle.sine_cosine(t)?);
                let (along, up) = if *from_axis { (sine, cosine) } else { (cosine, sine) };
                Ok([x + s * along, y + s * up])
            }
            PathLaw::Circle { centre, radius, angle, s } => {
                let ([x, y], r, s) = (pair(centre)?, value(radius)?, value(s)?);
                let (sine, cosine) = (s / r).sin_cos();
                let (s0, c0) = match angle {
                    Some(angle) => angle.sine_cosine(t)?,
                    None => (Jet::from_f64(0.0), Jet::from_f64(1.0)),
                };
                Ok([x + r * (cosine * c0 - sine * s0), y + r * (sine * c0 + cosine * s0)])
            }
            PathLaw::Polar { pole, r, phi } => {
                let ([x, y], r, (sine, cosine)) = (pair(pole)?, value(r)?, phi.sine_cosine(t)?);
                Ok([x + r * cosine, y + r * sine])
            }
            PathLaw::Free(laws) => pair(laws),
        }
    }
}

impl PathLaw {
    /// Returns the way folded for one kind of number, for many evaluations.
    ///
    /// # Errors
    /// If a part of a law without the time has no value.
    pub fn folded<N: Real>(&self) -> Result<PathLaw<Folded<N>>, Diagnostic> {
        let pair = |[x, y]: &[Law; 2]| Ok([x.folded()?, y.folded()?]);
        Ok(match self {
            PathLaw::Line { from, angle, from_axis, s } => PathLaw::Line {
                from: pair(from)?,
                angle: angle.folded()?,
                from_axis: *from_axis,
                s: s.folded()?,
            },
            PathLaw::Circle { centre, radius, angle, s } => {
                let angle = angle.as_ref().map(Law::folded).transpose()?;
                PathLaw::Circle {
                    centre: pair(centre)?,
                    radius: radius.folded()?,
                    angle,
                    s: s.folded()?,
                }
            }
            PathLaw::Polar { pole, r, phi } => {
                PathLaw::Polar { pole: pair(pole)?, r: r.folded()?, phi: phi.folded()? }
            }
            PathLaw::Free(laws) => PathLaw::Free(pair(laws)?),
        })
    }

    /// Returns the coordinates at a time.
    ///
    /// # Errors
    /// If a law has no value.
    pub fn at<N: Real>(&self, t: N) -> Result<JetPair<N>, Diagnostic> {
        self.folded()?.at(t)
    }

    /// True if none of the laws contains the time.
    pub fn is_at_rest(&self) -> bool {
        self.laws().iter().all(|(_, law)| !law.depends_on_time())
    }

    /// Returns the laws, with the names of their keys.
    pub fn laws(&self) -> Vec<(&'static str, &Law)> {
        match self {
            PathLaw::Line { angle, s, from_axis, .. } => {
                vec![(if *from_axis { "to_axis" } else { "angle" }, angle), ("s", s)]
            }
            PathLaw::Circle { radius, angle, s, .. } => {
                let mut all = vec![("radius", radius)];
                all.extend(angle.as_ref().map(|a| ("angle", a)));
                all.push(("s", s));
                all
            }
            PathLaw::Polar { r, phi, .. } => vec![("r", r), ("phi", phi)],
            PathLaw::Free([x, y]) => vec![("x", x), ("y", y)],
        }
    }
}

/// The rotation of a plate.
#[derive(Clone, Debug)]
pub enum PlateRotation {
    /// A law of the angle.
    Law(Law),
    /// The angle at the instant and its derivatives there; the rotation at other times is not
    /// given.
    Now {
        /// The angle from the axis that follows cyclically in x, y, z.
        angle: Law,
        /// The angular velocity.
        omega: Law,
        /// The angular acceleration, if it is not zero.
        alpha: Option<Law>,
    },
}

/// Sine and cosine of the angle of a plate with their derivatives, and its ω and α.
#[derive(Clone, Copy, Debug)]
pub struct PlateAngle<N> {
    /// sin φ.
    pub sin: Jet<N>,
    /// cos φ.
    pub cos: Jet<N>,
    /// ω.
    pub omega: N,
    /// α.
    pub alpha: N,
}

impl PlateRotation {
    /// Returns the rotation `dt` later (s): a law is unchanged; rates at an instant continue with
    /// constant α.
    ///
    /// # Errors
    /// If a law has no value.
    pub fn later(&self, dt: f64) -> Result<PlateRotation, Diagnostic> {
        Ok(match self {
            PlateRotation::Law(law) => PlateRotation::Law(law.clone()),
            PlateRotation::Now { .. } if dt == 0.0 => self.clone(),
            PlateRotation::Now { angle, omega, alpha } => {
                let value = |law: &Law| jet(law, 0.0).map(|j| j.0[0]);
                let (w, second) =
                    (value(omega)?, alpha.as_ref().map(value).transpose()?.unwrap_or(0.0));
                let (sine, cosine) = sine_cosine(angle, 0.0)?;
                let start = libm::atan2(sine.0[0], cosine.0[0]);
                PlateRotation::Now {
                    angle: Law::number(start + w * dt + second * dt * dt / 2.0),
                    omega: Law::number(w + second * dt),
                    alpha: alpha.clone(),
                }
            }
        })
    }

    /// Returns the rotation at a time; if the rates are given at the instant, that of the instant.
    ///
    /// # Errors
    /// If a law has no value.
    pub fn at<N: Real>(&self, t: N) -> Result<PlateAngle<N>, Diagnostic> {
        match self {
            PlateRotation::Law(law) => {
                let [_, omega, alpha] = jet(law, t)?.0;
                let (sin, cos) = sine_cosine(law, t)?;
                Ok(PlateAngle { sin, cos, omega, alpha })
            }
            PlateRotation::Now { angle, omega, alpha } => {
                let value = angle.at(t)?;
                let (s, c) = (value.sin_cos().0.0[0], value.sin_cos().1.0[0]);
                let omega = jet(omega, t)?.0[0];
                let alpha = alpha
                    .as_ref()
                    .map(|a| jet(a, t))
                    .transpose()?
                    .map_or(N::from_f64(0.0), |a| a.0[0]);
                let square = omega * omega;
                let (sin, cos) = (
                    Jet([s, c * omega, c * alpha - s * square]),
                    Jet([c, -(s * omega), -(s * alpha) - c * square]),
                );
                Ok(PlateAngle { sin, cos, omega, alpha })
            }
        }
    }
}
