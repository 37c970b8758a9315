//! Instantaneous centres as a table: construction, position, and the velocities derived from them.

use super::amount::length_unit;
use super::columns::columns;
use super::drafting;
use super::writing::PointForm;
use hodograph_base::digits::{direction_degrees, legible, line_degrees};
use hodograph_base::lang::{say, tr};
use hodograph_board::plan::names::name_label;
use hodograph_mechanism::answer::AnswerValue;
use hodograph_methods::centres::{
    Centre, CentreMotion, CentreMotionSource, CentrePlace, Centres, LinkPair, RelativeMotion,
    Speed, omega, velocity,
};
use hodograph_paper::paper::phrase::Phrase;
use hodograph_scene::{Kind, Lang, LinkId, Scene};

/// Significant digits of the table.
const DIGITS: usize = 6;

/// Differences below this are rounding errors of double precision.
const ROUNDING: f64 = 1e-12;

/// A writer for one result and language.
pub struct CentreWords<'a> {
    pub(super) found: &'a Centres,
    pub(super) scene: &'a Scene,
    pub(super) lang: Lang,
    /// Form of the names in sentences.
    pub(super) writing: PointForm,
}

/// Returns the report as text.
pub fn text(found: &Centres, lang: Lang) -> String {
    let w = CentreWords::new(found, lang);
    let mut lines = Vec::new();
    let title = lang.of(&w.scene.title);
    if !title.is_empty() {
        lines.push(title.to_owned());
    }
    lines.push(w.counts());
    lines.push(String::new());
    lines.extend(columns(&w.table(), 4));
    lines.extend(w.by_hand());
    lines.push(String::new());
    lines.push(w.proof());
    lines.push(String::new());
    lines.push(tr!(lang, "velocities by centres:").into());
    lines.extend(w.steps().into_iter().map(|s| format!("  {s}")));
    lines.push(String::new());
    lines.extend(columns(&w.ways(), 1));
    lines.iter().map(|l| format!("{}\n", l.trim_end())).collect()
}

impl<'a> CentreWords<'a> {
    /// Returns a writer for plain text.
    pub fn new(found: &'a Centres, lang: Lang) -> CentreWords<'a> {
        CentreWords { found, scene: &found.scene, lang, writing: PointForm::Plain }
    }

    /// Returns a writer with names between dollar signs
    /// ([`hodograph_paper::paper::phrase::Phrase::new`]).
    pub fn marked(found: &'a Centres, lang: Lang) -> CentreWords<'a> {
        CentreWords { writing: PointForm::Marked, ..CentreWords::new(found, lang) }
    }

    pub(super) fn pair(&self, a: LinkId, b: LinkId) -> LinkPair {
        self.found.closure.pair(a, b)
    }

    fn name(&self, a: LinkId, b: LinkId) -> String {
        self.writing.letter("P", &self.pair(a, b).indices(self.scene))
    }

    /// Returns the number of centres and how they are found.
    pub fn counts(&self) -> String {
        let c = &self.found.closure;
        let (n, all, primary, [more, taken]) =
            (c.links.len(), c.steps.len(), c.primary, c.found_by());
        match taken {
            0 => say!(
                self.lang,
                "{n} links, {all} centres: {primary} at the pairs, {more} by the theorem of three centres"
            ),
            _ => say!(
                self.lang,
                "{n} links, {all} centres: {primary} at the pairs, {taken} from velocities, {more} by the theorem of three centres"
            ),
        }
    }

    /// Returns a length in that unit.
    pub fn length(&self, m: f64) -> String {
        let (name, per_metre) = length_unit(self.scene);
        let m =
            if m.abs() <= ROUNDING * self.found.worked.configuration.extent() { 0.0 } else { m };
        format!("{} {name}", legible(m * per_metre, DIGITS))
    }

    fn table(&self) -> Vec<Vec<String>> {
        let lang = self.lang;
        let (unit, per_metre) = length_unit(self.scene);
        let size = self.found.worked.configuration.extent();
        let far = |c: &Centre| c.place.and_then(|p| p.point()).map_or(0.0, |p| p.to_vec2().norm());
        let number = |x: f64, c: &Centre| {
            // A value within rounding of zero is written as zero.
            let zero = x.abs() <= 1e-12 * size.max(far(c));
            legible(if zero { 0.0 } else { x * per_metre }, DIGITS)
        };
        let mut rows = vec![vec![
            tr!(lang, "centre").to_owned(),
            tr!(lang, "kind").to_owned(),
            tr!(lang, "round").to_owned(),
            tr!(lang, "how").to_owned(),
            format!("x / {unit}"),
            format!("y / {unit}"),
        ]];
        let by_hand = self.found.by_hand.as_ref();
        rows[0].extend(by_hand.map(|_| format!("± / {unit}")));
        for (k, c) in self.found.list.iter().enumerate() {
            let mut row = vec![
                c.step.pair.name(self.scene),
                self.kind(c).to_owned(),
                c.round.to_string(),
                self.how(c),
            ];
            match c.place {
                Some(CentrePlace::At(p)) => row.extend([number(p.x, c), number(p.y, c)]),
                Some(CentrePlace::Infinity(u)) => row.extend([
                    tr!(lang, "at infinity").to_owned(),
                    format!("∠ {}°", legible(line_degrees(u.angle()), DIGITS)),
                ]),
                None => row.extend([tr!(lang, "not determined").to_owned(), String::new()]),
            }
            row.extend(by_hand.map(|t| {
                t.centres[k].map_or_else(|| "–".to_owned(), |m| legible(m * per_metre, 2))
            }));
            rows.push(row);
        }
        rows
    }

    /// Returns the kind of a centre: absolute if one of its links is the ground, else relative.
    fn kind(&self, c: &Centre) -> &'static str {
        if c.step.pair.has(self.scene.ground) {
            tr!(self.lang, "absolute")
        } else {
            tr!(self.lang, "relative")
        }
    }

    /// Returns the names of the absolute centres, which are those of the ground, for a figure.
    pub fn absolute(&self) -> Phrase {
        let of_ground =
            self.found.list.iter().map(|c| c.step.pair).filter(|p| p.has(self.scene.ground));
        let names: Vec<String> = of_ground
            .map(|pair| format!("$P_{{{}}}$", name_label(&pair.indices(self.scene))))
            .collect();
        Phrase::new(&say!(
            self.lang,
            "absolute: {}; the others relative",
            names.join(self.lang.comma())
        ))
    }

    /// Returns the meaning of the tolerances, if there are any.
    fn by_hand(&self) -> Option<String> {
        let (pencil, mu) =
            (self.found.by_hand.as_ref()?.pencil_mm, self.found.worked.construction.diagram.mu);
        Some(drafting::by_hand_words(self.lang, pencil, mu))
    }

    fn proof(&self) -> String {
        let found = self.found;
        let to = |off: f64| match off {
            off if off < ROUNDING => tr!(self.lang, "to rounding").to_owned(),
            off => format!("{} {}", tr!(self.lang, "to"), legible(off, 2)),
        };
        let (residual, triple) = (to(found.worst_residual()), to(found.worst_triple));
        let none = found.list.iter().all(|c| c.residual.is_none());
        match none {
            true => {
                tr!(self.lang, "the loop equations have no motion in this pose to check them by")
                    .to_owned()
            }
            false => say!(
                self.lang,
                "checked by the loop equations: each centre has the same velocity on both links ({residual}); the three centres of any three links are collinear ({triple})"
            ),
        }
    }

    fn omega(&self, value: f64) -> String {
        let book = &self.scene.book;
        book.text(Kind::Omega, &legible(book.value(Kind::Omega, value), DIGITS))
    }

    fn velocity(&self, value: f64) -> String {
        let book = &self.scene.book;
        book.text(Kind::Velocity, &legible(book.value(Kind::Velocity, value), DIGITS))
    }

    /// Returns the symbol of a link's ω relative to the frame.
    fn symbol(&self, l: LinkId) -> String {
        let (name, frame) = (self.scene.link_name(l), self.found.uses.frame);
        let of = if frame == self.scene.ground {
            name.to_owned()
        } else {
            format!("{name}/{}", self.scene.link_name(frame))
        };
        self.writing.indexed("ω", &of)
    }

    /// Returns the symbol of the velocity of a link or a point.
    fn v(&self, of: &str) -> String {
        self.writing.indexed("v", of)
    }

    /// Returns the steps in words, one line each.
    pub fn steps(&self) -> Vec<String> {
        let uses = &self.found.uses;
        let mut steps = Vec::new();
        if self.found.at_rest {
            steps.push(
                tr!(self.lang, "the drivers are at rest: a unit of their rate is taken").to_owned(),
            );
        }
        steps.extend(uses.links.iter().map(|t| self.turning(t)));
        steps.extend(uses.points.iter().map(|s| self.speed(s)));
        match self.writing {
            PointForm::Plain => steps,
            // Adjacent names form one formula; column spacing is for terminals only.
            PointForm::Marked => {
                steps.iter().map(|s| s.replace("$$", "").replace("  ", " ")).collect()
            }
        }
    }

    fn sense(&self, omega: f64) -> &'static str {
        match omega {
            o if o > 0.0 => tr!(self.lang, ", counter-clockwise"),
            o if o < 0.0 => tr!(self.lang, ", clockwise"),
            _ => "",
        }
    }

    fn of(&self, l: LinkId) -> Option<&CentreMotion> {
        self.found.uses.links.iter().find(|t| t.link == l)
    }

    /// Returns the angular velocity of a link relative to the frame; zero if it is only rounding.
    fn rate_of(&self, l: LinkId) -> f64 {
        let rate =
            |t: &CentreMotion| if let RelativeMotion::Turn(omega) = t.motion { omega } else { 0.0 };
        let most = self.found.uses.links.iter().map(|t| rate(t).abs()).fold(0.0, f64::max);
        self.of(l).map(rate).filter(|omega| omega.abs() > ROUNDING * most).unwrap_or(0.0)
    }

    /// Returns a speed in words; zero if it is only rounding.
    fn speed_words(&self, value: f64) -> String {
        self.velocity(if value <= ROUNDING * self.fastest() { 0.0 } else { value })
    }

    /// Returns the largest speed of a point, or of a link's rotation over the size of the
    /// mechanism, as a reference for rounding.
    fn fastest(&self) -> f64 {
        let size = self.found.worked.configuration.extent();
        let of_links = self.found.uses.links.iter().map(|t| match t.motion {
            RelativeMotion::Turn(omega) => omega.abs() * size,
            RelativeMotion::Slide(v) => v.norm(),
        });
        self.found.uses.points.iter().map(|s| s.velocity.norm()).chain(of_links).fold(0.0, f64::max)
    }

    fn turning(&self, t: &CentreMotion) -> String {
        let (lang, frame) = (self.lang, self.found.uses.frame);
        let v_k = self.v(self.scene.link_name(t.link));
        let (rate, slide) = match t.motion {
            RelativeMotion::Turn(_) => (self.rate_of(t.link), None),
            RelativeMotion::Slide(v) => (0.0, Some(v)),
        };
        let rate_words = format!("{}{}", self.omega(rate.abs()), self.sense(rate));
        let slides = |v: hodograph_base::geom::Vec2| {
            let along = legible(direction_degrees(v.angle()), DIGITS);
            format!("{} ∠ {along}°", self.velocity(v.norm()))
        };
        let own = self.symbol(t.link);
        match t.by {
            CentreMotionSource::Driver | CentreMotionSource::Analysis => {
                let why = if t.by == CentreMotionSource::Driver {
                    match self.scene.own_drivers() {
                        0 | 1 => tr!(lang, "  (the driver)"),
                        _ => tr!(lang, "  (a driver)"),
                    }
                } else {
                    tr!(lang, "  (by the analysis)")
                };
                match slide {
                    Some(v) => format!("{v_k} = {}{why}", slides(v)),
                    None => format!("{own} = {rate_words}{why}"),
                }
            }
            CentreMotionSource::Ratio { link, of_other, own: arm } => {
                let (x, m) = (self.name(t.link, link), self.symbol(link));
                let (o, c) = (self.name(frame, t.link), self.name(frame, link));
                let sense = match rate * self.rate_of(link) {
                    0.0 => String::new(),
                    p if p > 0.0 => say!(lang, "; {x} lies outside {c}{o}: the same sense"),
                    _ => say!(lang, "; {x} lies between {c} and {o}: opposite senses"),
                };
                let ratio = legible(if rate == 0.0 { 0.0 } else { of_other / arm }, DIGITS);
                let (over, then) = if frame == self.scene.ground {
                    ("/", lang.semicolon())
                } else {
                    (" : ", lang.semicolon())
                };
                let (near, far) = (self.length(of_other), self.length(arm));
                format!(
                    "{own}{over}{m} = {c}{x}/{o}{x} = {near} / {far} = {ratio}{sense}{then}{own} = {rate_words}"
                )
            }
            CentreMotionSource::Together(m) => say!(
                lang,
                "{} lies at infinity: {own} = {} = {rate_words}",
                self.name(t.link, m),
                self.symbol(m)
            ),
            CentreMotionSource::Wedge(m) => {
                let (x, v_m) = (self.name(t.link, m), self.v(self.scene.link_name(m)));
                let v = slide.map_or(String::new(), slides);
                say!(
                    lang,
                    "{x} lies at infinity: {v_k} and {v_m} have one component along its direction; {v_k} = {v}"
                )
            }
            CentreMotionSource::Slides { link, arm } => {
                let (x, c, m) =
                    (self.name(t.link, link), self.name(frame, link), self.symbol(link));
                let turns = self.omega(self.rate_of(link).abs());
                format!(
                    "{v_k} = {m} · {c}{x} = {turns} · {} = {}",
                    self.length(arm),
                    slide.map_or(String::new(), slides)
                )
            }
            CentreMotionSource::FromSlide { link, arm } => {
                let (x, o) = (self.name(t.link, link), self.name(frame, t.link));
                let speed = self.of(link).map_or(0.0, |m| {
                    if let RelativeMotion::Slide(v) = m.motion { v.norm() } else { 0.0 }
                });
                let (v_m, speed, arm) =
                    (self.v(self.scene.link_name(link)), self.velocity(speed), self.length(arm));
                format!("{own} = {v_m} / {o}{x} = {speed} / {arm} = {rate_words}")
            }
        }
    }

    fn speed(&self, s: &Speed) -> String {
        let link = self.scene.link_name(s.link);
        let (v_point, point) = (
            self.v(self.scene.point_name(s.point)),
            self.writing.point(self.scene.point_name(s.point)),
        );
        let size = self.speed_words(s.velocity.norm());
        match s.arm {
            Some(arm) => {
                let o = self.name(self.scene.ground, s.link);
                let turns = self.omega(self.of(s.link).map_or(0.0, |t| t.omega.abs()));
                let omega = self.writing.indexed("ω", link);
                format!(
                    "{v_point} = {omega} · {o}{point} = {turns} · {} = {size}",
                    self.length(arm)
                )
            }
            None => format!("{v_point} = {} = {size}", self.v(link)),
        }
    }

    /// Returns the values by centres beside those of drawing and analysis.
    fn ways(&self) -> Vec<Vec<String>> {
        let lang = self.lang;
        let mut rows = vec![vec![
            tr!(lang, "magnitude").to_owned(),
            tr!(lang, "by centres").to_owned(),
            tr!(lang, "drawn").to_owned(),
            tr!(lang, "loop equations").to_owned(),
        ]];
        let most = self.found.uses.links.iter().map(|t| t.omega.abs()).fold(0.0, f64::max);
        let fastest = self.fastest();
        for (symbol, kind, value, others) in self.values() {
            let zero = 1e-12 * if kind == Kind::Omega { most } else { fastest };
            let write = |v: f64| match (kind, if v.abs() <= zero { 0.0 } else { v }) {
                (Kind::Omega, v) => self.omega(v),
                (_, v) => self.velocity(v),
            };
            let mut row = vec![symbol, write(value)];
            row.extend(others.map(|v| v.map_or_else(|| "–".to_owned(), write)));
            rows.push(row);
        }
        rows
    }

    /// Returns symbol, kind, value by centres, and values by drawing and analysis; for a vector its
    /// length.
    pub fn values(&self) -> Vec<(String, Kind, f64, [Option<f64>; 2])> {
        let number = |v: AnswerValue| match v {
            AnswerValue::Scalar(s) => s,
            AnswerValue::Vector(v) => v.norm(),
            AnswerValue::Point(p) => p.to_vec2().norm(),
        };
        let links = self.found.uses.links.iter().filter(|t| t.link != self.scene.ground).map(|t| {
            let others = self.found.other_ways(&omega(t.link, None)).map(|v| v.map(number));
            (format!("ω_{}", self.scene.link_name(t.link)), Kind::Omega, t.omega, others)
        });
        let points = self.found.uses.points.iter().map(|s| {
            let others = self.found.other_ways(&velocity(s.point)).map(|v| v.map(number));
            (
                format!("v_{}", self.scene.point_name(s.point)),
                Kind::Velocity,
                s.velocity.norm(),
                others,
            )
        });
        links.chain(points).collect()
    }
}

/// Returns the positions of all centres in one line, for readers who do not see the figure.
pub fn places(found: &Centres, lang: Lang) -> String {
    let w = CentreWords::new(found, lang);
    let place = |c: &Centre| match c.place {
        Some(CentrePlace::At(p)) => format!("({}, {})", w.length(p.x), w.length(p.y)),
        Some(CentrePlace::Infinity(_)) => tr!(lang, "at infinity").to_owned(),
        None => tr!(lang, "not determined").to_owned(),
    };
    found
        .list
        .iter()
        .map(|c| format!("{} {}", c.step.pair.name(w.scene), place(c)))
        .collect::<Vec<_>>()
        .join("; ")
}
