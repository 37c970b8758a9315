//! The language of this run's output: that of `--lang`, else the scene's, else English.
//!
//! A scene that cannot be read may still state its language; its faults are then reported in it.

use crate::diag::Both;
use crate::scene::Lang;
use std::sync::OnceLock;

/// The language of `--lang`.
static ASKED: OnceLock<Lang> = OnceLock::new();
/// The language of the scene.
static OF_SCENE: OnceLock<Lang> = OnceLock::new();

/// Sets the language of the command line; the first call counts.
pub fn ask(lang: Lang) {
    let _ = ASKED.set(lang);
}

/// Sets the language of the scene; a run has one scene.
pub fn take(lang: Lang) {
    let _ = OF_SCENE.set(lang);
}

/// Returns the language that the command line asks for.
pub fn asked() -> Option<Lang> {
    ASKED.get().copied()
}

/// Returns the current language.
pub fn now() -> Lang {
    asked().or(OF_SCENE.get().copied()).unwrap_or_default()
}

/// Returns the text in the current language.
pub fn of(text: &Both) -> &str {
    now().of(text)
}
