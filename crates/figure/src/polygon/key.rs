//! The key of a crowded polygon: names of vectors that find no place beside their lines are listed
//! below the drawing, each with the letters at the ends of its vector.
//!
//! This module decides when a polygon has a key, and which names it lists.

use hodograph_base::geom::Point;
use hodograph_paper::paper::drawing::{Drawing, DrawingPart, id};
use hodograph_paper::paper::grid::{self, Cell, Row};
use hodograph_paper::paper::item::Anchor;
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::style::Style;

use super::inset::Inset;
use super::names::PointLetter;
use super::{PolygonArrow, PolygonDraft, is_one};

/// With at least this many names on leader lines, a polygon has a key instead.
pub(super) const LEADERS: usize = 4;
/// Above this number of vectors, no page holds all names: they are listed without a trial.
const LISTED_AT_ONCE: usize = 30;
/// Distance from the drawing to the key, and between its columns.
const APART_MM: [f64; 2] = [3.0, 6.0];
/// A key may be as wide as this below a narrow drawing.
const USUAL_MM: f64 = 110.0;
/// Insets in place of leader lines make no drawing wider than this.
const WIDEST_MM: f64 = 130.0;
/// Row height, in type sizes.
const LEADING: f64 = 1.4;

/// The place that the name of a vector found.
#[derive(Clone, Copy, PartialEq)]
enum FoundPlace {
    Beside,
    Led,
    Nowhere,
}

impl PolygonDraft<'_> {
    /// Places all names: in the drawing, in insets, and in a key where many have leader lines if the
    /// drawing is then at most `key_mm` wide. `done` finishes a drawing.
    pub(super) fn named(
        &mut self,
        style: &Style,
        key_mm: Option<f64>,
        done: &dyn Fn(Drawing) -> DrawingPart,
    ) -> DrawingPart {
        let lettered: Vec<usize> =
            (0..self.arrows.len()).filter(|k| self.is_lettered(*k)).collect();
        if self.arrows.len() > LISTED_AT_ONCE {
            self.listed = lettered;
            let insets = self.insets(|k| self.listed.contains(&k));
            return self.keyed(style, done(self.draw(style, &insets).0));
        }
        let (drawing, names) = self.draw(style, &[]);
        let part = done(drawing);
        let left_out = part.left_out.clone();
        let unnamed = |arrow: usize| left_out.contains(&names[arrow]);
        let insets = self.insets(unnamed);
        let part = if insets.is_empty() { part } else { done(self.draw(style, &insets).0) };
        let led = |k: &&usize| self.found(**k, &part, &insets) == FoundPlace::Led;
        let Some(key_mm) = key_mm.filter(|_| lettered.iter().filter(led).count() >= LEADERS) else {
            return part;
        };
        let keyed = self.with_key(style, &part, &lettered, &insets, done);
        if keyed.bounds.width_mm() <= key_mm { keyed } else { part }
    }

    /// Places the names that have leader lines in `part`, a drawing with these insets: in further
    /// insets, or in a key.
    fn with_key(
        &mut self,
        style: &Style,
        part: &DrawingPart,
        lettered: &[usize],
        insets: &[Inset],
        done: &dyn Fn(Drawing) -> DrawingPart,
    ) -> DrawingPart {
        // Insets also name vectors that leader lines named, if the drawing becomes no larger.
        let most_mm = [part.bounds.width_mm().max(WIDEST_MM), part.bounds.height_mm()];
        let more = self.insets(|k| self.found(k, part, insets) != FoundPlace::Beside);
        for further in [&more[..], insets] {
            let (inside, outside): (Vec<usize>, Vec<usize>) = lettered
                .iter()
                .copied()
                .partition(|k| further.iter().any(|inset| inset.arrows.contains(k)));
            let listed =
                outside.into_iter().filter(|k| self.found(*k, part, insets) != FoundPlace::Beside);
            self.listed = listed.collect();
            let tried = done(self.draw(style, further).0);
            let size_mm = [tried.bounds.width_mm(), tried.bounds.height_mm()];
            if (0..2).any(|k| size_mm[k] > most_mm[k]) {
                continue;
            }
            let missing = |k: &usize| self.found(*k, &tried, further) != FoundPlace::Beside;
            let unplaced: Vec<usize> = inside.into_iter().filter(missing).collect();
            if unplaced.is_empty() {
                return self.keyed(style, tried);
            }
            self.listed.extend(unplaced);
            self.listed.sort_unstable();
            return self.keyed(style, done(self.draw(style, further).0));
        }
        self.keyed(style, done(self.draw(style, insets).0))
    }

    /// The place of a vector's name in a drawing with these insets.
    fn found(&self, arrow: usize, part: &DrawingPart, insets: &[Inset]) -> FoundPlace {
        let inset = insets.iter().any(|inset| inset.arrows.contains(&arrow));
        let within = if inset { "label-inset" } else { "label" };
        let name = id(self.p.on.word(), &format!("{within}-{}", self.arrows[arrow].key()));
        let leader = format!("{name}-leader");
        if part.left_out.contains(&name) {
            FoundPlace::Nowhere
        } else if part.items.iter().any(|i| i.id == leader) {
            FoundPlace::Led
        } else {
            FoundPlace::Beside
        }
    }

    /// The drawing without the listed names, and the key below it.
    fn keyed(&self, style: &Style, mut part: DrawingPart) -> DrawingPart {
        if self.listed.is_empty() {
            return part;
        }
        let mut key = self.key(style, part.bounds.width_mm().max(USUAL_MM));
        let left = part.bounds.centre().x - key.bounds.width_mm() / 2.0;
        key.stand_at(Point::new(left, part.bounds.min.y - APART_MM[0]));
        part.bounds = part.bounds.union(key.bounds);
        part.items.extend(key.items);
        part
    }

    /// True if both ends of a vector have letters, which name it.
    fn is_lettered(&self, arrow: usize) -> bool {
        let a = &self.arrows[arrow];
        [a.from, a.to].into_iter().all(|p| self.letters.iter().any(|l| is_one(l.at, p)))
    }

    /// The letters at the ends of a vector; among those at its tip, the one that marks its own end.
    fn ends(&self, a: &PolygonArrow) -> [&str; 2] {
        let at = |p: Point| self.letters.iter().filter(move |l| is_one(l.at, p));
        let marks = |l: &&PointLetter| {
            a.symbols.iter().any(|n| l.key == n.key || l.key == n.key.replacen("abs", "image", 1))
        };
        let tip = at(a.to).find(marks).or_else(|| at(a.to).next());
        [at(a.from).next(), tip].map(|l| l.map_or("", |l| &l.name))
    }

    /// The listed names in as many columns as this width holds, at least one.
    fn key(&self, style: &Style, width_mm: f64) -> DrawingPart {
        let (word, size_mm) = (self.p.on.word(), style.small_mm);
        let cell = |text: Label, class: String, name: &str| Cell {
            label: text.in_fonts(&style.fonts),
            size_mm,
            anchor: Anchor::Start,
            class: format!("{word} key{class}"),
            id: id(word, name),
        };
        let entry = |k: &usize| {
            let a = &self.arrows[*k];
            let ends = self.ends(a);
            let class = a.steps.iter().fold(String::new(), |c, step| format!("{c} step-{step}"));
            let name = Label::math(format!("{}:\\quad {}{}", a.name(), ends[0], ends[1]));
            cell(name, class, &format!("key-{}", a.key()))
        };
        let entries: Vec<Cell> = self.listed.iter().map(entry).collect();
        let rows = |columns: usize| {
            let high = entries.len().div_ceil(columns);
            let row = |k: usize| Row {
                cells: (0..columns).map(|c| entries.get(c * high + k).cloned()).collect(),
                height_mm: size_mm * LEADING,
            };
            DrawingPart::of(grid::set(&(0..high).map(row).collect::<Vec<_>>(), APART_MM[1]))
        };
        let fits = |columns: &usize| rows(*columns).bounds.width_mm() <= width_mm;
        let columns = (1..=entries.len()).rev().find(fits).unwrap_or(1);
        rows(columns)
    }
}
