//! Composite motion of a point: the moving points and frames that a mechanism offers, the reasons
//! for which some of them do not serve, and the parts of the motion for each choice.
//!
//! A choice serves if the moving point M and the frame belong to different bodies, M is permanently
//! the same material point, and its path in the frame is known. Then v_r has a known direction and
//! a_rⁿ a known magnitude, and each equation has only the unknowns of one crossing. The momentary
//! point of contact of a cam serves as well ([`contact`]). All other choices follow from topology
//! alone. The parts of the motion are found in the same way as the questions of the scene, by
//! drawing and by analysis.

pub mod contact;
pub mod coriolis;
pub mod derivation;
mod equated;
mod projection;
mod solved;

pub use contact::ContactScene;
pub use equated::{EquatedFrames, EquatedProjection, equated};
pub use projection::{On, Projection, ProjectionTerm, projections};
use solved::solved;
pub use solved::{AxisRotation, ChoiceSolution, ChoiceUnknowns, KnownMotion};

use hodograph_mechanism::mechanism::Level;
use hodograph_scene::quantity::{Frame, RelativePath, owns, relative_path};
use hodograph_scene::{CompositePoint, GuidePath, LinkId, OnLink, PointId, Scene};

/// The suitability of a moving point and a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ChoiceVerdict {
    /// The path of the point in the frame is known.
    Serves,
    /// No pair gives the path: the equation of velocities holds, but neither the direction of v_r
    /// nor a_rⁿ is known beforehand.
    PathUnknown,
    /// At every instant another point of the body is at the contact; its path is not the profile or
    /// guide.
    PointChanges,
    /// The point belongs to the frame.
    SameBody,
    /// The frame is at rest.
    FrameFixed,
}

/// The place at which a choice is offered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ChoicePlace {
    /// The scene names it.
    Named,
    /// A sliding pair.
    Guide(hodograph_scene::GuideId),
    /// A pin.
    Pin(PointId),
    /// The contact of a rolling pair.
    Contact(hodograph_scene::RollingId),
    /// The contact of a cam (index into the scene's list).
    Cam(usize),
}

/// A moving point and a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameChoice {
    /// The moving point.
    pub of: OnLink,
    /// The frame.
    pub frame: Frame,
    /// The place at which the choice is offered.
    pub place: ChoicePlace,
    /// The suitability of the choice.
    pub verdict: ChoiceVerdict,
    /// The path of the point in the frame.
    pub path: RelativePath,
}

/// The largest number of listed choices.
const MOST: usize = 500;

/// Judges a moving point and a frame.
pub fn judge(scene: &Scene, of: OnLink, frame: Frame, place: ChoicePlace) -> FrameChoice {
    let path = relative_path(scene, of, frame);
    let verdict = match path {
        _ if frame.is_fixed(scene) => ChoiceVerdict::FrameFixed,
        _ if frame.carries(scene, &of) => ChoiceVerdict::SameBody,
        _ if momentary(scene, of) => ChoiceVerdict::PointChanges,
        RelativePath::Guide(_) | RelativePath::Circle(_) => ChoiceVerdict::Serves,
        RelativePath::Unknown => ChoiceVerdict::PathUnknown,
    };
    // The point of a link under a pin has no path of its own, even if the pin runs on a circle.
    let path = if verdict == ChoiceVerdict::Serves { path } else { RelativePath::Unknown };
    FrameChoice { of, frame, place, verdict, path }
}

/// True if a point of a link is named only because a pin or contact of another link coincides with
/// it: at the next instant another point of the link is there.
fn momentary(scene: &Scene, of: OnLink) -> bool {
    let Some(link) = of.link else { return scene.rolling.iter().any(|r| r.at.contains(&of.point)) };
    if scene.links[link.0].points.contains(&of.point) {
        return false;
    }
    let under_pin = scene.guides.iter().any(|g| g.on == link && g.pin == Some(of.point));
    under_pin || scene.rolling.iter().any(|r| r.at.contains(&of.point) && r.links.contains(&link))
}

/// Returns all choices that topology offers: those that the scene names, then those at each slide,
/// pin and contact of wheels.
pub fn choices(scene: &Scene) -> Vec<FrameChoice> {
    let mut list = ChoiceList { scene, all: Vec::new() };
    for c in &scene.composite {
        if let CompositePoint::Point(of) = c.of {
            list.add(of, c.frame, ChoicePlace::Named);
        }
    }
    for (g, guide) in scene.guides.iter().enumerate().filter(|(_, g)| g.rolling.is_none()) {
        list.guide(hodograph_scene::GuideId(g), guide);
    }
    for p in (0..scene.points.len()).map(PointId) {
        list.pin(p);
    }
    for (r, pair) in scene.rolling.iter().enumerate() {
        // The ends of a strand are two different places.
        let Some(contact) = pair.contact() else { continue };
        let [a, b] = pair.links;
        for (own, other) in [(a, b), (b, a)] {
            let of = OnLink { point: contact, link: Some(own) };
            list.add_moving(
                of,
                Frame::Link(other),
                ChoicePlace::Contact(hodograph_scene::RollingId(r)),
            );
        }
    }
    list.all.truncate(MOST);
    list.all
}

/// Returns a point's name as a question writes it: `B`, `B3`, `O2,3`.
pub fn name_of(scene: &Scene, p: &OnLink) -> String {
    let point = scene.point_name(p.point);
    let Some(link) = p.link else { return point.to_owned() };
    let comma = if point.ends_with(|c: char| c.is_ascii_digit()) { "," } else { "" };
    format!("{point}{comma}{}", scene.link_name(link))
}

/// Returns the level of the parts of a motion: acceleration if a question of the scene asks for
/// one, otherwise velocity.
pub fn level(scene: &Scene) -> Level {
    scene
        .find
        .iter()
        .map(|f| f.what.level())
        .max()
        .map_or(Level::Velocity, |l| l.max(Level::Velocity))
}

/// True if the motion of a choice has parts.
fn usable(c: &FrameChoice) -> bool {
    match c.verdict {
        ChoiceVerdict::Serves | ChoiceVerdict::PathUnknown | ChoiceVerdict::PointChanges => true,
        ChoiceVerdict::SameBody | ChoiceVerdict::FrameFixed => false,
    }
}

struct ChoiceList<'a> {
    scene: &'a Scene,
    all: Vec<FrameChoice>,
}

impl ChoiceList<'_> {
    fn add(&mut self, of: OnLink, frame: Frame, place: ChoicePlace) {
        if !self.all.iter().any(|c| c.of == of && c.frame == frame) {
            self.all.push(judge(self.scene, of, frame, place));
        }
    }

    /// Adds a choice if both the frame and the point move.
    fn add_moving(&mut self, of: OnLink, frame: Frame, place: ChoicePlace) {
        if !frame.is_fixed(self.scene)
            && !owns(self.scene, self.scene.ground, &of)
            && !self.is_of_ground(&of)
        {
            self.add(of, frame, place);
        }
    }

    fn is_of_ground(&self, of: &OnLink) -> bool {
        of.link == Some(self.scene.ground)
    }

    fn guide(&mut self, id: hodograph_scene::GuideId, guide: &hodograph_scene::Guide) {
        let (scene, place) = (self.scene, ChoicePlace::Guide(id));
        let Some(pin) = guide.pin else { return };
        let of_pin = OnLink { point: pin, link: None };
        let under = OnLink { point: pin, link: Some(guide.on) };
        self.add_moving(of_pin, Frame::Link(guide.on), place);
        for runner in scene.carriers(pin).chain(guide.slider).filter(|l| *l != guide.on) {
            self.add_moving(under, Frame::Link(runner), place);
            if let GuidePath::Arc { centre, .. } = guide.path {
                self.add_moving(OnLink { point: centre, link: None }, Frame::Link(runner), place);
            }
        }
        // A link runs through a sleeve that turns about a fixed pin: its joints move along the guide.
        if let (GuidePath::Line { .. }, Some(sleeve)) = (&guide.path, guide.slider)
            && owns(scene, scene.ground, &of_pin)
        {
            let joined = |q: &&PointId| {
                scene.carriers(**q).count() > 1 || scene.guides.iter().any(|g| g.pin == Some(**q))
            };
            for q in scene.links[guide.on.0].points.iter().filter(joined) {
                self.add_moving(OnLink { point: *q, link: None }, Frame::Link(sleeve), place);
            }
        }
        if let GuidePath::Arc { centre, .. } = guide.path {
            let of_centre = OnLink { point: centre, link: None };
            self.add_moving(of_pin, Frame::Point(of_centre), place);
            self.add_moving(of_centre, Frame::Point(of_pin), place);
        }
    }

    /// Adds the choices at a pin of two links: the pin belongs to both, and further points of one
    /// link run on circles in the other.
    fn pin(&mut self, p: PointId) {
        let (scene, place) = (self.scene, ChoicePlace::Pin(p));
        let pin = OnLink { point: p, link: None };
        let links: Vec<LinkId> = scene.carriers(p).filter(|l| *l != scene.ground).collect();
        for own in &links {
            for other in links.iter().filter(|l| *l != own) {
                self.add_moving(pin, Frame::Link(*other), place);
                for q in scene.links[own.0].points.iter().filter(|q| **q != p) {
                    self.add_moving(OnLink { point: *q, link: None }, Frame::Link(*other), place);
                }
            }
            for q in scene.links[own.0].points.iter().filter(|q| **q != p && links.len() > 1) {
                self.add_moving(OnLink { point: *q, link: None }, Frame::Point(pin), place);
            }
        }
    }
}
