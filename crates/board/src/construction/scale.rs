//! Scales in other kinds of number.

use hodograph_base::digits::shortest;
use hodograph_base::number::Real;

/// A scale as another kind of number: the decimal that is printed, exactly, and not a neighbour of
/// it.
pub fn number<N: Real>(mu: f64) -> N {
    let error = if N::knows_its_error() { mu.abs() * f64::EPSILON } else { 0.0 };
    N::from_bounded(mu, error)
        .filter(|_| error == 0.0 || is_nearest_to_its_decimal(mu))
        .unwrap_or_else(|| N::from_decimal(&shortest(mu)))
}

/// True if a scale is the nearest double to a decimal of few digits, tested without writing it: n
/// and 10^e are exact, and so their quotient is rounded correctly.
fn is_nearest_to_its_decimal(mu: f64) -> bool {
    let mut power = 1.0;
    // 10^22 is the largest power of ten that a double holds; `shortest` writes twelve digits.
    for _ in 0..=22 {
        let n = libm::rint(mu * power);
        if n.abs() < 1e12 && n / power == mu {
            return true;
        }
        power *= 10.0;
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;
    use hodograph_base::number::{Ball, Dd};

    #[test]
    fn a_scale_is_the_decimal_that_is_printed() {
        for mu in [0.005, 0.02, 2.5e-6, 1.0, 50.0, 1e9, 0.0123] {
            assert!(is_nearest_to_its_decimal(mu), "{mu}");
            let (quick, told): (Ball<f64>, Ball<Dd>) =
                (number(mu), Real::from_decimal(&shortest(mu)));
            assert!(
                (told - Ball::exact(Dd::from_f64(quick.approx()))).approx().abs() <= quick.radius(),
                "{mu}"
            );
        }
        assert!(
            ![0.1 + 0.2, 1.0 / 3.0, 1e-30, f64::NAN].into_iter().any(is_nearest_to_its_decimal)
        );
    }
}
