//! Parameters on a grid of round numbers: `l_AB=80..120/5`.
//!
//! Values are whole multiples of a power of ten, so that each is written with the digits of the
//! request: `0.1..0.3/0.1` gives `0.1`, `0.2`, `0.3`.

use crate::diag::{Diagnostic, Faults, Span, both};
use crate::problem::range::{RangeFault, WrongValue};
use crate::scene::Scene;
use crate::sweep::vary::Variation;

/// Largest number of decimal places, and of digits of a bound.
const MOST_PLACES: u32 = 9;
const MOST_DIGITS: usize = 15;

/// A decimal number with a unit: `units / 10^places`.
#[derive(Clone, Debug, PartialEq)]
struct Decimal {
    units: i128,
    places: u32,
    unit: String,
}

impl Decimal {
    /// Reads `80`, `-0.5` or `80 mm`; returns `None` for other expressions.
    fn read(text: &str) -> Option<Decimal> {
        let (negative, rest) = match text.trim().strip_prefix('-') {
            Some(rest) => (true, rest),
            None => (false, text.trim()),
        };
        let end = rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(rest.len());
        let (number, unit) = (&rest[..end], rest[end..].trim());
        let (whole, part) = number.split_once('.').unwrap_or((number, ""));
        let digits = format!("{whole}{part}");
        let plain = !whole.is_empty() && digits.len() <= MOST_DIGITS;
        let units: i128 = digits.parse().ok().filter(|_| plain)?;
        let places = u32::try_from(part.len()).ok().filter(|p| *p <= MOST_PLACES)?;
        Some(Decimal { units: if negative { -units } else { units }, places, unit: unit.into() })
    }

    /// Returns its units of the last of more places.
    fn at(&self, places: u32) -> i128 {
        self.units * 10_i128.pow(places.saturating_sub(self.places))
    }
}

/// The values of one parameter: `first + k * step`, for `k` below `count`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ParameterGrid {
    /// Name of the parameter.
    pub name: String,
    first: i128,
    step: i128,
    places: u32,
    unit: String,
    /// Number of values.
    pub count: u64,
}

impl ParameterGrid {
    /// Returns the `k`-th value as a scene writes it.
    pub fn value(&self, k: u64) -> String {
        let units = self.first + i128::from(k) * self.step;
        let (size, scale) = (units.unsigned_abs(), 10_u128.pow(self.places));
        let part = format!("{:0width$}", size % scale, width = self.places as usize);
        let part = part.trim_end_matches('0');
        let sign = if units < 0 { "-" } else { "" };
        let dot = if part.is_empty() || self.places == 0 { "" } else { "." };
        let part = if self.places == 0 { "" } else { part };
        format!("{sign}{}{dot}{part} {}", size / scale, self.unit).trim_end().to_owned()
    }
}

/// Reads the grids of a request.
///
/// # Errors
/// `vary`, and the faults of names and values, each at its place in its text, all at once.
pub(super) fn grids(scene: &Scene, vary: &[String]) -> Result<Vec<ParameterGrid>, RangeFault> {
    let (mut all, mut wrong): (Vec<ParameterGrid>, Vec<WrongValue>) = (Vec::new(), Vec::new());
    for text in vary {
        match grid(scene, text) {
            Ok(grid) if all.iter().any(|g| g.name == grid.name) => {
                let d = Diagnostic::error(
                    "given-twice",
                    both!("parameter `{}` is varied twice", grid.name),
                );
                wrong.push(WrongValue::new("vary", text, d));
            }
            Ok(grid) => all.push(grid),
            Err(faults) => wrong.push(WrongValue::new("vary", text, faults)),
        }
    }
    if wrong.is_empty() { Ok(all) } else { Err(RangeFault::Values(wrong)) }
}

fn grid(scene: &Scene, text: &str) -> Result<ParameterGrid, Faults> {
    let unread = || {
        Diagnostic::error(
            "vary",
            both!("`--vary {text}` cannot be read"),
        )
        .help(both!(
            "write NAME=FROM..TO/STEP with plain numbers, such as --vary l_AB=80..120/5, or NAME=FROM..TO:N for N values"
        ))
    };
    let (name, rest) = text.split_once('=').ok_or_else(unread)?;
    let (from, rest) = rest.split_once("..").ok_or_else(unread)?;
    // A third dot would be read as the beginning of `.120`.
    if rest.starts_with('.') {
        return Err(unread().into());
    }
    let name = name.trim();
    let place = |part: &str| {
        let start = text.find(part).unwrap_or_default();
        Span::new(start, start + part.len())
    };
    let at = |part: &str, faults: Faults| Faults {
        list: faults.list.into_iter().map(|d| d.at(place(part))).collect(),
    };
    let variation = Variation::new(scene, &[name]).map_err(|f| at(name, f))?;
    let read = |part: &str| -> Result<Decimal, Faults> {
        let number = Decimal::read(part).ok_or_else(unread)?;
        variation.value(scene, name, part.trim()).map_err(|f| at(part.trim(), f))?;
        Ok(number)
    };
    let first = read(from)?;
    let (last, step, count) = if let Some((to, step)) = rest.rsplit_once('/') {
        (read(to)?, Some(read(step)?), 0)
    } else {
        let (to, n) = rest.rsplit_once(':').ok_or_else(unread)?;
        let n: i128 =
            n.trim().parse().ok().filter(|n| (2..=1_000_000).contains(n)).ok_or_else(unread)?;
        (read(to)?, None, n)
    };
    // A bare number has the unit of the scene; all of them must have one unit.
    let units: Vec<&str> = [Some(&first), Some(&last), step.as_ref()]
        .into_iter()
        .flatten()
        .map(|d| d.unit.as_str())
        .collect();
    let unit = (*units.first().unwrap_or(&"")).to_owned();
    if units.iter().any(|u| *u != unit) {
        return Err(unread().into());
    }
    let mut places = [Some(&first), Some(&last), step.as_ref()]
        .into_iter()
        .flatten()
        .map(|d| d.places)
        .max()
        .unwrap_or(0);
    let wide = |places: u32| last.at(places) - first.at(places);
    let step = match step {
        Some(step) => step.at(places),
        None => {
            while wide(places) % (count - 1) != 0 && places < MOST_PLACES {
                places += 1;
            }
            if wide(places) % (count - 1) != 0 {
                return Err(unread().into());
            }
            wide(places) / (count - 1)
        }
    };
    if step <= 0 || wide(places) < 0 {
        let message =
            both!("`{text}` has no values: a step is greater than zero, and FROM is not above TO");
        return Err(Diagnostic::error("vary", message).into());
    }
    let count = u64::try_from(wide(places) / step + 1).unwrap_or(u64::MAX);
    Ok(ParameterGrid { name: name.into(), first: first.at(places), step, places, unit, count })
}
