//! Given limit positions, `"synthesis": "limits"`: a crank-rocker or slider-crank by the limit
//! places of C ([`two_places`]), and the press 压床, a crank-rocker with a rocker DCE that drives a
//! ram through EF.
//!
//! The limit angles ψ₁, ψ₂ of the press's rocker count from the upward vertical, clockwise. The
//! ram's stroke H determines DE: H = 2 DE sin((ψ₂ − ψ₁)/2) where the limits are symmetrical about
//! the horizontal; else by the secant method from there. The ratios CE/CD and EF/DE give the other
//! lengths; crank and coupler are half the difference and half the sum of AC₁ and AC₂.

mod explained;
mod two_places;

use super::board::{PaperLine, SynthesisBoard, Weight};
use super::candidate::{Demand, DesignNumber, Draft, WantedPosition, deg, mm, place};
use super::form::TaskForm;
use super::fourbar::{Heading, headed, omega};
use super::nearest::{number, told};
use super::{KindOfTask, Proof, Statement, TaskResult, Wish};
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::digits::{metres, significant};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::each;
use serde_json::{Value as Json, json};
use std::f64::consts::PI;

/// Limit positions as a kind of task.
pub const KIND: KindOfTask = KindOfTask {
    name: "limits",
    what: each!(
        "linkages by the limit positions of their output: crank-rocker, slider-crank, press"
    ),
    keys: &[
        "linkage", "rocker", "frame", "angles", "places", "x1", "x2", "y", "stroke", "CE/CD",
        "EF/DE",
    ],
    read,
};

#[derive(Clone, Debug)]
struct Press {
    /// A relative to D (m).
    a: Point,
    /// The distance of the ram's line to the right of D (m).
    x2: f64,
    angles: [f64; 2],
    stroke: f64,
    ce_cd: f64,
    ef_de: f64,
}

/// Reads the task for a linkage.
type LimitsReader = fn(&TaskForm) -> Option<Box<dyn Wish>>;

/// The linkages, each with its reader.
const LINKAGES: [(&str, LimitsReader); 3] =
    [("crank-rocker", two_places::rocker), ("slider-crank", two_places::slider), ("press", press)];

fn read(form: &TaskForm) -> Option<Box<dyn Wish>> {
    form.need("linkage", "\"crank-rocker\"")?;
    let name = form.choice("linkage", &LINKAGES.map(|l| l.0))?;
    LINKAGES.iter().find(|l| l.0 == name).and_then(|(_, read)| read(form))
}

fn press(form: &TaskForm) -> Option<Box<dyn Wish>> {
    let length = |key: &str| form.need(key, "\"50 mm\"").and_then(|n| form.length_of(n, key));
    let (x1, x2, y) = (length("x1"), length("x2"), length("y"));
    let stroke = form.need_size("stroke", "\"150 mm\"");
    let angles = form
        .need("angles", "[\"60 deg\", \"120 deg\"]")
        .and_then(|n| form.several::<2>(n, "angles", "[\"60 deg\", \"120 deg\"]"));
    let angles =
        angles.and_then(|[p, q]| form.angle_of(p, "angles").zip(form.angle_of(q, "angles")));
    let ratio = |key: &str| {
        let value = form.number_of(form.need(key, "\"1/2\"")?, key)?;
        let positive = value > 0.0;
        if !positive {
            form.fault(
                Diagnostic::error("not-positive", both!("\"{key}\" must be greater than zero"))
                    .at(form.span(key)),
            );
        }
        positive.then_some(value)
    };
    let (ce_cd, ef_de) = (ratio("CE/CD"), ratio("EF/DE"));
    if let Some((p, q)) = angles.filter(|(p, q)| !(0.0 <= *p && p < q && *q <= PI)) {
        let [p, q] = [p, q].map(|a| significant(a.to_degrees(), 4));
        let message = both!("the limits {p}° and {q}° are not two angles of 0° to 180° in order");
        let help = both!(
            "they count clockwise from the upward vertical: write the upper limit first, such as [\"60 deg\", \"120 deg\"]"
        );
        form.fault(Diagnostic::error("out-of-range", message).at(form.span("angles")).help(help));
        return None;
    }
    let (p, q) = angles?;
    Some(Box::new(Press {
        a: Point::new(x1?, -y?),
        x2: x2?,
        angles: [p, q],
        stroke: stroke?,
        ce_cd: ce_cd?,
        ef_de: ef_de?,
    }))
}

/// The unit vector at an angle from the upward vertical, clockwise.
fn from_vertical(angle: f64) -> Vec2 {
    Vec2::new(libm::sin(angle), libm::cos(angle))
}

impl Press {
    /// F below E for a rocker DE in a limit.
    fn f(&self, de: f64, angle: f64) -> Option<Point> {
        let e = from_vertical(angle) * de;
        let (ef, aside) = (de * self.ef_de, self.x2 - e.x);
        let down2 = (ef - aside) * (ef + aside);
        (down2 >= 0.0).then(|| Point::new(self.x2, e.y - down2.sqrt()))
    }

    /// DE for the stroke (m).
    fn de(&self) -> Option<f64> {
        let [p, q] = self.angles;
        let stroke = |de: f64| Some(self.f(de, p)?.y - self.f(de, q)?.y);
        let mut x = self.stroke / (libm::cos(p) - libm::cos(q));
        let mut y = stroke(x)? - self.stroke;
        let mut next = x * (1.0 - y / self.stroke.max(y.abs()) - 1e-3);
        // The secant method; each step gains up to four digits near the root.
        for _ in 0..60 {
            if y.abs() <= 1e-15 * self.stroke {
                break;
            }
            let there = stroke(next)? - self.stroke;
            let slope = (there - y) / (next - x);
            (x, y) = (next, there);
            if slope == 0.0 || !slope.is_finite() {
                break;
            }
            next = x - y / slope;
        }
        (y.abs() <= 1e-12 * self.stroke).then_some(x)
    }

    /// True if the crank turns fully: AB is the shortest link, Grashof's sum holds, and both limits
    /// of the rocker are on one side of AD.
    fn turns(&self) -> bool {
        let Some(de) = self.de().filter(|de| *de > 0.0) else { return false };
        let cd = de / (1.0 + self.ce_cd);
        let c = self.angles.map(|a| (from_vertical(a) * cd).to_point());
        let far = c.map(|c| self.a.distance(c));
        let (ab, bc, ad) =
            ((far[0] - far[1]).abs() / 2.0, (far[0] + far[1]) / 2.0, self.a.to_vec2().norm());
        let longest = bc.max(cd).max(ad);
        let sides = c.map(|c| self.a.to_vec2().cross(c.to_vec2()));
        ab > 1e-6 * bc
            && ab < bc.min(cd).min(ad)
            && 2.0 * (ab + longest) < ab + bc + cd + ad
            && sides[0] * sides[1] > 0.0
    }

    /// Warnings for a crank that does not turn fully and a ram that reverses between the limits.
    fn warned(&self) -> Vec<Diagnostic> {
        let crank = || {
            let message = both!("the crank does not turn through with A in this place");
            Diagnostic::warning("not-a-crank", message).help(self.nearest())
        };
        let ram = || {
            let message = both!("the ram turns back between the limits: EF lies down too far");
            Diagnostic::warning("not-one-way", message).help(self.nearest_line())
        };
        let crank = (!self.turns()).then(crank);
        crank.into_iter().chain((!self.one_way()).then(ram)).collect()
    }

    /// True if the ram moves in one direction while the rocker swings from limit to limit: EF must
    /// not be inclined too far.
    fn one_way(&self) -> bool {
        const STEPS: usize = 60;
        let [p, q] = self.angles;
        let Some(de) = self.de() else { return false };
        (0..=STEPS).all(|i| {
            let angle = p + (q - p) * i as f64 / STEPS as f64;
            // dF = −DE (sin ψ + tan δ cos ψ) dψ, δ the inclination of EF.
            let aside = self.x2 - de * libm::sin(angle);
            let down = ((de * self.ef_de - aside) * (de * self.ef_de + aside)).sqrt();
            libm::sin(angle) + aside / down * libm::cos(angle) > 0.0
        })
    }

    /// The nearest line of the ram on which it does not reverse and the crank turns fully.
    fn nearest_line(&self) -> Both {
        let with = |x2: f64| Press { x2: x2 * 1e-3, ..self.clone() };
        match number(self.x2 * 1e3, self.stroke * 1e3, |mm| with(mm).turns() && with(mm).one_way())
        {
            Some(mm) => {
                both!("\"x2\": \"{} mm\" does; so may a greater \"EF/DE\"", told(mm))
            }
            None => both!("take \"x2\" nearer to E, or a greater \"EF/DE\""),
        }
    }

    /// The nearest place of A with a crank that turns fully.
    fn nearest(&self) -> Both {
        let scale = self.a.to_vec2().norm().max(self.stroke) * 1e3;
        let with = |a: Point| Press { a, ..self.clone() }.turns();
        let x1 = number(self.a.x * 1e3, scale, |mm| with(Point::new(mm * 1e-3, self.a.y)));
        let y = number(-self.a.y * 1e3, scale, |mm| with(Point::new(self.a.x, -mm * 1e-3)));
        let off = |v: Option<f64>, from: f64| v.map_or(f64::INFINITY, |v| (v - from).abs());
        let (key, value) =
            if off(x1, self.a.x * 1e3) <= off(y, -self.a.y * 1e3) { ("x1", x1) } else { ("y", y) };
        match value {
            Some(mm) => both!("\"{key}\": \"{} mm\" gives a crank that turns through", told(mm)),
            None => both!("take \"angles\" that are nearer to one another"),
        }
    }

    fn scene(
        &self,
        [ab, bc, cd, de]: [f64; 4],
        driver: f64,
        rough: &[(&str, Point)],
        heading: &Heading,
    ) -> Json {
        let mut scene = headed(heading);
        scene.insert("links".into(), json!({"1": ["A", "B"], "2": ["B", "C"], "3": ["D", "C", "E"], "4": ["E", "F"], "6": ["A", "D"]}));
        scene.insert("ground".into(), json!("6"));
        scene.insert(
            "points".into(),
            json!({"A": place(self.a), "D": [0, 0], "E": {"base": "DC", "x": mm(de), "y": 0}}),
        );
        scene.insert(
            "lengths".into(),
            json!({"AB": mm(ab), "BC": mm(bc), "CD": mm(cd), "EF": mm(de * self.ef_de)}),
        );
        scene.insert("guides".into(), json!([{"pin": "F", "slider": "5", "on": "6", "through": [mm(self.x2), 0], "angle": "90 deg"}]));
        scene.insert(
            "driver".into(),
            json!({"link": "1", "angle": deg(driver), "omega": omega(heading.omega)}),
        );
        scene.insert("sketch".into(), super::time_ratio::sketch(rough));
        scene.insert("find".into(), json!(["v_F", "a_F", "omega_3"]));
        Json::Object(scene)
    }
}

impl Wish for Press {
    fn title(&self) -> Both {
        both!("Press with a stroke of {}", metres(self.stroke))
    }

    fn solve(&self, heading: &Heading) -> Result<TaskResult, Faults> {
        let Some(de) = self.de() else {
            let message = both!("the link EF does not reach the ram's line in one of the limits");
            let help = self.nearest_line();
            return Err(Diagnostic::error("no-real-solution", message).help(help).into());
        };
        let cd = de / (1.0 + self.ce_cd);
        let c = self.angles.map(|a| (from_vertical(a) * cd).to_point());
        let far = c.map(|c| self.a.distance(c));
        let (ab, bc) = ((far[0] - far[1]).abs() / 2.0, (far[0] + far[1]) / 2.0);
        if ab <= 1e-9 * bc {
            let message = both!("AC1 and AC2 are equal: the crank would have no length");
            return Err(Diagnostic::error("no-real-solution", message).help(self.nearest()).into());
        }
        let wanted: Vec<WantedPosition> = (0..2)
            .filter_map(|i| {
                let sense = if far[i] > far[1 - i] { 1.0 } else { -1.0 };
                let crank = (c[i] - self.a) * (sense / far[i]);
                let places = vec![
                    ("B".into(), self.a + crank * ab),
                    ("C".into(), c[i]),
                    ("F".into(), self.f(de, self.angles[i])?),
                ];
                Some(WantedPosition { driver: crank.angle(), places })
            })
            .collect();
        let between = (c[0] - self.a).cross(c[1] - self.a).abs();
        let theta = libm::atan2(between, (c[0] - self.a).dot(c[1] - self.a));
        let k = (PI + theta) / (PI - theta);
        let numbers = vec![
            DesignNumber::length("AB", both!("crank"), ab),
            DesignNumber::length("BC", both!("coupler"), bc),
            DesignNumber::length("CD", both!("rocker to the coupler"), cd),
            DesignNumber::length("DE", both!("rocker"), de),
            DesignNumber::length("EF", both!("link to the ram"), de * self.ef_de),
            DesignNumber::angle("theta", both!("crank angle between the limit positions"), theta),
            DesignNumber::ratio("K", both!("time ratio"), k),
        ];
        let rough = [("C", c[0]), ("F", wanted.first().map_or(Point::ORIGIN, |w| w.places[2].1))];
        let driver = wanted.first().map_or(0.0, |w| w.driver);
        let scene = self.scene([ab, bc, cd, de], driver, &rough, heading);
        let demands = vec![Demand::FullTurn, Demand::TimeRatio(k), Demand::Stroke(self.stroke)];
        let notes = self.warned();
        let draft =
            Draft { demands, ..Draft::new(both!("the only solution"), scene, numbers, wanted) };
        Ok(TaskResult { drafts: vec![draft], notes, ..TaskResult::default() })
    }

    fn construct(&self, draft: &Draft, board: &mut SynthesisBoard) -> Option<()> {
        let [p, q] = self.angles;
        let (d, a) = (Point::ORIGIN, board.at(self.a));
        let lay = |angle: f64| PaperLine { at: d, along: from_vertical(angle) };
        // Symmetrical limits: the chord of E is the stroke, because EF has the same inclination in
        // both.
        let even = (p + q - PI).abs() < 1e-9;
        let de = if even {
            let half = PaperLine::ray(Point::new(0.0, board.mm(self.stroke) / 2.0), 0.0);
            let e = lay(p).cross(&half)?;
            board.step(both!(
                "Draw the rocker's limits from D; a parallel at H/2 over the horizontal meets the upper one at E1: DE"
            ));
            board.line(half.at, e, Weight::Thin).read("DE", d, e);
            d.distance(e)
        } else {
            board.step(both!("Draw the rocker's limits from D and lay off DE"));
            board.mm(draft.numbers.iter().find(|n| n.name == "DE")?.value)
        };
        let [e1, e2] = [p, q].map(|angle| lay(angle).place(de));
        board
            .line(d, e1, Weight::Given)
            .line(d, e2, Weight::Given)
            .mark("D", d)
            .mark("E_1", e1)
            .mark("E_2", e2);
        let [c1, c2] = [e1, e2].map(|e| d + (e - d) * (1.0 / (1.0 + self.ce_cd)));
        board.step(both!("Divide DE by the given ratio: C1 and C2; mark A"));
        board
            .line(a, c1, Weight::Thin)
            .line(a, c2, Weight::Thin)
            .mark("C_1", c1)
            .mark("C_2", c2)
            .mark("A", a)
            .read("CD", d, c1);
        // The letter F names the ram.
        board.halve_at(a, [c1, c2], "K")
    }

    fn statement(&self) -> Statement {
        self.stated()
    }

    fn proof(&self, draft: &Draft) -> Vec<Proof> {
        self.proved(draft)
    }
}
