//! What is said about a run: diagnostics as text.

pub mod diagnostics;
