//! The construction of each instantaneous centre in words: from its pair, or as the intersection of
//! two lines.

use super::centres::CentreWords;
use super::writing::PointForm;
use hodograph_base::lang::{say, tr};
use hodograph_board::plan::names::name_label;
use hodograph_methods::centres::{
    Centre, CentreLocus, CentreMethod, CentrePlace, LinkPair, Origin, Primary,
};
use hodograph_paper::paper::phrase::{Phrase, fill};
use hodograph_scene::{GuidePath, Lang, PointId};

impl CentreWords<'_> {
    /// Returns the construction of a centre in plain characters: `pin B`, `23·34 × 12·14`.
    pub fn how(&self, c: &Centre) -> String {
        let given =
            if c.step.given_drivers { tr!(self.lang, " (for the given drivers)") } else { "" };
        let how = match (&c.step.how, c.origin) {
            (CentreMethod::Primary(primary), _) => self.primary(*primary, PointForm::Plain),
            (_, Some(Origin::Crossing(lines))) => self.crossing(c, lines, PointForm::Plain),
            (CentreMethod::Lines(_), Some(Origin::Velocities)) => {
                tr!(self.lang, "velocities, as its lines coincide").to_owned()
            }
            (CentreMethod::Velocities, Some(Origin::Velocities)) => {
                let how = tr!(self.lang, "velocities of the analysis");
                self.normals(c).map_or_else(
                    || how.to_owned(),
                    |normals| {
                        format!(
                            "{how}{}{}",
                            tr!(self.lang, "clause" => ", "),
                            Phrase::new(&normals).plain()
                        )
                    },
                )
            }
            (_, Some(Origin::Pair) | None) => "–".to_owned(),
        };
        format!("{how}{given}")
    }

    /// Returns the construction of a centre in a few words for a figure: `pin B`, `23·34 × 12·14`.
    pub fn found_by(&self, c: &Centre) -> Phrase {
        Phrase::new(&match (&c.step.how, c.origin) {
            (CentreMethod::Primary(primary), _) => self.primary(*primary, PointForm::Marked),
            (_, Some(Origin::Crossing(lines))) => self.crossing(c, lines, PointForm::Marked),
            (_, Some(Origin::Velocities)) => {
                self.normals(c).unwrap_or_else(|| tr!(self.lang, "from velocities").to_owned())
            }
            (_, Some(Origin::Pair) | None) => "–".to_owned(),
        })
    }

    /// Returns the construction of a centre as a sentence.
    pub fn sentence(&self, c: &Centre) -> Phrase {
        let (i, j) = (c.step.pair.i, c.step.pair.j);
        let name = |a, b| format!("P_{{{}}}", name_label(&self.pair(a, b).indices(self.scene)));
        let far = matches!(c.place, Some(CentrePlace::Infinity(_)));
        let at_infinity = if far { tr!(self.lang, ", at infinity") } else { "" };
        let slides =
            matches!(c.step.how, CentreMethod::Primary(Primary::Slide(_) | Primary::Cylinder(_)));
        let own = name(i, j);
        let line = |line: CentreLocus| match line {
            CentreLocus::Through(k) => format!("${}{}$", name(i, k), name(k, j)),
            CentreLocus::Normal(_) | CentreLocus::Infinity => {
                self.line(c.step.pair, line, PointForm::Marked)
            }
        };
        Phrase::new(&match c.origin {
            Some(Origin::Crossing([a, b])) => say!(
                self.lang,
                "${own}$ is the intersection of {} and {}{at_infinity}.",
                line(a),
                line(b)
            ),
            _ if far && slides => {
                say!(self.lang, "sliding" => "${own}$: {}{at_infinity}.", self.found_by(c).source())
            }
            _ => say!(self.lang, "${own}$: {}{at_infinity}.", self.found_by(c).source()),
        })
    }

    /// Returns the two velocities with normals through a centre that Kennedy's theorem does not
    /// find.
    fn normals(&self, c: &Centre) -> Option<String> {
        let [a, b] = self.found.normals(c)?.map(|n| name_label(self.scene.point_name(n.point)));
        Some(say!(self.lang, "normals to $v_{{{a}}}$, $v_{{{b}}}$"))
    }

    /// Returns two lines that intersect in a centre.
    fn crossing(&self, c: &Centre, lines: [CentreLocus; 2], writing: PointForm) -> String {
        lines.map(|line| self.line(c.step.pair, line, writing)).join(" × ")
    }

    fn primary(&self, primary: Primary, writing: PointForm) -> String {
        let point = |p: PointId| writing.point(self.scene.point_name(p));
        match primary {
            Primary::Pin(p) => format!("{} {}", tr!(self.lang, "pin"), point(p)),
            Primary::Slide(g) => {
                let guide = &self.scene.guides[g.0];
                let at = guide.pin.map_or(String::new(), |p| format!(" {}", point(p)));
                format!("{}{at}", tr!(self.lang, "perpendicular to the guide"))
            }
            Primary::Contact(r) => {
                let rolling = &self.scene.rolling[r.0];
                let words = if rolling.kind.meshes() {
                    tr!(self.lang, "pitch point")
                } else if rolling.kind.is_flexible() {
                    tr!(self.lang, "rope leaves at")
                } else {
                    tr!(self.lang, "rolling contact")
                };
                format!("{words} {}", point(rolling.at[0]))
            }
            Primary::Strand(r) => {
                let [a, b] =
                    self.scene.rolling[r.0].centres().map(|p| p.map_or(String::new(), point));
                let inner = self.scene.rolling[r.0].is_crossed();
                let words = match inner {
                    true => tr!(self.lang, "inner tangent × line of centres"),
                    false => tr!(self.lang, "outer tangent × line of centres"),
                };
                format!("{words} {a}{b}")
            }
            Primary::Cylinder(_) => tr!(self.lang, "perpendicular to the cylinder").to_owned(),
        }
    }

    /// Returns a line through a centre: `23·34`.
    pub(super) fn line(&self, pair: LinkPair, line: CentreLocus, writing: PointForm) -> String {
        match line {
            CentreLocus::Through(k) => {
                format!(
                    "{}·{}",
                    self.pair(pair.i, k).indices(self.scene),
                    self.pair(k, pair.j).indices(self.scene)
                )
            }
            CentreLocus::Normal(g) => {
                let guide = &self.scene.guides[g.0];
                let pin =
                    guide.pin.map_or(String::new(), |p| writing.point(self.scene.point_name(p)));
                // On a circle of a cam, the normal of the contact and the radius through it are the
                // same line.
                if let Some(cam) = self.scene.cams.iter().find(|c| c.contact == Some(g)) {
                    let at = cam
                        .at
                        .as_deref()
                        .map(|at| match self.lang {
                            Lang::En => format!(" {}", writing.point(at)),
                            Lang::Zh => format!(" {} ", writing.point(at)),
                        })
                        .unwrap_or_default();
                    return fill(tr!(self.lang, "common normal at the contact{}"), &[("", &at)]);
                }
                match &guide.path {
                    GuidePath::Line { .. } => say!(self.lang, "normal of the slot at {pin}"),
                    GuidePath::Arc { .. } => say!(self.lang, "radius of the slot at {pin}"),
                }
            }
            CentreLocus::Infinity => tr!(self.lang, "the line at infinity").to_owned(),
        }
    }
}
