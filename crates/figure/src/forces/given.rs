//! Draws the given loads on the mechanism: weights, applied forces and couples, springs.
//!
//! Inertia forces and reactions are drawn at the separated links.

use super::ForcePage;
use hodograph_board::equilibrium::ForceTerm;
use hodograph_mechanism::force::Cause;
use hodograph_paper::paper::drawing::Drawing;
use hodograph_paper::paper::symbols;
use hodograph_scene::{LinkId, PointId, Spring};

/// Length of the ground line at the end of a spring.
const GROUND_MM: f64 = 8.0;

impl ForcePage<'_> {
    pub(super) fn given_loads(&self, d: &mut Drawing) {
        let is_given = |cause: Cause| matches!(cause, Cause::Weight | Cause::Applied(_));
        let size = |k: usize| self.of.loads[k].wrench.force.norm();
        let mut given: Vec<usize> =
            (0..self.of.loads.len()).filter(|k| is_given(self.of.loads[*k].cause)).collect();
        // The smaller of two forces on one line is placed after the larger one.
        given.sort_by(|a, b| size(*b).total_cmp(&size(*a)));
        let largest = given.first().map_or(0.0, |k| size(*k));
        for k in given {
            let load = &self.of.loads[k];
            match load.at.and_then(|p| self.place(p)) {
                Some(at) => {
                    self.force(d, (ForceTerm::Load(k), "force"), at, load.wrench.force, largest)
                }
                None => self.couple(d, k, self.centre(load.link), load.wrench.couple),
            }
        }
        for (k, spring) in self.maker.scene.loads.springs.iter().enumerate() {
            self.spring(d, k, spring);
        }
    }

    /// The point about which the couple of a link is drawn: its pivot on the ground, or else its
    /// first point.
    fn centre(&self, link: LinkId) -> Option<PointId> {
        let scene = self.maker.scene;
        let points = &scene.links[link.0].points;
        points
            .iter()
            .find(|p| scene.links[scene.ground.0].points.contains(p))
            .or(points.first())
            .copied()
    }

    /// Draws a spring between its ends, and the ground that holds it.
    fn spring(&self, d: &mut Drawing, k: usize, spring: &Spring) {
        let [Some(from), Some(to)] = spring.ends.map(|(p, _)| self.place(p)) else { return };
        let (id, style) = (format!("spring-{}", k + 1), self.style());
        d.draw(&id, "", symbols::spring(style, from, to));
        let Some(along) = (to - from).unit() else { return };
        for ((_, link), at, out) in [(spring.ends[0], from, -along), (spring.ends[1], to, along)] {
            if link == self.maker.scene.ground {
                let half = out.perp() * (GROUND_MM / 2.0);
                d.draw(
                    &format!("{id}-ground"),
                    "",
                    symbols::ground_line(style, at + half, at + -half),
                );
            }
        }
    }
}
