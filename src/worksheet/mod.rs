//! A worksheet: the problem as it is set, and its solution as a teacher writes it on the board.
//!
//! [`worksheet`] makes a [`Document`] of blocks from a solved scene; four writers turn it into
//! files: [`html`] with MathML, [`markdown`] with TeX formulas, [`typst`], and [`pages`] of A4 for
//! `render::pdf`. This module decides the contents and their order. All numbers come from the
//! certified answers and the drawing board, and figures have their style from elsewhere.
//!
//! The problem side holds only the given data: no answer, no polygon, no special point, not even in
//! the description of its figure for a screen reader.

mod centres;
mod composite;
mod design;
mod display;
mod equation;
pub mod html;
mod loops;
pub mod markdown;
mod mistake;
mod mobility;
pub mod pages;
mod pairs;
mod particle;
mod problem;
mod questions;
mod results;
mod solution;
mod speak;
pub mod typst;

use crate::certified::{Certified, CertifiedSteps, certify, steps};
use crate::diag::Diagnostic;
use crate::figure::sheet;
use crate::notation::Notation;
use crate::paper::font::own::Fonts;
use crate::paper::item::Figure;
use crate::paper::phrase::Phrase;
use crate::plan::text::PlanWriter;
use crate::render::math::Math;
use crate::scene::{Lang, LinkId, Scene};
use crate::worked::Worked;
use hodograph_base::lang::tr;
use speak::Speak;

pub use design::design;
pub use equation::equation;
pub use loops::by_loops;
pub use mistake::find_the_mistake;
pub use mobility::{mobility, mobility_of_pairs};
pub use particle::particle;
pub use questions::questions;

/// The sides of a worksheet that are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum WorksheetSides {
    /// The problem, then the solution.
    #[default]
    Both,
    /// The problem only, for pupils.
    Problem,
    /// The solution only, for teachers.
    Solution,
}

/// The problem of a worksheet, or the method of its solution.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum WorksheetTask<'a> {
    /// The scene's questions, solved by polygons.
    #[default]
    Polygons,
    /// The scene's questions, solved by the analytic method with vector loops.
    Loops,
    /// Questions on concepts.
    Questions,
    /// A wrong solution by its name, in which to find the mistake; the first possible one if the
    /// name is empty.
    Mistake(&'a str),
}

/// Options of a worksheet.
#[derive(Clone, Debug, PartialEq)]
pub struct WorksheetOptions {
    /// Language, notation, digits, and the style of figures.
    pub sheet: sheet::SheetOptions,
    /// The sides that are written.
    pub sides: WorksheetSides,
}

impl WorksheetOptions {
    /// Both sides in the default style of a language.
    pub fn of_language(lang: Lang) -> WorksheetOptions {
        WorksheetOptions {
            sheet: sheet::SheetOptions::of_language(lang),
            sides: WorksheetSides::Both,
        }
    }
}

/// A document for any of the writers.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    /// Its title.
    pub title: String,
    /// Its language.
    pub lang: Lang,
    /// The author's fonts for its pages; the other formats leave the choice to their readers.
    pub fonts: Fonts,
    /// Its contents.
    pub blocks: Vec<DocumentBlock>,
}

impl Document {
    /// Returns remarks on how the drawings were made, each once: those of the drawing with the most
    /// labels.
    pub fn remarks(&self) -> Vec<Diagnostic> {
        let figures = self.blocks.iter().filter_map(|block| match block {
            DocumentBlock::Figure { figure, .. } => Some(figure),
            DocumentBlock::Heading(..)
            | DocumentBlock::Paragraph(_)
            | DocumentBlock::List { .. }
            | DocumentBlock::Table(_)
            | DocumentBlock::Formula(_) => None,
        });
        figures
            .max_by_key(|f| f.remarks().len() * f.labels_placed())
            .map_or_else(Vec::new, |f| f.remarks())
    }
}

/// A block of a document.
#[derive(Clone, Debug, PartialEq)]
pub enum DocumentBlock {
    /// A heading: 1 for the sides, 2 within them, 3 within those.
    Heading(u8, String),
    /// A paragraph.
    Paragraph(Phrase),
    /// A list.
    List {
        /// True if its members are numbered, from 1.
        numbered: bool,
        /// Its members.
        members: Vec<Phrase>,
    },
    /// A table.
    Table(DocumentTable),
    /// A formula on a line of its own.
    Formula(Vec<Math>),
    /// A drawing, in true millimetres, with its caption in it.
    Figure {
        /// The word in its file name.
        name: &'static str,
        /// The drawing.
        figure: Box<Figure>,
    },
}

/// A table.
#[derive(Clone, Debug, PartialEq)]
pub struct DocumentTable {
    /// Its kind.
    pub kind: TableKind,
    /// Its rows, equally long; the first one heads the columns.
    pub rows: Vec<Vec<Phrase>>,
}

/// The kind of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TableKind {
    /// A vector equation with the known data of its terms below: cells centred, no lines.
    Equation,
    /// Values: cells left-aligned, a line below the head.
    Values,
}

/// A file that belongs to a document, such as a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct CompanionFile {
    /// Its name, in the folder of the document.
    pub name: String,
    /// Its contents.
    pub text: String,
}

/// Makes the worksheet of a scene that is solved for [`crate::worked::Scope::Figure`].
///
/// ```
/// use hodograph::{scene, worksheet, worked::{work, Scope}};
/// let scene = scene::read(scene::templates::get("crank-rocker").unwrap()).unwrap().value;
/// let worked = work(&scene, Scope::Figure).unwrap().value;
/// let document = worksheet::worksheet(&scene, &worked, &worksheet::WorksheetOptions::of_language(scene::Lang::En));
/// assert_eq!(document.blocks[0], worksheet::DocumentBlock::Heading(1, "Problem".into()));
/// ```
pub fn worksheet(scene: &Scene, worked: &Worked, options: &WorksheetOptions) -> Document {
    solved_by(scene, worked, options, |maker, blocks| {
        maker.solution(blocks, options.sides == WorksheetSides::Solution);
    })
}

/// Makes the worksheet of a scene with the solution that `solution` writes.
fn solved_by(
    scene: &Scene,
    worked: &Worked,
    options: &WorksheetOptions,
    solution: impl FnOnce(&SheetMaker, &mut Vec<DocumentBlock>),
) -> Document {
    let certified = certify(scene, worked, options.sheet.digits);
    let told = steps(scene, worked, worked.drafting.as_ref().map(|d| d.pencil_mm));
    let maker =
        SheetMaker { scene, worked, options: &options.sheet, certified: &certified, told: &told };
    let mut blocks = Vec::new();
    if options.sides != WorksheetSides::Solution {
        maker.problem(&mut blocks);
    }
    if options.sides != WorksheetSides::Problem {
        solution(&maker, &mut blocks);
    }
    document(scene, options, blocks)
}

/// Makes the document from the blocks under the scene's title.
fn document(scene: &Scene, options: &WorksheetOptions, blocks: Vec<DocumentBlock>) -> Document {
    let lang = options.sheet.lang;
    let title = lang.of(&scene.title);
    let title = if title.is_empty() { tr!(lang, "Planar mechanism") } else { title };
    Document { title: one_line(title), lang, fonts: options.sheet.style.fonts.clone(), blocks }
}

/// Shared input of all parts of a worksheet.
#[derive(Clone, Copy)]
struct SheetMaker<'a> {
    scene: &'a Scene,
    worked: &'a Worked,
    options: &'a sheet::SheetOptions,
    certified: &'a [Certified],
    /// The certified numbers of the construction's steps.
    told: &'a CertifiedSteps,
}

impl Speak for SheetMaker<'_> {
    fn lang(&self) -> Lang {
        self.options.lang
    }
}

impl SheetMaker<'_> {
    fn notation(&self) -> &Notation {
        &self.options.notation
    }

    fn writer(&self) -> PlanWriter<'_> {
        PlanWriter {
            scene: self.scene,
            plan: &self.worked.plan,
            notation: self.notation(),
            lang: self.lang(),
        }
    }

    fn link(&self, l: LinkId) -> &str {
        self.scene.link_name(l)
    }
}

/// A text on one line, with single spaces between its words: a line break would end a heading or a
/// link.
fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Protects the beginning of a paragraph that Markdown and Typst would take for a list or a
/// heading.
fn guarded(line: String) -> String {
    let digits = line.bytes().take_while(u8::is_ascii_digit).count();
    let mark = if digits > 0 { &[".", ")"][..] } else { &["-", "+", "="][..] };
    if mark.iter().any(|m| line[digits..].starts_with(m)) {
        format!("{}\\{}", &line[..digits], &line[digits..])
    } else {
        line
    }
}

/// Puts a backslash before each character that has a meaning in a language; `means` gets the
/// character, the one before it and the one after it.
fn backslashed(text: &str, means: impl Fn(Option<char>, char, Option<char>) -> bool) -> String {
    let mut out = String::with_capacity(text.len());
    let mut before = None;
    let mut chars = text.chars().peekable();
    while let Some(c) = chars.next() {
        if means(before, c, chars.peek().copied()) {
            out.push('\\');
        }
        out.push(c);
        before = Some(c);
    }
    out
}

/// The file names of a document's pictures under one stem: `shaper-mechanism.svg`; repeated words
/// get a number.
fn picture_names<'a>(document: &'a Document, stem: &str) -> Vec<(String, &'a Figure)> {
    let mut all: Vec<(String, &Figure)> = Vec::new();
    for block in &document.blocks {
        if let DocumentBlock::Figure { name, figure } = block {
            let plain = format!("{stem}-{name}.svg");
            let counted = (2..).map(|k| format!("{stem}-{name}-{k}.svg"));
            let free =
                std::iter::once(plain).chain(counted).find(|n| all.iter().all(|(m, _)| m != n));
            all.push((free.expect("numbers do not run out"), figure));
        }
    }
    all
}
