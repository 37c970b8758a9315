//! The analytic method written out, on all templates without wheels: rates are those of the
//! analysis, both sides of every equation are equal, and every formula is typeset.

use hodograph::answer::AnswerValue;
use hodograph::figure::stepped::ConstructionMethod;
use hodograph::lesson::{LessonOptions, lesson, told};
use hodograph::loops::{Equation, Formula, GroupLoops, Loops, PositionForm, loops};
use hodograph::paper::label::Label;
use hodograph::problem::{Kind, templates};
use hodograph::report::loops::closed;
use hodograph::scene::{self, Lang, Scene};
use hodograph::worked::{Scope, work};
use hodograph::worksheet::{
    DocumentBlock, WorksheetOptions, by_loops, html, markdown, pages, typst,
};
use std::collections::BTreeSet;
use std::f64::consts::TAU;

/// The largest difference relative to the larger of one and the value.
const CLOSE: f64 = 1e-11;

fn off(a: f64, b: f64) -> f64 {
    (a - b).abs() / b.abs().max(1.0)
}

/// Both sides of an equation, angles within a turn; a sum of large terms that cancel may lose the
/// digits that these have more than its result.
fn both_sides(name: &str, e: &Equation) {
    let (left, right) = (e.left.value(), e.right.value());
    let turns = match e.kind {
        Some(scene::Kind::Angle) => ((left - right) / TAU).round() * TAU,
        _ => 0.0,
    };
    assert!(
        off(left - turns, right) < CLOSE,
        "{name}: {} = {}: {left} and {right}",
        e.left.text(),
        e.right.text()
    );
    for side in [&e.left, &e.right] {
        let label = Label::math(side.text());
        assert!(label.faults().is_empty(), "{name}: {}", side.text());
    }
}

/// Angular velocity and acceleration of a link by the analysis.
fn of_analysis(text: &str, link: &str) -> [f64; 2] {
    let asked = format!("omega_{link},alpha_{link}");
    let asking = scene::read_asking(text.as_bytes(), &asked).unwrap().value;
    let worked = work(&asking, Scope::Questions).unwrap().value;
    let number = |k: usize| match worked.results[k].computed {
        AnswerValue::Scalar(x) => x,
        _ => panic!("{link}: an angular velocity is a number"),
    };
    [number(0), number(1)]
}

fn judged(name: &str, text: &str, scene: &Scene, all: &Loops) {
    for v in &all.variables {
        let Some(link) = v.link else { continue };
        let [omega, alpha] = of_analysis(text, scene.link_name(link));
        // Poses near a dead centre are refused; the others lose some digits at most.
        assert!(off(v.rate, omega) < 1e-9 && off(v.second, alpha) < 1e-8, "{name}: {v:?}");
    }
    for g in &all.groups {
        let sizes = [&g.position, &g.velocities, &g.accelerations].map(Vec::len);
        assert!(g.form == PositionForm::Newton || sizes[0] >= 2, "{name}: {sizes:?}");
        let equations = g.closures.iter().chain(&g.position);
        equations.chain(&g.velocities).chain(&g.accelerations).for_each(|e| both_sides(name, e));
        for (k, right) in g.system.right.iter().enumerate() {
            let order = k + 1;
            let x: Vec<f64> =
                g.unknowns.iter().map(|k| all.variables[*k].symbol(order).value()).collect();
            for (row, right) in g.system.rows.iter().zip(right) {
                let sum: f64 = row.iter().zip(&x).map(|(a, x)| a * x).sum();
                assert!(off(sum, *right) < CLOSE, "{name}: {sum} and {right}");
            }
        }
        for of in &g.loops {
            assert!(Label::math(closed(all, of)).faults().is_empty(), "{name}");
        }
    }
}

#[test]
fn formulas_give_the_rates_of_the_analysis_on_all_templates() {
    let (mut forms, mut refused) = (BTreeSet::new(), BTreeSet::new());
    for template in templates::all().into_iter().filter(|t| t.kind == Kind::Scene) {
        let text = templates::text(template.name, &[]).unwrap();
        // A scene without rates is one for counting only.
        let Ok(read) = scene::read(&text) else { continue };
        match loops(&read.value) {
            Ok(all) => {
                judged(template.name, &text, &read.value, &all.value);
                forms.extend(all.value.groups.iter().map(|g| format!("{:?}", g.form)));
            }
            Err(faults) => {
                assert!(!read.value.rolling.is_empty(), "{}: {faults}", template.name);
                assert!(faults.list.iter().any(|d| d.code == "loops"), "{faults}");
                refused.insert(template.name);
            }
        }
    }
    assert_eq!(
        forms.into_iter().collect::<Vec<_>>(),
        ["AngleAndLength", "Newton", "SlottedLever", "TwoAngles", "TwoLengths"]
    );
    assert!(refused.len() <= 12, "{refused:?}");
}

/// Where drivers move the points of a scene directly, the lesson writes their equations of motion;
/// a scene with neither loops nor such points has no lesson.
#[test]
fn the_lesson_of_the_method_has_the_equations_of_motion() {
    let page = |name: &str| {
        let scene = scene::read(templates::text(name, &[]).unwrap()).unwrap().value;
        let method = ConstructionMethod::named("loops");
        let english = LessonOptions::of_language(Lang::En);
        lesson(&scene, &LessonOptions { method, positions: 4, ..english })
    };
    for (name, motions) in [("lathe", 2), ("robot-arm", 3), ("crank-rocker", 0)] {
        let page = told(&page(name).unwrap().value).unwrap();
        for words in ["Differentiated once more:", "再对时间求导，得加速度："] {
            let found = page.matches(words).count();
            assert!(found >= motions && (motions > 0 || found == 0), "{name}: {found}");
        }
    }
    let faults = page("two-slots").unwrap_err();
    assert!(faults.list.iter().any(|d| d.code == "method"), "{faults}");
}

/// Every quarter of the turn has other signs in the formulas.
#[test]
fn formulas_hold_through_the_whole_turn() {
    for name in ["crank-rocker", "offset-slider-crank", "shaper", "stephenson-six-bar"] {
        let mut positions = 0;
        for step in 0..24 {
            let phi = format!("{} deg", 15 * step + 2);
            let Ok(text) = templates::text(name, &[("phi_1", &phi)])
                .or_else(|_| templates::text(name, &[("phi_2", &phi)]))
            else {
                continue;
            };
            let Ok(read) = scene::read(&text) else { continue };
            let Ok(all) = loops(&read.value) else { continue };
            judged(&format!("{name} at {phi}"), &text, &read.value, &all.value);
            positions += 1;
        }
        assert!(positions >= 8, "{name}: {positions}");
    }
}

/// In every format, with the formulas of each group and the results of both methods.
#[test]
fn a_worksheet_solves_by_the_loops() {
    for name in ["crank-rocker", "shaper", "scotch-yoke", "double-butterfly", "excavator"] {
        let text = templates::text(name, &[]).unwrap();
        let scene = scene::read(&text).unwrap().value;
        let worked = work(&scene, Scope::Figure).unwrap().value;
        let groups = loops(&scene).unwrap().value.groups;
        for lang in [Lang::En, Lang::Zh] {
            let options = WorksheetOptions::of_language(lang);
            let sheet = by_loops(&scene, &worked, &options).unwrap();
            let of = |found: fn(&DocumentBlock) -> bool| {
                sheet.blocks.iter().filter(|b| found(b)).count()
            };
            let loops: usize = groups.iter().map(|g| g.loops.len()).sum();
            let equations = |g: &GroupLoops| {
                let all = [&g.closures, &g.position, &g.velocities, &g.accelerations];
                g.loops.len() + all.map(Vec::len).iter().sum::<usize>()
            };
            assert!(of(|b| matches!(b, DocumentBlock::Figure { .. })) > loops, "{name}");
            let formulas = of(|b| matches!(b, DocumentBlock::Formula(_)));
            assert!(formulas >= groups.iter().map(equations).sum::<usize>(), "{name}");
            html::html(&sheet).unwrap();
            markdown::markdown(&sheet, name).unwrap();
            typst::typst(&sheet, name).unwrap();
            assert!(!pages::pages(&sheet).is_empty());
        }
    }
}

#[test]
fn a_formula_is_written_as_it_is_computed() {
    let s = |name: &str, value: f64| Formula::symbol(name, value);
    let difference = Formula::sum([(false, s("a", 5.0)), (true, s("b", 2.0))]);
    let product = Formula::product([Formula::whole(2), difference.clone().negative()]);
    assert_eq!((product.text().as_str(), product.value()), ("2\\,(b − a)", -6.0));
    let quotient = difference.over(s("c", 2.0).negative());
    assert_eq!((quotient.text().as_str(), quotient.value()), ("(b − a)/c", -1.5));
    assert_eq!(Formula::product([s("a", 5.0), Formula::whole(0)]).text(), "0");
    assert_eq!(Formula::sum([(true, s("a", 5.0))]).squared().text(), "a^2");
}

/// A scene that is refused names the reason; at a dead centre the matrix is singular.
#[test]
fn formulas_give_the_rates_of_the_analysis_on_all_cases() {
    let (mut shown, mut refused) = (0, 0);
    for folder in ["tests/cases", "tests/repro"] {
        for file in std::fs::read_dir(folder).unwrap() {
            let path = file.unwrap().path();
            let name = path.display().to_string();
            let Ok(text) = std::fs::read_to_string(&path) else { continue };
            // A case has its scene beside its answers.
            let text = match serde_json::from_str::<serde_json::Value>(&text) {
                Ok(case) if case["scene"].is_object() => case["scene"].to_string(),
                _ => text,
            };
            if Kind::of(text.as_bytes()) != Kind::Scene {
                continue;
            }
            let Ok(read) = scene::read(&text) else { continue };
            match loops(&read.value) {
                Ok(all) => {
                    judged(&name, &text, &read.value, &all.value);
                    shown += 1;
                }
                Err(_) => refused += 1,
            }
        }
    }
    assert!(shown > 100 && refused < shown, "{shown} shown, {refused} refused");
}
