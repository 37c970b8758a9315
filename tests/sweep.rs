//! Sweeps against single solutions: every row of a table is what `solve` says at that position, and what differences of
//! neighbouring positions say of its rates.

use hodograph::accuracy::toggle::with_driver_at;
use hodograph::analytic;
use hodograph::answer::{Value, evaluate};
use hodograph::mechanism::{Demand, Mechanism};
use hodograph::position;
use hodograph::scene::{Angle, DriverKind, Scene, edit, read, templates};
use hodograph::sweep::{self, Placed, Stations, Table, Width, extreme, station};

fn scene(name: &str, find: &[&str]) -> Scene {
    let text = templates::get(name).unwrap();
    let text = if find.is_empty() { text.to_owned() } else { edit::with_find(text, find).unwrap() };
    read(&text).unwrap_or_else(|f| panic!("{name}: {f}")).value
}

/// Stations about the instant: a turn, or a tenth of the size to either side.
fn stations(placed: &Placed, steps: usize) -> Stations {
    let now = station::position_now(placed.scene, &placed.at, 0);
    let per_value = station::angle_per_value(placed.scene, &placed.at, 0);
    match placed.scene.drivers[0].kind {
        DriverKind::Turn { .. } => Stations::slid(now, now + std::f64::consts::TAU, steps, per_value),
        _ => {
            let reach = 0.1 * placed.at.extent();
            Stations::slid(now - reach, now + reach, steps, per_value)
        }
    }
}

fn swept(scene: &Scene, m: &Mechanism, steps: usize, width: Width) -> (Table, Stations) {
    let placed = Placed::new(scene, m).unwrap();
    let stations = stations(&placed, steps);
    (sweep::run(&placed, 0, &stations, width).unwrap(), stations)
}

/// Every question, so that every kind of operation is compiled: those of the template, all points and all links.
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

/// The size of a column's kind: its largest number in the sweep, or what the drivers make at the size of the mechanism.
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
    table.columns[1..].iter().filter(|o| o.unit == unit).flat_map(|o| &o.values).fold(floor, |a, b| a.max(b.abs()))
}

/// The answers of the loop equations at one driver value, on the closures of the instant; `None` where the pose is
/// singular, or nearly: what rounding makes of such a pose is not the sweep's concern.
fn solved(scene: &Scene, m: &Mechanism, value: f64) -> Option<(Vec<f64>, f64)> {
    let demand = Demand::of(scene, m);
    let meant = position::configure(scene, m, &demand).unwrap().value;
    let there = with_driver_at(scene, 0, value);
    let at = position::recompute::<f64>(&there, m, &demand, &meant).ok()?;
    let solution = analytic::solve(&there, m, &at, &demand).ok()?;
    let mut row = Vec::new();
    for f in &scene.find {
        match evaluate(&there, &at, &solution, &f.what)? {
            Value::Scalar(s) => row.push(s),
            Value::Vector(v) => row.extend([v.x, v.y, v.norm()]),
        }
    }
    Some((row, solution.condition))
}

/// The triads have no closed form that can be evaluated elsewhere: they are checked by their lengths and by differences.
fn followed(m: &Mechanism) -> bool {
    m.groups.iter().any(|g| g.class().is_some_and(|c| c != "II"))
}

#[test]
fn every_row_is_what_the_single_solution_says() {
    let (mut rows, mut worst) = (0, (0.0f64, String::new()));
    for t in templates::list() {
        let scene = everything(t.name);
        let m = Mechanism::new(&scene).unwrap().value;
        // The parallelogram goes on smoothly through its change points, where the side that the scene names does not.
        if followed(&m) || t.name == "parallelogram" {
            continue;
        }
        let (table, stations) = swept(&scene, &m, 96, Width::Widest);
        let extent = Placed::new(&scene, &m).unwrap().at.extent();
        let mut there = 0;
        for value in &stations.values {
            let expected = solved(&scene, &m, *value);
            let row = table.columns[0].values.iter().position(|v| v == value);
            let Some((expected, condition)) = expected else {
                assert!(row.is_none(), "{}: a row at {value} that cannot be solved", t.name);
                continue;
            };
            let row = row.unwrap_or_else(|| panic!("{}: no row at {value}: {:?}", t.name, table.notes));
            there += 1;
            for (c, e) in table.columns[1..].iter().zip(expected) {
                let off = (c.values[row] - e).abs();
                let off = if c.unit == "rad" { off.min((off - std::f64::consts::TAU).abs()) } else { off };
                let off = off / size(&table, c.unit, &scene, extent) / (condition * 1e-3).max(1.0);
                if off > worst.0 {
                    worst = (off, format!("{} {} at {value}", t.name, c.name));
                }
                assert!(off < 1e-12, "{} {} at {value}: {} against {e} ({off:e}, condition {condition:.0})", t.name, c.name, c.values[row]);
            }
        }
        assert_eq!(there, table.rows(), "{}", t.name);
        rows += there;
    }
    println!("{rows} rows, worst {:.1e}: {}", worst.0, worst.1);
    assert!(rows > 2000);
}

#[test]
fn one_at_a_time_and_four_give_the_same_bits() {
    for t in templates::list() {
        let scene = everything(t.name);
        let m = Mechanism::new(&scene).unwrap().value;
        let (four, _) = swept(&scene, &m, 1500, Width::Widest);
        let (one, _) = swept(&scene, &m, 1500, Width::One);
        assert_eq!(four.notes, one.notes, "{}", t.name);
        for (a, b) in four.columns.iter().zip(&one.columns) {
            let same = a.values.len() == b.values.len() && a.values.iter().zip(&b.values).all(|(x, y)| x.to_bits() == y.to_bits());
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
        let placed = Placed::new(&scene, &m).unwrap();
        let now = station::position_now(&scene, &placed.at, 0);
        let step = 1e-5 * if matches!(scene.drivers[0].kind, DriverKind::Turn { .. }) { 1.0 } else { placed.at.extent() };
        if scene.drivers.len() > 1 {
            continue;
        }
        let values: Vec<f64> =
            (-40..40).flat_map(|k| (-2..=2).map(move |i| now + 2000.0 * step * f64::from(k) + step * f64::from(i))).collect();
        let stations = Stations::of_values(values.clone(), station::angle_per_value(&scene, &placed.at, 0));
        let table = sweep::run(&placed, 0, &stations, Width::Widest).unwrap();
        let rate = scene.drivers[0].rate.value;
        let acceleration = scene.drivers[0].acceleration.as_ref().map_or(0.0, |a| a.value);
        let pairs: Vec<(String, String, String)> = scene
            .points
            .iter()
            .flat_map(|p| ["x", "y"].map(|c| (format!("{c}_{}", p.name), format!("v_{}.{c}", p.name), format!("a_{}.{c}", p.name))))
            .chain(scene.links.iter().map(|l| (format!("phi_{}", l.name), format!("omega_{}", l.name), format!("alpha_{}", l.name))))
            .collect();
        for (s, v, a) in pairs {
            let (Some(s), Some(v), Some(a)) = (table.column(&s), table.column(&v), table.column(&a)) else { continue };
            let largest = |c: &sweep::Column| size(&table, c.unit, &scene, placed.at.extent());
            for first in 0..table.rows().saturating_sub(4) {
                let at = |i: usize| table.columns[0].values[first + i];
                if (at(4) - at(0) - 4.0 * step).abs() > 0.1 * step {
                    continue;
                }
                let slope = |c: &sweep::Column, k: usize| {
                    let (before, after) = (c.values[first + 2 - k], c.values[first + 2 + k]);
                    let turned =
                        if c.unit == "rad" { libm::rint((after - before) / std::f64::consts::TAU) * std::f64::consts::TAU } else { 0.0 };
                    (after - before - turned) / (2.0 * k as f64 * step) * rate
                };
                // a = dv/dx ẋ, the rate itself changing with the driver's own acceleration: v/ẋ is a function of x alone.
                let expected = [v.values[first + 2], a.values[first + 2] - v.values[first + 2] * acceleration / rate];
                for ((of, is), expected) in [(s, v), (v, a)].into_iter().zip(expected) {
                    // Where the two differences differ the function bends too sharply for them, next to a limit.
                    let (one, two) = (slope(of, 1), slope(of, 2));
                    let off = ((4.0 * one - two) / 3.0 - expected).abs() / largest(is);
                    let allowed = 1e-7 + (one - two).abs() / largest(is);
                    assert!(off < allowed, "{} {} at {}: {one}, {two} against {expected}", t.name, is.name, at(2));
                }
                checked += 1;
            }
        }
    }
    println!("{checked} slopes");
    assert!(checked > 10_000);
}

#[test]
fn a_parallelogram_stays_one() {
    let scene = scene("parallelogram", &["omega_2", "omega_3", "phi_2"]);
    let m = Mechanism::new(&scene).unwrap().value;
    let placed = Placed::new(&scene, &m).unwrap();
    let stations = Stations::turned(Angle::Deg(-360.0), Angle::Deg(720.0), 1080);
    let table = sweep::run(&placed, 0, &stations, Width::Widest).unwrap();
    assert_eq!(table.rows(), 1081, "{:?}", table.notes);
    let at = |n: &str, i: usize| table.column(n).unwrap().values[i];
    for i in 0..table.rows() {
        assert!(at("omega_2", i).abs() < 1e-6 && (at("omega_3", i) - 6.0).abs() < 1e-6, "row {i}: {}", at("omega_2", i));
        assert!(at("phi_2", i).abs() < 1e-6, "row {i}: {}", at("phi_2", i));
    }
    let told: Vec<&str> = table.notes.iter().map(|n| n.message.as_str()).collect();
    assert!(told.len() >= 5, "{told:#?}");
    assert!(told[0].contains("links 2, 3 lie in line (a change point)"), "{told:#?}");
}

fn limits_of(scene: &Scene) -> extreme::Limits {
    let m = Mechanism::new(scene).unwrap().value;
    extreme::limits(scene, &m, 0).unwrap()
}

/// numerics.md: 40-digit arithmetic gives 3.166736461625599254478 rad for the leg with a crank of 16.5.
#[test]
fn the_limit_of_the_walking_leg() {
    let text = templates::instantiate("jansen-leg", &[("l_m", "16.5")]).unwrap();
    let scene = read(text).unwrap().value;
    let limits = limits_of(&scene);
    let ends: Vec<f64> = limits.range.ends.iter().flatten().map(|e| e.value).collect();
    println!("{ends:?}");
    assert!(ends.iter().any(|e| (e - 3.166_736_461_625_599_3).abs() < 1e-15), "{limits:?}");
}

/// Khurmi & Gupta, ch. 5: centres 240 mm, crank 120 mm, lever 450 mm: inclination 30 degrees, time ratio 2, stroke 450 mm (the
/// lever's end, across); centres 200, crank 100, lever 400: stroke 400 mm.
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

/// Khurmi & Gupta, fig. 5.32 (Whitworth): centres 50, crank 75, ram on the line square to them: time ratio 2.73523918263.
#[test]
fn time_ratio_of_a_whitworth_mechanism() {
    let text = r#"{"links": {"1": ["C", "A"], "3": ["D", "P"], "4": ["C", "D"], "5": ["P", "R"]}, "ground": "4",
        "points": {"C": [0, 0], "D": [0, "-50 mm"]}, "lengths": {"CA": "75 mm", "DP": "150 mm", "PR": "135 mm"},
        "guides": [{"pin": "A", "slider": "2", "on": "3", "line": "DP"}, {"pin": "R", "slider": "6", "on": "4", "through": "D", "angle": "0 deg"}],
        "driver": {"link": "1", "angle": "5 deg", "omega": "10 rad/s"}, "find": ["v_R"]}"#;
    let text = text.replace("\"DP\": \"150 mm\", \"PR\": \"135 mm\"", "\"DP\": \"135 mm\", \"PR\": \"150 mm\"");
    let scene = read(&text).unwrap_or_else(|f| panic!("{f}")).value;
    let limits = limits_of(&scene);
    let ram = limits.swings.iter().find(|s| matches!(s.output, extreme::Output::Sliding(_))).unwrap();
    assert!((ram.time_ratio.unwrap() - 2.735_239_182_63).abs() < 1e-10, "{ram:?}");
    assert!((ram.stroke.unwrap() - 0.27).abs() < 1e-12, "{ram:?}");
}

/// A four-bar by hand: extremes of the rocker where crank and coupler lie in line, transmission angle where crank and frame do.
#[test]
fn limits_of_a_crank_rocker() {
    let scene = scene("crank-rocker", &[]);
    let limits = limits_of(&scene);
    let (a, b, c, d) = (0.1f64, 0.25f64, 0.2f64, 0.3f64);
    assert_eq!(limits.grashof.unwrap().0, extreme::Grashof::CrankRocker);
    let swing = &limits.swings[0];
    let angle = |s: f64| std::f64::consts::PI - ((c * c + d * d - s * s) / (2.0 * c * d)).acos();
    assert!((swing.stroke.unwrap() - (angle(b - a) - angle(a + b)).abs()).abs() < 1e-14, "{swing:?}");
    let crank = |s: f64| ((s * s + d * d - c * c) / (2.0 * s * d)).acos();
    let turn = std::f64::consts::PI + crank(b - a) - crank(b + a);
    let (long, short) = (turn.max(std::f64::consts::TAU - turn), turn.min(std::f64::consts::TAU - turn));
    assert!((swing.time_ratio.unwrap() - long / short).abs() < 1e-13, "{swing:?}");
    let gamma = |s: f64| ((b * b + c * c - s * s) / (2.0 * b * c)).acos();
    let worst = gamma(d - a).min(std::f64::consts::PI - gamma(d + a));
    assert!((limits.transmission[0].angle - worst).abs() < 1e-14, "{:?} {worst}", limits.transmission);
}

/// A triad's limit: the leg equations and their determinant vanish there; from both sides the fold goes with the square root.
#[test]
fn the_limit_of_a_triad() {
    let scene = scene("class-iii-six-bar", &[]);
    let m = Mechanism::new(&scene).unwrap().value;
    let limits = limits_of(&scene);
    let ends: Vec<f64> = limits.range.ends.iter().map(|e| e.as_ref().unwrap().value).collect();
    let placed = Placed::new(&scene, &m).unwrap();
    for (end, inward) in [(ends[0], 1.0), (ends[1], -1.0)] {
        let at = |off: f64| {
            let stations = Stations::of_values(vec![end + inward * off], 1.0);
            sweep::run(&placed, 0, &stations, Width::Widest).unwrap().column("omega_3").unwrap().values.first().copied()
        };
        // Rates grow with one over the root of the distance: a hundredth of the way, ten times as fast.
        let (far, near) = (at(1e-6).unwrap(), at(1e-8).unwrap());
        assert!((near / far / 10.0 - 1.0).abs() < 0.01, "{end}: {far} {near}");
        assert_eq!(at(-1e-9), None);
    }
}
