//! Zhukovsky's lever compared with the force polygons, and the loads on the drawing of the
//! mechanism.

use hodograph::figure::forces::zhukovsky;
use hodograph::figure::sheet::{SheetOptions, drawing};
use hodograph::scene::{self, DiagramKind, Lang, driver_position, templates, with_driver_at};
use hodograph::worked::{Scope, Worked, work};
use serde_json::{Value as Json, json};

/// The total power of all drivers by the lever and by the polygons, hence the balance of a single
/// driver.
fn balances(scene: &scene::Scene, worked: &Worked) -> Option<[[f64; 2]; 2]> {
    let of = worked.equilibrium.as_ref()?;
    let lever = zhukovsky(scene, worked)?;
    let power = [-lever.moment * lever.mu, of.forces.power];
    let one = lever.balance(scene).and_then(|balance| Some([balance, *of.forces.drivers.first()?]));
    Some([power, one.unwrap_or(power)])
}

#[test]
fn the_lever_balances_as_the_polygons_do() {
    let (mut proven, mut faults) = (0, Vec::new());
    for t in templates::list() {
        let text = templates::get(t.name).unwrap();
        let scene = scene::read(text).unwrap().value;
        // Templates without loads get one on each link.
        let own = !scene.loads.is_empty();
        let scene = if own {
            scene
        } else {
            scene::read(super::loaded(text, &scene).0.to_string()).unwrap().value
        };
        let Some(start) = driver_position(&scene, 0) else { continue };
        for k in 0..if own { 4 } else { 1 } {
            let posed = with_driver_at(&scene, 0, start + 0.35 * f64::from(k));
            let Ok(worked) = work(&posed, Scope::Figure) else { continue };
            let Some(all) = balances(&posed, &worked.value) else { continue };
            proven += 1;
            let forces = &worked.value.equilibrium.as_ref().unwrap().forces;
            let sizes = [forces.largest_power, forces.largest];
            for ([lever, polygons], size) in all.into_iter().zip(sizes) {
                if polygons.is_finite()
                    && (lever - polygons).abs() > 1e-9 * polygons.abs().max(size)
                {
                    faults.push(format!("{} pose {k}: {lever} and {polygons}", t.name));
                }
            }
        }
    }
    println!("{proven} levers");
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(proven > 45, "{proven} levers");
}

#[test]
fn the_mechanism_shows_the_given_loads() {
    let text = templates::get("four-bar-forces").unwrap();
    let mut json: Json = serde_json::from_str(text).unwrap();
    json["links"]["4"].as_array_mut().unwrap().push(json!("X"));
    json["points"]["X"] = json!(["0.3 m", "0.2 m"]);
    json["springs"] = json!([{"from": "X", "to": "S3", "k": "40 N/m", "free": "0.1 m"}]);
    let scene = scene::read(json.to_string()).unwrap().value;
    let worked = work(&scene, Scope::Figure).unwrap().value;
    let figure =
        drawing(&scene, &worked, &SheetOptions::of_language(Lang::En), DiagramKind::Plane).unwrap();
    let ids: Vec<&str> = figure.items.iter().map(|i| i.id.as_str()).collect();
    for wanted in
        ["force-G-1", "force-G-2", "force-G-3", "couple-of-M-3", "spring-1", "spring-1-ground"]
    {
        assert!(ids.iter().any(|id| id.ends_with(wanted)), "{wanted} is missing among {ids:?}");
    }
    // Inertia and reactions are drawn at the separated links.
    assert!(ids.iter().all(|id| !id.contains("force-F")), "{ids:?}");
}
