//! Every template: solved by both methods, compared with answers computed without this project, and
//! drawn.

mod asked;
mod letters;
mod names;
mod senses;
#[path = "../wide/mod.rs"]
mod wide;

use hodograph::answer::AnswerValue;
use hodograph::scene::{self, templates};
use hodograph::worked::{Scope, work};
use std::collections::BTreeSet;

#[test]
fn answers_are_as_expected() {
    let text = std::fs::read_to_string(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/tests/templates-expected.json"
    ))
    .unwrap();
    let expected: serde_json::Value = serde_json::from_str(&text).unwrap();
    let mut failures = Vec::new();
    for t in templates::list() {
        let scene = scene::read(templates::get(t.name).unwrap()).unwrap().value;
        let worked = match work(&scene, Scope::Figure) {
            Ok(w) => w.value,
            Err(f) => {
                failures.push(format!("{}: {f}", t.name));
                continue;
            }
        };
        // Answers and expectations are one set: a question without an answer, or an expected answer
        // without a question, is a fault.
        for unanswered in &worked.unanswered {
            failures
                .push(format!("{} {}: is not answered", t.name, scene.find[unanswered.find].text));
        }
        let asked: BTreeSet<&str> = scene.find.iter().map(|f| f.text.as_str()).collect();
        let told =
            worked.results.iter().map(|r| r.find).chain(worked.unanswered.iter().map(|u| u.find));
        let told: BTreeSet<&str> = told.map(|find| scene.find[find].text.as_str()).collect();
        let known: BTreeSet<&str> = expected[t.name]
            .as_object()
            .into_iter()
            .flatten()
            .map(|(find, _)| find.as_str())
            .collect();
        let mut fault = |what: &str, finds: Vec<&&str>| {
            failures.extend(finds.iter().map(|find| format!("{} {find}: {what}", t.name)));
        };
        fault(
            "is asked, and has neither an answer nor a reason",
            asked.difference(&told).collect(),
        );
        fault(
            "is asked, and tests/templates-expected.json has no answer to it",
            asked.difference(&known).collect(),
        );
        fault(
            "is in tests/templates-expected.json, and the template does not ask for it",
            known.difference(&asked).collect(),
        );
        for outcome in
            worked.results.iter().filter(|r| known.contains(scene.find[r.find].text.as_str()))
        {
            let find = &scene.find[outcome.find].text;
            let e = &expected[t.name][find];
            let component = |k: &str| {
                e[k].as_f64().unwrap_or_else(|| panic!("{} {find}: no expected {k}", t.name))
            };
            let off = |v: AnswerValue| match v {
                AnswerValue::Scalar(s) => {
                    (s - component("value")).abs() / component("value").abs().max(1e-3)
                }
                AnswerValue::Vector(v) => {
                    let (x, y) = (component("x"), component("y"));
                    (v.x - x).hypot(v.y - y) / x.hypot(y).max(1e-3)
                }
                AnswerValue::Point(p) => (p.x - component("x")).hypot(p.y - component("y")),
            };
            // Centres are drawn in a figure of their own: see tests/centres.rs.
            let place = matches!(outcome.computed, AnswerValue::Point(_));
            let drawn = outcome
                .drawn
                .as_ref()
                .map_or(if place { 0.0 } else { f64::INFINITY }, |a| off(a.value));
            let computed = off(outcome.computed);
            if !(drawn < 1e-9 && computed < 1e-9) {
                failures.push(format!(
                    "{} {find}: drawing off by {drawn:e}, analysis by {computed:e}",
                    t.name
                ));
            }
            if outcome.agreement.is_some_and(|a| a.difference > 1e-11) {
                failures.push(format!(
                    "{} {find}: drawing and analysis differ by {:e}",
                    t.name,
                    outcome.agreement.unwrap().difference
                ));
            }
        }
    }
    let names: BTreeSet<&str> = templates::list().iter().map(|t| t.name).collect();
    let unknown =
        expected.as_object().unwrap().keys().filter(|name| !names.contains(name.as_str()));
    failures.extend(
        unknown
            .map(|name| format!("{name} is in tests/templates-expected.json, and is no template")),
    );
    assert!(failures.is_empty(), "{} failures:\n{}", failures.len(), failures.join("\n"));
}

/// Two different ends of vectors in one polygon never have one name, in either notation.
#[test]
fn marks_are_distinguished() {
    use hodograph::construct::PolygonMark;
    use hodograph::notation::Notation;
    use hodograph::plan::text::PlanWriter;
    use hodograph::plan::{Term, VertexId};
    use hodograph::scene::DiagramKind;
    for t in templates::list() {
        let scene = scene::read(templates::get(t.name).unwrap()).unwrap().value;
        let worked = work(&scene, Scope::Figure).unwrap().value;
        for lang in [scene::Lang::En, scene::Lang::Zh] {
            let notation = Notation::of_language(lang);
            let w = PlanWriter { scene: &scene, plan: &worked.plan, notation: &notation, lang };
            for on in DiagramKind::POLYGONS {
                let Some(p) = worked.construction.polygon(on) else { continue };
                let mut parts: Vec<(String, Term)> = Vec::new();
                for edge in &p.edges {
                    if let PolygonMark::Part(term) | PolygonMark::Again(term) = edge.to.0 {
                        let name = w.part(on, &term);
                        let clash = parts.iter().find(|(n, other)| *n == name && *other != term);
                        assert!(clash.is_none(), "{}: {name} names {term:?} and {clash:?}", t.name);
                        parts.push((name, term));
                    }
                }
                let images: Vec<String> = (0..p.images.len())
                    .map(VertexId)
                    .filter(|v| !w.plan.vertex(*v).fixed && p.images[v.0].is_some())
                    .map(|v| w.image(on, v))
                    .collect();
                for (i, a) in images.iter().enumerate() {
                    assert!(!images[..i].contains(a), "{}: {a} names two images", t.name);
                    assert!(*a != w.pole(on), "{}: {a} names the pole and an image", t.name);
                }
            }
        }
    }
}
