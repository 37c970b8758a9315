//! Random mechanisms that begin with a cam, gears or a rolling wheel and continue with dyads, given
//! by lengths, teeth and angles as in a book: each dyad is attached at places of the mechanism so
//! far.

use crate::rng::Rng;
use hodograph::geom::Point;
use hodograph::scene::{self, Scene};
use hodograph::worked::{Scope, work};

/// A scene that grows.
#[derive(Clone, Default)]
struct Growing {
    links: Vec<(String, Vec<String>)>,
    points: Vec<String>,
    lengths: Vec<String>,
    sides: Vec<String>,
    guides: Vec<String>,
    /// Sections of the beginning only.
    sections: String,
    drivers: String,
    /// Points that move, to which a dyad can be attached.
    movers: Vec<String>,
    turning: Vec<String>,
    named: usize,
}

/// A length as a person writes it, in whole tenths of a millimetre.
fn mm(x: f64) -> String {
    format!("{:.1} mm", x)
}

fn degrees(rng: &mut Rng) -> String {
    format!("{:.1} deg", rng.between(0.0, 360.0))
}

impl Growing {
    fn link(&mut self, name: &str, points: &[&str]) {
        self.links.push((name.into(), points.iter().map(|p| (*p).to_owned()).collect()));
    }

    fn ground(&mut self, point: &str, at: [f64; 2]) {
        self.links[0].1.push(point.into());
        self.points.push(format!("\"{point}\": [\"{}\", \"{}\"]", mm(at[0]), mm(at[1])));
    }

    fn fresh(&mut self) -> String {
        self.named += 1;
        format!("J{}", self.named)
    }

    fn text(&self, find: &[String]) -> String {
        let links: Vec<String> = self
            .links
            .iter()
            .map(|(l, p)| {
                format!(
                    "\"{l}\": [{}]",
                    p.iter().map(|p| format!("\"{p}\"")).collect::<Vec<_>>().join(", ")
                )
            })
            .collect();
        let find: Vec<String> = find.iter().map(|f| format!("\"{f}\"")).collect();
        format!(
            "{{\"links\": {{{}}}, \"ground\": \"1\",\n\"points\": {{{}}},\n\"lengths\": {{{}}}, \"side\": {{{}}},\n\"guides\": [{}],\n{}\n\"driver\": {}, \"find\": [{}]}}",
            links.join(", "),
            self.points.join(", "),
            self.lengths.join(", "),
            self.sides.join(", "),
            self.guides.join(", "),
            self.sections,
            self.drivers,
            find.join(", ")
        )
    }

    /// The places of its moving points (mm).
    fn places(&self) -> Option<Vec<Point>> {
        let find: Vec<String> =
            self.movers.iter().flat_map(|p| [format!("x_{p}"), format!("y_{p}")]).collect();
        let scene = match scene::read(self.text(&find)) {
            Ok(scene) => scene.value,
            Err(f) if f.list.iter().any(|d| d.code == "no-contact") => return None,
            Err(f) => panic!("{f}\n{}", self.text(&find)),
        };
        let worked = work(&scene, Scope::Questions).ok()?.value;
        let at = |p: &String| {
            let id = scene.points.iter().position(|q| q.name == *p)?;
            worked.configuration.points[id].map(|at| Point::new(at.x * 1e3, at.y * 1e3))
        };
        self.movers.iter().map(at).collect()
    }

    /// Attaches a rod and a rocker, or a rod and a slider, to one of its points; `None` if the
    /// mechanism so far does not close.
    fn dyad(&mut self, rng: &mut Rng) -> Option<()> {
        let places = self.places()?;
        let k = rng.below(places.len());
        let (from, at) = (self.movers[k].clone(), places[k]);
        let (joint, number) = (self.fresh(), 10 + 2 * self.named);
        let along = rng.direction();
        let rod = rng.between(60.0, 140.0);
        let there = at + along * rod;
        let (rod_name, last) = (number.to_string(), (number + 1).to_string());
        self.link(&rod_name, &[&from, &joint]);
        self.lengths.push(format!("\"{from},{joint}\": \"{}\"", mm(rod)));
        let across = along.rotate_by(hodograph::geom::Vec2::from_angle(rng.between(1.0, 2.1)));
        if rng.chance(0.6) {
            let reach = rng.between(50.0, 120.0);
            let pivot = self.fresh();
            let foot = there + across * reach;
            self.ground(&pivot, [foot.x, foot.y]);
            self.link(&last, &[&joint, &pivot]);
            self.lengths.push(format!("\"{joint},{pivot}\": \"{}\"", mm(reach)));
            let left = (foot - at).cross(there - at) > 0.0;
            self.sides.push(format!(
                "\"{joint}\": \"{} of {from},{pivot}\"",
                if left { "left" } else { "right" }
            ));
            self.turning.push(last);
        } else {
            // The slider's path crosses the rod at no small angle; a rough place selects one of the
            // two intersections.
            let angle = (along.angle() + rng.between(-0.6, 0.6)).to_degrees();
            self.guides.push(format!(
                "{{\"pin\": \"{joint}\", \"slider\": \"{last}\", \"on\": \"1\", \"through\": [\"{}\", \"{}\"], \"angle\": \"{angle:.1} deg\"}}",
                mm(there.x),
                mm(there.y)
            ));
            let rough = format!("\"{joint}\": [\"{}\", \"{}\"]", mm(there.x), mm(there.y));
            self.sections = match self.sections.strip_prefix("\"sketch\": {") {
                Some(rest) => format!("\"sketch\": {{{rough}, {rest}"),
                None => format!("\"sketch\": {{{rough}}}, {}", self.sections),
            };
        }
        self.turning.push(rod_name);
        self.movers.push(joint);
        Some(())
    }
}

fn rates(rng: &mut Rng) -> String {
    format!(
        "\"omega\": \"{:.2} rad/s\", \"alpha\": \"{:.2} rad/s^2\"",
        rng.between(1.0, 6.0),
        rng.between(-9.0, 9.0)
    )
}

const LAWS: [&str; 6] = ["harmonic", "cycloidal", "3-4-5", "4-5-6-7", "modified-sine", "parabolic"];

/// A cam on the ground, its follower sliding or swinging, of any kind.
fn cam(rng: &mut Rng) -> Growing {
    let mut g = Growing::default();
    g.link("1", &[]);
    g.ground("O", [0.0, 0.0]);
    g.link("2", &["O", "Q"]);
    g.drivers = format!("{{\"link\": \"2\", \"angle\": \"{}\", {}}}", degrees(rng), rates(rng));
    let swings = rng.chance(0.5);
    let base = rng.between(25.0, 40.0);
    let nose = rng.between(0.3, 0.6) * base;
    // The nose projects beyond the circle about the axis.
    let far = base - nose + rng.between(4.0, 15.0);
    g.lengths.push(format!("\"OQ\": \"{}\"", mm(far)));
    let kind = rng.below(4);
    let end = match rng.below(4) {
        // A flat face has no contact with a tangent.
        3 if kind == 2 => 1,
        end => end,
    };
    if swings {
        let (d, aside) = (rng.between(95.0, 130.0), rng.between(-15.0, 15.0));
        g.ground("P", [d, aside]);
        g.link("3", &["P", "B"]);
        let arm = rng.between(0.75, 0.95) * d.hypot(aside);
        g.lengths.push(format!("\"PB\": \"{}\"", mm(arm)));
        if end != 3 {
            g.sides.push("\"B\": \"right of PO\"".into());
        }
        g.turning.push("3".into());
    } else {
        let e = rng.between(-8.0, 8.0);
        g.link("3", &["B"]);
        g.guides.push(format!(
            "{{\"pin\": \"B\", \"slider\": \"3\", \"on\": \"1\", \"through\": [\"{}\", \"{}\"], \"angle\": \"{:.1} deg\"}}",
            mm(e),
            mm(rng.between(-3.0, 3.0)),
            rng.between(75.0, 105.0)
        ));
    }
    let touch = match (end, swings) {
        (0, _) => "\"edge\": \"B\"".to_owned(),
        (1, _) => format!(
            "\"roller\": {{\"pin\": \"B\", \"radius\": \"{}\"}}",
            mm(rng.between(5.0, 12.0))
        ),
        (2, _) => {
            format!("\"arc\": {{\"pin\": \"B\", \"radius\": \"{}\"}}", mm(rng.between(15.0, 40.0)))
        }
        (_, false) => "\"face\": {}".to_owned(),
        (_, true) => {
            "\"face\": {\"through\": \"P\", \"line\": \"PB\", \"cam\": \"left\"}".to_owned()
        }
    };
    let profile = match kind {
        0 => format!("{{\"centre\": \"Q\", \"radius\": \"{}\"}}", mm(base)),
        1 => {
            let flank = far + base + rng.between(20.0, 60.0);
            format!(
                "[{{\"centre\": \"O\", \"radius\": \"{}\"}}, {{\"radius\": \"{}\"}}, {{\"centre\": \"Q\", \"radius\": \"{}\"}}, {{\"radius\": \"{}\"}}]",
                mm(base),
                mm(flank),
                mm(nose),
                mm(flank + rng.between(-10.0, 10.0))
            )
        }
        2 => format!(
            "[{{\"centre\": \"O\", \"radius\": \"{}\"}}, \"tangent\", {{\"centre\": \"Q\", \"radius\": \"{}\"}}, \"tangent\"]",
            mm(base),
            mm(nose)
        ),
        _ => {
            let lift = if swings {
                format!("{:.1} deg", rng.between(5.0, 14.0))
            } else {
                mm(rng.between(5.0, 15.0))
            };
            let over = (rng.between(90.0, 130.0).round(), rng.between(90.0, 130.0).round());
            format!(
                "{{\"base\": \"{}\", \"law\": [{{\"rise\": \"{lift}\", \"over\": \"{} deg\", \"law\": \"{}\"}}, {{\"dwell\": \"40 deg\"}}, {{\"return\": \"{lift}\", \"over\": \"{} deg\", \"law\": \"{}\"}}, {{\"dwell\": \"{} deg\"}}]}}",
                mm(base),
                over.0,
                rng.pick(&LAWS),
                over.1,
                rng.pick(&LAWS),
                320.0 - over.0 - over.1
            )
        }
    };
    g.sections = format!(
        "\"cams\": [{{\"cam\": \"2\", \"follower\": \"3\", {touch}, \"profile\": {profile}}}],"
    );
    g.movers.push("B".into());
    g
}

/// Gears on fixed axes, a planet on a driven arm, a rack, or a wheel on a straight or round track.
fn geared(rng: &mut Rng) -> Growing {
    let mut g = Growing::default();
    g.link("1", &[]);
    g.ground("O", [0.0, 0.0]);
    let teeth = |rng: &mut Rng| 17 + rng.below(40);
    let (z1, z2) = (teeth(rng), teeth(rng));
    g.drivers = format!("{{\"link\": \"2\", \"angle\": \"{}\", {}}}", degrees(rng), rates(rng));
    let pin = rng.between(15.0, 35.0);
    let phase = degrees(rng);
    match rng.below(5) {
        0 => {
            g.ground("Q", [rng.between(70.0, 110.0), rng.between(-20.0, 20.0)]);
            g.link("2", &["O", "A"]);
            g.link("3", &["Q", "C"]);
            g.lengths.extend([
                format!("\"OA\": \"{}\"", mm(pin)),
                format!("\"QC\": \"{}\"", mm(rng.between(15.0, 35.0))),
            ]);
            g.sections = format!(
                "\"gears\": [{{\"links\": [\"2\", \"3\"], \"centres\": [\"O\", \"Q\"], \"teeth\": [{z1}, {z2}], \"phase\": \"{phase}\", \"at\": \"K\"}}],"
            );
            g.movers.extend(["A".into(), "C".into()]);
            g.turning.push("3".into());
        }
        ring @ (1 | 2) => {
            // A planet on a fixed sun, or in a fixed ring.
            let (small, large) = (z1.min(z2), z1.max(z2) + 20);
            g.link("2", &["O", "C"]);
            g.link("3", &["C", "E"]);
            let module = rng.between(1.0, 2.0);
            g.lengths.push(format!("\"CE\": \"{}\"", mm(pin)));
            let hollow = if ring == 2 { ", \"ring\": \"1\"" } else { "" };
            g.sections = format!(
                "\"gears\": [{{\"links\": [\"1\", \"3\"], \"centres\": [\"O\", \"C\"], \"teeth\": [{large}, {small}], \"module\": \"{module:.2} mm\", \"phase\": \"{phase}\", \"at\": \"K\"{hollow}}}],"
            );
            g.movers.extend(["C".into(), "E".into()]);
            g.turning.push("3".into());
        }
        3 => {
            // A driven pinion on a rack that slides.
            g.link("2", &["O", "A"]);
            g.link("3", &["B"]);
            g.lengths.push(format!("\"OA\": \"{}\"", mm(pin)));
            let radius = rng.between(20.0, 40.0);
            g.guides.push(format!(
                "{{\"pin\": \"B\", \"slider\": \"3\", \"on\": \"1\", \"through\": [\"{}\", \"{}\"], \"angle\": \"0 deg\"}}",
                mm(0.0),
                mm(-radius)
            ));
            g.points.push(format!(
                "\"B\": [\"{}\", \"{}\"]",
                mm(rng.between(-50.0, 50.0)),
                mm(-radius)
            ));
            g.sections = format!(
                "\"gears\": [{{\"links\": [\"2\", \"3\"], \"centres\": [\"O\"], \"radii\": [\"{}\"], \"rack\": \"3\", \"angle\": \"0 deg\", \"at\": \"K\"}}],",
                mm(radius)
            );
            g.movers.extend(["A".into(), "B".into()]);
        }
        _ => {
            // A crank and a rod that draw a wheel along a line.
            g.link("2", &["O", "A"]);
            g.link("3", &["A", "C"]);
            g.link("4", &["C"]);
            let (rod, radius) = (rng.between(90.0, 130.0), rng.between(15.0, 40.0));
            g.lengths
                .extend([format!("\"OA\": \"{}\"", mm(pin)), format!("\"AC\": \"{}\"", mm(rod))]);
            let low = rng.between(-40.0, 10.0);
            g.sections = format!(
                "\"sketch\": {{\"C\": [\"{}\", \"{}\"]}}, \"rolling\": [{{\"wheel\": \"4\", \"centre\": \"C\", \"radius\": \"{}\", \"on\": \"1\", \"through\": [\"0 mm\", \"{}\"], \"angle\": \"0 deg\", \"at\": \"N\"}}],",
                mm(rod),
                mm(low + radius),
                mm(radius),
                mm(low)
            );
            g.movers.extend(["A".into(), "C".into()]);
            g.turning.extend(["3".into(), "4".into()]);
        }
    }
    g
}

/// A grown mechanism as a text, with all its motions asked for; `None` if it does not close.
pub fn text(seed: u64) -> Option<String> {
    let mut rng = Rng::new(seed.wrapping_mul(2) + 77);
    let mut g = if seed.is_multiple_of(2) { cam(&mut rng) } else { geared(&mut rng) };
    for _ in 0..rng.below(3) {
        g.dyad(&mut rng)?;
    }
    let rates = |p: &String| [format!("v_{p}"), format!("a_{p}")];
    let mut find: Vec<String> = g.movers.iter().flat_map(rates).collect();
    find.extend(g.turning.iter().flat_map(|l| [format!("omega_{l}"), format!("alpha_{l}")]));
    Some(g.text(&find))
}

/// The grown mechanism, read; `None` also if its cam does not reach its follower.
pub fn scene(seed: u64) -> Option<(String, Scene)> {
    let text = text(seed)?;
    match scene::read(&text) {
        Ok(scene) => Some((text, scene.value)),
        Err(f) => {
            assert!(
                f.list
                    .iter()
                    .all(|d| d.code == "no-contact"
                        || d.severity != hodograph::diag::Severity::Error),
                "seed {seed}: {f}\n{text}"
            );
            None
        }
    }
}
