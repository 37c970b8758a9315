//! Common and different properties of the kinds of driver, as methods, so that other modules need
//! not match the kinds.
//!
//! A new kind of driver implements these methods, and the modules that call them need no change.

use super::{Angle, DriverKind, GivenQuantity, GuideId, LinkId, PointId};

/// The position of a driver as the file gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Position<'a> {
    /// An angle, measured as the driver defines it.
    Angle(&'a GivenQuantity<Angle>),
    /// A coordinate along a guide, or a distance (m).
    Length(&'a GivenQuantity),
}

/// The storage of a driver's position.
#[derive(Debug)]
pub enum PositionSlot<'a> {
    /// An angle, measured as the driver defines it.
    Angle(&'a mut Option<GivenQuantity<Angle>>),
    /// A coordinate along a guide (m), of either sign.
    Coordinate(&'a mut Option<GivenQuantity>),
    /// A distance (m), which is not negative.
    Distance(&'a mut Option<GivenQuantity>),
}

impl Position<'_> {
    /// Returns its value: rad or m.
    pub fn value(self) -> f64 {
        match self {
            Position::Angle(angle) => angle.value.radians(),
            Position::Length(length) => length.value,
        }
    }
}

impl DriverKind {
    /// Returns true if its position is an angle; else the position is a length, and the rate a
    /// velocity.
    pub fn turns(&self) -> bool {
        match self {
            DriverKind::Turn { .. } => true,
            DriverKind::Slide { .. } | DriverKind::Cylinder { .. } => false,
        }
    }

    /// Returns the link that it turns, and the reference link.
    pub fn turned(&self) -> Option<(LinkId, LinkId)> {
        match *self {
            DriverKind::Turn { link, against, .. } => Some((link, against)),
            DriverKind::Slide { .. } | DriverKind::Cylinder { .. } => None,
        }
    }

    /// Returns true if it turns a link, or turns another relative to it.
    pub fn turns_link(&self, l: LinkId) -> bool {
        self.turned().is_some_and(|(link, against)| link == l || against == l)
    }

    /// Returns the lines of the driven link and of the reference link between which its angle is
    /// measured, if they differ from the default.
    pub fn lines(&self) -> [Option<(PointId, PointId)>; 2] {
        match *self {
            DriverKind::Turn { line, against_line, .. } => [line, against_line],
            DriverKind::Slide { .. } | DriverKind::Cylinder { .. } => [None, None],
        }
    }

    /// Returns the guide along which it moves a body.
    pub fn guide(&self) -> Option<GuideId> {
        match *self {
            DriverKind::Slide { guide, .. } => Some(guide),
            DriverKind::Turn { .. } | DriverKind::Cylinder { .. } => None,
        }
    }

    /// Returns the two points whose distance it gives.
    pub fn ends(&self) -> Option<[PointId; 2]> {
        match *self {
            DriverKind::Cylinder { a, b, .. } => Some([a, b]),
            DriverKind::Turn { .. } | DriverKind::Slide { .. } => None,
        }
    }

    /// Returns the links that are parts of the driver itself: barrel and rod of a cylinder, if they
    /// have numbers.
    pub fn parts(&self) -> &[LinkId] {
        match self {
            DriverKind::Cylinder { links, .. } => links,
            DriverKind::Turn { .. } | DriverKind::Slide { .. } => &[],
        }
    }

    /// Returns the ends of a cylinder, with the end of the given part first: the barrel is pinned
    /// at the first point in the file, the rod at the second.
    pub fn ends_of(&self, part: LinkId) -> Option<[PointId; 2]> {
        let [a, b] = self.ends()?;
        Some(if self.parts().get(1) == Some(&part) { [b, a] } else { [a, b] })
    }

    /// Returns its position; `None` if coordinates give the pose.
    pub fn position(&self) -> Option<Position<'_>> {
        match self {
            DriverKind::Turn { angle, .. } => angle.as_ref().map(Position::Angle),
            DriverKind::Slide { position: x, .. } | DriverKind::Cylinder { length: x, .. } => {
                x.as_ref().map(Position::Length)
            }
        }
    }

    /// Returns the storage of its position, for changes.
    pub fn slot(&mut self) -> PositionSlot<'_> {
        match self {
            DriverKind::Turn { angle, .. } => PositionSlot::Angle(angle),
            DriverKind::Slide { position, .. } => PositionSlot::Coordinate(position),
            DriverKind::Cylinder { length, .. } => PositionSlot::Distance(length),
        }
    }

    /// Returns its given angle, if any.
    pub fn angle(&self) -> Option<&GivenQuantity<Angle>> {
        match self.position()? {
            Position::Angle(angle) => Some(angle),
            Position::Length(_) => None,
        }
    }

    /// Returns its given coordinate or distance, if any.
    pub fn length(&self) -> Option<&GivenQuantity> {
        match self.position()? {
            Position::Length(length) => Some(length),
            Position::Angle(_) => None,
        }
    }
}
