//! The variable of a motion: the position of one driver, or time.

use super::front::TIME;
use super::{Kind, Scene};

/// The variable that changes from pose to pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Swept {
    /// One driver (its index, from 0); the others keep their places and rates.
    Driver(usize),
    /// Time: every driver moves by its law of time, or else with its constant acceleration at the
    /// instant.
    Time,
}

impl From<usize> for Swept {
    fn from(driver: usize) -> Swept {
        Swept::Driver(driver)
    }
}

impl Swept {
    /// Returns time if a driver moves by a law of time, else the first driver.
    pub fn usual(scene: &Scene) -> Swept {
        if scene.has_laws_of_time() { Swept::Time } else { Swept::Driver(0) }
    }

    /// Returns the variable with a name: a driver's position (`phi_1`, `s_B`, `l_BC`), `driver`,
    /// `driver2`; or `t`, unless the scene has a parameter of that name that is not the instant of
    /// its laws.
    pub fn named(scene: &Scene, name: &str) -> Option<Swept> {
        let driver = |d: usize| {
            name == scene.driver_name(d).0
                || name == format!("driver{}", d + 1)
                || d == 0 && name == "driver"
        };
        let is_time = || {
            name == TIME
                && (scene.has_laws_of_time() || scene.parameters.iter().all(|(own, _)| own != TIME))
        };
        (0..scene.drivers.len())
            .find(|d| driver(*d))
            .map(Swept::Driver)
            .or_else(|| is_time().then_some(Swept::Time))
    }

    /// Returns the name of the variable, and its kind: an angle, a length, a time.
    pub fn name(self, scene: &Scene) -> (String, Kind) {
        match self {
            Swept::Driver(d) => scene.driver_name(d),
            Swept::Time => (TIME.to_owned(), Kind::Time),
        }
    }

    /// Returns true for a driver that turns.
    pub fn turns(self, scene: &Scene) -> bool {
        matches!(self, Swept::Driver(d) if scene.drivers[d].kind.turns())
    }

    /// Returns the leading driver: of several that move, the first that moves independently.
    pub fn lead(self, scene: &Scene) -> usize {
        match self {
            Swept::Driver(d) => d,
            Swept::Time => {
                let moves = |d: &usize| {
                    !scene.is_led(*d)
                        && (scene.drivers[*d].law.is_some() || scene.drivers[*d].rate.value != 0.0)
                };
                (0..scene.drivers.len()).find(moves).unwrap_or(0)
            }
        }
    }
}

impl Scene {
    /// Returns true if a driver moves by a law of time.
    pub fn has_laws_of_time(&self) -> bool {
        self.drivers.iter().any(|d| d.law.is_some())
    }

    /// Returns the instant (s) of its laws of time; 0 if it has none.
    pub fn instant(&self) -> f64 {
        let t = self.parameters.iter().find(|(name, _)| name == TIME && self.has_laws_of_time());
        t.map_or(0.0, |(_, t)| t.value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{read, templates};

    #[test]
    fn t_is_the_time_unless_it_is_something_else() {
        let law = read(templates::get("plate-by-law").unwrap()).unwrap().value;
        assert_eq!(
            (Swept::usual(&law), Swept::named(&law, "t"), law.instant()),
            (Swept::Time, Some(Swept::Time), 1.0)
        );
        assert_eq!(Swept::named(&law, "phi_2"), Some(Swept::Driver(0)));
        let text = templates::get("five-bar").unwrap();
        let plain = read(text).unwrap().value;
        assert_eq!(
            (Swept::usual(&plain), Swept::named(&plain, "t"), plain.instant()),
            (Swept::Driver(0), Some(Swept::Time), 0.0)
        );
        assert_eq!(
            (Swept::named(&plain, "driver2"), Swept::named(&plain, "l_AB")),
            (Some(Swept::Driver(1)), None)
        );
        // For example a thickness.
        let own = read(text.replacen(r#""l_AB": "120 mm""#, r#""t": "120 mm", "l_AB": "t""#, 1))
            .unwrap()
            .value;
        assert_eq!((Swept::named(&own, "t"), own.instant()), (None, 0.0));
    }
}
