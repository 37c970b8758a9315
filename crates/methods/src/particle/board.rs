//! The drawing of motions without a mechanism at the instant: places, velocities and accelerations
//! to scale.
//!
//! A pursuit is drawn: the board takes the places and the speeds from the laws; directions are
//! transferred with the ruler, lengths are measured, and angular velocities are quotients of
//! measured lengths. The place of the pursuer at the instant cannot be found with the ruler: it is
//! integrated, and the sentences say so, with their symbols between dollar signs. The drawing uses
//! nothing of [`super::solve`]. The vectors of a plate are calculated from the laws and shown to
//! scale: nothing is measured on them, and they prove no answer.

mod chase;

pub use chase::{FINE, SIGHTS};

use super::ask::ParticleQuantity;
use super::law::{PathLaw, jet, sine_cosine};
use super::plate::PlateComponent;
use super::{ParticleMotion, ParticleMotionKind, ParticleProblem};
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::digits::significant;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::{Big, Jet, Real, within};
use hodograph_board::construct::scale::fitted;
use hodograph_scene::{self as scene, DiagramKind, front::Law};

/// The space for a drawing (mm).
pub const ROOM_MM: [f64; 2] = [70.0, 60.0];
/// The space for a length in one of the two views of a plate (mm): arrows begin at the point, and
/// the point's own place needs space too.
const VIEW_MM: [f64; 2] = [0.6 * ROOM_MM[0], 0.6 * ROOM_MM[1]];

/// A drawn vector: its symbol in the label language, tail and tip (mm).
#[derive(Clone, Debug, PartialEq)]
pub struct Arrow {
    /// The symbol.
    pub symbol: String,
    /// The tail.
    pub from: Point,
    /// The tip.
    pub to: Point,
    /// True if it is the absolute vector, the sum of the others.
    pub whole: bool,
    /// The index of the step that draws it.
    pub step: usize,
}

/// The drawing of a motion.
#[derive(Clone, Debug)]
pub struct MotionDrawing {
    /// The index of the motion.
    pub motion: usize,
    /// The scales: m, m/s and m/s² per millimetre.
    pub mu: [f64; 3],
    /// The steps of the drawing, one sentence each.
    pub steps: Vec<Both>,
    /// The measured or calculated values: vectors by their components, in SI.
    pub readings: Vec<(ParticleQuantity, Vec<f64>)>,
    /// True if the vectors are calculated and shown to scale, and none of them is measured.
    pub calculated: bool,
    /// The reason for which some answers are not measured.
    pub unread: Option<Diagnostic>,
    /// The views.
    pub views: Views,
}

impl MotionDrawing {
    /// Returns the scale of a diagram (SI per mm).
    pub fn scale(&self, on: DiagramKind) -> f64 {
        match on {
            DiagramKind::Plane => self.mu[0],
            DiagramKind::Velocity => self.mu[1],
            DiagramKind::Acceleration => self.mu[2],
            // The drawing of a motion of points has no forces.
            DiagramKind::Force => 1.0,
        }
    }
}

/// The views of a drawing; all coordinates in mm.
#[derive(Clone, Debug)]
pub enum Views {
    /// A pursuer, its target, and the polygons from their poles in the origin.
    Chase {
        /// Pursuer and target from the start to the end at equal times.
        course: Vec<[Point; 2]>,
        /// The time of the meeting, or the end of the drawn course (s).
        until: f64,
        /// True if the two meet.
        meets: bool,
        /// Pursuer and target.
        places: [Point; 2],
        /// Velocities.
        velocities: Vec<Arrow>,
        /// The foot of the perpendicular from b on the line of v_A.
        foot: Point,
        /// Accelerations.
        accelerations: Vec<Arrow>,
    },
    /// A plate, viewed square to it (to the right: away from the axis, up: along the axis) and
    /// along its axis.
    Plate {
        /// The point in both views.
        places: [Point; 2],
        /// The direction of the plate in the view along the axis.
        along: Vec2,
        /// Velocities in both views, from the point.
        velocities: [Vec<Arrow>; 2],
        /// Accelerations in both views, from the point.
        accelerations: [Vec<Arrow>; 2],
    },
}

/// The laws, evaluated at the instant with an accuracy of double precision for every instant. The
/// sine of an angle of 10⁹ rad loses half of its digits if the angle is rounded first, so the laws
/// are evaluated in longer numbers and then rounded.
struct InstantLaws<'a> {
    time: &'a Law,
}

/// Bits of the longer numbers.
const BITS: usize = 256;

type Jet3 = [f64; 3];

impl InstantLaws<'_> {
    fn evaluated<T>(&self, of: impl FnOnce(Big) -> Result<T, Diagnostic>) -> Result<T, Diagnostic> {
        within(BITS, || of(self.time.at(Big::from_f64(0.0))?.number.0[0]))
    }

    /// Returns a law's value and derivatives.
    fn law(&self, law: &Law) -> Result<Jet3, Diagnostic> {
        self.evaluated(|t| Ok(rounded(jet(law, t)?)))
    }

    /// Returns two coordinates with their derivatives.
    fn way(&self, way: &PathLaw) -> Result<[Jet3; 2], Diagnostic> {
        self.evaluated(|t| Ok(way.at(t)?.map(rounded)))
    }
}

fn rounded(jet: Jet<Big>) -> Jet3 {
    jet.0.map(|x| x.approx())
}

/// Draws all motions except those in the fixed plane by a law: pursuits are drawn, points on plates
/// are shown as calculated.
///
/// # Errors
/// Laws without a value.
pub fn draw(problem: &ParticleProblem) -> Result<Vec<MotionDrawing>, Diagnostic> {
    draw_again(problem, &[])
}

/// Draws all motions, with the known courses of a drawing at another instant: these are not
/// integrated again.
///
/// # Errors
/// The errors of [`draw`].
pub fn draw_again(
    problem: &ParticleProblem,
    known: &[MotionDrawing],
) -> Result<Vec<MotionDrawing>, Diagnostic> {
    let mut out = Vec::new();
    for (k, m) in problem.motions.iter().enumerate() {
        match m.kind {
            ParticleMotionKind::Toward { .. } => {
                out.extend(chase::draw(problem, k, m, known.iter().find(|d| d.motion == k))?)
            }
            ParticleMotionKind::OnPlate(..) => out.extend(plate(problem, k, m)?),
            ParticleMotionKind::Fixed(_) => {}
        }
    }
    Ok(out)
}

fn mm(x: f64) -> String {
    significant(x, 4).replace('-', "−")
}

fn arrow(symbol: &str, from: Point, by: Vec2, whole: bool, step: usize) -> Arrow {
    Arrow { symbol: symbol.to_owned(), from, to: from + by, whole, step }
}

/// Returns the largest extent of vectors.
fn most(all: &[Vec2]) -> [f64; 2] {
    all.iter().fold([0.0_f64; 2], |[x, y], v| [x.max(v.x.abs()), y.max(v.y.abs())])
}

/// The place in the view on the plate, the velocity there, and the normal and tangential parts of
/// the acceleration.
struct OnPlate {
    place: Point,
    velocity: Vec2,
    normal: Vec2,
    tangential: Vec2,
}

fn on_plate(way: &PathLaw, laws: &InstantLaws) -> Result<OnPlate, Diagnostic> {
    let [r, z] = laws.way(way)?;
    let place = Point::new(r[0], z[0]);
    Ok(match way {
        PathLaw::Line { angle, s, .. } => {
            let [sine, cosine] =
                laws.evaluated(|t| sine_cosine(angle, t).map(|(s, c)| [s, c].map(rounded)))?;
            let (along, s) = (Vec2::new(sine[0], cosine[0]), laws.law(s)?);
            OnPlate { place, velocity: along * s[1], normal: Vec2::ZERO, tangential: along * s[2] }
        }
        PathLaw::Circle { centre, radius, s, .. } => {
            let centre = Point::new(laws.law(&centre[0])?[0], laws.law(&centre[1])?[0]);
            let (radius, s) = (laws.law(radius)?[0], laws.law(s)?);
            let inward = (centre - place) * (1.0 / radius);
            let along = -inward.perp();
            OnPlate {
                place,
                velocity: along * s[1],
                normal: inward * (s[1] * s[1] / radius),
                tangential: along * s[2],
            }
        }
        PathLaw::Polar { .. } | PathLaw::Free(_) => {
            let (velocity, a) = (Vec2::new(r[1], z[1]), Vec2::new(r[2], z[2]));
            let tangential = velocity.unit().map_or(a, |e| e * e.dot(a));
            OnPlate { place, velocity, normal: a - tangential, tangential }
        }
    })
}

fn plate(
    problem: &ParticleProblem,
    k: usize,
    m: &ParticleMotion,
) -> Result<Option<MotionDrawing>, Diagnostic> {
    let ParticleMotionKind::OnPlate(p, way) = &m.kind else { return Ok(None) };
    let (plate, laws) = (&problem.plates[*p], InstantLaws { time: &problem.time });
    let offset = plate.offset.as_ref().map(|law| laws.law(law)).transpose()?.map_or(0.0, |j| j[0]);
    let on = on_plate(way, &laws)?;
    // cos φ and sin φ, ω and α.
    let [cosine, sine, w, alpha] = laws.evaluated(|t| {
        let turn = plate.turning.at(t)?;
        Ok([turn.cos.0[0], turn.sin.0[0], turn.omega, turn.alpha].map(|x| x.approx()))
    })?;
    // The two views: u to the right and the axis up; the plate in its direction, with its foot on
    // the side of the axis.
    let along = Vec2::new(cosine, sine);
    let seen = (along * on.place.x + along.perp() * offset).to_point();
    let extent = most(&[on.place.to_vec2(), seen.to_vec2()]);
    let mu_l = fitted(&problem.paper, scene::Kind::Length, extent, VIEW_MM);
    let (front, top) = (
        (on.place.to_vec2() * (1.0 / mu_l)).to_point(),
        (seen.to_vec2() * (1.0 / mu_l)).to_point(),
    );
    let arm = top.to_vec2();
    let reach = arm.norm() * mu_l;
    let ring = arm.perp() * mu_l;
    let (ve, vr) = (ring * w, along * on.velocity.x);
    let mu_v = fitted(
        &problem.paper,
        scene::Kind::Velocity,
        most(&[ve, vr, ve + vr, on.velocity]),
        VIEW_MM,
    );
    let paper_v = |v: Vec2| v * (1.0 / mu_v);
    // The horizontal component of v_r in the view on the plate is its length in the view along the
    // axis.
    let across = paper_v(on.velocity).x;
    let (aen, aet) = (arm * (-w * w * mu_l), ring * alpha);
    let ak = along.perp() * (2.0 * w * across * mu_v);
    let a_r = on.normal + on.tangential;
    let ar = along * a_r.x;
    let whole = aen + aet + ar + ak;
    let mu_a = fitted(
        &problem.paper,
        scene::Kind::Acceleration,
        most(&[aen, aet, ak, ar, whole, a_r]),
        VIEW_MM,
    );
    let paper_a = |v: Vec2| v * (1.0 / mu_a);
    let add = |all: &mut Vec<Arrow>, symbol: &str, at: Point, v: Vec2, whole: bool, step: usize| {
        if v.norm() > 0.5 {
            all.push(arrow(symbol, at, v, whole, step));
        }
    };
    let (mut v_front, mut v_top, mut a_front, mut a_top) =
        (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    add(&mut v_front, "v_r", front, paper_v(on.velocity), true, 0);
    let v_top_whole = paper_v(ve) + paper_v(vr);
    for (symbol, v, whole) in
        [("v_e", paper_v(ve), false), ("v_r'", paper_v(vr), false), ("v_a'", v_top_whole, true)]
    {
        add(&mut v_top, symbol, top, v, whole, 1);
    }
    if on.normal.norm() > 0.0 && on.tangential.norm() <= 1e-9 * on.normal.norm() {
        add(&mut a_front, "a_r^n", front, paper_a(on.normal), true, 2);
    } else if on.normal.norm() > 0.0 {
        for (symbol, v, whole) in
            [("a_r^n", on.normal, false), ("a_r^t", on.tangential, false), ("a_r", a_r, true)]
        {
            add(&mut a_front, symbol, front, paper_a(v), whole, 2);
        }
    } else {
        add(&mut a_front, "a_r", front, paper_a(a_r), true, 2);
    }
    for (symbol, v, whole) in [
        ("a_e^n", aen, false),
        ("a_e^t", aet, false),
        ("a_r'", ar, false),
        ("a_k", ak, false),
        ("a_a'", whole, true),
    ] {
        add(&mut a_top, symbol, top, paper_a(v), whole, if symbol == "a_k" { 3 } else { 4 });
    }
    let order = plate.axis.order();
    let space = |flat: Vec2, up: f64| {
        let mut out = vec![0.0; 3];
        for (place, value) in order.into_iter().zip([flat.x, flat.y, up]) {
            out[place] = value;
        }
        out
    };
    let flat = |v: Vec2| space(along * v.x, v.y);
    let part = |part: PlateComponent, v: Vec<f64>| (ParticleQuantity::Part(k, part), v);
    let readings = vec![
        (ParticleQuantity::Place(k), space(seen.to_vec2(), front.y * mu_l)),
        (ParticleQuantity::Velocity(k), space(v_top_whole * mu_v, paper_v(on.velocity).y * mu_v)),
        (ParticleQuantity::Acceleration(k), space(paper_a(whole) * mu_a, paper_a(a_r).y * mu_a)),
        part(PlateComponent::TransportVelocity, space(ve, 0.0)),
        part(PlateComponent::RelativeVelocity, flat(on.velocity)),
        part(PlateComponent::Transport, space(aen + aet, 0.0)),
        part(PlateComponent::TransportNormal, space(aen, 0.0)),
        part(PlateComponent::TransportTangential, space(aet, 0.0)),
        part(PlateComponent::Relative, flat(a_r)),
        part(PlateComponent::RelativeNormal, flat(on.normal)),
        part(PlateComponent::RelativeTangential, flat(on.tangential)),
        part(PlateComponent::Coriolis, space(ak, 0.0)),
    ];
    let steps = vec![
        both!(
            "View on the plate: $v_r$ along the path is {} mm long; its part across the axis is {} mm, along it {} mm, which is $v_{{{}}}$",
            mm(paper_v(on.velocity).norm()),
            mm(across.abs()),
            mm(paper_v(on.velocity).y.abs()),
            plate.axis.letter()
        ),
        both!(
            "View along the axis: the arm is {} mm long; $v_e$ = $\\omega$ · {} m square to it, $v_r'$ = {} mm along the plate; the diagonal is {} mm",
            mm(arm.norm()),
            mm(reach),
            mm(across.abs()),
            mm(v_top_whole.norm())
        ),
        both!(
            "View on the plate: the relative acceleration $a_r$ is {} mm long, its part across the axis {} mm",
            mm(paper_a(a_r).norm()),
            mm(paper_a(a_r).x.abs())
        ),
        both!(
            "Calculate $a_c = 2 \\omega v_r \\sin \\theta$ = $2 \\omega$ · {} mm · $\\mu_v$ = {} m/s²; it is square to the plate, $v_r'$ turned by 90° in the sense of $\\omega$",
            mm(across.abs()),
            mm(ak.norm())
        ),
        both!(
            "View along the axis: $a^n_e$ = $\\omega^2$ · {} m toward the axis{}; the sum of all parts is {} mm long; along the axis $a_{{{}}}$ = {} mm in the view on the plate",
            mm(reach),
            if alpha == 0.0 {
                Both::default()
            } else {
                both!(", $a^t_e$ = $\\alpha$ · {} m square to it", mm(reach))
            },
            mm(paper_a(whole).norm()),
            plate.axis.letter(),
            mm(paper_a(a_r).y)
        ),
    ];
    let views = Views::Plate {
        places: [front, top],
        along,
        velocities: [v_front, v_top],
        accelerations: [a_front, a_top],
    };
    let steps = steps.into_iter().map(Both::sentence).collect();
    Ok(Some(MotionDrawing {
        motion: k,
        mu: [mu_l, mu_v, mu_a],
        steps,
        readings,
        calculated: true,
        unread: None,
        views,
    }))
}
