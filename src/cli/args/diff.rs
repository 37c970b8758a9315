//! The arguments of `diff`.

use super::ClapArgs;
use crate::cli::values::tolerance;

#[derive(ClapArgs, Debug)]
#[command(
    after_help = "Exit codes, as of diff(1): 0 the figures are alike; 1 they differ; 2 a file cannot be read or written"
)]
pub struct DiffArgs {
    /// The figure as it was: SVG or PNG
    #[arg(value_name = "A")]
    pub old: String,
    /// The figure as it is, of the same kind
    #[arg(value_name = "B")]
    pub new: String,
    /// Write both over one another to this file ending in .png: A alone red, B alone blue, what
    /// both have grey
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<String>,
    /// Millimetres by which an item may have moved (default: 0.01); where it is given, pixels
    /// decide only if `--pixels` is given too
    #[arg(long, value_name = "MM", value_parser = tolerance)]
    pub tolerance: Option<f64>,
    /// Number of pixels that may differ by more than one step of a channel (default: 0)
    #[arg(long, value_name = "N")]
    pub pixels: Option<usize>,
    /// The differences as JSON
    #[arg(long)]
    pub json: bool,
}
