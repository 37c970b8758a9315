//! Legs: the connections of a group's core to known bodies.
//!
//! This module derives from topology alone what a leg gives of the core, as a statement
//! ([`LegStatement`], [`Hold`], [`ConstraintLine`]) that is the same for legs of the same geometry;
//! and the consequences: the freedoms that the leg takes and its letter in the name of a dyad.
//! Positions, plan, drawing and sweep match the statements and evaluate them each in its own
//! numbers; they do not distinguish the kinds of leg. The legs of a group are found in
//! [`super::groups`]; no length is used here.

use hodograph_scene::{GuideId, LinkId, PointId, RollingId};

/// The connection of an unknown point or link to a known body; [`Leg::freedoms`] returns the number
/// of freedoms that it takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Leg {
    /// A known pin on the core link (takes two freedoms).
    Pinned {
        /// The known pin.
        pin: PointId,
    },
    /// The angle of the core link follows from a known link: a slider that keeps its direction, or
    /// a rotary driver.
    Angle {
        /// The known link.
        of: LinkId,
        /// The rotary driver; `None` for a slider.
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
    /// The core link glides along a known link (or carries the guide along which a known link
    /// glides).
    Glide {
        /// The guide.
        guide: GuideId,
        /// The known link.
        other: LinkId,
    },
    /// The core pin moves in a guide of a known link at a given rate (takes two freedoms).
    Driven {
        /// The guide.
        guide: GuideId,
        /// The sliding driver.
        driver: usize,
        /// The core pin.
        pin: PointId,
    },
    /// The core pin moves at a given rate in a guide carried by an unknown link, which is itself
    /// pinned to a known pin.
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
    /// The core link glides along a known link at a given rate (two freedoms, including its guide).
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
        /// The point of contact.
        at: PointId,
    },
    /// A pin on a known link (takes both freedoms of a pin).
    Carried {
        /// The known link.
        link: LinkId,
    },
}

/// The information that a leg gives about the core.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LegStatement {
    /// The position of the core pin: a point of this known link.
    Carrier(LinkId),
    /// The known pin about which the core link turns.
    Pivot(PointId),
    /// The core link's direction.
    Angle {
        /// The known link that determines the direction.
        of: LinkId,
        /// The rotary driver; `None` for a slider, which keeps its direction.
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
        /// The part between them.
        strut: Strut,
    },
    /// A pin of the core runs in a guide of a known link.
    Guide {
        /// Pin of the core.
        pin: PointId,
        /// The guide.
        guide: GuideId,
        /// The sliding driver that determines the position along the guide, if there is one.
        driver: Option<usize>,
    },
    /// A guide of the core link runs over a known pin.
    Slot {
        /// The known pin.
        pin: PointId,
        /// The guide.
        guide: GuideId,
    },
    /// The core link, with a known direction, glides along a known link (or the known link along
    /// the core).
    Glide {
        /// The guide.
        guide: GuideId,
        /// The known link.
        other: LinkId,
        /// The sliding driver that determines the position along the guide, if there is one.
        driver: Option<usize>,
    },
    /// The core link rolls on a known link: its point at the contact has the velocity of the other
    /// link's point.
    Rolls {
        /// The rolling pair.
        pair: RollingId,
        /// The known link.
        other: LinkId,
        /// The point of contact.
        at: PointId,
    },
}

/// The part that keeps two pins apart and determines their distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strut {
    /// A link, of constant length.
    Bar(LinkId),
    /// A cylinder, with the length given by its driver.
    Cylinder(usize),
    /// A link pinned at the known pin, with a guide in which a driver holds the core's pin.
    Ram {
        /// The link.
        link: LinkId,
        /// Its guide.
        guide: GuideId,
        /// The sliding driver.
        driver: usize,
    },
}

/// The line along which a leg holds a point of the core. The leg gives a locus for the velocity of
/// every point of the core on the line, and these loci are parallel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConstraintLine {
    /// Through two pins.
    Along {
        /// Pin of the core.
        near: PointId,
        /// The known pin.
        far: PointId,
    },
    /// Through a pin, square to its guide; for a curved guide, through the centre of the arc.
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
        /// The point of contact.
        at: PointId,
    },
}

/// The combined information of all legs of a core, by kind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CoreLoci {
    /// The known link that carries the core pin.
    pub carrier: Option<LinkId>,
    /// The known pin about which the core link turns.
    pub pivot: Option<PointId>,
    /// The known link that determines the core link's direction, and the rotary driver if there is
    /// one.
    pub angle: Option<(LinkId, Option<usize>)>,
    /// The loci of points of the core, in the order of the legs.
    pub holds: Vec<Hold>,
}

impl Leg {
    /// Returns the driver of the cylinder, if the leg is one.
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

    /// Returns the information that the leg gives about the core: the only place that distinguishes
    /// the kinds of leg.
    pub fn gives(&self) -> LegStatement {
        LegStatement::Hold(match *self {
            Leg::Carried { link } => return LegStatement::Carrier(link),
            Leg::Pinned { pin } => return LegStatement::Pivot(pin),
            Leg::Angle { of, driver } => return LegStatement::Angle { of, driver },
            Leg::Bar { link, near, far } => Hold::Distance { near, far, strut: Strut::Bar(link) },
            Leg::Cylinder { driver, near, far } => {
                Hold::Distance { near, far, strut: Strut::Cylinder(driver) }
            }
            Leg::Ram { link, far, guide, driver, near } => {
                Hold::Distance { near, far, strut: Strut::Ram { link, guide, driver } }
            }
            Leg::OnGuide { pin, guide } => Hold::Guide { pin, guide, driver: None },
            Leg::Driven { guide, driver, pin } => Hold::Guide { pin, guide, driver: Some(driver) },
            Leg::InSlot { pin, guide } => Hold::Slot { pin, guide },
            Leg::Rolls { pair, other, at } => Hold::Rolls { pair, other, at },
            Leg::Glide { guide, other } => Hold::Glide { guide, other, driver: None },
            Leg::DrivenGlide { guide, other, driver } => {
                Hold::Glide { guide, other, driver: Some(driver) }
            }
        })
    }

    /// Returns the number of freedoms of the core that the leg takes: two for a position on a known
    /// body, one for a direction or a locus, and one more for a driver along a guide.
    pub fn freedoms(&self) -> usize {
        match self.gives() {
            LegStatement::Carrier(_) | LegStatement::Pivot(_) => 2,
            LegStatement::Angle { .. }
            | LegStatement::Hold(Hold::Distance { .. } | Hold::Slot { .. } | Hold::Rolls { .. }) => {
                1
            }
            LegStatement::Hold(Hold::Guide { driver, .. } | Hold::Glide { driver, .. }) => {
                1 + usize::from(driver.is_some())
            }
        }
    }

    /// Returns the letter of the pair at the known body, in the name of a dyad: revolute,
    /// prismatic, or the letter of a gear.
    pub fn letter(&self) -> &'static str {
        match self.gives() {
            LegStatement::Pivot(_) | LegStatement::Hold(Hold::Distance { .. }) => "R",
            LegStatement::Carrier(_)
            | LegStatement::Angle { .. }
            | LegStatement::Hold(Hold::Guide { .. } | Hold::Slot { .. } | Hold::Glide { .. }) => {
                "P"
            }
            LegStatement::Hold(Hold::Rolls { .. }) => "G",
        }
    }

    /// Returns true if a driver moves the core itself by this leg. A cylinder or a ram is driven
    /// too, but changes its own length.
    pub fn drives(&self) -> bool {
        match self.gives() {
            LegStatement::Angle { driver, .. }
            | LegStatement::Hold(Hold::Guide { driver, .. } | Hold::Glide { driver, .. }) => {
                driver.is_some()
            }
            LegStatement::Carrier(_)
            | LegStatement::Pivot(_)
            | LegStatement::Hold(Hold::Distance { .. } | Hold::Slot { .. } | Hold::Rolls { .. }) => {
                false
            }
        }
    }

    /// Returns the locus that the leg gives for a point of the core, if it gives one.
    pub fn hold(&self) -> Option<Hold> {
        match self.gives() {
            LegStatement::Hold(hold) => Some(hold),
            LegStatement::Carrier(_) | LegStatement::Pivot(_) | LegStatement::Angle { .. } => None,
        }
    }

    /// Returns the constraint line, if there is one, see [`Hold::line`].
    pub fn line(&self) -> Option<ConstraintLine> {
        self.hold()?.line()
    }
}

impl Hold {
    /// Returns the held pin of the core; `None` for a slot, which holds the point under its pin,
    /// for a contact, and for a gliding link, of which any point is suitable.
    pub fn near(&self) -> Option<PointId> {
        match *self {
            Hold::Distance { near, .. } => Some(near),
            Hold::Guide { pin, .. } => Some(pin),
            Hold::Slot { .. } | Hold::Glide { .. } | Hold::Rolls { .. } => None,
        }
    }

    /// Returns the link, its pin at the core, and the known pin of a bar.
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

    /// Returns the line along which the core is held; `None` if a driver also determines the
    /// position along the guide, and for a gliding link, which is held along a direction and not on
    /// a specific line.
    pub fn line(&self) -> Option<ConstraintLine> {
        match *self {
            Hold::Distance { near, far, .. } => Some(ConstraintLine::Along { near, far }),
            Hold::Guide { pin, guide, driver: None } | Hold::Slot { pin, guide } => {
                Some(ConstraintLine::Normal { pin, guide })
            }
            Hold::Rolls { pair, at, .. } => Some(ConstraintLine::Tangent { pair, at }),
            Hold::Guide { driver: Some(_), .. } | Hold::Glide { .. } => None,
        }
    }
}

impl ConstraintLine {
    /// Returns the pin, or the point of contact, through which the hold is drawn.
    pub fn pin(&self) -> PointId {
        match *self {
            ConstraintLine::Along { near, .. } => near,
            ConstraintLine::Normal { pin, .. } | ConstraintLine::Tangent { at: pin, .. } => pin,
        }
    }
}

impl CoreLoci {
    /// Returns the combined information of the legs of a core.
    pub fn of(legs: &[Leg]) -> CoreLoci {
        let mut entry = CoreLoci {
            carrier: None,
            pivot: None,
            angle: None,
            holds: Vec::with_capacity(legs.len()),
        };
        for leg in legs {
            match leg.gives() {
                LegStatement::Carrier(link) => entry.carrier = entry.carrier.or(Some(link)),
                LegStatement::Pivot(pin) => entry.pivot = entry.pivot.or(Some(pin)),
                LegStatement::Angle { of, driver } => {
                    entry.angle = entry.angle.or(Some((of, driver)))
                }
                LegStatement::Hold(hold) => entry.holds.push(hold),
            }
        }
        entry
    }
}
