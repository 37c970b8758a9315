//! Data attributes of vectors and points agree with the drawing and with the answers.

use hodograph::answer::AnswerValue;
use hodograph::figure::sheet::{SheetOptions, sheet};
use hodograph::render::svg;
use hodograph::scene::{self, DiagramKind, Lang, templates};
use hodograph::worked::{Scope, work};

use crate::wide::every;

/// Places in the file are rounded to 0.001 mm.
const ROUNDED_MM: f64 = 1.5e-3;

#[test]
fn lengths_are_distances_on_paper_and_values_are_lengths_times_the_scale() {
    let (mut vectors, mut asked) = (0, 0);
    for t in templates::list().iter().step_by(every(5)) {
        let scene = scene::read(templates::get(t.name).unwrap()).unwrap().value;
        let worked = work(&scene, Scope::Figure).unwrap().value;
        let figure = sheet(&scene, &worked, &SheetOptions::of_language(Lang::En)).unwrap();
        let text = svg::write(&figure).unwrap().value;
        let document = roxmltree::Document::parse(&text).unwrap();
        assert_eq!(document.root_element().attribute("data-hodograph"), Some(svg::CONTRACT));
        for node in document.descendants().filter(|n| n.attribute("data-mm").is_some()) {
            let number = |key: &str| node.attribute(key).unwrap().parse::<f64>().unwrap();
            let (id, name) = (node.attribute("id").unwrap(), node.attribute("data-name").unwrap());
            assert!(!node.attribute("data-si").unwrap().contains(['e', 'E', '−']), "{id}");
            let polygon = |on| worked.construction.polygon(on).unwrap().mu;
            let mu = match name.chars().next() {
                Some('v') => polygon(DiagramKind::Velocity),
                Some('a') => polygon(DiagramKind::Acceleration),
                _ => worked.equilibrium.as_ref().unwrap().mu(),
            };
            let inset = node.attribute("class").unwrap().contains("inset");
            if !inset {
                let wanted = number("data-mm") * mu;
                assert!(
                    (number("data-si") - wanted).abs() <= ROUNDED_MM * mu + 1e-5 * wanted.abs(),
                    "{}: {id} is {wanted}",
                    t.name
                );
            }
            // The tip is the corner of the head that is farthest from the tail.
            let line = node.children().find(|n| n.has_tag_name("line")).unwrap();
            let tail = ["x1", "y1"].map(|k| line.attribute(k).unwrap().parse::<f64>().unwrap());
            let head =
                node.children().find(|n| n.has_tag_name("path")).unwrap().attribute("d").unwrap();
            let numbers: Vec<f64> =
                head.split(['M', 'L', 'Z', ' ']).filter_map(|n| n.parse().ok()).collect();
            let far = numbers
                .chunks(2)
                .map(|p| (p[0] - tail[0]).hypot(p[1] - tail[1]))
                .fold(0.0, f64::max);
            assert!(
                (far - number("data-mm")).abs() < 2.0 * ROUNDED_MM,
                "{}: {id} tells {} and is {far} mm",
                t.name,
                number("data-mm")
            );
            vectors += 1;
        }
        for r in &worked.results {
            let (find, AnswerValue::Vector(v)) = (&scene.find[r.find], r.computed) else {
                continue;
            };
            let Some(drawn) = figure.vector(&find.text) else { continue };
            let value = v.norm();
            assert!(
                (drawn.si - value).abs() <= 1e-6 * value.max(drawn.mm * 1e-3),
                "{}: {} is {} and {value}",
                t.name,
                find.text,
                drawn.si
            );
            assert!((drawn.from.distance(drawn.to) - drawn.mm).abs() < 1e-9);
            asked += 1;
        }
    }
    assert!(
        vectors > 100 / every(5) && asked > 20 / every(5),
        "{vectors} vectors, {asked} answers"
    );
}

#[test]
fn a_vector_and_its_mark_are_found_by_name() {
    let scene = scene::read(templates::get("shaper").unwrap()).unwrap().value;
    let worked = work(&scene, Scope::Figure).unwrap().value;
    let figure = sheet(&scene, &worked, &SheetOptions::of_language(Lang::Zh)).unwrap();
    let id = |name: &str| figure.vector(name).map(|v| v.id);
    assert_eq!(id("ak_A3A2"), Some("acc-coriolis-A3-A2"));
    assert_eq!(id("vr_A3A2"), Some("vel-sliding-A3-A2"));
    assert_eq!(id("an_CB"), Some("acc-normal-C-B"));
    assert_eq!(id("v_nobody"), None);
    let (pole, b) = (figure.mark("pole-v").unwrap(), figure.vector("v_B").unwrap());
    assert_eq!((pole.id, pole.at), ("vel-mark-pole", b.from));
    assert_eq!(figure.mark("v_B").unwrap().at, b.to);
    assert!(figure.mark("an_CB").is_some());
}

#[test]
fn a_prefix_stands_before_all_ids_and_their_uses() {
    let scene = scene::read(templates::get("crank-rocker").unwrap()).unwrap().value;
    let worked = work(&scene, Scope::Figure).unwrap().value;
    let plain = svg::write(&sheet(&scene, &worked, &SheetOptions::of_language(Lang::En)).unwrap())
        .unwrap()
        .value;
    let put = svg::IdPrefix::new("fig2-").unwrap().put_before(&plain).into_owned();
    let document = roxmltree::Document::parse(&put).unwrap();
    let ids: Vec<&str> = document.descendants().filter_map(|n| n.attribute("id")).collect();
    assert!(ids.len() > 100 && ids.iter().all(|i| i.starts_with("fig2-")));
    let used = document
        .descendants()
        .filter_map(|n| n.attribute(("http://www.w3.org/1999/xlink", "href")));
    used.for_each(|u| assert!(ids.contains(&u.strip_prefix('#').unwrap()), "{u}"));
    assert_eq!(put.replace("\"fig2-", "\"").replace("\"#fig2-", "\"#"), plain);
    for bad in ["1a", "a b", "é", "a\"", "-", "_a", &"a".repeat(65)] {
        assert_eq!(svg::IdPrefix::new(bad).unwrap_err().code, "id-prefix", "{bad}");
    }
    // Words in a text stay.
    let text = r#"<svg><title>a id="x" > b</title><g aria-label="q > id=" id="c"/></svg>"#;
    assert!(
        svg::IdPrefix::new("p")
            .unwrap()
            .put_before(text)
            .contains(r#"<title>a id="x" > b</title><g aria-label="q > id=" id="pc"/>"#)
    );
}
