//! Tolerances of hand drawing: the centres drawn again and again by a hand whose marks miss.

use super::lines::CentrePlace;
use super::velocities::Velocities;
use super::{Centre, Centres, locate};
use hodograph_board::construct::pencil::{Hand, bounds};
use hodograph_board::construct::pencil_mm;

/// Bounds within which the centres of 95 of 100 drawings by hand fall.
#[derive(Clone, Debug, PartialEq)]
pub struct CentreTolerances {
    /// The pencil error (mm).
    pub pencil_mm: f64,
    /// Displacement of each centre (m) in the order of [`Centres::list`]; `None` for centres at
    /// infinity or without a place, and where more than 5 of 100 drawings fail.
    pub centres: Vec<Option<f64>>,
}

impl Centres {
    /// Adds the tolerances of hand drawing, for the scene's pencil or the usual one.
    pub fn with_drafting(mut self) -> Centres {
        let pencil_mm = pencil_mm(&self.scene.paper);
        let velocities = Velocities::of(&self.scene, &self.worked);
        let mu_l = self.worked.construction.diagram.mu;
        let centres = bounds(pencil_mm, self.list.len(), |pencil| {
            let hand = Hand::with(pencil, mu_l);
            let drawn = locate::again(
                &self.scene,
                &self.worked,
                &self.closure,
                &velocities,
                &self.list,
                &hand,
            );
            let error = |(exact, drawn): (&Centre, Option<CentrePlace>)| {
                Some(exact.place?.point()?.distance(drawn?.point()?))
            };
            self.list.iter().zip(drawn).map(error).collect()
        });
        self.by_hand = Some(CentreTolerances { pencil_mm, centres });
        self
    }
}

#[cfg(test)]
mod tests {
    use crate::centres::{CentreMethod, CentrePlace, centres};
    use hodograph_scene::{read, templates};

    /// A pin misses by the pencil error alone, a crossing by no less than some of it; all go with
    /// the pencil.
    #[test]
    fn tolerances_of_centres_go_with_the_pencil() {
        let (mut pins, mut crossings) = (0, 0);
        for name in ["shaper", "crank-rocker", "slider-crank", "whitworth", "geared-five-bar"] {
            let of = |pencil_mm: f64| {
                let mut scene = read(templates::get(name).unwrap()).unwrap().value;
                scene.paper.pencil_mm = Some(pencil_mm);
                centres(&scene).unwrap().value.with_drafting()
            };
            let (fine, blunt) = (of(0.01), of(0.02));
            let miss = 0.01e-3 * fine.worked.construction.diagram.mu * 1e3;
            let bounds = |c: &super::Centres| c.by_hand.clone().unwrap().centres;
            for ((c, a), b) in fine.list.iter().zip(bounds(&fine)).zip(bounds(&blunt)) {
                let Some(CentrePlace::At(_)) = c.place else {
                    assert_eq!(a, None);
                    continue;
                };
                let (Some(a), Some(b)) = (a, b) else { continue };
                if a == 0.0 {
                    continue;
                }
                assert!(
                    (1.7..2.3).contains(&(b / a)),
                    "{name} {}: {a} {b}",
                    c.step.pair.name(&fine.scene)
                );
                match c.step.how {
                    CentreMethod::Primary(_) => {
                        assert!((0.8..1.2).contains(&(a / miss)), "{name}: {a} of {miss}");
                        pins += 1;
                    }
                    CentreMethod::Lines(_) | CentreMethod::Velocities => crossings += 1,
                }
            }
        }
        assert!(pins > 15 && crossings > 10, "{pins} pins, {crossings} crossings");
    }
}
