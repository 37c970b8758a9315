//! Whether a pose is singular as it is written, where `f64` cannot tell.
//!
//! A pose by lengths is known in `f64` to the root of its rounding only: within some 1e-8 of a dead point or a limit the loop
//! equations must take it for one. In longer numbers the lengths are what is written, and a group whose pivots are surely not
//! zero has one motion.

use super::ladder::{Climb, Rung};
use crate::answer::{Value, evaluate};
use crate::geom::Vec2;
use crate::mechanism::{Demand, Mechanism};
use crate::motion;
use crate::number::decimal::Certain;
use crate::position::{self, Configuration};
use crate::scene::{Find, Scene};

/// A pose that is not singular as written.
#[derive(Clone, Debug, PartialEq)]
pub struct Regular {
    /// The answer to each question, to `f64`; `None` where it has none.
    pub values: Vec<Option<Value>>,
    /// The rung that told the pose from a singular one.
    pub rung: Rung,
}

/// The answers to some questions, whose demand is given, in a pose that `f64` takes for singular, if on some rung every group surely has one motion; `None` where the
/// pose is singular as written, or does not close.
pub fn regular(scene: &Scene, m: &Mechanism, demand: &Demand, at: &Configuration, questions: &[Find]) -> Option<Regular> {
    let written = Written { scene, m, demand, at, questions };
    Rung::LADDER.into_iter().find_map(|rung| Some(Regular { values: rung.climb(&written)?, rung }))
}

struct Written<'a> {
    scene: &'a Scene,
    m: &'a Mechanism,
    demand: &'a Demand,
    at: &'a Configuration,
    questions: &'a [Find],
}

impl Climb for Written<'_> {
    type Found = Option<Vec<Option<Value>>>;

    fn with<N: Certain>(&self) -> Self::Found {
        let at = position::recompute::<N>(self.scene, self.m, self.demand, self.at).ok()?;
        let motion = motion::solve(self.scene, self.m, &at, self.demand);
        let value = |v: Value<N>| match v {
            Value::Scalar(s) => Value::Scalar(s.approx()),
            Value::Vector(v) => Value::Vector(Vec2::approx(v)),
        };
        let answer = |find: &Find| evaluate(self.scene, &at, &motion, &find.what).map(value);
        motion.singular.is_empty().then(|| self.questions.iter().map(answer).collect())
    }
}
