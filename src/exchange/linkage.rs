//! The linkage of a solved scene: its joints, links, slides on the ground, and its crank.

use crate::diag::{Both, Diagnostic, Faults, both};
use crate::geom::{Point, Vec2};
use crate::position::Path;
use crate::scene::{GuidePath, LinkId, PointId, Scene};
use crate::worked::Worked;

/// A joint, or another point of a link.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkageJoint {
    /// The name.
    pub name: String,
    /// Its place at the instant (mm).
    pub at: Point,
    /// True if it is fixed.
    pub fixed: bool,
}

/// A moving link.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkageBody {
    /// The name.
    pub name: String,
    /// Its joints, by their indices.
    pub joints: Vec<usize>,
}

/// A straight guide.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkageSlide {
    /// The joint that runs in it.
    pub joint: usize,
    /// The body that carries it; `None` for the ground.
    pub on: Option<usize>,
    /// The body that keeps its direction in the guide; `None` for a bare pin in a slot.
    pub block: Option<usize>,
    /// Its direction at the instant, a unit vector.
    pub direction: Vec2,
}

/// A linkage with one crank.
#[derive(Clone, Debug, PartialEq)]
pub struct Linkage {
    /// The title.
    pub title: String,
    /// The joints.
    pub joints: Vec<LinkageJoint>,
    /// The moving links.
    pub bodies: Vec<LinkageBody>,
    /// The guides.
    pub slides: Vec<LinkageSlide>,
    /// The body that is driven.
    pub crank: usize,
    /// The fixed joint about which it turns.
    pub pivot: usize,
    /// Its angular velocity (rad/s), positive counter-clockwise.
    pub rate: f64,
}

impl Linkage {
    /// Returns the linkage of a scene at its instant.
    ///
    /// # Errors
    /// `export` for each part that such a linkage does not have: gears, belts, cams, circular slots,
    /// drivers other than one crank about a fixed pivot.
    pub fn of(scene: &Scene, worked: &Worked, title: String) -> Result<Linkage, Faults> {
        let mut faults = Faults::default();
        let mut lacking = |what: Both| faults.push(not_exported(what));
        if !scene.rolling.is_empty() || !scene.cams.is_empty() {
            lacking(both!("wheels, belts and cams"));
        }
        let mut number = vec![None; scene.points.len()];
        let mut joints = Vec::new();
        for (p, place) in worked.configuration.points.iter().enumerate() {
            let id = PointId(p);
            let used = scene.carriers(id).next().is_some()
                || scene.guides.iter().any(|g| g.pin == Some(id));
            if let Some(at) = place.filter(|_| used) {
                number[p] = Some(joints.len());
                let fixed = scene.links[scene.ground.0].points.contains(&id);
                let at = Point::new(at.x * 1e3, at.y * 1e3);
                joints.push(LinkageJoint { name: scene.point_name(id).to_owned(), at, fixed });
            }
        }
        let mut body_of = vec![None; scene.links.len()];
        let mut bodies: Vec<LinkageBody> = Vec::new();
        for (l, link) in scene.links.iter().enumerate().filter(|(l, _)| LinkId(*l) != scene.ground)
        {
            let joints: Vec<usize> = link.points.iter().filter_map(|p| number[p.0]).collect();
            if !joints.is_empty() {
                body_of[l] = Some(bodies.len());
                bodies.push(LinkageBody { name: link.name.clone(), joints });
            }
        }
        let mut slides = Vec::new();
        for (guide, path) in scene.guides.iter().zip(&worked.configuration.guides) {
            let joint = guide.pin.and_then(|pin| number[pin.0]);
            match (joint, &guide.path, path) {
                (Some(joint), GuidePath::Line { .. }, Some(Path::Line { direction, .. })) => {
                    let on = body_of[guide.on.0];
                    let block = guide.slider.and_then(|l| body_of[l.0]);
                    slides.push(LinkageSlide { joint, on, block, direction: *direction });
                }
                (_, GuidePath::Arc { .. }, _) => lacking(both!("circular slots")),
                _ => lacking(both!("slides without a pin")),
            }
        }
        let crank = match scene.drivers.as_slice() {
            [driver] => {
                driver.kind.turned().filter(|(_, against)| *against == scene.ground).and_then(
                    |(link, _)| {
                        let body = body_of[link.0]?;
                        let fixed = |j: &usize| joints[*j].fixed;
                        let pivot = bodies[body].joints.iter().copied().find(fixed)?;
                        Some((body, pivot, driver.rate.value))
                    },
                )
            }
            _ => None,
        };
        if crank.is_none() {
            lacking(both!("drivers other than one crank about a fixed pivot"));
        }
        match crank {
            Some((crank, pivot, rate)) if !faults.has_errors() => {
                Ok(Linkage { title, joints, bodies, slides, crank, pivot, rate })
            }
            _ => Err(faults),
        }
    }

    /// Returns the bodies that carry a joint.
    pub fn carriers(&self, joint: usize) -> impl Iterator<Item = usize> + '_ {
        (0..self.bodies.len()).filter(move |b| self.bodies[*b].joints.contains(&joint))
    }
}

/// The fault of a part that a format does not have.
pub(super) fn not_exported(what: Both) -> Diagnostic {
    Diagnostic::error("export", both!("the format has no place for {}", what))
        .help(both!("DXF and TikZ take every mechanism: `hodograph export SCENE -o x.dxf`"))
}
