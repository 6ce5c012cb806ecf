//! Shape of a plate that was measured, as a plan keeps it for pictures and reports.

use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// Shape of a plate that was measured: by a mesh, or by points on its face.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeasuredShape {
    /// Name of the file.
    pub file: String,
    /// Unit of the file, and whether it was guessed, as "mm" or "mm (guessed)".
    pub unit: String,
    /// True for points on the face, false for a mesh: between points nothing is measured.
    pub is_probed: bool,
    /// Greatest deviation of the measured plate from the fitted one \[m\].
    pub deviation_m: f64,
    /// Greatest deviation of the face from being round \[m\].
    pub out_of_round_m: f64,
    /// Heights of the measured plate over its pole.
    pub relief: Relief,
}

/// Heights of a plate on a polar grid, for pictures, relative to the pole, plate frame.
///
/// Ring k of n has the radius (k + ½)/n of the rim's. Azimuths begin at x, at equal angles. Heights are in steps of 10 µm, ring by ring.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Relief {
    /// Radii of the rings \[m\].
    pub radii_m: Vec<f64>,
    /// Number of azimuths.
    pub azimuths: usize,
    /// Heights of the face \[10 µm\].
    pub upper: Vec<i32>,
    /// Heights of the underside \[10 µm\]; empty if it was not measured.
    pub lower: Vec<i32>,
}
