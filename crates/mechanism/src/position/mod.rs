//! Positions at the instant: from lengths and driver angles, or from the coordinates in the scene.
//!
//! The groups are placed one after the other in solving order ([`assemble`]: a pin on its loci,
//! [`pins`]; a link on its legs, [`links`]). Each dyad is closed in closed form ([`kernel`]); the
//! scene (side, sketch) or a stated default selects the closure. A triad takes the assembly nearest
//! its sketch ([`triad`]). A higher group is solved by Newton's method on its equations
//! ([`higher`], [`newton`]); its limit of motion is the [`fold`]. [`finish`] adds the passive parts
//! and checks values that are given twice.
//!
//! The result is a [`Configuration`]: the data that the drawing board and the loop equations share.

mod assemble;
pub mod belt;
mod branch;
mod compiled;
mod configure;
mod coupled;
mod eliminant;
mod equations;
mod finish;
pub mod fold;
mod higher;
pub mod kernel;
mod links;
pub mod newton;
pub mod pieces;
mod pins;
mod proof;
pub mod redundant;
mod repeats;
mod rolling;
mod shape;
pub mod toggle;
mod touch;
pub mod triad;

pub use compiled::{AssemblyNumber, later, later_apart, recompute};
pub use configure::configure;
pub use rolling::RollingRecord;
pub use touch::ContourContact;

use crate::mechanism::Mechanism;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_scene::{Guide, GuideDirection, GuideId, GuidePath, LinkId, PointId, Scene, Through};

/// Position and direction of a link: its local frame in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose<N = f64> {
    /// The frame's origin (m).
    pub origin: Point<N>,
    /// The frame's x axis, a unit vector.
    pub axis: Vec2<N>,
}

impl Pose {
    /// The frame of ground: the plane's own.
    pub const GROUND: Pose = Pose { origin: Point::ORIGIN, axis: Vec2::new(1.0, 0.0) };
}

impl Pose {
    /// Converts the pose to another number type.
    pub fn lift<N: Real>(&self) -> Pose<N> {
        self.map(&N::from_f64)
    }
}

impl<N: Real> Pose<N> {
    /// Returns the frame of ground: the plane's own.
    pub fn ground() -> Self {
        Pose { origin: Point::origin(), axis: Vec2::unit_x() }
    }

    /// Returns the nearest pose in `f64`.
    pub fn approx(&self) -> Pose {
        self.map(&N::approx)
    }

    fn map<M>(&self, number: &impl Fn(N) -> M) -> Pose<M> {
        Pose { origin: self.origin.map(number), axis: self.axis.map(number) }
    }

    /// Converts a point from the link to the plane.
    pub fn to_world(&self, local: Point<N>) -> Point<N> {
        self.origin + self.turn(local.to_vec2())
    }

    /// Converts a direction from the link to the plane.
    pub fn turn(&self, local: Vec2<N>) -> Vec2<N> {
        local.rotate_by(self.axis)
    }

    /// Converts a point from the plane to the link.
    pub fn to_local(&self, world: Point<N>) -> Point<N> {
        self.turn_back(world - self.origin).to_point()
    }

    /// Converts a direction from the plane to the link.
    pub fn turn_back(&self, world: Vec2<N>) -> Vec2<N> {
        Vec2::new(self.axis.dot(world), self.axis.cross(world))
    }

    /// Returns the pose that puts local `a` at `world_a` and turns the local direction `toward`
    /// into `direction`.
    pub fn from_point_and_direction(
        a: Point<N>,
        toward: Vec2<N>,
        world_a: Point<N>,
        direction: Vec2<N>,
    ) -> Option<Self> {
        let axis = direction.divide_by(toward).unit()?;
        Some(Pose { origin: world_a - a.to_vec2().rotate_by(axis), axis })
    }
}

/// The path of a guide, in the plane or in its link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Path<N = f64> {
    /// A straight guide.
    Line {
        /// The point from which coordinates are measured.
        through: Point<N>,
        /// Unit vector of positive sliding.
        direction: Vec2<N>,
    },
    /// A slot along a circle.
    Arc {
        /// Centre of curvature.
        centre: Point<N>,
        /// Radius (m).
        radius: N,
    },
}

impl<N: Real> Path<N> {
    /// Returns the nearest path in `f64`.
    pub fn approx(&self) -> Path {
        self.map(&N::approx)
    }

    fn map<M>(&self, number: &impl Fn(N) -> M) -> Path<M> {
        match *self {
            Path::Line { through, direction } => {
                Path::Line { through: through.map(number), direction: direction.map(number) }
            }
            Path::Arc { centre, radius } => {
                Path::Arc { centre: centre.map(number), radius: number(radius) }
            }
        }
    }

    fn to_world(self, pose: &Pose<N>) -> Self {
        match self {
            Path::Line { through, direction } => {
                Path::Line { through: pose.to_world(through), direction: pose.turn(direction) }
            }
            Path::Arc { centre, radius } => Path::Arc { centre: pose.to_world(centre), radius },
        }
    }

    /// Returns the point at a coordinate along the path: metres from the start, of arc on a curved
    /// guide.
    pub fn point_at(&self, s: N) -> Point<N> {
        match *self {
            Path::Line { through, direction } => through + direction * s,
            Path::Arc { centre, radius } => centre + Vec2::from_angle(s / radius) * radius,
        }
    }

    /// Returns the coordinate of a point along the path, as in [`Path::point_at`].
    pub fn coordinate_of(&self, at: Point<N>) -> N {
        match *self {
            Path::Line { through, direction } => direction.dot(at - through),
            Path::Arc { centre, radius } => (at - centre).angle() * radius,
        }
    }

    /// Returns the unit tangent at the pin, in the positive sense of sliding (counter-clockwise
    /// about the centre on an arc).
    pub fn tangent_at(&self, pin: Point<N>) -> Vec2<N> {
        match *self {
            Path::Line { direction, .. } => direction,
            Path::Arc { centre, radius } => ((pin - centre) * (N::from_f64(1.0) / radius)).perp(),
        }
    }
}

/// All positions at one instant. Entries are `None` for parts that the demand does not cover.
#[derive(Clone, Debug, PartialEq)]
pub struct Configuration<N = f64> {
    /// Each point (m).
    pub points: Vec<Option<Point<N>>>,
    /// Each link's frame; blocks and cylinder parts have the frame of the line that they follow.
    pub poses: Vec<Option<Pose<N>>>,
    /// Each guide in the plane.
    pub guides: Vec<Option<Path<N>>>,
    /// Each link's points in its own frame, and each guide in the frame of the link that carries
    /// it.
    pub shapes: Shapes<N>,
    /// For each group the index of the closure taken, in the order of the closed forms (0 if there
    /// is one).
    pub closures: Vec<usize>,
    /// The rolling of each pair since the scene's instant.
    pub rolled: Vec<Option<RollingRecord>>,
}

/// The rigid shapes, in the frames of the links.
#[derive(Clone, Debug, PartialEq)]
pub struct Shapes<N = f64> {
    /// For each link, its points.
    pub points: Vec<Vec<(PointId, Point<N>)>>,
    /// For each guide, its path in the carrying link.
    pub guides: Vec<Option<Path<N>>>,
    /// For each rolling pair the sizes of its contours, see
    /// [`Rolling::sizes`](hodograph_scene::Rolling::sizes).
    pub rolling: Vec<[N; 2]>,
}

impl<N: Real> Shapes<N> {
    /// Returns a point in its link's frame.
    pub fn local(&self, link: LinkId, p: PointId) -> Option<Point<N>> {
        self.points[link.0].iter().find(|(q, _)| *q == p).map(|(_, at)| *at)
    }
}

impl Configuration {
    /// Converts the configuration to another number type.
    pub fn lift<N: Real>(&self) -> Configuration<N> {
        self.map(&N::from_f64)
    }
}

impl<N: Real> Configuration<N> {
    /// Returns the position of a point by its name; `None` if the scene has no such point or the
    /// point is not placed.
    pub fn named(&self, scene: &Scene, name: &str) -> Option<Point<N>> {
        self.points[scene.points.iter().position(|p| p.name == name)?]
    }

    /// Returns the position of a point that is known to be placed.
    ///
    /// # Panics
    /// If the point is not placed; the stages request only the points that their plan needs.
    pub fn point(&self, p: PointId) -> Point<N> {
        self.points[p.0].expect("a planned point is placed")
    }

    /// Returns a guide that is known to be placed.
    ///
    /// # Panics
    /// As [`Configuration::point`].
    pub fn guide(&self, g: GuideId) -> Path<N> {
        self.guides[g.0].expect("a planned guide is placed")
    }

    /// Returns the nearest configuration in `f64`.
    pub fn approx(&self) -> Configuration {
        self.map(&N::approx)
    }

    fn map<M>(&self, number: &impl Fn(N) -> M) -> Configuration<M> {
        let guides =
            |list: &[Option<Path<N>>]| list.iter().map(|g| g.map(|g| g.map(number))).collect();
        let shape =
            |s: &Vec<(PointId, Point<N>)>| s.iter().map(|(p, at)| (*p, at.map(number))).collect();
        Configuration {
            points: self.points.iter().map(|p| p.map(|p| p.map(number))).collect(),
            poses: self.poses.iter().map(|p| p.map(|p| p.map(number))).collect(),
            guides: guides(&self.guides),
            shapes: Shapes {
                points: self.shapes.points.iter().map(shape).collect(),
                guides: guides(&self.shapes.guides),
                rolling: self.shapes.rolling.iter().map(|r| r.map(number)).collect(),
            },
            closures: self.closures.clone(),
            rolled: self.rolled.clone(),
        }
    }

    /// Returns the largest distance of two placed points (m), the size of the mechanism; 0 for a
    /// single point.
    pub fn extent(&self) -> f64 {
        let mut lo = Vec2::new(f64::INFINITY, f64::INFINITY);
        let mut hi = Vec2::new(f64::NEG_INFINITY, f64::NEG_INFINITY);
        for p in self.points.iter().flatten().map(|p| p.approx()) {
            lo = Vec2::new(lo.x.min(p.x), lo.y.min(p.y));
            hi = Vec2::new(hi.x.max(p.x), hi.y.max(p.y));
        }
        if lo.x > hi.x { 0.0 } else { (hi - lo).norm() }
    }

    /// Returns the direction that defines the angle of a link: from its first point to its second;
    /// for a link with fewer points that of its guide, otherwise that of its frame's axis.
    pub fn direction(&self, scene: &Scene, l: LinkId) -> Option<Vec2<N>> {
        let of_guide = || match self.guides[guide_of(scene, l)?.0]? {
            Path::Line { direction, .. } => Some(direction),
            Path::Arc { .. } => None,
        };
        self.link_direction(scene, l).or_else(of_guide).or_else(|| self.poses[l.0].map(|p| p.axis))
    }

    /// Returns the direction of a link from its first point to its second; `None` if it has fewer
    /// than two.
    pub fn link_direction(&self, scene: &Scene, l: LinkId) -> Option<Vec2<N>> {
        let pts = &scene.links[l.0].points;
        let (a, b) = (self.points[pts.first()?.0]?, self.points[pts.get(1)?.0]?);
        Some(b - a)
    }
}

/// Returns the configuration of these poses and points, completed with the passive parts. Shapes,
/// closures and rolling records are those of `meant`.
pub fn laid(
    scene: &Scene,
    mechanism: &Mechanism,
    meant: &Configuration,
    poses: Vec<Option<Pose>>,
    points: Vec<Option<Point>>,
) -> Configuration {
    finish::complete(
        scene,
        mechanism,
        meant.shapes.clone(),
        (poses, points),
        meant.closures.clone(),
        &meant.rolled,
    )
}

/// Returns the straight guide that gives the direction of a link without a line: a guide on the
/// link with an angle given for the instant and a position of its own (a guide through its pin is
/// placed only on request), otherwise the first guide along which the link slides.
pub fn guide_of(scene: &Scene, l: LinkId) -> Option<GuideId> {
    let straight = |told: bool, g: &Guide| match &g.path {
        GuidePath::Line { through, direction, .. } => {
            !told || matches!(direction, GuideDirection::Instant(_)) && *through != Through::Pin
        }
        GuidePath::Arc { .. } => false,
    };
    let first = |is: &dyn Fn(&Guide) -> bool| scene.guides.iter().position(is).map(GuideId);
    first(&|g| g.on == l && straight(true, g))
        .or_else(|| first(&|g| g.slider == Some(l) && straight(false, g)))
}
