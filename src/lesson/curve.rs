//! The curve that the page draws between two frames; it is used here to judge the accuracy of the
//! page.

/// The value at `t` between knots `k` and `k + 1` (each a time and a value). The curve is a cubic.
/// Its slope at a knot is that of the parabola through the knot and its two neighbours, at an end
/// that of the parabola through the last three knots.
pub fn between(knots: &[(f64, f64)], k: usize, t: f64) -> f64 {
    let ((t0, p0), (t1, p1)) = (knots[k], knots[k + 1]);
    let h = t1 - t0;
    let rise = |i: usize| (knots[i + 1].1 - knots[i].1) / (knots[i + 1].0 - knots[i].0);
    let step = |i: usize| knots[i + 1].0 - knots[i].0;
    let before = k.checked_sub(1);
    let after = (k + 2 < knots.len()).then_some(k + 1);
    let here = rise(k);
    // Slope of a parabola: each of the two rises is weighted by the length of the other interval.
    let weigh = |a: usize, b: usize| (step(b) * rise(a) + step(a) * rise(b)) / (step(a) + step(b));
    let m0 = match (before, after) {
        (Some(b), _) => weigh(b, k),
        (None, Some(a)) => 2.0 * here - weigh(k, a),
        (None, None) => here,
    };
    let m1 = match (before, after) {
        (_, Some(a)) => weigh(k, a),
        (Some(b), None) => 2.0 * here - weigh(b, k),
        (None, None) => here,
    };
    let s = (t - t0) / h;
    let (s2, s3) = (s * s, s * s * s);
    p0 * (2.0 * s3 - 3.0 * s2 + 1.0)
        + m0 * h * (s3 - 2.0 * s2 + s)
        + p1 * (3.0 * s2 - 2.0 * s3)
        + m1 * h * (s3 - s2)
}

/// The value at `t` outside the known values, extrapolated by the polynomial through them.
pub fn onward(known: &[(f64, f64)], t: f64) -> f64 {
    let weight = |i: usize| {
        (0..known.len())
            .filter(|j| *j != i)
            .map(|j| (t - known[j].0) / (known[i].0 - known[j].0))
            .product::<f64>()
    };
    known.iter().enumerate().map(|(i, k)| k.1 * weight(i)).sum()
}

#[cfg(test)]
mod tests {
    use super::{between, onward};

    /// The curve reproduces a parabola exactly, with uneven steps and at the ends.
    #[test]
    fn parabolas_are_exact() {
        let f = |t: f64| 3.0 * t * t - t + 2.0;
        let knots: Vec<(f64, f64)> = [0.0, 1.0, 1.5, 3.0].iter().map(|t| (*t, f(*t))).collect();
        for (k, t) in [(0, 0.3), (1, 1.2), (2, 2.9)] {
            assert!((between(&knots, k, t) - f(t)).abs() < 1e-12, "{k} {t}");
        }
        assert!(
            (onward(&knots[1..], 3.5) - f(3.5)).abs() < 1e-12
                && onward(&knots[..1], 9.0) == knots[0].1
        );
    }
}
