//! A file of a program, made of its bytes.

use crate::dialect::language::Dialect;
use crate::program::ProgramFile;
use crate::rapid::Rapid;
use platewash_motion_proof::ReadError;

impl ProgramFile {
    /// Makes a file of its bytes: UTF-8, or for a module of RAPID also ISO 8859-1.
    ///
    /// # Errors
    /// [`ReadError`] with the first line that is not UTF-8.
    pub fn from_bytes(name: &str, bytes: Vec<u8>) -> Result<Self, ReadError> {
        let file = |text| Self {
            name: name.to_owned(),
            text,
        };
        match String::from_utf8(bytes) {
            Ok(text) => Ok(file(text)),
            Err(error) => {
                let (position, bytes) = (error.utf8_error().valid_up_to(), error.into_bytes());
                let module = file(text_of_latin_1(&bytes));
                if Rapid.is_in(&module) {
                    return Ok(module);
                }
                let line = 1 + bytes.iter().take(position).filter(|byte| **byte == b'\n').count();
                let reason = format!("not UTF-8 text (byte {position} of the file); save it in UTF-8");
                Err(ReadError::at(name, line, reason))
            }
        }
    }
}

/// Text of a module that is not UTF-8: ISO 8859-1, in which controllers and editors write comments. Of the bytes that are signs in Windows'
/// encoding alone only the place is kept; one of them ends lines elsewhere, and stays for the reader to refuse.
fn text_of_latin_1(bytes: &[u8]) -> String {
    const NEXT_LINE: u8 = 0x85;
    let sign = |byte: &u8| match byte {
        0x80..=0x9f if *byte != NEXT_LINE => char::REPLACEMENT_CHARACTER,
        byte => char::from(*byte),
    };
    bytes.iter().map(sign).collect()
}
