//! Jobs that can be handed over in RAPID: the load of the arm, and its make.

use platewash_export::Refusal;
use platewash_export::dialect::Dialect;
use platewash_export::rapid::Rapid;
use platewash_fixtures::kitchen_terms;
use platewash_kinematics::RobotModel;
use platewash_kinematics::irb120::IRB120_URDF;
use platewash_kinematics::urdf::MeshSource;
use platewash_workcell::tool::ToolMass;

fn refused(change: impl Fn(&mut ToolMass)) -> String {
    let arm = RobotModel::irb120().unwrap();
    let mut job = kitchen_terms(&arm, Vec::new());
    Rapid.accepts(&job, &arm).unwrap();
    let mut mass = job.workcell.tool.mass.unwrap();
    change(&mut mass);
    job.workcell.tool.mass = Some(mass);
    match Rapid.accepts(&job, &arm) {
        Err(Refusal::Load(reason)) => reason,
        other => panic!("{other:?}"),
    }
}

#[test]
fn loads_beyond_the_arm_are_refused_with_the_limit() {
    assert!(refused(|mass| mass.mass_kg = 3.01).contains("weighs 3.010 kg, the arm's rated payload is 3.000"));
    // 3 (0.15 + 0.072)² = 0.148, and 0.05 more.
    let about_5 = refused(|mass| {
        (mass.mass_kg, mass.com_m) = (3.0, [0.0, 0.0, 0.15]);
        mass.inertia_kg_m2 = [0.01, 0.02, 0.0, 0.01, 0.0, 0.01];
    });
    assert!(
        about_5.contains("about joint 5 is 0.178 kg·m², allowed are 0.175"),
        "{about_5}"
    );
    let about_6 = refused(|mass| (mass.mass_kg, mass.com_m) = (1.0, [0.3, 0.0, -0.072]));
    assert!(about_6.contains("about joint 6 is 0.090"), "{about_6}");
}

#[test]
fn rejects_loads_that_a_controller_refuses() {
    assert!(refused(|mass| mass.mass_kg = 0.0009).contains("0.001 kg or more"));
    assert!(refused(|mass| mass.com_m = [0.0; 3]).contains("centre of mass"));
    assert!(refused(|mass| mass.mass_kg = f64::NAN).contains("finite"));
    let arm = RobotModel::irb120().unwrap();
    let mut job = kitchen_terms(&arm, Vec::new());
    job.workcell.tool.mass = None;
    assert!(matches!(Rapid.accepts(&job, &arm), Err(Refusal::Load(reason)) if reason.contains("no mass")));
}

#[test]
fn rejects_arms_of_other_makers() {
    let text = IRB120_URDF.replace("<robot name=\"irb120\">", "<robot name=\"ur5\">");
    assert_ne!(text, IRB120_URDF);
    let sources = MeshSource::none();
    let arm = RobotModel::from_urdf(&text, &sources).unwrap();
    let job = kitchen_terms(&arm, Vec::new());
    let refusal = Rapid.accepts(&job, &arm).unwrap_err();
    assert_eq!(refusal.code(), "arm");
    assert!(refusal.to_string().contains("ur5"));
    let text = text.replace("\"ur5\"", "\"ABB_IRB1200\"");
    let arm = RobotModel::from_urdf(&text, &sources).unwrap();
    Rapid.accepts(&job, &arm).unwrap();
}
