//! One layout of the paper, planned exactly and executed literally.

use crate::error::PaperError;
use crate::job::PaperJob;
use crate::part::PaperPart;
use crate::run::{PaperRun, run};
use crate::tool_path::Segment;
use crate::tracking::Step;
use platewash_bodies::clearance::ClearanceModel;
use platewash_bodies::coverage::{Coverage, CoverageError, coverage};
use platewash_kinematics::JointVector;
use platewash_kinematics::ik::IkSolver;
use platewash_motion::trajectory::SegmentKind;
use platewash_workcell::layout::Finding;
use platewash_workcell::plate::Plate;
use platewash_workcell::random;
use platewash_workcell::tool::tool_down;
use rand::Rng;
use std::collections::BTreeMap;

/// Sponge radii for which coverage is measured \[mm\].
pub(super) const SPONGES_MM: [u32; 8] = [10, 15, 20, 25, 30, 35, 40, 45];

/// Cell size of the many executed spirals \[m\]; its proven error is added to the sampling error.
const EXECUTED_CELL_M: f64 = 5e-4;

/// Configuration from which the exact check of a segment starts: in front of the base, elbow up, flange down (degrees).
const READY_DEG: [f64; 6] = [0.0, 10.0, 10.0, 0.0, 70.0, 0.0];

/// Measurements of one layout.
#[derive(Debug, Default)]
pub(super) struct Sample {
    /// Counts as \[part, whole\], by the key of their share.
    pub counts: BTreeMap<&'static str, [usize; 2]>,
    /// Tip errors on the `first_spiral`, on `later_spirals` and on `transitions`, and the largest `radius` of the executed tip about
    /// the plate's centre, second plate on \[m\].
    pub lengths_m: BTreeMap<&'static str, Vec<f64>>,
    /// Coverage of each plate as executed, by sponge radius.
    pub coverage: Vec<Vec<Coverage>>,
}

impl Sample {
    fn count(&mut self, key: &'static str, part: usize, whole: usize) {
        let [parts, wholes] = self.counts.entry(key).or_default();
        *parts += part;
        *wholes += whole;
    }
}

/// Layout number `k` of a part of the paper, with the rest of the job as it is.
pub(super) fn measure(part: PaperPart, job: &PaperJob, seed: u64, k: usize) -> Result<Sample, PaperError> {
    let stream = format!("reproduce/layout/{}/{k}", part.name());
    let layout = part.draw(&job.arm, random::stream(seed, &stream).next_u64())?;
    let any = |is: fn(&Finding) -> bool| usize::from(layout.findings.iter().any(is));
    let mut sample = Sample::default();
    sample.count("plates_overlap", any(|f| matches!(f, Finding::PlatesOverlap { .. })), 1);
    sample.count("base_overlap", any(|f| matches!(f, Finding::OverlapsBase { .. })), 1);
    let clearance = ClearanceModel::new(&job.arm, &job.workcell, &layout.plates)?;
    let job = PaperJob { layout, ..job.clone() };
    let run = run(&job)?;
    check_exactly(&run, &clearance, &mut sample)?;
    execute(&run, &mut sample)?;
    Ok(sample)
}

/// Reach and contact of the exact path, each waypoint from the previous answer.
fn check_exactly(run: &PaperRun, clearance: &ClearanceModel, sample: &mut Sample) -> Result<(), PaperError> {
    let job = &run.job;
    let tip = job.workcell.tool.tip_frame(&job.arm);
    let solver = IkSolver::new(&job.arm, tip, job.settings.ik_settings())?;
    let mut is_clear = true;
    for segment in &run.tool_path.segments {
        let (points, [reached, clear]) = (segment.waypoints.len(), count_reached(&solver, segment, clearance));
        if segment.kind == SegmentKind::Wash {
            sample.count("points_reached", reached, points);
            sample.count("points_clear", clear, points);
            sample.count("plates_clear", usize::from(clear == points), 1);
            is_clear &= clear == points;
        } else {
            sample.count("transitions_reached", reached, points);
            sample.count("transition_points_clear", clear, reached);
            sample.count("transitions_clear", usize::from(clear == reached), 1);
        }
    }
    sample.count("layouts_clear", usize::from(is_clear), 1);
    Ok(())
}

/// Counts the waypoints of a segment that are reached, and among them those without contact.
fn count_reached(solver: &IkSolver<'_>, segment: &Segment, clearance: &ClearanceModel) -> [usize; 2] {
    let [mut reached, mut clear] = [0, 0];
    let mut seed = JointVector::from(READY_DEG).map(f64::to_radians);
    for target in &segment.waypoints {
        if let Ok(answer) = solver.solve(&tool_down(*target), &seed) {
            seed = answer.q;
            reached += 1;
            clear += usize::from(clearance.smallest(&seed, &[]).is_none_or(|c| c.distance_m > 0.0));
        }
    }
    [reached, clear]
}

/// Errors, radii, speeds and coverage of the literal execution.
fn execute(run: &PaperRun, sample: &mut Sample) -> Result<(), CoverageError> {
    for (index, segment) in run.tool_path.segments.iter().enumerate() {
        let steps: Vec<&Step> = run.steps.iter().filter(|step| step.segment == index).collect();
        let plate = run.job.layout.plates[segment.plate];
        let key = match (segment.kind, sample.coverage.len()) {
            (SegmentKind::Transit, _) => "transitions",
            (_, 0) => "first_spiral",
            _ => "later_spirals",
        };
        let errors = steps.iter().map(|step| step.tracking_error_m());
        sample.lengths_m.entry(key).or_default().extend(errors);
        if key == "transitions" {
            continue;
        }
        let path: Vec<_> = steps.iter().map(|s| [s.executed_tip.x, s.executed_tip.y]).collect();
        if key == "later_spirals" {
            let radius_m = path.iter().map(|tip| from_centre(&plate, tip)).fold(0.0, f64::max);
            sample.lengths_m.entry("radius").or_default().push(radius_m);
        }
        sample.coverage.push(by_sponge(&path, &plate, EXECUTED_CELL_M)?);
    }
    let dt = run.job.simulation.control.dt_s;
    let too_fast = |pair: &&[JointVector]| {
        let speed = (pair[1] - pair[0]).abs() / dt;
        (0..speed.len()).any(|j| speed[j] > run.job.arm.limits().velocity[j])
    };
    let too_fast = run.executed.positions().windows(2).filter(too_fast).count();
    sample.count("steps_too_fast", too_fast, run.steps.len());
    Ok(())
}

/// Distance of a point, seen from above, from the centre of a plate \[m\].
fn from_centre(plate: &Plate, point: &[f64; 2]) -> f64 {
    let [x, y] = plate.centre_xy();
    let (dx, dy) = (point[0] - x, point[1] - y);
    f64::sqrt(dx * dx + dy * dy)
}

/// Coverage of a plate by a path of the tip, by sponge radius.
pub(super) fn by_sponge(path: &[[f64; 2]], plate: &Plate, cell_m: f64) -> Result<Vec<Coverage>, CoverageError> {
    let by = |sponge| coverage(path, plate.centre_xy(), plate.rim_m(), 1e-3 * f64::from(sponge), cell_m);
    SPONGES_MM.into_iter().map(by).collect()
}
