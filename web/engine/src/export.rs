//! Documents of an opened file: worksheets, lesson, text, tables.

use crate::file::{CURVES, OpenFile, wanted};
use crate::words::{diagnostics, failed, look};
use base64::{Engine as _, prelude::BASE64_STANDARD};
use hodograph::diag::{Diagnostic, Faults, Warned, both};
use hodograph::paper::words::words;
use hodograph::problem::Pictures;
use hodograph::problem::{self, Kind, Lesson, Look, Options, whole};
use hodograph::render::pages::Page;
use hodograph::report::table::{Csv, RowFormat, TableHead, TablePiece};
use hodograph::scene::Swept;
use hodograph::worksheet::pages;
use hodograph::worksheet::{CompanionFile, WorksheetSides, WorksheetTask, html, markdown, typst};
use serde_json::{Value as Json, json};

impl OpenFile {
    /// Answers `export`: the files of a `form`, the first of which is the document; their names
    /// begin with `stem`.
    pub fn export(&self, message: &Json) -> Json {
        let stem = message["stem"].as_str().unwrap_or("scene");
        if message["form"] == "pdf" {
            return match self.pages(message) {
                Ok(of) => {
                    // Writing to memory does not fail.
                    let bytes = postcard::to_allocvec(&of).unwrap_or_default();
                    let pages = BASE64_STANDARD.encode(bytes);
                    json!({"ok": true, "files": [{"name": format!("{stem}.pdf"), "pages": pages}]})
                }
                Err(faults) => failed(&faults, &self.text),
            };
        }
        match self.document(message, stem) {
            Ok(Warned { value, notes }) => {
                let files = value.iter().map(|f| json!({"name": f.name, "text": f.text}));
                json!({"ok": true, "files": files.collect::<Vec<_>>(), "notes": diagnostics(&notes, &self.text)})
            }
            Err(faults) => failed(&faults, &self.text),
        }
    }

    /// Returns the pages of a PDF, its title and language tag: of the figures `what` at a `travel`
    /// of the driver, else of the worksheet.
    fn pages(&self, message: &Json) -> Result<(Vec<Page>, String, String), Faults> {
        let look = look(message);
        if message["what"].is_null() {
            let sheet = self.solved.worksheet(sides(message), task(message), &look)?;
            let tag = words(sheet.lang).tag.to_owned();
            return Ok((pages::pages(&sheet), sheet.title, tag));
        }
        let figures: Vec<_> = match message["what"][0].as_str() {
            Some(CURVES) => whole::curves(self.text.as_bytes(), &look, true)?.value,
            _ => {
                let pictures = Pictures { figures: &wanted(message), ..Pictures::default() };
                match message["travel"].as_f64() {
                    Some(travel) => self.at(travel, None)?.figures(&pictures, &look)?.value,
                    None => self.solved.figures(&pictures, &look)?.value,
                }
            }
        };
        let first = figures.first().map(|(_, f)| (f.title.clone(), f.lang.clone()));
        let (title, tag) = first.unwrap_or_default();
        Ok((figures.iter().map(|(_, f)| Page::of(f)).collect(), title, tag))
    }

    fn document(&self, message: &Json, stem: &str) -> Result<Warned<Vec<CompanionFile>>, Faults> {
        let look = look(message);
        let answers = Look { digits: Look::default().digits, ..look.clone() };
        let one = |ending: &str, text: String| {
            let name = format!("{stem}.{ending}");
            Warned { value: vec![CompanionFile { name, text }], notes: Vec::new() }
        };
        let sheet = || self.solved.worksheet(sides(message), task(message), &look);
        let beside = |ending: &str, (text, drawings): (String, Vec<CompanionFile>)| {
            let mut all = one(ending, text);
            all.value.extend(drawings);
            all
        };
        Ok(match message["form"].as_str().unwrap_or_default() {
            "html" => one("html", html::html(&sheet()?)?),
            "md" => beside("md", markdown::markdown(&sheet()?, stem)?),
            "typ" => beside("typ", typst::typst(&sheet()?, stem)?),
            "text" => one("txt", self.solved.text(&answers, true)),
            "json" => {
                let told = self.solved.json(&answers, false, &[]);
                one("json", format!("{told:#}\n"))
            }
            "lesson" => {
                let options = Options { whole_motion: true, ..Options::with_figures() };
                let solved = problem::solve(&self.problem, &options)?;
                let swept = self.swept.unwrap_or(Swept::Driver(0));
                let page = solved.lesson(&Lesson { swept, ..Lesson::default() }, &look)?;
                let notes = page.notes;
                Warned { notes, ..one("html", page.value) }
            }
            "csv" => {
                let Some(scene) = self.scene() else {
                    return Err(no_form("csv", self.kind()).into());
                };
                let Warned { value: table, notes } = whole::table(scene)?;
                let lang = look.lang.unwrap_or_default();
                let title = scene.title.get(lang);
                let format = Csv::new(TableHead::of(title, &table).in_language(lang));
                let columns: Vec<&[f64]> =
                    table.columns.iter().map(|c| c.values.as_slice()).collect();
                let rows = table.columns.first().map_or(0, |c| c.values.len());
                let mut out = format.begin(rows as u64, &table.notes);
                // Writing to memory does not fail.
                if let Ok(piece) = format.piece_in(&columns, TablePiece::default()) {
                    piece.parts.iter().for_each(|p| out.extend_from_slice(p));
                }
                let notes = notes.into_iter().chain(table.notes).collect();
                Warned { notes, ..one("csv", String::from_utf8_lossy(&out).into_owned()) }
            }
            form => return Err(no_form(form, self.kind()).into()),
        })
    }
}

fn sides(message: &Json) -> WorksheetSides {
    match message["sides"].as_str() {
        Some("problem") => WorksheetSides::Problem,
        Some("solution") => WorksheetSides::Solution,
        _ => WorksheetSides::Both,
    }
}

fn task(message: &Json) -> WorksheetTask<'_> {
    match message["mistake"].as_str() {
        Some(name) => WorksheetTask::Mistake(name),
        None if message["loops"] == true => WorksheetTask::Loops,
        None => WorksheetTask::Polygons,
    }
}

fn no_form(form: &str, kind: Kind) -> Diagnostic {
    let word = kind.word();
    Diagnostic::error("format", both!("no `{form}` of a {word}", "没有 `{form}` 格式（{word}）"))
}
