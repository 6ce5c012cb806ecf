//! The server as its clients meet it, good ones and others, over TCP.

use crate::toy::PATIENCE;
use crate::wire::{is, read_until};
use platewash_server::{Listener, LiveEnd, LiveRun, Page, Server, ServerError, Site};
use std::io::{ErrorKind, Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::sync::Arc;

const PAGE: &str = "<!doctype html><title>page</title>";

struct TestServer {
    server: Option<Server>,
    address: SocketAddr,
}

fn serve(live: Option<Arc<LiveRun>>) -> TestServer {
    serve_page(PAGE, live)
}

fn serve_page(page: &str, live: Option<Arc<LiveRun>>) -> TestServer {
    let listener = Listener::bind("127.0.0.1:0".parse().unwrap()).unwrap();
    let url = listener.url();
    let address = url.strip_prefix("http://").unwrap().strip_suffix('/').unwrap();
    let page = Page::Fixed(page.to_owned());
    let site = Site {
        live,
        ..Site::from_page(page)
    };
    TestServer {
        server: Some(listener.serve(site).unwrap()),
        address: address.parse().unwrap(),
    }
}

impl TestServer {
    fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(self.address).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        stream
    }

    /// Sends bytes; all that comes back until the connection is closed.
    fn send(&self, bytes: impl AsRef<[u8]>) -> String {
        let mut stream = self.connect();
        // It may be answered, and closed, half-way.
        let _ = stream.write_all(bytes.as_ref());
        rest(stream)
    }

    /// A request with a proper Host and more headers, a line each.
    fn ask(&self, line: &str, headers: &str) -> String {
        self.send(format!("{line}\r\nHost: {}\r\n{headers}\r\n", self.address))
    }

    fn get(&self, path: &str) -> String {
        self.ask(&format!("GET {path} HTTP/1.1"), "")
    }
}

fn rest(mut stream: TcpStream) -> String {
    let mut bytes = Vec::new();
    match stream.read_to_end(&mut bytes) {
        Ok(_) => {}
        Err(error) => assert_eq!(error.kind(), ErrorKind::ConnectionReset, "{error}"),
    }
    String::from_utf8(bytes).unwrap()
}

fn body(answer: &str) -> &str {
    answer.split_once("\r\n\r\n").unwrap().1
}

#[test]
fn serves_the_page_with_restrictive_headers() {
    let served = serve(None);
    for path in ["/", "/?t=3"] {
        let answer = served.get(path);
        is(&answer, "200");
        assert_eq!(body(&answer), PAGE);
        for header in [
            "Content-Type: text/html; charset=utf-8",
            "Content-Length: 34",
            "Connection: close",
            "Cache-Control: no-store",
            "Content-Security-Policy: default-src 'none'; ",
            "frame-ancestors 'none'",
            "X-Content-Type-Options: nosniff",
            "X-Frame-Options: DENY",
            "Cross-Origin-Resource-Policy: same-origin",
        ] {
            assert!(answer.contains(header), "{header}: {answer}");
        }
        assert!(!answer.contains("Access-Control"), "{answer}");
    }
}

#[test]
fn head_requests_get_headers_alone() {
    let served = serve(None);
    let (whole, head) = (served.get("/"), served.ask("HEAD / HTTP/1.1", ""));
    assert_eq!(head, whole.strip_suffix(PAGE).unwrap());
    let refused = served.ask("HEAD /nowhere HTTP/1.1", "");
    is(&refused, "404");
    assert_eq!(body(&refused), "");
}

#[test]
fn the_old_protocol_and_kept_connections_are_answered_and_closed() {
    let served = serve(None);
    is(&served.ask("GET / HTTP/1.0", ""), "200");
    let kept = served.ask("GET / HTTP/1.1", "Connection: keep-alive\r\n");
    assert!(kept.contains("Connection: close") && kept.ends_with(PAGE));
    let both = format!("GET / HTTP/1.1\r\nHost: {}\r\n\r\n", served.address).repeat(2);
    assert_eq!(served.send(both).matches("HTTP/1.1 ").count(), 1);
}

#[test]
fn serves_no_other_paths() {
    let served = serve(None);
    is(&served.get("/favicon.ico"), "204");
    for path in [
        "/events",
        "/index.html",
        "/etc/passwd",
        "/../../../../etc/passwd",
        "/..%2f..%2fetc%2fpasswd",
        "/%2e%2e/%2e%2e/etc/passwd",
        "/\\..\\..\\windows\\win.ini",
        "//",
        "/./",
        "/%00",
        "/#",
        "//evil.example/",
    ] {
        is(&served.get(path), "404");
    }
}

#[test]
fn only_reading_is_allowed() {
    let served = serve(None);
    for method in ["POST", "PUT", "DELETE", "OPTIONS", "TRACE", "PATCH", "BREW"] {
        let answer = served.ask(&format!("{method} / HTTP/1.1"), "");
        is(&answer, "405");
        assert!(answer.contains("Allow: GET, HEAD\r\n"), "{answer}");
    }
    let contents = "a".repeat(1 << 20);
    let posted = served.ask(
        "POST / HTTP/1.1",
        &format!("Content-Length: {}\r\n\r\n{contents}", 1 << 20),
    );
    is(&posted, "405");
    is(
        &served.ask("GET / HTTP/1.1", "Content-Length: 10\r\n\r\n0123456789"),
        "413",
    );
}

#[test]
fn foreign_hosts_and_origins_are_refused() {
    let served = serve(None);
    let port = served.address.port();
    let hosts = [
        ("evil.example".to_owned(), "403"),
        (format!("evil.example:{port}"), "403"),
        (format!("127.0.0.1.evil.example:{port}"), "403"),
        (format!("localhost:{}", port ^ 1), "403"),
        ("localhost".to_owned(), "403"),
        (format!("localhost:{port}"), "200"),
        (format!("[::1]:{port}"), "200"),
    ];
    for (host, status) in hosts {
        is(&served.send(format!("GET / HTTP/1.1\r\nHost: {host}\r\n\r\n")), status);
    }
    is(&served.send("GET / HTTP/1.1\r\n\r\n"), "400");
    let origins = [
        ("http://evil.example".to_owned(), "403"),
        ("null".to_owned(), "403"),
        (format!("https://localhost:{port}"), "403"),
        (format!("http://localhost:{port}"), "200"),
    ];
    for (origin, status) in origins {
        is(&served.ask("GET / HTTP/1.1", &format!("Origin: {origin}\r\n")), status);
    }
    is(&served.ask("GET / HTTP/1.1", "Sec-Fetch-Site: cross-site\r\n"), "403");
}

#[test]
fn refuses_garbage_and_serves_the_next_request() {
    let served = serve(None);
    let binary: Vec<u8> = (0..=255).cycle().take(5000).collect();
    let mut cases: Vec<(Vec<u8>, &str)> = vec![
        (b"hello\r\n\r\n".into(), "400"),
        (b"\r\n\r\n".into(), "400"),
        (b"\n\n".into(), "400"),
        (b"GET\r\n\r\n".into(), "400"),
        (b"GET / HTTP/9.9\r\nHost: a\r\n\r\n".into(), "505"),
        (b"GET / HTTP/1.1\r\nHost: \xff\xfe\r\n\r\n".into(), "400"),
        (b"GET / HTTP/1.1\r\nHo st: a\r\n\r\n".into(), "400"),
        (b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03\n\n".into(), "400"),
        (format!("GET /{} HTTP/1.1\r\n", "a".repeat(1 << 20)).into(), "431"),
        (
            format!("GET / HTTP/1.1\r\n{}", "a: b\r\n".repeat(1 << 16)).into(),
            "431",
        ),
        (
            format!("GET / HTTP/1.1\r\nCookie: {}", "a".repeat(1 << 20)).into(),
            "431",
        ),
    ];
    cases.push(([&b"GET /\0 HTTP/1.1\r\n"[..], &binary, b"\r\n\r\n"].concat(), "400"));
    for (bytes, status) in cases {
        is(&served.send(&bytes), status);
        is(&served.get("/"), "200");
    }
}

/// Clients that connect and say nothing, or not enough, have to go for one that asks.
#[test]
fn idle_clients_lock_nobody_out() {
    let served = serve(None);
    let idle: Vec<_> = (0..300)
        .map(|n| {
            let mut stream = served.connect();
            stream.write_all(&b"GET / HT"[..n % 9]).unwrap();
            stream
        })
        .collect();
    is(&served.get("/"), "200");
    drop(idle);
    is(&served.get("/"), "200");
}

/// A client that takes its page slowly, or not at all, holds up neither others nor the end.
#[test]
fn a_stuck_client_delays_nobody() {
    let page = "a".repeat(32 << 20);
    let mut served = serve_page(&page, None);
    let request = format!("GET / HTTP/1.1\r\nHost: {}\r\n\r\n", served.address);
    let stuck: Vec<_> = (0..5)
        .map(|_| {
            let mut stream = served.connect();
            stream.write_all(request.as_bytes()).unwrap();
            read_until(&mut stream, "\r\n\r\n");
            stream
        })
        .collect();
    is(&served.ask("HEAD / HTTP/1.1", ""), "200");
    drop(served.server.take());
    for mut stream in stuck {
        let mut received = Vec::new();
        let _ = stream.read_to_end(&mut received);
        assert!(received.len() < page.len(), "it was cut off");
    }
}

#[test]
fn the_port_is_free_again_when_the_server_has_ended() {
    let mut served = serve(None);
    let silent = served.connect();
    let taken = Listener::bind(served.address).unwrap_err();
    assert!(matches!(taken, ServerError::Bind { address, .. } if address == served.address));
    assert!(taken.to_string().contains(&served.address.to_string()), "{taken}");
    drop(served.server.take());
    assert_eq!(rest(silent), "");
    assert!(Listener::bind(served.address).is_ok());
}

fn end() -> LiveEnd {
    LiveEnd {
        headline: "WASHED </script>\n\u{2028}".to_owned(),
        washed: None,
    }
}

/// Events as name, id and data.
fn events(text: &str) -> Vec<(String, Option<usize>, serde_json::Value)> {
    let blocks = text.split("\n\n").filter(|block| block.starts_with("event: "));
    let field = |block: &str, name: &str| block.lines().find_map(|line| Some(line.strip_prefix(name)?.to_owned()));
    blocks
        .map(|block| {
            (
                field(block, "event: ").unwrap(),
                field(block, "id: ").map(|id| id.parse().unwrap()),
                serde_json::from_str(&field(block, "data: ").unwrap()).unwrap(),
            )
        })
        .collect()
}

#[test]
fn streams_a_run_and_sends_all_of_it_to_late_clients() {
    let live = LiveRun::new("a1");
    let served = serve(Some(live.clone()));
    let mut early = served.connect();
    let request = format!("GET {} HTTP/1.1\r\nHost: {}\r\n\r\n", live.events(), served.address);
    early.write_all(request.as_bytes()).unwrap();
    let head = read_until(&mut early, "\r\n\r\n");
    is(&head, "200");
    assert!(head.contains("Content-Type: text/event-stream"), "{head}");
    read_until(&mut early, "retry: 500\n\n");
    assert_eq!(
        read_until(&mut early, "\n\n"),
        "event: state\ndata: {\"state\":\"waiting\"}\n\n"
    );
    live.begin();
    read_until(&mut early, "{\"state\":\"running\"}\n\n");
    let row: [f64; 20] = std::array::from_fn(|n| n as f64 / 3.0);
    live.push(row);
    let first = events(&read_until(&mut early, "\n\n"));
    let rows = serde_json::json!({ "samples": [row] });
    assert_eq!(first, [("samples".to_owned(), Some(0), rows.clone())]);
    live.finish(end());
    let last = events(&rest(early));
    let names = |events: &[(String, Option<usize>, serde_json::Value)]| {
        events.iter().map(|(name, ..)| name.clone()).collect::<Vec<_>>()
    };
    assert_eq!(names(&last), ["state", "done"]);
    assert_eq!(
        last[1].2,
        serde_json::json!({"headline": "WASHED </script>\n\u{2028}", "washed": null})
    );
    let late = events(&served.get("/events"));
    assert_eq!(names(&late), ["samples", "state", "done"]);
    assert_eq!((late[0].1, &late[0].2), (Some(0), &rows));
}

#[test]
fn sends_missed_events_after_a_reconnection() {
    let live = LiveRun::new("a1");
    let served = serve(Some(live.clone()));
    live.begin();
    (0..10).for_each(|n| live.push([f64::from(n); 20]));
    let mut dropped = served.connect();
    let request = format!("GET /events HTTP/1.1\r\nHost: {}\r\n\r\n", served.address);
    dropped.write_all(request.as_bytes()).unwrap();
    read_until(&mut dropped, "id: 9\n");
    drop(dropped);
    (10..15).for_each(|n| live.push([f64::from(n); 20]));
    live.finish(end());
    let missed = events(&served.ask("GET /events HTTP/1.1", "Last-Event-ID: 9\r\n"));
    assert_eq!(missed[0].1, Some(14));
    let rows = missed[0].2["samples"].as_array().unwrap();
    assert_eq!((rows.len(), &rows[0][0]), (5, &serde_json::json!(10.0)));
    assert_eq!(missed.len(), 3);
}

#[test]
fn sends_the_rest_in_parts_to_late_clients() {
    const ROWS: usize = 1003;
    let live = LiveRun::new("a1");
    let served = serve(Some(live.clone()));
    live.begin();
    (0..ROWS).for_each(|n| live.push([n as f64; 20]));
    live.finish(end());
    for (last, first) in [
        ("0", 1),
        ("700", 701),
        ("x", 0),
        ("-1", 0),
        ("1002", ROWS),
        ("1003", ROWS),
        ("18446744073709551615", ROWS),
    ] {
        let told = events(&served.ask("GET /events HTTP/1.1", &format!("Last-Event-ID: {last}\r\n")));
        let names: Vec<_> = told.iter().map(|(name, ..)| name.as_str()).collect();
        let parts = told.len() - 2;
        assert_eq!(names[parts..], ["state", "done"], "{last}");
        let mut next = first;
        for (name, id, data) in &told[..parts] {
            let rows = data["samples"].as_array().unwrap();
            assert!(
                name == "samples" && rows.len() <= 500 && rows[0][0] == next as f64,
                "{last}"
            );
            next += rows.len();
            assert_eq!(*id, Some(next - 1));
        }
        assert_eq!(next, ROWS, "{last}");
    }
}

#[test]
fn tells_a_page_of_another_run_to_stop_asking() {
    let live = LiveRun::new("a1");
    let served = serve(Some(live));
    is(&served.get("/events?run=b2"), "204");
    is(&served.ask("HEAD /events HTTP/1.1", ""), "200");
    for headers in ["Origin: http://evil.example\r\n", "Sec-Fetch-Site: cross-site\r\n"] {
        is(&served.ask("GET /events HTTP/1.1", headers), "403");
    }
}

#[test]
fn more_followers_than_there_are_places_for_are_refused_and_the_page_still_comes() {
    let live = LiveRun::new("a1");
    let mut served = serve(Some(live));
    let request = format!("GET /events HTTP/1.1\r\nHost: {}\r\n\r\n", served.address);
    let followers: Vec<_> = (0..16)
        .map(|_| {
            let mut stream = served.connect();
            stream.write_all(request.as_bytes()).unwrap();
            read_until(&mut stream, "waiting\"}\n\n");
            stream
        })
        .collect();
    is(&served.get("/events"), "503");
    is(&served.get("/"), "200");
    drop(served.server.take());
    for follower in followers {
        assert_eq!(rest(follower), "", "it is closed with the server");
    }
}
