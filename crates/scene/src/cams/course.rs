//! Where a follower is beyond the instant that moves with other links than its cam.
//!
//! It follows from the whole mechanism and not from one angle, so this room cannot tell it: who can move mechanisms hands in a [`Course`], and from then
//! on the follower is a driver of its own like any other that a cam leads.

use super::super::model::{GuideId, LinkId, PointId, Scene};
use super::{Cam, Pieces};
use hodograph_base::cam::Segment;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use std::fmt;
use std::panic::{RefUnwindSafe, UnwindSafe};
use std::sync::Arc;

/// A follower as its cam leads it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Led {
    /// The coordinate of the driver that stands for the contact, and its first two derivatives by the time (SI).
    pub place: [f64; 3],
    /// The piece that is touched.
    pub piece: usize,
}

/// The pair on which a follower hangs, by which its coordinate is counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HangsOn {
    /// It slides in a guide.
    Guide(GuideId),
    /// It turns about a pin of another link; a line of it from that pin.
    Pivot {
        /// The other link.
        against: LinkId,
        /// The line.
        line: [PointId; 2],
    },
}

/// Knows where a cam leads its follower.
pub trait Leads: Send + Sync + UnwindSafe + RefUnwindSafe {
    /// The follower where the drivers stand, as fast as they move (position, rate, acceleration of each, SI); `None` where it cannot be followed.
    fn led(&self, drivers: &[[f64; 3]]) -> Option<Led>;

    /// Bounds of the errors of place, rate and acceleration that [`Leads::led`] tells; `None` where nothing encloses them.
    fn off(&self, drivers: &[[f64; 3]]) -> Option<[f64; 3]>;
}

/// One that is shared by all copies of a scene.
#[derive(Clone)]
pub struct Course(pub Arc<dyn Leads>);

impl fmt::Debug for Course {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Course")
    }
}

/// The same one.
impl PartialEq for Course {
    fn eq(&self, other: &Course) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Cam {
    /// Where a follower with a round end touches, and the unit normal out of the cam, while a driver stands for the contact; `None` of a flat face, whose
    /// direction only its pair told.
    pub fn touched_on_course<N: Real>(&self, scene: &Scene, place: &dyn Fn(PointId) -> Option<Point<N>>) -> Option<(Point<N>, Vec2<N>)> {
        let pieces = self.posed.as_ref().filter(|_| self.is_on_course())?;
        let (end, radius) = (place(self.follows.point())?, self.end_in(scene)?);
        let normal = pieces.normal(scene, place, end)?;
        Some((end - normal * radius, normal))
    }
}

impl Pieces {
    /// The outward normal of the piece that is touched, at a place.
    fn normal<N: Real>(&self, scene: &Scene, place: &dyn Fn(PointId) -> Option<Point<N>>, at: Point<N>) -> Option<Vec2<N>> {
        let [from, to] = self.frame;
        let origin = place(from)?;
        let axis = (place(to)? - origin).unit()?;
        let piece = if N::refines() { self.in_numbers(scene)?.get(self.touched).copied()? } else { lifted(self.segments[self.touched]) };
        match piece {
            Segment::Arc { centre, radius, .. } => {
                let away = (at - (origin + centre.rotate_by(axis))).unit()?;
                Some(if radius.approx() < 0.0 { -away } else { away })
            }
            Segment::Line { normal, .. } => Some(Vec2::from_angle(normal).rotate_by(axis)),
        }
    }
}

/// A piece in other numbers that know no more of it.
fn lifted<N: Real>(piece: Segment) -> Segment<N> {
    let number = N::from_f64;
    match piece {
        Segment::Arc { centre, radius, normals } => {
            Segment::Arc { centre: centre.lift(), radius: number(radius), normals: normals.map(number) }
        }
        Segment::Line { normal, distance, ends } => {
            Segment::Line { normal: number(normal), distance: number(distance), ends: ends.map(number) }
        }
    }
}
