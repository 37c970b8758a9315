//! The engine of the web page: the calls of [`hodograph::problem`] as messages in JSON.
//!
//! [`abi`] is the interface to the page's worker, without imports: it exchanges bytes. [`Engine`]
//! answers messages: `open` reads a file and keeps it under a handle, `frame` draws it at a place
//! of its motion, `steps` draws the construction, `motion` follows the driver, `place` gives the
//! edit that puts a driver into the text, `export` writes documents, `report` tells limits, mobility,
//! motion cycle or cams, `close` forgets the file.
//! `templates`, `template`, `schema`, `values` (of quantities of a text) and
//! `trial` (the frame of a text that is not kept) need no file.

#![deny(unsafe_code)]
#![warn(missing_docs)]
// clippy.toml lists the functions of f64 whose last bit the platform decides; tests may use them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod abi;
mod engine;
mod export;
mod file;
mod motion;
mod moving;
mod plane;
mod report;
mod words;

// Compiled again when its Chinese texts change.
const _: &str = include_str!("../po/zh.po");

pub use engine::Engine;
use hodograph::paper::font::give_song;
