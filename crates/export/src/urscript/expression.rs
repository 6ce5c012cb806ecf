//! Words into an expression.

use super::fault::Fault;
use super::tree::{Call, Expression, Operator};
use super::words::Word;

/// Deepest nesting of an expression.
const DEEPEST: usize = 32;

/// Operators from the loosest to the tightest.
const LEVELS: [&[(&str, Operator)]; 5] = [
    &[("or", Operator::Or)],
    &[("and", Operator::And)],
    &[
        ("==", Operator::Equal),
        ("!=", Operator::Different),
        ("<=", Operator::LessOrEqual),
        (">=", Operator::GreaterOrEqual),
        ("<", Operator::Less),
        (">", Operator::Greater),
    ],
    &[("+", Operator::Plus), ("-", Operator::Minus)],
    &[("*", Operator::Times), ("/", Operator::Over)],
];

/// Words that name no variable.
pub(super) const KEYWORDS: [&str; 21] = [
    "and", "break", "continue", "def", "elif", "else", "end", "for", "global", "halt", "if", "local", "not", "or",
    "return", "run", "sec", "struct", "thread", "while", "xor",
];

/// Words that are still to be read.
pub(super) struct Words<'a> {
    words: &'a [Word],
    depth: usize,
}

impl<'a> Words<'a> {
    pub(super) fn new(words: &'a [Word]) -> Self {
        Self { words, depth: 0 }
    }

    pub(super) fn peek(&self) -> Option<&'a Word> {
        self.words.first()
    }

    pub(super) fn next(&mut self) -> Option<&'a Word> {
        let (first, rest) = self.words.split_first()?;
        self.words = rest;
        Some(first)
    }

    /// Takes a sign or keyword, if it comes next.
    pub(super) fn take(&mut self, expected: &str) -> bool {
        let is_next = match self.peek() {
            Some(Word::Sign(sign)) => *sign == expected,
            Some(Word::Name(name)) => name == expected,
            _ => false,
        };
        if is_next {
            self.next();
        }
        is_next
    }

    /// A sign that must come next.
    pub(super) fn sign(&mut self, expected: &str) -> Result<(), Fault> {
        match self.take(expected) {
            true => Ok(()),
            false => Err(self.expected(&format!("\"{expected}\""))),
        }
    }

    /// A name that must come next, no keyword.
    pub(super) fn name(&mut self) -> Result<&'a str, Fault> {
        match self.peek() {
            Some(Word::Name(name)) if !KEYWORDS.contains(&name.as_str()) => {
                self.next();
                Ok(name)
            }
            _ => Err(self.expected("a name")),
        }
    }

    /// The end of the line.
    pub(super) fn end(&self) -> Result<(), Fault> {
        match self.peek() {
            None => Ok(()),
            Some(_) => Err(self.expected("the end of the line")),
        }
    }

    /// That something else was expected here.
    pub(super) fn expected(&self, what: &str) -> Fault {
        let found = self.peek().map_or("the end of the line".to_owned(), Word::told);
        Fault::new(format!("expected {what}, found {found}"))
    }

    /// An expression.
    pub(super) fn expression(&mut self) -> Result<Expression, Fault> {
        self.level(0)
    }

    fn deeper<T>(&mut self, read: impl FnOnce(&mut Self) -> Result<T, Fault>) -> Result<T, Fault> {
        if self.depth == DEEPEST {
            return Err(Fault::new(format!(
                "an expression nested deeper than {DEEPEST} brackets"
            )));
        }
        self.depth += 1;
        let read = read(self);
        self.depth -= 1;
        read
    }

    fn level(&mut self, level: usize) -> Result<Expression, Fault> {
        let Some(operators) = LEVELS.get(level) else {
            return self.prefixed();
        };
        let mut left = self.level(level + 1)?;
        while let Some(&(_, operator)) = operators.iter().find(|(sign, _)| self.take(sign)) {
            let right = self.level(level + 1)?;
            left = Expression::Binary(operator, Box::new([left, right]));
        }
        Ok(left)
    }

    fn prefixed(&mut self) -> Result<Expression, Fault> {
        if self.take("-") {
            // A negative number is a number: it keeps its sign where it is zero, and costs nothing.
            return Ok(match self.deeper(Self::prefixed)? {
                Expression::Number(number) => Expression::Number(-number),
                other => Expression::Negative(Box::new(other)),
            });
        }
        if self.take("+") {
            return self.deeper(Self::prefixed);
        }
        if self.take("not") {
            return Ok(Expression::Not(Box::new(self.deeper(Self::prefixed)?)));
        }
        let mut value = self.deeper(Self::value)?;
        while self.take("[") {
            let index = self.deeper(Self::expression)?;
            self.sign("]")?;
            value = Expression::Index(Box::new(value), Box::new(index));
        }
        Ok(value)
    }

    fn value(&mut self) -> Result<Expression, Fault> {
        if self.take("(") {
            let inner = self.expression()?;
            self.sign(")")?;
            return Ok(inner);
        }
        if self.take("[") {
            return Ok(Expression::List(self.rest_of_list()?));
        }
        match self.peek() {
            Some(Word::Number(number)) => {
                self.next();
                Ok(Expression::Number(*number))
            }
            Some(Word::Text(text)) => {
                self.next();
                Ok(Expression::Text(text.clone()))
            }
            Some(Word::Name(_)) => self.named(),
            _ => Err(self.expected("a value")),
        }
    }

    /// What begins with a name: a constant, a pose, a call, a variable.
    fn named(&mut self) -> Result<Expression, Fault> {
        let name = self.name()?;
        match (name, self.peek()) {
            ("True" | "true", _) => Ok(Expression::Bool(true)),
            ("False" | "false", _) => Ok(Expression::Bool(false)),
            ("p", Some(Word::Sign("["))) => {
                self.next();
                Ok(Expression::Pose(self.rest_of_list()?))
            }
            (_, Some(Word::Sign("("))) => Ok(Expression::Call(self.call(name)?)),
            _ => Ok(Expression::Name(name.to_owned())),
        }
    }

    /// What stands in a list behind its opening bracket, and the closing one.
    fn rest_of_list(&mut self) -> Result<Vec<Expression>, Fault> {
        let mut entries = Vec::new();
        if self.take("]") {
            return Ok(entries);
        }
        loop {
            entries.push(self.expression()?);
            if self.take("]") {
                return Ok(entries);
            }
            if !self.take(",") {
                return Err(self.expected("\",\" or \"]\""));
            }
        }
    }

    /// The arguments of a call, and its brackets.
    pub(super) fn call(&mut self, name: &str) -> Result<Call, Fault> {
        self.sign("(")?;
        let name = name.to_owned();
        let mut arguments = Vec::new();
        if self.take(")") {
            return Ok(Call { name, arguments });
        }
        loop {
            let is_named = matches!(self.words, [Word::Name(_), Word::Sign("="), ..]);
            let argument = match is_named {
                true => {
                    let name = self.name()?.to_owned();
                    self.sign("=")?;
                    Some(name)
                }
                false => None,
            };
            arguments.push((argument, self.expression()?));
            if self.take(")") {
                return Ok(Call { name, arguments });
            }
            if !self.take(",") {
                return Err(self.expected("\",\" or \")\""));
            }
        }
    }
}
