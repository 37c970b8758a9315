//! Closed vectors over a mechanism.

use hodograph_base::geom::{Point, Vec2};
use hodograph_base::notation::Notation;
use hodograph_paper::paper::drawing::DrawingPart;
use hodograph_paper::paper::item::{LineStroke, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::style::Style;
use hodograph_scene::Scene;
use hodograph_worked::worked::Worked;
use std::f64::consts::TAU;

use super::composed::{BARS, SHORTEST_MM};
use super::{MechanismDraft, SeriesFeatures};

/// Radius of the arc of an angle, and length of the line from which it is measured.
const ARC_MM: f64 = 7.0;
const AXIS_MM: f64 = 11.0;

/// Distance of a head from the end of its vector, and the largest part of the vector.
const HEAD_OFF_MM: f64 = 1.0;
const HEAD_OFF_PART: f64 = 0.2;

/// A vector between two places of the mechanism.
pub struct LoopArrow {
    /// The symbol of its length in the label language.
    pub symbol: String,
    /// The name, for ids.
    pub key: String,
    /// Its ends (m).
    pub places: [Point; 2],
    /// The symbol of its angle, if the angle is drawn, and the angle from the x axis (rad).
    pub angle: Option<(String, f64)>,
    /// The step of the construction that draws it.
    pub step: Option<usize>,
}

/// Draws the mechanism with closed vectors, each with its length and its angle from the x axis.
pub fn looped(
    style: &Style,
    scene: &Scene,
    worked: &Worked,
    notation: &Notation,
    arrows: &[LoopArrow],
) -> DrawingPart {
    let alone = SeriesFeatures::default();
    // A vector along a bar would be invisible on a dark bar.
    let style = &Style { link: style.link.coloured(BARS), ..style.clone() };
    let mut draft = MechanismDraft::new(style, scene, worked, notation, &alone);
    draft.constructed = false;
    draft.everything();
    draft.numbers();
    for a in arrows {
        draft.closed_vector(a);
    }
    draft.d.finish()
}

impl MechanismDraft<'_> {
    pub(super) fn closed_vector(&mut self, a: &LoopArrow) {
        let style = self.style;
        let [from, to] = a.places.map(|p| self.paper(p));
        let length = (to - from).norm();
        if length < SHORTEST_MM {
            return;
        }
        self.d.at_step(a.step);
        let stroke = LineStroke { width_mm: style.vector.width_mm * 1.2, ..style.vector };
        let name = format!("loop-{}", a.key);
        // The head ends at the ring of a joint, not in it.
        let tip = to + (from - to) * (HEAD_OFF_MM / length).min(HEAD_OFF_PART);
        let shape = Shape::Arrow { from, to: tip, stroke, head: style.head };
        let owner = self.d.shape(&name, "vector", shape);
        let label = Label::math(&a.symbol);
        let request = LabelRequest::along(label, style.label_mm, from, to, stroke.width_mm / 2.0);
        self.d.label(&name, "vector", request.owned(owner));
        let Some((symbol, angle)) = &a.angle else { return };
        let angle = angle.rem_euclid(TAU);
        // The arc takes the shorter way round.
        let angle = if angle > TAU / 2.0 { angle - TAU } else { angle };
        let name = format!("angle-{}", a.key);
        let axis = from + Vec2::new(AXIS_MM, 0.0);
        let thin = style.thin;
        self.d.shape(&format!("{name}-axis"), "axis", Shape::Line { from, to: axis, stroke: thin });
        let arc = Shape::Arc {
            centre: from,
            radius_mm: ARC_MM,
            from_rad: 0.0,
            to_rad: angle,
            stroke: thin,
        };
        let owner = self.d.shape(&name, "angle", arc);
        let request = LabelRequest::along_arc(
            Label::math(symbol),
            style.small_mm,
            from,
            ARC_MM,
            [0.0, angle],
            thin.width_mm / 2.0,
        );
        self.d.label(&name, "angle", request.owned(owner));
    }
}
