//! The functions that the page's worker calls.
//!
//! Bytes go in by [`input`] and come out by [`output`]; both are buffers of this module, so the
//! worker neither allocates nor frees. The only unsafe part is the export of the names: no other
//! code of the module may have them.

use crate::{Engine, give_song};
use std::cell::RefCell;
use std::sync::Once;

#[derive(Default)]
struct Desk {
    engine: Engine,
    input: Vec<u8>,
    output: Vec<u8>,
}

thread_local! {
    static DESK: RefCell<Desk> = RefCell::default();
    /// The message of a panic, which ends the engine.
    static FAULT: RefCell<String> = RefCell::default();
}

/// Keeps the messages of panics for [`fault`].
static LISTENING: Once = Once::new();

/// Makes room for a message of `length` bytes; returns the address for its bytes.
// SAFETY: the name belongs to this crate alone.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub extern "C" fn input(length: usize) -> *mut u8 {
    LISTENING.call_once(|| {
        std::panic::set_hook(Box::new(|info| FAULT.set(info.to_string())));
    });
    DESK.with_borrow_mut(|desk| {
        desk.input.clear();
        desk.input.resize(length, 0);
        desk.input.as_mut_ptr()
    })
}

/// Answers the message in the input; returns the number of bytes of the answer.
// SAFETY: the name belongs to this crate alone.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub extern "C" fn call() -> usize {
    DESK.with_borrow_mut(|desk| {
        desk.output = desk.engine.answer(&desk.input);
        desk.output.len()
    })
}

/// Takes the Chinese font from the input; returns 1 if it is a font, else 0.
// SAFETY: the name belongs to this crate alone.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub extern "C" fn font() -> u32 {
    DESK.with_borrow_mut(|desk| u32::from(give_song(std::mem::take(&mut desk.input))))
}

/// Returns the address of the answer.
// SAFETY: the name belongs to this crate alone.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub extern "C" fn output() -> *const u8 {
    DESK.with_borrow(|desk| desk.output.as_ptr())
}

/// Returns the address of the message of a panic.
// SAFETY: the name belongs to this crate alone.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub extern "C" fn fault() -> *const u8 {
    FAULT.with_borrow(|text| text.as_ptr())
}

/// Returns the length of the message of a panic, 0 if there was none.
// SAFETY: the name belongs to this crate alone.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub extern "C" fn fault_length() -> usize {
    FAULT.with_borrow(String::len)
}
