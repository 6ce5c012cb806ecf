//! An axis of a study: a key and the values that it takes, one after the other.

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
    /// Seeds, so many from the first on: they are counted, not kept.
    Seeds {
        /// The first.
        first: u64,
        /// How many.
        count: u64,
    },
}

impl Axis {
    /// How many values there are.
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
    fn one_number_has_one_text() {
        let of = |text: &str| canonical(&serde_json::from_str(text).unwrap());
        assert_eq!(of("[1, -0.0]"), of("[1.0, 0]"));
        assert_ne!(of("1"), of("\"1\""));
    }
}
