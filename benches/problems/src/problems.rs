//! Inverse-kinematics workloads: poses of `tool0` and the configurations to start from.

use crate::solver::Solver;
use crate::{ANALYTIC, NUMERIC, Tolerance};
use nalgebra::{UnitQuaternion, Vector3};
use platewash_kinematics::ik::{IkSettings, IkSolver};
use platewash_kinematics::{JointVector, Pose, RobotModel, ToolFrame};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::error::Error;
use std::f64::consts::{PI, TAU};

/// Targets in a workload, unless it says otherwise.
pub const COUNT: usize = 1000;
/// Targets for solvers whose time depends on what the branch predictor has learnt.
pub const MANY: usize = 20_000;
/// Centre and radius of a spiral that crosses the wrist singularity twice \[m\].
pub const THROUGH_M: [f64; 3] = [0.25, -0.25, 0.145];
/// Centre and radius of a spiral that stays away from it; between it and the end of the reach a radius of 0.145 m does not
/// fit \[m\].
pub const AWAY_M: [f64; 3] = [0.41, 0.09, 0.115];
/// Height of the tool over the base \[m\].
const HEIGHT_M: f64 = 0.08;
const TURNS: f64 = 3.0;
/// Seed of the random workloads.
const STREAM: u64 = 120;
/// Seed of those that start near an answer.
const NEAR_STREAM: u64 = 5;

/// Poses to reach, and from where.
#[derive(Debug, Clone)]
pub struct Problems {
    /// Target poses `T_base_tool0`.
    pub targets: Vec<Pose>,
    /// Starts.
    pub seeds: Seeds,
    /// How well they must be reached.
    pub tolerance: Tolerance,
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
    /// The start of each problem \[rad\].
    ///
    /// # Errors
    /// For problems that start from the last answer.
    pub fn starts(&self) -> Result<&[JointVector], &'static str> {
        match &self.seeds {
            Seeds::Given(starts) => Ok(starts),
            Seeds::LastAnswer(_) => Err("the problems have no start each"),
        }
    }

    /// Warm: an Archimedean spiral of three turns over the plate, equal angles apart, tool straight down (a turn
    /// by π about y), each point from the last answer.
    ///
    /// # Errors
    /// None unless the arm was changed: the centre of the plate is within its reach.
    pub fn spiral(robot: &RobotModel, [centre_x, centre_y, radius]: [f64; 3]) -> Result<Self, Box<dyn Error>> {
        let down = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), PI);
        let pose = |k: usize| {
            let share = k as f64 / (COUNT - 1) as f64;
            let (sin, cos) = (TAU * TURNS * share).sin_cos();
            let [x, y] = [centre_x + radius * share * cos, centre_y + radius * share * sin];
            Pose::from_parts(Vector3::new(x, y, HEIGHT_M).into(), down)
        };
        let targets: Vec<_> = (0..COUNT).map(pose).collect();
        let tool0 = robot.tool_frame(ToolFrame::Tool0)?;
        let solver = IkSolver::new(robot, tool0, IkSettings::default())?;
        let start = solver.solve(&targets[0], &JointVector::zeros())?.q;
        Ok(Self {
            targets,
            seeds: Seeds::LastAnswer(start),
            tolerance: NUMERIC,
        })
    }

    /// Cold: poses of random configurations within the limits, each from another random configuration.
    ///
    /// # Errors
    /// None unless the arm was changed: it has a `tool0`.
    pub fn random(robot: &RobotModel, count: usize) -> Result<Self, Box<dyn Error>> {
        let mut rng = Pcg64::seed_from_u64(STREAM);
        let tool0 = robot.tool_frame(ToolFrame::Tool0)?;
        let targets = configurations(robot, count, &mut rng)
            .iter()
            .map(|q| robot.pose(q, &tool0))
            .collect();
        let seeds = Seeds::Given(configurations(robot, count, &mut rng));
        let tolerance = NUMERIC;
        Ok(Self {
            targets,
            seeds,
            tolerance,
        })
    }

    /// The same for analytic solvers: [`MANY`], to [`ANALYTIC`].
    ///
    /// # Errors
    /// None unless the arm was changed: it has a `tool0`.
    pub fn random_many(robot: &RobotModel) -> Result<Self, Box<dyn Error>> {
        Ok(Self {
            tolerance: ANALYTIC,
            ..Self::random(robot, MANY)?
        })
    }

    /// Near: poses of random configurations within the limits, each from a start that is at most 0.01 rad from its
    /// configuration, joint by joint.
    ///
    /// # Errors
    /// None unless the arm was changed: it has a `tool0`.
    pub fn near(robot: &RobotModel, count: usize) -> Result<Self, Box<dyn Error>> {
        let mut rng = Pcg64::seed_from_u64(NEAR_STREAM);
        let tool0 = robot.tool_frame(ToolFrame::Tool0)?;
        let q = configurations(robot, count, &mut rng);
        let mut near = |q: &JointVector| {
            let moved = q.map(|angle| angle + 0.02 * (rng.random::<f64>() - 0.5));
            robot.limits().clamp(&moved)
        };
        Ok(Self {
            targets: q.iter().map(|q| robot.pose(q, &tool0)).collect(),
            seeds: Seeds::Given(q.iter().map(&mut near).collect()),
            tolerance: NUMERIC,
        })
    }

    /// Where a path starts; zero if the targets are none \[rad\].
    #[must_use]
    pub fn start(&self) -> JointVector {
        match &self.seeds {
            Seeds::LastAnswer(start) => *start,
            Seeds::Given(_) => JointVector::zeros(),
        }
    }

    /// Solves all targets in order; `seen` gets each target's index and answer.
    pub fn run(&self, solver: &mut dyn Solver, mut seen: impl FnMut(usize, Option<JointVector>)) {
        let mut last = self.start();
        if let Some(path) = solver.path(&last) {
            return path.into_iter().enumerate().for_each(|(k, answer)| seen(k, answer));
        }
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

/// Random configurations within the limits \[rad\].
pub fn configurations(robot: &RobotModel, count: usize, rng: &mut Pcg64) -> Vec<JointVector> {
    (0..count).map(|_| configuration(robot, rng)).collect()
}

/// One random configuration within the limits \[rad\].
pub fn configuration(robot: &RobotModel, rng: &mut Pcg64) -> JointVector {
    JointVector::from_fn(|joint, _| {
        let [low, high] = robot.limits().sampling_range(joint);
        low + (high - low) * rng.random::<f64>()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_spiral_goes_through_the_wrist_singularity_and_one_stays_away() {
        let robot = RobotModel::irb120().unwrap();
        let of = |centre| {
            let problems = Problems::spiral(&robot, centre).unwrap();
            let tool0 = robot.tool_frame(ToolFrame::Tool0).unwrap();
            let solver = IkSolver::new(&robot, tool0, IkSettings::default()).unwrap();
            let path = solver.solve_path(&problems.targets, &problems.start()).unwrap();
            path.q.iter().map(|q| q[4].abs()).fold(f64::INFINITY, f64::min)
        };
        let (through, away) = (of(THROUGH_M), of(AWAY_M));
        assert!(through < 0.01 && away > 0.05, "{through} {away}");
    }
}
