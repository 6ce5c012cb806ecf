//! A crowd of clients at once, most of them up to no good. A program of its own, as its memory is measured.
#![allow(clippy::unwrap_used, missing_docs)]

mod toy;

use std::io::Write;
use std::net::TcpStream;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering::SeqCst};
use std::thread::{scope, sleep};
use std::time::{Duration, Instant};
use toy::*;

/// How many come, and how many of them stay at a time: each is an open file, of which some systems allow few.
const CROWD: usize = 1000;
const STAYING: usize = if cfg!(target_os = "linux") { 600 } else { 100 };

/// More than the server and its clients here hold: 64 questions, twice, as room for them is made by doubling, and the crowd's.
const MOST_KIB: usize = 192 << 10;

/// One test at a time: each takes all places.
static ALONE: Mutex<()> = Mutex::new(());

/// What the n-th client sends, of which some is broken, some huge, some good.
fn sent(served: &ToyServer, n: usize) -> Vec<u8> {
    let good = served.question("/echo", "{}");
    let long = served.question("/echo", &"a".repeat(MOST_BYTES));
    let announced = request("POST /echo HTTP/1.1", &served.headers(MOST_BYTES));
    let text = match n % 12 {
        0 => String::new(),
        1 => "GET / HT".to_owned(),
        2 => good[..good.len() / 2].to_owned(),
        // A long question that stays away, comes by half, whole, too long.
        3 => announced,
        4 => long[..long.len() / 2].to_owned(),
        5 => long,
        6 => request("POST /work HTTP/1.1", &served.headers(usize::MAX)) + &"a".repeat(1 << 16),
        7 => "GET / HTTP/1.1\r\n".repeat(5000),
        8 => "a".repeat(1 << 20),
        9 => good.repeat(100),
        10 => good.replace(TOKEN, "0"),
        _ => served.question("/flood", "{}"),
    };
    text.into_bytes()
}

/// A client that sends what it can without being held up for long, and reads nothing.
fn client(served: &ToyServer, n: usize) -> TcpStream {
    let mut stream = served.connect();
    stream.set_write_timeout(Some(Duration::from_millis(50))).unwrap();
    let _ = stream.write_all(&sent(served, n));
    stream
}

/// The memory of this program \[KiB\], where the system says.
fn memory_kib() -> Option<usize> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    line.trim().strip_suffix("kB")?.trim().parse().ok()
}

/// How far the memory grows meanwhile \[KiB\].
fn grown_kib(meanwhile: impl FnOnce()) -> usize {
    let is_over = AtomicBool::new(false);
    let before = memory_kib().unwrap_or(0);
    scope(|scope| {
        let most = scope.spawn(|| {
            let mut most = before;
            while !is_over.load(SeqCst) {
                most = memory_kib().unwrap_or(0).max(most);
                sleep(Duration::from_millis(5));
            }
            most
        });
        // Even after a failure, or the scope would wait for ever.
        let ended = catch_unwind(AssertUnwindSafe(meanwhile));
        is_over.store(true, SeqCst);
        let most = most.join().unwrap();
        ended.unwrap_or_else(|failure| resume_unwind(failure));
        most - before
    })
}

#[test]
fn many_clients_lock_nobody_out_and_need_little_memory() {
    let _alone = ALONE.lock();
    let mut served = serve();
    let staying = Mutex::new(Vec::new());
    let grown = grown_kib(|| {
        scope(|scope| {
            for thread in 0..8 {
                let (served, staying) = (&served, &staying);
                scope.spawn(move || {
                    for n in (thread..CROWD).step_by(8) {
                        let stream = client(served, n);
                        let mut staying = staying.lock().unwrap();
                        if staying.len() < STAYING {
                            staying.push(stream);
                        }
                    }
                });
            }
        });
        // They are all still there, and none of them lets go.
        until("a good question is answered", || {
            served.ask("/echo", "{}").starts_with("HTTP/1.1 200")
        });
        assert!(served.get("/").ends_with(PAGE));
    });
    assert!(grown < MOST_KIB, "{grown} KiB");
    let begin = Instant::now();
    drop(served.server.take());
    assert!(begin.elapsed() < PATIENCE, "{:?}", begin.elapsed());
    until("nothing is worked on", || served.toy.busy.load(SeqCst) == 0);
}

#[test]
fn the_server_ends_while_clients_connect() {
    let _alone = ALONE.lock();
    let mut served = serve();
    let server = served.server.take();
    let is_over = AtomicBool::new(false);
    scope(|scope| {
        for thread in 0..4 {
            let (served, is_over) = (&served, &is_over);
            scope.spawn(move || {
                let mut n = thread;
                while !is_over.load(SeqCst) {
                    if let Ok(mut stream) = TcpStream::connect(served.address) {
                        let _ = stream.set_write_timeout(Some(Duration::from_millis(50)));
                        let _ = stream.write_all(&sent(served, n));
                    }
                    n += 1;
                }
            });
        }
        until("many have come", || served.toy.asked.load(SeqCst) > 50);
        let begin = Instant::now();
        drop(server);
        let took = begin.elapsed();
        is_over.store(true, SeqCst);
        assert!(took < PATIENCE, "{took:?}");
    });
    until("nothing is worked on", || served.toy.busy.load(SeqCst) == 0);
}
