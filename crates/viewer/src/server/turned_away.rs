//! Clients for which there is no place.

use super::answer;
use super::limits::{LINGER, LINGER_BYTES, LOOK, TURNED_AWAY};
use super::refusal::Refusal;
use std::io::{ErrorKind, Read, Result};
use std::net::{Shutdown, TcpStream};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::thread::Builder;
use std::time::Instant;

/// Where clients are told that there is no place, without a thread for each and without waiting for any of them.
#[derive(Debug)]
pub struct Door(SyncSender<Leaving>);

/// A client that has been told.
#[derive(Debug)]
struct Leaving {
    stream: TcpStream,
    since: Instant,
    read: usize,
}

impl Door {
    /// Opens it; it is watched until this is dropped.
    ///
    /// # Errors
    /// The system gives no thread.
    pub fn open() -> Result<Self> {
        let (sender, receiver) = sync_channel(TURNED_AWAY);
        Builder::new()
            .name("page door".to_owned())
            .spawn(move || see_off(&receiver))?;
        Ok(Self(sender))
    }

    /// Tells a client that all places are taken. Where too many have been told just now, it is closed at once.
    pub fn turn_away(&self, mut stream: TcpStream) {
        // The little that is said finds room in what the system holds for a new connection.
        let told = stream
            .set_nonblocking(true)
            .and_then(|()| answer::refusal(&mut stream, Refusal::Full, true))
            .and_then(|()| stream.shutdown(Shutdown::Write));
        if told.is_ok() {
            let (since, read) = (Instant::now(), 0);
            let _ = self.0.try_send(Leaving { stream, since, read });
        }
    }
}

/// Reads what clients go on sending until they have seen what they were told, so that the system does not tell them of a reset instead.
fn see_off(receiver: &Receiver<Leaving>) {
    let mut all: Vec<Leaving> = Vec::new();
    loop {
        let next = match all.is_empty() {
            true => receiver.recv().map_err(|_| RecvTimeoutError::Disconnected),
            false => receiver.recv_timeout(LOOK),
        };
        match next {
            Ok(leaving) => {
                if all.len() >= TURNED_AWAY {
                    all.remove(0);
                }
                all.push(leaving);
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return,
        }
        all.retain_mut(Leaving::is_there);
    }
}

impl Leaving {
    /// Whether it is still there, and may be.
    fn is_there(&mut self) -> bool {
        let mut buffer = [0; 4096];
        while self.read <= LINGER_BYTES && self.since.elapsed() < LINGER {
            match self.stream.read(&mut buffer) {
                Ok(0) => return false,
                Ok(more) => self.read += more,
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return error.kind() == ErrorKind::WouldBlock,
            }
        }
        false
    }
}
