//! Drawings of body guidance: bisectors for two and three positions, inversion for given pivots,
//! the centre-point curve for four and five.

use super::among::Among;
use super::pose::BodyPose;
use super::{Body, Method};
use crate::board::{PaperLine, SynthesisBoard, Weight, cross_circles};
use crate::candidate::Draft;
use hodograph_base::diag::both;
use hodograph_base::digits::significant;
use hodograph_base::geom::{Point, Vec2};
use std::f64::consts::PI;

impl Body {
    pub(super) fn drawn(&self, draft: &Draft, board: &mut SynthesisBoard) -> Option<()> {
        let bodies = self.positions_drawn(board);
        match self.method() {
            Method::Bisectors => {
                let ends =
                    [self.side(draft, board, &bodies, 0)?, self.side(draft, board, &bodies, 1)?];
                finished(board, ends)
            }
            Method::Curve | Method::Burmester => self.curve(draft, board, &bodies),
        }
    }

    /// A length that suits the drawing: a third of the body's greatest displacement (mm).
    fn reach(&self, board: &SynthesisBoard) -> f64 {
        let far = self
            .positions
            .iter()
            .map(|p| p.origin.distance(self.positions[0].origin))
            .fold(0.0, f64::max);
        board.mm(if far > 0.0 { far / 3.0 } else { 0.05 })
    }

    /// Lays off the positions. In each, two points of the body are drawn: its origin and one along
    /// its direction, with one opening of the compasses for all.
    fn positions_drawn(&self, board: &mut SynthesisBoard) -> Vec<[Point; 2]> {
        board
            .step(both!("Lay off the given positions of the body: its origin E and its direction"));
        let reach = self.reach(board);
        let of_position = |p: &BodyPose| {
            let origin = board.at(p.origin);
            [origin, PaperLine::ray(origin, p.angle).place(reach)]
        };
        let bodies: Vec<[Point; 2]> = self.positions.iter().map(of_position).collect();
        for (k, [origin, tip]) in bodies.iter().enumerate() {
            board.line(*origin, *tip, Weight::Given).mark(&format!("E_{}", k + 1), *origin);
        }
        bodies
    }

    /// The pin in position 1 and the pivot of one side.
    fn side(
        &self,
        draft: &Draft,
        board: &mut SynthesisBoard,
        bodies: &[[Point; 2]],
        side: usize,
    ) -> Option<[Point; 2]> {
        let [pin, pivot] = [["B", "C"], ["A", "D"]].map(|n| n[side]);
        let (places, sought) = match self.moving[side] {
            Some(local) => {
                let of_position = |(p, body): (&BodyPose, &[Point; 2])| {
                    PaperLine::ray(body[0], p.angle).place(board.mm(local.x))
                        + Vec2::from_angle(p.angle).perp() * board.mm(local.y)
                };
                let places: Vec<Point> =
                    self.positions.iter().zip(bodies).map(of_position).collect();
                board.step(both!(
                    "Mark {pin} in all positions; the bisectors of its places meet at {pivot}"
                ));
                for (k, at) in places.iter().enumerate() {
                    board.mark(&format!("{pin}_{}", k + 1), *at);
                }
                (places, pivot)
            }
            None => {
                let at = board.at(self.ground[side]?);
                board.step(both!(
                    "Carry {pivot} back with the body into position 1 (two openings of the compasses each)"
                ));
                board.mark(pivot, at);
                let mut places = vec![at];
                for (k, body) in bodies.iter().enumerate().skip(1) {
                    let back = board.transfer(at, *body, bodies[0])?;
                    board.mark(&format!("{pivot}_{}'", k + 1), back);
                    places.push(back);
                }
                board.step(both!("The bisectors of these places meet at {pin}1"));
                (places, pin)
            }
        };
        let found = match places[..] {
            [p, q, r] => board.centre(p, q, r)?,
            [p, q] => {
                let line = board.bisector(p, q)?;
                let name = if self.moving[side].is_some() {
                    sought.to_owned()
                } else {
                    format!("{sought}1")
                };
                let of = |axis: &str| {
                    draft
                        .numbers
                        .iter()
                        .find(|n| n.name == format!("{name}_{axis}"))
                        .map(|n| n.value)
                };
                // Any point of the bisector is a solution: the chosen one is laid off along it.
                let chosen = board.at(Point::new(of("x")?, of("y")?));
                line.place((chosen - line.at).dot(line.along))
            }
            _ => return None,
        };
        let given = places[0];
        let name =
            if self.moving[side].is_some() { sought.to_owned() } else { format!("{sought}_1") };
        board.mark(&name, found);
        board.read(["AB", "CD"][side], given, found);
        Some(if self.moving[side].is_some() { [given, found] } else { [found, given] })
    }

    /// A pole: the intersection of the bisectors of two points of the body.
    fn pole(
        &self,
        board: &mut SynthesisBoard,
        bodies: &[[Point; 2]],
        [i, j]: [usize; 2],
    ) -> Option<Point> {
        let (p, q) = (bodies.get(i)?, bodies.get(j)?);
        let (one, other) = (bisector(p[0], q[0])?, bisector(p[1], q[1])?);
        let at = one.cross(&other)?;
        board
            .line(one.at, at, Weight::Thin)
            .line(other.at, at, Weight::Thin)
            .mark(&format!("P_{{{}{}}}", i + 1, j + 1), at);
        Some(at)
    }

    /// The centre-point curve by the opposite-pole quadrilateral: circles over P₁₂P₂₃ and P₁₄P₃₄
    /// with equal inscribed angles.
    fn curve(
        &self,
        draft: &Draft,
        board: &mut SynthesisBoard,
        bodies: &[[Point; 2]],
    ) -> Option<()> {
        board.step(both!(
            "Find the poles of the positions: in each two bisectors of the places of points of the body meet"
        ));
        let [p12, p23, p14, p34, p13] =
            [[0, 1], [1, 2], [0, 3], [2, 3], [0, 2]].map(|of| self.pole(board, bodies, of));
        let quadrilateral = [p12?, p23?, p14?, p34?];
        board.step(both!("Circle over P12P23 and circle over P14P34 with the same inscribed angle intersect at centre points; as the angle varies they trace the centre-point curve"));
        let curve = centre_points(quadrilateral);
        for piece in &curve {
            piece.windows(2).for_each(|w| {
                board.line(w[0].1, w[1].1, Weight::Thin);
            });
        }
        let roots = match self.method() {
            Method::Bisectors | Method::Curve => match self.among {
                Some(among) => self.among_them(draft, board, among, &curve, quadrilateral),
                None => self.on_the_line(board, &curve, quadrilateral)?,
            },
            Method::Burmester => self.on_both(board, bodies, &curve, quadrilateral)?,
        };
        // The two pivots of the design are the ones sought.
        let wanted = |name: &str| {
            let of = |axis: &str| {
                draft.numbers.iter().find(|n| n.name == format!("{name}_{axis}")).map(|n| n.value)
            };
            Some(board.at(Point::new(of("x")?, of("y")?)))
        };
        let near = |at: Point| {
            roots.iter().copied().min_by(|p, q| p.distance(at).total_cmp(&q.distance(at)))
        };
        let (a, d) = (near(wanted("A")?)?, near(wanted("D")?)?);
        board.step(both!(
            "Moving pins: P12M and P13M turned about P12 and P13 by half the turning, backward, intersect at the pin of M"
        ));
        let half = |j: usize| -(self.positions[j].angle - self.positions[0].angle) / 2.0;
        let pin = |m: Point| {
            let ray = |pole: Point, j: usize| PaperLine::ray(pole, (m - pole).angle() + half(j));
            ray(p12?, 1).cross(&ray(p13?, 2))
        };
        let (b, c) = (pin(a)?, pin(d)?);
        board.mark("A", a).mark("D", d).mark("B_1", b).mark("C_1", c);
        for (pole, m, pin) in [(p12?, a, b), (p13?, a, b), (p12?, d, c), (p13?, d, c)] {
            board.line(pole, m, Weight::Thin).line(pole, pin, Weight::Thin);
        }
        board.read("AB", a, b).read("CD", c, d);
        finished(board, [[b, a], [c, d]])
    }

    /// The intersections of the curve with the given line.
    fn on_the_line(
        &self,
        board: &mut SynthesisBoard,
        curve: &[Vec<CentrePoint>],
        poles: [Point; 4],
    ) -> Option<Vec<Point>> {
        let (through, direction) = self.line?;
        let line = PaperLine { at: board.at(through), along: direction };
        board.step(both!("The curve crosses the given line in the pivots"));
        let off = |m: Point| line.along.cross(m - line.at);
        let roots = crossings(curve, poles, &off);
        let along = |m: &Point| line.along.dot(*m - line.at);
        let low = roots.iter().map(along).fold(f64::INFINITY, f64::min);
        let high = roots.iter().map(along).fold(f64::NEG_INFINITY, f64::max);
        if low < high {
            let over = 0.15 * (high - low);
            board.line(line.place(low - over), line.place(high + over), Weight::Given);
        }
        Some(roots)
    }

    /// The pivots within a box, where the curve has the height of the chosen pivots; or at
    /// inscribed angles, where their circles intersect.
    fn among_them(
        &self,
        draft: &Draft,
        board: &mut SynthesisBoard,
        among: Among,
        curve: &[Vec<CentrePoint>],
        poles: [Point; 4],
    ) -> Vec<Point> {
        match among {
            Among::Box(corners) => {
                let [p, q] = corners.map(|c| board.at(c));
                let corners = [p, Point::new(q.x, p.y), q, Point::new(p.x, q.y)];
                board.step(both!(
                    "Of the curve within the given box the pivots are chosen: A and D at their heights"
                ));
                for k in 0..4 {
                    board.line(corners[k], corners[(k + 1) % 4], Weight::Given);
                }
                let heights = draft
                    .numbers
                    .iter()
                    .filter(|n| n.name == "A_y" || n.name == "D_y")
                    .map(|n| board.mm(n.value));
                heights.flat_map(|y| crossings(curve, poles, &|m: Point| m.y - y)).collect()
            }
            Among::Angles(angles) => {
                let [a, d] = angles.map(|b| significant(b.to_degrees(), 4));
                board.step(both!(
                    "The circles of the inscribed angle {a}° intersect at A, those of {d}° at D"
                ));
                for angle in angles {
                    for (p, q) in [(poles[0], poles[1]), (poles[2], poles[3])] {
                        if let Some((c, r)) = over(p, q, angle) {
                            board.circle(c, r, Weight::Thin);
                        }
                    }
                }
                angles.into_iter().filter_map(|b| at_angle(poles, b)).flatten().collect()
            }
        }
    }

    /// The intersections of the curves of 1234 and of 1235: there the angles over P₁₂P₂₃ and P₁₅P₃₅
    /// are equal too.
    fn on_both(
        &self,
        board: &mut SynthesisBoard,
        bodies: &[[Point; 2]],
        curve: &[Vec<CentrePoint>],
        poles: [Point; 4],
    ) -> Option<Vec<Point>> {
        board.step(both!(
            "The same with P15 and P35: where both curves cross are Burmester's centre points"
        ));
        let (p15, p35) = (self.pole(board, bodies, [0, 4])?, self.pole(board, bodies, [2, 4])?);
        let off = |m: Point| {
            let angle = |p: Point, q: Point| libm::atan2((p - m).cross(q - m), (p - m).dot(q - m));
            libm::sin(angle(poles[0], poles[1]) - angle(p15, p35))
        };
        Some(crossings(curve, poles, &off))
    }
}

/// The bisector of two places, without drawing.
fn bisector(p: Point, q: Point) -> Option<PaperLine> {
    let [one, other] = cross_circles(p, 0.7 * p.distance(q), q, 0.7 * p.distance(q))?;
    PaperLine::through(one, other)
}

/// The resulting four-bar: pin and pivot of both sides.
fn finished(board: &mut SynthesisBoard, [[b, a], [c, d]]: [[Point; 2]; 2]) -> Option<()> {
    board.step(both!("Draw the linkage AB1C1D in position 1"));
    board.line(a, b, Weight::Result).line(b, c, Weight::Result).line(c, d, Weight::Result);
    board.read("BC", b, c).read("AD", a, d);
    Some(())
}

/// A centre point: the inscribed angle of its circles, and its place.
type CentrePoint = (f64, Point);

/// The circle over a chord for an inscribed angle (rad, signed): centre on the bisector, and
/// radius.
fn over(p: Point, q: Point, angle: f64) -> Option<(Point, f64)> {
    let lean = PI / 2.0 - angle;
    let (one, other) =
        (PaperLine::ray(p, (q - p).angle() + lean), PaperLine::ray(q, (p - q).angle() - lean));
    let centre = one.cross(&other)?;
    Some((centre, centre.distance(p)))
}

/// The two intersections of both circles for one inscribed angle.
fn at_angle([p12, p23, p14, p34]: [Point; 4], angle: f64) -> Option<[Point; 2]> {
    let ((c, r), (d, s)) = (over(p12, p23, angle)?, over(p14, p34, angle)?);
    cross_circles(c, r, d, s)
}

/// Steps of the inscribed angle.
const STEPS: usize = 2880;

/// The pieces of the curve: each intersection followed as the angle varies.
fn centre_points(poles: [Point; 4]) -> Vec<Vec<CentrePoint>> {
    let mut pieces: Vec<Vec<CentrePoint>> = Vec::new();
    for k in 0..2 {
        let mut piece: Vec<CentrePoint> = Vec::new();
        for i in 0..=STEPS {
            let angle = PI * (i as f64 + 0.5) / STEPS as f64;
            match at_angle(poles, angle).map(|c| c[k]) {
                Some(m) => piece.push((angle, m)),
                None if piece.len() > 1 => pieces.push(std::mem::take(&mut piece)),
                None => piece.clear(),
            }
        }
        pieces.push(piece);
    }
    pieces
}

/// The points of the curve at which a function vanishes, by bisection of the inscribed angle.
fn crossings(
    curve: &[Vec<CentrePoint>],
    poles: [Point; 4],
    off: &dyn Fn(Point) -> f64,
) -> Vec<Point> {
    let mut out = Vec::new();
    for w in curve.iter().flat_map(|piece| piece.windows(2)) {
        let ((mut low, m), (mut high, n)) = (w[0], w[1]);
        let (first, last) = (off(m), off(n));
        if first * last > 0.0 || first == 0.0 && last == 0.0 {
            continue;
        }
        let (mut at, mut next) = (m, n);
        for _ in 0..60 {
            let middle = (low + high) / 2.0;
            let Some(found) = at_angle(poles, middle) else { break };
            let there = found
                .into_iter()
                .min_by(|p, q| p.distance(at).total_cmp(&q.distance(at)))
                .unwrap_or(at);
            if (off(there) > 0.0) == (first > 0.0) {
                (low, at) = (middle, there)
            } else {
                (high, next) = (middle, there)
            }
        }
        // A jump through infinity changes the sign without a root.
        if at.distance(next) < 1e-6 * (1.0 + at.to_vec2().norm()) {
            out.push(next);
        }
    }
    out
}
