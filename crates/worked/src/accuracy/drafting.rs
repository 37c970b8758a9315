//! The accuracy of drawing by hand: the tolerance of every reading, derived step by step.
//!
//! The construction is drawn once in numbers that record their operations ([`Taped`]). The
//! derivatives of an answer by all marks follow from the record: each is the sensitivity to a mark
//! that is displaced by itself while all other steps are exact. Marks miss independently and normally
//! ([`Blunt`](hodograph_board::construct::pencil::Blunt)), so the variances of their effects add up
//! (the square root of the sum of squares), and the tolerance is the radius within which 95 % of
//! the answers fall. It is of first order: true while it is small relative to the answer, and a
//! warning otherwise. [`simulate`](super::simulate()) is the check.

use super::larger::{Larger, larger};
use hodograph_base::diag::Faults;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::{Real, Tape, Taped};
use hodograph_board::construct::pencil::{Pencil, WITHIN, radius_in_deviations};
use hodograph_board::construct::{Layout, PlanDrawing, by_hand, read_by_hand, scale, source};
use hodograph_board::equilibrium::Equilibrium;
use hodograph_board::plan::{Plan, VertexId};
use hodograph_mechanism::answer::{AnswerValue, MotionSource, evaluate};
use hodograph_mechanism::mechanism::{Level, Mechanism};
use hodograph_mechanism::position::Configuration;
use hodograph_scene::quantity::Forces;
use hodograph_scene::{Asked, ByKind, DiagramKind, Find, LinkId, PointId, Scene};
use std::sync::LazyLock;

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
        self.read_in(self.configuration, layout, pencil)
    }

    /// Draws and reads in the numbers of `at`, the true positions.
    fn read_in<N: Real, P: Pencil<N>>(
        &self,
        at: &Configuration<N>,
        layout: &Layout,
        pencil: &mut P,
    ) -> Result<Vec<Option<AnswerValue<N>>>, Faults> {
        let (scene, m, plan) = (self.scene, self.mechanism, self.plan);
        let (paper, shown) = by_hand(&self.construction.acts, scene, at, plan, layout, pencil)?;
        let mut read = read_by_hand(scene, m, &shown, plan, &paper, pencil);
        if let Some(equilibrium) = self.equilibrium {
            let motion = source(scene, m, plan, &paper);
            let forces = equilibrium.by_hand(scene, m, at, &motion, pencil).map(Reactions);
            for (find, value) in
                scene.find.iter().zip(&mut read).filter(|(f, _)| matches!(f.what, Asked::Force(_)))
            {
                *value = forces.as_ref().and_then(|drawn| evaluate(scene, at, drawn, &find.what));
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
struct Reactions<N>(Forces<N>);

impl<N> MotionSource<N> for Reactions<N> {
    fn vector(&self, _: Level, _: PointId, _: Option<LinkId>) -> Option<Vec2<N>> {
        None
    }

    fn turning(&self, _: Level, _: LinkId) -> Option<N> {
        None
    }

    fn forces(&self) -> Option<&Forces<N>> {
        Some(&self.0)
    }
}

/// The tolerances of a construction drawn by hand.
#[derive(Clone, Debug, PartialEq)]
pub struct Drafting {
    /// The pencil error: 95 % of the marks fall within it (mm).
    pub pencil_mm: f64,
    /// The tolerance for each question; `None` if it is not drawn, if nothing moves, or if it has no
    /// finite derivative by a mark; `None` for all questions in a drawing of more than a thousand
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
pub fn drafting(drawn: &DraftedConstruction, pencil_mm: f64) -> Drafting {
    let layout = Layout::of(drawn.construction);
    let tolerances = Spread::of_readings(drawn, &layout, pencil_mm).into_iter().enumerate();
    let tolerances = tolerances.map(|(find, spread)| {
        let spread = spread?;
        let (absolute, relative) = spread.tolerance(drawn, find)?;
        let parts = spread.0.map(|c| c.radius(WITHIN));
        let larger = relative.map(|r| larger(&drawn.scene.paper, drawn, &layout, r, &parts));
        Some(Tolerance { absolute, relative, parts, larger })
    });
    Drafting {
        pencil_mm,
        tolerances: tolerances.collect(),
        crossings: crossings(drawn.construction, pencil_mm),
    }
}

/// Returns [`Tolerance::relative`] of all readings for a pencil error (mm).
pub fn relative_tolerances(drawn: &DraftedConstruction, pencil_mm: f64) -> Vec<Option<f64>> {
    let spreads = Spread::of_readings(drawn, &Layout::of(drawn.construction), pencil_mm);
    let relative = |(find, spread): (usize, Option<Spread>)| spread?.tolerance(drawn, find)?.1;
    spreads.into_iter().enumerate().map(relative).collect()
}

/// A pencil that puts every mark at its intended place, with a variable displacement.
struct TapedPencil<'a> {
    tape: &'a Tape,
    /// The displacements of the marks.
    marks: Vec<(DiagramKind, Vec2<Taped<'a>>)>,
}

impl<'a> Pencil<Taped<'a>> for TapedPencil<'a> {
    const EXACT: bool = false;

    fn mark(&mut self, on: DiagramKind, at: Point<Taped<'a>>) -> Point<Taped<'a>> {
        let displaced = Vec2::ZERO.map(|zero| self.tape.variable(zero));
        self.marks.push((on, displaced));
        at + displaced
    }
}

/// The greatest number of marks; ten links have some hundred. The work grows with marks times
/// answers.
const MOST_MARKS: usize = 1000;

/// The covariances of one answer, by the drawing on which the marks were made.
#[derive(Clone, Debug, Default)]
struct Spread(ByKind<Covariance>);

impl Spread {
    /// Returns the covariances of all readings for marks with a pencil error (mm). All are `None`
    /// if the drawing has more than [`MOST_MARKS`].
    fn of_readings(
        drawn: &DraftedConstruction,
        layout: &Layout,
        pencil_mm: f64,
    ) -> Vec<Option<Spread>> {
        let tape = Tape::default();
        let mut pencil = TapedPencil { tape: &tape, marks: Vec::new() };
        let read = drawn.read_in(&drawn.configuration.lift(), layout, &mut pencil);
        let mut marks = pencil.marks;
        let Some(read) = read.ok().filter(|_| marks.len() <= MOST_MARKS) else {
            return vec![None; drawn.values.len()];
        };
        // A drawing that is a single point (nothing moves) has no marks, no scale, and nothing to
        // read.
        let drawings = DiagramKind::ALL.map(|on| (on, drawn.size_mm(on) != [0.0, 0.0]));
        let is_drawn = |on: DiagramKind| drawings.contains(&(on, true));
        marks.retain(|(on, _)| is_drawn(*on));
        let deviation_mm = pencil_mm / radius_in_deviations();
        let spread = |value: AnswerValue<Taped>| {
            let (x, y) = value.numbers();
            let (x, y) = (x.slopes(), y.map(Taped::slopes));
            let effect = |of: Taped| Vec2::new(x.by(of), y.as_ref().map_or(0.0, |y| y.by(of)));
            let mut spread = Spread::default();
            for (on, displaced) in &marks {
                let covariance = spread.0.entry(on.kind());
                covariance.add(effect(displaced.x) * deviation_mm);
                covariance.add(effect(displaced.y) * deviation_mm);
            }
            spread
        };
        let of_find = |(find, value): (&Find, Option<AnswerValue<Taped>>)| {
            value.filter(|_| is_drawn(find.what.diagram())).map(spread)
        };
        drawn.scene.find.iter().zip(read).map(of_find).collect()
    }

    /// Returns the tolerance of a reading and [`Tolerance::relative`].
    fn tolerance(&self, drawn: &DraftedConstruction, find: usize) -> Option<(f64, Option<f64>)> {
        let size = drawn.values[find]?.magnitude();
        let absolute = self.total().radius(WITHIN);
        let free = drawn.scene.find[find].what.entry().from_origin;
        let relative = (!free && size > 0.0).then(|| absolute / size);
        absolute.is_finite().then_some((absolute, relative))
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
        let (mean, half) =
            (0.5 * (self.xx + self.yy), libm::hypot(0.5 * (self.xx - self.yy), self.xy));
        let (large, small) = (mean + half, (mean - half).max(0.0));
        if large == 0.0 || !large.is_finite() {
            return large.sqrt();
        }
        let ratio = small / large;
        let rates = COS2.map(|c| 1.0 / (c + ratio * (1.0 - c)));
        // In units of s₁, with t = R²/2: the logarithm of the part outside is convex in t, so that
        // Newton's steps from the radius of an error equal in all directions, which is too large,
        // go too far once at most and then approach the root from one side.
        let wanted = libm::log(1.0 - p);
        let mut t = -wanted;
        for _ in 0..MOST_STEPS {
            let (mut outside, mut slope) = (0.0, 0.0);
            for rate in rates {
                let part = libm::exp(-t * rate);
                outside += part;
                slope += part * rate;
            }
            let step = (libm::log(outside / STEPS as f64) - wanted) * outside / slope;
            t = (t + step).max(0.25 * t);
            // The error of the next step is the square of this one's.
            if step.abs() <= 1e-9 * t {
                break;
            }
        }
        (2.0 * t * large).sqrt()
    }
}

/// The greatest number of Newton's steps; five are usual.
const MOST_STEPS: usize = 60;

/// The number of steps over a quarter turn.
const STEPS: usize = 32;

/// The squares of the cosines at the middles of the steps.
static COS2: LazyLock<[f64; STEPS]> = LazyLock::new(|| {
    std::array::from_fn(|k| {
        let c = libm::cos((k as f64 + 0.5) * std::f64::consts::FRAC_PI_2 / STEPS as f64);
        c * c
    })
});

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
