//! The file a person writes of a mechanism.
//!
//! Room: [`scene`] (from its text to a valid [`scene::Scene`]; templates, schema, what can be asked).

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// clippy.toml lists the functions of f64 whose last bit the platform decides; tests may use them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// The maps name private rooms too; `cargo doc --document-private-items` follows those links.
#![allow(rustdoc::private_intra_doc_links)]

use hodograph_base::{cam, diag, digits, geom, json, number, trig};

pub mod scene;
