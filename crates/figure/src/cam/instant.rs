//! Draws a cam with its follower at the instant: base circle, pitch curve, the normal with the
//! pressure angle α, the lift s and the stroke h, and the angles of the cam for rise, dwells and
//! return.

use super::{CamDrawing, heading};
use hodograph_base::cam::{CamJet, CamMotion, Follower, FollowerTip, round};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::tr;
use hodograph_board::construct::scale::choose_in;
use hodograph_paper::paper::item::{Colour, Dash, Figure, LineStroke, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::style::Style;
use hodograph_report::cam::Report;
use hodograph_scene::{Kind, Lang};
use std::f64::consts::TAU;

/// Approximate length of the drawing's larger side (mm).
const SIZE_MM: f64 = 130.0;
/// Points of each curve: one for each half degree.
const STEPS: usize = 720;
/// Distances of the dimensions s and h from the path of the follower's point, beyond its end (mm).
const ASIDE_MM: [f64; 2] = [9.0, 18.0];
/// Radius of the arc of the pressure angle, length of its sides, and of the normal (mm).
const ARC_MM: f64 = 15.0;
const NORMAL_MM: f64 = 24.0;
/// Distance of the arcs of rise, dwells and return from everything else (mm).
const STAGES_MM: f64 = 8.0;

/// Draws the figure; `None` if the follower touches nothing at the instant.
pub fn figure(report: &Report, style: &Style, lang: Lang) -> Option<Figure> {
    let (turning, disc) = (report.turning, &report.turning.disc);
    let station = disc.station(turning.phi, turning.side)?;
    let turn = Vec2::from_angle(disc.sense * turning.phi);
    let all: Vec<Vec2> = round(disc, STEPS)
        .into_iter()
        .filter_map(|(phi, side)| disc.station(phi, side))
        .map(|s| match disc.touch {
            FollowerTip::Point { .. } => s.pitch,
            // The foot of a face may be far from the cam.
            FollowerTip::Flat { .. } => s.contact,
        })
        .map(|p| p.rotate_by(turn))
        .collect();
    let far = all.iter().map(|p| p.norm()).fold(disc.base(), f64::max);
    let unit =
        report.scene.book.chosen(Kind::Length).map_or(1.0, hodograph_scene::book::BookUnit::size);
    let mu = choose_in(unit, [2.0 * far; 2], [SIZE_MM; 2]);
    let mut d = InstantDrawing { d: CamDrawing::new(report, style, mu), turn };
    d.circles();
    d.curves(&all);
    let [low, high] = report.survey.ends.map_or([0.0; 2], |ends| ends.map(|p| p.value));
    let low = if matches!(disc.motion, CamMotion::Law { .. }) { report.survey.rest } else { low };
    d.follower(station.q.0[0]);
    d.travel([low, station.q.0[0], high]);
    if let FollowerTip::Point { .. } = disc.touch {
        d.pressure(station.contact.rotate_by(turn), station.normal.rotate_by(turn), station.q.0[0]);
    }
    d.stages(far * d.d.scale + STAGES_MM);
    let title = tr!(lang, "the instant");
    let caption = match disc.touch {
        FollowerTip::Point { radius } if radius > 0.0 => tr!(
            lang,
            "thick: profile; chain line: pitch curve; circles: base circles of profile (thin) and pitch curve (dashed); n–n: normal"
        ),
        _ => tr!(lang, "thick: profile; circle: base circle"),
    };
    let title = heading(report.scene, title, lang);
    Some(d.d.finish(mu, title, caption, lang))
}

/// The drawing in the axes of the link that carries cam and follower, about the cam's centre.
struct InstantDrawing<'a> {
    d: CamDrawing<'a>,
    /// The rotation of the cam.
    turn: Vec2,
}

impl InstantDrawing<'_> {
    fn line(&mut self, class: &str, from: Point, to: Point, stroke: LineStroke) {
        self.d.draw(class, Shape::Line { from, to, stroke }, None);
    }

    fn circle(&mut self, class: &str, centre: Point, radius_mm: f64, stroke: LineStroke) {
        let stroke = Some(stroke);
        self.d.draw(class, Shape::Circle { centre, radius_mm, stroke, fill: None }, None);
    }

    fn dot(&mut self, class: &str, centre: Point) {
        let (radius_mm, fill) = (self.d.style.dot_radius_mm, Some(Colour::BLACK));
        self.d.draw(class, Shape::Circle { centre, radius_mm, stroke: None, fill }, None);
    }

    fn along(&mut self, text: &str, from: Point, to: Point) {
        let label = Label::math(text).in_fonts(&self.d.style.fonts);
        self.d.want(LabelRequest::along(label, self.d.style.small_mm, from, to, 0.2));
    }

    /// Returns the radius of the follower's end (m); 0 for a face.
    fn end(&self) -> f64 {
        match self.d.disc().touch {
            FollowerTip::Point { radius } => radius,
            FollowerTip::Flat { .. } => 0.0,
        }
    }

    /// Returns the follower's point at a coordinate.
    fn point(&self, q: f64) -> Vec2 {
        self.d.disc().follower.point(CamJet::constant(q)).order(0)
    }

    /// Draws the base circles of profile and pitch curve.
    fn circles(&mut self) {
        let (base, scale) = (self.d.disc().base(), self.d.scale);
        let thin = self.d.style.thin;
        self.circle("base", Point::ORIGIN, base * scale, thin);
        let radius = self.end();
        if radius > 0.0 {
            let dashed = thin.dashed(Dash::Dashed);
            self.circle("pitch-circle", Point::ORIGIN, (base + radius) * scale, dashed);
        }
        let to = self.d.at(Vec2::from_angle((-105.0f64).to_radians()) * base);
        let head = self.d.style.thin_head;
        self.d.draw("radius", Shape::Arrow { from: Point::ORIGIN, to, stroke: thin, head }, None);
        self.along("r_0", Point::ORIGIN, to);
        self.dot("centre", Point::ORIGIN);
        let name = self.d.report.scene.point_name(self.d.report.turning.pivot).to_owned();
        self.d.label(&name, Point::ORIGIN, 1.2, Vec2::new(-1.0, 1.0));
    }

    /// Draws profile and pitch curve.
    fn curves(&mut self, pitch: &[Vec2]) {
        let outline = self.d.disc().outline(STEPS);
        let points: Vec<Point> =
            outline.into_iter().map(|p| self.d.at(p.rotate_by(self.turn))).collect();
        let link = Some(self.d.report.cam.cam.0);
        let stroke = Some(self.d.style.link);
        let shape = Shape::Polyline { points, closed: true, stroke, fill: None };
        self.d.draw("profile", shape, link);
        if self.end() > 0.0 {
            let points: Vec<Point> = pitch.iter().map(|p| self.d.at(*p)).collect();
            let stroke = Some(self.d.style.thin.dashed(Dash::DashDot));
            let shape = Shape::Polyline { points, closed: true, stroke, fill: None };
            self.d.draw("pitch", shape, None);
        }
    }

    /// Draws the follower: its path or arm, its end.
    fn follower(&mut self, q: f64) {
        let (disc, stroke) = (self.d.disc().clone(), self.d.style.outline);
        let b = self.d.at(self.point(q));
        match disc.follower {
            Follower::Translating { direction, offset } => {
                let foot = self.d.at(direction.perp() * -offset);
                let chain = self.d.style.thin.dashed(Dash::DashDot);
                self.line("path", foot, b, chain);
                self.line("rod", b, b + direction * (NORMAL_MM * 1.6), stroke);
                if let FollowerTip::Flat { .. } = disc.touch {
                    let half = direction.perp() * NORMAL_MM;
                    self.line("face", b - half, b + half, stroke);
                }
            }
            Follower::Oscillating { pivot, arm, .. } => {
                let p = self.d.at(pivot);
                let to = if arm > 0.0 {
                    b
                } else {
                    let n = disc.follower.normal(CamJet::constant(q)).order(0);
                    p + n.perp()
                        * ((pivot.norm() * self.d.scale)
                            * if n.perp().dot(-pivot) > 0.0 { 1.2 } else { -1.2 })
                };
                self.line("arm", p, to, stroke);
                let fill = Some(Colour::WHITE);
                let pin = Shape::Circle { centre: p, radius_mm: 1.2, stroke: Some(stroke), fill };
                self.d.draw("pivot", pin, None);
            }
        }
        let radius_mm = self.end() * self.d.scale;
        if radius_mm > 0.0 {
            self.circle("roller", b, radius_mm, stroke);
        }
        if let FollowerTip::Point { .. } = disc.touch {
            self.dot("follower", b);
        }
    }

    /// Draws the lift s and the stroke h as dimensions from the lowest position.
    fn travel(&mut self, [low, now, high]: [f64; 3]) {
        let (stroke, head) = (self.d.style.thin, self.d.style.thin_head);
        let disc = self.d.disc().clone();
        let clear = self.end() * self.d.scale;
        let names = if self.d.report.swings() { ["\\psi", "\\Psi"] } else { ["s", "h"] };
        for ((to, aside), name) in [now, high].into_iter().zip(ASIDE_MM).zip(names) {
            let [from, to] = [low, to].map(|q| self.d.at(self.point(q)));
            if from.distance(to) < 1.0 {
                continue;
            }
            match disc.follower {
                Follower::Translating { direction, offset } => {
                    // On the side away from the cam's centre.
                    let side = if offset < 0.0 { direction.perp() } else { -direction.perp() };
                    let off = side * (clear + aside);
                    for end in [from, to] {
                        self.line("extension", end, end + off + side * 1.5, stroke);
                    }
                    let shape = Shape::Arrow { from: from + off, to: to + off, stroke, head };
                    self.d.draw("dimension", shape, None);
                    self.along(name, from + off, to + off);
                }
                Follower::Oscillating { pivot, .. } => {
                    let p = self.d.at(pivot);
                    let radius_mm = (from.distance(p) - clear - aside).max(ASIDE_MM[0]);
                    let [a, b] = [from, to].map(|e| (e - p).angle());
                    let b = a + (b - a + TAU / 2.0).rem_euclid(TAU) - TAU / 2.0;
                    for end in [from, to] {
                        self.line("extension", p, end, stroke.dashed(Dash::Dashed));
                    }
                    let arc = Shape::Arc { centre: p, radius_mm, from_rad: a, to_rad: b, stroke };
                    self.d.draw("dimension", arc, None);
                    self.arc_label(name, p, radius_mm, [a, b]);
                }
            }
        }
    }

    fn arc_label(&mut self, text: &str, centre: Point, radius_mm: f64, ends: [f64; 2]) {
        let label = Label::math(text).in_fonts(&self.d.style.fonts);
        let small = self.d.style.small_mm;
        self.d.want(LabelRequest::along_arc(label, small, centre, radius_mm, ends, 0.2));
    }

    /// Draws the normal through the contact and the pressure angle at the follower's point.
    fn pressure(&mut self, contact: Vec2, normal: Vec2, q: f64) {
        let thin = self.d.style.thin;
        let (b, at) = (self.d.at(self.point(q)), self.d.at(contact));
        let ends = [at - normal * NORMAL_MM, b + normal * NORMAL_MM];
        self.line("normal", ends[0], ends[1], thin);
        for end in ends {
            self.d.label("n", end, 0.6, Vec2::ZERO);
        }
        self.dot("contact", at);
        let out = match self.d.disc().follower {
            Follower::Translating { direction, .. } => direction,
            Follower::Oscillating { .. } => {
                self.d.disc().follower.normal(CamJet::constant(q)).order(0)
            }
        };
        let head = self.d.style.thin_head;
        let arrow = Shape::Arrow { from: b, to: b + out * NORMAL_MM, stroke: thin, head };
        self.d.draw("motion", arrow, None);
        let turn = libm::atan2(out.cross(normal), out.dot(normal));
        let (from_rad, to_rad) = (out.angle(), out.angle() + turn);
        if turn.abs() > 0.02 {
            let arc = Shape::Arc { centre: b, radius_mm: ARC_MM, from_rad, to_rad, stroke: thin };
            self.d.draw("pressure", arc, None);
            self.arc_label("\\alpha", b, ARC_MM, [from_rad, to_rad]);
        }
    }

    /// Draws the angles of the cam for rise, dwells and return, on the cam: between the directions
    /// of the follower's guide or pivot at their ends.
    fn stages(&mut self, radius_mm: f64) {
        let disc = self.d.disc().clone();
        let zero = match disc.follower {
            Follower::Translating { direction, .. } => direction.angle(),
            Follower::Oscillating { pivot, .. } => pivot.angle(),
        };
        let thin = self.d.style.thin;
        let turned = self.turn.angle();
        let way = |phi: f64| zero - disc.sense * phi + turned;
        for p in self.d.report.survey.phases.clone() {
            let name = match (p.way, p.out) {
                (1, _) => "\\Phi",
                (-1, _) => "\\Phi′",
                (_, true) => "\\Phi_s",
                (_, false) => "\\Phi′_s",
            };
            let [from_rad, to_rad] = [way(p.from), way(p.to)];
            let tip = Vec2::from_angle(from_rad) * (radius_mm + 2.0);
            self.line("stage", Point::ORIGIN, Point::ORIGIN + tip, thin.dashed(Dash::Dashed));
            let centre = Point::ORIGIN;
            let arc = Shape::Arc { centre, radius_mm, from_rad, to_rad, stroke: thin };
            self.d.draw("stage", arc, None);
            self.arc_label(name, centre, radius_mm, [from_rad, to_rad]);
        }
    }
}
