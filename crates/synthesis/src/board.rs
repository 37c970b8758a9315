//! The drawing board of synthesis: constructions with ruler and compasses, in millimetres of paper.
//!
//! A [`SynthesisBoard`] does not use the formulas: it lays off the givens to the scale μ_l, draws
//! lines and circles, marks their crossings and measures. Its only arithmetic is that of crossings,
//! so that its agreement with the closed formula is evidence. Given angles are laid off with the
//! protractor; halves, bisectors and circles through points are drawn.

use super::candidate::Draft;
use super::fourbar;
use hodograph_base::diag::{Both, both};
use hodograph_base::geom::{Point, Vec2, cross_lines};
use hodograph_board::construct::pencil::{Blunt, Hand};
pub use hodograph_mechanism::position::kernel::crossing as cross_circles;

/// The weight of a stroke.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weight {
    /// Givens.
    Given,
    /// Construction lines, which are kept (保留作图线).
    Thin,
    /// The resulting linkage.
    Result,
}

/// A stroke on the paper (mm).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PaperStroke {
    /// A segment between two places.
    Line(Point, Point),
    /// A full circle: centre and radius.
    Circle(Point, f64),
    /// A short arc that the compasses strike at a crossing: centre, radius and direction (rad).
    Arc(Point, f64, f64),
}

/// A step of the construction.
#[derive(Clone, Debug, PartialEq)]
pub struct BoardStep {
    /// The instruction.
    pub text: Both,
    /// The strokes.
    pub strokes: Vec<(PaperStroke, Weight)>,
    /// The marks that the step adds: name in the label language, and place.
    pub marks: Vec<(String, Point)>,
    /// The angles that the step lays off or finds.
    pub angles: Vec<PaperAngle>,
}

/// An angle marked on the paper.
#[derive(Clone, Debug, PartialEq)]
pub struct PaperAngle {
    /// The vertex.
    pub at: Point,
    /// A place on each leg; the arc runs from the first leg to the second, the shorter way.
    pub legs: [Point; 2],
    /// The name, in the label language.
    pub name: String,
}

/// A length or angle measured on the paper, for comparison with the formula's value.
#[derive(Clone, Debug, PartialEq)]
pub struct PaperReading {
    /// The name of the number of the design that the reading checks.
    pub name: String,
    /// The value on paper (mm; rad for an angle).
    pub measured: f64,
    /// True for an angle.
    pub angle: bool,
}

/// The drawing board.
#[derive(Clone, Debug)]
pub struct SynthesisBoard {
    /// The scale μ_l: metres per millimetre of paper.
    pub mu_l: f64,
    /// The steps drawn.
    pub steps: Vec<BoardStep>,
    /// The readings taken.
    pub readings: Vec<PaperReading>,
    hand: Hand,
}

/// Circles whose lines are nearer than this are read as touching (mm).
const LINE_MM: f64 = 0.5;
/// Two places nearer than this are one mark (mm), errors of the pencil excepted.
const SAME_MM: f64 = 1e-3;

/// A way of drawing a task.
pub type ConstructionVariant<'a> = dyn Fn(&mut SynthesisBoard) -> Option<()> + 'a;

/// A line on paper: a place and a direction.
#[derive(Clone, Copy, Debug)]
pub struct PaperLine {
    /// A point of the line.
    pub at: Point,
    /// The direction, a unit vector.
    pub along: Vec2,
}

impl PaperLine {
    /// The line through two places; `None` where they coincide.
    pub fn through(p: Point, q: Point) -> Option<PaperLine> {
        Some(PaperLine { at: p, along: (q - p).unit()? })
    }

    /// The line from a place at an angle (rad).
    pub fn ray(at: Point, angle: f64) -> PaperLine {
        PaperLine { at, along: Vec2::from_angle(angle) }
    }

    /// The place at a distance along the line (mm).
    pub fn place(&self, distance_mm: f64) -> Point {
        self.at + self.along * distance_mm
    }

    /// The intersection with another line.
    pub fn cross(&self, other: &PaperLine) -> Option<Point> {
        Some(cross_lines(self.at, self.along, other.at, other.along).at).filter(|p| p.is_finite())
    }

    /// The intersections with a circle, in the direction of the line.
    pub fn cross_circle(&self, centre: Point, radius_mm: f64) -> Option<[Point; 2]> {
        fourbar::cross_circle(self.at, self.along, centre, radius_mm)
            .map(|both| both.map(|s| self.place(s)))
    }

    /// The perpendicular through a place.
    pub fn square(&self, through: Point) -> PaperLine {
        PaperLine { at: through, along: self.along.perp() }
    }
}

impl SynthesisBoard {
    /// Returns an empty sheet.
    pub fn new(mu_l: f64) -> SynthesisBoard {
        SynthesisBoard { mu_l, steps: Vec::new(), readings: Vec::new(), hand: Hand::default() }
    }

    /// Returns an empty sheet for an inaccurate pencil: places laid off, marks, openings of the
    /// compasses and readings have errors.
    pub fn by_hand(mu_l: f64, pencil: Blunt) -> SynthesisBoard {
        SynthesisBoard { hand: Hand::with(pencil, 1.0), ..SynthesisBoard::new(mu_l) }
    }

    /// Returns the mark for an intended place.
    fn marked(&self, at: Point) -> Point {
        self.hand.mark(at)
    }

    /// The intersections of two circles, the one left of the line of centres first. With an
    /// inaccurate pencil, circles that miss each other by less than the width of a pencil line are
    /// marked as touching.
    pub fn circles(&self, p: Point, r: f64, q: Point, s: f64) -> Option<[Point; 2]> {
        let touching = || {
            let gap = (p.distance(q) - r - s).max((r - s).abs() - p.distance(q));
            let along = PaperLine::through(p, q).filter(|_| self.misses() && gap < LINE_MM)?;
            let at = along.place(if r >= s || p.distance(q) > s { r } else { -r });
            Some([at, at])
        };
        let found = cross_circles(p, r, q, s).or_else(touching)?;
        Some(found.map(|at| self.marked(at)))
    }

    /// The intersections of a line and a circle, in the direction of the line; touching as for
    /// [`SynthesisBoard::circles`].
    pub fn cut(&self, line: &PaperLine, centre: Point, radius_mm: f64) -> Option<[Point; 2]> {
        let touching = || {
            let foot = line.place(line.along.dot(centre - line.at));
            (self.misses() && foot.distance(centre) - radius_mm < LINE_MM).then_some([foot, foot])
        };
        let found = line.cross_circle(centre, radius_mm).or_else(touching)?;
        Some(found.map(|at| self.marked(at)))
    }

    fn misses(&self) -> bool {
        self.hand.misses()
    }

    /// The value of a reading at full size (m or rad).
    pub fn value(&self, reading: &PaperReading) -> f64 {
        if reading.angle { reading.measured.abs() } else { reading.measured * self.mu_l }
    }

    /// A length on paper (mm).
    pub fn mm(&self, length_m: f64) -> f64 {
        let length = length_m / self.mu_l;
        // The compasses take it from a ruler: only the component of an error along the ruler
        // counts.
        length + self.marked(Point::ORIGIN).x
    }

    /// A place on paper. A place laid off before keeps its mark.
    pub fn at(&self, place: Point) -> Point {
        self.hand.laid_off(place, Point::new(place.x / self.mu_l, place.y / self.mu_l))
    }

    /// Begins a step.
    pub fn step(&mut self, text: Both) -> &mut SynthesisBoard {
        self.steps.push(BoardStep {
            text: text.sentence(),
            strokes: Vec::new(),
            marks: Vec::new(),
            angles: Vec::new(),
        });
        self
    }

    fn last(&mut self) -> &mut BoardStep {
        if self.steps.is_empty() {
            self.step(Both::default());
        }
        let end = self.steps.len() - 1;
        &mut self.steps[end]
    }

    /// Draws a segment.
    pub fn line(&mut self, p: Point, q: Point, weight: Weight) -> &mut SynthesisBoard {
        self.last().strokes.push((PaperStroke::Line(p, q), weight));
        self
    }

    /// Draws a circle.
    pub fn circle(&mut self, centre: Point, radius_mm: f64, weight: Weight) -> &mut SynthesisBoard {
        self.last().strokes.push((PaperStroke::Circle(centre, radius_mm), weight));
        self
    }

    /// Strikes a short arc about a centre at a place.
    pub fn arc(&mut self, centre: Point, at: Point) -> &mut SynthesisBoard {
        self.last().strokes.push((
            PaperStroke::Arc(centre, centre.distance(at), (at - centre).angle()),
            Weight::Thin,
        ));
        self
    }

    /// Marks and names a place.
    pub fn mark(&mut self, name: &str, at: Point) -> &mut SynthesisBoard {
        // A point found again by another construction keeps its name.
        let there = |(n, p): &(String, Point)| n == name && p.distance(at) < SAME_MM;
        if !self.steps.iter().any(|s| s.marks.iter().any(there)) {
            self.last().marks.push((name.to_owned(), at));
        }
        self
    }

    /// Marks an angle at a vertex between two places with an arc and its name.
    pub fn angle(&mut self, at: Point, legs: [Point; 2], name: &str) -> &mut SynthesisBoard {
        self.last().angles.push(PaperAngle { at, legs, name: name.to_owned() });
        self
    }

    /// Reads the length between two places.
    pub fn read(&mut self, name: &str, p: Point, q: Point) -> &mut SynthesisBoard {
        self.readings.push(PaperReading {
            name: name.to_owned(),
            measured: self.marked(p).distance(self.marked(q)),
            angle: false,
        });
        self
    }

    /// Reads an angle (rad).
    pub fn read_angle(&mut self, name: &str, angle: f64) -> &mut SynthesisBoard {
        self.readings.push(PaperReading { name: name.to_owned(), measured: angle, angle: true });
        self
    }

    /// The perpendicular bisector: two circles of equal radius, and the line through their
    /// intersections.
    pub fn bisector(&mut self, p: Point, q: Point) -> Option<PaperLine> {
        // A radius well over half the distance gives sharp crossings.
        let opening = 0.7 * p.distance(q);
        let [one, other] = cross_circles(p, opening, q, opening)?.map(|at| self.marked(at));
        let line = PaperLine::through(one, other)?;
        for (centre, at) in [(p, one), (q, one), (p, other), (q, other)] {
            self.arc(centre, at);
        }
        let far = 0.35 * one.distance(other);
        self.line(one - line.along * far, other + line.along * far, Weight::Thin);
        Some(line)
    }

    /// The midpoint of two places.
    pub fn middle(&mut self, p: Point, q: Point) -> Option<Point> {
        let line = self.bisector(p, q)?;
        line.cross(&PaperLine::through(p, q)?).map(|at| self.marked(at))
    }

    /// The centre of the circle through three places: the intersection of two bisectors.
    pub fn centre(&mut self, p: Point, q: Point, r: Point) -> Option<Point> {
        let (one, other) = (self.bisector(p, q)?, self.bisector(q, r)?);
        let centre = self.marked(one.cross(&other)?);
        for (line, a, b) in [(one, p, q), (other, q, r)] {
            let middle = a + (b - a) * 0.5;
            if middle.distance(centre) > 0.0 && line.along.norm2() > 0.0 {
                self.line(middle, centre, Weight::Thin);
            }
        }
        Some(centre)
    }

    /// The circle over a chord with an inscribed angle θ (rad): its centre and radius. From either
    /// end the centre appears at 90° − θ from the chord; if `left`, it is left of the chord seen
    /// from the first end.
    pub fn inscribed(
        &mut self,
        p: Point,
        q: Point,
        angle: f64,
        left: bool,
    ) -> Option<(Point, f64)> {
        let side = if left { 1.0 } else { -1.0 };
        let lean = side * (std::f64::consts::FRAC_PI_2 - angle);
        let chord = q - p;
        let (one, other) =
            (PaperLine::ray(p, chord.angle() + lean), PaperLine::ray(q, (p - q).angle() - lean));
        let centre = self.marked(one.cross(&other)?);
        self.line(p, centre, Weight::Thin).line(q, centre, Weight::Thin);
        let acute = angle < std::f64::consts::FRAC_PI_2;
        let name = if acute { "90\\degree - \\theta" } else { "\\theta - 90\\degree" };
        self.angle(p, [q, centre], name).angle(q, [p, centre], name);
        let radius = centre.distance(p);
        self.circle(centre, radius, Weight::Thin);
        Some((centre, radius))
    }

    /// Moves a place with a body from one position to another: two openings of the compasses, from
    /// two points of the body.
    pub fn transfer(&mut self, at: Point, from: [Point; 2], to: [Point; 2]) -> Option<Point> {
        let (r, s) = (at.distance(from[0]), at.distance(from[1]));
        let left = (from[1] - from[0]).cross(at - from[0]) > 0.0;
        let found = match cross_circles(to[0], r, to[1], s) {
            Some([one, other]) => {
                if left {
                    one
                } else {
                    other
                }
            }
            // A place in line with the two points: the circles touch.
            None => {
                to[0]
                    + (to[1] - to[0])
                        * ((at - from[0]).dot(from[1] - from[0]) / (from[1] - from[0]).norm2())
            }
        };
        let found = self.marked(found);
        self.arc(to[0], found).arc(to[1], found);
        Some(found)
    }

    /// The limit positions of crank and coupler: the crank is half the difference of AC₁ and AC₂,
    /// halved with the compasses.
    pub fn halve(&mut self, a: Point, c: [Point; 2]) -> Option<()> {
        self.halve_at(a, c, "F")
    }

    /// Performs [`SynthesisBoard::halve`] with another letter than F for the end of the difference.
    pub fn halve_at(&mut self, a: Point, c: [Point; 2], letter: &str) -> Option<()> {
        let far = usize::from(a.distance(c[1]) > a.distance(c[0]));
        let (long, short) = (c[far], c[1 - far]);
        let reach = a.distance(short) + self.marked(Point::ORIGIN).x;
        let ray = PaperLine::through(a, long)?;
        let cut = ray.place(reach);
        self.step(both!(
            "With AC{} as opening about A cut AC{} at {letter}; halve {letter}C{}: the half is the crank AB, the rest the coupler BC",
            2 - far,
            far + 1,
            far + 1
        ));
        self.arc(a, cut).arc(a, short).mark(letter, cut).angle(a, c, "\\theta");
        let middle = self.middle(cut, long)?;
        self.mark("G", middle);
        self.read("AB", middle, long).read("BC", a, middle);
        let (crank, b) = (middle.distance(long), ray.place(middle.distance(long)));
        self.step(both!(
            "Draw the crank circle about A; B lies on AC{}: the linkage in that limit",
            far + 1
        ));
        self.circle(a, crank, Weight::Given);
        self.line(a, b, Weight::Result).line(b, long, Weight::Result).mark("B", b);
        Some(())
    }

    /// Draws the task in several ways (choice of crossing or side) and keeps the one whose readings
    /// are nearest to the design's numbers.
    pub fn meant(&mut self, draft: &Draft, ways: &[&ConstructionVariant]) -> Option<()> {
        let off = |board: &SynthesisBoard| {
            let of = |r: &PaperReading| {
                draft
                    .numbers
                    .iter()
                    .find(|n| n.name == r.name)
                    .map(|n| (board.value(r) - n.value.abs()).abs())
            };
            board.readings.iter().filter_map(of).fold(0.0, f64::max)
        };
        let drawn = ways.iter().filter_map(|way| {
            let mut board = self.clone();
            way(&mut board).map(|()| board)
        });
        *self = drawn.min_by(|a, b| off(a).total_cmp(&off(b)))?;
        Some(())
    }
}
