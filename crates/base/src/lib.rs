//! What every crate of hodograph stands on: numbers, plane geometry, diagnostics in two languages, JSON with places.
//!
//! Rooms: [`number`] (numbers of several precisions behind one trait), [`trig`] (sine and cosine, exact reduction of angles), [`geom`]
//! (points and vectors of the plane), [`cam`] (disc cams as plain geometry), [`digits`] (counting digits that are true), [`diag`] (what is
//! told of a fault), [`json`] (JSON whose words know where they stand), [`budget`] (a limit on the time of a
//! computation), [`kind`] (kinds of quantities), [`diagram`] (kinds of diagrams), [`lang`] (the languages), [`notation`] (marks that differ between textbooks).

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// clippy.toml lists the functions of f64 whose last bit the platform decides; tests may use them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// The maps name private rooms too; `cargo doc --document-private-items` follows those links.
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
pub mod notation;
pub mod number;
pub mod trig;
