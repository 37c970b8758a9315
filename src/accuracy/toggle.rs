//! Where a driver can go no farther: the toggle, found by halving.

use crate::mechanism::{Demand, Mechanism};
use crate::position;
use crate::scene::{Scene, driver_position, with_driver_at};

/// Steps of the search: a degree, or as fine a part of the mechanism's size.
const STEPS: usize = 360;

/// The last position of a driver at which the mechanism closes, going on from where it stands (`up`: with increasing
/// position) for a full turn, or for twice the mechanism's size; `None` where nothing stops it, or where it has no position.
///
/// The mechanism does not close beyond: there two of its links lie in line.
pub fn limit(scene: &Scene, driver: usize, up: bool) -> Option<f64> {
    let start = driver_position(scene, driver)?;
    let m = Mechanism::new(scene).ok()?.value;
    let demand = Demand::of(scene, &m).with_all_positions();
    let extent = |at: f64| Some(position::configure(&with_driver_at(scene, driver, at), &m, &demand).ok()?.value.extent());
    let reach = if scene.drivers[driver].kind.turns() { std::f64::consts::TAU } else { 2.0 * extent(start)? };
    let step = if up { reach } else { -reach } / STEPS as f64;
    let mut inside = start;
    extent(inside)?;
    let mut outside = (1..=STEPS).map(|i| start + step * i as f64).find(|&at| {
        let closes = extent(at).is_some();
        if closes {
            inside = at;
        }
        !closes
    })?;
    loop {
        let middle = 0.5 * (inside + outside);
        // No double lies between.
        if middle == inside || middle == outside {
            return Some(inside);
        }
        if extent(middle).is_some() { inside = middle } else { outside = middle }
    }
}
