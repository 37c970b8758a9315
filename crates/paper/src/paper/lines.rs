//! Breaks sentences with formulas into lines.
//!
//! Breaks follow the Unicode line breaking rules, which cover Chinese. A formula counts as one
//! character among the words; a long formula may also break before its relations.

use std::collections::VecDeque;

use unicode_linebreak::linebreaks;

use super::font::own::Fonts;
use super::label::Label;
use super::text;
use crate::paper::phrase::{Phrase, PhrasePiece};

/// Units that may follow a number given as a formula.
const UNITS: [&str; 8] = ["mm", "cm", "m", "ft", "in", "rad/s", "m/s", "s"];
/// Placeholder for a formula, or for a part of a long one, among the words.
const THING: char = '\u{FFFC}';

/// Returns true if a break would separate a number from its unit or from the counted noun.
fn parts_a_number(text: &str, at: usize) -> bool {
    let unit = || {
        text[at..]
            .split([' ', ')', ',', ';', '.', '，', '；', '。', '）'])
            .next()
            .is_some_and(|word| UNITS.contains(&word))
    };
    let number = |before: &str| {
        before.ends_with(|c: char| c.is_ascii_digit()) || before.ends_with(THING) && unit()
    };
    at < text.len() && text[..at].strip_suffix(' ').is_some_and(number)
}

/// Breaks a phrase into lines no wider than `width_mm`, at the places that Unicode's rules allow.
///
/// A word longer than a line breaks anywhere; a formula longer than a line extends beyond the
/// width.
pub fn wrapped(phrase: &Phrase, width_mm: f64, size_mm: f64, fonts: &Fonts) -> Vec<Label> {
    let mut plain = String::new();
    let mut formulas = VecDeque::new();
    for piece in phrase.pieces() {
        match piece {
            PhrasePiece::Words(w) => plain.extend(
                w.chars().map(|c| if c == THING { char::REPLACEMENT_CHARACTER } else { c }),
            ),
            PhrasePiece::Formula(f) => {
                for part in pieces_of(f) {
                    plain.push(THING);
                    formulas.push_back(part);
                }
            }
        }
    }
    let allowed = linebreaks(&plain).map(|(at, _)| at).filter(|at| !parts_a_number(&plain, *at));
    let breaks: Vec<usize> = std::iter::once(0).chain(allowed).collect();
    let label = |from: &str, formulas: &mut VecDeque<String>| {
        let mut out = Label::text("").in_fonts(fonts);
        for (k, words) in from.split(THING).enumerate() {
            if k > 0 {
                out = out.then(Label::math(formulas.pop_front().unwrap_or_default()));
            }
            if !words.is_empty() {
                out = out.then(Label::text(words));
            }
        }
        out
    };
    let wide = |l: &Label| text::set(l).width_em * size_mm;
    let mut lines = Vec::new();
    // The current line: without its trailing space, and with it for continuation.
    let mut here: Option<(Label, Label)> = None;
    let whole = breaks.windows(2).map(|ends| &plain[ends[0]..ends[1]]);
    let pieces = whole.flat_map(|segment| {
        let long = !segment.contains(THING)
            && wide(&Label::text(segment.trim_end()).in_fonts(fonts)) > width_mm;
        if long { segment.split_inclusive(|_| true).collect() } else { vec![segment] }
    });
    for segment in pieces {
        // The space at a line's end is dropped and takes no width.
        let things = segment.matches(THING).count();
        let mut own: VecDeque<String> = formulas.drain(..things).collect();
        let trimmed = label(segment.trim_end(), &mut own.clone());
        let full = label(segment, &mut own);
        here = Some(match here {
            None => (trimmed, full),
            Some((as_line, before)) => {
                let longer = before.clone().then(trimmed.clone());
                if wide(&longer) <= width_mm {
                    (longer, before.then(full))
                } else {
                    lines.push(as_line);
                    (trimmed, full)
                }
            }
        });
    }
    lines.extend(here.map(|(as_line, _)| as_line));
    lines
}

/// Splits a formula into parts that may be on different lines: in a long formula, each relation
/// starts a part.
fn pieces_of(formula: &str) -> Vec<String> {
    /// Shorter formulas are not split.
    const LONG: usize = 40;
    if formula.len() < LONG {
        return vec![formula.to_owned()];
    }
    let mut parts: Vec<String> = Vec::new();
    let mut depth = 0;
    for c in formula.chars() {
        depth += i32::from(c == '{') - i32::from(c == '}');
        match parts.last_mut() {
            Some(last) if c != '=' || depth != 0 => last.push(c),
            _ => parts.push(c.to_string()),
        }
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(source: &str, width_mm: f64) -> Vec<String> {
        wrapped(&Phrase::new(source), width_mm, 4.0, &Fonts::default())
            .iter()
            .map(|l| l.plain().trim_end().to_owned())
            .collect()
    }

    #[test]
    fn lines_break_at_words_and_fit() {
        let source = "Through $b$ draw the direction of $v_{CB}$, $\\perp BC$, and through the pole that of $v_C$.";
        let lines = wrapped(&Phrase::new(source), 50.0, 4.0, &Fonts::default());
        assert!(lines.len() > 2);
        for l in &lines {
            assert!(text::set(l).width_em * 4.0 <= 50.0, "{}", l.plain());
        }
        let joined: Vec<String> = lines.iter().map(Label::plain).collect();
        assert_eq!(joined.join(" "), Phrase::new(source).label().plain());
        assert!(texts(source, 50.0).iter().all(|l| !l.starts_with([',', '.'])));
    }

    #[test]
    fn a_number_keeps_its_unit() {
        for width in 20..80 {
            let lines = texts(
                "from o lay off 59.01 mm square to it, 3 mm more, then 12 mm back",
                f64::from(width),
            );
            assert!(lines.iter().all(|l| !l.starts_with("mm")), "{width} mm: {lines:?}");
        }
    }

    #[test]
    fn a_number_that_is_a_formula_keeps_its_unit() {
        for width in 20..80 {
            let lines = texts(
                "measured: $l_1$ = $144.64$ mm ($144.64$ mm), then $l_2$ = $65.8$ mm",
                f64::from(width),
            );
            assert!(lines.iter().all(|l| !l.starts_with("mm")), "{width} mm: {lines:?}");
        }
    }

    #[test]
    fn a_word_longer_than_a_line_breaks_anywhere() {
        let lines = texts(&format!("see https://example.org/{}.", "path".repeat(40)), 50.0);
        assert!(
            lines.len() > 5
                && lines.iter().all(|l| text::set(&Label::text(l.as_str())).width_em * 4.0 <= 51.0),
            "{lines:?}"
        );
    }

    #[test]
    fn chinese_breaks_anywhere_but_before_its_stops() {
        let lines = texts(
            "两线交于一点，交角甚大，故所得结果可靠。取极点，比例尺已知（见图），依次作各矢量。",
            30.0,
        );
        assert!(lines.len() > 4, "{lines:?}");
        assert!(
            lines.iter().all(|l| !l.starts_with(['，', '。', '）']) && !l.ends_with('（')),
            "{lines:?}"
        );
    }
}
