//! Plane vector equations on their own: D = A + B + C, with any number of vectors on both sides,
//! and two unknowns among their magnitudes and directions.
//!
//! Such a file has the front of a scene, `equation`, `vectors` and `lines`. [`read`] gives a
//! [`VectorEquation`], [`solve`] the unknowns in closed form with certain digits. The drawing with
//! ruler and compasses is in [`board`]; it uses none of these formulas.
//!
//! ```
//! use hodograph_methods::equation::{EquationCase, read, solve, templates};
//! let problem = read(templates::get("two-magnitudes").unwrap())?.value;
//! let solved = solve(&problem)?;
//! assert_eq!(solved.case, EquationCase::Magnitudes([0, 2]));
//! assert_eq!(solved.roots.len(), 1);
//! # Ok::<(), hodograph_base::diag::Faults>(())
//! ```

pub mod board;
mod read;
pub mod schema;
mod solve;
pub mod templates;

pub use read::{is_problem, read};
pub use solve::{EquationSolution, RootVector, VectorRoot, solve};

use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::geom::Vec2;
use hodograph_base::number::Real;
use hodograph_scene::front::Law;
use hodograph_scene::{Book, DiagramKind, Lang, Paper};

/// The content of a file.
#[derive(Clone, Debug)]
pub struct VectorEquation {
    /// The title.
    pub title: Both,
    /// The statement, with the values of its parameters inserted.
    pub statement: Option<Both>,
    /// The language that the file names.
    pub language: Option<Lang>,
    /// The notation profile that the file names.
    pub notation: Option<String>,
    /// The sheet and its scales.
    pub paper: Paper,
    /// The units of printed values.
    pub book: Book,
    /// The diagram, which decides the kind of quantity and the scale.
    pub on: DiagramKind,
    /// The vectors: those left of the sign of equality first, each side as written.
    pub terms: Vec<VectorTerm>,
}

/// A vector of an equation.
#[derive(Clone, Debug)]
pub struct VectorTerm {
    /// Its name as written.
    pub name: String,
    /// True if it is left of the sign of equality.
    pub left: bool,
    /// The magnitude, if known.
    pub magnitude: Option<Law>,
    /// The direction, if known.
    pub direction: Option<TermDirection>,
}

/// A known direction.
#[derive(Clone, Debug)]
pub struct TermDirection {
    /// The angle from the x axis: of the vector, or of the line.
    pub angle: Law,
    /// The line to which it is parallel or perpendicular.
    pub line: Option<String>,
    /// True if it is perpendicular to the line: its angle plus 90°.
    pub across: bool,
}

impl TermDirection {
    /// Returns the unit vector.
    ///
    /// # Errors
    /// An angle without a value.
    pub fn unit<N: Real>(&self) -> Result<Vec2<N>, Diagnostic> {
        let (sine, cosine) = self.angle.at(N::from_f64(0.0))?.sin_cos();
        let along = Vec2::new(cosine.0[0], sine.0[0]);
        Ok(if self.across { along.perp() } else { along })
    }
}

impl VectorTerm {
    /// Returns the magnitude, if known (SI).
    ///
    /// # Errors
    /// A magnitude without a value.
    pub fn size<N: Real>(&self) -> Result<Option<N>, Diagnostic> {
        let value = |law: &Law| Ok(law.at(N::from_f64(0.0))?.si().0[0]);
        self.magnitude.as_ref().map(value).transpose()
    }

    /// Returns the unit vector of the direction, if known.
    ///
    /// # Errors
    /// An angle without a value.
    pub fn unit<N: Real>(&self) -> Result<Option<Vec2<N>>, Diagnostic> {
        self.direction.as_ref().map(TermDirection::unit).transpose()
    }

    /// Returns the known vector, if magnitude and direction are known.
    ///
    /// # Errors
    /// A magnitude or an angle without a value.
    pub fn vector<N: Real>(&self) -> Result<Option<Vec2<N>>, Diagnostic> {
        Ok(self.unit::<N>()?.zip(self.size()?).map(|(u, size)| u * size))
    }

    /// Returns the symbol in the label language, with a number of primes: `v'_{CB}` for `v_CB`.
    pub fn symbol(&self, primes: usize) -> String {
        let (stem, below) = self.name.split_once('_').unwrap_or((&self.name, ""));
        let (stem, above) = stem.split_once('^').unwrap_or((stem, ""));
        let script = |sign: &str, text: &str| {
            if text.is_empty() { String::new() } else { format!("{sign}{{{text}}}") }
        };
        format!("{stem}{}{}{}", "'".repeat(primes), script("^", above), script("_", below))
    }
}

/// The unknowns of a solvable equation, by the indices of their vectors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EquationCase {
    /// Magnitude and direction of one vector: the closing side of the polygon.
    Vector(usize),
    /// Magnitudes of two vectors: two lines that cross.
    Magnitudes([usize; 2]),
    /// Directions of two vectors: two circles that cross.
    Directions([usize; 2]),
    /// Magnitude of one vector and direction of another: a line and a circle that cross.
    Mixed {
        /// The vector of unknown magnitude.
        magnitude: usize,
        /// The vector of unknown direction.
        direction: usize,
    },
}

impl EquationCase {
    /// Returns the case of an equation.
    ///
    /// # Errors
    /// `equation-unknowns` for more or less than two unknowns, with their names.
    pub fn of(terms: &[VectorTerm]) -> Result<EquationCase, Diagnostic> {
        let [sizes, directions] = unknowns(terms);
        match (&sizes[..], &directions[..]) {
            ([a], [b]) if a == b => Ok(EquationCase::Vector(*a)),
            ([a, b], []) => Ok(EquationCase::Magnitudes([*a, *b])),
            ([], [a, b]) => Ok(EquationCase::Directions([*a, *b])),
            ([a], [b]) => Ok(EquationCase::Mixed { magnitude: *a, direction: *b }),
            _ => Err(not_two(terms, &sizes, &directions)),
        }
    }

    /// Returns the indices of the vectors with unknowns.
    pub fn vectors(self) -> Vec<usize> {
        match self {
            EquationCase::Vector(k) => vec![k],
            EquationCase::Magnitudes(two) | EquationCase::Directions(two) => two.to_vec(),
            EquationCase::Mixed { magnitude, direction } => vec![magnitude, direction],
        }
    }

    /// Returns the case in words.
    pub fn words(self) -> Both {
        match self {
            EquationCase::Vector(_) => both!(
                "magnitude and direction of one vector are unknown: the closing side of the polygon"
            ),
            EquationCase::Magnitudes(_) => {
                both!("two magnitudes are unknown, their directions known: two lines that cross")
            }
            EquationCase::Directions(_) => {
                both!("two directions are unknown, their magnitudes known: two circles that cross")
            }
            EquationCase::Mixed { .. } => both!(
                "the magnitude of one vector and the direction of another are unknown: a line and a circle that cross"
            ),
        }
    }
}

/// Returns the indices of the vectors of unknown magnitude, and of those of unknown direction.
pub fn unknowns(terms: &[VectorTerm]) -> [Vec<usize>; 2] {
    let which = |unknown: fn(&VectorTerm) -> bool| {
        (0..terms.len()).filter(|k| unknown(&terms[*k])).collect::<Vec<_>>()
    };
    [which(|t| t.magnitude.is_none()), which(|t| t.direction.is_none())]
}

/// Returns the names of unknowns: `magnitude of v_C, direction of v_CB`.
fn listed(terms: &[VectorTerm], sizes: &[usize], directions: &[usize]) -> Both {
    let size = |k: &usize| both!("magnitude of {}", terms[*k].name);
    let direction = |k: &usize| both!("direction of {}", terms[*k].name);
    let all: Vec<Both> = sizes.iter().map(size).chain(directions.iter().map(direction)).collect();
    Both {
        en: all.iter().map(|b| b.en.as_str()).collect::<Vec<_>>().join(", "),
        zh: all.iter().map(|b| b.zh.as_str()).collect::<Vec<_>>().join("、"),
    }
}

fn not_two(terms: &[VectorTerm], sizes: &[usize], directions: &[usize]) -> Diagnostic {
    let count = sizes.len() + directions.len();
    let names = listed(terms, sizes, directions);
    let message = match count {
        0 => both!("not solvable: 0 unknowns; a plane equation settles two"),
        1 => both!("not solvable: 1 unknown ({}); a plane equation settles two", names),
        _ => both!("not solvable: {count} unknowns ({}); a plane equation settles two", names),
    };
    let help = if count < 2 {
        both!(
            "leave out another magnitude or direction: with all given the equation may contradict itself"
        )
    } else {
        both!(
            "give {} of them, or eliminate a vector: set two equations of it equal, such as v_A + v_CA = v_B + v_CB",
            count - 2
        )
    };
    Diagnostic::error("equation-unknowns", message).help(help)
}
