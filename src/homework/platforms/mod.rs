//! Questions for learning platforms: each number of each variant is a numerical question with the
//! picture of its mechanism, the tolerance of the pencil, and feedback for typical mistakes.
//!
//! [`questions()`] makes the questions once; each format is a writer of its own. All of them judge
//! alike ([`Judgement`]): the right answer; half of the credit for the wrong sense and for an
//! inaccurate drawing; none for the value of a typical mistake, which the feedback names.

mod canvas;
mod markup;
mod moodle;
mod prairielearn;
mod qti;

use super::mark::{HALF, INACCURATE};
use super::{HomeworkVariant, KeyEntry, keys, sheets};
use crate::answer::AnswerValue;
use crate::diag::{Diagnostic, Faults, both};
use crate::paper::item::Figure;
use crate::problem::Look;
use crate::render::{png, svg};
use crate::report::amount::symbol;
use crate::scene::Lang;
use crate::worksheet::{DocumentBlock, WorksheetSides};

pub use canvas::canvas;
pub use moodle::moodle;
pub use prairielearn::prairielearn;
pub use qti::{QtiVersion, qti};

/// Learning platforms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Platform {
    /// Moodle's XML.
    Moodle,
    /// QTI 3.0.
    Qti3,
    /// QTI 2.1.
    Qti2,
    /// Canvas.
    Canvas,
    /// PrairieLearn.
    Prairielearn,
}

impl Platform {
    /// All platforms, in the order of a list.
    pub const ALL: [Platform; 5] = [
        Platform::Moodle,
        Platform::Qti3,
        Platform::Qti2,
        Platform::Canvas,
        Platform::Prairielearn,
    ];

    /// The name.
    pub fn name(self) -> &'static str {
        match self {
            Platform::Moodle => "moodle",
            Platform::Qti3 => "qti3",
            Platform::Qti2 => "qti2",
            Platform::Canvas => "canvas",
            Platform::Prairielearn => "prairielearn",
        }
    }

    /// Returns the platform of a name.
    pub fn named(name: &str) -> Option<Platform> {
        Platform::ALL.into_iter().find(|p| p.name() == name)
    }
}

/// Resolution of pictures (dots per inch): sharp on a screen, small in a file.
const DPI: f64 = 144.0;

/// Largest size of the problems (bytes), each repeated in all its questions.
const MOST_TEXT: usize = 16 << 20;

/// The questions of a variant.
#[derive(Clone, Debug, PartialEq)]
pub struct PlatformTask {
    /// Its name, such as `v01`.
    pub name: String,
    /// Its title.
    pub title: String,
    /// The problem as XHTML, without its picture.
    pub problem: String,
    /// The picture of the mechanism (PNG).
    pub picture: Vec<u8>,
    /// The words for the picture.
    pub alt: String,
    /// The questions.
    pub questions: Vec<PlatformQuestion>,
}

/// A question.
#[derive(Clone, Debug, PartialEq)]
pub struct PlatformQuestion {
    /// Its name in the set, in ASCII letters, digits, `-` and `_`: `v01-omega_3`.
    pub name: String,
    /// Its symbol in plain text.
    pub plain: String,
    /// The sentence that asks for it, as XHTML.
    pub prompt: String,
    /// The key.
    pub key: KeyEntry,
    /// The judgements in order; the first that holds counts.
    pub judgements: Vec<Judgement>,
}

/// The judgement of all answers in an interval.
#[derive(Clone, Debug, PartialEq)]
pub struct Judgement {
    /// The value, in the unit of the key.
    pub value: f64,
    /// The distance from it up to which the judgement holds.
    pub within: f64,
    /// The credit, from 0 to 1.
    pub credit: f64,
    /// The feedback, as plain text; empty for the right answer.
    pub feedback: String,
}

impl Judgement {
    /// Returns the ends of its interval, to the digits of the key.
    pub fn ends(&self) -> [f64; 2] {
        [self.value - self.within, self.value + self.within].map(|v| keys::rounded_to(v, 9))
    }
}

/// All questions with their language.
#[derive(Clone, Debug, PartialEq)]
pub struct PlatformSet {
    /// The title of the problem.
    pub title: String,
    /// The language.
    pub lang: Lang,
    /// The variants.
    pub tasks: Vec<PlatformTask>,
}

/// Makes the questions of a set.
///
/// # Errors
/// `too-many` for texts that no platform takes; those of the drawings.
pub fn questions(all: &[HomeworkVariant], look: &Look) -> Result<PlatformSet, Faults> {
    let mut size = 0;
    let mut set = PlatformSet { title: String::new(), lang: Lang::En, tasks: Vec::new() };
    for variant in all {
        let document = variant.solved.worksheet(
            WorksheetSides::Problem,
            crate::worksheet::WorksheetTask::Polygons,
            look,
        )?;
        set.lang = document.lang;
        set.title.clone_from(&document.title);
        let mut figure: Option<&Figure> = None;
        let mut problem = String::new();
        for block in &document.blocks {
            match block {
                DocumentBlock::Figure { figure: drawn, .. } => figure = Some(drawn),
                DocumentBlock::Heading(1, _) => {}
                DocumentBlock::Heading(_, text) => problem += &markup::heading(text),
                DocumentBlock::Paragraph(p) => problem += &markup::paragraph(p),
                DocumentBlock::List { members, .. } => problem += &markup::list(members),
                DocumentBlock::Table(_) | DocumentBlock::Formula(_) => {}
            }
        }
        size += problem.len() * variant.key.len();
        if size > MOST_TEXT {
            return Err(too_long().into());
        }
        let Some(figure) = figure else {
            let message = both!("the problem has no picture");
            return Err(Diagnostic::error("no-figure", message).into());
        };
        let picture = png::render(&svg::write(figure)?.value, DPI)?;
        let name = format!("v{:0width$}", variant.number, width = all.len().to_string().len());
        let asked = variant.key.iter().map(|k| question(variant, k, &name, set.lang, look));
        set.tasks.push(PlatformTask {
            title: sheets::titled(&document.title, variant.number, set.lang),
            problem,
            picture,
            alt: figure.title.clone(),
            questions: asked.collect(),
            name,
        });
    }
    Ok(set)
}

fn too_long() -> Diagnostic {
    let most = MOST_TEXT >> 20;
    let message = both!("the problem, repeated in each question, takes more than {most} MiB");
    Diagnostic::error("too-many", message)
        .help(both!("ask for fewer variants, or for less in \"find\""))
}

fn question(
    variant: &HomeworkVariant,
    key: &KeyEntry,
    task: &str,
    lang: Lang,
    look: &Look,
) -> PlatformQuestion {
    let (text, axis) = match key.question.strip_suffix(".x") {
        Some(text) => (text, Some("x")),
        None => match key.question.strip_suffix(".y") {
            Some(text) => (text, Some("y")),
            None => (key.question.as_str(), None),
        },
    };
    let asked = variant.solved.mechanism().and_then(|(scene, worked)| {
        let r = worked.results.iter().find(|r| scene.find[r.find].text == text)?;
        let (_, notation) = look.marked(scene);
        Some((symbol(&scene.find[r.find], &notation), r.value()))
    });
    let (letter, value) = asked.unwrap_or_else(|| (text.to_owned(), AnswerValue::Scalar(0.0)));
    let vector = matches!(value, AnswerValue::Vector(_));
    let shown = markup::formula(&letter);
    let unit = match key.unit.as_str() {
        "" => String::new(),
        unit => {
            let unit = markup::unit(unit);
            lang.of(&both!(" in {unit}")).to_owned()
        }
    };
    let what = match (axis, vector, key.kind.turns()) {
        (Some(axis), ..) => both!("the coordinate <i>{axis}</i> of {shown}{unit}"),
        (None, true, _) => both!("the magnitude of {shown}{unit}"),
        (None, false, true) => {
            both!("{shown}{unit}, positive if counter-clockwise")
        }
        (None, false, false) => both!("{shown}{unit}"),
    };
    let prompt = both!("Find {}. Write a number with a decimal point.", what);
    let plain: String =
        text.chars().map(|c| if c.is_ascii_alphanumeric() || c == '_' { c } else { '-' }).collect();
    let plain = axis.map_or(plain.clone(), |axis| format!("{plain}-{axis}"));
    PlatformQuestion {
        name: format!("{task}-{plain}"),
        plain: key.question.clone(),
        prompt: lang.of(&prompt).to_owned(),
        key: key.clone(),
        judgements: judgements(key, lang),
    }
}

fn judgements(key: &KeyEntry, lang: Lang) -> Vec<Judgement> {
    let own = |value, within: f64, credit, words: &crate::diag::Both| Judgement {
        value,
        within: keys::rounded_to(within, 6),
        credit,
        feedback: lang.of(words).to_owned(),
    };
    let mut all = vec![own(key.value, key.tolerance, 1.0, &crate::diag::Both::default())];
    if key.kind.turns() && key.value.abs() > key.tolerance {
        let words = both!("The sense is wrong: counter-clockwise is positive.");
        all.push(own(-key.value, key.tolerance, HALF, &words));
    }
    for m in &key.mistakes {
        let words = both!("Likely mistake: {}.", m.words());
        all.push(own(m.value, key.tolerance, 0.0, &words));
    }
    let words = both!("Inaccurate: draw larger or sharpen the pencil.");
    all.push(own(key.value, INACCURATE * key.tolerance, HALF, &words));
    all
}
