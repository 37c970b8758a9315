//! Legs: how known bodies hold the core of a group.
//!
//! Decided here, from topology alone: what a leg gives of the core, as a statement ([`Gives`], [`Hold`], [`ConstraintLine`]) in which
//! legs of one geometry are one; and what follows from it, the freedoms that it takes and its letter in the name of a dyad.
//! Positions, plan, drawing and sweep match the statements and work them out each in its own numbers; none of them asks for the kind
//! of leg. Not decided here: which legs a group has ([`super::groups`]), and any length.

use hodograph_scene::{GuideId, LinkId, PointId, RollingId};

/// How a known body holds an unknown point or link; [`Leg::freedoms`] says how much of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Leg {
    /// A known pin sits on the core link (takes two freedoms).
    Pinned {
        /// The known pin.
        pin: PointId,
    },
    /// The core link's angle follows from a known link: a slider that keeps its direction, or a turning driver.
    Angle {
        /// The known link.
        of: LinkId,
        /// The turning driver; `None` for a slider.
        driver: Option<usize>,
    },
    /// A bar, pinned to a known pin at `far` and to the core at `near`.
    Bar {
        /// The bar.
        link: LinkId,
        /// Pin at the core.
        near: PointId,
        /// The known pin.
        far: PointId,
    },
    /// A pin of the core runs in a guide carried by a known link.
    OnGuide {
        /// Pin of the core.
        pin: PointId,
        /// The guide.
        guide: GuideId,
    },
    /// A known pin runs in a guide carried by the core link.
    InSlot {
        /// The known pin.
        pin: PointId,
        /// The guide.
        guide: GuideId,
    },
    /// A cylinder from a known pin to a pin of the core.
    Cylinder {
        /// The driver.
        driver: usize,
        /// Pin of the core.
        near: PointId,
        /// The known pin.
        far: PointId,
    },
    /// The core link glides along a known link (or carries the guide along which a known link glides).
    Glide {
        /// The guide.
        guide: GuideId,
        /// The known link.
        other: LinkId,
    },
    /// The core pin runs in a guide of a known link at a given rate (takes two freedoms).
    Driven {
        /// The guide.
        guide: GuideId,
        /// The sliding driver.
        driver: usize,
        /// The core pin.
        pin: PointId,
    },
    /// The core pin runs at a given rate in a guide carried by an unknown link, which is itself pinned to a known pin.
    Ram {
        /// The link that carries the guide.
        link: LinkId,
        /// The known pin of that link.
        far: PointId,
        /// The guide.
        guide: GuideId,
        /// The sliding driver.
        driver: usize,
        /// The core pin.
        near: PointId,
    },
    /// The core link glides along a known link at a given rate (with its guide: two freedoms).
    DrivenGlide {
        /// The guide.
        guide: GuideId,
        /// The known link.
        other: LinkId,
        /// The sliding driver.
        driver: usize,
    },
    /// The core link rolls on a known link.
    Rolls {
        /// The rolling pair.
        pair: RollingId,
        /// The known link.
        other: LinkId,
        /// The place of contact.
        at: PointId,
    },
    /// A pin that sits on a known link (takes both freedoms of a pin).
    Carried {
        /// The known link.
        link: LinkId,
    },
}

/// What a leg gives of the core.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gives {
    /// The core pin's place: a point of this known link.
    Carrier(LinkId),
    /// The known pin about which the core link turns.
    Pivot(PointId),
    /// The core link's direction.
    Angle {
        /// The known link from whose direction it follows.
        of: LinkId,
        /// The turning driver; `None` for a slider, which keeps its direction.
        driver: Option<usize>,
    },
    /// A locus of one point of the core.
    Hold(Hold),
}

/// The locus that a leg gives for one point of the core.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hold {
    /// A pin of the core keeps its distance from a known pin.
    Distance {
        /// Pin of the core.
        near: PointId,
        /// The known pin.
        far: PointId,
        /// What lies between them.
        strut: Strut,
    },
    /// A pin of the core runs in a guide of a known link.
    Guide {
        /// Pin of the core.
        pin: PointId,
        /// The guide.
        guide: GuideId,
        /// The sliding driver that says where along the guide, if there is one.
        driver: Option<usize>,
    },
    /// A guide of the core link runs over a known pin.
    Slot {
        /// The known pin.
        pin: PointId,
        /// The guide.
        guide: GuideId,
    },
    /// The core link, whose direction is known, glides along a known link (or that one along the core).
    Glide {
        /// The guide.
        guide: GuideId,
        /// The known link.
        other: LinkId,
        /// The sliding driver that says where along the guide, if there is one.
        driver: Option<usize>,
    },
    /// The core link rolls on a known link: its point at the contact has the velocity of the other's.
    Rolls {
        /// The rolling pair.
        pair: RollingId,
        /// The known link.
        other: LinkId,
        /// The place of contact.
        at: PointId,
    },
}

/// What keeps two pins apart, and how long it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strut {
    /// A link, by its length.
    Bar(LinkId),
    /// A cylinder, by its driver.
    Cylinder(usize),
    /// A link that is pinned at the known pin and in whose guide a driver holds the core's pin.
    Ram {
        /// The link.
        link: LinkId,
        /// Its guide.
        guide: GuideId,
        /// The sliding driver.
        driver: usize,
    },
}

/// The line along which a leg holds a point of the core: the leg gives a locus for the velocity of every point of the core on it, and
/// the loci of all of them are parallel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConstraintLine {
    /// Through two pins.
    Along {
        /// Pin of the core.
        near: PointId,
        /// The known pin.
        far: PointId,
    },
    /// Through a pin, square to its guide; where the guide is an arc, through the arc's centre.
    Normal {
        /// The pin.
        pin: PointId,
        /// The guide.
        guide: GuideId,
    },
    /// The tangent at the contact of a rolling pair.
    Tangent {
        /// The pair.
        pair: RollingId,
        /// The place of contact.
        at: PointId,
    },
}

/// All that the legs of a core give, by what it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// The known link that carries the core pin.
    pub carrier: Option<LinkId>,
    /// The known pin about which the core link turns.
    pub pivot: Option<PointId>,
    /// The known link from whose direction that of the core link follows, and the turning driver if there is one.
    pub angle: Option<(LinkId, Option<usize>)>,
    /// The loci of points of the core, in the order of the legs.
    pub holds: Vec<Hold>,
}

impl Leg {
    /// The driver whose cylinder it is, if it is one.
    pub fn cylinder(&self) -> Option<usize> {
        match self {
            Leg::Cylinder { driver, .. } => Some(*driver),
            Leg::Pinned { .. }
            | Leg::Angle { .. }
            | Leg::Bar { .. }
            | Leg::OnGuide { .. }
            | Leg::InSlot { .. }
            | Leg::Glide { .. }
            | Leg::Driven { .. }
            | Leg::Ram { .. }
            | Leg::DrivenGlide { .. }
            | Leg::Rolls { .. }
            | Leg::Carried { .. } => None,
        }
    }

    /// What it gives of the core: the one place that tells the kinds of leg apart.
    pub fn gives(&self) -> Gives {
        Gives::Hold(match *self {
            Leg::Carried { link } => return Gives::Carrier(link),
            Leg::Pinned { pin } => return Gives::Pivot(pin),
            Leg::Angle { of, driver } => return Gives::Angle { of, driver },
            Leg::Bar { link, near, far } => Hold::Distance { near, far, strut: Strut::Bar(link) },
            Leg::Cylinder { driver, near, far } => Hold::Distance { near, far, strut: Strut::Cylinder(driver) },
            Leg::Ram { link, far, guide, driver, near } => Hold::Distance { near, far, strut: Strut::Ram { link, guide, driver } },
            Leg::OnGuide { pin, guide } => Hold::Guide { pin, guide, driver: None },
            Leg::Driven { guide, driver, pin } => Hold::Guide { pin, guide, driver: Some(driver) },
            Leg::InSlot { pin, guide } => Hold::Slot { pin, guide },
            Leg::Rolls { pair, other, at } => Hold::Rolls { pair, other, at },
            Leg::Glide { guide, other } => Hold::Glide { guide, other, driver: None },
            Leg::DrivenGlide { guide, other, driver } => Hold::Glide { guide, other, driver: Some(driver) },
        })
    }

    /// How many freedoms of the core the leg takes: a place on a known body two, a direction or a locus one, and a driver along a guide
    /// one more.
    pub fn freedoms(&self) -> usize {
        match self.gives() {
            Gives::Carrier(_) | Gives::Pivot(_) => 2,
            Gives::Angle { .. } | Gives::Hold(Hold::Distance { .. } | Hold::Slot { .. } | Hold::Rolls { .. }) => 1,
            Gives::Hold(Hold::Guide { driver, .. } | Hold::Glide { driver, .. }) => 1 + usize::from(driver.is_some()),
        }
    }

    /// The pair by which it ends at a known body, in the name of a dyad: revolute, prismatic, or a gear's.
    pub fn letter(&self) -> &'static str {
        match self.gives() {
            Gives::Pivot(_) | Gives::Hold(Hold::Distance { .. }) => "R",
            Gives::Carrier(_) | Gives::Angle { .. } | Gives::Hold(Hold::Guide { .. } | Hold::Slot { .. } | Hold::Glide { .. }) => "P",
            Gives::Hold(Hold::Rolls { .. }) => "G",
        }
    }

    /// Whether a driver moves the core itself by this leg. A cylinder and a ram are driven too: they change their own length.
    pub fn drives(&self) -> bool {
        match self.gives() {
            Gives::Angle { driver, .. } | Gives::Hold(Hold::Guide { driver, .. } | Hold::Glide { driver, .. }) => driver.is_some(),
            Gives::Carrier(_) | Gives::Pivot(_) | Gives::Hold(Hold::Distance { .. } | Hold::Slot { .. } | Hold::Rolls { .. }) => false,
        }
    }

    /// The locus that it gives for a point of the core, if that is what it gives.
    pub fn hold(&self) -> Option<Hold> {
        match self.gives() {
            Gives::Hold(hold) => Some(hold),
            Gives::Carrier(_) | Gives::Pivot(_) | Gives::Angle { .. } => None,
        }
    }

    /// Its constraint line, if it has one, see [`Hold::line`].
    pub fn line(&self) -> Option<ConstraintLine> {
        self.hold()?.line()
    }
}

impl Hold {
    /// The pin of the core that is held: none for a slot, which holds the place under its pin, for a contact, and for a gliding link, of
    /// which any point will do.
    pub fn near(&self) -> Option<PointId> {
        match *self {
            Hold::Distance { near, .. } => Some(near),
            Hold::Guide { pin, .. } => Some(pin),
            Hold::Slot { .. } | Hold::Glide { .. } | Hold::Rolls { .. } => None,
        }
    }

    /// For a bar: the link, its pin at the core, and the known pin.
    pub fn bar(&self) -> Option<(LinkId, PointId, PointId)> {
        match *self {
            Hold::Distance { near, far, strut: Strut::Bar(link) } => Some((link, near, far)),
            Hold::Distance { strut: Strut::Cylinder(_) | Strut::Ram { .. }, .. }
            | Hold::Guide { .. }
            | Hold::Slot { .. }
            | Hold::Rolls { .. }
            | Hold::Glide { .. } => None,
        }
    }

    /// The line along which it holds the core: none where a driver takes the way along the guide too, and for a gliding link, which
    /// is held along a direction and no line of its own.
    pub fn line(&self) -> Option<ConstraintLine> {
        match *self {
            Hold::Distance { near, far, .. } => Some(ConstraintLine::Along { near, far }),
            Hold::Guide { pin, guide, driver: None } | Hold::Slot { pin, guide } => Some(ConstraintLine::Normal { pin, guide }),
            Hold::Rolls { pair, at, .. } => Some(ConstraintLine::Tangent { pair, at }),
            Hold::Guide { driver: Some(_), .. } | Hold::Glide { .. } => None,
        }
    }
}

impl ConstraintLine {
    /// The pin, or place of contact, through which it is drawn.
    pub fn pin(&self) -> PointId {
        match *self {
            ConstraintLine::Along { near, .. } => near,
            ConstraintLine::Normal { pin, .. } | ConstraintLine::Tangent { at: pin, .. } => pin,
        }
    }
}

impl Entry {
    /// What the legs of a core give together.
    pub fn of(legs: &[Leg]) -> Entry {
        let mut entry = Entry { carrier: None, pivot: None, angle: None, holds: Vec::with_capacity(legs.len()) };
        for leg in legs {
            match leg.gives() {
                Gives::Carrier(link) => entry.carrier = entry.carrier.or(Some(link)),
                Gives::Pivot(pin) => entry.pivot = entry.pivot.or(Some(pin)),
                Gives::Angle { of, driver } => entry.angle = entry.angle.or(Some((of, driver))),
                Gives::Hold(hold) => entry.holds.push(hold),
            }
        }
        entry
    }
}
