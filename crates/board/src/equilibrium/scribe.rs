//! Writes the construction: the forces on each link, and the acts of polygons and moments.

use super::joints::{Hinge, joints, reference};
use super::{
    About, Answers, ForceEdge, ForceTerm, GroupForces, MomentResult, Moments, Party,
    ReactionComponent, Undrawn,
};
use crate::construction::{
    Base, Construction, DiagramId, Direction, Key, Line, LineId, MarkId, Name, Number, NumberId,
    Op, Vector, VectorId,
};
use hodograph_base::diag::both;
use hodograph_base::diagram::DiagramKind;
use hodograph_mechanism::force::Load;
use hodograph_mechanism::mechanism::Mechanism;
use hodograph_mechanism::position::Configuration;
use hodograph_scene::quantity::ROUNDING;
use hodograph_scene::{GuideId, LinkId, PointId, Scene};

/// A construction with the meaning of its numbers.
pub(super) struct ForceConstruction {
    pub construction: Construction,
    pub groups: Vec<GroupForces>,
    pub undrawn: Vec<Undrawn>,
    pub answers: Answers,
    pub places: Vec<Option<MarkId>>,
}

/// A load or reaction on a link: a force at a point, a couple, or both.
#[derive(Clone, Copy)]
pub(super) struct ActingForce {
    pub term: ForceTerm,
    pub force: Option<(Base, PointId)>,
    pub couple: Option<NumberId>,
}

/// A force on a pin, from a link in equilibrium or from the cylinder that moves one.
#[derive(Clone, Copy)]
pub(super) struct OnPin {
    pub of: Party,
    pub force: NumberId,
}

pub(super) struct Scribe<'a> {
    pub scene: &'a Scene,
    pub m: &'a Mechanism,
    pub c: Construction,
    pub places: Vec<Option<MarkId>>,
    pub acting: Vec<Vec<ActingForce>>,
    pub at_pin: Vec<Vec<OnPin>>,
    pub answers: Answers,
    groups: Vec<GroupForces>,
    pub one: NumberId,
    pub plane: DiagramId,
    /// The key of the balancing force's direction among the givens; the lines of action of the
    /// rolling pairs follow it.
    pub balance: Key,
    /// The number of crossings of lines of action on the mechanism.
    pub crossings: usize,
    /// The largest load (N); a couple counts as its force at the size of the mechanism.
    pub largest: f64,
}

/// Writes the forces of all groups.
pub(super) fn written(
    scene: &Scene,
    m: &Mechanism,
    at: &Configuration,
    loads: &[Load],
) -> ForceConstruction {
    let mut c = Construction::default();
    let plane = c.begin(DiagramKind::Plane);
    let mark = |p: usize, c: &mut Construction| {
        at.points[p].map(|_| c.mark(plane, Name::Point(Key::of(p))))
    };
    let places: Vec<Option<MarkId>> = (0..scene.points.len()).map(|p| mark(p, &mut c)).collect();
    c.step(plane, None, places.iter().flatten().map(|mark| Op::Set(*mark)));
    let one = c.number(Number::Plain(1));
    let mut acting: Vec<Vec<ActingForce>> = vec![Vec::new(); scene.links.len()];
    let largest = loads.iter().map(|l| l.wrench.force.norm()).fold(0.0, f64::max);
    let couples = loads.iter().map(|l| l.wrench.couple.abs()).fold(0.0, f64::max);
    for (k, load) in loads.iter().enumerate() {
        // A load of zero is left out.
        let force = load
            .at
            .filter(|_| load.wrench.force.norm() > ROUNDING * largest)
            .map(|p| (Base::Given(Key::of(k)), p));
        let turns = load.wrench.couple.abs() > ROUNDING * couples.max(largest * at.extent());
        let couple = turns.then(|| c.number(Number::Given(Key::of(k))));
        if force.is_some() || couple.is_some() {
            acting[load.link.0].push(ActingForce { term: ForceTerm::Load(k), force, couple });
        }
    }
    let answers = Answers::default();
    let at_pin = vec![Vec::new(); scene.points.len()];
    let balance = Key::of(loads.len());
    let largest = largest.max(couples / at.extent());
    let mut scribe = Scribe {
        scene,
        m,
        c,
        places,
        acting,
        at_pin,
        answers,
        groups: Vec::new(),
        one,
        plane,
        balance,
        crossings: 0,
        largest,
    };
    // Links that no question needs have no loads and press on nothing.
    let mut open: Vec<bool> =
        (0..scene.links.len()).map(|l| at.poses[l].is_some() || l == scene.ground.0).collect();
    let mut broken = vec![false; scene.links.len()];
    let mut undrawn = Vec::new();
    for group in m.assur(scene).iter().rev() {
        let rod = |l: &LinkId| scene.drivers.iter().any(|d| d.kind.parts().contains(l));
        let (rods, links): (Vec<LinkId>, Vec<LinkId>) =
            group.links.iter().copied().filter(|l| at.poses[l.0].is_some()).partition(rod);
        if links.is_empty() {
            continue;
        }
        let result = if links.iter().any(|l| broken[l.0]) {
            Err(both!("it carries a group that is not drawn"))
        } else if rods.iter().any(|l| !scribe.acting[l.0].is_empty()) {
            Err(both!("the cylinder that moves it has loads of its own"))
        } else {
            rods.iter().for_each(|l| open[l.0] = false);
            joints(scene, m, at, &links, &open).and_then(|joints| scribe.group(&links, &joints, at))
        };
        links.iter().chain(&rods).for_each(|l| open[l.0] = false);
        if let Err(why) = result {
            for l in (0..scene.links.len()).map(LinkId).filter(|l| open[l.0] && *l != scene.ground)
            {
                broken[l.0] |= links.iter().chain(&rods).any(|own| touches(scene, *own, l));
            }
            undrawn.push(Undrawn { links, why });
        }
    }
    let Scribe { c: construction, groups, answers, places, .. } = scribe;
    ForceConstruction { construction, groups, undrawn, answers, places }
}

/// True if two links press on each other at any joint.
fn touches(scene: &Scene, a: LinkId, b: LinkId) -> bool {
    let pins = scene.links[a.0].points.iter().any(|p| scene.links[b.0].points.contains(p));
    let on = |l: LinkId, g: &hodograph_scene::Guide| {
        g.on == l
            || g.slider == Some(l)
            || g.pin.is_some_and(|p| scene.links[l.0].points.contains(&p))
    };
    let guides = scene.guides.iter().any(|g| on(a, g) && on(b, g));
    // A pin on no link presses on the slots in which it runs.
    let slot = |l: LinkId, p: PointId| scene.guides.iter().any(|g| g.on == l && g.pin == Some(p));
    let between_slots = (0..scene.points.len()).map(PointId).any(|p| slot(a, p) && slot(b, p));
    let rods = scene.drivers.iter().filter_map(|d| d.kind.ends()).any(|ends| {
        let carries = |l: LinkId| ends.iter().any(|p| scene.links[l.0].points.contains(p));
        carries(a) && carries(b)
    });
    let turned = scene.drivers.iter().any(|d| {
        d.kind
            .turned()
            .is_some_and(|(l, against)| [l, against].contains(&a) && [l, against].contains(&b))
    });
    pins || guides
        || between_slots
        || rods
        || turned
        || scene.rolling.iter().any(|r| r.links.contains(&a) && r.links.contains(&b))
}

/// A polygon under construction.
pub(super) struct Polygon {
    pub diagram: DiagramId,
    pub last: MarkId,
    /// The vertices in the order of laying off.
    pub vertices: Vec<MarkId>,
    pub sides: Vec<ForceEdge>,
    pub diagonals: Vec<ForceEdge>,
    pub moments: Vec<Moments>,
    pub drivers: Vec<(usize, NumberId)>,
    pub ops: Vec<Op>,
}

impl Scribe<'_> {
    pub fn mark(&self, p: PointId) -> MarkId {
        self.places[p.0].expect("a joint of a placed group is placed")
    }

    /// Returns the reference point of a guide's force.
    pub fn reference(&self, guide: GuideId) -> Option<PointId> {
        reference(self.scene, guide, |p| self.places[p.0].is_some())
    }

    /// Begins a polygon with its first vertex.
    pub fn polygon(&mut self) -> Polygon {
        let diagram = self.c.begin(DiagramKind::Force);
        let first = self.c.mark(diagram, Name::Vertex(0));
        Polygon {
            diagram,
            last: first,
            vertices: vec![first],
            sides: Vec::new(),
            diagonals: Vec::new(),
            moments: Vec::new(),
            drivers: Vec::new(),
            ops: vec![Op::Set(first)],
        }
    }

    fn vertex(&mut self, p: &mut Polygon) -> MarkId {
        let number = u32::try_from(p.vertices.len()).unwrap_or(u32::MAX);
        let mark = self.c.mark(p.diagram, Name::Vertex(number));
        p.vertices.push(mark);
        mark
    }

    /// Lays off a known force from the last vertex.
    fn lay(&mut self, p: &mut Polygon, (term, at): (ForceTerm, PointId), force: Base) {
        self.laid(p, (term, at), Direction::of(force), self.one);
    }

    /// Lays off a part of a force: its direction, a unit vector, times its magnitude.
    pub fn laid(
        &mut self,
        p: &mut Polygon,
        (term, at): (ForceTerm, PointId),
        along: Direction,
        times: NumberId,
    ) {
        let to = self.vertex(p);
        let vector = self.c.vector(Vector { terms: Vec::new(), from: p.last, to });
        p.ops.push(Op::Lay { vector, along, times });
        p.sides.push(ForceEdge { term, at, vector, known: true });
        p.last = to;
    }

    /// Lays off all forces on a link.
    pub fn lay_all(&mut self, p: &mut Polygon, acting: &[ActingForce]) {
        for a in acting {
            if let Some((force, at)) = a.force {
                self.lay(p, (a.term, at), force);
            }
        }
    }

    /// Draws a line through a vertex.
    pub fn line(&mut self, p: &mut Polygon, through: MarkId, along: Direction) -> LineId {
        let line =
            self.c.line(Line { on: p.diagram, through, along, moved: false, carries: Vec::new() });
        p.ops.push(Op::Rule(line));
        line
    }

    /// Adds a vertex: the crossing of two lines.
    pub fn meet(&mut self, p: &mut Polygon, lines: [LineId; 2]) -> MarkId {
        let to = self.vertex(p);
        p.ops.push(Op::Meet { lines, to });
        to
    }

    /// Draws a force between two vertices.
    pub fn show(&mut self, p: &mut Polygon, from: MarkId, to: MarkId) -> VectorId {
        let vector = self.c.vector(Vector { terms: Vec::new(), from, to });
        p.ops.push(Op::Show(vector));
        vector
    }

    /// Adds an unknown side of the polygon, at its place in the equation: first or last.
    pub fn side(
        &mut self,
        p: &mut Polygon,
        (term, at): (ForceTerm, PointId),
        [from, to]: [MarkId; 2],
        first: bool,
    ) {
        let vector = self.show(p, from, to);
        let side = ForceEdge { term, at, vector, known: false };
        if first {
            p.sides.insert(0, side);
        } else {
            p.sides.push(side);
        }
    }

    /// Adds a reaction that is a diagonal.
    pub fn diagonal(
        &mut self,
        p: &mut Polygon,
        (term, at): (ForceTerm, PointId),
        [from, to]: [MarkId; 2],
    ) {
        let vector = self.show(p, from, to);
        p.diagonals.push(ForceEdge { term, at, vector, known: false });
    }

    /// Measures a vector of a polygon.
    pub fn measured(&mut self, p: &mut Polygon, from: MarkId, to: MarkId) -> NumberId {
        let id = self.c.number(Number::Vector(from, to));
        p.ops.push(Op::Number(id));
        id
    }

    /// Measures or calculates a number.
    pub fn number(&mut self, ops: &mut Vec<Op>, number: Number) -> NumberId {
        let id = self.c.number(number);
        ops.push(Op::Number(id));
        id
    }

    /// Returns the moments of the forces on links about a point.
    pub fn moments(
        &mut self,
        ops: &mut Vec<Op>,
        links: &[LinkId],
        acting: &[ActingForce],
        about: About,
        gives: MomentResult,
    ) -> Moments {
        let mut out = Moments {
            links: links.to_vec(),
            about,
            of: Vec::new(),
            couples: Vec::new(),
            gives,
            value: self.one,
        };
        for a in acting {
            if let Some((force, at)) = a.force.filter(|(_, at)| About::Point(*at) != about) {
                let centre = match about {
                    About::Point(p) => self.mark(p),
                    About::Crossing { at, .. } => at,
                };
                let number = Number::Moment { force, at: self.mark(at), about: centre };
                let number = self.number(ops, number);
                out.of.push((a.term, at, number));
            }
            out.couples.extend(a.couple.map(|couple| (a.term, couple)));
        }
        out
    }

    /// Returns the sum of moments, with the sign reversed; zero if there are none.
    pub fn balancing(&mut self, ops: &mut Vec<Op>, moments: &Moments) -> NumberId {
        let all: Vec<NumberId> =
            moments.of.iter().map(|m| m.2).chain(moments.couples.iter().map(|c| c.1)).collect();
        let sum = all
            .into_iter()
            .reduce(|a, b| self.c.number(Number::Sum(a, b)))
            .unwrap_or_else(|| self.c.number(Number::Plain(0)));
        self.number(ops, Number::Negative(sum))
    }

    /// Returns the magnitude of a force square to a bar, at its end, that balances moments about
    /// its beginning; `None` if there are no moments.
    pub fn across(
        &mut self,
        ops: &mut Vec<Op>,
        found: &mut Vec<Moments>,
        mut of: Moments,
        bar: Base,
    ) -> Option<NumberId> {
        if of.of.is_empty() && of.couples.is_empty() {
            return None;
        }
        let turning = self.balancing(ops, &of);
        let length = self.c.number(Number::Length(bar));
        of.value = self.number(ops, Number::Quotient(turning, length));
        let value = of.value;
        found.push(of);
        Some(value)
    }

    /// Returns the forces that links in equilibrium put on a pin, as loads of one link.
    pub fn pin_loads(&mut self, at: PointId, on: LinkId) -> Vec<ActingForce> {
        let of = |load: &OnPin| ActingForce {
            term: ForceTerm::Reaction { of: load.of, on, part: ReactionComponent::Whole },
            force: Some((Base::Measured(load.force), at)),
            couple: None,
        };
        self.at_pin[at.0].iter().map(of).collect()
    }

    /// Returns all forces on a link: its loads, and the forces on its pins other than those at
    /// which it is held.
    pub fn all_on(&mut self, link: LinkId, held: &[Hinge]) -> Vec<ActingForce> {
        let mut acting = self.acting[link.0].clone();
        for p in self.scene.links[link.0].points.clone() {
            if !held.iter().any(|hinge| hinge.pin() == Some(p)) {
                acting.extend(self.pin_loads(p, link));
            }
        }
        acting
    }

    /// Adds acts of the plane before the polygon as a separate step.
    pub fn on_plane(&mut self, ops: Vec<Op>) {
        if !ops.is_empty() {
            self.c.step(self.plane, None, ops);
        }
    }

    /// Ends a polygon.
    pub fn finish(&mut self, p: Polygon, links: &[LinkId], kind: &'static str) {
        let Polygon { diagram, vertices, sides, diagonals, moments, drivers, ops, .. } = p;
        self.c.step(diagram, None, ops);
        self.groups.push(GroupForces {
            links: links.to_vec(),
            kind,
            diagram,
            vertices,
            sides,
            diagonals,
            moments,
            drivers,
        });
    }
}

/// Returns a unit vector square to a vector of the plane.
pub(super) fn square_to(base: Base) -> Direction {
    Direction::across(base).unit()
}
