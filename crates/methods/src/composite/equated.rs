//! One moving point in two frames: v_e1 + v_r1 = v_e2 + v_r2.
//!
//! Neither equation alone can be solved if v_a is unknown in magnitude and direction. Both give the
//! motion of the same point, and the magnitudes of both relative motions are the only unknowns: the
//! projection square to one relative path leaves the relative motion along the other.

use super::projection::{SQUARE, along, angle_from};
use super::solved::{ChoiceUnknowns, KnownMotion};
use super::{ChoiceSolution, ChoiceVerdict};
use hodograph_base::geom::Vec2;
use hodograph_scene::DiagramKind;
use hodograph_scene::quantity::composite::CompositePart;

/// Two solutions with one moving point, set equal.
#[derive(Clone, Debug, PartialEq)]
pub struct EquatedFrames {
    /// The solutions, as indices.
    pub of: [usize; 2],
    /// The projections: of the velocities, then of the accelerations.
    pub projections: Vec<EquatedProjection>,
}

/// The equation of both frames, projected on the line square to one relative path.
#[derive(Clone, Debug, PartialEq)]
pub struct EquatedProjection {
    /// The kind of equation.
    pub of: DiagramKind,
    /// The frame, 0 or 1, whose relative motion is found.
    pub wanted: usize,
    /// The direction of the line (unit vector).
    pub line: Vec2,
    /// The parts in each frame that have a component on the line, with their angle from it (rad,
    /// from 0 to π).
    pub terms: [Vec<(CompositePart, f64)>; 2],
}

/// Returns true for a solution whose equation has more than two unknowns, and could be set equal to
/// that of the same point in a second frame.
pub(super) fn needs_second(s: &ChoiceSolution) -> bool {
    s.choice.verdict == ChoiceVerdict::Serves
        && s.slip.is_none()
        && s.known == KnownMotion::Transport
        && s.closure == ChoiceUnknowns::Open
}

/// Returns the pairs of solutions that only together determine the motion of their moving point.
pub fn equated(solved: &[ChoiceSolution]) -> Vec<EquatedFrames> {
    let mut out = Vec::new();
    for (k, first) in solved.iter().enumerate() {
        for (l, second) in solved.iter().enumerate().skip(k + 1) {
            let open = needs_second(first) && needs_second(second);
            if !open || first.choice.of != second.choice.of {
                continue;
            }
            let projections = projections([first, second]);
            if !projections.is_empty() {
                out.push(EquatedFrames { of: [k, l], projections });
            }
        }
    }
    out
}

fn projections(both: [&ChoiceSolution; 2]) -> Vec<EquatedProjection> {
    let [Some(one), Some(two)] = both.map(along) else { return Vec::new() };
    if one.cross(two).abs() < SQUARE {
        return Vec::new();
    }
    let mut out = Vec::new();
    for of in DiagramKind::POLYGONS {
        let parts = both.map(|s| parts(s, of));
        let largest = parts.iter().flatten().map(|(_, v)| v.norm()).fold(0.0, f64::max);
        if largest == 0.0 {
            continue;
        }
        for (wanted, own, other) in [(0, one, two), (1, two, one)] {
            let line = if own.dot(other.perp()) < 0.0 { -other.perp() } else { other.perp() };
            let on_line = |(part, v): &(CompositePart, Vec2)| {
                let share = v.dot(line).abs();
                (share > SQUARE * largest).then(|| Some((*part, angle_from(*v, line)?))).flatten()
            };
            let terms = parts.each_ref().map(|parts| parts.iter().filter_map(on_line).collect());
            out.push(EquatedProjection { of, wanted, line, terms });
        }
    }
    out
}

/// Returns the parts of the motion in one frame.
fn parts(s: &ChoiceSolution, of: DiagramKind) -> Vec<(CompositePart, Vec2)> {
    let [_, transport, relative] = s.velocity;
    match of {
        DiagramKind::Acceleration => {
            s.acceleration.iter().filter_map(|(part, v)| Some(((*part)?, *v))).collect()
        }
        DiagramKind::Plane | DiagramKind::Velocity | DiagramKind::Force => vec![
            (CompositePart::TransportVelocity, transport),
            (CompositePart::RelativeVelocity, relative),
        ],
    }
}

#[cfg(test)]
mod tests {
    use super::super::{ContactScene, level};
    use super::*;
    use hodograph_scene::read;
    use hodograph_scene::templates::instantiate;

    /// Both sides of each projection are equal, and each has one unknown.
    #[test]
    fn a_projection_leaves_one_relative_motion() {
        for phi in ["25 deg", "40 deg", "-50 deg"] {
            let scene = read(instantiate("two-slots", &[("phi_2", phi)]).unwrap()).unwrap().value;
            let staged = ContactScene::new(&scene);
            let choices = staged.shown(&scene, 1);
            let (_, solved) =
                staged.solved_with_second(&scene, &choices, level(&scene)).unwrap().value;
            let [pair] = &equated(&solved)[..] else { panic!("{phi}") };
            assert_eq!((pair.of, pair.projections.len()), ([0, 1], 4));
            for p in &pair.projections {
                let sum = |k: usize| -> f64 {
                    let parts = parts(&solved[k], p.of);
                    let of = |part| parts.iter().find(|(own, _)| *own == part).unwrap().1.norm();
                    p.terms[k].iter().map(|(part, angle)| of(*part) * angle.cos()).sum()
                };
                assert!((sum(0) - sum(1)).abs() < 1e-9, "{phi}: {p:?}");
                let unknown = match p.of {
                    DiagramKind::Acceleration => CompositePart::RelativeTangential,
                    _ => CompositePart::RelativeVelocity,
                };
                let has = |k: usize| p.terms[k].iter().any(|(part, _)| *part == unknown);
                assert!(has(p.wanted) && !has(1 - p.wanted), "{phi}: {p:?}");
            }
        }
    }
}
