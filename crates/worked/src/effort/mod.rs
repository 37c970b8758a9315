//! The work done for a scene's questions, counted in the results of the stages that did it.
//!
//! Nothing here is a prediction: an equation counts as closed when its crossing is on the paper, a
//! group as solved when the loop equations hold its motion. The counters therefore show whether the
//! work matches the questions, and a stage that does more shows in them.

pub mod truth;
pub mod ways;

use crate::certified::ladder::Certified;
use crate::worked::Worked;
use hodograph_board::construct::{Action, Polygon, PolygonMark};
use hodograph_board::plan::PlanStep;
use hodograph_mechanism::mechanism::Level;
use hodograph_scene::DiagramKind;

/// The work done at one level of motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MotionWork {
    /// The number of groups (driven links among them) with a motion from the loop equations.
    pub groups: usize,
    /// The number of vector equations written, in the alternative that was drawn.
    pub equations_planned: usize,
    /// The number of vector equations closed on paper.
    pub equations_closed: usize,
    /// The number of points found on paper by their image, or as points of a link that does not
    /// turn.
    pub images: usize,
    /// The number of vectors drawn: laid off, or closed by a crossing.
    pub vectors: usize,
    /// The number of angular rates found on paper.
    pub rates: usize,
    /// The number of unknowns of the loop equations.
    pub unknowns: usize,
}

/// The work done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// The number of groups (driven links among them) with a position.
    pub groups_placed: usize,
    /// The work for velocities.
    pub velocity: MotionWork,
    /// The work for accelerations.
    pub acceleration: MotionWork,
    /// The number of evaluations of the construction: a trial and the drawing.
    pub drawings: usize,
    /// The number of questions answered.
    pub answers: usize,
    /// The number of certified numbers that the answers print: magnitude and direction of a vector,
    /// or the one number; 0 if nothing was certified.
    pub certified_values: usize,
    /// The number of labels for which a place was searched; 0 if no figure was laid out.
    pub labels_placed: usize,
}

impl Work {
    /// Counts the work up to the answers.
    pub fn of(worked: &Worked) -> Work {
        let groups = || worked.mechanism.groups.iter().filter(|g| !g.is_carried());
        let at = &worked.configuration;
        Work {
            groups_placed: groups()
                .filter(|g| {
                    g.links.iter().all(|l| at.poses[l.0].is_some())
                        && g.pins.iter().all(|p| at.points[p.0].is_some())
                })
                .count(),
            velocity: motion(worked, Level::Velocity),
            acceleration: motion(worked, Level::Acceleration),
            drawings: worked.drawings,
            answers: worked.results.len(),
            certified_values: 0,
            labels_placed: 0,
        }
    }

    /// Returns the number of levels reached: none, positions, velocities, accelerations.
    pub fn levels(&self) -> usize {
        [self.groups_placed, self.velocity.unknowns, self.acceleration.unknowns]
            .iter()
            .filter(|n| **n > 0)
            .count()
    }

    /// Adds the number of certified numbers.
    pub fn with_certified(self, certified: &[Certified]) -> Work {
        Work { certified_values: certified.iter().map(printed).sum(), ..self }
    }

    /// Adds the number of labels of a figure that was laid out (`Figure::labels_placed`).
    pub fn with_labels(self, labels_placed: usize) -> Work {
        Work { labels_placed, ..self }
    }
}

/// The number of certified numbers of an answer that are printed.
fn printed(c: &Certified) -> usize {
    c.parts.iter().filter(|(part, number)| c.prints(*part) && number.text(1).is_some()).count()
}

fn motion(worked: &Worked, level: Level) -> MotionWork {
    let on = DiagramKind::of(level);
    let solution = &worked.solution;
    let paper = &worked.construction;
    let groups = worked.mechanism.groups.iter().filter(|g| !g.is_carried());
    let solved = groups.filter(|g| match g.links[..] {
        // A driven slider without a link of its own.
        [] => g.pins.iter().all(|p| solution.reaches_pin(level, *p)),
        _ => g.links.iter().all(|l| solution.reaches(level, *l)),
    });
    let written =
        worked.plan.steps(on).iter().flat_map(|g| g.steps(g.drawn(paper.acts.chosen[g.group])));
    let mut done = MotionWork {
        groups: solved.count(),
        equations_planned: written.filter(|s| matches!(s, PlanStep::Equation { .. })).count(),
        unknowns: solution.size[usize::from(level == Level::Acceleration)],
        ..MotionWork::default()
    };
    if let Some(p) = paper.polygon(on) {
        done.vectors = p.edges.len();
        for action in &p.actions {
            match action {
                Action::Copy { .. } | Action::Same { .. } => done.images += 1,
                Action::Rate(_) => done.rates += 1,
                Action::LayOff(_)
                | Action::Nothing { .. }
                | Action::Line { .. }
                | Action::Cross { .. }
                | Action::Trials { .. }
                | Action::Reach(_)
                | Action::Join(_)
                | Action::Perpendicular { .. } => {
                    done.equations_closed += usize::from(closes(p, action))
                }
            }
        }
    }
    done
}

/// True if an action ends an equation: two lines crossed, a whole vector laid off, or nothing added
/// at all.
fn closes(p: &Polygon, action: &Action) -> bool {
    match action {
        Action::Cross { .. } | Action::Trials { .. } | Action::Reach(_) => true,
        Action::LayOff(edge) => matches!(p.edges[*edge].to.0, PolygonMark::Image(_)),
        Action::Nothing { target, .. } => target.is_some(),
        Action::Line { .. }
        | Action::Copy { .. }
        | Action::Same { .. }
        | Action::Join(_)
        | Action::Perpendicular { .. }
        | Action::Rate(_) => false,
    }
}
