//! The arguments of every command.

mod batch;
mod diff;
mod exchange;
mod homework;
mod motion;
mod paths;
mod reports;

use super::values::{
    FaultFormat, FigureFormat, Language, PointVectors, SheetFormat, TableFormat, TextFormat,
    digits, dpi, figures, length, methods, seconds, steps,
};
use crate::figure::list::{FigureEntry, USUAL};
use crate::figure::stepped::ConstructionMethod;
pub use batch::{BatchArgs, ShardsArgs, VariedArgs};
use clap::{Args as ClapArgs, Parser, Subcommand};
pub use diff::DiffArgs;
pub use exchange::{ExportArgs, ImportArgs};
pub use homework::{MarkArgs, VariantsArgs};
pub use motion::{AnimateArgs, CompareArgs, CycleArgs, PathArgs, TravelArgs};
pub use paths::{CurvatureArgs, InversionsArgs};
pub use reports::{
    AttemptsArgs, CentresArgs, CompositeArgs, LimitsArgs, LoopsArgs, ReadingsArgs, TeethArgs,
};
use serde::{Deserialize, Serialize};

/// Solves planar mechanisms the way they are solved at the drawing board.
#[derive(Parser, Debug)]
#[command(
    name = "hodograph",
    version,
    about,
    max_term_width = 110,
    after_help = "Start: hodograph new shaper > shaper.json && hodograph draw shaper.json -o out/\n\nExit codes: 0 done; 1 a file could not be written (of `diff`: the figures differ; of `shards verify`: parts are missing or damaged); 2 something is wrong with the scene; 3 drawing and analysis disagree (an error of ours); 4 done, but for answers that do not exist in the pose (dead centres)"
)]
pub struct Args {
    /// Language of the output (default: the scene's, else en)
    #[arg(long, value_enum, global = true)]
    pub lang: Option<Language>,
    /// Form of faults, warnings and notes on standard error: text, or one JSON document for the run
    /// (`hodograph schema --diagnostics`)
    #[arg(long, value_enum, global = true, default_value_t = FaultFormat::Text, hide_possible_values = true, hide_default_value = true, value_name = "text|json")]
    pub errors: FaultFormat,
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Subcommand, Debug)]
pub enum Command {
    /// Draw the sheet: mechanism, equation tables, velocity and acceleration polygons, results
    /// (SVG, PNG, PDF, TikZ)
    Draw(DrawArgs),
    /// Write a lesson: one HTML page with the construction step by step and a crank to drag
    Lesson(LessonArgs),
    /// Answer the scene's questions: values, units, senses, drawing against analysis; at a change
    /// point both motions
    Solve(SolveArgs),
    /// Write the vector equations in solving order, and why each effect is in or out; as JSON, also
    /// what work was done
    Plan(PlanArgs),
    /// Write a worksheet: the problem as it is set, and its solution step by step (PDF, HTML,
    /// Markdown, Typst)
    Worksheet(WorksheetArgs),
    /// Homework: the problem with other round numbers for each student, all sheets and all
    /// solutions as one PDF each, and the answers as CSV
    Variants(VariantsArgs),
    /// Mark the answers of a class by the keys of `variants`: partial credit by the pencil's
    /// tolerance, and the likely mistake
    Mark(MarkArgs),
    /// Measure what accuracy costs: every way to this scene's answers with its error and its time,
    /// as a table and a figure
    Accuracy(AccuracyArgs),
    /// Sweep a driver or a parameter: the answers at all positions, as a table (CSV, JSON, NumPy,
    /// Parquet)
    Sweep(SweepArgs),
    /// Vary parameters over a grid or at random: many mechanisms, at one or many positions each,
    /// into one table (CSV, NumPy, Parquet)
    Batch(BatchArgs),
    /// Check and join the parts of a batch that many machines or tasks compute (`batch --shard`)
    Shards(ShardsArgs),
    /// Line diagrams: displacement, velocity, acceleration against the position of the driver or
    /// the time, extremes marked
    Curves(CurvesArgs),
    /// Compare designs: several scenes side by side in one table (extremes, means, strokes, time
    /// ratios, transmission angles) and one diagram with a curve for each
    Compare(CompareArgs),
    /// Motion cycle: working strokes, returns and dwells of the outputs over a cycle of the driver,
    /// as a table and a diagram (bars, straight lines, rings)
    Cycle(CycleArgs),
    /// Paths of points (coupler curves) on the mechanism, and the hodographs of their velocities
    /// and accelerations
    Path(PathArgs),
    /// The motion as a moving picture: mechanism and polygons through the travel of a driver or
    /// through time (GIF, moving SVG, numbered PNG)
    Animate(AnimateArgs),
    /// A disc cam over a whole turn: displacement, velocity, acceleration, shocks, pressure angle,
    /// curvature; its profile (CSV, DXF)
    Cam(CamArgs),
    /// Ranges of the driver, extreme positions and strokes, time ratio, transmission angles,
    /// Grashof's type
    Limits(LimitsArgs),
    /// Count freedoms: links and pairs, compound hinges, local freedoms, virtual constraints,
    /// groups for each possible driver
    Mobility(MobilityArgs),
    /// Instantaneous centres of velocity: how each is found, where it lies, and the speeds that
    /// they tell
    Centres(CentresArgs),
    /// Inversions: each link of the chain as ground in turn, with Grashof's type, what turns fully,
    /// strokes, and Willis' ratios of gears; each a scene
    Inversions(InversionsArgs),
    /// Curvature of paths: pole, inflection circle, centres of curvature (Bobillier, Euler-Savary),
    /// acceleration pole, Ball's point
    Curvature(CurvatureArgs),
    /// Composite motion of a point: which moving points and frames serve and why not, and the parts
    /// of the motion
    Composite(CompositeArgs),
    /// The analytic method written out: vector loops, their real and imaginary parts, positions,
    /// velocities and accelerations as formulas with numbers
    Loops(LoopsArgs),
    /// Numbers of teeth for a ratio: all pairs for a centre distance (spur with profile shifts,
    /// helical), or trains of several stages with the ratio of each
    Teeth(TeethArgs),
    /// Wrong solutions: where typical mistakes can be made in this scene, what comes of them, and
    /// why they are wrong
    Attempts(AttemptsArgs),
    /// Design a linkage from a synthesis file: all candidates with lengths, errors, defects and
    /// transmission angles, each a scene
    Synth(super::synth::SynthArgs),
    /// Readings of a statement whose figure is lost: the answers of each, and which gives what was
    /// printed
    Readings(ReadingsArgs),
    /// Write a template's scene, with other parameters if wanted
    New {
        /// Name of the template (see `hodograph templates`)
        template: Option<String>,
        /// Give a parameter another value: NAME=VALUE; a bare number keeps the unit
        #[arg(long, value_name = "NAME=VALUE")]
        set: Vec<String>,
        /// Write to this file (default: `-`, standard output)
        #[arg(short, long, value_name = "FILE")]
        output: Option<String>,
    },
    /// Compare two figures (SVG, PNG): vectors that moved, items, texts, pixels; exit code 1 where
    /// they differ
    Diff(DiffArgs),
    /// Write the file of another program: drawing (DXF), GeoGebra, TikZ, slides (PPTX), linkage of
    /// pylinkage or PMKS
    Export(ExportArgs),
    /// Read a linkage of pylinkage or PMKS, and write its scene
    Import(ImportArgs),
    /// Preprocessor of mdBook: fenced scenes (```hodograph) become drawings; mdBook calls it, by
    /// [preprocessor.hodograph] command = "hodograph mdbook"
    Mdbook {
        /// `supports` asks if a renderer is supported
        #[arg(value_name = "supports")]
        asked: Option<String>,
        /// The renderer, such as html
        #[arg(requires = "asked")]
        renderer: Option<String>,
    },
    /// Edit a file in the browser: the page at an address of this machine, saving to the file and
    /// following its changes by other editors
    Edit(EditArgs),
    /// List the templates with their parameters
    Templates,
    /// Explain a fault, warning or note by its code: cause and cure; or list all codes
    Explain(super::explain::ExplainArgs),
    /// Print the JSON Schema of the scene format
    Schema {
        /// The schema of the synthesis file instead
        #[arg(long)]
        synthesis: bool,
        /// The schema of files of motions without a mechanism
        #[arg(long, conflicts_with = "synthesis")]
        motions: bool,
        /// The schema of files of a vector equation
        #[arg(long, conflicts_with_all = ["synthesis", "motions"])]
        equation: bool,
        /// The schema of the answers of `solve --json` and `synth --json`
        #[arg(long, conflicts_with_all = ["synthesis", "motions", "equation"])]
        solved: bool,
        /// The schema of faults, warnings and notes with `--errors json`
        #[arg(long, conflicts_with_all = ["synthesis", "motions", "equation", "solved"])]
        diagnostics: bool,
    },
}

/// Arguments of all commands on a scene.
#[derive(ClapArgs, Debug)]
pub struct CommonArgs {
    /// The scene file; `-` reads standard input
    #[arg(value_name = "SCENE")]
    pub scene: String,
    /// Give a parameter of the scene another value, or `t`, the instant of laws of time:
    /// NAME=VALUE; a bare number keeps the unit
    #[arg(long, value_name = "NAME=VALUE")]
    pub set: Vec<String>,
    /// Notation profile: en (pole o, superscripts c, rel) or cn (pole p, superscripts k, r)
    #[arg(long, value_parser = clap::builder::PossibleValuesParser::new(["en", "cn"]))]
    pub notation: Option<String>,
}

/// The appearance of figures.
#[derive(ClapArgs, Debug)]
pub struct LookArgs {
    /// Style: print (black on white), slides (a colour for each link), dark, or a style file ending
    /// in .json
    #[arg(long, value_name = "STYLE", default_value = "print")]
    pub style: String,
    /// A font of your own (.otf, .ttf) for letters, digits and words; twice for an upright and an
    /// italic one; before those of the style. What it lacks is set in the bundled fonts
    #[arg(long, value_name = "FILE")]
    pub font: Vec<String>,
    /// Before all ids of an SVG, so that several figures fit into one page: a letter, then letters,
    /// digits, - or _, such as fig1-
    #[arg(long, value_name = "PREFIX", default_value = "", hide_default_value = true)]
    pub id_prefix: String,
}

#[derive(ClapArgs, Debug)]
pub struct DrawArgs {
    #[command(flatten)]
    pub common: CommonArgs,
    /// Folder for the files, or one file ending in .svg, .png, .pdf or .tikz, or `-` for standard output;
    /// a folder that is not there yet and has a dot in its name ends in /
    #[arg(short, long, value_name = "PATH", default_value = ".")]
    pub output: String,
    /// Formats of the files, such as svg,pdf,tikz; of a file the ending of -o decides (default: svg,png
    /// into a folder, svg to standard output)
    #[arg(long, value_enum, value_delimiter = ',', value_name = "LIST")]
    pub format: Vec<FigureFormat>,
    /// The figures, each in files of its own: the whole sheet, or parts of it
    #[arg(long, value_parser = figures(), value_delimiter = ',', default_value = USUAL.name)]
    pub figure: Vec<&'static FigureEntry>,
    /// With the mechanism: vectors of this kind at its points
    #[arg(long, value_enum, conflicts_with = "steps")]
    pub vectors: Option<PointVectors>,
    /// Number of positions of the first driver: the sheet becomes a table of them, each with its
    /// mechanism and polygons, all to one set of scales; with `--figure mechanism` they lie behind
    /// the mechanism
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u16).range(0..=72), conflicts_with = "steps")]
    pub poses: u16,
    /// The paths of these points through the travel of the first driver, with the mechanism; with
    /// `--poses` on the sheet, their hodographs behind the polygons too
    #[arg(long, value_name = "POINTS", value_delimiter = ',', conflicts_with = "steps")]
    pub path: Vec<String>,
    /// With the mechanism: the given lengths and angles as dimensions in the scene's units, and
    /// below all else that is given, so that the mechanism can be drawn again from it
    #[arg(long, conflicts_with = "steps")]
    pub dimensions: bool,
    /// Format of the pages: a4, a4-landscape and other ISO sheets; 16:9 or 4:3 for slides; a width
    /// such as 80mm, or with the greatest height 80mmx120mm. Type has the size of the format; what
    /// does not fit goes to further pages a, b, ...
    #[arg(long, value_name = "FORMAT", conflicts_with = "width")]
    pub page: Option<String>,
    /// Width of the page, such as 80mm for a column of a book: type is made smaller as far as it
    /// can be read, then items are left out, with a note; a figure that still does not fit is not
    /// drawn
    #[arg(long, value_name = "LENGTH")]
    pub width: Option<String>,
    /// Letters of an SVG: outlines look the same everywhere; editable text depends on the fonts of
    /// the machine that shows it
    #[arg(long, value_enum, default_value_t = TextFormat::Outlines)]
    pub text: TextFormat,
    /// One picture for each step of the construction, with the step's sentence
    #[arg(long, conflicts_with = "figure")]
    pub steps: bool,
    /// For a synthesis file: the candidate, counted from 1 in the order of `hodograph synth`
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub pick: Option<u64>,
    #[command(flatten)]
    pub look: LookArgs,
    /// Significant digits of the results, 1 to 30; fewer are printed, with the reason, where fewer
    /// are certain
    #[arg(long, default_value_t = crate::figure::results::DIGITS, value_parser = digits)]
    pub digits: usize,
    /// The tolerance of each result when drawn by hand, with a pencil error such as 0.1mm (default:
    /// the scene's, else 0.1 mm)
    #[arg(long, value_name = "LENGTH", num_args = 0..=1, default_missing_value = "", value_parser = length)]
    pub drafting: Option<String>,
    /// Resolution of the PNG in dots per inch
    #[arg(long, default_value_t = 200.0, value_parser = dpi)]
    pub dpi: f64,
}

#[derive(ClapArgs, Debug)]
pub struct EditArgs {
    /// The file: a scene, a synthesis file, or motions without a mechanism
    #[arg(value_name = "SCENE")]
    pub scene: String,
    /// Begin with an empty scene if there is no such file
    #[arg(long)]
    pub new: bool,
    /// Port of the address (default: a free one)
    #[arg(long, value_name = "PORT", default_value_t = 0, hide_default_value = true)]
    pub port: u16,
    /// Only print the address; no browser is started
    #[arg(long)]
    pub no_open: bool,
    /// The page, hodograph.html (default: the one in the program, beside it, or in its checkout)
    #[arg(long, value_name = "FILE")]
    pub page: Option<String>,
}

#[derive(ClapArgs, Debug)]
pub struct LessonArgs {
    #[command(flatten)]
    pub common: CommonArgs,
    /// The page to write, or `-` for standard output (default: named after the scene)
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<String>,
    /// The construction of this method; without it the polygons of what the scene asks for, forces
    /// too
    #[arg(long, value_parser = methods(), conflicts_with = "reveal")]
    pub method: Option<ConstructionMethod>,
    /// A fragment for reveal.js instead: an inline SVG whose parts appear step by step
    #[arg(long, conflicts_with_all = ["positions", "driver", "over"])]
    pub reveal: bool,
    /// The page with the engine inside instead: lengths and other given values can be changed, and
    /// everything is drawn anew
    #[arg(long, conflicts_with_all = ["positions", "driver", "over", "method", "reveal", "pick", "style", "font", "notation"])]
    pub live: bool,
    /// With --live: the page, hodograph.html (default: the one in the program, beside it, or in its
    /// checkout)
    #[arg(long, value_name = "FILE", requires = "live")]
    pub page: Option<String>,
    /// With --reveal: width of the fragment, such as 240mm; drawings and type become smaller, then
    /// drawings stand one below the other
    #[arg(long, value_name = "LENGTH", requires = "reveal")]
    pub width: Option<String>,
    /// Positions through a full turn or the whole travel, 8 to 360; more are added where the motion
    /// bends
    #[arg(long, default_value_t = crate::lesson::POSITIONS as u64, value_parser = clap::value_parser!(u64).range(8..=360))]
    pub positions: u64,
    /// The driver that moves, counted from 1; for a file with `motions`, the motion that is shown
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..), conflicts_with = "over")]
    pub driver: Option<u64>,
    #[command(flatten)]
    pub moves: TravelArgs,
    /// For a synthesis file: the candidate, counted from 1 in the order of `hodograph synth`
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub pick: Option<u64>,
    #[command(flatten)]
    pub look: LookArgs,
}

#[derive(ClapArgs, Debug)]
pub struct SolveArgs {
    #[command(flatten)]
    pub common: CommonArgs,
    /// Answers as JSON, in SI, with both ways and their difference
    #[arg(long)]
    pub json: bool,
    /// Significant digits, 1 to 30; fewer are printed, with the reason, where fewer are certain
    #[arg(long, default_value_t = crate::report::answers::DIGITS, value_parser = digits)]
    pub digits: usize,
    /// Tolerances when drawn by hand, with a pencil error such as 0.1mm (default: the scene's, else
    /// 0.1 mm): of each answer, of each crossing, and the scales for 1 %
    #[arg(long, value_name = "LENGTH", num_args = 0..=1, default_missing_value = "", value_parser = length)]
    pub drafting: Option<String>,
    /// The construction too, step by step, with the lengths measured on paper
    #[arg(long, conflicts_with = "json")]
    pub steps: bool,
}

#[derive(ClapArgs, Debug)]
pub struct PlanArgs {
    #[command(flatten)]
    pub common: CommonArgs,
    /// The plan as JSON, with counters of the work that the questions made: groups, equations,
    /// vectors, unknowns, values
    #[arg(long)]
    pub json: bool,
    /// Lay the sheet out too, so that the labels placed on it are counted
    #[arg(long, requires = "json")]
    pub figure: bool,
    /// Also the points tried for each group, with the unknowns of their equations: solvable or not
    #[arg(long)]
    pub why: bool,
}

#[derive(ClapArgs, Debug)]
pub struct WorksheetArgs {
    #[command(flatten)]
    pub common: CommonArgs,
    /// The file, ending in .pdf, .html, .md or .typ, or `-` for standard output; the last two get
    /// their drawings as SVG files beside them
    #[arg(short, long, value_name = "FILE")]
    pub output: String,
    /// Formats where -o has no such ending, such as pdf,html; each ending is added where there are
    /// several (default of `-o -`: html)
    #[arg(long, value_enum, value_delimiter = ',', value_name = "LIST")]
    pub format: Vec<SheetFormat>,
    /// Only the problem: what is given and wanted, no answer
    #[arg(long, conflicts_with = "solution")]
    pub problem_only: bool,
    /// Only the solution
    #[arg(long)]
    pub solution: bool,
    /// Set a wrong solution as the problem: that which the scene names, else the first typical
    /// mistake; or one by its name
    #[arg(long, value_name = "MISTAKE", num_args = 0..=1, default_missing_value = "")]
    pub find_the_mistake: Option<String>,
    /// Ask for the degree of freedom and the groups instead of the motion: the solution counts,
    /// says why, and draws the groups apart
    #[arg(long, conflicts_with = "find_the_mistake")]
    pub mobility: bool,
    /// Solve by the analytic method: the vector loops, every unknown as a formula with its number
    #[arg(long, conflicts_with_all = ["find_the_mistake", "mobility"])]
    pub loops: bool,
    /// A sheet to draw on instead: the mechanism to scale, poles, scales, and the space that the
    /// polygons need; beside it NAME-overlay.pdf, the solution to lay over it
    #[arg(long, conflicts_with_all = ["problem_only", "solution", "find_the_mistake", "mobility", "loops", "pick", "questions", "table"])]
    pub frame: bool,
    /// Format of the pages of --frame, such as a4, a4-landscape, a3
    #[arg(long, value_name = "FORMAT", requires = "frame", default_value = "a4")]
    pub page: String,
    /// Questions on concepts: degree of freedom and class, number and kinds of the instantaneous
    /// centres, Coriolis accelerations in this pose
    #[arg(long, conflicts_with_all = ["find_the_mistake", "mobility", "loops"])]
    pub questions: bool,
    /// With the solution: the results at N equal steps over the whole motion, in the units of the
    /// scene's answers, else mm, mm/s, mm/s², degrees
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=i64::from(crate::problem::turn::MOST_TABLE_STEPS)), conflicts_with_all = ["problem_only", "mobility", "questions"])]
    pub table: Option<u16>,
    /// For a synthesis file: the candidate, counted from 1 in the order of `hodograph synth`
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub pick: Option<u64>,
    #[command(flatten)]
    pub look: LookArgs,
    /// Significant digits of the results, 1 to 30; fewer are printed, with the reason, where fewer
    /// are certain
    #[arg(long, default_value_t = crate::figure::results::DIGITS, value_parser = digits)]
    pub digits: usize,
}

#[derive(ClapArgs, Debug)]
pub struct AccuracyArgs {
    #[command(flatten)]
    pub common: CommonArgs,
    /// Also a series of poses that approach the nearest limit of the first driver, down to 1e-12
    #[arg(long)]
    pub toward_toggle: bool,
    /// Write the work-precision figure to this file, ending in .svg, .png, .pdf or .tikz, or to `-`,
    /// standard output, in place of the table
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<String>,
    /// Formats where -o has no such ending, such as svg,pdf,tikz; each ending is added where there are
    /// several (default of `-o -`: svg)
    #[arg(long, value_enum, value_delimiter = ',', value_name = "LIST", requires = "output")]
    pub format: Vec<FigureFormat>,
    /// The tables as JSON
    #[arg(long)]
    pub json: bool,
    /// Milliseconds for which each way is repeated; the median of its times counts
    #[arg(long, value_name = "MS", default_value_t = 20, value_parser = clap::value_parser!(u64).range(1..=10_000))]
    pub patience: u64,
    #[command(flatten)]
    pub look: LookArgs,
}

/// A driver's or parameter's values, and what is asked at each.
#[derive(ClapArgs, Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RangeArgs {
    /// The variable: a driver (`driver`, `driver2`, `phi_1`, `s_B`, `l_BC`); for `sweep` and
    /// `curves` also `t`, the time: all drivers, each by its law or at its rate (default where the
    /// scene has laws of time); of `sweep` a parameter of the scene
    #[arg(long, value_name = "NAME")]
    pub over: Option<String>,
    /// The beginning, with a unit (default: 0, or the end of the driver's range)
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    pub from: Option<String>,
    /// The end (default: a full turn, or the end of the driver's range; for the time twice the
    /// scene's instant)
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    pub to: Option<String>,
    /// Equal steps from one to the other; both ends are rows (default: 360; of `batch` none, each
    /// mechanism stands where the scene puts it)
    #[arg(long, value_name = "N", value_parser = steps)]
    pub steps: Option<usize>,
    /// Other questions than the scene's, such as v_E,a_E,omega_3
    #[arg(long, value_name = "LIST")]
    pub find: Option<String>,
}

#[derive(ClapArgs, Debug)]
pub struct SweepArgs {
    #[command(flatten)]
    pub common: CommonArgs,
    #[command(flatten)]
    pub range: RangeArgs,
    /// Units of the columns: `book` (those of the scene's answers, else mm, mm/s, mm/s², degrees),
    /// units such as mm,deg,m/s,r/min, or both (default: SI)
    #[arg(long, value_name = "LIST")]
    pub units: Option<String>,
    /// Write to this file, ending in .csv, .json, .npy or .parquet (default: `-`, standard output)
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<String>,
    /// Format where -o has no such ending (default of standard output: csv)
    #[arg(long, value_enum, value_delimiter = ',', value_name = "FORMAT")]
    pub format: Vec<TableFormat>,
}

#[derive(ClapArgs, Debug)]
pub struct CurvesArgs {
    #[command(flatten)]
    pub common: CommonArgs,
    #[command(flatten)]
    pub range: RangeArgs,
    #[command(flatten)]
    pub look: LookArgs,
    /// The vectors that are asked for, each from one pole, in place of line diagrams: the polar
    /// diagram of a bearing's force, the hodograph of a velocity
    #[arg(long)]
    pub polar: bool,
    /// The file, ending in .svg or .png (all panels over one another) or .pdf (pages of A4), or `-`
    /// for standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: String,
    /// Formats where -o has no such ending, such as svg,pdf,tikz; each ending is added where there are
    /// several (default of `-o -`: svg)
    #[arg(long, value_enum, value_delimiter = ',', value_name = "LIST")]
    pub format: Vec<FigureFormat>,
}

#[derive(ClapArgs, Debug)]
#[command(
    after_help = "Links and pairs are enough: without driver and lengths whatever lengths decide stays open"
)]
pub struct MobilityArgs {
    #[command(flatten)]
    pub common: CommonArgs,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub look: LookArgs,
    /// The groups drawn apart, in a file ending in .svg, .png, .pdf or .tikz, or on `-`, standard output,
    /// in place of the report; the scene must tell its pose
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<String>,
    /// Formats where -o has no such ending, such as svg,pdf,tikz; each ending is added where there are
    /// several (default of `-o -`: svg)
    #[arg(long, value_enum, value_delimiter = ',', value_name = "LIST", requires = "output")]
    pub format: Vec<FigureFormat>,
}

#[derive(ClapArgs, Debug)]
pub struct CamArgs {
    #[command(flatten)]
    pub common: CommonArgs,
    /// Folder for two figures: the motion of the follower, and the profile by inversion
    #[arg(short, long, value_name = "FOLDER")]
    pub output: Option<String>,
    /// Formats of the figures, such as svg,pdf,tikz (default: svg,png)
    #[arg(long, value_enum, value_delimiter = ',', value_name = "LIST")]
    pub format: Vec<FigureFormat>,
    /// Write the profile to this file in millimetres, ending in .csv (a row for each angle) or .dxf
    /// (for a machine that cuts), or to `-`, standard output, as CSV in place of the report
    #[arg(long, value_name = "FILE")]
    pub profile: Option<String>,
    /// Steps of a turn in the profile
    #[arg(long, value_name = "N", default_value_t = crate::problem::cams::STEPS, value_parser = clap::value_parser!(u32).range(12..=100_000))]
    pub steps: u32,
    /// The cam, counted from 1 (default: all)
    #[arg(long, value_name = "K")]
    pub cam: Option<usize>,
    /// Find the least base circle for this pressure angle as the follower goes out, such as 30deg;
    /// with -o a third figure, the s′-s diagram
    #[arg(long, value_name = "ANGLE")]
    pub alpha: Option<String>,
    /// With --alpha: the pressure angle allowed as the follower comes back (default: 75deg)
    #[arg(long, value_name = "ANGLE", requires = "alpha")]
    pub alpha_back: Option<String>,
    /// The report as JSON, in SI and radians
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub look: LookArgs,
    /// Resolution of the PNG in dots per inch
    #[arg(long, default_value_t = 200.0, value_parser = dpi)]
    pub dpi: f64,
}
