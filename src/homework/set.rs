//! The files of a set of variants: sheets, keys, questions for platforms.

use super::platforms::{self, Platform, QtiVersion};
use super::{HomeworkVariant, keys, sheets};
use crate::diag::Warned;
use crate::problem::Look;
use crate::problem::range::{RangeFault, WrongValue};
use crate::scene::PageFormat;
use crate::worksheet::WorksheetSides;
use crate::zip::ArchiveFile;

/// Files of a set in addition to problems, solutions and keys.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HomeworkAdditions<'a> {
    /// Platforms with questions for each.
    pub platforms: &'a [Platform],
    /// The pages of sheets to draw on and their overlays; `None` for none of them.
    pub frame: Option<PageFormat>,
}

/// Returns the files of a set, each with its path in the set's folder: problems.pdf, solutions.pdf,
/// frames.pdf and overlays.pdf, the questions of platforms, answers.csv (the key) and values.csv.
///
/// # Errors
/// The errors of the drawings and of the PDF; `too-many` for a set that a platform does not take.
pub fn files(
    all: &[HomeworkVariant],
    wanted: &HomeworkAdditions,
    look: &Look,
) -> Result<Warned<Vec<ArchiveFile>>, RangeFault> {
    let (mut out, mut notes) = (Vec::new(), Vec::new());
    for (path, sides) in
        [("problems.pdf", WorksheetSides::Problem), ("solutions.pdf", WorksheetSides::Solution)]
    {
        let made = sheets::pdf(all, sides, look).map_err(RangeFault::Scene)?;
        notes.extend(made.notes);
        out.push(one(path, made.value));
    }
    if let Some(page) = &wanted.frame {
        let made = sheets::frames(all, look, page).map_err(RangeFault::Scene)?;
        let [frames, overlays] = made.value;
        notes.extend(made.notes);
        out.extend([one("frames.pdf", frames), one("overlays.pdf", overlays)]);
    }
    if !wanted.platforms.is_empty() {
        let set = platforms::questions(all, look).map_err(RangeFault::Scene)?;
        for platform in wanted.platforms {
            match platform {
                Platform::Moodle => {
                    let text = platforms::moodle(&set);
                    let text = text.map_err(|d| WrongValue::new("to", platform.name(), d))?;
                    out.push(one("moodle.xml", text.into_bytes()));
                }
                Platform::Qti3 => {
                    out.push(one("qti3.zip", platforms::qti(&set, QtiVersion::Three)))
                }
                Platform::Qti2 => out.push(one("qti2.zip", platforms::qti(&set, QtiVersion::Two))),
                Platform::Canvas => out.push(one("canvas.zip", platforms::canvas(&set))),
                Platform::Prairielearn => out.extend(platforms::prairielearn(&set)),
            }
        }
    }
    out.push(one("answers.csv", keys::csv(all).into_bytes()));
    out.push(one("values.csv", keys::values_csv(all).into_bytes()));
    Ok(Warned { value: out, notes })
}

fn one(path: &str, bytes: Vec<u8>) -> ArchiveFile {
    ArchiveFile { path: path.to_owned(), bytes }
}
