//! Lessons on a touch screen, and for readers who prefer less motion.

use crate::chromium::Browser;
use crate::{PHONE, assert_quiet, browser, crank, in_window, page, template, travel, worked_at};
use hodograph::scene::driver_position;
use serde_json::json;

fn touch(b: &mut Browser, kind: &str, at: Option<[f64; 2]>) {
    let points: Vec<_> = at.iter().map(|[x, y]| json!({"x": x, "y": y})).collect();
    b.call("Input.dispatchTouchEvent", json!({"type": kind, "touchPoints": points}));
}

#[test]
fn a_finger_turns_the_crank_and_the_page_stays_where_it_is() {
    let Some(mut b) = browser() else { return };
    let scene = template("crank-rocker");
    b.call("Emulation.setTouchEmulationEnabled", json!({"enabled": true, "maxTouchPoints": 5}));
    b.open(&page("touch", &scene), PHONE);
    let start = driver_position(&scene, 0).unwrap().to_degrees();
    let (_, first) = worked_at(&mut b, &scene, 0.0);
    let (centre, radius) = crank(&scene, &first);
    let on = |d: f64| {
        [centre[0] + radius * d.to_radians().cos(), centre[1] + radius * d.to_radians().sin()]
    };
    let grip = in_window(&mut b, on(start));
    touch(&mut b, "touchStart", Some(grip));
    for turned in [10.0, 25.0, 40.0, 55.0, 70.0] {
        let finger = in_window(&mut b, on(start + turned));
        touch(&mut b, "touchMove", Some(finger));
    }
    // Moves of a finger are passed on with the next frame.
    b.eval("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))");
    let turned = travel(&mut b).to_degrees();
    assert!((turned - 70.0).abs() < 0.5, "the finger went 70°, the crank {turned}°");
    touch(&mut b, "touchEnd", None);
    assert_eq!(b.eval("scrollY"), 0, "the page has scrolled under the finger");

    // Beside the grip, the same finger scrolls the page.
    let acts =
        |what: &str| format!("getComputedStyle(document.querySelector('{what}')).touchAction");
    assert_eq!(b.eval(&acts("#mechanism svg")), "pan-y");
    assert_eq!(b.eval(&acts(".grip")), "none");
    assert_quiet(&b, "touch");
}

#[test]
fn with_less_motion_the_driver_goes_from_position_to_position() {
    let Some(mut b) = browser() else { return };
    let scene = template("crank-rocker");
    let less = json!({"features": [{"name": "prefers-reduced-motion", "value": "reduce"}]});
    b.call("Emulation.setEmulatedMedia", less);
    b.open(&page("less-motion", &scene), PHONE);
    let moved = "new Promise((done) => { const seen = new Set(), grip = document.querySelector('.grip'); \
                 const look = (n) => { seen.add(grip.dataset.travel); n ? requestAnimationFrame(() => look(n - 1)) : done([...seen].map(Number)); }; \
                 document.getElementById('play').click(); look(90); })";
    let seen: Vec<f64> = serde_json::from_value(b.eval(moved)).unwrap();
    b.eval("document.getElementById('play').click()");
    // A second and a half at 60 frames a second: jumps every 0.7 s, not a new place in each frame.
    assert!((2..=6).contains(&seen.len()), "{} places in 90 frames", seen.len());
    let step = seen[1] - seen[0];
    assert!(step.abs() > 1f64.to_radians(), "the driver hops by {step}");
    assert_quiet(&b, "less motion");
}
