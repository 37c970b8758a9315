//! Each stage from a scene to the sheet, and the whole command.
//!
//! `cargo bench --bench stages` prints medians; they make the table of docs/performance.md.

mod program;

use criterion::{Criterion, criterion_group};
use hodograph::construct::scale::Boxes;
use hodograph::figure::sheet::{SheetOptions, sheet};
use hodograph::mechanism::{Demand, Mechanism};
use hodograph::render::{png, svg};
use hodograph::scene::{self, Lang, templates};
use hodograph::worked::{Scope, work};
use hodograph::{analytic, construct, plan, position};
use std::hint::black_box;

fn stages(c: &mut Criterion) {
    for name in ["crank-rocker", "shaper", "jansen-leg"] {
        let text = templates::get(name).unwrap();
        let scene = scene::read(text).unwrap().value;
        let mechanism = Mechanism::new(&scene).unwrap().value;
        let demand = Demand::of(&scene, &mechanism);
        let at = position::configure(&scene, &mechanism, &demand).unwrap().value;
        let planned = plan::plan(&scene, &mechanism, &demand);
        let worked = work(&scene, Scope::Figure).unwrap().value;
        let options = SheetOptions::of_language(Lang::En);
        let figure = sheet(&scene, &worked, &options).unwrap();
        let drawn = svg::write(&figure).unwrap().value;
        let mut g = c.benchmark_group(name);
        g.bench_function("1 read", |b| b.iter(|| scene::read(black_box(text))));
        g.bench_function("2 mechanism", |b| b.iter(|| Mechanism::new(black_box(&scene))));
        g.bench_function("3 positions", |b| {
            b.iter(|| position::configure(black_box(&scene), &mechanism, &demand))
        });
        g.bench_function("4 plan", |b| {
            b.iter(|| plan::plan(black_box(&scene), &mechanism, &demand))
        });
        g.bench_function("5 construction", |b| {
            b.iter(|| {
                construct::construct(
                    black_box(&scene),
                    &mechanism,
                    &at,
                    &planned,
                    &Boxes::default(),
                )
            })
        });
        g.bench_function("6 loop equations", |b| {
            b.iter(|| analytic::solve(black_box(&scene), &mechanism, &at, &demand))
        });
        g.bench_function("7 figure", |b| b.iter(|| sheet(black_box(&scene), &worked, &options)));
        g.bench_function("8 svg", |b| b.iter(|| svg::write(black_box(&figure))));
        g.bench_function("9 png 150 dpi", |b| b.iter(|| png::render(black_box(&drawn), 150.0)));
        g.bench_function("scene to svg", |b| {
            b.iter(|| {
                let scene = scene::read(black_box(text)).unwrap().value;
                let worked = work(&scene, Scope::Figure).unwrap().value;
                svg::write(&sheet(&scene, &worked, &options).unwrap())
            })
        });
        g.finish();
    }
}

fn command(c: &mut Criterion) {
    let folder = tempfile::tempdir().unwrap();
    let mut g = c.benchmark_group("whole command");
    // The lessons of the mechanisms with groups without closed form, and of the one with the most
    // links.
    for (template, name, extra) in [
        ("shaper", "svg", vec!["draw", "--format", "svg", "-o", "."]),
        ("shaper", "png 150 dpi", vec!["draw", "--format", "png", "--dpi", "150", "-o", "."]),
        ("shaper", "pdf", vec!["draw", "--format", "pdf", "-o", "."]),
        ("shaper", "worksheet pdf", vec!["worksheet", "-o", "worksheet.pdf"]),
        ("shaper", "lesson, 72 positions", vec!["lesson", "-o", "shaper.html"]),
        (
            "class-iii-six-bar",
            "lesson, 72 positions",
            vec!["lesson", "-o", "class-iii-six-bar.html"],
        ),
        (
            "stephenson-six-bar",
            "lesson, 72 positions",
            vec!["lesson", "-o", "stephenson-six-bar.html"],
        ),
        ("excavator", "lesson, 72 positions", vec!["lesson", "-o", "excavator.html"]),
    ] {
        let file = folder.path().join(format!("{template}.json"));
        std::fs::write(&file, templates::get(template).unwrap()).unwrap();
        g.bench_function(format!("{template}: {name}"), |b| {
            b.iter(|| {
                let status = program::hodograph()
                    .current_dir(folder.path())
                    .arg(extra[0])
                    .arg(&file)
                    .args(&extra[1..])
                    .stdout(std::process::Stdio::null())
                    .stderr(std::process::Stdio::null())
                    .status()
                    .unwrap();
                assert!(status.success());
            })
        });
    }
    g.finish();
    let mut written: Vec<_> =
        std::fs::read_dir(folder.path()).unwrap().map(|f| f.unwrap()).collect();
    written.sort_by_key(std::fs::DirEntry::file_name);
    for file in written {
        println!(
            "{}: {:.0} kB",
            file.file_name().display(),
            file.metadata().map_or(0.0, |m| m.len() as f64 / 1000.0)
        );
    }
}

criterion_group!(benches, stages, command);

fn main() -> std::process::ExitCode {
    program::or(|| {
        benches();
        Criterion::default().configure_from_args().final_summary();
    })
}
