//! Readings agree with the drawing: every reading is the distance of two points, every name denotes
//! one vector, and three methods without a common definition of a part (edges, rows of the loop
//! equations, formulas of relative motion) agree on it.

use crate::emit;
use crate::properties::{mechanism, seeds, style};
use crate::wide::every;
use hodograph::answer::{AnswerValue, evaluate};
use hodograph::construct::{PolygonMark, ShownAs};
use hodograph::figure::results::named;
use hodograph::figure::sheet::{SheetOptions, sheet};
use hodograph::geom::Vec2;
use hodograph::mechanism::joined;
use hodograph::notation::Notation;
use hodograph::plan::text::PlanWriter;
use hodograph::plan::{VertexId, VertexPlace};
use hodograph::render::svg;
use hodograph::report::construction::mark;
use hodograph::scene::quantity::{
    Meaning, Of, Rate, Relative, RelativeComponent, Sliding, Turning, relative, sliding,
};
use hodograph::scene::{
    self, Asked, DiagramKind, DriverKind, Find, Lang, LinkId, OnLink, Scene, templates,
};
use hodograph::worked::{Scope, Worked, work};
use std::collections::BTreeMap;

/// All possible relative questions: on each link, at each guide in both senses, along each
/// cylinder, across links.
fn relative_questions(scene: &Scene) -> Vec<Asked> {
    let pin = |point| OnLink { point, link: None };
    let moving = |p: &OnLink| !scene.links[scene.ground.0].points.contains(&p.point);
    let mut all: Vec<Asked> = Vec::new();
    let parts =
        |of, to| relative::RelativePart::ALL.map(|part| Asked::from(Relative { part, of, to }));
    let slidings =
        |of, to| sliding::SlidingTerm::ALL.map(|part| Asked::from(Sliding { part, of, to }));
    for (l, link) in scene.links.iter().enumerate().filter(|(l, _)| *l != scene.ground.0) {
        for (i, p) in link.points.iter().enumerate().take(3) {
            for q in &link.points[i + 1..] {
                let (a, b) = if (l + i) % 2 == 0 { (*p, *q) } else { (*q, *p) };
                all.extend(parts(pin(a), pin(b)));
            }
        }
    }
    for driver in &scene.drivers {
        if let DriverKind::Cylinder { a, b, .. } = driver.kind {
            all.extend(parts(pin(a), pin(b)));
            all.extend(slidings(pin(b), pin(a)));
        }
    }
    for guide in &scene.guides {
        let runner = match (guide.pin, guide.slider) {
            (Some(p), _) => Some(pin(p)),
            (None, Some(s)) => {
                scene.links[s.0].points.first().map(|p| OnLink { point: *p, link: Some(s) })
            }
            (None, None) => None,
        };
        let Some(a) = runner else { continue };
        let b = OnLink { point: a.point, link: Some(guide.on) };
        for (a, b) in [(a, b), (b, a)] {
            all.extend(slidings(a, b));
            all.extend(&parts(a, b)[..2]);
        }
    }
    // A place of contact is a point of both links, and of neither alone.
    let by_itself = |p: &OnLink| scene.rolling.iter().all(|pair| !pair.at.contains(&p.point));
    let points = (0..scene.points.len()).map(|p| pin(hodograph::scene::PointId(p)));
    let movers: Vec<OnLink> = points.filter(moving).filter(by_itself).collect();
    if let [first, .., last] = movers[..] {
        all.extend([parts(first, last)[0], parts(last, first)[1]]);
    }
    for (l, _) in scene
        .links
        .iter()
        .enumerate()
        .filter(|(l, link)| *l != scene.ground.0 && link.points.len() > 1)
    {
        all.extend(
            Rate::ALL.map(|rate| Asked::from(Turning { rate, of: LinkId(l), against: None })),
        );
    }
    all.retain(|what| match what.meaning(scene) {
        Some(Meaning::Relative(RelativeComponent::Along | RelativeComponent::Across, a, b)) => {
            a.point != b.point && joined(scene, &a, &b).is_some()
        }
        Some(Meaning::Relative(RelativeComponent::Sliding | RelativeComponent::Coriolis, a, b)) => {
            joined(scene, &a, &b).is_some()
        }
        _ => true,
    });
    all
}

/// The text of a question.
fn text(scene: &Scene, what: &Asked) -> String {
    let name = |p: &OnLink| {
        format!("{}{}", scene.point_name(p.point), p.link.map_or("", |l| scene.link_name(l)))
    };
    let symbol = what.entry().symbol;
    match what.of() {
        Of::Points(a, b) => format!("{symbol}_{}{}", name(&a), name(&b)),
        Of::Link(l) => format!("{symbol}_{}", scene.link_name(l)),
        other => panic!("{other:?} is not asked here"),
    }
}

/// The scene with all relative questions in addition.
fn asking_all(mut scene: Scene) -> Scene {
    for what in relative_questions(&scene) {
        let text = text(&scene, &what);
        if !scene.find.iter().any(|f| f.text == text) {
            scene.find.push(Find { what, text, span: Default::default() });
        }
    }
    scene
}

fn scale(worked: &Worked, on: DiagramKind) -> f64 {
    let largest = |on| worked.construction.polygon(on).map_or(0.0, |p| p.largest());
    let v = largest(DiagramKind::Velocity);
    match on {
        DiagramKind::Acceleration => {
            largest(on).max(v * v / worked.configuration.extent().max(1e-300))
        }
        _ => v,
    }
}

/// Edges, rows and formulas agree; every length is the distance of two existing points.
fn check_readings(name: &str, scene: &Scene, worked: &Worked) -> usize {
    let mut read = 0;
    for r in &worked.results {
        let find = &scene.find[r.find];
        let (on, what) = (find.what.diagram(), format!("{name}: {}", find.text));
        // Forces are read off polygons of their own: tests/forces.rs.
        let (Some(drawn), true) = (&r.drawn, on > DiagramKind::Plane && on != DiagramKind::Force)
        else {
            continue;
        };
        let size =
            if matches!(drawn.value, AnswerValue::Scalar(_)) { r.scale } else { scale(worked, on) };
        let off = |a: AnswerValue, b: AnswerValue| match (a, b) {
            (AnswerValue::Vector(a), AnswerValue::Vector(b)) => (a - b).norm(),
            (AnswerValue::Scalar(a), AnswerValue::Scalar(b)) => (a - b).abs(),
            _ => f64::INFINITY,
        };
        let worst = worked.construction.magnified(on);
        let near = 1e-12 * worst.max(1e3) * size;
        assert!(
            off(drawn.value, r.computed) <= near,
            "{what}: edge {:?}, rows {:?}, size {size}",
            drawn.value,
            r.computed
        );
        let formula = evaluate(scene, &worked.configuration, &worked.solution, &find.what)
            .expect("the analysis reaches what is drawn");
        assert!(
            off(r.computed, formula) <= near,
            "{what}: rows {:?}, formula {formula:?}, size {size}",
            r.computed
        );
        let Some(m) = &drawn.measured else {
            assert!(
                matches!(drawn.value, AnswerValue::Scalar(_)) || drawn.value.magnitude() <= near,
                "{what}: no edge shows {:?}",
                drawn.value
            );
            continue;
        };
        read += 1;
        let polygon = worked.construction.polygon(on).expect("what is measured is drawn");
        let [from, to] = m.marks;
        let distance = (to.1 - from.1).norm();
        assert!(
            (distance - m.length_mm).abs() <= near / polygon.mu,
            "{what}: {} mm between marks {distance} mm apart",
            m.length_mm
        );
        for (mark, at) in m.marks {
            let there = match mark {
                PolygonMark::Pole => at.to_vec2().norm() == 0.0,
                PolygonMark::Image(v) => polygon.images[v.0] == Some(at),
                PolygonMark::Part(_) | PolygonMark::Again(_) => {
                    polygon.edges.iter().any(|e| e.to == (mark, at))
                }
            };
            assert!(there, "{what}: {mark:?} is not at {at:?}");
        }
        if let AnswerValue::Vector(v) = drawn.value {
            assert!(
                ((to.1 - from.1) * polygon.mu - v).norm() <= near,
                "{what}: the marks do not show {v:?}"
            );
        }
    }
    read
}

/// No two vectors have one name, and an answer has the name that the drawing gives it.
fn check_names(name: &str, scene: &Scene, worked: &Worked) {
    for lang in [Lang::En, Lang::Zh] {
        let notation = Notation::of_language(lang);
        let w = PlanWriter { scene, plan: &worked.plan, notation: &notation, lang };
        for on in DiagramKind::POLYGONS {
            let Some(p) = worked.construction.polygon(on) else { continue };
            let size = p.largest() / p.mu;
            let mut called: BTreeMap<String, Vec2> = BTreeMap::new();
            let mut call = |symbol: String, v: Vec2| {
                let before = *called.entry(symbol.clone()).or_insert(v);
                assert!(
                    (before - v).norm() <= 1e-6 * size,
                    "{name}: {symbol} is {before:?} and {v:?} mm"
                );
            };
            for e in &p.edges {
                if let [t] = e.terms[..] {
                    call(w.symbol(on, &t), e.to.1 - e.from.1);
                }
            }
            for (v, at) in p.images.iter().enumerate() {
                let (v, vertex) = (VertexId(v), worked.plan.vertex(VertexId(v)));
                if let (Some(at), false, VertexPlace::Point(_)) = (at, vertex.fixed, vertex.spot) {
                    call(w.vector(on, v), at.to_vec2());
                }
            }
            for r in worked.results.iter().filter(|r| scene.find[r.find].what.diagram() == on) {
                let Some(m) = r.drawn.as_ref().and_then(|d| d.measured.as_ref()) else { continue };
                let Some(shown) = &m.shown else { continue };
                let drawn = match &shown.vector {
                    ShownAs::Image(v) => w.vector(on, *v),
                    ShownAs::Edges(terms) => {
                        terms.iter().map(|t| w.symbol(on, t)).collect::<Vec<_>>().join(" + ")
                    }
                };
                let told = named(&w, &scene.find[r.find], r);
                assert!(
                    told.ends_with(&drawn) || told.ends_with(&format!("({drawn})")),
                    "{name}: {told} is drawn as {drawn}"
                );
                for symbol in
                    told.split(" = ").filter(|s| !s.starts_with('−') && !s.contains(" + "))
                {
                    call(symbol.to_string(), m.marks[1].1 - m.marks[0].1);
                }
            }
            // Points have distinct names, too.
            let mut letters: BTreeMap<String, PolygonMark> = BTreeMap::new();
            for (m, _) in p.edges.iter().flat_map(|e| [e.from, e.to]) {
                let letter = mark(&w, on, &m);
                let before = *letters.entry(letter.clone()).or_insert(m);
                assert_eq!(before, m, "{name}: two marks {letter}");
            }
        }
    }
}

fn with_angle(name: &str, degrees: Option<f64>) -> Option<Scene> {
    let text = match degrees {
        None => templates::get(name).unwrap().to_string(),
        Some(d) => templates::instantiate(name, &[("phi_1", &format!("{d} deg"))]).ok()?,
    };
    Some(scene::read(&text).ok()?.value)
}

#[test]
fn readings_of_all_templates_are_edges() {
    let mut read = 0;
    for name in templates::list().iter().map(|t| t.name) {
        for degrees in [None, Some(37.0), Some(118.0), Some(251.0)] {
            let Some(scene) = with_angle(name, degrees).map(asking_all) else { continue };
            let Ok(worked) = work(&scene, Scope::Questions) else { continue };
            let what = format!("{name} {degrees:?}");
            read += check_readings(&what, &scene, &worked.value);
            check_names(&what, &scene, &worked.value);
        }
    }
    assert!(read > 2000 / every(8), "only {read} readings were checked");
}

#[test]
fn readings_of_random_mechanisms_are_edges() {
    let mut read = 0;
    for seed in seeds(150) {
        let Some(m) = mechanism(seed) else { continue };
        let pose = if m.coordinates_only { emit::Pose::Coordinates } else { emit::Pose::of(seed) };
        let text = emit::scene(&m, &style(pose, emit::Ask::Velocities, seed));
        let scene = asking_all(scene::read(&text).unwrap().value);
        let Ok(worked) = work(&scene, Scope::Questions) else { continue };
        read += check_readings(&format!("seed {seed}\n{text}"), &scene, &worked.value);
        check_names(&format!("seed {seed}"), &scene, &worked.value);
    }
    assert!(read > 3000 / every(8), "only {read} readings were checked");
}

/// Every length that a sheet prints is the distance of two points in its SVG, found there by their
/// names.
#[test]
fn printed_lengths_are_distances_in_the_svg() {
    let mut found = 0;
    for name in templates::list().iter().step_by(every(8)).map(|t| t.name) {
        let scene = asking_all(with_angle(name, None).unwrap());
        let worked = work(&scene, Scope::Figure).unwrap_or_else(|f| panic!("{name}: {f}")).value;
        for lang in [Lang::En, Lang::Zh] {
            let options = SheetOptions::of_language(lang);
            let figure = sheet(&scene, &worked, &options).unwrap();
            let drawn = svg::write_editable(&figure).unwrap().value;
            let document = roxmltree::Document::parse(&drawn).unwrap();
            let by_id = |id: &str| document.descendants().find(|n| n.attribute("id") == Some(id));
            let w =
                PlanWriter { scene: &scene, plan: &worked.plan, notation: &options.notation, lang };
            for r in &worked.results {
                let find = &scene.find[r.find];
                let Some(m) = r.drawn.as_ref().and_then(|d| d.measured.as_ref()) else { continue };
                if worked.construction.is_empty(find.what.diagram()) {
                    continue;
                }
                let on = find.what.diagram();
                let place = |k: usize| {
                    let id = hodograph::figure::polygon::mark_id(&w, on, &m.marks[k].0);
                    let node = by_id(&id)
                        .unwrap_or_else(|| panic!("{name}: no mark {id} for {}", find.text));
                    assert!(node.attribute("class").unwrap().split(' ').any(|c| c == "mark"));
                    let number = |key: &str| node.attribute(key).unwrap().parse::<f64>().unwrap();
                    Vec2::new(number("cx"), number("cy"))
                };
                let distance = (place(1) - place(0)).norm();
                let cell = by_id(&format!(
                    "result-{}-measured",
                    hodograph::paper::shown::question_id(&find.text)
                ))
                .unwrap_or_else(|| panic!("{name}: {} is not printed", find.text));
                let printed: String =
                    cell.descendants().filter(|n| n.is_text()).filter_map(|n| n.text()).collect();
                let printed = printed
                    .split("mm")
                    .next()
                    .unwrap()
                    .trim()
                    .replace('−', "-")
                    .replace(['\u{a0}', '\u{2009}', ' '], "");
                let printed: f64 = printed
                    .parse()
                    .unwrap_or_else(|_| panic!("{name}: {} prints {printed}", find.text));
                // Places are written to 0.001 mm, lengths to four digits.
                assert!(
                    (printed - distance).abs() <= 2e-3 + 5.1e-4 * distance,
                    "{name}: {} prints {printed} mm between marks {distance} mm apart",
                    find.text
                );
                found += 1;
            }
        }
    }
    assert!(found > 1000 / every(8), "only {found} lengths were found");
}

/// The parts of the motion of a cylinder's ends can be asked for in a scene, and are read off
/// edges.
#[test]
fn parts_of_a_cylinder_can_be_asked() {
    let text = templates::get("excavator").unwrap();
    let scene =
        scene::read_asking(text, "vr_CB, vr_BC, an_CB, at_CB, ak_CB, v_CB, a_FE").unwrap().value;
    let worked = work(&scene, Scope::Questions).unwrap().value;
    assert_eq!(check_readings("excavator", &scene, &worked), 7);
    check_names("excavator", &scene, &worked);
    let faults = scene::read_asking(text, "vr_CD").unwrap_err().to_string();
    assert!(faults.contains("sliding is between two links at one place"), "{faults}");
}
