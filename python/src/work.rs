//! Long work: without the interpreter's lock, interruptible, within a limit of time.
//!
//! The work runs on a thread of its own. The calling thread waits for it, and meanwhile lets Python
//! see its signals: after Ctrl-C, or when the limit of time has passed, the work is cancelled
//! through its [`Budget`].

use crate::fault::{Refusal, internal};
use hodograph::budget::Budget;
use pyo3::prelude::*;
use std::any::Any;
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

/// Time between two looks at the signals.
const LOOK: Duration = Duration::from_millis(50);

/// Stack of the working thread (bytes), that of a main thread.
const STACK: usize = 8 << 20;

thread_local! {
    static DEADLINE: Cell<Option<Instant>> = const { Cell::new(None) };
}

/// Sets the time (s) after which work that this thread begins is stopped; returns the time that
/// was left of the limit before.
#[pyfunction]
#[pyo3(signature = (seconds))]
pub fn limit(seconds: Option<f64>) -> Option<f64> {
    let of = |seconds: f64| Duration::try_from_secs_f64(seconds).ok();
    let next = seconds.and_then(of).and_then(|time| Instant::now().checked_add(time));
    let before = DEADLINE.replace(next);
    before.map(|at| at.saturating_duration_since(Instant::now()).as_secs_f64())
}

/// The progress of work.
#[derive(Default)]
pub struct Progress {
    /// Parts that are done.
    pub done: AtomicU64,
    /// All parts.
    pub all: AtomicU64,
    /// True if the work is to stop.
    pub stop: Arc<AtomicBool>,
    /// The time at which the work is to stop.
    deadline: Option<Instant>,
}

impl Progress {
    /// Returns true if the work is to stop, on any thread.
    pub fn is_over(&self) -> bool {
        self.stop.load(Ordering::Relaxed) || self.deadline.is_some_and(|at| Instant::now() >= at)
    }
}

/// Runs work within the limit of time.
///
/// # Errors
/// The faults of the work; `stopped`; the exception of a signal; an internal error if it panics.
pub fn run<T: Send>(py: Python, work: impl FnOnce() -> Result<T, Refusal> + Send) -> PyResult<T> {
    watched(py, None, |_| work())
}

/// Runs work as [`run`], and calls `tell` with done and all parts while it runs.
///
/// # Errors
/// As [`run`]; those of `tell`, which stop the work.
pub fn watched<T: Send>(
    py: Python,
    tell: Option<&Bound<PyAny>>,
    work: impl FnOnce(&Progress) -> Result<T, Refusal> + Send,
) -> PyResult<T> {
    let deadline = DEADLINE.get();
    let progress = Progress { deadline, ..Progress::default() };
    let mut budget = Budget::default().cancelled_by(progress.stop.clone());
    if let Some(deadline) = deadline {
        budget = budget.until(deadline);
    }
    let tell = tell.map(|tell| tell.clone().unbind());
    let mut thrown = None;
    let done = py.detach(|| {
        let (send, receive) = mpsc::sync_channel(1);
        thread::scope(|s| {
            let progress = &progress;
            let all = move || {
                let done = catch_unwind(AssertUnwindSafe(|| budget.run(|| work(progress))));
                // The receiver waits for it.
                let _ = send.send(done);
            };
            if let Err(e) = thread::Builder::new().stack_size(STACK).spawn_scoped(s, all) {
                return Err(Box::new(e.to_string()) as Box<dyn Any + Send>);
            }
            loop {
                match receive.recv_timeout(LOOK) {
                    Ok(done) => return done,
                    Err(RecvTimeoutError::Timeout) if thrown.is_none() => {
                        let looked = Python::attach(|py| {
                            py.check_signals()?;
                            told(py, tell.as_ref(), progress)
                        });
                        if let Err(e) = looked {
                            thrown = Some(e);
                            progress.stop.store(true, Ordering::Relaxed);
                        }
                    }
                    Err(RecvTimeoutError::Timeout) => {}
                    Err(RecvTimeoutError::Disconnected) => return Err(Box::new("no result")),
                }
            }
        })
    });
    if let Some(e) = thrown {
        return Err(e);
    }
    let value = match done {
        Ok(Ok(Ok(value))) => value,
        Ok(Ok(Err(refusal))) => return Err(refusal.raised(py)),
        Ok(Err(stopped)) => return Err(Refusal::of(stopped).raised(py)),
        Err(panic) => return Err(internal(py, &words(&*panic))),
    };
    told(py, tell.as_ref(), &progress)?;
    Ok(value)
}

/// Calls `tell` with the parts that are done.
fn told(py: Python, tell: Option<&Py<PyAny>>, progress: &Progress) -> PyResult<()> {
    let Some(tell) = tell else { return Ok(()) };
    let [done, all] = [&progress.done, &progress.all].map(|n| n.load(Ordering::Relaxed));
    tell.call1(py, (done, all)).map(drop)
}

/// The message of a panic.
fn words(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_default()
}
