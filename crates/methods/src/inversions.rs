//! Inversions (机构的倒置): each link of a chain as ground in turn, each as a separate scene.
//!
//! The relative motion of the links is the same in all inversions. This module writes an inversion
//! from the places of the pose, so that all links are placed as in the scene; it chooses the driver
//! (the first link on the new ground that turns fully, otherwise the first that moves it); and it
//! finds the limits of the motion ([`extreme::limits`]). Gears and wheels keep their pitch circles.
//! Chains with several drivers or with cylinders keep them, because a driver is a relative motion
//! of two links. A cam with a profile of one circle is kept; other cams are refused, because their
//! contact follows from the driver's angle.
//!
//! ```
//! use hodograph_methods::inversions;
//! use hodograph_scene as scene;
//! let scene = scene::read(scene::templates::get("crank-rocker").unwrap()).unwrap().value;
//! let all = inversions::inversions(&scene).unwrap().value;
//! assert_eq!(all.len(), 4);
//! ```

pub use chain::{ChainLink, is_bore, part};
use hodograph_base::diag::{Both, Diagnostic, Faults, Warned, both};
use hodograph_mechanism::mechanism::Mechanism;
use hodograph_mechanism::position::{Configuration, Path};
use hodograph_scene::{self as scene, GuidePath, LinkId, PointId, Scene};
use hodograph_sweep::extreme::{self, MotionLimits};
use hodograph_worked::worked::{Scope, Worked, work};
use serde_json::{Map, Value as Json, json};

mod belts;
mod cams;
mod chain;
pub mod evolution;
mod pairs;

/// The largest permitted number of links: each link makes a figure.
pub const MOST_LINKS: usize = 24;

/// The mechanism with one link as ground.
#[derive(Clone, Debug)]
pub struct Inversion {
    /// The link of the scene that is the ground of the inversion.
    pub ground: LinkId,
    /// True if it is the ground of the scene itself.
    pub original: bool,
    /// The role of the ground in a chain of four links with slides, if the scene is one.
    pub part: Option<ChainLink>,
    /// The inversion's scene as a file.
    pub text: String,
    /// The scene, read from that file.
    pub scene: Scene,
    /// The solution of that scene.
    pub worked: Worked,
    /// The driving link, slide or cylinder; for several drivers all their names.
    pub driver: String,
    /// The limits of its motion.
    pub limits: MotionLimits,
}

/// Returns all inversions of a scene, in the order of its links.
///
/// # Errors
/// `inversion-pairs` for each cam with a profile other than one circle, `inversion-drivers` if
/// nothing drives, `too-many-links`, and the faults of the scene itself. An inversion that cannot
/// be driven gives a warning.
pub fn inversions(scene: &Scene) -> Result<Warned<Vec<Inversion>>, Faults> {
    refused(scene)?;
    let Warned { value: worked, .. } = work(scene, Scope::Figure)?;
    let (mut out, mut notes) = (Vec::new(), Vec::new());
    for ground in scene.links_in_order() {
        match invert(scene, &worked.configuration, ground) {
            Ok(inversion) => out.push(inversion),
            Err(faults) => {
                let name = scene.link_name(ground);
                let why = faults.list.first().map_or_else(Both::default, |d| d.message.clone());
                let message = both!("with link {name} as ground nothing moves: {}", why);
                notes.push(Diagnostic::warning("inversion", message));
            }
        }
    }
    Ok(Warned { value: out, notes })
}

/// Returns all reasons against an inversion at once.
fn refused(scene: &Scene) -> Result<(), Faults> {
    let mut faults = Faults::default();
    cams::refused(scene, &mut faults);
    if scene.drivers.is_empty() {
        let message = both!("nothing drives the chain, which is inverted as it moves");
        faults.push(
            Diagnostic::error("inversion-drivers", message).help(both!("give the scene a driver")),
        );
    }
    if scene.links.len() > MOST_LINKS {
        let message = both!("{} links; at most {MOST_LINKS} are taken", scene.links.len());
        faults.push(
            Diagnostic::error("too-many-links", message)
                .help(both!("take a part of the mechanism")),
        );
    }
    if faults.list.is_empty() { Ok(()) } else { Err(faults) }
}

/// Returns the chain with another ground, with the driver that moves it best.
fn invert(scene: &Scene, at: &Configuration, ground: LinkId) -> Result<Inversion, Faults> {
    let none = || {
        let name = scene.link_name(ground);
        Diagnostic::error("inversion", both!("no link is pinned to link {name} or slides on it"))
    };
    let (mut first, mut why) = (None, None);
    let candidates = match &scene.drivers[..] {
        [one] if one.kind.ends().is_none() => drivers(scene, ground),
        _ => vec![pairs::kept(scene, ground)],
    };
    for (name, driver) in candidates {
        let text = written(scene, at, ground, driver);
        match read(scene, ground, text, name) {
            // The first driver that turns fully; otherwise the first that moves at all.
            Ok(made) if made.limits.range.full() && turns(&made.scene) => return Ok(made),
            Ok(made) => first = first.or(Some(made)),
            Err(faults) => why = why.or(Some(faults)),
        }
    }
    first.ok_or_else(|| why.unwrap_or_else(|| none().into()))
}

fn turns(scene: &Scene) -> bool {
    scene.drivers.iter().all(|d| d.kind.turns())
}

fn read(scene: &Scene, ground: LinkId, text: String, driver: String) -> Result<Inversion, Faults> {
    let inverted = scene::read(&text)?.value;
    let Warned { value: worked, .. } = work(&inverted, Scope::Figure)?;
    let mechanism = Mechanism::new(&inverted)?.value;
    let limits = extreme::limits(&inverted, &mechanism, 0)?;
    let part = part(scene, ground);
    Ok(Inversion {
        ground,
        original: ground == scene.ground,
        part,
        text,
        scene: inverted,
        worked,
        driver,
        limits,
    })
}

/// Returns the points of a link, and the pins of the guides in which it slides: these belong to it
/// when it is the ground.
fn points(scene: &Scene, link: LinkId) -> Vec<PointId> {
    crate::curvature::points(scene, link)
}

/// Returns the guides of the file; guides of rolling pairs and of cams belong to the pairs.
fn own_guides(scene: &Scene) -> impl Iterator<Item = &scene::Guide> {
    scene.guides.iter().filter(|g| is_own(scene, g))
}

fn is_own(scene: &Scene, guide: &scene::Guide) -> bool {
    guide.rolling.is_none() && !cams::is_contact(scene, guide)
}

/// Returns the possible drivers: links pinned to the ground, in the order of the scene with its own
/// driver first, then slides.
fn drivers(scene: &Scene, ground: LinkId) -> Vec<(String, Json)> {
    let own = &scene.drivers[0];
    let rate = if own.kind.turns() && own.rate.value != 0.0 { own.rate.value } else { 1.0 };
    let own_driver = own.kind.turned().map(|(link, _)| link);
    let own = points(scene, ground);
    let guided = |l: LinkId| own_guides(scene).any(|g| g.on == l || g.slider == Some(l));
    let rolls = |l: LinkId| scene.rolling.iter().any(|r| r.links.contains(&l));
    let has_angle = |l: LinkId| scene.links[l.0].points.len() > 1 || guided(l) || rolls(l);
    let mut links: Vec<LinkId> = (0..scene.links.len())
        .map(LinkId)
        .filter(|l| {
            *l != ground && points(scene, *l).iter().any(|p| own.contains(p)) && has_angle(*l)
        })
        .collect();
    links.sort_by_key(|l| Some(*l) != own_driver);
    let turn = |l: &LinkId| {
        (
            scene.link_name(*l).to_owned(),
            json!({"link": scene.link_name(*l), "omega": format!("{rate:?} rad/s")}),
        )
    };
    let slide = |g: &scene::Guide| {
        let runner = match g.slider {
            Some(s) if s == ground => scene.link_name(g.on).to_owned(),
            Some(s) if g.on == ground => scene.link_name(s).to_owned(),
            None if g.on == ground => scene.point_name(g.pin?).to_owned(),
            Some(_) | None => return None,
        };
        Some((runner.clone(), json!({"slide": runner, "velocity": "1 m/s"})))
    };
    links.iter().map(turn).chain(own_guides(scene).filter_map(slide)).collect()
}

/// Returns the file of an inversion: all places are those of the pose.
fn written(scene: &Scene, at: &Configuration, ground: LinkId, driver: Json) -> String {
    let name = |p: &PointId| scene.point_name(*p).to_owned();
    let place = |p: PointId| {
        at.points[p.0].map(|at| {
            (
                scene.point_name(p).to_owned(),
                json!([format!("{:?} m", at.x), format!("{:?} m", at.y)]),
            )
        })
    };
    let mut links = Map::new();
    for l in (0..scene.links.len()).map(LinkId) {
        let own = if l == ground { points(scene, l) } else { scene.links[l.0].points.clone() };
        if !own.is_empty() {
            links.insert(scene.link_name(l).to_owned(), own.iter().map(name).collect());
        }
    }
    if let Some(pin) = pairs::pin_of_part(scene, ground) {
        links.insert(scene.link_name(ground).to_owned(), json!([pin]));
    }
    let contact =
        |p: &PointId| scene.rolling.iter().any(|r| r.at.contains(p)) || cams::is_touch(scene, *p);
    let points: Map<String, Json> =
        (0..scene.points.len()).map(PointId).filter(|p| !contact(p)).filter_map(place).collect();
    let own = scene.guides.iter().zip(&at.guides).filter(|(g, _)| is_own(scene, g));
    let guides: Vec<Json> = own
        .filter_map(|(g, path)| guide(scene, g, (*path)?, (ground, &driver)))
        .chain(pairs::cylinder(scene, at, ground))
        .collect();
    let title = |text: &str, fixed: String| {
        if text.is_empty() { fixed } else { format!("{text} – {fixed}") }
    };
    let fixed = scene.link_name(ground);
    let which = both!("link {fixed} fixed");
    let mut out = json!({
        "title": {"en": title(&scene.title.en, which.en), "zh": title(&scene.title.zh, which.zh)},
        "links": links,
        "ground": fixed,
        "points": points,
    });
    if !guides.is_empty() {
        out["guides"] = Json::Array(guides);
    }
    let cams = cams::section(scene, at);
    if !cams.is_empty() {
        out["cams"] = Json::Array(cams);
    }
    for (key, pairs) in
        ["gears", "rolling", "belts", "chains", "ropes"].into_iter().zip(pairs::rolling(scene, at))
    {
        if !pairs.is_empty() {
            out[key] = Json::Array(pairs);
        }
    }
    out["driver"] = driver;
    lines(&out)
}

/// Returns a scene as text, with one line for each key.
fn lines(scene: &Json) -> String {
    let line = |(key, value): (&String, &Json)| format!("  {}: {value}", json!(key));
    let all: Vec<String> = scene.as_object().into_iter().flatten().map(line).collect();
    format!("{{\n{}\n}}\n", all.join(",\n"))
}

/// Returns a guide as it is written with another ground. If the block is the ground, it carries the
/// guide: the original carrier slides, with a pin of its own if it drives, so that its position
/// follows from the places.
fn guide(
    scene: &Scene,
    g: &scene::Guide,
    path: Path,
    (ground, driver): (LinkId, &Json),
) -> Option<Json> {
    let link = |l: LinkId| scene.link_name(l).to_owned();
    let drives = |l: LinkId| driver["slide"].as_str() == Some(scene.link_name(l));
    Some(match (path, &g.path) {
        (Path::Line { direction, .. }, _) => {
            let angle = format!("{:?} rad", direction.angle());
            match (g.slider, g.pin) {
                (Some(s), _) if s == ground => {
                    match scene.links[g.on.0].points.first().filter(|_| drives(g.on)) {
                        Some(pin) => {
                            json!({"pin": scene.point_name(*pin), "slider": link(g.on), "on": link(s), "angle": angle})
                        }
                        None => json!({"slider": link(g.on), "on": link(s), "angle": angle}),
                    }
                }
                (Some(s), Some(p)) => {
                    json!({"pin": scene.point_name(p), "slider": link(s), "on": link(g.on), "angle": angle})
                }
                (Some(s), None) => json!({"slider": link(s), "on": link(g.on), "angle": angle}),
                (None, Some(p)) => {
                    json!({"pin": scene.point_name(p), "on": link(g.on), "angle": angle})
                }
                (None, None) => return None,
            }
        }
        (Path::Arc { radius, .. }, GuidePath::Arc { centre, .. }) => {
            let mut out = json!({"pin": scene.point_name(g.pin?), "on": link(g.on), "centre": scene.point_name(*centre), "radius": format!("{radius:?} m")});
            if let Some(s) = g.slider {
                out["slider"] = json!(link(s));
            }
            out
        }
        (Path::Arc { .. }, GuidePath::Line { .. }) => return None,
    })
}
