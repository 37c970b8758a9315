//! The reactions of all templates are drawn and equal those of the rows.

use super::loaded;
use hodograph::equilibrium::ForceTotals;
use hodograph::scene::quantity::{Contact, contacts, parties};
use hodograph::scene::{self, PointId, Scene, driver_position, templates, with_driver_at};
use hodograph::worked::{Scope, work};
use serde_json::json;

/// Templates with a group that is not drawn, with words of the reason.
const LEFT_OUT: [(&str, &str); 2] = [
    ("belt-crank-rocker", "belts, chains and ropes"),
    ("double-butterfly", "there is no method for 6 links"),
];

/// A template with forces and couples on all links except the parts of cylinders, with the
/// reactions of pins and contacts asked for.
pub fn asked(name: &str) -> Option<Scene> {
    let text = templates::get(name).ok()?;
    let plain = scene::read(text).ok()?.value;
    let (mut json, _) = loaded(text, &plain);
    let forces = json["forces"].as_array_mut()?;
    let rod = |l: usize| plain.drivers.iter().any(|d| d.kind.parts().contains(&scene::LinkId(l)));
    for (k, link) in
        plain.links.iter().enumerate().filter(|(k, _)| *k != plain.ground.0 && !rod(*k))
    {
        forces.push(json!({"on": link.name, "M": format!("{} N*m", 5.0 - 3.0 * k as f64)}));
    }
    let link = |l| plain.link_name(l);
    let mut find: Vec<String> = Vec::new();
    for a in 0..plain.links.len() {
        for b in a + 1..plain.links.len() {
            let [a, b] = [a, b].map(scene::LinkId);
            if let [Contact::Pin(_) | Contact::Rolling(..)] = contacts(&plain, a, b)[..] {
                find.push(format!("F_{},{}", link(a), link(b)));
            }
        }
    }
    for p in (0..plain.points.len()).map(PointId).filter(|p| parties(&plain, *p) > 2) {
        find.extend(plain.carriers(p).map(|l| format!("F_{}{}", plain.point_name(p), link(l))));
    }
    find.push("P".into());
    json["find"] = json!(find);
    scene::read(json.to_string()).ok().map(|read| read.value)
}

/// Every group of every template is drawn, except those with a known reason.
#[test]
fn reactions_of_templates_are_drawn() {
    let (mut drawn, mut whole) = (0, 0);
    let mut failures = Vec::new();
    for name in templates::list().iter().map(|t| t.name) {
        let Some(scene) = asked(name) else { continue };
        let why = LEFT_OUT.iter().find(|(left_out, _)| *left_out == name).map(|(_, why)| *why);
        for turned in [0.0, 0.7, 2.1, -1.3] {
            let there = driver_position(&scene, 0)
                .map_or_else(|| scene.clone(), |start| with_driver_at(&scene, 0, start + turned));
            let Ok(worked) = work(&there, Scope::Questions) else { continue };
            let worked = worked.value;
            let Some(of) = &worked.equilibrium else { continue };
            let named = |l: &scene::LinkId| there.link_name(*l);
            let told: Vec<String> = of
                .undrawn
                .iter()
                .map(|u| {
                    format!(
                        "{}: {}",
                        u.links.iter().map(named).collect::<Vec<_>>().join(" "),
                        u.why.en
                    )
                })
                .collect();
            match (why, told.first()) {
                (None, None) => {}
                (Some(why), Some(first)) if first.contains(why) => continue,
                _ => {
                    failures.push(format!("{name} at {turned}: left out {told:?}"));
                    break;
                }
            }
            match ForceTotals::of(&there, &worked.configuration, of) {
                Some(all) if (all.loads + all.ground).norm() > 1e-9 * of.forces.largest => {
                    failures.push(format!(
                        "{name} at {turned}: the ground bears {:?}, the loads are {:?}",
                        all.ground, all.loads
                    ));
                }
                Some(_) => whole += 1,
                None => failures
                    .push(format!("{name} at {turned}: a reaction of the ground is missing")),
            }
            for r in &worked.results {
                let text = &there.find[r.find].text;
                match r.agreement {
                    Some(a) if a.holds() => drawn += 1,
                    Some(a) => failures.push(format!("{name} at {turned}: {text} {a:?}")),
                    None => failures.push(format!("{name} at {turned}: {text} is not drawn")),
                }
            }
        }
    }
    assert!(failures.is_empty(), "{} failures\n{}", failures.len(), failures.join("\n"));
    assert!(drawn >= 100 && whole >= 100, "{drawn} drawn, {whole} in equilibrium as a whole");
}
