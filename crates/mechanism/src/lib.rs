//! Links, pairs and groups of a scene, their positions and their motion.
//!
//! Modules: [`mechanism`] (links, pairs and drivers as a graph, with a form for each pair; Assur
//! groups in solving order), [`position`] (positions of everything; the measure of a form is
//! written once, for any number type), [`stated`] (proof of positions against the scene),
//! [`answer`] (evaluation of requested quantities), [`motion`] (velocities and accelerations group
//! by group, for any number type).

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// The compiler then reports every match that an added kind affects.
#![warn(clippy::wildcard_enum_match_arm)]
// clippy.toml lists the functions of f64 whose last bit depends on the platform; tests may use
// them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// The module overviews name private modules too; `cargo doc --document-private-items` follows those
// links.
#![allow(rustdoc::private_intra_doc_links)]

pub mod answer;
pub mod force;
pub mod mechanism;
pub mod motion;
pub mod position;
pub mod stated;

// Compiled again when its Chinese texts change.
const _: &str = include_str!("../po/zh.po");
