//! The least base circle for an allowed pressure angle, as text and JSON.

use super::{DIGITS, Report, degrees};
use hodograph_base::cam::{
    AllowedPressure, CamSurvey, Follower, FollowerTip, LeastCam, PressureDiagram,
};
use hodograph_base::diag::{Diagnostic, both};
use hodograph_base::digits::{legible, minus};
use hodograph_base::lang::{say, tr};
use hodograph_scene::{Kind, Lang};
use serde_json::{Value as Json, json};

/// The part of the least radius of curvature of the pitch curve that a roller has at most (孙桓).
const ROLLER: f64 = 0.8;

/// The least cams of a report for allowed pressure angles.
#[derive(Clone, Debug)]
pub struct LeastCams {
    /// The allowed angles.
    pub allowed: AllowedPressure,
    /// The least cam with the offset of the scene; `None` for a follower that turns.
    pub kept: Option<LeastCam>,
    /// The least cam of all.
    pub best: LeastCam,
}

impl Report<'_> {
    /// Finds the least cams for allowed pressure angles.
    ///
    /// # Errors
    /// `cam-alpha` for a profile that is given, for a flat face, and if no place of the centre keeps
    /// the angles.
    pub fn least(&self, allowed: AllowedPressure) -> Result<LeastCams, Diagnostic> {
        let name = self.scene.link_name(self.cam.cam);
        let wrong = |d: Diagnostic| d.at(self.cam.span);
        let diagram = PressureDiagram::of(self.disc(), allowed).ok_or_else(|| {
            let message = both!(
                "the base circle of cam `{name}` does not follow from a pressure angle: its profile is given, or its follower has a flat face"
            );
            wrong(Diagnostic::error("cam-alpha", message).help(both!(
                "give \"profile\": {{\"base\": ..., \"law\": [...]}} and an edge, a roller or a round end"
            )))
        })?;
        let kept = match self.disc().follower {
            Follower::Translating { offset, .. } => diagram.clone().least(allowed, Some(offset)),
            Follower::Oscillating { .. } => None,
        };
        let best = diagram.least(allowed, None).ok_or_else(|| {
            let message = both!("no place of the centre of cam `{name}` keeps the pressure angles");
            wrong(
                Diagnostic::error("cam-alpha", message)
                    .help(both!("allow larger angles, or give the stages more of the turn")),
            )
        })?;
        Ok(LeastCams { allowed, kept, best })
    }

    fn length(&self, metres: f64) -> String {
        match self.scene.book.chosen(Kind::Length) {
            Some(unit) => unit.text(&minus(&legible(unit.of(metres), DIGITS))),
            None => {
                let unit = self.scene.length_unit;
                let value = metres * unit.denominator / unit.numerator;
                format!("{} {}", minus(&legible(value, DIGITS)), unit.name)
            }
        }
    }

    /// Returns the radius of the follower's end (m).
    fn end(&self) -> f64 {
        match self.disc().touch {
            FollowerTip::Point { radius } => radius,
            FollowerTip::Flat { .. } => 0.0,
        }
    }

    /// Returns the offset of a cam, positive towards the instantaneous centre on the outward motion,
    /// or the distance of its pivots (m).
    fn apart(&self, of: &LeastCam) -> f64 {
        match of.pitch.follower {
            Follower::Translating { offset, .. } => offset * self.disc().sense,
            Follower::Oscillating { pivot, .. } => pivot.norm(),
        }
    }

    /// Returns the least cams as text.
    pub fn least_text(&self, least: &LeastCams, lang: Lang) -> String {
        let AllowedPressure { rise, back } = least.allowed;
        let (rise, back) = (degrees(rise), degrees(back));
        let mut out = say!(lang, "  allowed pressure angle {rise} out, {back} back\n");
        let kept = least.kept.as_ref().map(|c| (c, tr!(lang, "with this offset")));
        let best = match self.disc().follower {
            Follower::Translating { .. } => tr!(lang, "with the best offset"),
            Follower::Oscillating { .. } => {
                tr!(lang, "with the best distance of the pivots")
            }
        };
        for (of, name) in kept.into_iter().chain([(&least.best, best)]) {
            out += &self.least_lines(of, name, lang);
        }
        out
    }

    fn least_lines(&self, of: &LeastCam, name: &str, lang: Lang) -> String {
        let symbol = if self.swings() { "d" } else { "e" };
        let apart = format!("{symbol} = {}", self.length(self.apart(of)));
        let [pitch, base] = [of.pitch_base, of.base(self.end())].map(|r| self.length(r));
        let mut out = say!(
            lang,
            "    {name} {apart}: least base circle of the pitch curve {pitch}, of the profile r₀ = {base}\n"
        );
        let mut at: Vec<(f64, bool)> = of.touched.iter().map(|(w, _)| (w.phi, w.rising)).collect();
        at.sort_by(|a, b| a.0.total_cmp(&b.0));
        let at: Vec<String> = at
            .into_iter()
            .map(|(phi, rising)| {
                let way = if rising { tr!(lang, "cam" => "out") } else { tr!(lang, "back") };
                let phi = degrees((phi * 1e6).round() / 1e6);
                match lang {
                    Lang::En => format!("φ = {phi} ({way})"),
                    Lang::Zh => format!("φ = {phi}（{way}）"),
                }
            })
            .collect();
        let at = at.join(lang.comma());
        out += &say!(lang, "      the allowed angle is reached at {at}\n");
        if let Some(rho) = least_radius(of) {
            let (rho, most) = (self.length(rho), self.length(ROLLER * rho));
            out += &say!(
                lang,
                "      least convex radius of the pitch curve ρ = {rho}: roller r_r ≤ 0.8 ρ = {most}\n"
            );
        }
        out
    }

    /// Returns the least cams as JSON: SI, angles in radians.
    pub fn least_json(&self, least: &LeastCams) -> Json {
        let one = |of: &LeastCam| {
            let rho = least_radius(of);
            json!({
                "offset": (!self.swings()).then(|| self.apart(of)),
                "distance": self.swings().then(|| self.apart(of)),
                "pitch_base": of.pitch_base,
                "base": of.base(self.end()),
                "reached": of.touched.iter().map(|(w, _)| w.phi).collect::<Vec<_>>(),
                "least_rho": rho,
                "greatest_roller": rho.map(|r| ROLLER * r),
            })
        };
        json!({
            "allowed": {"rise": least.allowed.rise, "return": least.allowed.back},
            "kept": least.kept.as_ref().map(one),
            "best": one(&least.best),
        })
    }
}

/// Returns the least convex radius of the pitch curve (m).
fn least_radius(of: &LeastCam) -> Option<f64> {
    CamSurvey::of(&of.pitch).least_rho.map(|(_, rho)| rho)
}
