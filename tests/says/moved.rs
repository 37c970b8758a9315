//! A scene that is written for another position of its driver, and solved alone.

use hodograph::analytic;
use hodograph::diag::Faults;
use hodograph::mechanism::Mechanism;
use hodograph::position::{Configuration, Path};
use hodograph::scene::{self, Find, GuideDirection, GuideId, PointPlace, Scene, Through};
use hodograph::sweep::{PlacedScene, station};
use serde_json::{Value as Json, json};
use std::collections::BTreeMap;

/// The answers of the loop equations to a scene as it is, including infinite ones; `None` where an
/// answer is not defined.
pub struct Single {
    pub answers: BTreeMap<String, Option<Vec<f64>>>,
    pub condition: f64,
    /// The position of the driver.
    pub value: f64,
}

pub fn solved(scene: &Scene, driver: Option<usize>) -> Result<Single, Faults> {
    let m = Mechanism::new(scene)?.value;
    let placed = PlacedScene::new(scene, &m)?;
    let solution = analytic::solve(scene, &m, &placed.at, &placed.demand)?;
    let answer = |f: &Find| {
        if f.what.infinite(scene).is_some() {
            return Some(vec![f64::INFINITY]);
        }
        let columns = solution.answer(scene, &placed.at, &f.what)?.columns();
        columns.iter().all(|v| v.is_finite()).then_some(columns)
    };
    let answers = scene.find.iter().map(|f| (f.text.clone(), answer(f))).collect();
    let condition = if solution.singular.is_empty() { solution.condition } else { f64::INFINITY };
    Ok(Single {
        answers,
        condition,
        value: driver.map_or(0.0, |d| station::position_now(scene, &placed.at, d)),
    })
}

/// The links that carry a track or a rack, each with the key of its list and of its name there.
const CARRYING: [(&str, &str); 2] = [("rolling", "on"), ("gears", "rack")];

/// The racks of a file with a named contact, each with the centre of its wheel and the contact.
pub fn touching(json: &Json) -> Vec<[String; 3]> {
    let named = |pair: &Json| {
        let all = [&pair["rack"], &pair["centres"][0], &pair["at"]]
            .map(|v| v.as_str().map(str::to_owned));
        let [Some(rack), Some(centre), Some(at)] = all else { return None };
        Some([rack, centre, at])
    };
    json["gears"].as_array().into_iter().flatten().filter_map(named).collect()
}

/// A scene of the file that is to be written for another position.
pub struct Moved<'a> {
    pub json: &'a Json,
    pub plain: &'a Scene,
    pub driver: usize,
    /// All places.
    pub at: &'a Configuration,
    /// The position of the driver.
    pub now: f64,
}

impl Moved<'_> {
    /// True if the scene states the driver's position.
    pub fn told(&self) -> bool {
        self.plain.drivers[self.driver].kind.position().is_some()
    }

    /// True if coordinates give a moving point.
    fn posed(&self, p: usize) -> bool {
        let fixed = self.plain.links[self.plain.ground.0].points.iter().any(|q| q.0 == p);
        let written = self.json["points"].get(&self.plain.points[p].name).is_some();
        written && !fixed && matches!(self.plain.points[p].place, PointPlace::At(_))
    }

    /// True if the sides of a joint refer to lines of its own link.
    fn is_made_so(&self, joint: &str) -> bool {
        let mut own = self.plain.sides.iter().filter(|s| self.plain.point_name(s.point) == joint);
        own.all(|s| {
            self.plain
                .links
                .iter()
                .any(|l| [s.point, s.from, s.to].iter().all(|p| l.points.contains(p)))
        })
    }

    /// The driver that turns the link of a guide, if the coordinates of the guide's pin show its
    /// direction and no angle of that driver is given.
    fn shown_beside(&self, g: GuideId) -> Option<usize> {
        let (guide, ground) = (&self.plain.guides[g.0], self.plain.ground);
        let silent = |d: &scene::Driver| {
            d.kind.turned() == Some((guide.on, ground)) && d.kind.angle().is_none()
        };
        self.plain
            .drivers
            .iter()
            .position(silent)
            .filter(|_| guide.pin.is_some_and(|p| self.posed(p.0)))
    }

    /// The scene with its driver at `value`, the points at their places and the links turned by
    /// these angles; `None` if its format cannot express it.
    pub fn at(
        &self,
        value: f64,
        places: &BTreeMap<String, [f64; 2]>,
        turned: &BTreeMap<String, f64>,
    ) -> Option<Json> {
        let (plain, mut json) = (self.plain, self.json.clone());
        let posed: Vec<usize> = (0..plain.points.len()).filter(|p| self.posed(*p)).collect();
        let own_guides = json["guides"].as_array().map_or(0, Vec::len);
        if !self.told() && posed.is_empty() {
            return None;
        }
        if self.told() {
            let kind = &plain.drivers[self.driver].kind;
            let (key, unit) = match (kind.turns(), kind.guide().is_some()) {
                (true, _) => ("angle", "rad"),
                (false, true) => ("position", "m"),
                (false, false) => ("length", "m"),
            };
            let own = match &mut json["driver"] {
                Json::Array(list) => list.get_mut(self.driver)?,
                one => one,
            };
            own[key] = json!(format!("{value:?} {unit}"));
        }
        let written = |[x, y]: [f64; 2]| json!([format!("{x:?} m"), format!("{y:?} m")]);
        for p in posed {
            let name = &plain.points[p].name;
            json["points"][name] = written(*places.get(name)?);
        }
        // A side gives the assembly of the instant; a motion may carry the joint to the other side,
        // so that its place is given instead. Sides of three points of one link describe its shape.
        if let Some(mut sides) =
            json.as_object_mut()?.remove("side").and_then(|sides| sides.as_object().cloned())
        {
            sides.retain(|joint, _| self.is_made_so(joint));
            let joints =
                self.json["side"].as_object()?.keys().filter(|joint| !sides.contains_key(*joint));
            for joint in joints {
                json["sketch"][joint] = written(*places.get(joint)?);
            }
            json["side"] = Json::Object(sides);
        }
        if let Some(sketch) = json.get_mut("sketch").and_then(Json::as_object_mut) {
            sketch
                .iter_mut()
                .filter_map(|(p, at)| Some((at, places.get(p)?)))
                .for_each(|(at, place)| *at = written(*place));
        }
        for (g, guide) in
            plain.guides.iter().enumerate().take(own_guides).filter(|(_, g)| g.on != plain.ground)
        {
            let scene::GuidePath::Line { through, direction, .. } = &guide.path else { continue };
            if matches!(through, Through::At(_)) {
                return None;
            }
            let turn = || turned.get(plain.link_name(guide.on));
            let angle = match direction {
                GuideDirection::Instant(angle) => angle.value.radians() + turn()?,
                // A slot shown by its pin is given by its angle: the pin may have moved to the
                // other side of the pivot.
                GuideDirection::Own => match (self.shown_beside(GuideId(g)), self.at.guides[g]) {
                    (Some(d), Some(Path::Line { direction, .. })) => {
                        direction.angle() + if d == self.driver { value - self.now } else { 0.0 }
                    }
                    (None, _) | (_, Some(Path::Arc { .. }) | None) => continue,
                },
                GuideDirection::Along(..) | GuideDirection::Slid(_) => continue,
            };
            json["guides"].get_mut(g)?["angle"] = json!(format!("{angle:?} rad"));
        }
        // So is the position of a track or a rack on its link.
        for (key, on) in CARRYING {
            for pair in json.get_mut(key).and_then(Json::as_array_mut).into_iter().flatten() {
                let (Some(link), Some(angle), None) =
                    (pair[on].as_str(), pair["angle"].as_str(), pair.get("line"))
                else {
                    continue;
                };
                if link != plain.link_name(plain.ground) {
                    pair["angle"] = json!(format!("({angle}) + ({:?} rad)", turned.get(link)?));
                }
            }
        }
        // The load of a rope, or a sliding rack, is placed by the coordinates of its pin alone.
        let of = |key: &str, on: &str| {
            let pairs = self.json[key].as_array().into_iter().flatten();
            pairs.filter_map(|pair| pair[on].as_str().map(str::to_owned)).collect::<Vec<_>>()
        };
        for load in of("ropes", "load").into_iter().chain(of("gears", "rack")) {
            let driven = plain.drivers[self.driver].kind.guide();
            for (g, guide) in plain
                .guides
                .iter()
                .enumerate()
                .filter(|(_, g)| g.slider.is_some_and(|l| plain.link_name(l) == load))
            {
                if driven == Some(GuideId(g)) {
                    continue;
                }
                let name = plain.point_name(guide.pin?);
                json["points"][name] = written(*places.get(name)?);
            }
        }
        // The angle of a cam behind wheels is given for the pose.
        for (i, cam) in plain.cams.iter().enumerate() {
            if let (Some(angle), Some(t)) =
                (json["cams"][i]["angle"].as_str().map(str::to_owned), &cam.disc)
            {
                json["cams"][i]["angle"] =
                    json!(format!("({angle}) + ({:?} rad)", t.way * (value - self.now)));
            }
        }
        Some(json)
    }
}
