//! The nearest feasible task where no linkage guides the body: another pin, another place of a
//! position, another line, box or angle.

use super::among::{self, Among};
use super::burmester::{of_five, on_line};
use super::pose::{BodyPose, centre};
use super::{Body, FAR, Method};
use crate::nearest::{number, roughly, told};
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::geom::{Point, Vec2};
use std::f64::consts::FRAC_PI_2;

/// A change of one number: its amount (mm or degrees), and the text that proposes it.
type Change = (f64, Both);

impl Body {
    /// The range over which numbers are varied (mm).
    fn scale(&self) -> f64 {
        let far = |p: &BodyPose| p.origin.distance(self.positions[0].origin);
        self.positions.iter().map(far).fold(0.0, f64::max).max(1e-3) * 1e3
    }

    /// True if the three places of a side's pin, or of its pivot moved back, are on a circle of
    /// practical size.
    fn round(&self, side: usize) -> bool {
        matches!(self.places(side)[..], [p, q, r] if centre(p, q, r).is_some_and(|(_, angle)| angle >= FAR))
    }

    /// The places of a side's given joint: of its pin in the positions, or of its pivot, moved back
    /// with the body.
    pub(super) fn places(&self, side: usize) -> Vec<Point> {
        match (self.moving[side], self.ground[side]) {
            (Some(local), _) => self.positions.iter().map(|p| p.place(local)).collect(),
            (None, at) => self
                .positions
                .iter()
                .map(|p| p.carry(&self.positions[0], at.unwrap_or(Point::ORIGIN)))
                .collect(),
        }
    }

    /// Reports a joint whose places are collinear, so that a slider guides it and no pivot;
    /// proposes a place of it, or of position 2, that works.
    pub(super) fn straight(&self, side: usize) -> Diagnostic {
        let [pin, pivot] = [["B", "C"], ["A", "D"]].map(|n| n[side]);
        let moving = self.moving[side].is_some();
        let (given, sought) = if moving { (pin, pivot) } else { (pivot, pin) };
        let message = match moving {
            true => {
                both!("the three places of {given} lie in line: {sought} would be infinitely far")
            }
            false => both!(
                "{given}, carried back into position 1, lies in line: {sought} would be infinitely far"
            ),
        };
        let changes = [0, 1]
            .into_iter()
            .flat_map(|axis| [self.joint(side, given, axis), self.second(side, axis)]);
        let nearest = changes.flatten().min_by(|a, b| a.0.total_cmp(&b.0)).map(|c| c.1);
        let slider = both!("guide {given} on a straight line (a slider)");
        let help = match nearest {
            Some(nearest) => both!("{}; else {}", nearest, slider),
            None => slider,
        };
        Diagnostic::error("no-real-solution", message).help(help)
    }

    /// Reports a joint that does not move between two positions: the pole, which is on no circle of
    /// a link.
    pub(super) fn still(&self, side: usize) -> Diagnostic {
        let given = if self.moving[side].is_some() { ["B", "C"] } else { ["A", "D"] }[side];
        let own = self.moving[side]
            .unwrap_or_else(|| self.ground[side].unwrap_or(Point::ORIGIN).to_vec2());
        let [x, y] = [own.x * 1e3 + self.scale(), own.y * 1e3].map(told);
        let message = both!("{given} is the pole of the two positions: it does not move");
        let help = both!("\"{given}\": [\"{x} mm\", \"{y} mm\"] does");
        Diagnostic::error("no-real-solution", message).help(help)
    }

    /// Reports two joints in one place, which make no link of the two sides.
    pub(super) fn one_joint(&self, pairs: &[super::BurmesterPair]) -> Option<Diagnostic> {
        let [one, other] = pairs else { return None };
        let near = |p: Point, q: Point| p.distance(q) <= 1e-9 * self.scale() * 1e-3;
        let names = match (near(one.pin, other.pin), near(one.centre, other.centre)) {
            (true, _) => ["B", "C"],
            (false, true) => ["A", "D"],
            (false, false) => return None,
        };
        let [p, q] = names;
        let message = both!("{p} and {q} come out in one place: the two sides are one link");
        let own =
            self.moving[1].unwrap_or_else(|| self.ground[1].unwrap_or(Point::ORIGIN).to_vec2());
        let given = if self.moving[1].is_some() { "C" } else { "D" };
        let [x, y] = [own.x * 1e3 + self.scale(), own.y * 1e3].map(told);
        let help = both!("\"{given}\": [\"{x} mm\", \"{y} mm\"] does");
        Some(Diagnostic::error("wrong-given", message).help(help))
    }

    /// The given joint moved along an axis to a place that works.
    fn joint(&self, side: usize, given: &str, axis: usize) -> Option<Change> {
        let own = self.moving[side]
            .unwrap_or_else(|| self.ground[side].unwrap_or(Point::ORIGIN).to_vec2());
        let mut at = [own.x * 1e3, own.y * 1e3];
        let from = at[axis];
        let with = |v: f64, mut at: [f64; 2]| {
            at[axis] = v;
            let at = Vec2::new(at[0] * 1e-3, at[1] * 1e-3);
            let mut other = self.clone();
            if self.moving[side].is_some() {
                other.moving[side] = Some(at)
            } else {
                other.ground[side] = Some(at.to_point())
            }
            other
        };
        at[axis] = number(from, self.scale(), |v| with(v, at).round(side))?;
        let said = both!("\"{given}\": [\"{} mm\", \"{} mm\"] does", told(at[0]), told(at[1]));
        Some(((at[axis] - from).abs(), said))
    }

    /// Position 2 moved along an axis so that both sides work.
    fn second(&self, side: usize, axis: usize) -> Option<Change> {
        let own = self.positions[1];
        let mut at = [own.origin.x * 1e3, own.origin.y * 1e3];
        let from = at[axis];
        let with = |v: f64, mut at: [f64; 2]| {
            at[axis] = v;
            let mut other = self.clone();
            other.positions[1].origin = Point::new(at[0] * 1e-3, at[1] * 1e-3);
            other
        };
        at[axis] =
            number(from, self.scale(), |v| with(v, at).round(side) && with(v, at).round(1 - side))?;
        let [x, y] = at.map(told);
        let said = both!("position 2 at [\"{x} mm\", \"{y} mm\"] does");
        Some(((at[axis] - from).abs(), said))
    }

    /// A line that intersects the centre-point curve of four positions at least twice: the given
    /// one, moved across itself.
    fn cutting(&self, positions: &[BodyPose], (through, along): (Point, Vec2)) -> Option<Both> {
        let cuts = |at: Point| on_line(positions, at, along).len() > 1;
        let across = along.perp();
        let step = roughly(0.0, self.scale(), |mm| {
            let at = rounded(through + across * (mm * 1e-3));
            cuts(at)
        })?;
        let at = rounded(through + across * (step * 1e-3));
        let angle = told(along.angle().to_degrees());
        let [x, y] = [at.x, at.y].map(|v| told(v * 1e3));
        Some(both!(
            "\"line\": {{\"through\": [\"{x} mm\", \"{y} mm\"], \"angle\": \"{angle} deg\"}} does"
        ))
    }

    /// Reports fewer than two pivots.
    pub(super) fn too_few(&self, count: usize) -> Diagnostic {
        let level = (self.positions[0].origin, Vec2::new(1.0, 0.0));
        let (message, help) = match self.method() {
            Method::Bisectors | Method::Curve => {
                let nearest = self.cutting(&self.positions, self.line.unwrap_or(level));
                let poles =
                    both!("move or turn \"line\": the curve passes the poles P12, P23, P34");
                (
                    both!(
                        "the line meets the centre-point curve in {count} point: a linkage has two pivots"
                    ),
                    nearest.unwrap_or(poles),
                )
            }
            Method::Burmester => {
                let leave = both!("leave position 5 out");
                let help = match self.cutting(&self.positions[..4], level) {
                    Some(line) => both!("{}: then {}", leave, line),
                    None => leave,
                };
                (
                    both!(
                        "these five positions have {count} real pairs of pin and pivot: their other roots are complex"
                    ),
                    match self.fifth() {
                        Some(nearest) => both!("{}; or {}", nearest, help),
                        None => help,
                    },
                )
            }
        };
        Diagnostic::error("no-real-solution", message).help(help)
    }

    /// Another direction of position 5 that has a linkage.
    fn fifth(&self) -> Option<Both> {
        let mut other = self.positions.clone();
        let own = other[4].angle.to_degrees();
        let works = |v: f64| {
            let mut other = other.clone();
            other[4].angle = v.to_radians();
            of_five(&other).len() > 1
        };
        let angle = roughly(own, 45.0, works)?;
        other[4].angle = angle.to_radians();
        Some(both!("position 5 under {}° has one", told(angle)))
    }

    /// Reports that there are no pivots in the box or at the angles.
    pub(super) fn none_among(&self, among: Among) -> Diagnostic {
        let (message, help) = match among {
            Among::Box([low, high]) => {
                let grown = |mm: f64| {
                    [low, high]
                        .map(|p| (p, if p == low { -mm } else { mm }))
                        .map(|(p, mm)| rounded(p + Vec2::new(mm, mm) * 1e-3))
                };
                let works = |mm: f64| {
                    mm > 0.0 && !among::pairs(&self.positions, Among::Box(grown(mm))).is_empty()
                };
                let larger = roughly(0.0, self.scale().max(low.distance(high) * 1e3), works).map(|mm| {
                    let [p, q] = grown(mm).map(|p| [p.x, p.y].map(|v| told(v * 1e3)));
                    both!(
                        "\"box\": {{\"from\": [\"{} mm\", \"{} mm\"], \"to\": [\"{} mm\", \"{} mm\"]}} has some",
                        p[0],
                        p[1],
                        q[0],
                        q[1]
                    )
                });
                (
                    both!(
                        "within the box the centre-point curve has no two pivots of a linkage"
                    ),
                    larger.unwrap_or_else(|| match self.poles().is_empty() {
                        true => both!(
                            "the body does not turn, so its poles are infinitely far: a parallelogram moves it, or a slider"
                        ),
                        false => both!(
                            "make the box larger: the curve passes through the poles P12, P23, P34, P14"
                        ),
                    }),
                )
            }
            Among::Angles(angles) => {
                let two = self.seen(angles);
                (
                    both!("the circles of one of these angles do not cross"),
                    two.unwrap_or(both!("give a \"box\"")),
                )
            }
        };
        Diagnostic::error("no-real-solution", message).help(help)
    }

    /// Two inscribed angles, each the nearest whose circles intersect in a pivot.
    fn seen(&self, angles: [f64; 2]) -> Option<Both> {
        let crosses = |deg: f64| {
            let inside = deg > 0.0 && deg < FRAC_PI_2.to_degrees() * 2.0;
            inside && !among::at_angle(&self.positions, deg.to_radians()).is_empty()
        };
        let near = |a: f64| {
            let own = a.to_degrees();
            if crosses(own) { Some(own) } else { roughly(own, 45.0, crosses) }
        };
        let [p, q] = [near(angles[0])?, near(angles[1])?];
        // One angle may have one pivot only.
        let both_found = |q: f64| {
            !among::pairs(&self.positions, Among::Angles([p, q].map(f64::to_radians))).is_empty()
        };
        let q = if both_found(q) { q } else { roughly(q, 45.0, |v| crosses(v) && both_found(v))? };
        Some(both!("\"angles\": [\"{} deg\", \"{} deg\"] has some", told(p), told(q)))
    }
}

/// A place rounded to a hundredth of a millimetre, as it is printed.
fn rounded(p: Point) -> Point {
    let on = |v: f64| libm::rint(v * 1e5) / 1e5;
    Point::new(on(p.x), on(p.y))
}
