//! Vector equations on their own: random equations of the four solvable cases against the vectors
//! that they were made from, substitution, faults, outputs in both languages; the equations that the
//! planner tries for the points of a group.

use hodograph::diag::{Diagnostic, Faults};
use hodograph::equation::{self, EquationCase, board, templates};
use hodograph::geom::Vec2;
use hodograph::problem::{
    self, Kind, Lesson, Look, Options, Pictures, Verdict, equation_plan, read, solve,
};
use hodograph::scene::Lang;
use hodograph::worksheet::{WorksheetSides, WorksheetTask};

/// A generator of Lehmer.
struct Dice(u64);

impl Dice {
    fn part(&mut self) -> f64 {
        self.0 = self.0 * 48271 % 0x7fff_ffff;
        self.0 as f64 / f64::from(0x7fff_ffff_u32)
    }

    fn below(&mut self, n: usize) -> usize {
        (self.part() * n as f64) as usize % n
    }
}

/// The names of the vectors of a random equation.
const NAMES: [&str; 6] = ["A", "v_B", "a^n_C", "D", "E_1", "F"];

/// A random equation with two unknowns of a case (0 to 3), and its vectors; the last vector closes
/// the sum.
fn random(dice: &mut Dice, case: usize) -> (String, Vec<Vec2>, usize) {
    let count = 3 + dice.below(4);
    let left = 1 + dice.below(count - 1);
    let mut vectors: Vec<Vec2> = (0..count)
        .map(|_| Vec2::from_angle(dice.part() * std::f64::consts::TAU) * (0.5 + 3.0 * dice.part()))
        .collect();
    // The left sum equals the right sum.
    let sign = |k: usize| if k < left { 1.0 } else { -1.0 };
    let rest = (0..count - 1).fold(Vec2::ZERO, |sum, k| sum + vectors[k] * sign(k));
    vectors[count - 1] = rest * -sign(count - 1);
    let x = dice.below(count);
    let y = (x + 1 + dice.below(count - 1)) % count;
    let side = |range: std::ops::Range<usize>| NAMES[range].join(" + ");
    let mut entries = Vec::new();
    for (k, v) in vectors.iter().enumerate() {
        let size = format!("\"magnitude\": \"{} N\"", v.norm());
        let angle = format!("\"direction\": \"{} rad\"", v.angle());
        let unknown_size = k == x && case != 2 || k == y && case == 1;
        let unknown_angle = k == x && (case == 0 || case == 2) || k == y && case >= 2;
        let known: Vec<String> = [(unknown_size, size), (unknown_angle, angle)]
            .into_iter()
            .filter(|(unknown, _)| !unknown)
            .map(|(_, text)| text)
            .collect();
        entries.push(format!("\"{}\": {{{}}}", NAMES[k], known.join(", ")));
    }
    let text = format!(
        "{{\"equation\": \"{} = {}\", \"quantity\": \"force\", \"vectors\": {{{}}}}}",
        side(0..left),
        side(left..count),
        entries.join(", ")
    );
    (text, vectors, left)
}

/// The vectors that a random equation was made from are one of its solutions, every solution
/// satisfies the equation, and the drawing agrees.
#[test]
fn random_equations_of_all_cases() {
    let mut dice = Dice(20_261_128);
    let mut twofold = 0;
    for round in 0..400 {
        let case = round % 4;
        let (text, vectors, left) = random(&mut dice, case);
        let problem = equation::read(&text).unwrap_or_else(|f| panic!("{text}\n{f}")).value;
        let solved = equation::solve(&problem).unwrap_or_else(|f| panic!("{text}\n{f}"));
        let drawn = board::draw(&problem).unwrap();
        let found = match solved.case {
            EquationCase::Vector(_) => 0,
            EquationCase::Magnitudes(_) => 1,
            EquationCase::Directions(_) => 2,
            EquationCase::Mixed { .. } => 3,
        };
        assert_eq!(found, case, "{text}");
        twofold += usize::from(solved.roots.len() == 2);
        let mut met = false;
        for (k, root) in solved.roots.iter().enumerate() {
            let mut all = vectors.clone();
            for v in &root.vectors {
                all[v.term] = v.value;
                let off = (drawn.read(v.term, k).unwrap() - v.value).norm();
                assert!(off * root.sine < 1e-11, "{text}: {off}");
            }
            let sum = all
                .iter()
                .enumerate()
                .fold(Vec2::ZERO, |sum, (k, v)| if k < left { sum + *v } else { sum - *v });
            assert!(sum.norm() < 1e-12, "{text}: {sum:?}");
            let near = |(a, b): (&Vec2, &Vec2)| (*a - *b).norm() < 1e-6;
            met |= all.iter().zip(&vectors).all(near);
        }
        assert!(met, "{text}");
    }
    assert!(twofold > 150, "{twofold}");
}

/// Answers of the templates by trigonometry.
#[test]
fn templates_have_the_answers_of_trigonometry() {
    let answers = |name: &str| -> Vec<(String, f64, f64)> {
        let problem = read(templates::get(name).unwrap()).unwrap().value;
        let solved = solve(&problem, &Options::default()).unwrap();
        assert_eq!(solved.verdict(), Verdict::Answered);
        let told = solved.answers(&Look::default());
        let value = |a: &problem::Answer| match a.value {
            Some(hodograph::answer::AnswerValue::Vector(v)) => (v.norm(), v.angle().to_degrees()),
            _ => panic!("{name}: a vector is no vector"),
        };
        told.iter().map(|a| (a.find.clone(), value(a).0, value(a).1)).collect()
    };
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-9, "{a} {b}");
    let degrees = |d: f64| d.to_radians();
    // The sum by components.
    let [x, y] = [f64::cos, f64::sin]
        .map(|f| 5.0 * f(degrees(20.0)) + 4.0 * f(degrees(95.0)) + 3.0 * f(degrees(-40.0)));
    let all = answers("closing-side");
    close(all[0].1, x.hypot(y));
    close(all[0].2, y.atan2(x).to_degrees());
    // The law of sines in the triangle with the angles 45°, 60°, 15°... of 165°, 150°, 105°.
    let all = answers("two-magnitudes");
    close(all[0].1, degrees(45.0).sin() / degrees(60.0).sin());
    close(all[1].1, degrees(15.0).sin() / degrees(60.0).sin());
    // The law of cosines: G and W make 500² + 120².
    let all = answers("two-directions");
    assert_eq!(
        all.iter().map(|a| a.0.as_str()).collect::<Vec<_>>(),
        ["F_S'", "F_T'", "F_S''", "F_T''"]
    );
    let r2 = 500.0_f64.powi(2) + 120.0_f64.powi(2);
    let between = ((r2 + 400.0_f64.powi(2) - 350.0_f64.powi(2)) / (2.0 * r2.sqrt() * 400.0)).acos();
    let up = 500.0_f64.atan2(-120.0);
    close(all[0].2, (up + between).to_degrees());
    close(all[2].2, (up - between).to_degrees());
    // The boat: v_a² − 2·3·v_a cos 35° + 9 − 4 = 0.
    let all = answers("magnitude-and-direction");
    let half = 3.0 * degrees(35.0).cos();
    close(all[0].1, half + (half * half - 5.0).sqrt());
    close(all[2].1, half - (half * half - 5.0).sqrt());
}

fn fault(text: &str) -> Diagnostic {
    let tried: Result<(), Faults> =
        read(text).and_then(|p| solve(&p.value, &Options::default()).map(|_| ()));
    let faults = tried.expect_err(text);
    for d in &faults.list {
        assert!(d.english_in_chinese().is_none(), "{d:?}");
    }
    faults.list[0].clone()
}

/// An equation of three vectors; the entries are of D, A and B.
fn of(d: &str, a: &str, b: &str) -> String {
    format!(
        "{{\"equation\": \"D = A + B\", \"lines\": {{\"g\": \"30 deg\"}}, \"vectors\": {{\"D\": {{{d}}}, \"A\": {{{a}}}, \"B\": {{{b}}}}}}}"
    )
}

#[test]
fn faults_say_what_is_wrong_and_by_how_much() {
    let known = r#""magnitude": "10 m/s", "direction": "0 deg""#;
    let d = fault(&of("", known, r#""magnitude": "3 m/s""#));
    assert_eq!(d.code, "equation-unknowns");
    assert_eq!(
        d.message.en,
        "not solvable: 3 unknowns (magnitude of D, direction of D, direction of B); a plane equation settles two"
    );
    assert!(fault(&of(r#""direction": "1 deg""#, known, known)).message.en.contains("1 unknown ("));
    assert!(fault(&of(known, known, known)).message.en.contains("0 unknowns"));
    let d = fault(&of(r#""direction": "parallel to g""#, known, r#""direction": "-150 deg""#));
    assert_eq!(d.code, "equation-parallel");
    assert!(d.help.unwrap().en.contains("5.000 m/s apart"));
    let d = fault(&of(r#""magnitude": "3 m/s""#, known, r#""magnitude": "4 m/s""#));
    assert_eq!(d.code, "equation-no-solution");
    assert!(d.message.en.contains("by 3.000 m/s"), "{}", d.message.en);
    let d = fault(&of(r#""magnitude": "3 m/s""#, known, r#""magnitude": "14 m/s""#));
    assert!(d.message.en.contains("encloses the other; they miss each other by 1.000 m/s"));
    let d = fault(&of(r#""direction": "perpendicular to g""#, known, r#""magnitude": "8 m/s""#));
    assert!(d.message.en.contains("the line passes the circle"), "{}", d.message.en);
    for (text, code) in [
        (r#"{"equation": "D = A - B", "vectors": {}}"#, "equation"),
        (r#"{"equation": "D + A", "vectors": {}}"#, "equation"),
        (r#"{"equation": "A = A", "vectors": {}}"#, "equation"),
        (r#"{"equation": "0 = 0", "vectors": {}}"#, "equation"),
        (r#"{"equation": "D = A", "vectors": {"E": {}}}"#, "unknown-key"),
        (
            r#"{"equation": "D = A", "vectors": {"D": {"direction": "parallel to h"}}}"#,
            "unknown-word",
        ),
        (r#"{"equation": "D = A", "quantity": "power", "vectors": {}}"#, "unknown-word"),
        (
            r#"{"equation": "D = A", "vectors": {"A": {"magnitude": "-1 m/s", "direction": "0 deg"}}}"#,
            "not-positive",
        ),
        (
            r#"{"equation": "D = A", "vectors": {"A": {"magnitude": "1 m/s", "direction": "2 s"}}}"#,
            "dimension",
        ),
    ] {
        assert_eq!(fault(text).code, code, "{text}");
    }
}

/// A line that touches the circle has one solution, and so have circles that touch.
#[test]
fn the_description_of_equations_can_be_solved() {
    let text = include_str!("../docs/scene.md");
    let blocks = text.split("```json\n").skip(1).filter_map(|b| b.split("```").next());
    let all: Vec<&str> = blocks.filter(|b| b.contains("\"equation\"")).collect();
    assert!(!all.is_empty());
    for block in all {
        let problem = read(block).unwrap_or_else(|f| panic!("{f}")).value;
        let solved = solve(&problem, &Options::default()).unwrap_or_else(|f| panic!("{f}"));
        assert_eq!(solved.verdict(), Verdict::Answered);
    }
}

#[test]
fn touching_loci_have_one_solution() {
    let known = r#""magnitude": "10 m/s", "direction": "0 deg""#;
    for text in [
        of(r#""direction": "30 deg""#, known, r#""magnitude": "5 m/s""#),
        of(r#""magnitude": "4 m/s""#, known, r#""magnitude": "6 m/s""#),
    ] {
        let problem = read(&text).unwrap().value;
        let solved = solve(&problem, &Options::default()).unwrap();
        assert_eq!(solved.verdict(), Verdict::Answered, "{text}");
        assert_eq!(solved.answers(&Look::default()).len(), 2, "{text}");
    }
}

/// The table and the count of unknowns need no solution.
#[test]
fn a_plan_counts_the_unknowns_of_any_equation() {
    let plan = |text: &str, lang| {
        let problem::Problem::Equation(problem) = read(text).unwrap().value else { panic!() };
        equation_plan(&problem, &Look { lang: Some(lang), ..Look::default() })
    };
    let (text, json) = plan(r#"{"equation": "D = A", "vectors": {}}"#, Lang::En);
    assert!(text.ends_with("4 unknowns; not solvable.\n"), "{text}");
    assert_eq!(json["solvable"], false);
    let (text, json) = plan(templates::get("two-magnitudes").unwrap(), Lang::Zh);
    assert!(text.contains("未知量 2 个；方程可解"), "{text}");
    assert_eq!(json["case"], "two magnitudes");
}

/// Every template is solved, drawn, stepped, and written in both languages.
#[test]
fn all_outputs_in_both_languages() {
    for name in templates::names() {
        let text = templates::get(name).unwrap();
        assert_eq!(Kind::of(text.as_bytes()), Kind::Equation);
        let problem = read(text).unwrap().value;
        let solved = solve(&problem, &Options::default()).unwrap();
        for lang in [Lang::En, Lang::Zh] {
            let look = Look { lang: Some(lang), ..Look::default() };
            let steps = Pictures { steps: true, ..Pictures::default() };
            let count = solved.json(&look, true, &[])["steps"].as_array().unwrap().len();
            assert_eq!(solved.figures(&steps, &look).unwrap().value.len(), count, "{name}");
            assert!(
                !solved.figures(&Pictures::default(), &look).unwrap().value[0].1.items.is_empty()
            );
            let lesson = solved.lesson(&Lesson::default(), &look).unwrap().value;
            assert!(lesson.starts_with("<!DOCTYPE html>"));
            let sheet =
                solved.worksheet(WorksheetSides::Both, WorksheetTask::Polygons, &look).unwrap();
            let page = hodograph::worksheet::markdown::markdown(&sheet, name).unwrap().0;
            assert!(page.contains(if lang == Lang::En { "# Solution" } else { "# 解" }), "{page}");
            let said = solved.text(&look, true);
            let chinese = said.chars().any(|c| ('\u{4e00}'..'\u{9fff}').contains(&c));
            assert_eq!(chinese, lang == Lang::Zh, "{said}");
        }
    }
}

/// The planner's own trials of a template, and the plan that they belong to.
fn tried(name: &str, lang: Lang) -> (String, serde_json::Value) {
    use hodograph::mechanism::{Demand, Mechanism};
    use hodograph::notation::Notation;
    use hodograph::plan::{self, text::PlanWriter, tried};
    use hodograph::report;
    let scene =
        hodograph::scene::read(hodograph::scene::templates::get(name).unwrap()).unwrap().value;
    let m = Mechanism::new(&scene).unwrap().value;
    let demand = Demand::of(&scene, &m);
    let (plan, trials) = tried::plan_tried(&scene, &m, &demand);
    let notation = Notation::of_language(lang);
    let usual = plan::plan(&scene, &m, &demand);
    let written = |plan: &plan::Plan| {
        let w = PlanWriter { scene: &scene, plan, notation: &notation, lang };
        report::plan::text(&scene, &m, &w, None)
    };
    assert_eq!(written(&plan), written(&usual), "{name}: trials change the plan");
    let w = PlanWriter { scene: &scene, plan: &plan, notation: &notation, lang };
    (report::tried::text(&m, &w, &trials), report::tried::json(&w, &trials))
}

/// In every template each equation taken has no more unknowns than it settles, and where a point
/// tried is solvable, such a point is taken.
#[test]
fn the_planner_takes_what_can_be_solved() {
    let mut unsolvable = 0;
    for template in hodograph::scene::templates::list() {
        let (_, json) = tried(template.name, Lang::En);
        for group in json.as_array().unwrap() {
            let of = |key: &str| group[key].as_array().unwrap().clone();
            let solvable = |p: &serde_json::Value| p["solvable"] == true;
            assert!(of("taken").iter().all(solvable), "{}: {group:#}", template.name);
            let good: Vec<_> = of("points").into_iter().filter(solvable).collect();
            let taken =
                |p: &serde_json::Value| of("taken").iter().any(|t| t["point"] == p["point"]);
            if let Some(first) = of("taken").first() {
                assert!(good.is_empty() || good.iter().any(taken), "{}: {group:#}", template.name);
                // A point that counts as unsolvable is not taken first.
                let of_first = |p: &serde_json::Value| p["point"] == first["point"];
                let fair = of("points").iter().filter(|p| of_first(p)).all(solvable);
                assert!(fair, "{}: {group:#}", template.name);
            }
            unsolvable += of("points").len() - good.len();
        }
    }
    assert!(unsolvable > 50, "{unsolvable}");
}

/// A crank-rocker, a group of class III and a shaper, as the notes of a course try them.
#[test]
fn points_are_tried_as_in_the_notes() {
    let (text, _) = tried("crank-rocker", Lang::En);
    let c = text.find("try C").unwrap();
    let e = text.find("try E").unwrap();
    assert!(c < e && text[c..e].contains("2 unknowns: solvable"), "{text}");
    assert!(text[e..].contains("v_E = v_B     + v_EB"), "{text}");
    assert!(text[e..].contains("3 unknowns, a plane equation settles 2: not solvable"), "{text}");
    let (text, json) = tried("stephenson-six-bar", Lang::Zh);
    assert!(text.contains("选 E 点") && text.contains("取：v_S — 特殊点法"), "{text}");
    assert!(text.contains("未知量 3 个，一个平面矢量方程只能解 2 个：方程不可解"), "{text}");
    assert!(text.contains("只知其方向"), "{text}");
    let solvable: Vec<_> =
        json[0]["points"].as_array().unwrap().iter().map(|p| p["solvable"] == true).collect();
    assert_eq!(solvable, [false, false, false]);
    assert_eq!(json[0]["taken"][0]["unknowns"], 2);
    let (text, json) = tried("shaper", Lang::En);
    assert!(text.contains("try A3") && json[0]["points"][0]["solvable"] == true, "{text}");
}
