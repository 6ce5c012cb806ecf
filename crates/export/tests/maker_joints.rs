//! Programs for arms whose controller counts axis 3 together with axis 2: asked for, written, read back and judged.

use crate::linkage::urdf;
use platewash_bodies::job::WashJob;
use platewash_certificate::{Certified, certify};
use platewash_export::dialects::by_name;
use platewash_export::program::ProgramFile;
use platewash_export::{CompareError, ExportError, ExportSettings, ExportedProgram, Joint3, Refusal, compare, export};
use platewash_fixtures::kitchen_terms;
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{JointVector, RobotModel};
use platewash_motion::plan::Plan;
use platewash_planner::{Watch, plan, recover};
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::job::Planner;
use platewash_workcell::plate::Plate;
use std::sync::Arc;

/// A washing of one plate by the arm of that name, from a home with joint 2 at 36° and joint 3 at 0°.
fn washing(name: &str) -> (Certified<Plan>, Arc<RobotModel>) {
    let arm = Arc::new(RobotModel::from_urdf(&urdf(name), &MeshSource::none()).unwrap());
    let mut terms = kitchen_terms(&arm, vec![Plate::level_disc([0.9, 0.0, 0.1], 0.11, 0.02)]);
    terms.home_rad = [JointVector::from([-8.0, 36.0, 0.0, 0.0, 54.0, 0.0]).map(f64::to_radians); 2];
    if let Planner::Wash(settings) = &mut terms.planner {
        settings.path_radius_m = Some(0.09);
    }
    let job = WashJob::new(Arc::clone(&arm), terms).unwrap();
    let plan = plan(&job).unwrap_or_else(|error| panic!("{name}: {error}")).plan;
    (
        certify(plan, &arm).unwrap_or_else(|error| panic!("{name}: {error}")),
        arm,
    )
}

type Washing = (Certified<Plan>, Arc<RobotModel>);

fn counted(joint_3: Option<Joint3>) -> ExportSettings {
    ExportSettings {
        joint_3,
        ..ExportSettings::default()
    }
}

fn exported((plan, arm): &Washing, target: &str, settings: &ExportSettings) -> Result<ExportedProgram, ExportError> {
    export(plan, arm, by_name(target).unwrap(), settings, &CancelToken::new())
}

fn refused(washing: &Washing, target: &str, settings: &ExportSettings) -> Refusal {
    match exported(washing, target, settings) {
        Err(ExportError::Refused(refusal)) => refusal,
        other => panic!("{other:?}"),
    }
}

/// The start that a module states \[°\].
fn start_deg(files: &[ProgramFile]) -> Vec<f64> {
    let (_, start) = files[0].text.split_once("pwStart:=[[").unwrap();
    let (start, _) = start.split_once(']').unwrap();
    start.split(',').map(|deg| deg.parse().unwrap()).collect()
}

fn edited(program: &ExportedProgram, from: &str, to: &str) -> Vec<ProgramFile> {
    let mut files = program.files.clone();
    assert!(files[0].text.contains(from), "{from}");
    files[0].text = files[0].text.replacen(from, to, 1);
    files
}

/// Arms that a public file states to be coupled, and one that two files state both ways.
#[test]
fn a_listed_arm_is_asked_for_its_count_and_moves_the_same_with_either() {
    let coupled = counted(Some(Joint3::WithJoint2));
    for name in ["abb_irb2400", "abb_irb4400l_30_243", "ABB IRB 7600-150/3.50"] {
        let washing = washing(name);
        let (plan, arm) = (&washing.0, &washing.1);
        let refusal = refused(&washing, "rapid", &ExportSettings::default());
        let words = refusal.to_string();
        assert_eq!(refusal.code(), "arm");
        for part in [
            name,
            "rax_3 = joint_3 + joint_2",
            "ros-industrial",
            "with-joint-2",
            "else independent",
        ] {
            assert!(words.contains(part), "{part}: {words}");
        }
        let program = exported(&washing, "rapid", &coupled).unwrap();
        let text = &program.files[0].text;
        assert!(text.contains("! platewash setting: joint_3 = with-joint-2\n"), "{text}");
        assert_eq!(start_deg(&program.files), [-8.0, 36.0, 36.0, 0.0, 54.0, 0.0]);
        assert!((program.reading.points[0].q_rad - plan.plan().job.home_rad[0]).amax() < 1e-6);
        let found = compare(plan, arm, &program.files, &CancelToken::new()).unwrap();
        assert!(found.holds() && found.is_unchanged() && found.checks_start, "{found:?}");
        let alone = exported(&washing, "rapid", &counted(Some(Joint3::Independent))).unwrap();
        assert_eq!(start_deg(&alone.files), [-8.0, 36.0, 0.0, 0.0, 54.0, 0.0]);
        assert!(alone.files[0].text.contains("rax_3 is counted on its own"));
        let [a, b] = [&program, &alone].map(|program| &program.reading.points);
        assert_eq!(a.len(), b.len());
        assert!(
            a.iter()
                .zip(b)
                .all(|(a, b)| (a.q_rad - b.q_rad).amax().to_degrees() < 1.2e-4)
        );
    }
}

#[test]
fn a_changed_axis_or_head_line_is_no_program_of_the_plan() {
    let washing = washing("abb_irb2400");
    let (plan, arm) = (&washing.0, &washing.1);
    let program = exported(&washing, "rapid", &counted(Some(Joint3::WithJoint2))).unwrap();
    let compared = |files: &[ProgramFile]| compare(plan, arm, files, &CancelToken::new());

    // A target in the middle, 0.1° farther about axis 3.
    let moves: Vec<_> = program.files[0]
        .text
        .lines()
        .filter(|line| line.contains("MoveAbsJ [["))
        .collect();
    let line = moves[moves.len() / 2];
    let rax_3 = line.split(',').nth(2).unwrap();
    let moved = format!("{:.4}", rax_3.parse::<f64>().unwrap() + 0.1);
    let found = compared(&edited(&program, line, &line.replacen(rax_3, &moved, 1))).unwrap();
    assert!(
        !found.holds() && found.changes[0].what == "joint 3",
        "{:?}",
        found.changes
    );

    let setting = "platewash setting: joint_3 = with-joint-2";
    for to in ["", "platewash setting: joint_3 = both"] {
        match compared(&edited(&program, setting, to)) {
            Err(CompareError::Read(error)) => {
                let words = error.to_string();
                assert!(words.contains(setting) && words.contains("found none"), "{words}");
            }
            other => panic!("{other:?}"),
        }
    }
    // The check of the start is that of the other count, too; without it the motion is judged, and is another one.
    let other = edited(&program, setting, "platewash setting: joint_3 = independent");
    assert!(
        compared(&other)
            .unwrap_err()
            .to_string()
            .contains("pwCheckStart is read only as it is exported")
    );
    let mut other = other;
    other[0].text = other[0].text.replace("+(now.robax.rax_2-pwStart.robax.rax_2)", "");
    let found = compared(&other).unwrap();
    assert!(!found.holds() && !found.is_unchanged());
}

/// The list is not the controller: what is given counts, and the head says what stands against it.
#[test]
fn a_count_against_the_list_is_stated_at_the_head() {
    let washing = washing("abb_irb4600_60_205");
    let program = exported(&washing, "rapid", &ExportSettings::default()).unwrap();
    assert!(!program.files[0].text.contains("rax_3 is") && start_deg(&program.files)[2] == 0.0);
    let program = exported(&washing, "rapid", &counted(Some(Joint3::WithJoint2))).unwrap();
    assert_eq!(start_deg(&program.files)[2], 36.0);
    assert!(program.files[0].text.contains("Independent by"));
}

/// Not on the list: independent unless it is stated, and without the line that states it the program is another one.
#[test]
fn an_arm_that_is_not_listed_is_taken_as_independent_and_its_program_says_so() {
    let washing = washing("abb_own_arm");
    let program = exported(&washing, "rapid", &ExportSettings::default()).unwrap();
    assert_eq!(start_deg(&program.files)[2], 0.0);
    assert!(
        program.files[0]
            .text
            .contains("rax_3 is counted on its own, as the description's joint 3.")
    );
    assert!(!program.files[0].text.contains("setting: joint_3"));

    let program = exported(&washing, "rapid", &counted(Some(Joint3::WithJoint2))).unwrap();
    assert_eq!(start_deg(&program.files)[2], 36.0);
    let mut files = edited(&program, "platewash setting: joint_3 = with-joint-2", "");
    files[0].text = files[0].text.replace("+(now.robax.rax_2-pwStart.robax.rax_2)", "");
    let found = compare(&washing.0, &washing.1, &files, &CancelToken::new()).unwrap();
    assert!(!found.holds() && !found.is_unchanged());
}

/// The motion home after a stop, and joint positions read off a controller.
#[test]
fn a_motion_home_and_a_stated_start_are_in_the_makers_joints() {
    let (plan, arm) = washing("abb_irb4400");
    let motion = plan.plan().knots.motion().unwrap();
    let stands = motion.at(0.5 * motion.duration_s()).unwrap().q;
    let home = recover(plan.plan(), &arm, &stands, None, &Watch::silent(&CancelToken::new()))
        .unwrap()
        .home;
    let washing = (certify(home, &arm).unwrap(), arm);
    let shown = Joint3::WithJoint2.convert(&stands);
    let settings = |off_deg: [f64; 2]| {
        let mut stands = shown;
        stands[1] += off_deg[0].to_radians();
        stands[2] += off_deg[1].to_radians();
        ExportSettings {
            stands_rad: Some(stands),
            ..counted(Some(Joint3::WithJoint2))
        }
    };
    let program = exported(&washing, "rapid", &settings([0.0; 2])).unwrap();
    assert_eq!(program.reading.start_within_deg, Some(0.1));
    for (stated, shown) in start_deg(&program.files).iter().zip(&shown) {
        assert!((stated - shown.to_degrees()).abs() < 1.1e-4, "{stated} {shown}");
    }
    // Axes 2 and 3 may be off together, which leaves joint 3 where it is, and not against each other.
    assert!(exported(&washing, "rapid", &settings([0.08, 0.08])).is_ok());
    match refused(&washing, "rapid", &settings([0.08, -0.08])) {
        Refusal::Start {
            joint: 2,
            found_deg,
            expected_deg,
            ..
        } => assert!((expected_deg - found_deg - 0.16).abs() < 1e-9),
        other => panic!("{other}"),
    }
}

#[test]
fn tables_and_messages_keep_the_descriptions_joints_and_say_so() {
    let note = |program: &ExportedProgram| {
        let text: String = program.files.iter().map(|file| file.text.as_str()).collect();
        text.split_whitespace()
            .collect::<Vec<_>>()
            .join(" ")
            .contains("may count axis 3")
    };
    for (name, is_noted) in [("abb_irb2400", true), ("fanuc_m10ia", true), ("abb_irb6640", false)] {
        let washing = washing(name);
        for target in ["csv", "ros2"] {
            let program = exported(&washing, target, &ExportSettings::default()).unwrap();
            assert_eq!(note(&program), is_noted, "{name} {target}");
            let refusal = refused(&washing, target, &counted(Some(Joint3::WithJoint2)));
            let words = refusal.to_string();
            assert!(
                refusal.code() == "setting" && words.contains("description's"),
                "{words}"
            );
        }
    }
}
