//! How much of a plate the sponge sweeps, at least.
//!
//! Tilted by τ, the sponge's face lies over a disc of radius s cos τ about the tip. Between neighbours of a polyline of
//! moments the tip leaves the chord by at most h²/8 · sup ‖p̈‖; less the greatest of these, the disc sweeps at least what it
//! would along the polyline.

use super::neighbours::{Touched, norm};
use super::piece::Piece;
use super::tip::{Arm, Stretch};
use platewash_workcell::coverage::{CoverageError, CoverageSettings, coverage};
use platewash_workcell::layout::Plate;
use serde::{Deserialize, Serialize};

/// How far the tip may leave the polyline \[m\], where halving helps.
const CHORD_M: f64 = 5e-5;

/// How often a piece is halved at most.
const MOST_HALVINGS: u32 = 6;

/// Halvings that any motion may have besides those of its pieces.
const SPLITS: usize = 4096;

/// Edges of the smallest cells, the second where the first do not suffice \[m\].
const CELLS_M: [f64; 2] = [1e-3, 2.5e-4];

/// The swept share of a plate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
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
    /// How far the sponge reaches beyond the rim at the height of the plate's face while it comes down, washes and leaves, at most,
    /// negative where it stays within it \[m\]; `None` where nothing is proved.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beyond_rim_m: Option<f64>,
    /// How far a sponge that is tilted as much would reach where the tip was seen \[m\].
    pub beyond_rim_seen_m: f64,
    /// How far it may reach \[m\].
    pub beyond_rim_allowed_m: f64,
    /// The neighbours that it may touch there.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub touches: Vec<Touched>,
}

/// What came of one wash.
#[derive(Debug)]
pub(super) struct Wash {
    /// The stage.
    pub stage: usize,
    /// The tip is never farther from the plate's centre, seen from above \[m\].
    pub tip_m: f64,
    /// How far it was seen to be \[m\].
    pub seen_m: f64,
    pub swept: PlateCoverage,
}

/// What the sponge of radius `sponge_m` sweeps of a plate during some pieces, with cos τ never below `cos_tilt`; and how far the tip is from
/// the plate's centre at most, and was seen to be \[m\]. It should keep `within_m`: where it does, that is proved.
///
/// # Errors
/// [`CoverageError`] for lengths that make no sense.
pub(super) fn sweep(
    arm: &Arm<'_>,
    pieces: &[Piece],
    (plate, index): (&Plate, usize),
    (sponge_m, cos_tilt): (f64, f64),
    required: f64,
    within_m: f64,
) -> Result<(PlateCoverage, [f64; 2]), CoverageError> {
    let line = Polyline::new(arm, pieces, plate, within_m, MOST_HALVINGS);
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
        beyond_rim_m: None,
        beyond_rim_seen_m: 0.0,
        beyond_rim_allowed_m: 0.0,
        touches: Vec::new(),
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
    Ok((swept, [line.within_m, line.seen_m]))
}

/// Moments of the tip, from above.
pub(super) struct Polyline {
    points: Vec<[f64; 2]>,
    /// The tip is never farther from it \[m\].
    off_m: f64,
    centre: [f64; 2],
    /// Largest distance of a moment from the centre \[m\].
    pub seen_m: f64,
    /// The tip is never farther from the centre \[m\].
    pub within_m: f64,
    /// How far it may be \[m\].
    allowed_m: f64,
    most_halvings: u32,
    /// Halvings left.
    splits: usize,
}

impl Polyline {
    /// The tip during some pieces about a plate. It should keep `allowed_m` of the centre: where it does, that is proved.
    pub fn new(arm: &Arm<'_>, pieces: &[Piece], plate: &Plate, allowed_m: f64, most_halvings: u32) -> Self {
        let mut line = Self {
            points: Vec::new(),
            off_m: 0.0,
            centre: [plate.x_m, plate.y_m],
            seen_m: 0.0,
            within_m: 0.0,
            allowed_m,
            most_halvings,
            splits: SPLITS + (pieces.len() << MOST_HALVINGS),
        };
        for (i, piece) in pieces.iter().enumerate() {
            let stretch = arm.stretch(piece);
            if i == 0 {
                line.points.push(flat(&stretch, 0));
            }
            line.add(arm, &stretch, 0);
        }
        line
    }

    /// Adds a stretch whose first end is there already.
    fn add(&mut self, arm: &Arm<'_>, stretch: &Stretch<'_>, depth: u32) {
        let off_m = stretch.sag(arm.derivatives(stretch).second());
        let far_m = [0, 1]
            .map(|end| self.off_centre_m(stretch, end))
            .into_iter()
            .fold(0.0, f64::max);
        let undecided = far_m <= self.allowed_m && far_m + off_m > self.allowed_m;
        let halves = if (off_m > CHORD_M || undecided) && depth < self.most_halvings && self.splits > 0 {
            self.splits -= 1;
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
        // ‖f‖ ≤ max(‖f(a)‖, ‖f(b)‖) + h²/8 · sup ‖f″‖ for f from the centre to the tip.
        self.seen_m = self.seen_m.max(far_m);
        self.within_m = if off_m.is_nan() {
            f64::INFINITY
        } else {
            self.within_m.max(far_m + off_m)
        };
        self.points.push(flat(stretch, 1));
    }

    /// Distance of an end of a stretch from the centre, seen from above \[m\].
    fn off_centre_m(&self, stretch: &Stretch<'_>, end: usize) -> f64 {
        let [x, y] = flat(stretch, end);
        norm(x - self.centre[0], y - self.centre[1])
    }
}

fn flat(stretch: &Stretch<'_>, end: usize) -> [f64; 2] {
    let p = &stretch.ends[end].position;
    [p.x, p.y]
}
