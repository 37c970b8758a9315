//! Motions without a mechanism: a point that always runs toward another point (pursuit), and a
//! point that moves by a law of time on a plate that turns about an axis in space.
//!
//! Such a file has the front of a scene, `time`, `points`, `plates`, `motions` and `find`, and no
//! links. [`read`] gives a [`ParticleProblem`], [`solve`] its answers with error bounds: laws are
//! differentiated exactly ([`law`]); a pursuit is integrated ([`pursuit`]), and the output says so.
//! The drawing with ruler and paper is in [`board`], which uses the laws at the instant and none of
//! the results computed here.
//!
//! Points that move on links of mechanisms by laws of time are scenes ([`hodograph_scene`]).
//!
//! ```
//! let problem = hodograph_methods::particle::read(hodograph_methods::particle::templates::get("pursuit").unwrap())?.value;
//! let solved = hodograph_methods::particle::solve(&problem)?;
//! assert_eq!(problem.find[0].text, "T_AB");
//! assert!((solved.answers[0].value.scalar().unwrap() - 5.0 / 9.0 * 3000.0).abs() < 1e-9);
//! # Ok::<(), hodograph_base::diag::Faults>(())
//! ```

mod ask;
pub mod board;
pub mod law;
mod peek;
pub mod plate;
#[doc(hidden)]
pub mod pursuit;
mod read;
mod rest;
pub mod schema;
mod solve;
pub mod templates;

pub use ask::{Mutual, ParticleQuantity, ParticleQuestion};
pub use read::{is_problem, read};
pub use solve::{ParticleAnswer, ParticleSolution, ParticleValue, course, solve, solve_again};

use hodograph_base::diag::{Both, Diagnostic};
use hodograph_scene::front::Law;
use hodograph_scene::{self as scene, Book, Lang, Paper};
use law::{PathLaw, PlateRotation};

/// The content of a file.
#[derive(Clone, Debug)]
pub struct ParticleProblem {
    /// The title.
    pub title: Both,
    /// The statement, with the values of its parameters inserted.
    pub statement: Option<Both>,
    /// The language that the file names.
    pub language: Option<Lang>,
    /// Names and values of the parameters as written.
    pub parameters: Vec<(String, String)>,
    /// The sheet and its scales.
    pub paper: Paper,
    /// The units of printed values.
    pub book: Book,
    /// The instant.
    pub time: Law,
    /// The plates.
    pub plates: Vec<Plate>,
    /// The motions.
    pub motions: Vec<ParticleMotion>,
    /// The questions; if the file has none, all possible ones.
    pub find: Vec<ParticleQuestion>,
}

/// A coordinate axis of space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpaceAxis {
    /// x.
    X,
    /// y.
    Y,
    /// z.
    Z,
}

impl SpaceAxis {
    /// The three axes, in order.
    pub const ALL: [SpaceAxis; 3] = [SpaceAxis::X, SpaceAxis::Y, SpaceAxis::Z];

    /// Returns the letter of the axis.
    pub fn letter(self) -> &'static str {
        match self {
            SpaceAxis::X => "x",
            SpaceAxis::Y => "y",
            SpaceAxis::Z => "z",
        }
    }

    /// Returns the indices of the two axes square to this one, in the order in which they form a
    /// right-handed system with it, then its own index.
    pub fn order(self) -> [usize; 3] {
        match self {
            SpaceAxis::X => [1, 2, 0],
            SpaceAxis::Y => [2, 0, 1],
            SpaceAxis::Z => [0, 1, 2],
        }
    }
}

/// A plate that turns about an axis through the origin and is parallel to it.
#[derive(Clone, Debug)]
pub struct Plate {
    /// The number of the plate.
    pub link: String,
    /// The axis.
    pub axis: SpaceAxis,
    /// The rotation: the angle from the axis that follows cyclically in x, y, z.
    pub turning: PlateRotation,
    /// The distance of the plate from the axis, to the side of its positive rotation.
    pub offset: Option<Law>,
}

/// The motion of a point.
#[derive(Clone, Debug)]
pub struct ParticleMotion {
    /// The point.
    pub point: String,
    /// The kind of motion.
    pub kind: ParticleMotionKind,
}

/// The kind of motion of a point.
#[derive(Clone, Debug)]
pub enum ParticleMotionKind {
    /// In the fixed plane by a law.
    Fixed(PathLaw),
    /// On a plate by a law; the index of the plate in the list.
    OnPlate(usize, PathLaw),
    /// Always toward another point.
    Toward {
        /// The place at t = 0.
        from: [Law; 2],
        /// The index of the target's motion in the list.
        target: usize,
        /// The speed.
        speed: Law,
    },
}

impl ParticleProblem {
    /// Returns the motion of a point.
    pub fn motion(&self, point: &str) -> Option<&ParticleMotion> {
        self.motions.iter().find(|m| m.point == point)
    }

    /// Returns the chase of a pursuer, and the name of its target.
    pub fn chase(&self, motion: &ParticleMotion) -> Option<(pursuit::Chase<'_>, &str)> {
        let own = self.motions.iter().find(|m| m.point == motion.point)?;
        let ParticleMotionKind::Toward { from, target, speed } = &own.kind else { return None };
        let ParticleMotion { point, kind: ParticleMotionKind::Fixed(target) } =
            self.motions.get(*target)?
        else {
            return None;
        };
        Some((pursuit::Chase { from, speed, target }, point))
    }

    /// Returns the problem at another instant (s), drawn to given scales. A plate with rates given
    /// at the instant keeps its angular acceleration.
    ///
    /// # Errors
    /// Laws of a plate without a value.
    pub fn at(&self, t: f64, mu: Option<[f64; 3]>) -> Result<ParticleProblem, Diagnostic> {
        let mut moved = self.clone();
        moved.time = Law::number(t);
        for plate in &mut moved.plates {
            plate.turning = plate.turning.later(t - self.instant())?;
        }
        if let Some(mu) = mu {
            moved.paper.scales = scene::Kind::DRAWN.into_iter().zip(mu).collect();
        }
        Ok(moved)
    }

    /// Returns the instant (s).
    pub fn instant(&self) -> f64 {
        self.time.at(0.0).map_or(0.0, |v| v.number.0[0])
    }
}
