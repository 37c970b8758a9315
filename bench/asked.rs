//! Time over the questions asked, for one mechanism of eight links: quantities that are not asked
//! for cost nothing.
//!
//! `cargo bench --bench asked` times the computation from topology to answers (positions, plan,
//! drawing board, loop equations), without reader and topology, and prints the table of
//! docs/performance.md: the work and the time of each question, compared with all questions.
//! Variants take turns, so that other load on the machine affects all alike.

use hodograph::answer::evaluate;
use hodograph::construct::scale::Boxes;
use hodograph::effort::Work;
use hodograph::mechanism::{Demand, Mechanism};
use hodograph::scene::{self, Scene, templates};
use hodograph::worked::{Scope, work};
use hodograph::{analytic, construct, plan, position};
use serde_json::{Value, json};
use std::hint::black_box;
use std::time::Instant;

/// Number of calls timed together, so that the clock's own time is negligible.
const CALLS: u32 = 50;
/// Rounds; the median of each variant is taken.
const ROUNDS: usize = 2000;

struct Variant {
    name: &'static str,
    scene: Scene,
    mechanism: Mechanism,
}

impl Variant {
    fn new(name: &'static str, find: &[&str], change: impl Fn(&mut Value)) -> Variant {
        let mut json: Value = serde_json::from_str(templates::get("jansen-leg").unwrap()).unwrap();
        if !find.is_empty() {
            json["find"] = json!(find);
        }
        change(&mut json);
        let scene = scene::read(json.to_string()).unwrap_or_else(|f| panic!("{name}: {f}")).value;
        let mechanism = Mechanism::new(&scene).unwrap_or_else(|f| panic!("{name}: {f}")).value;
        Variant { name, scene, mechanism }
    }

    /// Solves from the topology to the answers, as `worked::work` does.
    fn solve(&self) {
        let (scene, m) = (black_box(&self.scene), &self.mechanism);
        let demand = Demand::of(scene, m);
        let at = position::configure(scene, m, &demand).unwrap().value;
        let planned = plan::plan(scene, m, &demand);
        let paper =
            construct::construct(scene, m, &at, &planned, &Boxes::of(&scene.paper, &planned))
                .unwrap();
        let solution = analytic::solve(scene, m, &at, &demand).unwrap();
        black_box(construct::read(scene, m, &at, &planned, &paper));
        for f in &scene.find {
            black_box(evaluate(scene, &at, &solution, &f.what));
        }
    }

    fn work(&self) -> Work {
        Work::of(&work(&self.scene, Scope::Questions).unwrap().value)
    }
}

/// Adds a dyad on the foot: links 9 and 10, which no question refers to.
fn with_a_dyad(json: &mut Value) {
    json["links"]["9"] = json!(["G", "H"]);
    json["links"]["10"] = json!(["H", "K"]);
    json["links"]["8"] = json!(["O", "B", "K"]);
    json["points"]["K"] = json!(["-60 mm", "-160 mm"]);
    json["lengths"]["GH"] = json!("90 mm");
    json["lengths"]["HK"] = json!("90 mm");
    json["side"]["H"] = json!("left of GK");
}

fn main() {
    let same = |_: &mut Value| {};
    let variants = [
        Variant::new("first joint C: position", &["x_C", "y_C"], same),
        Variant::new("first joint C: velocity", &["v_C"], same),
        Variant::new("first joint C: acceleration", &["a_C"], same),
        Variant::new("last joint F: position", &["x_F", "y_F"], same),
        Variant::new("last joint F: velocity", &["v_F"], same),
        Variant::new("last joint F: acceleration", &["a_F"], same),
        Variant::new(
            "all joints: positions",
            &["x_C", "y_C", "x_D", "y_D", "x_E", "y_E", "x_F", "y_F", "x_G", "y_G"],
            same,
        ),
        Variant::new("all joints: velocities", &["v_C", "v_D", "v_E", "v_F", "v_G"], same),
        Variant::new("all joints: accelerations", &["a_C", "a_D", "a_E", "a_F", "a_G"], same),
        Variant::new("all questions of the template", &[], same),
        Variant::new("first joint C: acceleration, with a further dyad", &["a_C"], with_a_dyad),
        Variant::new("last joint F: acceleration, with a further dyad", &["a_F"], with_a_dyad),
        Variant::new("last joint F: velocity, the driver with α", &["v_F"], |j| {
            j["driver"]["alpha"] = json!("3 rad/s^2")
        }),
    ];
    // `cargo test --all-targets` runs benches too: a single round is enough there.
    let rounds = if std::env::args().any(|a| a == "--bench") { ROUNDS } else { 1 };
    let mut times = vec![Vec::with_capacity(rounds); variants.len()];
    for _ in 0..rounds {
        for (v, times) in variants.iter().zip(&mut times) {
            let start = Instant::now();
            for _ in 0..CALLS {
                v.solve();
            }
            times.push(start.elapsed().as_secs_f64() / f64::from(CALLS) * 1e6);
        }
    }
    let medians: Vec<f64> = times
        .iter_mut()
        .map(|t| {
            t.sort_by(f64::total_cmp);
            t[t.len() / 2]
        })
        .collect();
    let whole = medians[variants.iter().position(|v| v.name.starts_with("all questions")).unwrap()];
    println!(
        "| asked | groups placed | unknowns v, a | vectors v, a | µs | of all |\n|---|---|---|---|---|---|"
    );
    for (v, t) in variants.iter().zip(&medians) {
        let w = v.work();
        let pair = |a: usize, b: usize| format!("{a}, {b}");
        println!(
            "| {} | {} | {} | {} | {t:.1} | {:.0} % |",
            v.name,
            w.groups_placed,
            pair(w.velocity.unknowns, w.acceleration.unknowns),
            pair(w.velocity.vectors, w.acceleration.vectors),
            100.0 * t / whole
        );
    }
    let time_of = |name: &str| medians[variants.iter().position(|v| v.name == name).unwrap()];
    println!("\nnot asked, against without it:");
    for (with, without) in [
        ("first joint C: acceleration, with a further dyad", "first joint C: acceleration"),
        ("last joint F: acceleration, with a further dyad", "last joint F: acceleration"),
        ("last joint F: velocity, the driver with α", "last joint F: velocity"),
    ] {
        println!("{:.3}  {with}", time_of(with) / time_of(without));
    }
}
