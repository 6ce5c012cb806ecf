//! Who is connected, and who has to go for another.

use super::limits::CONNECTIONS;
use std::collections::BTreeMap;
use std::net::{Shutdown, TcpStream};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

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
}

#[derive(Debug)]
struct Connected {
    stream: TcpStream,
    /// Whether it is being answered: others have not asked yet, or have their answer.
    is_answered: bool,
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
        if open.streams.len() >= CONNECTIONS {
            let idle = open.streams.iter().find(|(_, connected)| !connected.is_answered);
            let oldest = *idle?.0;
            // Its thread finds the connection closed and ends.
            close(open.streams.remove(&oldest)?);
        }
        let number = open.next;
        open.next += 1;
        let is_answered = false;
        open.streams.insert(number, Connected { stream, is_answered });
        Some(Place {
            connections: self.clone(),
            number,
        })
    }

    /// Closes all connections and waits until their threads have seen it, for so long at most.
    pub fn close(&self, patience: Duration) {
        let mut open = self.lock();
        for connected in open.streams.values() {
            let _ = connected.stream.shutdown(Shutdown::Both);
        }
        while !open.streams.is_empty() {
            let (now, waited) = self
                .left
                .wait_timeout(open, patience)
                .unwrap_or_else(PoisonError::into_inner);
            open = now;
            if waited.timed_out() {
                return;
            }
        }
    }

    fn lock(&self) -> MutexGuard<'_, Open> {
        self.open.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn close(connected: Connected) {
    // One that is closed already needs nothing.
    let _ = connected.stream.shutdown(Shutdown::Both);
}

impl Place {
    /// Notes whether it is being answered.
    pub fn is_answered(&self, is_answered: bool) {
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
