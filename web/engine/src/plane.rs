//! The mechanism in its plane, for a page on which it is built with the mouse: places of points,
//! the paper of the figure, and the values of quantities.

use hodograph::paper::item::{Figure, Shape};
use hodograph::position::{Configuration, Path};
use hodograph::problem::Solved;
use hodograph::scene::{self, LinkId, PointId, Scene, eval, expr};
use serde_json::{Value as Json, json};
use std::collections::BTreeMap;

/// Returns the names of a scene: points, links and parameters.
pub fn names(scene: &Scene) -> Json {
    json!({
        "points": scene.points.iter().map(|p| &p.name).collect::<Vec<_>>(),
        "links": (0..scene.links.len()).map(|l| scene.link_name(LinkId(l))).collect::<Vec<_>>(),
        "parameters": scene.parameters.iter().map(|(name, _)| name).collect::<Vec<_>>(),
    })
}

/// Returns the names of a file that cannot be solved; null if even its links cannot be read.
pub fn names_of(text: &str) -> Json {
    scene::read_topology(text).map_or(Json::Null, |read| names(&read.value))
}

/// Returns the places (m) of all points.
pub fn places(at: &Configuration) -> Json {
    at.points.iter().map(|p| p.map_or(Json::Null, |p| json!([p.x, p.y]))).collect()
}

/// Returns the mechanism of a solution in its plane: points with their places (m) and links, links
/// with their points, guides with a place and a direction; null without a mechanism.
pub fn plane(solved: &Solved) -> Json {
    let Some((scene, worked)) = solved.mechanism() else { return Json::Null };
    let at = &worked.configuration;
    let carriers = |p: PointId| {
        let on = |l: &LinkId| scene.links[l.0].points.contains(&p);
        (0..scene.links.len()).map(LinkId).filter(on).map(|l| scene.link_name(l)).collect()
    };
    let point = |(p, one): (usize, &scene::NamedPoint)| {
        let links: Vec<&str> = carriers(PointId(p));
        json!({"name": one.name, "at": at.points[p].map(|p| [p.x, p.y]), "links": links})
    };
    let link = |one: &scene::Link| {
        let points: Vec<&str> = one.points.iter().map(|p| scene.point_name(*p)).collect();
        json!({"name": one.name, "points": points})
    };
    let guide = |(g, one): (usize, &scene::Guide)| {
        let [place, direction] = match at.guides.get(g).copied().flatten()? {
            Path::Line { through, direction } => {
                let pin = one.pin.and_then(|p| at.points[p.0]).unwrap_or(through);
                [[pin.x, pin.y], [direction.x, direction.y]]
            }
            Path::Arc { centre, .. } => [[centre.x, centre.y], [0.0, 0.0]],
        };
        let slider = one.slider.map(|l| scene.link_name(l));
        let pin = one.pin.map(|p| scene.point_name(p));
        let on = scene.link_name(one.on);
        Some(json!({"pin": pin, "slider": slider, "on": on, "at": place, "direction": direction}))
    };
    json!({
        "ground": scene.link_name(scene.ground),
        "points": scene.points.iter().enumerate().map(point).collect::<Vec<_>>(),
        "links": scene.links.iter().map(link).collect::<Vec<_>>(),
        "guides": scene.guides.iter().enumerate().filter_map(guide).collect::<Vec<_>>(),
    })
}

/// Returns the paper of the mechanism's figure: millimetres of paper for a metre, and the place
/// (mm, y down) of the origin of the plane; null if the figure shows no joint.
pub fn paper(solved: &Solved, figure: &Figure) -> Json {
    let Some((scene, worked)) = solved.mechanism() else { return Json::Null };
    let per_metre = 1.0 / worked.construction.diagram.mu;
    let marks = |name: &str| {
        let is = |id: &str| {
            ["pin", "pivot", "point"].iter().any(|kind| {
                let rest = id.strip_prefix(&format!("mechanism-{kind}-{name}"));
                rest.is_some_and(|r| r.is_empty() || r.starts_with('-'))
            })
        };
        figure.items.iter().find_map(|item| match item.shape {
            Shape::Circle { centre, .. } if is(&item.id) => Some(centre),
            _ => None,
        })
    };
    let origin = scene.points.iter().zip(&worked.configuration.points).find_map(|(point, at)| {
        let (mark, at) = (marks(&point.name)?, (*at)?);
        let height = figure.height_mm - mark.y;
        Some([mark.x - at.x * per_metre, height + at.y * per_metre])
    });
    origin.map_or(Json::Null, |origin| json!({"scale": per_metre, "origin": origin}))
}

/// Returns the SI values of quantities, with the parameters of a text; null for what has none.
pub fn values(text: &str, wanted: &[Json]) -> Json {
    let text: Json = serde_json::from_str(text).unwrap_or_default();
    let mut left: BTreeMap<String, String> = BTreeMap::new();
    for (name, value) in text["parameters"].as_object().into_iter().flatten() {
        left.insert(name.clone(), written(value));
    }
    let names: Vec<String> = left.keys().cloned().collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let mut known: BTreeMap<String, eval::DimensionedValue> = BTreeMap::new();
    let value = |text: &str, known: &BTreeMap<String, eval::DimensionedValue>| {
        let parsed = expr::parse(text, &names).ok()?;
        eval::evaluate(&parsed, &|name: &str| known.get(name).copied()).ok()
    };
    // In any order, but not in a circle: each round evaluates what rests on known ones.
    loop {
        let found: Vec<_> = left
            .iter()
            .filter_map(|(name, text)| Some((name.clone(), value(text, &known)?)))
            .collect();
        if found.is_empty() {
            break;
        }
        for (name, value) in found {
            left.remove(&name);
            known.insert(name, value);
        }
    }
    wanted
        .iter()
        .map(|w| json!(value(&written(w), &known).map(eval::DimensionedValue::si)))
        .collect()
}

/// A quantity as an expression: a number of the text as it is written.
fn written(value: &Json) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}
