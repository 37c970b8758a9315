//! Being asked to stop (Ctrl-C, a termination signal) while a file is written: the writer comes to an end by itself, so that nothing
//! half-written stays. Until somebody watches, such a signal ends the program as it does any other.
//!
//! A writer in the middle of a long computation may not look up for seconds. So it is waited for a moment only; then the program ends
//! all the same, unless the writer has heard and is coming to its end. What is under way then stands under a name of its own, as after
//! any end without warning.

use crate::diag::both;
use std::process;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

static ASKED: AtomicBool = AtomicBool::new(false);

/// Whether a writer has learnt that it is to stop.
static HEARD: AtomicBool = AtomicBool::new(false);

/// Writers that look up again and again by themselves.
static LOOKING: AtomicUsize = AtomicUsize::new(0);

/// Held while files get their names, and by who ends the program.
static DECIDED: Mutex<()> = Mutex::new(());

/// Exit code of an interrupted run, as shells have it.
pub const INTERRUPTED: u8 = 130;

/// How long a writer is waited for: who has pressed a key has an answer within half a second.
const PATIENCE: Duration = Duration::from_millis(400);

/// How long one is waited for that has heard, or soon will: it has a file to remove or a line to write, on whatever disk.
const TO_THE_END: Duration = Duration::from_secs(5);

/// From now on a signal asks first.
pub fn watch() {
    // A second handler in one process is refused; the first does the same.
    let _ = ctrlc::set_handler(|| {
        ASKED.store(true, Ordering::Relaxed);
        thread::sleep(PATIENCE);
        if HEARD.load(Ordering::Relaxed) || LOOKING.load(Ordering::Relaxed) > 0 {
            thread::sleep(TO_THE_END);
        }
        let _decided = undisturbed();
        super::interrupted(&both!("what was being computed is not written", "正在计算的内容没有写入"));
        super::errors::finish();
        process::exit(i32::from(INTERRUPTED));
    });
}

/// Whether the user has asked.
pub fn asked() -> bool {
    let asked = ASKED.load(Ordering::Relaxed);
    if asked {
        HEARD.store(true, Ordering::Relaxed);
    }
    asked
}

/// A writer that looks up between two rows: on a machine with much else to do it is waited for longer, and leaves nothing behind.
pub struct Looking(());

impl Looking {
    /// From now on, until this is dropped.
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

/// As long as this is held the program is not ended in the middle: for the moment in which files get their names.
pub fn undisturbed() -> MutexGuard<'static, ()> {
    DECIDED.lock().unwrap_or_else(PoisonError::into_inner)
}
