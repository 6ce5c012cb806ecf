//! The head of a request as bytes: all up to the first empty line.

use super::limits::HEAD_BYTES;
use super::refusal::Refusal;
use std::io::{ErrorKind, Read};

/// Bytes that are read at a time.
const CHUNK: usize = 2048;

/// Reads the head of a request and what came with it; nothing where the client left without a word.
pub fn read(mut source: impl Read) -> Result<Option<Vec<u8>>, Refusal> {
    let mut head = Vec::new();
    let mut chunk = [0; CHUNK];
    loop {
        let room = CHUNK.min(HEAD_BYTES - head.len());
        match source.read(&mut chunk[..room]) {
            Ok(0) if head.is_empty() => return Ok(None),
            Ok(0) => return Err(Refusal::Garbled),
            Ok(read) => {
                // The empty line may have begun in what was read before.
                let from = head.len().saturating_sub(3);
                head.extend_from_slice(&chunk[..read]);
                if ends(&head[from..]) {
                    return Ok(Some(head));
                }
                if head.len() >= HEAD_BYTES {
                    return Err(Refusal::TooLong);
                }
            }
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            // Nobody is told that nothing came: browsers connect before they know what to ask.
            Err(_) if head.is_empty() => return Ok(None),
            Err(_) => return Err(Refusal::Late),
        }
    }
}

fn ends(bytes: &[u8]) -> bool {
    bytes.windows(2).any(|w| w == b"\n\n") || bytes.windows(3).any(|w| w == b"\n\r\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A source that gives so many bytes at a time.
    struct Slow<'a>(&'a [u8], usize);

    impl Read for Slow<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
            let step = self.1.min(buffer.len()).min(self.0.len());
            let (now, later) = self.0.split_at(step);
            buffer[..step].copy_from_slice(now);
            self.0 = later;
            Ok(step)
        }
    }

    #[test]
    fn a_head_ends_with_its_empty_line_however_it_comes() {
        for text in ["GET / HTTP/1.1\r\nHost: a\r\n\r\n", "GET / HTTP/1.0\nHost: a\n\n"] {
            for step in 1..=text.len() {
                assert_eq!(read(Slow(text.as_bytes(), step)), Ok(Some(text.into())), "{step}");
            }
        }
    }

    #[test]
    fn an_end_half_way_is_no_request_and_one_before_the_first_byte_is_none() {
        assert_eq!(read(&b""[..]), Ok(None));
        assert_eq!(read(&b"GET / HTTP/1.1\r\nHo"[..]), Err(Refusal::Garbled));
    }

    #[test]
    fn a_head_without_an_end_is_read_up_to_its_bound() {
        let endless = vec![b'a'; HEAD_BYTES + 1];
        for step in [1, 1000, CHUNK] {
            let mut source = Slow(&endless, step);
            assert_eq!(read(&mut source), Err(Refusal::TooLong));
            assert_eq!(source.0.len(), 1);
        }
    }
}
