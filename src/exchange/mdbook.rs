//! A preprocessor of mdBook: fenced scenes become drawings.
//!
//! ````text
//! ```hodograph figure=velocity lang=zh
//! {"title": ..., "links": ...}
//! ```
//! ````
//! In place of the scene, the block may hold the name of a template, or of a file beside the chapter
//! ending in .json. Words after `hodograph` are `figure`, `lang`, `style`, `steps`.
//!
//! # Source
//! The mdBook documentation, *Preprocessors*: an array of context and book on standard input, the
//! book on standard output.

use crate::diag::{Diagnostic, Faults, both};
use crate::figure::list;
use crate::paper::style::Style;
use crate::problem::{self, Look, Options, Pictures, templates};
use crate::render::svg::{self, IdPrefix};
use crate::scene::Lang;
use serde_json::Value as Json;

/// The first word of a block.
const NAME: &str = "hodograph";

/// Reads a file beside a chapter: the path of the chapter, and the name of the file.
pub type ChapterFiles<'a> = dyn FnMut(&str, &str) -> Result<String, Diagnostic> + 'a;

/// Returns the book with drawings in place of scenes; the input is an array of context and book.
///
/// # Errors
/// `import` if the input is not such an array; the faults of each scene.
pub fn book(input: &str, files: &mut ChapterFiles) -> Result<String, Faults> {
    let wrong = |why: String| {
        let message = both!("not a book of mdBook: {why}");
        let help = both!(
            "mdBook calls the preprocessor: [preprocessor.hodograph] command = \"hodograph mdbook\""
        );
        Faults::from(Diagnostic::error("import", message).help(help))
    };
    let mut pair: Json = serde_json::from_str(input).map_err(|e| wrong(e.to_string()))?;
    let Some(book) = pair.get_mut(1).filter(|book| book.is_object()) else {
        return Err(wrong("[context, book]".to_owned()));
    };
    let (mut faults, mut count) = (Faults::default(), 0);
    chapters(book, &mut |path, content| match chapter(path, content, files, &mut count) {
        Ok(drawn) => *content = drawn,
        Err(more) => faults.list.extend(more.list),
    });
    if faults.has_errors() { Err(faults) } else { Ok(book.to_string()) }
}

/// Visits every chapter: its path and its text.
fn chapters(of: &mut Json, visit: &mut dyn FnMut(&str, &mut String)) {
    match of {
        Json::Array(all) => all.iter_mut().for_each(|one| chapters(one, visit)),
        Json::Object(all) => {
            if let Some(chapter) = all.get_mut("Chapter") {
                let path = chapter["path"].as_str().unwrap_or_default().to_owned();
                if let Some(Json::String(content)) = chapter.get_mut("content") {
                    visit(&path, content);
                }
            }
            all.values_mut().for_each(|one| chapters(one, visit));
        }
        Json::Null | Json::Bool(_) | Json::Number(_) | Json::String(_) => {}
    }
}

/// Returns the text of a chapter with its blocks drawn.
fn chapter(
    path: &str,
    content: &str,
    files: &mut ChapterFiles,
    count: &mut usize,
) -> Result<String, Faults> {
    let (mut out, mut faults) = (String::new(), Faults::default());
    let mut lines = content.lines();
    while let Some(line) = lines.next() {
        let fence: String = line.chars().take_while(|c| *c == '`').collect();
        if fence.len() < 3 {
            out += line;
            out.push('\n');
            continue;
        }
        let mut block = Vec::new();
        let mut end = None;
        for inner in lines.by_ref() {
            if inner.trim_end() == fence {
                end = Some(inner);
                break;
            }
            block.push(inner);
        }
        let mut words = line[fence.len()..].split_whitespace();
        if words.next() != Some(NAME) {
            out += &std::iter::once(line)
                .chain(block)
                .chain(end)
                .fold(String::new(), |text, line| text + line + "\n");
            continue;
        }
        let words: Vec<&str> = words.collect();
        match drawn(path, &words, block.join("\n").trim(), files, count) {
            Ok(markup) => out += &markup,
            Err(more) => faults.list.extend(more.list),
        }
    }
    if faults.has_errors() { Err(faults) } else { Ok(out) }
}

/// Returns the drawings of a block as HTML.
fn drawn(
    path: &str,
    words: &[&str],
    body: &str,
    files: &mut ChapterFiles,
    count: &mut usize,
) -> Result<String, Faults> {
    let text = if body.starts_with('{') {
        body.to_owned()
    } else if body.ends_with(".json") {
        files(path, body)?
    } else {
        templates::text(body, &[])?
    };
    let (mut figures, mut look, mut steps) = (Vec::new(), Look::default(), false);
    for word in words {
        let known = match word.split_once('=') {
            Some(("figure", name)) => list::named(name).map(|entry| figures.push(entry)),
            Some(("lang", name)) => Lang::named(name).map(|lang| look.lang = Some(lang)),
            Some(("style", name)) => Style::named(name).map(|style| look.style = style),
            _ if *word == "steps" => {
                steps = true;
                Some(())
            }
            Some(_) | None => None,
        };
        if known.is_none() {
            let message = both!("`{word}` is not known in {path}");
            let help = both!("write figure=NAME, lang=zh, style=slides or steps");
            return Err(Diagnostic::error("import", message).help(help).into());
        }
    }
    if figures.is_empty() {
        figures.push(list::USUAL);
    }
    let solved = problem::solve(&problem::read(text)?.value, &Options::with_figures())?;
    let pictures = Pictures { figures: &figures, steps, ..Pictures::default() };
    let mut out = String::new();
    for (_, figure) in solved.figures(&pictures, &look)?.value {
        *count += 1;
        let prefix = IdPrefix::new(&format!("hg{count}-"))?;
        let alone = svg::write(&figure)?.value;
        let markup = prefix.put_before(&alone);
        // A blank line would end the block of HTML.
        let lines = markup.lines().filter(|l| !l.trim().is_empty() && !l.starts_with("<?xml"));
        out += "\n<div class=\"hodograph\">\n";
        lines.for_each(|line| {
            out += line;
            out.push('\n');
        });
        out += "</div>\n\n";
    }
    Ok(out)
}
