//! Marks directions that the equation tables name t: guides that are not along a line of two named
//! points.

use super::MechanismDraft;
use hodograph_board::plan::text::PlanWriter;
use hodograph_paper::paper::item::Shape;
use hodograph_scene::{DiagramKind, GuideId, Lang};

/// The mark begins beyond the block and is long enough to show a direction.
const FROM_MM: f64 = 9.0;
const TO_MM: f64 = 17.0;

impl MechanismDraft<'_> {
    /// Marks the guides with a direction that an equation names t.
    pub(super) fn directions(&mut self) {
        let plan = &self.worked.plan;
        let w = PlanWriter { scene: self.scene, plan, notation: self.notation, lang: Lang::En };
        let named: Vec<(GuideId, String)> = (0..self.scene.guides.len())
            .map(GuideId)
            .filter(|g| {
                plan.steps(DiagramKind::Velocity)
                    .iter()
                    .flat_map(|s| s.steps(0))
                    .any(|s| s.slides_along(*g))
            })
            .filter_map(|g| Some((g, w.tangent(g)?)))
            .collect();
        for (g, name) in named {
            let Some((at, tangent)) = self.runner(g) else { continue };
            // Away from the nearest point of the link that carries the guide, where there is space.
            let others = &self.scene.links[self.scene.guides[g.0].on.0].points;
            let nearest = others
                .iter()
                .filter_map(|p| self.point(*p))
                .min_by(|p, q| p.distance(at).total_cmp(&q.distance(at)));
            let u = if nearest.is_some_and(|p| (p - at).dot(tangent) > 0.0) {
                tangent * -1.0
            } else {
                tangent
            };
            let (from, to) = (at + u * FROM_MM, at + u * TO_MM);
            let shape = Shape::Line { from, to, stroke: self.style.thin };
            self.d.shape(&format!("direction-{name}"), "direction", shape);
            self.d.label_at(
                &format!("direction-{name}"),
                "direction letter",
                &name,
                to,
                self.style.thin.width_mm,
                Some(u),
            );
        }
    }
}
