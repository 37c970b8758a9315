//! The linkage in place of a cam: it has the velocities and accelerations of the mechanism, by a
//! solution that knows no cam.

use hodograph::answer::AnswerValue;
use hodograph::problem::templates;
use hodograph::report::replaced::replaced_words;
use hodograph::scene::{self, Scene};
use hodograph::worked::{Outcome, Scope, work, work_replaced};

/// Largest difference, as a part of the larger of one and the value.
const CLOSE: f64 = 1e-7;

fn components(outcome: &Outcome) -> Vec<f64> {
    match outcome.computed {
        AnswerValue::Scalar(x) => vec![x],
        AnswerValue::Vector(v) => vec![v.x, v.y],
        AnswerValue::Point(p) => vec![p.x, p.y],
    }
}

/// The scene with questions for all moving links and the points on them.
fn asking(text: &str, bare: &Scene) -> Scene {
    let moving = bare.links.iter().filter(|l| l.name != bare.links[bare.ground.0].name);
    let links =
        moving.clone().flat_map(|l| [format!("omega_{}", l.name), format!("alpha_{}", l.name)]);
    let on_one = |p: &&scene::PointId| bare.carriers(**p).count() == 1;
    let points = moving.flat_map(|l| l.points.iter().filter(on_one)).flat_map(|p| {
        let name = bare.point_name(*p);
        [format!("v_{name}"), format!("a_{name}")]
    });
    let questions: Vec<String> = links.chain(points).collect();
    scene::read_asking(text.as_bytes(), &questions.join(",")).unwrap().value
}

#[test]
fn the_linkage_moves_as_the_cam_does() {
    let mut compared = 0;
    for (name, angle) in [
        ("cam-eccentric", "phi_2"),
        ("cam-offset-roller", "phi_2"),
        ("cam-valve-train", "phi_2"),
        ("cam-centres", "phi_2"),
        ("cam-on-arm", "phi_2"),
        ("eccentric-three-ways", "phi_2"),
    ] {
        for degrees in [20, 70, 115, 200, 260, 335] {
            let turned = format!("{degrees} deg");
            let Ok(text) = templates::text(name, &[(angle, &turned)]) else { continue };
            let Ok(bare) = scene::read(&text) else { continue };
            let scene = asking(&text, &bare.value);
            let Ok(worked) = work(&scene, Scope::Questions) else { continue };
            let Some((mut of, _)) = work_replaced(&scene, &worked.value).unwrap() else { continue };
            assert_eq!(of.links.len(), replaced_words(&scene).len());
            of.scene.find = scene.find.clone();
            let linkage =
                work(&of.scene, Scope::Questions).unwrap_or_else(|f| panic!("{name}: {f}"));
            let [own, lower] = [&worked.value.results, &linkage.value.results];
            let of_question = |find: usize| lower.iter().find(|r| r.find == find);
            for a in own {
                let Some(b) = of_question(a.find) else { continue };
                for (x, y) in components(a).into_iter().zip(components(b)) {
                    let off = (x - y).abs() / x.abs().max(1.0);
                    let asked = &scene.find[a.find].text;
                    assert!(off < CLOSE, "{name} at {degrees}°: {asked}: {x}, {y}");
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 150, "{compared} numbers were compared");
}
