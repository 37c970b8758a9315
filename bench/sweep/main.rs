//! Cost of one position of a sweep: the compiled program compared with hand-written loops, with
//! four lanes and with one; the cost over the length of a chain of dyads; batches.
//!
//! `cargo bench --bench sweep` prints the tables of docs/performance.md. `-- count NAME` runs one
//! variant a million times, to be counted by `perf stat` or callgrind. `-- only WORD` measures the
//! variants with this word in their names.
//!
//! Variants take turns, so that other load on the machine affects all alike; the medians are
//! reported.

mod by_hand;
mod wheels;

use by_hand::ByHand;
use hodograph::mechanism::Mechanism;
use hodograph::scene::{Scene, edit, read, templates};
use hodograph::sweep::CHUNK;
use hodograph::sweep::batch::{Batch, Block, ParameterChoice};
use hodograph::sweep::vary::Variation;
use hodograph::sweep::{self, PlacedScene, Stations, Width, compile};
use std::hint::black_box;
use std::time::Instant;

/// Rounds; the median of each variant is taken.
const ROUNDS: usize = 301;

/// Seconds of calls that are timed together: long enough to make the clock's own time negligible,
/// short enough that another program seldom interrupts.
const SAMPLE: f64 = 1e-4;

/// Scenes with loads, and the accelerations on which their balancing moments depend.
const FORCES: [(&str, &[&str]); 4] = [
    ("four-bar-forces", &["a_S1", "a_S2", "a_S3", "alpha_2", "alpha_3"]),
    ("press-forces", &["a_S2", "a_S3", "a_F", "alpha_2", "alpha_3"]),
    ("shaper-forces", &["a_S4", "a_C", "alpha_4"]),
    ("engine-forces", &["a_S2", "a_C", "alpha_2"]),
];

/// A name, the timed function, and the number of positions per call.
type Variant = (String, (Box<dyn FnMut()>, usize));

fn scene(text: &str) -> Scene {
    read(text).unwrap_or_else(|f| panic!("{f}")).value
}

fn asked(name: &str, find: &[&str]) -> Scene {
    scene(&edit::with_find(templates::get(name).unwrap(), find).unwrap())
}

/// The positions of a chunk.
fn stations(scene: &Scene) -> (Stations, Mechanism) {
    let m = Mechanism::new(scene).unwrap().value;
    let placed = PlacedScene::new(scene, &m).unwrap();
    let now = sweep::station::position_now(scene, &placed.at, 0);
    (Stations::slid(now, now + 0.1, CHUNK - 1, 1.0), m)
}

/// Returns a program over one chunk of positions with its inputs, and the number of positions.
fn chunk_of(scene: &Scene, width: Width) -> (Box<dyn FnMut()>, usize) {
    let (stations, m) = stations(scene);
    let placed = PlacedScene::new(scene, &m).unwrap();
    let fused = compile(scene, &m, &placed.at, Some(0), &scene.find).unwrap().fused().clone();
    let (mut buffer, n) = (fused.buffer(), fused.positions());
    fused.load(&mut buffer, &stations, 0..n);
    (Box::new(move || fused.run(black_box(&mut buffer), width)), n)
}

/// Returns the hand-written loop for a chunk; its results are first compared with the sweep's
/// columns.
fn hand(scene: &Scene, mechanism: by_hand::Mechanism) -> (Box<dyn FnMut()>, usize) {
    let (stations, m) = stations(scene);
    let placed = PlacedScene::new(scene, &m).unwrap();
    let table = sweep::run(&placed, 0, &stations, Width::Widest).unwrap();
    let mut hand = ByHand::new(mechanism, &stations.cosines, &stations.sines);
    hand.call();
    assert_eq!(hand.out.len() + 1, table.columns.len());
    for (own, column) in hand.out.iter().zip(&table.columns[1..]) {
        let size = column.values.iter().fold(0.0f64, |a, b| a.max(b.abs()));
        let off = own.0.iter().zip(&column.values).fold(0.0f64, |a, (x, y)| a.max((x - y).abs()));
        assert!(off <= 1e-12 * size, "{}: {off:e} of {size}", column.name);
    }
    (Box::new(move || black_box(&mut hand).call()), CHUNK)
}

/// A crank that drives `n` dyads, each attached to the one before it.
fn chain(n: usize) -> Scene {
    let (mut links, mut ground, mut points, mut lengths, mut side) =
        (String::new(), String::from("\"A\""), String::new(), String::new(), String::new());
    let mut find = Vec::new();
    let mut last = "B".to_owned();
    for i in 0..n {
        let (c, d) = (format!("C{i}"), format!("D{i}"));
        links.push_str(&format!(
            ", \"{}\": [\"{last}\", \"{c}\"], \"{}\": [\"{c}\", \"{d}\"]",
            10 + 2 * i,
            11 + 2 * i
        ));
        ground.push_str(&format!(", \"{d}\""));
        points.push_str(&format!(", \"{d}\": [\"{} mm\", 0]", 300 * (i + 1)));
        lengths.push_str(&format!(", \"{last}{c}\": \"300 mm\", \"{c}{d}\": \"220 mm\""));
        side.push_str(&format!("{}\"{c}\": \"left of {last}{d}\"", if i == 0 { "" } else { ", " }));
        find.extend([format!("\"v_{c}\""), format!("\"a_{c}\"")]);
        last = c;
    }
    scene(&format!(
        r#"{{"links": {{"1": ["A", "B"]{links}, "0": [{ground}]}}, "ground": "0", "points": {{"A": [0, 0]{points}}},
            "lengths": {{"AB": "40 mm"{lengths}}}, "driver": {{"link": "1", "angle": "60 deg", "omega": "10 rad/s"}},
            "side": {{{side}}}, "find": [{}]}}"#,
        find.join(", ")
    ))
}

/// A train of this number of gears in mesh, all on ground, each with a point with velocity and
/// acceleration asked for.
fn train(n: usize) -> Scene {
    let (mut links, mut points, mut gears, mut find) =
        (String::new(), String::new(), Vec::new(), Vec::new());
    let mut ground = vec!["\"D0\"".to_owned()];
    for k in 1..=n {
        links.push_str(&format!(", \"g{k}\": [\"D{k}\", \"C{k}\"]"));
        points.push_str(&format!(", \"D{k}\": [{}, 0], \"C{k}\": [{}, 10]", 60 * k, 60 * k + 15));
        let before = if k == 1 { "g0".to_owned() } else { format!("g{}", k - 1) };
        gears.push(format!(
            "{{\"links\": [\"{before}\", \"g{k}\"], \"centres\": [\"D{}\", \"D{k}\"], \"teeth\": [{}, {}]}}",
            k - 1,
            20 + k % 3,
            21 + k % 5
        ));
        ground.push(format!("\"D{k}\""));
        find.extend([format!("\"v_C{k}\""), format!("\"a_C{k}\"")]);
    }
    scene(&format!(
        r#"{{"units": {{"length": "mm"}}, "links": {{"g0": ["D0", "B"]{links}, "0": [{}]}}, "ground": "0", "points": {{"D0": [0, 0], "B": [10, 10]{points}}},
            "gears": [{}], "driver": {{"link": "g0", "omega": "10 rad/s"}}, "find": [{}]}}"#,
        ground.join(", "),
        gears.join(", "),
        find.join(", ")
    ))
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// Medians of all variants, measured in turn: ns per position.
fn measure(variants: &mut [Variant]) -> Vec<f64> {
    let mut times = vec![Vec::new(); variants.len()];
    let mut calls = vec![1u32; variants.len()];
    for _ in 0..ROUNDS {
        for (((_, (call, positions)), times), calls) in
            variants.iter_mut().zip(&mut times).zip(&mut calls)
        {
            let start = Instant::now();
            for _ in 0..*calls {
                call();
            }
            let t = start.elapsed().as_secs_f64() / f64::from(*calls);
            times.push(t * 1e9 / *positions as f64);
            *calls = (SAMPLE / t).clamp(1.0, 1000.0) as u32;
        }
    }
    times.into_iter().map(median).collect()
}

fn main() {
    let four_bar = asked("crank-rocker", &["v_C", "a_C"]);
    let leg = asked(
        "jansen-leg",
        &["v_C", "v_D", "v_E", "v_F", "v_G", "a_C", "a_D", "a_E", "a_F", "a_G"],
    );
    let mut variants: Vec<Variant> = vec![
        ("four-bar by hand".into(), hand(&four_bar, by_hand::Mechanism::FourBar)),
        ("four-bar: position, velocity, acceleration".into(), chunk_of(&four_bar, Width::Widest)),
        ("the same, one lane".into(), chunk_of(&four_bar, Width::One)),
        (
            "four-bar: position and velocity".into(),
            chunk_of(&asked("crank-rocker", &["v_C"]), Width::Widest),
        ),
        (
            "four-bar: position".into(),
            chunk_of(&asked("crank-rocker", &["x_C", "y_C"]), Width::Widest),
        ),
        ("eight-link leg by hand".into(), hand(&leg, by_hand::Mechanism::leg())),
        ("eight-link leg, all joints, all three".into(), chunk_of(&leg, Width::Widest)),
        ("the same leg, one lane".into(), chunk_of(&leg, Width::One)),
        (
            "slider-crank: v and a of the pin".into(),
            chunk_of(&asked("slider-crank", &["v_C", "a_C"]), Width::Widest),
        ),
        (
            "shaper: v and a of the ram".into(),
            chunk_of(&asked("shaper", &["v_C", "a_C"]), Width::Widest),
        ),
    ];
    let single = variants.len();
    let dyads = [1, 3, 10, 30, 100];
    variants.extend(
        dyads.map(|n| {
            (format!("chain of {n} dyads, all three"), chunk_of(&chain(n), Width::Widest))
        }),
    );
    let chained = variants.len();
    let meshes = [1, 3, 10, 30];
    variants.extend(
        meshes.map(|n| {
            (format!("train of {n} meshes, all three"), chunk_of(&train(n), Width::Widest))
        }),
    );
    let trained = variants.len();
    variants.extend(wheels::variants());
    let wheeled = variants.len();
    for (name, accelerations) in FORCES {
        variants.push((
            format!("forces, {name}: the accelerations"),
            chunk_of(&asked(name, accelerations), Width::Widest),
        ));
        variants.push((
            format!("forces, {name}: M_b"),
            chunk_of(&asked(name, &["M_b"]), Width::Widest),
        ));
    }
    let given: Vec<String> = std::env::args().skip(1).collect();
    if let [count, name, ..] = &given[..]
        && count == "count"
    {
        let (_, (call, positions)) = variants
            .iter_mut()
            .find(|v| v.0 == *name)
            .expect("the name of a variant, as the table has it");
        (0..1_000_000 / *positions).for_each(|_| call());
        return;
    }
    if let [only, word, ..] = &given[..]
        && only == "only"
    {
        variants.retain(|v| v.0.contains(word.as_str()));
        let times = measure(&mut variants);
        variants.iter().zip(times).for_each(|((name, _), t)| println!("| {name} | {t:.2} |"));
        return;
    }
    let times = measure(&mut variants);
    println!("| one core, in cache | ns a position | against the loop by hand |\n|---|---|---|");
    let mut by_hand = 0.0;
    for ((name, _), t) in variants[..single].iter().zip(&times) {
        by_hand = if name.ends_with("by hand") { *t } else { by_hand };
        println!("| {name} | {t:.2} | {:.2} |", t / by_hand);
    }
    println!("\n| dyads in a chain | ns a position and dyad |\n|---|---|");
    for (n, t) in dyads.iter().zip(&times[single..]) {
        println!("| {n} | {:.2} |", t / *n as f64);
    }
    println!("\n| meshes in a train | ns a position and mesh |\n|---|---|");
    for (n, t) in meshes.iter().zip(&times[chained..]) {
        println!("| {n} | {:.2} |", t / *n as f64);
    }
    println!("\n| cams | ns a position |\n|---|---|");
    for ((name, _), t) in variants[trained..wheeled].iter().zip(&times[trained..wheeled]) {
        println!("| {name} | {t:.1} |");
    }
    println!(
        "\n| balancing moment | ns a position | against the accelerations that it rests on |\n|---|---|---|"
    );
    for ((name, _), t) in FORCES.iter().zip(times[wheeled..].chunks(2)) {
        println!("| {name} | {:.1} | {:.2} |", t[1], t[1] / t[0]);
    }
    batch();
}

/// Ten thousand random four-bars at 200 positions, both cores, in memory.
fn batch() {
    let scene = asked("crank-rocker", &["v_C", "a_C"]);
    let m = Mechanism::new(&scene).unwrap().value;
    let variation = Variation::new(&scene, &["l_AB", "l_BC", "l_CD"]).unwrap();
    let range = |name, from, to| variation.range(&scene, name, from, to, 1).unwrap();
    let values =
        vec![range("l_AB", "60", "120"), range("l_BC", "200", "300"), range("l_CD", "180", "260")];
    let choice = ParameterChoice::Random { count: 10_000, seed: 1 };
    let stations = Some(Stations::turned(
        hodograph::scene::Angle::Deg(0.0),
        hodograph::scene::Angle::Deg(358.2),
        199,
    ));
    let batch = Batch {
        scene: &scene,
        mechanism: &m,
        variation: variation.clone(),
        values,
        choice,
        driver: 0,
        stations,
    };
    let (start, cpu) = (Instant::now(), processor_time());
    let (mut rows, mut block) = (0, Block::default());
    for from in (0..10_000).step_by(320) {
        block = black_box(batch.block_in(from, (from + 320).min(10_000), block));
        rows += block.columns[0].len();
    }
    let t = start.elapsed().as_secs_f64();
    println!(
        "\n10 000 random four-bars × 200 positions: {rows} rows in {t:.3} s, {:.1} million positions/s",
        2.0 / t
    );
    if let (Some(before), Some(after)) = (cpu, processor_time()) {
        let t = after - before;
        println!(
            "processor time {t:.3} s: {:.1} µs a mechanism, {:.1} million positions/s and core",
            t * 100.0,
            2.0 / t
        );
    }
}

/// Running time of all threads (s), if the system gives it; other programs on the machine are not
/// included.
fn processor_time() -> Option<f64> {
    let mut sum = 0.0;
    for task in std::fs::read_dir("/proc/self/task").ok()? {
        let text = std::fs::read_to_string(task.ok()?.path().join("schedstat")).ok()?;
        sum += text.split(' ').next()?.parse::<f64>().ok()? * 1e-9;
    }
    Some(sum)
}
