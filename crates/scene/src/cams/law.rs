//! A cam by a law at its instant. An arc about the centre of curvature of the profile at the
//! contact replaces the contact, as for a profile of arcs. If this centre is too far away, the
//! follower becomes a driver with its place, rate and acceleration.
//!
//! Let P be the follower's point relative to the pivot of the cam in the axes of the carrier, P′
//! and P″ its derivatives by φ there, and σ the sense of the cam's rotation. In the cam, the point
//! moves with w = P′ − σP⊥ and w′ = P″ − 2σP′⊥ − P. So the centre of curvature of its path, the
//! pitch curve, is K = P + w⊥ w²/(w × w′). The outward normal m of a flat face turns in the cam at
//! μ = r − σ (r its rate in the carrier), and the face has the support h, h′ = dh/dφ. With g = h′/μ
//! and f = (h″μ − h′r′)/μ³, the radius of curvature is h + f and K = g m⊥ − f m.
//!
//! The texts are formulas with the texts of the scene, so that higher-precision numbers certify the
//! answers of a law cam as those of any other mechanism. Parts that occur more than once become
//! parameters in addition to those of the file (`cam1_x`, `cam1_s`, ...).
//!
//! # Source
//! The path of a point in a turning frame: 孙桓, *Machine Theory*, 反转法; the support function of a
//! convex curve: h + h″ is its radius of curvature.

use super::super::model::{GivenQuantity, LinkId, PointId, Scene};
use super::super::raw::{RawDriver, RawDriverKind, RawPlace, RawQuantity};
use super::place::{CarriedFollower, OnPivot, PointTexts, direction, distance, outward};
use hodograph_base::cam::{
    CamStation, Disc, FollowerTip, PieceSide, StageMotion, StageProgram, in_turn_of,
};
use hodograph_base::diag::Span;
use hodograph_base::json::Word;

/// A stage as written.
pub(super) struct StageText {
    /// Lift of the stage; `None` for a dwell.
    pub gain: Option<GivenQuantity>,
    /// Text of the cam angle.
    pub over: String,
}

/// Texts of a law, in addition to its numbers.
pub(super) struct LawText {
    pub base: String,
    pub start: String,
    pub clockwise: bool,
    pub stages: Vec<StageText>,
}

/// Places of a cam and its follower, and the end in contact.
pub(super) struct At<'a> {
    pub scene: &'a Scene,
    /// The link that is the cam.
    pub of: LinkId,
    pub cam: &'a OnPivot,
    pub carried: &'a CarriedFollower,
    /// The follower's point, or the mark that gives its direction.
    pub point: PointId,
    /// Radius of the round end, as a text.
    pub radius: Option<String>,
    /// Distance from the pivot to the point, as a text.
    pub arm: Option<String>,
    /// Distance of a face from its pivot, as a text.
    pub lever: Option<String>,
    pub follower: &'a str,
    pub span: Span,
}

/// Pair or driver that replaces the contact, and the parameters that it adds to those of the file.
pub(super) struct ContactReplacement {
    pub parameters: Vec<(String, String)>,
    pub stands: LawReplacement,
}

/// Replacement of the contact of a law.
pub(super) enum LawReplacement {
    /// An arc about a point of the cam: the place of this point (`None` for the pivot), and the
    /// parameter of the radius, of the pitch curve or of the profile under a face.
    Arc { place: Option<RawPlace>, radius: String },
    /// The follower as a driver.
    Driver(RawDriver),
}

/// Texts of the lift and its derivatives by φ in a stage, with the data for all formulas.
struct StageTexts<'a> {
    at: &'a At<'a>,
    law: &'a LawText,
    name: &'a str,
    parameters: Vec<(String, String)>,
    /// "+" or "-": the outward sense of the follower, along its guide or counter-clockwise.
    out: &'static str,
    /// Text of s.
    s: String,
    /// Texts of s′ and s″; `None` in a dwell.
    rates: Option<(String, String)>,
}

impl<'a> StageTexts<'a> {
    fn new(
        at: &'a At<'a>,
        disc: &Disc,
        program: &StageProgram,
        law: &'a LawText,
        (phi, side): (f64, PieceSide),
        name: &'a str,
    ) -> Option<StageTexts<'a>> {
        let unit = if matches!(at.carried, CarriedFollower::Pivot { .. }) { "deg" } else { "mm" };
        let (i, _, _) = program.stage(phi, side)?;
        let stage = &program.stages()[i];
        let out = if outward(at.carried, &disc.follower) < 0.0 { "-" } else { "+" };
        let mut t = StageTexts {
            at,
            law,
            name,
            parameters: Vec::new(),
            out,
            s: String::new(),
            rates: None,
        };
        // The angle from the start of the law, minus whole turns and the preceding stages.
        let (start, angle) = (&law.start, &at.cam.angle.text);
        let turned = if law.clockwise {
            format!("({start})-({angle})")
        } else {
            format!("({angle})-({start})")
        };
        let in_turn = in_turn_of(phi, side);
        let turns = libm::rint((phi - in_turn) / std::f64::consts::TAU);
        let mut before = String::new();
        let mut lift = String::from("0 ") + unit;
        for (text, stage) in law.stages.iter().zip(program.stages()).take(i) {
            before += &format!("-({})", text.over);
            match (&text.gain, stage.way) {
                (Some(gain), StageMotion::Rise(..)) => lift += &format!("+({})", gain.text),
                (Some(gain), StageMotion::Return(..)) => lift += &format!("-({})", gain.text),
                (None, _) | (_, StageMotion::Dwell) => {}
            }
        }
        let whole = if turns == 0.0 { String::new() } else { format!("-({turns}*360 deg)") };
        let over = &law.stages[i].over;
        match (&law.stages[i].gain, stage.law()) {
            (Some(gain), Some(motion)) => {
                let x = t.define("x", format!("({turned}{whole}{before})/({over})"));
                let sign = if matches!(stage.way, StageMotion::Return(..)) { "-" } else { "" };
                let in_stage = (in_turn - program.joints()[i]) / stage.over;
                let [s, ds, dds] = motion.text(in_stage.clamp(0.0, 1.0), &x);
                let gain = format!("{sign}({})", gain.text);
                t.s = t.define(
                    "s",
                    format!("{lift}{}{gain}*({s})", if sign.is_empty() { "+" } else { "" }),
                );
                let ds = t.define("ds", format!("{gain}/({over})*({ds})"));
                let dds = t.define("dds", format!("{gain}/({over})^2*({dds})"));
                t.rates = Some((ds, dds));
            }
            _ => t.s = t.define("s", lift),
        }
        Some(t)
    }

    /// Adds a parameter to those of the file; returns its full name.
    fn define(&mut self, what: &str, text: String) -> String {
        let full = format!("{}_{what}", self.name);
        self.parameters.push((full.clone(), text));
        full
    }

    fn word(&self, text: String) -> Word {
        Word { text, span: self.at.span }
    }

    fn quantity(&self, text: String) -> RawQuantity {
        RawQuantity { text, span: self.at.span, bare: false }
    }

    /// Returns the vector from the pivot of the cam to a place of its carrier.
    fn seen_from_cam(&mut self, to: &PointTexts) -> [String; 2] {
        let [x, y] = self.at.cam.spot.way_to(to);
        [self.define("dx", x), self.define("dy", y)]
    }

    /// Returns the follower's coordinate, outward from the foot of the perpendicular from the pivot
    /// of the cam; `aside` is the text of the guide's distance from the pivot.
    fn way_out(&self, disc: &Disc, aside: &str) -> String {
        let base = &self.law.base;
        match (&self.at.radius, disc.touch) {
            (Some(r), FollowerTip::Point { .. }) => {
                format!("sqrt((({base})+({r}))^2-{aside}^2)+{}", self.s)
            }
            _ => format!("({base})+{}", self.s),
        }
    }

    /// Returns the angle of the arm, or of the line of the face.
    fn direction(&mut self, spot: &PointTexts) -> String {
        let centre = self.define("d", distance(spot, &self.at.cam.spot));
        let base = &self.law.base;
        let rest = match (&self.at.radius, &self.at.arm, &self.at.lever) {
            (Some(r), Some(l), _) => {
                format!("acos(({centre}^2+({l})^2-(({base})+({r}))^2)/(2*{centre}*({l})))")
            }
            (_, _, lever) => format!(
                "asin((({base})-({}))/{centre})",
                lever.clone().unwrap_or_else(|| "0 mm".into())
            ),
        };
        let rest = self.define("rest", rest);
        format!("{}{}({rest}+{})", direction(spot, &self.at.cam.spot), self.out, self.s)
    }

    /// Returns the driver that moves the follower by the law.
    fn driver(mut self, disc: &Disc) -> ContactReplacement {
        let cam = self.at.cam;
        let clockwise = self.law.clockwise;
        let turned =
            |text: &str| if clockwise { format!("(-({text}))") } else { format!("({text})") };
        let (w, a) = (turned(&cam.rate_text), turned(&cam.acceleration_text));
        let turning = matches!(self.at.carried, CarriedFollower::Pivot { .. });
        let (rate_unit, unit_2) = if turning { ("rad/s", "rad/s^2") } else { ("mm/s", "mm/s^2") };
        let (mut rate, mut acceleration) = match &self.rates {
            Some((ds, dds)) => (format!("{ds}*{w}"), format!("{dds}*{w}^2+{ds}*{a}")),
            None => (format!("0 {rate_unit}"), format!("0 {unit_2}")),
        };
        if self.out == "-" {
            (rate, acceleration) = (format!("-({rate})"), format!("-({acceleration})"));
        }
        let kind = match self.at.carried {
            CarriedFollower::Guide { through, angle, .. } => {
                let [x, y] = self.seen_from_cam(through);
                let t = &angle.text;
                // The coordinate counts from `through`; the foot of the perpendicular has this
                // coordinate.
                let foot = self.define("foot", format!("-({x}*cos({t})+{y}*sin({t}))"));
                let aside = self.define("e", format!("{x}*sin({t})-{y}*cos({t})"));
                let way = self.way_out(disc, &aside);
                let place = self.define("place", format!("{foot}{}({way})", self.out));
                let (slide, position) =
                    (self.word(self.at.follower.to_owned()), Some(self.quantity(place)));
                RawDriverKind::Slide { slide, position }
            }
            CarriedFollower::Pivot { pivot, spot } => {
                let place = self.direction(spot);
                let place = self.define("place", place);
                let line = format!(
                    "{},{}",
                    self.at.scene.point_name(*pivot),
                    self.at.scene.point_name(self.at.point)
                );
                RawDriverKind::Turn {
                    link: self.word(self.at.follower.to_owned()),
                    against: (cam.frame != self.at.scene.ground)
                        .then(|| self.word(self.at.scene.link_name(cam.frame).to_owned())),
                    line: Some(self.word(line)),
                    against_line: None,
                    angle: Some(self.quantity(place)),
                }
            }
        };
        let (rate, acceleration) = (Some(self.quantity(rate)), Some(self.quantity(acceleration)));
        let driver = RawDriver { kind, rate, acceleration, law: None, span: self.at.span };
        ContactReplacement { parameters: self.parameters, stands: LawReplacement::Driver(driver) }
    }

    /// Returns the centre of curvature in the axes of the carrier, relative to the pivot of the
    /// cam, and the radius: of the pitch curve, or of the profile under a face.
    fn curvature(&mut self, disc: &Disc) -> [String; 3] {
        let sigma = if self.law.clockwise { "-" } else { "" };
        let out = if self.out == "-" { "-" } else { "" };
        let (q1, q2) = self.rates.clone().unwrap_or_else(|| ("0".into(), "0".into()));
        match (self.at.carried, disc.touch) {
            (CarriedFollower::Guide { through, angle, .. }, touch) => {
                let [x, y] = self.seen_from_cam(through);
                let (c, s) = (format!("cos({})", angle.text), format!("sin({})", angle.text));
                let still = self.rates.is_none();
                let per_radian = |text: String, k: &str| {
                    if still { "0 mm".to_owned() } else { format!("{text}*(1 rad){k}") }
                };
                let (q1, q2) = (
                    self.define("q1", per_radian(q1, "")),
                    self.define("q2", per_radian(q2, "^2")),
                );
                let aside = self.define("e", format!("{x}*{s}-{y}*{c}"));
                let way = self.way_out(disc, &aside);
                let q = self.define("q", way);
                if let FollowerTip::Flat { .. } = touch {
                    let kx = format!("{sigma}({out}({q1}))*{s}-({out}({q2}))*{c}");
                    let ky = format!("-({sigma}({out}({q1}))*{c})-({out}({q2}))*{s}");
                    return [kx, ky, format!("{q}+{q2}")];
                }
                let along =
                    |text: &str| [format!("({out}({text}))*{c}"), format!("({out}({text}))*{s}")];
                let [px, py] = along(&q);
                let p = [
                    self.define("px", format!("{px}+{aside}*{s}")),
                    self.define("py", format!("{py}-{aside}*{c}")),
                ];
                self.pitch_curve(p, along(&q1), along(&q2), sigma)
            }
            (CarriedFollower::Pivot { spot, .. }, touch) => {
                let [x, y] = self.seen_from_cam(spot);
                let angle = self.direction(spot);
                let angle = self.define("arm", angle);
                let (c, s) = (format!("cos({angle})"), format!("sin({angle})"));
                let r1 = self.define("r1", format!("{out}({q1})"));
                let unit = if self.rates.is_none() { "" } else { "*(1 rad)" };
                let r2 = self.define("r2", format!("{out}({q2}){unit}"));
                if let FollowerTip::Flat { .. } = touch {
                    // m = ±u⊥, m⊥ = ∓u.
                    let (mx, my) = (format!("({out}(-{s}))"), format!("({out}({c}))"));
                    let b = self.define("b", format!("{x}*{mx}+{y}*{my}"));
                    let beside = self.define("n", format!("{y}*{mx}-{x}*{my}"));
                    let mu = self.define("mu", format!("{r1}-({sigma}1)"));
                    let g = self.define("g", format!("{r1}*{beside}/{mu}"));
                    let f = self.define(
                        "f",
                        format!("(({r2}*{beside}-{r1}^2*{b})*{mu}-{r1}*{beside}*{r2})/{mu}^3"),
                    );
                    let lever = self.at.lever.clone().unwrap_or_else(|| "0 mm".into());
                    return [
                        format!("-({g}*{my})-{f}*{mx}"),
                        format!("{g}*{mx}-{f}*{my}"),
                        format!("{b}+({lever})+{f}"),
                    ];
                }
                let l = self.at.arm.clone().unwrap_or_else(|| "0 mm".into());
                let p = [
                    self.define("px", format!("{x}+({l})*{c}")),
                    self.define("py", format!("{y}+({l})*{s}")),
                ];
                let first = [format!("-(({l})*{r1}*{s})"), format!("({l})*{r1}*{c}")];
                let second = [
                    format!("-(({l})*({r2}*{s}+{r1}^2*{c}))"),
                    format!("({l})*({r2}*{c}-{r1}^2*{s})"),
                ];
                self.pitch_curve(p, first, second, sigma)
            }
        }
    }

    /// Returns centre and radius of curvature of the pitch curve at the point P, from its
    /// derivatives by φ.
    fn pitch_curve(
        &mut self,
        [px, py]: [String; 2],
        first: [String; 2],
        second: [String; 2],
        sigma: &str,
    ) -> [String; 3] {
        let [ax, ay] = first;
        let (ax, ay) = (self.define("ax", ax), self.define("ay", ay));
        let wx = self.define("wx", format!("{ax}+({sigma}{py})"));
        let wy = self.define("wy", format!("{ay}-({sigma}{px})"));
        let [bx, by] = second;
        let zx = self.define("zx", format!("{bx}+2*({sigma}{ay})-{px}"));
        let zy = self.define("zy", format!("{by}-2*({sigma}{ax})-{py}"));
        let k = self.define("k", format!("({wx}^2+{wy}^2)/({wx}*{zy}-{wy}*{zx})"));
        [
            format!("{px}-{wy}*{k}"),
            format!("{py}+{wx}*{k}"),
            format!("sqrt({wx}^2+{wy}^2)*abs({k})"),
        ]
    }

    /// Returns the centre of curvature as a point of the cam, and the radius.
    fn contact(mut self, disc: &Disc) -> Option<ContactReplacement> {
        let cam = self.at.cam;
        let [x, y, radius] = self.curvature(disc);
        let (x, y) = (self.define("kx", x), self.define("ky", y));
        let radius = self.define("rho", radius);
        if is_about_pivot(disc, self.rates.is_none()) {
            return Some(ContactReplacement {
                parameters: self.parameters,
                stands: LawReplacement::Arc { place: None, radius },
            });
        }
        let (c, s) = (format!("cos({})", cam.angle.text), format!("sin({})", cam.angle.text));
        let (x, y) = (format!("{x}*{c}+{y}*{s}"), format!("{y}*{c}-{x}*{s}"));
        let scene = self.at.scene;
        let points = &scene.links[self.at.of.0].points;
        let place = if self.at.of == scene.ground {
            RawPlace::At([
                self.quantity(format!("{}+{x}", cam.spot.x.text)),
                self.quantity(format!("{}+{y}", cam.spot.y.text)),
            ])
        } else {
            let [first, second, ..] = points[..] else { return None };
            let (from, to, turn) = match cam.pivot {
                p if p == first => (first, second, ""),
                p if p == second => (second, first, "-"),
                _ => return None,
            };
            let base = self.word(format!("{},{}", scene.point_name(from), scene.point_name(to)));
            RawPlace::InLink { base, xy: [x, y].map(|t| self.quantity(format!("{turn}({t})"))) }
        };
        Some(ContactReplacement {
            parameters: self.parameters,
            stands: LawReplacement::Arc { place: Some(place), radius },
        })
    }
}

/// True if a face touches the arc about the pivot of the cam: in a dwell.
fn is_about_pivot(disc: &Disc, dwells: bool) -> bool {
    dwells && matches!(disc.touch, FollowerTip::Flat { .. })
}

/// Limit of the distance of a usable centre of curvature, as a multiple of the size of the cam:
/// beyond it, double precision loses too many digits.
const FAR: f64 = 1e4;

/// Least distance of a usable centre of curvature from the pivot, as a fraction of the size of the
/// cam. A nearer centre occurs at the beginning or end of a dwell; its direction from the pivot is
/// too uncertain to determine a face.
const NEAR: f64 = 1e-7;

/// Writes the replacement for the contact of a law at an angle φ; the names of its parameters begin
/// with `name`.
pub(super) fn written(
    at: &At,
    disc: &Disc,
    program: &StageProgram,
    law: &LawText,
    (phi, side): (f64, PieceSide),
    name: &str,
) -> Option<ContactReplacement> {
    let dwells = program.stage(phi, side).is_none_or(|(i, ..)| program.stages()[i].law().is_none());
    let apart = |s: &CamStation| (s.contact - s.normal * s.rho).norm() > NEAR * s.contact.norm();
    let told = |s: &CamStation| {
        matches!(disc.touch, FollowerTip::Point { .. }) || is_about_pivot(disc, dwells) || apart(s)
    };
    let near = disc
        .station(phi, side)
        .is_some_and(|s| s.rho_pitch.abs() <= FAR * s.pitch.norm() && told(&s));
    let texts = || StageTexts::new(at, disc, program, law, (phi, side), name);
    let arc = if near { texts().and_then(|t| t.contact(disc)) } else { None };
    arc.or_else(|| Some(texts()?.driver(disc)))
}
