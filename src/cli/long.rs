//! Long work: a progress bar with rate and remaining time, and a pipeline that computes one piece
//! while it writes the one before.

use super::{errors, lang};
use crate::diag::{Both, both};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::{self, IsTerminal};
use std::sync::mpsc;

/// Returns a progress bar on standard error, if that is a terminal.
pub fn bar(all: u64, done: u64, what: &Both) -> ProgressBar {
    let bar = if io::stderr().is_terminal() && !errors::as_json() {
        ProgressBar::new(all)
    } else {
        ProgressBar::hidden()
    };
    let words = both!("{{bar:40}} {{pos}}/{{len}} {}  {{per_sec}}  {{eta}} left", what);
    let style = ProgressStyle::with_template(lang::of(&words));
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.set_position(done);
    bar.reset_eta();
    bar
}

/// Makes, formats and takes pieces in parallel until there are no more or one of the steps fails.
/// Formatted pieces return to `make`, and taken ones to `form`, so that their memory is used again.
/// At most three made and three formatted pieces exist at a time.
pub fn pipeline<T: Send, U: Send>(
    mut make: impl FnMut(Option<T>) -> Option<T> + Send,
    mut form: impl FnMut(&T, Option<U>) -> io::Result<U> + Send,
    mut take: impl FnMut(&U) -> io::Result<()>,
) -> io::Result<()> {
    let (to_form, made) = mpsc::sync_channel(1);
    let (give_back, used) = mpsc::channel();
    let (to_take, formed) = mpsc::sync_channel(1);
    let (give_taken, taken) = mpsc::channel();
    std::thread::scope(|s| {
        // A send fails only after the receiver has failed.
        s.spawn(move || {
            while make(used.try_recv().ok()).is_some_and(|piece| to_form.send(piece).is_ok()) {}
        });
        s.spawn(move || {
            for piece in made {
                let new = form(&piece, taken.try_recv().ok());
                // `make` may have ended.
                let _ = give_back.send(piece);
                if to_take.send(new).is_err() {
                    break;
                }
            }
        });
        formed.into_iter().try_for_each(|piece| {
            let piece = piece?;
            take(&piece)?;
            // `form` may have ended.
            let _ = give_taken.send(piece);
            Ok(())
        })
    })
}
