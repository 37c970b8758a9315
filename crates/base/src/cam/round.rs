//! Sampling of a whole turn of a cam: angles, points of its profile, its base circle.

use super::{CamMotion, CamStation, Disc, PieceSide, PreparedDisc};
use crate::geom::Vec2;

/// Returns angles of the cam from 0 to a whole turn: equal steps and, at every joint, both sides.
pub fn round(disc: &Disc, steps: usize) -> Vec<(f64, PieceSide)> {
    around(&PreparedDisc::of(disc), steps)
}

/// Returns the states at the angles of [`round`] at which the follower touches the cam, with the
/// side from which each is seen.
pub fn stations(disc: &Disc, steps: usize) -> Vec<(CamStation, PieceSide)> {
    let disc = PreparedDisc::of(disc);
    let seen = |(phi, side)| Some((disc.station(phi, side)?, side));
    around(&disc, steps).into_iter().filter_map(seen).collect()
}

fn around(disc: &PreparedDisc, steps: usize) -> Vec<(f64, PieceSide)> {
    let tau = std::f64::consts::TAU;
    let corners = disc.corners();
    // A step that coincides with a joint within rounding is the joint.
    let apart = |phi: f64| {
        let k = corners.partition_point(|c| *c < phi);
        corners[k.saturating_sub(1)..].iter().take(2).all(|c| (c - phi).abs() > 1e-7)
    };
    let even = (0..steps)
        .map(|k| tau * k as f64 / steps as f64)
        .filter(|phi| *phi == 0.0 || apart(*phi))
        .map(|phi| (phi, PieceSide::After));
    let joints =
        corners.iter().flat_map(|phi| [(*phi, PieceSide::Before), (*phi, PieceSide::After)]);
    let mut all: Vec<(f64, PieceSide)> =
        even.chain(joints).chain([(tau, PieceSide::Before)]).collect();
    all.sort_by(|a, b| {
        a.0.total_cmp(&b.0).then((a.1 == PieceSide::After).cmp(&(b.1 == PieceSide::After)))
    });
    all.dedup_by(|a, b| a.1 == b.1 && (a.0 - b.0).abs() < 1e-9);
    // The turn begins after its start and ends before it.
    let outside = |(phi, side): &(f64, PieceSide)| match side {
        PieceSide::Before => *phi < 1e-9,
        PieceSide::After => *phi > tau - 1e-9,
    };
    all.retain(|station| !outside(station));
    all
}

impl Disc {
    /// Returns points along the profile, in the frame of the cam; closed.
    pub fn outline(&self, steps: usize) -> Vec<Vec2> {
        match &self.motion {
            CamMotion::Profile(segments) => {
                let most = std::f64::consts::TAU / steps as f64;
                segments.iter().flat_map(|s| s.points(most)).collect()
            }
            CamMotion::Law { .. } => {
                stations(self, steps).into_iter().map(|(s, _)| s.contact).collect()
            }
        }
    }

    /// Returns the radius of the base circle (m); for a profile, the least distance of the touched
    /// points from the centre.
    pub fn base(&self) -> f64 {
        match &self.motion {
            CamMotion::Law { base, .. } => *base,
            CamMotion::Profile(_) => {
                let near = stations(self, 720).into_iter().map(|(s, _)| s.contact.norm());
                near.fold(f64::INFINITY, f64::min)
            }
        }
    }
}
