//! The pose of a scene with all open choices decided: the fineness of the positions, the groups
//! that are not drawn, and the answers of longer numbers instead. No later stage changes them.
//!
//! A trial decides: loop equations and drawing with the given positions. If the two lose digits
//! next to a singular pose, the trial is repeated with positions to the last digit; groups that
//! still lose their digits are left out of the drawing.

use super::Worked;
use super::higher;
use super::sizes::PoseSizes;
use crate::accuracy::{
    self, Agreement, BAD_DEG, KeptDigits, Regular, compare, estimated, groups_of_question, kept,
    regular, settled_finely,
};
use hodograph_analytic::{self as analytic, Solution};
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_board::construct::scale::Boxes;
use hodograph_board::construct::{self, FindAnswer, PlanDrawing};
use hodograph_board::plan::{self, GroupChoices, Plan};
use hodograph_mechanism::answer::AnswerValue;
use hodograph_mechanism::mechanism::{Demand, Level, Mechanism};
use hodograph_mechanism::position::Configuration;
use hodograph_scene::{DiagramKind, LinkId, PointId, Scene};

/// The input of the stages from positions on.
#[derive(Clone, Copy)]
pub(super) struct PoseInput<'a> {
    pub scene: &'a Scene,
    pub mechanism: &'a Mechanism,
    pub demand: &'a Demand,
}

/// A drawing with its plan, and the answers read off it.
pub(super) struct DrawnAnswers {
    pub plan: Plan,
    pub construction: PlanDrawing,
    /// The answers, one for each question; `None` for questions that are not drawn.
    pub answers: Vec<Option<FindAnswer>>,
}

/// The number of evaluations of a construction: a trial for its scales, and the drawing.
const TRIAL_AND_DRAWING: usize = 2;

/// The decisions about a pose next to a singular one; they hold at all scales.
#[derive(Clone, Debug, Default)]
pub struct PoseDecisions {
    /// The groups that are not drawn because they are singular, or lose their digits.
    pub(super) singular: Vec<usize>,
    /// The answers of longer numbers, if the pose is nearly singular.
    pub(super) written: Option<Regular>,
    /// The digits that drawing and loop equations keep, if they were measured.
    pub(super) near: Option<KeptDigits>,
}

/// A pose with everything decided.
pub(super) struct DecidedPose {
    /// The positions, as fine as necessary.
    pub configuration: Configuration,
    /// The solution of the loop equations.
    pub solution: Solution,
    /// The decisions.
    pub decisions: PoseDecisions,
    /// The drawing without the groups that are not drawn.
    pub drawing: DrawnAnswers,
    /// The number of evaluations of constructions: two, but more for poses that lose digits, or
    /// with special points.
    pub drawings: usize,
    /// Remarks on the pose.
    pub notes: Vec<Diagnostic>,
}

/// Decides a pose. With `measured` the digits kept next to a singular pose are measured, not
/// estimated.
///
/// # Errors
/// The errors of the loop equations and of the drawing.
pub(super) fn pose(
    given: PoseInput,
    configuration: Configuration,
    measured: bool,
) -> Result<DecidedPose, Faults> {
    let mut posed = trial(given, configuration)?;
    let mut lost = if measured { posed.judge(given) } else { Vec::new() };
    if !lost.is_empty() {
        let finer =
            settled_finely(given.scene, given.mechanism, given.demand, posed.configuration.clone());
        if finer != posed.configuration {
            let before = posed.drawings;
            posed = trial(given, finer)?;
            posed.drawings += before;
            lost = posed.judge(given);
        }
    }
    if !lost.is_empty() {
        posed.leave_out(given, &lost)?;
    }
    if let (Some(worst), None) = (posed.solution.near.first(), &posed.decisions.written) {
        let told = estimated(worst, posed.solution.condition);
        let condition = posed.solution.condition;
        let note = told.map(|told| {
            posed.decisions.near.as_ref().map_or(told, |near| near.note(worst, condition))
        });
        posed.notes.extend(note);
    }
    Ok(posed)
}

/// Returns the pose of a finished work drawn to the scales of another paper. Nothing is decided
/// again.
///
/// # Errors
/// The errors of the drawing.
pub(super) fn to_scales(scene: &Scene, worked: &Worked) -> Result<DecidedPose, Faults> {
    let Worked { mechanism, demand, configuration, plan, solution, decisions, .. } = worked;
    let boxes = Boxes::of(&scene.paper, plan);
    let construction = construct::construct(scene, mechanism, configuration, plan, &boxes)?;
    let answers = construct::read(scene, mechanism, configuration, plan, &construction);
    let mut posed = DecidedPose {
        configuration: configuration.clone(),
        solution: solution.clone(),
        decisions: decisions.clone(),
        drawing: DrawnAnswers { plan: plan.clone(), construction, answers },
        drawings: worked.drawings,
        notes: Vec::new(),
    };
    if posed.decisions.near.is_some() {
        posed.measure(PoseInput { scene, mechanism, demand });
    }
    Ok(posed)
}

/// Loop equations and drawing with the given positions.
fn trial(given: PoseInput, configuration: Configuration) -> Result<DecidedPose, Faults> {
    let PoseInput { scene, mechanism, demand } = given;
    let mut solution = analytic::solve(scene, mechanism, &configuration, demand)?;
    let singular = singular_groups(scene, mechanism, &solution);
    let written = if singular.is_empty() {
        None
    } else {
        regular(scene, mechanism, demand, &configuration, &scene.find)
    };
    if let Some(written) = &written {
        solution.taken_for_singular(|words| near_singular(words, written));
    }
    let mut drawings = 0;
    let drawing = draw(given, &configuration, &singular, &mut drawings)?;
    Ok(DecidedPose {
        configuration,
        solution,
        decisions: PoseDecisions { singular, written, near: None },
        drawing,
        drawings,
        notes: Vec::new(),
    })
}

/// The drawing without some groups; adds the number of evaluations to `drawings`.
///
/// A group of higher class is drawn by the first way in which no lines cross under a bad angle,
/// else by the way with the best angles. If none can be drawn, it is left to the loop equations.
fn draw(
    given: PoseInput,
    configuration: &Configuration,
    without: &[usize],
    drawings: &mut usize,
) -> Result<DrawnAnswers, Faults> {
    let PoseInput { scene, mechanism, demand } = given;
    let mut constructed = |ways: &GroupChoices| {
        *drawings += TRIAL_AND_DRAWING;
        let plan = plan::plan_with(scene, mechanism, demand, ways);
        let drawing = construct::construct(
            scene,
            mechanism,
            configuration,
            &plan,
            &Boxes::of(&scene.paper, &plan),
        );
        (plan, drawing)
    };
    let mut ways = GroupChoices { left_out: without.to_vec(), ..GroupChoices::default() };
    let (mut plan, mut drawing) = constructed(&ways);
    for g in higher::drawn(mechanism, &plan) {
        let mut best = higher::worst_sine(g, &plan, &drawing);
        let mut other = ways.clone();
        while best < libm::sin(BAD_DEG.to_radians()) {
            *other.way.entry(g).or_insert(0) += 1;
            let next = constructed(&other);
            if next.0.undrawable.contains(&g) {
                break;
            }
            let sine = higher::worst_sine(g, &next.0, &next.1);
            if sine > best {
                (best, ways, (plan, drawing)) = (sine, other.clone(), next);
            }
        }
    }
    let construction = match drawing {
        Ok(construction) => construction,
        Err(faults) => {
            let higher = higher::drawn(mechanism, &plan);
            if higher.is_empty() {
                return Err(faults);
            }
            let drawing;
            (plan, drawing) = constructed(&GroupChoices {
                left_out: [without, &higher].concat(),
                ..GroupChoices::default()
            });
            drawing?
        }
    };
    let answers = construct::read(scene, mechanism, configuration, &plan, &construction);
    Ok(DrawnAnswers { plan, construction, answers })
}

impl DrawnAnswers {
    /// The values read off the drawing.
    fn values(&self) -> Vec<Option<AnswerValue>> {
        self.answers.iter().map(|a| a.as_ref().map(|a| a.value)).collect()
    }

    /// Returns the factor by which rounding is magnified at the worst crossing of a level.
    pub fn magnified(&self, level: Level) -> f64 {
        self.construction.magnified(DiagramKind::of(level))
    }
}

impl DecidedPose {
    /// Measures the digits that both ways keep next to a singular pose. Returns the groups whose
    /// digits are lost.
    fn judge(&mut self, given: PoseInput) -> Vec<usize> {
        if self.decisions.written.is_none() && self.solution.near.is_empty() {
            return Vec::new();
        }
        self.measure(given);
        let Some(near) = &self.decisions.near else { return Vec::new() };
        let PoseInput { scene, mechanism, .. } = given;
        let sizes = PoseSizes::of(scene, &self.drawing.construction, &self.configuration);
        let read = self.drawing.values();
        let agreed = |i: usize| -> Option<Agreement> {
            let (level, read) = (scene.find[i].what.level(), read[i]?);
            let computed = self.solution.answer(scene, &self.configuration, &scene.find[i].what)?;
            (level > Level::Position).then(|| {
                compare(
                    read,
                    computed,
                    sizes.against(level, &computed),
                    self.drawing.magnified(level),
                )
            })
        };
        // Questions that longer numbers already answer are not lost.
        let open = |i: &usize| read[*i].is_some() || self.decisions.written.is_none();
        let lost: Vec<usize> =
            (0..scene.find.len()).filter(open).filter(|i| near.lost(*i, agreed(*i))).collect();
        lost_groups(scene, mechanism, &self.solution, &lost)
    }

    fn measure(&mut self, given: PoseInput) {
        let PoseInput { scene, mechanism, demand } = given;
        let sizes = PoseSizes::of(scene, &self.drawing.construction, &self.configuration);
        let scale = |level, value: &AnswerValue| sizes.against(level, value);
        let ways = accuracy::ComparedMethods {
            solution: &self.solution,
            drawn: &self.drawing.values(),
            scale,
        };
        let PoseDecisions { written, near, .. } = &self.decisions;
        let truth = written.clone().or_else(|| near.as_ref().map(|near| near.truth.clone()));
        self.decisions.near = kept(scene, (mechanism, demand), &self.configuration, &ways, truth);
    }

    /// Leaves groups out of the drawing, with the answers of longer numbers; the other groups are
    /// judged by the remaining drawing.
    fn leave_out(&mut self, given: PoseInput, lost: &[usize]) -> Result<(), Faults> {
        if let Some(near) = &self.decisions.near {
            let words = self.solution.near.first().map_or_else(
                || both!("the links lie nearly as in a singular pose"),
                |worst| worst.words.clone(),
            );
            self.notes.extend(
                self.decisions.written.is_none().then(|| near_singular(&words, &near.truth)),
            );
            self.decisions.singular.extend(lost);
            self.decisions.written = Some(near.truth.clone());
            self.drawing =
                draw(given, &self.configuration, &self.decisions.singular, &mut self.drawings)?;
        }
        self.measure(given);
        Ok(())
    }
}

/// The nearly singular groups of answers that double precision has lost; for an answer without such
/// a group, all groups that it depends on.
fn lost_groups(scene: &Scene, m: &Mechanism, solution: &Solution, lost: &[usize]) -> Vec<usize> {
    let near: Vec<usize> =
        solution.near.iter().flat_map(|n| groups_of(scene, m, (&n.links, &n.pins))).collect();
    let mut groups: Vec<usize> = Vec::new();
    for i in lost {
        let all = groups_of_question(scene, m, &scene.find[*i]);
        let some: Vec<usize> = all.iter().copied().filter(|g| near.contains(g)).collect();
        groups.extend(if some.is_empty() { all } else { some });
    }
    groups.sort_unstable();
    groups.dedup();
    groups
}

/// The warning about a pose that only longer numbers distinguish from a singular one.
fn near_singular(words: &Both, regular: &Regular) -> Diagnostic {
    let numbers = regular.rung.name();
    Diagnostic::warning(
        "near-singular",
        both!(
            "{} but for a hair: as written the pose is not singular, but only numbers of more digits than double precision tell its answers ({numbers}); they are theirs, neither drawn nor checked by the loop equations",
            words
        ),
    )
    .help(both!("choose a pose further off, or one that is singular as written"))
}

/// The groups that are singular in the pose: their lines coincide, so that no crossing on paper has
/// a meaning.
fn singular_groups(scene: &Scene, m: &Mechanism, solution: &Solution) -> Vec<usize> {
    let answered = solution.singular.iter().flat_map(|s| groups_of(scene, m, (&s.links, &s.pins)));
    let refused = solution.refused.iter().flat_map(|r| groups_of(scene, m, (&r.links, &r.pins)));
    let mut groups: Vec<usize> = answered.chain(refused).collect();
    groups.sort_unstable();
    groups.dedup();
    groups
}

/// The groups of links and pins; a link that follows others has no group of its own and counts as
/// its pins.
pub(super) fn groups_of(
    scene: &Scene,
    m: &Mechanism,
    (links, pins): (&[LinkId], &[PointId]),
) -> Vec<usize> {
    let of_pins =
        |pins: &[PointId]| pins.iter().filter_map(|p| m.group_of_pin[p.0]).collect::<Vec<usize>>();
    let of_link = |l: &LinkId| {
        m.group_of_link[l.0].map_or_else(|| of_pins(&scene.links[l.0].points), |g| vec![g])
    };
    let mut groups: Vec<usize> = links.iter().flat_map(of_link).chain(of_pins(pins)).collect();
    groups.sort_unstable();
    groups.dedup();
    groups
}
