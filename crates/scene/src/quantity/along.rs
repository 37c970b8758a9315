//! Direction in the fixed plane of a straight guide, from the places of a pose.

use super::FormulaInputs;
use crate::Angle;
use crate::model::{GivenQuantity, Guide, GuideDirection, GuidePath};
use hodograph_base::geom::Vec2;
use hodograph_base::number::Real;

/// Returns the direction of a guide; `None` for an arc, and if only the pose of the guide's link
/// gives it.
pub(super) fn along<N: Real, K: FormulaInputs<N>>(known: &K, guide: &Guide) -> Option<Vec2<N>> {
    let GuidePath::Line { direction, .. } = &guide.path else { return None };
    match direction {
        GuideDirection::Instant(angle) if guide.on == known.scene().ground => turned(angle),
        GuideDirection::Along(a, b, turn) => {
            let way = (known.point(*b)? - known.point(*a)?).unit()?;
            match turn {
                Some(turn) => Some(way.rotate_by(turned(turn)?)),
                None => Some(way),
            }
        }
        GuideDirection::Instant(_) | GuideDirection::Own | GuideDirection::Slid(_) => {
            known.direction(guide.slider?)?.unit()
        }
    }
}

/// Returns the unit vector at an angle.
fn turned<N: Real>(angle: &GivenQuantity<Angle>) -> Option<Vec2<N>> {
    let number = |x: f64| {
        if angle.radius == 0.0 {
            Some(N::from_f64(x))
        } else {
            N::from_bounded(x, angle.radius + x.abs() * f64::EPSILON)
        }
    };
    let (s, c) = match angle.value {
        Angle::Deg(d) => N::sin_cos_degrees(number(d)?),
        Angle::Rad(r) => N::sin_cos(number(r)?),
    };
    Some(Vec2 { x: c, y: s })
}
