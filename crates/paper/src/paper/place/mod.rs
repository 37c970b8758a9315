//! Placement of labels: at their point or along their line, clear of everything else.
//!
//! Every label has a fixed list of places (`candidate`), each with a static cost (`cost`: covered
//! ink, distance from the target, nearness to a foreign line); `search` chooses one place per label
//! so that the sum including the overlaps of pairs is small. A label whose best place is still poor
//! gets places farther off, with a leader line. The order is fixed and there is no randomness: the
//! same requests give the same places. More than a hundred labels are placed one after the other
//! (`coarse`), because comparing them takes time that grows with the square of their number.
//!
//! Costs are in millimetres of foreign line covered; the constants define their relative weights.

mod candidate;
mod coarse;
mod cost;
mod obstacle;
mod offer;
mod raster;
mod search;

pub use obstacle::{Bar, InkDisc, Obstacles};
pub use raster::InkRaster;

use std::f64::consts::PI;

use hodograph_base::geom::{Point, Vec2};

use super::extent::Rect;
use super::item::{Anchor, Colour, FigureItem, LineStroke, PathPiece, Shape};
use super::label::Label;
use super::text;
use candidate::CandidatePlace;
use offer::Offer;

/// The object that a label names.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// A point with a symbol around it.
    Point {
        /// The point.
        at: Point,
        /// Radius of its symbol, which the label must not cover.
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
    /// An arc of a circle, such as an angle or the arrow of a rotation; a place outside it is
    /// preferred.
    Arc {
        /// Centre.
        centre: Point,
        /// Radius.
        radius_mm: f64,
        /// Angle at the start.
        from_rad: f64,
        /// Angle at the end.
        to_rad: f64,
        /// Half the width of the line.
        clear_mm: f64,
    },
}

/// The role of a label beside another one on the same line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reads {
    /// Read by itself.
    #[default]
    Alone,
    /// A quantity: a number close behind it would be read as its factor.
    Quantity,
    /// A number.
    Number,
}

/// A label to be placed.
#[derive(Clone, Debug, PartialEq)]
pub struct LabelRequest {
    /// The text.
    pub label: Label,
    /// Type size.
    pub size_mm: f64,
    /// The object that the label names.
    pub target: Target,
    /// The owner number of the obstacles that the target's own ink makes; they cost less than
    /// foreign ones.
    pub owner: Option<u32>,
    /// The preferred side, such as away from a polygon's centre; `None` for the upper right, or the
    /// outside of an arc.
    pub prefer: Option<Vec2>,
    /// The role beside another label.
    pub reads: Reads,
    /// True if the label may be left out if there is no clear place for it, because its target is
    /// named otherwise too.
    pub optional: bool,
}

impl LabelRequest {
    /// Returns the request of a label at a point.
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

    /// Returns the request of a label along a line.
    pub fn along(
        label: Label,
        size_mm: f64,
        from: Point,
        to: Point,
        clear_mm: f64,
    ) -> LabelRequest {
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

    /// Returns the request of a label along an arc of a circle.
    pub fn along_arc(
        label: Label,
        size_mm: f64,
        centre: Point,
        radius_mm: f64,
        angles_rad: [f64; 2],
        clear_mm: f64,
    ) -> LabelRequest {
        let target = Target::Arc {
            centre,
            radius_mm,
            from_rad: angles_rad[0],
            to_rad: angles_rad[1],
            clear_mm,
        };
        LabelRequest {
            label,
            size_mm,
            target,
            owner: None,
            prefer: None,
            reads: Reads::Alone,
            optional: false,
        }
    }

    /// Width of the label.
    pub fn width_mm(&self) -> f64 {
        text::set(&self.label).width_em * self.size_mm
    }

    /// Returns the point that the label names, if it names one.
    pub fn point(&self) -> Option<Point> {
        match self.target {
            Target::Point { at, .. } => Some(at),
            Target::Segment { .. } | Target::Arc { .. } => None,
        }
    }

    /// Returns the request with an owner.
    pub fn owned(self, owner: u32) -> LabelRequest {
        LabelRequest { owner: Some(owner), ..self }
    }

    /// Returns the request with a role beside another label.
    pub fn read_as(self, reads: Reads) -> LabelRequest {
        LabelRequest { reads, ..self }
    }

    /// Returns the request, marked as optional or required.
    pub fn optional(self, optional: bool) -> LabelRequest {
        LabelRequest { optional, ..self }
    }

    /// Returns the request with a preferred side.
    pub fn towards(self, side: Vec2) -> LabelRequest {
        LabelRequest { prefer: Some(side), ..self }
    }
}

/// The position of a label.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Start of the baseline.
    pub at: Point,
    /// Box of the ink.
    pub bounds: Rect,
    /// A leader line from the label to its target, if the label is far off.
    pub leader: Option<(Point, Point)>,
    /// Cost of the place; at or above [`CROWDED`] it covers something.
    pub cost: f64,
    /// Index of the place among the label's places, relative to its target: comparable between the
    /// figures of a series.
    pub index: usize,
}

/// Cost from which a label touches a foreign object or another label: any first touch costs at
/// least this much, nearness alone less.
pub const CROWDED: f64 = cost::TOUCH;

impl Placement {
    /// Returns the label as an item, after the items of its leader line if it has one.
    pub fn items(
        &self,
        request: &LabelRequest,
        class: &str,
        leader: LineStroke,
    ) -> Vec<FigureItem> {
        let line =
            self.leader.map(|(from, to)| FigureItem::new("leader", pointer(from, to, leader)));
        let label = Shape::Label {
            at: self.at,
            label: request.label.clone(),
            size_mm: request.size_mm,
            anchor: Anchor::Start,
            colour: Colour::BLACK,
        };
        line.into_iter().chain([FigureItem::new(class, label)]).collect()
    }
}

/// Grey level of a leader line: visible, but distinct from the lines of the drawing.
const LEADER_GREY: u8 = 140;
/// Radius of the dot at the end of a leader line (ISO 128-22: on a surface or a line without an
/// arrowhead).
const LEADER_DOT_MM: f64 = 0.45;

/// A leader line: grey, with a dot at the object that it names.
fn pointer(from: Point, to: Point, stroke: LineStroke) -> Shape {
    let grey = Colour::grey(LEADER_GREY);
    // Both arcs of the dot start at an angle independent of the leader's direction: between the
    // frames of a lesson all numbers of the dot then change alike, which takes no space in the
    // file.
    let half = |from_rad| PathPiece::Arc {
        centre: to,
        radius_mm: LEADER_DOT_MM,
        from_rad,
        to_rad: from_rad + PI,
    };
    Shape::Path {
        start: to + Vec2::new(LEADER_DOT_MM, 0.0),
        pieces: vec![half(0.0), half(PI), PathPiece::Move(to), PathPiece::Line(from)],
        closed: false,
        stroke: Some(stroke.coloured(grey)),
        fill: Some(grey),
    }
}

/// Finds a place for every label: one placement for each request, in their order.
///
/// `obstacles` contains all ink of the drawing, including the labels' own targets; `bounds` is the
/// available paper. An empty label has no size and is placed at its target.
pub fn place(requests: &[LabelRequest], obstacles: &Obstacles, bounds: Rect) -> Vec<Placement> {
    place_after(requests, obstacles, bounds, &[])
}

/// Finds a place for every label of a figure in a series.
///
/// A label with a [`Placement::index`] in `before` keeps that place beside its target unless
/// something obstructs it.
pub fn place_after(
    requests: &[LabelRequest],
    obstacles: &Obstacles,
    bounds: Rect,
    before: &[Option<usize>],
) -> Vec<Placement> {
    if is_coarse(requests.len()) {
        let none_left: Vec<LabelRequest> =
            requests.iter().map(|r| r.clone().optional(false)).collect();
        let habits: Vec<Option<Habit>> = before.iter().map(|b| b.map(Habit::At)).collect();
        return coarse::place(&none_left, obstacles, bounds, &habits)
            .0
            .into_iter()
            .flatten()
            .collect();
    }
    let labels: Vec<MeasuredRequest> = requests.iter().map(MeasuredRequest::new).collect();
    let mut offers: Vec<Offer> = labels.iter().map(|w| Offer::new(w, obstacles, bounds)).collect();
    let all: Vec<usize> = (0..labels.len()).collect();
    search::run(&mut offers, &all, before, LeaderReach::Short)
        .into_iter()
        .zip(&labels)
        .map(|(found, wanted)| wanted.placement(found))
        .collect()
}

/// Number of free places that is enough for a label: labels placed before it do not take all of
/// them.
pub const ROOM: usize = 8;

/// Counts the places beside its target, up to [`ROOM`], at which a label touches no ink and is not
/// read as the name of another object, on unbounded paper.
pub fn free_places(request: &LabelRequest, obstacles: &Obstacles) -> usize {
    let wanted = MeasuredRequest::new(request);
    let places = candidate::near(&wanted);
    let Some(paper) = places.iter().map(|c| c.reach).reduce(Rect::union) else { return ROOM };
    let around = cost::Around::new(&places, &wanted, obstacles, paper);
    places.iter().filter(|c| around.fixed(c) < CROWDED).take(ROOM).count()
}

/// Returns the first element with [`ROOM`] free places, else the one with the most.
pub fn roomiest<T: Clone>(
    all: impl IntoIterator<Item = T>,
    free: impl Fn(T) -> usize,
) -> Option<T> {
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

/// Returns true if there are too many labels to compare with one another: each then takes the best
/// place that those before it left.
pub fn is_coarse(labels: usize) -> bool {
    labels > coarse::MANY
}

/// The largest distance of a label from its target if no nearer place is clear.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LeaderReach {
    /// Leader lines of at most 12 mm: for a series of figures, in which a distant label keeps its
    /// place for long.
    Short,
    /// Twice as long: for a single figure.
    Long,
    /// The place in the figure before unless it is covered, for a figure that is drawn again while
    /// something moves.
    Kept,
}

/// The state of a label in the previous figure of a series.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Habit {
    /// Placed at this [`Placement::index`].
    At(usize),
    /// Left out for want of a clear place.
    LeftOut,
}

/// Finds places as [`place_after`] does, and leaves out (`None`) optional labels without a clear
/// place.
///
/// A place is not clear if the label is on another label or on a line as thick as its own, is
/// nearer to such a line than to its own, or has a leader line across a barred line; leaving it out
/// gives the others more space. A label that was left out in the previous figure returns only if
/// there is a clear place beside all others, so that names do not appear and disappear.
pub fn place_or_leave(
    requests: &[LabelRequest],
    obstacles: &Obstacles,
    (bounds, leads): (Rect, LeaderReach),
    before: &[Option<Habit>],
) -> Vec<Option<Placement>> {
    if leads == LeaderReach::Kept {
        return kept(requests, obstacles, bounds, before);
    }
    if is_coarse(requests.len()) {
        return coarse::place(requests, obstacles, bounds, before).0;
    }
    let absent = |i: &usize| requests[*i].optional && before.get(*i) == Some(&Some(Habit::LeftOut));
    let (away, mut kept): (Vec<usize>, Vec<usize>) = (0..requests.len()).partition(absent);
    let mut out = vec![None; requests.len()];
    let labels: Vec<MeasuredRequest> = requests.iter().map(MeasuredRequest::new).collect();
    let mut offers: Vec<Offer> = labels.iter().map(|w| Offer::new(w, obstacles, bounds)).collect();
    loop {
        let stood = |i: &usize| match before[*i] {
            Some(Habit::At(index)) => Some(index),
            _ => None,
        };
        let habits: Vec<Option<usize>> =
            if before.is_empty() { Vec::new() } else { kept.iter().map(stood).collect() };
        let found = search::run(&mut offers, &kept, &habits, leads);
        let places: Vec<Placement> =
            found.into_iter().zip(&kept).map(|(found, &i)| labels[i].placement(found)).collect();
        let hides = |k: usize| {
            let (own, here) = (&labels[kept[k]], places[k].bounds);
            let through = |other: Rect| {
                places[k].leader.is_some_and(|(a, b)| cost::clipped_mm(a, b, other) > 0.0)
            };
            let mut others =
                places.iter().enumerate().filter(|(j, _)| *j != k).map(|(_, p)| p.bounds);
            cost::hides(here, own, obstacles)
                || others.any(|other| other.overlap_mm2(here) > 0.0 || through(other))
        };
        let strays = |k: usize| {
            cost::strays(places[k].bounds, places[k].leader.is_some(), &labels[kept[k]], obstacles)
        };
        let barred = |k: usize| {
            places[k]
                .leader
                .is_some_and(|l| obstacles.barred.iter().any(|bar| cost::is_barred(l, bar)))
        };
        let poor = |k: usize| places[k].cost >= CROWDED && (hides(k) || barred(k)) || strays(k);
        let mut crowded: Vec<usize> =
            (0..kept.len()).filter(|&k| requests[kept[k]].optional && poor(k)).collect();
        if crowded.is_empty() {
            kept.iter().zip(places).for_each(|(&i, place)| out[i] = Some(place));
            break;
        }
        // The worst third at once: one at a time would take as many searches as there are labels.
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

/// Leaves every label at its place beside its target, unless something covers it there: then it
/// moves to the best near place, if that is better. New labels are placed beside those. An optional
/// label without a clear place is left out until it has one.
fn kept(
    requests: &[LabelRequest],
    obstacles: &Obstacles,
    bounds: Rect,
    before: &[Option<Habit>],
) -> Vec<Option<Placement>> {
    let labels: Vec<MeasuredRequest> = requests.iter().map(MeasuredRequest::new).collect();
    let stays = |(i, label): (usize, &MeasuredRequest)| match before.get(i).copied().flatten() {
        Some(Habit::At(index)) => {
            let mut offer = Offer::new(label, obstacles, bounds);
            let place = offer.place(index)?;
            Some(label.placement((place, offer.cost_alone(index), index)))
        }
        Some(Habit::LeftOut) | None => None,
    };
    let mut out: Vec<Option<Placement>> = labels.iter().enumerate().map(stays).collect();
    for (i, label) in labels.iter().enumerate() {
        let own = out[i].take();
        let others: Vec<Placement> = out.iter().flatten().copied().collect();
        let cost = own.map_or(f64::INFINITY, |p| p.cost + search::cost_beside(&p, &others));
        if cost < search::LEAVE {
            out[i] = own;
            continue;
        }
        let found = search::beside_placed(label, obstacles, bounds, &others);
        let found = found.map(|found| label.placement(found));
        let most = match before.get(i) {
            Some(Some(Habit::LeftOut)) => search::LEAVE,
            _ if requests[i].optional => CROWDED,
            _ => f64::INFINITY,
        };
        out[i] = match found {
            Some(better) if better.cost + search::LEAVE < cost => Some(better),
            _ => own.map(|p| Placement { cost, ..p }),
        };
        out[i] = out[i].filter(|p| p.cost < most);
    }
    out
}

/// A chosen place, its cost, and its index among the label's places.
type ChosenPlace = (CandidatePlace, f64, usize);

/// A request with its measures.
struct MeasuredRequest {
    half_width_mm: f64,
    half_height_mm: f64,
    /// Distances from the sides of the box to the ink, by which the eye judges distances.
    bearing_mm: [f64; 2],
    descent_mm: f64,
    target: Target,
    owner: Option<u32>,
    prefer: Option<Vec2>,
    reads: Reads,
}

impl MeasuredRequest {
    fn new(request: &LabelRequest) -> MeasuredRequest {
        let set = text::set(&request.label);
        let k = request.size_mm;
        MeasuredRequest {
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

    fn placement(&self, (candidate, cost, index): ChosenPlace) -> Placement {
        let at = Point::new(candidate.rect.min.x, candidate.rect.min.y + self.descent_mm);
        Placement { at, bounds: candidate.rect, leader: candidate.leader, cost, index }
    }

    /// Returns the extent of the ink within a box of the label.
    fn ink(&self, rect: Rect) -> Rect {
        let [left, right] = self.bearing_mm;
        Rect {
            min: Point::new(rect.min.x + left, rect.min.y),
            max: Point::new(rect.max.x - right, rect.max.y),
        }
    }

    fn rect(&self, centre: Point) -> Rect {
        let half = Vec2::new(self.half_width_mm, self.half_height_mm);
        Rect { min: centre - half, max: centre + half }
    }
}

#[cfg(test)]
mod tests;
