//! What stands behind the head of a request: a question.

use super::refusal::Refusal;
use std::io::{ErrorKind, Read};

/// Bytes that are read at a time. Room is made for what comes, and not for what is announced.
const CHUNK: usize = 16 << 10;

/// Reads a question of so many bytes, of which some may have come with the head. What stands behind it is no part of it.
pub fn read(mut source: impl Read, with_head: &[u8], length: usize) -> Result<Vec<u8>, Refusal> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::{Error, Result};

    /// A source that gives so many bytes at a time, and then no more, or an error.
    struct Slow<'a>(&'a [u8], usize, Option<ErrorKind>);

    impl Read for Slow<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> Result<usize> {
            let step = self.1.min(buffer.len()).min(self.0.len());
            let (now, later) = self.0.split_at(step);
            buffer[..step].copy_from_slice(now);
            self.0 = later;
            match (step, self.2) {
                (0, Some(kind)) => Err(Error::from(kind)),
                _ => Ok(step),
            }
        }
    }

    #[test]
    fn a_question_is_as_long_as_announced_however_it_comes() {
        let text: Vec<u8> = (0..=255).cycle().take(3 * CHUNK + 7).collect();
        for with_head in [0, 1, CHUNK, text.len()] {
            for step in [1000, CHUNK, text.len()] {
                let source = Slow(&text[with_head..], step, None);
                let read = read(source, &text[..with_head], text.len());
                assert!(read.as_ref() == Ok(&text), "{with_head} {step}");
            }
        }
    }

    #[test]
    fn what_stands_behind_a_question_is_left_there() {
        let mut source = Slow(b"defGET / HTTP/1.1", 100, None);
        assert_eq!(read(&mut source, b"abc", 6), Ok(b"abcdef".to_vec()));
        assert_eq!(source.0, b"GET / HTTP/1.1");
        assert_eq!(read(&mut source, b"abcGET /", 3), Ok(b"abc".to_vec()));
        assert_eq!(source.0, b"GET / HTTP/1.1");
        assert_eq!(read(&mut source, b"", 0), Ok(Vec::new()));
    }

    #[test]
    fn a_question_that_ends_early_is_none_and_one_that_stops_is_late() {
        assert_eq!(read(Slow(b"ab", 1, None), b"", 3), Err(Refusal::Garbled));
        for kind in [ErrorKind::WouldBlock, ErrorKind::TimedOut, ErrorKind::ConnectionReset] {
            assert_eq!(read(Slow(b"ab", 1, Some(kind)), b"", 3), Err(Refusal::Late));
        }
    }
}
