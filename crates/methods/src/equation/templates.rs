//! Templates of vector equations: one for each solvable case.

use hodograph_base::diag::Both;
use hodograph_templates::EQUATIONS;

/// Returns the names of all templates, in order.
pub fn names() -> impl Iterator<Item = &'static str> + Clone {
    EQUATIONS.iter().map(|(name, _)| *name)
}

/// Returns the text of a template; `None` for an unknown name.
pub fn get(name: &str) -> Option<&'static str> {
    EQUATIONS.iter().find(|(n, _)| *n == name).map(|(_, text)| *text)
}

/// Returns the title of a template.
pub fn title(name: &str) -> Both {
    get(name).and_then(|text| super::read(text).ok()).map(|p| p.value.title).unwrap_or_default()
}
