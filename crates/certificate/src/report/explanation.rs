//! Explanations of requirements: a sentence, the formula, and whose the limit is.

use crate::report::check::Check;
use crate::report::requirement::{Requirement, RequirementGroup};
use crate::report::verdict_basis::VerdictBasis;
use platewash_kinematics::trig::atan2;
use serde::Serialize;
use ts_rs::TS;

/// Explanation of a requirement to readers of its check.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, TS)]
pub struct Explanation {
    /// The requirement in a sentence.
    pub sentence: &'static str,
    /// Group of the page.
    pub group: RequirementGroup,
    /// Place in the group, from 1.
    pub place: u8,
    /// Section of the documentation with the proof: "docs/certificate.md, 24".
    pub section: String,
    /// Numbers of the formulas that bound it: "24.1".
    pub formulas: &'static [&'static str],
    /// Origin of the limit in a sentence; empty where nothing is measured.
    pub limit: String,
}

impl Explanation {
    /// The explanation of a check, on the basis of its verdict; `None` for a motion without a job.
    #[must_use]
    pub fn new(check: &Check, basis: Option<&VerdictBasis>) -> Self {
        let row = check.requirement.row();
        Self {
            sentence: row.sentence,
            group: row.group,
            place: row.place,
            section: row.reference(),
            formulas: row.formulas,
            limit: limit(check, basis),
        }
    }
}

/// Origin of the limits of joints.
const DESCRIBED: &str = "The limit is that of the arm's description.";

/// Origin of a check's limit.
fn limit(check: &Check, basis: Option<&VerdictBasis>) -> String {
    use Requirement as R;
    let Some(measure) = check.measure else {
        return String::new();
    };
    let of_joint = matches!(check.requirement, R::JointPosition | R::JointSpeed);
    let Some(basis) = basis.filter(|_| !of_joint) else {
        return if of_joint {
            DESCRIBED
        } else {
            "The limit was given with the motion."
        }
        .to_owned();
    };
    let job = &basis.requirements;
    let is_described = |joint: usize| basis.described_accelerations.contains(&(joint + 1));
    let said = match check.requirement {
        R::JointAcceleration if check.worst.joint.is_some_and(is_described) => DESCRIBED,
        R::JointAcceleration => "The limit is the job's: an assumption, as the arm's description has none.",
        R::Tilt => return tilt(measure.limit, basis),
        R::ContactHeight | R::PathDeviation | R::LineDeviation => {
            "The limit is a tolerance of the proof: it is the same for every plan."
        }
        R::ContactSpeed if job.landing_m_s.is_none() && job.lifting_m_s.is_none() => {
            "The limit is the job's wash speed."
        }
        R::ContactSpeed => "The limit is what the job states of landing and lifting.",
        R::Reach => {
            "The limit follows from the planned wash path and its tilt: a sponge that stays on it reaches no farther. The job states none."
        }
        R::PlanDeviation => "The limit is the tolerance that the program was judged with.",
        R::PlateStays => "The limit follows from what the job states of the holder.",
        _ => "The limit is what the job asks for.",
    };
    said.to_owned()
}

/// Origin of the limit of the tilt \[rad\]: the least of what the job, the wash paths and the sponge allow.
fn tilt(limit_rad: f64, basis: &VerdictBasis) -> String {
    let asked_rad = basis.requirements.tilt_rad;
    let degrees = |angle_rad: f64| {
        let digits = format!("{:.2}", angle_rad.to_degrees());
        format!("{}°", digits.trim_end_matches('0').trim_end_matches('.'))
    };
    let sponge = &basis.workcell.tool.sponge;
    if limit_rad >= asked_rad {
        return format!("The job asks for at most {}.", degrees(asked_rad));
    }
    let why = if limit_rad >= atan2(sponge.height_m, sponge.radius_m) {
        "beyond which the holder of the sponge would come under its far rim"
    } else {
        "for which the wash paths were planned"
    };
    let limit = degrees(limit_rad);
    format!(
        "The job asks for at most {}; the limit is {limit}, {why}.",
        degrees(asked_rad)
    )
}
