//! Inversions (机构的倒置): each link of a chain as ground in turn, every one a scene of its own.
//!
//! The relative motion of the links is the same in all of them. Decided here: how an inversion is written, from the places of the pose, so
//! that all stand as in the scene; which link drives (one on the new ground that turns fully, else the first that moves it); what its
//! motion as a whole is ([`extreme::limits`]). Chains of pins and slides with one freedom are inverted.
//!
//! ```
//! use hodograph::{inversions, scene};
//! let scene = scene::read(scene::templates::get("crank-rocker").unwrap()).unwrap().value;
//! let all = inversions::inversions(&scene).unwrap().value;
//! assert_eq!(all.len(), 4);
//! ```

use crate::diag::{Both, Diagnostic, Faults, Warned, both};
use crate::mechanism::Mechanism;
use crate::position::{Configuration, Path};
use crate::scene::{self, GuidePath, LinkId, PointId, Scene};
use crate::sweep::extreme::{self, Limits};
use crate::worked::{Scope, Worked, work};
use serde_json::{Map, Value as Json, json};

/// Scenes with more links are refused: each link makes a figure.
pub const MOST_LINKS: usize = 24;

/// One link as ground.
#[derive(Clone, Debug)]
pub struct Inversion {
    /// The link of the scene that is the ground here.
    pub ground: LinkId,
    /// Whether it is the ground of the scene itself.
    pub original: bool,
    /// Its scene as a file.
    pub text: String,
    /// The same, read.
    pub scene: Scene,
    /// The same, worked through.
    pub worked: Worked,
    /// The link or slide that drives.
    pub driver: String,
    /// Its motion as a whole.
    pub limits: Limits,
}

/// All inversions of a scene, in the order of its links.
///
/// # Errors
/// `inversion-pairs` for each wheel, cam or cylinder of the chain, `inversion-freedoms` for more than one freedom, `too-many-links`, and the
/// faults of the scene itself. An inversion that cannot be driven is a note.
pub fn inversions(scene: &Scene) -> Result<Warned<Vec<Inversion>>, Faults> {
    refused(scene)?;
    let Warned { value: worked, .. } = work(scene, Scope::Figure)?;
    let (mut out, mut notes) = (Vec::new(), Vec::new());
    for ground in (0..scene.links.len()).map(LinkId) {
        match invert(scene, &worked.configuration, ground) {
            Ok(inversion) => out.push(inversion),
            Err(faults) => {
                let name = scene.link_name(ground);
                let why = faults.list.first().map_or_else(Both::default, |d| d.message.clone());
                let message = both!("with link {name} as ground nothing moves: {}", "以构件 {name} 为机架时不能运动：{}", why);
                notes.push(Diagnostic::warning("inversion", message));
            }
        }
    }
    Ok(Warned { value: out, notes })
}

/// What cannot be inverted, and why; all at once.
fn refused(scene: &Scene) -> Result<(), Faults> {
    let mut faults = Faults::default();
    other_pairs(scene, &mut faults);
    if scene.drivers.len() != 1 {
        let message = both!(
            "a chain of one freedom is inverted; this one has {} drivers",
            "只能倒置单自由度运动链；该机构有 {} 个原动件",
            scene.drivers.len()
        );
        faults.push(Diagnostic::error("inversion-freedoms", message).help(both!("give the scene one driver", "请只给一个原动件")));
    }
    if scene.links.len() > MOST_LINKS {
        let message = both!("{} links; at most {MOST_LINKS} are taken", "{} 个构件；最多可有 {MOST_LINKS} 个", scene.links.len());
        faults.push(Diagnostic::error("too-many-links", message).help(both!("take a part of the mechanism", "请只取一部分机构")));
    }
    if faults.list.is_empty() { Ok(()) } else { Err(faults) }
}

/// Every pair that is neither pin nor slide, and why it is not inverted.
fn other_pairs(scene: &Scene, faults: &mut Faults) {
    let name = |l: LinkId| scene.link_name(l);
    for r in &scene.rolling {
        let [a, b] = r.links.map(name);
        let message = both!(
            "links {a} and {b} roll on one another: where a wheel is the ground its contour would have to be written for every pose, and only \
             chains of pins and slides are inverted",
            "构件 {a} 与 {b} 作纯滚动：以轮为机架时其接触轮廓随位置变化，只能倒置由转动副和移动副组成的运动链"
        );
        let help = both!(
            "leave the wheels out: `hodograph solve` with \"spin\" and ratios tells their turning against any link",
            "请去掉轮；各轮相对任一构件的转动可由 `hodograph solve` 求得"
        );
        faults.push(Diagnostic::error("inversion-pairs", message).at(r.span).help(help));
    }
    for c in &scene.cams {
        let (cam, follower) = (name(c.cam), name(c.follower));
        let message = both!(
            "cam {cam} drives follower {follower} by a higher pair, whose profile is given about the cam's pivot on the ground",
            "凸轮 {cam} 与从动件 {follower} 组成高副，其廓线是相对机架上的转轴给出的"
        );
        let help =
            both!("replace it by a lower pair at the instant (the centre of curvature as a pin)", "请先高副低代（以曲率中心为铰链）");
        faults.push(Diagnostic::error("inversion-pairs", message).at(c.span).help(help));
    }
    for d in &scene.drivers {
        if let Some(ends) = d.kind.ends() {
            let [a, b] = ends.map(|p| scene.point_name(p));
            let message = both!(
                "the cylinder from {a} to {b} drives by its length: barrel and rod carry no points and cannot be the ground",
                "油缸 {a}–{b} 以长度驱动：缸筒与活塞杆上没有其他点，不能作机架"
            );
            let help = both!(
                "write it as two links with a slide between them, {{\"on\": \"barrel\", \"slider\": \"rod\"}}, driven by that slide",
                "请写成两个构件及其间的移动副，并由该移动副驱动"
            );
            faults.push(Diagnostic::error("inversion-pairs", message).at(d.span).help(help));
        }
    }
}

/// The chain with another ground, driven by what moves it best.
fn invert(scene: &Scene, at: &Configuration, ground: LinkId) -> Result<Inversion, Faults> {
    let none = || {
        let name = scene.link_name(ground);
        Diagnostic::error("inversion", both!("no link is pinned to link {name} or slides on it", "没有构件与构件 {name} 铰接或沿其滑动"))
    };
    let (mut first, mut why) = (None, None);
    for (name, driver) in drivers(scene, ground) {
        let text = written(scene, at, ground, driver);
        match read(scene, ground, text, name) {
            // The first that turns fully; else the first that moves at all.
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
    Ok(Inversion { ground, original: ground == scene.ground, text, scene: inverted, worked, driver, limits })
}

/// Points of a link, and the pins of the guides in which it slides: the latter belong to it once it is the ground.
fn points(scene: &Scene, link: LinkId) -> Vec<PointId> {
    crate::curvature::points(scene, link)
}

/// What may drive: links pinned to the ground, as the scene lists them (its own driver first), then slides.
fn drivers(scene: &Scene, ground: LinkId) -> Vec<(String, Json)> {
    let own = &scene.drivers[0];
    let rate = if own.kind.turns() && own.rate.value != 0.0 { own.rate.value } else { 1.0 };
    let own_driver = own.kind.turned().map(|(link, _)| link);
    let own = points(scene, ground);
    let guided = |l: LinkId| scene.guides.iter().any(|g| g.on == l || g.slider == Some(l));
    let has_angle = |l: LinkId| scene.links[l.0].points.len() > 1 || guided(l);
    let mut links: Vec<LinkId> = (0..scene.links.len())
        .map(LinkId)
        .filter(|l| *l != ground && points(scene, *l).iter().any(|p| own.contains(p)) && has_angle(*l))
        .collect();
    links.sort_by_key(|l| Some(*l) != own_driver);
    let turn = |l: &LinkId| (scene.link_name(*l).to_owned(), json!({"link": scene.link_name(*l), "omega": format!("{rate:?} rad/s")}));
    let slide = |g: &scene::Guide| {
        let runner = match g.slider {
            Some(s) if s == ground => scene.link_name(g.on).to_owned(),
            Some(s) if g.on == ground => scene.link_name(s).to_owned(),
            None if g.on == ground => scene.point_name(g.pin?).to_owned(),
            Some(_) | None => return None,
        };
        Some((runner.clone(), json!({"slide": runner, "velocity": "1 m/s"})))
    };
    links.iter().map(turn).chain(scene.guides.iter().filter_map(slide)).collect()
}

/// The file of an inversion: all places as they are in the pose.
fn written(scene: &Scene, at: &Configuration, ground: LinkId, driver: Json) -> String {
    let name = |p: &PointId| scene.point_name(*p).to_owned();
    let place =
        |p: PointId| at.points[p.0].map(|at| (scene.point_name(p).to_owned(), json!([format!("{:?} m", at.x), format!("{:?} m", at.y)])));
    let mut links = Map::new();
    for l in (0..scene.links.len()).map(LinkId) {
        let own = if l == ground { points(scene, l) } else { scene.links[l.0].points.clone() };
        if !own.is_empty() {
            links.insert(scene.link_name(l).to_owned(), own.iter().map(name).collect());
        }
    }
    let points: Map<String, Json> = (0..scene.points.len()).map(PointId).filter_map(place).collect();
    let guides: Vec<Json> = scene.guides.iter().zip(&at.guides).filter_map(|(g, path)| guide(scene, g, (*path)?, ground)).collect();
    let title = |text: &str, fixed: String| if text.is_empty() { fixed } else { format!("{text} – {fixed}") };
    let fixed = scene.link_name(ground);
    let mut out = json!({
        "title": {"en": title(&scene.title.en, format!("link {fixed} fixed")), "zh": title(&scene.title.zh, format!("构件 {fixed} 为机架"))},
        "links": links,
        "ground": fixed,
        "points": points,
    });
    if !guides.is_empty() {
        out["guides"] = Json::Array(guides);
    }
    out["driver"] = driver;
    lines(&out)
}

/// A scene as people write it: a line for each key.
fn lines(scene: &Json) -> String {
    let line = |(key, value): (&String, &Json)| format!("  {}: {value}", json!(key));
    let all: Vec<String> = scene.as_object().into_iter().flatten().map(line).collect();
    format!("{{\n{}\n}}\n", all.join(",\n"))
}

/// A guide as it is written with another ground. A block that has become the ground carries it: what was its guide slides.
fn guide(scene: &Scene, g: &scene::Guide, path: Path, ground: LinkId) -> Option<Json> {
    let link = |l: LinkId| scene.link_name(l).to_owned();
    Some(match (path, &g.path) {
        (Path::Line { direction, .. }, _) => {
            let angle = format!("{:?} rad", direction.angle());
            match (g.slider, g.pin) {
                (Some(s), _) if s == ground => json!({"slider": link(g.on), "on": link(s), "angle": angle}),
                (Some(s), Some(p)) => json!({"pin": scene.point_name(p), "slider": link(s), "on": link(g.on), "angle": angle}),
                (Some(s), None) => json!({"slider": link(s), "on": link(g.on), "angle": angle}),
                (None, Some(p)) => json!({"pin": scene.point_name(p), "on": link(g.on), "angle": angle}),
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
