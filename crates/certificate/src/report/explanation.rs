//! Explanations of requirements: a sentence, the formula, and whose the limit is.

use crate::report::check::Check;
use crate::report::requirement::Requirement;
use crate::report::verdict_basis::VerdictBasis;
use platewash_kinematics::trig::atan2;
use serde::Serialize;
use ts_rs::TS;

/// Explanation of a requirement to readers of its check.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, TS)]
pub struct Explanation {
    /// The requirement in a sentence.
    pub sentence: &'static str,
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
    pub fn of(check: &Check, basis: Option<&VerdictBasis>) -> Self {
        let (sentence, section, formulas) = parts(check.requirement);
        let page = if IN_CONTACT.contains(&section) {
            "contact"
        } else {
            "certificate"
        };
        Self {
            sentence,
            section: format!("docs/{page}.md, {section}"),
            formulas,
            limit: limit(check, basis),
        }
    }
}

/// Origin of the limits of joints.
const DESCRIBED: &str = "The limit is that of the arm's description.";

/// Sections of `docs/contact.md`; the others are in `docs/certificate.md`.
const IN_CONTACT: [u8; 6] = [27, 28, 29, 30, 31, 33];

/// Sentence, number of the section, and numbers of the formulas.
const fn parts(requirement: Requirement) -> (&'static str, u8, &'static [&'static str]) {
    use Requirement as R;
    match requirement {
        R::Arm => ("The arm is the one that the plan was made for.", 1, &[]),
        R::Tool => ("The tip is the middle of the sponge's far face.", 2, &[]),
        R::Plates => ("No plate reaches below the floor.", 3, &[]),
        R::DryRun => (
            "The plates of the dry run are raised, and the real ones stand below them as obstacles.",
            4,
            &[],
        ),
        R::Exclusions => (
            "No pair of bodies is left out of the proof of clearance but those that follow from the arm.",
            5,
            &[],
        ),
        R::WashPaths => ("Every plate has a wash path that can be judged.", 6, &[]),
        R::Segments => (
            "The parts of the motion follow one another from home to home without a gap.",
            7,
            &[],
        ),
        R::EveryPlateOnce => (
            "Each plate is washed once; meanwhile the sponge sweeps no more than the rim of another.",
            8,
            &["8.1"],
        ),
        R::HomeToHome => ("The motion starts and ends at rest at home.", 9, &[]),
        R::RestAtWashEnds => ("The arm rests where each wash begins and where it ends.", 10, &[]),
        R::PlatesApart => ("No plate overlaps another, the base or an obstacle.", 11, &[]),
        R::JointPosition => (
            "Distance of every joint from the nearer end of its range, at every moment.",
            12,
            &["12.1"],
        ),
        R::JointSpeed => (
            "Speed of every joint at every moment; shown is the one that takes most of its limit.",
            13,
            &["12.1", "12.2"],
        ),
        R::JointAcceleration => (
            "Acceleration of every joint at every moment; shown is the one that takes most of its limit.",
            14,
            &["12.1", "12.2"],
        ),
        R::TipSpeed => ("Speed of the tip while it does not wash.", 15, &["15.1"]),
        R::TipAcceleration => ("Acceleration of the tip while it does not wash.", 16, &["16.1"]),
        R::WashSpeed => ("Speed of the tip while it washes.", 17, &["15.1"]),
        R::WashAcceleration => ("Acceleration of the tip while it washes.", 18, &["16.1"]),
        R::Tilt => (
            "Angle between the tool and the plate's normal from the approach to the retreat.",
            19,
            &["19.1"],
        ),
        R::ContactHeight => (
            "Height of the tip over or under the plate's face while it washes.",
            20,
            &["20.1"],
        ),
        R::ContactSpeed => (
            "Speed of every touching point of the sponge while it comes down and while it leaves.",
            21,
            &["21.1", "21.2"],
        ),
        R::PathDeviation => (
            "Distance of the tip from the wash path, which it follows whole and in order.",
            22,
            &["22.1"],
        ),
        R::LineDeviation => (
            "Distance of the tip from the plate's normal while it approaches and retreats.",
            23,
            &["22.1"],
        ),
        R::Clearance => (
            "Distance between any two bodies that must not touch.",
            24,
            &["24.1", "24.2", "24.3"],
        ),
        R::ReducedClearance => (
            "Distance of the pairs for which the job states less than for the others.",
            24,
            &["24.1", "24.2", "24.3"],
        ),
        R::Reach => (
            "How far the sponge reaches beyond the rim of the plate that it washes.",
            25,
            &["25.1"],
        ),
        R::Swept => (
            "Share of each plate that the sponge goes over while it touches.",
            26,
            &["26.1"],
        ),
        R::Pressed => (
            "Share of each face that presses the sponge in far enough, however high the plate lies within the height error.",
            27,
            &["27.1", "27.2"],
        ),
        R::ContactTime => ("Share of each face that is pressed for long enough.", 28, &["28.1"]),
        R::ContactDose => (
            "Share of each face that gets enough dose: pressure times the way that the sponge slides.",
            29,
            &["28.1"],
        ),
        R::Strain => (
            "Greatest compression of the sponge, as a share of its height.",
            30,
            &["30.1"],
        ),
        R::ContactForce => (
            "Force along the sponge's axis while it washes, over the whole range of the foam's stiffness.",
            31,
            &["31.1"],
        ),
        R::Wrist => (
            "Distance of joint 5 from 0, where the wrist loses a direction, while the sponge is at a plate.",
            32,
            &["12.1"],
        ),
        R::PlateStays => (
            "Each plate stays where it is while the sponge presses it.",
            33,
            &["33.1", "33.2", "33.3", "33.4", "33.5"],
        ),
        R::PlanDeviation => (
            "Distance between the tip in the robot program and in the plan at the same time.",
            34,
            &["34.1"],
        ),
    }
}

/// Origin of a check's limit.
fn limit(check: &Check, basis: Option<&VerdictBasis>) -> String {
    use Requirement as R;
    let Some(measure) = check.measure else {
        return String::new();
    };
    let Some(basis) = basis else {
        return match check.requirement {
            R::JointPosition | R::JointSpeed => DESCRIBED.to_owned(),
            _ => "The limit was given with the motion.".to_owned(),
        };
    };
    let job = &basis.requirements;
    let is_described = |joint: usize| basis.described_accelerations.contains(&(joint + 1));
    match check.requirement {
        R::JointPosition | R::JointSpeed => DESCRIBED.to_owned(),
        R::JointAcceleration if check.worst.joint.is_some_and(is_described) => DESCRIBED.to_owned(),
        R::JointAcceleration => "The limit is the job's: an assumption, as the arm's description has none.".to_owned(),
        R::Tilt => tilt(measure.limit, basis),
        R::ContactHeight | R::PathDeviation | R::LineDeviation => {
            "The limit is a tolerance of the proof: it is the same for every plan.".to_owned()
        }
        R::ContactSpeed if job.landing_m_s.is_none() && job.lifting_m_s.is_none() => {
            "The limit is the job's washing speed.".to_owned()
        }
        R::ContactSpeed => "The limit is what the job states of landing and lifting.".to_owned(),
        R::Reach => "The limit follows from the planned wash path and its tilt: a sponge that stays on it reaches no farther. The job \
                     states none."
            .to_owned(),
        R::PlanDeviation => "The limit is the tolerance that the program was judged with.".to_owned(),
        R::PlateStays => "The limit follows from what the job states of the holder.".to_owned(),
        _ => "The limit is what the job asks for.".to_owned(),
    }
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

#[cfg(test)]
mod tests {
    use super::{Requirement, parts};
    use std::fs;
    use std::path::Path;

    #[test]
    fn every_explanation_names_its_section_and_formulas_of_the_documentation() {
        let page = |name: &str| {
            let file = Path::new(env!("CARGO_MANIFEST_DIR"))
                .join("../../docs")
                .join(format!("{name}.md"));
            fs::read_to_string(&file).unwrap()
        };
        let both = page("certificate") + &page("contact");
        for requirement in Requirement::ALL {
            let (sentence, section, formulas) = parts(*requirement);
            assert!(sentence.ends_with('.'), "{sentence}");
            // A statement has a row, every other requirement a section that begins with its name.
            let name = requirement.name();
            let in_row = both.contains(&format!("| {section} | {} (`{name}`)", requirement.words()));
            let own = format!("`{name}`");
            let of_section = |part: &&str| {
                let heading = part.lines().next().unwrap_or_default();
                let numbers: Vec<u8> = (heading.split('.').next().unwrap_or_default().split([',', '–']))
                    .filter_map(|number| number.trim().parse().ok())
                    .collect();
                numbers
                    .first()
                    .zip(numbers.last())
                    .is_some_and(|(from, to)| (*from..=*to).contains(&section))
            };
            let in_section = both.split("\n## ").filter(of_section).any(|part| part.contains(&own));
            assert!(in_row || in_section, "{name} in {section}");
            for formula in formulas {
                assert!(both.contains(&format!("\\tag{{{formula}}}")), "{formula}");
            }
        }
    }
}
