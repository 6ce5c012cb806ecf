//! A request: its head, who may ask, and the question that may follow it.

use crate::answer::Refusal;
use crate::names::Names;
use crate::service::{QuestionLimits, Service};
use crate::token::is_token;
use httparse::{EMPTY_HEADER, Error, Header, Status};
use std::io::{ErrorKind, Read};

/// Longest head of a request \[bytes\]: its first line and all headers.
const HEAD_BYTES: usize = 16 << 10;

/// Most headers of a request.
const HEADERS: usize = 64;

/// Number of bytes that are read at a time. Memory is allocated for the bytes that come, not for an announced length.
const CHUNK: usize = 4096;

/// The header that carries the token. A page of another origin cannot send it without a preflight request, which is refused.
const TOKEN: &str = "x-platewash-token";

/// A request that may be answered.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Request {
    /// Kind of answer that is asked for.
    pub kind: RequestKind,
    /// From `/` to `?`.
    pub path: String,
    /// Behind `?`.
    pub query: Option<String>,
    /// The last event that a client who connects again has received.
    pub last_event_id: Option<String>,
    /// Length of its head \[bytes\].
    pub head_bytes: usize,
}

/// Kind of answer that a request asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RequestKind {
    /// Headers and contents.
    Contents,
    /// The headers alone.
    Headers,
    /// The answer to a question, which follows.
    Answer(Question),
}

/// A question that may be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Question {
    /// Its kind.
    pub limits: QuestionLimits,
    /// Its length \[bytes\].
    pub length: usize,
}

/// Reads the head of a request, up to the first empty line, and the bytes that came with it; `None` where the client left without
/// a word.
pub fn read_head(mut source: impl Read) -> Result<Option<Vec<u8>>, Refusal> {
    let mut head = Vec::new();
    let mut chunk = [0; CHUNK];
    loop {
        let room = CHUNK.min(HEAD_BYTES - head.len());
        match source.read(&mut chunk[..room]) {
            Ok(0) if head.is_empty() => return Ok(None),
            Ok(0) => return Err(Refusal::Garbled),
            Ok(read) => {
                // The empty line may have begun in the bytes read before.
                let from = head.len().saturating_sub(3);
                head.extend_from_slice(&chunk[..read]);
                let bytes = &head[from..];
                if bytes.windows(2).any(|w| w == b"\n\n") || bytes.windows(3).any(|w| w == b"\n\r\n") {
                    return Ok(Some(head));
                }
                if head.len() >= HEAD_BYTES {
                    return Err(Refusal::TooLong);
                }
            }
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            // Browsers connect before they have a request: an empty one needs no answer.
            Err(_) if head.is_empty() => return Ok(None),
            Err(_) => return Err(Refusal::Late),
        }
    }
}

/// Reads a question of `length` bytes, of which some may have come with the head. Bytes behind it are left.
pub fn read_question(mut source: impl Read, with_head: &[u8], length: usize) -> Result<Vec<u8>, Refusal> {
    let mut body = with_head[..with_head.len().min(length)].to_vec();
    let mut chunk = [0; CHUNK];
    while body.len() < length {
        let room = CHUNK.min(length - body.len());
        match source.read(&mut chunk[..room]) {
            Ok(0) => return Err(Refusal::Garbled),
            Ok(read) => body.extend_from_slice(&chunk[..read]),
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(_) => return Err(Refusal::Late),
        }
    }
    Ok(body)
}

impl Request {
    /// Judges the head of a request to a server of these names, where a service may answer questions.
    pub fn judge(head: &[u8], names: Names, service: Option<&dyn Service>) -> Result<Self, Refusal> {
        let mut headers = [EMPTY_HEADER; HEADERS];
        let mut parsed = httparse::Request::new(&mut headers);
        let head_bytes = match parsed.parse(head) {
            Ok(Status::Complete(bytes)) => bytes,
            Err(Error::TooManyHeaders) => return Err(Refusal::TooLong),
            Err(Error::Version) => return Err(Refusal::Version),
            Ok(Status::Partial) | Err(_) => return Err(Refusal::Garbled),
        };
        let headers = Headers(parsed.headers);
        let host = headers.one("host")?.ok_or(Refusal::Garbled)?;
        if !names.is_host(host) {
            return Err(Refusal::ForeignHost);
        }
        let origin = headers.one("origin")?;
        let is_foreign = headers.are_of_a_foreign_page()? && !headers.are_of_a_link()?;
        if origin.is_some_and(|origin| !names.is_origin(origin)) || is_foreign {
            return Err(Refusal::ForeignOrigin);
        }
        // A proxy would be asked for the whole address of another server.
        let target = parsed.path.filter(|path| path.starts_with('/'));
        let (path, query) = target.map_or((None, None), |target| match target.split_once('?') {
            Some((path, query)) => (Some(path), Some(query)),
            None => (Some(target), None),
        });
        let asked = service.and_then(|service| Some((service, service.knows(path?)?)));
        let wants = match (parsed.method, asked) {
            (Some("POST"), Some((service, asked))) => {
                RequestKind::Answer(Question::judge(&headers, host, asked, service.token())?)
            }
            (_, Some(_)) => return Err(Refusal::QuestionMethod),
            (Some("GET"), None) => RequestKind::Contents,
            (Some("HEAD"), None) => RequestKind::Headers,
            _ => return Err(Refusal::Method),
        };
        let length = headers.one("content-length")?.filter(|length| length.trim() != "0");
        if asked.is_none() && (length.is_some() || headers.one("transfer-encoding")?.is_some()) {
            return Err(Refusal::Contents);
        }
        Ok(Self {
            kind: wants,
            path: path.ok_or(Refusal::Garbled)?.to_owned(),
            query: query.map(ToOwned::to_owned),
            last_event_id: headers.one("last-event-id")?.map(ToOwned::to_owned),
            head_bytes,
        })
    }
}

/// The headers of a request.
struct Headers<'a>(&'a [Header<'a>]);

impl<'a> Headers<'a> {
    /// A header that can be stated once.
    fn one(&self, name: &str) -> Result<Option<&'a str>, Refusal> {
        let mut stated = self.0.iter().filter(|header| header.name.eq_ignore_ascii_case(name));
        match (stated.next(), stated.next()) {
            (None, _) => Ok(None),
            (Some(header), None) => std::str::from_utf8(header.value)
                .map(Some)
                .map_err(|_| Refusal::Garbled),
            (Some(_), Some(_)) => Err(Refusal::Garbled),
        }
    }

    /// Checks for a request from a page of another site, as browsers state of their own accord.
    fn are_of_a_foreign_page(&self) -> Result<bool, Refusal> {
        let site = self.one("sec-fetch-site")?;
        Ok(site.is_some_and(|site| !["same-origin", "none"].contains(&site)))
    }

    /// Checks for a link that is followed: the person who follows it sees the page, and the other site does not.
    fn are_of_a_link(&self) -> Result<bool, Refusal> {
        Ok(self.one("sec-fetch-mode")? == Some("navigate") && self.one("sec-fetch-dest")? == Some("document"))
    }
}

impl Question {
    /// Judges the headers of a question that came to `host`, one of this server's names.
    fn judge(headers: &Headers<'_>, host: &str, limits: QuestionLimits, token: &str) -> Result<Self, Refusal> {
        // Only a page that was loaded from here under the very name that it asks: browsers state the origin of each POST.
        let origin = headers.one("origin")?.and_then(|origin| origin.strip_prefix("http://"));
        let is_own = origin.is_some_and(|origin| origin.eq_ignore_ascii_case(host));
        if !is_own || headers.are_of_a_foreign_page()? {
            return Err(Refusal::ForeignOrigin);
        }
        // A form of another page cannot send this type.
        let media_type = headers.one("content-type")?.unwrap_or_default();
        let kind = media_type.split(';').next().unwrap_or_default();
        if !kind.trim().eq_ignore_ascii_case("application/json") {
            return Err(Refusal::Form);
        }
        if !headers.one(TOKEN)?.is_some_and(|sent| is_token(sent, token)) {
            return Err(Refusal::ForeignToken);
        }
        let stated = headers.one("content-length")?;
        let (Some(stated), None) = (stated, headers.one("transfer-encoding")?) else {
            return Err(Refusal::NoLength);
        };
        if stated.is_empty() || !stated.bytes().all(|b| b.is_ascii_digit()) {
            return Err(Refusal::Garbled);
        }
        match stated.parse() {
            Ok(length) if length <= limits.most_bytes => Ok(Self { limits, length }),
            _ => Err(Refusal::LongQuestion),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn judged(head: &str) -> Result<Request, Refusal> {
        Request::judge(head.as_bytes(), Names::new("127.0.0.1:8080".parse().unwrap()), None)
    }

    /// A request with a proper Host and more headers, a line each.
    fn with(first: &str, headers: &str) -> Result<Request, Refusal> {
        judged(&format!("{first}\r\nHost: localhost:8080\r\n{headers}\r\n"))
    }

    #[test]
    fn reads_path_and_last_event_of_a_request() {
        let asked = with("GET /events?run=7 HTTP/1.1", "last-event-id: 41\r\nAccept: */*\r\n").unwrap();
        let expected = Request {
            kind: RequestKind::Contents,
            path: "/events".to_owned(),
            query: Some("run=7".to_owned()),
            last_event_id: Some("41".to_owned()),
            head_bytes: 84,
        };
        assert_eq!(asked, expected);
        let asked = with("HEAD / HTTP/1.0", "").unwrap();
        assert!(asked.kind == RequestKind::Headers && asked.query.is_none());
    }

    #[test]
    fn ignores_bytes_behind_the_headers() {
        let alone = with("GET / HTTP/1.1", "").unwrap();
        let host = "\r\nHost: localhost:8080\r\n\r\n";
        let followed = judged(&format!("GET / HTTP/1.1{host}more\r\n\r\n")).unwrap();
        assert_eq!(
            (followed.head_bytes, &followed),
            ("GET / HTTP/1.1".len() + host.len(), &alone)
        );
    }

    #[test]
    fn rejects_invalid_requests() {
        let many = "a: b\r\n".repeat(HEADERS);
        let cases = [
            (judged("\r\n\r\n"), Refusal::Garbled),
            (judged("GET / HTTP/1.1\r\n\r\n"), Refusal::Garbled),
            (judged("GET / HTTP/1.0\r\n\r\n"), Refusal::Garbled),
            (judged("GET /\r\n\r\n"), Refusal::Garbled),
            (judged("\u{16}\u{3}\u{1}\n\n"), Refusal::Garbled),
            (with("GET / HTTP/2.0", ""), Refusal::Version),
            (with("GET / HTTP/1.1", &many), Refusal::TooLong),
            (with("GET / HTTP/1.1", "Host: localhost:8080\r\n"), Refusal::Garbled),
            (with("GET http://localhost:8080/ HTTP/1.1", ""), Refusal::Garbled),
            (with("GET * HTTP/1.1", ""), Refusal::Garbled),
            (with("POST / HTTP/1.1", ""), Refusal::Method),
            (with("get / HTTP/1.1", ""), Refusal::Method),
            (with("CONNECT localhost:8080 HTTP/1.1", ""), Refusal::Method),
            (with("GET / HTTP/1.1", "Content-Length: 1\r\n"), Refusal::Contents),
            (with("GET / HTTP/1.1", "Content-Length: -1\r\n"), Refusal::Contents),
            (
                with("GET / HTTP/1.1", "Transfer-Encoding: chunked\r\n"),
                Refusal::Contents,
            ),
        ];
        for (n, (answer, expected)) in cases.into_iter().enumerate() {
            assert_eq!(answer, Err(expected), "case {n}");
        }
        assert!(with("GET / HTTP/1.1", "Content-Length: 0\r\n").is_ok());
    }

    #[test]
    fn foreign_hosts_and_pages_are_refused_before_anything_else() {
        let foreign = judged("POST /nowhere HTTP/1.1\r\nHost: evil.example\r\n\r\n");
        assert_eq!(foreign, Err(Refusal::ForeignHost));
        for headers in [
            "Origin: http://evil.example\r\n",
            "Origin: null\r\n",
            "Origin: http://localhost:3000\r\n",
            "Sec-Fetch-Site: cross-site\r\n",
            "Sec-Fetch-Site: same-site\r\nSec-Fetch-Mode: no-cors\r\nSec-Fetch-Dest: image\r\n",
            "Sec-Fetch-Site: cross-site\r\nSec-Fetch-Mode: navigate\r\nSec-Fetch-Dest: iframe\r\n",
        ] {
            assert_eq!(
                with("GET / HTTP/1.1", headers),
                Err(Refusal::ForeignOrigin),
                "{headers}"
            );
        }
        for headers in [
            "Origin: http://localhost:8080\r\nSec-Fetch-Site: same-origin\r\n",
            "Sec-Fetch-Site: none\r\nSec-Fetch-Mode: navigate\r\nSec-Fetch-Dest: document\r\n",
            "Sec-Fetch-Site: cross-site\r\nSec-Fetch-Mode: navigate\r\nSec-Fetch-Dest: document\r\n",
        ] {
            assert!(with("GET / HTTP/1.1", headers).is_ok(), "{headers}");
        }
    }

    /// A source that gives so many bytes at a time, and then no more, or an error.
    struct SlowSource<'a>(&'a [u8], usize, Option<ErrorKind>);

    impl Read for SlowSource<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
            let step = self.1.min(buffer.len()).min(self.0.len());
            let (now, later) = self.0.split_at(step);
            buffer[..step].copy_from_slice(now);
            self.0 = later;
            match (step, self.2) {
                (0, Some(kind)) => Err(std::io::Error::from(kind)),
                _ => Ok(step),
            }
        }
    }

    #[test]
    fn reads_a_question_of_the_announced_length_in_any_pieces() {
        let text: Vec<u8> = (0..=255).cycle().take(3 * CHUNK + 7).collect();
        for with_head in [0, 1, CHUNK, text.len()] {
            for step in [1000, CHUNK, text.len()] {
                let source = SlowSource(&text[with_head..], step, None);
                let read = read_question(source, &text[..with_head], text.len());
                assert!(read.as_ref() == Ok(&text), "{with_head} {step}");
            }
        }
    }

    #[test]
    fn leaves_bytes_behind_a_question_unread() {
        let mut source = SlowSource(b"defGET / HTTP/1.1", 100, None);
        assert_eq!(read_question(&mut source, b"abc", 6), Ok(b"abcdef".to_vec()));
        assert_eq!(source.0, b"GET / HTTP/1.1");
        assert_eq!(read_question(&mut source, b"abcGET /", 3), Ok(b"abc".to_vec()));
        assert_eq!(source.0, b"GET / HTTP/1.1");
        assert_eq!(read_question(&mut source, b"", 0), Ok(Vec::new()));
    }

    #[test]
    fn rejects_a_question_that_ends_early_and_times_out_one_that_stops() {
        assert_eq!(read_question(SlowSource(b"ab", 1, None), b"", 3), Err(Refusal::Garbled));
        for kind in [ErrorKind::WouldBlock, ErrorKind::TimedOut, ErrorKind::ConnectionReset] {
            assert_eq!(
                read_question(SlowSource(b"ab", 1, Some(kind)), b"", 3),
                Err(Refusal::Late)
            );
        }
    }

    #[test]
    fn headers_end_with_an_empty_line_in_any_pieces() {
        for text in ["GET / HTTP/1.1\r\nHost: a\r\n\r\n", "GET / HTTP/1.0\nHost: a\n\n"] {
            for step in 1..=text.len() {
                assert_eq!(
                    read_head(SlowSource(text.as_bytes(), step, None)),
                    Ok(Some(text.into())),
                    "{step}"
                );
            }
        }
    }

    #[test]
    fn rejects_cut_requests_and_accepts_an_empty_connection() {
        assert_eq!(read_head(&b""[..]), Ok(None));
        assert_eq!(read_head(&b"GET / HTTP/1.1\r\nHo"[..]), Err(Refusal::Garbled));
    }

    #[test]
    fn reads_endless_headers_up_to_the_bound() {
        let endless = vec![b'a'; HEAD_BYTES + 1];
        for step in [1, 1000, CHUNK] {
            let mut source = SlowSource(&endless, step, None);
            assert_eq!(read_head(&mut source), Err(Refusal::TooLong));
            assert_eq!(source.0.len(), 1);
        }
    }

    const HOST: &str = "localhost:8080";
    const ASKED: QuestionLimits = QuestionLimits {
        is_work: false,
        most_bytes: 100,
    };
    const GOOD: [(&str, &str); 4] = [
        ("Origin", "http://localhost:8080"),
        ("Content-Type", "application/json"),
        ("X-Platewash-Token", "secret"),
        ("Content-Length", "100"),
    ];

    fn judged_question(headers: &[(&str, &str)], limits: QuestionLimits) -> Result<Question, Refusal> {
        let header = |&(name, value): &(&'static str, &'static str)| Header {
            name,
            value: value.as_bytes(),
        };
        // The tests' headers are constants; those of requests live as long as their head.
        let leaked: Vec<(&'static str, &'static str)> = headers
            .iter()
            .map(|(name, value)| (&*name.to_string().leak(), &*value.to_string().leak()))
            .collect();
        let headers: Vec<_> = leaked.iter().map(header).collect();
        Question::judge(&Headers(&headers), HOST, limits, "secret")
    }

    /// The good headers with one of them stated so, or not at all.
    fn with_header(name: &str, value: Option<&str>) -> Result<Question, Refusal> {
        let mut headers: Vec<_> = GOOD.iter().copied().filter(|header| header.0 != name).collect();
        headers.extend(value.map(|value| (name, value)));
        judged_question(&headers, ASKED)
    }

    #[test]
    fn a_question_of_the_page_may_be_read() {
        let (limits, length) = (ASKED, 100);
        assert_eq!(judged_question(&GOOD, ASKED), Ok(Question { limits, length }));
        for kind in [
            "Application/JSON",
            "application/json; charset=utf-8",
            "application/json ;x",
        ] {
            assert!(with_header("Content-Type", Some(kind)).is_ok(), "{kind}");
        }
        for site in ["same-origin", "none"] {
            assert!(with_header("Sec-Fetch-Site", Some(site)).is_ok(), "{site}");
        }
        assert_eq!(with_header("Content-Length", Some("0")).unwrap().length, 0);
        assert!(with_header("Origin", Some("http://LOCALHOST:8080")).is_ok());
    }

    #[test]
    fn each_required_header_is_checked() {
        let long = "9".repeat(40);
        let cases = [
            ("Origin", None, Refusal::ForeignOrigin),
            ("Origin", Some("null"), Refusal::ForeignOrigin),
            ("Origin", Some("https://localhost:8080"), Refusal::ForeignOrigin),
            // Another name of this server is another origin.
            ("Origin", Some("http://127.0.0.1:8080"), Refusal::ForeignOrigin),
            ("Origin", Some("http://localhost:8080/"), Refusal::ForeignOrigin),
            ("Sec-Fetch-Site", Some("cross-site"), Refusal::ForeignOrigin),
            ("Sec-Fetch-Site", Some("same-site"), Refusal::ForeignOrigin),
            ("Content-Type", None, Refusal::Form),
            ("Content-Type", Some("text/plain"), Refusal::Form),
            ("Content-Type", Some("text/plain;application/json"), Refusal::Form),
            ("Content-Type", Some("application/jsonp"), Refusal::Form),
            ("X-Platewash-Token", None, Refusal::ForeignToken),
            ("X-Platewash-Token", Some(""), Refusal::ForeignToken),
            ("X-Platewash-Token", Some("secre"), Refusal::ForeignToken),
            ("X-Platewash-Token", Some("secrex"), Refusal::ForeignToken),
            ("Content-Length", None, Refusal::NoLength),
            ("Transfer-Encoding", Some("chunked"), Refusal::NoLength),
            ("Content-Length", Some("101"), Refusal::LongQuestion),
            ("Content-Length", Some(&long), Refusal::LongQuestion),
            ("Content-Length", Some(""), Refusal::Garbled),
            ("Content-Length", Some("-1"), Refusal::Garbled),
            ("Content-Length", Some("+1"), Refusal::Garbled),
            ("Content-Length", Some("1, 1"), Refusal::Garbled),
            ("Content-Length", Some("0x10"), Refusal::Garbled),
        ];
        for (name, value, expected) in cases {
            assert_eq!(with_header(name, value), Err(expected), "{name}: {value:?}");
        }
        for header in GOOD {
            let twice: Vec<_> = GOOD.into_iter().chain([header]).collect();
            assert_eq!(judged_question(&twice, ASKED), Err(Refusal::Garbled), "{header:?}");
        }
    }

    #[test]
    fn a_link_to_a_question_is_foreign_too() {
        let navigation = [
            ("Sec-Fetch-Site", "cross-site"),
            ("Sec-Fetch-Mode", "navigate"),
            ("Sec-Fetch-Dest", "document"),
        ];
        let headers: Vec<_> = GOOD.into_iter().chain(navigation).collect();
        assert_eq!(judged_question(&headers, ASKED), Err(Refusal::ForeignOrigin));
    }

    #[test]
    fn every_question_needs_the_token() {
        let without: Vec<_> = GOOD
            .into_iter()
            .filter(|header| header.0 != "X-Platewash-Token")
            .collect();
        assert_eq!(judged_question(&without, ASKED), Err(Refusal::ForeignToken));
    }
}
