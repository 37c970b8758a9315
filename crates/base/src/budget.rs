//! A limit on the time of a computation, and a way to stop it from another thread.
//!
//! [`Budget::run`] runs a computation. All long loops of the library call [`spend`]; when the
//! budget is spent, [`spend`] unwinds to [`Budget::run`], which returns a diagnostic. A computation
//! without a budget is never stopped. A program built with `panic = "abort"` cannot stop
//! computations this way.

use crate::diag::{Diagnostic, both};
use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// A limit on a computation: a deadline, a flag that cancels it, or both.
///
/// ```
/// use hodograph_base::budget::{Budget, spend};
/// use std::time::{Duration, Instant};
/// let budget = Budget::default().until(Instant::now() + Duration::from_millis(5));
/// let endless = budget.run(|| -> f64 { loop { spend() } });
/// assert_eq!(endless.unwrap_err().code, "stopped");
/// assert_eq!(budget.run(|| 2 + 2).unwrap(), 4);
/// ```
#[derive(Clone, Debug, Default)]
pub struct Budget {
    deadline: Option<Instant>,
    cancelled: Option<Arc<AtomicBool>>,
}

/// The reason why a computation is stopped; the payload that unwinds from [`spend`] to
/// [`Budget::run`].
#[derive(Clone, Copy)]
enum Spent {
    Time,
    Cancelled,
}

thread_local! {
    /// The budget of the computation that runs on this thread.
    static HERE: RefCell<Option<Budget>> = const { RefCell::new(None) };
}

/// Restores the outer budget, also when the work unwinds.
struct OuterBudget(Option<Budget>);

impl Drop for OuterBudget {
    fn drop(&mut self) {
        HERE.set(self.0.take());
    }
}

impl Budget {
    /// Returns the budget with a deadline.
    pub fn until(self, deadline: Instant) -> Budget {
        Budget { deadline: Some(deadline), ..self }
    }

    /// Returns the budget with a flag: the computation stops soon after the flag is set.
    pub fn cancelled_by(self, flag: Arc<AtomicBool>) -> Budget {
        Budget { cancelled: Some(flag), ..self }
    }

    /// Runs a computation within the budget and returns its result.
    ///
    /// Within a nested budget only the inner budget counts.
    ///
    /// # Errors
    /// `stopped` if the deadline passes or the flag is set before the computation ends.
    pub fn run<T>(&self, work: impl FnOnce() -> T) -> Result<T, Diagnostic> {
        match catch_unwind(AssertUnwindSafe(|| ThreadBudget(Some(self.clone())).enter(work))) {
            Ok(value) => Ok(value),
            Err(thrown) => match thrown.downcast_ref::<Spent>() {
                Some(spent) => Err(spent.diagnostic()),
                None => resume_unwind(thrown),
            },
        }
    }

    fn spent(&self) -> Option<Spent> {
        if self.cancelled.as_ref().is_some_and(|flag| flag.load(Ordering::Relaxed)) {
            return Some(Spent::Cancelled);
        }
        self.deadline.filter(|deadline| Instant::now() >= *deadline).map(|_| Spent::Time)
    }
}

impl Spent {
    fn diagnostic(self) -> Diagnostic {
        let message = match self {
            Spent::Time => both!("the computation takes longer than its budget of time"),
            Spent::Cancelled => both!("the computation was cancelled"),
        };
        Diagnostic::error("stopped", message).help(both!("allow more time, or ask for less"))
    }
}

/// Stops the computation if its budget is spent. A call costs some nanoseconds.
pub fn spend() {
    let spent = HERE.with_borrow(|budget| budget.as_ref().and_then(Budget::spent));
    if let Some(spent) = spent {
        resume_unwind(Box::new(spent));
    }
}

/// Returns the budget of the computation on this thread, to be passed to other threads.
pub fn here() -> ThreadBudget {
    ThreadBudget(HERE.with_borrow(Option::clone))
}

/// The budget of one thread, passed to another thread.
#[derive(Clone, Debug)]
pub struct ThreadBudget(Option<Budget>);

impl ThreadBudget {
    /// Runs a part of the computation on the calling thread under this budget. A thread that waits
    /// for another computation may run the part, so a part without a budget suspends the budget of
    /// that thread.
    pub fn enter<T>(&self, work: impl FnOnce() -> T) -> T {
        let _outer = OuterBudget(HERE.replace(self.0.clone()));
        work()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn a_flag_stops_other_threads() {
        let flag = Arc::new(AtomicBool::new(false));
        let budget = Budget::default().cancelled_by(flag.clone());
        let done = budget.run(|| {
            let here = here();
            std::thread::scope(|s| {
                let other = s.spawn(|| {
                    here.enter(|| {
                        loop {
                            spend();
                        }
                    })
                });
                flag.store(true, Ordering::Relaxed);
                other.join().unwrap_or_else(|thrown| resume_unwind(thrown))
            })
        });
        assert_eq!(done.unwrap_err().message.en, "the computation was cancelled");
    }

    #[test]
    fn an_inner_budget_stands_for_itself() {
        let late = Budget::default().until(Instant::now() + Duration::from_secs(3600));
        let past = Budget::default().until(Instant::now());
        let inner = late.run(|| past.run(spend).is_err());
        assert!(inner.unwrap());
        assert!(past.run(|| late.run(spend).is_ok()).unwrap());
        spend();
    }

    #[test]
    fn a_part_without_a_budget_is_not_stopped_by_that_of_its_thread() {
        let free = here();
        let past = Budget::default().until(Instant::now());
        assert_eq!(
            past.run(|| free.enter(|| {
                spend();
                7
            }))
            .unwrap(),
            7
        );
    }

    #[test]
    fn other_panics_go_on() {
        let thrown = catch_unwind(|| Budget::default().run(|| resume_unwind(Box::new(7))));
        assert_eq!(thrown.unwrap_err().downcast_ref::<i32>(), Some(&7));
    }
}
