//! A wrong solution drawn beside the right one, and the results of both.

use super::{
    EquationPart, Site, SolutionSide, by_centre, contact_point, coriolis, image, normal,
    rolling_point,
};
use hodograph_base::geom::{Point, Vec2, cross_lines};
use hodograph_board::construct::pencil::Exact;
use hodograph_board::construct::{Acts, Layout, Polygon, read, scale};
use hodograph_board::plan::{Plan, Special, SpecialLine, VertexId, VertexPlace};
use hodograph_mechanism::answer::AnswerValue;
use hodograph_mechanism::mechanism::ConstraintLine;
use hodograph_mechanism::position::{Configuration, Path};
use hodograph_scene::{Attempted, ByKind, DiagramKind, GivenQuantity, Scene};
use hodograph_worked::worked::Worked;

/// A solution with its scene.
#[derive(Clone, Debug)]
pub struct AttemptScene {
    /// The scene: that of the file, unless the mistake is another mechanism.
    pub scene: Scene,
    /// The solved scene; its equations and their drawing are used.
    pub worked: Worked,
}

/// A question and its answers.
#[derive(Clone, Debug, PartialEq)]
pub struct AttemptAnswer {
    /// Index into the results of the right solution.
    pub result: usize,
    /// The answer of the wrong equations; `None` if they do not answer the question.
    pub wrong: Option<AnswerValue>,
    /// The printed value (SI; for a vector, the magnitude).
    pub printed: Option<GivenQuantity>,
}

/// The distance of the two tips of one vector.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TipGap {
    /// The polygon: velocities or accelerations.
    pub on: DiagramKind,
    /// The vertex in the right plan.
    pub right: VertexId,
    /// The corresponding vertex in the wrong plan.
    pub wrong: VertexId,
    /// The vector from the right tip to the wrong one (SI).
    pub vector: Vec2,
}

/// A wrong solution.
#[derive(Clone, Debug)]
pub struct Attempt {
    /// The mistake and its place.
    pub site: Site,
    /// The scene's own statement of the attempt, if it has one.
    pub said: Option<Attempted>,
    /// The right solution.
    pub right: AttemptScene,
    /// The wrong solution.
    pub wrong: AttemptScene,
    /// The equation in which the mistake is seen.
    pub shown: EquationPart,
    /// The questions with a changed answer or a printed value.
    pub rows: Vec<AttemptAnswer>,
    /// The distance of the tips.
    pub gap: TipGap,
}

/// The space for the polygons on a page (mm).
const PAGE_MM: [f64; 2] = [150.0, 150.0];
/// Two tips nearer than this (mm of paper) coincide.
const APART_MM: f64 = 0.05;
/// Answers that differ by less than this fraction of the largest of their kind agree.
const SAME: f64 = 1e-7;
/// A value below this fraction of the largest of its kind is a rounding error of zero.
const ROUNDING: f64 = 1e-12;
/// A centre farther away than this many sizes of the mechanism cannot be drawn with a pencil.
const FAR: f64 = 1e4;

/// Returns the wrong solution of a site; `None` if it cannot be drawn in the pose, or makes no
/// difference.
pub fn solved(
    scene: &Scene,
    worked: &Worked,
    site: Site,
    said: Option<&Attempted>,
) -> Option<Attempt> {
    let at = &worked.configuration;
    let stage = |worked: Worked| AttemptScene { scene: scene.clone(), worked };
    let (right, wrong, answers, shown): (
        AttemptScene,
        AttemptScene,
        Vec<Option<AnswerValue>>,
        EquationPart,
    ) = match changed(scene, worked, &site)? {
        Changed::Plan(wrong, shown) => {
            if !special_points_are_near(&wrong, at) {
                return None;
            }
            let layout = Layout::of(&worked.construction);
            let acts = Acts::of(scene, &worked.mechanism, &wrong, &worked.construction.acts.chosen);
            let construction = acts.draw(scene, at, &wrong, &layout, &mut Exact).ok()?;
            let answers = read(scene, &worked.mechanism, at, &wrong, &construction);
            let wrong = Worked { plan: *wrong, construction, ..worked.clone() };
            let answers = answers.into_iter().map(|a| a.map(|a| a.value)).collect();
            (stage(worked.clone()), stage(wrong), answers, shown)
        }
        Changed::Mechanism(both, shown) => {
            let (right, wrong) = *both;
            let (other, w) = (&wrong.scene, &wrong.worked);
            let of = |text: &str| {
                w.results.iter().find(|r| other.find[r.find].text == text).map(|r| r.value())
            };
            let answers = scene.find.iter().map(|f| of(&f.text)).collect();
            (right, wrong, answers, shown)
        }
    };
    let rows = rows(scene, worked, &answers, said);
    let (right, wrong) = to_one_scale(right, wrong)?;
    let gap = gap(&right, &wrong, &shown)?;
    Some(Attempt { site, said: said.cloned(), right, wrong, shown, rows, gap })
}

/// Draws both again, to the largest scales at which the superposed polygons fit a page.
fn to_one_scale(right: AttemptScene, wrong: AttemptScene) -> Option<(AttemptScene, AttemptScene)> {
    let extent = |on: DiagramKind| {
        let marks = |p: &Polygon| -> Vec<Point> {
            let ends = p
                .edges
                .iter()
                .flat_map(|e| [e.from.1, e.to.1])
                .chain(p.images.iter().flatten().copied());
            ends.map(|q| (q.to_vec2() * p.mu).to_point()).collect()
        };
        let polygons = [&right, &wrong].map(|s| s.worked.construction.polygon(on));
        let all = polygons.into_iter().flatten().flat_map(marks).chain([Point::ORIGIN]);
        scale::extent(all)
    };
    let mu = |on: DiagramKind| {
        let size = extent(on);
        let drawn = right.worked.construction.polygon(on)?;
        if size == [0.0, 0.0] {
            Some(drawn.mu)
        } else {
            Some(scale::fitted(&right.scene.paper, on.kind(), size, PAGE_MM))
        }
    };
    let scales: ByKind =
        DiagramKind::POLYGONS.into_iter().filter_map(|on| Some((on.kind(), mu(on)?))).collect();
    let again = |s: AttemptScene| {
        let layout = Layout { scales: scales.clone(), ..Layout::of(&s.worked.construction) };
        let construction = s
            .worked
            .construction
            .acts
            .draw(&s.scene, &s.worked.configuration, &s.worked.plan, &layout, &mut Exact)
            .ok()?;
        Some(AttemptScene { worked: Worked { construction, ..s.worked }, ..s })
    };
    Some((again(right)?, again(wrong)?))
}

/// The change that a mistake makes to a solution.
enum Changed {
    Plan(Box<Plan>, EquationPart),
    /// The right solution with the points that the wrong one names, the wrong solution, and the
    /// equation.
    Mechanism(Box<(AttemptScene, AttemptScene)>, EquationPart),
}

fn changed(scene: &Scene, worked: &Worked, site: &Site) -> Option<Changed> {
    let plan = &worked.plan;
    let of_plan = |(plan, shown)| Changed::Plan(Box::new(plan), shown);
    match *site {
        Site::NoCoriolis(g) => coriolis::left_out(plan, g).map(of_plan),
        Site::CoriolisWrongOmega(g, l) => coriolis::turned_by(plan, g, l).map(of_plan),
        Site::RollingPointAZero(r) => rolling_point::as_track(plan, r).map(of_plan),
        Site::RollingPointAsBase(r, p) => rolling_point::as_base(scene, plan, r, p).map(of_plan),
        Site::ImageAcrossLinks(p, ..) => image::on_points_of(scene, plan, p).map(of_plan),
        Site::NoNormal(l) => normal::left_out(plan, l).map(of_plan),
        Site::AccelerationByCentre(l) => by_centre::hung_on_pole(scene, plan, l).map(of_plan),
        Site::ContactPoint(c, frame) => {
            let (right, wrong, shown) =
                contact_point::slid(scene, &worked.configuration, c, frame)?;
            Some(Changed::Mechanism(Box::new((right, wrong)), shown))
        }
    }
}

/// True if the centres that a wrong plan puts on the pole are near enough to be drawn.
fn special_points_are_near(plan: &Plan, at: &Configuration) -> bool {
    let hung = plan.vertices.iter().filter(|v| v.fixed).filter_map(|v| match v.spot {
        VertexPlace::Special(k) => Some(&plan.specials[k]),
        VertexPlace::Point(_) => None,
    });
    hung.into_iter().all(|s| is_near(s, at).unwrap_or(false))
}

fn is_near(special: &Special, at: &Configuration) -> Option<bool> {
    let line = |l: &SpecialLine| {
        let SpecialLine::Leg(leg) = *l else { return None };
        let p = at.points[leg.pin().0]?;
        let along = match leg {
            ConstraintLine::Along { far, .. } => p - at.points[far.0]?,
            ConstraintLine::Normal { guide, .. } => match at.guides[guide.0]? {
                Path::Line { direction, .. } => direction.perp(),
                Path::Arc { centre, .. } => p - centre,
            },
            ConstraintLine::Tangent { .. } => return None,
        };
        Some((p, along))
    };
    let [(p, u), (q, w)] = [line(&special.lines[0])?, line(&special.lines[1])?];
    let c = cross_lines(p, u, q, w);
    Some(c.at.is_finite() && c.at.distance(p) < FAR * at.extent())
}

fn rows(
    scene: &Scene,
    worked: &Worked,
    wrong: &[Option<AnswerValue>],
    said: Option<&Attempted>,
) -> Vec<AttemptAnswer> {
    let printed = |text: &str| {
        said.and_then(|s| s.printed.iter().find(|(f, _)| f.text == text).map(|(_, v)| v.clone()))
    };
    let row = |(k, r): (usize, &hodograph_worked::worked::Outcome)| {
        let find = &scene.find[r.find];
        // A value within rounding counts as zero.
        let wrong = wrong[r.find].map(|v| v.above(ROUNDING * r.scale));
        let printed = printed(&find.text);
        let differs = match (r.value(), wrong) {
            (AnswerValue::Scalar(a), Some(AnswerValue::Scalar(b))) => {
                (a - b).abs() > SAME * r.scale.max(a.abs())
            }
            (AnswerValue::Vector(a), Some(AnswerValue::Vector(b))) => {
                (a - b).norm() > SAME * r.scale.max(a.norm())
            }
            (AnswerValue::Scalar(_) | AnswerValue::Vector(_) | AnswerValue::Point(_), _) => false,
        };
        (printed.is_some() || find.what.diagram() > DiagramKind::Plane && differs)
            .then_some(AttemptAnswer { result: k, wrong, printed })
    };
    worked.results.iter().enumerate().filter_map(row).collect()
}

/// Returns the gap between the tips of the vertex that the wrong step finds, or, where these agree,
/// the largest gap.
fn gap(right: &AttemptScene, wrong: &AttemptScene, shown: &EquationPart) -> Option<TipGap> {
    let of = |on: DiagramKind, v: VertexId| {
        let vertex = right.worked.plan.vertex(v);
        let same = |w: &hodograph_board::plan::Vertex| w.spot == vertex.spot && w.on == vertex.on;
        let other = VertexId(wrong.worked.plan.vertices.iter().position(same)?);
        let tips = [
            right.worked.construction.vector(on, v)?,
            wrong.worked.construction.vector(on, other)?,
        ];
        let mu = right.worked.construction.polygon(on)?.mu;
        let vector = tips[1] - tips[0];
        (vector.norm() > APART_MM * mu).then_some(TipGap { on, right: v, wrong: other, vector })
    };
    let levels = [shown.on, DiagramKind::Acceleration, DiagramKind::Velocity];
    levels.into_iter().find_map(|on| {
        let target = shown.step.target();
        let stage = match shown.side {
            SolutionSide::Right => right,
            SolutionSide::Wrong => wrong,
        };
        let named = stage.worked.plan.vertex(target);
        let meant = (0..right.worked.plan.vertices.len()).map(VertexId).find(|v| {
            let own = right.worked.plan.vertex(*v);
            own.spot == named.spot && own.on == named.on
        });
        if let Some(gap) = meant.and_then(|v| of(on, v)) {
            return Some(gap);
        }
        let all = (0..right.worked.plan.vertices.len()).filter_map(|v| of(on, VertexId(v)));
        all.max_by(|a, b| a.vector.norm().total_cmp(&b.vector.norm()))
    })
}
