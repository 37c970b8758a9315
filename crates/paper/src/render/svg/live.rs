//! A document that is kept while its figure is drawn again, and the changes from one to the next.

use std::collections::HashMap;

use ::svg::node::Blob;

use super::{SvgWriter, mm, root, with_letters};
use crate::paper::extent::anchor_shift_em;
use crate::paper::item::{Figure, FigureItem, Shape};
use crate::paper::text;
use hodograph_base::diag::{Diagnostic, Faults};

/// The changes from one document to the next.
///
/// The elements are the children of the root after the definitions, one for each item of the
/// figure, counted from 0. Applied in the order of the fields (elements removed, then added, then
/// changed and moved), the changes make the next document of the earlier one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Delta {
    /// Width and height (mm) for the root's `width`, `height` and `viewBox`, if they change.
    pub size_mm: Option<[f64; 2]>,
    /// The content of the root's `desc`, if it changes.
    pub desc: Option<String>,
    /// The markup of the root's `defs` with the outlines of all letters, if there are new ones.
    pub letters: Option<String>,
    /// The numbers in the earlier document of the elements to remove, the last first.
    pub removed: Vec<usize>,
    /// The elements to insert, with their numbers in the next document, the first first.
    pub added: Vec<(usize, String)>,
    /// The numbers in the next document of elements with new markup.
    pub changed: Vec<(usize, String)>,
    /// The numbers in the next document of elements with only a new `transform`, with its value.
    pub moved: Vec<(usize, String)>,
    /// Remarks on the new elements, such as a letter that no font has.
    pub notes: Vec<Diagnostic>,
}

/// A figure with the markup of its elements.
pub struct LiveFigure {
    figure: Figure,
    markup: Vec<String>,
    /// Number of letters that the document defines.
    letters: usize,
    /// The letters of all figures so far.
    writer: SvgWriter,
}

/// The next state of a [`LiveFigure`].
pub struct PreparedFigure {
    figure: Figure,
    markup: Vec<String>,
    delta: Delta,
}

impl LiveFigure {
    /// Returns an empty document for a first figure; written there, its document is that of
    /// [`super::write()`].
    pub fn blank(figure: &Figure) -> LiveFigure {
        let writer = SvgWriter { data: true, ..SvgWriter::new(figure.height_mm) };
        let blank = Figure { items: Vec::new(), ..figure.clone() };
        LiveFigure { figure: blank, markup: Vec::new(), letters: 0, writer }
    }

    /// Writes the next figure without replacing this one. Items with the same id, or without one
    /// with the same class, are one element as long as their order is kept.
    ///
    /// # Errors
    /// As [`super::write()`].
    pub fn prepare(&mut self, next: Figure) -> Result<PreparedFigure, Faults> {
        root(&next)?;
        let same_paper = self.figure.height_mm == next.height_mm;
        self.writer.height_mm = next.height_mm;
        let mut delta = Delta::default();
        let kept = kept(&self.figure.items, &next.items);
        let mut stays = vec![false; self.markup.len()];
        kept.iter().flatten().for_each(|&old| stays[old] = true);
        delta.removed = (0..stays.len()).rev().filter(|k| !stays[*k]).collect();
        let mut markup = Vec::with_capacity(next.items.len());
        for (k, (item, old)) in next.items.iter().zip(kept).enumerate() {
            let earlier = old.map(|old| (&self.figure.items[old], &self.markup[old]));
            if let Some((one, text)) = earlier {
                if same_paper && one == item {
                    markup.push(text.clone());
                    continue;
                }
                if item.is_finite()
                    && let Some(there) = moved(one, item)
                    && let Some((head, place, tail)) = transform(text)
                {
                    let place = self.writer.moved_to(place, there);
                    markup.push(format!("{head}{place}{tail}"));
                    if markup.last() != Some(text) {
                        delta.moved.push((k, place));
                    }
                    continue;
                }
            }
            let text = self.writer.finite(item).map(|node| node.to_string()).unwrap_or_default();
            match earlier {
                Some((_, before)) if *before == text => {}
                Some(_) => delta.changed.push((k, text.clone())),
                None => delta.added.push((k, text.clone())),
            }
            markup.push(text);
        }
        let faults = std::mem::take(&mut self.writer.faults);
        if faults.has_errors() {
            return Err(faults);
        }
        delta.notes = faults.list;
        if !delta.added.is_empty() || !delta.changed.is_empty() {
            delta.notes.extend(next.remarks());
        }
        let size = |f: &Figure| [f.width_mm, f.height_mm];
        delta.size_mm = Some(size(&next)).filter(|new| *new != size(&self.figure));
        delta.desc = Some(&next.desc).filter(|new| **new != self.figure.desc).cloned();
        if self.writer.letters.len() > self.letters {
            delta.letters = Some(self.writer.definitions().to_string());
        }
        Ok(PreparedFigure { figure: next, markup, delta })
    }

    /// Replaces the figure; returns the changes of the document.
    pub fn show(&mut self, next: PreparedFigure) -> Delta {
        self.letters = self.writer.letters.len();
        (self.figure, self.markup) = (next.figure, next.markup);
        next.delta
    }

    /// Returns the whole document.
    pub fn svg(&self) -> String {
        // Its numbers are finite, or it would not have been accepted.
        let Ok(mut document) = root(&self.figure) else { return String::new() };
        if !self.writer.letters.is_empty() {
            document = with_letters(document, self.writer.definitions());
        }
        for element in &self.markup {
            document = document.add(Blob::new(element.as_str()));
        }
        format!("{document}\n")
    }
}

/// The id of an item, or its class where it has none.
fn word(item: &FigureItem) -> &str {
    if item.id.is_empty() { &item.class } else { &item.id }
}

/// For each of the next items the index of the earlier one with its id or class, in one order.
fn kept(items: &[FigureItem], next: &[FigureItem]) -> Vec<Option<usize>> {
    if items.len() == next.len() && items.iter().zip(next).all(|(a, b)| word(a) == word(b)) {
        return (0..next.len()).map(Some).collect();
    }
    let places: HashMap<(&str, usize), usize> =
        names(items).into_iter().enumerate().map(|(k, name)| (name, k)).collect();
    let mut from = 0;
    let mut kept = vec![None; next.len()];
    for (k, name) in names(next).into_iter().enumerate() {
        let Some(&old) = places.get(&name).filter(|old| **old >= from) else { continue };
        (kept[k], from) = (Some(old), old + 1);
    }
    kept
}

/// The name of each item, with the number of those before it that are alike.
fn names(items: &[FigureItem]) -> Vec<(&str, usize)> {
    let mut counts: HashMap<&str, usize> = HashMap::new();
    let named = |item| {
        let count = counts.entry(word(item)).or_default();
        *count += 1;
        (word(item), *count)
    };
    items.iter().map(named).collect()
}

/// The place of the left end of a label that differs from an earlier one only by its place.
fn moved(one: &FigureItem, item: &FigureItem) -> Option<[f64; 2]> {
    let FigureItem { id, class, link, shown, shape } = item;
    let Shape::Label { at, label, size_mm, anchor, colour } = shape else { return None };
    let Shape::Label { at: _, label: text, size_mm: size, anchor: side, colour: ink } = &one.shape
    else {
        return None;
    };
    let is_alike = (text, size, side, ink) == (label, size_mm, anchor, colour)
        && (&one.id, &one.class, &one.link, &one.shown) == (id, class, link, shown);
    let left = || at.x - anchor_shift_em(*anchor, text::set(label).width_em) * size_mm;
    is_alike.then(|| [left(), at.y])
}

/// Markup divided about the value of its first `transform`.
fn transform(markup: &str) -> Option<(&str, &str, &str)> {
    const NAME: &str = " transform=\"";
    let start = markup.find(NAME)? + NAME.len();
    let end = start + markup[start..].find('"')?;
    Some((&markup[..start], &markup[start..end], &markup[end..]))
}

impl SvgWriter {
    /// Returns a label's transformation with its line at another place.
    fn moved_to(&self, transform: &str, [x, y]: [f64; 2]) -> String {
        let rest = transform.split_once(')').map_or("", |(_, rest)| rest);
        format!("translate({} {}){rest}", mm(x), self.y(y))
    }
}
