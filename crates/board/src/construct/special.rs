//! Lines on the diagram along which links are held, and the special points where two of them cross.

use super::Crossed;
use super::board::{Board, Line};
use super::choices::SPECIAL_LEGS;
use super::pencil::Pencil;
use crate::plan::{Special, SpecialLine, VertexId};
use hodograph_base::geom::{Point, Vec2, cross_lines};
use hodograph_base::number::Real;
use hodograph_mechanism::mechanism::{ConstraintLine, Core, Leg};
use hodograph_mechanism::position::Path;
use hodograph_scene::{DiagramKind, Normal, RollingId, Touch};

impl<N: Real, P: Pencil<N>> Board<'_, N, P> {
    pub(super) fn special_point(&mut self, v: VertexId, special: &Special) -> Option<Point<N>> {
        let [(p, u), (q, w)] = [self.special_line(&special.lines[0])?, self.special_line(&special.lines[1])?];
        let (u, w) = (self.laid(&special.lines[0], u), self.laid(&special.lines[1], w));
        let c = cross_lines(p, u, q, w);
        if !c.at.is_finite() {
            return None;
        }
        let alternative = special.legs.and_then(|legs| SPECIAL_LEGS.iter().position(|l| *l == legs));
        if alternative.is_none_or(|k| self.done.chosen[special.group] == k) {
            self.done.diagram.crossed.push(Crossed { target: v, sine: c.sine });
        }
        Some(self.pencil.mark(DiagramKind::Plane, c.at))
    }

    /// A line (on paper) along which a link is held.
    fn special_line(&self, line: &SpecialLine) -> Option<Line<N>> {
        match *line {
            SpecialLine::Leg(line) => self.line(line),
            SpecialLine::Through { pin, special } => {
                let p = self.joint(pin)?;
                Some((p, p - self.done.diagram.spots[special.0]?))
            }
        }
    }

    /// The line (on paper) on which a leg gives a locus for every point of the core.
    pub(super) fn constraint_line(&self, leg: &Leg) -> Option<Line<N>> {
        self.line(leg.line()?)
    }

    fn line(&self, line: ConstraintLine) -> Option<Line<N>> {
        let p = self.joint(line.pin())?;
        let along = match line {
            ConstraintLine::Along { far, .. } => p - self.joint(far)?,
            ConstraintLine::Normal { guide, .. } => match self.at.guide(guide) {
                Path::Line { direction, .. } => self.turned(guide, direction.perp()),
                Path::Arc { centre, .. } => self.turned(guide, p - self.paper(centre)),
            },
            ConstraintLine::Tangent { pair, .. } => self.contact_normal(pair)?.perp(),
        };
        Some((p, along))
    }

    pub(super) fn constraint_lines(&self, group: usize, legs: (usize, usize)) -> Option<(Line<N>, Line<N>)> {
        let Core::Link { legs: all, .. } = &self.m.groups[group].core else { return None };
        Some((self.constraint_line(&all[legs.0])?, self.constraint_line(&all[legs.1])?))
    }

    /// The line of centres at a contact, as drawn; of a straight track, and of a strand, its normal.
    pub(super) fn contact_normal(&self, pair: RollingId) -> Option<Vec2<N>> {
        let pair = &self.scene.rolling[pair.0];
        match pair.touch() {
            Touch::Point(Normal::Centres([a, b])) => Some(self.joint(b)? - self.joint(a)?),
            Touch::Point(Normal::Square { guide, .. }) => match self.at.guide(guide) {
                Path::Line { direction, .. } => Some(self.turned(guide, direction.perp())),
                Path::Arc { .. } => None,
            },
            Touch::Strand { .. } => Some((self.joint(pair.at[1])? - self.joint(pair.at[0])?).perp()),
        }
    }
}
