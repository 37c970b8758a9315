//! Chooses the layout of a drawing by a trial, and draws to it.

use super::acts::Acts;
use super::pencil::{Exact, Pencil};
use super::scale::{self, Boxes};
use super::{PlanDrawing, choices, drawing};
use crate::plan::Plan;
use hodograph_base::diag::Faults;
use hodograph_mechanism::mechanism::Mechanism;
use hodograph_mechanism::position::Configuration;
use hodograph_scene::{ByKind, DiagramKind, Kind, Scene};
use std::sync::Arc;

/// The scales of a drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    /// The scale of the mechanism (m/mm).
    pub mu: f64,
    /// The scales of the polygons (SI per mm); a polygon without a scale is not drawn.
    pub scales: ByKind,
}

impl Layout {
    /// Returns the layout of a finished drawing.
    pub fn of(done: &PlanDrawing) -> Layout {
        Layout {
            mu: done.diagram.mu,
            scales: done.diagrams.iter().map(|p| (p.on.kind(), p.mu)).collect(),
        }
    }

    /// Returns the layout with all drawings `factor` times as large.
    pub fn enlarged(&self, factor: f64) -> Layout {
        Layout { mu: self.mu / factor, scales: self.scales.map(|mu| mu / factor) }
    }

    /// Returns the scales of all diagrams.
    pub(super) fn all(&self) -> ByKind {
        let mut all = self.scales.clone();
        all.set(Kind::Length, Some(self.mu));
        all
    }
}

/// Draws a plan twice: a trial that chooses special points and scales, then the drawing itself.
///
/// # Errors
/// Two unknown directions that are parallel, at a dead centre (the diagnostic names the links and
/// the joint); numbers too large to draw.
pub fn construct(
    scene: &Scene,
    m: &Mechanism,
    at: &Configuration,
    plan: &Plan,
    boxes: &Boxes,
) -> Result<PlanDrawing, Faults> {
    let mu = scale::fitted(&scene.paper, Kind::Length, scale::size(scene, at), boxes.diagram);
    let chosen = choices::alternatives(scene, m, at, plan, mu)?;
    let acts = Acts::of(scene, m, plan, &chosen);
    let layout = trial(scene, at, plan, &acts, mu, boxes, &mut Exact)?;
    acts.draw(scene, at, plan, &layout, &mut Exact)
}

/// Returns the layout of a plan: the scales at which each polygon fits its space, found on a
/// drawing of any size.
fn trial<P: Pencil>(
    scene: &Scene,
    at: &Configuration,
    plan: &Plan,
    acts: &Arc<Acts>,
    mu: f64,
    boxes: &Boxes,
    pencil: &mut P,
) -> Result<Layout, Faults> {
    let polygons = DiagramKind::POLYGONS.into_iter().filter(|on| on.level() <= plan.level);
    let large = Layout {
        mu,
        scales: polygons.map(|on| (on.kind(), choices::trial_scale(scene, at, on))).collect(),
    };
    let drawn = drawing::fall(acts, scene, at, plan, &large, pencil)?;
    let fit = |(on, scale): (Kind, f64), diagram: usize| {
        let marks = acts
            .construction
            .marks
            .iter()
            .zip(&drawn.marks)
            .filter(|(m, _)| m.on.index() == diagram)
            .filter_map(|(_, at)| *at);
        let extent = scale::extent(marks).map(|mm| mm * scale);
        (on, scale::fitted(&scene.paper, on, extent, boxes.polygon))
    };
    let kinds = acts.construction.diagrams.iter().map(|on| on.kind()).enumerate();
    Ok(Layout {
        mu,
        scales: kinds.filter_map(|(k, on)| Some(fit((on, large.scales.get(on)?), k))).collect(),
    })
}
#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan;
    use hodograph_base::geom::Point;
    use hodograph_mechanism::mechanism::Demand;
    use hodograph_mechanism::position::configure;
    use hodograph_scene::{read, templates};

    /// The exact pencil, with a count of its marks on each diagram.
    #[derive(Default)]
    struct Counting(ByKind<usize>);

    impl Pencil for Counting {
        const EXACT: bool = true;

        fn mark(&mut self, on: DiagramKind, at: Point) -> Point {
            *self.0.entry(on.kind()) += 1;
            at
        }
    }

    #[test]
    fn the_trial_is_one_drawing_and_the_drawing_keeps_its_layout() {
        let mut marks = 0;
        for template in templates::list() {
            let Ok(scene) = read(templates::get(template.name).unwrap()) else { continue };
            let scene = scene.value;
            let Ok(m) = Mechanism::new(&scene) else { continue };
            let m = m.value;
            let demand = Demand::of(&scene, &m).with_all_positions();
            let Ok(at) = configure(&scene, &m, &demand) else { continue };
            let plan = plan::plan(&scene, &m, &demand);
            let (mut before, mut then) = (Counting::default(), Counting::default());
            let (mu, boxes) = (
                scale::fitted(
                    &scene.paper,
                    Kind::Length,
                    scale::size(&scene, &at.value),
                    [130.0; 2],
                ),
                Boxes::of(&scene.paper, &plan),
            );
            let Ok(chosen) = choices::alternatives(&scene, &m, &at.value, &plan, mu) else {
                continue;
            };
            let acts = Acts::of(&scene, &m, &plan, &chosen);
            let Ok(layout) = trial(&scene, &at.value, &plan, &acts, mu, &boxes, &mut before) else {
                continue;
            };
            let done = acts.draw(&scene, &at.value, &plan, &layout, &mut then).unwrap();
            assert_eq!(Layout::of(&done), layout, "{}", template.name);
            assert_eq!(before.0, then.0, "{}", template.name);
            marks += then.0.values().sum::<usize>();
        }
        assert!(marks > 500, "{marks}");
    }
}
