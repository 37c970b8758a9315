//! Paper and ink: what figures are made of, and how it is written as SVG, PDF and PNG.
//!
//! Rooms: [`paper`] (typed items, labels, words, fonts, placement of labels, styles), [`render`] (the doors between y up and y down).

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// clippy.toml lists the functions of f64 whose last bit the platform decides; tests may use them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// The maps name private rooms too; `cargo doc --document-private-items` follows those links.
#![allow(rustdoc::private_intra_doc_links)]

pub mod paper;
pub mod render;
