//! Kinds of quantities, a value for each of them, and the order of derivative.

use std::collections::BTreeMap;

/// A kind of quantity; all quantities of a kind share a unit.
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
    /// Forces.
    Force,
    /// Moments of forces and couples.
    Moment,
    /// Powers.
    Power,
    /// Time.
    Time,
    /// Ratios and counts: numbers without a unit.
    Number,
}

/// A value, mostly a number, for each kind of quantity that has one; for a kind of diagram, the
/// value of its drawn quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct ByKind<T = f64>(BTreeMap<Kind, T>);

impl<T> Default for ByKind<T> {
    fn default() -> Self {
        ByKind(BTreeMap::new())
    }
}

impl<T: Copy> ByKind<T> {
    /// Returns a copy of the value of a kind.
    pub fn get(&self, kind: Kind) -> Option<T> {
        self.of(kind).copied()
    }
}

impl<T> ByKind<T> {
    /// Returns a reference to the value of a kind.
    pub fn of(&self, kind: Kind) -> Option<&T> {
        self.0.get(&kind)
    }

    /// Returns the values of all kinds that have one, in the order of [`Kind`].
    pub fn values(&self) -> impl Iterator<Item = &T> {
        self.0.values()
    }

    /// Returns the value of a kind for modification; a missing value starts with the default.
    pub fn entry(&mut self, kind: Kind) -> &mut T
    where
        T: Default,
    {
        self.0.entry(kind).or_default()
    }

    /// Sets or removes the value of a kind.
    pub fn set(&mut self, kind: Kind, value: Option<T>) {
        match value {
            Some(value) => self.0.insert(kind, value),
            None => self.0.remove(&kind),
        };
    }

    /// Returns all values with another value for one kind, or without it.
    pub fn with(mut self, kind: Kind, value: Option<T>) -> Self {
        self.set(kind, value);
        self
    }

    /// Returns all values changed by the same function.
    pub fn map<U>(&self, change: impl Fn(&T) -> U) -> ByKind<U> {
        ByKind(self.0.iter().map(|(kind, value)| (*kind, change(value))).collect())
    }
}

impl<T> FromIterator<(Kind, T)> for ByKind<T> {
    fn from_iter<I: IntoIterator<Item = (Kind, T)>>(all: I) -> ByKind<T> {
        ByKind(all.into_iter().collect())
    }
}

impl Kind {
    /// The kinds that are drawn with their own scale.
    pub const DRAWN: [Kind; 4] = [Kind::Length, Kind::Velocity, Kind::Acceleration, Kind::Force];

    /// Returns the key of the scale in files, such as `mu_v`; `None` for kinds that are not drawn.
    pub const fn scale_key(self) -> Option<&'static str> {
        match self {
            Kind::Length => Some("mu_l"),
            Kind::Velocity => Some("mu_v"),
            Kind::Acceleration => Some("mu_a"),
            Kind::Force => Some("mu_F"),
            Kind::Angle
            | Kind::Omega
            | Kind::Alpha
            | Kind::Moment
            | Kind::Power
            | Kind::Time
            | Kind::Number => None,
        }
    }

    /// All kinds with a selectable unit of the answers.
    pub const ALL: [Kind; 9] = [
        Kind::Length,
        Kind::Angle,
        Kind::Velocity,
        Kind::Acceleration,
        Kind::Omega,
        Kind::Alpha,
        Kind::Force,
        Kind::Moment,
        Kind::Power,
    ];

    /// Returns the SI unit, for programs and tables.
    pub const fn si(self) -> &'static str {
        match self {
            Kind::Length => "m",
            Kind::Angle => "rad",
            Kind::Velocity => "m/s",
            Kind::Acceleration => "m/s²",
            Kind::Omega => "rad/s",
            Kind::Alpha => "rad/s²",
            Kind::Force => "N",
            Kind::Moment => "N·m",
            Kind::Power => "W",
            Kind::Time => "s",
            Kind::Number => "",
        }
    }

    /// Returns the order of the derivative of a position or an angle; the lowest level for other
    /// quantities, such as forces.
    pub const fn level(self) -> Level {
        match self {
            Kind::Length
            | Kind::Angle
            | Kind::Force
            | Kind::Moment
            | Kind::Power
            | Kind::Time
            | Kind::Number => Level::Position,
            Kind::Velocity | Kind::Omega => Level::Velocity,
            Kind::Acceleration | Kind::Alpha => Level::Acceleration,
        }
    }

    /// Returns true if the quantity describes rotation: answers give its sign as a sense, in words.
    pub const fn turns(self) -> bool {
        matches!(self, Kind::Omega | Kind::Alpha | Kind::Moment)
    }

    /// Returns true if the kind belongs to the forces of a mechanism and not to its motion.
    pub const fn is_of_forces(self) -> bool {
        matches!(self, Kind::Force | Kind::Moment | Kind::Power)
    }
}

/// The order of derivative that is requested. Each level needs the ones before it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Level {
    /// Positions.
    #[default]
    Position,
    /// Velocities.
    Velocity,
    /// Accelerations.
    Acceleration,
}

impl Level {
    /// All levels, each after those that it needs.
    pub const ALL: [Level; 3] = [Level::Position, Level::Velocity, Level::Acceleration];

    /// The levels that have equations and a polygon.
    pub const RATES: [Level; 2] = [Level::Velocity, Level::Acceleration];
}
