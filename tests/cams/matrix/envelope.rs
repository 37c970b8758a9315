//! A cam and its follower by brute force: among all points of the profile, the one that holds the
//! follower farthest out, found by trying them all. No centres of curvature, touched pieces or
//! derivatives are used.

use hodograph::geom::Vec2;

/// A piece of the profile in the frame of the cam.
#[derive(Clone, Copy, Debug)]
pub enum Piece {
    Arc { centre: Vec2, radius: f64, from: f64, to: f64 },
    Line { from: Vec2, to: Vec2 },
}

impl Piece {
    fn at(&self, u: f64) -> Vec2 {
        match *self {
            Piece::Arc { centre, radius, from, to } => {
                centre + Vec2::from_angle(from + (to - from) * u) * radius
            }
            Piece::Line { from, to } => from + (to - from) * u,
        }
    }
}

/// The end of a follower, which touches the cam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End {
    Round(f64),
    Flat,
}

/// The path of a follower in the plane: along a line, or about a pivot on an arm, clockwise from
/// the direction to the cam.
#[derive(Clone, Copy, Debug)]
pub enum Way {
    Along { through: Vec2, direction: Vec2 },
    About { pivot: Vec2, arm: f64 },
}

/// The position of the follower: its coordinate (m, rad), and the point of the profile that holds
/// it.
#[derive(Clone, Copy, Debug)]
pub struct Held {
    pub at: f64,
    pub contact: Vec2,
}

const SAMPLES: usize = 240;

/// The follower held by a cam with this origin and angle.
pub fn held(pieces: &[Piece], (origin, turn): (Vec2, f64), end: End, way: Way) -> Held {
    let axis = Vec2::from_angle(turn);
    let place = |piece: &Piece, u: f64| origin + piece.at(u).rotate_by(axis);
    let toward = match way {
        Way::Along { .. } => 0.0,
        Way::About { pivot, .. } => (origin - pivot).angle(),
    };
    // The clockwise angle of the point from the direction to the cam.
    let aside = |v: Vec2| {
        let a = toward - v.angle();
        a - std::f64::consts::TAU * (a / std::f64::consts::TAU).round()
    };
    // The coordinate at which a point of the profile holds the follower; `None` where it does not
    // reach it.
    let out = |x: Vec2| match (way, end) {
        (Way::Along { through, direction }, End::Round(r)) => {
            let (v, across) = (x - through, (x - through).dot(direction.perp()));
            v.dot(direction) + (r * r - across * across).sqrt()
        }
        (Way::Along { through, direction }, End::Flat) => (x - through).dot(direction),
        (Way::About { pivot, arm }, End::Round(r)) => {
            let d = (x - pivot).norm();
            aside(x - pivot) + ((arm * arm + d * d - r * r) / (2.0 * arm * d)).acos()
        }
        (Way::About { pivot, .. }, End::Flat) => aside(x - pivot),
    };
    let mut best = Held { at: f64::NEG_INFINITY, contact: Vec2::ZERO };
    let mut take = |at: f64, contact: Vec2| {
        if at > best.at {
            best = Held { at, contact };
        }
    };
    for piece in pieces {
        if end == End::Round(0.0) {
            // An edge: where the profile crosses its path.
            let off = |u: f64| match way {
                Way::Along { through, direction } => {
                    (place(piece, u) - through).dot(direction.perp())
                }
                Way::About { pivot, arm } => (place(piece, u) - pivot).norm() - arm,
            };
            for u in crossings(off) {
                let x = place(piece, u);
                let at = match way {
                    Way::Along { through, direction } => (x - through).dot(direction),
                    Way::About { pivot, .. } => aside(x - pivot),
                };
                take(at, x);
            }
            continue;
        }
        let value = |u: f64| {
            Some(out(place(piece, u))).filter(|q| q.is_finite()).unwrap_or(f64::NEG_INFINITY)
        };
        let k = (0..=SAMPLES)
            .max_by(|a, b| {
                value(*a as f64 / SAMPLES as f64).total_cmp(&value(*b as f64 / SAMPLES as f64))
            })
            .unwrap();
        let (mut low, mut high) =
            ((k.max(1) - 1) as f64 / SAMPLES as f64, (k + 1).min(SAMPLES) as f64 / SAMPLES as f64);
        for _ in 0..90 {
            let (a, b) = (low + 0.382 * (high - low), low + 0.618 * (high - low));
            if value(a) < value(b) { low = a } else { high = b }
        }
        let u = 0.5 * (low + high);
        take(value(u), place(piece, u));
    }
    match way {
        Way::Along { .. } => best,
        Way::About { .. } => Held { at: toward - best.at, ..best },
    }
}

/// Zeros of a function on 0..1.
fn crossings(f: impl Fn(f64) -> f64) -> Vec<f64> {
    let at = |k: usize| k as f64 / SAMPLES as f64;
    let mut out = Vec::new();
    for k in 0..SAMPLES {
        let (mut low, mut high) = (at(k), at(k + 1));
        if f(low) * f(high) > 0.0 {
            continue;
        }
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if f(low) * f(middle) <= 0.0 { high = middle } else { low = middle }
        }
        out.push(0.5 * (low + high));
    }
    out
}
