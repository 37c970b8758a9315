//! Sheets to draw on have the room that the solution needs, and their overlays have the same pole and
//! scales in the same places.

use hodograph::figure::frame::{FramePage, working_frame};
use hodograph::figure::list::{Extras, FigureInput};
use hodograph::figure::sheet::SheetOptions;
use hodograph::paper::extent::bounds;
use hodograph::paper::item::{Figure, FigureItem, Shape};
use hodograph::problem::{Kind, Options, read, solve, templates};
use hodograph::scene::{self, Lang};

fn has(item: &FigureItem, word: &str) -> bool {
    item.class.split_whitespace().any(|w| w == word)
}

fn pages(name: &str, lang: Lang, format: &str) -> Option<Vec<FramePage>> {
    let problem = read(templates::text(name, &[]).unwrap()).unwrap().value;
    let solved = solve(&problem, &Options::with_figures()).unwrap();
    let (scene, worked) = solved.mechanism()?;
    let (options, extras) = (SheetOptions::of_language(lang), Extras::default());
    let wanted = FigureInput { scene, worked, options: &options, extras: &extras };
    match working_frame(&wanted, &scene::page(format).unwrap()) {
        Ok(pages) => Some(pages),
        Err(faults) => {
            assert_eq!(faults.list[0].code, "no-figure", "{name}: {faults}");
            None
        }
    }
}

/// The poles of a figure, each with its name.
fn poles(figure: &Figure) -> Vec<(String, [f64; 2])> {
    let of = |m: hodograph::paper::shown::ShownMark| {
        let name = m.names.iter().find(|n| n.starts_with("pole-"))?;
        Some((name.clone(), [m.at.x, m.at.y]))
    };
    figure.marks().filter_map(of).collect()
}

#[test]
fn overlays_have_the_pole_in_its_place_and_stay_in_their_frames() {
    let mut drawn = 0;
    for template in templates::all().iter().filter(|t| t.kind == Kind::Scene) {
        let name = template.name;
        for (lang, format) in [(Lang::En, "a4"), (Lang::Zh, "a4-landscape")] {
            let Some(pages) = pages(name, lang, format) else { continue };
            drawn += 1;
            for FramePage { blank, overlay } in &pages {
                let size = |f: &Figure| [f.width_mm, f.height_mm];
                assert_eq!(size(blank), size(overlay), "{name}");
                assert_eq!(poles(blank), poles(overlay), "{name}");
                let registers = |f: &Figure| -> Vec<Option<_>> {
                    f.items
                        .iter()
                        .filter(|i| has(i, "register"))
                        .map(|i| bounds(std::slice::from_ref(i)))
                        .collect()
                };
                assert_eq!(registers(blank), registers(overlay), "{name}");
                let frames: Vec<_> = blank
                    .items
                    .iter()
                    .filter(|i| has(i, "frame"))
                    .filter_map(|i| bounds(std::slice::from_ref(i)))
                    .collect();
                // Nothing of the solution is on the sheet, and all of it is in a frame.
                let vector = |i: &&FigureItem| {
                    matches!(i.shape, Shape::Arrow { .. })
                        && (has(i, "velocity") || has(i, "acceleration"))
                };
                assert_eq!(blank.items.iter().filter(vector).count(), 0, "{name}");
                for item in overlay.items.iter().filter(|i| !has(i, "register") && !has(i, "title"))
                {
                    let Some(ink) = bounds(std::slice::from_ref(item)) else { continue };
                    let inside = frames.iter().any(|frame| {
                        frame.overlap_mm2(ink.grown(0.01)) > 0.0
                            && frame.min.x <= ink.min.x
                            && frame.max.x >= ink.max.x
                            && frame.min.y <= ink.min.y
                            && frame.max.y >= ink.max.y
                    });
                    assert!(inside, "{name}: {} {:?} {frames:?}", item.id, ink);
                }
                for (frame, k) in frames.iter().zip(0..) {
                    for other in &frames[k + 1..] {
                        assert_eq!(frame.overlap_mm2(*other), 0.0, "{name}");
                    }
                    assert!(frame.min.x > 0.0 && frame.max.x < blank.width_mm, "{name}");
                    assert!(frame.min.y > 0.0 && frame.max.y < blank.height_mm, "{name}");
                }
            }
            let poles: usize = pages.iter().map(|p| poles(&p.blank).len()).sum();
            assert!(poles >= 1, "{name}");
        }
    }
    assert!(drawn > 80, "{drawn}");
}

#[test]
fn worksheets_and_variants_write_sheets_and_overlays() {
    let folder = tempfile::tempdir().unwrap();
    let at = |file: &str| folder.path().join(file).to_str().unwrap().to_owned();
    std::fs::write(at("s.json"), templates::text("crank-rocker", &[]).unwrap()).unwrap();
    let run = |arguments: &[&str]| {
        assert_cmd::Command::new(env!("CARGO_BIN_EXE_hodograph")).args(arguments).assert()
    };
    run(&["worksheet", &at("s.json"), "--frame", "-o", &at("w.pdf")]).success();
    let vary = ["--vary", "phi_1=40..80/10", "--count", "3", "--frame", "--page", "a3"];
    run(&[&["variants", &at("s.json"), "-o", &at("set")], &vary[..]].concat()).success();
    let pages = |file: &str| {
        let bytes = std::fs::read(at(file)).unwrap();
        assert!(bytes.starts_with(b"%PDF"));
        String::from_utf8_lossy(&bytes).matches("/MediaBox").count()
    };
    let counts = ["w.pdf", "w-overlay.pdf", "set/frames.pdf", "set/overlays.pdf"].map(pages);
    assert_eq!(counts[0], counts[1]);
    assert_eq!(counts[2], counts[3]);
    run(&["worksheet", &at("s.json"), "--frame", "-o", &at("w.html")]).code(2);
    run(&["worksheet", &at("s.json"), "--frame", "--page", "80mm", "-o", &at("w.pdf")]).code(2);
}
