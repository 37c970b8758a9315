//! Rolling pairs: gears in mesh, a gear on its rack, a wheel on its track; pulleys in a belt, sprockets in a chain.
//!
//! Two circles, or a line and a circle, touch in a point Q and roll there without slip: the points of both links at Q have one
//! velocity, and their accelerations differ along the normal only. What keeps the two in touch is no matter of this pair: a link that
//! carries both centres, or the guide that the scene gets with it ([`Guide::rolling`](super::Guide::rolling)). Two pulleys touch nowhere: a strand of the belt runs off the one in
//! M and onto the other in N, and along it both move with the belt's speed.

use super::exact::Inputs;
use super::model::{Angle, Given, GuideId, LinkId, PointId};
use crate::diag::Span;
use crate::number::Real;

/// Index into [`Scene::rolling`](super::Scene::rolling).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct RollingId(pub usize);

/// Two links that roll on one another.
#[derive(Clone, Debug, PartialEq)]
pub struct Rolling {
    /// The two links; a track or rack that is straight comes first.
    pub links: [LinkId; 2],
    /// What rolls on what.
    pub contours: Contours,
    /// The place of contact on each link, a point of no link, found from the centres: one and the same but for the ends of a strand.
    pub at: [PointId; 2],
    /// By what they roll.
    pub kind: RollingKind,
    /// The guide in which the second centre runs against the first link, which keeps the two in touch where nothing else does.
    pub guide: Option<GuideId>,
    /// The angle of the second link's line, from the line of centres, when that of the first lies on it.
    pub phase: Option<Given<Angle>>,
    /// What is known of the flanks of two gears, or of a gear on its rack: they have numbers of teeth.
    pub flanks: Option<Flanks>,
    /// Where it is declared.
    pub span: Span,
}

/// By what two links roll on one another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RollingKind {
    /// Their teeth are in mesh.
    Gears,
    /// Friction; a guide holds the wheel on its track.
    Wheel,
    /// A belt runs round both.
    Belt,
    /// A chain runs round both.
    Chain,
}

/// The flanks of a gear pair, which matter for its figure alone: kinematics has the pitch circles.
#[derive(Clone, Debug, PartialEq)]
pub struct Flanks {
    /// Numbers of teeth, in the order of the links; a rack has none.
    pub teeth: [Option<u32>; 2],
    /// The module (m), where it is given; else it follows from the distance of the centres.
    pub module: Option<f64>,
    /// Pressure angle of the basic rack (rad).
    pub pressure_angle: f64,
    /// Profile shifts over the module, as far as they are given: a missing second one follows from the distance of the centres.
    pub shifts: Vec<f64>,
    /// Addendum over the module, h_a*.
    pub addendum: f64,
    /// Clearance over the module, c*.
    pub clearance: f64,
}

/// The two contours of a rolling pair.
#[derive(Clone, Debug, PartialEq)]
pub enum Contours {
    /// Two circles about these points, one of each link.
    Circles {
        /// The centres.
        centres: [PointId; 2],
        /// Their sizes.
        sizes: Sizes,
        /// Which of the two is hollow: the other one runs inside it.
        hollow: Option<usize>,
    },
    /// The first link is straight, along the pair's guide; the wheel lies to the left of the contact line.
    Track {
        /// The wheel's centre.
        centre: PointId,
        /// The wheel's radius (m).
        radius: Given,
    },
    /// Two neighbours in a belt or chain: circles about points whose distance a link keeps.
    Belt {
        /// The centres, one of each link.
        centres: [PointId; 2],
        /// The radii (m); of sprockets those with which the chain's speed is ω r.
        radii: [Given; 2],
        /// Numbers of teeth of sprockets.
        teeth: Option<[u32; 2]>,
        /// Whether the strand crosses the line of centres, so that the two turn in opposite senses.
        crossed: bool,
        /// Whether the strand lies right of the line of centres: the belt runs on its back over the first.
        right: bool,
        /// The link that carries both centres.
        arm: LinkId,
        /// Which belt of the file: its strands follow one another.
        belt: usize,
    },
}

/// Sizes of two circles.
#[derive(Clone, Debug, PartialEq)]
pub enum Sizes {
    /// Pitch radii (m).
    Radii([Given; 2]),
    /// Numbers of teeth: the radii divide the distance of the centres in their ratio.
    Teeth([u32; 2]),
}

impl Rolling {
    /// The sizes of both contours in one unit: their ratio is that of the radii. Negative is a hollow one, and the second in an open belt. A
    /// straight one is endless and has 0, the wheel its radius (m).
    pub fn sizes<N: Real>(&self, inputs: &Inputs<N>) -> [N; 2] {
        let [a, b] = match &self.contours {
            Contours::Circles { sizes: Sizes::Radii([a, b]), .. } => [inputs.number(a), inputs.number(b)],
            Contours::Circles { sizes: Sizes::Teeth(teeth), .. } => teeth.map(|z| N::from_f64(f64::from(z))),
            Contours::Track { radius, .. } => [N::from_f64(0.0), inputs.number(radius)],
            Contours::Belt { radii: [a, b], .. } => [inputs.number(a), inputs.number(b)],
        };
        match self.contours {
            Contours::Circles { hollow: Some(0), .. } => [-a, b],
            Contours::Circles { hollow: Some(_), .. } | Contours::Belt { crossed: false, .. } => [a, -b],
            Contours::Circles { hollow: None, .. } | Contours::Track { .. } | Contours::Belt { crossed: true, .. } => [a, b],
        }
    }

    /// The centres of the two contours; a straight one has none.
    pub fn centres(&self) -> [Option<PointId>; 2] {
        match self.contours {
            Contours::Circles { centres: [a, b], .. } | Contours::Belt { centres: [a, b], .. } => [Some(a), Some(b)],
            Contours::Track { centre, .. } => [None, Some(centre)],
        }
    }

    /// The centres of two round contours.
    pub fn round(&self) -> Option<[PointId; 2]> {
        match self.centres() {
            [Some(a), Some(b)] => Some([a, b]),
            [None, _] | [_, None] => None,
        }
    }

    /// The point in which the two touch, if they do.
    pub fn contact(&self) -> Option<PointId> {
        Some(self.at[0]).filter(|at| *at == self.at[1])
    }

    /// The place of contact on one of the two links.
    pub fn at_of(&self, link: LinkId) -> PointId {
        self.at[usize::from(self.links[1] == link)]
    }

    /// The link on which this one rolls, if it is one of the two.
    pub fn other(&self, link: LinkId) -> Option<LinkId> {
        match self.links {
            [a, b] if a == link => Some(b),
            [a, b] if b == link => Some(a),
            _ => None,
        }
    }
}
