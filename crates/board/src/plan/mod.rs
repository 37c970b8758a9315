//! The vector equations in solving order, as a person writes them before drawing.
//!
//! A [`Plan`] is made from topology and the demand alone and **holds no numbers**: changing a
//! length does not change it. If the drawing must choose by the numbers (the two constraint lines
//! of a triad that cross most squarely), the plan holds all alternatives and the drawing board
//! chooses one.
//!
//! Each group is entered by its legs ([`hodograph_mechanism::mechanism::Leg`]); [`locus`] converts
//! each leg's constraint to a chain of terms with one unknown magnitude; two chains for one point
//! make an equation, and further points follow by images.

mod between;
mod build;
mod common;
mod contact;
mod effects;
mod group;
mod keys;
mod lines;
mod locus;
pub mod names;
mod reduce;
mod rest;
mod step;
pub mod text;
mod trials;
pub mod tried;
mod vertex;

pub(crate) use between::body_of;
pub use between::{Asking, asking};
pub use build::{GroupChoices, plan, plan_with};
pub use rest::Rest;
pub use vertex::{Special, SpecialLine, Vertex, VertexPlace, VertexTrial};

use hodograph_mechanism::mechanism::Level;
use hodograph_scene::{DiagramKind, GuideId, LinkId, PointId, RollingId, Scene};

/// Index into [`Plan::vertices`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct VertexId(pub usize);

/// A body that turns: a link, or the line of a cylinder.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TurningBody {
    /// A link.
    Link(LinkId),
    /// The cylinder of a driver (index), with or without numbered parts.
    Cylinder(usize),
}

/// The cause of a term.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TermKind {
    /// v_BA = ω × r, square to AB; for accelerations the whole of a_BA, which only a joined line
    /// shows.
    Relative,
    /// aⁿ_BA = ω² l, from B to A.
    Normal,
    /// aᵗ_BA = α × r, square to AB.
    Tangential,
    /// Sliding along a guide: v_r or aʳ (on an arc its tangential part), along the tangent.
    Slide,
    /// v_r²/ρ on an arc: toward the centre for a pin relative to the carrying link, away from it in
    /// the opposite case.
    SlideNormal,
    /// 2 ω × v_r with the ω of the body that carries the guide (or of the cylinder).
    Coriolis,
    /// The given rate of a cylinder, along its line.
    Extension,
    /// In a trial polygon, from the image of a pin of the removed bar to its mate, along the bar,
    /// relative to the bar's other pin.
    Gap,
    /// The difference of the two points at a contact of rolling links, along its normal: zero for
    /// velocities, (ω₂ − ω₁)² ρ₁ρ₂/(ρ₁ + ρ₂) for accelerations.
    Roll,
}

/// The connection between the two points of a term.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TermConnection {
    /// A body that turns.
    Turning(TurningBody),
    /// A guide, with the link that carries it; `driver` if the sliding is given.
    Guide {
        /// The guide.
        guide: GuideId,
        /// The driver that gives the sliding, if there is one.
        driver: Option<usize>,
    },
    /// A cylinder (driver index).
    Cylinder(usize),
    /// The contact of a rolling pair.
    Contact(RollingId),
    /// The frame of the relative motion only.
    Frame {
        /// The body with which the frame turns, if it does.
        body: Option<TurningBody>,
        /// The centre of the path in the frame, if it is a circle.
        about: Option<PointId>,
    },
    /// No connection: two points of different links; only their difference is asked for.
    Apart,
}

/// One vector of an equation: of `of` relative to `to`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Term {
    /// The cause of the term.
    pub kind: TermKind,
    /// The point with this motion.
    pub of: VertexId,
    /// The reference point.
    pub to: VertexId,
    /// The connection.
    pub by: TermConnection,
    /// True if its magnitude is known (its direction always is).
    pub known: bool,
}

/// A locus for a point's vector: a known start, known terms, then unknown ones in one common
/// direction.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TermChain {
    /// The known vertex at the start; a fixed vertex starts at the pole.
    pub start: VertexId,
    /// Known terms, in drawing order.
    pub known: Vec<Term>,
    /// Terms of unknown magnitude, all along one line; empty if known terms lead all the way.
    pub unknown: Vec<Term>,
}

/// The method of an equation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// A driven point: everything is known.
    Driven,
    /// Two points of one link, two loci.
    SameLink,
    /// The two ends of a cylinder, on barrel and rod, whose distance is driven.
    Cylinder,
    /// Coincident points of two links.
    Coincident,
    /// The two ends of a strand of a belt or chain, on its wheels.
    Strand,
    /// The special point of a triad, of a link of a higher group, or common to two of its links.
    Special,
    /// A point of a trial polygon.
    Trial,
}

/// One step of a plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PlanStep {
    /// A vector equation; with two chains a crossing, with one chain a point reached by known
    /// terms.
    Equation {
        /// The point found.
        target: VertexId,
        /// One or two chains.
        chains: Vec<TermChain>,
        /// The method.
        method: Method,
    },
    /// A point found by an image: the triangle with two known points of its link.
    Image {
        /// The link.
        link: LinkId,
        /// The point found.
        target: VertexId,
        /// The two known points.
        from: (VertexId, VertexId),
    },
    /// A point on the line through its images of two trials, at the crossing with the line through
    /// their mates.
    Trials {
        /// The point found.
        target: VertexId,
        /// The point's vertices in both trials.
        images: [VertexId; 2],
        /// The mates of these vertices.
        mates: [VertexId; 2],
    },
    /// A point of a link that does not turn: it has the same vector as a known point of the link.
    Same {
        /// The link.
        link: LinkId,
        /// The point found.
        target: VertexId,
        /// The known point.
        from: VertexId,
    },
}

/// A vector between two images that no equation draws, and that a question or an angular quantity
/// needs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Between {
    /// The two images are joined: the whole relative vector.
    Join(Term),
    /// The perpendicular from the image of the first point to the line through the image of the
    /// second along the arm: aⁿ and aᵗ.
    Perpendicular {
        /// aⁿ, from the image of the second point to the foot.
        normal: Term,
        /// aᵗ, from the foot to the image of the first point.
        tangential: Term,
    },
    /// The known parts are laid off from the image of the second point; the rest joins them to the
    /// image of the first.
    LayOff {
        /// Known terms, in drawing order.
        known: Vec<Term>,
        /// Terms along one line.
        rest: Vec<Term>,
    },
}

impl Between {
    /// Returns the terms; each is an edge, but several in `rest` are a single edge.
    pub fn terms(&self) -> Vec<Term> {
        match self {
            Between::Join(t) => vec![*t],
            Between::Perpendicular { normal, tangential } => vec![*normal, *tangential],
            Between::LayOff { known, rest } => known.iter().chain(rest).copied().collect(),
        }
    }

    /// Returns the two points: the first, relative to the second.
    pub fn ends(&self) -> (VertexId, VertexId) {
        let t = match self {
            Between::Join(t) | Between::Perpendicular { normal: t, .. } => t,
            Between::LayOff { known, rest } => {
                known.iter().chain(rest).next().expect("something is laid off or joined")
            }
        };
        (t.of, t.to)
    }
}

/// The source of a body's angular velocity or acceleration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rate {
    /// Measured from the relative vector of two points, transferred to the link.
    Measured {
        /// The first point.
        of: VertexId,
        /// The reference point.
        to: VertexId,
    },
    /// Given by a driver, relative to another link.
    Given {
        /// The driver.
        driver: usize,
        /// The link to which the driver's motion is relative.
        against: LinkId,
    },
    /// Equal to that of another link.
    Same(LinkId),
    /// Zero: the body does not turn.
    Zero,
}

/// The steps of one group on one diagram.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GroupSteps {
    /// The index of the group.
    pub group: usize,
    /// The alternatives, with equal results: one for most groups, for a triad one for each pair of
    /// legs.
    pub alternatives: Vec<Vec<PlanStep>>,
    /// Vectors drawn between two images, each as soon as both images exist.
    pub between: Vec<Between>,
    /// Angular quantities that are asked for or needed later, found after the steps.
    pub rates: Vec<(TurningBody, Rate)>,
    /// Further points that are asked for, found last: by images and by angular quantities.
    pub further: Vec<PlanStep>,
}

impl GroupSteps {
    /// Returns the alternative that is drawn if the board's choice for the group is `chosen`.
    pub fn drawn(&self, chosen: usize) -> usize {
        chosen.min(self.alternatives.len().saturating_sub(1))
    }

    /// Returns the steps of one alternative, further points included.
    pub fn steps(&self, alternative: usize) -> impl Iterator<Item = &PlanStep> {
        self.alternatives.get(alternative).into_iter().flatten().chain(&self.further)
    }
}

/// The steps of one diagram.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanStage {
    /// The diagram.
    pub on: DiagramKind,
    /// The steps, group after group.
    pub groups: Vec<GroupSteps>,
}

/// An effect that the plan considers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effect {
    /// Velocities in general.
    Velocities,
    /// Accelerations in general.
    Accelerations,
    /// The motion of a driver, considered if its rate is 0.
    DriverRate(usize),
    /// The tangential acceleration of a turning driver, or the acceleration of a sliding one.
    DriverAcceleration(usize),
    /// The Coriolis acceleration at a guide.
    Coriolis(GuideId),
    /// A whole group.
    Group(usize),
}

/// The reason for which an effect counts or not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// A question needs it.
    Asked,
    /// No question needs it.
    NotAsked,
    /// The driver has an acceleration.
    Accelerated,
    /// The driver is at rest at the instant.
    AtRest,
    /// The driver's rate is constant.
    ConstantRate,
    /// The guide turns.
    GuideTurns,
    /// The guide does not turn.
    GuideDoesNotTurn,
    /// The guide belongs to a part that no question needs.
    GuideNotReached,
}

/// The equations of a scene, in solving order.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// All points with a vector in the plan.
    pub vertices: Vec<Vertex>,
    /// The special points among them.
    pub specials: Vec<Special>,
    /// The steps of each diagram, in the order of drawing; a diagram without steps has no stage.
    pub stages: Vec<PlanStage>,
    /// For each link, true if it keeps its direction for topological reasons.
    pub still: Vec<bool>,
    /// The parts at rest because a driver is at rest.
    pub rest: Rest,
    /// The letters of each point's image.
    letters: Vec<String>,
    /// The highest level of the questions.
    pub level: Level,
    /// The effects considered: the effect, true if it counts, and the reason.
    pub effects: Vec<(Effect, bool, Reason)>,
    /// Groups that are not drawn, and those that depend on them: no way opens their class, or
    /// [`GroupChoices`] leaves them out.
    pub undrawable: Vec<usize>,
    /// In a wrong solution (`attempts`): the guide with a Coriolis acceleration laid off with the
    /// angular velocity of a link other than its carrier, and that link.
    pub coriolis_by: Option<(GuideId, LinkId)>,
}

impl Plan {
    /// True if a body never turns.
    pub fn is_still(&self, body: TurningBody) -> bool {
        matches!(body, TurningBody::Link(l) if self.still[l.0])
    }

    /// True if a group is drawn by two trials.
    pub fn is_tried(&self, g: usize) -> bool {
        let steps = self
            .stages
            .iter()
            .flat_map(|s| &s.groups)
            .filter(|s| s.group == g)
            .flat_map(|s| s.steps(0));
        steps.into_iter().any(|s| matches!(s, PlanStep::Trials { .. }))
    }

    /// Returns the vertex with this index.
    pub fn vertex(&self, v: VertexId) -> &Vertex {
        &self.vertices[v.0]
    }

    /// Returns the steps of a diagram, group after group.
    pub fn steps(&self, on: DiagramKind) -> &[GroupSteps] {
        self.stages.iter().find(|s| s.on == on).map_or(&[], |s| &s.groups)
    }

    /// Returns the steps of a diagram for modification.
    pub fn steps_mut(&mut self, on: DiagramKind) -> &mut [GroupSteps] {
        self.stages.iter_mut().find(|s| s.on == on).map_or(&mut [], |s| &mut s.groups)
    }

    /// Returns the vertex of a point (of a link), if the plan has it.
    pub fn find_vertex(&self, scene: &Scene, p: PointId, on: Option<LinkId>) -> Option<VertexId> {
        between::find_vertex(&self.vertices, scene, p, on)
    }

    /// Returns the special point of a vertex, if it is one.
    pub fn special(&self, v: VertexId) -> Option<&Special> {
        match self.vertex(v).spot {
            VertexPlace::Special(k) => self.specials.get(k),
            VertexPlace::Point(_) => None,
        }
    }

    /// Returns the special point that a step introduces: the target is a special point, and its
    /// equation is neither part of a trial nor transferred from another link.
    pub fn introduced(&self, step: &PlanStep) -> Option<&Special> {
        match step {
            PlanStep::Equation { target, method: Method::Special, .. } => {
                self.special(*target).filter(|_| self.vertex(*target).trial.is_none())
            }
            PlanStep::Equation { .. }
            | PlanStep::Image { .. }
            | PlanStep::Trials { .. }
            | PlanStep::Same { .. } => None,
        }
    }

    /// Returns the terms of all chains and of all vectors drawn between images on a diagram,
    /// alternatives included.
    pub fn terms(&self, on: DiagramKind) -> impl Iterator<Item = Term> + '_ {
        self.steps(on).iter().flat_map(|g| {
            let chains =
                g.alternatives.iter().flatten().chain(&g.further).flat_map(PlanStep::chains);
            let of_chains = chains.flat_map(|c| c.known.iter().chain(&c.unknown)).copied();
            of_chains.chain(g.between.iter().flat_map(Between::terms))
        })
    }

    /// Returns the number of vector equations (with two chains) written for a diagram, in the first
    /// alternatives.
    pub fn equations(&self, on: DiagramKind) -> usize {
        self.steps(on)
            .iter()
            .flat_map(|g| g.steps(0))
            .filter(|s| matches!(s, PlanStep::Equation { chains, .. } if chains.len() == 2))
            .count()
    }
}

/// Returns the link in a vertex's key: `None` for a link that carries the point, because its point
/// is the pin itself; only a coincident point keeps its link.
pub(crate) fn canonical(scene: &Scene, p: PointId, on: Option<LinkId>) -> Option<LinkId> {
    on.filter(|l| !scene.links[l.0].points.contains(&p))
}
