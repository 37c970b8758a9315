//! The sections `paper`, `language` and `notation`.

use super::*;
use crate::book::Book;
use hodograph_base::kind::Kind;

/// ISO 216 sheets in portrait format, in mm.
pub(crate) const SHEETS: [(&str, [f64; 2]); 5] = [
    ("A4", [210.0, 297.0]),
    ("A3", [297.0, 420.0]),
    ("A2", [420.0, 594.0]),
    ("A1", [594.0, 841.0]),
    ("A5", [148.0, 210.0]),
];

/// Smallest and largest side of a sheet in mm. A figure does not fit in less than 20 mm, and
/// printers do not take more than 5 m; such a side is a mistake in the units.
const SIDES_MM: [f64; 2] = [20.0, 5000.0];

/// Largest accepted pencil error (mm).
const BLUNTEST_MM: f64 = 5.0;

pub(super) fn paper(raw: &RawScene, values: &Values, book: &Book, faults: &mut Faults) -> Paper {
    let size_mm = match &raw.paper.size {
        Some(RawSize::Named(word)) => named(word, faults),
        Some(RawSize::Sides(sides)) => sides_mm(sides, values, faults),
        None => None,
    };
    let mut scale = |kind: Kind, q: &Option<RawQuantity>, wanted: RequiredQuantity| {
        let (q, key) = (q.as_ref()?, kind.scale_key()?);
        let given = values.si(q, wanted, faults)?;
        if given.value <= 0.0 {
            faults.push(
                Diagnostic::error("not-positive", both!("`{key}` must be greater than zero"))
                    .at(q.span),
            );
            return None;
        }
        // The value is per metre of paper.
        Some((kind, given.value / 1000.0))
    };
    let scales = [
        scale(Kind::Length, &raw.paper.mu_l, RequiredQuantity::ScaleOfLengths),
        scale(Kind::Velocity, &raw.paper.mu_v, RequiredQuantity::ScaleOfVelocities),
        scale(Kind::Acceleration, &raw.paper.mu_a, RequiredQuantity::ScaleOfAccelerations),
        scale(Kind::Force, &raw.paper.mu_f, RequiredQuantity::ScaleOfForces),
    ];
    Paper {
        size_mm,
        scales: scales.into_iter().flatten().collect(),
        round_in: Kind::DRAWN
            .into_iter()
            .map(|kind| (kind, book.size(kind)))
            .filter(|(_, unit)| *unit != 1.0)
            .collect(),
        pencil_mm: raw.paper.pencil.as_ref().and_then(|q| pencil_mm(q, values, faults)),
    }
}

/// Returns the pencil error, in mm.
pub(crate) fn pencil_mm(q: &RawQuantity, values: &Values, faults: &mut Faults) -> Option<f64> {
    let given = values.positive_length(q, both!("the pencil error"), faults)?;
    let mm = given.value * 1000.0;
    if mm > BLUNTEST_MM {
        let message =
            both!("a pencil error of {}; no pencil is blunter than {BLUNTEST_MM} mm", given.text);
        faults.push(
            Diagnostic::error("pencil", message).at(q.span).help(both!(
                "a careful hand draws within \"0.1 mm\", a hasty one within \"0.5 mm\""
            )),
        );
        return None;
    }
    Some(mm)
}

fn named(word: &Word, faults: &mut Faults) -> Option<[f64; 2]> {
    let mut parts = word.text.split_whitespace();
    let sheet = parts.next().and_then(|name| SHEETS.iter().find(|(s, _)| *s == name));
    let landscape = match (parts.next(), parts.next()) {
        (None, _) => Some(false),
        (Some("landscape"), None) => Some(true),
        _ => None,
    };
    let (Some((_, [w, h])), Some(landscape)) = (sheet, landscape) else {
        let d = Diagnostic::error("paper", both!("there is no paper size `{}`", word.text))
            .at(word.span);
        let known: Vec<_> = SHEETS.iter().map(|(s, _)| *s).collect();
        faults.push(d.help(both!(
            "write one of {}, with \" landscape\" where it lies, or [\"200 mm\", \"150 mm\"]",
            Both::names(&known)
        )));
        return None;
    };
    Some(if landscape { [*h, *w] } else { [*w, *h] })
}

fn sides_mm(sides: &[RawQuantity; 2], values: &Values, faults: &mut Faults) -> Option<[f64; 2]> {
    let [w, h] = values.two_lengths(sides, faults)?;
    let mm = [w.value * 1000.0, h.value * 1000.0];
    for (given, mm) in [&w, &h].into_iter().zip(mm) {
        if !(SIDES_MM[0]..=SIDES_MM[1]).contains(&mm) {
            let message = both!(
                "a side of {mm} mm; paper has sides from {} mm to {} mm",
                SIDES_MM[0],
                SIDES_MM[1]
            );
            faults.push(Diagnostic::error("paper", message).at(given.span));
            return None;
        }
    }
    Some(mm)
}

/// Returns the width of a page, in mm.
pub(super) fn width_mm(q: &RawQuantity, values: &Values, faults: &mut Faults) -> Option<f64> {
    let given = values.positive_length(q, both!("the width"), faults)?;
    let mm = given.value * 1000.0;
    if !(SIDES_MM[0]..=SIDES_MM[1]).contains(&mm) {
        let message = both!("a side of {}", given.text);
        faults.push(Diagnostic::error("paper", message).at(q.span).help(both!(
            "give {} mm to {} mm, such as \"80 mm\" for a column of a book",
            SIDES_MM[0],
            SIDES_MM[1]
        )));
        return None;
    }
    Some(mm)
}

pub(super) fn language(raw: &RawScene, faults: &mut Faults) -> Option<Lang> {
    let word = raw.language.as_ref()?;
    match Lang::named(&word.text) {
        Some(lang) => Some(lang),
        None => {
            let other = &word.text;
            let d = Diagnostic::error("language", both!("there is no language `{other}`"))
                .at(word.span);
            faults.push(d.help(both!("write \"en\" or \"zh\"")));
            None
        }
    }
}

pub(super) fn notation(raw: &RawScene, faults: &mut Faults) -> Option<String> {
    let word = raw.notation.as_ref()?;
    if ["en", "cn"].contains(&word.text.as_str()) {
        return Some(word.text.clone());
    }
    let d =
        Diagnostic::error("notation", both!("there is no notation `{}`", word.text)).at(word.span);
    faults.push(d.help(both!("write \"en\" or \"cn\"")));
    None
}
