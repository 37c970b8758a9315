//! `rho_E`, `O_E`, `J_2`, `d_2`, `K_2`, `u_2`, `p_24`: the curvature of the path of a point, and
//! the quantities of the pole of a link.
//!
//! From velocities and accelerations at the instant: ρ = v³/(v × a), its centre O = E + i v · v²/(v
//! × a); P = B + i v_B/ω, PJ = a_P/ω², u = i a_P/ω, K = P + a_P/(ω² − iα). `J_2/3` is observed from
//! link 3, with relative velocities and accelerations. The module `curvature` draws these
//! quantities and treats the cases in which they do not exist.

use super::value::{fastest, largest, vanishes};
use super::{
    AnswerValue, Entry, FormulaInputs, Level, Meaning, Need, Of, OverSign, Quantity, ValueForm,
};
use crate::model::{LinkId, OnLink, PointId, Scene};
use crate::resolve::Question;
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::kind::Kind;
use hodograph_base::lang::each;
use hodograph_base::number::Real;

/// A quantity of a path, or of the pole of a link.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Curvature {
    /// The radius of curvature of a point's path, or its centre.
    Path(OnLink, OfPath),
    /// A quantity of the pole of a link relative to another; each link has a reference point, the
    /// ground needs none.
    Pole([(LinkId, Option<PointId>); 2], OfPole),
}

/// Quantities of the path of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum OfPath {
    /// The radius of curvature ρ.
    Radius,
    /// The centre of curvature.
    Centre,
}

/// Quantities of the pole of a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum OfPole {
    /// The inflection pole J.
    InflectionPole,
    /// The diameter PJ of the inflection circle.
    Diameter,
    /// The acceleration pole K.
    AccelerationPole,
    /// The pole velocity u.
    PoleVelocity,
    /// The pole in the axes of the link.
    InLink,
}

/// Rows of the table.
const PATHS: [OfPath; 2] = [OfPath::Radius, OfPath::Centre];
const POLES: [OfPole; 5] = [
    OfPole::InflectionPole,
    OfPole::Diameter,
    OfPole::AccelerationPole,
    OfPole::PoleVelocity,
    OfPole::InLink,
];

impl Quantity for Curvature {
    const WRITTEN: &'static [Entry] = &[
        Entry::new(
            "rho",
            "rho_E",
            Kind::Length,
            ValueForm::Scalar,
            each!("radius of curvature of the path"),
        )
        .printed("\\rho", OverSign::Nothing)
        .at_level(Level::Acceleration),
        Entry::new(
            "O",
            "O_E",
            Kind::Length,
            ValueForm::Point,
            each!("centre of curvature of the path"),
        )
        .at_level(Level::Acceleration),
        Entry::new("J", "J_2", Kind::Length, ValueForm::Point, each!("inflection pole"))
            .at_level(Level::Acceleration),
        Entry::new(
            "d",
            "d_2",
            Kind::Length,
            ValueForm::Scalar,
            each!("diameter of the inflection circle"),
        )
        .at_level(Level::Acceleration),
        Entry::new("K", "K_2", Kind::Length, ValueForm::Point, each!("acceleration pole"))
            .at_level(Level::Acceleration),
        Entry::new("u", "u_2", Kind::Velocity, ValueForm::Vector, each!("pole velocity"))
            .at_level(Level::Acceleration),
        Entry::new(
            "p",
            "p_2",
            Kind::Length,
            ValueForm::Point,
            each!("pole in the axes of the link"),
        )
        .at_level(Level::Velocity),
    ];

    fn read(question: &Question<'_>) -> Result<Option<Curvature>, Diagnostic> {
        let row = question.row(Self::WRITTEN);
        if let Some(of) = PATHS.get(row) {
            // ρ of a cam belongs to two links, its least value to one.
            let names = question.names();
            if *of == OfPath::Radius
                && (names.contains('/')
                    || names.starts_with("min_")
                    || question.link(names).is_ok())
            {
                return Ok(None);
            }
            let (point, second) = question.points()?;
            return match second {
                None => Ok(Some(Curvature::Path(point, *of))),
                Some(_) => Err(question
                    .fault(both!("`{}` names two points; a path is of one", question.text()))),
            };
        }
        let names = question.names();
        let links = match names.split_once('/') {
            Some((link, against)) => [question.link(link.trim())?, question.link(against.trim())?],
            None => [question.link(names)?, question.ground()],
        };
        if links[0] == links[1] {
            return Err(question
                .fault(both!("`{}` is of a link against itself", question.text()))
                .help(both!("ask for a moving link")));
        }
        let mut of = links.map(|l| (l, None));
        for (link, point) in of.iter_mut().filter(|(l, _)| !question.is_ground(*l)) {
            *point = question.first_point(*link);
            if point.is_none() {
                let d = question.fault(both!(
                    "`{}`: a link without a point of its own has no such quantity in `find`",
                    question.text()
                ));
                return Err(d.help(both!("give the link a point")));
            }
        }
        Ok(Some(Curvature::Pole(of, POLES[row - PATHS.len()])))
    }

    fn entry(&self) -> &'static Entry {
        &Self::WRITTEN[match self {
            Curvature::Path(_, of) => PATHS.iter().position(|p| p == of).unwrap_or(0),
            Curvature::Pole(_, of) => PATHS.len() + POLES.iter().position(|p| p == of).unwrap_or(0),
        }]
    }

    fn of(&self) -> Of {
        match *self {
            Curvature::Path(p, _) => Of::Point(p),
            Curvature::Pole([(link, _), (_, None)], _) => Of::Link(link),
            Curvature::Pole([(link, _), (against, _)], _) => Of::Links(link, against),
        }
    }

    fn meaning(&self, _scene: &Scene) -> Option<Meaning> {
        None
    }

    fn no_value(&self, scene: &Scene) -> Both {
        match *self {
            Curvature::Path(p, _) => {
                let name = scene.point_name(p.point);
                both!(
                    "{name} stands still or its path is straight there: it has no centre of curvature"
                )
            }
            Curvature::Pole(links, _) => {
                let [i, j] = links.map(|(l, _)| scene.link_name(l));
                both!("links {i} and {j} do not turn against one another: they have no pole")
            }
        }
    }

    fn needs(&self) -> Vec<(Need, Level)> {
        let level = self.entry().level;
        match *self {
            Curvature::Path(p, _) => vec![(Need::Point(p.point, p.link), level)],
            Curvature::Pole(links, _) => {
                let moving = links.into_iter().filter_map(|(l, p)| Some((l, p?)));
                moving
                    .flat_map(|(l, p)| [Need::Turning(l), Need::Point(p, Some(l))])
                    .map(|need| (need, level))
                    .collect()
            }
        }
    }

    fn value<N: Real, K: FormulaInputs<N>>(&self, known: &K) -> Option<AnswerValue<N>> {
        match *self {
            Curvature::Path(p, of) => path(known, &p, of),
            Curvature::Pole(links, of) => pole(known, links, of),
        }
    }
}

fn path<N: Real, K: FormulaInputs<N>>(known: &K, p: &OnLink, of: OfPath) -> Option<AnswerValue<N>> {
    let (v, a) = (known.vector(Level::Velocity, p)?, known.vector(Level::Acceleration, p)?);
    let (square, turn) = (v.norm2(), v.cross(a));
    // The rounding error of v and a is that of the largest velocity and acceleration.
    let [fast, strong] = [(Level::Velocity, v), (Level::Acceleration, a)]
        .map(|(level, own)| largest(known, level).max(own.norm().approx()));
    if vanishes(turn, fast * a.norm().approx() + strong * v.norm().approx()) {
        return None;
    }
    match of {
        OfPath::Radius => {
            let radius = square * square.sqrt() / turn;
            let radius = if turn.approx() < 0.0 { -radius } else { radius };
            radius.is_decided().then_some(AnswerValue::Scalar(radius))
        }
        OfPath::Centre => {
            let centre = known.point(p.point)? + v.perp() * (square / turn);
            centre.is_finite().then_some(AnswerValue::Point(centre))
        }
    }
}

/// The motion of one link relative to another at a place: velocity, ω, acceleration, α.
struct RelativeState<N> {
    at: Point<N>,
    v: Vec2<N>,
    omega: N,
    a: Vec2<N>,
    alpha: N,
}

fn seen<N: Real, K: FormulaInputs<N>>(
    known: &K,
    links: [(LinkId, Option<PointId>); 2],
    level: Level,
) -> Option<RelativeState<N>> {
    let zero = N::from_f64(0.0);
    let at = known.point(links.iter().find_map(|(_, p)| *p)?)?;
    let deep = level == Level::Acceleration;
    let motion = |(link, point): (LinkId, Option<PointId>)| {
        let Some(point) = point else { return Some((Vec2::zero(), zero, Vec2::zero(), zero)) };
        let own = OnLink { point, link: Some(link) };
        let r = at - known.point(point)?;
        let omega = known.turning(Level::Velocity, link)?;
        let v = known.vector(Level::Velocity, &own)? + r.perp() * omega;
        if !deep {
            return Some((v, omega, Vec2::zero(), zero));
        }
        let alpha = known.turning(Level::Acceleration, link)?;
        let a = known.vector(Level::Acceleration, &own)? + r.perp() * alpha - r * (omega * omega);
        Some((v, omega, a, alpha))
    };
    let ((v, omega, a, alpha), (w, frame, b, turns)) = (motion(links[0])?, motion(links[1])?);
    let relative = omega - frame;
    if vanishes(relative, fastest(known)) {
        return None;
    }
    let v = v - w;
    Some(RelativeState {
        at,
        v,
        omega: relative,
        a: a - b - v.perp() * (N::from_f64(2.0) * frame),
        alpha: alpha - turns,
    })
}

fn pole<N: Real, K: FormulaInputs<N>>(
    known: &K,
    links: [(LinkId, Option<PointId>); 2],
    of: OfPole,
) -> Option<AnswerValue<N>> {
    let level = if of == OfPole::InLink { Level::Velocity } else { Level::Acceleration };
    let RelativeState { at, v, omega, a, alpha } = seen(known, links, level)?;
    let one = N::from_f64(1.0);
    let arm = v.perp() * (one / omega);
    let square = omega * omega;
    let a = a + arm.perp() * alpha - arm * square;
    let pole = at + arm;
    let place = |p: Point<N>| p.is_finite().then_some(AnswerValue::Point(p));
    match of {
        OfPole::InLink => {
            let base = known.point(links[0].1?)?;
            place((pole - base).divide_by(known.direction(links[0].0)?.unit()?).to_point())
        }
        OfPole::InflectionPole => place(pole + a * (one / square)),
        OfPole::AccelerationPole => place(pole + a.divide_by(Vec2::new(square, -alpha))),
        OfPole::Diameter => {
            let d = a.norm() / square;
            d.is_decided().then_some(AnswerValue::Scalar(d))
        }
        OfPole::PoleVelocity => {
            let u = a.perp() * (one / omega);
            u.is_finite().then_some(AnswerValue::Vector(u))
        }
    }
}
