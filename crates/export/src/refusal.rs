//! Why a plan is not handed over.

use platewash_certificate::Requirement;

/// Reason that a plan is not handed over. [`Refusal::code`] is stable.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Refusal {
    /// The certificate waives requirements that were not accepted by name.
    #[error("the certificate waives {}: accept each by its name to export it", .waived.join(", "))]
    Waived {
        /// Their names.
        waived: Vec<String>,
    },
    /// The program is for arms of another make.
    #[error("a {dialect} program is for {expected}; the plan is for \"{found}\"")]
    Arm {
        /// The dialect.
        dialect: &'static str,
        /// Arms that it is for.
        expected: &'static str,
        /// The plan's arm.
        found: String,
    },
    /// The count of axis 3 by the controller of this arm is not stated.
    #[error(
        "how the controller of \"{arm}\" counts axis 3 must be stated: where a parallel linkage drives it, ABB's count it together with axis 2 \
         (rax_3 = joint_3 + joint_2), {known}. Counted otherwise, the arm moves elsewhere. Give joint_3: with-joint-2 where the forearm keeps its \
         direction while axis 2 alone is jogged, else independent"
    )]
    Joint3 {
        /// The plan's arm.
        arm: String,
        /// Public knowledge of this arm, and its source.
        known: String,
    },
    /// The tool has no mass, or one that the controller or the arm does not take.
    #[error("{0}")]
    Load(String),
    /// The tool's frame is not the plan's.
    #[error("{0}")]
    Frame(String),
    /// The arm does not stand where the plan begins.
    #[error(
        "joint {} stands at {found_deg:.4}°, the plan starts at {expected_deg:.4}°: more than {most_deg}° away; move the arm there first",
        .joint + 1
    )]
    Start {
        /// Index of the joint.
        joint: usize,
        /// Position of the joint \[°\].
        found_deg: f64,
        /// Position at the start of the plan \[°\].
        expected_deg: f64,
        /// Largest difference allowed \[°\].
        most_deg: f64,
    },
    /// A setting that makes no sense.
    #[error("{name} must be {expected}; found {found}")]
    Setting {
        /// Its name.
        name: &'static str,
        /// Range or kind of value required.
        expected: String,
        /// Value found.
        found: String,
    },
    /// The arm is not the one that the plan is certified for.
    #[error("the plan is certified for the arm \"{expected}\" as another description states it; given is \"{found}\"")]
    OtherArm {
        /// The plan's arm.
        expected: String,
        /// The one given.
        found: String,
    },
    /// Points would have to be closer together than controllers take them.
    #[error(
        "at {t_s:.3} s the tip would be {:.3} mm from the plan with {:.0} ms between points, the closest that are written; {:.3} mm were \
         asked: allow more, run at a smaller share of the speed, or plan with lower accelerations",
        1e3 * .deviation_m, 1e3 * .least_s, 1e3 * .tolerance_m
    )]
    TooClose {
        /// Time in the plan \[s\].
        t_s: f64,
        /// Deviation of the tip from the plan \[m\].
        deviation_m: f64,
        /// Deviation allowed \[m\].
        tolerance_m: f64,
        /// The shortest time between two points \[s\].
        least_s: f64,
    },
    /// The motion of the program does not keep to the plan or to its job.
    #[error("{} is not kept{assuming}: {words}", .requirement.words())]
    NotKept {
        /// Requirement that is not kept.
        requirement: Requirement,
        /// The assumption, in words that follow a noun; empty where there is only one.
        assuming: String,
        /// Value found, and its place.
        words: String,
    },
}

impl Refusal {
    /// A stable word for it.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::Waived { .. } => "waived",
            Self::Arm { .. } | Self::Joint3 { .. } | Self::OtherArm { .. } => "arm",
            Self::Setting { .. } => "setting",
            Self::Load(_) => "load",
            Self::Frame(_) => "frame",
            Self::Start { .. } => "start",
            Self::TooClose { .. } => "segment_time",
            Self::NotKept { requirement, .. } => match requirement {
                Requirement::JointSpeed => "joint_speed",
                Requirement::PlanDeviation => "deviation",
                Requirement::Clearance | Requirement::ReducedClearance => "clearance",
                Requirement::Swept => "coverage",
                Requirement::ContactHeight => "contact",
                _ => "not_kept",
            },
        }
    }
}
