//! Tools that lean from axis 6, or begin beside it: planned, proved and simulated as the straight one is.

use platewash::certificate::{Requirement, Status, prove};
use platewash::motion::trajectory::SegmentKind;
use platewash::planner::plan;
use platewash::{Plan, RobotModel, Scenario, SimulationReport, SimulationVerdict, simulate};
use platewash_fixtures::is_thorough;
use proptest::prelude::*;

/// Two plates beside each other, washed in the order of their list.
fn two_plates(mount_m: [f64; 3], mount_rpy_deg: [f64; 3], start_6_deg: f64) -> Scenario {
    let mut scenario = Scenario::load("kitchen-spiral").unwrap();
    scenario.layout.positions_m = Some(vec![[0.30, -0.20], [0.28, 0.18]]);
    (scenario.tool.mount_m, scenario.tool.mount_rpy_deg) = (mount_m, mount_rpy_deg);
    scenario.robot.start_deg = Some([0.0, 0.0, 0.0, 0.0, 90.0, start_6_deg]);
    scenario
}

fn planned(scenario: &Scenario) -> (Plan, RobotModel) {
    let job = scenario.job().unwrap();
    let plan = plan(&job).unwrap().plan;
    (plan, job.arm().clone())
}

fn is_proved(plan: &Plan, arm: &RobotModel) -> bool {
    prove(plan, arm).unwrap().passes()
}

/// Where the washes begin \[rad\].
fn first_of_washes(plan: &Plan) -> Vec<[f64; 6]> {
    let motion = plan.knots.motion().unwrap();
    let washes = plan.segments.iter().filter(|s| s.kind == SegmentKind::Wash);
    washes.map(|s| motion.at(s.t_start_s).unwrap().q.into()).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: if is_thorough() { 6 } else { 2 }, failure_persistence: None, ..ProptestConfig::default() })]

    /// Turned about axis 6 by φ, and home with it, the arm moves as before but for joint 6, which stands φ back.
    #[test]
    fn a_tool_turned_about_axis_6_turns_joint_6_back(turn_deg in -170.0..170.0f64, lean_deg in prop_oneof![-30.0..-5.0f64, 5.0..30.0f64]) {
        let (s, c) = turn_deg.to_radians().sin_cos();
        let plain = two_plates([0.02, 0.0, 0.04], [lean_deg, 0.0, 0.0], 0.0);
        let turned = two_plates([0.02 * c, 0.02 * s, 0.04], [lean_deg, 0.0, turn_deg], -turn_deg);
        let [(plain, arm), (turned, _)] = [planned(&plain), planned(&turned)];
        prop_assert_eq!(is_proved(&plain, &arm), is_proved(&turned, &arm));
        prop_assert!((plain.duration_s() - turned.duration_s()).abs() < 1e-2);
        for (a, b) in first_of_washes(&plain).iter().zip(first_of_washes(&turned)) {
            let off: Vec<_> = a.iter().zip(b).map(|(a, b)| b - a).collect();
            prop_assert!(off[..5].iter().all(|d| d.abs() < 1e-6), "{off:?}");
            prop_assert!((off[5] + turn_deg.to_radians()).abs() < 1e-6, "{off:?}");
        }
    }
}

/// A straight tool is the same however it is turned about its axis: the motion does not change.
#[test]
fn a_straight_tool_has_no_side() {
    let [(plain, arm), (turned, _)] = [0.0, 73.0].map(|yaw| planned(&two_plates([0.0; 3], [0.0, 0.0, yaw], 0.0)));
    assert!(is_proved(&plain, &arm) && is_proved(&turned, &arm));
    for (a, b) in first_of_washes(&plain).iter().zip(first_of_washes(&turned)) {
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6), "{a:?} {b:?}");
    }
}

/// 30° to either side and 40 mm beside the axis, with contact promised.
#[test]
fn tools_that_lean_wash_the_kitchen() {
    for mount_rpy_deg in [[30.0, 0.0, 0.0], [-30.0, 0.0, 0.0], [0.0, 30.0, 0.0]] {
        let mut scenario = Scenario::load("kitchen").unwrap();
        (scenario.tool.mount_m, scenario.tool.mount_rpy_deg) = ([0.04, 0.0, 0.035], mount_rpy_deg);
        let (plan, arm) = planned(&scenario);
        let certificate = prove(&plan, &arm).unwrap();
        assert!(certificate.passes(), "{mount_rpy_deg:?}: {}", certificate.headline);
        assert_eq!(certificate.check(Requirement::Wrist).unwrap().status, Status::Proved);
        let settings = plan.job.simulation.clone();
        let execution = simulate(&plan, &arm, &settings).unwrap();
        let report = SimulationReport::new(&plan, &arm, &settings, &execution).unwrap();
        assert_eq!(report.verdict, SimulationVerdict::Washed, "{}", report.headline);
        // What joint 6 turns beside its axis is judged against the link that carries the joint.
        let excluded = |body: &str| {
            let pair = |e: &&platewash::workcell::Exclusion| {
                e.pair.contains(&"link_5".to_owned()) && e.pair.contains(&body.to_owned())
            };
            plan.job.workcell.exclusions.iter().find(pair).is_some()
        };
        assert!(!excluded("handle") && !excluded("sponge"));
    }
}
