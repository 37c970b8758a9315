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
use crate::paper::phrase::{Phrase, tr};
use crate::particle::board::MotionDrawing;
use crate::particle::{ParticleMotionKind, ParticleProblem, ParticleSolution};
use crate::render::math::Math;
use crate::report::particle::{
    drawn, in_unit, integrated, largest, marked, sentence, symbol, unit, value,
};
use crate::scene::Lang;

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
    let heading = |level: u8, en: &'static str, zh: &'static str| {
        DocumentBlock::Heading(level, tr(lang, en, zh).into())
    };
    let mut blocks = Vec::new();
    if options.sides != WorksheetSides::Solution {
        blocks.push(heading(1, "Problem", "题目"));
        if let Some(text) = &problem.statement {
            blocks.extend(text.get(lang).lines().map(|l| DocumentBlock::Paragraph(Phrase::new(l))));
        }
        for d in board {
            let figure = as_given(problem, solved, d, &options.sheet.style, lang)?;
            blocks.push(DocumentBlock::Figure { name: "given", figure: Box::new(figure) });
        }
        let list = |members| DocumentBlock::List { numbered: false, members };
        blocks.extend([heading(2, "Given", "已知"), list(given::given(problem, lang))]);
        blocks.extend([heading(2, "Wanted", "求"), list(given::wanted(problem, lang, notation))]);
    }
    if options.sides != WorksheetSides::Problem {
        blocks.push(heading(1, "Solution", "解"));
        for d in board {
            blocks.extend(equations(problem, d, lang, notation));
            let figure = within_text(problem, solved, d, &options.sheet.style, lang)?;
            blocks.push(match d.calculated {
                true => heading(2, "Calculated, shown to scale", "计算所得，按比例示出"),
                false => heading(2, "Drawing", "作图"),
            });
            blocks.push(DocumentBlock::Figure { name: "motion", figure: Box::new(figure) });
            let steps = d.steps.iter().map(|s| sentence(s, lang, notation)).collect();
            blocks.push(DocumentBlock::List { numbered: true, members: steps });
        }
        blocks.extend([
            heading(2, "Answers", "结果"),
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
    let say = |en: &'static str, zh: &'static str| {
        DocumentBlock::Paragraph(Phrase::new(tr(lang, en, zh)))
    };
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
            say(
                "Moving point: the point; frame: the plate. What is along the axis, and $v_r$, $a_r$, is seen on the plate; what is square to the axis is seen along it.",
                "动点：该点；动系：平板。沿轴的分量以及 $v_r$、$a_r$ 在板面视图中示出真实长度；垂直于轴的分量在沿轴视图中示出。",
            ),
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
    let head =
        [tr(lang, "quantity", "量"), tr(lang, "drawing", "作图"), tr(lang, "analysis", "解析")];
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
