//! Every point and direction named by an equation table has a letter in the kinematic diagram: a
//! reader of ∥CF looks for F.

use std::collections::BTreeSet;

use hodograph::figure::sheet::{SheetOptions, drawing, equations};
use hodograph::paper::item::{Figure, Shape};
use hodograph::scene::{self, DiagramKind, Lang, templates};
use hodograph::worked::{Scope, work};

fn labels(figure: &Figure) -> Vec<&str> {
    figure
        .items
        .iter()
        .filter_map(|i| {
            if let Shape::Label { label, .. } = &i.shape { Some(label.source()) } else { None }
        })
        .collect()
}

/// Removes typesetting: a point is O_1 where a length's index has O1, and t–t is the direction t.
fn plain(name: &str) -> String {
    name.replace("\\text{–}t", "").replace(['{', '}', '_'], "")
}

/// The names in a direction (`\perp AB`, `B \to A_2`, `\parallel t_{3}`) or in the lengths of a
/// magnitude (`\omega_2^2 l_{AB}`).
fn named(source: &str) -> Vec<String> {
    let of_direction = ["\\perp", "\\parallel", "\\to"].iter().any(|w| source.contains(w));
    let mut out = Vec::new();
    if of_direction {
        let bare = ["\\perp", "\\parallel", "\\to"]
            .iter()
            .fold(source.to_owned(), |s, w| s.replace(w, " "));
        let bare = bare.replace("\\text{–}t", "");
        out.extend(points(&bare));
    }
    for part in source.split("l_{").skip(1) {
        let mut depth = 1;
        let inside = part.chars().take_while(|c| {
            depth += i32::from(*c == '{') - i32::from(*c == '}');
            depth > 0
        });
        out.extend(points(&inside.collect::<String>()));
    }
    out
}

/// Letters with their attachments: `A`, `O_2`, `B_{31}`, `K'`, `t_{3}`.
fn points(text: &str) -> Vec<String> {
    let mut out: Vec<String> = Vec::new();
    let (mut depth, mut hanging) = (0, false);
    for c in text.chars() {
        let begins = depth == 0 && !hanging && c.is_alphabetic();
        if begins {
            out.push(String::new());
        }
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        hanging = c == '_';
        if let Some(last) = out.last_mut() {
            last.push(c);
        }
    }
    out.iter().map(|name| plain(name.trim())).collect()
}

#[test]
fn every_letter_of_a_table_is_in_the_diagram() {
    let (mut missing, mut seen) = (BTreeSet::new(), 0);
    for t in templates::list() {
        let scene = scene::read(templates::get(t.name).unwrap()).unwrap().value;
        let worked = work(&scene, Scope::Figure).unwrap().value;
        for lang in [Lang::En, Lang::Zh] {
            let options = SheetOptions::of_language(lang);
            let Some(tables) = equations(&scene, &worked, &options) else { continue };
            let diagram = drawing(&scene, &worked, &options, DiagramKind::Plane).unwrap();
            let drawn: Vec<String> = labels(&diagram).iter().map(|l| plain(l)).collect();
            for source in labels(&tables) {
                for name in named(source) {
                    seen += 1;
                    // A point with its link, B_3, is found at B; a direction of an axis needs no
                    // letter.
                    let there = drawn.iter().any(|d| name == *d || name.starts_with(d.as_str()));
                    if !there && name != "x" && name != "y" {
                        missing.insert(format!("{} {lang:?}: {name} of `{source}`", t.name));
                    }
                }
            }
        }
    }
    assert!(seen > 1000, "only {seen} names were read in the tables");
    assert!(
        missing.is_empty(),
        "{} letters are not in the diagram:\n{}",
        missing.len(),
        Vec::from_iter(missing).join("\n")
    );
}
