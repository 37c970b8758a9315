//! All positions of a driver, as fast as the loop written by hand.
//!
//! Room: [`sweep`] (the scene compiled to operations over chunks of positions; limits and extremes of the motion; batches of
//! mechanisms).

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// clippy.toml lists the functions of f64 whose last bit the platform decides; tests may use them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// The maps name private rooms too; `cargo doc --document-private-items` follows those links.
#![allow(rustdoc::private_intra_doc_links)]

use hodograph_analytic::analytic;
use hodograph_base::{cam, diag, digits, geom, number, trig};
use hodograph_mechanism::{answer, mechanism, motion, position, stated};
use hodograph_scene::scene;

pub mod sweep;
