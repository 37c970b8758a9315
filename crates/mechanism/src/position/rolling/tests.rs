//! Wheels by lengths: points of contact and senses of rotation.

use super::*;
use crate::mechanism::{Demand, Mechanism};
use crate::position::configure;
use hodograph_scene as scene;

#[test]
fn whole_turns_are_those_of_what_is_known_roughly() {
    for turns in -4..=4 {
        for (wrapped, rough) in [(0.3, 0.31), (3.1, -3.1), (-3.0, 3.2), (0.0, 0.0)] {
            let near = rough + TAU * f64::from(turns);
            let angle: f64 = whole(wrapped, near);
            assert!(
                (angle - near).abs() < 0.1
                    && ((angle - wrapped) / TAU - libm::round((angle - wrapped) / TAU)).abs()
                        < 1e-12,
                "{near}: {angle}"
            );
        }
    }
}

/// The centres of curvature are at Q − ρ₁n and Q + ρ₂n for any ratio of sizes, and for hollow
/// and straight contours.
#[test]
fn normals_point_from_the_first_contour_to_the_second() {
    let pair = |links: &str, centres: &str, more: &str| {
        format!(
            r#"{{"links": {{"1": ["A", "B"], "2": ["A"], "3": ["B"]}}, "ground": "1", "units": {{"length": "mm"}}, "points": {{"A": [3, 4], "B": [51, 68]}},
            "gears": [{{"links": [{links}], "centres": [{centres}], {more}}}], "driver": {{"link": "2", "omega": "1 rad/s"}}, "find": ["omega_3"]}}"#
        )
    };
    let (ab, ba) = ((r#""2", "3""#, r#""A", "B""#), (r#""3", "2""#, r#""B", "A""#));
    for (links, centres) in [ab, ba] {
        for more in [
            r#""teeth": [20, 60]"#,
            r#""teeth": [60, 20]"#,
            r#""teeth": [30, 30]"#,
            r#""teeth": [90, 30], "ring": "2""#,
            r#""teeth": [30, 90], "ring": "3""#,
        ] {
            // The ring is the larger one.
            let (hollow, first) = (more.contains("ring"), links.starts_with("\"2"));
            let more = if hollow && !first {
                more.replace("\"2\"", "\"x\"").replace("\"3\"", "\"2\"").replace("\"x\"", "\"3\"")
            } else {
                more.to_owned()
            };
            let text = pair(links, centres, &more);
            let scene = scene::read(&text).unwrap_or_else(|f| panic!("{f}\n{text}")).value;
            let m = Mechanism::new(&scene).unwrap().value;
            let at =
                configure(&scene, &m, &Demand::of(&scene, &m).with_all_positions()).unwrap().value;
            let (n, [r1, r2]) = (at.normal(&scene, RollingId(0)).unwrap(), at.shapes.rolling[0]);
            let contact = at.point(scene.rolling[0].at[0]);
            let [p, q] = scene.rolling[0].centres().map(|c| at.point(c.unwrap()));
            // For teeth alone the distance determines the radii.
            let unit = p.distance(q) / (r1 + r2).abs();
            let off = (contact - n * (r1 * unit))
                .distance(p)
                .max((contact + n * (r2 * unit)).distance(q));
            assert!(off < 1e-15, "{off} m with radii {r1} and {r2}\n{text}");
        }
    }
}
