//! One drawing over all frames: its elements, the frames in which each is seen, and the numbers
//! that change.
//!
//! The markup comes from the SVG writer, and this module looks only at the numbers in it. Any
//! figure can therefore move. Items of two frames are one element if their names, their texts and
//! their markup without the numbers agree.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use crate::diag::Faults;
use crate::paper::arrow::{ArrowHead, HEAD_PART_MAX};
use crate::paper::item::{FigureItem, Shape};
use crate::paper::label::Label;
use crate::render::svg::Elements;

use super::pack;

/// Attributes whose numbers are coordinates.
const GEOMETRY: [&str; 9] = ["x1", "y1", "x2", "y2", "cx", "cy", "r", "d", "transform"];
/// Resolution of the numbers, in parts of a millimetre. Rounding to it is a quarter of the 0.01 mm
/// by which the page may be off, and the third differences of a smooth column take one character
/// each.
pub const UNIT: f64 = 200.0;

/// An element.
struct TrackElement {
    /// Its markup in the scene's own pose, or where it is first seen.
    markup: String,
    /// True if it is seen in the scene's own pose.
    at_base: bool,
    /// Its numbers in each frame; `None` where it is not seen.
    frames: Vec<Option<Vec<i64>>>,
    /// The head of a straight arrow: the page draws shaft and head anew between the ends.
    head: Option<ArrowHead>,
}

/// The numbers of an arrow's markup: ends of the shaft (x, x, y, y), then the corners of the head,
/// the tip first.
const ARROW: usize = 12;
/// Indices of the coordinates of the two ends: x and y.
const ENDS: [usize; 4] = [0, 2, 4, 5];

/// A drawing under construction.
pub struct DrawingTrack {
    /// The writer of the elements; it records the letters that they use.
    pub elements_of: Elements,
    base: usize,
    count: usize,
    order: Vec<usize>,
    elements: Vec<TrackElement>,
    known: HashMap<(String, String, String, Vec<usize>), usize>,
}

/// A drawing as data for the page.
pub struct TrackOutput {
    /// The elements' markup, from back to front; those not seen in the scene's own pose are hidden.
    pub markup: String,
    /// For each element that changes: its index, the runs of frames in which it is seen (seen, not
    /// seen, seen …), which numbers of which attributes of which part change, and those numbers.
    pub moving: Vec<serde_json::Value>,
}

impl DrawingTrack {
    /// A drawing on a paper of this height, over this number of frames; `base` is the frame of the
    /// scene's own pose.
    pub fn new(height_mm: f64, base: usize, count: usize) -> DrawingTrack {
        DrawingTrack {
            elements_of: Elements::new(height_mm),
            base,
            count,
            order: Vec::new(),
            elements: Vec::new(),
            known: HashMap::new(),
        }
    }

    /// Adds the items of a frame, in any order of frames. `drawn` distinguishes drawings: a polygon
    /// by another plan or with another special point is a different drawing, and the page does not
    /// interpolate between the two.
    ///
    /// # Errors
    /// Those of the SVG writer.
    pub fn add(
        &mut self,
        frame: usize,
        items: &[FigureItem],
        drawn: &[usize],
    ) -> Result<(), Faults> {
        // Blank labels have the same places; the outlines of letters are not needed in every frame.
        let blank: Vec<FigureItem> = items.iter().map(blank).collect();
        let mut after = None;
        for (item, text) in items.iter().zip(self.elements_of.of(&blank)?) {
            let (form, numbers) = taken_apart(&text);
            let key = (item.id.clone(), source(item).to_owned(), form, drawn.to_vec());
            let index = match self.known.get(&key) {
                Some(&index) => index,
                None => {
                    let index = self.elements.len();
                    let place = after
                        .and_then(|a| self.order.iter().position(|e| *e == a))
                        .map_or(0, |p| p + 1);
                    self.order.insert(place, index);
                    let markup = self.markup(item)?;
                    let mut head = None;
                    if let Shape::Arrow { head: of, .. } = item.shape
                        && numbers.len() == ARROW
                    {
                        head = Some(of);
                    }
                    self.elements.push(TrackElement {
                        markup,
                        at_base: false,
                        frames: vec![None; self.count],
                        head,
                    });
                    self.known.insert(key, index);
                    index
                }
            };
            if frame == self.base {
                self.elements[index].markup = self.markup(item)?;
                self.elements[index].at_base = true;
            }
            self.elements[index].frames[frame] = Some(numbers);
            after = Some(index);
        }
        Ok(())
    }

    /// The markup of an item; items of a link carry the link's number, so that a step can highlight
    /// it.
    fn markup(&mut self, item: &FigureItem) -> Result<String, Faults> {
        let text = self.elements_of.of(std::slice::from_ref(item))?.concat();
        Ok(match item.link {
            Some(link) if item.class.starts_with("mechanism") => {
                with(&text, &format!("data-l=\"{link}\""))
            }
            _ => text,
        })
    }

    /// The drawing for the page. `at_once`: true if it is seen before the script runs; otherwise
    /// the moving numbers are given once, with the moving elements, and not in the markup too.
    pub fn output(&self, at_once: bool) -> TrackOutput {
        let mut told = TrackOutput { markup: String::new(), moving: Vec::new() };
        // Vectors share end points, and bars share joints: columns that move alike are stored once.
        let mut columns_told: HashMap<(Vec<usize>, Vec<i64>), usize> = HashMap::new();
        for (place, element) in self.order.iter().map(|e| &self.elements[*e]).enumerate() {
            let seen: Vec<&Vec<i64>> = element.frames.iter().flatten().collect();
            let changing: Vec<usize> =
                (0..seen[0].len()).filter(|n| seen.iter().any(|f| f[*n] != seen[0][*n])).collect();
            let arrow = element.head.filter(|_| !changing.is_empty());
            let markup = if element.at_base && at_once {
                element.markup.clone()
            } else {
                let all: Vec<usize> = (0..seen[0].len()).collect();
                without(&element.markup, if arrow.is_some() { &all } else { &changing })
            };
            told.markup.push_str(&if element.at_base { markup } else { hidden(&markup) });
            told.markup.push('\n');
            if changing.is_empty() && seen.len() == element.frames.len() {
                continue;
            }
            let changing = if arrow.is_some() { ENDS.to_vec() } else { changing };
            let runs = runs(element.frames.iter().map(Option::is_some));
            let mut columns = String::new();
            for n in &changing {
                let column: Vec<i64> = seen.iter().map(|f| f[*n]).collect();
                let next = columns_told.len();
                match columns_told.entry((runs.clone(), column)) {
                    Entry::Occupied(earlier) => pack::same(*earlier.get(), &mut columns),
                    Entry::Vacant(first) => {
                        pack::column(&first.key().1, &mut columns);
                        first.insert(next);
                    }
                }
            }
            let parts = match arrow {
                Some(ArrowHead { length_mm, width_mm, notch }) => {
                    vec![format!("0 arrow {length_mm} {width_mm} {notch} {HEAD_PART_MAX}")]
                }
                None => places(&element.markup, &changing),
            };
            told.moving.push(serde_json::json!([place, runs, parts, columns]));
        }
        told
    }
}

/// Lengths of the runs of frames in which something is seen, not seen, seen …; empty where it is
/// seen in all.
pub fn runs(frames: impl IntoIterator<Item = bool>) -> Vec<usize> {
    let mut runs = vec![0];
    let mut seen = true;
    for f in frames {
        if f != seen {
            runs.push(0);
            seen = !seen;
        }
        *runs.last_mut().expect("there is a run") += 1;
    }
    if runs.len() == 1 { Vec::new() } else { runs }
}

fn source(item: &FigureItem) -> &str {
    if let Shape::Label { label, .. } = &item.shape { label.source() } else { "" }
}

fn blank(item: &FigureItem) -> FigureItem {
    let mut item = item.clone();
    if let Shape::Label { label, anchor, at, size_mm, .. } = &mut item.shape {
        // The writer places a label by its left end.
        let width = crate::paper::text::set(label).width_em;
        at.x -= crate::paper::extent::anchor_shift_em(*anchor, width) * *size_mm;
        *anchor = crate::paper::item::Anchor::Start;
        *label = Label::text("");
    }
    item
}

fn hidden(markup: &str) -> String {
    with(markup, "display=\"none\"")
}

/// An element with one more attribute.
fn with(markup: &str, attribute: &str) -> String {
    let end = markup.find([' ', '>', '/']).unwrap_or(markup.len());
    format!("{} {attribute}{}", &markup[..end], &markup[end..])
}

/// An attribute of an element, or of one of the elements in it.
struct Attribute<'a> {
    /// The index of the element, in the order of the markup.
    part: usize,
    name: &'a str,
    value: &'a str,
}

/// The attributes of markup by the SVG writer, which has no text between elements and no quotation
/// marks in values.
fn attributes(markup: &str) -> Vec<Attribute<'_>> {
    let mut part = 0;
    let mut begun = false;
    let mut list = Vec::new();
    let mut pieces = markup.split('"');
    while let Some(before) = pieces.next() {
        let opened =
            before.match_indices('<').filter(|(i, _)| !before[i + 1..].starts_with('/')).count();
        if opened > 0 {
            part += opened - usize::from(!begun);
            begun = true;
        }
        let (Some(name), Some(value)) = (before.rsplit([' ', '<']).next(), pieces.next()) else {
            break;
        };
        list.push(Attribute { part, name: name.trim_end_matches('='), value });
    }
    list
}

/// The numbers of an attribute's value: where each begins and ends. Flags of arcs are not
/// coordinates.
fn numerals(value: &str) -> Vec<(usize, usize)> {
    let bytes = value.as_bytes();
    let mut list = Vec::new();
    let mut command = b' ';
    let mut since = 0;
    let mut i = 0;
    while i < bytes.len() {
        let numeral = bytes[i].is_ascii_digit() || bytes[i] == b'-';
        if !numeral {
            if bytes[i].is_ascii_alphabetic() {
                (command, since) = (bytes[i], 0);
            }
            i += 1;
            continue;
        }
        let start = i;
        i += 1;
        while i < bytes.len() && (bytes[i].is_ascii_digit() || bytes[i] == b'.') {
            i += 1;
        }
        // Rotation, large-arc and sweep flag.
        if !(command == b'A' && (2..5).contains(&since)) {
            list.push((start, i));
        }
        since += 1;
    }
    list
}

/// Markup without its numbers, and the numbers.
fn taken_apart(markup: &str) -> (String, Vec<i64>) {
    let mut form = String::with_capacity(markup.len());
    let mut numbers = Vec::new();
    for a in attributes(markup) {
        form.push_str(&format!("{} {}=", a.part, a.name));
        if !GEOMETRY.contains(&a.name) {
            form.push_str(a.value);
            continue;
        }
        let mut from = 0;
        for (start, end) in numerals(a.value) {
            form.push_str(&a.value[from..start]);
            form.push('#');
            numbers.push((a.value[start..end].parse::<f64>().unwrap_or(0.0) * UNIT).round() as i64);
            from = end;
        }
        form.push_str(&a.value[from..]);
    }
    (form, numbers)
}

/// Markup with a zero for each of these numbers.
fn without(markup: &str, numbers: &[usize]) -> String {
    let mut out = String::with_capacity(markup.len());
    let (mut done, mut n) = (0, 0);
    for a in attributes(markup).iter().filter(|a| GEOMETRY.contains(&a.name)) {
        let from = a.value.as_ptr() as usize - markup.as_ptr() as usize;
        for (start, end) in numerals(a.value) {
            if numbers.contains(&n) {
                out.push_str(&markup[done..from + start]);
                // A single sign may have separated two numbers.
                out.push_str(if out.ends_with(|c: char| c.is_ascii_digit()) { " 0" } else { "0" });
                done = from + end;
            }
            n += 1;
        }
    }
    out.push_str(&markup[done..]);
    out
}

/// The places of the changing numbers: `part attribute numeral …`, one string for each attribute.
fn places(markup: &str, changing: &[usize]) -> Vec<String> {
    let mut list: Vec<String> = Vec::new();
    let mut n = 0;
    for a in attributes(markup).iter().filter(|a| GEOMETRY.contains(&a.name)) {
        let count = numerals(a.value).len();
        let mine: Vec<String> =
            (0..count).filter(|k| changing.contains(&(n + k))).map(|k| k.to_string()).collect();
        if !mine.is_empty() {
            list.push(format!("{} {} {}", a.part, a.name, mine.join(" ")));
        }
        n += count;
    }
    list
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::paper::item::LineStroke;

    #[test]
    fn markup_is_taken_apart() {
        let (form, numbers) = taken_apart(
            "<g id=\"v3\"><line x1=\"-1.5\" y1=\"2\"/>\n<path d=\"M0 1A3 3 0 0 1 4 5.25Z\"/></g>",
        );
        assert_eq!(form, "0 id=v31 x1=#1 y1=#2 d=M# #A# # 0 0 1 # #Z");
        assert_eq!(numbers, [-300, 400, 0, 200, 600, 600, 800, 1050]);
    }

    #[test]
    fn numbers_that_are_told_elsewhere_are_left_out() {
        let markup =
            "<g id=\"v3\"><line x1=\"-1.5\" y1=\"2\"/><path d=\"M0 1A3 3 0 0 1 4-5.25Z\"/></g>";
        let left = without(markup, &[0, 6, 7]);
        assert_eq!(
            left,
            "<g id=\"v3\"><line x1=\"0\" y1=\"2\"/><path d=\"M0 1A3 3 0 0 1 0 0Z\"/></g>"
        );
        assert_eq!(taken_apart(&left).1.len(), taken_apart(markup).1.len());
    }

    #[test]
    fn an_element_that_comes_and_goes() {
        let line = |id: &str, x: f64| {
            FigureItem::new(
                "link",
                Shape::Line {
                    from: Point::ORIGIN,
                    to: Point::new(x, 3.0),
                    stroke: LineStroke::new(0.5),
                },
            )
            .with_id(id)
        };
        let mut track = DrawingTrack::new(10.0, 0, 3);
        track.add(0, &[line("a", 1.0), line("c", 1.0)], &[]).unwrap();
        track.add(1, &[line("a", 2.0), line("b", 5.0), line("c", 1.0)], &[]).unwrap();
        track.add(2, &[line("a", 3.0), line("c", 1.0)], &[]).unwrap();
        let told = track.output(true);
        let ids: Vec<usize> =
            ["\"a\"", "\"b\"", "\"c\""].iter().map(|id| told.markup.find(id).unwrap()).collect();
        assert!(
            ids.is_sorted() && told.markup.contains("<line display=\"none\""),
            "{}",
            told.markup
        );
        assert_eq!(told.moving.len(), 2);
        assert_eq!(
            (&told.moving[0][0], &told.moving[0][2]),
            (&0.into(), &serde_json::json!(["0 x2 0"]))
        );
        assert_eq!(
            (&told.moving[1][0], &told.moving[1][1]),
            (&1.into(), &serde_json::json!([0, 1, 1, 1]))
        );
    }
}
