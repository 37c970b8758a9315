//! A disc prepared for states at many angles: about each angle only few pieces of a profile can be
//! touched.
//!
//! The pitch curve of a piece is within a circle about its middle. The follower's point reaches
//! that circle only while the cam is turned by certain angles, which follow from the circle's least
//! and greatest distance from the centre; a flat face has the normals of a piece only while the cam
//! is turned by certain angles too. These intervals are somewhat too wide, never too narrow: among
//! the pieces that remain, the contact itself decides.

use super::disc::{BESIDE, Branch, CamMotion, CamStation, Disc, Follower, FollowerTip};
use super::jet::CamJet;
use super::outline::ProfileSegment;
use super::{PieceSide, in_turn};
use crate::geom::Vec2;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A disc with the pieces of its profile that can be touched about each angle.
pub struct PreparedDisc<'a> {
    disc: &'a Disc,
    /// The follower's coordinate on the base circle of a law.
    rest: f64,
    /// The pieces that can be touched; `None` for all.
    near: Option<NearPieces>,
}

/// Pieces by the angle by which the cam is turned.
struct NearPieces {
    /// The pieces for which no interval is known.
    always: Vec<usize>,
    /// The pieces for each of equal parts of a turn.
    parts: Vec<Vec<usize>>,
}

/// The fewest pieces that are worth a table.
const WORTH: usize = 8;

/// Relative amount by which circles and intervals are widened: more than the rounding error of a
/// contact that nearly slips off its piece, about √ε.
const WIDER: f64 = 1e-6;

/// The greatest mean number of pieces in a part of the turn for each part of the profile.
const CROWD: f64 = 32.0;

impl<'a> PreparedDisc<'a> {
    /// Prepares a disc for a single angle.
    pub(super) fn bare(disc: &'a Disc) -> Self {
        let rest = match &disc.motion {
            CamMotion::Law { base, .. } => disc.rest(*base),
            CamMotion::Profile(_) => 0.0,
        };
        PreparedDisc { disc, rest, near: None }
    }

    /// Prepares a disc for many angles.
    pub fn of(disc: &'a Disc) -> Self {
        let near = match &disc.motion {
            CamMotion::Profile(segments) if segments.len() >= WORTH => {
                Some(NearPieces::of(disc, segments))
            }
            CamMotion::Profile(_) | CamMotion::Law { .. } => None,
        };
        PreparedDisc { near, ..PreparedDisc::bare(disc) }
    }

    /// Returns the disc of a law with another base circle.
    pub(super) fn on_base(&self, base: f64) -> Self {
        PreparedDisc { disc: self.disc, rest: self.disc.rest(base), near: None }
    }

    /// Returns the disc as given.
    pub fn disc(&self) -> &'a Disc {
        self.disc
    }

    /// Returns the piece of the profile that is touched; see [`Disc::touched`].
    pub fn touched(&self, phi: f64, side: PieceSide) -> Option<usize> {
        let CamMotion::Profile(segments) = &self.disc.motion else { return None };
        let beside = match side {
            PieceSide::Before => phi - BESIDE,
            PieceSide::After => phi + BESIDE,
        };
        // If the follower leaves its cam here, nothing is touched beside the pose on that side, but
        // a piece is touched in the pose.
        self.farthest(segments, self.disc.sense * beside)
            .or_else(|| self.farthest(segments, self.disc.sense * phi))
    }

    /// Returns the piece that holds the follower farthest out when the cam is turned by `turn`
    /// (rad); of equal ones the first.
    fn farthest(&self, segments: &[ProfileSegment], turn: f64) -> Option<usize> {
        let Disc { follower, touch, .. } = self.disc;
        let held = |i: usize| {
            let q = segments[i].coordinate(follower, touch, CamJet::constant(turn)).value();
            (q.is_finite() && segments[i].holds(follower, touch, turn, q)).then_some((i, q))
        };
        let farther = |a: (usize, f64), b: (usize, f64)| {
            if b.1 > a.1 || b.1 == a.1 && b.0 < a.0 { b } else { a }
        };
        let best = match &self.near {
            None => (0..segments.len()).filter_map(held).reduce(farther),
            Some(near) => near.at(turn).filter_map(held).reduce(farther),
        };
        best.map(|(i, _)| i)
    }

    /// Returns the formula that applies at an angle; `None` if nothing is touched.
    pub fn branch(&self, phi: f64, side: PieceSide) -> Option<Branch> {
        match &self.disc.motion {
            CamMotion::Law { program, .. } => {
                program.branch(phi, side).map(|(stage, piece)| Branch::Stage(stage, piece))
            }
            CamMotion::Profile(_) => self.touched(phi, side).map(Branch::Piece),
        }
    }

    /// Returns the follower's coordinate with its derivatives by φ; `None` if it touches nothing.
    pub fn coordinate(&self, phi: f64, side: PieceSide) -> Option<CamJet> {
        match &self.disc.motion {
            CamMotion::Law { program, .. } => {
                let q = program.lift(phi, side) + CamJet::constant(self.rest);
                q.0.iter().all(|x| x.is_finite()).then_some(q)
            }
            CamMotion::Profile(_) => self.disc.coordinate_on(self.branch(phi, side)?, phi),
        }
    }

    /// Returns the state at one angle.
    pub fn station(&self, phi: f64, side: PieceSide) -> Option<CamStation> {
        match self.disc.motion {
            CamMotion::Law { .. } => Some(self.disc.station_of(self.coordinate(phi, side)?, phi)),
            CamMotion::Profile(_) => self.disc.station_on(self.branch(phi, side)?, phi),
        }
    }

    /// Returns the angles of the cam at which pieces of its law or of its profile meet, from 0 on.
    pub fn corners(&self) -> Vec<f64> {
        match &self.disc.motion {
            CamMotion::Law { program, .. } => program.corners(),
            CamMotion::Profile(segments) if segments.len() > 1 => self.changes(segments),
            CamMotion::Profile(_) => Vec::new(),
        }
    }
}

impl NearPieces {
    fn of(disc: &Disc, segments: &[ProfileSegment]) -> Self {
        let mut always = Vec::new();
        let mut some: Vec<(usize, [f64; 2])> = Vec::new();
        for (i, segment) in segments.iter().enumerate() {
            let intervals = turns(disc, segment);
            if intervals.iter().all(|[from, to]| to - from < PI) {
                some.extend(intervals.into_iter().map(|interval| (i, interval)));
            } else {
                always.push(i);
            }
        }
        // As many parts as keep the table in proportion to the profile.
        let pieces = segments.len() as f64;
        let covered: f64 = some.iter().map(|(_, [from, to])| (to - from) / TAU).sum();
        let count = (2.0 * pieces).min(CROWD * pieces / covered.max(1.0)).max(1.0) as usize;
        let mut parts = vec![Vec::new(); count];
        for (i, [from, to]) in some {
            let first = part_of(from, count);
            let more = libm::ceil((to - from) / TAU * count as f64) as usize;
            for k in first..=first + more.min(count - 1) {
                let part: &mut Vec<usize> = &mut parts[k % count];
                if part.last() != Some(&i) {
                    part.push(i);
                }
            }
        }
        NearPieces { always, parts }
    }

    /// Returns the pieces that can be touched when the cam is turned by `turn` (rad).
    fn at(&self, turn: f64) -> impl Iterator<Item = usize> {
        self.always.iter().chain(&self.parts[part_of(turn, self.parts.len())]).copied()
    }
}

/// Returns the part of the turn, of `count` equal ones, that contains an angle.
fn part_of(angle: f64, count: usize) -> usize {
    ((in_turn(angle) / TAU * count as f64) as usize).min(count - 1)
}

/// Returns intervals that contain all angles by which the cam is turned when a piece is touched; an
/// interval of a whole turn if they are not known.
fn turns(disc: &Disc, segment: &ProfileSegment) -> Vec<[f64; 2]> {
    const ALL: [f64; 2] = [0.0, TAU];
    // Angles of the follower in the ground, less angles in the cam.
    let apart = |[low, high]: [f64; 2], [from, to]: [f64; 2]| {
        let interval = [low - to - WIDER, high - from + WIDER];
        if interval.iter().all(|x| x.is_finite()) { interval } else { ALL }
    };
    match disc.touch {
        FollowerTip::Point { radius } => {
            let (middle, around) = circle_about(segment, radius);
            let distance = middle.norm();
            let around = around + WIDER * (around + distance);
            if around >= distance {
                return vec![ALL];
            }
            let (towards, aside) = (middle.angle(), libm::asin(around / distance));
            let reached = reached(&disc.follower, [distance - around, distance + around]);
            reached.map(|r| apart(r, [towards - aside, towards + aside])).to_vec()
        }
        FollowerTip::Flat { lever } => {
            // A flat face touches no hollow, and a line at its ends only, which are corners.
            let ProfileSegment::Arc { centre, radius, normals: [a, b] } = *segment else {
                return Vec::new();
            };
            let normals @ [from, to] = [a.min(b), a.max(b)];
            match disc.follower {
                Follower::Translating { direction, .. } => {
                    vec![apart([direction.angle(); 2], normals)]
                }
                Follower::Oscillating { pivot, .. } => {
                    let out = Vec2::from_angle(0.5 * (from + to)).dot(centre) + radius - lever;
                    let more = centre.norm() * 0.5 * (to - from) + WIDER * pivot.norm();
                    let aside = [out + more, out - more].map(|x| arc_cosine(x / pivot.norm()));
                    both_sides(pivot.angle(), aside).map(|r| apart(r, normals)).to_vec()
                }
            }
        }
    }
}

/// Returns the middle and the radius of a circle that contains the pitch curve of a piece.
fn circle_about(segment: &ProfileSegment, end: f64) -> (Vec2, f64) {
    match *segment {
        ProfileSegment::Arc { centre, radius, normals: [from, to] } => {
            let (length, half) = (radius + end, 0.5 * (to - from).abs());
            if half >= FRAC_PI_2 {
                return (centre, length.abs());
            }
            let middle = centre + Vec2::from_angle(0.5 * (from + to)) * length;
            (middle, 2.0 * length.abs() * libm::sin(0.5 * half))
        }
        ProfileSegment::Line { normal, distance, ends: [from, to] } => {
            let n = Vec2::from_angle(normal);
            (n * (distance + end) + n.perp() * (0.5 * (from + to)), 0.5 * (to - from).abs())
        }
    }
}

/// Returns the angles, as seen from the centre, at which the follower's point can be while its
/// distance from the centre is between two bounds: on its way it has each distance twice.
fn reached(follower: &Follower, distances: [f64; 2]) -> [[f64; 2]; 2] {
    match *follower {
        Follower::Translating { direction, offset } => {
            let along = distances.map(|r| libm::sqrt((r * r - offset * offset).max(0.0)));
            [1.0, -1.0].map(|way| {
                let at = along.map(|x| direction.angle() + libm::atan2(-offset, way * x));
                [at[0].min(at[1]), at[0].max(at[1])]
            })
        }
        Follower::Oscillating { pivot, arm, .. } => {
            let d = pivot.norm();
            let cosine = |r: f64| (r * r + d * d - arm * arm) / (2.0 * d * r);
            let mut ends = distances.map(cosine);
            ends.sort_by(f64::total_cmp);
            // The direction from the centre that touches the circle of the arm.
            let turning = libm::sqrt((d * d - arm * arm).max(0.0));
            if distances[0] < turning && turning < distances[1] {
                ends[0] = ends[0].min(cosine(turning));
            }
            both_sides(pivot.angle(), [arc_cosine(ends[1]), arc_cosine(ends[0])])
        }
    }
}

/// Returns an interval of angles on either side of a direction.
fn both_sides(direction: f64, [low, high]: [f64; 2]) -> [[f64; 2]; 2] {
    [[direction + low, direction + high], [direction - high, direction - low]]
}

/// Returns the arc cosine; beyond ±1 that of ±1.
fn arc_cosine(x: f64) -> f64 {
    libm::acos(x.clamp(-1.0, 1.0))
}
