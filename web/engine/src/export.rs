//! Documents of an opened file: worksheets, lesson, text, tables, files of other programs.

use crate::file::{OpenFile, wanted};
use crate::words::{diagnostics, failed, look};
use base64::{Engine as _, prelude::BASE64_STANDARD};
use hodograph::diag::{Diagnostic, Faults, Warned, both};
use hodograph::exchange::{self, ExportFormat};
use hodograph::figure::list;
use hodograph::figure::stepped::ConstructionMethod;
use hodograph::paper::item::Figure;
use hodograph::paper::words::words;
use hodograph::problem::cams::{self, SurveyedCam};
use hodograph::problem::turn::{MOST_TABLE_STEPS, turn_table};
use hodograph::problem::{self, Kind, Lesson, Look, Options, Pictures, whole, whole_page};
use hodograph::render::pages::Page;
use hodograph::report::table::{Csv, RowFormat, TableHead, TablePiece};
use hodograph::scene::Swept;
use hodograph::worksheet::pages;
use hodograph::worksheet::{
    CompanionFile, Document, WorksheetSides, WorksheetTask, html, markdown, typst,
};
use serde_json::{Value as Json, json};

impl OpenFile {
    /// Answers `export`: the files of a `form`, the first of which is the document; their names
    /// begin with `stem`.
    pub fn export(&self, message: &Json) -> Json {
        let stem = message["stem"].as_str().unwrap_or("scene");
        if message["form"] == "pdf" {
            return match self.pages(message) {
                Ok(all) => {
                    let one = |(word, of): (&str, PdfPages)| {
                        // Writing to memory does not fail.
                        let bytes = postcard::to_allocvec(&of).unwrap_or_default();
                        let pages = BASE64_STANDARD.encode(bytes);
                        json!({"name": format!("{stem}{word}.pdf"), "pages": pages})
                    };
                    json!({"ok": true, "files": all.into_iter().map(one).collect::<Vec<_>>()})
                }
                Err(faults) => failed(&faults, &self.text),
            };
        }
        if let Some(format) = message["form"].as_str().and_then(ExportFormat::named) {
            let ending = format.endings().first().copied().unwrap_or_default();
            let figure =
                message["figure"].as_str().and_then(list::named).unwrap_or(list::MECHANISM);
            // In digits like a text, not like a sheet.
            let look = Look { digits: Look::default().digits, ..look(message) };
            return match exchange::export(&self.solved, format, figure, &look) {
                Ok(made) => {
                    let file = bytes_of(format!("{stem}.{ending}"), &made.value);
                    json!({"ok": true, "files": [file], "notes": diagnostics(&made.notes, &self.text)})
                }
                Err(fault) => failed(&fault.into(), &self.text),
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

    /// Returns the PDF files with the words for their names: the sheet to draw on (`frame`) and its
    /// overlay; the figures `what` at a `travel` of the driver; else the worksheet.
    fn pages(&self, message: &Json) -> Result<Vec<(&'static str, PdfPages)>, Faults> {
        let look = look(message);
        if message["frame"] == true {
            let page = whole_page(message["page"].as_str().unwrap_or("a4"));
            let page = page.map_err(|wrong| wrong.faults)?;
            let all = self.solved.frame(&page, &look)?.into_iter();
            let (blanks, overlays): (Vec<_>, Vec<_>) =
                all.map(|page| (page.blank, page.overlay)).unzip();
            return Ok(vec![("", of_figures(&blanks)), ("-overlay", of_figures(&overlays))]);
        }
        if message["what"].is_null() {
            let sheet = self.sheet(message, &look)?;
            let tag = words(sheet.lang).tag.to_owned();
            return Ok(vec![("", (pages::pages(&sheet), sheet.title, tag))]);
        }
        let name = message["what"][0].as_str().unwrap_or_default();
        let figures: Vec<Figure> = match self.of_motion(name, message, true) {
            Some(pages) => pages?.value,
            None => {
                let pictures = Pictures { figures: &wanted(message), ..Pictures::default() };
                match message["travel"].as_f64() {
                    Some(travel) => self.at(travel, None)?.figures(&pictures, &look)?.value,
                    None => self.solved.figures(&pictures, &look)?.value,
                }
            }
        }
        .into_iter()
        .map(|(_, figure)| figure)
        .collect();
        Ok(vec![("", of_figures(&figures))])
    }

    /// Returns the worksheet, with the results over the motion in `table` steps.
    fn sheet(&self, message: &Json, look: &Look) -> Result<Document, Faults> {
        let mut sheet = self.solved.worksheet(sides(message), task(message), look)?;
        if let Some(steps) = message["table"].as_u64().and_then(|n| usize::try_from(n).ok()) {
            sheet.blocks.extend(
                turn_table(
                    self.text.as_bytes(),
                    steps.clamp(1, usize::from(MOST_TABLE_STEPS)),
                    look,
                )?
                .value,
            );
        }
        Ok(sheet)
    }

    fn document(&self, message: &Json, stem: &str) -> Result<Warned<Vec<CompanionFile>>, Faults> {
        let look = look(message);
        let answers = Look { digits: Look::default().digits, ..look.clone() };
        let one = |ending: &str, text: String| {
            let name = format!("{stem}.{ending}");
            Warned { value: vec![CompanionFile { name, text }], notes: Vec::new() }
        };
        let sheet = || self.sheet(message, &look);
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
                let method = message["method"].as_str().and_then(ConstructionMethod::named);
                let page = solved.lesson(&Lesson { swept, method, ..Lesson::default() }, &look)?;
                let notes = page.notes;
                Warned { notes, ..one("html", page.value) }
            }
            "csv" => {
                let Some(scene) = self.scene() else {
                    return Err(no_form("csv", self.kind()).into());
                };
                let Warned { value: table, notes } = whole::table(scene)?;
                let lang = look.lang.unwrap_or_default();
                let title = lang.of(&scene.title);
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
            form @ ("cam-dxf" | "cam-csv") => {
                let Some(scene) = self.scene() else {
                    return Err(no_form(form, self.kind()).into());
                };
                let cams = cams::survey(scene, None, None)?;
                let file = |(k, cam): (usize, &SurveyedCam)| {
                    let number = if cams.len() > 1 { format!("-{}", k + 1) } else { String::new() };
                    let (ending, text) = match form {
                        "cam-dxf" => ("dxf", cam.profile_dxf(cams::STEPS as usize)),
                        _ => (
                            "csv",
                            String::from_utf8_lossy(&cam.profile_csv(cams::STEPS as usize))
                                .into_owned(),
                        ),
                    };
                    CompanionFile { name: format!("{stem}-profile{number}.{ending}"), text }
                };
                Warned { value: cams.iter().enumerate().map(file).collect(), notes: Vec::new() }
            }
            form => return Err(no_form(form, self.kind()).into()),
        })
    }
}

/// Pages of a PDF, its title and language tag.
type PdfPages = (Vec<Page>, String, String);

fn of_figures(figures: &[Figure]) -> PdfPages {
    let first = figures.first().map(|f| (f.title.clone(), f.lang.clone()));
    let (title, tag) = first.unwrap_or_default();
    (figures.iter().map(Page::of).collect(), title, tag)
}

/// Returns a file as `text`, or as `base64` if it is no text.
fn bytes_of(name: String, bytes: &[u8]) -> Json {
    match std::str::from_utf8(bytes) {
        Ok(text) => json!({"name": name, "text": text}),
        Err(_) => json!({"name": name, "base64": BASE64_STANDARD.encode(bytes)}),
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
        None if message["questions"] == true => WorksheetTask::Questions,
        None => WorksheetTask::Polygons,
    }
}

fn no_form(form: &str, kind: Kind) -> Diagnostic {
    let word = kind.word();
    Diagnostic::error("format", both!("no `{form}` of a {word}"))
}
