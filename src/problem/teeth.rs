//! Numbers of teeth for a ratio: pairs for a centre distance, and trains of several stages.

use super::range::WrongValue;
use super::{Kind, Wish};
use crate::diag::{Both, Diagnostic, Faults, both};
use crate::gears::Basic;
use crate::gears::unknown::{FoundGear, WantedGear, unknown_teeth};
use crate::gears::wanted::{FoundPair, STAGES, TAPER, WantedPair, WantedTrain, pairs, stages};
use crate::report::teeth;
use crate::scene::{Lang, edit};
use serde_json::Value as Json;

/// Modules of the first series of ISO 54 and GB/T 1357 (mm).
const MODULES_MM: [f64; 11] = [1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];

/// Largest number of teeth.
const MOST_TEETH: u32 = 400;

/// A request for numbers of teeth, in the words of the user.
#[derive(Clone, Copy, Debug)]
pub struct TeethRequest<'a> {
    /// The ratio of at least 1, such as `3.15` or `63/20`.
    pub ratio: &'a str,
    /// Greatest deviation of the ratio, such as `1%`.
    pub within: &'a str,
    /// Least and greatest number of teeth, such as `17..120`.
    pub teeth: &'a str,
    /// The centre distance of a pair, such as `150mm`.
    pub distance: Option<&'a str>,
    /// The modules to try (mm); the usual ones if there is none.
    pub modules: &'a [f64],
    /// Least and greatest sum of the profile shifts of a spur pair.
    pub shifts: &'a str,
    /// Least and greatest helix angle of a helical pair (degrees).
    pub helix: &'a str,
    /// The number of stages of a train, within [`STAGES`].
    pub stages: Option<usize>,
    /// Ratio of a stage over that of the next slower one, within [`TAPER`].
    pub taper: f64,
    /// Greatest number of solutions.
    pub count: usize,
}

impl Default for TeethRequest<'_> {
    fn default() -> Self {
        TeethRequest {
            ratio: "",
            within: "1%",
            teeth: "17..120",
            distance: None,
            modules: &[],
            shifts: "-0.5..1.5",
            helix: "8..20",
            stages: None,
            taper: 1.3,
            count: 20,
        }
    }
}

/// The numbers of teeth that are found, the best first.
#[derive(Clone, Debug)]
pub enum TeethList {
    /// Pairs for a centre distance.
    Pairs(WantedPair, Vec<FoundPair>),
    /// Trains of several stages, each with the teeth of its pairs.
    Trains(WantedTrain, Vec<Vec<[u32; 2]>>),
}

impl TeethList {
    /// Returns the numbers of teeth for a request.
    ///
    /// # Errors
    /// Values that cannot be read or are out of bounds; neither distance nor stages.
    pub fn of(a: &TeethRequest) -> Result<TeethList, WrongValue> {
        let ratio = quotient(a.ratio).ok_or_else(|| {
            let message = both!("`{}` is no ratio of at least 1", a.ratio);
            refused("ratio", a.ratio, message)
        })?;
        let within = part(a.within)?;
        let teeth = whole_range(a.teeth)?;
        match (a.stages, a.distance) {
            (Some(count), _) => {
                within_bounds("stages", count, STAGES)?;
                within_bounds("taper", a.taper, TAPER)?;
                let wish = WantedTrain { ratio, stages: count, taper: a.taper, teeth, within };
                let mut found = stages(&wish);
                found.truncate(a.count);
                Ok(TeethList::Trains(wish, found))
            }
            (None, Some(distance)) => {
                let modules = modules(a.modules)?;
                let basic = Basic {
                    module: 1.0,
                    alpha: 20.0_f64.to_radians(),
                    addendum: 1.0,
                    clearance: 0.25,
                };
                let length = edit::length(distance);
                let distance = length.map_err(|f| WrongValue::new("distance", distance, f))?;
                let shifts = range("shifts", a.shifts)?;
                let helix = range("helix", a.helix)?.map(f64::to_radians);
                let wish =
                    WantedPair { ratio, within, teeth, modules, basic, distance, shifts, helix };
                let mut found = pairs(&wish);
                found.truncate(a.count);
                Ok(TeethList::Pairs(wish, found))
            }
            (None, None) => {
                let message = both!("neither --distance nor --stages is given");
                Err(refused("ratio", a.ratio, message))
            }
        }
    }

    /// Returns the solutions as a table.
    pub fn text(&self, lang: Lang) -> String {
        match self {
            TeethList::Pairs(wish, found) => teeth::pairs_text(wish, found, lang),
            TeethList::Trains(wish, found) => teeth::stages_text(wish, found, lang),
        }
    }

    /// Returns the solutions as JSON, in SI.
    pub fn json(&self) -> Json {
        match self {
            TeethList::Pairs(wish, found) => teeth::pairs_json(wish, found),
            TeethList::Trains(wish, found) => teeth::stages_json(wish, found),
        }
    }
}

/// The numbers of teeth of a gear in a scene with which a quantity has its wanted value.
#[derive(Debug)]
pub struct GearList<'a> {
    wish: WantedGear<'a>,
    found: FoundGear,
}

/// Returns the request for the teeth of a gear in a scene: the link, such as `3`, and the quantity
/// with its value, such as `omega_5=3rad/s`.
///
/// # Errors
/// Values that cannot be read or are out of bounds.
pub fn wanted_gear<'a>(
    gear: &'a str,
    want: &'a str,
    teeth: &str,
    within: &str,
) -> Result<WantedGear<'a>, WrongValue> {
    let (quantity, value) = want.split_once('=').ok_or_else(|| {
        let message = both!("`{want}` is no NAME=VALUE");
        refused("want", want, message)
    })?;
    Ok(WantedGear {
        gear,
        quantity: quantity.trim(),
        value: value.trim(),
        teeth: whole_range(teeth)?,
        within: part(within)?,
    })
}

impl<'a> GearList<'a> {
    /// Returns at most `count` numbers of teeth, the best first.
    ///
    /// # Errors
    /// The file is no mechanism; the faults of the scene and of the wanted value.
    pub fn of(file: &[u8], wish: WantedGear<'a>, count: usize) -> Result<GearList<'a>, Faults> {
        Kind::of(file).grants(Wish::Mechanism)?;
        let mut found = unknown_teeth(&String::from_utf8_lossy(file), &wish)?;
        found.found.truncate(count);
        Ok(GearList { wish, found })
    }

    /// Returns the numbers as a table.
    pub fn text(&self, lang: Lang) -> String {
        teeth::gear_text(&self.wish, &self.found, lang)
    }

    /// Returns the numbers as JSON, in SI.
    pub fn json(&self) -> Json {
        teeth::gear_json(&self.wish, &self.found)
    }
}

fn refused(of: &'static str, text: &str, message: Both) -> WrongValue {
    let help = both!(
        "as in `hodograph teeth --ratio 3 --distance 150mm --module 2,2.5` or `hodograph teeth --ratio 31.5 --stages 3`"
    );
    WrongValue::new(of, text, Diagnostic::error("wrong-given", message).help(help))
}

fn within_bounds<T: PartialOrd + std::fmt::Display>(
    option: &'static str,
    value: T,
    [least, most]: [T; 2],
) -> Result<(), WrongValue> {
    if least <= value && value <= most {
        return Ok(());
    }
    let text = value.to_string();
    let message = both!("--{option}: {text} is not a number from {least} to {most}");
    Err(refused(option, &text, message))
}

/// Reads a ratio of at least 1, such as 3.15 or 63/20.
fn quotient(text: &str) -> Option<f64> {
    let mut parts = text.splitn(2, '/').map(|p| p.trim().parse::<f64>().ok());
    let (above, below) = (parts.next()??, parts.next().map_or(Some(1.0), |x| x)?);
    Some(above / below).filter(|r| (1.0..=1e4).contains(r))
}

/// Reads a part such as 1% or 0.01.
fn part(text: &str) -> Result<f64, WrongValue> {
    let (number, times) = text.strip_suffix('%').map_or((text, 1.0), |n| (n, 0.01));
    let value = number.trim().parse::<f64>().ok().map(|x| x * times);
    value.filter(|x| (0.0..=0.2).contains(x)).ok_or_else(|| {
        let message = both!("`{text}` is no part from 0 to 20%");
        refused("within", text, message)
    })
}

/// Reads two numbers with two points between them.
fn range(option: &'static str, text: &str) -> Result<[f64; 2], WrongValue> {
    let read = |t: &str| t.trim().trim_end_matches("deg").trim().parse::<f64>().ok();
    let both = text.split_once("..").and_then(|(a, b)| Some([read(a)?, read(b)?]));
    both.filter(|[a, b]| a.is_finite() && b.is_finite() && a <= b).ok_or_else(|| {
        let message = both!("`{text}` is no range such as 8..20");
        refused(option, text, message)
    })
}

fn whole_range(text: &str) -> Result<[u32; 2], WrongValue> {
    let both = text.split_once("..").and_then(|(a, b)| Some([a.parse().ok()?, b.parse().ok()?]));
    both.filter(|[a, b]| 5 <= *a && a <= b && *b <= MOST_TEETH).ok_or_else(|| {
        let message =
            both!("`{text}` is no range of teeth from 5 to {MOST_TEETH}, such as 17..120");
        refused("teeth", text, message)
    })
}

/// Returns modules (m): those given, in mm, or the usual ones.
fn modules(given: &[f64]) -> Result<Vec<f64>, WrongValue> {
    if let Some(wrong) = given.iter().find(|m| !(0.01..=1000.0).contains(*m)) {
        let message = both!("a module of {wrong} mm is no size of a gear");
        return Err(refused("module", &wrong.to_string(), message));
    }
    let all = if given.is_empty() { &MODULES_MM[..] } else { given };
    Ok(all.iter().take(40).map(|mm| mm * 1e-3).collect())
}
