//! The mechanisms of the combinations: the places of cam and follower, as numbers over time and as
//! the text of a scene.

use super::Follower;
use super::envelope::{End, Held, Piece, Way};
use hodograph::geom::Vec2;

/// The carriers of cam 2 and follower 3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Seat {
    /// Both on the ground.
    Ground,
    /// Both on arm 4, which turns about G.
    Arm,
    /// The cam is the ground; arm 4 turns about it and carries the follower.
    Still,
    /// The cam on arm 4, the follower on the ground.
    CamOnArm,
    /// The cam on the ground, the follower on arm 4.
    FollowerOnArm,
    /// The cam on arm 4, the follower on arm 5.
    TwoArms,
}

impl Seat {
    pub const ALL: [Seat; 6] =
        [Seat::Ground, Seat::Arm, Seat::Still, Seat::CamOnArm, Seat::FollowerOnArm, Seat::TwoArms];

    pub fn has_one_carrier(self) -> bool {
        matches!(self, Seat::Ground | Seat::Arm | Seat::Still)
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Profile {
    Circle,
    Arcs,
    Tangent,
    Law,
}

impl Profile {
    pub const ALL: [Profile; 4] = [Profile::Circle, Profile::Arcs, Profile::Tangent, Profile::Law];
}

/// One combination in one pose.
#[derive(Clone, Copy, Debug)]
pub struct Setting {
    pub seat: Seat,
    pub profile: Profile,
    pub swings: bool,
    pub end: End,
    /// The angle of the cam in its carrier (rad).
    pub angle: f64,
    /// True if lengths and angles of drivers give the places of cam and follower on different
    /// links; else coordinates do.
    pub by_lengths: bool,
}

/// Angular velocity and acceleration of the cam in its carrier, of arm 4 and of arm 5.
const CAM: [f64; 2] = [3.0, -2.0];
const ARM: [f64; 3] = [0.4, 1.7, 0.6];
const OTHER: [f64; 3] = [-0.3, -1.1, 0.9];
/// Pivots of arms 4 and 5 on the ground (m), and the lengths of the arms.
const G: Vec2 = Vec2::new(-0.08, -0.03);
const K: Vec2 = Vec2::new(0.12, -0.05);
const LONG: f64 = 0.2;
/// Direction of the guide in its carrier (rad), and the arm of a swinging follower (m).
const RISE: f64 = 1.4;
const REACH: f64 = 0.075;

fn turned([angle, w, a]: [f64; 3], t: f64) -> f64 {
    angle + w * t + 0.5 * a * t * t
}

/// A carrier link: origin, angle, angular velocity and acceleration.
#[derive(Clone, Copy)]
struct Frame {
    origin: Vec2,
    angle: f64,
}

impl Frame {
    fn to_plane(self, v: Vec2) -> Vec2 {
        self.origin + v.rotate_by(Vec2::from_angle(self.angle))
    }
}

impl Setting {
    fn frame_of_cam(&self, t: f64) -> Frame {
        match self.seat {
            Seat::Ground | Seat::Still | Seat::FollowerOnArm => {
                Frame { origin: Vec2::ZERO, angle: 0.0 }
            }
            Seat::Arm | Seat::CamOnArm | Seat::TwoArms => {
                Frame { origin: G, angle: turned(ARM, t) }
            }
        }
    }

    fn frame_of_follower(&self, t: f64) -> Frame {
        match self.seat {
            Seat::Ground | Seat::CamOnArm => Frame { origin: Vec2::ZERO, angle: 0.0 },
            Seat::Arm | Seat::FollowerOnArm => Frame { origin: G, angle: turned(ARM, t) },
            // In its carrier, the cam turns against the carrier's own sense.
            Seat::Still => Frame { origin: Vec2::ZERO, angle: -self.cam_angle(t) },
            Seat::TwoArms => Frame { origin: K, angle: turned(OTHER, t) },
        }
    }

    fn cam_angle(&self, t: f64) -> f64 {
        turned([self.angle, CAM[0], CAM[1]], t)
    }

    /// The place of the cam's pivot in its carrier.
    fn pivot_of_cam(&self) -> Vec2 {
        match self.seat {
            Seat::Ground | Seat::Still | Seat::FollowerOnArm => Vec2::ZERO,
            Seat::Arm | Seat::CamOnArm | Seat::TwoArms => Vec2::new(0.09, 0.02),
        }
    }

    /// The place in the carrier of the guide, or of the follower's pivot: beside the cam at the
    /// instant.
    fn seat_of_follower(&self) -> Vec2 {
        let beside = if self.swings { Vec2::new(0.095, 0.010) } else { Vec2::new(0.006, 0.003) };
        if self.seat.has_one_carrier() {
            return self.pivot_of_cam() + beside;
        }
        let (frame, cam) = (self.frame_of_follower(0.0), self.cam(0.0).0);
        let at = (cam + beside - frame.origin).rotate_by(Vec2::from_angle(-frame.angle));
        // Rounded as a person would write it.
        Vec2::new((at.x * 1e4).round() / 1e4, (at.y * 1e4).round() / 1e4)
    }

    /// Origin and angle of the cam in the plane.
    pub fn cam(&self, t: f64) -> (Vec2, f64) {
        let frame = self.frame_of_cam(t);
        let angle = if self.seat == Seat::Still { 0.0 } else { frame.angle + self.cam_angle(t) };
        (frame.to_plane(self.pivot_of_cam()), angle)
    }

    /// The velocity of the cam's point at a place of the plane.
    pub fn cam_velocity(&self, at: Vec2) -> Vec2 {
        let (o, _) = self.cam(0.0);
        let w4 = if matches!(self.seat, Seat::Arm | Seat::CamOnArm | Seat::TwoArms) {
            ARM[1]
        } else {
            0.0
        };
        let w2 = if self.seat == Seat::Still { 0.0 } else { w4 + CAM[0] };
        let origin = self.frame_of_cam(0.0).origin;
        (o - origin).perp() * w4 + (at - o).perp() * w2
    }

    /// Angular velocity and acceleration of the link that carries the follower.
    pub fn frame_rate(&self) -> (f64, f64) {
        match self.seat {
            Seat::Ground | Seat::CamOnArm => (0.0, 0.0),
            Seat::Arm | Seat::FollowerOnArm => (ARM[1], ARM[2]),
            Seat::Still => (-CAM[0], -CAM[1]),
            Seat::TwoArms => (OTHER[1], OTHER[2]),
        }
    }

    pub fn way(&self, t: f64) -> Way {
        let frame = self.frame_of_follower(t);
        let at = frame.to_plane(self.seat_of_follower());
        match self.swings {
            false => Way::Along { through: at, direction: Vec2::from_angle(frame.angle + RISE) },
            true => Way::About { pivot: at, arm: REACH },
        }
    }

    /// The profile in the frame of the cam.
    pub fn pieces(&self) -> Vec<Piece> {
        use std::f64::consts::TAU;
        let q = Vec2::new(0.035, 0.0);
        match self.profile {
            Profile::Circle => {
                vec![Piece::Arc { centre: Vec2::new(0.012, 0.0), radius: 0.03, from: 0.0, to: TAU }]
            }
            Profile::Tangent => {
                let lean = ((0.030_f64 - 0.014) / 0.035).acos();
                let n = [Vec2::from_angle(lean), Vec2::from_angle(-lean)];
                vec![
                    Piece::Arc { centre: Vec2::ZERO, radius: 0.030, from: lean, to: TAU - lean },
                    Piece::Line { from: n[1] * 0.030, to: q + n[1] * 0.014 },
                    Piece::Arc { centre: q, radius: 0.014, from: -lean, to: lean },
                    Piece::Line { from: q + n[0] * 0.014, to: n[0] * 0.030 },
                ]
            }
            Profile::Arcs => {
                // Flanks of 70 and 75 mm touch circles of 30 mm about the origin and of 4 mm about
                // Q, below and above.
                let flank = |radius: f64, above: f64| {
                    let (a, b, d) = (radius - 0.030, radius - 0.004, 0.035);
                    let x = (a * a - b * b + d * d) / (2.0 * d);
                    let centre = Vec2::new(x, -above * (a * a - x * x).sqrt());
                    let angles = [(-centre).angle(), (q - centre).angle()];
                    (Piece::Arc { centre, radius, from: angles[0], to: angles[1] }, angles)
                };
                let ((low, below), (high, above)) = (flank(0.070, -1.0), flank(0.075, 1.0));
                vec![
                    low,
                    high,
                    Piece::Arc {
                        centre: Vec2::ZERO,
                        radius: 0.030,
                        from: above[0],
                        to: below[0] + TAU,
                    },
                    Piece::Arc { centre: q, radius: 0.004, from: below[1], to: above[1] },
                ]
            }
            Profile::Law => Vec::new(),
        }
    }

    /// The follower moved by a law, in its carrier; the contact by differences of the relative
    /// motion.
    pub fn by_law(&self, t: f64) -> Held {
        let lift = |phi: f64| {
            Law.lift(phi.rem_euclid(std::f64::consts::TAU))
                * if self.swings { 17.0_f64.to_radians() } else { 0.018 }
        };
        let o = self.pivot_of_cam();
        let seat = self.seat_of_follower();
        let end = match self.end {
            End::Round(r) => Some(r),
            End::Flat => None,
        };
        let base = 0.040;
        // The follower's coordinate, its end, and the outward normal of a face, in the carrier.
        let at = |phi: f64| -> (f64, Vec2, Vec2) {
            if self.swings {
                let d = (seat - o).norm();
                let rest = match end {
                    Some(r) => {
                        ((d * d + REACH * REACH - (base + r).powi(2)) / (2.0 * d * REACH)).acos()
                    }
                    None => (base / d).asin(),
                };
                let psi = (o - seat).angle() - rest - lift(phi);
                let u = Vec2::from_angle(psi);
                (psi, seat + u * REACH, -u.perp())
            } else {
                let u = Vec2::from_angle(RISE);
                let e = (o - seat).dot(u.perp());
                let rest = end.map_or(base, |r| ((base + r).powi(2) - e * e).sqrt());
                let q = (o - seat).dot(u) + rest + lift(phi);
                (q, seat + u * q, u)
            }
        };
        let phi = self.cam_angle(t);
        let in_cam = |phi: f64, v: Vec2| (v - o).rotate_by(Vec2::from_angle(-phi));
        let (q, end_at, _) = at(phi);
        let step = 1e-5;
        let contact = match end {
            Some(r) => {
                // Perpendicular to the path of the end in the cam, inward.
                let way =
                    in_cam(phi + step, at(phi + step).1) - in_cam(phi - step, at(phi - step).1);
                let n = way.unit().unwrap().perp();
                let b = in_cam(phi, end_at);
                b - n * r * n.dot(b).signum()
            }
            None => {
                // The intersection of the face with itself one step on.
                let line = |phi: f64| {
                    let (_, p, n) = at(phi);
                    let n = n.rotate_by(Vec2::from_angle(-phi));
                    (n, n.dot(in_cam(phi, p)))
                };
                let ((n, _), (a, da), (b, db)) = (line(phi), line(phi - step), line(phi + step));
                let d = line(phi).1;
                let turned = (b - a).dot(n.perp()) / (2.0 * step);
                n * d + n.perp() * ((db - da) / (2.0 * step) / turned)
            }
        };
        let turn = if self.swings { self.frame_of_follower(t).angle } else { 0.0 };
        let (origin, angle) = self.cam(t);
        Held { at: q + turn, contact: origin + contact.rotate_by(Vec2::from_angle(angle)) }
    }

    pub fn point_name(&self) -> &'static str {
        if self.swings && self.end == End::Flat { "W" } else { "B" }
    }

    /// The scene in the pose at the instant.
    pub fn text(&self, find: &str, now: &Follower) -> String {
        let posed =
            !self.seat.has_one_carrier() && self.profile != Profile::Circle && !self.by_lengths;
        let (p, t) = (self.point_name(), if self.swings { "P" } else { "T" });
        let (cam, of_cam, of_follower) = match self.seat {
            Seat::Ground => ("2", "1", "1"),
            Seat::Arm => ("2", "4", "4"),
            Seat::Still => ("1", "4", "4"),
            Seat::CamOnArm => ("2", "4", "1"),
            Seat::FollowerOnArm => ("2", "1", "4"),
            Seat::TwoArms => ("2", "4", "5"),
        };
        let mut links: Vec<(&str, Vec<&str>)> = vec![("1", vec![])];
        let mut points: Vec<String> = Vec::new();
        let mut lengths: Vec<String> = Vec::new();
        let place = |name: &str, v: Vec2| format!("\"{name}\": [\"{:?} m\", \"{:?} m\"]", v.x, v.y);
        let local = |name: &str, base: &str, v: Vec2| {
            format!(
                "\"{name}\": {{\"base\": \"{base}\", \"x\": \"{:?} m\", \"y\": \"{:?} m\"}}",
                v.x, v.y
            )
        };
        // Arms.
        for (link, pivot, at, tip, arm) in [("4", "G", G, "H", ARM), ("5", "K", K, "L", OTHER)] {
            let used = self.seat != Seat::Still && [of_cam, of_follower].contains(&link);
            if used {
                links[0].1.push(pivot);
                links.push((link, vec![pivot, tip]));
                points.push(place(pivot, at));
                match posed {
                    true => points.push(place(tip, at + Vec2::from_angle(arm[0]) * LONG)),
                    false => lengths.push(format!("\"{pivot}{tip}\": \"{LONG:?} m\"")),
                }
            }
        }
        if self.seat == Seat::Still {
            links.push(("4", vec!["O", "H"]));
            lengths.push(format!("\"OH\": \"{LONG:?} m\""));
        }
        let base = |link: &str| match (self.seat, link) {
            (Seat::Still, _) => "OH",
            (_, "5") => "KL",
            _ => "GH",
        };
        let (o, turn) = self.cam(0.0);
        let seat_in_plane = self.frame_of_follower(0.0).to_plane(self.seat_of_follower());
        if self.seat == Seat::Still {
            points.push(place("O", Vec2::ZERO));
            links[0].1.push("O");
        } else {
            links.iter_mut().find(|(l, _)| *l == of_cam).unwrap().1.push("O");
            points.push(match of_cam {
                "1" => place("O", self.pivot_of_cam()),
                _ if posed => place("O", o),
                _ => local("O", base(of_cam), self.pivot_of_cam()),
            });
        }
        let name: &'static str = t;
        let mine = links.iter_mut().find(|(l, _)| *l == of_follower).unwrap();
        mine.1.push(name);
        points.push(match of_follower {
            "1" => place(name, self.seat_of_follower()),
            _ if posed => place(name, seat_in_plane),
            _ => local(name, base(of_follower), self.seat_of_follower()),
        });
        // The cam.
        let centre = if self.profile == Profile::Circle {
            Vec2::new(0.012, 0.0)
        } else {
            Vec2::new(0.035, 0.0)
        };
        if self.seat == Seat::Still {
            links[0].1.push("Q");
            points.push(place("Q", centre));
        } else {
            links.push(("2", vec!["O", "Q"]));
            if posed {
                points.push(place("Q", o + centre.rotate_by(Vec2::from_angle(turn))));
            }
            lengths.push(format!("\"OQ\": \"{:?} m\"", centre.x));
        }
        // The follower.
        if self.swings {
            links.push(("3", vec!["P", p]));
            match posed {
                true => points.push(place(p, now.point)),
                false => lengths.push(format!("\"P{p}\": \"{REACH:?} m\"")),
            }
        } else {
            links.push(("3", vec!["B"]));
            if posed && self.end != End::Flat {
                points.push(place("B", now.point));
            }
        }
        let guide = match of_follower {
            _ if self.swings => String::new(),
            "1" => format!(
                r#""guides": [{{"pin": "B", "slider": "3", "on": "1", "through": "T", "angle": "{RISE:?} rad"}}],"#
            ),
            link => format!(
                r#""guides": [{{"pin": "B", "slider": "3", "on": "{link}", "through": "T", "line": "{}", "angle": "{RISE:?} rad"}}],"#,
                base(link)
            ),
        };
        let end = match (self.end, self.swings) {
            (End::Round(0.0), _) => r#""edge": "B""#.to_owned(),
            (End::Round(r), _) if r < 0.02 => {
                format!(r#""roller": {{"pin": "B", "radius": "{r:?} m"}}"#)
            }
            (End::Round(r), _) => format!(r#""arc": {{"pin": "B", "radius": "{r:?} m"}}"#),
            (End::Flat, false) => r#""face": {}"#.to_owned(),
            (End::Flat, true) => {
                r#""face": {"through": "P", "line": "PW", "cam": "left"}"#.to_owned()
            }
        };
        let profile = match self.profile {
            Profile::Circle => r#"{"centre": "Q", "radius": "30 mm"}"#.to_owned(),
            Profile::Arcs => {
                r#"[{"centre": "O", "radius": "30 mm"}, {"radius": "70 mm"}, {"centre": "Q", "radius": "4 mm"}, {"radius": "75 mm"}]"#
                    .to_owned()
            }
            Profile::Tangent => {
                r#"[{"centre": "O", "radius": "30 mm"}, "tangent", {"centre": "Q", "radius": "14 mm"}, "tangent"]"#.to_owned()
            }
            Profile::Law => format!(
                r#"{{"base": "40 mm", "law": [{{"rise": "{0}", "over": "130 deg", "law": "3-4-5"}}, {{"dwell": "50 deg"}},
                {{"return": "{0}", "over": "120 deg", "law": "cycloidal"}}, {{"dwell": "60 deg"}}]}}"#,
                if self.swings { "17 deg" } else { "18 mm" }
            ),
        };
        let driver = |link: &str, against: &str, [angle, w, a]: [f64; 3]| {
            let angle =
                if posed { String::new() } else { format!(r#""angle": "{angle:?} rad", "#) };
            format!(
                r#"{{"link": "{link}", "against": "{against}", {angle}"omega": "{w:?} rad/s", "alpha": "{a:?} rad/s^2"}}"#
            )
        };
        let cam_driver = [self.angle, CAM[0], CAM[1]];
        let mut drivers = Vec::new();
        match self.seat {
            Seat::Still => drivers.push(driver("4", "1", cam_driver.map(|x| -x))),
            _ => {
                drivers.push(driver("2", of_cam, cam_driver));
                for (link, arm) in [("4", ARM), ("5", OTHER)] {
                    if [of_cam, of_follower].contains(&link) {
                        drivers.push(driver(link, "1", arm));
                    }
                }
            }
        }
        let quoted = |names: &[&str]| {
            names.iter().map(|n| format!("\"{n}\"")).collect::<Vec<_>>().join(", ")
        };
        let links: Vec<String> =
            links.iter().map(|(l, p)| format!("\"{l}\": [{}]", quoted(p))).collect();
        let side = if self.swings && !posed && self.end != End::Flat {
            r#""side": {"B": "right of PO"},"#
        } else {
            ""
        };
        let sketch = if self.swings && !posed && !self.by_lengths {
            format!(r#""sketch": {{"{p}": ["{:?} m", "{:?} m"]}},"#, now.point.x, now.point.y)
        } else {
            String::new()
        };
        format!(
            "{{\"links\": {{{}}}, \"ground\": \"1\", \"points\": {{{}}}, \"lengths\": {{{}}}, {guide} {side} {sketch}\n\"cams\": [{{\"cam\": \"{cam}\", \"follower\": \"3\", {end}, \"profile\": {profile}, \"at\": \"E\"}}],\n\"driver\": [{}], \"find\": [{find}]}}",
            links.join(", "),
            points.join(", "),
            lengths.join(", "),
            drivers.join(", "),
        )
    }
}

/// Rise by the 3-4-5 polynomial over 130°, dwell 50°, cycloidal return over 120°, dwell; the stroke
/// is one.
struct Law;

impl Law {
    fn lift(&self, phi: f64) -> f64 {
        use std::f64::consts::TAU;
        let degrees = phi.to_degrees();
        match degrees {
            d if d < 130.0 => {
                let x = d / 130.0;
                x * x * x * (10.0 - 15.0 * x + 6.0 * x * x)
            }
            d if d < 180.0 => 1.0,
            d if d < 300.0 => {
                let x = (d - 180.0) / 120.0;
                1.0 - (x - (TAU * x).sin() / TAU)
            }
            _ => 0.0,
        }
    }
}
