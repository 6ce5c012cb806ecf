//! A service that does nothing useful in several ways, served, and a client for it.
#![allow(dead_code, clippy::unwrap_used, clippy::panic, missing_docs)]

use platewash_server::{Listener, NoListener, Page, QuestionLimits, Server, Service, Site};
use platewash_workcell::cancel::CancelToken;
use std::io::{ErrorKind, Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::SeqCst};
use std::thread::sleep;
use std::time::{Duration, Instant};

pub const PAGE: &str = "<!doctype html><title>cell</title>";
pub const TOKEN: &str = "0123456789abcdef0123456789abcdef";

/// Longest question, and longest one under `/long`.
pub const MOST_BYTES: usize = 1 << 20;
pub const MOST_LONG_BYTES: usize = 8 << 20;

/// Long after anything that answers has answered.
pub const PATIENCE: Duration = Duration::from_secs(300);

#[derive(Debug, Default)]
pub struct Toy {
    /// Questions that have come to it.
    pub asked: AtomicUsize,
    /// Those it is at, and the most at a time of those that are work.
    pub busy: AtomicUsize,
    pub working: AtomicUsize,
    pub most_working: AtomicUsize,
    /// Answers that nobody listened to any more.
    pub given_up: AtomicUsize,
    /// Lets those go that are held.
    pub release: AtomicBool,
}

impl Service for Toy {
    fn knows(&self, path: &str) -> Option<QuestionLimits> {
        let is_work = ["/work", "/flood", "/panic"].contains(&path);
        let is_known = is_work || ["/hello", "/echo", "/hold", "/long"].contains(&path);
        is_known.then_some(QuestionLimits {
            is_work,
            most_bytes: if path == "/long" { MOST_LONG_BYTES } else { MOST_BYTES },
        })
    }

    fn answer(
        &self,
        path: &str,
        question: &[u8],
        tell: &mut dyn FnMut(String) -> Result<(), NoListener>,
        gone: &CancelToken,
    ) {
        self.asked.fetch_add(1, SeqCst);
        self.busy.fetch_add(1, SeqCst);
        match path {
            "/hello" | "/echo" => {
                let question = String::from_utf8_lossy(question).into_owned();
                let _ = tell(serde_json::json!({ "path": path, "question": question }).to_string());
            }
            "/long" => drop(tell(question.len().to_string())),
            "/hold" => self.hold(tell, gone),
            "/panic" => std::panic::resume_unwind(Box::new("on purpose")),
            _ => {
                let working = self.working.fetch_add(1, SeqCst) + 1;
                self.most_working.fetch_max(working, SeqCst);
                match path {
                    "/work" => self.hold(tell, gone),
                    _ => while tell("1".repeat(1 << 20)).is_ok() {},
                }
                self.working.fetch_sub(1, SeqCst);
            }
        }
        if gone.is_cancelled() {
            self.given_up.fetch_add(1, SeqCst);
        }
        self.busy.fetch_sub(1, SeqCst);
    }

    fn token(&self) -> &str {
        TOKEN
    }
}

impl Toy {
    /// Says that it has begun, and the rest when it is let go.
    fn hold(&self, tell: &mut dyn FnMut(String) -> Result<(), NoListener>, gone: &CancelToken) {
        let _ = tell("\"begun\"".to_owned());
        while !gone.is_cancelled() && !self.release.load(SeqCst) {
            sleep(Duration::from_millis(2));
        }
        let _ = tell("\"done\"".to_owned());
    }
}

/// Waits until something holds; how long that took.
#[track_caller]
pub fn until(what: &str, holds: impl Fn() -> bool) -> Duration {
    let begin = Instant::now();
    while !holds() {
        assert!(begin.elapsed() < PATIENCE, "{what} never holds");
        sleep(Duration::from_millis(1));
    }
    begin.elapsed()
}

pub struct ToyServer {
    pub toy: Arc<Toy>,
    pub server: Option<Server>,
    pub address: SocketAddr,
}

pub fn serve() -> ToyServer {
    serve_page(Page::Fixed(PAGE.to_owned()))
}

pub fn serve_page(page: Page) -> ToyServer {
    let listener = Listener::bind("127.0.0.1:0".parse().unwrap()).unwrap();
    let url = listener.url();
    let address = url.strip_prefix("http://").unwrap().strip_suffix('/').unwrap();
    let toy = Arc::new(Toy::default());
    let site = Site {
        service: Some(toy.clone()),
        ..Site::from_page(page)
    };
    ToyServer {
        address: address.parse().unwrap(),
        server: Some(listener.serve(site).unwrap()),
        toy,
    }
}

impl ToyServer {
    pub fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(self.address).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        stream
    }

    /// The headers of a question as the page sends it, by name.
    pub fn headers(&self, length: usize) -> Vec<(&'static str, String)> {
        vec![
            ("Host", self.address.to_string()),
            ("Origin", format!("http://{}", self.address)),
            ("Sec-Fetch-Site", "same-origin".to_owned()),
            ("Content-Type", "application/json".to_owned()),
            ("X-Platewash-Token", TOKEN.to_owned()),
            ("Content-Length", length.to_string()),
        ]
    }

    /// A question as the page sends it.
    pub fn question(&self, path: &str, body: &str) -> String {
        request(&format!("POST {path} HTTP/1.1"), &self.headers(body.len())) + body
    }

    /// Asks, and goes on without waiting for the answer.
    pub fn begin(&self, path: &str) -> TcpStream {
        let mut stream = self.connect();
        stream.write_all(self.question(path, "{}").as_bytes()).unwrap();
        stream
    }

    /// Sends bytes; all that comes back until the connection is closed.
    pub fn send(&self, bytes: impl AsRef<[u8]>) -> String {
        let mut stream = self.connect();
        // It may be answered, and closed, half-way.
        let _ = stream.write_all(bytes.as_ref());
        rest(stream)
    }

    pub fn ask(&self, path: &str, body: &str) -> String {
        self.send(self.question(path, body))
    }

    pub fn get(&self, path: &str) -> String {
        self.send(format!("GET {path} HTTP/1.1\r\nHost: {}\r\n\r\n", self.address))
    }
}

pub fn request(line: &str, headers: &[(&str, String)]) -> String {
    let headers = headers.iter().map(|(name, value)| format!("{name}: {value}\r\n"));
    format!("{line}\r\n{}\r\n", headers.collect::<String>())
}

pub fn rest(mut stream: TcpStream) -> String {
    let mut bytes = Vec::new();
    match stream.read_to_end(&mut bytes) {
        Ok(_) => {}
        Err(error) => assert_eq!(error.kind(), ErrorKind::ConnectionReset, "{error}"),
    }
    String::from_utf8(bytes).unwrap()
}

pub fn body(answer: &str) -> &str {
    answer.split_once("\r\n\r\n").unwrap().1
}
