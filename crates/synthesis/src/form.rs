//! The synthesis file as written: an object whose keys are known, whose quantities are read by the machinery of scenes.
//!
//! A [`Form`] interprets nothing; each kind of task takes from it what it needs, and says what is missing with an example. Faults are
//! collected, so that one run shows them all.

use hodograph_base::diag::{Diagnostic, Faults, Span, both};
use hodograph_base::geom::Point;
use hodograph_base::json::fields::{Fields, list, suggest, word, wrong};
use hodograph_base::json::{Kind, Node, Word};
use hodograph_scene::front::{Curve, Front};
use hodograph_scene::units::Wanted;
use std::cell::RefCell;
use std::collections::BTreeSet;

/// More entries of one list are refused: four hundred pairs of angles or points of a path are more than any course design asks for, and
/// they bound the time of the optimisers.
const MOST: usize = 400;

/// An object of the file.
pub(crate) struct Form<'a> {
    fields: Fields<'a>,
    front: &'a Front<'a>,
    faults: &'a RefCell<Faults>,
    /// The keys whose values have been taken.
    taken: RefCell<BTreeSet<String>>,
}

impl<'a> Form<'a> {
    /// An object whose keys have been checked.
    pub fn new(fields: Fields<'a>, front: &'a Front<'a>, faults: &'a RefCell<Faults>) -> Form<'a> {
        Form { fields, front, faults, taken: RefCell::default() }
    }

    /// Adds a fault.
    pub fn fault(&self, d: Diagnostic) {
        self.faults.borrow_mut().push(d);
    }

    /// The value of a key as it stands.
    pub fn node(&self, key: &str) -> Option<&'a Node> {
        self.taken.borrow_mut().insert(key.to_owned());
        self.fields.get(key)
    }

    /// Those of some keys that are there although nothing took them: they say nothing in this task.
    pub fn idle(&self, keys: &[&'static str]) -> Vec<Diagnostic> {
        let idle = keys.iter().filter(|k| self.has(k) && !self.taken.borrow().contains(**k));
        let told = |key: &&str| {
            let message = both!("`{key}` says nothing here: nothing in this task depends on it", "`{key}` 在此不起作用：本题与它无关");
            Diagnostic::warning("unused-key", message).at(self.span(key)).help(both!("leave it out", "请去掉它"))
        };
        idle.map(told).collect()
    }

    /// Whether the key is there.
    pub fn has(&self, key: &str) -> bool {
        self.fields.get(key).is_some()
    }

    /// The place of a value, or of the object where it is missing.
    pub fn span(&self, key: &str) -> Span {
        self.fields.get(key).map_or_else(|| self.fields.span(), |n| n.span)
    }

    /// The value of a key that must be there.
    pub fn need(&self, key: &str, example: &str) -> Option<&'a Node> {
        self.taken.borrow_mut().insert(key.to_owned());
        self.fields.need(key, example, &mut self.faults.borrow_mut())
    }

    /// A length (m).
    pub fn length(&self, key: &str) -> Option<f64> {
        self.length_of(self.node(key)?, key)
    }

    /// A length (m) of any value.
    pub fn length_of(&self, node: &Node, key: &str) -> Option<f64> {
        self.front.si(node, Wanted::Length, &format!("\"{key}\""), &mut self.faults.borrow_mut())
    }

    /// A length (m) that must be greater than zero.
    pub fn size(&self, key: &str) -> Option<f64> {
        let value = self.length(key)?;
        if value > 0.0 {
            return Some(value);
        }
        let d = Diagnostic::error("not-positive", both!("\"{key}\" must be greater than zero", "\"{key}\" 应大于零"));
        self.fault(d.at(self.span(key)));
        None
    }

    /// A length greater than zero that must be there.
    pub fn need_size(&self, key: &str, example: &str) -> Option<f64> {
        self.need(key, example)?;
        self.size(key)
    }

    /// An angle (rad).
    pub fn angle(&self, key: &str) -> Option<f64> {
        self.angle_of(self.node(key)?, key)
    }

    /// An angle (rad) of any value.
    pub fn angle_of(&self, node: &Node, key: &str) -> Option<f64> {
        self.front.angle(node, &format!("\"{key}\""), &mut self.faults.borrow_mut())
    }

    /// An angle that must be there.
    pub fn need_angle(&self, key: &str, example: &str) -> Option<f64> {
        self.angle_of(self.need(key, example)?, key)
    }

    /// A number without a dimension.
    pub fn number(&self, key: &str) -> Option<f64> {
        self.number_of(self.node(key)?, key)
    }

    /// A number of any value.
    pub fn number_of(&self, node: &Node, key: &str) -> Option<f64> {
        self.front.number(node, &format!("\"{key}\""), &mut self.faults.borrow_mut())
    }

    /// A number without a dimension or an angle: as written, and for an angle whether it counts degrees.
    pub fn number_or_angle(&self, key: &str) -> Option<(f64, Option<bool>)> {
        self.front.number_or_angle(self.node(key)?, &format!("\"{key}\""), &mut self.faults.borrow_mut())
    }

    /// A function of a variable.
    pub fn curve(&self, key: &str, variable: &str) -> Option<Curve> {
        self.front.curve(self.node(key)?, variable, &format!("\"{key}\""), &mut self.faults.borrow_mut())
    }

    /// A rate of turning (rad/s).
    pub fn omega(&self, key: &str) -> Option<f64> {
        self.front.si(self.node(key)?, Wanted::Omega, &format!("\"{key}\""), &mut self.faults.borrow_mut())
    }

    /// A whole number within bounds.
    pub fn count(&self, key: &str, least: usize, most: usize) -> Option<usize> {
        let value = self.number(key)?;
        if value.fract() == 0.0 && value >= least as f64 && value <= most as f64 {
            return Some(value as usize);
        }
        let d = Diagnostic::error(
            "out-of-range",
            both!(
                "\"{key}\" is {value}; a whole number from {least} to {most} is wanted",
                "\"{key}\" 为 {value}，应为 {least} 到 {most} 的整数"
            ),
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

    /// One of several words, of any value.
    pub fn choice_of(&self, node: &Node, key: &str, known: &[&'static str]) -> Option<&'static str> {
        let found = word(node, &format!("\"{key}\""), &mut self.faults.borrow_mut())?;
        let one = known.iter().find(|k| **k == found.text).copied();
        if one.is_none() {
            let d = Diagnostic::error("unknown-word", both!("there is no {key} `{}`", "\"{key}\" 没有 `{}`", found.text)).at(found.span);
            self.fault(d.help(suggest(&found.text, known.iter().copied(), both!("known are", "可用的有"))));
        }
        one
    }

    /// A place `[x, y]` (m).
    pub fn point(&self, key: &str) -> Option<Point> {
        self.point_of(self.node(key)?, key)
    }

    /// A place of any value.
    pub fn point_of(&self, node: &Node, key: &str) -> Option<Point> {
        let [x, y] = self.several::<2>(node, key, "[\"10 mm\", \"20 mm\"]")?;
        let (x, y) = (self.length_of(x, key), self.length_of(y, key));
        Some(Point::new(x?, y?))
    }

    /// A list of exactly so many values.
    pub fn several<const N: usize>(&self, node: &'a Node, key: &str, example: &str) -> Option<[&'a Node; N]> {
        let items = list(node, &format!("\"{key}\""), &mut self.faults.borrow_mut())?;
        let all: Vec<&Node> = items.iter().collect();
        let found = all.len();
        all.try_into().ok().or_else(|| {
            let d = Diagnostic::error(
                "wrong-count",
                both!("\"{key}\" has {N} values here, this has {found}", "\"{key}\" 此处应有 {N} 个值，现有 {found} 个"),
            );
            self.fault(d.at(node.span).help(both!("write {example}", "请写 {example}")));
            None
        })
    }

    /// The items of a list that must be there, so many at least.
    pub fn items(&self, key: &str, example: &str, least: usize) -> Option<&'a [Node]> {
        let node = self.need(key, example)?;
        let items = list(node, &format!("\"{key}\""), &mut self.faults.borrow_mut())?;
        if (least..=MOST).contains(&items.len()) {
            return Some(items);
        }
        let count = items.len();
        let d = Diagnostic::error(
            "wrong-count",
            both!("\"{key}\" has {count} entries; {least} to {MOST} are wanted", "\"{key}\" 有 {count} 项，应为 {least} 到 {MOST} 项"),
        );
        self.fault(d.at(node.span));
        None
    }

    /// The places of a list.
    pub fn points(&self, key: &str, example: &str, least: usize) -> Option<Vec<Point>> {
        let found: Vec<Option<Point>> = self.items(key, example, least)?.iter().map(|n| self.point_of(n, key)).collect();
        found.into_iter().collect()
    }

    /// An object inside, whose keys must be among these.
    pub fn inner(&self, key: &str, keys: &[&str]) -> Option<Form<'a>> {
        self.object(self.node(key)?, key, keys)
    }

    /// Any value as an object, whose keys must be among these.
    pub fn object(&self, node: &'a Node, key: &str, keys: &[&str]) -> Option<Form<'a>> {
        let fields = Fields::open(node, &format!("\"{key}\""), keys, &mut self.faults.borrow_mut())?;
        Some(Form::new(fields, self.front, self.faults))
    }

    /// The named places of an object inside, such as `{"A": [...], "D": [...]}`, of which none must be there.
    pub fn places(&self, key: &str, names: &[&str]) -> Vec<(String, Point)> {
        let Some(inner) = self.inner(key, names) else { return Vec::new() };
        names.iter().filter_map(|n| Some(((*n).to_owned(), inner.point(n)?))).collect()
    }

    /// Refuses a value of the wrong type.
    pub fn refuse<T>(&self, node: &Node, key: &str, wanted: hodograph_base::diag::Both) -> Option<T> {
        wrong(node, &format!("\"{key}\""), wanted, &mut self.faults.borrow_mut())
    }
}

/// Whether a file is a synthesis file: an object with that key. What cannot be read is none.
pub(crate) fn is_task(root: &Node) -> bool {
    matches!(&root.kind, Kind::Object(members) if members.iter().any(|(k, _)| k.text == "synthesis"))
}
