//! Where everything is at the instant: from lengths and driver angles, or from the coordinates that the scene gives.
//!
//! Group after group in solving order ([`assemble`]: a pin on its loci, [`pins`]; a link on its legs, [`links`]). Each dyad is closed in closed form ([`kernel`]), the closure chosen by what the
//! scene says (side, sketch) or by a stated default; a triad takes the assembly nearest its sketch ([`triad`]); a higher
//! group is solved by Newton's method on its own equations ([`higher`], [`newton`]); where these let it go no farther is its [`fold`]. [`finish`] adds what only follows and
//! checks what was given twice.
//!
//! The result is a [`Configuration`]: all that the drawing board and the loop equations share.

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

pub use compiled::{Placed, later, recompute};
pub use configure::configure;
pub use rolling::Rolled;
pub use touch::Touch;

use crate::mechanism::Mechanism;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_scene::{Direction, Guide, GuideId, GuidePath, LinkId, PointId, Scene, Through};

/// Place and direction of a link: its local frame in the plane.
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
    /// The same in other numbers.
    pub fn lift<N: Real>(&self) -> Pose<N> {
        Pose { origin: self.origin.lift(), axis: self.axis.lift() }
    }
}

impl<N: Real> Pose<N> {
    /// The frame of ground: the plane's own.
    pub fn ground() -> Self {
        Pose { origin: Point::origin(), axis: Vec2::unit_x() }
    }

    /// The nearest pose in `f64`.
    pub fn approx(&self) -> Pose {
        Pose { origin: self.origin.approx(), axis: self.axis.approx() }
    }

    /// From the link to the plane.
    pub fn to_world(&self, local: Point<N>) -> Point<N> {
        self.origin + self.turn(local.to_vec2())
    }

    /// A direction of the link, in the plane.
    pub fn turn(&self, local: Vec2<N>) -> Vec2<N> {
        local.rotate_by(self.axis)
    }

    /// From the plane to the link.
    pub fn to_local(&self, world: Point<N>) -> Point<N> {
        self.turn_back(world - self.origin).to_point()
    }

    /// A direction of the plane, in the link.
    pub fn turn_back(&self, world: Vec2<N>) -> Vec2<N> {
        Vec2::new(self.axis.dot(world), self.axis.cross(world))
    }

    /// The pose at which local `a` lies on `world_a` and local a→b points along `direction`.
    pub fn from_point_and_direction(a: Point<N>, toward: Vec2<N>, world_a: Point<N>, direction: Vec2<N>) -> Option<Self> {
        let axis = direction.divide_by(toward).unit()?;
        Some(Pose { origin: world_a - a.to_vec2().rotate_by(axis), axis })
    }
}

/// The path of a guide, in the plane or in its link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Path<N = f64> {
    /// A straight guide.
    Line {
        /// A point of it, from which positions are counted.
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
    /// The nearest path in `f64`.
    pub fn approx(&self) -> Path {
        match *self {
            Path::Line { through, direction } => Path::Line { through: through.approx(), direction: direction.approx() },
            Path::Arc { centre, radius } => Path::Arc { centre: centre.approx(), radius: radius.approx() },
        }
    }

    fn to_world(self, pose: &Pose<N>) -> Self {
        match self {
            Path::Line { through, direction } => Path::Line { through: pose.to_world(through), direction: pose.turn(direction) },
            Path::Arc { centre, radius } => Path::Arc { centre: pose.to_world(centre), radius },
        }
    }

    /// The place at a coordinate along the path: metres from the start, of arc on a curved guide.
    pub fn point_at(&self, s: N) -> Point<N> {
        match *self {
            Path::Line { through, direction } => through + direction * s,
            Path::Arc { centre, radius } => centre + Vec2::from_angle(s / radius) * radius,
        }
    }

    /// The coordinate of a place along the path, as [`Path::point_at`] counts it.
    pub fn coordinate_of(&self, at: Point<N>) -> N {
        match *self {
            Path::Line { through, direction } => direction.dot(at - through),
            Path::Arc { centre, radius } => (at - centre).angle() * radius,
        }
    }

    /// Unit tangent at the pin, in the positive sense of sliding (counter-clockwise about the centre on an arc).
    pub fn tangent_at(&self, pin: Point<N>) -> Vec2<N> {
        match *self {
            Path::Line { direction, .. } => direction,
            Path::Arc { centre, radius } => ((pin - centre) * (N::from_f64(1.0) / radius)).perp(),
        }
    }
}

/// All positions at one instant. Entries are `None` for what the questions do not call for.
#[derive(Clone, Debug, PartialEq)]
pub struct Configuration<N = f64> {
    /// Each point (m).
    pub points: Vec<Option<Point<N>>>,
    /// Each link's frame; blocks and cylinder parts have that of the line they follow.
    pub poses: Vec<Option<Pose<N>>>,
    /// Each guide in the plane.
    pub guides: Vec<Option<Path<N>>>,
    /// Each link's points in its own frame, and each guide in the frame of the link that carries it.
    pub shapes: Shapes<N>,
    /// For each group, which of its closures was taken, in the order of the closed forms (0 where there is one).
    pub closures: Vec<usize>,
    /// How far each rolling pair has rolled since the scene's instant.
    pub rolled: Vec<Option<Rolled>>,
}

/// The rigid forms, in the links' own frames.
#[derive(Clone, Debug, PartialEq)]
pub struct Shapes<N = f64> {
    /// For each link, its points.
    pub points: Vec<Vec<(PointId, Point<N>)>>,
    /// For each guide, its path in the carrying link.
    pub guides: Vec<Option<Path<N>>>,
    /// For each rolling pair the sizes of its contours, see [`Rolling::sizes`](hodograph_scene::Rolling::sizes).
    pub rolling: Vec<[N; 2]>,
}

impl<N: Real> Shapes<N> {
    /// A point in its link's frame.
    pub fn local(&self, link: LinkId, p: PointId) -> Option<Point<N>> {
        self.points[link.0].iter().find(|(q, _)| *q == p).map(|(_, at)| *at)
    }
}

impl<N: Real> Configuration<N> {
    /// The place of a point by its name; `None` of one that the scene does not have or that is not placed.
    pub fn named(&self, scene: &Scene, name: &str) -> Option<Point<N>> {
        self.points[scene.points.iter().position(|p| p.name == name)?]
    }

    /// A point that is known to be placed.
    ///
    /// # Panics
    /// If the point was not called for; the stages ask only for what their plan needs.
    pub fn point(&self, p: PointId) -> Point<N> {
        self.points[p.0].expect("a planned point is placed")
    }

    /// A guide that is known to be placed.
    ///
    /// # Panics
    /// As [`Configuration::point`].
    pub fn guide(&self, g: GuideId) -> Path<N> {
        self.guides[g.0].expect("a planned guide is placed")
    }

    /// The nearest configuration in `f64`.
    pub fn approx(&self) -> Configuration {
        let guides = |list: &[Option<Path<N>>]| list.iter().map(|g| g.map(|g| g.approx())).collect();
        Configuration {
            points: self.points.iter().map(|p| p.map(Point::approx)).collect(),
            poses: self.poses.iter().map(|p| p.map(|p| p.approx())).collect(),
            guides: guides(&self.guides),
            shapes: Shapes {
                points: self.shapes.points.iter().map(|s| s.iter().map(|(p, at)| (*p, at.approx())).collect()).collect(),
                guides: guides(&self.shapes.guides),
                rolling: self.shapes.rolling.iter().map(|r| r.map(Real::approx)).collect(),
            },
            closures: self.closures.clone(),
            rolled: self.rolled.clone(),
        }
    }

    /// The largest distance of two placed points (m), the size of the mechanism; 0 for a single point.
    pub fn extent(&self) -> f64 {
        let mut lo = Vec2::new(f64::INFINITY, f64::INFINITY);
        let mut hi = Vec2::new(f64::NEG_INFINITY, f64::NEG_INFINITY);
        for p in self.points.iter().flatten().map(|p| p.approx()) {
            lo = Vec2::new(lo.x.min(p.x), lo.y.min(p.y));
            hi = Vec2::new(hi.x.max(p.x), hi.y.max(p.y));
        }
        if lo.x > hi.x { 0.0 } else { (hi - lo).norm() }
    }

    /// The direction whose angle a link's is: from its first point to its second; of a link that has fewer than two, that of its guide, else of its
    /// frame's axis.
    pub fn direction(&self, scene: &Scene, l: LinkId) -> Option<Vec2<N>> {
        let of_guide = || match self.guides[guide_of(scene, l)?.0]? {
            Path::Line { direction, .. } => Some(direction),
            Path::Arc { .. } => None,
        };
        self.link_direction(scene, l).or_else(of_guide).or_else(|| self.poses[l.0].map(|p| p.axis))
    }

    /// Direction of a link from its first point to its second; `None` where it has fewer than two.
    pub fn link_direction(&self, scene: &Scene, l: LinkId) -> Option<Vec2<N>> {
        let pts = &scene.links[l.0].points;
        let (a, b) = (self.points[pts.first()?.0]?, self.points[pts.get(1)?.0]?);
        Some(b - a)
    }
}

/// The configuration of these poses and points, completed by what follows from them. Shapes, closures and the records of what rolls are those
/// of `meant`.
pub fn laid(
    scene: &Scene,
    mechanism: &Mechanism,
    meant: &Configuration,
    poses: Vec<Option<Pose>>,
    points: Vec<Option<Point>>,
) -> Configuration {
    finish::complete(scene, mechanism, meant.shapes.clone(), (poses, points), meant.closures.clone(), &meant.rolled)
}

/// The straight guide whose direction is that of a link without a line of its own: one that lies on it at an angle told for the instant and has a
/// place of its own (one through its pin is placed only where that is asked for), else the first along which it slides.
pub fn guide_of(scene: &Scene, l: LinkId) -> Option<GuideId> {
    let straight = |told: bool, g: &Guide| match &g.path {
        GuidePath::Line { through, direction, .. } => !told || matches!(direction, Direction::Instant(_)) && *through != Through::Pin,
        GuidePath::Arc { .. } => false,
    };
    let first = |is: &dyn Fn(&Guide) -> bool| scene.guides.iter().position(is).map(GuideId);
    first(&|g| g.on == l && straight(true, g)).or_else(|| first(&|g| g.slider == Some(l) && straight(false, g)))
}
