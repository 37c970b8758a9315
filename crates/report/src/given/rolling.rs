//! Gears, racks and wheels in the given data.

use super::GivenSentences;
use super::guide::Lay;
use hodograph_base::lang::{say, tr};
use hodograph_scene::{Contours, Flanks, GuideDirection, GuidePath, Rolling, RollingKind, Sizes};

impl GivenSentences<'_> {
    /// Returns a rolling pair in one sentence:
    /// `gears 2 and 4: $z_{2} = 20$, $z_{4} = 40$, pitch point $K$`.
    pub(super) fn rolling(&self, pair: &Rolling) -> String {
        let mut parts: Vec<String> = self.sizes(pair).into_iter().collect();
        parts.extend(self.crossing(pair));
        if let Some(phase) = &pair.phase {
            let angle = self.angle(phase);
            parts.push(say!(
                self.lang(),
                "its line ${angle}$ from the line of centres when that of the other lies on it"
            ));
        }
        let [at, end] = pair.at.map(|p| self.point(p));
        parts.push(match pair.kind {
            RollingKind::Gears => say!(self.lang(), "pitch point {at}"),
            RollingKind::Wheel => say!(self.lang(), "touching in {at}, without slip"),
            RollingKind::Rope => say!(self.lang(), "running off the drum at {at}"),
            RollingKind::Belt => say!(self.lang(), "a strand from {at} to {end}, without slip"),
            RollingKind::Chain => say!(self.lang(), "a strand from {at} to {end}"),
        });
        format!("{}{}", self.pair(pair), parts.join(self.lang().comma()))
    }

    /// Returns the two links and their arrangement.
    fn pair(&self, pair: &Rolling) -> String {
        let [a, b] = pair.links.map(|l| self.link(l));
        let lang = self.lang();
        let on = match pair.links[0] == self.scene.ground {
            true => tr!(lang, "the ground").to_owned(),
            false => say!(lang, "before a verb" => "link {a}"),
        };
        match (&pair.contours, pair.kind == RollingKind::Gears) {
            (Contours::Belt { .. }, _) => self.belt(pair),
            (Contours::Track { .. }, _) if pair.kind == RollingKind::Rope => {
                let Lay { course, .. } = self.track(pair);
                say!(lang, "a rope wound on drum {b} draws {on}{course}: ")
            }
            (Contours::Circles { hollow: None, .. }, true) => say!(lang, "gears {a} and {b}: "),
            (Contours::Circles { hollow: Some(i), .. }, true) => {
                let (ring, inner) = if *i == 0 { (a, b) } else { (b, a) };
                say!(lang, "gear {inner} in the ring gear {ring}: ")
            }
            (Contours::Track { .. }, toothed) => {
                // The offset of the wheel centre's guide from the track is the radius, which is
                // stated separately.
                let Lay { attribute, course, name, .. } = self.track(pair);
                match toothed {
                    true => say!(lang, "gear {b} on the {attribute}rack of {on}{course}{name}: "),
                    false => say!(
                        lang,
                        "wheel {b} rolls on a {attribute}straight track of {on}{course}{name}: "
                    ),
                }
            }
            (Contours::Circles { centres, hollow, .. }, false) => {
                let centre = self.point(centres[0]);
                match hollow.is_some() {
                    true => say!(lang, "wheel {b} rolls inside a circle of {on} about {centre}: "),
                    false => say!(lang, "wheel {b} rolls on a circle of {on} about {centre}: "),
                }
            }
        }
    }

    /// Returns the position of a straight track.
    fn track(&self, pair: &Rolling) -> Lay {
        let path = pair.guide().map(|g| &self.scene.guides[g.0].path);
        match path {
            Some(
                path @ GuidePath::Line {
                    direction: GuideDirection::Along(..) | GuideDirection::Instant(_),
                    ..
                },
            ) => self.lay(path),
            Some(
                GuidePath::Line {
                    direction: GuideDirection::Own | GuideDirection::Slid(_), ..
                }
                | GuidePath::Arc { .. },
            )
            | None => Lay {
                course: tr!(self.lang(), "course of a guide" => "").to_owned(),
                ..Lay::default()
            },
        }
    }

    /// Returns numbers of teeth, module and radii.
    fn sizes(&self, pair: &Rolling) -> Vec<String> {
        let [a, b] = pair.links.map(|l| hodograph_board::plan::names::name_label(self.link(l)));
        let radius = |of: &str, r| format!("$r_{{{of}}} = {}$", self.length(r));
        match (&pair.flanks, &pair.contours) {
            (Some(Flanks { teeth, module, .. }), _) => {
                let number =
                    |(of, z): (&String, &Option<u32>)| z.map(|z| format!("$z_{{{of}}} = {z}$"));
                let mut parts: Vec<String> = [a, b].iter().zip(teeth).filter_map(number).collect();
                parts.extend(module.map(|m| format!("$m = {} mm$", super::inked(m * 1e3))));
                parts
            }
            (None, Contours::Circles { sizes: Sizes::Radii([p, q]), .. }) => {
                vec![radius(&a, p), radius(&b, q)]
            }
            (None, Contours::Circles { sizes: Sizes::Teeth([y, z]), .. }) => {
                vec![format!("$z_{{{a}}} = {y}$"), format!("$z_{{{b}}} = {z}$")]
            }
            (None, Contours::Track { radius: r, .. }) => vec![radius(&b, r)],
            (None, Contours::Belt { radii: [p, q], teeth, .. }) => {
                let number = |(of, z)| format!("$z_{{{of}}} = {z}$");
                let teeth = teeth.iter().flat_map(|[y, z]| [number((&a, y)), number((&b, z))]);
                teeth.chain([radius(&a, p), radius(&b, q)]).collect()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::given::GivenSentences;
    use hodograph_scene::{Lang, read};

    const GEARS: &str = r#"{"units": {"length": "mm", "angle": "deg"}, "links": {"1": ["A"], "2": ["A", "B"], "3": ["B", "C"], "4": ["C"], "5": ["P"], "6": ["A"]},
        "ground": "1", "points": {"A": [0, 0], "B": [60, 80], "C": [210, 0], "P": [260, 40]},
        "guides": [{"slider": "5", "pin": "P", "on": "1", "angle": "0 deg"}],
        "rolling": [{"wheel": "4", "centre": "C", "radius": 40, "on": "1", "angle": "0 deg", "at": "N"}],
        "gears": [{"links": ["4", "5"], "centres": ["C"], "radii": [40], "rack": "5", "angle": "180 deg", "at": "Q"}],
        "driver": {"link": "2", "omega": "10 rad/s"}, "find": ["v_C", "v_P"]}"#;

    #[test]
    fn pairs_are_givens_and_their_guides_are_not() {
        let text = GEARS.replace(r#", "6": ["A"]"#, "");
        let scene = read(text).unwrap().value;
        for (lang, wanted) in [
            (
                Lang::En,
                [
                    "wheel 4 rolls on a horizontal straight track of the ground",
                    "gear 4 on the horizontal rack of link 5",
                    "pitch point",
                    "without slip",
                ],
            ),
            (
                Lang::Zh,
                [
                    "轮 4 沿机架上的水平直线轨道滚动",
                    "齿轮 4 与构件 5 上的水平齿条啮合",
                    "节点",
                    "纯滚动",
                ],
            ),
        ] {
            let all: String = GivenSentences { scene: &scene, lang }
                .list()
                .iter()
                .map(|p| p.plain() + "\n")
                .collect();
            for part in wanted {
                assert!(all.contains(part), "{part} is not in\n{all}");
            }
            let slides = if lang == Lang::En {
                "slides in a horizontal guide"
            } else {
                "的水平导路滑动"
            };
            assert_eq!(all.matches(slides).count(), 1, "{all}");
        }
    }
}
