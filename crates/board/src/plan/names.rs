//! Names of points and links in the label language.
//!
//! A scene names its points and links freely (`O2`, `A'`, `B_1`, `滑块`); in the label language an
//! underscore begins a subscript and a prime follows the sign that it marks. Every name in a label
//! passes through this file.

use super::{Plan, VertexPlace};
use std::collections::HashMap;

use hodograph_scene::{PointId, Scene};

/// Returns a name, or several run together (`O2B`, `3/2`), as part of a longer label: `B_1` →
/// `B\_1`.
///
/// ```
/// use hodograph_board::plan::names::name_label;
/// assert_eq!(name_label("O_"), "O\\_");
/// assert_eq!(name_label("B'"), "B'");
/// ```
pub fn name_label(names: &str) -> String {
    let mut out = String::with_capacity(names.len());
    // A prime needs a preceding sign: a letter, a digit, or another prime on one of these.
    let mut hosted = false;
    for c in names.chars() {
        match c {
            '_' => out.push_str("\\_"),
            '\'' if !hosted => out.push_str("\\'"),
            c => out.push(c),
        }
        hosted = c.is_alphanumeric() || c == '\'' && hosted;
    }
    out
}

/// Returns the label of a single point's name: `O2` → `O_{2}`, `A1'` → `A'_{1}`, `B` → `B`.
pub fn point_label(name: &str) -> String {
    match Parts::of(name) {
        Parts { head, digits: "", primes } => format!("{}{primes}", name_label(head)),
        Parts { head, digits, primes } => format!("{head}{primes}_{{{digits}}}"),
    }
}

/// Returns the image of a point in a polygon: `B` → `b`, `O2` → `o_{2}`, the point of link 3 at B →
/// `b_{3}`, each with `prime`.
pub(super) fn image_label(
    letters: &[String],
    point: PointId,
    link: Option<&str>,
    prime: &str,
) -> String {
    image_of(&letters[point.0], link, prime)
}

/// Returns the names of all points in the small letters of images. If two points have the same name
/// except for case, both keep their case.
pub(super) fn small_letters(scene: &Scene) -> Vec<String> {
    let lower: Vec<String> = scene.points.iter().map(|p| p.name.to_lowercase()).collect();
    let mut of: HashMap<&str, usize> = HashMap::new();
    for name in &lower {
        *of.entry(name).or_default() += 1;
    }
    scene
        .points
        .iter()
        .zip(&lower)
        .map(|(p, l)| if of[l.as_str()] > 1 { p.name.clone() } else { l.clone() })
        .collect()
}

/// Returns the image label of a name that is already in the case of images.
pub(super) fn image_of(name: &str, link: Option<&str>, prime: &str) -> String {
    let Parts { head, digits, primes } = Parts::of(name);
    let link = link.map(name_label).unwrap_or_default();
    let comma = if digits.is_empty() || link.is_empty() { "" } else { "," };
    let sub = format!("{digits}{comma}{link}");
    let head = format!("{}{primes}{prime}", name_label(head));
    if sub.is_empty() { head } else { format!("{head}_{{{sub}}}") }
}

/// Returns a point's name followed by the number of a link, with a comma if it could be read
/// differently: `B3`, `O2,3`.
pub(super) fn numbered(scene: &Scene, name: String, link: Option<&str>) -> String {
    let Some(link) = link else { return name };
    let run = format!("{name}{link}");
    let unclear =
        name.ends_with(|c: char| c.is_ascii_digit()) || scene.points.iter().any(|p| p.name == run);
    if unclear { format!("{name},{link}") } else { run }
}

/// Returns the letter of points constructed on the mechanism: S, or the next one that no point of
/// the scene has, in either case and with or without a number.
pub fn crossing_letter(scene: &Scene) -> &'static str {
    let taken = |letter: &str| {
        scene.points.iter().any(|p| Parts::of(&p.name).head.eq_ignore_ascii_case(letter))
    };
    ["S", "T", "U", "W", "Z"].into_iter().find(|l| !taken(l)).unwrap_or("S")
}

/// Returns a label with the number of a trial in its subscript: `b` → `b_{(1)}`, `b_{3}` and `b_3`
/// → `b_{3(1)}`.
pub(super) fn of_trial(label: &str, run: u8) -> String {
    match (label.split_once('_'), label.strip_suffix('}').filter(|_| label.contains("_{"))) {
        (_, Some(head)) => format!("{head}({run})}}"),
        (Some((head, sub)), None) => format!("{head}_{{{sub}({run})}}"),
        (None, None) => format!("{label}_{{({run})}}"),
    }
}

/// Returns the letter of the mates of trial polygons: X, or the next one that no point of the scene
/// has.
pub fn mate_letter(scene: &Scene) -> &'static str {
    let taken = |letter: &str| {
        scene.points.iter().any(|p| Parts::of(&p.name).head.eq_ignore_ascii_case(letter))
    };
    ["X", "Y", "Z", "W", "U"].into_iter().find(|l| !taken(l)).unwrap_or("X")
}

/// Returns the name of a special point (by its index in the plan's list): [`crossing_letter`],
/// numbered if several are drawn. The special points of one triad share a name, because only one of
/// them is drawn.
pub fn special_name(scene: &Scene, plan: &Plan, special: usize) -> String {
    let letter = crossing_letter(scene);
    // Counted by the group for a triad, by the link for a reduction.
    let key = |k: usize| {
        let s = &plan.specials[k];
        (s.group, s.legs.is_none().then_some(s.link))
    };
    let mut named: Vec<_> = (0..plan.specials.len()).map(key).collect();
    named.sort_unstable();
    named.dedup();
    match named[..] {
        [] | [_] => letter.to_owned(),
        _ => format!(
            "{letter}{}",
            named.iter().position(|k| *k == key(special)).map_or(0, |k| k + 1)
        ),
    }
}

/// Returns the letter of poles: that of the notation, or the first of `p`, `o`, `q`, `z` that no
/// image of a moving point has.
pub(super) fn pole_letter(scene: &Scene, plan: &Plan, usual: &str) -> String {
    let taken = |letter: &str| {
        let named = |s: VertexPlace| matches!(s, VertexPlace::Point(p) if scene.point_name(p).to_lowercase() == letter);
        plan.vertices.iter().any(|v| !v.fixed && named(v.spot))
    };
    [usual, "p", "o", "q", "z"].into_iter().find(|l| !taken(l)).unwrap_or("z").to_owned()
}

/// True if the image of a moving point has this letter, with or without a number.
pub(super) fn is_image(scene: &Scene, plan: &Plan, letter: &str) -> bool {
    let bears = |s: VertexPlace| match s {
        VertexPlace::Point(p) => Parts::of(scene.point_name(p)).head.eq_ignore_ascii_case(letter),
        VertexPlace::Special(k) => {
            Parts::of(&special_name(scene, plan, k)).head.eq_ignore_ascii_case(letter)
        }
    };
    plan.vertices.iter().any(|v| !v.fixed && bears(v.spot))
}

/// A name that ends in a number: the head before the number, the number, and the primes after it.
/// Any other name is only a head, primes included.
struct Parts<'a> {
    head: &'a str,
    digits: &'a str,
    primes: &'a str,
}

impl Parts<'_> {
    fn of(name: &str) -> Parts<'_> {
        let bare = name.trim_end_matches('\'');
        let head = bare.trim_end_matches(|c: char| c.is_ascii_digit());
        let digits = &bare[head.len()..];
        // A number becomes a subscript if letters precede it; after an underscore, a prime or
        // another number it stays in place.
        if digits.is_empty() || head.is_empty() || !head.chars().all(char::is_alphabetic) {
            return Parts { head: name, digits: "", primes: "" };
        }
        Parts { head, digits, primes: &name[bare.len()..] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_alone_and_among_others() {
        for (name, alone, among) in [
            ("B", "B", "B"),
            ("O2", "O_{2}", "O2"),
            ("O21", "O_{21}", "O21"),
            ("A'", "A'", "A'"),
            ("A1'", "A'_{1}", "A1'"),
            ("A'1", "A'1", "A'1"),
            ("B_1", "B\\_1", "B\\_1"),
            ("B__", "B\\_\\_", "B\\_\\_"),
            ("O_'", "O\\_\\'", "O\\_\\'"),
            ("''3", "\\'\\'3", "\\'\\'3"),
            ("Ω3", "Ω_{3}", "Ω3"),
            ("滑块2", "滑块_{2}", "滑块2"),
        ] {
            assert_eq!(
                (point_label(name).as_str(), name_label(name).as_str()),
                (alone, among),
                "{name}"
            );
        }
    }
}
