//! Style files: JSON with the differences from a base style. All faults are reported together, each
//! with its position.
//!
//! ```json
//! { "base": "print", "lines": { "vector": 0.5 }, "colours": { "links": ["#0072b2", "#d55e00"] }, "notation": { "pole": "P" } }
//! ```

use super::{Marks, Style};
use crate::paper::font::own::Fonts;
use crate::paper::item::Colour;
use crate::paper::label::Label;
use crate::paper::text;
use hodograph_base::diag::{Diagnostic, Faults, both};
use hodograph_base::json::fields::{FaultSubject, Fields, list, suggest, word, wrong};
use hodograph_base::json::{self, Node, NodeKind};
use hodograph_base::notation::Vectors;

/// A length that a style sets: its key, its field, and its bounds in mm.
type StyleLength = (&'static str, fn(&mut Style) -> &mut f64, [f64; 2]);

/// Longest mark in characters: a mark is a letter or a word in the label language and occurs in
/// many labels.
const MARK_MAX: usize = 40;

/// Line widths: lines thinner than a hair do not print, and lines thicker than 2 mm hide what they
/// join.
const LINES: &[StyleLength] = &[
    ("link", |s| &mut s.link.width_mm, [0.1, 2.0]),
    ("outline", |s| &mut s.outline.width_mm, [0.1, 2.0]),
    ("thin", |s| &mut s.thin.width_mm, [0.1, 2.0]),
    ("vector", |s| &mut s.vector.width_mm, [0.1, 2.0]),
];

/// Arrowheads: a head shorter than a millimetre is invisible, and one longer than a centimetre
/// covers the vector.
const HEADS: &[StyleLength] = &[
    ("vector_length", |s| &mut s.head.length_mm, [1.0, 10.0]),
    ("vector_width", |s| &mut s.head.width_mm, [0.4, 6.0]),
    ("thin_length", |s| &mut s.thin_head.length_mm, [1.0, 10.0]),
    ("thin_width", |s| &mut s.thin_head.width_mm, [0.4, 6.0]),
];

/// Symbol sizes: half to four times the textbook sizes; beyond these, symbols run into one another.
const SYMBOLS: &[StyleLength] = &[
    ("pin_radius", |s| &mut s.pin_radius_mm, [0.5, 4.0]),
    ("dot_radius", |s| &mut s.dot_radius_mm, [0.3, 2.0]),
    ("pivot_height", |s| &mut s.pivot_height_mm, [2.0, 16.0]),
    ("pivot_half_base", |s| &mut s.pivot_half_base_mm, [1.5, 12.0]),
    ("ground_half", |s| &mut s.ground_half_mm, [2.5, 20.0]),
    ("hatch_pitch", |s| &mut s.hatch_pitch_mm, [0.5, 5.0]),
    ("hatch_depth", |s| &mut s.hatch_depth_mm, [0.5, 6.0]),
    ("block_length", |s| &mut s.block_length_mm, [4.0, 30.0]),
    ("block_width", |s| &mut s.block_width_mm, [2.0, 16.0]),
    ("slot_width", |s| &mut s.slot_width_mm, [1.5, 12.0]),
];

/// Type sizes: scripts are 70 % of the type; below 3.2 mm they fall below 2.2 mm, the smallest size
/// that prints well.
const TEXT: &[StyleLength] = &[
    ("label", |s| &mut s.label_mm, [3.2, 15.0]),
    ("caption", |s| &mut s.caption_mm, [3.2, 15.0]),
    ("small", |s| &mut s.small_mm, [3.2, 15.0]),
];

const SECTIONS: &[(&str, &str, &[StyleLength])] = &[
    ("lines", "\"lines\"", LINES),
    ("heads", "\"heads\"", HEADS),
    ("symbols", "\"symbols\"", SYMBOLS),
    ("text", "\"text\"", TEXT),
];
const KEYS: &[&str] = &[
    "name", "base", "lines", "heads", "symbols", "text", "fonts", "colours", "notation", "captions",
];
const COLOURS: &[&str] = &["paper", "ink", "plate", "links"];
const MARKS: &[&str] = &[
    "pole",
    "coriolis",
    "tangential",
    "sliding",
    "known",
    "unknown",
    "similar",
    "normal_end",
    "coriolis_end",
    "vectors",
];
/// Largest number of link colours: more cannot be distinguished, and the bound limits the memory
/// that a file can take.
const LINKS_MAX: usize = 64;

/// Reads the file that a style names. Fonts are stored beside the style, and this module opens no
/// files.
pub type FontOpener<'a> = dyn FnMut(&str) -> Result<Vec<u8>, Diagnostic> + 'a;

/// Reads a style file that names no other files.
///
/// # Errors
/// All faults in one list, each with its place in `source` as byte offsets.
///
/// ```
/// let style = hodograph_paper::paper::style::read(br#"{ "base": "dark", "lines": { "link": 0.9 } }"#).unwrap();
/// assert_eq!(style.link.width_mm, 0.9);
/// assert!(hodograph_paper::paper::style::read(br#"{ "lines": { "link": 90 } }"#).is_err());
/// ```
pub fn read(source: &[u8]) -> Result<Style, Faults> {
    read_with(source, &mut nothing)
}

/// Reads a style file; `open` reads the fonts that it names.
///
/// # Errors
/// As [`read`]; also the errors of `open`, and `font` for a file that is not a font and for a
/// second font of a cut.
pub fn read_with(source: &[u8], open: &mut FontOpener) -> Result<Style, Faults> {
    read_onto(source, Style::default(), open)
}

/// Opens no file: returns an error for every name.
pub(super) fn nothing(name: &str) -> Result<Vec<u8>, Diagnostic> {
    Err(Diagnostic::error(
        "font",
        both!("{name} cannot be read: this style is read without other files"),
    ))
}

/// Reads a style file that is based on `usual` if it names no base.
pub(super) fn read_onto(
    source: &[u8],
    usual: Style,
    open: &mut FontOpener,
) -> Result<Style, Faults> {
    let mut faults = Faults::default();
    let (_, root) = json::parse(source, &mut faults)?;
    let style = style(&root, usual, open, &mut faults);
    style.filter(|_| !faults.has_errors()).ok_or(faults)
}

fn style(root: &Node, usual: Style, open: &mut FontOpener, faults: &mut Faults) -> Option<Style> {
    let f = Fields::open(root, both!("a style"), KEYS, faults)?;
    let mut style = match f.get("base") {
        None => usual,
        Some(node) => {
            let base = word(node, "\"base\"", faults)?;
            Style::named(&base.text).or_else(|| {
                let d =
                    Diagnostic::error("unknown-style", both!("there is no style `{}`", base.text))
                        .at(base.span);
                faults.push(d.help(suggest(
                    &base.text,
                    Style::names().into_iter(),
                    both!("the styles are"),
                )));
                None
            })?
        }
    };
    if let Some(name) = f.get("name").and_then(|n| word(n, "\"name\"", faults)) {
        style.name = name.text;
    }
    for (key, what, lengths) in SECTIONS {
        let Some(node) = f.get(key) else { continue };
        let keys: Vec<&str> = lengths.iter().map(|l| l.0).collect();
        let Some(section) = Fields::open(node, *what, &keys, faults) else { continue };
        for (key, place, bounds) in *lengths {
            if let Some(mm) = section.get(key).and_then(|n| length(n, key, *bounds, faults)) {
                *place(&mut style) = mm;
            }
        }
    }
    if let Some(node) = f.get("fonts") {
        style.fonts = fonts(node, open, faults);
    }
    if let Some(node) = f.get("colours") {
        colours(node, &mut style, faults);
    }
    if let Some(node) = f.get("notation") {
        marks(node, &mut style.marks, faults);
    }
    if let Some(node) = f.get("captions") {
        style.captions.read(node, faults);
    }
    Some(style)
}

fn length(node: &Node, key: &str, [least, most]: [f64; 2], faults: &mut Faults) -> Option<f64> {
    let NodeKind::Number(text) = &node.kind else {
        return wrong(node, &format!("`{key}`"), both!("a number of millimetres"), faults);
    };
    match text.parse::<f64>() {
        Ok(mm) if (least..=most).contains(&mm) => Some(mm),
        _ => {
            let d = Diagnostic::error("out-of-range", both!("`{key}` is {text} mm")).at(node.span);
            faults.push(d.help(both!("give {least} to {most} mm")));
            None
        }
    }
}

/// Reads an upright font, a slanted one, or both; a fault is reported at the name of its font.
fn fonts(node: &Node, open: &mut FontOpener, faults: &mut Faults) -> Fonts {
    let mut fonts = Fonts::default();
    for item in list(node, "\"fonts\"", faults).unwrap_or_default() {
        let Some(name) = word(item, both!("a font"), faults) else { continue };
        match open(&name.text).and_then(|bytes| fonts.with(&name.text, bytes)) {
            Ok(more) => fonts = more,
            Err(d) => faults.push(d.at(name.span)),
        }
    }
    fonts
}

fn colours(node: &Node, style: &mut Style, faults: &mut Faults) {
    let Some(f) = Fields::open(node, "\"colours\"", COLOURS, faults) else { return };
    let mut one = |key: &str, place: &mut Colour| {
        if let Some(c) = f.get(key).and_then(|n| colour(n, &format!("`{key}`"), faults)) {
            *place = c;
        }
    };
    one("paper", &mut style.palette.paper);
    one("ink", &mut style.palette.ink);
    one("plate", &mut style.plate);
    let Some(node) = f.get("links") else { return };
    let Some(items) = list(node, "\"links\"", faults) else { return };
    if items.len() > LINKS_MAX {
        let message =
            both!("\"links\" has {} colours; at most {LINKS_MAX} are allowed", items.len());
        return faults.push(Diagnostic::error("too-many", message).at(node.span));
    }
    style.palette.links =
        items.iter().filter_map(|n| colour(n, both!("`a colour of a link`"), faults)).collect();
}

fn colour(node: &Node, what: impl Into<FaultSubject>, faults: &mut Faults) -> Option<Colour> {
    let text = word(node, what, faults)?;
    let digits = text
        .text
        .strip_prefix('#')
        .filter(|d| d.len() == 6 && d.bytes().all(|b| b.is_ascii_hexdigit()));
    let value = digits.and_then(|d| u32::from_str_radix(d, 16).ok());
    if value.is_none() {
        let d = Diagnostic::error("colour", both!("`{}` is no colour", text.text)).at(text.span);
        faults.push(d.help(both!(
            "write red, green and blue in two hexadecimal digits each, such as \"#1f6fd0\""
        )));
    }
    value.map(|v| Colour::rgb((v >> 16) as u8, (v >> 8) as u8, v as u8))
}

fn marks(node: &Node, marks: &mut Marks, faults: &mut Faults) {
    let Some(f) = Fields::open(node, "\"notation\"", MARKS, faults) else { return };
    let mut one = |key: &str, place: &mut Option<String>| {
        let Some(text) = f.get(key).and_then(|n| word(n, &format!("`{key}`"), faults)) else {
            return;
        };
        if text.text.chars().count() > MARK_MAX {
            let d = Diagnostic::error("mark", both!("`{key}` has more than {MARK_MAX} characters"))
                .at(text.span);
            return faults.push(d.help(both!("write another mark")));
        }
        let label = Label::math(text.text.as_str());
        let set = text::set(&label);
        match set.faults.first() {
            Some(fault) => faults.push(
                Diagnostic::error("mark", fault.message.clone())
                    .at(text.span)
                    .help(both!("write another mark")),
            ),
            None => *place = Some(text.text),
        }
    };
    one("pole", &mut marks.pole);
    one("coriolis", &mut marks.coriolis);
    one("tangential", &mut marks.tangential);
    one("sliding", &mut marks.sliding);
    one("known", &mut marks.known);
    one("unknown", &mut marks.unknown);
    one("similar", &mut marks.similar);
    one("normal_end", &mut marks.normal_end);
    one("coriolis_end", &mut marks.coriolis_end);
    if let Some(word) = f.get("vectors").and_then(|n| word(n, "`vectors`", faults)) {
        let known = Vectors::ALL.into_iter().find(|(name, _)| *name == word.text);
        if known.is_none() {
            let d = Diagnostic::error("mark", both!("`vectors` is `{}`", word.text)).at(word.span);
            faults.push(d.help(suggest(
                &word.text,
                Vectors::ALL.into_iter().map(|(name, _)| name),
                both!("it is"),
            )));
        }
        marks.vectors = known.map(|(_, vectors)| vectors);
    }
}

#[cfg(test)]
mod tests {
    use super::super::Captioned;
    use super::*;
    use hodograph_base::diag::Both;
    use hodograph_base::diagram::DiagramKind;
    use hodograph_base::lang::Lang;

    #[test]
    fn captions_and_vectors_of_a_style() {
        let source = r#"{ "captions": { "velocity": "Plan $v$", "results": { "zh": "结论" } }, "notation": { "vectors": "bold" } }"#;
        let style = read(source.as_bytes()).unwrap();
        let of = |what, lang| style.captions.of(what, lang);
        assert_eq!(of(Captioned::Drawing(DiagramKind::Velocity), Lang::En), "Plan $v$");
        assert_eq!(of(Captioned::Drawing(DiagramKind::Velocity), Lang::Zh), "Plan $v$");
        assert_eq!(
            (of(Captioned::Results, Lang::En), of(Captioned::Results, Lang::Zh)),
            ("Results", "结论")
        );
        assert_eq!(of(Captioned::Equations(DiagramKind::Acceleration), Lang::En), "Accelerations");
        assert_eq!(style.marks.vectors, Some(Vectors::Bold));
        let long = "x".repeat(81);
        let wrong = format!(
            r#"{{ "captions": {{ "velo": "x", "velocity": "$\\nosuch$", "mechanism": "{long}", "results": {{ "de": "x", "zh": 7 }} }},
            "notation": {{ "vectors": "fat" }} }}"#
        );
        let faults = read(wrong.as_bytes()).unwrap_err();
        let mut codes: Vec<&str> = faults.list.iter().map(|d| d.code).collect();
        codes.sort_unstable();
        assert_eq!(
            codes,
            ["caption", "mark", "too-long", "unknown-key", "unknown-key", "wrong-type"]
        );
        assert!(faults.list.iter().all(|d| d.span.is_some()));
    }

    #[test]
    fn all_faults_at_once_with_their_places() {
        let source = br##"{ "bse": "print", "lines": { "link": 40, "vektor": 0.5 }, "text": { "label": "big" },
            "colours": { "ink": "black", "links": ["#12345", "#0072b2"] }, "notation": { "pole": "\\nosuch" } }"##;
        let faults = read(source).unwrap_err();
        let codes: Vec<&str> = faults.list.iter().map(|d| d.code).collect();
        assert_eq!(
            codes,
            [
                "unknown-key",
                "unknown-key",
                "out-of-range",
                "wrong-type",
                "colour",
                "colour",
                "mark"
            ]
        );
        assert!(faults.list.iter().all(|d| d.span.is_some()));
        assert!(faults.list[2].help.as_ref().unwrap().en.contains("0.1 to 2 mm"));
    }

    #[test]
    fn fonts_stand_beside_the_style() {
        let mut asked = Vec::new();
        let mut open = |name: &str| {
            asked.push(name.to_owned());
            std::fs::read(format!("{}/fonts/{name}", env!("CARGO_MANIFEST_DIR")))
                .map_err(|e| Diagnostic::error("cannot-read", Both::same(e.to_string())))
        };
        let style = read_with(
            br#"{ "base": "dark", "fonts": ["tinos-italic.ttf", "tinos-normal.ttf"] }"#,
            &mut open,
        )
        .unwrap();
        assert!(!style.fonts.is_empty() && style != Style::named("dark").unwrap());
        let faults = read_with(br#"{ "fonts": ["tinos-italic.ttf", "nosuch.ttf", "README.md", "tinos-italic.ttf", 3] }"#, &mut open);
        let faults = faults.unwrap_err();
        let codes: Vec<&str> = faults.list.iter().map(|d| d.code).collect();
        assert_eq!(codes, ["cannot-read", "font", "font", "wrong-type"]);
        assert!(faults.list.iter().all(|d| d.span.is_some()));
        assert_eq!(asked[..2], ["tinos-italic.ttf", "tinos-normal.ttf"]);
        assert_eq!(read(br#"{ "fonts": ["a.ttf"] }"#).unwrap_err().list[0].code, "font");
    }

    #[test]
    fn the_usual_style_gives_every_measure() {
        let mut print = Style::default();
        for (section, _, lengths) in SECTIONS {
            for (key, place, [least, most]) in *lengths {
                assert!(
                    (*least..=*most).contains(place(&mut print)),
                    "{section}.{key} is missing in print.json"
                );
            }
        }
    }

    #[test]
    fn what_is_not_said_is_that_of_the_base() {
        let style =
            read(br#"{ "base": "slides", "lines": { "thin": 0.2 }, "notation": { "pole": "P" } }"#)
                .unwrap();
        let base = Style::named("slides").unwrap();
        assert_eq!(style.thin.width_mm, 0.2);
        assert_eq!((style.link, &style.palette), (base.link, &base.palette));
        assert_eq!(style.marks.pole.as_deref(), Some("P"));
        assert_eq!(read(br#"{ "base": "nosuch" }"#).unwrap_err().list[0].code, "unknown-style");
    }
}
