//! Every end of a follower (edge, roller, round end, flat face) on every path (sliding with an
//! offset, swinging) under every profile (one circle, arcs, tangents, a law), with cam and follower
//! on the ground, on one moving link, or on different links. Drawing and analysis, and the contact
//! as a point of the questions, are compared with a contact found by brute force ([`envelope`]) and
//! with its differences.

mod envelope;
mod seat;

use crate::wide::every;
use envelope::{End, Held, held};
use hodograph::answer::AnswerValue;
use hodograph::geom::Vec2;
use hodograph::scene;
use hodograph::worked::{Scope, work};
use seat::{Profile, Seat, Setting};
use std::f64::consts::TAU;

const H: f64 = 1e-3;

/// The state of the follower at a time.
struct Follower {
    held: Held,
    /// Its point B; for a swinging face W on the face.
    point: Vec2,
    /// The angle of a swinging follower.
    angle: f64,
}

fn follower(s: &Setting, t: f64) -> Follower {
    let (cam, way) = (s.cam(t), s.way(t));
    let held = match s.profile {
        Profile::Law => s.by_law(t),
        Profile::Circle | Profile::Arcs | Profile::Tangent => held(&s.pieces(), cam, s.end, way),
    };
    let (point, angle) = match way {
        envelope::Way::Along { through, direction } => (through + direction * held.at, 0.0),
        envelope::Way::About { pivot, arm } => (pivot + Vec2::from_angle(held.at) * arm, held.at),
    };
    Follower { held, point, angle }
}

/// Value, first and second derivative, from five places.
fn differences(f: impl Fn(f64) -> f64) -> [f64; 3] {
    let [a, b, c, d, e] = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| f(k * H));
    [
        c,
        (a - 8.0 * b + 8.0 * d - e) / (12.0 * H),
        (-a + 16.0 * b - 30.0 * c + 16.0 * d - e) / (12.0 * H * H),
    ]
}

fn numbers(v: AnswerValue) -> [f64; 2] {
    match v {
        AnswerValue::Scalar(s) => [s, 0.0],
        AnswerValue::Vector(v) => [v.x, v.y],
        AnswerValue::Point(p) => [p.x, p.y],
    }
}

/// Returns the faults in the answers of a setting; empty if all agree.
fn faults(s: &Setting) -> Vec<String> {
    let now = follower(s, 0.0);
    // Next to a joint, differences reach across it.
    let spread = [-2.0, 2.0].map(|k| follower(s, k * H).held.contact);
    let (p, swings) = (s.point_name(), s.swings);
    let mut find = vec![
        format!("v_{p}"),
        format!("a_{p}"),
        "x_E".into(),
        "y_E".into(),
        "v_E2".into(),
        "v_E3".into(),
        "a_E3".into(),
        "vr_E3E2".into(),
    ];
    if s.seat == Seat::Still {
        find.retain(|f| !f.contains("E2"));
    }
    if matches!(s.end, End::Round(r) if r > 0.0) {
        find.push("pressure_3".into());
    }
    if swings {
        find.extend(["omega_3".into(), "alpha_3".into()]);
    }
    let text =
        s.text(&find.iter().map(|f| format!("\"{f}\"")).collect::<Vec<_>>().join(", "), &now);
    let scene = match scene::read(&text) {
        Ok(scene) => scene.value,
        Err(f) => return vec![format!("refused: {f}\n{text}")],
    };
    let worked = match work(&scene, Scope::Figure) {
        Ok(w) => w.value,
        Err(f) => return vec![format!("not solved: {f}\n{text}")],
    };
    let mut out = Vec::new();
    if worked.results.len() != find.len() {
        out.push("something is not answered".to_owned());
    }
    let track = |f: &dyn Fn(&Follower) -> Vec2| {
        let [x, y] = [differences(|t| f(&follower(s, t)).x), differences(|t| f(&follower(s, t)).y)];
        [0, 1, 2].map(|k| Vec2::new(x[k], y[k]))
    };
    let [_, v, a] = track(&|f| f.point);
    let turn = |a: f64| a - TAU * ((a - now.angle) / TAU).round();
    let [_, w, alpha] = differences(|t| turn(follower(s, t).angle));
    let base = s.frame_rate();
    // A sliding follower turns with the link in which it slides.
    let (w3, alpha3) = if swings { (w, alpha) } else { base };
    let arm = now.held.contact - now.point;
    let v3 = v + arm.perp() * w3;
    let a3 = a + arm.perp() * alpha3 - arm * (w3 * w3);
    let v2 = s.cam_velocity(now.held.contact);
    let beside = (spread[1] - spread[0]).norm().max(1e-3);
    // The path of the end in its carrier, relative to the normal.
    let way = match s.way(0.0) {
        envelope::Way::Along { direction, .. } => direction,
        envelope::Way::About { pivot, .. } => (now.point - pivot).perp(),
    };
    let pressure = arm.cross(way).abs().atan2(arm.dot(way).abs());
    for r in &worked.results {
        let text = scene.find[r.find].text.as_str();
        let (exact, tolerance) = match text {
            "x_E" => ([now.held.contact.x, 0.0], 3e-7 * (1.0 + beside)),
            "y_E" => ([now.held.contact.y, 0.0], 3e-7 * (1.0 + beside)),
            "v_E2" => ([v2.x, v2.y], 1e-6),
            "v_E3" => ([v3.x, v3.y], 1e-6),
            "a_E3" => ([a3.x, a3.y], 2e-5),
            "vr_E3E2" => ([v3.x - v2.x, v3.y - v2.y], 1e-6),
            "pressure_3" => ([pressure, 0.0], 1e-5),
            "omega_3" => ([w, 0.0], 1e-6),
            "alpha_3" => ([alpha, 0.0], 2e-5),
            f if f.starts_with("v_") => ([v.x, v.y], 1e-7),
            _ => ([a.x, a.y], 2e-6),
        };
        let drawn = r.drawn.iter().map(|d| ("drawn", d.value));
        for (how, value) in drawn.chain([("computed", r.computed)]) {
            let got = numbers(value).map(|x| if text == "pressure_3" { x.abs() } else { x });
            if (0..2).any(|k| (got[k] - exact[k]).abs() > tolerance) {
                out.push(format!("{text} {how}: {got:?}, by brute force {exact:?}"));
            }
        }
        if r.agreement.is_some_and(|a| !a.holds()) {
            out.push(format!("{text}: drawing and analysis disagree"));
        }
        if r.drawn.is_none() && !text.starts_with(['x', 'y', 'p']) {
            out.push(format!("{text} is not drawn"));
        }
    }
    if !out.is_empty() {
        out.push(text);
    }
    out
}

/// True if a joint of the profile is so near that differences reach across it: the acceleration
/// jumps there.
fn near_a_joint(s: &Setting) -> bool {
    let jerk = |t: f64| {
        let f = |k: f64| follower(s, t + k * H);
        let second =
            |g: &dyn Fn(&Follower) -> f64| (g(&f(-1.0)) - 2.0 * g(&f(0.0)) + g(&f(1.0))) / (H * H);
        [second(&|f| f.point.x), second(&|f| f.point.y)]
    };
    let at: Vec<[f64; 2]> = [-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0].map(|k| jerk(k * H)).into();
    (0..2).any(|i| at.windows(3).any(|w| ((w[2][i] - w[1][i]) - (w[1][i] - w[0][i])).abs() > 2e-3))
}

#[test]
fn every_follower_under_every_cam_on_every_link() {
    let mut all = Vec::new();
    let (mut tried, mut passed, mut poses) = (0, 0, 0);
    for seat in Seat::ALL {
        for profile in Profile::ALL {
            for swings in [false, true] {
                for end in [End::Round(0.0), End::Round(9e-3), End::Round(25e-3), End::Flat] {
                    if end == End::Flat && profile == Profile::Tangent
                        || profile == Profile::Law && !seat.has_one_carrier()
                    {
                        continue;
                    }
                    for by_lengths in [false, true] {
                        // A profile of one circle, and pairs on one carrier, need no coordinates in
                        // any case.
                        if by_lengths && (seat.has_one_carrier() || profile == Profile::Circle) {
                            continue;
                        }
                        let mut faulty = Vec::new();
                        let mut here = 0;
                        for k in 0..9 {
                            let s = Setting {
                                seat,
                                profile,
                                swings,
                                end,
                                angle: 0.21 + 0.7 * f64::from(k),
                                by_lengths,
                            };
                            if near_a_joint(&s) || !follower(&s, 0.0).held.at.is_finite() {
                                continue;
                            }
                            if here == 9 / every(9) {
                                break;
                            }
                            here += 1;
                            let found = faults(&s);
                            if !found.is_empty() {
                                faulty.push(format!(
                                    "{seat:?} {profile:?} {} {end:?} at {:.2}:\n  {}",
                                    if swings { "swings" } else { "slides" },
                                    s.angle,
                                    found.join("\n  ")
                                ));
                            }
                        }
                        poses += here;
                        assert!(
                            here >= 1,
                            "{seat:?} {profile:?} {swings} {end:?}: only {here} poses are clear of joints"
                        );
                        tried += 1;
                        passed += usize::from(faulty.is_empty());
                        all.extend(faulty.into_iter().take(1));
                    }
                }
            }
        }
    }
    assert_eq!(tried, 198);
    assert!(poses > 900 / every(9), "{poses}");
    assert!(all.is_empty(), "{passed} of {tried} combinations pass:\n{}", all.join("\n\n"));
}
