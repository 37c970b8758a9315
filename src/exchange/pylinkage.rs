//! Linkages of pylinkage: a script that builds the linkage, and the file of its module
//! `mechanism`, in both directions. Lengths are in millimetres; a step turns the crank by one
//! degree.
//!
//! # Source
//! pylinkage 1.3: `pylinkage.mechanism.serialization`, `pylinkage.dyads`.

use super::linkage::{Linkage, LinkageBody, LinkageJoint, LinkageSlide, not_exported};
use super::placing::{PlacedJoint, PlacingRule, order};
use crate::diag::{Both, Diagnostic, Faults, both};
use crate::geom::{Point, Vec2};
use serde_json::{Value as Json, json};
use std::f64::consts::TAU;
use std::fmt::Write as _;

/// Steps of a turn.
const STEPS: f64 = 360.0;

/// Returns a Python script that builds the linkage as `linkage`, its components in the order of
/// solution.
///
/// # Errors
/// The errors of [`order`].
pub fn script(linkage: &Linkage) -> Result<String, Faults> {
    let placed = order(linkage)?;
    let title: String = linkage.title.chars().filter(|c| !c.is_control()).collect();
    let mut out = format!("# {title}\n# Millimetres; a step turns the crank by one degree.\n");
    out += "from math import tau\n\nfrom pylinkage.actuators import Crank\n";
    out += "from pylinkage.components import Ground\n";
    out += "from pylinkage.dyads import FixedDyad, RRPDyad, RRRDyad\n";
    out += "from pylinkage.simulation import Linkage\n\n";
    let name = |j: usize| text(&linkage.joints[j].name);
    let joint = |j: usize| format!("joints[{}]", name(j));
    out += "joints = {}\n";
    for (j, fixed) in linkage.joints.iter().enumerate().filter(|(_, joint)| joint.fixed) {
        let Point { x, y } = fixed.at;
        let _ = writeln!(out, "{} = Ground({x}, {y}, name={})", joint(j), name(j));
    }
    for PlacedJoint { joint: j, rule } in &placed {
        let Point { x, y } = linkage.joints[*j].at;
        let made = match rule {
            PlacingRule::Crank => {
                let arm = linkage.joints[*j].at - linkage.joints[linkage.pivot].at;
                let turn = if linkage.rate < 0.0 { "-tau" } else { "tau" };
                format!(
                    "Crank({}, radius={}, angular_velocity={turn} / {STEPS}, initial_angle={}",
                    joint(linkage.pivot),
                    arm.norm(),
                    arm.angle()
                )
            }
            PlacingRule::Carried { base: [a, b], parts: [along, left] } => {
                let parts = Vec2::new(*along, *left);
                let (distance, angle) = (parts.norm() * linkage.length(*a, *b), parts.angle());
                format!("FixedDyad({}, {}, {distance}, {angle}", joint(*a), joint(*b))
            }
            PlacingRule::Slotted { pivot, pin, parts: [along, left] } => {
                let arm = Vec2::new(*along, *left);
                let (a, b) = (joint(*pivot), joint(*pin));
                format!("FixedDyad({a}, {b}, {}, {}", arm.norm(), arm.angle())
            }
            PlacingRule::Circles { centres: [a, b], .. } => {
                let (one, other) = (linkage.length(*a, *j), linkage.length(*b, *j));
                format!("RRRDyad({}, {}, {one}, {other}, {x}, {y}", joint(*a), joint(*b))
            }
            PlacingRule::OnLine { centre, slide, .. } => {
                let (_, u) = linkage.line(*slide);
                let ends = [0.0, 1e3].map(|t| (x + t * u.x, y + t * u.y));
                let _ = writeln!(out, "line_{slide} = [Ground{:?}, Ground{:?}]", ends[0], ends[1]);
                format!(
                    "RRPDyad({}, *line_{slide}, {}, {x}, {y}",
                    joint(*centre),
                    linkage.length(*centre, *j)
                )
            }
        };
        let _ = writeln!(out, "{} = {made}, name={})", joint(*j), name(*j));
    }
    let lines: String = placed
        .iter()
        .filter_map(|p| match p.rule {
            PlacingRule::OnLine { slide, .. } => Some(format!("*line_{slide}, ")),
            PlacingRule::Crank
            | PlacingRule::Carried { .. }
            | PlacingRule::Slotted { .. }
            | PlacingRule::Circles { .. } => None,
        })
        .collect();
    let _ = writeln!(
        out,
        "\nlinkage = Linkage([{lines}*joints.values()], name={})\n\n\
         if __name__ == \"__main__\":\n    \
         for _ in linkage.step(iterations={STEPS}):\n        \
         print(*((j.name, j.x, j.y) for j in joints.values()))",
        text(&title)
    );
    Ok(out)
}

/// A Python string.
fn text(of: &str) -> String {
    Json::from(of).to_string()
}

/// Returns the file that `pylinkage.mechanism.mechanism_from_json` reads. Every link of more than
/// two joints is written as links of two joints with one name.
///
/// # Errors
/// The errors of [`order`]; `export` for a slot in a moving link, and for a straight lever whose
/// third joint carries other links: the program has no joint for them there.
pub fn file(linkage: &Linkage) -> Result<String, Faults> {
    let placed = order(linkage)?;
    let name = |j: usize| Json::from(linkage.joints[j].name.clone());
    let mut joints: Vec<Json> = Vec::new();
    let mut links: Vec<Json> = Vec::new();
    let fixed: Vec<usize> =
        (0..linkage.joints.len()).filter(|j| linkage.joints[*j].fixed).collect();
    let place = |j: usize| {
        let Point { x, y } = linkage.joints[j].at;
        json!([x, y])
    };
    joints.extend(
        fixed.iter().map(|j| json!({"id": name(*j), "type": "ground", "position": place(*j)})),
    );
    let grounded: Vec<Json> = fixed.iter().map(|j| name(*j)).collect();
    links.push(json!({"id": "ground", "type": "ground", "joints": grounded}));
    let bar = |body: usize, a: usize, b: usize, links: &mut Vec<Json>| {
        let id = format!("link{}", links.len());
        let of = &linkage.bodies[body].name;
        links.push(json!({"id": id, "type": "link", "name": of, "joints": [name(a), name(b)]}));
    };
    for PlacedJoint { joint: j, rule } in &placed {
        let mut kind = json!({"id": name(*j), "type": "revolute", "position": place(*j)});
        match rule {
            PlacingRule::Crank => {
                let arm = linkage.joints[*j].at - linkage.joints[linkage.pivot].at;
                let turn = if linkage.rate < 0.0 { -TAU } else { TAU };
                links.push(json!({
                    "id": "crank", "type": "driver", "name": linkage.bodies[linkage.crank].name,
                    "joints": [name(linkage.pivot), name(*j)], "motor_joint": name(linkage.pivot),
                    "angular_velocity": turn / STEPS, "initial_angle": arm.angle(),
                }));
            }
            PlacingRule::Carried { base: [a, b], parts: [along, left] } => {
                let used = placed.iter().any(|p| p.from().contains(j));
                if !used {
                    let parts = Vec2::new(*along, *left);
                    kind = json!({
                        "id": name(*j), "type": "tracker", "position": place(*j),
                        "ref_joint1_id": name(*a), "ref_joint2_id": name(*b),
                        "distance": parts.norm() * linkage.length(*a, *b), "angle": parts.angle(),
                    });
                } else if left.abs() < 1e-6 {
                    let what = both!(
                        "a straight lever with a third joint, {}, in a file; write a script, x.py",
                        linkage.joints[*j].name
                    );
                    return Err(not_exported(what).into());
                } else if let Some(body) = body_of(linkage, [*a, *b, *j]) {
                    bar(body, *a, *j, &mut links);
                    bar(body, *b, *j, &mut links);
                }
            }
            PlacingRule::Slotted { .. } => {
                let what = both!("a slot in a moving link in a file; write a script, x.py");
                return Err(not_exported(what).into());
            }
            PlacingRule::Circles { centres, bodies, .. } => {
                for (centre, body) in centres.iter().zip(bodies) {
                    bar(*body, *centre, *j, &mut links);
                }
            }
            PlacingRule::OnLine { centre, body, slide, .. } => {
                let (_, u) = linkage.line(*slide);
                kind = json!({
                    "id": name(*j), "type": "prismatic", "position": place(*j),
                    "axis": [u.x, u.y], "line_point": place(*j),
                });
                bar(*body, *centre, *j, &mut links);
            }
        }
        joints.push(kind);
    }
    let all = json!({"name": linkage.title, "joints": joints, "links": links, "ground": "ground"});
    Ok(format!("{all:#}\n"))
}

fn body_of(linkage: &Linkage, joints: [usize; 3]) -> Option<usize> {
    linkage.bodies.iter().position(|b| joints.iter().all(|j| b.joints.contains(j)))
}

/// Reads a file of pylinkage's module `mechanism`; links with one name are one link.
///
/// # Errors
/// `import` if it is not such a file, or has no driven link.
pub fn read(source: &str) -> Result<Linkage, Faults> {
    let file: Json =
        serde_json::from_str(source).map_err(|e| Faults::from(wrong(Both::same(e.to_string()))))?;
    let list = |key: &str| file[key].as_array().cloned().unwrap_or_default();
    let (given, bars) = (list("joints"), list("links"));
    if bars.is_empty() || given.is_empty() {
        return Err(wrong(both!("it has no joints and links")).into());
    }
    let pair = |value: &Json| Some((value[0].as_f64()?, value[1].as_f64()?));
    let word = |value: &Json| value.as_str().unwrap_or_default().to_owned();
    let grounded: Vec<String> = bars
        .iter()
        .filter(|l| l["type"] == "ground")
        .flat_map(|l| l["joints"].as_array().cloned().unwrap_or_default())
        .map(|id| word(&id))
        .collect();
    let (mut joints, mut slides, mut tracked) = (Vec::new(), Vec::new(), Vec::new());
    for (j, joint) in given.iter().enumerate() {
        let id = word(&joint["id"]);
        let Some((x, y)) = pair(&joint["position"]) else {
            let d = wrong(both!("joint `{id}` has no place"));
            return Err(d.into());
        };
        let fixed = joint["type"] == "ground" || grounded.contains(&id);
        if joint["type"] == "prismatic"
            && let Some((x, y)) = pair(&joint["axis"])
            && let Some(direction) = Vec2::new(x, y).unit()
        {
            slides.push(LinkageSlide { joint: j, on: None, block: None, direction });
        }
        if joint["type"] == "tracker" {
            tracked.push((j, [word(&joint["ref_joint1_id"]), word(&joint["ref_joint2_id"])]));
        }
        joints.push(LinkageJoint { name: id, at: Point::new(x, y), fixed });
    }
    let index = |id: &str| joints.iter().position(|j: &LinkageJoint| j.name == id);
    let mut bodies: Vec<LinkageBody> = Vec::new();
    let mut driven = None;
    for bar in bars.iter().filter(|l| l["type"] != "ground") {
        let name = bar["name"].as_str().or(bar["id"].as_str()).unwrap_or_default().to_owned();
        let of: Vec<usize> = bar["joints"]
            .as_array()
            .into_iter()
            .flatten()
            .filter_map(|id| index(id.as_str()?))
            .collect();
        let body = bodies.iter().position(|b| b.name == name).unwrap_or_else(|| {
            bodies.push(LinkageBody { name, joints: Vec::new() });
            bodies.len() - 1
        });
        for j in of {
            if !bodies[body].joints.contains(&j) {
                bodies[body].joints.push(j);
            }
        }
        if let (true, Some(pivot)) =
            (bar["type"] == "driver", bar["motor_joint"].as_str().and_then(&index))
        {
            driven = Some((body, pivot, bar["angular_velocity"].as_f64().unwrap_or(1.0)));
        }
    }
    for (j, base) in tracked {
        let ends = base.map(|id| index(&id));
        let carrier = bodies
            .iter_mut()
            .find(|b| ends.iter().all(|end| end.is_some_and(|end| b.joints.contains(&end))));
        if let Some(carrier) = carrier {
            carrier.joints.push(j);
        }
    }
    let Some((crank, pivot, rate)) = driven else {
        return Err(wrong(both!("no link is a driver")).into());
    };
    let title = word(&file["name"]);
    Ok(Linkage { title, joints, bodies, slides, crank, pivot, rate: rate.signum() })
}

fn wrong(why: Both) -> Diagnostic {
    Diagnostic::error("import", both!("not a mechanism of pylinkage: {}", why))
        .help(both!("write it with pylinkage.mechanism.mechanism_to_json"))
}
