//! Answers read off the paper: measured length × μ, with sense.

use super::Construction;
use super::pencil::Pencil;
use crate::answer::{Source, Value, evaluate, level_of};
use crate::geom::Vec2;
use crate::mechanism::{Level, Mechanism, Passive};
use crate::plan::{Body, Plan, Spot, VertexId};
use crate::position::Configuration;
use crate::scene::{Asked, Find, LinkId, PointId, Scene};

/// The answer to one question.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// Index into the scene's `find` list.
    pub find: usize,
    /// The value.
    pub value: Value,
    /// What the ruler gave; `None` for given values and positions.
    pub measured: Option<Measured>,
}

/// A length measured on paper, and what it was multiplied with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// The length (mm).
    pub length_mm: f64,
    /// The scale (SI per mm).
    pub mu: f64,
    /// For a turning rate, the arm (m) by which the product is divided.
    pub arm_m: Option<f64>,
    /// The two points whose distance the arm is, where it is one.
    pub arm_of: Option<(PointId, PointId)>,
}

struct OnPaper<'a> {
    scene: &'a Scene,
    m: &'a Mechanism,
    plan: &'a Plan,
    paper: &'a Construction,
}

impl OnPaper<'_> {
    fn vertex(&self, p: PointId, on: Option<LinkId>) -> Option<VertexId> {
        self.plan.find_vertex(self.scene, p, on)
    }

    /// The body with which a link turns.
    fn body(&self, link: LinkId) -> Body {
        match self.m.passive[link.0] {
            Some(Passive::Cylinder(d)) => Body::Cylinder(d),
            _ => Body::Link(self.m.turns_as(self.scene, link)),
        }
    }
}

impl Source for OnPaper<'_> {
    fn vector(&self, level: Level, p: PointId, on: Option<LinkId>) -> Option<Vec2> {
        // Fixed points lie in the pole, whether or not the plan had a use for them.
        let ground = self.scene.ground;
        if on == Some(ground) || (on.is_none() && self.scene.links[ground.0].points.contains(&p)) {
            return Some(Vec2::ZERO);
        }
        self.paper.vector(level, self.vertex(p, on)?)
    }

    fn turning(&self, level: Level, link: LinkId) -> Option<f64> {
        if self.m.never_turns[link.0] {
            return Some(0.0);
        }
        let body = self.body(link);
        if let Body::Link(l) = body
            && self.m.never_turns[l.0]
        {
            return Some(0.0);
        }
        self.paper.rate(level, body)
    }
}

/// The points at the ends of a line, if the arm is their distance (a special point is no point of the scene, and some arms
/// begin in a centre of curvature).
fn points_of(at: &Configuration, plan: &Plan, line: Option<(VertexId, VertexId)>, arm: f64) -> Option<(PointId, PointId)> {
    let (of, to) = line?;
    let (Spot::Point(a), Spot::Point(b)) = (plan.vertex(of).spot, plan.vertex(to).spot) else { return None };
    let off = at.points[a.0]?.distance(at.points[b.0]?) - arm;
    // Both are the same distance but for rounding, or another one altogether.
    (off.abs() < 1e-9 * arm).then_some((a, b))
}

/// The answers from the drawing board; `None` for what was not drawn (a group higher than class III).
pub fn read(scene: &Scene, m: &Mechanism, at: &Configuration, plan: &Plan, paper: &Construction) -> Vec<Option<Answer>> {
    let source = OnPaper { scene, m, plan, paper };
    scene
        .find
        .iter()
        .enumerate()
        .map(|(find, f)| {
            let value = evaluate(scene, at, &source, &f.what)?;
            let level = level_of(&f.what);
            let measured = match (value, paper.polygon(level)) {
                (Value::Vector(v), Some(p)) => Some(Measured { length_mm: v.norm() / p.mu, mu: p.mu, arm_m: None, arm_of: None }),
                (Value::Scalar(_), Some(p)) => {
                    let body = match f.what {
                        Asked::Omega(l) | Asked::Alpha(l) => Some(source.body(l)),
                        _ => None,
                    };
                    paper.rates.iter().find(|r| r.level == level && Some(r.body) == body).and_then(|r| {
                        let (length_mm, arm) = r.measured?;
                        Some(Measured { length_mm, mu: p.mu, arm_m: Some(arm), arm_of: points_of(at, plan, r.line, arm) })
                    })
                }
                _ => None,
            };
            Some(Answer { find, value, measured })
        })
        .collect()
}

/// What a pencil's owner reads: the answers from a drawing made [`by_hand`](super::by_hand), each length read with the same
/// pencil; positions are measured on the diagram. `shown` is the configuration that came with the drawing.
pub fn read_by_hand<P: Pencil>(
    scene: &Scene,
    m: &Mechanism,
    shown: &Configuration,
    plan: &Plan,
    paper: &Construction,
    pencil: &mut P,
) -> Vec<Option<Value>> {
    let source = OnPaper { scene, m, plan, paper };
    let mu_l = paper.diagram.mu_l;
    let mut read = |find: &Find| -> Option<Value> {
        let value = evaluate(scene, shown, &source, &find.what)?;
        let level = level_of(&find.what);
        Some(match (value, paper.polygon(level)) {
            (Value::Vector(v), Some(p)) => Value::Vector(pencil.read(level, v * (1.0 / p.mu)) * p.mu),
            // Rates were read when they were first needed; a difference of two is reckoned.
            (Value::Scalar(_), Some(_)) | (Value::Vector(_), None) => value,
            (Value::Scalar(s), None) => Value::Scalar(match find.what {
                Asked::LinkAngle(l) => {
                    let apart = shown.link_direction(scene, l).map_or(shown.extent(), Vec2::norm) / mu_l;
                    pencil.ruler(level, Vec2::from_angle(s), apart).angle()
                }
                _ => pencil.read(level, Vec2::new(s / mu_l, 0.0)).x * mu_l,
            }),
        })
    };
    scene.find.iter().map(&mut read).collect()
}
