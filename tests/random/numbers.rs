//! The kinds of number: a result ball contains the result of every point of its operands and is
//! hardly wider; plain numbers of every length agree. The reference is 300-bit arithmetic on single
//! points.

use crate::rng::Rng;
use hodograph::number::ball::{Ball, Middle};
use hodograph::number::decimal::{Certain, Enclosure};
use hodograph::number::{Big, Dd, Real, within};

/// Both ends and the middle of a ball.
fn points((mid, radius): (f64, f64)) -> [f64; 3] {
    [mid, mid - radius, mid + radius]
}

/// Real power, logarithm and exponential: only balls with a fixed precision have them, and
/// double-double has none.
const TRANSCENDENT: [&str; 3] = ["x^y", "ln x", "eˣ"];

type Operation<N> = (&'static str, fn(N, N) -> N);

/// Operations on two positive numbers well away from zero.
fn operations<N: Real>() -> Vec<Operation<N>> {
    vec![
        ("x + y", |x, y| x + y),
        ("x - y", |x, y| x - y),
        ("-x", |x, _| -x),
        ("x y", |x, y| x * y),
        ("x / y", |x, y| x / y),
        ("√x", |x, _| x.sqrt()),
        ("√(x² + y²)", |x, y| x.hypot(y)),
        ("atan2(x, y)", |x, y| x.atan2(y)),
        ("atan2(-y, -x)", |x, y| (-y).atan2(-x)),
        ("sin x", |x, _| x.sin_cos().0),
        ("cos x", |x, _| x.sin_cos().1),
        ("sin x°", |x, _| x.sin_cos_degrees().0),
        ("cos x°", |x, _| x.sin_cos_degrees().1),
        ("x³", |x, _| x.pow(N::from_f64(3.0))),
        ("x⁻²", |x, _| x.pow(N::from_f64(-2.0))),
        (TRANSCENDENT[0], |x, y| x.pow(y)),
        (TRANSCENDENT[1], |x, _| x.ln()),
        (TRANSCENDENT[2], |x, _| x.exp()),
    ]
}

/// Pairs of balls as (middle, radius), wide and narrow, none containing zero. Their ends are `f64`
/// numbers.
fn pairs(seed: u64, count: usize) -> Vec<[(f64, f64); 2]> {
    let mut rng = Rng::new(seed);
    let mut one = |k: usize| {
        let mid = f64::from(rng.between(0.3, 3.0) as f32);
        (
            mid,
            mid * [0.0, 0.875, 0.5, 0.0625, 0.5f64.powi(13), 0.5f64.powi(21), 0.5f64.powi(27)]
                [k % 7],
        )
    };
    (0..count).map(|k| [one(k), one(k / 7)]).collect()
}

/// The results of an operation on single points of two balls: an almost exact interval for each
/// pair of points.
fn truths(
    operation: fn(Ball<Big>, Ball<Big>) -> Ball<Big>,
    [x, y]: [(f64, f64); 2],
) -> Vec<Enclosure> {
    within(300, || {
        let number = |x: f64| Ball::exact(Big::from_f64(x));
        let all = points(x).into_iter().flat_map(|p| points(y).map(|q| (p, q)));
        all.map(|(p, q)| operation(number(p), number(q)).enclosure().expect("points have a value"))
            .collect()
    })
}

fn contains<M: Middle>(
    kind: &str,
    (name, operation): Operation<Ball<M>>,
    [x, y]: [(f64, f64); 2],
    truths: &[Enclosure],
) where
    Ball<M>: Certain,
{
    let ball = |(mid, radius): (f64, f64)| Ball::new(M::from_f64(mid), radius);
    let Some(seen) = operation(ball(x), ball(y)).enclosure() else {
        let may =
            ["x⁻²", "atan2(x, y)", "atan2(-y, -x)"].contains(&name) || TRANSCENDENT.contains(&name);
        return assert!(may, "{kind}: {name} is undecided on {x:?}, {y:?}");
    };
    for truth in truths {
        assert!(
            seen.meets(truth),
            "{kind}: {name} on {x:?}, {y:?} is {seen:?}, but {truth:?} at a point"
        );
    }
    let narrow = |(mid, radius): (f64, f64)| radius <= 0.06 * mid;
    if narrow(x) && narrow(y) {
        // For narrow balls the bound is of first order, which the corners show; at an extreme of a
        // sine they show nothing.
        let spread = truths.iter().map(|t| (t.approx - seen.approx).abs()).fold(0.0, f64::max);
        let turned = if name.contains("sin") || name.contains("cos") { 2.0 * x.1 } else { 0.0 };
        let most = 8.0 * spread + turned + 1e-14 * (1.0 + seen.approx.abs());
        assert!(
            seen.radius <= most,
            "{kind}: {name} on {x:?}, {y:?} is wide: {seen:?}, where points spread by {spread:e}"
        );
    }
}

/// Wide operands too: they reveal results that hold to first order only.
#[test]
fn what_is_inside_the_operands_is_inside_the_result() {
    for pair in pairs(7, 98) {
        for (k, (_, operation)) in operations().into_iter().enumerate() {
            let truths = truths(operation, pair);
            contains::<f64>("f64", operations()[k], pair, &truths);
            contains::<Dd>("double-double", operations()[k], pair, &truths);
            within(120, || contains::<Big>("long", operations()[k], pair, &truths));
        }
    }
}

/// Balls that reach zero, including those that only touch it, give no quotient and no angle, and a
/// root that reaches down to zero; a ball entirely below zero is recognised as such.
#[test]
fn balls_that_reach_zero() {
    fn check<M: Middle>(kind: &str)
    where
        Ball<M>: Certain,
    {
        let ball = |mid: f64, radius: f64| Ball::new(M::from_f64(mid), radius);
        let one = ball(1.0, 0.0);
        for size in [1e-30, 1e-3, 1.0, 3.7, 1e20] {
            for part in [1.0, 1.5, 40.0] {
                for sign in [-1.0, 1.0] {
                    let reaching = ball(sign * size, part * size);
                    assert!(
                        reaching.contains_zero() && !reaching.is_surely_negative(),
                        "{kind}: {reaching:?}"
                    );
                    assert!(
                        !(one / reaching).is_decided(),
                        "{kind}: 1/{reaching:?} is {:?}",
                        one / reaching
                    );
                    assert!(
                        !reaching.atan2(ball(0.0, size)).is_decided(),
                        "{kind}: the angle of {reaching:?}"
                    );
                    let upper = sign * size + part * size;
                    let root = reaching
                        .sqrt()
                        .enclosure()
                        .unwrap_or_else(|| panic!("{kind}: √{reaching:?}"));
                    for inside in [0.0, 0.5 * upper, upper] {
                        let truth =
                            within(300, || Ball::exact(Big::from_f64(inside)).sqrt().enclosure())
                                .expect("a root");
                        assert!(
                            root.meets(&truth),
                            "{kind}: the root of {reaching:?} is {root:?}, without that of {inside:e}"
                        );
                    }
                    assert!(
                        root.largest() >= upper.sqrt(),
                        "{kind}: {root:?} reaches no farther than {:e}",
                        root.largest()
                    );
                    assert!(
                        root.largest() <= 1.001 * upper.sqrt() + 1e-280,
                        "{kind}: the root of {reaching:?} is wide: {root:?}"
                    );
                }
            }
            for radius in [0.0, 1e-9 * size, 0.999 * size] {
                assert!(
                    ball(-size, radius).is_surely_negative()
                        && !ball(size, radius).is_surely_negative(),
                    "{kind}: ±{size:e}, {radius:e}"
                );
                assert!(
                    !ball(-size, radius).sqrt().is_decided(),
                    "{kind}: √ of {size:e} below zero"
                );
            }
        }
        for (mid, radius, by) in [(1.0, 0.0, 0.25), (-2.0, 0.5, 1e-3), (3.0, 1e-12, 1e-12)] {
            let wider = ball(mid, radius).widened(by);
            assert_eq!(wider.middle().approx(), mid);
            let exact = radius + by;
            assert!(
                wider.radius() >= exact && wider.radius() <= exact * (1.0 + 1e-14),
                "{kind}: {wider:?} is not {by:e} wider than {radius:e}"
            );
        }
    }
    check::<f64>("f64");
    check::<Dd>("double-double");
    within(150, || check::<Big>("long"));
}

/// Exact where the value is a binary fraction, and enclosed slightly beside it, after any number of
/// turns.
#[test]
fn sines_at_special_angles_and_a_hair_beside_them() {
    fn exact<N: Certain>(kind: &str) {
        for turns in [0, 1, -1, 1000, -123_456] {
            for quarter in 0..4 {
                let at = f64::from(turns) * 360.0 + 90.0 * f64::from(quarter);
                let (s, c) = N::from_f64(at).sin_cos_degrees();
                let right = [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)][quarter as usize];
                assert_eq!(
                    ((s.approx(), s.radius()), (c.approx(), c.radius())),
                    ((right.0, 0.0), (right.1, 0.0)),
                    "{kind}: {at}°"
                );
                // The sine of 30° plus a whole number of half turns is a half, or the cosine.
                for off in [-60.0, -30.0, 30.0, 60.0] {
                    let (s, c) = N::from_f64(at + off).sin_cos_degrees();
                    let halves = [s, c]
                        .into_iter()
                        .filter(|x| x.approx().abs() == 0.5 && x.radius() == 0.0)
                        .count();
                    assert_eq!(halves, 1, "{kind}: {}°: {s:?}, {c:?}", at + off);
                }
            }
        }
    }
    fn beside<N: Certain>(text: &str) -> [Option<Enclosure>; 2] {
        let (s, c) = N::from_decimal(text).sin_cos_degrees();
        [s.enclosure(), c.enclosure()]
    }
    exact::<Ball<f64>>("f64");
    exact::<Ball<Dd>>("double-double");
    within(150, || exact::<Ball<Big>>("long"));
    for degrees in [0, 30, 45, 60, 90, 120, 135, 225, 300, 315, 330, 390, 405] {
        for zeros in 0..28 {
            let text = format!("{degrees}.{}1", "0".repeat(zeros));
            let truth = within(400, || {
                let x = Ball::<Big>::from_decimal(&text) * Real::pi() / Ball::from_f64(180.0);
                let (s, c) = x.sin_cos();
                [s.enclosure(), c.enclosure()]
            });
            for (kind, seen) in [
                ("f64", beside::<Ball<f64>>(&text)),
                ("double-double", beside::<Ball<Dd>>(&text)),
                ("long", within(150, || beside::<Ball<Big>>(&text))),
            ] {
                for (what, (seen, truth)) in ["sine", "cosine"].iter().zip(seen.iter().zip(&truth))
                {
                    let (seen, truth) =
                        (seen.as_ref().expect("decided"), truth.as_ref().expect("decided"));
                    assert!(
                        seen.meets(truth),
                        "{kind}: the {what} of {text}° is {seen:?}, not {truth:?}"
                    );
                }
            }
        }
    }
}

/// Any decimal is enclosed: zeros in all their spellings, numbers at the ends of the range of
/// `f64`.
#[test]
fn decimals_are_inside_what_is_read_of_them() {
    fn read<N: Certain>(text: &str) -> Option<Enclosure> {
        N::from_decimal(text).enclosure()
    }
    for text in [
        "0",
        "0.0",
        "0.000",
        "0e9",
        "1e-300",
        "0.1",
        "123456789012345",
        "1234567890123456",
        "0.3e-7",
        "17e300",
    ] {
        let truth = within(400, || read::<Ball<Big>>(text)).expect("a decimal has a value");
        for (kind, seen) in [
            ("f64", read::<Ball<f64>>(text)),
            ("double-double", read::<Ball<Dd>>(text)),
            ("long", within(150, || read::<Ball<Big>>(text))),
        ] {
            let seen = seen.unwrap_or_else(|| panic!("{kind}: {text} is undecided"));
            assert!(
                seen.radius >= 0.0 && seen.meets(&truth),
                "{kind}: {text} is {seen:?}, not {truth:?}"
            );
        }
    }
}

/// Single, double and long numbers without error bounds give the same value to their last digits.
#[test]
fn plain_numbers_of_every_length_say_the_same() {
    fn all<N: Real>(x: f64, y: f64) -> Vec<f64> {
        let (a, b) = (N::from_f64(x), N::from_f64(y));
        let mut out: Vec<f64> = operations::<N>().iter().map(|(_, f)| f(a, b).approx()).collect();
        out.extend(
            [
                a,
                N::pi(),
                (-a).sqrt_or_zero(),
                a.sqrt_or_zero(),
                N::from_decimal("0.3125"),
                N::from_decimal("17e-1"),
            ]
            .map(N::approx),
        );
        out
    }
    for [x, y] in pairs(11, 200) {
        let long = within(200, || all::<Big>(x.0, y.0));
        for (kind, unit, seen) in [
            ("f32", f64::from(f32::EPSILON), all::<f32>(x.0, y.0)),
            ("f64", f64::EPSILON, all::<f64>(x.0, y.0)),
            ("double-double", f64::EPSILON, all::<Dd>(x.0, y.0)),
        ] {
            for (k, (seen, truth)) in seen.iter().zip(&long).enumerate() {
                let none = kind == "double-double"
                    && operations::<f64>().get(k).is_some_and(|o| TRANSCENDENT.contains(&o.0));
                assert!(
                    none || (seen - truth).abs() <= 16.0 * unit * (1.0 + truth.abs()),
                    "{kind}: value {k} of {}, {} is {seen:e}, not {truth:e}",
                    x.0,
                    y.0
                );
            }
        }
        for bounded in [f32::from_bounded(x.0, 1e-9).map(f64::from), f64::from_bounded(x.0, 1e-9)] {
            assert!(
                (bounded.expect("plain numbers take any bound") - x.0).abs()
                    <= f64::from(f32::EPSILON) * x.0
            );
        }
    }
}
