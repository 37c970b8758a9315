//! A value with its first three derivatives by φ, and the arithmetic of such values (Leibniz, Faà
//! di Bruno), in any kind of number.

use crate::geom::Vec2;
use crate::number::Real;
use std::ops::{Add, Mul, Neg, Sub};

/// The value and its derivatives f, f′, f″, f‴.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CamJet<N = f64>(pub [N; 4]);

impl<N: Real> CamJet<N> {
    /// Returns a constant.
    pub fn constant(x: N) -> Self {
        let zero = N::from_f64(0.0);
        CamJet([x, zero, zero, zero])
    }

    /// Returns φ itself.
    pub fn variable(phi: N) -> Self {
        let zero = N::from_f64(0.0);
        CamJet([phi, N::from_f64(1.0), zero, zero])
    }

    /// Returns the value.
    pub fn value(self) -> N {
        self.0[0]
    }

    /// Returns g∘f for a function with the value and derivatives `g` at the value of f.
    fn of(self, g: [N; 4]) -> Self {
        let [_, a, b, c] = self.0;
        let three = N::from_f64(3.0);
        CamJet([
            g[0],
            g[1] * a,
            g[2] * a * a + g[1] * b,
            g[3] * a * a * a + three * g[2] * a * b + g[1] * c,
        ])
    }

    /// Returns the square root; undecided if it does not exist.
    pub fn sqrt(self) -> Self {
        let x = self.0[0];
        let r = x.sqrt();
        let [half, quarter, more] = [0.5, -0.25, 0.375].map(N::from_f64);
        self.of([r, half / r, quarter / (x * r), more / (x * x * r)])
    }

    /// Returns the reciprocal.
    pub fn recip(self) -> Self {
        let i = N::from_f64(1.0) / self.0[0];
        self.of([i, -i * i, N::from_f64(2.0) * i * i * i, N::from_f64(-6.0) * i * i * i * i])
    }

    /// Returns sine and cosine.
    pub fn sine_cosine(self) -> (Self, Self) {
        let (s, c) = self.0[0].sin_cos();
        (self.of([s, c, -s, -c]), self.of([c, -s, -c, s]))
    }

    /// Returns the arc sine, from −π/2 to π/2; undecided if it does not exist.
    pub fn arc_sine(self) -> Self {
        let x = self.0[0];
        let one = N::from_f64(1.0);
        let q = (one - x) * (one + x);
        let w = q.sqrt();
        self.of([x.atan2(w), one / w, x / (q * w), (one + N::from_f64(2.0) * x * x) / (q * q * w)])
    }

    /// Returns the arc cosine, from 0 to π; undecided if it does not exist.
    pub fn arc_cosine(self) -> Self {
        CamJet::constant(N::pi() * N::from_f64(0.5)) - self.arc_sine()
    }

    /// Returns the direction of (x, y) as an angle.
    pub fn direction(y: Self, x: Self) -> Self {
        // θ′ = (x y′ − y x′)/(x² + y²); its derivatives are the higher derivatives of θ.
        let rate = (x * y.derivative() - y * x.derivative()) * (x * x + y * y).recip();
        CamJet([y.0[0].atan2(x.0[0]), rate.0[0], rate.0[1], rate.0[2]])
    }

    /// Returns the derivative with its own derivatives: f′, f″, f‴; the fourth derivative is
    /// unknown and counts as zero.
    pub fn derivative(self) -> Self {
        CamJet([self.0[1], self.0[2], self.0[3], N::from_f64(0.0)])
    }

    /// Returns the value multiplied by a sign, +1 or −1.
    pub fn signed(self, sign: f64) -> Self {
        if sign < 0.0 { -self } else { self }
    }
}

impl<N: Real> Add for CamJet<N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        CamJet(std::array::from_fn(|i| self.0[i] + other.0[i]))
    }
}

impl<N: Real> Sub for CamJet<N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        CamJet(std::array::from_fn(|i| self.0[i] - other.0[i]))
    }
}

impl<N: Real> Neg for CamJet<N> {
    type Output = Self;
    fn neg(self) -> Self {
        CamJet(self.0.map(|x| -x))
    }
}

impl<N: Real> Mul for CamJet<N> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let ([a, a1, a2, a3], [b, b1, b2, b3]) = (self.0, other.0);
        let [two, three] = [2.0, 3.0].map(N::from_f64);
        CamJet([
            a * b,
            a1 * b + a * b1,
            a2 * b + two * a1 * b1 + a * b2,
            a3 * b + three * (a2 * b1 + a1 * b2) + a * b3,
        ])
    }
}

impl<N: Real> Mul<N> for CamJet<N> {
    type Output = Self;
    fn mul(self, by: N) -> Self {
        CamJet(self.0.map(|x| x * by))
    }
}

/// A vector with jets as components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane<N = f64> {
    /// The component to the right.
    pub x: CamJet<N>,
    /// The component upward.
    pub y: CamJet<N>,
}

impl<N: Real> Plane<N> {
    /// Returns a constant vector.
    pub fn constant(v: Vec2<N>) -> Self {
        Plane { x: CamJet::constant(v.x), y: CamJet::constant(v.y) }
    }

    /// Returns the unit vector at an angle.
    pub fn direction(angle: CamJet<N>) -> Self {
        let (y, x) = angle.sine_cosine();
        Plane { x, y }
    }

    /// Returns the vector turned by an angle, counter-clockwise.
    pub fn turned(self, by: CamJet<N>) -> Self {
        let (s, c) = by.sine_cosine();
        Plane { x: self.x * c - self.y * s, y: self.x * s + self.y * c }
    }

    /// Returns the scalar product.
    pub fn dot(self, other: Self) -> CamJet<N> {
        self.x * other.x + self.y * other.y
    }

    /// Returns the z component of the cross product.
    pub fn cross(self, other: Self) -> CamJet<N> {
        self.x * other.y - self.y * other.x
    }

    /// Returns the vector turned by +90°.
    pub fn perp(self) -> Self {
        Plane { x: -self.y, y: self.x }
    }

    /// Returns the direction as an angle.
    pub fn angle(self) -> CamJet<N> {
        CamJet::direction(self.y, self.x)
    }

    /// Returns the vector (`k` = 0) or its derivative of order `k`.
    pub fn order(self, k: usize) -> Vec2<N> {
        Vec2::new(self.x.0[k], self.y.0[k])
    }

    /// Returns the derivative, which has one derivative fewer.
    pub fn derivative(self) -> Self {
        Plane { x: self.x.derivative(), y: self.y.derivative() }
    }

    /// Returns the vector multiplied by a sign, +1 or −1.
    pub fn signed(self, sign: f64) -> Self {
        Plane { x: self.x.signed(sign), y: self.y.signed(sign) }
    }
}

impl<N: Real> Add for Plane<N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Plane { x: self.x + other.x, y: self.y + other.y }
    }
}

impl<N: Real> Sub for Plane<N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Plane { x: self.x - other.x, y: self.y - other.y }
    }
}

impl<N: Real> Mul<CamJet<N>> for Plane<N> {
    type Output = Self;
    fn mul(self, by: CamJet<N>) -> Self {
        Plane { x: self.x * by, y: self.y * by }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks each derivative against the differences of the previous one.
    fn check(f: impl Fn(CamJet) -> CamJet, x: f64) {
        let h = 1e-5;
        let [low, here, high] = [x - h, x, x + h].map(|x| f(CamJet::variable(x)));
        for k in 0..3 {
            let slope = (high.0[k] - low.0[k]) / (2.0 * h);
            assert!(
                (slope - here.0[k + 1]).abs() < 1e-7 * (1.0 + slope.abs()),
                "{k}: {slope} {}",
                here.0[k + 1]
            );
        }
    }

    #[test]
    fn derivatives_are_those_of_differences() {
        check(|x| (x * x + CamJet::constant(1.0)).sqrt(), 0.7);
        check(|x| (x * x * x + CamJet::constant(2.0)).recip(), 0.4);
        check(|x| x.sine_cosine().0 * x.sine_cosine().1 * x, 1.1);
        check(|x| (x * 0.5).arc_sine() + (x * x * 0.3).arc_cosine(), 0.6);
        check(|x| CamJet::direction(x * x + CamJet::constant(0.3), x * -2.0), 0.8);
        check(|x| Plane::direction(x).turned(x * 2.0).angle(), 0.5);
    }
}
