//! Reports of a cam over a full turn, as text and JSON: stages, strokes, extremes, shocks, pressure
//! angle, curvature, and faults.

mod least;
mod numbers;
mod subject;

pub use least::LeastCams;
pub use numbers::{CamNumber, Now, PrintedUnit};
pub use subject::CamSubject;

use hodograph_base::cam::{
    CamExtreme, CamMotion, CamSurvey, Disc, Fault, Follower, FollowerTip, Jump, MotionLaw,
    PieceSide, Shock, StageMotion, in_turn, stations,
};
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::digits::legible;
use hodograph_base::lang::{say, tr};
use hodograph_scene::{Cam, Follows, Kind, Lang, Scene, TurningCam};
use serde_json::{Value as Json, json};
use std::f64::consts::TAU;

/// Digits of values computed from given lengths.
const DIGITS: usize = 6;

/// A cam with its survey, reported in the units of a scene.
pub struct Report<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The cam.
    pub cam: &'a Cam,
    /// Geometry of the cam.
    pub turning: &'a TurningCam,
    /// Survey of a full turn.
    pub survey: &'a CamSurvey,
    exact: numbers::KnownCams,
    numbers: numbers::KnownNumbers,
}

impl<'a> Report<'a> {
    /// Creates the report of a cam with its survey.
    pub fn new(
        scene: &'a Scene,
        cam: &'a Cam,
        turning: &'a TurningCam,
        survey: &'a CamSurvey,
    ) -> Self {
        let (exact, numbers) = Default::default();
        Report { scene, cam, turning, survey, exact, numbers }
    }

    /// Returns the report of a cam; `None` for a cam without a profile over the whole turn, which
    /// is carried by a moving link.
    pub fn of(scene: &'a Scene, cam: &'a Cam) -> Option<Self> {
        let turning = cam.disc.as_ref()?;
        Some(Report::new(scene, cam, turning, turning.survey.of(&turning.disc)))
    }
}

impl Report<'_> {
    fn disc(&self) -> &Disc {
        &self.turning.disc
    }

    /// Returns true if the follower's coordinate is an angle.
    pub fn swings(&self) -> bool {
        matches!(self.disc().follower, Follower::Oscillating { .. })
    }

    /// Returns the magnitude of the cam's angular velocity (rad/s).
    pub fn omega(&self) -> f64 {
        self.turning.rates(self.scene)[0].abs()
    }

    /// Returns the kind of the follower's coordinate (0), of its rate (1) or of its second
    /// derivative (2).
    fn kind_of(&self, order: usize) -> Kind {
        match (self.swings(), order) {
            (true, 0) => Kind::Angle,
            (true, 1) => Kind::Omega,
            (true, _) => Kind::Alpha,
            (false, 0) => Kind::Length,
            (false, 1) => Kind::Velocity,
            (false, _) => Kind::Acceleration,
        }
    }

    /// Returns a number with its unit, to as many digits as are certain; `rough` is its approximate
    /// value (SI).
    fn say(&self, which: CamNumber, unit: PrintedUnit, rough: f64) -> String {
        if !rough.is_finite() {
            return "∞".into();
        }
        let text = self.digits(which, unit, rough);
        match unit {
            PrintedUnit::Si => text,
            PrintedUnit::Degrees => in_degrees(&text),
            PrintedUnit::Lift(0) if self.swings() => in_degrees(&text),
            PrintedUnit::Length | PrintedUnit::Lift(0) => {
                match self.scene.book.chosen(Kind::Length) {
                    Some(chosen) => chosen.text(&text),
                    None => format!("{text} {}", self.scene.length_unit.name),
                }
            }
            PrintedUnit::Lift(order) => self.scene.book.text(self.kind_of(order), &text),
        }
    }

    /// Returns the letter of the lift (0), of its rate (1) or of its second derivative (2); all are
    /// positive outwards.
    fn symbol(&self, order: usize) -> &'static str {
        if self.swings() { ["ψ", "ω", "α"][order] } else { ["s", "v", "a"][order] }
    }

    /// Returns the values at the instant in double precision: s, v, a, pressure angle, radii of
    /// curvature of profile and pitch curve.
    fn now(&self) -> Option<[f64; 6]> {
        let (phi, side) = (self.turning.phi, self.turning.side);
        let station = self.disc().station(phi, side)?;
        let [w, a] = self.turning.rates(self.scene);
        let [s, v, acceleration, _] = self.survey.lift(self.disc(), phi, side)?;
        Some([
            s,
            v * w,
            acceleration * w * w + v * a,
            station.pressure,
            station.rho,
            station.rho_pitch,
        ])
    }

    /// Returns the report as text.
    pub fn text(&self, lang: Lang) -> String {
        self.lines(lang).into_iter().map(|(_, line)| line + "\n").collect()
    }

    /// Returns the lines of the report, each with its subject.
    pub fn lines(&self, lang: Lang) -> Vec<(CamSubject, String)> {
        let mut out = Vec::new();
        let comma = tr!(lang, "clause" => ", ");
        let mut line = |subject: CamSubject, text: String| out.push((subject, text));
        let scene = self.scene;
        let (cam, follower) = (scene.link_name(self.cam.cam), scene.link_name(self.cam.follower));
        let kind = kind(self.cam, self.disc(), lang);
        line(CamSubject::Data, say!(lang, "cam {cam}, follower {follower}: {kind}"));
        line(
            CamSubject::Data,
            format!(
                "  {} r₀ = {}",
                tr!(lang, "base circle"),
                self.say(CamNumber::Base, PrintedUnit::Length, self.disc().base())
            ),
        );
        if let FollowerTip::Point { radius } = self.disc().touch
            && radius > 0.0
        {
            line(
                CamSubject::Data,
                format!(
                    "  {} r_r = {}",
                    tr!(lang, "radius of the follower's end"),
                    self.say(CamNumber::End, PrintedUnit::Length, radius)
                ),
            );
        }
        match self.disc().follower {
            Follower::Translating { offset, .. } => {
                // Positive towards the instantaneous centre of cam and follower on the outward
                // motion.
                line(
                    CamSubject::Data,
                    format!(
                        "  {} e = {}",
                        tr!(lang, "offset"),
                        self.say(
                            CamNumber::Offset,
                            PrintedUnit::Length,
                            offset * self.disc().sense
                        )
                    ),
                );
            }
            Follower::Oscillating { pivot, arm, .. } => {
                line(
                    CamSubject::Data,
                    format!(
                        "  {} d = {}",
                        tr!(lang, "distance of the pivots"),
                        self.say(CamNumber::Distance, PrintedUnit::Length, pivot.norm())
                    ),
                );
                if arm > 0.0 {
                    line(
                        CamSubject::Data,
                        format!(
                            "  {} l = {}",
                            tr!(lang, "arm"),
                            self.say(CamNumber::Arm, PrintedUnit::Length, arm)
                        ),
                    );
                }
            }
        }
        line(
            CamSubject::Law,
            format!(
                "  {} h = {}",
                tr!(lang, "stroke"),
                self.say(CamNumber::Stroke, PrintedUnit::Lift(0), self.survey.stroke)
            ),
        );
        let s = self.survey;
        line(
            CamSubject::Law,
            format!(
                "  {}",
                [("Φ", 1, false), ("Φs", 0, true), ("Φ′", -1, false), ("Φs′", 0, false)]
                    .map(|(name, way, out)| format!(
                        "{name} = {}",
                        self.say(
                            CamNumber::Phase(way, out),
                            PrintedUnit::Degrees,
                            s.angle(way, out)
                        )
                    ))
                    .join("  ")
            ),
        );
        if let CamMotion::Law { program, .. } = &self.disc().motion {
            let (joints, outer) = (program.joints(), program.outer());
            for (k, stage) in program.stages().iter().enumerate() {
                let [from, to] = [k, k + 1]
                    .map(|k| self.say(CamNumber::Start(k), PrintedUnit::Degrees, joints[k]));
                line(
                    CamSubject::Law,
                    format!("  {from:>8} – {to:<8} {}", self.stage(k, stage.way, outer[k], lang)),
                );
            }
        }
        let w = self.omega();
        let marks = [
            (1, [0, 1].map(CamExtreme::Rate), s.velocity),
            (2, [0, 1].map(CamExtreme::Bend), s.acceleration),
        ];
        for (order, mark, list) in marks {
            let factor = if order == 1 { w } else { w * w };
            let told = |k: usize| {
                let at = self.say(CamNumber::At(mark[k]), PrintedUnit::Degrees, list[k].0);
                (
                    at,
                    self.say(
                        CamNumber::Most(mark[k]),
                        PrintedUnit::Lift(order),
                        list[k].1 * factor,
                    ),
                )
            };
            let [low, high] = [told(0), told(1)];
            let symbol = self.symbol(order);
            let subject = if order == 1 { CamSubject::Velocity } else { CamSubject::Acceleration };
            line(
                subject,
                say!(lang, "  {symbol}: {} at φ = {}, {} at φ = {}", high.1, high.0, low.1, low.0),
            );
        }
        for (k, j) in s.jumps.iter().enumerate() {
            line(CamSubject::Acceleration, format!("  {}", self.jump(k, j, lang)));
        }
        let names =
            [tr!(lang, "greatest pressure angle, out"), tr!(lang, "greatest pressure angle, back")];
        for (k, name) in names.into_iter().enumerate() {
            if s.pressure[k].is_some() {
                line(
                    CamSubject::Pressure,
                    format!(
                        "  {name}{}",
                        self.valued(CamExtreme::Pressure(k), s.pressure[k], lang)
                    ),
                );
            }
        }
        if s.least_rho.is_some() {
            let name = match self.disc().touch {
                FollowerTip::Point { .. } => tr!(lang, "least convex radius of the pitch curve"),
                FollowerTip::Flat { .. } => {
                    tr!(lang, "least radius of the profile")
                }
            };
            line(
                CamSubject::Curvature,
                format!("  {name}{}", self.valued(CamExtreme::Radius, s.least_rho, lang)),
            );
        }
        if let Some([lift, v, a, pressure, rho, rho_pitch]) = self.now() {
            let lifts = [lift, v, a].into_iter().enumerate();
            let lifts = lifts.map(|(k, x)| {
                format!(
                    "{} = {}",
                    self.symbol(k),
                    self.say(CamNumber::Now(Now::Lift(k)), PrintedUnit::Lift(k), x)
                )
            });
            line(
                CamSubject::Instant,
                format!(
                    "  {} φ = {}{}{}",
                    tr!(lang, "at the instant"),
                    self.say(
                        CamNumber::Now(Now::Phi),
                        PrintedUnit::Degrees,
                        in_turn(self.turning.phi)
                    ),
                    tr!(lang, ": "),
                    lifts.collect::<Vec<_>>().join(comma)
                ),
            );
            let alpha = match self.disc().touch {
                FollowerTip::Point { .. } => {
                    let pressure =
                        self.say(CamNumber::Now(Now::Pressure), PrintedUnit::Degrees, pressure);
                    format!("{} {pressure}{comma}", tr!(lang, "pressure angle"))
                }
                FollowerTip::Flat { .. } => String::new(),
            };
            let pitch = if rho_pitch == rho {
                String::new()
            } else {
                let told = self.say(CamNumber::Now(Now::Pitch), PrintedUnit::Length, rho_pitch);
                format!("{comma}{} {told}", tr!(lang, "of the pitch curve"))
            };
            line(
                CamSubject::Instant,
                format!(
                    "    {alpha}ρ = {}{pitch}",
                    self.say(CamNumber::Now(Now::Rho), PrintedUnit::Length, rho)
                ),
            );
        }
        out
    }

    fn stage(&self, k: usize, way: StageMotion, out: bool, lang: Lang) -> String {
        let gain = |h: f64| self.say(CamNumber::Gain(k), PrintedUnit::Lift(0), h);
        let comma = tr!(lang, "clause" => ", ");
        let law = |l: MotionLaw| match lang {
            Lang::En => format!("{} motion", l.name()),
            Lang::Zh => l.words(lang).to_owned(),
        };
        match way {
            StageMotion::Rise(h, l) => {
                format!("{} {}{comma}{}", tr!(lang, "rise"), gain(h), law(l))
            }
            StageMotion::Dwell => dwell(out, lang).to_owned(),
            StageMotion::Return(h, l) => {
                format!("{} {}{comma}{}", tr!(lang, "return"), gain(h), law(l))
            }
        }
    }

    /// Returns an extreme with its cam angle, to follow its name: `: 30° at φ = 60°`,
    /// `：30°（φ = 60° 时）`.
    fn valued(&self, mark: CamExtreme, found: Option<(f64, f64)>, lang: Lang) -> String {
        let (phi, value) = found.unwrap_or_default();
        let unit =
            if mark == CamExtreme::Radius { PrintedUnit::Length } else { PrintedUnit::Degrees };
        let at = self.say(CamNumber::At(mark), PrintedUnit::Degrees, phi);
        let value = self.say(
            CamNumber::Most(mark),
            unit,
            if mark == CamExtreme::Radius { value } else { value.abs() },
        );
        say!(lang, ": {value} at φ = {at}")
    }

    /// Returns a shock in words.
    fn jump(&self, k: usize, j: &Jump, lang: Lang) -> String {
        let name = match j.shock {
            Shock::Rigid => tr!(lang, "rigid shock"),
            Shock::Soft => tr!(lang, "soft shock"),
        };
        let order = j.shock.order();
        let (symbol, factor) = (self.symbol(order), libm::pow(self.omega(), order as f64));
        let [b, a] = [0, 1].map(|side| {
            self.say(CamNumber::Jump(k, side), PrintedUnit::Lift(order), j.sides[side] * factor)
        });
        let at = self.say(CamNumber::JumpAt(k), PrintedUnit::Degrees, in_turn(j.phi));
        say!(lang, "{name} at φ = {at}: {symbol} from {b} to {a}")
    }

    /// Returns the report as JSON: SI, angles in radians.
    pub fn json(&self) -> Json {
        let s = self.survey;
        let near = |which: CamNumber, rough: f64| self.nearest(which, rough);
        let place = |mark: CamExtreme, e: (f64, f64)| json!({"phi": near(CamNumber::At(mark), e.0), "value": near(CamNumber::ByPhi(mark), e.1)});
        let now = self.now().map(|[lift, v, a, pressure, rho, pitch]| {
            let of = |now: Now, rough: f64| near(CamNumber::Now(now), rough);
            json!({"phi": of(Now::Phi, in_turn(self.turning.phi)), "s": of(Now::Lift(0), lift), "v": of(Now::Lift(1), v), "a": of(Now::Lift(2), a),
                "pressure_angle": of(Now::Pressure, pressure), "rho": of(Now::Rho, rho), "rho_pitch": of(Now::Pitch, pitch)})
        });
        let jumps: Vec<Json> = s
            .jumps
            .iter()
            .enumerate()
            .map(|(k, j)| {
                let kind = match j.shock {
                    Shock::Rigid => "rigid",
                    Shock::Soft => "soft",
                };
                let sides = [0, 1].map(|side| near(CamNumber::JumpByPhi(k, side), j.sides[side]));
                json!({"phi": near(CamNumber::JumpAt(k), in_turn(j.phi)), "kind": kind, "before": sides[0], "after": sides[1]})
            })
            .collect();
        let angle = |way: i8, out: bool| near(CamNumber::Phase(way, out), s.angle(way, out));
        let both = |mark: fn(usize) -> CamExtreme, list: [(f64, f64); 2]| {
            [0, 1].map(|k| place(mark(k), list[k]))
        };
        let pressure = |k: usize| s.pressure[k].map(|e| place(CamExtreme::Pressure(k), e));
        json!({
            "cam": self.scene.link_name(self.cam.cam),
            "follower": self.scene.link_name(self.cam.follower),
            "oscillating": self.swings(),
            "base": near(CamNumber::Base, self.disc().base()),
            "stroke": near(CamNumber::Stroke, s.stroke),
            "angles": {"rise": angle(1, false), "outer_dwell": angle(0, true), "return": angle(-1, false), "inner_dwell": angle(0, false)},
            "ds": both(CamExtreme::Rate, s.velocity),
            "dds": both(CamExtreme::Bend, s.acceleration),
            "shocks": jumps,
            "pressure_angle": {"rise": pressure(0), "return": pressure(1)},
            "least_rho": s.least_rho.map(|e| place(CamExtreme::Radius, e)),
            "now": now,
            "faults": self.faults().iter().map(|d| json!({"code": d.code, "message": d.message.en})).collect::<Vec<_>>(),
        })
    }

    /// Returns the faults of the cam as diagnostics, located at the cam.
    pub fn faults(&self) -> Vec<Diagnostic> {
        let rigid = self.survey.jumps.iter().enumerate().filter(|(_, j)| j.shock == Shock::Rigid);
        let mut out: Vec<Diagnostic> = rigid
            .map(|(k, j)| {
                let message = both!(
                    "{}",
                    Both { en: self.jump(k, j, Lang::En), zh: self.jump(k, j, Lang::Zh) }
                );
                Diagnostic::warning("impulse", message).help(both!(
                    "the acceleration is infinite there: choose a law whose velocity begins at zero"
                ))
            })
            .collect();
        out.extend(self.survey.faults.iter().map(|f| self.fault(f)));
        out.into_iter().map(|d| d.at(self.cam.span)).collect()
    }

    fn fault(&self, fault: &Fault) -> Diagnostic {
        match *fault {
            Fault::Undercut { phi, rho, least_base } => {
                let at = self.say(CamNumber::At(CamExtreme::Radius), PrintedUnit::Degrees, in_turn(phi));
                let rho = self.say(CamNumber::Most(CamExtreme::Radius), PrintedUnit::Length, rho);
                let message = match self.disc().touch {
                    FollowerTip::Point { radius } => both!(
                        "the profile is undercut: at φ = {at} the pitch curve has the radius {rho}, the roller {}",
                        self.say(CamNumber::End, PrintedUnit::Length, radius)
                    ),
                    FollowerTip::Flat { .. } => both!(
                        "the profile is undercut: at φ = {at} a flat face would need the radius {rho}"
                    ),
                };
                let d = Diagnostic::warning("undercut", message);
                match least_base {
                    Some(base) => d.help(both!(
                        "the least base circle that avoids it is {}; or take a smaller roller, a longer angle, a gentler law",
                        self.say(CamNumber::LeastBase, PrintedUnit::Length, base)
                    )),
                    None => d.help(both!(
                        "no base circle avoids it: take a smaller roller or a longer angle"
                    )),
                }
            }
            Fault::RollerTooLarge { phi, rho } => Diagnostic::warning(
                "roller-too-large",
                both!(
                    "the roller does not go into the hollow of radius {} (φ = {})",
                    self.say(CamNumber::Hollow, PrintedUnit::Length, -rho),
                    self.say(CamNumber::HollowAt, PrintedUnit::Degrees, in_turn(phi))
                ),
            )
            .help(both!("take a smaller roller")),
            Fault::Pressure { phi, angle, usual, rising } => Diagnostic::warning(
                "pressure-angle",
                both!(
                    "the pressure angle reaches {} at φ = {} {}; usual is at most {}",
                    self.say(CamNumber::Most(CamExtreme::Pressure(usize::from(!rising))), PrintedUnit::Degrees, angle.abs()),
                    self.say(CamNumber::At(CamExtreme::Pressure(usize::from(!rising))), PrintedUnit::Degrees, in_turn(phi)),
                    if rising { both!("as the follower goes out") } else { both!("as it comes back") },
                    degrees(usual)
                ),
            )
            .help(both!(
                "take a larger base circle, a longer angle, or an offset toward the side of the rise"
            )),
            Fault::NoContact { phi } => Diagnostic::warning(
                "no-contact",
                both!("at φ = {} the follower touches nothing", degrees(in_turn(phi))),
            )
            .help(both!("the follower cannot go round: check radii, offset and arm")),
        }
    }

    /// Returns the profile as a table: names, units, columns; lengths in millimetres, angles in
    /// degrees.
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
        for (s, side) in stations(self.disc(), steps) {
            let phi = s.phi;
            // One row for each angle: at a joint the values after it.
            if side == PieceSide::Before && phi < TAU - 1e-9 {
                continue;
            }
            let Some([lift, dq, ddq, _]) = self.survey.lift(self.disc(), phi, side) else {
                continue;
            };
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

/// Returns the name of a dwell: the outer one with `outer`, with the follower farthest out.
pub fn dwell(outer: bool, lang: Lang) -> &'static str {
    if outer { tr!(lang, "outer dwell") } else { tr!(lang, "inner dwell") }
}

/// Returns degrees without trailing zeros.
fn in_degrees(text: &str) -> String {
    let text =
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text };
    format!("{text}°")
}

/// Returns an angle in degrees from double precision, used if no certified value exists.
fn degrees(radians: f64) -> String {
    // Rounds to 1e-8°, which restores values that are written in degrees.
    in_degrees(&legible((radians.to_degrees() * 1e8).round() / 1e8 + 0.0, DIGITS))
}

/// Returns the type of the cam in words.
pub fn kind(cam: &Cam, disc: &Disc, lang: Lang) -> String {
    let moves = match disc.follower {
        Follower::Translating { .. } => tr!(lang, "translating"),
        Follower::Oscillating { .. } => tr!(lang, "oscillating"),
    };
    let end = match cam.follows {
        Follows::Edge(_) => tr!(lang, "knife-edge follower"),
        Follows::Roller(..) => tr!(lang, "roller follower"),
        Follows::Arc(..) => tr!(lang, "mushroom follower"),
        Follows::Face(_) => tr!(lang, "flat-faced follower"),
    };
    match lang {
        Lang::En => format!("{moves} {end}"),
        Lang::Zh => format!("{moves}{end}"),
    }
}
