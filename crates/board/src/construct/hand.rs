//! Drawing by hand: a construction drawn again with a pencil that misses.
//!
//! What a draughtsman knows is not drawn but taken as known: the length of a link (two joints of one link), the radius of a slot, the rates of the
//! drivers, and μ. Everything else comes from paper: directions from the joints where they really lie, lengths that change (a
//! pin in its slot) from the diagram, shapes of links for images from the diagram, ω and α from the polygons.

use super::Construction;
use super::board::Board;
use super::layout::{Layout, drawn};
use super::pencil::Pencil;
use crate::plan::{Body, By, Plan, SpecialLine, Spot, Term, VertexId};
use hodograph_base::diag::Faults;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_mechanism::mechanism::{ConstraintLine, Mechanism};
use hodograph_mechanism::position::{Configuration, Path, Pose};
use hodograph_scene::{DiagramKind, GuideId, Normal, PointId, RollingId, Scene, Touch};

/// Draws a plan with a pencil, to given scales.
///
/// With it comes the configuration as the diagram shows it: joints where the pencil put them. With the exact pencil the construction
/// is that of [`construct`](super::construct()): in numbers that know their error, with a bound of what rounding does to
/// every mark.
///
/// # Errors
/// As [`construct`](super::construct()): a pencil may make two lines parallel.
pub fn by_hand<N: Real, P: Pencil<N>>(
    scene: &Scene,
    m: &Mechanism,
    at: &Configuration<N>,
    plan: &Plan,
    layout: &Layout,
    pencil: &mut P,
) -> Result<(Construction<N>, Configuration<N>), Faults> {
    let board = drawn(scene, m, at, plan, layout, pencil)?;
    let shown = board.shown();
    Ok((board.finish()?, shown))
}

/// What a blunt pencil made of the mechanism.
#[derive(Clone, Debug)]
pub(super) struct Hand<N> {
    /// Each joint where it lies (mm).
    joints: Vec<Option<Point<N>>>,
    /// For each guide the turn from its true direction, as (cos, sin).
    turns: Vec<Vec2<N>>,
}

impl<N> Default for Hand<N> {
    fn default() -> Self {
        Hand { joints: Vec::new(), turns: Vec::new() }
    }
}

impl<N: Real, P: Pencil<N>> Board<'_, N, P> {
    /// Draws every joint, and every guide through its runner.
    pub(super) fn draw_joints(&mut self) {
        if P::EXACT {
            return;
        }
        for p in 0..self.at.points.len() {
            let drawn = self.at.points[p].map(|q| self.paper(q)).map(|q| self.pencil.mark(DiagramKind::Plane, q));
            self.hand.joints.push(drawn);
        }
        for g in 0..self.at.guides.len() {
            let apart = self.guide_length(GuideId(g));
            let turn = self.pencil.ruler(DiagramKind::Plane, Vec2::unit_x(), apart);
            self.hand.turns.push(turn);
        }
    }

    /// A joint on the diagram.
    pub(super) fn joint(&self, p: PointId) -> Option<Point<N>> {
        if P::EXACT { self.at.points[p.0].map(|q| self.paper(q)) } else { self.hand.joints[p.0] }
    }

    /// A direction that goes with a guide, as the guide was drawn.
    pub(super) fn turned(&self, guide: GuideId, direction: Vec2<N>) -> Vec2<N> {
        if P::EXACT { direction } else { direction.rotate_by(self.hand.turns[guide.0]) }
    }

    /// The direction of a constraint line as a ruler takes it.
    pub(super) fn laid(&mut self, line: &SpecialLine, along: Vec2<N>) -> Vec2<N> {
        if P::EXACT {
            return along;
        }
        let apart = match *line {
            SpecialLine::Leg(ConstraintLine::Normal { guide, .. }) => self.guide_length(guide),
            SpecialLine::Leg(ConstraintLine::Along { .. } | ConstraintLine::Tangent { .. }) | SpecialLine::Through { .. } => {
                along.approx().norm()
            }
        };
        along.unit().map_or(along, |u| self.pencil.ruler(DiagramKind::Plane, u, apart))
    }

    /// How far apart the two marks lie from which the direction of a term is taken (mm): the joints of its arm, or the ends of the
    /// guide on the diagram.
    pub(super) fn drawn_length(&self, term: &Term) -> f64 {
        match term.by {
            _ if P::EXACT => 0.0,
            By::Turning(_) | By::Cylinder(_) => self.arm(term.of, term.to).approx().norm() / self.done.diagram.mu,
            By::Guide { guide, .. } => self.guide_length(guide),
            By::Contact(pair) => self.contact_length(pair),
            By::Frame { .. } | By::Apart => 0.0,
        }
    }

    /// How far apart two centres are drawn (mm); of a straight track how long it is drawn.
    fn contact_length(&self, pair: RollingId) -> f64 {
        match self.scene.rolling[pair.0].touch() {
            Touch::Point(Normal::Square { guide, .. }) => self.guide_length(guide),
            Touch::Point(Normal::Centres(_)) | Touch::Strand { .. } => self.contact_normal(pair).map_or(0.0, |n| n.approx().norm()),
        }
    }

    /// How long a guide is drawn (mm): from its runner to the farthest joint of the link that carries it, across the
    /// diagram where there is none; for an arc its radius, square to which it runs.
    fn guide_length(&self, guide: GuideId) -> f64 {
        let diagram = self.at.extent() / self.done.diagram.mu;
        let g = &self.scene.guides[guide.0];
        let Some(path) = self.at.guides[guide.0] else { return diagram };
        if let Path::Arc { radius, .. } = path {
            return radius.approx() / self.done.diagram.mu;
        }
        let runner = match (g.pin, g.slider) {
            (Some(p), _) => self.at.points[p.0],
            (None, Some(s)) => self.at.poses[s.0].map(|pose| pose.origin),
            (None, None) => None,
        };
        let joints = self.scene.links[g.on.0].points.iter().filter_map(|p| self.at.points[p.0]).map(Point::approx);
        let farthest = runner.map(Point::approx).map_or(0.0, |r| joints.map(|j| j.distance(r)).fold(0.0, f64::max)) / self.done.diagram.mu;
        if farthest > 0.0 { farthest } else { diagram }
    }

    /// The arm on which a body turns, in metres: its direction from the diagram, its length from the body where both ends
    /// are joints of it.
    pub(super) fn arm_of(&self, body: Body, of: VertexId, to: VertexId) -> Vec2<N> {
        let drawn = self.arm(of, to);
        if P::EXACT {
            return drawn;
        }
        match (drawn.unit(), self.known_length(body, of, to)) {
            (Some(u), Some(length)) => u * length,
            _ => drawn,
        }
    }

    fn known_length(&self, body: Body, of: VertexId, to: VertexId) -> Option<N> {
        let point = |v: VertexId| match self.plan.vertex(v).spot {
            Spot::Point(p) => Some(p),
            Spot::Special(_) => None,
        };
        let (p, q) = (point(of)?, point(to)?);
        let known = match body {
            Body::Link(l) => [p, q].iter().all(|x| self.scene.links[l.0].points.contains(x)),
            Body::Cylinder(d) => self.scene.drivers[d].kind.ends().is_some_and(|[a, b]| (a, b) == (p, q) || (b, a) == (p, q)),
        };
        if known { Some(self.at.points[p.0]?.distance(self.at.points[q.0]?)) } else { None }
    }

    /// The configuration as the diagram shows it.
    pub(super) fn shown(&self) -> Configuration<N> {
        let mut shown = self.at.clone();
        if P::EXACT {
            return shown;
        }
        let d = &self.done.diagram;
        for (place, joint) in shown.points.iter_mut().zip(&self.hand.joints) {
            *place = joint.map(|q| d.origin + q.to_vec2() * self.mu);
        }
        // A link without two joints shows its angle by its guide.
        for (guide, turn) in self.scene.guides.iter().zip(&self.hand.turns) {
            for l in [Some(guide.on), guide.slider].into_iter().flatten().filter(|l| *l != self.scene.ground) {
                if self.scene.links[l.0].points.len() < 2
                    && let Some(pose) = self.at.poses[l.0]
                {
                    shown.poses[l.0] = Some(Pose { axis: pose.axis.rotate_by(*turn), ..pose });
                }
            }
        }
        shown
    }
}
