//! Many mechanisms from one scene: parameters vary over a grid or at random.
//!
//! The rows of a [`Batch`] depend on the scene, the ranges and the choice alone. A table consists
//! of the rows of consecutive blocks of [`block`] mechanisms.

use super::range::{RangeFault, SweptRange, WrongValue, driver_of, steps};
use crate::diag::{Diagnostic, Faults, Span, both};
use crate::mechanism::Mechanism;
#[cfg(any(feature = "csv", feature = "tables"))]
use crate::report::table::TableHead;
#[cfg(any(feature = "csv", feature = "tables"))]
use crate::scene::Lang;
use crate::scene::Scene;
use crate::scene::eval::DimensionedValue;
use crate::sweep::PlacedScene;
use crate::sweep::batch::{Batch, ParameterChoice};
use crate::sweep::vary::Variation;

/// Largest number of values of a parameter.
pub const MOST_VALUES: usize = 10_000_000;
/// Largest number of steps of each mechanism: all its rows are in memory at once, in each stage of
/// the work; a dozen columns take some ten megabytes.
pub const MOST_POSITIONS: usize = 100_000;

/// Approximate number of values in a block: some megabytes, in Parquet a row group of some 100 000
/// rows.
const BLOCK: usize = 1 << 20;

/// A batch in the notation of the scene.
#[derive(Clone, Copy, Debug)]
pub struct BatchRequest<'a> {
    /// The parameters and their values, each `NAME=FROM..TO:N`, or `NAME=FROM..TO` for two values
    /// (the bounds of a random one); bare numbers have the scene's unit.
    pub vary: &'a [String],
    /// The choice of values for each mechanism.
    pub choice: ParameterChoice,
    /// The positions of the driver; without steps each mechanism is solved in the scene's pose.
    pub range: SweptRange<'a>,
}

/// Plans a batch and passes it to `work`.
///
/// # Errors
/// Values that cannot be read or do not fit the quantity of their parameter, all at once; those of
/// the range and of the scene.
pub fn planned<T>(
    scene: &Scene,
    request: &BatchRequest,
    work: impl FnOnce(&Batch) -> T,
) -> Result<T, RangeFault> {
    let BatchRequest { vary, choice, range } = request;
    let mechanism = Mechanism::new(scene).map_err(RangeFault::Scene)?.value;
    let driver = driver_of(scene, range.over)?;
    let stations = match range.steps {
        None => None,
        Some(_) => {
            let placed = PlacedScene::new(scene, &mechanism).map_err(RangeFault::Scene)?;
            Some(steps(&placed, driver, range)?.all())
        }
    };
    let (variation, values) = varied(scene, vary).map_err(RangeFault::Values)?;
    let choice = *choice;
    Ok(work(&Batch { scene, mechanism: &mechanism, variation, values, choice, driver, stations }))
}

/// Returns the parameters of ranges with their values.
fn varied(
    scene: &Scene,
    vary: &[String],
) -> Result<(Variation, Vec<Vec<DimensionedValue>>), Vec<WrongValue>> {
    let fault = |text: &str, faults: Faults| WrongValue::new("vary", text, faults);
    let (mut wrong, mut read) = (Vec::new(), Vec::new());
    for text in vary {
        let known = range(text).and_then(|r| {
            Variation::new(scene, &[r.name]).map(|_| r).map_err(|f| at(text, r.name, f))
        });
        match known {
            Ok(r) => read.push((text, r)),
            Err(faults) => wrong.push(fault(text, faults)),
        }
    }
    if !wrong.is_empty() {
        return Err(wrong);
    }
    let names: Vec<&str> = read.iter().map(|(_, r)| r.name).collect();
    let again = (0..names.len()).find(|&i| names[..i].contains(&names[i])).unwrap_or_default();
    let twice = read.get(again).map_or("", |(text, _)| text.as_str());
    let variation = Variation::new(scene, &names).map_err(|f| vec![fault(twice, f)])?;
    let mut values = Vec::new();
    for (text, r) in &read {
        let checked = |value: &str| {
            variation.value(scene, r.name, value).map(drop).map_err(|f| at(text, value, f))
        };
        let listed = checked(r.from)
            .and_then(|()| checked(r.to))
            .and_then(|()| variation.range(scene, r.name, r.from, r.to, r.count - 1));
        match listed {
            Ok(list) => values.push(list),
            Err(faults) => wrong.push(fault(text, faults)),
        }
    }
    if wrong.is_empty() { Ok((variation, values)) } else { Err(wrong) }
}

/// Returns the number of mechanisms in a block.
pub fn block(batch: &Batch) -> u64 {
    (BLOCK / (batch.positions() * batch.columns().len()).max(1)).max(1) as u64
}

/// Returns the head of a batch's table, with notes in a language. The mechanism's number, its
/// parameters and the driver's position repeat.
#[cfg(any(feature = "csv", feature = "tables"))]
pub fn head(batch: &Batch, title: &str, lang: Lang) -> TableHead {
    let mut head = TableHead::new(title, batch.columns()).in_language(lang);
    let leading = 2 + batch.values.len();
    head.columns.iter_mut().take(leading).for_each(|c| c.repeats = true);
    head.columns.iter_mut().take(1).for_each(|c| c.whole = true);
    head
}

/// Returns the notes of a batch's table, `missing` of whose positions have no row.
pub fn notes(missing: u64) -> Vec<Diagnostic> {
    let note = |n| {
        Diagnostic::note(
            "no-position",
            both!("{n} positions have no row: the mechanism cannot be assembled there"),
        )
    };
    (missing > 0).then(|| note(missing)).into_iter().collect()
}

/// Returns the faults of a part of a text, at the place of that part.
fn at(text: &str, part: &str, faults: Faults) -> Faults {
    let start = text.find(part).unwrap_or_default();
    let place = Span::new(start, start + part.len());
    Faults { list: faults.list.into_iter().map(|d| d.at(place)).collect() }
}

/// A parameter's values as written.
#[derive(Clone, Copy)]
struct ParameterRange<'a> {
    name: &'a str,
    from: &'a str,
    to: &'a str,
    count: usize,
}

fn range(text: &str) -> Result<ParameterRange<'_>, Faults> {
    let unread = || {
        let d = Diagnostic::error("vary", both!("`--vary {text}` cannot be read"));
        Faults::from(d.help(both!(
            "write NAME=FROM..TO:N, such as --vary l_BC=80..120:100; N is 1 to 10000000"
        )))
    };
    let (name, rest) = text.split_once('=').ok_or_else(unread)?;
    let (bounds, count) = match rest.rsplit_once(':') {
        Some((bounds, n)) => (
            bounds,
            n.trim().parse().ok().filter(|n| (1..=MOST_VALUES).contains(n)).ok_or_else(unread)?,
        ),
        None => (rest, 2),
    };
    // `60...120` could be read as `60..0.120`.
    if let Some(dots) = text.find("...") {
        let d = Diagnostic::error(
            "vary",
            both!("a range has two dots between its bounds; this one has three or more"),
        );
        let d = d.at(Span::new(dots, text.len() - text[dots..].trim_start_matches('.').len()));
        return Err(d
            .help(both!("write FROM..TO; before the point of a number write a digit, 0.5"))
            .into());
    }
    let (from, to) = bounds.split_once("..").ok_or_else(unread)?;
    Ok(ParameterRange { name: name.trim(), from: from.trim(), to: to.trim(), count })
}
