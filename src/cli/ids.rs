//! The prefix of the ids in the SVG files of this run (`--id-prefix`).

use super::{Failure, args};
use crate::diag::{Diagnostic, both};
use crate::render::svg::IdPrefix;
use std::borrow::Cow;
use std::sync::OnceLock;

/// The prefix of the command line, one per run.
static PREFIX: OnceLock<IdPrefix> = OnceLock::new();

/// Sets the prefix from the command line.
pub fn take(text: &str) -> Result<(), Failure> {
    let prefix = IdPrefix::new(text).map_err(|d| Failure::argument("--id-prefix", text, d))?;
    let _ = PREFIX.set(prefix);
    Ok(())
}

/// Returns an SVG with the prefix before its ids.
pub fn put_before(svg: &str) -> Cow<'_, str> {
    PREFIX.get().map_or(svg.into(), |prefix| prefix.put_before(svg))
}

/// Refuses a prefix for a whole page.
pub fn of_lesson(a: &args::LessonArgs) -> Result<(), Failure> {
    if a.look.id_prefix.is_empty() || a.reveal {
        return Ok(());
    }
    let message = both!("a lesson is a page of its own: its ids have no prefix");
    let d =
        Diagnostic::error("id-prefix", message).help(both!("it is for figures and for --reveal"));
    Err(Failure::argument("--id-prefix", &a.look.id_prefix, d))
}
