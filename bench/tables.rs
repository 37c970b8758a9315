//! Time that the command adds to the computation: start, and writing of tables.
//! `cargo bench --bench tables` prints the table of docs/performance.md; `-- sweep STEPS` only runs
//! sweeps of a four-bar in memory, `-- compiled STEPS` the same without compiling, and `-- chunk`
//! its compiled program in cache, for `bench/peers`.
//!
//! Variants take turns, so that other load on the machine affects all alike; the medians are
//! reported.

mod program;

use hodograph::mechanism::Mechanism;
use hodograph::report::table::{Csv, Npy, Parquet, PiecePlace, RowFormat, TableHead};
use hodograph::scene::{Angle, Scene, edit, read, templates};
use hodograph::sweep::batch::{Batch, Block, ParameterChoice};
use hodograph::sweep::vary::Variation;
use hodograph::sweep::{PlacedScene, Stations, Sweep, Table, Width, compile};
use std::fs::File;
use std::hint::black_box;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::mpsc;
use std::time::Instant;

/// Mechanisms of the batch; 200 positions each.
const MECHANISMS: u64 = 10_000;

/// The arguments by which the command writes the same batch.
const ARGUMENTS: &str = "--vary l_AB=60..120 --vary l_BC=200..300 --vary l_CD=180..260 --random 10000 --seed 1 --from 0deg --to 358.2deg \
    --steps 199 --find v_C,a_C -o";

/// Mechanisms in a block of the command.
const STEP: u64 = 476;

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn seconds(call: impl FnOnce()) -> f64 {
    let start = Instant::now();
    call();
    start.elapsed().as_secs_f64()
}

fn asked(find: &[&str]) -> Scene {
    read(edit::with_find(templates::get("crank-rocker").unwrap(), find).unwrap()).unwrap().value
}

/// The part of a sweep that is repeated.
#[derive(PartialEq)]
enum Again {
    /// The whole sweep: scene to table.
    Whole,
    /// The part after compiling: stations to table.
    Compiled,
}

/// Runs sweeps of this number of steps in memory, one after the other; returns the number of
/// positions. The caller measures the time and states the number of cores.
fn in_memory(steps: usize, again: Again) -> usize {
    let scene = asked(&["x_C", "y_C", "v_C", "a_C"]);
    let m = Mechanism::new(&scene).unwrap().value;
    let stations = Stations::turned(Angle::Deg(0.0), Angle::Deg(360.0), steps);
    let placed = PlacedScene::new(&scene, &m).unwrap();
    let compiled = Sweep::new(&placed, 0).unwrap();
    let mut table = Table::default();
    let mut one = || {
        let used = std::mem::take(&mut table);
        table = if again == Again::Compiled {
            compiled.run(&stations, Width::Widest, used)
        } else {
            Sweep::new(&PlacedScene::new(&scene, &m).unwrap(), 0).unwrap().run(
                &stations,
                Width::Widest,
                used,
            )
        };
        black_box(&table).rows()
    };
    (0..20_000_000 / steps).map(|_| one()).sum()
}

/// Runs the compiled program over one chunk repeatedly, in cache; returns the number of positions.
fn in_cache() -> usize {
    let scene = asked(&["x_C", "y_C", "v_C", "a_C"]);
    let m = Mechanism::new(&scene).unwrap().value;
    let placed = PlacedScene::new(&scene, &m).unwrap();
    let fused = compile(&scene, &m, &placed.at, Some(0), &scene.find).unwrap().fused().clone();
    let stations = Stations::turned(Angle::Deg(0.0), Angle::Deg(360.0), fused.positions() - 1);
    let mut buffer = fused.buffer();
    fused.load(&mut buffer, &stations, 0..stations.len());
    let chunks = 50_000_000 / stations.len();
    (0..chunks).for_each(|_| fused.run(black_box(&mut buffer), Width::Widest));
    chunks * stations.len()
}

/// Writes blocks as the command does: the next block is formatted while the last one is written,
/// into a part that then replaces the earlier file.
fn write(blocks: &[Block], format: &dyn RowFormat, path: &Path) {
    let part = path.with_extension("part");
    let mut file = File::create(&part).unwrap();
    let begin = format.begin(0, &[]);
    file.write_all(&begin).unwrap();
    let (sender, pieces) = mpsc::sync_channel(1);
    let (give_back, used) = mpsc::channel();
    let mut standing = Vec::new();
    std::thread::scope(|s| {
        s.spawn(move || {
            for block in blocks {
                let columns: Vec<&[f64]> = block.columns.iter().map(Vec::as_slice).collect();
                sender
                    .send(format.piece_in(&columns, used.try_recv().unwrap_or_default()).unwrap())
                    .unwrap();
            }
        });
        let mut offset = begin.len() as u64;
        for piece in pieces {
            piece.write(&mut file).unwrap();
            standing.push(PiecePlace { offset, rows: piece.rows, index: piece.index.clone() });
            offset += piece.length();
            let _ = give_back.send(piece);
        }
    });
    file.write_all(&format.end(&standing, &[]).unwrap()).unwrap();
    file.sync_all().unwrap();
    std::fs::rename(&part, path).unwrap();
}

fn command(arguments: &str, last: &Path) {
    let mut c = program::hodograph();
    c.args(arguments.split_whitespace())
        .arg(last)
        .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(".."))
        .stdout(Stdio::null());
    assert!(c.status().unwrap().success());
}

fn writing() {
    let scene = asked(&["v_C", "a_C"]);
    let m = Mechanism::new(&scene).unwrap().value;
    let variation = Variation::new(&scene, &["l_AB", "l_BC", "l_CD"]).unwrap();
    let range = |name, from, to| variation.range(&scene, name, from, to, 1).unwrap();
    let values =
        vec![range("l_AB", "60", "120"), range("l_BC", "200", "300"), range("l_CD", "180", "260")];
    let choice = ParameterChoice::Random { count: MECHANISMS, seed: 1 };
    let stations = Some(Stations::turned(Angle::Deg(0.0), Angle::Deg(358.2), 199));
    let batch = Batch {
        scene: &scene,
        mechanism: &m,
        variation: variation.clone(),
        values,
        choice,
        driver: 0,
        stations,
    };
    let ends =
        || (0..MECHANISMS).step_by(STEP as usize).map(|from| (from, MECHANISMS.min(from + STEP)));
    // One after the other, each in the memory of the one before.
    let computed = || {
        ends().fold(Block::default(), |used, (from, to)| black_box(batch.block_in(from, to, used)))
    };
    let kept: Vec<Block> = ends().map(|(from, to)| batch.block(from, to)).collect();
    let rows: usize = kept.iter().map(|b| b.columns[0].len()).sum();
    let mut head = TableHead::new("", batch.columns());
    head.columns.iter_mut().take(5).for_each(|c| c.repeats = true);
    head.columns[0].whole = true;
    let folder = std::env::temp_dir().join(format!("hodograph-bench-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let formats: [(&str, Box<dyn RowFormat>); 3] = [
        ("csv", Box::new(Csv::new(head.clone()))),
        ("npy", Box::new(Npy::new(head.clone()))),
        ("parquet", Box::new(Parquet::new(head).unwrap())),
    ];
    let (mut compute, mut alone, mut whole) =
        (Vec::new(), vec![Vec::new(); 3], vec![Vec::new(); 3]);
    let path = |ending: &str| folder.join(format!("designs.{ending}"));
    for round in 0..6 {
        compute.push(seconds(|| drop(computed())));
        for (k, (ending, format)) in formats.iter().enumerate() {
            let arguments = format!("batch templates/crank-rocker.json {ARGUMENTS}");
            // The second variant finds memory that has just been freed: each is first in turn.
            for first in [round % 2 == 0, round % 2 != 0] {
                if first {
                    alone[k].push(seconds(|| write(&kept, &**format, &path(ending))));
                } else {
                    whole[k].push(seconds(|| command(&arguments, &path(ending))));
                }
            }
        }
    }
    let compute = median(compute);
    let million = |t: f64| rows as f64 / t / 1e6;
    println!(
        "{rows} rows of 11 columns; computed only: {compute:.3} s, {:.1} million positions/s",
        million(compute)
    );
    println!(
        "\n| format | MB | writing alone, s | whole command, s | whole / writing alone | (whole - computing) / writing alone | whole / computing + writing | million positions/s |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    for (k, (ending, _)) in formats.iter().enumerate() {
        let (alone, whole) = (median(alone[k].clone()), median(whole[k].clone()));
        let size = std::fs::metadata(path(ending)).unwrap().len() as f64 / 1e6;
        let ratios = [whole / alone, (whole - compute) / alone, whole / (alone + compute)]
            .map(|r| format!("{r:.2}"))
            .join(" | ");
        println!(
            "| {ending} | {size:.0} | {alone:.3} | {whole:.3} | {ratios} | {:.1} |",
            million(whole)
        );
    }
    let _ = std::fs::remove_dir_all(&folder);
}

/// Time to start the command, compared with an empty program.
fn starting() {
    let run = |mut c: Command, arguments: &[&str]| {
        seconds(|| assert!(c.args(arguments).stdout(Stdio::null()).status().unwrap().success()))
    };
    let (mut ours, mut empty) = (Vec::new(), Vec::new());
    for _ in 0..201 {
        ours.push(run(program::hodograph(), &["--version"]));
        empty.push(run(Command::new("true"), &[]));
    }
    let (ours, empty) = (median(ours) * 1e3, median(empty) * 1e3);
    println!(
        "\nstarting: hodograph --version {ours:.2} ms, an empty program {empty:.2} ms: {:.2} ms more",
        ours - empty
    );
}

fn main() -> std::process::ExitCode {
    program::or(measured)
}

fn measured() {
    let arguments: Vec<String> = std::env::args().collect();
    let steps = |text: &str| text.parse().expect("a number of steps");
    let positions = match &arguments[1..] {
        [what, n, ..] if what == "sweep" => in_memory(steps(n), Again::Whole),
        [what, n, ..] if what == "compiled" => in_memory(steps(n), Again::Compiled),
        [what, ..] if what == "chunk" => in_cache(),
        _ => {
            writing();
            starting();
            return;
        }
    };
    println!("{{\"positions\": {positions}}}");
}
