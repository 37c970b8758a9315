//! Belts and chains: ratios by Willis, motions compared with closed formulas and their differences,
//! the compiled sweep over many turns, mobility as counted in books, inversions, and messages on
//! impossible belts.

use hodograph::answer::AnswerValue;
use hodograph::centres::{CentrePlace, centres};
use hodograph::diag::{Faults, Severity};
use hodograph::geom::{Point, Vec2};
use hodograph::mechanism::Mechanism;
use hodograph::notation::Notation;
use hodograph::plan::TermKind;
use hodograph::plan::text::PlanWriter;
use hodograph::report;
use hodograph::scene::build::{Belt, Builder, Driver, deg, mm, rad_per_s};
use hodograph::scene::{self, DiagramKind, Lang, Scene, templates};
use hodograph::sweep::{self, PlacedScene, Stations, Width, extreme, station};
use hodograph::trains::{given, trains};
use hodograph::worked::{Scope, Worked, work};
use std::f64::consts::TAU;

pub fn read(text: &str) -> Scene {
    scene::read(text).unwrap_or_else(|f| panic!("{f}\n{text}")).value
}

pub fn solved(scene: &Scene) -> Worked {
    let worked = work(scene, Scope::Figure).unwrap_or_else(|f| panic!("{f}")).value;
    assert!(worked.unanswered.is_empty(), "{:?}", worked.unanswered);
    for r in &worked.results {
        assert!(
            r.agreement.is_some_and(|a| a.holds()),
            "{}: {:?}",
            scene.find[r.find].text,
            r.agreement
        );
    }
    worked
}

fn value(scene: &Scene, worked: &Worked, find: &str) -> AnswerValue {
    let i = scene.find.iter().position(|f| f.text == find).unwrap();
    worked.results.iter().find(|r| r.find == i).unwrap_or_else(|| panic!("{find}")).computed
}

pub fn scalar(scene: &Scene, worked: &Worked, find: &str) -> f64 {
    match value(scene, worked, find) {
        AnswerValue::Scalar(s) => s,
        other @ (AnswerValue::Vector(_) | AnswerValue::Point(_)) => panic!("{find} = {other:?}"),
    }
}

pub fn vector(scene: &Scene, worked: &Worked, find: &str) -> Vec2 {
    match value(scene, worked, find) {
        AnswerValue::Vector(v) => v,
        other @ (AnswerValue::Scalar(_) | AnswerValue::Point(_)) => panic!("{find} = {other:?}"),
    }
}

pub fn near(found: f64, wanted: f64, what: &str) {
    assert!((found - wanted).abs() < 1e-9 * wanted.abs().max(1.0), "{what}: {found}, not {wanted}");
}

/// A pulley of link 3 about O drives one of link 4 about P, the end of the arm 2, by an open or a
/// crossed belt.
fn on_arm(crossed: bool, radii_mm: [f64; 2]) -> Scene {
    let [a, b] = radii_mm;
    read(&format!(
        r#"{{"units": {{"length": "mm"}}, "links": {{"1": ["O"], "2": ["O", "P"], "3": ["O", "E"], "4": ["P", "B"]}}, "ground": "1",
        "points": {{"O": [0, 0], "P": [120, 50], "B": [150, 60], "E": [-20, 15]}},
        "belts": [{{"pulleys": ["3", "4"], "centres": ["O", "P"], "radii": [{a:?}, {b:?}], "crossed": {crossed}}}],
        "driver": [{{"link": "2", "omega": "5 rad/s", "alpha": "2 rad/s^2"}}, {{"link": "3", "omega": "-7 rad/s", "alpha": "3 rad/s^2"}}],
        "find": ["v_B", "a_B", "omega_4", "alpha_4", "v_M3", "v_N4", "a_M3", "a_N4"]}}"#
    ))
}

/// The place of B at a time, with arm and pulley turned by the angles of Willis' formula.
fn b_at(crossed: bool, [a, b]: [f64; 2], t: f64) -> Vec2 {
    let turned = |omega: f64, alpha: f64| omega * t + 0.5 * alpha * t * t;
    let (arm, first) = (turned(5.0, 2.0), turned(-7.0, 3.0));
    let ratio = if crossed { -a / b } else { a / b };
    let second = arm + ratio * (first - arm);
    Vec2::new(0.12, 0.05).rotate_by(Vec2::from_angle(arm))
        + Vec2::new(0.03, 0.01).rotate_by(Vec2::from_angle(second))
}

#[test]
fn a_belt_on_an_arm_moves_as_willis_says() {
    for (crossed, radii) in
        [(false, [30.0, 45.0]), (true, [30.0, 45.0]), (false, [40.0, 40.0]), (true, [50.0, 20.0])]
    {
        let scene = on_arm(crossed, radii);
        let worked = solved(&scene);
        let what = format!("{radii:?}, crossed {crossed}");
        let ratio = radii[0] / radii[1] * if crossed { -1.0 } else { 1.0 };
        near(scalar(&scene, &worked, "omega_4"), 5.0 + ratio * (-7.0 - 5.0), &what);
        near(scalar(&scene, &worked, "alpha_4"), 2.0 + ratio * (3.0 - 2.0), &what);
        // Fourth-order differences of the closed formula.
        let (h, at) = (1e-3, |k: f64| b_at(crossed, radii, k * 1e-3));
        let v =
            (at(1.0) - at(-1.0)) * (8.0 / (12.0 * h)) - (at(2.0) - at(-2.0)) * (1.0 / (12.0 * h));
        let a = ((at(1.0) + at(-1.0)) * 16.0 - (at(2.0) + at(-2.0)) - at(0.0) * 30.0)
            * (1.0 / (12.0 * h * h));
        let (off_v, off_a) = (
            (vector(&scene, &worked, "v_B") - v).norm(),
            (vector(&scene, &worked, "a_B") - a).norm(),
        );
        assert!(off_v < 1e-6 && off_a < 1e-5, "{what}: {off_v}, {off_a}");
    }
}

/// The strand neither stretches nor slips: its ends have the same speed along it, and it touches
/// both wheels.
#[test]
fn both_ends_of_a_strand_run_along_it_at_one_speed() {
    for (crossed, radii) in [(false, [30.0, 45.0]), (true, [30.0, 45.0]), (false, [40.0, 40.0])] {
        let scene = on_arm(crossed, radii);
        let worked = solved(&scene);
        let place = |name: &str| {
            worked.configuration.points[scene.points.iter().position(|p| p.name == name).unwrap()]
                .unwrap()
        };
        let (m, n, o, p): (Point, Point, Point, Point) =
            (place("M"), place("N"), place("O"), place("P"));
        let along = (n - m).unit().unwrap();
        near((m - o).norm(), radii[0] / 1e3, "radius");
        near((n - p).norm(), radii[1] / 1e3, "radius");
        near(along.dot(m - o), 0.0, "tangent");
        near(along.dot(n - p), 0.0, "tangent");
        near((m - o).dot(n - p).signum(), if crossed { -1.0 } else { 1.0 }, "side");
        near(
            along.dot(vector(&scene, &worked, "v_M3")),
            along.dot(vector(&scene, &worked, "v_N4")),
            "speed along the strand",
        );
    }
}

/// Between fixed axes both ends of a strand have the same velocity: it is written so, and no
/// sliding is sought. On a turning arm they differ by its angular velocity.
#[test]
fn no_sliding_of_a_belt_is_sought_between_axes_that_stand() {
    let apart = |scene: &Scene| {
        let plan = solved(scene).plan;
        plan.terms(DiagramKind::Velocity).filter(|t| t.kind == TermKind::Roll).count()
    };
    let standing = read(templates::get("belt-crank-rocker").unwrap());
    assert_eq!(apart(&standing), 0);
    assert_eq!(apart(&on_arm(false, [30.0, 45.0])), 1);
    let worked = solved(&standing);
    for (lang, words) in
        [(Lang::En, "ends of a strand, without slip"), (Lang::Zh, "带（链）段两端的点，不打滑")]
    {
        let w = PlanWriter {
            scene: &standing,
            plan: &worked.plan,
            notation: &Notation::of_language(lang),
            lang,
        };
        let told = report::plan::text(&standing, &worked.mechanism, &w, None);
        assert!(
            told.contains("v_N3 = v_M2") && told.contains(words) && !told.contains("v_N3M2"),
            "{told}"
        );
    }
}

/// The limit of the crank-rocker behind the belt, by two circles, over the five turns after which
/// the pose repeats.
#[test]
fn the_sweep_keeps_the_ratio_over_many_turns() {
    let text = templates::get("belt-crank-rocker").unwrap();
    let scene =
        read(&scene::edit::with_find(text, &["x_C", "y_C", "x_M", "y_M", "omega_3"]).unwrap());
    let mechanism = Mechanism::new(&scene).unwrap().value;
    let placed = PlacedScene::new(&scene, &mechanism).unwrap();
    let (now, per_value) = (
        station::position_now(&scene, &placed.at, 0),
        station::angle_per_value(&scene, &placed.at, 0),
    );
    let stations = Stations::slid(now, now + 50.0 * TAU, 1000, per_value);
    let table = sweep::run(&placed, 0, &stations, Width::Widest).unwrap();
    assert!(!table.notes.iter().any(|d| d.code == "no-kernel"), "{:?}", table.notes);
    let column = |name: &str| {
        &table
            .columns
            .iter()
            .find(|c| c.name == name)
            .unwrap_or_else(|| panic!("no column {name}"))
            .values
    };
    let start = column("phi_2")[0];
    for k in 0..table.rows() {
        let crank = (60.0f64).to_radians() + 0.4 * (column("phi_2")[k] - start);
        let (b, d) = (Vec2::from_angle(crank) * 0.07, Vec2::new(0.26, 0.0));
        let (line, l) = ((d - b).unit().unwrap(), (d - b).norm());
        let along = (0.23 * 0.23 - 0.18 * 0.18 + l * l) / (2.0 * l);
        let c = b + line * along + line.perp() * (0.23f64 * 0.23 - along * along).sqrt();
        assert!(
            (column("x_C")[k] - c.x).abs() < 1e-9 && (column("y_C")[k] - c.y).abs() < 1e-9,
            "row {k}: {c:?}"
        );
        near(column("x_M")[k], column("x_M")[0], "the strand stands still on ground");
        near(column("omega_3")[k], 10.0, "omega_3");
    }
    let found = extreme::limits(&scene, &mechanism, 0).unwrap_or_else(|f| panic!("{f}"));
    assert!(format!("{found:?}").contains("turns: 5"), "{found:?}");
}

#[test]
fn sprockets_turn_as_their_teeth_say() {
    let scene = read(
        r#"{"units": {"length": "mm"}, "links": {"1": ["O", "A", "B"], "2": ["O"], "3": ["A"], "4": ["B"]}, "ground": "1",
        "points": {"O": [0, 0], "A": [150, 140], "B": [260, -10]},
        "chains": [{"sprockets": ["2", "3", "4"], "centres": ["O", "A", "B"], "teeth": [19, 25, 38], "pitch": 9.525, "reversed": ["3"]}],
        "driver": {"link": "2", "omega": "10 rad/s", "alpha": "4 rad/s^2"}, "find": ["omega_3", "omega_4", "alpha_4", "v_M2"]}"#,
    );
    let worked = solved(&scene);
    near(scalar(&scene, &worked, "omega_3"), -10.0 * 19.0 / 25.0, "omega_3");
    near(scalar(&scene, &worked, "omega_4"), 10.0 * 19.0 / 38.0, "omega_4");
    near(scalar(&scene, &worked, "alpha_4"), 4.0 * 19.0 / 38.0, "alpha_4");
    near(
        vector(&scene, &worked, "v_M2").norm(),
        19.0 * 0.009525 * 10.0 / TAU,
        "the chain's speed: z p n",
    );
}

#[test]
fn a_belt_counts_as_a_higher_pair() {
    let scene = read(templates::get("belt-crank-rocker").unwrap());
    let mobility = Mechanism::new(&scene).unwrap().value.mobility;
    assert_eq!((mobility.moving, mobility.lower, mobility.higher, mobility.freedom), (4, 5, 1, 1));
}

/// With any link as ground, the relative rotations stay the same, including the arm of the belt.
#[test]
fn inversions_keep_the_belt() {
    let scene = on_arm(true, [30.0, 45.0]);
    let found = hodograph::inversions::inversions(&scene).unwrap_or_else(|f| panic!("{f}")).value;
    assert!(found.len() >= 3, "{}", found.len());
    for i in &found {
        assert!(i.text.contains("\"belts\"") && i.text.contains("\"reversed\""), "{}", i.text);
    }
}

#[test]
fn a_program_builds_a_belt() {
    let builder = Builder::new()
        .link("1", ["O", "A"])
        .link("2", ["O"])
        .link("3", ["A", "B"])
        .ground("1")
        .length("OA", mm(300.0))
        .length("AB", mm(50.0))
        .belt(
            Belt::round(&["2", "3"], &["O", "A"], &[mm(40.0), mm(80.0)])
                .crossed(true)
                .at(&["S", "T"])
                .phase(deg(0.0)),
        )
        .driver(Driver::turning("2").omega(rad_per_s(6.0)))
        .find(["omega_3", "v_S2"]);
    let scene = builder.build().unwrap_or_else(|f| panic!("{f}\n{}", builder.json())).value;
    near(scalar(&scene, &solved(&scene), "omega_3"), -3.0, "omega_3");
    let chain = Builder::new().belt(Belt::chain(&["2", "3"], &["O", "A"], &[17, 34], mm(12.7)));
    assert!(chain.json().contains("\"chains\""), "{}", chain.json());
}

/// An arm moved by a belt is found with its rod and rocker: these are named where they stop it.
#[test]
fn a_limit_names_the_links_that_a_belt_moves() {
    let scene = read(
        r#"{"units": {"length": "mm"}, "links": {"1": ["O", "D"], "2": ["O", "P"], "3": ["O"], "4": ["P", "B"], "5": ["B", "D"]}, "ground": "1",
        "points": {"O": [0, 0], "P": [120, 50], "B": [170, 60], "D": [260, -30]},
        "belts": [{"pulleys": ["3", "4"], "centres": ["O", "P"], "radii": [30, 45]}],
        "driver": {"link": "3", "omega": "-7 rad/s", "alpha": "3 rad/s^2"}, "find": ["v_B", "a_B", "omega_4", "alpha_4", "v_M3", "v_N4"]}"#,
    );
    solved(&scene);
    let mechanism = Mechanism::new(&scene).unwrap().value;
    let limits = extreme::limits(&scene, &mechanism, 0).unwrap_or_else(|f| panic!("{f}"));
    let ends: Vec<_> = limits.range.ends.iter().flatten().collect();
    assert!(!ends.is_empty() && ends.iter().all(|e| !e.links.is_empty()), "{ends:?}");
}

fn errors(f: &Faults) -> Vec<&'static str> {
    f.list.iter().filter(|d| d.severity == Severity::Error).map(|d| d.code).collect()
}

#[test]
fn belts_that_cannot_be_are_reported() {
    let belts = |entry: &str| {
        format!(
            r#"{{"units": {{"length": "mm"}}, "links": {{"1": ["O", "A", "B"], "2": ["O"], "3": ["A"], "4": ["B", "C"], "5": ["C"]}}, "ground": "1",
            "points": {{"O": [0, 0], "A": [200, 0], "B": [100, 150], "C": [120, 150]}}, {entry},
            "driver": [{{"link": "2", "omega": "1 rad/s"}}, {{"link": "4", "omega": "1 rad/s"}}, {{"link": "5", "against": "4", "omega": "1 rad/s"}}], "find": ["omega_3"]}}"#
        )
    };
    for (entry, wanted) in [
        (r#""belts": [{"pulleys": ["2"], "centres": ["O"], "radii": [20]}]"#, "wrong-count"),
        (
            r#""belts": [{"pulleys": ["2", "3"], "centres": ["O", "A"], "radii": [20]}]"#,
            "wrong-count",
        ),
        (
            r#""belts": [{"pulleys": ["2", "3"], "centres": ["O", "A"], "radii": [20, -3]}]"#,
            "not-positive",
        ),
        (
            r#""belts": [{"pulleys": ["2", "5"], "centres": ["O", "C"], "radii": [20, 30]}]"#,
            "belt-arm",
        ),
        (
            r#""belts": [{"pulleys": ["2", "3"], "centres": ["O", "A"], "radii": [120, 90]}]"#,
            "belt-overlap",
        ),
        (
            r#""belts": [{"pulleys": ["2", "3"], "centres": ["O", "B"], "radii": [20, 30]}]"#,
            "not-on-link",
        ),
        (
            r#""belts": [{"pulleys": ["2", "3"], "centres": ["O", "A"], "radii": [20, 30], "crossed": 1}]"#,
            "wrong-type",
        ),
        (
            r#""belts": [{"pulleys": ["2", "3"], "centres": ["O", "A"], "radii": [20, 30], "at": ["M"]}]"#,
            "wrong-count",
        ),
        (
            r#""belts": [{"pulleys": ["2", "3"], "centres": ["O", "A"], "radii": [20, 30], "at": ["M", "C"]}]"#,
            "contact-point",
        ),
        (
            r#""belts": [{"pulleys": ["2", "3"], "centres": ["O", "A"], "radii": [20, 30], "reversed": ["4"]}]"#,
            "unknown-link",
        ),
        (
            r#""belts": [{"pulleys": ["2", "3", "4"], "centres": ["O", "A", "B"], "radii": [20, 30, 20], "crossed": true}]"#,
            "belt",
        ),
        (
            r#""belts": [{"pulleys": ["2", "3", "4"], "centres": ["O", "A", "B"], "radii": [20, 30, 20], "phase": "3 deg"}]"#,
            "phase",
        ),
        (
            r#""chains": [{"sprockets": ["2", "3"], "centres": ["O", "A"], "teeth": [20, 30], "pitch": 8, "reversed": ["3"]}]"#,
            "belt",
        ),
        (
            r#""chains": [{"sprockets": ["2", "3"], "centres": ["O", "A"], "teeth": [20, 30]}]"#,
            "missing-key",
        ),
        (
            r#""chains": [{"sprockets": ["2", "3"], "centres": ["O", "A"], "teeth": [20.5, 30], "pitch": 8}]"#,
            "teeth",
        ),
        (
            r#""chains": [{"sprockets": ["2", "3"], "centres": ["O", "A"], "teeth": [20, 30], "pitch": 8, "crossed": true}]"#,
            "unknown-key",
        ),
    ] {
        let text = belts(entry);
        let found = match scene::read(&text) {
            Err(faults) => errors(&faults),
            Ok(scene) => work(&scene.value, Scope::Questions)
                .map(|_| Vec::new())
                .unwrap_or_else(|f| errors(&f)),
        };
        assert!(found.contains(&wanted), "{entry}: {found:?}, not {wanted}");
    }
    // Named counter-clockwise, the strands would run inside.
    let three = |order: &str| {
        format!(
            r#"{{"units": {{"length": "mm"}}, "links": {{"1": ["O", "A", "B"], "2": ["O"], "3": ["A"], "4": ["B"]}}, "ground": "1",
            "points": {{"O": [0, 0], "A": [200, 0], "B": [100, 150]}}, "belts": [{{{order}, "radii": [20, 20, 20]}}],
            "driver": {{"link": "2", "omega": "1 rad/s"}}, "find": ["omega_3"]}}"#
        )
    };
    let turned = work(
        &read(&three(r#""pulleys": ["2", "3", "4"], "centres": ["O", "A", "B"]"#)),
        Scope::Questions,
    );
    assert_eq!(errors(&turned.unwrap_err()), ["belt-order"]);
    assert!(
        work(
            &read(&three(r#""pulleys": ["2", "4", "3"], "centres": ["O", "B", "A"]"#)),
            Scope::Questions
        )
        .is_ok()
    );
}

/// The strand intersects the line of centres in the centre of its two wheels, at infinity where an
/// open belt joins equal ones; Willis' table lists belts and chains beside gears.
#[test]
fn belts_have_centres_and_stand_in_the_table() {
    let text = |of: &str| {
        format!(
            r#"{{"units": {{"length": "mm"}}, "links": {{"1": ["O"], "2": ["O"], "3": ["O", "A"], "4": ["A"]}}, "ground": "1",
            "points": {{"O": [10, 20], "A": [170, 140]}}, {of},
            "driver": [{{"link": "3", "omega": "2 rad/s"}}, {{"link": "2", "omega": "-5 rad/s"}}], "find": ["omega_4"]}}"#
        )
    };
    let belt = |radii: &str, more: &str| {
        format!(
            r#""belts": [{{"pulleys": ["2", "4"], "centres": ["O", "A"], "radii": {radii}{more}}}]"#
        )
    };
    let chain = r#""chains": [{"sprockets": ["2", "4"], "centres": ["O", "A"], "teeth": [19, 38], "pitch": "12 mm"}]"#;
    for (of, ratio, formula) in [
        (belt("[30, 45]", ""), 30.0 / 45.0, "r_{2}/r_{4}"),
        (belt("[30, 45]", r#", "crossed": true"#), -30.0 / 45.0, "−r_{2}/r_{4}"),
        (belt("[40, 40]", ""), 1.0, "r_{2}/r_{4}"),
        (chain.to_owned(), 0.5, "z_{2}/z_{4}"),
    ] {
        let scene = read(&text(&of));
        let wanted = 2.0 + ratio * (-5.0 - 2.0);
        near(scalar(&scene, &solved(&scene), "omega_4"), wanted, &of);
        let train = trains(&scene).remove(0);
        let gear = train.gears.iter().position(|g| scene.link_name(g.link) == "4").unwrap();
        let turns = train.turns(|l| given(&scene, l)).unwrap();
        near(train.rate(gear, turns), wanted, &of);
        assert_eq!(train.gears[gear].ratio.formula(), formula);
        let found = centres(&scene).unwrap_or_else(|f| panic!("{of}: {f}")).value;
        let centre = found.list.iter().find(|c| c.step.pair.name(&scene) == "P24").unwrap();
        assert_eq!(centre.round, 0, "{of}: {centre:?}");
        match centre.place.unwrap() {
            // ω₂ OP = ω₄ AP, seen from the arm.
            CentrePlace::At(p) => {
                let way = (p - Point::new(0.01, 0.02)).dot(Vec2::new(0.8, 0.6));
                near(way, 0.2 * ratio / (ratio - 1.0), &of);
                assert!((p - Point::new(0.01, 0.02)).cross(Vec2::new(0.8, 0.6)).abs() < 1e-12);
            }
            CentrePlace::Infinity(u) => {
                assert!(ratio == 1.0 && u.cross(Vec2::new(0.8, 0.6)).abs() < 1e-12, "{of}: {u:?}")
            }
        }
        assert!(
            found.list.iter().all(|c| c.residual.is_none_or(|r| r.abs() < 1e-9)),
            "{of}: {:?}",
            found.list
        );
    }
}
