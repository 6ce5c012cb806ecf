//! Requirements of a plan.

use crate::report::unit::Unit;
use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// Declares the requirements once. A row has the identifier, the name, the units of its measures, the section of the documentation, the
/// formulas, the group of the page with the place in it, and a sentence. The enum, [`Requirement::ALL`], the names in files and settings
/// and the explanations follow from the rows, so none can be missing.
macro_rules! requirements {
    ($(
        $(#[$doc:meta])*
        $requirement:ident = $name:literal [$($unit:ident),*] $section:literal [$($formula:literal),*] $group:ident $place:literal
            $sentence:literal,
    )*) => {
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

            /// Row of the table of requirements.
            #[must_use]
            pub const fn row(self) -> RequirementRow {
                match self {
                    $(Self::$requirement => RequirementRow {
                        units: &[$(Unit::$unit),*],
                        section: $section,
                        formulas: &[$($formula),*],
                        group: RequirementGroup::$group,
                        place: $place,
                        sentence: $sentence,
                    },)*
                }
            }
        }
    };
}

/// Row of the table of requirements, beside the name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RequirementRow {
    /// Units of the requirement's measures in a certificate; empty for a statement, several where what is measured depends on the job.
    pub units: &'static [Unit],
    /// Number of the section of the documentation.
    pub section: u8,
    /// Numbers of the formulas that bound the measure: "24.1".
    pub formulas: &'static [&'static str],
    /// Group of the page.
    pub group: RequirementGroup,
    /// Place in the group, from 1: what people look at first comes first.
    pub place: u8,
    /// The requirement in a sentence.
    pub sentence: &'static str,
}

impl RequirementRow {
    /// Returns the page and the section of the documentation: "docs/certificate.md, 24". Contact has a page of its own.
    #[must_use]
    pub fn reference(&self) -> String {
        let page = match self.section {
            27..=31 | 33 => "contact",
            _ => "certificate",
        };
        format!("docs/{page}.md, {}", self.section)
    }
}

/// Group of requirements on the page. The names are the headings that readers see.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, TS)]
pub enum RequirementGroup {
    /// Purpose of the job: the plates are washed.
    Washed,
    /// Nothing is hit, scratched or pressed too hard.
    Safe,
    /// The arm keeps the limits of speed, acceleration and range.
    #[serde(rename = "Within limits")]
    WithinLimits,
}

requirements! {
    /// The arm is the one that the plan is for: same name, same hashes of the description and the SRDF.
    Arm = "arm" [] 1 [] Safe 14
        "The arm is the one that the plan was made for.",
    /// The tip is the middle of the sponge's far face.
    Tool = "tool" [] 2 [] Safe 13
        "The tip is the middle of the sponge's far face.",
    /// No plate reaches below the floor.
    Plates = "plates" [] 3 [] Safe 11
        "No plate reaches below the floor.",
    /// A dry run's plates are raised, and the real ones stand below them as obstacles. For dry runs only.
    DryRun = "dry_run" [] 4 [] Safe 15
        "The plates of the dry run are raised, and the real ones stand below them as obstacles.",
    /// The excluded pairs follow from the arm and its SRDF; any other excluded pair keeps clear all the same, or is waived.
    Exclusions = "exclusions" [] 5 [] Safe 12
        "No pair of bodies is left out of the proof of clearance but those that follow from the arm.",
    /// Every plate has a wash path that can be judged.
    WashPaths = "wash_paths" [] 6 [] Washed 9
        "Every plate has a wash path that can be judged.",
    /// The segments follow one another from home to home.
    Segments = "segments" [] 7 [] WithinLimits 6
        "The parts of the motion follow one another from home to home without a gap.",
    /// Every plate is in the order and is washed once; while another one is washed no more than its rim is swept.
    EveryPlateOnce = "every_plate_once" [] 8 ["8.1"] Washed 10
        "Each plate is washed once; meanwhile the sponge sweeps no more than the rim of another.",
    /// The motion starts and ends at rest in the job's home positions.
    HomeToHome = "home_to_home" [] 9 [] WithinLimits 7
        "The motion starts and ends at rest at home.",
    /// The arm rests where a wash begins and where it ends. A tilted sponge touches before and after: see
    /// [`Requirement::ContactSpeed`].
    RestAtWashEnds = "rest_at_wash_ends" [] 10 [] Safe 9
        "The arm rests where each wash begins and where it ends.",
    /// No plate overlaps another or the base.
    PlatesApart = "plates_apart" [] 11 [] Safe 10
        "No plate overlaps another, the base or an obstacle.",
    /// Joint positions, as the margin to the nearest limit.
    JointPosition = "joint_position" [Radian] 12 ["12.1"] WithinLimits 8
        "Distance of every joint from the nearer end of its range, at every moment.",
    /// Joint speeds.
    JointSpeed = "joint_speed" [RadianPerSecond] 13 ["12.1", "12.2"] WithinLimits 9
        "Speed of every joint at every moment; shown is the one that takes most of its limit.",
    /// Joint accelerations.
    JointAcceleration = "joint_acceleration" [RadianPerSecondSquared] 14 ["12.1", "12.2"] WithinLimits 10
        "Acceleration of every joint at every moment; shown is the one that takes most of its limit.",
    /// Speed of the tip while it does not wash.
    TipSpeed = "tip_speed" [MetrePerSecond] 15 ["15.1"] WithinLimits 3
        "Speed of the tip while it does not wash.",
    /// Acceleration of the tip while it does not wash.
    TipAcceleration = "tip_acceleration" [MetrePerSecondSquared] 16 ["16.1"] WithinLimits 4
        "Acceleration of the tip while it does not wash.",
    /// Speed of the tip while it washes.
    WashSpeed = "wash_speed" [MetrePerSecond] 17 ["15.1"] WithinLimits 1
        "Speed of the tip while it washes.",
    /// Acceleration of the tip while it washes.
    WashAcceleration = "wash_acceleration" [MetrePerSecondSquared] 18 ["16.1"] WithinLimits 2
        "Acceleration of the tip while it washes.",
    /// Angle of the tool from the plate's normal while it approaches, washes and retreats.
    Tilt = "tilt" [Radian] 19 ["19.1"] Safe 5
        "Angle between the tool and the plate's normal from the approach to the retreat.",
    /// Height of the tip over or under the plate while it washes.
    ContactHeight = "contact_height" [Metre] 20 ["20.1"] Washed 7
        "Height of the tip over or under the plate's face while it washes.",
    /// Speed of every touching point of the sponge, at or below the plate's face, while it comes down and while it leaves.
    ContactSpeed = "contact_speed" [MetrePerSecond] 21 ["21.1", "21.2"] Safe 3
        "Speed of every touching point of the sponge while it comes down and while it leaves.",
    /// Distance of the tip from the wash path, which it follows completely and in order.
    PathDeviation = "path_deviation" [Metre] 22 ["22.1"] Washed 8
        "Distance of the tip from the wash path, which it follows whole and in order.",
    /// Distance of the tip from the plate's normal while it approaches and retreats.
    LineDeviation = "line_deviation" [Metre] 23 ["22.1"] Safe 7
        "Distance of the tip from the plate's normal while it approaches and retreats.",
    /// Clearance of every pair.
    Clearance = "clearance" [Metre] 24 ["24.1", "24.2", "24.3"] Safe 1
        "Distance between any two bodies that must not touch.",
    /// Clearance of the pairs that keep less than the others, as the job states. For jobs with such pairs only.
    ReducedClearance = "reduced_clearance" [Metre] 24 ["24.1", "24.2", "24.3"] Safe 2
        "Distance of the pairs for which the job states less than for the others.",
    /// Reach of the sponge beyond the rim of the plate that it washes.
    Reach = "reach" [Metre] 25 ["25.1"] Safe 6
        "How far the sponge reaches beyond the rim of the plate that it washes.",
    /// Share of each plate that the sponge sweeps.
    Swept = "swept" [Share] 26 ["26.1"] Washed 2
        "Share of each plate that the sponge goes over while it touches.",
    /// Share of each plate's face, by area, that compresses the sponge enough to count as contact, for every plate height within the error.
    /// Applies where the job has contact requirements, like all up to [`Requirement::Wrist`].
    Pressed = "pressed" [Share] 27 ["27.1", "27.2"] Washed 1
        "Share of each face that presses the sponge in far enough, however high the plate lies within the height error.",
    /// Share of each plate's face that is in contact long enough.
    ContactTime = "contact_time" [Share] 28 ["28.1"] Washed 3
        "Share of each face that is pressed for long enough.",
    /// Share of each plate's face that gets enough dose, pressure integrated over sliding distance, in contact.
    ContactDose = "contact_dose" [Share] 29 ["28.1"] Washed 4
        "Share of each face that gets enough dose: pressure times the way that the sponge slides.",
    /// Greatest strain of the sponge.
    Strain = "strain" [Share] 30 ["30.1"] Safe 4
        "Greatest compression of the sponge, as a share of its height.",
    /// Force along the sponge's axis while it washes, between the least and the greatest allowed.
    ContactForce = "contact_force" [Newton] 31 ["31.1"] Washed 5
        "Force along the sponge's axis while it washes, over the whole range of the foam's stiffness.",
    /// Distance of joint 5 from 0, on the same side from an approach to the retreat after it.
    Wrist = "wrist" [Radian] 32 ["12.1"] Safe 8
        "Distance of joint 5 from 0, where the wrist loses a direction, while the sponge is at a plate.",
    /// Each plate stays where it is while the sponge presses it. For jobs that state what holds the plates.
    PlateStays = "plate_stays" [Newton, NewtonMetre, Share] 33 ["33.1", "33.2", "33.3", "33.4", "33.5"] Washed 6
        "Each plate stays where it is while the sponge presses it.",
    /// Distance of the tip from its position in the plan at the same time. For programs only.
    PlanDeviation = "plan_deviation" [Metre] 34 ["34.1"] WithinLimits 5
        "Distance between the tip in the robot program and in the plan at the same time.",
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
    use super::{Requirement, RequirementGroup};

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

    #[test]
    fn every_group_of_the_page_counts_its_places() {
        for group in [
            RequirementGroup::Washed,
            RequirementGroup::Safe,
            RequirementGroup::WithinLimits,
        ] {
            let rows = Requirement::ALL.iter().map(|requirement| requirement.row());
            let mut places: Vec<_> = rows.filter(|row| row.group == group).map(|row| row.place).collect();
            places.sort_unstable();
            let expected: Vec<_> = (1..=u8::try_from(places.len()).unwrap()).collect();
            assert_eq!(places, expected, "{group:?}");
        }
    }
}
