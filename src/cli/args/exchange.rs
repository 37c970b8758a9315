//! Arguments of the exchange with other programs.

use super::{ClapArgs, CommonArgs, LookArgs};
use crate::cli::values::figures;
use crate::exchange::{ExportFormat, ImportFormat};
use crate::figure::list::FigureEntry;

#[derive(ClapArgs, Debug)]
#[command(
    after_help = "dxf: the mechanism in the millimetres of the scene, other figures in those of the paper. ggb: GeoGebra, the crank can be dragged. tikz: a picture for LaTeX. pptx: a slide for each step of the construction. pylinkage: a Python script; pylinkage-json: the file of its module `mechanism`. pmks: the text of PMKS. ggb, pylinkage and pmks take linkages with pins and straight guides, one crank on the ground"
)]
pub struct ExportArgs {
    #[command(flatten)]
    pub common: CommonArgs,
    /// The file, or `-` for standard output; its ending decides: .dxf, .ggb, .tikz, .pptx, .py and
    /// .json (pylinkage), .txt and .csv (PMKS)
    #[arg(short, long, value_name = "FILE")]
    pub output: String,
    /// Format where the ending does not say it
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub to: Option<ExportFormat>,
    /// For dxf and tikz: the figure
    #[arg(long, value_parser = figures(), default_value = "mechanism")]
    pub figure: &'static FigureEntry,
    #[command(flatten)]
    pub look: LookArgs,
}

#[derive(ClapArgs, Debug)]
pub struct ImportArgs {
    /// The linkage of another program: .json of pylinkage (`mechanism_to_json`), .txt or .csv of
    /// PMKS; `-` reads standard input
    #[arg(value_name = "FILE")]
    pub file: String,
    /// Format where the ending does not say it
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub from: Option<ImportFormat>,
    /// Write the scene to this file (default: `-`, standard output)
    #[arg(short, long, value_name = "FILE", default_value = "-", hide_default_value = true)]
    pub output: String,
}
