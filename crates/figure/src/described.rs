//! Describes a figure for readers who cannot see it: the drawings on it, with the links of the
//! mechanism and the vectors of the polygons.

use hodograph_base::lang::{each, say, tr};
use std::collections::HashSet;

use hodograph_paper::paper::item::{FigureItem, Shape};
use hodograph_scene::{Lang, Scene};

/// Maximum number of names of one kind; the others are counted.
const TOLD: usize = 16;

/// Returns a sentence that gives the title and the drawings that these items show.
pub fn described(scene: &Scene, lang: Lang, title: &str, items: &[FigureItem]) -> String {
    let first = |kind: &str| items.iter().any(|i| i.class.split(' ').next() == Some(kind));
    let word = |what: &str| items.iter().any(|i| i.class.split(' ').any(|w| w == what));
    let mut shown = Vec::new();
    if first("mechanism") {
        let moving = (0..scene.links.len())
            .filter(|l| *l != scene.ground.0)
            .map(|l| scene.links[l].name.clone())
            .collect();
        let (links, ground) = (list(lang, moving), scene.link_name(scene.ground));
        shown.push(say!(lang, "kinematic diagram to scale, links {links}, ground {ground}"));
    }
    let polygons =
        [("velocity", each!("velocity polygon")), ("acceleration", each!("acceleration polygon"))];
    for (kind, name) in polygons {
        if !items.iter().any(|i| i.class.starts_with(&format!("{kind} pole"))) {
            continue;
        }
        let names = vectors(items, kind);
        let what = lang.pick(name);
        shown.push(match names.is_empty() {
            true => what.to_owned(),
            false => say!(lang, "{what} of {}", list(lang, names)),
        });
    }
    if word("table") || word("statement") {
        shown.push(tr!(lang, "vector equations").to_owned());
    }
    if word("result") {
        shown.push(tr!(lang, "results").to_owned());
    }
    let (colon, between, end) = match lang {
        Lang::En => (": ", "; ", ". "),
        Lang::Zh => ("：", "；", "。"),
    };
    if shown.is_empty() {
        format!("{title}{end}")
    } else {
        format!("{title}{colon}{}{end}", shown.join(between))
    }
}

/// The symbols of a polygon's vectors, taken from its labels.
fn vectors(items: &[FigureItem], kind: &str) -> Vec<String> {
    let (mut out, mut seen) = (Vec::new(), HashSet::new());
    for item in items {
        let Shape::Label { label, .. } = &item.shape else { continue };
        let mut words = item.class.split(' ');
        if words.next() == Some(kind)
            && words.any(|w| matches!(w, "edge" | "absolute"))
            && seen.insert(label.plain())
        {
            out.push(label.plain());
        }
    }
    out
}

fn list(lang: Lang, mut names: Vec<String>) -> String {
    let more = names.len().saturating_sub(TOLD);
    names.truncate(TOLD);
    let told = names.join(lang.comma());
    match more {
        0 => told,
        more => say!(lang, "{told} and {more} more"),
    }
}
