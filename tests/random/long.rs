//! Long chains: a hundred dyads one after another, three hundred links.

use crate::rng::Rng;
use hodograph::scene;
use hodograph::worked::{Scope, work};
use serde_json::json;
use std::time::{Duration, Instant};

/// Four-bar after four-bar: every rocker drives the next.
fn chain(dyads: usize, lengths: bool) -> String {
    let mut rng = Rng::new(7);
    let mut near = |a: f64| a + rng.between(-0.03, 0.03);
    let (mut links, mut points, mut sketch, mut rods) = (
        serde_json::Map::new(),
        serde_json::Map::new(),
        serde_json::Map::new(),
        serde_json::Map::new(),
    );
    let mut pivots = vec!["A0".to_string()];
    let m = |x: f64| format!("{x:?} m");
    points.insert("A0".into(), json!(["0 m", "0 m"]));
    let mut last = (0.0f64, 1.0f64);
    points.insert("B0".into(), json!([m(last.0), m(last.1)]));
    links.insert("c".into(), json!(["A0", "B0"]));
    for i in 1..=dyads {
        let at = (near(i as f64), near(1.0));
        let pivot = (near(i as f64), near(0.0));
        points.insert(format!("A{i}"), json!([m(pivot.0), m(pivot.1)]));
        (if lengths { &mut sketch } else { &mut points })
            .insert(format!("B{i}"), json!([m(at.0), m(at.1)]));
        if lengths {
            rods.insert(format!("B{},B{i}", i - 1), json!(m((at.0 - last.0).hypot(at.1 - last.1))));
            rods.insert(format!("A{i},B{i}"), json!(m((at.0 - pivot.0).hypot(at.1 - pivot.1))));
        }
        pivots.push(format!("A{i}"));
        links.insert(format!("r{i}"), json!([format!("B{}", i - 1), format!("B{i}")]));
        links.insert(format!("s{i}"), json!([format!("A{i}"), format!("B{i}")]));
        last = at;
    }
    links.insert("g".into(), json!(pivots));
    json!({"links": links, "ground": "g", "points": points, "sketch": sketch, "lengths": rods,
        "driver": {"link": "c", "omega": "1 rad/s", "alpha": "0.5 rad/s^2"},
        "find": [format!("a_B{dyads}"), format!("v_B{dyads}"), format!("alpha_r{dyads}"), format!("omega_s{dyads}")]})
    .to_string()
}

#[test]
fn a_hundred_dyads_and_three_hundred_links() {
    for (dyads, lengths) in [(100, false), (100, true), (150, false), (150, true)] {
        let start = Instant::now();
        let scene = scene::read(chain(dyads, lengths)).unwrap().value;
        let done =
            work(&scene, Scope::Figure).unwrap_or_else(|f| panic!("{dyads} dyads: {f}")).value;
        let took = start.elapsed();
        println!(
            "{dyads} dyads ({} links): {took:?}, condition {:.1e}",
            scene.links.len(),
            done.solution.condition
        );
        for o in &done.results {
            let a = o.agreement.expect("drawn and computed");
            assert!(
                a.holds() && a.difference < 1e-9,
                "{dyads} dyads: {} {o:?}",
                scene.find[o.find].text
            );
        }
        assert!(took < Duration::from_secs(10), "{dyads} dyads took {took:?}");
    }
}
