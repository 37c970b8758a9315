//! Linkages with a slotted lever 导杆: the slotted lever, the shaper, Whitworth's linkage.
//!
//! Swinging lever: in its limits the crank is perpendicular to it, so that its swing ψ is θ, and AB
//! = AC sin(θ/2). Shaper: CD = H/(2 sin(θ/2)), the ram's guide in the middle of the rise of D's
//! arc, y = CD (1 + cos(θ/2))/2, which minimises the greatest pressure angle. Whitworth: the lever
//! turns fully about a pivot inside the crank's circle; while its dead-centre line turns by 180°
//! the crank turns by 360°/(K + 1), so AC = AB cos(180°/(K + 1)). Pivots: A of the crank, C of the
//! lever, vertically below A.

mod drawing;
mod explained;

use super::StrokeRatio;
use super::slider_crank::sketch;
use crate::board::SynthesisBoard;
use crate::candidate::{Demand, DesignNumber, Draft, WantedPosition, deg, mm, place};
use crate::form::TaskForm;
use crate::fourbar::{Heading, headed, omega};
use crate::{Proof, Statement, TaskResult, Wish};
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::digits::{metres, significant};
use hodograph_base::geom::{Point, Vec2};
use serde_json::{Map, Value as Json, json};
use std::f64::consts::PI;

#[derive(Clone, Debug)]
struct Slotted {
    ratio: StrokeRatio,
    /// Crank AB and frame AC (m).
    crank: f64,
    frame: f64,
    /// True if the crank is given and the frame follows from it.
    by_crank: bool,
    kind: SlottedKind,
    /// Notes on the sizes chosen by default.
    notes: Vec<Diagnostic>,
}

#[derive(Clone, Copy, Debug)]
enum SlottedKind {
    /// The lever alone, extended to D if its length is given.
    Lever { lever: Option<f64> },
    /// A lever with a ram.
    Shaper { stroke: f64, link: f64 },
    /// A lever with a slider on a line through C.
    Whitworth { stroke: f64, link: f64 },
}

/// A kind, with notes on its sizes chosen by default.
type ChosenKind = (SlottedKind, Vec<Diagnostic>);

/// The crank (m), and the crank angle θ between the limits (rad).
struct LeverSizes {
    crank: f64,
    theta: f64,
}

/// Reads the task of the lever alone.
pub(super) fn lever(form: &TaskForm) -> Option<Box<dyn Wish>> {
    let lever = if form.has("rocker") { form.size("rocker").map(Some) } else { Some(None) };
    read(form, swings, |_| Some((SlottedKind::Lever { lever: lever? }, Vec::new())))
}

/// Reads the task of the shaper.
pub(super) fn shaper(form: &TaskForm) -> Option<Box<dyn Wish>> {
    let stroke = form.need_size("stroke", STROKE);
    let link = sized(form, "link");
    read(form, swings, |own| {
        let (stroke, link, mut notes) = (stroke?, link?, Vec::new());
        let link = link.unwrap_or_else(|| short_link(stroke, own.theta / 2.0, &mut notes));
        Some((SlottedKind::Shaper { stroke, link }, notes))
    })
}

/// Reads the task of Whitworth's linkage.
pub(super) fn whitworth(form: &TaskForm) -> Option<Box<dyn Wish>> {
    let (stroke, link) = (sized(form, "stroke"), sized(form, "link"));
    let share = |ratio: StrokeRatio| 1.0 / libm::cos(PI / (ratio.k + 1.0));
    read(form, share, |own| {
        let (stroke, link, mut notes) = (stroke?, link?, Vec::new());
        let stroke = stroke.unwrap_or_else(|| chosen_stroke(own.crank, &mut notes));
        let link = link.unwrap_or_else(|| chosen_link(stroke, &mut notes));
        Some((SlottedKind::Whitworth { stroke, link }, notes))
    })
}

/// An example of a stroke as written.
const STROKE: &str = "\"300 mm\"";

/// An optional length (m); the outer `None` where it has a fault.
fn sized(form: &TaskForm, key: &'static str) -> Option<Option<f64>> {
    if form.has(key) { form.size(key).map(Some) } else { Some(None) }
}

/// The ratio AB/AC of a lever that swings.
fn swings(ratio: StrokeRatio) -> f64 {
    libm::sin(ratio.theta / 2.0)
}

/// Reads the parts common to all three: the time ratio, and crank or frame, the other by its
/// `share`; `kind` returns `None` where its own keys have a fault.
fn read(
    form: &TaskForm,
    share: impl Fn(StrokeRatio) -> f64,
    kind: impl FnOnce(&LeverSizes) -> Option<ChosenKind>,
) -> Option<Box<dyn Wish>> {
    let ratio = StrokeRatio::read(form);
    let one = one_of(form, ["crank", "frame"]);
    let (ratio, (key, size)) = (ratio?, one?);
    if ratio.theta == 0.0 {
        let d = Diagnostic::error(
            "no-real-solution",
            both!("with K = 1 a slotted lever has no quick return"),
        );
        form.fault(d.at(form.span("K")).help(both!("K is greater than one")));
        return None;
    }
    let share = share(ratio);
    let (crank, frame) = if key == "crank" { (size, size / share) } else { (size * share, size) };
    let (kind, mut notes) = kind(&LeverSizes { crank, theta: ratio.theta })?;
    notes.extend(ratio.notes());
    Some(Box::new(Slotted { ratio, crank, frame, by_crank: key == "crank", kind, notes }))
}

/// A default link for a shaper's ram: three tenths of the lever, and no less than keeps its
/// pressure angle under 12°.
fn short_link(stroke: f64, half: f64, notes: &mut Vec<Diagnostic>) -> f64 {
    let lever = stroke / (2.0 * libm::sin(half));
    let rise = lever * (1.0 - libm::cos(half)) / 2.0;
    let link = (0.3 * lever).max(5.0 * rise);
    let message = both!("the link to the ram is free: {} is taken", metres(link));
    let help = both!("give \"link\", longer than {}", metres(rise));
    notes.push(Diagnostic::note("free-choice", message).help(help));
    link
}

/// A default stroke for Whitworth's slider: the diameter of the crank's circle.
fn chosen_stroke(crank: f64, notes: &mut Vec<Diagnostic>) -> f64 {
    let stroke = 2.0 * crank;
    let message = both!("the stroke of the slider is free: {} is taken", metres(stroke));
    notes.push(Diagnostic::note("free-choice", message).help(both!("give \"stroke\"")));
    stroke
}

/// A default link for Whitworth's slider: three times the lever's arm.
fn chosen_link(stroke: f64, notes: &mut Vec<Diagnostic>) -> f64 {
    let link = 1.5 * stroke;
    let message = both!("the link to the slider is free: {} is taken", metres(link));
    let help = both!("give \"link\", longer than {}", metres(stroke / 2.0));
    notes.push(Diagnostic::note("free-choice", message).help(help));
    link
}

/// Exactly one of two lengths.
fn one_of(form: &TaskForm, keys: [&'static str; 2]) -> Option<(&'static str, f64)> {
    match keys.map(|k| form.has(k)) {
        [true, false] => Some((keys[0], form.size(keys[0])?)),
        [false, true] => Some((keys[1], form.size(keys[1])?)),
        _ => {
            let [one, other] = keys;
            let message = both!("one of `{one}` and `{other}` is given");
            form.fault(
                Diagnostic::error("missing-key", message)
                    .at(form.span("linkage"))
                    .help(both!("write \"{other}\": \"100 mm\"")),
            );
            None
        }
    }
}

impl Wish for Slotted {
    fn title(&self) -> Both {
        let k = significant(self.ratio.k, 4);
        match self.kind {
            SlottedKind::Lever { .. } => {
                both!("Slotted lever with time ratio {}", k)
            }
            SlottedKind::Shaper { .. } => {
                both!("Shaper with time ratio {}", k)
            }
            SlottedKind::Whitworth { .. } => both!("Whitworth quick return with time ratio {}", k),
        }
    }

    fn solve(&self, heading: &Heading) -> Result<TaskResult, Faults> {
        let draft = match self.kind {
            SlottedKind::Lever { lever } => self.lever(lever, heading),
            SlottedKind::Shaper { stroke, link } => self.shaper(stroke, link, heading)?,
            SlottedKind::Whitworth { stroke, link } => self.whitworth(stroke, link, heading)?,
        };
        Ok(TaskResult { drafts: vec![draft], notes: self.notes.clone(), ..TaskResult::default() })
    }

    fn construct(&self, _: &Draft, board: &mut SynthesisBoard) -> Option<()> {
        self.drawn(board)
    }

    fn statement(&self) -> Statement {
        self.stated()
    }

    fn proof(&self, draft: &Draft) -> Vec<Proof> {
        self.proved(draft)
    }
}

impl Slotted {
    fn c(&self) -> Point {
        Point::new(0.0, -self.frame)
    }

    fn numbers(&self) -> Vec<DesignNumber> {
        vec![
            DesignNumber::length("AB", both!("crank"), self.crank),
            DesignNumber::length("AC", both!("frame"), self.frame),
            DesignNumber::angle(
                "theta",
                both!("crank angle between the limit positions"),
                self.ratio.theta,
            ),
            DesignNumber::ratio("K", both!("time ratio"), self.ratio.k),
        ]
    }

    /// The swinging lever's limits, with the crank perpendicular to the lever on the right and on
    /// the left: crank angle, B, and the lever's direction.
    fn limits(&self) -> [(f64, Point, Vec2); 2] {
        let half = self.ratio.theta / 2.0;
        [1.0, -1.0].map(|side| {
            let crank = Vec2::new(side * libm::cos(half), -libm::sin(half));
            (
                crank.angle(),
                (crank * self.crank).to_point(),
                Vec2::new(side * libm::sin(half), libm::cos(half)),
            )
        })
    }

    /// The scene with the links and the slot common to all three; `D` is on the lever if that has a
    /// length.
    fn scene(&self, heading: &Heading, driver: f64, d: Option<(f64, Point)>) -> Map<String, Json> {
        let mut scene = headed(heading);
        let lever = if d.is_some() { json!(["C", "D"]) } else { json!(["C"]) };
        scene.insert("links".into(), json!({"1": ["A", "B"], "3": lever, "6": ["A", "C"]}));
        scene.insert("ground".into(), json!("6"));
        scene.insert("points".into(), json!({"A": [0, 0], "C": place(self.c())}));
        let guide = match d {
            Some(_) => json!({"pin": "B", "slider": "2", "on": "3", "line": "CD"}),
            None => json!({"pin": "B", "slider": "2", "on": "3", "through": "C"}),
        };
        let mut lengths = json!({"AB": mm(self.crank)});
        if let Some((lever, at)) = d {
            lengths["CD"] = mm(lever);
            scene.insert("sketch".into(), sketch(&[("D", at)]));
        }
        scene.insert("lengths".into(), lengths);
        scene.insert("guides".into(), json!([guide]));
        scene.insert(
            "driver".into(),
            json!({"link": "1", "angle": deg(driver), "omega": omega(heading.omega)}),
        );
        scene.insert("find".into(), json!(["omega_3", "alpha_3", "vr_B3B2"]));
        scene
    }

    fn draft(
        &self,
        scene: Map<String, Json>,
        numbers: Vec<DesignNumber>,
        wanted: Vec<WantedPosition>,
        stroke: f64,
        heading: &Heading,
    ) -> Draft {
        let remarks = vec![super::slow_stroke(wanted[0].driver, wanted[1].driver, heading.omega)];
        let demands =
            vec![Demand::FullTurn, Demand::TimeRatio(self.ratio.k), Demand::Stroke(stroke)];
        Draft {
            demands,
            remarks,
            ..Draft::new(both!("the only solution"), Json::Object(scene), numbers, wanted)
        }
    }

    fn lever(&self, lever: Option<f64>, heading: &Heading) -> Draft {
        let limits = self.limits();
        let wanted = limits.map(|(driver, b, direction)| {
            let d = lever.map(|l| ("D".to_owned(), self.c() + direction * l));
            WantedPosition {
                driver,
                places: std::iter::once(("B".to_owned(), b)).chain(d).collect(),
            }
        });
        let (driver, _, direction) = limits[0];
        let scene = self.scene(heading, driver, lever.map(|l| (l, self.c() + direction * l)));
        let mut numbers = self.numbers();
        numbers.extend(lever.map(|l| DesignNumber::length("CD", both!("lever"), l)));
        self.draft(scene, numbers, wanted.into(), self.ratio.theta, heading)
    }

    fn shaper(&self, stroke: f64, link: f64, heading: &Heading) -> Result<Draft, Faults> {
        let half = self.ratio.theta / 2.0;
        let lever = stroke / (2.0 * libm::sin(half));
        let height = lever * (1.0 + libm::cos(half)) / 2.0;
        let off = (lever - height) / link;
        if off >= 1.0 {
            let message = both!("the link of {} does not reach from D to the ram", metres(link));
            let help = both!("\"link\" is longer than {}", metres(lever - height));
            return Err(Diagnostic::error("no-real-solution", message).help(help).into());
        }
        let limits = self.limits();
        // The ram is to the left of D.
        let ram = |d: Point| {
            let rise = self.c().y + height - d.y;
            Point::new(d.x - ((link - rise) * (link + rise)).sqrt(), self.c().y + height)
        };
        let wanted = limits.map(|(driver, b, direction)| {
            let d = self.c() + direction * lever;
            WantedPosition {
                driver,
                places: vec![("B".into(), b), ("D".into(), d), ("E".into(), ram(d))],
            }
        });
        let d = self.c() + limits[0].2 * lever;
        let mut scene = self.scene(heading, limits[0].0, Some((lever, d)));
        self.add_slider(&mut scene, link, self.c().y + height, &[("D", d), ("E", ram(d))]);
        let mut numbers = self.numbers();
        numbers.push(DesignNumber::length("CD", both!("lever"), lever));
        numbers.push(DesignNumber::length("DE", both!("shaper" => "link to the ram"), link));
        numbers.push(DesignNumber::length("y", both!("height of the ram's guide over C"), height));
        numbers.push(DesignNumber::length("H", both!("stroke"), stroke));
        numbers.push(DesignNumber::angle(
            "alpha_max",
            both!("greatest pressure angle of DE"),
            libm::asin(off),
        ));
        Ok(self.draft(scene, numbers, wanted.into(), stroke, heading))
    }

    fn whitworth(&self, stroke: f64, link: f64, heading: &Heading) -> Result<Draft, Faults> {
        let arm = stroke / 2.0;
        if link <= arm {
            let message =
                both!("the link of {} is too short for the slider's stroke", metres(link));
            let help = both!("\"link\" is longer than {}", metres(arm));
            return Err(Diagnostic::error("no-real-solution", message).help(help).into());
        }
        // The lever's dead-centre line: perpendicular to AC through C, to its intersection with the
        // crank's circle.
        let reach = ((self.crank - self.frame) * (self.crank + self.frame)).sqrt();
        let c = self.c();
        let wanted = [1.0, -1.0].map(|side| {
            let b = Point::new(side * reach, c.y);
            let d = Point::new(side * arm, c.y);
            WantedPosition {
                driver: b.to_vec2().angle(),
                places: vec![
                    ("B".into(), b),
                    ("D".into(), d),
                    ("E".into(), Point::new(d.x - link, c.y)),
                ],
            }
        });
        let (d, e) = (Point::new(arm, c.y), Point::new(arm - link, c.y));
        // The slot gives the lever's direction: D is on the side of B.
        let mut scene = self.scene(heading, wanted[0].driver, Some((arm, d)));
        self.add_slider(&mut scene, link, c.y, &[("D", d), ("E", e)]);
        let mut numbers = self.numbers();
        numbers.push(DesignNumber::length("CD", both!("arm of the lever"), arm));
        numbers.push(DesignNumber::length("DE", both!("link to the slider"), link));
        numbers.push(DesignNumber::length("H", both!("stroke"), stroke));
        numbers.push(DesignNumber::angle(
            "alpha_return",
            both!("crank angle of the quick stroke"),
            2.0 * PI / (self.ratio.k + 1.0),
        ));
        let ratio = |gap: f64| self.crank / gap;
        numbers.push(DesignNumber::ratio(
            "i_max",
            both!("greatest ratio ω of lever to crank"),
            ratio(self.crank - self.frame),
        ));
        numbers.push(DesignNumber::ratio(
            "i_min",
            both!("least ratio ω of lever to crank"),
            ratio(self.crank + self.frame),
        ));
        Ok(self.draft(scene, numbers, wanted.into(), stroke, heading))
    }

    /// Adds the link DE and its slider on a horizontal guide.
    fn add_slider(
        &self,
        scene: &mut Map<String, Json>,
        link: f64,
        level: f64,
        rough: &[(&str, Point)],
    ) {
        scene["links"]["4"] = json!(["D", "E"]);
        scene["lengths"]["DE"] = mm(link);
        if let Some(guides) = scene["guides"].as_array_mut() {
            guides.push(json!({"pin": "E", "slider": "5", "on": "6", "through": [0, mm(level)], "angle": "0 deg"}));
        }
        scene.insert("sketch".into(), sketch(rough));
        scene.insert("find".into(), json!(["v_E", "a_E", "omega_3", "omega_4"]));
    }
}
