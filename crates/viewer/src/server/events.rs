//! A live run as server-sent events.

use super::answer;
use super::deadline::Deadline;
use super::limits::{HEARTBEAT, TO_RECEIVE_EVENTS};
use super::live::{Follower, News, Row};
use serde::Serialize;
use std::fmt::Display;
use std::io::{Result, Write};
use std::net::TcpStream;

/// Time after which a page that has lost the connection comes again \[ms\].
const RETRY_MS: u32 = 500;

#[derive(Serialize)]
struct State {
    state: super::live::LiveState,
}

#[derive(Serialize)]
struct Samples<'a> {
    samples: &'a [Row],
}

/// Sends a run from where the follower is to its end. Each event has its own deadline: a client that is too slow for one is left, comes
/// again, and is told what it missed.
pub fn send(stream: &TcpStream, follower: &mut Follower) -> Result<()> {
    let out = || Deadline::after(stream, TO_RECEIVE_EVENTS);
    answer::events(&mut out())?;
    write(&mut out(), format_args!("retry: {RETRY_MS}\n\n"))?;
    loop {
        match follower.news(HEARTBEAT) {
            News::State(state) => event(&mut out(), "state", None, &State { state })?,
            News::Samples(rows, last) => event(&mut out(), "samples", Some(last), &Samples { samples: &rows })?,
            // Whether the client is still there shows when it is written to.
            News::Silence => write(&mut out(), ":\n\n")?,
            News::Closed => return Ok(()),
            News::End(end) => {
                event(&mut out(), "done", None, &end)?;
                follower.knows_the_end();
                return Ok(());
            }
        }
    }
}

fn event(out: &mut impl Write, name: &str, id: Option<usize>, data: &impl Serialize) -> Result<()> {
    let id = id.map_or_else(String::new, |id| format!("id: {id}\n"));
    // JSON has no line breaks of its own.
    let data = serde_json::to_string(data)?;
    write(out, format_args!("event: {name}\n{id}data: {data}\n\n"))
}

fn write(out: &mut impl Write, text: impl Display) -> Result<()> {
    out.write_all(text.to_string().as_bytes())?;
    out.flush()
}
