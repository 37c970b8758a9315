//! The whole solution as one call, and the accuracy of its answers.
//!
//! Modules: [`accuracy`] (the difference of drawing and analysis, and the effect of a pencil error
//! on the drawing), [`worked`] (the result of each stage), [`certified`] (the number of true
//! digits), [`effort`] (the work done, and the cost of accuracy).

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// clippy.toml lists the functions of f64 whose last bit depends on the platform; tests may use
// them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// The maps link to private modules too; `cargo doc --document-private-items` resolves those links.
#![allow(rustdoc::private_intra_doc_links)]

pub mod accuracy;
pub mod certified;
pub mod effort;
pub mod worked;

// Compiled again when its Chinese texts change.
const _: &str = include_str!("../po/zh.po");
