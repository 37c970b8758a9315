//! The projections that solve an equation of composite motion: each uses a line square to the other
//! unknown, which thus drops out.
//!
//! The line follows from the quantities known beforehand ([`ChoiceUnknowns`]), from topology alone.

use super::ChoiceSolution;
use super::solved::{ChoiceUnknowns, KnownMotion};
use hodograph_base::geom::Vec2;
use hodograph_scene::DiagramKind;
use hodograph_scene::quantity::RelativePath;
use hodograph_scene::quantity::composite::CompositePart;

/// A component on the line below this fraction of the largest vector counts as zero.
pub(super) const SQUARE: f64 = 1e-9;

/// The line of a projection.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum On {
    /// Square to the relative path, to find the wanted motion.
    Across,
    /// Along the relative path, to find the relative motion.
    Along,
    /// The x axis.
    X,
    /// The y axis.
    Y,
}

/// A vector of a projected equation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProjectionTerm {
    /// The motion of the point.
    Absolute,
    /// The normal part of this motion, toward the centre of the point's fixed circle.
    AbsoluteNormal,
    /// The tangential part, along that circle.
    AbsoluteTangential,
    /// The component of the motion along the projection line.
    Component,
    /// A part of the motion.
    Part(CompositePart),
}

/// An equation projected on a line.
#[derive(Clone, Debug, PartialEq)]
pub struct Projection {
    /// The kind of equation: velocities or accelerations.
    pub of: DiagramKind,
    /// The kind of line.
    pub on: On,
    /// The direction of the line (unit vector).
    pub line: Vec2,
    /// True if the point is at rest in the frame at the instant.
    pub rests: bool,
    /// The vectors with a component on the line, each with its angle from the line (rad, from 0 to
    /// π); the vectors of the point come first.
    pub terms: Vec<(ProjectionTerm, f64)>,
}

/// Returns the projections of a choice; empty if the equation has more than two unknowns, or if the
/// point is permanently at rest in the frame.
pub fn projections(s: &ChoiceSolution) -> Vec<Projection> {
    let lines = lines(s);
    let levels =
        [(DiagramKind::Velocity, velocities(s)), (DiagramKind::Acceleration, accelerations(s))];
    let all = levels.iter().flat_map(|(of, vectors)| {
        lines.iter().filter_map(|(on, line)| projected(s, *of, (*on, *line), vectors))
    });
    all.collect()
}

/// Returns the lines that the choice requires.
fn lines(s: &ChoiceSolution) -> Vec<(On, Vec2)> {
    let [absolute, ..] = s.velocity;
    match (s.closure, along(s)) {
        (ChoiceUnknowns::Side, _)
            if matches!(s.choice.path, RelativePath::Unknown) && s.slip.is_none() =>
        {
            Vec::new()
        }
        (ChoiceUnknowns::Side, _) => {
            vec![(On::X, Vec2::new(1.0, 0.0)), (On::Y, Vec2::new(0.0, 1.0))]
        }
        (ChoiceUnknowns::Crossing, Some(along)) if s.known == KnownMotion::Both => {
            vec![(On::Along, along)]
        }
        (ChoiceUnknowns::Crossing, Some(along)) => {
            // The sense in which the velocity of the point is positive.
            let line = along.perp();
            vec![(
                On::Across,
                if absolute.dot(line) < -SQUARE * absolute.norm() { -line } else { line },
            )]
        }
        (ChoiceUnknowns::Crossing, None) | (ChoiceUnknowns::Open, _) => Vec::new(),
    }
}

/// Returns the direction of the relative path; `None` if it is not known.
pub(super) fn along(s: &ChoiceSolution) -> Option<Vec2> {
    match s.slip {
        Some(slip) => Some(slip.normal.perp()),
        // For a point at rest on a straight path, the acceleration gives the direction.
        None => s.velocity[2]
            .unit()
            .or_else(|| tangential(s)?.unit())
            .filter(|_| !matches!(s.choice.path, RelativePath::Unknown)),
    }
}

/// Returns the angle of a vector from a line (rad, from 0 to π).
pub(super) fn angle_from(v: Vec2, line: Vec2) -> Option<f64> {
    let u = v.unit()?;
    Some(Vec2::new(u.dot(line), u.cross(line).abs()).angle())
}

fn velocities(s: &ChoiceSolution) -> Vec<(ProjectionTerm, Vec2)> {
    let [absolute, transport, relative] = s.velocity;
    vec![
        (ProjectionTerm::Absolute, absolute),
        (ProjectionTerm::Part(CompositePart::TransportVelocity), transport),
        (ProjectionTerm::Part(CompositePart::RelativeVelocity), relative),
    ]
}

/// Returns the vectors of the acceleration equation. For a point on a fixed circle with wanted
/// motion, a_aⁿ is known and a_aᵗ is not, so a_a is resolved into both.
fn accelerations(s: &ChoiceSolution) -> Vec<(ProjectionTerm, Vec2)> {
    let own = s
        .circle
        .filter(|_| s.known == KnownMotion::Transport && s.closure == ChoiceUnknowns::Crossing);
    let told = |(part, v): &(Option<CompositePart>, Vec2)| match (part, own) {
        (Some(part), _) => vec![(ProjectionTerm::Part(*part), *v)],
        (None, Some(inward)) => {
            let normal = inward * inward.dot(*v);
            vec![
                (ProjectionTerm::AbsoluteNormal, normal),
                (ProjectionTerm::AbsoluteTangential, *v - normal),
            ]
        }
        (None, None) => vec![(ProjectionTerm::Absolute, *v)],
    };
    s.acceleration.iter().flat_map(told).collect()
}

/// Returns the equation of a level, projected on a line.
fn projected(
    s: &ChoiceSolution,
    of: DiagramKind,
    (on, line): (On, Vec2),
    vectors: &[(ProjectionTerm, Vec2)],
) -> Option<Projection> {
    let largest = vectors.iter().map(|v| v.1.norm()).fold(0.0, f64::max);
    let on_line = |(term, v): &(ProjectionTerm, Vec2)| {
        (v.dot(line).abs() > SQUARE * largest).then_some((*term, angle_from(*v, line)?))
    };
    let mut terms: Vec<(ProjectionTerm, f64)> = vectors.iter().filter_map(on_line).collect();
    if matches!(on, On::X | On::Y) {
        terms.retain(|(term, _)| *term != ProjectionTerm::Absolute);
        terms.insert(0, (ProjectionTerm::Component, 0.0));
    }
    let [absolute, _, relative] = s.velocity;
    let rests = relative.norm() <= SQUARE * absolute.norm();
    (terms.len() > 1).then_some(Projection { of, on, line, rests, terms })
}

/// Returns a_rᵗ.
fn tangential(s: &ChoiceSolution) -> Option<Vec2> {
    s.acceleration
        .iter()
        .find(|(part, _)| *part == Some(CompositePart::RelativeTangential))
        .map(|(_, v)| *v)
}
