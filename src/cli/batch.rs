//! The command `batch`: parameters varied, many mechanisms, into one file, block by block.
//!
//! The rows go to a part file beside the output, whose state is kept in a small file next to it. When all are written it takes
//! its name; a run that is interrupted leaves the part, and the same command goes on from there. A file that cannot be
//! written in full is removed: whoever finds the output finds all of it.

use super::args::Batch as Args;
use super::sweep::{ask, driver_of, stations};
use super::{Failure, Input, Run, files};
use crate::diag::{Diagnostic, Faults};
use crate::mechanism::Mechanism;
use crate::scene::Scene;
use crate::sweep::Placed;
use crate::sweep::batch::{Batch, Block, Choice};
use crate::sweep::vary::Variation;
use indicatif::{ProgressBar, ProgressStyle};
use serde::{Deserialize, Serialize};
use std::fs::{File, OpenOptions};
use std::io::{BufWriter, IsTerminal, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, mpsc};

/// Positions of a block, about: a few megabytes of numbers, some hundredths of a second of work.
const BLOCK: usize = 1 << 16;

/// Exit code of an interrupted run, as shells have it.
const INTERRUPTED: u8 = 130;

/// What is known of a part file.
#[derive(Serialize, Deserialize)]
struct State {
    /// What was asked: another question begins anew.
    job: String,
    /// Mechanisms whose rows are in the file.
    done: u64,
    /// Length of the file with them.
    bytes: u64,
    /// Positions without a row so far.
    missing: u64,
}

pub fn batch(a: Args) -> Run {
    let mut input = Input::read(&a.common.scene)?;
    ask(&mut input, a.range.find.as_deref())?;
    let failed = |faults: Faults| Failure::Input(faults, input.name.clone(), input.source.clone());
    let out = PathBuf::from(&a.output);
    if out.extension().and_then(|e| e.to_str()) != Some("csv") {
        let d = Diagnostic::error("output", format!("{} is no .csv file", out.display()));
        return Err(Failure::Input(d.help("name the output designs.csv").into(), a.output, String::new()));
    }
    let mechanism = Mechanism::new(&input.scene).map_err(failed)?.value;
    let batch = plan(&input.scene, &mechanism, &a).map_err(failed)?;
    let job = format!(
        "{:?} {:?} {:?} {:?} {:?} {:?}",
        a.vary,
        a.random,
        a.seed,
        (&a.range.over, &a.range.from, &a.range.to, a.steps),
        a.range.find,
        input.source
    );
    let (code, state) = write(&batch, &out, job)?;
    let positions = batch.mechanisms().saturating_mul(batch.positions() as u64);
    if code == ExitCode::SUCCESS {
        files::print(&format!(
            "{}: {} mechanisms, {} rows, {} positions without one\n",
            a.output,
            state.done,
            positions - state.missing,
            state.missing
        ))?;
    }
    Ok(code)
}

fn plan<'a>(scene: &'a Scene, mechanism: &'a Mechanism, a: &Args) -> Result<Batch<'a>, Faults> {
    let mut names = Vec::new();
    let mut ranges = Vec::new();
    let mut faults = Faults::default();
    for text in &a.vary {
        match range(text) {
            Some((name, from, to, n)) => {
                names.push(name);
                ranges.push((from, to, n));
            }
            None => faults.push(
                Diagnostic::error("vary", format!("`--vary {text}` cannot be read"))
                    .help("write NAME=FROM..TO:N, such as --vary l_BC=80..120:100"),
            ),
        }
    }
    if faults.has_errors() {
        return Err(faults);
    }
    let variation = Variation::new(scene, &names)?;
    let mut values = Vec::new();
    for (name, (from, to, n)) in names.iter().zip(&ranges) {
        values.push(variation.range(scene, name, from, to, n.saturating_sub(1))?);
    }
    let driver = driver_of(scene, a.range.over.as_deref())?;
    let stations = match a.steps {
        None => None,
        Some(steps) => Some(stations(&Placed::new(scene, mechanism)?, driver, &a.range, steps)?),
    };
    let choice = a.random.map_or(Choice::Grid, |count| Choice::Random { count, seed: a.seed });
    Ok(Batch { scene, mechanism, variation, values, choice, driver, stations })
}

/// `NAME=FROM..TO:N`, or `NAME=FROM..TO` for two values (the bounds of a random one).
fn range(text: &str) -> Option<(&str, &str, &str, usize)> {
    let (name, rest) = text.split_once('=')?;
    let (bounds, n) = match rest.rsplit_once(':') {
        Some((bounds, n)) => (bounds, n.trim().parse().ok().filter(|n| (1..=10_000_000).contains(n))?),
        None => (rest, 2),
    };
    let (from, to) = bounds.split_once("..")?;
    Some((name.trim(), from.trim(), to.trim(), n))
}

/// The file under way.
struct Part {
    path: PathBuf,
    file: BufWriter<File>,
    state: State,
}

impl Part {
    fn state_path(path: &Path) -> PathBuf {
        path.with_extension("part.json")
    }

    /// Opens the part of an output, and goes on where the same job was left.
    fn open(out: &Path, job: String) -> std::io::Result<Part> {
        if let Some(folder) = out.parent().filter(|p| !p.as_os_str().is_empty()) {
            std::fs::create_dir_all(folder)?;
        }
        let path = out.with_extension("csv.part");
        let left = std::fs::read(Part::state_path(&path)).ok().and_then(|b| serde_json::from_slice::<State>(&b).ok());
        let state = left.filter(|s| s.job == job && std::fs::metadata(&path).is_ok_and(|m| m.len() >= s.bytes));
        let state = state.unwrap_or(State { job, done: 0, bytes: 0, missing: 0 });
        let mut file = OpenOptions::new().create(true).truncate(false).write(true).open(&path)?;
        file.set_len(state.bytes)?;
        file.seek(SeekFrom::Start(state.bytes))?;
        Ok(Part { path, file: BufWriter::with_capacity(1 << 20, file), state })
    }

    /// Adds text; the state follows only when it is on its way to the disk.
    fn add(&mut self, text: &[u8], done: u64, missing: u64) -> std::io::Result<()> {
        self.file.write_all(text)?;
        self.file.flush()?;
        self.state.bytes += text.len() as u64;
        self.state.done = done;
        self.state.missing += missing;
        std::fs::write(Part::state_path(&self.path), serde_json::to_vec(&self.state)?)
    }

    fn remove(&self) {
        // What cannot be removed is left; its name says what it is.
        let _ = std::fs::remove_file(&self.path);
        let _ = std::fs::remove_file(Part::state_path(&self.path));
    }

    fn finish(mut self, out: &Path) -> std::io::Result<State> {
        self.file.flush()?;
        self.file.get_ref().sync_all()?;
        std::fs::rename(&self.path, out)?;
        let _ = std::fs::remove_file(Part::state_path(&self.path));
        Ok(self.state)
    }
}

fn write(batch: &Batch, out: &Path, job: String) -> Result<(ExitCode, State), Failure> {
    let failed = |e: std::io::Error| Failure::Output(format!("{} cannot be written: {e}", out.display()));
    let mut part = Part::open(out, job).map_err(failed)?;
    let stop = Arc::new(AtomicBool::new(false));
    let asked = Arc::clone(&stop);
    // A second handler in one process is refused; the run then ends as any program does.
    let _ = ctrlc::set_handler(move || asked.store(true, Ordering::Relaxed));
    let result = stream(batch, &mut part, &stop);
    if let Err(e) = result {
        part.remove();
        return Err(failed(e));
    }
    if stop.load(Ordering::Relaxed) && part.state.done < batch.mechanisms() {
        eprintln!("interrupted after {} of {} mechanisms; the same command goes on from there", part.state.done, batch.mechanisms());
        return Ok((ExitCode::from(INTERRUPTED), part.state));
    }
    part.finish(out).map(|state| (ExitCode::SUCCESS, state)).map_err(failed)
}

/// Computes and writes block after block; one is computed while the one before it is written.
fn stream(batch: &Batch, part: &mut Part, stop: &AtomicBool) -> std::io::Result<()> {
    let all = batch.mechanisms();
    let step = (BLOCK / batch.positions().max(1)).max(1) as u64;
    let bar = if std::io::stderr().is_terminal() { ProgressBar::new(all) } else { ProgressBar::hidden() };
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} mechanisms  {per_sec}  {eta} left");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.set_position(part.state.done);
    if part.state.done == 0 {
        let head: Vec<String> = batch.columns().into_iter().map(|(n, u)| if u.is_empty() { n } else { format!("{n} [{u}]") }).collect();
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(head).map_err(std::io::Error::other)?;
        let text = writer.into_inner().map_err(|e| std::io::Error::other(e.to_string()))?;
        part.add(&text, 0, 0)?;
    }
    let (sender, blocks) = mpsc::sync_channel::<(u64, Block)>(1);
    let first = part.state.done;
    std::thread::scope(|s| {
        s.spawn(move || {
            let mut from = first;
            while from < all && !stop.load(Ordering::Relaxed) {
                let to = all.min(from + step);
                // The writer has failed and gone.
                if sender.send((to, batch.block(from, to))).is_err() {
                    return;
                }
                from = to;
            }
        });
        for (done, block) in blocks {
            part.add(&text(&block)?, done, block.missing)?;
            bar.set_position(done);
        }
        bar.finish_and_clear();
        Ok(())
    })
}

fn text(block: &Block) -> std::io::Result<Vec<u8>> {
    let rows = block.columns.first().map_or(0, Vec::len);
    let mut writer = csv::Writer::from_writer(Vec::with_capacity(rows * block.columns.len() * 20));
    let mut row = vec![0.0; block.columns.len()];
    for i in 0..rows {
        row.iter_mut().zip(&block.columns).for_each(|(x, c)| *x = c[i]);
        writer.serialize(&row).map_err(std::io::Error::other)?;
    }
    writer.into_inner().map_err(|e| std::io::Error::other(e.to_string()))
}
