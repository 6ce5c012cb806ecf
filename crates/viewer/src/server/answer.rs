//! What is answered.

use super::refusal::Refusal;
use std::fmt::Write as _;
use std::io::{Result, Write};

/// What a page may do and load: what stands in it, pictures that it draws itself, and events from here; nobody frames it.
const POLICY: &str = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; connect-src 'self'; \
     base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Words are text, whatever is in them.
const TEXT: (&str, &str) = ("Content-Type", "text/plain; charset=utf-8");

/// Writes the page; its headers alone where only they are asked for.
pub fn page(out: &mut impl Write, page: &str, wants_contents: bool) -> Result<()> {
    let head = head(
        "200 OK",
        &[("Content-Type", "text/html; charset=utf-8")],
        Some(page.len()),
    );
    whole(out, &head, page, wants_contents)
}

/// Writes that there is nothing to show; a follower of events does not ask again.
pub fn nothing(out: &mut impl Write) -> Result<()> {
    whole(out, &head("204 No Content", &[], None), "", false)
}

/// Writes a refusal.
pub fn refusal(out: &mut impl Write, refusal: Refusal, wants_contents: bool) -> Result<()> {
    let words = format!("{}\n", refusal.words());
    let headers = [&[TEXT], refusal.headers()].concat();
    whole(
        out,
        &head(refusal.status(), &headers, Some(words.len())),
        &words,
        wants_contents,
    )
}

/// Writes that there is no page, and why.
pub fn no_page(out: &mut impl Write, words: &str, wants_contents: bool) -> Result<()> {
    let words = format!("the page cannot be made: {words}\n");
    let head = head("500 Internal Server Error", &[TEXT], Some(words.len()));
    whole(out, &head, &words, wants_contents)
}

/// Writes the headers that events follow.
pub fn events(out: &mut impl Write) -> Result<()> {
    let head = head("200 OK", &[("Content-Type", "text/event-stream; charset=utf-8")], None);
    whole(out, &head, "", false)
}

/// Writes the headers that the lines of an answer follow.
pub fn lines(out: &mut impl Write) -> Result<()> {
    let head = head(
        "200 OK",
        &[("Content-Type", "application/x-ndjson; charset=utf-8")],
        None,
    );
    whole(out, &head, "", false)
}

fn whole(out: &mut impl Write, head: &str, contents: &str, wants_contents: bool) -> Result<()> {
    out.write_all(head.as_bytes())?;
    if wants_contents {
        out.write_all(contents.as_bytes())?;
    }
    out.flush()
}

/// Status and headers, with the empty line behind them.
fn head(status: &str, headers: &[(&str, &str)], length: Option<usize>) -> String {
    let mut text = format!("HTTP/1.1 {status}\r\n");
    let always = [
        ("Connection", "close"),
        ("Cache-Control", "no-store"),
        ("Content-Security-Policy", POLICY),
        ("Cross-Origin-Opener-Policy", "same-origin"),
        ("Cross-Origin-Resource-Policy", "same-origin"),
        ("Referrer-Policy", "no-referrer"),
        ("X-Content-Type-Options", "nosniff"),
        ("X-Frame-Options", "DENY"),
    ];
    for (name, value) in headers.iter().chain(&always) {
        // Writing into a string does not fail.
        let _ = write!(text, "{name}: {value}\r\n");
    }
    if let Some(length) = length {
        let _ = write!(text, "Content-Length: {length}\r\n");
    }
    text.push_str("\r\n");
    text
}
