//! The drawing board: ruler and paper, in millimetres.
//!
//! A [`Plan`] is written down as [`Acts`], which are what a draughtsman does: take the pole, lay off known vectors, draw lines of known direction, cross
//! them, copy triangles by similarity, measure. Their evaluation is a [`Drawing`]: marks in millimetres, which μ turns into answers.
//! Neither looks at the loop equations. Each mark is made by a [`pencil`]: the exact one, or a blunt one
//! ([`by_hand`]), which shows what the drawing is worth.

mod acts;
mod between;
mod board;
mod checks;
mod choices;
mod drawing;
mod givens;
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
pub use readings::{Answer, Measured, Shown, ShownAs, read, read_by_hand};

use crate::plan::{Body, Plan, Term, VertexId};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_scene::{ByKind, DiagramKind};
use std::sync::Arc;

/// The mechanism drawn to scale.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagram<N = f64> {
    /// μ of lengths (m per mm).
    pub mu: f64,
    /// The place (m) that lies in the diagram's origin.
    pub origin: Point<N>,
    /// Vertices' places in mm of paper.
    pub spots: Vec<Option<Point<N>>>,
    /// Lines crossed on it: the special points that the construction uses.
    pub crossed: Vec<Crossed<N>>,
}

impl Diagram {
    /// Whether three places are in line, to a tenth of a millimetre of paper: less is no triangle.
    pub fn in_line(&self, vertices: [VertexId; 3]) -> bool {
        let [Some(a), Some(b), Some(c)] = vertices.map(|v| self.spots[v.0]) else { return false };
        (b - a).unit().is_none_or(|u| u.cross(c - a).abs() < 0.1)
    }
}

/// The end of a laid-off vector that is no vertex's image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mark {
    /// The pole.
    Pole,
    /// The image of a vertex.
    Image(VertexId),
    /// The end of a part of an equation: n′, k′ and the like, told by the term that ends there.
    Part(Term),
    /// The end of the same part drawn once more, between two images.
    Again(Term),
}

/// A vector drawn on the board.
#[derive(Clone, Debug, PartialEq)]
pub struct Edge<P = Point> {
    /// Its terms: one, or two that lie in one line and are drawn as one.
    pub terms: Vec<Term>,
    /// Where it starts.
    pub from: (Mark, P),
    /// Where it ends.
    pub to: (Mark, P),
    /// Whether its magnitude was known when it was drawn.
    pub known: bool,
    /// Whether it belongs to no equation, but is read off between two images.
    pub between: bool,
}

/// Two lines crossed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossed<N = f64> {
    /// The vertex found.
    pub target: VertexId,
    /// Sine of the angle between the lines.
    pub sine: N,
}

/// What was done, in order.
#[derive(Clone, Debug, PartialEq)]
pub enum Action<N = f64> {
    /// A known vector laid off: index of the edge.
    LayOff(usize),
    /// Terms along one line that vanish because a driver is at rest: nothing is laid off.
    Nothing {
        /// The terms.
        terms: Vec<Term>,
        /// Where they would begin and end.
        at: Point<N>,
        /// The vertex whose image lies there, if the last of them would end in it.
        target: Option<VertexId>,
    },
    /// A line of known direction drawn from the end of the known part of a chain.
    Line {
        /// The unknown terms along it.
        terms: Vec<Term>,
        /// The mark through which it is drawn: two marks may lie at one place.
        mark: Mark,
        /// Point on paper.
        through: Point<N>,
        /// Unit direction.
        direction: Vec2<N>,
    },
    /// Two lines crossed, which gave two edges (indices).
    Cross {
        /// The vertex found.
        target: VertexId,
        /// The edges it closed.
        edges: Vec<usize>,
        /// Sine of the crossing.
        sine: N,
    },
    /// The lines of two trials crossed.
    Trials {
        /// The vertex found.
        target: VertexId,
        /// A point and the unit direction of each line: of the images, and of their mates.
        lines: [(Point<N>, Vec2<N>); 2],
        /// Sine of the crossing.
        sine: N,
    },
    /// A vertex's image is where its chain starts: nothing is added to the known vector.
    Reach(VertexId),
    /// A triangle copied.
    Copy {
        /// The vertex found.
        target: VertexId,
        /// The two images that it stands on.
        from: (VertexId, VertexId),
    },
    /// The same image as another vertex, because the link does not turn.
    Same {
        /// The vertex found.
        target: VertexId,
        /// The other.
        from: VertexId,
    },
    /// Two marks joined by a vector: index of the edge.
    Join(usize),
    /// A relative vector resolved by the perpendicular from its end on a line through its start: indices of the part along the line and
    /// of the one square to it.
    Perpendicular {
        /// Along the line, and square to it.
        edges: [usize; 2],
        /// Unit direction of the line.
        direction: Vec2<N>,
    },
    /// An angular rate found (index into [`Drawing::rates`]).
    Rate(usize),
}

impl<N> Action<N> {
    /// Whether the action finds no image, but draws and measures between images that are there.
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

    /// The vectors that it draws (indices of edges).
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

    /// The vertex whose image it finds; a vector laid off finds that at its end ([`Edge::to`]).
    pub fn finds(&self) -> Option<VertexId> {
        match self {
            Action::Cross { target, .. }
            | Action::Trials { target, .. }
            | Action::Reach(target)
            | Action::Copy { target, .. }
            | Action::Same { target, .. } => Some(*target),
            Action::Nothing { target, .. } => *target,
            Action::LayOff(_) | Action::Line { .. } | Action::Join(_) | Action::Perpendicular { .. } | Action::Rate(_) => None,
        }
    }
}

/// A polygon.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon<N = f64> {
    /// Velocity or acceleration.
    pub on: DiagramKind,
    /// μ, SI per mm.
    pub mu: f64,
    /// Images of the vertices, mm from the pole; fixed vertices lie in the pole.
    pub images: Vec<Option<Point<N>>>,
    /// Vectors drawn.
    pub edges: Vec<Edge<Point<N>>>,
    /// What was done.
    pub actions: Vec<Action<N>>,
}

/// The marks of a vector, from the first to the second, and whether the drawing shows the opposite one.
type Vector<P> = ([(Mark, P); 2], bool);

impl<N: Copy> Polygon<N> {
    /// The mark of a vertex: its image, the pole for a fixed one.
    pub fn mark(&self, plan: &Plan, v: VertexId) -> Mark {
        if plan.vertex(v).fixed { Mark::Pole } else { Mark::Image(v) }
    }

    /// The two marks between which a vector of these terms is drawn, one edge or consecutive ones; and whether the drawing shows the
    /// opposite vector: the marks are exchanged then.
    pub fn edge_of(&self, terms: &[Term]) -> Option<Vector<Point<N>>> {
        edge_of(&self.edges, terms)
    }
}

/// Returns the mark, with its place, in which a term ends that is drawn from another mark.
fn end_of<P: Copy>(edges: &[Edge<P>], from: &Mark, term: &Term) -> Option<(Mark, P)> {
    let drawn = |e: &&Edge<P>| e.from.0 == *from && matches!(&e.terms[..], [t] if t.is_same(term) == Some(false));
    edges.iter().find(drawn).map(|e| e.to)
}

/// See [`Polygon::edge_of`].
fn edge_of<P: Copy>(edges: &[Edge<P>], terms: &[Term]) -> Option<Vector<P>> {
    let shows = |e: &Edge<P>, t: &Term| if let [u] = &e.terms[..] { u.is_same(t) } else { None };
    // What vanishes has no edge: the others are all there is.
    let drawn: Vec<&Term> = terms.iter().filter(|t| edges.iter().any(|e| shows(e, t).is_some())).collect();
    let (head, rest) = drawn.split_first()?;
    let row = |reversed: bool| {
        let is = |e: &&Edge<P>, t: &Term| shows(e, t) == Some(reversed);
        let after = |before: &Edge<P>, t: &Term| edges.iter().find(|e| is(e, t) && e.from.0 == before.to.0);
        let whole = |first| Some((first, rest.iter().try_fold(first, |before, t| after(before, t))?));
        edges.iter().filter(|e| is(e, head)).find_map(whole)
    };
    let marks = |(first, last): (&Edge<P>, &Edge<P>), reversed| if reversed { [last.to, first.from] } else { [first.from, last.to] };
    [false, true].into_iter().find_map(|reversed| Some((marks(row(reversed)?, reversed), reversed)))
}

impl Polygon {
    /// The polygon's largest distance from the pole, in SI: the scale against which small differences are judged.
    pub fn largest(&self) -> f64 {
        self.images.iter().flatten().map(|p| p.to_vec2().norm()).fold(0.0, f64::max) * self.mu
    }

    /// The same polygon to another scale.
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

    /// Whether it is a single point: all its vectors are zero.
    pub fn is_empty(&self) -> bool {
        self.extent() == [0.0, 0.0]
    }

    /// Width and height of all that is drawn, the pole included, in SI.
    pub fn extent(&self) -> [f64; 2] {
        let marks = self.edges.iter().flat_map(|e| [e.from.1, e.to.1]).chain(self.images.iter().flatten().copied());
        scale::extent(marks.chain([Point::ORIGIN])).map(|mm| mm * self.mu)
    }
}

/// An angular rate read off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RateReading<N = f64> {
    /// The polygon on which it is measured: that of velocities for ω, of accelerations for α.
    pub on: DiagramKind,
    /// The body.
    pub body: Body,
    /// rad/s or rad/s².
    pub value: N,
    /// What was measured; `None` where it was given.
    pub measured: Option<RateMeasured<N>>,
}

/// The vector from which an angular rate was measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RateMeasured<N = f64> {
    /// Its length, square to the arm (mm of polygon).
    pub length: N,
    /// The arm, by which the product with μ was divided (m).
    pub arm: N,
    /// The line on which it was measured: of the first vertex, seen from the second.
    pub line: (VertexId, VertexId),
    /// The marks between which it lies.
    pub marks: [(Mark, Point<N>); 2],
}

/// Everything on the board.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing<N = f64> {
    /// The mechanism to scale.
    pub diagram: Diagram<N>,
    /// The vector diagrams, each to its own scale, in the order in which they were drawn: the polygon of the velocities if they are
    /// asked for, that of the accelerations.
    pub diagrams: Vec<Polygon<N>>,
    /// Angular rates.
    pub rates: Vec<RateReading<N>>,
    /// The acts that were drawn.
    pub acts: Arc<Acts>,
    /// The factor by which the worst crossing that a polygon rests on magnifies rounding; none where it rests on none.
    magnification: ByKind,
}

impl Drawing {
    /// The scale of the mechanism or of a polygon, SI per mm; `None` where there is no polygon.
    pub fn scale(&self, on: DiagramKind) -> Option<f64> {
        if on == DiagramKind::Plane { Some(self.diagram.mu) } else { self.polygon(on).map(|p| p.mu) }
    }

    /// True for a polygon that is a single point, because nothing moves: it has a pole, and no scale worth telling.
    pub fn is_empty(&self, on: DiagramKind) -> bool {
        self.polygon(on).is_some_and(Polygon::is_empty)
    }
}

impl<N> Drawing<N> {
    /// The factor by which the worst crossing that a diagram rests on magnifies rounding; 1 without crossings.
    pub fn magnified(&self, on: DiagramKind) -> f64 {
        self.magnification.get(on.kind()).unwrap_or(1.0)
    }
}

impl<N: Real> Drawing<N> {
    /// The polygon of a kind, if it is drawn.
    pub fn polygon(&self, on: DiagramKind) -> Option<&Polygon<N>> {
        self.diagrams.iter().find(|p| p.on == on)
    }

    /// The crossings on a diagram, in the order in which they were drawn.
    pub fn crossings(&self, on: DiagramKind) -> Vec<Crossed<N>> {
        match self.polygon(on) {
            None if on == DiagramKind::Plane => self.diagram.crossed.clone(),
            None => Vec::new(),
            Some(p) => p
                .actions
                .iter()
                .filter_map(|a| {
                    let (Action::Cross { target, sine, .. } | Action::Trials { target, sine, .. }) = *a else { return None };
                    Some(Crossed { target, sine })
                })
                .collect(),
        }
    }

    /// A vertex's vector in SI, through μ.
    pub fn vector(&self, on: DiagramKind, v: VertexId) -> Option<Vec2<N>> {
        let p = self.polygon(on)?;
        Some(p.images[v.0]?.to_vec2() * scale::number(p.mu))
    }

    /// An angular rate.
    pub fn rate(&self, on: DiagramKind, body: Body) -> Option<N> {
        // Mostly one that was read last is wanted.
        self.rates.iter().rev().find(|r| r.on == on && r.body == body).map(|r| r.value)
    }
}
