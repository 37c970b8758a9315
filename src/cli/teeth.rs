//! `hodograph teeth`: numbers of teeth for a ratio.

use super::args::TeethArgs;
use super::{CommandResult, Failure, InputFile, files, lang};
use crate::diag::{Diagnostic, Warned, both};
use crate::gears::Basic;
use crate::gears::unknown::{WantedGear, unknown_teeth};
use crate::gears::wanted::{WantedPair, WantedTrain, pairs, stages};
use crate::problem::{Kind, Wish};
use crate::report::teeth;
use crate::scene::edit;

/// Modules of the first series of ISO 54 and GB/T 1357 (mm).
const MODULES_MM: [f64; 11] = [1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];

/// Largest number of teeth.
const MOST_TEETH: u32 = 400;

/// Runs the command.
pub fn run(a: &TeethArgs) -> CommandResult {
    if let Some(scene) = &a.scene {
        return in_scene(a, scene);
    }
    let given = a.ratio.as_deref().unwrap_or_default();
    let ratio = quotient(given).ok_or_else(|| {
        let message =
            both!("`{given}` is no ratio of at least 1", "`{given}` 不是不小于 1 的传动比");
        refused("--ratio", given, message)
    })?;
    let within = part(&a.within)?;
    let teeth = whole_range(&a.teeth)?;
    let language = lang::now();
    let (text, json) = match (a.stages, &a.distance) {
        (Some(count), _) => {
            let (stages_wanted, taper) = (usize::from(count), a.taper);
            let wish = WantedTrain { ratio, stages: stages_wanted, taper, teeth, within };
            let mut found = stages(&wish);
            found.truncate(a.count);
            (teeth::stages_text(&wish, &found, language), teeth::stages_json(&wish, &found))
        }
        (None, Some(distance)) => {
            let modules = modules(&a.module)?;
            let length = |text: &str, option: &'static str| {
                edit::length(text).map_err(|f| Failure::argument(option, text, f))
            };
            let basic =
                Basic { module: 1.0, alpha: 20.0_f64.to_radians(), addendum: 1.0, clearance: 0.25 };
            let distance = length(distance, "--distance")?;
            let shifts = range("--shifts", &a.shifts)?;
            let helix = range("--helix", &a.helix)?.map(f64::to_radians);
            let wish = WantedPair { ratio, within, teeth, modules, basic, distance, shifts, helix };
            let mut found = pairs(&wish);
            found.truncate(a.count);
            (teeth::pairs_text(&wish, &found, language), teeth::pairs_json(&wish, &found))
        }
        (None, None) => {
            let message =
                both!("neither --distance nor --stages is given", "未给出 --distance 或 --stages");
            return Err(refused("--ratio", given, message));
        }
    };
    if a.json { files::print(&format!("{json:#}\n")) } else { files::print(&text) }
}

/// Finds the teeth of a gear in a scene.
fn in_scene(a: &TeethArgs, scene: &str) -> CommandResult {
    let (gear, want) =
        (a.gear.as_deref().unwrap_or_default(), a.want.as_deref().unwrap_or_default());
    let (quantity, value) = want.split_once('=').ok_or_else(|| {
        let message = both!("`{want}` is no NAME=VALUE", "`{want}` 不是 NAME=VALUE 的形式");
        refused("--want", want, message)
    })?;
    let wish = WantedGear {
        gear,
        quantity: quantity.trim(),
        value: value.trim(),
        teeth: whole_range(&a.teeth)?,
        within: part(&a.within)?,
    };
    let mut file = InputFile::open(scene, &[])?;
    let mut found = file.read(|bytes| {
        Kind::of(bytes).grants(Wish::Mechanism)?;
        let value = unknown_teeth(&String::from_utf8_lossy(bytes), &wish)?;
        Ok(Warned { value, notes: Vec::new() })
    })?;
    found.found.truncate(a.count);
    if a.json {
        files::print(&format!("{:#}\n", teeth::gear_json(&wish, &found)))
    } else {
        files::print(&teeth::gear_text(&wish, &found, lang::now()))
    }
}

fn refused(option: &'static str, text: &str, message: crate::diag::Both) -> Failure {
    let help = both!(
        "as in `hodograph teeth --ratio 3 --distance 150mm --module 2,2.5` or `hodograph teeth --ratio 31.5 --stages 3`",
        "例如 `hodograph teeth --ratio 3 --distance 150mm --module 2,2.5` 或 `hodograph teeth --ratio 31.5 --stages 3`"
    );
    Failure::argument(option, text, Diagnostic::error("wrong-given", message).help(help))
}

/// Reads a ratio of at least 1, such as 3.15 or 63/20.
fn quotient(text: &str) -> Option<f64> {
    let mut parts = text.splitn(2, '/').map(|p| p.trim().parse::<f64>().ok());
    let (above, below) = (parts.next()??, parts.next().map_or(Some(1.0), |x| x)?);
    Some(above / below).filter(|r| (1.0..=1e4).contains(r))
}

/// Reads a part such as 1% or 0.01.
fn part(text: &str) -> Result<f64, Failure> {
    let (number, times) = text.strip_suffix('%').map_or((text, 1.0), |n| (n, 0.01));
    let value = number.trim().parse::<f64>().ok().map(|x| x * times);
    value.filter(|x| (0.0..=0.2).contains(x)).ok_or_else(|| {
        let message = both!("`{text}` is no part from 0 to 20%", "`{text}` 不是 0 到 20% 的偏差");
        refused("--within", text, message)
    })
}

/// Reads two numbers with two points between them.
fn range(option: &'static str, text: &str) -> Result<[f64; 2], Failure> {
    let read = |t: &str| t.trim().trim_end_matches("deg").trim().parse::<f64>().ok();
    let both = text.split_once("..").and_then(|(a, b)| Some([read(a)?, read(b)?]));
    both.filter(|[a, b]| a.is_finite() && b.is_finite() && a <= b).ok_or_else(|| {
        let message = both!("`{text}` is no range such as 8..20", "`{text}` 不是范围，如 8..20");
        refused(option, text, message)
    })
}

fn whole_range(text: &str) -> Result<[u32; 2], Failure> {
    let both = text.split_once("..").and_then(|(a, b)| Some([a.parse().ok()?, b.parse().ok()?]));
    both.filter(|[a, b]| 5 <= *a && a <= b && *b <= MOST_TEETH).ok_or_else(|| {
        let message = both!(
            "`{text}` is no range of teeth from 5 to {MOST_TEETH}, such as 17..120",
            "`{text}` 不是 5 到 {MOST_TEETH} 的齿数范围，如 17..120"
        );
        refused("--teeth", text, message)
    })
}

/// Returns modules (m): those given, in mm, or the usual ones.
fn modules(given: &[f64]) -> Result<Vec<f64>, Failure> {
    if let Some(wrong) = given.iter().find(|m| !(0.01..=1000.0).contains(*m)) {
        let message =
            both!("a module of {wrong} mm is no size of a gear", "模数 {wrong} mm 不合理");
        return Err(refused("--module", &wrong.to_string(), message));
    }
    let all = if given.is_empty() { &MODULES_MM[..] } else { given };
    Ok(all.iter().take(40).map(|mm| mm * 1e-3).collect())
}
