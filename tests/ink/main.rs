//! Checks that a reader can see on a sheet which label belongs to which item, measured on the
//! written SVG by `usvg`: ink boxes of letters, flattened paths of lines. The checks do not use the
//! placement of labels.
//!
//! The gate examines a few poses of each template; all of them (every 15° from 4°, both languages,
//! three styles): `HODOGRAPH_INK=all cargo test --test ink -- --nocapture`. One template:
//! `HODOGRAPH_ONLY=shaper`.

mod faults;
mod read;

use faults::Faults;
use hodograph::figure::fit::pages;
use hodograph::figure::list::{Extras, FigureInput, USUAL};
use hodograph::figure::sheet::{SheetOptions, sheet};
use hodograph::paper::extent::bounds;
use hodograph::paper::item::Shape;
use hodograph::paper::style::Style;
use hodograph::render::svg;
use hodograph::scene::{
    self, ByKind, DriverKind, Lang, Scene, driver_position, templates, with_driver_at,
};
use hodograph::worked::{Scope, work};

/// First angle of the whole check (deg), so that nothing is perpendicular by accident.
const FIRST_DEG: usize = 4;
const STEP_DEG: usize = 15;
/// The gate takes every n-th of these; each template begins with another one.
const SAMPLE: usize = 12;

fn all() -> bool {
    std::env::var("HODOGRAPH_INK").is_ok_and(|v| v == "all")
}

/// The scene as written, and at odd angles of its first turning driver.
fn poses(scene: &Scene, template: usize) -> Vec<Scene> {
    let mut out = vec![scene.clone()];
    let turns = matches!(scene.drivers.first().map(|d| &d.kind), Some(DriverKind::Turn { .. }));
    if turns && driver_position(scene, 0).is_some() {
        let picked = |k: &usize| all() || k % SAMPLE == template % SAMPLE;
        let angle = |k: usize| ((FIRST_DEG + STEP_DEG * k) as f64).to_radians();
        out.extend((0..360 / STEP_DEG).filter(picked).map(|k| with_driver_at(scene, 0, angle(k))));
    }
    out
}

#[test]
fn what_belongs_to_what_is_seen() {
    let only = std::env::var("HODOGRAPH_ONLY").unwrap_or_default();
    let looks: &[(Lang, &str)] =
        &[(Lang::En, "print"), (Lang::Zh, "slides"), (Lang::En, "dark"), (Lang::Zh, "print")];
    let (mut total, mut told, mut sheets) = (Faults::default(), Vec::new(), 0);
    for (t, template) in templates::list()
        .iter()
        .enumerate()
        .filter(|(_, t)| only.is_empty() || only.split(',').any(|o| o == t.name))
    {
        let scene = scene::read(templates::get(template.name).unwrap()).unwrap().value;
        for (k, pose) in poses(&scene, t).iter().enumerate() {
            let Ok(worked) = work(pose, Scope::Figure) else { continue };
            for (lang, style) in looks
                .iter()
                .enumerate()
                .filter(|(l, _)| all() || (k + t) % 2 == *l)
                .map(|(_, l)| *l)
            {
                let options = SheetOptions {
                    style: Style::named(style).unwrap(),
                    ..SheetOptions::of_language(lang)
                };
                let figure = sheet(pose, &worked.value, &options).unwrap();
                let found = faults::of(&read::read(&svg::write(&figure).unwrap().value));
                sheets += 1;
                let angle = driver_position(pose, 0).unwrap_or_default().to_degrees();
                told.extend(
                    found
                        .list
                        .iter()
                        .map(|f| format!("{} at {angle:.1} {lang:?} {style}: {f}", template.name)),
                );
                total.add(found);
            }
        }
    }
    assert!(sheets > 0);
    println!("{sheets} sheets\n{}\n{}", total.table(), told.join("\n"));
    assert!(total.can_be_read(sheets), "{}", total.table());
}

/// Page formats and the smallest type (mm) on them: 8.8 points in print, 13.6 points on a slide.
const FORMATS: [(&str, f64); 7] = [
    ("a4", 3.1),
    ("16:9", 4.8),
    ("80mm", 3.1),
    ("a4-landscape", 3.1),
    ("4:3", 4.8),
    ("120mm", 3.1),
    ("170mm", 3.1),
];

/// The gate draws each template in one of the formats, the whole check in all.
#[test]
fn pages_of_all_formats_have_their_size_and_legible_type() {
    let (mut total, mut faults, mut drawn) = (Faults::default(), Vec::new(), 0);
    for (t, template) in templates::list().iter().enumerate() {
        let scene = scene::read(templates::get(template.name).unwrap()).unwrap().value;
        let worked = work(&scene, Scope::Figure).unwrap().value;
        for (k, (name, least)) in FORMATS.iter().enumerate() {
            if !all() && (t + k) % FORMATS.len() != 0 {
                continue;
            }
            let format = scene::page(name).unwrap();
            let lang = if (t + k) % 2 == 0 { Lang::En } else { Lang::Zh };
            let (options, extras) = (SheetOptions::of_language(lang), Extras::default());
            let wanted =
                FigureInput { scene: &scene, worked: &worked, options: &options, extras: &extras };
            let what = format!("{} on {name}, {lang:?}", template.name);
            let made = match pages(USUAL, &wanted, &format) {
                Ok(made) => made,
                // A scale that the scene fixes is kept.
                Err(_) if scene.paper.scales != ByKind::default() => continue,
                Err(e) => panic!("{what}: {e}"),
            };
            for (word, figure) in made.value {
                drawn += 1;
                let ink = bounds(&figure.items).unwrap();
                let size = [figure.width_mm, figure.height_mm];
                let whole = size == [format.width_mm, format.height_mm];
                if size[0] != format.width_mm
                    || size[1] > format.height_mm
                    || format.whole && !whole
                    || ink.min.x.min(ink.min.y) < 0.0
                    || ink.max.x > size[0]
                    || ink.max.y > size[1]
                {
                    faults.push(format!("{what}, page {word}: {size:?} mm, ink {ink:?}"));
                }
                for item in &figure.items {
                    if let Shape::Label { size_mm, .. } = item.shape
                        && size_mm < *least
                    {
                        faults.push(format!("{what}, page {word}: {} of {size_mm} mm", item.id));
                    }
                }
                let found = faults::of(&read::read(&svg::write(&figure).unwrap().value));
                faults.extend(found.list.iter().map(|f| format!("{what}, page {word}: {f}")));
                total.add(found);
            }
        }
    }
    println!("{drawn} pages\n{}\n{}", total.table(), faults.join("\n"));
    assert!(total.can_be_read(drawn), "{}", total.table());
    let other = faults.len() - total.list.len();
    assert_eq!(other, 0, "{} faults", other);
}
