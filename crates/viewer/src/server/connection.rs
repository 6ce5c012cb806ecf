//! One connection, from request to answer. Each serves one request, so that no client holds a thread for longer than its deadlines.

use super::connections::Place;
use super::deadline::Deadline;
use super::limits::{LINGER, LINGER_BYTES, TO_ASK, TO_RECEIVE};
use super::names::Names;
use super::refusal::Refusal;
use super::request::Request;
use super::site::{Found, Site};
use super::{answer, events, head};
use std::io::{Read, Result};
use std::net::{Shutdown, TcpStream};

/// Reads a request and answers it.
pub fn serve(stream: &TcpStream, site: &Site, names: Names, place: &Place) {
    let head = match head::read(Deadline::after(stream, TO_ASK)) {
        Ok(None) => return,
        Ok(Some(head)) => Ok(head),
        Err(refusal) => Err(refusal),
    };
    place.is_answered(true);
    // Whoever leaves before the end of the answer has no use for it.
    let _ = answer(stream, site, names, head);
    place.is_answered(false);
    close(stream);
}

fn answer(stream: &TcpStream, site: &Site, names: Names, head: std::result::Result<Vec<u8>, Refusal>) -> Result<()> {
    let wants_contents = !head.as_ref().is_ok_and(|head| head.starts_with(b"HEAD "));
    let request = head.and_then(|head| Request::judge(&head, names));
    let found = request.and_then(|request| Ok((site.find(&request)?, request)));
    let mut out = Deadline::after(stream, TO_RECEIVE);
    match found {
        Err(refusal) => answer::refusal(&mut out, refusal, wants_contents),
        Ok((Found::Nothing, _)) => answer::nothing(&mut out),
        Ok((Found::Page(page), _)) => answer::page(&mut out, page, wants_contents),
        Ok((Found::Events(_), _)) if !wants_contents => answer::events(&mut out),
        Ok((Found::Events(live), request)) => match live.follow(request.last_event_id.as_deref()) {
            Some(mut follower) => events::send(stream, &mut follower),
            None => answer::refusal(&mut out, Refusal::Busy, wants_contents),
        },
    }
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
