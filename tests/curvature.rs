//! Curvature: drawing with the ruler against accelerations, both against reference cases and against differences of places.

use hodograph::curvature::drawing::{Drawing, How};
use hodograph::curvature::motion::{Bend, State};
use hodograph::curvature::{Asked, Curvature, OfLink, centrodes, couplers, curvature};
use hodograph::geom::{Point, Vec2};
use hodograph::scene::{self, LinkId, PointId, Scene, templates};
use serde_json::Value as Json;

fn read(text: &str) -> Scene {
    scene::read(text).unwrap_or_else(|f| panic!("{f}\n{text}")).value
}

fn template(name: &str, values: &[(&str, &str)]) -> Scene {
    read(&templates::instantiate(name, values).unwrap())
}

fn all(scene: &Scene) -> Curvature {
    let asked = Asked { links: couplers(scene), ..Asked::default() };
    curvature(scene, &asked).unwrap_or_else(|f| panic!("{f}")).value
}

fn link(scene: &Scene, name: &str) -> LinkId {
    LinkId(scene.links.iter().position(|l| l.name == name).unwrap())
}

fn point(scene: &Scene, name: &str) -> PointId {
    PointId(scene.points.iter().position(|p| p.name == name).unwrap())
}

/// The cases by the ruler: no velocity enters P, J and E₀.
#[test]
fn cases_by_drawing() {
    let mut values = 0;
    for name in ["curv-fourbar", "curv-slider-crank", "curv-cardan"] {
        let path = format!("{}/tests/cases/{name}.json", env!("CARGO_MANIFEST_DIR"));
        let case: Json = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
        let scene = read(&case["scene"].to_string());
        let found = all(&scene);
        let of = &found.list[0];
        let drawn = of.drawn().unwrap();
        let e = of.points.iter().find(|p| scene.point_name(p.point) == "E").unwrap();
        let centre = e.drawn.unwrap().centre.at().unwrap();
        let (j, k, u) = (drawn.pole + drawn.normal, drawn.acceleration_pole.unwrap(), drawn.pole_velocity.unwrap());
        for expected in case["expect"].as_array().unwrap() {
            let value = match expected["name"].as_str().unwrap() {
                "P_x" => drawn.pole.x,
                "P_y" => drawn.pole.y,
                "J_x" => j.x,
                "J_y" => j.y,
                "d_inflection" => drawn.normal.norm(),
                "K_x" => k.x,
                "K_y" => k.y,
                "rho_E" => centre.distance(e.at),
                "E0_x" => centre.x,
                "E0_y" => centre.y,
                "u_P" => u.norm(),
                other => panic!("{other}"),
            };
            let exact: f64 = expected["exact"].as_str().unwrap().parse().unwrap();
            let size = expected["size"].as_f64().unwrap_or(exact.abs());
            assert!((value - exact).abs() < 1e-10 * size, "{name} {}: {value}, expected {exact}", expected["name"]);
            values += 1;
        }
        assert!(of.apart().unwrap() < 1e-11, "{name}: {:?}", of.apart());
    }
    assert_eq!(values, 33);
}

#[test]
fn the_collineation_point_is_where_the_rod_crosses_the_ground() {
    let found = all(&template("crank-rocker", &[("l_AB", "100"), ("l_BC", "250"), ("l_CD", "200"), ("l_AD", "300"), ("phi_1", "60")]));
    let Drawing::Rays(rays) = &found.list[0].drawing else { panic!("two cranks are two rays") };
    let q = rays.collineation.unwrap().at().unwrap();
    assert!(q.distance(Point::new(-0.12348702887402354484, 0.0)) < 1e-12, "{q:?}");
    assert!(rays.how.iter().all(|h| matches!(h, How::Collineation(_))));
}

/// Every template with a coupler, at many positions: both ways are one, and Ball's point too.
#[test]
fn drawing_is_analysis_everywhere() {
    let (mut poses, mut balls, mut faults) = (0, 0, Vec::new());
    for t in templates::list() {
        let turns = t.parameters.iter().any(|(name, _)| name == "phi_1");
        for k in 0..if turns { 12 } else { 1 } {
            let angle = format!("{} deg", 7 + 30 * k);
            let values: Vec<(&str, &str)> = if turns { vec![("phi_1", angle.as_str())] } else { Vec::new() };
            let Ok(text) = templates::instantiate(t.name, &values) else { continue };
            let Ok(scene) = scene::read(&text) else { continue };
            let asked = Asked { links: couplers(&scene.value), ..Asked::default() };
            let Ok(found) = curvature(&scene.value, &asked) else { continue };
            for of in &found.value.list {
                let Some(apart) = of.apart() else { continue };
                poses += 1;
                balls += usize::from(of.drawn().unwrap().ball.is_some() && of.pole().is_some_and(|p| p.ball.is_some()));
                if apart.is_nan() || apart > 1e-8 {
                    faults.push(format!("{} {values:?} link {}: {apart:e}", t.name, scene.value.link_name(of.link)));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{} of {poses}:\n{}", faults.len(), faults.join("\n"));
    assert!(poses > 200 && balls > 100, "{poses} poses, {balls} Ball's points");
}
