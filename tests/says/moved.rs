//! A scene that is written for another position of its driver, and solved by itself.

use hodograph::analytic;
use hodograph::diag::Faults;
use hodograph::mechanism::Mechanism;
use hodograph::scene::{self, Find, Place, Scene, Through};
use hodograph::sweep::{Placed, station};
use serde_json::{Value as Json, json};
use std::collections::BTreeMap;

/// The answers of the loop equations to a scene as it stands, infinite ones too; `None` of what is not defined there.
pub struct Single {
    pub answers: BTreeMap<String, Option<Vec<f64>>>,
    pub condition: f64,
    /// Where the driver stands.
    pub value: f64,
}

pub fn solved(scene: &Scene, driver: Option<usize>) -> Result<Single, Faults> {
    let m = Mechanism::new(scene)?.value;
    let placed = Placed::new(scene, &m)?;
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
    Ok(Single { answers, condition, value: driver.map_or(0.0, |d| station::position_now(scene, &placed.at, d)) })
}

/// A scene of the file's own words that is told to stand elsewhere.
pub struct Moved<'a> {
    pub json: &'a Json,
    pub plain: &'a Scene,
    pub driver: usize,
    /// Where the driver stands.
    pub now: f64,
}

impl Moved<'_> {
    /// Whether the scene says where its driver stands.
    pub fn told(&self) -> bool {
        self.plain.drivers[self.driver].kind.position().is_some()
    }

    /// Whether a point that moves is given by coordinates.
    fn posed(&self, p: usize) -> bool {
        let fixed = self.plain.links[self.plain.ground.0].points.iter().any(|q| q.0 == p);
        let written = self.json["points"].get(&self.plain.points[p].name).is_some();
        written && !fixed && matches!(self.plain.points[p].place, Place::At(_))
    }

    /// The scene with its driver at `value`, the points at their places and the links turned by so much; `None` where its words cannot say it.
    pub fn at(&self, value: f64, places: &BTreeMap<String, [f64; 2]>, turned: &BTreeMap<String, f64>) -> Option<Json> {
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
        // A side tells the assembly of the instant; a motion may carry the joint to the other one, so that its place is told instead.
        let sides = json.as_object_mut()?.remove("side").unwrap_or_default();
        for joint in sides.as_object().into_iter().flat_map(|sides| sides.keys()) {
            json["sketch"][joint] = written(*places.get(joint)?);
        }
        if let Some(sketch) = json.get_mut("sketch").and_then(Json::as_object_mut) {
            sketch.iter_mut().filter_map(|(p, at)| Some((at, places.get(p)?))).for_each(|(at, place)| *at = written(*place));
        }
        for (g, guide) in plain.guides.iter().enumerate().take(own_guides).filter(|(_, g)| g.on != plain.ground) {
            let scene::GuidePath::Line { through, direction, .. } = &guide.path else { continue };
            if matches!(through, Through::At(_)) {
                return None;
            }
            if let scene::Direction::Instant(angle) = direction {
                let by = turned.get(plain.link_name(guide.on))?;
                json["guides"].get_mut(g)?["angle"] = json!(format!("{:?} rad", angle.value.radians() + by));
            }
        }
        // How a cam behind wheels stands is told for the pose.
        for (i, cam) in plain.cams.iter().enumerate() {
            if let (Some(angle), Some(t)) = (json["cams"][i]["angle"].as_str().map(str::to_owned), &cam.disc) {
                json["cams"][i]["angle"] = json!(format!("({angle}) + ({:?} rad)", t.way * (value - self.now)));
            }
        }
        Some(json)
    }
}
