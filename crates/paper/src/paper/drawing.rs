//! A part of a sheet in the making: items, what labels keep off, and the labels that still want a place.
//!
//! Decided here: that every item has a name of its own, and when labels are placed (once, when all lines are there).
//! Not decided here: what is drawn, and where the part stands on the sheet.

use std::collections::{BTreeMap, HashMap, HashSet};

use hodograph_base::diagram::DiagramKind;
use hodograph_base::geom::{Point, Vec2};

use super::broken::break_at;
use super::extent::{Rect, bounds, translate};
use super::item::{COARSE, Item, PLACED, Shape, tag};
use super::label::Label;
use super::place::{Habit, LabelRequest, Leads, Obstacles, Placement, Target, is_coarse, place_or_leave};
use super::shown::{Shown, escaped};
use super::style::Style;

/// Room around the lines of a part in which its labels may stand: the longest leader line and a short label.
const LABEL_ROOM_MM: f64 = 20.0;
/// Air between a line and a label that is wider than that room.
const LABEL_AIR_MM: f64 = 3.0;

/// As many names within the height of a letter still find places from which one sees what they name.
const CROWD: usize = 8;

/// Two places nearer than this are one.
const SAME_MM: f64 = 0.05;

/// A finished part: items in coordinates of its own, and the box around them.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// What is drawn.
    pub items: Vec<Item>,
    /// The box around all ink.
    pub bounds: Rect,
    /// Where the labels found their places, and what it cost.
    pub placements: Vec<Placement>,
    /// The names of optional labels for which there was no clear place.
    pub left_out: Vec<String>,
}

impl Part {
    /// A part of finished items; an empty one takes no room.
    pub fn of(items: Vec<Item>) -> Part {
        let bounds = bounds(&items).unwrap_or(Rect::new(Point::ORIGIN, Point::ORIGIN));
        Part { items, bounds, placements: Vec::new(), left_out: Vec::new() }
    }

    /// Moves the part so that its box begins at `corner`, its upper left one.
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

/// For each label, by name, where it stood or that it was left out.
pub type Habits = BTreeMap<String, Habit>;

/// A part in the making.
#[derive(Debug)]
pub struct Drawing {
    kind: &'static str,
    style: Style,
    items: Vec<Item>,
    obstacles: Obstacles,
    wanted: Vec<Wanted>,
    names: HashSet<String>,
    /// For each wish, up to which number its names are taken.
    counts: HashMap<String, usize>,
    owners: u32,
    link: Option<usize>,
}

/// A label that wants a place.
#[derive(Debug)]
struct Wanted {
    request: LabelRequest,
    id: String,
    class: String,
    link: Option<usize>,
}

impl Drawing {
    /// An empty drawing; `kind` is the first word of every class and name in it.
    pub fn new(kind: &'static str, style: Style) -> Drawing {
        let (obstacles, names, counts) = (Obstacles::default(), HashSet::new(), HashMap::new());
        Drawing { kind, style, items: Vec::new(), obstacles, wanted: Vec::new(), names, counts, owners: 0, link: None }
    }

    /// What is drawn from now on belongs to this link, or to none.
    pub fn of_link(&mut self, link: Option<usize>) {
        self.link = link;
    }

    /// Draws a thing of one or more items, named after `name`; returns its owner for labels.
    pub fn draw(&mut self, name: &str, class: &str, mut items: Vec<Item>) -> u32 {
        self.owners += 1;
        items = items.into_iter().map(|item| item.in_fonts(&self.style.fonts)).collect();
        tag(&mut items, &format!("{} {class}", self.kind).replace("  ", " "));
        self.obstacles.add(&items, Some(self.owners));
        for item in &mut items {
            item.id = self.name(name);
            // Parts of one symbol may belong to links of their own, as barrel and rod do.
            item.link = item.link.or(self.link);
        }
        self.items.extend(items);
        self.owners
    }

    /// How many things of what is drawn so far these items would cross, or come nearer to than `air_mm`.
    pub fn met_by(&self, items: &[Item], air_mm: f64) -> usize {
        self.obstacles.met_by(&Obstacles::of(items), air_mm)
    }

    /// The same for ink that is known.
    pub fn met(&self, ink: &Obstacles, air_mm: f64) -> usize {
        self.obstacles.met_by(ink, air_mm)
    }

    /// All that labels keep off so far.
    pub fn obstacles(&self) -> &Obstacles {
        &self.obstacles
    }

    /// The box around what is drawn so far.
    pub fn bounds(&self) -> Rect {
        bounds(&self.items).unwrap_or(Rect::new(Point::ORIGIN, Point::ORIGIN))
    }

    /// What is drawn by this lies behind all that is there but the areas of plates, in which it shows.
    pub fn behind(&mut self, draw: impl FnOnce(&mut Drawing)) {
        let (before, bars) = (self.items.len(), self.obstacles.bars.len());
        draw(self);
        self.obstacles.bars[bars..].iter_mut().for_each(|bar| bar.faint = true);
        let added = self.items.split_off(before);
        // An area without its edge is one that went behind before.
        let edgeless = |i: &Item| matches!(i.shape, Shape::Polyline { stroke: None, fill: Some(_), .. });
        let plate = |i: &Item| i.class.split(' ').any(|word| word == "plate");
        let (mut areas, kept): (Vec<Item>, Vec<Item>) = std::mem::take(&mut self.items).into_iter().partition(|i| plate(i) && edgeless(i));
        self.items = kept;
        for item in self.items.iter_mut().filter(|i| plate(i)) {
            let mut area = item.clone();
            if let (Shape::Polyline { stroke, .. }, Shape::Polyline { fill, .. }) = (&mut area.shape, &mut item.shape)
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
        self.draw(name, class, vec![Item::new("", shape)])
    }

    /// Draws a thin frame around other things: labels may stand in it, and across it where there is no better place.
    pub fn frame(&mut self, name: &str, class: &str, shape: Shape) {
        let mut item = Item::new("", shape).with_id(self.name(name));
        tag(std::slice::from_mut(&mut item), &format!("{} {class}", self.kind));
        self.items.push(item);
    }

    /// Draws a vector of a quantity.
    pub fn vector(&mut self, name: &str, class: &str, shape: Shape, shown: Shown) -> u32 {
        self.draw(name, class, vec![Item::new("", shape).showing(shown)])
    }

    /// Names a place without ink, for programs that measure on the drawing: a circle of no radius, which labels do not keep off, but to which
    /// the letter of another place stands no nearer than to its own.
    pub fn mark(&mut self, name: &str, shown: Shown, at: Point) {
        let shape = Shape::Circle { centre: at, radius_mm: 0.0, stroke: None, fill: None };
        let id = self.name(&format!("mark-{name}"));
        self.items.push(Item::new(format!("{} mark", self.kind), shape).with_id(id).showing(shown));
        self.obstacles.marks.push(at);
    }

    /// Asks for a label; it is placed when the drawing is finished. Returns its name.
    pub fn label(&mut self, name: &str, class: &str, mut request: LabelRequest) -> String {
        request.label = request.label.in_fonts(&self.style.fonts);
        let id = self.name(&format!("label-{name}"));
        self.wanted.push(Wanted { request, id: id.clone(), class: format!("{} {class} {PLACED}", self.kind), link: self.link });
        id
    }

    /// Only the letters of points stay: for a drawing that stands beside one with all its names.
    pub fn letters_only(&mut self) {
        let is_letter = |w: &Wanted| w.request.point().is_some() && w.class.split(' ').any(|word| matches!(word, "point" | "pole"));
        self.wanted.retain(is_letter);
    }

    /// Only the labels stay whose name, as it was asked for, is among these.
    pub fn only_named(&mut self, among: impl Fn(&str) -> bool) {
        let prefix = format!("{}-label-", prefix(self.kind));
        self.wanted.retain(|w| w.id.strip_prefix(&prefix).is_none_or(&among));
    }

    /// Where very many marks and short lines lie within the height of a letter, no leader tells one from the others: their names are left out, but
    /// for those at the points that are kept.
    pub fn thin_out(&mut self, kept: &[Point]) {
        let small = |w: &Wanted| match w.request.target {
            Target::Point { at, .. } => Some((at, w.request.size_mm)),
            Target::Segment { from, to, .. } => {
                (from.distance(to) < w.request.size_mm).then(|| (from + (to - from) * 0.5, w.request.size_mm))
            }
            Target::Arc { .. } => None,
        };
        let places: Vec<Option<(Point, f64)>> = self.wanted.iter().map(small).collect();
        let near = |at: Point, reach: f64| places.iter().flatten().filter(|(p, _)| p.distance(at) < reach).count();
        let stays = |place: &Option<(Point, f64)>| {
            place.is_none_or(|(at, reach)| near(at, reach) <= CROWD || kept.iter().any(|k| k.distance(at) < SAME_MM))
        };
        let mut staying = places.iter().map(stays);
        self.wanted.retain(|_| staying.next().unwrap_or(true));
    }

    /// A label at a point.
    pub fn label_at(&mut self, name: &str, class: &str, text: &str, at: Point, clear_mm: f64, prefer: Option<Vec2>) {
        let request = LabelRequest::at_point(Label::math(text), self.style.label_mm, at, clear_mm);
        self.label(name, class, LabelRequest { prefer, ..request });
    }

    /// A label along a line that has been drawn.
    pub fn label_along(&mut self, name: &str, class: &str, text: &str, ends: (Point, Point), clear_mm: f64, owner: u32) {
        let request = LabelRequest::along(Label::math(text), self.style.label_mm, ends.0, ends.1, clear_mm);
        self.label(name, class, request.owned(owner));
    }

    /// An id not used before: `vel-rel-C-B`, then `vel-rel-C-B-2`.
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

    /// Places the labels.
    pub fn finish(self) -> Part {
        let room = self.room();
        self.placed(&mut Habits::new(), room, Leads::Long)
    }

    /// Places the labels of a drawing of a series: each where it stood before, if it can; `habits` then says where it stands
    /// now.
    pub fn finish_after(self, habits: &mut Habits) -> Part {
        let room = self.room();
        self.finish_within(habits, room)
    }

    /// The same with the room that the labels have.
    pub fn finish_within(self, habits: &mut Habits, room: Rect) -> Part {
        self.placed(habits, room, Leads::Short)
    }

    fn room(&self) -> Rect {
        let widest = self.wanted.iter().map(|w| w.request.width_mm()).fold(0.0, f64::max);
        self.bounds().grown(LABEL_ROOM_MM.max(widest + LABEL_AIR_MM))
    }

    fn placed(mut self, habits: &mut Habits, room: Rect, leads: Leads) -> Part {
        let requests: Vec<LabelRequest> = self.wanted.iter().map(|w| w.request.clone()).collect();
        self.obstacles.marks.extend(requests.iter().filter_map(LabelRequest::point));
        let (first, coarse) = (habits.is_empty(), is_coarse(requests.len()));
        let before: Vec<Option<Habit>> = self.wanted.iter().filter(|_| !first).map(|w| habits.get(&w.id).copied()).collect();
        let placed = place_or_leave(&requests, &self.obstacles, (room, leads), &before);
        if leads == Leads::Long {
            // In a series breaks would come and go.
            let fixed = self.items.iter().filter(|i| matches!(i.shape, Shape::Label { .. })).filter_map(Item::bounds);
            let boxes: Vec<Rect> = placed.iter().flatten().map(|p| p.bounds).chain(fixed).collect();
            break_at(&mut self.items, &boxes);
        }
        for (p, w) in placed.iter().zip(&self.wanted) {
            habits.insert(w.id.clone(), p.map_or(Habit::LeftOut, |p| Habit::At(p.index)));
            let Some(p) = p else { continue };
            let class = if coarse { w.class.replace(PLACED, &format!("{COARSE} {PLACED}")) } else { w.class.clone() };
            for (k, mut item) in p.items(&w.request, &class, self.style.thin).into_iter().rev().enumerate() {
                item.link = w.link;
                let id = &w.id;
                if k > 0 {
                    // It comes and goes with its label, but is none.
                    item.class = format!("{} leader", w.class.trim_end_matches(PLACED).trim_end());
                }
                // The label comes first in this order and keeps the name; its leader line is named after it.
                self.items.push(if k == 0 { item.with_id(id.clone()) } else { item.with_id(format!("{id}-leader")) });
            }
        }
        let mut part = Part::of(self.items);
        part.left_out = placed.iter().zip(&self.wanted).filter(|(p, _)| p.is_none()).map(|(_, w)| w.id.clone()).collect();
        part.placements = placed.into_iter().flatten().collect();
        part
    }
}

/// The id in a document of a thing of a drawing: `id("velocity", "normal-C-B")` is `vel-normal-C-B`; a second one of the same name bears a number
/// behind it. The name is made of words in small letters and of names of the scene as they are ([`escaped`]).
pub fn id(kind: &str, name: &str) -> String {
    format!("{}-{}", prefix(kind), escaped(name))
}

/// The first word of the ids of a drawing.
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
        d.draw("pivot-A", "", sym::fixed_pivot(&Style::default(), Point::ORIGIN, Vec2::new(0.0, -1.0)));
        d.draw("pivot-A", "", sym::pin(&Style::default(), Point::new(20.0, 0.0)));
        d.label_at("A", "point", "A", Point::ORIGIN, 1.3, None);
        let part = d.finish();
        let names: HashSet<&str> = part.items.iter().map(|i| i.id.as_str()).collect();
        assert_eq!(names.len(), part.items.len());
        assert!(part.items.iter().all(|i| i.class.starts_with("mechanism ")), "{:?}", part.items);
        assert_eq!(part.placements.len(), 1);
    }

    /// Of a crowd only what is kept is named; what stands apart, and long lines out of the crowd, keep their names.
    #[test]
    fn a_crowd_is_not_named() {
        let labels = |count: usize| {
            let mut d = Drawing::new("velocity", Style::default());
            for k in 0..count {
                d.label_at(&format!("b{k}"), "image", "b", Point::new(0.1 * k as f64, 0.0), 0.5, None);
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
        use crate::paper::item::Stroke;
        let mut d = Drawing::new("mechanism", Style::default());
        let corners = [(0.0, 0.0), (9.0, 0.0), (0.0, 9.0)].map(|(x, y)| Point::new(x, y));
        d.draw("link-2", "", sym::plate(&Style::default(), &corners));
        for k in 0..5 {
            let shape = Shape::Line { from: Point::ORIGIN, to: Point::new(9.0, f64::from(k)), stroke: Stroke::new(0.2) };
            d.behind(|d| {
                d.shape("ray", "ray", shape.clone());
            });
        }
        let part = d.finish();
        let filled = |i: &Item| matches!(i.shape, Shape::Polyline { fill: Some(_), .. });
        assert_eq!(part.items.iter().filter(|i| filled(i)).count(), 1);
        assert!(filled(&part.items[0]), "the area is behind all rays");
    }

    #[test]
    fn a_part_stands_where_it_is_put() {
        let mut part = Part::of(sym::pin(&Style::default(), Point::new(3.0, 4.0)));
        part.stand_at(Point::new(10.0, 100.0));
        assert_eq!((part.bounds.min.x, part.bounds.max.y), (10.0, 100.0));
        assert_eq!(bounds(&part.items), Some(part.bounds));
    }
}
