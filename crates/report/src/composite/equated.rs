//! Two frames of one moving point, set equal and projected.

use super::{CompositeWords, projected_sum, symbol};
use hodograph_base::digits::{direction_degrees, inked, significant};
use hodograph_base::lang::say;
use hodograph_board::plan::names::name_label;
use hodograph_methods::composite::{
    ChoiceSolution, EquatedFrames, EquatedProjection, equated, name_of,
};
use hodograph_paper::paper::phrase::Phrase;
use hodograph_scene::DiagramKind;
use hodograph_scene::quantity::Frame;
use hodograph_scene::quantity::composite::CompositePart;

impl CompositeWords<'_> {
    /// Returns the lines on frames that only together determine the motion of their moving point:
    /// the equation of both, and its projections. Empty if there are none.
    pub fn equated(&self, solved: &[ChoiceSolution]) -> Vec<Phrase> {
        equated(solved).iter().flat_map(|e| self.frames(e, solved)).collect()
    }

    fn frames(&self, e: &EquatedFrames, solved: &[ChoiceSolution]) -> Vec<Phrase> {
        let both = e.of.map(|k| &solved[k]);
        let point = name_label(&name_of(self.scene, &both[0].choice.of));
        let mut out = vec![Phrase::new(&say!(
            self.lang,
            "Each equation alone has three unknowns; both give the motion of the same point ${point}$:"
        ))];
        for of in DiagramKind::POLYGONS {
            let of_level: Vec<&EquatedProjection> =
                e.projections.iter().filter(|p| p.of == of).collect();
            if of_level.is_empty() {
                continue;
            }
            let sides = both.map(|s| {
                let symbol = |part| self.notation.vectors.write(self.in_frame(s, part, of));
                let parts: Vec<String> = parts(s, of).into_iter().map(symbol).collect();
                parts.join(" + ")
            });
            out.push(Phrase::new(&format!("${}$", sides.join(" = "))));
            out.extend(of_level.iter().map(|p| self.equated_projection(p, both)));
        }
        out
    }

    fn equated_projection(&self, p: &EquatedProjection, both: [&ChoiceSolution; 2]) -> Phrase {
        let relative = match p.of {
            DiagramKind::Acceleration => CompositePart::RelativeTangential,
            DiagramKind::Plane | DiagramKind::Velocity | DiagramKind::Force => {
                CompositePart::RelativeVelocity
            }
        };
        let [wanted, other] =
            [p.wanted, 1 - p.wanted].map(|k| self.in_frame(both[k], relative, p.of));
        let degrees = inked(&significant(direction_degrees(p.line.angle()), 4));
        let sides: Vec<String> = p
            .terms
            .iter()
            .zip(both)
            .map(|(terms, s)| {
                projected_sum(terms.iter().map(|(part, a)| (self.in_frame(s, *part, p.of), *a)))
            })
            .collect();
        let words = say!(
            self.lang,
            "Projected on the perpendicular to ${other}$ (${degrees}$°) for ${wanted}$:"
        );
        Phrase::new(&self.projected(&words, &sides.join(" = ")))
    }

    /// Returns the symbol of a part with the name of its frame.
    fn in_frame(&self, s: &ChoiceSolution, part: CompositePart, on: DiagramKind) -> String {
        let frame = match s.choice.frame {
            Frame::Link(l) => name_label(self.scene.link_name(l)),
            Frame::Point(p) => name_label(&name_of(self.scene, &p)),
        };
        let bare = symbol(Some(part), on, self.notation);
        format!("{}{frame}}}", bare.strip_suffix('}').unwrap_or(&bare))
    }
}

/// Returns the parts of the motion in one frame, in the order of the equation.
fn parts(s: &ChoiceSolution, of: DiagramKind) -> Vec<CompositePart> {
    match of {
        DiagramKind::Acceleration => s.acceleration.iter().filter_map(|(part, _)| *part).collect(),
        DiagramKind::Plane | DiagramKind::Velocity | DiagramKind::Force => {
            vec![CompositePart::TransportVelocity, CompositePart::RelativeVelocity]
        }
    }
}
