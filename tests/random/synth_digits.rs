//! Every printed digit of a design is true: compared with closed formulas in 640-bit arithmetic
//! ([`crate::synth_truth`]).

use crate::properties::seeds;
use crate::rng::Rng;
use crate::synth_truth::{
    Task, body, cognates, crank_rocker, function, path, quick_return, two_positions,
};
use crate::wide::every;
use hodograph::answer::AnswerValue;
use hodograph::certified::ladder::parts;
use hodograph::effort::truth::BITS;
use hodograph::number::{Ball, Big, Real, within};
use hodograph::report::synthesis::value;
use hodograph::scene::{Book, Kind};
use hodograph::synthesis::candidate::DesignNumber;
use hodograph::synthesis::{read, solve};

/// A kind of tasks: its name, and one of them.
type Kinds = (&'static str, fn(&mut Rng) -> Task);

/// Digits of printed designs.
const DIGITS: usize = 6;
/// A candidate is identified by numbers with a smaller relative difference than this.
const NEAR: f64 = 1e-7;

/// The printed and the true number, without unit and sign.
fn texts(book: &Book, n: &DesignNumber, truth: Big) -> Option<[String; 2]> {
    let printed = value(book, n);
    // From 10 m on metres are printed, with four digits.
    if printed.ends_with(" m") {
        return None;
    }
    let bare = printed
        .trim_end_matches('°')
        .trim_end_matches(" mm")
        .trim_start_matches(['-', '−'])
        .to_owned();
    // A difference of 10⁻⁹ of its terms or less is zero, or has no digit.
    let truth = match n.kind {
        Some(Kind::Length) => truth * Big::from_f64(1000.0),
        Some(Kind::Angle) => truth * Big::from_f64(180.0) / Big::pi(),
        _ => truth,
    };
    let ball = Ball::new(truth, 1e-60);
    let all = parts(Kind::Number, AnswerValue::Scalar(ball), 0.0, DIGITS).ok()?;
    let (text, _) = all[0].1.text(DIGITS).unwrap_or_else(|| ("0".into(), DIGITS));
    Some([bare, text.trim_start_matches(['-', '−']).to_owned()])
}

/// True if a number is midway between two values of the last digit, one of which is printed.
fn is_a_half(told: &str, truth: &str) -> bool {
    let decimals = told.split_once('.').map_or(0, |(_, d)| d.len() as i32);
    let off =
        (told.parse::<f64>().unwrap() - truth.parse::<f64>().unwrap()).abs() * 10f64.powi(decimals);
    truth.len() > told.len() && (off - 0.5).abs() < 1e-6
}

#[test]
fn printed_digits_are_true_of_designs() {
    let kinds: [Kinds; 7] = [
        ("body", body),
        ("two positions", two_positions),
        ("path", path),
        ("function", function),
        ("cognates", cognates),
        ("crank-rocker", crank_rocker),
        ("quick return", quick_return),
    ];
    let (mut printed, mut open, mut wrong, mut by) =
        (0, 0, Vec::new(), std::collections::BTreeMap::<&str, usize>::new());
    for seed in seeds(30) {
        for (name, make) in kinds {
            let task = make(&mut Rng::new(seed + 5));
            let read = read(task.text.as_bytes())
                .unwrap_or_else(|f| panic!("{name} {seed}: {f}\n{}", task.text))
                .value;
            let Ok(design) = solve(&read) else {
                open += 1;
                continue;
            };
            within(BITS, || {
                let truths = (task.truth)();
                for c in &design.candidates {
                    let of = |truth: &[(String, Big)]| -> Vec<(DesignNumber, Big)> {
                        let find = |(name, x): &(String, Big)| {
                            let all = c.draft.numbers.iter().chain(&design.numbers);
                            Some((all.clone().find(|n| n.name == *name)?.clone(), *x))
                        };
                        truth.iter().filter_map(find).collect()
                    };
                    let far = |pairs: &[(DesignNumber, Big)]| {
                        let off = |(n, x): &(DesignNumber, Big)| {
                            (n.value.abs() - x.approx().abs()).abs() / x.approx().abs().max(1e-3)
                        };
                        pairs.iter().map(off).fold(0.0, f64::max)
                    };
                    let best =
                        truths.iter().map(|t| of(t)).min_by(|a, b| far(a).total_cmp(&far(b)));
                    let Some(pairs) = best.filter(|p| !p.is_empty()) else { continue };
                    if far(&pairs) > NEAR {
                        wrong.push(format!(
                            "{name} {seed}: candidate {} is none of the true ones\n{}",
                            c.draft.which.en, task.text
                        ));
                        continue;
                    }
                    for (n, x) in pairs {
                        let Some([told, truth]) = texts(&read.book, &n, x) else { continue };
                        printed += 1;
                        *by.entry(name).or_default() += 1;
                        if told != truth && !is_a_half(&told, &truth) {
                            wrong.push(format!(
                                "{name} {seed}: {} is printed {told}, it is {truth}\n{}",
                                n.name, task.text
                            ));
                        }
                    }
                }
            });
        }
    }
    println!(
        "designs: {printed} printed numbers against {BITS} bit: {} wrong; {open} tasks without a design; {by:?}",
        wrong.len()
    );
    assert!(
        wrong.is_empty(),
        "{} are wrong, first {}",
        wrong.len(),
        wrong[..wrong.len().min(3)].join("\n")
    );
    assert!(printed >= 1000 / every(8), "only {printed} numbers were compared");
}
