//! Writes figures of one size as one animated SVG (SMIL), for browsers and programs that embed
//! them.
//!
//! Elements that are equal in all frames, in the same order, are written once. Each other element
//! is shown during its frames; a program without animation shows the first frame.

use std::collections::HashMap;

use crate::paper::item::{Colour, Figure};
use hodograph_base::diag::{Faults, both};

use super::number::mm;
use super::svg::Elements;
use super::{escaped, not_finite};

/// Writes figures as the frames of one period of `seconds` seconds; size, title and language are
/// those of the first.
///
/// # Errors
/// `not-finite` for a number that is not finite, or if there is no figure.
pub fn write(frames: &[&Figure], seconds: f64) -> Result<String, Faults> {
    let Some(first) = frames.first().filter(|_| seconds.is_finite() && seconds > 0.0) else {
        return Err(not_finite(both!("there is no frame, or no time to show it")).into());
    };
    let mut elements = Elements::new(first.height_mm);
    let mut shown: Vec<Vec<String>> = Vec::new();
    for figure in frames {
        // Names belong to one frame and have no meaning in a picture of all.
        let items: Vec<_> = figure.items.iter().map(|i| i.clone().with_id("")).collect();
        shown.push(elements.of(&items)?);
    }
    let (w, h) = (mm(first.width_mm), mm(first.height_mm));
    let (title, desc) = (escaped(&first.title), escaped(&first.desc));
    let mut out = format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="{w}mm" height="{h}mm" viewBox="0 0 {w} {h}" role="img" lang="{}">
<title>{title}</title>
<desc>{desc}</desc>
"#,
        escaped(&first.lang)
    );
    if first.paper != Colour::WHITE {
        let Colour { r, g, b } = first.paper;
        out.push_str(&format!(
            "<rect width=\"{w}\" height=\"{h}\" fill=\"#{r:02x}{g:02x}{b:02x}\"/>\n"
        ));
    }
    out.push_str(&Elements::letters([&elements]));
    out.push('\n');
    // The current position in each frame.
    let mut at = vec![0; shown.len()];
    for anchor in anchors(&shown) {
        between(&shown, &at, &anchor, seconds, &mut out);
        out.push_str(&shown[0][anchor[0]]);
        out.push('\n');
        at = anchor.iter().map(|k| k + 1).collect();
    }
    let ends: Vec<usize> = shown.iter().map(Vec::len).collect();
    between(&shown, &at, &ends, seconds, &mut out);
    out.push_str("</svg>\n");
    Ok(out)
}

/// Returns the elements that are equal in all frames, in stacking order: for each its index in
/// every frame.
fn anchors(shown: &[Vec<String>]) -> Vec<Vec<usize>> {
    let places: Vec<HashMap<&str, Vec<usize>>> = shown
        .iter()
        .map(|frame| {
            let mut all: HashMap<&str, Vec<usize>> = HashMap::new();
            frame.iter().enumerate().for_each(|(k, e)| all.entry(e).or_default().push(k));
            all
        })
        .collect();
    let mut last = vec![None; shown.len()];
    let mut out: Vec<Vec<usize>> = Vec::new();
    for e in &shown[0] {
        let next = |(of, last): (&HashMap<&str, Vec<usize>>, &Option<usize>)| {
            of.get(e.as_str())?.iter().copied().find(|k| Some(*k) > *last)
        };
        let found: Option<Vec<usize>> = places.iter().zip(&last).map(next).collect();
        if let Some(found) = found {
            last = found.iter().map(|k| Some(*k)).collect();
            out.push(found);
        }
    }
    out
}

/// Writes the elements of each frame from one index to another, shown during the frame's time.
fn between(shown: &[Vec<String>], from: &[usize], to: &[usize], seconds: f64, out: &mut String) {
    let count = shown.len();
    for (k, frame) in shown.iter().enumerate().filter(|(k, _)| from[*k] < to[*k]) {
        // A program without animation shows the first frame alone.
        let display = if k == 0 { "inline" } else { "none" };
        let part = |k: usize| mm(k as f64 / count as f64);
        let (values, times) = match k {
            0 => ("inline;none".to_owned(), format!("0;{}", part(1))),
            _ if k + 1 == count => ("none;inline".to_owned(), format!("0;{}", part(k))),
            _ => ("none;inline;none".to_owned(), format!("0;{};{}", part(k), part(k + 1))),
        };
        out.push_str(&format!("<g display=\"{display}\">\n"));
        if count > 1 {
            let seconds = mm(seconds);
            out.push_str(&format!(
                "<animate attributeName=\"display\" values=\"{values}\" keyTimes=\"{times}\" dur=\"{seconds}s\" calcMode=\"discrete\" repeatCount=\"indefinite\"/>\n"
            ));
        }
        for e in &frame[from[k]..to[k]] {
            out.push_str(e);
            out.push('\n');
        }
        out.push_str("</g>\n");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::paper::item::{FigureItem, LineStroke, Shape};
    use hodograph_base::geom::Point;

    #[test]
    fn what_is_alike_is_written_once_and_the_rest_shown_in_turn() {
        let line = |x: f64| {
            let shape = Shape::Line {
                from: Point::ORIGIN,
                to: Point::new(x, 1.0),
                stroke: LineStroke::new(0.5),
            };
            FigureItem::new("link", shape).with_id(format!("l{x}"))
        };
        let figure = |x: f64| Figure {
            width_mm: 10.0,
            height_mm: 5.0,
            title: "A <turn>".into(),
            desc: String::new(),
            lang: "en".into(),
            paper: Colour::WHITE,
            items: vec![line(9.0), line(x), line(8.0)],
        };
        let figures = [1.0, 2.0, 3.0].map(figure);
        let svg = write(&figures.iter().collect::<Vec<_>>(), 6.0).unwrap();
        assert_eq!(
            (
                svg.matches("x2=\"9\"").count(),
                svg.matches("<animate").count(),
                svg.matches("display=\"inline\"").count()
            ),
            (1, 3, 1)
        );
        // Between the two static elements, as in each frame.
        let place = |what: &str| svg.find(what).unwrap();
        assert!(place("x2=\"9\"") < place("x2=\"3\"") && place("x2=\"3\"") < place("x2=\"8\""));
        assert!(
            svg.contains("A &lt;turn&gt;")
                && svg.contains("dur=\"6s\"")
                && svg.contains("keyTimes=\"0;0.333;0.667\""),
            "{svg}"
        );
        assert!(roxmltree::Document::parse(&svg).is_ok());
        assert!(write(&[], 6.0).is_err() && write(&[&figures[0]], f64::NAN).is_err());
    }
}
