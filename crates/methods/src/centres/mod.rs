//! Instantaneous centres of velocity (瞬心): their number, the order in which they are found, their
//! places, and their use.
//!
//! A centre P_ij is the place at which two links have the same velocity. From topology alone follow
//! the centres that are known at once ([`primary`]) and the rounds in which the Aronhold-Kennedy
//! theorem finds the others ([`rounds`]). Positions give the two lines drawn for each centre
//! ([`lines`]) and their crossing ([`locate`]). The loop equations give the centres that a stalled
//! closure lacks, and check that each centre has the same velocity on both links ([`velocities`]).
//! [`uses`] derives angular velocities and speeds from centres.
//!
//! ```
//! use hodograph_methods::centres;
//! use hodograph_scene as scene;
//! let scene = scene::read(scene::templates::get("crank-rocker").unwrap()).unwrap().value;
//! let found = centres::centres(&scene).unwrap().value;
//! assert_eq!(found.list.len(), 6);
//! ```
//!
//! # Source
//! S. Aronhold, 1872; A. B. W. Kennedy, 1886: the centres of three links are collinear.

mod by_hand;
mod lines;
mod locate;
mod normals;
mod primary;
mod rounds;
mod task;
mod uses;
mod velocities;

pub use by_hand::CentreTolerances;
pub use lines::CentrePlace;
pub use locate::{Centre, Origin, Undetermined};
pub use normals::VelocityNormal as ByVelocity;
pub use primary::{Primary, SlotNormal};
pub use rounds::{CentreClosure, CentreLocus, CentreMethod, CentreStep, LinkPair};
pub use task::CentreTask;
pub use uses::{CentreMotion, CentreMotionSource, RelativeMotion, Speed, Uses};

use hodograph_base::diag::{Both, Diagnostic, Faults, Severity, Warned, both};
use hodograph_mechanism::answer::AnswerValue;
use hodograph_mechanism::mechanism::{Demand, Mechanism};
use hodograph_mechanism::position::Configuration;
use hodograph_scene::quantity::{self, PointMotion, Rate};
use hodograph_scene::{Asked, Find, LinkId, OnLink, PointId, Scene};
use hodograph_worked::worked::{Scope, Worked, work, work_placed};
use velocities::Velocities;

/// The largest permitted number of links: more links have thousands of centres, each with a line
/// through every other link.
pub const MOST_LINKS: usize = 64;

/// All centres of a mechanism in its pose.
#[derive(Clone, Debug)]
pub struct Centres {
    /// The order of finding, from topology alone.
    pub closure: CentreClosure,
    /// Every centre, in the order of finding.
    pub list: Vec<Centre>,
    /// Angular velocities and speeds by centres.
    pub uses: Uses,
    /// The scene that asks for all velocities. If all drivers are at rest in the file, they have
    /// unit rates here.
    pub scene: Scene,
    /// The solution of that scene.
    pub worked: Worked,
    /// The largest deviation of a triple P_ij, P_ik, P_jk from collinearity: the volume of their
    /// unit vectors in projective coordinates.
    pub worst_triple: f64,
    /// True if all drivers are at rest in the file, so that unit rates are assumed.
    pub at_rest: bool,
    /// The tolerances of hand drawing, if [`Centres::with_drafting`] was called.
    pub by_hand: Option<CentreTolerances>,
}

impl Centres {
    /// Returns the centre of two different links.
    pub fn of(&self, a: LinkId, b: LinkId) -> Option<&Centre> {
        let pair = self.closure.pair(a, b);
        self.list.iter().find(|c| c.step.pair == pair)
    }

    /// Returns the answers of the drawing and of the loop equations to a question of
    /// [`Centres::scene`]; each is `None` if there is no answer.
    pub fn other_ways(&self, what: &Asked) -> [Option<AnswerValue>; 2] {
        let result = self.worked.results.iter().find(|r| self.scene.find[r.find].what == *what);
        [result.and_then(|r| r.drawn.as_ref()).map(|a| a.value), result.map(|r| r.computed)]
    }

    /// Returns the largest relative velocity of two links at their centre, divided by the
    /// velocities at its distance.
    pub fn worst_residual(&self) -> f64 {
        self.list.iter().filter_map(|c| c.residual).fold(0.0, f64::max)
    }
}

/// Returns the number of centres of a mechanism with `links` links: N(N − 1)/2. The ground counts
/// as a link.
///
/// ```
/// assert_eq!([3, 4, 5, 6].map(hodograph_methods::centres::count), [3, 6, 10, 15]);
/// ```
pub fn count(links: usize) -> usize {
    links * links.saturating_sub(1) / 2
}

/// Finds all centres of a scene in its pose.
///
/// # Errors
/// `too-many-links`, and the faults of [`work`].
pub fn centres(scene: &Scene) -> Result<Warned<Centres>, Faults> {
    if scene.links.len() > MOST_LINKS {
        let message = both!(
            "{} links have {} centres; at most {MOST_LINKS} links are taken",
            scene.links.len(),
            count(scene.links.len())
        );
        let help = both!("take the part of the mechanism whose centres are wanted");
        return Err(Diagnostic::error("too-many-links", message).help(help).into());
    }
    let (asking, at_rest) = asking_all(scene);
    let worked = work(&asking, Scope::Figure)?;
    Ok(located(asking, worked, at_rest))
}

/// Finds all centres of a mechanism in a pose of its motion.
///
/// # Errors
/// The faults of [`work_placed`].
pub fn placed(
    scene: &Scene,
    mechanism: &Mechanism,
    at: &Configuration,
) -> Result<Warned<Centres>, Faults> {
    let (asking, at_rest) = asking_all(scene);
    let demand = Demand::of(&asking, mechanism).with_all_positions();
    let worked = work_placed(&asking, mechanism.clone(), demand, at.clone())?;
    Ok(located(asking, worked, at_rest))
}

/// Returns the centres of a scene that asks for all velocities.
fn located(asking: Scene, worked: Warned<Worked>, at_rest: bool) -> Warned<Centres> {
    let Warned { value: worked, mut notes } = worked;
    // The reason for which the pose leaves a value undefined is reported once, as a remark; these
    // values are not questions of the scene.
    notes.iter_mut().for_each(|d| d.severity = d.severity.min(Severity::Warning));
    let closure = rounds::closure(&asking, asking.drivers.len());
    let velocities = Velocities::of(&asking, &worked);
    let list = locate::locate(&asking, &worked, &closure, &velocities);
    notes.extend(remarks(&asking, &closure, &list));
    let worst_triple = locate::worst_triple(&velocities, &closure, &list);
    let uses = uses::uses(&asking, &worked, &closure, &list);
    Warned {
        value: Centres {
            closure,
            list,
            uses,
            scene: asking,
            worked,
            worst_triple,
            at_rest,
            by_hand: None,
        },
        notes,
    }
}

/// Returns the order of finding of a scene, without any computation of numbers.
///
/// # Errors
/// The faults of [`Mechanism::new`].
pub fn closure(scene: &Scene) -> Result<CentreClosure, Faults> {
    Mechanism::new(scene)?;
    Ok(rounds::closure(scene, scene.drivers.len()))
}

/// Returns the question for ω of a link, relative to the ground or another link.
pub fn omega(of: LinkId, against: Option<LinkId>) -> Asked {
    quantity::Turning { rate: Rate::Velocity, of, against }.into()
}

/// Returns the question for the velocity of a point.
pub fn velocity(point: PointId) -> Asked {
    PointMotion { rate: Rate::Velocity, of: OnLink { point, link: None } }.into()
}

/// Returns the scene with moving drivers, and true if all drivers are at rest in the file, so that
/// each gets a unit rate. The place of a centre and the curvature of a path do not depend on the
/// speed of a single driver, but velocities that are all zero do not determine them.
pub fn moving_at_all(scene: &Scene) -> (Scene, bool) {
    let mut asking = scene.clone();
    let at_rest = scene.drivers.iter().all(|d| d.rate.value == 0.0);
    if at_rest {
        for driver in &mut asking.drivers {
            driver.rate.value = 1.0;
            driver.rate.radius = 0.0;
            driver.rate.text = match driver.kind {
                hodograph_scene::DriverKind::Turn { .. } => "1 rad/s".into(),
                hodograph_scene::DriverKind::Slide { .. }
                | hodograph_scene::DriverKind::Cylinder { .. } => "1 m/s".into(),
            };
        }
    }
    (asking, at_rest)
}

/// Returns the scene with questions for the velocities of all links and points, and true if its
/// drivers are at rest.
fn asking_all(scene: &Scene) -> (Scene, bool) {
    let (mut asking, at_rest) = moving_at_all(scene);
    let moving = |l: &LinkId| *l != scene.ground;
    let turnings = (0..scene.links.len())
        .map(LinkId)
        .filter(moving)
        .map(|l| (omega(l, None), format!("omega_{}", scene.link_name(l))));
    let on_ground = |p: PointId| scene.links[scene.ground.0].points.contains(&p);
    let carried = |p: &PointId| {
        !on_ground(*p)
            && (scene.carriers(*p).next().is_some()
                || scene.guides.iter().any(|g| g.pin == Some(*p)))
    };
    let points = (0..scene.points.len()).map(PointId).filter(carried);
    let speeds = points.map(|p| (velocity(p), format!("v_{}", scene.point_name(p))));
    asking.find = turnings
        .chain(speeds)
        .map(|(what, text)| Find { what, text, span: Default::default() })
        .collect();
    (asking, at_rest)
}

/// Returns remarks on centres that the theorem does not find, and on those that have no certain
/// place in the pose.
fn remarks(scene: &Scene, closure: &CentreClosure, list: &[Centre]) -> Vec<Diagnostic> {
    let mut notes = Vec::new();
    let name = |c: &Centre| c.step.pair.name(scene);
    let taken: Vec<String> =
        list.iter().filter(|c| c.step.how == CentreMethod::Velocities).map(name).collect();
    if !taken.is_empty() {
        let (found, all, taken) = (closure.alone, closure.steps.len(), Both::names(&taken));
        notes.push(if closure.freedoms == 1 {
            Diagnostic::note(
                "centre-stalled",
                both!(
                    "the theorem of three centres alone finds {found} of {all} centres and then has no second line for any other; {} is taken from the velocities of the analysis, and the theorem goes on",
                    taken
                ),
            )
        } else {
            Diagnostic::note(
                "centre-given-drivers",
                both!(
                    "{found} of {all} centres hold whatever the {} drivers do; {}, taken from the velocities, and those found with it hold for the given rates of the drivers",
                    closure.freedoms,
                    taken
                ),
            )
        });
    }
    for (why, words) in [
        (Undetermined::LinesCoincide, both!("the lines drawn for it coincide in this pose")),
        (Undetermined::NoLines, both!("the centres that its lines need are missing in this pose")),
        (Undetermined::NoMotion, both!("the links have no relative motion in this pose")),
    ] {
        let by_velocities: Vec<String> =
            list.iter().filter(|c| c.why == Some(why) && c.place.is_some()).map(name).collect();
        let none: Vec<String> =
            list.iter().filter(|c| c.why == Some(why) && c.place.is_none()).map(name).collect();
        if !by_velocities.is_empty() {
            let message = both!(
                "{}: {}; the velocities of the analysis tell the place",
                Both::names(&by_velocities),
                words
            );
            notes.push(Diagnostic::note("centre-undetermined", message));
        }
        if !none.is_empty() {
            let message = both!("{} has no certain place: {}", Both::names(&none), words);
            let help = both!("choose a pose nearby");
            notes.push(Diagnostic::warning("centre-undetermined", message).help(help));
        }
    }
    notes
}
