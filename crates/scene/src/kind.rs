//! Kinds of quantities, and one number for each of them.

use super::quantity::Level;
use super::units::Wanted;
use std::collections::BTreeMap;

/// A kind of quantity: what shares a unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// Lengths and coordinates.
    Length,
    /// Angles of links and drivers.
    Angle,
    /// Velocities of points.
    Velocity,
    /// Accelerations of points.
    Acceleration,
    /// Angular velocities.
    Omega,
    /// Angular accelerations.
    Alpha,
    /// Time.
    Time,
    /// Ratios and counts: numbers without a unit.
    Number,
}

/// A number for each kind of quantity that has one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ByKind(BTreeMap<Kind, f64>);

impl ByKind {
    /// The number of a kind.
    pub fn get(&self, kind: Kind) -> Option<f64> {
        self.0.get(&kind).copied()
    }

    /// Sets the number of a kind, or takes it away.
    pub fn set(&mut self, kind: Kind, value: Option<f64>) {
        match value {
            Some(value) => self.0.insert(kind, value),
            None => self.0.remove(&kind),
        };
    }

    /// All with another number for a kind, or without one.
    pub fn with(mut self, kind: Kind, value: Option<f64>) -> ByKind {
        self.set(kind, value);
        self
    }

    /// All numbers changed alike.
    pub fn map(&self, change: impl Fn(f64) -> f64) -> ByKind {
        ByKind(self.0.iter().map(|(kind, value)| (*kind, change(*value))).collect())
    }
}

impl FromIterator<(Kind, f64)> for ByKind {
    fn from_iter<I: IntoIterator<Item = (Kind, f64)>>(all: I) -> ByKind {
        ByKind(all.into_iter().collect())
    }
}

impl Kind {
    /// The kinds that are drawn to a scale of their own.
    pub const DRAWN: [Kind; 3] = [Kind::Length, Kind::Velocity, Kind::Acceleration];

    /// The key of the scale in files, such as `mu_v`; `None` of what is not drawn.
    pub const fn scale_key(self) -> Option<&'static str> {
        match self {
            Kind::Length => Some("mu_l"),
            Kind::Velocity => Some("mu_v"),
            Kind::Acceleration => Some("mu_a"),
            Kind::Angle | Kind::Omega | Kind::Alpha | Kind::Time | Kind::Number => None,
        }
    }

    /// All for whose answers a unit can be chosen.
    pub const ALL: [Kind; 6] = [Kind::Length, Kind::Angle, Kind::Velocity, Kind::Acceleration, Kind::Omega, Kind::Alpha];

    /// What the scene must write for it.
    pub const fn wanted(self) -> Wanted {
        match self {
            Kind::Length => Wanted::Length,
            Kind::Angle => Wanted::Angle,
            Kind::Velocity => Wanted::Velocity,
            Kind::Acceleration => Wanted::Acceleration,
            Kind::Omega => Wanted::Omega,
            Kind::Alpha => Wanted::Alpha,
            Kind::Time => Wanted::Time,
            Kind::Number => Wanted::Number,
        }
    }

    /// Its SI unit, for programs and tables.
    pub const fn si(self) -> &'static str {
        match self {
            Kind::Length => "m",
            Kind::Angle => "rad",
            Kind::Velocity => "m/s",
            Kind::Acceleration => "m/s²",
            Kind::Omega => "rad/s",
            Kind::Alpha => "rad/s²",
            Kind::Time => "s",
            Kind::Number => "",
        }
    }

    /// Which derivative of a place or an angle it is.
    pub const fn level(self) -> Level {
        match self {
            Kind::Length | Kind::Angle | Kind::Time | Kind::Number => Level::Position,
            Kind::Velocity | Kind::Omega => Level::Velocity,
            Kind::Acceleration | Kind::Alpha => Level::Acceleration,
        }
    }

    /// Whether it counts turning: its sign is a sense, told in words.
    pub const fn turns(self) -> bool {
        matches!(self, Kind::Omega | Kind::Alpha)
    }
}
