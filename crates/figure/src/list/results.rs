//! The results, alone.

use crate::sheet;

use super::{Entry, page};

/// The results.
pub const ENTRY: Entry = Entry {
    name: "results",
    about: ["The results", "结果"],
    draw: |w| page(ENTRY.name, Some(sheet::results(w.scene, w.worked, w.options))),
};
