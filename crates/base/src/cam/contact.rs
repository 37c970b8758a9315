//! Angles of the cam over which each piece of its profile is touched.
//!
//! The contact enters and leaves a piece at the angles at which the follower touches one of its
//! ends. These angles have a closed form: the follower's point is at a known distance from the
//! centre (a flat face has a known normal), so two positions in the plane are possible, and the cam
//! turns by the angle from its own end to such a position. Between two of these angles the pieces
//! within reach stay the same. The contact changes there only where two pieces hold the follower
//! equally far out, or where a piece ceases to reach it; bisection finds these angles.

use super::disc::{BESIDE, CamMotion, Disc, Follower, FollowerTip};
use super::jet::CamJet;
use super::outline::ProfileSegment;
use super::{PieceSide, PreparedDisc, in_turn};
use crate::geom::Vec2;
use crate::number::Real;

/// Angles closer than this (rad) are one joint: two ends that meet are computed in two ways.
const ONE_JOINT: f64 = 1e-11;

impl<N: Real> Disc<N> {
    /// Returns the angles of the cam at which the follower's position matches an end of a piece, in
    /// contact there or not.
    pub(super) fn ends(&self, segment: &ProfileSegment<N>) -> Vec<N> {
        let turns: Vec<N> = match (segment, self.touch) {
            (ProfileSegment::Arc { normals: [from, to], .. }, _)
                if (*to - *from).approx().abs() >= std::f64::consts::TAU =>
            {
                Vec::new()
            }
            (ProfileSegment::Arc { centre, radius, normals }, FollowerTip::Point { radius: r }) => {
                normals
                    .iter()
                    .flat_map(|n| self.turns_to(*centre + Vec2::from_angle(*n) * (*radius + r)))
                    .collect()
            }
            (ProfileSegment::Line { normal, distance, ends }, FollowerTip::Point { radius: r }) => {
                let n = Vec2::from_angle(*normal);
                ends.iter()
                    .flat_map(|t| self.turns_to(n * (*distance + r) + n.perp() * *t))
                    .collect()
            }
            (ProfileSegment::Arc { centre, radius, normals }, FollowerTip::Flat { lever }) => {
                normals
                    .iter()
                    .flat_map(|n| {
                        self.turns_facing(*n, Vec2::from_angle(*n).dot(*centre) + *radius - lever)
                    })
                    .collect()
            }
            (ProfileSegment::Line { .. }, FollowerTip::Flat { .. }) => Vec::new(),
        };
        turns.into_iter().map(|turn| if self.sense < 0.0 { -turn } else { turn }).collect()
    }

    /// Returns the two angles by which the cam is turned when the follower's point coincides with a
    /// point of the cam.
    fn turns_to(&self, place: Vec2<N>) -> [N; 2] {
        let reach = place.norm();
        let places = match self.follower {
            Follower::Translating { direction, offset } => {
                let along = (reach * reach - offset * offset).sqrt();
                [along, -along].map(|q| direction * q - direction.perp() * offset)
            }
            Follower::Oscillating { pivot, arm, .. } => {
                let d = pivot.norm();
                let foot = (reach * reach + d * d - arm * arm) / (N::from_f64(2.0) * d);
                let aside = (reach * reach - foot * foot).sqrt();
                let u = pivot * (N::from_f64(1.0) / d);
                [aside, -aside].map(|h| u * foot + u.perp() * h)
            }
        };
        places.map(|at| at.angle() - place.angle())
    }

    /// Returns the two angles by which the cam is turned when a face has a given normal of the cam.
    /// `out` is the coordinate along the normal of the touched point of the cam, less the distance
    /// of the face from its pivot.
    fn turns_facing(&self, normal: N, out: N) -> [N; 2] {
        match self.follower {
            Follower::Translating { direction, .. } => [direction.angle() - normal; 2],
            Follower::Oscillating { pivot, .. } => {
                let aside = CamJet::constant(out / pivot.norm()).arc_cosine().value();
                [aside, -aside].map(|a| pivot.angle() + a - normal)
            }
        }
    }
}

impl PreparedDisc<'_> {
    /// Returns the stretches of a turn in which one piece of the profile is touched: the angle at
    /// which each begins, from 0 on, and the piece; `None` where nothing is touched. A single
    /// stretch without joints, or a cam given by a law, begins at 0; otherwise the last stretch
    /// continues through 0.
    pub fn stretches(&self) -> Vec<(f64, Option<usize>)> {
        let joints = match &self.disc().motion {
            CamMotion::Profile(_) => self.corners(),
            CamMotion::Law { .. } => Vec::new(),
        };
        if joints.is_empty() {
            return vec![(0.0, self.touched(0.0, PieceSide::After))];
        }
        joints.into_iter().map(|phi| (phi, self.touched(phi, PieceSide::After))).collect()
    }

    /// Returns the angles at which the contact changes from one piece of the profile to another,
    /// from 0 on.
    pub(super) fn changes(&self, segments: &[ProfileSegment]) -> Vec<f64> {
        let mut ends: Vec<f64> = segments
            .iter()
            .flat_map(|s| self.disc().ends(s))
            .filter(|phi| phi.is_finite())
            .map(in_turn)
            .collect();
        ends.push(0.0);
        ends.sort_by(f64::total_cmp);
        ends.dedup_by(|a, b| (*a - *b).abs() < ONE_JOINT);
        let mut out = Vec::new();
        for (k, &here) in ends.iter().enumerate() {
            if self.touched(here, PieceSide::Before) != self.touched(here, PieceSide::After) {
                out.push(here);
            }
            let next = ends.get(k + 1).copied().unwrap_or(std::f64::consts::TAU);
            // If two pieces reach the follower, the contact may change to the other and back again
            // between two ends.
            const PARTS: usize = 4;
            let at = |i: usize| here + (next - here) * i as f64 / PARTS as f64;
            let (first, last) = (here + 2.0 * BESIDE, next - 2.0 * BESIDE);
            let mut from = first;
            for i in 1..=PARTS {
                let to = if i == PARTS { last } else { at(i) };
                if to > from {
                    self.between([from, to], &mut out, 0);
                    from = to;
                }
            }
        }
        let mut out: Vec<f64> = out.into_iter().map(in_turn).collect();
        out.sort_by(f64::total_cmp);
        out
    }

    /// Finds the angles, each to rounding, at which the touched piece changes.
    fn between(&self, [mut low, mut high]: [f64; 2], out: &mut Vec<f64>, depth: usize) {
        let of = |phi: f64| self.touched(phi, PieceSide::After);
        let (first, last) = (of(low), of(high));
        if first == last {
            return;
        }
        while high - low > 1e-14 {
            let middle = 0.5 * (low + high);
            match of(middle) {
                here if here == first => low = middle,
                here if here == last => high = middle,
                _ if depth < 8 => {
                    self.between([low, middle], out, depth + 1);
                    self.between([middle, high], out, depth + 1);
                    return;
                }
                _ => break,
            }
        }
        // A step ahead selects the next piece.
        out.push(0.5 * (low + high) + BESIDE);
    }
}
