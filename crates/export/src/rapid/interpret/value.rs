//! Values, and whether one fits where another stood.

use std::rc::Rc;

/// A value.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// `num`, an IEEE single.
    Num(f32),
    /// `bool`.
    Truth(bool),
    /// `string`.
    Text(Rc<str>),
    /// A record with its components.
    Record(Rc<RecordType>, Vec<Value>),
    /// An array; of two dimensions, an array of arrays.
    Array(Vec<Value>),
    /// An aggregate, before it is known what of.
    List(Vec<Value>),
}

/// A type of records.
#[derive(Debug, PartialEq)]
pub struct RecordType {
    /// Its name.
    pub name: Rc<str>,
    /// Its components, in small letters, each with what it is by default.
    pub components: Vec<(Rc<str>, Value)>,
}

/// Why a value does not fit.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Misfit {
    /// It is of another type.
    #[error("expected {expected}, found {found}")]
    Type {
        /// What goes there.
        expected: String,
        /// What it is.
        found: String,
    },
    /// It has another number of elements.
    #[error("expected {expected} elements in {what}, found {found}")]
    Count {
        /// In what.
        what: String,
        /// How many go there.
        expected: usize,
        /// How many it has.
        found: usize,
    },
}

impl Value {
    /// What it is, in words.
    #[must_use]
    pub fn kind(&self) -> String {
        match self {
            Self::Num(_) => "a num".to_owned(),
            Self::Truth(_) => "a bool".to_owned(),
            Self::Text(_) => "a string".to_owned(),
            Self::Record(of, _) => format!("a {}", of.name),
            Self::Array(elements) => format!("an array of {}", elements.len()),
            Self::List(elements) => format!("an aggregate of {}", elements.len()),
        }
    }

    /// How many single values it holds, at least 1.
    #[must_use]
    pub fn size(&self) -> usize {
        match self {
            Self::Num(_) | Self::Truth(_) | Self::Text(_) => 1,
            Self::Record(_, parts) | Self::Array(parts) | Self::List(parts) => {
                parts.iter().map(Self::size).sum::<usize>() + 1
            }
        }
    }

    /// A value in the place of this one: of the same type, with aggregates read as records or arrays.
    pub fn replaced_by(&self, value: Self) -> Result<Self, Misfit> {
        match (self, value) {
            (Self::Num(_), value @ Self::Num(_))
            | (Self::Truth(_), value @ Self::Truth(_))
            | (Self::Text(_), value @ Self::Text(_)) => Ok(value),
            (Self::Record(of, _), value @ Self::Record(..)) if matches!(&value, Self::Record(is, _) if is.name == of.name) => {
                Ok(value)
            }
            (Self::Record(of, parts), Self::List(values)) => {
                Ok(Self::Record(Rc::clone(of), all_replaced(&self.kind(), parts, values)?))
            }
            (Self::Array(parts), Self::List(values) | Self::Array(values)) => {
                Ok(Self::Array(all_replaced(&self.kind(), parts, values)?))
            }
            (_, value) => Err(Misfit::Type {
                expected: self.kind(),
                found: value.kind(),
            }),
        }
    }
}

fn all_replaced(what: &str, parts: &[Value], values: Vec<Value>) -> Result<Vec<Value>, Misfit> {
    if parts.len() != values.len() {
        return Err(Misfit::Count {
            what: what.to_owned(),
            expected: parts.len(),
            found: values.len(),
        });
    }
    parts
        .iter()
        .zip(values)
        .map(|(part, value)| part.replaced_by(value))
        .collect()
}

/// The index of a component.
pub fn component_index(value: &Value, key: &Rc<str>) -> Option<usize> {
    match value {
        Value::Record(of, _) => of.components.iter().position(|(name, _)| name == key),
        _ => None,
    }
}

/// A component of a record that is a number.
#[must_use]
pub fn component(value: &Value, key: &str) -> Option<f32> {
    match part_of_record(value, key)? {
        Value::Num(number) => Some(*number),
        _ => None,
    }
}

/// A component of a record.
#[must_use]
pub fn part_of_record<'v>(value: &'v Value, key: &str) -> Option<&'v Value> {
    let index = component_index(value, &Rc::from(key))?;
    match value {
        Value::Record(_, parts) => parts.get(index),
        _ => None,
    }
}
