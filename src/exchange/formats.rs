//! The formats by their names and endings; a solved file in each, and the scene of a file of another
//! program.

use super::{ImportedLinkage, Linkage, drawing, geogebra, mechanism, pmks, pylinkage, scene};
use crate::diag::{Diagnostic, Faults, Warned, both};
#[cfg(feature = "png")]
use crate::figure::list::{Extras, FigureInput};
use crate::figure::list::{FigureEntry, MECHANISM};
use crate::paper::item::Figure;
use crate::problem::range::{RangeFault, WrongValue};
use crate::problem::{Kind, Look, Pictures, Solved, Wish};
use crate::render::tikz;

/// Formats of other programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExportFormat {
    /// A drawing for CAD programs.
    Dxf,
    /// A construction for GeoGebra, with a crank to drag.
    Ggb,
    /// A picture for LaTeX.
    Tikz,
    /// A slide for each step of the construction.
    Pptx,
    /// A script that builds the linkage with pylinkage.
    Pylinkage,
    /// The file of pylinkage's module `mechanism`.
    PylinkageJson,
    /// The text of PMKS.
    Pmks,
}

/// Formats of linkages that are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ImportFormat {
    /// JSON of pylinkage's module `mechanism`.
    Pylinkage,
    /// The text of PMKS.
    Pmks,
}

impl ExportFormat {
    /// All formats, in the order of a list.
    pub const ALL: [ExportFormat; 7] = [
        ExportFormat::Dxf,
        ExportFormat::Ggb,
        ExportFormat::Tikz,
        ExportFormat::Pptx,
        ExportFormat::Pylinkage,
        ExportFormat::PylinkageJson,
        ExportFormat::Pmks,
    ];

    /// The name.
    pub fn name(self) -> &'static str {
        match self {
            ExportFormat::Dxf => "dxf",
            ExportFormat::Ggb => "ggb",
            ExportFormat::Tikz => "tikz",
            ExportFormat::Pptx => "pptx",
            ExportFormat::Pylinkage => "pylinkage",
            ExportFormat::PylinkageJson => "pylinkage-json",
            ExportFormat::Pmks => "pmks",
        }
    }

    /// Returns the format of a name.
    pub fn named(name: &str) -> Option<ExportFormat> {
        ExportFormat::ALL.into_iter().find(|f| f.name() == name)
    }

    /// The endings of its files, without the dot; the first is the usual one.
    pub fn endings(self) -> &'static [&'static str] {
        match self {
            ExportFormat::Dxf => &["dxf"],
            ExportFormat::Ggb => &["ggb"],
            ExportFormat::Tikz => &["tikz"],
            ExportFormat::Pptx => &["pptx"],
            ExportFormat::Pylinkage => &["py"],
            ExportFormat::PylinkageJson => &["json"],
            ExportFormat::Pmks => &["txt", "csv"],
        }
    }

    /// Returns the format of files with an ending.
    pub fn of_ending(ending: &str) -> Option<ExportFormat> {
        ExportFormat::ALL.into_iter().find(|f| f.endings().contains(&ending))
    }

    /// Checks that files of a kind can be written in the format.
    ///
    /// # Errors
    /// `not-a-scene` for a format of mechanisms and another kind of file.
    pub fn granted(self, kind: Kind) -> Result<(), Diagnostic> {
        match self {
            ExportFormat::Dxf | ExportFormat::Tikz => Ok(()),
            ExportFormat::Ggb
            | ExportFormat::Pptx
            | ExportFormat::Pylinkage
            | ExportFormat::PylinkageJson
            | ExportFormat::Pmks => kind.grants(Wish::Mechanism),
        }
    }
}

impl ImportFormat {
    /// All formats, in the order of a list.
    pub const ALL: [ImportFormat; 2] = [ImportFormat::Pylinkage, ImportFormat::Pmks];

    /// The name.
    pub fn name(self) -> &'static str {
        match self {
            ImportFormat::Pylinkage => "pylinkage",
            ImportFormat::Pmks => "pmks",
        }
    }

    /// Returns the format of a name.
    pub fn named(name: &str) -> Option<ImportFormat> {
        ImportFormat::ALL.into_iter().find(|f| f.name() == name)
    }

    /// Returns the format of a file, by the ending of its name, else by its text.
    pub fn of(ending: Option<&str>, text: &str) -> ImportFormat {
        match ending {
            Some("json") => ImportFormat::Pylinkage,
            Some("txt" | "csv") => ImportFormat::Pmks,
            _ if text.trim_start().starts_with('{') => ImportFormat::Pylinkage,
            _ => ImportFormat::Pmks,
        }
    }
}

/// Returns a solved file in a format: of DXF and TikZ one figure of it.
///
/// # Errors
/// `not-a-scene`; `export` for parts that the format does not have; the value `output` if the figure
/// has several pages; those of the figures.
pub fn export(
    solved: &Solved,
    format: ExportFormat,
    figure: &'static FigureEntry,
    look: &Look,
) -> Result<Warned<Vec<u8>>, RangeFault> {
    let alone = |text: String| Warned { value: text.into_bytes(), notes: Vec::new() };
    let linkage = || {
        let (scene, worked) = solved.needed_mechanism()?;
        let (lang, _) = look.of(scene.language, None);
        Linkage::of(scene, worked, lang.of(&scene.title).to_owned())
    };
    Ok(match (format, solved.mechanism()) {
        (ExportFormat::Dxf, Some((scene, worked))) if figure.name == MECHANISM.name => {
            let options = look.sheet_of(scene);
            alone(mechanism(scene, worked, &options.style, &options.notation))
        }
        (ExportFormat::Dxf, _) => {
            only(solved, figure, look)?.map(|figure| drawing(&figure).into_bytes())
        }
        (ExportFormat::Tikz, _) => {
            let Warned { value, notes } = only(solved, figure, look)?;
            Warned { value: tikz::tikz(&value)?.into_bytes(), notes }
        }
        (ExportFormat::Pptx, _) => slides(solved, look)?,
        (ExportFormat::Ggb, _) => Warned { value: geogebra::ggb(&linkage()?)?, notes: Vec::new() },
        (ExportFormat::Pylinkage, _) => alone(pylinkage::script(&linkage()?)?),
        (ExportFormat::PylinkageJson, _) => alone(pylinkage::file(&linkage()?)?),
        (ExportFormat::Pmks, _) => alone(pmks::text(&linkage()?)),
    })
}

/// Draws a figure of one page.
fn only(
    solved: &Solved,
    figure: &'static FigureEntry,
    look: &Look,
) -> Result<Warned<Figure>, RangeFault> {
    let pictures = Pictures { figures: &[figure], ..Pictures::default() };
    let Warned { mut value, notes } = solved.figures(&pictures, look)?;
    match (value.pop(), value.len()) {
        (Some((_, figure)), 0) => Ok(Warned { value: figure, notes }),
        (_, more) => {
            let message = both!("the file takes one figure; {} are asked for", more + 1);
            let help = both!("ask for one with --figure, such as --figure velocity");
            let d = Diagnostic::error("output", message).help(help);
            Err(WrongValue::new("output", "", d).into())
        }
    }
}

#[cfg(feature = "png")]
fn slides(solved: &Solved, look: &Look) -> Result<Warned<Vec<u8>>, Faults> {
    let (scene, worked) = solved.needed_mechanism()?;
    let (options, extras) = (look.sheet_of(scene), Extras::default());
    super::pptx::pptx(&FigureInput { scene, worked, options: &options, extras: &extras })
}

/// Refuses slides: each has a PNG beside its SVG.
#[cfg(not(feature = "png"))]
fn slides(_: &Solved, _: &Look) -> Result<Warned<Vec<u8>>, Faults> {
    let message = both!("slides need the writer of PNG");
    Err(Diagnostic::error("export", message).into())
}

/// Returns the scene of a linkage in the format of another program.
///
/// # Errors
/// Faults of the text, each at its place.
pub fn import(text: &str, format: ImportFormat) -> Result<ImportedLinkage, Faults> {
    let linkage = match format {
        ImportFormat::Pylinkage => pylinkage::read(text),
        ImportFormat::Pmks => pmks::read(text),
    }?;
    Ok(scene(&linkage))
}
