//! Vector equations on their own.

use super::{Answer, Answered, Kind, Lesson, Look, Pictures, Solved, Verdict};
use crate::answer::AnswerValue;
use crate::diag::{Diagnostic, Faults, Warned};
use crate::equation::board::{self, EquationDrawing};
use crate::equation::{self, EquationSolution, RootVector, VectorEquation};
use crate::figure::list::Pages;
use crate::figure::synthesis::growing;
use crate::figure::vector_equation::EquationSheet;
use crate::figure::{fit, sheet};
use crate::lesson::equation as lesson;
use crate::notation::Notation;
use crate::paper::style::Style;
use crate::report::vector_equation as report;
use crate::scene::Lang;
use crate::worksheet::{self, Document, WorksheetSides, WorksheetTask};
use serde_json::Value as Json;

/// An equation with its solution.
#[derive(Debug)]
struct EquationSolved {
    problem: VectorEquation,
    solved: EquationSolution,
    drawn: EquationDrawing,
}

pub(super) fn solve(problem: &VectorEquation) -> Result<Solved, Faults> {
    let solved = equation::solve(problem)?;
    let drawn = board::draw(problem)?;
    let answered = Box::new(EquationSolved { problem: problem.clone(), solved, drawn });
    Ok(Solved { notes: Vec::new(), answered })
}

/// Returns the table of an equation with the count of its unknowns, as text and for programs; also
/// of one that cannot be solved.
pub fn equation_plan(problem: &VectorEquation, look: &Look) -> (String, Json) {
    let (lang, notation) = look.of(problem.language, problem.notation.as_deref());
    (report::plan(problem, &notation, lang), report::plan_json(problem))
}

impl EquationSolved {
    fn look(&self, look: &Look) -> (Lang, Notation) {
        let (lang, notation) = look.of(self.problem.language, self.problem.notation.as_deref());
        (lang, look.style.marks.over(&notation))
    }

    /// The vectors with unknowns, solution after solution.
    fn vectors(&self) -> impl Iterator<Item = (usize, &RootVector)> {
        let roots = self.solved.roots.iter().enumerate();
        roots.flat_map(|(k, root)| root.vectors.iter().map(move |v| (k, v)))
    }

    /// Calls a function with the drawing in a style.
    fn sheet<T>(&self, style: &Style, look: &Look, make: impl FnOnce(EquationSheet) -> T) -> T {
        let (lang, notation) = self.look(look);
        let (problem, solved, drawn) = (&self.problem, &self.solved, &self.drawn);
        make(EquationSheet { problem, solved, drawn, style, notation: &notation, lang })
    }
}

impl Answered for EquationSolved {
    fn answers(&self, look: &Look) -> Vec<Answer> {
        let answer = |(root, v): (usize, &RootVector)| Answer {
            find: report::find(&self.problem, &self.solved, root, v.term),
            symbol: self.problem.terms[v.term].symbol(report::primes(&self.solved, root)),
            unit: self.problem.on.kind().si(),
            turns: false,
            value: Some(AnswerValue::Vector(v.value)),
            text: report::value(&self.problem, &self.solved, v, look.digits),
            drawn: self.drawn.read(v.term, root).map(AnswerValue::Vector),
            difference: report::apart(&self.solved, &self.drawn, root, v),
        };
        self.vectors().map(answer).collect()
    }

    fn text(&self, look: &Look, steps: bool) -> String {
        let (lang, notation) = self.look(look);
        let (problem, solved, drawn) = (&self.problem, &self.solved, &self.drawn);
        report::text(problem, solved, drawn, (look.digits, steps), &notation, lang)
    }

    fn kind(&self) -> Kind {
        Kind::Equation
    }

    fn json(&self, look: &Look, _: bool, notes: &[Diagnostic]) -> Json {
        report::json(&self.problem, &self.solved, &self.drawn, look.digits, notes)
    }

    fn figures(&self, pictures: &Pictures, look: &Look) -> Result<Warned<Pages>, Faults> {
        let figure = self.sheet(&look.style, look, |sheet| sheet.figure(true));
        let mut pages =
            if pictures.steps { growing(&figure) } else { vec![(String::new(), figure)] };
        if let Some(format) = &pictures.page {
            pages = fit::placed(pages, format, pictures.steps)?;
        }
        Ok(Warned { value: pages, notes: Vec::new() })
    }

    fn worksheet(
        &self,
        sides: WorksheetSides,
        _: WorksheetTask,
        look: &Look,
    ) -> Result<Document, Faults> {
        let (lang, _) = self.look(look);
        let sheet = sheet::SheetOptions {
            style: look.style.clone(),
            digits: look.digits,
            ..sheet::SheetOptions::of_language(lang)
        };
        let options = worksheet::WorksheetOptions { sheet, sides };
        Ok(self.sheet(&look.style, look, |sheet| worksheet::equation(&sheet, &options)))
    }

    fn lesson(&self, _: &Lesson, look: &Look) -> Result<Warned<String>, Faults> {
        let value = self.sheet(&look.style, look, |sheet| lesson::lesson(&sheet))?;
        Ok(Warned { value, notes: Vec::new() })
    }

    fn verdict(&self) -> Verdict {
        let off = |(root, v): (usize, &RootVector)| {
            let apart = report::apart(&self.solved, &self.drawn, root, v);
            // The error of a flat crossing grows with the reciprocal of its sine.
            apart.is_none_or(|off| off * self.solved.roots[root].sine > report::AGREES)
        };
        if self.vectors().any(off) { Verdict::Disagree } else { Verdict::Answered }
    }
}
