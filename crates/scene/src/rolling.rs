//! Rolling pairs: gears in mesh, a gear on its rack, a wheel on its track; pulleys in a belt, sprockets in a chain.
//!
//! Two statements make up such a pair, and each is asked for on its own. Its [`Relation`] is linear between turnings, or between turning
//! and sliding: equations of position, of motion and the sweep are made of it. Its [`Touch`] is geometry: in a point Q the points
//! of both links have one velocity, and accelerations that differ along the normal only; over a strand of a belt, which runs off the one in M and onto the other
//! in N, both move with the belt's speed. Drawing, centres and curvature are made of it. What keeps two links in touch is no matter of this pair: a link that
//! carries both centres, or the guide that the scene gets with it ([`Guide::rolling`](super::Guide::rolling)).
//!
//! Which kinds and contours there are is matched here, where a scene is read and written, and in figures and words. The solvers ask for relation, touch
//! and [sizes](Rolling::sizes).

use super::exact::Inputs;
use super::model::{Angle, Given, GuideId, LinkId, PointId};
use hodograph_base::diag::Span;
use hodograph_base::number::Real;

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
    /// A rope runs off the second, a drum, and draws the first along.
    Rope,
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
        /// The guide in which the second centre runs against the first link, where no link carries both.
        guide: Option<GuideId>,
    },
    /// The first link is straight; the wheel lies to the left of the contact line.
    Track {
        /// The wheel's centre.
        centre: PointId,
        /// The wheel's radius (m).
        radius: Given,
        /// The guide in which the centre runs, parallel to the contact line.
        guide: GuideId,
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

/// What is linearly related in a rolling pair, ρ being its [sizes](Rolling::sizes), φ the angles of its links.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// The turnings of the links and of the line of two centres, one of each link: ρ₁(φ₁ − β) + ρ₂(φ₂ − β) stays, β the line's angle.
    Turnings([PointId; 2]),
    /// Turning and sliding: s + ρ₂(φ₂ − φ₁) stays, s the coordinate of a centre of the second link along a guide of the first.
    Slide {
        /// The centre.
        centre: PointId,
        /// The guide, a straight one.
        guide: GuideId,
    },
}

/// How the two links of a rolling pair meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Touch {
    /// In a point, in which neither slips on the other.
    Point(Normal),
    /// Over a strand that is tangent to a circle of each.
    Strand {
        /// The centres, one of each link.
        centres: [PointId; 2],
        /// Whether it lies right of the line of centres.
        right: bool,
        /// The link that carries both centres.
        arm: LinkId,
    },
}

/// The common normal of two contours in their point of contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Normal {
    /// The line of two centres, one of each link.
    Centres([PointId; 2]),
    /// Square to a straight guide of the first link, through a centre of the second.
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
    Radii([Given; 2]),
    /// Numbers of teeth: the radii divide the distance of the centres in their ratio.
    Teeth([u32; 2]),
}

impl RollingKind {
    /// Whether it counts as a lower pair, which takes two freedoms; a higher pair takes one.
    pub fn is_lower(self) -> bool {
        match self {
            RollingKind::Wheel => true,
            RollingKind::Gears | RollingKind::Belt | RollingKind::Chain | RollingKind::Rope => false,
        }
    }

    /// Whether it has teeth: what rolls are pitch circles and pitch lines.
    pub fn is_toothed(self) -> bool {
        match self {
            RollingKind::Gears | RollingKind::Chain => true,
            RollingKind::Wheel | RollingKind::Belt | RollingKind::Rope => false,
        }
    }

    /// Whether it is a rope, belt or chain that joins its links: it is drawn as far as it runs.
    pub fn is_flexible(self) -> bool {
        match self {
            RollingKind::Belt | RollingKind::Chain | RollingKind::Rope => true,
            RollingKind::Gears | RollingKind::Wheel => false,
        }
    }

    /// Whether its links need not keep their distance: other pairs do; only teeth, which touch on both sides, do so where no other pair does.
    pub fn leaves_distance(self) -> bool {
        match self {
            RollingKind::Gears | RollingKind::Rope => true,
            RollingKind::Wheel | RollingKind::Belt | RollingKind::Chain => false,
        }
    }

    /// Whether its links touch with teeth on both sides.
    pub fn meshes(self) -> bool {
        match self {
            RollingKind::Gears => true,
            RollingKind::Wheel | RollingKind::Belt | RollingKind::Chain | RollingKind::Rope => false,
        }
    }
}

impl Contours {
    /// The radii that the scene gives (m), to be varied.
    pub fn radii_mut(&mut self) -> Vec<&mut Given> {
        match self {
            Contours::Circles { sizes: Sizes::Radii(radii), .. } | Contours::Belt { radii, .. } => radii.iter_mut().collect(),
            Contours::Circles { sizes: Sizes::Teeth(_), .. } => Vec::new(),
            Contours::Track { radius, .. } => vec![radius],
        }
    }
}

impl Rolling {
    /// What is linearly related.
    pub fn relation(&self) -> Relation {
        match self.contours {
            Contours::Circles { centres, .. } | Contours::Belt { centres, .. } => Relation::Turnings(centres),
            Contours::Track { centre, guide, .. } => Relation::Slide { centre, guide },
        }
    }

    /// How the two links meet.
    pub fn touch(&self) -> Touch {
        match self.contours {
            Contours::Circles { centres, .. } => Touch::Point(Normal::Centres(centres)),
            Contours::Track { centre, guide, .. } => Touch::Point(Normal::Square { centre, guide }),
            Contours::Belt { centres, right, arm, .. } => Touch::Strand { centres, right, arm },
        }
    }

    /// The guide in which the second centre runs against the first link, which keeps the two in touch where nothing else does.
    pub fn guide(&self) -> Option<GuideId> {
        match self.contours {
            Contours::Circles { guide, .. } => guide,
            Contours::Track { guide, .. } => Some(guide),
            Contours::Belt { .. } => None,
        }
    }

    /// The same, to be numbered anew.
    pub(super) fn guide_mut(&mut self) -> Option<&mut GuideId> {
        match &mut self.contours {
            Contours::Circles { guide, .. } => guide.as_mut(),
            Contours::Track { guide, .. } => Some(guide),
            Contours::Belt { .. } => None,
        }
    }

    /// Which of the two contours is hollow, if one is.
    pub fn hollow(&self) -> Option<usize> {
        match self.contours {
            Contours::Circles { hollow, .. } => hollow,
            Contours::Track { .. } | Contours::Belt { .. } => None,
        }
    }

    /// Which belt or chain of the file it is a strand of; the strands of one follow one another.
    pub fn belt(&self) -> Option<usize> {
        match self.contours {
            Contours::Belt { belt, .. } => Some(belt),
            Contours::Circles { .. } | Contours::Track { .. } => None,
        }
    }

    /// Whether it is a strand that crosses the line of centres.
    pub fn is_crossed(&self) -> bool {
        match self.contours {
            Contours::Belt { crossed, .. } => crossed,
            Contours::Circles { .. } | Contours::Track { .. } => false,
        }
    }

    /// The radii of the two circles, where the scene gives both (m).
    pub fn radii(&self) -> Option<[&Given; 2]> {
        match &self.contours {
            Contours::Circles { sizes: Sizes::Radii([a, b]), .. } | Contours::Belt { radii: [a, b], .. } => Some([a, b]),
            Contours::Circles { sizes: Sizes::Teeth(_), .. } | Contours::Track { .. } => None,
        }
    }

    /// The numbers of teeth whose ratio is that of the two sizes, where the scene gives them.
    pub fn teeth(&self) -> Option<[u32; 2]> {
        match self.contours {
            Contours::Circles { sizes: Sizes::Teeth(teeth), .. } => Some(teeth),
            Contours::Belt { teeth, .. } => teeth,
            Contours::Circles { sizes: Sizes::Radii(_), .. } | Contours::Track { .. } => None,
        }
    }

    /// Names its links anew.
    pub fn rename(&mut self, of: impl Fn(LinkId) -> LinkId) {
        self.links = self.links.map(&of);
        match &mut self.contours {
            Contours::Belt { arm, .. } => *arm = of(*arm),
            Contours::Circles { .. } | Contours::Track { .. } => {}
        }
    }

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
