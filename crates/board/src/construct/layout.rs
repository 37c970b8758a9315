//! The layout of a drawing, chosen by a trial, and the drawing to it.

use super::Construction;
use super::board::Board;
use super::pencil::{Exact, Pencil};
use super::scale::{self, Boxes};
use crate::plan::Plan;
use hodograph_base::diag::Faults;
use hodograph_base::number::Real;
use hodograph_mechanism::mechanism::Mechanism;
use hodograph_mechanism::position::Configuration;
use hodograph_scene::{ByKind, DiagramKind, Kind, Scene};

/// The choices before a drawing is made: scales, and which special points are used.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    /// Scale of the mechanism (m/mm).
    pub mu: f64,
    /// Scales of the polygons, SI per mm; what has none is not drawn.
    pub scales: ByKind,
    /// For each group, the alternative of its steps.
    pub chosen: Vec<usize>,
}

impl Layout {
    /// The layout of a finished construction.
    pub fn of(done: &Construction) -> Layout {
        let scales = done.diagrams.iter().map(|p| (p.on.kind(), p.mu)).collect();
        Layout { mu: done.diagram.mu, scales, chosen: done.chosen.clone() }
    }

    /// All drawings `factor` times as large.
    pub fn enlarged(&self, factor: f64) -> Layout {
        Layout { mu: self.mu / factor, scales: self.scales.map(|mu| mu / factor), chosen: self.chosen.clone() }
    }
}

/// Draws a plan: once for trial, which chooses special points and scales, and once to them.
///
/// # Errors
/// Two unknown directions that are parallel: a dead centre, with the links and the joint; numbers too large to draw.
pub fn construct(scene: &Scene, m: &Mechanism, at: &Configuration, plan: &Plan, boxes: &Boxes) -> Result<Construction, Faults> {
    let layout = trial(scene, m, at, plan, boxes, &mut Exact)?;
    drawn(scene, m, at, plan, &layout, &mut Exact)?.finish()
}

/// The layout of a plan: the special points that lie best, and the scales at which each polygon, drawn on a sheet of any size, fits its room.
fn trial<P: Pencil>(
    scene: &Scene,
    m: &Mechanism,
    at: &Configuration,
    plan: &Plan,
    boxes: &Boxes,
    pencil: &mut P,
) -> Result<Layout, Faults> {
    let mu = scale::fitted(&scene.paper, Kind::Length, scale::size(scene, at), boxes.diagram);
    let mut board = Board::new(scene, m, at, plan, mu, pencil);
    for g in 0..m.groups.len() {
        if plan.steps(DiagramKind::Velocity).iter().any(|s| s.group == g && s.alternatives.len() > 1) {
            board.done.chosen[g] = board.best_alternative(g)?;
        }
    }
    board.set_out();
    let mut scales = ByKind::default();
    for on in DiagramKind::POLYGONS.into_iter().filter(|on| on.level() <= plan.level) {
        let polygon = board.draw(on, board.trial_scale(on))?;
        scales.set(on.kind(), Some(scale::fitted(&scene.paper, on.kind(), polygon.extent(), boxes.polygon)));
        board.keep(polygon);
    }
    Ok(Layout { mu, scales, chosen: board.done.chosen })
}

/// Everything drawn to a layout; what has no scale in it is not drawn.
pub(super) fn drawn<'a, N: Real, P: Pencil<N>>(
    scene: &'a Scene,
    m: &'a Mechanism,
    at: &'a Configuration<N>,
    plan: &'a Plan,
    layout: &Layout,
    pencil: &'a mut P,
) -> Result<Board<'a, N, P>, Faults> {
    let mut board = Board::new(scene, m, at, plan, layout.mu, pencil);
    board.done.chosen.clone_from(&layout.chosen);
    board.set_out();
    for on in DiagramKind::POLYGONS {
        if let Some(mu) = layout.scales.get(on.kind()) {
            let polygon = board.draw(on, mu)?;
            board.keep(polygon);
        }
    }
    Ok(board)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan;
    use hodograph_base::geom::Point;
    use hodograph_mechanism::mechanism::Demand;
    use hodograph_mechanism::position::configure;
    use hodograph_scene::{read, templates};

    /// The exact pencil, and how many marks it makes on each diagram.
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
            let Ok(layout) = trial(&scene, &m, &at.value, &plan, &Boxes::of(&scene.paper, &plan), &mut before) else { continue };
            let done = drawn(&scene, &m, &at.value, &plan, &layout, &mut then).unwrap().finish().unwrap();
            assert_eq!(Layout::of(&done), layout, "{}", template.name);
            assert_eq!(before.0, then.0, "{}", template.name);
            marks += then.0.values().sum::<usize>();
        }
        assert!(marks > 500, "{marks}");
    }
}
