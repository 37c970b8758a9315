//! Guides in words, as in textbooks: the sliding part, the link with the guide, and the direction
//! of the line ("in a horizontal guide", 水平导路).

use super::GivenSentences;
use hodograph_board::plan::text::point_label;
use hodograph_scene::{Angle, Guide, GuideDirection, GuidePath, Lang, Through};

/// Tolerance in degrees for a horizontal or vertical direction, which may be computed.
const NEAR_DEG: f64 = 1e-9;

/// The position of a guide or a track, as parts of a sentence.
#[derive(Default)]
pub(super) struct Lay {
    /// Attribute before the noun: "horizontal ", 水平.
    pub attribute: &'static str,
    /// English: phrase after the noun, with a space before it. Chinese: phrase before the noun,
    /// with 的 at its end.
    pub course: String,
    /// Chinese: the line's name after the noun.
    pub name: String,
    /// Offset of a guide from the point that it would pass through, at the end of the sentence.
    pub offset: String,
}

/// Returns the attribute of a horizontal or vertical direction.
fn attribute(angle: Angle, lang: Lang) -> Option<&'static str> {
    let quarters = angle.degrees() / 90.0;
    let nearest = quarters.round();
    let near = (quarters - nearest).abs() * 90.0 <= NEAR_DEG;
    let level = nearest.rem_euclid(2.0) == 0.0;
    near.then_some(match (level, lang) {
        (true, Lang::En) => "horizontal ",
        (true, Lang::Zh) => "水平",
        (false, Lang::En) => "vertical ",
        (false, Lang::Zh) => "铅直",
    })
}

impl GivenSentences<'_> {
    /// Returns the sliding part of a guide, and its position.
    pub(super) fn guide(&self, g: &Guide) -> String {
        let on = self.link(g.on);
        let runner = match (g.pin, g.slider, self.lang()) {
            (Some(p), Some(s), Lang::En) => {
                format!("slider {} (pin {}) ", self.link(s), self.point(p))
            }
            (Some(p), Some(s), Lang::Zh) => {
                format!("滑块 {}（销 {}）", self.link(s), self.point(p))
            }
            (Some(p), None, Lang::En) => format!("pin {} ", self.point(p)),
            (Some(p), None, Lang::Zh) => format!("销 {} ", self.point(p)),
            (None, Some(s), Lang::En) => format!("link {} ", self.link(s)),
            (None, Some(s), Lang::Zh) => format!("构件 {} ", self.link(s)),
            (None, None, _) => String::new(),
        };
        if let GuidePath::Arc { centre, radius } = &g.path {
            let centre = self.point(*centre);
            let radius = radius.as_ref().map(|r| format!("$\\rho = {}$", self.length(r)));
            return match self.lang() {
                Lang::En => {
                    let radius = radius.map(|r| format!(", {r}")).unwrap_or_default();
                    format!("{runner}slides in a slot of link {on}, an arc about {centre}{radius}")
                }
                Lang::Zh => {
                    let radius = radius.map(|r| format!("、{r} 为半径")).unwrap_or_default();
                    format!("{runner}在构件 {on} 上以 {centre} 为圆心{radius}的圆弧槽内滑动")
                }
            };
        }
        let Lay { attribute, course, name, offset } = self.lay(&g.path);
        match self.lang() {
            Lang::En => {
                format!("{runner}slides in a {attribute}guide of link {on}{course}{offset}")
            }
            Lang::Zh => format!("{runner}沿构件 {on} 上{course}{attribute}导路{name}滑动{offset}"),
        }
    }

    /// Returns the position of a guide's line; empty for an arc.
    pub(super) fn lay(&self, path: &GuidePath) -> Lay {
        let GuidePath::Line { through, direction, offset } = path else { return Lay::default() };
        let mut lay = Lay::default();
        let en = self.lang() == Lang::En;
        let mut told = Vec::new();
        match direction {
            GuideDirection::Along(a, b, turn) => {
                let line =
                    format!("${}{}$", point_label(self.name(*a)), point_label(self.name(*b)));
                match (turn.as_ref().map(|t| self.angle(t)), en) {
                    (Some(t), true) => {
                        told.push(format!(" in the direction of {line} turned by ${t}$"))
                    }
                    (Some(t), false) => told.push(format!("由 {line} 方向转过 ${t}$")),
                    (None, true) if *through == Through::Pin => {
                        told.push(format!(" parallel to {line}"))
                    }
                    (None, false) if *through == Through::Pin => {
                        told.push(format!("平行于 {line}"))
                    }
                    (None, true) => told.push(format!(" along {line}")),
                    (None, false) => lay.name = format!(" {line} "),
                }
            }
            GuideDirection::Instant(a) => match attribute(a.value, self.lang()) {
                Some(word) => lay.attribute = word,
                None if en => told.push(format!(" at ${}$ to the horizontal", self.angle(a))),
                None => told.push(format!("与水平线成 ${}$", self.angle(a))),
            },
            GuideDirection::Own | GuideDirection::Slid(_) => {}
        }
        let place = match through {
            Through::Pin => None,
            Through::Point(p) if matches!(direction, GuideDirection::Along(a, b, None) if a == p || b == p) => {
                None
            }
            Through::Point(p) => Some((self.point(*p), "过 ")),
            Through::At([x, y]) => {
                Some((format!("$({}, {})$", self.length(x), self.length(y)), "过点 "))
            }
        };
        if let Some((place, zh)) = place {
            told.push(if en { format!(" through {place}") } else { format!("{zh}{place}") });
        }
        lay.course = match (en, told.is_empty()) {
            (true, _) => told.concat(),
            (false, true) => "的".to_owned(),
            (false, false) => format!("{} 的", told.join("、")),
        };
        if let Some(o) = offset {
            let (by, left) = (self.unsigned(o), o.value >= 0.0);
            lay.offset = match (en, left) {
                (true, true) => format!(", offset ${by}$ to the left"),
                (true, false) => format!(", offset ${by}$ to the right"),
                (false, true) => format!("，向左偏距 ${by}$"),
                (false, false) => format!("，向右偏距 ${by}$"),
            };
        }
        lay
    }
}
