//! Evaluation of requested quantities from the vectors of points and the angular rates of links, by
//! the formulas of relative motion.
//!
//! A [`MotionSource`] provides vectors and rates; [`evaluate`] combines them with the positions of
//! a pose according to the definition of the quantity ([`Asked::value`]). Two other ways of
//! solution do not use these formulas: the drawing reads edges (`construct::read`), and the
//! analysis (`analytic::Solution::answer`) derives the parts of a relative motion from separate
//! rows. A wrong definition therefore appears as a disagreement.

use crate::mechanism::Level;
use crate::position::{Configuration, Path};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
pub use hodograph_scene::quantity::AnswerValue;
use hodograph_scene::quantity::{Asked, Forces, FormulaInputs};
use hodograph_scene::{GuideId, LinkId, OnLink, PointId, Scene};

/// A source of vectors and rates.
pub trait MotionSource<N = f64> {
    /// Returns the vector of the point of a link (or of the pin itself).
    fn vector(&self, level: Level, p: PointId, on: Option<LinkId>) -> Option<Vec2<N>>;
    /// Returns the angular velocity or angular acceleration of a link.
    fn turning(&self, level: Level, link: LinkId) -> Option<N>;
    /// Returns the forces, for a source that solves for them.
    fn forces(&self) -> Option<&Forces<N>> {
        None
    }
}

/// A source for a pose with known positions only.
struct Still;

impl<N> MotionSource<N> for Still {
    fn vector(&self, _: Level, _: PointId, _: Option<LinkId>) -> Option<Vec2<N>> {
        None
    }

    fn turning(&self, _: Level, _: LinkId) -> Option<N> {
        None
    }
}

/// Positions and motion at one instant.
struct Instant<'a, N, S> {
    scene: &'a Scene,
    at: &'a Configuration<N>,
    motion: &'a S,
}

impl<N: Real, S: MotionSource<N>> FormulaInputs<N> for Instant<'_, N, S> {
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

/// Returns the value of a quantity that depends on positions; `None` for a quantity of motion, and
/// if a position is not known.
pub fn place<N: Real>(
    scene: &Scene,
    at: &Configuration<N>,
    what: &Asked,
) -> Option<AnswerValue<N>> {
    evaluate(scene, at, &Still, what)
}

/// Evaluates a quantity from a source of vectors and rates by the formulas of relative motion: the
/// definition that the group-by-group solution uses.
pub fn evaluate<N: Real>(
    scene: &Scene,
    at: &Configuration<N>,
    source: &impl MotionSource<N>,
    what: &Asked,
) -> Option<AnswerValue<N>> {
    what.value(&Instant { scene, at, motion: source })
}
