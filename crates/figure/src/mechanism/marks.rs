//! Draws the drivers: given angles, and the places of the arrows of given rates;
//! [`rates`](super::rates) draws these arrows.

use std::f64::consts::TAU;

use hodograph_base::geom::{Point, Vec2};
use hodograph_board::plan::names::name_label;
use hodograph_paper::paper::broken::seen;
use hodograph_paper::paper::extent::on_circle;
use hodograph_paper::paper::item::{FigureItem, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::{LabelRequest, Reads};
use hodograph_paper::paper::symbols as sym;
use hodograph_report::given::GivenSentences;
use hodograph_scene::{Driver, DriverKind, GuideId, Lang, LinkId, PointId};

use super::rates::{ARROW_MM, Slides, TurnArrows};
use super::{MechanismDraft, form};

/// Radius of a given angle's arc: as a part of the crank, and between a readable and an unobtrusive
/// radius.
const ANGLE_PART: f64 = 0.5;
const ANGLE_MM: [f64; 2] = [8.5, 13.0];
/// A shorter arc gets a larger radius, up to this part of the crank and this radius.
const ANGLE_ARC_MM: f64 = 9.0;
const SMALL_ANGLE_PART: f64 = 0.8;
const SMALL_ANGLE_MM: f64 = 24.0;
/// Radius of the arrow of a rotation; it clears the support's triangle (6.2 mm with its hatching).
const ROTATION_PART: f64 = 0.4;
const ROTATION_MM: [f64; 2] = [7.0, 9.5];
/// Start and end of the arrow of a rotation, measured from the crank.
const ROTATION_RAD: [f64; 2] = [0.45, 1.9];
/// Additional radius of a second driver's arrows: its label fits between.
pub(super) const NEXT_MM: f64 = 6.0;
/// Distance between a support's hatching and the arc of an angle round it.
const HATCHING_AIR_MM: f64 = 0.8;
/// Sampling step of an arc, length of its head, step of the other radii that are tried, and their
/// excess over the usual limit.
const ARC_STEP_MM: f64 = 0.2;
const HEAD_MM: f64 = 2.5;
const RADIUS_STEP_MM: f64 = 0.5;
const FARTHER_MM: f64 = 3.0;
/// Cost of a fully hidden arc, against 1 per mm of change of the radius.
const HIDDEN_COST: f64 = 100.0;
/// Sine of the angle beyond which the side of a given angle and the drawn line of the link are two
/// lines.
const OWN_LINE: f64 = 0.01;
/// A smaller given angle has no space for its arrow.
const ANGLE_LEAST_RAD: f64 = 0.12;
/// Distance of the arrow of a wheel from the rim, and half its length.
const RIM_OFF_MM: f64 = 2.5;
const RIM_ARROW_MM: f64 = 8.0;
/// Distance of a straight arrow from the moving part.
const ARROW_OFF_MM: f64 = 3.0;

/// The names of a mark: in ids and on paper, with its kind.
pub(super) struct Called<'a> {
    /// The name in ids.
    pub id: &'a str,
    /// The name on paper, in the label language.
    pub symbol: &'a str,
    /// The last word of the class.
    pub class: &'a str,
}

impl MechanismDraft<'_> {
    /// Draws all drivers.
    pub(super) fn drivers(&mut self) {
        let mut centres: Vec<Point> = Vec::new();
        for k in 0..self.scene.drivers.len() {
            // A follower that a cam's law moves is no driver.
            if !self.shows_driver(k) || self.scene.is_led(k) {
                continue;
            }
            let driver = &self.scene.drivers[k];
            match driver.kind {
                DriverKind::Turn { link, against, .. } => {
                    let Some(centre) = self.shared(link, against) else { continue };
                    // A second driver at the same joint has its arrows around those of the first.
                    let before =
                        centres.iter().filter(|c| c.distance(centre) < super::SAME_MM).count();
                    centres.push(centre);
                    self.turning(driver, centre, before as f64 * NEXT_MM);
                }
                DriverKind::Slide { guide, .. } => self.sliding(guide, driver),
                DriverKind::Cylinder { a, b, .. } => self.stretching(a, b, driver),
            }
        }
    }

    /// Given angles with arcs around a point: start angle and sweep.
    pub(super) fn given_angles(&self, p: PointId) -> Vec<(f64, f64)> {
        let at_point = |d: &Driver| match d.kind {
            DriverKind::Turn { link, against, line, angle: Some(ref angle), .. }
                if against == self.scene.ground =>
            {
                let vertex =
                    line.map(|l| l.0).or_else(|| self.scene.links[link.0].points.first().copied());
                (vertex == Some(p)).then(|| (0.0, angle.value.radians() % TAU))
            }
            DriverKind::Turn { .. } | DriverKind::Slide { .. } | DriverKind::Cylinder { .. } => {
                None
            }
        };
        self.scene
            .drivers
            .iter()
            .filter_map(at_point)
            .filter(|(_, sweep)| sweep.abs() > ANGLE_LEAST_RAD)
            .collect()
    }

    fn turning(&mut self, driver: &Driver, centre: Point, wider_mm: f64) {
        let DriverKind::Turn { link, against, line, against_line, ref angle } = driver.kind else {
            return;
        };
        let first_two = |l: LinkId| match self.scene.links[l.0].points[..] {
            [a, b, ..] => Some((a, b)),
            _ => None,
        };
        let ends = line
            .or_else(|| first_two(link))
            .and_then(|(a, b)| Some((self.point(a)?, self.point(b)?)));
        let ends = ends.or_else(|| self.lever(link)).or_else(|| self.turned_block(link));
        // The arrow of a wheel without a line of its own is outside its rim.
        let wheel = self.free_side(link).filter(|_| ends.is_none());
        let Some((at, to)) = ends.or_else(|| wheel.map(|(c, u, r)| (c, c + u * r))) else { return };
        let Some(u) = (to - at).unit() else { return };
        let crank = at.distance(to);
        let grounded = against == self.scene.ground;
        let index = if grounded {
            self.scene.link_name(link).to_owned()
        } else {
            format!("{}/{}", self.scene.link_name(link), self.scene.link_name(against))
        };
        let mut side = 1.0;
        let written = angle.as_ref().map(|a| a.value.radians() % TAU);
        if let Some(sweep) = written.filter(|s| s.abs() > ANGLE_LEAST_RAD && ends.is_some()) {
            side = sweep.signum();
            let radius = (ANGLE_PART * crank).clamp(ANGLE_MM[0], ANGLE_MM[1]);
            // A small angle has a larger radius, so that its arc has space for a head.
            let radius = radius.max(
                (ANGLE_ARC_MM / sweep.abs()).min(SMALL_ANGLE_PART * crank).min(SMALL_ANGLE_MM),
            ) + wider_mm;
            // Round a support's hatching, not through it, if the link is long enough.
            let round = self.hatching_mm() + HATCHING_AIR_MM;
            let held = self.scene.links[link.0]
                .points
                .iter()
                .find(|p| self.is_fixed_pivot(**p) && self.point(**p) == Some(at));
            let passes = |p: &PointId| form::sweeps(0.0, sweep, self.support_side(*p).angle());
            let radius = if grounded && round < crank && held.is_some_and(passes) {
                radius.max(round)
            } else {
                radius
            };
            let reference = match against_line.or_else(|| first_two(against)) {
                Some((a, b)) if !grounded || against_line.is_some() => {
                    self.point(a).zip(self.point(b)).map_or(0.0, |(a, b)| (b - a).angle())
                }
                _ => 0.0,
            };
            let radius =
                self.radius_off_hatching(at, (radius, crank), [reference, reference + sweep]);
            let mut arc = sym::angle(self.style, at, radius, reference, reference + sweep);
            // A cam that is not a circle has no line of its own there.
            let own = Vec2::from_angle(reference + sweep);
            let round = self.scene.cams.iter().any(|c| c.cam == link && c.circle.is_some());
            if own.cross(u).abs() > OWN_LINE || self.is_profile(link) && !round {
                let (from, to) =
                    (at + own * self.style.pin_radius_mm, at + own * (radius * 4.0 / 3.0));
                arc.insert(
                    0,
                    FigureItem::new("angle own", Shape::Line { from, to, stroke: self.style.thin }),
                );
            }
            let id = format!("angle-{}", index.replace('/', "-"));
            let owner = self.d.draw(
                &id,
                "driver",
                self.behind_hatching(arc, at, radius, [reference, reference + sweep]),
            );
            let mut symbol = format!("\\varphi_{{{}}}", name_label(&index));
            if let Some(given) = angle.as_ref().filter(|_| self.dimensioned) {
                symbol += &format!(
                    " = {}",
                    GivenSentences { scene: self.scene, lang: Lang::default() }.angle(given)
                );
            }
            self.arc_label(
                Called { id: &id, symbol: &symbol, class: "angle" },
                at,
                radius,
                [reference, reference + sweep],
                owner,
            );
        }
        let radius = match wheel {
            Some((_, _, rim)) => rim + RIM_OFF_MM,
            None => (ROTATION_PART * crank).clamp(ROTATION_MM[0], ROTATION_MM[1]) + wider_mm,
        };
        let outward = if at.distance(centre) <= to.distance(centre) { u } else { -u };
        let angles = match wheel {
            Some((_, _, rim)) => {
                [-1.0, 1.0].map(|a| outward.angle() + a * (RIM_ARROW_MM / rim).min(1.0))
            }
            None => ROTATION_RAD.map(|a| outward.angle() + side * a),
        };
        self.d.of_link(Some(link.0));
        self.rotations(
            driver,
            &index,
            TurnArrows { centre, radius, angles, mirror: outward.angle() },
        );
        self.d.of_link(None);
    }

    /// The parts of an arc that no hatching hides; its head is always visible.
    fn seen_parts(&self, at: Point, radius: f64, [from, to]: [f64; 2]) -> Vec<[f64; 2]> {
        let length = radius * (to - from).abs();
        let head = HEAD_MM / length;
        let on = |t: f64| on_circle(at, radius, from + (to - from) * t);
        seen((length / ARC_STEP_MM).ceil() as usize, |t| {
            t < 1.0 - head && self.d.obstacles().is_barred(on(t), HATCHING_AIR_MM)
        })
    }

    /// The radius nearest to this one at which the least part of a given angle's arc is in
    /// hatching.
    fn radius_off_hatching(&self, at: Point, (radius, crank): (f64, f64), angles: [f64; 2]) -> f64 {
        let most = radius.max((SMALL_ANGLE_PART * crank).min(SMALL_ANGLE_MM)) + FARTHER_MM;
        let head =
            |r: f64| self.d.obstacles().is_barred(on_circle(at, r, angles[1]), HEAD_MM / 2.0);
        let hidden = |r: f64| {
            let seen: f64 = self.seen_parts(at, r, angles).iter().map(|[from, to]| to - from).sum();
            1.0 - seen + if head(r) { 1.0 } else { 0.0 }
        };
        let steps = ((most - ANGLE_MM[0]) / RADIUS_STEP_MM).floor().max(0.0) as usize;
        let others = (0..=steps).map(|k| ANGLE_MM[0] + k as f64 * RADIUS_STEP_MM);
        let cost = |r: f64| HIDDEN_COST * hidden(r) + (r - radius).abs();
        if hidden(radius) == 0.0 {
            radius
        } else {
            others.fold(radius, |best, r| if cost(r) < cost(best) { r } else { best })
        }
    }

    /// An angle's items, with its arc broken where hatching hides it.
    fn behind_hatching(
        &self,
        mut items: Vec<FigureItem>,
        at: Point,
        radius: f64,
        [from, to]: [f64; 2],
    ) -> Vec<FigureItem> {
        let parts = self.seen_parts(at, radius, [from, to]);
        let angle = |t: f64| from + (to - from) * t;
        if let (
            Some((last, before)),
            Some(FigureItem { shape: Shape::ArcArrow { from_rad, stroke, .. }, class, .. }),
        ) = (parts.split_last(), items.last_mut())
        {
            *from_rad = angle(last[0]);
            let (stroke, class) = (*stroke, class.clone());
            items.extend(before.iter().map(|[a, b]| {
                FigureItem::new(
                    class.clone(),
                    Shape::Arc {
                        centre: at,
                        radius_mm: radius,
                        from_rad: angle(*a),
                        to_rad: angle(*b),
                        stroke,
                    },
                )
            }));
        }
        items
    }

    /// Distance from a fixed pivot to the farthest corner of its support's hatching.
    fn hatching_mm(&self) -> f64 {
        let style = self.style;
        libm::hypot(
            style.ground_half_mm + style.hatch_depth_mm,
            style.pivot_height_mm + style.hatch_depth_mm,
        )
    }

    /// For a link that consists of its pivot and a slot through it: the pivot, and a point of the
    /// slot.
    fn lever(&self, l: LinkId) -> Option<(Point, Point)> {
        let [pivot] = self.scene.links[l.0].points[..] else { return None };
        let slot = |g: &GuideId| {
            self.scene.guides[g.0].on == l && self.scene.guides[g.0].rolling.is_none()
        };
        let g = (0..self.scene.guides.len()).map(GuideId).find(slot)?;
        let (from, (runner, along)) = (self.point(pivot)?, self.runner(g)?);
        (from.distance(runner) > super::SAME_MM
            && (runner - from).cross(along).abs() < super::SAME_MM)
            .then_some((from, runner))
    }

    /// For a block that turns about its joint: the joint, and an end of the block.
    fn turned_block(&self, l: LinkId) -> Option<(Point, Point)> {
        let [joint] = self.scene.links[l.0].points[..] else { return None };
        let own = |g: &GuideId| {
            self.scene.guides[g.0].slider == Some(l) && self.scene.guides[g.0].pin == Some(joint)
        };
        let (at, along) =
            (0..self.scene.guides.len()).map(GuideId).find(own).and_then(|g| self.runner(g))?;
        Some((at, at + along * self.style.block_length_mm))
    }

    pub(super) fn arc_label(
        &mut self,
        called: Called,
        centre: Point,
        radius: f64,
        angles: [f64; 2],
        owner: u32,
    ) {
        let request = self.arc_request(called.symbol, centre, radius, angles);
        self.d.label(
            called.id,
            &format!("driver {}", called.class),
            request.owned(owner).read_as(Reads::Quantity),
        );
    }

    pub(super) fn arc_request(
        &self,
        symbol: &str,
        centre: Point,
        radius: f64,
        angles: [f64; 2],
    ) -> LabelRequest {
        LabelRequest::along_arc(
            Label::math(symbol),
            self.style.label_mm,
            centre,
            radius,
            angles,
            self.style.vector.width_mm / 2.0,
        )
    }

    /// The joint of two links.
    fn shared(&self, a: LinkId, b: LinkId) -> Option<Point> {
        self.scene.links[a.0]
            .points
            .iter()
            .find(|p| self.scene.links[b.0].points.contains(p))
            .and_then(|p| self.point(*p))
    }

    fn sliding(&mut self, g: GuideId, driver: &Driver) {
        let Some((at, tangent)) = self.runner(g) else { return };
        let guide = &self.scene.guides[g.0];
        let name = match (guide.pin, guide.slider) {
            (Some(p), _) => self.scene.point_name(p).to_owned(),
            (None, Some(s)) => self.scene.link_name(s).to_owned(),
            (None, None) => return,
        };
        // Above the block, because the hatching is below.
        let normal = if tangent.perp().y >= 0.0 { tangent.perp() } else { -tangent.perp() };
        let (who, name) = (name.clone(), name_label(&name));
        let link = |l: LinkId| name_label(self.scene.link_name(l));
        // In a guide that moves, the driver gives the motion relative to the guide.
        let symbol = |quantity: &str| match (guide.on == self.scene.ground, guide.pin) {
            (true, _) => format!("{quantity}_{{{name}}}"),
            (false, Some(_)) => {
                let (own, on, sliding) = (
                    guide.slider.map(link).unwrap_or_default(),
                    link(guide.on),
                    &self.notation.sliding,
                );
                format!("{quantity}^{{{sliding}}}_{{{name}{own}{name}{on}}}")
            }
            (false, None) => format!("{quantity}_{{{name}/{}}}", link(guide.on)),
        };
        let symbols = ["v", "a"].map(symbol);
        let ahead = if driver.rate.value < 0.0 { -tangent } else { tangent };
        let from = match guide.pin {
            // Beyond the end of a slot with hatching on both sides.
            Some(p) if self.in_fixed_slot(p) => {
                let [back, on] = self.travel(g);
                let goes = if driver.rate.value >= 0.0 { on } else { -back };
                at + ahead * (goes + super::slides::GUIDE_MM / 2.0 + ARROW_OFF_MM)
            }
            _ => at + normal * (self.style.block_width_mm / 2.0 + ARROW_OFF_MM),
        };
        self.translations(driver, &symbols, Slides { from, along: tangent, outward: normal, who });
    }

    fn stretching(&mut self, a: PointId, b: PointId, driver: &Driver) {
        let (Some(base), Some(tip)) = (self.point(a), self.point(b)) else { return };
        let Some(u) = (tip - base).unit() else { return };
        let (na, nb) = (name_label(self.scene.point_name(a)), name_label(self.scene.point_name(b)));
        // Beside the rod; the arrow points in the direction of the rod's motion.
        let rod = base + (tip - base) * 0.75 + u.perp() * ARROW_OFF_MM;
        let from = if driver.rate.value >= 0.0 {
            rod - u * (ARROW_MM / 2.0)
        } else {
            rod + u * (ARROW_MM / 2.0)
        };
        let symbols = ["v", "a"].map(|q| format!("{q}^{{{}}}_{{{nb}{na}}}", self.notation.sliding));
        let who = format!("{}-{}", self.scene.point_name(b), self.scene.point_name(a));
        self.translations(driver, &symbols, Slides { from, along: u, outward: u.perp(), who });
    }
}
