//! Scenes.

use super::{Answer, Answered, Kind, Lesson, Look, Options, Pictures, Solved, Verdict};
use crate::attempts;
use crate::certified::{Certified, certify, steps};
use crate::diag::{Diagnostic, Faults, Warned, both};
use crate::figure::fit;
use crate::figure::forces::zhukovsky;
use crate::figure::list::{self, FigureEntry, FigureInput, Pages};
use crate::lesson;
use crate::notation::Notation;
use crate::plan::text::PlanWriter;
use crate::report::amount::symbol;
use crate::report::answers::{self, AnswerLine};
use crate::report::forces::ForceWriter;
use crate::report::{construction, drafting, trains};
use crate::scene::{DiagramKind, Lang, Scene};
use crate::sweep::follow::course;
use crate::worked::{NoAnswer, Scope, Unanswered, Worked, work};
use crate::worksheet::{self, Document, WorksheetSides, WorksheetTask};
use serde_json::Value as Json;

/// A scene with its solution.
#[derive(Debug)]
pub(super) struct SceneSolution {
    pub scene: Scene,
    pub worked: Worked,
}

pub(super) fn solve(given: &Scene, options: &Options) -> Result<Solved, Faults> {
    let Warned { value: mut scene, mut notes } = match options.whole_motion {
        true => whole_motion(given.clone()),
        false => Warned { value: given.clone(), notes: Vec::new() },
    };
    scene.paper.pencil_mm = options.pencil_mm.or(scene.paper.pencil_mm);
    let scope = if options.figures { Scope::Figure } else { Scope::Questions };
    let Warned { value: mut worked, notes: more } = work(&scene, scope)?;
    notes.extend(more);
    if options.drafting {
        worked = worked.with_drafting(&scene);
    }
    Ok(Solved { notes, answered: Box::new(SceneSolution { scene, worked }) })
}

/// Returns a scene for its whole motion: cams with an equivalent linkage that holds only at the
/// instant move their followers by their profiles instead. Adds a warning for each cam that is
/// assumed to keep the current piece of its profile.
pub fn whole_motion(scene: Scene) -> Warned<Scene> {
    let value = course::over_a_turn(&scene);
    let kept = |c: &crate::scene::Cam| {
        let (cam, follower) = (value.link_name(c.cam), value.link_name(c.follower));
        let message = both!(
            "beyond the instant, cam `{cam}` is taken to go on with the piece of its profile that `{follower}` touches now"
        );
        let warning = Diagnostic::warning("cam-piece", message).at(c.span);
        if c.posed.is_some() {
            return warning;
        }
        warning.help(both!(
            "give the face a line of the follower that begins in its pivot, such as \"line\": \"CF\": then the contact goes from piece to piece"
        ))
    };
    let notes = value.kept_cams().map(kept).collect();
    Warned { value, notes }
}

impl SceneSolution {
    fn look(&self, look: &Look) -> (Lang, Notation) {
        look.of(self.scene.language, self.scene.notation.as_deref())
    }

    fn certified(&self, look: &Look) -> Vec<Certified> {
        certify(&self.scene, &self.worked, look.digits)
    }

    /// The requested figures, each once.
    fn asked<'a>(&self, pictures: &Pictures<'a>) -> Vec<&'a FigureEntry> {
        let there = pictures.figures.iter().any(|e| e.name == list::MECHANISM.name);
        let alone: [&'static FigureEntry; 1] = [list::MECHANISM];
        let asked: Vec<&'a FigureEntry> = if pictures.extras.of_mechanism_alone() && !there {
            alone.to_vec()
        } else {
            pictures.figures.to_vec()
        };
        let first = |(k, entry): (usize, &&'a FigureEntry)| {
            (!asked[..k].iter().any(|e| e.name == entry.name)).then_some(*entry)
        };
        asked.iter().enumerate().filter_map(first).collect()
    }
}

impl Answered for SceneSolution {
    fn answers(&self, look: &Look) -> Vec<Answer> {
        let (lang, notation) = look.marked(&self.scene);
        let certified = self.certified(look);
        let without = |find: usize, text: String| {
            let find = &self.scene.find[find];
            Answer {
                find: find.text.clone(),
                symbol: symbol(find, &notation),
                unit: find.what.kind().si(),
                turns: find.what.kind().turns(),
                value: None,
                text,
                drawn: None,
                difference: None,
            }
        };
        let answer = |line: AnswerLine| match line {
            AnswerLine::Answer(r, c) => Answer {
                value: Some(r.value()),
                drawn: r.drawn.as_ref().map(|d| d.value),
                difference: r.agreement.map(|a| a.difference),
                ..without(
                    r.find,
                    answers::value_words(
                        &self.scene.book,
                        &self.scene.find[r.find],
                        r.value(),
                        c,
                        look.digits,
                        lang,
                    ),
                )
            },
            AnswerLine::None(u) => without(
                u.find,
                format!(
                    "{} ({})",
                    answers::verdict(u, lang),
                    answers::reason(&self.scene, u, lang)
                ),
            ),
            AnswerLine::InfiniteCentre(far) => without(far.find, answers::at_infinity(far, lang)),
        };
        answers::lines(&self.worked, &certified).into_iter().map(answer).collect()
    }

    fn text(&self, look: &Look, with_steps: bool) -> String {
        let SceneSolution { scene, worked } = self;
        let (lang, notation) = self.look(look);
        let mut out = answers::text(scene, worked, &self.certified(look), look.digits, lang);
        out += &trains::text(scene, worked, lang);
        if worked.drafting.is_none() && !with_steps {
            return out;
        }
        let w = PlanWriter { scene, plan: &worked.plan, notation: &notation, lang };
        let steps = steps(scene, worked, worked.drafting.as_ref().map(|d| d.pencil_mm));
        if worked.drafting.is_some() {
            out += &format!("\n{}", drafting::text(&w, worked, &steps));
        }
        if with_steps {
            out += &format!("\n{}", construction::text(&w, &worked.construction, &steps));
            if let Some(of) = &worked.equilibrium {
                let forces = ForceWriter { scene, notation: &notation, lang, of };
                out += &format!("\n{}", forces.text());
                let (lever, pole) = (zhukovsky(scene, worked), w.pole(DiagramKind::Velocity));
                out += &forces.checks_text(
                    &worked.configuration,
                    lever.as_ref().map(|lever| (lever, pole.as_str())),
                );
            }
        }
        out
    }

    fn kind(&self) -> Kind {
        Kind::Scene
    }

    fn json(&self, look: &Look, _: bool, notes: &[Diagnostic]) -> Json {
        answers::json(&self.scene, &self.worked, &self.certified(look), look.digits, notes)
    }

    fn figures(&self, pictures: &Pictures, look: &Look) -> Result<Warned<Pages>, Faults> {
        let options = look.sheet_of(&self.scene);
        let SceneSolution { scene, worked } = self;
        let wanted = FigureInput { scene, worked, options: &options, extras: &pictures.extras };
        if pictures.steps {
            let value = fit::steps(&wanted, pictures.page.as_ref())?;
            return if value.is_empty() {
                Err(no_steps().into())
            } else {
                Ok(Warned { value, notes: Vec::new() })
            };
        }
        let (mut out, mut notes, mut missing) = (Vec::new(), Vec::new(), Faults::default());
        for entry in self.asked(pictures) {
            let pages = fit::drawn(entry, &wanted, pictures.page.as_ref())?;
            notes.extend(pages.notes);
            if pages.value.is_empty() {
                missing.push(not_called_for(entry.name));
            }
            out.extend(pages.value);
        }
        if missing.has_errors() { Err(missing) } else { Ok(Warned { value: out, notes }) }
    }

    fn worksheet(
        &self,
        sides: WorksheetSides,
        task: WorksheetTask,
        look: &Look,
    ) -> Result<Document, Faults> {
        let options = worksheet::WorksheetOptions { sheet: look.sheet_of(&self.scene), sides };
        let SceneSolution { scene, worked } = self;
        let name = match task {
            WorksheetTask::Polygons => return Ok(worksheet::worksheet(scene, worked, &options)),
            WorksheetTask::Loops => return worksheet::by_loops(scene, worked, &options),
            WorksheetTask::Questions => return Ok(worksheet::questions(scene, worked, &options)),
            WorksheetTask::Mistake(name) => name,
        };
        let all = attempts::wanted(scene, worked, false)?;
        match all.iter().find(|a| name.is_empty() || a.site.mistake().name() == name) {
            Some(attempt) => Ok(worksheet::find_the_mistake(scene, worked, attempt, &options)),
            None => Err(no_mistake(name).into()),
        }
    }

    fn lesson(&self, wanted: &Lesson, look: &Look) -> Result<Warned<String>, Faults> {
        let (lang, notation) = look.marked(&self.scene);
        if wanted.reveal {
            let options = look.sheet_of(&self.scene);
            return match wanted.width_mm {
                Some(width_mm) => lesson::reveal_in(&self.scene, &self.worked, &options, width_mm),
                None => lesson::reveal(&self.scene, &self.worked, &options),
            };
        }
        let Lesson { positions, swept, method, .. } = *wanted;
        let style = look.style.clone();
        let options = lesson::LessonOptions { lang, notation, positions, swept, method, style };
        lesson::of_worked(&self.scene, &self.worked, &options)
    }

    fn verdict(&self) -> Verdict {
        Verdict::of(&self.worked)
    }

    fn mechanism(&self) -> Option<(&Scene, &Worked)> {
        Some((&self.scene, &self.worked))
    }
}

impl Verdict {
    /// The verdict on a scene; an infinite radius counts as an answer.
    pub fn of(worked: &Worked) -> Verdict {
        let infinite = |u: &Unanswered| matches!(u.why, NoAnswer::Infinite(_));
        let agrees = worked.results.iter().all(|r| r.agreement.is_none_or(|a| a.holds()));
        match (agrees, worked.unanswered.iter().all(infinite)) {
            (false, _) => Verdict::Disagree,
            (true, false) => Verdict::Unanswered,
            (true, true) => Verdict::Answered,
        }
    }
}

fn not_called_for(word: &str) -> Diagnostic {
    let d =
        Diagnostic::error("no-figure", both!("the scene's questions call for no figure `{word}`"));
    d.help(both!("ask for one in \"find\", or leave `{word}` out of --figure"))
}

fn no_steps() -> Diagnostic {
    Diagnostic::error("no-figure", both!("there is nothing to draw")).help(both!(
        "of what the scene asks no step is drawn: leave --steps out, or ask for velocities or accelerations in \"find\""
    ))
}

fn no_mistake(name: &str) -> Diagnostic {
    let message = match name {
        "" => both!("no known mistake changes an answer of this scene"),
        name => both!("the mistake `{name}` cannot be made in this scene"),
    };
    Diagnostic::error("attempt", message)
        .help(both!("`hodograph attempts --all` lists those that can"))
}
