//! The usual motion laws, normalized to unit rise over unit travel: S(x) with S(0) = 0 and S(1)
//! = 1.
//!
//! Every law consists of pieces. Each piece is a polynomial and one wave, c₀ + c₁x + … + A sin(kx +
//! p); the coefficients have a value in any kind of number and a text. Derivatives are computed
//! from the pieces and are not written separately.
//!
//! # Source
//! 孙桓《机械原理》, table of the laws of followers; R. L. Norton, *Cam Design and Manufacturing
//! Handbook*, chapters 3 and 4.

mod elementary;
mod modified;
mod polynomial;

use super::jet::CamJet;
use crate::lang::{Lang, each};
use crate::number::Real;

/// A coefficient: (a + bπ + c/π)/(d + eπ).
#[derive(Clone, Copy, Debug)]
pub struct LawCoefficient {
    over: [f64; 3],
    under: [f64; 2],
    /// The number as an expression.
    pub text: &'static str,
}

impl LawCoefficient {
    /// Returns a coefficient that is a binary fraction.
    const fn plain(value: f64, text: &'static str) -> LawCoefficient {
        LawCoefficient { over: [value, 0.0, 0.0], under: [1.0, 0.0], text }
    }

    /// Returns the coefficient (a + bπ + c/π)/(d + eπ).
    const fn of(over: [f64; 3], under: [f64; 2], text: &'static str) -> LawCoefficient {
        LawCoefficient { over, under, text }
    }

    /// Returns true if the coefficient is zero.
    pub fn is_zero(&self) -> bool {
        self.over == [0.0; 3]
    }

    /// Returns the value; a binary fraction is exact.
    pub fn value<N: Real>(&self) -> N {
        let [a, b, c] = self.over;
        let [d, e] = self.under;
        if (b, c, d, e) == (0.0, 0.0, 1.0, 0.0) {
            return N::from_f64(a);
        }
        let (pi, number) = (N::pi(), N::from_f64);
        let over = number(a) + number(b) * pi + number(c) / pi;
        over / (number(d) + number(e) * pi)
    }
}

/// A piece of a law: a polynomial and a wave, valid up to its end.
#[derive(Debug)]
pub struct LawPiece {
    /// End of the piece on x.
    pub end: f64,
    /// Coefficients of 1, x, x², …
    pub polynomial: &'static [LawCoefficient],
    /// Amplitude, degrees per unit of x, phase in degrees.
    pub wave: Option<(LawCoefficient, f64, f64)>,
}

impl LawPiece {
    /// Returns S and its first three derivatives by x.
    pub fn at<N: Real>(&self, x: N) -> CamJet<N> {
        let zero = N::from_f64(0.0);
        let mut out = [zero; 4];
        let mut c: Vec<N> = self.polynomial.iter().map(LawCoefficient::value).collect();
        for value in &mut out {
            *value = c.iter().rev().fold(zero, |sum, c| sum * x + *c);
            // The coefficients of the derivative.
            for i in 1..c.len() {
                c[i - 1] = N::from_f64(i as f64) * c[i];
            }
            c.pop();
        }
        if let Some((amplitude, k, phase)) = &self.wave {
            let (s, c) = (N::from_f64(*k) * x + N::from_f64(*phase)).sin_cos_degrees();
            let rate = N::from_f64(*k) * N::pi() / N::from_f64(180.0);
            let mut factor: N = amplitude.value();
            for (out, wave) in out.iter_mut().zip([s, c, -s, -c]) {
                *out = *out + factor * wave;
                factor = factor * rate;
            }
        }
        CamJet(out)
    }

    /// Returns the derivative of an order as an expression in a variable.
    fn text(&self, order: usize, x: &str) -> String {
        let mut terms: Vec<String> = Vec::new();
        for (i, coefficient) in self.polynomial.iter().enumerate().skip(order) {
            if coefficient.is_zero() {
                continue;
            }
            let text = coefficient.text;
            let factor: usize = (0..order).map(|j| i - j).product();
            let head = if factor == 1 { format!("({text})") } else { format!("{factor}*({text})") };
            terms.push(match i - order {
                0 => head,
                1 => format!("{head}*{x}"),
                n => format!("{head}*{x}^{n}"),
            });
        }
        if let Some((LawCoefficient { text: amplitude, .. }, k, phase)) = &self.wave {
            let rate = if order == 0 { String::new() } else { format!("*({k}/180*pi)^{order}") };
            let shift = (phase + 90.0 * order as f64) % 360.0;
            terms.push(format!("({amplitude}){rate}*sin({k} deg*{x}+{shift} deg)"));
        }
        if terms.is_empty() { "0".to_owned() } else { terms.join("+") }
    }
}

/// A motion law.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum MotionLaw {
    /// Constant velocity 等速: rigid shocks at both ends.
    Uniform,
    /// Constant acceleration, then equal retardation 等加速等减速: soft shocks.
    Parabolic,
    /// Simple harmonic motion 简谐 (余弦加速度): soft shocks at the ends.
    Harmonic,
    /// Sine acceleration 摆线 (正弦加速度): no shock.
    Cycloidal,
    /// Polynomial of degree five 3-4-5 多项式.
    Poly345,
    /// Polynomial of degree seven 4-5-6-7 多项式.
    Poly4567,
    /// Modified sine 修正正弦.
    ModifiedSine,
    /// Modified trapezoidal acceleration 修正梯形.
    ModifiedTrapezoidal,
}

impl MotionLaw {
    /// All laws.
    pub const ALL: [MotionLaw; 8] = [
        MotionLaw::Uniform,
        MotionLaw::Parabolic,
        MotionLaw::Harmonic,
        MotionLaw::Cycloidal,
        MotionLaw::Poly345,
        MotionLaw::Poly4567,
        MotionLaw::ModifiedSine,
        MotionLaw::ModifiedTrapezoidal,
    ];

    /// Returns the name in a scene.
    pub const fn name(self) -> &'static str {
        match self {
            MotionLaw::Uniform => "uniform",
            MotionLaw::Parabolic => "parabolic",
            MotionLaw::Harmonic => "harmonic",
            MotionLaw::Cycloidal => "cycloidal",
            MotionLaw::Poly345 => "3-4-5",
            MotionLaw::Poly4567 => "4-5-6-7",
            MotionLaw::ModifiedSine => "modified-sine",
            MotionLaw::ModifiedTrapezoidal => "modified-trapezoidal",
        }
    }

    /// Returns the name in a sentence.
    pub fn words(self, lang: Lang) -> &'static str {
        lang.pick(match self {
            MotionLaw::Uniform => each!("uniform"),
            MotionLaw::Parabolic => each!("parabolic"),
            MotionLaw::Harmonic => each!("harmonic"),
            MotionLaw::Cycloidal => each!("cycloidal"),
            MotionLaw::Poly345 => each!("3-4-5"),
            MotionLaw::Poly4567 => each!("4-5-6-7"),
            MotionLaw::ModifiedSine => each!("modified-sine"),
            MotionLaw::ModifiedTrapezoidal => each!("modified-trapezoidal"),
        })
    }

    /// Returns the law with a name.
    pub fn named(name: &str) -> Option<MotionLaw> {
        MotionLaw::ALL.into_iter().find(|l| l.name() == name)
    }

    /// Returns the pieces of the law, in order.
    pub fn pieces(self) -> &'static [LawPiece] {
        match self {
            MotionLaw::Uniform => elementary::UNIFORM,
            MotionLaw::Parabolic => elementary::PARABOLIC,
            MotionLaw::Harmonic => elementary::HARMONIC,
            MotionLaw::Cycloidal => elementary::CYCLOIDAL,
            MotionLaw::Poly345 => polynomial::POLY_345,
            MotionLaw::Poly4567 => polynomial::POLY_4567,
            MotionLaw::ModifiedSine => modified::SINE,
            MotionLaw::ModifiedTrapezoidal => modified::TRAPEZOIDAL,
        }
    }

    /// Returns the index of the piece that contains x; at a joint the following piece, or with
    /// `before` the preceding one.
    pub fn place(self, x: f64, before: bool) -> usize {
        let on = |p: &LawPiece| if before { x <= p.end } else { x < p.end };
        self.pieces().iter().position(on).unwrap_or(self.pieces().len() - 1)
    }

    fn piece(self, x: f64, before: bool) -> &'static LawPiece {
        &self.pieces()[self.place(x, before)]
    }

    /// Returns S, S′, S″, S‴ at x from 0 to 1.
    pub fn at(self, x: f64, side: super::PieceSide) -> [f64; 4] {
        self.piece(x, side == super::PieceSide::Before).at(x).0
    }

    /// Returns S, S′ and S″ of the piece that contains x, as expressions in a variable.
    pub fn text(self, x: f64, variable: &str) -> [String; 3] {
        std::array::from_fn(|order| self.piece(x, false).text(order, variable))
    }

    /// Returns the greatest magnitudes of S′, S″, S‴ within the pieces, one-sided at their ends: V,
    /// A, J of the tables, in units of h/β, h/β², h/β³.
    pub fn peaks(self) -> [f64; 3] {
        const STEPS: usize = 20_000;
        let mut most = [0.0f64; 3];
        let mut start = 0.0;
        for piece in self.pieces() {
            for k in 0..=STEPS {
                let at = piece.at(start + (piece.end - start) * k as f64 / STEPS as f64).0;
                for (most, value) in most.iter_mut().zip(&at[1..]) {
                    *most = most.max(value.abs());
                }
            }
            start = piece.end;
        }
        most
    }
}

#[cfg(test)]
mod tests {
    use super::super::PieceSide;
    use super::*;

    #[test]
    fn a_law_begins_at_zero_and_ends_at_one_without_a_gap() {
        for law in MotionLaw::ALL {
            let ends = [law.at(0.0, PieceSide::After)[0], law.at(1.0, PieceSide::Before)[0]];
            assert!(
                ends[0].abs() < 1e-15 && (ends[1] - 1.0).abs() < 1e-14,
                "{}: {ends:?}",
                law.name()
            );
            for joint in law.pieces().iter().map(|p| p.end).filter(|e| *e < 1.0) {
                let [before, after] =
                    [PieceSide::Before, PieceSide::After].map(|s| law.at(joint, s));
                // S and S′ are continuous; S″ jumps inside for the parabolic law only.
                let orders = if law == MotionLaw::Parabolic { 2 } else { 3 };
                for k in 0..orders {
                    assert!(
                        (before[k] - after[k]).abs() < 1e-12,
                        "{} at {joint}, order {k}: {before:?} {after:?}",
                        law.name()
                    );
                }
            }
        }
    }

    #[test]
    fn derivatives_are_those_of_differences() {
        let h = 1e-6;
        for law in MotionLaw::ALL {
            for x in [0.03, 0.111, 0.2, 0.3, 0.47, 0.52, 0.7, 0.8, 0.93] {
                let [low, here, high] = [x - h, x, x + h].map(|x| law.at(x, PieceSide::After));
                for k in 0..3 {
                    let slope = (high[k] - low[k]) / (2.0 * h);
                    assert!(
                        (slope - here[k + 1]).abs() < 1e-6 * (1.0 + slope.abs()),
                        "{} {x} {k}: {slope} {here:?}",
                        law.name()
                    );
                }
            }
        }
    }

    /// The tables of the textbooks: 孙桓, Norton 8-3.
    #[test]
    fn peaks_are_those_of_the_tables() {
        for (law, v, a, j) in [
            (MotionLaw::Uniform, 1.0, 0.0, 0.0),
            (MotionLaw::Parabolic, 2.0, 4.0, 0.0),
            (
                MotionLaw::Harmonic,
                std::f64::consts::FRAC_PI_2,
                4.934_802_200_544_68,
                15.503_138_340_149_9,
            ),
            (MotionLaw::Cycloidal, 2.0, std::f64::consts::TAU, 39.478_417_604_357_4),
            (MotionLaw::Poly345, 1.875, 5.773_502_691_896_26, 60.0),
            (MotionLaw::Poly4567, 2.1875, 7.513_188_404_399_29, 52.5),
            (
                MotionLaw::ModifiedSine,
                1.759_603_385_953_77,
                5.527_957_070_544_09,
                69.466_357_288_724_3,
            ),
            (MotionLaw::ModifiedTrapezoidal, 2.0, 4.888_123_762_813_26, 61.425_974_812_367_3),
        ] {
            for (got, exact) in law.peaks().into_iter().zip([v, a, j]) {
                assert!(
                    (got - exact).abs() <= 1e-7 * exact.max(1.0),
                    "{}: {got} {exact}",
                    law.name()
                );
            }
        }
    }
}
