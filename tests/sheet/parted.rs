//! Two links that overlap are distinguishable in any pose.

use crate::wide::every;
use hodograph::figure::mechanism::mechanism;
use hodograph::geom::Point;
use hodograph::notation::Notation;
use hodograph::paper::item::{FigureItem, Shape};
use hodograph::paper::style::Style;
use hodograph::scene::{self, Lang, Scene, templates};
use hodograph::scene::{driver_position, with_driver_at};
use hodograph::worked::{Scope, work};

/// White space is visible between two bars of 0.7 mm with their middles at this distance.
const APART_MM: f64 = 0.8;
/// Bars that overlap over a shorter length meet at a joint.
const OVER_MM: f64 = 4.5;

type Bar = (Option<usize>, Point, Point);

fn bars(items: &[FigureItem]) -> Vec<Bar> {
    let bar = |i: &FigureItem| match i.shape {
        Shape::Line { from, to, .. } if i.class.trim_end().ends_with(" link") => {
            Some((i.link, from, to))
        }
        _ => None,
    };
    items.iter().filter_map(bar).collect()
}

/// The distance of two bars where they run side by side, found by trying places; `None` where they
/// do not.
fn least_apart((_, a, b): Bar, (_, c, d): Bar) -> Option<f64> {
    const PLACES: usize = 400;
    let off = |p: Point| {
        let u = (d - c).unit()?;
        let t = (p - c).dot(u);
        (0.0..=c.distance(d)).contains(&t).then(|| u.cross(p - c).abs())
    };
    let near: Vec<f64> =
        (0..=PLACES).filter_map(|k| off(a + (b - a) * (k as f64 / PLACES as f64))).collect();
    let shared = near.len() as f64 / PLACES as f64 * a.distance(b);
    (shared > OVER_MM).then(|| near.into_iter().fold(0.0, f64::max))
}

fn over_one_another(scene: &Scene) -> Vec<String> {
    let Ok(worked) = work(scene, Scope::Figure) else { return Vec::new() };
    let drawn =
        mechanism(&Style::default(), scene, &worked.value, &Notation::of_language(Lang::En));
    let bars = bars(&drawn.items);
    let mut found = Vec::new();
    for (k, one) in bars.iter().enumerate() {
        for other in bars[..k].iter().filter(|o| o.0 != one.0) {
            if let Some(mm) = least_apart(*one, *other).filter(|mm| *mm < APART_MM) {
                found.push(format!("links {:?} and {:?} are {mm:.2} mm apart", one.0, other.0));
            }
        }
    }
    found
}

#[test]
fn links_over_one_another_are_distinguished() {
    let mut faults = Vec::new();
    for t in templates::list() {
        let scene = scene::read(templates::get(t.name).unwrap()).unwrap().value;
        let Some(start) = driver_position(&scene, 0) else { continue };
        for degrees in (0..360).step_by(every(8)) {
            let pose = with_driver_at(&scene, 0, start + f64::from(degrees).to_radians());
            faults.extend(
                over_one_another(&pose)
                    .into_iter()
                    .map(|f| format!("{} {degrees}° on: {f}", t.name)),
            );
        }
    }
    assert!(faults.is_empty(), "{} poses:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn a_parallelogram_in_line_shows_all_its_links() {
    let text = r#"{
        "links": {"1": ["A", "B"], "2": ["B", "C"], "3": ["D", "C"], "4": ["A", "D"]},
        "ground": "4",
        "lengths": {"AB": "100 mm", "BC": "160 mm", "CD": "100 mm", "AD": "160 mm"},
        "driver": {"link": "1", "angle": "60 deg", "omega": "6 rad/s"},
        "side": {"C": "left of BD"},
        "find": ["v_C"]
    }"#;
    let scene = scene::read(text).unwrap().value;
    for degrees in [0.0_f64, 2.0, 180.0] {
        let pose = with_driver_at(&scene, 0, degrees.to_radians());
        assert_eq!(over_one_another(&pose), Vec::<String>::new());
        let worked = work(&pose, Scope::Figure).unwrap().value;
        let drawn = mechanism(&Style::default(), &pose, &worked, &Notation::of_language(Lang::En));
        assert_eq!(bars(&drawn.items).len(), 3, "crank, coupler and the other crank");
    }
}
