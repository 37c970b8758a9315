//! The certified numbers of a construction's steps.
//!
//! The drawing board itself runs again in numbers that know their error, on the scales and with the
//! special points that the drawing in `f64` chose; a measurement on that board is true within its
//! bound. As for the answers, the next rung is asked for numbers that one rung leaves uncertain,
//! and the loop equations take no part.

use super::ladder::{CertifiedNumber, MissingDigits, READING_DIGITS};
use crate::accuracy::{Climb, Rung};
use crate::worked::Worked;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_base::number::decimal::Certain;
use hodograph_board::construct::pencil::Exact;
use hodograph_board::construct::{Action, Edge, Layout, PlanDrawing, Polygon, PolygonMark, scale};
use hodograph_board::plan::VertexId;
use hodograph_mechanism::motion::MotionNumber;
use hodograph_mechanism::position;
use hodograph_scene::{Book, DiagramKind, Kind, Scene};
use std::collections::BTreeMap;

/// The kinds of numbers of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum StepNumber {
    /// A length on paper (mm), counted if a step has several: of the edges it drew, of the vector
    /// it found, or of the relative vector from which it took an angular rate.
    Length(usize),
    /// The angle of a crossing, in degrees from 0 to 90.
    Angle,
    /// The displacement of a crossing by a pencil error (mm).
    Moved,
    /// The displacement through μ, in the unit in which such vectors are printed.
    Off,
    /// The arm by which a measured rate is divided, in the unit in which lengths are printed.
    Arm,
    /// An angular rate, in the unit in which it is printed (rad/s, rad/s², or those of the book).
    Rate,
}

impl StepNumber {
    /// Returns the number of digits to print: for an angle one fewer than for a length, for an
    /// error two.
    pub fn digits(self) -> usize {
        match self {
            StepNumber::Length(_) | StepNumber::Arm | StepNumber::Rate => READING_DIGITS,
            StepNumber::Angle => 3,
            StepNumber::Moved | StepNumber::Off => 2,
        }
    }
}

/// The key of one number of a construction: its diagram, the action (its index there; on the
/// diagram, which counts no actions, the crossing) or the vertex, and the kind of number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Key {
    Step(DiagramKind, usize, StepNumber),
    /// The length of the vector of a vertex that ends a laid-off vector, in the unit in which it is
    /// printed.
    Vector(DiagramKind, VertexId),
}

impl Key {
    fn digits(self) -> usize {
        match self {
            Key::Step(_, _, what) => what.digits(),
            Key::Vector(..) => READING_DIGITS,
        }
    }
}

/// The numbers of a construction's steps, each number as far as it is certain.
#[derive(Clone, Debug, PartialEq)]
pub struct CertifiedSteps {
    /// The pencil error for which crossings were weighed (mm); `None` if they were not.
    pub pencil_mm: Option<f64>,
    numbers: BTreeMap<Key, (CertifiedNumber, Rung)>,
    /// The reason why some numbers have fewer digits than their kind; `None` if none has.
    pub why: Option<MissingDigits>,
}

/// The length on paper up to which it counts as zero (mm): a hundred times the rounding of the
/// drawing in `f64`, and a millionth of the ruler's resolution.
const NOTHING_MM: f64 = 1e-9;

/// The part of the largest rate of its polygon below which a given rate is zero.
const NOTHING: f64 = 1e-14;

impl CertifiedSteps {
    /// Returns a number of an action on a diagram; `None` if not even its first digit is certain.
    pub fn text(&self, on: DiagramKind, action: usize, what: StepNumber) -> Option<String> {
        Some(self.number(on, action, what)?.text(what.digits())?.0)
    }

    /// Returns a function for each crossing of a drawing that gives its numbers, in the order of
    /// [`PlanDrawing::crossings`].
    pub fn crossings<'a>(
        &'a self,
        paper: &PlanDrawing,
        on: DiagramKind,
    ) -> Vec<impl Fn(StepNumber) -> Option<String> + 'a> {
        let crossed = |(i, a): (usize, &Action)| {
            matches!(a, Action::Cross { .. } | Action::Trials { .. }).then_some(i)
        };
        let at: Vec<usize> = match paper.polygon(on) {
            Some(p) => p.actions.iter().enumerate().filter_map(crossed).collect(),
            None => (0..paper.crossings(on).len()).collect(),
        };
        at.into_iter().map(move |i| move |what| self.text(on, i, what)).collect()
    }

    /// Returns a number of an action on a diagram, with its interval.
    pub fn number(
        &self,
        on: DiagramKind,
        action: usize,
        what: StepNumber,
    ) -> Option<&CertifiedNumber> {
        self.numbers.get(&Key::Step(on, action, what)).map(|n| &n.0)
    }

    /// Returns the length of the vector of a vertex that ends a laid-off vector, in the unit in
    /// which such vectors are printed (SI, or that of the book).
    pub fn vector(&self, on: DiagramKind, v: VertexId) -> Option<&CertifiedNumber> {
        self.numbers.get(&Key::Vector(on, v)).map(|n| &n.0)
    }

    /// Returns all numbers, each with the digits to which it is printed and the rung that gave it,
    /// in the order of the drawing.
    pub fn all(&self) -> impl Iterator<Item = (&CertifiedNumber, usize, Rung)> {
        self.numbers.iter().map(|(key, (n, rung))| (n, key.digits(), *rung))
    }
}

/// Certifies the numbers of the steps of a worked scene's construction; with a pencil error (mm),
/// also the displacement of each crossing.
pub fn steps(scene: &Scene, worked: &Worked, pencil_mm: Option<f64>) -> CertifiedSteps {
    let mut done = CertifiedSteps { pencil_mm, numbers: BTreeMap::new(), why: None };
    if worked.construction.diagrams.is_empty() {
        return done;
    }
    let bounded = scene.bounded();
    let scene = bounded.as_ref().unwrap_or(scene);
    for rung in Rung::LADDER {
        let last = rung == Rung::LAST;
        let seen = rung.climb(&Redrawn { scene, worked, pencil_mm });
        done.why = None;
        let Some(seen) = seen else {
            done.why = Some(MissingDigits::TooClose);
            continue;
        };
        for (key, number) in seen {
            let kept = done.numbers.get(&key).is_some_and(|(n, _)| n.holds(key.digits(), false));
            if kept {
                continue;
            }
            if !number.as_ref().is_some_and(|n| n.holds(key.digits(), last)) {
                done.why = Some(if last { MissingDigits::Tie } else { MissingDigits::TooClose });
            }
            if let Some(number) = number {
                done.numbers.insert(key, (number, rung));
            }
        }
        if done.why.is_none() {
            break;
        }
    }
    done
}

/// The construction drawn again in other numbers.
struct Redrawn<'a> {
    scene: &'a Scene,
    worked: &'a Worked,
    pencil_mm: Option<f64>,
}

impl Climb for Redrawn<'_> {
    type Found = Option<Vec<(Key, Option<CertifiedNumber>)>>;

    fn with<N: Certain + MotionNumber>(&self) -> Self::Found {
        let Worked { mechanism: m, demand, configuration, plan, construction, .. } = self.worked;
        let at = position::recompute::<N>(self.scene, m, demand, configuration).ok()?;
        let layout = Layout::of(construction);
        let paper = construction.acts.draw(self.scene, &at, plan, &layout, &mut Exact).ok()?;
        Some(numbers(&self.scene.book, &paper, self.pencil_mm))
    }
}

/// All numbers that the sentences on a drawing use; `None` for those without a value.
fn numbers<N: Certain>(
    book: &Book,
    paper: &PlanDrawing<N>,
    pencil_mm: Option<f64>,
) -> Vec<(Key, Option<CertifiedNumber>)> {
    let mut out = Vec::new();
    for (i, c) in paper.diagram.crossed.iter().enumerate() {
        let told = crossing(
            c.sine,
            |moved| book.in_chosen(Kind::Length, moved * scale::number(paper.diagram.mu)),
            pencil_mm,
        );
        out.extend(told.into_iter().map(|(what, n)| (Key::Step(DiagramKind::Plane, i, what), n)));
    }
    for on in DiagramKind::POLYGONS {
        let Some(p) = paper.polygon(on) else { continue };
        let vector = |si: N| book.in_chosen(on.kind(), si);
        let turning = |si: N| book.in_chosen(on.turning(), si);
        let rates = paper.rates.iter().filter(|r| r.on == on);
        let largest = rates.map(|r| r.value.approx().abs()).fold(0.0, f64::max);
        for (i, action) in p.actions.iter().enumerate() {
            let mut tell =
                |what, number: Option<CertifiedNumber>| out.push((Key::Step(on, i, what), number));
            match action {
                Action::LayOff(e) => {
                    tell(StepNumber::Length(0), length(span(&p.edges[*e])));
                    // A given vector is a number in the equations.
                    if let PolygonMark::Image(v) = p.edges[*e].to.0 {
                        let nothing = from_pole(p, v).and_then(length).is_some_and(|l| l.zero);
                        let size = from_pole(p, v)
                            .and_then(|drawn| some(vector((drawn * scale::number(p.mu)).norm())));
                        out.push((Key::Vector(on, v), size.map(|n| n.or_zero(nothing))));
                    }
                }
                Action::Cross { edges, sine, .. } => {
                    for (k, e) in edges.iter().enumerate() {
                        tell(StepNumber::Length(k), length(span(&p.edges[*e])));
                    }
                    crossing(*sine, |moved| vector(moved * scale::number(p.mu)), pencil_mm)
                        .into_iter()
                        .for_each(|(what, n)| tell(what, n));
                }
                Action::Trials { target, sine, .. } => {
                    tell(StepNumber::Length(0), from_pole(p, *target).and_then(length));
                    crossing(*sine, |moved| vector(moved * scale::number(p.mu)), pencil_mm)
                        .into_iter()
                        .for_each(|(what, n)| tell(what, n));
                }
                Action::Reach(v) | Action::Copy { target: v, .. } => {
                    tell(StepNumber::Length(0), from_pole(p, *v).and_then(length))
                }
                Action::Join(e) => tell(StepNumber::Length(0), length(span(&p.edges[*e]))),
                Action::Perpendicular { edges, .. } => {
                    for (k, e) in edges.iter().enumerate() {
                        tell(StepNumber::Length(k), length(span(&p.edges[*e])));
                    }
                }
                Action::Rate(r) => {
                    let r = &paper.rates[*r];
                    let small = |n: &CertifiedNumber| {
                        n.enclosure().contains_zero()
                            && n.enclosure().largest() <= NOTHING * largest
                    };
                    let zero = match r.measured {
                        Some(m) => {
                            let mm = length_of(m.length);
                            let zero = mm.as_ref().is_some_and(|n| n.zero);
                            tell(StepNumber::Length(0), mm);
                            tell(StepNumber::Arm, some(book.in_chosen(Kind::Length, m.arm)));
                            zero
                        }
                        None => some(r.value).as_ref().is_some_and(small),
                    };
                    tell(StepNumber::Rate, some(turning(r.value)).map(|n| n.or_zero(zero)));
                }
                Action::Nothing { .. } | Action::Line { .. } | Action::Same { .. } => {}
            }
        }
    }
    out
}

/// The numbers of a crossing with this sine; `off` converts millimetres of its drawing to printed
/// units.
fn crossing<N: Certain>(
    sine: N,
    off: impl Fn(N) -> N,
    pencil_mm: Option<f64>,
) -> Vec<(StepNumber, Option<CertifiedNumber>)> {
    let mut told = vec![(StepNumber::Angle, some(angle_deg(sine)))];
    if let Some(e) = pencil_mm {
        let moved = scale::number::<N>(e) / sine.magnitude();
        told.extend([(StepNumber::Moved, some(moved)), (StepNumber::Off, some(off(moved)))]);
    }
    told
}

fn span<N: Real>(e: &Edge<Point<N>>) -> Vec2<N> {
    e.to.1 - e.from.1
}

fn from_pole<N: Real>(p: &Polygon<N>, v: VertexId) -> Option<Vec2<N>> {
    p.images[v.0].map(|q| q.to_vec2())
}

fn some<N: Certain>(x: N) -> Option<CertifiedNumber> {
    x.enclosure().map(CertifiedNumber::new)
}

/// A length on paper (mm), zero if it is certainly negligible.
fn length<N: Certain>(v: Vec2<N>) -> Option<CertifiedNumber> {
    length_of(v.norm())
}

fn length_of<N: Certain>(mm: N) -> Option<CertifiedNumber> {
    let n = some(mm)?;
    let nothing = n.enclosure().largest() <= NOTHING_MM;
    Some(n.or_zero(nothing))
}

/// The angle from 0 to 90 degrees with this sine, up to its sign.
fn angle_deg<N: Real>(sine: N) -> N {
    let cosine = (N::from_f64(1.0) - sine * sine).sqrt_or_zero();
    sine.magnitude().atan2(cosine) * N::from_f64(180.0) / N::pi()
}
