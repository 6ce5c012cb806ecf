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

#[cfg(test)]
mod tests {
    use super::*;

    fn plate(x_m: f64, y_m: f64) -> Plate {
        Plate::level_disc([x_m, y_m, 0.03], 0.145, 0.02)
    }

    #[test]
    fn the_tip_leaves_a_plate_where_its_spiral_ends() {
        // From plate 1 (first) the centre of plate 2 is nearer, but the exit at +0.145 m in x favours plate 3.
        let plates = [plate(0.0, 0.1), plate(-0.2, 0.1), plate(0.3, 0.1)];
        let exit = |p: &Plate| [p.centre_xy()[0] + 0.145, p.centre_xy()[1]];
        assert_eq!(order(&plates, PaperOrder::Nearest, [0.0, 0.0], exit), [0, 2, 1]);
        assert_eq!(
            order(&plates, PaperOrder::Nearest, [0.0, 0.0], Plate::centre_xy),
            [0, 1, 2]
        );
        assert_eq!(order(&plates, PaperOrder::Given, [9.0, 9.0], exit), [0, 1, 2]);
    }

    #[test]
    fn every_plate_comes_once_and_ties_go_to_the_lower_index() {
        let plates = [plate(0.3, 0.0), plate(-0.3, 0.0), plate(0.0, 0.3)];
        assert_eq!(
            order(&plates, PaperOrder::Nearest, [0.0, 0.0], |_| [0.0, 0.0]),
            [0, 1, 2]
        );
        assert!(order(&[], PaperOrder::Nearest, [0.0, 0.0], |_| [0.0, 0.0]).is_empty());
    }
}
