//! The legend of a figure of curvature: the letters and lines that occur in it, each in a few
//! words.

use super::curvature::CurvatureWords;
use hodograph_base::geom::Vec2;
use hodograph_methods::curvature::OfLink;
use hodograph_methods::curvature::drawing::{CurvatureDrawing, RayMethod, Rays};
use hodograph_methods::curvature::motion::Bend;
use hodograph_paper::paper::phrase::{Phrase, tr};
use hodograph_scene::{Lang, PointId};

impl CurvatureWords<'_> {
    /// Returns the legend of the construction of a link.
    pub fn legend(&self, of: &OfLink) -> Vec<Phrase> {
        let mut parts: Vec<String> = Vec::new();
        let mut add = |symbol: String, en: &'static str, zh: &'static str| {
            parts.push(format!("${symbol}$ {}", tr(self.lang, en, zh)))
        };
        let Some(pole) = of.pole() else { return Vec::new() };
        add(self.pole(of), "pole (instantaneous centre)", "瞬心");
        if !pole.stands() {
            add("t".into(), "pole tangent", "瞬心切线");
            add(self.letter("u", of), "velocity with which the pole moves", "瞬心的移动速度");
            add(
                self.letter("w", of),
                "inflection circle: points whose paths are straight here",
                "拐点圆：其上各点轨迹在此处曲率为零",
            );
            add(self.letter("d", of), "its diameter", "其直径");
            add(self.letter("J", of), "inflection pole", "拐点极");
            if pole.bresse.is_some() {
                add(
                    self.letter("b", of),
                    "Bresse's circle (dashed): points without tangential acceleration",
                    "布雷斯圆（虚线）：其上各点切向加速度为零",
                );
            }
            add(
                self.letter("K", of),
                "acceleration pole: the point without acceleration",
                "加速度瞬心：加速度为零的点",
            );
            if pole.ball.is_some() {
                add(
                    self.letter("U", of),
                    "Ball's point: its path is straightest",
                    "鲍尔点：轨迹最接近直线",
                );
            }
        }
        if let CurvatureDrawing::Rays(rays) = &of.drawing {
            self.legend_of_rays(rays, &mut add);
        }
        // Points with a centre of curvature; `found` omits those with a centre given by a ray.
        let bent: Vec<_> = of.points.iter().filter(|p| matches!(p.bend, Bend::About(..))).collect();
        let on_ray = |p: PointId| matches!(&of.drawing, CurvatureDrawing::Rays(rays) if rays.known.iter().any(|k| k.why.moving() == Some(p)));
        let found: Vec<String> =
            bent.iter().filter(|p| !on_ray(p.point)).map(|p| self.centre(p.point)).collect();
        if !bent.is_empty() {
            add("\\rho".into(), "radius of curvature of a point's path", "点轨迹的曲率半径");
        }
        if !found.is_empty() {
            add(found.join(", "), "centre of curvature of a point's path", "点轨迹的曲率中心");
        }
        if bent.iter().any(|p| p.drawn.is_some() && !on_ray(p.point)) && !pole.stands() {
            add(
                self.helper().into(),
                "helping point of the construction (Euler-Savary)",
                "作图辅助点（欧拉–萨瓦里）",
            );
        }
        let separate = match self.lang {
            Lang::En => "; ",
            Lang::Zh => "；",
        };
        vec![Phrase::new(&parts.join(separate))]
    }

    /// Returns the legend of the centrodes of a link, in the label language.
    pub fn centrode_legend(&self, of: &OfLink) -> String {
        let pole = self.pole(of);
        let [is_pole, paths] = match self.lang {
            Lang::En => [" pole", " its paths in the fixed and the moving plane"],
            Lang::Zh => [" 瞬心", " 瞬心在定平面与动平面中的轨迹"],
        };
        format!("{pole}\\text{{{is_pole}}},\\quad p,\\,p'\\text{{{paths}}}")
    }

    fn legend_of_rays(&self, rays: &Rays, add: &mut dyn FnMut(String, &'static str, &'static str)) {
        let straight = rays
            .known
            .iter()
            .zip(&rays.how)
            .filter(|(_, how)| **how != RayMethod::Given)
            .map(|(known, _)| self.straight(known));
        let straight: Vec<String> = straight.filter(|_| rays.normal() != Vec2::ZERO).collect();
        if !straight.is_empty() {
            add(
                straight.join(", "),
                "points of the rays whose paths are straight",
                "射线与拐点圆的交点",
            );
        }
        if rays.collineation.is_some() {
            add(
                self.on_axis().into(),
                "on the collineation axis (Bobillier)",
                "共线轴上的点（博比利尔）",
            );
        }
    }
}
