//! The momentary point of contact of a cam and its follower taken for a lasting coincident point: E of the follower sliding along the tangent
//! of the cam, as if it were a pin in a straight slot of the cam.
//!
//! That is a mechanism of its own, and it is planned and drawn as one, in the same pose. Its velocities are right. In the accelerations the part of
//! a_E3E2 along the normal is missing, for the profiles roll and slide past one another and the point of contact changes on both.

use super::{Missing, Shown, Side, Site, Stage, Topology};
use crate::diag::{Both, both};
use crate::digits::significant;
use crate::geom::{Point, Vec2};
use crate::mechanism::{Demand, Level, Mechanism};
use crate::plan::{Body, TermKind};
use crate::position::{Configuration, Path};
use crate::scene::quantity::{Meaning, PointMotion, Rate};
use crate::scene::{Angle, Cam, Direction, Find, Follows, Given, Guide, GuideId, GuidePath, Kind, OnLink, Place, PointId, Scene, Through};
use crate::worked::{Worked, work_placed};

/// Digits of the missing part in the table.
const DIGITS: usize = 4;

/// Each cam that is a circle, with a follower that is a face or a round end: of an edge or a roller another point is named.
pub fn sites(t: &Topology) -> Vec<Site> {
    let offers = |c: &Cam| {
        c.circle.is_some() && c.contact.is_some() && c.cam != t.scene.ground && matches!(c.follows, Follows::Face(_) | Follows::Arc(..))
    };
    t.scene.cams.iter().enumerate().filter(|(_, c)| offers(c)).map(|(k, _)| Site::ContactPoint(k)).collect()
}

/// The name of the point of contact: that of the scene, or E, or the next letter that is free.
pub fn name(scene: &Scene, cam: usize) -> String {
    let own = |i: usize| scene.cams[cam].touch == Some(PointId(i));
    let taken = |n: &str| scene.points.iter().enumerate().any(|(i, p)| p.name == n && !own(i));
    let own = scene.cams[cam].at.clone().filter(|n| !taken(n));
    let free = || ["E", "K", "T", "U", "W"].into_iter().find(|n| !taken(n)).unwrap_or("E_").to_owned();
    own.unwrap_or_else(free)
}

/// The place of contact and the tangent there.
fn touch(scene: &Scene, at: &Configuration, cam: &Cam) -> Option<(GuideId, Point, Vec2)> {
    let ((centre, radius), guide) = (cam.circle?, cam.contact?);
    let b = at.points[centre.0]?;
    let normal = match (&scene.guides[guide.0].path, at.guides[guide.0]?) {
        // The centre runs on a parallel to the face, `offset` to the left of it.
        (GuidePath::Line { offset: Some(offset), .. }, Path::Line { direction, .. }) => direction.perp() * -offset.value.signum(),
        (GuidePath::Arc { .. }, Path::Arc { centre: k, .. }) => (at.points[scene.guides[guide.0].pin?.0]? - k).unit()?,
        (GuidePath::Line { .. } | GuidePath::Arc { .. }, _) => return None,
    };
    Some((guide, b + normal * radius, normal.perp()))
}

/// The scene with the point of contact as a point of the follower, in its pose, asking for the accelerations of both coincident points.
struct Touched {
    scene: Scene,
    at: Configuration,
    own: PointId,
}

fn touched(scene: &Scene, at: &Configuration, index: usize, place: Point) -> Option<Touched> {
    let cam = &scene.cams[index];
    let (mut scene, mut at) = (scene.clone(), at.clone());
    let own = PointId(scene.points.len());
    let pose = at.poses[cam.follower.0]?;
    // It stands for the contact that questions may name.
    if let Some(asked) = cam.touch {
        at.points[asked.0] = None;
    }
    scene.points.push(crate::scene::Point { name: name(&scene, index), place: Place::Unknown, sketch: None, span: cam.span });
    scene.links[cam.follower.0].points.push(own);
    at.points.push(Some(place));
    at.shapes.points[cam.follower.0].push((own, pose.to_local(place)));
    for link in [None, Some(cam.cam)] {
        for rate in [Rate::Velocity, Rate::Acceleration] {
            let what = PointMotion { rate, of: OnLink { point: own, link } }.into();
            scene.find.push(Find { what, text: format!("contact {}", scene.find.len()), span: cam.span });
        }
    }
    scene.cams.clear();
    Some(Touched { scene, at, own })
}

/// Questions that a mechanism without the guide still answers: of whole vectors and turnings.
fn asked_as_well(scene: &Scene, f: &Find) -> bool {
    matches!(f.what.meaning(scene), Some(Meaning::Vector(_) | Meaning::Turning(..)))
}

fn worked(t: Touched) -> Option<(Scene, Worked)> {
    let mechanism = Mechanism::new(&t.scene).ok()?.value;
    let demand = Demand::of(&t.scene, &mechanism).with_all_positions();
    let worked = work_placed(&t.scene, mechanism, demand, t.at).ok()?.value;
    Some((t.scene, worked))
}

/// The right solution with the point of contact in it, the wrong one, and the equation with what it lacks.
pub fn slid(scene: &Scene, at: &Configuration, index: usize) -> Option<(Stage, Stage, Shown)> {
    let cam = &scene.cams[index];
    let (guide, place, tangent) = touch(scene, at, cam)?;
    let mut right = touched(scene, at, index, place)?;
    right.scene.find.retain(|f| asked_as_well(scene, f));
    let mut wrong = Touched { scene: right.scene.clone(), at: right.at.clone(), own: right.own };
    let (own, span) = (right.own, cam.span);
    let angle = Given { value: Angle::Rad(tangent.angle()), radius: f64::EPSILON, text: format!("{} rad", tangent.angle()), span };
    let path = GuidePath::Line { through: Through::Pin, direction: Direction::Instant(angle), offset: None };
    wrong.scene.guides[guide.0] = Guide { pin: Some(own), slider: None, on: cam.cam, path, rolling: None, span };
    let line = Path::Line { through: place, direction: tangent };
    let pose = at.poses[cam.cam.0]?;
    wrong.at.guides[guide.0] = Some(line);
    wrong.at.shapes.guides[guide.0] = Some(Path::Line { through: pose.to_local(place), direction: pose.turn_back(tangent) });
    let (right, wrong) = (worked(right)?, worked(wrong)?);
    let mut shown = Shown::with(&wrong.1.plan, Level::Acceleration, Side::Wrong, |t| t.kind == TermKind::Coriolis)?;
    shown.framed.clear();
    shown.missing = Some(missing(scene, cam, own, &right, tangent.perp())?);
    let stage = |(scene, worked)| Stage { scene, worked };
    Some((stage(right), stage(wrong), shown))
}

/// a_E3 − a_E2 − a_k along the normal.
fn missing(scene: &Scene, cam: &Cam, own: PointId, right: &(Scene, Worked), normal: Vec2) -> Option<Missing> {
    let (s, w) = right;
    let vector = |level, link| {
        let v = w.plan.find_vertex(s, own, link)?;
        w.construction.vector(level, v)
    };
    let relative = |level| Some(vector(level, None)? - vector(level, Some(cam.cam))?);
    let omega = w.construction.rate(Level::Velocity, Body::Link(cam.cam))?;
    let coriolis = relative(Level::Velocity)?.perp() * (2.0 * omega);
    let along = (relative(Level::Acceleration)? - coriolis).dot(normal);
    let book = &scene.book;
    let number = significant(book.value(Kind::Acceleration, along.abs()), DIGITS);
    let (e, follower, cam_name) = (&s.points[own.0].name, scene.link_name(cam.follower), scene.link_name(cam.cam));
    Some(Missing {
        symbol: format!("a^{{n}}_{{{e}{follower}{e}{cam_name}}}"),
        direction: "\\perp t\\text{–}t".into(),
        magnitude: book.label(Kind::Acceleration, &crate::digits::inked(&number)),
    })
}

/// Why it is none.
pub fn why(scene: &Scene, index: usize) -> Both {
    let cam = &scene.cams[index];
    let (e, cam_name, follower) = (name(scene, index), scene.link_name(cam.cam), scene.link_name(cam.follower));
    let centre = cam.circle.map_or("", |c| scene.point_name(c.0));
    both!(
        "{e} is the point of contact at this instant only: the point of link {follower} at {e} does not run along the tangent of link {cam_name}, so its relative acceleration has a part along the normal. {centre}, the centre of the profile, is a lasting point: use it.",
        "{e} 只是该瞬时的接触点：构件 {follower} 上的 {e} 点并不沿构件 {cam_name} 的公切线作直线运动，相对加速度还有沿法线的分量。廓线圆心 {centre} 才是固定的点，应以它为重合点。"
    )
}
