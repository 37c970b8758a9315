//! Places the numbers of links and the letters of points.

use hodograph_base::geom::{Point, Vec2};
use hodograph_board::plan::names::{name_label, point_label};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::{LabelRequest, Reads, free_places, roomiest};
use hodograph_scene::PointId;

use super::MechanismDraft;

/// The place for the number of a block, a yoke or a cylinder's part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum NumberPlace {
    /// Along a rod.
    Along(Point, Point, u32),
    /// Around a block with this middle, preferably on this side.
    Around(Point, Option<Vec2>),
    /// Beside something with this half width.
    Wide(Point, Point, f64, u32),
}

/// The ground's number is at the right end of the hatching, unless the left end is farther from all
/// arrows by more than this.
const NO_NEARER_MM: f64 = 2.0;
/// Position of a plate's number from its middle towards a corner, as a part of that distance.
const NEAR_CORNER: f64 = 0.4;
/// Directions with a resultant below this leave no preferred side.
const NO_SIDE: f64 = 0.2;

impl MechanismDraft<'_> {
    /// Places link numbers: beside the longest bar, inside a plate, beside a block; the ground's
    /// number beside a support.
    pub(super) fn numbers(&mut self) {
        for l in 0..self.scene.links.len() {
            let name = self.scene.links[l].name.clone();
            let id = format!("number-{name}");
            self.d.of_link((l != self.scene.ground.0).then_some(l));
            if l == self.scene.ground.0 {
                if self.shows(self.scene.ground) {
                    self.ground_number(&id, &name);
                }
                continue;
            }
            let half = self.style.link.width_mm / 2.0;
            // Nearly as far as the corners: along a side the number is a little off.
            let block =
                0.9 * libm::hypot(self.style.block_width_mm, self.style.block_length_mm) / 2.0;
            match self.number_at[l] {
                Some(NumberPlace::Along(a, b, owner)) => {
                    self.number(&id, &name, (a, b), half, owner)
                }
                Some(NumberPlace::Around(at, side)) => {
                    let request = LabelRequest::at_point(
                        Label::math(name_label(&name)),
                        self.style.label_mm,
                        at,
                        block,
                    );
                    self.d.label(
                        &id,
                        "number",
                        LabelRequest { prefer: side, reads: Reads::Number, ..request },
                    );
                }
                Some(NumberPlace::Wide(a, b, wide, owner)) => {
                    self.number(&id, &name, (a, b), wide + half, owner)
                }
                None => {
                    let Some(form) = &self.forms[l] else { continue };
                    if form.plate.is_empty() {
                        let length = |s: &(Point, Point)| s.0.distance(s.1);
                        let longest = self
                            .pieces(l)
                            .into_iter()
                            .max_by(|a, b| length(a).total_cmp(&length(b)));
                        if let Some(s) = longest {
                            // The link's own lines may be near, unlike those of any other link.
                            self.number(&id, &name, s, half, 0);
                        }
                    } else {
                        let n = form.plate.len() as f64;
                        let middle = form
                            .plate
                            .iter()
                            .fold(Point::ORIGIN, |m, p| m + p.to_vec2() * (1.0 / n));
                        // In the middle, or nearer to a corner.
                        let places = form
                            .plate
                            .iter()
                            .map(|corner| middle + (*corner - middle) * NEAR_CORNER);
                        let label = Label::math(name_label(&name));
                        let request = |at: Point| {
                            LabelRequest::at_point(label.clone(), self.style.label_mm, at, 0.0)
                        };
                        let requests: Vec<LabelRequest> =
                            std::iter::once(middle).chain(places).map(request).collect();
                        self.label_with_space(&id, requests);
                    }
                }
            }
        }
        self.d.of_link(None);
    }

    fn number(&mut self, id: &str, name: &str, ends: (Point, Point), clear_mm: f64, owner: u32) {
        let request = LabelRequest::along(
            Label::math(name_label(name)),
            self.style.label_mm,
            ends.0,
            ends.1,
            clear_mm,
        );
        self.d.label(id, "number", request.owned(owner).read_as(Reads::Number));
    }

    /// The bars of a link between its neighbouring points.
    fn pieces(&self, l: usize) -> Vec<(Point, Point)> {
        let Some(form) = &self.forms[l] else { return Vec::new() };
        let points: Vec<Point> =
            self.scene.links[l].points.iter().filter_map(|p| self.point(*p)).collect();
        let runners = (0..self.scene.guides.len())
            .filter(|g| self.scene.guides[*g].on.0 == l)
            .filter_map(|g| self.runner(hodograph_scene::GuideId(g)));
        let stops: Vec<Point> = points.into_iter().chain(runners.map(|(at, _)| at)).collect();
        let mut out = Vec::new();
        for (a, b) in form.segments() {
            let mut on: Vec<Point> = stops
                .iter()
                .copied()
                .filter(|p| super::form::on_segment(*p, a, b, super::SAME_MM))
                .collect();
            on.extend([a, b]);
            on.sort_by(|p, q| a.distance(*p).total_cmp(&a.distance(*q)));
            out.extend(on.windows(2).map(|w| (w[0], w[1])));
        }
        out
    }

    fn ground_number(&mut self, id: &str, name: &str) {
        let all: Vec<Point> =
            (0..self.scene.points.len()).filter_map(|p| self.point(PointId(p))).collect();
        let alone = |p: Point| {
            all.iter()
                .map(|q| p.distance(*q))
                .filter(|d| *d > super::SAME_MM)
                .fold(f64::INFINITY, f64::min)
        };
        let driven =
            |p: Point| self.turned_at.iter().any(|(centre, _)| centre.distance(p) < super::SAME_MM);
        // A support without arrows, the one with the most space around it; the first among equals.
        let pivots = (0..self.scene.points.len()).map(PointId).filter(|p| self.is_fixed_pivot(*p));
        let mut places: Vec<(Point, Vec2)> =
            pivots.filter_map(|p| Some((self.point(p)?, self.support_side(p)))).collect();
        places.sort_by(|(a, _), (b, _)| {
            driven(*a).cmp(&driven(*b)).then(alone(*b).total_cmp(&alone(*a)))
        });
        let beside: Vec<(Point, Vec2)> =
            places.into_iter().flat_map(|(at, down)| self.beside_hatching(at, down)).collect();
        // The hatching identifies the ground: if there is no clear place, the number is left out.
        let number = |end: Point, clear_mm: f64, out: Vec2| {
            LabelRequest::at_point(
                Label::math(name_label(name)),
                self.style.label_mm,
                end,
                clear_mm,
            )
            .towards(out)
            .optional(true)
        };
        let request = |(end, out): (Point, Vec2)| number(end, self.style.hatch_depth_mm / 2.0, out);
        if !beside.is_empty() {
            self.label_with_space(id, beside.into_iter().map(request).collect());
        } else {
            let guide = (0..self.scene.guides.len())
                .filter(|g| self.scene.guides[*g].on == self.scene.ground);
            let at = guide.filter_map(|g| self.runner(hodograph_scene::GuideId(g))).next();
            if let Some((at, u)) = at {
                let below = if u.perp().y <= 0.0 { u.perp() } else { -u.perp() };
                let end = at
                    + u * 13.0
                    + below * (self.style.block_width_mm / 2.0 + self.style.hatch_depth_mm / 2.0);
                self.d.label(id, "number", number(end, 1.0, u));
            }
        }
    }

    /// Requests a number at the first of these places with enough space, or else at the one with
    /// the most space.
    fn label_with_space(&mut self, id: &str, requests: Vec<LabelRequest>) {
        if let Some(request) = roomiest(requests, |r| free_places(&r, self.d.obstacles())) {
            self.d.label(id, "number", request.read_as(Reads::Number));
        }
    }

    /// The ends of a support's hatching and the middle below it, each with its outward direction.
    /// The end farther from the arrows comes first, because a number behind the name of an angular
    /// velocity would be read as a factor.
    fn beside_hatching(&self, at: Point, down: Vec2) -> [(Point, Vec2); 3] {
        let foot = at + down * (self.style.pivot_height_mm + self.style.hatch_depth_mm / 2.0);
        let end = |side: f64| {
            (foot + down.perp() * (side * self.style.ground_half_mm), down.perp() * side)
        };
        let free = |p: Point| {
            self.turned_at.iter().map(|(_, arrow)| p.distance(*arrow)).fold(f64::INFINITY, f64::min)
        };
        let [right, left] = [end(1.0), end(-1.0)];
        if free(left.0) > free(right.0) + NO_NEARER_MM {
            [left, right, (foot, down)]
        } else {
            [right, left, (foot, down)]
        }
    }

    /// Places the letters of points, away from the links that meet there.
    pub(super) fn letters(&mut self) {
        for p in (0..self.scene.points.len()).map(PointId) {
            let Some(at) = self.point(p).filter(|_| self.shows_point(p)) else { continue };
            let shown = self.is_fixed_pivot(p)
                || self.is_pin(p)
                || self.is_reference(p)
                || self.scene.rolling.iter().any(|r| r.at.contains(&p))
                || self.scene.carriers(p).any(|l| self.forms[l.0].is_some());
            if !shown {
                continue;
            }
            let clear = if self.in_cross(p) {
                super::crosses::ARM_MM
            } else if self.block_at(p).is_some() {
                self.style.block_width_mm / 2.0
            } else if self.in_fixed_slot(p) {
                self.style.slot_width_mm / 2.0 + self.style.hatch_depth_mm
            } else if self.is_pin(p) {
                self.style.pin_radius_mm + self.style.outline.width_mm / 2.0
            } else {
                self.style.dot_radius_mm
            };
            let mut away = self.leaving(p).into_iter().fold(Vec2::ZERO, |s, u| s - u);
            if self.is_fixed_pivot(p) {
                away = away - self.support_side(p);
            }
            if let Some(side) = self.block_at(p).and_then(|g| self.hatched[g.0]) {
                away = away - side;
            }
            let prefer = away.unit().filter(|_| away.norm() > NO_SIDE);
            let name = self.scene.point_name(p).to_owned();
            self.d.label_at(&name, "point", &point_label(&name), at, clear, prefer);
        }
    }
}
