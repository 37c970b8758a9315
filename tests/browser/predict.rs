//! Prediction of a whole construction: by keys with right and wrong answers, and by the pointer.

use super::*;

pub fn text(b: &mut Browser, id: &str) -> String {
    b.eval(&format!("document.getElementById('{id}').textContent")).as_str().unwrap().to_owned()
}

pub fn asking(b: &mut Browser) -> bool {
    b.eval("document.body.classList.contains('asking')") == true
}

/// The directions (degrees) and lengths (mm) that the library lays off or draws, in order; for a
/// crossing the place of the point.
fn answers(scene: &Scene) -> Vec<Answer> {
    use hodograph::construct::Action;
    let worked = work(scene, Scope::Figure).unwrap().value;
    let mut list = Vec::new();
    for on in DiagramKind::POLYGONS {
        let Some(p) = worked.construction.polygon(on) else { continue };
        let ends = |e: usize| (p.edges[e].from.1, p.edges[e].to.1);
        for action in &p.actions {
            match action {
                Action::LayOff(e) => {
                    let (from, to) = ends(*e);
                    let by = to - from;
                    list.push(Answer::Vector {
                        degrees: by.y.atan2(by.x).to_degrees(),
                        mm: by.norm(),
                    });
                }
                Action::Line { direction, .. } => {
                    list.push(Answer::Line { degrees: direction.y.atan2(direction.x).to_degrees() })
                }
                Action::Cross { target, .. } => {
                    let at = p.images[target.0].unwrap();
                    list.push(Answer::Mark([at.x, at.y]));
                }
                _ => {}
            }
        }
    }
    list
}

#[derive(Debug)]
enum Answer {
    Vector { degrees: f64, mm: f64 },
    Line { degrees: f64 },
    Mark([f64; 2]),
}

/// Turns the tip by keys to a whole degree.
pub fn turn_to(b: &mut Browser, degrees: f64) {
    for _ in 0..400 {
        let now: f64 = b
            .eval("document.querySelector('.tip').getAttribute('aria-valuenow')")
            .as_str()
            .unwrap()
            .parse()
            .unwrap();
        let off = (degrees.round() - now + 180.0).rem_euclid(360.0) - 180.0;
        if off.abs() < 0.5 {
            return;
        }
        b.key(if off > 0.0 { "ArrowUp" } else { "ArrowDown" });
    }
    panic!("the tip does not turn to {degrees}°");
}

pub fn lengthen_to(b: &mut Browser, mm: f64) {
    for _ in 0..600 {
        let now: f64 = text(b, "guess").split(' ').next().unwrap().parse().unwrap();
        let off = (mm * 2.0).round() / 2.0 - now;
        if off.abs() < 0.25 {
            return;
        }
        b.key_with(
            if off > 0.0 { "ArrowUp" } else { "ArrowDown" },
            if off.abs() >= 5.0 { 8 } else { 0 },
        );
    }
    panic!("the tip does not go to {mm} mm");
}

/// Moves the tip by the pointer to a place of the polygon's paper (mm from the pole) and checks it.
fn drag_to(b: &mut Browser, [x, y]: [f64; 2]) {
    let script = format!(
        "(() => {{ const t = document.querySelector('.tip'), svg = t.ownerSVGElement, m = svg.getScreenCTM(); \
         const [ox, oy] = svg.dataset.origin.split(' ').map(Number), k = Number(svg.dataset.times); const r = t.querySelector('.ring').getBoundingClientRect(); \
         const p = new DOMPoint(ox + ({x}) * k, oy - ({y}) * k).matrixTransform(m); \
         return [r.x + r.width / 2, r.y + r.height / 2, p.x, p.y]; }})()"
    );
    let v: [f64; 4] = serde_json::from_value(b.eval(&script)).unwrap();
    b.mouse("mousePressed", [v[0], v[1]]);
    b.mouse("mouseMoved", [0.5 * (v[0] + v[2]), 0.5 * (v[1] + v[3])]);
    b.mouse("mouseMoved", [v[2], v[3]]);
    b.mouse("mouseReleased", [v[2], v[3]]);
}

#[test]
fn a_construction_is_predicted_by_keys() {
    let Some(mut b) = browser() else { return };
    let scene = template("crank-rocker");
    b.open(&page("predict-keys", &scene), [1280, 720]);
    b.key("q");
    assert!(asking(&mut b));
    let all = answers(&scene);
    for (k, answer) in all.iter().enumerate() {
        assert!(asking(&mut b), "{k}: {answer:?}");
        let label = b.eval("document.querySelector('.tip').getAttribute('aria-label')");
        assert!(!label.as_str().unwrap().contains("undefined"), "{label}");
        match answer {
            Answer::Vector { degrees, mm } => {
                if k == 0 {
                    // Errors are named: the sense of the crank, perpendicular and parallel, too
                    // long and too short.
                    turn_to(&mut b, degrees + 180.0);
                    b.key("Enter");
                    assert!(
                        text(&mut b, "verdict").contains("sense")
                            && bare(&text(&mut b, "verdict")).contains("ω1"),
                        "{}",
                        text(&mut b, "verdict")
                    );
                    turn_to(&mut b, degrees + 90.0);
                    b.key("Enter");
                    assert_eq!(text(&mut b, "verdict"), "It is square to AB, not along it.");
                    turn_to(&mut b, degrees + 20.0);
                    b.key("Enter");
                    assert!(
                        text(&mut b, "verdict").contains("20° off"),
                        "{}",
                        text(&mut b, "verdict")
                    );
                }
                turn_to(&mut b, *degrees);
                b.key("Enter");
                assert_eq!(text(&mut b, "verdict"), "The direction is right.", "{k}: {answer:?}");
                if k == 0 {
                    lengthen_to(&mut b, mm + 3.0);
                    b.key("Enter");
                    assert!(
                        text(&mut b, "verdict").starts_with("Too long by 3.0 mm"),
                        "{}",
                        text(&mut b, "verdict")
                    );
                }
                lengthen_to(&mut b, *mm);
            }
            Answer::Line { degrees } => turn_to(&mut b, *degrees),
            // By keys a point is placed in small steps; the pointer's test covers that.
            Answer::Mark(_) => {
                b.key("PageDown");
                assert!(text(&mut b, "verdict").starts_with("This is the answer."));
                b.key("Enter");
                continue;
            }
        }
        b.key("Enter");
        let said = text(&mut b, "verdict");
        assert!(
            said.starts_with(if k == 0 { "Correct." } else { "Right." }),
            "{k}: {answer:?}: {said}"
        );
        b.key("Enter");
    }
    assert!(!asking(&mut b));
    let marks = all.iter().filter(|a| matches!(a, Answer::Mark(_))).count();
    let want = format!("{} of {} at the first try", all.len() - marks - 1, all.len());
    assert!(
        text(&mut b, "verdict").contains(&want),
        "{} instead of {want}",
        text(&mut b, "verdict")
    );
    b.key("q");
    assert_eq!(b.eval("document.getElementById('predict').getAttribute('aria-pressed')"), "false");
    assert_quiet(&b, "predict");
}

#[test]
fn a_construction_is_predicted_by_the_pointer_on_a_phone() {
    let Some(mut b) = browser() else { return };
    let scene = template("crank-rocker");
    b.open(&page("predict-pointer", &scene), PHONE);
    b.eval("document.getElementById('predict').click()");
    let click =
        |b: &mut Browser, id: &str| b.eval(&format!("document.getElementById('{id}').click()"));
    let mut tail = [0.0, 0.0];
    for answer in answers(&scene).into_iter().take(4) {
        assert!(asking(&mut b), "{answer:?}");
        let script = "(() => { const c = document.querySelector('circle.guess'); if (!c) return [0, 0]; const svg = c.ownerSVGElement, [x, y] = svg.dataset.origin.split(' ').map(Number), \
                      k = Number(svg.dataset.times); return [(c.cx.baseVal.value - x) / k, (y - c.cy.baseVal.value) / k]; })()";
        let from: [f64; 2] = serde_json::from_value(b.eval(script)).unwrap();
        match answer {
            Answer::Vector { degrees, mm } => {
                tail = from;
                let (sin, cos) = degrees.to_radians().sin_cos();
                // The pointer is two degrees off; the set square corrects that.
                let (s2, c2) = (degrees + 2.0).to_radians().sin_cos();
                drag_to(&mut b, [tail[0] + 0.5 * mm * c2, tail[1] + 0.5 * mm * s2]);
                click(&mut b, "check");
                assert_eq!(text(&mut b, "verdict"), "The direction is right.");
                drag_to(&mut b, [tail[0] + mm * cos, tail[1] + mm * sin]);
            }
            Answer::Line { degrees } => {
                let (sin, cos) = degrees.to_radians().sin_cos();
                drag_to(&mut b, [from[0] + 30.0 * cos, from[1] + 30.0 * sin]);
            }
            Answer::Mark(at) => {
                drag_to(&mut b, [at[0] + 8.0, at[1]]);
                click(&mut b, "check");
                assert!(
                    text(&mut b, "verdict").contains("mm from the point of intersection"),
                    "{}",
                    text(&mut b, "verdict")
                );
                drag_to(&mut b, at);
            }
        }
        click(&mut b, "check");
        // The point is placed right only at the second try.
        let said = text(&mut b, "verdict");
        let due = if matches!(answer, Answer::Mark(_)) { "Correct." } else { "Right." };
        assert!(said.starts_with(due), "{answer:?} from {tail:?}: {said}");
        click(&mut b, "check");
    }
    assert_quiet(&b, "predict on a phone");
}
