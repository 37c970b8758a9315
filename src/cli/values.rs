//! Values of arguments: the named choices, and the reading of numbers.

use super::files::FileRefusal;
use super::{Failure, SourceFaults, files};
use crate::certified::ladder::MOST_DIGITS;
use crate::diag::{Diagnostic, Faults, both};
use crate::exchange::{ExportFormat, ImportFormat};
use crate::figure::cycle::CycleForm;
use crate::figure::list::{self, FigureEntry};
use crate::figure::stepped::{ConstructionMethod, METHODS};
use crate::homework::platforms::Platform;
use crate::scene::{Lang, edit};
use clap::ValueEnum;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FigureFormat {
    Svg,
    Png,
    Pdf,
    Tikz,
}

impl FigureFormat {
    /// The format that a file's ending names.
    pub fn of(ending: &str) -> Option<FigureFormat> {
        FigureFormat::value_variants().iter().copied().find(|f| f.ending() == ending)
    }

    /// The ending of its files.
    pub fn ending(self) -> &'static str {
        match self {
            FigureFormat::Svg => "svg",
            FigureFormat::Png => "png",
            FigureFormat::Pdf => "pdf",
            FigureFormat::Tikz => "tikz",
        }
    }
}

/// Formats of a comparison: its diagram, or its table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ComparisonFormat {
    Svg,
    Png,
    Pdf,
    Tikz,
    Csv,
    Json,
}

impl ComparisonFormat {
    /// The format of the diagram; `None` for a table.
    pub fn of_figure(self) -> Option<FigureFormat> {
        match self {
            ComparisonFormat::Svg => Some(FigureFormat::Svg),
            ComparisonFormat::Png => Some(FigureFormat::Png),
            ComparisonFormat::Pdf => Some(FigureFormat::Pdf),
            ComparisonFormat::Tikz => Some(FigureFormat::Tikz),
            ComparisonFormat::Csv | ComparisonFormat::Json => None,
        }
    }
}

/// Formats of a worksheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SheetFormat {
    Pdf,
    Html,
    Md,
    Typ,
}

/// Formats of a motion; PNG is a picture for each frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MotionFormat {
    Gif,
    Svg,
    Png,
}

/// Formats of a sweep's table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum TableFormat {
    Csv,
    Json,
    Npy,
    Parquet,
}

/// Formats of a batch's table: those that are written row by row.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum BatchFormat {
    Csv,
    Npy,
    Parquet,
}

impl ValueEnum for Platform {
    fn value_variants<'a>() -> &'a [Platform] {
        &Platform::ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(self.name()))
    }
}

impl ValueEnum for ExportFormat {
    fn value_variants<'a>() -> &'a [ExportFormat] {
        &ExportFormat::ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(self.name()))
    }
}

impl ValueEnum for ImportFormat {
    fn value_variants<'a>() -> &'a [ImportFormat] {
        &ImportFormat::ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(self.name()))
    }
}

/// Actions of `shards`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ShardsAction {
    Missing,
    Verify,
    Compact,
}

/// One share of a batch: every `of`-th part, from the part `number - 1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    pub number: u64,
    pub of: u64,
}

impl std::str::FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Shard, String> {
        let parts =
            text.split_once('/').and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
        parts
            .filter(|(number, of)| (1..=*of).contains(number))
            .map(|(number, of)| Shard { number, of })
            .ok_or_else(|| "write I/N, such as 3/100: the third of a hundred shares".to_owned())
    }
}

/// Formats of a cam's profile.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Profile {
    Csv,
    Dxf,
}

/// The form of letters in an SVG.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum TextFormat {
    /// Outlines
    Outlines,
    /// Text, for drawing programs
    Editable,
}

/// Vectors at the points of a mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum PointVectors {
    /// Velocities
    Velocity,
    /// Accelerations
    Acceleration,
}

/// The figures that `draw` makes, by name.
pub fn figures() -> impl TypedValueParser<Value = &'static FigureEntry> {
    let values = list::LIST.iter().map(|e| PossibleValue::new(e.name).help(e.about[0]));
    PossibleValuesParser::new(values).map(|name| list::named(&name).unwrap_or(list::USUAL))
}

/// The methods whose construction `lesson` shows, by name.
pub fn methods() -> impl TypedValueParser<Value = ConstructionMethod> {
    let values = METHODS.iter().map(|e| PossibleValue::new(e.name).help(e.about[0]));
    PossibleValuesParser::new(values)
        .map(|name| ConstructionMethod::named(&name).unwrap_or(METHODS[0].method))
}

/// The forms of a motion cycle, by name.
pub fn cycle_forms() -> impl TypedValueParser<Value = CycleForm> {
    let values = CycleForm::ALL.map(|f| PossibleValue::new(f.name()).help(f.about()[0]));
    PossibleValuesParser::new(values).map(|name| CycleForm::named(&name).unwrap_or(CycleForm::Bars))
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Language {
    En,
    Zh,
}

/// Form of faults, warnings and notes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FaultFormat {
    Text,
    Json,
}

impl FaultFormat {
    /// The form of a name.
    pub fn named(name: &str) -> Option<FaultFormat> {
        FaultFormat::from_str(name, false).ok()
    }
}

impl From<Language> for Lang {
    fn from(l: Language) -> Lang {
        match l {
            Language::En => Lang::En,
            Language::Zh => Lang::Zh,
        }
    }
}

/// A number of digits that the precision ladder can certify.
pub fn digits(s: &str) -> Result<usize, FileRefusal> {
    match s.parse::<usize>() {
        Ok(n) if (1..=MOST_DIGITS).contains(&n) => Ok(n),
        _ => Err(FileRefusal(both!("not a whole number from 1 to {MOST_DIGITS}"))),
    }
}

/// Reads a length: a bare `--drafting` before the scene's name would take that for its length.
pub fn length(s: &str) -> Result<String, FileRefusal> {
    match s.trim_start().chars().next() {
        None => Ok(String::new()),
        Some(c) if c.is_ascii_digit() || "+-.(".contains(c) => Ok(s.to_string()),
        Some(_) => Err(FileRefusal(both!(
            "not a length; write --drafting=0.1mm, or put --drafting after the scene"
        ))),
    }
}

/// The greatest number of steps: a hundred columns of ten million rows are eight gigabytes.
pub fn steps(s: &str) -> Result<usize, FileRefusal> {
    match s.parse::<usize>() {
        Ok(n) if n <= 10_000_000 => Ok(n),
        _ => Err(FileRefusal(both!("not a whole number from 0 to 10000000"))),
    }
}

/// A resolution that neither vanishes nor fills the memory: an A4 sheet at 2400 dpi has 550 million
/// pixels.
pub fn dpi(s: &str) -> Result<f64, FileRefusal> {
    match s.parse::<f64>() {
        Ok(v) if (20.0..=1200.0).contains(&v) => Ok(v),
        Ok(v) => Err(FileRefusal(both!("{v} is not between 20 and 1200"))),
        Err(_) => Err(FileRefusal(both!("not a number"))),
    }
}

/// A tolerance of places on paper.
pub fn tolerance(s: &str) -> Result<f64, FileRefusal> {
    match s.parse::<f64>() {
        Ok(v) if (0.0..=1000.0).contains(&v) => Ok(v),
        Ok(v) => Err(FileRefusal(both!("{v} is not between 0 and 1000"))),
        Err(_) => Err(FileRefusal(both!("not a number"))),
    }
}

/// A time that a viewer sees something in and does not give up.
pub fn seconds(s: &str) -> Result<f64, FileRefusal> {
    match s.parse::<f64>() {
        Ok(v) if (0.1..=600.0).contains(&v) => Ok(v),
        Ok(v) => Err(FileRefusal(both!("{v} is not between 0.1 and 600"))),
        Err(_) => Err(FileRefusal(both!("not a number"))),
    }
}

/// The name to show and the bytes of a scene, or of another file with parameters, that have the
/// values of `--set`.
pub(super) fn file(path: &str, set: &[String]) -> Result<(String, Vec<u8>), Failure> {
    let (name, bytes) = files::scene(path).map_err(|d| Failure::input(d, path, ""))?;
    match std::str::from_utf8(&bytes) {
        Ok(text) if edit::with_parameters(text, &[]).is_ok() => {
            let text = with_values(set, |values| edit::with_parameters(text, values))?;
            Ok((name, text.into_bytes()))
        }
        // A text that cannot be changed has a fault, which the reader tells with its place.
        Ok(_) | Err(_) => Ok((name, bytes)),
    }
}

/// A text with the values of `--set NAME=VALUE`; every fault is shown at the argument that has it.
pub(super) fn with_values(
    set: &[String],
    apply: impl Fn(&[(&str, &str)]) -> Result<String, Faults>,
) -> Result<String, Failure> {
    let mut values = Vec::new();
    let mut wrong = Vec::new();
    for s in set {
        let Some((name, value)) = s.split_once('=') else {
            let d = Diagnostic::error("set", both!("`--set {s}` has no `=`"))
                .help(both!("write --set NAME=VALUE, such as --set l_AB=120"));
            wrong.push(SourceFaults::argument("--set", s, d));
            continue;
        };
        values.push((name.trim(), value.trim()));
        if let Err(faults) = apply(&values) {
            values.pop();
            wrong.push(SourceFaults::argument("--set", s, faults));
        }
    }
    if !wrong.is_empty() {
        return Err(Failure::Input(wrong));
    }
    apply(&values).map_err(|f| Failure::argument("--set", &set.join(" "), f))
}
