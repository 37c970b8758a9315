//! Entries of a scene with several members: drivers, guides, gears, wheels. Each member has a
//! method with the name that it has in the file.

use super::amount::{Acceleration, Angle, AngularAcceleration, AngularVelocity, Length, Velocity};
use serde_json::{Map, Value, json};

/// An entry under construction.
#[derive(Clone, Debug, Default)]
pub(super) struct MemberEntry(pub(super) Map<String, Value>);

impl MemberEntry {
    pub(super) fn with(mut self, key: &str, value: Value) -> MemberEntry {
        self.0.insert(key.into(), value);
        self
    }
}

/// Methods that set one member each.
macro_rules! members {
    ($name:ident: $($(#[$doc:meta])* $method:ident($($argument:ident: $kind:ty),+) $key:literal = $value:expr;)+) => {
        impl $name {
            $(
                $(#[$doc])*
                pub fn $method(self, $($argument: $kind),+) -> $name {
                    $name(self.0.with($key, $value))
                }
            )+

            pub(super) fn json(self) -> Value {
                Value::Object(self.0.0)
            }
        }
    };
}

pub(super) use members;

/// A driver of the mechanism.
#[derive(Clone, Debug)]
#[must_use]
pub struct Driver(MemberEntry);

impl Driver {
    /// Returns a driver that turns a link; set `angle` (unless coordinates give the pose) and
    /// `omega`.
    pub fn turning(link: &str) -> Driver {
        Driver(MemberEntry::default().with("link", json!(link)))
    }

    /// Returns a driver that moves a pin or slider along its guide; set `position` (unless
    /// coordinates give the pose) and `velocity`.
    pub fn sliding(point_or_slider: &str) -> Driver {
        Driver(MemberEntry::default().with("slide", json!(point_or_slider)))
    }

    /// Returns a cylinder between two points, such as `FG`; set `length` (unless coordinates give
    /// the pose) and `rate`.
    pub fn cylinder(ends: &str) -> Driver {
        Driver(MemberEntry::default().with("cylinder", json!(ends)))
    }
}

members! { Driver:
    /// The link from which angle and rates are measured, instead of the ground.
    against(link: &str) "against" = json!(link);
    /// The line of the driven link whose angle is given, instead of that of its first two points.
    line(points: &str) "line" = json!(points);
    /// The line of `against` from which the angle is measured.
    against_line(points: &str) "against_line" = json!(points);
    /// The angle.
    angle(value: Angle) "angle" = value.json();
    /// The angular velocity.
    omega(value: AngularVelocity) "omega" = value.json();
    /// The angular acceleration; without it the rate is constant.
    alpha(value: AngularAcceleration) "alpha" = value.json();
    /// Position of a sliding driver along its guide.
    position(value: Length) "position" = value.json();
    /// The velocity along the guide.
    velocity(value: Velocity) "velocity" = value.json();
    /// The acceleration along the guide, or of a cylinder's length.
    acceleration(value: Acceleration) "acceleration" = value.json();
    /// The length of a cylinder.
    length(value: Length) "length" = value.json();
    /// The rate of a cylinder's length.
    rate(value: Velocity) "rate" = value.json();
    /// The numbers of barrel and rod.
    links(barrel: &str, rod: &str) "links" = json!([barrel, rod]);
}

/// A sliding pair.
#[derive(Clone, Debug)]
#[must_use]
pub struct Guide(MemberEntry);

impl Guide {
    /// Returns a bare pin that runs in a slot, on ground unless `on` is set.
    pub fn pin(point: &str) -> Guide {
        Guide(MemberEntry::default().with("pin", json!(point)))
    }

    /// Returns a slider with its pin.
    pub fn slider(link: &str, pin: &str) -> Guide {
        Guide(MemberEntry::default().with("pin", json!(pin)).with("slider", json!(link)))
    }

    /// Returns a link that slides without turning and has no pin in the guide, such as a yoke.
    pub fn yoke(link: &str) -> Guide {
        Guide(MemberEntry::default().with("slider", json!(link)))
    }
}

members! { Guide:
    /// The link that carries the guide.
    on(link: &str) "on" = json!(link);
    /// The line of two points of that link along which the guide is directed.
    line(points: &str) "line" = json!(points);
    /// A point of that link on the guide.
    through(point: &str) "through" = json!(point);
    /// A place in the fixed plane on a guide on ground.
    through_at(x: Length, y: Length) "through" = json!([x.json(), y.json()]);
    /// The direction, measured from the x axis at the instant, or from `line`.
    angle(value: Angle) "angle" = value.json();
    /// Distance of the guide to the left, looking along its direction.
    offset(value: Length) "offset" = value.json();
    /// The centre of a slot along an arc.
    centre(point: &str) "centre" = json!(point);
    /// The radius of a slot along an arc.
    radius(value: Length) "radius" = value.json();
    /// Bearing length of a slider in its guide.
    length(value: Length) "length" = value.json();
}

/// A pair of gears, or a gear on its rack.
#[derive(Clone, Debug)]
#[must_use]
pub struct Gears(MemberEntry);

impl Gears {
    /// Returns two gears with their centres.
    pub fn pair(links: [&str; 2], centres: [&str; 2]) -> Gears {
        Gears(MemberEntry::default().with("links", json!(links)).with("centres", json!(centres)))
    }

    /// Returns a gear with its centre, and the link that is its rack; set `angle` or `line`.
    pub fn on_rack(gear: &str, centre: &str, rack: &str) -> Gears {
        Gears(
            MemberEntry::default()
                .with("links", json!([gear, rack]))
                .with("centres", json!([centre]))
                .with("rack", json!(rack)),
        )
    }
}

members! { Gears:
    /// The radii of the pitch circles, in the order of the centres.
    radii(values: &[Length]) "radii" = values.iter().map(Length::json).collect();
    /// The numbers of teeth, in the order of the centres.
    teeth(values: &[u32]) "teeth" = json!(values);
    /// The module.
    module(value: Length) "module" = value.json();
    /// The link whose gear is internal.
    ring(link: &str) "ring" = json!(link);
    /// The line of two points of the rack along which the rack is directed.
    line(points: &str) "line" = json!(points);
    /// The direction of the rack, measured from the x axis at the instant, or from `line`.
    angle(value: Angle) "angle" = value.json();
    /// The name of the point of contact.
    at(point: &str) "at" = json!(point);
    /// The angle of the second link's line from the line of centres, when the first link's line
    /// coincides with it.
    phase(value: Angle) "phase" = value.json();
}

/// A wheel that rolls without slip.
#[derive(Clone, Debug)]
#[must_use]
pub struct Wheel(MemberEntry);

impl Wheel {
    /// Returns a wheel with its centre and radius.
    pub fn new(link: &str, centre: &str, radius: Length) -> Wheel {
        Wheel(
            MemberEntry::default()
                .with("wheel", json!(link))
                .with("centre", json!(centre))
                .with("radius", radius.json()),
        )
    }
}

members! { Wheel:
    /// The link on which it rolls, instead of the ground.
    on(link: &str) "on" = json!(link);
    /// The centre of a circular track.
    track(centre: &str) "track" = json!(centre);
    /// The radius of a circular track.
    track_radius(value: Length) "track_radius" = value.json();
    /// True if it rolls inside that circle.
    inside(value: bool) "inside" = json!(value);
    /// The line of two points along which a straight track is directed; the wheel is to its left.
    line(points: &str) "line" = json!(points);
    /// A place in the fixed plane on a straight track on ground.
    through_at(x: Length, y: Length) "through" = json!([x.json(), y.json()]);
    /// The direction of a straight track.
    angle(value: Angle) "angle" = value.json();
    /// The name of the point of contact.
    at(point: &str) "at" = json!(point);
    /// The angle of the wheel's line, as [`Gears::phase`].
    phase(value: Angle) "phase" = value.json();
}
