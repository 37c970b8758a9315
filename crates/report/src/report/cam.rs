//! A cam over a whole turn, for people and programs: stages, strokes, extremes, shocks, pressure angle, curvature, and what does not work.

use crate::cam::{Disc, Fault, Follower, Jump, Law, Motion, Shock, Side, Station, Survey, Touch, Way, in_turn, round};
use crate::diag::{Both, Diagnostic, both};
use crate::digits::significant;
use crate::number::{Ball, Real};
use crate::paper::phrase::tr;
use crate::scene::{Cam, Follows, Kind, Lang, Scene, Turning};
use serde_json::{Value as Json, json};
use std::f64::consts::TAU;

/// Digits of what is computed from given lengths.
const DIGITS: usize = 6;

/// A cam with its survey, told in the units of a scene.
pub struct Report<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The cam.
    pub cam: &'a Cam,
    /// Its geometry.
    pub turning: &'a Turning,
    /// What a turn shows.
    pub survey: &'a Survey,
}

impl Report<'_> {
    fn disc(&self) -> &Disc {
        &self.turning.disc
    }

    /// Whether the follower's coordinate is an angle.
    fn swings(&self) -> bool {
        matches!(self.disc().follower, Follower::Oscillating { .. })
    }

    /// How fast the cam turns, without sense (rad/s).
    pub fn omega(&self) -> f64 {
        self.turning.rates(self.scene)[0].abs()
    }

    fn length(&self, value_m: f64) -> String {
        if !value_m.is_finite() {
            return "∞".into();
        }
        if self.scene.book.chosen(Kind::Length).is_none() && self.scene.length_unit.name == "mm" {
            return format!("{} mm", significant(value_m * 1e3, DIGITS));
        }
        let unit = self.scene.length_unit;
        match self.scene.book.chosen(Kind::Length) {
            Some(chosen) => chosen.text(&significant(chosen.of(value_m), DIGITS)),
            None => format!("{} {}", significant(value_m * unit.denominator / unit.numerator, DIGITS), unit.name),
        }
    }

    fn lift(&self, value: f64) -> String {
        if self.swings() { degrees(value) } else { self.length(value) }
    }

    /// A quantity of the follower: rate (1) or rate of rate (2).
    fn rate(&self, order: usize, value: f64) -> String {
        let kind = match (self.swings(), order) {
            (true, 1) => Kind::Omega,
            (true, _) => Kind::Alpha,
            (false, 1) => Kind::Velocity,
            (false, _) => Kind::Acceleration,
        };
        self.scene.book.text(kind, &significant(self.scene.book.value(kind, value), DIGITS))
    }

    /// The letter of the lift (0), its rate (1) and the rate of that (2); all count outward.
    fn symbol(&self, order: usize) -> &'static str {
        if self.swings() { ["ψ", "ω", "α"][order] } else { ["s", "v", "a"][order] }
    }

    /// What is read at the instant: s, v, a beside the rest. What is no more than the bound of its error is zero.
    fn now(&self) -> Option<(Station, [f64; 3])> {
        let here = (self.turning.phi, self.turning.side);
        let mut station = self.disc().station(here.0, here.1)?;
        let [w, a] = self.turning.rates(self.scene);
        let [mut s, mut v, mut acceleration, _] = self.survey.lift(self.disc(), here.0, here.1)?;
        (v, acceleration) = (v * w, acceleration * w * w + v * a);
        if let Some((cam, phi)) = self.turning.exact::<Ball<f64>>(self.scene)
            && let Some(exact) = cam.station(here, phi)
        {
            let number = |x: Ball<f64>| if x.contains_zero() { 0.0 } else { x.approx() };
            let [w, a] = [w, a].map(Ball::from_f64);
            let [_, dq, ddq, _] = exact.q.0;
            (v, acceleration) = (number(dq * w), number(ddq * w * w + dq * a));
            s = cam.lift(here, phi).map_or(s, number);
            station.pressure = number(exact.pressure);
        }
        Some((station, [s, v, acceleration]))
    }

    /// The report as text.
    pub fn text(&self, lang: Lang) -> String {
        let mut out = String::new();
        let comma = tr(lang, ", ", "，");
        let mut line = |text: String| {
            out.push_str(&text);
            out.push('\n');
        };
        let scene = self.scene;
        let (cam, follower) = (scene.link_name(self.cam.cam), scene.link_name(self.cam.follower));
        let kind = kind(self.cam, self.disc(), lang);
        line(match lang {
            Lang::En => format!("cam {cam}, follower {follower}: {kind}"),
            Lang::Zh => format!("凸轮 {cam}，从动件 {follower}：{kind}"),
        });
        line(format!("  {} r₀ = {}", tr(lang, "base circle", "基圆半径"), self.length(self.disc().base())));
        if let Touch::Point { radius } = self.disc().touch
            && radius > 0.0
        {
            line(format!("  {} r_r = {}", tr(lang, "radius of the follower's end", "滚子（圆端）半径"), self.length(radius)));
        }
        match self.disc().follower {
            Follower::Translating { offset, .. } => {
                // Plus toward the centre of cam and follower as it goes out.
                line(format!("  {} e = {}", tr(lang, "offset", "偏距"), self.length(offset * self.disc().sense + 0.0)));
            }
            Follower::Oscillating { pivot, arm, .. } => {
                line(format!("  {} d = {}", tr(lang, "distance of the pivots", "中心距"), self.length(pivot.norm())));
                if arm > 0.0 {
                    line(format!("  {} l = {}", tr(lang, "arm", "摆杆长"), self.length(arm)));
                }
            }
        }
        line(format!("  {} h = {}", tr(lang, "stroke", "行程"), self.lift(self.survey.stroke)));
        let s = self.survey;
        line(format!(
            "  {}",
            [("Φ", 1, false), ("Φs", 0, true), ("Φ′", -1, false), ("Φs′", 0, false)]
                .map(|(name, way, out)| format!("{name} = {}", degrees(s.angle(way, out))))
                .join("  ")
        ));
        if let Motion::Law { program, .. } = &self.disc().motion {
            for ((stage, start), out) in program.stages.iter().zip(program.joints()).zip(program.outer()) {
                line(format!("  {:>8} – {:<8} {}", degrees(start), degrees(start + stage.over), self.stage(stage.way, out, lang)));
            }
        }
        let w = self.omega();
        for (order, list) in [(1, s.velocity), (2, s.acceleration)] {
            let [low, high] = list;
            let factor = if order == 1 { w } else { w * w };
            let [high, low] = [high, low].map(|e| (degrees(e.0), self.rate(order, e.1 * factor)));
            let symbol = self.symbol(order);
            line(match lang {
                Lang::En => format!("  {symbol}: {} at φ = {}, {} at φ = {}", high.1, high.0, low.1, low.0),
                Lang::Zh => format!("  φ = {} 时 {symbol} = {}，φ = {} 时 {symbol} = {}", high.0, high.1, low.0, low.1),
            });
        }
        for j in &s.jumps {
            line(format!("  {}", self.jump(j, lang)));
        }
        let names =
            [tr(lang, "greatest pressure angle, out", "推程最大压力角"), tr(lang, "greatest pressure angle, back", "回程最大压力角")];
        for (name, found) in names.into_iter().zip(s.pressure) {
            if let Some((phi, angle)) = found {
                line(format!("  {name}{}", valued(degrees(angle.abs()), phi, lang)));
            }
        }
        if let Some((phi, rho)) = s.least_rho {
            let name = match self.disc().touch {
                Touch::Point { .. } => tr(lang, "least convex radius of the pitch curve", "理论廓线外凸部分的最小曲率半径"),
                Touch::Flat { .. } => tr(lang, "least radius of the profile", "廓线的最小曲率半径"),
            };
            line(format!("  {name}{}", valued(self.length(rho), phi, lang)));
        }
        if let Some((station, [lift, v, a])) = self.now() {
            line(format!(
                "  {} φ = {}{}{}",
                tr(lang, "at the instant", "图示位置"),
                degrees(in_turn(self.turning.phi)),
                tr(lang, ": ", "："),
                [
                    format!("{} = {}", self.symbol(0), self.lift(lift)),
                    format!("{} = {}", self.symbol(1), self.rate(1, v)),
                    format!("{} = {}", self.symbol(2), self.rate(2, a))
                ]
                .join(comma)
            ));
            let alpha = match self.disc().touch {
                Touch::Point { .. } => format!("{} {}{comma}", tr(lang, "pressure angle", "压力角"), degrees(station.pressure)),
                Touch::Flat { .. } => String::new(),
            };
            let pitch = if station.rho_pitch == station.rho {
                String::new()
            } else {
                format!("{comma}{} {}", tr(lang, "of the pitch curve", "理论廓线"), self.length(station.rho_pitch))
            };
            line(format!("    {alpha}ρ = {}{pitch}", self.length(station.rho)));
        }
        out
    }

    fn stage(&self, way: Way, out: bool, lang: Lang) -> String {
        let comma = tr(lang, ", ", "，");
        let law = |l: Law| match lang {
            Lang::En => format!("{} motion", l.name()),
            Lang::Zh => l.name_zh().to_owned(),
        };
        match way {
            Way::Rise(h, l) => format!("{} {}{comma}{}", tr(lang, "rise", "推程"), self.lift(h), law(l)),
            Way::Dwell => dwell(out, lang).to_owned(),
            Way::Return(h, l) => format!("{} {}{comma}{}", tr(lang, "return", "回程"), self.lift(h), law(l)),
        }
    }

    /// A shock in words.
    fn jump(&self, j: &Jump, lang: Lang) -> String {
        let w = self.omega();
        let (order, factor, name) = match j.shock {
            Shock::Rigid => (1, w, tr(lang, "rigid shock", "刚性冲击")),
            Shock::Soft => (2, w * w, tr(lang, "soft shock", "柔性冲击")),
        };
        let symbol = self.symbol(order);
        let [b, a] = j.sides.map(|x| self.rate(order, x * factor));
        match lang {
            Lang::En => format!("{name} at φ = {}: {symbol} from {b} to {a}", degrees(in_turn(j.phi))),
            Lang::Zh => format!("φ = {} 处有{name}：{symbol} 由 {b} 变为 {a}", degrees(in_turn(j.phi))),
        }
    }

    /// The report as JSON: SI, angles in radians.
    pub fn json(&self) -> Json {
        let s = self.survey;
        let place = |e: (f64, f64)| json!({"phi": e.0, "value": e.1});
        let now = self.now().map(|(station, [lift, v, a])| {
            json!({"phi": in_turn(self.turning.phi), "s": lift, "v": v, "a": a, "pressure_angle": station.pressure,
                "rho": finite(station.rho), "rho_pitch": finite(station.rho_pitch)})
        });
        let jumps: Vec<Json> = s
            .jumps
            .iter()
            .map(|j| {
                let kind = match j.shock {
                    Shock::Rigid => "rigid",
                    Shock::Soft => "soft",
                };
                json!({"phi": in_turn(j.phi), "kind": kind, "before": j.sides[0], "after": j.sides[1]})
            })
            .collect();
        json!({
            "cam": self.scene.link_name(self.cam.cam),
            "follower": self.scene.link_name(self.cam.follower),
            "oscillating": self.swings(),
            "base": self.disc().base(),
            "stroke": s.stroke,
            "angles": {"rise": s.angle(1, false), "outer_dwell": s.angle(0, true), "return": s.angle(-1, false), "inner_dwell": s.angle(0, false)},
            "ds": s.velocity.map(place),
            "dds": s.acceleration.map(place),
            "shocks": jumps,
            "pressure_angle": {"rise": s.pressure[0].map(place), "return": s.pressure[1].map(place)},
            "least_rho": s.least_rho.map(place),
            "now": now,
            "faults": self.faults().iter().map(|d| json!({"code": d.code, "message": d.message.en})).collect::<Vec<_>>(),
        })
    }

    /// What does not work, as diagnostics with the place of the cam.
    pub fn faults(&self) -> Vec<Diagnostic> {
        let rigid = self.survey.jumps.iter().filter(|j| j.shock == Shock::Rigid);
        let mut out: Vec<Diagnostic> = rigid
            .map(|j| {
                let message = both!("{}", "{}", Both { en: self.jump(j, Lang::En), zh: self.jump(j, Lang::Zh) });
                Diagnostic::warning("impulse", message).help(both!(
                    "the acceleration is infinite there: choose a law whose velocity begins at zero",
                    "该处加速度为无穷大：请选用起始速度为零的运动规律"
                ))
            })
            .collect();
        out.extend(self.survey.faults.iter().map(|f| self.fault(f)));
        out.into_iter().map(|d| d.at(self.cam.span)).collect()
    }

    fn fault(&self, fault: &Fault) -> Diagnostic {
        match *fault {
            Fault::Undercut { phi, rho, least_base } => {
                let (at, rho) = (degrees(in_turn(phi)), self.length(rho));
                let message = match self.disc().touch {
                    Touch::Point { radius } => both!(
                        "the profile is undercut: at φ = {at} the pitch curve has the radius {rho}, the roller {}",
                        "运动失真：φ = {at} 处理论廓线的曲率半径为 {rho}，滚子半径为 {}",
                        self.length(radius)
                    ),
                    Touch::Flat { .. } => both!(
                        "the profile is undercut: at φ = {at} a flat face would need the radius {rho}",
                        "运动失真：φ = {at} 处平底从动件要求的曲率半径为 {rho}"
                    ),
                };
                let d = Diagnostic::warning("undercut", message);
                match least_base {
                    Some(base) => d.help(both!(
                        "the least base circle that avoids it is {}; or take a smaller roller, a longer angle, a gentler law",
                        "避免失真的最小基圆半径为 {}；或减小滚子、加大运动角、改用较平缓的规律",
                        self.length(base)
                    )),
                    None => d.help(both!(
                        "no base circle avoids it: take a smaller roller or a longer angle",
                        "加大基圆也不能避免：请减小滚子或加大运动角"
                    )),
                }
            }
            Fault::RollerTooLarge { phi, rho } => Diagnostic::warning(
                "roller-too-large",
                both!(
                    "the roller does not go into the hollow of radius {} (φ = {})",
                    "滚子放不进半径为 {} 的内凹廓线（φ = {}）",
                    self.length(-rho),
                    degrees(in_turn(phi))
                ),
            )
            .help(both!("take a smaller roller", "请减小滚子")),
            Fault::Pressure { phi, angle, usual, rising } => Diagnostic::warning(
                "pressure-angle",
                both!(
                    "the pressure angle reaches {} at φ = {} {}; usual is at most {}",
                    "压力角在 φ = {1} {2}达到 {0}；许用值为 {3}",
                    degrees(angle.abs()),
                    degrees(in_turn(phi)),
                    if rising { both!("as the follower goes out", "（推程）") } else { both!("as it comes back", "（回程）") },
                    degrees(usual)
                ),
            )
            .help(both!(
                "take a larger base circle, a longer angle, or an offset toward the side of the rise",
                "请加大基圆、加大运动角，或采用合适的偏置"
            )),
            Fault::NoContact { phi } => Diagnostic::warning(
                "no-contact",
                both!("at φ = {} the follower touches nothing", "φ = {} 处从动件接触不到廓线", degrees(in_turn(phi))),
            )
            .help(both!("the follower cannot go round: check radii, offset and arm", "凸轮不能转过一周：请检查各半径、偏距和摆杆长")),
        }
    }

    /// The profile as a table: names, units, columns; lengths in millimetres, angles in degrees.
    pub fn table(&self, steps: usize) -> (Vec<(String, &'static str)>, Vec<Vec<f64>>) {
        let unit = if self.swings() { "deg" } else { "mm" };
        let rates = if self.swings() { ["deg/rad", "deg/rad^2"] } else { ["mm/rad", "mm/rad^2"] };
        let names = [
            ("phi", "deg"),
            ("s", unit),
            ("ds", rates[0]),
            ("dds", rates[1]),
            ("pitch.x", "mm"),
            ("pitch.y", "mm"),
            ("profile.x", "mm"),
            ("profile.y", "mm"),
            ("normal", "deg"),
            ("rho", "mm"),
            ("pressure_angle", "deg"),
        ];
        let mut columns: Vec<Vec<f64>> = vec![Vec::new(); names.len()];
        let factor = if self.swings() { 180.0 / std::f64::consts::PI } else { 1e3 };
        for (phi, side) in round(self.disc(), steps) {
            let Some(s) = self.disc().station(phi, side) else { continue };
            // One row for each angle: at a joint what follows.
            if side == Side::Before && phi < TAU - 1e-9 {
                continue;
            }
            let Some([lift, dq, ddq, _]) = self.survey.lift(self.disc(), phi, side) else { continue };
            let row = [
                phi.to_degrees(),
                lift * factor,
                dq * factor,
                ddq * factor,
                s.pitch.x * 1e3,
                s.pitch.y * 1e3,
                s.contact.x * 1e3,
                s.contact.y * 1e3,
                in_turn(s.normal.angle()).to_degrees(),
                s.rho * 1e3,
                s.pressure.to_degrees(),
            ];
            columns.iter_mut().zip(row).for_each(|(c, v)| c.push(v));
        }
        (names.map(|(n, u)| (n.to_owned(), u)).to_vec(), columns)
    }
}

/// A dwell by its place: `outer` where the follower is farthest out.
pub fn dwell(outer: bool, lang: Lang) -> &'static str {
    if outer { tr(lang, "outer dwell", "远休止") } else { tr(lang, "inner dwell", "近休止") }
}

/// A value with the angle of the cam at which it is reached, behind its name: `: 30° at φ = 60°`, `：30°（φ = 60° 时）`.
fn valued(value: String, phi: f64, lang: Lang) -> String {
    match lang {
        Lang::En => format!(": {value} at φ = {}", degrees(phi)),
        Lang::Zh => format!("：{value}（φ = {} 时）", degrees(phi)),
    }
}

fn finite(x: f64) -> Option<f64> {
    x.is_finite().then_some(x)
}

/// An angle in degrees with a reasonable number of digits.
pub fn degrees(radians: f64) -> String {
    let d = radians.to_degrees();
    // What is written in degrees is met to rounding.
    let rounded = (d * 1e8).round() / 1e8 + 0.0;
    let text = significant(rounded, DIGITS);
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    format!("{text}°")
}

/// What kind of cam it is.
pub fn kind(cam: &Cam, disc: &Disc, lang: Lang) -> String {
    let moves = match disc.follower {
        Follower::Translating { .. } => tr(lang, "translating", "直动"),
        Follower::Oscillating { .. } => tr(lang, "oscillating", "摆动"),
    };
    let end = match cam.follows {
        Follows::Edge(_) => tr(lang, "knife-edge follower", "尖顶从动件"),
        Follows::Roller(..) => tr(lang, "roller follower", "滚子从动件"),
        Follows::Arc(..) => tr(lang, "mushroom follower", "曲面从动件"),
        Follows::Face(_) => tr(lang, "flat-faced follower", "平底从动件"),
    };
    match lang {
        Lang::En => format!("{moves} {end}"),
        Lang::Zh => format!("{moves}{end}"),
    }
}
