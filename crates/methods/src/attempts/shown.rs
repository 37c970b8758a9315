//! The equation in which a mistake is seen, and the vector in it that is framed.

use hodograph_board::plan::{Plan, PlanStep, Term};
use hodograph_scene::DiagramKind;

/// The solution to which an equation belongs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SolutionSide {
    /// The right solution: the wrong one lacks the framed vector.
    Right,
    /// The wrong solution: the framed vector is wrong.
    Wrong,
}

/// A vector that the printed equation leaves out.
#[derive(Clone, Debug, PartialEq)]
pub struct Missing {
    /// The symbol.
    pub symbol: String,
    /// The direction.
    pub direction: String,
    /// The magnitude.
    pub magnitude: String,
}

/// The part of an equation that is shown.
#[derive(Clone, Debug, PartialEq)]
pub struct EquationPart {
    /// The polygon: velocities or accelerations.
    pub on: DiagramKind,
    /// The step.
    pub step: PlanStep,
    /// The solution to which the equation belongs.
    pub side: SolutionSide,
    /// The framed terms; if there are none, the whole equation is wrong.
    pub framed: Vec<Term>,
    /// A missing vector, shown framed.
    pub missing: Option<Missing>,
}

impl EquationPart {
    /// Finds a step of a polygon with a term for which `wrong` holds, and all such terms of it.
    /// Steps with two chains take precedence, which show more than one with known terms only; among
    /// equal steps the first is taken, in which the mistake has its effect alone.
    pub fn with(
        plan: &Plan,
        on: DiagramKind,
        side: SolutionSide,
        wrong: impl Fn(&Term) -> bool,
    ) -> Option<EquationPart> {
        let terms = |s: &PlanStep| -> Vec<Term> {
            s.chains()
                .iter()
                .flat_map(|c| c.known.iter().chain(&c.unknown))
                .filter(|t| wrong(t))
                .copied()
                .collect()
        };
        let all: Vec<&PlanStep> = plan
            .steps(on)
            .iter()
            .flat_map(|g| g.steps(0))
            .filter(|s| !terms(s).is_empty())
            .collect();
        let step = all.iter().find(|s| s.chains().len() == 2).or(all.first())?;
        Some(EquationPart { on, step: (*step).clone(), side, framed: terms(step), missing: None })
    }
}
