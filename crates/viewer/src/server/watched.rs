//! Work for a client, and a look at whether it is still there.

use super::limits::{LINGER_BYTES, LOOK};
use super::lines::Lines;
use platewash_workcell::cancel::CancelToken;
use std::io::{ErrorKind, Read, Result};
use std::net::TcpStream;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{Builder, scope};

/// Does some work while another thread reads what the client sends: it has nothing to say, so that its leaving is what comes. `gone` is
/// cancelled then. The same thread gives signs of life.
///
/// # Errors
/// The system gives no thread; nothing is done.
pub fn watched(stream: &TcpStream, lines: &Lines, gone: &CancelToken, work: impl FnOnce()) -> Result<()> {
    let is_done = AtomicBool::new(false);
    scope(|scope| {
        let watcher = Builder::new().name("page client, watched".to_owned());
        watcher.spawn_scoped(scope, || watch(stream, lines, gone, &is_done))?;
        // Ends the other thread even where the work panics.
        let _done = Done(&is_done);
        work();
        Ok(())
    })
}

struct Done<'a>(&'a AtomicBool);

impl Drop for Done<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// Reads until the work is done, or the client is gone: it has closed its side, is cut off, sends on and on, or takes nothing any more.
fn watch(mut stream: &TcpStream, lines: &Lines, gone: &CancelToken, is_done: &AtomicBool) {
    let (mut buffer, mut read) = ([0; 4096], 0);
    let waits = |kind| [ErrorKind::WouldBlock, ErrorKind::TimedOut, ErrorKind::Interrupted].contains(&kind);
    while !is_done.load(Ordering::Relaxed) {
        let seen = stream
            .set_read_timeout(Some(LOOK))
            .and_then(|()| stream.read(&mut buffer));
        let is_there = match seen {
            Ok(0) => false,
            Ok(more) => {
                read += more;
                read <= LINGER_BYTES
            }
            Err(error) => waits(error.kind()),
        };
        if !is_there || lines.sign_of_life().is_err() {
            return gone.cancel();
        }
    }
}
