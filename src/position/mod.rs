//! Where everything is at the instant: from lengths and driver angles, or from the coordinates that the scene gives.
//!
//! Group after group in solving order ([`assemble`]: a pin on its loci, [`pins`]; a link on its legs, [`links`]). Each dyad is closed in closed form ([`kernel`]), the closure chosen by what the
//! scene says (side, sketch) or by a stated default; a triad takes the assembly nearest its sketch ([`triad`]); a higher
//! group is solved by Newton's method on its own equations ([`higher`], [`newton`]). [`finish`] adds what only follows and
//! checks what was given twice.
//!
//! The result is a [`Configuration`]: all that the drawing board and the loop equations share.

mod assemble;
mod branch;
mod finish;
mod higher;
pub mod kernel;
mod links;
pub mod newton;
mod pins;
mod shape;
mod triad;

pub use assemble::configure;

use crate::geom::{Point, Vec2};
use crate::scene::{GuideId, LinkId, PointId, Scene};

/// Place and direction of a link: its local frame in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// The frame's origin (m).
    pub origin: Point,
    /// The frame's x axis, a unit vector.
    pub axis: Vec2,
}

impl Pose {
    /// The frame of ground: the plane's own.
    pub const GROUND: Pose = Pose { origin: Point::ORIGIN, axis: Vec2::new(1.0, 0.0) };

    /// From the link to the plane.
    pub fn to_world(&self, local: Point) -> Point {
        self.origin + self.turn(local.to_vec2())
    }

    /// A direction of the link, in the plane.
    pub fn turn(&self, local: Vec2) -> Vec2 {
        local.rotate_by(self.axis)
    }

    /// From the plane to the link.
    pub fn to_local(&self, world: Point) -> Point {
        self.turn_back(world - self.origin).to_point()
    }

    /// A direction of the plane, in the link.
    pub fn turn_back(&self, world: Vec2) -> Vec2 {
        Vec2::new(self.axis.dot(world), self.axis.cross(world))
    }

    /// The pose at which local `a` lies on `world_a` and local a→b points along `direction`.
    pub fn from_point_and_direction(a: Point, toward: Vec2, world_a: Point, direction: Vec2) -> Option<Pose> {
        let axis = direction.divide_by(toward).unit()?;
        Some(Pose { origin: world_a - a.to_vec2().rotate_by(axis), axis })
    }
}

/// The path of a guide, in the plane or in its link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Path {
    /// A straight guide.
    Line {
        /// A point of it, from which positions are counted.
        through: Point,
        /// Unit vector of positive sliding.
        direction: Vec2,
    },
    /// A slot along a circle.
    Arc {
        /// Centre of curvature.
        centre: Point,
        /// Radius (m).
        radius: f64,
    },
}

impl Path {
    fn to_world(self, pose: &Pose) -> Path {
        match self {
            Path::Line { through, direction } => Path::Line { through: pose.to_world(through), direction: pose.turn(direction) },
            Path::Arc { centre, radius } => Path::Arc { centre: pose.to_world(centre), radius },
        }
    }

    /// The place at a coordinate along the path: metres from the start, of arc on a curved guide.
    pub fn point_at(&self, s: f64) -> Point {
        match *self {
            Path::Line { through, direction } => through + direction * s,
            Path::Arc { centre, radius } => centre + Vec2::from_angle(s / radius) * radius,
        }
    }

    /// The coordinate of a place along the path, as [`Path::point_at`] counts it.
    pub fn coordinate_of(&self, at: Point) -> f64 {
        match *self {
            Path::Line { through, direction } => direction.dot(at - through),
            Path::Arc { centre, radius } => (at - centre).angle() * radius,
        }
    }

    /// Unit tangent at the pin, in the positive sense of sliding (counter-clockwise about the centre on an arc).
    pub fn tangent_at(&self, pin: Point) -> Vec2 {
        match *self {
            Path::Line { direction, .. } => direction,
            Path::Arc { centre, radius } => ((pin - centre) * (1.0 / radius)).perp(),
        }
    }
}

/// All positions at one instant. Entries are `None` for what the questions do not call for.
#[derive(Clone, Debug, PartialEq)]
pub struct Configuration {
    /// Each point (m).
    pub points: Vec<Option<Point>>,
    /// Each link's frame; blocks and cylinder parts have that of the line they follow.
    pub poses: Vec<Option<Pose>>,
    /// Each guide in the plane.
    pub guides: Vec<Option<Path>>,
    /// Each link's points in its own frame, and each guide in the frame of the link that carries it.
    pub shapes: Shapes,
}

/// The rigid forms, in the links' own frames.
#[derive(Clone, Debug, PartialEq)]
pub struct Shapes {
    /// For each link, its points.
    pub points: Vec<Vec<(PointId, Point)>>,
    /// For each guide, its path in the carrying link.
    pub guides: Vec<Option<Path>>,
}

impl Shapes {
    /// A point in its link's frame.
    pub fn local(&self, link: LinkId, p: PointId) -> Option<Point> {
        self.points[link.0].iter().find(|(q, _)| *q == p).map(|(_, at)| *at)
    }
}

impl Configuration {
    /// A point that is known to be placed.
    ///
    /// # Panics
    /// If the point was not called for; the stages ask only for what their plan needs.
    pub fn point(&self, p: PointId) -> Point {
        self.points[p.0].expect("a planned point is placed")
    }

    /// A guide that is known to be placed.
    ///
    /// # Panics
    /// As [`Configuration::point`].
    pub fn guide(&self, g: GuideId) -> Path {
        self.guides[g.0].expect("a planned guide is placed")
    }

    /// The largest distance of two placed points (m), the size of the mechanism; 0 for a single point.
    pub fn extent(&self) -> f64 {
        let mut lo = Vec2::new(f64::INFINITY, f64::INFINITY);
        let mut hi = Vec2::new(f64::NEG_INFINITY, f64::NEG_INFINITY);
        for p in self.points.iter().flatten() {
            lo = Vec2::new(lo.x.min(p.x), lo.y.min(p.y));
            hi = Vec2::new(hi.x.max(p.x), hi.y.max(p.y));
        }
        if lo.x > hi.x { 0.0 } else { (hi - lo).norm() }
    }

    /// Direction of a link from its first point to its second; `None` where it has fewer than two.
    pub fn link_direction(&self, scene: &Scene, l: LinkId) -> Option<Vec2> {
        let pts = &scene.links[l.0].points;
        let (a, b) = (self.points[pts.first()?.0]?, self.points[pts.get(1)?.0]?);
        Some(b - a)
    }
}
