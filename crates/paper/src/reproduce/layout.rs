//! One layout of the paper, planned exactly and executed literally.

use super::sponges::{NOTHING, SPONGES_MM, by_sponge};
use crate::error::PaperError;
use crate::job::PaperJob;
use crate::part::PaperPart;
use crate::run::{PaperRun, run};
use crate::tool_path::{Segment, ToolPath};
use crate::tracking::Step;
use nalgebra::Vector3;
use platewash_kinematics::ik::IkSolver;
use platewash_kinematics::{JointVector, RobotModel};
use platewash_workcell::clearance::ClearanceModel;
use platewash_workcell::coverage::{Coverage, CoverageError, CoverageSettings};
use platewash_workcell::layout::{Finding, Layout, LayoutSource};
use platewash_workcell::plate::Plate;
use platewash_workcell::random;
use platewash_workcell::tool::tool_down;
use platewash_workcell::trajectory::SegmentKind;
use rand::Rng;
use std::sync::Arc;

/// Coverage raster of the many executed spirals; its proven error is added to the sampling error.
const EXECUTED_CELL: CoverageSettings = CoverageSettings { cell_m: 5e-4 };

/// Configuration from which the exact check of a segment starts: in front of the base, elbow up, flange down (degrees).
const READY_DEG: [f64; 6] = [0.0, 10.0, 10.0, 0.0, 70.0, 0.0];

/// How many points there are, are reached, and are reached without contact.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Counts {
    pub points: usize,
    pub reached: usize,
    pub clear: usize,
}

/// What was measured on one plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PlateSample {
    pub spiral: Counts,
    /// By sponge radius, see [`SPONGES_MM`].
    pub executed_coverage: [Coverage; SPONGES_MM.len()],
}

/// What was measured of one layout.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct LayoutSample {
    pub plates_overlap: bool,
    pub base_overlap: bool,
    pub plates: Vec<PlateSample>,
    pub transit: Counts,
    pub transits: usize,
    pub clear_transits: usize,
    /// Tip errors \[m\].
    pub first_spiral_errors: Vec<f64>,
    pub later_spiral_errors: Vec<f64>,
    pub transit_errors: Vec<f64>,
    /// Largest distance of the executed tip from the plate's centre, second plate on \[m\].
    pub outermost_radii: Vec<f64>,
    pub steps: usize,
    pub steps_too_fast: usize,
}

impl LayoutSample {
    pub fn points(&self) -> usize {
        self.plates.iter().map(|p| p.spiral.points).sum()
    }

    pub fn reached(&self) -> usize {
        self.plates.iter().map(|p| p.spiral.reached).sum()
    }

    pub fn clear(&self) -> usize {
        self.plates.iter().map(|p| p.spiral.clear).sum()
    }

    pub fn clear_plates(&self) -> usize {
        self.plates.iter().filter(|p| p.spiral.clear == p.spiral.points).count()
    }

    pub fn is_clear(&self) -> bool {
        self.clear() == self.points()
    }
}

/// What all layouts of a part of the paper share.
pub(super) struct Bench {
    part: PaperPart,
    job: PaperJob,
}

impl Bench {
    pub fn new(part: PaperPart, arm: &Arc<RobotModel>) -> Result<Self, PaperError> {
        let none = Layout {
            plates: Vec::new(),
            source: LayoutSource::Explicit,
            findings: Vec::new(),
        };
        let job = PaperJob::of_part(part, arm.clone(), none, 1)?;
        Ok(Self { part, job })
    }

    /// Layout number `k` of the region.
    pub fn measure(&self, seed: u64, k: usize) -> Result<LayoutSample, PaperError> {
        let stream = format!("reproduce/layout/{}/{k}", self.part.name());
        let layout = self
            .part
            .draw(&self.job.arm, random::stream(seed, &stream).next_u64())?;
        let any = |is: fn(&Finding) -> bool| layout.findings.iter().any(is);
        let mut sample = LayoutSample {
            plates_overlap: any(|f| matches!(f, Finding::PlatesOverlap { .. })),
            base_overlap: any(|f| matches!(f, Finding::OverlapsBase { .. })),
            ..LayoutSample::default()
        };
        let clearance = ClearanceModel::new(&self.job.arm, &self.job.workcell, &layout.plates)?;
        let run = run(&PaperJob {
            layout,
            ..self.job.clone()
        })?;
        self.check_exactly(&run.tool_path, &clearance, &mut sample)?;
        execute(&run, &mut sample)?;
        Ok(sample)
    }

    /// Reach and contact of the exact path, each waypoint from the previous answer.
    fn check_exactly(
        &self,
        path: &ToolPath,
        clearance: &ClearanceModel,
        sample: &mut LayoutSample,
    ) -> Result<(), PaperError> {
        let job = &self.job;
        let tip = job.workcell.tool.tip_frame(&job.arm);
        let solver = IkSolver::new(&job.arm, tip, job.settings.ik_settings())?;
        for segment in &path.segments {
            let counts = count(&solver, segment, clearance);
            match segment.kind {
                SegmentKind::Wash => sample.plates.push(PlateSample {
                    spiral: counts,
                    executed_coverage: [NOTHING; SPONGES_MM.len()],
                }),
                _ => {
                    let sum = &mut sample.transit;
                    sum.points += counts.points;
                    sum.reached += counts.reached;
                    sum.clear += counts.clear;
                    sample.transits += 1;
                    sample.clear_transits += usize::from(counts.clear == counts.reached);
                }
            }
        }
        Ok(())
    }
}

fn count(solver: &IkSolver<'_>, segment: &Segment, clearance: &ClearanceModel) -> Counts {
    let mut counts = Counts::default();
    let mut seed = JointVector::from(READY_DEG).map(f64::to_radians);
    for target in &segment.waypoints {
        counts.points += 1;
        if let Ok(answer) = solver.solve(&tool_down(*target), &seed) {
            seed = answer.q;
            counts.reached += 1;
            let free = clearance.smallest(&seed, &[]).is_none_or(|c| c.distance_m > 0.0);
            counts.clear += usize::from(free);
        }
    }
    counts
}

/// Errors, radii, speeds and coverage of the literal execution.
fn execute(run: &PaperRun, sample: &mut LayoutSample) -> Result<(), CoverageError> {
    let mut plates = 0;
    for (index, segment) in run.tool_path.segments.iter().enumerate() {
        let steps: Vec<&Step> = run.steps.iter().filter(|s| s.segment == index).collect();
        let errors = steps.iter().map(|s| s.tracking_error_m());
        if segment.kind == SegmentKind::Transit {
            sample.transit_errors.extend(errors);
            continue;
        }
        let plate = run.job.layout.plates[segment.plate];
        if plates == 0 {
            sample.first_spiral_errors.extend(errors);
        } else {
            sample.later_spiral_errors.extend(errors);
            sample.outermost_radii.push(
                steps
                    .iter()
                    .map(|s| from_centre(&plate, &s.executed_tip))
                    .fold(0.0, f64::max),
            );
        }
        let path: Vec<_> = steps.iter().map(|s| [s.executed_tip.x, s.executed_tip.y]).collect();
        sample.plates[plates].executed_coverage = by_sponge(&path, &plate, &EXECUTED_CELL)?;
        plates += 1;
    }
    let dt = run.job.simulation.control.dt_s;
    let too_fast = |pair: &[JointVector]| {
        let speed = (pair[1] - pair[0]).abs() / dt;
        (0..speed.len()).any(|j| speed[j] > run.job.arm.limits().velocity[j])
    };
    sample.steps = run.steps.len();
    sample.steps_too_fast = run
        .executed
        .positions()
        .windows(2)
        .filter(|pair| too_fast(pair))
        .count();
    Ok(())
}

fn from_centre(plate: &Plate, tip: &Vector3<f64>) -> f64 {
    let [x, y] = plate.centre_xy();
    let (dx, dy) = (tip.x - x, tip.y - y);
    f64::sqrt(dx * dx + dy * dy)
}
