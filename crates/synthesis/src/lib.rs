//! Synthesis: from what a linkage is to do to scenes that do it.
//!
//! Room: [`synthesis`] (closed formulas, the construction with ruler and paper, judging by sweeping).

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// clippy.toml lists the functions of f64 whose last bit the platform decides; tests may use them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// The maps name private rooms too; `cargo doc --document-private-items` follows those links.
#![allow(rustdoc::private_intra_doc_links)]

use hodograph_base::{diag, digits, geom, json, number};
use hodograph_board::construct;
use hodograph_mechanism::{mechanism, position};
use hodograph_scene::scene;
use hodograph_search::search;
use hodograph_sweep::sweep;

pub mod synthesis;
