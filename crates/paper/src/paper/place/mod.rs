//! Where labels stand: at their point or along their line, clear of everything else.
//!
//! Every label has a fixed list of places (`candidate`), each with a static cost (`cost`: what it covers, how far
//! it strays, whether it stands nearer to a foreign line than to its own); `search` picks one each so that the sum
//! with the overlaps of pairs is small. A label whose best place is still poor is offered places farther off, with a
//! leader line. Fixed order, no randomness: the same requests give the same places. More than a hundred labels are placed one after
//! the other (`coarse`): weighing them against one another takes time that grows with the square of their number.
//!
//! Costs are in millimetres of foreign line covered; the constants say what they are worth against each other.

mod candidate;
mod coarse;
mod cost;
mod obstacle;
mod offer;
mod raster;
mod search;

pub use obstacle::{Bar, Disc, Obstacles};
pub use raster::Raster;

use std::f64::consts::PI;

use hodograph_base::geom::{Point, Vec2};

use super::extent::Rect;
use super::item::{Anchor, Colour, Item, Piece, Shape, Stroke};
use super::label::Label;
use super::text;
use candidate::Candidate;
use offer::Offer;

/// What a label belongs to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// A point with a symbol around it.
    Point {
        /// The point.
        at: Point,
        /// Radius of its symbol; the label keeps off it.
        clear_mm: f64,
    },
    /// A line.
    Segment {
        /// One end.
        from: Point,
        /// The other end.
        to: Point,
        /// Half the width of the line.
        clear_mm: f64,
    },
    /// A piece of a circle, such as an angle or the arrow of a rotation; outside is preferred.
    Arc {
        /// Centre.
        centre: Point,
        /// Radius.
        radius_mm: f64,
        /// Angle of its beginning.
        from_rad: f64,
        /// Angle of its end.
        to_rad: f64,
        /// Half the width of the line.
        clear_mm: f64,
    },
}

/// What a label would be read as beside another one on the same line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reads {
    /// As itself.
    #[default]
    Alone,
    /// As a quantity: a number close behind it would be its factor.
    Quantity,
    /// As a number.
    Number,
}

/// A label that wants a place.
#[derive(Clone, Debug, PartialEq)]
pub struct LabelRequest {
    /// What is written.
    pub label: Label,
    /// Size of the type.
    pub size_mm: f64,
    /// What it belongs to.
    pub target: Target,
    /// The owner named by the obstacles that the label's own thing makes; they are neither foreign nor as costly.
    pub owner: Option<u32>,
    /// The side to prefer, such as away from a polygon's middle; `None` for the upper right, for an arc the outside.
    pub prefer: Option<Vec2>,
    /// What it would be read as beside another label.
    pub reads: Reads,
    /// Whether it may be left out where there is no clear place for it, as its thing is named otherwise too.
    pub optional: bool,
}

impl LabelRequest {
    /// A label at a point.
    pub fn at_point(label: Label, size_mm: f64, at: Point, clear_mm: f64) -> LabelRequest {
        LabelRequest {
            label,
            size_mm,
            target: Target::Point { at, clear_mm },
            owner: None,
            prefer: None,
            reads: Reads::Alone,
            optional: false,
        }
    }

    /// A label along a line.
    pub fn along(label: Label, size_mm: f64, from: Point, to: Point, clear_mm: f64) -> LabelRequest {
        LabelRequest {
            label,
            size_mm,
            target: Target::Segment { from, to, clear_mm },
            owner: None,
            prefer: None,
            reads: Reads::Alone,
            optional: false,
        }
    }

    /// A label along a piece of a circle.
    pub fn along_arc(label: Label, size_mm: f64, centre: Point, radius_mm: f64, angles_rad: [f64; 2], clear_mm: f64) -> LabelRequest {
        let target = Target::Arc { centre, radius_mm, from_rad: angles_rad[0], to_rad: angles_rad[1], clear_mm };
        LabelRequest { label, size_mm, target, owner: None, prefer: None, reads: Reads::Alone, optional: false }
    }

    /// How wide its ink is.
    pub fn width_mm(&self) -> f64 {
        text::set(&self.label).width_em * self.size_mm
    }

    /// The point that it names, if it names one.
    pub fn point(&self) -> Option<Point> {
        match self.target {
            Target::Point { at, .. } => Some(at),
            Target::Segment { .. } | Target::Arc { .. } => None,
        }
    }

    /// The same with an owner.
    pub fn owned(self, owner: u32) -> LabelRequest {
        LabelRequest { owner: Some(owner), ..self }
    }

    /// The same for a label that is read with another one.
    pub fn read_as(self, reads: Reads) -> LabelRequest {
        LabelRequest { reads, ..self }
    }

    /// The same for a label that may be left out.
    pub fn optional(self, optional: bool) -> LabelRequest {
        LabelRequest { optional, ..self }
    }

    /// The same with a side to prefer.
    pub fn towards(self, side: Vec2) -> LabelRequest {
        LabelRequest { prefer: Some(side), ..self }
    }
}

/// Where a label stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Start of its baseline.
    pub at: Point,
    /// Box of its ink.
    pub bounds: Rect,
    /// A leader line from the label to its thing, where it stands far off.
    pub leader: Option<(Point, Point)>,
    /// What the place costs; above [`CROWDED`] it covers something.
    pub cost: f64,
    /// Which of the label's places it is, seen from its thing: the same in figures of a series.
    pub index: usize,
}

/// From this cost on a label touches a foreign thing or another label: any first touch costs more, any nearness less.
pub const CROWDED: f64 = cost::TOUCH;

impl Placement {
    /// The label as an item, and its leader line before it where it has one.
    pub fn items(&self, request: &LabelRequest, class: &str, leader: Stroke) -> Vec<Item> {
        let line = self.leader.map(|(from, to)| Item::new("leader", pointer(from, to, leader)));
        let label = Shape::Label {
            at: self.at,
            label: request.label.clone(),
            size_mm: request.size_mm,
            anchor: Anchor::Start,
            colour: Colour::BLACK,
        };
        line.into_iter().chain([Item::new(class, label)]).collect()
    }
}

/// How grey a leader line is: to be followed, and not to be taken for a line of the drawing.
const LEADER_GREY: u8 = 140;
/// The dot at its end (ISO 128-22: on a surface or a line without an arrowhead).
const LEADER_DOT_MM: f64 = 0.45;

/// A leader line: grey, with a dot at the thing that it names.
fn pointer(from: Point, to: Point, stroke: Stroke) -> Shape {
    let grey = Colour::grey(LEADER_GREY);
    // Both begin where no direction plays a part: over the frames of a lesson all numbers of the dot change alike, and take no room.
    let half = |from_rad| Piece::Arc { centre: to, radius_mm: LEADER_DOT_MM, from_rad, to_rad: from_rad + PI };
    Shape::Path {
        start: to + Vec2::new(LEADER_DOT_MM, 0.0),
        pieces: vec![half(0.0), half(PI), Piece::Move(to), Piece::Line(from)],
        closed: false,
        stroke: Some(stroke.coloured(grey)),
        fill: Some(grey),
    }
}

/// Finds a place for every label: one placement for each request, in their order.
///
/// `obstacles` is all that is drawn, the labels' own things included; `bounds` is the paper that they may use.
/// An empty label takes no room and stands at its target.
pub fn place(requests: &[LabelRequest], obstacles: &Obstacles, bounds: Rect) -> Vec<Placement> {
    place_after(requests, obstacles, bounds, &[])
}

/// The same in a figure that follows another one of a series: a label with a [`Placement::index`] in `before` keeps that
/// place beside its thing unless something has come in its way.
pub fn place_after(requests: &[LabelRequest], obstacles: &Obstacles, bounds: Rect, before: &[Option<usize>]) -> Vec<Placement> {
    if is_coarse(requests.len()) {
        let none_left: Vec<LabelRequest> = requests.iter().map(|r| r.clone().optional(false)).collect();
        let habits: Vec<Option<Habit>> = before.iter().map(|b| b.map(Habit::At)).collect();
        return coarse::place(&none_left, obstacles, bounds, &habits).0.into_iter().flatten().collect();
    }
    let labels: Vec<Wanted> = requests.iter().map(Wanted::new).collect();
    let mut offers: Vec<Offer> = labels.iter().map(|w| Offer::new(w, obstacles, bounds)).collect();
    let all: Vec<usize> = (0..labels.len()).collect();
    search::run(&mut offers, &all, before, Leads::Short).into_iter().zip(&labels).map(|(found, wanted)| wanted.placement(found)).collect()
}

/// So many free places, and a label that is placed before has not taken all of them.
pub const ROOM: usize = 8;

/// How many places, up to [`ROOM`], a label has beside its thing where it touches nothing that is drawn and is not taken for another
/// thing's, on paper without end.
pub fn free_places(request: &LabelRequest, obstacles: &Obstacles) -> usize {
    let wanted = Wanted::new(request);
    let places = candidate::near(&wanted);
    let Some(paper) = places.iter().map(|c| c.reach).reduce(Rect::union) else { return ROOM };
    let around = cost::Around::new(&places, &wanted, obstacles, paper);
    places.iter().filter(|c| around.fixed(c) < CROWDED).take(ROOM).count()
}

/// The first of these with [`ROOM`] free places, else the one with most of them.
pub fn roomiest<T: Clone>(all: impl IntoIterator<Item = T>, free: impl Fn(T) -> usize) -> Option<T> {
    let mut best: Option<(T, usize)> = None;
    for one in all {
        let room = free(one.clone());
        if best.as_ref().is_none_or(|b| room > b.1) {
            best = Some((one, room));
        }
        if room >= ROOM {
            break;
        }
    }
    best.map(|b| b.0)
}

/// Whether so many labels are too many to be weighed against one another: then each takes the best place that those before it left.
pub fn is_coarse(labels: usize) -> bool {
    labels > coarse::MANY
}

/// How far from its thing a label may stand where nothing nearer is clear.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Leads {
    /// As far as a leader line of 12 mm goes: in a series of figures, in which a label far off keeps its place for long.
    Short,
    /// Twice as far: in a figure that stands alone.
    Long,
}

/// What a label of a series did in the figure before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Habit {
    /// It stood there ([`Placement::index`]).
    At(usize),
    /// There was no clear place for it.
    LeftOut,
}

/// Finds places as [`place_after`], and leaves out optional labels that would stand on another label, on a line as thick as
/// their own, or nearer to one than to their own, or whose leader line would cross what none may cross; the others then have more room. `None` for those left out. One that was left out in the figure before comes back
/// when there is a clear place beside all others, so that names do not come and go.
pub fn place_or_leave(
    requests: &[LabelRequest],
    obstacles: &Obstacles,
    (bounds, leads): (Rect, Leads),
    before: &[Option<Habit>],
) -> Vec<Option<Placement>> {
    if is_coarse(requests.len()) {
        return coarse::place(requests, obstacles, bounds, before).0;
    }
    let absent = |i: &usize| requests[*i].optional && before.get(*i) == Some(&Some(Habit::LeftOut));
    let (away, mut kept): (Vec<usize>, Vec<usize>) = (0..requests.len()).partition(absent);
    let mut out = vec![None; requests.len()];
    let labels: Vec<Wanted> = requests.iter().map(Wanted::new).collect();
    let mut offers: Vec<Offer> = labels.iter().map(|w| Offer::new(w, obstacles, bounds)).collect();
    loop {
        let stood = |i: &usize| match before[*i] {
            Some(Habit::At(index)) => Some(index),
            _ => None,
        };
        let habits: Vec<Option<usize>> = if before.is_empty() { Vec::new() } else { kept.iter().map(stood).collect() };
        let found = search::run(&mut offers, &kept, &habits, leads);
        let places: Vec<Placement> = found.into_iter().zip(&kept).map(|(found, &i)| labels[i].placement(found)).collect();
        let hides = |k: usize| {
            let (own, here) = (&labels[kept[k]], places[k].bounds);
            let through = |other: Rect| places[k].leader.is_some_and(|(a, b)| cost::clipped_mm(a, b, other) > 0.0);
            let mut others = places.iter().enumerate().filter(|(j, _)| *j != k).map(|(_, p)| p.bounds);
            cost::hides(here, own, obstacles) || others.any(|other| other.overlap_mm2(here) > 0.0 || through(other))
        };
        let strays = |k: usize| cost::strays(places[k].bounds, places[k].leader.is_some(), &labels[kept[k]], obstacles);
        let barred = |k: usize| places[k].leader.is_some_and(|l| obstacles.barred.iter().any(|bar| cost::is_barred(l, bar)));
        let poor = |k: usize| places[k].cost >= CROWDED && (hides(k) || barred(k)) || strays(k);
        let mut crowded: Vec<usize> = (0..kept.len()).filter(|&k| requests[kept[k]].optional && poor(k)).collect();
        if crowded.is_empty() {
            kept.iter().zip(places).for_each(|(&i, place)| out[i] = Some(place));
            break;
        }
        // The worst third at once: to go one by one would take as many searches as labels.
        crowded.sort_by(|&a, &b| places[b].cost.total_cmp(&places[a].cost));
        crowded.truncate(crowded.len().div_ceil(3));
        let mut k = 0;
        kept.retain(|_| {
            k += 1;
            !crowded.contains(&(k - 1))
        });
    }
    for i in away {
        let placed: Vec<Placement> = out.iter().flatten().copied().collect();
        let found = search::beside_placed(&labels[i], obstacles, bounds, &placed);
        out[i] = found.map(|found| labels[i].placement(found)).filter(|p| p.cost < CROWDED);
    }
    out
}

/// A place that was picked, what it costs, and which of the label's places it is.
type Found = (Candidate, f64, usize);

/// A request with its measures.
struct Wanted {
    half_width_mm: f64,
    half_height_mm: f64,
    /// From the sides of the box to the ink, which is what the eye compares distances by.
    bearing_mm: [f64; 2],
    descent_mm: f64,
    target: Target,
    owner: Option<u32>,
    prefer: Option<Vec2>,
    reads: Reads,
}

impl Wanted {
    fn new(request: &LabelRequest) -> Wanted {
        let set = text::set(&request.label);
        let k = request.size_mm;
        Wanted {
            half_width_mm: set.width_em * k / 2.0,
            half_height_mm: (set.ascent_em + set.descent_em) * k / 2.0,
            bearing_mm: [set.ink_em[0] * k, (set.width_em - set.ink_em[1]) * k],
            descent_mm: set.descent_em * k,
            target: request.target,
            owner: request.owner,
            reads: request.reads,
            prefer: request.prefer.and_then(Vec2::unit),
        }
    }

    fn placement(&self, (candidate, cost, index): Found) -> Placement {
        let at = Point::new(candidate.rect.min.x, candidate.rect.min.y + self.descent_mm);
        Placement { at, bounds: candidate.rect, leader: candidate.leader, cost, index }
    }

    /// The ink in a box of the label.
    fn ink(&self, rect: Rect) -> Rect {
        let [left, right] = self.bearing_mm;
        Rect { min: Point::new(rect.min.x + left, rect.min.y), max: Point::new(rect.max.x - right, rect.max.y) }
    }

    fn rect(&self, centre: Point) -> Rect {
        let half = Vec2::new(self.half_width_mm, self.half_height_mm);
        Rect { min: centre - half, max: centre + half }
    }
}

#[cfg(test)]
mod tests;
