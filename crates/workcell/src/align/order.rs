//! Points that were touched in another order than they are drawn.

use super::fit::{Touch, align};

/// Points of which all orders are tried: 720.
const MOST: usize = 6;

/// The order in which the touched points fit the drawn ones to `tolerance_m` \[m\], root mean square: entry k is the touched point that
/// belongs to the drawn one k. `None` where no other order than the given one fits, and for more than six points.
#[must_use]
pub fn fitting_order(touches: &[Touch], tolerance_m: f64) -> Option<Vec<usize>> {
    let count = touches.len();
    if count > MOST {
        return None;
    }
    let mut best: Option<(f64, Vec<usize>)> = None;
    let mut order: Vec<usize> = (0..count).collect();
    while next(&mut order) {
        let swapped: Vec<Touch> = order
            .iter()
            .zip(touches)
            .map(|(&k, touch)| Touch {
                touched_m: touches[k].touched_m,
                ..*touch
            })
            .collect();
        let Ok(found) = align(&swapped) else { continue };
        if found.rms_m <= tolerance_m && best.as_ref().is_none_or(|(rms_m, _)| found.rms_m < *rms_m) {
            best = Some((found.rms_m, order.clone()));
        }
    }
    best.map(|(_, order)| order)
}

/// The next permutation in lexicographic order; false after the last.
fn next(order: &mut [usize]) -> bool {
    let Some(at) = order.windows(2).rposition(|pair| pair[0] < pair[1]) else {
        return false;
    };
    let pivot = order[at];
    let Some(with) = order.iter().rposition(|k| *k > pivot) else {
        return false;
    };
    order.swap(at, with);
    order[at + 1..].reverse();
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_permutation_comes_once() {
        let mut order = vec![0, 1, 2, 3];
        let mut all = std::collections::BTreeSet::from([order.clone()]);
        while next(&mut order) {
            assert!(all.insert(order.clone()));
        }
        assert_eq!(all.len(), 24);
        assert!(!next(&mut []) && !next(&mut [0]));
    }
}
