//! Functions of the WebAssembly module. Texts pass through the module's memory, as UTF-8.

// The names of the functions are the interface of the module.
#![allow(unsafe_code)]

use crate::Playground;
use std::sync::{LazyLock, Mutex, PoisonError};
use std::time::Duration;

#[link(wasm_import_module = "host")]
unsafe extern "C" {
    /// Milliseconds since some fixed moment.
    safe fn now() -> f64;
    /// Takes a line of an answer.
    safe fn tell(text: *const u8, bytes: usize);
    /// Takes the message of a panic, after which the module is of no more use.
    safe fn fail(text: *const u8, bytes: usize);
}

/// Question of the host: its path, a line feed, its JSON.
static QUESTION: Mutex<Vec<u8>> = Mutex::new(Vec::new());

static PLAYGROUND: LazyLock<Playground> = LazyLock::new(|| {
    std::panic::set_hook(Box::new(|panic| {
        let words = panic.to_string();
        fail(words.as_ptr(), words.len());
    }));
    Playground::new(|| Duration::from_secs_f64(1e-3 * now().max(0.0)))
});

/// Makes room for a question; returns where the host has to write it.
#[unsafe(no_mangle)]
pub extern "C" fn reserve(bytes: usize) -> *mut u8 {
    let mut question = QUESTION.lock().unwrap_or_else(PoisonError::into_inner);
    *question = vec![0; bytes];
    question.as_mut_ptr()
}

/// Answers the question that was written.
#[unsafe(no_mangle)]
pub extern "C" fn answer() {
    let question = std::mem::take(&mut *QUESTION.lock().unwrap_or_else(PoisonError::into_inner));
    let question = String::from_utf8_lossy(&question);
    let (path, question) = question.split_once('\n').unwrap_or((&question, "{}"));
    PLAYGROUND.answer(path, question, &mut |line| tell(line.as_ptr(), line.len()));
}
