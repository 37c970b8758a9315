//! Forces against virtual work: on every template each moving link is loaded, and the drivers' balancing moments and forces must do the opposite work.

use hodograph::answer::Value;
use hodograph::certified::ladder::{Part, certify};
use hodograph::geom::Vec2;
use hodograph::scene::{self, Scene, templates};
use hodograph::worked::{Scope, Worked, work};
use serde_json::{Value as Json, json};

/// Digits asked of the ladder.
const DIGITS: usize = 8;

/// A load of a scene: force at a point of a link.
struct Load {
    link: String,
    point: String,
    force: Vec2,
}

/// A template with a force at a point of each moving link, and the questions for the points' velocities and the drivers' balance.
fn loaded(text: &str, scene: &Scene) -> (Json, Vec<Load>) {
    let mut json: Json = serde_json::from_str(text).unwrap();
    let mut loads = Vec::new();
    for (k, link) in scene.links.iter().enumerate() {
        let Some(p) = link.points.last().filter(|_| k != scene.ground.0) else { continue };
        // Numbers without a pattern, the same in every run.
        let force = Vec2::new(37.0 + 13.0 * k as f64, -29.0 + 17.0 * (k % 3) as f64);
        loads.push(Load { link: link.name.clone(), point: scene.point_name(*p).to_owned(), force });
    }
    json["forces"] =
        loads.iter().map(|l| json!({"on": l.link, "at": l.point, "F": [format!("{} N", l.force.x), format!("{} N", l.force.y)]})).collect();
    let mut find: Vec<String> = Vec::new();
    for l in &loads {
        let v = format!("v_{}", l.point);
        if !find.contains(&v) {
            find.push(v);
        }
    }
    for (d, driver) in scene.drivers.iter().enumerate() {
        let letter = if driver.kind.turns() { "M" } else { "F" };
        find.push(if d == 0 { format!("{letter}_b") } else { format!("{letter}_b{}", d + 1) });
    }
    for key in ["composite", "attempts", "readings"] {
        json.as_object_mut().unwrap().remove(key);
    }
    json["find"] = json!(find);
    (json, loads)
}

fn answer(scene: &Scene, worked: &Worked, find: &str) -> Option<Value> {
    let i = scene.find.iter().position(|f| f.text == find)?;
    worked.results.iter().find(|r| r.find == i).map(|r| r.computed)
}

#[test]
fn balancing_moments_do_the_work_of_the_loads() {
    let (mut failures, mut checked, mut drawn) = (Vec::new(), 0, 0);
    for template in templates::list() {
        let name = template.name;
        let text = templates::get(name).unwrap();
        let Ok(plain) = scene::read(text) else { continue };
        // A template with forces of its own lacks points without them.
        if !plain.value.loads.is_empty() {
            continue;
        }
        let (json, loads) = loaded(text, &plain.value);
        let scene = match scene::read(json.to_string()) {
            Ok(read) => read.value,
            Err(faults) => {
                failures.push(format!("{name}: {faults}"));
                continue;
            }
        };
        let worked = match work(&scene, Scope::Questions) {
            Ok(worked) => worked.value,
            Err(faults) => {
                failures.push(format!("{name}: {faults}"));
                continue;
            }
        };
        let mut work = 0.0;
        let mut size = 0.0;
        for l in &loads {
            let Some(Value::Vector(v)) = answer(&scene, &worked, &format!("v_{}", l.point)) else {
                failures.push(format!("{name}: v_{} is not answered", l.point));
                continue;
            };
            work += v.dot(l.force);
            size += v.norm() * l.force.norm();
        }
        for (d, driver) in scene.drivers.iter().enumerate() {
            let find = &scene.find[scene.find.len() - scene.drivers.len() + d].text;
            let Some(Value::Scalar(balance)) = answer(&scene, &worked, find) else {
                failures.push(format!("{name}: {find} is not answered: {:?}", worked.unanswered));
                continue;
            };
            work += balance * driver.rate.value;
        }
        if work.abs() > 1e-9 * size {
            failures.push(format!("{name}: the power is out of balance by {work} W of {size} W"));
        }
        checked += 1;
        for (r, c) in worked.results.iter().zip(certify(&scene, &worked, DIGITS)) {
            let find = &scene.find[r.find];
            if let (Value::Scalar(x), Some(n)) = (r.computed, c.part(Part::Scalar)) {
                let off = (x - n.enclosure().approx).abs();
                if off > 1e-9 * r.scale.max(x.abs()) {
                    failures.push(format!("{name}: {} by the rows {x}, by the ladder {}", find.text, n.enclosure().approx));
                }
            }
            if let Some(a) = r.agreement.filter(|_| find.what.kind().is_of_forces()) {
                drawn += 1;
                if !a.holds() {
                    failures.push(format!("{name}: {} drawing and analysis disagree: {a:?}", find.text));
                }
            }
        }
    }
    println!("{checked} templates, {drawn} balancing moments drawn");
    assert!(checked > 40 && drawn > 20, "{checked} templates, {drawn} drawn");
    assert!(failures.is_empty(), "{} failures:\n{}", failures.len(), failures.join("\n"));
}
