//! A worksheet as Markdown: formulas in TeX between dollar signs, tables with pipes, drawings as
//! SVG files in the same folder (programs that show Markdown seldom show embedded drawings).

use super::{
    CompanionFile, Document, DocumentBlock, DocumentTable, backslashed, guarded, one_line,
    picture_names,
};
use crate::diag::Faults;
use crate::paper::label::Label;
use crate::paper::phrase::{Phrase, PhrasePiece};
use crate::render::math::{tex, tex_display};
use crate::render::svg;

/// Writes the document; the names of its drawings begin with `stem`.
///
/// # Errors
/// The errors of [`svg::write`] for a drawing.
pub fn markdown(document: &Document, stem: &str) -> Result<(String, Vec<CompanionFile>), Faults> {
    let mut out = format!("# {}\n", escaped(&document.title));
    let pictures = picture_names(document, stem);
    let mut files = Vec::new();
    let mut next = pictures.iter();
    for block in &document.blocks {
        out.push('\n');
        match block {
            DocumentBlock::Heading(level, text) => {
                out += &format!("{} {}\n", "#".repeat(usize::from(*level) + 1), escaped(text))
            }
            DocumentBlock::Paragraph(p) => out += &format!("{}\n", guarded(inline(p))),
            DocumentBlock::List { numbered, members } => {
                for (k, m) in members.iter().enumerate() {
                    let mark = if *numbered { format!("{}.", k + 1) } else { "-".into() };
                    out += &format!("{mark} {}\n", inline(m));
                }
            }
            DocumentBlock::Table(table) => out += &rows(table),
            DocumentBlock::Formula(parts) => out += &format!("$${}$$\n", tex_display(parts)),
            DocumentBlock::Figure { .. } => {
                let (name, figure) = next.next().expect("every figure has its name");
                out += &format!("![{}](<{}>)\n", escaped(&one_line(&figure.title)), target(name));
                files.push(CompanionFile { name: name.clone(), text: svg::write(figure)?.value });
            }
        }
    }
    Ok((out, files))
}

fn rows(table: &DocumentTable) -> String {
    let mut out = String::new();
    for (r, row) in table.rows.iter().enumerate() {
        let cells: Vec<String> = row.iter().map(|c| inline(c).replace('|', "\\|")).collect();
        out += &format!("| {} |\n", cells.join(" | "));
        if r == 0 {
            out += &format!("|{}\n", " :---: |".repeat(row.len()));
        }
    }
    out
}

fn inline(phrase: &Phrase) -> String {
    let piece = |p: &PhrasePiece| match p {
        PhrasePiece::Words(w) => escaped(w),
        PhrasePiece::Formula(f) => format!("${}$", tex(&Label::math(f.as_str()))),
    };
    phrase.pieces().iter().map(piece).collect()
}

/// Escapes words so that Markdown takes them literally: emphasis, code, entities (`&copy;`),
/// strikethrough and fences (`~~~`), formulas, links. Two hyphens would become a dash in some
/// programs.
fn escaped(text: &str) -> String {
    let sign = |c| {
        matches!(c, '\\' | '`' | '*' | '_' | '<' | '>' | '[' | ']' | '$' | '#' | '&' | '~' | '^')
    };
    backslashed(text, |before, c, _| sign(c) || c == '-' && before == Some('-'))
}

/// A file's name as the target of a link. Characters other than letters, digits and `-._~/` are
/// percent-encoded, because spaces, brackets and backslashes have a meaning there.
fn target(name: &str) -> String {
    let mut out = String::new();
    for c in name.chars() {
        if c.is_ascii() && !c.is_ascii_alphanumeric() && !"-._~/".contains(c) {
            out += &format!("%{:02X}", u32::from(c));
        } else {
            out.push(c);
        }
    }
    out
}
