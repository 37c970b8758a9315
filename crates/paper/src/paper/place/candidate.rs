//! Candidate places of a label.

use std::f64::consts::{FRAC_PI_4, TAU};
use std::sync::LazyLock;

use crate::paper::extent::Rect;
use hodograph_base::geom::{Point, Vec2};

use super::{MeasuredRequest, Reads, Target};

/// A candidate place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CandidatePlace {
    /// Box of the label's ink at this place.
    pub rect: Rect,
    /// Leader line from the label to its target.
    pub leader: Option<(Point, Point)>,
    /// Box around label and leader line.
    pub reach: Rect,
    /// Cost of the place before anything is covered.
    pub base: f64,
    /// The role of the label beside another one on the same line.
    pub reads: Reads,
}

/// Width of two letters: a number farther off is not read as a factor.
pub(super) const FACTOR_MM: f64 = 4.0;

impl CandidatePlace {
    /// Returns a place.
    pub fn new(rect: Rect, leader: Option<(Point, Point)>, base: f64) -> CandidatePlace {
        let reach = leader.map_or(rect, |(a, b)| rect.union(Rect::new(a, b)));
        CandidatePlace { rect, leader, reach, base, reads: Reads::Alone }
    }

    /// Returns the place with the role of its label beside another one.
    pub fn read_as(mut self, reads: Reads) -> CandidatePlace {
        self.reads = reads;
        if reads == Reads::Quantity {
            self.reach.max.x = self.reach.max.x.max(self.rect.max.x + FACTOR_MM);
        }
        self
    }
}

/// Number of directions around a point.
const DIRECTIONS: usize = 16;
/// Gaps between a point's symbol and its label, and the cost of each.
const POINT_GAPS: [(f64, f64); 3] = [(0.6, 0.0), (1.3, 1.0), (2.4, 2.6)];
/// Positions along a line, as fractions of its length. The ends are left to the labels of the
/// points.
const STATIONS: [f64; 7] = [0.5, 0.42, 0.58, 0.34, 0.66, 0.26, 0.74];
/// Gaps between a line and its label, and the cost of each.
const LINE_GAPS: [(f64, f64); 2] = [(0.9, 0.0), (1.7, 0.9)];
/// Cost per unit of the distance of a position from the line's middle, as a fraction of the length:
/// cheaper than the next larger gap.
const STATION_COST: f64 = 3.0;
/// Cost of the inside of an arc, where the lines of an angle are.
const INSIDE_COST: f64 = 1.2;
/// Cost of the direction opposite to a requested one.
const PREFER_COST: f64 = 2.4;
/// Cost of the direction opposite to the default one: enough to decide between equal places, too
/// little to choose a place farther off.
const DEFAULT_COST: f64 = 0.5;
/// Lengths of leader lines and their costs: more than any cost of nearness, less than covering a
/// line's width.
const LEADERS: [(f64, f64); 3] = [(5.0, 3.5), (8.0, 4.2), (12.0, 5.0)];
/// Lengths and costs of leader lines used if none of [`LEADERS`] ends at a clear place.
const LONG_LEADERS: [(f64, f64); 2] = [(17.0, 5.8), (22.0, 6.6)];

/// Lengths and costs of leader lines in the directions between those of [`DIRECTIONS`].
const BETWEEN: [(f64, f64); 6] =
    [(3.5, 3.6), (6.5, 4.0), (10.0, 4.7), (14.0, 5.4), (19.0, 6.1), (26.0, 7.2)];

/// Lengths and costs of leader lines for a label that still covers something: spaced as closely as
/// places are distinguishable, and as long as a sheet allows.
const ANYWHERE: [(f64, f64); 8] = [
    (4.5, 5.0),
    (7.0, 5.4),
    (10.5, 5.8),
    (14.0, 6.2),
    (18.0, 6.6),
    (22.0, 7.0),
    (27.0, 7.5),
    (33.0, 7.9),
];
/// Number of directions for [`ANYWHERE`], and the positions of these leader lines' ends on a line
/// or an arc.
const MANY_DIRECTIONS: usize = 32;
const ALL_ALONG: [f64; 5] = [0.5, 0.3, 0.7, 0.1, 0.9];

/// Further positions of the ends of leader lines on a line or an arc, beside its middle.
const ASIDE: [f64; 2] = [0.3, 0.7];

/// Cosine of the smallest angle between such a leader line and its own vector: 30°.
const ACROSS: f64 = 0.866;

/// Returns the places near the target: 48 around a point, 28 along a segment or an arc.
pub(super) fn near(wanted: &MeasuredRequest) -> Vec<CandidatePlace> {
    match wanted.target {
        Target::Point { at, clear_mm } => {
            let mut all = Vec::with_capacity(DIRECTIONS * POINT_GAPS.len());
            for (gap, base) in POINT_GAPS {
                for &u in directions() {
                    let rect = wanted.rect(at + u * reach(u, wanted, clear_mm + gap));
                    all.push(CandidatePlace::new(rect, None, base + side_cost(u, wanted)));
                }
            }
            all
        }
        Target::Segment { from, to, clear_mm } => {
            // A segment of length zero has no sides; the label goes above or below it.
            let along = (to - from).unit().unwrap_or(Vec2::new(1.0, 0.0));
            let normal = along.perp();
            let half =
                normal.x.abs() * wanted.half_width_mm + normal.y.abs() * wanted.half_height_mm;
            let mut all = Vec::with_capacity(2 * STATIONS.len() * LINE_GAPS.len());
            for (gap, base) in LINE_GAPS {
                for t in STATIONS {
                    for side in [normal, -normal] {
                        let on = from + (to - from) * t;
                        let rect = wanted.rect(on + side * (half + clear_mm + gap));
                        all.push(CandidatePlace::new(
                            rect,
                            None,
                            base + STATION_COST * (t - 0.5).abs() + side_cost(side, wanted),
                        ));
                    }
                }
            }
            all
        }
        Target::Arc { centre, radius_mm, from_rad, to_rad, clear_mm } => {
            let mut all = Vec::with_capacity(2 * STATIONS.len() * LINE_GAPS.len());
            for (gap, base) in LINE_GAPS {
                for t in STATIONS {
                    let u = Vec2::from_angle(from_rad + (to_rad - from_rad) * t);
                    let outside = reach(u, wanted, radius_mm + clear_mm + gap);
                    // Inside, the farthest corner of the box must stay in the circle; half the
                    // diagonal as distance guarantees this.
                    let inside = radius_mm
                        - clear_mm
                        - gap
                        - libm::hypot(wanted.half_width_mm, wanted.half_height_mm);
                    for (t_mm, side, off) in [(outside, u, 0.0), (inside, -u, INSIDE_COST)] {
                        let rect = wanted.rect(centre + u * t_mm);
                        let base = base + off + STATION_COST * (t - 0.5).abs();
                        let wish =
                            if wanted.prefer.is_some() { side_cost(side, wanted) } else { 0.0 };
                        all.push(CandidatePlace::new(rect, None, base + wish));
                    }
                }
            }
            all
        }
    }
}

/// Returns places farther off, with a leader line.
pub(super) fn far(wanted: &MeasuredRequest) -> Vec<CandidatePlace> {
    led(wanted, &LEADERS, directions())
}

/// Returns places so far off that the reader must follow the leader line to find its end.
pub(super) fn farthest(wanted: &MeasuredRequest) -> Vec<CandidatePlace> {
    led(wanted, &LONG_LEADERS, directions())
}

/// Returns places with a leader line in intermediate directions, for a label without a clear place.
pub(super) fn between(wanted: &MeasuredRequest) -> Vec<CandidatePlace> {
    static ALL: LazyLock<[Vec2; DIRECTIONS]> = LazyLock::new(|| {
        std::array::from_fn(|k| Vec2::from_angle((k as f64 + 0.5) * TAU / DIRECTIONS as f64))
    });
    match wanted.target {
        Target::Point { .. } => led(wanted, &BETWEEN, &*ALL),
        Target::Segment { from, to, .. } => {
            let along = (to - from).unit().unwrap_or(Vec2::ZERO);
            let mut all = led(wanted, &BETWEEN, &across(along, &*ALL));
            let aside = across(along, directions());
            all.extend(
                ASIDE
                    .iter()
                    .flat_map(|t| led_from(from + (to - from) * *t, 0.0, wanted, &LEADERS, &aside)),
            );
            all
        }
        Target::Arc { centre, radius_mm, from_rad, to_rad, .. } => {
            let mut all = led(wanted, &BETWEEN, &*ALL);
            let off = |t: f64| Vec2::from_angle(from_rad + (to_rad - from_rad) * t);
            let aside = |t: f64| {
                led_from(
                    centre + off(t) * radius_mm,
                    0.0,
                    wanted,
                    &LEADERS,
                    &across(off(t).perp(), directions()),
                )
            };
            all.extend(ASIDE.iter().flat_map(|t| aside(*t)));
            all
        }
    }
}

/// Returns places with a leader line to any part of the target, for a label that would cover a
/// thick line or have a barred leader line.
pub(super) fn anywhere(wanted: &MeasuredRequest) -> Vec<CandidatePlace> {
    static ALL: LazyLock<[Vec2; MANY_DIRECTIONS]> = LazyLock::new(|| {
        std::array::from_fn(|k| Vec2::from_angle((k as f64 + 0.5) * TAU / MANY_DIRECTIONS as f64))
    });
    match wanted.target {
        Target::Point { .. } => led(wanted, &ANYWHERE, &*ALL),
        Target::Segment { from, to, .. } => {
            let aside = across((to - from).unit().unwrap_or(Vec2::ZERO), &*ALL);
            ALL_ALONG
                .iter()
                .flat_map(|t| led_from(from + (to - from) * *t, 0.0, wanted, &ANYWHERE, &aside))
                .collect()
        }
        Target::Arc { centre, radius_mm, from_rad, to_rad, .. } => {
            let off = |t: f64| Vec2::from_angle(from_rad + (to_rad - from_rad) * t);
            let aside = |t: f64| {
                led_from(
                    centre + off(t) * radius_mm,
                    0.0,
                    wanted,
                    &ANYWHERE,
                    &across(off(t).perp(), &*ALL),
                )
            };
            ALL_ALONG.iter().flat_map(|t| aside(*t)).collect()
        }
    }
}

/// Returns the directions at an angle to a line: a leader line along it would be invisible.
fn across(line: Vec2, directions: &[Vec2]) -> Vec<Vec2> {
    directions.iter().copied().filter(|u| u.dot(line).abs() < ACROSS).collect()
}

fn led(
    wanted: &MeasuredRequest,
    leaders: &[(f64, f64)],
    directions: &[Vec2],
) -> Vec<CandidatePlace> {
    let (at, clear_mm) = match wanted.target {
        Target::Point { at, clear_mm } => (at, clear_mm),
        Target::Segment { from, to, .. } => (from + (to - from) * 0.5, 0.0),
        Target::Arc { centre, radius_mm, from_rad, to_rad, .. } => {
            let out = Vec2::from_angle((from_rad + to_rad) / 2.0);
            return led_from(
                centre + out * radius_mm,
                0.0,
                wanted,
                leaders,
                &across(out.perp(), directions),
            );
        }
    };
    led_from(at, clear_mm, wanted, leaders, directions)
}

/// Returns places with leader lines that end `clear_mm` from a point.
fn led_from(
    at: Point,
    clear_mm: f64,
    wanted: &MeasuredRequest,
    leaders: &[(f64, f64)],
    directions: &[Vec2],
) -> Vec<CandidatePlace> {
    let mut all = Vec::with_capacity(DIRECTIONS * leaders.len());
    for &(length, base) in leaders {
        for &u in directions {
            let t = reach(u, wanted, clear_mm + length);
            let rect = wanted.rect(at + u * t);
            let near = nearest(rect, at);
            let Some(back) = (near - at).unit() else { continue };
            // A gap at the letters, none at the target.
            let leader = (near - back * 0.5, at + back * clear_mm);
            all.push(CandidatePlace::new(rect, Some(leader), base + side_cost(u, wanted)));
        }
    }
    all
}

fn directions() -> &'static [Vec2; DIRECTIONS] {
    static ALL: LazyLock<[Vec2; DIRECTIONS]> = LazyLock::new(|| {
        std::array::from_fn(|k| Vec2::from_angle(k as f64 * TAU / DIRECTIONS as f64))
    });
    &ALL
}

/// Returns the distance along `u` from the origin to the centre of a box at which the box is
/// `clear_mm` from the origin.
fn reach(u: Vec2, wanted: &MeasuredRequest, clear_mm: f64) -> f64 {
    let (ux, uy, hw, hh) = (u.x.abs(), u.y.abs(), wanted.half_width_mm, wanted.half_height_mm);
    // A side of the box faces the origin, …
    if ux * (hh + clear_mm) <= uy * hw {
        return (hh + clear_mm) / uy;
    }
    if uy * (hw + clear_mm) <= ux * hh {
        return (hw + clear_mm) / ux;
    }
    // … or a corner.
    let b = ux * hw + uy * hh;
    b + (b * b - hw * hw - hh * hh + clear_mm * clear_mm).max(0.0).sqrt()
}

fn side_cost(u: Vec2, wanted: &MeasuredRequest) -> f64 {
    let (side, cost) = wanted
        .prefer
        .map_or((Vec2::from_angle(FRAC_PI_4), DEFAULT_COST), |side| (side, PREFER_COST));
    cost * (1.0 - u.dot(side)) / 2.0
}

/// Returns the point of a box nearest to `p`.
pub(super) fn nearest(rect: Rect, p: Point) -> Point {
    Point::new(p.x.max(rect.min.x).min(rect.max.x), p.y.max(rect.min.y).min(rect.max.y))
}
