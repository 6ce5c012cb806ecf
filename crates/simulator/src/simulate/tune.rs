//! Many frequencies and dampings: the trade-off between tip error, torque and coverage.

use crate::simulate::error::SimulationError;
use crate::simulate::report::{Seal, SimulationReport, SimulationVerdict};
use crate::simulate::run::simulate_with;
use platewash_kinematics::{AXES, RobotModel};
use platewash_motion::plan::Plan;
use platewash_workcell::cancel::{CancelToken, Cancelled};
use platewash_workcell::simulation::SimulationSettings;
use rayon::prelude::*;
use serde::Serialize;

/// The outcome of a setting.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TuneOutcome {
    /// Verdict on the wash.
    pub verdict: SimulationVerdict,
    /// Tip error over the whole execution, root mean square \[m\].
    pub tip_rms_m: f64,
    /// Tip error over the whole execution, at most \[m\].
    pub tip_max_m: f64,
    /// Largest torque of each joint \[N·m\].
    pub torque_max_n_m: [f64; AXES],
    /// Work of all motors \[J\].
    pub work_j: f64,
    /// Least share of a plate swept; `None` where the plan washes none.
    pub least_swept: Option<f64>,
}

/// One setting.
#[derive(Debug, Clone, PartialEq)]
pub struct TuneRow {
    /// Natural frequency \[rad/s\].
    pub frequency_rad_s: f64,
    /// Damping ratio.
    pub damping_ratio: f64,
    /// Its outcome, or the error with which it was refused.
    pub outcome: Result<TuneOutcome, SimulationError>,
}

/// Simulates a plan with every pair of a frequency \[rad/s\] and a damping ratio, gains given outright being left out; rows
/// in the order of the frequencies, then of the dampings. On rayon's current thread pool; the answer does not depend on it.
///
/// # Errors
/// [`Cancelled`] when `token` says so: no row is left half-done.
pub fn tune(
    plan: &Plan,
    robot: &RobotModel,
    settings: &SimulationSettings,
    frequencies_rad_s: &[f64],
    damping_ratios: &[f64],
    token: &CancelToken,
) -> Result<Vec<TuneRow>, Cancelled> {
    let pairs: Vec<_> = frequencies_rad_s
        .iter()
        .flat_map(|&frequency| damping_ratios.iter().map(move |&damping| (frequency, damping)))
        .collect();
    let seal = Seal::from_plan(plan);
    let row = |&(frequency_rad_s, damping_ratio): &(f64, f64)| {
        let mut settings = settings.clone();
        let control = &mut settings.control;
        (control.joint_kp, control.joint_kd) = (None, None);
        (control.frequency_rad_s, control.damping_ratio) = (frequency_rad_s, damping_ratio);
        let outcome = || -> Result<TuneOutcome, SimulationError> {
            let execution = simulate_with(plan, robot, &settings, token)?;
            let report = SimulationReport::judge(plan, robot, &settings, &execution, seal)?;
            let coverages = report.plates.iter().map(|plate| plate.executed.fraction);
            Ok(TuneOutcome {
                verdict: report.verdict,
                tip_rms_m: report.tracking.tip_m.rms,
                tip_max_m: report.tracking.tip_m.max,
                torque_max_n_m: report
                    .effort
                    .map_or([0.0; AXES], |effort| effort.joints.map(|joint| joint.torque_n_m.max)),
                work_j: report.effort.map_or(0.0, |effort| effort.work_j),
                least_swept: coverages.min_by(f64::total_cmp),
            })
        };
        match outcome() {
            Err(SimulationError::Cancelled(cancelled)) => Err(cancelled),
            outcome => Ok(TuneRow {
                frequency_rad_s,
                damping_ratio,
                outcome,
            }),
        }
    };
    pairs.par_iter().map(row).collect()
}
