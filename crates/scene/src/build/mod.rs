//! Scenes from a program, without JSON: what a scene says, in typed quantities.
//!
//! A [`Builder`] gathers the same words that a file says; [`Builder::build`] hands them to the reader of files, so that there is one
//! set of rules, and [`Builder::json`] is the file. Names, numbers and what belongs together are judged there, not here.
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

/// A scene in the making. Every call adds to what the file of that scene would say; a second call for the same name replaces the first.
#[derive(Clone, Debug, Default)]
#[must_use]
pub struct Builder {
    members: Map<String, Value>,
}

impl Builder {
    /// A scene that says nothing yet.
    pub fn new() -> Builder {
        Builder::default()
    }

    /// The title, in the language of the scene.
    pub fn title(self, text: &str) -> Builder {
        self.member("title", json!(text))
    }

    /// The problem statement, in the language of the scene.
    pub fn statement(self, text: &str) -> Builder {
        self.member("statement", json!(text))
    }

    /// A link and its points. A point that several links name is the pin that joins them.
    pub fn link<'a>(self, name: &str, points: impl IntoIterator<Item = &'a str>) -> Builder {
        self.under("links", name, json!(points.into_iter().collect::<Vec<_>>()))
    }

    /// The fixed link; its pivots are those of [`Builder::link`].
    pub fn ground(self, name: &str) -> Builder {
        self.member("ground", json!(name))
    }

    /// A named value that later quantities may use in their expressions.
    pub fn parameter(self, name: &str, value: impl Into<Amount>) -> Builder {
        let value: Amount = value.into();
        self.under("parameters", name, value.json())
    }

    /// The distance of two points of one link, such as `AB` or `O2,B`.
    pub fn length(self, points: &str, value: Length) -> Builder {
        self.under("lengths", points, value.json())
    }

    /// A point's place in the plane at the instant: a fixed pivot, or part of the pose.
    pub fn point(self, name: &str, x: Length, y: Length) -> Builder {
        self.under("points", name, json!([x.json(), y.json()]))
    }

    /// A point's place in its link: the origin is the first point of `base`, x runs toward the second, y to the left.
    pub fn point_in_link(self, name: &str, base: &str, x: Length, y: Length) -> Builder {
        self.under("points", name, json!({"base": base, "x": x.json(), "y": y.json()}))
    }

    /// A point's place in its link, at a distance from the first point of `base`, counter-clockwise from the direction toward the second.
    pub fn point_by_angle(self, name: &str, base: &str, length: Length, angle: Angle) -> Builder {
        self.under("points", name, json!({"base": base, "length": length.json(), "angle": angle.json()}))
    }

    /// A sliding pair.
    pub fn guide(self, guide: Guide) -> Builder {
        self.among("guides", guide.json())
    }

    /// A pair of gears, or a gear on its rack.
    pub fn gears(self, gears: Gears) -> Builder {
        self.among("gears", gears.json())
    }

    /// A wheel that rolls without slip.
    pub fn wheel(self, wheel: Wheel) -> Builder {
        self.among("rolling", wheel.json())
    }

    /// A belt round pulleys, or a chain round sprockets.
    pub fn belt(self, belt: Belt) -> Builder {
        let key = belt.section();
        self.among(key, belt.json())
    }

    /// A rope from a drum to its load.
    pub fn rope(self, rope: Rope) -> Builder {
        self.among("ropes", rope.json())
    }

    /// A driver; several may be added.
    pub fn driver(mut self, driver: Driver) -> Builder {
        match self.members.get_mut("driver") {
            None => drop(self.members.insert("driver".into(), driver.json())),
            Some(Value::Array(list)) => list.push(driver.json()),
            Some(first) => *first = json!([first.take(), driver.json()]),
        }
        self
    }

    /// On which side of a directed line a point lies, such as `left of BD`: chooses the assembly.
    pub fn side(self, point: &str, side: &str) -> Builder {
        self.under("side", point, json!(side))
    }

    /// Where a point lies roughly: chooses the assembly.
    pub fn sketch(self, point: &str, x: Length, y: Length) -> Builder {
        self.under("sketch", point, json!([x.json(), y.json()]))
    }

    /// What is asked; without it, everything is.
    pub fn find<'a>(mut self, questions: impl IntoIterator<Item = &'a str>) -> Builder {
        for question in questions {
            self = self.among("find", json!(question));
        }
        self
    }

    /// The language of what is printed.
    pub fn language(self, lang: Lang) -> Builder {
        let code = match lang {
            Lang::En => "en",
            Lang::Zh => "zh",
        };
        self.member("language", json!(code))
    }

    /// Any other member of the file, such as `cams`, `paper`, `answers`, as `docs/scene.md` describes it.
    pub fn member(mut self, key: &str, value: Value) -> Builder {
        self.members.insert(key.into(), value);
        self
    }

    /// The file of this scene, as a person would write it.
    pub fn json(&self) -> String {
        write(&Value::Object(self.members.clone()))
    }

    /// Reads what was said as the reader of files does.
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
