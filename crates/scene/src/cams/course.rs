//! Follower positions beyond the instant, for a follower on other links than its cam.
//!
//! The position follows from the whole mechanism and not from one angle, so this module cannot
//! compute it. Modules that can move mechanisms supply a [`FollowerCourse`]; then the follower is a
//! driver like any other follower that a cam moves.

use super::super::model::{GuideId, LinkId, PointId, Scene};
use super::{Cam, Pieces};
use hodograph_base::cam::ProfileSegment;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use std::fmt;
use std::panic::{RefUnwindSafe, UnwindSafe};
use std::sync::Arc;

/// State of a follower that its cam moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FollowerState {
    /// The coordinate of the driver that replaces the contact, and its first two time derivatives
    /// (SI).
    pub place: [f64; 3],
    /// Index of the piece in contact.
    pub piece: usize,
}

/// The pair that joins a follower to another link and defines its coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HangsOn {
    /// The follower slides in a guide.
    Guide(GuideId),
    /// The follower turns about a pin of another link; a line of it begins at that pin.
    Pivot {
        /// The other link.
        against: LinkId,
        /// The line.
        line: [PointId; 2],
    },
}

/// Computes the state of a follower that its cam moves.
pub trait FollowerSolver: Send + Sync + UnwindSafe + RefUnwindSafe {
    /// Returns the follower's state for the position, rate and acceleration of each driver (SI);
    /// `None` where it cannot be followed.
    fn led(&self, drivers: &[[f64; 3]]) -> Option<FollowerState>;

    /// Returns bounds of the errors of place, rate and acceleration from [`FollowerSolver::led`];
    /// `None` where there is no enclosure.
    fn off(&self, drivers: &[[f64; 3]]) -> Option<[f64; 3]>;
}

/// The computation of a follower's states, shared by all copies of a scene.
#[derive(Clone)]
pub struct FollowerCourse(pub Arc<dyn FollowerSolver>);

impl fmt::Debug for FollowerCourse {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Course")
    }
}

/// Equality is identity.
impl PartialEq for FollowerCourse {
    fn eq(&self, other: &FollowerCourse) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Cam {
    /// Returns the point of contact of a follower with a round end and the outward unit normal of
    /// the cam, if a driver replaces the contact; `None` for a flat face, because only a pair gives
    /// its direction.
    pub fn touched_on_course<N: Real>(
        &self,
        scene: &Scene,
        place: &dyn Fn(PointId) -> Option<Point<N>>,
    ) -> Option<(Point<N>, Vec2<N>)> {
        let pieces = self.posed.as_ref().filter(|_| self.is_on_course())?;
        let (end, radius) = (place(self.follows.point())?, self.end_in(scene)?);
        let normal = pieces.normal(scene, place, end)?;
        Some((end - normal * radius, normal))
    }
}

impl Pieces {
    /// Returns the outward normal of the piece in contact at a place.
    fn normal<N: Real>(
        &self,
        scene: &Scene,
        place: &dyn Fn(PointId) -> Option<Point<N>>,
        at: Point<N>,
    ) -> Option<Vec2<N>> {
        let [from, to] = self.frame;
        let origin = place(from)?;
        let axis = (place(to)? - origin).unit()?;
        let piece = if N::refines() {
            self.in_numbers(scene)?.get(self.touched).copied()?
        } else {
            lifted(self.segments[self.touched])
        };
        match piece {
            ProfileSegment::Arc { centre, radius, .. } => {
                let away = (at - (origin + centre.rotate_by(axis))).unit()?;
                Some(if radius.approx() < 0.0 { -away } else { away })
            }
            ProfileSegment::Line { normal, .. } => Some(Vec2::from_angle(normal).rotate_by(axis)),
        }
    }
}

/// Converts a piece to another number type, at the same precision.
fn lifted<N: Real>(piece: ProfileSegment) -> ProfileSegment<N> {
    let number = N::from_f64;
    match piece {
        ProfileSegment::Arc { centre, radius, normals } => ProfileSegment::Arc {
            centre: centre.lift(),
            radius: number(radius),
            normals: normals.map(number),
        },
        ProfileSegment::Line { normal, distance, ends } => ProfileSegment::Line {
            normal: number(normal),
            distance: number(distance),
            ends: ends.map(number),
        },
    }
}
