//! Text → tokens.

use super::error::SyntaxError;
use super::keyword::keyword;
use super::token::{At, Lexed, Token};
use platewash_workcell::words::without_mark;

/// Longest name.
pub const NAME_CHARACTERS: usize = 32;
/// Longest string.
pub const TEXT_CHARACTERS: usize = 80;
/// Largest text \[bytes\].
pub const MOST_BYTES: usize = 4 << 20;

/// Symbols, the longer ones first.
const SYMBOLS: [&str; 24] = [
    ":=", "<=", ">=", "<>", "(", ")", "[", "]", "{", "}", ",", ".", ";", ":", "=", "<", ">", "+", "-", "*", "/", "\\",
    "%", "?",
];

/// All tokens of a text; the last one is its end.
///
/// # Errors
/// [`SyntaxError`] where a token cannot be read.
pub fn tokens(text: &str) -> Result<Vec<Lexed<'_>>, SyntaxError> {
    let mut lexer = Lexer {
        rest: without_mark(text),
        at: At { line: 1, column: 1 },
    };
    if text.len() > MOST_BYTES {
        let (at, most, found) = (lexer.at, MOST_BYTES, text.len());
        return Err(SyntaxError::Large { at, most, found });
    }
    lexer.skip_file_header();
    let mut found = Vec::new();
    loop {
        lexer.skip_blank()?;
        let at = lexer.at;
        let token = lexer.token()?;
        let is_end = token == Token::End;
        found.push(Lexed { token, at });
        if is_end {
            return Ok(found);
        }
    }
}

struct Lexer<'a> {
    rest: &'a str,
    at: At,
}

impl<'a> Lexer<'a> {
    /// Takes that many bytes, which end at a character.
    fn take(&mut self, bytes: usize) -> &'a str {
        let (taken, rest) = self.rest.split_at(bytes);
        for c in taken.chars() {
            if c == '\n' {
                self.at = At {
                    line: self.at.line + 1,
                    column: 1,
                };
            } else {
                self.at.column += 1;
            }
        }
        self.rest = rest;
        taken
    }

    fn take_while(&mut self, keep: impl Fn(char) -> bool) -> &'a str {
        let end = self.rest.find(|c| !keep(c)).unwrap_or(self.rest.len());
        self.take(end)
    }

    fn peek(&self) -> Option<char> {
        self.rest.chars().next()
    }

    /// Lines between `%%%` and `%%%` at the head of a file say its version and language.
    fn skip_file_header(&mut self) {
        self.take_while(char::is_whitespace);
        let Some(inner) = self.rest.strip_prefix("%%%") else {
            return;
        };
        // What is no such line is left to be read, and refused.
        let stated =
            |line: &str| line.trim().is_empty() || line.trim().split_once(':').is_some_and(|(_, it)| is_plain(it));
        if let Some(end) = inner.find("%%%").filter(|end| inner[..*end].lines().all(stated)) {
            self.take(end + 6);
        }
    }

    fn skip_blank(&mut self) -> Result<(), SyntaxError> {
        loop {
            self.take_while(|c| c.is_whitespace() || c == '\0');
            if self.peek() != Some('!') {
                return Ok(());
            }
            self.take_while(|c| c != '\n' && c != '\r' && !is_line_end(c));
            // A comment ends with its line, and that everybody must see.
            let ends = self.rest.is_empty() || self.rest.starts_with('\n') || self.rest.starts_with("\r\n");
            if let Some(found) = self.peek().filter(|_| !ends) {
                let at = self.at;
                return Err(SyntaxError::Character { at, found });
            }
        }
    }

    fn token(&mut self) -> Result<Token<'a>, SyntaxError> {
        let Some(first) = self.peek() else {
            return Ok(Token::End);
        };
        let second = self.rest.chars().nth(1);
        if is_letter(first) {
            return self.word();
        }
        if first.is_ascii_digit() || (first == '.' && second.is_some_and(|c| c.is_ascii_digit())) {
            return self.number();
        }
        if first == '"' {
            return self.text();
        }
        match SYMBOLS.into_iter().find(|symbol| self.rest.starts_with(symbol)) {
            Some(symbol) => {
                self.take(symbol.len());
                Ok(Token::Fixed(symbol))
            }
            None if first == '|' => {
                self.take(1);
                Ok(Token::Fixed("|"))
            }
            None => Err(SyntaxError::Character {
                at: self.at,
                found: first,
            }),
        }
    }

    fn word(&mut self) -> Result<Token<'a>, SyntaxError> {
        let at = self.at;
        let word = self.take_while(|c| is_letter(c) || c.is_ascii_digit() || c == '_');
        if let Some(keyword) = keyword(word) {
            return Ok(Token::Fixed(keyword));
        }
        let found = word.chars().count();
        if found > NAME_CHARACTERS {
            let (what, most) = ("name", NAME_CHARACTERS);
            return Err(SyntaxError::Long { at, what, most, found });
        }
        Ok(Token::Name(word))
    }

    fn number(&mut self) -> Result<Token<'a>, SyntaxError> {
        let at = self.at;
        let start = self.rest;
        let lower = |c: char| c.to_ascii_lowercase();
        let radix = match (self.peek(), self.rest.chars().nth(1).map(lower)) {
            (Some('0'), Some('x')) => Some(16),
            (Some('0'), Some('o')) => Some(8),
            (Some('0'), Some('b')) => Some(2),
            _ => None,
        };
        let value = if let Some(radix) = radix {
            self.take(2);
            let digits = self.take_while(|c| c.is_ascii_alphanumeric());
            // Exact up to here, as whole numbers of a `num` are up to 2²³.
            u32::from_str_radix(digits, radix).ok().map(f64::from)
        } else {
            self.take_while(|c| c.is_ascii_digit());
            if self.peek() == Some('.') {
                self.take(1);
                self.take_while(|c| c.is_ascii_digit());
            }
            let mut ahead = self.rest.chars();
            if ahead.next().map(lower) == Some('e') {
                let sign = usize::from(matches!(ahead.next(), Some('+' | '-')));
                if self.rest.chars().nth(1 + sign).is_some_and(|c| c.is_ascii_digit()) {
                    self.take(1 + sign);
                    self.take_while(|c| c.is_ascii_digit());
                }
            }
            let written = start.get(..start.len() - self.rest.len()).unwrap_or_default();
            written.parse::<f64>().ok()
        };
        let written = || start.get(..start.len() - self.rest.len()).unwrap_or_default();
        match value {
            Some(value) if value <= f64::from(f32::MAX) && !self.peek().is_some_and(is_letter) => {
                Ok(Token::Number(value))
            }
            _ => {
                let found = written().chars().take(NAME_CHARACTERS).chain(self.peek()).collect();
                Err(SyntaxError::Number { at, found })
            }
        }
    }

    fn text(&mut self) -> Result<Token<'a>, SyntaxError> {
        let at = self.at;
        self.take(1);
        let mut text = String::new();
        loop {
            text.push_str(self.take_while(|c| !matches!(c, '"' | '\\' | '\n' | '\r')));
            match self.peek() {
                Some('"') if self.rest.starts_with("\"\"") => {
                    self.take(2);
                    text.push('"');
                }
                Some('"') => {
                    self.take(1);
                    break;
                }
                Some('\\') => text.push(self.escape()?),
                _ => return Err(SyntaxError::OpenText { at }),
            }
        }
        let found = text.chars().count();
        if found > TEXT_CHARACTERS {
            let (what, most) = ("string", TEXT_CHARACTERS);
            return Err(SyntaxError::Long { at, what, most, found });
        }
        Ok(Token::Text(text))
    }

    /// `\\` is a backslash, `\4B` the character of that code.
    fn escape(&mut self) -> Result<char, SyntaxError> {
        let at = self.at;
        if self.rest.starts_with("\\\\") {
            self.take(2);
            return Ok('\\');
        }
        let digits: String = self.rest.chars().skip(1).take(2).collect();
        let is_code = digits.len() == 2 && digits.chars().all(|c| c.is_ascii_hexdigit());
        match u8::from_str_radix(&digits, 16) {
            Ok(code) if is_code => {
                self.take(3);
                Ok(char::from(code))
            }
            _ => Err(SyntaxError::Escape {
                at,
                found: format!("{digits:?}"),
            }),
        }
    }
}

/// Whether a line of a file's header states a version or a language.
fn is_plain(value: &str) -> bool {
    value
        .chars()
        .all(|c| c.is_ascii_alphanumeric() || matches!(c, '.' | '_' | '-'))
}

/// Whether a character may end a line for a controller and does not here, so that what is behind it would be a comment to one alone.
fn is_line_end(c: char) -> bool {
    matches!(c, '\u{b}' | '\u{c}' | '\u{1a}' | '\u{85}' | '\u{2028}' | '\u{2029}')
}

/// ISO 8859-1 has letters beyond ASCII.
fn is_letter(c: char) -> bool {
    c.is_ascii_alphabetic() || (c <= '\u{ff}' && c.is_alphabetic())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(text: &str) -> Vec<Token<'_>> {
        tokens(text).unwrap().into_iter().map(|lexed| lexed.token).collect()
    }

    #[test]
    fn numbers_in_all_forms() {
        let found = all("9E9 .5 5. 0xfF 0b101 0o17 1e-3 2E+2 7");
        let values = [9e9, 0.5, 5.0, 255.0, 5.0, 15.0, 1e-3, 200.0, 7.0];
        assert_eq!(found[..9], values.map(Token::Number));
        for wrong in ["1e99", "0x", "0b12", "3x", "0xFFFFFFFFF"] {
            assert!(matches!(tokens(wrong), Err(SyntaxError::Number { .. })), "{wrong}");
        }
    }

    #[test]
    fn strings_with_quotes_and_codes() {
        assert_eq!(
            all(r#""a""b\\c\41" ! rest"#),
            [Token::Text("a\"b\\cA".to_owned()), Token::End]
        );
        assert!(matches!(tokens("\"open\n\""), Err(SyntaxError::OpenText { .. })));
        assert!(matches!(tokens(r#""\+1""#), Err(SyntaxError::Escape { .. })));
        let long = format!("\"{}\"", "x".repeat(81));
        assert!(matches!(tokens(&long), Err(SyntaxError::Long { found: 81, .. })));
    }

    #[test]
    fn a_header_comments_and_line_ends_of_either_kind() {
        let found = tokens("%%%\r\n  VERSION:1\r\n%%%\r\n! note\r\nmodule M\r\n").unwrap();
        assert_eq!(found[0].token, Token::Fixed("MODULE"));
        assert_eq!(found[0].at, At { line: 5, column: 1 });
        assert_eq!(found[1].token, Token::Name("M"));
    }
}
