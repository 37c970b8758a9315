//! The drawing board: relative-motion vector equations, and their construction with ruler and paper.
//!
//! Rooms: [`plan`] (the vector equations, without numbers), [`construction`] (acts of ruler and set squares, and their evaluation), [`construct`] (a plan
//! written as acts and drawn in millimetres of paper, and what is read off it).
//! The crate does not know the loop equations, and they do not know it: that drawing and analysis agree is evidence because of this.

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// A kind that is added shows the compiler every match that it concerns.
#![warn(clippy::wildcard_enum_match_arm)]
// clippy.toml lists the functions of f64 whose last bit the platform decides; tests may use them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// The maps name private rooms too; `cargo doc --document-private-items` follows those links.
#![allow(rustdoc::private_intra_doc_links)]

pub mod construct;
pub mod construction;
pub mod equilibrium;
pub mod plan;
