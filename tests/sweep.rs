//! Sweeps: each row agrees with `solve`, and its rates with differences of neighbouring positions.

#[path = "sweep/class_iv.rs"]
mod class_iv;
#[path = "sweep/long.rs"]
mod long;
#[path = "sweep/strokes.rs"]
mod strokes;
mod wide;

use class_iv::class_iv;
use hodograph::analytic;
use hodograph::answer::evaluate;
use hodograph::diag::Diagnostic;
use hodograph::digits::significant;
use hodograph::mechanism::{Demand, Mechanism};
use hodograph::position;
use hodograph::scene::{Angle, DriverKind, Lang, Scene, edit, read, templates};
use hodograph::scene::{driver_position, with_driver_at};
use hodograph::sweep::batch::{Batch, Block, ParameterChoice};
use hodograph::sweep::pieces::gather;
use hodograph::sweep::vary::{Variation, Varied};
use hodograph::sweep::{self, PlacedScene, Stations, Sweep, Table, Width, extreme, station};
use long::{pieces, same_bits};
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use wide::every;

fn scene(name: &str, find: &[&str]) -> Scene {
    let text = templates::get(name).unwrap();
    let text = if find.is_empty() { text.to_owned() } else { edit::with_find(text, find).unwrap() };
    read(&text).unwrap_or_else(|f| panic!("{name}: {f}")).value
}

/// Stations about the instant: a turn, or a tenth of the size to either side.
fn stations(placed: &PlacedScene, steps: usize) -> Stations {
    let now = station::position_now(placed.scene, &placed.at, 0);
    let per_value = station::angle_per_value(placed.scene, &placed.at, 0);
    match placed.scene.drivers[0].kind {
        DriverKind::Turn { .. } => {
            Stations::slid(now, now + std::f64::consts::TAU, steps, per_value)
        }
        _ => {
            let reach = 0.1 * placed.at.extent();
            Stations::slid(now - reach, now + reach, steps, per_value)
        }
    }
}

fn swept(scene: &Scene, m: &Mechanism, steps: usize, width: Width) -> (Table, Stations) {
    let placed = PlacedScene::new(scene, m).unwrap();
    let stations = stations(&placed, steps);
    (sweep::run(&placed, 0, &stations, width).unwrap(), stations)
}

/// Every question, so that every operation is compiled: the template's, all points, all links.
fn everything(name: &str) -> Scene {
    let plain = scene(name, &[]);
    let mut find: Vec<String> = plain.find.iter().map(|f| f.text.clone()).collect();
    for p in &plain.points {
        find.extend(["x", "y", "v", "a"].iter().map(|q| format!("{q}_{}", p.name)));
    }
    for l in plain.links.iter().filter(|l| l.name != plain.link_name(plain.ground)) {
        find.extend(["phi", "omega", "alpha"].iter().map(|q| format!("{q}_{}", l.name)));
    }
    find.sort();
    find.dedup();
    find.retain(|f| read(edit::with_find(templates::get(name).unwrap(), &[f]).unwrap()).is_ok());
    scene(name, &find.iter().map(String::as_str).collect::<Vec<_>>())
}

/// The size of a column's kind: its largest number, or the drivers' motion at the mechanism's size.
fn size(table: &Table, unit: &str, scene: &Scene, extent: f64) -> f64 {
    let rate = scene.drivers.iter().map(|d| match d.kind {
        DriverKind::Turn { .. } => d.rate.value.abs(),
        _ => d.rate.value.abs() / extent,
    });
    let rate = rate.fold(0.0f64, f64::max);
    let floor = match unit {
        "m" => extent,
        "m/s" => extent * rate,
        "m/s²" => extent * rate * rate,
        "rad/s" => rate,
        "rad/s²" => rate * rate,
        _ => 1.0,
    };
    table.columns[1..]
        .iter()
        .filter(|o| o.unit == unit)
        .flat_map(|o| &o.values)
        .fold(floor, |a, b| a.max(b.abs()))
}

/// The answers of the loop equations at one driver value, on the closures of the instant; `None` if
/// the pose is singular, or nearly: the effect of rounding there is not tested.
fn solved(scene: &Scene, m: &Mechanism, value: f64) -> Option<(Vec<f64>, f64)> {
    let demand = Demand::of(scene, m);
    let meant = position::configure(scene, m, &demand).unwrap().value;
    let there = with_driver_at(scene, 0, value);
    let at = position::recompute::<f64>(&there, m, &demand, &meant).ok()?;
    let solution = analytic::solve(&there, m, &at, &demand).ok()?;
    let mut row = Vec::new();
    for f in &scene.find {
        row.extend(evaluate(&there, &at, &solution, &f.what)?.columns());
    }
    Some((row, solution.condition))
}

/// True with kept cams (see `tests/says`) or groups above class II (tested by differences).
fn followed(scene: &Scene, m: &Mechanism) -> bool {
    scene.kept_cams().next().is_some()
        || m.groups.iter().any(|g| g.class().is_some_and(|c| c != "II"))
}

#[test]
fn every_row_is_what_the_single_solution_says() {
    let (mut rows, mut worst) = (0, (0.0f64, String::new()));
    for t in templates::list() {
        let scene = everything(t.name);
        let m = Mechanism::new(&scene).unwrap().value;
        // Parallelograms pass smoothly through change points, unlike the named side.
        if followed(&scene, &m)
            || driver_position(&scene, 0).is_none()
            || ["parallelogram", "third-crank"].contains(&t.name)
        {
            continue;
        }
        let (table, stations) = swept(&scene, &m, 96 / every(8), Width::Widest);
        let extent = PlacedScene::new(&scene, &m).unwrap().at.extent();
        let mut there = 0;
        for value in &stations.values {
            let expected = solved(&scene, &m, *value);
            let row = table.columns[0].values.iter().position(|v| v == value);
            let Some((expected, condition)) = expected else {
                assert!(row.is_none(), "{}: a row at {value} that cannot be solved", t.name);
                continue;
            };
            let row =
                row.unwrap_or_else(|| panic!("{}: no row at {value}: {:?}", t.name, table.notes));
            there += 1;
            for (c, e) in table.columns[1..].iter().zip(expected) {
                let off = (c.values[row] - e).abs();
                let off = if c.unit == "rad" {
                    off.min((off - std::f64::consts::TAU).abs())
                } else {
                    off
                };
                let off = if off == 0.0 {
                    0.0
                } else {
                    off / size(&table, c.unit, &scene, extent) / (condition * 1e-3).max(1.0)
                };
                if off > worst.0 {
                    worst = (off, format!("{} {} at {value}", t.name, c.name));
                }
                assert!(
                    off < 1e-12,
                    "{} {} at {value}: {} against {e} ({off:e}, condition {condition:.0})",
                    t.name,
                    c.name,
                    c.values[row]
                );
            }
        }
        assert_eq!(there, table.rows(), "{}", t.name);
        rows += there;
    }
    println!("{rows} rows, worst {:.1e}: {}", worst.0, worst.1);
    assert!(rows > 2000 / every(8));
}

#[test]
fn one_at_a_time_and_four_give_the_same_bits() {
    for t in templates::list().iter().step_by(every(2)) {
        let scene = everything(t.name);
        let m = Mechanism::new(&scene).unwrap().value;
        let (four, _) = swept(&scene, &m, 1500 / every(8), Width::Widest);
        let (one, _) = swept(&scene, &m, 1500 / every(8), Width::One);
        assert_eq!(four.notes, one.notes, "{}", t.name);
        for (a, b) in four.columns.iter().zip(&one.columns) {
            let same = a.values.len() == b.values.len()
                && a.values.iter().zip(&b.values).all(|(x, y)| x.to_bits() == y.to_bits());
            assert!(same, "{} {}", t.name, a.name);
        }
    }
}

#[test]
fn rates_are_the_slopes_of_the_columns() {
    let mut checked = 0;
    for t in templates::list() {
        let scene = everything(t.name);
        let m = Mechanism::new(&scene).unwrap().value;
        let placed = PlacedScene::new(&scene, &m).unwrap();
        let now = station::position_now(&scene, &placed.at, 0);
        let step = 1e-5
            * if matches!(scene.drivers[0].kind, DriverKind::Turn { .. }) {
                1.0
            } else {
                placed.at.extent()
            };
        if scene.drivers.len() > 1 || scene.cams.iter().any(|c| c.radii.is_empty()) {
            continue; // The arc that replaces a cam by a law, which gives no radii, is another one at each position.
        }
        let values: Vec<f64> = (-40..40)
            .step_by(every(8))
            .flat_map(|k| {
                (-2..=2).map(move |i| now + 2000.0 * step * f64::from(k) + step * f64::from(i))
            })
            .collect();
        let stations =
            Stations::of_values(values.clone(), station::angle_per_value(&scene, &placed.at, 0));
        let table = sweep::run(&placed, 0, &stations, Width::Widest).unwrap();
        let rate = scene.drivers[0].rate.value;
        let acceleration = scene.drivers[0].acceleration.as_ref().map_or(0.0, |a| a.value);
        let pairs: Vec<(String, String, String)> = scene
            .points
            .iter()
            .flat_map(|p| {
                ["x", "y"].map(|c| {
                    (
                        format!("{c}_{}", p.name),
                        format!("v_{}.{c}", p.name),
                        format!("a_{}.{c}", p.name),
                    )
                })
            })
            .chain(scene.links.iter().map(|l| {
                (
                    format!("phi_{}", l.name),
                    format!("omega_{}", l.name),
                    format!("alpha_{}", l.name),
                )
            }))
            .collect();
        for (s, v, a) in pairs {
            let (Some(s), Some(v), Some(a)) =
                (table.column(&s), table.column(&v), table.column(&a))
            else {
                continue;
            };
            let largest = |c: &sweep::Column| size(&table, c.unit, &scene, placed.at.extent());
            for first in 0..table.rows().saturating_sub(4) {
                let at = |i: usize| table.columns[0].values[first + i];
                if (at(4) - at(0) - 4.0 * step).abs() > 0.1 * step {
                    continue;
                }
                let slope = |c: &sweep::Column, k: usize| {
                    let (before, after) = (c.values[first + 2 - k], c.values[first + 2 + k]);
                    let turned = if c.unit == "rad" {
                        libm::rint((after - before) / std::f64::consts::TAU) * std::f64::consts::TAU
                    } else {
                        0.0
                    };
                    (after - before - turned) / (2.0 * k as f64 * step) * rate
                };
                // a = dv/dx ẋ, the rate itself changing with the driver's own acceleration: v/ẋ is
                // a function of x alone.
                let expected = [
                    v.values[first + 2],
                    a.values[first + 2] - v.values[first + 2] * acceleration / rate,
                ];
                for ((of, is), expected) in [(s, v), (v, a)].into_iter().zip(expected) {
                    // If the two differ, the function is curved too strongly, next to a limit.
                    let (one, two) = (slope(of, 1), slope(of, 2));
                    let off = ((4.0 * one - two) / 3.0 - expected).abs() / largest(is);
                    let allowed = 1e-7 + (one - two).abs() / largest(is);
                    assert!(
                        off < allowed,
                        "{} {} at {}: {one}, {two} against {expected}",
                        t.name,
                        is.name,
                        at(2)
                    );
                }
                checked += 1;
            }
        }
    }
    println!("{checked} slopes");
    assert!(checked > 10_000 / every(8));
}

#[test]
fn a_parallelogram_stays_one() {
    let scene = scene("parallelogram", &["omega_2", "omega_3", "phi_2"]);
    let m = Mechanism::new(&scene).unwrap().value;
    let placed = PlacedScene::new(&scene, &m).unwrap();
    let stations = Stations::turned(Angle::Deg(-360.0), Angle::Deg(720.0), 1080);
    let table = sweep::run(&placed, 0, &stations, Width::Widest).unwrap();
    assert_eq!(table.rows(), 1081, "{:?}", table.notes);
    let at = |n: &str, i: usize| table.column(n).unwrap().values[i];
    for i in 0..table.rows() {
        assert!(
            at("omega_2", i).abs() < 1e-6 && (at("omega_3", i) - 6.0).abs() < 1e-6,
            "row {i}: {}",
            at("omega_2", i)
        );
        assert!(at("phi_2", i).abs() < 1e-6, "row {i}: {}", at("phi_2", i));
    }
    let told: Vec<&str> = table.notes.iter().map(|n| n.message.en.as_str()).collect();
    assert!(told.len() >= 5, "{told:#?}");
    assert!(told[0].contains("links 2, 3 lie in line (a change point)"), "{told:#?}");
}

fn limits_of(scene: &Scene) -> extreme::MotionLimits {
    let m = Mechanism::new(scene).unwrap().value;
    extreme::limits(scene, &m, 0).unwrap()
}

/// numerics.md: 40-digit arithmetic gives 3.166736461625599254478 rad for the leg with a crank of
/// 16.5.
#[test]
fn the_limit_of_the_walking_leg() {
    let text = templates::instantiate("jansen-leg", &[("l_m", "16.5")]).unwrap();
    let scene = read(text).unwrap().value;
    let limits = limits_of(&scene);
    let ends: Vec<f64> = limits.range.ends.iter().flatten().map(|e| e.value).collect();
    println!("{ends:?}");
    assert!(ends.iter().any(|e| (e - 3.166_736_461_625_599_3).abs() < 1e-15), "{limits:?}");
}

/// At a limit of the driver an output is at its end: a trammel's slider moves from 300 mm to the
/// intersection of the guides (0) and back, a boom from straight down its cylinder's line to
/// straight up, half a turn.
#[test]
fn outputs_at_the_limits_of_the_driver() {
    let trammel = limits_of(&read(templates::get("elliptic-trammel").unwrap()).unwrap().value);
    let ends: Vec<f64> = trammel.swings[0].extremes.iter().map(|e| e.output).collect();
    assert!(ends[0] == 0.0 && ends[2] == 0.0 && (ends[1] - 0.3).abs() < 1e-15, "{ends:?}");
    let excavator = limits_of(&read(templates::get("excavator").unwrap()).unwrap().value);
    assert!(
        (excavator.swings[0].stroke.unwrap() - std::f64::consts::PI).abs() < 1e-11,
        "{:?}",
        excavator.swings
    );
    // A class III group: the remaining travel goes as the square root of the distance to the end.
    let scene = scene("class-iii-six-bar", &["phi_4"]);
    let m = Mechanism::new(&scene).unwrap().value;
    let limits = limits_of(&scene);
    let upper = limits.range.ends[1].as_ref().unwrap().value;
    let end = limits.swings[0].extremes.last().unwrap();
    let stations =
        Stations::of_values((0..40).map(|k| upper - 0.1 * 0.6f64.powi(k)).collect(), 1.0);
    let table =
        sweep::run(&PlacedScene::new(&scene, &m).unwrap(), 0, &stations, Width::One).unwrap();
    let way = |k: usize| {
        (end.output - table.column("phi_4").unwrap().values[k])
            / (upper - stations.values[k]).sqrt()
    };
    assert!(end.at_limit && table.rows() == 40, "{end:?} {}", table.rows());
    assert!(
        (way(39) / way(30) - 1.0).abs() < 5e-3 && (way(39) / way(35) - 1.0).abs() < 1e-3,
        "{} {} {}",
        way(30),
        way(35),
        way(39)
    );
}

/// Khurmi & Gupta, ch. 5: centres 240 mm, crank 120 mm, lever 450 mm: inclination 30 degrees, time
/// ratio 2, stroke 450 mm (the lever's end, across); centres 200, crank 100, lever 400: stroke 400
/// mm.
#[test]
fn time_ratio_of_a_slotted_lever() {
    for (centre, crank, lever, stroke) in [(0.24, 0.12, 0.45, 0.45), (0.2, 0.1, 0.4, 0.4)] {
        let text = format!(
            r#"{{"links": {{"1": ["O", "A"], "3": ["C", "D"], "4": ["O", "C"]}}, "ground": "4",
                "points": {{"O": [0, 0], "C": [0, "-{centre} m"]}}, "lengths": {{"OA": "{crank} m", "CD": "{lever} m"}},
                "guides": [{{"pin": "A", "slider": "2", "on": "3", "line": "CD"}}],
                "driver": {{"link": "1", "angle": "60 deg", "omega": "10 rad/s"}}, "find": ["omega_3"]}}"#
        );
        let scene = read(&text).unwrap_or_else(|f| panic!("{f}")).value;
        let limits = limits_of(&scene);
        let swing = &limits.swings[0];
        assert!(limits.range.full());
        assert!((swing.time_ratio.unwrap() - 2.0).abs() < 1e-12, "{swing:?}");
        assert!((swing.stroke.unwrap() - 60f64.to_radians()).abs() < 1e-14, "{swing:?}");
        let across: Vec<f64> = swing.extremes.iter().map(|e| lever * e.output.cos()).collect();
        assert!(((across[0] - across[1]).abs() - stroke).abs() < 1e-12, "{across:?}");
    }
}

/// Khurmi & Gupta, fig. 5.32: centres 50, crank 75, ram perpendicular: time ratio 2.73523918263.
#[test]
fn time_ratio_of_a_whitworth_mechanism() {
    let text = r#"{"links": {"1": ["C", "A"], "3": ["D", "P"], "4": ["C", "D"], "5": ["P", "R"]}, "ground": "4",
        "points": {"C": [0, 0], "D": [0, "-50 mm"]}, "lengths": {"CA": "75 mm", "DP": "150 mm", "PR": "135 mm"},
        "guides": [{"pin": "A", "slider": "2", "on": "3", "line": "DP"}, {"pin": "R", "slider": "6", "on": "4", "through": "D", "angle": "0 deg"}],
        "driver": {"link": "1", "angle": "5 deg", "omega": "10 rad/s"}, "find": ["v_R"]}"#;
    let text = text.replace(
        "\"DP\": \"150 mm\", \"PR\": \"135 mm\"",
        "\"DP\": \"135 mm\", \"PR\": \"150 mm\"",
    );
    let scene = read(&text).unwrap_or_else(|f| panic!("{f}")).value;
    let limits = limits_of(&scene);
    let ram = limits
        .swings
        .iter()
        .find(|s| matches!(s.output, extreme::DrivenOutput::Sliding(_)))
        .unwrap();
    assert!((ram.time_ratio.unwrap() - 2.735_239_182_63).abs() < 1e-10, "{ram:?}");
    assert!((ram.stroke.unwrap() - 0.27).abs() < 1e-12, "{ram:?}");
}

/// Lecture notes 001, exam 2-4: K = 1.5 (advance to return): the crank turns 180° ± 36° between the
/// extremes. Bisection finds the rocker's length for K = 1.5.
#[test]
fn extreme_position_angle_of_a_time_ratio() {
    let limits = |rocker: f64| {
        let text = templates::instantiate(
            "crank-rocker",
            &[("l_BC", "200"), ("l_CD", &format!("{rocker:e} m"))],
        )
        .unwrap();
        limits_of(&read(text).unwrap().value)
    };
    let ratio = |l: &extreme::MotionLimits| l.swings[0].time_ratio.unwrap();
    // Crank 100, coupler 200, frame 300 mm.
    let (mut low, mut high) = (0.3, 0.36);
    assert!(
        ratio(&limits(low)) < 1.5 && ratio(&limits(high)) > 1.5,
        "{} {}",
        ratio(&limits(low)),
        ratio(&limits(high))
    );
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if ratio(&limits(middle)) < 1.5 { low = middle } else { high = middle }
    }
    let ends: Vec<f64> = limits(low).swings[0].extremes.iter().map(|e| e.driver).collect();
    let theta = ((ends[0] - ends[1]).abs() - std::f64::consts::PI).abs();
    assert!((theta.to_degrees() - 36.0).abs() < 1e-9, "{theta} {ends:?}");
}

/// A triad's limit: leg equations and determinant vanish; the fold goes as the square root.
#[test]
fn the_limit_of_a_triad() {
    let scene = scene("class-iii-six-bar", &[]);
    let m = Mechanism::new(&scene).unwrap().value;
    let limits = limits_of(&scene);
    let ends: Vec<f64> = limits.range.ends.iter().map(|e| e.as_ref().unwrap().value).collect();
    let placed = PlacedScene::new(&scene, &m).unwrap();
    for (end, inward) in [(ends[0], 1.0), (ends[1], -1.0)] {
        let at = |off: f64| {
            let stations = Stations::of_values(vec![end + inward * off], 1.0);
            sweep::run(&placed, 0, &stations, Width::Widest)
                .unwrap()
                .column("omega_3")
                .unwrap()
                .values
                .first()
                .copied()
        };
        // Rates grow as 1/√distance: at a hundredth of the distance, ten times as fast.
        let (far, near) = (at(1e-6).unwrap(), at(1e-8).unwrap());
        assert!((near / far / 10.0 - 1.0).abs() < 0.01, "{end}: {far} {near}");
        assert_eq!(at(-1e-9), None);
    }
}

/// The number of random mechanisms: small, or that of `HODOGRAPH_SWEEPS` for a long search.
fn count(own: u64) -> u64 {
    std::env::var("HODOGRAPH_SWEEPS").ok().and_then(|n| n.parse().ok()).unwrap_or(own)
}

/// Every row of a coarse sweep is that of a sweep of 3600 steps: the branch does not depend on the
/// step.
fn same_branch_at_every_step(name: &str, scene: &Scene, m: &Mechanism) -> usize {
    let Ok(placed) = PlacedScene::new(scene, m) else { return 0 };
    let fine = sweep::run(
        &placed,
        0,
        &Stations::turned(Angle::Deg(0.0), Angle::Deg(360.0), 3600),
        Width::Widest,
    )
    .unwrap();
    let mut rows = 0;
    for steps in [24, 72, 360] {
        let coarse = sweep::run(
            &placed,
            0,
            &Stations::turned(Angle::Deg(0.0), Angle::Deg(360.0), steps),
            Width::Widest,
        )
        .unwrap();
        for (i, value) in coarse.columns[0].values.iter().enumerate() {
            let there = fine.columns[0].values.iter().position(|v| (v - value).abs() < 1e-9);
            let there = there.unwrap_or_else(|| {
                panic!("{name}: {steps} steps have a row at {value}, 3600 have none")
            });
            for (a, b) in coarse.columns.iter().zip(&fine.columns).filter(|(a, _)| a.unit == "m") {
                let off = (a.values[i] - b.values[there]).abs() / placed.at.extent();
                assert!(
                    off < 1e-6,
                    "{name}: {} at {value} by {steps} steps: {} against {}",
                    a.name,
                    a.values[i],
                    b.values[there]
                );
            }
            rows += 1;
        }
        let expected = fine.columns[0].values.iter().filter(|v| {
            (*v * steps as f64 / std::f64::consts::TAU)
                .fract()
                .min(1.0 - (*v * steps as f64 / std::f64::consts::TAU).fract())
                < 1e-9
        });
        assert_eq!(coarse.rows(), expected.count(), "{name}: {steps} steps");
    }
    rows
}

#[test]
fn random_four_bars_stay_on_their_branch() {
    let mut rng = Pcg64Mcg::seed_from_u64(7);
    let mut uniform =
        |a: f64, b: f64| a + (b - a) * (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
    let (mut rows, mut swept) = (0, 0);
    for i in 0..count(150) {
        let [a, b, c, d] =
            [uniform(0.05, 0.4), uniform(0.1, 0.5), uniform(0.1, 0.5), uniform(0.1, 0.5)];
        let side = if i % 2 == 0 { "left" } else { "right" };
        let text = format!(
            r#"{{"links": {{"1": ["A", "B"], "2": ["B", "C"], "3": ["D", "C"], "4": ["A", "D"]}}, "ground": "4",
                "lengths": {{"AB": "{a} m", "BC": "{b} m", "CD": "{c} m", "AD": "{d} m"}},
                "driver": {{"link": "1", "angle": "{} deg", "omega": "1 rad/s"}}, "side": {{"C": "{side} of BD"}}, "find": ["x_C", "y_C"]}}"#,
            uniform(0.0, 360.0)
        );
        let scene = read(&text).unwrap_or_else(|f| panic!("{f}\n{text}")).value;
        let m = Mechanism::new(&scene).unwrap().value;
        let n = same_branch_at_every_step(&text, &scene, &m);
        swept += usize::from(n > 0);
        rows += n;
    }
    println!("{swept} four-bars, {rows} rows");
    assert!(swept > 50);
}

#[test]
fn random_triads_stay_on_their_assembly() {
    let mut rng = Pcg64Mcg::seed_from_u64(11);
    let mut uniform =
        |a: f64, b: f64| a + (b - a) * (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
    let (mut rows, mut swept) = (0, 0);
    for _ in 0..count(30) {
        // A pose first; the lengths are read off it.
        let mut at = |x: f64, y: f64| [x + uniform(-0.08, 0.08), y + uniform(-0.08, 0.08)];
        let (p, q, r, m, n) =
            (at(0.15, 0.17), at(0.27, 0.13), at(0.25, 0.27), at(0.42, 0.02), at(0.1, 0.4));
        let (crank, angle) = (uniform(0.02, 0.09), uniform(0.0, 360.0));
        let a = [crank * angle.to_radians().cos(), crank * angle.to_radians().sin()];
        let l = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
        let text = format!(
            r#"{{"links": {{"1": ["O", "A"], "2": ["A", "P"], "3": ["P", "Q", "R"], "4": ["M", "Q"], "5": ["N", "R"], "6": ["O", "M", "N"]}},
                "ground": "6", "points": {{"O": [0, 0], "M": ["{} m", "{} m"], "N": ["{} m", "{} m"]}},
                "lengths": {{"OA": "{crank} m", "AP": "{} m", "PQ": "{} m", "PR": "{} m", "QR": "{} m", "MQ": "{} m", "NR": "{} m"}},
                "driver": {{"link": "1", "angle": "{angle} deg", "omega": "1 rad/s"}},
                "sketch": {{"P": ["{} m", "{} m"], "Q": ["{} m", "{} m"], "R": ["{} m", "{} m"]}}, "find": ["x_P", "y_P", "x_Q", "y_Q", "x_R", "y_R"]}}"#,
            m[0],
            m[1],
            n[0],
            n[1],
            l(a, p),
            l(p, q),
            l(p, r),
            l(q, r),
            l(m, q),
            l(n, r),
            p[0],
            p[1],
            q[0],
            q[1],
            r[0],
            r[1]
        );
        let scene = read(&text).unwrap_or_else(|f| panic!("{f}\n{text}")).value;
        let m = Mechanism::new(&scene).unwrap().value;
        let k = same_branch_at_every_step(&text, &scene, &m);
        swept += usize::from(k > 0);
        rows += k;
    }
    println!("{swept} triads, {rows} rows");
    assert!(swept > 20);
}

#[test]
fn a_batch_is_its_parts() {
    let scene = scene("crank-rocker", &["v_C", "omega_3"]);
    let m = Mechanism::new(&scene).unwrap().value;
    let variation = Variation::new(&scene, &["l_AB", "l_BC"]).unwrap();
    let values = vec![
        variation.range(&scene, "l_AB", "60", "160", 10).unwrap(),
        variation.range(&scene, "l_BC", "200", "300", 4).unwrap(),
    ];
    for choice in [ParameterChoice::Grid, ParameterChoice::Random { count: 55, seed: 3 }] {
        let stations = Some(Stations::turned(Angle::Deg(0.0), Angle::Deg(350.0), 35));
        let batch = Batch {
            scene: &scene,
            mechanism: &m,
            variation: variation.clone(),
            values: values.clone(),
            choice,
            driver: 0,
            stations,
        };
        assert_eq!(batch.mechanisms(), 55);
        let whole = batch.block(0, 55);
        let mut parts = Block { columns: vec![Vec::new(); whole.columns.len()], missing: 0 };
        // Each in the memory of the one before, with any contents.
        let mut part = whole.clone();
        for from in (0..55).step_by(7) {
            part = batch.block_in(from, (from + 7).min(55), part);
            parts.missing += part.missing;
            parts.columns.iter_mut().zip(&part.columns).for_each(|(c, p)| c.extend(p));
        }
        assert_eq!(whole, parts);
        assert_eq!(whole.columns[0].len() as u64 + whole.missing, 55 * 36);
        // Each mechanism agrees with its own text.
        for number in [0, 17, 54] {
            let lengths: Vec<String> =
                batch.parameters(number).iter().map(|v| format!("{:e} m", v.si())).collect();
            let text = templates::instantiate(
                "crank-rocker",
                &[("l_AB", &lengths[0]), ("l_BC", &lengths[1])],
            )
            .unwrap();
            let own = read(edit::with_find(&text, &["v_C", "omega_3"]).unwrap()).unwrap().value;
            let Ok(placed) = PlacedScene::new(&own, &m) else { continue };
            let table =
                sweep::run(&placed, 0, batch.stations.as_ref().unwrap(), Width::One).unwrap();
            let rows: Vec<usize> = (0..whole.columns[0].len())
                .filter(|&i| whole.columns[0][i] == number as f64)
                .collect();
            assert_eq!(rows.len(), table.rows(), "{number}");
            for (c, t) in whole.columns[3..].iter().zip(&table.columns) {
                for (k, &i) in rows.iter().enumerate() {
                    assert!(
                        (c[i] - t.values[k]).abs() <= 1e-12 * c[i].abs().max(1.0),
                        "{number} {} {} {}",
                        t.name,
                        c[i],
                        t.values[k]
                    );
                }
            }
        }
    }
}

/// Mechanisms that pass a change point, or stop, are swept as if alone; an old table is only
/// memory.
#[test]
fn change_points_in_a_batch() {
    let text = templates::instantiate(
        "crank-rocker",
        &[("l_BC", "300"), ("l_CD", "100"), ("l_AD", "300")],
    )
    .unwrap();
    let scene = read(edit::with_find(&text, &["v_C", "omega_3"]).unwrap()).unwrap().value;
    let m = Mechanism::new(&scene).unwrap().value;
    let variation = Variation::new(&scene, &["l_AB"]).unwrap();
    let values = vec![variation.range(&scene, "l_AB", "90", "110", 2).unwrap()];
    let stations = Stations::turned(Angle::Deg(0.0), Angle::Deg(360.0), 200);
    let batch = Batch {
        scene: &scene,
        mechanism: &m,
        variation,
        values,
        choice: ParameterChoice::Grid,
        driver: 0,
        stations: Some(stations.clone()),
    };
    let whole = batch.block(0, 3);
    let (mut table, mut changed, mut stopped) = (Table::default(), 0, 0);
    for number in 0..3 {
        let mut own = scene.clone();
        batch.variation.set(&mut own, &batch.parameters(number)).unwrap();
        table = Sweep::new(&PlacedScene::new(&own, &m).unwrap(), 0).unwrap().run(
            &stations,
            Width::Widest,
            table,
        );
        let coded = |code: &str| table.notes.iter().filter(|n| n.code == code).count();
        changed += coded("change-point");
        stopped += coded("limit");
        let rows: Vec<usize> =
            (0..whole.columns[0].len()).filter(|&i| whole.columns[0][i] == number as f64).collect();
        assert_eq!(rows.len(), table.rows(), "{number}");
        for (c, t) in whole.columns[2..].iter().zip(&table.columns) {
            rows.iter().zip(&t.values).for_each(|(&i, v)| {
                assert_eq!(c[i].to_bits(), v.to_bits(), "{number} {} {i}", t.name)
            });
        }
    }
    assert!(changed >= 2 && stopped >= 1, "{changed} change points, {stopped} limits");
}

/// The compiled program agrees with the same position with the length in the file.
#[test]
fn a_sweep_over_a_length() {
    let scene = scene("shaper", &["v_C", "a_C", "omega_3"]);
    let m = Mechanism::new(&scene).unwrap().value;
    let variation = Variation::new(&scene, &["l_O2B"]).unwrap();
    let span = variation.span(&scene, "l_O2B", "500", "580", 8).unwrap();
    let table = gather(&mut Varied::new(&scene, &m, &variation, span));
    assert_eq!(table.rows(), 9, "{:?}", table.notes);
    for (i, l) in table.columns[0].values.iter().enumerate() {
        let text = templates::instantiate("shaper", &[("l_O2B", &format!("{l:e} m"))]).unwrap();
        let own = read(edit::with_find(&text, &["v_C", "a_C", "omega_3"]).unwrap()).unwrap().value;
        let now = own.drivers[0].kind.clone();
        let DriverKind::Turn { angle: Some(angle), .. } = now else {
            panic!("the shaper has a crank")
        };
        let (row, _) = solved(&own, &m, angle.value.radians()).unwrap();
        for (c, e) in table.columns[1..].iter().zip(row) {
            assert!(
                (c.values[i] - e).abs() <= 1e-11 * e.abs().max(1e-3),
                "{} at {l}: {} against {e}",
                c.name,
                c.values[i]
            );
        }
    }
}

/// A parameter over a range with no mechanism in a part of it, in pieces.
#[test]
fn a_sweep_over_a_parameter_is_its_pieces() {
    let scene = scene("crank-rocker", &["v_C", "omega_3"]);
    let m = Mechanism::new(&scene).unwrap().value;
    let variation = Variation::new(&scene, &["l_BC"]).unwrap();
    let span = variation.span(&scene, "l_BC", "20", "300", 500).unwrap();
    let whole = gather(&mut Varied::new(&scene, &m, &variation, span));
    assert!(
        (100..501).contains(&whole.rows()) && whole.notes.len() == 1,
        "{} {:?}",
        whole.rows(),
        whole.notes
    );
    let (columns, notes) = pieces(&mut Varied::new(&scene, &m, &variation, span), 23);
    same_bits("l_BC", &columns, &whole);
    assert_eq!(notes, whole.notes);
}
