//! What a place costs, in millimetres of foreign line covered.

use crate::paper::extent::Rect;
use hodograph_base::geom::{Point, Vec2};

use super::candidate::{Candidate, FACTOR_MM, nearest};
use super::obstacle::{Bar, Disc, Obstacles};
use super::{Reads, Target, Wanted};

/// The first touch of anything: more than the farthest place near the thing (6.4) can cost, so that touching is
/// never the better bargain.
pub(super) const TOUCH: f64 = 8.0;
/// Air that a label keeps around its ink, so that a line beside it is seen as beside.
const AIR_MM: f64 = 0.5;
/// Each millimetre of a line under a label.
const PER_MM: f64 = 1.0;
/// A bar or a vector under a label is worse than a thin line: a leader line across two lines is better still.
pub(super) const THICK_FACTOR: f64 = 1.5;
/// Half the width from which a line is one of those.
const THICK_HALF_MM: f64 = 0.165;
/// A thin line that stands back is better crossed than led across.
const FAINT_FACTOR: f64 = 0.5;
/// An arrowhead is what the reader looks for: it counts as this many lines.
const HEAD_FACTOR: f64 = 2.0;
/// The label's own thin line through its letters does not mislead, and is no easier to read.
const OWN_FACTOR: f64 = 0.9;
/// Each millimetre of a disc's depth and each square millimetre of a box.
const PER_DEPTH: f64 = 2.0;
/// Leaving the paper: worse than anything on it.
const OUTSIDE: f64 = 200.0;
/// Each millimetre by which a foreign line is nearer than the label's own thing, plus a margin that tells them apart.
const NEARER_PER_MM: f64 = 1.8;
/// Foreign lines must be this much farther off than the own thing before they stop being mistaken for it.
const NEARER_MARGIN_MM: f64 = 0.8;
/// Nearness never costs as much as touching.
const NEARER_MAX: f64 = 4.0;
/// A foreign place nearer than the own one, or a line as thick as the own one nearer than that: more than the longest leader line with
/// foreign lines beside its label, less than covering a thick line.
const STRAYS: f64 = 14.0;
/// Of lines that lie over one another neither is nearer, whatever rounding says.
const TIE_MM: f64 = 1e-6;
/// Letters within this of one place are those of one mark.
const ONE_MARK_MM: f64 = 0.15;
/// A leader line across a line, or across a label.
const LEADER_CROSSES: f64 = 2.5;
/// A leader line through hatching or the arc of an angle: worse than anything but another label.
const BARRED: f64 = 20.0;
/// Its dot may lie on such an arc, if it is that which is named.
const DOT_MM: f64 = 0.6;
/// Overlap of two labels, and each square millimetre of it.
const OVERLAP: f64 = 25.0;
const OVERLAP_PER_MM2: f64 = 2.0;
/// A number that would be read as the factor of a quantity: more than a leader line.
const FACTOR: f64 = 7.0;
/// Names of two things in one line, so close that they are read as one name or as a product: decides between places about as good, no more.
const BESIDE: f64 = 1.2;
/// How close that is, in parts of the lower one's height: somewhat more than a word space.
const BESIDE_PART: f64 = 0.5;
/// From this part of the lower one's height on two names stand in one line, though not on one.
const BESIDE_LEVEL: f64 = 0.2;
/// From this part of its height on a number stands on one line with a quantity: somewhat less than the eye allows.
const LEVEL_PART: f64 = 0.4;
/// Air between two labels, for each of them.
const PAIR_AIR_MM: f64 = 0.3;

/// What is drawn around a label's places: found once, so that each place is asked about little more than it may touch.
pub(super) struct Around<'a> {
    wanted: &'a Wanted,
    paper: Rect,
    bars: Vec<Line<'a>>,
    heads: Vec<&'a Bar>,
    discs: Vec<&'a Disc>,
    rects: Vec<&'a Rect>,
    barred: Vec<&'a Bar>,
    rivals: Vec<Point>,
}

/// A line near a label's places.
struct Line<'a> {
    bar: &'a Bar,
    bounds: Rect,
    own: bool,
    meets: bool,
}

impl<'a> Around<'a> {
    /// All that can make one of these places dearer.
    pub(super) fn new(places: &[Candidate], wanted: &'a Wanted, obstacles: &'a Obstacles, paper: Rect) -> Around<'a> {
        let looks = places.iter().map(|c| c.reach.union(c.rect.grown(own_distance(c.rect, wanted.target) + NEARER_MARGIN_MM)));
        let Some(reach) = looks.reduce(Rect::union).map(|r| r.grown(AIR_MM)) else {
            return Around { wanted, paper, bars: vec![], heads: vec![], discs: vec![], rects: vec![], barred: vec![], rivals: vec![] };
        };
        let led = places.iter().any(|c| c.leader.is_some());
        let near = |bar: &&Bar| !far_apart(reach.grown(bar.half_width_mm), bar);
        let line = |bar: &'a Bar| {
            let own = bar.owner.is_some() && bar.owner == wanted.owner;
            Line { bar, bounds: Rect::new(bar.from, bar.to), own, meets: !own && meets(bar, wanted.target) }
        };
        let touched = |d: &&Disc| nearest(reach, d.centre).distance(d.centre) <= d.radius_mm;
        Around {
            wanted,
            paper,
            bars: obstacles.bars.iter().filter(near).map(line).collect(),
            heads: obstacles.heads.iter().filter(near).collect(),
            discs: obstacles.discs.iter().filter(touched).collect(),
            rects: obstacles.rects.iter().filter(|r| r.overlap_mm2(reach) > 0.0).collect(),
            barred: obstacles.barred.iter().filter(|bar| led && near(bar)).collect(),
            rivals: rivals(wanted, obstacles).filter(|p| nearest(reach, *p).distance(*p) <= reach.width_mm()).collect(),
        }
    }

    /// Whether another mark is nearer than the label's own, or another line as thick.
    fn strays(&self, rect: Rect) -> bool {
        let rect = self.wanted.ink(rect);
        match self.wanted.target {
            Target::Point { at, .. } => {
                let own = nearest(rect, at).distance(at);
                self.rivals.iter().any(|p| nearest(rect, *p).distance(*p) < own - TIE_MM)
            }
            Target::Segment { clear_mm, .. } => {
                let own = own_distance(rect, self.wanted.target);
                let rival = |l: &&Line| !l.own && !l.meets && l.bar.half_width_mm >= clear_mm;
                let near = |l: &Line| touch(rect.grown(own + l.bar.half_width_mm), l.bounds);
                self.bars.iter().filter(rival).any(|l| near(l) && distance(rect, l.bar) - l.bar.half_width_mm < own - TIE_MM)
            }
            Target::Arc { .. } => false,
        }
    }

    /// The part of a place's cost that does not depend on other labels.
    pub(super) fn fixed(&self, c: &Candidate) -> f64 {
        let mut cost = c.base;
        let look = own_distance(c.rect, self.wanted.target) + NEARER_MARGIN_MM;
        let mut nearer: f64 = 0.0;
        for Line { bar, bounds, own, meets } in &self.bars {
            let grown = c.rect.grown(bar.half_width_mm + AIR_MM);
            // A line that is farther off than the nearest so far changes nothing.
            if !touch(grown.grown(look - nearer), *bounds) {
                continue;
            }
            let covered = if touch(grown, *bounds) { clipped_mm(bar.from, bar.to, grown) } else { 0.0 };
            if covered > 0.0 {
                let factor = match (*own, bar.half_width_mm >= THICK_HALF_MM) {
                    (true, false) => OWN_FACTOR,
                    (true | false, true) => THICK_FACTOR,
                    (false, false) if bar.faint => FAINT_FACTOR,
                    (false, false) => 1.0,
                };
                cost += (TOUCH + PER_MM * covered) * factor;
            } else if !own && !meets && NEARER_PER_MM * nearer < NEARER_MAX {
                let foreign = distance(c.rect, bar) - bar.half_width_mm;
                nearer = nearer.max(look - foreign);
            }
        }
        cost += (NEARER_PER_MM * nearer).min(NEARER_MAX);
        if c.leader.is_none() && self.strays(c.rect) {
            cost += STRAYS - (NEARER_PER_MM * nearer).min(NEARER_MAX);
        }
        for head in &self.heads {
            let grown = c.rect.grown(head.half_width_mm + AIR_MM);
            if !far_apart(grown, head) {
                let covered = clipped_mm(head.from, head.to, grown);
                if covered > 0.0 {
                    cost += HEAD_FACTOR * (TOUCH + PER_MM * covered);
                }
            }
        }
        for disc in &self.discs {
            let depth = disc.radius_mm + AIR_MM - nearest(c.rect, disc.centre).distance(disc.centre);
            if depth > 0.0 {
                cost += TOUCH + PER_DEPTH * depth;
            }
        }
        for rect in &self.rects {
            let area = rect.overlap_mm2(c.rect.grown(AIR_MM));
            if area > 0.0 {
                cost += TOUCH + PER_DEPTH * area;
            }
        }
        cost += outside(c.rect, self.paper);
        cost + c.leader.map_or(0.0, |leader| self.across(leader))
    }

    /// What a leader line costs by what it crosses, from its label to its thing.
    fn across(&self, (a, b): (Point, Point)) -> f64 {
        let reach = Rect::new(a, b);
        let near = self.bars.iter().filter(|l| !l.own && !l.meets && touch(reach, l.bounds));
        let crossed = near.filter(|l| crosses(a, b, l.bar.from, l.bar.to));
        let texts = self.rects.iter().filter(|r| clipped_mm(a, b, ***r) > 0.0);
        let barred = self.barred.iter().any(|bar| is_barred((a, b), bar));
        LEADER_CROSSES * crossed.count() as f64 + TOUCH * texts.count() as f64 + if barred { BARRED } else { 0.0 }
    }
}

/// Whether a leader line, from its label to its thing, crosses what none may cross.
pub(super) fn is_barred((a, b): (Point, Point), bar: &Bar) -> bool {
    let before_dot = b + (a - b).unit().unwrap_or(Vec2::ZERO) * DOT_MM;
    crosses(a, before_dot, bar.from, bar.to)
}

/// The marked places that are not the label's own.
fn rivals(wanted: &Wanted, obstacles: &Obstacles) -> impl Iterator<Item = Point> {
    let own = match wanted.target {
        Target::Point { at, .. } => Some(at),
        Target::Segment { .. } | Target::Arc { .. } => None,
    };
    obstacles.marks.iter().copied().filter(move |p| own.is_some_and(|at| at.distance(*p) > ONE_MARK_MM))
}

/// Whether a label there lies on something that it would make unreadable, or that would make it so: an arrowhead, a symbol, a
/// foreign line as thick as the label's own. A thin line through it does neither.
pub(super) fn hides(rect: Rect, wanted: &Wanted, obstacles: &Obstacles) -> bool {
    let own_half_mm = match wanted.target {
        Target::Segment { clear_mm, .. } | Target::Arc { clear_mm, .. } => clear_mm,
        Target::Point { .. } => 0.0,
    };
    let foreign = |bar: &&Bar| bar.owner.is_none() || bar.owner != wanted.owner;
    let under = |bar: &Bar| clipped_mm(bar.from, bar.to, rect.grown(bar.half_width_mm)) > 0.0;
    obstacles.bars.iter().filter(foreign).any(|bar| bar.half_width_mm >= own_half_mm && under(bar))
        || obstacles.heads.iter().any(under)
        || obstacles.discs.iter().any(|d| nearest(rect, d.centre).distance(d.centre) < d.radius_mm)
        || obstacles.rects.iter().any(|r| r.overlap_mm2(rect) > 0.0)
}

/// Whether a label there would be read as the name of another line: one as thick as its own is nearer. A leader line tells.
pub(super) fn strays(c: Rect, leader: bool, wanted: &Wanted, obstacles: &Obstacles) -> bool {
    let Target::Segment { clear_mm, .. } = wanted.target else { return false };
    let c = wanted.ink(c);
    let own = own_distance(c, wanted.target);
    let reach = c.grown(own);
    let rival = |bar: &Bar| {
        let foreign = bar.owner.is_none() || bar.owner != wanted.owner;
        foreign && bar.half_width_mm >= clear_mm && touch(reach.grown(bar.half_width_mm), Rect::new(bar.from, bar.to))
    };
    !leader
        && obstacles.bars.iter().any(|bar| rival(bar) && !meets(bar, wanted.target) && distance(c, bar) - bar.half_width_mm < own - TIE_MM)
}

/// What it costs to leave the paper.
pub(super) fn outside(rect: Rect, paper: Rect) -> f64 {
    if rect.overlap_mm2(paper) < rect.width_mm() * rect.height_mm() - 1e-9 { OUTSIDE } else { 0.0 }
}

/// What two places cost beside one another.
#[inline]
pub(super) fn pair(a: &Candidate, b: &Candidate) -> f64 {
    if !close(a.reach, b.reach) {
        return 0.0;
    }
    let (ra, rb) = (a.rect.grown(PAIR_AIR_MM), b.rect.grown(PAIR_AIR_MM));
    let area = ra.overlap_mm2(rb);
    let mut cost = if area > 0.0 { OVERLAP + OVERLAP_PER_MM2 * area } else { 0.0 };
    if a.reads != b.reads && (is_factor(a, b) || is_factor(b, a)) {
        cost += FACTOR;
    } else if is_beside(a.rect, b.rect) {
        cost += BESIDE;
    }
    if a.leader.is_none() && b.leader.is_none() { cost } else { cost + across([a, b], [ra, rb]) }
}

/// Whether a number stands on one line with a quantity and close behind it.
fn is_factor(quantity: &Candidate, number: &Candidate) -> bool {
    let (q, n) = (quantity.rect, number.rect);
    let level = q.max.y.min(n.max.y) - q.min.y.max(n.min.y) > LEVEL_PART * n.height_mm();
    let behind = (0.0..FACTOR_MM).contains(&(n.min.x - q.max.x));
    quantity.reads == Reads::Quantity && number.reads == Reads::Number && level && behind
}

/// Whether two names stand on one line and are read as one.
pub(super) fn is_beside(a: Rect, b: Rect) -> bool {
    let least = a.height_mm().min(b.height_mm());
    let level = a.max.y.min(b.max.y) - a.min.y.max(b.min.y) > BESIDE_LEVEL * least;
    level && (b.min.x - a.max.x).max(a.min.x - b.max.x) < BESIDE_PART * least
}

/// What it costs that leader lines run across the labels and one another.
fn across([a, b]: [&Candidate; 2], [ra, rb]: [Rect; 2]) -> f64 {
    let mut cost = 0.0;
    for (leader, rect) in [(a.leader, rb), (b.leader, ra)] {
        if leader.is_some_and(|(p, q)| touch(rect, Rect::new(p, q)) && inside(p, q, rect).is_some()) {
            cost += OVERLAP;
        }
    }
    if let (Some((p, q)), Some((r, s))) = (a.leader, b.leader)
        && crosses(p, q, r, s)
    {
        cost += LEADER_CROSSES;
    }
    cost
}

/// Whether places within two boxes can meet, or stand beside each other.
pub(super) fn close(a: Rect, b: Rect) -> bool {
    let air = (BESIDE_PART * a.height_mm().min(b.height_mm())).max(2.0 * PAIR_AIR_MM);
    touch(a.grown(air), b)
}

/// Whether a line ends or passes at the target: then to stand near it is to stand near the own point.
fn meets(bar: &Bar, target: Target) -> bool {
    match target {
        Target::Point { at, clear_mm } => to_segment(at, bar.from, bar.to) <= clear_mm + bar.half_width_mm,
        // Another line between the same two points, such as the one under a vector.
        Target::Segment { from, to, clear_mm } => {
            let slack = clear_mm + bar.half_width_mm;
            to_segment(bar.from, from, to) <= slack && to_segment(bar.to, from, to) <= slack
        }
        Target::Arc { .. } => false,
    }
}

fn own_distance(rect: Rect, target: Target) -> f64 {
    match target {
        Target::Point { at, clear_mm } => (nearest(rect, at).distance(at) - clear_mm).max(0.0),
        Target::Segment { from, to, clear_mm } => {
            (distance(rect, &Bar { from, to, half_width_mm: 0.0, owner: None, faint: false }) - clear_mm).max(0.0)
        }
        Target::Arc { centre, radius_mm, clear_mm, .. } => {
            let (near, mid) = (nearest(rect, centre).distance(centre), rect.centre().distance(centre));
            // Outside the circle the near side counts, inside the far one, which lies half a diagonal beyond the middle.
            let far = mid + rect.min.distance(rect.max) / 2.0;
            ((near - radius_mm).max(radius_mm - far) - clear_mm).max(0.0)
        }
    }
}

fn far_apart(rect: Rect, bar: &Bar) -> bool {
    !touch(rect, Rect::new(bar.from, bar.to))
}

fn touch(a: Rect, b: Rect) -> bool {
    a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y
}

/// Length of the segment inside the box.
pub(super) fn clipped_mm(a: Point, b: Point, rect: Rect) -> f64 {
    inside(a, b, rect).map_or(0.0, |[t0, t1]| (t1 - t0) * (b - a).norm())
}

/// The part of a segment inside the box; one of no length has none.
pub(super) fn clipped(a: Point, b: Point, rect: Rect) -> Option<(Point, Point)> {
    inside(a, b, rect).map(|[t0, t1]| (a + (b - a) * t0, a + (b - a) * t1))
}

/// From which part of a segment to which it is inside the box (Liang and Barsky's clipping).
#[inline]
fn inside(a: Point, b: Point, rect: Rect) -> Option<[f64; 2]> {
    let d = b - a;
    let (mut t0, mut t1) = (0.0_f64, 1.0_f64);
    for (p, lo, hi) in [(d.x, rect.min.x - a.x, rect.max.x - a.x), (d.y, rect.min.y - a.y, rect.max.y - a.y)] {
        // Exactly parallel to the side: outside for good, or no bound from it; any other slope divides safely.
        if p == 0.0 {
            if lo > 0.0 || hi < 0.0 {
                return None;
            }
        } else {
            let (near, far) = if p > 0.0 { (lo / p, hi / p) } else { (hi / p, lo / p) };
            t0 = t0.max(near);
            t1 = t1.min(far);
        }
    }
    (t1 > t0).then_some([t0, t1])
}

/// Distance from a box to a segment; 0 where they meet.
fn distance(rect: Rect, bar: &Bar) -> f64 {
    if clipped_mm(bar.from, bar.to, rect) > 0.0 {
        return 0.0;
    }
    let corners = [rect.min, rect.max, Point::new(rect.min.x, rect.max.y), Point::new(rect.max.x, rect.min.y)];
    let by_end = [bar.from, bar.to].into_iter().fold(f64::INFINITY, |least, p| least.min((nearest(rect, p) - p).norm2()));
    corners.into_iter().fold(by_end, |least, c| least.min(to_segment2(c, bar.from, bar.to))).sqrt()
}

/// Distance of the edges of two bars; negative where one lies on the other, of bars that cross minus infinity.
pub(super) fn bars_apart(a: &Bar, b: &Bar) -> f64 {
    if crosses(a.from, a.to, b.from, b.to) {
        return f64::NEG_INFINITY;
    }
    let middles = [(a.from, b), (a.to, b), (b.from, a), (b.to, a)].map(|(p, bar)| to_segment(p, bar.from, bar.to));
    middles.into_iter().fold(f64::INFINITY, f64::min) - a.half_width_mm - b.half_width_mm
}

/// Distance of a point from the edge of a bar.
pub(super) fn to_bar(p: Point, bar: &Bar) -> f64 {
    to_segment(p, bar.from, bar.to) - bar.half_width_mm
}

fn to_segment(p: Point, a: Point, b: Point) -> f64 {
    to_segment2(p, a, b).sqrt()
}

/// The square of the distance from a point to a segment (mm²).
fn to_segment2(p: Point, a: Point, b: Point) -> f64 {
    let d = b - a;
    let n2 = d.norm2();
    let t = if n2 > 0.0 { ((p - a).dot(d) / n2).clamp(0.0, 1.0) } else { 0.0 };
    (a + d * t - p).norm2()
}

fn crosses(a: Point, b: Point, c: Point, d: Point) -> bool {
    let side = |p: Point, q: Point, r: Point| (q - p).cross(r - p);
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}
