//! The contract of SVG files (docs/svg.md): ids by meaning, what vectors and marks tell of themselves, and `diff`, which reads it.

#[path = "../wide/mod.rs"]
mod wide;

mod ids;
mod shown;
