use platewash_fixtures::kitchen;
use platewash_kinematics::JointVector;
use platewash_motion::plan::*;
use platewash_motion::trajectory::{PlanSegment, SegmentKind};
use platewash_workcell::wash_path::{WashCurve, WashPath, WashPattern};

fn plan() -> Plan {
    let job = kitchen();
    let home = job.terms().home_rad[0];
    let parts = PlanParts {
        provenance: Provenance::new("kitchen"),
        order: vec![0],
        wash_paths: vec![WashPath {
            plate: 0,
            curve: WashCurve {
                radius_m: 0.12,
                turns: 3.5,
                start_angle_rad: 0.1,
                closing_ring: true,
                trim_rad: 0.0,
                pattern: WashPattern::Spiral,
            },
            lift_m: 0.03,
            cone_rad: 0.25,
        }],
        segments: vec![PlanSegment {
            kind: SegmentKind::Transit,
            plate: 0,
            t_start_s: 0.0,
            t_end_s: 1.0,
        }],
        knots: Knots {
            t_s: vec![0.0, 1.0],
            q_rad: vec![home; 2],
            qd_rad_s: vec![JointVector::zeros(); 2],
        },
    };
    Plan::sealed(job.terms().clone(), parts).unwrap()
}

#[test]
fn reads_back_what_was_written() {
    let plan = plan();
    let text = plan.to_json().unwrap();
    let read = Plan::from_json(&text).unwrap();
    assert_eq!(read, plan);
    assert!(read.is_sealed() && read.to_json().unwrap() == text);
    // Without its spaces and its order of keys, it is the file that another program would write.
    let pretty = serde_json::to_string_pretty(&serde_json::from_str::<serde_json::Value>(&text).unwrap()).unwrap();
    assert!(Plan::from_json(&pretty).unwrap().is_sealed());
}

#[test]
fn a_change_breaks_the_seal_until_the_plan_is_resealed() {
    let mut changed = plan();
    changed.job.requirements.clearance_m = 0.005;
    assert!(!changed.is_sealed());
    changed.hash = Some(changed.seal().unwrap());
    assert!(changed.is_sealed());
}

#[test]
fn refuses_to_write_values_that_json_cannot_hold() {
    let mut infinite = plan();
    infinite.knots.q_rad[1][2] = f64::INFINITY;
    assert!(matches!(infinite.seal(), Err(PlanFileError::Unwritable { .. })));
    let mut nan = plan();
    nan.job.simulation.payload_kg = Some(f64::NAN);
    assert!(matches!(nan.seal(), Err(PlanFileError::Unwritable { .. })));
    let mut large = plan();
    large.job.seed = platewash_workcell::job::MAX_SEED + 2;
    assert!(matches!(large.seal(), Err(PlanFileError::Unwritable { .. })));
}

#[test]
fn other_formats_are_refused_with_what_to_do() {
    let said = |text: &str| Plan::from_json(text).unwrap_err().to_string();
    let before = said(r#"{"format": "platewash-plan/1", "scenario": {}}"#);
    assert!(before.contains("plan its scenario again"), "{before}");
    // Whatever else stands in it.
    let relabelled = plan()
        .to_json()
        .unwrap()
        .replace("platewash-plan/2", "platewash-plan/1");
    assert_eq!(said(&relabelled), before);
    assert!(said(r#"{"format": "platewash-plan/3"}"#).contains("found \"platewash-plan/3\""));
    assert!(said("{}").contains("is missing"), "{}", said("{}"));
    assert!(said("no JSON").contains("not a plan file"));
}

#[test]
fn a_process_that_the_job_contradicts_is_refused() {
    let text = plan()
        .to_json()
        .unwrap()
        .replace(r#""process":"wash""#, r#""process":"paper""#);
    let said = Plan::from_json(&text).unwrap_err().to_string();
    assert!(
        said.contains("process is \"paper\"") && said.contains("\"wash\""),
        "{said}"
    );
}

#[test]
fn rejects_an_invalid_quaternion() {
    let text = plan().to_json().unwrap();
    let unit = r#""quaternion_wxyz":[1,0,0,0]"#;
    assert!(text.contains(unit));
    let said = Plan::from_json(&text.replacen(unit, r#""quaternion_wxyz":[1,1,0,0]"#, 1)).unwrap_err();
    assert!(said.to_string().contains("must have length 1"), "{said}");
}
