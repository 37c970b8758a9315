//! Standard error: faults, warnings and notes, written at once as text, or with `--errors json` as
//! one document at the end of the run.

use super::{files, lang};
use crate::diag::{Diagnostic, Faults, json};
use crate::report::diagnostics;
use serde_json::Value;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

/// True if the run writes its faults as JSON.
static AS_JSON: AtomicBool = AtomicBool::new(false);

/// The document under construction; `None` once it is written.
static TOLD: Mutex<Option<Vec<Value>>> = Mutex::new(Some(Vec::new()));

/// Collects all further diagnostics for the document.
pub fn collect() {
    AS_JSON.store(true, Ordering::Relaxed);
}

/// Returns true if faults are collected for the document; nothing else then goes to standard error.
pub fn as_json() -> bool {
    AS_JSON.load(Ordering::Relaxed)
}

/// Reports diagnostics of a text: a file, or the value of an option; `name` is its name.
pub fn tell(faults: &Faults, name: &str, source: &str) {
    if as_json() {
        add(faults.json(name, source));
    } else if !faults.list.is_empty() {
        files::write_stderr(&diagnostics::render_in(faults, name, source, lang::now()));
    }
}

/// Reports a diagnostic; as text it is a single line.
pub fn tell_line(diagnostic: &Diagnostic, line: &str) {
    if as_json() {
        add(vec![diagnostic.json("", "")]);
    } else {
        files::write_stderr(line);
    }
}

fn add(more: Vec<Value>) {
    let mut told = TOLD.lock().unwrap_or_else(PoisonError::into_inner);
    told.iter_mut().for_each(|list| list.extend(more.iter().cloned()));
}

/// Ends the reports: writes the document once, even if it is empty.
pub fn finish() {
    if !as_json() {
        return;
    }
    let told = TOLD.lock().unwrap_or_else(PoisonError::into_inner).take();
    if let Some(list) = told {
        files::write_stderr(&format!("{:#}\n", json::document(list)));
    }
}
