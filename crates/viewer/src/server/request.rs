//! A request, judged.

use super::limits::HEADERS;
use super::names::Names;
use super::refusal::Refusal;
use httparse::{EMPTY_HEADER, Error, Header, Status};

/// A request that may be answered.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Request {
    /// Whether the answer's contents are asked for, and not its headers alone.
    pub wants_contents: bool,
    /// From `/` to `?`.
    pub path: String,
    /// Behind `?`.
    pub query: Option<String>,
    /// The last event that a client who connects again has received.
    pub last_event_id: Option<String>,
}

impl Request {
    /// Judges the head of a request to a server of these names.
    pub fn judge(head: &[u8], names: Names) -> Result<Self, Refusal> {
        let mut headers = [EMPTY_HEADER; HEADERS];
        let mut parsed = httparse::Request::new(&mut headers);
        match parsed.parse(head) {
            Ok(Status::Complete(_)) => {}
            Ok(Status::Partial) => return Err(Refusal::Garbled),
            Err(Error::TooManyHeaders) => return Err(Refusal::TooLong),
            Err(Error::Version) => return Err(Refusal::Version),
            Err(_) => return Err(Refusal::Garbled),
        }
        let headers = Headers(parsed.headers);
        let host = headers.one("host")?.ok_or(Refusal::Garbled)?;
        if !names.is_host(host) {
            return Err(Refusal::ForeignHost);
        }
        let origin = headers.one("origin")?;
        if origin.is_some_and(|origin| !names.is_origin(origin)) || headers.are_of_a_foreign_page()? {
            return Err(Refusal::ForeignOrigin);
        }
        let wants_contents = match parsed.method {
            Some("GET") => true,
            Some("HEAD") => false,
            _ => return Err(Refusal::Method),
        };
        if headers.announce_contents()? {
            return Err(Refusal::Contents);
        }
        // The whole of another server's address is what a proxy is asked for.
        let target = parsed
            .path
            .filter(|path| path.starts_with('/'))
            .ok_or(Refusal::Garbled)?;
        let (path, query) = target
            .split_once('?')
            .map_or((target, None), |(path, query)| (path, Some(query)));
        Ok(Self {
            wants_contents,
            path: path.to_owned(),
            query: query.map(ToOwned::to_owned),
            last_event_id: headers.one("last-event-id")?.map(ToOwned::to_owned),
        })
    }
}

struct Headers<'a>(&'a [Header<'a>]);

impl<'a> Headers<'a> {
    /// A header that can be stated once.
    fn one(&self, name: &str) -> Result<Option<&'a str>, Refusal> {
        let mut stated = self.0.iter().filter(|header| header.name.eq_ignore_ascii_case(name));
        let (first, second) = (stated.next(), stated.next());
        match (first, second) {
            (None, _) => Ok(None),
            (Some(header), None) => std::str::from_utf8(header.value)
                .map(Some)
                .map_err(|_| Refusal::Garbled),
            (Some(_), Some(_)) => Err(Refusal::Garbled),
        }
    }

    /// Whether a page of another site asks for something to put into itself, as browsers say of their own accord. A link to here is
    /// followed: who follows it sees the page, and the other site does not.
    fn are_of_a_foreign_page(&self) -> Result<bool, Refusal> {
        let site = self.one("sec-fetch-site")?;
        let is_followed =
            self.one("sec-fetch-mode")? == Some("navigate") && self.one("sec-fetch-dest")? == Some("document");
        Ok(site.is_some_and(|site| !["same-origin", "none"].contains(&site)) && !is_followed)
    }

    fn announce_contents(&self) -> Result<bool, Refusal> {
        let length = self.one("content-length")?;
        Ok(self.one("transfer-encoding")?.is_some() || length.is_some_and(|length| length.trim() != "0"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn judged(head: &str) -> Result<Request, Refusal> {
        Request::judge(head.as_bytes(), Names::of("127.0.0.1:8080".parse().unwrap()))
    }

    /// A request with a proper Host and more headers, a line each.
    fn with(first: &str, headers: &str) -> Result<Request, Refusal> {
        judged(&format!("{first}\r\nHost: localhost:8080\r\n{headers}\r\n"))
    }

    #[test]
    fn a_request_is_its_path_and_what_it_missed() {
        let asked = with("GET /events?run=7 HTTP/1.1", "last-event-id: 41\r\nAccept: */*\r\n").unwrap();
        let expected = Request {
            wants_contents: true,
            path: "/events".to_owned(),
            query: Some("run=7".to_owned()),
            last_event_id: Some("41".to_owned()),
        };
        assert_eq!(asked, expected);
        let asked = with("HEAD / HTTP/1.0", "").unwrap();
        assert!(!asked.wants_contents && asked.query.is_none());
    }

    #[test]
    fn what_is_no_request_is_refused() {
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
}
