//! A stream with a deadline for all that is read and written, however slowly the other side goes.

use std::io::{ErrorKind, Read, Result, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

/// Longest time for a client to ask, to send its question, or to receive one line or event.
pub const SHORT: Duration = Duration::from_secs(5);

/// Longest time for a client to receive the page.
pub const LONG: Duration = Duration::from_secs(60);

/// Time to the next sign of life where there is no event to send.
pub const HEARTBEAT: Duration = Duration::from_secs(2);

/// Time between two checks that the waiting client gives up, or is gone.
pub const LOOK: Duration = Duration::from_millis(50);

/// A stream, to be used until a moment.
pub struct Deadline<'a> {
    stream: &'a TcpStream,
    until: Instant,
}

impl<'a> Deadline<'a> {
    /// A stream for some time from now on.
    pub fn after(stream: &'a TcpStream, time: Duration) -> Self {
        Self {
            stream,
            until: Instant::now() + time,
        }
    }

    fn left(&self) -> Result<Option<Duration>> {
        let left = self.until.saturating_duration_since(Instant::now());
        // The system takes no time of zero.
        match left.is_zero() {
            true => Err(ErrorKind::TimedOut.into()),
            false => Ok(Some(left)),
        }
    }
}

impl Read for Deadline<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize> {
        self.stream.set_read_timeout(self.left()?)?;
        self.stream.read(buffer)
    }
}

impl Write for Deadline<'_> {
    fn write(&mut self, bytes: &[u8]) -> Result<usize> {
        self.stream.set_write_timeout(self.left()?)?;
        self.stream.write(bytes)
    }

    fn flush(&mut self) -> Result<()> {
        self.stream.flush()
    }
}
