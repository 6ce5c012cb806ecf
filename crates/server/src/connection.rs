//! One connection, from request to answer. Each serves one request, so that no client holds a thread for longer than its deadlines.

use crate::answer::{self, LINES, Refusal};
use crate::connections::{Place, Turns};
use crate::deadline::{Deadline, HEARTBEAT, LONG, LOOK, SHORT};
use crate::names::Names;
use crate::request::{self, Request, RequestKind};
use crate::service::{NoListener, Service};
use crate::site::{Site, SiteAnswer};
use platewash_workcell::cancel::CancelToken;
use std::io::{ErrorKind, Read, Result, Write};
use std::net::{Shutdown, TcpStream};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError, TryLockError};
use std::thread::{Builder, scope};
use std::time::{Duration, Instant};

/// Amount of further data from a client that is read before its connection is closed \[bytes\], and the time for it. A connection
/// that is closed at once makes the system send a reset in place of the answer.
const LINGER_BYTES: usize = 64 << 10;
const LINGER: Duration = Duration::from_millis(500);

/// State that all connections of a server share.
#[derive(Debug)]
pub struct ServerState {
    /// The site that is served.
    pub site: Site,
    /// Names of the server that requests may use.
    pub names: Names,
    /// Limit on simultaneous work.
    pub turns: Turns,
}

/// Reads a request and answers it.
pub fn serve(stream: &TcpStream, served: &ServerState, place: &Place) {
    // A client that leaves before the end of the answer does not need it.
    let head = request::read_head(Deadline::after(stream, SHORT));
    place.set_answered(true);
    let _ = match head {
        Ok(None) => return,
        Ok(Some(head)) => answer(stream, served, place, &head),
        Err(refused) => refused.write(&mut Deadline::after(stream, LONG), true),
    };
    place.set_answered(false);
    close(stream);
}

fn answer(stream: &TcpStream, served: &ServerState, place: &Place, head: &[u8]) -> Result<()> {
    let (site, service) = (&served.site, served.site.service.as_deref());
    let request = match Request::judge(head, served.names, service) {
        Ok(request) => request,
        Err(refused) => return refused.write(&mut Deadline::after(stream, LONG), !head.starts_with(b"HEAD ")),
    };
    if let (RequestKind::Answer(question), Some(service)) = (request.kind, service) {
        let begun = head.get(request.head_bytes..).unwrap_or_default();
        // While it is being sent it may have to go for another one.
        place.set_answered(false);
        let body = request::read_question(Deadline::after(stream, SHORT), begun, question.length);
        place.set_answered(true);
        return match body {
            Ok(body) => {
                let turns = question.limits.is_work.then_some(&served.turns);
                answer_question(stream, service, turns, &request.path, &body)
            }
            Err(refused) => refused.write(&mut Deadline::after(stream, LONG), true),
        };
    }
    let wants_contents = request.kind == RequestKind::Contents;
    let found = site.find(&request);
    let mut out = Deadline::after(stream, LONG);
    match found {
        Err(refused) => refused.write(&mut out, wants_contents),
        Ok(SiteAnswer::Nothing) => answer::nothing(&mut out),
        Ok(SiteAnswer::Page(page)) => answer::page(&mut out, &page, wants_contents),
        Ok(SiteAnswer::NoPage(words)) => answer::no_page(&mut out, &words, wants_contents),
        Ok(SiteAnswer::Events(_)) if !wants_contents => answer::stream(&mut out, answer::EVENTS),
        Ok(SiteAnswer::Events(live)) => live.send(stream, request.last_event_id.as_deref()),
    }
}

/// Closes a connection so that the answer arrives, even if the client goes on sending.
fn close(stream: &TcpStream) {
    if stream.shutdown(Shutdown::Write).is_err() {
        return;
    }
    let mut rest = Deadline::after(stream, LINGER);
    let (mut buffer, mut read) = ([0; 4096], 0);
    while read < LINGER_BYTES {
        match rest.read(&mut buffer) {
            Ok(0) | Err(_) => return,
            Ok(more) => read += more,
        }
    }
}

/// Answers a question when its turn has come, while another thread looks whether the client is still there.
fn answer_question(
    stream: &TcpStream,
    service: &dyn Service,
    turns: Option<&Turns>,
    path: &str,
    body: &[u8],
) -> Result<()> {
    let lines = Lines::new(stream);
    scope(|scope| {
        let watcher = Builder::new().name("page client, watched".to_owned());
        if watcher.spawn_scoped(scope, || lines.watch()).is_err() {
            return Refusal::Full.write(&mut lines.out(), true);
        }
        // Ends the other thread even where the service panics.
        let _done = DoneOnDrop(&lines.is_done);
        let answered = answer_in_turn(service, turns, path, body, &lines);
        // The answer ends here, and not when the thread that watches has seen it.
        let _ = stream.shutdown(Shutdown::Write);
        answered
    })
}

fn answer_in_turn(
    service: &dyn Service,
    turns: Option<&Turns>,
    path: &str,
    body: &[u8],
    lines: &Lines<'_>,
) -> Result<()> {
    let gone = &lines.gone;
    let turn = turns.map(|turns| turns.wait(gone));
    if matches!(turn, Some(None)) {
        return match gone.is_cancelled() {
            true => Ok(()),
            false => Refusal::Busy.write(&mut lines.out(), true),
        };
    }
    lines.begin()?;
    let mut tell = |line| match gone.is_cancelled() || lines.line(line).is_err() {
        true => {
            gone.cancel();
            Err(NoListener)
        }
        false => Ok(()),
    };
    service.answer(path, body, &mut tell, gone);
    Ok(())
}

struct DoneOnDrop<'a>(&'a AtomicBool);

impl Drop for DoneOnDrop<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// The lines of an answer. Each has its own deadline, and is on its way when it is written.
struct Lines<'a> {
    stream: &'a TcpStream,
    /// Time at which the last one was written; `None` before the headers are.
    last: Mutex<Option<Instant>>,
    /// The client has left, or is too slow.
    gone: CancelToken,
    is_done: AtomicBool,
}

impl<'a> Lines<'a> {
    fn new(stream: &'a TcpStream) -> Self {
        Self {
            stream,
            last: Mutex::default(),
            gone: CancelToken::new(),
            is_done: AtomicBool::new(false),
        }
    }

    /// Writes the headers that lines follow.
    fn begin(&self) -> Result<()> {
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        answer::stream(&mut self.out(), LINES)?;
        *last = Some(Instant::now());
        Ok(())
    }

    /// Writes a line.
    fn line(&self, line: String) -> Result<()> {
        self.write(self.last.lock().unwrap_or_else(PoisonError::into_inner), line)
    }

    /// Writes an empty line as a sign of life where the last one is long ago; nothing where one is just being written.
    fn send_keep_alive(&self) -> Result<()> {
        let last = match self.last.try_lock() {
            Ok(last) => last,
            Err(TryLockError::Poisoned(poisoned)) => poisoned.into_inner(),
            Err(TryLockError::WouldBlock) => return Ok(()),
        };
        match last.is_some_and(|last| last.elapsed() >= HEARTBEAT) {
            true => self.write(last, String::new()),
            false => Ok(()),
        }
    }

    fn write(&self, mut last: MutexGuard<'_, Option<Instant>>, mut line: String) -> Result<()> {
        line.push('\n');
        let mut out = self.out();
        out.write_all(line.as_bytes())?;
        out.flush()?;
        *last = Some(Instant::now());
        Ok(())
    }

    fn out(&self) -> Deadline<'a> {
        Deadline::after(self.stream, SHORT)
    }

    /// Reads until the work is done, or the client is gone: it has closed its side, is cut off, sends on and on, or takes nothing any
    /// more. Gives signs of life meanwhile.
    fn watch(&self) {
        let (mut stream, mut buffer, mut read) = (self.stream, [0; 4096], 0);
        let waits = |kind| [ErrorKind::WouldBlock, ErrorKind::TimedOut, ErrorKind::Interrupted].contains(&kind);
        while !self.is_done.load(Ordering::Relaxed) {
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
            if !is_there || self.send_keep_alive().is_err() {
                return self.gone.cancel();
            }
        }
    }
}
