//! The results over a whole motion as tables of a worksheet, in the units of the book.

use super::Look;
use super::range::{SweptRange, steps};
use super::whole::{asking_for_motion, no_curve, usual};
use crate::diag::{Faults, Warned};
use crate::digits::{minus, shortest};
use crate::figure::curves::CurveDiagram;
use crate::paper::phrase::Phrase;
use crate::scene::Swept;
use crate::sweep::long::LongSweep;
use crate::sweep::pieces::gather;
use crate::sweep::timed::TimedSweep;
use crate::sweep::{self, PlacedScene};
use crate::worksheet::{DocumentBlock, DocumentTable, TableKind};
use hodograph_base::lang::{say, tr};

/// Significant digits of the greatest value of a column.
const DIGITS: f64 = 5.0;

/// Largest number of columns of results in one table.
const COLUMNS: usize = 8;

/// Values below this part of the greatest of their column are rounding errors.
const ZERO: f64 = 1e-9;

/// Greatest number of steps of the table.
pub const MOST_TABLE_STEPS: u16 = 720;

/// Returns the answers of a scene, with the displacements of
/// [`with_positions`](super::whole::with_positions), at `count` equal steps over its whole motion,
/// at most [`MOST_TABLE_STEPS`]: a heading, a sentence, and tables of at most eight columns of results
/// beside the position of the driver. A vector that is parallel to one axis has its sign, any other
/// its magnitude. Units that the scene does not choose are mm, mm/s, mm/s² and degrees.
///
/// # Errors
/// `no-driver` for a scene without one; `no-curve` if nothing is asked; those of the sweep.
pub fn turn_table(
    source: &[u8],
    count: usize,
    look: &Look,
) -> Result<Warned<Vec<DocumentBlock>>, Faults> {
    let mut scene = asking_for_motion(source, None)?.value;
    scene.book = scene.book.of_table("book").unwrap_or_default();
    let mechanism = sweep::mechanism(&scene)?;
    let placed = PlacedScene::new(&scene, &mechanism)?;
    let (lang, notation) = look.marked(&scene);
    let (diagram, notes) = match usual(&scene)? {
        Swept::Driver(driver) => {
            let range = SweptRange { steps: Some(count), ..SweptRange::default() };
            let steps = steps(&placed, driver, &range).map_err(Faults::from)?;
            let table = gather(&mut LongSweep::new(&placed, driver, steps)?);
            (CurveDiagram::of(&placed, driver, &table, &notation), table.notes)
        }
        Swept::Time => {
            let (timed, range) = TimedSweep::new(&placed, [None, None])?;
            let table = gather(&mut timed.steps(range, count));
            let again = |times| Some(timed.table(times));
            let diagram = CurveDiagram::swept(&scene, Swept::Time, &table, &again, &notation);
            (diagram, table.notes)
        }
    };
    if diagram.is_empty() {
        return Err(no_curve().into());
    }
    let driver = &diagram.driver[0];
    let title = tr!(lang, "Results over the motion");
    let sentence = say!(lang, "Results at {count} equal steps of ${driver}$.");
    let mut blocks = vec![
        DocumentBlock::Heading(2, title.to_owned()),
        DocumentBlock::Paragraph(Phrase::new(&sentence)),
    ];
    let told = notes.iter().map(|n| Phrase::of_words(lang.of(&n.message))).collect::<Vec<_>>();
    if !told.is_empty() {
        blocks.push(DocumentBlock::List { numbered: false, members: told });
    }
    blocks.extend(tables(&diagram));
    Ok(Warned { value: blocks, notes: Vec::new() })
}

/// Returns the rows of a diagram as tables, each with the position of the driver first.
fn tables(diagram: &CurveDiagram) -> Vec<DocumentBlock> {
    let math = |text: String| Phrase::new(&format!("${text}$"));
    let mut heads = diagram.heads().into_iter().map(math);
    let mut column = |values: Vec<String>| -> Vec<Phrase> {
        heads.next().into_iter().chain(values.into_iter().map(math)).collect()
    };
    let driver = column(diagram.places.iter().map(|x| minus(&shortest(*x))).collect());
    let curves = diagram.panels.iter().flat_map(|p| &p.curves);
    let columns: Vec<Vec<Phrase>> = curves.map(|c| column(fixed(&c.values))).collect();
    // Tables of about equal width.
    let wide = columns.len().div_ceil(columns.len().div_ceil(COLUMNS).max(1)).max(1);
    let table = |some: &[Vec<Phrase>]| {
        let row = |k: usize| {
            let all = std::iter::once(&driver).chain(some);
            all.filter_map(|column| column.get(k).cloned()).collect()
        };
        let rows = (0..driver.len()).map(row).collect();
        DocumentBlock::Table(DocumentTable { kind: TableKind::Values, rows })
    };
    columns.chunks(wide).map(table).collect()
}

/// Returns the numbers of a column with the same number of decimals; the greatest has five
/// significant digits. A value that does not exist is a dash.
fn fixed(values: &[f64]) -> Vec<String> {
    let finite = values.iter().filter(|v| v.is_finite());
    let most = finite.fold(0.0, |m: f64, v| m.max(v.abs()));
    let places = if most > 0.0 { DIGITS - 1.0 - libm::floor(libm::log10(most)) } else { 0.0 };
    let places = places.clamp(0.0, 15.0) as usize;
    let text = |v: &f64| match v {
        v if !v.is_finite() => "\\text{—}".to_owned(),
        v if v.abs() < ZERO * most => "0".to_owned(),
        v => {
            let text = format!("{v:.places$}");
            let zero = text.chars().all(|c| matches!(c, '-' | '0' | '.'));
            if zero { "0".to_owned() } else { minus(&text) }
        }
    };
    values.iter().map(text).collect()
}
