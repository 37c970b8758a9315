//! The evolution of the four-bar: a pivot at infinity, an enlarged pin, exchanged elements of a slide.
//!
//! The rocker CD and a slider in an arc about D move C on one circle: replacing one by the other
//! changes no motion. With D at infinity the arc is a straight guide, and the four-bar an offset
//! slider-crank. A pin B that is enlarged until it surrounds A is an eccentric disc. A rod in a
//! block moves like a block on a rod. Each stage is written as a scene in the pose of the given one
//! and is solved.

use super::chain::{ChainLink, is_bore, part};
use hodograph_base::diag::{Diagnostic, Faults, both};
use hodograph_base::geom::{Point, Vec2};
use hodograph_mechanism::position::Path;
use hodograph_scene::{self as scene, GuideId, LinkId, PointId, Scene};
use hodograph_worked::worked::{Scope, Worked, work};
use serde_json::{Map, Value as Json, json};

/// A stage of the evolution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EvolutionStep {
    /// The four-bar.
    FourBar,
    /// A slider in an arc about the pivot of the rocker.
    ArcSlider,
    /// The pivot at infinity: a slider on a straight guide.
    Straight,
    /// The pin between crank and coupler as an eccentric disc.
    Disc,
    /// A block on a guide.
    Lever,
    /// The elements of the slide exchanged: a rod in a block.
    Exchanged,
}

/// A stage with its mechanism in the pose.
#[derive(Clone, Debug)]
pub struct EvolutionStage {
    /// The change to the stage before it.
    pub step: EvolutionStep,
    /// The mechanism.
    pub scene: Scene,
    /// Its solution.
    pub worked: Worked,
    /// The link between the crank and the wanted motion: coupler, lever or block.
    pub follower: LinkId,
    /// The crank.
    pub crank: DrivingCrank,
    /// The length of the rocker (m), for [`EvolutionStep::FourBar`] and
    /// [`EvolutionStep::ArcSlider`].
    pub rocker: Option<f64>,
}

impl EvolutionStage {
    /// Returns the length of the crank (m).
    pub fn arm(&self) -> f64 {
        let at = &self.worked.configuration.points;
        match [self.crank.pivot, self.crank.pin].map(|p| at[p.0]) {
            [Some(pivot), Some(pin)] => pivot.distance(pin),
            _ => 0.0,
        }
    }

    /// Returns true if a slider moves on a guide of the ground.
    pub fn slides_on_ground(&self) -> bool {
        self.scene.guides.iter().any(|g| g.on == self.scene.ground)
    }
}

/// The rocker of the four-bar from which a slider-crank comes, in lengths of its coupler.
const ROCKER: f64 = 1.2;
/// Length of a lever beyond its block, as a part of the distance of block and pivot.
const LEVER: f64 = 0.4;
/// A distance below this part of the mechanism is zero.
const SMALL: f64 = 1e-9;

/// The crank of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DrivingCrank {
    /// The link.
    pub link: LinkId,
    /// The point at which it is pinned to the ground.
    pub pivot: PointId,
    /// The pin at which it moves the next link.
    pub pin: PointId,
}

/// Returns the stages of a scene that is a four-bar, a slider-crank, or one of its inversions with a
/// lever or a swinging block.
///
/// # Errors
/// `evolution` for other mechanisms; the faults of a stage.
pub fn evolution(scene: &Scene, worked: &Worked) -> Result<Vec<EvolutionStage>, Faults> {
    let stages = Stages { scene, at: &worked.configuration.points, worked };
    stages.all().unwrap_or_else(|| Err(other().into()))
}

fn other() -> Diagnostic {
    Diagnostic::error(
        "evolution",
        both!(
            "the mechanism is neither a four-bar nor a chain with one slide that a crank drives"
        ),
    )
    .help(both!(
        "the evolution is drawn for four-bars, slider-cranks, levers with a block and swinging blocks whose crank is on the ground"
    ))
}

/// Links, places and guides of a stage as in a file.
type StageParts = (Map<String, Json>, Vec<(String, Point)>, Vec<Json>);

/// A scene that is taken apart.
struct Stages<'a> {
    scene: &'a Scene,
    at: &'a [Option<Point>],
    worked: &'a Worked,
}

impl Stages<'_> {
    fn all(&self) -> Option<Result<Vec<EvolutionStage>, Faults>> {
        let scene = self.scene;
        let crank = self.crank()?;
        match (part(scene, scene.ground), &scene.guides[..]) {
            (None, []) if scene.links.len() == 4 && scene.rolling.is_empty() => {
                let (coupler, joint) = self.coupler(&crank)?;
                let rocker = scene.carriers(joint).find(|l| *l != coupler)?;
                let pivot = self.shared(rocker, scene.ground)?;
                let direction = (self.place(joint)? - self.place(pivot)?).unit()?.perp();
                let centre = (scene.point_name(pivot).to_owned(), self.place(pivot)?);
                let follower = scene.link_name(rocker).to_owned();
                Some(self.of_four_bar(&crank, (coupler, joint), follower, centre, direction, false))
            }
            (Some(ChainLink::Guide), [guide]) if guide.on == scene.ground => {
                let (coupler, joint) = self.coupler(&crank)?;
                let Path::Line { direction, .. } = self.worked.configuration.guides[0]? else {
                    return None;
                };
                let [b, c] = [self.place(crank.pin)?, self.place(joint)?];
                // The pivot is on the other side of the guide than the crank, or below it.
                let normal = direction.perp();
                let side = normal.dot(self.place(crank.pivot)? - c);
                let level = side.abs() <= SMALL * (c - b).norm();
                let away = if level { -normal.y } else { -side };
                let normal = if away < 0.0 { -normal } else { normal };
                let centre = (self.free_point(), c + normal * (ROCKER * (c - b).norm()));
                let slider = guide.slider.map_or_else(|| self.free_link(), |s| self.link(s));
                Some(self.of_four_bar(&crank, (coupler, joint), slider, centre, direction, true))
            }
            (Some(ChainLink::Crank | ChainLink::Coupler), [guide]) if guide.on != scene.ground => {
                self.of_lever(&crank, GuideId(0))
            }
            _ => None,
        }
    }

    fn place(&self, p: PointId) -> Option<Point> {
        self.at[p.0]
    }

    fn link(&self, l: LinkId) -> String {
        self.scene.link_name(l).to_owned()
    }

    fn shared(&self, a: LinkId, b: LinkId) -> Option<PointId> {
        let links = &self.scene.links;
        links[a.0].points.iter().copied().find(|p| links[b.0].points.contains(p))
    }

    /// Returns the crank: the only driver, pinned to the ground and to another link or a block.
    fn crank(&self) -> Option<DrivingCrank> {
        let scene = self.scene;
        let [driver] = &scene.drivers[..] else { return None };
        let (link, against) = driver.kind.turned()?;
        let pivot = self.shared(link, scene.ground).filter(|_| against == scene.ground)?;
        let joined = |p: &PointId| {
            scene.carriers(*p).any(|l| l != link)
                || scene.guides.iter().any(|g| g.pin == Some(*p) && g.on != link)
        };
        let pin = scene.links[link.0].points.iter().copied().find(|p| *p != pivot && joined(p))?;
        Some(DrivingCrank { link, pivot, pin })
    }

    /// Returns the link at the crank's pin, and its joint with the next one.
    fn coupler(&self, crank: &DrivingCrank) -> Option<(LinkId, PointId)> {
        let scene = self.scene;
        let coupler = scene.carriers(crank.pin).find(|l| *l != crank.link)?;
        let joined = |p: &PointId| {
            *p != crank.pin
                && (scene.carriers(*p).any(|l| l != coupler)
                    || scene.guides.iter().any(|g| g.pin == Some(*p)))
        };
        Some((coupler, scene.links[coupler.0].points.iter().copied().find(joined)?))
    }

    /// Returns a letter that names no point of the scene.
    fn free_point(&self) -> String {
        let free = |n: &&str| self.scene.points.iter().all(|p| p.name != **n);
        let names = ["D", "E", "F", "G", "H", "K", "L", "M", "N", "P", "Q", "R"];
        names.iter().copied().find(|n| free(n)).unwrap_or("Z").to_owned()
    }

    /// Returns a number that names no link of the scene.
    fn free_link(&self) -> String {
        let free = |n: &String| self.scene.links.iter().all(|l| l.name != *n);
        (1..=9).map(|n: u8| n.to_string()).find(free).unwrap_or_else(|| "0".to_owned())
    }

    /// Returns the stages of a four-bar, or of the slider-crank that it becomes (`slides`).
    fn of_four_bar(
        &self,
        crank: &DrivingCrank,
        (coupler, joint): (LinkId, PointId),
        rocker: String,
        (centre, at): (String, Point),
        direction: Vec2,
        slides: bool,
    ) -> Result<Vec<EvolutionStage>, Faults> {
        let scene = self.scene;
        let [a, b, c] = [crank.pivot, crank.pin, joint].map(|p| scene.point_name(p).to_owned());
        let place = |p: PointId| self.place(p).unwrap_or(Point::ORIGIN);
        let (ground, couples) = (self.link(scene.ground), self.link(coupler));
        let length = (place(joint) - at).norm();
        let degrees = format!("{} deg", direction.angle().to_degrees());
        let base = || {
            let mut links = Map::new();
            links.insert(self.link(crank.link), json!([a, b]));
            links.insert(couples.clone(), json!([b, c]));
            let points = vec![
                (a.clone(), place(crank.pivot)),
                (b.clone(), place(crank.pin)),
                (c.clone(), place(joint)),
            ];
            (links, points)
        };
        let stage = |step| -> Result<EvolutionStage, Faults> {
            let (mut links, mut points) = base();
            let mut guides = Vec::new();
            let about = (centre.clone(), at);
            match step {
                EvolutionStep::FourBar => {
                    links.insert(rocker.clone(), json!([centre, c]));
                    links.insert(ground.clone(), json!([a, centre]));
                    points.push(about);
                }
                EvolutionStep::ArcSlider => {
                    links.insert(ground.clone(), json!([a, centre]));
                    points.push(about);
                    guides.push(json!({
                        "pin": c, "slider": rocker, "on": ground, "centre": centre, "radius": length,
                    }));
                }
                EvolutionStep::Straight
                | EvolutionStep::Disc
                | EvolutionStep::Lever
                | EvolutionStep::Exchanged => {
                    links.insert(ground.clone(), json!([a]));
                    guides
                        .push(json!({"pin": c, "slider": rocker, "on": ground, "angle": degrees}));
                }
            }
            let rocker =
                matches!(step, EvolutionStep::FourBar | EvolutionStep::ArcSlider).then_some(length);
            self.stage(step, crank, (links, points, guides), &couples, rocker)
        };
        let mut out = Vec::new();
        for step in [EvolutionStep::FourBar, EvolutionStep::ArcSlider, EvolutionStep::Straight] {
            out.push(stage(step)?);
        }
        let enlarged = out[if slides { 2 } else { 0 }].clone();
        out.push(EvolutionStage { step: EvolutionStep::Disc, ..enlarged });
        // Block and rod of the exchanged slide move as slider and guide do.
        let exchanged = out[2].clone();
        out.push(EvolutionStage { step: EvolutionStep::Exchanged, ..exchanged });
        Ok(out)
    }

    /// Returns the two stages of a lever with a block or of a rod in a swinging block.
    fn of_lever(
        &self,
        crank: &DrivingCrank,
        g: GuideId,
    ) -> Option<Result<Vec<EvolutionStage>, Faults>> {
        let scene = self.scene;
        let guide = &scene.guides[g.0];
        let pivot = self.shared(guide.on, scene.ground)?;
        let (pin, at) = (guide.pin?, self.place(pivot)?);
        if pin != crank.pin || guide.on == crank.link {
            return None;
        }
        let Path::Line { direction, .. } = self.worked.configuration.guides[g.0]? else {
            return None;
        };
        let arm = self.place(pin)? - at;
        // Only a guide through the pivot has a block about it.
        if direction.cross(arm).abs() > SMALL * arm.norm() {
            return None;
        }
        let [a, b, c] = [crank.pivot, crank.pin, pivot].map(|p| scene.point_name(p).to_owned());
        let (end, tip) = (self.free_point(), at + arm * (1.0 + LEVER));
        let slider = guide.slider.map_or_else(|| self.free_link(), |s| self.link(s));
        let (ground, lever) = (self.link(scene.ground), self.link(guide.on));
        let stage = |step, block: bool| {
            let mut links = Map::new();
            links.insert(self.link(crank.link), json!([a, b]));
            links.insert(lever.clone(), if block { json!([c]) } else { json!([c, end]) });
            links.insert(ground.clone(), json!([a, c]));
            let mut points = vec![
                (a.clone(), self.place(crank.pivot)?),
                (b.clone(), self.place(crank.pin)?),
                (c.clone(), at),
            ];
            if !block {
                points.push((end.clone(), tip));
            }
            let mut guide = json!({"pin": b, "slider": slider, "on": lever});
            if block {
                guide["through"] = json!(c);
            } else {
                guide["line"] = json!(format!("{c},{end}"));
            }
            let guides = vec![guide];
            Some(self.stage(step, crank, (links, points, guides), &lever, None))
        };
        let bore = is_bore(scene);
        let first = stage(EvolutionStep::Lever, bore)?;
        let second = stage(EvolutionStep::Exchanged, !bore)?;
        Some(first.and_then(|first| Ok(vec![first, second?])))
    }

    /// Writes a stage as a scene and solves it.
    fn stage(
        &self,
        step: EvolutionStep,
        crank: &DrivingCrank,
        (links, points, guides): StageParts,
        follower: &str,
        rocker: Option<f64>,
    ) -> Result<EvolutionStage, Faults> {
        let driver = &self.scene.drivers[0];
        let mut drives = json!({"link": self.link(crank.link), "omega": driver.rate.value});
        if let Some(alpha) = &driver.acceleration {
            drives["alpha"] = json!(alpha.value);
        }
        let places: Map<String, Json> =
            points.into_iter().map(|(name, p)| (name, json!([p.x, p.y]))).collect();
        let text = json!({
            "units": {"length": "m", "omega": "rad/s", "alpha": "rad/s^2"},
            "links": links,
            "ground": self.scene.link_name(self.scene.ground),
            "points": places,
            "guides": guides,
            "driver": drives,
            "find": [format!("omega_{follower}"), format!("alpha_{follower}")],
        });
        let mut scene = scene::read(text.to_string())?.value;
        scene.book = self.scene.book.clone();
        let worked = work(&scene, Scope::Figure)?.value;
        let named = |name: &str| scene.points.iter().position(|p| p.name == name).map(PointId);
        let of_link = |name: &str| scene.links.iter().position(|l| l.name == name).map(LinkId);
        let [pivot, pin] = [crank.pivot, crank.pin].map(|p| named(self.scene.point_name(p)));
        let crank = (|| {
            let link = of_link(&self.link(crank.link))?;
            Some(DrivingCrank { link, pivot: pivot?, pin: pin? })
        })();
        let (follower, crank) = of_link(follower).zip(crank).ok_or_else(other)?;
        Ok(EvolutionStage { step, follower, crank, rocker, scene, worked })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hodograph_mechanism::answer::MotionSource;
    use hodograph_mechanism::mechanism::Level;
    use hodograph_scene::templates;

    fn stages(name: &str) -> Vec<(EvolutionStep, f64, f64)> {
        let given = scene::read(templates::get(name).unwrap()).unwrap().value;
        let worked = work(&given, Scope::Figure).unwrap().value;
        let all = evolution(&given, &worked).unwrap();
        let rates = |s: &EvolutionStage| {
            let of = |level| s.worked.solution.turning(level, s.follower).unwrap();
            (s.step, of(Level::Velocity), of(Level::Acceleration))
        };
        all.iter().map(rates).collect()
    }

    /// A slider in an arc moves as the rocker, a disc as the crank, a rod in a block as a block on a
    /// rod; a straight guide has the tangent of the arc, so that only α differs.
    #[test]
    fn stages_keep_their_motion() {
        let close = |a: f64, b: f64| (a - b).abs() <= 1e-9 * a.abs().max(1.0);
        for (name, disc) in [("crank-rocker", 0), ("drag-link", 0), ("offset-slider-crank", 2)] {
            let all = stages(name);
            assert_eq!(all.len(), 5, "{name}");
            assert!(all.iter().all(|s| close(s.1, all[0].1)), "{name}: {all:?}");
            assert!(close(all[0].2, all[1].2) && close(all[3].2, all[disc].2), "{name}: {all:?}");
            assert!(close(all[4].2, all[2].2) && !close(all[2].2, all[0].2), "{name}: {all:?}");
        }
        for name in ["slotted-lever", "oscillating-cylinder"] {
            let [one, other] = stages(name)[..] else { panic!("{name}") };
            assert!(close(one.1, other.1) && close(one.2, other.2), "{name}");
        }
    }

    #[test]
    fn other_mechanisms_are_refused() {
        let given = scene::read(templates::get("shaper").unwrap()).unwrap().value;
        let worked = work(&given, Scope::Figure).unwrap().value;
        let faults = evolution(&given, &worked).unwrap_err();
        assert_eq!(faults.list[0].code, "evolution");
    }
}
