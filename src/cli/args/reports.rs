//! Arguments of the commands that report on a scene and take nothing more than how.

use super::{ClapArgs, Common};

#[derive(ClapArgs, Debug)]
#[command(after_help = "The figure with the circle diagram: hodograph draw SCENE --figure centres -o centres.svg")]
pub struct Centres {
    #[command(flatten)]
    pub common: Common,
    /// As JSON, in SI
    #[arg(long)]
    pub json: bool,
}

#[derive(ClapArgs, Debug)]
#[command(after_help = "The figure with the parallelograms: hodograph draw SCENE --figure composite -o composite.svg")]
pub struct Composite {
    #[command(flatten)]
    pub common: Common,
    /// As JSON, in SI
    #[arg(long)]
    pub json: bool,
}

#[derive(ClapArgs, Debug)]
#[command(after_help = "Each wrong solution drawn over the right one: hodograph draw SCENE --figure attempts -o attempts.svg")]
pub struct Attempts {
    #[command(flatten)]
    pub common: Common,
    /// All typical mistakes of the scene, though it names some
    #[arg(long)]
    pub all: bool,
    /// As JSON, in SI
    #[arg(long)]
    pub json: bool,
}

#[derive(ClapArgs, Debug)]
pub struct Readings {
    #[command(flatten)]
    pub common: Common,
    /// As JSON, in SI
    #[arg(long)]
    pub json: bool,
}
