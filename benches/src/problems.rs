//! Inverse-kinematics workloads: poses of `tool0` and the configurations to start from.

use crate::solvers::Solver;
use nalgebra::{UnitQuaternion, Vector3};
use platewash_kinematics::ik::{IkSettings, IkSolver};
use platewash_kinematics::{JointVector, Pose, RobotModel, ToolFrame};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::error::Error;
use std::f64::consts::{PI, TAU};

/// Targets in every workload.
pub const COUNT: usize = 1000;
/// Centre of the plate \[m\].
const CENTRE_M: [f64; 2] = [0.25, -0.25];
/// Height of the tool over the base \[m\].
const HEIGHT_M: f64 = 0.08;
/// Radius of the spiral \[m\].
const RADIUS_M: f64 = 0.145;
const TURNS: f64 = 3.0;
/// Seed of the random workloads.
const STREAM: u64 = 120;

/// Poses to reach, and from where.
#[derive(Debug, Clone)]
pub struct Problems {
    /// Target poses `T_base_tool0`.
    pub targets: Vec<Pose>,
    /// Starts.
    pub seeds: Seeds,
}

/// Where each solution starts from.
#[derive(Debug, Clone)]
pub enum Seeds {
    /// From the last answer; the first one from here \[rad\].
    LastAnswer(JointVector),
    /// From one given configuration each \[rad\].
    Given(Vec<JointVector>),
}

impl Problems {
    /// Warm: an Archimedean spiral of three turns over the plate, equal angles apart, tool straight down (a turn
    /// by π about y), each point from the last answer. It crosses the wrist singularity.
    ///
    /// # Errors
    /// None unless the arm was changed: the centre of the plate is within its reach.
    pub fn spiral(robot: &RobotModel) -> Result<Self, Box<dyn Error>> {
        let down = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), PI);
        let pose = |k: usize| {
            let share = k as f64 / (COUNT - 1) as f64;
            let (sin, cos) = (TAU * TURNS * share).sin_cos();
            let [x, y] = [
                CENTRE_M[0] + RADIUS_M * share * cos,
                CENTRE_M[1] + RADIUS_M * share * sin,
            ];
            Pose::from_parts(Vector3::new(x, y, HEIGHT_M).into(), down)
        };
        let targets: Vec<_> = (0..COUNT).map(pose).collect();
        let tool0 = robot.tool_frame(ToolFrame::Tool0)?;
        let solver = IkSolver::new(robot, tool0, IkSettings::default())?;
        let start = solver.solve(&targets[0], &JointVector::zeros())?.q;
        Ok(Self {
            targets,
            seeds: Seeds::LastAnswer(start),
        })
    }

    /// Cold: poses of random configurations within the limits, each from another random configuration.
    ///
    /// # Errors
    /// None unless the arm was changed: it has a `tool0`.
    pub fn random(robot: &RobotModel) -> Result<Self, Box<dyn Error>> {
        let mut rng = Pcg64::seed_from_u64(STREAM);
        let tool0 = robot.tool_frame(ToolFrame::Tool0)?;
        let targets = configurations(robot, &mut rng)
            .iter()
            .map(|q| robot.pose(q, &tool0))
            .collect();
        let seeds = Seeds::Given(configurations(robot, &mut rng));
        Ok(Self { targets, seeds })
    }

    /// Solves all targets in order; `seen` gets each target's index and answer.
    pub fn run(&self, solver: &mut dyn Solver, mut seen: impl FnMut(usize, Option<JointVector>)) {
        let mut last = match &self.seeds {
            Seeds::LastAnswer(start) => *start,
            Seeds::Given(_) => JointVector::zeros(),
        };
        for target in 0..self.targets.len() {
            let seed = match &self.seeds {
                Seeds::LastAnswer(_) => last,
                Seeds::Given(seeds) => seeds[target],
            };
            let answer = solver.solve(target, &seed);
            last = answer.unwrap_or(last);
            seen(target, answer);
        }
    }
}

/// [`COUNT`] random configurations within the limits \[rad\].
pub fn configurations(robot: &RobotModel, rng: &mut Pcg64) -> Vec<JointVector> {
    (0..COUNT).map(|_| configuration(robot, rng)).collect()
}

/// One random configuration within the limits \[rad\].
pub fn configuration(robot: &RobotModel, rng: &mut Pcg64) -> JointVector {
    JointVector::from_fn(|joint, _| {
        let [low, high] = robot.limits().sampling_range(joint);
        low + (high - low) * rng.random::<f64>()
    })
}
