//! The linkage of lower pairs in place of a mechanism with cams 高副低代: each contact becomes a link
//! with two lower pairs.
//!
//! | cam | follower | link |
//! |---|---|---|
//! | curved | round end or edge | a bar from the centre of curvature to the centre of the end |
//! | straight | round end or edge | a block in a slide of the cam, pinned to the end |
//! | curved | flat face | a block in a slide of the follower, pinned at the centre of curvature |
//!
//! The linkage has the velocities and accelerations of the instant; for a profile of one circle it
//! has those of every position.

use super::super::model::*;
use super::super::rolling::Rolling;
use hodograph_base::diag::Span;
use hodograph_base::geom::Point;

/// A link in place of the contact of a cam.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReplacingLink {
    /// The cam, an index into [`Scene::cams`] of the scene with cams.
    pub cam: usize,
    /// The link, in the scene without cams.
    pub link: LinkId,
    /// Its pin on the cam: the centre of curvature; `None` for a slide of the cam.
    pub on_cam: Option<PointId>,
    /// Its pin on the follower: the centre of its end; `None` for a slide of the follower.
    pub on_follower: Option<PointId>,
}

/// A scene without cams, and the links in place of their contacts.
#[derive(Clone, Debug, PartialEq)]
pub struct ReplacedScene {
    /// The linkage; it asks nothing and carries no loads. Points, drivers and the links of the
    /// scene with cams keep their indices.
    pub scene: Scene,
    /// One link for each cam.
    pub links: Vec<ReplacingLink>,
}

impl Scene {
    /// Returns the linkage in place of the mechanism with its cams; `at` gives places (m) that
    /// select the assembly. `None` without cams, and with a contact that no lower pairs replace:
    /// that of a law whose profile is straight at the instant.
    pub fn replaced(&self, at: impl Fn(PointId) -> Option<Point>) -> Option<ReplacedScene> {
        if self.cams.is_empty() {
            return None;
        }
        let mut scene = Scene {
            cams: Vec::new(),
            loads: Loads::default(),
            find: Vec::new(),
            composite: Vec::new(),
            attempts: Vec::new(),
            source: None,
            ..self.clone()
        };
        let rollers: Vec<String> = self.cams.iter().filter_map(|c| c.roller.clone()).collect();
        let mut links = Vec::new();
        let mut gone = Vec::new();
        for (k, cam) in self.cams.iter().enumerate() {
            // A contact of which a mobility count knows no more than that it exists has no form.
            let contact = cam
                .contact
                .filter(|_| cam.circle.is_some() || cam.disc.is_some() || cam.posed.is_some())?;
            let guide = &self.guides[contact.0];
            let pin = guide.pin?;
            let link = scene.add_link(&rollers, cam.span);
            match &guide.path {
                GuidePath::Arc { centre, radius } => {
                    scene.links[link.0].points = vec![*centre, pin];
                    if let Some(value) = radius {
                        let (a, b, value) = (*centre, pin, value.clone());
                        scene.lengths.push(Length { a, b, value });
                    }
                    gone.push(contact);
                    let (on_cam, on_follower) = (Some(*centre), Some(pin));
                    links.push(ReplacingLink { cam: k, link, on_cam, on_follower });
                }
                GuidePath::Line { .. } => {
                    scene.links[link.0].points = vec![pin];
                    scene.guides[contact.0].slider = Some(link);
                    let of_cam = guide.on == cam.cam;
                    let (on_cam, on_follower) =
                        if of_cam { (None, Some(pin)) } else { (Some(pin), None) };
                    links.push(ReplacingLink { cam: k, link, on_cam, on_follower });
                }
            }
        }
        scene.drop_guides(&gone);
        for (p, point) in scene.points.iter_mut().enumerate() {
            if let Some(place) = at(PointId(p)) {
                point.sketch = Some([place.x, place.y]);
            }
        }
        Some(ReplacedScene { scene, links })
    }

    /// Adds a link without points and returns it; its number is the first that no link and no roller
    /// has.
    fn add_link(&mut self, rollers: &[String], span: Span) -> LinkId {
        let taken =
            |name: &String| self.links.iter().map(|l| &l.name).chain(rollers).any(|n| n == name);
        let name = (1..).map(|k: usize| k.to_string()).find(|name| !taken(name));
        self.links.push(Link { name: name.unwrap_or_default(), points: Vec::new(), span });
        LinkId(self.links.len() - 1)
    }

    /// Removes guides of contacts, which nothing else of the scene names.
    fn drop_guides(&mut self, gone: &[GuideId]) {
        let place = |g: GuideId| GuideId(g.0 - gone.iter().filter(|k| k.0 < g.0).count());
        let mut k = 0;
        self.guides.retain(|_| {
            k += 1;
            !gone.contains(&GuideId(k - 1))
        });
        for d in &mut self.drivers {
            match &mut d.kind {
                DriverKind::Slide { guide, .. } => *guide = place(*guide),
                DriverKind::Turn { .. } | DriverKind::Cylinder { .. } => {}
            }
        }
        for guide in self.rolling.iter_mut().filter_map(Rolling::guide_mut) {
            *guide = place(*guide);
        }
    }
}
