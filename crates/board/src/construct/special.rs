//! Lines on the diagram that guide links, and the special points at which two of them cross.

use super::board::{ActWriter, path_key, vertex_key};
use crate::construction::{Base, DiagramId, Direction, Line, LineId, MarkId, Name, Op};
use crate::plan::{Special, SpecialLine, VertexId};
use hodograph_mechanism::mechanism::ConstraintLine;
use hodograph_scene::{Normal, RollingId, Touch};

impl ActWriter<'_> {
    pub(super) fn special_point(
        &mut self,
        on: DiagramId,
        v: VertexId,
        special: &Special,
    ) -> Option<MarkId> {
        let lines =
            [self.special_line(on, &special.lines[0])?, self.special_line(on, &special.lines[1])?];
        let to = self.mark(on, Name::Image(vertex_key(v)));
        self.act(on, [Op::Meet { lines, to }]);
        Some(to)
    }

    /// Draws a line that guides a link.
    fn special_line(&mut self, on: DiagramId, line: &SpecialLine) -> Option<LineId> {
        Some(match *line {
            SpecialLine::Leg(line) => self.constraint_line(on, line),
            SpecialLine::Through { pin, special } => {
                let along =
                    Direction::of(Base::Marks(self.done.image(on, special)?, self.joint(pin)));
                self.held(on, self.joint(pin), along)
            }
        })
    }

    /// Draws the line on which a leg gives a locus for every point of the core.
    pub(super) fn constraint_line(&mut self, on: DiagramId, line: ConstraintLine) -> LineId {
        let pin = self.joint(line.pin());
        let along = match line {
            ConstraintLine::Along { far, .. } => Direction::of(Base::Marks(self.joint(far), pin)),
            ConstraintLine::Normal { guide, .. } => {
                Direction::of(Base::Normal(path_key(guide), pin))
            }
            ConstraintLine::Tangent { pair, .. } => {
                let normal = self.contact_normal(pair);
                Direction { quarters: (normal.quarters + 1) % 4, ..normal }
            }
        };
        self.held(on, pin, along)
    }

    fn held(&mut self, on: DiagramId, through: MarkId, along: Direction) -> LineId {
        let line = self.done.construction.line(Line {
            on,
            through,
            along,
            moved: false,
            carries: Vec::new(),
        });
        self.act(on, [Op::Rule(line)]);
        line
    }

    /// Returns the line of centres at a contact, as drawn; for a straight track and for a strand,
    /// its normal.
    pub(super) fn contact_normal(&self, pair: RollingId) -> Direction {
        let pair = &self.scene.rolling[pair.0];
        match pair.touch() {
            Touch::Point(Normal::Centres([a, b])) => {
                Direction::of(Base::Marks(self.joint(a), self.joint(b)))
            }
            Touch::Point(Normal::Square { guide, .. }) => {
                Direction::across(Base::Tangent(path_key(guide), None))
            }
            Touch::Strand { .. } => {
                Direction::across(Base::Marks(self.joint(pair.at[0]), self.joint(pair.at[1])))
            }
        }
    }
}
