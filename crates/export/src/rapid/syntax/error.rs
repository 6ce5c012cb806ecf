//! Why a text is no program of the language.

use super::token::At;

/// Why a text is no program of the language.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SyntaxError {
    /// Something else stands where a construct goes on.
    #[error("expected {expected}, found {found}")]
    Unexpected {
        /// Where.
        at: At,
        /// What goes there.
        expected: String,
        /// What stands there.
        found: String,
    },
    /// A character of no token.
    #[error("expected a name, a number, a string or a symbol, found the character {found:?}")]
    Character {
        /// Where.
        at: At,
        /// The character.
        found: char,
    },
    /// A number that no number can be read from, or that a `num` does not hold.
    #[error("expected a number within ±3.4E38, found {found}")]
    Number {
        /// Where.
        at: At,
        /// As written.
        found: String,
    },
    /// A string that does not end on its line.
    #[error("expected a `\"` that ends the string on its line, found the end of the line")]
    OpenText {
        /// Where it begins.
        at: At,
    },
    /// A backslash in a string that begins no character code.
    #[error("expected a second `\\` or two hexadecimal digits after a `\\` in a string, found {found}")]
    Escape {
        /// Where.
        at: At,
        /// What follows it.
        found: String,
    },
    /// A name or a string that is too long.
    #[error("expected a {what} of at most {most} characters, found {found}")]
    Long {
        /// Where.
        at: At,
        /// What.
        what: &'static str,
        /// How long it may be.
        most: usize,
        /// How long it is.
        found: usize,
    },
    /// Blocks or expressions within each other, too deep.
    #[error("expected at most {most} blocks or expressions within each other, found more")]
    Deep {
        /// Where.
        at: At,
        /// How deep they may be.
        most: usize,
    },
    /// A text that is too large.
    #[error("expected at most {most} bytes, found {found}")]
    Large {
        /// Where.
        at: At,
        /// How many it may have.
        most: usize,
        /// How many it has.
        found: usize,
    },
}

impl SyntaxError {
    /// Where it is.
    #[must_use]
    pub fn at(&self) -> At {
        match self {
            Self::Unexpected { at, .. }
            | Self::Character { at, .. }
            | Self::Number { at, .. }
            | Self::OpenText { at }
            | Self::Escape { at, .. }
            | Self::Long { at, .. }
            | Self::Deep { at, .. }
            | Self::Large { at, .. } => *at,
        }
    }
}
