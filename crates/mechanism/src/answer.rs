//! What a question means where vectors of points and angular rates are given: the formulas of relative motion.
//!
//! A [`Source`] gives vectors and rates; [`evaluate`] combines them with the places of a pose as the question says
//! ([`Asked::value`]). The drawing does not use it (it reads edges, `construct::read`), nor does the analysis
//! (`analytic::Solution::answer` takes the parts of a relative motion from rows of its own), so that a wrong definition shows as
//! a disagreement.

use crate::mechanism::Level;
use crate::position::{Configuration, Path};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
pub use hodograph_scene::quantity::Value;
use hodograph_scene::quantity::{Asked, Forces, Known};
use hodograph_scene::{GuideId, LinkId, OnLink, PointId, Scene};

/// Where vectors and rates are looked up.
pub trait Source<N = f64> {
    /// Vector of the point of a link (or of the pin itself).
    fn vector(&self, level: Level, p: PointId, on: Option<LinkId>) -> Option<Vec2<N>>;
    /// Turning rate.
    fn turning(&self, level: Level, link: LinkId) -> Option<N>;
    /// Forces, of a source that solves for them.
    fn forces(&self) -> Option<&Forces<N>> {
        None
    }
}

/// A pose of which only the places are known.
struct Still;

impl<N> Source<N> for Still {
    fn vector(&self, _: Level, _: PointId, _: Option<LinkId>) -> Option<Vec2<N>> {
        None
    }

    fn turning(&self, _: Level, _: LinkId) -> Option<N> {
        None
    }
}

/// Places and motion of one instant.
struct Instant<'a, N, S> {
    scene: &'a Scene,
    at: &'a Configuration<N>,
    motion: &'a S,
}

impl<N: Real, S: Source<N>> Known<N> for Instant<'_, N, S> {
    fn scene(&self) -> &Scene {
        self.scene
    }

    fn point(&self, p: PointId) -> Option<Point<N>> {
        self.at.points[p.0]
    }

    fn guide(&self, g: GuideId) -> Option<(Point<N>, Vec2<N>)> {
        match self.at.guides[g.0]? {
            Path::Line { through, direction } => Some((through, direction)),
            Path::Arc { .. } => None,
        }
    }

    fn direction(&self, link: LinkId) -> Option<Vec2<N>> {
        self.at.direction(self.scene, link)
    }

    fn vector(&self, level: Level, p: &OnLink) -> Option<Vec2<N>> {
        self.motion.vector(level, p.point, p.link)
    }

    fn turning(&self, level: Level, link: LinkId) -> Option<N> {
        self.motion.turning(level, link)
    }

    fn forces(&self) -> Option<&Forces<N>> {
        self.motion.forces()
    }
}

/// The value of a question of places; `None` for a question of motion, and where a place is not known.
pub fn place<N: Real>(scene: &Scene, at: &Configuration<N>, what: &Asked) -> Option<Value<N>> {
    evaluate(scene, at, &Still, what)
}

/// Evaluates a question on a source of vectors and rates by the formulas of relative motion: what the group-by-group solution means by it.
pub fn evaluate<N: Real>(scene: &Scene, at: &Configuration<N>, source: &impl Source<N>, what: &Asked) -> Option<Value<N>> {
    what.value(&Instant { scene, at, motion: source })
}
