//! Scenes from a program, without JSON, in typed quantities.
//!
//! A [`Builder`] collects the members of a scene file. [`Builder::build`] passes them to the reader
//! of files, so that there is one set of rules, and [`Builder::json`] returns the file. The reader
//! checks names, numbers and their consistency.
//!
//! ```
//! use hodograph_scene::build::{Builder, Driver, deg, mm, rad_per_s};
//!
//! let builder = Builder::new()
//!     .link("1", ["A", "B"])
//!     .link("2", ["A"])
//!     .ground("2")
//!     .length("AB", mm(100.0))
//!     .driver(Driver::turning("1").angle(deg(30.0)).omega(rad_per_s(10.0)))
//!     .find(["v_B"]);
//! assert_eq!(builder.build()?.value.lengths[0].value.value, 0.1);
//! assert!(builder.json().contains(r#""lengths": {"AB": "100 mm"}"#));
//! # Ok::<(), hodograph_base::diag::Faults>(())
//! ```

mod amount;
mod belt;
mod part;
#[cfg(test)]
mod tests;

pub use amount::*;
pub use belt::{Belt, Rope};
pub use part::{Driver, Gears, Guide, Wheel};

use super::{Lang, Scene, read, write};
use hodograph_base::diag::{Faults, Warned};
use serde_json::{Map, Value, json};

/// A scene under construction. Every call adds to the scene's file; a second call for the same name
/// replaces the first.
#[derive(Clone, Debug, Default)]
#[must_use]
pub struct Builder {
    members: Map<String, Value>,
}

impl Builder {
    /// Returns an empty scene.
    pub fn new() -> Builder {
        Builder::default()
    }

    /// Sets the title, in the language of the scene.
    pub fn title(self, text: &str) -> Builder {
        self.member("title", json!(text))
    }

    /// Sets the problem statement, in the language of the scene.
    pub fn statement(self, text: &str) -> Builder {
        self.member("statement", json!(text))
    }

    /// Adds a link and its points. A point that several links name is the pin that joins them.
    pub fn link<'a>(self, name: &str, points: impl IntoIterator<Item = &'a str>) -> Builder {
        self.under("links", name, json!(points.into_iter().collect::<Vec<_>>()))
    }

    /// Sets the fixed link; its pivots are those of [`Builder::link`].
    pub fn ground(self, name: &str) -> Builder {
        self.member("ground", json!(name))
    }

    /// Adds a named value for the expressions of later quantities.
    pub fn parameter(self, name: &str, value: impl Into<Amount>) -> Builder {
        let value: Amount = value.into();
        self.under("parameters", name, value.json())
    }

    /// Adds the distance of two points of one link, such as `AB` or `O2,B`.
    pub fn length(self, points: &str, value: Length) -> Builder {
        self.under("lengths", points, value.json())
    }

    /// Sets a point's place in the fixed plane at the instant: a fixed pivot, or part of the pose.
    pub fn point(self, name: &str, x: Length, y: Length) -> Builder {
        self.under("points", name, json!([x.json(), y.json()]))
    }

    /// Sets a point's place in its link: origin at the first point of `base`, x toward the second,
    /// y to the left.
    pub fn point_in_link(self, name: &str, base: &str, x: Length, y: Length) -> Builder {
        self.under("points", name, json!({"base": base, "x": x.json(), "y": y.json()}))
    }

    /// Sets a point's place in its link by polar coordinates: the distance from the first point of
    /// `base`, and the angle from the direction toward the second, positive counter-clockwise.
    pub fn point_by_angle(self, name: &str, base: &str, length: Length, angle: Angle) -> Builder {
        self.under(
            "points",
            name,
            json!({"base": base, "length": length.json(), "angle": angle.json()}),
        )
    }

    /// Adds a sliding pair.
    pub fn guide(self, guide: Guide) -> Builder {
        self.among("guides", guide.json())
    }

    /// Adds a pair of gears, or a gear on its rack.
    pub fn gears(self, gears: Gears) -> Builder {
        self.among("gears", gears.json())
    }

    /// Adds a wheel that rolls without slip.
    pub fn wheel(self, wheel: Wheel) -> Builder {
        self.among("rolling", wheel.json())
    }

    /// Adds a belt around pulleys, or a chain around sprockets.
    pub fn belt(self, belt: Belt) -> Builder {
        let key = belt.section();
        self.among(key, belt.json())
    }

    /// Adds a rope from a drum to its load.
    pub fn rope(self, rope: Rope) -> Builder {
        self.among("ropes", rope.json())
    }

    /// Adds a driver; several are possible.
    pub fn driver(mut self, driver: Driver) -> Builder {
        match self.members.get_mut("driver") {
            None => drop(self.members.insert("driver".into(), driver.json())),
            Some(Value::Array(list)) => list.push(driver.json()),
            Some(first) => *first = json!([first.take(), driver.json()]),
        }
        self
    }

    /// Sets the side of a directed line on which a point is, such as `left of BD`, to select the
    /// assembly.
    pub fn side(self, point: &str, side: &str) -> Builder {
        self.under("side", point, json!(side))
    }

    /// Sets the rough place of a point, to select the assembly.
    pub fn sketch(self, point: &str, x: Length, y: Length) -> Builder {
        self.under("sketch", point, json!([x.json(), y.json()]))
    }

    /// Adds questions; without any, everything is asked.
    pub fn find<'a>(mut self, questions: impl IntoIterator<Item = &'a str>) -> Builder {
        for question in questions {
            self = self.among("find", json!(question));
        }
        self
    }

    /// Sets the language of the output.
    pub fn language(self, lang: Lang) -> Builder {
        self.member("language", json!(lang.name()))
    }

    /// Sets any other member of the file, such as `cams`, `paper`, `answers`, as `docs/scene.md`
    /// describes it.
    pub fn member(mut self, key: &str, value: Value) -> Builder {
        self.members.insert(key.into(), value);
        self
    }

    /// Returns the file of this scene, in the layout that a person writes.
    pub fn json(&self) -> String {
        write(&Value::Object(self.members.clone()))
    }

    /// Reads the scene with the reader of files.
    ///
    /// # Errors
    /// As [`read`]; places count in [`Builder::json`].
    pub fn build(&self) -> Result<Warned<Scene>, Faults> {
        read(self.json())
    }

    fn under(mut self, key: &str, name: &str, value: Value) -> Builder {
        if let Value::Object(members) = self.members.entry(key).or_insert_with(|| json!({})) {
            members.insert(name.into(), value);
        }
        self
    }

    fn among(mut self, key: &str, value: Value) -> Builder {
        if let Value::Array(list) = self.members.entry(key).or_insert_with(|| json!([])) {
            list.push(value);
        }
        self
    }
}
