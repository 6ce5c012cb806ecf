//! The kitchen's plan under its controllers, and the paper's job under its own law.
#![allow(clippy::unwrap_used, missing_docs)]

use platewash_kinematics::{JointVector, RobotModel};
use platewash_planner::cycle::Cycle;
use platewash_planner::job::Job;
use platewash_planner::plan::Plan;
use platewash_planner::scenario::{ControlLawName, Integrator, Scenario};
use platewash_planner::tool_path::SegmentKind;
use platewash_simulator::simulate::{Cause, PayloadVerdict, PlateVerdict, SimulationVerdict};
use platewash_simulator::{ControlError, Execution, Setup, SimulationError, SimulationReport, simulate, tune};
use std::sync::OnceLock;

fn kitchen() -> &'static (RobotModel, Plan) {
    static KITCHEN: OnceLock<(RobotModel, Plan)> = OnceLock::new();
    KITCHEN.get_or_init(|| {
        let cycle = Cycle::plan(&Scenario::load("kitchen").unwrap()).unwrap();
        let plan = cycle.to_plan().unwrap();
        (cycle.robot, plan)
    })
}

fn under(law: ControlLawName, frequency: f64) -> Setup {
    let mut setup = Setup::of(&kitchen().1);
    setup.law = law;
    setup.control.frequency_rad_s = frequency;
    setup
}

fn judged(setup: &Setup) -> (Execution, SimulationReport) {
    let (robot, plan) = kitchen();
    let execution = simulate(plan, robot, setup).unwrap();
    let report = SimulationReport::new(plan, robot, setup, &execution).unwrap();
    (execution, report)
}

#[test]
fn computed_torque_covers_as_much_as_planned() {
    let (_, plan) = kitchen();
    assert_eq!(
        Setup::of(plan).law,
        ControlLawName::ComputedTorque,
        "a certified job's own law"
    );
    let (execution, report) = judged(&under(ControlLawName::ComputedTorque, 30.0));
    println!("{}", report.headline);
    assert_eq!(report.verdict, SimulationVerdict::Washed);
    assert_eq!(report.plates.len(), 4);
    for plate in &report.plates {
        assert!(
            (plate.executed.fraction - plate.planned.fraction).abs() < 1e-3,
            "{plate:?}"
        );
        assert!(
            plate.executed.lower >= 0.995 && plate.in_contact == plate.samples,
            "{plate:?}"
        );
        assert!(plate.causes.is_empty(), "{:?}", plate.causes);
    }
    assert!(report.tracking.tip_m.rms < 1e-4 && report.tracking.tip_m.max < 1e-3);
    assert!((report.duration_s - plan.summary.duration_s).abs() < 1e-3 && execution.samples[0].t_s == 0.0);
    let effort = report.effort.unwrap();
    assert!(
        effort.joints.iter().all(|joint| joint.share_of_limit.is_none()),
        "no limit is published"
    );
    assert!((10.0..60.0).contains(&effort.joints[1].torque_n_m.max) && effort.work_j > 0.0);
    assert_eq!(report.payload.verdict, PayloadVerdict::Within);
    assert_eq!((report.payload.tool_kg, report.payload.rated_kg), (0.3, Some(3.0)));
}

#[test]
fn pd_alone_washes_less_and_says_why() {
    let (_, report) = judged(&under(ControlLawName::Pd, 15.0));
    println!("{}", report.headline);
    assert_eq!(report.verdict, SimulationVerdict::NotWashed);
    for plate in &report.plates {
        assert_eq!(plate.verdict, PlateVerdict::NotWashed);
        assert!(plate.executed.upper < plate.planned.lower - 0.3, "{plate:?}");
        assert!(
            plate
                .causes
                .iter()
                .any(|cause| matches!(cause, Cause::Pressed { most_m, .. } if *most_m > 0.025))
        );
        let words: Vec<_> = plate.causes.iter().map(Cause::to_string).collect();
        println!(
            "plate {}: {:.1} % of {:.1} %: {}",
            plate.plate,
            100.0 * plate.executed.fraction,
            100.0 * plate.planned.fraction,
            words.join("; ")
        );
        assert!(words.iter().any(|w| w.contains("sinks")) && words.iter().any(|w| w.contains("required")));
    }
}

#[test]
fn an_arm_that_lifts_loses_contact() {
    // Gravity compensated for a tool that is not there would lift; here the plate pushes instead.
    let mut setup = under(ControlLawName::PdGravity, 15.0);
    setup.plant.contact_force_n = 60.0;
    let (_, report) = judged(&setup);
    let lifted = |cause: &Cause| matches!(cause, Cause::Lifted { most_m, .. } if *most_m > 0.005);
    assert!(
        report
            .plates
            .iter()
            .any(|p| p.causes.iter().any(lifted) && p.in_contact < p.samples),
        "{:?}",
        report.plates
    );
}

#[test]
fn finer_integration_and_runge_kutta_tell_the_same() {
    let mut setup = under(ControlLawName::PdGravity, 30.0);
    let (euler, _) = judged(&setup);
    setup.plant.substeps = 10;
    let (fine, _) = judged(&setup);
    setup.plant.integrator = Integrator::Rk4;
    let (fourth, _) = judged(&setup);
    let off = |a: &Execution, b: &Execution| {
        let pairs = a.samples.iter().zip(&b.samples);
        pairs.map(|(a, b)| (a.state.q - b.state.q).amax()).fold(0.0, f64::max)
    };
    let (coarse, near) = (off(&euler, &fourth), off(&fine, &fourth));
    assert!(coarse < 1e-3 && near < coarse / 5.0, "{coarse:e} {near:e}");
}

#[test]
fn torque_limits_saturate_and_are_reported() {
    let mut setup = under(ControlLawName::ComputedTorque, 30.0);
    setup.plant.torque_limit_n_m = Some([100.0, 100.0, 100.0, 100.0, 100.0, 100.0]);
    let (_, roomy) = judged(&setup);
    let share = roomy.effort.unwrap().joints[1].share_of_limit.unwrap();
    assert!((0.1..0.6).contains(&share) && roomy.effort.unwrap().saturated_share == 0.0);
    setup.plant.torque_limit_n_m = Some([100.0, 15.0, 100.0, 100.0, 100.0, 100.0]);
    let (_, weak) = judged(&setup);
    assert!(weak.effort.unwrap().saturated_share > 0.1 && weak.effort.unwrap().joints[1].torque_n_m.max == 15.0);
    assert_eq!(weak.verdict, SimulationVerdict::NotWashed);
}

#[test]
fn the_same_run_has_the_same_bits() {
    let setup = under(ControlLawName::ComputedTorque, 30.0);
    assert_eq!(judged(&setup), judged(&setup));
}

#[test]
fn tuning_trades_error_for_nothing_but_torque() {
    let (robot, plan) = kitchen();
    let rows = tune(
        plan,
        robot,
        &under(ControlLawName::PdGravity, 1.0),
        &[15.0, 30.0, 1e4],
        &[0.7, 1.0],
    );
    assert_eq!(rows.len(), 6);
    let order: Vec<_> = rows
        .iter()
        .map(|row| (row.frequency_rad_s, row.damping_ratio))
        .collect();
    assert_eq!(order[..3], [(15.0, 0.7), (15.0, 1.0), (30.0, 0.7)]);
    let error = |k: usize| rows[k].outcome.as_ref().unwrap().tip_rms_m;
    assert!(error(3) < 0.5 * error(1));
    assert!(
        rows[..4]
            .iter()
            .all(|row| row.outcome.as_ref().unwrap().least_coverage.unwrap() > 0.9)
    );
    assert!(
        matches!(rows[5].outcome, Err(SimulationError::Control(_))),
        "{:?}",
        rows[5].outcome
    );
}

/// Simulating the paper's plan under the paper's law gives back what its program executed.
#[test]
fn the_papers_law_executes_the_papers_job() {
    let job = Job::run(&Scenario::load("paper-appendix").unwrap()).unwrap();
    let report = job.report().unwrap();
    let plan = Plan::new(&job, &report).unwrap();
    let setup = Setup::of(&plan);
    assert_eq!(setup.law, ControlLawName::Paper);
    let execution = simulate(&plan, &job.robot, &setup).unwrap();
    assert_eq!(execution.samples.len(), job.executed.positions().len());
    for (sample, (t, q)) in execution
        .samples
        .iter()
        .zip(job.executed.times().iter().zip(job.executed.positions()))
    {
        assert_eq!(sample.t_s, *t);
        assert!((sample.state.q - q).amax() < 1e-12, "at {t} s");
    }
    let judged = SimulationReport::new(&plan, &job.robot, &setup, &execution).unwrap();
    assert_eq!(judged.verdict, SimulationVerdict::NotWashed);
    assert!(judged.effort.is_none() && judged.plates.iter().all(|p| p.causes.contains(&Cause::NoTool)));
    for (ours, theirs) in judged.plates.iter().zip(&report.plates) {
        assert_eq!(ours.plate, theirs.plate);
        // The first waypoint of the first plate ends the way there.
        assert!(
            (ours.executed.fraction - theirs.executed_coverage.fraction).abs() < 0.02,
            "{ours:?} {theirs:?}"
        );
    }
}

#[test]
fn exact_is_exact() {
    let mut setup = under(ControlLawName::Exact, 30.0);
    setup.control.dt_s = 0.002;
    let (execution, report) = judged(&setup);
    assert!(report.tracking.tip_m.max < 1e-12 && report.verdict == SimulationVerdict::Washed);
    assert!(execution.limits.is_none() && report.effort.is_none());
}

#[test]
fn the_csv_has_the_plans_columns_and_torque() {
    let (robot, plan) = kitchen();
    let (execution, _) = judged(&under(ControlLawName::ComputedTorque, 30.0));
    let text = simulate::table(&execution, plan, robot, 0.1).unwrap().to_string();
    let header = text.lines().next().unwrap();
    assert!(header.starts_with(platewash_workcell::csv::HEADER) && header.ends_with("tau6_n_m"));
    let columns = header.split(',').count();
    assert!(text.lines().all(|line| line.split(',').count() == columns));
    let times: Vec<f64> = text
        .lines()
        .skip(1)
        .map(|line| line.split(',').next().unwrap().parse().unwrap())
        .collect();
    assert!(times.windows(2).all(|pair| pair[1] > pair[0]) && (times[1] - 0.1).abs() < 1e-9);
    assert_eq!(*times.last().unwrap(), execution.samples.last().unwrap().t_s);
    for bad in [0.0, -1.0, f64::NAN, 1e-9] {
        assert!(simulate::table(&execution, plan, robot, bad).is_err(), "{bad}");
    }
    let parts: Vec<_> = text
        .lines()
        .skip(1)
        .map(|line| line.split(',').nth(1).unwrap())
        .collect();
    assert!(parts.contains(&"wash") && parts[0] == "depart" && *parts.last().unwrap() == "return");
}

#[test]
fn every_segment_is_tracked() {
    let (_, plan) = kitchen();
    let (execution, report) = judged(&under(ControlLawName::PdGravity, 30.0));
    assert_eq!(report.segments.len(), plan.segments.len());
    assert_eq!(
        report.segments.iter().map(|s| s.samples).sum::<usize>(),
        execution.samples.len()
    );
    let worst = report.segments.iter().map(|s| s.tracking.tip_m.max).fold(0.0, f64::max);
    assert_eq!(worst, report.tracking.tip_m.max);
    let washes = report.segments.iter().filter(|s| s.kind == SegmentKind::Wash).count();
    assert_eq!(washes, 4);
    for joint in report.tracking.joints_rad {
        assert!(joint.rms <= joint.max && joint.p95 <= joint.max);
    }
}

#[test]
fn payloads_are_checked() {
    let (robot, plan) = kitchen();
    let mut heavy = plan.clone();
    heavy.tool.mass_kg = 3.5;
    // What is edited and not sealed again is judged as altered, whatever else.
    let setup = Setup::of(&heavy);
    let execution = simulate(&heavy, robot, &setup).unwrap();
    let report = SimulationReport::new(&heavy, robot, &setup, &execution).unwrap();
    assert_eq!(report.verdict, SimulationVerdict::Altered);
    heavy.hash = Some(heavy.seal().unwrap());
    let report = SimulationReport::new(&heavy, robot, &setup, &execution).unwrap();
    assert_eq!(report.payload.verdict, PayloadVerdict::Exceeded);
    assert_eq!(report.verdict, SimulationVerdict::Overloaded);
    assert!(
        report.headline.starts_with("tool 3.5 kg, rated 3 kg; 4 of 4 plates"),
        "{}",
        report.headline
    );
    assert!(report.to_string().starts_with("OVERLOADED: tool 3.5 kg"));
    heavy.scenario.robot.payload_kg = Some(5.0);
    let report = SimulationReport::new(&heavy, robot, &setup, &execution).unwrap();
    assert_eq!(report.payload.verdict, PayloadVerdict::Within);
}

#[test]
fn plans_and_settings_that_make_no_sense_are_refused() {
    let (robot, plan) = kitchen();
    let setup = Setup::of(plan);
    let refusal = |plan: &Plan, setup: &Setup| simulate(plan, robot, setup).unwrap_err();
    let with = |edit: &dyn Fn(&mut Plan)| {
        let mut edited = plan.clone();
        edit(&mut edited);
        refusal(&edited, &setup)
    };
    assert!(matches!(
        with(&|p| p.robot.urdf_sha256.clear()),
        SimulationError::OtherArm { .. }
    ));
    assert!(matches!(
        with(&|p| p.segments.clear()),
        SimulationError::Empty { segments: 0, .. }
    ));
    assert!(matches!(
        with(&|p| {
            p.knots.t_s.clear();
            p.knots.q_rad.clear();
            p.knots.qd_rad_s.clear();
        }),
        SimulationError::Empty { knots: 0, .. }
    ));
    assert!(matches!(
        with(&|p| p.knots.q_rad[7][2] = f64::NAN),
        SimulationError::Knots(_)
    ));
    assert!(matches!(
        with(&|p| p.segments[3].plate = 99),
        SimulationError::Plate {
            segment: 3,
            plate: 99,
            plates: 4
        }
    ));
    let last = plan.knots.t_s.len() - 1;
    assert!(matches!(
        with(&|p| p.knots.t_s[last] = 1e9),
        SimulationError::TooLong { .. }
    ));
    assert!(matches!(
        with(&|p| p.knots.q_rad[last] = JointVector::repeat(1e300)),
        SimulationError::Divergence { .. }
    ));
    assert!(matches!(with(&|p| p.tool.mass_kg = -1.0), SimulationError::Dynamics(_)));
    let settings = |edit: &dyn Fn(&mut Setup)| {
        let mut edited = setup.clone();
        edit(&mut edited);
        refusal(plan, &edited)
    };
    assert!(matches!(
        settings(&|s| s.plant.substeps = 0),
        SimulationError::Setting {
            key: "plant.substeps",
            ..
        }
    ));
    assert!(matches!(
        settings(&|s| s.control.rate_hz = 0.0),
        SimulationError::Setting {
            key: "control.rate_hz",
            ..
        }
    ));
    assert!(matches!(
        settings(&|s| s.control.rate_hz = f64::NAN),
        SimulationError::Setting {
            key: "control.rate_hz",
            ..
        }
    ));
    assert!(matches!(
        settings(&|s| s.plant.contact_force_n = f64::NAN),
        SimulationError::Setting {
            key: "plant.contact_force_n",
            ..
        }
    ));
    assert!(matches!(
        settings(&|s| s.plant.coulomb_friction_n_m[5] = -0.1),
        SimulationError::Setting {
            key: "plant.coulomb_friction_n_m",
            ..
        }
    ));
    assert!(matches!(
        settings(&|s| s.plant.torque_limit_n_m = Some([0.0; 6])),
        SimulationError::Setting {
            key: "plant.torque_limit_n_m",
            ..
        }
    ));
    let message = settings(&|s| s.control.frequency_rad_s = 5000.0).to_string();
    assert!(
        message.contains("not stable sampled at 1000 Hz") && message.contains("at most"),
        "{message}"
    );
    let mut paper = setup.clone();
    paper.law = ControlLawName::Paper;
    for (kp, kd, dt_s) in [
        (1e6, 0.1, 0.01),
        (0.0, 0.1, 0.01),
        (20.0, 1.5, 0.01),
        (f64::NAN, 0.1, 0.01),
    ] {
        (paper.control.kp, paper.control.kd, paper.control.dt_s) = (kp, kd, dt_s);
        let error = refusal(plan, &paper);
        assert!(
            matches!(error, SimulationError::Control(ControlError::UnstablePaper { .. })),
            "{error}"
        );
    }
    assert!(refusal(plan, &paper).to_string().contains("180"), "the limit is named");
}
