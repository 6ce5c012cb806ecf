//! Who is connected, and who has to go for another.

use super::limits::{CONNECTIONS, QUESTIONS};
use std::collections::BTreeMap;
use std::net::{Shutdown, TcpStream};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// All connections, oldest first.
#[derive(Debug, Default)]
pub struct Connections {
    open: Mutex<Open>,
    left: Condvar,
}

#[derive(Debug, Default)]
struct Open {
    streams: BTreeMap<u64, Connected>,
    next: u64,
    /// Nobody comes in any more.
    is_closed: bool,
}

#[derive(Debug)]
struct Connected {
    stream: TcpStream,
    stage: Stage,
}

/// How far a connection has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// It has not asked yet.
    Asking,
    /// It sends a question.
    Telling,
    /// It is being answered, or waits for that.
    Answered,
    /// It has its answer.
    Leaving,
}

/// A place among the connections, until it is dropped.
#[derive(Debug)]
pub struct Place {
    connections: Arc<Connections>,
    number: u64,
}

impl Connections {
    /// A place for one more. Where there is none, the oldest one that is not being answered has to go; where all are, there is none.
    pub fn enter(self: &Arc<Self>, stream: &TcpStream) -> Option<Place> {
        let stream = stream.try_clone().ok()?;
        let mut open = self.lock();
        if open.is_closed {
            return None;
        }
        if open.streams.len() >= CONNECTIONS {
            open.push_out(|stage| stage != Stage::Answered)?;
        }
        let number = open.next;
        open.next += 1;
        let stage = Stage::Asking;
        open.streams.insert(number, Connected { stream, stage });
        Some(Place {
            connections: self.clone(),
            number,
        })
    }

    /// Closes all connections and waits until their threads have seen it, for so long at most.
    pub fn close(&self, patience: Duration) {
        let end = Instant::now() + patience;
        let mut open = self.lock();
        open.is_closed = true;
        for connected in open.streams.values() {
            let _ = connected.stream.shutdown(Shutdown::Both);
        }
        while !open.streams.is_empty() {
            let left = end.saturating_duration_since(Instant::now());
            if left.is_zero() {
                return;
            }
            let woken = self.left.wait_timeout(open, left);
            open = woken.unwrap_or_else(PoisonError::into_inner).0;
        }
    }

    fn lock(&self) -> MutexGuard<'_, Open> {
        self.open.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Open {
    /// Closes the oldest connection of such a stage: its thread finds it closed and ends. None where there is none.
    fn push_out(&mut self, of: impl Fn(Stage) -> bool) -> Option<()> {
        let oldest = *self.streams.iter().find(|(_, connected)| of(connected.stage))?.0;
        let connected = self.streams.remove(&oldest)?;
        // One that is closed already needs nothing.
        let _ = connected.stream.shutdown(Shutdown::Both);
        Some(())
    }
}

impl Place {
    /// Notes how far it has come. Where too many send a question, the oldest of them has to go.
    pub fn is_at(&self, stage: Stage) {
        let mut open = self.connections.lock();
        let is_alike = |connected: &&Connected| connected.stage == stage;
        if stage == Stage::Telling && open.streams.values().filter(is_alike).count() >= QUESTIONS {
            open.push_out(|other| other == stage);
        }
        if let Some(connected) = open.streams.get_mut(&self.number) {
            connected.stage = stage;
        }
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        self.connections.lock().streams.remove(&self.number);
        self.connections.left.notify_all();
    }
}
