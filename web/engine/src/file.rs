//! An opened file: its problem, and its solution in its own pose.

use crate::motion::exact;
use crate::moving::MovingFigures;
use crate::plane;
use crate::words::{diagnostics, failed};
use hodograph::diag::{Both, Diagnostic, Faults, Warned};
use hodograph::figure::cycle::CycleForm;
use hodograph::figure::list::{self, FigureEntry, Pages};
use hodograph::paper::label::Label;
use hodograph::problem::cams::{self, SurveyedCam};
use hodograph::problem::cycle::CycledScene;
use hodograph::problem::range::RangeFault;
use hodograph::problem::{self, Kind, Look, Options, Pictures, Problem, Solved, Verdict, whole};
use hodograph::render::math::mathml;
use hodograph::render::svg;
use hodograph::scene::{DriverKind, Scene, Swept};
use hodograph::sweep::follow::PoseFollower;
use serde_json::{Value as Json, json};

/// A file under a handle.
pub struct OpenFile {
    /// Its text.
    pub text: String,
    /// Its problem.
    pub problem: Problem,
    /// Its solution with all positions.
    pub solved: Solved,
    /// The moving quantity of a scene.
    pub swept: Option<Swept>,
    /// The figures in motion.
    pub moving: Option<MovingFigures>,
    notes: Vec<Diagnostic>,
}

/// Gives the mechanism a scale (m per mm), if it is one.
fn hold_plane(scene: &mut Scene, mu: Option<f64>) {
    if mu.is_some_and(|mu| mu.is_finite() && mu > 0.0) {
        scene.paper.scales.set(hodograph::kind::Kind::Length, mu);
    }
}

impl OpenFile {
    /// Reads and solves a file: candidate `pick` (from 0) of a task, a mechanism in the scale `mu`
    /// (m per mm), if one is given.
    ///
    /// # Errors
    /// The errors of reading and solving.
    pub fn read(text: &str, pick: usize, mu: Option<f64>) -> Result<OpenFile, Faults> {
        let Warned { value: mut problem, mut notes } = problem::read(text)?;
        if let Problem::Scene(scene) = &mut problem {
            hold_plane(scene, mu);
        }
        let options = Options { candidate: pick, ..Options::with_figures() };
        let solved = problem::solve(&problem, &options)?;
        notes.extend(solved.notes.iter().cloned());
        let swept = match &problem {
            Problem::Scene(scene) if !scene.drivers.is_empty() => Some(Swept::usual(scene)),
            _ => None,
        };
        Ok(OpenFile { text: text.to_owned(), problem, solved, swept, moving: None, notes })
    }

    /// Returns the description of the file: kind, title, drivers, names, remarks.
    pub fn told(&self, look: &Look) -> Json {
        let scene = self.scene();
        json!({
            "ok": true,
            "kind": self.problem.kind().word(),
            "title": self.title(look),
            "language": self.language(look),
            "drivers": scene.map(drivers),
            "swept": self.swept.map(|s| match s { Swept::Driver(d) => json!(d), Swept::Time => json!("t") }),
            "names": scene.map(plane::names),
            "candidates": self.solved.design().map(|d| d.candidates.len()),
            "diagnostics": diagnostics(&self.notes, &self.text),
            "verdict": verdict(&self.solved),
        })
    }

    fn title(&self, look: &Look) -> String {
        let both = |title: &Both, own| look.of(own, None).0.of(title).to_owned();
        match &self.problem {
            Problem::Scene(scene) => both(&scene.title, scene.language),
            Problem::Motion(problem) => both(&problem.title, problem.language),
            Problem::Equation(problem) => both(&problem.title, problem.language),
            Problem::Task(task) => both(&task.heading.title, task.language),
            _ => String::new(),
        }
    }

    /// Language in which the file is shown.
    fn language(&self, look: &Look) -> &'static str {
        let own = match &self.problem {
            Problem::Scene(scene) => scene.language,
            Problem::Motion(problem) => problem.language,
            Problem::Equation(problem) => problem.language,
            _ => None,
        };
        match look.of(own, None).0 {
            hodograph::scene::Lang::En => "en",
            hodograph::scene::Lang::Zh => "zh",
        }
    }

    /// The scene, if the file is one.
    pub fn scene(&self) -> Option<&Scene> {
        match &self.problem {
            Problem::Scene(scene) => Some(scene),
            _ => None,
        }
    }

    /// Returns the solution at a travel (rad, m or s) of the moving quantity from the file's own
    /// pose, in the scales of that pose, or with the mechanism in the scale `mu`: that of the text
    /// with this place of the driver, if the text gives one.
    ///
    /// # Errors
    /// The errors of reading and solving.
    pub fn at(&self, travel: f64, mu: Option<f64>) -> Result<Solved, Faults> {
        let options = Options::with_figures();
        let moved = match self.text_at(travel, exact) {
            Some(text) => problem::read(text)?.value,
            None => {
                let (Some((scene, worked)), Some(swept)) = (self.solved.mechanism(), self.swept)
                else {
                    return problem::solve(&self.problem, &options);
                };
                let (of, at) = (&worked.mechanism, &worked.configuration);
                let follower = PoseFollower::new(scene, of, &worked.demand, at, swept);
                Problem::Scene(Box::new(follower.scene_at(scene, travel)))
            }
        };
        self.scaled(moved, mu)
    }

    /// Returns the solution of the file in another pose or scale of the mechanism.
    fn scaled(&self, problem: Problem, mu: Option<f64>) -> Result<Solved, Faults> {
        let options = Options::with_figures();
        let Problem::Scene(mut scene) = problem else { return problem::solve(&problem, &options) };
        if let Some((_, worked)) = self.solved.mechanism() {
            worked.hold_scales(&mut scene);
        }
        hold_plane(&mut scene, mu);
        problem::solve(&Problem::Scene(scene), &options)
    }

    /// Answers `frame`: the figures `what` (`["sheet"]` without), and the answers; with `plane` the
    /// places of the mechanism, with `mu` the mechanism in that scale (m per mm).
    pub fn frame(&self, message: &Json) -> Json {
        let look = crate::words::look(message);
        let there;
        let mu = message["mu"].as_f64();
        let at = match (message["travel"].as_f64(), mu) {
            (None, None) => None,
            (None, mu) => Some(self.scaled(self.problem.clone(), mu)),
            (Some(travel), mu) => Some(self.at(travel, mu)),
        };
        let solved = match at {
            Some(told) => match told {
                Ok(solved) => {
                    there = solved;
                    &there
                }
                Err(faults) => return failed(&faults, &self.text),
            },
            None => &self.solved,
        };
        let (mut figures, mut missing) = (Vec::new(), Vec::new());
        for entry in wanted(message) {
            match self.drawn(solved, entry, &look) {
                Ok(drawn) => figures.extend(drawn),
                Err(faults) => missing.extend(faults.list),
            }
        }
        let named = message["what"].as_array().map_or(&[][..], Vec::as_slice);
        for name in named.iter().filter_map(Json::as_str) {
            let made = self.of_motion(name, message, false);
            match made.map(|pages| self.written(name, pages?)).transpose() {
                Ok(pages) => figures.extend(pages.into_iter().flatten()),
                Err(faults) => missing.extend(faults.list),
            }
        }
        if message["prefix"] == json!(true) {
            figures.iter_mut().for_each(put_before);
        }
        json!({
            "ok": true,
            "figures": figures,
            "missing": diagnostics(&missing, &self.text),
            "answers": if message["answers"] == json!(true) { answers(solved, &look) } else { Json::Null },
            "verdict": verdict(solved),
            "plane": if message["plane"] == json!(true) { plane::plane(solved) } else { Json::Null },
        })
    }

    /// Draws one figure of a solution.
    pub fn drawn(
        &self,
        solved: &Solved,
        entry: &'static FigureEntry,
        look: &Look,
    ) -> Result<Vec<Json>, Faults> {
        let pictures = Pictures { figures: &[entry], ..Pictures::default() };
        let drawn = solved.figures(&pictures, look)?;
        let papers: Vec<Json> = drawn.value.iter().map(|(_, f)| plane::paper(solved, f)).collect();
        let mut written = self.written(entry.name, drawn)?;
        for (page, paper) in written.iter_mut().zip(papers) {
            page["paper"] = paper;
        }
        Ok(written)
    }

    /// Draws a figure of the whole motion, which is none of [`list::LIST`]: diagrams of the answers
    /// (on pages of A4 if `paged`), the motion cycle, the least base circle of a cam; `None` for
    /// another name.
    pub fn of_motion(
        &self,
        name: &str,
        message: &Json,
        paged: bool,
    ) -> Option<Result<Warned<Pages>, Faults>> {
        let look = crate::words::look(message);
        let alone = |figure| vec![(name.to_owned(), figure)];
        match name {
            "curves" => Some(whole::curves(self.text.as_bytes(), &look, paged)),
            "cycle" => Some(self.cycle().map(|made| {
                let (lang, _) = look.of(made.value.scene.language, None);
                let form = message["cycle"].as_str().and_then(CycleForm::named);
                let form = form.unwrap_or(CycleForm::Bars);
                made.map(|of| alone(of.figure(form, &look.style, lang)))
            })),
            "cam-alpha" => Some(self.with_cams(message, |cams, scene| {
                let (lang, _) = look.of(scene.language, None);
                cams.iter()
                    .filter_map(|c| c.least_figure(&look.style, lang))
                    .flat_map(alone)
                    .collect()
            })),
            _ => None,
        }
    }

    /// Returns the motion cycle of all outputs.
    ///
    /// # Errors
    /// A file without a mechanism or driver; those of the limits of the motion.
    pub fn cycle(&self) -> Result<Warned<CycledScene>, Faults> {
        let (scene, _) = self.solved.needed_mechanism()?;
        Ok(CycledScene::of(scene.clone(), None, &[])?)
    }

    /// Applies `take` to the cams of the scene, with the least ones for the pressure angle `alpha`.
    ///
    /// # Errors
    /// A file without such cams; an `alpha` that is no allowed pressure angle.
    pub fn with_cams<T>(
        &self,
        message: &Json,
        take: impl FnOnce(&[SurveyedCam], &Scene) -> T,
    ) -> Result<Warned<T>, Faults> {
        let (scene, _) = self.solved.needed_mechanism()?;
        let allowed = message["alpha"].as_str().map(|alpha| cams::allowed(alpha, None)).transpose();
        let allowed = allowed.map_err(RangeFault::from)?;
        let cams = cams::survey(scene, None, allowed)?;
        let notes = cams.iter().flat_map(|cam| cam.report.faults()).collect();
        Ok(Warned { value: take(&cams, scene), notes })
    }

    fn written(&self, figure: &str, pages: Warned<Pages>) -> Result<Vec<Json>, Faults> {
        let one = |(name, drawn)| {
            let Warned { value, notes } = svg::write(&drawn)?;
            Ok(
                json!({"name": name, "figure": figure, "svg": value, "notes": diagnostics(&notes, &self.text)}),
            )
        };
        let mut written: Vec<Json> =
            pages.value.into_iter().map(one).collect::<Result<_, Faults>>()?;
        if let (Some(first), false) = (written.first_mut(), pages.notes.is_empty()) {
            first["notes"] = diagnostics(&pages.notes, &self.text);
        }
        Ok(written)
    }

    /// Answers `steps`: a picture for each step of the construction.
    pub fn steps(&self, message: &Json) -> Json {
        let look = crate::words::look(message);
        let pictures = Pictures { steps: true, ..Pictures::default() };
        let drawn = self.solved.figures(&pictures, &look).and_then(|p| self.written("step", p));
        match drawn {
            Ok(pages) => json!({"ok": true, "figures": pages}),
            Err(faults) => failed(&faults, &self.text),
        }
    }

    /// The kind of the file.
    pub fn kind(&self) -> Kind {
        self.problem.kind()
    }
}

/// The figures that a message asks for: those named in `what`, or the sheet.
pub fn wanted(message: &Json) -> Vec<&'static FigureEntry> {
    match message["what"].as_array() {
        Some(names) => {
            names.iter().filter_map(|n| list::named(n.as_str().unwrap_or_default())).collect()
        }
        None => vec![list::USUAL],
    }
}

/// The prefix that makes the ids of a page different from those of other pages on the screen.
pub fn prefix(page: &str) -> svg::IdPrefix {
    svg::IdPrefix::new(&format!("p-{page}-")).unwrap_or_default()
}

fn put_before(page: &mut Json) {
    if let (Some(name), Some(svg)) = (page["name"].as_str(), page["svg"].as_str()) {
        page["svg"] = json!(prefix(name).put_before(svg));
    }
}

fn drivers(scene: &Scene) -> Json {
    let one = |d: usize| {
        let driver = &scene.drivers[d];
        json!({
            "name": scene.driver_name(d).0,
            "turns": driver.kind.turns(),
            "position": hodograph::scene::driver_position(scene, d),
            "rate": driver.rate.value,
            "led": scene.is_led(d),
            "kind": match driver.kind {
                DriverKind::Turn { .. } => "turn",
                DriverKind::Slide { .. } => "slide",
                DriverKind::Cylinder { .. } => "cylinder",
            },
        })
    };
    (0..scene.drivers.len()).map(one).collect()
}

/// Answers of a solution, for `answers`.
pub fn answers(solved: &Solved, look: &Look) -> Json {
    // As many digits as `solve` prints.
    let look = &Look { digits: Look::default().digits, ..look.clone() };
    let one = |a: problem::Answer| {
        let answered = a.value.is_some();
        let symbol = mathml(&Label::math(a.symbol));
        json!({"find": a.find, "symbol": symbol, "text": a.text, "answered": answered, "difference": a.difference})
    };
    solved.answers(look).into_iter().map(one).collect()
}

/// The word for the outcome of a solution.
pub fn verdict(solved: &Solved) -> &'static str {
    match solved.verdict() {
        Verdict::Answered => "answered",
        Verdict::Disagree => "disagree",
        _ => "unanswered",
    }
}
