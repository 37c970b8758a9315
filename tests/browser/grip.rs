//! A driver without a point other than its pivot (a wheel, a cam, a lever with only a slot) is
//! gripped away from its pivot and turns with the pointer.

use super::*;

/// Releases the grip and waits until it is at rest.
pub fn let_go(b: &mut Browser, at: [f64; 2]) {
    b.mouse("mouseReleased", at);
    b.eval("new Promise((done) => setTimeout(done, 400))");
}

/// The centres of grip and pivot in the window.
const GRIP: &str = "(() => { const r = document.querySelector('.grip .ring').getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2]; })()";

#[test]
fn a_wheel_and_a_slotted_lever_turn_with_the_hand() {
    let Some(mut b) = browser() else { return };
    for name in ["planetary-gear", "oldham-coupling", "cam-offset-roller"] {
        let scene = template(name);
        b.open(&page(name, &scene), PROJECTOR);
        let worked = work(&scene, Scope::Figure).unwrap().value;
        let (centre, _) = crank(&scene, &worked);
        let pivot = in_window(&mut b, centre);
        let at = b.eval(GRIP);
        let grip = [at[0].as_f64().unwrap(), at[1].as_f64().unwrap()];
        // In metres of the mechanism, y up: the window may change its scale during the drag.
        let metre = in_window(&mut b, [centre[0] + 1.0, centre[1]])[0] - pivot[0];
        let arm = [(grip[0] - pivot[0]) / metre, (pivot[1] - grip[1]) / metre];
        assert!(arm[0].hypot(arm[1]) * metre > 20.0, "{name}: the grip is at the pivot");
        b.mouse("mousePressed", grip);
        let mut last = grip;
        for k in 1..=8 {
            let (s, c) = (5.0 * f64::from(k)).to_radians().sin_cos();
            last = in_window(
                &mut b,
                [centre[0] + arm[0] * c - arm[1] * s, centre[1] + arm[0] * s + arm[1] * c],
            );
            b.mouse("mouseMoved", last);
        }
        let travelled = travel(&mut b).to_degrees();
        assert!(
            (travelled - 40.0).abs() < 1.0,
            "{name}: turned by 40°, the page says {travelled}°"
        );
        let_go(&mut b, last);
        assert_quiet(&b, name);
    }
}
