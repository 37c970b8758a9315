//! Figures that are drawn again while their drivers are dragged.

use super::scene::SceneSolution;
use super::{Look, Options, Pictures, Problem, Solved, whole_motion};
use crate::construct::scale::Boxes;
use crate::diag::{Diagnostic, Faults, Warned, both};
use crate::figure::list::{FigureEntry, Pages};
use crate::figure::series::size;
use crate::mechanism::{Demand, Mechanism};
use crate::paper::memory::LabelMemory;
use crate::position::{self, Configuration};
use crate::render::svg::{Delta, LiveFigure};
use crate::scene::{ByKind, DiagramKind, Scene, Swept};
use crate::sweep::follow::PoseFollower;
use crate::sweep::station::position_now;
use crate::worked::{Scope, Worked, work, work_pose};

/// Parts of its box that a polygon fills at least and at most before it gets another scale.
const LEAST_FILLED: f64 = 0.25;
const MOST_FILLED: f64 = 1.0 + 1e-9;
/// Poses of a turn for which [`Live::reserve`] draws.
const RESERVED_POSES: usize = 24;

/// Figures of a mechanism, prepared to be drawn again for other positions of its drivers.
///
/// The arrangement stays; so does the scale of a polygon as long as it fills its box well. Every
/// label keeps its place beside its object, every element its id. Tolerances of drawing by hand are left out, and lines are not broken below labels;
/// everything else is that of [`Solved::figures`].
///
/// ```
/// use hodograph::problem::{Live, Look, Options, Pictures, read, templates};
/// let problem = read(templates::text("crank-rocker", &[])?)?.value;
/// let mut live = Live::new(&problem, &Options::default(), &Pictures::default(), &Look::default())?;
/// let changes = live.redraw(&[live.values()[0] + 0.1])?;
/// assert!(!changes[0].delta.changed.is_empty() && live.svg("").unwrap().starts_with("<svg"));
/// # Ok::<(), hodograph::diag::Faults>(())
/// ```
pub struct Live {
    /// Remarks on the first figures.
    pub notes: Vec<Diagnostic>,
    scene: Scene,
    /// The scales that the file fixes.
    own_scales: ByKind,
    mechanism: Mechanism,
    demand: Demand,
    base: Configuration,
    /// Positions of the scene's own drivers in its pose (rad or m).
    start: Vec<f64>,
    /// Positions in the figures.
    values: Vec<f64>,
    /// The places of the figures.
    at: Configuration,
    solved: Solved,
    wanted: LivePictures,
    pages: Vec<(String, LiveFigure)>,
}

/// The changes of a page.
#[derive(Clone, Debug, PartialEq)]
pub struct PageDelta {
    /// The name of the page, as [`Solved::figures`] gives it.
    pub name: String,
    /// True for a page that was not there before; all its elements are added.
    pub begins: bool,
    /// The changes.
    pub delta: Delta,
}

/// The wanted figures.
struct LivePictures {
    figures: Vec<&'static FigureEntry>,
    pictures: Pictures<'static>,
    look: Look,
    memory: LabelMemory,
}

impl LivePictures {
    /// Draws all pages.
    fn draw(&self, solved: &Solved) -> Result<Warned<Pages>, Faults> {
        self.memory.restart();
        let pictures = Pictures { figures: &self.figures, ..self.pictures.clone() };
        solved.figures(&pictures, &self.look)
    }
}

/// Leaves the scales of the polygons open that the file does not fix.
fn free_scales(scene: &mut Scene, own: &ByKind) {
    for on in DiagramKind::VECTORS {
        scene.paper.scales.set(on.kind(), own.get(on.kind()));
    }
}

impl Live {
    /// Solves a scene for its whole motion and draws the figures. Of the options, only the pencil
    /// error is used.
    ///
    /// # Errors
    /// `not-a-scene` for a file of another kind; those of [`super::solve()`] and of the drawings.
    pub fn new(
        problem: &Problem,
        options: &Options,
        pictures: &Pictures,
        look: &Look,
    ) -> Result<Live, Faults> {
        let Warned { value: mut scene, mut notes } = whole_motion(problem.clone().into_scene()?);
        scene.paper.pencil_mm = options.pencil_mm.or(scene.paper.pencil_mm);
        let worked = work(&scene, Scope::Figure)?;
        notes.extend(worked.notes);
        let worked = worked.value;
        let own_scales = scene.paper.scales.clone();
        worked.hold_scales(&mut scene);
        let memory = LabelMemory::default();
        let mut look = look.clone();
        look.style.memory = Some(memory.clone());
        let wanted = LivePictures {
            figures: pictures.figures.to_vec(),
            pictures: Pictures { figures: &[], ..pictures.clone() },
            look,
            memory,
        };
        let at = worked.configuration.clone();
        let start: Vec<f64> = own_drivers(&scene).map(|d| position_now(&scene, &at, d)).collect();
        let (read, worked) = (work_pose(&scene, (&worked.mechanism, &worked.demand), &at)?, worked);
        let mut live = Live {
            notes,
            scene,
            own_scales,
            mechanism: worked.mechanism,
            demand: worked.demand,
            base: at.clone(),
            values: start.clone(),
            start,
            at,
            solved: solution(read),
            wanted,
            pages: Vec::new(),
        };
        let drawn = live.wanted.draw(&live.solved)?;
        live.notes.extend(drawn.notes);
        for PageDelta { delta, .. } in live.show(drawn.value)? {
            live.notes.extend(delta.notes);
        }
        Ok(live)
    }

    /// Positions of the drivers in the figures (rad or m), in the order of the file without those
    /// that follow a cam.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The solution in the pose of the figures.
    pub fn solved(&self) -> &Solved {
        &self.solved
    }

    /// Draws the figures for other positions of the drivers, in the assembly nearest to that of
    /// the figures, and returns the changes of all pages. The documents of pages that are not
    /// named end.
    ///
    /// # Errors
    /// `driver` if the number of positions is not that of [`Live::values`]; the reason why the
    /// mechanism cannot be assembled; those of the drawings. The figures then remain.
    pub fn redraw(&mut self, values: &[f64]) -> Result<Vec<PageDelta>, Faults> {
        if values.len() != self.start.len() {
            let message = both!(
                "{} drivers move, and {} positions are given",
                self.start.len(),
                values.len()
            );
            return Err(Diagnostic::error("driver", message).into());
        }
        let travels = self.start.iter().zip(values).map(|(start, value)| value - start);
        let moves: Vec<(Swept, f64)> =
            own_drivers(&self.scene).map(Swept::Driver).zip(travels).collect();
        let changes = self.redraw_at(&moves)?;
        self.values = values.to_vec();
        Ok(changes)
    }

    /// Draws the figures after a travel (rad, m or s) of one driver, or of time, from the scene's
    /// own pose, as [`Live::redraw`] does.
    ///
    /// # Errors
    /// As [`Live::redraw`].
    pub fn redraw_after(&mut self, swept: Swept, travel: f64) -> Result<Vec<PageDelta>, Faults> {
        let changes = self.redraw_at(&[(swept, travel)])?;
        let now = |(d, start): (usize, &f64)| match swept {
            Swept::Driver(moved) if moved == d => start + travel,
            Swept::Driver(_) => *start,
            Swept::Time => position_now(&self.scene, &self.at, d),
        };
        self.values = own_drivers(&self.scene).zip(&self.start).map(now).collect();
        Ok(changes)
    }

    /// Reserves space for the figures over the whole motion of a driver, or over time, so that nothing
    /// fixed shifts when they are drawn again; returns the changes of all pages.
    ///
    /// # Errors
    /// Those of the drawings at the positions of the figures.
    pub fn reserve(&mut self, swept: Swept) -> Result<Vec<PageDelta>, Faults> {
        let Live { scene, mechanism, demand, base, wanted, .. } = self;
        let follower = PoseFollower::new(scene, mechanism, demand, base, swept);
        for pose in follower.sweep(RESERVED_POSES).poses {
            let mut there = follower.scene_at(scene, pose.travel);
            free_scales(&mut there, &self.own_scales);
            if let Ok(read) = work_pose(&there, (mechanism, demand), &pose.configuration) {
                // Only the memory of the drawing is wanted; a pose without one needs no space.
                let _ = wanted.draw(&solution(read));
            }
        }
        let drawn = wanted.draw(&self.solved)?;
        self.show(drawn.value)
    }

    fn redraw_at(&mut self, moves: &[(Swept, f64)]) -> Result<Vec<PageDelta>, Faults> {
        let (scene, at) = self.placed(moves)?;
        let solved = solution(self.solved_to_scale(scene, &at)?);
        let drawn = self.wanted.draw(&solved)?;
        let mut changes = self.show(drawn.value)?;
        if let Some(first) = changes.first_mut() {
            first.delta.notes.extend(drawn.notes);
        }
        (self.at, self.solved) = (at, solved);
        Ok(changes)
    }

    /// Solves a pose to the scales of the figures, or to new ones for polygons that become too large
    /// or too small for their boxes.
    fn solved_to_scale(
        &mut self,
        mut scene: Scene,
        at: &Configuration,
    ) -> Result<(Scene, Worked), Faults> {
        let of = (&self.mechanism, &self.demand);
        let read = work_pose(&scene, of, at)?;
        let boxes = Boxes::of(&scene.paper, &read.1.plan);
        let fills = |on| {
            let part = size(&read.1, on, &boxes)? / read.1.scale(on)?;
            (part > 0.0).then_some(part)
        };
        let is_free = |on: &DiagramKind| self.own_scales.get(on.kind()).is_none();
        let ill = |on: &DiagramKind| {
            fills(*on).is_some_and(|part| !(LEAST_FILLED..=MOST_FILLED).contains(&part))
        };
        let again: Vec<DiagramKind> =
            DiagramKind::VECTORS.into_iter().filter(is_free).filter(ill).collect();
        if again.is_empty() {
            return Ok(read);
        }
        again.iter().for_each(|on| scene.paper.scales.set(on.kind(), None));
        let read = work_pose(&scene, of, at)?;
        for on in again {
            self.scene.paper.scales.set(on.kind(), read.1.scale(on));
        }
        Ok(read)
    }

    /// Returns the document of a page.
    pub fn svg(&self, page: &str) -> Option<String> {
        self.pages.iter().find(|(name, _)| name == page).map(|(_, figure)| figure.svg())
    }

    /// Replaces the documents of all pages.
    fn show(&mut self, drawn: Pages) -> Result<Vec<PageDelta>, Faults> {
        let mut earlier = std::mem::take(&mut self.pages);
        let mut prepared = Vec::with_capacity(drawn.len());
        let mut begun = Vec::new();
        for (name, figure) in drawn {
            let old = earlier.iter_mut().find(|(page, _)| *page == name);
            let begins = old.is_none();
            let mut blank = LiveFigure::blank(&figure);
            let on = old.map_or(&mut blank, |(_, figure)| figure);
            match on.prepare(figure) {
                Ok(next) => prepared.push((name.clone(), begins, next)),
                Err(faults) => {
                    self.pages = earlier;
                    return Err(faults);
                }
            }
            if begins {
                begun.push((name, blank));
            }
        }
        earlier.append(&mut begun);
        let mut changes = Vec::with_capacity(prepared.len());
        for (name, begins, next) in prepared {
            let Some(k) = earlier.iter().position(|(page, _)| *page == name) else { continue };
            let (_, mut figure) = earlier.swap_remove(k);
            let delta = figure.show(next);
            self.pages.push((name.clone(), figure));
            changes.push(PageDelta { name, begins, delta });
        }
        Ok(changes)
    }

    /// The scene and the places after some travels from its own pose.
    fn placed(&self, moves: &[(Swept, f64)]) -> Result<(Scene, Configuration), Faults> {
        let (mut scene, mut at) = (self.scene.clone(), Some(self.base.clone()));
        let moving: Vec<&(Swept, f64)> = moves.iter().filter(|(_, by)| *by != 0.0).collect();
        for (k, (swept, travel)) in moving.iter().enumerate() {
            let from = at.as_ref().unwrap_or(&self.base);
            let (mechanism, demand) = (&self.mechanism, &self.demand);
            let follower = PoseFollower::new(&scene, mechanism, demand, from, *swept);
            let there = follower.scene_at(&scene, *travel);
            let guess = if k + 1 == moving.len() { &self.at } else { from };
            let found = at.is_some().then(|| follower.at(guess, *travel)).flatten();
            (scene, at) = (there, found);
        }
        match at {
            Some(at) => Ok((scene, at)),
            // Assembled anew, for the reason if that fails too.
            None => {
                let at = position::configure(&scene, &self.mechanism, &self.demand)?.value;
                Ok((scene, at))
            }
        }
    }
}

fn solution((scene, worked): (Scene, Worked)) -> Solved {
    Solved { notes: Vec::new(), answered: Box::new(SceneSolution { scene, worked }) }
}

/// The drivers that move by themselves.
fn own_drivers(scene: &Scene) -> impl Iterator<Item = usize> {
    (0..scene.drivers.len()).filter(|d| !scene.is_led(*d))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::list;
    use crate::problem::{read, templates};

    /// The elements of a document, and what is before them.
    fn parted(svg: &str) -> (String, Vec<String>) {
        let body = svg.split_once("</defs>\n").unwrap();
        let (mut list, mut depth) = (vec![String::new()], 0_i32);
        for line in body.1.trim_end().trim_end_matches("</svg>").lines() {
            let opened = line.matches('<').count() as i32;
            let closed = (line.matches("</").count() + line.matches("/>").count()) as i32;
            depth += opened - line.matches("</").count() as i32 - closed;
            let last = list.last_mut().unwrap();
            last.push_str(line);
            last.push('\n');
            if depth == 0 {
                list.push(String::new());
            }
        }
        list.pop();
        (format!("{}</defs>\n", body.0), list)
    }

    /// A document with the changes made, as a page makes them.
    fn applied(svg: &str, delta: &Delta) -> Vec<String> {
        let mut list = parted(svg).1;
        delta.removed.iter().for_each(|k| {
            list.remove(*k);
        });
        delta.added.iter().for_each(|(k, text)| list.insert(*k, format!("{text}\n")));
        delta.changed.iter().for_each(|(k, text)| list[*k] = format!("{text}\n"));
        for (k, place) in &delta.moved {
            let (head, tail) = list[*k].split_once("transform=\"").unwrap();
            let tail = tail.split_once('"').unwrap().1;
            list[*k] = format!("{head}transform=\"{place}\"{tail}");
        }
        list
    }

    /// Ids and classes of all elements, without those of leader lines.
    fn identities(svg: &str) -> Vec<String> {
        let word = |text: &str, name: &str| {
            text.split_once(name).map_or("", |t| t.1.split('"').next().unwrap_or("")).to_owned()
        };
        let of = |e: &String| format!("{} {}", word(e, " id=\""), word(e, " class=\""));
        let mut all: Vec<String> = parted(svg).1.iter().map(of).collect();
        all.retain(|name| !name.contains("leader") && !name.contains("label-"));
        all.sort();
        all
    }

    fn live(problem: &Problem) -> Result<Live, Faults> {
        Live::new(problem, &Options::default(), &Pictures::default(), &Look::default())
    }

    /// For every template: the changes make the next document of the earlier one, and the figure is
    /// that of a fresh preparation in the same pose but for the places of labels.
    #[test]
    fn changes_lead_to_the_document_of_the_pose() {
        let mut moved = 0;
        for templates::Template { name, .. } in templates::all() {
            let problem = read(templates::text(name, &[]).unwrap()).unwrap().value;
            let Ok(mut figure) = live(&problem) else { continue };
            let start = figure.values().to_vec();
            for step in [0.01, 0.02] {
                let earlier = figure.svg("").unwrap();
                let values: Vec<f64> = start.iter().map(|v| v + step).collect();
                let Ok(changes) = figure.redraw(&values) else {
                    assert_eq!(
                        figure.svg("").unwrap(),
                        earlier,
                        "{name}: a refused pose leaves the figure"
                    );
                    continue;
                };
                let (next, delta) = (figure.svg("").unwrap(), &changes[0].delta);
                assert_eq!(applied(&earlier, delta), parted(&next).1, "{name}");
                assert_eq!(delta.letters.is_some(), {
                    let letters =
                        |svg: &str| parted(svg).0.split_once("<defs>").unwrap().1.to_owned();
                    letters(&earlier) != letters(&next)
                });
                moved += 1;
            }
            let mut fresh = live(&problem).unwrap();
            if figure.values() != start {
                fresh.redraw(figure.values()).unwrap();
                assert_eq!(
                    identities(&fresh.svg("").unwrap()),
                    identities(&figure.svg("").unwrap()),
                    "{name}"
                );
            }
        }
        assert!(moved > 30, "{moved}");
    }

    /// Once space is reserved for the whole motion, the paper keeps its size, and pivots, poles and
    /// captions their places.
    #[test]
    fn with_reserved_space_nothing_fixed_moves() {
        let figures = ["mechanism", "velocity", "acceleration"].map(|n| list::named(n).unwrap());
        let fixed = |svg: &str| -> Vec<String> {
            let is_fixed = |e: &&String| {
                ["pivot-", "mark-pole", "\"caption-"].iter().any(|name| e.contains(name))
                    && !e.contains("label-")
            };
            parted(svg).1.iter().filter(is_fixed).cloned().collect()
        };
        let pictures = Pictures { figures: &figures, ..Pictures::default() };
        let names = ["shaper", "crank-rocker", "whitworth", "cam-offset-roller", "planetary-gear"];
        for name in names.into_iter().chain(["sheet of slider-crank"]) {
            let (pictures, name) = match name.strip_prefix("sheet of ") {
                Some(name) => (Pictures::default(), name),
                None => (pictures.clone(), name),
            };
            let problem = read(templates::text(name, &[]).unwrap()).unwrap().value;
            let mut live =
                Live::new(&problem, &Options::default(), &pictures, &Look::default()).unwrap();
            live.reserve(Swept::Driver(0)).unwrap();
            let pages: Vec<String> = live.pages.iter().map(|(page, _)| page.clone()).collect();
            let before: Vec<String> = pages.iter().map(|page| live.svg(page).unwrap()).collect();
            for k in 1..=12 {
                let travel = f64::from(k) * std::f64::consts::TAU / 12.0;
                let changes = live.redraw_after(Swept::Driver(0), travel).unwrap();
                assert!(
                    changes.iter().all(|c| !c.begins && c.delta.size_mm.is_none()),
                    "{name} {k}"
                );
                for (page, before) in pages.iter().zip(&before) {
                    assert_eq!(fixed(&live.svg(page).unwrap()), fixed(before), "{name} {page} {k}");
                }
            }
        }
    }

    /// A pose out of reach gives a diagnosis, and the figure remains.
    #[test]
    fn a_pose_out_of_reach_leaves_the_figure() {
        let text = templates::text("crank-rocker", &[("l_CD", "130 mm")]);
        let problem = read(text.unwrap_or_else(|f| panic!("{f}"))).unwrap().value;
        let mut figure = live(&problem).unwrap();
        let earlier = figure.svg("").unwrap();
        let start = figure.values()[0];
        let refused = (0..60).filter(|k| figure.redraw(&[start + f64::from(*k) * 0.1]).is_err());
        assert!(refused.count() > 0 && figure.redraw(&[]).is_err());
        figure.redraw(&[start]).unwrap();
        assert_eq!(identities(&figure.svg("").unwrap()), identities(&earlier));
    }
}
