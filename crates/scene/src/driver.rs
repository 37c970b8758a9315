//! What kinds of driver have in common, and what sets them apart: asked here instead of matched in the rooms.
//!
//! A new kind of driver answers these questions, and the rooms that ask them need not know it.

use super::{Angle, DriverKind, Given, GuideId, LinkId, PointId};

/// The position of a driver as the file gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Position<'a> {
    /// An angle, counted as the driver says.
    Angle(&'a Given<Angle>),
    /// A coordinate along a guide, or a distance (m).
    Length(&'a Given),
}

/// Where the position of a driver is held.
#[derive(Debug)]
pub enum PositionSlot<'a> {
    /// An angle, counted as the driver says.
    Angle(&'a mut Option<Given<Angle>>),
    /// A coordinate along a guide (m), of either sign.
    Coordinate(&'a mut Option<Given>),
    /// A distance (m), which is not negative.
    Distance(&'a mut Option<Given>),
}

impl Position<'_> {
    /// Its value: rad or m.
    pub fn value(self) -> f64 {
        match self {
            Position::Angle(angle) => angle.value.radians(),
            Position::Length(length) => length.value,
        }
    }
}

impl DriverKind {
    /// Whether its position is an angle; else it is a length, and its rate a speed.
    pub fn turns(&self) -> bool {
        match self {
            DriverKind::Turn { .. } => true,
            DriverKind::Slide { .. } | DriverKind::Cylinder { .. } => false,
        }
    }

    /// The link that it turns, and the one against which.
    pub fn turned(&self) -> Option<(LinkId, LinkId)> {
        match *self {
            DriverKind::Turn { link, against, .. } => Some((link, against)),
            DriverKind::Slide { .. } | DriverKind::Cylinder { .. } => None,
        }
    }

    /// Whether it turns a link, or turns others against it.
    pub fn turns_link(&self, l: LinkId) -> bool {
        self.turned().is_some_and(|(link, against)| link == l || against == l)
    }

    /// The lines of the driven link and of the other between which its angle is counted, where they are not the usual ones.
    pub fn lines(&self) -> [Option<(PointId, PointId)>; 2] {
        match *self {
            DriverKind::Turn { line, against_line, .. } => [line, against_line],
            DriverKind::Slide { .. } | DriverKind::Cylinder { .. } => [None, None],
        }
    }

    /// The guide along which it slides something.
    pub fn guide(&self) -> Option<GuideId> {
        match *self {
            DriverKind::Slide { guide, .. } => Some(guide),
            DriverKind::Turn { .. } | DriverKind::Cylinder { .. } => None,
        }
    }

    /// The two points whose distance it gives.
    pub fn ends(&self) -> Option<[PointId; 2]> {
        match *self {
            DriverKind::Cylinder { a, b, .. } => Some([a, b]),
            DriverKind::Turn { .. } | DriverKind::Slide { .. } => None,
        }
    }

    /// The links that are parts of the driver itself: barrel and rod of a cylinder, where they have numbers.
    pub fn parts(&self) -> &[LinkId] {
        match self {
            DriverKind::Cylinder { links, .. } => links,
            DriverKind::Turn { .. } | DriverKind::Slide { .. } => &[],
        }
    }

    /// The ends of a cylinder, that of one of its parts first: the barrel is pinned at the first that the file names, the rod at the second.
    pub fn ends_of(&self, part: LinkId) -> Option<[PointId; 2]> {
        let [a, b] = self.ends()?;
        Some(if self.parts().get(1) == Some(&part) { [b, a] } else { [a, b] })
    }

    /// Its position; `None` where the pose is given by coordinates.
    pub fn position(&self) -> Option<Position<'_>> {
        match self {
            DriverKind::Turn { angle, .. } => angle.as_ref().map(Position::Angle),
            DriverKind::Slide { position: x, .. } | DriverKind::Cylinder { length: x, .. } => x.as_ref().map(Position::Length),
        }
    }

    /// Where its position is held, to be changed.
    pub fn slot(&mut self) -> PositionSlot<'_> {
        match self {
            DriverKind::Turn { angle, .. } => PositionSlot::Angle(angle),
            DriverKind::Slide { position, .. } => PositionSlot::Coordinate(position),
            DriverKind::Cylinder { length, .. } => PositionSlot::Distance(length),
        }
    }

    /// The angle that it gives, if it gives one.
    pub fn angle(&self) -> Option<&Given<Angle>> {
        match self.position()? {
            Position::Angle(angle) => Some(angle),
            Position::Length(_) => None,
        }
    }

    /// The coordinate or distance that it gives, if it gives one.
    pub fn length(&self) -> Option<&Given> {
        match self.position()? {
            Position::Length(length) => Some(length),
            Position::Angle(_) => None,
        }
    }
}
