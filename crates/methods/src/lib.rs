//! Methods in addition to the velocity and acceleration polygons.
//!
//! Modules: [`centres`] (instantaneous centres of velocity), [`composite`] (composite motion of a
//! point), [`attempts`] (wrong solutions), [`curvature`] (curvature of paths), [`inversions`] (each
//! link as ground in turn), [`loops`] (the analytic method written out), [`gears`] (a pair of spur gears), [`trains`] (gear trains by Willis'
//! method), [`particle`] (motions without a mechanism), [`equation`] (vector equations on their own).

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// clippy.toml lists the functions of f64 with a platform-dependent last bit; tests may use them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// The module overviews link to private modules; `cargo doc --document-private-items` follows those
// links.
#![allow(rustdoc::private_intra_doc_links)]

pub mod attempts;
pub mod centres;
pub mod composite;
pub mod curvature;
pub mod equation;
pub mod gears;
pub mod inversions;
pub mod loops;
pub mod particle;
pub mod trains;

// Compiled again when its Chinese texts change.
const _: &str = include_str!("../po/zh.po");
