//! Writes a plan as acts of ruler and set squares: diagram, velocity polygon, acceleration polygon.
//! It uses no coordinates.

use super::acts::{Acts, BodyRate, GivenNumber};
use super::{Edge, PolygonMark};
use crate::construction::{
    Base, Because, Construction, DiagramId, Direction, Key, Line, LineId, MarkId, Name, Number,
    NumberId, Op, Vector, VectorId,
};
use crate::plan::{
    Between, Plan, PlanStep, Rate, Term, TermChain, TermConnection, TermKind, TurningBody,
    VertexId, VertexPlace,
};
use hodograph_base::budget::spend;
use hodograph_mechanism::mechanism::Mechanism;
use hodograph_scene::{DiagramKind, GuideId, PointId, Scene};

pub(super) struct ActWriter<'a> {
    pub(super) scene: &'a Scene,
    pub(super) m: &'a Mechanism,
    pub(super) plan: &'a Plan,
    /// The chosen alternative of the steps, for each group.
    chosen: &'a [usize],
    pub(super) done: Acts,
}

pub(super) fn place_key(p: PointId) -> Key {
    Key::of(p.0)
}

pub(super) fn path_key(g: GuideId) -> Key {
    Key::of(g.0)
}

pub(super) fn vertex_key(v: VertexId) -> Key {
    Key::of(v.0)
}

impl<'a> ActWriter<'a> {
    pub(super) fn new(
        scene: &'a Scene,
        m: &'a Mechanism,
        plan: &'a Plan,
        chosen: &'a [usize],
    ) -> Self {
        let construction = Construction::with_room(scene.points.len() + plan.vertices.len());
        ActWriter { scene, m, plan, chosen, done: Acts { construction, ..Acts::default() } }
    }

    /// Draws joints and guides on the diagram.
    pub(super) fn set_out_joints(&mut self) -> DiagramId {
        let on = self.done.begin(DiagramKind::Plane, vec![None; self.plan.vertices.len()]);
        for p in 0..self.scene.points.len() {
            let joint = self.mark(on, Name::Point(Key::of(p)));
            self.done.joints.push(joint);
        }
        let guides = (0..self.scene.guides.len()).map(|g| Op::Path(Key::of(g)));
        let joints = self.done.joints.iter().map(|joint| Op::Set(*joint));
        self.done.construction.step(on, None, joints.chain(guides));
        on
    }

    /// Draws the diagram: joints, guides, and the special points.
    pub(super) fn set_out(&mut self) {
        let on = self.set_out_joints();
        let plan = self.plan;
        for (i, v) in plan.vertices.iter().enumerate() {
            self.done.images[on.index()][i] = match v.spot {
                VertexPlace::Point(p) => Some(self.joint(p)),
                VertexPlace::Special(k) => {
                    let placed = plan.vertices[..i].iter().position(|own| own.spot == v.spot);
                    match placed {
                        Some(k) => self.done.images[on.index()][k],
                        None => self.special_point(on, VertexId(i), &plan.specials[k]),
                    }
                }
            };
        }
    }

    /// Draws a polygon.
    pub(super) fn draw(&mut self, kind: DiagramKind) {
        let on = self.done.begin(kind, vec![None; self.plan.vertices.len()]);
        let pole = self.mark(on, Name::Pole);
        for (image, vertex) in self.done.images[on.index()].iter_mut().zip(&self.plan.vertices) {
            *image = vertex.fixed.then_some(pole);
        }
        self.act(on, [Op::Set(pole)]);
        let plan = self.plan;
        // Vectors between images, and rates measured on such images, wait for the images of later
        // groups.
        let (mut open, mut unread): (Vec<&Between>, Vec<(TurningBody, Rate)>) =
            (Vec::new(), Vec::new());
        for steps in plan.steps(kind) {
            // Given rates serve the points of the group; measured rates follow from them.
            for (body, rate) in
                steps.rates.iter().filter(|(_, r)| !matches!(r, Rate::Measured { .. }))
            {
                self.turning(on, *body, *rate);
            }
            let alternative = steps.drawn(self.chosen[steps.group]);
            for step in steps.alternatives.get(alternative).into_iter().flatten() {
                self.step(on, step);
            }
            open.extend(&steps.between);
            unread.extend(&steps.rates);
            self.read_off(on, &mut unread, &mut open);
            for step in &steps.further {
                self.step(on, step);
                // A block on a curved guide is measured from the guide's centre, which is one of
                // the further points.
                self.read_off(on, &mut unread, &mut open);
            }
        }
    }

    pub(super) fn act(&mut self, on: DiagramId, ops: impl IntoIterator<Item = Op>) {
        self.done.construction.step(on, None, ops);
    }

    pub(super) fn act_of(
        &mut self,
        on: DiagramId,
        (of, to): (VertexId, VertexId),
        ops: impl IntoIterator<Item = Op>,
    ) {
        self.done.construction.step(on, Some([of, to].map(vertex_key)), ops);
    }

    pub(super) fn mark(&mut self, on: DiagramId, name: Name) -> MarkId {
        self.done.construction.mark(on, name)
    }

    pub(super) fn number(&mut self, number: Number) -> NumberId {
        self.done.construction.number(number)
    }

    pub(super) fn given(&mut self, given: GivenNumber) -> NumberId {
        let key = self.done.given(given);
        self.number(Number::Given(key))
    }

    pub(super) fn kind(&self, on: DiagramId) -> DiagramKind {
        self.done.construction.diagrams[on.index()]
    }

    /// Returns the mark of a joint on the diagram.
    pub(super) fn joint(&self, p: PointId) -> MarkId {
        self.done.joints[p.0]
    }

    /// Returns the mark of a vertex on the diagram.
    pub(super) fn spot(&self, v: VertexId) -> MarkId {
        self.done.images[0][v.0].expect("a planned vertex has a place on the diagram")
    }

    /// Returns the arm from `to` to `of` on the diagram, in metres.
    pub(super) fn arm(&self, of: VertexId, to: VertexId) -> Base {
        Base::Arm { from: self.spot(to), to: self.spot(of), known: false }
    }

    /// Returns the arm about which a body turns: its direction from the diagram, and its length
    /// from the body if both ends are joints of it.
    pub(super) fn arm_of(&self, body: TurningBody, of: VertexId, to: VertexId) -> Base {
        Base::Arm { from: self.spot(to), to: self.spot(of), known: self.knows_length(body, of, to) }
    }

    fn knows_length(&self, body: TurningBody, of: VertexId, to: VertexId) -> bool {
        let (VertexPlace::Point(p), VertexPlace::Point(q)) =
            (self.plan.vertex(of).spot, self.plan.vertex(to).spot)
        else {
            return false;
        };
        match body {
            TurningBody::Link(l) => [p, q].iter().all(|x| self.scene.links[l.0].points.contains(x)),
            TurningBody::Cylinder(d) => self.scene.drivers[d]
                .kind
                .ends()
                .is_some_and(|[a, b]| (a, b) == (p, q) || (b, a) == (p, q)),
        }
    }

    /// True for a polygon in which all vectors vanish because no driver moves.
    pub(super) fn stands(&self, on: DiagramId) -> bool {
        self.kind(on) == DiagramKind::Velocity && self.plan.rest.is_all()
    }

    pub(super) fn vanishes(&self, on: DiagramId, term: &Term) -> bool {
        self.plan.vanishes(self.scene, self.kind(on), term)
    }

    pub(super) fn image(&self, on: DiagramId, v: VertexId) -> MarkId {
        self.done.image(on, v).expect("the plan finds a vertex before it uses it")
    }

    /// Adds a mark: the image of a vertex.
    fn found(&mut self, on: DiagramId, v: VertexId) -> MarkId {
        let mark = self.mark(on, Name::Image(vertex_key(v)));
        self.done.images[on.index()][v.0] = Some(mark);
        mark
    }

    /// Adds the mark at the end of a part.
    pub(super) fn part(&mut self, on: DiagramId, term: &Term) -> MarkId {
        let taken = |e: &Edge<MarkId>| matches!(e.to.0, PolygonMark::Part(t) if t.is_same(term) == Some(false));
        let taken = self.done.edges[on.index()].iter().any(taken);
        let key = self.done.term(*term);
        self.mark(on, if taken { Name::Again(key) } else { Name::End(key) })
    }

    pub(super) fn vector(
        &mut self,
        terms: &[Term],
        from: MarkId,
        to: MarkId,
        known: bool,
        between: bool,
    ) -> VectorId {
        let [start, end] = [from, to].map(|id| (self.done.mark(id), id));
        let on = self.done.construction.marks[to.index()].on;
        self.done.edges[on.index()].push(Edge {
            terms: terms.to_vec(),
            from: start,
            to: end,
            known,
            between,
        });
        let terms = terms.iter().map(|t| self.done.term(*t)).collect();
        self.done.construction.vector(Vector { terms, from, to })
    }

    fn step(&mut self, on: DiagramId, step: &PlanStep) {
        spend();
        match step {
            PlanStep::Equation { target, chains, .. } => self.equation(on, *target, chains),
            // If nothing moves there is no triangle to copy.
            PlanStep::Image { target, from: (a, _), .. } if self.stands(on) => {
                let mark = self.image(on, *a);
                self.falls_on(on, *target, mark, Because::Reached, None);
            }
            PlanStep::Image { target, from: (a, b), .. } => {
                let of = [*a, *b, *target].map(|v| self.spot(v));
                let onto = [*a, *b].map(|v| self.image(on, v));
                let to = self.found(on, *target);
                self.act_of(on, (*a, *b), [Op::Image { of, onto, to }]);
            }
            PlanStep::Trials { target, images: [e, _], .. } if self.stands(on) => {
                let mark = self.image(on, *e);
                self.falls_on(on, *target, mark, Because::Reached, None);
            }
            PlanStep::Trials { target, images, mates } => {
                let [a, b] = [images, mates].map(|pair| {
                    let [from, to] = pair.map(|v| self.image(on, v));
                    let along = Direction::of(Base::Marks(from, to));
                    self.done.construction.line(Line {
                        on,
                        through: from,
                        along,
                        moved: false,
                        carries: Vec::new(),
                    })
                });
                let to = self.found(on, *target);
                self.act(on, [Op::Rule(a), Op::Rule(b), Op::Meet { lines: [a, b], to }]);
            }
            PlanStep::Same { target, from, .. } => {
                let mark = self.image(on, *from);
                self.falls_on(on, *target, mark, Because::Translates, Some((*from, *target)));
            }
        }
    }

    fn falls_on(
        &mut self,
        on: DiagramId,
        target: VertexId,
        mark: MarkId,
        because: Because,
        ends: Option<(VertexId, VertexId)>,
    ) {
        let to = self.found(on, target);
        let ends = ends.map(|(a, b)| [a, b].map(vertex_key));
        self.done.construction.step(on, ends, [Op::Same { mark, to, because }]);
    }

    fn equation(&mut self, on: DiagramId, target: VertexId, chains: &[TermChain]) {
        let mut lines: Vec<(MarkId, LineId, &TermChain)> = Vec::new();
        let mut last = None;
        for chain in chains {
            let start = self.image(on, chain.start);
            // The last known vector of a chain without unknowns ends in the target itself.
            let leads = chain.unknown.is_empty() && chains.len() == 1;
            let at = self.lay_off(on, start, &chain.known, leads.then_some(target), false);
            last = last.or(Some(at));
            match chain.unknown.first() {
                Some(term) if self.vanishes(on, term) => self.omit(on, &chain.unknown, at, None),
                Some(term) => {
                    let along = self.direction(term).unit();
                    let carries = chain.unknown.iter().map(|t| self.done.term(*t)).collect();
                    let line = self.done.construction.line(Line {
                        on,
                        through: at,
                        along,
                        moved: true,
                        carries,
                    });
                    self.act_of(on, (term.of, term.to), [Op::Rule(line)]);
                    lines.push((at, line, chain));
                }
                None => {}
            }
        }
        match lines[..] {
            [(from_a, a, one), (from_b, b, other)] => {
                let to = self.found(on, target);
                let vectors = [(from_a, one), (from_b, other)]
                    .map(|(from, chain)| self.vector(&chain.unknown, from, to, false, false));
                let [u, w] = vectors.map(Op::Show);
                self.act(on, [Op::Meet { lines: [a, b], to }, u, w]);
            }
            // Without an unknown direction nothing moves, and all chains end where they start.
            [] => {
                let at = last.expect("an equation has a chain");
                // The last known vector ends in the target; if there is none, the start is the
                // target.
                if chains.len() == 2 || chains[0].known.is_empty() {
                    self.falls_on(on, target, at, Because::Reached, None);
                }
            }
            _ => unreachable!("an equation has one chain without, or two with, unknown parts"),
        }
    }

    /// Records that terms along one line are 0.
    pub(super) fn omit(
        &mut self,
        on: DiagramId,
        terms: &[Term],
        at: MarkId,
        target: Option<VertexId>,
    ) {
        let terms = terms.iter().map(|t| self.done.term(*t)).collect();
        let to = target.map(|v| self.found(on, v));
        self.act(on, [Op::Omit { terms, at, to }]);
    }

    /// Lays off known terms one after another; the last ends in the image of `target`, if one is
    /// given.
    pub(super) fn lay_off(
        &mut self,
        on: DiagramId,
        from: MarkId,
        known: &[Term],
        target: Option<VertexId>,
        between: bool,
    ) -> MarkId {
        let mut at = from;
        let last_drawn = known.iter().rposition(|t| !self.vanishes(on, t));
        for (i, term) in known.iter().enumerate() {
            if self.vanishes(on, term) {
                let reached = target.filter(|_| last_drawn.is_none() && i + 1 == known.len());
                self.omit(on, &[*term], at, reached);
                continue;
            }
            let (mut ops, along, times) = self.known_vector(on, term);
            let to = match target {
                Some(target) if Some(i) == last_drawn => self.found(on, target),
                Some(_) | None => self.part(on, term),
            };
            let vector = self.vector(&[*term], at, to, true, between);
            ops.push(Op::Lay { vector, along, times });
            self.act_of(on, (term.of, term.to), ops);
            at = to;
        }
        at
    }

    /// Returns the direction of sliding along a guide, at the sliding pin.
    pub(super) fn guide_tangent(&self, guide: GuideId, of: VertexId) -> Base {
        let pin = match self.plan.vertex(of).spot {
            VertexPlace::Point(p) => Some(place_key(p)),
            VertexPlace::Special(_) => None,
        };
        Base::Tangent(path_key(guide), pin)
    }

    /// Returns the direction of an unknown term.
    fn direction(&self, term: &Term) -> Direction {
        match term.by {
            TermConnection::Turning(_) if term.kind == TermKind::Gap => {
                Direction::of(self.arm(term.of, term.to))
            }
            TermConnection::Turning(_) | TermConnection::Cylinder(_) => {
                Direction::across(self.arm(term.of, term.to))
            }
            TermConnection::Guide { guide, .. } => {
                Direction::of(self.guide_tangent(guide, term.of))
            }
            TermConnection::Contact(pair) => self.contact_normal(pair),
            TermConnection::Frame { .. } | TermConnection::Apart => {
                unreachable!("no equation has an unknown term that no pair holds")
            }
        }
    }

    /// True if the first point of a sliding term belongs to the carrier of the guide: signs are
    /// then reversed.
    pub(super) fn reversed(&self, term: &Term) -> bool {
        let TermConnection::Guide { guide, .. } = term.by else { return false };
        let on = self.scene.guides[guide.0].on;
        let v = self.plan.vertex(term.of);
        match (v.on, v.spot) {
            (Some(l), _) => l == on,
            (None, VertexPlace::Point(p)) => self.scene.links[on.0].points.contains(&p),
            (None, VertexPlace::Special(_)) => false,
        }
    }

    /// Records the angular quantity of a body.
    pub(super) fn turns(&mut self, turning: BodyRate) {
        self.done.turnings.push(turning);
    }
}
