//! Draws the given radii of cams, rollers and wheels as dimensions: a thin line from the centre with
//! its arrowhead at the circle, and the number R on it or beyond it.
//!
//! This module chooses the direction of each radius: the first in which its number covers no line
//! and its line crosses least. The number may be on the body itself.

use std::f64::consts::TAU;

use hodograph_base::cam::CamMotion;
use hodograph_base::geom::{Point, Vec2};
use hodograph_paper::paper::extent::turned_corners;
use hodograph_paper::paper::item::{Dash, FigureItem, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::Obstacles;

use super::MechanismDraft;
use super::dimensions::{AIR_MM, CROSSED_COST, PlacedDimension, turned};

/// Number of directions, and the angle of the first one: to the lower right, where mechanisms have
/// few lines.
const DIRECTIONS: usize = 24;
const FIRST_RAD: f64 = -0.7;
/// Cost of the next direction: the first free one is taken.
const TURN_COST: f64 = 0.1;
/// Distance from a circle to the number outside it.
const CLEAR_MM: f64 = 2.0;
/// A smaller circle has no space for an arrowhead.
const LEAST_MM: f64 = 2.0;

/// The radius of a circle: its centre on paper, its length (mm), its name, and its number.
struct GivenRadius {
    centre: Point,
    radius_mm: f64,
    name: String,
    text: String,
}

impl MechanismDraft<'_> {
    /// Draws all radii, and the base circles to which some of them belong.
    pub(super) fn radii(&mut self) {
        for radius in self.given_radii() {
            if radius.radius_mm < LEAST_MM {
                continue;
            }
            let label = Label::math(&radius.text).in_fonts(&self.style.fonts);
            let Some(placed) = self.place_radius(&radius, &label) else { continue };
            self.d.draw(&radius.name, "", placed.lines);
            self.d.draw(&format!("{}-number", radius.name), "dimension", vec![placed.number]);
        }
    }

    fn given_radii(&mut self) -> Vec<GivenRadius> {
        let scene = self.scene;
        let mut out = Vec::new();
        let mut add = |centre: Option<Point>, radius_mm: f64, name: String, number: String| {
            let text = format!("R{number}");
            out.extend(centre.map(|centre| GivenRadius { centre, radius_mm, name, text }));
        };
        for (k, c) in scene.cams.iter().enumerate() {
            let of_law = c.disc.as_ref().and_then(|turning| match turning.disc.motion {
                CamMotion::Law { base, .. } => Some((turning.pivot, base)),
                CamMotion::Profile(_) => None,
            });
            if let Some((pivot, base)) = of_law
                && let Some(centre) = self.point(pivot)
            {
                let shape = Shape::Arc {
                    centre,
                    radius_mm: self.mm(base),
                    from_rad: 0.0,
                    to_rad: TAU,
                    stroke: self.style.thin.dashed(Dash::DashDot),
                };
                self.d.shape(&format!("base-circle-{k}"), "centre", shape);
            }
            if let Some((centre, r)) = c.circle.or(of_law) {
                let name = format!("dimension-cam-{k}");
                add(self.point(centre), self.mm(r), name, self.length_of("", r));
            }
            if let Some(r) = c.follows.radius() {
                let (at, name) = (self.point(c.follows.point()), format!("dimension-end-{k}"));
                add(at, self.mm(r), name, self.length_of(c.end.as_deref().unwrap_or(""), r));
            }
        }
        for (k, pair) in scene.rolling.iter().enumerate() {
            if pair.flanks.is_some() || pair.teeth().is_some() {
                continue;
            }
            let mut contours = pair.contours.clone();
            let given = contours.radii_mut();
            // A track has no radius: the only one is that of its wheel, which comes second.
            for (i, r) in (2 - given.len().min(2)..2).zip(given) {
                let link = scene.link_name(pair.links[i]);
                let centre = pair.centres()[i].and_then(|p| self.point(p));
                let name = format!("dimension-wheel-{k}-{link}");
                add(centre, self.mm(r.value), name, self.length_of(&r.text, r.value));
            }
        }
        // A wheel of several pairs has one radius.
        let mut once: Vec<GivenRadius> = Vec::new();
        for one in out {
            let is_same = |o: &GivenRadius| {
                o.centre.distance(one.centre) < super::SAME_MM
                    && (o.radius_mm - one.radius_mm).abs() < super::SAME_MM
            };
            if !once.iter().any(is_same) {
                once.push(one);
            }
        }
        once
    }

    fn place_radius(&self, radius: &GivenRadius, label: &Label) -> Option<PlacedDimension> {
        let level = turned_corners(Point::ORIGIN, 0.0, label, self.style.small_mm)?;
        let (centre, stroke) = (radius.centre, self.style.thin);
        let mut best: Option<(f64, PlacedDimension)> = None;
        for k in 0..DIRECTIONS {
            let u = Vec2::from_angle(FIRST_RAD + TAU * k as f64 / DIRECTIONS as f64);
            let tip = centre + u * radius.radius_mm;
            // The line begins beside the joint at the centre.
            let from = centre + u * self.style.pin_radius_mm.min(radius.radius_mm / 2.0);
            let out = tip + u * CLEAR_MM;
            let inside = self.spots((from, tip), &level).into_iter().filter(|s| s.beyond.is_none());
            let beyond = self.spots((from, out), &level);
            let beyond = beyond.into_iter().filter(|s| s.beyond.is_some_and(|b| b[0] == out));
            for spot in inside.chain(beyond) {
                let ink = Obstacles::of_turned(turned(&level, &spot));
                if self.d.met(&ink, AIR_MM) > 0 {
                    continue;
                }
                let arrow = Shape::Arrow { from, to: tip, stroke, head: self.style.thin_head };
                let beyond = |[_, to]: [Point; 2]| Shape::Line { from: tip, to, stroke };
                let lines: Vec<FigureItem> = [Some(arrow), spot.beyond.map(beyond)]
                    .into_iter()
                    .flatten()
                    .map(|shape| FigureItem::new("dimension", shape))
                    .collect();
                let crossed = self.d.met_by(&lines, 0.0) as f64;
                let cost = CROSSED_COST * crossed + TURN_COST * k as f64 + spot.cost;
                if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                    let number = self.written(&spot, label);
                    best = Some((cost, PlacedDimension { lines, number }));
                }
            }
        }
        best.map(|(_, placed)| placed)
    }
}
