//! What a position of a sweep costs: the compiled program against a loop written by hand, with four lanes and with one; the
//! cost against the length of a chain of dyads; whole sweeps and batches. `cargo bench --bench sweep` prints the README's table.
//!
//! Variants take turns, so that whatever else the machine does falls on all alike; medians count.

use fearless_simd::{Level, Simd, SimdBase, SimdFloat, f64x4};
use hodograph::mechanism::Mechanism;
use hodograph::scene::{Scene, edit, read, templates};
use hodograph::sweep::batch::{Batch, Choice};
use hodograph::sweep::program::{CHUNK, COS, SIN, VALUE};
use hodograph::sweep::vary::Variation;
use hodograph::sweep::{self, Placed, Stations, Width, compile};
use std::hint::black_box;
use std::time::Instant;

/// Rounds; the median of each variant is taken.
const ROUNDS: usize = 301;

/// Calls timed together, so that the clock's own time vanishes in them.
const CALLS: u32 = 400;

/// A name and what is timed.
type Variant = (String, Box<dyn FnMut()>);

fn scene(text: &str) -> Scene {
    read(text).unwrap_or_else(|f| panic!("{f}")).value
}

fn asked(name: &str, find: &[&str]) -> Scene {
    scene(&edit::with_find(templates::get(name).unwrap(), find).unwrap())
}

/// One chunk of a program, its inputs filled in: ns a position.
fn chunk_of(scene: &Scene, width: Width) -> Box<dyn FnMut()> {
    let m = Mechanism::new(scene).unwrap().value;
    let placed = Placed::new(scene, &m).unwrap();
    let program = compile(scene, &m, &placed.at, Some(0), &scene.find).unwrap();
    let now = sweep::station::position_now(scene, &placed.at, 0);
    let stations = Stations::slid(now, now + 0.1, CHUNK - 1, 1.0);
    let mut buffer = program.buffer();
    buffer.fill(VALUE, &stations.values);
    buffer.fill(COS, &stations.cosines);
    buffer.fill(SIN, &stations.sines);
    Box::new(move || program.run(black_box(&mut buffer), width))
}

/// Position, velocity and acceleration of C of the crank-rocker by hand: one fused loop, everything constant in registers.
struct ByHand {
    cos: [f64; CHUNK],
    sin: [f64; CHUNK],
    out: [[f64; CHUNK]; 6],
}

impl ByHand {
    #[inline(always)]
    fn run<S: Simd>(&mut self, simd: S) {
        let (l1, l2, l3, l4, w) = (0.1, 0.25, 0.2, 0.3, 10.0);
        let zero = f64x4::splat(simd, 0.0);
        for i in (0..CHUNK).step_by(4) {
            let (c, s) = (f64x4::from_slice(simd, &self.cos[i..i + 4]), f64x4::from_slice(simd, &self.sin[i..i + 4]));
            let (bx, by) = (c * l1, s * l1);
            let (dx, dy) = (-bx + l4, -by);
            let d2 = dx * dx + dy * dy;
            let m = (-d2 + (l2 + l3) * (l2 + l3)) * (d2 - (l2 - l3) * (l2 - l3));
            let root = m.max(zero).sqrt();
            let inverse = f64x4::splat(simd, 0.5) / d2;
            let (f, h) = ((d2 + (l2 * l2 - l3 * l3)) * inverse, root * inverse);
            let (cx, cy) = (bx + dx * f - dy * h, by + dy * f + dx * h);
            let (ux, uy, wx, wy) = (cx - bx, cy - by, cx - l4, cy);
            let det = f64x4::splat(simd, 1.0) / (ux * wy - uy * wx);
            let (vbx, vby) = (-by * w, bx * w);
            let p = (ux * vbx + uy * vby) * det;
            let (vx, vy) = (p * wy, -p * wx);
            let (rx, ry) = (vx - vbx, vy - vby);
            let p = (-(ux * bx + uy * by) * (w * w) - (rx * rx + ry * ry)) * det;
            let q = -(vx * vx + vy * vy) * det;
            for (out, v) in self.out.iter_mut().zip([cx, cy, vx, vy, p * wy - q * uy, q * ux - p * wx]) {
                v.store_slice(&mut out[i..i + 4]);
            }
        }
    }

    fn call(&mut self) {
        match Level::new().as_avx2() {
            Some(simd) => simd.vectorize(
                #[inline(always)]
                || self.run(simd),
            ),
            None => self.run(fearless_simd::Level::baseline().as_sse2().expect("the loop by hand is for x86")),
        }
    }
}

/// A crank that drives `n` dyads, each hanging on the last.
fn chain(n: usize) -> Scene {
    let (mut links, mut ground, mut points, mut lengths, mut side) =
        (String::new(), String::from("\"A\""), String::new(), String::new(), String::new());
    let mut find = Vec::new();
    let mut last = "B".to_owned();
    for i in 0..n {
        let (c, d) = (format!("C{i}"), format!("D{i}"));
        links.push_str(&format!(", \"{}\": [\"{last}\", \"{c}\"], \"{}\": [\"{c}\", \"{d}\"]", 10 + 2 * i, 11 + 2 * i));
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

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// Medians of all variants, in turn: ns a position.
fn measure(variants: &mut [Variant]) -> Vec<f64> {
    let mut times = vec![Vec::new(); variants.len()];
    for _ in 0..ROUNDS {
        for ((_, call), times) in variants.iter_mut().zip(&mut times) {
            let start = Instant::now();
            for _ in 0..CALLS {
                call();
            }
            times.push(start.elapsed().as_secs_f64() * 1e9 / f64::from(CALLS) / CHUNK as f64);
        }
    }
    times.into_iter().map(median).collect()
}

fn main() {
    let four_bar = asked("crank-rocker", &["v_C", "a_C"]);
    let leg = asked("jansen-leg", &["v_C", "v_D", "v_E", "v_F", "v_G", "a_C", "a_D", "a_E", "a_F", "a_G"]);
    let mut hand = ByHand { cos: [0.0; CHUNK], sin: [0.0; CHUNK], out: [[0.0; CHUNK]; 6] };
    for i in 0..CHUNK {
        (hand.sin[i], hand.cos[i]) = libm::sincos(1.0 + i as f64 * 1e-3);
    }
    let mut variants: Vec<Variant> = vec![
        ("four-bar, loop by hand, four lanes".into(), Box::new(move || black_box(&mut hand).call())),
        ("four-bar: position, velocity, acceleration".into(), chunk_of(&four_bar, Width::Widest)),
        ("the same, one lane".into(), chunk_of(&four_bar, Width::One)),
        ("four-bar: position and velocity".into(), chunk_of(&asked("crank-rocker", &["v_C"]), Width::Widest)),
        ("four-bar: position".into(), chunk_of(&asked("crank-rocker", &["x_C", "y_C"]), Width::Widest)),
        ("eight-link leg, all joints, all three".into(), chunk_of(&leg, Width::Widest)),
        ("the same, one lane".into(), chunk_of(&leg, Width::One)),
    ];
    let dyads = [1, 3, 10, 30, 100];
    variants.extend(dyads.map(|n| (format!("chain of {n} dyads, all three"), chunk_of(&chain(n), Width::Widest))));
    let times = measure(&mut variants);
    println!("| one core, in cache | ns a position | against the loop by hand |\n|---|---|---|");
    for ((name, _), t) in variants.iter().zip(&times) {
        println!("| {name} | {t:.2} | {:.2} |", t / times[0]);
    }
    println!("\n| dyads in a chain | ns a position and dyad |\n|---|---|");
    for (n, t) in dyads.iter().zip(&times[7..]) {
        println!("| {n} | {:.2} |", t / *n as f64);
    }
    batch();
}

/// Ten thousand random four-bars at 200 positions, both cores, in memory.
fn batch() {
    let scene = asked("crank-rocker", &["v_C", "a_C"]);
    let m = Mechanism::new(&scene).unwrap().value;
    let variation = Variation::new(&scene, &["l_AB", "l_BC", "l_CD"]).unwrap();
    let range = |name, from, to| variation.range(&scene, name, from, to, 1).unwrap();
    let values = vec![range("l_AB", "60", "120"), range("l_BC", "200", "300"), range("l_CD", "180", "260")];
    let choice = Choice::Random { count: 10_000, seed: 1 };
    let stations = Some(Stations::turned(hodograph::scene::Angle::Deg(0.0), hodograph::scene::Angle::Deg(358.2), 199));
    let batch = Batch { scene: &scene, mechanism: &m, variation: variation.clone(), values, choice, driver: 0, stations };
    let start = Instant::now();
    let mut rows = 0;
    for from in (0..10_000).step_by(320) {
        rows += black_box(batch.block(from, (from + 320).min(10_000))).columns[0].len();
    }
    let t = start.elapsed().as_secs_f64();
    println!("\n10 000 random four-bars × 200 positions: {rows} rows in {t:.3} s, {:.1} million positions/s", 2.0 / t);
}
