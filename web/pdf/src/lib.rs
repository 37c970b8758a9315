//! The PDF writer of the web page, loaded when the first PDF is asked for.
//!
//! The page's engine decides all positions and sends the pages as data (feature `wire` of
//! `hodograph_paper`); this module writes the file, with the program's own writer. [`abi`] is the
//! interface to the page's worker, the same file as the engine's.

#![deny(unsafe_code)]
#![warn(missing_docs)]
#![warn(clippy::disallowed_methods)]

#[path = "../../engine/src/abi.rs"]
pub mod abi;

use hodograph_base::diag::{Both, Diagnostic, Faults};
use hodograph_paper::paper::font::give_song;
use hodograph_paper::render::{pages::Page, pdf};

/// A writer without a state.
#[derive(Default)]
pub struct Engine;

impl Engine {
    /// Answers pages, title and language tag with the file; if it cannot be made, with the first
    /// fault as JSON, in both languages.
    pub fn answer(&mut self, message: &[u8]) -> Vec<u8> {
        let written = postcard::from_bytes::<(Vec<Page>, String, String)>(message)
            .map_err(|e| Faults::from(Diagnostic::error("pdf", Both::same(e.to_string()))))
            .and_then(|(pages, title, lang)| pdf::document(&pages, &title, &lang));
        match written {
            Ok(file) => file.value,
            Err(faults) => {
                let first = faults.list.first().map(|d| d.message.json().to_string());
                first.unwrap_or_default().into_bytes()
            }
        }
    }
}
