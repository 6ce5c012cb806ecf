//! Times in messages: whole nanoseconds after the lead-in, strictly increasing.

use platewash_motion_proof::message::NS_PER_S;

/// Time at which the first point is reached, where the plan begins \[s\]. A controller moves there from the arm's current
/// position: a first point at 0 s would be a step.
pub const LEAD_IN_S: f64 = 0.5;

/// The same time \[ns\].
pub(crate) const LEAD_IN_NS: i64 = NS_PER_S / 2;

/// Times of a program \[s\] as times of its messages \[ns\]: rounded, and a nanosecond later where that would not be after the one before.
pub(crate) fn nanoseconds(times_s: impl Iterator<Item = f64>) -> Vec<i64> {
    let mut all: Vec<i64> = Vec::new();
    for t_s in times_s {
        let rounded = LEAD_IN_NS.saturating_add((t_s * NS_PER_S as f64).round() as i64);
        let next = all.last().map_or(i64::MIN, |last| last.saturating_add(1));
        all.push(rounded.max(next));
    }
    all
}

/// Time between two of them \[s\].
pub(crate) fn seconds_between(from_ns: i128, to_ns: i128) -> f64 {
    (to_ns - from_ns) as f64 / NS_PER_S as f64
}
