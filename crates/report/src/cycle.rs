//! The motion cycle of a machine: the strokes and dwells of its outputs over one cycle of the
//! driver, with the positions at which they change, as text and JSON.
//!
//! The forward stroke of an output is the direction that takes more of the cycle, as a tool cuts
//! slowly and returns quickly; where both take the same, and where a cam moves the output, it is the
//! direction in which the coordinate of the output grows. Positions of the driver are in the order
//! of time: a driver with a negative rate goes through them downwards.

use super::limits::output_name;
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::digits::legible;
use hodograph_base::lang::{say, tr};
use hodograph_scene::{Kind, Lang, Scene};
use hodograph_sweep::extreme::{DrivenOutput, MotionLimits, Swing};
use serde_json::{Value as Json, json};
use std::f64::consts::TAU;

/// Significant digits of positions and strokes.
const DIGITS: usize = 6;
/// Strokes whose parts of the cycle differ by less than this have the same duration.
const EQUAL: f64 = 1e-9;

/// The kind of a part of the cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PhaseKind {
    /// The working stroke.
    Forward,
    /// The stroke back.
    Return,
    /// A rest.
    Dwell,
    /// Moving on without an extreme position.
    Steady,
}

impl PhaseKind {
    /// Returns the word for it.
    pub fn words(self, lang: Lang) -> &'static str {
        match self {
            PhaseKind::Forward => tr!(lang, "forward"),
            PhaseKind::Return => tr!(lang, "return"),
            PhaseKind::Dwell => tr!(lang, "dwell"),
            PhaseKind::Steady => tr!(lang, "no extreme position"),
        }
    }

    fn key(self) -> &'static str {
        self.words(Lang::En)
    }
}

/// A part of the cycle of one output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionPhase {
    /// Its kind.
    pub kind: PhaseKind,
    /// Beginning and end, as the driver's way from the beginning of the cycle (rad or m); an end
    /// beyond the period is in the next cycle.
    pub span: [f64; 2],
    /// The position of the output at the beginning and at the end (rad or m).
    pub output: [f64; 2],
}

/// The cycle of one output.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputCycle {
    /// Its name, such as `phi_3`.
    pub name: String,
    /// The kind of its position.
    pub kind: Kind,
    /// Its stroke (rad or m), if it has one.
    pub stroke: Option<f64>,
    /// Its time ratio K, if it has one.
    pub time_ratio: Option<f64>,
    /// Its phases in the order of time.
    pub phases: Vec<MotionPhase>,
}

/// The cycle of a machine.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionCycle {
    /// The name of the driver and the kind of its position.
    pub driver: (String, Kind),
    /// The driver's position at the beginning and at the end of the cycle (rad or m).
    pub ends: [f64; 2],
    /// True if the motion repeats after the cycle; false for a driver between two ends.
    pub repeats: bool,
    /// The outputs.
    pub outputs: Vec<OutputCycle>,
}

impl MotionCycle {
    /// Returns the cycle of a scene's outputs from the limits of its motion.
    pub fn of(scene: &Scene, driver: usize, limits: &MotionLimits) -> MotionCycle {
        let named = scene.driver_name(driver);
        let repeats = named.1 == Kind::Angle && limits.range.full();
        let ends = match repeats {
            true => [0.0, TAU * limits.seen.max(1) as f64],
            false => limits.range.bounds(),
        };
        let [low, high] = ends;
        let ends = if scene.drivers[driver].rate.value < 0.0 { [high, low] } else { [low, high] };
        let mut cycle = MotionCycle { driver: named, ends, repeats, outputs: Vec::new() };
        cycle.outputs = limits.swings.iter().map(|s| cycle.output(scene, s)).collect();
        cycle
    }

    /// Keeps the outputs with these names, in the order of the names.
    ///
    /// # Errors
    /// `no-output`: a name that no output has.
    pub fn choose(&mut self, names: &[&str]) -> Result<(), Diagnostic> {
        let mut chosen = Vec::new();
        for name in names {
            let Some(output) = self.outputs.iter().find(|o| o.name == *name) else {
                let all: Vec<String> = self.outputs.iter().map(|o| o.name.clone()).collect();
                let message = both!("the mechanism has no output `{name}`");
                let help = both!("its outputs are {}", Both::names(&all));
                return Err(Diagnostic::error("no-output", message).help(help));
            };
            chosen.push(output.clone());
        }
        self.outputs = chosen;
        Ok(())
    }

    /// Returns the driver's way through the cycle.
    pub fn length(&self) -> f64 {
        (self.ends[1] - self.ends[0]).abs()
    }

    /// Returns the driver's position after a way (rad or m), in the first cycle if it repeats.
    pub fn position(&self, way: f64) -> f64 {
        let [from, to] = self.ends;
        let way = if self.repeats { within(way, self.length()) } else { way };
        if to < from { from - way } else { from + way }
    }

    /// Returns the way to a position of the driver.
    fn way(&self, position: f64) -> f64 {
        let [from, to] = self.ends;
        let way = if to < from { from - position } else { position - from };
        if self.repeats { within(way, self.length()) } else { way }
    }

    fn output(&self, scene: &Scene, swing: &Swing) -> OutputCycle {
        let length = self.length();
        // Each extreme as the beginning and the end of a rest in the order of time, and its place.
        let mut rests: Vec<([f64; 2], f64)> = swing
            .extremes
            .iter()
            .map(|e| {
                let rest = e.until.map_or(0.0, |until| (until - e.driver).abs());
                let first = match (e.until, self.ends[1] < self.ends[0]) {
                    (Some(until), true) => until,
                    (None, _) | (_, false) => e.driver,
                };
                let from = self.way(first);
                ([from, from + rest], e.output)
            })
            .collect();
        rests.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
        let mut strokes: Vec<MotionPhase> = Vec::new();
        let mut phases: Vec<MotionPhase> = Vec::new();
        for (k, (rest, at)) in rests.iter().enumerate() {
            if rest[1] > rest[0] {
                let output = [*at, *at];
                phases.push(MotionPhase { kind: PhaseKind::Dwell, span: *rest, output });
            }
            let next = match (rests.get(k + 1), rests.first()) {
                (Some((next, to)), _) => Some((next[0], *to)),
                (None, Some((first, to))) if self.repeats && rests.len() > 1 => {
                    Some((first[0] + length, *to))
                }
                (None, _) => None,
            };
            if let Some((end, to)) = next {
                let kind = if to > *at { PhaseKind::Forward } else { PhaseKind::Return };
                let stroke = MotionPhase { kind, span: [rest[1], end], output: [*at, to] };
                strokes.push(stroke);
                phases.push(stroke);
            }
        }
        let took = |kind| -> f64 {
            strokes.iter().filter(|p| p.kind == kind).map(|p| p.span[1] - p.span[0]).sum()
        };
        let later = took(PhaseKind::Return) - took(PhaseKind::Forward);
        if later > EQUAL * length && !moved_by_cam(scene, swing.output) {
            phases.iter_mut().for_each(|p| p.kind = turned(p.kind));
        }
        // A phase that begins after the end of the cycle is that of the cycle before; the working
        // stroke comes first.
        let repeats = self.repeats;
        for phase in phases.iter_mut().filter(|p| repeats && p.span[0] >= length) {
            phase.span = phase.span.map(|way| way - length);
        }
        if let Some(first) = phases.iter().position(|p| repeats && p.kind == PhaseKind::Forward) {
            phases.rotate_left(first);
        }
        if phases.is_empty() {
            let output = [0.0, 0.0];
            phases.push(MotionPhase { kind: PhaseKind::Steady, span: [0.0, length], output });
        }
        OutputCycle {
            name: output_name(scene, swing.output),
            kind: match swing.output {
                DrivenOutput::Turning(_) => Kind::Angle,
                DrivenOutput::Sliding(_) => Kind::Length,
            },
            stroke: swing.stroke,
            time_ratio: swing.time_ratio,
            phases,
        }
    }

    /// Returns the phases as text: a line for each output, then one for each of its phases.
    pub fn text(&self, scene: &Scene, lang: Lang) -> String {
        let mut out = String::new();
        let title = lang.of(&scene.title);
        if !title.is_empty() {
            out += &format!("{title}\n");
        }
        let driver = named(&self.driver.0, lang);
        let ends = self.ends.map(|x| amount(scene, self.driver.1, x));
        out += &say!(lang, "Motion cycle: {driver} from {} to {}\n", ends[0], ends[1]);
        for output in &self.outputs {
            out += &format!("{}\n", output.heading(scene, lang));
            for phase in &output.phases {
                let [from, to] = phase.span.map(|way| self.place(scene, way));
                let size = amount(scene, self.driver.1, phase.span[1] - phase.span[0]);
                out += &match (lang, phase.kind) {
                    (_, PhaseKind::Steady) => format!("  {}\n", phase.kind.words(lang)),
                    (Lang::En, kind) => {
                        format!("  {} {from} … {to} ({size})\n", kind.words(lang))
                    }
                    (Lang::Zh, kind) => {
                        format!("  {} {from} … {to}（{size}）\n", kind.words(lang))
                    }
                };
            }
        }
        out
    }

    /// Returns the position of the driver after a way, with its unit.
    pub fn place(&self, scene: &Scene, way: f64) -> String {
        amount(scene, self.driver.1, self.position(way))
    }

    /// Returns the phases as JSON, in SI.
    pub fn json(&self) -> Json {
        let phase = |p: &MotionPhase| {
            json!({
                "phase": p.kind.key(),
                "from": self.position(p.span[0]),
                "to": self.position(p.span[1]),
                "way": p.span[1] - p.span[0],
                "output": p.output,
            })
        };
        let outputs = self.outputs.iter().map(|o| {
            json!({
                "output": o.name,
                "stroke": o.stroke,
                "time_ratio": o.time_ratio,
                "phases": o.phases.iter().map(phase).collect::<Vec<_>>(),
            })
        });
        json!({
            "driver": self.driver.0,
            "ends": self.ends,
            "repeats": self.repeats,
            "outputs": outputs.collect::<Vec<_>>(),
        })
    }
}

impl OutputCycle {
    /// Returns name, stroke and time ratio: `phi_3: 60.0°, K = 1.2`.
    pub fn heading(&self, scene: &Scene, lang: Lang) -> String {
        let mut parts = Vec::new();
        parts.extend(
            self.stroke.map(|stroke| {
                format!("{} {}", tr!(lang, "stroke"), amount(scene, self.kind, stroke))
            }),
        );
        parts.extend(self.time_ratio.map(|k| format!("K = {}", legible(k, DIGITS))));
        let name = named(&self.name, lang);
        match parts.is_empty() {
            true => name,
            false => {
                format!("{name}{}{}", tr!(lang, ": "), parts.join(tr!(lang, "clause" => ", ")))
            }
        }
    }
}

/// Returns the name of a coordinate: Chinese sentences have Greek letters.
fn named(name: &str, lang: Lang) -> String {
    if lang == Lang::Zh { name.replacen("phi", "φ", 1) } else { name.to_owned() }
}

/// Returns an angle or a length with its unit; lengths without a chosen unit are in millimetres.
pub fn amount(scene: &Scene, kind: Kind, si: f64) -> String {
    // A position within rounding of zero is zero.
    let si = if si.abs() < 1e-9 { 0.0 } else { si };
    match (kind, scene.book.chosen(kind)) {
        (Kind::Length, None) => format!("{} mm", legible(si * 1e3, DIGITS)),
        (kind, _) => scene.book.text(kind, &legible(scene.book.value(kind, si), DIGITS)),
    }
}

/// Returns a way within one cycle; a way within rounding of a whole cycle is zero.
fn within(way: f64, length: f64) -> f64 {
    let rest = way.rem_euclid(length);
    if length - rest < EQUAL * length { 0.0 } else { rest }
}

fn turned(kind: PhaseKind) -> PhaseKind {
    match kind {
        PhaseKind::Forward => PhaseKind::Return,
        PhaseKind::Return => PhaseKind::Forward,
        PhaseKind::Dwell => PhaseKind::Dwell,
        PhaseKind::Steady => PhaseKind::Steady,
    }
}

/// Returns true if a cam moves an output.
fn moved_by_cam(scene: &Scene, output: DrivenOutput) -> bool {
    let link = match output {
        DrivenOutput::Turning(link) => Some(link),
        DrivenOutput::Sliding(guide) => {
            let guide = &scene.guides[guide.0];
            guide.slider.or_else(|| guide.pin.and_then(|pin| scene.mover(pin)))
        }
    };
    scene.cams.iter().any(|cam| Some(cam.follower) == link)
}
