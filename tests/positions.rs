//! Positions against the data of the scenes: no configuration violates a datum, a displaced joint
//! is detected, followers stay on the side of the cam that the scene names, and the order of
//! entries does not matter.

mod wide;

use hodograph::answer::AnswerValue;
use hodograph::geom::{Point, Vec2};
use hodograph::mechanism::{Demand, Mechanism};
use hodograph::position;
use hodograph::scene::{self, Angle, PointId, Scene, templates};
use hodograph::stated::{Moment, breaches, is_unproven};
use hodograph::sweep::follow::{PoseFollower, course};
use hodograph::sweep::{self, PlacedScene, Stations, TravelEnds, Width};
use hodograph::worked::{Scope, work};
use serde_json::Value as Json;
use wide::every;

/// Templates and reference cases as scenes in JSON, by name.
fn scenes() -> Vec<(String, String)> {
    let mut all: Vec<(String, String)> = templates::list()
        .iter()
        .map(|t| (t.name.to_owned(), templates::get(t.name).unwrap().to_owned()))
        .collect();
    let folder = format!("{}/tests/cases", env!("CARGO_MANIFEST_DIR"));
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|f| f.unwrap().path())
        .filter(|p| p.is_file())
        .collect();
    files.sort();
    for path in files {
        let case: Json = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
        all.push((
            path.file_stem().unwrap().to_string_lossy().into_owned(),
            case["scene"].to_string(),
        ));
    }
    assert!(all.len() > 150, "{}", all.len());
    all
}

/// A scene with its mechanism and configuration; `None` if the scene is refused.
fn placed(scene: &Scene) -> Option<(Mechanism, Demand, position::Configuration)> {
    let mechanism = Mechanism::new(scene).ok()?.value;
    let demand = Demand::of(scene, &mechanism).with_all_positions();
    let at = position::configure(scene, &mechanism, &demand).ok()?.value;
    Some((mechanism, demand, at))
}

#[test]
fn configurations_of_all_scenes_are_proved_at_the_instant_and_on_their_way() {
    let (mut instants, mut positions, mut broken) = (0, 0, Vec::new());
    for (name, text) in scenes().into_iter().step_by(every(6)) {
        let Ok(scene) = scene::read(&text).map(|s| s.value) else { continue };
        let Some((mechanism, _, at)) = placed(&scene) else { continue };
        let found = breaches(&scene, &mechanism, &at, Moment::Instant);
        broken.extend(found.first().map(|b| format!("{name}: {}", b.words.en)));
        instants += 1;
        let moving = course::over_a_turn(&scene);
        let Some((mechanism, demand, at)) =
            placed(&moving).filter(|_| moving.kept_cams().next().is_none())
        else {
            continue;
        };
        for driver in (0..moving.drivers.len()).filter(|d| !moving.is_led(*d)) {
            let follower = PoseFollower::new(&moving, &mechanism, &demand, &at, driver);
            for pose in follower.sweep(24).poses {
                let found = breaches(&moving, &mechanism, &pose.configuration, Moment::Later(&at));
                broken.extend(found.first().map(|b| {
                    format!("{name}, driver {driver} gone on by {}: {}", pose.travel, b.words.en)
                }));
                positions += 1;
            }
        }
    }
    assert!(broken.is_empty(), "{} of {positions}:\n{}", broken.len(), broken.join("\n"));
    assert!(instants > 20 && positions > 500, "{instants} {positions}");
}

/// Points without a place given by the scene: points of contact, and those of links that are at
/// rest in the pose alone.
fn is_stated(scene: &Scene, p: PointId) -> bool {
    scene.carriers(p).next().is_some()
}

#[test]
fn a_joint_that_is_moved_by_a_millionth_of_the_mechanism_is_found() {
    let (mut moved, mut unseen) = (0, Vec::new());
    for (name, text) in scenes().into_iter().step_by(every(3)) {
        let Ok(scene) = scene::read(&text).map(|s| s.value) else { continue };
        let Some((mechanism, _, at)) = placed(&scene) else { continue };
        let by = 1e-6 * at.extent();
        for p in (0..scene.points.len()).map(PointId).filter(|p| is_stated(&scene, *p)) {
            let Some(place) = at.points[p.0] else { continue };
            // A point may move perpendicular to its constraint without a first-order change: of
            // three directions one is not.
            let found = [0.3, 1.4, 2.5].into_iter().any(|way| {
                let mut wrong = at.clone();
                wrong.points[p.0] = Some(place + Vec2::from_angle(way) * by);
                !breaches(&scene, &mechanism, &wrong, Moment::Instant).is_empty()
            });
            moved += 1;
            if !found {
                unseen.push(format!("{name}: {}", scene.point_name(p)));
            }
        }
    }
    assert!(moved > 200, "{moved}");
    assert!(unseen.is_empty(), "{} of {moved} unseen: {unseen:?}", unseen.len());
}

/// The hull of two circles about O (the origin) and Q: the tangent cam in the plane.
struct Hull {
    circles: [(Vec2, f64); 2],
}

impl Hull {
    fn support(&self, n: Vec2) -> f64 {
        self.circles.iter().map(|(c, r)| c.dot(n) + r).fold(f64::MIN, f64::max)
    }

    /// Distance of a place outside: the greatest of its distances from the support lines.
    fn distance(&self, at: Vec2) -> f64 {
        let from = |a: f64| at.dot(Vec2::from_angle(a)) - self.support(Vec2::from_angle(a));
        let start = (0..720)
            .map(|k| k as f64 * std::f64::consts::TAU / 720.0)
            .max_by(|a, b| from(*a).total_cmp(&from(*b)))
            .unwrap();
        let (mut low, mut high) = (start - 0.01, start + 0.01);
        for _ in 0..80 {
            let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if from(a) < from(b) { low = a } else { high = b }
        }
        from(0.5 * (low + high))
    }

    /// Distance along u from `start` at which a round end rests on the hull, on its far side.
    fn held(&self, start: Vec2, u: Vec2, radius: f64) -> f64 {
        let (mut low, mut high) = (0.0, 200.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.distance(start + u * middle) < radius { low = middle } else { high = middle }
        }
        high
    }
}

fn tangent_cam(at: f64) -> Hull {
    Hull { circles: [(Vec2::ZERO, 25.0), (Vec2::from_angle(at) * 30.0, 10.0)] }
}

/// A tangent cam with a follower in a guide at `guide` degrees, at the distance `aside` (mm) from
/// the pivot.
fn on_tangent_cam(
    at: f64,
    guide: f64,
    aside: f64,
    follows: &str,
    more: &str,
    find: &str,
) -> String {
    let (x, y) = (-aside * guide.to_radians().sin(), aside * guide.to_radians().cos());
    format!(
        r#"{{"units": {{"length": "mm", "angle": "rad"}}, "links": {{"1": ["O"], "2": ["O", "Q"]}}, "ground": "1", "points": {{"O": [0, 0]}}, "lengths": {{"OQ": 30}},
        "guides": [{{"pin": "B", "slider": "3", "on": "1", "through": [{x:?}, {y:?}], "angle": "{guide:?} deg"}}],
        "cams": [{{"cam": "2", "follower": "3", {follows}, "at": "E", "profile": [{{"centre": "O", "radius": "25 mm"}}, "tangent", {{"centre": "Q", "radius": "10 mm"}}, "tangent"]}}],
        "driver": {{"link": "2", "angle": {at:?}, "omega": "1 rad/s"}}, "find": [{find}]{more}}}"#
    )
}

fn answer(text: &str, k: usize) -> AnswerValue {
    let scene = scene::read(text).unwrap_or_else(|f| panic!("{f}\n{text}")).value;
    work(&scene, Scope::Questions).unwrap_or_else(|f| panic!("{f}\n{text}")).value.results[k]
        .value()
}

fn place(text: &str, k: usize) -> [f64; 2] {
    match (answer(text, k), answer(text, k + 1)) {
        (AnswerValue::Scalar(x), AnswerValue::Scalar(y)) => [x * 1e3, y * 1e3],
        other => panic!("{other:?}"),
    }
}

/// Texts by which a scene puts the follower on the rising side of its guide, or on the other.
fn sides(guide: f64, rising: bool) -> Vec<(&'static str, String, String)> {
    let u = Vec2::from_angle(guide.to_radians()) * if rising { 60.0 } else { -60.0 };
    let sketch = format!(r#", "sketch": {{"B": [{:?}, {:?}]}}"#, u.x, u.y);
    // Looking along the face at the guide's angle + 90°, the side before the follower's rise is on
    // the right.
    let (square, turned) = if rising { ("left", "right") } else { ("right", "left") };
    vec![
        ("face", format!(r#""face": {{"cam": "{square}"}}"#), String::new()),
        (
            "face",
            format!(r#""face": {{"angle": "{:?} deg", "cam": "{square}"}}"#, guide + 90.0),
            String::new(),
        ),
        (
            "face",
            format!(r#""face": {{"angle": "{:?} deg", "cam": "{turned}"}}"#, guide - 90.0),
            String::new(),
        ),
        ("edge", r#""edge": "B""#.to_owned(), sketch.clone()),
        ("roller", r#""roller": {"pin": "B", "radius": "6 mm"}"#.to_owned(), sketch),
    ]
}

#[test]
fn followers_keep_to_the_side_of_the_cam_that_the_scene_names() {
    let mut checked = 0;
    for (k, guide) in [90.0, 35.0, -110.0].into_iter().enumerate() {
        for step in (0..24).step_by(every(4)) {
            let at = 0.137 + step as f64 * 0.2618;
            for rising in [true, false] {
                for (kind, follows, more) in sides(guide, rising) {
                    let u = Vec2::from_angle(guide.to_radians());
                    let out = if rising { u } else { -u };
                    let aside = if kind == "face" { 0.0 } else { [0.0, 7.0, -5.0][k] };
                    let foot = u.perp() * aside;
                    let reach = |at: f64| match kind {
                        "face" => tangent_cam(at).support(out),
                        "edge" => tangent_cam(at).held(foot, out, 0.0),
                        _ => tangent_cam(at).held(foot, out, 6.0),
                    };
                    let due = foot + out * reach(at);
                    let text =
                        on_tangent_cam(at, guide, aside, &follows, &more, r#""x_B", "y_B", "v_B""#);
                    let [x, y] = place(&text, 0);
                    let off = (Vec2::new(x, y) - due).norm();
                    assert!(
                        off < 1e-7,
                        "{kind} at {at}, guide {guide}, rising {rising}: ({x}, {y}), not {due:?}\n{text}"
                    );
                    let AnswerValue::Vector(v) = answer(&text, 2) else { panic!() };
                    let h = 1e-4;
                    let rate = out * ((reach(at + h) - reach(at - h)) / (2.0 * h));
                    // Differences across a joint of the profile belong to neither side.
                    let bends =
                        (reach(at + h) + reach(at - h) - 2.0 * reach(at)).abs() / (h * h) > 1e3;
                    assert!(
                        bends || (v * 1e3 - rate).norm() < 1e-2,
                        "{kind} at {at}: {v:?}, not {rate:?}\n{text}"
                    );
                    checked += 1;
                }
            }
        }
    }
    assert!(checked > 100, "{checked}");
}

#[test]
fn sweeps_keep_to_that_side() {
    for (kind, follows, more) in sides(90.0, false) {
        let text = on_tangent_cam(0.4, 90.0, 0.0, &follows, &more, r#""y_B", "v_B""#);
        let scene = course::over_a_turn(&scene::read(&text).unwrap().value);
        let mechanism = Mechanism::new(&scene).unwrap().value;
        let run = PlacedScene::new(&scene, &mechanism).unwrap();
        let table = sweep::run(
            &run,
            0,
            &Stations::turned(Angle::Deg(3.0), Angle::Deg(363.0), 24),
            Width::Widest,
        )
        .unwrap();
        assert_eq!(table.rows(), 25, "{kind}");
        for k in 0..25 {
            let at = (3.0 + 15.0 * k as f64).to_radians();
            let radius = if kind == "roller" { 6.0 } else { 0.0 };
            let due = match kind {
                "face" => -tangent_cam(at).support(Vec2::new(0.0, -1.0)),
                _ => -tangent_cam(at).held(Vec2::ZERO, Vec2::new(0.0, -1.0), radius),
            };
            let y = table.columns[1].values[k] * 1e3;
            assert!((y - due).abs() < 1e-7, "{kind} row {k}: {y}, not {due}");
        }
    }
}

/// Positions of a mechanism with lengths other than those of the scene: samples reveal this in a
/// sweep of any kind, which is refused.
#[test]
fn sweeps_are_judged_by_samples() {
    for name in
        ["crank-rocker", "double-butterfly", "slider-crank", "gear-linkage", "class-iii-six-bar"]
    {
        let own = scene::read(scene::templates::get(name).unwrap()).unwrap().value;
        let mechanism = Mechanism::new(&own).unwrap().value;
        let PlacedScene { demand, at, .. } = PlacedScene::new(&own, &mechanism).unwrap();
        let mut stated = own.clone();
        stated.lengths.last_mut().unwrap().value.value *= 1.0 + 1e-6;
        let placed = PlacedScene {
            scene: &stated,
            mechanism: &mechanism,
            demand,
            at,
            ends: TravelEnds::default(),
        };
        let told = sweep::run(
            &placed,
            0,
            &Stations::turned(Angle::Deg(0.0), Angle::Deg(360.0), 90),
            Width::Widest,
        );
        // Rows without a compiled program are refused one by one.
        assert!(told.map_or_else(|f| is_unproven(&f), |table| table.rows() == 0), "{name}");
    }
}

#[test]
fn a_law_goes_out_on_the_side_that_the_scene_names() {
    let law = r#""profile": {"base": "30 mm", "law": [{"rise": "20 mm", "over": "120 deg", "law": "cycloidal"}, {"dwell": "60 deg"}, {"return": "20 mm", "over": "180 deg", "law": "3-4-5"}]}"#;
    let scene = |follows: &str, more: &str, at: f64| {
        format!(
            r#"{{"units": {{"length": "mm"}}, "links": {{"1": ["O"], "2": ["O", "M"]}}, "ground": "1", "points": {{"O": [0, 0]}}, "lengths": {{"OM": 30}},
            "guides": [{{"pin": "B", "slider": "3", "on": "1", "through": [0, 0], "angle": "90 deg"}}], "cams": [{{"cam": "2", "follower": "3", {follows}, {law}}}],
            "driver": {{"link": "2", "angle": "{at:?} deg", "omega": "2 rad/s"}}, "find": ["x_B", "y_B", "v_B", "a_B"]{more}}}"#
        )
    };
    for at in [0.0, 37.0, 100.0, 150.0, 250.0, 355.0] {
        for (up, down, more) in [
            (r#""face": {"cam": "left"}"#, r#""face": {"cam": "right"}"#, ["", ""]),
            (
                r#""edge": "B""#,
                r#""edge": "B""#,
                [r#", "sketch": {"B": [0, 50]}"#, r#", "sketch": {"B": [0, -50]}"#],
            ),
        ] {
            let (up, down) = (scene(up, more[0], at), scene(down, more[1], at));
            assert!((place(&up, 0)[1] + place(&down, 0)[1]).abs() < 1e-9, "{at}: {up}");
            for k in [2, 3] {
                let (AnswerValue::Vector(a), AnswerValue::Vector(b)) =
                    (answer(&up, k), answer(&down, k))
                else {
                    panic!()
                };
                assert!((a + b).norm() <= 1e-9 * a.norm(), "{at}: {a:?} {b:?}");
            }
        }
    }
}

/// A cam of constant breadth between two faces: in either order of the two, and with each alone,
/// the mechanism is the same.
#[test]
fn a_yoke_on_a_cam_of_constant_breadth_is_one_mechanism_in_any_order() {
    let arcs = r#"[{"centre": "O", "radius": "10 mm"}, {"centre": "V", "radius": "70 mm"}, {"centre": "W", "radius": "10 mm"},
        {"centre": "O", "radius": "70 mm"}, {"centre": "V", "radius": "10 mm"}, {"centre": "W", "radius": "70 mm"}]"#;
    let cam = |face: &str| {
        format!(
            r#"{{"cam": "2", "follower": "3", "face": {{"angle": "0 deg", {face}}}, "profile": {arcs}}}"#
        )
    };
    let scene = |cams: &[&str], at: f64| {
        let corner = |a: f64| format!(r#"["60 mm*cos({a:?} deg)", "60 mm*sin({a:?} deg)"]"#);
        let cams: Vec<String> = cams.iter().map(|face| cam(face)).collect();
        format!(
            r#"{{"links": {{"1": ["O"], "2": ["O", "V", "W"]}}, "ground": "1", "points": {{"O": [0, 0], "V": {}, "W": {}}},
            "guides": [{{"slider": "3", "on": "1", "angle": "90 deg"}}], "cams": [{}], "driver": {{"link": "2", "omega": "4 rad/s"}}, "find": ["x_F", "y_F", "v_F", "a_F"]}}"#,
            corner(at + 60.0),
            corner(at),
            cams.join(", ")
        )
    };
    let (below, above) = (r#""cam": "left""#, r#""cam": "right""#);
    let (and_above, and_below) =
        (r#""cam": "right", "offset": "80 mm""#, r#""cam": "left", "offset": "-80 mm""#);
    for at in [5.0, 15.0, 47.0, 100.0, 200.0, 290.0] {
        let y = |cams: &[&str]| place(&scene(cams, at), 0)[1];
        let (low, high) = (y(&[below]), y(&[above]));
        assert!((high - low - 80.0).abs() < 1e-9, "{at}: {low} {high}");
        for cams in [[below, and_above], [and_above, below]] {
            assert!((y(&cams) - low).abs() < 1e-9, "{at}");
        }
        for cams in [[above, and_below], [and_below, above]] {
            assert!((y(&cams) - high).abs() < 1e-9, "{at}");
        }
    }
}

/// Pseudo-random numbers, the same in every run.
struct Dice(u64);

impl Dice {
    fn below(&mut self, n: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % n
    }

    fn shuffled<T>(&mut self, mut list: Vec<T>) -> Vec<T> {
        for i in (1..list.len()).rev() {
            list.swap(i, self.below(i + 1));
        }
        list
    }
}

/// The scene with its entries in another order; lists with a meaningful order (points of a link,
/// pieces of a profile, wheels of a belt) keep it.
fn in_another_order(scene: &Json, dice: &mut Dice) -> Json {
    let Json::Object(keys) = scene else { panic!("a scene is an object") };
    // A balancing moment has the number of its driver.
    let numbered = scene["find"].to_string().contains("_b");
    let mixed = |key: &str, value: &Json, dice: &mut Dice| match (key, value) {
        ("driver", drivers) if numbered => drivers.clone(),
        (
            "parameters" | "links" | "points" | "lengths" | "side" | "sketch" | "units",
            Json::Object(entries),
        ) => Json::Object(
            dice.shuffled(entries.iter().map(|(k, v)| (k.clone(), v.clone())).collect())
                .into_iter()
                .collect(),
        ),
        (
            "guides" | "cams" | "gears" | "wheels" | "ropes" | "belts" | "chains" | "find"
            | "driver",
            Json::Array(entries),
        ) => Json::Array(dice.shuffled(entries.clone())),
        (_, other) => other.clone(),
    };
    let entries = keys.iter().map(|(k, v)| (k.clone(), mixed(k, v, dice))).collect();
    Json::Object(dice.shuffled(entries).into_iter().collect())
}

/// The answers by the texts of the questions; `None` if the scene is refused.
fn answers(text: &str) -> Option<Vec<(String, AnswerValue)>> {
    let scene = scene::read(text).ok()?.value;
    let worked = work(&scene, Scope::Questions).ok()?.value;
    let mut all: Vec<(String, AnswerValue)> =
        worked.results.iter().map(|r| (scene.find[r.find].text.clone(), r.value())).collect();
    all.sort_by(|a, b| a.0.cmp(&b.0));
    Some(all)
}

#[test]
fn the_order_of_entries_does_not_matter() {
    let mut dice = Dice(7);
    let mut compared = 0;
    for (name, text) in scenes().into_iter().step_by(every(4)) {
        let Some(first) = answers(&text) else { continue };
        let scene: Json = serde_json::from_str(&text).unwrap_or_else(|e| panic!("{name}: {e}"));
        for _ in 0..2 {
            let mixed = in_another_order(&scene, &mut dice).to_string();
            let other = answers(&mixed)
                .unwrap_or_else(|| panic!("{name} is refused in another order:\n{mixed}"));
            assert_eq!(first.len(), other.len(), "{name}:\n{mixed}");
            for ((find, a), (_, b)) in first.iter().zip(&other) {
                let (off, size) = match (a, b) {
                    (AnswerValue::Scalar(a), AnswerValue::Scalar(b)) => ((a - b).abs(), a.abs()),
                    (AnswerValue::Vector(a), AnswerValue::Vector(b)) => {
                        ((*a - *b).norm(), a.norm())
                    }
                    (AnswerValue::Point(a), AnswerValue::Point(b)) => {
                        (a.distance(*b), a.distance(Point::ORIGIN))
                    }
                    (a, b) => panic!("{name}, {find}: {a:?} {b:?}"),
                };
                assert!(
                    off <= 1e-6 * size.max(1e-6),
                    "{name}, {find}: {a:?}, in another order {b:?}\n{mixed}"
                );
                compared += 1;
            }
        }
    }
    assert!(compared > 100, "{compared}");
}

#[test]
fn parameters_may_name_later_ones_but_not_themselves() {
    let scene = |parameters: &str| {
        format!(
            r#"{{"parameters": {{{parameters}}}, "links": {{"1": ["O"], "2": ["O", "A"]}}, "ground": "1", "points": {{"O": [0, 0]}}, "lengths": {{"OA": "b"}},
            "driver": {{"link": "2", "angle": "10 deg", "omega": "1 rad/s"}}, "find": ["v_A"]}}"#
        )
    };
    assert_eq!(
        answer(&scene(r#""b": "2*a", "a": "3 mm""#), 0),
        answer(&scene(r#""a": "3 mm", "b": "2*a""#), 0)
    );
    let faults = scene::read(scene(r#""b": "2*a", "a": "b/2", "c": "a""#)).unwrap_err();
    let circular: Vec<&str> = faults
        .list
        .iter()
        .filter(|d| d.code == "circular-parameter")
        .map(|d| d.message.en.as_str())
        .collect();
    assert_eq!(circular.len(), 3, "{faults}");
    assert!(circular[0].contains("`b` rests on itself, by way of a"), "{circular:?}");
}
