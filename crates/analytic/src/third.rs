//! The third derivative of the motion: one more order of the loop equations, with the same Jacobian
//! as velocities and accelerations.
//!
//! With c₁ = q̇ and c₂ = q̈/2 known, the terms of t³ leave J c₃ = −r₃, where r₃ is the contribution
//! of the lower terms to each equation ([`super::series`]). Drivers keep their accelerations
//! constant; followers of cams with a law have the third derivative of the law.

use super::rows::UnknownLayout;
use super::series::MotionSeries;
use super::{LoopSystem, Solution};
use hodograph_base::geom::{Point, Vec2};
use hodograph_mechanism::mechanism::{Demand, Level, Mechanism};
use hodograph_mechanism::position::Configuration;
use hodograph_scene::{LinkId, Scene};
use nalgebra::DVector;

/// The third derivatives of a link: of the position of a point of it (m/s³), and of its angle
/// (rad/s³).
type ThirdDerivatives = (Vec2, f64);

/// Returns the third derivatives of all links that are requested up to their accelerations, at the
/// link's point at `place`; `None` for the other links, and for all links in a singular pose.
pub fn third(
    scene: &Scene,
    m: &Mechanism,
    at: &Configuration,
    demand: &Demand,
    solution: &Solution,
    place: Point,
) -> Vec<Option<ThirdDerivatives>> {
    let mut out = vec![None; scene.links.len()];
    out[scene.ground.0] = Some((Vec2::ZERO, 0.0));
    if let Some(found) = solved(scene, m, at, demand, solution) {
        for (l, third) in found {
            out[l.0] = solution.moved_to(l, place, third);
        }
    }
    out
}

fn solved(
    scene: &Scene,
    m: &Mechanism,
    at: &Configuration,
    demand: &Demand,
    solution: &Solution,
) -> Option<Vec<(LinkId, ThirdDerivatives)>> {
    if !solution.singular.is_empty() || !solution.refused.is_empty() {
        return None;
    }
    let layout = UnknownLayout::new(scene, m, at, demand, Level::Acceleration);
    if layout.unknowns == 0 {
        return None;
    }
    let mut motion = MotionSeries::new(layout.unknowns);
    let [rates, accelerations] =
        [Level::Velocity, Level::Acceleration].map(|level| packed(&layout, solution, level));
    for (u, (rate, acceleration)) in rates?.into_iter().zip(accelerations?).enumerate() {
        motion.set(u, 1, rate);
        motion.set(u, 2, 0.5 * acceleration);
    }
    let system = LoopSystem::new(scene, at, &layout).ok()?;
    let left = system
        .rows
        .iter()
        .map(|row| layout.third_by_law(scene, row.of) / 6.0 - motion.residual(&row.relation, 3));
    let terms = system.solve(&DVector::from_iterator(system.rows.len(), left))? * 6.0;
    Some(
        layout
            .links
            .iter()
            .enumerate()
            .map(|(i, l)| {
                (
                    *l,
                    (
                        Vec2::new(terms[3 * i], terms[3 * i + 1]) * (1.0 / layout.scale),
                        terms[3 * i + 2],
                    ),
                )
            })
            .collect(),
    )
}

/// Returns the rates of a level for the unknowns of a layout, from a solution; `None` if the
/// solution does not contain them.
fn packed(layout: &UnknownLayout, from: &Solution, level: Level) -> Option<Vec<f64>> {
    let mut x = Vec::with_capacity(layout.unknowns);
    let second = level == Level::Acceleration;
    for l in &layout.links {
        let motion = from.links[l.0]?;
        let (v, turning) = if second { motion.second? } else { (motion.v, motion.omega) };
        x.extend([v.x * layout.scale, v.y * layout.scale, turning]);
    }
    for p in &layout.bare {
        let v = from.bare[usize::from(second)].iter().find(|b| b.0 == *p)?.1;
        x.extend([v.x * layout.scale, v.y * layout.scale]);
    }
    Some(x)
}

impl Solution {
    /// Returns the velocity or acceleration of the point of a link at a position.
    pub fn of_link(&self, level: Level, link: LinkId, place: Point) -> Option<Vec2> {
        if link == self.ground { Some(Vec2::ZERO) } else { self.of_place(level, link, place) }
    }

    /// Returns the third derivative at a point of a link, from that at its origin: (D³ e^{iθ}) r =
    /// (i θ⃛ − 3 ω α − i ω³) r.
    fn moved_to(
        &self,
        link: LinkId,
        place: Point,
        (of_origin, turning): ThirdDerivatives,
    ) -> Option<ThirdDerivatives> {
        let motion = self.links[link.0]?;
        let (omega, (_, alpha)) = (motion.omega, motion.second?);
        let r = place - self.origins[link.0]?;
        Some((
            of_origin + r.perp() * (turning - omega * omega * omega) - r * (3.0 * omega * alpha),
            turning,
        ))
    }
}
