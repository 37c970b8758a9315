//! Disc cams of a scene, and the lower pairs that replace their contact (高副低代).
//!
//! A cam is replaced before the scene is resolved, so that all later stages handle lower pairs
//! only:
//! - a circle against a round end: the follower's point runs in a slot of the cam about the
//!   circle's centre; a line against a round end: in a straight slot;
//! - a circle against a flat face: its centre runs in a straight guide of the follower;
//! - a law: an arc about the centre of curvature of its profile at the contact; if the centre is
//!   too far away, the follower is a driver whose place, rate and acceleration are s, s′ω, s″ω² +
//!   s′α.
//!
//! The replacement gives the right velocity and acceleration at the instant, and is exact along
//! circles and lines. For a profile of several pieces, the piece in contact in the pose is
//! replaced; at a joint of two pieces, the next one in the driver's sense.
//!
//! [`decode`] reads the section, [`marked`] adds implied data, [`carrier`] and [`place`] locate cam
//! and follower, [`reckoned`] locates points on different links, [`expand`] writes the pairs in the
//! form of the scene, so that higher-precision numbers are read from the same texts. [`motion`]
//! handles them beyond the instant, with the help of a [`course`] where different links carry cam
//! and follower. [`replaced`] writes the linkage out, with a link for each contact. [`texts`] keeps
//! the numbers as written.

mod by_law;
mod by_parts;
mod by_pose;
mod carrier;
mod course;
pub(super) mod decode;
pub(super) mod expand;
mod for_count;
mod geared;
mod law;
pub(super) mod marked;
mod motion;
mod pairs;
mod place;
pub(super) mod raw;
mod reckoned;
mod replaced;
pub(super) mod rollers;
mod texts;

pub use course::{FollowerCourse, FollowerSolver, FollowerState, HangsOn};
pub use replaced::{ReplacedScene, ReplacingLink};
pub use texts::{MotionTexts, Texts};

use super::model::{GuideId, LinkId, PointId, Scene};
use hodograph_base::cam::{CamMotion, Disc, PieceSide, ProfileSegment, Surveyed};
use hodograph_base::diag::Span;
use hodograph_base::geom::{Point, Vec2};

/// The contact element of a follower.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Follows {
    /// A knife edge 尖顶: a point of the follower.
    Edge(PointId),
    /// A roller 滚子 about a point of the follower, with its radius (m).
    Roller(PointId, f64),
    /// A round end (mushroom) 曲面: the centre of its arc, a point of the follower, and its radius
    /// (m).
    Arc(PointId, f64),
    /// A flat face 平底 through a point of the follower, or parallel to the line through it.
    Face(PointId),
}

impl Follows {
    /// Returns the named point of the follower.
    pub fn point(&self) -> PointId {
        match *self {
            Follows::Edge(p) | Follows::Roller(p, _) | Follows::Arc(p, _) | Follows::Face(p) => p,
        }
    }

    /// Returns the radius of its end (m); 0 for an edge, `None` for a face.
    pub fn radius(&self) -> Option<f64> {
        match *self {
            Follows::Edge(_) => Some(0.0),
            Follows::Roller(_, r) | Follows::Arc(_, r) => Some(r),
            Follows::Face(_) => None,
        }
    }
}

/// A disc cam and its follower, with the data of the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Cam {
    /// The link that is the cam.
    pub cam: LinkId,
    /// The follower.
    pub follower: LinkId,
    /// The contact element of the follower.
    pub follows: Follows,
    /// The name of its roller, if the file has one: a link in books but not in the scene, see
    /// `rollers`.
    pub roller: Option<String>,
    /// The name of the contact, if it has one.
    pub at: Option<String>,
    /// The contact as a point of the scene, on no link, if a question names it.
    pub touch: Option<PointId>,
    /// For a face: true if the cam is to the left of it, looking along it.
    pub left: bool,
    /// The text of the radius of its round end.
    pub end: Option<String>,
    /// The texts of the radii of its pieces, `None` for a line; empty for a law.
    pub radii: Vec<Option<String>>,
    /// Centre and radius (m) of a profile that is one circle; it needs no pose.
    pub circle: Option<(PointId, f64)>,
    /// The cam on a pivot of the link in which its follower slides or turns, the ground or a moving
    /// link, for a whole turn. `None` where different links carry them.
    pub disc: Option<TurningCam>,
    /// The pieces of a profile placed by the coordinates of the pose, where different links carry
    /// cam and follower.
    pub posed: Option<Pieces>,
    /// The guide that replaces the contact; a law has a driver instead.
    pub contact: Option<GuideId>,
    /// Place of the declaration.
    pub span: Span,
}

impl Cam {
    /// Returns true if a driver replaces its contact and different links carry cam and follower.
    pub fn is_on_course(&self) -> bool {
        self.posed.as_ref().is_some_and(|p| p.led.is_some())
    }

    /// Returns true if this driver replaces its contact and different links carry cam and follower.
    pub fn is_led_by(&self, driver: usize) -> bool {
        self.posed.as_ref().is_some_and(|p| p.led.as_ref().is_some_and(|(k, _)| *k == driver))
    }

    /// Returns the radius of curvature of the profile at the contact in the pose (m), negative for
    /// a hollow; `None` for a line.
    pub fn touched_radius(&self) -> Option<f64> {
        let of = |segments: &[ProfileSegment], i: usize| match segments.get(i) {
            Some(ProfileSegment::Arc { radius, .. }) => Some(*radius),
            Some(ProfileSegment::Line { .. }) | None => None,
        };
        let of_disc = |t: &TurningCam| match &t.disc.motion {
            CamMotion::Profile(segments) => of(segments, t.touched?),
            CamMotion::Law { .. } => t.disc.station(t.phi, t.side).map(|s| s.rho),
        };
        let several = || self.posed.as_ref().and_then(|p| of(&p.segments, p.touched));
        self.circle.map(|c| c.1).or_else(|| self.disc.as_ref().and_then(of_disc)).or_else(several)
    }

    /// Returns the piece in contact in the pose; `None` for a law.
    fn touched(&self) -> Option<usize> {
        let of_disc = || self.disc.as_ref().and_then(|t| t.touched);
        self.circle.map(|_| 0).or_else(of_disc).or_else(|| self.posed.as_ref().map(|p| p.touched))
    }

    /// Returns true if a straight piece is in contact in the pose.
    pub fn is_touched_straight(&self) -> bool {
        let straight = |segments: &[ProfileSegment]| {
            self.touched()
                .is_some_and(|i| matches!(segments.get(i), Some(ProfileSegment::Line { .. })))
        };
        let of_disc = |t: &TurningCam| matches!(&t.disc.motion, CamMotion::Profile(segments) if straight(segments));
        self.disc.as_ref().is_some_and(of_disc)
            || self.posed.as_ref().is_some_and(|p| straight(&p.segments))
    }
}

/// A profile of several pieces on a link.
#[derive(Clone, Debug, PartialEq)]
pub struct Pieces {
    /// The points of the cam that define the frame of the pieces: origin at the first, x toward the
    /// second.
    pub frame: [PointId; 2],
    /// The pieces, counter-clockwise.
    pub segments: Vec<ProfileSegment>,
    /// The texts of their numbers, if each has one.
    pub texts: Option<MotionTexts>,
    /// Index of the piece in contact in the pose.
    pub touched: usize,
    /// The scene with each of the other pieces in contact, if that is possible.
    pub others: Vec<(usize, Scene)>,
    /// For a whole motion: the driver that replaces the contact, and the computation of its states.
    pub led: Option<(usize, FollowerCourse)>,
}

impl Pieces {
    /// Returns the scene whose contact is on a piece; `None` for the piece in contact in the pose,
    /// and for a piece that cannot be touched.
    pub fn on(&self, piece: usize) -> Option<&Scene> {
        self.others.iter().find(|(k, _)| *k == piece).map(|(_, scene)| scene)
    }
}

/// A cam that turns about a pivot of the link that carries its follower.
#[derive(Clone, Debug, PartialEq)]
pub struct TurningCam {
    /// The link that carries both; angles and places are measured in its axes.
    pub frame: LinkId,
    /// The pivot.
    pub pivot: PointId,
    /// Its geometry. φ is positive in the cam's sense of rotation.
    pub disc: Disc,
    /// Survey of a whole turn.
    pub survey: Surveyed,
    /// φ at the instant (rad).
    pub phi: f64,
    /// The driver that turns the cam, index into the scene's list.
    pub driver: usize,
    /// Ratio of the cam's rotation in the carrying link to the driver's: +1; −1 where the driver
    /// turns the carrying link about the cam; the gear ratio of a train of wheels.
    pub way: f64,
    /// Angle of the cam in the carrying link (rad) at driver position 0; it is 0 unless wheels
    /// drive the cam.
    pub from: f64,
    /// For a law: the driver that replaces the contact.
    pub by_law: Option<usize>,
    /// The angle of the cam in the carrying link (rad) at φ = 0.
    pub start: f64,
    /// The follower's coordinate in its own guide, or its angle (m, rad), at the zero of [`Disc`].
    pub origin: f64,
    /// +1 if this coordinate grows with that of [`Disc`], −1 otherwise.
    pub outward: f64,
    /// Index of the piece in contact, if a pair replaces the contact.
    pub touched: Option<usize>,
    /// On a moving carrier: the place of a point of the follower in the pose, in the carrier's
    /// axes; it selects the assembly.
    pub rough: Option<(PointId, Vec2)>,
    /// The side of a joint at which the instant is taken: the next piece in the driver's sense.
    pub side: PieceSide,
    /// The texts of its numbers, if each has one.
    pub texts: Option<Texts>,
}

impl TurningCam {
    /// Returns true if the cam's angle is that of its driver or its negative; if gears, a belt or a
    /// chain drive the cam, its angle is a multiple of the driver's plus a constant.
    pub fn is_drivers_own(&self) -> bool {
        self.way.abs() == 1.0 && self.from == 0.0
    }

    /// Returns its rough place in the fixed plane, with the carrier's points placed by `at`.
    pub fn rough_in_plane(
        &self,
        scene: &Scene,
        of: PointId,
        at: &dyn Fn(PointId) -> Option<Point>,
    ) -> Option<Point> {
        let (_, place) = self.rough.filter(|(p, _)| *p == of)?;
        let [a, b] = self.axis(scene)?;
        let origin = at(a)?;
        Some(origin + place.rotate_by((at(b)? - origin).unit()?))
    }

    /// Returns the two points that define the x axis of the carrying link; `None` for that of the
    /// fixed plane.
    pub fn axis(&self, scene: &Scene) -> Option<[PointId; 2]> {
        let [a, b, ..] = scene.links[self.frame.0].points.as_slice() else { return None };
        Some([*a, *b]).filter(|_| self.frame != scene.ground)
    }

    /// Returns dφ/dt and d²φ/dt² in a scene (rad/s, rad/s²).
    pub fn rates(&self, scene: &Scene) -> [f64; 2] {
        let d = &scene.drivers[self.driver];
        [d.rate.value, d.acceleration.as_ref().map_or(0.0, |a| a.value)]
            .map(|r| self.way * self.disc.sense * r)
    }
}
