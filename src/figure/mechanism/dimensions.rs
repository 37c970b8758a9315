//! The given lengths as dimensions (GB/T 4458.4, ISO 129-1): numbers stand along their lines, to be read from below or from the right, and
//! on no body.
//!
//! Decided here: on which side of its points and how far off each dimension stands: the first place where its number covers nothing and
//! its lines cross least. A dimension without such a place is not drawn; the list of given values names it instead.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::digits::{inked, shortest};
use crate::figure::drawing::id;
use crate::figure::extent::turned_corners;
use crate::figure::item::{Colour, Item, Shape};
use crate::figure::label::Label;
use crate::figure::place::Obstacles;
use crate::figure::symbols as sym;
use crate::geom::{Point, Vec2};
use crate::scene::{Contours, Given, GuidePath, Kind, Place, PointId, Scene, Through, Told};

use super::{Draft, form};

/// The nearest dimension line, clear of the joints' letters, and the distance of the next ones.
const FIRST_MM: f64 = 9.0;
const NEXT_MM: f64 = 5.0;
const LEVELS: i32 = 9;
/// From the dimension line up to its number.
const GAP_MM: f64 = 0.8;
/// Air around a number.
const AIR_MM: f64 = 0.7;
/// What speaks against a place: to cross a line with the dimension line or an extension line, to lead the dimension line over a body, to be one step farther off, to be on the side
/// of the mechanism's middle, to have the number away from the middle of its line or beyond its end.
const CROSSED_COST: f64 = 3.0;
const OVER_COST: f64 = 5.0;
const FAR_COST: f64 = 1.0;
const INSIDE_COST: f64 = 2.5;
const ASIDE_COST: f64 = 0.8;
const BEYOND_COST: f64 = 2.0;
/// Where along its line a number may stand, as parts of it; then beyond either end.
const STATIONS: [f64; 5] = [0.5, 0.35, 0.65, 0.22, 0.78];

/// The name of the dimension of two points.
pub fn name_of(scene: &Scene, a: PointId, b: PointId) -> String {
    format!("dimension-{}{}", scene.point_name(a), scene.point_name(b))
}

/// The name that the line of a dimension has in a drawing.
pub fn id_of(scene: &Scene, a: PointId, b: PointId) -> String {
    id("mechanism", &name_of(scene, a, b))
}

/// A dimension in a place.
struct Placed {
    lines: Vec<Item>,
    number: Item,
}

/// What no number stands on.
struct Bodies {
    areas: Vec<Vec<Point>>,
    discs: Vec<(Point, f64)>,
}

impl Bodies {
    fn cover(&self, p: Point) -> bool {
        self.areas.iter().any(|a| form::inside(p, a)) || self.discs.iter().any(|(c, r)| c.distance(p) < *r)
    }
}

impl Draft<'_> {
    /// All dimensions.
    pub(super) fn dimensions(&mut self) {
        let places: Vec<Point> = (0..self.scene.points.len()).filter_map(|p| self.point(PointId(p))).collect();
        let middle = places.iter().fold(Point::ORIGIN, |m, p| m + p.to_vec2() * (1.0 / places.len().max(1) as f64));
        let bodies = self.bodies();
        // The longest come last, as they stand farthest out.
        let mut wanted: Vec<(Point, Point, String, String)> = Vec::new();
        let of_cam = |p: PointId| self.scene.cams.iter().any(|c| c.span == self.scene.points[p.0].span);
        for length in self.scene.lengths.iter().filter(|l| !of_cam(l.a) && !of_cam(l.b)) {
            let (Some(a), Some(b)) = (self.point(length.a), self.point(length.b)) else { continue };
            wanted.push((a, b, name_of(self.scene, length.a, length.b), self.dimension(&length.value)));
        }
        for p in (0..self.scene.points.len()).map(PointId) {
            let Some(at) = self.point(p) else { continue };
            match &self.scene.points[p.0].place {
                Place::InLink { base: (a, b), xy: [x, y] } => {
                    let (Some(a), Some(b)) = (self.point(*a), self.point(*b)) else { continue };
                    let Some(u) = (b - a).unit() else { continue };
                    let foot = a + u * (at - a).dot(u);
                    let name = self.scene.point_name(p);
                    let mut add = |from: Point, to: Point, axis: &str, given: &Given| {
                        if from.distance(to) > super::SAME_MM {
                            wanted.push((
                                from,
                                to,
                                format!("dimension-{axis}-{name}"),
                                self.dimension(given).trim_start_matches('−').to_owned(),
                            ));
                        }
                    };
                    add(a, foot, "x", x);
                    add(foot, at, "y", y);
                }
                Place::Polar { base: (a, _), length, .. } => {
                    let Some(from) = self.point(*a) else { continue };
                    wanted.push((from, at, name_of(self.scene, *a, p), self.dimension(length)));
                }
                Place::At(_) | Place::Unknown => {}
            }
        }
        wanted.extend(self.offsets());
        wanted.sort_by(|a, b| a.0.distance(a.1).total_cmp(&b.0.distance(b.1)));
        for (a, b, name, text) in wanted {
            let label = Label::math(text).in_fonts(&self.style.fonts);
            let Some(placed) = self.place_dimension(a, b, &label, middle, &bodies) else { continue };
            self.d.draw(&name, "", placed.lines);
            self.d.draw(&format!("{name}-number"), "dimension", vec![placed.number]);
        }
    }

    /// The offsets of guides, from the point that the guide would pass through without.
    fn offsets(&self) -> Vec<(Point, Point, String, String)> {
        let mut out = Vec::new();
        for (g, guide) in self.scene.guides.iter().enumerate().filter(|(_, g)| g.rolling.is_none()) {
            let GuidePath::Line { through, offset: Some(offset), .. } = &guide.path else { continue };
            let from = match through {
                Through::Point(p) => self.point(*p),
                Through::At([x, y]) => Some(self.paper(Point::new(x.value, y.value))),
                Through::Pin => None,
            };
            let (Some(from), Some(crate::position::Path::Line { through, direction })) = (from, self.guide(crate::scene::GuideId(g)))
            else {
                continue;
            };
            let foot = through + direction * (from - through).dot(direction);
            if from.distance(foot) > super::SAME_MM {
                let number = self.dimension(offset).trim_start_matches('−').to_owned();
                out.push((from, foot, format!("dimension-offset-{g}"), number));
            }
        }
        out
    }

    /// Plates, wheels and cams.
    fn bodies(&self) -> Bodies {
        let areas = self.forms.iter().flatten().filter(|f| !f.plate.is_empty()).map(|f| f.plate.clone()).collect();
        let mut discs = Vec::new();
        for pair in &self.scene.rolling {
            let hollow = match pair.contours {
                Contours::Circles { hollow, .. } => hollow,
                Contours::Track { .. } | Contours::Belt { .. } => None,
            };
            let round = |i: usize| {
                let centre = self.point(pair.centres()[i]?)?;
                Some((centre, centre.distance(self.point(pair.at[i])?)))
            };
            discs.extend([0, 1].into_iter().filter(|i| hollow != Some(*i)).filter_map(round));
        }
        for c in &self.scene.cams {
            if let Some((centre, radius)) = c.circle
                && let Some(centre) = self.point(centre)
            {
                discs.push((centre, self.mm(radius)));
            }
        }
        Bodies { areas, discs }
    }

    fn place_dimension(&self, a: Point, b: Point, label: &Label, middle: Point, bodies: &Bodies) -> Option<Placed> {
        let along = (b - a).unit()?;
        let inside = along.cross(middle - a).signum();
        let mut best: Option<(f64, Placed)> = None;
        for level in 0..LEVELS {
            for side in [-inside, inside] {
                let side = if side == 0.0 { 1.0 } else { side };
                let offset = side * (FIRST_MM + NEXT_MM * f64::from(level));
                let base = FAR_COST * f64::from(level) + if side == inside { INSIDE_COST } else { 0.0 };
                if best.as_ref().is_some_and(|(cost, _)| *cost <= base) {
                    continue;
                }
                let (p, q) = sym::dimension_line(a, b, offset);
                let lines = sym::dimension(self.style, a, b, offset);
                let crossed = CROSSED_COST * self.d.met_by(&lines[2..], AIR_MM) as f64 + self.d.met_by(&lines[..2], 0.1) as f64;
                let over = (1..8).any(|k| bodies.cover(p + (q - p) * (f64::from(k) / 8.0)));
                let crossed = crossed + if over { OVER_COST } else { 0.0 };
                for (number, extra, beyond) in self.numbers_of(p, q, label) {
                    let cost = base + crossed + extra;
                    if best.as_ref().is_some_and(|(c, _)| *c <= cost) || !self.is_free(&number, bodies) {
                        continue;
                    }
                    let mut lines = lines.clone();
                    lines.extend(beyond);
                    best = Some((cost, Placed { lines, number }));
                }
            }
        }
        best.map(|(_, placed)| placed)
    }

    /// The places of a number along its line, what speaks against each, and the line that goes on under it where it stands beyond an end.
    fn numbers_of(&self, p: Point, q: Point, label: &Label) -> Vec<(Item, f64, Option<Item>)> {
        let (style, length) = (self.style, p.distance(q));
        let Some(along) = (q - p).unit() else { return Vec::new() };
        // Read from below, or from the right.
        let mut angle = along.angle();
        if angle > FRAC_PI_2 + 1e-6 {
            angle -= PI;
        } else if angle <= -FRAC_PI_2 + 1e-6 {
            angle += PI;
        }
        let up = Vec2::from_angle(angle).perp();
        let Some([c0, c1, _, _]) = turned_corners(Point::ORIGIN, 0.0, label, style.small_mm) else { return Vec::new() };
        let (wide, below) = (c1.x - c0.x, -c0.y);
        let number = |at: Point| {
            let shape = Shape::Turned {
                at: at + up * (GAP_MM + below.max(0.0)),
                angle_rad: angle,
                label: label.clone(),
                size_mm: style.small_mm,
                colour: Colour::BLACK,
            };
            Item::new("", shape)
        };
        let heads = 2.0 * style.thin_head.length_mm;
        let mut out = Vec::new();
        for (k, part) in STATIONS.into_iter().enumerate() {
            if part.min(1.0 - part) * length >= wide / 2.0 + if k == 0 { 0.0 } else { heads / 2.0 } && length >= wide + 1.0 {
                out.push((number(p + along * (part * length)), ASIDE_COST * k as f64, None));
            }
        }
        for (end, out_of) in [(q, along), (p, -along)] {
            let to = end + out_of * (wide + 2.0);
            let line = Item::new("dimension", Shape::Line { from: end, to, stroke: style.thin });
            out.push((number(end + out_of * (wide / 2.0 + 1.2)), BEYOND_COST, Some(line)));
        }
        out
    }

    /// Whether a number stands on nothing.
    fn is_free(&self, number: &Item, bodies: &Bodies) -> bool {
        let Shape::Turned { at, angle_rad, label, size_mm, .. } = &number.shape else { return false };
        let Some([a, b, c, d]) = turned_corners(*at, *angle_rad, label, *size_mm) else { return false };
        let part = |p: Point, q: Point, t: f64| p + (q - p) * t;
        let grid = (0..=4).flat_map(|i| [0.0, 0.5, 1.0].map(|j| part(part(a, b, f64::from(i) / 4.0), part(d, c, f64::from(i) / 4.0), j)));
        !grid.into_iter().any(|p| bodies.cover(p)) && self.d.met(&Obstacles::of(std::slice::from_ref(number)), AIR_MM) == 0
    }

    /// A given length at its dimension line: millimetres to the micrometre without their name, all else with its unit.
    fn dimension(&self, given: &Given) -> String {
        let number = |value: f64| inked(&shortest((value * 1e3).round() / 1e3));
        match self.scene.told(Kind::Length, &given.text, given.value) {
            Told::AsWritten(number, unit) if unit.name() != "mm" => unit.label(&inked(&number)),
            Told::Computed(value, unit) if unit.name() != "mm" => unit.label(&number(value)),
            Told::AsWritten(..) | Told::Computed(..) | Told::Usual => shortest((given.value * 1e6).round() / 1e3),
        }
    }
}
