//! The worksheet of a vector equation: the problem; its table, the polygon with its sentences, the
//! answers by both methods.

use super::{
    Document, DocumentBlock, DocumentTable, TableKind, WorksheetOptions, WorksheetSides, one_line,
};
use crate::digits::{minus, shortest, significant};
use crate::equation::{VectorTerm, unknowns};
use crate::figure::vector_equation::EquationSheet;
use crate::notation::Notation;
use crate::paper::phrase::Phrase;
use crate::paper::words::words;
use crate::plan::text::EquationColumn;
use crate::report::vector_equation::{columns, count, primes, value};
use crate::scene::Lang;
use hodograph_base::lang::{each, say, tr};

/// Makes the worksheet.
pub fn equation(sheet: &EquationSheet, options: &WorksheetOptions) -> Document {
    let lang = sheet.lang;
    let heading =
        |level: u8, words: [&str; 2]| DocumentBlock::Heading(level, lang.pick(words).into());
    let table = || {
        let columns = columns(&sheet.problem.terms, sheet.notation);
        DocumentBlock::Table(equation_table(columns, lang, sheet.notation))
    };
    let mut blocks = Vec::new();
    if options.sides != WorksheetSides::Solution {
        blocks.push(heading(1, each!("Problem")));
        if let Some(text) = &sheet.problem.statement {
            let lines = lang.of(text).lines();
            blocks.extend(lines.map(|l| DocumentBlock::Paragraph(Phrase::new(l))));
        }
        let list = |members| DocumentBlock::List { numbered: false, members };
        blocks.extend([
            table(),
            heading(2, each!("Given")),
            list(sheet.problem.terms.iter().filter_map(|t| given(sheet, t)).collect()),
            heading(2, each!("Wanted")),
            list(wanted(sheet)),
        ]);
    }
    if options.sides != WorksheetSides::Problem {
        blocks.push(heading(1, each!("Solution")));
        let told = count(&sheet.problem.terms).sentence();
        blocks.push(DocumentBlock::Paragraph(Phrase::of_words(lang.of(&told))));
        if options.sides == WorksheetSides::Solution {
            blocks.push(table());
        }
        blocks.push(heading(2, each!("Drawing")));
        let figure = Box::new(sheet.figure(false));
        blocks.push(DocumentBlock::Figure { name: "equation", figure });
        let members = sheet.drawn.steps.iter().map(|s| Phrase::new(lang.of(s))).collect();
        blocks.push(DocumentBlock::List { numbered: true, members });
        blocks.extend([
            heading(2, each!("Answers")),
            DocumentBlock::Table(answers(sheet, options.sheet.digits)),
        ]);
    }
    Document {
        title: one_line(lang.of(&sheet.problem.title)),
        lang,
        fonts: options.sheet.style.fonts.clone(),
        blocks,
    }
}

/// Returns the table of an equation: symbols, and the rows of magnitudes and directions.
pub(super) fn equation_table(
    columns: Vec<EquationColumn>,
    lang: Lang,
    notation: &Notation,
) -> DocumentTable {
    let [mut symbols, mut magnitudes, mut directions] =
        ["", words(lang).magnitude, words(lang).direction].map(|head| vec![Phrase::new(head)]);
    for c in columns {
        let cell = |text: &str| {
            Phrase::new(&if text.is_empty() { String::new() } else { format!("${text}$") })
        };
        if !c.joint.is_empty() {
            symbols.push(cell(c.joint));
            magnitudes.push(cell(""));
            directions.push(cell(""));
        }
        symbols.push(cell(&c.symbol));
        magnitudes.push(cell(&c.magnitude));
        directions.push(cell(&c.direction));
    }
    let [second, third] = if notation.first_row == "direction" {
        [directions, magnitudes]
    } else {
        [magnitudes, directions]
    };
    DocumentTable { kind: TableKind::Equation, rows: vec![symbols, second, third] }
}

/// The known data of a vector, in a line.
fn given(sheet: &EquationSheet, term: &VectorTerm) -> Option<Phrase> {
    let lang = sheet.lang;
    let size = term.magnitude.as_ref().map(|law| {
        let value = law.at(0.0).map_or(0.0, |v| v.si().0[0]);
        let (book, kind) = (&sheet.problem.book, sheet.problem.on.kind());
        book.text(kind, &minus(&shortest(book.value(kind, value))))
    });
    let direction = term.direction.as_ref().map(|d| {
        let angle = d.angle.at(0.0_f64).map_or(0.0, |v| v.si().0[0].to_degrees());
        let angle = minus(&significant(angle, 6).parse().map_or_else(|_| String::new(), shortest));
        match &d.line {
            None => format!("∠ {angle}°"),
            Some(line) => {
                let (open, close) = (tr!(lang, " ("), tr!(lang, ")"));
                let sign = if d.across { "⊥" } else { "∥" };
                format!("{sign} {line}{open}{line} ∠ {angle}°{close}")
            }
        }
    });
    let told: Vec<String> = size.into_iter().chain(direction).collect();
    let apart = tr!(lang, "clause" => ", ");
    (!told.is_empty()).then(|| Phrase::new(&format!("${}$: {}", term.symbol(0), told.join(apart))))
}

/// The unknowns, one line each.
fn wanted(sheet: &EquationSheet) -> Vec<Phrase> {
    let [sizes, directions] = unknowns(&sheet.problem.terms);
    let symbol = |k: &usize| sheet.problem.terms[*k].symbol(0);
    let size = sizes.iter().map(|k| say!(sheet.lang, "magnitude of ${}$", symbol(k)));
    let direction = directions.iter().map(|k| say!(sheet.lang, "direction of ${}$", symbol(k)));
    size.chain(direction).map(|text: String| Phrase::new(&text)).collect()
}

fn answers(sheet: &EquationSheet, digits: usize) -> DocumentTable {
    let lang = sheet.lang;
    let head = [tr!(lang, "quantity"), tr!(lang, "drawing"), tr!(lang, "closed form")];
    let mut rows = vec![head.iter().map(|h| Phrase::of_words(h)).collect::<Vec<_>>()];
    let (book, kind) = (&sheet.problem.book, sheet.problem.on.kind());
    for (k, root) in sheet.solved.roots.iter().enumerate() {
        for v in &root.vectors {
            let read = sheet.drawn.read(v.term, k).map_or_else(
                || "—".to_owned(),
                |r| book.text(kind, &significant(book.value(kind, r.norm()), 4)),
            );
            let cells = [
                format!("${}$", sheet.problem.terms[v.term].symbol(primes(sheet.solved, k))),
                read,
                value(sheet.problem, sheet.solved, v, digits),
            ];
            rows.push(cells.iter().map(|c| Phrase::new(c)).collect());
        }
    }
    DocumentTable { kind: TableKind::Values, rows }
}
