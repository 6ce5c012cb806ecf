//! Token with which a page proves that it is from this server.

use crate::error::ServerError;
use rand::TryRng;
use rand::rngs::SysRng;
use std::hint::black_box;
use std::io::Error;

/// Length of a token \[bytes\], before it is written in digits.
const BYTES: usize = 16;

/// A token that nobody can guess: 128 bits of the system's randomness, as 32 hexadecimal digits.
///
/// # Errors
/// [`ServerError::Randomness`]: the system has none.
pub fn token() -> Result<String, ServerError> {
    let mut bytes = [0; BYTES];
    SysRng
        .try_fill_bytes(&mut bytes)
        .map_err(|error| ServerError::Randomness(Error::other(error)))?;
    Ok(format!("{:032x}", u128::from_be_bytes(bytes)))
}

/// Compares a token with the expected one, in a time that does not depend on their differences. No token equals an empty one.
pub fn is_token(token: &str, expected: &str) -> bool {
    let pairs = token.bytes().zip(expected.bytes());
    let differences = pairs.fold(0, |differences, (a, b)| black_box(differences | (a ^ b)));
    !expected.is_empty() && token.len() == expected.len() && differences == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tokens_are_long_and_never_the_same() {
        let tokens: Vec<_> = (0..100).map(|_| token().unwrap()).collect();
        for (n, token) in tokens.iter().enumerate() {
            assert!(
                token.len() == 32 && token.bytes().all(|b| b.is_ascii_hexdigit()),
                "{token}"
            );
            assert!(!tokens[..n].contains(token));
        }
        // Each bit is 0 in some and 1 in others.
        let values = tokens.iter().map(|token| u128::from_str_radix(token, 16).unwrap());
        let (all, any) = values.fold((u128::MAX, 0), |(all, any), value| (all & value, any | value));
        assert_eq!((all, any), (0, u128::MAX));
    }

    #[test]
    fn tokens_equal_only_themselves() {
        let expected = "0123456789abcdef";
        assert!(is_token(expected, expected));
        for n in 0..expected.len() {
            let mut other = expected.to_owned();
            other.replace_range(n..=n, "x");
            assert!(
                !is_token(&other, expected) && !is_token(&expected[..n], expected),
                "{n}"
            );
        }
        for other in ["", "0123456789abcdef0", "0123456789ABCDEF", "0123456789abcdé"] {
            assert!(!is_token(other, expected), "{other}");
        }
        assert!(!is_token("", ""));
    }
}
