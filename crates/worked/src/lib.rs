//! The whole way as one call, and how true its answers are.
//!
//! Rooms: [`accuracy`] (how far drawing and analysis are apart, and what a pencil makes of the drawing), [`worked`] (each stage's result
//! kept), [`certified`] (how many digits are true), [`effort`] (what was done, and what accuracy costs).

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// clippy.toml lists the functions of f64 whose last bit the platform decides; tests may use them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// The maps name private rooms too; `cargo doc --document-private-items` follows those links.
#![allow(rustdoc::private_intra_doc_links)]

pub mod accuracy;
pub mod certified;
pub mod effort;
pub mod worked;
