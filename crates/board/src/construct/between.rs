//! Writes down the vectors between two images that a question or an angular rate reads, and decides in which order images, vectors and rates become known.

use super::board::Board;
use crate::construction::{DiagramId, Direction, Line, Op};
use crate::plan::{Between, Body, By, Rate, Term, TermKind};
use hodograph_scene::DiagramKind;

impl Board<'_> {
    /// What is drawn between images, as far as they are there, and the turnings measured from what is drawn. What cannot be read yet stays
    /// in `unread`, for a block is measured on points that a later group may bring.
    pub(super) fn read_off(&mut self, on: DiagramId, unread: &mut Vec<(Body, Rate)>, open: &mut Vec<&Between>) {
        loop {
            unread.retain(|(body, rate)| !self.turning(on, *body, *rate));
            let there = |b: &&Between| {
                let (of, to) = b.ends();
                self.done.image(on, of).is_some() && self.done.image(on, to).is_some() && self.knows_turnings(b)
            };
            let Some(next) = open.iter().position(there) else { return };
            let between = open.remove(next);
            // The alternative of the group that was drawn may show it.
            let terms = between.terms();
            let each = terms.iter().all(|t| self.vanishes(on, t) || self.done.edge_of(on, &[*t]).is_some());
            let shown = match between {
                // Where nothing moves there are no edges: each vector that would be drawn is told to be nothing.
                _ if self.stands(on) => false,
                Between::Join(_) | Between::Perpendicular { .. } => each,
                Between::LayOff { .. } => each && self.done.edge_of(on, &terms).is_some(),
            };
            if !shown {
                self.between(on, between);
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
            still || self.done.turning(DiagramKind::Velocity, b).is_some()
        })
    }

    /// Draws a vector, or the parts of one, between two images.
    fn between(&mut self, on: DiagramId, between: &Between) {
        let (of, to) = between.ends();
        let from = self.image(on, to);
        if self.stands(on) {
            let parts: Vec<Vec<Term>> = match between {
                Between::Join(t) => vec![vec![*t]],
                Between::Perpendicular { normal, tangential } => vec![vec![*normal, *tangential]],
                Between::LayOff { known, rest } => known.iter().map(|t| vec![*t]).chain([rest.clone()]).collect(),
            };
            for terms in parts.into_iter().filter(|terms| !terms.is_empty()) {
                self.omit(on, &terms, from, None);
            }
            return;
        }
        let end = self.image(on, of);
        match between {
            Between::Join(t) => {
                let joined = self.vector(&[*t], from, end, false, true);
                self.act(on, [Op::Show(joined)]);
            }
            Between::Perpendicular { normal, tangential } => {
                // Where a chain has laid aⁿ off from the same image, its end is the foot.
                if let Some(foot) = self.done.end_of(on, from, normal) {
                    let joined = self.vector(&[*tangential], foot, end, false, true);
                    self.act(on, [Op::Show(joined)]);
                    return;
                }
                let along = Direction::of(self.arm(of, to)).unit();
                let carries = vec![self.done.term(*normal)];
                let line = self.done.construction.line(Line { on, through: from, along, moved: false, carries });
                let foot = self.part(on, normal);
                let normal = self.vector(&[*normal], from, foot, false, true);
                let tangential = self.vector(&[*tangential], foot, end, false, true);
                let drop = Op::Foot { from: end, on: line, to: foot };
                self.act_of(on, (of, to), [Op::Rule(line), drop, Op::Show(normal), Op::Show(tangential)]);
            }
            Between::LayOff { known, rest } => {
                // What a chain has laid off from the same image stands already.
                let (mut at, mut open) = (from, &known[..]);
                while let Some((end, later)) = open.split_first().and_then(|(t, later)| Some((self.done.end_of(on, at, t)?, later))) {
                    (at, open) = (end, later);
                }
                let at = self.lay_off(on, at, open, None, true);
                if !rest.is_empty() {
                    let joined = self.vector(rest, at, end, false, true);
                    self.act(on, [Op::Show(joined)]);
                }
            }
        }
    }
}
