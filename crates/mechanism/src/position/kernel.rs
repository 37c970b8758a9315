//! Closures of the dyads in closed form. Both closures are returned; another module selects one.
//!
//! A pin held by two legs is on two loci, each a circle or a line; a lever pinned at one point,
//! with a slot over a pin at another, is turned until its slot meets the pin. That makes the five
//! dyads: RRR two circles, RRP circle and line, PRP two lines, RPP two lines (or a line and a
//! circle) for a link that keeps its direction, RPR the lever.
//!
//! Loci that do not meet are reported with the amount by which they miss; the only tolerances are
//! those of rounding.

use hodograph_base::geom::{Point, Vec2, cross_lines};
use hodograph_base::number::Real;

/// A locus of a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Locus<N = f64> {
    /// All points at `radius` from `centre`.
    Circle {
        /// Centre.
        centre: Point<N>,
        /// Radius, not negative.
        radius: N,
    },
    /// A straight line.
    Line {
        /// A point of it.
        through: Point<N>,
        /// Unit direction.
        direction: Vec2<N>,
    },
}

/// The reason why two loci do not meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Miss {
    /// Two circles, or a circle and a line, too far apart by this much (m).
    TooFar(f64),
    /// One circle inside the other, with this gap (m).
    TooNear(f64),
    /// Two parallel lines at this distance (m), or two circles about one centre.
    Parallel(f64),
}

/// Returns the intersections of two loci, at most two: first the one on the left of the line from
/// the first locus's centre to the second's (two circles), or the one further along the line's
/// direction (circle and line).
///
/// Two coinciding solutions (the loci touch) are returned as two equal points. In numbers that know
/// their error a miss is a statement about the numbers as written; in plain numbers, a miss within
/// rounding counts as contact.
pub fn meet<N: Real>(a: Locus<N>, b: Locus<N>) -> Result<Vec<Point<N>>, Miss> {
    match (a, b) {
        (Locus::Circle { centre: p, radius: r }, Locus::Circle { centre: q, radius: s }) => {
            circles(p, r, q, s)
        }
        (Locus::Circle { centre, radius }, Locus::Line { through, direction })
        | (Locus::Line { through, direction }, Locus::Circle { centre, radius }) => {
            circle_line(centre, radius, through, direction)
        }
        (Locus::Line { through: p, direction: u }, Locus::Line { through: q, direction: w }) => {
            let c = cross_lines(p, u, q, w);
            // The sine of two unit vectors that are parallel as written is zero to the last bit or
            // two.
            if c.sine.approx().abs() <= PARALLEL || !c.at.is_finite() {
                Err(Miss::Parallel(u.cross(q - p).approx().abs()))
            } else {
                Ok(vec![c.at])
            }
        }
    }
}

/// Sine below which two directions cannot be distinguished from parallel ones: each is a unit
/// vector rounded by a few units in the last place (u = 1.1e-16). A smaller bound takes rounding
/// for geometry, a larger one refuses poses that double precision can still solve to a digit.
const PARALLEL: f64 = 1e-15;

/// Rounding tolerance of a radicand that is a product of two differences of squares: if the written
/// numbers make the loci touch exactly, rounding may leave −4u of its terms. A radicand below that
/// is a miss, not contact.
const TOUCH: f64 = 8.0 * f64::EPSILON;

/// Ratio of the size of two circles to the distance of their centres above which the tolerance of
/// their inner contact is measured by that distance: below it, the two measures differ by less than
/// this factor.
const CLOSE: f64 = 16.0;

/// Relative distance, as a part of the radius, of the contact point of two circles from the
/// circles: rounding gives some 1e-8, circles about one centre miss by the whole radius.
const COINCIDE: f64 = 1e-6;

/// Returns true if a radicand is negative beyond its rounding; `size` is that of its terms. Numbers
/// that know their error decide by their bound: with a wide bound the midpoint is not conclusive.
fn misses<N: Real>(radicand: N, size: N) -> bool {
    if N::knows_its_error() {
        radicand.is_surely_negative()
    } else {
        radicand.approx() < -TOUCH * size.approx()
    }
}

/// Returns a radicand, set to zero in plain numbers if it is zero within rounding: the loci touch,
/// and their intersection does not move by the square root of the rounding (1e-8 of the size:
/// a dead centre would be missed by as much).
fn touching<N: Real>(radicand: N, size: N) -> N {
    if !N::refines() && radicand.approx().abs() <= 0.25 * TOUCH * size.approx() {
        N::from_f64(0.0)
    } else {
        radicand
    }
}

/// Returns the factors (r+s)²−d² and d²−(r−s)² of m: two circles meet if neither is negative.
///
/// # Source
/// m = ((r+s)²−d²)(d²−(r−s)²), the squared quadruple area after Heron; of 12 measured forms this is
/// the fastest, and as stable as Kahan's.
fn factors<N: Real>(d2: N, r: N, s: N) -> [N; 2] {
    [(r + s) * (r + s) - d2, d2 - (r - s) * (r - s)]
}

/// Returns the vector from the first centre to the middle of the common chord, and half of the
/// chord, on the left of `d`; `m` as above.
fn chord<N: Real>(d: Vec2<N>, d2: N, m: N, r: N, s: N) -> [Vec2<N>; 2] {
    let two = N::from_f64(2.0);
    let f = (d2 + (r - s) * (r + s)) / (two * d2);
    let h = m.sqrt_or_zero() / (two * d2);
    [d * f, d.perp() * h]
}

/// Returns the intersections of circles about `p` and `q`, first the point on the left of the line
/// from `p` to `q`; `None` if there are none.
///
/// For searches with millions of calls, in plain numbers and lengths of similar size: like
/// [`meet`], but without its scaling, without the rounding tolerance at contact, and without the
/// amount of a miss.
pub fn crossing(p: Point, r: f64, q: Point, s: f64) -> Option<[Point; 2]> {
    let d = q - p;
    let d2 = d.norm2();
    let [outer, inner] = factors(d2, r, s);
    if !(outer >= 0.0 && inner >= 0.0 && d2 > 0.0) {
        return None;
    }
    let [foot, side] = chord(d, d2, outer * inner, r, s);
    Some([p + (foot + side), p + (foot - side)])
}

/// Intersects two circles in any number type, scaled; a miss within rounding counts as contact.
fn circles<N: Real>(p: Point<N>, r: N, q: Point<N>, s: N) -> Result<Vec<Point<N>>, Miss> {
    let d = q - p;
    // Scaled by a power of two so that squares of very small or large lengths neither vanish nor
    // overflow.
    let k = power_of_two_scale(r.approx().max(s.approx()).max(d.approx().norm()));
    let (up, back) = (N::from_f64(k), N::from_f64(1.0 / k));
    let (d, r, s) = (d * up, r * up, s * up);
    let d2 = d.norm2();
    if d2.approx() == 0.0 {
        return Err(Miss::Parallel((r - s).approx().abs() / k));
    }
    let [outer, inner] = factors(d2, r, s);
    let terms = d2 + r * r + s * s;
    if misses(outer, terms) {
        return Err(Miss::TooFar((d2.sqrt() - (r + s)).approx() / k));
    }
    if misses(inner, terms) {
        return Err(Miss::TooNear(((r - s).approx().abs() - d2.approx().sqrt()) / k));
    }
    // The rounding of d affects d² − (r−s)²: for circles with nearly one centre by far less than
    // their squares.
    let close = N::from_f64(terms.approx().min(CLOSE * d2.approx().sqrt() * terms.approx().sqrt()));
    let m = touching(outer, terms) * touching(inner, close);
    let [foot, side] = chord(d, d2, m, r, s);
    // The point of contact of two circles has the radius as its distance from the centre; otherwise
    // the circles coincide within rounding, and meet everywhere.
    if m.approx() == 0.0 && (foot.approx().norm() - r.approx()).abs() > COINCIDE * r.approx() {
        return Err(Miss::Parallel((r - s).approx().abs() / k));
    }
    Ok(vec![p + (foot + side) * back, p + (foot - side) * back])
}

fn circle_line<N: Real>(c: Point<N>, r: N, q: Point<N>, t: Vec2<N>) -> Result<Vec<Point<N>>, Miss> {
    let k = power_of_two_scale(r.approx().max((q - c).approx().norm()));
    let (up, back) = (N::from_f64(k), N::from_f64(1.0 / k));
    let e = (q - c) * up;
    let r = r * up;
    let b = e.dot(t);
    let h = t.cross(e);
    let outer = (r - h) * (r + h);
    let terms = r * r + h * h;
    if misses(outer, terms) {
        return Err(Miss::TooFar((h.approx().abs() - r.approx()) / k));
    }
    let w = touching(outer, terms).sqrt_or_zero();
    let foot = q - t * (b * back);
    Ok(vec![foot + t * (w * back), foot - t * (w * back)])
}

/// Turns a lever about its pivot until its slot meets the pin.
///
/// In the lever's frame: pivot `d`, slot along the unit vector `t` through `q`. `to_pin` is the
/// vector from the pivot to the pin in the plane. Returns, for each closure, the position of the
/// pin in the lever's frame: first the one further along the slot's direction.
pub fn lever<N: Real>(
    d: Point<N>,
    q: Point<N>,
    t: Vec2<N>,
    to_pin: Vec2<N>,
) -> Result<Vec<Point<N>>, Miss> {
    circle_line(d, to_pin.norm(), q, t)
}

/// Returns 2^−e with e the binary exponent of `x`, so that the product with `x` is in [1, 2); 1 for
/// zero and non-finite values.
pub fn power_of_two_scale(x: f64) -> f64 {
    if !(x.is_normal()) {
        return 1.0;
    }
    let (_, e) = libm::frexp(x);
    libm::ldexp(1.0, (1 - e).clamp(-1000, 1000))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn circle(x: f64, y: f64, r: f64) -> Locus {
        Locus::Circle { centre: Point::new(x, y), radius: r }
    }

    #[test]
    fn three_four_five() {
        let two = meet(circle(0.0, 0.0, 4.0), circle(5.0, 0.0, 3.0)).unwrap();
        assert!((two[0] - Point::new(3.2, 2.4)).norm() < 1e-15);
        assert!((two[1] - Point::new(3.2, -2.4)).norm() < 1e-15);
    }

    #[test]
    fn touching_circles_are_not_a_miss() {
        let two = meet(circle(0.0, 0.0, 0.1), circle(0.3, 0.0, 0.2)).unwrap();
        assert!((two[0] - two[1]).norm() < 1e-8);
        assert_eq!(meet(circle(0.0, 0.0, 1.0), circle(5.0, 0.0, 3.0)), Err(Miss::TooFar(1.0)));
        assert_eq!(meet(circle(0.0, 0.0, 5.0), circle(1.0, 0.0, 1.0)), Err(Miss::TooNear(3.0)));
    }

    #[test]
    fn equal_circles_about_nearly_one_centre_meet_on_both_or_coincide() {
        for e in [-30, -36, -40, -44, -48] {
            let d = libm::ldexp(0.15, e);
            for p in meet(circle(0.0, 0.0, 0.15), circle(d, 0.0, 0.15)).unwrap_or_default() {
                assert!(
                    (p.to_vec2().norm() - 0.15).abs() < 1e-12 && p.y.abs() > 0.14,
                    "{e}: {p:?}"
                );
            }
        }
        assert!(meet(circle(0.0, 0.0, 0.15), circle(1e-13, 0.0, 0.15)).is_ok());
        assert!(matches!(
            meet(circle(0.0, 0.0, 0.15), circle(1e-18, 0.0, 0.15)),
            Err(Miss::Parallel(_))
        ));
    }

    #[test]
    fn circle_and_line_ahead_first() {
        let line = Locus::Line { through: Point::new(0.0, 3.0), direction: Vec2::new(1.0, 0.0) };
        assert_eq!(
            meet(circle(0.0, 0.0, 5.0), line).unwrap(),
            vec![Point::new(4.0, 3.0), Point::new(-4.0, 3.0)]
        );
    }

    #[test]
    fn scaling_by_a_power_of_two_changes_no_digit() {
        let one = meet(circle(0.1, 0.2, 0.7), circle(0.9, 0.3, 0.5)).unwrap();
        for e in [-300, -40, 40, 300] {
            let k = libm::ldexp(1.0, e);
            let two =
                meet(circle(0.1 * k, 0.2 * k, 0.7 * k), circle(0.9 * k, 0.3 * k, 0.5 * k)).unwrap();
            assert_eq!((one[0].x * k, one[0].y * k), (two[0].x, two[0].y));
        }
    }
}
