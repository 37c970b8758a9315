//! Draws guides, slots, blocks, rods of yokes, and cylinders.

use hodograph_base::geom::{Point, Vec2, cross_lines};
use hodograph_mechanism::mechanism::Opened;
use hodograph_mechanism::position::Path;
use hodograph_paper::paper::item::{Dash, Shape};
use hodograph_paper::paper::symbols as sym;
use hodograph_scene::{GuideId, GuidePath, LinkId, PointId, Through};

use super::MechanismDraft;
use super::letters::NumberPlace;
use super::wheels::RACK_HALF_MM;

/// Length of a fixed guide: a little more than three blocks.
pub(super) const GUIDE_MM: f64 = 26.0;
/// Distance from a yoke's slot to the bushing of its rod.
const BUSHING_MM: f64 = 20.0;
/// Distance between the end of a rack and its bushing.
const BUSHING_FREE_MM: f64 = 5.0;
/// Length of a bushing.
const BUSHING_LENGTH_MM: f64 = 11.0;
/// Extension of the slotted bar of a yoke beyond its rod.
const BEYOND_ROD_MM: f64 = 8.0;
/// Length of a cylinder's barrel, as a part of the cylinder's length: the rod shows also when it is
/// far in.
const BARREL_PART: f64 = 0.5;
/// Half the length of a fixed curved slot.
const FIXED_SLOT_HALF_MM: f64 = 13.0;

impl MechanismDraft<'_> {
    /// The guides that are drawn as guides: rolling pairs have their own drawing.
    fn guides(&self) -> impl Iterator<Item = GuideId> + use<> {
        let drawn: Vec<GuideId> = (0..self.scene.guides.len())
            .map(GuideId)
            .filter(|g| self.scene.guides[g.0].rolling.is_none())
            .collect();
        drawn.into_iter()
    }

    /// Draws guides on the ground: hatched lines along the block, or a slot for a bare pin.
    pub(super) fn ground_guides(&mut self) {
        for g in self.guides() {
            let guide = &self.scene.guides[g.0];
            if guide.on != self.scene.ground || !self.shows_runner(g) {
                continue;
            }
            let (pin, slider) = (guide.pin, guide.slider);
            let Some(path) = self.guide(g) else { continue };
            match (pin, slider, path) {
                (Some(p), Some(_), Path::Line { direction, .. }) => {
                    self.hatched_line(g, p, direction)
                }
                (None, Some(_), Path::Line { direction, .. }) => self.bushing(g, direction),
                (Some(p), None, Path::Line { direction, .. }) => self.fixed_slot(g, p, direction),
                (Some(p), _, Path::Arc { centre, radius }) => self.fixed_arc(g, p, centre, radius),
                _ => {}
            }
        }
    }

    fn hatched_line(&mut self, g: GuideId, p: PointId, direction: Vec2) {
        let Some(at) = self.point(p) else { return };
        self.axis(g, p, at, direction);
        // Hatched on the right-hand side of its direction: below, or away from a link that comes
        // from there.
        let rightward = direction.x > 1e-9 || direction.x.abs() <= 1e-9 && direction.y > 0.0;
        let mut u = if rightward { direction } else { -direction };
        let pull: f64 = self.leaving(p).iter().map(|v| u.cross(*v)).sum();
        // The sine of the angle under which a link reaches the line before the line's end.
        let half_mm = self.style.block_width_mm / 2.0;
        let steep = half_mm / libm::hypot(half_mm, GUIDE_MM / 2.0);
        let turned = match self.course.hatched.get(g.0).copied().flatten() {
            Some(side) => side.dot(u.perp()) > 0.0,
            None => pull < -steep,
        };
        if turned {
            u = -u;
        }
        self.hatched[g.0] = Some(-u.perp());
        let [back, on] = self.travel(g);
        let middle = at + self.raised(g, direction) + direction * ((back + on) / 2.0);
        let items = sym::guide(
            self.style,
            middle,
            u.angle(),
            GUIDE_MM + on - back,
            sym::GuideForm::OneSided,
        );
        let items = self.as_opened(Opened::Guide(g), items);
        self.d.draw(&format!("guide-{}", self.scene.point_name(p)), "", items);
    }

    /// Draws the line from a named point of the ground along which the block moves.
    fn axis(&mut self, g: GuideId, p: PointId, at: Point, direction: Vec2) {
        let GuidePath::Line { through: Through::Point(q), offset, .. } =
            &self.scene.guides[g.0].path
        else {
            return;
        };
        let (Some(from), None) = (self.point(*q), offset) else { return };
        let Some(u) = (at - from).unit() else { return };
        if u.cross(direction).abs() > 1e-6 {
            return;
        }
        let [back, on] = self.travel(g);
        let ahead = if u.dot(direction) > 0.0 { on } else { -back };
        let shape = Shape::Line {
            from,
            to: at + u * (ahead + GUIDE_MM / 2.0 + 4.0),
            stroke: self.style.thin.dashed(Dash::DashDot),
        };
        self.d.shape(&format!("axis-{}", self.scene.point_name(p)), "centre", shape);
    }

    fn fixed_slot(&mut self, g: GuideId, p: PointId, direction: Vec2) {
        let Some(at) = self.point(p) else { return };
        let [back, on] = self.travel(g);
        let at = at + direction * ((back + on) / 2.0);
        let (u, n) = (
            direction * ((GUIDE_MM + on - back) / 2.0),
            direction.perp() * (self.style.slot_width_mm / 2.0),
        );
        let id = format!("guide-{}", self.scene.point_name(p));
        self.d.draw(&id, "", sym::ground_line(self.style, at - u - n, at + u - n));
        self.d.draw(&id, "", sym::ground_line(self.style, at + u + n, at - u + n));
    }

    /// Draws a curved slot of the ground, and the radius from its centre.
    fn fixed_arc(&mut self, g: GuideId, p: PointId, centre: Point, radius: f64) {
        let Some(at) = self.point(p) else { return };
        let (middle, half) = ((at - centre).angle(), (FIXED_SLOT_HALF_MM / radius).min(1.5));
        let [back, on] = self.travel(g).map(|t| t / radius);
        let span = [middle + back - half, middle + on + half];
        let (radius, width) =
            (radius.max(self.style.slot_width_mm), self.style.slot_width_mm / 2.0);
        let id = format!("guide-{}", self.scene.point_name(p));
        self.d.draw(&id, "", sym::ground_arc(self.style, centre, radius + width, span, true));
        self.d.draw(&id, "", sym::ground_arc(self.style, centre, radius - width, span, false));
        let shape =
            Shape::Line { from: centre, to: at, stroke: self.style.thin.dashed(Dash::DashDot) };
        self.d.shape(&format!("{id}-radius"), "centre", shape);
    }

    /// Draws a slider without a pin (a yoke): a rod through a hatched bushing.
    fn bushing(&mut self, g: GuideId, u: Vec2) {
        let Some(slider) = self.scene.guides[g.0].slider else { return };
        let Some((root, taken)) = self.rod_root(slider.0, g, u) else { return };
        // Away from the fixed pivots, so that the crank does not run into the bushing.
        let pivots = (0..self.scene.points.len())
            .map(PointId)
            .filter(|p| self.is_fixed_pivot(*p))
            .filter_map(|p| self.point(p));
        let [back, on] = self.travel(g);
        let middle = root + u * ((back + on) / 2.0);
        let away: f64 = pivots.map(|p| (middle - p).dot(u)).sum();
        let (u, ahead) = if away < 0.0 { (-u, -back) } else { (u, on) };
        // The bushing is where the yoke never comes; the rod reaches through it when the yoke is
        // farthest away.
        let before = BUSHING_MM.max(taken + BUSHING_FREE_MM);
        let centre = root + u * (ahead + before + BUSHING_LENGTH_MM / 2.0);
        let end = root + u * (on - back + before + BUSHING_LENGTH_MM + 8.0);
        let root = root + u * taken;
        let name = self.scene.links[slider.0].name.clone();
        let items =
            sym::guide(self.style, centre, u.angle(), BUSHING_LENGTH_MM, sym::GuideForm::TwoSided);
        self.d.draw(&format!("guide-{name}"), "", items);
        self.d.of_link(Some(slider.0));
        let owner = self.d.draw(&format!("link-{name}"), "", sym::link(self.style, &[root, end]));
        self.d.of_link(None);
        self.number_at[slider.0] =
            Some(NumberPlace::Along(root, root + u * (before - taken), owner));
    }

    /// The start of a yoke's rod: on its slot, level with a fixed pivot; at one of its points; at a
    /// wheel's contact; or on its guide. The second value is the half length of the body that holds
    /// the rod.
    fn rod_root(&self, slider: usize, g: GuideId, u: Vec2) -> Option<(Point, f64)> {
        let link = &self.scene.links[slider];
        let slot = self.forms[slider].as_ref().and_then(|f| f.guide_bars.first().copied());
        if let Some((a, b)) = slot {
            let pivot = (0..self.scene.points.len())
                .map(PointId)
                .find(|p| self.is_fixed_pivot(*p))
                .and_then(|p| self.point(p));
            let middle = a + (b - a) * 0.5;
            let crossing = cross_lines(a, b - a, pivot.unwrap_or(middle), u);
            return Some((
                if crossing.at.is_finite() && crossing.sine.abs() > 0.1 {
                    crossing.at
                } else {
                    middle
                },
                0.0,
            ));
        }
        let own = link.points.iter().find_map(|p| self.point(*p));
        let rolled = || {
            self.scene
                .rolling
                .iter()
                .filter(|r| r.links.iter().any(|l| l.0 == slider))
                .find_map(|r| self.point(r.at_of(LinkId(slider))))
        };
        let along = || own.or_else(|| self.runner(g).map(|(at, _)| at)).map(|at| (at, 0.0));
        own.is_none().then(rolled).flatten().map(|at| (at, RACK_HALF_MM)).or_else(along)
    }

    /// Draws guides carried by moving links: bars, and slots over them.
    pub(super) fn carriers(&mut self) {
        for l in 0..self.forms.len() {
            let Some(mut form) = self.forms[l].take() else { continue };
            let id = self.link_id(l);
            if self.scene.links[l].points.is_empty() {
                self.extend_yoke(l, &mut form);
            }
            self.d.of_link(Some(l));
            for (k, (a, b)) in form.guide_bars.iter().enumerate() {
                let aside = self.aside(LinkId(l), form.bars.len() + k);
                self.d.draw(&id, "", sym::link(self.style, &[*a + aside, *b + aside]));
            }
            for (a, b) in &form.slots {
                self.d.draw(&format!("{id}-slot"), "", sym::slot(self.style, *a, *b));
            }
            for (centre, radius, [from, to]) in &form.arcs {
                let r = radius.max(self.style.slot_width_mm);
                self.d.draw(
                    &format!("{id}-slot"),
                    "",
                    sym::slot_arc(self.style, *centre, r, *from, *to),
                );
                let middle = *centre + Vec2::from_angle((from + to) / 2.0) * r;
                let shape = Shape::Line {
                    from: *centre,
                    to: middle,
                    stroke: self.style.thin.dashed(Dash::DashDot),
                };
                self.d.shape(&format!("{id}-radius"), "centre", shape);
            }
            self.forms[l] = Some(form);
        }
        self.d.of_link(None);
    }

    /// Extends the slotted bar of a yoke to its rod.
    fn extend_yoke(&self, l: usize, form: &mut super::LinkForm) {
        let glides = |g: &GuideId| {
            self.scene.guides[g.0].slider.is_some_and(|s| s.0 == l)
                && self.scene.guides[g.0].pin.is_none()
        };
        let Some(g) = self.guides().find(glides) else { return };
        let Some(Path::Line { direction, .. }) = self.guide(g) else { return };
        let [(a, b)] = form.guide_bars[..] else { return };
        let Some(u) = (b - a).unit() else { return };
        let crossing = {
            let pivot = (0..self.scene.points.len())
                .map(PointId)
                .find(|p| self.is_fixed_pivot(*p))
                .and_then(|p| self.point(p));
            cross_lines(a, u, pivot.unwrap_or(a + (b - a) * 0.5), direction)
        };
        if !crossing.at.is_finite() || crossing.sine.abs() < 0.1 {
            return;
        }
        let t = (crossing.at - a).dot(u);
        form.guide_bars[0] =
            (a + u * (t - BEYOND_ROD_MM).min(0.0), a + u * (t + BEYOND_ROD_MM).max(a.distance(b)));
    }

    /// Draws the blocks of numbered sliders with a pin.
    pub(super) fn blocks(&mut self) {
        for g in self.guides() {
            let guide = &self.scene.guides[g.0];
            let (Some(_), Some(slider)) = (guide.pin, guide.slider) else { continue };
            if !self.shows(slider) || self.is_bore(g) {
                continue;
            }
            if let Some(other) = self.crossing(g) {
                self.cross(g, other);
                continue;
            }
            let through =
                guide.on != self.scene.ground && matches!(guide.path, GuidePath::Line { .. });
            let Some((pin, tangent)) = self.runner(g) else { continue };
            let at = pin + self.raised(g, tangent);
            let items = sym::block(self.style, at, tangent.angle(), through);
            self.d.of_link(Some(slider.0));
            if at != pin {
                self.d.draw(
                    &format!("link-{}", self.scene.links[slider.0].name),
                    "",
                    sym::link(self.style, &[pin, at]),
                );
            }
            self.d.draw(&format!("link-{}", self.scene.links[slider.0].name), "", items);
            self.number_at[slider.0] =
                Some(NumberPlace::Around(at, self.hatched[g.0].map(|side| -side)));
        }
        self.d.of_link(None);
    }

    /// Draws cylinders: the barrel at their first point, the rod at their second.
    pub(super) fn cylinders(&mut self) {
        for k in 0..self.scene.drivers.len() {
            let kind = &self.scene.drivers[k].kind;
            let Some([a, b]) = kind.ends() else { continue };
            if !self.shows_driver(k) {
                continue;
            }
            let (links, name) = (
                kind.parts().to_vec(),
                format!("cylinder-{}{}", self.scene.point_name(a), self.scene.point_name(b)),
            );
            let (Some(base), Some(tip)) = (self.point(a), self.point(b)) else { continue };
            let length = base.distance(tip);
            let mut items = sym::cylinder(self.style, base, tip, BARREL_PART * length);
            for item in &mut items {
                let of_rod = ["rod", "piston"].iter().any(|part| item.class.contains(part));
                item.link = links.get(usize::from(of_rod)).map(|l| l.0);
            }
            let owner = self.d.draw(&name, "", items);
            let at = |t: f64| base + (tip - base) * t;
            let off = self.style.block_width_mm / 2.0;
            for (l, (from, to, wide)) in links.iter().zip([(0.1, 0.6, off), (0.65, 0.95, 0.0)]) {
                self.number_at[l.0] = Some(NumberPlace::Wide(at(from), at(to), wide, owner));
            }
        }
    }
}
