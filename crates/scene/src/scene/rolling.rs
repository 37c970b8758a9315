//! Rolling pairs: gears in mesh, a gear on its rack, a wheel on its track.
//!
//! Two circles, or a line and a circle, touch in a point Q and roll there without slip: the points of both links at Q have one
//! velocity, and their accelerations differ along the normal only. What keeps the two in touch is no matter of this pair: a link that
//! carries both centres, or the guide that the scene gets with it ([`Guide::rolling`](super::Guide::rolling)).

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
    /// The place of contact: a point of no link, found from the centres.
    pub at: PointId,
    /// Whether the pair has teeth; a wheel without them is held on its track by a guide.
    pub toothed: bool,
    /// The guide in which the second centre runs against the first link, which keeps the two in touch where nothing else does.
    pub guide: Option<GuideId>,
    /// The angle of the second link's line, from the line of centres, when that of the first lies on it.
    pub phase: Option<Given<Angle>>,
    /// What is known of the flanks of two gears, or of a gear on its rack: they have numbers of teeth.
    pub flanks: Option<Flanks>,
    /// Where it is declared.
    pub span: Span,
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
    /// The sizes of both contours in one unit, a hollow one negative: their ratio is that of the radii. A straight one is endless and
    /// has 0, the wheel its radius (m).
    pub fn sizes<N: Real>(&self, inputs: &Inputs<N>) -> [N; 2] {
        let [a, b] = match &self.contours {
            Contours::Circles { sizes: Sizes::Radii([a, b]), .. } => [inputs.number(a), inputs.number(b)],
            Contours::Circles { sizes: Sizes::Teeth(teeth), .. } => teeth.map(|z| N::from_f64(f64::from(z))),
            Contours::Track { radius, .. } => [N::from_f64(0.0), inputs.number(radius)],
        };
        match self.contours {
            Contours::Circles { hollow: Some(0), .. } => [-a, b],
            Contours::Circles { hollow: Some(_), .. } => [a, -b],
            Contours::Circles { hollow: None, .. } | Contours::Track { .. } => [a, b],
        }
    }

    /// The centres of the two contours; a straight one has none.
    pub fn centres(&self) -> [Option<PointId>; 2] {
        match self.contours {
            Contours::Circles { centres: [a, b], .. } => [Some(a), Some(b)],
            Contours::Track { centre, .. } => [None, Some(centre)],
        }
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
