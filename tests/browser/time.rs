//! A lesson through time: places, velocities and polygons are those of the time shown, and it
//! restarts at its end.

use super::{PROJECTOR, assert_quiet, browser, drawn, shown, travel};
use hodograph::lesson::{LessonOptions, lesson};
use hodograph::scene::{Kind, Lang, Swept, read, templates};
use hodograph::worked::{Scope, work};
use std::path::PathBuf;

#[test]
fn a_lesson_through_time_shows_what_holds_at_each_time() {
    let Some(mut b) = browser() else { return };
    let name = "plate-by-law";
    let scene = read(templates::get(name).unwrap()).unwrap().value;
    let options =
        LessonOptions { swept: Swept::usual(&scene), ..LessonOptions::of_language(Lang::En) };
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("lesson-time.html");
    std::fs::write(&path, lesson(&scene, &options).unwrap().value).unwrap();
    b.open(&path, PROJECTOR);
    let said = |b: &mut super::Browser| {
        b.eval("document.getElementById('travel').textContent").as_str().unwrap().to_owned()
    };
    assert_eq!(said(&mut b), "t = 1 s");
    for steps in [3, 40] {
        for _ in 0..steps {
            b.key("+");
        }
        let instant = scene.instant() + travel(&mut b);
        let mut there =
            read(templates::instantiate(name, &[("t", &format!("{instant:?} s"))]).unwrap())
                .unwrap()
                .value;
        let mut mu = |key: &str| {
            b.eval(&format!("document.querySelector('#{key} svg')?.dataset.mu ?? ''"))
                .as_str()
                .unwrap()
                .parse::<f64>()
                .ok()
        };
        for (kind, shows) in [
            (Kind::Length, "mechanism"),
            (Kind::Velocity, "velocity"),
            (Kind::Acceleration, "acceleration"),
        ] {
            there.paper.scales.set(kind, mu(shows));
        }
        let worked = work(&there, Scope::Figure).unwrap().value;
        let (shown, drawn) = (shown(&mut b), drawn(&there, &worked));
        let mut compared = 0;
        for (id, want) in &drawn {
            let Some(told) = shown.get(id) else { continue };
            let worst = told.iter().zip(want).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-2, "at t = {instant} s: {id} is off by {worst} mm");
            compared += 1;
        }
        assert!(compared > 7, "at t = {instant} s only {compared} of {:?} are shown", drawn.keys());
    }
    assert_eq!(said(&mut b), "t = 2 s");
    // Time does not run backwards.
    b.key(" ");
    b.eval("new Promise((done) => setTimeout(done, 300))");
    b.key(" ");
    assert!(travel(&mut b) < -0.5, "it begins anew: {}", said(&mut b));
    assert_quiet(&b, name);
}
