//! Draws the two views of a plate that turns in space: perpendicular to it, and along its axis.

use super::{ParticleDrafter, ParticleView, step};
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::geom::{Point, Vec2};
use hodograph_methods::particle::ParticleMotionKind;
use hodograph_methods::particle::board::{Arrow, MotionDrawing, Views};
use hodograph_methods::particle::law::PathLaw;
use hodograph_paper::paper::drawing::Drawing;
use hodograph_paper::paper::item::{Colour, Dash, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::symbols as sym;
use hodograph_scene::DiagramKind;

/// Colour of a plate seen edge-on, in the background of the vectors along it.
const PLATE: Colour = Colour::grey(175);

impl ParticleDrafter<'_> {
    /// Draws the view on the plate: its axis upwards, the path, v_r or a_r at the point.
    pub(super) fn on_plate(
        &self,
        drawn: &MotionDrawing,
        on: DiagramKind,
        arrows: &[Arrow],
    ) -> Result<ParticleView, Diagnostic> {
        let style = self.style;
        let mut d = Drawing::new("front", style.clone());
        let motion = &self.problem.motions[drawn.motion];
        let (Views::Plate { places, .. }, ParticleMotionKind::OnPlate(k, way)) =
            (&drawn.views, &motion.kind)
        else {
            return Err(Diagnostic::error("plate", both!("`{}` moves on no plate", motion.point)));
        };
        let plate = &self.problem.plates[*k];
        let (m, mu) = (places[0], drawn.scale(DiagramKind::Plane));
        let path = self.path(way, mu)?;
        let ends = || {
            path.iter()
                .copied()
                .chain([m, Point::ORIGIN])
                .chain(arrows.iter().map(|a| a.to))
                .chain(self.also[0].iter().copied())
        };
        let most = |f: fn(Point) -> f64| {
            ends().map(f).fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], x| [l.min(x), h.max(x)])
        };
        let ([x0, x1], [y0, y1]) = (most(|p| p.x), most(|p| p.y));
        let (low, high) = (y0 - 6.0, y1 + 6.0);
        let (left, right) = (if x0 < -0.5 { x0 - 4.0 } else { 0.0 }, x1 + 4.0);
        let sheet = [
            Point::new(left, low),
            Point::new(right, low),
            Point::new(right, high),
            Point::new(left, high),
        ];
        d.draw("plate", "plate", sym::plate(style, &sheet));
        let axis = [Point::new(0.0, low - 5.0), Point::new(0.0, high + 7.0)];
        let stroke = style.thin.dashed(Dash::DashDot);
        let owner = d.shape(
            "axis",
            "axis",
            Shape::Arrow { from: axis[0], to: axis[1], stroke, head: style.thin_head },
        );
        d.label(
            "axis",
            "axis",
            LabelRequest::at_point(Label::math(plate.axis.letter()), style.label_mm, axis[1], 0.6)
                .owned(owner),
        );
        self.line(&mut d, "path", path, style.outline);
        for a in arrows {
            self.arrow(&mut d, a, drawn.scale(on), Some(&motion.point));
        }
        self.named(&mut d, &motion.point, m);
        d.label(
            "link",
            "link",
            LabelRequest::at_point(
                Label::math(&plate.link),
                style.label_mm,
                sheet[1] + Vec2::new(-5.0, 5.0),
                0.0,
            ),
        );
        let caption = match on {
            DiagramKind::Plane => both!("View on the plate"),
            DiagramKind::Velocity | DiagramKind::Acceleration | DiagramKind::Force => {
                both!("View on the plate (calculated)")
            }
        };
        Ok(ParticleView { part: d.finish(), caption, scales: self.scales(drawn, on) })
    }

    /// The path on the plate (mm): a line beyond the point and its start, a full circle, or part of
    /// another path.
    fn path(&self, way: &PathLaw, mu: f64) -> Result<Vec<Point>, Diagnostic> {
        let t = self.problem.instant();
        let place = |t: f64| -> Result<Point, Diagnostic> {
            let [r, z] = way.at(t)?;
            Ok(Point::new(r.0[0] / mu, z.0[0] / mu))
        };
        let now = place(t)?;
        Ok(match way {
            PathLaw::Line { from, angle, .. } => {
                let (s, c) = hodograph_methods::particle::law::sine_cosine(angle, t)?;
                let along = Vec2::new(s.0[0], c.0[0]);
                let value = |k: usize| {
                    hodograph_methods::particle::law::jet(&from[k], t).map(|j| j.0[0] / mu)
                };
                let start = Point::new(value(0)?, value(1)?);
                let there = along.dot(now - start);
                vec![start + along * there.min(0.0), start + along * (there.max(0.0) + 8.0)]
            }
            PathLaw::Circle { centre, .. } => {
                let value = |k: usize| {
                    hodograph_methods::particle::law::jet(&centre[k], t).map(|j| j.0[0] / mu)
                };
                let centre = Point::new(value(0)?, value(1)?);
                let arm = now - centre;
                (0..=120)
                    .map(|k| {
                        centre
                            + arm.rotate_by(Vec2::from_angle(
                                std::f64::consts::TAU * f64::from(k) / 120.0,
                            ))
                    })
                    .collect()
            }
            PathLaw::Polar { .. } | PathLaw::Free(_) => {
                let span = if t > 0.0 { 2.0 * t } else { 1.0 };
                (0..=60).filter_map(|k| place(span * f64::from(k) / 60.0).ok()).collect()
            }
        })
    }

    /// Draws the view along the axis: the plate as a line, and all components perpendicular to the
    /// axis.
    pub(super) fn along_axis(
        &self,
        drawn: &MotionDrawing,
        on: DiagramKind,
        arrows: &[Arrow],
    ) -> ParticleView {
        let style = self.style;
        let mut d = Drawing::new("top", style.clone());
        let motion = &self.problem.motions[drawn.motion];
        let (Views::Plate { places, along, .. }, ParticleMotionKind::OnPlate(k, _)) =
            (&drawn.views, &motion.kind)
        else {
            return ParticleView { part: d.finish(), caption: Both::default(), scales: Vec::new() };
        };
        let plate = &self.problem.plates[*k];
        let (m, o) = (places[1], Point::ORIGIN);
        let foot = o + along.perp() * along.perp().dot(m.to_vec2());
        let far = along.dot(m - foot);
        let ends = [foot + *along * (far.min(0.0) - 4.0), foot + *along * (far.max(0.0) + 10.0)];
        let order = plate.axis.order();
        for (direction, place) in [(Vec2::new(1.0, 0.0), order[0]), (Vec2::new(0.0, 1.0), order[1])]
        {
            let reach = arrows
                .iter()
                .flat_map(|a| [a.from, a.to])
                .chain(ends)
                .chain(self.also[1].iter().copied())
                .map(|p| direction.dot(p.to_vec2()))
                .fold(12.0, f64::max);
            let tip = o + direction * (reach + 6.0);
            let owner = d.shape(
                "axis",
                "axis",
                Shape::Arrow { from: o, to: tip, stroke: style.thin, head: style.thin_head },
            );
            let letter = ["x", "y", "z"][place];
            d.label(
                "axis",
                "axis",
                LabelRequest::at_point(Label::math(letter), style.label_mm, tip, 0.6)
                    .owned(owner)
                    .towards(direction),
            );
        }
        d.shape(
            "plate",
            "link",
            Shape::Line { from: ends[0], to: ends[1], stroke: style.link.coloured(PLATE) },
        );
        if foot.distance(o) > 0.5 {
            self.line(&mut d, "offset", vec![o, foot], style.thin.dashed(Dash::Dashed));
        }
        // The axis points towards the reader.
        d.shape(
            "axis",
            "axis",
            Shape::Circle {
                centre: o,
                radius_mm: 1.4,
                stroke: Some(style.outline),
                fill: Some(Colour::WHITE),
            },
        );
        d.draw("axis", "axis", sym::dot(style, o));
        d.label(
            "axis",
            "axis",
            LabelRequest::at_point(Label::math(plate.axis.letter()), style.label_mm, o, 1.6),
        );
        if let Ok(turn) = plate.turning.at(self.problem.instant())
            && turn.omega != 0.0
        {
            let turn_by = if turn.omega > 0.0 { 1.0 } else { -1.0 };
            let start = along.angle() + turn_by * 0.5;
            let owner = d.draw(
                "omega",
                "rotation",
                sym::rotation(style, o, 7.0, start, start + turn_by * 1.3),
            );
            let ring = LabelRequest::along_arc(
                Label::math(format!("\\omega_{{{}}}", plate.link)),
                style.label_mm,
                o,
                7.0,
                [start, start + turn_by * 1.3],
                0.2,
            );
            d.label("omega", "rotation", ring.owned(owner));
        }
        if let (DiagramKind::Velocity, [one, other, whole]) = (on, arrows) {
            for from in [one.to, other.to] {
                self.line(
                    &mut d,
                    &format!("parallelogram {}", step(1)),
                    vec![from, whole.to],
                    style.thin.dashed(Dash::Dashed),
                );
            }
        }
        for a in arrows {
            self.arrow(&mut d, a, drawn.scale(on), Some(&motion.point));
        }
        self.named(&mut d, &motion.point, m);
        let caption = match on {
            DiagramKind::Plane => both!("View along the axis"),
            DiagramKind::Velocity | DiagramKind::Acceleration | DiagramKind::Force => {
                both!("View along the axis (calculated; $v'$, $a'$ as they are seen there)")
            }
        };
        ParticleView { part: d.finish(), caption, scales: self.scales(drawn, on) }
    }
}
