//! The analytic method, written out: closed loops of vectors, their real and imaginary parts, the
//! unknowns of each Assur group in closed form, and the time derivatives.
//!
//! The links and joints form a graph ([`graph`]); each group closes its loops of vectors
//! ([`vectors`]). Groups are solved in order ([`solve`]): the positions of a dyad by elimination,
//! velocities and accelerations by projection onto the direction that removes the other unknown;
//! groups with several loops by the matrix of their equations. Every formula carries the values of
//! its symbols ([`formula`]), and its result is the one that later formulas use. Of the positions
//! only the assembly is taken, and the unknowns of groups that have no closed form.
//!
//! # Source
//! The method of complex numbers: 孙桓等, 机械原理; R. L. Norton, *Design of Machinery*.

mod formula;
mod graph;
mod motion;
mod solve;
mod vectors;

pub use formula::{Formula, UnaryFunction};
pub use motion::{CoordinateEquations, FrameEquations, MotionEquations, PointEquations};
pub use vectors::{LoopVariable, LoopVector, VectorAngle, VectorSize};

use graph::Graph;
use hodograph_base::diag::{Both, Diagnostic, Faults, Warned, both};
use hodograph_base::linear::LinearSystem;
use hodograph_mechanism::mechanism::Mechanism;
use hodograph_mechanism::position::Configuration;
use hodograph_scene::{Kind, LinkId, Scene};
use hodograph_worked::worked::{Scope, work};
use nalgebra::{DMatrix, DVector};
use solve::GroupEquations;
use vectors::VectorMaker;

/// An equation between two formulas.
#[derive(Clone, Debug, PartialEq)]
pub struct Equation {
    /// The left side; a single symbol for a quantity that the equation gives.
    pub left: Formula,
    /// The right side.
    pub right: Formula,
    /// The quantity of both sides; `None` for a product of two lengths.
    pub kind: Option<Kind>,
}

impl Equation {
    fn new(left: Formula, right: Formula, kind: impl Into<Option<Kind>>) -> Equation {
        Equation { left, right, kind: kind.into() }
    }
}

/// The closed form of a group's positions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PositionForm {
    /// Two unknown angles: A cos φ + B sin φ + C = 0.
    TwoAngles,
    /// An unknown angle and a distance along a known direction.
    AngleAndLength,
    /// A distance along a link of unknown angle.
    SlottedLever,
    /// Two distances along known directions.
    TwoLengths,
    /// No closed form is written out, or the pose is so near a dead centre that it loses its digits:
    /// Newton's method.
    Newton,
}

/// The linear systems A x = b of the derivatives: those of the velocities and of the accelerations
/// have the same coefficients.
#[derive(Clone, Debug, PartialEq)]
pub struct LoopSystem {
    /// The rows of A: real and imaginary part of each loop.
    pub rows: Vec<Vec<f64>>,
    /// The right sides of the velocities and of the accelerations.
    pub right: [Vec<f64>; 2],
}

/// The largest condition number (1-norm) of a matrix whose solution is printed: beyond it, the
/// rounding errors of the pose reach the printed digits of accelerations.
const WORST_CONDITION: f64 = 1e4;

/// Factors a square matrix; `None` if it is singular or nearly so. Each column is measured in its
/// unit.
fn factored(rows: &[Vec<f64>], units: &[f64]) -> Option<LinearSystem> {
    let n = units.len();
    let norm = |m: &DMatrix<f64>| m.column_iter().map(|c| c.lp_norm(1)).fold(0.0, f64::max);
    let system = LinearSystem::new(DMatrix::from_fn(n, n, |r, c| rows[r][c] / units[c]));
    let columns: Option<Vec<_>> = (0..n)
        .map(|k| system.solve(&DVector::from_fn(n, |r, _| f64::from(u8::from(r == k)))))
        .collect();
    let inverse = DMatrix::from_columns(&columns?);
    let condition = norm(system.matrix()) * norm(&inverse);
    // A condition that is no number is refused too.
    (condition <= WORST_CONDITION).then_some(system)
}

/// One group: its loops and their solution.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupLoops {
    /// The group, an index into [`Mechanism::groups`].
    pub group: usize,
    /// The links.
    pub links: Vec<LinkId>,
    /// The kind, such as RRR ([`hodograph_mechanism::mechanism::Group::kind`]).
    pub kind: String,
    /// The loops.
    pub loops: Vec<Vec<LoopVector>>,
    /// The unknowns, as indices into [`Loops::variables`].
    pub unknowns: Vec<usize>,
    /// Real and imaginary part of each loop.
    pub closures: Vec<Equation>,
    /// The form of the positions.
    pub form: PositionForm,
    /// The positions, in the order of calculation; empty for Newton's method.
    pub position: Vec<Equation>,
    /// The linear systems of velocities and accelerations.
    pub system: LoopSystem,
    /// Velocities by projection; empty for a group with several loops.
    pub velocities: Vec<Equation>,
    /// Accelerations by projection; empty for a group with several loops.
    pub accelerations: Vec<Equation>,
}

/// The loops of a mechanism with their solution.
#[derive(Clone, Debug, PartialEq)]
pub struct Loops {
    /// The variables, with their values and derivatives.
    pub variables: Vec<LoopVariable>,
    /// The groups in the order of solution.
    pub groups: Vec<GroupLoops>,
    /// The equations of motion of points that drivers move directly.
    pub motion: MotionEquations,
}

/// Finds the loops of a scene and solves them.
///
/// # Errors
/// `loops` for pairs that no closed vectors describe and for groups that they do not determine; the
/// faults of [`work`].
pub fn loops(scene: &Scene) -> Result<Warned<Loops>, Faults> {
    let Warned { value: worked, notes } = work(scene, Scope::Figure)?;
    let value = placed(scene, &worked.mechanism, &worked.configuration)?;
    Ok(Warned { value, notes })
}

/// Finds the loops of a mechanism in its pose and solves them.
///
/// # Errors
/// As [`loops`].
pub fn placed(scene: &Scene, m: &Mechanism, at: &Configuration) -> Result<Loops, Diagnostic> {
    let graph = Graph::of(scene)?;
    let mut maker = VectorMaker::new(scene, at, &graph);
    let mut groups: Vec<GroupLoops> = Vec::new();
    let mut solved: Vec<bool> = Vec::new();
    for cycles in graph.cycles(scene, m) {
        let group = &m.groups[cycles.group];
        let found: Option<Vec<_>> = cycles.cycles.iter().map(|c| maker.vectors(c)).collect();
        let vectors = found.ok_or_else(|| open(scene, &group.links))?;
        solved.resize(maker.variables.len(), false);
        let mut unknowns = Vec::new();
        let used = vectors.iter().flatten().flat_map(|v| {
            let size = match v.size {
                VectorSize::Variable(k) => Some(k),
                VectorSize::Fixed(..) => None,
            };
            v.angle.variable.into_iter().chain(size)
        });
        for k in used {
            let driver = maker.variables[k].driver;
            if let (Some(d), false) = (driver, solved[k]) {
                let [rate, second] = maker.rates(d);
                (maker.variables[k].rate, maker.variables[k].second) = (rate, second);
                solved[k] = true;
            }
            if !solved[k] && !unknowns.contains(&k) {
                unknowns.push(k);
            }
        }
        if unknowns.len() != 2 * vectors.len() {
            return Err(open(scene, &group.links));
        }
        let mut equations =
            GroupEquations { variables: &mut maker.variables, loops: &vectors, unknowns };
        let closures = vectors.iter().flat_map(|v| equations.closure(v)).collect();
        let (form, position) =
            equations.sound_positions().unwrap_or((PositionForm::Newton, Vec::new()));
        let system = equations.rates().ok_or_else(|| open(scene, &group.links))?;
        let [velocities, accelerations] =
            [1, 2].map(|order| equations.by_projection(order).unwrap_or_default());
        let unknowns = std::mem::take(&mut equations.unknowns);
        unknowns.iter().for_each(|k| solved[*k] = true);
        groups.push(GroupLoops {
            group: cycles.group,
            links: group.links.clone(),
            kind: group.kind(),
            loops: vectors,
            unknowns,
            closures,
            form,
            position,
            system,
            velocities,
            accelerations,
        });
    }
    let motion = motion::motion_equations(scene, at);
    Ok(Loops { variables: maker.variables, groups, motion })
}

/// The fault of a group that its loops do not determine, or not to the printed digits.
fn open(scene: &Scene, links: &[LinkId]) -> Diagnostic {
    let names: Vec<&str> = links.iter().map(|l| scene.link_name(*l)).collect();
    Diagnostic::error(
        "loops",
        both!(
            "the vector loops do not determine the group of links {} in this pose: it is at a dead centre or near one",
            Both::names(&names)
        ),
    )
    .help(both!(
        "`hodograph solve` answers there, with the number of true digits; or choose another pose"
    ))
}
