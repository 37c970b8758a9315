//! The language in which this run speaks: that of `--lang`, else the scene's, else English.
//!
//! A scene that cannot be read may still tell its language: what is wrong with it is said in that.

use crate::diag::Both;
use crate::scene::Lang;
use std::sync::OnceLock;

/// The language of `--lang`.
static ASKED: OnceLock<Lang> = OnceLock::new();
/// The language of the scene.
static OF_SCENE: OnceLock<Lang> = OnceLock::new();

/// Takes the language of the command line; the first one counts.
pub fn ask(lang: Lang) {
    let _ = ASKED.set(lang);
}

/// Takes the language of the scene; a run has one scene.
pub fn take(lang: Lang) {
    let _ = OF_SCENE.set(lang);
}

/// The language that the command line asks for.
pub fn asked() -> Option<Lang> {
    ASKED.get().copied()
}

/// The language of what is said now.
pub fn now() -> Lang {
    asked().or(OF_SCENE.get().copied()).unwrap_or_default()
}

/// A text in it.
pub fn of(text: &Both) -> &str {
    now().of(text)
}
