//! Answers read from the paper: the distance of two marks × μ, with sense.
//!
//! A question of motion is an edge of a polygon, consecutive edges, or a vector from the pole
//! ([`asking`]). An angular velocity or acceleration is measured when it is first needed. The
//! meaning of a question is not written here as a formula: if no edge shows it, nothing is
//! measured.

use super::pencil::Pencil;
use super::{PlanDrawing, PolygonMark, scale};
use crate::plan::{Asking, Plan, Term, VertexId, VertexPlace, asking, body_of};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_mechanism::answer::{AnswerValue, MotionSource, place};
use hodograph_mechanism::mechanism::{Level, Mechanism};
use hodograph_mechanism::position::Configuration;
use hodograph_scene::quantity::combined::combine;
use hodograph_scene::quantity::composite::CompositePart;
use hodograph_scene::quantity::{Composite, Frame, Meaning, ObservedPart, Of};
use hodograph_scene::{Asked, DiagramKind, Find, Kind, LinkId, OnLink, PointId, Scene};

/// The answer to one question.
#[derive(Clone, Debug, PartialEq)]
pub struct FindAnswer<N = f64> {
    /// Index into the scene's `find` list.
    pub find: usize,
    /// The value.
    pub value: AnswerValue<N>,
    /// The measurement; `None` for given values, for positions, and if the drawing shows nothing
    /// because the quantity vanishes for topological reasons or because a driver is at rest.
    pub measured: Option<MeasuredDistance>,
}

/// The distance of two marks measured on paper, with its factors.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredDistance {
    /// The length (mm).
    pub length_mm: f64,
    /// The scale (SI per mm).
    pub mu: f64,
    /// For an angular quantity, the arm (m) by which the product is divided.
    pub arm_m: Option<f64>,
    /// The two points at the ends of the arm, if the arm is their distance.
    pub arm_of: Option<(PointId, PointId)>,
    /// The marks at the ends of the length, with their places in the polygon (mm from its pole); a
    /// vector points from the first to the second.
    pub marks: [(PolygonMark, Point); 2],
    /// The vector in the names of the drawing; `None` for an angular quantity.
    pub shown: Option<DrawnVector>,
}

/// The vector of the drawing that a question reads.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnVector {
    /// The image of a vertex from the pole, or the terms of consecutive edges.
    pub vector: ShownAs,
    /// True if the question asks for the opposite vector.
    pub reversed: bool,
}

/// The form of a vector in [`DrawnVector`].
#[derive(Clone, Debug, PartialEq)]
pub enum ShownAs {
    /// The vector from the pole to an image.
    Image(VertexId),
    /// Consecutive edges, as drawn.
    Edges(Vec<Term>),
}

/// A vector found on paper: its marks and its name.
struct FoundVector<N> {
    marks: [(PolygonMark, Point<N>); 2],
    shown: DrawnVector,
}

/// A relative velocity below this fraction of the transport velocity shows no direction on paper,
/// and has too few digits.
const SHORT: f64 = 1e-4;

struct OnPaper<'a, N> {
    scene: &'a Scene,
    m: &'a Mechanism,
    plan: &'a Plan,
    paper: &'a PlanDrawing<N>,
}

impl<N: Real> OnPaper<'_, N> {
    /// Returns the image of a point, the pole for a fixed one; `None` if it is not drawn.
    fn image(&self, on: DiagramKind, p: &OnLink) -> Option<Point<N>> {
        let ground = self.scene.ground;
        if p.link
            .map_or_else(|| self.scene.links[ground.0].points.contains(&p.point), |l| l == ground)
        {
            return Some(Point::origin());
        }
        self.paper.polygon(on)?.images[self.plan.find_vertex(self.scene, p.point, p.link)?.0]
    }

    /// True if all points of a question have their images on the diagram from which it is read.
    fn is_drawn(&self, what: &Asked) -> bool {
        what.points(self.scene).iter().all(|p| self.image(what.diagram(), p).is_some())
    }

    /// Returns the place of a question on paper; `None` if no edge shows it.
    fn find(&self, what: &Asked) -> Option<FoundVector<N>> {
        let polygon = self.paper.polygon(what.diagram())?;
        match asking(self.scene, self.m, self.plan, what)? {
            Asking::Vector { of, reversed } => {
                let (pole, tip) = (
                    (PolygonMark::Pole, Point::origin()),
                    (polygon.mark(self.plan, of), polygon.images[of.0]?),
                );
                let marks = if reversed { [tip, pole] } else { [pole, tip] };
                Some(FoundVector {
                    marks,
                    shown: DrawnVector { vector: ShownAs::Image(of), reversed },
                })
            }
            Asking::Terms(terms) => {
                let (marks, reversed) = polygon.edge_of(&terms)?;
                let drawn =
                    |t: &Term| if reversed { Term { of: t.to, to: t.of, ..*t } } else { *t };
                Some(FoundVector {
                    marks,
                    shown: DrawnVector {
                        vector: ShownAs::Edges(terms.iter().map(drawn).collect()),
                        reversed,
                    },
                })
            }
        }
    }

    fn turning(&self, on: DiagramKind, link: LinkId) -> Option<N> {
        // A link that turns like one that never turns does not turn itself.
        if self.m.never_turns[link.0] {
            return Some(N::from_f64(0.0));
        }
        self.paper.rate(on, body_of(self.scene, self.m, link))
    }
}

/// Returns the vectors and rates of a drawing as a source for formulas: accelerations for inertia,
/// velocities for resistances.
pub fn source<'a, N: Real>(
    scene: &'a Scene,
    m: &'a Mechanism,
    plan: &'a Plan,
    paper: &'a PlanDrawing<N>,
) -> impl MotionSource<N> + 'a {
    OnPaper { scene, m, plan, paper }
}

impl<N: Real> MotionSource<N> for OnPaper<'_, N> {
    fn vector(&self, level: Level, p: PointId, on: Option<LinkId>) -> Option<Vec2<N>> {
        let diagram = DiagramKind::of(level);
        let own = on.filter(|l| !self.scene.links[l.0].points.contains(&p));
        let at = self.image(diagram, &OnLink { point: p, link: own })?;
        match self.paper.polygon(diagram) {
            Some(polygon) => Some(at.to_vec2() * scale::number(polygon.mu)),
            // Nothing moves.
            None => Some(Vec2::zero()),
        }
    }

    fn turning(&self, level: Level, link: LinkId) -> Option<N> {
        self.turning(DiagramKind::of(level), link)
    }
}

/// Returns the points at the ends of a line, if the arm is their distance (a special point is not a
/// point of the scene, and some arms begin in a centre of curvature).
fn points_of<N: Real>(
    at: &Configuration<N>,
    plan: &Plan,
    (of, to): (VertexId, VertexId),
    arm: f64,
) -> Option<(PointId, PointId)> {
    let (VertexPlace::Point(a), VertexPlace::Point(b)) =
        (plan.vertex(of).spot, plan.vertex(to).spot)
    else {
        return None;
    };
    let off = at.points[a.0]?.distance(at.points[b.0]?).approx() - arm;
    // The two distances agree to rounding, or are different altogether.
    (off.abs() < 1e-9 * arm).then_some((a, b))
}

/// True if a Coriolis part vanishes because its frame never turns.
fn vanishes(m: &Mechanism, what: &Asked, scene: &Scene) -> bool {
    match what.meaning(scene) {
        Some(Meaning::Seen(ObservedPart::Coriolis, _, Frame::Link(l), _)) => m.never_turns[l.0],
        Some(Meaning::Seen(ObservedPart::Coriolis, _, Frame::Point(_), _)) => true,
        _ => false,
    }
}

/// Returns the answers from the drawing board; `None` for vectors that are not drawn
/// ([`Plan::undrawable`]).
pub fn read<N: Real>(
    scene: &Scene,
    m: &Mechanism,
    at: &Configuration<N>,
    plan: &Plan,
    paper: &PlanDrawing<N>,
) -> Vec<Option<FindAnswer<N>>> {
    let source = OnPaper { scene, m, plan, paper };
    scene.find.iter().enumerate().map(|(find, f)| source.answer(at, find, &f.what)).collect()
}

impl<N: Real> OnPaper<'_, N> {
    /// Returns the answer to a question.
    fn answer(&self, at: &Configuration<N>, find: usize, what: &Asked) -> Option<FindAnswer<N>> {
        let on = what.diagram();
        // A combination of two quantities is drawn if both are.
        if let Asked::Combined(c) = what {
            let [a, b] = c.operands.map(|q| self.answer(at, find, &q.asked()));
            return Some(FindAnswer {
                find,
                value: combine(c.operation, a?.value, b?.value)?,
                measured: None,
            });
        }
        if on == DiagramKind::Plane {
            return Some(FindAnswer { find, value: place(self.scene, at, what)?, measured: None });
        }
        match what.meaning(self.scene) {
            Some(Meaning::Turning(l, None)) => {
                let reading = self
                    .paper
                    .rates
                    .iter()
                    .find(|r| r.on == on && r.body == body_of(self.scene, self.m, l));
                let measured = reading.zip(self.paper.polygon(on)).and_then(|(r, p)| {
                    let m = r.measured?;
                    let arm = m.arm.approx();
                    Some(MeasuredDistance {
                        length_mm: m.length.approx(),
                        mu: p.mu,
                        arm_m: Some(arm),
                        arm_of: points_of(at, self.plan, m.line, arm),
                        marks: m.marks.map(|(mark, at)| (mark, at.approx())),
                        shown: None,
                    })
                });
                return Some(FindAnswer {
                    find,
                    value: AnswerValue::Scalar(self.turning(on, l)?),
                    measured,
                });
            }
            Some(Meaning::Turning(l, Some(against))) => {
                let value = self.turning(on, l)? - self.turning(on, against)?;
                return Some(FindAnswer {
                    find,
                    value: AnswerValue::Scalar(value),
                    measured: None,
                });
            }
            Some(Meaning::Ratio(links, arm)) => {
                let of = |l| self.turning(on, l);
                let arm = arm.map_or(Some(N::from_f64(0.0)), of)?;
                let value = (of(links[0])? - arm) / (of(links[1])? - arm);
                return value.is_decided().then_some(FindAnswer {
                    find,
                    value: AnswerValue::Scalar(value),
                    measured: None,
                });
            }
            Some(Meaning::Vector(_) | Meaning::Relative(..)) => {}
            Some(Meaning::Seen(..))
                if asking(self.scene, self.m, self.plan, what).is_none()
                    && !vanishes(self.m, what, self.scene) =>
            {
                return self.dropped(at, find, what);
            }
            Some(Meaning::Seen(..)) => {}
            // No edge shows these.
            Some(Meaning::Place(_)) | None => return None,
        }
        if !self.is_drawn(what) {
            return None;
        }
        Some(match (self.find(what), self.paper.polygon(on)) {
            (Some(FoundVector { marks, shown }), Some(p)) => {
                let drawn = marks[1].1 - marks[0].1;
                let measured = MeasuredDistance {
                    length_mm: drawn.norm().approx(),
                    mu: p.mu,
                    arm_m: None,
                    arm_of: None,
                    marks: marks.map(|(mark, at)| (mark, at.approx())),
                    shown: Some(shown),
                };
                FindAnswer {
                    find,
                    value: AnswerValue::Vector(drawn * N::from_f64(p.mu)),
                    measured: Some(measured),
                }
            }
            // Both images exist, without an edge between them: this part vanishes.
            _ => FindAnswer { find, value: AnswerValue::Vector(Vec2::zero()), measured: None },
        })
    }

    /// Returns a_rⁿ and a_rᵗ if no pair gives the relative path: by the perpendicular from the tip
    /// of a_r to the line of v_r, both of which are drawn.
    fn dropped(&self, at: &Configuration<N>, find: usize, what: &Asked) -> Option<FindAnswer<N>> {
        let Asked::Composite(c) = what else { return None };
        let of = |part| match self.answer(at, find, &Composite { part, ..*c }.into())?.value {
            AnswerValue::Vector(v) => Some(v),
            AnswerValue::Scalar(_) | AnswerValue::Point(_) => None,
        };
        if !matches!(c.part, CompositePart::RelativeNormal | CompositePart::RelativeTangential) {
            return None;
        }
        let [whole, v_r, v_e] = [
            of(CompositePart::Relative)?,
            of(CompositePart::RelativeVelocity)?,
            of(CompositePart::TransportVelocity)?,
        ];
        let way = v_r.unit().filter(|_| v_r.approx().norm() > SHORT * v_e.approx().norm())?;
        let along = way * way.dot(whole);
        let value = if c.part == CompositePart::RelativeTangential { along } else { whole - along };
        Some(FindAnswer { find, value: AnswerValue::Vector(value), measured: None })
    }
}

/// Returns the answers that are read from a drawing made [`by_hand`](super::by_hand), each length
/// with the same pencil; positions are measured on the diagram. `shown` is the configuration that
/// belongs to the drawing.
pub fn read_by_hand<N: Real, P: Pencil<N>>(
    scene: &Scene,
    m: &Mechanism,
    shown: &Configuration<N>,
    plan: &Plan,
    paper: &PlanDrawing<N>,
    pencil: &mut P,
) -> Vec<Option<AnswerValue<N>>> {
    let mu = paper.diagram.mu;
    let [mu_l, per_m] = [mu, 1.0 / mu].map(N::from_f64);
    let drawn = read(scene, m, shown, plan, paper);
    let mut measure = |find: &Find, answer: Option<FindAnswer<N>>| -> Option<AnswerValue<N>> {
        // Combinations of two quantities are calculated.
        if matches!(find.what, Asked::Combined(_)) {
            return Some(answer?.value);
        }
        let on = find.what.diagram();
        Some(match (answer?.value, paper.polygon(on)) {
            (AnswerValue::Vector(v), Some(p)) => AnswerValue::Vector(
                pencil.read(on, v * N::from_f64(1.0 / p.mu)) * N::from_f64(p.mu),
            ),
            // Rates were read when they were first needed; the difference of two rates is
            // calculated.
            (value @ (AnswerValue::Scalar(_) | AnswerValue::Point(_)), Some(_))
            | (value @ AnswerValue::Vector(_), None) => value,
            (AnswerValue::Point(p), None) => {
                AnswerValue::Point((pencil.read(on, p.to_vec2() * per_m) * mu_l).to_point())
            }
            (AnswerValue::Scalar(s), None) => AnswerValue::Scalar(match find.what.of() {
                Of::Link(l) if find.what.kind() == Kind::Angle => {
                    let apart = shown
                        .link_direction(scene, l)
                        .map_or(shown.extent(), |along| along.approx().norm())
                        / mu;
                    pencil.ruler(on, Vec2::from_angle(s), apart).angle()
                }
                Of::Point(_)
                | Of::Points(..)
                | Of::Link(_)
                | Of::Links(..)
                | Of::Line(..)
                | Of::Seen(..)
                | Of::Mechanism => pencil.read(on, Vec2::unit_x() * (s / mu_l)).x * mu_l,
            }),
        })
    };
    scene.find.iter().zip(drawn).map(|(find, answer)| measure(find, answer)).collect()
}
