//! Inversions: each is a scene with the same relative motion of links, and the types follow
//! Grashof's rule.

use hodograph::answer::MotionSource;
use hodograph::inversions::{Inversion, inversions};
use hodograph::mechanism::{Demand, Level, Mechanism};
use hodograph::position;
use hodograph::problem;
use hodograph::scene::{self, LinkId, Scene, templates};
use hodograph::sweep::extreme::{Grashof, MotionLimits, limits};
use hodograph::sweep::{self, PlacedScene, TravelEnds};

mod wide;

fn template(name: &str, values: &[(&str, &str)]) -> Scene {
    scene::read(templates::instantiate(name, values).unwrap()).unwrap().value
}

fn all(scene: &Scene) -> Vec<Inversion> {
    inversions(scene).unwrap_or_else(|f| panic!("{f}")).value
}

#[test]
fn links_move_against_one_another_as_before() {
    let names = [
        "crank-rocker",
        "drag-link",
        "slider-crank",
        "offset-slider-crank",
        "slotted-lever",
        "whitworth",
        "watt-six-bar",
        "shaper",
        "elliptic-trammel",
        "oscillating-cylinder",
        "scotch-yoke",
    ];
    assert!(relative_motion_is_kept(&names) > 40);
}

#[test]
fn wheels_roll_on_one_another_as_before() {
    let names = [
        "planetary-gear",
        "sun-and-planet",
        "geared-five-bar",
        "hypocycloid",
        "wheel-in-groove",
        "rack-stroke-doubler",
    ];
    assert_eq!(relative_motion_is_kept(&names), 4 + 5 + 5 + 3 + 4 + 5);
}

/// A sweep, which follows in its own steps, reaches all positions between the limits of a driver,
/// and none beyond them. Always examined are a linkage with another assembly close beyond a limit,
/// and one with limits of several joints close to one another, or behind a link on three legs.
#[test]
fn a_limit_is_where_a_sweep_ends() {
    const ALWAYS: [&str; 2] = ["gear-linkage", "jansen-leg"];
    let list = templates::list();
    let names = list.iter().map(|t| t.name).step_by(wide::every(8));
    let mut ended = 0;
    for name in names.filter(|n| !ALWAYS.contains(n)).chain(ALWAYS) {
        let scene = template(name, &[]);
        let whole = problem::whole_motion(scene.clone()).value;
        if let Ok(limits) = limits(&whole, &Mechanism::new(&whole).unwrap().value, 0) {
            ended += swept_to_the_ends(&whole, &limits, name);
        }
        for i in inversions(&scene).map_or_else(|_| Vec::new(), |found| found.value) {
            ended += swept_to_the_ends(&i.scene, &i.limits, &i.text);
        }
    }
    assert!(ended > 240 / wide::every(8), "{ended}");
}

/// Compares the limits of the first driver with the rows of a sweep, and returns their number.
fn swept_to_the_ends(scene: &Scene, limits: &MotionLimits, name: &str) -> usize {
    let m = Mechanism::new(scene).unwrap().value;
    let demand = Demand::of(scene, &m).with_all_positions();
    // Without a position of its driver a scene has limits, but no pose.
    let Ok(at) = position::configure(scene, &m, &demand) else { return 0 };
    let at = at.value;
    let placed = PlacedScene { scene, mechanism: &m, demand, at, ends: TravelEnds::default() };
    let missing = |values: Vec<f64>| {
        let rows = sweep::of_values(&placed, 0, values.clone()).unwrap().columns.remove(0).values;
        values.into_iter().filter(|v| !rows.contains(v)).collect::<Vec<_>>()
    };
    let (range, turns) = (&limits.range, scene.drivers[0].kind.turns());
    let unit = if turns { 1.0 } else { placed.at.extent() };
    if turns && range.full() {
        // Not in a dead centre, where a question may have no answer.
        let turn =
            (0..24).map(|k| range.now + std::f64::consts::TAU * (f64::from(k) + 0.37) / 24.0);
        assert_eq!(missing(turn.collect()), Vec::<f64>::new(), "in a full turn\n{name}");
    }
    for (end, sign) in range.ends.iter().zip([-1.0, 1.0]) {
        let Some(end) = end else { continue };
        let way = end.value - range.now;
        let mut within: Vec<f64> = (1..24).map(|k| range.now + way * f64::from(k) / 24.0).collect();
        within.push(end.value - sign * (1e-6 * unit).min(0.5 * way.abs()));
        within.sort_by(f64::total_cmp);
        let none = Vec::<f64>::new();
        assert_eq!(missing(within), none, "up to the limit at {}\n{name}", end.value);
        let beyond = vec![end.value + sign * 1e-6 * unit];
        assert_eq!(missing(beyond.clone()), beyond, "beyond the limit at {}\n{name}", end.value);
    }
    range.ends.iter().flatten().count()
}

/// Barrels and rods are treated like other links, and several drivers are kept.
#[test]
fn cylinders_and_several_drivers_are_kept() {
    assert_eq!(relative_motion_is_kept(&["excavator"]), 12);
    assert_eq!(relative_motion_is_kept(&["five-bar"]), 5);
    for i in all(&template("excavator", &[])) {
        let rates: f64 = i.scene.drivers.iter().map(|d| d.rate.value).sum();
        assert!((rates - 0.51).abs() < 1e-12 && i.scene.drivers.len() == 3, "{}", i.text);
    }
}

/// A cam of one circle touches its follower with any link as ground: faces, rollers and edges, at
/// any angle.
#[test]
fn cams_of_one_circle_are_kept() {
    assert_eq!(
        relative_motion_is_kept(&[
            "cam-eccentric",
            "cam-centres",
            "eccentric-three-ways",
            "flat-face-mistake"
        ]),
        4 * 3
    );
    for angle in [-70, 15, 128, 200] {
        let mut scene: serde_json::Value =
            serde_json::from_str(templates::get("cam-eccentric").unwrap()).unwrap();
        scene["driver"]["angle"] = format!("{angle} deg").into();
        for side in ["left", "right"] {
            scene["cams"][0]["face"]["cam"] = side.into();
            let Ok(read) = scene::read(scene.to_string()) else { continue };
            let Ok(found) = inversions(&read.value) else { continue };
            for i in found.value {
                let c = &i.scene.cams[0];
                let (centre, radius) = c.circle.unwrap();
                assert_eq!(c.left, side == "left", "{}", i.text);
                let at = &i.worked.configuration;
                let hodograph::position::Path::Line { through, direction } =
                    at.guides[c.contact.unwrap().0].unwrap()
                else {
                    panic!()
                };
                // The centre's parallel is where it was, and the face through C is at the distance
                // of its radius.
                assert!(
                    direction.cross(at.points[centre.0].unwrap() - through).abs() < 1e-12,
                    "{}",
                    i.text
                );
                let own = at.points[c.follows.point().0].unwrap();
                assert!(
                    (direction.cross(through - own).abs() - radius).abs() < 1e-12,
                    "{}",
                    i.text
                );
            }
        }
    }
}

/// Relative angular velocities are those of the scene, up to a common factor: the driver's. Returns
/// the number of inversions compared.
fn relative_motion_is_kept(names: &[&str]) -> usize {
    let mut seen = 0;
    for name in names {
        let scene = template(name, &[]);
        let found = all(&scene);
        assert!(
            found.len() + 1 >= scene.links.len(),
            "{name}: {} of {}",
            found.len(),
            scene.links.len()
        );
        let omegas = |i: &Inversion| -> Vec<Option<f64>> {
            let of = |l: &scene::Link| {
                let id = LinkId(i.scene.links.iter().position(|m| m.name == l.name)?);
                if id == i.scene.ground {
                    Some(0.0)
                } else {
                    i.worked.solution.turning(Level::Velocity, id)
                }
            };
            scene.links.iter().map(of).collect()
        };
        let original = found.iter().find(|i| i.original).unwrap();
        let base = omegas(original);
        for i in &found {
            let own = omegas(i);
            let mut pairs = Vec::new();
            for a in 0..base.len() {
                for b in 0..a {
                    if let (Some(p), Some(q), Some(r), Some(s)) = (base[a], base[b], own[a], own[b])
                    {
                        pairs.push((p - q, r - s));
                    }
                }
            }
            let largest =
                pairs.iter().copied().max_by(|a, b| a.0.abs().total_cmp(&b.0.abs())).unwrap();
            let factor = largest.1 / largest.0;
            assert!(scene.drivers.len() == 1 || (factor - 1.0).abs() < 1e-9, "{name}: {factor}");
            for (p, q) in &pairs {
                assert!(
                    (q - p * factor).abs() < 1e-9 * largest.1.abs(),
                    "{name} {}: {p} {q} {factor}",
                    i.text
                );
            }
            // The file and the scene agree.
            assert_eq!(scene::read(&i.text).unwrap().value.links.len(), i.scene.links.len());
            seen += 1;
        }
    }
    seen
}

#[test]
fn types_follow_grashofs_rule() {
    let kinds = |scene: &Scene| -> Vec<(String, Grashof)> {
        all(scene)
            .iter()
            .map(|i| (i.scene.link_name(i.scene.ground).to_owned(), i.limits.grashof.unwrap().0))
            .collect()
    };
    // s + l < p + q: the shortest link fixed gives a double crank, its neighbours crank-rockers,
    // its opposite a double rocker.
    let scene = template("crank-rocker", &[]);
    for (ground, kind) in kinds(&scene) {
        let expected = match ground.as_str() {
            "1" => Grashof::DoubleCrank,
            "3" => Grashof::DoubleRocker,
            _ => Grashof::CrankRocker,
        };
        assert_eq!(kind, expected, "link {ground}");
    }
    // s + l > p + q: all are triple rockers.
    let scene = template(
        "crank-rocker",
        &[("l_BC", "190"), ("l_AD", "330"), ("l_AB", "130"), ("l_CD", "150")],
    );
    assert!(kinds(&scene).iter().all(|(_, k)| *k == Grashof::TripleRocker));
}

/// The names in textbooks of the inversions of chains with slides, for each ground.
#[test]
fn inversions_of_chains_with_slides_are_named() {
    for (name, wanted) in [
        (
            "slider-crank",
            [("1", "转动导杆"), ("2", "曲柄摇块"), ("3", "移动导杆"), ("4", "曲柄滑块")].as_slice(),
        ),
        ("slotted-lever", &[("4", "摆动导杆"), ("3", "曲柄滑块")]),
        ("oscillating-cylinder", &[("4", "曲柄摇块"), ("1", "导杆机构")]),
        ("scotch-yoke", &[("4", "正弦机构"), ("1", "双转块"), ("2", "正弦机构"), ("3", "双滑块")]),
        ("elliptic-trammel", &[("4", "双滑块"), ("2", "双转块"), ("1", "正弦机构")]),
        ("oldham-coupling", &[("1", "双转块"), ("3", "双滑块")]),
    ] {
        let made = all(&template(name, &[]));
        for (ground, words) in wanted {
            let of = |i: &&Inversion| i.scene.link_name(i.scene.ground) == *ground;
            let Some(i) = made.iter().find(of) else { panic!("{name}: link {ground}") };
            let said = hodograph::report::inversions::line(i, scene::Lang::Zh);
            assert!(said.contains(words), "{name}: {said}");
        }
    }
}

#[test]
fn what_cannot_be_inverted_is_reported() {
    for (name, code, told) in [
        ("cam-valve-train", "inversion-pairs", "touched piece"),
        ("cam-offset-roller", "inversion-pairs", "touched piece"),
    ] {
        let faults = inversions(&template(name, &[])).map(|_| ()).unwrap_err();
        let one = faults
            .list
            .iter()
            .find(|d| d.code == code && d.help.is_some())
            .unwrap_or_else(|| panic!("{name}: {faults}"));
        // Each pair has its own place in the file.
        assert!(
            one.message.en.contains(told) && (one.span.is_some() || code != "inversion-pairs"),
            "{name}: {one}"
        );
        assert!(faults.list.iter().all(|d| d.english_in_chinese().is_none()));
    }
}

/// Collected cases are inverted or refused, including one with a translating body, where the driver
/// of an inversion can hardly move.
#[test]
fn collected_cases_are_inverted() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/cases");
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|f| f.unwrap().path()).collect();
    files.sort();
    let mut some: Vec<_> = files.iter().step_by(wide::every(16).max(4)).cloned().collect();
    some.push(format!("{folder}/hit-7.17.json").into());
    let inverted = |file: &std::path::PathBuf| {
        let case: serde_json::Value =
            serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
        scene::read(case["scene"].to_string()).is_ok_and(|s| inversions(&s.value).is_ok())
    };
    let count = some.iter().filter(|f| inverted(f)).count();
    assert!(count * 2 > some.len(), "{count}");
}
