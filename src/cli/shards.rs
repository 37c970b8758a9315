//! `batch --shard` and `hodograph shards`: a batch as parts in a folder, for many tasks on one or
//! many machines.
//!
//! A part holds a fixed range of mechanisms, whatever the number of shards, and is a complete table
//! with its journal. Task I of N computes every N-th part, skips finished ones and continues those
//! that were interrupted. A table appears by renaming, and its journal after it: a part counts once
//! both exist. The folder describes the batch in `batch.json`; each part depends on it alone.

use super::args::{ShardsArgs, VariedArgs};
use super::batch::{BatchRun, bar, written};
use super::part::{FinishedTable, JournalAfter};
use super::target::unwritable;
use super::together::OutputFile;
use super::values::{BatchFormat, Shard, ShardsAction};
use super::{CommandResult, Failure, InputFile, SceneInput, files, lang, places, tables};
use crate::diag::{Diagnostic, both};
use crate::problem;
use crate::problem::batch::{block, notes};
use crate::report::table::{GENERATOR, PiecePlace, RowFormat};
use crate::scene::Lang;
use crate::sweep::batch::Batch;
use serde::{Deserialize, Serialize};
use std::io::{self, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// The file that describes the batch of a folder.
const DESCRIPTION: &str = "batch.json";

/// Everything on which the parts of a folder depend.
#[derive(Serialize, Deserialize, Debug, PartialEq)]
struct FolderDescription {
    generator: String,
    format: String,
    language: String,
    mechanisms_per_part: u64,
    arguments: VariedArgs,
    scene: String,
}

/// Returns the format of the parts in a folder.
///
/// # Errors
/// `format` for the name of a table, and for several formats.
pub fn format(output: &str, formats: &[BatchFormat]) -> Result<BatchFormat, Failure> {
    if places::of_name::<BatchFormat>(output).is_none() && output != "-" {
        // The folder's name carries no format: that of a stream is the one asked for.
        return places::in_stream("-", formats, BatchFormat::Parquet);
    }
    let message = both!(
        "{output} is no name of a folder, and --shard writes parts into a folder",
        "{output} 不是文件夹名，而 --shard 把各分块写入文件夹"
    );
    let help = both!(
        "write -o parts/ --format parquet; `hodograph shards compact parts/ -o table.parquet` joins them",
        "请写 -o parts/ --format parquet；再用 `hodograph shards compact parts/ -o table.parquet` 合并"
    );
    Err(Failure::argument("-o", output, Diagnostic::error("output", message).help(help)))
}

/// Computes the missing parts of a shard.
pub fn compute(
    run: &BatchRun,
    shard: Shard,
    per_part: Option<u64>,
    folder: &Path,
) -> CommandResult {
    run.planned(|batch, format| {
        let parts = Parts::begin(folder, run, per_part.unwrap_or_else(|| block(batch)))?;
        let own = || (shard.number - 1..parts.count(batch)).step_by(shard.of.try_into().unwrap_or(usize::MAX));
        let bar = bar(own().map(|k| length(&parts.mechanisms(batch, k))).sum());
        let (mut mechanisms, mut rows, mut missing) = (0, 0, 0);
        for k in own() {
            let range = parts.mechanisms(batch, k);
            mechanisms += length(&range);
            match parts.finished(batch, k) {
                Some(table) => {
                    bar.inc(length(&range));
                    (rows, missing) = (rows + table.rows(), missing + table.missing());
                }
                None => {
                    let place = (&*parts.path(k), &*parts.job(k));
                    let table = written(batch, format, range, place, JournalAfter::Kept, &bar)?;
                    (rows, missing) = (rows + table.rows, missing + table.missing);
                }
            }
        }
        bar.finish_and_clear();
        files::print(lang::of(&both!(
            "{}: shard {} of {}, {} of {} parts: {mechanisms} mechanisms, {rows} rows, {missing} positions without one\n",
            "{}：第 {} 片（共 {} 片），含 {} 个分块（全部 {} 个）：{mechanisms} 个机构，{rows} 行，{missing} 个位置没有数据行\n",
            folder.display(),
            shard.number,
            shard.of,
            own().count(),
            parts.count(batch)
        )))
    })
}

/// Runs the command `shards`.
pub fn run(a: &ShardsArgs) -> CommandResult {
    let (run, parts) = Parts::open(Path::new(&a.folder))?;
    run.planned(|batch, format| match a.action {
        ShardsAction::Missing => missing(batch, &parts, a.of),
        ShardsAction::Verify => verify(batch, format, &parts, a.remove_damaged),
        ShardsAction::Compact => compact(batch, format, &parts, a.output.as_deref().unwrap_or("-")),
    })
}

/// Prints the missing parts, or the shards of `of` that have some, counted from 1: `2,5-7`.
fn missing(batch: &Batch, parts: &Parts, of: Option<u64>) -> CommandResult {
    let absent = (0..parts.count(batch)).filter(|&k| parts.finished(batch, k).is_none());
    let mut numbers: Vec<u64> = match of {
        Some(of) => absent.map(|k| k % of + 1).collect(),
        None => absent.collect(),
    };
    numbers.sort_unstable();
    numbers.dedup();
    let runs = numbers.chunk_by(|a, b| a + 1 == *b).filter_map(|run| match run {
        [one] => Some(one.to_string()),
        [first, .., last] => Some(format!("{first}-{last}")),
        [] => None,
    });
    let list = runs.collect::<Vec<_>>().join(",");
    files::print(&if list.is_empty() { list } else { list + "\n" })
}

/// Reads all parts; exit code 1 if some are missing or damaged.
fn verify(batch: &Batch, format: &dyn RowFormat, parts: &Parts, remove: bool) -> CommandResult {
    let (mut rows, mut gaps, mut sum) = (0, 0, crc32fast::Hasher::new());
    let (mut text, mut absent, mut damaged) = (String::new(), 0, 0);
    for k in 0..parts.count(batch) {
        let path = parts.path(k);
        let Some(mut table) = parts.finished(batch, k) else {
            absent += 1;
            continue;
        };
        if table.is_sound(format, &notes(table.missing())).unwrap_or(false) {
            (rows, gaps) = (rows + table.rows(), gaps + table.missing());
            table.add_checksum(&mut sum);
            continue;
        }
        damaged += 1;
        text += lang::of(&both!("{}: damaged\n", "{}：已损坏\n", path.display()));
        if remove {
            FinishedTable::remove(&path).map_err(|e| unwritable(&path, &e))?;
        }
    }
    let (all, sum) = (parts.count(batch), sum.finalize());
    text += lang::of(&both!(
        "{}: {all} parts, {absent} missing, {damaged} damaged; {rows} rows, {gaps} positions without one, CRC-32 {sum:08x}\n",
        "{}：共 {all} 个分块，缺少 {absent} 个，损坏 {damaged} 个；{rows} 行，{gaps} 个位置没有数据行，CRC-32 {sum:08x}\n",
        parts.folder.display()
    ));
    files::print_names(&text)?;
    Ok(if absent + damaged == 0 { ExitCode::SUCCESS } else { ExitCode::from(1) })
}

/// Joins all parts into one table.
fn compact(batch: &Batch, format: &dyn RowFormat, parts: &Parts, output: &str) -> CommandResult {
    let (named, name) = tables::place(output, &[], parts.format)?;
    places::agrees(&name, named, &[parts.format])?;
    let (mut rows, mut gaps, mut count, all) = (0, 0, 0, parts.count(batch));
    for k in 0..all {
        match parts.finished(batch, k) {
            Some(table) => (rows, gaps) = (rows + table.rows(), gaps + table.missing()),
            None => count += 1,
        }
    }
    if count > 0 {
        let message =
            both!("{count} of {all} parts are missing", "共 {all} 个分块，缺少 {count} 个");
        let help = both!(
            "run `batch --shard` again; `hodograph shards missing {}` lists them",
            "请再次运行 `batch --shard`；`hodograph shards missing {}` 列出缺少的分块",
            parts.folder.display()
        );
        return Err(parts.refused(Diagnostic::error("parts", message).help(help)));
    }
    let copy = |out: &mut OutputFile| {
        let begin = format.begin(rows, &[]);
        out.write_all(&begin)?;
        let (mut places, mut end): (Vec<PiecePlace>, _) = (Vec::new(), begin.len() as u64);
        for k in 0..parts.count(batch) {
            let sound = match parts.finished(batch, k) {
                Some(mut table) => table.copy(out, &mut places, &mut end)?,
                None => false,
            };
            if !sound {
                let words = both!(
                    "{} is damaged: `shards verify --remove-damaged`",
                    "{} 已损坏：请用 `shards verify --remove-damaged`",
                    parts.path(k).display()
                );
                return Err(io::Error::other(files::FileRefusal(words)));
            }
        }
        out.write_all(&format.end(&places, &notes(gaps))?)
    };
    files::write_with(Path::new(&name), copy)?;
    files::print(lang::of(&both!(
        "{name}: {} mechanisms, {rows} rows, {gaps} positions without one\n",
        "{name}：{} 个机构，{rows} 行，{gaps} 个位置没有数据行\n",
        batch.mechanisms()
    )))
}

/// A folder of parts.
struct Parts {
    folder: PathBuf,
    job: String,
    format: BatchFormat,
    per_part: u64,
}

impl Parts {
    /// Describes a batch in its folder, or compares the folder's description with it.
    ///
    /// # Errors
    /// `parts` for a folder of another batch; a folder that cannot be written.
    fn begin(folder: &Path, run: &BatchRun, per_part: u64) -> Result<Parts, Failure> {
        let description = FolderDescription {
            generator: GENERATOR.to_owned(),
            format: places::ending(run.format),
            language: run.lang.name().to_owned(),
            mechanisms_per_part: per_part,
            arguments: run.varied.clone(),
            scene: run.input.file.source.clone(),
        };
        let path = folder.join(DESCRIPTION);
        let fail = |e: io::Error| unwritable(&path, &e);
        std::fs::create_dir_all(folder).map_err(|e| unwritable(folder, &e))?;
        if !path.exists() {
            let text = serde_json::to_string_pretty(&description).map_err(|e| fail(e.into()))?;
            files::write(&path, text.as_bytes())?;
        }
        let parts = Parts::of(folder, run, per_part);
        if read(&path)? == description {
            return Ok(parts);
        }
        let message = both!(
            "{} holds the parts of another batch",
            "{} 中是另一批量计算的分块",
            folder.display()
        );
        let help = both!(
            "name another folder, or remove it; {DESCRIPTION} in it describes its batch",
            "请另取文件夹，或将其删除；其中的 {DESCRIPTION} 描述该批量计算"
        );
        Err(parts.refused(Diagnostic::error("parts", message).help(help)))
    }

    /// Opens a folder with the batch that it describes.
    fn open(folder: &Path) -> Result<(BatchRun, Parts), Failure> {
        let path = folder.join(DESCRIPTION);
        let told = read(&path)?;
        let fault = |message| {
            let d = Diagnostic::error("parts", message);
            Failure::argument("FOLDER", &folder.display().to_string(), d)
        };
        if told.generator != GENERATOR {
            return Err(fault(both!(
                "the parts are of {}, this is {GENERATOR}",
                "各分块由 {} 生成，而本程序为 {GENERATOR}",
                told.generator
            )));
        }
        let unknown = || fault(both!("{DESCRIPTION} is damaged", "{DESCRIPTION} 已损坏"));
        let format = places::of_name(&format!("x.{}", told.format)).ok_or_else(unknown)?;
        let lang = Lang::named(&told.language).ok_or_else(unknown)?;
        if told.mechanisms_per_part == 0 {
            return Err(unknown());
        }
        let mut file = InputFile::of(path.display().to_string(), told.scene);
        let scene = file.read(|bytes| problem::read(bytes))?;
        let scene = scene.into_scene().map_err(|d| file.failed(d.into()))?;
        let run = BatchRun::new(SceneInput { file, scene }, told.arguments, format, lang)?;
        let parts = Parts::of(folder, &run, told.mechanisms_per_part);
        Ok((run, parts))
    }

    fn of(folder: &Path, run: &BatchRun, per_part: u64) -> Parts {
        Parts { folder: folder.to_owned(), job: run.job(), format: run.format, per_part }
    }

    fn count(&self, batch: &Batch) -> u64 {
        batch.mechanisms().div_ceil(self.per_part)
    }

    /// Returns the mechanisms of a part.
    fn mechanisms(&self, batch: &Batch, part: u64) -> Range<u64> {
        let from = part * self.per_part;
        from..batch.mechanisms().min(from + self.per_part)
    }

    fn path(&self, part: u64) -> PathBuf {
        self.folder.join(format!("part-{part:06}.{}", places::ending(self.format)))
    }

    fn job(&self, part: u64) -> String {
        format!("{} part {part} of {}", self.job, self.per_part)
    }

    fn finished(&self, batch: &Batch, part: u64) -> Option<FinishedTable> {
        let mechanisms = length(&self.mechanisms(batch, part));
        FinishedTable::open(&self.path(part), &self.job(part), mechanisms)
    }

    fn refused(&self, fault: Diagnostic) -> Failure {
        Failure::argument("FOLDER", &self.folder.display().to_string(), fault)
    }
}

/// Reads the description of a folder.
fn read(path: &Path) -> Result<FolderDescription, Failure> {
    let name = path.display().to_string();
    let (_, bytes) = files::scene(&name).map_err(|d| {
        let d = d.help(both!(
            "`hodograph batch SCENE --vary ... --shard 1/8 -o FOLDER` makes such a folder",
            "`hodograph batch SCENE --vary ... --shard 1/8 -o FOLDER` 生成这样的文件夹"
        ));
        Failure::argument("FOLDER", &name, d)
    })?;
    serde_json::from_slice(&bytes).map_err(|e| {
        let message = both!("{DESCRIPTION} cannot be read: {e}", "无法读取 {DESCRIPTION}：{e}");
        Failure::argument("FOLDER", &name, Diagnostic::error("parts", message))
    })
}

fn length(range: &Range<u64>) -> u64 {
    range.end - range.start
}
