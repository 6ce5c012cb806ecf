//! Statements.

use super::ast::{Expression, For, Statement, StatementKind};
use super::cursor::Cursor;
use super::error::SyntaxError;
use super::token::Token;

type Read<T> = Result<T, SyntaxError>;

/// Keywords that a statement begins with.
const BEGINNINGS: [&str; 12] = [
    "IF", "FOR", "WHILE", "TEST", "GOTO", "RETURN", "EXIT", "RAISE", "RETRY", "TRYNEXT", "CONNECT", "%",
];

impl Cursor<'_> {
    /// Statements, as many as there are.
    pub fn statements(&mut self) -> Read<Vec<Statement>> {
        let mut found = Vec::new();
        loop {
            let begins = match self.peek() {
                Token::Name(_) => true,
                Token::Fixed(word) => BEGINNINGS.contains(word),
                _ => false,
            };
            if !begins {
                return Ok(found);
            }
            found.push(self.deeper(Self::statement)?);
        }
    }

    fn statement(&mut self) -> Read<Statement> {
        let at = self.at();
        let kind = match *self.peek() {
            Token::Fixed("IF") => self.condition()?,
            Token::Fixed("FOR") => self.counting()?,
            Token::Fixed("WHILE") => self.while_loop()?,
            Token::Fixed("TEST") => self.test()?,
            _ => self.simple()?,
        };
        Ok(Statement { at, kind })
    }

    fn condition(&mut self) -> Read<StatementKind> {
        self.need("IF")?;
        let condition = self.expression()?;
        if !self.eat("THEN") {
            return self.compact(condition);
        }
        let mut branches = vec![(condition, self.statements()?)];
        while self.eat("ELSEIF") {
            let condition = self.expression()?;
            self.need("THEN")?;
            branches.push((condition, self.statements()?));
        }
        let otherwise = if self.eat("ELSE") {
            self.statements()?
        } else {
            Vec::new()
        };
        self.close("ENDIF")?;
        Ok(StatementKind::If(branches, otherwise))
    }

    /// `IF condition statement`, without `THEN`.
    fn compact(&mut self, condition: Expression) -> Read<StatementKind> {
        let begins = matches!(self.peek(), Token::Name(_))
            || matches!(self.peek(), Token::Fixed(word) if BEGINNINGS.contains(word));
        if !begins {
            return Err(self.unexpected("`THEN` or a statement"));
        }
        let statement = self.deeper(Self::statement)?;
        Ok(StatementKind::If(vec![(condition, vec![statement])], Vec::new()))
    }

    fn counting(&mut self) -> Read<StatementKind> {
        self.need("FOR")?;
        let name = self.name("the name of what counts")?;
        self.need("FROM")?;
        let from = self.expression()?;
        self.need("TO")?;
        let to = self.expression()?;
        let step = if self.eat("STEP") {
            Some(self.expression()?)
        } else {
            None
        };
        self.need("DO")?;
        let body = self.statements()?;
        self.close("ENDFOR")?;
        Ok(StatementKind::For(Box::new(For {
            name,
            from,
            to,
            step,
            body,
        })))
    }

    fn while_loop(&mut self) -> Read<StatementKind> {
        self.need("WHILE")?;
        let condition = self.expression()?;
        self.need("DO")?;
        let body = self.statements()?;
        self.close("ENDWHILE")?;
        Ok(StatementKind::While(condition, body))
    }

    fn test(&mut self) -> Read<StatementKind> {
        self.need("TEST")?;
        let value = self.expression()?;
        let mut cases = Vec::new();
        while self.eat("CASE") {
            let values = self.expressions(":")?;
            cases.push((values, self.statements()?));
        }
        let mut otherwise = Vec::new();
        if self.eat("DEFAULT") {
            self.need(":")?;
            otherwise = self.statements()?;
        }
        self.close("ENDTEST")?;
        Ok(StatementKind::Test(value, cases, otherwise))
    }

    /// The end of a block.
    fn close(&mut self, end: &str) -> Read<()> {
        if self.eat(end) {
            return Ok(());
        }
        Err(self.unexpected(&format!("a statement or `{end}`")))
    }

    /// Statements that end with a semicolon, and labels.
    fn simple(&mut self) -> Read<StatementKind> {
        if self.is_label() {
            let name = self.name("a label")?;
            self.need(":")?;
            return Ok(StatementKind::Label(name));
        }
        let kind = match *self.peek() {
            Token::Name(_) => return self.assignment_or_call(),
            Token::Fixed("%") => return self.late_call(),
            Token::Fixed("GOTO") => {
                self.step();
                StatementKind::Goto(self.name("a label")?)
            }
            Token::Fixed("RETURN") => {
                self.step();
                StatementKind::Return(self.value_if_any()?)
            }
            Token::Fixed("RAISE") => {
                self.step();
                StatementKind::Raise(self.value_if_any()?)
            }
            Token::Fixed("CONNECT") => {
                self.step();
                let name = self.name("the name of an interrupt")?;
                let target = self.designator(name)?;
                self.need("WITH")?;
                StatementKind::Connect(target, self.name("the name of a trap")?)
            }
            _ => self.single_word()?,
        };
        self.need(";")?;
        Ok(kind)
    }

    fn single_word(&mut self) -> Read<StatementKind> {
        let words = [("EXIT", 0), ("RETRY", 1), ("TRYNEXT", 2)];
        match self.eat_one(&words) {
            Some(0) => Ok(StatementKind::Exit),
            Some(1) => Ok(StatementKind::Retry),
            Some(_) => Ok(StatementKind::TryNext),
            None => Err(self.unexpected("a statement")),
        }
    }

    fn value_if_any(&mut self) -> Read<Option<Expression>> {
        if self.is(";") {
            Ok(None)
        } else {
            self.expression().map(Some)
        }
    }

    fn assignment_or_call(&mut self) -> Read<StatementKind> {
        let name = self.name("a name")?;
        if matches!(self.peek(), Token::Fixed("{" | "." | ":=")) {
            let target = self.designator(name)?;
            self.need(":=")?;
            let value = self.expression()?;
            self.need(";")?;
            return Ok(StatementKind::Assign(target, value));
        }
        let arguments = self.arguments(";")?;
        self.need(";")?;
        Ok(StatementKind::Call(name, arguments))
    }

    fn late_call(&mut self) -> Read<StatementKind> {
        self.need("%")?;
        let name = self.expression()?;
        self.need("%")?;
        let arguments = self.arguments(";")?;
        self.need(";")?;
        Ok(StatementKind::LateCall(name, arguments))
    }
}
