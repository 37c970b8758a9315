//! A lesson: one HTML page that shows a mechanism beside its polygons, which are built step by
//! step, with a crank to drag.
//!
//! This module decides what the page holds. [`crate::sweep::follow`] follows the mechanism through
//! its driver's travel, [`frames`] solves each pose to one scale ([`zoom`]; [`split`] divides a
//! polygon of many vectors), [`scenery`] draws it, [`track`] finds what changes from frame to frame
//! and [`pack`] packs it, [`bank`] does the same for sentences ([`crate::render::math`] sets their
//! formulas), [`equations`] gives each step its equation, [`page`] puts the page together, and
//! [`reveal`] writes one pose as a fragment for slides.
//!
//! The other lessons share the page of [`player`]: those of methods ([`method`]), of designs
//! ([`design`]), of motions without a mechanism ([`motion`]) and of vector equations
//! ([`equation`]).

mod acts;
mod bank;
mod curve;
pub mod design;
pub mod equation;
mod equations;
mod frames;
mod marks;
mod method;
pub mod motion;
mod pack;
mod page;
mod player;
mod reveal;
mod scenery;
mod split;
mod steps;
mod track;
mod words;
mod zoom;

pub use pack::told;
pub use reveal::{reveal, reveal_in};

use crate::centres::CentreTask;
use crate::diag::{Diagnostic, Faults, Warned, both};
use crate::figure::stepped::ConstructionMethod;
use crate::notation::Notation;
use crate::paper::style::Style;
use crate::scene::{Lang, Scene, Swept};
use crate::worked::{Scope, Worked, work};

use crate::sweep::follow::PoseFollower;
use crate::sweep::follow::course::over_a_turn;
use frames::LessonInput;

/// Options of a lesson.
#[derive(Clone, Debug, PartialEq)]
pub struct LessonOptions {
    /// The language in which the page opens; it holds both.
    pub lang: Lang,
    /// Notation of vectors; it is the same in both languages.
    pub notation: Notation,
    /// Number of poses through a full turn, or through the travel of a slider; more are added where
    /// the motion curves strongly.
    pub positions: usize,
    /// The driver or the time that is moved.
    pub swept: Swept,
    /// The method whose construction is shown; `None` for the polygons of the questions, or for the
    /// centres if the scene asks for nothing else.
    pub method: Option<ConstructionMethod>,
    /// Weights, sizes and fonts of the drawings; the page sets the colours, with a light and a dark
    /// theme.
    pub style: Style,
}

impl LessonOptions {
    /// The default lesson in a language.
    pub fn of_language(lang: Lang) -> LessonOptions {
        LessonOptions {
            lang,
            notation: Notation::of_language(lang),
            positions: POSITIONS,
            swept: Swept::Driver(0),
            method: None,
            style: Style::default(),
        }
    }
}

/// Size of names in the drawings, relative to a sheet: they must be legible from the last row.
const LARGER: f64 = 1.6;

/// Default number of poses through a turn: every 5°.
pub const POSITIONS: usize = 72;

/// Largest number of links and points together: the labels are placed anew for every position,
/// which takes some seconds in all.
const MOST: usize = 120;

/// Writes the page; the warnings are remarks for the reader.
///
/// # Errors
/// The errors of the scene in its own pose.
///
/// ```
/// use hodograph::{lesson, scene};
/// let text = scene::templates::get("slider-crank").unwrap();
/// let scene = scene::read(text)?.value;
/// let page = lesson::lesson(&scene, &lesson::LessonOptions::of_language(scene::Lang::En))?.value;
/// assert!(page.starts_with("<!DOCTYPE html>") && page.len() < 300_000);
/// # Ok::<(), hodograph::diag::Faults>(())
/// ```
pub fn lesson(scene: &Scene, options: &LessonOptions) -> Result<Warned<String>, Faults> {
    // Pairs that replace cams at the instant do not take part in the motion.
    let scene = &over_a_turn(scene);
    let Warned { value: worked, mut notes } = work(scene, Scope::Figure)?;
    let made = of_worked(scene, &worked, options)?;
    notes.extend(made.notes);
    Ok(Warned { value: made.value, notes })
}

/// Writes the page of a scene that is solved for [`Scope::Figure`] in its own pose, without the
/// notes of that.
///
/// # Errors
/// A driver that the scene does not have; a mechanism too large for all its positions; those of the
/// drawings.
pub fn of_worked(
    scene: &Scene,
    worked: &Worked,
    options: &LessonOptions,
) -> Result<Warned<String>, Faults> {
    let mut notes = Vec::new();
    let size = scene.links.len() + scene.links.iter().map(|l| l.points.len()).sum::<usize>();
    if size > MOST {
        let message = both!(
            "the links and their points are {size} together; a page that draws every position of them is made up to {MOST}"
        );
        let help =
            both!("take a part of the mechanism, or `hodograph draw --steps` for one position");
        return Err(Diagnostic::error("too-many", message).help(help).into());
    }
    if let Swept::Driver(driver) = options.swept
        && driver >= scene.drivers.len()
    {
        return Err(Diagnostic::error(
            "driver",
            both!("there is no driver {}: the scene has {}", driver + 1, scene.drivers.len()),
        )
        .into());
    }
    if let Swept::Driver(driver) = options.swept
        && scene.is_led(driver)
    {
        let (name, _) = scene.driver_name(driver);
        let message = both!("`{name}` follows its cam: it does not move by itself");
        return Err(Diagnostic::error("no-driver", message).help(both!("let the cam turn")).into());
    }
    let follower = PoseFollower::new(
        scene,
        &worked.mechanism,
        &worked.demand,
        &worked.configuration,
        options.swept,
    );
    let sweep = follower.sweep(options.positions.clamp(8, 360));
    follower.proved(sweep.poses.iter().map(|p| &p.configuration))?;
    notes.extend(follower.shortened());
    let asked = CentreTask::of(scene).filter(|t| t.alone).map(|_| ConstructionMethod::Centres);
    if let Some(method) = options.method.or(asked) {
        let page = method::lesson(scene, (worked, method), options, (&follower, &sweep))?;
        return Ok(Warned { value: page, notes });
    }
    let maker = LessonInput {
        scene,
        mechanism: &worked.mechanism,
        demand: &worked.demand,
        follower: &follower,
        style: &options.style,
        notation: &options.notation,
    };
    let frames = maker.frames(&sweep)?;
    if frames.list.len() == 1 {
        let d = Diagnostic::warning(
            "lesson-still",
            both!(
                "no pose beside this one can be drawn: the lesson shows it alone, and nothing in it moves"
            ),
        );
        notes.push(d.help(both!("give another pose, or move another driver with --driver")));
    }
    let turns = follower.returns();
    if turns != 1 && options.swept.turns(scene) && sweep.limits == [None, None] {
        notes.push(Diagnostic::note(
            "lesson-turns",
            match (sweep.full, turns) {
                (true, _) => both!(
                    "the lesson shows {turns} turns of the driver: then all wheels stand as before"
                ),
                (false, 0) => {
                    both!("the lesson shows one turn of the driver: the wheels never stand as before")
                }
                (false, _) => both!(
                    "the lesson shows one turn of the driver: the wheels stand as before after {turns}"
                ),
            },
        ));
    }
    if scene.own_drivers() > 1 && options.swept != Swept::Time {
        notes.push(
            Diagnostic::note(
                "lesson-driver",
                both!(
                    "the scene has several drivers: the lesson moves one of them, the others hold their positions"
                ),
            )
            .help(both!("with --over t all of them move, each at its rate")),
        );
    }
    Ok(Warned { value: page::page(scene, options, (&worked.mechanism, &sweep), &frames)?, notes })
}
