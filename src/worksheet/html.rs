//! A worksheet as one HTML file: formulas in MathML, drawings as SVG inside it, a style for screen
//! and print. The file fetches nothing and is also well-formed XML.

use super::{Document, DocumentBlock, DocumentTable, TableKind};
use crate::diag::Faults;
use crate::paper::item::{Figure, FigureItem};
use crate::paper::words::words;
use crate::render::math::mathml_display;
use crate::render::{escaped, number::mm, svg};
use crate::report::html::sentence;
use crate::webfont;

/// The style: a page of text on the screen, A4 in print, where drawings keep their millimetres so
/// that their scales stay true. Letters of quantities use the italic of the text: in many
/// mathematical fonts an italic v looks like υ.
const STYLE: &str = "
@page { size: A4; margin: 20mm }
body { font: 12pt/1.5 Hodograph, 'Tinos', 'Times New Roman', 'Liberation Serif', 'Noto Serif CJK SC', 'SimSun', serif; max-width: 174mm;
  margin: 2em auto; padding: 0 1em; color: #000; background: #fff }
h1 { font-size: 1.5em } h2 { font-size: 1.25em } h3 { font-size: 1.05em } h4 { font-size: 1em }
h1, h2, h3, h4 { font-weight: 600; line-height: 1.25; break-after: avoid; margin: 1.2em 0 .4em }
li { margin: .15em 0 }
figure { margin: 1em 0; text-align: center; overflow-x: auto; break-inside: avoid }
figure svg { max-width: 100%; height: auto }
.scroll { overflow-x: auto; overflow-y: hidden; padding: .2em 0 }
math { font-family: Hodograph, 'STIX Two Math', 'Cambria Math', 'Latin Modern Math', 'Times New Roman', serif }
mi { text-transform: none; font-style: italic; font-family: Hodograph, 'Tinos', 'Times New Roman', 'Liberation Serif', serif }
mi[mathvariant] { font-style: normal }
table { border-collapse: collapse; margin: .6em 0; break-inside: avoid }
td, th { padding: .15em .6em; text-align: left; font-weight: 400 }
.values { border-top: 1.5px solid; border-bottom: 1.5px solid }
.values th { border-bottom: 1px solid; font-style: italic }
.values td:last-child { min-width: 8em }
.equation td, .equation th { text-align: center }
@media print { body { margin: 0; padding: 0; max-width: none } .scroll, figure { overflow: visible } figure svg { max-width: none }
  .solution { break-before: page } }
";

/// Writes the document.
///
/// # Errors
/// The errors of [`svg::Elements::of`] for a drawing.
pub fn html(document: &Document) -> Result<String, Faults> {
    let title = escaped(&document.title);
    let lang = words(document.lang).tag;
    let mut out = format!(
        "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"{lang}\" xml:lang=\"{lang}\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>{title}</title>\n<style>{STYLE}{}</style>\n</head>\n\
         <body>\n",
        webfont::faces()
    );
    let begin = out.len();
    out += &format!("<h1>{title}</h1>\n");
    let mut drawn: Vec<svg::Elements> = Vec::new();
    let mut sides = 0;
    for block in &document.blocks {
        match block {
            DocumentBlock::Heading(level, text) => {
                sides += usize::from(*level == 1);
                // The title has the first level; the second side begins a new page.
                let class = if *level == 1 && sides > 1 { " class=\"solution\"" } else { "" };
                let h = level + 1;
                out += &format!("<h{h}{class}>{}</h{h}>\n", escaped(text));
            }
            DocumentBlock::Paragraph(p) => out += &format!("<p>{}</p>\n", sentence(p)),
            DocumentBlock::List { numbered, members } => {
                let tag = if *numbered { "ol" } else { "ul" };
                out += &format!("<{tag}>\n");
                for m in members {
                    out += &format!("<li>{}</li>\n", sentence(m));
                }
                out += &format!("</{tag}>\n");
            }
            DocumentBlock::Table(table) => out += &rows(table),
            DocumentBlock::Formula(parts) => {
                out += &format!("<div class=\"scroll\">{}</div>\n", mathml_display(parts))
            }
            DocumentBlock::Figure { figure, .. } => {
                out += &format!("<figure>\n{}</figure>\n", drawing(figure, &mut drawn)?)
            }
        }
    }
    // The letters of all drawings, each once: ids must be unique in a page.
    if !drawn.is_empty() {
        let letters = svg::Elements::letters(&drawn);
        out.insert_str(
            begin,
            &format!("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"0\" height=\"0\" style=\"position:absolute\" aria-hidden=\"true\">{letters}</svg>\n"),
        );
    }
    out += "</body>\n</html>\n";
    Ok(out)
}

/// A drawing inside the page. Its parts have no ids, because several drawings must not share them.
fn drawing(figure: &Figure, drawn: &mut Vec<svg::Elements>) -> Result<String, Faults> {
    let nameless =
        |item: &FigureItem| FigureItem { id: String::new(), class: String::new(), ..item.clone() };
    let items: Vec<FigureItem> = figure.items.iter().map(nameless).collect();
    let (w, h) = (mm(figure.width_mm), mm(figure.height_mm));
    let (title, desc) = (escaped(&figure.title), escaped(&figure.desc));
    let mut elements = svg::Elements::new(figure.height_mm);
    let markup = elements.of(&items)?.join("\n");
    drawn.push(elements);
    Ok(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"{w}mm\" height=\"{h}mm\" viewBox=\"0 0 {w} {h}\" role=\"img\">\n\
         <title>{title}</title>\n<desc>{desc}</desc>\n{markup}\n</svg>\n"
    ))
}

fn rows(table: &DocumentTable) -> String {
    let class = match table.kind {
        TableKind::Equation => "equation",
        TableKind::Values => "values",
    };
    let mut out = format!("<div class=\"scroll\"><table class=\"{class}\">\n");
    for (r, row) in table.rows.iter().enumerate() {
        out += "<tr>";
        for (c, cell) in row.iter().enumerate() {
            let tag = if r == 0 && table.kind == TableKind::Values
                || c == 0 && table.kind == TableKind::Equation
            {
                "th"
            } else {
                "td"
            };
            out += &format!("<{tag}>{}</{tag}>", sentence(cell));
        }
        out += "</tr>\n";
    }
    out + "</table></div>\n"
}
