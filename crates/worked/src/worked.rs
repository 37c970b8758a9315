//! Works a scene through: every stage once, in order, with each result kept.
//!
//! This is the sequence of stages in the crate documentation as one call, for the command line, for
//! tests and for callers that need all results. Each stage is public by itself as well.

pub mod contact;
mod far;
mod higher;
mod joint;
mod pose;
mod posed;
mod remarks;
mod sizes;
#[cfg(test)]
mod tests;

pub use far::{InfiniteCentre, NoAnswer, Unanswered};
pub use joint::instant;
pub use posed::{work_motion, work_pose, work_replaced};

pub use self::pose::PoseDecisions;
use self::pose::{DecidedPose, PoseInput, groups_of};
use self::sizes::PoseSizes;
use crate::accuracy::Rung;
use crate::accuracy::{
    Agreement, BadAngle, DraftedConstruction, Drafting, bad_angles, compare, drafting, regular,
    settled,
};
use hodograph_analytic::{RefusedPart, Solution};
use hodograph_base::diag::{Faults, Warned};
use hodograph_board::construct::{self, FindAnswer, PlanDrawing};
use hodograph_board::equilibrium::Equilibrium;
use hodograph_board::plan::Plan;
use hodograph_mechanism::answer::{AnswerValue, MotionSource, evaluate};
use hodograph_mechanism::mechanism::{Demand, Level, Mechanism, Need};
use hodograph_mechanism::position::redundant::RedundancyVerdict;
use hodograph_mechanism::position::{self, Configuration};
use hodograph_mechanism::stated::{self, Moment};
use hodograph_scene::{Asked, DiagramKind, Find, LinkId, Scene};

/// The extent of the work beyond the scene's questions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Scope {
    /// Only the parts that the questions require.
    #[default]
    Questions,
    /// All positions too, because the whole mechanism is drawn.
    Figure,
}

/// All results for a scene at its instant.
#[derive(Clone, Debug)]
pub struct Worked {
    /// The topology.
    pub mechanism: Mechanism,
    /// The requirements of the questions.
    pub demand: Demand,
    /// The positions.
    pub configuration: Configuration,
    /// The equations.
    pub plan: Plan,
    /// The drawing board.
    pub construction: PlanDrawing,
    /// The number of evaluations of the construction: a trial for its scales, and the drawing; more
    /// in a pose that loses digits, or with special points.
    pub drawings: usize,
    /// Reactions by moments and force polygons, if forces are asked for and can be drawn.
    pub equilibrium: Option<Equilibrium>,
    /// The solution of the loop equations.
    pub solution: Solution,
    /// One result for each question that has an answer in the pose, in the order of the questions.
    pub results: Vec<Outcome>,
    /// The questions that have no answer in the pose.
    pub unanswered: Vec<Unanswered>,
    /// The requested instantaneous centres that are at infinity.
    pub at_infinity: Vec<InfiniteCentre>,
    /// Links and pairs that repeat others, checked in several positions; empty for [`work_placed`].
    pub redundant: Vec<position::redundant::Checked>,
    /// Crossings under less than 10°, with remedies.
    pub bad_angles: Vec<BadAngle>,
    /// The tolerances of hand drawing, if [`Worked::with_drafting`] was called.
    pub drafting: Option<Drafting>,
    /// The decisions about the pose.
    pub decisions: PoseDecisions,
}

impl Worked {
    /// Returns the scale of the mechanism or of its polygons (SI per mm); `None` for polygons that
    /// are not drawn.
    pub fn scale(&self, on: DiagramKind) -> Option<f64> {
        match on {
            DiagramKind::Force => self.equilibrium.as_ref().map(Equilibrium::mu),
            DiagramKind::Plane | DiagramKind::Velocity | DiagramKind::Acceleration => {
                self.construction.scale(on)
            }
        }
    }

    /// Fixes all scales on the paper of the scene that it leaves open.
    pub fn hold_scales(&self, scene: &mut Scene) {
        for on in DiagramKind::ALL {
            let held = scene.paper.scales.get(on.kind()).or_else(|| self.scale(on));
            scene.paper.scales.set(on.kind(), held);
        }
    }

    /// Draws to the scales of another paper. `scene` differs from the worked one by its paper only;
    /// the pose, the equations and the analysis are kept.
    ///
    /// # Errors
    /// The errors of the drawing.
    pub fn to_scales(&self, scene: &Scene) -> Result<Worked, Faults> {
        let posed = pose::to_scales(scene, self)?;
        let drawn = answered(scene, self.mechanism.clone(), self.demand.clone(), posed).value;
        let drawn = drawn.judged(scene, self.redundant.clone(), &self.bad_angles);
        Ok(if self.drafting.is_some() { drawn.with_drafting(scene) } else { drawn })
    }

    /// Adds the crossings under bad angles, with the poses of `known` ones, and what links that
    /// repeat others only approximately do to the agreement: they make two mechanisms of one,
    /// because drawing and loop equations use different pairs of it.
    fn judged(
        mut self,
        scene: &Scene,
        redundant: Vec<position::redundant::Checked>,
        known: &[BadAngle],
    ) -> Worked {
        self.bad_angles = bad_angles(&self.drawn(scene), construct::pencil_mm(&scene.paper), known);
        let nearly = redundant
            .iter()
            .filter(|r| r.verdict == RedundancyVerdict::Almost)
            .map(|r| r.off_m)
            .fold(0.0, f64::max);
        let blur = NEARLY * nearly / self.configuration.extent().max(f64::MIN_POSITIVE);
        if nearly > 0.0 {
            for a in self.results.iter_mut().filter_map(|r| r.agreement.as_mut()) {
                *a = a.no_better_than(blur);
            }
        }
        self.redundant = redundant;
        self
    }

    /// Returns everything that is needed to draw the construction again with another pencil.
    pub fn drawn<'a>(&'a self, scene: &'a Scene) -> DraftedConstruction<'a> {
        let mut values = vec![None; scene.find.len()];
        for r in &self.results {
            values[r.find] = r.drawn.as_ref().map(|_| r.value());
        }
        DraftedConstruction {
            scene,
            mechanism: &self.mechanism,
            configuration: &self.configuration,
            plan: &self.plan,
            construction: &self.construction,
            equilibrium: self.equilibrium.as_ref(),
            values,
        }
    }

    /// Adds the tolerances of hand drawing, for the scene's pencil or the usual one.
    pub fn with_drafting(mut self, scene: &Scene) -> Worked {
        self.drafting = Some(self.by_hand(scene));
        self
    }

    /// Returns the tolerances of hand drawing, for the scene's pencil or the usual one.
    pub fn by_hand(&self, scene: &Scene) -> Drafting {
        drafting(&self.drawn(scene), construct::pencil_mm(&scene.paper))
    }
}

/// The answers to one question.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Index into the scene's `find` list.
    pub find: usize,
    /// The value read off the paper; `None` if the group is not drawable.
    pub drawn: Option<FindAnswer>,
    /// The value from the loop equations (for positions from the configuration); see also
    /// [`Outcome::longer`].
    pub computed: AnswerValue,
    /// The difference of the two; `None` for positions and where nothing was drawn.
    pub agreement: Option<Agreement>,
    /// The reference size (SI) of the answer: the largest vector or rate of its kind, for positions
    /// the mechanism's size.
    pub scale: f64,
    /// The answer on the other motion through each change point of the pose (see
    /// [`hodograph_analytic::Singularity::other`]); empty for positions and in every other pose.
    pub others: Vec<AnswerValue>,
    /// The value (SI) up to which the answer cannot be distinguished from zero.
    pub noise: f64,
    /// The number of true digits of an answer from the next order of the loop equations, if the
    /// pose is singular.
    pub next_order: Option<usize>,
    /// The rung of the ladder that distinguishes the pose from a singular one, if `f64` cannot; the
    /// value then comes from that rung instead of the loop equations.
    pub longer: Option<Rung>,
}

impl Outcome {
    /// Returns the value to print: the drawing's, if there is one; zero if it is no more than
    /// rounding.
    pub fn value(&self) -> AnswerValue {
        self.drawn.as_ref().map_or(self.computed, |a| a.value).above(self.noise)
    }
}

/// The size, relative to the largest of its kind, below which a value of a solution without a
/// drawing cannot be distinguished from zero: rounding, and the distance of the pose from the
/// singular one for which it was solved.
fn blur_of(pose: &Solution) -> f64 {
    let off = pose.singular.iter().map(|s| s.off).fold(0.0, f64::max);
    crate::accuracy::ROUNDING + 16.0 * off
}

/// Works a scene through. A scene that may be at a junction of two pieces of a cam's profile must
/// pass [`instant`] first.
///
/// # Errors
/// The faults of the first stage that has any; `position-unproven` if the position found breaks a
/// statement of the scene. A pose in which some parts have no motion is no fault: their questions
/// are [`Worked::unanswered`].
pub fn work(scene: &Scene, scope: Scope) -> Result<Warned<Worked>, Faults> {
    joint::goes_on(scene)?;
    let Warned { value: mechanism, mut notes } = Mechanism::new(scene)?;
    notes.extend(hodograph_scene::quantity::notes(scene));
    let mut demand = Demand::of(scene, &mechanism);
    // Links that repeat others are checked by their pins, at all levels of motion that are asked
    // for.
    for (a, b) in (0..scene.links.len()).filter_map(|l| mechanism.held(LinkId(l))) {
        let deepest = demand.level;
        for level in Level::RATES.into_iter().filter(|level| *level <= deepest) {
            demand.add(scene, &mechanism, Need::Point(a, None), level);
            demand.add(scene, &mechanism, Need::Point(b, None), level);
        }
    }
    if scope == Scope::Figure {
        demand = demand.with_all_positions();
    }
    let redundant = position::redundant::check(scene, &mechanism)?;
    notes.extend(redundant.iter().map(|r| r.diagnostic(scene, &mechanism)));
    let placed = position::configure(scene, &mechanism, &demand)?;
    notes.extend(placed.notes);
    let configuration = settled(scene, &mechanism, &demand, placed.value);
    stated::proved(scene, &mechanism, &configuration, Moment::Instant)?;
    let Warned { value: worked, notes: more } =
        stages(scene, mechanism, demand, configuration, true)?;
    notes.extend(more);
    let worked = worked.judged(scene, redundant, &[]);
    let drawn = worked.drawn(scene);
    notes.extend(worked.bad_angles.iter().map(|b| b.diagnostic(&drawn)));
    Ok(Warned { value: worked, notes })
}

/// Works through the stages from positions on, for callers that followed the mechanism to a pose by
/// themselves. Crossings under bad angles are not searched for, and the loss of double precision
/// next to a singular pose is estimated, not measured.
///
/// # Errors
/// The faults of the first stage that has any.
pub fn work_placed(
    scene: &Scene,
    mechanism: Mechanism,
    demand: Demand,
    configuration: Configuration,
) -> Result<Warned<Worked>, Faults> {
    stages(scene, mechanism, demand, configuration, false)
}

/// The space (mm) for the largest force polygon.
const FORCES_MM: [f64; 2] = [110.0, 110.0];

/// The rounding of a reaction, relative to that of one polygon.
const POLYGONS: f64 = 10.0;

/// The factor of an acceleration's error on a length's: a length enters it by its square, and by
/// two links.
const NEARLY: f64 = 64.0;

/// The stages from positions on; `measured` is that of [`pose::pose`].
fn stages(
    scene: &Scene,
    mechanism: Mechanism,
    demand: Demand,
    configuration: Configuration,
    measured: bool,
) -> Result<Warned<Worked>, Faults> {
    let given = PoseInput { scene, mechanism: &mechanism, demand: &demand };
    let posed = pose::pose(given, configuration, measured)?;
    Ok(answered(scene, mechanism, demand, posed))
}

/// The answers in a decided pose.
fn answered(
    scene: &Scene,
    mechanism: Mechanism,
    demand: Demand,
    posed: DecidedPose,
) -> Warned<Worked> {
    let DecidedPose { configuration, solution, decisions, drawing, drawings, mut notes } = posed;
    let PoseDecisions { singular, written, near } = &decisions;
    let magnified = |level| drawing.magnified(level);
    let (plan, construction) = (&drawing.plan, &drawing.construction);
    notes.extend(solution.notes.iter().cloned());
    notes.extend(higher::notes(scene, &mechanism, plan));
    let equilibrium = demand.wants_forces().then(|| {
        let motion = construct::source(scene, &mechanism, plan, construction);
        Equilibrium::of(
            scene,
            &mechanism,
            &configuration,
            &motion,
            construction.diagram.mu,
            FORCES_MM,
        )
    });
    let equilibrium = equilibrium.flatten();
    if demand.wants_forces() {
        notes.extend(remarks::of_loads(scene, &configuration, &solution));
    }
    let blur = blur_of(&solution);
    let sizes = PoseSizes::of(scene, construction, &configuration);
    let (mut results, mut unanswered, mut at_infinity) = (Vec::new(), Vec::new(), Vec::new());
    // The loop equations hold a driven pin by the links that it carries; if those have no motion,
    // its own group still has one.
    let beside = |find: &Find| {
        let asked = Demand::of_questions(scene, &mechanism, [find]);
        if solution.refused.is_empty() || singular.iter().any(|g| asked.groups[*g].is_some()) {
            return None;
        }
        regular(scene, &mechanism, &asked, &configuration, std::slice::from_ref(find))?.values[0]
    };
    let of_forces = |i: usize, find: &Find| {
        let drawn = equilibrium.as_ref().filter(|_| matches!(find.what, Asked::Force(_)))?;
        let value = evaluate(scene, &configuration, drawn, &find.what)?;
        value.numbers().0.is_finite().then_some(FindAnswer { find: i, value, measured: None })
    };
    for (i, (find, drawn)) in scene.find.iter().zip(drawing.answers.iter().cloned()).enumerate() {
        let drawn = drawn.or_else(|| of_forces(i, find));
        // The loop equations check drawn answers, near a singular pose as elsewhere.
        let computed = match written.as_ref().filter(|_| drawn.is_none()) {
            Some(written) => written.values[i],
            None => solution.answer(scene, &configuration, &find.what).or_else(|| beside(find)),
        };
        let Some(computed) = computed.filter(|c| !far::is_nowhere(&find.what, c, sizes.extent))
        else {
            let asked = Demand::of_questions(scene, &mechanism, [find]);
            let rests_on = |r: &&RefusedPart| {
                groups_of(scene, &mechanism, (&r.links, &r.pins))
                    .iter()
                    .any(|g| asked.groups[*g].is_some())
            };
            if let Some(refused) = solution.refused.iter().find(rests_on) {
                unanswered.push(Unanswered {
                    find: i,
                    why: NoAnswer::NoMotion(Box::new(refused.clone())),
                });
                continue;
            }
            if let Some(centre) = far::far(scene, &solution, &configuration, i) {
                at_infinity.push(centre);
                continue;
            }
            let undefined = || {
                NoAnswer::NoValue(
                    remarks::unbalanced(scene, &mechanism, &configuration, &demand, find)
                        .unwrap_or_else(|| find.what.no_value(scene)),
                )
            };
            unanswered.push(Unanswered {
                find: i,
                why: find.what.infinite(scene).map_or_else(undefined, NoAnswer::Infinite),
            });
            continue;
        };
        let level = find.what.level();
        let size = solution.forces().and_then(|f| f.size(find.what.kind()));
        let scale = match (size, level) {
            (Some(size), _) => size,
            (None, Level::Position) => sizes.extent,
            (None, Level::Velocity | Level::Acceleration) => sizes.against(level, &computed),
        };
        let agreement = match (&drawn, level) {
            (Some(d), _) if matches!(find.what, Asked::Force(_)) => {
                let crossings = equilibrium.as_ref().map_or(1.0, Equilibrium::magnified);
                // A reaction is the result of several polygons, each of which depends on those
                // before.
                Some(compare(
                    d.value,
                    computed,
                    POLYGONS * scale,
                    magnified(demand.level).max(crossings),
                ))
            }
            (_, Level::Position) | (None, _) => None,
            (Some(d), _) => {
                let agreement = compare(d.value, computed, scale, magnified(level));
                Some(match near {
                    Some(near) => near.promised(i, agreement),
                    // Solved as the singular pose next to it, the pose is known to the root of its
                    // rounding.
                    None if !(solution.singular.is_empty() && solution.refused.is_empty()) => {
                        agreement.no_better_than(f64::EPSILON.sqrt())
                    }
                    None => agreement.no_better_than(solution.near.first().map_or(0.0, |n| n.loss)),
                })
            }
        };
        let noise_of = |of: &Solution, value: &AnswerValue| match value {
            AnswerValue::Point(_) => blur * sizes.extent,
            AnswerValue::Vector(_) | AnswerValue::Scalar(_) => {
                blur * of.largest(level, matches!(value, AnswerValue::Scalar(_)))
            }
        };
        let noise = match (level, agreement) {
            _ if size.is_some() => blur * scale,
            (Level::Position, _) => 0.0,
            (_, None) if written.is_some() => 0.0,
            (_, Some(a)) => a.noise,
            (_, None) => noise_of(&solution, &computed),
        };
        let mut others = Vec::new();
        for other in solution
            .singular
            .iter()
            .filter_map(|s| s.other.as_deref())
            .filter(|_| level > Level::Position)
        {
            let value = other.answer(scene, &configuration, &find.what);
            others.extend(value.map(|v| v.above(noise_of(other, &v))));
        }
        let longer =
            written.as_ref().filter(|_| drawn.is_none() && level > Level::Position).map(|r| r.rung);
        let by_next_order =
            !solution.singular.is_empty() && drawn.is_none() && level > Level::Position;
        let next_order = by_next_order.then(|| (-libm::log10(blur)).floor().max(1.0) as usize);
        results.push(Outcome {
            find: i,
            drawn,
            computed,
            agreement,
            scale,
            others,
            noise,
            next_order,
            longer,
        });
    }

    let worked = Worked {
        mechanism,
        demand,
        configuration,
        plan: drawing.plan,
        construction: drawing.construction,
        drawings,
        equilibrium,
        solution,
        results,
        unanswered,
        at_infinity,
        redundant: Vec::new(),
        bad_angles: Vec::new(),
        drafting: None,
        decisions,
    };
    Warned { value: worked, notes }
}
