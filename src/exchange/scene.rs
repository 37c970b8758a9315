//! The text of a scene from a linkage.

use super::linkage::Linkage;
use crate::diag::{Diagnostic, both};
use crate::geom::Vec2;
use serde_json::{Map, Value as Json, json};

/// The angular velocity of an imported crank (rad/s): the formats have none in a unit.
const OMEGA: f64 = 10.0;
/// Longest name of a point that is taken over.
const LONGEST: usize = 16;

/// The text of a scene made from a linkage.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportedLinkage {
    /// The text.
    pub text: String,
    /// Its first note says what the file did not give.
    pub notes: Vec<Diagnostic>,
}

/// Returns the scene of a linkage: its joints by their places, links numbered in their order, the
/// ground last; asked for are the velocities of its joints and the angular velocities of its links.
pub fn scene(linkage: &Linkage) -> ImportedLinkage {
    let names = names(linkage);
    let number = |body: usize| (body + 1).to_string();
    let ground = number(linkage.bodies.len());
    let list =
        |joints: &[usize]| -> Vec<&str> { joints.iter().map(|j| names[*j].as_str()).collect() };
    let mut links: Map<String, Json> = linkage
        .bodies
        .iter()
        .enumerate()
        .map(|(b, body)| (number(b), json!(list(&body.joints))))
        .collect();
    let fixed: Vec<usize> =
        (0..linkage.joints.len()).filter(|j| linkage.joints[*j].fixed).collect();
    links.insert(ground.clone(), json!(list(&fixed)));
    let points: Map<String, Json> = linkage
        .joints
        .iter()
        .zip(&names)
        .map(|(joint, name)| (name.clone(), json!([joint.at.x, joint.at.y])))
        .collect();
    let guides: Vec<Json> = linkage
        .slides
        .iter()
        .map(|slide| {
            let mut guide = Map::new();
            guide.insert("pin".into(), json!(names[slide.joint]));
            if let Some(block) = slide.block {
                guide.insert("slider".into(), json!(number(block)));
            }
            guide.insert("on".into(), json!(slide.on.map_or(ground.clone(), number)));
            guide.insert("angle".into(), json!(degrees(slide.direction)));
            Json::Object(guide)
        })
        .collect();
    let moving = (0..linkage.joints.len()).filter(|j| !linkage.joints[*j].fixed);
    let turning = (0..linkage.bodies.len()).filter(|b| {
        *b != linkage.crank
            && linkage.bodies[*b].joints.len() > 1
            && linkage.slides.iter().all(|s| s.block != Some(*b))
    });
    let find: Vec<String> = moving
        .map(|j| format!("v_{}", names[j]))
        .chain(turning.map(|b| format!("omega_{}", number(b))))
        .collect();
    let mut all = Map::new();
    if !linkage.title.is_empty() {
        all.insert("title".into(), json!(linkage.title));
    }
    all.insert("units".into(), json!({"length": "mm", "angle": "deg", "omega": "rad/s"}));
    all.insert("links".into(), Json::Object(links));
    all.insert("ground".into(), json!(ground));
    all.insert("points".into(), Json::Object(points));
    if !guides.is_empty() {
        all.insert("guides".into(), json!(guides));
    }
    let omega = OMEGA * linkage.rate.signum();
    all.insert("driver".into(), json!({"link": number(linkage.crank), "omega": omega}));
    all.insert("find".into(), json!(find));
    let message = both!("lengths are read as millimetres, and the crank turns at {omega} rad/s");
    let help = both!("change \"units\" and \"driver\"");
    let notes = vec![Diagnostic::note("imported", message).help(help)];
    ImportedLinkage { text: format!("{:#}\n", Json::Object(all)), notes }
}

fn degrees(direction: Vec2) -> f64 {
    direction.angle().to_degrees() + 0.0
}

/// Names that a scene can have: those of the joints where they are names of points, else letters.
fn names(linkage: &Linkage) -> Vec<String> {
    let mut taken: Vec<String> = Vec::new();
    for joint in &linkage.joints {
        let name = &joint.name;
        let good = name.chars().next().is_some_and(char::is_alphabetic)
            && name.chars().all(|c| c.is_alphanumeric())
            && name.chars().count() <= LONGEST
            && !taken.contains(name);
        let name = if good {
            name.clone()
        } else {
            let used = |name: &String| {
                taken.contains(name) || linkage.joints.iter().any(|j| j.name == *name)
            };
            (1..).map(|k| format!("P{k}")).find(|name| !used(name)).unwrap_or_default()
        };
        taken.push(name);
    }
    taken
}
