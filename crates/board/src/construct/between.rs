//! Writes the vectors between two images that a question or an angular velocity or acceleration
//! reads, and decides the order in which images, vectors and rates become known.

use super::board::ActWriter;
use crate::construction::{DiagramId, Direction, Line, Op};
use crate::plan::{Between, Rate, Term, TermConnection, TermKind, TurningBody};
use hodograph_scene::DiagramKind;

impl ActWriter<'_> {
    /// Draws the vectors between existing images, and measures the angular quantities that follow
    /// from them. Rates that cannot be measured yet stay in `unread`: a block is measured on points
    /// that a later group may find.
    pub(super) fn read_off(
        &mut self,
        on: DiagramId,
        unread: &mut Vec<(TurningBody, Rate)>,
        open: &mut Vec<&Between>,
    ) {
        loop {
            unread.retain(|(body, rate)| !self.turning(on, *body, *rate));
            let there = |b: &&Between| {
                let (of, to) = b.ends();
                self.done.image(on, of).is_some()
                    && self.done.image(on, to).is_some()
                    && self.knows_turnings(b)
            };
            let Some(next) = open.iter().position(there) else { return };
            let between = open.remove(next);
            // The drawn alternative of the group may already show it.
            let terms = between.terms();
            let each = terms
                .iter()
                .all(|t| self.vanishes(on, t) || self.done.edge_of(on, &[*t]).is_some());
            let shown = match between {
                // If nothing moves there are no edges: each vector is recorded as zero.
                _ if self.stands(on) => false,
                Between::Join(_) | Between::Perpendicular { .. } => each,
                Between::LayOff { .. } => each && self.done.edge_of(on, &terms).is_some(),
            };
            if !shown {
                self.between(on, between);
            }
        }
    }

    /// True if the angular quantities needed to lay off a vector between two images are already
    /// measured.
    fn knows_turnings(&self, between: &Between) -> bool {
        let Between::LayOff { known, .. } = between else { return true };
        let by_omega = |t: &&Term| matches!(t.kind, TermKind::Normal | TermKind::Coriolis);
        let body = |t: &Term| match t.by {
            TermConnection::Turning(body) => Some(body),
            TermConnection::Guide { guide, .. } => {
                Some(TurningBody::Link(self.scene.guides[guide.0].on))
            }
            TermConnection::Cylinder(d) => Some(TurningBody::Cylinder(d)),
            TermConnection::Frame { body, .. } => body,
            TermConnection::Contact(_) | TermConnection::Apart => None,
        };
        known.iter().filter(by_omega).filter_map(body).all(|b| {
            let still = matches!(b, TurningBody::Link(l) if self.m.never_turns[l.0]);
            still || self.done.turning(DiagramKind::Velocity, b).is_some()
        })
    }

    /// Draws a vector, or its parts, between two images.
    fn between(&mut self, on: DiagramId, between: &Between) {
        let (of, to) = between.ends();
        let from = self.image(on, to);
        if self.stands(on) {
            let parts: Vec<Vec<Term>> = match between {
                Between::Join(t) => vec![vec![*t]],
                Between::Perpendicular { normal, tangential } => vec![vec![*normal, *tangential]],
                Between::LayOff { known, rest } => {
                    known.iter().map(|t| vec![*t]).chain([rest.clone()]).collect()
                }
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
                // If a chain has laid off aⁿ from the same image, its end is the foot.
                if let Some(foot) = self.done.end_of(on, from, normal) {
                    let joined = self.vector(&[*tangential], foot, end, false, true);
                    self.act(on, [Op::Show(joined)]);
                    return;
                }
                let along = Direction::of(self.arm(of, to)).unit();
                let carries = vec![self.done.term(*normal)];
                let line = self.done.construction.line(Line {
                    on,
                    through: from,
                    along,
                    moved: false,
                    carries,
                });
                let foot = self.part(on, normal);
                let normal = self.vector(&[*normal], from, foot, false, true);
                let tangential = self.vector(&[*tangential], foot, end, false, true);
                let drop = Op::Foot { from: end, on: line, to: foot };
                self.act_of(
                    on,
                    (of, to),
                    [Op::Rule(line), drop, Op::Show(normal), Op::Show(tangential)],
                );
            }
            Between::LayOff { known, rest } => {
                // Vectors that a chain has laid off from the same image are already drawn.
                let (mut at, mut open) = (from, &known[..]);
                while let Some((end, later)) = open
                    .split_first()
                    .and_then(|(t, later)| Some((self.done.end_of(on, at, t)?, later)))
                {
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
