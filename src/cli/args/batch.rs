//! The arguments of `batch` and `shards`.

use super::super::values::{BatchFormat, Shard, ShardsAction};
use super::{CommonArgs, RangeArgs};
use clap::Args as ClapArgs;
use serde::{Deserialize, Serialize};

#[derive(ClapArgs, Debug)]
pub struct BatchArgs {
    #[command(flatten)]
    pub common: CommonArgs,
    #[command(flatten)]
    pub varied: VariedArgs,
    /// Write to this file, ending in .csv, .npy or .parquet, or to `-`, standard output; an
    /// interrupted run goes on where it was left. With --shard a folder
    #[arg(short, long, value_name = "FILE")]
    pub output: String,
    /// Format where -o has no such ending (default of `-o -`: csv, with --shard: parquet)
    #[arg(long, value_enum, value_delimiter = ',', value_name = "FORMAT")]
    pub format: Vec<BatchFormat>,
    /// Compute one share of the batch, such as 3/100, as parts in the folder of -o; `shards` joins
    /// them
    #[arg(long, value_name = "I/N")]
    pub shard: Option<Shard>,
    /// Mechanisms in a part (default: about a million numbers); fewer where each takes long
    #[arg(long, value_name = "N", requires = "shard", value_parser = clap::value_parser!(u64).range(1..))]
    pub per_part: Option<u64>,
}

/// The mechanisms of a batch.
#[derive(ClapArgs, Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct VariedArgs {
    /// A parameter and its values: NAME=FROM..TO:N; bare numbers keep the unit
    #[arg(long, value_name = "NAME=FROM..TO:N", required = true)]
    pub vary: Vec<String>,
    /// Number of random mechanisms instead of every combination
    #[arg(long, value_name = "N")]
    pub random: Option<u64>,
    /// Seed of the random mechanisms
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub seed: u64,
    #[command(flatten)]
    pub range: RangeArgs,
}

#[derive(ClapArgs, Debug)]
pub struct ShardsArgs {
    /// missing: list the missing parts; verify: read all parts and compare their checksums;
    /// compact: join them into one table, with the bytes of a `batch` that ran alone
    #[arg(value_enum, value_name = "missing|verify|compact", hide_possible_values = true)]
    pub action: ShardsAction,
    /// The folder of `batch --shard`
    #[arg(value_name = "FOLDER")]
    pub folder: String,
    /// For missing: list the shards of N that have missing parts, as in `sbatch --array`
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub of: Option<u64>,
    /// For verify: remove damaged parts, so that the same `batch` computes them again
    #[arg(long)]
    pub remove_damaged: bool,
    /// For compact: the table, ending like the parts, or `-`, standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<String>,
}
