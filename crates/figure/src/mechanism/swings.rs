//! Draws swinging blocks: a link with one joint, and a guide through that joint for another link's
//! rod (曲柄摇块, an oscillating cylinder).
//!
//! Such a link is drawn as the block, and the runner as the rod, from its pin through the block and
//! beyond. A link with another point on it is a lever on which a block slides
//! ([`slides`](super::slides)); so is a link that a driver turns, and a link with a runner that
//! itself carries a guide.

use hodograph_base::geom::{Point, Vec2};
use hodograph_mechanism::position::Path;
use hodograph_paper::paper::symbols as sym;
use hodograph_scene::{GuideId, GuidePath, LinkId, PointId};

use super::MechanismDraft;
use super::letters::NumberPlace;

/// Extension of the rod beyond the block.
const BEYOND_MM: f64 = 6.0;

/// A swinging block on paper.
pub(super) struct SwingingBlock {
    /// The block.
    pub block: LinkId,
    /// The link that slides through the block.
    pub rod: LinkId,
    /// The block's joint.
    pub centre: Point,
    /// The rod, from its pin to its free end.
    pub ends: (Point, Point),
}

impl MechanismDraft<'_> {
    /// True if a guide is the bore of a swinging block: its carrier has one point, which is on the
    /// guide.
    pub(super) fn is_bore(&self, g: GuideId) -> bool {
        let guide = &self.scene.guides[g.0];
        let [joint] = self.scene.links[guide.on.0].points[..] else { return false };
        let straight = matches!(guide.path, GuidePath::Line { .. })
            && guide.rolling.is_none()
            && !self.is_contact(g);
        let alone = self
            .scene
            .guides
            .iter()
            .filter(|o| o.on == guide.on || o.slider == Some(guide.on))
            .count()
            == 1;
        let plain = |l: LinkId| {
            self.scene.guides.iter().all(|o| o.on != l)
                && self.scene.links[l.0].points.iter().all(|p| Some(*p) == guide.pin)
        };
        let rod = guide.slider.is_some_and(plain) && self.crossing(g).is_none();
        let turned = self.scene.drivers.iter().any(|d| d.kind.turns_link(guide.on));
        let hangs = guide.pin.is_some_and(|p| p != joint)
            && guide.on != self.scene.ground
            && self.is_pin(joint);
        if !(straight && alone && rod && hangs) || turned {
            return false;
        }
        match (self.guide(g), self.point(joint)) {
            (Some(Path::Line { through, direction }), Some(at)) => {
                (at - through).cross(direction).abs() < super::SAME_MM
            }
            (Some(Path::Arc { .. }), _) | (None, _) | (_, None) => false,
        }
    }

    /// All swinging blocks.
    pub(super) fn swings(&self) -> Vec<SwingingBlock> {
        (0..self.scene.guides.len())
            .map(GuideId)
            .filter(|g| self.is_bore(*g))
            .filter_map(|g| self.swing(g))
            .collect()
    }

    fn swing(&self, g: GuideId) -> Option<SwingingBlock> {
        let guide = &self.scene.guides[g.0];
        let (pin, centre) =
            (self.point(guide.pin?)?, self.point(self.scene.links[guide.on.0].points[0])?);
        // A pin in the middle of the block leaves the guide's own direction.
        let along = self.runner(g)?.1;
        let u = (centre - pin).unit().unwrap_or(along);
        let [back, on] = self.travel(g);
        let farther = if u.dot(along) > 0.0 { -back } else { on };
        let length = pin.distance(centre) + farther + self.style.block_length_mm / 2.0 + BEYOND_MM;
        Some(SwingingBlock {
            block: guide.on,
            rod: guide.slider?,
            centre,
            ends: (pin, pin + u * length),
        })
    }

    /// The directions in which rods leave the joint of a block.
    pub(super) fn rods_leaving(&self, p: PointId) -> Vec<Vec2> {
        let Some(at) = self.point(p) else { return Vec::new() };
        let here = self.swings().into_iter().filter(|s| s.centre.distance(at) < super::SAME_MM);
        here.flat_map(|s| [s.ends.0, s.ends.1].map(|e| e - at)).filter_map(Vec2::unit).collect()
    }

    /// Draws the blocks, over their rods and supports.
    pub(super) fn swinging(&mut self) {
        let shown: Vec<SwingingBlock> =
            self.swings().into_iter().filter(|s| self.shows(s.block)).collect();
        for s in shown {
            let Some(u) = (s.ends.1 - s.ends.0).unit() else { continue };
            let id = self.link_id(s.block.0);
            self.d.of_link(Some(s.block.0));
            self.d.draw(&id, "", sym::block(self.style, s.centre, u.angle(), true));
            self.d.of_link(None);
            self.d.draw(&format!("{id}-pin"), "", sym::pin(self.style, s.centre));
            self.number_at[s.block.0] = Some(NumberPlace::Around(s.centre, Some(u.perp())));
        }
    }
}
