//! Properties of solved random mechanisms.

use crate::emit::{self, Ask, Pose, Style};
use crate::kept::settled;
use crate::mech::{self, Mech};
pub use crate::rng::seeds;
use crate::wide::every;
use hodograph::answer::{AnswerValue, MotionSource};
use hodograph::construct::Edge;
use hodograph::diag::Faults;
use hodograph::geom::{Point, Vec2};
use hodograph::mechanism::{Level, Mechanism};
use hodograph::plan::{
    Plan, PlanStep, Term, TermConnection, TermKind, TurningBody, Vertex, VertexId, VertexPlace,
};
use hodograph::position::{Configuration, Path, newton};
use hodograph::scene::{self, DiagramKind, DriverKind, PointId, Scene};
use hodograph::worked::{Scope, Worked, work};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// A mechanism read from text and solved.
pub struct Case {
    pub seed: u64,
    pub text: String,
    pub scene: Scene,
    pub worked: Worked,
}

impl Case {
    /// Panics with everything that is needed to see the error.
    fn fail(&self, what: impl std::fmt::Display) -> ! {
        panic!("seed {}: {what}\n{}", self.seed, self.text)
    }

    fn results(&self) -> impl Iterator<Item = (&str, AnswerValue, AnswerValue)> {
        self.worked.results.iter().map(|o| {
            let text = self.scene.find[o.find].text.as_str();
            match &o.drawn {
                Some(d) => (text, d.value, o.computed),
                None => self.fail(format!("{text} was not drawn")),
            }
        })
    }

    fn largest(&self, level: Level) -> f64 {
        self.worked.construction.polygon(DiagramKind::of(level)).map_or(0.0, |p| p.largest())
    }

    /// The size by which a level's vectors are judged: if all vanish, that of the driver's motion.
    fn scale(&self, level: Level) -> f64 {
        let (v, extent) =
            (self.largest(Level::Velocity), self.worked.configuration.extent().max(1e-300));
        if level == Level::Acceleration { self.largest(level).max(v * v / extent) } else { v }
    }

    fn well_conditioned(&self) -> bool {
        self.worked.solution.condition < WELL
    }
}

/// Seeds with a worse conditioned chain of groups are judged only by the agreement's own bound.
const WELL: f64 = 1e4;

/// Reads and solves a text; a panic names the seed and shows the scene.
pub fn worked(seed: u64, text: &str) -> Result<(Scene, Worked), Faults> {
    let run = || {
        let scene = scene::read(text)?.value;
        let worked = work(&scene, Scope::Questions)?.value;
        Ok((scene, worked))
    };
    catch_unwind(AssertUnwindSafe(run))
        .unwrap_or_else(|_| panic!("seed {seed}: a panic on\n{text}"))
}

pub fn style(pose: Pose, ask: Ask, seed: u64) -> Style {
    Style { pose, ask, choices: seed, renamed: false }
}

/// The mechanism of a seed, of 2 to 20 groups, most of them small.
pub fn mechanism(seed: u64) -> Option<Mech> {
    let groups =
        2 + (seed % 7) as usize + if seed.is_multiple_of(11) { (seed % 13) as usize } else { 0 };
    mech::grow(seed, seed, groups.min(20))
}

pub fn solve(seed: u64, m: &Mech, style: &Style) -> Case {
    let text = emit::scene(m, style);
    match worked(seed, &text) {
        Ok((scene, worked)) => Case { seed, text, scene, worked },
        Err(f) => panic!("seed {seed} ({style:?}, groups {:?}): {f}\n{text}", m.groups),
    }
}

fn each(own: u64, pose: Pose, ask: Ask, mut check: impl FnMut(&Mech, &Case)) {
    for seed in seeds(own) {
        let Some(m) = mechanism(seed) else { continue };
        let pose = if m.coordinates_only { Pose::Coordinates } else { pose };
        let case = solve(seed, &m, &style(pose, ask, seed));
        check(&m, &case);
    }
}

fn difference(a: AnswerValue, b: AnswerValue) -> f64 {
    match (a, b) {
        (AnswerValue::Vector(a), AnswerValue::Vector(b)) => (a - b).norm(),
        (AnswerValue::Scalar(a), AnswerValue::Scalar(b)) => (a - b).abs(),
        _ => f64::INFINITY,
    }
}

/// The grown mechanism is found again, place by place, by the reader and the position solver.
#[test]
fn the_pose_is_found_again() {
    for pose in [Pose::Coordinates, Pose::Lengths] {
        let mut worst = 0.0f64;
        each(400, pose, Ask::Positions, |m, c| {
            let extent = c.worked.configuration.extent();
            for (i, p) in c.scene.points.iter().enumerate() {
                let grown = m.points[p.name[1..].parse::<usize>().unwrap()];
                let Some(at) = c.worked.configuration.points[i] else { continue };
                let off = at.distance(grown) / extent;
                if off > 1e-9 {
                    c.fail(format!(
                        "{} of {:?} is {off:e} of the mechanism's size from where it was grown",
                        p.name, m.groups
                    ));
                }
                worst = worst.max(off);
            }
        });
        println!("positions by {pose:?}: worst {worst:.1e} of the size");
    }
}

/// Ruler and paper agree with the loop equations, for every question.
#[test]
fn drawing_agrees_with_the_loop_equations() {
    let mut worst = [(0.0f64, 0, String::new()), (0.0, 0, String::new())];
    let (mut answers, mut cases, mut ill) = (0, 0, 0);
    for pose in [Pose::Coordinates, Pose::Lengths] {
        each(500, pose, Ask::Everything, |m, c| {
            cases += 1;
            ill += usize::from(!c.well_conditioned());
            for (text, drawn, computed) in c.results() {
                if !(drawn.magnitude().is_finite() && computed.magnitude().is_finite()) {
                    c.fail(format!("{text} is not finite: {drawn:?} {computed:?}"));
                }
                answers += 1;
            }
            for o in &c.worked.results {
                let Some(a) = o.agreement else { continue };
                let text = &c.scene.find[o.find].text;
                if !a.holds() || (c.well_conditioned() && a.difference > 1e-9) {
                    let (d, k) = (o.drawn.as_ref().map(|d| d.value), c.worked.solution.condition);
                    c.fail(format!(
                        "{text} of {:?}: drawn {d:?}, computed {:?}, {a:?}, condition {k:e}",
                        m.groups, o.computed
                    ));
                }
                let w = &mut worst[usize::from(c.well_conditioned())];
                if a.difference > w.0 {
                    *w = (a.difference, c.seed, text.clone());
                }
            }
        });
    }
    println!("{cases} cases, {answers} answers, {ill} ill-conditioned (condition over {WELL:e})");
    println!(
        "drawing against loop equations, relative: worst {:?}; where ill-conditioned {:?}",
        worst[1], worst[0]
    );
}

/// Vectors of a point of the configuration, or the angle of a link, at a driver time.
pub struct Motion {
    pub at: Vec<Configuration>,
}

/// Central differences with h, 2h, 4h, extrapolated twice: the error is proportional to h⁶.
const STEPS: [f64; 7] = [0.0, 1.0, -1.0, 2.0, -2.0, 4.0, -4.0];

impl Motion {
    pub fn of(c: &Case, h: f64) -> Option<Motion> {
        let (scene, w) = (&c.scene, &c.worked);
        let now = newton::driver_values(scene, &w.configuration);
        let at = STEPS.map(|k| {
            let t = k * h;
            let mut values = now.clone();
            for (d, driver) in scene.drivers.iter().enumerate() {
                let a = driver.acceleration.as_ref().map_or(0.0, |a| a.value);
                values.0[d] += driver.rate.value * t + 0.5 * a * t * t;
            }
            newton::moved(scene, &w.mechanism, &w.configuration, &values)
        });
        Some(Motion { at: at.into_iter().collect::<Option<Vec<_>>>()? })
    }

    pub fn first(&self, h: f64, f: impl Fn(&Configuration) -> Vec2) -> Vec2 {
        let d = |k: usize| (f(&self.at[k]) - f(&self.at[k + 1])) * (0.5 / (h * STEPS[k]));
        extrapolate(d(1), d(3), d(5))
    }

    pub fn second(&self, h: f64, f: impl Fn(&Configuration) -> Vec2) -> Vec2 {
        let d = |k: usize| {
            let step = h * STEPS[k];
            ((f(&self.at[k]) - f(&self.at[0])) + (f(&self.at[k + 1]) - f(&self.at[0])))
                * (1.0 / (step * step))
        };
        extrapolate(d(1), d(3), d(5))
    }
}

fn extrapolate(h: Vec2, h2: Vec2, h4: Vec2) -> Vec2 {
    let (a, b) = (h + (h - h2) * (1.0 / 3.0), h2 + (h2 - h4) * (1.0 / 3.0));
    a + (a - b) * (1.0 / 15.0)
}

/// Both methods agree with the change of positions when the drivers move.
#[test]
fn vectors_are_differences_of_positions() {
    let (mut worst_v, mut worst_a, mut cases) = (0.0f64, 0.0f64, 0);
    for seed in seeds(160) {
        let Some(m) = mechanism(seed).filter(|m| m.groups.len() <= 8) else { continue };
        let pose = if m.coordinates_only { Pose::Coordinates } else { Pose::of(seed) };
        let c = solve(seed, &m, &style(pose, Ask::Everything, seed));
        let extent = c.worked.configuration.extent();
        let (v, a) = (c.largest(Level::Velocity), c.largest(Level::Acceleration));
        let rates = c.worked.construction.rates.iter().filter(|r| r.on == DiagramKind::Velocity);
        let omega = rates.map(|r| r.value.abs()).fold(v / extent, f64::max);
        // If a motion is strongly amplified, its higher derivatives spoil any difference formula.
        if c.worked.solution.condition > 2e2 || omega > 20.0 {
            continue;
        }
        let h = 2e-3 / omega.max(1.0);
        let Some(moved) = Motion::of(&c, h) else {
            c.fail("positions do not follow a small step of the drivers")
        };
        cases += 1;
        let scale = [v.max(1e-3), a.max(v * omega).max(1e-3)];
        let mut compare = |what: String,
                           level: Level,
                           differences: Vec2,
                           solved: Vec2,
                           scale: f64| {
            let off = (differences - solved).norm() / scale;
            let (allowed, worst) =
                if level == Level::Velocity { (1e-6, &mut worst_v) } else { (1e-5, &mut worst_a) };
            if off > allowed {
                c.fail(format!("{what} at {level:?} of {:?}: differences say {differences:?}, solved {solved:?}, off {off:e}", m.groups));
            }
            *worst = worst.max(off);
        };
        for (i, p) in c.scene.points.iter().enumerate() {
            let place = |at: &Configuration| at.points[i].map_or(Vec2::ZERO, Point::to_vec2);
            for (k, level) in Level::RATES.into_iter().enumerate() {
                let Some(solved) = c.worked.solution.vector(level, PointId(i), None) else {
                    continue;
                };
                let d = if k == 0 { moved.first(h, place) } else { moved.second(h, place) };
                compare(p.name.clone(), level, d, solved, scale[k]);
            }
        }
        for (l, link) in c.scene.links.iter().enumerate() {
            let Some(now) = c.worked.configuration.poses[l] else { continue };
            // Small angles from the pose, so that no turn is lost.
            let angle = |at: &Configuration| {
                Vec2::new(at.poses[l].map_or(0.0, |p| p.axis.divide_by(now.axis).angle()), 0.0)
            };
            for (k, level) in Level::RATES.into_iter().enumerate() {
                let Some(solved) = c.worked.solution.turning(level, scene::LinkId(l)) else {
                    continue;
                };
                let d = if k == 0 { moved.first(h, angle) } else { moved.second(h, angle) };
                let scale = if k == 0 { omega } else { omega * omega + a / extent };
                compare(format!("link {}", link.name), level, d, Vec2::new(solved, 0.0), scale);
            }
        }
    }
    println!(
        "{cases} cases against differences: worst velocity {worst_v:.1e}, acceleration {worst_a:.1e} (relative to the largest)"
    );
    assert!(cases > 40 / every(8), "only {cases} cases were fit for differences");
}

/// A term by the configuration and the loop equations alone.
struct Expected {
    /// The vector, if its magnitude follows from the level below.
    vector: Option<Vec2>,
    /// Its line.
    direction: Vec2,
}

struct Oracle<'a> {
    c: &'a Case,
}

impl Oracle<'_> {
    fn place(&self, v: VertexId) -> Point {
        let (w, d) = (&self.c.worked, &self.c.worked.construction.diagram);
        match w.plan.vertex(v).spot {
            VertexPlace::Point(p) => w.configuration.point(p),
            // A special point exists only on the diagram.
            VertexPlace::Special(_) => d.origin + d.spots[v.0].unwrap().to_vec2() * d.mu,
        }
    }

    fn vector(&self, level: Level, v: VertexId) -> Option<Vec2> {
        let vertex = self.c.worked.plan.vertex(v);
        match vertex.spot {
            VertexPlace::Point(_) if vertex.fixed => Some(Vec2::ZERO),
            VertexPlace::Point(p) if vertex.trial.is_none() => {
                self.c.worked.solution.vector(level, p, vertex.on)
            }
            VertexPlace::Point(_) | VertexPlace::Special(_) => None,
        }
    }

    fn omega(&self, b: TurningBody) -> f64 {
        match b {
            TurningBody::Link(l) => self
                .c
                .worked
                .solution
                .turning(Level::Velocity, l)
                .unwrap_or_else(|| self.c.fail("a link without ω")),
            TurningBody::Cylinder(d) => {
                let DriverKind::Cylinder { a, b, .. } = self.c.scene.drivers[d].kind else {
                    self.c.fail("no cylinder")
                };
                let at = |p| self.c.worked.configuration.point(p);
                let v = |p| {
                    self.c.worked.solution.vector(Level::Velocity, p, None).unwrap_or(Vec2::ZERO)
                };
                let r = at(b) - at(a);
                r.cross(v(b) - v(a)) / r.norm2()
            }
        }
    }

    fn expected(&self, level: Level, t: &Term) -> Expected {
        let arm = self.place(t.of) - self.place(t.to);
        let unit = arm.unit().unwrap_or(Vec2::ZERO);
        let slide = || {
            let v = |x| self.vector(Level::Velocity, x);
            Some(v(t.of)? - v(t.to)?)
        };
        match (t.kind, t.by) {
            (TermKind::Relative | TermKind::Tangential, _) => {
                Expected { vector: None, direction: unit.perp() }
            }
            (TermKind::Normal, TermConnection::Turning(b)) => {
                let w = self.omega(b);
                Expected { vector: Some(arm * -(w * w)), direction: unit }
            }
            (TermKind::Extension, TermConnection::Cylinder(d)) => {
                let d = &self.c.scene.drivers[d];
                let rate = if level == Level::Velocity {
                    d.rate.value
                } else {
                    d.acceleration.as_ref().map_or(0.0, |a| a.value)
                };
                Expected { vector: Some(unit * rate), direction: unit }
            }
            (TermKind::Coriolis, TermConnection::Cylinder(d)) => {
                let w = self.omega(TurningBody::Cylinder(d));
                Expected {
                    vector: Some(unit.perp() * (2.0 * w * self.c.scene.drivers[d].rate.value)),
                    direction: unit.perp(),
                }
            }
            (kind, TermConnection::Guide { guide, .. }) => {
                let path = self.c.worked.configuration.guide(guide);
                let at = self.place(t.of);
                let tangent = match path {
                    Path::Line { direction, .. } => direction,
                    Path::Arc { centre, .. } => (at - centre).perp().unit().unwrap(),
                };
                match kind {
                    TermKind::Slide => Expected { vector: None, direction: tangent },
                    TermKind::Coriolis => {
                        let w = self.omega(TurningBody::Link(self.c.scene.guides[guide.0].on));
                        Expected {
                            vector: slide().map(|v| v.perp() * (2.0 * w)),
                            direction: tangent.perp(),
                        }
                    }
                    TermKind::SlideNormal => {
                        let Path::Arc { centre, radius } = path else {
                            self.c.fail("a curved part on a straight guide")
                        };
                        // Toward the centre seen from the carrier; reversed from the runner.
                        let carrier = self.c.scene.guides[guide.0].on;
                        let v = self.c.worked.plan.vertex(t.of);
                        let carried = match (v.on, v.spot) {
                            (Some(l), _) => l == carrier,
                            (None, VertexPlace::Point(p)) => {
                                self.c.scene.links[carrier.0].points.contains(&p)
                            }
                            _ => false,
                        };
                        let inward =
                            (centre - at).unit().unwrap() * if carried { -1.0 } else { 1.0 };
                        Expected {
                            vector: slide().map(|v| inward * (v.norm2() / radius)),
                            direction: inward,
                        }
                    }
                    other => self.c.fail(format!("a guide makes no {other:?}")),
                }
            }
            other => self.c.fail(format!("no such term: {other:?}")),
        }
    }
}

/// Edges agree with their terms, chains lead to their targets, vertices are at their true places.
#[test]
fn every_edge_keeps_its_word() {
    let (mut edges, mut images, mut vertices) = (0, 0, 0);
    for pose in [Pose::Coordinates, Pose::Lengths] {
        each(250, pose, Ask::Everything, |_, c| {
            if !c.well_conditioned() {
                return;
            }
            let oracle = Oracle { c };
            let plan = &c.worked.plan;
            for level in Level::RATES {
                let Some(polygon) = c.worked.construction.polygon(DiagramKind::of(level)) else {
                    continue;
                };
                let largest = polygon
                    .edges
                    .iter()
                    .map(|e| (e.to.1 - e.from.1).norm() * polygon.mu)
                    .fold(c.scale(level), f64::max);
                let near = 1e-8 * largest + f64::MIN_POSITIVE;
                for (i, v) in plan.vertices.iter().enumerate() {
                    let (Some(image), Some(solved)) =
                        (polygon.images[i], oracle.vector(level, VertexId(i)))
                    else {
                        continue;
                    };
                    vertices += 1;
                    if (image.to_vec2() * polygon.mu - solved).norm() > near {
                        c.fail(format!(
                            "{level:?} image of {v:?}: {:?}, solved {solved:?}",
                            image.to_vec2() * polygon.mu
                        ));
                    }
                }
                let vector = |e: &Edge| (e.to.1 - e.from.1) * polygon.mu;
                for e in &polygon.edges {
                    edges += 1;
                    for t in &e.terms {
                        let x = oracle.expected(level, t);
                        // Between a special point and a coincident joint there is no line.
                        if (oracle.place(t.of) - oracle.place(t.to)).norm()
                            < 1e-7 * c.worked.configuration.extent()
                            && matches!(t.kind, TermKind::Relative | TermKind::Tangential)
                        {
                            continue;
                        }
                        let aside = x.direction.cross(vector(e)).abs();
                        if aside > near {
                            c.fail(format!(
                                "{level:?} edge {t:?} lies {:e} of the largest beside its line",
                                aside / largest
                            ));
                        }
                        if let (true, Some(v)) = (t.known && e.known, x.vector)
                            && (v - vector(e)).norm() > near
                        {
                            c.fail(format!("{level:?} edge {t:?} is {:?}, not {v:?}", vector(e)));
                        }
                    }
                }
                // The board draws edges chain by chain: known ones, then one per unknown line.
                let mut rest = polygon.edges.iter().filter(|e| !e.between);
                for group in plan.steps(DiagramKind::of(level)) {
                    for step in
                        group.steps(group.drawn(c.worked.construction.acts.chosen[group.group]))
                    {
                        match step {
                            PlanStep::Equation { target, chains, .. } => {
                                let known: Vec<Vec2> = chains
                                    .iter()
                                    .map(|ch| {
                                        rest.by_ref()
                                            .take(ch.known.len())
                                            .map(vector)
                                            .fold(Vec2::ZERO, |s, v| s + v)
                                    })
                                    .collect();
                                for (ch, sum) in chains.iter().zip(known) {
                                    let last = if ch.unknown.is_empty() {
                                        Vec2::ZERO
                                    } else {
                                        rest.next().map_or(Vec2::ZERO, vector)
                                    };
                                    let image = |v: VertexId| {
                                        polygon.images[v.0].unwrap().to_vec2() * polygon.mu
                                    };
                                    let gap = image(ch.start) + sum + last - image(*target);
                                    if gap.norm() > near {
                                        c.fail(format!(
                                            "{level:?} chain to {target:?} does not close: {gap:?}"
                                        ));
                                    }
                                }
                            }
                            PlanStep::Image { target, from: (a, b), .. } => {
                                images += 1;
                                let image = |v: &VertexId| polygon.images[v.0].unwrap().to_vec2();
                                let (link, drawn) = (
                                    (oracle.place(*target) - oracle.place(*a))
                                        .divide_by(oracle.place(*b) - oracle.place(*a)),
                                    (image(target) - image(a)).divide_by(image(b) - image(a)),
                                );
                                // Without rotation the image is a single point.
                                let base = (image(b) - image(a)).norm() * polygon.mu;
                                if base > 1e-3 * largest
                                    && (link - drawn).norm() * base > near * (1.0 + link.norm())
                                {
                                    c.fail(format!("{level:?} image of {target:?} is not similar to its link: {link:?} {drawn:?}"));
                                }
                            }
                            PlanStep::Same { target, from, .. } => {
                                assert_eq!(polygon.images[target.0], polygon.images[from.0])
                            }
                            PlanStep::Trials { .. } => {}
                        }
                    }
                }
                assert!(rest.next().is_none(), "an edge belongs to no equation");
            }
        });
    }
    println!("{edges} edges, {images} images of triangles, {vertices} vertices");
}

/// A type without floating-point numbers in it can be `Eq`.
fn holds_no_numbers<T: Eq>() {}

#[test]
fn a_plan_does_not_change_with_the_lengths() {
    holds_no_numbers::<Vertex>();
    holds_no_numbers::<hodograph::plan::GroupSteps>();
    holds_no_numbers::<hodograph::plan::Effect>();
    let mut plans = 0;
    for seed in seeds(300) {
        let groups = 2 + (seed % 9) as usize;
        let (Some(a), Some(b)) =
            (mech::grow(seed, seed, groups), mech::grow(seed, seed + 1_000_000, groups))
        else {
            continue;
        };
        assert_eq!(
            (&a.links, &a.groups),
            (&b.links, &b.groups),
            "seed {seed}: the geometry reached the topology"
        );
        let s = style(Pose::Coordinates, Ask::Everything, seed);
        let (a, b) = (solve(seed, &a, &s), solve(seed, &b, &s));
        if a.worked.plan != b.worked.plan {
            a.fail(format!("another plan with other lengths:\n{}", b.text));
        }
        plans += 1;
    }
    println!("{plans} plans");
}

/// Answers of two runs with the same questions in the same order.
fn compare(
    what: &str,
    a: &Case,
    b: &Case,
    tolerance: f64,
    map: impl Fn(&str, AnswerValue) -> AnswerValue,
) -> f64 {
    assert_eq!(a.worked.results.len(), b.worked.results.len(), "{what}: the questions differ");
    let mut worst = 0.0f64;
    let largest = |text: &str| {
        let kind = text.split('_').next().unwrap_or("");
        a.results()
            .filter(|r| r.0.split('_').next() == Some(kind))
            .map(|r| r.2.magnitude())
            .fold(0.0, f64::max)
    };
    // Vanishing values are compared with those that do not vanish.
    let motion = a
        .results()
        .filter(|r| !r.0.starts_with(['x', 'y']))
        .map(|r| r.2.magnitude())
        .fold(0.0, f64::max);
    for ((text, drawn, computed), (_, other_drawn, other)) in a.results().zip(b.results()) {
        for (was, is) in [(drawn, other_drawn), (computed, other)] {
            let off = difference(map(text, was), is);
            let reference = map(text, was)
                .magnitude()
                .max(1e-3 * map(text, AnswerValue::Scalar(largest(text))).magnitude())
                .max(1e-4 * motion)
                .max(1e-9);
            worst = worst.max(off / reference);
            if off > tolerance * reference {
                a.fail(format!(
                    "{what} changes {text} from {was:?} to {is:?} (off {:e})\n{}\nand",
                    off / reference,
                    b.text
                ));
            }
        }
    }
    worst
}

/// True if the quantity is proportional to the length unit.
fn goes_with_length(text: &str) -> bool {
    !(text.starts_with("omega") || text.starts_with("alpha"))
}

#[test]
fn a_power_of_two_changes_no_digit() {
    each(60, Pose::Lengths, Ask::Everything, |m, c| {
        for k in [-40, -10, 10, 40] {
            let stretch = libm::ldexp(1.0, k);
            let s = style(
                if m.coordinates_only { Pose::Coordinates } else { Pose::Lengths },
                Ask::Everything,
                c.seed,
            );
            let b = solve(c.seed, &m.mapped(Vec2::new(1.0, 0.0), stretch, Vec2::ZERO), &s);
            for ((text, drawn, was), (_, other_drawn, is)) in c.results().zip(b.results()) {
                let scale = |v: AnswerValue| match v {
                    _ if !goes_with_length(text) => v,
                    v => v.map(|x| x * stretch),
                };
                let near =
                    1e-9 * is.magnitude() + 1e-11 * scale(AnswerValue::Scalar(1.0)).magnitude();
                // Positions short of digits use the written decimals, which 2^k changes.
                let written = || settled(&c.scene, &c.worked) || settled(&b.scene, &b.worked);
                if scale(was) != is && (difference(scale(was), is) > near || !written()) {
                    c.fail(format!("2^{k} changes {text} from {was:?} to {is:?}\n{}\nand", b.text));
                }
                // The paper's scales are 1, 2, 2.5, 5 × 10^k: a reading is rounded differently.
                let (d, e) =
                    (difference(scale(drawn), other_drawn), difference(scale(was), scale(drawn)));
                if d > 4.0 * e + near {
                    c.fail(format!(
                        "2^{k} changes the drawn {text} from {drawn:?} to {other_drawn:?}"
                    ));
                }
            }
        }
    });
}

#[test]
fn turning_and_shifting_the_whole() {
    let (mut turned, mut shifted) = (0.0f64, 0.0f64);
    for pose in [Pose::Coordinates, Pose::Lengths] {
        each(120, pose, Ask::Velocities, |m, c| {
            if c.worked.solution.condition > 1e3 {
                return;
            }
            let pose = if m.coordinates_only { Pose::Coordinates } else { pose };
            let s = style(pose, Ask::Everything, c.seed);
            let c = solve(c.seed, m, &s);
            let by = Vec2::from_angle(0.7 + c.seed as f64);
            let b = solve(c.seed, &m.mapped(by, 1.0, Vec2::ZERO), &s);
            let coordinates = |text: &str| text.starts_with("x_") || text.starts_with("y_");
            let rotate = |text: &str, v: AnswerValue| match v {
                AnswerValue::Vector(v) => AnswerValue::Vector(v.rotate_by(by)),
                AnswerValue::Scalar(_) if coordinates(text) => AnswerValue::Scalar(f64::NAN),
                s => s,
            };
            turned = turned.max(compare_skipping("turning the whole", &c, &b, 1e-9, rotate));
            let far = m.mapped(Vec2::new(1.0, 0.0), 1.0, Vec2::new(1e3, -2e3));
            let b = solve(c.seed, &far, &s);
            let skip = |text: &str, v: AnswerValue| {
                if coordinates(text) { AnswerValue::Scalar(f64::NAN) } else { v }
            };
            shifted = shifted.max(compare_skipping(
                "shifting the whole by a thousand lengths",
                &c,
                &b,
                2e-8,
                skip,
            ));
        });
    }
    println!("worst change by turning {turned:.1e}, by shifting {shifted:.1e}");
}

/// Compares like [`compare`], without values for which `map` gives NaN.
fn compare_skipping(
    what: &str,
    a: &Case,
    b: &Case,
    tolerance: f64,
    map: impl Fn(&str, AnswerValue) -> AnswerValue,
) -> f64 {
    let keep = |text: &str, v: AnswerValue| match map(text, v) {
        AnswerValue::Scalar(s) if s.is_nan() => v,
        w => w,
    };
    let strip = |c: &Case| {
        let kept: Vec<_> = c
            .worked
            .results
            .iter()
            .filter(|o| !c.scene.find[o.find].text.starts_with(['x', 'y']))
            .cloned()
            .collect();
        Case {
            seed: c.seed,
            text: c.text.clone(),
            scene: c.scene.clone(),
            worked: Worked { results: kept, ..c.worked.clone() },
        }
    };
    compare(what, &strip(a), &strip(b), tolerance, keep)
}

#[test]
fn names_and_the_order_of_keys_do_not_matter() {
    let mut worst = 0.0f64;
    for pose in [Pose::Coordinates, Pose::Lengths] {
        each(150, pose, Ask::Everything, |m, c| {
            if c.worked.solution.condition > 1e3 {
                return;
            }
            let pose = if m.coordinates_only { Pose::Coordinates } else { pose };
            let s = Style { renamed: true, ..style(pose, Ask::Everything, c.seed) };
            let b = solve(c.seed, m, &s);
            worst = worst.max(compare("renaming and reordering", c, &b, 1e-9, |_, v| v));
        });
    }
    println!("worst change by renaming and reordering {worst:.1e}");
}

fn terms(plan: &Plan, level: Level) -> impl Iterator<Item = &Term> {
    let steps = plan
        .steps(DiagramKind::of(level))
        .iter()
        .flat_map(|g| g.alternatives.iter().flatten().chain(&g.further));
    steps.flat_map(|s| match s {
        PlanStep::Equation { chains, .. } => {
            chains.iter().flat_map(|c| c.known.iter().chain(&c.unknown)).collect::<Vec<_>>()
        }
        _ => Vec::new(),
    })
}

#[test]
fn only_what_is_asked_is_done() {
    each(120, Pose::Coordinates, Ask::Positions, |_, c| {
        let (plan, paper) = (&c.worked.plan, &c.worked.construction);
        assert!(plan.stages.is_empty() && plan.vertices.is_empty(), "seed {}", c.seed);
        assert!(paper.diagrams.is_empty() && c.worked.solution.size == [0, 0]);
    });
    each(120, Pose::Coordinates, Ask::Velocities, |_, c| {
        let (plan, paper) = (&c.worked.plan, &c.worked.construction);
        let on = DiagramKind::Acceleration;
        assert!(plan.steps(on).is_empty() && paper.polygon(on).is_none(), "seed {}", c.seed);
        assert_eq!(
            c.worked.solution.size[1], 0,
            "seed {}: accelerations solved that nothing asks for",
            c.seed
        );
    });
    each(200, Pose::Coordinates, Ask::Everything, |_, c| {
        let plan = &c.worked.plan;
        for t in terms(plan, Level::Acceleration) {
            match (t.kind, t.by) {
                (TermKind::Coriolis, TermConnection::Guide { guide, .. })
                    if c.worked.mechanism.never_turns[c.scene.guides[guide.0].on.0] =>
                {
                    c.fail("a Coriolis term at a guide that does not turn");
                }
                (TermKind::Tangential, TermConnection::Turning(TurningBody::Link(l)))
                    if t.known =>
                {
                    let driver = c
                        .scene
                        .drivers
                        .iter()
                        .find(|d| matches!(d.kind, DriverKind::Turn { link, against, .. } if link == l && against == c.scene.ground));
                    if driver.is_some_and(|d| d.acceleration.is_none()) {
                        c.fail("a tangential term of a driver at constant rate");
                    }
                }
                (TermKind::Slide, TermConnection::Guide { driver: Some(d), .. })
                | (TermKind::Extension, TermConnection::Cylinder(d))
                    if c.scene.drivers[d].acceleration.is_none() =>
                {
                    c.fail("an acceleration term of a slide at constant rate");
                }
                _ => {}
            }
        }
    });
}

/// For a question on one joint, only the groups that it depends on are placed and planned.
#[test]
fn only_the_groups_upstream_are_solved() {
    for seed in seeds(200) {
        let Some(m) = mechanism(seed) else { continue };
        let text = emit::scene(&m, &style(Pose::Coordinates, Ask::Positions, seed));
        let mut json: serde_json::Value = serde_json::from_str(&text).unwrap();
        let scene = scene::read(&text).unwrap().value;
        let p = (seed % scene.points.len() as u64) as usize;
        json["find"] = serde_json::json!([format!("a_{}", scene.points[p].name)]);
        let (scene, w) =
            worked(seed, &json.to_string()).unwrap_or_else(|f| panic!("seed {seed}: {f}\n{json}"));
        let group_of = |m: &Mechanism, p: usize| {
            let carriers = || scene.carriers(PointId(p)).filter_map(|l| m.group_of_link[l.0]).min();
            m.group_of_pin[p].or_else(carriers)
        };
        let mut reached = vec![false; w.mechanism.groups.len()];
        let mut stack: Vec<usize> = group_of(&w.mechanism, p).into_iter().collect();
        while let Some(g) = stack.pop() {
            if !std::mem::replace(&mut reached[g], true) {
                stack.extend(&w.mechanism.groups[g].upstream);
            }
        }
        for (g, reached) in reached.iter().enumerate() {
            let planned = w.plan.stages.iter().flat_map(|s| &s.groups).any(|s| s.group == g);
            assert_eq!(planned, *reached, "seed {seed}: group {g} planned or not\n{json}");
            for l in &w.mechanism.groups[g].links {
                assert_eq!(
                    w.configuration.poses[l.0].is_some(),
                    *reached,
                    "seed {seed}: link {l:?} placed or not\n{json}"
                );
            }
        }
        assert!(
            w.results.iter().all(|o| o.agreement.is_some_and(|a| a.holds())),
            "seed {seed}: {:?}\n{json}",
            w.results
        );
    }
}

/// Coordinates for some points besides lengths: a diagnosis or the right pose, never a wrong one.
#[test]
fn partly_by_coordinates() {
    let (mut solved, mut refused) = (0, std::collections::BTreeMap::<&str, usize>::new());
    for seed in seeds(600) {
        let Some(m) = mechanism(seed).filter(|m| !m.coordinates_only) else { continue };
        let text = emit::scene(&m, &style(Pose::Mixed, Ask::Everything, seed));
        match worked(seed, &text) {
            Err(f) => {
                assert!(f.has_errors(), "seed {seed}: refused without an error\n{text}");
                *refused.entry(f.list[0].code).or_default() += 1;
            }
            Ok((scene, worked)) => {
                solved += 1;
                let c = Case { seed, text, scene, worked };
                for (i, p) in c.scene.points.iter().enumerate() {
                    let grown = m.points[p.name[1..].parse::<usize>().unwrap()];
                    let off = c.worked.configuration.points[i].map_or(0.0, |q| q.distance(grown));
                    if off > 1e-7 {
                        c.fail(format!(
                            "{} of {:?} is {off:e} m from where it was grown",
                            p.name, m.groups
                        ));
                    }
                }
                if let Some(o) =
                    c.worked.results.iter().find(|o| o.agreement.is_some_and(|a| !a.holds()))
                {
                    c.fail(format!("{}: {o:?}", c.scene.find[o.find].text));
                }
            }
        }
    }
    println!("partly by coordinates: {solved} solved, refused: {refused:?}");
}
