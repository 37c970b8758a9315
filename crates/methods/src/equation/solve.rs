//! The unknowns in closed form: projections, the law of sines, the law of cosines.
//!
//! The known vectors are summed and moved to one side. Then x + σ y = d, where x and y are the
//! vectors with unknowns, d the known sum, and σ = −1 if x and y are on different sides of the
//! equation:
//! - two magnitudes: x × y₀ = d × y₀ and x₀ × σ y = x₀ × d, with unit vectors x₀, y₀;
//! - two directions: the part of x along d is (d² + x² − y²)/2d (law of cosines);
//! - magnitude of x, direction of y: the part of σ y square to x is that of d (law of sines).
//!
//! All is evaluated in balls of [`BITS`] bits, so that printed digits are certain.

use super::{EquationCase, VectorEquation};
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::digits::legible;
use hodograph_base::geom::Vec2;
use hodograph_base::number::decimal::{Certain, Enclosure};
use hodograph_base::number::{Ball, Big, Real, within};

/// Bits of the numbers.
const BITS: usize = 256;

/// The solution of an equation.
#[derive(Clone, Debug, PartialEq)]
pub struct EquationSolution {
    /// The unknowns.
    pub case: EquationCase,
    /// The solutions: one, or two in a fixed order. For two unknown directions the polygon left of
    /// the closing line comes first; for a magnitude and a direction the one farther along the
    /// known direction.
    pub roots: Vec<VectorRoot>,
}

/// One solution: the vectors with unknowns.
#[derive(Clone, Debug, PartialEq)]
pub struct VectorRoot {
    /// The vectors, in the order of [`EquationCase::vectors`].
    pub vectors: Vec<RootVector>,
    /// Sine of the angle at which the two lines or circles of the construction cross; 1 for a
    /// closing side.
    pub sine: f64,
}

/// A vector that was unknown in part.
#[derive(Clone, Debug, PartialEq)]
pub struct RootVector {
    /// The index of the vector.
    pub term: usize,
    /// The vector (SI).
    pub value: Vec2,
    /// The magnitude (SI).
    pub magnitude: Enclosure,
    /// The angle from the x axis (degrees), in (−180°, 180°]; `None` for a vector of length 0.
    pub angle: Option<Enclosure>,
}

/// Solves an equation.
///
/// # Errors
/// `equation-unknowns` unless two unknowns are left; `equation-parallel` if the two known
/// directions are parallel; `equation-no-solution` if lines or circles do not meet; a quantity
/// without a value.
pub fn solve(problem: &VectorEquation) -> Result<EquationSolution, Faults> {
    let case = EquationCase::of(&problem.terms)?;
    let roots = within(BITS, || roots::<Ball<Big>>(problem, case))?;
    Ok(EquationSolution { case, roots })
}

/// The sum of known vectors, and the data of the vectors with unknowns.
struct ReducedEquation<N> {
    /// d.
    sum: Vec2<N>,
    /// σ.
    sign: N,
    /// Magnitudes of x and y, if known.
    sizes: [Option<N>; 2],
    /// Unit vectors of x and y, if known.
    units: [Option<Vec2<N>>; 2],
}

fn reduced<N: Real>(
    problem: &VectorEquation,
    case: EquationCase,
) -> Result<ReducedEquation<N>, Diagnostic> {
    let terms = &problem.terms;
    let wanted = case.vectors();
    let (x, y) = (&terms[wanted[0]], wanted.get(1).map(|k| &terms[*k]));
    let mut sum = Vec2::zero();
    for term in terms {
        if let Some(v) = term.vector::<N>()? {
            sum = if term.left == x.left { sum - v } else { sum + v };
        }
    }
    let one = N::from_f64(1.0);
    let sign = if y.is_some_and(|y| y.left != x.left) { -one } else { one };
    let of_y = |y: Option<&super::VectorTerm>| -> Result<_, Diagnostic> {
        y.map_or(Ok((None, None)), |y| Ok((y.size()?, y.unit()?)))
    };
    let (size, unit) = of_y(y)?;
    Ok(ReducedEquation { sum, sign, sizes: [x.size()?, size], units: [x.unit()?, unit] })
}

/// Two vectors x and y (y the same as x if there is one), and the sine of the crossing.
type VectorPair<N> = ([Vec2<N>; 2], f64);

fn roots<N: Certain>(
    problem: &VectorEquation,
    case: EquationCase,
) -> Result<Vec<VectorRoot>, Diagnostic> {
    let r = reduced::<N>(problem, case)?;
    let pairs: Vec<VectorPair<N>> = match (case, r.sizes, r.units) {
        (EquationCase::Magnitudes(_), _, [Some(u), Some(w)]) => {
            vec![crossed(problem, case, &r, u, w)?]
        }
        (EquationCase::Directions(_), [Some(x), Some(y)], _) => circles(problem, case, &r, x, y)?,
        (EquationCase::Mixed { .. }, [_, Some(y)], [Some(u), _]) => {
            line_circle(problem, case, &r, u, y)?
        }
        (EquationCase::Vector(_), ..)
        | (EquationCase::Magnitudes(_), ..)
        | (EquationCase::Directions(_), ..)
        | (EquationCase::Mixed { .. }, ..) => vec![([r.sum, r.sum], 1.0)],
    };
    let terms = case.vectors();
    let root = |(pair, sine): &VectorPair<N>| {
        let vectors = terms.iter().zip(pair).map(|(k, v)| vector(*k, *v));
        Ok(VectorRoot { vectors: vectors.collect::<Result<_, _>>()?, sine: *sine })
    };
    pairs.iter().map(root).collect()
}

/// A vector with its certain digits.
fn vector<N: Certain>(term: usize, v: Vec2<N>) -> Result<RootVector, Diagnostic> {
    let undecided = || {
        Diagnostic::error(
            "equation-no-solution",
            both!("the numbers of the equation have no value"),
        )
    };
    let size = v.norm();
    let degrees = v.angle() * N::from_f64(180.0) / N::pi();
    let angle = if size.approx() > size.radius() { degrees.enclosure() } else { None };
    Ok(RootVector {
        term,
        value: v.approx(),
        magnitude: size.enclosure().ok_or_else(undecided)?,
        angle,
    })
}

/// Two magnitudes.
fn crossed<N: Real>(
    problem: &VectorEquation,
    case: EquationCase,
    r: &ReducedEquation<N>,
    u: Vec2<N>,
    w: Vec2<N>,
) -> Result<VectorPair<N>, Diagnostic> {
    let sine = u.cross(w);
    if sine.approx().abs() <= sine.radius() {
        let names = case.vectors();
        let [x, y] = [names[0], names[1]].map(|k| &problem.terms[k].name);
        let across = u.cross(r.sum).approx();
        let message = both!("not solvable: the directions of {x} and {y} are parallel");
        let help = if across.abs() <= u.cross(r.sum).radius() {
            both!("the known sum has the same direction: any sum of the two closes the polygon")
        } else {
            both!(
                "the two lines of the polygon do not cross: they are {} {} apart",
                legible(across.abs(), 4),
                problem.on.kind().si()
            )
        };
        return Err(Diagnostic::error("equation-parallel", message).help(help));
    }
    let (a, b) = (r.sum.cross(w) / sine, r.sign * u.cross(r.sum) / sine);
    Ok(([u * a, w * b], sine.approx().abs()))
}

/// Two directions.
fn circles<N: Real>(
    problem: &VectorEquation,
    case: EquationCase,
    r: &ReducedEquation<N>,
    x: N,
    y: N,
) -> Result<Vec<VectorPair<N>>, Diagnostic> {
    let distance = r.sum.norm();
    if distance.approx() <= distance.radius() {
        let gap = (x - y).approx().abs();
        return Err(if gap <= (x - y).radius() {
            apart(
                problem,
                case,
                both!(
                    "the known vectors sum to 0 and both circles are the same: every direction closes the polygon"
                ),
            )
        } else {
            missed(problem, case, gap, both!("one circle encloses the other"))
        });
    }
    let two = N::from_f64(2.0);
    let part = (distance * distance + (x - y) * (x + y)) / (two * distance);
    let rest = x * x - part * part;
    let along = r.sum * (N::from_f64(1.0) / distance);
    let pair = |side: N| {
        let v = along * part + along.perp() * side;
        [v, (r.sum - v) * r.sign]
    };
    // The area of the triangle of x, y, d gives the sine of the angle between the circles.
    let sine = |side: N| (side * distance / (x * y)).approx().abs();
    match standing(rest) {
        CircleMeeting::Apart => {
            let (d, x, y) = (distance.approx(), x.approx(), y.approx());
            Err(if d > x + y {
                missed(problem, case, d - x - y, both!("the circles lie apart"))
            } else {
                let gap = (x - y).abs() - d;
                missed(problem, case, gap, both!("one circle encloses the other"))
            })
        }
        CircleMeeting::Touching => Ok(vec![(pair(N::from_f64(0.0)), 0.0)]),
        CircleMeeting::Crossing => {
            let side = rest.sqrt();
            Ok(vec![(pair(side), sine(side)), (pair(-side), sine(side))])
        }
    }
}

/// The magnitude of x and the direction of y.
fn line_circle<N: Real>(
    problem: &VectorEquation,
    case: EquationCase,
    r: &ReducedEquation<N>,
    u: Vec2<N>,
    y: N,
) -> Result<Vec<VectorPair<N>>, Diagnostic> {
    let (along, across) = (u.dot(r.sum), u.cross(r.sum));
    let rest = y * y - across * across;
    let pair = |part: N| [u * (along - part), (u * part + u.perp() * across) * r.sign];
    match standing(rest) {
        CircleMeeting::Apart => {
            let gap = across.approx().abs() - y.approx();
            Err(missed(problem, case, gap, both!("the line passes the circle")))
        }
        CircleMeeting::Touching => Ok(vec![(pair(N::from_f64(0.0)), 0.0)]),
        CircleMeeting::Crossing => {
            let part = rest.sqrt();
            let sine = (part / y).approx().abs();
            Ok(vec![(pair(-part), sine), (pair(part), sine)])
        }
    }
}

/// Line and circle, or two circles, judged by the square of half their common chord.
enum CircleMeeting {
    Apart,
    Touching,
    Crossing,
}

fn standing<N: Real>(square: N) -> CircleMeeting {
    match square.approx() {
        value if value > square.radius() => CircleMeeting::Crossing,
        value if value < -square.radius() => CircleMeeting::Apart,
        _ => CircleMeeting::Touching,
    }
}

/// The message for circles or lines that miss each other by a distance (SI).
fn missed(problem: &VectorEquation, case: EquationCase, gap: f64, how: Both) -> Diagnostic {
    let kind = problem.on.kind();
    let by = problem.book.text(kind, &legible(problem.book.value(kind, gap), 4));
    apart(problem, case, both!("{}; they miss each other by {by}", how))
}

fn apart(problem: &VectorEquation, case: EquationCase, why: Both) -> Diagnostic {
    let names: Vec<&str> = case.vectors().iter().map(|k| problem.terms[*k].name.as_str()).collect();
    let message = both!(
        "no solution for {}: {}",
        Both { en: names.join(" and "), zh: names.join("、") },
        why
    );
    Diagnostic::error("equation-no-solution", message)
        .help(both!("check the magnitudes: no triangle has these sides"))
}
