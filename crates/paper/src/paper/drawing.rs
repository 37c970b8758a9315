//! A part of a sheet while it is built: its items, the obstacles of its labels, and the labels to
//! be placed.
//!
//! This module gives every item a unique name and places the labels once, after all lines are
//! drawn. It does not decide what is drawn or the position of the part on the sheet.

use std::collections::{BTreeMap, HashMap, HashSet};

use hodograph_base::diagram::DiagramKind;
use hodograph_base::geom::{Point, Vec2};

use super::broken::break_at;
use super::extent::{Rect, bounds, translate};
use super::item::{COARSE, FigureItem, PLACED, Shape, tag};
use super::label::Label;
use super::place::{
    Habit, LabelRequest, LeaderReach, Obstacles, Placement, Target, is_coarse, place_or_leave,
};
use super::shown::{ShownQuantity, escaped};
use super::style::Style;

/// Margin around the lines of a part in which its labels may be placed: the longest leader line and
/// a short label.
const LABEL_ROOM_MM: f64 = 20.0;
/// Gap between a line and a label that is wider than [`LABEL_ROOM_MM`].
const LABEL_AIR_MM: f64 = 3.0;

/// Number of names within the height of a letter that still find readable places.
const CROWD: usize = 8;

/// Two points nearer than this coincide.
const SAME_MM: f64 = 0.05;

/// A finished part: its items in local coordinates and their bounding box.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawingPart {
    /// The items to draw.
    pub items: Vec<FigureItem>,
    /// The bounding box of all ink.
    pub bounds: Rect,
    /// The places of the labels and their costs.
    pub placements: Vec<Placement>,
    /// The names of optional labels that found no clear place.
    pub left_out: Vec<String>,
}

impl DrawingPart {
    /// Returns a part of finished items; an empty part has no size.
    pub fn of(items: Vec<FigureItem>) -> DrawingPart {
        let bounds = bounds(&items).unwrap_or(Rect::new(Point::ORIGIN, Point::ORIGIN));
        DrawingPart { items, bounds, placements: Vec::new(), left_out: Vec::new() }
    }

    /// Moves the part so that the upper left corner of its box is at `corner`.
    pub fn stand_at(&mut self, corner: Point) {
        let by = corner - Point::new(self.bounds.min.x, self.bounds.max.y);
        self.translate(by);
    }

    /// Moves the part.
    pub fn translate(&mut self, by: Vec2) {
        translate(&mut self.items, by);
        self.bounds = Rect::new(self.bounds.min + by, self.bounds.max + by);
        for p in &mut self.placements {
            p.at = p.at + by;
            p.bounds = Rect::new(p.bounds.min + by, p.bounds.max + by);
        }
    }
}

/// The place of each label, by name, in the previous figure, or the fact that it was left out.
pub type Habits = BTreeMap<String, Habit>;

/// A part while it is built.
#[derive(Debug)]
pub struct Drawing {
    kind: &'static str,
    style: Style,
    items: Vec<FigureItem>,
    obstacles: Obstacles,
    wanted: Vec<PendingLabel>,
    names: HashSet<String>,
    /// For each requested name, the highest number already in use.
    counts: HashMap<String, usize>,
    owners: u32,
    link: Option<usize>,
    step: Option<usize>,
}

/// A label to be placed.
#[derive(Debug)]
struct PendingLabel {
    request: LabelRequest,
    id: String,
    class: String,
    link: Option<usize>,
}

impl Drawing {
    /// Returns an empty drawing; `kind` is the first word of every class and name in it.
    pub fn new(kind: &'static str, style: Style) -> Drawing {
        let (obstacles, names, counts) = (Obstacles::default(), HashSet::new(), HashMap::new());
        Drawing {
            kind,
            style,
            items: Vec::new(),
            obstacles,
            wanted: Vec::new(),
            names,
            counts,
            owners: 0,
            link: None,
            step: None,
        }
    }

    /// Assigns the items drawn after this call to a link, or to none.
    pub fn of_link(&mut self, link: Option<usize>) {
        self.link = link;
    }

    /// Assigns the items drawn after this call to a step of the construction, or to none.
    pub fn at_step(&mut self, step: Option<usize>) {
        self.step = step;
    }

    /// Returns the step to which items are assigned.
    pub fn step(&self) -> Option<usize> {
        self.step
    }

    /// Returns a class with its first word and the step.
    fn classed(&self, class: &str) -> String {
        let class = format!("{} {class}", self.kind);
        self.step.map_or_else(|| class.clone(), |k| format!("{class} step-{k}"))
    }

    /// Draws an object of one or more items, named after `name`; returns its owner number for
    /// labels.
    pub fn draw(&mut self, name: &str, class: &str, mut items: Vec<FigureItem>) -> u32 {
        self.owners += 1;
        items = items.into_iter().map(|item| item.in_fonts(&self.style.fonts)).collect();
        tag(&mut items, &self.classed(class).replace("  ", " "));
        self.obstacles.add(&items, Some(self.owners));
        for item in &mut items {
            item.id = self.name(name);
            // Parts of one symbol may belong to different links, as barrel and rod do.
            item.link = item.link.or(self.link);
        }
        self.items.extend(items);
        self.owners
    }

    /// Counts the drawn objects that these items would cross, or approach to less than `air_mm`.
    pub fn met_by(&self, items: &[FigureItem], air_mm: f64) -> usize {
        self.obstacles.met_by(&Obstacles::of(items), air_mm)
    }

    /// Counts the drawn objects that this ink would cross, or approach to less than `air_mm`.
    pub fn met(&self, ink: &Obstacles, air_mm: f64) -> usize {
        self.obstacles.met_by(ink, air_mm)
    }

    /// Returns all obstacles of the labels drawn so far.
    pub fn obstacles(&self) -> &Obstacles {
        &self.obstacles
    }

    /// Returns the bounding box of the items drawn so far.
    pub fn bounds(&self) -> Rect {
        bounds(&self.items).unwrap_or(Rect::new(Point::ORIGIN, Point::ORIGIN))
    }

    /// Draws behind all items drawn before, but in front of the areas of plates, so that it is
    /// visible on them.
    pub fn behind(&mut self, draw: impl FnOnce(&mut Drawing)) {
        let (before, bars) = (self.items.len(), self.obstacles.bars.len());
        draw(self);
        self.obstacles.bars[bars..].iter_mut().for_each(|bar| bar.faint = true);
        let added = self.items.split_off(before);
        // A plate area without an edge was moved to the back by an earlier call.
        let edgeless =
            |i: &FigureItem| matches!(i.shape, Shape::Polyline { stroke: None, fill: Some(_), .. });
        let plate = |i: &FigureItem| i.class.split(' ').any(|word| word == "plate");
        let (mut areas, kept): (Vec<FigureItem>, Vec<FigureItem>) =
            std::mem::take(&mut self.items).into_iter().partition(|i| plate(i) && edgeless(i));
        self.items = kept;
        for item in self.items.iter_mut().filter(|i| plate(i)) {
            let mut area = item.clone();
            if let (Shape::Polyline { stroke, .. }, Shape::Polyline { fill, .. }) =
                (&mut area.shape, &mut item.shape)
                && fill.is_some()
            {
                (*stroke, *fill) = (None, None);
                area.id = format!("{}-area", area.id);
                areas.push(area);
            }
        }
        self.items.splice(..0, areas.into_iter().chain(added));
    }

    /// Draws one item.
    pub fn shape(&mut self, name: &str, class: &str, shape: Shape) -> u32 {
        self.draw(name, class, vec![FigureItem::new("", shape)])
    }

    /// Draws a thin frame around other items: labels may be placed in it, and also across it.
    pub fn frame(&mut self, name: &str, class: &str, shape: Shape) {
        let mut item = FigureItem::new("", shape).with_id(self.name(name));
        tag(std::slice::from_mut(&mut item), &self.classed(class));
        self.items.push(item);
    }

    /// Draws a vector of a quantity.
    pub fn vector(&mut self, name: &str, class: &str, shape: Shape, shown: ShownQuantity) -> u32 {
        self.draw(name, class, vec![FigureItem::new("", shape).showing(shown)])
    }

    /// Names a point without ink, for programs that measure on the drawing.
    ///
    /// The point is a circle of radius zero. Labels may cover it, but no letter of another point is
    /// placed nearer to it than to its own point.
    pub fn mark(&mut self, name: &str, shown: ShownQuantity, at: Point) {
        let shape = Shape::Circle { centre: at, radius_mm: 0.0, stroke: None, fill: None };
        let id = self.name(&format!("mark-{name}"));
        self.items
            .push(FigureItem::new(format!("{} mark", self.kind), shape).with_id(id).showing(shown));
        self.obstacles.marks.push(at);
    }

    /// Requests a label, which is placed when the drawing is finished. Returns its name.
    pub fn label(&mut self, name: &str, class: &str, mut request: LabelRequest) -> String {
        request.label = request.label.in_fonts(&self.style.fonts);
        let id = self.name(&format!("label-{name}"));
        self.wanted.push(PendingLabel {
            request,
            id: id.clone(),
            class: format!("{} {PLACED}", self.classed(class)),
            link: self.link,
        });
        id
    }

    /// Keeps only the letters of points and poles, for a drawing beside one that has all names.
    pub fn letters_only(&mut self) {
        let is_letter = |w: &PendingLabel| {
            w.request.point().is_some()
                && w.class.split(' ').any(|word| matches!(word, "point" | "pole"))
        };
        self.wanted.retain(is_letter);
    }

    /// Keeps only the labels for which `among` accepts the requested name.
    pub fn only_named(&mut self, among: impl Fn(&str) -> bool) {
        let prefix = format!("{}-label-", prefix(self.kind));
        self.wanted.retain(|w| w.id.strip_prefix(&prefix).is_none_or(&among));
    }

    /// Leaves out names in crowded regions, except those at the points in `kept`.
    ///
    /// A region is crowded where more than [`CROWD`] points and short lines are within the height
    /// of a letter: leader lines could not distinguish them.
    pub fn thin_out(&mut self, kept: &[Point]) {
        let small = |w: &PendingLabel| match w.request.target {
            Target::Point { at, .. } => Some((at, w.request.size_mm)),
            Target::Segment { from, to, .. } => (from.distance(to) < w.request.size_mm)
                .then(|| (from + (to - from) * 0.5, w.request.size_mm)),
            Target::Arc { .. } => None,
        };
        let places: Vec<Option<(Point, f64)>> = self.wanted.iter().map(small).collect();
        let near = |at: Point, reach: f64| {
            places.iter().flatten().filter(|(p, _)| p.distance(at) < reach).count()
        };
        let stays = |place: &Option<(Point, f64)>| {
            place.is_none_or(|(at, reach)| {
                near(at, reach) <= CROWD || kept.iter().any(|k| k.distance(at) < SAME_MM)
            })
        };
        let mut staying = places.iter().map(stays);
        self.wanted.retain(|_| staying.next().unwrap_or(true));
    }

    /// Requests a label at a point.
    pub fn label_at(
        &mut self,
        name: &str,
        class: &str,
        text: &str,
        at: Point,
        clear_mm: f64,
        prefer: Option<Vec2>,
    ) {
        let request = LabelRequest::at_point(Label::math(text), self.style.label_mm, at, clear_mm);
        self.label(name, class, LabelRequest { prefer, ..request });
    }

    /// Requests a label along a line that is already drawn.
    pub fn label_along(
        &mut self,
        name: &str,
        class: &str,
        text: &str,
        ends: (Point, Point),
        clear_mm: f64,
        owner: u32,
    ) {
        let request =
            LabelRequest::along(Label::math(text), self.style.label_mm, ends.0, ends.1, clear_mm);
        self.label(name, class, request.owned(owner));
    }

    /// Returns an unused id: `vel-rel-C-B`, then `vel-rel-C-B-2`.
    fn name(&mut self, wish: &str) -> String {
        let base = id(self.kind, wish);
        let taken = self.counts.entry(base.clone()).or_default();
        loop {
            *taken += 1;
            let name = if *taken == 1 { base.clone() } else { format!("{base}-{taken}") };
            if self.names.insert(name.clone()) {
                return name;
            }
        }
    }

    /// Places the labels and returns the finished part.
    pub fn finish(self) -> DrawingPart {
        let room = self.room();
        match self.style.memory.clone() {
            None => self.placed(&mut Habits::new(), room, LeaderReach::Long),
            Some(memory) => memory.next(self.kind, |habits| {
                let reach = if habits.is_empty() { LeaderReach::Short } else { LeaderReach::Kept };
                self.placed(habits, room, reach)
            }),
        }
    }

    /// Places the labels of a drawing in a series and returns the finished part.
    ///
    /// Each label keeps its place from the previous drawing if possible. Updates `habits` with the
    /// places taken.
    pub fn finish_after(self, habits: &mut Habits) -> DrawingPart {
        let room = self.room();
        self.finish_within(habits, room)
    }

    /// Places the labels of a drawing in a series within an area and returns the finished part.
    pub fn finish_within(self, habits: &mut Habits, room: Rect) -> DrawingPart {
        self.placed(habits, room, LeaderReach::Short)
    }

    fn room(&self) -> Rect {
        let widest = self.wanted.iter().map(|w| w.request.width_mm()).fold(0.0, f64::max);
        self.bounds().grown(LABEL_ROOM_MM.max(widest + LABEL_AIR_MM))
    }

    fn placed(mut self, habits: &mut Habits, room: Rect, leads: LeaderReach) -> DrawingPart {
        let requests: Vec<LabelRequest> = self.wanted.iter().map(|w| w.request.clone()).collect();
        self.obstacles.marks.extend(requests.iter().filter_map(LabelRequest::point));
        let (first, coarse) = (habits.is_empty(), is_coarse(requests.len()));
        let before: Vec<Option<Habit>> =
            self.wanted.iter().filter(|_| !first).map(|w| habits.get(&w.id).copied()).collect();
        let placed = place_or_leave(&requests, &self.obstacles, (room, leads), &before);
        if leads == LeaderReach::Long {
            // In a series, breaks would appear and disappear from figure to figure.
            let fixed = self
                .items
                .iter()
                .filter(|i| matches!(i.shape, Shape::Label { .. }))
                .filter_map(FigureItem::bounds);
            let boxes: Vec<Rect> = placed.iter().flatten().map(|p| p.bounds).chain(fixed).collect();
            break_at(&mut self.items, &boxes);
        }
        for (p, w) in placed.iter().zip(&self.wanted) {
            habits.insert(w.id.clone(), p.map_or(Habit::LeftOut, |p| Habit::At(p.index)));
            let Some(p) = p else { continue };
            let class = if coarse {
                w.class.replace(PLACED, &format!("{COARSE} {PLACED}"))
            } else {
                w.class.clone()
            };
            for (k, mut item) in
                p.items(&w.request, &class, self.style.thin).into_iter().rev().enumerate()
            {
                item.link = w.link;
                let id = &w.id;
                if k > 0 {
                    // The leader line appears and disappears with its label, but is not a label.
                    item.class = format!("{} leader", w.class.trim_end_matches(PLACED).trim_end());
                }
                // The label comes first in this order and keeps the name; its leader line is named
                // after it.
                self.items.push(if k == 0 {
                    item.with_id(id.clone())
                } else {
                    item.with_id(format!("{id}-leader"))
                });
            }
        }
        let mut part = DrawingPart::of(self.items);
        part.left_out = placed
            .iter()
            .zip(&self.wanted)
            .filter(|(p, _)| p.is_none())
            .map(|(_, w)| w.id.clone())
            .collect();
        part.placements = placed.into_iter().flatten().collect();
        part
    }
}

/// Returns the id of a drawing's object in the document: `id("velocity", "normal-C-B")` is
/// `vel-normal-C-B`.
///
/// A second object with the same name gets a number at the end. The name consists of words in small
/// letters and of unchanged names of the scene ([`escaped`]).
pub fn id(kind: &str, name: &str) -> String {
    format!("{}-{}", prefix(kind), escaped(name))
}

/// Returns the first word of the ids of a drawing.
pub fn prefix(kind: &str) -> &str {
    DiagramKind::ALL.into_iter().find(|on| on.word() == kind).map_or(kind, |on| on.prefix())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::paper::symbols as sym;

    #[test]
    fn names_are_unique_and_classes_begin_with_the_kind() {
        let mut d = Drawing::new("mechanism", Style::default());
        d.draw(
            "pivot-A",
            "",
            sym::fixed_pivot(&Style::default(), Point::ORIGIN, Vec2::new(0.0, -1.0)),
        );
        d.draw("pivot-A", "", sym::pin(&Style::default(), Point::new(20.0, 0.0)));
        d.label_at("A", "point", "A", Point::ORIGIN, 1.3, None);
        let part = d.finish();
        let names: HashSet<&str> = part.items.iter().map(|i| i.id.as_str()).collect();
        assert_eq!(names.len(), part.items.len());
        assert!(part.items.iter().all(|i| i.class.starts_with("mechanism ")), "{:?}", part.items);
        assert_eq!(part.placements.len(), 1);
    }

    /// In a crowded region only the kept points are named; isolated points, and long lines that
    /// leave the region, keep their names.
    #[test]
    fn a_crowd_is_not_named() {
        let labels = |count: usize| {
            let mut d = Drawing::new("velocity", Style::default());
            for k in 0..count {
                d.label_at(
                    &format!("b{k}"),
                    "image",
                    "b",
                    Point::new(0.1 * k as f64, 0.0),
                    0.5,
                    None,
                );
            }
            d.label_along("short", "edge", "s", (Point::ORIGIN, Point::new(1.0, 0.0)), 0.2, 0);
            d.label_along("long", "edge", "l", (Point::ORIGIN, Point::new(40.0, 0.0)), 0.2, 0);
            d.label_at("far", "image", "f", Point::new(0.0, 30.0), 0.5, None);
            d.thin_out(&[Point::ORIGIN]);
            d.wanted.into_iter().map(|w| w.id).collect::<Vec<_>>()
        };
        assert_eq!(labels(20), ["vel-label-b0", "vel-label-long", "vel-label-far"]);
        assert_eq!(labels(CROWD - 1).len(), CROWD + 2);
    }

    #[test]
    fn a_plate_has_one_area_however_often_things_go_behind_it() {
        use crate::paper::item::LineStroke;
        let mut d = Drawing::new("mechanism", Style::default());
        let corners = [(0.0, 0.0), (9.0, 0.0), (0.0, 9.0)].map(|(x, y)| Point::new(x, y));
        d.draw("link-2", "", sym::plate(&Style::default(), &corners));
        for k in 0..5 {
            let shape = Shape::Line {
                from: Point::ORIGIN,
                to: Point::new(9.0, f64::from(k)),
                stroke: LineStroke::new(0.2),
            };
            d.behind(|d| {
                d.shape("ray", "ray", shape.clone());
            });
        }
        let part = d.finish();
        let filled = |i: &FigureItem| matches!(i.shape, Shape::Polyline { fill: Some(_), .. });
        assert_eq!(part.items.iter().filter(|i| filled(i)).count(), 1);
        assert!(filled(&part.items[0]), "the area is behind all rays");
    }

    #[test]
    fn a_part_stands_where_it_is_put() {
        let mut part = DrawingPart::of(sym::pin(&Style::default(), Point::new(3.0, 4.0)));
        part.stand_at(Point::new(10.0, 100.0));
        assert_eq!((part.bounds.min.x, part.bounds.max.y), (10.0, 100.0));
        assert_eq!(bounds(&part.items), Some(part.bounds));
    }
}
