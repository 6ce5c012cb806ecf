//! Who is connected, who has to go for another, and how much is worked on at a time.

use crate::deadline::LOOK;
use platewash_workcell::cancel::CancelToken;
use std::collections::BTreeMap;
use std::net::{Shutdown, TcpStream};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Most connections at a time.
const CONNECTIONS: usize = 64;

/// Most questions that are being worked on at a time.
const WORK: usize = 2;

/// Longest time that a question waits for its turn.
const TO_WAIT: Duration = Duration::from_secs(10);

/// All connections, oldest first.
#[derive(Debug, Default)]
pub struct Connections {
    open: Mutex<OpenConnections>,
    left: Condvar,
}

#[derive(Debug, Default)]
struct OpenConnections {
    streams: BTreeMap<u64, OpenConnection>,
    next: u64,
    /// Nobody comes in any more.
    is_closed: bool,
}

#[derive(Debug)]
struct OpenConnection {
    stream: TcpStream,
    is_answered: bool,
}

/// A place among the connections, until it is dropped.
#[derive(Debug)]
pub struct Place {
    connections: Arc<Connections>,
    number: u64,
}

impl Connections {
    /// Makes a place for one more connection. Where there is none, the oldest one that is not being answered is closed; where all
    /// are being answered, it returns `None`.
    pub fn enter(self: &Arc<Self>, stream: &TcpStream) -> Option<Place> {
        let stream = stream.try_clone().ok()?;
        let mut open = self.lock();
        if open.is_closed {
            return None;
        }
        if open.streams.len() >= CONNECTIONS {
            let oldest = *open.streams.iter().find(|(_, connected)| !connected.is_answered)?.0;
            // The thread of the closed connection notices and ends. A connection that is closed already needs no action.
            let _ = open.streams.remove(&oldest)?.stream.shutdown(Shutdown::Both);
        }
        let number = open.next;
        open.next += 1;
        let is_answered = false;
        open.streams.insert(number, OpenConnection { stream, is_answered });
        let connections = self.clone();
        Some(Place { connections, number })
    }

    /// Closes all connections and waits until their threads have seen it, for so long at most.
    pub fn close(&self, patience: Duration) {
        let mut open = self.lock();
        open.is_closed = true;
        for connected in open.streams.values() {
            let _ = connected.stream.shutdown(Shutdown::Both);
        }
        let waits = |open: &mut OpenConnections| !open.streams.is_empty();
        drop(self.left.wait_timeout_while(open, patience, waits));
    }

    fn lock(&self) -> MutexGuard<'_, OpenConnections> {
        self.open.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Place {
    /// Notes whether it is being answered: then it need not go for another one.
    pub fn set_answered(&self, is_answered: bool) {
        if let Some(connected) = self.connections.lock().streams.get_mut(&self.number) {
            connected.is_answered = is_answered;
        }
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        self.connections.lock().streams.remove(&self.number);
        self.connections.left.notify_all();
    }
}

/// Limit on simultaneous long work.
#[derive(Debug, Default)]
pub struct Turns {
    running: Mutex<usize>,
    freed: Condvar,
}

/// A turn, until it is dropped.
#[derive(Debug)]
pub struct Turn<'a>(&'a Turns);

impl Turns {
    /// Waits for a turn, no longer than `gone` allows; `None` where none came in time.
    pub fn wait(&self, gone: &CancelToken) -> Option<Turn<'_>> {
        let begin = Instant::now();
        let mut running = self.lock();
        while *running >= WORK {
            if gone.is_cancelled() || begin.elapsed() >= TO_WAIT {
                return None;
            }
            let woken = self.freed.wait_timeout(running, LOOK);
            running = woken.unwrap_or_else(PoisonError::into_inner).0;
        }
        *running += 1;
        Some(Turn(self))
    }

    fn lock(&self) -> MutexGuard<'_, usize> {
        self.running.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Turn<'_> {
    fn drop(&mut self) {
        *self.0.lock() -= 1;
        self.0.freed.notify_one();
    }
}
