//! The synthesis file as written: an object with known keys, whose quantities are read with the
//! same code as those of scenes.
//!
//! A [`TaskForm`] interprets nothing; each kind of task reads from it the keys that it needs, and
//! reports missing ones with an example. Faults are collected, so that one run shows all.

use hodograph_base::diag::{Diagnostic, Faults, Span, both};
use hodograph_base::geom::Point;
use hodograph_base::json::fields::{Fields, list, suggest, word, wrong};
use hodograph_base::json::{Node, NodeKind, Word};
use hodograph_scene::front::{Curve, Front};
use hodograph_scene::units::RequiredQuantity;
use std::cell::RefCell;
use std::collections::BTreeSet;

/// Greatest number of entries of a list. Four hundred pairs of angles or points of a path exceed
/// any course design, and bound the time of the optimisers.
const MOST: usize = 400;

/// An object of the file.
pub(crate) struct TaskForm<'a> {
    fields: Fields<'a>,
    front: &'a Front<'a>,
    faults: &'a RefCell<Faults>,
    /// The keys that have been read.
    taken: RefCell<BTreeSet<String>>,
}

impl<'a> TaskForm<'a> {
    /// Returns an object with checked keys.
    pub fn new(
        fields: Fields<'a>,
        front: &'a Front<'a>,
        faults: &'a RefCell<Faults>,
    ) -> TaskForm<'a> {
        TaskForm { fields, front, faults, taken: RefCell::default() }
    }

    /// Adds a fault.
    pub fn fault(&self, d: Diagnostic) {
        self.faults.borrow_mut().push(d);
    }

    /// The value of a key; marks the key as read.
    pub fn node(&self, key: &str) -> Option<&'a Node> {
        self.taken.borrow_mut().insert(key.to_owned());
        self.fields.get(key)
    }

    /// Warnings for those of some keys that are present but were not read: they have no effect in
    /// this task.
    pub fn idle(&self, keys: &[&'static str]) -> Vec<Diagnostic> {
        let idle = keys.iter().filter(|k| self.has(k) && !self.taken.borrow().contains(**k));
        let told = |key: &&str| {
            let message = both!("`{key}` says nothing here: nothing in this task depends on it");
            Diagnostic::warning("unused-key", message)
                .at(self.span(key))
                .help(both!("leave it out"))
        };
        idle.map(told).collect()
    }

    /// True if the key is present.
    pub fn has(&self, key: &str) -> bool {
        self.fields.get(key).is_some()
    }

    /// The place of a value, or of the object if the value is missing.
    pub fn span(&self, key: &str) -> Span {
        self.fields.get(key).map_or_else(|| self.fields.span(), |n| n.span)
    }

    /// The value of a required key.
    pub fn need(&self, key: &str, example: &str) -> Option<&'a Node> {
        self.taken.borrow_mut().insert(key.to_owned());
        self.fields.need(key, example, &mut self.faults.borrow_mut())
    }

    /// A length (m).
    pub fn length(&self, key: &str) -> Option<f64> {
        self.length_of(self.node(key)?, key)
    }

    /// A length (m), from any value.
    pub fn length_of(&self, node: &Node, key: &str) -> Option<f64> {
        self.front.si(
            node,
            RequiredQuantity::Length,
            &format!("\"{key}\""),
            &mut self.faults.borrow_mut(),
        )
    }

    /// A length (m) that must be greater than zero.
    pub fn size(&self, key: &str) -> Option<f64> {
        let value = self.length(key)?;
        if value > 0.0 {
            return Some(value);
        }
        let d = Diagnostic::error("not-positive", both!("\"{key}\" must be greater than zero"));
        self.fault(d.at(self.span(key)));
        None
    }

    /// A required length greater than zero (m).
    pub fn need_size(&self, key: &str, example: &str) -> Option<f64> {
        self.need(key, example)?;
        self.size(key)
    }

    /// An angle (rad).
    pub fn angle(&self, key: &str) -> Option<f64> {
        self.angle_of(self.node(key)?, key)
    }

    /// An angle (rad), from any value.
    pub fn angle_of(&self, node: &Node, key: &str) -> Option<f64> {
        self.front.angle(node, &format!("\"{key}\""), &mut self.faults.borrow_mut())
    }

    /// A required angle (rad).
    pub fn need_angle(&self, key: &str, example: &str) -> Option<f64> {
        self.angle_of(self.need(key, example)?, key)
    }

    /// A dimensionless number.
    pub fn number(&self, key: &str) -> Option<f64> {
        self.number_of(self.node(key)?, key)
    }

    /// A number, from any value.
    pub fn number_of(&self, node: &Node, key: &str) -> Option<f64> {
        self.front.number(node, &format!("\"{key}\""), &mut self.faults.borrow_mut())
    }

    /// A dimensionless number or an angle: the value as written, and for an angle whether it is in
    /// degrees.
    pub fn number_or_angle(&self, key: &str) -> Option<(f64, Option<bool>)> {
        self.front.number_or_angle(
            self.node(key)?,
            &format!("\"{key}\""),
            &mut self.faults.borrow_mut(),
        )
    }

    /// A function of a variable.
    pub fn curve(&self, key: &str, variable: &str) -> Option<Curve> {
        self.front.curve(
            self.node(key)?,
            variable,
            &format!("\"{key}\""),
            &mut self.faults.borrow_mut(),
        )
    }

    /// An angular velocity (rad/s).
    pub fn omega(&self, key: &str) -> Option<f64> {
        self.front.si(
            self.node(key)?,
            RequiredQuantity::Omega,
            &format!("\"{key}\""),
            &mut self.faults.borrow_mut(),
        )
    }

    /// An integer within bounds.
    pub fn count(&self, key: &str, least: usize, most: usize) -> Option<usize> {
        let value = self.number(key)?;
        if value.fract() == 0.0 && value >= least as f64 && value <= most as f64 {
            return Some(value as usize);
        }
        let d = Diagnostic::error(
            "out-of-range",
            both!("\"{key}\" is {value}; a whole number from {least} to {most} is wanted"),
        );
        self.fault(d.at(self.span(key)));
        None
    }

    /// A text.
    pub fn word(&self, key: &str) -> Option<Word> {
        word(self.node(key)?, &format!("\"{key}\""), &mut self.faults.borrow_mut())
    }

    /// One of several words.
    pub fn choice(&self, key: &str, known: &[&'static str]) -> Option<&'static str> {
        self.choice_of(self.node(key)?, key, known)
    }

    /// One of several words, from any value.
    pub fn choice_of(
        &self,
        node: &Node,
        key: &str,
        known: &[&'static str],
    ) -> Option<&'static str> {
        let found = word(node, &format!("\"{key}\""), &mut self.faults.borrow_mut())?;
        let one = known.iter().find(|k| **k == found.text).copied();
        if one.is_none() {
            let d = Diagnostic::error("unknown-word", both!("there is no {key} `{}`", found.text))
                .at(found.span);
            self.fault(d.help(suggest(&found.text, known.iter().copied(), both!("known are"))));
        }
        one
    }

    /// A place `[x, y]` (m).
    pub fn point(&self, key: &str) -> Option<Point> {
        self.point_of(self.node(key)?, key)
    }

    /// A place, from any value (m).
    pub fn point_of(&self, node: &Node, key: &str) -> Option<Point> {
        let [x, y] = self.several::<2>(node, key, "[\"10 mm\", \"20 mm\"]")?;
        let (x, y) = (self.length_of(x, key), self.length_of(y, key));
        Some(Point::new(x?, y?))
    }

    /// A list of exactly `N` values.
    pub fn several<const N: usize>(
        &self,
        node: &'a Node,
        key: &str,
        example: &str,
    ) -> Option<[&'a Node; N]> {
        let items = list(node, &format!("\"{key}\""), &mut self.faults.borrow_mut())?;
        let all: Vec<&Node> = items.iter().collect();
        let found = all.len();
        all.try_into().ok().or_else(|| {
            let d = Diagnostic::error(
                "wrong-count",
                both!("\"{key}\" has {N} values here, this has {found}"),
            );
            self.fault(d.at(node.span).help(both!("write {example}")));
            None
        })
    }

    /// The items of a required list of at least `least` values.
    pub fn items(&self, key: &str, example: &str, least: usize) -> Option<&'a [Node]> {
        let node = self.need(key, example)?;
        let items = list(node, &format!("\"{key}\""), &mut self.faults.borrow_mut())?;
        if (least..=MOST).contains(&items.len()) {
            return Some(items);
        }
        let count = items.len();
        let d = Diagnostic::error(
            "wrong-count",
            both!("\"{key}\" has {count} entries; {least} to {MOST} are wanted"),
        );
        self.fault(d.at(node.span));
        None
    }

    /// The places of a required list (m).
    pub fn points(&self, key: &str, example: &str, least: usize) -> Option<Vec<Point>> {
        let found: Vec<Option<Point>> =
            self.items(key, example, least)?.iter().map(|n| self.point_of(n, key)).collect();
        found.into_iter().collect()
    }

    /// A nested object, whose keys must be among these.
    pub fn inner(&self, key: &str, keys: &[&str]) -> Option<TaskForm<'a>> {
        self.object(self.node(key)?, key, keys)
    }

    /// Any value as an object, whose keys must be among these.
    pub fn object(&self, node: &'a Node, key: &str, keys: &[&str]) -> Option<TaskForm<'a>> {
        let fields =
            Fields::open(node, &format!("\"{key}\""), keys, &mut self.faults.borrow_mut())?;
        Some(TaskForm::new(fields, self.front, self.faults))
    }

    /// The named places of a nested object, such as `{"A": [...], "D": [...]}`; all are optional.
    pub fn places(&self, key: &str, names: &[&str]) -> Vec<(String, Point)> {
        let Some(inner) = self.inner(key, names) else { return Vec::new() };
        names.iter().filter_map(|n| Some(((*n).to_owned(), inner.point(n)?))).collect()
    }

    /// Refuses a value of the wrong type.
    pub fn refuse<T>(
        &self,
        node: &Node,
        key: &str,
        wanted: hodograph_base::diag::Both,
    ) -> Option<T> {
        wrong(node, &format!("\"{key}\""), wanted, &mut self.faults.borrow_mut())
    }
}

/// Returns true for a synthesis file: an object with the key `"synthesis"`. Returns false for a
/// file that cannot be read.
pub(crate) fn is_task(root: &Node) -> bool {
    matches!(&root.kind, NodeKind::Object(members) if members.iter().any(|(k, _)| k.text == "synthesis"))
}
