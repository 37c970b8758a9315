//! Arguments of the commands that report on a scene and take nothing more than how.

use super::{ClapArgs, CommonArgs};

#[derive(ClapArgs, Debug)]
#[command(
    after_help = "The figure with the circle diagram: hodograph draw SCENE --figure centres -o centres.svg"
)]
pub struct CentresArgs {
    #[command(flatten)]
    pub common: CommonArgs,
    /// The tolerance of each place when drawn by hand, with a pencil error such as 0.1mm (default:
    /// the scene's, else 0.1 mm)
    #[arg(long, value_name = "LENGTH", num_args = 0..=1, default_missing_value = "", value_parser = crate::cli::values::length)]
    pub drafting: Option<String>,
    /// Print JSON, in SI
    #[arg(long)]
    pub json: bool,
}

#[derive(ClapArgs, Debug)]
#[command(
    after_help = "The figure with the parallelograms: hodograph draw SCENE --figure composite -o composite.svg"
)]
pub struct CompositeArgs {
    #[command(flatten)]
    pub common: CommonArgs,
    /// Print JSON, in SI
    #[arg(long)]
    pub json: bool,
}

#[derive(ClapArgs, Debug)]
#[command(
    after_help = "The loops as arrows on the mechanism: hodograph draw SCENE --figure loops -o loops.svg"
)]
pub struct LoopsArgs {
    #[command(flatten)]
    pub common: CommonArgs,
    /// Print JSON, in SI and radians
    #[arg(long)]
    pub json: bool,
}

#[derive(ClapArgs, Debug)]
#[command(
    after_help = "Each wrong solution drawn over the right one: hodograph draw SCENE --figure attempts -o attempts.svg"
)]
pub struct AttemptsArgs {
    #[command(flatten)]
    pub common: CommonArgs,
    /// All typical mistakes of the scene, though it names some
    #[arg(long)]
    pub all: bool,
    /// Print JSON, in SI
    #[arg(long)]
    pub json: bool,
}

#[derive(ClapArgs, Debug)]
pub struct ReadingsArgs {
    #[command(flatten)]
    pub common: CommonArgs,
    /// Print JSON, in SI
    #[arg(long)]
    pub json: bool,
}

#[derive(ClapArgs, Debug)]
pub struct LimitsArgs {
    #[command(flatten)]
    pub common: CommonArgs,
    /// The driver that moves, by its name (`phi_1`, `s_B`, `l_BC`, `driver2`); the others are at
    /// rest
    #[arg(long, value_name = "NAME")]
    pub over: Option<String>,
    /// These quantities instead: highest and lowest value of each and its zeros over the whole
    /// motion, such as v_C,a_C
    #[arg(long, value_name = "LIST", conflicts_with_all = ["ranges", "flywheel"])]
    pub find: Option<String>,
    /// For a four-bar: the ranges of each length, the three others held, for each of Grashof's
    /// types
    #[arg(long, conflicts_with = "flywheel")]
    pub ranges: bool,
    /// With the scene's loads: the flywheel on the driver's shaft for this coefficient of speed
    /// fluctuation, such as 1/30
    #[arg(long, value_name = "DELTA")]
    pub flywheel: Option<String>,
    /// Print JSON, in SI
    #[arg(long)]
    pub json: bool,
}

#[derive(ClapArgs, Debug)]
#[command(
    after_help = "Teeth of the basic rack of ISO 53: pressure angle 20°, addendum 1 m, clearance 0.25 m"
)]
pub struct TeethArgs {
    /// A scene in which the teeth of one gear are unknown; `-` reads standard input
    #[arg(value_name = "SCENE", requires_all = ["gear", "want"])]
    pub scene: Option<String>,
    /// With a scene: the link of the gear
    #[arg(long, value_name = "LINK", requires = "scene")]
    pub gear: Option<String>,
    /// With a scene: the wanted angular velocity or ratio, such as omega_5=3rad/s or i_52=3
    #[arg(long, value_name = "NAME=VALUE", requires = "scene")]
    pub want: Option<String>,
    /// The ratio z2/z1 of at least 1, or that of the whole train, such as 3.15 or 63/20
    #[arg(long, value_name = "I", required_unless_present = "scene", conflicts_with = "scene")]
    pub ratio: Option<String>,
    /// Greatest deviation of the ratio
    #[arg(long, value_name = "PART", default_value = "1%")]
    pub within: String,
    /// Least and greatest number of teeth
    #[arg(long, value_name = "LEAST..MOST", default_value = "17..120")]
    pub teeth: String,
    /// Centre distance of the pair, such as 150mm
    #[arg(long, value_name = "LENGTH", conflicts_with = "stages")]
    pub distance: Option<String>,
    /// Modules to try, in mm (default: 1 to 10 of the first series of ISO 54)
    #[arg(long, value_name = "LIST", value_delimiter = ',', requires = "distance")]
    pub module: Vec<f64>,
    /// Least and greatest sum of the profile shifts of a spur pair
    #[arg(
        long,
        value_name = "LEAST..MOST",
        default_value = "-0.5..1.5",
        allow_hyphen_values = true
    )]
    pub shifts: String,
    /// Least and greatest helix angle of a helical pair, in degrees
    #[arg(long, value_name = "LEAST..MOST", default_value = "8..20")]
    pub helix: String,
    /// Number of stages of a train
    #[arg(long, value_name = "N")]
    pub stages: Option<usize>,
    /// Ratio of a stage over that of the next slower one
    #[arg(long, value_name = "FACTOR", default_value_t = 1.3)]
    pub taper: f64,
    /// Greatest number of solutions, the best first
    #[arg(long, value_name = "N", default_value_t = 20)]
    pub count: usize,
    /// Print JSON, in SI
    #[arg(long)]
    pub json: bool,
}
