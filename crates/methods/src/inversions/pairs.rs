//! Other pairs that an inversion keeps besides its pins and guides: wheels that roll on one
//! another, and drivers between links.
//!
//! Pitch circles do not depend on the ground: they keep sizes and contact, and the places of the
//! pose determine the angle of each wheel. A straight track keeps its momentary direction. A driver
//! is a relative motion of two links and is kept; only the order of the two is exchanged if the
//! driven link is the ground. A cylinder is a distance of two pins; if its barrel or rod is the
//! ground, it is written as the equivalent guide, with the other part as slider.

use super::belts;
use hodograph_mechanism::position::{Configuration, Path};
use hodograph_scene::{
    Contours, Driver, DriverKind, Guide, LinkId, Rolling, RollingKind, Scene, Sizes,
};
use serde_json::{Value as Json, json};

pub(super) fn metres(x: f64) -> String {
    format!("{x:?} m")
}

/// Returns the sections `gears`, `rolling`, `belts`, `chains` and `ropes`.
pub(super) fn rolling(scene: &Scene, at: &Configuration) -> [Vec<Json>; 5] {
    let (mut gears, mut wheels, mut ropes) = (Vec::new(), Vec::new(), Vec::new());
    let [belts, chains] = belts::sections(scene);
    for pair in &scene.rolling {
        let direction = pair.guide().and_then(|g| match at.guides[g.0] {
            Some(Path::Line { direction, .. }) => Some(format!("{:?} rad", direction.angle())),
            Some(Path::Arc { .. }) | None => None,
        });
        match pair.kind {
            RollingKind::Gears => gears.extend(gear(scene, pair, direction)),
            RollingKind::Wheel => wheels.extend(wheel(scene, pair, direction)),
            RollingKind::Rope => ropes.extend(rope(scene, pair, direction)),
            RollingKind::Belt | RollingKind::Chain => {}
        }
    }
    [gears, wheels, belts, chains, ropes]
}

/// Returns two gears, or a gear on its rack.
fn gear(scene: &Scene, pair: &Rolling, direction: Option<String>) -> Option<Json> {
    let [a, b] = pair.links.map(|l| scene.link_name(l));
    let at = scene.point_name(pair.contact()?);
    let mut out = match &pair.contours {
        Contours::Circles { centres, sizes, hollow, .. } => {
            let mut out =
                json!({"links": [a, b], "centres": centres.map(|p| scene.point_name(p)), "at": at});
            match sizes {
                Sizes::Radii(radii) => {
                    out["radii"] = radii.iter().map(|r| metres(r.value)).collect()
                }
                Sizes::Teeth(teeth) => out["teeth"] = json!(teeth),
            }
            if let Some(i) = hollow {
                out["ring"] = json!([a, b][*i]);
            }
            out
        }
        Contours::Track { centre, radius, .. } => {
            json!({"links": [b, a], "centres": [scene.point_name(*centre)], "radii": [metres(radius.value)], "rack": a, "angle": direction, "at": at})
        }
        Contours::Belt { .. } => return None,
    };
    if let Some(flanks) = &pair.flanks {
        let teeth: Vec<u32> = flanks.teeth.iter().copied().flatten().collect();
        out["teeth"] = json!(teeth);
        if let Some(fields) = out.as_object_mut() {
            fields.remove("radii");
        }
        if let Some(module) = flanks.module {
            out["module"] = json!(metres(module));
        }
        out["pressure_angle"] = json!(format!("{:?} rad", flanks.pressure_angle));
        out["addendum"] = json!(flanks.addendum);
        out["clearance"] = json!(flanks.clearance);
        if !flanks.shifts.is_empty() {
            out["shift"] = json!(flanks.shifts);
        }
    }
    Some(out)
}

/// Returns a drum and the load on its rope.
fn rope(scene: &Scene, pair: &Rolling, direction: Option<String>) -> Option<Json> {
    let ([load, drum], [_, radius]) = (
        pair.links.map(|l| scene.link_name(l)),
        pair.sizes(&hodograph_scene::exact::Inputs::<f64>::of(scene)),
    );
    let centre = scene.point_name(pair.centres()[1]?);
    let at = scene.point_name(pair.contact()?);
    Some(
        json!({"drum": drum, "centre": centre, "radius": metres(radius), "load": load, "angle": direction, "at": at}),
    )
}

/// Returns a wheel on its track.
fn wheel(scene: &Scene, pair: &Rolling, direction: Option<String>) -> Option<Json> {
    let [on, wheel] = pair.links.map(|l| scene.link_name(l));
    let at = scene.point_name(pair.contact()?);
    Some(match &pair.contours {
        Contours::Circles { centres: [track, centre], hollow, .. } => {
            let [size, own] =
                pair.sizes(&hodograph_scene::exact::Inputs::<f64>::of(scene)).map(f64::abs);
            json!({
                "wheel": wheel, "centre": scene.point_name(*centre), "radius": metres(own), "on": on,
                "track": scene.point_name(*track), "track_radius": metres(size), "inside": hollow.is_some(), "at": at,
            })
        }
        Contours::Track { centre, radius, .. } => {
            json!({"wheel": wheel, "centre": scene.point_name(*centre), "radius": metres(radius.value), "on": on, "angle": direction, "at": at})
        }
        Contours::Belt { .. } => return None,
    })
}

/// Returns for a cylinder with the ground as barrel or rod: the ground's pin, the other pin, and
/// the number of the other part.
fn part(scene: &Scene, kind: &DriverKind, ground: LinkId) -> Option<[String; 3]> {
    let (links, [a, b]) = (kind.parts(), kind.ends()?.map(|p| scene.point_name(p).to_owned()));
    let number = |k: usize| {
        links.get(k).map_or_else(String::new, |l: &LinkId| scene.link_name(*l).to_owned())
    };
    match links.iter().position(|l| *l == ground)? {
        0 => Some([a, b, number(1)]),
        _ => Some([b, a, number(0)]),
    }
}

/// Returns the pin of the scene's cylinder that the ground carries as its barrel or rod.
pub(super) fn pin_of_part(scene: &Scene, ground: LinkId) -> Option<String> {
    scene.drivers.iter().find_map(|d| part(scene, &d.kind, ground)).map(|[own, ..]| own)
}

/// Returns the guide equivalent to a cylinder if the ground is a part of it: along its line,
/// positive outward.
pub(super) fn cylinder(scene: &Scene, at: &Configuration, ground: LinkId) -> Option<Json> {
    scene.drivers.iter().find_map(|d| {
        let [_, end, other] = part(scene, &d.kind, ground)?;
        let [a, b] = d.kind.ends()?.map(|p| at.points[p.0]);
        let (a, b) = (a?, b?);
        let out = if scene.point_name(d.kind.ends()?[0]) == end { a - b } else { b - a };
        let mut guide = json!({"pin": end, "on": scene.link_name(ground), "angle": format!("{:?} rad", out.angle())});
        if !other.is_empty() {
            guide["slider"] = json!(other);
        }
        Some(guide)
    })
}

/// Returns all drivers of the scene with another ground, and their names.
pub(super) fn kept(scene: &Scene, ground: LinkId) -> (String, Json) {
    let rate = |d: &Driver| {
        if d.rate.value == 0.0 && scene.drivers.len() == 1 { 1.0 } else { d.rate.value }
    };
    let (names, drivers): (Vec<String>, Vec<Json>) =
        scene.drivers.iter().map(|d| driver(scene, d, rate(d), ground)).unzip();
    (names.join(", "), Json::Array(drivers))
}

fn driver(scene: &Scene, d: &Driver, rate: f64, ground: LinkId) -> (String, Json) {
    let link = |l: LinkId| scene.link_name(l).to_owned();
    let slide = |runner: String, rate: f64| {
        (runner.clone(), json!({"slide": runner, "velocity": format!("{rate:?} m/s")}))
    };
    if let Some((turned, against)) = d.kind.turned() {
        let ([turned, against], rate) =
            if turned == ground { ([against, turned], -rate) } else { ([turned, against], rate) };
        let mut out = json!({"link": link(turned), "omega": format!("{rate:?} rad/s")});
        if against != ground {
            out["against"] = json!(link(against));
        }
        return (link(turned), out);
    }
    if let Some(guide) = d.kind.guide() {
        let (runner, sense) = runner(scene, &scene.guides[guide.0], ground);
        return slide(runner, sense * rate);
    }
    if let Some([_, end, other]) = part(scene, &d.kind, ground) {
        return slide(if other.is_empty() { end } else { other }, rate);
    }
    let ends: String = d.kind.ends().into_iter().flatten().map(|p| scene.point_name(p)).collect();
    let mut out = json!({"cylinder": ends, "rate": format!("{rate:?} m/s")});
    if !d.kind.parts().is_empty() {
        out["links"] = d.kind.parts().iter().map(|l| link(*l)).collect();
    }
    (ends, out)
}

/// Returns the runner of a guide, and its sense: if the slider is the ground, its guide runs in the
/// opposite sense.
fn runner(scene: &Scene, g: &Guide, ground: LinkId) -> (String, f64) {
    match (g.slider, g.pin) {
        (Some(s), _) if s == ground => (scene.link_name(g.on).to_owned(), -1.0),
        (Some(s), _) => (scene.link_name(s).to_owned(), 1.0),
        (None, pin) => (pin.map_or_else(String::new, |p| scene.point_name(p).to_owned()), 1.0),
    }
}
