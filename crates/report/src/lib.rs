//! Reports of a run as text and JSON: the plan, the construction, the answers, the diagnostics;
//! tables of numbers as files.

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// clippy.toml lists the functions of f64 whose last bit the platform decides; tests may use them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// The module maps also name private modules; `cargo doc --document-private-items` resolves those
// links.
#![allow(rustdoc::private_intra_doc_links)]

#[doc(hidden)]
pub mod amount;
pub mod answers;
pub mod attempts;
pub mod cam;
pub mod centres;
mod centres_found;
pub mod centres_json;
mod columns;
pub mod comparison;
pub mod composite;
pub mod construction;
pub mod curvature;
pub mod curvature_json;
mod curvature_legend;
pub mod curvature_steps;
pub mod cycle;
pub mod diagnostics;
pub mod drafting;
#[doc(hidden)]
pub mod equation;
pub mod forces;
#[doc(hidden)]
pub mod given;
#[doc(hidden)]
pub mod html;
pub mod inversions;
pub mod limits;
pub mod loops;
pub mod mobility;
pub mod particle;
pub mod plan;
pub mod plan_json;
pub mod price;
pub mod readings;
pub mod replaced;
pub mod statement;
#[doc(hidden)]
pub mod symbols;
pub mod synthesis;
#[cfg(feature = "csv")]
pub mod table;
pub mod teeth;
pub mod trains;
pub mod tried;
pub mod vector_equation;
mod writing;

// Compiled again when its Chinese texts change.
const _: &str = include_str!("../po/zh.po");
