//! Every template: solved both ways, against answers computed without this project, and drawn.

use hodograph::answer::Value;
use hodograph::scene::{self, templates};
use hodograph::worked::{Scope, work};

#[test]
fn answers_are_as_expected() {
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/templates-expected.json")).unwrap();
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
        for outcome in &worked.results {
            let find = &scene.find[outcome.find].text;
            let e = &expected[t.name][find];
            let component = |k: &str| e[k].as_f64().unwrap_or_else(|| panic!("{} {find}: no expected {k}", t.name));
            let off = |v: Value| match v {
                Value::Scalar(s) => (s - component("value")).abs() / component("value").abs().max(1e-3),
                Value::Vector(v) => {
                    let (x, y) = (component("x"), component("y"));
                    (v.x - x).hypot(v.y - y) / x.hypot(y).max(1e-3)
                }
            };
            let drawn = outcome.drawn.as_ref().map_or(f64::INFINITY, |a| off(a.value));
            let computed = off(outcome.computed);
            if !(drawn < 1e-9 && computed < 1e-9) {
                failures.push(format!("{} {find}: drawing off by {drawn:e}, analysis by {computed:e}", t.name));
            }
            if outcome.agreement.is_some_and(|a| a.difference > 1e-11) {
                failures.push(format!("{} {find}: drawing and analysis differ by {:e}", t.name, outcome.agreement.unwrap().difference));
            }
        }
    }
    assert!(failures.is_empty(), "{} failures:\n{}", failures.len(), failures.join("\n"));
}
