//! Draws acts, and collects the marks under the names of the plan.

use super::acts::Acts;
use super::choices::SPECIAL_LEGS;
use super::givens::{PosedInputs, origin};
use super::layout::Layout;
use super::pencil::Pencil;
use super::refusal::{overflow, refusal};
use super::scale;
use super::{
    Action, Crossed, Diagram, Edge, PlanDrawing, Polygon, PolygonMark, RateMeasured, RateReading,
};
use crate::construction::{
    self, Because, DiagramId, DrawnPlaces, Line, LineId, MarkId, Met, Name, Number, Op, Step,
    VectorId,
};
use crate::plan::{Plan, VertexId};
use hodograph_base::diag::Faults;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_mechanism::position::{Configuration, Pose};
use hodograph_scene::{ByKind, DiagramKind, Scene};
use std::sync::Arc;

impl Acts {
    /// Draws to given scales.
    ///
    /// In numbers with error bounds and with the exact pencil, every mark has a bound of its
    /// rounding error.
    ///
    /// # Errors
    /// Two unknown directions that are parallel, possibly only because of the pencil's error;
    /// numbers too large to draw.
    pub fn draw<N: Real, P: Pencil<N>>(
        self: &Arc<Acts>,
        scene: &Scene,
        at: &Configuration<N>,
        plan: &Plan,
        layout: &Layout,
        pencil: &mut P,
    ) -> Result<PlanDrawing<N>, Faults> {
        told(evaluate(self, scene, at, plan, layout, pencil)?.0)
    }
}

/// Returns the drawing if all its numbers are finite and decided.
fn told<N: Real>(done: PlanDrawing<N>) -> Result<PlanDrawing<N>, Faults> {
    let finite =
        |p: &Polygon<N>| p.images.iter().flatten().all(|q| q.is_finite()) && p.mu.is_finite();
    if done.diagrams.iter().all(finite) && done.rates.iter().all(|r| r.value.is_decided()) {
        return Ok(done);
    }
    Err(overflow().into())
}

/// Evaluates the construction.
pub(super) fn fall<N: Real, P: Pencil<N>>(
    acts: &Acts,
    scene: &Scene,
    at: &Configuration<N>,
    plan: &Plan,
    layout: &Layout,
    pencil: &mut P,
) -> Result<DrawnPlaces<N>, Faults> {
    let posed = PosedInputs::new(scene, at, &acts.givens);
    Ok(construction::draw(&acts.construction, &posed, &layout.all(), pencil)
        .map_err(|stop| refusal(acts, scene, plan, &stop))?)
}

/// Returns the drawing, even if its numbers are not decided, and the place of every mark of the
/// construction.
fn evaluate<N: Real, P: Pencil<N>>(
    acts: &Arc<Acts>,
    scene: &Scene,
    at: &Configuration<N>,
    plan: &Plan,
    layout: &Layout,
    pencil: &mut P,
) -> Result<(PlanDrawing<N>, DrawnPlaces<N>), Faults> {
    let drawn = fall(acts, scene, at, plan, layout, pencil)?;
    let drawing =
        ActsView { acts, plan, drawn: &drawn, scales: &layout.all() }.drawing(origin(scene, at));
    Ok((drawing, drawn))
}

struct ActsView<'a, N> {
    acts: &'a Arc<Acts>,
    plan: &'a Plan,
    drawn: &'a DrawnPlaces<N>,
    scales: &'a ByKind,
}

impl<N: Real> ActsView<'_, N> {
    fn drawing(&self, origin: Point<N>) -> PlanDrawing<N> {
        let (construction, plane) = (&self.acts.construction, DiagramKind::Plane);
        let place = |mark: &Option<MarkId>| mark.and_then(|m| self.drawn.marks[m.index()]);
        let spots =
            self.acts.images.first().map_or(Vec::new(), |spots| spots.iter().map(place).collect());
        let mu = self.scales.get(plane.kind()).unwrap_or(1.0);
        let mut out = PlanDrawing {
            diagram: Diagram { mu, origin, spots, crossed: self.crossed() },
            diagrams: Vec::new(),
            rates: Vec::new(),
            magnification: ByKind::default(),
            acts: Arc::clone(self.acts),
        };
        for (index, on) in construction.diagrams.iter().enumerate().filter(|(_, on)| **on != plane)
        {
            let Some(mu) = self.scales.get(on.kind()) else { continue };
            let mut polygon = Polygon {
                on: *on,
                mu,
                images: self.acts.images[index].iter().map(place).collect(),
                edges: Vec::new(),
                actions: Vec::new(),
            };
            let at =
                |(mark, id): (PolygonMark, MarkId)| Some((mark, self.drawn.marks[id.index()]?));
            let edge = |e: &Edge<MarkId>| {
                Some(Edge {
                    terms: e.terms.clone(),
                    from: at(e.from)?,
                    to: at(e.to)?,
                    known: e.known,
                    between: e.between,
                })
            };
            polygon.edges = self.acts.edges[index].iter().filter_map(edge).collect();
            for (k, step) in
                construction.steps.iter().enumerate().filter(|(_, s)| s.on.index() == index)
            {
                let action = self.action(k, step, &mut out.rates);
                polygon.actions.extend(action);
            }
            out.diagrams.push(polygon);
        }
        for met in &self.drawn.met {
            // Errors of velocities grow with 1/sine; those of accelerations with the square of
            // velocities and one more crossing.
            let s = met.sine.approx().abs();
            let on = construction.diagrams[construction.marks[met.to.index()].on.index()];
            if on != plane {
                let mut magnify = |on: DiagramKind, by: f64| {
                    let worst = out.magnified(on).max(by);
                    out.magnification.set(on.kind(), Some(worst));
                };
                magnify(DiagramKind::Velocity, met.rounding / s);
                magnify(DiagramKind::Acceleration, met.rounding * met.rounding / (s * s * s));
            }
        }
        out
    }

    /// Returns the special points that the alternatives of the groups use.
    fn crossed(&self) -> Vec<Crossed<N>> {
        let used = |met: &&Met<N>| {
            let Name::Image(v) = self.acts.construction.marks[met.to.index()].name else {
                return false;
            };
            let Some(special) = self.plan.special(VertexId(v.index())) else { return false };
            let alternative =
                special.legs.and_then(|legs| SPECIAL_LEGS.iter().position(|l| *l == legs));
            self.on(met.to) == DiagramKind::Plane
                && alternative.is_none_or(|k| self.acts.chosen[special.group] == k)
        };
        self.drawn
            .met
            .iter()
            .filter(used)
            .map(|met| Crossed { target: self.vertex(met.to), sine: met.sine })
            .collect()
    }

    fn on(&self, mark: MarkId) -> DiagramKind {
        self.acts.construction.diagrams[self.acts.construction.marks[mark.index()].on.index()]
    }

    /// Returns the vertex of an image.
    fn vertex(&self, mark: MarkId) -> VertexId {
        match self.acts.mark(mark) {
            PolygonMark::Image(v) => v,
            PolygonMark::Pole | PolygonMark::Part(_) | PolygonMark::Again(_) => {
                unreachable!("what is found is the image of a vertex")
            }
        }
    }

    fn place(&self, mark: MarkId) -> Point<N> {
        self.drawn.marks[mark.index()].expect("what is drawn has a place")
    }

    /// Returns the index of a vector among those of its diagram.
    fn edge(&self, on: DiagramId, vector: VectorId) -> usize {
        vector.index() - self.acts.edges[..on.index()].iter().map(Vec::len).sum::<usize>()
    }

    fn line(&self, line: LineId) -> Vec2<N> {
        self.drawn.lines[line.index()].expect("what is drawn has a direction").1
    }

    /// Returns a step as an action of the plan; `None` for a step that is not described.
    fn action(
        &self,
        index: usize,
        step: &Step,
        rates: &mut Vec<RateReading<N>>,
    ) -> Option<Action<N>> {
        let construction = &self.acts.construction;
        let ends = step.ends.map(|[a, b]| (VertexId(a.index()), VertexId(b.index())));
        Some(match construction.ops(step) {
            [.., Op::Lay { vector, .. }] => Action::LayOff(self.edge(step.on, *vector)),
            [Op::Rule(line)] => {
                let Line { through, carries, .. } = &construction.lines[line.index()];
                Action::Line {
                    terms: self.acts.terms(carries),
                    mark: self.acts.mark(*through),
                    through: self.place(*through),
                    direction: self.line(*line),
                }
            }
            [Op::Meet { to, .. }, Op::Show(a), Op::Show(b)] => {
                let met = &self.drawn.met
                    [self.drawn.met.binary_search_by_key(&index, |m| m.step).ok()?];
                Action::Cross {
                    target: self.vertex(*to),
                    edges: vec![self.edge(step.on, *a), self.edge(step.on, *b)],
                    sine: met.sine,
                }
            }
            [Op::Rule(a), Op::Rule(b), Op::Meet { to, .. }] => {
                let met = &self.drawn.met
                    [self.drawn.met.binary_search_by_key(&index, |m| m.step).ok()?];
                let ends = [*a, *b].map(|line| {
                    (self.place(construction.lines[line.index()].through), self.line(line))
                });
                Action::Trials { target: self.vertex(*to), lines: ends, sine: met.sine }
            }
            [Op::Rule(line), Op::Foot { .. }, Op::Show(a), Op::Show(b)] => Action::Perpendicular {
                edges: [*a, *b].map(|v| self.edge(step.on, v)),
                direction: self.line(*line),
            },
            [Op::Image { to, .. }] => Action::Copy { target: self.vertex(*to), from: ends? },
            [Op::Same { to, because: Because::Reached, .. }] => Action::Reach(self.vertex(*to)),
            [Op::Same { to, because: Because::Translates, .. }] => {
                Action::Same { target: self.vertex(*to), from: ends?.0 }
            }
            [Op::Omit { terms, at, to }] => Action::Nothing {
                terms: self.acts.terms(terms),
                at: self.place(*at),
                target: to.map(|to| self.vertex(to)),
            },
            [Op::Show(vector)] => Action::Join(self.edge(step.on, *vector)),
            _ => {
                let turning = &self.acts.turnings
                    [self.acts.turnings.binary_search_by_key(&index, |t| t.step).ok()?];
                let number = |id| self.drawn.number(id);
                let measured = turning.measured.and_then(|([across, arm], line)| {
                    let Number::Across { from, to, .. } = construction.numbers[across.index()]
                    else {
                        return None;
                    };
                    let marks = [from, to].map(|mark| (self.acts.mark(mark), self.place(mark)));
                    Some(RateMeasured {
                        length: number(across)?.magnitude(),
                        arm: number(arm)?,
                        line,
                        marks,
                    })
                });
                rates.push(RateReading {
                    on: turning.on,
                    body: turning.body,
                    value: number(turning.number)?,
                    measured,
                });
                Action::Rate(rates.len() - 1)
            }
        })
    }
}

/// Draws with an inexact pencil; returns the drawing, and the configuration of its diagram, with
/// joints where the pencil put them.
///
/// The lengths of links (two joints of one link), the radii of slots, the rates of the drivers and
/// μ count as known. Everything else is measured on the drawing: directions from the drawn joints,
/// variable lengths (a pin in its slot) and shapes of links for images from the diagram, ω and α
/// from the polygons.
///
/// # Errors
/// The errors of [`Acts::draw`].
pub fn by_hand<N: Real, P: Pencil<N>>(
    acts: &Arc<Acts>,
    scene: &Scene,
    at: &Configuration<N>,
    plan: &Plan,
    layout: &Layout,
    pencil: &mut P,
) -> Result<(PlanDrawing<N>, Configuration<N>), Faults> {
    let (done, drawn) = evaluate(acts, scene, at, plan, layout, pencil)?;
    let mut shown = at.clone();
    if !P::EXACT {
        let mu: N = scale::number(layout.mu);
        for (place, joint) in shown.points.iter_mut().zip(&acts.joints) {
            *place = drawn.marks[joint.index()].map(|q| done.diagram.origin + q.to_vec2() * mu);
        }
        // The angle of a link without two joints follows from its guide.
        for (guide, turn) in scene.guides.iter().zip(&drawn.turns) {
            for l in
                [Some(guide.on), guide.slider].into_iter().flatten().filter(|l| *l != scene.ground)
            {
                if let (Some(pose), Some(turn)) = (at.poses[l.0], turn)
                    && scene.links[l.0].points.len() < 2
                {
                    shown.poses[l.0] = Some(Pose { axis: pose.axis.rotate_by(*turn), ..pose });
                }
            }
        }
    }
    Ok((told(done)?, shown))
}
