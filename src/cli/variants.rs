//! `hodograph variants`: a problem with other numbers for each student, with keys.

use super::draw::style_of;
use super::together::Together;
use super::values::Platform;
use super::{CommandResult, Failure, SceneInput, args, files, look_of, places};
use crate::diag::{Diagnostic, Warned, both};
use crate::homework::platforms::{self, PlatformSet, QtiVersion};
use crate::homework::{self, HomeworkRequest, keys, sheets};
use crate::scene::{self, PageFormat};
use crate::worksheet::WorksheetSides;
use crate::zip::ArchiveFile;
use std::path::Path;
use std::process::ExitCode;

/// The number of variants without a roster.
const USUAL: usize = 30;

/// Runs the command.
pub fn run(a: args::VariantsArgs) -> CommandResult {
    let style = style_of(&a.look)?;
    let mut input = SceneInput::read(&a.common)?.drawn_in(&style);
    let folder = both!("name a folder: -o set/", "请指定文件夹：-o set/");
    places::one_result(&a.output, 4, folder)?;
    let students = match &a.roster {
        Some(path) => roster(path)?,
        None => Vec::new(),
    };
    let usual = match (students.len(), a.vary.is_empty()) {
        (0, true) => 1,
        (0, false) => USUAL,
        (n, _) => n,
    };
    let count = a.count.map_or(usual, usize::from);
    if count < students.len() || count > homework::MOST_VARIANTS {
        let message = both!(
            "{count} variants for {} names; there can be {} variants",
            "{count} 道题对 {} 个姓名；最多 {} 道",
            students.len(),
            homework::MOST_VARIANTS
        );
        let d = Diagnostic::error("roster", message);
        return Err(Failure::argument("--count", &count.to_string(), d));
    }
    let request = HomeworkRequest { vary: &a.vary, count, seed: a.seed, students: &students };
    let Warned { value: all, notes } = homework::variants(&input.file.source, &request)
        .map_err(|fault| input.out_of_range(fault))?;
    input.file.notes.extend(notes);
    let look = look_of(&a.common, style, a.digits);
    // All bytes are made before the first file is begun: until then a signal ends the run at once.
    let mut made = Vec::new();
    for (path, sides) in
        [("problems.pdf", WorksheetSides::Problem), ("solutions.pdf", WorksheetSides::Solution)]
    {
        let Warned { value, notes } =
            sheets::pdf(&all, sides, &look).map_err(|f| input.failed(f))?;
        input.file.notes.extend(notes);
        made.extend(one(path, value));
    }
    if a.frame {
        let page = whole_page(&a.page)?;
        let Warned { value: [frames, overlays], notes } =
            sheets::frames(&all, &look, &page).map_err(|f| input.failed(f))?;
        input.file.notes.extend(notes);
        made.extend(one("frames.pdf", frames));
        made.extend(one("overlays.pdf", overlays));
    }
    let platforms = places::once(&a.to);
    if !platforms.is_empty() {
        let set = platforms::questions(&all, &look).map_err(|f| input.failed(f))?;
        for platform in platforms {
            made.extend(exported(platform, &set)?);
        }
    }
    made.extend(one("answers.csv", keys::csv(&all).into_bytes()));
    made.extend(one("values.csv", keys::values_csv(&all).into_bytes()));
    let (mut together, mut written) = (Together::default(), String::new());
    for ArchiveFile { path, bytes } in made {
        let path = Path::new(&a.output).join(path);
        together.add(&path, &bytes)?;
        written += &format!("{}\n", path.display());
    }
    together.appear()?;
    files::print_names(&written)?;
    input.file.say_notes();
    Ok(ExitCode::SUCCESS)
}

/// Reads the page of a sheet to draw on.
///
/// # Errors
/// `paper` if it is no format of a sheet of paper or of a slide.
pub(super) fn whole_page(text: &str) -> Result<PageFormat, Failure> {
    let page = scene::page(text).map_err(|faults| Failure::argument("--page", text, faults))?;
    if page.whole {
        return Ok(page);
    }
    let message = both!("{text} is not a sheet of paper", "{text} 不是图纸幅面");
    let d = Diagnostic::error("paper", message)
        .help(both!("write --page a4 or --page a3", "请写 --page a4 或 --page a3"));
    Err(Failure::argument("--page", text, d))
}

fn one(path: &str, bytes: Vec<u8>) -> Vec<ArchiveFile> {
    vec![ArchiveFile { path: path.to_owned(), bytes }]
}

/// Returns the files of a platform.
fn exported(platform: Platform, set: &PlatformSet) -> Result<Vec<ArchiveFile>, Failure> {
    Ok(match platform {
        Platform::Moodle => {
            let text =
                platforms::moodle(set).map_err(|d| Failure::argument("--to", "moodle", d))?;
            one("moodle.xml", text.into_bytes())
        }
        Platform::Qti3 => one("qti3.zip", platforms::qti(set, QtiVersion::Three)),
        Platform::Qti2 => one("qti2.zip", platforms::qti(set, QtiVersion::Two)),
        Platform::Canvas => one("canvas.zip", platforms::canvas(set)),
        Platform::Prairielearn => platforms::prairielearn(set),
    })
}

fn roster(path: &str) -> Result<Vec<String>, Failure> {
    let (name, text) = table(path)?;
    homework::names(&text).map_err(|f| Failure::input(f, &name, &text))
}

/// Reads a table of a teacher; returns the name to show and the text.
pub(super) fn table(path: &str) -> Result<(String, String), Failure> {
    let (name, bytes) = files::table(path).map_err(|d| Failure::input(d, path, ""))?;
    match String::from_utf8(bytes) {
        Ok(text) => Ok((name, text)),
        Err(_) => {
            let message = both!("{name} is not UTF-8 text", "{name} 不是 UTF-8 文本");
            let d = Diagnostic::error("table", message)
                .help(both!("save the table as \"CSV UTF-8\"", "请将表格另存为“CSV UTF-8”"));
            Err(Failure::input(d, path, ""))
        }
    }
}
