//! The drawing board: relative-motion vector equations, and their construction with ruler and
//! paper.
//!
//! Modules: [`plan`] (the vector equations, without numbers), [`construction`] (acts of ruler and
//! set squares, and their evaluation), [`construct`] (a plan written as acts, drawn in millimetres
//! of paper, and read).
//! The crate does not use the loop equations, and they do not use it: the agreement of drawing and
//! analysis is therefore evidence.

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// A new kind makes the compiler report every match that it concerns.
#![warn(clippy::wildcard_enum_match_arm)]
// clippy.toml lists the functions of f64 with a platform-dependent last bit; tests may use them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// The module overviews link to private modules; `cargo doc --document-private-items` follows those
// links.
#![allow(rustdoc::private_intra_doc_links)]

pub mod construct;
pub mod construction;
pub mod equilibrium;
pub mod plan;

// Compiled again when its Chinese texts change.
const _: &str = include_str!("../po/zh.po");
