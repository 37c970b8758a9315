//! Curvature (曲率) of the paths of a link's points at an instant, by drawing and by analysis,
//! independently of one another.
//!
//! [`drawing`] takes two rays with known centres ([`known`]) and finds pole, inflection pole and
//! centres of curvature with the ruler alone (Bobillier, Euler–Savary); it needs no velocity.
//! [`mod@motion`] takes velocities, accelerations and third derivatives of the loop equations and
//! finds the same quantities, and those that depend on the driver's rate: pole velocity,
//! acceleration pole, Bresse's circle. [`centrodes`] are the paths of the pole in both planes. The
//! motion of any moving link relative to any other is covered.
//!
//! ```
//! use hodograph_methods::curvature;
//! use hodograph_scene as scene;
//! let scene = scene::read(scene::templates::get("crank-rocker").unwrap()).unwrap().value;
//! let asked = curvature::CurvatureRequest { links: curvature::couplers(&scene), ..Default::default() };
//! let found = curvature::curvature(&scene, &asked).unwrap().value;
//! assert!(found.list[0].apart().unwrap() < 1e-12);
//! ```

pub mod by_hand;
pub mod centrodes;
pub mod drawing;
#[doc(hidden)]
pub mod known;
pub mod motion;
#[doc(hidden)]
pub mod plane;

use crate::centres::moving_at_all;
use by_hand::CurvatureTolerances;
use drawing::{CurvatureDrawing, Traced};
use hodograph_analytic::third;
use hodograph_base::diag::{Diagnostic, Faults, Severity, Warned, both};
use hodograph_base::geom::{Point, Vec2};
use hodograph_board::construct::pencil::Hand;
use hodograph_mechanism::answer::{AnswerValue, MotionSource};
use hodograph_mechanism::mechanism::Level;
use hodograph_scene::quantity::{PointMotion, Rate, Turning};
use hodograph_scene::{Asked as Question, Find, LinkId, OnLink, PointId, Scene};
use hodograph_worked::worked::{Scope, Worked, work};
use known::CurvaturePlaces;
use motion::{Bend, PlaneMotion, PlaneState, PoleMotion as Pole};

/// The curvature that is asked for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CurvatureRequest {
    /// The links whose curvature is wanted.
    pub links: Vec<LinkId>,
    /// The reference link; `None` for the ground.
    pub against: Option<LinkId>,
    /// The points with wanted paths, each on every listed link that carries it; if empty, all
    /// points of the links.
    pub points: Vec<PointId>,
}

/// The curvature of some links.
#[derive(Clone, Debug)]
pub struct LinkCurvatures {
    /// The curvature of each link.
    pub list: Vec<OfLink>,
    /// The reference link of the motion.
    pub against: LinkId,
    /// The scene that asks for the motions. If all drivers are at rest in the file, they have unit
    /// rates here.
    pub scene: Scene,
    /// The solution of that scene.
    pub worked: Worked,
    /// True if all drivers are at rest in the file, so that unit rates are assumed.
    pub at_rest: bool,
}

/// The curvature of one link.
#[derive(Clone, Debug)]
pub struct OfLink {
    /// The link.
    pub link: LinkId,
    /// Its motion by analysis.
    pub motion: PlaneMotion,
    /// The kind of motion, and the quantities of the pole.
    pub state: PlaneState,
    /// The drawing.
    pub drawing: CurvatureDrawing,
    /// For each point the analysis, and the drawing if there is one.
    pub points: Vec<OfPoint>,
    /// ω and α read from the polygons; they serve to draw acceleration pole and pole velocity.
    pub read: Option<[f64; 2]>,
    /// The tolerances of hand drawing, if [`LinkCurvatures::with_drafting`] was called.
    pub by_hand: Option<CurvatureTolerances>,
}

/// The curvature of a point's path.
#[derive(Clone, Debug, PartialEq)]
pub struct OfPoint {
    /// The point.
    pub point: PointId,
    /// The place of the point (m).
    pub at: Point,
    /// The result of the analysis.
    pub bend: Bend,
    /// The result of the drawing.
    pub drawn: Option<Traced>,
}

impl OfPoint {
    /// Returns the bend as a figure shows it: about the centre that is drawn, else about the
    /// calculated one.
    pub fn shown(&self) -> Bend {
        match (self.bend, self.drawn.map(|drawn| drawn.centre)) {
            (Bend::About(..), Some(plane::PlanePoint::At(centre))) => {
                Bend::About(centre, centre.distance(self.at))
            }
            (bend, _) => bend,
        }
    }
}

/// The pole's places and circles on paper, from the drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawnPole {
    /// P, the pole.
    pub pole: Point,
    /// PJ.
    pub normal: Vec2,
    /// The acceleration pole: the foot of J on PJ turned by the angle with tangent α/ω².
    pub acceleration_pole: Option<Point>,
    /// u = ω PJ, square to PJ.
    pub pole_velocity: Option<Vec2>,
    /// Ball's point, from the two points on circles.
    pub ball: Option<Point>,
    /// The diameter of Bresse's circle from the pole: PJ turned by a quarter, times ω²/α.
    pub bresse: Option<Vec2>,
}

impl OfLink {
    /// Returns the quantities of the pole by analysis; `None` if the link does not turn.
    pub fn pole(&self) -> Option<Pole> {
        match self.state {
            PlaneState::Turning(pole) => Some(pole),
            PlaneState::Rest | PlaneState::Translation(_) => None,
        }
    }

    /// Returns the quantities of the pole that a figure shows: by drawing, and by analysis where
    /// there is no drawing.
    pub fn shown(&self) -> Option<Pole> {
        let pole = self.pole()?;
        let Some(drawn) = self.drawn().filter(|_| !pole.stands()) else { return Some(pole) };
        Some(Pole {
            pole: drawn.pole,
            normal: drawn.normal,
            pole_velocity: drawn.pole_velocity.unwrap_or(pole.pole_velocity),
            acceleration_pole: drawn.acceleration_pole.unwrap_or(pole.acceleration_pole),
            bresse: pole.bresse.and(drawn.bresse).or(pole.bresse),
            ball: pole.ball.and(drawn.ball).or(pole.ball),
        })
    }

    /// Returns the quantities of the pole by drawing; `None` if the drawing finds no pole.
    pub fn drawn(&self) -> Option<DrawnPole> {
        let (pole, normal) = self.drawing.pole()?;
        let ball = self.drawing.ball();
        let rates = self.read.filter(|[omega, _]| *omega != 0.0);
        let acceleration_pole = rates.map(|[omega, alpha]| {
            pole + (normal * (omega * omega)).divide_by(Vec2::new(omega * omega, -alpha))
        });
        let pole_velocity = rates.map(|[omega, _]| normal.perp() * omega);
        let bresse = rates
            .filter(|[_, alpha]| *alpha != 0.0)
            .map(|[omega, alpha]| normal.perp() * (omega * omega / alpha));
        Some(DrawnPole { pole, normal, acceleration_pole, pole_velocity, ball, bresse })
    }

    /// Returns the largest difference between drawing and analysis: the difference of a place,
    /// relative to the distances from which it is drawn; `None` if there is nothing to compare.
    pub fn apart(&self) -> Option<f64> {
        let (drawn, pole) = (self.drawn()?, self.pole()?);
        let size = self.motion.size;
        let apart = |a: Point, b: Point| {
            a.distance(b)
                / size.max(a.distance(drawn.pole)).max(drawn.pole.distance(self.motion.at))
        };
        let mut worst = apart(drawn.pole, pole.pole)
            .max(apart(drawn.pole + drawn.normal, pole.inflection_pole()));
        let end = |diameter: Option<Vec2>| Some(pole.pole + diameter?);
        let both = [
            (drawn.acceleration_pole, Some(pole.acceleration_pole)),
            (drawn.ball, pole.ball),
            (end(drawn.bresse), end(pole.bresse)),
        ];
        for (a, b) in both.into_iter().filter_map(|(a, b)| Some((a?, b?))) {
            worst = worst.max(apart(a, b));
        }
        for p in &self.points {
            let (Some(Traced { centre: plane::PlanePoint::At(c), .. }), Bend::About(at, rho)) =
                (p.drawn, p.bend)
            else {
                continue;
            };
            // A distant centre is as accurate as the small curvature of its path.
            worst = worst.max(c.distance(at) / size.max(rho * rho / size));
        }
        Some(worst)
    }
}

/// Returns the points of a link, and the pins of the guides in which it slides.
pub fn points(scene: &Scene, link: LinkId) -> Vec<PointId> {
    let mut out = scene.links[link.0].points.clone();
    let pins = scene.guides.iter().filter(|g| g.slider == Some(link)).filter_map(|g| g.pin);
    for p in pins {
        if !out.contains(&p) {
            out.push(p);
        }
    }
    out
}

/// Returns the links with a moving pole: those that neither turn about a pin of the ground nor
/// slide on it. Blocks, which have one point, are included only if there are no others.
pub fn couplers(scene: &Scene) -> Vec<LinkId> {
    let on_ground = |p: &PointId| scene.links[scene.ground.0].points.contains(p);
    let slides =
        |l: LinkId| scene.guides.iter().any(|g| g.slider == Some(l) && g.on == scene.ground);
    let floats = |l: &LinkId| {
        let points = points(scene, *l);
        *l != scene.ground && !slides(*l) && !points.is_empty() && !points.iter().any(on_ground)
    };
    let all: Vec<LinkId> = (0..scene.links.len()).map(LinkId).filter(floats).collect();
    let large: Vec<LinkId> =
        all.iter().copied().filter(|l| scene.links[l.0].points.len() > 1).collect();
    if large.is_empty() { all } else { large }
}

/// Finds the curvature of links at the instant of a scene.
///
/// # Errors
/// `no-coupler` if no link is named and all links turn about fixed pins or slide, and the faults of
/// [`work`].
pub fn curvature(
    scene: &Scene,
    asked: &CurvatureRequest,
) -> Result<Warned<LinkCurvatures>, Faults> {
    if asked.links.is_empty() {
        let message = both!(
            "all moving links turn about fixed pins or slide on the ground: none has a pole that moves"
        );
        return Err(Diagnostic::error("no-coupler", message)
            .help(both!("name a link with --link"))
            .into());
    }
    let (mut asking, at_rest) = moving_at_all(scene);
    let against = asked.against.unwrap_or(scene.ground);
    let links: Vec<LinkId> =
        asked.links.iter().copied().chain([against]).filter(|l| *l != scene.ground).collect();
    asking.find = links.iter().flat_map(|l| questions(scene, *l)).collect();
    let Warned { value: worked, mut notes } = work(&asking, Scope::Figure)?;
    notes.iter_mut().for_each(|d| d.severity = d.severity.min(Severity::Warning));
    let mut list = Vec::new();
    for link in &asked.links {
        match of_link(&asking, &worked, asked, *link, against) {
            Some(found) => list.push(found),
            None => notes.push(unknown(scene, *link)),
        }
    }
    Ok(Warned { value: LinkCurvatures { list, against, scene: asking, worked, at_rest }, notes })
}

fn unknown(scene: &Scene, link: LinkId) -> Diagnostic {
    let name = scene.link_name(link);
    let message = both!(
        "link {name} has no velocity or acceleration in this pose: its curvature is not told"
    );
    Diagnostic::warning("no-curvature", message).help(both!("choose a pose nearby"))
}

/// Returns the questions for the motion of a link: ω, α, and velocity and acceleration of its
/// points.
fn questions(scene: &Scene, link: LinkId) -> Vec<Find> {
    let find = |what: Question, text: String| Find { what, text, span: Default::default() };
    let name = scene.link_name(link);
    let mut out = Vec::new();
    for (rate, letters) in [(Rate::Velocity, ("omega", "v")), (Rate::Acceleration, ("alpha", "a"))]
    {
        out.push(find(
            Turning { rate, of: link, against: None }.into(),
            format!("{}_{name}", letters.0),
        ));
        for p in &points(scene, link) {
            let of = OnLink { point: *p, link: None };
            out.push(find(
                PointMotion { rate, of }.into(),
                format!("{}_{}", letters.1, scene.point_name(*p)),
            ));
        }
    }
    out
}

/// Returns the motion of a link relative to another, at the link's first known place.
pub fn motion(
    scene: &Scene,
    worked: &Worked,
    link: LinkId,
    against: LinkId,
) -> Option<PlaneMotion> {
    let Worked { solution, configuration, mechanism, demand, .. } = worked;
    let at = scene.links[link.0].points.iter().find_map(|p| configuration.points[p.0]).or_else(
        || {
            scene
                .guides
                .iter()
                .filter(|g| g.slider == Some(link) || g.on == link)
                .find_map(|g| configuration.points[g.pin?.0])
        },
    )?;
    let of = |level, l| solution.of_link(level, l, at);
    let turning = |level, l| if l == scene.ground { Some(0.0) } else { solution.turning(level, l) };
    let (omega, frame) = (turning(Level::Velocity, link)?, turning(Level::Velocity, against)?);
    let (alpha, frames) =
        (turning(Level::Acceleration, link)?, turning(Level::Acceleration, against)?);
    let v = of(Level::Velocity, link)? - of(Level::Velocity, against)?;
    let whole = of(Level::Acceleration, link)? - of(Level::Acceleration, against)?;
    // Relative to the turning frame: (d/dt − iω)² and (d/dt − iω)³ of the vector from the frame's
    // own point.
    let a = whole - v.perp() * (2.0 * frame);
    let thirds = third(scene, mechanism, configuration, demand, solution, at);
    let relative = |(j, b): (Vec2, f64), (k, c): (Vec2, f64)| {
        let seen = (j - k)
            - whole.perp() * (3.0 * frame)
            - (v.perp() * frames + v * (frame * frame)) * 3.0;
        (seen, b - c)
    };
    let third = thirds[link.0].zip(thirds[against.0]).map(|(one, other)| relative(one, other));
    let size = Some(configuration.extent()).filter(|s| *s > 0.0).unwrap_or(1.0);
    let largest = solution
        .largest(Level::Velocity, true)
        .max(solution.largest(Level::Velocity, false) / size);
    Some(PlaneMotion {
        at,
        v,
        omega: omega - frame,
        a,
        alpha: alpha - frames,
        third,
        size,
        largest,
    })
}

fn of_link(
    scene: &Scene,
    worked: &Worked,
    asked: &CurvatureRequest,
    link: LinkId,
    against: LinkId,
) -> Option<OfLink> {
    let motion = motion(scene, worked, link, against)?;
    let hand = Hand::default();
    let places = CurvaturePlaces { scene, at: &worked.configuration, against, hand: &hand };
    let drawing = places.drawing_behind(link, &[]);
    let own = points(scene, link);
    let wanted: Vec<PointId> = own
        .iter()
        .copied()
        .filter(|p| asked.points.is_empty() || asked.points.contains(p))
        .collect();
    let of_point = |p: &PointId| {
        let at = worked.configuration.points[p.0]?;
        Some(OfPoint { point: *p, at, bend: motion.bend(at), drawn: places.traced(&drawing, *p) })
    };
    let points = wanted.iter().filter_map(of_point).collect();
    let read = |rate| {
        let of = |l: LinkId| {
            if l == scene.ground {
                return Some(0.0);
            }
            let what = Turning { rate, of: l, against: None }.into();
            let result = worked.results.iter().find(|r| scene.find[r.find].what == what)?;
            match result.drawn.as_ref().map_or(result.computed, |d| d.value) {
                AnswerValue::Scalar(s) => Some(s),
                AnswerValue::Vector(_) | AnswerValue::Point(_) => None,
            }
        };
        Some(of(link)? - of(against)?)
    };
    let read = read(Rate::Velocity).zip(read(Rate::Acceleration)).map(|(a, b)| [a, b]);
    Some(OfLink { link, state: motion.state(), motion, drawing, points, read, by_hand: None })
}
