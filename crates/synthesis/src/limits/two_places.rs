//! Crank and coupler by the two limit places of C, `"linkage": "crank-rocker"` or `"slider-crank"`.
//!
//! In the limits crank and coupler are collinear: AB is half the difference of AC₁ and AC₂, BC half
//! their sum. The places are given as such; or those of a rocker are given by its length, the frame
//! and the angles ∠ADC₁, ∠ADC₂ (A at the origin, D on the x axis). If the pivot of a rocker is not
//! given, D is on the bisector of C₁C₂, on either side.

use crate::board::{SynthesisBoard, Weight};
use crate::candidate::{Demand, DesignNumber, Draft, WantedPosition, deg, mm, place};
use crate::form::TaskForm;
use crate::fourbar::{FourBar, Heading, headed, meet, named_lengths, omega};
use crate::nearest::{number, told};
use crate::statement::{angle, half_difference, length, number as ratio, of, place as shown};
use crate::time_ratio::{sketch, slow_stroke};
use crate::{Proof, Statement, TaskResult, Wish};
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::digits::significant;
use hodograph_base::geom::{Point, Vec2};
use serde_json::{Value as Json, json};
use std::f64::consts::PI;

/// Lengths that differ by no more than this share are equal, as written with the digits of a book.
const WRITTEN: f64 = 5e-3;
/// Limits with distances from A that differ by no more than this share have no crank.
const NO_CRANK: f64 = 1e-9;

#[derive(Clone, Debug)]
struct TwoPlaces {
    a: Point,
    c: [Point; 2],
    output: Output,
}

/// The output link that carries C.
#[derive(Clone, Debug)]
enum Output {
    /// A rocker about one of these pivots; the angles ∠ADC of both limits, if given.
    Rocker { pivots: Vec<Point>, angles: Option<[f64; 2]> },
    /// A slider on the line through both places.
    Slider,
}

pub(super) fn rocker(form: &TaskForm) -> Option<Box<dyn Wish>> {
    if form.has("places") {
        return by_places(form, true);
    }
    let (rocker, frame) =
        (form.need_size("rocker", "\"500 mm\""), form.need_size("frame", "\"1000 mm\""));
    let example = "[\"80 deg\", \"100 deg\"]";
    let angles = form.need("angles", example).and_then(|n| form.several::<2>(n, "angles", example));
    let angles =
        angles.and_then(|[p, q]| form.angle_of(p, "angles").zip(form.angle_of(q, "angles")));
    let (rocker, frame, (p, q)) = (rocker?, frame?, angles?);
    if !(0.0 < p.min(q) && p.max(q) < PI && p != q) {
        let message = both!("the limits are two different angles between 0° and 180°");
        let help = both!(
            "they are the rocker's angles with the frame, ∠ADC1 and ∠ADC2: write \"angles\": {example}"
        );
        form.fault(Diagnostic::error("out-of-range", message).at(form.span("angles")).help(help));
        return None;
    }
    Some(Box::new(TwoPlaces::by_angles(rocker, frame, [p, q])))
}

pub(super) fn slider(form: &TaskForm) -> Option<Box<dyn Wish>> {
    by_places(form, false)
}

fn by_places(form: &TaskForm, rocker: bool) -> Option<Box<dyn Wish>> {
    let example = "{\"A\": [\"0 mm\", \"0 mm\"], \"C1\": [\"150 mm\", \"60 mm\"], \"C2\": [\"90 mm\", \"60 mm\"]}";
    form.need("places", example)?;
    let names: &[&str] = if rocker { &["A", "C1", "C2", "D"] } else { &["A", "C1", "C2"] };
    let inner = form.inner("places", names)?;
    let at = |key: &str| inner.point_of(inner.need(key, "[\"0 mm\", \"0 mm\"]")?, key);
    let (a, c1, c2) = (at("A"), at("C1"), at("C2"));
    let own = if rocker && inner.has("D") { Some(inner.point("D")?) } else { None };
    let by_length =
        if rocker && own.is_none() { Some(form.need_size("rocker", "\"75 mm\"")?) } else { None };
    let (a, c) = (a?, [c1?, c2?]);
    let fault = |message: Both, help: Both| {
        form.fault(Diagnostic::error("wrong-given", message).at(form.span("places")).help(help));
        None
    };
    if c[0] == c[1] {
        return fault(both!("C1 and C2 are one place"), both!("give two limit places of C"));
    }
    let pivots = match (own, by_length) {
        (Some(d), _) => {
            let (p, q) = (d.distance(c[0]), d.distance(c[1]));
            if (p - q).abs() > WRITTEN * p.max(q) {
                let (p, q) = (significant(p * 1e3, 4), significant(q * 1e3, 4));
                let message = both!("D is {p} mm from C1 and {q} mm from C2");
                return fault(
                    message,
                    both!("a rocker has one length: move D onto the bisector of C1C2"),
                );
            }
            // Moved onto the bisector, because coordinates are rounded.
            let (middle, along) = (c[0] + (c[1] - c[0]) * 0.5, (c[1] - c[0]).unit()?);
            vec![d - along * along.dot(d - middle)]
        }
        (None, Some(l)) => {
            let both_sides: Vec<Point> =
                [true, false].into_iter().filter_map(|left| meet(c[0], l, c[1], l, left)).collect();
            if both_sides.is_empty() {
                let message = both!("the rocker is shorter than half of C1C2");
                return fault(message, both!("take a longer one, or give D"));
            }
            both_sides
        }
        (None, None) => Vec::new(),
    };
    let output = if rocker { Output::Rocker { pivots, angles: None } } else { Output::Slider };
    Some(Box::new(TwoPlaces { a, c, output }))
}

impl TwoPlaces {
    fn by_angles(rocker: f64, frame: f64, angles: [f64; 2]) -> TwoPlaces {
        let d = Point::new(frame, 0.0);
        let c = angles.map(|q| d + Vec2::from_angle(PI - q) * rocker);
        TwoPlaces {
            a: Point::ORIGIN,
            c,
            output: Output::Rocker { pivots: vec![d], angles: Some(angles) },
        }
    }

    /// The distances AC₁ and AC₂ (m).
    fn reach(&self) -> [f64; 2] {
        self.c.map(|c| self.a.distance(c))
    }

    /// Crank and coupler (m).
    fn bars(&self) -> [f64; 2] {
        let [p, q] = self.reach();
        [(p - q).abs() / 2.0, (p + q) / 2.0]
    }

    /// The angle θ = ∠C₁AC₂ (rad).
    fn theta(&self) -> f64 {
        let [u, v] = self.c.map(|c| c - self.a);
        libm::atan2(u.cross(v).abs(), u.dot(v))
    }

    /// True if the crank turns fully and one motion joins both limits.
    fn turns(&self) -> bool {
        let [ab, bc] = self.bars();
        if ab <= NO_CRANK * bc {
            return false;
        }
        match &self.output {
            Output::Rocker { pivots, .. } => pivots.iter().any(|d| {
                let (cd, ad) = (d.distance(self.c[0]), d.distance(self.a));
                let longest = bc.max(cd).max(ad);
                let sides = self.c.map(|c| (*d - self.a).cross(c - self.a));
                ab < bc.min(cd).min(ad)
                    && 2.0 * (ab + longest) < ab + bc + cd + ad
                    && sides[0] * sides[1] > 0.0
            }),
            Output::Slider => {
                let along = self.c[1] - self.c[0];
                (self.c[0] - self.a).dot(along) * (self.c[1] - self.a).dot(along) > 0.0
            }
        }
    }

    /// The nearest feasible task with a crank that turns fully.
    fn nearest(&self) -> Both {
        if let Output::Rocker { pivots, angles: Some(angles) } = &self.output
            && let Some(frame) = pivots.first().map(|d| d.x)
        {
            let rocker = self.c[0].distance(pivots[0]);
            let works =
                |mm: f64| mm > 0.0 && TwoPlaces::by_angles(rocker, mm * 1e-3, *angles).turns();
            if let Some(mm) = number(frame * 1e3, frame * 1e3, works) {
                return both!("\"frame\": \"{} mm\" has one", told(mm));
            }
            return both!("take angles nearer to one another");
        }
        let scale = self.c[0].distance(self.c[1]) * 1e3;
        let moved = |at: Point| TwoPlaces { a: at, ..self.clone() }.turns();
        let x = number(self.a.x * 1e3, scale, |mm| moved(Point::new(mm * 1e-3, self.a.y)))
            .map(|mm| [mm, self.a.y * 1e3]);
        let y = number(self.a.y * 1e3, scale, |mm| moved(Point::new(self.a.x, mm * 1e-3)))
            .map(|mm| [self.a.x * 1e3, mm]);
        let far = |to: &[f64; 2]| (to[0] - self.a.x * 1e3).abs() + (to[1] - self.a.y * 1e3).abs();
        match x.into_iter().chain(y).min_by(|p, q| far(p).total_cmp(&far(q))) {
            Some([x, y]) => both!("A at [\"{} mm\", \"{} mm\"] has one", told(x), told(y)),
            None => {
                both!("take A farther from the bisector of C1C2")
            }
        }
    }

    /// The positions of crank and coupler in the limits.
    fn wanted(&self) -> Vec<WantedPosition> {
        let (reach, [ab, _]) = (self.reach(), self.bars());
        let at = |i: usize| {
            // In the farther limit crank and coupler are stretched, in the nearer one they are
            // folded.
            let sense = if reach[i] > reach[1 - i] { 1.0 } else { -1.0 };
            let crank = (self.c[i] - self.a) * (sense / reach[i]);
            WantedPosition {
                driver: crank.angle(),
                places: vec![("B".into(), self.a + crank * ab), ("C".into(), self.c[i])],
            }
        };
        vec![at(0), at(1)]
    }

    fn draft(&self, d: Option<(usize, Point)>, heading: &Heading) -> Draft {
        let ([ab, bc], theta, wanted) = (self.bars(), self.theta(), self.wanted());
        let k = (PI + theta) / (PI - theta);
        let b = wanted[0].places[0].1;
        let (mut numbers, scene, moved) = match d {
            Some((_, d)) => {
                let four = FourBar { a: self.a, b, c: self.c[0], d, e: None };
                let [u, v] = self.c.map(|c| c - d);
                let swing = libm::atan2(u.cross(v).abs(), u.dot(v));
                let mut numbers =
                    named_lengths([ab, bc, d.distance(self.c[0]), d.distance(self.a)]);
                numbers.push(DesignNumber::angle("psi", both!("swing of the rocker"), swing));
                (numbers, four.scene(heading), Demand::Swing(swing))
            }
            None => {
                let way = self.c[0] - self.c[1];
                let (stroke, off) =
                    (way.norm(), (way.cross(self.a - self.c[1]) / way.norm()).abs());
                let numbers = vec![
                    DesignNumber::length("AB", both!("crank"), ab),
                    DesignNumber::length("BC", both!("rod"), bc),
                    DesignNumber::length("e", both!("offset"), off),
                    DesignNumber::length("H", both!("stroke"), stroke),
                ];
                (
                    numbers,
                    self.slider_scene([ab, bc], wanted[0].driver, heading),
                    Demand::Stroke(stroke),
                )
            }
        };
        numbers.push(DesignNumber::angle(
            "theta",
            both!("crank angle between the limit positions"),
            theta,
        ));
        numbers.push(DesignNumber::ratio("K", both!("time ratio"), k));
        let which = match (d, &self.output) {
            (Some((side, _)), Output::Rocker { pivots, .. }) if pivots.len() > 1 => match side {
                0 => both!("D left of C1C2"),
                _ => both!("D right of C1C2"),
            },
            (Some(_) | None, Output::Rocker { .. } | Output::Slider) => {
                both!("the only solution")
            }
        };
        let demands = vec![Demand::FullTurn, Demand::TimeRatio(k), moved];
        let remarks = vec![slow_stroke(wanted[0].driver, wanted[1].driver, heading.omega)];
        Draft { demands, remarks, ..Draft::new(which, scene, numbers, wanted) }
    }

    fn slider_scene(&self, [ab, bc]: [f64; 2], driver: f64, heading: &Heading) -> Json {
        let way = (self.c[0] - self.c[1]).angle();
        let mut scene = headed(heading);
        scene.insert("links".into(), json!({"1": ["A", "B"], "2": ["B", "C"], "4": ["A"]}));
        scene.insert("ground".into(), json!("4"));
        scene.insert("points".into(), json!({"A": place(self.a)}));
        scene.insert("lengths".into(), json!({"AB": mm(ab), "BC": mm(bc)}));
        scene.insert("guides".into(), json!([{"pin": "C", "slider": "3", "on": "4", "through": place(self.c[1]), "angle": deg(way)}]));
        scene.insert(
            "driver".into(),
            json!({"link": "1", "angle": deg(driver), "omega": omega(heading.omega)}),
        );
        scene.insert("sketch".into(), sketch(&[("C", self.c[0])]));
        scene.insert("find".into(), json!(["v_C", "a_C", "omega_2"]));
        Json::Object(scene)
    }
}

impl Wish for TwoPlaces {
    fn title(&self) -> Both {
        match self.output {
            Output::Rocker { .. } => both!("Crank-rocker by the limit positions of its rocker"),
            Output::Slider => both!("Slider-crank by the limit positions of its slider"),
        }
    }

    fn solve(&self, heading: &Heading) -> Result<TaskResult, Faults> {
        let [ab, bc] = self.bars();
        if ab <= NO_CRANK * bc {
            let message = both!("AC1 and AC2 are equal: the crank would have no length");
            return Err(Diagnostic::error("no-real-solution", message).help(self.nearest()).into());
        }
        let mut notes = Vec::new();
        if !self.turns() {
            let message =
                both!("no crank turns through what comes out, or its limits lie on two assemblies");
            notes.push(Diagnostic::warning("not-a-crank", message).help(self.nearest()));
        }
        let drafts = match &self.output {
            Output::Rocker { pivots, .. } => {
                pivots.iter().enumerate().map(|(k, d)| self.draft(Some((k, *d)), heading)).collect()
            }
            Output::Slider => vec![self.draft(None, heading)],
        };
        Ok(TaskResult { drafts, notes, ..TaskResult::default() })
    }

    fn construct(&self, draft: &Draft, board: &mut SynthesisBoard) -> Option<()> {
        let (a, [c1, c2]) = (board.at(self.a), self.c.map(|c| board.at(c)));
        match &self.output {
            Output::Rocker { pivots, .. } => {
                board.step(both!("Lay off the frame AD and the rocker in its limits DC1 and DC2"));
                let cd = of(draft, "AD");
                let d = pivots.iter().min_by(|p, q| {
                    let off = |at: &Point| (at.distance(self.a) - cd).abs();
                    off(p).total_cmp(&off(q))
                })?;
                let d = board.at(*d);
                board
                    .line(a, d, Weight::Given)
                    .line(d, c1, Weight::Given)
                    .line(d, c2, Weight::Given)
                    .mark("D", d)
                    .read("CD", d, c1);
            }
            Output::Slider => {
                board.step(both!("Lay off A and the slider's limits C1, C2 on the guide"));
                board.line(c1, c2, Weight::Given).read("H", c1, c2);
            }
        }
        board.mark("A", a).mark("C_1", c1).mark("C_2", c2).line(a, c1, Weight::Thin).line(
            a,
            c2,
            Weight::Thin,
        );
        board.halve(a, [c1, c2])
    }

    fn statement(&self) -> Statement {
        let [c1, c2] = self.c.map(shown);
        let (task, given) = match &self.output {
            Output::Rocker { pivots, angles } => {
                let task = both!(
                    "Design a crank-rocker $ABCD$ whose rocker $CD$ swings between two given limit positions."
                );
                let d = pivots.first().copied().unwrap_or(Point::ORIGIN);
                let rocker = both!("rocker $l_{{CD}} = {}$", length(d.distance(self.c[0])));
                let given = match angles {
                    Some([p, q]) => vec![
                        rocker,
                        both!("frame $l_{{AD}} = {}$", length(d.x)),
                        both!(
                            "limits of the rocker $\\angle ADC_1 = {}$, $\\angle ADC_2 = {}$",
                            angle(*p),
                            angle(*q)
                        ),
                    ],
                    None => {
                        let places = both!("$A = {}$, $C_1 = {c1}$, $C_2 = {c2}$", shown(self.a));
                        let pivot = both!("$D = {}$", shown(d));
                        vec![places, if pivots.len() > 1 { rocker } else { pivot }]
                    }
                };
                (task, given)
            }
            Output::Slider => (
                both!(
                    "Design a slider-crank $ABC$ whose slider $C$ runs to and fro between two given places."
                ),
                vec![both!("$A = {}$, $C_1 = {c1}$, $C_2 = {c2}$", shown(self.a))],
            ),
        };
        let wanted = vec![
            both!("the lengths of crank $l_{{AB}}$ and coupler $l_{{BC}}$"),
            both!("the time ratio $K$"),
        ];
        Statement { task, given, wanted, open_steps: 1 }
    }

    fn proof(&self, draft: &Draft) -> Vec<Proof> {
        let k = format!(
            "\\theta = \\angle C_1AC_2 = {} ,\\quad K = \\frac{{180\\degree + \\theta}}{{180\\degree − \\theta}} = {}",
            angle(of(draft, "theta")),
            ratio(of(draft, "K"))
        );
        vec![
            half_difference(self.reach(), of(draft, "AB"), of(draft, "BC")),
            Proof::new(both!("The crank angle between the limits and the time ratio:"), [k]),
        ]
    }
}
