//! Poses of a motion: the cam moves its follower in each of them, and the answers are those of the
//! motion.

use hodograph::answer::AnswerValue;
use hodograph::scene::{self, Scene, Swept, templates};
use hodograph::sweep;
use hodograph::sweep::follow::{PoseFollower, course::over_a_turn};
use hodograph::sweep::pieces::gather;
use hodograph::sweep::vary::{Variation, Varied};
use hodograph::worked::{self, Scope, Worked, work, work_placed, work_pose};

/// Poses of a turn.
const POSES: usize = 24;

/// The scenes with cams that are replaced for an instant: templates, and one case of each kind of
/// cam.
fn scenes() -> Vec<(String, Scene)> {
    let read = |name: &str, text: &str| {
        (name.to_owned(), scene::read(text).unwrap_or_else(|f| panic!("{name}: {f}")).value)
    };
    let templates =
        templates::list().into_iter().map(|t| read(t.name, templates::get(t.name).unwrap()));
    let kinds = ["tangent", "flat", "swinging flat", "law cycloidal", "swing harmonic"];
    let kinds = kinds.into_iter().map(|kind| read(kind, &crate::text(kind, "33 deg")));
    templates.chain(kinds).filter(|(_, scene)| scene.has_momentary_cams()).collect()
}

fn answers(scene: &Scene, worked: &Worked) -> Vec<(String, AnswerValue)> {
    worked.results.iter().map(|r| (scene.find[r.find].text.clone(), r.value())).collect()
}

#[test]
fn a_pose_of_a_motion_is_moved_by_its_cam() {
    let mut told = 0;
    for (name, scene) in scenes() {
        let motion = over_a_turn(&scene);
        let base = work(&motion, Scope::Figure).unwrap_or_else(|f| panic!("{name}: {f}")).value;
        let follower = PoseFollower::new(
            &motion,
            &base.mechanism,
            &base.demand,
            &base.configuration,
            Swept::Driver(0),
        );
        let (mut poses, mut moved) = (0, 0);
        for pose in follower.sweep(POSES).poses {
            let there = follower.scene_at(&motion, pose.travel);
            let led = work_placed(
                &there,
                base.mechanism.clone(),
                base.demand.clone(),
                pose.configuration.clone(),
            );
            let (Ok(led), Ok((own, worked))) =
                (led, work_pose(&there, (&base.mechanism, &base.demand), &pose.configuration))
            else {
                continue;
            };
            poses += 1;
            moved += usize::from(own.own_drivers() == own.drivers.len());
            let by_cam = answers(&own, &worked);
            for (text, value) in answers(&there, &led.value) {
                // A question about the contact has no answer where a driver replaces it.
                let Some((_, other)) = by_cam.iter().find(|(of, _)| *of == text) else {
                    panic!("{name}: no {text}")
                };
                let pairs = || value.columns().into_iter().zip(other.columns());
                let size = pairs().map(|(a, b)| a.abs().max(b.abs())).fold(1e-3, f64::max);
                for (a, b) in pairs() {
                    assert!(
                        (a - b).abs() < 1e-7 * size,
                        "{name} at {}: {text} is {b}, of the motion {a}",
                        pose.travel
                    );
                    told += 1;
                }
            }
        }
        assert!(
            poses >= POSES / 2 && moved * 10 >= poses * 9,
            "{name}: the cam moves {moved} of {poses} poses"
        );
    }
    assert!(told > 1000, "{told}");
}

/// A table over a parameter of a cam has a row for each value: the scene read with that value, for
/// the instant and for the motion.
#[test]
fn parameters_of_a_cam_vary_as_the_scene_is_read() {
    for (name, parameter, from, to) in [
        ("cam-offset-roller", "h", "12 mm", "30 mm"),
        ("cam-offset-roller", "e", "0 mm", "12 mm"),
        ("cam-valve-train", "phi_2", "0 deg", "300 deg"),
    ] {
        let own = scene::read(templates::get(name).unwrap()).unwrap().value;
        for scene in [over_a_turn(&own), own] {
            let mechanism = sweep::mechanism(&scene).unwrap();
            let variation = Variation::new(&scene, &[parameter]).unwrap();
            let span = variation.span(&scene, parameter, from, to, 6).unwrap();
            let table = gather(&mut Varied::new(&scene, &mechanism, &variation, span));
            assert_eq!(table.columns[0].values.len(), 7, "{name}, {parameter}: {:?}", table.notes);
            for row in 0..7 {
                let value = span.value(row);
                let text = if value.degrees {
                    format!("{:?} deg", value.number)
                } else {
                    format!("{:?} m", value.si())
                };
                let there =
                    scene::read(templates::instantiate(name, &[(parameter, &text)]).unwrap())
                        .unwrap()
                        .value;
                let worked = work(&worked::instant(there).value, Scope::Questions).unwrap().value;
                let meant: Vec<f64> =
                    worked.results.iter().flat_map(|r| r.value().columns()).collect();
                let told = table.columns[1..].iter().map(|c| c.values[row]);
                let size = meant.iter().fold(1e-3, |s: f64, v| s.max(v.abs()));
                for (told, meant) in told.zip(meant) {
                    assert!(
                        (told - meant).abs() < 1e-9 * size,
                        "{name} with {parameter} = {text}: {told}, read {meant}"
                    );
                }
            }
        }
    }
}
