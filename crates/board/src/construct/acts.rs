//! Writes a plan as acts: the construction, and the points, terms and numbers of the scene behind
//! its keys.

use super::board::ActWriter;
use super::{Edge, PolygonMark, edge_of, end_of};
use crate::construction::{Construction, DiagramId, Key, MarkId, Name, NumberId};
use crate::plan::{Plan, Term, TurningBody, VertexId};
use hodograph_mechanism::mechanism::Mechanism;
use hodograph_scene::{DiagramKind, RollingId, Scene};
use std::sync::Arc;

/// A plan written as a construction. It holds no coordinates, and is valid in all poses with the
/// same special points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Acts {
    /// The acts.
    pub construction: Construction,
    /// The chosen alternative of the steps, for each group.
    pub chosen: Vec<usize>,
    /// The vectors of each diagram, in the order of the construction.
    pub(super) edges: Vec<Vec<Edge<MarkId>>>,
    /// For each diagram, the image of each vertex; in the plane, its place.
    pub(super) images: Vec<Vec<Option<MarkId>>>,
    /// The joints of the diagram.
    pub(super) joints: Vec<MarkId>,
    /// The angular velocities and accelerations of bodies.
    pub(super) turnings: Vec<BodyRate>,
    /// The terms behind the keys.
    pub(super) terms: Vec<Term>,
    /// The given numbers behind the keys.
    pub(super) givens: Vec<GivenNumber>,
}

/// A number that a scene gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum GivenNumber {
    /// The rate of a driver.
    Rate(usize),
    /// The acceleration of a driver.
    Acceleration(usize),
    /// One of the two sizes of a rolling pair.
    Size(RollingId, usize),
    /// The rate chosen for the second trial on a polygon.
    Trial(DiagramKind),
}

/// The angular velocity or acceleration of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct BodyRate {
    /// The polygon on which it is found.
    pub on: DiagramKind,
    /// The body.
    pub body: TurningBody,
    /// The number.
    pub number: NumberId,
    /// The measured part square to an arm, the arm's length, and the line of the arm: its first
    /// vertex relative to the second.
    pub measured: Option<([NumberId; 2], (VertexId, VertexId))>,
    /// The index of the step.
    pub step: usize,
}

impl Acts {
    /// Writes a plan as acts, with an alternative for each group of the mechanism.
    ///
    /// # Panics
    /// If `chosen` has fewer entries than the mechanism has groups.
    pub fn of(scene: &Scene, m: &Mechanism, plan: &Plan, chosen: &[usize]) -> Arc<Acts> {
        let mut board = ActWriter::new(scene, m, plan, chosen);
        board.set_out();
        for on in DiagramKind::POLYGONS.into_iter().filter(|on| on.level() <= plan.level) {
            board.draw(on);
        }
        Arc::new(Acts { chosen: chosen.to_vec(), ..board.done })
    }

    /// Begins a diagram and returns its index.
    pub(super) fn begin(&mut self, kind: DiagramKind, images: Vec<Option<MarkId>>) -> DiagramId {
        self.edges.push(Vec::new());
        self.images.push(images);
        self.construction.begin(kind)
    }

    pub(super) fn given(&mut self, given: GivenNumber) -> Key {
        let known = self.givens.iter().position(|g| *g == given);
        Key::of(known.unwrap_or_else(|| {
            self.givens.push(given);
            self.givens.len() - 1
        }))
    }

    pub(super) fn term(&mut self, term: Term) -> Key {
        self.terms.push(term);
        Key::of(self.terms.len() - 1)
    }

    pub(super) fn terms(&self, keys: &[Key]) -> Vec<Term> {
        keys.iter().map(|k| self.terms[k.index()]).collect()
    }

    pub(super) fn image(&self, on: DiagramId, v: VertexId) -> Option<MarkId> {
        self.images[on.index()][v.0]
    }

    /// Returns the name of a mark in a polygon.
    pub(super) fn mark(&self, id: MarkId) -> PolygonMark {
        match self.construction.marks[id.index()].name {
            Name::Pole | Name::Point(_) | Name::Vertex(_) => PolygonMark::Pole,
            Name::Image(v) => PolygonMark::Image(VertexId(v.index())),
            Name::End(t) => PolygonMark::Part(self.terms[t.index()]),
            Name::Again(t) => PolygonMark::Again(self.terms[t.index()]),
        }
    }

    /// Returns the mark at the end of a term that is drawn from another mark.
    pub(super) fn end_of(&self, on: DiagramId, from: MarkId, term: &Term) -> Option<MarkId> {
        end_of(&self.edges[on.index()], &self.mark(from), term).map(|(_, id)| id)
    }

    /// Returns the marks between which a vector of these terms is drawn, and true if the drawing
    /// shows the opposite vector.
    pub(super) fn edge_of(&self, on: DiagramId, terms: &[Term]) -> Option<([MarkId; 2], bool)> {
        let (marks, reversed) = edge_of(&self.edges[on.index()], terms)?;
        Some((marks.map(|(_, id)| id), reversed))
    }

    /// Returns the angular quantity of a body, if it is found.
    pub(super) fn turning(&self, on: DiagramKind, body: TurningBody) -> Option<&BodyRate> {
        // Usually the last one found is wanted.
        self.turnings.iter().rev().find(|t| t.on == on && t.body == body)
    }
}
