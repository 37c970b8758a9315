//! The prefix of the ids of this run's SVG files: that of `--id-prefix`.

use super::Failure;
use crate::render::svg::IdPrefix;
use std::borrow::Cow;
use std::sync::OnceLock;

/// The prefix of the command line; a run has one.
static PREFIX: OnceLock<IdPrefix> = OnceLock::new();

/// Takes the prefix of the command line.
pub fn take(text: &str) -> Result<(), Failure> {
    let prefix = IdPrefix::new(text).map_err(|d| Failure::argument("--id-prefix", text, d))?;
    let _ = PREFIX.set(prefix);
    Ok(())
}

/// An SVG with the prefix before its ids.
pub fn put_before(svg: &str) -> Cow<'_, str> {
    PREFIX.get().map_or(svg.into(), |prefix| prefix.put_before(svg))
}
