//! Modules as data and procedures.

use super::names::is_taken;
use crate::dialect::ReadError;
use crate::file::{Place, ProgramFile};
use crate::tokens::{self, Token};
use std::collections::HashMap;

/// Most files and lines that are read.
const MOST_LINES: usize = 1_000_000;

/// Deepest nesting of brackets in a value.
const DEEPEST: usize = 8;

/// A token and its line, from 1.
#[derive(Debug, Clone)]
pub(super) struct Placed {
    pub(super) token: Token,
    pub(super) line: usize,
}

/// A value of literals.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    /// A number, as the controller's single.
    Number(f32),
    Truth(bool),
    Text,
    List(Vec<Value>),
}

/// Declared data.
#[derive(Debug)]
pub(super) struct Data {
    pub(super) place: Place,
    /// Its type, in small letters.
    pub(super) type_name: String,
    pub(super) is_constant: bool,
    /// `None` where none is stated.
    pub(super) value: Option<Value>,
}

/// A procedure.
#[derive(Debug)]
pub(super) struct Procedure {
    pub(super) place: Place,
    /// Its name, as it stands.
    pub(super) name: String,
    /// What stands between the brackets behind its name.
    pub(super) parameters: Vec<Placed>,
    /// What stands before `ENDPROC`.
    pub(super) body: Vec<Placed>,
}

/// The modules of a program; names in small letters.
#[derive(Debug, Default)]
pub(super) struct Modules {
    pub(super) data: HashMap<String, Data>,
    pub(super) procedures: HashMap<String, Procedure>,
    names: HashMap<String, Place>,
}

/// Reads all modules.
///
/// # Errors
/// [`ReadError`] with the line of what is not read.
pub(super) fn modules(files: &[ProgramFile]) -> Result<Modules, ReadError> {
    let mut modules = Modules::default();
    for file in files {
        let tokens = placed(file)?;
        let mut cursor = Cursor::new(&file.name, &tokens);
        while cursor.peek().is_some() {
            modules.module(&mut cursor)?;
        }
    }
    Ok(modules)
}

/// The tokens of a file, but for the header of files that a controller has saved.
fn placed(file: &ProgramFile) -> Result<Vec<Placed>, ReadError> {
    let mut all = Vec::new();
    let text = file.text.trim_start_matches('\u{feff}');
    let mut marks = 0;
    for (index, text) in text.lines().enumerate() {
        let line = index + 1;
        if line > MOST_LINES {
            return Err(ReadError::at(
                &file.name,
                line,
                format!("more than {MOST_LINES} lines, the most that are read"),
            ));
        }
        if all.is_empty() && marks < 2 && text.trim() == "%%%" {
            marks += 1;
            continue;
        }
        if marks == 1
            && ["VERSION:", "LANGUAGE:"]
                .iter()
                .any(|key| text.trim_start().starts_with(key))
        {
            continue;
        }
        let add = |token| all.push(Placed { token, line });
        tokens::line(text, '!', add).map_err(|reason| ReadError::at(&file.name, line, reason))?;
    }
    Ok(all)
}

impl Modules {
    fn module(&mut self, cursor: &mut Cursor<'_>) -> Result<(), ReadError> {
        cursor.keyword("MODULE")?;
        self.declare(cursor)?;
        if cursor.takes_sign("(") {
            while !cursor.takes_sign(")") {
                cursor.next("`)`")?;
            }
        }
        while !cursor.takes("ENDMODULE") {
            let is_task = cursor.takes("TASK");
            if cursor.takes("PROC") {
                self.procedure(cursor)?;
            } else if let Some(storage) = ["CONST", "PERS", "VAR"].into_iter().find(|word| cursor.takes(word)) {
                self.data(cursor, storage == "CONST")?;
            } else {
                let expected = if is_task {
                    "data"
                } else {
                    "CONST, PERS, VAR, PROC without LOCAL, or ENDMODULE"
                };
                return Err(cursor.expected(expected));
            }
        }
        Ok(())
    }

    /// A name that is declared once, and its place.
    fn declare(&mut self, cursor: &mut Cursor<'_>) -> Result<(String, Place), ReadError> {
        let place = cursor.place();
        let name = cursor.word("a name")?;
        let refused = |reason| ReadError {
            place: place.clone(),
            reason,
        };
        if is_taken(&name) {
            return Err(refused(format!("the name {name} is the controller's own")));
        }
        if let Some(other) = self.names.insert(name.to_ascii_lowercase(), place.clone()) {
            return Err(refused(format!("{name} is declared twice; see {other}")));
        }
        Ok((name, place))
    }

    fn data(&mut self, cursor: &mut Cursor<'_>, is_constant: bool) -> Result<(), ReadError> {
        let type_name = cursor.word("a type")?.to_ascii_lowercase();
        let (name, place) = self.declare(cursor)?;
        let value = cursor.takes_sign(":=").then(|| cursor.value(0)).transpose()?;
        cursor.sign(";")?;
        let data = Data {
            place,
            type_name,
            is_constant,
            value,
        };
        self.data.insert(name.to_ascii_lowercase(), data);
        Ok(())
    }

    fn procedure(&mut self, cursor: &mut Cursor<'_>) -> Result<(), ReadError> {
        let (name, place) = self.declare(cursor)?;
        cursor.sign("(")?;
        let parameters = cursor.up_to(|token| token.is(")"), "`)`")?;
        let body = cursor.up_to(|token| token.is_same(&Token::Word("ENDPROC".to_owned())), "ENDPROC")?;
        let key = name.to_ascii_lowercase();
        self.procedures.insert(
            key,
            Procedure {
                place,
                name,
                parameters,
                body,
            },
        );
        Ok(())
    }
}

/// Tokens one by one.
#[derive(Debug, Clone)]
pub(super) struct Cursor<'a> {
    file: &'a str,
    tokens: &'a [Placed],
    at: usize,
}

impl<'a> Cursor<'a> {
    pub(super) fn new(file: &'a str, tokens: &'a [Placed]) -> Self {
        Self { file, tokens, at: 0 }
    }

    pub(super) fn peek(&self) -> Option<&'a Token> {
        self.tokens.get(self.at).map(|placed| &placed.token)
    }

    /// The place of the next token; at the end that of the last one.
    pub(super) fn place(&self) -> Place {
        let line = self
            .tokens
            .get(self.at)
            .or(self.tokens.last())
            .map_or(1, |placed| placed.line);
        Place {
            file: self.file.to_owned(),
            line,
        }
    }

    pub(super) fn refused(&self, reason: impl Into<String>) -> ReadError {
        ReadError {
            place: self.place(),
            reason: reason.into(),
        }
    }

    pub(super) fn expected(&self, what: &str) -> ReadError {
        let found = self.peek().map_or_else(|| "the end".to_owned(), ToString::to_string);
        self.refused(format!("expected {what}, found {found}"))
    }

    pub(super) fn next(&mut self, expected: &str) -> Result<&'a Token, ReadError> {
        let token = self.peek().ok_or_else(|| self.expected(expected))?;
        self.at += 1;
        Ok(token)
    }

    pub(super) fn word(&mut self, expected: &str) -> Result<String, ReadError> {
        match self.peek() {
            Some(Token::Word(word)) => {
                self.at += 1;
                Ok(word.clone())
            }
            _ => Err(self.expected(expected)),
        }
    }

    /// Whether the next token is that word, which is taken then.
    pub(super) fn takes(&mut self, word: &str) -> bool {
        let is_it = matches!(self.peek(), Some(Token::Word(found)) if found.eq_ignore_ascii_case(word));
        self.at += usize::from(is_it);
        is_it
    }

    pub(super) fn keyword(&mut self, word: &str) -> Result<(), ReadError> {
        match self.takes(word) {
            true => Ok(()),
            false => Err(self.expected(&format!("`{word}`"))),
        }
    }

    pub(super) fn takes_sign(&mut self, sign: &str) -> bool {
        let is_it = self.peek().is_some_and(|token| token.is(sign));
        self.at += usize::from(is_it);
        is_it
    }

    pub(super) fn sign(&mut self, sign: &str) -> Result<(), ReadError> {
        match self.takes_sign(sign) {
            true => Ok(()),
            false => Err(self.expected(&format!("`{sign}`"))),
        }
    }

    /// The tokens before the first one that ends them, which is taken, too.
    pub(super) fn up_to(&mut self, ends: impl Fn(&Token) -> bool, expected: &str) -> Result<Vec<Placed>, ReadError> {
        let from = self.at;
        while !ends(self.next(expected)?) {}
        Ok(self.tokens[from..self.at - 1].to_vec())
    }

    /// A value of literals.
    pub(super) fn value(&mut self, depth: usize) -> Result<Value, ReadError> {
        if depth > DEEPEST {
            return Err(self.refused(format!("brackets nested deeper than {DEEPEST}")));
        }
        if self.takes_sign("[") {
            let mut values = vec![self.value(depth + 1)?];
            while self.takes_sign(",") {
                values.push(self.value(depth + 1)?);
            }
            self.sign("]")?;
            return Ok(Value::List(values));
        }
        if self.takes("TRUE") {
            return Ok(Value::Truth(true));
        }
        if self.takes("FALSE") {
            return Ok(Value::Truth(false));
        }
        if let Some(Token::Text(_)) = self.peek() {
            self.at += 1;
            return Ok(Value::Text);
        }
        self.number().map(Value::Number)
    }

    /// A literal number, as the controller's single.
    pub(super) fn number(&mut self) -> Result<f32, ReadError> {
        let sign = match self.takes_sign("-") {
            true => -1.0,
            false => {
                self.takes_sign("+");
                1.0
            }
        };
        match self.peek() {
            Some(Token::Number(number)) if *number <= f64::from(f32::MAX) => {
                self.at += 1;
                Ok((sign * number) as f32)
            }
            _ => Err(self.expected("a number")),
        }
    }
}
