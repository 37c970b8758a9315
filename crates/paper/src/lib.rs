//! Paper and ink: the items of figures, and their output as SVG, PDF and PNG.
//!
//! Modules: [`paper`] (typed items, labels, words, fonts, placement of labels, styles) and
//! [`render`] (writers of file formats, which turn y over where the format needs it).

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// clippy.toml lists the functions of f64 whose last bit the platform decides; tests may use them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// The module maps also name private modules; `cargo doc --document-private-items` resolves those
// links.
#![allow(rustdoc::private_intra_doc_links)]

pub mod paper;
pub mod render;

// Compiled again when its Chinese texts change.
const _: &str = include_str!("../po/zh.po");
