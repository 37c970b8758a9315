//! Arguments of homework: variants of a problem, and the marking of answers.

use super::{ClapArgs, CommonArgs, LookArgs};
use crate::cli::values::digits;
use crate::homework::platforms::Platform;

#[derive(ClapArgs, Debug)]
#[command(
    after_help = "Files in the folder: problems.pdf, solutions.pdf, answers.csv (the key, with the values of typical mistakes), values.csv (the varied values)"
)]
pub struct VariantsArgs {
    #[command(flatten)]
    pub common: CommonArgs,
    /// The varied parameters with round values, each NAME=FROM..TO/STEP, such as l_AB=80..120/5, or
    /// NAME=FROM..TO:N for N values
    #[arg(long, value_name = "RANGE", num_args = 1.., allow_hyphen_values = false)]
    pub vary: Vec<String>,
    /// Number of variants, up to 200 (default: one for each name of --roster, else 30)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=200))]
    pub count: Option<u16>,
    /// Seed of the choice: the same seed gives the same files
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// Names of students as CSV, one in each line or in the column `name`: each gets a variant
    #[arg(long, value_name = "FILE")]
    pub roster: Option<String>,
    /// Also the questions for learning platforms, such as moodle,qti3: numerical questions with the
    /// pencil's tolerance, the picture, and feedback for typical mistakes
    #[arg(long, value_enum, value_delimiter = ',', value_name = "LIST")]
    pub to: Vec<Platform>,
    /// Also frames.pdf, a sheet to draw on for each variant: the mechanism to scale, poles, scales,
    /// and the space that the polygons need; and overlays.pdf, the solutions to lay over them
    #[arg(long)]
    pub frame: bool,
    /// Format of the pages of --frame, such as a4, a4-landscape, a3
    #[arg(long, value_name = "FORMAT", requires = "frame", default_value = "a4")]
    pub page: String,
    /// Folder of the files
    #[arg(short, long, value_name = "FOLDER")]
    pub output: String,
    #[command(flatten)]
    pub look: LookArgs,
    /// Significant digits of the solutions, 1 to 30
    #[arg(long, default_value_t = crate::figure::results::DIGITS, value_parser = digits)]
    pub digits: usize,
}

#[derive(ClapArgs, Debug)]
#[command(
    after_help = "Columns of the answers: student,variant,question,value,unit. Values have a decimal point; a rotation is positive counter-clockwise, or is followed by cw or ccw; of a vector the magnitude is asked for"
)]
pub struct MarkArgs {
    /// The answers of the class as CSV
    #[arg(value_name = "ANSWERS")]
    pub answers: String,
    /// The answers.csv of `hodograph variants`
    #[arg(long, value_name = "FILE")]
    pub keys: String,
    /// Write the marks to this CSV file (default: `-`, standard output)
    #[arg(short, long, value_name = "FILE", default_value = "-", hide_default_value = true)]
    pub output: String,
}
