//! A value with its first three derivatives by φ, and the arithmetic of such values (Leibniz, Faà di Bruno).

use std::ops::{Add, Mul, Neg, Sub};

/// f, f′, f″, f‴.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet(pub [f64; 4]);

impl Jet {
    /// A value that stays.
    pub const fn constant(x: f64) -> Jet {
        Jet([x, 0.0, 0.0, 0.0])
    }

    /// φ itself.
    pub const fn variable(phi: f64) -> Jet {
        Jet([phi, 1.0, 0.0, 0.0])
    }

    /// The value.
    pub fn value(self) -> f64 {
        self.0[0]
    }

    /// The value of a function whose derivatives at the value are `g`.
    fn of(self, g: [f64; 4]) -> Jet {
        let [_, a, b, c] = self.0;
        Jet([g[0], g[1] * a, g[2] * a * a + g[1] * b, g[3] * a * a * a + 3.0 * g[2] * a * b + g[1] * c])
    }

    /// Square root; not a number where there is none.
    pub fn sqrt(self) -> Jet {
        let x = self.0[0];
        let r = if x < 0.0 { f64::NAN } else { x.sqrt() };
        self.of([r, 0.5 / r, -0.25 / (x * r), 0.375 / (x * x * r)])
    }

    /// One over the value.
    pub fn recip(self) -> Jet {
        let i = 1.0 / self.0[0];
        self.of([i, -i * i, 2.0 * i * i * i, -6.0 * i * i * i * i])
    }

    /// Sine and cosine.
    pub fn sine_cosine(self) -> (Jet, Jet) {
        let (s, c) = libm::sincos(self.0[0]);
        (self.of([s, c, -s, -c]), self.of([c, -s, -c, s]))
    }

    /// The angle of a sine, from −π/2 to π/2.
    pub fn arc_sine(self) -> Jet {
        let x = self.0[0];
        let q = 1.0 - x * x;
        let w = if q < 0.0 { f64::NAN } else { q.sqrt() };
        self.of([libm::asin(x), 1.0 / w, x / (q * w), (1.0 + 2.0 * x * x) / (q * q * w)])
    }

    /// The angle of a cosine, from 0 to π.
    pub fn arc_cosine(self) -> Jet {
        Jet::constant(std::f64::consts::FRAC_PI_2) - self.arc_sine()
    }

    /// The direction of (x, y).
    pub fn direction(y: Jet, x: Jet) -> Jet {
        let at = libm::atan2(y.0[0], x.0[0]);
        let (s, c) = libm::sincos(at);
        let (u, v) = (x * c + y * s, y * c - x * s);
        // The direction that is left is none at the value: atan has there the derivatives 1, 0, −2.
        let rest = (v * u.recip()).of([0.0, 1.0, 0.0, -2.0]);
        rest + Jet::constant(at)
    }

    /// The same with one derivative fewer: f′, f″, f‴; the last is not known and counts as zero.
    pub fn derivative(self) -> Jet {
        Jet([self.0[1], self.0[2], self.0[3], 0.0])
    }
}

impl Add for Jet {
    type Output = Jet;
    fn add(self, other: Jet) -> Jet {
        Jet(std::array::from_fn(|i| self.0[i] + other.0[i]))
    }
}

impl Sub for Jet {
    type Output = Jet;
    fn sub(self, other: Jet) -> Jet {
        Jet(std::array::from_fn(|i| self.0[i] - other.0[i]))
    }
}

impl Neg for Jet {
    type Output = Jet;
    fn neg(self) -> Jet {
        Jet(self.0.map(|x| -x))
    }
}

impl Mul for Jet {
    type Output = Jet;
    fn mul(self, other: Jet) -> Jet {
        let ([a, a1, a2, a3], [b, b1, b2, b3]) = (self.0, other.0);
        Jet([a * b, a1 * b + a * b1, a2 * b + 2.0 * a1 * b1 + a * b2, a3 * b + 3.0 * (a2 * b1 + a1 * b2) + a * b3])
    }
}

impl Mul<f64> for Jet {
    type Output = Jet;
    fn mul(self, by: f64) -> Jet {
        Jet(self.0.map(|x| x * by))
    }
}

/// A vector whose parts are jets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// To the right.
    pub x: Jet,
    /// Up.
    pub y: Jet,
}

impl Plane {
    /// A vector that stays.
    pub fn constant(v: crate::geom::Vec2) -> Plane {
        Plane { x: Jet::constant(v.x), y: Jet::constant(v.y) }
    }

    /// The direction at an angle.
    pub fn direction(angle: Jet) -> Plane {
        let (y, x) = angle.sine_cosine();
        Plane { x, y }
    }

    /// Turned by an angle, counter-clockwise.
    pub fn turned(self, by: Jet) -> Plane {
        let (s, c) = by.sine_cosine();
        Plane { x: self.x * c - self.y * s, y: self.x * s + self.y * c }
    }

    /// The product of the lengths and the cosine of the angle between.
    pub fn dot(self, other: Plane) -> Jet {
        self.x * other.x + self.y * other.y
    }

    /// Turned a quarter, counter-clockwise.
    pub fn perp(self) -> Plane {
        Plane { x: -self.y, y: self.x }
    }

    /// The direction as an angle.
    pub fn angle(self) -> Jet {
        Jet::direction(self.y, self.x)
    }

    /// The vector (0), or its derivative of an order.
    pub fn order(self, k: usize) -> crate::geom::Vec2 {
        crate::geom::Vec2::new(self.x.0[k], self.y.0[k])
    }
}

impl Add for Plane {
    type Output = Plane;
    fn add(self, other: Plane) -> Plane {
        Plane { x: self.x + other.x, y: self.y + other.y }
    }
}

impl Sub for Plane {
    type Output = Plane;
    fn sub(self, other: Plane) -> Plane {
        Plane { x: self.x - other.x, y: self.y - other.y }
    }
}

impl Mul<Jet> for Plane {
    type Output = Plane;
    fn mul(self, by: Jet) -> Plane {
        Plane { x: self.x * by, y: self.y * by }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A derivative by differences of the one before.
    fn check(f: impl Fn(Jet) -> Jet, x: f64) {
        let h = 1e-5;
        let [low, here, high] = [x - h, x, x + h].map(|x| f(Jet::variable(x)));
        for k in 0..3 {
            let slope = (high.0[k] - low.0[k]) / (2.0 * h);
            assert!((slope - here.0[k + 1]).abs() < 1e-7 * (1.0 + slope.abs()), "{k}: {slope} {}", here.0[k + 1]);
        }
    }

    #[test]
    fn derivatives_are_those_of_differences() {
        check(|x| (x * x + Jet::constant(1.0)).sqrt(), 0.7);
        check(|x| (x * x * x + Jet::constant(2.0)).recip(), 0.4);
        check(|x| x.sine_cosine().0 * x.sine_cosine().1 * x, 1.1);
        check(|x| (x * 0.5).arc_sine() + (x * x * 0.3).arc_cosine(), 0.6);
        check(|x| Jet::direction(x * x + Jet::constant(0.3), x * -2.0), 0.8);
        check(|x| Plane::direction(x).turned(x * 2.0).angle(), 0.5);
    }
}
