//! Answers: the page, events, lines, and refusals.

use std::fmt::Write as _;
use std::io::{Result, Write};

/// Content security policy of the page: it may use its own text, pictures that it draws itself, and events from here; nobody
/// frames it.
const POLICY: &str = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; connect-src 'self'; \
     base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// A page.
pub const HTML: &str = "text/html; charset=utf-8";
/// Server-sent events.
pub const EVENTS: &str = "text/event-stream; charset=utf-8";
/// JSON Lines.
pub const LINES: &str = "application/x-ndjson; charset=utf-8";
/// Type of answers in plain text.
const TEXT: &str = "text/plain; charset=utf-8";

/// Reason that a request is refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Refusal {
    /// The request is no HTTP, or repeats a header that may stand only once.
    Garbled,
    /// The request names a host that is not this server: a page elsewhere may have had its name changed to this machine's
    /// address.
    ForeignHost,
    /// A page of another origin asks.
    ForeignOrigin,
    /// There is nothing at this path.
    NotFound,
    /// Neither GET nor HEAD.
    Method,
    /// Something else than POST, where questions are answered.
    QuestionMethod,
    /// The request carries contents.
    Contents,
    /// A question in another form than JSON.
    Form,
    /// A question that does not say how long it is, or comes in pieces.
    NoLength,
    /// A question that is too long.
    LongQuestion,
    /// A question without the token of this server: its page was loaded from another one.
    ForeignToken,
    /// The request did not come in time.
    Late,
    /// The first line or the headers of the request are too long or too many.
    TooLong,
    /// The request has another version of HTTP than 1.0 and 1.1.
    Version,
    /// The greatest number of pages follows the run already.
    Followed,
    /// The greatest number of questions is under work already.
    Busy,
    /// The greatest number of clients is being answered already.
    Full,
}

impl Refusal {
    /// Status, and advice for a person who sees it.
    fn parts(self) -> (&'static str, &'static str) {
        const OPEN: &str = "403 Forbidden";
        const FULL: &str = "503 Service Unavailable";
        match self {
            Self::Garbled => (
                "400 Bad Request",
                "this is not an HTTP/1.1 request with exactly one Host header",
            ),
            Self::ForeignHost => (
                OPEN,
                "this server answers to its own address and port alone: open the address that the command has printed",
            ),
            Self::ForeignOrigin => (
                OPEN,
                "pages of other origins are not answered: open the address that the command has printed",
            ),
            Self::ForeignToken => (
                OPEN,
                "the page does not have the token of this server: open the address that platewash edit printed",
            ),
            Self::NotFound => ("404 Not Found", "there is one page here: /"),
            Self::Method => ("405 Method Not Allowed", "GET and HEAD are answered, nothing else"),
            Self::QuestionMethod => (
                "405 Method Not Allowed",
                "questions of the page are answered here: POST, nothing else",
            ),
            Self::Late => ("408 Request Timeout", "the request did not come in time"),
            Self::NoLength => (
                "411 Length Required",
                "a question states its length, once, and comes in one piece: Content-Length, and no Transfer-Encoding",
            ),
            Self::Contents => ("413 Content Too Large", "a request has no contents here"),
            Self::LongQuestion => ("413 Content Too Large", "the question is too long"),
            Self::Form => (
                "415 Unsupported Media Type",
                "a question is JSON: Content-Type: application/json",
            ),
            Self::TooLong => ("431 Request Header Fields Too Large", "the request's head is too long"),
            Self::Followed => (FULL, "as many pages follow the run as can: close one"),
            Self::Busy => (FULL, "as much is being worked on as can be: ask again"),
            Self::Full => (FULL, "as many are being answered as can be: ask again"),
            Self::Version => (
                "505 HTTP Version Not Supported",
                "HTTP/1.0 and HTTP/1.1 are spoken, nothing else",
            ),
        }
    }

    /// A header that goes with it.
    fn header(self) -> &'static str {
        match self {
            Self::Method => "Allow: GET, HEAD\r\n",
            Self::QuestionMethod => "Allow: POST\r\n",
            // In so many seconds.
            Self::Busy | Self::Full => "Retry-After: 1\r\n",
            _ => "",
        }
    }

    /// Writes it; its headers alone where only they are asked for.
    pub fn write(self, out: &mut impl Write, wants_contents: bool) -> Result<()> {
        let (status, words) = self.parts();
        let head = format!("{status}\r\nContent-Type: {TEXT}\r\n{}", self.header());
        write_response(out, &head, Some(&format!("{words}\n")), wants_contents)
    }
}

/// Writes the page; its headers alone where only they are asked for.
pub fn page(out: &mut impl Write, page: &str, wants_contents: bool) -> Result<()> {
    let head = format!("200 OK\r\nContent-Type: {HTML}\r\n");
    write_response(out, &head, Some(page), wants_contents)
}

/// Writes that there is nothing to show; a follower of events does not ask again.
pub fn nothing(out: &mut impl Write) -> Result<()> {
    write_response(out, "204 No Content\r\n", None, false)
}

/// Writes that there is no page, and why.
pub fn no_page(out: &mut impl Write, words: &str, wants_contents: bool) -> Result<()> {
    let words = format!("the page cannot be made: {words}\n");
    let head = format!("500 Internal Server Error\r\nContent-Type: {TEXT}\r\n");
    write_response(out, &head, Some(&words), wants_contents)
}

/// Writes the headers that [`EVENTS`] or [`LINES`] follow.
pub fn stream(out: &mut impl Write, media_type: &str) -> Result<()> {
    write_response(out, &format!("200 OK\r\nContent-Type: {media_type}\r\n"), None, false)
}

/// Writes status and headers, the empty line behind them, and the contents where they are wanted.
fn write_response(out: &mut impl Write, head: &str, contents: Option<&str>, wants_contents: bool) -> Result<()> {
    let mut text = format!(
        "HTTP/1.1 {head}Connection: close\r\nCache-Control: no-store\r\nContent-Security-Policy: {POLICY}\r\n\
         Cross-Origin-Opener-Policy: same-origin\r\nCross-Origin-Resource-Policy: same-origin\r\nReferrer-Policy: no-referrer\r\n\
         X-Content-Type-Options: nosniff\r\nX-Frame-Options: DENY\r\n"
    );
    if let Some(contents) = contents {
        // Writing into a string does not fail.
        let _ = write!(text, "Content-Length: {}\r\n", contents.len());
    }
    text.push_str("\r\n");
    out.write_all(text.as_bytes())?;
    if let Some(contents) = contents.filter(|_| wants_contents) {
        out.write_all(contents.as_bytes())?;
    }
    out.flush()
}
