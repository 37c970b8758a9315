//! The legend of a figure of curvature: the letters and lines that occur in it, each in a few
//! words.

use super::curvature::CurvatureWords;
use hodograph_base::geom::Vec2;
use hodograph_base::lang::{each, tr};
use hodograph_methods::curvature::OfLink;
use hodograph_methods::curvature::drawing::{CurvatureDrawing, RayMethod, Rays};
use hodograph_methods::curvature::motion::Bend;
use hodograph_paper::paper::phrase::Phrase;
use hodograph_scene::PointId;

impl CurvatureWords<'_> {
    /// Returns the legend of the construction of a link.
    pub fn legend(&self, of: &OfLink) -> Vec<Phrase> {
        let mut parts: Vec<String> = Vec::new();
        let mut add = |symbol: String, words: [&str; 2]| {
            parts.push(format!("${symbol}$ {}", self.lang.pick(words)))
        };
        let Some(pole) = of.pole() else { return Vec::new() };
        add(self.pole(of), each!("pole (instantaneous centre)"));
        if !pole.stands() {
            add("t".into(), each!("pole tangent"));
            add(self.letter("u", of), each!("velocity with which the pole moves"));
            add(
                self.letter("w", of),
                each!("inflection circle: points whose paths are straight here"),
            );
            add(self.letter("d", of), each!("its diameter"));
            add(self.letter("J", of), each!("inflection pole"));
            if pole.bresse.is_some() {
                add(
                    self.letter("b", of),
                    each!("Bresse's circle (dashed): points without tangential acceleration"),
                );
            }
            add(self.letter("K", of), each!("acceleration pole: the point without acceleration"));
            if pole.ball.is_some() {
                add(self.letter("U", of), each!("Ball's point: its path is straightest"));
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
            add("\\rho".into(), each!("radius of curvature of a point's path"));
        }
        if !found.is_empty() {
            add(found.join(", "), each!("centre of curvature of a point's path"));
        }
        if bent.iter().any(|p| p.drawn.is_some() && !on_ray(p.point)) && !pole.stands() {
            add(self.helper().into(), each!("helping point of the construction (Euler-Savary)"));
        }
        let separate = self.lang.semicolon();
        vec![Phrase::new(&parts.join(separate))]
    }

    /// Returns the legend of the centrodes of a link, in the label language.
    pub fn centrode_legend(&self, of: &OfLink) -> String {
        let pole = self.pole(of);
        let [is_pole, paths] = [
            tr!(self.lang, " pole"),
            tr!(self.lang, " its paths in the fixed and the moving plane"),
        ];
        format!("{pole}\\text{{{is_pole}}},\\quad p,\\,p'\\text{{{paths}}}")
    }

    fn legend_of_rays(&self, rays: &Rays, add: &mut dyn FnMut(String, [&str; 2])) {
        let straight = rays
            .known
            .iter()
            .zip(&rays.how)
            .filter(|(_, how)| **how != RayMethod::Given)
            .map(|(known, _)| self.straight(known));
        let straight: Vec<String> = straight.filter(|_| rays.normal() != Vec2::ZERO).collect();
        if !straight.is_empty() {
            add(straight.join(", "), each!("points of the rays whose paths are straight"));
        }
        if rays.collineation.is_some() {
            add(self.on_axis().into(), each!("on the collineation axis (Bobillier)"));
        }
    }
}
