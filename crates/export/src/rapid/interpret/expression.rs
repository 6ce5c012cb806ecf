//! Expressions, worked out.

use super::machine::{Machine, Run};
use super::operator::combined;
use super::predefined::predefined;
use super::value::Value;
use crate::rapid::syntax::ast::{Designator, Expression, ExpressionKind};
use std::rc::Rc;

impl<'a> Machine<'a> {
    /// The value of an expression.
    pub fn evaluate(&mut self, expression: &'a Expression) -> Run<Value> {
        self.deeper(expression.at, |this| this.evaluate_here(expression))
    }

    fn evaluate_here(&mut self, expression: &'a Expression) -> Run<Value> {
        let at = expression.at;
        self.count(at, 1)?;
        match &expression.kind {
            // A `num` is a single: the nearest one.
            ExpressionKind::Number(value) => Ok(Value::Num(*value as f32)),
            ExpressionKind::Text(text) => Ok(Value::Text(Rc::clone(text))),
            ExpressionKind::Truth(truth) => Ok(Value::Truth(*truth)),
            ExpressionKind::Read(designator) => self.read(designator),
            ExpressionKind::Call(name, arguments) => self.function(name, arguments),
            ExpressionKind::List(parts) => {
                let values = parts.iter().map(|part| self.evaluate(part)).collect::<Run<_>>()?;
                Ok(Value::List(values))
            }
            ExpressionKind::Chain(first, rest) => {
                let mut value = self.evaluate(first)?;
                for (operator, operand) in rest {
                    let right = self.evaluate(operand)?;
                    self.count(at, 1)?;
                    value = match combined(value, *operator, right) {
                        Ok(value) => value,
                        Err(reason) => return self.refuse(operand.at, reason.to_string()),
                    };
                }
                Ok(value)
            }
            ExpressionKind::Negative(inner) => Ok(Value::Num(-self.number(inner)?)),
            ExpressionKind::Not(inner) => Ok(Value::Truth(!self.truth(inner)?)),
        }
    }

    fn read(&mut self, designator: &'a Designator) -> Run<Value> {
        let name = &designator.name;
        let Some(part) = self.part_of(designator)? else {
            let Some(value) = predefined(&name.key) else {
                return self.refuse(
                    name.at,
                    format!("the name {} is not declared, nor known here", name.text),
                );
            };
            let default = self.types.default_of(value.type_name).cloned();
            let Some(default) = default.filter(|_| designator.path.is_empty()) else {
                return self.refuse(
                    name.at,
                    format!("parts of the predefined {} are not modelled", name.text),
                );
            };
            return self.fitted(name.at, &default, value.value);
        };
        let Some(value) = self.value(&part).cloned() else {
            return self.refuse(name.at, format!("the value of {} depends on itself", name.text));
        };
        self.count(name.at, value.size())?;
        Ok(value)
    }

    /// The value of an expression that must be a number.
    pub fn number(&mut self, expression: &'a Expression) -> Run<f32> {
        match self.evaluate(expression)? {
            Value::Num(value) => Ok(value),
            other => self.refuse(expression.at, format!("expected a num, found {}", other.kind())),
        }
    }

    /// The value of an expression that must be true or false.
    pub fn truth(&mut self, expression: &'a Expression) -> Run<bool> {
        match self.evaluate(expression)? {
            Value::Truth(value) => Ok(value),
            other => self.refuse(expression.at, format!("expected a bool, found {}", other.kind())),
        }
    }

    /// The value of an expression that must be a string.
    pub fn text(&mut self, expression: &'a Expression) -> Run<Rc<str>> {
        match self.evaluate(expression)? {
            Value::Text(value) => Ok(value),
            other => self.refuse(expression.at, format!("expected a string, found {}", other.kind())),
        }
    }

    /// The value of an expression that must be of a record type of the controller.
    pub fn of_type(&mut self, expression: &'a Expression, type_name: &str) -> Run<Value> {
        let value = self.evaluate(expression)?;
        match self.types.default_of(type_name).cloned() {
            Some(default) => self.fitted(expression.at, &default, value),
            None => self.refuse(expression.at, format!("data of the type {type_name} are not modelled")),
        }
    }
}
