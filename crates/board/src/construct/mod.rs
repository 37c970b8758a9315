//! The drawing board: ruler and paper, in millimetres.
//!
//! A [`Plan`] is written as [`Acts`], the work of a draughtsman: take the pole, lay off known
//! vectors, draw lines of known direction, cross them, copy triangles by similarity, measure. Their
//! evaluation is a [`PlanDrawing`]: marks in millimetres, which μ converts to answers. The loop
//! equations are not used. Each mark is made by a [`pencil`]: an exact one, or a blunt one
//! ([`by_hand`]), which shows the accuracy of the drawing.

mod acts;
mod between;
mod board;
mod checks;
mod choices;
mod drawing;
pub(crate) mod givens;
mod known;
mod layout;
mod readings;
mod refusal;
pub mod scale;
mod special;

pub use crate::construction::pencil;
pub use acts::Acts;
pub use checks::{Condition, conditions};
pub use drawing::by_hand;
pub use layout::{Layout, construct};
pub use readings::source;
pub use readings::{DrawnVector, FindAnswer, MeasuredDistance, ShownAs, read, read_by_hand};

use crate::plan::{Plan, Term, TurningBody, VertexId};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_scene::{ByKind, DiagramKind, Paper};
use std::sync::Arc;

/// Returns the pencil error (mm) of a paper: its own, else the usual one.
pub fn pencil_mm(paper: &Paper) -> f64 {
    paper.pencil_mm.unwrap_or(pencil::USUAL_MM)
}

/// The mechanism drawn to scale.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagram<N = f64> {
    /// The scale μ of lengths (m per mm).
    pub mu: f64,
    /// The place (m) at the diagram's origin.
    pub origin: Point<N>,
    /// The places of the vertices (mm of paper).
    pub spots: Vec<Option<Point<N>>>,
    /// Lines crossed on the diagram: the special points that the construction uses.
    pub crossed: Vec<Crossed<N>>,
}

impl Diagram {
    /// True if three places are collinear, to a tenth of a millimetre of paper, so that they form
    /// no triangle.
    pub fn in_line(&self, vertices: [VertexId; 3]) -> bool {
        let [Some(a), Some(b), Some(c)] = vertices.map(|v| self.spots[v.0]) else { return false };
        (b - a).unit().is_none_or(|u| u.cross(c - a).abs() < 0.1)
    }
}

/// The end of a vector on a polygon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PolygonMark {
    /// The pole.
    Pole,
    /// The image of a vertex.
    Image(VertexId),
    /// The end of a part of an equation (n′, k′ and the like), given by the term that ends there.
    Part(Term),
    /// The end of the same part drawn a second time, between two images.
    Again(Term),
}

/// A vector drawn on the board.
#[derive(Clone, Debug, PartialEq)]
pub struct Edge<P = Point> {
    /// The terms: one, or two along one line that are drawn as one.
    pub terms: Vec<Term>,
    /// The start of the vector.
    pub from: (PolygonMark, P),
    /// The end of the vector.
    pub to: (PolygonMark, P),
    /// True if its magnitude was known when it was drawn.
    pub known: bool,
    /// True if it belongs to no equation, but is read between two images.
    pub between: bool,
}

/// The crossing of two lines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossed<N = f64> {
    /// The vertex found.
    pub target: VertexId,
    /// The sine of the angle between the lines.
    pub sine: N,
}

/// An action of the drawing.
#[derive(Clone, Debug, PartialEq)]
pub enum Action<N = f64> {
    /// A known vector is laid off: index of the edge.
    LayOff(usize),
    /// Terms along one line vanish because a driver is at rest: nothing is laid off.
    Nothing {
        /// The terms.
        terms: Vec<Term>,
        /// The place at which they begin and end.
        at: Point<N>,
        /// The vertex with its image there, if the last of them ends in it.
        target: Option<VertexId>,
    },
    /// A line of known direction is drawn from the end of the known part of a chain.
    Line {
        /// The unknown terms along it.
        terms: Vec<Term>,
        /// The mark through which it is drawn; two marks may have the same place.
        mark: PolygonMark,
        /// The place of the mark on paper.
        through: Point<N>,
        /// The unit direction.
        direction: Vec2<N>,
    },
    /// Two lines are crossed.
    Cross {
        /// The vertex found.
        target: VertexId,
        /// The indices of the edges that the crossing closes.
        edges: Vec<usize>,
        /// The sine of the crossing.
        sine: N,
    },
    /// The lines of two trials are crossed.
    Trials {
        /// The vertex found.
        target: VertexId,
        /// A point and the unit direction of each line: of the images, and of their mates.
        lines: [(Point<N>, Vec2<N>); 2],
        /// The sine of the crossing.
        sine: N,
    },
    /// A vertex has its image at the start of its chain: nothing is added to the known vector.
    Reach(VertexId),
    /// A triangle is copied.
    Copy {
        /// The vertex found.
        target: VertexId,
        /// The two images on which the triangle is based.
        from: (VertexId, VertexId),
    },
    /// A vertex gets the image of another vertex, because the link does not turn.
    Same {
        /// The vertex found.
        target: VertexId,
        /// The other vertex.
        from: VertexId,
    },
    /// Two marks are joined by a vector: index of the edge.
    Join(usize),
    /// A relative vector is resolved by the perpendicular from its end to a line through its start.
    Perpendicular {
        /// Indices of the part along the line, and of the part square to it.
        edges: [usize; 2],
        /// The unit direction of the line.
        direction: Vec2<N>,
    },
    /// An angular velocity or acceleration is found (index into [`PlanDrawing::rates`]).
    Rate(usize),
}

impl<N> Action<N> {
    /// True if the action finds no image, but draws and measures between existing images.
    pub fn reads(&self) -> bool {
        match self {
            Action::Join(_) | Action::Perpendicular { .. } | Action::Rate(_) => true,
            Action::LayOff(_)
            | Action::Nothing { .. }
            | Action::Line { .. }
            | Action::Cross { .. }
            | Action::Trials { .. }
            | Action::Reach(_)
            | Action::Copy { .. }
            | Action::Same { .. } => false,
        }
    }

    /// Returns the vectors that the action draws (indices of edges).
    pub fn edges(&self) -> &[usize] {
        match self {
            Action::LayOff(e) | Action::Join(e) => std::slice::from_ref(e),
            Action::Cross { edges, .. } => edges,
            Action::Perpendicular { edges, .. } => edges,
            Action::Nothing { .. }
            | Action::Trials { .. }
            | Action::Line { .. }
            | Action::Reach(_)
            | Action::Copy { .. }
            | Action::Same { .. }
            | Action::Rate(_) => &[],
        }
    }

    /// Returns the vertex with the image that the action finds; for a laid-off vector, the image is
    /// at its end ([`Edge::to`]).
    pub fn finds(&self) -> Option<VertexId> {
        match self {
            Action::Cross { target, .. }
            | Action::Trials { target, .. }
            | Action::Reach(target)
            | Action::Copy { target, .. }
            | Action::Same { target, .. } => Some(*target),
            Action::Nothing { target, .. } => *target,
            Action::LayOff(_)
            | Action::Line { .. }
            | Action::Join(_)
            | Action::Perpendicular { .. }
            | Action::Rate(_) => None,
        }
    }
}

/// A polygon of velocities or accelerations.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon<N = f64> {
    /// The kind of polygon.
    pub on: DiagramKind,
    /// The scale μ (SI per mm).
    pub mu: f64,
    /// The images of the vertices, mm from the pole; fixed vertices have their image at the pole.
    pub images: Vec<Option<Point<N>>>,
    /// The vectors drawn.
    pub edges: Vec<Edge<Point<N>>>,
    /// The actions, in order.
    pub actions: Vec<Action<N>>,
}

/// The marks of a vector, from the first to the second, and true if the drawing shows the opposite
/// vector.
type VectorMarks<P> = ([(PolygonMark, P); 2], bool);

impl<N: Copy> Polygon<N> {
    /// Returns the mark of a vertex: its image, or the pole for a fixed one.
    pub fn mark(&self, plan: &Plan, v: VertexId) -> PolygonMark {
        if plan.vertex(v).fixed { PolygonMark::Pole } else { PolygonMark::Image(v) }
    }

    /// Returns the two marks between which a vector of these terms is drawn, as one edge or
    /// consecutive ones, and true if the drawing shows the opposite vector: the marks are then
    /// exchanged.
    pub fn edge_of(&self, terms: &[Term]) -> Option<VectorMarks<Point<N>>> {
        edge_of(&self.edges, terms)
    }
}

/// Returns the mark, with its place, at the end of a term that is drawn from another mark.
fn end_of<P: Copy>(edges: &[Edge<P>], from: &PolygonMark, term: &Term) -> Option<(PolygonMark, P)> {
    let drawn = |e: &&Edge<P>| {
        e.from.0 == *from && matches!(&e.terms[..], [t] if t.is_same(term) == Some(false))
    };
    edges.iter().find(drawn).map(|e| e.to)
}

/// The common part of [`Polygon::edge_of`] for all kinds of places.
fn edge_of<P: Copy>(edges: &[Edge<P>], terms: &[Term]) -> Option<VectorMarks<P>> {
    let shows = |e: &Edge<P>, t: &Term| if let [u] = &e.terms[..] { u.is_same(t) } else { None };
    // Terms that vanish have no edge: only the others count.
    let drawn: Vec<&Term> =
        terms.iter().filter(|t| edges.iter().any(|e| shows(e, t).is_some())).collect();
    let (head, rest) = drawn.split_first()?;
    let row = |reversed: bool| {
        let is = |e: &&Edge<P>, t: &Term| shows(e, t) == Some(reversed);
        let after =
            |before: &Edge<P>, t: &Term| edges.iter().find(|e| is(e, t) && e.from.0 == before.to.0);
        let whole =
            |first| Some((first, rest.iter().try_fold(first, |before, t| after(before, t))?));
        edges.iter().filter(|e| is(e, head)).find_map(whole)
    };
    let marks = |(first, last): (&Edge<P>, &Edge<P>), reversed| {
        if reversed { [last.to, first.from] } else { [first.from, last.to] }
    };
    [false, true].into_iter().find_map(|reversed| Some((marks(row(reversed)?, reversed), reversed)))
}

impl Polygon {
    /// Returns the polygon's largest distance from the pole, in SI: the reference for small
    /// differences.
    pub fn largest(&self) -> f64 {
        self.images.iter().flatten().map(|p| p.to_vec2().norm()).fold(0.0, f64::max) * self.mu
    }

    /// Returns the polygon at another scale.
    pub fn to_scale(&self, mu: f64) -> Polygon {
        let k = self.mu / mu;
        let moved = |at: &mut Point| *at = (at.to_vec2() * k).to_point();
        let mut own = Polygon { mu, ..self.clone() };
        own.images.iter_mut().flatten().for_each(moved);
        for e in &mut own.edges {
            moved(&mut e.from.1);
            moved(&mut e.to.1);
        }
        for action in &mut own.actions {
            match action {
                Action::Nothing { at, .. } | Action::Line { through: at, .. } => moved(at),
                Action::Trials { lines, .. } => lines.iter_mut().for_each(|(at, _)| moved(at)),
                Action::LayOff(_)
                | Action::Cross { .. }
                | Action::Reach(_)
                | Action::Copy { .. }
                | Action::Same { .. }
                | Action::Join(_)
                | Action::Perpendicular { .. }
                | Action::Rate(_) => {}
            }
        }
        own
    }

    /// True if the polygon is a single point: all its vectors are zero.
    pub fn is_empty(&self) -> bool {
        self.extent() == [0.0, 0.0]
    }

    /// Returns the width and height of the drawing including the pole, in SI.
    pub fn extent(&self) -> [f64; 2] {
        let marks = self
            .edges
            .iter()
            .flat_map(|e| [e.from.1, e.to.1])
            .chain(self.images.iter().flatten().copied());
        scale::extent(marks.chain([Point::ORIGIN])).map(|mm| mm * self.mu)
    }
}

/// A measured angular velocity or acceleration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RateReading<N = f64> {
    /// The polygon on which it is measured: velocities for ω, accelerations for α.
    pub on: DiagramKind,
    /// The body.
    pub body: TurningBody,
    /// The value (rad/s or rad/s²).
    pub value: N,
    /// The measured vector; `None` for a given value.
    pub measured: Option<RateMeasured<N>>,
}

/// The vector from which an angular quantity is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RateMeasured<N = f64> {
    /// The component square to the arm (mm of polygon).
    pub length: N,
    /// The arm, the divisor of the product with μ (m).
    pub arm: N,
    /// The line on which it is measured: its first vertex relative to the second.
    pub line: (VertexId, VertexId),
    /// The marks at its ends.
    pub marks: [(PolygonMark, Point<N>); 2],
}

/// A finished drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanDrawing<N = f64> {
    /// The mechanism to scale.
    pub diagram: Diagram<N>,
    /// The vector diagrams, each to its own scale, in the order in which they were drawn: the
    /// velocity polygon if it is asked for, and the acceleration polygon.
    pub diagrams: Vec<Polygon<N>>,
    /// The angular velocities and accelerations.
    pub rates: Vec<RateReading<N>>,
    /// The acts that were drawn.
    pub acts: Arc<Acts>,
    /// The factor by which the worst crossing that a polygon depends on magnifies rounding errors;
    /// none for a polygon without crossings.
    magnification: ByKind,
}

impl PlanDrawing {
    /// Returns the scale of the mechanism or of a polygon (SI per mm); `None` if there is no such
    /// polygon.
    pub fn scale(&self, on: DiagramKind) -> Option<f64> {
        if on == DiagramKind::Plane {
            Some(self.diagram.mu)
        } else {
            self.polygon(on).map(|p| p.mu)
        }
    }

    /// True for a polygon that is a single point, because nothing moves: it has a pole, and no
    /// meaningful scale.
    pub fn is_empty(&self, on: DiagramKind) -> bool {
        self.polygon(on).is_some_and(Polygon::is_empty)
    }
}

impl<N> PlanDrawing<N> {
    /// Returns the factor by which the worst crossing that a diagram depends on magnifies rounding
    /// errors; 1 without crossings.
    pub fn magnified(&self, on: DiagramKind) -> f64 {
        self.magnification.get(on.kind()).unwrap_or(1.0)
    }
}

impl<N: Real> PlanDrawing<N> {
    /// Returns the polygon of a kind, if it is drawn.
    pub fn polygon(&self, on: DiagramKind) -> Option<&Polygon<N>> {
        self.diagrams.iter().find(|p| p.on == on)
    }

    /// Returns the crossings on a diagram, in the order in which they were drawn.
    pub fn crossings(&self, on: DiagramKind) -> Vec<Crossed<N>> {
        match self.polygon(on) {
            None if on == DiagramKind::Plane => self.diagram.crossed.clone(),
            None => Vec::new(),
            Some(p) => p
                .actions
                .iter()
                .filter_map(|a| {
                    let (Action::Cross { target, sine, .. } | Action::Trials { target, sine, .. }) =
                        *a
                    else {
                        return None;
                    };
                    Some(Crossed { target, sine })
                })
                .collect(),
        }
    }

    /// Returns a vertex's vector in SI, by means of μ.
    pub fn vector(&self, on: DiagramKind, v: VertexId) -> Option<Vec2<N>> {
        let p = self.polygon(on)?;
        Some(p.images[v.0]?.to_vec2() * scale::number(p.mu))
    }

    /// Returns the angular velocity or acceleration of a body.
    pub fn rate(&self, on: DiagramKind, body: TurningBody) -> Option<N> {
        // Usually the last one read is wanted.
        self.rates.iter().rev().find(|r| r.on == on && r.body == body).map(|r| r.value)
    }
}
