//! The Coriolis acceleration at each slide of a scene, with the reason if there is none.
//!
//! a_k = 2ω × v_r has a value only if the body that carries the guide turns and the other body
//! slides along it. A guide at rest or in translation has none in any position; a guide without
//! angular velocity and a slide at the end of its travel have none at the instant.

use hodograph_base::diag::{Faults, Warned};
use hodograph_base::geom::Vec2;
use hodograph_mechanism::answer::MotionSource;
use hodograph_mechanism::mechanism::Level;
use hodograph_scene::quantity::{PointMotion, Rate, Turning};
use hodograph_scene::{Asked, Find, GuideId, OnLink, PointId, Scene};
use hodograph_worked::worked::{Scope, Worked, work};

/// The decision on the Coriolis acceleration at a slide.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CoriolisVerdict {
    /// None: the guide is at rest.
    GuideFixed,
    /// None: the guide translates.
    GuideTranslates,
    /// None at the instant: the guide has no angular velocity.
    GuideDwells,
    /// None at the instant: nothing slides.
    NoSliding,
    /// There is one.
    Present,
}

/// A slide with its decision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlideCoriolis {
    /// The guide.
    pub guide: GuideId,
    /// The point that slides: the pin, or the first point of the slider; `None` for a slider
    /// without points.
    pub at: Option<PointId>,
    /// The decision.
    pub verdict: CoriolisVerdict,
    /// The angular velocity of the body that carries the guide (rad/s).
    pub omega: f64,
    /// The velocity along the guide v_r (m/s).
    pub relative: Vec2,
}

impl SlideCoriolis {
    /// Returns a_k = 2ω × v_r (m/s²).
    pub fn acceleration(&self) -> Vec2 {
        self.relative.perp() * (2.0 * self.omega)
    }
}

/// An angular velocity or velocity below this fraction of the largest one is a rounding error.
const ROUNDING: f64 = 1e-9;

/// Solves a scene and decides on each of its slides; guides of rolling pairs are left out.
///
/// # Errors
/// The faults of the scene.
pub fn coriolis(scene: &Scene) -> Result<(Worked, Vec<SlideCoriolis>), Faults> {
    let slides: Vec<(GuideId, Option<OnLink>)> = (0..scene.guides.len())
        .map(GuideId)
        .filter(|g| scene.guides[g.0].rolling.is_none())
        .map(|g| (g, runner(scene, g)))
        .collect();
    let mut asking = scene.clone();
    let ask = |what: Asked| Find { what, text: String::new(), span: Default::default() };
    asking.find = Vec::new();
    for (g, of) in &slides {
        let on = scene.guides[g.0].on;
        if let Some(of) = of {
            let seat = OnLink { point: of.point, link: Some(on) };
            let both = [*of, seat].map(|of| PointMotion { rate: Rate::Velocity, of });
            asking.find.extend(both.map(|m| ask(m.into())));
        }
        if on != scene.ground {
            asking.find.push(ask(Turning { rate: Rate::Velocity, of: on, against: None }.into()));
        }
    }
    let Warned { value: worked, .. } = work(&asking, Scope::Figure)?;
    let decided = slides.iter().filter_map(|(g, of)| decide(scene, &worked, *g, *of)).collect();
    Ok((worked, decided))
}

/// Returns the point of a slide that runs along the guide.
fn runner(scene: &Scene, g: GuideId) -> Option<OnLink> {
    let guide = &scene.guides[g.0];
    let of_slider = || {
        let slider = guide.slider?;
        let point = *scene.links[slider.0].points.first()?;
        Some(OnLink { point, link: Some(slider) })
    };
    guide.pin.map(|point| OnLink { point, link: None }).or_else(of_slider)
}

/// Decides on a slide; `None` if the guide turns and its motion, or that of the slide, is not known.
fn decide(scene: &Scene, worked: &Worked, g: GuideId, of: Option<OnLink>) -> Option<SlideCoriolis> {
    let (on, motion) = (scene.guides[g.0].on, &worked.solution);
    let velocity = |p: PointId, link| motion.vector(Level::Velocity, p, link);
    let relative =
        of.and_then(|of| Some(velocity(of.point, of.link)? - velocity(of.point, Some(on))?));
    let turns = on != scene.ground && !worked.mechanism.never_turns[on.0];
    let (omega, relative) = match turns {
        true => (motion.turning(Level::Velocity, on)?, relative?),
        false => (0.0, relative.unwrap_or(Vec2::ZERO)),
    };
    let small = |x: f64, turning| x <= ROUNDING * motion.largest(Level::Velocity, turning);
    let verdict = if on == scene.ground {
        CoriolisVerdict::GuideFixed
    } else if !turns {
        CoriolisVerdict::GuideTranslates
    } else if small(omega.abs(), true) {
        CoriolisVerdict::GuideDwells
    } else if small(relative.norm(), false) {
        CoriolisVerdict::NoSliding
    } else {
        CoriolisVerdict::Present
    };
    Some(SlideCoriolis { guide: g, at: of.map(|of| of.point), verdict, omega, relative })
}

#[cfg(test)]
mod tests {
    use super::*;
    use hodograph_scene::read;
    use hodograph_scene::templates::instantiate;

    fn verdict(template: &str, values: &[(&str, &str)], pin: &str) -> (CoriolisVerdict, f64) {
        let scene = read(instantiate(template, values).unwrap()).unwrap().value;
        let (_, all) = coriolis(&scene).unwrap();
        let here = |s: &&SlideCoriolis| s.at.is_some_and(|p| scene.point_name(p) == pin);
        let found = all.iter().find(here).unwrap();
        (found.verdict, found.acceleration().norm())
    }

    #[test]
    fn a_guide_at_rest_or_in_translation_and_two_poses_have_none() {
        let at = |phi| verdict("slotted-lever", &[("phi_1", phi)], "B").0;
        assert_eq!(verdict("slider-crank", &[], "C").0, CoriolisVerdict::GuideFixed);
        assert_eq!(verdict("scotch-yoke", &[], "B").0, CoriolisVerdict::GuideTranslates);
        // The crank of 100 mm is square to the lever, or in line with it.
        assert_eq!(at("acos(l_AB/l_AC) - 90 deg"), CoriolisVerdict::GuideDwells);
        assert_eq!(at("-90 deg - acos(l_AB/l_AC)"), CoriolisVerdict::GuideDwells);
        assert_eq!(at("90 deg"), CoriolisVerdict::NoSliding);
        assert_eq!(at("-90 deg"), CoriolisVerdict::NoSliding);
    }

    /// 2 ω₃ v_r of the lever: the crank 0.1 m at 30°, the frame 0.25 m, ω₁ = 10 rad/s.
    #[test]
    fn a_turning_guide_has_two_omega_times_the_sliding() {
        let (verdict, size) = verdict("slotted-lever", &[], "B");
        let (x, y) = (0.1 * 0.75_f64.sqrt(), 0.1 * 0.5 + 0.25);
        let (r2, v) = (x * x + y * y, [-0.5, 0.75_f64.sqrt()]);
        let omega = (x * v[1] - y * v[0]) / r2;
        let sliding = (x * v[0] + y * v[1]) / r2.sqrt();
        assert_eq!(verdict, CoriolisVerdict::Present);
        assert!((size - (2.0 * omega * sliding).abs()).abs() < 1e-12, "{size}");
    }
}
