//! The four-bar A B C D as a design: its lengths, its position, and its scene.
//!
//! Letters: AB is the crank, BC the coupler, DC the follower, AD the frame; E is a point of the
//! coupler.

use super::candidate::{deg, mm, place};
use hodograph_base::diag::{Both, both};
use hodograph_base::geom::{Point, Vec2};
use hodograph_mechanism::position::kernel::crossing;
use serde_json::{Map, Value as Json, json};

/// A four-bar in one position, defined by its points.
#[derive(Clone, Debug, PartialEq)]
pub struct FourBar {
    /// Crank pivot.
    pub a: Point,
    /// Pin of crank and coupler.
    pub b: Point,
    /// Pin of coupler and follower.
    pub c: Point,
    /// Pivot of the follower.
    pub d: Point,
    /// A point of the coupler in its frame (m): along BC from B, and to the left of BC.
    pub e: Option<Vec2>,
}

/// The head and the driver of a scene.
#[derive(Clone, Debug, Default)]
pub struct Heading {
    /// Title.
    pub title: Both,
    /// Language, if the task names one.
    pub language: Option<&'static str>,
    /// The driver's angular velocity (rad/s).
    pub omega: f64,
    /// The units of answers: quantity and unit.
    pub answers: Vec<(String, String)>,
}

impl FourBar {
    /// Lengths AB, BC, CD, AD (m).
    pub fn lengths(&self) -> [f64; 4] {
        [
            self.a.distance(self.b),
            self.b.distance(self.c),
            self.c.distance(self.d),
            self.a.distance(self.d),
        ]
    }

    /// The sum of the least and greatest length minus that of the other two: negative where the
    /// shortest link turns fully (Grashof).
    pub fn grashof(&self) -> f64 {
        let mut l = self.lengths();
        l.sort_by(f64::total_cmp);
        l[0] + l[3] - l[1] - l[2]
    }

    /// The size of the drawing (m).
    pub fn size(&self) -> f64 {
        self.lengths().into_iter().fold(0.0, f64::max)
    }

    /// The coupler point in a position given by B and C.
    pub fn coupler_point(&self, b: Point, c: Point) -> Option<Point> {
        let (e, axis) = (self.e?, (c - b).unit()?);
        Some(b + e.rotate_by(axis))
    }

    /// B and C for another crank angle, C on its present side of BD; `None` where the dyad does not
    /// close.
    pub fn at(&self, crank: f64) -> Option<(Point, Point)> {
        let [a, bc, cd, _] = self.lengths();
        let b = self.a + Vec2::from_angle(crank) * a;
        let left = (self.d - self.b).cross(self.c - self.b) > 0.0;
        Some((b, meet(b, bc, self.d, cd, left)?))
    }

    /// The scene: pivots by their places, lengths, the crank angle, the side of C.
    pub fn scene(&self, heading: &Heading) -> Json {
        let [ab, bc, cd, _] = self.lengths();
        let mut points = Map::new();
        points.insert("A".into(), place(self.a));
        points.insert("D".into(), place(self.d));
        let mut coupler = json!(["B", "C"]);
        if let (Some(e), Json::Array(names)) = (self.e, &mut coupler) {
            names.push(json!("E"));
            points.insert("E".into(), json!({"base": "BC", "x": mm(e.x), "y": mm(e.y)}));
        }
        let left = (self.d - self.b).cross(self.c - self.b) > 0.0;
        let mut scene = headed(heading);
        scene.insert(
            "links".into(),
            json!({"1": ["A", "B"], "2": coupler, "3": ["D", "C"], "4": ["A", "D"]}),
        );
        scene.insert("ground".into(), json!("4"));
        scene.insert("points".into(), Json::Object(points));
        scene.insert("lengths".into(), json!({"AB": mm(ab), "BC": mm(bc), "CD": mm(cd)}));
        scene.insert("driver".into(), json!({"link": "1", "angle": deg((self.b - self.a).angle()), "omega": omega(heading.omega)}));
        scene.insert("side".into(), json!({"C": if left { "left of BD" } else { "right of BD" }}));
        let find = if self.e.is_some() {
            json!(["v_E", "a_E", "omega_3", "alpha_3"])
        } else {
            json!(["omega_2", "omega_3", "alpha_3"])
        };
        scene.insert("find".into(), find);
        Json::Object(scene)
    }
}

/// The beginning of a scene.
pub fn headed(heading: &Heading) -> Map<String, Json> {
    let mut scene = Map::new();
    scene.insert("title".into(), json!({"en": heading.title.en, "zh": heading.title.zh}));
    if let Some(language) = heading.language {
        scene.insert("language".into(), json!(language));
    }
    if !heading.answers.is_empty() {
        let units: Map<String, Json> =
            heading.answers.iter().map(|(key, unit)| (key.clone(), json!(unit))).collect();
        scene.insert("answers".into(), Json::Object(units));
    }
    scene
}

/// An angular velocity for a scene's text.
pub fn omega(rate: f64) -> Json {
    Json::String(format!("{rate} rad/s"))
}

/// The intersection of two circles on the left or right of the line from the first centre to the
/// second.
pub fn meet(p: Point, r: f64, q: Point, s: f64, left: bool) -> Option<Point> {
    let [on_left, on_right] = crossing(p, r, q, s)?;
    Some(if left { on_left } else { on_right })
}

/// The intersections of a line and a circle as distances along the unit direction, the smaller
/// first.
pub fn cross_circle(from: Point, direction: Vec2, centre: Point, radius: f64) -> Option<[f64; 2]> {
    let to = centre - from;
    let (foot, off) = (direction.dot(to), direction.cross(to));
    let half2 = (radius - off) * (radius + off);
    (half2 >= 0.0).then(|| [foot - half2.sqrt(), foot + half2.sqrt()])
}

/// The lengths of a four-bar as named numbers, in the order of [`FourBar::lengths`].
pub fn named_lengths(lengths: [f64; 4]) -> Vec<super::candidate::DesignNumber> {
    use super::candidate::DesignNumber;
    let [ab, bc, cd, ad] = lengths;
    vec![
        DesignNumber::length("AB", both!("crank"), ab),
        DesignNumber::length("BC", both!("coupler"), bc),
        DesignNumber::length("CD", both!("follower"), cd),
        DesignNumber::length("AD", both!("frame"), ad),
    ]
}
