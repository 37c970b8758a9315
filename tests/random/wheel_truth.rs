//! Random gear trains, belts and rolling wheels with their scenes, and their answers by formulas of
//! this file in long numbers: ratios of teeth, intersections of circles and lines, differences of
//! these.

use crate::cam_truth::{Number, whole};
use crate::rng::Rng;
use hodograph::answer::AnswerValue;
use hodograph::geom::{Point, Vec2};
use hodograph::number::{Big, Real};

type V = Vec2<Big>;

/// A scene and its true answers, by the texts of its questions; the latter in a region of long
/// numbers.
pub struct Told {
    pub text: String,
    pub truth: Box<dyn Fn() -> Vec<(String, AnswerValue<Big>)>>,
}

/// A growing list of answers.
#[derive(Default)]
struct Answers(Vec<(String, AnswerValue<Big>)>);

impl Answers {
    fn scalar(&mut self, text: impl Into<String>, x: Big) {
        self.0.push((text.into(), AnswerValue::Scalar(x)));
    }

    fn rates(&mut self, link: &str, [omega, alpha]: [Big; 2]) {
        self.scalar(format!("omega_{link}"), omega);
        self.scalar(format!("alpha_{link}"), alpha);
    }

    fn moves(&mut self, point: &str, [v, a]: [V; 2]) {
        self.0.push((format!("v_{point}"), AnswerValue::Vector(v)));
        self.0.push((format!("a_{point}"), AnswerValue::Vector(a)));
    }

    fn place(&mut self, text: &str, at: V) {
        self.0.push((text.into(), AnswerValue::Point(at.to_point())));
    }
}

/// Velocity and acceleration of a point at `arm` from a point with a known motion, on a link with
/// this angular velocity and acceleration.
fn carried([v, a]: [V; 2], [omega, alpha]: [Big; 2], arm: V) -> [V; 2] {
    [v + arm.perp() * omega, a + arm.perp() * alpha - arm * (omega * omega)]
}

fn rested() -> [V; 2] {
    [V::zero(); 2]
}

fn questions(of: &str) -> String {
    let list: Vec<String> = of.split(' ').map(|q| format!("\"{q}\"")).collect();
    list.join(", ")
}

fn rate(rng: &mut Rng) -> [Number; 2] {
    let sign = if rng.chance(0.5) { "-" } else { "" };
    let omega = Number::of(rng, 1.0, 20.0);
    [Number(format!("{sign}{}", omega.0)), Number::of(rng, -30.0, 30.0)]
}

fn exact(pair: &[Number; 2]) -> [Big; 2] {
    pair.each_ref().map(Number::exact)
}

fn driver(link: &str, [omega, alpha]: &[Number; 2]) -> String {
    format!(r#"{{"link": "{link}", "omega": "{} rad/s", "alpha": "{} rad/s^2"}}"#, omega.0, alpha.0)
}

/// Sun, planet, ring and arm: one of them is fixed, and others are driven.
pub fn planetary(rng: &mut Rng) -> Told {
    let (sun, planet) = (12 + rng.below(50), 12 + rng.below(50));
    let (module, phi, first, second) =
        (Number::of(rng, 1.0, 6.0), Number::of(rng, -170.0, 170.0), rate(rng), rate(rng));
    let out = [Number::of(rng, -40.0, 40.0), Number::of(rng, -40.0, 40.0)];
    let kind = rng.below(4);
    let ring = sun + 2 * planet;
    // The link of the sun, and of the ring.
    let [s, r] = [["2", "1"], ["2", "1"], ["1", "5"], ["2", "5"]][kind];
    let drivers = match kind {
        0 => driver("2", &first),
        1 => driver("3", &first),
        2 => driver("5", &first),
        _ => format!("[{}, {}]", driver("2", &first), driver("5", &second)),
    };
    let mut links = r#""1": ["O"], "3": ["O", "P"], "4": ["P", "M"]"#.to_owned();
    [s, r].iter().filter(|l| **l != "1").for_each(|l| links += &format!(r#", "{l}": ["O"]"#));
    let asked = match kind {
        0 | 1 => {
            "omega_2 alpha_2 omega_3 alpha_3 omega_4 alpha_4 i_23 i_24/3 v_P a_P v_M a_M v_K4 a_K4 v_E4 a_E4 P_2,4 P_1,4 rho_M J_4 d_4"
        }
        2 => {
            "omega_5 alpha_5 omega_3 alpha_3 omega_4 alpha_4 i_53 i_54/3 v_P a_P v_M a_M v_K4 a_K4 v_E4 a_E4 P_4,5 P_1,4 rho_M J_4 d_4"
        }
        _ => {
            "omega_3 alpha_3 omega_4 alpha_4 i_23 i_53 i_24/3 v_P a_P v_M a_M v_K4 a_K4 v_E4 a_E4 P_2,4 P_4,5 P_1,4 rho_M"
        }
    };
    let text = format!(
        r#"{{"parameters": {{"m0": "{} mm", "phi": "{} deg", "a": "m0*{}/2"}}, "links": {{{links}}}, "ground": "1",
        "points": {{"O": [0, 0], "P": ["a*cos(phi)", "a*sin(phi)"], "M": ["a*cos(phi) + {} mm", "a*sin(phi) + {} mm"]}},
        "gears": [{{"links": ["{s}", "4"], "centres": ["O", "P"], "teeth": [{sun}, {planet}], "module": "m0", "at": "K"}},
        {{"links": ["4", "{r}"], "centres": ["P", "O"], "teeth": [{planet}, {ring}], "module": "m0", "ring": "{r}", "at": "E"}}],
        "driver": {drivers}, "find": [{}]}}"#,
        module.0,
        phi.0,
        sun + planet,
        out[0].0,
        out[1].0,
        questions(asked)
    );
    let truth = move || {
        let mut all = Answers::default();
        let z = |n: usize| whole(n as i32);
        let both = sun + planet;
        let [first, second] = [exact(&first), exact(&second)];
        let of = |f: &dyn Fn(Big, Big) -> Big| [0, 1].map(|k| f(first[k], second[k]));
        let arm = match kind {
            0 => of(&|w, _| w * z(sun) / z(2 * both)),
            1 => first,
            2 => of(&|w, _| w * z(ring) / z(2 * both)),
            _ => of(&|w, u| (w * z(sun) + u * z(ring)) / z(2 * both)),
        };
        let turns: [[Big; 2]; 2] = match kind {
            0 => [first, [whole(0); 2]],
            1 => [arm.map(|w| w * z(2 * both) / z(sun)), [whole(0); 2]],
            2 => [[whole(0); 2], first],
            _ => [first, second],
        };
        let wheel = [0, 1].map(|k| (arm[k] * z(both) - turns[0][k] * z(sun)) / z(planet));
        for (link, rates) in [("2", turns[0]), ("5", turns[1]), ("3", arm), ("4", wheel)] {
            all.rates(link, rates);
        }
        all.scalar("i_23", turns[0][0] / arm[0]);
        all.scalar("i_53", turns[1][0] / arm[0]);
        all.scalar("i_24/3", -z(planet) / z(sun));
        all.scalar("i_54/3", z(planet) / z(ring));
        let out_of = Vec2::from_angle(phi.radians());
        let [a, small, r] = [both, sun, planet].map(|n| module.metres() * z(n) / whole(2));
        let pin = carried(rested(), arm, out_of * a);
        all.moves("P", pin);
        let offset = V::new(out[0].metres(), out[1].metres());
        let m = carried(pin, wheel, offset);
        all.moves("M", m);
        all.moves("K4", carried(pin, wheel, out_of * -r));
        all.moves("E4", carried(pin, wheel, out_of * r));
        all.place("P_2,4", out_of * small);
        all.place("P_4,5", out_of * (a + r));
        // On the line of centres, where the planet's point is at rest.
        let pole = a - arm[0] * a / wheel[0];
        all.place("P_1,4", out_of * pole);
        // The pole stays at its distance from O, and rotates with the arm: u = ω₃ × OP, PJ = −i
        // u/ω₄.
        all.place("J_4", out_of * (pole + pole * arm[0] / wheel[0]));
        let d = pole * arm[0] / wheel[0];
        all.scalar("d_4", if d.approx() < 0.0 { -d } else { d });
        let (speed, turn) = (m[0].norm(), m[0].cross(m[1]));
        let rho = speed * speed * speed / turn;
        all.scalar("rho_M", if rho.approx() < 0.0 { -rho } else { rho });
        all.0
    };
    Told { text, truth: Box::new(truth) }
}

/// Wheels on fixed axes: two pairs of gears one behind the other, the second external or in a ring,
/// and a belt behind them.
pub fn in_a_row(rng: &mut Rng) -> Told {
    let z = [0; 4].map(|_| 12 + rng.below(60));
    let inside = rng.chance(0.4);
    let z = if inside { [z[0], z[1], z[2], z[2] + z[3]] } else { z };
    let (m, angles, turns) = (
        [0; 2].map(|_| Number::of(rng, 1.0, 5.0)),
        [0; 3].map(|_| Number::of(rng, -170.0, 170.0)),
        rate(rng),
    );
    let pulleys = [0; 2].map(|_| Number::of(rng, 30.0, 80.0));
    let (reach, crossed) = (Number::of(rng, 200.0, 300.0), rng.chance(0.5));
    let second = if inside { z[3] - z[2] } else { z[2] + z[3] };
    let asked = "omega_2 alpha_2 omega_3 alpha_3 omega_4 alpha_4 omega_5 alpha_5 i_24 i_25 i_52 v_K2 v_K3 a_K2 a_K3 v_L3 a_L4 P_2,3 P_3,4";
    let ring = if inside { r#", "ring": "4""# } else { "" };
    let text = format!(
        r#"{{"parameters": {{"d1": "{} mm*{}/2", "d2": "{} mm*{second}/2", "t1": "{} deg", "t2": "{} deg", "t3": "{} deg"}},
        "links": {{"1": ["O", "Q", "R", "S"], "2": ["O"], "3": ["Q"], "4": ["R"], "5": ["S"]}}, "ground": "1",
        "points": {{"O": [0, 0], "Q": ["d1*cos(t1)", "d1*sin(t1)"], "R": ["d1*cos(t1) + d2*cos(t2)", "d1*sin(t1) + d2*sin(t2)"],
        "S": ["d1*cos(t1) + d2*cos(t2) + {} mm*cos(t3)", "d1*sin(t1) + d2*sin(t2) + {} mm*sin(t3)"]}},
        "gears": [{{"links": ["2", "3"], "centres": ["O", "Q"], "teeth": [{}, {}], "module": "{} mm", "at": "K"}},
        {{"links": ["3", "4"], "centres": ["Q", "R"], "teeth": [{}, {}], "module": "{} mm"{ring}, "at": "L"}}],
        "belts": [{{"pulleys": ["4", "5"], "centres": ["R", "S"], "radii": ["{} mm", "{} mm"], "crossed": {crossed}}}],
        "driver": {}, "find": [{}]}}"#,
        m[0].0,
        z[0] + z[1],
        m[1].0,
        angles[0].0,
        angles[1].0,
        angles[2].0,
        reach.0,
        reach.0,
        z[0],
        z[1],
        m[0].0,
        z[2],
        z[3],
        m[1].0,
        pulleys[0].0,
        pulleys[1].0,
        driver("2", &turns),
        questions(asked)
    );
    let truth = move || {
        let mut all = Answers::default();
        let teeth = z.map(|n| whole(n as i32));
        let two = exact(&turns);
        let three = two.map(|w| -w * teeth[0] / teeth[1]);
        let sign = whole(if inside { 1 } else { -1 });
        let four = three.map(|w| sign * w * teeth[2] / teeth[3]);
        let belt = whole(if crossed { -1 } else { 1 });
        let five = four.map(|w| belt * w * pulleys[0].exact() / pulleys[1].exact());
        for (link, rates) in [("2", two), ("3", three), ("4", four), ("5", five)] {
            all.rates(link, rates);
        }
        all.scalar("i_24", two[0] / four[0]);
        all.scalar("i_25", two[0] / five[0]);
        all.scalar("i_52", five[0] / two[0]);
        let [along, next] = [&angles[0], &angles[1]].map(|a| Vec2::from_angle(a.radians()));
        let radius = |m: &Number, z: Big| m.metres() * z / whole(2);
        let r: Vec<Big> = (0..4).map(|k| radius(&m[k / 2], teeth[k])).collect();
        all.moves("K2", carried(rested(), two, along * r[0]));
        all.moves("K3", carried(rested(), three, along * -r[1]));
        // A wheel in a ring touches it beyond its own centre, seen from that of the ring.
        let way = if inside { -next } else { next };
        all.moves("L3", carried(rested(), three, way * r[2]));
        all.moves("L4", carried(rested(), four, if inside { way * r[3] } else { way * -r[3] }));
        all.place("P_2,3", along * r[0]);
        all.place("P_3,4", along * (r[0] + r[1]) + way * r[2]);
        all.0
    };
    Told { text, truth: Box::new(truth) }
}

/// The step of differences.
fn step() -> Big {
    Big::from_f64(2f64.powi(-180))
}

/// A crank and a rod that draw a wheel along a straight track, or on a round one, outside or
/// inside.
pub fn drawn(rng: &mut Rng) -> Told {
    let (crank, rod, r) =
        (Number::of(rng, 20.0, 50.0), Number::of(rng, 120.0, 180.0), Number::of(rng, 10.0, 40.0));
    let (phi, turns, lean) = (Number::of(rng, 0.0, 360.0), rate(rng), Number::of(rng, -40.0, 40.0));
    let (x, y, track) = (
        Number::of(rng, -20.0, 20.0),
        Number::of(rng, -40.0, -20.0),
        Number::of(rng, 150.0, 220.0),
    );
    let kind = rng.below(3);
    // The middle of a round track is below or above the path of the centre.
    let middle = [Number::of(rng, 100.0, 160.0), Number::of(rng, 120.0, 160.0)];
    let below = rng.chance(0.5);
    let middle =
        [middle[0].clone(), Number(format!("{}{}", if below { "-" } else { "" }, middle[1].0))];
    let places = {
        let (crank, rod, r, phi, turns, lean) =
            (crank.clone(), rod.clone(), r.clone(), phi.clone(), turns.clone(), lean.clone());
        let (x, y, track, middle) = (x.clone(), y.clone(), track.clone(), middle.clone());
        // Crank pin, wheel's centre and the normal from the track to it, at a time.
        move |t: Big| -> [V; 3] {
            let [w, a] = exact(&turns);
            let a = Vec2::from_angle(phi.radians() + w * t + a * t * t / whole(2)) * crank.metres();
            let (l, r) = (rod.metres(), r.metres());
            if kind == 0 {
                let u = Vec2::from_angle(lean.radians());
                let from = V::new(x.metres(), y.metres()) + u.perp() * r;
                let (along, aside) = ((a - from).dot(u), (a - from).cross(u));
                return [a, from + u * (along + (l * l - aside * aside).sqrt()), u.perp()];
            }
            let k = V::new(middle[0].metres(), middle[1].metres());
            let reach = if kind == 1 { track.metres() + r } else { track.metres() - r };
            let way = k - a;
            let d = way.norm();
            let foot = (d * d + l * l - reach * reach) / (whole(2) * d);
            let height = (l * l - foot * foot).sqrt();
            let u = way * (whole(1) / d);
            let c = a + u * foot + u.perp() * if below { height } else { -height };
            let out = (c - k) * (whole(1) / reach);
            [a, c, if kind == 1 { out } else { -out }]
        }
    };
    let on = match kind {
        0 => format!(
            r#""on": "1", "through": ["{} mm", "{} mm"], "angle": "{} deg""#,
            x.0, y.0, lean.0
        ),
        _ => format!(r#""track": "K", "track_radius": "{} mm", "inside": {}"#, track.0, kind == 2),
    };
    let (ground, k) = match kind {
        0 => (r#""O""#, String::new()),
        _ => (r#""O", "K""#, format!(r#", "K": ["{} mm", "{} mm"]"#, middle[0].0, middle[1].0)),
    };
    let rough = hodograph::number::within(128, || places(whole(0))[1].approx());
    let asked = "v_A a_A v_C a_C omega_3 alpha_3 omega_4 alpha_4 a_N4 P_1,4 P_1,3 P_3,4 P_1,3,C v_CA a_CA x_C y_C";
    let text = format!(
        r#"{{"links": {{"1": [{ground}], "2": ["O", "A"], "3": ["A", "C"], "4": ["C"]}}, "ground": "1", "points": {{"O": [0, 0]{k}}},
        "lengths": {{"OA": "{} mm", "AC": "{} mm"}}, "sketch": {{"C": ["{} m", "{} m"]}},
        "rolling": [{{"wheel": "4", "centre": "C", "radius": "{} mm", {on}, "at": "N"}}],
        "driver": {{"link": "2", "angle": "{} deg", "omega": "{} rad/s", "alpha": "{} rad/s^2"}}, "find": [{}]}}"#,
        crank.0,
        rod.0,
        rough.x,
        rough.y,
        r.0,
        phi.0,
        turns[0].0,
        turns[1].0,
        questions(asked)
    );
    let truth = move || {
        let mut all = Answers::default();
        let h = step();
        let [before, now, after] = [-h, whole(0), h].map(&places);
        let rates = |f: &dyn Fn([V; 3]) -> V| {
            let [p, q, s] = [before, now, after].map(f);
            [(s - p) * (whole(1) / (h + h)), ((s - q) - (q - p)) * (whole(1) / (h * h))]
        };
        let (a, c) = (rates(&|p| p[0]), rates(&|p| p[1]));
        all.moves("A", a);
        all.moves("C", c);
        all.moves("CA", [0, 1].map(|k| c[k] - a[k]));
        let turn = |p: [V; 3]| (p[1] - p[0]).divide_by(now[1] - now[0]).angle();
        let [p, s] = [turn(before), turn(after)];
        let of_rod = [(s - p) / (h + h), (s + p) / (h * h)];
        all.rates("3", of_rod);
        // Without slip: the centre moves by ω r along the track.
        let (r, n) = (r.metres(), now[2]);
        let of_wheel = [0, 1].map(|k| c[k].dot(n.perp()) / r);
        all.rates("4", of_wheel);
        all.moves("N4", carried(c, of_wheel, n * -r));
        all.place("P_1,4", now[1] - n * r);
        let crossing =
            hodograph::geom::cross_lines(Point::origin(), now[0], now[1].to_point(), n).at;
        all.place("P_1,3", crossing.to_vec2());
        all.place("P_3,4", now[1]);
        all.scalar("P_1,3,C", crossing.distance(now[1].to_point()));
        all.scalar("x_C", now[1].x);
        all.scalar("y_C", now[1].y);
        all.0
    };
    Told { text, truth: Box::new(truth) }
}
