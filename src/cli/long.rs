//! Long work: a bar with rate and time left, and one piece computed while the one before it is written.

use indicatif::{ProgressBar, ProgressStyle};
use std::io::{self, IsTerminal};
use std::sync::mpsc;

/// A bar on standard error, where that is a terminal.
pub fn bar(all: u64, done: u64, what: &str) -> ProgressBar {
    let bar = if io::stderr().is_terminal() { ProgressBar::new(all) } else { ProgressBar::hidden() };
    let style = ProgressStyle::with_template(&format!("{{bar:40}} {{pos}}/{{len}} {what}  {{per_sec}}  {{eta}} left"));
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.set_position(done);
    bar.reset_eta();
    bar
}

/// Makes and takes pieces side by side until there are no more, or one of them fails. At most three are in memory.
pub fn overlapped<T: Send>(mut make: impl FnMut() -> Option<T> + Send, mut take: impl FnMut(T) -> io::Result<()>) -> io::Result<()> {
    let (sender, pieces) = mpsc::sync_channel(1);
    std::thread::scope(|s| {
        // An error of the sender: the taker has failed and gone.
        s.spawn(move || while make().is_some_and(|piece| sender.send(piece).is_ok()) {});
        pieces.into_iter().try_for_each(&mut take)
    })
}
