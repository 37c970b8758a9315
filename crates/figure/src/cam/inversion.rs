//! Constructs the profile by inversion 反转法: the cam is fixed and the follower goes round it in
//! the opposite sense, in twelve numbered stations.

use super::{CamDrawing, heading};
use hodograph_base::cam::{CamMotion, CamStation, Disc, Follower, FollowerTip, PieceSide, round};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::tr;
use hodograph_board::construct::scale::choose_in;
use hodograph_paper::paper::drawing::DrawingPart;
use hodograph_paper::paper::item::{Colour, Dash, Figure, LineStroke, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::{Bar, LabelRequest, Obstacles};
use hodograph_paper::paper::style::Style;
use hodograph_report::cam::Report;
use hodograph_scene::{Kind, Lang};
use std::f64::consts::TAU;

/// Stations in a full turn.
pub(super) const STATIONS: usize = 12;
/// Approximate length of the drawing's larger side (mm).
const SIZE_MM: f64 = 165.0;
/// Length of the larger side of a drawing that is shown alone (mm).
const ALONE_MM: f64 = 100.0;
/// Points of each curve: one for each half degree.
const STEPS: usize = 720;

/// Distance from the drawing to the arrow of the sense outside it (mm): leaves space for a number.
const ARROW_MM: f64 = 9.0;
/// Length of the sides of the pressure angle.
const ANGLE_MM: f64 = 24.0;
/// Extra angle on either side of the arrow within which it keeps clear of the drawing (rad).
const ARROW_AIR: f64 = 0.12;
/// Sample points on each line.
const SAMPLES: usize = 32;

/// The profile with its steps from `first` on: the stations, a pitch curve if the follower rolls,
/// the profile, the pressure angle where it is greatest, and the least radius of curvature; and the
/// scale (m/mm).
pub(super) fn stepped(report: &Report, style: &Style, first: usize) -> (DrawingPart, f64) {
    let (mut d, mu) = drawn(report, style, Some(first));
    d.pressure();
    d.curvature();
    (DrawingPart::of(d.labelled().0), mu)
}

/// True if the follower ends in a roller.
pub(super) fn rolls(disc: &Disc) -> bool {
    matches!(disc.touch, FollowerTip::Point { radius } if radius > 0.0)
}

/// The profile about the cam's centre without its labels, in steps if a first step is given, and its
/// scale (m/mm).
fn drawn<'a>(report: &'a Report, style: &'a Style, first: Option<usize>) -> (CamDrawing<'a>, f64) {
    let disc = &report.turning.disc;
    let reach = reach(disc);
    let unit =
        report.scene.book.chosen(Kind::Length).map_or(1.0, hodograph_scene::book::BookUnit::size);
    let size_mm = if first.is_some() { ALONE_MM } else { SIZE_MM };
    let mu = choose_in(unit, [2.0 * reach; 2], [size_mm; 2]);
    let mut d = CamDrawing::new(report, style, mu);
    if let Some(first) = first {
        d = d.in_steps(first);
    }
    d.circles();
    d.curves();
    d.stations();
    d.turning();
    (d, mu)
}

/// Draws the figure.
pub fn figure(report: &Report, style: &Style, lang: Lang) -> Figure {
    let (d, mu) = drawn(report, style, None);
    let title = heading(report.scene, tr!(lang, "profile by inversion"), lang);
    d.finish(mu, title, &legend(&report.turning.disc, lang), lang)
}

/// Radius (m) of the circle of the roller's centre on the base circle; `None` without a roller or
/// where the profile does not come from a law of motion.
fn prime_m(disc: &Disc) -> Option<f64> {
    let radius = if let FollowerTip::Point { radius } = disc.touch { radius } else { 0.0 };
    (radius > 0.0 && matches!(disc.motion, CamMotion::Law { .. })).then(|| disc.base() + radius)
}

/// The legend of the line types that this cam has.
fn legend(disc: &Disc, lang: Lang) -> String {
    let rolling = rolls(disc);
    let offset = matches!(disc.follower, Follower::Translating { offset, .. } if offset != 0.0);
    let swinging = matches!(disc.follower, Follower::Oscillating { .. });
    let mut dashed = Vec::new();
    dashed.extend(prime_m(disc).map(|_| tr!(lang, "prime circle")));
    dashed.extend(swinging.then(|| tr!(lang, "circle of the pivots")));
    let (thick, between) = (
        if rolling {
            tr!(lang, "thick: profile")
        } else {
            tr!(lang, "inversion" => "thick: profile")
        },
        tr!(lang, "clause" => "; "),
    );
    let mut parts = vec![thick.to_owned()];
    parts.extend(rolling.then(|| tr!(lang, "chain line: pitch curve").to_owned()));
    let thin = match offset {
        true => tr!(lang, "thin: stations of the follower, base and offset circles"),
        false => tr!(lang, "thin: stations of the follower, base circle"),
    };
    parts.push(thin.to_owned());
    if !dashed.is_empty() {
        parts.push(format!("{}{}", tr!(lang, "dashed: "), dashed.join(lang.comma())));
    }
    parts.join(between)
}

/// The largest distance from the cam's centre to anything drawn (m).
fn reach(disc: &Disc) -> f64 {
    let stations =
        round(disc, STEPS / 4).into_iter().filter_map(|(phi, side)| disc.station(phi, side));
    let end = match disc.touch {
        FollowerTip::Point { radius } => radius,
        FollowerTip::Flat { .. } => 0.0,
    };
    let far =
        stations.map(|s| s.pitch.norm().max(s.contact.norm()) + end).fold(disc.base(), f64::max);
    match disc.follower {
        Follower::Translating { .. } => far * 1.06,
        Follower::Oscillating { pivot, .. } => far.max(pivot.norm() * 1.06),
    }
}

impl CamDrawing<'_> {
    fn circle(&mut self, class: &str, radius: f64, stroke: LineStroke) {
        let radius_mm = radius * self.scale;
        // A circle smaller than a dot is not drawn.
        if radius_mm > 0.5 {
            self.draw(
                class,
                Shape::Circle {
                    centre: Point::ORIGIN,
                    radius_mm,
                    stroke: Some(stroke),
                    fill: None,
                },
                None,
            );
        }
    }

    /// Numbers a station.
    fn number(&mut self, name: &str, at: Point, clear_mm: f64, towards: Vec2) {
        if !name.is_empty() {
            self.label(name, at, clear_mm, towards);
        }
    }

    /// Draws profile and pitch curve.
    fn curves(&mut self) {
        let disc = self.disc().clone();
        let link = Some(self.report.cam.cam.0);
        let points: Vec<Point> = disc.outline(STEPS).into_iter().map(|p| self.at(p)).collect();
        let stroke = self.style.link;
        self.begin(STATIONS + usize::from(rolls(&disc)));
        self.draw(
            "profile",
            Shape::Polyline { points, closed: true, stroke: Some(stroke), fill: None },
            link,
        );
        if let FollowerTip::Point { radius } = disc.touch
            && radius > 0.0
        {
            let all =
                round(&disc, STEPS).into_iter().filter_map(|(phi, side)| disc.station(phi, side));
            let points: Vec<Point> = all.map(|s| self.at(s.pitch)).collect();
            let stroke = self.style.thin.dashed(Dash::DashDot);
            self.begin(STATIONS);
            self.draw(
                "pitch",
                Shape::Polyline { points, closed: true, stroke: Some(stroke), fill: None },
                None,
            );
        }
    }

    /// Draws the base circle, the circle of the roller's centre on it, the offset circle, and the
    /// circle of the pivots.
    fn circles(&mut self) {
        let disc = self.disc().clone();
        let base = disc.base();
        let (thin, dashed) = (self.style.thin, self.style.thin.dashed(Dash::Dashed));
        self.circle("base", base, thin);
        if let Some(radius) = prime_m(&disc) {
            self.circle("pitch-circle", radius, dashed);
        }
        // Radii are drawn between two stations, clear of the follower.
        let radius = |d: &mut CamDrawing, name: &str, r: f64, angle: f64| {
            let to = d.at(Vec2::from_angle(angle) * r);
            let (stroke, head) = (d.style.thin, d.style.thin_head);
            d.draw("radius", Shape::Arrow { from: Point::ORIGIN, to, stroke, head }, None);
            let label = Label::math(name).in_fonts(&d.style.fonts);
            d.want(LabelRequest::along(label, d.style.small_mm, Point::ORIGIN, to, 0.2));
        };
        radius(self, "r_0", base, (-105.0f64).to_radians());
        match disc.follower {
            Follower::Translating { offset, .. } if offset != 0.0 => {
                self.circle("offset", offset.abs(), thin);
                radius(self, "e", offset.abs(), (-15.0f64).to_radians());
            }
            Follower::Translating { .. } => {}
            Follower::Oscillating { pivot, .. } => self.circle("pivots", pivot.norm(), dashed),
        }
        let dot = Shape::Circle {
            centre: Point::ORIGIN,
            radius_mm: self.style.dot_radius_mm,
            stroke: None,
            fill: Some(Colour::BLACK),
        };
        self.draw("centre", dot, None);
        let name = self.report.scene.point_name(self.report.turning.pivot).to_owned();
        self.label(&name, Point::ORIGIN, 1.2, Vec2::new(-1.0, 1.0));
    }

    /// Draws the follower in its stations, the first one in thick lines.
    fn stations(&mut self) {
        let disc = self.disc().clone();
        for k in 0..STATIONS {
            let phi = TAU * k as f64 / STATIONS as f64;
            let Some(s) = disc.station(phi, PieceSide::After) else { continue };
            let stroke = if k == 0 { self.style.outline } else { self.style.thin };
            self.begin(k);
            self.follower(&disc, &s, Some(k), stroke);
        }
    }

    fn follower(&mut self, disc: &Disc, s: &CamStation, k: Option<usize>, stroke: LineStroke) {
        let link = Some(self.report.cam.follower.0);
        let back = Vec2::from_angle(-disc.sense * s.phi);
        let pitch = self.at(s.pitch);
        let contact = self.at(s.contact);
        let name = k.map_or_else(String::new, |k| k.to_string());
        if let FollowerTip::Point { radius } = disc.touch
            && radius > 0.0
        {
            let shape = Shape::Circle {
                centre: pitch,
                radius_mm: radius * self.scale,
                stroke: Some(stroke),
                fill: None,
            };
            self.draw("roller", shape, link);
        }
        let dot = |centre| Shape::Circle {
            centre,
            radius_mm: 0.6,
            stroke: None,
            fill: Some(Colour::BLACK),
        };
        match disc.follower {
            Follower::Translating { direction, offset } => {
                let d = direction.rotate_by(back);
                let foot = self.at(d.perp() * -offset);
                let far = pitch + d * self.beyond(disc);
                self.draw("station", Shape::Line { from: foot, to: far, stroke }, link);
                self.number(&name, far, 0.5, d);
            }
            Follower::Oscillating { pivot, .. } => {
                let p = self.at(pivot.rotate_by(back));
                // The arm, or the face from beside the pivot to its contact and beyond.
                let (from, to) = match disc.touch {
                    FollowerTip::Point { .. } => (p, pitch),
                    FollowerTip::Flat { .. } => (pitch, contact + (contact - pitch) * 0.15),
                };
                if from != p
                    && (from - p).norm() > 0.5
                    && matches!(disc.touch, FollowerTip::Flat { .. })
                {
                    self.draw("lever", Shape::Line { from: p, to: from, stroke }, link);
                }
                self.draw("station", Shape::Line { from, to, stroke }, link);
                let pin = Shape::Circle {
                    centre: p,
                    radius_mm: 1.0,
                    stroke: Some(stroke),
                    fill: Some(Colour::WHITE),
                };
                self.draw("pivot", pin, None);
                self.number(&name, p, 1.2, p.to_vec2());
            }
        }
        if let (FollowerTip::Flat { .. }, Follower::Translating { .. }) =
            (disc.touch, disc.follower)
        {
            let half = (s.contact - s.pitch).norm() * self.scale + 6.0;
            let along = s.normal.perp() * half;
            self.draw("face", Shape::Line { from: pitch - along, to: pitch + along, stroke }, link);
        }
        self.draw("contact", dot(contact), None);
        if let FollowerTip::Point { radius } = disc.touch
            && radius > 0.0
        {
            self.draw("pitch-point", dot(pitch), None);
        }
    }

    /// Length of a translating follower's line beyond its point (mm).
    fn beyond(&self, disc: &Disc) -> f64 {
        match disc.touch {
            FollowerTip::Point { radius } => (radius * self.scale + 3.0).max(6.0),
            FollowerTip::Flat { .. } => 6.0,
        }
    }

    /// Draws an arrow in the sense in which the follower goes round, opposite to the cam's, outside
    /// the drawing at that place.
    fn turning(&mut self) {
        self.begin(0);
        let sense = -self.disc().sense;
        let from_rad = 0.25 * TAU + sense * 0.12;
        let (stroke, head) = (self.style.thin, self.style.thin_head);
        let to_rad = from_rad + sense * 0.28;
        let angles = [from_rad.min(to_rad), from_rad.max(to_rad)];
        let there = |p: &Point| {
            (angles[0] - ARROW_AIR..angles[1] + ARROW_AIR).contains(&p.to_vec2().angle())
        };
        let along = |bar: &Bar| {
            (0..=SAMPLES)
                .map(|k| bar.from + (bar.to - bar.from) * (k as f64 / SAMPLES as f64))
                .collect::<Vec<_>>()
        };
        let drawn = Obstacles::of(&self.items).bars;
        let reach_mm = drawn
            .iter()
            .flat_map(along)
            .filter(there)
            .map(|p| p.to_vec2().norm())
            .fold(0.0, f64::max);
        let radius_mm = reach_mm + ARROW_MM;
        self.draw(
            "sense",
            Shape::ArcArrow { centre: Point::ORIGIN, radius_mm, from_rad, to_rad, stroke, head },
            None,
        );
        let label = Label::math("−ω").in_fonts(&self.style.fonts);
        self.want(LabelRequest::along_arc(
            label,
            self.style.small_mm,
            Point::ORIGIN,
            radius_mm,
            angles,
            0.3,
        ));
    }

    /// Draws the pressure angle where it is greatest on the way out: the normal, the direction in
    /// which the follower moves, and the arc between.
    fn pressure(&mut self) {
        let Some((phi, _)) = self.report.survey.pressure[0] else { return };
        let disc = self.disc().clone();
        let Some(s) = disc.station(phi, PieceSide::After) else { return };
        self.begin(STATIONS + 1 + usize::from(rolls(&disc)));
        self.follower(&disc, &s, None, self.style.outline);
        let back = Vec2::from_angle(-disc.sense * s.phi);
        let motion = match disc.follower {
            Follower::Translating { direction, .. } => direction.rotate_by(back),
            Follower::Oscillating { pivot, .. } => {
                let across = (s.pitch - pivot.rotate_by(back)).perp();
                let across = across.unit().unwrap_or(s.normal);
                if across.dot(s.normal) < 0.0 { across * -1.0 } else { across }
            }
        };
        let at = self.at(s.pitch);
        for (class, along) in [("normal", s.normal), ("motion", motion)] {
            let (to, stroke) = (at + along * ANGLE_MM, self.style.thin.dashed(Dash::Dashed));
            self.draw(class, Shape::Line { from: at, to, stroke }, None);
        }
        let turned = libm::atan2(motion.cross(s.normal), motion.dot(s.normal));
        let from_rad = motion.angle();
        let to_rad = from_rad + turned;
        let (radius_mm, stroke) = (ANGLE_MM * 0.7, self.style.thin);
        self.draw("angle", Shape::Arc { centre: at, radius_mm, from_rad, to_rad, stroke }, None);
        let label = Label::math("\\alpha_{max}").in_fonts(&self.style.fonts);
        let angles = [from_rad.min(to_rad), from_rad.max(to_rad)];
        let size_mm = self.style.small_mm;
        self.want(LabelRequest::along_arc(label, size_mm, at, radius_mm, angles, 0.3));
    }

    /// Draws the circle of curvature where its radius is least.
    fn curvature(&mut self) {
        let Some((phi, rho)) = self.report.survey.least_rho else { return };
        let Some(s) = self.disc().station(phi, PieceSide::After) else { return };
        let before = [rolls(self.disc()), self.report.survey.pressure[0].is_some()];
        self.begin(STATIONS + 1 + before.into_iter().filter(|b| *b).count());
        let of = match self.disc().touch {
            FollowerTip::Point { .. } => s.pitch,
            FollowerTip::Flat { .. } => s.contact,
        };
        let (at, centre) = (self.at(of), self.at(of - s.normal * rho));
        let (stroke, head) = (self.style.thin, self.style.thin_head);
        let radius_mm = at.distance(centre);
        let dashed = Some(stroke.dashed(Dash::Dashed));
        self.draw(
            "osculating",
            Shape::Circle { centre, radius_mm, stroke: dashed, fill: None },
            None,
        );
        self.draw("radius", Shape::Arrow { from: centre, to: at, stroke, head }, None);
        let label = Label::math("\\rho_{min}").in_fonts(&self.style.fonts);
        self.want(LabelRequest::along(label, self.style.small_mm, centre, at, 0.2));
    }
}
