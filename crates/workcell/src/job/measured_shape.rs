//! Shape of a plate that was measured, as a plan keeps it for pictures and reports.

use crate::measured::Relief;
use serde::{Deserialize, Serialize};

/// Shape of a plate that was measured: by a mesh, or by points on its face.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeasuredShape {
    /// Name of the file.
    pub file: String,
    /// Unit of the file, and whether it was guessed, as "mm" or "mm (guessed)".
    pub unit: String,
    /// Greatest deviation of the measured plate from the fitted one \[m\].
    pub deviation_m: f64,
    /// Greatest deviation of the face from being round \[m\].
    pub out_of_round_m: f64,
    /// Heights of the measured plate over its pole.
    pub relief: Relief,
}
