//! Requirements of a plan.

use serde::{Deserialize, Serialize};

/// Declares the requirements once. The enum, [`Requirement::ALL`] and the names in files and settings follow from the list, so none can be
/// missing.
macro_rules! requirements {
    ($($(#[$doc:meta])* $requirement:ident = $name:literal,)*) => {
        /// A requirement of a plan, in the order of the certificate.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
        #[non_exhaustive]
        pub enum Requirement {
            $($(#[$doc])* #[serde(rename = $name)] $requirement,)*
        }

        impl Requirement {
            /// All requirements, in the order of the certificate. Some apply only to some plans.
            pub const ALL: &'static [Self] = &[$(Self::$requirement,)*];

            /// Name in JSON, settings and Python.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$requirement => $name,)*
                }
            }
        }
    };
}

requirements! {
    /// The arm is the one that the plan is for: same name, same hashes of the description and the SRDF.
    Arm = "arm",
    /// The tip is the middle of the sponge's far face.
    Tool = "tool",
    /// No plate reaches below the floor.
    Plates = "plates",
    /// A dry run's plates are raised, and the real ones stand below them as obstacles. For dry runs only.
    DryRun = "dry_run",
    /// The excluded pairs follow from the arm and its SRDF; any other excluded pair keeps clear all the same, or is waived.
    Exclusions = "exclusions",
    /// Every plate has a wash path that can be judged.
    WashPaths = "wash_paths",
    /// The segments follow one another from home to home.
    Segments = "segments",
    /// Every plate is in the order and is washed once; while another one is washed no more than its rim is swept.
    EveryPlateOnce = "every_plate_once",
    /// The motion starts and ends at rest in the job's home positions.
    HomeToHome = "home_to_home",
    /// The arm rests where a wash begins and where it ends. A tilted sponge touches before and after: see
    /// [`Requirement::ContactSpeed`].
    RestAtWashEnds = "rest_at_wash_ends",
    /// No plate overlaps another or the base.
    PlatesApart = "plates_apart",
    /// Joint positions, as the margin to the nearest limit.
    JointPosition = "joint_position",
    /// Joint speeds.
    JointSpeed = "joint_speed",
    /// Joint accelerations.
    JointAcceleration = "joint_acceleration",
    /// Speed of the tip while it does not wash.
    TipSpeed = "tip_speed",
    /// Acceleration of the tip while it does not wash.
    TipAcceleration = "tip_acceleration",
    /// Speed of the tip while it washes.
    WashSpeed = "wash_speed",
    /// Acceleration of the tip while it washes.
    WashAcceleration = "wash_acceleration",
    /// Angle of the tool from the plate's normal while it approaches, washes and retreats.
    Tilt = "tilt",
    /// Height of the tip over or under the plate while it washes.
    ContactHeight = "contact_height",
    /// Speed of every touching point of the sponge, at or below the plate's face, while it comes down and while it leaves.
    ContactSpeed = "contact_speed",
    /// Distance of the tip from the wash path, which it follows completely and in order.
    PathDeviation = "path_deviation",
    /// Distance of the tip from the plate's normal while it approaches and retreats.
    LineDeviation = "line_deviation",
    /// Clearance of every pair.
    Clearance = "clearance",
    /// Clearance of the pairs that keep less than the others, as the job states. For jobs with such pairs only.
    ReducedClearance = "reduced_clearance",
    /// Reach of the sponge beyond the rim of the plate that it washes.
    Reach = "reach",
    /// Share of each plate that the sponge sweeps.
    Swept = "swept",
    /// Share of each plate's face, by area, that compresses the sponge enough to count as contact, for every plate height within the error.
    /// Applies where the job has contact requirements, like all up to [`Requirement::Wrist`].
    Pressed = "pressed",
    /// Share of each plate's face that is in contact long enough.
    ContactTime = "contact_time",
    /// Share of each plate's face that gets enough dose, pressure integrated over sliding distance, in contact.
    ContactDose = "contact_dose",
    /// Greatest strain of the sponge.
    Strain = "strain",
    /// Force along the sponge's axis while it washes, between the least and the greatest allowed.
    ContactForce = "contact_force",
    /// Distance of joint 5 from 0, on the same side from an approach to the retreat after it.
    Wrist = "wrist",
    /// Each plate stays where it is while the sponge presses it. For jobs that state what holds the plates.
    PlateStays = "plate_stays",
    /// Distance of the tip from its position in the plan at the same time. For programs only.
    PlanDeviation = "plan_deviation",
}

impl Requirement {
    /// Returns the name with spaces, as tables, sentences and pages show it.
    #[must_use]
    pub fn words(self) -> String {
        self.name().replace('_', " ")
    }

    /// Returns the requirement of a name, written with underscores or spaces; `None` for an unknown name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let name = name.trim().replace(' ', "_");
        Self::ALL.iter().copied().find(|requirement| requirement.name() == name)
    }
}

#[cfg(test)]
mod tests {
    use super::Requirement;

    #[test]
    fn every_requirement_is_found_by_its_one_name() {
        for requirement in Requirement::ALL {
            let json = serde_json::to_value(requirement).unwrap();
            assert_eq!(json, requirement.name());
            assert_eq!(serde_json::from_value::<Requirement>(json).unwrap(), *requirement);
            for name in [requirement.name(), &requirement.words()] {
                assert_eq!(Requirement::named(name), Some(*requirement), "{name}");
            }
        }
        assert!(Requirement::ALL.is_sorted(), "the order of the certificate");
        assert_eq!(Requirement::named("deviation from plan"), None);
    }
}
