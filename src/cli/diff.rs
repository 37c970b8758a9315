//! `hodograph diff`: compares two figures, with the exit codes of diff(1).

use super::args::DiffArgs;
use super::{CommandResult, Failure, files, lang};
use crate::diag::{Diagnostic, both};
use crate::render::diff::{Difference, Options, Picture, Pixels, compare, picture};
use serde_json::{Value, json};
use std::path::Path;
use std::process::ExitCode;

/// The figures differ.
const DIFFERENT: u8 = 1;
/// No result: a file cannot be read or written.
const TROUBLE: u8 = 2;
/// Number of differences that are printed; the others are counted. `--json` lists them all.
const TOLD: usize = 60;

/// Runs the command.
pub fn run(a: DiffArgs) -> CommandResult {
    match compared(&a) {
        // In the other commands, code 1 means that a file could not be written; here it means a
        // difference.
        Err(failure @ Failure::Output(_)) => {
            failure.report();
            Ok(ExitCode::from(TROUBLE))
        }
        other => other,
    }
}

fn compared(a: &DiffArgs) -> CommandResult {
    if let Some(path) = a.output.as_deref().filter(|p| files::ending(p).as_deref() != Some("png")) {
        let d = Diagnostic::error("output", both!("{path} does not end in .png"));
        return Err(Failure::argument("-o", path, d.help(both!("write -o diff.png"))));
    }
    let (old, new) = (read(&a.old)?, read(&a.new)?);
    let usual = Options::default();
    let options = Options {
        tolerance_mm: a.tolerance.unwrap_or(usual.tolerance_mm),
        // A tolerance for items removes the default limit of changed pixels.
        pixels: a.pixels.or(usual.pixels.filter(|_| a.tolerance.is_none())),
        ..usual
    };
    let fault = |d: Diagnostic| Failure::input(d, &a.new, "");
    let found = compare(&old, &new, &options).map_err(fault)?;
    if let Some(path) = &a.output {
        files::write(Path::new(path), &picture(&old, &new, &options).map_err(fault)?)?;
    }
    let alike = found.is_empty();
    if a.json {
        files::print(&format!("{:#}\n", difference_json(&found)))?;
    } else if !alike {
        let lines = found.lines();
        let mut text: String =
            lines.iter().take(TOLD).map(|line| format!("{}\n", lang::of(line))).collect();
        if lines.len() > TOLD {
            let more = lines.len() - TOLD;
            text += &format!("{}\n", lang::of(&both!("and {more} more")));
        }
        files::print_names(&text)?;
    }
    Ok(if alike { ExitCode::SUCCESS } else { ExitCode::from(DIFFERENT) })
}

fn read(path: &str) -> Result<Picture, Failure> {
    files::picture(path).and_then(Picture::read).map_err(|d| Failure::input(d, path, ""))
}

/// The differences for programs: lengths in mm, values in SI.
fn difference_json(found: &Difference) -> Value {
    let Pixels { over, largest, bounds, sizes } = found.pixels;
    let vectors = found.vectors.iter().map(
        |v| json!({"id": v.id, "name": v.name, "tail_moved_mm": v.moved_mm[0], "tip_moved_mm": v.moved_mm[1], "mm": v.mm, "si": v.si}),
    );
    json!({
        "alike": found.is_empty(),
        "vectors": vectors.collect::<Vec<_>>(),
        "moved": found.moved.iter().map(|m| json!({"id": m.id, "mm": m.mm})).collect::<Vec<_>>(),
        "restyled": found.restyled,
        "removed": found.removed,
        "added": found.added,
        "texts": found.texts.iter().map(|t| json!({"id": t.id, "old": t.old, "new": t.new})).collect::<Vec<_>>(),
        "pixels": {"over": over, "largest": largest, "bounds": bounds, "sizes": sizes, "decide": found.pixels_differ},
    })
}
