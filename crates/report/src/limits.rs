//! The motion over its full range, as text and JSON: range of the driver, extremes of the outputs,
//! transmission angles, Grashof.

pub mod balanced;
pub mod ranges;

use hodograph_base::diag::{Both, both};
use hodograph_base::digits::legible;
use hodograph_base::lang::{say, tr};
use hodograph_paper::paper::phrase::fill;
use hodograph_scene::{Book, Kind, Lang, LinkId, PointId, Scene};
use hodograph_sweep::extreme::{DrivenOutput, Grashof, MotionLimits, OutputExtreme, Swing};
use hodograph_sweep::limit::{Event, EventKind};
use serde_json::{Value as Json, json};
use std::f64::consts::TAU;

/// A writer for one scene, driver and language.
struct LimitWords<'a> {
    scene: &'a Scene,
    limits: &'a MotionLimits,
    lang: Lang,
    name: String,
    angular: bool,
}

/// Returns the report as text.
pub fn text(scene: &Scene, driver: usize, limits: &MotionLimits, lang: Lang) -> String {
    let w = LimitWords::new(scene, driver, limits, lang);
    let mut out = String::new();
    let mut line = |text: String| {
        out.push_str(&text);
        out.push('\n');
    };
    let title = lang.of(&scene.title);
    if !title.is_empty() {
        line(title.to_owned());
    }
    line(w.range());
    if let Some(turns) = w.turns() {
        line(format!("  {turns}"));
    }
    for e in limits.events() {
        line(format!("  {}", w.event(e)));
    }
    if let Some((kind, [a, b, c, d])) = limits.grashof {
        let sums = format!(
            "{} {} {} {}",
            scene.length_words(a),
            scene.length_words(b),
            scene.length_words(c),
            scene.length_words(d)
        );
        let of = tr!(lang, "driver, coupler, output, frame");
        let kind = grashof_words(kind, lang);
        line(say!(lang, "Grashof: {kind} ({of}: {sums})"));
    }
    for s in &limits.swings {
        line(w.swing(s));
        for e in &s.extremes {
            line(format!("  {}", w.extreme(s, e)));
        }
    }
    if let Some(worst) = limits.transmission.iter().min_by(|a, b| a.angle.total_cmp(&b.angle)) {
        line(tr!(lang, "smallest transmission angles γ:").to_owned());
        for t in &limits.transmission {
            let mark = if std::ptr::eq(t, worst) && limits.transmission.len() > 1 {
                tr!(lang, "  (the worst)")
            } else {
                ""
            };
            line(format!(
                "  {} γ = {}{}{mark}",
                w.joint(&t.links, t.pin),
                angle(&scene.book, t.angle),
                w.at(t.driver)
            ));
        }
    }
    out
}

/// Returns the motion of each output in words: its swing or stroke, or the reason that it has none.
pub fn output_words(
    scene: &Scene,
    driver: usize,
    limits: &MotionLimits,
    lang: Lang,
) -> Vec<String> {
    let w = LimitWords::new(scene, driver, limits, lang);
    limits.swings.iter().map(|s| w.swing(s)).collect()
}

/// Returns the name of an output: `phi_3`, `s_C`.
pub fn output_name(scene: &Scene, output: DrivenOutput) -> String {
    match output {
        DrivenOutput::Turning(l) => format!("phi_{}", scene.link_name(l)),
        DrivenOutput::Sliding(g) => {
            let guide = &scene.guides[g.0];
            let point = guide.pin.map(|p| scene.point_name(p));
            let name = point.or(guide.slider.map(|l| scene.link_name(l)));
            format!("s_{}", name.unwrap_or_default())
        }
    }
}

/// Returns the report as JSON, in SI.
pub fn json(scene: &Scene, driver: usize, limits: &MotionLimits) -> Json {
    let w = LimitWords::new(scene, driver, limits, Lang::En);
    let links = |l: &[LinkId]| l.iter().map(|l| scene.link_name(*l)).collect::<Vec<_>>();
    let event = |e: &Event| {
        json!({
            "kind": if e.kind == EventKind::Limit { "limit" } else { "change-point" },
            "driver": e.value,
            "links": links(&e.links),
            "pin": e.pin.map(|p| scene.point_name(p)),
            "why": e.toggle.as_ref().map(|t| t.words(scene, Lang::En)),
        })
    };
    let swings: Vec<Json> = limits
        .swings
        .iter()
        .map(|s| {
            let extremes: Vec<Json> = s.extremes.iter().map(|e| w.extreme_json(e)).collect();
            json!({"output": w.output(s.output), "extremes": extremes, "stroke": s.stroke, "time_ratio": s.time_ratio})
        })
        .collect();
    let transmission: Vec<Json> = limits
        .transmission
        .iter()
        .map(|t| json!({"links": links(&t.links), "pin": t.pin.map(|p| scene.point_name(p)), "angle": t.angle, "driver": w.wrapped(t.driver)}))
        .collect();
    json!({
        "driver": w.name,
        "now": limits.range.now,
        "full_turn": w.angular && limits.range.full(),
        "turns": limits.turns,
        "range": limits.range.ends.iter().map(|e| e.as_ref().map(event)).collect::<Vec<_>>(),
        "change_points": limits.range.changes.iter().map(event).collect::<Vec<_>>(),
        "outputs": swings,
        "transmission": transmission,
        "grashof": limits.grashof.map(|(kind, lengths)| json!({"type": grashof_words(kind, Lang::En), "lengths": lengths})),
    })
}

impl<'a> LimitWords<'a> {
    fn new(scene: &'a Scene, driver: usize, limits: &'a MotionLimits, lang: Lang) -> Self {
        let (name, kind) = scene.driver_name(driver);
        LimitWords { scene, limits, lang, name, angular: kind == Kind::Angle }
    }

    /// Returns a crank's position reduced to [0, 2π) if it rotates fully, or to the number of turns
    /// examined.
    fn wrapped(&self, value: f64) -> f64 {
        if !(self.angular && self.limits.range.full()) {
            return value;
        }
        let all = TAU * self.limits.seen as f64;
        let turned = value.rem_euclid(all);
        // A value within rounding of a full turn is the start.
        if all - turned < 1e-12 { 0.0 } else { turned }
    }

    /// Returns the name of a coordinate in a sentence: Chinese sentences have Greek letters.
    fn coordinate_name(&self, name: &str) -> String {
        if self.lang == Lang::Zh { name.replacen("phi", "φ", 1) } else { name.to_owned() }
    }

    fn value(&self, value: f64) -> String {
        let book = &self.scene.book;
        if self.angular { angle(book, self.wrapped(value)) } else { length(book, value) }
    }

    fn at(&self, value: f64) -> String {
        say!(self.lang, " at {} = {}", self.coordinate_name(&self.name), self.value(value))
    }

    fn range(&self) -> String {
        let r = &self.limits.range;
        match &r.ends {
            [None, None] if self.angular => {
                format!("{} {}", self.coordinate_name(&self.name), tr!(self.lang, "turns fully"))
            }
            [low, high] => {
                let end = |e: &Option<Event>| {
                    e.as_ref().map_or_else(
                        || tr!(self.lang, "no limit found").to_owned(),
                        |e| self.value(e.value),
                    )
                };
                format!(
                    "{} {} {} … {}",
                    self.coordinate_name(&self.name),
                    tr!(self.lang, "goes"),
                    end(low),
                    end(high)
                )
            }
        }
    }

    /// Returns the number of turns after which all wheels are in their initial position; `None` if
    /// it is one.
    fn turns(&self) -> Option<String> {
        let MotionLimits { turns, seen, .. } = self.limits;
        let both = match (*turns, *seen) {
            (1, _) => return None,
            (0, _) => {
                both!("the wheels never stand as before; extreme positions are those of one turn")
            }
            (n, 1) => both!(
                "the wheels stand as before after {n} turns; extreme positions are those of one"
            ),
            (n, _) => both!("the wheels stand as before after {n} turns"),
        };
        let Both { en, zh } = both;
        Some(if self.lang == Lang::Zh { zh } else { en })
    }

    fn joint(&self, links: &[LinkId], pin: Option<PointId>) -> String {
        let names: Vec<_> = links.iter().map(|l| self.scene.link_name(*l)).collect();
        let word = if names.len() == 1 { tr!(self.lang, "link") } else { tr!(self.lang, "links") };
        let names = names.join(self.lang.comma());
        match (pin.map(|p| self.scene.point_name(p)), names.is_empty()) {
            (Some(p), true) => p.to_owned(),
            (Some(p), false) => {
                format!("{word} {names} {} {p}", tr!(self.lang, "position" => "at"))
            }
            (None, _) => format!("{word} {names}"),
        }
    }

    fn event(&self, e: &Event) -> String {
        let what = match e.kind {
            EventKind::Limit => tr!(self.lang, "limit"),
            EventKind::ChangePoint => tr!(self.lang, "change point"),
        };
        let line = || format!("{} {}", self.joint(&e.links, e.pin), tr!(self.lang, "in line"));
        let why = e.toggle.as_ref().map_or_else(line, |t| t.words(self.scene, self.lang));
        format!("{what}{}{}{why}", self.at(e.value), tr!(self.lang, ": "))
    }

    fn output(&self, output: DrivenOutput) -> String {
        output_name(self.scene, output)
    }

    fn size(&self, output: DrivenOutput, value: f64) -> String {
        match output {
            DrivenOutput::Turning(_) => angle(&self.scene.book, value),
            DrivenOutput::Sliding(_) => length(&self.scene.book, value),
        }
    }

    fn swing(&self, s: &Swing) -> String {
        let (lang, name) = (self.lang, self.coordinate_name(&self.output(s.output)));
        let Some(stroke) = s.stroke else {
            return match s.extremes.is_empty() {
                true => format!("{name} {}", tr!(lang, "has no extreme position")),
                false => format!(
                    "{name} {}",
                    tr!(lang, "has no stroke, as no limit of the driver was found")
                ),
            };
        };
        let word = match s.output {
            DrivenOutput::Turning(_) => tr!(lang, "swings"),
            DrivenOutput::Sliding(_) => tr!(lang, "has a stroke of"),
        };
        let ratio = s.time_ratio.map_or(String::new(), |k| {
            let theta = std::f64::consts::PI * (k - 1.0) / (k + 1.0);
            fill(
                tr!(lang, ", time ratio K = {k} (θ = {})"),
                &[("k", &legible(k, 6)), ("", &angle(&self.scene.book, theta))],
            )
        });
        format!("{name} {word} {}{ratio}", self.size(s.output, stroke))
    }

    fn extreme(&self, s: &Swing, e: &OutputExtreme) -> String {
        let remark = match e.until {
            _ if e.at_limit => tr!(self.lang, "  (the driver goes no farther)").to_owned(),
            Some(until) => tr!(self.lang, " to {}  (a dwell)").replace("{}", &self.value(until)),
            None if s.extremes.iter().any(|e| e.at_limit) => String::new(),
            None => tr!(self.lang, "  (a dead centre if it is driven from there)").to_owned(),
        };
        format!(
            "{} = {}{}{remark}",
            self.coordinate_name(&self.output(s.output)),
            self.size(s.output, e.output),
            self.at(e.driver)
        )
    }

    fn extreme_json(&self, e: &OutputExtreme) -> Json {
        json!({"driver": self.wrapped(e.driver), "until": e.until.map(|x| self.wrapped(x)), "output": e.output, "at_limit": e.at_limit})
    }
}

/// Returns Grashof's type in words.
pub fn grashof_words(kind: Grashof, lang: Lang) -> &'static str {
    match kind {
        Grashof::CrankRocker => tr!(lang, "crank-rocker"),
        Grashof::RockerCrank => {
            tr!(lang, "rocker-crank (the rocker drives)")
        }
        Grashof::DoubleCrank => tr!(lang, "double crank (drag link)"),
        Grashof::DoubleRocker => {
            tr!(lang, "double rocker, the coupler turns fully")
        }
        Grashof::TripleRocker => {
            tr!(lang, "double rocker, no link turns fully")
        }
        Grashof::ChangePoint => tr!(lang, "change-point mechanism"),
    }
}

fn angle(book: &Book, rad: f64) -> String {
    // A value within rounding of zero is zero; the angle is a square root, hence the wide
    // tolerance.
    let rad = if rad.abs() < 1e-7 { 0.0 } else { rad };
    book.text(Kind::Angle, &legible(book.value(Kind::Angle, rad), 6))
}

fn length(book: &Book, m: f64) -> String {
    match book.chosen(Kind::Length) {
        Some(unit) => book.text(Kind::Length, &legible(unit.of(m), 6)),
        None => format!("{} mm", legible(m * 1e3, 6)),
    }
}
