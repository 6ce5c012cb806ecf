//! Questions of the page as the server takes them, good ones and others, over TCP.

use crate::toy::*;
use crate::wire::*;
use platewash_server::Page;
use std::io::{Read, Write};
use std::net::Shutdown;
use std::sync::atomic::{AtomicUsize, Ordering::SeqCst};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Questions that are worked on at a time, and connections, as the documentation says.
const WORK: usize = 2;
const CONNECTIONS: usize = 64;

#[test]
fn a_question_is_answered_in_lines() {
    let served = serve();
    let answer = served.ask("/echo?x=1", "{\"a\": \"\u{e9}\"}");
    is(&answer, "200");
    for header in [
        "Content-Type: application/x-ndjson; charset=utf-8\r\n",
        "Connection: close\r\n",
        "Cache-Control: no-store\r\n",
        "X-Content-Type-Options: nosniff\r\n",
    ] {
        assert!(answer.contains(header), "{header}: {answer}");
    }
    for header in ["Content-Length", "Transfer-Encoding", "Access-Control"] {
        assert!(!answer.contains(header), "{header}: {answer}");
    }
    let line: serde_json::Value = serde_json::from_str(body(&answer).strip_suffix('\n').unwrap()).unwrap();
    assert_eq!(
        line,
        serde_json::json!({"path": "/echo", "question": "{\"a\": \"\u{e9}\"}"})
    );
    is(&served.get("/"), "200");
}

#[test]
fn sends_each_line_at_once_and_the_end_with_the_last() {
    let served = serve();
    let mut stream = served.begin("/work");
    is(&read_until(&mut stream, "\r\n\r\n"), "200");
    assert_eq!(read_until(&mut stream, "\n"), "\"begun\"\n");
    served.toy.release.store(true, SeqCst);
    assert_eq!(rest(stream), "\"done\"\n");
    until("all is over", || served.toy.busy.load(SeqCst) == 0);
    assert_eq!(served.toy.given_up.load(SeqCst), 0);
}

#[test]
fn sends_empty_lines_as_keep_alive() {
    let served = serve();
    let begin = Instant::now();
    let mut stream = served.begin("/work");
    read_until(&mut stream, "\"begun\"\n");
    assert_eq!(read_until(&mut stream, "\n"), "\n");
    assert!(begin.elapsed() > Duration::from_secs(1));
    served.toy.release.store(true, SeqCst);
    assert_eq!(rest(stream), "\"done\"\n");
}

#[test]
fn rejects_questions_from_other_pages() {
    let served = serve();
    let port = served.address.port();
    let foreign = [
        ("Host", Some("evil.example".to_owned()), "403"),
        ("Host", Some(format!("127.0.0.1:{}", port ^ 1)), "403"),
        ("Host", None, "400"),
        ("Origin", None, "403"),
        ("Origin", Some("null".to_owned()), "403"),
        ("Origin", Some("http://evil.example".to_owned()), "403"),
        ("Origin", Some(format!("http://evil.example:{port}")), "403"),
        ("Origin", Some(format!("http://localhost:{port}")), "403"),
        ("Origin", Some(format!("https://127.0.0.1:{port}")), "403"),
        ("Sec-Fetch-Site", Some("cross-site".to_owned()), "403"),
        ("Sec-Fetch-Site", Some("same-site".to_owned()), "403"),
        ("Content-Type", None, "415"),
        ("Content-Type", Some("text/plain".to_owned()), "415"),
        (
            "Content-Type",
            Some("application/x-www-form-urlencoded".to_owned()),
            "415",
        ),
        ("X-Platewash-Token", None, "403"),
        ("X-Platewash-Token", Some(TOKEN.replace('0', "1")), "403"),
        ("X-Platewash-Token", Some(TOKEN[1..].to_owned()), "403"),
        ("Content-Length", None, "411"),
        ("Content-Length", Some("-2".to_owned()), "400"),
        ("Content-Length", Some((MOST_BYTES + 1).to_string()), "413"),
        ("Content-Length", Some("9".repeat(30)), "413"),
        ("Transfer-Encoding", Some("chunked".to_owned()), "411"),
    ];
    for (name, value, status) in foreign {
        let mut headers = served.headers(2);
        headers.retain(|header| header.0 != name);
        headers.extend(value.clone().map(|value| (name, value)));
        let answer = served.send(request("POST /echo HTTP/1.1", &headers) + "{}");
        is(&answer, status);
        assert!(!answer.contains("Access-Control"), "{name} {value:?}: {answer}");
    }
    let stale = [served.headers(2), vec![("X-Platewash-Token", String::new())]].concat();
    is(&served.send(request("POST /echo HTTP/1.1", &stale) + "{}"), "400");
    assert_eq!(served.toy.asked.load(SeqCst), 0, "nothing has come so far");
    let twice = served.question("/echo", "{}").repeat(2);
    assert_eq!(served.send(twice).matches("HTTP/1.1 ").count(), 1);
    assert_eq!(served.toy.asked.load(SeqCst), 1);
}

#[test]
fn tells_a_page_without_token_its_address() {
    let served = serve();
    let mut headers = served.headers(2);
    headers.retain(|header| header.0 != "X-Platewash-Token");
    for path in ["/echo", "/hello"] {
        let answer = served.send(request(&format!("POST {path} HTTP/1.1"), &headers) + "{}");
        is(&answer, "403");
        assert!(answer.contains("the address that platewash edit printed"), "{answer}");
    }
}

#[test]
fn accepts_post_for_questions_only() {
    let served = serve();
    for method in ["GET", "HEAD", "PUT", "DELETE", "OPTIONS", "PATCH", "post"] {
        let answer = served.send(request(&format!("{method} /echo HTTP/1.1"), &served.headers(2)) + "{}");
        is(&answer, "405");
        assert!(answer.contains("Allow: POST\r\n"), "{answer}");
    }
    for path in ["/", "/echo/", "/Echo", "/%65cho", "/nowhere", "//echo"] {
        let answer = served.ask(path, "{}");
        is(&answer, "405");
        assert!(answer.contains("Allow: GET, HEAD\r\n"), "{answer}");
    }
    // What a browser asks before it lets a foreign page send a question.
    let preflight = [
        ("Host", served.address.to_string()),
        ("Origin", "http://evil.example".to_owned()),
        ("Access-Control-Request-Method", "POST".to_owned()),
        ("Access-Control-Request-Headers", "x-platewash-token".to_owned()),
    ];
    let answer = served.send(request("OPTIONS /echo HTTP/1.1", &preflight));
    is(&answer, "403");
    assert!(!answer.contains("Access-Control"), "{answer}");
    assert_eq!(served.toy.asked.load(SeqCst), 0);
}

#[test]
fn a_question_may_come_slowly_but_not_in_part() {
    let served = serve();
    let long = format!("\"{}\"", "a".repeat(MOST_BYTES - 2));
    let answer = served.ask("/echo", &long);
    assert!(answer.len() > MOST_BYTES, "{}", answer.len());
    let question = served.question("/echo", "{\"slowly\": 1}");
    let mut slow = served.connect();
    for part in question.as_bytes().chunks(20) {
        slow.write_all(part).unwrap();
        slow.flush().unwrap();
        sleep(Duration::from_millis(1));
    }
    assert!(rest(slow).contains("slowly"));
    // It ends too early.
    let mut short = served.connect();
    short
        .write_all(request("POST /echo HTTP/1.1", &served.headers(10)).as_bytes())
        .unwrap();
    short.write_all(b"{}").unwrap();
    short.shutdown(Shutdown::Write).unwrap();
    is(&rest(short), "400");
    // It is longer than it says: the rest is no question, and no part of this one.
    let longer = served.question("/echo", "{}") + &"GET / HTTP/1.1\r\n".repeat(100);
    let answer = served.send(longer);
    assert!(answer.ends_with("\"question\":\"{}\"}\n"), "{answer}");
    // It does not come at all.
    let begin = Instant::now();
    let never = served.send(request("POST /echo HTTP/1.1", &served.headers(10)));
    is(&never, "408");
    assert!(begin.elapsed() < PATIENCE, "{:?}", begin.elapsed());
    assert_eq!(served.toy.asked.load(SeqCst), 3);
}

#[test]
fn a_huge_question_is_refused_without_being_read() {
    let served = serve();
    let mut stream = served.connect();
    let head = request("POST /echo HTTP/1.1", &served.headers(usize::MAX));
    stream.write_all(head.as_bytes()).unwrap();
    // Nothing of it is sent, and the answer comes all the same.
    is(&rest(stream), "413");
}

#[test]
fn notices_a_client_that_leaves() {
    let served = serve();
    let toy = &served.toy;
    for n in 1..=5 {
        let mut stream = served.begin("/work");
        match n % 2 {
            0 => drop(read_until(&mut stream, "\"begun\"\n")),
            // What it has not read makes a reset of its leaving.
            _ => drop(until("it has begun", || toy.working.load(SeqCst) == 1)),
        }
        assert_eq!(toy.given_up.load(SeqCst), n - 1);
        drop(stream);
        until("it is noticed", || toy.given_up.load(SeqCst) == n);
    }
}

#[test]
fn drops_a_client_that_sends_without_end() {
    let served = serve();
    let mut stream = served.begin("/work");
    read_until(&mut stream, "\"begun\"\n");
    while stream.write_all(&[b'a'; 1000]).is_ok() {}
    until("it is left", || served.toy.given_up.load(SeqCst) == 1);
}

#[test]
fn drops_a_client_that_reads_too_slowly() {
    let served = serve();
    let mut stream = served.begin("/flood");
    read_until(&mut stream, "\r\n\r\n1");
    until("it is left", || served.toy.given_up.load(SeqCst) == 1);
    assert_eq!(served.toy.working.load(SeqCst), 0);
    // What it has not been sent by then does not come any more.
    let mut received = Vec::new();
    let _ = stream.read_to_end(&mut received);
}

#[test]
fn bounds_simultaneous_work_and_lets_others_wait() {
    const WAITING: usize = 10;
    let served = serve();
    let toy = &served.toy;
    let mut at_work: Vec<_> = (0..WORK).map(|_| served.begin("/work")).collect();
    until("as much is worked on as can be", || toy.working.load(SeqCst) == WORK);
    let waiting: Vec<_> = (0..WAITING).map(|_| served.begin("/work")).collect();
    is(&served.ask("/echo", "{}"), "200");
    is(&served.get("/"), "200");
    // One that leaves makes room for another.
    drop(at_work.pop());
    until("another one has its turn", || toy.asked.load(SeqCst) == WORK + 2);
    assert_eq!((toy.given_up.load(SeqCst), toy.working.load(SeqCst)), (1, WORK));
    toy.release.store(true, SeqCst);
    for answer in at_work.into_iter().chain(waiting).map(rest) {
        is(&answer, "200");
        assert!(answer.ends_with("\"begun\"\n\"done\"\n"), "{answer}");
    }
    assert_eq!(toy.most_working.load(SeqCst), WORK);
}

#[test]
fn tells_a_client_that_waited_too_long_to_ask_again() {
    let served = serve();
    let _at_work: Vec<_> = (0..WORK).map(|_| served.begin("/work")).collect();
    until("as much is worked on as can be", || {
        served.toy.working.load(SeqCst) == WORK
    });
    let answer = served.ask("/work", "{}");
    is(&answer, "503");
    assert!(answer.contains("Retry-After: 1\r\n"), "{answer}");
}

#[test]
fn a_panic_of_the_service_loses_only_its_answer() {
    let served = serve();
    for _ in 0..2 * WORK {
        let answer = served.ask("/panic", "{}");
        assert!(answer.is_empty() || body(&answer).is_empty(), "{answer}");
    }
    let mut stream = served.begin("/work");
    read_until(&mut stream, "\"begun\"\n");
    is(&served.get("/"), "200");
}

#[test]
fn refuses_a_client_when_all_places_are_taken() {
    let served = serve();
    let toy = &served.toy;
    let held: Vec<_> = (0..CONNECTIONS).map(|_| served.begin("/hold")).collect();
    until("all are held", || toy.busy.load(SeqCst) == CONNECTIONS);
    for _ in 0..200 {
        let answer = served.get("/");
        is(&answer, "503");
        assert!(answer.contains("Retry-After: 1\r\n"), "{answer}");
    }
    let long = served.question("/echo", &"a".repeat(MOST_BYTES));
    is(&served.send(long), "503");
    toy.release.store(true, SeqCst);
    for stream in held {
        is(&rest(stream), "200");
    }
    until("there is a place again", || served.get("/").starts_with("HTTP/1.1 200"));
}

#[test]
fn the_end_of_the_server_is_the_end_of_all_work() {
    let mut served = serve();
    let streams: Vec<_> = ["/work", "/work", "/work", "/hold", "/hold", "/echo"]
        .map(|path| served.begin(path))
        .into();
    let toy = served.toy.clone();
    until("all are at it", || {
        toy.busy.load(SeqCst) == 4 && toy.asked.load(SeqCst) == 5
    });
    let begin = Instant::now();
    drop(served.server.take());
    assert!(begin.elapsed() < PATIENCE, "{:?}", begin.elapsed());
    until("all have given up", || toy.busy.load(SeqCst) == 0);
    assert!(toy.given_up.load(SeqCst) >= 4);
    for stream in streams {
        assert!(!rest(stream).contains("done"));
    }
}

#[test]
fn a_page_can_be_rendered_for_each_request() {
    let loads = AtomicUsize::new(0);
    let served = serve_page(Page::Made(Box::new(move || match loads.fetch_add(1, SeqCst) {
        2 => Err("the disk is <b>full</b>".into()),
        n => Ok(format!("<title>{n}</title>")),
    })));
    for n in 0..2 {
        assert_eq!(body(&served.get("/")), format!("<title>{n}</title>"));
    }
    let failed = served.get("/");
    is(&failed, "500");
    assert!(
        failed.contains("Content-Type: text/plain; charset=utf-8\r\n"),
        "{failed}"
    );
    assert!(body(&failed).contains("the disk is <b>full</b>"));
    assert_eq!(body(&served.get("/")), "<title>3</title>");
}
