//! Draws a pursuit: the course from the start to the meeting, and the polygons at the instant.

use super::{ParticleDrafter, ParticleView, step};
use hodograph_base::diag::{Both, both};
use hodograph_base::digits::significant;
use hodograph_base::geom::Point;
use hodograph_methods::particle::board::{Arrow, FINE, MotionDrawing, SIGHTS, Views};
use hodograph_paper::paper::drawing::{Drawing, DrawingPart};
use hodograph_paper::paper::item::{Colour, Dash, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::symbols as sym;
use hodograph_scene::DiagramKind;

fn caption(until: f64, meets: bool) -> Both {
    let last = significant(until, if meets { 5 } else { 3 });
    if meets {
        both!("Courses from $t = 0$ to the meeting $P$ at {last} s, lines of sight at equal times")
    } else {
        both!("Courses from $t = 0$ to {last} s, lines of sight at equal times; no meeting")
    }
}

/// Distance from a lettered point within which a number would be read with the letter.
const BESIDE_MM: f64 = 3.0;

impl ParticleDrafter<'_> {
    /// Draws the course of pursuer and target from the start to the meeting, with lines of sight at
    /// equal times, and the two points at the instant if `with_now` is true (in a lesson they move:
    /// [`ParticleDrafter::pair`]).
    pub fn course(&self, drawn: &MotionDrawing, with_now: bool) -> Option<ParticleView> {
        let motion = &self.problem.motions[drawn.motion];
        let Views::Chase { course, until, meets, places, .. } = &drawn.views else { return None };
        let (_, target) = self.problem.chase(motion)?;
        let mut d = Drawing::new("course", self.style.clone());
        self.sights(&mut d, course, if with_now { places } else { &[] });
        if with_now {
            self.line(&mut d, &format!("line {}", step(0)), places.to_vec(), self.style.outline);
        }
        if self.problem.instant() > 0.0 || !with_now {
            for (name, at) in [motion.point.as_str(), target].into_iter().zip(*course.first()?) {
                d.draw(name, "point", sym::dot(self.style, at));
                d.label_at(name, "point", &format!("{name}_0"), at, self.style.dot_radius_mm, None);
            }
        }
        if with_now {
            self.named(&mut d, &motion.point, places[0]);
            self.named(&mut d, target, places[1]);
        }
        if let Some([_, p]) = course.last().filter(|_| *meets) {
            self.named(&mut d, "P", *p);
        }
        Some(ParticleView {
            part: d.finish(),
            caption: caption(*until, *meets),
            scales: vec![(DiagramKind::Plane, drawn.scale(DiagramKind::Plane))],
        })
    }

    /// Draws pursuer and target at the start, with the path of the target.
    pub(super) fn start(&self, drawn: &MotionDrawing) -> Option<ParticleView> {
        let Views::Chase { course, .. } = &drawn.views else { return None };
        let motion = &self.problem.motions[drawn.motion];
        let (_, target) = self.problem.chase(motion)?;
        let mut d = Drawing::new("course", self.style.clone());
        let [a, b] = *course.first()?;
        self.line(
            &mut d,
            "target",
            course.iter().map(|p| p[1]).collect(),
            self.style.thin.dashed(Dash::DashDot),
        );
        self.line(&mut d, "line", vec![a, b], self.style.thin);
        self.named(&mut d, &motion.point, a);
        self.named(&mut d, target, b);
        let caption = both!("At the start, $t = 0$, with the path of ${target}$");
        Some(ParticleView {
            part: d.finish(),
            caption,
            scales: vec![(DiagramKind::Plane, drawn.scale(DiagramKind::Plane))],
        })
    }

    /// Draws the two points at the instant and the line between them.
    pub fn pair(&self, drawn: &MotionDrawing) -> DrawingPart {
        let mut d = Drawing::new("course", self.style.clone());
        let motion = &self.problem.motions[drawn.motion];
        if let (Views::Chase { places, .. }, Some((_, target))) =
            (&drawn.views, self.problem.chase(motion))
        {
            self.line(&mut d, &format!("line {}", step(0)), places.to_vec(), self.style.outline);
            self.named(&mut d, &motion.point, places[0]);
            self.named(&mut d, target, places[1]);
        }
        d.finish()
    }

    /// Draws the two paths, lines of sight and numbers at equal times. Beside a letter there is no
    /// number: it would be read as an exponent.
    fn sights(&self, d: &mut Drawing, course: &[[Point; 2]], lettered: &[Point]) {
        let style = self.style;
        for [a, b] in course.iter().step_by(FINE).copied() {
            if a.distance(b) > 1.0 {
                self.line(d, "sight", vec![a, b], style.thin.coloured(Colour::grey(150)));
            }
        }
        self.line(
            d,
            "target",
            course.iter().map(|p| p[1]).collect(),
            style.thin.dashed(Dash::DashDot),
        );
        self.line(d, "pursuer", course.iter().map(|p| p[0]).collect(), style.vector);
        for (k, pair) in course.iter().step_by(FINE).enumerate().take(SIGHTS).skip(1) {
            for at in *pair {
                d.draw("tick", "position", sym::dot(style, at));
                if lettered.iter().any(|p| p.distance(at) < BESIDE_MM) {
                    continue;
                }
                let number = LabelRequest::at_point(
                    Label::math(k.to_string()),
                    style.small_mm * 0.85,
                    at,
                    style.dot_radius_mm,
                );
                d.label("tick", "position", number.optional(true));
            }
        }
    }

    /// Draws both polygons from their poles.
    pub fn polygons(&self, drawn: &MotionDrawing) -> Vec<ParticleView> {
        let Views::Chase { velocities, foot, accelerations, .. } = &drawn.views else {
            return Vec::new();
        };
        vec![
            self.polygon(drawn, DiagramKind::Velocity, velocities, Some(*foot)),
            self.polygon(drawn, DiagramKind::Acceleration, accelerations, None),
        ]
    }

    fn polygon(
        &self,
        drawn: &MotionDrawing,
        on: DiagramKind,
        arrows: &[Arrow],
        foot: Option<Point>,
    ) -> ParticleView {
        let style = self.style;
        let mut d = Drawing::new("polygon", style.clone());
        let prime = on.prime();
        let pole = format!("{}{prime}", self.notation().pole);
        let mu = drawn.scale(on);
        for a in arrows {
            self.arrow(&mut d, a, mu, None);
        }
        if let (Some(foot), Some(b)) = (foot, arrows.get(1)) {
            let tip_a = arrows[0].to;
            // The line of v_A is extended to the foot if it ends before it.
            if foot.to_vec2().norm() > tip_a.to_vec2().norm()
                || foot.to_vec2().dot(tip_a.to_vec2()) < 0.0
            {
                self.line(&mut d, &format!("beyond {}", step(2)), vec![tip_a, foot], style.thin);
            }
            let class = format!("across {}", step(2));
            let owner = d.shape(
                "across",
                &class,
                Shape::Line { from: b.to, to: foot, stroke: style.thin.dashed(Dash::Dashed) },
            );
            if b.to.distance(foot) > 3.0 {
                let name =
                    LabelRequest::along(Label::math("\\omega l"), style.small_mm, b.to, foot, 0.1);
                d.label("across", &class, name.owned(owner).optional(true));
            }
        }
        d.draw("pole", "pole", sym::dot(style, Point::ORIGIN));
        d.label_at("pole", "pole", &pole, Point::ORIGIN, style.dot_radius_mm, None);
        let caption = match on {
            DiagramKind::Acceleration => both!("Acceleration of the pursuer"),
            DiagramKind::Plane | DiagramKind::Velocity | DiagramKind::Force => {
                both!("Velocities at the instant")
            }
        };
        ParticleView { part: d.finish(), caption, scales: vec![(on, mu)] }
    }
}
