//! The arrows of drivers in the written SVG: one for each velocity and one for each acceleration
//! that is not zero, each in its own sense and with its own name only.

use hodograph::figure::sheet::{SheetOptions, drawing};
use hodograph::render::svg;
use hodograph::scene::{self, DiagramKind, Driver, DriverKind, Lang, Scene, templates};
use hodograph::worked::{Scope, Worked, work};

type P = [f64; 2];

/// All pairs of numbers of an outline; arcs give their ends only.
fn places(d: &str) -> Vec<P> {
    let mut out = Vec::new();
    let mut here = [0.0; 2];
    let spaced: String = d
        .chars()
        .map(|c| if c.is_ascii_alphabetic() { format!(" {c} ") } else { c.to_string() })
        .collect();
    let mut words = spaced.split([' ', ',']).filter(|w| !w.is_empty()).peekable();
    let mut command = 'M';
    while let Some(word) = words.peek() {
        if let Some(c) = word.chars().next().filter(char::is_ascii_alphabetic) {
            command = c;
            words.next();
            continue;
        }
        let mut number = || words.next().unwrap().parse::<f64>().unwrap();
        let step: P = match command {
            'M' | 'L' => [number(), number()],
            'A' => {
                for _ in 0..5 {
                    number();
                }
                [number(), number()]
            }
            'm' | 'l' => [here[0] + number(), here[1] + number()],
            'H' => [number(), here[1]],
            'V' => [here[0], number()],
            'h' => [here[0] + number(), here[1]],
            'v' => [here[0], here[1] + number()],
            'a' => {
                for _ in 0..5 {
                    number();
                }
                [here[0] + number(), here[1] + number()]
            }
            c => panic!("the test does not read `{c}` of {d}"),
        };
        here = step;
        out.push(here);
    }
    out
}

/// Tail and tip of an arrow, y up: the tail begins its shaft, the tip is the corner of the head
/// farthest from there.
fn arrow(document: &roxmltree::Document, id: &str) -> Option<(P, P)> {
    let node = document.descendants().find(|n| n.attribute("id") == Some(id))?;
    let line = |n: roxmltree::Node| {
        let end = |[x, y]: [&str; 2]| {
            Some([n.attribute(x)?.parse().ok()?, n.attribute(y)?.parse().ok()?])
        };
        Some(vec![end(["x1", "y1"])?, end(["x2", "y2"])?])
    };
    let outlines: Vec<Vec<P>> = node
        .descendants()
        .filter_map(|n| n.attribute("d").map(places).or_else(|| line(n)))
        .collect();
    let (shaft, head) = (outlines.first()?, outlines.last()?);
    let tail = shaft[0];
    let apart = |p: &P| (p[0] - tail[0]).hypot(p[1] - tail[1]);
    let tip = head.iter().max_by(|a, b| apart(a).total_cmp(&apart(b)))?;
    Some(([tail[0], -tail[1]], [tip[0], -tip[1]]))
}

/// The given values of a driver, each with the name of its arrow.
fn given(scene: &Scene, driver: &Driver) -> Vec<(f64, String)> {
    let second = driver.acceleration.as_ref().map_or(0.0, |a| a.value);
    let names: [String; 2] = match driver.kind {
        DriverKind::Turn { link, against, .. } => {
            let who = scene.link_name(link);
            let index = if against == scene.ground {
                who.to_owned()
            } else {
                format!("{who}-{}", scene.link_name(against))
            };
            ["rotation", "angular-acceleration"].map(|k| format!("mechanism-{k}-{index}"))
        }
        DriverKind::Slide { guide, .. } => {
            let g = &scene.guides[guide.0];
            let who =
                g.pin.map_or_else(|| scene.link_name(g.slider.unwrap()), |p| scene.point_name(p));
            ["vel", "acc"].map(|k| format!("mechanism-driver-{k}-{who}"))
        }
        DriverKind::Cylinder { a, b, .. } => {
            let who = format!("{}-{}", scene.point_name(b), scene.point_name(a));
            ["vel", "acc"].map(|k| format!("mechanism-driver-{k}-{who}"))
        }
    };
    [driver.rate.value, second].into_iter().zip(names).collect()
}

/// The sense of an arrow as a signed number.
fn sense(
    scene: &Scene,
    worked: &Worked,
    driver: &Driver,
    (tail, tip): (P, P),
    centre: Option<P>,
) -> f64 {
    let place = |p: scene::PointId| worked.configuration.points[p.0].map(|p| [p.x, p.y]);
    let along = match driver.kind {
        DriverKind::Turn { .. } => {
            let c = centre.expect("the mark of a turning driver's pivot");
            let (a, b) = ([tail[0] - c[0], tail[1] - c[1]], [tip[0] - c[0], tip[1] - c[1]]);
            return a[0] * b[1] - a[1] * b[0];
        }
        DriverKind::Slide { guide, .. } => {
            let path = worked.configuration.guides[guide.0].unwrap();
            let at = scene.guides[guide.0]
                .pin
                .and_then(|p| worked.configuration.points[p.0])
                .unwrap_or_default();
            let t = path.tangent_at(at);
            [t.x, t.y]
        }
        DriverKind::Cylinder { a, b, .. } => {
            let (a, b) = (place(a).unwrap(), place(b).unwrap());
            [b[0] - a[0], b[1] - a[1]]
        }
    };
    (tip[0] - tail[0]) * along[0] + (tip[1] - tail[1]) * along[1]
}

/// Checks every arrow of a scene's drivers, by name; faults are collected.
fn check(name: &str, scene: &Scene, faults: &mut Vec<String>) -> usize {
    let worked = work(scene, Scope::Figure).unwrap_or_else(|f| panic!("{name}: {f}")).value;
    let options = SheetOptions::of_language(Lang::En);
    let written =
        svg::write(&drawing(scene, &worked, &options, DiagramKind::Plane).unwrap()).unwrap().value;
    let document = roxmltree::Document::parse(&written).unwrap();
    let mut seen = 0;
    for (k, driver) in scene.drivers.iter().enumerate() {
        let centre = pivot(&document, scene, driver);
        for (value, id) in given(scene, driver) {
            let found = arrow(&document, &id);
            if value == 0.0 || scene.is_led(k) {
                if found.is_some() {
                    faults.push(format!("{name}: {id} is drawn for nothing that is given"));
                }
                continue;
            }
            let Some(ends) = found else {
                faults.push(format!("{name}: {id} has no arrow"));
                continue;
            };
            seen += 1;
            if sense(scene, &worked, driver, ends, centre) * value <= 0.0 {
                faults.push(format!("{name}: {id} stands for {value} and points the other way"));
            }
        }
    }
    // An arrow has one name: a comma would separate two.
    let drivers = document
        .descendants()
        .filter(|n| n.attribute("class").is_some_and(|c| c.contains("driver")));
    faults.extend(
        drivers
            .filter_map(|n| n.attribute("data-text"))
            .filter(|t| t.contains(','))
            .map(|t| format!("{name}: one label `{t}`")),
    );
    seen
}

/// The place at which the joint of a turning driver is drawn, y up.
fn pivot(document: &roxmltree::Document, scene: &Scene, driver: &Driver) -> Option<P> {
    let DriverKind::Turn { link, against, .. } = driver.kind else { return None };
    let shared =
        scene.links[link.0].points.iter().find(|p| scene.links[against.0].points.contains(p))?;
    let name = scene.point_name(*shared);
    let ids = [
        format!("mechanism-pivot-{name}"),
        format!("mechanism-pin-{name}"),
        format!("mechanism-pivot-{name}-2"),
    ];
    let circle = document.descendants().filter(|n| n.tag_name().name() == "circle").find(|n| {
        n.ancestors().any(|a| {
            a.attribute("id").is_some_and(|i| ids.iter().any(|w| i.starts_with(w.as_str())))
        })
    })?;
    let of = |a: &str| circle.attribute(a).unwrap().parse::<f64>().unwrap();
    Some([of("cx"), -of("cy")])
}

#[test]
fn arrows_of_drivers_point_as_they_are_given() {
    let (mut faults, mut seen) = (Vec::new(), 0);
    for t in templates::list() {
        let scene = scene::read(templates::get(t.name).unwrap()).unwrap().value;
        seen += check(t.name, &scene, &mut faults);
        // Every combination of signs of velocity and acceleration.
        for (rate, second) in [(-1.0, 1.0), (1.0, -1.0), (1.0, 1.0), (0.0, -1.0)] {
            let mut other = scene.clone();
            for d in &mut other.drivers {
                let size = d.rate.value.abs();
                d.rate.value = rate * size;
                d.acceleration =
                    Some(scene::GivenQuantity { value: second * (size + 1.0), ..d.rate.clone() });
            }
            if work(&other, Scope::Figure).is_ok() {
                seen += check(
                    &format!("{} with rate {rate}, acceleration {second}", t.name),
                    &other,
                    &mut faults,
                );
            }
        }
    }
    assert!(seen > 300, "only {seen} arrows were found");
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}
