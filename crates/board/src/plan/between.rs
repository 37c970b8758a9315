//! Readings between two images: the vector on paper that a question means, and the lines that must
//! be drawn for it.
//!
//! A reading is an edge of the drawing or the distance of two of its marks. Most questions ask for
//! a term of an equation. The other vectors are drawn between their two images afterwards
//! ([`Between`]): v_EA of two points that no chain joins, aⁿ of points found by an image, aʳ if its
//! edge is merged with another, and aᵗ if an angular acceleration is measured from it.

use super::build::{PlanBuilder, slot};
use super::{
    Between, GroupSteps, Plan, PlanStage, PlanStep, Rate, Term, TermConnection, TermKind,
    TurningBody, Vertex, VertexId, VertexPlace, canonical,
};
use hodograph_mechanism::mechanism::{
    Level, Mechanism, Need, Passive, PointJoint, Strut, joined, nodes_of,
};
use hodograph_scene::quantity::{Frame, Meaning, ObservedPart, RelativeComponent};
use hodograph_scene::{Asked, DiagramKind, GuidePath, LinkId, OnLink, PointId, Scene};

/// The vector on paper that a question of motion means.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Asking {
    /// The vector from the pole to an image; `reversed`: from the image to the pole.
    Vector {
        /// The vertex of the image.
        of: VertexId,
        /// True if the vector belongs to a fixed point, relative to this vertex.
        reversed: bool,
    },
    /// One edge, or consecutive ones, of these terms.
    Terms(Vec<Term>),
}

/// Returns the vector on a plan's paper that a question means; `None` for angular quantities and
/// positions, and for points that the plan does not have.
pub fn asking(scene: &Scene, m: &Mechanism, plan: &Plan, what: &Asked) -> Option<Asking> {
    asking_of(scene, m, &plan.vertices, what)
}

/// Returns the vertex of a point (of a link).
pub(super) fn find_vertex(
    vertices: &[Vertex],
    scene: &Scene,
    p: PointId,
    on: Option<LinkId>,
) -> Option<VertexId> {
    let on = canonical(scene, p, on);
    vertices.iter().position(|v| v.spot == VertexPlace::Point(p) && v.on == on).map(VertexId)
}

/// Returns the body with which a link turns.
pub(crate) fn body_of(scene: &Scene, m: &Mechanism, l: LinkId) -> TurningBody {
    match m.passive[l.0] {
        Some(Passive::Cylinder(d)) => TurningBody::Cylinder(d),
        // A block on the ground never turns, like the ground itself, but is not called by the
        // ground's number.
        Some(Passive::Block(_) | Passive::Held(..)) | None if m.never_turns[l.0] => {
            TurningBody::Link(l)
        }
        Some(Passive::Block(_) | Passive::Held(..)) | None => {
            TurningBody::Link(m.turns_as(scene, l))
        }
    }
}

fn asking_of(scene: &Scene, m: &Mechanism, vertices: &[Vertex], what: &Asked) -> Option<Asking> {
    use TermKind::{Coriolis, Extension, Normal, Relative, Slide, SlideNormal, Tangential};
    let vertex = |p: &OnLink| find_vertex(vertices, scene, p.point, p.link);
    let fixed = |p: &OnLink| {
        p.link.map_or_else(
            || scene.links[scene.ground.0].points.contains(&p.point),
            |l| l == scene.ground,
        )
    };
    let whole = |p: &OnLink, reversed| Some(Asking::Vector { of: vertex(p)?, reversed });
    let terms = |a: &OnLink, b: &OnLink, kinds: &[TermKind], by: TermConnection| {
        let (of, to) = (vertex(a)?, vertex(b)?);
        Some(Asking::Terms(
            kinds.iter().map(|kind| Term { kind: *kind, of, to, by, known: false }).collect(),
        ))
    };
    let arc = |g: hodograph_scene::GuideId| matches!(scene.guides[g.0].path, GuidePath::Arc { .. });
    let still = |g: hodograph_scene::GuideId| m.never_turns[scene.guides[g.0].on.0];
    let guide = |guide| TermConnection::Guide { guide, driver: None };
    let even =
        |g| scene.drivers.iter().any(|d| d.kind.guide() == Some(g) && d.acceleration.is_none());
    let level = what.level();
    match what.meaning(scene)? {
        Meaning::Vector(p) => whole(&p, false),
        Meaning::Relative(RelativeComponent::Whole, a, b) if fixed(&b) => whole(&a, false),
        Meaning::Relative(RelativeComponent::Whole, a, b) if fixed(&a) => whole(&b, true),
        Meaning::Relative(RelativeComponent::Whole, a, b) => match joined(scene, &a, &b) {
            Some(PointJoint::Guide(g)) if level == Level::Velocity || (still(g) && !arc(g)) => {
                terms(&a, &b, &[Slide], guide(g))
            }
            Some(PointJoint::Guide(g)) => terms(&a, &b, &[Relative], guide(g)),
            Some(PointJoint::Cylinder(d)) => {
                terms(&a, &b, &[Relative], TermConnection::Cylinder(d))
            }
            Some(PointJoint::Link(l)) => {
                terms(&a, &b, &[Relative], TermConnection::Turning(body_of(scene, m, l)))
            }
            None => terms(&a, &b, &[Relative], TermConnection::Apart),
        },
        Meaning::Relative(part @ (RelativeComponent::Along | RelativeComponent::Across), a, b) => {
            let kind = if part == RelativeComponent::Along { Normal } else { Tangential };
            match joined(scene, &a, &b)? {
                PointJoint::Link(l) => {
                    terms(&a, &b, &[kind], TermConnection::Turning(body_of(scene, m, l)))
                }
                PointJoint::Cylinder(d) => {
                    terms(&a, &b, &[kind], TermConnection::Turning(TurningBody::Cylinder(d)))
                }
                PointJoint::Guide(_) => None,
            }
        }
        Meaning::Relative(RelativeComponent::Sliding, a, b) => {
            match (joined(scene, &a, &b)?, level) {
                (PointJoint::Guide(g), Level::Position | Level::Velocity) => {
                    terms(&a, &b, &[Slide], guide(g))
                }
                // A slide driven at a constant rate has no acceleration along its path.
                (PointJoint::Guide(g), Level::Acceleration) => match (arc(g), even(g)) {
                    (true, true) => terms(&a, &b, &[SlideNormal], guide(g)),
                    (true, false) => terms(&a, &b, &[SlideNormal, Slide], guide(g)),
                    (false, true) => None,
                    (false, false) => terms(&a, &b, &[Slide], guide(g)),
                },
                (PointJoint::Cylinder(d), Level::Acceleration)
                    if scene.drivers[d].acceleration.is_none() =>
                {
                    None
                }
                (PointJoint::Cylinder(d), _) => {
                    terms(&a, &b, &[Extension], TermConnection::Cylinder(d))
                }
                (PointJoint::Link(_), _) => None,
            }
        }
        Meaning::Relative(RelativeComponent::Coriolis, a, b) => match joined(scene, &a, &b)? {
            PointJoint::Guide(g) => terms(&a, &b, &[Coriolis], guide(g)),
            PointJoint::Cylinder(d) => terms(&a, &b, &[Coriolis], TermConnection::Cylinder(d)),
            PointJoint::Link(_) => None,
        },
        Meaning::Relative(
            part @ (RelativeComponent::SlidingNormal | RelativeComponent::SlidingTangential),
            a,
            b,
        ) => match joined(scene, &a, &b)? {
            PointJoint::Guide(g) if part == RelativeComponent::SlidingNormal => {
                if arc(g) {
                    terms(&a, &b, &[SlideNormal], guide(g))
                } else {
                    None
                }
            }
            PointJoint::Guide(g) => {
                if even(g) {
                    None
                } else {
                    terms(&a, &b, &[Slide], guide(g))
                }
            }
            PointJoint::Cylinder(_) | PointJoint::Link(_) => None,
        },
        Meaning::Seen(seen, a, frame, about) => {
            let body = match frame {
                Frame::Link(l) if !m.never_turns[l.0] => Some(body_of(scene, m, l)),
                Frame::Link(_) | Frame::Point(_) => None,
            };
            let (seat, by) = (frame.transport_point(a), TermConnection::Frame { body, about });
            match (seen, body, about) {
                (ObservedPart::Relative, _, Some(_)) => terms(&a, &seat, &[SlideNormal, Slide], by),
                // In a translating frame, the relative motion is that of one point relative to the
                // other.
                (ObservedPart::Relative, None, None) => {
                    terms(&a, &seat, &[Relative], TermConnection::Apart)
                }
                (ObservedPart::Relative, Some(_), None) => terms(&a, &seat, &[Slide], by),
                (ObservedPart::Coriolis, Some(_), _) => terms(&a, &seat, &[Coriolis], by),
                (ObservedPart::RelativeNormal, _, Some(_)) => terms(&a, &seat, &[SlideNormal], by),
                (ObservedPart::RelativeTangential, _, Some(_)) => terms(&a, &seat, &[Slide], by),
                (ObservedPart::Coriolis, None, _) => None,
                // Parts along a path that no pair gives are calculated.
                (
                    ObservedPart::RelativeNormal
                    | ObservedPart::RelativeTangential
                    | ObservedPart::TransportNormal
                    | ObservedPart::TransportTangential,
                    ..,
                ) => None,
            }
        }
        Meaning::Place(_) | Meaning::Turning(..) | Meaning::Ratio(..) => None,
    }
}

impl Term {
    /// Returns `Some(false)` if two terms are the same vector, `Some(true)` if they are opposite,
    /// with their points exchanged. The driver of a sliding does not matter.
    pub fn is_same(&self, other: &Term) -> Option<bool> {
        let by = match (self.by, other.by) {
            (TermConnection::Guide { guide: g, .. }, TermConnection::Guide { guide: h, .. }) => {
                g == h
            }
            (a, b) => a == b,
        };
        match () {
            () if self.kind != other.kind || !by => None,
            () if (self.of, self.to) == (other.of, other.to) => Some(false),
            () if (self.of, self.to) == (other.to, other.of) => Some(true),
            () => None,
        }
    }
}

/// True if a row of drawn terms contains these terms, one after another.
fn holds(drawn: &[Term], wanted: &[Term]) -> bool {
    drawn.windows(wanted.len()).any(|w| {
        let same: Vec<Option<bool>> = w.iter().zip(wanted).map(|(t, u)| t.is_same(u)).collect();
        same[0].is_some() && same.iter().all(|s| *s == same[0])
    })
}

/// Returns the edges that a step draws, chain by chain: several unknown terms along one line are a
/// single edge, and none of them is an edge by itself.
fn rows(step: &PlanStep) -> impl Iterator<Item = Vec<Term>> + '_ {
    step.chains().iter().map(|c| {
        let alone = if c.unknown.len() == 1 { &c.unknown[..] } else { &[] };
        c.known.iter().chain(alone).copied().collect()
    })
}

/// Returns the point if a question asks for a part of its acceleration.
fn parts_of(scene: &Scene, what: &Asked) -> Option<Need> {
    match what.meaning(scene)? {
        Meaning::Relative(RelativeComponent::Along | RelativeComponent::Across, a, _) => {
            Some(Need::Point(a.point, a.link))
        }
        Meaning::Relative(
            RelativeComponent::Whole
            | RelativeComponent::Sliding
            | RelativeComponent::SlidingNormal
            | RelativeComponent::SlidingTangential
            | RelativeComponent::Coriolis,
            ..,
        )
        | Meaning::Seen(..)
        | Meaning::Vector(_)
        | Meaning::Turning(..)
        | Meaning::Ratio(..)
        | Meaning::Place(_) => None,
    }
}

impl PlanBuilder<'_> {
    /// Moves points with wanted parts to the front of the points found after a group: an equation
    /// from a known point shows the parts, an image does not.
    pub(super) fn parts_first(&mut self) {
        let parts: Vec<Need> =
            self.scene.find.iter().flat_map(|f| parts_of(self.scene, &f.what)).collect();
        self.due.iter_mut().for_each(|due| due.sort_by_key(|(need, _)| !parts.contains(need)));
    }

    /// Writes the vectors drawn between images at a level: for angular quantities measured from a
    /// part, and for questions.
    pub(super) fn draw_between(&mut self, level: Level) {
        let measured: Vec<(usize, TurningBody, VertexId, VertexId)> = self
            .list(level)
            .iter()
            .flat_map(|g| {
                g.rates.iter().filter_map(|(body, rate)| match rate {
                    Rate::Measured { of, to } => Some((g.group, *body, *of, *to)),
                    Rate::Given { .. } | Rate::Same(_) | Rate::Zero => None,
                })
            })
            .collect();
        for (group, body, of, to) in measured {
            let kind = match (level, body) {
                (Level::Acceleration, _) => TermKind::Tangential,
                // The angular velocity of a cylinder's line follows from the part square to it;
                // that of a link from the whole vector.
                (_, TurningBody::Cylinder(_)) => TermKind::Relative,
                (_, TurningBody::Link(_)) => continue,
            };
            self.between(
                level,
                group,
                &[Term { kind, of, to, by: TermConnection::Turning(body), known: false }],
            );
        }
        let scene = self.scene;
        for find in scene.find.iter().filter(|f| f.what.level() == level) {
            for p in find.what.points(scene) {
                // A fixed point may not have a vertex yet.
                if p.link.map_or_else(
                    || scene.links[scene.ground.0].points.contains(&p.point),
                    |l| l == scene.ground,
                ) {
                    self.vertex_of(&p);
                }
            }
            let Some(Asking::Terms(terms)) = asking_of(scene, self.m, &self.vertices, &find.what)
            else {
                continue;
            };
            let nodes = find
                .what
                .points(scene)
                .into_iter()
                .flat_map(|p| nodes_of(scene, self.m, Need::Point(p.point, p.link)));
            let Some(group) = nodes.filter_map(|n| self.m.group_of(n)).max() else { continue };
            self.between(level, group, &terms);
        }
    }

    fn vertex_of(&mut self, p: &OnLink) -> VertexId {
        self.intern(VertexPlace::Point(p.point), canonical(self.scene, p.point, p.link))
    }

    pub(super) fn list(&mut self, level: Level) -> &mut Vec<GroupSteps> {
        let on = DiagramKind::of(level);
        let stage = self.stages.iter().position(|s| s.on == on).unwrap_or_else(|| {
            self.stages.push(PlanStage { on, groups: Vec::new() });
            self.stages.len() - 1
        });
        &mut self.stages[stage].groups
    }

    /// Draws terms between their two images after a group, unless an edge shows them already.
    fn between(&mut self, level: Level, group: usize, terms: &[Term]) {
        let Term { of, to, .. } = terms[0];
        let drawn = |g: &GroupSteps| {
            let in_all = !g.alternatives.is_empty()
                && g.alternatives.iter().all(|a| a.iter().flat_map(rows).any(|r| holds(&r, terms)));
            in_all
                || g.further.iter().flat_map(rows).any(|r| holds(&r, terms))
                || g.between.iter().any(|b| holds(&b.terms(), terms))
        };
        if !self.is_known(level, of)
            || !self.is_known(level, to)
            || self.list(level).iter().any(drawn)
        {
            return;
        }
        let term = |kind, by| Term { kind, of, to, by, known: false };
        let between = match (terms[0].kind, terms[0].by) {
            (TermKind::Relative, TermConnection::Turning(TurningBody::Cylinder(d)))
                if self.are_ends(d, of, to) =>
            {
                self.along_cylinder(level, d, of, to)
            }
            (TermKind::Relative, by) => Some(Between::Join(term(TermKind::Relative, by))),
            (_, TermConnection::Turning(TurningBody::Cylinder(d))) if self.are_ends(d, of, to) => {
                self.along_cylinder(level, d, of, to)
            }
            (_, TermConnection::Turning(TurningBody::Link(l))) if self.m.never_turns[l.0] => None,
            (_, by @ TermConnection::Turning(_)) => Some(Between::Perpendicular {
                normal: term(TermKind::Normal, by),
                tangential: term(TermKind::Tangential, by),
            }),
            (_, TermConnection::Cylinder(d)) => self.along_cylinder(level, d, of, to),
            (_, TermConnection::Guide { guide, .. }) => {
                let (known, rest) = self.sliding(level, guide, of, to, None);
                Some(match (&known[..], &rest[..]) {
                    ([], [slide]) => Between::Join(*slide),
                    _ => Between::LayOff { known, rest },
                })
            }
            (_, by @ TermConnection::Contact(_)) => Some(Between::Join(term(TermKind::Roll, by))),
            (_, by @ TermConnection::Frame { body, about }) => {
                let coriolis = body.map(|_| TermKind::Coriolis);
                let parts = coriolis.into_iter().chain(about.map(|_| TermKind::SlideNormal));
                Some(Between::LayOff {
                    known: parts.map(|kind| Term { known: true, ..term(kind, by) }).collect(),
                    rest: vec![term(TermKind::Slide, by)],
                })
            }
            (_, TermConnection::Apart) => None,
        };
        let Some(between) = between else { return };
        let entry = self.list(level).iter_mut().find(|s| s.group == group);
        if let Some(entry) = entry {
            entry.between.push(between);
        }
    }

    fn are_ends(&self, driver: usize, of: VertexId, to: VertexId) -> bool {
        let Some([a, b]) = self.scene.drivers[driver].kind.ends() else { return false };
        let spots = [self.vertices[of.0].spot, self.vertices[to.0].spot];
        spots == [a, b].map(VertexPlace::Point) || spots == [b, a].map(VertexPlace::Point)
    }

    fn along_cylinder(
        &mut self,
        level: Level,
        driver: usize,
        of: VertexId,
        to: VertexId,
    ) -> Option<Between> {
        let (VertexPlace::Point(near), VertexPlace::Point(far)) =
            (self.vertices[of.0].spot, self.vertices[to.0].spot)
        else {
            return None;
        };
        let chain = self.strut(level, near, far, Strut::Cylinder(driver));
        Some(Between::LayOff { known: chain.known, rest: chain.unknown })
    }

    /// True if a vertex has its image at a level.
    pub(super) fn is_known(&self, level: Level, v: VertexId) -> bool {
        self.vertices[v.0].fixed || self.known[slot(level)].contains(&v)
    }
}
