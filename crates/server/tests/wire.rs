//! Answers as they come over TCP.

use std::io::Read;
use std::net::TcpStream;

/// Reads until a text has come.
pub fn read_until(stream: &mut TcpStream, text: &str) -> String {
    let (mut bytes, mut byte) = (Vec::new(), [0]);
    while !String::from_utf8_lossy(&bytes).ends_with(text) {
        stream.read_exact(&mut byte).unwrap();
        bytes.push(byte[0]);
    }
    String::from_utf8(bytes).unwrap()
}

#[track_caller]
pub fn is(answer: &str, status: &str) {
    let start = format!("HTTP/1.1 {status} ");
    assert!(answer.starts_with(&start), "{status}: {answer:?}");
}
