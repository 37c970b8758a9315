//! The equations of motion of points that drivers move directly.

use super::{DisplayedFormula, LoopWords, equation_json, gives, plain};
use hodograph_base::lang::{say, tr};
use hodograph_board::plan::names::{name_label, point_label};
use hodograph_methods::loops::{Equation, FrameEquations, LoopVariable, PointEquations};
use hodograph_paper::paper::phrase::Phrase;
use hodograph_scene::Kind;
use hodograph_scene::quantity::Frame;
use serde_json::{Value as Json, json};

/// A heading, its sentences each with the equations below it.
pub struct WrittenMotion {
    /// The point, or the frame.
    pub heading: Phrase,
    /// The sentences.
    pub parts: Vec<(Phrase, Vec<Equation>)>,
}

impl LoopWords<'_> {
    /// Returns the given motions: the law of each variable, or its value and rates at the instant.
    pub fn given_motions(&self) -> Vec<Phrase> {
        let line = |v: &LoopVariable| {
            // Formulas of their own, between which a line can break.
            let comma = format!("${}$", tr!(self.lang, "clause" => ", "));
            let values = [0, 1, 2].map(|order| self.variable(v, order)).join(&comma);
            let driver = &self.scene.drivers[v.driver?];
            let relative = driver.kind.turned().is_some_and(|(_, l)| l != self.scene.ground);
            let law = driver.law.as_ref().filter(|_| !relative).map(|law| law.text.clone());
            let symbol = v.symbol(0).text();
            let lang = self.lang;
            Some(Phrase::new(&match (law, self.constant(v)) {
                (Some(law), _) => {
                    say!(lang, "${symbol}$ = {law}; at $t = {}$: ${values}$", self.instant())
                }
                (None, Some(law)) => say!(lang, "${symbol} = {law}$; at the instant: ${values}$"),
                (None, None) => say!(lang, "at the instant: ${values}$"),
            }))
        };
        self.all.motion.variables.iter().filter_map(line).collect()
    }

    /// Returns the law of a variable with a constant acceleration, with the time from the instant;
    /// `None` if a law of time moves a driver.
    fn constant(&self, v: &LoopVariable) -> Option<String> {
        if self.scene.has_laws_of_time() || v.rate == 0.0 && v.second == 0.0 {
            return None;
        }
        let mut out = self.number(Some(v.kind(0)), v.value);
        for (k, rate, power) in [(1, v.rate, "t"), (2, 0.5 * v.second, "t^2")] {
            if rate != 0.0 {
                let sign = if rate < 0.0 { "−" } else { "+" };
                out += &format!(" {sign} ({})\\,{power}", self.number(Some(v.kind(k)), rate.abs()));
            }
        }
        Some(out)
    }

    fn instant(&self) -> String {
        self.number(Some(Kind::Time), self.scene.instant())
    }

    /// Returns the equations of motion of all points.
    pub fn motions(&self) -> Vec<WrittenMotion> {
        self.all.motion.points.iter().flat_map(|p| self.of_point(p)).collect()
    }

    fn of_point(&self, p: &PointEquations) -> Vec<WrittenMotion> {
        let lang = self.lang;
        let name = point_label(self.scene.point_name(p.of));
        let rates = || Phrase::new(tr!(lang, "Differentiated with respect to time:"));
        let seconds = || Phrase::new(tr!(lang, "Differentiated once more:"));
        let mut out = Vec::new();
        if let Some([place, velocity, acceleration]) = &p.absolute {
            out.push(WrittenMotion {
                heading: Phrase::new(&say!(lang, "Equations of motion of ${name}$")),
                parts: vec![
                    (Phrase::new(tr!(lang, "Coordinates:")), place.to_vec()),
                    (rates(), velocity.to_vec()),
                    (seconds(), acceleration.to_vec()),
                ],
            });
        }
        for f in &p.frames {
            let [place, velocity, acceleration] = &f.relative;
            let mut parts = Vec::new();
            if let Some(both) = &f.from_relative {
                let words = tr!(lang, "Absolute coordinates by relative ones:");
                parts.push((Phrase::new(words), both.to_vec()));
            }
            let words = tr!(lang, "Relative equations of motion:");
            parts.push((Phrase::new(words), place.to_vec()));
            let [v, a] = f.sizes.clone();
            parts.push((rates(), velocity.iter().cloned().chain([v]).collect()));
            parts.push((seconds(), acceleration.iter().cloned().chain([a]).collect()));
            out.push(WrittenMotion { heading: self.of_frame(&name, f), parts });
        }
        out
    }

    fn of_frame(&self, name: &str, f: &FrameEquations) -> Phrase {
        let scene = self.scene;
        let origin = point_label(scene.point_name(f.origin));
        Phrase::new(&match f.frame {
            Frame::Link(l) => {
                let line = self.axis(&scene.links[l.0].points);
                say!(
                    self.lang,
                    "Motion of ${name}$ in the axes of link {}, from ${origin}${line}",
                    scene.link_name(l)
                )
            }
            Frame::Point(_) => {
                say!(self.lang, "Motion of ${name}$ in axes that translate with ${origin}$")
            }
        })
    }

    /// Returns the words for the line of the x′ axis.
    fn axis(&self, points: &[hodograph_scene::PointId]) -> String {
        let [a, b, ..] = points else { return String::new() };
        let line = [a, b].map(|p| self.scene.point_name(*p)).concat();
        let line = name_label(&line);
        say!(self.lang, " with $x'$ along ${line}$")
    }

    /// Returns the given motions in steps, each a sentence.
    pub fn given_steps(&self) -> Vec<String> {
        let step = |p: Phrase| say!(self.lang, "Given motion: {}.", p.source());
        self.given_motions().into_iter().map(step).collect()
    }

    /// Returns the equations of motion of each point, and of each in a frame, in steps: sentences
    /// with the formulas below them.
    pub fn motion_steps(&self) -> Vec<Vec<(String, Vec<DisplayedFormula>)>> {
        let steps = |WrittenMotion { heading, parts }: WrittenMotion| {
            let sentence = |(k, (words, equations)): (usize, (Phrase, Vec<Equation>))| {
                let below = equations.iter().map(|e| self.display(e)).collect();
                let words = words.source();
                match k {
                    0 => (format!("{}{}{words}", heading.source(), tr!(self.lang, ". ")), below),
                    _ => (words, below),
                }
            };
            parts.into_iter().enumerate().map(sentence).collect()
        };
        self.motions().into_iter().map(steps).collect()
    }

    /// Returns the equations of motion as lines of text.
    pub(super) fn motion_lines(&self) -> Vec<String> {
        let motions = self.motions();
        if motions.is_empty() {
            return Vec::new();
        }
        let given = tr!(self.lang, "given motions:").to_owned();
        let mut lines = vec![String::new(), given];
        lines.extend(self.given_motions().iter().map(|p| format!("  {}", p.plain())));
        for m in motions {
            lines.extend([String::new(), m.heading.plain()]);
            for (words, equations) in m.parts {
                lines.push(format!("  {}", words.plain()));
                lines.extend(equations.iter().map(|e| {
                    let equation = plain(&format!("{} = {}", e.left.text(), e.right.text()));
                    match gives(e) && e.left.text() != e.right.text() {
                        true => format!("    {equation} = {}", plain(&self.value_of(e))),
                        false => format!("    {equation}"),
                    }
                }));
            }
        }
        lines
    }

    /// Returns the equations of motion as JSON.
    pub(super) fn motion_json(&self) -> Json {
        let list = |equations: &[Equation]| equations.iter().map(equation_json).collect::<Vec<_>>();
        let orders = |all: &[[Equation; 2]; 3]| {
            let [place, velocity, acceleration] = all;
            json!({
                "position": list(place), "velocity": list(velocity),
                "acceleration": list(acceleration),
            })
        };
        let frame = |f: &FrameEquations| {
            json!({
                "frame": match f.frame {
                    Frame::Link(l) => json!({"link": self.scene.link_name(l)}),
                    Frame::Point(p) => json!({"point": self.scene.point_name(p.point)}),
                },
                "origin": self.scene.point_name(f.origin),
                "from_relative": f.from_relative.as_ref().map(|both| list(both)),
                "relative": orders(&f.relative),
                "sizes": list(&f.sizes),
            })
        };
        self.all
            .motion
            .points
            .iter()
            .map(|p| {
                json!({
                    "point": self.scene.point_name(p.of),
                    "absolute": p.absolute.as_ref().map(orders),
                    "frames": p.frames.iter().map(frame).collect::<Vec<_>>(),
                })
            })
            .collect()
    }
}
