//! Numbers as a certificate tells them.

use crate::check::{Measure, Sense, Unit};
use platewash_kinematics::words::{decimals_down, decimals_up, percent, rounded};

/// Significant digits of a number that are told at most.
const DIGITS: usize = 9;

/// A length in millimetres, as short as it is.
pub(crate) fn mm(length_m: f64) -> String {
    number(1e3 * length_m)
}

/// A number as people write it: as short as it is, up to nine digits.
pub(crate) fn number(value: f64) -> String {
    // A negative zero is 0.
    let told = rounded(value, DIGITS) + 0.0;
    if told == 0.0 || (1e-6..=1e6).contains(&told.abs()) {
        told.to_string()
    } else {
        format!("{told:e}")
    }
}

/// Numbers with commas between.
pub(crate) fn list(numbers: impl IntoIterator<Item = f64>) -> String {
    let each: Vec<_> = numbers.into_iter().map(number).collect();
    each.join(", ")
}

/// Decimals beyond which a bound and its limit are the same number.
const MOST_DECIMALS: usize = 9;

impl Unit {
    /// Factor and unit in which people read a quantity.
    #[must_use]
    pub fn scale(self) -> (f64, &'static str) {
        match self {
            Self::Radian => (180.0 / std::f64::consts::PI, "°"),
            Self::RadianPerSecond => (1.0, "rad/s"),
            Self::RadianPerSecondSquared => (1.0, "rad/s²"),
            Self::Metre => (1e3, "mm"),
            Self::MetrePerSecond => (1.0, "m/s"),
            Self::MetrePerSecondSquared => (1.0, "m/s²"),
            Self::Newton => (1.0, "N"),
            Self::Share => (100.0, "%"),
        }
    }
}

/// Decimals of a quantity in a table.
pub(crate) fn decimals(unit: Unit) -> usize {
    match unit {
        Unit::Share => 1,
        _ => 4,
    }
}

/// The bound of a measure that keeps its limit, in its unit; a share that only rounding keeps from being whole is 100.
pub(crate) fn kept(measure: &Measure, bound: f64, decimals: usize) -> String {
    if measure.unit == Unit::Share && measure.sense == Sense::AtLeast && bound >= 1.0 - 1e-9 {
        return percent(bound);
    }
    let (scale, _) = measure.unit.scale();
    toward_limit(bound * scale, measure.limit * scale, measure.sense, decimals)
}

/// A bound that keeps its limit, with `decimals` decimals. It is rounded towards the limit, so that no more is said than is proved, with as
/// many more decimals as it takes to read as one that keeps the limit.
fn toward_limit(bound: f64, limit: f64, sense: Sense, decimals: usize) -> String {
    let told = |decimals| match sense {
        Sense::AtMost => decimals_up(bound, decimals),
        Sense::AtLeast | Sense::Above => decimals_down(bound, decimals),
    };
    let keeps = |told: &String| {
        let read = told.parse::<f64>().unwrap_or(f64::NAN);
        if sense == Sense::AtMost {
            read <= limit
        } else {
            read >= limit
        }
    };
    let shown = (decimals..=MOST_DECIMALS).map(told).find(keeps);
    shown.unwrap_or_else(|| number(limit))
}
