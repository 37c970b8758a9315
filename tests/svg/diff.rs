//! `diff` finds exactly the changes, and keeps its bounds.

use std::process::Command;

use hodograph::figure::sheet::{SheetOptions, sheet};
use hodograph::paper::item::{Figure, Shape};
use hodograph::paper::label::Label;
use hodograph::render::diff::{Options, Picture, compare, picture};
use hodograph::render::{png, svg};
use hodograph::scene::{self, Lang, templates};
use hodograph::worked::{Scope, work};

fn figure() -> Figure {
    let scene = scene::read(templates::get("crank-rocker").unwrap()).unwrap().value;
    let worked = work(&scene, Scope::Figure).unwrap().value;
    sheet(&scene, &worked, &SheetOptions::of_language(Lang::En)).unwrap()
}

fn written(figure: &Figure) -> Picture {
    Picture::Svg(svg::write(figure).unwrap().value)
}

#[test]
fn nothing_differs_between_a_figure_and_itself() {
    let one = written(&figure());
    let found = compare(&one, &one, &Options::default()).unwrap();
    assert!(found.is_empty() && found.lines().is_empty() && found.pixels.over == 0, "{found:?}");
}

#[test]
fn a_moved_vector_is_found_with_its_millimetres() {
    let (old, mut new) = (figure(), figure());
    let item = new.items.iter_mut().find(|i| i.id == "vel-rel-C-B").unwrap();
    let Shape::Arrow { to, .. } = &mut item.shape else { panic!("an arrow") };
    *to = *to + hodograph::geom::Vec2::new(0.3, -0.4);
    let found = compare(&written(&old), &written(&new), &Options::default()).unwrap();
    let [v] = &found.vectors[..] else { panic!("{found:?}") };
    assert_eq!((v.id.as_str(), v.name.as_str()), ("vel-rel-C-B", "v_CB"));
    assert!(v.moved_mm[0] == 0.0 && (v.moved_mm[1] - 0.5).abs() < 2e-3, "{:?}", v.moved_mm);
    assert!(
        found.moved.is_empty()
            && found.texts.is_empty()
            && found.added.is_empty()
            && found.removed.is_empty()
    );
    assert!(found.pixels.over > 20 && found.pixels_differ);
    // Within a tolerance an item has not moved; the pixels are counted and decide nothing.
    let wide = Options { tolerance_mm: 0.6, pixels: None, ..Options::default() };
    let found = compare(&written(&old), &written(&new), &wide).unwrap();
    assert!(found.is_empty() && found.pixels.over > 20, "{found:?}");
}

#[test]
fn changed_texts_colours_and_items_are_found() {
    let (old, mut new) = (figure(), figure());
    let label = new.items.iter_mut().find(|i| i.id == "vel-label-rel-C-B").unwrap();
    if let Shape::Label { label, .. } = &mut label.shape {
        *label = Label::math("v_{BC}");
    }
    let edge = new.items.iter_mut().find(|i| i.id == "acc-abs-E").unwrap();
    if let Shape::Arrow { stroke, .. } = &mut edge.shape {
        stroke.width_mm *= 2.0;
    }
    new.items.retain(|i| i.id != "mechanism-point-E");
    let pin = new.items.iter_mut().find(|i| i.id == "mechanism-pin-B").unwrap();
    pin.id = "mechanism-pin-Q".into();
    new.title = "Another".into();
    let found = compare(&written(&old), &written(&new), &Options::default()).unwrap();
    let texts: Vec<[&str; 3]> =
        found.texts.iter().map(|t| [t.id.as_str(), &t.old, &t.new]).collect();
    assert_eq!(
        texts,
        [
            ["<title>", "Crank-rocker with a coupler point", "Another"],
            ["vel-label-rel-C-B", "v_{CB}", "v_{BC}"]
        ]
    );
    assert_eq!(found.restyled, ["acc-abs-E"]);
    assert_eq!(found.removed, ["mechanism-pin-B", "mechanism-point-E"]);
    assert_eq!(found.added, ["mechanism-pin-Q"]);
    assert!(found.vectors.is_empty() && found.moved.is_empty(), "{found:?}");
}

#[test]
fn png_files_are_compared_by_their_pixels() {
    let draw = |f: &Figure| {
        Picture::read(png::render(&svg::write(f).unwrap().value, 60.0).unwrap()).unwrap()
    };
    let (old, mut new) = (figure(), figure());
    new.items.retain(|i| i.id != "vel-abs-B");
    assert!(compare(&draw(&old), &draw(&old), &Options::default()).unwrap().is_empty());
    let found = compare(&draw(&old), &draw(&new), &Options::default()).unwrap();
    let [left, top, right, bottom] = found.pixels.bounds.unwrap();
    assert!(
        found.pixels.over > 50 && right > left && bottom > top && found.vectors.is_empty(),
        "{found:?}"
    );
    let made = picture(&draw(&old), &draw(&new), &Options::default()).unwrap();
    // The picture shows in red the items of the first figure only.
    let Picture::Png(raster) = Picture::read(made).unwrap() else { panic!("a PNG") };
    let red = (left..right).flat_map(|x| (top..bottom).map(move |y| (x, y))).filter(|(x, y)| {
        let [r, g, b] = raster.at(*x, *y);
        r > 200 && g < 100 && b < 100
    });
    assert!(red.count() > 20);
    assert_eq!(
        compare(&draw(&old), &written(&old), &Options::default()).unwrap_err().code,
        "diff-kinds"
    );
}

/// Files that would take time or memory without bound, and files that are not figures, are refused.
#[test]
fn hostile_files_are_refused_at_once() {
    let root = |inner: &str| {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"9mm\" height=\"9mm\" viewBox=\"0 0 9 9\">{inner}</svg>"
        )
    };
    let laughs: String = (1..12)
        .map(|k| {
            format!(
                "<g id=\"a{k}\">{}</g>",
                format!("<use xlink:href=\"#a{}\"/>", k - 1).repeat(10)
            )
        })
        .collect();
    let bad = [
        root(&format!("<path id=\"a0\" d=\"M0 0\"/>{laughs}")),
        root(&format!("{}{}", "<g>".repeat(5000), "</g>".repeat(5000))),
        root("<filter id=\"f\"><feGaussianBlur stdDeviation=\"999\"/></filter>"),
        root("<image href=\"/etc/passwd\"/>"),
        root(&"<g/>".repeat(400_000)),
        root("").replace("width=\"9mm\"", "width=\"0mm\""),
        "<!DOCTYPE a [<!ENTITY b \"c\">]><svg>&b;</svg>".to_owned(),
        "not a picture".to_owned(),
    ];
    for text in bad {
        let fault = Picture::read(text.clone().into_bytes()).err();
        assert_eq!(fault.map(|d| d.code), Some("diff-input"), "{}", &text[..text.len().min(120)]);
    }
    // The header of a PNG of 60 000 by 60 000 pixels, without data.
    let mut huge = png::render(&root(""), 100.0).unwrap();
    huge[16..24].copy_from_slice(&[0, 0, 0xea, 0x60, 0, 0, 0xea, 0x60]);
    assert_eq!(Picture::read(huge).unwrap_err().code, "diff-input");
    // A page as large as a field is drawn coarsely.
    let field = Picture::Svg(root("").replace("\"9mm\"", "\"90000mm\""));
    let found = compare(&field, &field, &Options::default()).unwrap();
    assert!(found.is_empty() && found.pixels.sizes[0].iter().all(|side| *side < 5000));
}

#[test]
fn exit_codes_are_those_of_diff() {
    let folder = std::env::temp_dir().join(format!("hodograph-diff-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let at = |name: &str| folder.join(name).display().to_string();
    let (old, mut new) = (figure(), figure());
    new.items.retain(|i| i.id != "vel-abs-B");
    for (name, f) in [("a.svg", &old), ("b.svg", &new)] {
        std::fs::write(folder.join(name), svg::write(f).unwrap().value).unwrap();
    }
    let run = |args: &[&str]| {
        let out =
            Command::new(env!("CARGO_BIN_EXE_hodograph")).arg("diff").args(args).output().unwrap();
        (out.status.code().unwrap(), String::from_utf8(out.stdout).unwrap())
    };
    let [a, b, png, nowhere] = ["a.svg", "b.svg", "d.png", "a.svg/d.png"].map(at);
    assert_eq!(run(&[&a, &a]), (0, String::new()));
    let (code, said) = run(&[&a, &b, "-o", &png]);
    assert!(
        code == 1
            && said.starts_with("removed vel-abs-B\n")
            && std::fs::metadata(&png).unwrap().len() > 1000,
        "{code}: {said}"
    );
    assert!(run(&[&a, &b, "--lang", "zh"]).1.starts_with("缺少 vel-abs-B\n"));
    let (code, said) = run(&[&a, &b, "--json"]);
    let told: serde_json::Value = serde_json::from_str(&said).unwrap();
    assert!(code == 1 && told["removed"][0] == "vel-abs-B" && told["alike"] == false, "{told}");
    for bad in [
        &[&a, "/no/such.svg"][..],
        &[&a, &png],
        &[&a, &b, "-o", &nowhere],
        &[&a, &b, "-o", "d.svg"],
        &[&a, &b, "--tolerance", "-1"],
    ] {
        assert_eq!(run(bad).0, 2, "{bad:?}");
    }
    std::fs::remove_dir_all(&folder).unwrap();
}
