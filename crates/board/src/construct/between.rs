//! Draws the vectors between two images that a question or an angular rate reads, and decides in which order images, vectors and rates become known.

use super::board::{Board, part_mark};
use super::pencil::Pencil;
use super::{Action, Edge, Polygon};
use crate::plan::{Between, Body, By, Rate, Term, TermKind};
use hodograph_base::diag::Faults;
use hodograph_base::number::Real;
use hodograph_scene::DiagramKind;

impl<N: Real, P: Pencil<N>> Board<'_, N, P> {
    /// What is drawn between images, as far as they are there, and the turnings measured from what is drawn. What cannot be read yet stays
    /// in `unread`, for a block is measured on points that a later group may bring.
    pub(super) fn read_off(&mut self, p: &mut Polygon<N>, unread: &mut Vec<(Body, Rate)>, open: &mut Vec<&Between>) -> Result<(), Faults> {
        loop {
            unread.retain(|(body, rate)| !self.turning(p, *body, *rate));
            let there = |b: &&Between| {
                let (of, to) = b.ends();
                p.images[of.0].is_some() && p.images[to.0].is_some() && self.knows_turnings(b)
            };
            let Some(next) = open.iter().position(there) else { return Ok(()) };
            let between = open.remove(next);
            // The alternative of the group that was drawn may show it.
            let terms = between.terms();
            let each = terms.iter().all(|t| self.plan.vanishes(self.scene, p.on, t) || p.edge_of(&[*t]).is_some());
            let shown = match between {
                // Where nothing moves there are no edges: each vector that would be drawn is told to be nothing.
                _ if self.stands(p.on) => false,
                Between::Join(_) | Between::Perpendicular { .. } => each,
                Between::LayOff { .. } => each && p.edge_of(&terms).is_some(),
            };
            if !shown {
                self.between(p, between)?;
            }
        }
    }

    /// Whether the angular rates that a vector between two images is laid off with are read already.
    fn knows_turnings(&self, between: &Between) -> bool {
        let Between::LayOff { known, .. } = between else { return true };
        let by_omega = |t: &&Term| matches!(t.kind, TermKind::Normal | TermKind::Coriolis);
        let body = |t: &Term| match t.by {
            By::Turning(body) => Some(body),
            By::Guide { guide, .. } => Some(Body::Link(self.scene.guides[guide.0].on)),
            By::Cylinder(d) => Some(Body::Cylinder(d)),
            By::Frame { body, .. } => body,
            By::Contact(_) | By::Apart => None,
        };
        known.iter().filter(by_omega).filter_map(body).all(|b| {
            let still = matches!(b, Body::Link(l) if self.m.never_turns[l.0]);
            still || self.done.rate(DiagramKind::Velocity, b).is_some()
        })
    }

    /// Draws a vector, or the parts of one, between two images.
    fn between(&mut self, p: &mut Polygon<N>, between: &Between) -> Result<(), Faults> {
        let (of, to) = between.ends();
        let from = (self.mark(to), self.image(p, to));
        if self.stands(p.on) {
            let parts: Vec<Vec<Term>> = match between {
                Between::Join(t) => vec![vec![*t]],
                Between::Perpendicular { normal, tangential } => vec![vec![*normal, *tangential]],
                Between::LayOff { known, rest } => known.iter().map(|t| vec![*t]).chain([rest.clone()]).collect(),
            };
            let told = parts.into_iter().filter(|terms| !terms.is_empty());
            p.actions.extend(told.map(|terms| Action::Nothing { terms, at: from.1, target: None }));
            return Ok(());
        }
        let end = (self.mark(of), self.image(p, of));
        let edge = |terms: Vec<Term>, from, to, known| Edge { terms, from, to, known, between: true };
        match between {
            Between::Join(t) => {
                p.edges.push(edge(vec![*t], from, end, false));
                p.actions.push(Action::Join(p.edges.len() - 1));
            }
            Between::Perpendicular { normal, tangential } => {
                // Where a chain has laid aⁿ off from the same image, its end is the foot.
                if let Some(foot) = p.end_of(&from.0, normal) {
                    p.edges.push(edge(vec![*tangential], foot, end, false));
                    p.actions.push(Action::Join(p.edges.len() - 1));
                    return Ok(());
                }
                let u = self.arm(of, to).unit().ok_or_else(|| Faults::from(self.coincide(of, to)))?;
                let apart = self.drawn_length(normal);
                let u = self.pencil.ruler(p.on, u, apart);
                let foot = self.pencil.mark(p.on, from.1 + u * u.dot(end.1 - from.1));
                let foot = (part_mark(p, normal), foot);
                p.edges.push(edge(vec![*normal], from, foot, false));
                p.edges.push(edge(vec![*tangential], foot, end, false));
                p.actions.push(Action::Perpendicular { edges: [p.edges.len() - 2, p.edges.len() - 1], direction: u });
            }
            Between::LayOff { known, rest } => {
                // What a chain has laid off from the same image stands already.
                let (mut at, mut open) = (from, &known[..]);
                while let Some((end, later)) = open.split_first().and_then(|(t, later)| Some((p.end_of(&at.0, t)?, later))) {
                    (at, open) = (end, later);
                }
                let first = p.edges.len();
                let at = self.lay_off(p, at, open, None)?;
                p.edges[first..].iter_mut().for_each(|e| e.between = true);
                if !rest.is_empty() {
                    p.edges.push(edge(rest.clone(), at, end, false));
                    p.actions.push(Action::Join(p.edges.len() - 1));
                }
            }
        }
        Ok(())
    }
}
