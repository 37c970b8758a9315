//! Body guidance 按连杆预定位置, `"synthesis": "body"`: a coupler through two to five positions.
//!
//! In three positions, the places of a moving pin are on the circle about its pivot; the places of
//! a pivot, moved back with the body into position 1, are on the circle about its pin. Two
//! positions leave one free parameter on each bisector. Four determine a curve of pins, which a
//! given line intersects; five determine up to four pins. Each pair of pins with their centres is a
//! four-bar; either side may be the driver.

mod among;
pub mod burmester;
mod drawing;
mod explained;
mod nearest;
pub mod pose;
mod positions;

use super::board::SynthesisBoard;
use super::candidate::{DesignNumber, Draft, WantedPosition};
use super::form::TaskForm;
use super::fourbar::{FourBar, Heading, named_lengths};
use super::{KindOfTask, Proof, Statement, TaskResult, Wish};
use among::Among;
use burmester::BurmesterPair;
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::digits::{metres, significant};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::each;
use pose::{BodyPose, centre};
use std::cmp::Ordering;

/// Body guidance as a kind of task.
pub const KIND: KindOfTask = KindOfTask {
    name: "body",
    what: each!("a coupler through two to five positions"),
    keys: &["positions", "moving", "ground", "line", "box", "angles"],
    read,
};

/// The angle below which two bisectors put the pivot too far away.
const FAR: f64 = 5.0 * std::f64::consts::PI / 180.0;

#[derive(Clone, Debug)]
struct Body {
    positions: Vec<BodyPose>,
    /// Pins B and C in the body's frame (m).
    moving: [Option<Vec2>; 2],
    /// Pivots A and D (m).
    ground: [Option<Point>; 2],
    line: Option<(Point, Vec2)>,
    /// The choice of pivots for four positions without a line.
    among: Option<Among>,
}

/// The method of finding the pins, determined by the number of positions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Method {
    /// For two or three positions: bisectors.
    Bisectors,
    /// For four: the centre-point curve and a line.
    Curve,
    /// For five: the intersections of two curves.
    Burmester,
}

fn method(count: usize) -> Method {
    match count.cmp(&4) {
        Ordering::Less => Method::Bisectors,
        Ordering::Equal => Method::Curve,
        Ordering::Greater => Method::Burmester,
    }
}

fn read(form: &TaskForm) -> Option<Box<dyn Wish>> {
    let positions = positions::read(form);
    let moving = form.places("moving", &["B", "C"]);
    let ground = form.places("ground", &["A", "D"]);
    let find =
        |all: &[(String, Point)], name: &str| all.iter().find(|(n, _)| n == name).map(|(_, p)| *p);
    let line = form.inner("line", &["through", "angle"]).map(|l| {
        l.need("through", "[\"0 mm\", \"40 mm\"]")?;
        let through = l.point("through");
        let angle = if l.has("angle") { l.angle("angle") } else { Some(0.0) };
        Some((through?, Vec2::from_angle(angle?)))
    });
    let line = match line {
        Some(None) => return None,
        Some(found) => found,
        None => None,
    };
    let mut moving = ["B", "C"].map(|n| find(&moving, n).map(Point::to_vec2));
    let ground = ["A", "D"].map(|n| find(&ground, n));
    let among = among::read(form)?;
    let positions::GivenPositions { all: positions, pins } = positions?;
    let count = positions.len();
    if let Some(pins) = pins.filter(|_| method(count) == Method::Bisectors) {
        for side in 0..2 {
            if ground[side].is_none() {
                moving[side] = moving[side].or(Some(pins[side]));
            }
        }
    }
    if among.is_some() && (line.is_some() || method(count) != Method::Curve) {
        let message = both!(
            "\"box\" and \"angles\" choose pivots of four positions, in the place of \"line\""
        );
        let d = Diagnostic::error("wrong-given", message).at(form.span(if form.has("box") {
            "box"
        } else {
            "angles"
        }));
        form.fault(d.help(both!("leave it out")));
        return None;
    }
    if !enough(form, count, &moving, &ground, line.is_some() || among.is_some()) {
        return None;
    }
    Some(Box::new(Body { positions, moving, ground, line, among }))
}

/// Returns true if the givens fit the number of positions; reports what is missing.
fn enough(
    form: &TaskForm,
    count: usize,
    moving: &[Option<Vec2>; 2],
    ground: &[Option<Point>; 2],
    line: bool,
) -> bool {
    let dyads = [0, 1].map(|i| (moving[i].is_some(), ground[i].is_some()));
    let (message, help) = match method(count) {
        Method::Bisectors if dyads.iter().all(|(m, g)| m != g) => return true,
        Method::Bisectors => (
            both!("of each side of the linkage its pin or its pivot is given: B or A, C or D"),
            both!(
                "write \"moving\": {{\"B\": [...], \"C\": [...]}} or \"ground\": {{\"A\": [...], \"D\": [...]}}"
            ),
        ),
        Method::Curve if line && dyads == [(false, false); 2] => return true,
        Method::Curve => (
            both!(
                "with four positions the pivots lie on a curve: a line that cuts it, a box or two inscribed angles are wanted, and neither pins nor pivots"
            ),
            both!(
                "write \"line\": {{\"through\": [\"0 mm\", \"40 mm\"], \"angle\": \"0 deg\"}}, \"box\": {{\"from\": [...], \"to\": [...]}} or \"angles\": [\"40 deg\", \"110 deg\"]"
            ),
        ),
        Method::Burmester if !line && dyads == [(false, false); 2] => return true,
        Method::Burmester => (
            both!("five positions fix pins and pivots by themselves"),
            both!("leave \"moving\", \"ground\" and \"line\" out, or give fewer positions"),
        ),
    };
    form.fault(Diagnostic::error("wrong-given", message).at(form.span("positions")).help(help));
    false
}

impl Wish for Body {
    fn title(&self) -> Both {
        both!("Four-bar for {} positions of its coupler", self.positions.len())
    }

    fn solve(&self, heading: &Heading) -> Result<TaskResult, Faults> {
        let mut notes = Vec::new();
        if let Some(among) = self.among {
            return self.chosen(among, heading);
        }
        let pairs = match self.method() {
            Method::Bisectors => vec![self.dyad(0, &mut notes)?, self.dyad(1, &mut notes)?],
            Method::Curve => {
                let (through, direction) =
                    self.line.unwrap_or((Point::ORIGIN, Vec2::new(1.0, 0.0)));
                burmester::on_line(&self.positions, through, direction)
            }
            Method::Burmester => burmester::of_five(&self.positions),
        };
        if pairs.len() < 2 {
            return Err(self.too_few(pairs.len()).into());
        }
        if let Some(d) = self.one_joint(&pairs) {
            return Err(d.into());
        }
        let fixed = self.method() == Method::Bisectors;
        let mut drafts = Vec::new();
        for i in 0..pairs.len() {
            for j in (0..pairs.len()).filter(|j| *j != i && (i < *j || !fixed)) {
                drafts.push(self.draft([pairs[i], pairs[j]], [i, j], heading));
            }
        }
        let mut numbers = self.poles();
        if !fixed {
            numbers.push(DesignNumber::ratio(
                "count",
                both!("pairs of pin and pivot"),
                pairs.len() as f64,
            ));
            numbers.extend(pairs.iter().enumerate().flat_map(|(k, p)| told(k + 1, p)));
        }
        Ok(TaskResult { drafts, numbers, notes })
    }

    fn construct(&self, draft: &Draft, board: &mut SynthesisBoard) -> Option<()> {
        self.drawn(draft, board)
    }

    fn statement(&self) -> Statement {
        self.stated()
    }

    fn proof(&self, draft: &Draft) -> Vec<Proof> {
        self.proved(draft)
    }
}

/// The numbers of a pair.
fn told(k: usize, p: &BurmesterPair) -> Vec<DesignNumber> {
    let (centre, pin) = (both!("pivot {k}"), both!("pin {k} in position 1"));
    vec![
        DesignNumber::length(&format!("centre_{k}_x"), centre.clone(), p.centre.x),
        DesignNumber::length(&format!("centre_{k}_y"), centre, p.centre.y),
        DesignNumber::length(&format!("pin_{k}_x"), pin.clone(), p.pin.x),
        DesignNumber::length(&format!("pin_{k}_y"), pin, p.pin.y),
        DesignNumber::length(&format!("length_{k}"), both!("link {k}"), p.centre.distance(p.pin)),
    ]
}

impl Body {
    /// The linkages of four positions with the pivots in a box or at two inscribed angles.
    fn chosen(&self, among: Among, heading: &Heading) -> Result<TaskResult, Faults> {
        let pairs = among::pairs(&self.positions, among);
        if pairs.is_empty() {
            return Err(self.none_among(among).into());
        }
        let drafts = pairs
            .iter()
            .enumerate()
            .map(|(k, p)| self.draft(*p, [2 * k, 2 * k + 1], heading))
            .collect();
        Ok(TaskResult { drafts, numbers: self.poles(), notes: Vec::new() })
    }

    fn method(&self) -> Method {
        method(self.positions.len())
    }

    /// The poles of all displacements, as numbers.
    fn poles(&self) -> Vec<DesignNumber> {
        let mut out = Vec::new();
        for j in 1..self.positions.len() {
            for i in 0..j {
                let Some(p) = self.positions[i].pole(&self.positions[j]) else { continue };
                let what = both!("pole of positions {} and {}", i + 1, j + 1);
                out.push(DesignNumber::length(
                    &format!("P{}{}_x", i + 1, j + 1),
                    what.clone(),
                    p.x,
                ));
                out.push(DesignNumber::length(&format!("P{}{}_y", i + 1, j + 1), what, p.y));
            }
        }
        out
    }

    /// Pin and pivot of one side of the linkage, for two or three positions.
    fn dyad(&self, side: usize, notes: &mut Vec<Diagnostic>) -> Result<BurmesterPair, Faults> {
        let [pin, pivot] = [["B", "C"], ["A", "D"]].map(|n| n[side]);
        let (places, moving) = (self.places(side), self.moving[side].is_some());
        let sought = if moving { pivot } else { pin };
        let found = match places[..] {
            [p, q] if p.distance(q) == 0.0 => return Err(self.still(side).into()),
            [p, q] => self.on_bisector(p, q, sought, notes),
            [p, q, r] => {
                let Some((at, angle)) = centre(p, q, r) else {
                    return Err(self.straight(side).into());
                };
                if angle < FAR {
                    let message = both!(
                        "the bisectors for {sought} cross under {}° only: it lies far off",
                        significant(angle.to_degrees(), 3)
                    );
                    notes.push(Diagnostic::warning("pivot-far", message));
                }
                at
            }
            _ => Point::ORIGIN,
        };
        Ok(if moving {
            BurmesterPair { pin: places[0], centre: found }
        } else {
            BurmesterPair { pin: found, centre: places[0] }
        })
    }

    /// The point of a bisector that is taken for two positions: its intersection with the line if
    /// one is given, else the point from which the link turns by 60°.
    fn on_bisector(&self, p: Point, q: Point, sought: &str, notes: &mut Vec<Diagnostic>) -> Point {
        let (middle, across) = (p + (q - p) * 0.5, (q - p).perp());
        if let Some((through, direction)) = self.line {
            let slant = across.cross(direction);
            if slant.abs() > 1e-9 * across.norm() {
                return middle + across * ((through - middle).cross(direction) / slant);
            }
        }
        let message = both!("{sought} is free on a bisector: taken where the link turns by 60°");
        notes.push(Diagnostic::note("free-choice", message).help(both!("fix it by \"line\"")));
        middle + across * (3.0f64.sqrt() / 2.0)
    }

    fn draft(
        &self,
        [one, other]: [BurmesterPair; 2],
        which: [usize; 2],
        heading: &Heading,
    ) -> Draft {
        let first = self.positions[0];
        let (b, c) = (one.pin, other.pin);
        let axis = (c - b) * (1.0 / (c - b).norm());
        let local = first.origin - b;
        let e = Vec2::new(axis.dot(local), axis.cross(local));
        let four = FourBar { a: one.centre, b, c, d: other.centre, e: Some(e) };
        let wanted: Vec<WantedPosition> = self
            .positions
            .iter()
            .map(|p| {
                let (b, c) = (first.carry(p, one.pin), first.carry(p, other.pin));
                WantedPosition {
                    driver: (b - one.centre).angle(),
                    places: vec![("B".into(), b), ("C".into(), c), ("E".into(), p.origin)],
                }
            })
            .collect();
        let mut numbers = named_lengths(four.lengths());
        for (name, at) in [("A", one.centre), ("B1", b), ("C1", c), ("D", other.centre)] {
            numbers.push(DesignNumber::length(
                &format!("{name}_x"),
                both!("place of {name}"),
                at.x,
            ));
            numbers.push(DesignNumber::length(
                &format!("{name}_y"),
                both!("place of {name}"),
                at.y,
            ));
        }
        let which = match self.method() {
            Method::Bisectors => both!("crank at A"),
            Method::Curve | Method::Burmester => {
                both!("pivots {} and {}", which[0] + 1, which[1] + 1)
            }
        };
        Draft {
            ordered: true,
            remarks: remarks(&four),
            ..Draft::new(which, four.scene(heading), numbers, wanted)
        }
    }
}

/// Remarks on the sizes.
fn remarks(four: &FourBar) -> Vec<Diagnostic> {
    let [ab, bc, cd, _] = four.lengths();
    let short = ab.min(bc).min(cd);
    let message = || {
        both!(
            "a link of {} beside one of {}: hardly to be built",
            metres(short),
            metres(four.size())
        )
    };
    (short < 0.01 * four.size())
        .then(|| Diagnostic::warning("sizes", message()))
        .into_iter()
        .collect()
}
