//! Belts around pulleys, chains around sprockets, ropes from a drum.

use super::amount::{Angle, Length};
use super::part::{MemberEntry, members};
use serde_json::{Value, json};

/// A belt or a chain.
#[derive(Clone, Debug)]
#[must_use]
pub struct Belt(MemberEntry);

impl Belt {
    /// Returns a belt around pulleys with their centres and radii, in the order along the belt.
    pub fn round(pulleys: &[&str], centres: &[&str], radii: &[Length]) -> Belt {
        let radii: Value = radii.iter().map(Length::json).collect();
        Belt(
            MemberEntry::default()
                .with("pulleys", json!(pulleys))
                .with("centres", json!(centres))
                .with("radii", radii),
        )
    }

    /// Returns a chain of this pitch around sprockets with their centres and numbers of teeth.
    pub fn chain(sprockets: &[&str], centres: &[&str], teeth: &[u32], pitch: Length) -> Belt {
        let entry = MemberEntry::default()
            .with("sprockets", json!(sprockets))
            .with("centres", json!(centres));
        Belt(entry.with("teeth", json!(teeth)).with("pitch", pitch.json()))
    }

    /// Returns its section of the file.
    pub(super) fn section(&self) -> &'static str {
        if self.0.0.contains_key("sprockets") { "chains" } else { "belts" }
    }
}

members! { Belt:
    /// True if a belt around two pulleys is crossed.
    crossed(value: bool) "crossed" = json!(value);
    /// The wheels that turn in the opposite sense.
    reversed(links: &[&str]) "reversed" = json!(links);
    /// The names of both ends of the strand between each wheel and the next.
    at(points: &[&str]) "at" = json!(points);
    /// The angle of the second link's line, as [`Gears::phase`](super::Gears::phase).
    phase(value: Angle) "phase" = value.json();
}

/// A rope that winds on a drum and pulls a load.
#[derive(Clone, Debug)]
#[must_use]
pub struct Rope(MemberEntry);

impl Rope {
    /// Returns a rope between a drum, with its centre and radius, and the load that slides in the
    /// direction of the rope, with the drum on its left.
    pub fn wound(drum: &str, centre: &str, radius: Length, load: &str, direction: Angle) -> Rope {
        let entry = MemberEntry::default()
            .with("drum", json!(drum))
            .with("centre", json!(centre))
            .with("radius", radius.json());
        Rope(entry.with("load", json!(load)).with("angle", direction.json()))
    }
}

members! { Rope:
    /// The name of the point at which it leaves the drum.
    at(point: &str) "at" = json!(point);
}
