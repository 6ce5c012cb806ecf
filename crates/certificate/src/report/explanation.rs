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
        let (sentence, section, formulas) = check.requirement.explained();
        let page = match section {
            27..=31 | 33 => "contact",
            _ => "certificate",
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
            "The limit is the job's washing speed."
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

#[cfg(test)]
mod tests {
    use super::Requirement;
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
            let (sentence, section, formulas) = requirement.explained();
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
