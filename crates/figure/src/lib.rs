//! What is drawn: diagram, polygons, tables and sheet as items on paper; motions as line diagrams, paths, poses and frames.
//!
//! Room: [`figure`].

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// clippy.toml lists the functions of f64 whose last bit the platform decides; tests may use them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// The maps name private rooms too; `cargo doc --document-private-items` follows those links.
#![allow(rustdoc::private_intra_doc_links)]

use hodograph_analytic::analytic;
use hodograph_base::{cam, diag, digits, geom};
use hodograph_board::{construct, plan};
use hodograph_mechanism::{answer, mechanism, position};
use hodograph_methods::{attempts, centres, composite, curvature, gears, inversions, particle, trains};
use hodograph_paper::paper;
use hodograph_report::report;
use hodograph_scene::scene;
use hodograph_sweep::sweep;
use hodograph_synthesis::synthesis;
use hodograph_worked::{accuracy, certified, effort, worked};

pub mod figure;
