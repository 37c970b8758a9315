//! The construction of pole, inflection circle and centres of curvature as sentences, one per step.

use super::curvature::CurvatureWords;
use hodograph_base::geom::Vec2;
use hodograph_methods::curvature::drawing::{CurvatureDrawing, RayMethod, Rays, RollingWheel};
use hodograph_methods::curvature::known::{CurvatureRay, CurvatureReason};
use hodograph_methods::curvature::plane::PlanePoint;
use hodograph_methods::curvature::{OfLink, OfPoint};
use hodograph_paper::paper::phrase::{Phrase, capital, tr};
use hodograph_scene::{Lang, PointId};

/// Returns the text with a capital first letter and a full stop.
fn sentence(text: String, lang: Lang) -> String {
    capital(&text) + tr(lang, ".", "。")
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
        let circle = match lang {
            Lang::En => format!(
                "draw the circle on the diameter ${pole}{j}$ ({measured} on paper), the inflection circle; the pole tangent $t$ is perpendicular to it at ${pole}$"
            ),
            Lang::Zh => format!(
                "以 ${pole}{j}$（图上 {measured}）为直径作圆，即拐点圆；过 ${pole}$ 作其垂线，即瞬心切线 $t$"
            ),
        };
        out.push((CurvatureStage::Circle, circle));
        let centre = |p: &OfPoint| Some((CurvatureStage::Centre(p.point), self.of_point(of, p)?));
        out.extend(of.points.iter().filter_map(centre));
        if of.read.is_some() {
            let k = self.letter("K", of);
            let sentence = match lang {
                Lang::En => format!(
                    "turn ${pole}{j}$ about ${pole}$ by the angle whose tangent is $\\alpha/\\omega^{{2}}$; the foot of the perpendicular from ${j}$ to it is the acceleration pole ${k}$"
                ),
                Lang::Zh => format!(
                    "将 ${pole}{j}$ 绕 ${pole}$ 转过正切为 $\\alpha/\\omega^{{2}}$ 的角，由 ${j}$ 向其作垂线，垂足即加速度瞬心 ${k}$"
                ),
            };
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
        match self.lang {
            Lang::En => [
                format!(
                    "the perpendiculars to the rays at ${b}$ and ${c}$ cut $t$ and the line ${pole}{j}$; the corners ${g}$ and ${h}$ complete the rectangles with the corner ${pole}$"
                ),
                format!(
                    "${g}{h}$ meets the parallel to $t$ through ${j}$ at ${corner}$; ${foot}$ is its foot on $t$; the foot of the perpendicular from ${pole}$ to ${foot}{j}$ is Ball's point ${u}$"
                ),
            ],
            Lang::Zh => [
                format!(
                    "过 ${b}$、${c}$ 分别作射线的垂线，与 $t$ 和直线 ${pole}{j}$ 相交；以交点和 ${pole}$ 为顶点作矩形，得 ${pole}$ 的对角顶点 ${g}$、${h}$"
                ),
                format!(
                    "${g}{h}$ 与过 ${j}$ 且平行于 $t$ 的直线交于 ${corner}$；由 ${corner}$ 向 $t$ 作垂线得垂足 ${foot}$；由 ${pole}$ 向 ${foot}{j}$ 作垂线，垂足即鲍尔点 ${u}$"
                ),
            ],
        }
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
        match (k.why, lang) {
            (CurvatureReason::Crank(_, _, by), Lang::En) => {
                format!(
                    "${moving}$ moves on a circle about ${fixed}$ (link {}): draw the ray ${fixed}{moving}$",
                    self.scene().link_name(by)
                )
            }
            (CurvatureReason::Crank(_, _, by), Lang::Zh) => {
                format!(
                    "${moving}$ 绕 ${fixed}$ 作圆周运动（构件 {}）：作射线 ${fixed}{moving}$",
                    self.scene().link_name(by)
                )
            }
            (CurvatureReason::Straight(..), Lang::En) => {
                format!(
                    "${moving}$ moves on a straight line: the ray is perpendicular to its guide, the centre lies at infinity"
                )
            }
            (CurvatureReason::Straight(..), Lang::Zh) => {
                format!("${moving}$ 沿直线运动：射线垂直于导路，曲率中心在无穷远处")
            }
            (CurvatureReason::Arc(..), Lang::En) => format!(
                "${moving}$ moves on an arc about ${fixed}$: draw the ray ${fixed}{moving}$"
            ),
            (CurvatureReason::Arc(..), Lang::Zh) => {
                format!("${moving}$ 沿以 ${fixed}$ 为中心的圆弧运动：作射线 ${fixed}{moving}$")
            }
            (CurvatureReason::Through(..), Lang::En) => format!(
                "a line of the link along its guide always leads through ${fixed}$: draw the ray perpendicular to it through ${fixed}$; the moving point lies at infinity"
            ),
            (CurvatureReason::Through(..), Lang::Zh) => {
                format!(
                    "构件上沿导路的直线始终通过 ${fixed}$：过 ${fixed}$ 作其垂线为射线，动点在无穷远处"
                )
            }
            (CurvatureReason::Borrowed(_, of), Lang::En) => format!(
                "${moving}$ belongs to link {} too, whose drawing gives the centre ${fixed}$ of its path: draw the ray ${fixed}{moving}$",
                self.scene().link_name(of)
            ),
            (CurvatureReason::Borrowed(_, of), Lang::Zh) => format!(
                "${moving}$ 又在构件 {} 上，由该构件的作图得其轨迹的曲率中心 ${fixed}$：作射线 ${fixed}{moving}$",
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
        let crossing = match lang {
            Lang::En => format!("the rays intersect at the pole ${pole}$"),
            Lang::Zh => format!("两射线交于瞬心 ${pole}$"),
        };
        out.push((CurvatureStage::Pole, crossing));
        let [b, c] = &rays.known;
        if let Some(q) = rays.collineation {
            let (moving, fixed) =
                ((self.moving(b), self.moving(c)), (self.fixed(b), self.fixed(c)));
            let at = if q.at().is_none() {
                tr(
                    lang,
                    " (at infinity: the axis is parallel to both)",
                    "（在无穷远处：轴与两线平行）",
                )
            } else {
                ""
            };
            let q = self.on_axis();
            let axis = match lang {
                Lang::En => format!(
                    "${}{}$ and ${}{}$ intersect at ${q}${at}; ${pole}{q}$ is the collineation axis (Bobillier)",
                    moving.0, moving.1, fixed.0, fixed.1
                ),
                Lang::Zh => {
                    format!(
                        "${}{}$ 与 ${}{}$ 交于 ${q}${at}；${pole}{q}$ 为共线轴（博比利尔）",
                        moving.0, moving.1, fixed.0, fixed.1
                    )
                }
            };
            out.push((CurvatureStage::Collineation, axis));
        }
        for k in [1, 0] {
            let (own, other) = (&rays.known[k], &rays.known[1 - k]);
            let (j, m, o) = (self.straight(own), self.moving(own), self.moving(other));
            let found = match (rays.how[k], lang) {
                (RayMethod::Given, Lang::En) => {
                    format!("the path of ${m}$ is straight: ${j} = {m}$")
                }
                (RayMethod::Given, Lang::Zh) => format!("${m}$ 的轨迹为直线：${j} = {m}$"),
                (RayMethod::Collineation(PlanePoint::Infinity(_)), Lang::En) => {
                    format!(
                        "the parallel to the axis through ${o}$ meets the ray of ${m}$ at ${j}$"
                    )
                }
                (RayMethod::Collineation(PlanePoint::Infinity(_)), Lang::Zh) => {
                    format!("过 ${o}$ 作共线轴的平行线，交 ${m}$ 的射线于 ${j}$")
                }
                (RayMethod::Collineation(PlanePoint::At(_)), _) => {
                    let (q, a) = (format!("{}_{{{}}}", self.on_axis(), 2 - k), self.fixed(other));
                    match lang {
                        Lang::En => format!(
                            "the parallel to the ray of ${m}$ through ${a}$ meets the axis at ${q}$; ${q}{o}$ meets the ray at ${j}$"
                        ),
                        Lang::Zh => format!(
                            "过 ${a}$ 作 ${m}$ 的射线的平行线，交共线轴于 ${q}$；${q}{o}$ 交该射线于 ${j}$"
                        ),
                    }
                }
                (RayMethod::Proportion, Lang::En) => {
                    format!(
                        "on the ray of ${m}$: $1/{pole}{j} = 1/{pole}{m} − 1/{pole}{}$ gives ${j}$ (Euler–Savary)",
                        self.fixed(own)
                    )
                }
                (RayMethod::Proportion, Lang::Zh) => {
                    format!(
                        "在 ${m}$ 的射线上由 $1/{pole}{j} = 1/{pole}{m} − 1/{pole}{}$ 得 ${j}$（欧拉–萨瓦里）",
                        self.fixed(own)
                    )
                }
            };
            out.push((CurvatureStage::Straight(k), found));
        }
        let (jb, jc, j) = (self.straight(b), self.straight(c), self.letter("J", of));
        let stands = rays.normal() == Vec2::ZERO;
        let inflection = match (lang, stands) {
            (Lang::En, false) => format!(
                "the perpendiculars to the rays at ${jb}$ and ${jc}$ intersect at the inflection pole ${j}$"
            ),
            (Lang::Zh, false) => format!("过 ${jb}$、${jc}$ 分别作射线的垂线，交于拐点极 ${j}$"),
            (Lang::En, true) => {
                format!("both fall on ${pole}$: it stands still, there is no inflection circle")
            }
            (Lang::Zh, true) => format!("两点都落在 ${pole}$ 上：瞬心不动，没有拐点圆"),
        };
        out.push((CurvatureStage::Inflection, inflection));
        out
    }

    fn of_rolling(&self, of: &OfLink, _: &RollingWheel) -> Vec<(CurvatureStage, String)> {
        let (pole, j) = (self.pole(of), self.letter("J", of));
        let contact = match self.lang {
            Lang::En => format!(
                "the link rolls on the other: the contact is the pole ${pole}$, the centres of both contours lie on the pole normal; $1/{pole}{j}$ = 1/(moving radius) − 1/(fixed radius), both counted from ${pole}$ along it"
            ),
            Lang::Zh => format!(
                "构件沿另一构件纯滚动：接触点即瞬心 ${pole}$，两廓线的中心在瞬心法线上；自 ${pole}$ 沿法线计，$1/{pole}{j}$ = 1/(动圆半径) − 1/(定圆半径)"
            ),
        };
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
        Some(match (drawn.centre, lang) {
            (PlanePoint::Infinity(_), Lang::En) => {
                format!("${e}$ lies on the inflection circle: its path is straight")
            }
            (PlanePoint::Infinity(_), Lang::Zh) => format!("${e}$ 在拐点圆上：其轨迹为直"),
            (PlanePoint::At(_), Lang::En) => format!(
                "draw the perpendicular to ${pole}{e}$ at ${pole}$: it meets ${e}{j}$ at ${h}$; the parallel to ${pole}{j}$ through ${h}$ meets ${pole}{e}$ at ${centre}$, the centre of the path of ${e}$: ${e}{centre}$ = {radius} on paper"
            ),
            (PlanePoint::At(_), Lang::Zh) => format!(
                "过 ${pole}$ 作 ${pole}{e}$ 的垂线，交 ${e}{j}$ 于 ${h}$；过 ${h}$ 作 ${pole}{j}$ 的平行线，交 ${pole}{e}$ 于 ${centre}$，即 ${e}$ 轨迹的曲率中心，图上 ${e}{centre}$ = {radius}"
            ),
        })
    }
}
