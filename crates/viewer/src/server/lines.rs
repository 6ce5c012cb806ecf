//! The lines of an answer, as they are known.

use super::answer;
use super::deadline::Deadline;
use super::limits::{HEARTBEAT, TO_RECEIVE_LINE};
use super::refusal::Refusal;
use std::io::{Result, Write};
use std::net::TcpStream;
use std::sync::{Mutex, MutexGuard, PoisonError, TryLockError};
use std::time::Instant;

/// The lines of an answer. Each has its own deadline, and is on its way when it is written.
#[derive(Debug)]
pub struct Lines<'a> {
    stream: &'a TcpStream,
    /// When the last one was written; none before the headers are.
    last: Mutex<Option<Instant>>,
}

impl<'a> Lines<'a> {
    /// Lines into a stream, of which nothing is written yet.
    pub fn new(stream: &'a TcpStream) -> Self {
        let last = Mutex::default();
        Self { stream, last }
    }

    /// Writes a refusal in their place.
    pub fn refuse(&self, refused: Refusal) -> Result<()> {
        answer::refusal(&mut self.out(), refused, true)
    }

    /// Writes the headers that lines follow.
    pub fn begin(&self) -> Result<()> {
        let last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        answer::lines(&mut self.out())?;
        written(last)
    }

    /// Writes a line.
    pub fn line(&self, mut line: String) -> Result<()> {
        line.push('\n');
        let last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        self.write(line.as_bytes())?;
        written(last)
    }

    /// Writes an empty line as a sign of life where the last one is long ago; nothing where one is just being written.
    pub fn sign_of_life(&self) -> Result<()> {
        let last = match self.last.try_lock() {
            Ok(last) => last,
            Err(TryLockError::Poisoned(poisoned)) => poisoned.into_inner(),
            Err(TryLockError::WouldBlock) => return Ok(()),
        };
        match last.is_some_and(|last| last.elapsed() >= HEARTBEAT) {
            true => {
                self.write(b"\n")?;
                written(last)
            }
            false => Ok(()),
        }
    }

    fn write(&self, bytes: &[u8]) -> Result<()> {
        let mut out = self.out();
        out.write_all(bytes)?;
        out.flush()
    }

    fn out(&self) -> Deadline<'a> {
        Deadline::after(self.stream, TO_RECEIVE_LINE)
    }
}

fn written(mut last: MutexGuard<'_, Option<Instant>>) -> Result<()> {
    *last = Some(Instant::now());
    Ok(())
}
