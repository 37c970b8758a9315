//! Ways by laws of time: where a point is on its plane, and how a plate turns, with rate and second derivative, in any number.
//!
//! A way gives two coordinates: x and y on the fixed plane, distance from the axis and height along it on a plate. Nothing is
//! differentiated by hand: the laws are evaluated in jets of time ([`hodograph_base::number::Jet`]).

use hodograph_base::diag::Diagnostic;
use hodograph_base::number::{Jet, Real};
use hodograph_scene::folded::Folded;
use hodograph_scene::front::Law;

/// Two coordinates and their derivatives.
pub type Pair<N> = [Jet<N>; 2];

/// Along what a point moves, and by which law: laws as written, or folded for one kind of number ([`Folded`]).
#[derive(Clone, Debug)]
pub enum Way<L = Law> {
    /// A straight line from a place; the angle counts from the first coordinate's direction to the second's, or from the second's to the
    /// first's (from the axis of a plate).
    Line {
        /// The place at s = 0.
        from: [L; 2],
        /// Its direction.
        angle: L,
        /// Whether the angle is that from the axis.
        from_axis: bool,
        /// The law.
        s: L,
    },
    /// A circle; s is the arc, counter-clockwise from the angle.
    Circle {
        /// Its centre.
        centre: [L; 2],
        /// Its radius.
        radius: L,
        /// Where s is 0.
        angle: Option<L>,
        /// The law.
        s: L,
    },
    /// Distance from a pole and direction, each by a law.
    Polar {
        /// The pole.
        pole: [L; 2],
        /// The distance.
        r: L,
        /// The angle from the first coordinate's direction to the second's.
        phi: L,
    },
    /// Coordinates, each by a law of its own.
    Free([L; 2]),
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

impl<N: Real> Way<Folded<N>> {
    /// The coordinates at a time.
    ///
    /// # Errors
    /// Where a law has no value.
    pub fn at(&self, t: N) -> Result<Pair<N>, Diagnostic> {
        let value = |law: &Folded<N>| law.at(t).map(|v| v.si());
        let pair = |[x, y]: &[Folded<N>; 2]| Ok([value(x)?, value(y)?]);
        match self {
            Way::Line { from, angle, from_axis, s } => {
                let ([x, y], s, (sine, cosine)) = (pair(from)?, value(s)?, angle.sine_cosine(t)?);
                let (along, up) = if *from_axis { (sine, cosine) } else { (cosine, sine) };
                Ok([x + s * along, y + s * up])
            }
            Way::Circle { centre, radius, angle, s } => {
                let ([x, y], r, s) = (pair(centre)?, value(radius)?, value(s)?);
                let (sine, cosine) = (s / r).sin_cos();
                let (s0, c0) = match angle {
                    Some(angle) => angle.sine_cosine(t)?,
                    None => (Jet::from_f64(0.0), Jet::from_f64(1.0)),
                };
                Ok([x + r * (cosine * c0 - sine * s0), y + r * (sine * c0 + cosine * s0)])
            }
            Way::Polar { pole, r, phi } => {
                let ([x, y], r, (sine, cosine)) = (pair(pole)?, value(r)?, phi.sine_cosine(t)?);
                Ok([x + r * cosine, y + r * sine])
            }
            Way::Free(laws) => pair(laws),
        }
    }
}

impl Way {
    /// The way in one kind of number, to be asked often.
    ///
    /// # Errors
    /// Where a part of a law without the time has no value.
    pub fn folded<N: Real>(&self) -> Result<Way<Folded<N>>, Diagnostic> {
        let pair = |[x, y]: &[Law; 2]| Ok([x.folded()?, y.folded()?]);
        Ok(match self {
            Way::Line { from, angle, from_axis, s } => {
                Way::Line { from: pair(from)?, angle: angle.folded()?, from_axis: *from_axis, s: s.folded()? }
            }
            Way::Circle { centre, radius, angle, s } => {
                let angle = angle.as_ref().map(Law::folded).transpose()?;
                Way::Circle { centre: pair(centre)?, radius: radius.folded()?, angle, s: s.folded()? }
            }
            Way::Polar { pole, r, phi } => Way::Polar { pole: pair(pole)?, r: r.folded()?, phi: phi.folded()? },
            Way::Free(laws) => Way::Free(pair(laws)?),
        })
    }

    /// The coordinates at a time.
    ///
    /// # Errors
    /// Where a law has no value.
    pub fn at<N: Real>(&self, t: N) -> Result<Pair<N>, Diagnostic> {
        self.folded()?.at(t)
    }

    /// Whether the time is in none of its laws.
    pub fn is_at_rest(&self) -> bool {
        self.laws().iter().all(|(_, law)| !law.depends_on_time())
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
