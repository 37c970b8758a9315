//! The dimensioned diagram: its printed numbers suffice to draw the mechanism again, and every
//! number is legible.

use hodograph::figure::mechanism::Overlay;
use hodograph::figure::sheet::{SheetOptions, diagram};
use hodograph::geom::Point;
use hodograph::paper::extent::{Rect, turned_corners};
use hodograph::paper::item::{Figure, Shape};
use hodograph::scene::{self, Lang, Scene, templates};
use hodograph::worked::{Scope, Worked, work};

fn dimensioned(scene: &Scene, worked: &Worked, lang: Lang) -> Figure {
    let overlay = Overlay { dimensions: true, ..Overlay::default() };
    diagram(scene, worked, &SheetOptions::of_language(lang), &overlay)
}

/// All printed texts, without the scale.
fn printed(figure: &Figure) -> Vec<String> {
    let text = |s: &Shape| match s {
        Shape::Label { label, .. } | Shape::Turned { label, .. } => Some(label.source().to_owned()),
        _ => None,
    };
    let mut all: Vec<String> = figure
        .items
        .iter()
        .filter_map(|i| text(&i.shape))
        .filter(|t| !t.contains("\\mu"))
        .collect();
    all.sort();
    all
}

/// The file with one of its numbers slightly increased, for each number that is a size or a
/// position.
fn varied(source: &str) -> Vec<(String, String)> {
    let root: serde_json::Value = serde_json::from_str(source).unwrap();
    let mut places = Vec::new();
    for section in
        ["parameters", "points", "lengths", "guides", "driver", "gears", "rolling", "cams"]
    {
        leaves(&root[section], &format!("/{section}"), &mut places);
    }
    let mut out = Vec::new();
    for place in places {
        let mut other = root.clone();
        let leaf = other.pointer_mut(&place).unwrap();
        let larger = match leaf {
            serde_json::Value::Number(n) => {
                n.as_f64().filter(|v| *v != 0.0).map(|v| serde_json::json!(larger(v)))
            }
            serde_json::Value::String(s) => quantity(s).map(|s| serde_json::json!(s)),
            _ => None,
        };
        let Some(larger) = larger else { continue };
        *leaf = larger;
        out.push((place, other.to_string()));
    }
    out
}

fn larger(value: f64) -> f64 {
    if value.fract() == 0.0 && value.abs() < 1e6 {
        value + value.signum()
    } else {
        (value * 1.013 * 1e6).round() / 1e6
    }
}

/// `"100 mm"` → `"101 mm"`; a text that does not begin with a number is not a quantity.
fn quantity(text: &str) -> Option<String> {
    let end =
        text.find(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-')).unwrap_or(text.len());
    let value: f64 = text[..end].parse().ok().filter(|v| *v != 0.0)?;
    Some(format!("{}{}", larger(value), &text[end..]))
}

fn leaves(value: &serde_json::Value, place: &str, out: &mut Vec<String>) {
    match value {
        serde_json::Value::Array(list) => {
            list.iter().enumerate().for_each(|(k, v)| leaves(v, &format!("{place}/{k}"), out))
        }
        serde_json::Value::Object(fields) => {
            fields.iter().for_each(|(k, v)| {
                leaves(v, &format!("{place}/{}", k.replace('~', "~0").replace('/', "~1")), out)
            });
        }
        serde_json::Value::Number(_) | serde_json::Value::String(_) => out.push(place.to_owned()),
        serde_json::Value::Null | serde_json::Value::Bool(_) => {}
    }
}

/// Distance between the points of two poses, relative to the size of the first.
fn apart(a: &Worked, b: &Worked) -> f64 {
    let pairs = a.configuration.points.iter().zip(&b.configuration.points);
    pairs.filter_map(|(p, q)| Some(p.as_ref()?.distance((*q)?))).fold(0.0, f64::max)
        / a.configuration.extent()
}

/// Any number of the file that changes the pose also changes a printed number: the pose therefore
/// follows from the printed numbers.
#[test]
fn the_pose_follows_from_what_is_printed() {
    let (mut silent, mut told) = (Vec::new(), 0);
    for t in templates::list() {
        let source = templates::get(t.name).unwrap();
        let scene = scene::read(source).unwrap().value;
        let worked = work(&scene, Scope::Figure).unwrap().value;
        let here = printed(&dimensioned(&scene, &worked, Lang::En));
        for (place, text) in varied(source) {
            let Ok(other) = scene::read(text.as_bytes().to_vec().as_slice()) else { continue };
            let Ok(moved) = work(&other.value, Scope::Figure) else { continue };
            if apart(&worked, &moved.value) < 1e-6 {
                continue;
            }
            if printed(&dimensioned(&other.value, &moved.value, Lang::En)) == here {
                silent.push(format!(
                    "{} {place}: the pose changes, and nothing that is printed",
                    t.name
                ));
            } else {
                told += 1;
            }
        }
    }
    println!("{told} numbers are told");
    assert!(told > 150, "only {told} numbers move a pose");
    assert!(silent.is_empty(), "{} numbers are not told:\n{}", silent.len(), silent.join("\n"));
}

/// True if two convex areas overlap (separating axes).
fn overlap(a: &[Point], b: &[Point]) -> bool {
    let sides = |p: &[Point]| {
        (0..p.len()).map(|k| (p[(k + 1) % p.len()] - p[k]).perp()).collect::<Vec<_>>()
    };
    let span = |p: &[Point], n: hodograph::geom::Vec2| {
        let all = p.iter().map(|q| q.to_vec2().dot(n));
        (all.clone().fold(f64::INFINITY, f64::min), all.fold(f64::NEG_INFINITY, f64::max))
    };
    sides(a).into_iter().chain(sides(b)).filter_map(|n| n.unit()).all(|n| {
        let ((a0, a1), (b0, b1)) = (span(a, n), span(b, n));
        a0 < b1 - 0.05 && b0 < a1 - 0.05
    })
}

fn corners(r: Rect) -> Vec<Point> {
    vec![r.min, Point::new(r.max.x, r.min.y), r.max, Point::new(r.min.x, r.max.y)]
}

#[test]
fn numbers_of_dimensions_stand_on_nothing() {
    let (mut faults, mut numbers) = (Vec::new(), 0);
    for t in templates::list() {
        let scene = scene::read(templates::get(t.name).unwrap()).unwrap().value;
        let worked = work(&scene, Scope::Figure).unwrap().value;
        for lang in [Lang::En, Lang::Zh] {
            let figure = dimensioned(&scene, &worked, lang);
            let mut boxes: Vec<(String, Vec<Point>, bool)> = Vec::new();
            for item in &figure.items {
                match &item.shape {
                    Shape::Turned { at, angle_rad, label, size_mm, .. } => {
                        numbers += 1;
                        boxes.push((
                            label.source().into(),
                            turned_corners(*at, *angle_rad, label, *size_mm).unwrap().to_vec(),
                            true,
                        ));
                    }
                    Shape::Label { label, .. } => boxes
                        .extend(item.bounds().map(|b| (label.source().into(), corners(b), false))),
                    _ => {}
                }
            }
            for (k, (name, a, _)) in boxes.iter().enumerate().filter(|(_, b)| b.2) {
                for (j, (other, b, turned)) in boxes.iter().enumerate() {
                    if j != k && (!*turned || j > k) && overlap(a, b) {
                        faults.push(format!("{} {lang:?}: `{name}` on `{other}`", t.name));
                    }
                }
                for item in &figure.items {
                    let body = match &item.shape {
                        // Inside a cam there is space for the numbers of its centre.
                        Shape::Polyline { points, fill: Some(_), .. }
                            if !item.class.ends_with("cam") =>
                        {
                            points.clone()
                        }
                        Shape::Line { from, to, stroke } if stroke.width_mm > 0.3 => {
                            let side =
                                (*to - *from).unit().unwrap().perp() * (stroke.width_mm / 2.0);
                            vec![*from - side, *to - side, *to + side, *from + side]
                        }
                        _ => continue,
                    };
                    if body.len() >= 3 && overlap(a, &body) {
                        faults.push(format!("{} {lang:?}: `{name}` on {}", t.name, item.id));
                    }
                }
            }
        }
    }
    assert!(numbers > 200, "only {numbers} numbers");
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}
