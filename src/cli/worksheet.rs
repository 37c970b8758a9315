//! `hodograph worksheet`: the problem and its solution as a document.

use super::{Failure, Input, Run, args, choices, files, verdict};
use crate::diag::{Diagnostic, Faults};
use crate::figure::sheet;
use crate::render::pdf;
use crate::worked::Scope;
use crate::worksheet::{Beside, Document, Options, Sides, html, markdown, pages, typst, worksheet};
use std::path::Path;

/// Runs the command.
pub fn run(a: args::Worksheet) -> Run {
    let write = writer(&a.output).map_err(|f| Failure::Input(f, a.output.clone(), String::new()))?;
    let mut input = Input::read(&a.common.scene)?;
    let worked = input.work(Scope::Figure)?;
    let (lang, notation) = choices(&input.scene, &a.common);
    let sides = match (a.problem_only, a.solution) {
        (true, _) => Sides::Problem,
        (_, true) => Sides::Solution,
        _ => Sides::Both,
    };
    let options = Options { sheet: sheet::Options { notation, digits: a.digits, ..sheet::Options::of_language(lang) }, sides };
    let document = worksheet(&input.scene, &worked, &options);
    let out = Path::new(&a.output);
    let stem = out.file_stem().and_then(|s| s.to_str()).unwrap_or("worksheet");
    let (bytes, beside) = write(&document, stem).map_err(|f| Failure::Input(f, input.name.clone(), input.source.clone()))?;
    // The drawings first: where the document is, they are too.
    for picture in beside {
        let path = out.with_file_name(&picture.name);
        files::write(&path, picture.text.as_bytes())?;
        files::print(&format!("{}\n", path.display()))?;
    }
    files::write(out, &bytes)?;
    files::print(&format!("{}\n", a.output))?;
    input.say_notes();
    Ok(verdict(&worked))
}

type Written = Result<(Vec<u8>, Vec<Beside>), Faults>;

/// What writes files that end so.
fn writer(output: &str) -> Result<fn(&Document, &str) -> Written, Faults> {
    match files::ending(output) {
        Some("pdf") => Ok(|d, _| {
            let lang = crate::figure::words::words(d.lang).tag;
            Ok((pdf::document(&pages::pages(d), &d.title, lang)?.value, Vec::new()))
        }),
        Some("html") => Ok(|d, _| Ok((html::html(d)?.into_bytes(), Vec::new()))),
        Some("md") => Ok(|d, stem| markdown::markdown(d, stem).map(|(text, beside)| (text.into_bytes(), beside))),
        Some("typ") => Ok(|d, stem| typst::typst(d, stem).map(|(text, beside)| (text.into_bytes(), beside))),
        _ => Err(Diagnostic::error("output", format!("{output} ends in none of .pdf, .html, .md, .typ"))
            .help("name the file after its format, such as -o sheet.pdf")
            .into()),
    }
}
