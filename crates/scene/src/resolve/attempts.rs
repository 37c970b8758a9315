//! The section `attempts`: wrong solutions, their mistakes and the printed results.
//!
//! The module `attempts`, which has the equations, decides whether a mistake is possible in the
//! scene.

use super::find::asked;
use super::*;

/// Resolves the wrong solutions.
pub(super) fn attempts(c: &Context, faults: &mut Faults) -> Vec<Attempted> {
    c.raw.attempts.iter().filter_map(|raw| attempt(c, raw, faults)).collect()
}

fn attempt(c: &Context, raw: &RawAttempt, faults: &mut Faults) -> Option<Attempted> {
    let mistake = Mistake::ALL.into_iter().find(|m| m.name() == raw.mistake.text);
    if mistake.is_none() {
        let message = both!("`{}` is no known mistake", raw.mistake.text);
        let help = suggest(
            &raw.mistake.text,
            Mistake::ALL.iter().map(|m| m.name()),
            both!("the known mistakes are"),
        );
        faults.push(Diagnostic::error("attempt", message).at(raw.mistake.span).help(help));
    }
    let link = match &raw.link {
        Some(word) => Some(note(c.names.link(word), faults)?),
        None => None,
    };
    let mut printed = Vec::new();
    for (word, quantity) in &raw.printed {
        let Some(what) = note(asked(c, word), faults) else { continue };
        let Some(value) = c.values.si(quantity, RequiredQuantity::of(what.kind()), faults) else {
            continue;
        };
        printed.push((Find { what, text: word.text.clone(), span: word.span }, value));
    }
    Some(Attempted {
        mistake: mistake?,
        pair: raw.pair.as_ref().map(|w| w.text.clone()),
        link,
        printed,
        why: localized(&raw.why),
        span: raw.span,
    })
}
