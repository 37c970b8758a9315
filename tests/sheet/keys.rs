//! Keys of crowded polygons beyond the sheet, and captions of drawings side by side.

use hodograph::figure::sheet::{SheetOptions, sheet};
use hodograph::figure::{poses, steps::StepFigures};
use hodograph::geom::Point;
use hodograph::paper::item::{Figure, Shape};
use hodograph::scene::{Lang, Scene, Swept, read, templates};
use hodograph::worked::{Scope, Worked, work};
use std::collections::BTreeMap;

fn open(name: &str) -> (Scene, Worked) {
    let scene = read(templates::get(name).unwrap()).unwrap().value;
    let worked = work(&scene, Scope::Figure).unwrap().value;
    (scene, worked)
}

/// The labels whose id begins with this: id, place, text.
fn labels(figure: &Figure, start: &str) -> Vec<(String, Point, String)> {
    let label = |i: &hodograph::paper::item::FigureItem| match &i.shape {
        Shape::Label { at, label, .. } if i.id.starts_with(start) => {
            Some((i.id.clone(), *at, label.source().to_owned()))
        }
        _ => None,
    };
    figure.items.iter().filter_map(label).collect()
}

/// Each page of a table of positions lists the vectors of a crowded column once, by different
/// letters at their ends, below the table; a column with names in a drawing has no list.
#[test]
fn crowded_tables_of_positions_have_a_key() {
    let pages = |name: &str| {
        let (scene, worked) = open(name);
        let wanted = poses::PosesContent { count: 6, swept: Swept::Driver(0), points: Vec::new() };
        let options = SheetOptions::of_language(Lang::En);
        poses::sheets(&scene, &worked, &options, &wanted).unwrap().value
    };
    for name in ["class-iii-six-bar", "stephenson-six-bar"] {
        for page in pages(name) {
            let key = labels(&page, "acc-key-");
            assert!(key.len() > 10, "{name}: {key:?}");
            let rules = page.items.iter().filter(|i| i.class == "rule").filter_map(|i| i.bounds());
            let bottom = rules.map(|b| b.min.y).fold(f64::INFINITY, f64::min);
            for (id, at, text) in &key {
                let (_, ends) = text.split_once(":\\quad ").unwrap();
                let halves = ends.split_at(ends.len() / 2);
                assert!(halves.0 != halves.1, "{name}: {text}");
                assert!(at.y > 0.0 && at.y < bottom, "{name}: {id} at {}", at.y);
                assert_eq!(key.iter().filter(|other| other.0 == *id).count(), 1, "{name}: {id}");
            }
        }
    }
    for page in pages("crank-rocker") {
        assert!(labels(&page, "vel-key-").is_empty());
    }
}

/// An entry of the key appears in the same step as its vector, and keeps its place.
#[test]
fn a_key_grows_with_the_steps() {
    let (scene, worked) = open("class-iii-six-bar");
    let options = SheetOptions::of_language(Lang::Zh);
    let steps = StepFigures::of(&scene, &worked, &options, None);
    let mut seen: BTreeMap<String, Point> = BTreeMap::new();
    for figure in steps.figures() {
        for (id, at, _) in labels(&figure, "acc-key-") {
            let vector = id.replacen("acc-key-", "acc-", 1);
            assert!(figure.items.iter().any(|i| i.id == vector), "{id} without {vector}");
            assert!(seen.insert(id.clone(), at).is_none_or(|before| before == at), "{id} moved");
        }
    }
    assert!(seen.len() >= 3, "{seen:?}");
}

/// Captions of polygons side by side are on one line.
#[test]
fn captions_of_a_row_are_on_one_line() {
    for name in ["crank-rocker", "atkinson", "radar-dish", "gear-linkage"] {
        for lang in [Lang::En, Lang::Zh] {
            let (scene, worked) = open(name);
            let drawn = sheet(&scene, &worked, &SheetOptions::of_language(lang)).unwrap();
            let line = |id: &str| labels(&drawn, id)[0].1;
            let [one, other] = ["caption-vel", "caption-acc"].map(line);
            assert!((one.x - other.x).abs() > 20.0, "{name}: the polygons are not side by side");
            assert!(
                (one.y - other.y).abs() < 1e-9,
                "{name}: captions at {} and {}",
                one.y,
                other.y
            );
        }
    }
}
