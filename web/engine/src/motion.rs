//! The motion of a file: its poses with the place by which the driver is dragged, and the edit
//! that puts a place of the driver into the text.

use crate::file::OpenFile;
use crate::plane;
use crate::words::{failed, place};
use hodograph::diag::Span;
use hodograph::position::Configuration;
use hodograph::problem::{self, Options};
use hodograph::scene::{DriverKind, PointId, Position, Scene, Swept, driver_position, edit};
use hodograph::sweep::follow::PoseFollower;
use hodograph::sweep::station::now;
use serde_json::{Value as Json, json};

/// Least number of poses of a turn that the page gets.
const POSES: usize = 72;

/// The dragged point of a driver.
fn grip(scene: &Scene, driver: usize, at: &Configuration) -> Option<PointId> {
    match &scene.drivers.get(driver)?.kind {
        DriverKind::Turn { link, against, .. } => {
            let points = &scene.links[link.0].points;
            let shared = |p: &&PointId| scene.links[against.0].points.contains(p);
            let centre = at.points[points.iter().find(shared)?.0]?;
            let far = |p: &PointId| at.points[p.0].map_or(0.0, |q| q.distance(centre));
            points.iter().copied().max_by(|a, b| far(a).total_cmp(&far(b)))
        }
        DriverKind::Slide { guide, .. } => {
            let guide = &scene.guides[guide.0];
            guide.pin.or_else(|| scene.links[guide.slider?.0].points.first().copied())
        }
        DriverKind::Cylinder { b, .. } => Some(*b),
    }
}

impl OpenFile {
    /// Answers `motion`: for each pose its travel, the place of the grip (mm on the paper of the
    /// mechanism, y up) and the places of all `points` (m), and whether the motion closes.
    pub fn motion(&self) -> Json {
        let still = || json!({"ok": true, "poses": []});
        let Some(swept) = self.swept else { return still() };
        // Pairs that replace cams at the instant do not take part in the motion.
        let options = Options { whole_motion: true, ..Options::with_figures() };
        let solved = match problem::solve(&self.problem, &options) {
            Ok(solved) => solved,
            Err(faults) => return failed(&faults, &self.text),
        };
        let Some((scene, worked)) = solved.mechanism() else { return still() };
        let (of, at) = (&worked.mechanism, &worked.configuration);
        let follower = PoseFollower::new(scene, of, &worked.demand, at, swept);
        let sweep = follower.sweep(POSES);
        let driver = match swept {
            Swept::Driver(d) => d,
            Swept::Time => 0,
        };
        let grip = grip(scene, driver, at);
        let diagram = &worked.construction.diagram;
        let paper = |p: hodograph::geom::Point| {
            let v = (p - diagram.origin) * (1.0 / diagram.mu);
            [v.x, v.y]
        };
        let poses: Vec<Json> = sweep
            .poses
            .iter()
            .map(|pose| {
                let place = grip.and_then(|p| pose.configuration.points[p.0]).map(paper);
                let places = plane::places(&pose.configuration);
                json!({"travel": pose.travel, "grip": place, "places": places})
            })
            .collect();
        json!({
            "ok": true,
            "poses": poses,
            "full": sweep.full,
            "period": if sweep.full { json!(sweep.period()) } else { Json::Null },
            "back": follower.goes_back(),
            "grip": grip.map(|p| scene.point_name(p)),
            "points": scene.points.iter().map(|p| &p.name).collect::<Vec<_>>(),
            "start": now(scene, at, swept),
            "time": swept == Swept::Time,
        })
    }

    /// Answers `place`: the text with the driver at a travel, to three decimals of degrees or
    /// millimetres, as an edit; nothing if the text gives its place in another way.
    pub fn place(&self, travel: f64) -> Json {
        let Some(new) = self.text_at(travel, rounded) else { return json!({"ok": true}) };
        let same = self.text.bytes().zip(new.bytes()).take_while(|(a, b)| a == b).count();
        let tail = |text: &str| text.len() - same;
        let back = self.text.bytes().rev().zip(new.bytes().rev()).take_while(|(a, b)| a == b);
        let back = back.count().min(tail(&self.text)).min(tail(&new));
        let mut edit = place(Span::new(same, self.text.len() - back), &self.text);
        // The quantities are ASCII, and so are the letters where the texts differ.
        edit["insert"] = json!(new.get(same..new.len() - back));
        json!({"ok": true, "edit": edit})
    }

    /// Returns the text with the driver at a travel; `None` if the text gives its place neither as
    /// a quantity nor as a parameter.
    pub fn text_at(&self, travel: f64, written: fn(f64) -> f64) -> Option<String> {
        let (scene, Swept::Driver(driver)) = (self.scene()?, self.swept?) else { return None };
        let (span, text, turns) = match scene.drivers.get(driver)?.kind.position()? {
            Position::Angle(angle) => (angle.span, &angle.text, true),
            Position::Length(x) => (x.span, &x.text, false),
        };
        let value = driver_position(scene, driver)? + travel;
        let (number, unit) = if turns { (value.to_degrees(), "deg") } else { (value * 1e3, "mm") };
        let quantity = format!("{} {unit}", written(number));
        // A parameter is changed where it has its value.
        if scene.parameters.iter().any(|(name, _)| name == text) {
            return edit::with_parameters(&self.text, &[(text, &quantity)]).ok();
        }
        let quoted = self.text.get(span.start..span.end)?.starts_with('"');
        let mut new = self.text.clone();
        new.replace_range(span.start..span.end, &format!("\"{quantity}\""));
        quoted.then_some(new)
    }
}

/// A number to three decimals, without a negative zero.
fn rounded(number: f64) -> f64 {
    (number * 1e3).round() / 1e3 + 0.0
}

/// A number as it is.
pub fn exact(number: f64) -> f64 {
    number
}
