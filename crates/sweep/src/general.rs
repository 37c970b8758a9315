//! Single positions by the general solvers, where a program has no value, and the messages about
//! rows and limits.

use super::PlacedScene;
use super::follow::whole::DrivenMechanism;
use super::limit::Event;
use super::station::Stations;
use hodograph_analytic::{self as analytic, Solution};
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::digits::significant;
use hodograph_mechanism::mechanism::Mechanism;
use hodograph_mechanism::position::{self, Configuration};
use hodograph_mechanism::stated::{self, Moment};
use hodograph_scene::with_driver_at;
use hodograph_scene::{Find, Kind, Lang, LinkId, Scene};
use std::collections::BTreeMap;
use std::ops::Range;

/// Solves single rows of a sweep by the general solvers.
pub(super) struct General<'a> {
    placed: &'a PlacedScene<'a>,
    driver: usize,
}

impl<'a> General<'a> {
    pub fn new(placed: &'a PlacedScene<'a>, driver: usize) -> General<'a> {
        General { placed, driver }
    }

    /// The scene.
    pub fn scene(&self) -> &'a Scene {
        self.placed.scene
    }

    /// The scene placed at the instant.
    pub fn placed(&self) -> &'a PlacedScene<'a> {
        self.placed
    }

    /// The driver that moves.
    pub fn driver(&self) -> usize {
        self.driver
    }

    /// The scene with its driver at a station.
    pub fn scene_at(&self, stations: &Stations, row: usize) -> Scene {
        with_driver_at(
            self.placed.scene,
            self.driver,
            stations.place(row, self.placed.scene, self.driver),
        )
    }

    /// True if closed forms solve every station, with the closures of the instant.
    pub fn is_closed_everywhere(&self) -> bool {
        self.placed.scene.is_told_everywhere()
            && !DrivenMechanism::new(self.placed, self.driver).counts_turns()
    }

    /// True if a cam's contact is valid at the instant only, with no driver to replace it; then
    /// each position is that of the scene read again with the driver there.
    pub fn is_read_again(&self) -> bool {
        let scene = self.placed.scene;
        scene.source.is_some() && scene.is_told_everywhere() && scene.kept_cams().next().is_some()
    }

    /// Solves one row by the position solver, with the closures of the instant, and the loop
    /// equations; at a change point returns one row for each way on.
    pub fn solve(&self, stations: &Stations, row: usize) -> Result<Vec<Vec<f64>>, Faults> {
        let p = self.placed;
        let scene = self.scene_at(stations, row);
        unfollowed(&scene)?;
        if self.is_read_again() {
            let there = Afresh::of(&scene, &|_| None)?;
            return Ok(vec![
                scene.find.iter().map(|f| there.answer(f)).collect::<Result<Vec<_>, _>>()?.concat(),
            ]);
        }
        // Closed forms do not give the turn of wheels, nor the pose near one that is given by
        // coordinates.
        if self.is_closed_everywhere() {
            let told = self.answers(
                &scene,
                &position::recompute::<f64>(&scene, p.mechanism, &p.demand, &p.at)?,
            );
            // A group without closed forms is only refined from the instant, which leads to no
            // position far from it.
            if !told.as_ref().is_err_and(stated::is_unproven) {
                return told;
            }
        }
        self.answers(&scene, &DrivenMechanism::new(p, self.driver).standing(stations.values[row])?)
    }

    /// Solves one row with the configuration `at`, or else by the position solver; one row for each
    /// way on.
    pub fn ways(
        &self,
        stations: &Stations,
        row: usize,
        at: Option<&Configuration>,
    ) -> Result<Vec<Vec<f64>>, Faults> {
        at.map_or_else(
            || self.solve(stations, row),
            |at| self.answers(&self.scene_at(stations, row), at),
        )
    }

    /// Returns the row of a pose, one for each way on.
    ///
    /// # Errors
    /// A position that is not the scene's.
    pub fn answers(&self, scene: &Scene, at: &Configuration) -> Result<Vec<Vec<f64>>, Faults> {
        let p = self.placed;
        stated::proved(scene, p.mechanism, at, Moment::Later(&p.at))?;
        let solution = analytic::solve(scene, p.mechanism, at, &p.demand)?;
        let others = solution.singular.iter().filter_map(|s| s.other.as_deref());
        std::iter::once(&solution).chain(others).map(|s| self.row(scene, at, s)).collect()
    }

    fn row(
        &self,
        scene: &Scene,
        at: &Configuration,
        solution: &Solution,
    ) -> Result<Vec<f64>, Faults> {
        let mut row = Vec::new();
        let mut afresh = None;
        // A driver replaces the contact of a cam; the scene knows only the piece of the instant.
        let led = scene.source.is_some() && (0..scene.drivers.len()).any(|d| scene.is_led(d));
        for f in &scene.find {
            let known = if led && f.what.infinite(scene).is_some() {
                None
            } else {
                numbers(scene, at, solution, f)
            };
            match known {
                Some(numbers) => row.extend(numbers?),
                // Answers that depend on that contact.
                None if led => {
                    let there = match afresh.take() {
                        Some(there) => there,
                        None => {
                            Afresh::of(scene, &|name| at.named(scene, name).map(|p| [p.x, p.y]))?
                        }
                    };
                    row.extend(there.answer(f)?);
                    afresh = Some(there);
                }
                None => return Err(not_defined(scene, f).into()),
            }
        }
        Ok(row)
    }
}

fn not_defined(scene: &Scene, f: &Find) -> Diagnostic {
    Diagnostic::error("not-defined", both!("{}: {}", f.text, f.what.no_value(scene))).at(f.span)
}

/// The columns of an answer, infinite where it is; `None` where it has no value.
fn numbers(
    scene: &Scene,
    at: &Configuration,
    solution: &Solution,
    find: &Find,
) -> Option<Result<Vec<f64>, Faults>> {
    match find.what.infinite(scene) {
        Some(_) => Some(Ok(vec![f64::INFINITY])),
        None => solution.answer(scene, at, &find.what).map(|value| finite(value.columns())),
    }
}

fn finite(row: Vec<f64>) -> Result<Vec<f64>, Faults> {
    match row.iter().all(|v| v.is_finite()) {
        true => Ok(row),
        false => Err(Diagnostic::error("overflow", both!("a number is out of range")).into()),
    }
}

/// A scene read again for one position.
struct Afresh {
    scene: Scene,
    at: Configuration,
    solution: Solution,
}

impl Afresh {
    /// Reads the scene, with its drivers at the position, again.
    fn of(scene: &Scene, place: &dyn Fn(&str) -> Option<[f64; 2]>) -> Result<Afresh, Faults> {
        let scene = scene.read_again(place)?;
        let mechanism = Mechanism::new(&scene)?.value;
        let PlacedScene { at, demand, .. } = PlacedScene::new(&scene, &mechanism)?;
        stated::proved(&scene, &mechanism, &at, Moment::Instant)?;
        let solution = analytic::solve(&scene, &mechanism, &at, &demand)?;
        Ok(Afresh { at, solution, scene })
    }

    fn answer(&self, find: &Find) -> Result<Vec<f64>, Faults> {
        let own = self.scene.find.iter().find(|f| f.text == find.text).unwrap_or(find);
        numbers(&self.scene, &self.at, &self.solution, own)
            .unwrap_or_else(|| Err(not_defined(&self.scene, own).into()))
    }
}

/// Refuses a scene whose follower does not reach the position that its cam demands.
fn unfollowed(scene: &Scene) -> Result<(), Faults> {
    let Some(cam) = scene.lost_follower() else { return Ok(()) };
    let (cam, follower) = (scene.link_name(cam.cam), scene.link_name(cam.follower));
    let message = both!("the follower `{follower}` cannot be moved so far on cam `{cam}`");
    Err(Diagnostic::error("limit", message).into())
}

/// A driver's value for readers: `phi_1 = 92.5°`.
pub(super) fn driver_words(scene: &Scene, driver: usize, value: f64) -> String {
    let (name, kind) = scene.driver_name(driver);
    let turning = kind == Kind::Angle;
    let words = if turning {
        scene.book.text(kind, &significant(scene.book.value(kind, value), 6))
    } else {
        scene.length_words(value)
    };
    format!("{name} = {words}")
}

/// The links of an event for a sentence: `links 2, 3`.
pub(super) fn links_words(scene: &Scene, links: &[LinkId]) -> Both {
    let names: Vec<_> = links.iter().map(|l| scene.link_name(*l)).collect();
    match names[..] {
        [one] => both!("link {one}"),
        _ => both!("links {}", Both::names(&names)),
    }
}

/// The note of a change point.
pub(super) fn change_note(scene: &Scene, driver: usize, change: &Event) -> Diagnostic {
    let (links, at) =
        (links_words(scene, &change.links), driver_words(scene, driver, change.value));
    Diagnostic::note(
        "change-point",
        both!(
            "at {at} {} lie in line (a change point); the motion is carried on smoothly to the other side",
            links
        ),
    )
}

/// The note of change points that recur as far as a value.
pub(super) fn again_note(scene: &Scene, driver: usize, until: f64) -> Diagnostic {
    let until = driver_words(scene, driver, until);
    Diagnostic::note(
        "change-point",
        both!("the same change points come again, on every further turn, as far as {until}"),
    )
}

/// The note of a limit of the driver.
pub(super) fn limit_note(scene: &Scene, driver: usize, limit: &Event) -> Diagnostic {
    let at = driver_words(scene, driver, limit.value);
    let what = limit.toggle.as_ref().map_or_else(
        || {
            let pin = limit.pin.map_or(Both::default(), |p| both!(" at {}", scene.point_name(p)));
            let links = links_words(scene, &limit.links);
            match limit.links.len() {
                // A slot at the end of its reach.
                1 => both!("{} reaches no farther{}", links, pin),
                _ => both!("{} come into line{}", links, pin),
            }
        },
        |t| Both { en: t.words(scene, Lang::En), zh: t.words(scene, Lang::Zh) },
    );
    Diagnostic::note("limit", both!("the driver goes no farther than {at}: there {}", what))
}

/// A run of missing rows, and the reason why the first of them is missing.
pub(super) struct RowGap {
    pub rows: Range<usize>,
    pub why: Both,
}

/// The runs of missing rows; the number of the first row of all is `first`.
pub(super) fn runs(missing: &BTreeMap<usize, Faults>, first: usize) -> Vec<RowGap> {
    let mut gaps: Vec<RowGap> = Vec::new();
    for (i, why) in missing {
        let row = first + i;
        match gaps.last_mut().filter(|g| g.rows.end == row) {
            Some(gap) => gap.rows.end = row + 1,
            None => gaps.push(RowGap {
                rows: row..row + 1,
                why: why.list.first().map_or(Both::default(), |d| d.message.clone()),
            }),
        }
    }
    gaps
}

/// The range of a run of rows; `words` names a row by its swept value.
fn range_words(words: &dyn Fn(usize) -> String, rows: &Range<usize>) -> Both {
    match rows.len() {
        1 => both!("at {}", words(rows.start)),
        _ => both!("from {} to {}", words(rows.start), words(rows.end - 1)),
    }
}

/// One note for each run of missing rows.
pub(super) fn gap_notes(words: &dyn Fn(usize) -> String, gaps: &[RowGap]) -> Vec<Diagnostic> {
    let note = |RowGap { rows, why }: &RowGap| {
        let count = match rows.len() {
            1 => both!("1 row is"),
            n => both!("{n} rows are"),
        };
        Diagnostic::warning(
            "no-position",
            both!("{} missing {}: {}", count, range_words(words, rows), why),
        )
    };
    gaps.iter().map(note).collect()
}

/// The note of a run of rows in which an answer is infinite.
pub(super) fn infinite_note(
    words: &dyn Fn(usize) -> String,
    name: &str,
    rows: &Range<usize>,
) -> Diagnostic {
    Diagnostic::note("infinite", both!("{name} is infinite {}", range_words(words, rows)))
}
