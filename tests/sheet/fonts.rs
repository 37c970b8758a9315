//! The author's fonts: everything drawn in a style is set in the fonts of that style, and nothing
//! else is.

use std::time::{Duration, Instant};

use hodograph::effort::ways;
use hodograph::figure::curves::{self, CurveDiagram};
use hodograph::figure::mechanism::Overlay;
use hodograph::figure::sheet::{SheetOptions, diagram, sheet};
use hodograph::figure::steps::StepFigures;
use hodograph::figure::{path, poses, price};
use hodograph::mechanism::Mechanism;
use hodograph::notation::Notation;
use hodograph::paper::font::{Face, own::Fonts};
use hodograph::paper::item::{Figure, FigureItem, Shape};
use hodograph::paper::style::{self, Style};
use hodograph::paper::text;
use hodograph::scene::{Angle, Lang, PointId, Swept, read, templates};
use hodograph::sweep::{self, PlacedScene, Stations, Width};
use hodograph::worked::{Scope, work};
use hodograph::worksheet::{self, WorksheetSides, pages};

fn tinos() -> Fonts {
    let file = |name: &str| {
        std::fs::read(format!("{}/crates/paper/fonts/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap()
    };
    let names = ["tinos-normal.ttf", "tinos-italic.ttf"];
    names.iter().fold(Fonts::default(), |fonts, name| fonts.with(name, file(name)).unwrap())
}

#[test]
fn vectors_are_bold_in_vector_equations_alone() {
    let scene = read(templates::get("shaper").unwrap()).unwrap().value;
    let worked = work(&scene, Scope::Figure).unwrap().value;
    let style = style::read(br#"{ "notation": { "vectors": "bold" } }"#).unwrap();
    let notation = style.marks.over(&Notation::named("en").unwrap());
    let figure = sheet(
        &scene,
        &worked,
        &SheetOptions { style, notation, ..SheetOptions::of_language(Lang::En) },
    )
    .unwrap();
    let (mut bold, mut plain) = (0, 0);
    for item in &figure.items {
        let Shape::Label { label, .. } = &item.shape else { continue };
        let is_bold = text::set(label).runs.iter().any(|run| run.face == Face::Bold);
        let symbol = item.class.split(' ').any(|c| c == "symbol");
        assert_eq!(is_bold, symbol, "{} {}", item.class, label.plain());
        bold += usize::from(is_bold);
        plain += usize::from(!is_bold && label.plain().starts_with(['v', 'a']));
    }
    assert!(bold > 10 && plain > 10, "{bold} bold, {plain} plain");
}

/// Letters from a bundled font for words or quantities, and the number of letters from the author's
/// fonts.
fn letters<'a>(items: impl IntoIterator<Item = &'a FigureItem>) -> (Vec<String>, usize) {
    let (mut bundled, mut own) = (Vec::new(), 0);
    for item in items {
        let Shape::Label { label, .. } = &item.shape else { continue };
        for run in &text::set(label).runs {
            match run.face {
                Face::Own(_) => own += 1,
                Face::Roman | Face::Italic if run.text.chars().any(char::is_alphanumeric) => {
                    bundled.push(label.plain())
                }
                _ => {}
            }
        }
    }
    (bundled, own)
}

#[test]
fn every_label_is_set_in_the_fonts_of_its_style() {
    let scene = read(templates::get("crank-rocker").unwrap()).unwrap().value;
    let worked = work(&scene, Scope::Figure).unwrap().value.with_drafting(&scene);
    let style = Style { fonts: tinos(), ..Style::default() };
    let options = SheetOptions { style: style.clone(), ..SheetOptions::of_language(Lang::En) };
    let points = vec![PointId(scene.points.iter().position(|p| p.name == "E").unwrap())];
    let mut drawn: Vec<(&str, Vec<FigureItem>)> = Vec::new();
    let mut figures = |what: &'static str, list: Vec<Figure>| {
        drawn.extend(list.into_iter().map(|f| (what, f.items)))
    };
    figures("sheet", vec![sheet(&scene, &worked, &options).unwrap()]);
    figures("steps", StepFigures::of(&scene, &worked, &options, None).figures().collect());
    let overlay = Overlay { dimensions: true, ..Overlay::default() };
    figures("diagram", vec![diagram(&scene, &worked, &options, &overlay)]);
    let wanted = poses::PosesContent { count: 4, swept: Swept::Driver(0), points: points.clone() };
    figures("poses", poses::sheets(&scene, &worked, &options, &wanted).unwrap().value);
    let wanted = path::PathContent { points, swept: Swept::Driver(0), marks: 4, poses: 3 };
    figures("path", vec![path::figure(&scene, &worked, &options, &wanted).unwrap().value]);
    let mechanism = Mechanism::new(&scene).unwrap().value;
    let placed = PlacedScene::new(&scene, &mechanism).unwrap();
    let table = sweep::run(
        &placed,
        0,
        &Stations::turned(Angle::Deg(0.0), Angle::Deg(360.0), 90),
        Width::One,
    )
    .unwrap();
    let lines = CurveDiagram::of(&placed, 0, &table, &options.notation);
    figures("curves", vec![curves::figure(&scene, &lines, &style, Lang::En)]);
    let start = Instant::now();
    let watch = ways::Watch { now: &|| start.elapsed(), patience: Duration::from_millis(1) };
    let measured = ways::measure(&scene, &worked, watch).unwrap();
    figures("accuracy", vec![price::figure(&scene, &measured, &[], &style, Lang::En)]);
    let document = worksheet::worksheet(
        &scene,
        &worked,
        &worksheet::WorksheetOptions { sheet: options, sides: WorksheetSides::Both },
    );
    drawn.extend(
        pages::pages(&document)
            .into_iter()
            .map(|p| ("worksheet", p.parts.into_iter().flat_map(|p| p.items).collect())),
    );
    for (what, items) in &drawn {
        let (bundled, own) = letters(items);
        assert!(bundled.is_empty() && own > 0, "{what}: {own} in one's own, but {bundled:?}");
    }
    // The next figure of the same program does not use them.
    let usual = sheet(&scene, &worked, &SheetOptions::of_language(Lang::En)).unwrap();
    assert_eq!(letters(&usual.items).1, 0);
}
