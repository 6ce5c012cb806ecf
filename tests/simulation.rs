//! What is planned, under its controllers: the kitchen's plan, and the paper's program under its own law.

use platewash::paper::{self, PaperJob, PaperPart};
use platewash::simulator::simulate::{Cause, PayloadVerdict, PlateVerdict};
use platewash::workcell::fixtures::kitchen;
use platewash::workcell::simulation::{ControlLawName, SimulationSettings};
use platewash::{Execution, Plan, RobotModel, SimulationReport, SimulationVerdict, plan, simulate};
use std::sync::{Arc, OnceLock};

fn planned() -> &'static (Arc<RobotModel>, Plan) {
    static PLANNED: OnceLock<(Arc<RobotModel>, Plan)> = OnceLock::new();
    PLANNED.get_or_init(|| {
        let job = kitchen();
        (job.shared_arm(), plan(&job).unwrap().plan)
    })
}

fn under(law: ControlLawName, frequency: f64) -> SimulationSettings {
    let mut settings = planned().1.job.simulation.clone();
    settings.law = law;
    settings.control.frequency_rad_s = frequency;
    settings
}

fn judged(settings: &SimulationSettings) -> (Execution, SimulationReport) {
    let (robot, plan) = planned();
    let execution = simulate(plan, robot, settings).unwrap();
    let report = SimulationReport::new(plan, robot, settings, &execution).unwrap();
    (execution, report)
}

#[test]
fn computed_torque_covers_as_much_as_planned() {
    let (_, plan) = planned();
    let (execution, report) = judged(&plan.job.simulation);
    println!("{}", report.headline);
    assert_eq!(report.law, ControlLawName::ComputedTorque, "the job's own law");
    assert_eq!(report.verdict, SimulationVerdict::Swept);
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
    assert!((report.duration_s - plan.duration_s()).abs() < 1e-3 && execution.samples[0].t_s == 0.0);
    let effort = report.effort.unwrap();
    assert!((10.0..60.0).contains(&effort.joints[1].torque_n_m.max) && effort.work_j > 0.0);
    assert_eq!(report.payload.verdict, PayloadVerdict::Within);
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
        assert!(words.iter().any(|w| w.contains("sinks")) && words.iter().any(|w| w.contains("required")));
    }
}

#[test]
fn an_arm_that_lifts_loses_contact() {
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
fn torque_limits_saturate_and_are_reported() {
    let mut settings = under(ControlLawName::ComputedTorque, 30.0);
    settings.plant.torque_limit_n_m = Some([100.0, 15.0, 100.0, 100.0, 100.0, 100.0]);
    let (_, weak) = judged(&settings);
    let effort = weak.effort.unwrap();
    assert!(effort.saturated_share > 0.1 && effort.joints[1].torque_n_m.max == 15.0);
    assert_eq!(weak.verdict, SimulationVerdict::NotSwept);
}

/// Simulating the paper's plan under the paper's law gives back what its program executed.
#[test]
fn the_papers_law_executes_the_papers_program() {
    let arm = Arc::new(RobotModel::irb120().unwrap());
    let layout = PaperPart::Appendix.draw(&arm, 1).unwrap();
    let job = PaperJob::of_part(PaperPart::Appendix, arm.clone(), layout, 1).unwrap();
    let run = paper::run(&job).unwrap();
    let (report, plan) = (run.report().unwrap(), run.plan().unwrap());
    let settings = &plan.job.simulation;
    assert_eq!(settings.law, ControlLawName::Paper);
    let execution = simulate(&plan, &arm, settings).unwrap();
    assert_eq!(execution.samples.len(), run.executed.positions().len());
    let executed = run.executed.times().iter().zip(run.executed.positions());
    for (sample, (t, q)) in execution.samples.iter().zip(executed) {
        assert_eq!(sample.t_s, *t);
        assert!((sample.state.q - q).amax() < 1e-12, "at {t} s");
    }
    let judged = SimulationReport::new(&plan, &arm, settings, &execution).unwrap();
    assert_eq!(judged.verdict, SimulationVerdict::NotSwept);
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
