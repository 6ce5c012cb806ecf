//! Expressions. From the tightest: `* / DIV MOD`, `+ -`, comparisons, `AND`, `OR XOR NOT`; so `NOT a AND b` is `NOT (a AND b)`.

use super::ast::{Access, Argument, Designator, Expression, ExpressionKind, Name, Operator};
use super::cursor::Cursor;
use super::error::SyntaxError;
use super::token::Token;

const EITHER: [(&str, Operator); 2] = [("OR", Operator::Or), ("XOR", Operator::Xor)];
const BOTH: [(&str, Operator); 1] = [("AND", Operator::And)];
const COMPARED: [(&str, Operator); 6] = [
    ("<", Operator::Less),
    ("<=", Operator::LessOrEqual),
    (">", Operator::Greater),
    (">=", Operator::GreaterOrEqual),
    ("=", Operator::Equal),
    ("<>", Operator::Unequal),
];
const SUMMED: [(&str, Operator); 2] = [("+", Operator::Plus), ("-", Operator::Minus)];
const SCALED: [(&str, Operator); 4] = [
    ("*", Operator::Times),
    ("/", Operator::Over),
    ("DIV", Operator::Div),
    ("MOD", Operator::Mod),
];

type Read<T> = Result<T, SyntaxError>;

impl Cursor<'_> {
    /// An expression.
    pub fn expression(&mut self) -> Read<Expression> {
        self.deeper(|this| this.chain(&EITHER, Self::conjunction))
    }

    fn chain(
        &mut self,
        operators: &[(&str, Operator)],
        operand: fn(&mut Self) -> Read<Expression>,
    ) -> Read<Expression> {
        let at = self.at();
        let first = operand(self)?;
        let mut rest = Vec::new();
        while let Some(operator) = self.eat_one(operators) {
            rest.push((operator, operand(self)?));
        }
        if rest.is_empty() {
            return Ok(first);
        }
        let kind = ExpressionKind::Chain(Box::new(first), rest);
        Ok(Expression { at, kind })
    }

    /// Operands of `AND`. A `NOT` before the first one is that of them all.
    fn conjunction(&mut self) -> Read<Expression> {
        let at = self.at();
        if self.eat("NOT") {
            let inner = self.deeper(Self::conjunction)?;
            let kind = ExpressionKind::Not(Box::new(inner));
            return Ok(Expression { at, kind });
        }
        self.chain(&BOTH, Self::relation)
    }

    fn relation(&mut self) -> Read<Expression> {
        let at = self.at();
        if self.eat("NOT") {
            let inner = self.deeper(Self::relation)?;
            let kind = ExpressionKind::Not(Box::new(inner));
            return Ok(Expression { at, kind });
        }
        let first = self.sum()?;
        let Some(operator) = self.eat_one(&COMPARED) else {
            return Ok(first);
        };
        let rest = vec![(operator, self.sum()?)];
        let kind = ExpressionKind::Chain(Box::new(first), rest);
        Ok(Expression { at, kind })
    }

    fn sum(&mut self) -> Read<Expression> {
        self.chain(&SUMMED, Self::product)
    }

    fn product(&mut self) -> Read<Expression> {
        self.chain(&SCALED, Self::primary)
    }

    fn primary(&mut self) -> Read<Expression> {
        let at = self.at();
        if self.eat("-") {
            let inner = self.deeper(Self::primary)?;
            let kind = ExpressionKind::Negative(Box::new(inner));
            return Ok(Expression { at, kind });
        }
        if self.eat("+") {
            return self.deeper(Self::primary);
        }
        if self.eat("(") {
            let inner = self.expression()?;
            self.need(")")?;
            return Ok(inner);
        }
        let kind = self.primary_kind()?;
        Ok(Expression { at, kind })
    }

    fn primary_kind(&mut self) -> Read<ExpressionKind> {
        match self.peek().clone() {
            Token::Number(value) => {
                self.step();
                Ok(ExpressionKind::Number(value))
            }
            Token::Text(text) => {
                self.step();
                Ok(ExpressionKind::Text(text.into()))
            }
            Token::Fixed(word @ ("TRUE" | "FALSE")) => {
                self.step();
                Ok(ExpressionKind::Truth(word == "TRUE"))
            }
            Token::Fixed("[") => {
                self.step();
                Ok(ExpressionKind::List(self.expressions("]")?))
            }
            Token::Name(_) => {
                let name = self.name("a name")?;
                if !self.is("(") {
                    return Ok(ExpressionKind::Read(self.designator(name)?));
                }
                self.step();
                let arguments = self.arguments(")")?;
                self.need(")")?;
                Ok(ExpressionKind::Call(name, arguments))
            }
            _ => Err(self.unexpected("an expression")),
        }
    }

    /// Expressions up to a closing symbol, which is taken.
    pub fn expressions(&mut self, end: &str) -> Read<Vec<Expression>> {
        let mut found = vec![self.expression()?];
        while self.eat(",") {
            found.push(self.expression()?);
        }
        if !self.eat(end) {
            return Err(self.unexpected(&format!("`,` or `{end}`")));
        }
        Ok(found)
    }

    /// Data or a part of them, whose name has been read.
    pub fn designator(&mut self, name: Name) -> Read<Designator> {
        let mut path = Vec::new();
        loop {
            if self.eat("{") {
                path.push(Access::Index(self.expressions("}")?));
            } else if self.eat(".") {
                path.push(Access::Component(self.name("the name of a component")?));
            } else {
                return Ok(Designator { name, path });
            }
        }
    }

    /// Arguments up to a closing symbol, which is left. The comma before `\` may be missing.
    pub fn arguments(&mut self, end: &str) -> Read<Vec<Argument>> {
        let mut found = Vec::new();
        while !self.is(end) {
            let comma = !found.is_empty() && self.eat(",");
            if self.is("\\") {
                found.push(self.optional_argument()?);
            } else if comma || found.is_empty() {
                found.push(Argument::Required(self.expression()?));
            } else {
                return Err(self.unexpected(&format!("`,`, `\\` or `{end}`")));
            }
        }
        Ok(found)
    }

    fn optional_argument(&mut self) -> Read<Argument> {
        self.need("\\")?;
        let name = self.name("the name of an optional argument")?;
        if self.eat("?") {
            return Ok(Argument::Passed(name, self.name("the name of a parameter")?));
        }
        let value = if self.eat(":=") { Some(self.expression()?) } else { None };
        Ok(Argument::Optional(name, value))
    }
}
