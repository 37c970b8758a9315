//! Further arguments: what moves, and those of the commands that draw a motion.

use super::{ClapArgs, CommonArgs, FigureFormat, LookArgs, dpi, seconds};
use crate::cli::values::{ComparisonFormat, MotionFormat, cycle_forms};
use crate::figure::cycle::CycleForm;

/// The motion from pose to pose.
#[derive(ClapArgs, Debug)]
pub struct TravelArgs {
    /// The motion: a driver by its name (`phi_1`, `s_B`, `l_BC`, `driver2`), the others at rest; or
    /// `t`, the time: all drivers, each by its law or at its rate (default: the time where the
    /// scene has laws of it, else the first driver)
    #[arg(long, value_name = "NAME")]
    pub over: Option<String>,
}

#[derive(ClapArgs, Debug)]
#[command(
    after_help = "The numbers of the curves as a table: hodograph sweep SCENE --find x_E,y_E,v_E,a_E -o curves.csv"
)]
pub struct PathArgs {
    #[command(flatten)]
    pub common: CommonArgs,
    /// The points whose paths are drawn, such as E or E,F
    #[arg(long, value_name = "POINTS", value_delimiter = ',', required = true)]
    pub point: Vec<String>,
    /// A moving link: the paths as they are seen from it, drawn on it in the pose of the scene
    #[arg(long, value_name = "LINK")]
    pub against: Option<String>,
    /// The mechanism in so many positions at equal steps of the driver, one over another
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u16).range(0..=72))]
    pub poses: u16,
    /// Number of positions at equal steps of the driver, numbered alike on paths and hodographs
    /// (default: those of --poses, else 12)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=72))]
    pub marks: Option<u16>,
    #[command(flatten)]
    pub moves: TravelArgs,
    #[command(flatten)]
    pub look: LookArgs,
    /// The file, ending in .svg, .png, .pdf or .tikz, or `-` for standard output (default: named after the
    /// scene)
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<String>,
    /// Formats where -o has no such ending, such as svg,pdf,tikz; each ending is added where there are
    /// several (default: svg)
    #[arg(long, value_enum, value_delimiter = ',', value_name = "LIST")]
    pub format: Vec<FigureFormat>,
}

#[derive(ClapArgs, Debug)]
#[command(
    after_help = "A film from the frames: ffmpeg -framerate 12 -i turn-%03d.png -pix_fmt yuv420p turn.mp4"
)]
pub struct AnimateArgs {
    #[command(flatten)]
    pub common: CommonArgs,
    /// Positions at equal steps of the driver, through a full turn, or from one end of its travel
    /// to the other and back
    #[arg(long, value_name = "N", default_value_t = 72, value_parser = clap::value_parser!(u16).range(2..=360))]
    pub frames: u16,
    /// Duration of one period, in seconds
    #[arg(long, value_name = "S", default_value_t = 6.0, value_parser = seconds)]
    pub seconds: f64,
    #[command(flatten)]
    pub moves: TravelArgs,
    #[command(flatten)]
    pub look: LookArgs,
    /// Resolution of GIF and PNG in dots per inch; both sides have an even number of pixels
    #[arg(long, default_value_t = 96.0, value_parser = dpi)]
    pub dpi: f64,
    /// The file, ending in .gif, .svg (it moves by itself in browsers) or .png (one for each frame:
    /// turn-001.png, …), or `-` for standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: String,
    /// Formats where -o has no such ending, such as gif,svg; each ending is added where there are
    /// several (default of `-o -`: svg)
    #[arg(long, value_enum, value_delimiter = ',', value_name = "LIST")]
    pub format: Vec<MotionFormat>,
}

#[derive(ClapArgs, Debug)]
#[command(
    after_help = "Outputs and quantities of the same name are compared: give the designs the same letters and link numbers"
)]
pub struct CompareArgs {
    /// The scene files, two or more; `-` reads standard input
    #[arg(value_name = "SCENE", required = true, num_args = 2..)]
    pub scenes: Vec<String>,
    /// Give a parameter that all scenes have another value: NAME=VALUE; a bare number keeps the
    /// unit
    #[arg(long, value_name = "NAME=VALUE")]
    pub set: Vec<String>,
    /// Notation profile: en (pole o, superscripts c, rel) or cn (pole p, superscripts k, r)
    #[arg(long, value_parser = clap::builder::PossibleValuesParser::new(["en", "cn"]))]
    pub notation: Option<String>,
    /// The driver of each scene that moves, by its name (`phi_1`, `s_B`, `l_BC`, `driver2`); the
    /// others are at rest
    #[arg(long, value_name = "NAME")]
    pub over: Option<String>,
    /// Other questions than the scenes', such as v_C,a_C
    #[arg(long, value_name = "LIST")]
    pub find: Option<String>,
    #[command(flatten)]
    pub look: LookArgs,
    /// Write the diagram to this file, ending in .svg, .png, .pdf or .tikz, or the table, ending in
    /// .csv or .json; `-` for standard output (default: the table as text)
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<String>,
    /// Formats where -o has no such ending, such as svg,csv; each ending is added where there are
    /// several (default of `-o -`: svg)
    #[arg(long, value_enum, value_delimiter = ',', value_name = "LIST", requires = "output")]
    pub format: Vec<ComparisonFormat>,
    /// Print the table as JSON, in SI
    #[arg(long)]
    pub json: bool,
}

#[derive(ClapArgs, Debug)]
#[command(
    after_help = "The forward stroke is the slower one; of a cam's follower and of strokes of one duration, that in which the coordinate grows"
)]
pub struct CycleArgs {
    #[command(flatten)]
    pub common: CommonArgs,
    /// The driver that moves, by its name (`phi_1`, `s_B`, `l_BC`, `driver2`); the others are at
    /// rest
    #[arg(long, value_name = "NAME")]
    pub over: Option<String>,
    /// The outputs, such as phi_3,s_C (default: all links on a pivot and sliders on a guide of the
    /// ground)
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    pub find: Vec<String>,
    /// Form of the diagram
    #[arg(long, value_parser = cycle_forms(), default_value = "bars")]
    pub form: CycleForm,
    #[command(flatten)]
    pub look: LookArgs,
    /// The diagram, in a file ending in .svg, .png, .pdf or .tikz, or on `-`, standard output, in
    /// place of the table
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<String>,
    /// Formats where -o has no such ending, such as svg,pdf,tikz; each ending is added where there are
    /// several (default of `-o -`: svg)
    #[arg(long, value_enum, value_delimiter = ',', value_name = "LIST", requires = "output")]
    pub format: Vec<FigureFormat>,
    /// Print the phases as JSON, in SI
    #[arg(long)]
    pub json: bool,
}
