//! Plots with axes of numbers and of powers of ten: everything is on the paper, and no name
//! overlaps another.

use std::time::{Duration, Instant};

use hodograph::effort::ways;
use hodograph::figure::curves::{self, CurveDiagram};
use hodograph::figure::price;
use hodograph::mechanism::Mechanism;
use hodograph::notation::Notation;
use hodograph::paper::extent::{Rect, bounds};
use hodograph::paper::item::{Figure, Shape};
use hodograph::paper::style::Style;
use hodograph::scene::{Angle, Lang, read, templates};
use hodograph::sweep::{self, PlacedScene, Stations, Width};
use hodograph::worked::{Scope, work};

fn faults_of(figure: &Figure, what: &str) -> Vec<String> {
    let mut faults = Vec::new();
    let ink = bounds(&figure.items).unwrap();
    if ink.min.x < 0.0
        || ink.min.y < 0.0
        || ink.max.x > figure.width_mm
        || ink.max.y > figure.height_mm
    {
        faults.push(format!(
            "{what}: ink at {ink:?} of {} x {} mm",
            figure.width_mm, figure.height_mm
        ));
    }
    let label = |i: &&hodograph::paper::item::FigureItem| matches!(i.shape, Shape::Label { .. });
    let boxes: Vec<(&str, Rect)> = figure
        .items
        .iter()
        .filter(label)
        .filter_map(|i| Some((i.id.as_str(), i.bounds()?)))
        .collect();
    for (k, (a, r)) in boxes.iter().enumerate() {
        for (b, s) in &boxes[k + 1..] {
            let (w, h) = (
                r.max.x.min(s.max.x) - r.min.x.max(s.min.x),
                r.max.y.min(s.max.y) - r.min.y.max(s.min.y),
            );
            if w > 0.05 && h > 0.05 {
                faults.push(format!("{what}: {a} on {b}"));
            }
        }
    }
    faults
}

#[test]
fn plots_stay_on_the_paper_and_their_names_apart() {
    let near = include_str!("../../docs/near-toggle.json");
    let near = read(near).unwrap().value;
    let worked = work(&near, Scope::Questions).unwrap().value;
    let start = Instant::now();
    let watch = ways::Watch { now: &|| start.elapsed(), patience: Duration::from_millis(1) };
    let measured = ways::measure(&near, &worked, watch).unwrap();
    let series = ways::toward_toggle(&near, watch).unwrap();
    let scene = read(templates::get("jansen-leg").unwrap()).unwrap().value;
    let mechanism = Mechanism::new(&scene).unwrap().value;
    let placed = PlacedScene::new(&scene, &mechanism).unwrap();
    let table = sweep::run(
        &placed,
        0,
        &Stations::turned(Angle::Deg(0.0), Angle::Deg(360.0), 90),
        Width::One,
    )
    .unwrap();
    let mut faults = Vec::new();
    for style in Style::names().map(|name| Style::named(name).unwrap()) {
        for lang in [Lang::En, Lang::Zh] {
            let figure = price::figure(&near, &measured, &series, &style, lang);
            let named = |text: &str| {
                figure.items.iter().filter(|i| matches!(&i.shape, Shape::Label { label, .. } if label.source() == text)).count()
            };
            assert!(
                named("10^{−10}") >= 2 && named("1") >= 2,
                "both vertical axes have their powers of ten"
            );
            faults.extend(faults_of(&figure, &format!("accuracy {} {lang:?}", style.name)));
            let diagram = CurveDiagram::of(&placed, 0, &table, &Notation::of_language(lang));
            for (k, page) in curves::pages(&scene, &diagram, &style, lang).iter().enumerate() {
                assert_eq!((page.width_mm, page.height_mm), (210.0, 297.0));
                faults.extend(faults_of(page, &format!("curves {} {lang:?} page {k}", style.name)));
            }
            let figure = curves::figure(&scene, &diagram, &style, lang);
            // More lines than kinds of dashes are still distinguishable.
            let mut strokes: Vec<String> = Vec::new();
            for item in
                figure.items.iter().filter(|i| i.class == "curve" && i.id.starts_with("panel-0-"))
            {
                if let Shape::Polyline { stroke: Some(s), .. } = item.shape {
                    strokes.push(format!("{:?} {}", s.dash, s.width_mm));
                }
            }
            let all = strokes.len();
            strokes.sort();
            strokes.dedup();
            assert_eq!((all, strokes.len()), (5, 5), "five velocities");
            faults.extend(faults_of(&figure, &format!("curves {} {lang:?}", style.name)));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
