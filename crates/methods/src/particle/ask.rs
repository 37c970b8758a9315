//! The questions about a motion without a mechanism, and their notation.

use super::plate::PlateComponent;
use super::{ParticleMotionKind, ParticleProblem};
use hodograph_base::diag::{Diagnostic, Span, both};
use hodograph_base::json::fields::suggest;

/// A question.
#[derive(Clone, Debug, PartialEq)]
pub struct ParticleQuestion {
    /// The question as written.
    pub text: String,
    /// Its meaning.
    pub what: ParticleQuantity,
}

/// The quantity asked for; points are given by the index of their motion in the list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParticleQuantity {
    /// `T_AB`: the time at which pursuer and target meet.
    MeetingTime(usize),
    /// `P_AB`: the place at which they meet.
    MeetingPlace(usize),
    /// `l_AB`: their distance at the instant.
    Distance(usize),
    /// `omega_AB`: the angular velocity of the line from pursuer to target.
    LineOmega(usize),
    /// `r_A`: the place.
    Place(usize),
    /// `v_A`: the velocity.
    Velocity(usize),
    /// `a_A`: the acceleration.
    Acceleration(usize),
    /// `rho_A`: the radius of curvature of the path.
    Curvature(usize),
    /// `ve_M` and the other parts of the motion of a point on a plate.
    Part(usize, PlateComponent),
    /// `l_AB` and the other quantities of two points of which neither pursues the other.
    Between([usize; 2], Mutual),
}

/// A quantity of two points of the plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mutual {
    /// `l_AB`: their distance.
    Distance,
    /// `omega_AB`: the angular velocity of their line.
    Turning,
    /// `vr_A/B`: the velocity of A relative to axes that translate with B.
    Velocity,
    /// `ar_A/B`: the acceleration of A relative to the same axes.
    Acceleration,
}

impl Mutual {
    const ALL: [Mutual; 4] =
        [Mutual::Distance, Mutual::Turning, Mutual::Velocity, Mutual::Acceleration];

    fn text(self, [a, b]: [&str; 2]) -> String {
        match self {
            Mutual::Distance => format!("l_{a}{b}"),
            Mutual::Turning => format!("omega_{a}{b}"),
            Mutual::Velocity => format!("vr_{a}/{b}"),
            Mutual::Acceleration => format!("ar_{a}/{b}"),
        }
    }
}

impl ParticleQuantity {
    /// Returns the indices of the motions that the quantity depends on.
    pub(super) fn motions(self) -> Vec<usize> {
        match self {
            ParticleQuantity::MeetingTime(k)
            | ParticleQuantity::MeetingPlace(k)
            | ParticleQuantity::Distance(k)
            | ParticleQuantity::LineOmega(k)
            | ParticleQuantity::Place(k)
            | ParticleQuantity::Velocity(k)
            | ParticleQuantity::Acceleration(k)
            | ParticleQuantity::Curvature(k)
            | ParticleQuantity::Part(k, _) => vec![k],
            ParticleQuantity::Between(two, _) => two.to_vec(),
        }
    }

    /// True for a place, which is given by its coordinates alone.
    pub fn is_place(self) -> bool {
        match self {
            ParticleQuantity::MeetingPlace(_) | ParticleQuantity::Place(_) => true,
            ParticleQuantity::MeetingTime(_)
            | ParticleQuantity::Distance(_)
            | ParticleQuantity::LineOmega(_)
            | ParticleQuantity::Velocity(_)
            | ParticleQuantity::Acceleration(_)
            | ParticleQuantity::Curvature(_)
            | ParticleQuantity::Part(..)
            | ParticleQuantity::Between(..) => false,
        }
    }
}

/// Returns the questions that are answered if the file asks none, the most informative first: all
/// except those about points at rest only.
pub fn all(problem: &ParticleProblem) -> Vec<ParticleQuestion> {
    let moves = |k: usize| match &problem.motions[k].kind {
        ParticleMotionKind::Fixed(way) => !way.is_at_rest(),
        ParticleMotionKind::OnPlate(..) | ParticleMotionKind::Toward { .. } => true,
    };
    possible(problem).into_iter().filter(|f| f.what.motions().into_iter().any(moves)).collect()
}

fn possible(problem: &ParticleProblem) -> Vec<ParticleQuestion> {
    let mut out: Vec<ParticleQuestion> = Vec::new();
    let mut add = |text: String, what: ParticleQuantity| out.push(ParticleQuestion { text, what });
    for (k, m) in problem.motions.iter().enumerate() {
        let name = &m.point;
        if let Some((_, target)) = problem.chase(m) {
            let pair = format!("{name}{target}");
            add(format!("T_{pair}"), ParticleQuantity::MeetingTime(k));
            add(format!("P_{pair}"), ParticleQuantity::MeetingPlace(k));
            add(format!("l_{pair}"), ParticleQuantity::Distance(k));
            add(format!("omega_{pair}"), ParticleQuantity::LineOmega(k));
        }
        add(format!("r_{name}"), ParticleQuantity::Place(k));
        add(format!("v_{name}"), ParticleQuantity::Velocity(k));
        add(format!("a_{name}"), ParticleQuantity::Acceleration(k));
        if let ParticleMotionKind::OnPlate(..) = m.kind {
            for (word, part) in PlateComponent::ALL {
                add(format!("{word}_{name}"), ParticleQuantity::Part(k, part));
            }
        }
        add(format!("rho_{name}"), ParticleQuantity::Curvature(k));
    }
    let by_law = |k: usize| matches!(problem.motions[k].kind, ParticleMotionKind::Fixed(_));
    out.extend(
        between(problem)
            .into_iter()
            .filter(|([a, b], _)| a < b && by_law(*a) && by_law(*b))
            .map(|(_, find)| find),
    );
    out
}

/// Returns all questions about two points, each with the two indices; points on plates are left
/// out.
fn between(problem: &ParticleProblem) -> Vec<([usize; 2], ParticleQuestion)> {
    let plane = |k: &usize| !matches!(problem.motions[*k].kind, ParticleMotionKind::OnPlate(..));
    let all: Vec<usize> = (0..problem.motions.len()).filter(plane).collect();
    let name = |k: usize| problem.motions[k].point.as_str();
    let pairs = all.iter().flat_map(|a| all.iter().map(|b| [*a, *b])).filter(|[a, b]| a != b);
    pairs
        .flat_map(|two| {
            Mutual::ALL.map(|m| {
                (
                    two,
                    ParticleQuestion {
                        text: m.text(two.map(name)),
                        what: ParticleQuantity::Between(two, m),
                    },
                )
            })
        })
        .collect()
}

/// Returns the meaning of a question; a part may be followed by a slash and the number of the plate
/// (`ak_M/2`).
pub fn meaning(
    problem: &ParticleProblem,
    text: &str,
    span: Span,
) -> Result<ParticleQuestion, Diagnostic> {
    let mut known = possible(problem);
    let more = between(problem)
        .into_iter()
        .map(|(_, find)| find)
        .filter(|f| known.iter().all(|k| k.text != f.text))
        .collect::<Vec<_>>();
    known.extend(more);
    let plain = |f: &&ParticleQuestion| {
        f.text == text
            || f.text.strip_prefix("T_").is_some_and(|pair| text == "T" && !pair.is_empty())
    };
    let framed = |f: &&ParticleQuestion| {
        let ParticleQuantity::Part(k, _) = f.what else { return false };
        match &problem.motions[k].kind {
            ParticleMotionKind::OnPlate(plate, _) => {
                text == format!("{}/{}", f.text, problem.plates[*plate].link)
            }
            ParticleMotionKind::Fixed(_) | ParticleMotionKind::Toward { .. } => false,
        }
    };
    if let Some(found) = known.iter().find(plain).or_else(|| known.iter().find(framed)) {
        return Ok(ParticleQuestion { text: text.to_owned(), what: found.what });
    }
    let d = Diagnostic::error("unknown-question", both!("`{text}` is no quantity of this file"))
        .at(span);
    Err(d.help(suggest(text, known.iter().map(|f| f.text.as_str()), both!("there are"))))
}
