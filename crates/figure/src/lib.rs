//! The figure as typed items in millimetres of paper.
//!
//! All coordinates are y up and independent of any file format; the crate `render` turns a
//! [`hodograph_paper::paper::item::Figure`] into ink.

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// clippy.toml lists the functions of f64 with a platform-dependent last bit; tests may use them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// The module maps also link to private modules; `cargo doc --document-private-items` resolves these
// links.
#![allow(rustdoc::private_intra_doc_links)]

mod arrange;
pub mod attempts;
pub mod cam;
pub mod centres;
mod cognates;
pub mod composite;
mod coriolis;
#[doc(hidden)]
pub mod course;
mod curvature;
pub mod curves;
pub mod cycle;
mod derivation;
mod described;
mod evolution;
mod extremes;
pub mod fit;
pub mod forces;
pub mod frame;
mod gears;
pub mod groups;
pub(crate) mod hodograph;
mod inversions;
mod kutzbach;
pub mod list;
pub mod loops;
pub mod mechanism;
pub mod particle;
pub mod path;
mod placed;
mod plot;
pub mod polygon;
pub mod poses;
pub mod price;
mod relative;
#[doc(hidden)]
pub mod remarks;
mod replaced;
pub mod results;
mod scales;
#[doc(hidden)]
pub mod series;
pub mod sheet;
pub mod stepped;
pub mod steps;
pub mod synthesis;
#[doc(hidden)]
pub mod tables;
mod transmission;
pub mod vector_equation;

// Compiled again when its Chinese texts change.
const _: &str = include_str!("../po/zh.po");
