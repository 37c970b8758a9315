//! Searches by which synthesis finds linkages.
//!
//! Room: [`search`] (crank-rockers whose coupler point passes nearest to given places). A crate of its own because it is optimised: the
//! rest of synthesis is not.

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// clippy.toml lists the functions of f64 whose last bit the platform decides; tests may use them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// The maps name private rooms too; `cargo doc --document-private-items` follows those links.
#![allow(rustdoc::private_intra_doc_links)]

use hodograph_base::{diag, geom};
use hodograph_mechanism::position;

pub mod search;
