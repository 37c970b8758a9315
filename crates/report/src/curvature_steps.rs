//! The construction of pole, inflection circle and centres of curvature as sentences, one per step.

use super::curvature::CurvatureWords;
use hodograph_base::geom::Vec2;
use hodograph_base::lang::{say, tr};
use hodograph_methods::curvature::drawing::{CurvatureDrawing, RayMethod, Rays, RollingWheel};
use hodograph_methods::curvature::known::{CurvatureRay, CurvatureReason};
use hodograph_methods::curvature::plane::PlanePoint;
use hodograph_methods::curvature::{OfLink, OfPoint};
use hodograph_paper::paper::phrase::{Phrase, capital};
use hodograph_scene::{Lang, PointId};

/// Returns the text with a capital first letter and a full stop.
fn sentence(text: String, lang: Lang) -> String {
    capital(&text) + tr!(lang, ".")
}

/// Part of the construction that a step draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurvatureStage {
    /// One of the two rays.
    Ray(usize),
    /// The pole.
    Pole,
    /// The contact of rolling contours, with the inflection pole.
    Rolling,
    /// The collineation axis.
    Collineation,
    /// The point of a ray with a straight path.
    Straight(usize),
    /// The inflection pole.
    Inflection,
    /// The inflection circle with the pole tangent.
    Circle,
    /// The centre of a point's path.
    Centre(PointId),
    /// The acceleration pole.
    AccelerationPole,
    /// The corners of the rectangles (0), then Ball's point (1).
    Ball(usize),
}

impl CurvatureWords<'_> {
    /// Returns the construction step by step.
    pub fn steps(&self, of: &OfLink) -> Vec<Phrase> {
        self.stages(of).into_iter().map(|(_, sentence)| sentence).collect()
    }

    /// Returns the construction step by step, each step with what it draws.
    pub fn stages(&self, of: &OfLink) -> Vec<(CurvatureStage, Phrase)> {
        let mut out = match &of.drawing {
            CurvatureDrawing::Rays(rays) => self.of_rays(of, rays),
            CurvatureDrawing::Rolling(rolled) => self.of_rolling(of, rolled),
            CurvatureDrawing::Hinge(_)
            | CurvatureDrawing::Parallel(_)
            | CurvatureDrawing::OneLine(_)
            | CurvatureDrawing::NoRays => {
                return Vec::new();
            }
        };
        let (pole, j, lang) = (self.pole(of), self.letter("J", of), self.lang);
        if of.drawn().is_some_and(|d| d.normal == Vec2::ZERO) {
            return self.set(out);
        }
        let measured = of.drawn().map_or_else(String::new, |d| self.on_paper(d.normal.norm()));
        let circle = say!(
            lang,
            "draw the circle on the diameter ${pole}{j}$ ({measured} on paper), the inflection circle; the pole tangent $t$ is perpendicular to it at ${pole}$"
        );
        out.push((CurvatureStage::Circle, circle));
        let centre = |p: &OfPoint| Some((CurvatureStage::Centre(p.point), self.of_point(of, p)?));
        out.extend(of.points.iter().filter_map(centre));
        if of.read.is_some() {
            let k = self.letter("K", of);
            let sentence = say!(
                lang,
                "turn ${pole}{j}$ about ${pole}$ by the angle whose tangent is $\\alpha/\\omega^{{2}}$; the foot of the perpendicular from ${j}$ to it is the acceleration pole ${k}$"
            );
            out.push((CurvatureStage::AccelerationPole, sentence));
        }
        if let CurvatureDrawing::Rays(rays) = &of.drawing
            && rays.ball().is_some()
        {
            let sentences = self.of_ball(of, rays).into_iter().enumerate();
            out.extend(sentences.map(|(k, sentence)| (CurvatureStage::Ball(k), sentence)));
        }
        self.set(out)
    }

    /// Returns the steps with their texts as sentences.
    fn set(&self, steps: Vec<(CurvatureStage, String)>) -> Vec<(CurvatureStage, Phrase)> {
        let set = |(stage, text)| (stage, Phrase::new(&sentence(text, self.lang)));
        steps.into_iter().map(set).collect()
    }

    /// Returns the steps to Ball's point.
    fn of_ball(&self, of: &OfLink, rays: &Rays) -> [String; 2] {
        let (pole, j, u) = (self.pole(of), self.letter("J", of), self.letter("U", of));
        let (corner, foot) = (self.corner(), self.foot());
        let [b, c] = rays.known.each_ref().map(|k| self.moving(k));
        let [g, h] =
            rays.known.each_ref().map(|k| self.below(corner, k.why.moving().unwrap_or(PointId(0))));
        [
            say!(
                self.lang,
                "the perpendiculars to the rays at ${b}$ and ${c}$ cut $t$ and the line ${pole}{j}$; the corners ${g}$ and ${h}$ complete the rectangles with the corner ${pole}$"
            ),
            say!(
                self.lang,
                "${g}{h}$ meets the parallel to $t$ through ${j}$ at ${corner}$; ${foot}$ is its foot on $t$; the foot of the perpendicular from ${pole}$ to ${foot}{j}$ is Ball's point ${u}$"
            ),
        ]
    }

    fn moving(&self, k: &CurvatureRay) -> String {
        k.why.moving().map_or_else(
            || format!("{}^{{\\infty}}", self.below("N", k.why.fixed().unwrap_or(PointId(0)))),
            |p| self.point(p),
        )
    }

    fn fixed(&self, k: &CurvatureRay) -> String {
        match (k.why.fixed(), k.why.moving()) {
            (Some(p), _) => self.point(p),
            (None, Some(p)) if matches!(k.fixed, PlanePoint::Infinity(_)) => {
                format!("{}^{{\\infty}}", self.centre(p))
            }
            (None, Some(p)) => self.centre(p),
            (None, None) => String::new(),
        }
    }

    fn ray(&self, k: &CurvatureRay) -> String {
        let (moving, fixed, lang) = (self.moving(k), self.fixed(k), self.lang);
        match k.why {
            CurvatureReason::Crank(_, _, by) => say!(
                lang,
                "${moving}$ moves on a circle about ${fixed}$ (link {}): draw the ray ${fixed}{moving}$",
                self.scene().link_name(by)
            ),
            CurvatureReason::Straight(..) => say!(
                lang,
                "${moving}$ moves on a straight line: the ray is perpendicular to its guide, the centre lies at infinity"
            ),
            CurvatureReason::Arc(..) => say!(
                lang,
                "${moving}$ moves on an arc about ${fixed}$: draw the ray ${fixed}{moving}$"
            ),
            CurvatureReason::Through(..) => say!(
                lang,
                "a line of the link along its guide always leads through ${fixed}$: draw the ray perpendicular to it through ${fixed}$; the moving point lies at infinity"
            ),
            CurvatureReason::Borrowed(_, of) => say!(
                lang,
                "${moving}$ belongs to link {} too, whose drawing gives the centre ${fixed}$ of its path: draw the ray ${fixed}{moving}$",
                self.scene().link_name(of)
            ),
        }
    }

    /// Returns the name of the inflection point of a ray, where paths are straight.
    pub fn straight(&self, k: &CurvatureRay) -> String {
        self.below("J", k.why.moving().or(k.why.fixed()).unwrap_or(PointId(0)))
    }

    fn of_rays(&self, of: &OfLink, rays: &Rays) -> Vec<(CurvatureStage, String)> {
        let (lang, pole) = (self.lang, self.pole(of));
        let known = rays.known.iter().enumerate();
        let mut out: Vec<(CurvatureStage, String)> =
            known.map(|(k, ray)| (CurvatureStage::Ray(k), self.ray(ray))).collect();
        let crossing = say!(lang, "the rays intersect at the pole ${pole}$");
        out.push((CurvatureStage::Pole, crossing));
        let [b, c] = &rays.known;
        if let Some(q) = rays.collineation {
            let (moving, fixed) =
                ((self.moving(b), self.moving(c)), (self.fixed(b), self.fixed(c)));
            let at = if q.at().is_none() {
                tr!(lang, " (at infinity: the axis is parallel to both)")
            } else {
                ""
            };
            let q = self.on_axis();
            let axis = say!(
                lang,
                "${}{}$ and ${}{}$ intersect at ${q}${at}; ${pole}{q}$ is the collineation axis (Bobillier)",
                moving.0,
                moving.1,
                fixed.0,
                fixed.1
            );
            out.push((CurvatureStage::Collineation, axis));
        }
        for k in [1, 0] {
            let (own, other) = (&rays.known[k], &rays.known[1 - k]);
            let (j, m, o) = (self.straight(own), self.moving(own), self.moving(other));
            let found = match rays.how[k] {
                RayMethod::Given => say!(lang, "the path of ${m}$ is straight: ${j} = {m}$"),
                RayMethod::Collineation(PlanePoint::Infinity(_)) => say!(
                    lang,
                    "the parallel to the axis through ${o}$ meets the ray of ${m}$ at ${j}$"
                ),
                RayMethod::Collineation(PlanePoint::At(_)) => {
                    let (q, a) = (format!("{}_{{{}}}", self.on_axis(), 2 - k), self.fixed(other));
                    say!(
                        lang,
                        "the parallel to the ray of ${m}$ through ${a}$ meets the axis at ${q}$; ${q}{o}$ meets the ray at ${j}$"
                    )
                }
                RayMethod::Proportion => say!(
                    lang,
                    "on the ray of ${m}$: $1/{pole}{j} = 1/{pole}{m} − 1/{pole}{}$ gives ${j}$ (Euler–Savary)",
                    self.fixed(own)
                ),
            };
            out.push((CurvatureStage::Straight(k), found));
        }
        let (jb, jc, j) = (self.straight(b), self.straight(c), self.letter("J", of));
        let stands = rays.normal() == Vec2::ZERO;
        let inflection = match stands {
            false => say!(
                lang,
                "the perpendiculars to the rays at ${jb}$ and ${jc}$ intersect at the inflection pole ${j}$"
            ),
            true => {
                say!(lang, "both fall on ${pole}$: it stands still, there is no inflection circle")
            }
        };
        out.push((CurvatureStage::Inflection, inflection));
        out
    }

    fn of_rolling(&self, of: &OfLink, _: &RollingWheel) -> Vec<(CurvatureStage, String)> {
        let (pole, j) = (self.pole(of), self.letter("J", of));
        let contact = say!(
            self.lang,
            "the link rolls on the other: the contact is the pole ${pole}$, the centres of both contours lie on the pole normal; $1/{pole}{j}$ = 1/(moving radius) − 1/(fixed radius), both counted from ${pole}$ along it"
        );
        vec![(CurvatureStage::Rolling, contact)]
    }

    fn of_point(&self, of: &OfLink, p: &OfPoint) -> Option<String> {
        let (drawn, h) = (p.drawn?, self.helper());
        let (pole, j, e, centre, lang) = (
            self.pole(of),
            self.letter("J", of),
            self.point(p.point),
            self.centre(p.point),
            self.lang,
        );
        let given = match &of.drawing {
            CurvatureDrawing::Rays(r) => r.known.iter().any(|k| k.why.moving() == Some(p.point)),
            CurvatureDrawing::Rolling(_)
            | CurvatureDrawing::Hinge(_)
            | CurvatureDrawing::Parallel(_)
            | CurvatureDrawing::OneLine(_)
            | CurvatureDrawing::NoRays => false,
        };
        if given {
            return None;
        }
        let radius =
            drawn.centre.at().map_or_else(String::new, |c| self.on_paper(c.distance(p.at)));
        Some(match drawn.centre {
            PlanePoint::Infinity(_) => {
                say!(lang, "${e}$ lies on the inflection circle: its path is straight")
            }
            PlanePoint::At(_) => say!(
                lang,
                "draw the perpendicular to ${pole}{e}$ at ${pole}$: it meets ${e}{j}$ at ${h}$; the parallel to ${pole}{j}$ through ${h}$ meets ${pole}{e}$ at ${centre}$, the centre of the path of ${e}$: ${e}{centre}$ = {radius} on paper"
            ),
        })
    }
}
