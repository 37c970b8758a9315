//! Mean balancing moment, surplus energy and flywheel.

use super::LimitWords;
use hodograph_base::digits::legible;
use hodograph_base::lang::{say, tr};
use hodograph_scene::{Kind, Lang, Scene};
use hodograph_sweep::energy::Energy;
use hodograph_sweep::extreme::MotionLimits;
use serde_json::{Value as Json, json};

/// Energy of a period, with the driver's mean speed (rad/s) and the requested coefficient of speed
/// fluctuation.
#[derive(Clone, Debug, PartialEq)]
pub struct BalancedEnergy {
    /// Mean moment and surplus energy.
    pub energy: Energy,
    /// Mean speed (rad/s).
    pub rate: f64,
    /// δ = (ω_max − ω_min)/ω.
    pub delta: Option<f64>,
}

impl BalancedEnergy {
    /// Returns the lines of text.
    pub fn text(&self, scene: &Scene, driver: usize, limits: &MotionLimits, lang: Lang) -> String {
        let w = LimitWords::new(scene, driver, limits, lang);
        let of = |kind: Kind, x: f64| scene.book.text(kind, &legible(scene.book.value(kind, x), 6));
        let e = &self.energy;
        let mut out =
            format!("{}{}\n", tr!(lang, "mean balancing moment "), of(Kind::Moment, e.mean));
        let surplus = legible(e.surplus, 6);
        out += &say!(
            lang,
            "  greatest surplus of energy ΔW = {surplus} J: slowest{}, fastest{}\n",
            w.at(e.slowest),
            w.at(e.fastest)
        );
        if let Some(delta) = self.delta {
            let inertia = legible(e.flywheel(self.rate, delta), 6);
            let rpm = |part: f64| {
                legible((self.rate.abs() * (1.0 + part * delta)) * 30.0 / std::f64::consts::PI, 6)
            };
            let (slow, fast) = (rpm(-0.5), rpm(0.5));
            let delta = legible(delta, 6);
            out += &say!(
                lang,
                "  flywheel for δ = {delta}: J_F = ΔW/(ω²δ) = {inertia} kg·m²; {slow} to {fast} r/min\n"
            );
        }
        out
    }

    /// Returns the numbers as JSON, in SI units.
    pub fn json(&self) -> Json {
        let e = &self.energy;
        json!({
            "period": e.period,
            "mean_moment": e.mean,
            "surplus": e.surplus,
            "slowest": e.slowest,
            "fastest": e.fastest,
            "delta": self.delta,
            "flywheel": self.delta.map(|delta| e.flywheel(self.rate, delta)),
        })
    }
}
