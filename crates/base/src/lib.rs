//! The base of every hodograph crate: numbers, plane geometry, diagnostics in two languages, JSON
//! with positions in the source.
//!
//! Modules: [`number`] (numbers of several precisions behind one trait), [`trig`] (sine and cosine,
//! exact reduction of angles), [`geom`] (points and vectors of the plane), [`cam`] (disc cams as
//! plane geometry), [`digits`] (formatting of numbers for people), [`diag`] (diagnostics), [`json`]
//! (JSON values with their spans), [`budget`] (a limit on the time of a computation), [`linear`]
//! (linear systems), [`kind`] (kinds of quantities), [`diagram`] (kinds of diagrams), [`lang`] (the
//! languages), [`notation`] (marks that differ between textbooks).

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// clippy.toml lists the functions of f64 whose last bit depends on the platform; tests may use
// them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// The module overviews name private modules too; `cargo doc --document-private-items` follows those
// links.
#![allow(rustdoc::private_intra_doc_links)]

pub mod budget;
pub mod cam;
pub mod diag;
pub mod diagram;
pub mod digits;
pub mod geom;
pub mod json;
pub mod kind;
pub mod lang;
pub mod linear;
pub mod notation;
pub mod number;
pub mod trig;

// Compiled again when its Chinese texts change.
const _: &str = include_str!("../po/zh.po");
