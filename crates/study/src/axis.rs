//! An axis of a study: a key and the values that it takes, one after the other.

use serde::{Deserialize, Serialize};
use serde_json::Value;

/// An axis: a scenario's key, and its values in order.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// The scenario's key, as `tool.length_m` or `plate[0].at_m`.
    pub key: String,
    pub(crate) values: Values,
}

/// The values of an axis.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Values {
    /// One by one.
    Listed(Vec<Value>),
    /// A number of consecutive seeds from the first on; they are not stored.
    Seeds {
        /// The first.
        first: u64,
        /// Number of seeds.
        count: u64,
    },
}

/// Common kind of an axis's values, which decides the columns of tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AxisKind {
    /// True or false.
    Flag,
    /// Integers.
    Whole,
    /// Numbers.
    Number,
    /// Texts.
    Text,
    /// Lists of numbers, each of the given length.
    Numbers(usize),
    /// Anything else, or values of several kinds.
    Json,
}

impl AxisKind {
    /// Kind of values, of which there is at least one.
    pub(crate) fn of_all<'a>(values: impl IntoIterator<Item = &'a Value>) -> Self {
        let kinds = values.into_iter().map(Self::from_value);
        kinds.reduce(Self::with).unwrap_or(Self::Json)
    }

    fn from_value(value: &Value) -> Self {
        match value {
            Value::Bool(_) => Self::Flag,
            Value::Number(number) if number.is_i64() => Self::Whole,
            Value::Number(_) => Self::Number,
            Value::String(_) => Self::Text,
            Value::Array(parts) if !parts.is_empty() && parts.iter().all(Value::is_number) => {
                Self::Numbers(parts.len())
            }
            _ => Self::Json,
        }
    }

    /// Checks that a value is of this kind.
    pub(crate) fn fits(self, value: &Value) -> bool {
        Self::from_value(value).with(self) == self
    }

    fn with(self, other: Self) -> Self {
        match (self, other) {
            (one, other) if one == other => one,
            (Self::Whole | Self::Number, Self::Whole | Self::Number) => Self::Number,
            _ => Self::Json,
        }
    }
}

impl Axis {
    /// Common kind of its values.
    #[must_use]
    pub fn kind(&self) -> AxisKind {
        match &self.values {
            Values::Listed(values) => AxisKind::of_all(values),
            Values::Seeds { .. } => AxisKind::Whole,
        }
    }

    /// Number of values.
    #[must_use]
    pub fn count(&self) -> u64 {
        match &self.values {
            Values::Listed(values) => values.len() as u64,
            Values::Seeds { count, .. } => *count,
        }
    }

    /// A value by its place; `None` beyond the last.
    #[must_use]
    pub fn value(&self, place: u64) -> Option<Value> {
        match &self.values {
            Values::Listed(values) => values.get(usize::try_from(place).ok()?).cloned(),
            Values::Seeds { first, count } => (place < *count).then(|| Value::from(first + place)),
        }
    }
}

/// Evenly spaced values, both ends included, which are met exactly.
pub(crate) fn spaced(from: f64, to: f64, count: usize) -> Vec<Value> {
    let last = count.saturating_sub(1);
    let at = |i: usize| match i {
        0 => from,
        i if i == last => to,
        i => from + (to - from) * (i as f64 / last as f64),
    };
    (0..count).map(|i| Value::from(at(i))).collect()
}

/// A value as text that is the same for all ways of writing it: 1 and 1.0 are one number.
pub(crate) fn canonical(value: &Value) -> String {
    match value {
        Value::Number(number) => number
            .as_f64()
            .map_or_else(|| number.to_string(), |v| format!("{}", v + 0.0)),
        Value::Array(values) => format!("[{}]", values.iter().map(canonical).collect::<Vec<_>>().join(",")),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ends_of_a_range_are_met_exactly() {
        let values = spaced(0.1, 0.3, 3);
        assert_eq!((&values[0], &values[2]), (&Value::from(0.1), &Value::from(0.3)));
        assert_eq!(values.len(), 3);
        assert_eq!(spaced(0.1, 0.1, 1), [Value::from(0.1)]);
    }

    #[test]
    fn the_kind_of_an_axis_fits_all_values() {
        let of = |text: &str| AxisKind::of_all(&serde_json::from_str::<Vec<Value>>(text).unwrap());
        let (number, json) = (AxisKind::Number, AxisKind::Json);
        for (values, kind) in [
            ("[true, false]", AxisKind::Flag),
            ("[-1, 9007199254740993]", AxisKind::Whole),
            ("[1, 0.15]", number),
            ("[18446744073709551615]", number),
            ("[\"a\"]", AxisKind::Text),
            ("[[1, 2.5], [0.1, 0]]", AxisKind::Numbers(2)),
            ("[[1, 2], [1, 2, 3]]", json),
            ("[[], [[1]]]", json),
            ("[1, true]", json),
            ("[1, \"1\", 2]", json),
        ] {
            assert_eq!(of(values), kind, "{values}");
        }
    }

    #[test]
    fn equal_numbers_have_equal_texts() {
        let of = |text: &str| canonical(&serde_json::from_str(text).unwrap());
        assert_eq!(of("[1, -0.0]"), of("[1.0, 0]"));
        assert_ne!(of("1"), of("\"1\""));
    }
}
