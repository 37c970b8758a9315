//! Random cams with their scenes, and their answers by formulas of this file in long numbers:
//! derivatives by differences, angles of phases from triangles.

use crate::cam_laws::{ends, normal};
use crate::rng::Rng;
use hodograph::geom::Vec2;
use hodograph::number::{Big, Real};

type Place = Vec2<Big>;

/// A decimal with its text.
#[derive(Clone, Debug)]
pub struct Number(pub String);

impl Number {
    pub fn of(rng: &mut Rng, low: f64, high: f64) -> Number {
        let decimals = rng.below(4);
        Number(format!("{:.decimals$}", rng.between(low, high)))
    }

    pub fn approx(&self) -> f64 {
        self.0.parse().unwrap()
    }

    pub fn exact(&self) -> Big {
        self.0
            .strip_prefix('-')
            .map_or_else(|| Big::from_decimal(&self.0), |t| -Big::from_decimal(t))
    }

    pub fn metres(&self) -> Big {
        self.exact() / whole(1000)
    }

    pub fn radians(&self) -> Big {
        self.exact() * Big::pi() / whole(180)
    }
}

pub fn whole(n: i32) -> Big {
    Big::from_f64(f64::from(n))
}

fn arc_cosine(x: Big) -> Big {
    ((whole(1) - x) * (whole(1) + x)).sqrt().atan2(x)
}

/// A follower: (offset) on a vertical guide, (pivot, arm) on an arm to the right of the line from
/// its pivot to O, or a face perpendicular to a vertical guide.
#[derive(Clone, Debug)]
pub enum Follower {
    Guide(Number),
    Arm([Number; 2], Number),
    Face,
}

/// Stages of a law: name, gain, angle; or the radius of nose and flank (0: a tangent) and the
/// distance of the centres.
#[derive(Clone, Debug)]
pub enum Profile {
    Law(Vec<(&'static str, Number, Number)>),
    Arcs { nose: Number, flank: Number, apart: Number },
}

#[derive(Clone, Debug)]
pub struct Cam {
    pub follower: Follower,
    pub end: Number,
    pub base: Number,
    pub profile: Profile,
    angle: Number,
    clockwise: bool,
}

const LAWS: [&str; 7] =
    ["parabolic", "harmonic", "cycloidal", "3-4-5", "4-5-6-7", "modified-sine", "uniform"];

impl Cam {
    pub fn of(seed: u64) -> Cam {
        let mut rng = Rng::new(seed + 4711);
        let law = rng.chance(0.6);
        let follower = match rng.below(3) {
            0 => Follower::Guide(Number::of(&mut rng, -9.0, 9.0)),
            1 => Follower::Arm(
                [Number::of(&mut rng, 80.0, 95.0), Number::of(&mut rng, -15.0, 15.0)],
                Number::of(&mut rng, 68.0, 80.0),
            ),
            _ => Follower::Face,
        };
        let end = if rng.chance(0.2) { Number("0".into()) } else { Number::of(&mut rng, 3.0, 9.0) };
        let base = Number::of(&mut rng, 24.0, 33.0);
        let profile = if law {
            let swings = matches!(follower, Follower::Arm(..));
            let gain = if swings {
                Number::of(&mut rng, 6.0, 18.0)
            } else {
                Number::of(&mut rng, 6.0, 22.0)
            };
            let [rise, dwell, back] = [
                Number::of(&mut rng, 70.0, 140.0),
                Number::of(&mut rng, 10.0, 60.0),
                Number::of(&mut rng, 70.0, 140.0),
            ];
            let rest =
                Number(format!("{:.4}", 360.0 - rise.approx() - dwell.approx() - back.approx()));
            let [out, home] = [LAWS[rng.below(7)], LAWS[rng.below(7)]];
            let none = Number("0".into());
            Profile::Law(vec![
                (out, gain.clone(), rise),
                ("", none.clone(), dwell),
                (home, Number(format!("-{}", gain.0)), back),
                ("", none.clone(), rest),
            ])
        } else {
            let flank = match (rng.below(3), &follower) {
                (0, Follower::Guide(_) | Follower::Arm(..)) => Number("0".into()),
                (1, Follower::Guide(_) | Follower::Arm(..)) => Number::of(&mut rng, -120.0, -60.0),
                _ => Number::of(&mut rng, 65.0, 110.0),
            };
            Profile::Arcs {
                nose: Number::of(&mut rng, 6.0, 14.0),
                flank,
                apart: Number::of(&mut rng, 22.0, 33.0),
            }
        };
        let angle = Number(format!("{:.1$}", rng.between(0.0, 360.0), rng.below(9)));
        let clockwise = law && rng.chance(0.5);
        Cam { follower, end, base, profile, angle, clockwise }
    }

    /// φ at the instant.
    pub fn turned(&self) -> Big {
        let turn = self.angle.radians();
        if self.clockwise && turn.approx() > 0.0 { Big::pi() + Big::pi() - turn } else { turn }
    }

    pub fn swings(&self) -> bool {
        matches!(self.follower, Follower::Arm(..))
    }

    pub fn text(&self) -> String {
        let (links, more, guide, side) = match &self.follower {
            Follower::Guide(e) => (
                r#""1": ["O"], "3": ["B"]"#.to_owned(),
                String::new(),
                format!(
                    r#""guides": [{{"pin": "B", "slider": "3", "on": "1", "through": ["{} mm", 0], "angle": "90 deg"}}],"#,
                    e.0
                ),
                "",
            ),
            Follower::Arm([x, y], arm) => (
                r#""1": ["O", "P"], "3": ["P", "B"]"#.to_owned(),
                format!(r#", "P": ["{} mm", "{} mm"]"#, x.0, y.0),
                format!(r#""lengths": {{"PB": "{} mm" LENGTHS}},"#, arm.0),
                r#""side": {"B": "right of PO"},"#,
            ),
            Follower::Face => (
                r#""1": ["O"]"#.to_owned(),
                String::new(),
                r#""guides": [{"slider": "3", "on": "1", "angle": "90 deg", "through": "O"}],"#
                    .to_owned(),
                "",
            ),
        };
        let touch = match (&self.follower, self.end.approx()) {
            (Follower::Face, _) => r#""face": {}"#.to_owned(),
            (_, 0.0) => r#""edge": "B""#.to_owned(),
            (_, _) => format!(r#""roller": {{"pin": "B", "radius": "{} mm"}}"#, self.end.0),
        };
        let unit = if self.swings() { "deg" } else { "mm" };
        let (cam, profile, lengths) = match &self.profile {
            Profile::Law(stages) => {
                let stage =
                    |(law, gain, over): &(&str, Number, Number)| match gain.0.strip_prefix('-') {
                        _ if law.is_empty() => format!(r#"{{"dwell": "{} deg"}}"#, over.0),
                        Some(back) => format!(
                            r#"{{"return": "{back} {unit}", "over": "{} deg", "law": "{law}"}}"#,
                            over.0
                        ),
                        None => format!(
                            r#"{{"rise": "{} {unit}", "over": "{} deg", "law": "{law}"}}"#,
                            gain.0, over.0
                        ),
                    };
                let sense = if self.clockwise { r#""turns": "clockwise", "# } else { "" };
                let stages: Vec<String> = stages.iter().map(stage).collect();
                (
                    r#""O""#,
                    format!(
                        r#"{{"base": "{} mm", {sense}"law": [{}]}}"#,
                        self.base.0,
                        stages.join(", ")
                    ),
                    String::new(),
                )
            }
            Profile::Arcs { nose, flank, apart } => {
                let flank = if flank.approx() == 0.0 {
                    r#""tangent""#.to_owned()
                } else {
                    format!(r#"{{"radius": "{} mm"}}"#, flank.0)
                };
                let circle = |centre: &str, r: &Number| {
                    format!(r#"{{"centre": "{centre}", "radius": "{} mm"}}"#, r.0)
                };
                let list = format!(
                    "[{}, {flank}, {}, {flank}]",
                    circle("O", &self.base),
                    circle("Q", nose)
                );
                (r#""O", "Q""#, list, format!(r#""OQ": "{} mm""#, apart.0))
            }
        };
        let guide = match (guide.contains("LENGTHS"), lengths.is_empty()) {
            (true, true) => guide.replace("LENGTHS", ""),
            (true, false) => guide.replace("LENGTHS", &format!(", {lengths}")),
            (false, true) => guide,
            (false, false) => format!(r#"{guide} "lengths": {{{lengths}}},"#),
        };
        let find = if self.swings() { r#""psi_3", "Psi_3""# } else { r#""s_3", "h_3""# };
        format!(
            r#"{{"links": {{"2": [{cam}], {links}}}, "ground": "1", "points": {{"O": [0, 0]{more}}}, {guide} {side}
            "cams": [{{"cam": "2", "follower": "3", {touch}, "profile": {profile}}}],
            "driver": {{"link": "2", "angle": "{} deg", "omega": "3 rad/s"}}, "find": [{find}, "Phi_3", "pressure_3", "rho_2/3", "rho_min_2"]}}"#,
            self.angle.0
        )
    }
}

/// The step of differences: its square is less than the rounding of 640 bits over the same square.
fn step() -> Big {
    Big::from_f64(2f64.powi(-140))
}

/// First and second difference quotient.
pub fn differences<T: Copy + std::ops::Sub<Output = T> + std::ops::Mul<Big, Output = T>>(
    f: &dyn Fn(Big) -> T,
    at: Big,
) -> [T; 2] {
    let h = step();
    let [a, b, c] = [f(at - h), f(at), f(at + h)];
    [(c - a) * (whole(1) / (h + h)), ((c - b) - (b - a)) * (whole(1) / (h * h))]
}

/// The branch of a law about an angle: stage, part of its law.
pub type Branch = (usize, usize);

/// A cam by a law in long numbers.
pub struct ByLaw<'a> {
    pub cam: &'a Cam,
    pub stages: &'a [(&'static str, Number, Number)],
    /// The base circle (m).
    pub base: Big,
}

impl ByLaw<'_> {
    pub fn starts(&self) -> Vec<Big> {
        let mut at = whole(0);
        let mut all = vec![at];
        all.extend(self.stages.iter().map(|s| {
            at = at + s.2.radians();
            at
        }));
        all
    }

    pub fn branch(&self, phi: f64) -> Branch {
        let starts = self.starts();
        let stage = (0..4).rev().find(|k| starts[*k].approx() <= phi).unwrap();
        let x = (phi - starts[stage].approx()) / self.stages[stage].2.radians().approx();
        (stage, ends(self.stages[stage].0).iter().position(|e| x < *e).unwrap_or(0))
    }

    pub fn lift(&self, (stage, part): Branch, phi: Big) -> Big {
        let gain = |n: &Number| if self.cam.swings() { n.radians() } else { n.metres() };
        let before = self.stages[..stage].iter().fold(whole(0), |sum, s| sum + gain(&s.1));
        let (law, h, over) = &self.stages[stage];
        if law.is_empty() {
            return before;
        }
        before + gain(h) * normal(law, (phi - self.starts()[stage]) / over.radians(), part)
    }

    pub fn sense(&self) -> Big {
        whole(1 - 2 * i32::from(self.cam.clockwise))
    }

    /// The follower's point in the plane and its outward direction.
    fn at(&self, lift: Big) -> (Place, Place) {
        self.cam.stands(self.base + self.cam.end.metres(), lift)
    }

    /// The pressure angle and the radius of curvature of the profile.
    pub fn bent(&self, branch: Branch, phi: Big) -> [Big; 2] {
        let into = |v: Place, phi: Big| v.rotate_by(Vec2::from_angle(-(self.sense() * phi)));
        if let Follower::Face = self.cam.follower {
            let s = |phi: Big| self.base + self.lift(branch, phi);
            return [whole(0), s(phi) + differences(&s, phi)[1]];
        }
        let pitch = |phi: Big| into(self.at(self.lift(branch, phi)).0, phi);
        let [v, a] = differences(&pitch, phi);
        let speed = v.norm();
        let rho = speed * speed * speed / (-(self.sense() * v.cross(a))) - self.cam.end.metres();
        let out = into(self.at(self.lift(branch, phi)).1, phi);
        let across = v.perp() * (self.sense() / speed);
        [self.sense() * out.cross(across).atan2(out.dot(across)), rho]
    }

    /// The answers in the order of the questions; the least radius only if requested.
    pub fn answers(&self, least: bool) -> [Option<Big>; 6] {
        let phi = self.cam.turned();
        let branch = self.branch(phi.approx());
        let [pressure, rho] = self.bent(branch, phi);
        let gain = &self.stages[0].1;
        let gain = if self.cam.swings() { gain.radians() } else { gain.metres() };
        let least = least.then(|| self.least());
        [
            Some(self.lift(branch, phi)),
            Some(gain),
            Some(self.stages[0].2.radians()),
            Some(pressure),
            Some(rho),
            least,
        ]
    }

    /// The least radius of curvature; for round ends only where the pitch curve is convex.
    pub fn least(&self) -> Big {
        let mut least: Option<Big> = None;
        let starts = self.starts();
        let convex = |rho: Big| {
            matches!(self.cam.follower, Follower::Face)
                || rho.approx() + self.cam.end.metres().approx() > 0.0
        };
        let mut consider = |rho: Big| {
            if convex(rho) && least.is_none_or(|l| rho.approx() < l.approx()) {
                least = Some(rho);
            }
        };
        for (k, (law, _, over)) in self.stages.iter().enumerate() {
            let mut from = 0.0;
            for (part, end) in ends(law).iter().enumerate() {
                let at = |x: f64| starts[k] + Big::from_f64(x) * over.radians();
                let rho = |phi: Big| self.bent((k, part), phi)[1];
                const STEPS: usize = 24;
                let samples: Vec<(Big, Big)> = (0..=STEPS)
                    .map(|i| at(from + (end - from) * i as f64 / STEPS as f64))
                    .map(|phi| (phi, rho(phi)))
                    .collect();
                consider(samples[0].1);
                consider(samples[STEPS].1);
                let falls: Vec<bool> =
                    samples.iter().map(|(phi, _)| slope(&rho, *phi).approx() < 0.0).collect();
                for (w, falls) in samples.windows(2).zip(falls.windows(2)) {
                    if falls[0] && !falls[1] && convex(w[0].1) && convex(w[1].1) {
                        consider(rho(bottom(&rho, w[0].0, w[1].0)));
                    }
                }
                from = *end;
            }
        }
        least.unwrap()
    }
}

/// A derivative, by wider differences than those within the function.
pub fn slope(f: &dyn Fn(Big) -> Big, x: Big) -> Big {
    let wide = Big::from_f64(WIDE);
    (f(x + wide) - f(x - wide)) / (wide + wide)
}

const WIDE: f64 = 1.0 / (1u128 << 70) as f64;

/// The place of a function's minimum between two places: bisection of the slope, then Newton's
/// method on difference quotients.
pub fn bottom(f: &dyn Fn(Big) -> Big, mut a: Big, mut b: Big) -> Big {
    for _ in 0..20 {
        let middle = (a + b) / whole(2);
        if slope(f, middle).approx() > 0.0 { b = middle } else { a = middle }
    }
    let (mut x, wide) = ((a + b) / whole(2), Big::from_f64(WIDE));
    for _ in 0..4 {
        let bend = (f(x + wide) - f(x) - (f(x) - f(x - wide))) / (wide * wide);
        x = x - slope(f, x) / bend;
    }
    x
}

impl Cam {
    /// The follower's point at a lift above its place at the distance `reach` from O, and its
    /// outward direction.
    fn stands(&self, reach: Big, lift: Big) -> (Place, Place) {
        match &self.follower {
            Follower::Guide(e) => {
                let e = e.metres();
                (Vec2::new(e, (reach * reach - e * e).sqrt() + lift), Vec2::new(whole(0), whole(1)))
            }
            Follower::Arm([x, y], arm) => {
                let (p, l) = (Vec2::new(x.metres(), y.metres()), arm.metres());
                let d = p.norm();
                let q = arc_cosine((d * d + l * l - reach * reach) / (whole(2) * d * l)) + lift;
                let arm = Vec2::from_angle((-p).angle() - q);
                (p + arm * l, -arm.perp())
            }
            Follower::Face => (Vec2::new(whole(0), reach + lift), Vec2::new(whole(0), whole(1))),
        }
    }

    /// The coordinate of the follower for a place of its point: along the guide, or the angle of
    /// the arm from PO.
    fn coordinate(&self, at: Place) -> Big {
        match &self.follower {
            Follower::Guide(_) | Follower::Face => at.y,
            Follower::Arm([x, y], _) => {
                let p = Vec2::new(x.metres(), y.metres());
                let (b, o) = (at - p, -p);
                b.cross(o).atan2(b.dot(o))
            }
        }
    }

    /// Lift, stroke, rise, pressure angle, radius (`None`: infinite) and least radius for a profile
    /// of arcs, touched on a given piece.
    pub fn of_arcs(&self, piece: usize) -> [Option<Big>; 6] {
        let Profile::Arcs { nose, flank, apart } = &self.profile else { panic!() };
        let (r1, r2, r, d, end) =
            (self.base.metres(), nose.metres(), flank.metres(), apart.metres(), self.end.metres());
        let hollow = flank.approx() < 0.0;
        // The normal of the upper flank where it leaves the base circle, and the flank's centre.
        let (joint, centre) = if flank.approx() == 0.0 {
            (arc_cosine((r1 - r2) / d), None)
        } else {
            let (a, b) = (r - r1, r - r2);
            let foot = (d * d + a * a - b * b) / (whole(2) * d);
            let height = (a * a - foot * foot).sqrt();
            let centre = Vec2::new(foot, if hollow { height } else { -height });
            (if hollow { centre.angle() } else { (-centre).angle() }, Some(centre))
        };
        let turned = |v: Place| v.rotate_by(Vec2::from_angle(self.angle.radians()));
        let face = matches!(self.follower, Follower::Face);
        let end = if face { whole(0) } else { end };
        let (home, top) =
            (self.stands(r1 + end, whole(0)).0, self.stands(d + r2 + end, whole(0)).0);
        let rise = if face { joint } else { top.angle() - home.angle() + joint };
        let low = self.coordinate(home);
        // The piece: 0 about O, 1 the lower flank, 2 about Q, 3 the upper flank.
        let (k, radius) = match piece {
            0 => (Some(Vec2::zero()), Some(r1)),
            2 => (Some(Vec2::new(d, whole(0))), Some(r2)),
            1 => (centre.map(|c| Vec2::new(c.x, -c.y)), centre.map(|_| r)),
            _ => (centre, centre.map(|_| r)),
        };
        let up = Vec2::new(whole(0), whole(1));
        let (at, across) = match (k, &self.follower) {
            (Some(k), Follower::Face) => (turned(k) + up * radius.unwrap(), up),
            (Some(k), Follower::Guide(e)) => {
                let (k, reach) = (turned(k), radius.unwrap() + end);
                let aside = k.x - e.metres();
                let h = (reach * reach - aside * aside).sqrt();
                let at = Vec2::new(e.metres(), k.y + if hollow && piece % 2 == 1 { -h } else { h });
                (at, (at - k) * (whole(1) / reach))
            }
            (Some(k), Follower::Arm([x, y], arm)) => {
                // The intersection of two circles on the side of the follower.
                let (k, reach) = (turned(k), radius.unwrap() + end);
                let (p, l) = (Vec2::new(x.metres(), y.metres()), arm.metres());
                let way = k - p;
                let apart = way.norm();
                let foot = (apart * apart + l * l - reach * reach) / (whole(2) * apart);
                let h = (l * l - foot * foot).sqrt();
                let u = way * (whole(1) / apart);
                let at = p + u * foot - u.perp() * if hollow && piece % 2 == 1 { -h } else { h };
                (at, (at - k) * (whole(1) / reach))
            }
            (None, follower) => {
                let n = turned(Vec2::from_angle(if piece == 3 { joint } else { -joint }));
                let far = r1 + end;
                let at = match follower {
                    Follower::Guide(e) => Vec2::new(e.metres(), (far - e.metres() * n.x) / n.y),
                    Follower::Arm([x, y], arm) => {
                        let (p, l) = (Vec2::new(x.metres(), y.metres()), arm.metres());
                        let along = far - p.dot(n);
                        p + n * along + n.perp() * (l * l - along * along).sqrt()
                    }
                    Follower::Face => panic!("a face lies on no tangent"),
                };
                (at, n)
            }
        };
        let out = match &self.follower {
            Follower::Guide(_) | Follower::Face => up,
            Follower::Arm([x, y], arm) => {
                -((at - Vec2::new(x.metres(), y.metres())) * (whole(1) / arm.metres())).perp()
            }
        };
        let pressure = out.cross(across).atan2(out.dot(across));
        let least = if r2.approx() < r1.approx() { r2 } else { r1 };
        [
            Some(self.coordinate(at) - low),
            Some(self.coordinate(top) - low),
            Some(rise),
            Some(pressure),
            radius,
            Some(least),
        ]
    }
}
