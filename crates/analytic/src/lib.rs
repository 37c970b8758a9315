//! The loop equations of a mechanism, all rows at once in `f64`: the proof of the drawing, which it does not know.
//!
//! Room: [`analytic`] (constraint rows, Jacobian, conditioning; singular poses by the next orders).

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// A kind that is added shows the compiler every match that it concerns.
#![warn(clippy::wildcard_enum_match_arm)]
// clippy.toml lists the functions of f64 whose last bit the platform decides; tests may use them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// The maps name private rooms too; `cargo doc --document-private-items` follows those links.
#![allow(rustdoc::private_intra_doc_links)]

use hodograph_base::{cam, diag, geom};
use hodograph_mechanism::{answer, mechanism, position};
use hodograph_scene::scene;

pub mod analytic;
