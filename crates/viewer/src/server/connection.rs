//! One connection, from request to answer. Each serves one request, so that no client holds a thread for longer than its deadlines.

use super::connections::{Place, Stage};
use super::deadline::Deadline;
use super::limits::{LINGER, LINGER_BYTES, TO_ASK, TO_RECEIVE};
use super::names::Names;
use super::questions::{self, Come};
use super::refusal::Refusal;
use super::request::{Request, Wants};
use super::site::{Found, Site};
use super::work::Work;
use super::{answer, events, head};
use std::io::{Read, Result};
use std::net::{Shutdown, TcpStream};

/// What all connections of a server share.
#[derive(Debug)]
pub struct Served {
    /// What is served.
    pub site: Site,
    /// By which names.
    pub names: Names,
    /// Whose turn it is where there is work to do.
    pub work: Work,
}

/// Reads a request and answers it.
pub fn serve(stream: &TcpStream, served: &Served, place: &Place) {
    let head = match head::read(Deadline::after(stream, TO_ASK)) {
        Ok(None) => return,
        Ok(Some(head)) => Ok(head),
        Err(refusal) => Err(refusal),
    };
    // Whoever leaves before the end of the answer has no use for it.
    let _ = match head {
        Ok(head) => answer(stream, served, place, &head),
        Err(refused) => refuse(stream, place, refused, true),
    };
    place.is_at(Stage::Leaving);
    close(stream);
}

fn answer(stream: &TcpStream, served: &Served, place: &Place, head: &[u8]) -> Result<()> {
    let (site, service) = (&served.site, served.site.service.as_deref());
    let request = match Request::judge(head, served.names, service) {
        Ok(request) => request,
        Err(refused) => return refuse(stream, place, refused, !head.starts_with(b"HEAD ")),
    };
    if let (Wants::Answer(question), Some(service)) = (request.wants, service) {
        let (path, begun) = (
            request.path.as_str(),
            head.get(request.head_bytes..).unwrap_or_default(),
        );
        let come = Come { path, question, begun };
        return questions::answer(stream, service, &served.work, place, &come);
    }
    let wants_contents = request.wants == Wants::Contents;
    place.is_at(Stage::Answered);
    let found = site.find(&request);
    let mut out = Deadline::after(stream, TO_RECEIVE);
    match found {
        Err(refused) => answer::refusal(&mut out, refused, wants_contents),
        Ok(Found::Nothing) => answer::nothing(&mut out),
        Ok(Found::Page(page)) => answer::page(&mut out, &page, wants_contents),
        Ok(Found::NoPage(words)) => answer::no_page(&mut out, &words, wants_contents),
        Ok(Found::Events(_)) if !wants_contents => answer::events(&mut out),
        Ok(Found::Events(live)) => match live.follow(request.last_event_id.as_deref()) {
            Some(mut follower) => events::send(stream, &mut follower),
            None => answer::refusal(&mut out, Refusal::Followed, wants_contents),
        },
    }
}

fn refuse(stream: &TcpStream, place: &Place, refused: Refusal, wants_contents: bool) -> Result<()> {
    place.is_at(Stage::Answered);
    answer::refusal(&mut Deadline::after(stream, TO_RECEIVE), refused, wants_contents)
}

/// Closes a connection so that the answer arrives, whatever else the client goes on sending.
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
