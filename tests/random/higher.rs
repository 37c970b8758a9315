//! Groups of class IV and higher: drawn in every way that opens them, and answered from the loop
//! equations, which differences of positions confirm.

use hodograph::accuracy::{BAD_DEG, crossings};
use hodograph::answer::AnswerValue;
use hodograph::certified::certify;
use hodograph::certified::ladder::AnswerPart;
use hodograph::construct::scale::Boxes;
use hodograph::construct::{PlanDrawing, construct, read};
use hodograph::digits::significant;
use hodograph::effort::truth;
use hodograph::geom::Point;
use hodograph::mechanism::Core;
use hodograph::number::{Real, within};
use hodograph::plan::{GroupChoices, plan_with};
use hodograph::position::newton::{driver_values, moved};
use hodograph::scene::{self, DiagramKind, PointId, Scene};
use hodograph::worked::{Scope, Worked, work};

const LINKS: &str = r#""links": {"1": ["O","A"], "2": ["A","B","C"], "3": ["B","D"], "4": ["C","E"], "5": ["D","E","G"], "6": ["O","G"]}, "ground": "6",
  "find": ["v_D", "a_D", "omega_5", "v_A"]"#;

fn by_coordinates() -> String {
    format!(
        r#"{{{LINKS}, "units": {{"length": "m"}}, "driver": {{"link": "1", "omega": "2 rad/s"}},
        "points": {{"O": [0,0], "A": [1,2], "B": [3,4], "C": [4,1.5], "D": [6,5], "E": [7,2], "G": [9,1]}}}}"#
    )
}

fn by_lengths() -> String {
    format!(
        r#"{{{LINKS}, "units": {{"length": "m"}}, "driver": {{"link": "1", "angle": "atan(2)", "omega": "2 rad/s"}},
        "points": {{"O": [0,0], "G": [9,1]}},
        "lengths": {{"OA": "sqrt(5)", "AB": "sqrt(8)", "BC": "sqrt(7.25)", "AC": "sqrt(9.25)", "BD": "sqrt(10)", "CE": "sqrt(9.25)",
          "DE": "sqrt(10)", "EG": "sqrt(5)", "DG": 5}},
        "sketch": {{"A": [1,2], "B": [3.1,4], "C": [4,1.4], "D": [6,5.2], "E": [7,2]}}}}"#
    )
}

/// A group with a slider inside: link 5 keeps its direction on a ground guide and carries the slot
/// of E, which runs in another ground guide. The sketch is rough and must not affect the answer.
fn with_slider() -> String {
    r#"{"links": {"1": ["O","A"], "2": ["A","B","C"], "3": ["B","D"], "4": ["C","E"], "5": ["D"], "6": ["O"]}, "ground": "6",
      "find": ["v_D", "a_D", "omega_2", "alpha_2", "v_E", "x_D"], "units": {"length": "m"},
      "driver": {"link": "1", "angle": "atan(2)", "omega": "2 rad/s"}, "points": {"O": [0,0]},
      "guides": [{"slider": "5", "on": "6", "through": [0, 5], "angle": "0 deg"},
        {"pin": "E", "on": "5", "through": "D", "angle": "90 deg", "offset": "-1 m"},
        {"pin": "E", "on": "6", "through": [0, 2], "angle": "0 deg"}],
      "lengths": {"OA": "sqrt(5)", "AB": "sqrt(8)", "BC": "sqrt(7.25)", "AC": "sqrt(9.25)", "BD": "sqrt(10)", "CE": "sqrt(9.25)"},
      "sketch": {"A": [1,2], "B": [3.1,4], "C": [4,1.4], "D": [6.1,5.2], "E": [7,2]}}"#
        .into()
}

#[test]
fn a_slider_inside_a_higher_group_is_proved() {
    let (scene, done) = worked(&with_slider());
    let places = [("D", 6.0, 5.0), ("E", 7.0, 2.0), ("B", 3.0, 4.0)];
    for (name, x, y) in places {
        let at = done
            .configuration
            .point(PointId(scene.points.iter().position(|p| p.name == name).unwrap()));
        assert!((at - Point::new(x, y)).norm() < 1e-13, "{name} is at {at:?}");
    }
    let certified = certify(&scene, &done, 12);
    within(truth::BITS, || {
        for ((c, r), t) in
            certified.iter().zip(&done.results).zip(truth::answers(&scene, &done).unwrap())
        {
            let find = &scene.find[r.find];
            assert_eq!(c.why, None, "{}", find.text);
            let t = match t.unwrap() {
                AnswerValue::Scalar(s) => s.approx(),
                AnswerValue::Vector(v) => v.norm().approx(),
                AnswerValue::Point(_) => panic!("{} is no place", find.text),
            };
            let part = c.part(AnswerPart::Scalar).or(c.part(AnswerPart::Magnitude)).unwrap();
            assert_eq!(part.text(12).unwrap().0, significant(t, 12), "{}", find.text);
        }
    });
}

/// Two points by lengths give a slider a direction of its own, and nothing gives its angle to its
/// guide: the rough sketch must not decide it.
#[test]
fn the_direction_of_a_slider_is_not_taken_from_the_sketch() {
    let text = with_slider()
        .replace(r#""5": ["D"]"#, r#""5": ["D", "K"]"#)
        .replace(r#""OA":"#, r#""DK": 1, "OA":"#);
    let text = text
        .replace(r#""E": [7,2]}"#, r#""E": [7,2], "K": [7,5.1]}"#)
        .replace(r#""through": "D", "angle": "90 deg""#, r#""line": "DK", "angle": "90 deg""#);
    let scene = scene::read(&text).unwrap_or_else(|f| panic!("{f}")).value;
    let faults = work(&scene, Scope::Figure).map(|_| ()).unwrap_err();
    assert!(faults.list.iter().any(|d| d.code == "angle-not-given"), "{faults}");
}

fn worked(text: &str) -> (Scene, Worked) {
    let scene = scene::read(text).unwrap_or_else(|f| panic!("{f}")).value;
    let done = work(&scene, Scope::Figure).unwrap_or_else(|f| panic!("{f}"));
    assert!(
        done.notes.iter().any(|d| d.code == "higher-group" && d.message.en.contains("2, 3, 4, 5")),
        "{:?}",
        done.notes
    );
    (scene, done.value)
}

#[test]
fn a_higher_group_is_what_differences_of_positions_say() {
    let (scene, done) = worked(&by_coordinates());
    let (_, again) = worked(&by_lengths());
    assert!(done.plan.undrawable.is_empty());
    let d = PointId(scene.points.iter().position(|p| p.name == "D").unwrap());
    let place = |h: f64| {
        let mut drivers = driver_values(&scene, &done.configuration);
        drivers.0[0] += h * 2.0;
        moved(&scene, &done.mechanism, &done.configuration, &drivers).unwrap().point(d)
    };
    let h = 1e-4;
    let velocity = (place(h) - place(-h)) * (0.5 / h);
    let acceleration = ((place(h) - place(0.0)) - (place(0.0) - place(-h))) * (1.0 / (h * h));
    for (o, p) in done.results.iter().zip(&again.results) {
        assert!(o.drawn.is_some(), "{}", scene.find[o.find].text);
        let off = match (o.computed, p.computed) {
            (AnswerValue::Vector(a), AnswerValue::Vector(b)) => (a - b).norm() / a.norm(),
            (AnswerValue::Scalar(a), AnswerValue::Scalar(b)) => (a - b).abs() / a.abs(),
            _ => panic!("the same question has the same kind of answer"),
        };
        assert!(off < 1e-11, "{}: the two poses differ by {off:e}", scene.find[o.find].text);
    }
    let AnswerValue::Vector(v) = done.results[0].computed else { panic!("v_D is a vector") };
    let AnswerValue::Vector(a) = done.results[1].computed else { panic!("a_D is a vector") };
    assert!((v - velocity).norm() < 1e-6 * v.norm(), "{v:?} {velocity:?}");
    assert!((a - acceleration).norm() < 1e-4 * a.norm(), "{a:?} {acceleration:?}");
}

/// Links, guides, places that may be moved, questions.
type Shape =
    (&'static str, &'static str, &'static str, &'static [(&'static str, f64, f64)], &'static str);

/// Groups that no link on three lines opens.
const SHAPES: [Shape; 4] = [
    (
        "two bars",
        r#""1": ["O","A"], "2": ["A","B","C"], "3": ["B","D"], "4": ["C","E"], "5": ["D","E","F"], "6": ["O","F"]"#,
        "",
        &[
            ("O", 0.0, 0.0),
            ("A", 2.0, 1.0),
            ("B", 3.5, 3.6),
            ("C", 5.2, 1.9),
            ("D", 6.4, 5.1),
            ("E", 8.3, 2.6),
            ("F", 9.0, 6.0),
        ],
        r#""omega_2", "omega_3", "omega_5", "alpha_2", "alpha_4", "alpha_5", "v_B", "a_E""#,
    ),
    (
        "a bar and a slot",
        r#""1": ["O","A"], "2": ["A","B","C"], "3": ["B","D"], "5": ["D","F"], "6": ["O","F"]"#,
        r#""guides": [{"pin": "C", "on": "5", "slider": "4", "angle": "63 deg"}],"#,
        &[
            ("O", 0.0, 0.0),
            ("A", 2.0, 1.0),
            ("B", 3.5, 3.6),
            ("C", 5.2, 1.9),
            ("D", 6.4, 5.1),
            ("F", 9.0, 6.0),
        ],
        r#""omega_2", "omega_3", "omega_5", "alpha_2", "alpha_3", "alpha_5", "v_CC5", "ak_CC5", "a_D""#,
    ),
    (
        "a bar and a curved slot",
        r#""1": ["O","A"], "2": ["A","B","C"], "3": ["B","D"], "5": ["D","F","K"], "6": ["O","F"]"#,
        r#""guides": [{"pin": "C", "on": "5", "centre": "K"}],"#,
        &[
            ("O", 0.0, 0.0),
            ("A", 2.0, 1.0),
            ("B", 3.5, 3.6),
            ("C", 5.2, 1.9),
            ("D", 6.4, 5.1),
            ("F", 9.0, 6.0),
            ("K", 8.0, -1.0),
        ],
        r#""omega_2", "omega_3", "omega_5", "alpha_2", "alpha_3", "alpha_5", "v_C", "a_D""#,
    ),
    (
        "a ring",
        r#""8": ["O","F","H"], "1": ["O","A"], "2": ["A","P","Q"], "3": ["P","R"], "4": ["R","T","F"], "5": ["T","U"], "6": ["U","V","H"], "7": ["V","Q"]"#,
        "",
        &[
            ("O", 0.0, 0.0),
            ("A", 2.0, 1.0),
            ("P", 4.0, 3.0),
            ("Q", 4.0, 0.0),
            ("R", 6.0, 5.0),
            ("T", 9.0, 4.0),
            ("F", 7.0, 8.0),
            ("U", 11.0, 2.0),
            ("V", 9.0, -1.0),
            ("H", 12.0, -2.0),
        ],
        r#""omega_2", "omega_4", "omega_6", "alpha_2", "alpha_3", "alpha_4", "alpha_6", "v_R", "a_U""#,
    ),
];

/// Each way in which a plan can open a group agrees with the loop equations, at any places; and the
/// best of them is drawn.
#[test]
fn every_way_to_draw_a_group_gives_the_same() {
    for (shape, links, guides, places, find) in SHAPES {
        let (mut compared, mut ways_of, mut flat) = (0, 0, 0);
        for seed in 0..25 {
            let mut rng = crate::rng::Rng::new(seed);
            let mut moved = || rng.between(-0.8, 0.8);
            let points: Vec<String> = places
                .iter()
                .map(|(name, x, y)| format!("\"{name}\": [{}, {}]", x + moved(), y + moved()))
                .collect();
            let ground = if shape == "a ring" { "8" } else { "6" };
            let text = format!(
                r#"{{"units": {{"length": "m"}}, "links": {{{links}}}, "ground": "{ground}", {guides} "points": {{{}}}, "driver": {{"link": "1", "omega": "3 rad/s", "alpha": "2 rad/s^2"}}, "find": [{find}]}}"#,
                points.join(", ")
            );
            let scene = scene::read(&text).unwrap_or_else(|f| panic!("{shape}: {f}")).value;
            let w = work(&scene, Scope::Figure)
                .unwrap_or_else(|f| panic!("{shape}, seed {seed}: {f}"))
                .value;
            assert!(w.plan.undrawable.is_empty(), "{shape}, seed {seed}: not drawn");
            assert!(
                w.results.iter().all(|r| r.agreement.is_some_and(|a| a.holds())),
                "{shape}, seed {seed}: {:?}",
                w.results
            );
            let group = w
                .mechanism
                .groups
                .iter()
                .position(|g| matches!(g.core, Core::Higher))
                .expect("a group without a core");
            // The smallest intersection angle of a drawing, in degrees.
            let flattest = |d: &PlanDrawing| {
                crossings(d, 0.0).iter().map(|c| c.angle_deg()).fold(90.0, f64::min)
            };
            let mut best: f64 = 0.0;
            let mut way = 0;
            loop {
                let plan = plan_with(
                    &scene,
                    &w.mechanism,
                    &w.demand,
                    &GroupChoices { way: [(group, way)].into(), ..GroupChoices::default() },
                );
                if plan.undrawable.contains(&group) {
                    break;
                }
                way += 1;
                let drawn = construct(
                    &scene,
                    &w.mechanism,
                    &w.configuration,
                    &plan,
                    &Boxes::of(&scene.paper, &plan),
                );
                let Ok(drawn) = drawn else {
                    flat += 1;
                    continue;
                };
                best = best.max(flattest(&drawn));
                let bound = 1e-12 * drawn.magnified(DiagramKind::Acceleration).max(1e3);
                if bound > 1e-3 {
                    flat += 1;
                    continue;
                }
                let answers = read(&scene, &w.mechanism, &w.configuration, &plan, &drawn);
                for (r, answer) in w.results.iter().zip(&answers) {
                    let answer = answer.as_ref().unwrap_or_else(|| {
                        panic!(
                            "{shape}, seed {seed}, way {way}: {} is not drawn",
                            scene.find[r.find].text
                        )
                    });
                    let off = match (answer.value, r.computed) {
                        (AnswerValue::Vector(a), AnswerValue::Vector(b)) => (a - b).norm(),
                        (AnswerValue::Scalar(a), AnswerValue::Scalar(b)) => (a - b).abs(),
                        _ => f64::INFINITY,
                    };
                    assert!(
                        off <= bound * r.scale.max(1.0),
                        "{shape}, seed {seed}, way {way}: {} is off by {off:e}",
                        scene.find[r.find].text
                    );
                    compared += 1;
                }
            }
            let chosen = flattest(&w.construction);
            assert!(
                chosen >= best.min(BAD_DEG) - 1e-9,
                "{shape}, seed {seed}: drawn under {chosen}°, where {best}° was to be had"
            );
            ways_of += way;
        }
        println!(
            "{shape}: {compared} answers compared in {ways_of} ways, {flat} of them without a crossing"
        );
        assert!(
            compared > 800,
            "{shape}: {compared} answers compared in {ways_of} ways, {flat} of them without a crossing"
        );
    }
}

/// The double butterfly has no link on three legs: two of its links are held by two lines each,
/// with a dyad in between. At any places of its joints, the drawing by the special points agrees
/// with the loop equations, or the note says that it is not drawn.
#[test]
fn a_double_butterfly_is_drawn_by_special_points() {
    let (mut drawn, mut left) = (0, 0);
    for seed in 0..60 {
        let mut rng = crate::rng::Rng::new(seed);
        let places = [
            (0.0, 0.0),
            (1.0, 6.0),
            (-5.0, 1.0),
            (-4.0, 5.0),
            (6.0, 0.0),
            (7.0, 4.0),
            (-2.0, 3.0),
            (-1.0, 5.0),
            (3.0, 2.0),
            (4.0, 7.0),
        ];
        let points: Vec<String> = places
            .iter()
            .zip("ABCDEFGHKL".chars())
            .map(|((x, y), name)| {
                format!(
                    "\"{name}\": [{}, {}]",
                    x + rng.between(-1.0, 1.0),
                    y + rng.between(-1.0, 1.0)
                )
            })
            .collect();
        let text = format!(
            r#"{{"units": {{"length": "mm"}}, "links": {{"1": ["A","C","E"], "2": ["A","G","K"], "3": ["B","D","H"], "4": ["B","F","L"], "5": ["C","D"], "6": ["E","F"],
               "7": ["G","H"], "8": ["K","L"]}}, "ground": "1", "points": {{{}}}, "driver": {{"link": "2", "omega": "1 rad/s", "alpha": "2 rad/s^2"}},
               "find": ["v_B", "a_B", "omega_3", "alpha_3", "omega_8", "alpha_8", "v_L", "a_H"]}}"#,
            points.join(", ")
        );
        let scene = scene::read(&text).unwrap_or_else(|f| panic!("{f}")).value;
        let done = work(&scene, Scope::Figure).unwrap_or_else(|f| panic!("seed {seed}: {f}"));
        let w = done.value;
        let not_drawn = done
            .notes
            .iter()
            .any(|d| d.code == "higher-group" && d.message.en.contains("not drawn"));
        assert_eq!(w.plan.undrawable.is_empty(), !not_drawn, "seed {seed}");
        for r in &w.results {
            let Some(d) = &r.drawn else {
                assert!(not_drawn, "seed {seed}: {}", scene.find[r.find].text);
                continue;
            };
            let off = match (d.value, r.computed) {
                (AnswerValue::Vector(a), AnswerValue::Vector(b)) => (a - b).norm() / b.norm(),
                (AnswerValue::Scalar(a), AnswerValue::Scalar(b)) => (a - b).abs() / b.abs(),
                _ => f64::INFINITY,
            };
            assert!(
                off < 1e-12 * w.construction.magnified(DiagramKind::Acceleration).max(1e3),
                "seed {seed}: {} is off by {off:e}",
                scene.find[r.find].text
            );
        }
        if not_drawn { left += 1 } else { drawn += 1 }
    }
    assert!(drawn > 55, "{drawn} drawn, {left} left");
}
