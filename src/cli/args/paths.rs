//! Further arguments: those of the commands on curvature, inversions and synthesis.

use super::CommonArgs;
use clap::Args as ClapArgs;

#[derive(ClapArgs, Debug)]
#[command(
    after_help = "The figures: hodograph draw SCENE --figure curvature,centrodes -o out/; in find: rho_E O_E J_2 d_2 K_2 u_2 p_2"
)]
pub struct CurvatureArgs {
    #[command(flatten)]
    pub common: CommonArgs,
    /// The links (default: all that neither turn about a fixed pin nor slide on the ground)
    #[arg(long, value_name = "N", value_delimiter = ',')]
    pub link: Vec<String>,
    /// From which link the motion is seen (default: the ground)
    #[arg(long, value_name = "M")]
    pub against: Option<String>,
    /// The points whose paths are asked (default: all points of the links)
    #[arg(long, value_name = "POINTS", value_delimiter = ',')]
    pub point: Vec<String>,
    /// The construction with the ruler, step by step
    #[arg(long)]
    pub steps: bool,
    /// The tolerance of each place and length when drawn by hand, with a pencil error such as 0.1mm
    /// (default: the scene's, else 0.1 mm)
    #[arg(long, value_name = "LENGTH", num_args = 0..=1, default_missing_value = "", value_parser = crate::cli::values::length)]
    pub drafting: Option<String>,
    /// Print JSON, in SI
    #[arg(long)]
    pub json: bool,
    /// With the paths of the pole in both planes
    #[arg(long, requires = "json")]
    pub centrodes: bool,
}

#[derive(ClapArgs, Debug)]
#[command(
    after_help = "Side by side as a figure: hodograph draw SCENE --figure inversions -o inversions.svg"
)]
pub struct InversionsArgs {
    #[command(flatten)]
    pub common: CommonArgs,
    /// Write the scene of each inversion into this folder, or that of --pick to this file ending in
    /// .json or to `-`, standard output
    #[arg(short, long, value_name = "PATH")]
    pub output: Option<String>,
    /// The inversion with this link as ground alone; without -o its scene is printed
    #[arg(long, value_name = "LINK")]
    pub pick: Option<String>,
    /// Print JSON, in SI
    #[arg(long, conflicts_with = "pick")]
    pub json: bool,
}
