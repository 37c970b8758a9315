//! Guides in words, as in textbooks: the sliding part, the link with the guide, and the direction
//! of the line ("in a horizontal guide", 水平导路).

use super::GivenSentences;
use hodograph_base::lang::{say, tr};
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
    near.then_some(match level {
        true => tr!(lang, "horizontal "),
        false => tr!(lang, "vertical "),
    })
}

impl GivenSentences<'_> {
    /// Returns the sliding part of a guide, and its position.
    pub(super) fn guide(&self, g: &Guide) -> String {
        let on = self.link(g.on);
        let runner = match (g.pin, g.slider) {
            (Some(p), Some(s)) => {
                say!(self.lang(), "slider {} (pin {}) ", self.link(s), self.point(p))
            }
            (Some(p), None) => say!(self.lang(), "pin {} ", self.point(p)),
            (None, Some(s)) => say!(self.lang(), "link {} ", self.link(s)),
            (None, None) => String::new(),
        };
        if let GuidePath::Arc { centre, radius } = &g.path {
            let centre = self.point(*centre);
            let radius = radius.as_ref().map(|r| format!("$\\rho = {}$", self.length(r)));
            return match radius {
                Some(radius) => say!(
                    self.lang(),
                    "{runner}slides in a slot of link {on}, an arc about {centre}, {radius}"
                ),
                None => {
                    say!(
                        self.lang(),
                        "{runner}slides in a slot of link {on}, an arc about {centre}"
                    )
                }
            };
        }
        let Lay { attribute, course, name, offset } = self.lay(&g.path);
        say!(self.lang(), "{runner}slides in a {attribute}guide of link {on}{course}{offset}")
    }

    /// Returns the position of a guide's line; empty for an arc.
    pub(super) fn lay(&self, path: &GuidePath) -> Lay {
        let GuidePath::Line { through, direction, offset } = path else { return Lay::default() };
        let mut lay = Lay::default();
        let lang = self.lang();
        let mut told = Vec::new();
        match direction {
            GuideDirection::Along(a, b, turn) => {
                let line =
                    format!("${}{}$", point_label(self.name(*a)), point_label(self.name(*b)));
                match (turn.as_ref().map(|t| self.angle(t)), lang) {
                    (Some(t), _) => {
                        told.push(say!(lang, " in the direction of {line} turned by ${t}$"))
                    }
                    (None, _) if *through == Through::Pin => {
                        told.push(say!(lang, " parallel to {line}"))
                    }
                    (None, Lang::En) => told.push(format!(" along {line}")),
                    (None, Lang::Zh) => lay.name = format!(" {line} "),
                }
            }
            GuideDirection::Instant(a) => match attribute(a.value, lang) {
                Some(word) => lay.attribute = word,
                None => told.push(say!(lang, " at ${}$ to the horizontal", self.angle(a))),
            },
            GuideDirection::Own | GuideDirection::Slid(_) => {}
        }
        match through {
            Through::Pin => {}
            Through::Point(p) if matches!(direction, GuideDirection::Along(a, b, None) if a == p || b == p) =>
                {}
            Through::Point(p) => told.push(say!(lang, " through {}", self.point(*p))),
            Through::At([x, y]) => told.push(say!(
                lang,
                "coordinates" => " through $({}, {})$",
                self.length(x),
                self.length(y)
            )),
        }
        let joined = told.join(lang.pick(["", "、"]));
        lay.course = match told.is_empty() {
            true => tr!(lang, "course of a guide" => "").to_owned(),
            false => say!(lang, "course of a guide" => "{joined}"),
        };
        if let Some(o) = offset {
            let by = self.unsigned(o);
            lay.offset = match o.value >= 0.0 {
                true => say!(lang, ", offset ${by}$ to the left"),
                false => say!(lang, ", offset ${by}$ to the right"),
            };
        }
        lay
    }
}
