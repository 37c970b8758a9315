//! Places of a coupler point met exactly: the crank pin in each position, then the follower by
//! inversion.
//!
//! Either crank and BE are given: B_k is the intersection of the crank's circle and the circle
//! about E_k, on one side of AE_k. Or the crank's rotations are given for three places: E₂ and E₃,
//! turned back about A with the crank, are as far from B₁ as E₁ is, so that B₁ is the centre of the
//! circle through them. This determines all positions of the coupler. For three places, D moved
//! back with the coupler is on a circle about C₁. For four, D is the intersection of a line with
//! the centre-point curve of these positions ([`burmester`]); for five, D is one of Burmester's
//! points. The pair of B and A is among the results and is left out.

use super::sides::{Sides, told as sides_told};
use crate::body::burmester::{self, BurmesterPair};
use crate::body::pose::{BodyPose, centre};
use crate::candidate::{DesignNumber, Draft, WantedPosition};
use crate::fourbar::{FourBar, Heading, meet, named_lengths};
use crate::nearest::{number, told};
use hodograph_base::diag::{Both, both};
use hodograph_base::digits::metres;
use hodograph_base::geom::{Point, Vec2};

/// A pair of pin and pivot that differs from B and A by no more than this share of the size is
/// theirs.
const SAME: f64 = 1e-6;

/// B at each place, for crank and BE.
pub(super) fn pins(
    e: &[Point],
    a: Point,
    [crank, be]: [f64; 2],
    sides: &[bool],
) -> Result<Vec<Point>, Both> {
    let one = |(k, (at, left)): (usize, (&Point, &bool))| {
        meet(a, crank, *at, be, *left).ok_or_else(|| {
            let far = metres(a.distance(*at));
            both!("E{} is {} from A: crank and BE do not reach it", k + 1, far)
        })
    };
    e.iter().zip(sides).enumerate().map(one).collect()
}

/// The places of E turned back about A to the first position of the crank.
pub(super) fn turned_back(e: &[Point], a: Point, turns: &[f64]) -> Vec<Point> {
    e.iter()
        .zip(turns)
        .map(|(e, t)| a + (*e - a).rotate_by(Vec2::from_angle(turns[0] - t)))
        .collect()
}

/// B at three places that the crank reaches at given rotations.
pub(super) fn turned_pins(e: &[Point; 3], a: Point, turns: &[f64; 3]) -> Result<Vec<Point>, Both> {
    let back = turned_back(e, a, turns);
    let Some((b, _)) = centre(back[0], back[1], back[2]) else {
        return Err(both!(
            "E2 and E3, turned back with the crank, lie in line with E1: B would be infinitely far"
        ));
    };
    if b.distance(a) <= SAME * b.distance(e[0]) {
        return Err(both!("E turns about A with the crank: the crank would have no length"));
    }
    Ok((0..3).map(|k| a + (b - a).rotate_by(Vec2::from_angle(turns[k] - turns[0]))).collect())
}

/// D moved back with the coupler from position `k` into the first; the coupler's direction is that
/// of BE.
pub(super) fn back_to_first(d: Point, b: &[Point], e: &[Point], k: usize) -> Point {
    let local = (d - b[k]).divide_by(e[k] - b[k]);
    b[0] + local.rotate_by(e[0] - b[0])
}

/// C in the first of three positions.
pub(super) fn follower(e: &[Point], b: &[Point], d: Point) -> Result<Point, Both> {
    let [d2, d3] = [1, 2].map(|k| back_to_first(d, b, e, k));
    let found = centre(d, d2, d3);
    found.map(|c| c.0).ok_or_else(|| {
        both!("D, carried back into position 1, lies in line: C would be infinitely far")
    })
}

/// The pivots D and pins C: of four positions on a line, or of five.
pub(super) fn followers(
    e: &[Point],
    b: &[Point],
    a: Point,
    line: Option<(Point, Vec2)>,
) -> Vec<BurmesterPair> {
    let positions: Vec<BodyPose> =
        e.iter().zip(b).map(|(e, b)| BodyPose { origin: *e, angle: (*e - *b).angle() }).collect();
    let found = match line {
        Some((through, along)) => burmester::on_line(&positions, through, along),
        None => burmester::of_five(&positions),
    };
    let size = a.distance(e[0]).max(a.distance(b[0]));
    let own = |p: &BurmesterPair| {
        p.centre.distance(a) <= SAME * size && p.pin.distance(b[0]) <= SAME * size
    };
    found.into_iter().filter(|p| !own(p)).collect()
}

/// The linkage in the positions of its coupler, with C given in the first.
pub(super) fn draft(
    e: &[Point],
    b: &[Point],
    [a, d]: [Point; 2],
    c: Point,
    which: Both,
    heading: &Heading,
) -> Draft {
    let direction = |k: usize| e[k] - b[k];
    let carried = |k: usize| b[k] + (c - b[0]).divide_by(direction(0)).rotate_by(direction(k));
    let axis = (c - b[0]) * (1.0 / (c - b[0]).norm());
    let local = direction(0);
    let four = FourBar { a, b: b[0], c, d, e: Some(Vec2::new(axis.dot(local), axis.cross(local))) };
    let wanted = (0..e.len())
        .map(|k| WantedPosition {
            driver: (b[k] - a).angle(),
            places: vec![("B".into(), b[k]), ("C".into(), carried(k)), ("E".into(), e[k])],
        })
        .collect();
    let mut numbers = named_lengths(four.lengths());
    numbers.push(DesignNumber::length("BE", both!("B to E"), local.norm()));
    numbers.push(DesignNumber::length("CE", both!("C to E"), c.distance(e[0])));
    let mut places = vec![("B1", b[0]), ("C1", c)];
    if e.len() > 3 {
        places.push(("D", d));
    }
    for (name, at) in places {
        numbers.push(DesignNumber::length(&format!("{name}_x"), both!("place of {name}"), at.x));
        numbers.push(DesignNumber::length(&format!("{name}_y"), both!("place of {name}"), at.y));
    }
    numbers.extend(b.iter().enumerate().map(|(k, b)| {
        DesignNumber::angle(&format!("crank_{}", k + 1), both!("crank angle"), (*b - a).angle())
    }));
    Draft { ordered: true, ..Draft::new(which, four.scene(heading), numbers, wanted) }
}

/// Three places with crank and BE given.
pub(super) fn three(
    e: &[Point; 3],
    [a, d]: [Point; 2],
    lengths: [f64; 2],
    sides: &[bool],
    heading: &Heading,
) -> Result<Draft, Both> {
    let b = pins(e, a, lengths, sides)?;
    let c = follower(e, &b, d)?;
    Ok(draft(e, &b, [a, d], c, sides_told(sides), heading))
}

/// Three places at given rotations of the crank.
pub(super) fn turned(
    e: &[Point; 3],
    [a, d]: [Point; 2],
    turns: &[f64; 3],
    heading: &Heading,
) -> Result<Draft, Both> {
    let b = turned_pins(e, a, turns)?;
    let c = follower(e, &b, d)?;
    Ok(draft(e, &b, [a, d], c, both!("the only solution"), heading))
}

/// The nearest BE, else the nearest crank, with which the linkage reaches three places.
pub(super) fn nearest(
    e: &[Point; 3],
    pivots: [Point; 2],
    [crank, be]: [f64; 2],
    sides: &Sides,
    heading: &Heading,
) -> Both {
    let works = |lengths: [f64; 2]| {
        // A pivot of C farther away than a hundred times the frame does not count.
        let near = |draft: Draft| {
            draft.numbers.iter().all(|n| {
                n.name != "CD" || n.value < 100.0 * pivots[0].distance(pivots[1]).max(crank)
            })
        };
        lengths.iter().all(|l| *l > 0.0)
            && sides.all.iter().any(|s| three(e, pivots, lengths, s, heading).is_ok_and(near))
    };
    let scale = (pivots[0].distance(pivots[1]) + pivots[0].distance(e[0])) * 1e3;
    nearest_lengths(e, pivots[0], [crank, be], scale, works)
}

/// The nearest BE, crank, or both, for which a task works.
pub(super) fn nearest_lengths(
    e: &[Point],
    a: Point,
    [crank, be]: [f64; 2],
    scale: f64,
    works: impl Fn([f64; 2]) -> bool,
) -> Both {
    if let Some(mm) = number(be * 1e3, scale, |mm| works([crank, mm * 1e-3])) {
        return both!("\"BE\": \"{} mm\" does", told(mm));
    }
    if let Some(mm) = number(crank * 1e3, scale, |mm| works([mm * 1e-3, be])) {
        return both!("\"crank\": \"{} mm\" does", told(mm));
    }
    // With BE between the nearest and the farthest place, the shortest crank reaches all.
    let far = e.iter().map(|p| p.distance(a) * 1e3);
    let (low, high) = far.fold((f64::INFINITY, 0.0_f64), |(l, h), x| (l.min(x), h.max(x)));
    let middle = libm::rint((low + high) / 2.0);
    match number(crank * 1e3, scale, |mm| works([mm * 1e-3, middle * 1e-3])) {
        Some(mm) => {
            both!("\"crank\": \"{} mm\" with \"BE\": \"{} mm\" does", told(mm), told(middle))
        }
        None => both!("move the pivots: both crank and BE must reach all places"),
    }
}
