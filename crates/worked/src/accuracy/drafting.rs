//! The accuracy of drawing by hand: the tolerance of every reading, derived step by step.
//!
//! Each mark of the construction is displaced by itself while all other steps are repeated exactly;
//! the change of the answers is the sensitivity to that mark. Marks miss independently and normally
//! ([`Blunt`](hodograph_board::construct::pencil::Blunt)), so the variances of their effects add up
//! (the square root of the sum of squares), and the tolerance is the radius within which 95 % of
//! the answers fall. It is of first order: true while it is small relative to the answer, and a
//! warning otherwise. [`simulate`](super::simulate()) is the check.

use super::larger::{Larger, larger};
use hodograph_base::diag::Faults;
use hodograph_base::geom::{Point, Vec2};
use hodograph_board::construct::pencil::{Pencil, WITHIN, radius_in_deviations};
use hodograph_board::construct::{Layout, PlanDrawing, by_hand, read_by_hand, scale, source};
use hodograph_board::equilibrium::Equilibrium;
use hodograph_board::plan::{Plan, VertexId};
use hodograph_mechanism::answer::{AnswerValue, MotionSource, evaluate};
use hodograph_mechanism::mechanism::{Level, Mechanism};
use hodograph_mechanism::position::Configuration;
use hodograph_scene::quantity::Forces;
use hodograph_scene::{Asked, ByKind, DiagramKind, Kind, LinkId, PointId, Scene};

/// A finished construction with everything that is needed to draw it again.
#[derive(Clone, Debug)]
pub struct DraftedConstruction<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The topology.
    pub mechanism: &'a Mechanism,
    /// The true positions.
    pub configuration: &'a Configuration,
    /// The equations.
    pub plan: &'a Plan,
    /// The exact drawing.
    pub construction: &'a PlanDrawing,
    /// The exact drawing of the forces, if they are drawn.
    pub equilibrium: Option<&'a Equilibrium>,
    /// The true answers, one for each question; `None` for questions that are not drawn.
    pub values: Vec<Option<AnswerValue>>,
}

impl DraftedConstruction<'_> {
    /// Returns width and height of a drawing (mm).
    pub fn size_mm(&self, on: DiagramKind) -> [f64; 2] {
        if on == DiagramKind::Force {
            return self.equilibrium.map_or([0.0; 2], Equilibrium::size_mm);
        }
        match self.construction.polygon(on) {
            Some(p) => p.extent().map(|s| s / p.mu),
            None => scale::size(self.scene, self.configuration)
                .map(|s| s / self.construction.diagram.mu),
        }
    }

    /// Draws the construction with a pencil, and returns the readings: one value for each question,
    /// `None` for questions that are not drawn.
    ///
    /// # Errors
    /// Two lines that the pencil made parallel.
    pub fn read_with<P: Pencil>(
        &self,
        layout: &Layout,
        pencil: &mut P,
    ) -> Result<Vec<Option<AnswerValue>>, Faults> {
        let (scene, m, plan) = (self.scene, self.mechanism, self.plan);
        let (paper, shown) =
            by_hand(&self.construction.acts, scene, self.configuration, plan, layout, pencil)?;
        let mut read = read_by_hand(scene, m, &shown, plan, &paper, pencil);
        if let Some(equilibrium) = self.equilibrium {
            let motion = source(scene, m, plan, &paper);
            let forces =
                equilibrium.by_hand(scene, m, self.configuration, &motion, pencil).map(Reactions);
            for (find, value) in
                scene.find.iter().zip(&mut read).filter(|(f, _)| matches!(f.what, Asked::Force(_)))
            {
                *value = forces
                    .as_ref()
                    .and_then(|drawn| evaluate(scene, self.configuration, drawn, &find.what));
            }
        }
        Ok(read
            .into_iter()
            .zip(&self.values)
            .map(|(r, v)| if v.is_some() { r } else { None })
            .collect())
    }
}

/// The forces of one drawing as a source of answers.
struct Reactions(Forces);

impl MotionSource<f64> for Reactions {
    fn vector(&self, _: Level, _: PointId, _: Option<LinkId>) -> Option<Vec2> {
        None
    }

    fn turning(&self, _: Level, _: LinkId) -> Option<f64> {
        None
    }

    fn forces(&self) -> Option<&Forces> {
        Some(&self.0)
    }
}

/// The tolerances of a construction drawn by hand.
#[derive(Clone, Debug, PartialEq)]
pub struct Drafting {
    /// The pencil error: 95 % of the marks fall within it (mm).
    pub pencil_mm: f64,
    /// The tolerance for each question; `None` if it is not drawn, if nothing moves, or if a mark's
    /// error may undo the drawing; `None` for all questions in a drawing of more than a thousand
    /// marks.
    pub tolerances: Vec<Option<Tolerance>>,
    /// Every crossing, in drawing order.
    pub crossings: Vec<CrossingTolerance>,
}

/// The tolerance of one reading.
#[derive(Clone, Debug, PartialEq)]
pub struct Tolerance {
    /// The radius (SI) about the true answer that contains 95 % of the readings (for a vector: a
    /// circle about its end).
    pub absolute: f64,
    /// The tolerance as a part of the answer; `None` for an answer of zero, and for coordinates and
    /// angles, which have an arbitrary zero.
    pub relative: Option<f64>,
    /// The part of `absolute` from marks on the diagram, the velocity and the acceleration polygon,
    /// each alone.
    pub parts: ByKind,
    /// The enlargement of the drawings for 1 %; `None` if `relative` is.
    pub larger: Option<Larger>,
}

/// A crossing and the effect of a pencil error on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrossingTolerance {
    /// The drawing: [`DiagramKind::Plane`] for the special point of a triad on the diagram.
    pub on: DiagramKind,
    /// The vertex found.
    pub target: VertexId,
    /// The sine of the angle between the lines, signed from the first to the second.
    pub sine: f64,
    /// The displacement of the crossing by one line that misses by the pencil error: e / |sine|
    /// (mm).
    pub moves_mm: f64,
    /// The displacement through μ, in SI.
    pub moves: f64,
}

/// The length of the longest sheet (mm): the long side of A0.
const LONGEST_SHEET_MM: f64 = 1189.0;

impl CrossingTolerance {
    /// Returns `moves_mm`, unless that leaves every sheet.
    pub fn moves_on_paper_mm(&self) -> Option<f64> {
        (self.moves_mm <= LONGEST_SHEET_MM).then_some(self.moves_mm)
    }

    /// Returns the angle between the lines, in degrees from 0 to 90.
    pub fn angle_deg(&self) -> f64 {
        libm::asin(self.sine.abs().min(1.0)).to_degrees()
    }
}

/// Returns every crossing of a construction with the effect of a pencil error (mm) on it, in
/// drawing order.
pub fn crossings(paper: &PlanDrawing, pencil_mm: f64) -> Vec<CrossingTolerance> {
    let mut all = Vec::new();
    for on in DiagramKind::OF_MOTION {
        let mu = paper.polygon(on).map_or(paper.diagram.mu, |p| p.mu);
        all.extend(paper.crossings(on).into_iter().map(|c| {
            let moves_mm = pencil_mm / c.sine.abs();
            CrossingTolerance { on, target: c.target, sine: c.sine, moves_mm, moves: moves_mm * mu }
        }));
    }
    all
}

/// Returns the tolerances of all readings for a pencil error (mm).
///
/// The cost is four drawings for each mark: some hundred microseconds for a four-bar, some
/// milliseconds for ten links.
pub fn drafting(drawn: &DraftedConstruction, pencil_mm: f64) -> Drafting {
    let layout = Layout::of(drawn.construction);
    let spreads = spreads(drawn, &layout, pencil_mm / radius_in_deviations());
    let tolerances = drawn.values.iter().enumerate().map(|(find, value)| {
        // Without motion there is no polygon, no scale, and nothing to read.
        if drawn.size_mm(drawn.scene.find[find].what.diagram()) == [0.0, 0.0] {
            return None;
        }
        let spread = spreads.as_ref()?[find].as_ref()?;
        let value = (*value)?;
        let absolute = spread.total().radius(WITHIN);
        let free = drawn.scene.find[find].what.entry().from_origin;
        let relative = (!free && value.magnitude() > 0.0).then(|| absolute / value.magnitude());
        let parts = spread.0.map(|c| c.radius(WITHIN));
        let larger = relative.map(|r| larger(&drawn.scene.paper, drawn, &layout, r, &parts));
        absolute.is_finite().then_some(Tolerance { absolute, relative, parts, larger })
    });
    Drafting {
        pencil_mm,
        tolerances: tolerances.collect(),
        crossings: crossings(drawn.construction, pencil_mm),
    }
}

/// A pencil that displaces one mark, or only records the drawing of each mark.
struct DisplacedPencil {
    marks: Vec<DiagramKind>,
    count: usize,
    displaced: Option<(usize, Vec2)>,
}

impl Pencil for DisplacedPencil {
    const EXACT: bool = false;

    fn mark(&mut self, on: DiagramKind, at: Point) -> Point {
        let here = self.count;
        self.count += 1;
        match self.displaced {
            None => {
                self.marks.push(on);
                at
            }
            Some((step, by)) if step == here => at + by,
            Some(_) => at,
        }
    }
}

/// The displacement of a mark for the derivatives, as a part (2⁻²⁰) of its drawing's larger side.
/// It is small enough for linear answers even at flat crossings, and the rounding of the drawing,
/// 1e-16 of that side, leaves ten digits.
const STEP: f64 = 1.0 / 1_048_576.0;

/// The greatest number of marks. Each mark is displaced by itself and the rest drawn again: the
/// work grows with the square of the marks. Ten links have some hundred.
const MOST_MARKS: usize = 1000;

/// The covariances of the answers for marks that miss by `deviation_mm` in x and in y; `None` if a
/// displaced mark undoes the drawing, or if there are more than [`MOST_MARKS`].
fn spreads(
    drawn: &DraftedConstruction,
    layout: &Layout,
    deviation_mm: f64,
) -> Option<Vec<Option<Spread>>> {
    let mut first = DisplacedPencil { marks: Vec::new(), count: 0, displaced: None };
    let base = drawn.read_with(layout, &mut first).ok()?;
    if first.marks.len() > MOST_MARKS {
        return None;
    }
    let mut all: Vec<Option<Spread>> = base.iter().map(|v| v.map(|_| Spread::default())).collect();
    let step_mm = |on: DiagramKind| {
        let [w, h] = drawn.size_mm(on);
        (on.kind(), w.max(h) * STEP)
    };
    let steps_mm: ByKind = DiagramKind::ALL.into_iter().map(step_mm).collect();
    for (mark, on) in first.marks.iter().enumerate() {
        let h = steps_mm.get(on.kind()).unwrap_or(0.0);
        // A drawing that is a single point (nothing moves) has no marks.
        if h == 0.0 {
            continue;
        }
        for axis in [Vec2::new(h, 0.0), Vec2::new(0.0, h)] {
            let at = |by: Vec2| {
                let mut pencil =
                    DisplacedPencil { marks: Vec::new(), count: 0, displaced: Some((mark, by)) };
                drawn.read_with(layout, &mut pencil).ok()
            };
            let (ahead, behind) = (at(axis)?, at(-axis)?);
            for (find, spread) in all.iter_mut().enumerate() {
                if let (Some(spread), Some(a), Some(b)) = (spread, ahead[find], behind[find]) {
                    let change = difference(&drawn.scene.find[find].what, a, b);
                    spread.on(*on).add(change * (0.5 * deviation_mm / h));
                }
            }
        }
    }
    Some(all)
}

/// The difference of two answers, a number as a vector along x; angles by the shorter way round.
pub(super) fn difference(what: &Asked, a: AnswerValue, b: AnswerValue) -> Vec2 {
    match (a, b) {
        (AnswerValue::Vector(a), AnswerValue::Vector(b)) => a - b,
        (AnswerValue::Point(a), AnswerValue::Point(b)) => a - b,
        (AnswerValue::Scalar(a), AnswerValue::Scalar(b)) if what.kind() == Kind::Angle => {
            Vec2::new(Vec2::from_angle(a - b).angle(), 0.0)
        }
        (AnswerValue::Scalar(a), AnswerValue::Scalar(b)) => Vec2::new(a - b, 0.0),
        (AnswerValue::Vector(_) | AnswerValue::Scalar(_) | AnswerValue::Point(_), _) => {
            Vec2::new(f64::INFINITY, 0.0)
        }
    }
}

/// The covariances of one answer, by the drawing on which the marks were made.
#[derive(Clone, Debug, Default)]
struct Spread(ByKind<Covariance>);

impl Spread {
    /// The covariance of one drawing.
    fn on(&mut self, on: DiagramKind) -> &mut Covariance {
        self.0.entry(on.kind())
    }

    fn total(&self) -> Covariance {
        self.0.values().fold(Covariance::default(), |a, b| Covariance {
            xx: a.xx + b.xx,
            xy: a.xy + b.xy,
            yy: a.yy + b.yy,
        })
    }
}

/// The covariance of an error in the plane.
#[derive(Clone, Copy, Debug, Default)]
struct Covariance {
    xx: f64,
    xy: f64,
    yy: f64,
}

impl Covariance {
    /// Adds the effect of one mark displaced by its deviation.
    fn add(&mut self, v: Vec2) {
        self.xx += v.x * v.x;
        self.xy += v.x * v.y;
        self.yy += v.y * v.y;
    }

    /// The radius that contains a part `p` of normal errors of this covariance.
    ///
    /// With the principal deviations s₁ ≥ s₂ the error is ρ(s₁ cos φ, s₂ sin φ), with ρ Rayleigh
    /// distributed and φ uniform, so that the part within R is the mean over φ of 1 − exp(−R²/2h),
    /// h = s₁² cos²φ + s₂² sin²φ. For s₂ = 0 this is the error function (Craig's form), for s₂ = s₁
    /// Rayleigh's law. The mean over equal steps of a smooth periodic function converges faster
    /// than any power.
    fn radius(&self, p: f64) -> f64 {
        const STEPS: usize = 32;
        let (mean, half) =
            (0.5 * (self.xx + self.yy), libm::hypot(0.5 * (self.xx - self.yy), self.xy));
        let (large, small) = (mean + half, (mean - half).max(0.0));
        if large == 0.0 || !large.is_finite() {
            return large.sqrt();
        }
        let ratio = small / large;
        let outside = |r: f64| -> f64 {
            let at = |k: usize| {
                let c = libm::cos((k as f64 + 0.5) * std::f64::consts::FRAC_PI_2 / STEPS as f64);
                libm::exp(-0.5 * r * r / (c * c + ratio * (1.0 - c * c)))
            };
            (0..STEPS).map(at).sum::<f64>() / STEPS as f64
        };
        // In units of s₁ the radius is between that of an error along one line and that of one
        // equal in all directions.
        let (mut lo, mut hi) = (0.0, (-2.0 * libm::log(1.0 - p)).sqrt());
        for _ in 0..52 {
            let mid = 0.5 * (lo + hi);
            if outside(mid) > 1.0 - p { lo = mid } else { hi = mid }
        }
        0.5 * (lo + hi) * large.sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn radii_of_known_laws() {
        // The textbook 1.96 of one dimension, the 2.448 of two.
        let line = Covariance { xx: 4.0, xy: 0.0, yy: 0.0 };
        assert!((line.radius(0.95) - 2.0 * 1.959_964).abs() < 1e-5);
        assert!((line.radius(0.5) - 2.0 * 0.674_490).abs() < 1e-5);
        let disc = Covariance { xx: 4.0, xy: 0.0, yy: 4.0 };
        assert!((disc.radius(0.95) - 2.0 * radius_in_deviations()).abs() < 1e-9);
        // A turn by 45° changes nothing.
        let turned = Covariance { xx: 2.0, xy: 2.0, yy: 2.0 };
        assert!((turned.radius(0.95) - line.radius(0.95)).abs() < 1e-9);
        assert_eq!(Covariance::default().radius(0.95), 0.0);
    }
}
