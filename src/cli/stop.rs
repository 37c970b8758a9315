//! Requests to stop (Ctrl-C, a termination signal) while a file is written: the writer ends by
//! itself, so that no half-written file remains. Before [`watch`], such a signal ends the program
//! in the default way.
//!
//! A writer in a long computation may not check for a request for seconds. The handler waits a
//! moment; then it ends the program, unless the writer has seen the request and is about to end. An
//! unfinished file then keeps its temporary name, as after any abrupt end.

use crate::diag::both;
use std::process;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

/// True in a process of the program; signals of other processes belong to them.
static OWN: AtomicBool = AtomicBool::new(false);

static ASKED: AtomicBool = AtomicBool::new(false);

/// True once a writer has seen the request.
static HEARD: AtomicBool = AtomicBool::new(false);

/// Number of writers that check regularly.
static LOOKING: AtomicUsize = AtomicUsize::new(0);

/// Locked while files are renamed, and by the handler that ends the program.
static DECIDED: Mutex<()> = Mutex::new(());

/// Exit code of an interrupted run, as in shells.
pub const INTERRUPTED: u8 = 130;

/// Time to wait for a writer: the user gets a response within half a second.
const PATIENCE: Duration = Duration::from_millis(400);

/// Time to wait for a writer that has seen the request or soon will: it may have to remove a file
/// or to write a line, on a slow disk.
const TO_THE_END: Duration = Duration::from_secs(5);

/// Declares that the process runs the program, which may handle its signals.
pub fn own() {
    OWN.store(true, Ordering::Relaxed);
}

/// Handles further signals as requests, if the process runs the program.
pub fn watch() {
    if !OWN.load(Ordering::Relaxed) {
        return;
    }
    // A second handler in one process is refused; the first one serves.
    let _ = ctrlc::set_handler(|| {
        ASKED.store(true, Ordering::Relaxed);
        thread::sleep(PATIENCE);
        if HEARD.load(Ordering::Relaxed) || LOOKING.load(Ordering::Relaxed) > 0 {
            thread::sleep(TO_THE_END);
        }
        let _decided = undisturbed();
        super::interrupted(&both!("what was being computed is not written"));
        super::errors::finish();
        process::exit(i32::from(INTERRUPTED));
    });
}

/// Returns true if the user has asked to stop.
pub fn asked() -> bool {
    let asked = ASKED.load(Ordering::Relaxed);
    if asked {
        HEARD.store(true, Ordering::Relaxed);
    }
    asked
}

/// A writer that checks for requests between rows: on a busy machine the handler waits longer for
/// it, and it leaves no file behind.
pub struct Looking(());

impl Looking {
    /// Begins the checks, until the value is dropped.
    pub fn begin() -> Looking {
        LOOKING.fetch_add(1, Ordering::Relaxed);
        Looking(())
    }
}

impl Drop for Looking {
    fn drop(&mut self) {
        LOOKING.fetch_sub(1, Ordering::Relaxed);
    }
}

/// Prevents the end of the program while the guard is held, for the moment in which files are
/// renamed.
pub fn undisturbed() -> MutexGuard<'static, ()> {
    DECIDED.lock().unwrap_or_else(PoisonError::into_inner)
}
