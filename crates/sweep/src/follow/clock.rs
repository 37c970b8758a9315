//! The motion of all drivers through time: each by its law, else with the constant acceleration
//! that it has at the instant.
//!
//! Laws of time are evaluated anew at every time ([`Variation`] over `t`); nothing is extrapolated
//! from the instant.

use crate::station::position_now;
use crate::vary::Variation;
use hodograph_mechanism::position::Configuration;
use hodograph_scene::eval::DimensionedValue;
use hodograph_scene::front::TIME;
use hodograph_scene::{GivenQuantity, Scene, Swept, driver_position, with_driver_at};
use std::f64::consts::TAU;

/// The greatest number of turns of the fastest driver that are shown.
const TURNS_SEEN: f64 = 3.0;
/// The number of times at which the angles of drivers are sampled.
const SAMPLES: usize = 256;
/// The number of halvings of the time between two samples.
const HALVINGS: usize = 50;
/// The number of times that a shorter range is sampled anew: finer samples may find more travel.
const ROUNDS: usize = 8;
/// A step of a driver (rad): 10°.
const STEP: f64 = std::f64::consts::PI / 18.0;

/// The motion of every driver.
#[derive(Clone)]
pub struct Clock {
    /// The scene at its instant.
    scene: Scene,
    /// The position of each driver at the instant (rad or m).
    positions: Vec<f64>,
    /// The quantities that depend on t, and the value of one second; `None` without laws of time.
    laws: Option<(Variation, DimensionedValue)>,
}

/// The motion of a driver some time after the instant, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gone {
    /// The travel since the instant.
    pub by: f64,
    /// The rate at that time.
    pub rate: f64,
    /// The acceleration at that time.
    pub acceleration: f64,
}

impl Clock {
    /// Makes the clock of a scene placed at its instant.
    pub fn of(scene: &Scene, at: &Configuration) -> Clock {
        let laws = scene.has_laws_of_time().then(|| {
            let variation = Variation::of(scene, &[TIME]).ok()?;
            let second = variation.value(scene, TIME, "1 s").ok()?;
            Some((variation, second))
        });
        let positions = (0..scene.drivers.len()).map(|d| position_now(scene, at, d)).collect();
        Clock { scene: scene.clone(), positions, laws: laws.flatten() }
    }

    /// Returns the motion of the drivers `t` seconds after the instant; `None` where a law has no
    /// value.
    pub fn gone(&self, t: f64) -> Option<Vec<Gone>> {
        let mut there = None;
        if let Some((laws, second)) = &self.laws {
            let mut scene = self.scene.clone();
            laws.set(
                &mut scene,
                &[DimensionedValue { number: self.scene.instant() + t, ..*second }],
            )
            .ok()?;
            there = Some(scene);
        }
        let of = |d: usize| {
            let now = &self.scene.drivers[d];
            if let (Some(scene), Some(_)) = (&there, &now.law) {
                let driver = &scene.drivers[d];
                let by = driver_position(scene, d)? - driver_position(&self.scene, d)?;
                return Some(Gone {
                    by,
                    rate: driver.rate.value,
                    acceleration: driver.acceleration.as_ref().map_or(0.0, |a| a.value),
                });
            }
            let (rate, acceleration) =
                (now.rate.value, now.acceleration.as_ref().map_or(0.0, |a| a.value));
            Some(Gone {
                by: rate * t + 0.5 * acceleration * t * t,
                rate: rate + acceleration * t,
                acceleration,
            })
        };
        let gone: Vec<Gone> = (0..self.scene.drivers.len()).map(of).collect::<Option<_>>()?;
        gone.iter()
            .all(|g| g.by.is_finite() && g.rate.is_finite() && g.acceleration.is_finite())
            .then_some(gone)
    }

    /// Returns a scene at a time `t` after the instant (s): the drivers have their positions, rates
    /// and accelerations of that time.
    pub fn scene_at(&self, scene: &Scene, t: f64) -> Scene {
        let Some(gone) = self.gone(t) else { return scene.clone() };
        let mut there = scene.clone();
        for (d, g) in gone.iter().enumerate().filter(|(d, _)| !scene.is_led(*d)) {
            let driver = &mut there.drivers[d];
            let (turns, span) = (driver.kind.turns(), driver.rate.span);
            let given = |value: f64, units: [&str; 2]| {
                let text = format!("({value:?}) {}", units[usize::from(!turns)]);
                GivenQuantity { value, radius: value.abs() * f64::EPSILON, text, span }
            };
            driver.rate = given(g.rate, ["rad/s", "m/s"]);
            driver.acceleration =
                (g.acceleration != 0.0).then(|| given(g.acceleration, ["rad/s^2", "m/s^2"]));
            // The driver's rates decide on which side the followers of cams are placed.
            let position = driver_position(scene, d).unwrap_or(self.positions[d]);
            there = with_driver_at(&there, d, position + g.by);
        }
        there
    }

    /// Returns the times before and after the instant for which the motion is shown (s): those of
    /// [`Clock::usual_reach`], but on either side at most three turns of actual travel of the
    /// driver that turns farthest.
    pub fn reach(&self, extent: f64) -> [f64; 2] {
        let [before, after] = self.usual_reach(extent);
        [-self.within_turns(-before), self.within_turns(after)]
    }

    /// Returns the part of the time from the instant to `to` (s) in which no driver travels more
    /// than three turns, to and fro.
    fn within_turns(&self, mut to: f64) -> f64 {
        for _ in 0..ROUNDS {
            match self.three_turns(to) {
                Some(sooner) if sooner != to => to = sooner,
                Some(_) | None => break,
            }
        }
        to
    }

    /// Returns the time on the way to another one (s) at which the first driver has travelled three
    /// turns; `None` if none does.
    fn three_turns(&self, to: f64) -> Option<f64> {
        const MOST: f64 = TURNS_SEEN * TAU;
        let turning = self.turning();
        let mut turned = vec![0.0; turning.len()];
        let (mut last, mut from) = (self.gone(0.0)?, 0.0);
        for k in 1..=SAMPLES {
            let t = to * (k as f64 / SAMPLES as f64);
            let Some(gone) = self.gone(t) else { continue };
            let more = |gone: &[Gone], d: usize| (gone[d].by - last[d].by).abs();
            // Three turns at constant rate are three turns but for rounding.
            let passes = |gone: &[Gone]| {
                let mut all = turning.iter().zip(&turned);
                all.any(|(d, turned)| turned + more(gone, *d) > MOST * (1.0 + 1e-9))
            };
            if passes(&gone) {
                let mut outside = t;
                for _ in 0..HALVINGS {
                    let middle = 0.5 * (from + outside);
                    match self.gone(middle) {
                        Some(gone) if !passes(&gone) => from = middle,
                        Some(_) | None => outside = middle,
                    }
                }
                return Some(from);
            }
            turning.iter().zip(&mut turned).for_each(|(d, turned)| *turned += more(&gone, *d));
            (last, from) = (gone, t);
        }
        None
    }

    /// The turning drivers.
    fn turning(&self) -> Vec<usize> {
        (0..self.scene.drivers.len()).filter(|d| self.scene.drivers[*d].kind.turns()).collect()
    }

    /// Returns the usual times before and after the instant (s): with laws
    /// from t = 0 to twice the instant; without them, or at t = 0, onward through a turn of the
    /// slowest turning driver, but at most three of the fastest. If all drivers slide, the time of
    /// travel through the mechanism's size: in both directions, with laws onward only; with laws
    /// and no motion, one second.
    pub fn usual_reach(&self, extent: f64) -> [f64; 2] {
        let instant = self.scene.instant();
        if self.laws.is_some() && instant > 0.0 {
            return [instant, instant];
        }
        let own = (0..self.scene.drivers.len())
            .filter(|d| !self.scene.is_led(*d))
            .map(|d| &self.scene.drivers[d]);
        let (mut turns, mut slides) = (Vec::new(), 0.0_f64);
        for d in own.filter(|d| d.rate.value != 0.0) {
            match d.kind.turns() {
                true => turns.push(TAU / d.rate.value.abs()),
                false => slides = slides.max(extent / d.rate.value.abs()),
            }
        }
        let [fastest, slowest] = turns
            .iter()
            .fold([f64::INFINITY, 0.0_f64], |[least, most], t| [least.min(*t), most.max(*t)]);
        match (self.laws.is_some(), turns.is_empty()) {
            // A law at t = 0 gives no time by itself.
            (true, true) if slides == 0.0 => [0.0, 1.0],
            (true, true) => [0.0, slides],
            (false, true) => [slides; 2],
            (_, false) => [0.0, slowest.min(TURNS_SEEN * fastest)],
        }
    }

    /// Returns the number of steps in which no driver turns by more than 10° each.
    pub fn steps(&self, [before, after]: [f64; 2]) -> usize {
        let turning = self.turning();
        let mut turned = vec![0.0; turning.len()];
        let mut last: Option<Vec<Gone>> = None;
        for k in 0..=SAMPLES {
            let Some(gone) = self.gone((before + after) * (k as f64 / SAMPLES as f64) - before)
            else {
                continue;
            };
            if let Some(last) = &last {
                turning
                    .iter()
                    .zip(&mut turned)
                    .for_each(|(d, turned)| *turned += (gone[*d].by - last[*d].by).abs());
            }
            last = Some(gone);
        }
        let most = turned.into_iter().fold(0.0, f64::max);
        libm::ceil(most / STEP) as usize
    }
}

/// The moving quantity: a driver, or the time with the drivers' motion.
pub(super) enum SweptVariable {
    Driver(usize),
    Time(Box<Clock>),
}

impl SweptVariable {
    pub fn of(scene: &Scene, at: &Configuration, swept: Swept) -> SweptVariable {
        match swept {
            Swept::Driver(d) => SweptVariable::Driver(d),
            Swept::Time => SweptVariable::Time(Box::new(Clock::of(scene, at))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::PlacedScene;
    use hodograph_mechanism::mechanism::Mechanism;
    use hodograph_scene::{read, templates};

    fn clock(scene: &Scene) -> Clock {
        let m = Mechanism::new(scene).unwrap().value;
        Clock::of(scene, &PlacedScene::new(scene, &m).unwrap().at)
    }

    /// At any time the clock gives the same drivers as the scene with that instant.
    #[test]
    fn a_law_at_another_time_is_the_scene_at_that_instant() {
        for name in ["plate-by-law", "cart-by-law"] {
            let text = templates::get(name).unwrap();
            let scene = read(text).unwrap().value;
            let clock = clock(&scene);
            for t in [0.3, 1.7] {
                let later =
                    templates::instantiate(name, &[("t", &format!("{} s", scene.instant() + t))])
                        .unwrap();
                let (there, meant) = (clock.scene_at(&scene, t), read(&later).unwrap().value);
                for (a, b) in there.drivers.iter().zip(&meant.drivers) {
                    assert!(
                        (a.kind.position().unwrap().value() - b.kind.position().unwrap().value())
                            .abs()
                            < 1e-13,
                        "{name}"
                    );
                    assert!(
                        (a.rate.value - b.rate.value).abs() < 1e-13,
                        "{name}: {} against {}",
                        a.rate.value,
                        b.rate.value
                    );
                    let of = |d: &hodograph_scene::Driver| {
                        d.acceleration.as_ref().map_or(0.0, |a| a.value)
                    };
                    assert!((of(a) - of(b)).abs() < 1e-13, "{name}: {} against {}", of(a), of(b));
                }
            }
        }
    }

    /// Returns the travel of a driver from the instant to a time, to and fro, from many samples.
    fn travel(clock: &Clock, driver: usize, to: f64) -> f64 {
        let at = |k: usize| clock.gone(to * k as f64 / 20_000.0).unwrap()[driver].by;
        (0..20_000).map(|k| (at(k + 1) - at(k)).abs()).sum()
    }

    /// The motion by laws is shown for three turns of travel on either side, however late the
    /// instant is and however slow the driver is at the instant.
    #[test]
    fn motions_through_time_show_at_most_three_turns_on_either_side() {
        for (name, values) in
            [("plate-by-law", [("t", "10 s")]), ("robot-arm", [("w_3", "0.2 rad/s")])]
        {
            let text = templates::instantiate(name, &values).unwrap();
            let scene = read(&text).unwrap().value;
            let clock = clock(&scene);
            let extent = 1.0;
            let [before, after] = clock.reach(extent);
            let usual = clock.usual_reach(extent);
            assert!(before <= usual[0] && after < usual[1], "{name}: {before} {after} {usual:?}");
            let most = |to: f64| {
                clock.turning().into_iter().map(|d| travel(&clock, d, to)).fold(0.0, f64::max)
            };
            assert!((most(after) / TAU - TURNS_SEEN).abs() < 0.02, "{name}: {}", most(after) / TAU);
            assert!(most(-before) / TAU < TURNS_SEEN + 0.02, "{name}: {}", most(-before) / TAU);
            assert!(clock.steps([before, after]) <= 217, "{name}");
        }
        // Nearly at rest at the instant, the driver speeds up.
        let text = r#"{"links":{"1":["O"],"2":["O","A"]},"ground":"1","points":{"O":[0,0]},
            "lengths":{"OA":"1 m"},"find":["v_A"],"driver":{"link":"2","angle":"20 deg",
            "omega":"0.0001 rad/s","alpha":"3 rad/s^2"}}"#;
        let scene = read(text).unwrap().value;
        let clock_at_rest = clock(&scene);
        let [before, after] = clock_at_rest.reach(1.0);
        assert!(before == 0.0 && (travel(&clock_at_rest, 0, after) / TAU - 3.0).abs() < 1e-6);
        let scene = read(templates::get("plate-by-law").unwrap()).unwrap().value;
        let clock = clock(&scene);
        assert_eq!(clock.reach(1.0), clock.usual_reach(1.0), "less than three turns");
    }

    /// Without laws each driver keeps its acceleration.
    #[test]
    fn drivers_without_laws_keep_their_accelerations() {
        let scene = read(templates::get("five-bar").unwrap()).unwrap().value;
        let clock = clock(&scene);
        let gone = clock.gone(0.01).unwrap();
        assert!(gone.len() > 1);
        for (g, d) in gone.iter().zip(&scene.drivers) {
            let acceleration = d.acceleration.as_ref().map_or(0.0, |a| a.value);
            assert_eq!(g.by, d.rate.value * 0.01 + 0.5 * acceleration * 1e-4);
            assert_eq!(g.rate, d.rate.value + acceleration * 0.01);
        }
    }
}
