//! The maker's joints: how a controller counts axis 3 of an arm with a parallel linkage, and the arms of which that is known.
//!
//! Over a parallel linkage axis 3 holds the forearm's direction in space while axis 2 alone moves. ABB's controllers then count the two together:
//! `rax_3 = joint_3 + joint_2`, the joints of the description on the right. (FANUC's count `J3 = joint_3 - joint_2` for most of their arms,
//! with a plus for the M-430iA; there is no dialect for them.) Source of both: ROS-Industrial's drivers, `linkage_transform` in `abb_utils.cpp` and
//! in `fanuc_utils.cpp`, which is called with `J23_coupled` and `J23_factor`.
//!
//! The map is linear, so it takes straight lines to straight lines and parabolas to parabolas, at the same times: a controller that moves evenly
//! in its own joints moves evenly in the description's. Points, corners and speeds are therefore chosen and judged in the description's joints,
//! and a program alone has the maker's. Sizes do not carry over: if axes 2 and 3 of the maker are off by d each, joint 3 is off by up to 2 d.

use crate::dialect::language::Dialect;
use crate::joint_3::Joint3;
use crate::program::Point;
use crate::refusal::Refusal;
use platewash_kinematics::RobotModel;
use platewash_kinematics::words::{decimals_up, fixed};

/// An arm of ABB of which the count of axis 3 is publicly known, or publicly doubtful.
#[derive(Debug)]
struct ListedArm {
    /// Number of the model, with the letters behind it where only that variant is meant; in small letters.
    model: &'static str,
    /// The count; `None` where sources contradict each other or leave it open.
    joint_3: Option<Joint3>,
    /// Repository on GitHub with the folder or thread that states the count, or a page.
    source: &'static str,
}

const fn arm(model: &'static str, joint_3: Option<Joint3>, source: &'static str) -> ListedArm {
    ListedArm { model, joint_3, source }
}

const COUPLED: Option<Joint3> = Some(Joint3::WithJoint2);
const SERIAL: Option<Joint3> = Some(Joint3::Independent);
const ABB: &str = "ros-industrial/abb, launch files (J23_coupled)";
const EXPERIMENTAL: &str = "ros-industrial/abb_experimental, launch files (J23_coupled)";
const CORRECTED: &str = "ros-industrial/abb, older launch files; abb_experimental#155 corrects those of serial arms";

/// The arms; read on 2026-11-29. The launch files are `abb_irb<model>_support/launch/robot_interface_download_irb<model>….launch`.
static ARMS: [ListedArm; 21] = [
    arm("2400", COUPLED, ABB),
    arm("4400", COUPLED, ABB),
    arm("6660", COUPLED, EXPERIMENTAL),
    arm("5400", None, "ros-industrial/abb#206, against its launch file"),
    arm("1410", None, "ros-industrial/abb#189: no package"),
    // blogs/knowledge/abb-irb-240044006400-j2j3-axis-coupling-in-moveabsj
    arm("6400", None, "industrialmonitordirect.com"),
    arm("8700", None, "RobotComponents/RobotComponents#181"),
    arm("52", None, CORRECTED),
    arm("6650s", None, CORRECTED),
    arm("7600", None, CORRECTED),
    arm("120", SERIAL, ABB),
    arm("140", SERIAL, EXPERIMENTAL),
    arm("1200", SERIAL, ABB),
    arm("1300", SERIAL, EXPERIMENTAL),
    // Of the 10/1.45; the older ones of the others are corrected by #155. So it is for the 6700.
    arm("1600", SERIAL, EXPERIMENTAL),
    arm("2600", SERIAL, EXPERIMENTAL),
    arm("4600", SERIAL, EXPERIMENTAL),
    arm("6600", SERIAL, ABB),
    arm("6640", SERIAL, ABB),
    arm("6700", SERIAL, ABB),
    arm("15000", SERIAL, EXPERIMENTAL),
];

/// The arm on the list that a description's name means: `irb2400`, `abb_irb_2400-16`, `ABB IRB 4400L`. The number stands behind `irb`, `crb` or `abb`.
fn listed(name: &str) -> Option<&'static ListedArm> {
    let name = name.to_ascii_lowercase();
    let model = |(at, maker): (usize, &str)| {
        let rest = name[at + maker.len()..].trim_start_matches(['_', '-', ' ', '.']);
        let digits = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
        let letters = rest[digits..].find(|c: char| !c.is_ascii_alphabetic());
        let whole = letters.map_or(rest, |length| &rest[..digits + length]);
        ARMS.iter().find(|arm| [whole, &rest[..digits]].contains(&arm.model))
    };
    ["irb", "crb", "abb"]
        .iter()
        .flat_map(|maker| name.match_indices(maker))
        .find_map(model)
}

/// Refuses a count of axis 3 that a dialect cannot state, and asks for one where the arm's is not known to be independent.
///
/// # Errors
/// [`Refusal::Setting`]; [`Refusal::Joint3`].
pub(crate) fn check(dialect: &dyn Dialect, arm: &RobotModel, stated: Option<Joint3>) -> Result<(), Refusal> {
    let has_maker_joints = dialect.has_maker_joints();
    match (stated, listed(arm.name()).filter(|arm| arm.joint_3 != SERIAL)) {
        (Some(Joint3::WithJoint2), _) if !has_maker_joints => Err(Refusal::Setting {
            name: "joint_3",
            expected: format!(
                "left out or independent: the joints of a {} program are the description's",
                dialect.name()
            ),
            found: Joint3::WithJoint2.name().to_owned(),
        }),
        (None, Some(listed)) if has_maker_joints => Err(Refusal::Joint3 {
            arm: arm.name().to_owned(),
            known: match listed.joint_3 {
                Some(_) => format!("as stated for this arm by {}", listed.source),
                None => format!("which public sources leave open for this arm ({})", listed.source),
            },
        }),
        _ => Ok(()),
    }
}

/// States what joint 3 of a program is, as a sentence of its head; `None` where the arm's list leaves no question.
pub(crate) fn assumption(
    dialect: &dyn Dialect,
    arm: &RobotModel,
    (joint_3, speed_share): (Option<Joint3>, f64),
    points: &[Point],
) -> Option<String> {
    let listed = listed(arm.name());
    match (dialect.has_maker_joints(), joint_3) {
        (true, Some(Joint3::WithJoint2)) => {
            let against = listed.filter(|arm| arm.joint_3 == SERIAL);
            let against = against.map_or_else(String::new, |arm| format!(" Independent by {}.", arm.source));
            Some(coupled(speed_share, points) + &against)
        }
        (true, None) if listed.is_some() => None,
        (true, _) => Some("rax_3 is counted on its own, as the description's joint 3.".to_owned()),
        (false, _) => {
            let is_asked = listed.is_some_and(|arm| arm.joint_3 != SERIAL);
            let is_fanuc = arm.name().to_ascii_lowercase().contains("fanuc");
            (is_asked || is_fanuc).then(|| {
                "Joint 3 is the description's. The controller of this arm may count axis 3 together with axis 2: convert it before the \
                 controller's own program states it."
                    .to_owned()
            })
        }
    }
}

/// The sentence for a program that counts axis 3 with axis 2, with what the maker's axis 3 does at a share of the plan's speed.
fn coupled(speed_share: f64, points: &[Point]) -> String {
    let axis_deg = |point: &Point| Joint3::WithJoint2.convert(&point.q_rad)[2].to_degrees();
    let all = || points.iter().map(axis_deg);
    let [least, most] = [
        all().fold(f64::INFINITY, f64::min),
        all().fold(f64::NEG_INFINITY, f64::max),
    ];
    let speeds = points.windows(2).map(|both| {
        let [before, after] = [&both[0], &both[1]];
        (axis_deg(after) - axis_deg(before)).abs() / (after.t_s - before.t_s) * speed_share
    });
    format!(
        "rax_3 is the description's joint_3 + joint_2 (parallel linkage): from {} to {} deg, at up to {} deg/s. The controller's limits of it are not \
         known and not judged; those of joint 3 are the description's.",
        fixed(least, 4),
        fixed(most, 4),
        decimals_up(speeds.fold(0.0, f64::max), 1)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arms_are_known_by_any_spelling_of_their_name() {
        let count = |name: &str| listed(name).map(|arm| (arm.model, arm.joint_3));
        for name in [
            "abb_irb2400",
            "irb_2400",
            "ABB IRB 2400/16",
            "abb_irb2400_12_155",
            "IRB2400L",
            "abb2400",
        ] {
            assert_eq!(count(name), Some(("2400", COUPLED)), "{name}");
        }
        for name in ["abb_irb4400l_30_243", "abb-irb-4400", "abb_airbus_irb4400"] {
            assert_eq!(count(name), Some(("4400", COUPLED)), "{name}");
        }
        for name in ["irb120", "abb_irb120_3_58", "abb_irb120t_3_58", "IRB 120T"] {
            assert_eq!(count(name), Some(("120", SERIAL)), "{name}");
        }
        assert_eq!(count("abb_irb1200_5_90"), Some(("1200", SERIAL)));
        assert_eq!(count("abb_irb6650s_90_390"), Some(("6650s", None)));
        assert_eq!(count("abb_irb52_7_120"), Some(("52", None)));
        for name in [
            "abb_irb6650",
            "abb_irb24000",
            "abb",
            "abb_irb",
            "irb_x2400",
            "ur5",
            "",
            "abb_é2400",
            "irbé",
        ] {
            assert_eq!(count(name), None, "{name}");
        }
    }

    #[test]
    fn every_model_stands_once_in_the_list() {
        for (k, arm) in ARMS.iter().enumerate() {
            assert!(ARMS[..k].iter().all(|other| other.model != arm.model), "{arm:?}");
            assert_eq!(
                listed(&format!("abb_irb{}", arm.model)).map(|found| found.model),
                Some(arm.model)
            );
        }
    }
}
