//! A position among the tokens, with what every rule of the grammar needs.

use super::ast::Name;
use super::error::SyntaxError;
use super::lexer::tokens;
use super::token::{At, Lexed, Token};
use std::collections::HashMap;
use std::rc::Rc;

/// How deep blocks and expressions may be within each other.
pub const DEPTH: usize = 64;

const END: Token<'static> = Token::End;

/// A position among the tokens.
pub struct Cursor<'a> {
    tokens: Vec<Lexed<'a>>,
    next: usize,
    depth: usize,
    /// Names that were read before, so that each is kept once.
    known: HashMap<&'a str, (Rc<str>, Rc<str>)>,
}

impl<'a> Cursor<'a> {
    /// Before the first token of a text.
    pub fn new(text: &'a str) -> Result<Self, SyntaxError> {
        Ok(Self {
            tokens: tokens(text)?,
            next: 0,
            depth: 0,
            known: HashMap::new(),
        })
    }

    /// The token that is next.
    pub fn peek(&self) -> &Token<'a> {
        self.ahead(0)
    }

    /// The token that comes that much later.
    pub fn ahead(&self, by: usize) -> &Token<'a> {
        self.tokens.get(self.next + by).map_or(&END, |lexed| &lexed.token)
    }

    /// Where the next token begins.
    pub fn at(&self) -> At {
        let lexed = self.tokens.get(self.next).or(self.tokens.last());
        lexed.map_or(At { line: 1, column: 1 }, |lexed| lexed.at)
    }

    /// Goes on to the token after the next one.
    pub fn step(&mut self) {
        self.next += 1;
    }

    /// Whether that word is next.
    pub fn is(&self, word: &str) -> bool {
        matches!(self.peek(), Token::Fixed(found) if *found == word)
    }

    /// Takes that word if it is next.
    pub fn eat(&mut self, word: &str) -> bool {
        let is_next = self.is(word);
        if is_next {
            self.step();
        }
        is_next
    }

    /// Takes the one of those words that is next.
    pub fn eat_one<T: Copy>(&mut self, words: &[(&str, T)]) -> Option<T> {
        let (_, meaning) = words.iter().find(|(word, _)| self.is(word))?;
        self.step();
        Some(*meaning)
    }

    /// Takes that word, which must be next.
    pub fn need(&mut self, word: &str) -> Result<(), SyntaxError> {
        if self.eat(word) {
            return Ok(());
        }
        Err(self.unexpected(&format!("`{word}`")))
    }

    /// Takes a name, which must be next.
    pub fn name(&mut self, what: &str) -> Result<Name, SyntaxError> {
        let at = self.at();
        let Token::Name(name) = *self.peek() else {
            return Err(self.unexpected(what));
        };
        self.step();
        let known = self.known.entry(name);
        let (text, key) = known.or_insert_with(|| (Rc::from(name), Rc::from(name.to_lowercase())));
        Ok(Name {
            text: Rc::clone(text),
            key: Rc::clone(key),
            at,
        })
    }

    /// That something else should be next.
    pub fn unexpected(&self, expected: &str) -> SyntaxError {
        SyntaxError::Unexpected {
            at: self.at(),
            expected: expected.to_owned(),
            found: self.peek().to_string(),
        }
    }

    /// What a rule reads, one level deeper.
    pub fn deeper<T>(&mut self, rule: impl FnOnce(&mut Self) -> Result<T, SyntaxError>) -> Result<T, SyntaxError> {
        if self.depth >= DEPTH {
            let at = self.at();
            return Err(SyntaxError::Deep { at, most: DEPTH });
        }
        self.depth += 1;
        let read = rule(self);
        self.depth -= 1;
        read
    }
}
