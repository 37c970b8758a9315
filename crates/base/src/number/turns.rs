//! Tests of sine and cosine of extremely large angles, in every kind of number, against an exact
//! reduction of their decimals.

use super::ball::Ball;
use super::decimal::{Certain, Enclosure};
use super::{Big, Dd, Real, within};

/// Removes whole turns from a decimal by long division by 360, for any number of digits.
fn less_turns(decimal: &str) -> String {
    let (sign, digits) = decimal.strip_prefix('-').map_or(("", decimal), |d| ("-", d));
    let (whole, broken) = digits.split_once('.').unwrap_or((digits, "0"));
    let rest = whole.bytes().fold(0u32, |rest, b| (10 * rest + u32::from(b - b'0')) % 360);
    format!("{sign}{rest}.{broken}")
}

fn number<N: Real>(text: &str) -> N {
    text.strip_prefix('-').map_or_else(|| N::from_decimal(text), |t| -N::from_decimal(t))
}

fn enclosures<N: Certain>((s, c): (N, N)) -> [Option<Enclosure>; 2] {
    [s.enclosure(), c.enclosure()]
}

/// Returns the results of every level of the ladder for a text.
fn rungs(text: &str, degrees: bool) -> Vec<(String, [Option<Enclosure>; 2])> {
    fn of<N: Certain>(text: &str, degrees: bool) -> [Option<Enclosure>; 2] {
        let x: N = number(text);
        enclosures(if degrees { x.sin_cos_degrees() } else { x.sin_cos() })
    }
    let mut all = vec![
        ("f64".to_string(), of::<Ball<f64>>(text, degrees)),
        ("double-double".to_string(), of::<Ball<Dd>>(text, degrees)),
    ];
    for bits in [192, 384, 768] {
        all.push((format!("{bits} bit"), within(bits, || of::<Ball<Big>>(text, degrees))));
    }
    all
}

struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0 >> 11
    }

    fn decimal(&mut self, whole: u64, broken: u64) -> String {
        let sign = if self.next().is_multiple_of(2) { "-" } else { "" };
        let mut digits = |n: u64| {
            (0..n).map(|_| char::from(b'0' + (self.next() % 10) as u8)).collect::<String>()
        };
        let first = format!("{sign}1{}", digits(whole));
        if broken == 0 { first } else { format!("{first}.{}", digits(broken)) }
    }
}

fn check(text: &str, degrees: bool, truth: &[Option<Enclosure>; 2]) {
    for (rung, seen) in rungs(text, degrees) {
        for (what, (seen, truth)) in ["sine", "cosine"].into_iter().zip(seen.iter().zip(truth)) {
            let truth = truth.as_ref().expect("the reference has a value");
            // An undecided result is no failure; an enclosure without the true value is.
            if let Some(seen) = seen {
                assert!(
                    seen.meets(truth),
                    "{rung}: the {what} of {text} is said to be {seen:?}, it is {truth:?}"
                );
            }
        }
    }
}

#[test]
fn degrees_are_reduced_as_they_are_written() {
    assert_eq!(less_turns("108000000000002550"), "30.0");
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let mut texts: Vec<String> = vec![
        "108000000000002550".into(),
        format!("36{}30", "0".repeat(60)),
        format!("-36{}45.0", "0".repeat(30)),
    ];
    for whole in 0..80 {
        for broken in [0, 1, 9, 40] {
            texts.push(random.decimal(whole, broken));
        }
    }
    for text in texts {
        let truth =
            within(1200, || enclosures(number::<Ball<Big>>(&less_turns(&text)).sin_cos_degrees()));
        check(&text, true, &truth);
        // The longest numbers hold all its digits.
        let longest = rungs(&text, true).pop().unwrap().1;
        assert!(
            longest.iter().all(|e| e.as_ref().is_some_and(|e| e.radius < 1e-60)),
            "{text}: {longest:?}"
        );
    }
}

#[test]
fn large_radians_are_known_or_not_said() {
    let mut random = Random(0x1234_5678_9abc_def1);
    for whole in 0..90 {
        for broken in [0, 6, 30] {
            let text = random.decimal(whole, broken);
            let truth = within(2000, || enclosures(number::<Ball<Big>>(&text).sin_cos()));
            check(&text, false, &truth);
        }
    }
}
