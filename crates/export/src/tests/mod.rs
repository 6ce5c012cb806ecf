//! The way from a certified plan to a program that is judged, in the plainest of dialects.

mod toy;

use crate::export::{self, ExportError};
use crate::program::ProgramFile;
use crate::tests::toy::Toy;
use crate::{
    CompareError, ExportSettings, ExportedProgram, ProgramComparison, Refusal, compare, contact_not_judged, judgement,
};
use nalgebra::{Translation3, UnitQuaternion};
use platewash_certificate::{Certified, Requirement, certify};
use platewash_fixtures as fixtures;
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{JointVector, Pose, RobotModel};
use platewash_motion::plan::Plan;
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::job::ContactRequirements;
use std::sync::OnceLock;

fn arm() -> RobotModel {
    RobotModel::irb120().unwrap()
}

fn kitchen() -> &'static Certified<Plan> {
    static KITCHEN: OnceLock<Certified<Plan>> = OnceLock::new();
    KITCHEN.get_or_init(|| {
        let job = fixtures::kitchen();
        certify(platewash_planner::plan(&job).unwrap().plan, job.arm()).unwrap()
    })
}

fn export(settings: &ExportSettings) -> Result<ExportedProgram, ExportError> {
    export::export(kitchen(), &arm(), &Toy, settings, &CancelToken::new())
}

fn refused(settings: &ExportSettings) -> Refusal {
    match export(settings) {
        Err(ExportError::Refused(refusal)) => refusal,
        other => panic!("{other:?}"),
    }
}

fn bound(exported: &ExportedProgram, requirement: Requirement) -> f64 {
    let worst = exported.judgement.worst();
    let check = worst.iter().find(|check| check.requirement == requirement).unwrap();
    check.measure.unwrap().bound.unwrap()
}

#[test]
fn exports_as_few_points_as_the_tolerance_needs() {
    let mut last = usize::MAX;
    for tolerance_m in [1e-4, 2e-4, 5e-4, 2e-3] {
        let exported = export(&ExportSettings {
            tolerance_m,
            ..ExportSettings::default()
        })
        .unwrap();
        let deviation_m = bound(&exported, Requirement::PlanDeviation);
        // Points that are not needed would leave the bound far below the tolerance.
        assert!(
            deviation_m <= tolerance_m && deviation_m > 0.85 * tolerance_m,
            "{tolerance_m}: {deviation_m}"
        );
        assert_eq!(exported.judgement.cases.len(), 4);
        let points = exported.reading.points;
        assert!(points.len() < last, "{tolerance_m}: {} points", points.len());
        last = points.len();
        let least_s = points
            .windows(2)
            .map(|both| both[1].t_s - both[0].t_s)
            .fold(1.0, f64::min);
        assert!(least_s >= 0.01, "{least_s}");
        assert!((points[points.len() - 1].t_s - kitchen().plan().duration_s()).abs() < 1e-9);
    }
}

/// Every wash begins and ends with a stop, at the plan's own moment.
#[test]
fn the_arm_stops_where_the_plan_rests_and_nowhere_else() {
    let exported = export(&ExportSettings::default()).unwrap();
    let stops: Vec<_> = exported
        .reading
        .points
        .iter()
        .filter(|point| point.corner_m.is_none())
        .collect();
    assert_eq!(stops.len(), 2 * kitchen().plan().order.len() + 2);
    let motion = kitchen().plan().knots.motion().unwrap();
    for stop in stops {
        assert!(motion.at(stop.t_s).unwrap().qd.amax() < 1e-9);
    }
}

#[test]
fn a_share_of_the_speed_makes_a_longer_program_on_the_same_path() {
    let whole = export(&ExportSettings::default()).unwrap();
    let half = export(&ExportSettings {
        speed_share: 0.5,
        ..ExportSettings::default()
    })
    .unwrap();
    let [a, b] = [&whole, &half].map(|exported| exported.reading.points.last().unwrap().t_s);
    assert!((2.0 * a - b).abs() < 1e-9);
    let deviation = |exported| bound(exported, Requirement::PlanDeviation);
    assert!(deviation(&half) <= 2e-4);
    let speed = |exported| bound(exported, Requirement::JointSpeed);
    assert!(
        (speed(&whole) - 2.0 * speed(&half)).abs() < 0.02,
        "{} {}",
        speed(&whole),
        speed(&half)
    );
}

#[test]
fn the_same_plan_gives_the_same_bytes_with_its_origin() {
    let [a, b] = [0, 1].map(|_| export(&ExportSettings::default()).unwrap().files);
    assert_eq!(a, b);
    let head: Vec<_> = a[0].text.lines().filter(|line| line.starts_with('#')).collect();
    let head = head.join("\n");
    assert!(head.is_ascii());
    let plan = kitchen().plan();
    for words in [
        plan.hash.as_deref().unwrap(),
        &plan.job.workcell.arm.urdf_sha256,
        "certificate sha256:",
        "HOLDS",
        "plan deviation: at most 0.19",
        "not a safety function",
        "nothing of it is true",
        "0.3 kg",
        "42.679 s",
        "platewash setting: tolerance_m = 0.0002",
    ] {
        assert!(head.contains(words), "{words}\n{head}");
    }
}

#[test]
fn settings_that_make_no_sense_are_refused_by_name() {
    let default = ExportSettings::default;
    for (name, settings) in [
        (
            "tolerance_m",
            ExportSettings {
                tolerance_m: f64::NAN,
                ..default()
            },
        ),
        (
            "tolerance_m",
            ExportSettings {
                tolerance_m: -2e-4,
                ..default()
            },
        ),
        (
            "tolerance_m",
            ExportSettings {
                tolerance_m: f64::INFINITY,
                ..default()
            },
        ),
        (
            "speed_share",
            ExportSettings {
                speed_share: 0.0,
                ..default()
            },
        ),
        (
            "speed_share",
            ExportSettings {
                speed_share: 1.01,
                ..default()
            },
        ),
        (
            "corner_m",
            ExportSettings {
                corner_m: f64::NAN,
                ..default()
            },
        ),
        (
            "stands_rad",
            ExportSettings {
                stands_rad: Some(JointVector::repeat(f64::NAN)),
                ..default()
            },
        ),
    ] {
        let refusal = refused(&settings);
        assert_eq!(refusal.code(), "setting");
        assert!(refusal.to_string().starts_with(name), "{refusal}");
    }
}

#[test]
fn an_arm_that_stands_elsewhere_is_refused_and_one_that_is_near_is_not() {
    let start = kitchen().plan().job.home_rad[0];
    let stands = |joint: usize, off_deg: f64| {
        let mut q = start;
        q[joint] += off_deg.to_radians();
        ExportSettings {
            stands_rad: Some(q),
            ..ExportSettings::default()
        }
    };
    for joint in 0..6 {
        let refusal = refused(&stands(joint, -0.51));
        assert_eq!(refusal.code(), "start");
        assert!(
            refusal.to_string().contains(&format!("joint {} ", joint + 1)),
            "{refusal}"
        );
        assert!(export(&stands(joint, 0.49)).is_ok());
    }
}

#[test]
fn another_tool_frame_is_refused() {
    let tip = kitchen().plan().job.workcell.tool.tip;
    let with = |tip| ExportSettings {
        tip: Some(tip),
        ..ExportSettings::default()
    };
    assert!(export(&with(tip)).is_ok());
    let moved = Pose::from_parts(Translation3::new(0.0, 0.0006, 0.15), tip.rotation);
    let turned = Pose::from_parts(tip.translation, UnitQuaternion::from_euler_angles(0.02, 0.0, 0.0));
    for other in [moved, turned] {
        assert_eq!(refused(&with(other)).code(), "frame");
    }
}

#[test]
fn another_arm_is_refused() {
    let urdf = platewash_kinematics::irb120::IRB120_URDF.replacen("<robot name=\"", "<robot name=\"other_", 1);
    let other = RobotModel::from_urdf(&urdf, &MeshSource::default()).unwrap();
    let exported = export::export(kitchen(), &other, &Toy, &ExportSettings::default(), &CancelToken::new());
    let Err(ExportError::Refused(refusal)) = exported else {
        panic!("{exported:?}");
    };
    assert_eq!(refusal.code(), "arm");
}

#[test]
fn points_that_would_be_too_close_are_refused() {
    let refusal = refused(&ExportSettings {
        tolerance_m: 2e-5,
        ..ExportSettings::default()
    });
    assert_eq!(refusal.code(), "segment_time");
    assert!(refusal.to_string().contains("10 ms"), "{refusal}");
    // At half the speed there is time for them.
    assert!(
        export(&ExportSettings {
            tolerance_m: 2e-5,
            speed_share: 0.5,
            ..ExportSettings::default()
        })
        .is_ok()
    );
}

/// Half of the time for the same way: speeds beyond the limits, and far from the plan at every moment.
#[test]
fn a_program_that_does_not_hold_is_refused_by_name() {
    let mut exported = export(&ExportSettings::default()).unwrap();
    exported.reading.points.iter_mut().for_each(|point| point.t_s *= 0.5);
    let judged = judgement::judge(kitchen(), &exported.reading, &arm(), 2e-4, &CancelToken::new()).unwrap();
    assert!(!judged.holds());
    let refusal = judged.accepted().unwrap_err();
    assert!(
        ["joint_speed", "contact", "deviation"].contains(&refusal.code()),
        "{refusal}"
    );
    let broken: Vec<_> = judged
        .worst()
        .into_iter()
        .filter(|check| !check.status.is_kept())
        .collect();
    assert!(broken.iter().any(|check| check.requirement == Requirement::JointSpeed));
    assert!(
        broken
            .iter()
            .any(|check| check.requirement == Requirement::PlanDeviation)
    );
}

#[test]
fn a_cancelled_export_writes_nothing() {
    let cancel = CancelToken::new();
    cancel.cancel();
    let exported = export::export(kitchen(), &arm(), &Toy, &ExportSettings::default(), &cancel);
    assert!(
        matches!(exported, Err(ExportError::Prove(error)) if error.to_string().contains("given up") || error.to_string().contains("cancel"))
    );
}

/// Compares a program whose text is changed.
fn compared(change: impl Fn(&str) -> String) -> Result<ProgramComparison, CompareError> {
    let settings = ExportSettings {
        speed_share: 0.8,
        ..ExportSettings::default()
    };
    let files = export(&settings).unwrap().files;
    let changed = files.iter().map(|file| ProgramFile {
        name: file.name.clone(),
        text: change(&file.text),
    });
    let changed: Vec<_> = changed.collect();
    compare::compare_in(kitchen(), &arm(), &Toy, &changed, &CancelToken::new())
}

/// The text that is changed.
fn text() -> String {
    let settings = ExportSettings {
        speed_share: 0.8,
        ..ExportSettings::default()
    };
    export(&settings).unwrap().files[0].text.clone()
}

/// Subjects of the changes.
fn about(compared: &ProgramComparison) -> Vec<&str> {
    compared.changes.iter().map(|change| change.what.as_str()).collect()
}

/// The line from which a text is edited, and its number.
fn line_of(text: &str, point: usize) -> (usize, String) {
    let mut points = text.lines().enumerate().filter(|(_, line)| !line.starts_with('#'));
    let (i, line) = points.nth(point).unwrap();
    (i + 1, line.to_owned())
}

#[test]
fn finds_no_change_in_an_unchanged_program() {
    let same = compared(str::to_owned).unwrap();
    assert!(same.is_unchanged() && same.holds(), "{:?}", same.changes);
    // Line ends, spaces, and how numbers are written.
    let respelled = compared(|text| text.replace('\n', "  \n\n").replace(" 0.005 ", " 5.0E-03 ")).unwrap();
    assert!(respelled.is_unchanged() && respelled.holds(), "{:?}", respelled.changes);
}

#[test]
fn finds_a_changed_digit_in_its_line() {
    let (line, before) = line_of(&text(), 300);
    let words: Vec<_> = before.split(' ').map(str::to_owned).collect();
    let edit = |word: usize, by: f64| {
        let mut words = words.clone();
        words[word] = (words[word].parse::<f64>().unwrap() + by).to_string();
        let after = words.join(" ");
        compared(|text| text.replace(&before, &after)).unwrap()
    };
    let found = edit(4, 1e-6);
    assert_eq!(about(&found), ["joint 3"]);
    assert_eq!(found.changes[0].place, format!("unnamed.toy:{line}"));
    assert!(found.holds(), "a micrometre is within the tolerance");
    let found = edit(4, 1e-2);
    assert_eq!(about(&found), ["joint 3"]);
    assert!(!found.holds());
    let found = edit(0, 1e-5);
    assert_eq!(about(&found), ["time"]);
    assert_eq!(found.changes[0].place, format!("unnamed.toy:{line}"));
    let found = edit(1, 0.004);
    assert_eq!(about(&found), ["corner"]);
    assert!(found.holds());
}

#[test]
fn finds_missing_and_added_lines_where_they_are() {
    let (line, before) = line_of(&text(), 300);
    let found = compared(|text| text.replace(&format!("{before}\n"), "")).unwrap();
    assert_eq!(found.changes.len(), 1, "{:?}", found.changes);
    assert_eq!(about(&found), ["line that is missing behind it"]);
    assert_eq!(found.changes[0].place, format!("unnamed.toy:{}", line - 1));
    assert!(found.changes[0].expected.starts_with(&before[..40]));
    assert!(!found.holds(), "a point less than needed is too few");
    let found = compared(|text| text.replace(&before, &format!("# nothing new\n{before}"))).unwrap();
    assert_eq!(
        (about(&found), found.changes[0].found.as_str()),
        (vec!["line"], "# nothing new")
    );
    assert_eq!(found.changes[0].place, format!("unnamed.toy:{line}"));
    assert!(found.holds());
}

/// Changes outside the motion are listed too, such as those of the head.
#[test]
fn names_a_changed_header() {
    let found = compared(|text| text.replace("not a safety function", "a safety function")).unwrap();
    assert_eq!(found.changes.len(), 1);
    assert!(found.changes[0].expected.contains("not a safety function"));
}

#[test]
fn rejects_a_program_of_another_plan_by_its_hash() {
    let hash = kitchen().plan().hash.clone().unwrap();
    let other = "0123456789abcdef".repeat(4);
    let refused = compared(|text| text.replace(&hash, &other)).unwrap_err();
    assert!(
        matches!(&refused, CompareError::OtherPlan { found, .. } if *found == other),
        "{refused}"
    );
}

/// A tolerance that was widened in the head is the one that the program is judged by.
#[test]
fn judges_a_program_by_its_edited_setting() {
    let found = compared(|text| text.replace("tolerance_m = 0.0002", "tolerance_m = 0.001")).unwrap();
    assert_eq!(found.tolerance_m, 1e-3);
    let refused = compared(|text| text.replace("tolerance_m = 0.0002", "tolerance_m = 1"));
    assert!(matches!(refused, Err(CompareError::Again(_))), "{refused:?}");
    let refused = compared(|text| text.replace("tolerance_m = 0.0002", "tolerance_m = wide"));
    assert!(matches!(refused, Err(CompareError::Setting { .. })), "{refused:?}");
}

/// The text of a program names the promises about contact for which it is not judged; without promises it says nothing.
#[test]
fn reports_contact_promises_that_are_not_judged() {
    let job = &kitchen().plan().job;
    let text = export(&ExportSettings::default()).unwrap().files[0].text.clone();
    assert!(
        text.contains("high while it washes, free 5.0 mm higher (assumed)"),
        "{text}"
    );
    let mut promised = job.requirements;
    let told = contact_not_judged(&promised);
    assert_eq!(
        text.contains("Proved for the plan, not for this program: "),
        told.is_some()
    );
    (promised.contact, promised.landing_m_s) = (None, Some(0.05));
    (promised.lifting_m_s, promised.wrist_rad) = (None, None);
    assert_eq!(contact_not_judged(&promised).as_deref(), Some("contact speed"));
    promised.landing_m_s = None;
    assert_eq!(contact_not_judged(&promised), None);
    promised.contact = Some(ContactRequirements {
        compression_m: 0.001,
        height_error_m: 0.001,
        share: 0.995,
        strain: 0.6,
        force_n: [1.0, 40.0],
        time_s: 0.1,
        time_share: 0.99,
        dose_pa_m: 50.0,
        dose_share: 0.99,
    });
    (promised.landing_m_s, promised.wrist_rad) = (Some(0.05), Some(0.05));
    let all = "pressed, contact time, contact dose, strain, contact force, contact speed, wrist";
    assert_eq!(contact_not_judged(&promised).as_deref(), Some(all));
}
