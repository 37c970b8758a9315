//! Legibility of the figures of `--figure composite` and `--figure attempts`: every template, in
//! both languages, in the pose of its file and at 24 positions of its driver.
//!
//! The gate examines one of the positions, another one for each template; all of them:
//! `HODOGRAPH_WIDE=1 HODOGRAPH_EXTRA=all cargo test --test sheet read -- --nocapture`. One
//! template: `HODOGRAPH_ONLY=shaper`.

use crate::legible::{SMALLEST_MM, look, poses};
use crate::wide::every;
use hodograph::figure::list::{self, Extras, FigureInput};
use hodograph::figure::sheet::{SheetOptions, drawing};
use hodograph::paper::item::{Colour, Shape};
use hodograph::paper::style::Style;
use hodograph::scene::{self, DiagramKind, Lang, templates};
use hodograph::worked::{Scope, work};

/// The position of the 24 that the gate examines, another one for each template.
fn rotation() -> usize {
    24 / every(8)
}

fn all() -> bool {
    std::env::var("HODOGRAPH_EXTRA").is_ok_and(|v| v == "all")
}

fn every_page_can_be_read(name: &str) {
    let only = std::env::var("HODOGRAPH_ONLY").unwrap_or_default();
    let entry = list::named(name).unwrap();
    let (mut faults, mut pages, mut labels) = (Vec::new(), 0, 0);
    for (t, template) in templates::list().iter().enumerate() {
        if !only.is_empty() && !only.split(',').any(|o| o == template.name) {
            continue;
        }
        let scene = scene::read(templates::get(template.name).unwrap()).unwrap().value;
        if !all() && t % every(4) != 0 {
            continue;
        }
        for (k, pose) in std::iter::once(scene.clone()).chain(poses(&scene)).enumerate() {
            if !all() && k > 0 && (k + t) % rotation() > 0 {
                continue;
            }
            let pose = &pose;
            let Ok(worked) = work(pose, Scope::Figure) else { continue };
            for lang in [Lang::En, Lang::Zh] {
                let options = SheetOptions::of_language(lang);
                let wanted = FigureInput {
                    scene: pose,
                    worked: &worked.value,
                    options: &options,
                    extras: &Extras::default(),
                };
                let drawn = match (entry.draw)(&wanted) {
                    Ok(drawn) => drawn.value,
                    // A named mistake may be possible only in the pose of the file.
                    Err(_) if k > 0 => continue,
                    Err(f) => panic!("{} pose {k}: {f}", template.name),
                };
                for (page, figure) in &drawn {
                    let found = look(figure, pose.links.len());
                    pages += 1;
                    labels += figure.labels_placed();
                    // Three solutions with the graphic scale of each drawing fill a page.
                    let least_mm = if name == "composite" { 2.1 } else { SMALLEST_MM };
                    if found.overlaps + found.outside > 0 || found.smallest_mm < least_mm {
                        let (o, out, least) = (found.overlaps, found.outside, found.smallest_mm);
                        faults.push(format!(
                            "{} pose {k} {lang:?} {page}: {o} overlaps, {out} outside, smallest type {least:.2} mm",
                            template.name
                        ));
                    }
                }
            }
        }
    }
    println!("{name}: {pages} pages, {labels} labels");
    assert!(!only.is_empty() || pages > 40, "only {pages} pages of {name}");
    assert!(faults.is_empty(), "{} pages:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn composite_motions_can_be_read() {
    every_page_can_be_read("composite");
}

#[test]
fn wrong_solutions_can_be_read() {
    every_page_can_be_read("attempts");
}

/// A rocker that is a plate holds its roller at a corner: the whole rim is visible, over the plate.
#[test]
fn a_roller_lies_over_the_plate_that_holds_it() {
    let changes = [
        (r#""3": ["C", "D"]"#, r#""3": ["C", "D", "E"]"#),
        (r#""CD": "l_CD""#, r#""CD": "l_CD", "DE": "30 mm", "CE": "50 mm""#),
        (r#""D": "right of CA""#, r#""D": "right of CA", "E": "left of CD""#),
    ];
    let mut text = templates::get("cam-centres").unwrap().to_owned();
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replacen(from, to, 1);
    }
    let scene = scene::read(&text).unwrap().value;
    let worked = work(&scene, Scope::Figure).unwrap().value;
    let figure =
        drawing(&scene, &worked, &SheetOptions::of_language(Lang::En), DiagramKind::Plane).unwrap();
    let last = |what: &str| {
        figure.items.iter().rposition(|i| i.class.split_whitespace().any(|c| c == what))
    };
    let (plate, roller) = (last("plate"), last("roller"));
    assert!(plate.is_some() && plate < roller, "plate {plate:?}, roller {roller:?}");
}

/// In a coloured style every moving link with a number has one colour for number and lines, and no
/// two links share one.
#[test]
fn twelve_links_have_twelve_colours() {
    let scene = scene::read(templates::get("excavator").unwrap()).unwrap().value;
    let worked = work(&scene, Scope::Figure).unwrap().value;
    for style in ["slides", "dark"] {
        let options = SheetOptions {
            style: Style::named(style).unwrap(),
            ..SheetOptions::of_language(Lang::En)
        };
        let figure = drawing(&scene, &worked, &options, DiagramKind::Plane).unwrap();
        let mut colours: Vec<(usize, Colour)> = Vec::new();
        for item in &figure.items {
            let (
                Some(link),
                Shape::Line { stroke, .. } | Shape::Polyline { stroke: Some(stroke), .. },
            ) = (item.link, &item.shape)
            else {
                continue;
            };
            match colours.iter().find(|(l, _)| *l == link) {
                Some((_, c)) => assert_eq!(*c, stroke.colour, "{style}: {}", item.id),
                None => {
                    let twin = colours.iter().find(|(_, c)| *c == stroke.colour);
                    assert!(twin.is_none(), "{style}: links {link} and {twin:?} share a colour");
                    colours.push((link, stroke.colour));
                }
            }
        }
        assert_eq!(
            colours.len(),
            scene.links.len() - 1,
            "{style}: every moving link is drawn in its colour"
        );
    }
}
