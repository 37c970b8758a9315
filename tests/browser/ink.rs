//! Compares the layout of a real browser with the one assumed by the checks of `tests/ink`: boxes
//! of letters and lines of sheets in Chromium, against those that `usvg` reads from the same file.

#[path = "../ink/read.rs"]
mod read;

use crate::chromium::Browser;
use crate::{browser, template};
use hodograph::figure::sheet::{SheetOptions, sheet};
use hodograph::paper::style::Style;
use hodograph::render::svg;
use hodograph::scene::{Lang, Scene, with_driver_at};
use hodograph::worked::{Scope, work};
use read::P;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Coordinates of the file are rounded to a thousandth of a millimetre, those of the browser to a
/// fraction of its pixel.
const OFF_MM: f64 = 0.05;

/// Left, top, right, bottom in mm, by id.
type Boxes = BTreeMap<String, [f64; 4]>;

/// The boxes in the browser: each label, and each line that has an id and no rotation of its own.
const MEASURE: &str = r#"(() => {
    const svg = document.querySelector("svg"), o = svg.getBoundingClientRect(), mm = svg.viewBox.baseVal.width / o.width;
    const out = {};
    for (const e of svg.querySelectorAll("[id]")) {
        if (!e.dataset.text || e.closest("defs")) continue;
        const r = e.getBoundingClientRect();
        out[e.id] = [(r.left - o.left) * mm, (r.top - o.top) * mm, (r.right - o.left) * mm, (r.bottom - o.top) * mm];
    }
    for (const e of svg.querySelectorAll("path[id], line[id], polyline[id], polygon[id]")) {
        if (e.closest("defs") || e.closest("[data-text]")) continue;
        const b = e.getBBox(), m = e.getCTM(), k = svg.getCTM().inverse().multiply(m);
        if (k.b || k.c) continue;
        const [x, y] = [k.a * b.x + k.e, k.d * b.y + k.f], [w, h] = [k.a * b.width, k.d * b.height];
        out[e.id] = [Math.min(x, x + w), Math.min(y, y + h), Math.max(x, x + w), Math.max(y, y + h)];
    }
    return JSON.stringify(out);
})()"#;

fn in_browser(b: &mut Browser, name: &str, markup: &str) -> Boxes {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("ink-{name}.html"));
    std::fs::write(
        &path,
        format!(
            "<!doctype html><html data-ready><meta charset=\"utf-8\"><title>{name}</title>{markup}"
        ),
    )
    .unwrap();
    b.open(&path, [1600, 1200]);
    let told = b.eval(MEASURE);
    serde_json::from_str(told.as_str().unwrap()).unwrap()
}

/// The boxes by `usvg`; an id of several lines is left out.
fn by_usvg(markup: &str) -> Boxes {
    let ink = read::read(markup);
    let turned = |class: &str| class.split_whitespace().any(|w| w == "turned");
    let letters = ink.texts.iter().filter(|t| !turned(&t.class)).map(|t| {
        assert!(!t.text.is_empty());
        (t.id.clone(), [t.ink.lo[0], t.ink.lo[1], t.ink.hi[0], t.ink.hi[1]])
    });
    let mut all: Boxes = letters.collect();
    let mut often: BTreeMap<&str, usize> = BTreeMap::new();
    ink.lines.iter().for_each(|l| *often.entry(&l.id).or_default() += 1);
    let drawn =
        |l: &&read::Line| l.width_mm > 0.0 && !l.pieces.is_empty() && !l.class.contains("leader");
    for line in ink.lines.iter().filter(drawn).filter(|l| often[l.id.as_str()] == 1) {
        let ends: Vec<P> = line.pieces.iter().flat_map(|(a, b)| [*a, *b]).collect();
        let side = |k: usize, pick: fn(f64, f64) -> f64, from: f64| {
            ends.iter().map(|p| p[k]).fold(from, pick)
        };
        let (low, high) = (f64::INFINITY, f64::NEG_INFINITY);
        all.insert(
            line.id.clone(),
            [
                side(0, f64::min, low),
                side(1, f64::min, low),
                side(0, f64::max, high),
                side(1, f64::max, high),
            ],
        );
    }
    assert!(!ink.marks.is_empty(), "a sheet names its places");
    all
}

fn sheets() -> Vec<(String, Scene, Lang, &'static str)> {
    let turned =
        |name: &str, degrees: f64| with_driver_at(&template(name), 0, degrees.to_radians());
    vec![
        ("shaper".into(), template("shaper"), Lang::En, "print"),
        ("crank-rocker".into(), turned("crank-rocker", 124.0), Lang::Zh, "slides"),
        ("excavator".into(), template("excavator"), Lang::En, "dark"),
        ("class-iii-six-bar".into(), turned("class-iii-six-bar", 49.0), Lang::Zh, "print"),
        ("planetary-gear".into(), template("planetary-gear"), Lang::En, "slides"),
    ]
}

#[test]
fn letters_and_lines_stand_where_the_checks_take_them_to_be() {
    let Some(mut b) = browser() else { return };
    for (name, scene, lang, style) in sheets() {
        let worked = work(&scene, Scope::Figure).unwrap().value;
        let options =
            SheetOptions { style: Style::named(style).unwrap(), ..SheetOptions::of_language(lang) };
        let markup = svg::write(&sheet(&scene, &worked, &options).unwrap()).unwrap().value;
        let (shown, read) = (in_browser(&mut b, &name, &markup), by_usvg(&markup));
        let both: Vec<(&String, [f64; 4], [f64; 4])> =
            shown.iter().filter_map(|(id, s)| Some((id, *s, *read.get(id)?))).collect();
        let labels = both.iter().filter(|(id, ..)| id.contains("-label-")).count();
        assert!(
            labels >= 10 && both.len() >= labels + 5,
            "{name}: {labels} labels among {} things in both",
            both.len()
        );
        for (id, s, r) in both {
            let off = s.iter().zip(&r).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off <= OFF_MM, "{name}: {id} is shown at {s:.3?} and read at {r:.3?}");
        }
    }
}
