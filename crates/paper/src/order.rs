//! The order in which plates are washed.

use platewash_workcell::plate::Plate;
use serde::{Deserialize, Serialize};

/// Order in which plates are washed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PaperOrder {
    /// Always the nearest unvisited plate centre (the paper's rule).
    Nearest,
    /// As listed.
    Given,
}

/// Order of the plates (indices).
///
/// [`PaperOrder::Nearest`] is the paper's rule: from the current position, always the nearest unvisited plate
/// centre (in xy; ties go to the lower index). The position is `start` (x, y \[m\]) at first, then the last
/// spiral point of the plate just washed, `exit(plate)`, not its centre.
#[must_use]
pub fn order(plates: &[Plate], rule: PaperOrder, start: [f64; 2], exit: impl Fn(&Plate) -> [f64; 2]) -> Vec<usize> {
    let mut open: Vec<usize> = (0..plates.len()).collect();
    let mut order = Vec::with_capacity(plates.len());
    let mut here = start;
    while !open.is_empty() {
        let next = match rule {
            PaperOrder::Given => 0,
            PaperOrder::Nearest => nearest(plates, &open, here),
        };
        let plate = open.remove(next);
        here = exit(&plates[plate]);
        order.push(plate);
    }
    order
}

/// Position in `open` of the plate whose centre is nearest to `here`.
fn nearest(plates: &[Plate], open: &[usize], here: [f64; 2]) -> usize {
    let squared = |i: usize| {
        let [x, y] = plates[i].centre_xy();
        let (dx, dy) = (x - here[0], y - here[1]);
        dx * dx + dy * dy
    };
    let by_distance = |a: &(usize, &usize), b: &(usize, &usize)| squared(*a.1).total_cmp(&squared(*b.1));
    open.iter()
        .enumerate()
        .min_by(by_distance)
        .map_or(0, |(position, _)| position)
}
