//! Templates of motions without a mechanism, whose parameters can be set.

use hodograph_base::diag::Both;

/// Every template: its name and its text.
const FILES: &[(&str, &str)] = &[
    ("pursuit", include_str!("../../../../templates/particle/pursuit.json")),
    ("pursuit-of-a-ship", include_str!("../../../../templates/particle/pursuit-of-a-ship.json")),
    ("plate-in-space", include_str!("../../../../templates/particle/plate-in-space.json")),
    ("ring-in-space", include_str!("../../../../templates/particle/ring-in-space.json")),
];

/// The names of all templates, in order.
pub fn names() -> impl Iterator<Item = &'static str> + Clone {
    FILES.iter().map(|(name, _)| *name)
}

/// The text of a template; `None` for an unknown name.
pub fn get(name: &str) -> Option<&'static str> {
    FILES.iter().find(|(n, _)| *n == name).map(|(_, text)| *text)
}

/// The title of a template.
pub fn title(name: &str) -> Both {
    get(name).and_then(|text| super::read(text).ok()).map(|p| p.value.title).unwrap_or_default()
}
