//! Poses of a motion: the cam moves its follower in each of them, and the answers are those of the motion.

use hodograph::answer::Value;
use hodograph::scene::{self, Scene, Swept, templates};
use hodograph::sweep::follow::{Follower, course::over_a_turn};
use hodograph::worked::{Scope, Worked, work, work_placed, work_pose};

/// Poses of a turn.
const POSES: usize = 24;

/// The scenes whose cams are replaced for an instant: templates, and one of the cases of each kind of cam.
fn scenes() -> Vec<(String, Scene)> {
    let read = |name: &str, text: &str| (name.to_owned(), scene::read(text).unwrap_or_else(|f| panic!("{name}: {f}")).value);
    let templates = templates::list().into_iter().map(|t| read(t.name, templates::get(t.name).unwrap()));
    let kinds = ["tangent", "flat", "swinging flat", "law cycloidal", "swing harmonic"];
    let kinds = kinds.into_iter().map(|kind| read(kind, &crate::text(kind, "33 deg")));
    templates.chain(kinds).filter(|(_, scene)| scene.has_momentary_cams()).collect()
}

fn answers(scene: &Scene, worked: &Worked) -> Vec<(String, Value)> {
    worked.results.iter().map(|r| (scene.find[r.find].text.clone(), r.value())).collect()
}

#[test]
fn a_pose_of_a_motion_is_moved_by_its_cam() {
    let mut told = 0;
    for (name, scene) in scenes() {
        let motion = over_a_turn(&scene);
        let base = work(&motion, Scope::Figure).unwrap_or_else(|f| panic!("{name}: {f}")).value;
        let follower = Follower::new(&motion, &base.mechanism, &base.demand, &base.configuration, Swept::Driver(0));
        let (mut poses, mut moved) = (0, 0);
        for pose in follower.sweep(POSES).poses {
            let there = follower.scene_at(&motion, pose.travel);
            let led = work_placed(&there, base.mechanism.clone(), base.demand.clone(), pose.configuration.clone());
            let (Ok(led), Ok((own, worked))) = (led, work_pose(&there, (&base.mechanism, &base.demand), &pose.configuration)) else {
                continue;
            };
            poses += 1;
            moved += usize::from(own.own_drivers() == own.drivers.len());
            let by_cam = answers(&own, &worked);
            for (text, value) in answers(&there, &led.value) {
                // A question about the contact has no answer where a driver stands for it.
                let Some((_, other)) = by_cam.iter().find(|(of, _)| *of == text) else { panic!("{name}: no {text}") };
                let pairs = || value.columns().into_iter().zip(other.columns());
                let size = pairs().map(|(a, b)| a.abs().max(b.abs())).fold(1e-3, f64::max);
                for (a, b) in pairs() {
                    assert!((a - b).abs() < 1e-7 * size, "{name} at {}: {text} is {b}, of the motion {a}", pose.travel);
                    told += 1;
                }
            }
        }
        assert!(poses >= POSES / 2 && moved * 10 >= poses * 9, "{name}: the cam moves {moved} of {poses} poses");
    }
    assert!(told > 1000, "{told}");
}
