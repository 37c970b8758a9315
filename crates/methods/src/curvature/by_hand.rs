//! Tolerances of hand drawing: the construction drawn again and again by a hand whose marks miss.

use super::drawing::Traced;
use super::known::CurvaturePlaces;
use super::{LinkCurvatures, OfLink};
use hodograph_board::construct::pencil::{Hand, bounds};
use hodograph_board::construct::pencil_mm;

/// Bounds within which 95 of 100 drawings by hand fall (m); `None` if more than 5 of 100 fail.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvatureTolerances {
    /// The pencil error (mm).
    pub pencil_mm: f64,
    /// Displacement of the pole.
    pub pole: Option<f64>,
    /// Displacement of the inflection pole.
    pub inflection_pole: Option<f64>,
    /// Error of the diameter of the inflection circle.
    pub diameter: Option<f64>,
    /// Displacement of Ball's point.
    pub ball: Option<f64>,
    /// Error of the radius of curvature of each point of the link.
    pub radii: Vec<Option<f64>>,
}

impl LinkCurvatures {
    /// Adds the tolerances of hand drawing, for the scene's pencil or the usual one.
    pub fn with_drafting(mut self) -> LinkCurvatures {
        let all: Vec<Option<CurvatureTolerances>> =
            self.list.iter().map(|of| self.by_hand(of)).collect();
        self.list.iter_mut().zip(all).for_each(|(of, by_hand)| of.by_hand = by_hand);
        self
    }

    /// Returns the tolerances of a link's drawing; `None` if it finds no pole.
    fn by_hand(&self, of: &OfLink) -> Option<CurvatureTolerances> {
        let pencil_mm = pencil_mm(&self.scene.paper);
        let (pole, normal) = of.drawing.pole()?;
        let ball = of.drawing.ball();
        let radius = |t: Traced| t.centre.at().map(|c| c.distance(t.at));
        let exact = Hand::default();
        let drawn_by = |hand: &Hand| {
            let places = CurvaturePlaces {
                scene: &self.scene,
                at: &self.worked.configuration,
                against: self.against,
                hand,
            };
            let drawing = places.drawing_behind(of.link, &[]);
            let traced: Vec<Option<Traced>> =
                of.points.iter().map(|p| places.traced(&drawing, p.point)).collect();
            (drawing, traced)
        };
        drawn_by(&exact);
        let mu_l = self.worked.construction.diagram.mu;
        let mut bounds = bounds(pencil_mm, 4 + of.points.len(), |pencil| {
            let (drawing, traced) = drawn_by(&exact.again(pencil, mu_l));
            let drawn = drawing.pole();
            let of_pole = [
                drawn.map(|(p, _)| p.distance(pole)),
                drawn.map(|(p, n)| (p + n).distance(pole + normal)),
                drawn.map(|(_, n)| (n.norm() - normal.norm()).abs()),
                drawing.ball().zip(ball).map(|(p, q)| p.distance(q)),
            ];
            let radii = of.points.iter().zip(traced).map(|(p, traced)| {
                let (by_hand, exact) = (traced?, p.drawn?);
                Some((radius(by_hand)? - radius(exact)?).abs())
            });
            of_pole.into_iter().chain(radii).collect()
        })
        .into_iter();
        let mut next = || bounds.next().flatten();
        let [pole, inflection_pole, diameter, ball] = [next(), next(), next(), next()];
        Some(CurvatureTolerances {
            pencil_mm,
            pole,
            inflection_pole,
            diameter,
            ball,
            radii: bounds.collect(),
        })
    }
}
