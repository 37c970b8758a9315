//! The numbers in the steps of a construction, found without drawing: from differences of positions
//! in long numbers, and from the meaning of each term.

use hodograph::answer::MotionSource;
use hodograph::certified::steps::StepNumber;
use hodograph::construct::{Action, Polygon};
use hodograph::digits::shortest;
use hodograph::effort::truth::Differences;
use hodograph::geom::{Point, Vec2, cross_lines};
use hodograph::mechanism::{ConstraintLine, Level};
use hodograph::number::{Big, Real};
use hodograph::plan::{
    SpecialLine, Term, TermConnection, TermKind, TurningBody, VertexId, VertexPlace,
};
use hodograph::position::{Configuration, Path};
use hodograph::scene::{DiagramKind, DriverKind, LinkId, Scene};
use hodograph::worked::Worked;

/// One number: its polygon, its action, its kind, its value, and the limit below which it counts as
/// zero.
pub struct Told {
    pub level: DiagramKind,
    pub action: usize,
    pub what: StepNumber,
    pub value: Big,
    pub nothing: f64,
}

struct Oracle<'a> {
    scene: &'a Scene,
    w: &'a Worked,
    d: &'a Differences<Big>,
}

/// Smaller lengths on paper (mm) are printed as zero.
const NOTHING_MM: f64 = 1.001e-9;

/// Every number in the steps, in a region of long numbers.
pub fn told(scene: &Scene, w: &Worked, d: &Differences<Big>, pencil_mm: f64) -> Vec<Told> {
    let o = Oracle { scene, w, d };
    let mut out = Vec::new();
    for (action, c) in w.construction.diagram.crossed.iter().enumerate() {
        let special =
            w.plan.special(c.target).expect("only special points are crossed on the diagram");
        let [u, v] = special.lines.each_ref().map(|line| o.line(line).1);
        let crossing =
            crossing(u, v, Big::from_decimal(&shortest(w.construction.diagram.mu)), pencil_mm);
        out.extend(crossing.map(|(what, value, nothing)| Told {
            level: DiagramKind::Plane,
            action,
            what,
            value,
            nothing,
        }));
    }
    for level in DiagramKind::POLYGONS {
        if let Some(p) = w.construction.polygon(level) {
            for action in 0..p.actions.len() {
                out.extend(
                    o.numbers(level.level(), p, action, pencil_mm)
                        .into_iter()
                        .map(|(what, value, nothing)| Told { level, action, what, value, nothing }),
                );
            }
        }
    }
    out
}

impl Oracle<'_> {
    fn numbers(
        &self,
        level: Level,
        p: &Polygon,
        action: usize,
        pencil_mm: f64,
    ) -> Vec<(StepNumber, Big, f64)> {
        let mu = Big::from_decimal(&shortest(p.mu));
        // A trial drawing belongs to no motion.
        let tried = |v: &VertexId| self.w.plan.vertex(*v).trial.is_some();
        let drawn = |i: &usize| p.edges[*i].terms.iter().any(|t| tried(&t.of));
        let in_trial = match &p.actions[action] {
            Action::LayOff(i) | Action::Join(i) => drawn(i),
            Action::Cross { edges, .. } => edges.iter().any(drawn),
            Action::Reach(v) | Action::Copy { target: v, .. } => tried(v),
            _ => false,
        };
        if in_trial {
            return Vec::new();
        }
        let edge = |k, i: usize| {
            let whole = p.edges[i].terms.iter().fold(Vec2::zero(), |s, t| s + self.term(level, t));
            (StepNumber::Length(k), whole.norm() / mu, NOTHING_MM)
        };
        match &p.actions[action] {
            Action::LayOff(i) => vec![edge(0, *i)],
            Action::Cross { edges, .. } => {
                let mut all: Vec<_> = edges.iter().enumerate().map(|(k, i)| edge(k, *i)).collect();
                let [u, w] = [0, 1].map(|k| self.direction(&p.edges[edges[k]].terms[0]));
                all.extend(crossing(u, w, mu, pencil_mm));
                all
            }
            Action::Reach(v)
            | Action::Copy { target: v, .. }
            | Action::Trials { target: v, .. } => {
                vec![(StepNumber::Length(0), self.vector(level, *v).norm() / mu, NOTHING_MM)]
            }
            Action::Rate(r) => {
                let r = &self.w.construction.rates[*r];
                let value = self.turning(level, r.body);
                match r.measured.map(|m| m.line) {
                    Some((of, to)) => {
                        let arm = (self.place(of) - self.place(to)).norm();
                        let length = absolute(value) * arm / mu;
                        let nothing = (Big::from_f64(NOTHING_MM) * mu / arm).approx();
                        vec![
                            (StepNumber::Length(0), length, NOTHING_MM),
                            (StepNumber::Arm, arm, 0.0),
                            (StepNumber::Rate, value, nothing),
                        ]
                    }
                    None => {
                        let rates = self.w.construction.rates.iter().filter(|r| r.on == p.on);
                        vec![(
                            StepNumber::Rate,
                            value,
                            1e-13 * rates.map(|r| r.value.abs()).fold(0.0, f64::max),
                        )]
                    }
                }
            }
            Action::Join(i) => vec![edge(0, *i)],
            Action::Perpendicular { edges, .. } => {
                edges.iter().enumerate().map(|(k, i)| edge(k, *i)).collect()
            }
            Action::Nothing { .. } | Action::Line { .. } | Action::Same { .. } => Vec::new(),
        }
    }

    fn place(&self, v: VertexId) -> Point<Big> {
        match self.w.plan.vertex(v).spot {
            VertexPlace::Point(p) => self.d.now.point(p),
            VertexPlace::Special(k) => {
                let [(p, u), (q, w)] =
                    self.w.plan.specials[k].lines.each_ref().map(|line| self.line(line));
                cross_lines(p, u, q, w).at
            }
        }
    }

    fn line(&self, line: &SpecialLine) -> (Point<Big>, Vec2<Big>) {
        let at = |p| self.d.now.point(p);
        match *line {
            SpecialLine::Through { pin, special } => (at(pin), at(pin) - self.place(special)),
            SpecialLine::Leg(ConstraintLine::Along { near, far }) => (at(near), at(near) - at(far)),
            SpecialLine::Leg(ConstraintLine::Tangent { .. }) => {
                panic!("these mechanisms have no wheels")
            }
            SpecialLine::Leg(ConstraintLine::Normal { pin, guide }) => {
                match self.d.now.guide(guide) {
                    Path::Line { direction, .. } => (at(pin), direction.perp()),
                    Path::Arc { centre, .. } => (at(pin), at(pin) - centre),
                }
            }
        }
    }

    fn vector(&self, level: Level, v: VertexId) -> Vec2<Big> {
        let vertex = self.w.plan.vertex(v);
        match vertex.spot {
            _ if vertex.fixed => Vec2::zero(),
            VertexPlace::Point(p) => {
                self.d.vector(level, p, vertex.on).expect("a drawn point has places")
            }
            VertexPlace::Special(k) => {
                let link = vertex.on.unwrap_or(self.w.plan.specials[k].link);
                let local = self.d.now.poses[link.0].expect("placed").to_local(self.place(v));
                let at = |c: &Configuration<Big>| c.poses[link.0].expect("placed").to_world(local);
                let (before, now, after) = (at(&self.d.before), at(&self.d.now), at(&self.d.after));
                let one = Big::from_f64(1.0);
                match level {
                    Level::Acceleration => {
                        ((after - now) - (now - before)) * (one / (self.d.step * self.d.step))
                    }
                    _ => (after - before) * (one / (self.d.step + self.d.step)),
                }
            }
        }
    }

    fn turning(&self, level: Level, body: TurningBody) -> Big {
        match body {
            TurningBody::Link(l) => self.link_turning(level, l),
            TurningBody::Cylinder(d) => {
                let DriverKind::Cylinder { a, b, .. } = self.scene.drivers[d].kind else {
                    panic!("no cylinder")
                };
                let line = |c: &Configuration<Big>| c.point(b) - c.point(a);
                let start = line(&self.d.now);
                let angle = |c: &Configuration<Big>| start.cross(line(c)).atan2(start.dot(line(c)));
                let (before, after) = (angle(&self.d.before), angle(&self.d.after));
                match level {
                    Level::Acceleration => (after + before) / (self.d.step * self.d.step),
                    _ => (after - before) / (self.d.step + self.d.step),
                }
            }
        }
    }

    fn link_turning(&self, level: Level, l: LinkId) -> Big {
        self.d.turning(level, l).expect("a drawn link has poses")
    }

    fn direction(&self, t: &Term) -> Vec2<Big> {
        match t.by {
            TermConnection::Guide { guide, .. } => match self.d.now.guide(guide) {
                Path::Line { direction, .. } => direction,
                Path::Arc { centre, .. } => (self.place(t.of) - centre).perp(),
            },
            TermConnection::Contact(pair) => {
                self.d.now.normal(self.scene, pair).expect("a drawn contact is placed")
            }
            TermConnection::Turning(_)
            | TermConnection::Cylinder(_)
            | TermConnection::Frame { .. }
            | TermConnection::Apart => (self.place(t.of) - self.place(t.to)).perp(),
        }
    }

    /// A term by its definition.
    fn term(&self, level: Level, t: &Term) -> Vec2<Big> {
        let arm = self.place(t.of) - self.place(t.to);
        let two = Big::from_f64(2.0);
        let between = |level| self.vector(level, t.of) - self.vector(level, t.to);
        let coriolis = |turning: TurningBody, v: Vec2<Big>| {
            v.perp() * (two * self.turning(Level::Velocity, turning))
        };
        // The component of a vector along a line.
        let along = |v: Vec2<Big>, u: Vec2<Big>| u * (v.dot(u) / u.norm2());
        match (t.kind, t.by) {
            (TermKind::Relative, TermConnection::Turning(TurningBody::Cylinder(_))) => {
                along(between(level), arm.perp())
            }
            (TermKind::Relative, _) => between(level),
            (TermKind::Normal, TermConnection::Turning(b)) => {
                let w = self.turning(Level::Velocity, b);
                arm * -(w * w)
            }
            (TermKind::Tangential, TermConnection::Turning(b)) => {
                arm.perp() * self.turning(level, b)
            }
            (TermKind::Extension, _) => {
                // l̇, or l̈ = (d·a + v² − l̇²)/l, along the line.
                let (l2, v) = (arm.norm2(), between(Level::Velocity));
                match level {
                    Level::Velocity => along(v, arm),
                    _ => {
                        arm * ((arm.dot(between(level)) + v.norm2() - v.dot(arm) * v.dot(arm) / l2)
                            / l2)
                    }
                }
            }
            (TermKind::Coriolis, TermConnection::Cylinder(d)) => {
                coriolis(TurningBody::Cylinder(d), along(between(Level::Velocity), arm))
            }
            (TermKind::Coriolis, TermConnection::Guide { guide, .. }) => {
                coriolis(TurningBody::Link(self.scene.guides[guide.0].on), between(Level::Velocity))
            }
            (TermKind::Coriolis, TermConnection::Frame { body: Some(body), .. }) => {
                coriolis(body, between(Level::Velocity))
            }
            (TermKind::Slide, TermConnection::Frame { .. }) if level == Level::Velocity => {
                between(level)
            }
            (TermKind::Slide, TermConnection::Frame { body: Some(body), about: None }) => {
                between(level) - coriolis(body, between(Level::Velocity))
            }
            (TermKind::SlideNormal, TermConnection::Guide { guide, .. }) => {
                self.slide_normal(t, guide, between(Level::Velocity))
            }
            (TermKind::Slide, TermConnection::Guide { .. }) if level == Level::Velocity => {
                between(level)
            }
            // The component along the guide of the relative acceleration less the Coriolis part.
            (TermKind::Slide, TermConnection::Guide { guide, .. }) => {
                let carrier = TurningBody::Link(self.scene.guides[guide.0].on);
                let rest = between(level) - coriolis(carrier, between(Level::Velocity));
                along(rest, self.direction(t))
            }
            (TermKind::Roll, TermConnection::Contact(_)) => between(level),
            other => panic!("no such term: {other:?}"),
        }
    }

    fn slide_normal(&self, t: &Term, guide: hodograph::scene::GuideId, v: Vec2<Big>) -> Vec2<Big> {
        let Path::Arc { centre, radius } = self.d.now.guide(guide) else {
            panic!("a curved part on a straight guide")
        };
        // Only its length is printed: v²/ρ, toward the centre or away from it.
        let inward = centre - self.place(t.of);
        inward * (v.norm2() / (radius * inward.norm()))
    }
}

/// The numbers of two intersecting lines.
fn crossing(u: Vec2<Big>, w: Vec2<Big>, mu: Big, pencil_mm: f64) -> [(StepNumber, Big, f64); 3] {
    let (sine, cosine) = (absolute(u.cross(w)), absolute(u.dot(w)));
    let angle = sine.atan2(cosine) * Big::from_f64(180.0) / Big::pi();
    let moved = Big::from_decimal(&shortest(pencil_mm)) * u.norm() * w.norm() / sine;
    [
        (StepNumber::Angle, angle, 0.0),
        (StepNumber::Moved, moved, 0.0),
        (StepNumber::Off, moved * mu, 0.0),
    ]
}

fn absolute(x: Big) -> Big {
    if x.approx() < 0.0 { -x } else { x }
}
