//! Judgement of a motion: the rules it is held to, and the stop behind its end.

use crate::points::PointMotion;
use crate::report::MotionReport;
use crate::stop::with_stop;
use platewash_certificate::{MotionRules, ProveError, Timing, prove_arm_motion};
use platewash_kinematics::{JointVector, RobotModel};
use platewash_motion::piecewise::PiecewiseMotion;
use platewash_workcell::Workcell;
use platewash_workcell::cancel::CancelToken;

/// Judges the motion of an arm in a workcell: joint limits, and the clearance of every pair of bodies, at every moment.
///
/// ```
/// use platewash_motion_proof::bodies::assembly;
/// use platewash_motion_proof::kinematics::{JointVector, Pose, RobotModel};
/// use platewash_motion_proof::{CancelToken, JointPoints, prove_motion};
///
/// let arm = RobotModel::irb120()?;
/// let points = JointPoints { q_rad: vec![JointVector::zeros(), JointVector::repeat(0.5)], ..JointPoints::default() };
/// let motion = points.motion(&arm, None)?;
/// let alone = assembly::workcell_without_tool(&arm, Pose::identity(), Vec::new())?;
/// let report = prove_motion(&motion, &alone, &arm, 0.005, None, &CancelToken::new())?;
/// assert!(report.headline.starts_with("PROVED"), "{report}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// `acceleration_rad_s2` are the greatest joint accelerations, if they are to be judged; those that the description states are judged wherever
/// speeds do not jump. Without times only positions and clearance are judged.
///
/// # Errors
/// [`ProveError`] for what cannot be judged, and when it is given up. A motion that breaks a rule is no error.
pub fn prove_motion(
    motion: &PointMotion,
    workcell: &Workcell,
    arm: &RobotModel,
    clearance_m: f64,
    acceleration_rad_s2: Option<JointVector>,
    cancel: &CancelToken,
) -> Result<MotionReport, ProveError> {
    let rules = MotionRules {
        clearance_m,
        acceleration_rad_s2,
        rests_outside: motion.rests_outside(),
        timing: motion.start.map_or(Timing::Free, |_| Timing::Stated),
    };
    let judged = judged_motion(motion, arm, acceleration_rad_s2.as_ref());
    let proof = prove_arm_motion(&judged, workcell, arm, &rules, cancel)?;
    Ok(MotionReport::new((motion, &judged), workcell, arm, &rules, proof))
}

/// Returns the motion that is judged: through the points, and to rest behind the last one where the points state speeds and every joint has
/// an acceleration limit \[rad/s²\], given or of the description, at which it brakes.
#[must_use]
pub fn judged_motion(
    motion: &PointMotion,
    arm: &RobotModel,
    acceleration_rad_s2: Option<&JointVector>,
) -> PiecewiseMotion {
    let states_speeds = motion.start.is_some() && !motion.rests_outside();
    let given = acceleration_rad_s2.copied();
    let given = given.unwrap_or_else(|| JointVector::repeat(f64::INFINITY));
    // The lesser of those given and those of the description; infinite where neither is.
    let limits = arm.limits().within_acceleration(&given);
    match states_speeds && limits.iter().all(|limit| *limit > 0.0 && limit.is_finite()) {
        true => with_stop(&motion.motion, &limits),
        false => motion.motion.clone(),
    }
}
