//! Values, and what is computed with them.

use super::fault::Fault;
use super::tree::Operator;

/// A value.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    Number(f64),
    Bool(bool),
    Text(String),
    List(Vec<f64>),
    /// Position \[m\] and rotation vector \[rad\].
    Pose([f64; 6]),
    /// What only the arm knows, and what is computed from it, while it is not asked.
    Unknown,
}

impl Value {
    /// As a message says it.
    pub(super) fn told(&self) -> &'static str {
        match self {
            Self::Number(_) => "a number",
            Self::Bool(_) => "True or False",
            Self::Text(_) => "a text",
            Self::List(_) => "a list",
            Self::Pose(_) => "a pose",
            Self::Unknown => "a measured value",
        }
    }

    /// A number.
    pub(super) fn number(&self) -> Result<f64, Fault> {
        match self {
            Self::Number(number) => Ok(*number),
            other => Err(Fault::new(format!("expected a number, found {}", other.told()))),
        }
    }

    /// As many numbers as `count`, in a list.
    pub(super) fn list<const COUNT: usize>(&self) -> Result<[f64; COUNT], Fault> {
        match self {
            Self::List(list) => <[f64; COUNT]>::try_from(list.as_slice()).map_err(|_| {
                Fault::new(format!(
                    "expected a list of {COUNT} numbers, found one of {}",
                    list.len()
                ))
            }),
            other => Err(Fault::new(format!(
                "expected a list of {COUNT} numbers, found {}",
                other.told()
            ))),
        }
    }

    /// A pose.
    pub(super) fn pose(&self) -> Result<[f64; 6], Fault> {
        match self {
            Self::Pose(pose) => Ok(*pose),
            other => Err(Fault::new(format!(
                "expected a pose p[x, y, z, rx, ry, rz], found {}",
                other.told()
            ))),
        }
    }

    /// An entry of a list or pose, from 0.
    pub(super) fn entry(&self, index: &Self) -> Result<Self, Fault> {
        let numbers: &[f64] = match (self, index) {
            (Self::Unknown, _) | (_, Self::Unknown) => return Ok(Self::Unknown),
            (Self::List(list), _) => list,
            (Self::Pose(pose), _) => pose,
            _ => {
                return Err(Fault::new(format!(
                    "expected a list or pose before \"[\", found {}",
                    self.told()
                )));
            }
        };
        let at = index.number()?;
        let entry = (0..numbers.len())
            .find(|&k| k as f64 == at)
            .and_then(|k| numbers.get(k));
        match entry {
            Some(&number) => Ok(Self::Number(number)),
            None => Err(Fault::new(format!(
                "no entry {at}: they are counted from 0 and are {}",
                numbers.len()
            ))),
        }
    }

    /// `-x`
    pub(super) fn negative(&self) -> Result<Self, Fault> {
        match self {
            Self::Unknown => Ok(Self::Unknown),
            other => Ok(Self::Number(-other.number()?)),
        }
    }

    /// `not x`
    pub(super) fn not(&self) -> Result<Self, Fault> {
        match self {
            Self::Unknown => Ok(Self::Unknown),
            Self::Bool(is) => Ok(Self::Bool(!is)),
            other => Err(Fault::new(format!("expected True or False, found {}", other.told()))),
        }
    }

    /// A function of one value: `norm`, `d2r`, `r2d`.
    pub(super) fn function(&self, name: &str) -> Result<Self, Fault> {
        let number = match (name, self) {
            (_, Self::Unknown) => return Ok(Self::Unknown),
            ("norm", Self::List(list)) => list.iter().map(|x| x * x).sum::<f64>().sqrt(),
            ("norm", value) => value.number()?.abs(),
            ("d2r", value) => value.number()?.to_radians(),
            (_, value) => value.number()?.to_degrees(),
        };
        finite(number)
    }
}

fn finite(number: f64) -> Result<Value, Fault> {
    match number.is_finite() {
        true => Ok(Value::Number(number)),
        false => Err(Fault::new(format!("the result is {number}, no number to go by"))),
    }
}

/// What an operator makes of two values.
pub(super) fn binary(operator: Operator, [left, right]: [&Value; 2]) -> Result<Value, Fault> {
    if matches!(left, Value::Unknown) || matches!(right, Value::Unknown) {
        return Ok(Value::Unknown);
    }
    match operator {
        Operator::And | Operator::Or => match (left, right) {
            (Value::Bool(a), Value::Bool(b)) => Ok(Value::Bool(match operator {
                Operator::And => *a && *b,
                _ => *a || *b,
            })),
            (Value::Bool(_), other) | (other, _) => {
                Err(Fault::new(format!("expected True or False, found {}", other.told())))
            }
        },
        Operator::Plus => finite(left.number()? + right.number()?),
        Operator::Minus => finite(left.number()? - right.number()?),
        Operator::Times => finite(left.number()? * right.number()?),
        Operator::Over => finite(left.number()? / right.number()?),
        _ => compared(operator, left.number()?, right.number()?),
    }
}

fn compared(operator: Operator, left: f64, right: f64) -> Result<Value, Fault> {
    Ok(Value::Bool(match operator {
        Operator::Equal => left == right,
        Operator::Different => left != right,
        Operator::Less => left < right,
        Operator::LessOrEqual => left <= right,
        Operator::Greater => left > right,
        _ => left >= right,
    }))
}
