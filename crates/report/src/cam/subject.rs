//! The lines of a cam's report by their subjects, as sentences.

use super::{DIGITS, Report};
use hodograph_base::cam::PieceSide;
use hodograph_base::digits::legible;
use hodograph_base::lang::tr;
use hodograph_paper::paper::phrase::capital;
use hodograph_scene::Lang;

/// The subject of a line of the report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CamSubject {
    /// Kind of cam, radii, offset or arm.
    Data,
    /// Stroke, angles and stages of the law of motion.
    Law,
    /// Extremes of the velocity.
    Velocity,
    /// Extremes of the acceleration, and shocks.
    Acceleration,
    /// Greatest pressure angles.
    Pressure,
    /// Least radius of curvature.
    Curvature,
    /// Values at the instant.
    Instant,
}

impl Report<'_> {
    /// Returns the lines on a subject as one sentence.
    pub fn sentence(&self, subject: CamSubject, lang: Lang) -> Option<String> {
        let lines = self.lines(lang).into_iter().filter(|(of, _)| *of == subject);
        let lines: Vec<String> = lines
            .map(|(_, line)| line.trim().replace("  ", tr!(lang, "clause" => ", ")))
            .map(|line| line.replace("r_r ", "$r_{r}$ "))
            .collect();
        let [between, stop] = [lang.semicolon(), tr!(lang, ".")];
        (!lines.is_empty()).then(|| format!("{}{stop}", capital(&lines.join(between))))
    }

    /// Returns the lift at a cam angle with its unit.
    pub fn lift_words(&self, phi: f64) -> Option<String> {
        let [lift, ..] = self.survey.lift(self.disc(), phi, PieceSide::After)?;
        Some(match self.swings() {
            true => format!("{}°", legible(lift.to_degrees(), DIGITS)),
            false => self.scene.length_words(lift),
        })
    }
}
