//! Motions of points without a mechanism.

use super::{Answer, Answered, Kind, Lesson, Look, Pictures, Solved, Verdict};
use crate::answer::AnswerValue as Told;
use crate::diag::{Diagnostic, Faults, Warned, both};
use crate::figure::list::Pages;
use crate::figure::{fit, particle as figure, sheet};
use crate::lesson::motion as lesson;
use crate::notation::Notation;
use crate::paper::style::{Marks, Style};
use crate::particle::board::{self, MotionDrawing};
use crate::particle::{self, ParticleProblem, ParticleValue};
use crate::report::particle as report;
use crate::scene::{Lang, Swept};
use crate::worksheet::{self, Document, WorksheetSides, WorksheetTask};
use serde_json::Value as Json;

/// Motions with their solution.
#[derive(Debug)]
struct MotionSolution {
    problem: ParticleProblem,
    solved: particle::ParticleSolution,
    board: Vec<MotionDrawing>,
}

pub(super) fn solve(problem: &ParticleProblem) -> Result<Solved, Faults> {
    let solved = particle::solve(problem)?;
    let board = board::draw(problem)?;
    let notes = board.iter().filter_map(|d| d.unread.clone()).collect();
    Ok(Solved {
        notes,
        answered: Box::new(MotionSolution { problem: problem.clone(), solved, board }),
    })
}

impl MotionSolution {
    fn lang(&self, look: &Look) -> Lang {
        look.lang.or(self.problem.language).unwrap_or_default()
    }

    /// The style, with the marks of the requested notation in addition to its own.
    fn style(&self, look: &Look) -> Style {
        let marks =
            look.notation.as_ref().map(|notation| Marks::of(look.style.marks.over(notation)));
        Style { marks: marks.unwrap_or_else(|| look.style.marks.clone()), ..look.style.clone() }
    }

    /// Relative difference between drawing and analysis.
    fn apart(&self, answer: &particle::ParticleAnswer) -> Option<f64> {
        let what = self.problem.find[answer.find].what;
        let drawn = report::drawn(&self.board, what)?;
        report::apart(&answer.value, drawn, report::largest(&self.problem, &self.solved, what))
    }
}

/// Largest relative difference between drawing and analysis that counts as agreement.
const AGREES: f64 = 1e-9;

/// A value in the plane; `None` for a value in space.
fn in_plane(parts: &[f64]) -> Option<Told> {
    match parts {
        [value] => Some(Told::Scalar(*value)),
        [x, y] => Some(Told::Vector(crate::geom::Vec2::new(*x, *y))),
        _ => None,
    }
}

impl Answered for MotionSolution {
    fn answers(&self, look: &Look) -> Vec<Answer> {
        let lang = self.lang(look);
        let notation = look.notation.clone().unwrap_or_else(|| Notation::of_language(lang));
        let answer = |a: &particle::ParticleAnswer| {
            let find = &self.problem.find[a.find];
            let size = report::largest(&self.problem, &self.solved, find.what);
            let parts = a.value.vector().or_else(|| a.value.scalar().map(|s| vec![s]));
            Answer {
                find: find.text.clone(),
                symbol: report::symbol(&self.problem, find.what, &notation),
                unit: report::kind(find.what).map_or("s", |q| q.si()),
                turns: report::kind(find.what).is_some_and(|q| q.turns()),
                value: parts.as_deref().and_then(in_plane),
                text: report::value(
                    &self.problem.book,
                    find.what,
                    &a.value,
                    size,
                    look.digits,
                    lang,
                ),
                drawn: report::drawn(&self.board, find.what).and_then(in_plane),
                difference: self.apart(a),
            }
        };
        self.solved.answers.iter().map(answer).collect()
    }

    fn text(&self, look: &Look, steps: bool) -> String {
        let lang = self.lang(look);
        let notation = look.notation.clone().unwrap_or_else(|| Notation::of_language(lang));
        report::text(
            &self.problem,
            &self.solved,
            &self.board,
            look.digits,
            steps.then_some(&notation),
            lang,
        )
    }

    fn kind(&self) -> Kind {
        Kind::Motion
    }

    fn json(&self, look: &Look, _: bool, notes: &[Diagnostic]) -> Json {
        report::json(&self.problem, &self.solved, &self.board, look.digits, notes)
    }

    fn figures(&self, pictures: &Pictures, look: &Look) -> Result<Warned<Pages>, Faults> {
        let mut pages = figure::figures(
            &self.problem,
            &self.solved,
            &self.board,
            &self.style(look),
            self.lang(look),
        )?;
        if pages.is_empty() {
            let message =
                both!("there is nothing to draw: no point pursues another one or moves on a plate");
            let help = both!(
                "`hodograph solve` answers what is asked of laws alone; with \"links\" and the points \"on\" the ground it is a scene, which is drawn"
            );
            return Err(Diagnostic::error("no-figure", message).help(help).into());
        }
        if let Some(format) = &pictures.page {
            pages = fit::placed(pages, format, false)?;
        }
        Ok(Warned { value: pages, notes: Vec::new() })
    }

    fn worksheet(
        &self,
        sides: WorksheetSides,
        _: WorksheetTask,
        look: &Look,
    ) -> Result<Document, Faults> {
        let sheet = sheet::SheetOptions {
            style: self.style(look),
            digits: look.digits,
            ..sheet::SheetOptions::of_language(self.lang(look))
        };
        Ok(worksheet::particle(
            &self.problem,
            &self.solved,
            &self.board,
            &worksheet::WorksheetOptions { sheet, sides },
        )?)
    }

    fn lesson(&self, wanted: &Lesson, look: &Look) -> Result<Warned<String>, Faults> {
        let motion = match wanted.swept {
            Swept::Driver(k) => k,
            Swept::Time => 0,
        };
        let options = lesson::MotionOptions {
            lang: self.lang(look),
            style: self.style(look),
            positions: wanted.positions,
            motion,
        };
        let value = lesson::lesson(&self.problem, &options)?;
        Ok(Warned { value, notes: Vec::new() })
    }

    fn verdict(&self) -> Verdict {
        if self.solved.answers.iter().filter_map(|a| self.apart(a)).any(|off| off > AGREES) {
            return Verdict::Disagree;
        }
        let none = self.solved.answers.iter().any(|a| matches!(a.value, ParticleValue::None(_)));
        if none { Verdict::Unanswered } else { Verdict::Answered }
    }
}
