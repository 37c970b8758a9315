//! Units and dimensions: the known units with their values, and the dimension of each quantity of a
//! scene.

use super::expr::Expr;
use super::front::{self, mentions};
use hodograph_base::diag::{Both, both};
use hodograph_base::kind::Kind;

/// Exponents of length, time, plane angle and mass. The angle is a separate dimension, so that
/// `60 deg` is not mistaken for a length or a pure number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Dim {
    /// Exponent of the metre.
    pub length: i8,
    /// Exponent of the second.
    pub time: i8,
    /// Exponent of the radian.
    pub angle: i8,
    /// Exponent of the kilogram.
    pub mass: i8,
}

impl Dim {
    /// The dimension of a pure number.
    pub const NUMBER: Dim = Dim::new(0, 0, 0);
    /// The dimension of an angle.
    pub const ANGLE: Dim = Dim::new(0, 0, 1);

    /// The dimension of a time.
    pub const TIME: Dim = Dim::new(0, 1, 0);

    const fn new(length: i8, time: i8, angle: i8) -> Dim {
        Dim { length, time, angle, mass: 0 }
    }

    /// A dimension that contains the kilogram to the first power.
    const fn of_mass(length: i8, time: i8) -> Dim {
        Dim { length, time, angle: 0, mass: 1 }
    }

    /// Returns its exponents.
    pub const fn exponents(self) -> [i8; 4] {
        [self.length, self.time, self.angle, self.mass]
    }

    /// Returns the dimension of a product with the `k`-th power of another: `self · other^k`.
    pub const fn times(self, other: Dim, k: i32) -> Dim {
        // Exponents outside the range are refused, so their values have no effect.
        let k = if k > 100 {
            100
        } else if k < -100 {
            -100
        } else {
            k as i8
        };
        Dim {
            length: self.length.saturating_add(other.length.saturating_mul(k)),
            time: self.time.saturating_add(other.time.saturating_mul(k)),
            angle: self.angle.saturating_add(other.angle.saturating_mul(k)),
            mass: self.mass.saturating_add(other.mass.saturating_mul(k)),
        }
    }

    /// Returns true if a quantity of this dimension fits where `wanted` is needed. An arc is a
    /// length, `ω·r` a velocity and `v/r` an angular velocity: next to a length or a time, radians
    /// are pure numbers.
    pub const fn serves(self, wanted: Dim) -> bool {
        // (m/s)/m, 1/s and rad/s are angular velocities; a scale in 1/s is not.
        let turning = wanted.angle != 0 && wanted.time != 0;
        let same =
            self.length == wanted.length && self.time == wanted.time && self.mass == wanted.mass;
        same && (self.angle == wanted.angle || self.length != 0 || turning)
    }

    /// Returns it in words: `a length`, `an angle`, `a quantity in m^2/s`.
    pub fn describe(self) -> Both {
        match (self.length, self.time, self.angle) {
            _ if self.mass != 0 => {
                match RequiredQuantity::OF_MASS.into_iter().find(|w| w.dim() == self) {
                    Some(wanted) => wanted.describe(),
                    None => both!("a quantity in {}", self.units()),
                }
            }
            (0, 0, 0) => both!("a pure number"),
            (1, 0, 0) => both!("a length"),
            (2, 0, 0) => both!("an area"),
            (0, 1, 0) => both!("a time"),
            (0, 0, 1) => both!("an angle"),
            (0, -1, 1) => both!("an angular velocity"),
            (0, -2, 1) => both!("an angular acceleration"),
            (1, -1, 0) => both!("a velocity"),
            (1, -2, 0) => both!("an acceleration"),
            _ => both!("a quantity in {}", self.units()),
        }
    }

    fn units(self) -> String {
        let part = |sign: i8| {
            let mut out = Vec::new();
            for (name, k) in
                [("kg", self.mass), ("m", self.length), ("rad", self.angle), ("s", self.time)]
            {
                match k * sign {
                    1 => out.push(name.to_owned()),
                    k if k > 1 => out.push(format!("{name}^{k}")),
                    _ => {}
                }
            }
            out
        };
        let (above, below) = (part(1), part(-1));
        let above = if above.is_empty() { "1".to_owned() } else { above.join(" ") };
        match below.as_slice() {
            [] => above,
            [one] => format!("{above}/{one}"),
            many => format!("{above}/({})", many.join(" ")),
        }
    }
}

/// A unit: its value is `numerator / denominator` SI units, or that many degrees.
#[derive(Debug, PartialEq)]
pub struct Unit {
    /// Name as written.
    pub name: &'static str,
    /// Its dimension.
    pub dim: Dim,
    /// Numerator of the value. Value and divisor are two whole numbers, because 250 / 1000 is
    /// rounded once and 250 × 0.001 twice.
    pub numerator: f64,
    /// Denominator of the value.
    pub denominator: f64,
    /// True if the value is in degrees instead of radians: 1 rev = 360°, 1 rpm = 6°/s.
    pub degrees: bool,
}

const fn unit(name: &'static str, dim: Dim, numerator: f64, denominator: f64) -> Unit {
    Unit { name, dim, numerator, denominator, degrees: false }
}

const fn degrees(name: &'static str, dim: Dim, numerator: f64) -> Unit {
    Unit { name, dim, numerator, denominator: 1.0, degrees: true }
}

/// A minute and a second of arc, which occur only after degrees: `20°30′15″`.
pub static OF_ARC: [Unit; 2] = [
    Unit { name: "′", dim: Dim::ANGLE, numerator: 1.0, denominator: 60.0, degrees: true },
    Unit { name: "″", dim: Dim::ANGLE, numerator: 1.0, denominator: 3600.0, degrees: true },
];

const LENGTH: Dim = Dim::new(1, 0, 0);
const TIME: Dim = Dim::new(0, 1, 0);
const RATE: Dim = Dim::new(0, -1, 1);
const MASS: Dim = Dim::of_mass(0, 0);
const FORCE: Dim = Dim::of_mass(1, -2);
const POWER: Dim = Dim::of_mass(2, -3);

/// All units. Inch and foot are the international ones (25.4 mm, 304.8 mm), and so is the pound
/// (0.453 592 37 kg); a kilogram-force and a pound-force are the corresponding weights at g = 9.806
/// 65 m/s². A slug is 1 lbf·s²/ft, a blob 1 lbf·s²/in.
pub static UNITS: &[Unit] = &[
    unit("m", LENGTH, 1.0, 1.0),
    unit("cm", LENGTH, 1.0, 100.0),
    unit("mm", LENGTH, 1.0, 1000.0),
    unit("km", LENGTH, 1000.0, 1.0),
    unit("in", LENGTH, 254.0, 10000.0),
    unit("ft", LENGTH, 3048.0, 10000.0),
    degrees("deg", Dim::ANGLE, 1.0),
    degrees("°", Dim::ANGLE, 1.0),
    unit("rad", Dim::ANGLE, 1.0, 1.0),
    degrees("rev", Dim::ANGLE, 360.0),
    unit("s", TIME, 1.0, 1.0),
    unit("min", TIME, 60.0, 1.0),
    unit("h", TIME, 3600.0, 1.0),
    unit("kg", MASS, 1.0, 1.0),
    unit("g", MASS, 1.0, 1000.0),
    unit("lb", MASS, 45_359_237.0, 1e8),
    unit("slug", MASS, 8_896_443_230_521.0, 609_600_000_000.0),
    unit("blob", MASS, 8_896_443_230_521.0, 50_800_000_000.0),
    unit("N", FORCE, 1.0, 1.0),
    unit("kN", FORCE, 1000.0, 1.0),
    unit("kgf", FORCE, 980_665.0, 1e5),
    unit("lbf", FORCE, 8_896_443_230_521.0, 2e12),
    unit("W", POWER, 1.0, 1.0),
    unit("kW", POWER, 1000.0, 1.0),
    degrees("rpm", RATE, 6.0),
    // Revolutions per minute in Chinese books; only directly after a number, because `r` may be a
    // parameter.
    degrees("r/min", RATE, 6.0),
];

/// Returns the unit with a name.
pub fn unit_named(name: &str) -> Option<&'static Unit> {
    UNITS.iter().find(|u| u.name == name)
}

/// The quantity that a place in the scene needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RequiredQuantity {
    /// A length (m).
    Length,
    /// An angle (rad or degrees).
    Angle,
    /// An angular velocity (rad/s).
    Omega,
    /// An angular acceleration (rad/s²).
    Alpha,
    /// A velocity (m/s).
    Velocity,
    /// An acceleration (m/s²).
    Acceleration,
    /// A time (s).
    Time,
    /// A number without a unit.
    Number,
    /// A force (N).
    Force,
    /// A moment (N·m).
    Moment,
    /// A power (W).
    Power,
    /// A mass (kg).
    Mass,
    /// A moment of inertia (kg·m²).
    Inertia,
    /// A stiffness (N/m).
    Stiffness,
    /// A scale of lengths (m per mm of paper).
    ScaleOfLengths,
    /// A scale of velocities (m/s per mm of paper).
    ScaleOfVelocities,
    /// A scale of accelerations (m/s² per mm of paper).
    ScaleOfAccelerations,
    /// A scale of forces (N per mm of paper).
    ScaleOfForces,
}

impl RequiredQuantity {
    /// Returns the amount that a scene writes for a kind of quantity.
    pub const fn of(kind: Kind) -> RequiredQuantity {
        match kind {
            Kind::Length => RequiredQuantity::Length,
            Kind::Angle => RequiredQuantity::Angle,
            Kind::Velocity => RequiredQuantity::Velocity,
            Kind::Acceleration => RequiredQuantity::Acceleration,
            Kind::Omega => RequiredQuantity::Omega,
            Kind::Alpha => RequiredQuantity::Alpha,
            Kind::Time => RequiredQuantity::Time,
            Kind::Number => RequiredQuantity::Number,
            Kind::Force => RequiredQuantity::Force,
            Kind::Moment => RequiredQuantity::Moment,
            Kind::Power => RequiredQuantity::Power,
        }
    }

    /// The quantities whose dimension contains a mass.
    const OF_MASS: [RequiredQuantity; 6] = [
        RequiredQuantity::Force,
        RequiredQuantity::Moment,
        RequiredQuantity::Power,
        RequiredQuantity::Mass,
        RequiredQuantity::Inertia,
        RequiredQuantity::Stiffness,
    ];

    /// The quantities in the `units` table of a scene, with their keys.
    pub const TABLE: [(&'static str, RequiredQuantity); 12] = [
        ("length", RequiredQuantity::Length),
        ("angle", RequiredQuantity::Angle),
        ("omega", RequiredQuantity::Omega),
        ("alpha", RequiredQuantity::Alpha),
        ("velocity", RequiredQuantity::Velocity),
        ("acceleration", RequiredQuantity::Acceleration),
        ("force", RequiredQuantity::Force),
        ("moment", RequiredQuantity::Moment),
        ("power", RequiredQuantity::Power),
        ("mass", RequiredQuantity::Mass),
        ("inertia", RequiredQuantity::Inertia),
        ("stiffness", RequiredQuantity::Stiffness),
    ];

    /// Returns its dimension.
    pub const fn dim(self) -> Dim {
        match self {
            RequiredQuantity::Length => LENGTH,
            RequiredQuantity::Angle => Dim::ANGLE,
            RequiredQuantity::Omega => RATE,
            RequiredQuantity::Alpha => Dim::new(0, -2, 1),
            RequiredQuantity::Velocity => Dim::new(1, -1, 0),
            RequiredQuantity::Acceleration => Dim::new(1, -2, 0),
            RequiredQuantity::Time => TIME,
            RequiredQuantity::Number | RequiredQuantity::ScaleOfLengths => Dim::NUMBER,
            RequiredQuantity::ScaleOfVelocities => Dim::new(0, -1, 0),
            RequiredQuantity::ScaleOfAccelerations => Dim::new(0, -2, 0),
            RequiredQuantity::Force => FORCE,
            RequiredQuantity::Moment => Dim::of_mass(2, -2),
            RequiredQuantity::Power => POWER,
            RequiredQuantity::Mass => MASS,
            RequiredQuantity::Inertia => Dim::of_mass(2, 0),
            RequiredQuantity::Stiffness | RequiredQuantity::ScaleOfForces => Dim::of_mass(0, -2),
        }
    }

    /// Returns it in words for a message: `a length`.
    pub fn describe(self) -> Both {
        match self {
            RequiredQuantity::Length => both!("a length"),
            RequiredQuantity::Angle => both!("an angle"),
            RequiredQuantity::Omega => both!("an angular velocity"),
            RequiredQuantity::Alpha => both!("an angular acceleration"),
            RequiredQuantity::Velocity => both!("a velocity"),
            RequiredQuantity::Acceleration => both!("an acceleration"),
            RequiredQuantity::Time => both!("a time"),
            RequiredQuantity::Number => both!("a number"),
            RequiredQuantity::ScaleOfLengths => both!("a scale of lengths"),
            RequiredQuantity::ScaleOfVelocities => both!("a scale of velocities"),
            RequiredQuantity::ScaleOfAccelerations => {
                both!("a scale of accelerations")
            }
            RequiredQuantity::Force => both!("a force"),
            RequiredQuantity::Moment => both!("a moment"),
            RequiredQuantity::Power => both!("a power"),
            RequiredQuantity::Mass => both!("a mass"),
            RequiredQuantity::Inertia => both!("a moment of inertia"),
            RequiredQuantity::Stiffness => both!("a stiffness"),
            RequiredQuantity::ScaleOfForces => both!("a scale of forces"),
        }
    }

    /// Returns the help for an expression of another dimension; a law of time with the bare seconds
    /// of t lacks a factor.
    pub fn missing(self, dim: Dim, expr: &Expr) -> Both {
        let wanted = self.dim();
        let lacking = [("m", wanted.length - dim.length), ("rad", wanted.angle - dim.angle)];
        let seconds = dim.time - wanted.time;
        if seconds < 1
            || !mentions(expr, front::TIME)
            || lacking.iter().any(|(_, n)| !(0..=1).contains(n))
        {
            return both!("write it in {}", self.usual_unit());
        }
        let below = if seconds == 1 { "s".to_owned() } else { format!("s^{seconds}") };
        let above = lacking.iter().find(|(_, n)| *n == 1);
        let factor =
            above.map_or(format!("1/(1 {below})"), |(unit, _)| format!("1 {unit}/{below}"));
        both!("t counts in seconds: multiply by {factor}")
    }

    /// Returns a unit to suggest for a bare number.
    pub const fn usual_unit(self) -> &'static str {
        match self {
            RequiredQuantity::Length => "mm",
            RequiredQuantity::Angle => "deg",
            RequiredQuantity::Omega => "rad/s",
            RequiredQuantity::Alpha => "rad/s^2",
            RequiredQuantity::Velocity => "m/s",
            RequiredQuantity::Acceleration => "m/s^2",
            RequiredQuantity::Time => "s",
            RequiredQuantity::Number => "",
            RequiredQuantity::ScaleOfLengths => "m/mm",
            RequiredQuantity::ScaleOfVelocities => "(m/s)/mm",
            RequiredQuantity::ScaleOfAccelerations => "(m/s^2)/mm",
            RequiredQuantity::Force => "N",
            RequiredQuantity::Moment => "N*m",
            RequiredQuantity::Power => "W",
            RequiredQuantity::Mass => "kg",
            RequiredQuantity::Inertia => "kg*m^2",
            RequiredQuantity::Stiffness => "N/m",
            RequiredQuantity::ScaleOfForces => "N/mm",
        }
    }

    /// Returns the key in the `units` table for bare numbers of this kind; scales have none.
    pub fn key(self) -> Option<&'static str> {
        RequiredQuantity::TABLE.iter().find(|(_, w)| *w == self).map(|(k, _)| *k)
    }
}
