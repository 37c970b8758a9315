//! Four positions without a line: pivots of the centre-point curve within a box, or at two
//! inscribed angles.
//!
//! The curve is intersected with lines across the box in both directions; the intersections inside
//! it are the candidates for pivots. Pairs of them are ranked: those whose follower stays on one
//! side of BD come first, then by the least transmission angle in the four positions. The best
//! pairs with distinct pivots are returned. The inscribed angle β of a centre point M is ∠P₁₂MP₂₃,
//! that of the circles of the construction; two circles of one β intersect in two centre points.

use super::burmester::{BurmesterPair, on_line};
use super::pose::BodyPose;
use crate::form::TaskForm;
use crate::fourbar::meet;
use hodograph_base::diag::{Diagnostic, both};
use hodograph_base::geom::{Point, Vec2};
use std::f64::consts::PI;

/// Lines across a box in each direction.
const LINES: usize = 24;
/// Number of pairs returned, and the least distance of their pivots (share of the box).
const TOLD: usize = 6;
const APART: f64 = 0.04;
/// The greatest useful ratio of two lengths.
const UNEVEN: f64 = 20.0;

/// The choice of pivots on the centre-point curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Among {
    /// Pivots within a box, given by its least and greatest corner (m).
    Box([Point; 2]),
    /// Pivots with two inscribed angles (rad): of A and of D.
    Angles([f64; 2]),
}

/// Reads `box` or `angles`; the outer `None` where a key is present and cannot be read.
pub(super) fn read(form: &TaskForm) -> Option<Option<Among>> {
    match (form.has("box"), form.has("angles")) {
        (false, false) => Some(None),
        (true, true) => {
            let d = Diagnostic::error(
                "wrong-given",
                both!("\"box\" and \"angles\" are two ways to choose"),
            );
            form.fault(d.at(form.span("angles")).help(both!("keep one of the two")));
            None
        }
        (true, false) => {
            let inner = form.inner("box", &["from", "to"])?;
            let corner = |key: &str| inner.point_of(inner.need(key, "[\"0 mm\", \"0 mm\"]")?, key);
            let (p, q) = (corner("from"), corner("to"));
            let (p, q) = (p?, q?);
            if p.x == q.x || p.y == q.y {
                let d = Diagnostic::error("out-of-range", both!("the box has no area"));
                form.fault(
                    d.at(form.span("box")).help(both!("\"from\" and \"to\" are opposite corners")),
                );
                return None;
            }
            Some(Some(Among::Box([
                Point::new(p.x.min(q.x), p.y.min(q.y)),
                Point::new(p.x.max(q.x), p.y.max(q.y)),
            ])))
        }
        (false, true) => {
            let [a, d] =
                form.several::<2>(form.node("angles")?, "angles", "[\"40 deg\", \"110 deg\"]")?;
            let within = |n| {
                let angle = form.angle_of(n, "angles")?;
                let inside = angle > 0.0 && angle < PI;
                if !inside {
                    let d = Diagnostic::error(
                        "out-of-range",
                        both!("an inscribed angle lies between 0° and 180°"),
                    );
                    let help = both!("write \"angles\": [\"40 deg\", \"110 deg\"]");
                    form.fault(d.at(form.span("angles")).help(help));
                }
                inside.then_some(angle)
            };
            let (a, d) = (within(a), within(d));
            Some(Some(Among::Angles([a?, d?])))
        }
    }
}

/// The best pairs of dyads, the best first; the first dyad of a pair is that of A.
pub(super) fn pairs(positions: &[BodyPose], among: Among) -> Vec<[BurmesterPair; 2]> {
    match among {
        Among::Box(corners) => best(positions, &within(positions, corners), corners),
        Among::Angles(angles) => {
            let [a, d] = angles.map(|b| at_angle(positions, b));
            let all = a.iter().flat_map(|p| d.iter().map(move |q| [*p, *q]));
            all.filter(|[p, q]| p.centre.distance(q.centre) > 1e-9 * size(positions)).collect()
        }
    }
}

fn size(positions: &[BodyPose]) -> f64 {
    positions.iter().map(|p| p.origin.distance(positions[0].origin)).fold(0.0, f64::max)
}

/// The centre points within a box.
fn within(positions: &[BodyPose], [low, high]: [Point; 2]) -> Vec<BurmesterPair> {
    let inside = |p: &BurmesterPair| {
        p.centre.x >= low.x && p.centre.x <= high.x && p.centre.y >= low.y && p.centre.y <= high.y
    };
    let part = |k: usize| (k as f64 + 0.5) / LINES as f64;
    let level = (0..LINES)
        .map(|k| (Point::new(low.x, low.y + (high.y - low.y) * part(k)), Vec2::new(1.0, 0.0)));
    let upright = (0..LINES)
        .map(|k| (Point::new(low.x + (high.x - low.x) * part(k), low.y), Vec2::new(0.0, 1.0)));
    level
        .chain(upright)
        .flat_map(|(through, along)| on_line(positions, through, along))
        .filter(inside)
        .collect()
}

/// The best pairs with distinct pivots.
fn best(
    positions: &[BodyPose],
    all: &[BurmesterPair],
    [low, high]: [Point; 2],
) -> Vec<[BurmesterPair; 2]> {
    let mut ranked: Vec<(bool, f64, [BurmesterPair; 2])> = Vec::new();
    for (i, p) in all.iter().enumerate() {
        for (j, q) in all.iter().enumerate() {
            if let Some((joined, gamma)) = (i != j).then(|| rank(positions, [p, q])).flatten() {
                ranked.push((joined, gamma, [*p, *q]));
            }
        }
    }
    ranked.sort_by(|a, b| b.0.cmp(&a.0).then(b.1.total_cmp(&a.1)));
    let apart = APART * low.distance(high);
    let mut told: Vec<[BurmesterPair; 2]> = Vec::new();
    for (_, _, pair) in ranked {
        let near =
            |t: &[BurmesterPair; 2]| (0..2).all(|k| t[k].centre.distance(pair[k].centre) < apart);
        if !told.iter().any(near) {
            told.push(pair);
        }
        if told.len() == TOLD {
            break;
        }
    }
    told
}

/// True if C stays on one side of BD in the four positions, with the least transmission angle there
/// (rad); `None` for a linkage that cannot be built.
fn rank(positions: &[BodyPose], [p, q]: [&BurmesterPair; 2]) -> Option<(bool, f64)> {
    let lengths = [
        p.centre.distance(p.pin),
        p.pin.distance(q.pin),
        q.pin.distance(q.centre),
        p.centre.distance(q.centre),
    ];
    let (least, most) =
        lengths.iter().fold((f64::INFINITY, 0.0_f64), |(l, m), x| (l.min(*x), m.max(*x)));
    if !(least > 0.0 && most < UNEVEN * least) {
        return None;
    }
    let first = positions[0];
    let mut sides = Vec::new();
    let mut gamma = f64::INFINITY;
    for at in positions {
        let (b, c) = (first.carry(at, p.pin), first.carry(at, q.pin));
        let (u, v) = (b - c, q.centre - c);
        gamma = gamma.min(libm::atan2(u.cross(v).abs(), u.dot(v).abs()));
        sides.push(u.cross(v) > 0.0);
    }
    Some((sides.iter().all(|s| *s == sides[0]), gamma))
}

/// The centre points of an inscribed angle: the intersections of the circles over P₁₂P₂₃ and
/// P₁₄P₃₄, whose centres are at half the chord times the angle's cotangent above the midpoints of
/// the chords; then corrected onto the cubic along a line.
pub(super) fn at_angle(positions: &[BodyPose], angle: f64) -> Vec<BurmesterPair> {
    let pole = |i: usize, j: usize| positions[i].pole(&positions[j]);
    let found = || {
        let circle = |p: Point, q: Point| {
            let half = (q - p) * 0.5;
            let centre = p + half + half.perp() * (libm::cos(angle) / libm::sin(angle));
            (centre, centre.distance(p))
        };
        let ((c, r), (d, s)) = (circle(pole(0, 1)?, pole(1, 2)?), circle(pole(0, 3)?, pole(2, 3)?));
        Some(
            [true, false].into_iter().filter_map(|left| meet(c, r, d, s, left)).collect::<Vec<_>>(),
        )
    };
    let poles: Vec<Point> =
        [(0, 1), (1, 2), (0, 3), (2, 3)].into_iter().filter_map(|(i, j)| pole(i, j)).collect();
    let near = 1e-9 * size(positions);
    let on_curve = |m: Point| {
        let all = [Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0)]
            .into_iter()
            .flat_map(|along| on_line(positions, m, along));
        all.min_by(|a, b| a.centre.distance(m).total_cmp(&b.centre.distance(m)))
    };
    // Where two poles coincide, both circles pass through them for any angle.
    found()
        .unwrap_or_default()
        .into_iter()
        .filter(|m| poles.iter().all(|p| p.distance(*m) > near))
        .filter_map(on_curve)
        .collect()
}
