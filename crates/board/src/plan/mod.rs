//! The vector equations in solving order: what a person would write before taking up the ruler.
//!
//! A [`Plan`] is made from topology and the demand alone and **holds no numbers**: changing a length does not change it.
//! Where the drawing must choose by the numbers (which two constraint lines of a triad cross most squarely), the plan
//! holds all alternatives and the drawing board picks one.
//!
//! Each group is entered by its legs ([`hodograph_mechanism::mechanism::Leg`]); [`locus`] turns what one holds into a chain of terms with one
//! unknown magnitude, two chains for one point make an equation, and further points follow by images.

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
mod vertex;

pub(crate) use between::body_of;
pub use between::{Asking, asking};
pub use build::{Ways, plan, plan_with};
pub use rest::Rest;
pub use vertex::{Special, SpecialLine, Spot, Trial, Vertex};

use hodograph_mechanism::mechanism::Level;
use hodograph_scene::{DiagramKind, GuideId, LinkId, PointId, RollingId, Scene};

/// Index into [`Plan::vertices`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct VertexId(pub usize);

/// A body that turns: a link, or the line of a cylinder.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Body {
    /// A link.
    Link(LinkId),
    /// The cylinder of a driver (index), whether its parts are numbered or not.
    Cylinder(usize),
}

/// What makes a term.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TermKind {
    /// v_BA = ω × r, square to AB; of accelerations the whole of a_BA, which only a joined line shows.
    Relative,
    /// aⁿ_BA = ω² l, from B to A.
    Normal,
    /// aᵗ_BA = α × r, square to AB.
    Tangential,
    /// Sliding along a guide: v_r or aʳ (on an arc its tangential part), along the tangent.
    Slide,
    /// v_r²/ρ on an arc: toward the centre for a pin against the carrying link, away from it the other way round.
    SlideNormal,
    /// 2 ω × v_r with the ω of the body that carries the guide (or of the cylinder).
    Coriolis,
    /// The given rate of a cylinder, along its line.
    Extension,
    /// In a trial polygon, from the image of a pin of the bar that is left out to its mate, along the bar; seen from the bar's other pin.
    Gap,
    /// Between the two points at a contact of rolling links, along its normal: nothing of the velocities, (ω₂ − ω₁)² ρ₁ρ₂/(ρ₁ + ρ₂) of the
    /// accelerations.
    Roll,
}

/// By what the two points of a term are connected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum By {
    /// A body that turns.
    Turning(Body),
    /// A guide, with the link that carries it; `driver` where the sliding is given.
    Guide {
        /// The guide.
        guide: GuideId,
        /// The driver that gives its sliding, if one does.
        driver: Option<usize>,
    },
    /// A cylinder (driver index).
    Cylinder(usize),
    /// The contact of a rolling pair.
    Contact(RollingId),
    /// Nothing but the frame from which the one is seen.
    Frame {
        /// The body with which the frame turns, if it does.
        body: Option<Body>,
        /// The centre of the path in the frame, where it is a circle.
        about: Option<PointId>,
    },
    /// Nothing: two points of different links, of which the difference alone is asked.
    Apart,
}

/// One vector of an equation: of `of` relative to `to`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Term {
    /// What makes it.
    pub kind: TermKind,
    /// The point whose motion it is.
    pub of: VertexId,
    /// The point from which it is seen.
    pub to: VertexId,
    /// The connection.
    pub by: By,
    /// Whether its magnitude is known (its direction always is).
    pub known: bool,
}

/// A locus for a point's vector: a known start, known terms, then unknown ones in one common direction.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Chain {
    /// A vertex known before; fixed vertices start in the pole.
    pub start: VertexId,
    /// Known terms, in drawing order.
    pub known: Vec<Term>,
    /// Terms of unknown magnitude, all along one line; none where the chain leads all the way.
    pub unknown: Vec<Term>,
}

/// Why an equation is written as it is.
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
    /// The special point of a triad, or of a link of a higher group.
    Special,
    /// A point of a trial polygon.
    Trial,
}

/// One step of a plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Step {
    /// A vector equation; with two chains a crossing, with one a point reached by known terms.
    Equation {
        /// The point found.
        target: VertexId,
        /// Its one or two chains.
        chains: Vec<Chain>,
        /// Why so.
        method: Method,
    },
    /// A point found by its image: the triangle with two known points of its link.
    Image {
        /// The link.
        link: LinkId,
        /// The point found.
        target: VertexId,
        /// The two known ones.
        from: (VertexId, VertexId),
    },
    /// A point on the line through its images of two trials, where that line meets the line through their mates.
    Trials {
        /// The point found.
        target: VertexId,
        /// Its vertices of both trials.
        images: [VertexId; 2],
        /// Their mates.
        mates: [VertexId; 2],
    },
    /// A point of a link that does not turn: the same vector as a known point of it.
    Same {
        /// The link.
        link: LinkId,
        /// The point found.
        target: VertexId,
        /// The known one.
        from: VertexId,
    },
}

/// A vector between two images that no equation draws, and that is asked or needed for a turning: it is drawn between them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Between {
    /// The two images are joined: the whole relative vector.
    Join(Term),
    /// The perpendicular from the image of the first point on the line through the image of the second along the arm: aⁿ and aᵗ.
    Perpendicular {
        /// aⁿ, from the image of the second point to the foot.
        normal: Term,
        /// aᵗ, from the foot to the image of the first.
        tangential: Term,
    },
    /// The known parts are laid off from the image of the second point; the rest is what joins them to the image of the first.
    LayOff {
        /// Known terms, in drawing order.
        known: Vec<Term>,
        /// Terms along one line.
        rest: Vec<Term>,
    },
}

impl Between {
    /// Its terms, each of which is an edge; of several in `rest` together one.
    pub fn terms(&self) -> Vec<Term> {
        match self {
            Between::Join(t) => vec![*t],
            Between::Perpendicular { normal, tangential } => vec![*normal, *tangential],
            Between::LayOff { known, rest } => known.iter().chain(rest).copied().collect(),
        }
    }

    /// The two points: of the first relative to the second.
    pub fn ends(&self) -> (VertexId, VertexId) {
        let t = match self {
            Between::Join(t) | Between::Perpendicular { normal: t, .. } => t,
            Between::LayOff { known, rest } => known.iter().chain(rest).next().expect("something is laid off or joined"),
        };
        (t.of, t.to)
    }
}

/// How the turning (ω, α) of a body is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rate {
    /// From the relative vector of two of its points, carried back to the link.
    Measured {
        /// One point.
        of: VertexId,
        /// The other.
        to: VertexId,
    },
    /// Given by a driver, against another link.
    Given {
        /// The driver.
        driver: usize,
        /// The link against which it turns.
        against: LinkId,
    },
    /// The same as that of another link.
    Same(LinkId),
    /// It does not turn.
    Zero,
}

/// The steps of one group on one diagram.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GroupSteps {
    /// The group.
    pub group: usize,
    /// The alternatives, equal in result: one for most groups; for a triad one for each pair of legs.
    pub alternatives: Vec<Vec<Step>>,
    /// Vectors drawn between two images, each as soon as both are there.
    pub between: Vec<Between>,
    /// Angular rates that are asked for or needed later, found after the steps.
    pub rates: Vec<(Body, Rate)>,
    /// Further points that are asked for, found last: by images and by the angular rates.
    pub further: Vec<Step>,
}

impl GroupSteps {
    /// The alternative that is drawn when the board's choice for the group is `chosen`.
    pub fn drawn(&self, chosen: usize) -> usize {
        chosen.min(self.alternatives.len().saturating_sub(1))
    }

    /// The steps of one alternative, further points included.
    pub fn steps(&self, alternative: usize) -> impl Iterator<Item = &Step> {
        self.alternatives.get(alternative).into_iter().flatten().chain(&self.further)
    }
}

/// The steps of one diagram.
#[derive(Clone, Debug, PartialEq)]
pub struct Stage {
    /// The diagram.
    pub on: DiagramKind,
    /// Its steps, group after group.
    pub groups: Vec<GroupSteps>,
}

/// An effect that was considered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effect {
    /// Velocities at all.
    Velocities,
    /// Accelerations at all.
    Accelerations,
    /// The motion of a driver: considered where its rate is 0.
    DriverRate(usize),
    /// The tangential acceleration of a turning driver, or the acceleration of a sliding one.
    DriverAcceleration(usize),
    /// The Coriolis acceleration at a guide.
    Coriolis(GuideId),
    /// A whole group.
    Group(usize),
}

/// Why an effect is in or out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// A question calls for it.
    Asked,
    /// No question calls for it.
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
    /// The group's guide belongs to what no question calls for.
    GuideNotReached,
}

/// The equations of a scene, in solving order.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// All points whose vectors occur.
    pub vertices: Vec<Vertex>,
    /// The special points among them.
    pub specials: Vec<Special>,
    /// The steps of each diagram, in the order of drawing; a diagram of which nothing is planned has none.
    pub stages: Vec<Stage>,
    /// For each link, whether it keeps its direction for topological reasons.
    pub still: Vec<bool>,
    /// What stands still because a driver does.
    pub rest: Rest,
    /// For each point, the letters of its image.
    letters: Vec<String>,
    /// How far the questions go.
    pub level: Level,
    /// Effects considered: what, in or out, why.
    pub effects: Vec<(Effect, bool, Reason)>,
    /// Groups that are not drawn, and those that rest on them: of a class that no way opens, or left out of [`Ways`].
    pub undrawable: Vec<usize>,
    /// Of a wrong solution (`attempts`): the guide whose Coriolis acceleration is laid off with the turning of another link than
    /// that which carries it.
    pub coriolis_by: Option<(GuideId, LinkId)>,
}

impl Plan {
    /// Whether a body never turns.
    pub fn is_still(&self, body: Body) -> bool {
        matches!(body, Body::Link(l) if self.still[l.0])
    }

    /// Returns true for a group that is drawn by two trials.
    pub fn is_tried(&self, g: usize) -> bool {
        let steps = self.stages.iter().flat_map(|s| &s.groups).filter(|s| s.group == g).flat_map(|s| s.steps(0));
        steps.into_iter().any(|s| matches!(s, Step::Trials { .. }))
    }

    /// The vertex.
    pub fn vertex(&self, v: VertexId) -> &Vertex {
        &self.vertices[v.0]
    }

    /// The steps of a diagram, group after group.
    pub fn steps(&self, on: DiagramKind) -> &[GroupSteps] {
        self.stages.iter().find(|s| s.on == on).map_or(&[], |s| &s.groups)
    }

    /// The steps of a diagram, to be changed.
    pub fn steps_mut(&mut self, on: DiagramKind) -> &mut [GroupSteps] {
        self.stages.iter_mut().find(|s| s.on == on).map_or(&mut [], |s| &mut s.groups)
    }

    /// The vertex of a point (of a link), if the plan has it.
    pub fn find_vertex(&self, scene: &Scene, p: PointId, on: Option<LinkId>) -> Option<VertexId> {
        between::find_vertex(&self.vertices, scene, p, on)
    }

    /// The special point that a vertex is, if it is one.
    pub fn special(&self, v: VertexId) -> Option<&Special> {
        match self.vertex(v).spot {
            Spot::Special(k) => self.specials.get(k),
            Spot::Point(_) => None,
        }
    }

    /// The special point that a step introduces: it is the target, and its equation is not one of a trial or carried over from another link.
    pub fn introduced(&self, step: &Step) -> Option<&Special> {
        match step {
            Step::Equation { target, method: Method::Special, .. } => self.special(*target),
            Step::Equation { .. } | Step::Image { .. } | Step::Trials { .. } | Step::Same { .. } => None,
        }
    }

    /// The terms of all chains and of all vectors drawn between images on a diagram, alternatives included.
    pub fn terms(&self, on: DiagramKind) -> impl Iterator<Item = Term> + '_ {
        self.steps(on).iter().flat_map(|g| {
            let chains = g.alternatives.iter().flatten().chain(&g.further).flat_map(Step::chains);
            let of_chains = chains.flat_map(|c| c.known.iter().chain(&c.unknown)).copied();
            of_chains.chain(g.between.iter().flat_map(Between::terms))
        })
    }

    /// Number of vector equations (with two chains) written for a diagram, in the first alternatives.
    pub fn equations(&self, on: DiagramKind) -> usize {
        self.steps(on).iter().flat_map(|g| g.steps(0)).filter(|s| matches!(s, Step::Equation { chains, .. } if chains.len() == 2)).count()
    }
}

/// A point of a link that carries the point is the pin itself; only a point that merely coincides is told apart.
pub(crate) fn canonical(scene: &Scene, p: PointId, on: Option<LinkId>) -> Option<LinkId> {
    on.filter(|l| !scene.links[l.0].points.contains(&p))
}
