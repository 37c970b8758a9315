//! Four and five places at given crank rotations, all lengths unknown: for four places A and D are
//! on lines, for five they are some of a few points.
//!
//! |E_k − A − R(β_k) w| = BE for all k, with w = AB₁: so the points E_k − R(β_k) w are on a circle
//! about A. They are the places of a pin of a plane that has its origin in E_k and rotates with the
//! crank, and A is a centre point of its positions ([`burmester`]). This determines all positions
//! of the coupler, and D is a centre point of those.

use super::inversion;
use crate::body::burmester;
use crate::body::pose::BodyPose;
use crate::candidate::{DesignNumber, Draft};
use crate::form::TaskForm;
use crate::fourbar::Heading;
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::geom::{Point, Vec2};

/// A line through a place.
pub(super) type Ray = (Point, Vec2);

/// The task of four or five places at given crank rotations.
#[derive(Clone, Debug)]
pub(super) struct Prescribed {
    /// The places (m).
    pub points: Vec<Point>,
    /// The crank angles at them (rad).
    pub turns: Vec<f64>,
    /// The line of A and the line of D; `None` for five places, where nothing is free.
    pub lines: Option<[Ray; 2]>,
}

/// A crank shorter than this share of the distance of A from the path counts as zero.
const NONE: f64 = 1e-6;

/// Reads the line under a key.
pub(super) fn ray(form: &TaskForm, key: &'static str) -> Option<Ray> {
    form.need(key, "{\"through\": [\"100 mm\", \"0 mm\"], \"angle\": \"0 deg\"}")?;
    let inner = form.inner(key, &["through", "angle"])?;
    inner.need("through", "[\"100 mm\", \"0 mm\"]")?;
    let angle = if inner.has("angle") { inner.angle("angle") } else { Some(0.0) };
    let through = inner.point("through");
    Some((through?, Vec2::from_angle(angle?)))
}

/// Reads a task of four places: `line` for D and A, or `line_A` for A.
pub(super) fn read(form: &TaskForm, points: Vec<Point>) -> Option<Prescribed> {
    if let Some(key) = ["ground", "crank", "BE", "side", "seed"].into_iter().find(|k| form.has(k)) {
        let message = both!(
            "with `timing` at four places `{key}` is not free: the pivots lie on curves, the lengths follow"
        );
        let help = both!(
            "leave it out and give the \"line\" on which A and D lie (\"line_A\" for another line of A)"
        );
        form.fault(Diagnostic::error("wrong-given", message).at(form.span(key)).help(help));
        return None;
    }
    let turns = super::timing(form, points.len());
    let line = ray(form, "line");
    let of_a = if form.has("line_A") { ray(form, "line_A") } else { line };
    Some(Prescribed { points, turns: turns?, lines: Some([of_a?, line?]) })
}

impl Prescribed {
    /// The pivots A, each with B at all places.
    fn cranks(&self) -> Vec<(Point, Vec<Point>)> {
        let positions: Vec<BodyPose> = self
            .points
            .iter()
            .zip(&self.turns)
            .map(|(e, t)| BodyPose { origin: *e, angle: *t })
            .collect();
        let crank = |pair: burmester::BurmesterPair| {
            let (a, w) = (pair.centre, self.points[0] - pair.pin);
            let b: Vec<Point> = self
                .turns
                .iter()
                .map(|t| a + w.rotate_by(Vec2::from_angle(t - self.turns[0])))
                .collect();
            let far = self.points.iter().map(|e| e.distance(a)).fold(0.0, f64::max);
            (w.norm() > NONE * far && self.points[0].distance(b[0]) > NONE * far).then_some((a, b))
        };
        let found = match self.lines {
            Some([(through, along), _]) => burmester::on_line(&positions, through, along),
            None => burmester::of_five(&positions),
        };
        found.into_iter().filter_map(crank).collect()
    }

    /// The linkages for each A and each D.
    pub(super) fn linkages(&self, heading: &Heading) -> Vec<Draft> {
        let e = &self.points;
        let of_crank = |(i, (a, b)): (usize, &(Point, Vec<Point>))| -> Vec<Draft> {
            let pairs = inversion::followers(e, b, *a, self.lines.map(|l| l[1]));
            let one = |(k, p): (usize, &burmester::BurmesterPair)| {
                let which = both!("pivot A {}, pivot D {}", i + 1, k + 1);
                let mut draft = inversion::draft(e, b, [*a, p.centre], p.pin, which, heading);
                draft.numbers.push(DesignNumber::length("A_x", both!("place of A"), a.x));
                draft.numbers.push(DesignNumber::length("A_y", both!("place of A"), a.y));
                draft
            };
            pairs.iter().enumerate().map(one).collect()
        };
        self.cranks().iter().enumerate().flat_map(of_crank).collect()
    }

    /// Returns the linkages, or the error if there are none.
    pub(super) fn solve(&self, heading: &Heading) -> Result<Vec<Draft>, Faults> {
        let drafts = self.linkages(heading);
        if !drafts.is_empty() {
            return Ok(drafts);
        }
        let message = if self.cranks().is_empty() {
            both!(
                "the line of A does not meet the curve of the pivots at which the crank has these turns"
            )
        } else {
            both!("the line of D does not meet the centre-point curve of the coupler's positions")
        };
        Err(Diagnostic::error("no-real-solution", message).help(self.shifted()).into())
    }

    /// The nearest given lines, moved across themselves, that give a linkage.
    fn shifted(&self) -> Both {
        let size = self.points.iter().map(|p| p.distance(self.points[0])).fold(0.0, f64::max);
        let moved = |by: f64| {
            let lines = self
                .lines
                .map(|both| both.map(|(through, along)| (through + along.perp() * by, along)));
            let wish = Prescribed { lines, ..self.clone() };
            let follows = |(a, b): &(Point, Vec<Point>)| {
                !inversion::followers(&wish.points, b, *a, lines.map(|l| l[1])).is_empty()
            };
            wish.cranks().iter().any(follows)
        };
        // Twentieths of the path, up to twice its size to either side.
        let found = (1..=40)
            .flat_map(|k| [f64::from(k), -f64::from(k)])
            .map(|k| k * size / 20.0)
            .find(|by| moved(*by));
        match found {
            Some(by) => {
                let told = hodograph_base::digits::significant(by.abs() * 1e3, 4);
                if by > 0.0 {
                    both!("moved {told} mm to its left the line does")
                } else {
                    both!("moved {told} mm to its right the line does")
                }
            }
            None => both!("give another line, or other turns"),
        }
    }
}
