//! One layout of the paper's cell, planned exactly and executed literally.

use crate::error::PlanError;
use crate::job::{self, Job};
use crate::place;
use crate::robot;
use crate::scenario::Scenario;
use crate::tool_path::{Segment, SegmentKind, ToolPath};
use crate::tracking::Step;
use nalgebra::Vector3;
use platewash_kinematics::ik::IkSolver;
use platewash_kinematics::{JointVector, RobotModel};
use platewash_workcell::clearance::ClearanceModel;
use platewash_workcell::coverage::{Coverage, CoverageError, CoverageSettings, coverage};
use platewash_workcell::layout::{Finding, Plate};
use platewash_workcell::random;
use platewash_workcell::tool::tool_down;
use rand::Rng;

/// Sponge radii for which coverage is measured \[mm\].
pub(super) const SPONGES_MM: [u32; 8] = [10, 15, 20, 25, 30, 35, 40, 45];

/// Coverage raster of the many executed spirals; its proven error is added to the sampling error.
const EXECUTED_CELL: CoverageSettings = CoverageSettings { cell_m: 5e-4 };

/// Posture from which the exact check of a segment starts: in front of the base, elbow up, flange down (degrees).
const READY_DEG: [f64; 6] = [0.0, 10.0, 10.0, 0.0, 70.0, 0.0];

const NOTHING: Coverage = Coverage {
    fraction: 0.0,
    lower: 0.0,
    upper: 0.0,
};

/// How many points there are, are reached, and are reached without contact.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Counts {
    pub points: usize,
    pub reached: usize,
    pub clear: usize,
}

/// What one plate came to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PlateSample {
    pub spiral: Counts,
    /// By sponge radius, see [`SPONGES_MM`].
    pub executed_coverage: [Coverage; SPONGES_MM.len()],
}

/// What one layout came to.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct LayoutSample {
    pub plates_overlap: bool,
    pub base_overlap: bool,
    pub plates: Vec<PlateSample>,
    pub transition: Counts,
    pub transitions: usize,
    pub clear_transitions: usize,
    /// Tip errors \[m\].
    pub first_spiral_errors: Vec<f64>,
    pub later_spiral_errors: Vec<f64>,
    pub transition_errors: Vec<f64>,
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

/// What all layouts of a region share.
pub(super) struct Bench {
    scenario: Scenario,
    robot: RobotModel,
}

impl Bench {
    pub fn new(scenario: Scenario) -> Result<Self, PlanError> {
        let robot = robot::load(&scenario.robot)?;
        Ok(Self { scenario, robot })
    }

    /// Layout number `k` of a region.
    pub fn measure(&self, seed: u64, region: &str, k: usize) -> Result<LayoutSample, PlanError> {
        let mut scenario = self.scenario.clone();
        scenario.seed = random::stream(seed, &format!("reproduce/layout/{region}/{k}")).next_u64();
        let layout = place::place_plates(&scenario, &self.robot)?;
        let any = |is: fn(&Finding) -> bool| layout.findings.iter().any(is);
        let mut sample = LayoutSample {
            plates_overlap: any(|f| matches!(f, Finding::PlatesOverlap { .. })),
            base_overlap: any(|f| matches!(f, Finding::OverlapsBase { .. })),
            ..LayoutSample::default()
        };
        let clearance = ClearanceModel::new(&self.robot, &scenario.tool, &layout.plates)?;
        let job = Job::on(&scenario, self.robot.clone(), layout)?;
        self.check_exactly(&job.tool_path, &clearance, &mut sample)?;
        execute(&job, &mut sample)?;
        Ok(sample)
    }

    /// Reach and contact of the exact path, each waypoint from the previous answer.
    fn check_exactly(
        &self,
        path: &ToolPath,
        clearance: &ClearanceModel,
        sample: &mut LayoutSample,
    ) -> Result<(), PlanError> {
        let tip = platewash_workcell::tool::tip_frame(&self.robot, &self.scenario.tool);
        let solver = IkSolver::new(&self.robot, tip, job::ik_settings(&self.scenario))?;
        for segment in &path.segments {
            let counts = count(&solver, segment, clearance);
            match segment.kind {
                SegmentKind::Wash => sample.plates.push(PlateSample {
                    spiral: counts,
                    executed_coverage: [NOTHING; SPONGES_MM.len()],
                }),
                _ => {
                    let sum = &mut sample.transition;
                    sum.points += counts.points;
                    sum.reached += counts.reached;
                    sum.clear += counts.clear;
                    sample.transitions += 1;
                    sample.clear_transitions += usize::from(counts.clear == counts.reached);
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
fn execute(job: &Job, sample: &mut LayoutSample) -> Result<(), CoverageError> {
    let mut plates = 0;
    for (index, segment) in job.tool_path.segments.iter().enumerate() {
        let steps: Vec<&Step> = job.steps.iter().filter(|s| s.segment == index).collect();
        let errors = steps.iter().map(|s| s.tracking_error_m());
        if segment.kind == SegmentKind::Transition {
            sample.transition_errors.extend(errors);
            continue;
        }
        let plate = job.layout.plates[segment.plate];
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
    let dt = job.scenario.control.dt_s;
    let too_fast = |pair: &[JointVector]| {
        let speed = (pair[1] - pair[0]).abs() / dt;
        (0..speed.len()).any(|j| speed[j] > job.robot.limits().velocity[j])
    };
    sample.steps = job.steps.len();
    sample.steps_too_fast = job
        .executed
        .positions()
        .windows(2)
        .filter(|pair| too_fast(pair))
        .count();
    Ok(())
}

fn from_centre(plate: &Plate, tip: &Vector3<f64>) -> f64 {
    let (dx, dy) = (tip.x - plate.x_m, tip.y - plate.y_m);
    f64::sqrt(dx * dx + dy * dy)
}

fn by_sponge(
    path: &[[f64; 2]],
    plate: &Plate,
    settings: &CoverageSettings,
) -> Result<[Coverage; SPONGES_MM.len()], CoverageError> {
    let mut all = [NOTHING; SPONGES_MM.len()];
    for (covered, sponge) in all.iter_mut().zip(SPONGES_MM) {
        *covered = coverage(
            path,
            [plate.x_m, plate.y_m],
            plate.radius_m,
            1e-3 * f64::from(sponge),
            settings,
        )?;
    }
    Ok(all)
}

/// Coverage of a plate had the tip followed the waypoints, by sponge radius.
pub(super) fn ideal_coverage(scenario: &Scenario) -> Result<[Coverage; SPONGES_MM.len()], PlanError> {
    let mut single = scenario.clone();
    single.layout.positions_m = Some(vec![[0.3, 0.0]]);
    let layout = place::place_plates(&single, &robot::load(&single.robot)?)?;
    let path = ToolPath::new(&single, &layout);
    let spiral: Vec<_> = path
        .segments
        .iter()
        .flat_map(|s| &s.waypoints)
        .map(|p| [p.x, p.y])
        .collect();
    Ok(by_sponge(
        &spiral,
        &layout.plates[0],
        &CoverageSettings { cell_m: 1e-4 },
    )?)
}
