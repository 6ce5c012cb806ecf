//! Intervals in which quantities that change linearly are not below 0.

/// Returns the part of [0, 1] on which the line through two values is not below 0.
#[must_use]
pub fn at_least_0([from, to]: [f64; 2]) -> Option<[f64; 2]> {
    let crossing = || from / (from - to);
    match (from >= 0.0, to >= 0.0) {
        (true, true) => Some([0.0, 1.0]),
        (true, false) => Some([0.0, crossing()]),
        (false, true) => Some([crossing(), 1.0]),
        (false, false) => None,
    }
}

/// Intersection of two ranges; `None` if it has no length.
#[must_use]
pub fn both([a, b]: [f64; 2], [c, d]: [f64; 2]) -> Option<[f64; 2]> {
    let common = [a.max(c), b.min(d)];
    (common[0] < common[1]).then_some(common)
}
