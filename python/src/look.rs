//! The look of figures and documents, by names.

use crate::fault::Refusal;
use hodograph::certified::ladder::MOST_DIGITS;
use hodograph::diag::{Both, Diagnostic, both};
use hodograph::notation::Notation;
use hodograph::paper::style::{self, Style};
use hodograph::problem::Look;
use hodograph::scene::Lang;

/// Language, notation, style and digits as Python gives them.
pub type Named = (Option<String>, Option<String>, Option<String>, Option<usize>);

/// Returns the refusal of a name that is none of those known.
pub fn unknown(code: &'static str, of: Both, name: &str, known: &[&str]) -> Refusal {
    let message = both!("there is no {} `{name}`", of);
    let help = both!("there are {}", Both::names(known));
    Refusal::of(Diagnostic::error(code, message).help(help))
}

/// Returns a look; a style is a name, or the text of a style file.
pub fn look((lang, notation, named, digits): Named, usual: usize) -> Result<Look, Refusal> {
    let lang = match lang.as_deref() {
        None => None,
        Some(name) => Some(
            Lang::named(name)
                .ok_or_else(|| unknown("lang", both!("language"), name, &["en", "zh"]))?,
        ),
    };
    let notation = match notation.as_deref() {
        None => None,
        Some(name) => Some(Notation::named(name).ok_or_else(|| {
            let names = Notation::names();
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            unknown("notation", both!("notation"), name, &names)
        })?),
    };
    let style = match named.as_deref() {
        None => Style::default(),
        Some(text) if text.trim_start().starts_with('{') => {
            style::read(text.as_bytes()).map_err(|f| Refusal::in_text(f, "style", text))?
        }
        Some(name) => Style::named(name)
            .ok_or_else(|| unknown("unknown-style", both!("style"), name, &Style::names()))?,
    };
    let digits = digits.unwrap_or(usual);
    if !(1..=MOST_DIGITS).contains(&digits) {
        let message = both!("digits: {digits} is not a whole number from 1 to {MOST_DIGITS}");
        return Err(Refusal::of(Diagnostic::error("digits", message)));
    }
    Ok(Look { lang, notation, style, digits })
}
