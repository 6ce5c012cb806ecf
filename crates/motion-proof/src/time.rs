//! Times as a file states them, without rounding.

use std::fmt;

/// Steps in a second.
const STEPS: i128 = 1_000_000_000_000_000_000;

/// Greatest time \[s\].
const MOST_S: i128 = 1_000_000_000_000_000;

/// Decimals that are written.
const SHOWN: usize = 9;

/// Time in steps of 10⁻¹⁸ s. A time of the clock, such as 1 700 000 000.001300039 s, has more digits than a number of 64 bits: only the
/// difference of two times becomes one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct ExactTime(i128);

impl ExactTime {
    /// Returns the time after some nanoseconds; `None` beyond 10¹⁵ s.
    #[must_use]
    pub fn of_nanoseconds(ns: i128) -> Option<Self> {
        Self::within(ns.checked_mul(STEPS / 1_000_000_000)?)
    }

    /// Returns the time of a finite number \[s\], as the number has it; `None` beyond 10¹⁵ s.
    #[must_use]
    pub fn of_seconds(t_s: f64) -> Option<Self> {
        if !(t_s.is_finite() && t_s.abs() <= MOST_S as f64) {
            return None;
        }
        let whole = t_s.trunc() as i128 * STEPS;
        Self::within(whole + ((t_s - t_s.trunc()) * STEPS as f64).round() as i128)
    }

    /// Reads a number in decimals \[s\], to the nearest step; `None` if it is no number, or beyond 10¹⁵ s.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        let (mantissa, exponent) = match text.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
            None => (text, 0),
        };
        let (is_negative, digits) = match mantissa.strip_prefix('-') {
            Some(rest) => (true, rest),
            None => (false, mantissa.strip_prefix('+').unwrap_or(mantissa)),
        };
        let (whole, part) = digits.split_once('.').unwrap_or((digits, ""));
        if whole.len() + part.len() == 0 || !(whole.bytes().chain(part.bytes()).all(|digit| digit.is_ascii_digit())) {
            return None;
        }
        // The digits are a whole number of 10^first steps.
        let first = i64::from(exponent) - part.len() as i64 + 18;
        let all: Vec<i128> = whole
            .bytes()
            .chain(part.bytes())
            .map(|digit| i128::from(digit - b'0'))
            .collect();
        let all = &all[all.iter().position(|digit| *digit != 0).unwrap_or(all.len())..];
        let mut steps: i128 = 0;
        for (digit, place) in all.iter().zip((first..first + all.len() as i64).rev()) {
            if *digit == 0 && steps == 0 {
                continue;
            }
            match place {
                0.. => {
                    let power = 10_i128.checked_pow(u32::try_from(place).ok()?)?;
                    steps = steps.checked_add(digit.checked_mul(power)?)?;
                }
                // Half a step and more is rounded up.
                -1 if *digit >= 5 => steps += 1,
                _ => {}
            }
        }
        Self::within(if is_negative { -steps } else { steps })
    }

    fn within(steps: i128) -> Option<Self> {
        (steps.abs() <= MOST_S * STEPS).then_some(Self(steps))
    }

    /// The time as a number \[s\], rounded.
    #[must_use]
    pub fn seconds(self) -> f64 {
        self.since(Self(0))
    }

    /// Time from an earlier one to this one \[s\]: the difference of both, rounded once they are subtracted (by 2⁻⁵² of it at most).
    #[must_use]
    pub fn since(self, earlier: Self) -> f64 {
        (self.0 - earlier.0) as f64 / STEPS as f64
    }

    /// The time some seconds later, 10¹⁵ s at most.
    #[must_use]
    pub fn later(self, by_s: f64) -> Self {
        let most = MOST_S as f64;
        Self(self.0 + Self::of_seconds(by_s.clamp(-most, most)).unwrap_or_default().0)
    }
}

impl fmt::Display for ExactTime {
    /// Writes seconds, rounded to nanoseconds.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let unit = 10_i128.pow(18 - SHOWN as u32);
        let rounded = (self.0.abs() + unit / 2) / unit;
        let sign = if self.0 < 0 && rounded > 0 { "-" } else { "" };
        let (whole, part) = (rounded / 1_000_000_000, rounded % 1_000_000_000);
        let part = format!("{part:0SHOWN$}");
        let part = part.trim_end_matches('0');
        let point = if part.is_empty() { "" } else { "." };
        write!(f, "{sign}{whole}{point}{part}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn digits_are_kept_until_times_are_subtracted() {
        let time = |text: &str| ExactTime::parse(text).unwrap();
        let (from, to) = (time("1700000000.001300039"), time("1700000000.002300039"));
        assert_eq!(to.since(from), 1e-3);
        assert_eq!(ExactTime::of_nanoseconds(1_700_000_000_001_300_039), Some(from));
        assert_eq!(from.to_string(), "1700000000.001300039");
        assert_eq!(from.later(0.25).to_string(), "1700000000.251300039");
        for (text, shown) in [
            ("0", "0"),
            ("-0.50", "-0.5"),
            ("+1.7e3", "1700"),
            (".5", "0.5"),
            ("2.", "2"),
            ("1e-10", "0"),
            ("999999.0001", "999999.0001"),
        ] {
            assert_eq!(time(text).to_string(), shown, "{text}");
        }
        for text in [
            "",
            ".",
            "-",
            "e5",
            "1e",
            "1e400",
            "1e16",
            "0x1",
            "1_0",
            "nan",
            "inf",
            "1.2.3",
            "--1",
            "1e99999999999",
        ] {
            assert_eq!(ExactTime::parse(text), None, "{text}");
        }
        assert_eq!(ExactTime::of_seconds(f64::NAN), None);
        assert_eq!(ExactTime::parse(&"9".repeat(400)), None);
        assert_eq!(
            ExactTime::parse(&format!("0.{}5", "0".repeat(17))).unwrap(),
            ExactTime(5)
        );
    }

    proptest! {
        #[test]
        fn a_number_is_read_as_the_standard_library_reads_it(t_s in -1e9..1e9f64, decimals in 0..12usize) {
            let text = format!("{t_s:.decimals$}");
            let found = ExactTime::parse(&text).unwrap().seconds();
            let expected: f64 = text.parse().unwrap();
            prop_assert!((found - expected).abs() <= 4e-16 * expected.abs(), "{} {}", found, expected);
            let back = ExactTime::of_seconds(expected).unwrap().seconds();
            prop_assert!((back - expected).abs() <= 4e-16 * expected.abs());
        }
    }
}
