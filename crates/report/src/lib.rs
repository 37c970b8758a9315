//! What is told: plan, construction, answers and diagnostics as text in either language, as JSON, and as tables.
//!
//! Room: [`report`].

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// clippy.toml lists the functions of f64 whose last bit the platform decides; tests may use them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// The maps name private rooms too; `cargo doc --document-private-items` follows those links.
#![allow(rustdoc::private_intra_doc_links)]

use hodograph_analytic::analytic;
use hodograph_base::{cam, diag, digits, geom, number};
use hodograph_board::{construct, plan};
use hodograph_mechanism::{answer, mechanism, motion, position};
use hodograph_methods::{attempts, centres, composite, curvature, inversions, particle, trains};
use hodograph_paper::{paper, render};
use hodograph_scene::scene;
use hodograph_sweep::sweep;
use hodograph_synthesis::synthesis;
use hodograph_worked::{accuracy, certified, effort, worked};

pub mod report;
