//! A formula on a line of its own: fractions about the axis, roots that grow with their contents.

use crate::geom::Point;
use crate::paper::extent::bounds;
use crate::paper::font::own::Fonts;
use crate::paper::item::{Anchor, FigureItem, LineStroke, Shape};
use crate::paper::label::Label;
use crate::paper::text;
use crate::render::math::Math;

use super::pages::line;

/// The line of a fraction, as in the MATH table of STIX Two Math: height over the baseline and
/// thickness, in em.
const AXIS_EM: f64 = 0.258;
const RULE_EM: f64 = 0.068;
/// Gap between a fraction's line and its numerator and denominator, and between a root's bar and
/// its contents.
const GAP_EM: f64 = 0.16;

/// A display formula: items about its baseline, and the space above and below.
pub(super) struct Built {
    pub items: Vec<FigureItem>,
    pub above: f64,
    pub below: f64,
}

/// Sets a formula with an em of `em` mm.
pub(super) fn built(parts: &[Math], em: f64, fonts: &Fonts) -> Built {
    let mut out = Built { items: Vec::new(), above: em, below: 0.3 * em };
    let mut x = 0.0;
    let rule = |from: f64, to: f64, y: f64| {
        let shape = Shape::Line {
            from: Point::new(from, y),
            to: Point::new(to, y),
            stroke: LineStroke::new(RULE_EM * em),
        };
        FigureItem::new("rule", shape)
    };
    let set = |label: &Label| label.clone().in_fonts(fonts);
    for part in parts {
        match part {
            Math::Row(label) => {
                let label = &set(label);
                out.items.push(line(label, Point::new(x, 0.0), em, Anchor::Start));
                x += text::set(label).width_em * em;
            }
            Math::Fraction(over, under) => {
                let [over, under] = &[over, under].map(set);
                let [top, bottom] = [over, under].map(text::set);
                let wide = top.width_em.max(bottom.width_em) * em + 0.2 * em;
                x += 0.1 * em;
                let middle = x + wide / 2.0;
                let up = AXIS_EM + GAP_EM + top.descent_em.max(0.0);
                let down = GAP_EM + bottom.ascent_em - AXIS_EM;
                out.items.push(line(over, Point::new(middle, up * em), em, Anchor::Middle));
                out.items.push(line(under, Point::new(middle, -down * em), em, Anchor::Middle));
                out.items.push(rule(x, x + wide, AXIS_EM * em));
                out.above = out.above.max((up + top.ascent_em) * em);
                out.below = out.below.max((down + bottom.descent_em) * em);
                x += wide + 0.1 * em;
            }
            Math::Root(label) => {
                let (label, sign) = (&set(label), Label::math("√"));
                let (set, inner) = (text::set(&sign), text::set(label));
                // The root sign grows with its contents; its bar begins at its end.
                let top = inner.ascent_em + GAP_EM;
                let size =
                    (top + inner.descent_em.max(0.0)) / (set.ascent_em + set.descent_em) * em;
                let foot = -inner.descent_em.max(0.0) * em + set.descent_em * size;
                let right = bounds(&[line(&sign, Point::new(x, foot), size, Anchor::Start)])
                    .map_or(x, |b| b.max.x);
                out.items.push(line(&sign, Point::new(x, foot), size, Anchor::Start));
                let end = right + inner.width_em * em + 0.1 * em;
                out.items.push(rule(right, end, (top - RULE_EM / 2.0) * em));
                out.items.push(line(label, Point::new(right + 0.05 * em, 0.0), em, Anchor::Start));
                out.above = out.above.max((top + 0.1) * em);
                x = end + 0.1 * em;
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fraction_stands_on_the_axis() {
        let b = built(
            &[
                Math::Row(Label::math("\\omega_3 =")),
                Math::Fraction(Label::math("v_C"), Label::math("l_{CD}")),
            ],
            4.0,
            &Fonts::default(),
        );
        let ys: Vec<f64> = b
            .items
            .iter()
            .filter_map(|i| match i.shape {
                Shape::Label { at, .. } => Some(at.y),
                _ => None,
            })
            .collect();
        assert!(ys[1] > 0.0 && ys[2] < 0.0 && b.above > 4.0 && b.below > 2.0);
    }
}
