//! A figure that is drawn again while its drivers are dragged.

use super::scene::SceneSolution;
use super::{Answered, Look, Options, Pictures, Problem, whole_motion};
use crate::diag::{Diagnostic, Faults, Warned, both};
use crate::figure::list::FigureEntry;
use crate::mechanism::{Demand, Mechanism};
use crate::paper::item::Figure;
use crate::paper::memory::LabelMemory;
use crate::position::{self, Configuration};
use crate::render::svg::{Delta, LiveFigure};
use crate::scene::Scene;
use crate::sweep::follow::PoseFollower;
use crate::sweep::station::position_now;
use crate::worked::{Scope, work, work_pose};

/// A figure of a mechanism, prepared to be drawn again for other positions of its drivers.
///
/// Every label keeps its place beside its object, every element its id. Tolerances of drawing by
/// hand are left out, and lines are not broken below labels; everything else is that of
/// [`Solved::figures`](super::Solved::figures).
///
/// ```
/// use hodograph::problem::{Live, Look, Options, Pictures, Problem, read, templates};
/// let problem = read(templates::text("crank-rocker", &[])?)?.value;
/// let mut live = Live::new(&problem, &Options::default(), &Pictures::default(), &Look::default())?;
/// let delta = live.redraw(&[live.values()[0] + 0.1])?;
/// assert!(!delta.changed.is_empty() && live.svg().starts_with("<svg"));
/// # Ok::<(), hodograph::diag::Faults>(())
/// ```
pub struct Live {
    /// Remarks on the first figure.
    pub notes: Vec<Diagnostic>,
    scene: Scene,
    mechanism: Mechanism,
    demand: Demand,
    base: Configuration,
    /// Positions of the scene's own drivers in its pose (rad or m).
    start: Vec<f64>,
    /// Positions in the figure.
    values: Vec<f64>,
    /// The places of the figure.
    at: Configuration,
    wanted: LivePictures,
    figure: LiveFigure,
}

/// The wanted figure.
struct LivePictures {
    figures: Vec<&'static FigureEntry>,
    pictures: Pictures<'static>,
    look: Look,
    memory: LabelMemory,
}

impl LivePictures {
    /// Draws the first page.
    fn draw(&self, scene: Scene, worked: crate::worked::Worked) -> Result<Warned<Figure>, Faults> {
        self.memory.restart();
        let pictures = Pictures { figures: &self.figures, ..self.pictures.clone() };
        let pages = SceneSolution { scene, worked }.figures(&pictures, &self.look)?;
        let first = pages.value.into_iter().next().map(|(_, figure)| figure);
        let none =
            || Diagnostic::error("no-figure", both!("there is nothing to draw", "没有可画的图"));
        Ok(Warned { value: first.ok_or_else(none)?, notes: pages.notes })
    }
}

impl Live {
    /// Solves a scene for its whole motion and draws the first page of the figures. Of the options,
    /// only the pencil error is used.
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
        let (mechanism, demand, base) =
            (worked.value.mechanism, worked.value.demand, worked.value.configuration);
        let memory = LabelMemory::default();
        let mut look = look.clone();
        look.style.memory = Some(memory.clone());
        let wanted = LivePictures {
            figures: pictures.figures.to_vec(),
            pictures: Pictures { figures: &[], ..pictures.clone() },
            look,
            memory,
        };
        let (read, worked) = work_pose(&scene, (&mechanism, &demand), &base)?;
        let drawn = wanted.draw(read, worked)?;
        let Warned { value: figure, notes: more } = LiveFigure::new(drawn.value)?;
        notes.extend(drawn.notes.into_iter().chain(more));
        let start: Vec<f64> = own_drivers(&scene).map(|d| position_now(&scene, &base, d)).collect();
        let (values, at) = (start.clone(), base.clone());
        Ok(Live { notes, scene, mechanism, demand, base, start, values, at, wanted, figure })
    }

    /// Positions of the drivers in the figure (rad or m), in the order of the file without those
    /// that follow a cam.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Draws the figure for other positions of the drivers, in the assembly nearest to that of the
    /// figure, and returns the changes of its document.
    ///
    /// # Errors
    /// `driver` if the number of positions is not that of [`Live::values`]; the reason why the
    /// mechanism cannot be assembled; those of the drawings. The figure then remains.
    pub fn redraw(&mut self, values: &[f64]) -> Result<Delta, Faults> {
        if values.len() != self.start.len() {
            let message = both!(
                "{} drivers move, and {} positions are given",
                "有 {} 个原动件，却给出 {} 个位置",
                self.start.len(),
                values.len()
            );
            return Err(Diagnostic::error("driver", message).into());
        }
        let (scene, at) = self.placed(values)?;
        let (read, worked) = work_pose(&scene, (&self.mechanism, &self.demand), &at)?;
        let drawn = self.wanted.draw(read, worked)?;
        let mut delta = self.figure.redraw(drawn.value)?;
        delta.notes.extend(drawn.notes);
        (self.values, self.at) = (values.to_vec(), at);
        Ok(delta)
    }

    /// Returns the document of the figure.
    pub fn svg(&self) -> String {
        self.figure.svg()
    }

    /// The scene and the places for some positions of the drivers.
    fn placed(&self, values: &[f64]) -> Result<(Scene, Configuration), Faults> {
        let (mut scene, mut at) = (self.scene.clone(), Some(self.base.clone()));
        let travels = self.start.iter().zip(values).map(|(start, value)| value - start);
        let mut moving: Vec<(usize, f64)> = own_drivers(&self.scene).zip(travels).collect();
        moving.retain(|(_, travel)| *travel != 0.0);
        for (k, (driver, travel)) in moving.iter().copied().enumerate() {
            let from = at.as_ref().unwrap_or(&self.base);
            let (mechanism, demand) = (&self.mechanism, &self.demand);
            let follower = PoseFollower::new(&scene, mechanism, demand, from, driver);
            let there = follower.scene_at(&scene, travel);
            let guess = if k + 1 == moving.len() { &self.at } else { from };
            let found = at.is_some().then(|| follower.at(guess, travel)).flatten();
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

/// The drivers that move by themselves.
fn own_drivers(scene: &Scene) -> impl Iterator<Item = usize> {
    (0..scene.drivers.len()).filter(|d| !scene.is_led(*d))
}

#[cfg(test)]
mod tests {
    use super::*;
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
                let earlier = figure.svg();
                let values: Vec<f64> = start.iter().map(|v| v + step).collect();
                let Ok(delta) = figure.redraw(&values) else {
                    assert_eq!(figure.svg(), earlier, "{name}: a refused pose leaves the figure");
                    continue;
                };
                let next = figure.svg();
                assert_eq!(applied(&earlier, &delta), parted(&next).1, "{name}");
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
                assert_eq!(identities(&fresh.svg()), identities(&figure.svg()), "{name}");
            }
        }
        assert!(moved > 30, "{moved}");
    }

    /// A pose out of reach gives a diagnosis, and the figure remains.
    #[test]
    fn a_pose_out_of_reach_leaves_the_figure() {
        let text = templates::text("crank-rocker", &[("l_CD", "130 mm")]);
        let problem = read(text.unwrap_or_else(|f| panic!("{f}"))).unwrap().value;
        let mut figure = live(&problem).unwrap();
        let earlier = figure.svg();
        let start = figure.values()[0];
        let refused = (0..60).filter(|k| figure.redraw(&[start + f64::from(*k) * 0.1]).is_err());
        assert!(refused.count() > 0 && figure.redraw(&[]).is_err());
        figure.redraw(&[start]).unwrap();
        assert_eq!(parted(&figure.svg()).1.len(), parted(&earlier).1.len());
    }
}
