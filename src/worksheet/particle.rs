//! The worksheet of a motion without a mechanism: the problem; the drawing with its sentences, the
//! formulas, the answers by both methods.

mod given;

use super::{
    Document, DocumentBlock, DocumentTable, TableKind, WorksheetOptions, WorksheetSides, one_line,
};
use crate::diag::Diagnostic;
use crate::digits::significant;
use crate::figure::particle::{as_given, notation, within_text};
use crate::notation::Notation;
use crate::paper::label::Label;
use crate::paper::phrase::Phrase;
use crate::particle::board::MotionDrawing;
use crate::particle::{ParticleMotionKind, ParticleProblem, ParticleSolution};
use crate::render::math::Math;
use crate::report::particle::{
    drawn, in_unit, integrated, largest, marked, sentence, symbol, unit, value,
};
use crate::scene::Lang;
use hodograph_base::lang::{each, tr};

/// Makes the worksheet.
///
/// # Errors
/// Laws without a value during the motion.
pub fn particle(
    problem: &ParticleProblem,
    solved: &ParticleSolution,
    board: &[MotionDrawing],
    options: &WorksheetOptions,
) -> Result<Document, Diagnostic> {
    let lang = options.sheet.lang;
    let notation = &notation(&options.sheet.style, lang);
    let heading =
        |level: u8, words: [&str; 2]| DocumentBlock::Heading(level, lang.pick(words).into());
    let mut blocks = Vec::new();
    if options.sides != WorksheetSides::Solution {
        blocks.push(heading(1, each!("Problem")));
        if let Some(text) = &problem.statement {
            blocks.extend(lang.of(text).lines().map(|l| DocumentBlock::Paragraph(Phrase::new(l))));
        }
        for d in board {
            let figure = as_given(problem, solved, d, &options.sheet.style, lang)?;
            blocks.push(DocumentBlock::Figure { name: "given", figure: Box::new(figure) });
        }
        let list = |members| DocumentBlock::List { numbered: false, members };
        blocks.extend([heading(2, each!("Given")), list(given::given(problem, lang))]);
        blocks.extend([heading(2, each!("Wanted")), list(given::wanted(problem, lang, notation))]);
    }
    if options.sides != WorksheetSides::Problem {
        blocks.push(heading(1, each!("Solution")));
        for d in board {
            blocks.extend(equations(problem, d, lang, notation));
            let figure = within_text(problem, solved, d, &options.sheet.style, lang)?;
            blocks.push(match d.calculated {
                true => heading(2, each!("Calculated, shown to scale")),
                false => heading(2, each!("Drawing")),
            });
            blocks.push(DocumentBlock::Figure { name: "motion", figure: Box::new(figure) });
            let steps = d.steps.iter().map(|s| sentence(s, lang, notation)).collect();
            blocks.push(DocumentBlock::List { numbered: true, members: steps });
        }
        blocks.extend([
            heading(2, each!("Answers")),
            DocumentBlock::Table(answers(problem, solved, board, options, notation)),
        ]);
    }
    Ok(Document {
        title: one_line(lang.of(&problem.title)),
        lang,
        fonts: options.sheet.style.fonts.clone(),
        blocks,
    })
}

/// The drawn equations.
fn equations(
    problem: &ParticleProblem,
    d: &MotionDrawing,
    lang: Lang,
    notation: &Notation,
) -> Vec<DocumentBlock> {
    let motion = &problem.motions[d.motion];
    let formula = |source: &str| {
        DocumentBlock::Formula(vec![Math::Row(Label::math(marked(source, notation)))])
    };
    match &motion.kind {
        ParticleMotionKind::Toward { .. } => {
            let (a, b) = (&motion.point, problem.chase(motion).map_or("", |c| c.1));
            vec![
                DocumentBlock::Paragraph(Phrase::of_words(integrated(lang))),
                formula(&format!(
                    "v_{{{a}}} \\parallel {a}{b} ,\\quad \\omega_{{{a}{b}}} = v_{{{b}\\perp}} / l_{{{a}{b}}} ,\\quad a_{{{a}}}^n = v_{{{a}}} \\omega_{{{a}{b}}} ,\\quad \\rho_{{{a}}} = v_{{{a}}} / \\omega_{{{a}{b}}}"
                )),
            ]
        }
        ParticleMotionKind::OnPlate(..) => vec![
            DocumentBlock::Paragraph(Phrase::new(tr!(
                lang,
                "Moving point: the point; frame: the plate. What is along the axis, and $v_r$, $a_r$, is seen on the plate; what is square to the axis is seen along it."
            ))),
            formula("v_a = v_e + v_r ,\\quad v_e = \\omega \\times r"),
            formula(
                "a_a = a_e^n + a_e^t + a_r^n + a_r^t + a_k ,\\quad a_k = 2 \\omega v_r \\sin \\theta",
            ),
        ],
        ParticleMotionKind::Fixed(_) => Vec::new(),
    }
}

fn answers(
    problem: &ParticleProblem,
    solved: &ParticleSolution,
    board: &[MotionDrawing],
    options: &WorksheetOptions,
    notation: &Notation,
) -> DocumentTable {
    let lang = options.sheet.lang;
    let head = [tr!(lang, "quantity"), tr!(lang, "drawing"), tr!(lang, "analysis")];
    let mut rows = vec![head.iter().map(|h| Phrase::of_words(h)).collect::<Vec<_>>()];
    for a in &solved.answers {
        let what = problem.find[a.find].what;
        let read = drawn(board, what).map_or_else(
            || "—".to_owned(),
            |all| {
                let size = match all {
                    [one] => *one,
                    _ => all.iter().fold(0.0, |s, x| s + x * x).sqrt(),
                };
                format!(
                    "{} {}",
                    significant(in_unit(&problem.book, what, size), 4),
                    unit(&problem.book, what)
                )
            },
        );
        let cells = [
            format!("${}$", symbol(problem, what, notation)),
            printed(&read),
            printed(&value(
                &problem.book,
                what,
                &a.value,
                largest(problem, solved, what),
                options.sheet.digits,
                lang,
            )),
        ];
        rows.push(cells.iter().map(|c| Phrase::new(c)).collect());
    }
    DocumentTable { kind: TableKind::Values, rows }
}

/// Numbers in print: the minus sign is as long as the plus sign.
fn printed(text: &str) -> String {
    text.replace('-', "−")
}
