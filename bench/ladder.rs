//! Cost of a rung of the precision ladder: positions, motions and answers of one scene in each kind
//! of number, and the whole of `certify` compared with the plain `f64` solution. Ratios within one
//! run: `cargo bench --bench ladder`.

use criterion::{Criterion, criterion_group, criterion_main};
use hodograph::answer::evaluate;
use hodograph::certified::{certify, steps};
use hodograph::number::{Ball, Big, Dd, within};
use hodograph::scene::{Scene, read, templates};
use hodograph::worked::{Scope, Worked, work};
use hodograph::{motion, position};
use std::hint::black_box;

fn solved<N: motion::MotionNumber>(scene: &Scene, w: &Worked) -> usize {
    let at = position::recompute::<N>(scene, &w.mechanism, &w.demand, &w.configuration).unwrap();
    let motion = motion::solve(scene, &w.mechanism, &at, &w.demand);
    w.results
        .iter()
        .filter_map(|r| evaluate(scene, &at, &motion, &scene.find[r.find].what))
        .map(black_box)
        .count()
}

fn ladder(c: &mut Criterion) {
    for name in ["crank-rocker", "shaper", "jansen-leg", "class-iii-six-bar"] {
        let scene = read(templates::get(name).unwrap()).unwrap().value;
        let w = work(&scene, Scope::Questions).unwrap().value;
        let mut g = c.benchmark_group(name);
        g.bench_function("1 f64", |b| b.iter(|| solved::<f64>(&scene, &w)));
        g.bench_function("2 f64 with its error", |b| b.iter(|| solved::<Ball<f64>>(&scene, &w)));
        g.bench_function("3 certify to 4 digits", |b| b.iter(|| certify(&scene, &w, 4)));
        g.bench_function("4 double-double", |b| b.iter(|| solved::<Dd>(&scene, &w)));
        g.bench_function("5 double-double with its error", |b| {
            b.iter(|| solved::<Ball<Dd>>(&scene, &w))
        });
        g.bench_function("6 192 bit with its error", |b| {
            b.iter(|| within(192, || solved::<Ball<Big>>(&scene, &w)))
        });
        g.bench_function("7 certify to 14 digits", |b| b.iter(|| certify(&scene, &w, 14)));
        g.bench_function("8 certify the steps", |b| b.iter(|| steps(&scene, &w, None)));
        g.finish();
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20).warm_up_time(std::time::Duration::from_millis(300)).measurement_time(std::time::Duration::from_millis(1000));
    targets = ladder
}
criterion_main!(benches);
