//! A scene worked through: every stage once, in order, each result kept.
//!
//! The arrows of the crate documentation as one call, for the command line, for tests and for callers who want it all. Each
//! stage is public by itself as well.

use crate::accuracy::{Agreement, compare};
use crate::analytic::{self, Solution};
use crate::answer::{Value, evaluate, level_of};
use crate::construct::scale::Boxes;
use crate::construct::{self, Answer, Construction};
use crate::diag::{Diagnostic, Faults, Warned};
use crate::mechanism::{Demand, Level, Mechanism};
use crate::plan::{self, Plan};
use crate::position::{self, Configuration};
use crate::scene::Scene;

/// How much is wanted beyond the scene's questions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scope {
    /// Only what the questions call for.
    #[default]
    Questions,
    /// All positions too, because the whole mechanism is to be drawn.
    Figure,
}

/// Everything that is known of a scene at its instant.
#[derive(Clone, Debug)]
pub struct Worked {
    /// Topology.
    pub mechanism: Mechanism,
    /// What the questions call for.
    pub demand: Demand,
    /// Positions.
    pub configuration: Configuration,
    /// Equations.
    pub plan: Plan,
    /// The drawing board.
    pub construction: Construction,
    /// The loop equations' solution.
    pub solution: Solution,
    /// One result for each question.
    pub results: Vec<Outcome>,
}

/// The answers to one question.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Index into the scene's `find` list.
    pub find: usize,
    /// Read off the paper; `None` where the group is not drawable.
    pub drawn: Option<Answer>,
    /// From the loop equations (positions: from the configuration).
    pub computed: Value,
    /// How far the two are apart; `None` for positions and where nothing was drawn.
    pub agreement: Option<Agreement>,
}

impl Outcome {
    /// The value to print: the drawing's where there is one.
    pub fn value(&self) -> Value {
        self.drawn.as_ref().map_or(self.computed, |a| a.value)
    }
}

/// Works a scene through.
///
/// # Errors
/// The faults of the first stage that has any.
pub fn work(scene: &Scene, scope: Scope) -> Result<Warned<Worked>, Faults> {
    let Warned { value: mechanism, mut notes } = Mechanism::new(scene)?;
    let mut demand = Demand::of(scene, &mechanism);
    if scope == Scope::Figure {
        demand = demand.with_all_positions();
    }
    let placed = position::configure(scene, &mechanism, &demand)?;
    let configuration = placed.value;
    notes.extend(placed.notes);
    let plan = plan::plan(scene, &mechanism, &demand);
    let construction = construct::construct(scene, &mechanism, &configuration, &plan, &Boxes::default())?;
    notes.extend(construction.warnings.iter().cloned());
    let solution = analytic::solve(scene, &mechanism, &configuration, &demand)?;
    let drawn = construct::read(scene, &mechanism, &configuration, &plan, &construction);
    let mut results = Vec::new();
    for (i, (find, drawn)) in scene.find.iter().zip(drawn).enumerate() {
        let Some(computed) = evaluate(scene, &configuration, &solution, &find.what) else {
            return Err(Diagnostic::error("cannot-answer", format!("{} cannot be answered here", find.text)).at(find.span).into());
        };
        let level = level_of(&find.what);
        let agreement = match (&drawn, level) {
            (_, Level::Position) | (None, _) => None,
            (Some(d), _) => {
                let scale = scale_of(&construction, configuration.extent(), level, matches!(computed, Value::Vector(_)));
                Some(compare(d.value, computed, scale, solution.condition, level))
            }
        };
        results.push(Outcome { find: i, drawn, computed, agreement });
    }
    Ok(Warned { value: Worked { mechanism, demand, configuration, plan, construction, solution, results }, notes })
}

/// The size against which a difference of the two ways is judged: the largest vector or rate of the level, or what the rest
/// of the motion makes of the mechanism's size `l` (v/l for ω, v²/l for a). Without the latter, a level at which everything
/// vanishes would compare rounding with rounding.
fn scale_of(drawn: &Construction, l: f64, level: Level, vector: bool) -> f64 {
    let largest = |level| drawn.polygon(level).map_or(0.0, construct::Polygon::largest);
    let (v, a) = (largest(Level::Velocity), largest(Level::Acceleration));
    let rates = |level| drawn.rates.iter().filter(|r| r.level == level).map(|r| r.value.abs()).fold(0.0, f64::max);
    let omega = rates(Level::Velocity).max(if l > 0.0 { v / l } else { 0.0 });
    match (level, vector) {
        (Level::Acceleration, true) => a.max(v * omega),
        (Level::Acceleration, false) => rates(Level::Acceleration).max(if l > 0.0 { a / l } else { 0.0 }).max(omega * omega),
        (_, true) => v,
        (_, false) => omega,
    }
}
