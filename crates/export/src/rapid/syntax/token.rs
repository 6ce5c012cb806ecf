//! What a text is made of.

use std::fmt;

/// A place in a text, both from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct At {
    /// Line.
    pub line: usize,
    /// Character within it.
    pub column: usize,
}

/// A token.
#[derive(Debug, Clone, PartialEq)]
pub enum Token<'a> {
    /// A name that is no keyword, as written.
    Name(&'a str),
    /// A keyword in capitals, or a symbol.
    Fixed(&'static str),
    /// A number.
    Number(f64),
    /// A string, without its quotes and escapes.
    Text(String),
    /// The end of the file.
    End,
}

impl fmt::Display for Token<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Name(name) => write!(f, "the name {name}"),
            Self::Fixed(word) => write!(f, "`{word}`"),
            Self::Number(value) => write!(f, "the number {value}"),
            Self::Text(text) => write!(f, "the string \"{text}\""),
            Self::End => f.write_str("the end of the file"),
        }
    }
}

/// A token and where it begins.
#[derive(Debug, Clone, PartialEq)]
pub struct Lexed<'a> {
    /// The token.
    pub token: Token<'a>,
    /// Its first character.
    pub at: At,
}
