//! Disc cams of a scene, and the pairs that stand for their contact 高副低代.
//!
//! A cam is replaced before the scene is resolved, so that everything after sees lower pairs only:
//! - a circle against a round end: the follower's point runs in a slot of the cam about the circle's centre; a line: in a straight slot;
//! - a circle against a flat face: its centre runs in a straight guide of the follower;
//! - a law: an arc about the centre of curvature of its profile at the contact; where that is too far off the follower is a driver of its own, whose place, rate
//!   and acceleration are s, s′ω, s″ω² + s′α.
//!
//! Right for velocity and acceleration at the instant, exact along circles and lines. Of a profile of several pieces the one that is touched in
//! the pose is taken; at a joint of two, that which follows in the driver's sense.
//!
//! [`decode`] reads the section, [`marked`] adds what is understood, [`carrier`] and [`place`] find where cam and follower are, [`reckoned`] where things are that different links carry, [`expand`] writes the pairs in the words of the scene, so that
//! longer numbers read the same texts; [`motion`] carries them on beyond the instant; what [`course`] hands in does where cam and follower move with different links. [`texts`] keeps the numbers as they are written.

mod by_law;
mod by_parts;
mod by_pose;
mod carrier;
mod course;
pub(super) mod decode;
pub(super) mod expand;
mod geared;
mod law;
pub(super) mod marked;
mod motion;
mod pairs;
mod place;
pub(super) mod raw;
mod reckoned;
pub(super) mod rollers;
mod texts;
mod untold;

pub use course::{Course, HangsOn, Leads, Led};
pub use texts::{MotionTexts, Texts};

use super::model::{GuideId, LinkId, PointId, Scene};
use hodograph_base::cam::{Disc, Motion, Segment, Side, Surveyed};
use hodograph_base::diag::Span;
use hodograph_base::geom::{Point, Vec2};

/// With what a follower touches its cam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Follows {
    /// A knife edge 尖顶: a point of the follower.
    Edge(PointId),
    /// A roller 滚子 about a point of the follower, with its radius (m).
    Roller(PointId, f64),
    /// A round end (mushroom) 曲面: the centre of its arc, a point of the follower, and its radius (m).
    Arc(PointId, f64),
    /// A flat face 平底 through a point of the follower, or parallel to the line through it.
    Face(PointId),
}

impl Follows {
    /// The point of the follower that is named.
    pub fn point(&self) -> PointId {
        match *self {
            Follows::Edge(p) | Follows::Roller(p, _) | Follows::Arc(p, _) | Follows::Face(p) => p,
        }
    }

    /// The radius of its end (m); 0 for an edge, nothing for a face.
    pub fn radius(&self) -> Option<f64> {
        match *self {
            Follows::Edge(_) => Some(0.0),
            Follows::Roller(_, r) | Follows::Arc(_, r) => Some(r),
            Follows::Face(_) => None,
        }
    }
}

/// A disc cam and its follower, as the scene gives them.
#[derive(Clone, Debug, PartialEq)]
pub struct Cam {
    /// The link that is the cam.
    pub cam: LinkId,
    /// The link that it moves.
    pub follower: LinkId,
    /// With what the follower touches.
    pub follows: Follows,
    /// The number of its roller, where the file has one for it: a link of books and not of the scene, see `rollers`.
    pub roller: Option<String>,
    /// The name of the contact, if it has one.
    pub at: Option<String>,
    /// The contact as a point of the scene, on no link, where a question names it.
    pub touch: Option<PointId>,
    /// Of a face: whether the cam lies left of it, looking along it.
    pub left: bool,
    /// The text of the radius of its round end.
    pub end: Option<String>,
    /// The texts of the radii of its pieces, nothing for a line; empty of a law.
    pub radii: Vec<Option<String>>,
    /// A profile that is one circle: its centre and radius (m). It needs no pose.
    pub circle: Option<(PointId, f64)>,
    /// The cam on a pivot of the link in which its follower slides or turns, of the ground or a moving one: what it does over a whole turn. `None` where
    /// different links carry them.
    pub disc: Option<Turning>,
    /// The pieces of a profile that the coordinates of the pose place: different links carry cam and follower.
    pub posed: Option<Pieces>,
    /// The guide that stands for the contact; a law has a driver instead.
    pub contact: Option<GuideId>,
    /// Where it is declared.
    pub span: Span,
}

impl Cam {
    /// Whether some driver stands for its contact, cam and follower moving with different links.
    pub fn is_on_course(&self) -> bool {
        self.posed.as_ref().is_some_and(|p| p.led.is_some())
    }

    /// Whether a driver stands for its contact, cam and follower moving with different links.
    pub fn is_led_by(&self, driver: usize) -> bool {
        self.posed.as_ref().is_some_and(|p| p.led.as_ref().is_some_and(|(k, _)| *k == driver))
    }

    /// The radius of curvature of the profile where it is touched in the pose (m), minus where it is hollow; nothing of a line.
    pub fn touched_radius(&self) -> Option<f64> {
        let of = |segments: &[Segment], i: usize| match segments.get(i) {
            Some(Segment::Arc { radius, .. }) => Some(*radius),
            Some(Segment::Line { .. }) | None => None,
        };
        let of_disc = |t: &Turning| match &t.disc.motion {
            Motion::Profile(segments) => of(segments, t.touched?),
            Motion::Law { .. } => t.disc.station(t.phi, t.side).map(|s| s.rho),
        };
        let several = || self.posed.as_ref().and_then(|p| of(&p.segments, p.touched));
        self.circle.map(|c| c.1).or_else(|| self.disc.as_ref().and_then(of_disc)).or_else(several)
    }

    /// The piece of the profile that is touched in the pose; nothing of a law.
    fn touched(&self) -> Option<usize> {
        let of_disc = || self.disc.as_ref().and_then(|t| t.touched);
        self.circle.map(|_| 0).or_else(of_disc).or_else(|| self.posed.as_ref().map(|p| p.touched))
    }

    /// Whether a straight piece is touched in the pose.
    pub fn is_touched_straight(&self) -> bool {
        let straight = |segments: &[Segment]| self.touched().is_some_and(|i| matches!(segments.get(i), Some(Segment::Line { .. })));
        let of_disc = |t: &Turning| matches!(&t.disc.motion, Motion::Profile(segments) if straight(segments));
        self.disc.as_ref().is_some_and(of_disc) || self.posed.as_ref().is_some_and(|p| straight(&p.segments))
    }
}

/// A profile of several pieces on a link.
#[derive(Clone, Debug, PartialEq)]
pub struct Pieces {
    /// The points of the cam in whose frame the pieces are: origin in the first, x toward the second.
    pub frame: [PointId; 2],
    /// The pieces, counter-clockwise.
    pub segments: Vec<Segment>,
    /// The texts of their numbers, where each has one.
    pub texts: Option<MotionTexts>,
    /// The one that is touched in the pose.
    pub touched: usize,
    /// The scene with each of the other pieces in its place, as far as it can be touched.
    pub others: Vec<(usize, Scene)>,
    /// Over a whole motion: the driver that stands for the contact, and who knows where it is.
    pub led: Option<(usize, Course)>,
}

impl Pieces {
    /// The scene whose contact is on a piece; `None` for the one that is touched in the pose, and where the piece cannot be touched.
    pub fn on(&self, piece: usize) -> Option<&Scene> {
        self.others.iter().find(|(k, _)| *k == piece).map(|(_, scene)| scene)
    }
}

/// A cam that turns about a pivot of the link that carries its follower.
#[derive(Clone, Debug, PartialEq)]
pub struct Turning {
    /// The link that carries both; angles and places are counted in its axes.
    pub frame: LinkId,
    /// The pivot.
    pub pivot: PointId,
    /// Its geometry. φ counts in the sense in which the cam turns.
    pub disc: Disc,
    /// What a turn of it shows.
    pub survey: Surveyed,
    /// φ at the instant (rad).
    pub phi: f64,
    /// The driver that turns the cam, index into the scene's list.
    pub driver: usize,
    /// By how much the cam turns in the carrying link as the driver turns by one: +1; −1 where the driver turns the carrying link about the cam;
    /// the ratio of the wheels between the two.
    pub way: f64,
    /// The angle of the cam in the carrying link (rad) as the driver stands at 0: 0 but behind wheels.
    pub from: f64,
    /// For a law: the driver that stands for the contact.
    pub by_law: Option<usize>,
    /// The angle of the cam in the carrying link (rad) at φ = 0.
    pub start: f64,
    /// The coordinate of the follower in its own guide, or its angle (m, rad), where [`Disc`] counts from.
    pub origin: f64,
    /// +1 where the two grow together, −1 otherwise.
    pub outward: f64,
    /// The pair that stands for the contact: the piece of the profile that is touched.
    pub touched: Option<usize>,
    /// On a moving carrier: where a point of the follower is in the pose, in the carrier's axes. It tells which of several assemblies is meant.
    pub rough: Option<(PointId, Vec2)>,
    /// On which side of a joint the instant is seen: as it goes on in the driver's sense.
    pub side: Side,
    /// The texts of its numbers, where each has one.
    pub texts: Option<Texts>,
}

impl Turning {
    /// Whether the cam's angle is that of its driver or its negative; behind gears, a belt or a chain it is a multiple of it from somewhere.
    pub fn is_drivers_own(&self) -> bool {
        self.way.abs() == 1.0 && self.from == 0.0
    }

    /// Where its rough place is in the plane, the carrier's points standing where `at` says.
    pub fn rough_in_plane(&self, scene: &Scene, of: PointId, at: &dyn Fn(PointId) -> Option<Point>) -> Option<Point> {
        let (_, place) = self.rough.filter(|(p, _)| *p == of)?;
        let [a, b] = self.axis(scene)?;
        let origin = at(a)?;
        Some(origin + place.rotate_by((at(b)? - origin).unit()?))
    }

    /// The two points along which the x axis of the carrying link lies; `None`: it is that of the plane.
    pub fn axis(&self, scene: &Scene) -> Option<[PointId; 2]> {
        let [a, b, ..] = scene.links[self.frame.0].points.as_slice() else { return None };
        Some([*a, *b]).filter(|_| self.frame != scene.ground)
    }

    /// How fast φ grows, and how fast that grows, in a scene (rad/s, rad/s²).
    pub fn rates(&self, scene: &Scene) -> [f64; 2] {
        let d = &scene.drivers[self.driver];
        [d.rate.value, d.acceleration.as_ref().map_or(0.0, |a| a.value)].map(|r| self.way * self.disc.sense * r)
    }
}
