//! Draws a plan step by step: diagram, velocity polygon, acceleration polygon.

use super::pencil::Pencil;
use super::scale;
use super::{Action, Construction, Diagram, Edge, Mark, Polygon};
use crate::plan::{Between, Body, By, Chain, Plan, Rate, Spot, Step, Term, VertexId};
use hodograph_base::budget::spend;
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::geom::{Point, Vec2, cross_lines};
use hodograph_base::number::Real;
use hodograph_mechanism::mechanism::Mechanism;
use hodograph_mechanism::position::Configuration;
use hodograph_scene::exact::Inputs;
use hodograph_scene::{ByKind, DiagramKind, Scene};

pub(super) struct Board<'a, N, P> {
    pub(super) scene: &'a Scene,
    pub(super) m: &'a Mechanism,
    pub(super) at: &'a Configuration<N>,
    pub(super) plan: &'a Plan,
    pub(super) pencil: &'a mut P,
    pub(super) done: Construction<N>,
    /// The scene's given numbers.
    pub(super) inputs: Inputs<'a, N>,
    /// μ of the mechanism (m/mm).
    pub(super) mu: N,
    /// What a blunt pencil made of joints and guides; nothing for the exact one.
    pub(super) hand: super::hand::Hand<N>,
    /// Size of the mechanism (m).
    extent: f64,
}

/// A line on paper: a point of it, and its direction.
pub(super) type Line<N> = (Point<N>, Vec2<N>);

/// The mark in which a part ends.
pub(super) fn part_mark<N>(p: &Polygon<N>, term: &Term) -> Mark {
    let taken = |m: &Mark| matches!(m, Mark::Part(t) if t.is_same(term) == Some(false));
    if p.edges.iter().any(|e| taken(&e.to.0)) { Mark::Again(*term) } else { Mark::Part(*term) }
}

/// A crossing is called parallel when its sine is no larger than what rounding makes of the two directions: each is a
/// difference of places known to half a unit in the last place of the mechanism's size, divided by its length. Eight
/// such units keep exact dead centres (sine 0 or a few units) on this side and poses 1e-9 rad away on the other.
const PARALLEL_UNITS: f64 = 8.0;

impl<'a, N: Real, P: Pencil<N>> Board<'a, N, P> {
    pub(super) fn new(scene: &'a Scene, m: &'a Mechanism, at: &'a Configuration<N>, plan: &'a Plan, mu: f64, pencil: &'a mut P) -> Self {
        let origin = scene.links[scene.ground.0]
            .points
            .iter()
            .chain(scene.links.iter().flat_map(|l| &l.points))
            .find_map(|p| at.points[p.0])
            .unwrap_or(Point::origin());
        Board {
            scene,
            m,
            at,
            plan,
            pencil,
            inputs: Inputs::of(scene),
            mu: scale::number(mu),
            done: Construction {
                diagram: Diagram { mu, origin, spots: vec![None; plan.vertices.len()], crossed: Vec::new() },
                diagrams: Vec::new(),
                rates: Vec::new(),
                chosen: vec![0; m.groups.len()],
                magnification: ByKind::default(),
            },
            hand: super::hand::Hand::default(),
            extent: at.extent(),
        }
    }

    /// Sets out the diagram: joints, guides, and the special points that the chosen alternatives use.
    pub(super) fn set_out(&mut self) {
        self.draw_joints();
        let plan = self.plan;
        for (i, v) in plan.vertices.iter().enumerate() {
            self.done.diagram.spots[i] = match v.spot {
                Spot::Point(p) => self.joint(p),
                Spot::Special(k) => self.special_point(VertexId(i), &plan.specials[k]),
            };
        }
    }

    pub(super) fn keep(&mut self, polygon: Polygon<N>) {
        self.done.diagrams.push(polygon);
    }

    /// What was drawn, if its numbers can be told.
    pub(super) fn finish(self) -> Result<Construction<N>, Faults> {
        let done = self.done;
        let finite = |p: &Polygon<N>| p.images.iter().flatten().all(|q| q.is_finite()) && p.mu.is_finite();
        if !done.diagrams.iter().all(finite) || !done.rates.iter().all(|r| r.value.is_decided()) {
            return Err(Diagnostic::error(
                "overflow",
                both!("the numbers are too large or too small to be drawn", "数值过大或过小，无法作图"),
            )
            .into());
        }
        Ok(done)
    }

    /// A place of the mechanism in mm of paper.
    pub(super) fn paper(&self, p: Point<N>) -> Point<N> {
        ((p - self.done.diagram.origin) * (N::from_f64(1.0) / self.mu)).to_point()
    }

    fn spot(&self, v: VertexId) -> Point<N> {
        self.done.diagram.spots[v.0].expect("a planned vertex has a place on the diagram")
    }

    /// From `to` to `of` on the diagram, in metres.
    pub(super) fn arm(&self, of: VertexId, to: VertexId) -> Vec2<N> {
        (self.spot(of) - self.spot(to)) * self.mu
    }

    pub(super) fn draw(&mut self, on: DiagramKind, mu: f64) -> Result<Polygon<N>, Faults> {
        let fixed = self.plan.vertices.iter().map(|v| v.fixed.then_some(Point::origin())).collect();
        let mut polygon = Polygon { on, mu, images: fixed, edges: Vec::new(), actions: Vec::new() };
        let plan = self.plan;
        // What waits for an image of a later group: vectors between images, and rates measured on such images.
        let (mut open, mut unread): (Vec<&Between>, Vec<(Body, Rate)>) = (Vec::new(), Vec::new());
        for steps in plan.steps(on) {
            // Given rates serve the group's own points; measured ones come from them.
            for (body, rate) in steps.rates.iter().filter(|(_, r)| !matches!(r, Rate::Measured { .. })) {
                self.turning(&mut polygon, *body, *rate);
            }
            let alternative = steps.drawn(self.done.chosen[steps.group]);
            for step in steps.alternatives.get(alternative).into_iter().flatten() {
                self.step(&mut polygon, step)?;
            }
            open.extend(&steps.between);
            unread.extend(&steps.rates);
            self.read_off(&mut polygon, &mut unread, &mut open)?;
            for step in &steps.further {
                self.step(&mut polygon, step)?;
                // A block on a curved guide is measured from the guide's centre, which is one of the further points.
                self.read_off(&mut polygon, &mut unread, &mut open)?;
            }
        }
        Ok(polygon)
    }

    fn step(&mut self, p: &mut Polygon<N>, step: &Step) -> Result<(), Faults> {
        spend();
        match step {
            Step::Equation { target, chains, .. } => self.equation(p, *target, chains),
            // Where nothing moves there is no triangle to copy.
            Step::Image { target, from: (a, _), .. } if self.stands(p.on) => {
                p.images[target.0] = Some(self.image(p, *a));
                p.actions.push(Action::Reach(*target));
                Ok(())
            }
            Step::Image { target, from: (a, b), .. } => {
                let (ia, ib) = (self.image(p, *a), self.image(p, *b));
                let ratio = self.arm(*target, *a).divide_by(self.arm(*b, *a));
                if !ratio.is_finite() {
                    return Err(self.coincide(*a, *b).into());
                }
                p.images[target.0] = Some(self.pencil.mark(p.on, ia + (ib - ia).rotate_by(ratio)));
                p.actions.push(Action::Copy { target: *target, from: (*a, *b) });
                Ok(())
            }
            Step::Same { target, from, .. } => {
                p.images[target.0] = Some(self.image(p, *from));
                p.actions.push(Action::Same { target: *target, from: *from });
                Ok(())
            }
        }
    }

    /// True for a polygon all of whose vectors vanish because no driver moves.
    pub(super) fn stands(&self, on: DiagramKind) -> bool {
        on == DiagramKind::Velocity && self.plan.rest.is_all()
    }

    pub(super) fn image(&self, p: &Polygon<N>, v: VertexId) -> Point<N> {
        p.images[v.0].expect("the plan finds a vertex before it uses it")
    }

    pub(super) fn mark(&self, v: VertexId) -> Mark {
        if self.plan.vertex(v).fixed { Mark::Pole } else { Mark::Image(v) }
    }

    fn equation(&mut self, p: &mut Polygon<N>, target: VertexId, chains: &[Chain]) -> Result<(), Faults> {
        let mut ends: Vec<(Mark, Point<N>, Option<Line<N>>)> = Vec::new();
        for chain in chains {
            let start = (self.mark(chain.start), self.image(p, chain.start));
            // The last known vector of a chain without unknowns ends in the target itself.
            let leads = chain.unknown.is_empty() && chains.len() == 1;
            let at = self.lay_off(p, start, &chain.known, leads.then_some(target))?;
            let vanishes = |t: &Term| self.plan.vanishes(self.scene, p.on, t);
            let line = match chain.unknown.first() {
                Some(term) if vanishes(term) => {
                    p.actions.push(Action::Nothing { terms: chain.unknown.clone(), at: at.1, target: None });
                    None
                }
                Some(term) => {
                    let u = self.direction(term)?;
                    p.actions.push(Action::Line { terms: chain.unknown.clone(), mark: at.0, through: at.1, direction: u });
                    let apart = self.drawn_length(term);
                    Some((self.pencil.mark(p.on, at.1), self.pencil.ruler(p.on, u, apart)))
                }
                None => None,
            };
            ends.push((at.0, at.1, line));
        }
        match ends[..] {
            [(_, _, Some((a, u))), (_, _, Some((b, w)))] => {
                let c = cross_lines(a, u, b, w);
                let rounding = 1.0 + self.rounding(&chains[0]) + self.rounding(&chains[1]);
                let s = c.sine.approx().abs();
                // Numbers that know their error are undecided where the lines may be parallel.
                let parallel = !N::knows_its_error() && s <= PARALLEL_UNITS * f64::EPSILON * rounding;
                if parallel || !c.at.is_finite() {
                    return Err(self.dead_centre(p.on, target, chains).into());
                }
                // Velocities go with 1/sine; accelerations with the square of velocities through one more crossing.
                self.magnify(DiagramKind::Velocity, rounding / s);
                self.magnify(DiagramKind::Acceleration, rounding * rounding / (s * s * s));
                let found = self.pencil.mark(p.on, c.at);
                p.images[target.0] = Some(found);
                let mut edges = Vec::new();
                for ((mark, from, _), chain) in ends.iter().zip(chains) {
                    p.edges.push(Edge {
                        terms: chain.unknown.clone(),
                        from: (*mark, *from),
                        to: (Mark::Image(target), found),
                        known: false,
                        between: false,
                    });
                    edges.push(p.edges.len() - 1);
                }
                p.actions.push(Action::Cross { target, edges, sine: c.sine });
            }
            // Two chains without a direction: nothing moves, and both end where they start.
            [(_, a, None)] | [(_, a, None), (_, _, None)] => {
                p.images[target.0] = Some(a);
                // The last known vector ends in the target by itself; without one, the start is the target.
                if chains.len() == 2 || chains[0].known.is_empty() {
                    p.actions.push(Action::Reach(target));
                }
            }
            _ => unreachable!("an equation has one chain without, or two with, unknown parts"),
        }
        Ok(())
    }

    /// Lays known terms off one after another; the last ends in the image of `target`, if one is given.
    pub(super) fn lay_off(
        &mut self,
        p: &mut Polygon<N>,
        from: (Mark, Point<N>),
        known: &[Term],
        target: Option<VertexId>,
    ) -> Result<(Mark, Point<N>), Faults> {
        let mut at = from;
        let last_drawn = known.iter().rposition(|t| !self.plan.vanishes(self.scene, p.on, t));
        for (i, term) in known.iter().enumerate() {
            if self.plan.vanishes(self.scene, p.on, term) {
                let reached = target.filter(|_| last_drawn.is_none() && i + 1 == known.len());
                p.actions.push(Action::Nothing { terms: vec![*term], at: at.1, target: reached });
                continue;
            }
            let end = at.1 + self.known_vector(p, term)?.laid_off(p.mu);
            let end = self.pencil.mark(p.on, end);
            let mark = match target {
                Some(target) if Some(i) == last_drawn => Mark::Image(target),
                Some(_) | None => part_mark(p, term),
            };
            p.edges.push(Edge { terms: vec![*term], from: at, to: (mark, end), known: true, between: false });
            p.actions.push(Action::LayOff(p.edges.len() - 1));
            at = (mark, end);
        }
        Ok(at)
    }

    /// Size of the mechanism over the length from which a direction is taken: how rounding of places acts on it.
    fn rounding(&self, chain: &Chain) -> f64 {
        let Some(term) = chain.unknown.first() else { return 0.0 };
        match term.by {
            By::Turning(_) | By::Cylinder(_) => self.extent / self.arm(term.of, term.to).approx().norm(),
            By::Guide { .. } | By::Contact(_) | By::Frame { .. } | By::Apart => 1.0,
        }
    }

    pub(super) fn guide_tangent(&self, term: &Term) -> Vec2<N> {
        let By::Guide { guide, .. } = term.by else { unreachable!("only sliding terms have a tangent") };
        let pin = match self.plan.vertex(term.of).spot {
            Spot::Point(p) => self.at.point(p),
            Spot::Special(_) => Point::origin(),
        };
        self.turned(guide, self.at.guide(guide).tangent_at(pin))
    }

    /// Direction (unit) of an unknown term.
    fn direction(&self, term: &Term) -> Result<Vec2<N>, Faults> {
        let u = match term.by {
            By::Turning(_) | By::Cylinder(_) => self.arm(term.of, term.to).perp().unit(),
            By::Guide { .. } => self.guide_tangent(term).unit(),
            By::Contact(pair) => self.contact_normal(pair).and_then(|n| n.unit()),
            By::Frame { .. } | By::Apart => None,
        };
        u.ok_or_else(|| self.coincide(term.of, term.to).into())
    }

    pub(super) fn coincide(&self, a: VertexId, b: VertexId) -> Diagnostic {
        let (a, b) = (self.name(a), self.name(b));
        Diagnostic::error(
            "coincident-points",
            both!("{a} and {b} coincide in this pose: their line has no direction", "{a} 与 {b} 在该位置重合，连线没有方向"),
        )
        .help(both!("choose another pose, or other lengths", "请改变位置或长度"))
    }

    fn name(&self, v: VertexId) -> String {
        crate::plan::text::vertex_name(self.scene, self.plan, v)
    }

    /// Notes by how much a crossing magnifies rounding on a diagram.
    fn magnify(&mut self, on: DiagramKind, by: f64) {
        let worst = self.done.magnified(on).max(by);
        self.done.magnification.set(on.kind(), Some(worst));
    }

    /// Whether the first point of a sliding term belongs to the carrier of the guide (then signs are reversed).
    pub(super) fn reversed(&self, term: &Term) -> bool {
        let By::Guide { guide, .. } = term.by else { return false };
        let on = self.scene.guides[guide.0].on;
        let v = self.plan.vertex(term.of);
        match (v.on, v.spot) {
            (Some(l), _) => l == on,
            (None, Spot::Point(p)) => self.scene.links[on.0].points.contains(&p),
            (None, Spot::Special(_)) => false,
        }
    }

    fn dead_centre(&self, on: DiagramKind, target: VertexId, chains: &[Chain]) -> Diagnostic {
        let words: Vec<Both> =
            chains.iter().filter_map(|c| c.unknown.first()).map(|t| crate::plan::text::held_by(self.scene, self.plan, t)).collect();
        let at = self.name(target);
        let lie = if chains.iter().flat_map(|c| &c.unknown).all(|t| matches!(t.by, By::Turning(_) | By::Cylinder(_))) {
            both!("lie in line", "共线")
        } else {
            both!("leave the same direction open", "所余方向相同")
        };
        let mut d = Diagnostic::error(
            "dead-centre",
            both!(
                "dead centre: {} {} at {at}, so that its {} is not determined",
                "死点：{}在 {at} 处{}，{}不能确定",
                Both::join(&words, " and ", "与"),
                lie,
                on.vector()
            ),
        )
        .help(both!("choose another pose, or drive another link", "请改变位置或换原动件"));
        if let Spot::Point(p) = self.plan.vertex(target).spot {
            d = d.at(self.scene.points[p.0].span);
        }
        d
    }
}
