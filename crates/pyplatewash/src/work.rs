//! Work without the interpreter lock: threads that survive a fork, Ctrl-C, no panic.
//!
//! Calls of the package's Python functions from Rust methods: figures, pages in cells.
//!
//! The command `platewash`: the same code as the Rust program.

use crate::{argument, exception};
use platewash::CancelToken;
use pyo3::call::PyCallArgs;
use pyo3::prelude::*;
use pyo3::types::PyString;
use rayon::ThreadPool;
use std::ffi::OsString;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// Time between two looks for signals.
const LOOK: Duration = Duration::from_millis(20);

/// Stack of a thread of ours.
const STACK_BYTES: usize = 8 << 20;

/// Items that a batch works on between two looks for signals: some ten milliseconds.
pub const STRETCH: usize = 1 << 16;

/// The pool of a process: a fork takes the memory along but not the threads.
static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// The threads to work on, as many as `RAYON_NUM_THREADS` says, else one a processor.
fn pool(py: Python<'_>) -> PyResult<Arc<ThreadPool>> {
    let mut held = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    let here = std::process::id();
    if let Some((process, pool)) = held.as_ref()
        && *process == here
    {
        return Ok(pool.clone());
    }
    let pool = Arc::new(new_pool(py)?);
    // A parent's pool has no threads here that could be told to end.
    std::mem::forget(held.replace((here, pool.clone())));
    Ok(pool)
}

fn new_pool(py: Python<'_>) -> PyResult<ThreadPool> {
    let pool = rayon::ThreadPoolBuilder::new().stack_size(STACK_BYTES).build();
    pool.map_err(|e| exception::internal(py, &format!("no threads: {e}")))
}

/// Runs short work on the pool without the interpreter lock.
///
/// # Errors
/// `InternalError` in place of a panic.
pub fn released<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    let pool = pool(py)?;
    let done = py.detach(|| catch_unwind(AssertUnwindSafe(|| pool.install(work))));
    done.map_err(|panic| exception::internal(py, &panic_text(panic.as_ref())))
}

/// Runs short work on this thread without the interpreter lock.
///
/// # Errors
/// `InternalError` in place of a panic.
pub fn alone<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    let done = py.detach(|| catch_unwind(AssertUnwindSafe(work)));
    done.map_err(|panic| exception::internal(py, &panic_text(panic.as_ref())))
}

/// Runs work without the interpreter lock on threads of its own, beside other such work: a thread of a shared pool that waits for a
/// part of one would begin another one meanwhile, and the first had to wait for it.
///
/// # Errors
/// `InternalError` in place of a panic.
pub fn aside<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    let pool = new_pool(py)?;
    let done = py.detach(|| catch_unwind(AssertUnwindSafe(|| pool.install(work))));
    done.map_err(|panic| exception::internal(py, &panic_text(panic.as_ref())))
}

/// Runs work that may take long without the interpreter lock, looking for signals: Ctrl-C raises at once, and the work, for whose
/// result nobody waits any more, is told to give up.
///
/// # Errors
/// The exception of a signal handler (`KeyboardInterrupt`); `InternalError` in place of a panic.
pub fn patiently<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(&CancelToken) -> T + Send + 'static,
) -> PyResult<T> {
    patiently_on(py, pool(py)?, &CancelToken::new(), work)
}

/// Runs work as [`patiently`] does, on a pool of `threads` threads of its own. The caller can cancel it by `cancel`.
///
/// # Errors
/// As [`patiently`]; `EngineError` where the system has not so many threads.
pub fn patiently_by<T: Send + 'static>(
    py: Python<'_>,
    threads: usize,
    cancel: &CancelToken,
    work: impl FnOnce(&CancelToken) -> T + Send + 'static,
) -> PyResult<T> {
    let pool = rayon::ThreadPoolBuilder::new()
        .stack_size(STACK_BYTES)
        .num_threads(threads);
    let pool = pool.build().map_err(|e| {
        exception::named(
            py,
            "EngineError",
            &format!("no {threads} threads begin: {e}; give fewer workers"),
        )
    })?;
    patiently_on(py, Arc::new(pool), cancel, work)
}

fn patiently_on<T: Send + 'static>(
    py: Python<'_>,
    pool: Arc<ThreadPool>,
    cancel: &CancelToken,
    work: impl FnOnce(&CancelToken) -> T + Send + 'static,
) -> PyResult<T> {
    let (answer, waiting) = channel();
    let heard = cancel.clone();
    let run = move || {
        let done = catch_unwind(AssertUnwindSafe(|| pool.install(|| work(&heard))));
        // Nobody may be waiting any more.
        let _ = answer.send(done);
    };
    let spawned = std::thread::Builder::new().stack_size(STACK_BYTES).spawn(run);
    spawned.map_err(|e| exception::internal(py, &format!("no thread: {e}")))?;
    let waiting = Mutex::new(waiting);
    loop {
        let heard = py.detach(|| {
            let waiting = waiting.lock().unwrap_or_else(PoisonError::into_inner);
            waiting.recv_timeout(LOOK)
        });
        match heard {
            Ok(Ok(done)) => return Ok(done),
            Ok(Err(panic)) => return Err(exception::internal(py, &panic_text(panic.as_ref()))),
            Err(RecvTimeoutError::Disconnected) => {
                return Err(exception::internal(py, "a thread ended without an answer"));
            }
            Err(RecvTimeoutError::Timeout) => py.check_signals().inspect_err(|_| cancel.cancel())?,
        }
    }
}

fn panic_text(panic: &(dyn std::any::Any + Send)) -> String {
    let words = panic
        .downcast_ref::<&str>()
        .map(|text| (*text).to_owned())
        .or_else(|| panic.downcast_ref::<String>().cloned());
    format!("a fault in platewash, please report it: {}", words.unwrap_or_default())
}

/// Calls a function in one of the package's Python modules and returns its result.
///
/// # Errors
/// The exception that the function raises.
pub fn ask<'py>(
    py: Python<'py>,
    module: &str,
    function: &str,
    arguments: impl PyCallArgs<'py>,
) -> PyResult<Bound<'py, PyAny>> {
    let module = py.import(format!("pyplatewash.{module}"))?;
    module.getattr(function)?.call1(arguments)
}

/// Runs the command `platewash` with these arguments (its own name left out) in this process: results on standard output,
/// messages on standard error. The answer is the exit code: 0 done, 1 internal error, 2 bad usage or input, 3 infeasible,
/// 4 verification failed. Ctrl-C raises, and ends long work and `view`.
#[pyfunction]
pub fn run_command(py: Python<'_>, arguments: &Bound<'_, PyAny>) -> PyResult<u8> {
    let line = line(arguments)?;
    patiently(py, move |cancel| platewash::cli::main_until(line, cancel))
}

/// The same as a program of its own, which answers Ctrl-C: exit code 130.
#[pyfunction]
pub fn _program(py: Python<'_>, arguments: &Bound<'_, PyAny>) -> PyResult<u8> {
    let line = line(arguments)?;
    alone(py, move || platewash::cli::program(line))
}

/// The command's own name and its arguments.
fn line(arguments: &Bound<'_, PyAny>) -> PyResult<Vec<OsString>> {
    const NEEDED: &str = "a list of strings";
    if arguments.is_instance_of::<PyString>() {
        return Err(argument::wrong_type("arguments", arguments, NEEDED));
    }
    let arguments = argument::each("arguments", arguments, NEEDED, argument::path)?;
    let arguments = arguments.into_iter().map(PathBuf::into_os_string);
    Ok(std::iter::once(OsString::from("platewash")).chain(arguments).collect())
}
