//! Lines into statements.

use super::expression::Words;
use super::fault::Fault;
use super::tree::{Branch, Expression, Function, Scope, Statement, StatementKind};
use super::words::{Word, words};
use crate::dialect::ReadError;
use crate::file::ProgramFile;
use platewash_workcell::words::quoted;

/// Most lines that are read.
const MOST_LINES: usize = 1_000_000;

/// Longest line that is read \[bytes\].
const LONGEST: usize = 10_000;

/// Deepest nesting of functions and conditions.
const DEEPEST: usize = 16;

/// Words that begin what is not read here, and why.
const NOT_READ: [(&str, &str); 9] = [
    ("while", "loops are not read: write out what moves"),
    ("for", "loops are not read: write out what moves"),
    ("break", "loops are not read"),
    ("continue", "loops are not read"),
    ("thread", "what runs beside the motion is not read"),
    ("run", "what runs beside the motion is not read"),
    ("sec", "secondary programs do not move an arm"),
    ("struct", "structs are not read"),
    ("return", "functions that return something are not read"),
];

/// The statements of a program.
pub(super) fn program(file: &ProgramFile) -> Result<Vec<Statement>, ReadError> {
    let mut lines = Vec::new();
    for (index, text) in file.text.trim_start_matches('\u{feff}').lines().enumerate() {
        let line = index + 1;
        if index == MOST_LINES {
            return Err(ReadError::at(
                &file.name,
                line,
                format!("more than {MOST_LINES} lines, the most that are read"),
            ));
        }
        if text.len() > LONGEST {
            return Err(ReadError::at(
                &file.name,
                line,
                format!("a line of more than {LONGEST} bytes, the most that are read"),
            ));
        }
        let words = words(text).map_err(|fault| fault.at(&file.name, line))?;
        if !words.is_empty() {
            lines.push((line, words));
        }
    }
    let mut reader = Reader {
        file: &file.name,
        lines: lines.iter(),
        depth: 0,
    };
    let (statements, end) = reader.block()?;
    match end {
        None => Ok(statements),
        Some((line, closing)) => Err(ReadError::at(
            &file.name,
            line,
            format!("\"{}\" closes nothing", closing.word()),
        )),
    }
}

/// What ends a block.
#[derive(Clone)]
enum Closing {
    End,
    Else,
    Elif(Expression),
}

impl Closing {
    fn word(&self) -> &'static str {
        match self {
            Self::End => "end",
            Self::Else => "else",
            Self::Elif(_) => "elif",
        }
    }
}

type Line = (usize, Vec<Word>);

/// What ended a block, and the line.
type Closed = (usize, Closing);

struct Reader<'a> {
    file: &'a str,
    lines: std::slice::Iter<'a, Line>,
    depth: usize,
}

impl<'a> Reader<'a> {
    /// Statements up to what closes them, and that with its line; none at the end of the text.
    fn block(&mut self) -> Result<(Vec<Statement>, Option<Closed>), ReadError> {
        let mut statements = Vec::new();
        while let Some((line, words)) = self.lines.next() {
            let mut words = Words::new(words);
            if let Some(closing) = self.at(*line, closing(&mut words))? {
                return Ok((statements, Some((*line, closing))));
            }
            statements.push(self.statement(*line, words)?);
        }
        Ok((statements, None))
    }

    fn at<T>(&self, line: usize, read: Result<T, Fault>) -> Result<T, ReadError> {
        read.map_err(|fault| fault.at(self.file, line))
    }

    fn statement(&mut self, line: usize, mut words: Words<'a>) -> Result<Statement, ReadError> {
        let kind = if words.take("def") {
            let (name, parameters) = self.at(line, head(&mut words))?;
            let (body, closing) = self.nested(line, "def")?;
            if !matches!(closing.1, Closing::End) {
                return Err(ReadError::at(
                    self.file,
                    closing.0,
                    format!("\"{}\" without its \"if\"", closing.1.word()),
                ));
            }
            StatementKind::Function(Function { name, parameters, body })
        } else if words.take("if") {
            let condition = self.at(line, condition(&mut words))?;
            self.branches(line, condition)?
        } else {
            self.at(line, simple(&mut words))?
        };
        Ok(Statement { line, kind })
    }

    /// The branches of an `if` up to its `end`.
    fn branches(&mut self, line: usize, condition: Expression) -> Result<StatementKind, ReadError> {
        let mut branches = Vec::new();
        let mut next = (line, Some(condition));
        loop {
            let (body, (closed, closing)) = self.nested(line, "if")?;
            let is_last = next.1.is_none();
            branches.push(Branch {
                line: next.0,
                condition: next.1,
                body,
            });
            next = match closing {
                Closing::End => return Ok(StatementKind::If(branches)),
                _ if is_last => {
                    let reason = format!("\"{}\" behind \"else\"; expected \"end\"", closing.word());
                    return Err(ReadError::at(self.file, closed, reason));
                }
                Closing::Else => (closed, None),
                Closing::Elif(condition) => (closed, Some(condition)),
            };
        }
    }

    /// A block that must be closed.
    fn nested(&mut self, line: usize, what: &str) -> Result<(Vec<Statement>, Closed), ReadError> {
        if self.depth == DEEPEST {
            let reason = format!("functions and conditions nested deeper than {DEEPEST}");
            return Err(ReadError::at(self.file, line, reason));
        }
        self.depth += 1;
        let (statements, closing) = self.block()?;
        self.depth -= 1;
        match closing {
            Some(closing) => Ok((statements, closing)),
            None => Err(ReadError::at(
                self.file,
                line,
                format!("this \"{what}\" has no \"end\""),
            )),
        }
    }
}

/// Whether a line closes a block.
fn closing(words: &mut Words<'_>) -> Result<Option<Closing>, Fault> {
    let closing = if words.take("end") {
        Closing::End
    } else if words.take("else") {
        words.sign(":")?;
        Closing::Else
    } else if words.take("elif") {
        return condition(words).map(|condition| Some(Closing::Elif(condition)));
    } else {
        return Ok(None);
    };
    words.end()?;
    Ok(Some(closing))
}

/// `CONDITION:` and the end of the line.
fn condition(words: &mut Words<'_>) -> Result<Expression, Fault> {
    let condition = words.expression()?;
    words.sign(":")?;
    words.end()?;
    Ok(condition)
}

/// `NAME(PARAMETERS):` and the end of the line.
fn head(words: &mut Words<'_>) -> Result<(String, Vec<String>), Fault> {
    let name = words.name()?.to_owned();
    words.sign("(")?;
    let mut parameters = Vec::new();
    if !words.take(")") {
        loop {
            let parameter = words.name()?.to_owned();
            if parameters.contains(&parameter) {
                return Err(Fault::new(format!("two parameters {}", quoted(&parameter))));
            }
            parameters.push(parameter);
            if words.take(")") {
                break;
            }
            words.sign(",")?;
        }
    }
    words.sign(":")?;
    words.end()?;
    Ok((name, parameters))
}

/// A statement of one line.
fn simple(words: &mut Words<'_>) -> Result<StatementKind, Fault> {
    if let Some(Word::Name(name)) = words.peek()
        && let Some((word, reason)) = NOT_READ.into_iter().find(|(word, _)| word == name)
    {
        return Err(Fault::new(format!("\"{word}\": {reason}")));
    }
    let kind = if words.take("halt") {
        StatementKind::Halt
    } else {
        let scope = match (words.take("local"), words.take("global")) {
            (true, false) => Scope::Local,
            (false, true) => Scope::Global,
            (false, false) => Scope::Unsaid,
            (true, true) => return Err(Fault::new("expected a name, found \"global\"")),
        };
        let name = words.name()?;
        if scope == Scope::Unsaid && matches!(words.peek(), Some(Word::Sign("("))) {
            StatementKind::Call(words.call(name)?)
        } else if words.take("=") {
            StatementKind::Assignment(scope, name.to_owned(), words.expression()?)
        } else {
            return Err(words.expected("\"=\" or \"(\""));
        }
    };
    words.end()?;
    Ok(kind)
}
