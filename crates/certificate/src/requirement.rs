//! What is required of every plan.

use serde::{Deserialize, Serialize};

/// What is required of a plan, in the order of the certificate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Requirement {
    /// The plan is for this arm: its name and the hashes of its description and its SRDF.
    Arm,
    /// The tip is the middle of the sponge's far face.
    Tool,
    /// No plate reaches below the floor.
    Plates,
    /// A dry run's plates are raised, and the real ones stand below them as obstacles. Asked of dry runs alone.
    DryRun,
    /// The pairs that are left out are those that follow from the arm and its SRDF; any other keeps clear all the same, or is waived.
    Exclusions,
    /// Every plate has a wash path that can be judged.
    WashPaths,
    /// The segments follow one another from home to home.
    Segments,
    /// Every plate is washed once and the order says so; while another one is washed no more than its rim is swept.
    EveryPlateOnce,
    /// The motion starts and ends at rest in the job's home positions.
    HomeToHome,
    /// The arm rests where a wash begins and where it ends. A tilted sponge touches before and after: see
    /// [`Requirement::ContactSpeed`].
    RestAtWashEnds,
    /// No plate overlaps another or the base.
    PlatesApart,
    /// Joint positions, as the margin to the nearest limit.
    JointPosition,
    /// Joint speeds.
    JointSpeed,
    /// Joint accelerations.
    JointAcceleration,
    /// Speed of the tip, wherever it does not wash.
    TipSpeed,
    /// Acceleration of the tip, wherever it does not wash.
    TipAcceleration,
    /// Speed of the tip while it washes.
    WashSpeed,
    /// Acceleration of the tip while it washes.
    WashAcceleration,
    /// Angle of the tool from the plate's normal while it approaches, washes and retreats.
    Tilt,
    /// Height of the tip over or under the plate while it washes.
    ContactHeight,
    /// Speed of the sponge's rim, at every point at or below the plate's face, while it comes down and while it leaves.
    ContactSpeed,
    /// Distance of the tip from the wash path while it washes, the whole of it in order.
    PathDeviation,
    /// Distance of the tip from the plate's normal while it approaches and retreats.
    LineDeviation,
    /// Clearance of every pair.
    Clearance,
    /// How far the sponge reaches beyond the rim of the plate that it washes.
    Reach,
    /// Share of each plate that the sponge sweeps.
    Coverage,
    /// Share of each plate's face, by its area, that presses the sponge together by what counts as contact, wherever within its error of
    /// height the plate lies. Asked where the job does, like all up to [`Requirement::Wrist`].
    Contact,
    /// Share of each plate's face that is in contact long enough.
    ContactTime,
    /// Share of each plate's face that gets enough of a dose, pressure over sliding distance, in contact.
    ContactDose,
    /// Strain of the sponge anywhere.
    Strain,
    /// Force along the sponge's axis while it washes, between its least and its greatest.
    ContactForce,
    /// Joint 5 keeps from 0, always on the same side, from an approach to the retreat after it.
    Wrist,
    /// Distance of the tip from where the plan has it at that time: of a program alone.
    PlanDeviation,
}

impl Requirement {
    /// Those that are asked of every plan, in the order of the certificate; the last is of programs alone.
    pub const ALL: [Self; 26] = [
        Self::Arm,
        Self::Tool,
        Self::Plates,
        Self::Exclusions,
        Self::WashPaths,
        Self::Segments,
        Self::EveryPlateOnce,
        Self::HomeToHome,
        Self::RestAtWashEnds,
        Self::PlatesApart,
        Self::JointPosition,
        Self::JointSpeed,
        Self::JointAcceleration,
        Self::TipSpeed,
        Self::TipAcceleration,
        Self::WashSpeed,
        Self::WashAcceleration,
        Self::Tilt,
        Self::ContactHeight,
        Self::ContactSpeed,
        Self::PathDeviation,
        Self::LineDeviation,
        Self::Clearance,
        Self::Reach,
        Self::Coverage,
        Self::PlanDeviation,
    ];

    /// The words used in tables.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Arm => "arm",
            Self::Tool => "tool",
            Self::Plates => "plates",
            Self::DryRun => "dry run",
            Self::Exclusions => "exclusions",
            Self::WashPaths => "wash paths",
            Self::Segments => "segments",
            Self::EveryPlateOnce => "every plate once",
            Self::HomeToHome => "home to home",
            Self::RestAtWashEnds => "rest at wash ends",
            Self::PlatesApart => "plates apart",
            Self::JointPosition => "joint position",
            Self::JointSpeed => "joint speed",
            Self::JointAcceleration => "joint acceleration",
            Self::TipSpeed => "tip speed",
            Self::TipAcceleration => "tip acceleration",
            Self::WashSpeed => "wash speed",
            Self::WashAcceleration => "wash acceleration",
            Self::Tilt => "tilt",
            Self::ContactHeight => "contact height",
            Self::ContactSpeed => "contact speed",
            Self::PathDeviation => "path deviation",
            Self::LineDeviation => "line deviation",
            Self::Clearance => "clearance",
            Self::Reach => "reach beyond rim",
            Self::Coverage => "coverage",
            Self::Contact => "contact",
            Self::ContactTime => "contact time",
            Self::ContactDose => "contact dose",
            Self::Strain => "strain",
            Self::ContactForce => "contact force",
            Self::Wrist => "wrist",
            Self::PlanDeviation => "deviation from plan",
        }
    }
}
