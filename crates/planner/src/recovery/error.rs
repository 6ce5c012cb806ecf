//! Reason that there is no recovery.

use crate::error::PlanError;
use platewash_bodies::clearance::PairClearance;
use platewash_kinematics::LimitViolation;
use platewash_kinematics::words::distinct_decimals;
use platewash_workcell::words::{plate_name, printable};

/// Reason that there is no recovery.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RecoveryError {
    /// The plan is a run of the paper's program.
    #[error("the plan is a run of the paper's program, which is not proved; recover is for plans of a washing")]
    PaperRun,
    /// The plan is the motion home of a recovery.
    #[error(
        "the plan is the motion home of a recovery: give the plan that was stopped first, with where the arm stands now"
    )]
    MotionHome,
    /// The plan is a dry run.
    #[error(
        "the plan is a dry run, whose plates are in the air where nothing is: move the arm home by hand, then run it again from its start"
    )]
    DryRun,
    /// The plan's hash is missing, or not that of its contents.
    #[error("the plan was changed after it was written; a recovery names its parent by its hash")]
    NotSealed,
    /// A joint position is NaN or infinite.
    #[error("the joint positions must be finite numbers")]
    NotFinite,
    /// The arm stands beyond a limit of a joint.
    #[error("where the arm stands, {0}; move that joint back by hand first")]
    Limit(LimitViolation),
    /// The time is not within the plan.
    #[error("the time of the stop must be from 0 to {duration_s:.3} s, the plan's end; found {found_s} s")]
    Time {
        /// Time given \[s\].
        found_s: f64,
        /// Duration of the plan \[s\].
        duration_s: f64,
    },
    /// The joints do not fit the plan at the stated time, and fit it at another one.
    #[error(
        "the joints do not fit the plan at the stated {found_s} s (a joint is off by {:.1}°) and fit it at {fits_s:.2} s (off by up to {:.2}°): \
         state the time in the plan, or leave it out; the log of a program that ran at a share of its speed, or was held, has other times",
        found_off_rad.to_degrees(), fits_off_rad.to_degrees()
    )]
    OtherTime {
        /// Time given \[s\].
        found_s: f64,
        /// Largest distance of a joint from the plan then \[rad\].
        found_off_rad: f64,
        /// Moment of the plan that the joints fit \[s\].
        fits_s: f64,
        /// Largest distance of a joint from the plan at that moment \[rad\].
        fits_off_rad: f64,
    },
    /// Bodies touch where the arm stands.
    #[error(
        "where the arm stands, '{}' and '{}' touch: no motion from there can be proved; move the arm away by hand first",
        printable(&.pair.a), printable(&.pair.b)
    )]
    Touching {
        /// The bodies.
        pair: Box<PairClearance>,
    },
    /// No way to a clear place was found.
    #[error("no way was found from where the arm stands to a place that is clear of everything{}", nearest(.plate, .pair.as_deref()))]
    NoWay {
        /// Plate that the sponge is at.
        plate: Option<usize>,
        /// Nearest bodies.
        pair: Option<Box<PairClearance>>,
    },
    /// The motion home, or the plates that are left, could not be planned.
    #[error(transparent)]
    Plan(#[from] PlanError),
}

fn nearest(plate: &Option<usize>, pair: Option<&PairClearance>) -> String {
    match (plate, pair) {
        (_, Some(pair)) => {
            let [found, _] = distinct_decimals(1e3 * pair.distance_m, 0.0, 2);
            format!(
                ": '{}' and '{}' are {found} mm apart",
                printable(&pair.a),
                printable(&pair.b)
            )
        }
        (Some(plate), None) => format!(": the sponge is at {}", plate_name(*plate)),
        (None, None) => String::new(),
    }
}
