//! Dirt on the plates: it lies until the proved dose of a place reaches the required one.
//!
//! Unlike the coverage, these times are proved, at the middles of the cells of a raster.

use super::error::ViewError;
use super::numbers::Numbers;
use super::raster::Raster;
use platewash_certificate as proved;
use platewash_kinematics::RobotModel;
use platewash_motion::plan::Plan;
use serde::Serialize;
use ts_rs::TS;

/// Cells of all rasters together, about.
const CELLS: usize = 10_000;

/// Cells along an edge of a raster, at least and at most.
const EDGE: [usize; 2] = [24, 64];

/// Dirt on a plate.
#[derive(Debug, Clone, PartialEq, Serialize, TS)]
#[ts(optional_fields)]
pub struct PlateDirt {
    /// Index of the plate.
    pub plate: usize,
    /// Half of the square's edge: the rim's radius \[m\].
    pub half_m: f64,
    /// Dose that removes it \[Pa·m\].
    pub dose_pa_m: f64,
    /// Name of the soil, if one is stated.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub soil: Option<String>,
    /// \[rows, columns\], y then x ascending in the plate's frame: when the dose is proved at the cell's middle, in steps of `step_s`;
    /// 65535 for never, 65534 for cells with their middle outside the rim.
    pub clean: Numbers,
    /// \[s\]
    pub step_s: f64,
}

/// Dirt on every plate for which a certificate proves a dose.
///
/// # Errors
/// [`ViewError::Dose`] for a plan that cannot be judged.
pub(super) fn plates(plan: &Plan, robot: &RobotModel, of: &proved::Certificate) -> Result<Vec<PlateDirt>, ViewError> {
    if plan.job.requirements.contact.is_none() {
        return Ok(Vec::new());
    }
    let cells = (CELLS / plan.job.plates.len().max(1)).isqrt().clamp(EDGE[0], EDGE[1]);
    let middles = |_, rim_m: f64| Raster::new(rim_m, cells).middles();
    let times = proved::dose_times(plan, robot, of, middles)?;
    let one = |times: &proved::DoseTimes| {
        let plate = &plan.job.plates[times.plate];
        let half_m = plate.rim_m();
        let mut raster = Raster::new(half_m, cells);
        raster.arrive(&times.times_s);
        let (clean, step_s) = raster.first(plan.duration_s());
        PlateDirt {
            plate: times.plate,
            half_m,
            dose_pa_m: plan.job.contact_of(plate).map_or(0.0, |wanted| wanted.dose_pa_m),
            soil: plan.job.soil_of(plate).map(|soil| soil.name.clone()),
            clean,
            step_s,
        }
    };
    Ok(times.iter().map(one).collect())
}
