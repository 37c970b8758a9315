//! Rolling pairs: gears in mesh, a gear on its rack, a wheel on its track; pulleys in a belt,
//! sprockets in a chain.
//!
//! Two parts describe a rolling pair, and each has its own type.
//!
//! - [`Relation`]: a linear relation between rotations, or between rotation and sliding. The
//!   equations of position and motion and the sweep follow from it.
//! - [`Touch`]: the geometry. At a point of contact Q the points of both links have the same
//!   velocity, and their accelerations differ along the normal only. Over the strand of a belt,
//!   which leaves one contour at M and meets the other at N, both points have the belt's speed.
//!   Drawing, centres and curvature follow from it.
//!
//! The pair itself does not keep the links in touch: a link that carries both centres does, or a
//! guide that is added to the scene ([`Guide::rolling`](super::Guide::rolling)).
//!
//! Kinds and contours are matched here, where a scene is read and written, and in figures and
//! words. The solvers use the relation, the touch and the [sizes](Rolling::sizes).

use super::exact::Inputs;
use super::model::{Angle, GivenQuantity, GuideId, LinkId, PointId};
use hodograph_base::diag::Span;
use hodograph_base::number::Real;

/// Index into [`Scene::rolling`](super::Scene::rolling).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct RollingId(pub usize);

/// Two links that roll on each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Rolling {
    /// The two links; a straight track or rack comes first.
    pub links: [LinkId; 2],
    /// The two contours.
    pub contours: Contours,
    /// Place of contact on each link, a point that no link lists, found from the centres: the same
    /// point for both, except for the two ends of a strand.
    pub at: [PointId; 2],
    /// The kind of rolling pair.
    pub kind: RollingKind,
    /// Angle of the second link's line from the line of centres, when the first link's line
    /// coincides with it.
    pub phase: Option<GivenQuantity<Angle>>,
    /// Data of the flanks, if the pair is two gears, or a gear on its rack, with numbers of teeth.
    pub flanks: Option<Flanks>,
    /// Place of the declaration.
    pub span: Span,
}

/// The kind of a rolling pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RollingKind {
    /// Teeth in mesh.
    Gears,
    /// A wheel held by friction; a guide keeps it on its track.
    Wheel,
    /// A belt around both.
    Belt,
    /// A chain around both.
    Chain,
    /// A rope that unwinds from the second link, a drum, and pulls the first.
    Rope,
}

/// The flanks of a gear pair, used in its figure only: the kinematics uses the pitch circles.
#[derive(Clone, Debug, PartialEq)]
pub struct Flanks {
    /// Numbers of teeth, in the order of the links; a rack has none.
    pub teeth: [Option<u32>; 2],
    /// The module (m), if given; else it follows from the distance of the centres.
    pub module: Option<f64>,
    /// Pressure angle of the basic rack (rad).
    pub pressure_angle: f64,
    /// Given profile shifts divided by the module; a missing second one follows from the distance
    /// of the centres.
    pub shifts: Vec<f64>,
    /// Addendum divided by the module, h_a*.
    pub addendum: f64,
    /// Clearance divided by the module, c*.
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
        /// Index of the hollow circle, if any: the other one runs inside it.
        hollow: Option<usize>,
        /// The guide of the first link in which the second centre runs, where no link carries both
        /// centres.
        guide: Option<GuideId>,
    },
    /// The first link is straight; the wheel is to the left of the contact line.
    Track {
        /// The wheel's centre.
        centre: PointId,
        /// The wheel's radius (m).
        radius: GivenQuantity,
        /// The guide of the centre, parallel to the contact line.
        guide: GuideId,
    },
    /// Two neighbours in a belt or chain: circles about points at a distance fixed by a link.
    Belt {
        /// The centres, one of each link.
        centres: [PointId; 2],
        /// The radii (m); for sprockets, those with which the chain's speed is ω r.
        radii: [GivenQuantity; 2],
        /// Numbers of teeth of sprockets.
        teeth: Option<[u32; 2]>,
        /// True if the strand crosses the line of centres, so that the two rotate in opposite
        /// senses.
        crossed: bool,
        /// True if the strand is to the right of the line of centres: the back of the belt bears on
        /// the first contour.
        right: bool,
        /// The link that carries both centres.
        arm: LinkId,
        /// Index of the belt in the file; the strands of one belt are consecutive.
        belt: usize,
    },
}

/// The linear relation of a rolling pair, ρ being its [sizes](Rolling::sizes), φ the angles of its
/// links.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// Between the rotations of the links and of the line of two centres, one of each link: ρ₁(φ₁ −
    /// β) + ρ₂(φ₂ − β) is constant, β being the line's angle.
    Turnings([PointId; 2]),
    /// Between rotation and sliding: s + ρ₂(φ₂ − φ₁) is constant, s being the coordinate of a
    /// centre of the second link along a guide of the first.
    Slide {
        /// The centre.
        centre: PointId,
        /// The guide, which is straight.
        guide: GuideId,
    },
}

/// The contact of the two links of a rolling pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Touch {
    /// At a point, without slip.
    Point(Normal),
    /// Over a strand that is tangent to a circle of each link.
    Strand {
        /// The centres, one of each link.
        centres: [PointId; 2],
        /// True if the strand is to the right of the line of centres.
        right: bool,
        /// The link that carries both centres.
        arm: LinkId,
    },
}

/// The common normal of two contours at their point of contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Normal {
    /// The line of two centres, one of each link.
    Centres([PointId; 2]),
    /// The perpendicular to a straight guide of the first link, through a centre of the second.
    Square {
        /// The centre.
        centre: PointId,
        /// The guide.
        guide: GuideId,
    },
}

/// Sizes of two circles.
#[derive(Clone, Debug, PartialEq)]
pub enum Sizes {
    /// Pitch radii (m).
    Radii([GivenQuantity; 2]),
    /// Numbers of teeth: the pitch radii divide the distance of the centres in this ratio.
    Teeth([u32; 2]),
}

impl RollingKind {
    /// True if the pair counts as a lower pair, which removes two degrees of freedom; a higher pair
    /// removes one.
    pub fn is_lower(self) -> bool {
        match self {
            RollingKind::Wheel => true,
            RollingKind::Gears | RollingKind::Belt | RollingKind::Chain | RollingKind::Rope => {
                false
            }
        }
    }

    /// True if the pair has teeth: pitch circles and pitch lines roll on each other.
    pub fn is_toothed(self) -> bool {
        match self {
            RollingKind::Gears | RollingKind::Chain => true,
            RollingKind::Wheel | RollingKind::Belt | RollingKind::Rope => false,
        }
    }

    /// True if a rope, belt or chain joins the links; it is drawn over its length.
    pub fn is_flexible(self) -> bool {
        match self {
            RollingKind::Belt | RollingKind::Chain | RollingKind::Rope => true,
            RollingKind::Gears | RollingKind::Wheel => false,
        }
    }

    /// True if another pair keeps the distance of the links. Teeth, which touch on both sides, keep
    /// it themselves only where no other pair does.
    pub fn leaves_distance(self) -> bool {
        match self {
            RollingKind::Gears | RollingKind::Rope => true,
            RollingKind::Wheel | RollingKind::Belt | RollingKind::Chain => false,
        }
    }

    /// True if the links touch with teeth on both sides.
    pub fn meshes(self) -> bool {
        match self {
            RollingKind::Gears => true,
            RollingKind::Wheel | RollingKind::Belt | RollingKind::Chain | RollingKind::Rope => {
                false
            }
        }
    }
}

impl Contours {
    /// Returns the radii that the scene gives (m), for variation.
    pub fn radii_mut(&mut self) -> Vec<&mut GivenQuantity> {
        match self {
            Contours::Circles { sizes: Sizes::Radii(radii), .. } | Contours::Belt { radii, .. } => {
                radii.iter_mut().collect()
            }
            Contours::Circles { sizes: Sizes::Teeth(_), .. } => Vec::new(),
            Contours::Track { radius, .. } => vec![radius],
        }
    }
}

impl Rolling {
    /// Returns the linear relation of the pair.
    pub fn relation(&self) -> Relation {
        match self.contours {
            Contours::Circles { centres, .. } | Contours::Belt { centres, .. } => {
                Relation::Turnings(centres)
            }
            Contours::Track { centre, guide, .. } => Relation::Slide { centre, guide },
        }
    }

    /// Returns the contact of the two links.
    pub fn touch(&self) -> Touch {
        match self.contours {
            Contours::Circles { centres, .. } => Touch::Point(Normal::Centres(centres)),
            Contours::Track { centre, guide, .. } => Touch::Point(Normal::Square { centre, guide }),
            Contours::Belt { centres, right, arm, .. } => Touch::Strand { centres, right, arm },
        }
    }

    /// Returns the guide of the second centre on the first link, which keeps the two in touch where
    /// nothing else does.
    pub fn guide(&self) -> Option<GuideId> {
        match self.contours {
            Contours::Circles { guide, .. } => guide,
            Contours::Track { guide, .. } => Some(guide),
            Contours::Belt { .. } => None,
        }
    }

    /// Returns the guide of the second centre for renumbering.
    pub(super) fn guide_mut(&mut self) -> Option<&mut GuideId> {
        match &mut self.contours {
            Contours::Circles { guide, .. } => guide.as_mut(),
            Contours::Track { guide, .. } => Some(guide),
            Contours::Belt { .. } => None,
        }
    }

    /// Returns the index of the hollow contour, if any.
    pub fn hollow(&self) -> Option<usize> {
        match self.contours {
            Contours::Circles { hollow, .. } => hollow,
            Contours::Track { .. } | Contours::Belt { .. } => None,
        }
    }

    /// Returns the index of the belt or chain in the file, if the pair is a strand; the strands of
    /// one belt are consecutive.
    pub fn belt(&self) -> Option<usize> {
        match self.contours {
            Contours::Belt { belt, .. } => Some(belt),
            Contours::Circles { .. } | Contours::Track { .. } => None,
        }
    }

    /// True if the pair is a strand that crosses the line of centres.
    pub fn is_crossed(&self) -> bool {
        match self.contours {
            Contours::Belt { crossed, .. } => crossed,
            Contours::Circles { .. } | Contours::Track { .. } => false,
        }
    }

    /// Returns the radii of the two circles (m), if the scene gives both.
    pub fn radii(&self) -> Option<[&GivenQuantity; 2]> {
        match &self.contours {
            Contours::Circles { sizes: Sizes::Radii([a, b]), .. }
            | Contours::Belt { radii: [a, b], .. } => Some([a, b]),
            Contours::Circles { sizes: Sizes::Teeth(_), .. } | Contours::Track { .. } => None,
        }
    }

    /// Returns the numbers of teeth in the ratio of the two sizes, if the scene gives them.
    pub fn teeth(&self) -> Option<[u32; 2]> {
        match self.contours {
            Contours::Circles { sizes: Sizes::Teeth(teeth), .. } => Some(teeth),
            Contours::Belt { teeth, .. } => teeth,
            Contours::Circles { sizes: Sizes::Radii(_), .. } | Contours::Track { .. } => None,
        }
    }

    /// Renumbers its links.
    pub fn rename(&mut self, of: impl Fn(LinkId) -> LinkId) {
        self.links = self.links.map(&of);
        match &mut self.contours {
            Contours::Belt { arm, .. } => *arm = of(*arm),
            Contours::Circles { .. } | Contours::Track { .. } => {}
        }
    }

    /// Returns the sizes of both contours in one unit; their ratio is that of the radii. A hollow
    /// contour is negative, and so is the second of an open belt. A straight contour has 0, and its
    /// wheel the radius (m).
    pub fn sizes<N: Real>(&self, inputs: &Inputs<N>) -> [N; 2] {
        let [a, b] = match &self.contours {
            Contours::Circles { sizes: Sizes::Radii([a, b]), .. } => {
                [inputs.number(a), inputs.number(b)]
            }
            Contours::Circles { sizes: Sizes::Teeth(teeth), .. } => {
                teeth.map(|z| N::from_f64(f64::from(z)))
            }
            Contours::Track { radius, .. } => [N::from_f64(0.0), inputs.number(radius)],
            Contours::Belt { radii: [a, b], .. } => [inputs.number(a), inputs.number(b)],
        };
        match self.contours {
            Contours::Circles { hollow: Some(0), .. } => [-a, b],
            Contours::Circles { hollow: Some(_), .. } | Contours::Belt { crossed: false, .. } => {
                [a, -b]
            }
            Contours::Circles { hollow: None, .. }
            | Contours::Track { .. }
            | Contours::Belt { crossed: true, .. } => [a, b],
        }
    }

    /// Returns the centres of the two contours; a straight one has none.
    pub fn centres(&self) -> [Option<PointId>; 2] {
        match self.contours {
            Contours::Circles { centres: [a, b], .. } | Contours::Belt { centres: [a, b], .. } => {
                [Some(a), Some(b)]
            }
            Contours::Track { centre, .. } => [None, Some(centre)],
        }
    }

    /// Returns the centres of two round contours.
    pub fn round(&self) -> Option<[PointId; 2]> {
        match self.centres() {
            [Some(a), Some(b)] => Some([a, b]),
            [None, _] | [_, None] => None,
        }
    }

    /// Returns the point of contact, unless the pair is a strand.
    pub fn contact(&self) -> Option<PointId> {
        Some(self.at[0]).filter(|at| *at == self.at[1])
    }

    /// Returns the place of contact on one of the two links.
    pub fn at_of(&self, link: LinkId) -> PointId {
        self.at[usize::from(self.links[1] == link)]
    }

    /// Returns the other link of the pair, if `link` is one of the two.
    pub fn other(&self, link: LinkId) -> Option<LinkId> {
        match self.links {
            [a, b] if a == link => Some(b),
            [a, b] if b == link => Some(a),
            _ => None,
        }
    }
}
