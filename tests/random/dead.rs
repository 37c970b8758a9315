//! A dead centre makes only its dependent questions unanswerable.

use crate::rng::Rng;
use hodograph::certified::{certify, steps};
use hodograph::notation::Notation;
use hodograph::plan::text::PlanWriter;
use hodograph::report::{answers, construction};
use hodograph::scene::{self, Lang, Scene};
use hodograph::worked::{Scope, Worked, work};

/// A crank-rocker A B C D with a dyad C F G behind it, a dyad F H K behind that, and a dyad B P Q
/// beside it; F is the midpoint of C and G (or not).
fn scene_of(rng: &mut Rng, in_line: bool, find: &str) -> String {
    let mut whole = |lo: f64, hi: f64| rng.between(lo, hi).round();
    let (b, c, d) = (
        (whole(5.0, 20.0), whole(10.0, 30.0)),
        (whole(60.0, 90.0), whole(40.0, 80.0)),
        (whole(70.0, 110.0), whole(-10.0, 5.0)),
    );
    let (dx, dy) = (whole(10.0, 40.0), whole(-40.0, 40.0));
    let f = (c.0 + dx, c.1 + dy);
    let g = if in_line { (f.0 + dx, f.1 + dy) } else { (f.0 + dx, f.1 + dy - 7.0) };
    let (h, k) = ((f.0 - 20.0, f.1 + 50.0), (f.0 + 30.0, f.1 + 60.0));
    let (p, q) = ((b.0 - 40.0, b.1 + 20.0), (b.0 - 50.0, b.1 - 30.0));
    let points = [
        ("A", (0.0, 0.0)),
        ("B", b),
        ("C", c),
        ("D", d),
        ("F", f),
        ("G", g),
        ("H", h),
        ("K", k),
        ("P", p),
        ("Q", q),
    ];
    let points: Vec<String> =
        points.iter().map(|(n, (x, y))| format!(r#""{n}": [{x}, {y}]"#)).collect();
    format!(
        r#"{{"links": {{"1": ["A","B"], "2": ["B","C"], "3": ["C","D"], "5": ["C","F"], "6": ["F","G"], "7": ["F","H"], "8": ["H","K"],
          "9": ["B","P"], "10": ["P","Q"], "0": ["A","D","G","K","Q"]}}, "ground": "0", "units": {{"length": "mm"}},
          "points": {{{}}}, "driver": {{"link": "1", "omega": "3 rad/s", "alpha": "1 rad/s^2"}}, "find": [{find}]}}"#,
        points.join(", ")
    )
}

const UPSTREAM: &str = r#""v_B", "v_C", "a_C", "omega_2", "omega_3", "alpha_3""#;
const BESIDE: &str = r#""v_P", "omega_10", "alpha_9""#;
const DEAD: &str = r#""omega_5", "v_F", "a_F", "alpha_6", "omega_7", "a_H""#;

fn worked(text: &str) -> (Scene, Worked) {
    let scene = scene::read(text).unwrap_or_else(|f| panic!("{f}\n{text}")).value;
    let done = work(&scene, Scope::Questions).unwrap_or_else(|f| panic!("{f}\n{text}")).value;
    (scene, done)
}

#[test]
fn what_does_not_rest_on_a_dead_point_is_answered_as_without_it() {
    let mut seen = 0;
    for seed in 0..60 {
        let all = scene_of(&mut Rng::new(seed), true, &format!("{DEAD}, {UPSTREAM}, {BESIDE}"));
        let (scene, done) = worked(&all);
        let (alone, without) =
            worked(&scene_of(&mut Rng::new(seed), true, &format!("{UPSTREAM}, {BESIDE}")));
        let told: Vec<&str> =
            done.unanswered.iter().map(|u| scene.find[u.find].text.as_str()).collect();
        if told.is_empty() {
            // C happens to move perpendicular to CG.
            continue;
        }
        seen += 1;
        assert_eq!(told, ["omega_5", "v_F", "a_F", "alpha_6", "omega_7", "a_H"], "{all}");
        for refused in done
            .unanswered
            .iter()
            .map(|u| u.refused().expect("it rests on a part without a motion"))
        {
            assert_eq!(refused.diagnostic.code, "dead-centre");
            assert!(
                refused.words.en.contains("link 5 (CF) and link 6 (FG) lie in line at F"),
                "{}\n{all}",
                refused.words.en
            );
        }
        let lines = |scene: &Scene, done: &Worked| -> Vec<String> {
            let text = answers::text(scene, done, &certify(scene, done, 12), 12, Lang::En);
            let words = |l: &str| l.split_whitespace().collect::<Vec<_>>().join(" ");
            // The scales depend on the other drawn quantities.
            text.lines()
                .filter(|l| !l.contains("unbounded") && !l.contains("differ"))
                .map(|l| words(l.split('(').next().unwrap()))
                .collect()
        };
        let (here, there) = (lines(&scene, &done), lines(&alone, &without));
        assert_eq!(here, there, "{all}");
        assert!(certify(&scene, &done, 12).iter().all(|c| c.why.is_none()), "{all}");
        // All possible parts are drawn, and certified to the last digit.
        let told = steps(&scene, &done, None);
        assert_eq!(told.why, None, "{all}");
        let notation = Notation::of_language(Lang::En);
        let w = PlanWriter { scene: &scene, plan: &done.plan, notation: &notation, lang: Lang::En };
        let text = construction::text(&w, &done.construction, &told);
        assert!(
            text.contains("v_CB")
                && text.contains("v_P")
                && !text.contains("v_F")
                && !text.contains('≈'),
            "{text}"
        );
        let json = answers::json(&scene, &done, &certify(&scene, &done, 6), 6, &[]);
        for (answer, find) in json["answers"].as_array().unwrap().iter().zip(&scene.find) {
            let dead = DEAD.contains(&format!("\"{}\"", find.text));
            assert_eq!(answer["find"], find.text.as_str());
            assert_eq!(
                (answer["unbounded"].as_bool(), answer["value"].is_null()),
                (Some(dead), dead),
                "{answer}"
            );
        }
    }
    assert!(seen > 50, "{seen}");
}

#[test]
fn beside_the_line_everything_is_answered() {
    for seed in 0..10 {
        let (scene, done) =
            worked(&scene_of(&mut Rng::new(seed), false, &format!("{DEAD}, {UPSTREAM}, {BESIDE}")));
        assert_eq!((done.unanswered.len(), done.results.len()), (0, scene.find.len()));
    }
}

/// All parts that hold a singular block are named, not only the first bar beside its guide: a link
/// on two bars and a guide, and on one bar and two guides.
#[test]
fn what_holds_a_dead_block_is_named_whole() {
    // All normals of the parts that hold link 3 pass through (5, 0).
    let scene = |legs: &str, guides: &str| {
        format!(
            r#"{{"links": {{"1": ["O", "A"], "2": ["A", "P"], "3": ["P", "Q", "R"]{legs}, "0": ["O", "G"]}}, "ground": "0", "units": {{"length": "m"}},
            "points": {{"O": [3, 0], "A": [4.8, 1], "P": [4, 5], "Q": [7, 4], "R": [6, 7], "G": [5.5, 1]}}, "guides": [{guides}],
            "driver": {{"link": "1", "omega": "1 rad/s"}}, "find": ["omega_2", "omega_3"]}}"#
        )
    };
    let guide = |pin: &str, ratio: &str| {
        format!(r#"{{"pin": "{pin}", "on": "0", "angle": "atan({ratio})"}}"#)
    };
    let (at_r, at_q) = (guide("R", "-1/7"), guide("Q", "-1/2"));
    for (text, named) in [
        (
            scene(r#", "4": ["G", "Q"]"#, &at_r),
            vec!["link 2 (AP)", "link 4 (GQ)", "the guide of R"],
        ),
        (
            scene("", &format!("{at_r}, {at_q}")),
            vec!["link 2 (AP)", "the guide of R", "the guide of Q"],
        ),
    ] {
        let scene = scene::read(&text).unwrap_or_else(|f| panic!("{f}\n{text}")).value;
        let said = match work(&scene, Scope::Questions) {
            Ok(done) => {
                done.notes.iter().map(|d| d.message.en.clone()).collect::<Vec<_>>().join("\n")
            }
            Err(faults) => faults.to_string(),
        };
        assert!(
            named.iter().all(|n| said.contains(n)) && !said.contains("square"),
            "{said}\n{text}"
        );
    }
}
