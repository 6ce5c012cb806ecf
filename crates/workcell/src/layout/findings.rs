//! Problems of a layout that do not make it unusable.

use crate::layout::footprint::BaseFootprint;
use crate::layout::region::Region;
use crate::layout::spacing::Spacing;
use crate::plate::Plate;
use crate::words::plate_name;
use platewash_kinematics::words::{distinct_decimals, nonzero_decimals};
use serde::{Deserialize, Serialize};
use std::fmt;

/// Problem of a layout. Plates are given by index, from 0; lengths are in metres, positions in the base frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
#[non_exhaustive]
pub enum Finding {
    /// Two centres are not farther apart than `min_distance_m`. This breaks a rule of the layout; the plates need not touch.
    SpacingBroken {
        /// Index of the first plate.
        a: usize,
        /// Index of the other plate.
        b: usize,
        /// Distance between the centres \[m\].
        distance_m: f64,
        /// Least allowed distance, not included \[m\].
        required_m: f64,
    },
    /// A centre is not farther from the base axis than `base_radius_m`. This breaks a rule of the layout; plate and base need not touch.
    TooCloseToBase {
        /// Index of the plate.
        plate: usize,
        /// Distance of its centre from the base axis \[m\].
        distance_m: f64,
        /// Least allowed distance, not included \[m\].
        required_m: f64,
    },
    /// Two plates overlap.
    PlatesOverlap {
        /// Index of the first plate.
        a: usize,
        /// Index of the other plate.
        b: usize,
        /// Distance by which they would have to be moved apart \[m\].
        overlap_m: f64,
    },
    /// A plate lies over the footprint of the robot's base.
    OverlapsBase {
        /// Index of the plate.
        plate: usize,
        /// Distance by which it would have to be moved away \[m\].
        overlap_m: f64,
    },
    /// A centre lies outside the region.
    LeavesRegion {
        /// Index of the plate.
        plate: usize,
        /// x of its centre \[m\].
        x_m: f64,
        /// y of its centre \[m\].
        y_m: f64,
    },
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mm = |metres: f64| 1e3 * metres;
        match *self {
            Self::SpacingBroken {
                a,
                b,
                distance_m,
                required_m,
            } => {
                let [distance, required] = distinct_decimals(mm(distance_m), mm(required_m), 1);
                write!(
                    f,
                    "{} and {} are {distance} mm apart; the spacing rule wants more than {required} mm",
                    plate_name(a),
                    plate_name(b)
                )
            }
            Self::TooCloseToBase {
                plate,
                distance_m,
                required_m,
            } => {
                let [distance, required] = distinct_decimals(mm(distance_m), mm(required_m), 1);
                write!(
                    f,
                    "{} is {distance} mm from the base axis; the spacing rule wants more than {required} mm",
                    plate_name(plate)
                )
            }
            Self::PlatesOverlap { a, b, overlap_m } => {
                write!(
                    f,
                    "{} and {} overlap by {} mm",
                    plate_name(a),
                    plate_name(b),
                    nonzero_decimals(mm(overlap_m), 1)
                )
            }
            Self::OverlapsBase { plate, overlap_m } => {
                write!(
                    f,
                    "{} overlaps the robot's base by {} mm",
                    plate_name(plate),
                    nonzero_decimals(mm(overlap_m), 1)
                )
            }
            Self::LeavesRegion { plate, x_m, y_m } => {
                write!(
                    f,
                    "{} at x = {:.1} mm, y = {:.1} mm lies outside the region",
                    plate_name(plate),
                    mm(x_m),
                    mm(y_m)
                )
            }
        }
    }
}

impl Finding {
    /// Moves the positions in the finding by `[x, y]` \[m\], for a layout about another origin.
    pub(crate) fn move_by(&mut self, [x, y]: [f64; 2]) {
        if let Self::LeavesRegion { x_m, y_m, .. } = self {
            (*x_m, *y_m) = (*x_m + x, *y_m + y);
        }
    }
}

/// Finds plates that overlap each other or the base: parallel plates, seen along their axis, and level plates over the base. Plates at an
/// angle are checked by their bodies elsewhere.
pub(crate) fn overlaps(plates: &[Plate], base: Option<&BaseFootprint>) -> Vec<Finding> {
    let mut findings = Vec::new();
    for (i, plate) in plates.iter().enumerate() {
        let overlap_m = base.and_then(|base| base.gap_m(plate)).map_or(0.0, |gap_m| -gap_m);
        if overlap_m > 0.0 {
            findings.push(Finding::OverlapsBase { plate: i, overlap_m });
        }
    }
    for (a, b, _) in pairs(plates) {
        let (first, second) = (&plates[a], &plates[b]);
        if !first.is_parallel(second) || first.is_over(second) || second.is_over(first) {
            continue;
        }
        let overlap_m = -first.gap_beside_m(second);
        if overlap_m > 0.0 {
            findings.push(Finding::PlatesOverlap { a, b, overlap_m });
        }
    }
    findings
}

/// Finds plates that break the rules by which layouts are drawn.
pub(crate) fn broken_rules(plates: &[Plate], region: Option<&Region>, spacing: &Spacing) -> Vec<Finding> {
    let mut findings = Vec::new();
    for (i, plate) in plates.iter().enumerate() {
        let [x_m, y_m] = plate.centre_xy();
        if region.is_some_and(|region| !region.contains([x_m, y_m])) {
            findings.push(Finding::LeavesRegion { plate: i, x_m, y_m });
        }
        let (squared, required_m) = (x_m * x_m + y_m * y_m, spacing.base_radius_m);
        if squared <= required_m * required_m {
            findings.push(Finding::TooCloseToBase {
                plate: i,
                distance_m: squared.sqrt(),
                required_m,
            });
        }
    }
    for (a, b, distance_m) in pairs(plates) {
        if distance_m <= spacing.min_distance_m {
            findings.push(Finding::SpacingBroken {
                a,
                b,
                distance_m,
                required_m: spacing.min_distance_m,
            });
        }
    }
    findings
}

/// Returns every pair of plates once, with the distance between their centres.
fn pairs(plates: &[Plate]) -> impl Iterator<Item = (usize, usize, f64)> {
    (0..plates.len()).flat_map(move |a| {
        (a + 1..plates.len()).map(move |b| {
            let ([xa, ya], [xb, yb]) = (plates[a].centre_xy(), plates[b].centre_xy());
            let (dx, dy) = (xa - xb, ya - yb);
            (a, b, (dx * dx + dy * dy).sqrt())
        })
    })
}
