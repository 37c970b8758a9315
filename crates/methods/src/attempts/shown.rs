//! The equation in which a mistake is seen, and the vector in it that is framed.

use hodograph_board::plan::{Plan, Step, Term};
use hodograph_scene::DiagramKind;

/// Whose equation it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Of the right solution: the framed vector is what the wrong one lacks.
    Right,
    /// Of the wrong solution: the framed vector is wrong.
    Wrong,
}

/// A vector that the equation as printed has no place for.
#[derive(Clone, Debug, PartialEq)]
pub struct Missing {
    /// Its symbol.
    pub symbol: String,
    /// Its direction.
    pub direction: String,
    /// Its magnitude.
    pub magnitude: String,
}

/// What is shown of an equation.
#[derive(Clone, Debug, PartialEq)]
pub struct Shown {
    /// Of velocities or accelerations.
    pub on: DiagramKind,
    /// The step.
    pub step: Step,
    /// Whose it is.
    pub side: Side,
    /// The framed terms; where there are none, the whole statement is wrong.
    pub framed: Vec<Term>,
    /// A vector to be added, framed.
    pub missing: Option<Missing>,
}

impl Shown {
    /// The first step of a polygon with a term for which `wrong` holds, and all such terms of it.
    pub fn with(plan: &Plan, on: DiagramKind, side: Side, wrong: impl Fn(&Term) -> bool) -> Option<Shown> {
        let terms = |s: &Step| -> Vec<Term> {
            s.chains().iter().flat_map(|c| c.known.iter().chain(&c.unknown)).filter(|t| wrong(t)).copied().collect()
        };
        let all = plan.steps(on).iter().flat_map(|g| g.steps(0));
        // An equation with unknowns tells more than one in which all is known.
        let step = all.filter(|s| !terms(s).is_empty()).max_by_key(|s| (s.chains().len() == 2, std::cmp::Reverse(0)))?;
        Some(Shown { on, step: step.clone(), side, framed: terms(step), missing: None })
    }
}
