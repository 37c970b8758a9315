//! A scene with its driver elsewhere: the same mechanism at another instant of its motion.

use super::{Angle, Given, Position, PositionSlot, Scene};

/// The position of a driver: radians for a turning one, metres for a slider or a cylinder; `None` where the pose is given by
/// coordinates.
pub fn driver_position(scene: &Scene, driver: usize) -> Option<f64> {
    scene.drivers.get(driver)?.kind.position().map(Position::value)
}

/// The same scene with a driver elsewhere: just the decimal that is printed for `position` (radians or metres).
///
/// A scene whose driver has no position stays as it is.
pub fn with_driver_at(scene: &Scene, driver: usize, position: f64) -> Scene {
    let mut scene = scene.clone();
    // The shortest decimal that reads back as the same double is within half a unit of its last place.
    let radius = position.abs() * f64::EPSILON;
    match scene.drivers[driver].kind.slot() {
        PositionSlot::Angle(Some(angle)) => {
            *angle = Given { value: Angle::Rad(position), radius, text: format!("({position:?}) rad"), span: angle.span };
        }
        PositionSlot::Coordinate(Some(x)) | PositionSlot::Distance(Some(x)) => {
            *x = Given { value: position, radius, text: format!("({position:?}) m"), span: x.span };
        }
        PositionSlot::Angle(None) | PositionSlot::Coordinate(None) | PositionSlot::Distance(None) => {}
    }
    scene.set_followers(driver, None);
    scene
}
