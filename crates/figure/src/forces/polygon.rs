//! Draws the force polygon of a group. Items carry the class `step-N` of the step that draws them;
//! step 0 is the first one after the links are separated.

use super::ForcePage;
use hodograph_base::geom::Point;
use hodograph_board::construction::{MarkId, Op};
use hodograph_board::equilibrium::{Act, ForceEdge, GroupForces};
use hodograph_paper::paper::drawing::Drawing;
use hodograph_paper::paper::item::{Dash, LineStroke, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::shown::ShownQuantity;
use hodograph_paper::paper::symbols;

/// Below this length a force has neither a visible head nor a visible direction.
const SHORTEST_MM: f64 = 0.3;
/// Extension of a line of known direction beyond the vertex in which it crosses another.
const BEYOND_MM: f64 = 5.0;

impl ForcePage<'_> {
    pub(super) fn polygon(&self, group: &GroupForces) -> Drawing {
        let style = self.style();
        let mut d = Drawing::new("force", style.clone());
        // Lines of known direction, a little longer than the vectors on them.
        for (line, mark) in self.crossed(group) {
            let class = format!("direction{}", self.step(group, |act| *act == Act::Cross(mark)));
            d.shape(
                "direction",
                &class,
                Shape::Line { from: line[0], to: line[1], stroke: style.thin },
            );
        }
        let mut drawn: Vec<[Point; 2]> = Vec::new();
        for (side, diagonal) in
            group.sides.iter().map(|s| (s, false)).chain(group.diagonals.iter().map(|s| (s, true)))
        {
            self.arrow(&mut d, (group, side), diagonal, &mut drawn);
        }
        for (mark, letter) in self.w.letters(group) {
            let Some(at) = self.of.drawn.marks[mark.index()] else { continue };
            let ends_in = |act: &Act| match act {
                Act::Lay(side) => self.of.construction.vectors[side.vector.index()].to == mark,
                Act::Cross(to) => *to == mark,
                Act::Free | Act::Friction | Act::Moments(_) | Act::Read(_) => false,
            };
            let step = self.step(group, ends_in);
            d.draw(&format!("vertex-{letter}"), &format!("vertex{step}"), symbols::dot(style, at));
            let request = LabelRequest::at_point(
                Label::math(&letter),
                style.label_mm,
                at,
                style.dot_radius_mm,
            );
            d.label(&letter, &format!("point{step}"), request);
            d.mark(&letter, ShownQuantity::mark(letter.clone()), at);
        }
        d
    }

    fn arrow(
        &self,
        d: &mut Drawing,
        (group, side): (&GroupForces, &ForceEdge),
        diagonal: bool,
        drawn: &mut Vec<[Point; 2]>,
    ) {
        let style = self.style();
        let Some([from, to]) = self.of.vector_mm(side.vector) else { return };
        if from.distance(to) <= SHORTEST_MM {
            return;
        }
        // Two names of one vector share one arrow; an internal reaction and its opposite share one
        // line.
        let same = |ends: &[Point; 2]| {
            ends[0].distance(from) < SHORTEST_MM && ends[1].distance(to) < SHORTEST_MM
        };
        let opposite = |ends: &[Point; 2]| {
            ends[1].distance(from) < SHORTEST_MM && ends[0].distance(to) < SHORTEST_MM
        };
        if drawn.iter().any(|ends| same(ends) || diagonal && opposite(ends)) {
            return;
        }
        drawn.push([from, to]);
        let whole = self.stroke(side.term);
        let stroke = if diagonal {
            LineStroke { width_mm: whole.width_mm * 0.7, ..whole }.dashed(Dash::DashDot)
        } else {
            whole
        };
        let key = self.key(side.term);
        let shown = ShownQuantity::vector(self.w.plain(side.term), from, to, self.of.mu());
        let step = self.step(
            group,
            |act| matches!(act, Act::Lay(own) | Act::Read(own) if own.vector == side.vector),
        );
        let class = &format!("{}{step}", if diagonal { "diagonal" } else { "side" });
        let owner =
            d.vector(&key, class, Shape::Arrow { from, to, stroke, head: style.head }, shown);
        let request = LabelRequest::along(
            Label::math(self.w.symbol(side.term)),
            style.label_mm,
            from,
            to,
            stroke.width_mm / 2.0,
        );
        d.label(&key, class, request.owned(owner));
    }

    /// The crossing lines of the group's vertices: each from the vertex that it is drawn through to
    /// beyond the crossing, with the vertex in which it crosses.
    fn crossed(&self, group: &GroupForces) -> Vec<([Point; 2], MarkId)> {
        let c = &self.of.construction;
        let mut out = Vec::new();
        for step in c.steps.iter().filter(|s| s.on == group.diagram) {
            for op in c.ops(step) {
                let Op::Meet { lines, to } = op else { continue };
                let Some(at) = self.of.drawn.marks[to.index()] else { continue };
                for line in lines {
                    let Some(from) = self.of.drawn.marks[c.lines[line.index()].through.index()]
                    else {
                        continue;
                    };
                    let Some(u) = (at - from).unit() else { continue };
                    out.push(([from - u * BEYOND_MM, at + u * BEYOND_MM], *to));
                }
            }
        }
        out
    }
}
