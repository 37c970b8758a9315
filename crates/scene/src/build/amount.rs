//! Quantities with their dimension in their type, written as in a scene: a number and its unit, or
//! an expression.

use serde_json::{Value, json};

/// A quantity of any dimension.
#[derive(Clone, Debug, PartialEq)]
pub struct Amount(String);

impl Amount {
    pub(super) fn json(&self) -> Value {
        json!(self.0)
    }
}

/// Returns a number with a unit, as the shortest decimal of this `f64`.
fn written(value: f64, unit: &str) -> String {
    format!("{value:?} {unit}").replacen(".0 ", " ", 1)
}

/// Defines a quantity's type, with one function for each unit.
macro_rules! amounts {
    ($($(#[$doc:meta])* $name:ident { $($function:ident $unit:literal),+ })+) => { $(
        $(#[$doc])*
        #[derive(Clone, Debug, PartialEq)]
        pub struct $name(Amount);

        impl $name {
            /// Returns an expression as in a file, which may use parameters: `2*r`. Its dimension
            /// is checked when the scene is read.
            pub fn expression(text: &str) -> $name {
                $name(Amount(text.to_owned()))
            }

            pub(super) fn json(&self) -> Value {
                self.0.json()
            }
        }

        impl From<$name> for Amount {
            fn from(value: $name) -> Amount {
                value.0
            }
        }

        $(
            #[doc = concat!("A number of ", $unit, ". What is not finite is refused when the scene is read.")]
            pub fn $function(value: f64) -> $name {
                $name(Amount(written(value, $unit)))
            }
        )+
    )+ };
}

amounts! {
    /// A length.
    Length { m "m", cm "cm", mm "mm", inches "in", feet "ft" }
    /// An angle, positive counter-clockwise.
    Angle { deg "deg", rad "rad" }
    /// An angular velocity, positive counter-clockwise.
    AngularVelocity { rad_per_s "rad/s", deg_per_s "deg/s", rpm "rpm" }
    /// An angular acceleration, positive counter-clockwise.
    AngularAcceleration { rad_per_s2 "rad/s^2", deg_per_s2 "deg/s^2" }
    /// A velocity.
    Velocity { m_per_s "m/s", mm_per_s "mm/s", feet_per_s "ft/s" }
    /// An acceleration.
    Acceleration { m_per_s2 "m/s^2", mm_per_s2 "mm/s^2", feet_per_s2 "ft/s^2" }
}
