//! Being asked to stop (Ctrl-C, a termination signal) while a file is written: the writer comes to an end by itself, so that nothing
//! half-written stays. Until somebody watches, such a signal ends the program as it does any other.

use std::sync::atomic::{AtomicBool, Ordering};

static ASKED: AtomicBool = AtomicBool::new(false);

/// Exit code of an interrupted run, as shells have it.
pub const INTERRUPTED: u8 = 130;

/// From now on a signal only asks.
pub fn watch() {
    // A second handler in one process is refused; the first does the same.
    let _ = ctrlc::set_handler(|| ASKED.store(true, Ordering::Relaxed));
}

/// Whether the user has asked.
pub fn asked() -> bool {
    ASKED.load(Ordering::Relaxed)
}
