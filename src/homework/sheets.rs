//! The sheets of all variants as pages: each problem with its number and a line for the name, each
//! solution with its number.

use super::HomeworkVariant;
use crate::diag::{Both, Faults, Warned, both};
use crate::figure::frame::{FramePage, working_frame};
use crate::figure::list::{Extras, FigureInput};
use crate::paper::phrase::Phrase;
use crate::paper::words::words;
use crate::problem::Look;
use crate::render::pages::Page;
use crate::render::pdf;
use crate::scene::{Lang, PageFormat};
use crate::worksheet::{Document, DocumentBlock, WorksheetSides, WorksheetTask, pages};

/// Returns the document of one side of a variant.
///
/// # Errors
/// The errors of the drawings.
pub fn document(
    variant: &HomeworkVariant,
    sides: WorksheetSides,
    look: &Look,
) -> Result<Document, Faults> {
    let mut document = variant.solved.worksheet(sides, WorksheetTask::Polygons, look)?;
    let lang = document.lang;
    document.title = titled(&document.title, variant.number, lang);
    let name = variant.student.clone();
    let line = match sides {
        WorksheetSides::Solution => name.map(|name| both!("For {name}")),
        WorksheetSides::Problem | WorksheetSides::Both => {
            let name = name.unwrap_or_else(|| "_".repeat(24));
            Some(both!("Name: {name}   Class: {0}   Date: {0}", "_".repeat(12)))
        }
    };
    // The line is the first one below the heading of the side.
    if let Some(line) = line {
        let at = document.blocks.len().min(1);
        let words = Phrase::of_words(lang.of(&line));
        document.blocks.insert(at, DocumentBlock::Paragraph(words));
    }
    Ok(document)
}

/// Returns the sheets to draw on of all variants as one PDF, and their overlays as another.
///
/// # Errors
/// The errors of [`working_frame`] and of the PDF.
pub fn frames(
    all: &[HomeworkVariant],
    look: &Look,
    page: &PageFormat,
) -> Result<Warned<[Vec<u8>; 2]>, Faults> {
    let (mut blanks, mut overlays) = (Vec::new(), Vec::new());
    let extras = Extras::default();
    for variant in all {
        let Some((scene, worked)) = variant.solved.mechanism() else { continue };
        let options = look.sheet_of(scene);
        let title = titled(options.lang.of(&scene.title), variant.number, options.lang);
        let title = match &variant.student {
            Some(name) => format!("{title} · {name}"),
            None => title,
        };
        let mut scene = scene.clone();
        scene.title = Both { en: title.clone(), zh: title };
        let wanted = FigureInput { scene: &scene, worked, options: &options, extras: &extras };
        for FramePage { blank, overlay } in working_frame(&wanted, page)? {
            blanks.push(blank);
            overlays.push(overlay);
        }
    }
    let Warned { value: blanks, notes } = pdf::pdf(&blanks)?;
    Ok(Warned { value: [blanks, pdf::pdf(&overlays)?.value], notes })
}

/// Returns the title of a variant.
pub(super) fn titled(title: &str, n: usize, lang: Lang) -> String {
    format!("{title} · {}", lang.of(&both!("Variant {n}")))
}

/// Returns one PDF with a side of all variants, one after the other.
///
/// # Errors
/// The errors of the drawings and of the PDF.
pub fn pdf(
    all: &[HomeworkVariant],
    sides: WorksheetSides,
    look: &Look,
) -> Result<Warned<Vec<u8>>, Faults> {
    let (mut every, mut title, mut lang) = (Vec::<Page>::new(), String::new(), Lang::En);
    for variant in all {
        let document = document(variant, sides, look)?;
        every.extend(pages::pages(&document));
        if title.is_empty() {
            lang = document.lang;
            title = document.title.rsplit_once(" · ").map_or("", |(t, _)| t).to_owned();
        }
    }
    pdf::document(&every, &title, words(lang).tag)
}
