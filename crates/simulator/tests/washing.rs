//! A washing under its controllers.

use crate::two_plates::{judged, planned, under};
use platewash_kinematics::JointVector;
use platewash_motion::plan::{Knots, Plan};
use platewash_motion::trajectory::Trajectory;
use platewash_motion::trajectory::{PlanSegment, SegmentKind};
use platewash_simulator::simulate::{Cause, PayloadVerdict, PlateVerdict, SimulationVerdict};
use platewash_simulator::{
    ControlError, Execution, SimulationError, SimulationReport, simulate, simulate_watched, simulate_with, tune,
};
use platewash_workcell::cancel::{CancelToken, Cancelled};
use platewash_workcell::job::TermsError;
use platewash_workcell::simulation::{ControlLawName, Integrator, SimulationSettings};

#[test]
fn computed_torque_covers_as_much_as_planned() {
    let (_, plan) = planned();
    assert_eq!(
        plan.job.simulation.law,
        ControlLawName::ComputedTorque,
        "the job's own law"
    );
    let (execution, report) = judged(&under(ControlLawName::ComputedTorque, 30.0));
    println!("{}", report.headline);
    assert_eq!(report.verdict, SimulationVerdict::Swept);
    assert_eq!(report.plates.len(), 2);
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
    assert!((report.duration_s - plan.duration_s()).abs() < 1e-3 && execution.samples[0].t_s == 0.0);
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
fn pd_alone_washes_less_and_reports_the_cause() {
    let (_, report) = judged(&under(ControlLawName::Pd, 15.0));
    println!("{}", report.headline);
    assert_eq!(report.verdict, SimulationVerdict::NotSwept);
    for plate in &report.plates {
        assert_eq!(plate.verdict, PlateVerdict::NotSwept);
        assert!(plate.executed.upper < plate.planned.lower - 0.3, "{plate:?}");
        assert!(
            plate
                .causes
                .iter()
                .any(|cause| matches!(cause, Cause::Sunk { most_m, .. } if *most_m > 0.025))
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
    let mut settings = under(ControlLawName::PdGravity, 15.0);
    settings.plant.contact_force_n = 60.0;
    let (_, report) = judged(&settings);
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
fn finer_integration_and_runge_kutta_agree() {
    let mut settings = under(ControlLawName::PdGravity, 30.0);
    let (euler, _) = judged(&settings);
    settings.plant.substeps = 10;
    let (fine, _) = judged(&settings);
    settings.plant.integrator = Integrator::Rk4;
    let (fourth, _) = judged(&settings);
    let off = |a: &Execution, b: &Execution| {
        let pairs = a.samples.iter().zip(&b.samples);
        pairs.map(|(a, b)| (a.state.q - b.state.q).amax()).fold(0.0, f64::max)
    };
    let (coarse, near) = (off(&euler, &fourth), off(&fine, &fourth));
    assert!(coarse < 1e-3 && near < coarse / 5.0, "{coarse:e} {near:e}");
}

#[test]
fn torque_limits_saturate_and_are_reported() {
    let mut settings = under(ControlLawName::ComputedTorque, 30.0);
    settings.plant.torque_limit_n_m = Some([100.0, 100.0, 100.0, 100.0, 100.0, 100.0]);
    let (_, roomy) = judged(&settings);
    let share = roomy.effort.unwrap().joints[1].share_of_limit.unwrap();
    assert!((0.1..0.6).contains(&share) && roomy.effort.unwrap().saturated_share == 0.0);
    settings.plant.torque_limit_n_m = Some([100.0, 15.0, 100.0, 100.0, 100.0, 100.0]);
    let (_, weak) = judged(&settings);
    assert!(weak.effort.unwrap().saturated_share > 0.1 && weak.effort.unwrap().joints[1].torque_n_m.max == 15.0);
    assert_eq!(weak.verdict, SimulationVerdict::NotSwept);
}

#[test]
fn the_same_run_has_the_same_bits() {
    let settings = under(ControlLawName::ComputedTorque, 30.0);
    assert_eq!(judged(&settings), judged(&settings));
}

#[test]
fn tuning_trades_error_for_nothing_but_torque() {
    let (robot, plan) = planned();
    let rows = tune(
        plan,
        robot,
        &under(ControlLawName::PdGravity, 1.0),
        &[15.0, 30.0, 1e4],
        &[0.7, 1.0],
        &CancelToken::new(),
    )
    .unwrap();
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
            .all(|row| row.outcome.as_ref().unwrap().least_swept.unwrap() > 0.9)
    );
    assert!(
        matches!(rows[5].outcome, Err(SimulationError::Control(_))),
        "{:?}",
        rows[5].outcome
    );
}

/// A plan of waypoints, one a sample, under the paper's law: the filter stepped by hand, which forgets where a segment begins. The way
/// to the first waypoint and what follows it are one segment of the paper's program.
#[test]
fn the_papers_law_follows_waypoints_as_its_program_does() {
    let (robot, before) = planned();
    let (dt_s, kp, kd) = (0.01, 20.0, 0.1);
    let waypoint = |k: usize| before.knots.q_rad[1 + 10 * k] * (1.0 + 0.1 * (k % 3) as f64);
    let asked: Vec<_> = std::iter::once(before.job.home_rad[0])
        .chain((0..12).map(waypoint))
        .collect();
    let mut plan = before.clone();
    plan.knots = Knots::from(&Trajectory::through(asked.clone(), dt_s));
    let ends = [
        (SegmentKind::Depart, 1),
        (SegmentKind::Wash, 5),
        (SegmentKind::Transit, 8),
        (SegmentKind::Wash, 12),
    ];
    let mut from = 0;
    plan.segments.clear();
    for (kind, to) in ends {
        let [t_start_s, t_end_s] = [from, to].map(|k| k as f64 * dt_s);
        plan.segments.push(PlanSegment {
            kind,
            plate: 0,
            t_start_s,
            t_end_s,
        });
        from = to;
    }
    let mut settings = under(ControlLawName::Paper, 30.0);
    (settings.control.kp, settings.control.kd, settings.control.dt_s) = (kp, kd, dt_s);
    let execution = simulate(&plan, robot, &settings).unwrap();
    assert_eq!(execution.samples.len(), asked.len());
    let (mut q, mut last) = (asked[0], JointVector::zeros());
    for (k, sample) in execution.samples.iter().enumerate() {
        assert!((sample.state.q - q).amax() < 1e-12, "sample {k}");
        let Some(next) = asked.get(k + 1) else { break };
        if [0, 5, 8].contains(&k) {
            last = JointVector::zeros();
        }
        let error = next - q;
        q += error * (kp * dt_s) + (error - last) * kd;
        last = error;
    }
}

#[test]
fn the_exact_law_has_no_error() {
    let mut settings = under(ControlLawName::Exact, 30.0);
    settings.control.dt_s = 0.002;
    let (execution, report) = judged(&settings);
    assert!(report.tracking.tip_m.max < 1e-12 && report.verdict == SimulationVerdict::Swept);
    assert!(execution.limits.is_none() && report.effort.is_none());
}

#[test]
fn a_simulation_can_be_cancelled() {
    let (robot, plan) = planned();
    let settings = under(ControlLawName::Pd, 15.0);
    let token = CancelToken::new();
    assert_eq!(
        simulate_with(plan, robot, &settings, &token),
        simulate(plan, robot, &settings)
    );
    token.cancel();
    assert_eq!(
        simulate_with(plan, robot, &settings, &token),
        Err(SimulationError::Cancelled(Cancelled))
    );
    assert_eq!(tune(plan, robot, &settings, &[15.0], &[1.0], &token), Err(Cancelled));
}

#[test]
fn the_observer_sees_every_sample_once_and_changes_none() {
    let (robot, plan) = planned();
    for law in [ControlLawName::ComputedTorque, ControlLawName::Exact] {
        let settings = under(law, 30.0);
        let mut seen = Vec::new();
        let token = CancelToken::new();
        let watched = simulate_watched(plan, robot, &settings, &token, &mut |sample| seen.push(*sample)).unwrap();
        assert_eq!(seen, watched.samples);
        assert_eq!(watched, simulate(plan, robot, &settings).unwrap());
    }
}

/// The token is looked at between two samples, whoever used it.
#[test]
fn the_observer_can_end_the_run() {
    let (robot, plan) = planned();
    let settings = under(ControlLawName::ComputedTorque, 30.0);
    let token = CancelToken::new();
    let mut seen = 0;
    let ended = simulate_watched(plan, robot, &settings, &token, &mut |_| {
        seen += 1;
        if seen == 100 {
            token.cancel();
        }
    });
    assert_eq!((seen, ended), (100, Err(SimulationError::Cancelled(Cancelled))));
}

/// Forty million steps last for a minute; told from elsewhere, the work ends at the next sample.
#[test]
fn long_work_ends_half_way() {
    let (robot, plan) = planned();
    let mut settings = under(ControlLawName::PdGravity, 15.0);
    settings.control.rate_hz = 4e4;
    settings.plant.substeps = 24;
    let token = CancelToken::new();
    let ended = std::thread::scope(|scope| {
        let work = scope.spawn(|| simulate_with(plan, robot, &settings, &token));
        std::thread::sleep(std::time::Duration::from_millis(500));
        token.cancel();
        work.join().unwrap()
    });
    assert_eq!(ended, Err(SimulationError::Cancelled(Cancelled)));
}

#[test]
fn the_csv_has_the_plans_columns_and_torque() {
    let (robot, plan) = planned();
    let (execution, _) = judged(&under(ControlLawName::ComputedTorque, 30.0));
    let text = simulate::table(&execution, plan, robot, 0.1).unwrap().to_string();
    let header = text.lines().next().unwrap();
    assert!(header.starts_with(platewash_motion::csv::HEADER) && header.ends_with("tau6_n_m"));
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
    let (_, plan) = planned();
    let (execution, report) = judged(&under(ControlLawName::PdGravity, 30.0));
    assert_eq!(report.segments.len(), plan.segments.len());
    assert_eq!(
        report.segments.iter().map(|s| s.samples).sum::<usize>(),
        execution.samples.len()
    );
    let worst = report.segments.iter().map(|s| s.tracking.tip_m.max).fold(0.0, f64::max);
    assert_eq!(worst, report.tracking.tip_m.max);
    let washes = report.segments.iter().filter(|s| s.kind == SegmentKind::Wash).count();
    assert_eq!(washes, 2);
    for joint in report.tracking.joints_rad {
        assert!(joint.rms <= joint.max && joint.p95 <= joint.max);
    }
}

#[test]
fn payloads_are_checked() {
    let (robot, plan) = planned();
    let mut heavy = plan.clone();
    heavy.job.workcell.tool.mass.as_mut().unwrap().mass_kg = 3.5;
    // What is edited and not sealed again is judged as altered, whatever else.
    let mut settings = heavy.job.simulation.clone();
    let execution = simulate(&heavy, robot, &settings).unwrap();
    let report = SimulationReport::new(&heavy, robot, &settings, &execution).unwrap();
    assert_eq!(report.verdict, SimulationVerdict::Altered);
    heavy.hash = Some(heavy.seal().unwrap());
    let report = SimulationReport::new(&heavy, robot, &settings, &execution).unwrap();
    assert_eq!(report.payload.verdict, PayloadVerdict::Exceeded);
    assert_eq!(report.verdict, SimulationVerdict::Overloaded);
    assert!(
        report.headline.starts_with("tool 3.5 kg, rated 3 kg; 2 of 2 plates"),
        "{}",
        report.headline
    );
    assert!(report.to_string().starts_with("OVERLOADED: tool 3.5 kg"));
    settings.payload_kg = Some(5.0);
    let report = SimulationReport::new(&heavy, robot, &settings, &execution).unwrap();
    assert_eq!(report.payload.verdict, PayloadVerdict::Within);
}

#[test]
fn plans_and_settings_that_make_no_sense_are_refused() {
    let (robot, plan) = planned();
    let settings = plan.job.simulation.clone();
    let refusal = |plan: &Plan, settings: &SimulationSettings| simulate(plan, robot, settings).unwrap_err();
    let with = |edit: &dyn Fn(&mut Plan)| {
        let mut edited = plan.clone();
        edit(&mut edited);
        refusal(&edited, &settings)
    };
    assert!(matches!(
        with(&|p| p.job.workcell.arm.urdf_sha256.clear()),
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
            plates: 2
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
    assert!(matches!(
        with(&|p| p.job.workcell.tool.mass.as_mut().unwrap().mass_kg = -1.0),
        SimulationError::Dynamics(_)
    ));
    let edited_settings = |edit: &dyn Fn(&mut SimulationSettings)| {
        let mut edited = settings.clone();
        edit(&mut edited);
        refusal(plan, &edited)
    };
    assert!(matches!(
        edited_settings(&|s| s.plant.substeps = 0),
        SimulationError::Setting { name: "substeps", .. }
    ));
    assert!(matches!(
        edited_settings(&|s| s.control.rate_hz = 0.0),
        SimulationError::Control(ControlError::Setting { name: "rate_hz", .. })
    ));
    assert!(matches!(
        edited_settings(&|s| s.control.rate_hz = f64::NAN),
        SimulationError::Control(ControlError::Setting { name: "rate_hz", .. })
    ));
    assert!(matches!(
        edited_settings(&|s| s.plant.contact_force_n = f64::NAN),
        SimulationError::Setting {
            name: "contact_force_n",
            ..
        }
    ));
    assert!(matches!(
        edited_settings(&|s| s.plant.coulomb_friction_n_m[5] = -0.1),
        SimulationError::Setting {
            name: "coulomb_friction_n_m",
            ..
        }
    ));
    assert!(matches!(
        edited_settings(&|s| s.plant.torque_limit_n_m = Some([0.0; 6])),
        SimulationError::Setting {
            name: "torque_limit_n_m",
            ..
        }
    ));
    let message = edited_settings(&|s| s.control.frequency_rad_s = 5000.0).to_string();
    assert!(
        message.contains("not stable sampled at 1000 Hz") && message.contains("at most"),
        "{message}"
    );
    let mut paper = settings.clone();
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
    assert!(matches!(
        with(&|p| p.job.workcell.mount.translation.z = f64::NAN),
        SimulationError::Job(TermsError::Mount)
    ));
}
