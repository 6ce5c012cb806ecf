//! The motions of the paper's own cells, knot by knot, to the last bit.

use platewash_bodies::job::WashJob;
use platewash_kinematics::RobotModel;
use platewash_motion::plan::{Plan, Process};
use platewash_motion::trajectory::Trajectory;
use platewash_paper::{PaperJob, PaperPart, PaperRun, PaperSettings, run};
use platewash_workcell::job::Planner;
use sha2::{Digest, Sha256};
use std::sync::Arc;

/// The first 16 digits of the SHA-256 of the planned motion, seeds 1 to 3.
const COMMITTED: [(PaperPart, [&str; 3]); 2] = [
    (
        PaperPart::Appendix,
        ["75994b7bd24ac9eb", "10c4c11648ab956e", "78b3c606493648b7"],
    ),
    (
        PaperPart::Text,
        ["f66689701d29ac8c", "b4fb225af5499e20", "4c4f2071604aaba4"],
    ),
];

fn ran(part: PaperPart, seed: u64) -> PaperRun {
    let arm = Arc::new(RobotModel::irb120().unwrap());
    let layout = part.draw(&arm, seed).unwrap();
    run(&PaperJob::of_part(part, arm, layout, seed).unwrap()).unwrap()
}

/// Of the bytes of t, then q, then q̇, little-endian.
fn hash(motion: &Trajectory) -> String {
    let joints = motion.positions().iter().chain(motion.speeds()).flatten();
    let mut hash = Sha256::new();
    for number in motion.times().iter().chain(joints) {
        hash.update(number.to_le_bytes());
    }
    hash.finalize()[..8].iter().map(|byte| format!("{byte:02x}")).collect()
}

#[test]
fn the_papers_program_moves_as_committed() {
    for (part, hashes) in COMMITTED {
        for (seed, committed) in (1..).zip(hashes) {
            assert_eq!(hash(&ran(part, seed).planned), committed, "{part:?}, seed {seed}");
        }
    }
}

#[test]
fn a_run_is_stated_in_full_by_its_plan() {
    let run = ran(PaperPart::Appendix, 1);
    let plan = run.plan().unwrap();
    assert!(plan.is_sealed() && plan.process == Process::Paper && plan.wash_paths.is_empty());
    assert_eq!(plan, Plan::from_json(&plan.to_json().unwrap()).unwrap());
    assert_eq!(plan.knots.motion().unwrap(), run.planned);
    let (order, provenance) = (&plan.order, &plan.provenance.scenario);
    assert_eq!((order, provenance.as_str()), (&run.tool_path.order, "paper-appendix"));
    let kinds: Vec<_> = plan.segments.iter().map(|s| s.kind.name()).collect();
    assert_eq!(
        kinds,
        [
            "depart", "wash", "transit", "wash", "transit", "wash", "transit", "wash"
        ]
    );
    let Planner::Paper(settings) = &plan.job.planner else {
        unreachable!("of the paper's program")
    };
    let read: PaperSettings = serde_json::from_value(settings.clone()).unwrap();
    assert_eq!(read, PaperSettings::appendix());
    assert!(WashJob::new(run.job.arm.clone(), plan.job.clone()).is_ok());
}
