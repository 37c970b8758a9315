//! Evaluates a construction: where every mark falls.

use super::pencil::Pencil;
use super::scale;
use super::{
    Base, Construction, DiagramId, Direction, Key, Line, LineId, MarkId, Name, NumberId, Op, Step,
};
use hodograph_base::budget::spend;
use hodograph_base::diagram::DiagramKind;
use hodograph_base::geom::{Point, Vec2, cross_lines};
use hodograph_base::kind::ByKind;
use hodograph_base::number::Real;

/// Scales by kind of quantity (SI per mm). A diagram without a scale is not drawn.
pub type Scales = ByKind;

/// The givens of a construction, in numbers of one kind.
pub trait Givens<N> {
    /// A place of the mechanism (m); `None` where it is not known.
    fn place(&self, key: Key) -> Option<Point<N>>;
    /// A number, in SI.
    fn number(&self, key: Key) -> N;
    /// A vector, in SI; `None` where it is not known.
    fn vector(&self, _key: Key) -> Option<Vec2<N>> {
        None
    }
    /// A path on the mechanism; `None` where it is not known.
    fn path(&self, key: Key) -> Option<Track<N>>;
    /// The length (m) over which a path is drawn; the ruler is laid along its ends.
    fn reach(&self, path: Key) -> f64;
    /// The place (m) at the origin of the mechanism's drawing.
    fn origin(&self) -> Point<N>;
    /// The size of the mechanism (m), to which the rounding of places is relative.
    fn extent(&self) -> f64;
}

/// A path on the mechanism.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Track<N> {
    /// Straight, in the direction of a unit vector.
    Line(Vec2<N>),
    /// Along a circle.
    Arc {
        /// Its centre (m).
        centre: Point<N>,
        /// Its radius (m).
        radius: N,
    },
}

/// A number that has been measured or calculated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Value<N> {
    Scalar(N),
    Vector(Vec2<N>),
}

/// A crossing that was marked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Met<N = f64> {
    /// The step.
    pub step: usize,
    /// The mark.
    pub to: MarkId,
    /// The sine of the angle from the first line to the second.
    pub sine: N,
    /// The factor by which rounding of places affects the two directions together.
    pub rounding: f64,
}

/// The result of a drawing: the places of marks and lines.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnPlaces<N = f64> {
    /// The marks (mm from the origin of their diagram); `None` for those that are not drawn.
    pub marks: Vec<Option<Point<N>>>,
    /// The lines: a point, and the direction.
    pub lines: Vec<Option<(Point<N>, Vec2<N>)>>,
    /// The crossings, in the order of drawing.
    pub met: Vec<Met<N>>,
    /// For each path drawn, its rotation from the true direction as (cos, sin); empty with the
    /// exact pencil.
    pub turns: Vec<Option<Vec2<N>>>,
    pub(super) numbers: Vec<Option<Value<N>>>,
}

/// The step at which a construction stops, and the reason.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// The step.
    pub step: usize,
    /// The reason.
    pub why: Why,
}

/// The reason for which a construction stops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Why {
    /// Two lines are parallel, so that they do not cross in a mark.
    Parallel([LineId; 2], MarkId),
    /// Two places coincide, so that their line has no direction.
    Coincide,
    /// A mark of the mechanism that is needed has no place: the lines that cross in it are
    /// parallel.
    Missing(MarkId),
}

/// Draws a construction.
///
/// # Errors
/// The step at which two lines of a polygon are parallel, or two places coincide or are not given.
///
/// # Panics
/// For ids that refer to nothing, and numbers that refer to the scale of a diagram that has none.
pub fn draw<N: Real, P: Pencil<N>>(
    construction: &Construction,
    givens: &impl Givens<N>,
    scales: &Scales,
    pencil: &mut P,
) -> Result<DrawnPlaces<N>, Stop> {
    let scale = |kind: &DiagramKind| scales.get(kind.kind());
    let mu: Vec<Option<N>> =
        construction.diagrams.iter().map(|k| scale(k).map(scale::number)).collect();
    let plane = construction.diagram(DiagramKind::Plane).and_then(|d| mu[d.index()]);
    let drawn = DrawnPlaces {
        marks: vec![None; construction.marks.len()],
        lines: vec![None; construction.lines.len()],
        met: Vec::new(),
        turns: Vec::new(),
        numbers: vec![None; construction.numbers.len()],
    };
    let mu_l = plane.unwrap_or(N::from_f64(1.0));
    let mm_l = scale(&DiagramKind::Plane).unwrap_or(1.0);
    let mut board = Board {
        construction,
        givens,
        pencil,
        drawn,
        mu,
        mu_l,
        per_m: N::from_f64(1.0) / mu_l,
        mm_l,
    };
    for (index, step) in construction.steps.iter().enumerate() {
        spend();
        if board.mu[step.on.index()].is_some() {
            board.step(index, step).map_err(|why| Stop { step: index, why })?;
        }
    }
    Ok(board.drawn)
}

impl<N: Real> DrawnPlaces<N> {
    /// A measured vector, in SI; `None` for what is not measured, or is no vector.
    pub fn vector(&self, id: NumberId) -> Option<Vec2<N>> {
        match self.numbers[id.index()]? {
            Value::Vector(v) => Some(v),
            Value::Scalar(_) => None,
        }
    }

    /// The value of a number, in SI; a part measured across an arm in mm. `None` for what is not
    /// measured, or is no scalar.
    pub fn number(&self, id: NumberId) -> Option<N> {
        match self.numbers[id.index()]? {
            Value::Scalar(x) => Some(x),
            Value::Vector(_) => None,
        }
    }
}

pub(super) struct Board<'a, N, G, P> {
    pub(super) construction: &'a Construction,
    pub(super) givens: &'a G,
    pub(super) pencil: &'a mut P,
    pub(super) drawn: DrawnPlaces<N>,
    /// μ by diagram.
    pub(super) mu: Vec<Option<N>>,
    /// μ of the mechanism, its reciprocal, and the scale as it is printed.
    pub(super) mu_l: N,
    pub(super) per_m: N,
    pub(super) mm_l: f64,
}

/// The bound below which a crossing counts as parallel, in units of the rounding of its two
/// directions. Each direction is a difference of places known to half a unit in the last place of
/// the mechanism's size, divided by its length. Eight such units keep exact dead centres (sine 0 or
/// a few units) below the bound and poses 1e-9 rad away above it.
const PARALLEL_UNITS: f64 = 8.0;

impl<N: Real, G: Givens<N>, P: Pencil<N>> Board<'_, N, G, P> {
    fn step(&mut self, index: usize, step: &Step) -> Result<(), Why> {
        let construction = self.construction;
        for op in construction.ops(step) {
            match op {
                Op::Set(to) => self.set(*to),
                Op::Path(path) => self.path(*path),
                Op::Lay { vector, along, times } => {
                    let vector = &construction.vectors[vector.index()];
                    let from = self.place(vector.from)?;
                    let laid = self.direction(along)? * self.number(*times)?;
                    let mu = self.mu(step.on);
                    self.mark(vector.to, from + laid * (N::from_f64(1.0) / mu));
                }
                Op::Rule(line) => self.rule(*line)?,
                Op::Meet { lines, to } => self.meet(index, *lines, *to)?,
                Op::Foot { from, on, to } => {
                    let (from, Some((q, u))) = (self.place(*from)?, self.drawn.lines[on.index()])
                    else {
                        return Err(Why::Coincide);
                    };
                    self.mark(*to, q + u * u.dot(from - q));
                }
                Op::Image { of: [a, b, c], onto, to } => {
                    let [ia, ib] = [self.place(onto[0])?, self.place(onto[1])?];
                    let ratio = self.arm(*a, *c)?.divide_by(self.arm(*a, *b)?);
                    if !ratio.is_finite() {
                        return Err(Why::Coincide);
                    }
                    self.mark(*to, ia + (ib - ia).rotate_by(ratio));
                }
                Op::Same { mark, to, .. } | Op::Omit { at: mark, to: Some(to), .. } => {
                    self.drawn.marks[to.index()] = Some(self.place(*mark)?);
                }
                Op::Number(id) => {
                    let value = self.value(*id)?;
                    self.drawn.numbers[id.index()] = Some(value);
                }
                Op::Show(_) | Op::Omit { to: None, .. } => {}
            }
        }
        Ok(())
    }

    /// The kind of the diagram of a mark.
    pub(super) fn on(&self, mark: MarkId) -> DiagramKind {
        self.construction.diagrams[self.construction.marks[mark.index()].on.index()]
    }

    pub(super) fn mu(&self, on: DiagramId) -> N {
        self.mu[on.index()].expect("a diagram that is drawn has a scale")
    }

    /// Makes a mark at an intended place.
    fn mark(&mut self, to: MarkId, at: Point<N>) {
        self.drawn.marks[to.index()] = Some(self.pencil.mark(self.on(to), at));
    }

    pub(super) fn place(&self, mark: MarkId) -> Result<Point<N>, Why> {
        self.drawn.marks[mark.index()].ok_or(Why::Missing(mark))
    }

    /// A place of the mechanism in mm of paper.
    fn paper(&self, p: Point<N>) -> Point<N> {
        ((p - self.givens.origin()) * self.per_m).to_point()
    }

    fn set(&mut self, to: MarkId) {
        match self.construction.marks[to.index()].name {
            Name::Point(key) => {
                if let Some(at) = self.givens.place(key) {
                    self.mark(to, self.paper(at));
                }
            }
            // Vectors begin at the pencil's starting point, wherever it is.
            Name::Pole | Name::Image(_) | Name::End(_) | Name::Again(_) | Name::Vertex(_) => {
                self.drawn.marks[to.index()] = Some(Point::origin())
            }
        }
    }

    fn path(&mut self, path: Key) {
        if P::EXACT {
            return;
        }
        if self.drawn.turns.len() <= path.index() {
            self.drawn.turns.resize(path.index() + 1, None);
        }
        let apart = self.reach_mm(path);
        self.drawn.turns[path.index()] =
            Some(self.pencil.ruler(DiagramKind::Plane, Vec2::unit_x(), apart));
    }

    fn reach_mm(&self, path: Key) -> f64 {
        self.givens.reach(path) / self.mm_l
    }

    /// A direction that follows a given path, as the path was drawn.
    fn turned(&self, path: Key, direction: Vec2<N>) -> Vec2<N> {
        match self.drawn.turns.get(path.index()) {
            Some(Some(turn)) if !P::EXACT => direction.rotate_by(*turn),
            _ => direction,
        }
    }

    /// The vector from one mark to another on the mechanism, in metres.
    fn arm(&self, from: MarkId, to: MarkId) -> Result<Vec2<N>, Why> {
        Ok((self.place(to)? - self.place(from)?) * self.mu_l)
    }

    /// Returns the vector from one mark to another in metres, with the given length where it is
    /// known.
    fn arm_of(&self, from: MarkId, to: MarkId, known: bool) -> Result<Vec2<N>, Why> {
        let drawn = self.arm(from, to)?;
        if P::EXACT || !known {
            return Ok(drawn);
        }
        let given = |m: MarkId| match self.construction.marks[m.index()].name {
            Name::Point(key) => self.givens.place(key),
            Name::Pole | Name::Image(_) | Name::End(_) | Name::Again(_) | Name::Vertex(_) => None,
        };
        let length = given(from).zip(given(to)).map(|(p, q)| p.distance(q));
        Ok(drawn.unit().zip(length).map_or(drawn, |(u, l)| u * l))
    }

    pub(super) fn base(&self, base: &Base) -> Result<Vec2<N>, Why> {
        let given = |key: Key| self.givens.place(key).ok_or(Why::Coincide);
        let path = |key: Key| self.givens.path(key).ok_or(Why::Coincide);
        Ok(match *base {
            Base::Marks(from, to) => self.place(to)? - self.place(from)?,
            Base::Arm { from, to, known } => self.arm_of(from, to, known)?,
            Base::Part(from, to, part) => self.arm(from, to)? * self.number(part)?,
            Base::Places(from, to) => given(to)? - given(from)?,
            Base::Tangent(key, at) => {
                let tangent = match path(key)? {
                    Track::Line(direction) => direction,
                    Track::Arc { centre, radius } => {
                        let at = at.map_or(Ok(Point::origin()), given)?;
                        ((at - centre) * (N::from_f64(1.0) / radius)).perp()
                    }
                };
                self.turned(key, tangent)
            }
            Base::Normal(key, at) => {
                let normal = match path(key)? {
                    Track::Line(direction) => direction.perp(),
                    Track::Arc { centre, .. } => self.place(at)? - self.paper(centre),
                };
                self.turned(key, normal)
            }
            Base::Inward(key, at) => match path(key)? {
                Track::Line(_) => return Err(Why::Coincide),
                Track::Arc { centre, radius } => {
                    self.turned(key, (centre - given(at)?) * (N::from_f64(1.0) / radius))
                }
            },
            Base::Measured(id) => self.vector(id)?,
            Base::Given(key) => self.givens.vector(key).ok_or(Why::Coincide)?,
        })
    }

    pub(super) fn direction(&self, direction: &Direction) -> Result<Vec2<N>, Why> {
        let v = self.base(&direction.base)?;
        let v = match direction.quarters {
            0 => v,
            1 => v.perp(),
            2 => -v,
            _ => -v.perp(),
        };
        if direction.unit { v.unit().ok_or(Why::Coincide) } else { Ok(v) }
    }

    /// The distance (mm) of the two marks that define a direction: the joints of an arm, the ends
    /// of a path.
    fn apart(&self, base: &Base) -> Result<f64, Why> {
        Ok(match base {
            _ if P::EXACT => 0.0,
            Base::Marks(..) => self.base(base)?.approx().norm(),
            Base::Arm { .. } => self.base(base)?.approx().norm() / self.mm_l,
            Base::Tangent(path, _) | Base::Normal(path, _) | Base::Inward(path, _) => {
                self.reach_mm(*path)
            }
            Base::Part(..) | Base::Places(..) => self.base(base)?.approx().norm() / self.mm_l,
            Base::Measured(_) | Base::Given(_) => return Err(Why::Coincide),
        })
    }

    fn rule(&mut self, id: LineId) -> Result<(), Why> {
        let Line { through, along, moved, .. } = &self.construction.lines[id.index()];
        let (through, kind) = (*through, self.on(*through));
        let laid = self
            .place(through)
            .and_then(|at| Ok((at, self.direction(along)?, self.apart(&along.base)?)));
        let (at, v, apart) = match laid {
            Ok(laid) => laid,
            // A place of the mechanism is missing if a place that it depends on is.
            Err(_) if kind == DiagramKind::Plane => return Ok(()),
            Err(why) => return Err(why),
        };
        let at = if *moved { self.pencil.mark(kind, at) } else { at };
        let v = match v.unit() {
            _ if along.unit => self.pencil.ruler(kind, v, apart),
            Some(u) if !P::EXACT => self.pencil.ruler(kind, u, apart),
            _ => v,
        };
        self.drawn.lines[id.index()] = Some((at, v));
        Ok(())
    }

    /// The size of the mechanism over the length from which a direction is taken: the effect of the
    /// rounding of places.
    fn rounding(&self, line: LineId) -> Result<f64, Why> {
        let base = &self.construction.lines[line.index()].along.base;
        Ok(match *base {
            Base::Arm { from, to, .. } => {
                self.givens.extent() / self.arm(from, to)?.approx().norm()
            }
            Base::Marks(..)
            | Base::Part(..)
            | Base::Places(..)
            | Base::Tangent(..)
            | Base::Normal(..)
            | Base::Inward(..)
            | Base::Measured(_)
            | Base::Given(_) => 1.0,
        })
    }

    fn meet(&mut self, step: usize, lines: [LineId; 2], to: MarkId) -> Result<(), Why> {
        let plane = self.on(to) == DiagramKind::Plane;
        let (Some((p, u)), Some((q, w))) =
            (self.drawn.lines[lines[0].index()], self.drawn.lines[lines[1].index()])
        else {
            return if plane { Ok(()) } else { Err(Why::Parallel(lines, to)) };
        };
        let c = cross_lines(p, u, q, w);
        let rounding =
            if plane { 1.0 } else { 1.0 + self.rounding(lines[0])? + self.rounding(lines[1])? };
        // Numbers with error bounds are undecided where the lines may be parallel.
        let parallel = !plane
            && !N::knows_its_error()
            && c.sine.approx().abs() <= PARALLEL_UNITS * f64::EPSILON * rounding;
        if parallel || !c.at.is_finite() {
            return if plane { Ok(()) } else { Err(Why::Parallel(lines, to)) };
        }
        self.drawn.met.push(Met { step, to, sine: c.sine, rounding });
        self.mark(to, c.at);
        Ok(())
    }
}
