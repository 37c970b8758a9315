//! A value with its first and second derivative by one variable, over any kind of number: a formula
//! is differentiated exactly, term by term (Leibniz' and the chain rule), and keeps the digits and
//! the error bound of the underlying numbers.
//!
//! Decisions (domains, whole exponents) depend on the value alone.

use super::Real;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// f, f′, f″.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet<N>(pub [N; 3]);

impl<N: Real> Jet<N> {
    /// Returns a constant.
    pub fn constant(x: N) -> Self {
        Jet([x, N::from_f64(0.0), N::from_f64(0.0)])
    }

    /// Returns the variable itself.
    pub fn variable(x: N) -> Self {
        Jet([x, N::from_f64(1.0), N::from_f64(0.0)])
    }

    /// Returns true if the value is constant to this order.
    pub fn stays(self) -> bool {
        self.0[1..].iter().all(|d| d.approx() == 0.0 && d.radius() == 0.0)
    }

    /// Returns a function of the jet, with the value and derivatives `g` at the value.
    fn of(self, g: [N; 3]) -> Self {
        let [_, a, b] = self.0;
        Jet([g[0], g[1] * a, g[2] * a * a + g[1] * b])
    }
}

impl<N: Real> Add for Jet<N> {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Jet([0, 1, 2].map(|k| self.0[k] + o.0[k]))
    }
}

impl<N: Real> Sub for Jet<N> {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Jet([0, 1, 2].map(|k| self.0[k] - o.0[k]))
    }
}

impl<N: Real> Neg for Jet<N> {
    type Output = Self;
    fn neg(self) -> Self {
        Jet(self.0.map(|x| -x))
    }
}

impl<N: Real> Mul for Jet<N> {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        let ([a, a1, a2], [b, b1, b2]) = (self.0, o.0);
        Jet([a * b, a1 * b + a * b1, a2 * b + a1 * b1 + a1 * b1 + a * b2])
    }
}

impl<N: Real> Div for Jet<N> {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        let ([a, a1, a2], [b, b1, b2]) = (self.0, o.0);
        let q = a / b;
        let q1 = (a1 - q * b1) / b;
        Jet([q, q1, (a2 - q1 * b1 - q1 * b1 - q * b2) / b])
    }
}

impl<N: Real> Real for Jet<N> {
    fn from_f64(x: f64) -> Self {
        Jet::constant(N::from_f64(x))
    }

    fn from_bounded(value: f64, error: f64) -> Option<Self> {
        N::from_bounded(value, error).map(Jet::constant)
    }

    fn from_decimal(text: &str) -> Self {
        Jet::constant(N::from_decimal(text))
    }

    fn approx(self) -> f64 {
        self.0[0].approx()
    }

    fn is_decided(self) -> bool {
        self.0.iter().all(|x| x.is_decided())
    }

    fn knows_its_error() -> bool {
        N::knows_its_error()
    }

    fn refines() -> bool {
        N::refines()
    }

    fn mid(self) -> Self {
        Jet(self.0.map(N::mid))
    }

    fn radius(self) -> f64 {
        self.0[0].radius()
    }

    fn sqrt(self) -> Self {
        let r = self.0[0].sqrt();
        if self.stays() {
            return Jet::constant(r);
        }
        let half = N::from_f64(0.5) / r;
        self.of([r, half, -(half * N::from_f64(0.5) / self.0[0])])
    }

    fn is_surely_negative(self) -> bool {
        self.0[0].is_surely_negative()
    }

    fn hypot(self, y: Self) -> Self {
        (self * self + y * y).sqrt()
    }

    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.0[0].sin_cos();
        (self.of([s, c, -s]), self.of([c, -s, -c]))
    }

    fn sin_cos_degrees(self) -> (Self, Self) {
        let (s, c) = self.0[0].sin_cos_degrees();
        let one = N::pi() / N::from_f64(180.0);
        (self.of([s, c * one, -(s * one * one)]), self.of([c, -(s * one), -(c * one * one)]))
    }

    fn atan2(self, x: Self) -> Self {
        let y = self;
        let angle = y.0[0].atan2(x.0[0]);
        let square = x.0[0] * x.0[0] + y.0[0] * y.0[0];
        let first = (x.0[0] * y.0[1] - y.0[0] * x.0[1]) / square;
        let slope = (x.0[0] * x.0[1] + y.0[0] * y.0[1]) * N::from_f64(2.0);
        Jet([angle, first, (x.0[0] * y.0[2] - y.0[0] * x.0[2] - first * slope) / square])
    }

    fn pow(self, exponent: Self) -> Self {
        if self.stays() && exponent.stays() {
            return Jet::constant(self.0[0].pow(exponent.0[0]));
        }
        if !exponent.stays() {
            return (self.ln() * exponent).exp();
        }
        // The derivatives of x^k by lower powers: they exist at x = 0 for whole k ≥ 2.
        let (x, k) = (self.0[0], exponent.0[0]);
        let one = N::from_f64(1.0);
        let power = |by: f64| {
            // A whole exponent stays exact.
            let whole = k.radius() == 0.0 && k == N::from_f64(k.approx());
            let e = if whole { N::from_f64(k.approx() - by) } else { k - N::from_f64(by) };
            // 0^0 appears with a coefficient that is zero, or for one.
            if e.approx() == 0.0 { one } else { x.pow(e) }
        };
        let first = if k.approx() == 0.0 { N::from_f64(0.0) } else { k * power(1.0) };
        let second = if k.approx() == 0.0 || k.approx() == 1.0 {
            N::from_f64(0.0)
        } else {
            k * (k - one) * power(2.0)
        };
        self.of([power(0.0), first, second])
    }

    fn ln(self) -> Self {
        let i = N::from_f64(1.0) / self.0[0];
        self.of([self.0[0].ln(), i, -(i * i)])
    }

    fn exp(self) -> Self {
        let e = self.0[0].exp();
        self.of([e, e, e])
    }

    fn pi() -> Self {
        Jet::constant(N::pi())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::{Ball, Dd};

    /// Checks every rule against differences in double-double numbers.
    #[test]
    fn derivatives_are_those_of_differences() {
        type F<N> = fn(N) -> N;
        fn all<N: Real>() -> [F<N>; 11] {
            [
                |x| x * x + x,
                |x| x - N::from_f64(1.0) / x,
                |x| -(x * x * x),
                |x| x.sqrt(),
                |x| x.hypot(x * x),
                |x| x.sin_cos().0,
                |x| x.sin_cos().1,
                |x| (x * N::from_f64(20.0)).sin_cos_degrees().0,
                |x| (x * N::from_f64(20.0)).sin_cos_degrees().1,
                |x| x.atan2(x * x + N::from_f64(1.0)),
                |x| x.pow(N::from_f64(3.0)) + x.pow(N::from_f64(1.0)) - x.pow(N::from_f64(-2.0)),
            ]
        }
        let h = 1e-8;
        for (k, (jet, plain)) in all::<Jet<f64>>().iter().zip(all::<Dd>()).enumerate() {
            let [f, f1, f2] = jet(Jet::variable(0.7)).0;
            let at = |by: f64| plain(Dd::from_f64(0.7) + Dd::from_f64(by));
            let (low, mid, high) = (at(-h), at(0.0), at(h));
            let first = ((high - low) / Dd::from_f64(2.0 * h)).approx();
            let second = ((high - mid - (mid - low)) / Dd::from_f64(h * h)).approx();
            assert!((f - mid.approx()).abs() < 1e-14, "{k}: {f}");
            assert!((f1 - first).abs() < 1e-12 * (1.0 + first.abs()), "{k}: {f1} {first}");
            assert!((f2 - second).abs() < 1e-11 * (1.0 + second.abs()), "{k}: {f2} {second}");
        }
        let (root, power) =
            (Jet::variable(0.7_f64).sqrt(), Jet::variable(0.7_f64).pow(Jet::from_f64(0.5)));
        assert!(
            root.0.iter().zip(power.0).all(|(a, b)| (a - b).abs() < 1e-14),
            "{root:?} {power:?}"
        );
        let (x, both) = (Jet::variable(0.7_f64), Jet::variable(0.7_f64).pow(Jet::variable(0.7)));
        assert_eq!(both, (x.ln() * x).exp());
        let square = Jet::<Ball<f64>>::variable(Ball::from_f64(0.0)).pow(Jet::from_f64(2.0));
        assert_eq!(square.0.map(Real::approx), [0.0, 0.0, 2.0]);
    }

    /// Queries of a jet depend on its value: the same calls on the value alone give the same
    /// answers.
    #[test]
    fn a_jet_of_balls_knows_the_error_of_its_value() {
        for (mid, radius) in [(3.0, 0.25), (-1.0, 0.0), (-2.0, 1e-9), (0.5, 1.0), (f64::NAN, 0.0)] {
            let ball = Ball::<f64>::new(mid, radius);
            let jet = Jet::variable(ball);
            assert_eq!(jet.radius(), ball.radius());
            assert_eq!(jet.mid().radius(), 0.0);
            assert_eq!(jet.is_surely_negative(), ball.is_surely_negative());
            assert_eq!(jet.is_decided(), ball.is_decided());
        }
    }
}
