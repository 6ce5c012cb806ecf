//! Times in messages: whole nanoseconds after the lead-in, strictly increasing.

/// Nanoseconds of a second.
pub(super) const NS_PER_S: i64 = 1_000_000_000;

/// When the first point is reached, where the plan begins \[s\]. A controller moves there from wherever the arm is: a first point at
/// 0 s would be a step.
pub const LEAD_IN_S: f64 = 0.5;

/// The same \[ns\].
pub(super) const LEAD_IN_NS: i64 = NS_PER_S / 2;

/// Times of a program \[s\] as times of its messages \[ns\]: rounded, and a nanosecond later where that would not be after the one before.
pub(super) fn nanoseconds(times_s: impl Iterator<Item = f64>) -> Vec<i64> {
    let mut all: Vec<i64> = Vec::new();
    for t_s in times_s {
        let rounded = LEAD_IN_NS.saturating_add((t_s * NS_PER_S as f64).round() as i64);
        let next = all.last().map_or(i64::MIN, |last| last.saturating_add(1));
        all.push(rounded.max(next));
    }
    all
}

/// Time between two of them \[s\].
pub(super) fn seconds_between(from_ns: i128, to_ns: i128) -> f64 {
    (to_ns - from_ns) as f64 / NS_PER_S as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn the_first_point_is_after_the_lead_in() {
        assert_eq!(nanoseconds([0.0, 1.25].into_iter()), [500_000_000, 1_750_000_000]);
        assert_eq!(LEAD_IN_NS as f64 / NS_PER_S as f64, LEAD_IN_S);
    }

    #[test]
    fn times_that_round_to_one_are_told_apart() {
        assert_eq!(
            nanoseconds([0.0, 1e-10, 2e-10].into_iter()),
            [500_000_000, 500_000_001, 500_000_002]
        );
        // Huge times saturate; reading refuses what comes of it.
        assert_eq!(
            nanoseconds([f64::INFINITY, f64::INFINITY].into_iter()),
            [i64::MAX, i64::MAX]
        );
    }

    proptest! {
        #[test]
        fn they_increase_and_are_within_a_nanosecond(steps in prop::collection::vec(2e-9..1.0_f64, 1..50)) {
            let times: Vec<f64> = steps.iter().scan(0.0, |t, step| { *t += step; Some(*t) }).collect();
            let all = nanoseconds(times.iter().copied());
            prop_assert!(all.windows(2).all(|pair| pair[0] < pair[1]));
            for (t_s, ns) in times.iter().zip(&all) {
                let read = seconds_between(i128::from(LEAD_IN_NS), i128::from(*ns));
                prop_assert!((read - t_s).abs() <= 1e-9, "{} {}", t_s, read);
            }
        }
    }
}
