//! Answers drawn on separate figures: instantaneous centres by two lines, and quantities of a pole
//! by ruler construction.

use hodograph_mechanism::answer::AnswerValue;
use hodograph_methods::centres::{CentrePlace, Centres, Origin, centres};
use hodograph_methods::curvature::plane::PlanePoint;
use hodograph_methods::curvature::{self, LinkCurvatures, OfLink, couplers, curvature};
use hodograph_scene::quantity::combined::combine;
use hodograph_scene::quantity::{Curvature as Bend, InstantCentre, OfPath, OfPole};
use hodograph_scene::{Asked, LinkId, PointId, Scene};
use hodograph_worked::worked::Worked;
use std::cell::OnceCell;

/// Returns for each question the value on a figure of centres or of curvature; `None` if neither
/// draws it.
pub fn drawn(scene: &Scene, worked: &Worked) -> Vec<Option<AnswerValue>> {
    let figures = Figures { scene, worked, centres: OnceCell::new() };
    scene.find.iter().map(|f| figures.value(&f.what)).collect()
}

struct Figures<'a> {
    scene: &'a Scene,
    worked: &'a Worked,
    centres: OnceCell<Option<Centres>>,
}

impl Figures<'_> {
    fn value(&self, what: &Asked) -> Option<AnswerValue> {
        match what {
            Asked::InstantCentre(q) => self.centre(q).map(AnswerValue::Point),
            Asked::FromCentre(q) => {
                let at = self.worked.configuration.points[q.point.0]?;
                Some(AnswerValue::Scalar(self.centre(&q.centre)?.distance(at)))
            }
            Asked::Curvature(Bend::Pole([(link, _), (against, _)], of)) => {
                let found = self.bends(*link, *against, Vec::new())?;
                pole(found.list.first()?, *of)
            }
            Asked::Curvature(Bend::Path(p, of)) => {
                let carries = |l: &LinkId| self.scene.links[l.0].points.contains(&p.point);
                let link = p.link.or_else(|| couplers(self.scene).into_iter().find(carries))?;
                let found = self.bends(link, self.scene.ground, vec![p.point])?;
                let of_point = found.list.first()?.points.iter().find(|q| q.point == p.point)?;
                let PlanePoint::At(centre) = of_point.drawn?.centre else { return None };
                match of {
                    OfPath::Radius => Some(AnswerValue::Scalar(centre.distance(of_point.at))),
                    OfPath::Centre => Some(AnswerValue::Point(centre)),
                    _ => None,
                }
            }
            Asked::Combined(c) => {
                let [a, b] = c.operands.map(|q| self.value(&q.asked()));
                combine(c.operation, a?, b?)
            }
            Asked::PointMotion(_)
            | Asked::Relative(_)
            | Asked::Sliding(_)
            | Asked::Composite(_)
            | Asked::Turning(_)
            | Asked::Place(_)
            | Asked::CamQuantity(_)
            | Asked::Ratio(_)
            | Asked::RollerSpin(_)
            | Asked::Transmission(_)
            | Asked::Force(_)
            | Asked::Curvature(_) => None,
        }
    }

    /// Returns a centre by ruler construction: from its pair, or by two lines.
    fn centre(&self, q: &InstantCentre) -> Option<hodograph_base::geom::Point> {
        let found = self
            .centres
            .get_or_init(|| centres(self.scene).ok().map(|found| found.value))
            .as_ref()?;
        let c = found.of(q.links[0].0, q.links[1].0)?;
        match (c.origin.as_ref()?, c.place?) {
            (Origin::Pair | Origin::Crossing(_), CentrePlace::At(at)) => Some(at),
            _ => None,
        }
    }

    fn bends(&self, link: LinkId, against: LinkId, points: Vec<PointId>) -> Option<LinkCurvatures> {
        let asked =
            curvature::CurvatureRequest { links: vec![link], against: Some(against), points };
        curvature(self.scene, &asked).ok().map(|found| found.value)
    }
}

/// Returns a quantity of a pole by ruler construction.
fn pole(of_link: &OfLink, of: OfPole) -> Option<AnswerValue> {
    let drawn = of_link.drawn()?;
    match of {
        OfPole::InflectionPole => Some(AnswerValue::Point(drawn.pole + drawn.normal)),
        OfPole::Diameter => Some(AnswerValue::Scalar(drawn.normal.norm())),
        OfPole::AccelerationPole => drawn.acceleration_pole.map(AnswerValue::Point),
        OfPole::PoleVelocity => drawn.pole_velocity.map(AnswerValue::Vector),
        // Nothing is drawn in the axes of a rotating link.
        _ => None,
    }
}
