//! How much of a plate the sponge sweeps, at least.
//!
//! Tilted by τ, the sponge's face lies over a disc of radius s cos τ about the tip. Between neighbours of a polyline of
//! moments the tip leaves the chord by at most h²/8 · sup ‖p̈‖; less the greatest of these, the disc sweeps at least what it
//! would along the polyline.

use super::piece::Piece;
use super::tip::{Arm, Stretch};
use crate::coverage::{CoverageError, CoverageSettings, coverage};
use crate::layout::Plate;
use serde::{Deserialize, Serialize};

/// How far the tip may leave the polyline \[m\], where halving helps.
const CHORD_M: f64 = 5e-5;

/// How often a piece is halved at most.
const MOST_HALVINGS: u32 = 6;

/// Edges of the smallest cells, the second where the first do not suffice \[m\].
const CELLS_M: [f64; 2] = [1e-3, 2.5e-4];

/// The swept share of a plate.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PlateCoverage {
    /// Index of the plate.
    pub plate: usize,
    /// What is proved: no smaller share is swept.
    pub at_least: f64,
    /// No greater share is swept; `None` where it was not needed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_most: Option<f64>,
    /// Least cos τ while washing, proved.
    pub cos_tilt: f64,
}

/// What the sponge of radius `sponge_m` sweeps of a plate during some pieces, with cos τ never below `cos_tilt`.
///
/// # Errors
/// [`CoverageError`] for lengths that make no sense.
pub(super) fn sweep(
    arm: &Arm<'_>,
    pieces: &[Piece],
    (plate, index): (&Plate, usize),
    (sponge_m, cos_tilt): (f64, f64),
    required: f64,
) -> Result<PlateCoverage, CoverageError> {
    let mut line = Polyline {
        points: Vec::new(),
        off_m: 0.0,
    };
    for (i, piece) in pieces.iter().enumerate() {
        let stretch = arm.stretch(piece);
        if i == 0 {
            line.points.push(flat(&stretch, 0));
        }
        line.add(arm, &stretch, 0);
    }
    let share = |radius_m: f64, cell_m: f64| {
        let settings = CoverageSettings {
            cell_m: cell_m.max(1e-4 * plate.radius_m),
        };
        coverage(
            &line.points,
            [plate.x_m, plate.y_m],
            plate.radius_m,
            radius_m,
            &settings,
        )
    };
    let shrunk = sponge_m * cos_tilt - line.off_m;
    let mut swept = PlateCoverage {
        plate: index,
        at_least: 0.0,
        at_most: None,
        cos_tilt,
    };
    if shrunk > 0.0 {
        swept.at_least = share(shrunk, CELLS_M[0])?.lower;
        if swept.at_least < required {
            swept.at_least = swept.at_least.max(share(shrunk, CELLS_M[1])?.lower);
        }
    }
    if swept.at_least < required && line.off_m.is_finite() {
        swept.at_most = Some(share(sponge_m + line.off_m, CELLS_M[1])?.upper);
    }
    Ok(swept)
}

/// Moments of the tip, from above.
struct Polyline {
    points: Vec<[f64; 2]>,
    /// The tip is never farther from it \[m\].
    off_m: f64,
}

impl Polyline {
    /// Adds a stretch whose first end is there already.
    fn add(&mut self, arm: &Arm<'_>, stretch: &Stretch<'_>, depth: u32) {
        let off_m = stretch.sag(arm.derivatives(stretch).second());
        let halves = if off_m > CHORD_M && depth < MOST_HALVINGS {
            arm.halves(stretch)
        } else {
            None
        };
        if let Some(halves) = halves {
            return halves.iter().for_each(|half| self.add(arm, half, depth + 1));
        }
        self.off_m = if off_m.is_nan() {
            f64::INFINITY
        } else {
            self.off_m.max(off_m)
        };
        self.points.push(flat(stretch, 1));
    }
}

fn flat(stretch: &Stretch<'_>, end: usize) -> [f64; 2] {
    let p = &stretch.ends[end].position;
    [p.x, p.y]
}
