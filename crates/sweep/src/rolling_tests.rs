//! Tests of swept mechanisms with rolling pairs: compiled, by Newton's method, by differences, and
//! against whole numbers.

use super::extreme::limits;
use super::{PlacedScene, Stations, Width, compile, follow::whole, run};
use hodograph_mechanism::mechanism::Mechanism;
use hodograph_scene::{Angle, read};
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use std::f64::consts::TAU;

const FAST: &str = r#"{"units": {"length": "mm", "angle": "deg"}, "links": {"1": ["A","D"], "2": ["A","B"], "3": ["D","C"]}, "ground": "1",
    "points": {"A": [0,0], "D": [90,0]}, "lengths": {"AB": 20, "CD": 40},
    "gears": [{"links": ["2","3"], "centres": ["A","D"], "teeth": [21, 40], "at": "K", "phase": "0 deg"}],
    "driver": {"link": "2", "angle": "0 deg", "omega": "10 rad/s"}, "find": ["phi_3","omega_3","alpha_3","v_K3","a_K3","v_C","a_C"]}"#;

/// A planet between a driving sun and a fixed ring, followed by a dyad.
const PLANET: &str = r#"{"units": {"length": "mm", "angle": "deg"}, "links": {"1": ["O","D"], "2": ["O"], "3": ["O","Q"], "4": ["Q","B"],
    "5": ["B","C"], "6": ["C","D"]}, "ground": "1", "points": {"O": [0,0], "Q": [36,48], "B": [46,66], "C": [110,80], "D": [120,10]},
    "gears": [{"links": ["2","4"], "centres": ["O","Q"], "radii": [30,30], "at": "K"},
              {"links": ["4","1"], "centres": ["Q","O"], "radii": [30,90], "ring": "1", "at": "E"}],
    "driver": {"link": "2", "omega": "-10 rad/s"}, "find": ["v_K4","v_B","v_C","omega_6","alpha_6","a_E4","a_B","omega_3"]}"#;

/// The scenes, each with the length of its sweep (rad, m).
const SCENES: [(&str, &str, f64); 11] = [
    ("mesh", FAST, 3.0 * TAU),
    ("planet", PLANET, 0.5 * TAU),
    (
        "rack on a wheel of a connecting rod",
        r#"{"units": {"length": "mm", "angle": "deg"}, "links": {"1": ["A"], "2": ["A","B"], "3": ["B","C"], "4": ["C"]}, "ground": "1",
        "points": {"A": [0,0], "B": [60,80], "C": [210,0]}, "guides": [{"slider": "5", "on": "1", "angle": "0 deg"}],
        "rolling": [{"wheel": "4", "centre": "C", "radius": 40, "on": "1", "angle": "0 deg"}],
        "gears": [{"links": ["4","5"], "centres": ["C"], "radii": [40], "rack": "5", "angle": "180 deg", "at": "Q"}],
        "driver": {"link": "2", "omega": "10 rad/s"}, "find": ["v_C","a_C","omega_4","alpha_4","v_Q5","a_Q5"]}"#,
        2.0 * TAU,
    ),
    (
        "disc in a groove",
        r#"{"units": {"length": "m", "angle": "deg"}, "links": {"1": ["O","K"], "2": ["O","A"], "3": ["A","B"], "4": ["B"]}, "ground": "1",
        "points": {"O": [0,0], "A": [0.3,0.4], "B": [1.1,1], "K": [0.524,0.832]},
        "rolling": [{"wheel": "4", "centre": "B", "radius": 0.2, "on": "1", "track": "K", "track_radius": 0.8, "inside": true, "at": "N"}],
        "driver": {"link": "2", "omega": "2 rad/s"}, "find": ["v_B","omega_4","alpha_4","a_N4","a_B"]}"#,
        2.0 * TAU,
    ),
    (
        "gear on a coupler",
        r#"{"units": {"length": "mm", "angle": "deg"}, "links": {"1": ["A","D"], "2": ["A","B"], "3": ["B","C"], "4": ["C","D"], "5": ["D","E"],
        "6": ["E","F"], "7": ["F","A"]}, "ground": "1",
        "points": {"A": [0,0], "B": [20,30], "C": [110,90], "D": [120,0], "E": [130,10], "F": [60,80]},
        "gears": [{"links": ["3","5"], "centres": ["C","D"], "teeth": [20,30], "at": "K"}],
        "driver": {"link": "2", "omega": "4 rad/s"}, "find": ["phi_5","omega_5","alpha_5","v_E","a_E","a_K5"]}"#,
        3.0 * TAU,
    ),
    (
        "two drivers",
        r#"{"units": {"length": "mm", "angle": "deg"}, "links": {"1": ["O"], "2": ["O"], "3": ["O","Q"], "4": ["Q","B"]}, "ground": "1",
        "points": {"O": [0,0], "Q": [60,0], "B": [80,10]}, "gears": [{"links": ["2","4"], "centres": ["O","Q"], "teeth": [17,33], "at": "K"}],
        "driver": [{"link": "2", "omega": "10 rad/s"}, {"link": "3", "omega": "-3 rad/s"}], "find": ["omega_4","v_B","a_B","v_K2","a_K4"]}"#,
        2.0 * TAU,
    ),
    (
        "two planets on one arm",
        r#"{"units": {"length": "mm", "angle": "deg"}, "links": {"1": ["O"], "2": ["O"], "3": ["O","P","R"], "4": ["P"], "5": ["R","B"]}, "ground": "1",
        "points": {"O": [0,0], "P": [40,0], "R": [70,10], "B": [80,20]},
        "gears": [{"links": ["2","4"], "centres": ["O","P"], "teeth": [20,20]}, {"links": ["4","5"], "centres": ["P","R"], "teeth": [19,15]},
                  {"links": ["5","1"], "centres": ["R","O"], "teeth": [15,90], "ring": "1", "at": "K"}],
        "driver": {"link": "2", "omega": "10 rad/s"}, "find": ["omega_3","omega_4","omega_5","v_B","a_B","v_K5"]}"#,
        2.0 * TAU,
    ),
    (
        "rack and pinion",
        r#"{"units": {"length": "mm", "angle": "deg"}, "links": {"1": ["A","D"], "2": ["A"], "5": ["B"], "6": ["B","C"], "7": ["C","D"]}, "ground": "1",
        "points": {"A": [0,0], "B": [50,-40], "C": [120,30], "D": [100,-60]}, "guides": [{"slider": "5", "on": "1", "angle": "0 deg"}],
        "gears": [{"links": ["2","5"], "centres": ["A"], "radii": [40], "rack": "5", "angle": "0 deg", "at": "K"}],
        "driver": {"link": "2", "omega": "3 rad/s"}, "find": ["v_B","a_B","omega_7","alpha_7","v_K5"]}"#,
        0.1 * TAU,
    ),
    (
        "wheel that drives itself",
        r#"{"units": {"length": "mm", "angle": "deg"}, "links": {"1": ["O"], "3": ["C","M"]}, "ground": "1",
        "points": {"O": [0,0], "C": [0,300], "M": [100,400]}, "rolling": [{"wheel": "3", "centre": "C", "radius": 300, "on": "1", "angle": "0 deg"}],
        "driver": {"link": "3", "omega": "2 rad/s"}, "find": ["x_C","v_C","v_M","a_M"]}"#,
        4.0 * TAU,
    ),
    (
        "planet on a drag link",
        r#"{"units": {"length": "mm", "angle": "deg"}, "links": {"1": ["A","D"], "2": ["A","B"], "3": ["B","C"], "4": ["C","D"], "6": ["C","E"]},
        "ground": "1", "points": {"A": [0,0], "B": [0,60], "C": [70,45], "D": [20,0], "E": [80,60]},
        "gears": [{"links": ["1","6"], "centres": ["D","C"], "teeth": [30,20]}],
        "driver": {"link": "2", "omega": "10 rad/s"}, "find": ["phi_6","omega_6","alpha_6","v_E","a_E"]}"#,
        4.3 * TAU,
    ),
    (
        "rack that is pushed",
        r#"{"units": {"length": "mm", "angle": "deg"}, "links": {"1": ["A"], "2": ["A","B"], "5": ["E"]}, "ground": "1",
        "points": {"A": [0,0], "B": [30,20], "E": [50,-40]}, "guides": [{"slider": "5", "on": "1", "angle": "0 deg"}],
        "gears": [{"links": ["2","5"], "centres": ["A"], "radii": [40], "rack": "5", "angle": "0 deg", "at": "K"}],
        "driver": {"slide": "5", "position": "50 mm", "velocity": "0.3 m/s"}, "find": ["omega_2","alpha_2","v_B","a_B","v_E"]}"#,
        0.9,
    ),
];

fn with<T>(text: &str, see: impl FnOnce(&PlacedScene) -> T) -> T {
    let scene = read(text).unwrap_or_else(|f| panic!("{f}\n{text}")).value;
    let m = Mechanism::new(&scene).unwrap_or_else(|f| panic!("{f}\n{text}")).value;
    see(&PlacedScene::new(&scene, &m).unwrap_or_else(|f| panic!("{f}\n{text}")))
}

/// The columns by both methods, the driver's values first.
fn both(name: &str, placed: &PlacedScene, stations: &Stations) -> [Vec<Vec<f64>>; 2] {
    let compiled = compile(placed.scene, placed.mechanism, &placed.at, Some(0), &placed.scene.find);
    assert!(compiled.is_ok(), "{name}: {:?}", compiled.err());
    let table = run(placed, 0, stations, Width::Widest).unwrap();
    assert_eq!(table.rows(), stations.len(), "{name}: {:?}", table.notes);
    let (rows, notes) = whole::follow(placed, 0, stations);
    assert!(rows.missing.is_empty(), "{name}: {notes:?}");
    [table.columns.into_iter().skip(1).map(|c| c.values).collect(), rows.columns]
}

fn same(name: &str, [a, b]: &[Vec<Vec<f64>>; 2], tolerance: f64) {
    for (k, (a, b)) in a.iter().zip(b).enumerate() {
        let size = b.iter().fold(1e-3, |m: f64, v| m.max(v.abs()));
        for (i, (x, y)) in a.iter().zip(b).enumerate() {
            let off = (x - y).abs();
            // Angles differ by whole turns.
            let off = off.min((off - TAU).abs());
            assert!(off <= tolerance * size, "{name}: column {k}, row {i}: {x} against {y}");
        }
    }
}

#[test]
fn compiled_is_what_newton_finds() {
    for (name, text, reach) in SCENES {
        with(text, |placed| {
            let now = super::station::position_now(placed.scene, &placed.at, 0);
            let per_value = super::station::angle_per_value(placed.scene, &placed.at, 0);
            let stations = Stations::slid(now, now + reach, 60, per_value);
            same(name, &both(name, placed, &stations), 1e-9);
        });
    }
}

/// In `find`, the acceleration of a point or link follows its velocity: differences of the velocity
/// give the acceleration.
#[test]
fn compiled_rates_are_differences() {
    let pairs = [
        ("mesh", "phi_3", "omega_3"),
        ("gear on a coupler", "omega_5", "alpha_5"),
        ("planet on a drag link", "phi_6", "omega_6"),
        ("disc in a groove", "omega_4", "alpha_4"),
    ];
    let points = [
        ("mesh", "C"),
        ("planet", "B"),
        ("gear on a coupler", "E"),
        ("planet on a drag link", "E"),
        ("two planets on one arm", "B"),
        ("rack and pinion", "B"),
        ("wheel that drives itself", "M"),
    ];
    let mut asked: Vec<(&str, String, String)> =
        pairs.iter().map(|(n, a, b)| (*n, (*a).to_owned(), (*b).to_owned())).collect();
    for (n, p) in points {
        asked.push((n, format!("v_{p}"), format!("a_{p}")));
        asked.push((n, format!("x_{p}"), format!("v_{p}")));
    }
    for (name, of, rate) in asked {
        let (_, text, reach) = SCENES.iter().find(|s| s.0 == name).unwrap();
        let text = hodograph_scene::edit::with_find(text, &[&of, &rate]).unwrap();
        with(&text, |placed| {
            let now = super::station::position_now(placed.scene, &placed.at, 0);
            let omega = placed.scene.drivers[0].rate.value;
            for part in [0.07, 0.31, 0.83] {
                let (x, h) = (now + part * reach, 1e-4);
                let table =
                    run(placed, 0, &Stations::of_values(vec![x - h, x, x + h], 1.0), Width::One)
                        .unwrap();
                let (a, b) = (
                    &table.columns[1].values,
                    &table
                        .columns
                        .iter()
                        .find(|c| c.name.split('.').next() == Some(&rate))
                        .unwrap()
                        .values,
                );
                let turn = a[2] - a[0];
                let slope = (turn
                    - TAU * libm::rint(turn / TAU) * f64::from(of.starts_with("phi")))
                    * omega
                    / (2.0 * h);
                assert!(
                    (slope - b[1]).abs() < 1e-5 * (1.0 + b[1].abs()),
                    "{name}: {of} changes by {slope}, {rate} = {}",
                    b[1]
                );
            }
        });
    }
}

/// Trains of gears on ground and on a crank with any numbers of teeth.
#[test]
fn random_trains_are_what_newton_finds() {
    for seed in 0..24 {
        let mut rng = Pcg64Mcg::seed_from_u64(seed);
        let mut below = |n: u32| rng.next_u32() % n;
        let mut links = vec!["\"2\": [\"P0\",\"B\"]".to_owned()];
        let mut points = vec!["\"P0\": [0,0]".to_owned(), "\"B\": [20,10]".to_owned()];
        let (mut gears, mut find, mut ground) = (Vec::new(), Vec::new(), vec!["\"P0\"".to_owned()]);
        let planets = seed % 3 == 0;
        for k in 1..=2 + below(3) {
            let (x, y) = (60 * k, below(40));
            let link = 2 + k;
            points.push(format!("\"P{k}\": [{x},{y}]"));
            points.push(format!("\"C{k}\": [{},{}]", x + 5 + below(20), y + 3));
            links.push(format!("\"{link}\": [\"P{k}\",\"C{k}\"]"));
            ground.push(format!("\"P{k}\""));
            gears.push(format!(
                "{{\"links\": [\"{}\",\"{link}\"], \"centres\": [\"P{}\",\"P{k}\"], \"teeth\": [{},{}]}}",
                link - 1,
                k - 1,
                12 + below(40),
                12 + below(40)
            ));
            find.extend([
                format!("\"v_C{k}\""),
                format!("\"a_C{k}\""),
                format!("\"omega_{link}\""),
            ]);
        }
        let (base, driven) =
            if planets { ("\"P0\"".to_owned(), ", \"99\": [") } else { (ground.join(","), "") };
        // On an arm as the driver, about a fixed first wheel.
        let arm = if planets { format!("{driven}{}]", ground.join(",")) } else { String::new() };
        let drivers = if planets {
            r#"[{"link": "99", "omega": "2 rad/s"}, {"link": "2", "omega": "0 rad/s"}]"#
        } else {
            r#"[{"link": "2", "omega": "2 rad/s"}]"#
        };
        let text = format!(
            "{{\"units\": {{\"length\": \"mm\", \"angle\": \"deg\"}}, \"links\": {{\"1\": [{base}], {}{arm}}}, \"ground\": \"1\", \"points\": {{{}}}, \"gears\": [{}], \"driver\": {drivers}, \"find\": [{}]}}",
            links.join(", "),
            points.join(", "),
            gears.join(", "),
            find.join(", ")
        );
        with(&text, |placed| {
            let now = super::station::position_now(placed.scene, &placed.at, 0);
            let stations = Stations::slid(now, now - 2.5 * TAU, 40, 1.0);
            same(&format!("seed {seed}"), &both("train", placed, &stations), 1e-9);
        });
    }
}

/// After ten thousand turns every angle is the one that whole numbers give.
#[test]
fn ten_thousand_turns_lose_nothing() {
    with(FAST, |placed| {
        for turn in [0i64, 1, 9_999, -10_000] {
            let from = 360 * turn;
            let table = run(
                placed,
                0,
                &Stations::turned(Angle::Deg(from as f64), Angle::Deg((from + 360) as f64), 120),
                Width::Widest,
            )
            .unwrap();
            let phi = &table.columns[1].values;
            for (i, phi) in phi.iter().enumerate() {
                // −21/40 of the travel, and the half turn by which the pair's phase begins: the
                // angle at 0 is 0.
                let way = (-21 * (from + 3 * i as i64)).rem_euclid(360 * 40) as f64 / 40.0;
                let off = libm::remainder(phi - way.to_radians(), TAU).abs();
                assert!(off < 1e-15 * 8.0, "turn {turn}, {way}: off by {off:e}");
            }
        }
    });
}

/// Newton's method reaches any travel that it is sent to, and agrees with the program.
#[test]
fn newton_is_not_blocked_by_the_length_of_the_way() {
    with(FAST, |placed| {
        let stations = Stations::turned(Angle::Deg(36_000.0), Angle::Deg(36_010.0), 2);
        same("a hundred turns", &both("a hundred turns", placed, &stations), 1e-9);
    });
}

/// Limits exist on any of the turns after which a train's pose recurs.
#[test]
fn limits_are_found_beyond_one_turn() {
    let scene = read(PLANET).unwrap().value;
    let m = Mechanism::new(&scene).unwrap().value;
    let found = limits(&scene, &m, 0).unwrap();
    let ends: Vec<f64> = found.range.ends.iter().flatten().map(|e| e.value.to_degrees()).collect();
    // The position at which |BD| = BC + CD, with OQ turned by φ/4 and QB by −φ/2.
    assert!(
        ends.len() == 2
            && (ends[0] + 659.536_744_354_043_7).abs() < 1e-9
            && (ends[1] - 241.225_814_241_048_6).abs() < 1e-9,
        "{ends:?}"
    );
    let scene = read(FAST).unwrap().value;
    let m = Mechanism::new(&scene).unwrap().value;
    let found = limits(&scene, &m, 0).unwrap();
    assert!(found.range.full() && found.turns == 40 && found.seen == 1, "{found:?}");
    let twelve = FAST.replace("[21, 40]", "[21, 12]");
    let scene = read(&twelve).unwrap().value;
    let found = limits(&scene, &m, 0).unwrap();
    assert_eq!((found.turns, found.seen), (4, 4), "{found:?}");
}
