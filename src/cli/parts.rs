//! A batch as parts in a folder, for many tasks on one or many machines.
//!
//! A part holds a fixed range of mechanisms, whatever the number of shards, and is a complete table
//! with its journal. A table appears by renaming, and its journal after it: a part counts once both
//! exist. A part that was interrupted is continued. The folder describes the batch in `batch.json`;
//! each part depends on it alone.
//!
//! `hodograph batch --shard`, `hodograph shards` and the Python package call this module, which
//! prints nothing and handles no signals.

use super::args::{RangeArgs, VariedArgs};
use super::batch::{BatchRun, WorkWatch, written};
use super::part::{FinishedTable, JournalAfter};
use super::target::unwritable;
use super::together::OutputFile;
use super::values::BatchFormat;
use super::{Failure, InputFile, SceneInput, files, places, tables};
use crate::diag::{Diagnostic, Faults, both};
use crate::problem;
use crate::problem::batch::{block, notes};
use crate::problem::range::SweptRange;
use crate::report::table::{GENERATOR, PiecePlace};
use crate::scene::Lang;
use crate::sweep::pieces::StopSignal;
use serde::{Deserialize, Serialize};
use std::io::{self, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

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

/// A batch to be computed in parts, as [`crate::problem::batch::BatchRequest`] with the scene's
/// text.
#[derive(Clone, Copy, Debug)]
pub struct PartRequest<'a> {
    /// Name and text of the scene.
    pub scene: (&'a str, &'a str),
    /// The parameters and their values, each `NAME=FROM..TO:N` or `NAME=FROM..TO`.
    pub vary: &'a [String],
    /// Number of random mechanisms; `None` for every combination.
    pub random: Option<u64>,
    /// Seed of the random mechanisms.
    pub seed: u64,
    /// The positions of the driver.
    pub range: SweptRange<'a>,
    /// Questions in place of the scene's.
    pub find: Option<&'a str>,
    /// `csv`, `npy` or `parquet`.
    pub format: &'a str,
    /// Number of mechanisms in a part; `None` for about a million numbers.
    pub per_part: Option<u64>,
}

/// Faults of a scene, an argument or a file.
#[derive(Clone, Debug, PartialEq)]
pub struct PartFault {
    /// The name of the text: an argument such as `vary`, or a file.
    pub name: String,
    /// The text to which the places of the faults refer.
    pub text: String,
    /// The faults.
    pub faults: Faults,
}

/// Number of mechanisms, rows, and positions without a row.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RowCount {
    /// The mechanisms.
    pub mechanisms: u64,
    /// The rows.
    pub rows: u64,
    /// The positions without a row.
    pub missing: u64,
}

/// The result of reading all parts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VerifiedParts {
    /// The numbers of missing parts.
    pub absent: Vec<u64>,
    /// The numbers of damaged parts.
    pub damaged: Vec<u64>,
    /// The rows of the sound parts.
    pub count: RowCount,
    /// CRC-32 of all rows of the sound parts, in order.
    pub sum: u32,
}

/// A folder of parts.
pub struct PartFolder {
    run: BatchRun,
    folder: PathBuf,
    job: String,
    per_part: u64,
    mechanisms: u64,
}

impl PartFolder {
    /// Describes a batch in its folder, or compares the folder's description with it.
    ///
    /// # Errors
    /// Faults of the request; `parts` for a folder of another batch; a folder that cannot be
    /// written.
    pub fn begin(folder: &Path, request: &PartRequest) -> Result<PartFolder, Vec<PartFault>> {
        let begun = || {
            let (name, source) = request.scene;
            let SweptRange { over, from, to, steps } = request.range;
            let [over, from, to, find] =
                [over, from, to, request.find].map(|text| text.map(str::to_owned));
            let arguments = VariedArgs {
                vary: request.vary.to_vec(),
                random: request.random,
                seed: request.seed,
                range: RangeArgs { over, from, to, steps, find },
            };
            let format = places::of_name(&format!("x.{}", request.format)).ok_or_else(|| {
                let message = both!("`{}` is no format of a batch", request.format);
                let help = both!("there are csv, npy, parquet");
                Failure::argument(
                    "format",
                    request.format,
                    Diagnostic::error("format", message).help(help),
                )
            })?;
            let run = run_of((name.to_owned(), source.to_owned()), arguments, format, None)?;
            PartFolder::begun(folder, run, request.per_part)
        };
        begun().map_err(Failure::told)
    }

    /// Opens a folder with the batch that it describes.
    ///
    /// # Errors
    /// A folder without a description, or with that of another version.
    pub fn open(folder: &Path) -> Result<PartFolder, Vec<PartFault>> {
        PartFolder::opened(folder).map_err(Failure::told)
    }

    /// Computes parts that are missing; others are counted.
    ///
    /// `stop` ends the work after the current block; `done` is called with the number of mechanisms
    /// that are done since its last call.
    ///
    /// # Errors
    /// A part that cannot be written; `interrupted`.
    pub fn compute(
        &self,
        parts: &[u64],
        stop: StopSignal,
        done: &dyn Fn(u64),
    ) -> Result<RowCount, Vec<PartFault>> {
        self.computed(parts, &WorkWatch { stop, done, changed: &|_| () }).map_err(Failure::told)
    }

    /// Reads all parts and compares them with their journals; removes damaged ones if `remove`.
    ///
    /// # Errors
    /// A damaged part that cannot be removed.
    pub fn verify(&self, remove: bool) -> Result<VerifiedParts, Vec<PartFault>> {
        self.verified(remove).map_err(Failure::told)
    }

    /// Joins all parts into one table.
    ///
    /// # Errors
    /// A name with the ending of another format; missing or damaged parts; a file that cannot be
    /// written.
    pub fn compact(&self, output: &str) -> Result<RowCount, Vec<PartFault>> {
        self.joined(output).map_err(Failure::told)
    }

    /// Returns the number of parts.
    pub fn count(&self) -> u64 {
        self.mechanisms.div_ceil(self.per_part)
    }

    /// Returns the numbers of the missing parts.
    pub fn missing(&self) -> Vec<u64> {
        (0..self.count()).filter(|&k| self.finished(k).is_none()).collect()
    }

    /// Returns the file of a part.
    pub fn path(&self, part: u64) -> PathBuf {
        self.folder.join(format!("part-{part:06}.{}", places::ending(self.run.format)))
    }

    /// Returns the number of mechanisms of a part.
    pub fn mechanisms(&self, part: u64) -> u64 {
        let range = self.range(part);
        range.end - range.start
    }

    pub(super) fn begun(
        folder: &Path,
        run: BatchRun,
        per_part: Option<u64>,
    ) -> Result<PartFolder, Failure> {
        let parts = PartFolder::of(folder, run, per_part)?;
        let run = &parts.run;
        let description = FolderDescription {
            generator: GENERATOR.to_owned(),
            format: places::ending(run.format),
            language: run.lang.name().to_owned(),
            mechanisms_per_part: parts.per_part,
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
        if read(&path)? == description {
            return Ok(parts);
        }
        let message = both!("{} holds the parts of another batch", folder.display());
        let help =
            both!("name another folder, or remove it; {DESCRIPTION} in it describes its batch");
        Err(parts.refused(Diagnostic::error("parts", message).help(help)))
    }

    pub(super) fn opened(folder: &Path) -> Result<PartFolder, Failure> {
        let path = folder.join(DESCRIPTION);
        let told = read(&path)?;
        let fault = |message| {
            let d = Diagnostic::error("parts", message);
            Failure::argument("FOLDER", &folder.display().to_string(), d)
        };
        if told.generator != GENERATOR {
            return Err(fault(both!("the parts are of {}, this is {GENERATOR}", told.generator)));
        }
        let unknown = || fault(both!("{DESCRIPTION} is damaged"));
        let format = places::of_name(&format!("x.{}", told.format)).ok_or_else(unknown)?;
        let lang = Lang::named(&told.language).ok_or_else(unknown)?;
        if told.mechanisms_per_part == 0 {
            return Err(unknown());
        }
        let scene = (path.display().to_string(), told.scene);
        let run = run_of(scene, told.arguments, format, Some(lang))?;
        PartFolder::of(folder, run, Some(told.mechanisms_per_part))
    }

    fn of(folder: &Path, run: BatchRun, per_part: Option<u64>) -> Result<PartFolder, Failure> {
        let (mechanisms, usual) = run.planned(|batch, _| Ok((batch.mechanisms(), block(batch))))?;
        let per_part = per_part.unwrap_or(usual);
        let (job, folder) = (run.job(), folder.to_owned());
        Ok(PartFolder { run, folder, job, per_part, mechanisms })
    }

    pub(super) fn computed(&self, own: &[u64], watch: &WorkWatch) -> Result<RowCount, Failure> {
        self.run.planned(|batch, format| {
            let mut count = RowCount::default();
            for &k in own {
                let range = self.range(k);
                let mechanisms = range.end - range.start;
                let (rows, missing) = match self.finished(k) {
                    Some(table) => {
                        (watch.done)(mechanisms);
                        (table.rows(), table.missing())
                    }
                    None => {
                        let place = (&*self.path(k), &*self.job(k));
                        let after = JournalAfter::Kept;
                        let table = written(batch, format, range, place, after, watch)?;
                        (table.rows, table.missing)
                    }
                };
                count.add(mechanisms, rows, missing);
            }
            Ok(count)
        })
    }

    pub(super) fn verified(&self, remove: bool) -> Result<VerifiedParts, Failure> {
        self.run.planned(|_, format| {
            let (mut count, mut sum) = (RowCount::default(), crc32fast::Hasher::new());
            let (mut absent, mut damaged) = (Vec::new(), Vec::new());
            for k in 0..self.count() {
                let Some(mut table) = self.finished(k) else {
                    absent.push(k);
                    continue;
                };
                if table.is_sound(format, &notes(table.missing())).unwrap_or(false) {
                    count.add(self.mechanisms(k), table.rows(), table.missing());
                    table.add_checksum(&mut sum);
                    continue;
                }
                damaged.push(k);
                if remove {
                    let path = self.path(k);
                    FinishedTable::remove(&path).map_err(|e| unwritable(&path, &e))?;
                }
            }
            Ok(VerifiedParts { absent, damaged, count, sum: sum.finalize() })
        })
    }

    pub(super) fn joined(&self, output: &str) -> Result<RowCount, Failure> {
        let (named, name) = tables::place(output, &[], self.run.format)?;
        places::agrees(&name, named, &[self.run.format])?;
        let (mut count, mut absent) = (RowCount::default(), 0);
        for k in 0..self.count() {
            match self.finished(k) {
                Some(table) => count.add(self.mechanisms(k), table.rows(), table.missing()),
                None => absent += 1,
            }
        }
        if absent > 0 {
            let all = self.count();
            let message = both!("{absent} of {all} parts are missing");
            let help = both!(
                "run `batch --shard` again; `hodograph shards missing {}` lists them",
                self.folder.display()
            );
            return Err(self.refused(Diagnostic::error("parts", message).help(help)));
        }
        self.run.planned(|_, format| {
            let copy = |out: &mut OutputFile| {
                let begin = format.begin(count.rows, &[]);
                out.write_all(&begin)?;
                let (mut places, mut end): (Vec<PiecePlace>, _) = (Vec::new(), begin.len() as u64);
                for k in 0..self.count() {
                    let sound = match self.finished(k) {
                        Some(mut table) => table.copy(out, &mut places, &mut end)?,
                        None => false,
                    };
                    if !sound {
                        let words = both!(
                            "{} is damaged: `shards verify --remove-damaged`",
                            self.path(k).display()
                        );
                        return Err(io::Error::other(files::FileRefusal(words)));
                    }
                }
                out.write_all(&format.end(&places, &notes(count.missing))?)
            };
            files::write_with(Path::new(&name), copy)
        })?;
        Ok(count)
    }

    /// Returns the mechanisms of a part.
    fn range(&self, part: u64) -> Range<u64> {
        let from = part.saturating_mul(self.per_part).min(self.mechanisms);
        from..self.mechanisms.min(from.saturating_add(self.per_part))
    }

    fn job(&self, part: u64) -> String {
        format!("{} part {part} of {}", self.job, self.per_part)
    }

    pub(super) fn finished(&self, part: u64) -> Option<FinishedTable> {
        FinishedTable::open(&self.path(part), &self.job(part), self.mechanisms(part))
    }

    fn refused(&self, fault: Diagnostic) -> Failure {
        Failure::argument("FOLDER", &self.folder.display().to_string(), fault)
    }
}

impl RowCount {
    fn add(&mut self, mechanisms: u64, rows: u64, missing: u64) {
        self.mechanisms += mechanisms;
        self.rows += rows;
        self.missing += missing;
    }
}

/// Returns the batch of a scene's text; without a language in that of the scene.
fn run_of(
    (name, source): (String, String),
    arguments: VariedArgs,
    format: BatchFormat,
    lang: Option<Lang>,
) -> Result<BatchRun, Failure> {
    let mut file = InputFile::of(name, source);
    let scene = file.read(|bytes| problem::read(bytes))?;
    let scene = scene.into_scene().map_err(|d| file.failed(d.into()))?;
    let lang = lang.or(scene.language).unwrap_or_default();
    BatchRun::new(SceneInput { file, scene }, arguments, format, lang)
}

/// Reads the description of a folder.
fn read(path: &Path) -> Result<FolderDescription, Failure> {
    let name = path.display().to_string();
    let refused = |d: Diagnostic| {
        let d = d.help(both!(
            "`hodograph batch SCENE --vary ... --shard 1/8 -o FOLDER` makes such a folder"
        ));
        Failure::argument("FOLDER", &name, d)
    };
    let absent = || files::unreadable(path, &io::ErrorKind::NotFound.into());
    let bytes = files::read_now(path).map_err(refused)?.ok_or_else(|| refused(absent()))?;
    serde_json::from_slice(&bytes).map_err(|e| {
        let message = both!("{DESCRIPTION} cannot be read: {e}");
        Failure::argument("FOLDER", &name, Diagnostic::error("parts", message))
    })
}
