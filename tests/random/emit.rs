//! A mechanism as the text of a scene.

use crate::mech::{Drive, Mech, Shape};
use crate::rng::Rng;
use hodograph::geom::{Point, Vec2};
use serde_json::{Map, Value, json};

/// The way in which the pose is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pose {
    /// All points by coordinates.
    Coordinates,
    /// Lengths, driver values and a sketch.
    Lengths,
    /// By lengths, with additional coordinates for some points: consistent, but not always
    /// sufficient.
    Mixed,
}

impl Pose {
    /// Alternates between coordinates and lengths.
    pub fn of(seed: u64) -> Pose {
        if seed.is_multiple_of(2) { Pose::Coordinates } else { Pose::Lengths }
    }
}

/// The questions of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ask {
    Everything,
    Velocities,
    Positions,
}

#[derive(Clone, Debug)]
pub struct Style {
    pub pose: Pose,
    pub ask: Ask,
    /// Small choices of notation.
    pub choices: u64,
    /// Other names, and all keys in another order.
    pub renamed: bool,
}

pub fn point_name(p: usize, renamed: bool) -> String {
    // A letter after the number: no name is the beginning of another followed by a link.
    if renamed { format!("Z{}q", 977 * (p + 1) % 1009) } else { format!("P{p}") }
}

pub fn link_name(l: usize, renamed: bool) -> String {
    if renamed { format!("w{}", 499 * (l + 3) % 1013) } else { format!("k{l}") }
}

fn metres(x: f64) -> String {
    // Debug prints the shortest text that reads back as the same double, at any size.
    format!("{x:?} m")
}

fn radians(x: f64) -> String {
    format!("{x:?} rad")
}

/// For each point, true if coordinates give it.
fn told(m: &Mech, style: &Style, rng: &mut Rng) -> Vec<bool> {
    let mut told: Vec<bool> = (0..m.points.len())
        .map(|_| match style.pose {
            Pose::Coordinates => true,
            Pose::Lengths => false,
            Pose::Mixed => rng.chance(0.3),
        })
        .collect();
    for (l, link) in m.links.iter().enumerate() {
        if l == 0 || link.by_coordinates {
            for &p in &link.points {
                told[p] = true;
            }
        }
    }
    told
}

pub fn scene(m: &Mech, style: &Style) -> String {
    let mut rng = Rng::new(style.choices ^ 0x5555);
    let pn = |p: usize| point_name(p, style.renamed);
    let ln = |l: usize| link_name(l, style.renamed);
    let told = told(m, style, &mut rng);
    let by_lengths = style.pose != Pose::Coordinates;
    let at = |p: usize| m.points[p];
    let xy = |p: Point| json!([metres(p.x), metres(p.y)]);
    let mut carriers = vec![0; m.points.len()];
    for l in m.links.iter().filter(|l| !l.closed || l.points.len() > 1) {
        for &p in &l.points {
            carriers[p] += 1;
        }
    }

    let mut links = Map::new();
    for (l, link) in m.links.iter().enumerate() {
        if link.listed && !(l == 0 && link.points.is_empty()) {
            links.insert(ln(l), json!(link.points.iter().map(|p| pn(*p)).collect::<Vec<_>>()));
        }
    }
    let mut points = Map::new();
    let mut lengths = Map::new();
    let mut sketch = Map::new();
    for (p, &by_coordinates) in told.iter().enumerate() {
        if by_coordinates {
            points.insert(pn(p), xy(at(p)));
        } else {
            sketch.insert(pn(p), xy(at(p)));
        }
    }
    if by_lengths {
        for link in m.links.iter().skip(1) {
            let [a, b, rest @ ..] = &link.points[..] else { continue };
            let mut length = |p: usize, q: usize| {
                if told[p] && told[q] {
                    return; // their distance is given by coordinates, to the last digit only in one of the two
                }
                if !lengths.contains_key(&format!("{},{}", pn(q), pn(p))) {
                    lengths.insert(
                        format!("{},{}", pn(p), pn(q)),
                        json!(metres(at(p).distance(at(q)))),
                    );
                }
            };
            length(*a, *b);
            for &c in rest {
                if told[c] {
                    length(*a, c);
                    length(*b, c);
                    continue;
                }
                let local = (at(c) - at(*a)).divide_by((at(*b) - at(*a)).unit().unwrap());
                match rng.below(3) {
                    0 if carriers[c] == 1 => {
                        points.insert(pn(c), json!({"base": format!("{},{}", pn(*a), pn(*b)), "x": metres(local.x), "y": metres(local.y)}));
                        sketch.remove(&pn(c));
                    }
                    1 if carriers[c] == 1 => {
                        let polar = json!({
                            "base": format!("{},{}", pn(*a), pn(*b)), "length": metres(local.norm()), "angle": radians(local.angle())});
                        points.insert(pn(c), polar);
                        sketch.remove(&pn(c));
                    }
                    _ => {
                        length(*a, c);
                        length(*b, c);
                    }
                }
            }
        }
    }
    let mut guides = Vec::new();
    // For each straight guide the place from which the travel is measured.
    let mut starts: Vec<Point> = Vec::new();
    for g in &m.guides {
        let mut o = Map::new();
        if let Some(p) = g.pin {
            o.insert("pin".into(), json!(pn(p)));
        }
        if let Some(s) = g.slider {
            o.insert("slider".into(), json!(ln(s)));
        }
        if g.on != 0 || rng.chance(0.5) {
            o.insert("on".into(), json!(ln(g.on)));
        }
        let mut start = g.pin.map_or(Point::ORIGIN, at);
        match &g.shape {
            Shape::Own(p) => {
                o.insert("through".into(), json!(pn(*p)));
                start = at(*p);
            }
            Shape::Arc(c) => {
                o.insert("centre".into(), json!(pn(*c)));
                if by_lengths || rng.chance(0.5) {
                    o.insert("radius".into(), json!(metres(at(*c).distance(at(g.pin.unwrap())))));
                }
            }
            Shape::Line(d) => {
                let own = &m.links[g.on].points;
                let mut through = None;
                if own.len() >= 2 && (by_lengths && g.on != 0 || rng.chance(0.4)) {
                    let (a, b) = (own[0], own[1]);
                    o.insert("line".into(), json!(format!("{},{}", pn(a), pn(b))));
                    o.insert("angle".into(), json!(radians(d.divide_by(at(b) - at(a)).angle())));
                    through = Some(a);
                } else {
                    o.insert("angle".into(), json!(radians(d.angle())));
                }
                let in_slot_of_nothing = own.is_empty() && g.on != 0;
                match (g.pin, through) {
                    (None, _) => {}
                    (Some(_), None) if in_slot_of_nothing => {}
                    (Some(pin), through) => {
                        let pose_known = style.pose == Pose::Coordinates;
                        if through.is_none() && pose_known && rng.chance(0.5) {
                            // It passes through the pin.
                        } else if through.is_none() && g.on == 0 {
                            let beside = rng.between(-0.3, 0.3) * at(pin).to_vec2().norm();
                            start = at(pin) + *d * beside;
                            o.insert("through".into(), xy(start));
                        } else {
                            let a = through.unwrap_or_else(|| own[rng.below(own.len())]);
                            if o.get("line").is_none() || rng.chance(0.5) {
                                o.insert("through".into(), json!(pn(a)));
                            }
                            let offset = d.cross(at(pin) - at(a));
                            o.insert("offset".into(), json!(metres(offset)));
                            start = at(a) + d.perp() * offset;
                        }
                    }
                }
            }
        }
        starts.push(start);
        guides.push(Value::Object(o));
    }
    let mut drivers = Vec::new();
    for d in &m.drivers {
        let mut o = Map::new();
        let (rate, acceleration, unit) = match &d.kind {
            Drive::Turn { link, against } => {
                o.insert("link".into(), json!(ln(*link)));
                if *against != 0 || rng.chance(0.3) {
                    o.insert("against".into(), json!(ln(*against)));
                }
                if by_lengths {
                    let line = |l: usize| at(m.links[l].points[1]) - at(m.links[l].points[0]);
                    let base = if *against == 0 { Vec2::new(1.0, 0.0) } else { line(*against) };
                    o.insert("angle".into(), json!(radians(line(*link).divide_by(base).angle())));
                }
                ("omega", "alpha", "rad/s")
            }
            Drive::Slide { guide } => {
                let g = &m.guides[*guide];
                o.insert("slide".into(), json!(g.pin.map_or_else(|| ln(g.slider.unwrap()), pn)));
                // A pin may run in several guides: its slider names the right one.
                let often = m.guides.iter().filter(|h| h.pin == g.pin).count() > 1;
                if let (true, Some(s)) = (often, g.slider) {
                    o.insert("slide".into(), json!(ln(s)));
                }
                if by_lengths && let Some(p) = g.pin {
                    let s = match &g.shape {
                        Shape::Line(d) => d.dot(at(p) - starts[*guide]),
                        Shape::Own(q) => at(p).distance(at(*q)),
                        Shape::Arc(c) => (at(p) - at(*c)).angle() * at(p).distance(at(*c)),
                    };
                    o.insert("position".into(), json!(metres(s)));
                }
                ("velocity", "acceleration", "m/s")
            }
            Drive::Cylinder { a, b, links } => {
                o.insert("cylinder".into(), json!(format!("{},{}", pn(*a), pn(*b))));
                if by_lengths {
                    o.insert("length".into(), json!(metres(at(*a).distance(at(*b)))));
                }
                if !links.is_empty() {
                    o.insert(
                        "links".into(),
                        json!(links.iter().map(|l| ln(*l)).collect::<Vec<_>>()),
                    );
                }
                ("rate", "acceleration", "m/s")
            }
        };
        o.insert(rate.into(), json!(format!("{:?} {unit}", d.rate)));
        if let Some(x) = d.acceleration {
            o.insert(acceleration.into(), json!(format!("{x:?} {unit}^2")));
        }
        drivers.push(Value::Object(o));
    }
    let mut scene = Map::new();
    scene.insert("links".into(), Value::Object(links));
    scene.insert("ground".into(), json!(ln(0)));
    scene.insert("points".into(), Value::Object(points));
    scene.insert("lengths".into(), Value::Object(lengths));
    scene.insert("guides".into(), Value::Array(guides));
    let driver = if drivers.len() == 1 && rng.chance(0.5) {
        drivers.remove(0)
    } else {
        Value::Array(drivers)
    };
    scene.insert("driver".into(), driver);
    scene.insert("sketch".into(), Value::Object(sketch));
    scene.insert("find".into(), json!(questions(m, style)));
    let mut whole = Value::Object(scene);
    if style.renamed {
        reorder(&mut whole, &mut rng);
    }
    serde_json::to_string_pretty(&whole).unwrap()
}

fn reorder(v: &mut Value, rng: &mut Rng) {
    match v {
        Value::Object(o) => {
            let mut entries: Vec<_> = std::mem::take(o).into_iter().collect();
            rng.shuffle(&mut entries);
            for (k, mut v) in entries {
                reorder(&mut v, rng);
                o.insert(k, v);
            }
        }
        Value::Array(a) => {
            for v in a {
                reorder(v, rng);
            }
        }
        _ => {}
    }
}

/// All possible questions: the same list, in the same order, with any names.
fn questions(m: &Mech, style: &Style) -> Vec<String> {
    let pn = |p: usize| point_name(p, style.renamed);
    let ln = |l: usize| link_name(l, style.renamed);
    let placed = |p: usize| {
        m.links.iter().any(|l| l.points.contains(&p)) || m.guides.iter().any(|g| g.pin == Some(p))
    };
    let mut find = Vec::new();
    let accelerations = style.ask == Ask::Everything;
    for p in (0..m.points.len()).filter(|p| placed(*p)) {
        find.push(format!("x_{}", pn(p)));
        find.push(format!("y_{}", pn(p)));
        if style.ask == Ask::Positions {
            continue;
        }
        find.push(format!("v_{}", pn(p)));
        if accelerations {
            find.push(format!("a_{}", pn(p)));
        }
    }
    if style.ask == Ask::Positions {
        return find;
    }
    for l in 1..m.links.len() {
        find.push(format!("omega_{}", ln(l)));
        if l > 1 {
            find.push(format!("omega_{}/{}", ln(l), ln(l - 1)));
        }
        if accelerations {
            find.push(format!("alpha_{}", ln(l)));
        }
    }
    for g in &m.guides {
        let Some(p) = g.pin else { continue };
        find.push(format!("v_{}{}", pn(p), ln(g.on)));
        let pair = format!("{},{}{}", pn(p), pn(p), ln(g.on));
        if g.on != 0 {
            find.push(format!("vr_{pair}"));
            if accelerations {
                find.push(format!("ak_{pair}"));
                find.push(format!("ar_{pair}"));
            }
        }
    }
    for l in m.links.iter().skip(1).filter(|l| l.points.len() > 1) {
        let pair = format!("{},{}", pn(l.points[1]), pn(l.points[0]));
        find.push(format!("v_{pair}"));
        if accelerations {
            find.push(format!("an_{pair}"));
            find.push(format!("at_{pair}"));
        }
    }
    let mut seen = std::collections::HashSet::new();
    find.retain(|f| seen.insert(f.clone()));
    find
}
