//! Draws a block in the slots of two moving links (十字滑块, the disc of Oldham's coupling): one
//! rigid body with an arm along each slot, and no joint where the arms meet.

use hodograph_base::geom::{Vec2, cross_lines};
use hodograph_paper::paper::item::{Colour, Dash, FigureItem, Shape};
use hodograph_scene::{Guide, GuideId, GuidePath, PointId};

use super::MechanismDraft;
use super::letters::NumberPlace;

/// Half the length of an arm: this part of an arm shows beyond the width of the other one.
pub(super) const ARM_MM: f64 = 6.0;
/// Slots that cross at a smaller angle (sine) have no separate arms.
const SQUARE_SINE: f64 = 0.8;

impl MechanismDraft<'_> {
    /// The other slot of a block that runs in two.
    pub(super) fn crossing(&self, g: GuideId) -> Option<GuideId> {
        let guide = &self.scene.guides[g.0];
        let (pin, slider) = (guide.pin?, guide.slider?);
        let of_a_link = |o: &Guide| {
            o.on != self.scene.ground
                && o.rolling.is_none()
                && matches!(o.path, GuidePath::Line { .. })
        };
        let other = |o: &GuideId| {
            let o = &self.scene.guides[o.0];
            o.on != guide.on && o.pin == Some(pin) && o.slider == Some(slider) && of_a_link(o)
        };
        let o =
            (0..self.scene.guides.len()).map(GuideId).filter(|_| of_a_link(guide)).find(other)?;
        let sine = self.runner(g)?.1.cross(self.runner(o)?.1).abs();
        (sine > SQUARE_SINE).then_some(o)
    }

    /// True if a point is where the arms of such a block meet and nothing is joined: a point of one
    /// body.
    pub(super) fn in_cross(&self, p: PointId) -> bool {
        let here =
            |g: &GuideId| self.scene.guides[g.0].pin == Some(p) && self.crossing(*g).is_some();
        let Some(g) = (0..self.scene.guides.len()).map(GuideId).find(here) else { return false };
        self.scene.carriers(p).all(|l| Some(l) == self.scene.guides[g.0].slider)
    }

    /// Draws the block, once for its two slots.
    pub(super) fn cross(&mut self, g: GuideId, other: GuideId) {
        let (Some((at, u)), Some((_, v)), Some(slider)) =
            (self.runner(g), self.runner(other), self.scene.guides[g.0].slider)
        else {
            return;
        };
        if other < g {
            return;
        }
        let id = self.link_id(slider.0);
        self.d.of_link(Some(slider.0));
        let half = self.style.block_width_mm / 2.0;
        // The second direction is to the left of the first one.
        let v = if u.cross(v) > 0.0 { v } else { -v };
        let corner = |one: Vec2, next: Vec2| {
            // The intersection of the left side of one arm and the right side of the next.
            let inner = cross_lines(at + one.perp() * half, one, at - next.perp() * half, next).at;
            [at + one * ARM_MM - one.perp() * half, at + one * ARM_MM + one.perp() * half, inner]
        };
        let points = [(u, v), (v, -u), (-u, -v), (-v, u)]
            .into_iter()
            .flat_map(|(one, next)| corner(one, next))
            .collect();
        let outline = Shape::Polyline {
            points,
            closed: true,
            stroke: Some(self.style.outline),
            fill: Some(Colour::WHITE),
        };
        let hidden = [u, v].map(|along| {
            let (from, to) = (at - along * ARM_MM, at + along * ARM_MM);
            FigureItem::new(
                "slider hidden",
                Shape::Line { from, to, stroke: self.style.thin.dashed(Dash::Dashed) },
            )
        });
        let items = [FigureItem::new("slider", outline)].into_iter().chain(hidden).collect();
        self.d.draw(&id, "", items);
        self.d.of_link(None);
        self.number_at[slider.0] = Some(NumberPlace::Around(at, None));
    }
}
