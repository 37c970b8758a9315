//! Curvature in words: the steps of the construction, the values by drawing beside those by
//! analysis, and remarks on poses with elements at infinity.

use super::columns::columns;
use super::drafting;
use hodograph_base::digits::{direction_degrees, legible};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::{each, say, tr};
use hodograph_board::plan::names::{name_label, point_label};
use hodograph_methods::curvature::drawing::CurvatureDrawing;
use hodograph_methods::curvature::motion::{Bend, PlaneState};
use hodograph_methods::curvature::plane::PlanePoint;
use hodograph_methods::curvature::{LinkCurvatures, OfLink, OfPoint};
use hodograph_paper::paper::phrase::Phrase;
use hodograph_scene::{Kind, Lang, LinkId, PointId, Scene};

/// Most significant digits of the table.
const DIGITS: f64 = 6.0;
/// Fewest significant digits.
const FEWEST: f64 = 2.0;
/// Lengths below this fraction of the mechanism's size are rounding.
const ROUNDING: f64 = 1e-12;

/// A writer for one result and language.
pub struct CurvatureWords<'a> {
    /// The result to report.
    pub found: &'a LinkCurvatures,
    /// The language.
    pub lang: Lang,
}

/// Returns the report as text, with the construction if `steps` is true.
pub fn text(found: &LinkCurvatures, steps: bool, lang: Lang) -> String {
    let w = CurvatureWords { found, lang };
    let mut lines = Vec::new();
    let title = lang.of(&found.scene.title);
    if !title.is_empty() {
        lines.push(title.to_owned());
    }
    for of in &found.list {
        lines.push(String::new());
        lines.push(w.heading(of));
        lines.extend(w.remarks(of).iter().map(|r| format!("  {}", r.plain())));
        lines.extend(columns(&w.values(of), usize::MAX).into_iter().map(|r| format!("  {r}")));
        lines.extend(columns(&w.points(of), usize::MAX).into_iter().map(|r| format!("  {r}")));
        lines.extend(w.by_hand(of).map(|told| format!("  {told}")));
        if let Some(apart) = of.apart() {
            let told = tr!(lang, "drawing and analysis are apart by");
            lines.push(format!("  {told} {apart:.1e}"));
        }
        if steps {
            let steps = w.steps(of);
            lines.extend(
                steps.iter().enumerate().map(|(k, s)| format!("  {}. {}", k + 1, s.plain())),
            );
        }
    }
    lines.iter().map(|l| format!("{}\n", l.trim_end())).collect()
}

impl CurvatureWords<'_> {
    pub(super) fn scene(&self) -> &Scene {
        &self.found.scene
    }

    /// Returns the significant digits on which drawing and analysis agree, with one in reserve: a
    /// joint close to the pole takes digits from the curvature of its path.
    fn digits(&self) -> usize {
        let apart = self.found.list.iter().filter_map(OfLink::apart).fold(0.0, f64::max);
        let agreed = -libm::log10(apart.max(f64::MIN_POSITIVE)) - 1.0;
        agreed.clamp(FEWEST, DIGITS) as usize
    }

    /// Returns the link with its points: `2 (BCE)`.
    fn link(&self, link: LinkId) -> String {
        let scene = self.scene();
        let points: String = hodograph_methods::curvature::points(scene, link)
            .iter()
            .map(|p| scene.point_name(*p))
            .collect();
        if points.is_empty() {
            scene.link_name(link).to_owned()
        } else {
            format!("{} ({points})", scene.link_name(link))
        }
    }

    /// Returns the heading with the link's points as formulas.
    pub fn heading_set(&self, of: &OfLink) -> Phrase {
        Phrase::new(&match self
            .heading(of)
            .split_once('(')
            .map(|(before, rest)| (before, rest.split_once(')')))
        {
            Some((before, Some((points, after)))) => {
                let [open, close] = match self.lang {
                    Lang::En => ["(", ")"],
                    Lang::Zh => ["（", "）"],
                };
                format!(
                    "{}{open}${points}${close}{after}",
                    if self.lang == Lang::Zh { before.trim_end() } else { before }
                )
            }
            Some((_, None)) | None => self.heading(of),
        })
    }

    /// Returns the heading: `link 2 (BCE), seen from link 3`.
    pub fn heading(&self, of: &OfLink) -> String {
        let against = self.scene().link_name(self.found.against);
        let seen = self.found.against != self.scene().ground;
        match seen {
            false => say!(self.lang, "link {}", self.link(of.link)),
            true => say!(self.lang, "link {}, seen from link {against}", self.link(of.link)),
        }
    }

    /// Returns a letter with the link as subscript: `J_{2}`, `J_{2/3}`.
    pub fn letter(&self, letter: &str, of: &OfLink) -> String {
        let scene = self.scene();
        let (link, against) = (scene.link_name(of.link), scene.link_name(self.found.against));
        if self.found.against == scene.ground {
            format!("{letter}_{{{}}}", name_label(link))
        } else {
            format!("{letter}_{{{}}}", name_label(&format!("{link}/{against}")))
        }
    }

    /// Returns the symbol of the pole: `P_{24}`.
    pub fn pole(&self, of: &OfLink) -> String {
        let scene = self.scene();
        let (a, b) = (of.link.min(self.found.against), of.link.max(self.found.against));
        let names = [a, b].map(|l| scene.link_name(l));
        let comma = if names.iter().all(|n| n.chars().count() == 1) { "" } else { "," };
        format!("P_{{{}}}", name_label(&names.join(comma)))
    }

    /// Returns the letter of the auxiliary point of the Euler–Savary construction: H, unless a
    /// joint has that letter.
    pub fn helper(&self) -> &'static str {
        self.free_letter(["H", "S", "V", "X", "Y"])
    }

    /// Returns the letter of the point on the collineation axis: Q, with Q₁ and Q₂, unless a joint
    /// has that letter.
    pub fn on_axis(&self) -> &'static str {
        self.free_letter(["Q", "R", "W", "Z", "L"])
    }

    /// Returns the letter of the corners of the rectangles that determine Ball's point: G, unless a
    /// joint has that letter.
    pub fn corner(&self) -> &'static str {
        self.free_letter(["G", "M", "N", "F", "A"])
    }

    /// Returns the letter of the foot on the pole tangent in that construction: T, unless a joint
    /// has that letter.
    pub fn foot(&self) -> &'static str {
        self.free_letter(["T", "E", "I", "O", "C"])
    }

    /// Returns the first of some letters that no point has, with or without a number; the first
    /// letter if all are taken.
    fn free_letter(&self, letters: [&'static str; 5]) -> &'static str {
        let begins = |letter: &str| {
            self.scene()
                .points
                .iter()
                .any(|p| p.name.trim_end_matches(|c: char| c.is_ascii_digit()) == letter)
        };
        letters.into_iter().find(|l| !begins(l)).unwrap_or(letters[0])
    }

    /// Returns the symbol of a point: `B`, `O_{2}`.
    pub fn point(&self, p: PointId) -> String {
        point_label(self.scene().point_name(p))
    }

    /// Returns a letter with a point as subscript: `J_{B}`, the inflection point of a ray.
    pub fn below(&self, letter: &str, p: PointId) -> String {
        format!("{letter}_{{{}}}", name_label(self.scene().point_name(p)))
    }

    /// Returns the symbol of the centre of curvature of a point's path: `E_{0}`, `B_{2,0}`.
    pub fn centre(&self, p: PointId) -> String {
        let name = self.scene().point_name(p);
        let digits = name.trim_start_matches(|c: char| !c.is_ascii_digit());
        if digits.is_empty() || digits.len() == name.len() {
            return format!("{}_{{0}}", name_label(name));
        }
        format!("{}_{{{digits},0}}", name_label(&name[..name.len() - digits.len()]))
    }

    /// Returns the unit of length, and how many there are in a metre.
    fn unit(&self) -> (String, f64) {
        let scene = self.scene();
        match scene.book.chosen(Kind::Length) {
            Some(unit) => (unit.name().to_owned(), unit.of(1.0)),
            None => (
                scene.length_unit.name.to_owned(),
                scene.length_unit.denominator / scene.length_unit.numerator,
            ),
        }
    }

    fn length(&self, m: f64) -> String {
        let (name, per_metre) = self.unit();
        let m =
            if m.abs() <= ROUNDING * self.found.worked.configuration.extent() { 0.0 } else { m };
        format!("{} {name}", legible(m * per_metre, self.digits()))
    }

    /// Returns the bound of a reading by hand: `± 12 mm`, `–` if there is none.
    fn tolerance(&self, bound: Option<f64>) -> String {
        let (unit, per_metre) = self.unit();
        bound.map_or_else(|| "–".to_owned(), |m| format!("± {} {unit}", legible(m * per_metre, 2)))
    }

    /// Returns the meaning of the tolerances, if there are any.
    fn by_hand(&self, of: &OfLink) -> Option<String> {
        Some(drafting::by_hand_words(self.lang, of.by_hand.as_ref()?.pencil_mm, self.mu_l()))
    }

    /// Returns the scale of the mechanism's drawing (m/mm).
    pub(super) fn mu_l(&self) -> f64 {
        self.found.worked.construction.diagram.mu
    }

    /// Returns a length as read off the drawing: `25.23 mm`.
    pub(super) fn on_paper(&self, m: f64) -> String {
        format!("{} mm", legible(m / self.mu_l(), 4))
    }

    fn place(&self, p: Point) -> String {
        format!("({}, {})", self.length(p.x), self.length(p.y))
    }

    fn velocity(&self, v: Vec2) -> String {
        let book = &self.scene().book;
        let size = book
            .text(Kind::Velocity, &legible(book.value(Kind::Velocity, v.norm()), self.digits()));
        if v == Vec2::ZERO {
            size
        } else {
            format!("{size} ∠ {}°", legible(direction_degrees(v.angle()), 5))
        }
    }

    /// Returns the remarks on the pose that come before the values.
    pub fn remarks(&self, of: &OfLink) -> Vec<Phrase> {
        let lang = self.lang;
        let pole = self.pole(of);
        let mut out = Vec::new();
        match of.state {
            PlaneState::Rest => {
                out.push(tr!(lang, "the link is at rest in this pose: it has no pole").to_owned())
            }
            PlaneState::Translation(v) => {
                let direction = legible(direction_degrees(v.perp().angle()), 5);
                out.push(say!(lang, "the link translates at this instant: ${pole}$ lies at infinity, toward {direction}°; points whose path is straight lie on a line, not on a circle"));
            }
            PlaneState::Turning(p) if p.stands() => out.push(say!(lang, "${pole}$ stands still at this instant: the inflection circle has shrunk to it, all paths bend about it")),
            PlaneState::Turning(_) => {}
        }
        out.extend(self.not_drawn(of));
        if self.found.at_rest {
            out.push(
                tr!(
                    lang,
                    "all drivers rest: values that depend on the rate are for one unit of it"
                )
                .to_owned(),
            );
        }
        out.iter().map(|s| Phrase::new(s)).collect()
    }

    /// Returns the note of a figure on the points taken from the analysis.
    pub fn calculated(&self) -> Phrase {
        Phrase::new(tr!(
            self.lang,
            "pole, inflection circle and centres of curvature are shown where they are calculated"
        ))
    }

    /// Returns the note on names of the steps that a figure does not show.
    pub fn undrawn(&self, names: &[String]) -> Option<Phrase> {
        let marked: Vec<String> = names.iter().map(|name| format!("${name}$")).collect();
        (!marked.is_empty()).then(|| {
            Phrase::new(&say!(
                self.lang,
                "not drawn, as their construction leaves the paper: {}",
                marked.join(self.lang.comma())
            ))
        })
    }

    /// Returns the reason if there is no drawing.
    fn not_drawn(&self, of: &OfLink) -> Option<String> {
        let (lang, pole) = (self.lang, self.pole(of));
        match &of.drawing {
            CurvatureDrawing::Rays(_) | CurvatureDrawing::Rolling(_) => None,
            CurvatureDrawing::Hinge(p) => Some(say!(lang, "both links carry ${}$: it is the pole for good", self.point(*p))),
            CurvatureDrawing::Parallel(_) => Some(say!(lang, "the two rays are parallel: they cross in no ${pole}$ on paper")),
            CurvatureDrawing::OneLine(_) => Some(
                tr!(
                    lang,
                    "both rays lie on one line, a dead point: they do not tell the pole; the values are those of the analysis"
                )
                .to_owned(),
            ),
            CurvatureDrawing::NoRays => Some(
                tr!(
                    lang,
                    "fewer than two points have paths with a known centre: it is not drawn; the values are those of the analysis"
                )
                .to_owned(),
            ),
        }
    }

    /// Returns the values of the pole: symbol, name, by drawing, by analysis.
    pub fn values(&self, of: &OfLink) -> Vec<Vec<String>> {
        let lang = self.lang;
        let Some(pole) = of.pole() else { return Vec::new() };
        let drawn = of.drawn();
        let none = || "–".to_owned();
        let place = |p: Option<Point>| p.map_or_else(none, |p| self.place(p));
        let mut rows = vec![vec![
            String::new(),
            String::new(),
            tr!(lang, "drawing").into(),
            tr!(lang, "analysis").into(),
        ]];
        rows[0].extend(of.by_hand.as_ref().map(|_| tr!(lang, "by hand").to_owned()));
        let mut row =
            |symbol: String, name: [&'static str; 2], by_drawing: String, by_analysis: String| {
                let mut cells = vec![
                    Phrase::new(&format!("${symbol}$")).plain(),
                    lang.pick(name).to_owned(),
                    by_drawing,
                    by_analysis,
                ];
                // Velocities and the poles of acceleration rest on the polygons, whose tolerances
                // `solve` gives.
                let bound = of.by_hand.as_ref().and_then(|t| match name[0] {
                    "pole" => t.pole,
                    "inflection pole" => t.inflection_pole,
                    "inflection circle" => t.diameter,
                    "Ball's point" => t.ball,
                    _ => None,
                });
                cells.extend(of.by_hand.as_ref().map(|_| self.tolerance(bound)));
                rows.push(cells);
            };
        row(self.pole(of), each!("pole"), place(drawn.map(|d| d.pole)), self.place(pole.pole));
        if pole.stands() {
            return rows;
        }
        let letter = |l: &str| self.letter(l, of);
        row(
            letter("J"),
            each!("inflection pole"),
            place(drawn.map(|d| d.pole + d.normal)),
            self.place(pole.inflection_pole()),
        );
        row(
            letter("d"),
            each!("inflection circle"),
            drawn.map_or_else(none, |d| self.length(d.normal.norm())),
            self.length(pole.diameter()),
        );
        let tangent = |u: Vec2| {
            format!("{}°", legible(direction_degrees(u.angle()).rem_euclid(180.0), self.digits()))
        };
        row(
            "t".into(),
            each!("pole tangent"),
            drawn.map_or_else(none, |d| tangent(d.normal.perp())),
            tangent(pole.normal.perp()),
        );
        row(
            letter("U"),
            each!("Ball's point"),
            place(drawn.and_then(|d| d.ball)),
            place(pole.ball),
        );
        row(
            letter("u"),
            each!("pole velocity"),
            drawn.and_then(|d| d.pole_velocity).map_or_else(none, |u| self.velocity(u)),
            self.velocity(pole.pole_velocity),
        );
        row(
            letter("K"),
            each!("acceleration pole"),
            place(drawn.and_then(|d| d.acceleration_pole)),
            self.place(pole.acceleration_pole),
        );
        let bresse = pole
            .bresse
            .map_or_else(|| tr!(lang, "the line PJ (α = 0)").to_owned(), |d| self.length(d.norm()));
        let bresse_drawn = drawn.and_then(|d| d.bresse).filter(|_| pole.bresse.is_some());
        row(
            letter("b"),
            each!("Bresse's circle"),
            bresse_drawn.map_or_else(none, |d| self.length(d.norm())),
            bresse,
        );
        rows
    }

    /// Returns the values of the points: symbol, radius and centre by drawing and by analysis.
    fn points(&self, of: &OfLink) -> Vec<Vec<String>> {
        of.points
            .iter()
            .enumerate()
            .map(|(k, p)| {
                let (name, drawn) =
                    (self.scene().point_name(p.point).to_owned(), p.drawn.map(|d| d.centre));
                let (radius, centre) = self.bend(p);
                let drawn = match drawn {
                    Some(PlanePoint::At(c)) => {
                        format!("{}  {}", self.length(c.distance(p.at)), self.place(c))
                    }
                    Some(PlanePoint::Infinity(_)) => tr!(self.lang, "∞").to_owned(),
                    None => "–".to_owned(),
                };
                let mut row = vec![
                    format!("ρ_{name}"),
                    tr!(self.lang, "radius, centre").to_owned(),
                    drawn,
                    format!("{radius}  {centre}"),
                ];
                row.extend(of.by_hand.as_ref().map(|t| self.tolerance(t.radii[k])));
                row
            })
            .collect()
    }

    /// Returns the results below a figure: `d_2 = 2523 mm`, radii of the requested points.
    pub fn told(&self, of: &OfLink) -> Vec<Phrase> {
        let (scene, lang) = (self.scene(), self.lang);
        let words = |m: f64| scene.length_words(m);
        let mut parts = Vec::new();
        if let Some(pole) = of.pole().filter(|p| !p.stands()) {
            parts.push(format!("${}$ = {}", self.letter("d", of), words(pole.diameter())));
            let book = &scene.book;
            let u = book.text(
                Kind::Velocity,
                &legible(book.value(Kind::Velocity, pole.pole_velocity.norm()), 4),
            );
            parts.push(format!("${}$ = {u}", self.letter("u", of)));
        }
        for p in &of.points {
            let rho = self.below("\\rho", p.point);
            parts.push(match p.bend {
                Bend::About(_, radius) => format!("${rho}$ = {}", words(radius)),
                Bend::Straight => format!("${rho} = \\infty$"),
                Bend::AtPole => format!("${rho} = 0$"),
                Bend::Rest => continue,
            });
        }
        let comma = tr!(lang, "clause" => ", ");
        if parts.is_empty() { Vec::new() } else { vec![Phrase::new(&parts.join(comma))] }
    }

    /// Returns radius and centre by analysis, in words if they are at infinity.
    pub fn bend(&self, p: &OfPoint) -> (String, String) {
        let lang = self.lang;
        match p.bend {
            Bend::About(centre, radius) => (self.length(radius), self.place(centre)),
            Bend::Straight => {
                ("∞".into(), tr!(lang, "on the inflection circle: its path is straight").into())
            }
            Bend::AtPole => {
                ("0".into(), tr!(lang, "it is the pole: its path has a cusp or stops").into())
            }
            Bend::Rest => ("–".into(), tr!(lang, "at rest").into()),
        }
    }
}
