//! Costs of places, in millimetres of foreign line covered.

use crate::paper::extent::Rect;
use hodograph_base::geom::{Point, Vec2};

use super::candidate::{CandidatePlace, FACTOR_MM, nearest};
use super::obstacle::{Bar, InkDisc, Obstacles};
use super::{MeasuredRequest, Reads, Target};

/// Cost of first touching an object: more than the costliest place near the target (6.4), so that
/// touching is never preferred.
pub(super) const TOUCH: f64 = 8.0;
/// Margin of a label around its ink, so that a line beside it is visibly beside it.
const AIR_MM: f64 = 0.5;
/// Cost per millimetre of a line under a label.
const PER_MM: f64 = 1.0;
/// Factor of a bar or a vector under a label: worse than a thin line, so that a leader line across
/// two lines is preferred.
pub(super) const THICK_FACTOR: f64 = 1.5;
/// Half the width from which a line counts as thick.
const THICK_HALF_MM: f64 = 0.165;
/// Factor of a faint line: crossing it is preferred to a leader line.
const FAINT_FACTOR: f64 = 0.5;
/// Factor of an arrowhead, which the reader looks for.
const HEAD_FACTOR: f64 = 2.0;
/// Factor of the label's own thin line through its letters: not misleading, but equally hard to
/// read.
const OWN_FACTOR: f64 = 0.9;
/// Cost per millimetre of a disc's depth and per square millimetre of a box.
const PER_DEPTH: f64 = 2.0;
/// Cost of leaving the paper: more than any place on it.
const OUTSIDE: f64 = 200.0;
/// Cost per millimetre by which a foreign line is nearer than the label's own target plus a margin.
const NEARER_PER_MM: f64 = 1.8;
/// Margin by which foreign lines must be farther off than the target so as not to be mistaken for
/// it.
const NEARER_MARGIN_MM: f64 = 0.8;
/// Upper bound of the nearness cost: less than touching.
const NEARER_MAX: f64 = 4.0;
/// Cost of a foreign mark nearer than the own one, or of a line as thick as the own one that is
/// nearer: more than the longest leader line with foreign lines beside its label, less than
/// covering a thick line.
const STRAYS: f64 = 14.0;
/// Tolerance for lines that lie on top of each other: rounding must not make one of them the nearer
/// one.
const TIE_MM: f64 = 1e-6;
/// Letters within this distance of one point belong to one mark.
const ONE_MARK_MM: f64 = 0.15;
/// Cost of a leader line that crosses a line, or another leader line.
const LEADER_CROSSES: f64 = 2.5;
/// Cost of a leader line through hatching or the arc of an angle: more than anything except another
/// label.
const BARRED: f64 = 20.0;
/// Length at the end of a leader line, for its dot, that may lie on such an arc if it is the named
/// one.
const DOT_MM: f64 = 0.6;
/// Cost of the overlap of two labels, and per square millimetre of it.
const OVERLAP: f64 = 25.0;
const OVERLAP_PER_MM2: f64 = 2.0;
/// Cost of a number that would be read as the factor of a quantity: more than a leader line.
const FACTOR: f64 = 7.0;
/// Cost of two names in one line, so close that they look like one name or a product: decides only
/// between places of similar cost.
const BESIDE: f64 = 1.2;
/// Largest gap of such names, as a fraction of the lower one's height: somewhat more than a word
/// space.
const BESIDE_PART: f64 = 0.5;
/// Smallest vertical overlap, as a fraction of the lower one's height, at which two names look like
/// one line, even if their baselines differ.
const BESIDE_LEVEL: f64 = 0.2;
/// Smallest vertical overlap, as a fraction of the number's height, at which a number and a
/// quantity are on one line: somewhat less than the eye tolerates.
const LEVEL_PART: f64 = 0.4;
/// Margin around each of two labels.
const PAIR_AIR_MM: f64 = 0.3;

/// The obstacles around a label's places, collected once, so that each place is compared with few
/// that it does not touch.
pub(super) struct Around<'a> {
    wanted: &'a MeasuredRequest,
    paper: Rect,
    bars: Vec<NearbyLine<'a>>,
    heads: Vec<&'a Bar>,
    discs: Vec<&'a InkDisc>,
    rects: Vec<&'a Rect>,
    barred: Vec<&'a Bar>,
    rivals: Vec<Point>,
}

/// A line near a label's places.
struct NearbyLine<'a> {
    bar: &'a Bar,
    bounds: Rect,
    own: bool,
    meets: bool,
}

impl<'a> Around<'a> {
    /// Collects all obstacles that can make one of these places costlier.
    pub(super) fn new(
        places: &[CandidatePlace],
        wanted: &'a MeasuredRequest,
        obstacles: &'a Obstacles,
        paper: Rect,
    ) -> Around<'a> {
        let looks = places.iter().map(|c| {
            c.reach.union(c.rect.grown(own_distance(c.rect, wanted.target) + NEARER_MARGIN_MM))
        });
        let Some(reach) = looks.reduce(Rect::union).map(|r| r.grown(AIR_MM)) else {
            return Around {
                wanted,
                paper,
                bars: vec![],
                heads: vec![],
                discs: vec![],
                rects: vec![],
                barred: vec![],
                rivals: vec![],
            };
        };
        let led = places.iter().any(|c| c.leader.is_some());
        let near = |bar: &&Bar| !far_apart(reach.grown(bar.half_width_mm), bar);
        let line = |bar: &'a Bar| {
            let own = bar.owner.is_some() && bar.owner == wanted.owner;
            NearbyLine {
                bar,
                bounds: Rect::new(bar.from, bar.to),
                own,
                meets: !own && meets(bar, wanted.target),
            }
        };
        let touched = |d: &&InkDisc| nearest(reach, d.centre).distance(d.centre) <= d.radius_mm;
        Around {
            wanted,
            paper,
            bars: obstacles.bars.iter().filter(near).map(line).collect(),
            heads: obstacles.heads.iter().filter(near).collect(),
            discs: obstacles.discs.iter().filter(touched).collect(),
            rects: obstacles.rects.iter().filter(|r| r.overlap_mm2(reach) > 0.0).collect(),
            barred: obstacles.barred.iter().filter(|bar| led && near(bar)).collect(),
            rivals: rivals(wanted, obstacles)
                .filter(|p| nearest(reach, *p).distance(*p) <= reach.width_mm())
                .collect(),
        }
    }

    /// Returns true if another mark, or another line as thick, is nearer than the label's own
    /// target.
    fn strays(&self, rect: Rect) -> bool {
        let rect = self.wanted.ink(rect);
        match self.wanted.target {
            Target::Point { at, .. } => {
                let own = nearest(rect, at).distance(at);
                self.rivals.iter().any(|p| nearest(rect, *p).distance(*p) < own - TIE_MM)
            }
            Target::Segment { clear_mm, .. } => {
                let own = own_distance(rect, self.wanted.target);
                let rival = |l: &&NearbyLine| !l.own && !l.meets && l.bar.half_width_mm >= clear_mm;
                let near = |l: &NearbyLine| touch(rect.grown(own + l.bar.half_width_mm), l.bounds);
                self.bars
                    .iter()
                    .filter(rival)
                    .any(|l| near(l) && distance(rect, l.bar) - l.bar.half_width_mm < own - TIE_MM)
            }
            Target::Arc { .. } => false,
        }
    }

    /// Returns the part of a place's cost that is independent of other labels.
    pub(super) fn fixed(&self, c: &CandidatePlace) -> f64 {
        let mut cost = c.base;
        let look = own_distance(c.rect, self.wanted.target) + NEARER_MARGIN_MM;
        let mut nearer: f64 = 0.0;
        for NearbyLine { bar, bounds, own, meets } in &self.bars {
            let grown = c.rect.grown(bar.half_width_mm + AIR_MM);
            // A line farther off than the nearest one so far changes nothing.
            if !touch(grown.grown(look - nearer), *bounds) {
                continue;
            }
            let covered =
                if touch(grown, *bounds) { clipped_mm(bar.from, bar.to, grown) } else { 0.0 };
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
            let depth =
                disc.radius_mm + AIR_MM - nearest(c.rect, disc.centre).distance(disc.centre);
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

    /// Returns the cost of what a leader line crosses, from its label to its target.
    fn across(&self, (a, b): (Point, Point)) -> f64 {
        let reach = Rect::new(a, b);
        let near = self.bars.iter().filter(|l| !l.own && !l.meets && touch(reach, l.bounds));
        let crossed = near.filter(|l| crosses(a, b, l.bar.from, l.bar.to));
        let texts = self.rects.iter().filter(|r| clipped_mm(a, b, ***r) > 0.0);
        let barred = self.barred.iter().any(|bar| is_barred((a, b), bar));
        LEADER_CROSSES * crossed.count() as f64
            + TOUCH * texts.count() as f64
            + if barred { BARRED } else { 0.0 }
    }
}

/// Returns true if a leader line, from its label to its target, crosses a barred line.
pub(super) fn is_barred((a, b): (Point, Point), bar: &Bar) -> bool {
    let before_dot = b + (a - b).unit().unwrap_or(Vec2::ZERO) * DOT_MM;
    crosses(a, before_dot, bar.from, bar.to)
}

/// Returns the marked points except the label's own.
fn rivals(wanted: &MeasuredRequest, obstacles: &Obstacles) -> impl Iterator<Item = Point> {
    let own = match wanted.target {
        Target::Point { at, .. } => Some(at),
        Target::Segment { .. } | Target::Arc { .. } => None,
    };
    obstacles
        .marks
        .iter()
        .copied()
        .filter(move |p| own.is_some_and(|at| at.distance(*p) > ONE_MARK_MM))
}

/// Returns true if a label at this place would make an object illegible, or be made so by it: an
/// arrowhead, a symbol, another label, or a foreign line as thick as the label's own. A thin line
/// through the label does neither.
pub(super) fn hides(rect: Rect, wanted: &MeasuredRequest, obstacles: &Obstacles) -> bool {
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

/// Returns true if a label at this place would be read as the name of another line, because one as
/// thick as its own is nearer. False with a leader line, which makes the target clear.
pub(super) fn strays(
    c: Rect,
    leader: bool,
    wanted: &MeasuredRequest,
    obstacles: &Obstacles,
) -> bool {
    let Target::Segment { clear_mm, .. } = wanted.target else { return false };
    let c = wanted.ink(c);
    let own = own_distance(c, wanted.target);
    let reach = c.grown(own);
    let rival = |bar: &Bar| {
        let foreign = bar.owner.is_none() || bar.owner != wanted.owner;
        foreign
            && bar.half_width_mm >= clear_mm
            && touch(reach.grown(bar.half_width_mm), Rect::new(bar.from, bar.to))
    };
    !leader
        && obstacles.bars.iter().any(|bar| {
            rival(bar)
                && !meets(bar, wanted.target)
                && distance(c, bar) - bar.half_width_mm < own - TIE_MM
        })
}

/// Returns the cost of leaving the paper.
pub(super) fn outside(rect: Rect, paper: Rect) -> f64 {
    if rect.overlap_mm2(paper) < rect.width_mm() * rect.height_mm() - 1e-9 { OUTSIDE } else { 0.0 }
}

/// Returns the cost of two places beside each other.
#[inline]
pub(super) fn pair(a: &CandidatePlace, b: &CandidatePlace) -> f64 {
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

/// Returns true if a number is on one line with a quantity and close behind it.
fn is_factor(quantity: &CandidatePlace, number: &CandidatePlace) -> bool {
    let (q, n) = (quantity.rect, number.rect);
    let level = q.max.y.min(n.max.y) - q.min.y.max(n.min.y) > LEVEL_PART * n.height_mm();
    let behind = (0.0..FACTOR_MM).contains(&(n.min.x - q.max.x));
    quantity.reads == Reads::Quantity && number.reads == Reads::Number && level && behind
}

/// Returns true if two names are on one line and are read as one.
pub(super) fn is_beside(a: Rect, b: Rect) -> bool {
    let least = a.height_mm().min(b.height_mm());
    let level = a.max.y.min(b.max.y) - a.min.y.max(b.min.y) > BESIDE_LEVEL * least;
    level && (b.min.x - a.max.x).max(a.min.x - b.max.x) < BESIDE_PART * least
}

/// Returns the cost of leader lines that cross the labels or each other.
fn across([a, b]: [&CandidatePlace; 2], [ra, rb]: [Rect; 2]) -> f64 {
    let mut cost = 0.0;
    for (leader, rect) in [(a.leader, rb), (b.leader, ra)] {
        if leader.is_some_and(|(p, q)| touch(rect, Rect::new(p, q)) && inside(p, q, rect).is_some())
        {
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

/// Returns true if places within two boxes can touch, or be beside each other on a line.
pub(super) fn close(a: Rect, b: Rect) -> bool {
    let air = (BESIDE_PART * a.height_mm().min(b.height_mm())).max(2.0 * PAIR_AIR_MM);
    touch(a.grown(air), b)
}

/// Returns true if a line ends at or passes the target: a label near it is then near its own
/// target.
fn meets(bar: &Bar, target: Target) -> bool {
    match target {
        Target::Point { at, clear_mm } => {
            to_segment(at, bar.from, bar.to) <= clear_mm + bar.half_width_mm
        }
        // Another line between the same points, such as the one under a vector.
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
            (distance(rect, &Bar { from, to, half_width_mm: 0.0, owner: None, faint: false })
                - clear_mm)
                .max(0.0)
        }
        Target::Arc { centre, radius_mm, clear_mm, .. } => {
            let (near, mid) =
                (nearest(rect, centre).distance(centre), rect.centre().distance(centre));
            // Outside the circle the near side counts; inside, the far side, which is half a
            // diagonal beyond the centre of the box.
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

/// Returns the length of the segment inside the box.
pub(super) fn clipped_mm(a: Point, b: Point, rect: Rect) -> f64 {
    inside(a, b, rect).map_or(0.0, |[t0, t1]| (t1 - t0) * (b - a).norm())
}

/// Returns the part of a segment inside the box; `None` for a segment of length zero.
pub(super) fn clipped(a: Point, b: Point, rect: Rect) -> Option<(Point, Point)> {
    inside(a, b, rect).map(|[t0, t1]| (a + (b - a) * t0, a + (b - a) * t1))
}

/// Returns the parameter interval of a segment inside the box (Liang–Barsky clipping).
#[inline]
fn inside(a: Point, b: Point, rect: Rect) -> Option<[f64; 2]> {
    let d = b - a;
    let (mut t0, mut t1) = (0.0_f64, 1.0_f64);
    for (p, lo, hi) in
        [(d.x, rect.min.x - a.x, rect.max.x - a.x), (d.y, rect.min.y - a.y, rect.max.y - a.y)]
    {
        // Exactly parallel to the side: entirely outside, or not bounded by it. Any other slope
        // divides safely.
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

/// Distance from a box to the axis of a bar; 0 if they meet.
fn distance(rect: Rect, bar: &Bar) -> f64 {
    if clipped_mm(bar.from, bar.to, rect) > 0.0 {
        return 0.0;
    }
    let corners = [
        rect.min,
        rect.max,
        Point::new(rect.min.x, rect.max.y),
        Point::new(rect.max.x, rect.min.y),
    ];
    let by_end = [bar.from, bar.to]
        .into_iter()
        .fold(f64::INFINITY, |least, p| least.min((nearest(rect, p) - p).norm2()));
    corners.into_iter().fold(by_end, |least, c| least.min(to_segment2(c, bar.from, bar.to))).sqrt()
}

/// Distance between the edges of two bars; negative if they overlap, minus infinity if they cross.
pub(super) fn bars_apart(a: &Bar, b: &Bar) -> f64 {
    if crosses(a.from, a.to, b.from, b.to) {
        return f64::NEG_INFINITY;
    }
    let middles = [(a.from, b), (a.to, b), (b.from, a), (b.to, a)]
        .map(|(p, bar)| to_segment(p, bar.from, bar.to));
    middles.into_iter().fold(f64::INFINITY, f64::min) - a.half_width_mm - b.half_width_mm
}

/// Distance of a point from the edge of a bar.
pub(super) fn to_bar(p: Point, bar: &Bar) -> f64 {
    to_segment(p, bar.from, bar.to) - bar.half_width_mm
}

fn to_segment(p: Point, a: Point, b: Point) -> f64 {
    to_segment2(p, a, b).sqrt()
}

/// Squared distance from a point to a segment (mm²).
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
