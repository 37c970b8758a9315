//! A scene worked through: every stage once, in order, each result kept.
//!
//! The arrows of the crate documentation as one call, for the command line, for tests and for callers who want it all. Each
//! stage is public by itself as well.

use crate::accuracy::{Agreement, BadAngle, Drafting, Drawn, bad_angles, compare, drafting};
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
    /// Crossings under less than 10°, with what helps.
    pub bad_angles: Vec<BadAngle>,
    /// The tolerances of hand drawing, where [`Worked::with_drafting`] asked for them.
    pub drafting: Option<Drafting>,
}

impl Worked {
    /// All that is needed to draw the construction again with another pencil.
    pub fn drawn<'a>(&'a self, scene: &'a Scene) -> Drawn<'a> {
        Drawn {
            scene,
            mechanism: &self.mechanism,
            configuration: &self.configuration,
            plan: &self.plan,
            construction: &self.construction,
            values: self.results.iter().map(|r| r.drawn.as_ref().map(|_| r.value())).collect(),
        }
    }

    /// The same with the tolerances that drawing by hand has: for the scene's pencil, or the usual one.
    pub fn with_drafting(mut self, scene: &Scene) -> Worked {
        self.drafting = Some(drafting(&self.drawn(scene), pencil_mm(scene)));
        self
    }
}

/// The pencil error of a scene (mm).
fn pencil_mm(scene: &Scene) -> f64 {
    scene.paper.pencil_mm.unwrap_or(construct::pencil::USUAL_MM)
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
    /// The size (SI) of what it is measured against: the largest vector or rate of its kind, for positions the mechanism.
    pub scale: f64,
}

impl Outcome {
    /// The value to print: the drawing's where there is one; zero where it is no more than rounding.
    pub fn value(&self) -> Value {
        let value = self.drawn.as_ref().map_or(self.computed, |a| a.value);
        match (value, self.agreement) {
            (Value::Vector(_), Some(a)) if value.magnitude() <= a.noise => Value::Vector(crate::geom::Vec2::ZERO),
            (Value::Scalar(_), Some(a)) if value.magnitude() <= a.noise => Value::Scalar(0.0),
            _ => value,
        }
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
    let construction = construct::construct(scene, &mechanism, &configuration, &plan, &Boxes::of(&scene.paper, &plan))?;
    let solution = analytic::solve(scene, &mechanism, &configuration, &demand)?;
    let drawn = construct::read(scene, &mechanism, &configuration, &plan, &construction);
    let mut results = Vec::new();
    for (i, (find, drawn)) in scene.find.iter().zip(drawn).enumerate() {
        let Some(computed) = evaluate(scene, &configuration, &solution, &find.what) else {
            return Err(Diagnostic::error("cannot-answer", format!("{} cannot be answered here", find.text)).at(find.span).into());
        };
        let level = level_of(&find.what);
        let scale = match level {
            Level::Position => configuration.extent(),
            _ => scale_of(scene, &construction, &configuration, level, &computed),
        };
        let agreement = match (&drawn, level) {
            (_, Level::Position) | (None, _) => None,
            (Some(d), _) => {
                let worst = construction.magnification[usize::from(level == Level::Acceleration)];
                Some(compare(d.value, computed, scale, worst))
            }
        };
        results.push(Outcome { find: i, drawn, computed, agreement, scale });
    }

    let mut worked =
        Worked { mechanism, demand, configuration, plan, construction, solution, results, bad_angles: Vec::new(), drafting: None };
    let drawn = worked.drawn(scene);
    let bad_angles = bad_angles(&drawn, pencil_mm(scene));
    notes.extend(bad_angles.iter().map(|b| b.diagnostic(&drawn)));
    worked.bad_angles = bad_angles;
    Ok(Warned { value: worked, notes })
}

/// The size against which a small answer of a level is judged: the longest vector of its polygon, or what the drivers
/// would make at the size of the mechanism where all vectors vanish; for a turning rate the largest rate, or what that
/// vector makes on the shortest arm on which a rate was measured (ω of a short link is a small difference of vectors
/// divided by a small length, and α may vanish where ω² l does not).
fn scale_of(scene: &Scene, paper: &Construction, at: &Configuration, level: Level, value: &Value) -> f64 {
    let extent = at.extent();
    // A driver that starts from rest has no speed yet; what it would have after turning by a radian measures it.
    let driven = |d: &crate::scene::Driver| {
        let (rate, a) = (d.rate.value.abs(), d.acceleration.as_ref().map_or(0.0, |a| a.value.abs()));
        match d.kind {
            crate::scene::DriverKind::Turn { .. } => rate.max(a.sqrt()) * extent,
            _ => rate.max((a * extent).sqrt()),
        }
    };
    let largest = |level| paper.polygon(level).map_or(0.0, construct::Polygon::largest);
    let speed = scene.drivers.iter().map(driven).fold(largest(Level::Velocity), f64::max);
    let vector = match level {
        Level::Acceleration if extent > 0.0 => largest(level).max(speed * speed / extent),
        Level::Acceleration => largest(level),
        _ => speed,
    };
    match value {
        Value::Vector(_) => vector,
        Value::Scalar(_) => {
            let rates = paper.rates.iter().filter(|r| r.level == level);
            let largest = rates.clone().map(|r| r.value.abs()).fold(0.0, f64::max);
            let arm = rates.filter_map(|r| r.measured).map(|m| m.1).fold(extent, f64::min);
            if arm > 0.0 { largest.max(vector / arm) } else { largest }
        }
    }
}
