//! The motion of a file: its poses with the place by which the driver is dragged, and the edit
//! that puts a place of the driver into the text.

use crate::file::OpenFile;
use crate::words::place;
use hodograph::diag::Faults;
use hodograph::mechanism::Mechanism;
use hodograph::position::Configuration;
use hodograph::problem::whole_motion;
use hodograph::scene::{DriverKind, PointId, Scene, Swept, edit};
use hodograph::sweep::follow::PoseFollower;
use hodograph::sweep::long::LongSweep;
use hodograph::sweep::station::{DriverSpan, angle_per_value, now};
use hodograph::sweep::timed::TimedSweep;
use hodograph::sweep::{PlacedScene, StationSteps, extreme, mechanism, pieces};
use serde_json::{Value as Json, json};

/// Least number of poses of a turn that the page gets.
const POSES: usize = 72;
/// Steps of a table: one for each degree.
const STEPS: usize = 360;

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
    /// Answers `motion`: for each pose its travel and the place of the grip (mm on the paper of the
    /// mechanism, y up), the paper's extent over all poses, and whether the motion closes.
    pub fn motion(&self) -> Json {
        let (Some(scene), Some(swept)) = (self.scene(), self.swept) else {
            return json!({"ok": true, "poses": []});
        };
        let scene = whole_motion(scene.clone()).value;
        let Some((_, worked)) = self.solved.mechanism() else {
            return json!({"ok": true, "poses": []});
        };
        let follower = PoseFollower::new(
            &scene,
            &worked.mechanism,
            &worked.demand,
            &worked.configuration,
            swept,
        );
        let sweep = follower.sweep(POSES);
        let driver = match swept {
            Swept::Driver(d) => d,
            Swept::Time => 0,
        };
        let grip = grip(&scene, driver, &worked.configuration);
        let diagram = &worked.construction.diagram;
        let paper = |p: hodograph::geom::Point| {
            let v = (p - diagram.origin) * (1.0 / diagram.mu);
            [v.x, v.y]
        };
        let poses: Vec<Json> = sweep
            .poses
            .iter()
            .map(|pose| {
                let at = grip.and_then(|p| pose.configuration.points[p.0]).map(paper);
                json!({"travel": pose.travel, "grip": at})
            })
            .collect();
        json!({
            "ok": true,
            "poses": poses,
            "full": sweep.full,
            "period": if sweep.full { json!(sweep.period()) } else { Json::Null },
            "back": follower.goes_back(),
            "grip": grip.map(|p| scene.point_name(p)),
            "start": now(&scene, &worked.configuration, swept),
            "time": swept == Swept::Time,
        })
    }

    /// Answers `place`: the edit of the text that puts the driver at a travel; `null` if the text
    /// gives its place in another way.
    pub fn place(&self, travel: f64) -> Json {
        let edited = || {
            let (scene, Swept::Driver(driver)) = (self.scene()?, self.swept?) else { return None };
            let (span, written, turns) = match scene.drivers.get(driver)?.kind.position()? {
                hodograph::scene::Position::Angle(angle) => (angle.span, angle.text.clone(), true),
                hodograph::scene::Position::Length(x) => (x.span, x.text.clone(), false),
            };
            let value = hodograph::scene::driver_position(scene, driver)? + travel;
            // A parameter alone is changed where it has its value.
            if scene.parameters.iter().any(|(name, _)| *name == written) {
                let value = quantity(value, turns);
                let new = edit::with_parameters(&self.text, &[(&written, &value)]).ok()?;
                return Some(json!({"ok": true, "text": new}));
            }
            let old = self.text.get(span.start..span.end)?;
            if !old.starts_with('"') {
                return None;
            }
            let mut told = place(span, &self.text);
            told["insert"] = json!(format!("\"{}\"", quantity(value, turns)));
            Some(json!({"ok": true, "edit": told}))
        };
        edited().unwrap_or_else(|| json!({"ok": true}))
    }

    /// Returns the table of the whole motion.
    ///
    /// # Errors
    /// Those of the sweep.
    pub fn table(&self) -> Result<hodograph::sweep::Table, Faults> {
        let (Some(scene), Some(swept)) = (self.scene(), self.swept) else {
            return Err(hodograph::diag::Diagnostic::error(
                "no-driver",
                hodograph::diag::both!("the scene has no driver", "机构文件没有原动件"),
            )
            .into());
        };
        let scene = whole_motion(scene.clone()).value;
        let of: Mechanism = mechanism(&scene)?;
        let placed = PlacedScene::new(&scene, &of)?;
        let Swept::Driver(driver) = swept else {
            let (timed, range) = TimedSweep::new(&placed, [None, None])?;
            return Ok(pieces::gather(&mut timed.steps(range, STEPS)));
        };
        let way = if scene.drivers[driver].kind.turns() {
            let [from, to] = edit::angles("0", "360")?;
            DriverSpan::Turn(from, to)
        } else {
            let limits = extreme::limits(&scene, &of, driver)?;
            let [from, to] = limits.range.bounds();
            let per_value = angle_per_value(&scene, &placed.at, driver);
            DriverSpan::Slide { from, to, per_value }
        };
        Ok(pieces::gather(&mut LongSweep::new(
            &placed,
            driver,
            StationSteps { way, steps: STEPS },
        )?))
    }
}

/// A quantity as a teacher writes it: degrees or millimetres to three decimals.
fn quantity(value: f64, turns: bool) -> String {
    let (number, unit) = if turns { (value.to_degrees(), "deg") } else { (value * 1e3, "mm") };
    let rounded = (number * 1e3).round() / 1e3;
    // No negative zero.
    format!("{} {unit}", rounded + 0.0)
}
