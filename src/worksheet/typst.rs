//! A worksheet as Typst source: native formulas and tables, drawings as SVG files in the same
//! folder.

use super::{
    CompanionFile, Document, DocumentBlock, DocumentTable, TableKind, backslashed, guarded,
    picture_names,
};
use crate::diag::Faults;
use crate::paper::label::Label;
use crate::paper::phrase::{Phrase, PhrasePiece};
use crate::paper::words::words;
use crate::render::math::{typst as formula, typst_display};
use crate::render::{number::mm, svg};

/// Widest drawing on a page: A4 without its margins. A wider one would be cut; it is reduced to the
/// width of the page, and its scales are then not true.
const WIDEST_MM: f64 = 174.0;

/// Writes the document; the names of its drawings begin with `stem`.
///
/// # Errors
/// The errors of [`svg::write`] for a drawing.
pub fn typst(document: &Document, stem: &str) -> Result<(String, Vec<CompanionFile>), Faults> {
    let lang = words(document.lang).tag;
    let mut out = format!(
        "#set document(title: {})\n#set page(paper: \"a4\", margin: 18mm, numbering: \"1 / 1\")\n\
         #set text(lang: \"{lang}\", size: 11pt, font: (\"Tinos\", \"Times New Roman\", \"Liberation Serif\", \"Noto Serif CJK SC\", \"SimSun\"))\n\
         #set par(justify: false)\n#show heading: set block(sticky: true)\n#show table: set block(breakable: false)\n\n#align(center, text(size: 16pt)[{}])\n",
        string(&document.title),
        guarded(escaped(&document.title))
    );
    let pictures = picture_names(document, stem);
    let mut files = Vec::new();
    let mut next = pictures.iter();
    let mut sides = 0;
    for block in &document.blocks {
        out.push('\n');
        match block {
            DocumentBlock::Heading(level, text) => {
                sides += usize::from(*level == 1);
                if *level == 1 && sides > 1 {
                    out += "#pagebreak()\n";
                }
                out += &format!("{} {}\n", "=".repeat(usize::from(*level)), escaped(text));
            }
            DocumentBlock::Paragraph(p) => out += &format!("{}\n", guarded(inline(p))),
            DocumentBlock::List { numbered, members } => {
                let mark = if *numbered { '+' } else { '-' };
                for m in members {
                    out += &format!("{mark} {}\n", inline(m));
                }
            }
            DocumentBlock::Table(table) => out += &rows(table),
            DocumentBlock::Formula(parts) => out += &format!("$ {} $\n", typst_display(parts)),
            DocumentBlock::Figure { .. } => {
                let (name, figure) = next.next().expect("every figure has its name");
                let (name_text, alt) = (string(name), string(&figure.desc));
                let width = mm(figure.width_mm.min(WIDEST_MM));
                out +=
                    &format!("#align(center, image({name_text}, width: {width}mm, alt: {alt}))\n");
                files.push(CompanionFile { name: name.clone(), text: svg::write(figure)?.value });
            }
        }
    }
    Ok((out, files))
}

fn rows(table: &DocumentTable) -> String {
    let columns = table.rows.first().map_or(0, Vec::len);
    let (align, line) = match table.kind {
        TableKind::Equation => ("center", String::new()),
        TableKind::Values => (
            "left",
            format!(
                "  table.hline(y: 0, stroke: 0.8pt),\n  table.hline(y: 1, stroke: 0.5pt),\n  table.hline(y: {}, stroke: 0.8pt),\n",
                table.rows.len()
            ),
        ),
    };
    let mut out = format!(
        "#table(columns: {columns}, stroke: none, inset: 4pt, align: {align} + horizon,\n{line}"
    );
    for row in &table.rows {
        let cells: Vec<String> = row.iter().map(|c| format!("[{}]", inline(c))).collect();
        out += &format!("  {},\n", cells.join(", "));
    }
    out + ")\n"
}

fn inline(phrase: &Phrase) -> String {
    let piece = |p: &PhrasePiece| match p {
        PhrasePiece::Words(w) => escaped(w),
        PhrasePiece::Formula(f) => format!("${}$", formula(&Label::math(f.as_str()))),
    };
    phrase.pieces().iter().map(piece).collect()
}

/// A string literal of Typst.
fn string(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '\\' | '"' => out.extend(['\\', c]),
            c if c.is_control() => out += &format!("\\u{{{:x}}}", u32::from(c)),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

/// Escapes words so that Typst takes them literally. Hyphens and full stops are escaped only in a
/// row, where they would become dashes, a hyphenation hint (`-?`), a minus sign (`-1`) or an
/// ellipsis.
fn escaped(text: &str) -> String {
    let sign = |c| {
        matches!(
            c,
            '\\' | '#'
                | '*'
                | '_'
                | '`'
                | '$'
                | '<'
                | '>'
                | '@'
                | '['
                | ']'
                | '~'
                | '='
                | '/'
                | '"'
                | '\''
        )
    };
    backslashed(text, |before, c, next| match c {
        '-' => {
            before == Some('-')
                || matches!(next, Some('-' | '?' | '0'..='9'))
                    && !before.is_some_and(char::is_alphanumeric)
        }
        '.' => next == Some('.') || before == Some('.'),
        c => sign(c),
    })
}
