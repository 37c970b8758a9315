//! A scene with its driver at another position: the same mechanism at another instant of its
//! motion.

use super::{
    Angle, GivenQuantity, GuideDirection, GuidePath, LinkId, NamedPoint, PointId, PointPlace,
    Position, PositionSlot, Scene,
};

/// Returns the position of a driver: radians for a turning one, metres for a slider or a cylinder;
/// `None` if coordinates give the pose.
pub fn driver_position(scene: &Scene, driver: usize) -> Option<f64> {
    scene.drivers.get(driver)?.kind.position().map(Position::value)
}

/// Returns the scene with a driver at another position, exactly the decimal that is printed for
/// `position` (radians or metres).
///
/// The cams that the driver turns move with it. In a scene whose pose is given by coordinates, the
/// coordinates remain.
pub fn with_driver_at(scene: &Scene, driver: usize, position: f64) -> Scene {
    let before = driver_position(scene, driver);
    let mut scene = scene.clone();
    // The shortest decimal that reads back as the same double is within half a unit of its last
    // place.
    let radius = position.abs() * f64::EPSILON;
    match scene.drivers[driver].kind.slot() {
        PositionSlot::Angle(Some(angle)) => {
            *angle = GivenQuantity {
                value: Angle::Rad(position),
                radius,
                text: format!("({position:?}) rad"),
                span: angle.span,
            };
        }
        PositionSlot::Coordinate(Some(x)) | PositionSlot::Distance(Some(x)) => {
            *x = GivenQuantity {
                value: position,
                radius,
                text: format!("({position:?}) m"),
                span: x.span,
            };
        }
        PositionSlot::Angle(None)
        | PositionSlot::Coordinate(None)
        | PositionSlot::Distance(None) => {}
    }
    scene.set_followers(driver, Some(position));
    if let (Some((link, _)), Some(before)) = (scene.drivers[driver].kind.turned(), before) {
        turn_guides(&mut scene, link, position - before);
    }
    scene
}

impl Scene {
    /// Returns true if lengths and drivers determine the pose at all driver positions; coordinates
    /// of a moving point determine one pose only.
    pub fn is_told_everywhere(&self) -> bool {
        let fixed = |p: PointId| self.links[self.ground.0].points.contains(&p);
        let posed = |(p, point): (usize, &NamedPoint)| {
            matches!(point.place, PointPlace::At(_)) && !fixed(PointId(p))
        };
        !self.points.iter().enumerate().any(posed)
            && self.drivers.iter().all(|d| d.kind.position().is_some())
    }
}

/// Turns guides with a direction at the instant together with the links that carry them, which turn
/// with a driven link.
fn turn_guides(scene: &mut Scene, driven: LinkId, by: f64) {
    let turning = scene.turning_with(driven);
    for guide in scene.guides.iter_mut().filter(|g| turning[g.on.0]) {
        let GuidePath::Line { direction: GuideDirection::Instant(angle), .. } = &mut guide.path
        else {
            continue;
        };
        let turned = angle.value.radians() + by;
        let radius = angle.radius + (turned.abs() + by.abs()) * f64::EPSILON;
        *angle = GivenQuantity {
            value: Angle::Rad(turned),
            radius,
            text: format!("({turned:?}) rad"),
            span: angle.span,
        };
    }
}
