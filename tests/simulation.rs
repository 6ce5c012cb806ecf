//! The paper's program under its own law.

use platewash::paper::{self, PaperJob, PaperPart};
use platewash::simulator::simulate::Cause;
use platewash::workcell::simulation::ControlLawName;
use platewash::{RobotModel, SimulationReport, SimulationVerdict, simulate};
use std::sync::Arc;

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
