//! A request, judged.

use super::headers::Headers;
use super::limits::HEADERS;
use super::names::Names;
use super::question::Question;
use super::refusal::Refusal;
use super::service::Service;
use httparse::{EMPTY_HEADER, Error, Status};

/// A request that may be answered.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Request {
    /// What it is to get.
    pub wants: Wants,
    /// From `/` to `?`.
    pub path: String,
    /// Behind `?`.
    pub query: Option<String>,
    /// The last event that a client who connects again has received.
    pub last_event_id: Option<String>,
    /// Length of its head \[bytes\].
    pub head_bytes: usize,
}

/// What a request is to get.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wants {
    /// What is here.
    Contents,
    /// The headers of that alone.
    Headers,
    /// The answer to a question, which follows.
    Answer(Question),
}

impl Request {
    /// Judges the head of a request to a server of these names, where somebody may answer questions.
    pub fn judge(head: &[u8], names: Names, service: Option<&dyn Service>) -> Result<Self, Refusal> {
        let mut headers = [EMPTY_HEADER; HEADERS];
        let mut parsed = httparse::Request::new(&mut headers);
        let head_bytes = match parsed.parse(head) {
            Ok(Status::Complete(bytes)) => bytes,
            Ok(Status::Partial) => return Err(Refusal::Garbled),
            Err(Error::TooManyHeaders) => return Err(Refusal::TooLong),
            Err(Error::Version) => return Err(Refusal::Version),
            Err(_) => return Err(Refusal::Garbled),
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
        // The whole of another server's address is what a proxy is asked for.
        let target = parsed.path.filter(|path| path.starts_with('/'));
        let (path, query) = target.map_or((None, None), parted);
        let asked = service.and_then(|service| Some((service, service.knows(path?)?)));
        let wants = match (parsed.method, asked) {
            (Some("POST"), Some((service, asked))) => {
                Wants::Answer(Question::judge(&headers, host, asked, service.token())?)
            }
            (_, Some(_)) => return Err(Refusal::QuestionMethod),
            (Some("GET"), None) => Wants::Contents,
            (Some("HEAD"), None) => Wants::Headers,
            _ => return Err(Refusal::Method),
        };
        if asked.is_none() && headers.announce_contents()? {
            return Err(Refusal::Contents);
        }
        Ok(Self {
            wants,
            path: path.ok_or(Refusal::Garbled)?.to_owned(),
            query: query.map(ToOwned::to_owned),
            last_event_id: headers.one("last-event-id")?.map(ToOwned::to_owned),
            head_bytes,
        })
    }
}

/// Path and query.
fn parted(target: &str) -> (Option<&str>, Option<&str>) {
    target
        .split_once('?')
        .map_or((Some(target), None), |(path, query)| (Some(path), Some(query)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn judged(head: &str) -> Result<Request, Refusal> {
        Request::judge(head.as_bytes(), Names::of("127.0.0.1:8080".parse().unwrap()), None)
    }

    /// A request with a proper Host and more headers, a line each.
    fn with(first: &str, headers: &str) -> Result<Request, Refusal> {
        judged(&format!("{first}\r\nHost: localhost:8080\r\n{headers}\r\n"))
    }

    #[test]
    fn a_request_is_its_path_and_what_it_missed() {
        let asked = with("GET /events?run=7 HTTP/1.1", "last-event-id: 41\r\nAccept: */*\r\n").unwrap();
        let expected = Request {
            wants: Wants::Contents,
            path: "/events".to_owned(),
            query: Some("run=7".to_owned()),
            last_event_id: Some("41".to_owned()),
            head_bytes: 84,
        };
        assert_eq!(asked, expected);
        let asked = with("HEAD / HTTP/1.0", "").unwrap();
        assert!(asked.wants == Wants::Headers && asked.query.is_none());
    }

    #[test]
    fn what_follows_a_head_is_no_part_of_it() {
        let alone = with("GET / HTTP/1.1", "").unwrap();
        let host = "\r\nHost: localhost:8080\r\n\r\n";
        let followed = judged(&format!("GET / HTTP/1.1{host}more\r\n\r\n")).unwrap();
        assert_eq!(
            (followed.head_bytes, &followed),
            ("GET / HTTP/1.1".len() + host.len(), &alone)
        );
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
