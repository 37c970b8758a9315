//! Kinds of quantities, a value for each of them, and the order of derivative.

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

/// A value, mostly a number, for each kind of quantity that has one: for each kind of diagram, by the quantity that it is drawn of.
#[derive(Clone, Debug, PartialEq)]
pub struct ByKind<T = f64>(BTreeMap<Kind, T>);

impl<T> Default for ByKind<T> {
    fn default() -> Self {
        ByKind(BTreeMap::new())
    }
}

impl<T: Copy> ByKind<T> {
    /// The value of a kind.
    pub fn get(&self, kind: Kind) -> Option<T> {
        self.of(kind).copied()
    }
}

impl<T> ByKind<T> {
    /// The value of a kind, as it stands.
    pub fn of(&self, kind: Kind) -> Option<&T> {
        self.0.get(&kind)
    }

    /// The values of all kinds that have one, in the order of [`Kind`].
    pub fn values(&self) -> impl Iterator<Item = &T> {
        self.0.values()
    }

    /// The value of a kind, to be changed; that of a kind without one begins with the default.
    pub fn entry(&mut self, kind: Kind) -> &mut T
    where
        T: Default,
    {
        self.0.entry(kind).or_default()
    }

    /// Sets the value of a kind, or takes it away.
    pub fn set(&mut self, kind: Kind, value: Option<T>) {
        match value {
            Some(value) => self.0.insert(kind, value),
            None => self.0.remove(&kind),
        };
    }

    /// All with another value for a kind, or without one.
    pub fn with(mut self, kind: Kind, value: Option<T>) -> Self {
        self.set(kind, value);
        self
    }

    /// All values changed alike.
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
    /// The kinds that are drawn to a scale of their own.
    pub const DRAWN: [Kind; 4] = [Kind::Length, Kind::Velocity, Kind::Acceleration, Kind::Force];

    /// The key of the scale in files, such as `mu_v`; `None` of what is not drawn.
    pub const fn scale_key(self) -> Option<&'static str> {
        match self {
            Kind::Length => Some("mu_l"),
            Kind::Velocity => Some("mu_v"),
            Kind::Acceleration => Some("mu_a"),
            Kind::Force => Some("mu_F"),
            Kind::Angle | Kind::Omega | Kind::Alpha | Kind::Moment | Kind::Power | Kind::Time | Kind::Number => None,
        }
    }

    /// All for whose answers a unit can be chosen.
    pub const ALL: [Kind; 9] =
        [Kind::Length, Kind::Angle, Kind::Velocity, Kind::Acceleration, Kind::Omega, Kind::Alpha, Kind::Force, Kind::Moment, Kind::Power];

    /// Its SI unit, for programs and tables.
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

    /// Which derivative of a place or an angle it is; the lowest level for what is none, such as a force.
    pub const fn level(self) -> Level {
        match self {
            Kind::Length | Kind::Angle | Kind::Force | Kind::Moment | Kind::Power | Kind::Time | Kind::Number => Level::Position,
            Kind::Velocity | Kind::Omega => Level::Velocity,
            Kind::Acceleration | Kind::Alpha => Level::Acceleration,
        }
    }

    /// Whether it counts turning: its sign is a sense, told in words.
    pub const fn turns(self) -> bool {
        matches!(self, Kind::Omega | Kind::Alpha | Kind::Moment)
    }

    /// True for a kind that belongs to the forces of a mechanism and not to its motion.
    pub const fn is_of_forces(self) -> bool {
        matches!(self, Kind::Force | Kind::Moment | Kind::Power)
    }
}

/// How deep a thing is asked for. Each level needs the ones before it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Level {
    /// Where it is.
    #[default]
    Position,
    /// How fast.
    Velocity,
    /// With which acceleration.
    Acceleration,
}

impl Level {
    /// All of them, each after those that it needs.
    pub const ALL: [Level; 3] = [Level::Position, Level::Velocity, Level::Acceleration];

    /// Those that have equations and a polygon.
    pub const RATES: [Level; 2] = [Level::Velocity, Level::Acceleration];
}
