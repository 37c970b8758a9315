//! Every digit that `cam` prints of a cam over a whole turn is true: compared with formulas of
//! [`crate::cam_truth`] in 640-bit arithmetic, which take derivatives by differences and search for
//! extremes by themselves.
//!
//! `HODOGRAPH_SEEDS=10 HODOGRAPH_WIDE=1 cargo test --test random of_cams -- --nocapture`

use crate::cam_laws::ends;
use crate::cam_truth::{Branch, ByLaw, Cam, Follower, Profile, bottom, differences, slope, whole};
use crate::properties::seeds;
use crate::wide::every;
use hodograph::answer::AnswerValue;
use hodograph::cam::{CamExtreme, least_base};
use hodograph::certified::ladder::parts;
use hodograph::effort::truth::BITS;
use hodograph::number::{Ball, Big, Real, within};
use hodograph::report::cam::{CamNumber, Now, PrintedUnit, Report};
use hodograph::scene::{Kind, read};

const DIGITS: [usize; 3] = [4, 6, 12];
/// Values with a smaller relative difference are equal: one of several places is printed.
const EQUAL: f64 = 1e-9;
/// Smaller slopes count as zero.
const STILL: f64 = 1e-30;
/// The error of places of extremes.
const OFF: f64 = 1e-35;

/// A maximum: its place, its value, and whether it is reached there only.
struct Greatest {
    at: Big,
    value: Big,
    alone: bool,
}

/// The maximum of a function over some stages, at ends of pieces or where its slope passes through
/// zero.
fn greatest(
    law: &ByLaw,
    on: &dyn Fn(usize) -> bool,
    f: &dyn Fn(Branch, Big) -> Big,
) -> Option<Greatest> {
    const STEPS: usize = 24;
    let mut all: Vec<(Big, Big)> = Vec::new();
    let starts = law.starts();
    for (k, (name, _, over)) in law.stages.iter().enumerate().filter(|(k, _)| on(*k)) {
        let mut from = 0.0;
        for (part, end) in ends(name).iter().enumerate() {
            let at = |x: f64| starts[k] + Big::from_f64(x) * over.radians();
            let fall = |phi: Big| -f((k, part), phi);
            let places: Vec<Big> =
                (0..=STEPS).map(|i| at(from + (end - from) * i as f64 / STEPS as f64)).collect();
            all.extend([places[0], places[STEPS]].map(|phi| (phi, f((k, part), phi))));
            let slopes: Vec<f64> = places.iter().map(|phi| slope(&fall, *phi).approx()).collect();
            for i in 0..STEPS {
                // Differences of a constant are rounding.
                if slopes[i] < -STILL && slopes[i + 1] >= -STILL {
                    let phi = bottom(&fall, places[i], places[i + 1]);
                    all.push((phi, f((k, part), phi)));
                }
            }
            from = *end;
        }
    }
    let (at, value) = *all.iter().max_by(|a, b| a.1.approx().total_cmp(&b.1.approx()))?;
    let near = |x: Big, y: Big| (x - y).approx().abs() <= EQUAL * y.approx().abs().max(1e-9);
    let alone = all.iter().all(|(phi, x)| !near(*x, value) || (*phi - at).approx().abs() < 1e-9);
    Some(Greatest { at, value, alone })
}

/// Numbers with their true values in their printed unit.
type Told = Vec<(CamNumber, PrintedUnit, Big)>;

fn degrees(x: Big) -> Big {
    x * whole(180) / Big::pi()
}

/// True numbers of a cam by a law.
fn of_law(cam: &Cam, law: &ByLaw, seed: u64) -> Told {
    let flat = matches!(cam.follower, Follower::Face);
    let lift = if cam.swings() { degrees } else { |x: Big| x * whole(1000) };
    let omega = whole(3);
    let moving = |k: usize| !law.stages[k].0.is_empty();
    let mut all: Told = vec![(CamNumber::Base, PrintedUnit::Length, law.base * whole(1000))];
    let gain = if cam.swings() { law.stages[0].1.radians() } else { law.stages[0].1.metres() };
    all.push((CamNumber::Stroke, PrintedUnit::Lift(0), lift(gain)));
    for (k, (way, out)) in [(1, false), (0, true), (-1, false), (0, false)].into_iter().enumerate()
    {
        all.push((CamNumber::Phase(way, out), PrintedUnit::Degrees, law.stages[k].2.exact()));
        all.push((CamNumber::Start(k), PrintedUnit::Degrees, degrees(law.starts()[k])));
    }
    let mut extreme = |mark: CamExtreme,
                       unit: PrintedUnit,
                       found: Option<Greatest>,
                       value: &dyn Fn(Big) -> Big| {
        let Some(found) = found else { return };
        all.push((CamNumber::Most(mark), unit, value(found.value)));
        if found.alone {
            all.push((CamNumber::At(mark), PrintedUnit::Degrees, degrees(found.at)));
        }
    };
    for (k, sign) in [(0, whole(-1)), (1, whole(1))] {
        let of = |order: usize| {
            move |b: Branch, phi: Big| sign * differences(&|x| law.lift(b, x), phi)[order]
        };
        // A follower at rest has no velocity.
        extreme(CamExtreme::Rate(k), PrintedUnit::Lift(1), greatest(law, &moving, &of(0)), &|x| {
            sign * x * omega
        });
        extreme(CamExtreme::Bend(k), PrintedUnit::Lift(2), greatest(law, &moving, &of(1)), &|x| {
            sign * x * omega * omega
        });
        if !flat && seed.is_multiple_of(4) {
            let stage = 2 * k;
            let size = |b: Branch, phi: Big| {
                let x = law.bent(b, phi)[0];
                if x.approx() < 0.0 { -x } else { x }
            };
            extreme(
                CamExtreme::Pressure(k),
                PrintedUnit::Degrees,
                greatest(law, &|s| s == stage, &size),
                &degrees,
            );
        }
    }
    let turn = cam.turned();
    let branch = law.branch(turn.approx());
    let ([v, a], [pressure, rho]) =
        (differences(&|x| law.lift(branch, x), turn), law.bent(branch, turn));
    let way = law.sense() * omega;
    all.extend([
        (CamNumber::Now(Now::Phi), PrintedUnit::Degrees, degrees(turn)),
        (CamNumber::Now(Now::Lift(0)), PrintedUnit::Lift(0), lift(law.lift(branch, turn))),
        (CamNumber::Now(Now::Lift(1)), PrintedUnit::Lift(1), v * way),
        (CamNumber::Now(Now::Lift(2)), PrintedUnit::Lift(2), a * way * way),
        (CamNumber::Now(Now::Rho), PrintedUnit::Length, rho * whole(1000)),
    ]);
    if !flat {
        all.push((CamNumber::Now(Now::Pressure), PrintedUnit::Degrees, degrees(pressure)));
    }
    all
}

/// The base circle at which the least radius of the profile is zero, next to that in double
/// precision.
fn base_without_undercut(cam: &Cam, law: &ByLaw, near: f64) -> Big {
    let least = |base: Big| ByLaw { cam, stages: law.stages, base }.least();
    let mut x = [Big::from_f64(near * (1.0 + 1e-9)), Big::from_f64(near * (1.0 - 1e-9))];
    let mut y = x.map(least);
    for _ in 0..7 {
        let next = x[1] - y[1] * (x[1] - x[0]) / (y[1] - y[0]);
        if (next - x[1]).approx().abs() < 1e-40 {
            return next;
        }
        (x, y) = ([x[1], next], [y[1], least(next)]);
    }
    x[1]
}

#[test]
fn printed_digits_are_true_of_cams_over_a_turn() {
    let (mut scenes, mut printed, mut open, mut wrong, mut bases) = (0, 0, 0, Vec::new(), 0);
    for seed in seeds(80) {
        let cam = Cam::of(seed);
        let text = cam.text();
        let Ok(scene) = read(&text) else { continue };
        let scene = scene.value;
        let Some(turning) = &scene.cams[0].disc else { continue };
        let Profile::Law(stages) = &cam.profile else { continue };
        let survey = turning.survey.of(&turning.disc);
        let report = Report::new(&scene, &scene.cams[0], turning, survey);
        scenes += 1;
        within(BITS, || {
            let law = ByLaw { cam: &cam, stages, base: cam.base.metres() };
            let mut all = of_law(&cam, &law, seed);
            // An edge has no undercut: its least base circle is the one at which the follower just
            // reaches its cam.
            let edge = !matches!(cam.follower, Follower::Face) && cam.end.approx() == 0.0;
            if let Some(near) =
                (seed.is_multiple_of(16) && !edge).then(|| least_base(&turning.disc)).flatten()
            {
                all.push((
                    CamNumber::LeastBase,
                    PrintedUnit::Length,
                    base_without_undercut(&cam, &law, near) * whole(1000),
                ));
                bases += 1;
            }
            for (which, unit, truth) in all {
                let ball = Ball::new(truth, OFF * truth.approx().abs().max(1.0));
                let Ok(expected) = parts(Kind::Number, AnswerValue::Scalar(ball), 1.0, 6) else {
                    wrong.push(format!("seed {seed}: {which:?} has no true value\n{text}"));
                    continue;
                };
                let expected = &expected[0].1;
                for digits in DIGITS {
                    let Some(told) = report.told(which, unit, digits) else {
                        open += 1;
                        continue;
                    };
                    printed += 1;
                    let (truth, _) = expected
                        .text(digits)
                        .unwrap_or_else(|| (format!("{:e}", truth.approx()), 0));
                    if told != truth
                        && !(told == "0" && truth.parse::<f64>().is_ok_and(|x| x.abs() < 1e-20))
                    {
                        wrong.push(format!(
                            "seed {seed}: {which:?} is told {told}, it is {truth}\n{text}"
                        ));
                    }
                }
            }
        });
    }
    println!(
        "{scenes} cams over a turn, {printed} printed numbers against {BITS} bit: {} wrong; {open} without digits; {bases} base circles",
        wrong.len()
    );
    assert!(
        wrong.is_empty(),
        "{} are wrong, first {}",
        wrong.len(),
        wrong[..wrong.len().min(8)].join("\n")
    );
    assert!(
        printed >= 2000 / every(8) && open * 100 <= printed,
        "only {printed} numbers were compared, {open} had no digits"
    );
}
