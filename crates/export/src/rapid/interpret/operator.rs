//! Operators between two values, in single precision.

use super::value::Value;
use crate::rapid::syntax::ast::Operator;
use std::rc::Rc;

/// Longest string.
const TEXT_CHARACTERS: usize = 80;

/// Why an operator has no result.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoResult {
    /// It is not for such values.
    #[error("expected operands that {operator:?} is for, found {left} and {right}")]
    Operands {
        /// The operator.
        operator: Operator,
        /// What stands left of it.
        left: String,
        /// What stands right of it.
        right: String,
    },
    /// A division by zero.
    #[error("expected a divisor other than 0, found 0")]
    Zero,
    /// A result beyond what a `num` holds.
    #[error("expected a result within ±3.4E38, found {0}")]
    Beyond(f32),
    /// An operator of whole numbers between others.
    #[error("expected whole numbers, found {0} and {1}")]
    Whole(f32, f32),
    /// A string that is too long.
    #[error("expected a string of at most {TEXT_CHARACTERS} characters, found {0}")]
    Long(usize),
}

/// What an operator makes of two values.
pub fn combined(left: Value, operator: Operator, right: Value) -> Result<Value, NoResult> {
    match (left, right) {
        (Value::Num(a), Value::Num(b)) => numbers(a, operator, b),
        (Value::Truth(a), Value::Truth(b)) => truths(a, operator, b),
        (Value::Text(a), Value::Text(b)) if operator == Operator::Plus => {
            let joined = format!("{a}{b}");
            match joined.chars().count() {
                found if found > TEXT_CHARACTERS => Err(NoResult::Long(found)),
                _ => Ok(Value::Text(Rc::from(joined))),
            }
        }
        (a, b) => match (operator, a.replaced_by(b.clone())) {
            (Operator::Equal, Ok(b)) => Ok(Value::Truth(a == b)),
            (Operator::Unequal, Ok(b)) => Ok(Value::Truth(a != b)),
            _ => Err(not_for(&a, operator, &b)),
        },
    }
}

fn numbers(a: f32, operator: Operator, b: f32) -> Result<Value, NoResult> {
    let whole = a.fract() == 0.0 && b.fract() == 0.0;
    let value = match operator {
        Operator::Times => a * b,
        Operator::Plus => a + b,
        Operator::Minus => a - b,
        Operator::Over | Operator::Div | Operator::Mod if b == 0.0 => return Err(NoResult::Zero),
        Operator::Div | Operator::Mod if !whole => return Err(NoResult::Whole(a, b)),
        Operator::Over => a / b,
        Operator::Div => (a / b).trunc(),
        Operator::Mod => a % b,
        Operator::Less => return Ok(Value::Truth(a < b)),
        Operator::LessOrEqual => return Ok(Value::Truth(a <= b)),
        Operator::Greater => return Ok(Value::Truth(a > b)),
        Operator::GreaterOrEqual => return Ok(Value::Truth(a >= b)),
        Operator::Equal => return Ok(Value::Truth(a == b)),
        Operator::Unequal => return Ok(Value::Truth(a != b)),
        Operator::And | Operator::Or | Operator::Xor => {
            return Err(not_for(&Value::Num(a), operator, &Value::Num(b)));
        }
    };
    if value.is_finite() {
        Ok(Value::Num(value))
    } else {
        Err(NoResult::Beyond(value))
    }
}

fn truths(a: bool, operator: Operator, b: bool) -> Result<Value, NoResult> {
    match operator {
        Operator::And => Ok(Value::Truth(a && b)),
        Operator::Or => Ok(Value::Truth(a || b)),
        Operator::Xor | Operator::Unequal => Ok(Value::Truth(a != b)),
        Operator::Equal => Ok(Value::Truth(a == b)),
        _ => Err(not_for(&Value::Truth(a), operator, &Value::Truth(b))),
    }
}

fn not_for(left: &Value, operator: Operator, right: &Value) -> NoResult {
    NoResult::Operands {
        operator,
        left: left.kind(),
        right: right.kind(),
    }
}
