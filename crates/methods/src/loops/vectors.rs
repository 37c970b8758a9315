//! The vectors of a loop, and the variables on which they depend.

use super::formula::{Formula, UnaryFunction};
use super::graph::{Body, Cycle, Graph, Joint};
use hodograph_base::digits::significant;
use hodograph_base::geom::{Point, Vec2};
use hodograph_board::plan::names::name_label;
use hodograph_mechanism::position::{Configuration, Path};
use hodograph_scene::{Driver, GuideId, GuidePath, Kind, LinkId, PointId, Scene};
use std::f64::consts::{FRAC_PI_2, PI};

/// A quantity that changes with the motion.
#[derive(Clone, Debug, PartialEq)]
pub struct LoopVariable {
    /// Its symbol in the label language, without the letter: the index.
    pub index: String,
    /// The link whose angle it is.
    pub link: Option<LinkId>,
    /// True for an angle, false for a length.
    pub angular: bool,
    /// The driver that gives it.
    pub driver: Option<usize>,
    /// The value in the pose (rad or m).
    pub value: f64,
    /// The first derivative by time.
    pub rate: f64,
    /// The second derivative by time.
    pub second: f64,
    /// The carrier of a length.
    pub(super) along: SlideCarrier,
}

/// The carrier along which a length changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SlideCarrier {
    /// A guide on ground: the derivative is a velocity of the point.
    Ground,
    /// A guide on a moving link: the derivative is a relative velocity.
    Link,
    /// A cylinder.
    Cylinder,
}

impl LoopVariable {
    /// Returns the quantity of the variable (order 0) or of a derivative by time.
    pub fn kind(&self, order: usize) -> Kind {
        match (self.angular, order) {
            (true, 0) => Kind::Angle,
            (true, 1) => Kind::Omega,
            (true, _) => Kind::Alpha,
            (false, 0) => Kind::Length,
            (false, 1) => Kind::Velocity,
            (false, _) => Kind::Acceleration,
        }
    }

    /// Returns the variable (order 0) or a derivative by time as a symbol.
    pub fn symbol(&self, order: usize) -> Formula {
        let letter = match (self.angular, self.along, order) {
            (true, _, 0) => "\\varphi",
            (true, _, 1) => "\\omega",
            (true, _, _) => "\\alpha",
            (false, SlideCarrier::Cylinder, 0) => "l",
            (false, SlideCarrier::Ground | SlideCarrier::Link, 0) => "s",
            (false, _, 1) => "v",
            (false, _, _) => "a",
        };
        let relative = !self.angular && self.along != SlideCarrier::Ground && order > 0;
        let value = [self.value, self.rate, self.second][order.min(2)];
        let mark = if relative { "r\\," } else { "" };
        Formula::symbol(format!("{letter}_{{{mark}{}}}", self.index), value)
    }
}

/// The length of a vector.
#[derive(Clone, Debug, PartialEq)]
pub enum VectorSize {
    /// Constant: its symbol and value (m).
    Fixed(String, f64),
    /// A variable, an index into [`super::Loops::variables`].
    Variable(usize),
}

/// The angle of a vector from the x axis: a constant (rad), added to a variable if there is one.
#[derive(Clone, Debug, PartialEq)]
pub struct VectorAngle {
    /// An index into [`super::Loops::variables`].
    pub variable: Option<usize>,
    /// The constant (rad), in (−π, π].
    pub plus: f64,
}

impl VectorAngle {
    /// Returns the angle as a formula.
    pub fn formula(&self, variables: &[LoopVariable]) -> Formula {
        AngleDifference::new(variables, self, None).formula()
    }
}

/// A vector of a loop.
#[derive(Clone, Debug, PartialEq)]
pub struct LoopVector {
    /// The names of its ends in the direction of the loop; empty for a foot on a guide.
    pub ends: [String; 2],
    /// Its ends in the pose (m), in the direction in which length and angle are measured.
    pub places: [Point; 2],
    /// The link that carries it.
    pub link: Option<LinkId>,
    /// True on the left side of the equation.
    pub left: bool,
    /// False if the loop runs against the vector.
    pub forward: bool,
    /// The length.
    pub size: VectorSize,
    /// The angle.
    pub angle: VectorAngle,
}

impl LoopVector {
    /// Returns true if the term is subtracted when all terms are on one side.
    pub fn negative(&self) -> bool {
        self.left != self.forward
    }
}

/// Angles (sine) below this are rounding errors.
const ROUNDING: f64 = 1e-11;

/// Makes the vectors of loops.
pub struct VectorMaker<'a> {
    pub scene: &'a Scene,
    at: &'a Configuration,
    graph: &'a Graph,
    pub variables: Vec<LoopVariable>,
    /// For each body the first of the bodies that turn with it.
    classes: Vec<usize>,
    /// For each class its variable, and the angle of that variable's direction in the pose.
    angles: Vec<Option<(usize, f64)>>,
    /// For each guide its variable.
    slides: Vec<Option<usize>>,
    /// For each guide the foot from which its variable is measured, and the direction.
    feet: Vec<Option<(Point, Vec2)>>,
    /// For each body that is a cylinder its length.
    lengths: Vec<Option<usize>>,
}

impl<'a> VectorMaker<'a> {
    pub fn new(scene: &'a Scene, at: &'a Configuration, graph: &'a Graph) -> VectorMaker<'a> {
        let mut classes: Vec<usize> = (0..graph.bodies.len()).collect();
        for edge in &graph.edges {
            let locks = match edge.joint {
                Joint::Slide(g) => scene.guides[g.0].slider.is_some(),
                Joint::Pin(_) => false,
            };
            if locks {
                let [a, b] = edge.bodies.map(|b| classes[b]);
                let (low, high) = (a.min(b), a.max(b));
                classes.iter_mut().filter(|c| **c == high).for_each(|c| *c = low);
            }
        }
        VectorMaker {
            scene,
            at,
            graph,
            variables: Vec::new(),
            angles: vec![None; classes.len()],
            lengths: vec![None; classes.len()],
            classes,
            slides: vec![None; scene.guides.len()],
            feet: vec![None; scene.guides.len()],
        }
    }

    /// Returns the vectors of a loop; `None` if the pose lacks a point of it.
    pub fn vectors(&mut self, cycle: &Cycle) -> Option<Vec<LoopVector>> {
        let mut out = Vec::new();
        let Cycle { left, right, base, closing } = cycle;
        let first = left.first().map_or(*closing, |(_, e)| *e);
        for (k, &(body, e)) in left.iter().enumerate() {
            let leave = left.get(k + 1).map_or(*closing, |(_, e)| *e);
            self.through(body, [e, leave], true, &mut out)?;
        }
        let leave = right.first().map_or(*closing, |(_, e)| *e);
        self.through(*base, [first, leave], false, &mut out)?;
        for (k, &(body, e)) in right.iter().enumerate() {
            let leave = right.get(k + 1).map_or(*closing, |(_, e)| *e);
            self.through(body, [e, leave], false, &mut out)?;
        }
        Some(out)
    }

    /// Adds the vectors from one joint of a body to another.
    fn through(
        &mut self,
        body: usize,
        [enter, leave]: [usize; 2],
        left: bool,
        out: &mut Vec<LoopVector>,
    ) -> Option<()> {
        let guide = |e: usize| match self.graph.edges[e].joint {
            Joint::Slide(g) if self.graph.edges[e].bodies[0] == body => Some(g),
            _ => None,
        };
        let (from, to) = (guide(enter), guide(leave));
        let (p, q) = (self.place(enter)?, self.place(leave)?);
        // Feet are measured from the joint at the other end, or from the other foot.
        let start = match from {
            Some(g) => self.foot(g, p.0, to.map_or(q.0, |_| p.0))?,
            None => p.0,
        };
        let end = match to {
            Some(g) => self.foot(g, q.0, start)?,
            None => q.0,
        };
        if let Some(g) = from {
            let slide = self.slide(body, g, start, &p, left, false)?;
            out.push(slide);
        }
        let ends = [
            if from.is_some() { String::new() } else { p.1.clone() },
            if to.is_some() { String::new() } else { q.1.clone() },
        ];
        let small = (end - start).norm() <= ROUNDING * self.at.extent();
        if !small {
            let normal = (from.is_some() != to.is_some()).then(|| from.or(to)).flatten();
            let perpendicular = normal.filter(|g| {
                self.feet[g.0]
                    .is_some_and(|(_, d)| d.dot(end - start).abs() <= ROUNDING * self.at.extent())
            });
            let vector = self.rigid(body, [start, end], ends, perpendicular, left);
            out.push(vector);
        }
        if let Some(g) = to {
            let slide = self.slide(body, g, end, &q, left, true)?;
            out.push(slide);
        }
        Some(())
    }

    /// Returns place and name of a joint.
    fn place(&self, edge: usize) -> Option<(Point, String)> {
        let edge = &self.graph.edges[edge];
        let named = |p: PointId| Some((self.at.points[p.0]?, self.scene.point_name(p).to_owned()));
        match edge.joint {
            Joint::Pin(p) => named(p),
            Joint::Slide(g) => match self.scene.guides[g.0].pin {
                Some(pin) => named(pin),
                None => {
                    let slider = edge.bodies[1];
                    let pinned = self.graph.edges.iter().find_map(|e| match e.joint {
                        Joint::Pin(p) if e.bodies.contains(&slider) => Some(p),
                        _ => None,
                    });
                    match (pinned, self.graph.bodies[slider]) {
                        (Some(p), _) => named(p),
                        (None, Body::Link(l)) => {
                            Some((self.at.poses[l.0]?.origin, self.scene.link_name(l).to_owned()))
                        }
                        (None, _) => None,
                    }
                }
            },
        }
    }

    /// Returns the foot of a point on the parallel to a guide through the sliding point; kept from
    /// the first request.
    fn foot(&mut self, g: GuideId, sliding: Point, of: Point) -> Option<Point> {
        if let Some((foot, _)) = self.feet[g.0] {
            return Some(foot);
        }
        let Path::Line { direction, .. } = self.at.guides[g.0]? else { return None };
        let along = direction.dot(sliding - of);
        let foot = sliding + direction * -along;
        // On a moving link the direction is such that the distance is positive.
        let moving = self.scene.guides[g.0].on != self.scene.ground && self.driver_of(g).is_none();
        let direction = if moving && along < 0.0 { direction * -1.0 } else { direction };
        self.feet[g.0] = Some((foot, direction));
        Some(foot)
    }

    fn driver_of(&self, g: GuideId) -> Option<usize> {
        self.scene.drivers.iter().position(|d| d.kind.guide() == Some(g))
    }

    fn slide(
        &mut self,
        body: usize,
        g: GuideId,
        foot: Point,
        (at, name): &(Point, String),
        left: bool,
        forward: bool,
    ) -> Option<LoopVector> {
        let (_, direction) = self.feet[g.0]?;
        let angle = self.angle(body, direction);
        let variable = match self.slides[g.0] {
            Some(v) => v,
            None => {
                let driver = self.driver_of(g);
                let v = self.add(LoopVariable {
                    index: name_label(name),
                    link: None,
                    angular: false,
                    driver,
                    value: direction.dot(*at - foot),
                    rate: 0.0,
                    second: 0.0,
                    along: match self.scene.guides[g.0].on == self.scene.ground {
                        true => SlideCarrier::Ground,
                        false => SlideCarrier::Link,
                    },
                });
                self.slides[g.0] = Some(v);
                v
            }
        };
        let ends =
            if forward { [String::new(), name.clone()] } else { [name.clone(), String::new()] };
        Some(LoopVector {
            ends,
            places: [foot, *at],
            link: self.link(body),
            left,
            forward,
            size: VectorSize::Variable(variable),
            angle,
        })
    }

    fn link(&self, body: usize) -> Option<LinkId> {
        match self.graph.bodies[body] {
            Body::Link(l) => Some(l),
            Body::Radius(_) | Body::Cylinder(_) => None,
        }
    }

    /// A vector of constant length, or along a cylinder.
    fn rigid(
        &mut self,
        body: usize,
        [start, end]: [Point; 2],
        ends: [String; 2],
        normal: Option<GuideId>,
        left: bool,
    ) -> LoopVector {
        let between = end - start;
        let angle = self.angle(body, between);
        let size = match (self.graph.bodies[body], normal) {
            (Body::Cylinder(d), _) => VectorSize::Variable(self.cylinder(body, d, between, &ends)),
            (_, Some(g)) => {
                let guide = &self.scene.guides[g.0];
                let of = match (guide.pin, guide.slider) {
                    (Some(p), _) => self.scene.point_name(p),
                    (None, Some(l)) => self.scene.link_name(l),
                    (None, None) => "",
                };
                VectorSize::Fixed(format!("e_{{{}}}", name_label(of)), between.norm())
            }
            (_, None) => {
                let name = |end: &String| if end.is_empty() { "F".to_owned() } else { end.clone() };
                let pair = name_label(&ends.each_ref().map(name).concat());
                let text = format!("l_{{{pair}}}");
                VectorSize::Fixed(text, between.norm())
            }
        };
        LoopVector {
            ends,
            places: [start, end],
            link: self.link(body),
            left,
            forward: true,
            size,
            angle,
        }
    }

    fn cylinder(&mut self, body: usize, driver: usize, between: Vec2, ends: &[String; 2]) -> usize {
        if let Some(v) = self.lengths[body] {
            return v;
        }
        let v = self.add(LoopVariable {
            index: name_label(&ends.concat()),
            link: None,
            angular: false,
            driver: Some(driver),
            value: between.norm(),
            rate: 0.0,
            second: 0.0,
            along: SlideCarrier::Cylinder,
        });
        self.lengths[body] = Some(v);
        v
    }

    /// Returns the angle of a direction on a body.
    fn angle(&mut self, body: usize, direction: Vec2) -> VectorAngle {
        let class = self.classes[body];
        let here = direction.angle();
        if class == self.classes[self.scene.ground.0] {
            return VectorAngle { variable: None, plus: rounded(here) };
        }
        let (variable, reference) = match self.angles[class] {
            Some(known) => known,
            None => {
                // The direction of a guide on the link, else that of its first vector.
                let guide = (0..self.feet.len())
                    .find(|g| self.classes[self.scene.guides[*g].on.0] == class);
                let direction = guide.and_then(|g| self.feet[g]).map(|(_, d)| d.angle());
                let here = direction.unwrap_or(here);
                let main = self.main(body, class);
                let variable = self.add(LoopVariable {
                    index: name_label(&self.index_of(main)),
                    link: self.link(main),
                    angular: true,
                    driver: self.turning(class),
                    value: here,
                    rate: 0.0,
                    second: 0.0,
                    along: SlideCarrier::Ground,
                });
                self.angles[class] = Some((variable, here));
                (variable, here)
            }
        };
        VectorAngle { variable: Some(variable), plus: rounded(wrapped(here - reference)) }
    }

    /// Returns the body whose number an angle has: a block has that of the link on which it slides.
    fn main(&self, body: usize, class: usize) -> usize {
        let slides = |b: usize| {
            self.graph.edges.iter().any(|e| matches!(e.joint, Joint::Slide(_)) && e.bodies[1] == b)
        };
        let main = (0..self.classes.len()).find(|b| self.classes[*b] == class && !slides(*b));
        main.unwrap_or(body)
    }

    fn index_of(&self, body: usize) -> String {
        let name = |p: PointId| self.scene.point_name(p);
        match self.graph.bodies[body] {
            Body::Link(l) => self.scene.link_name(l).to_owned(),
            Body::Radius(g) => match (&self.scene.guides[g.0].path, self.scene.guides[g.0].pin) {
                (GuidePath::Arc { centre, .. }, Some(pin)) => [name(*centre), name(pin)].concat(),
                _ => String::new(),
            },
            Body::Cylinder(d) => {
                let ends = self.scene.drivers[d].kind.ends();
                ends.map_or_else(String::new, |ends| ends.map(name).concat())
            }
        }
    }

    /// Returns the driver that turns a class of bodies.
    fn turning(&self, class: usize) -> Option<usize> {
        let turned = |d: &Driver| d.kind.turned().map(|(link, _)| self.classes[link.0]);
        self.scene.drivers.iter().position(|d| turned(d) == Some(class))
    }

    /// Returns rate and acceleration of a driver's variable, for a link relative to ground.
    pub fn rates(&self, driver: usize) -> [f64; 2] {
        let mut sum = [0.0; 2];
        let mut next = Some(driver);
        // A driver may turn a link relative to one that another driver turns, and so on.
        for _ in 0..self.scene.drivers.len() {
            let Some(d) = next.take().map(|k| &self.scene.drivers[k]) else { break };
            sum[0] += d.rate.value;
            sum[1] += d.acceleration.as_ref().map_or(0.0, |a| a.value);
            let Some((_, against)) = d.kind.turned() else { break };
            let class = self.classes[against.0];
            next = self.turning(class);
            if let (None, Some((v, _))) = (next, self.angles[class]) {
                sum[0] += self.variables[v].rate;
                sum[1] += self.variables[v].second;
            }
        }
        sum
    }

    fn add(&mut self, variable: LoopVariable) -> usize {
        self.variables.push(variable);
        self.variables.len() - 1
    }
}

pub(super) fn wrapped(angle: f64) -> f64 {
    if angle > PI {
        angle - 2.0 * PI
    } else if angle <= -PI {
        angle + 2.0 * PI
    } else {
        angle
    }
}

/// Returns the multiple of a right angle from which an angle differs by rounding only.
pub(super) fn rounded(angle: f64) -> f64 {
    let turns = (angle / FRAC_PI_2).round();
    if (angle - turns * FRAC_PI_2).abs() < ROUNDING { wrapped(turns * FRAC_PI_2) } else { angle }
}

/// Returns the number of quarter turns, if an angle is a multiple of a right angle.
fn quarters(angle: f64) -> Option<i64> {
    let turns = (angle / FRAC_PI_2).round();
    (turns * FRAC_PI_2 == angle || wrapped(turns * FRAC_PI_2) == angle)
        .then_some((turns as i64).rem_euclid(4))
}

/// Significant digits of a constant angle in a formula.
const ANGLE_DIGITS: usize = 6;

/// Returns a constant angle as it is written.
fn constant(angle: f64) -> Formula {
    let degrees = significant(angle.to_degrees(), ANGLE_DIGITS);
    let short = match degrees.split_once('.') {
        Some(_) => degrees.trim_end_matches('0').trim_end_matches('.').to_owned(),
        None => degrees,
    };
    Formula::Number(format!("{short}°"), angle)
}

/// The difference of two angles, or one angle.
#[derive(Clone, Debug)]
pub struct AngleDifference {
    of: Option<Formula>,
    less: Option<Formula>,
    plus: f64,
}

impl AngleDifference {
    /// The angle `a`, less the angle `b`.
    pub fn new(variables: &[LoopVariable], a: &VectorAngle, b: Option<&VectorAngle>) -> Self {
        let symbol = |v: Option<usize>| v.map(|v| variables[v].symbol(0));
        let less = b.and_then(|b| b.variable);
        let plus = rounded(wrapped(a.plus - b.map_or(0.0, |b| b.plus)));
        if a.variable == less {
            return AngleDifference { of: None, less: None, plus };
        }
        AngleDifference { of: symbol(a.variable), less: symbol(less), plus }
    }

    /// Returns the angle as a formula.
    pub fn formula(&self) -> Formula {
        let mut terms: Vec<(bool, Formula)> = Vec::new();
        terms.extend(self.of.clone().map(|f| (false, f)));
        terms.extend(self.less.clone().map(|f| (true, f)));
        if self.plus != 0.0 || terms.is_empty() {
            terms.push((self.plus < 0.0, constant(self.plus.abs())));
        }
        Formula::sum(terms)
    }

    /// Returns cosine and sine. Quarter turns are taken out of them.
    pub fn cos_sin(&self) -> [Formula; 2] {
        // cos(−φ) = cos φ, sin(−φ) = −sin φ.
        if let (None, Some(less)) = (&self.of, &self.less) {
            let turned = AngleDifference { of: Some(less.clone()), less: None, plus: -self.plus };
            let [c, s] = turned.cos_sin();
            return [c, s.negative()];
        }
        let bare = self.of.is_none();
        let (turns, rest) = match quarters(self.plus) {
            Some(turns) => (turns, AngleDifference { plus: 0.0, ..self.clone() }),
            None => (0, self.clone()),
        };
        let [c, s] = if bare && rest.plus == 0.0 {
            [Formula::whole(1), Formula::whole(0)]
        } else {
            let of = rest.formula();
            [of.clone().call(UnaryFunction::Cos), of.call(UnaryFunction::Sin)]
        };
        match turns {
            0 => [c, s],
            1 => [s.negative(), c],
            2 => [c.negative(), s.negative()],
            _ => [s, c.negative()],
        }
    }
}
