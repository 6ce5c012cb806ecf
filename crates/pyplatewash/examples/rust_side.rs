//! The Rust calls behind the wheel's, timed for tests/python/bench_wheel.py, which runs this program.
//!
//!     rust_side FILE
//!
//! FILE holds configurations and then as many seeds near them, rows of six little-endian doubles. Each line of standard
//! input names a piece of work; the answer is a line with the seconds that it took.
#![allow(clippy::print_stdout)]

use platewash::kinematics::batch::{self, Backend};
use platewash::{Frame, IkSettings, IkSolver, JointVector, Pose, RobotModel, Scenario, ToolFrame, plan};
use std::error::Error;
use std::hint::black_box;
use std::io::Write;
use std::time::Instant;

/// Calls of which one is timed, where one is too short for a clock.
const CALLS: u32 = 1000;

/// The problems, as a caller in Rust has them.
struct Work {
    robot: RobotModel,
    tool0: Frame,
    q: Vec<JointVector>,
    seeds: Vec<JointVector>,
    targets: Vec<Pose>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).ok_or("which file?")?;
    let work = Work::read(&std::fs::read(file)?)?;
    for line in std::io::stdin().lines() {
        println!("{}", work.seconds(line?.trim())?);
        std::io::stdout().flush()?;
    }
    Ok(())
}

impl Work {
    fn read(bytes: &[u8]) -> Result<Self, Box<dyn Error>> {
        let (doubles, _) = bytes.as_chunks::<8>();
        let numbers: Vec<f64> = doubles.iter().map(|b| f64::from_le_bytes(*b)).collect();
        let (rows, _) = numbers.as_chunks::<6>();
        let mut q: Vec<JointVector> = rows.iter().map(|row| JointVector::from(*row)).collect();
        let seeds = q.split_off(q.len() / 2);
        let robot = RobotModel::irb120()?;
        let tool0 = robot.tool_frame(ToolFrame::Tool0)?;
        let targets = batch::fk(&robot, &tool0, &q, Backend::Detected);
        Ok(Self {
            robot,
            tool0,
            q,
            seeds,
            targets,
        })
    }

    /// Does the work that goes by this name and says how long it took \[s\].
    fn seconds(&self, name: &str) -> Result<f64, Box<dyn Error>> {
        let solver = IkSolver::new(&self.robot, self.tool0, IkSettings::default())?;
        let cold = vec![JointVector::zeros(); self.q.len()];
        let begun = Instant::now();
        match name {
            "fk" => {
                let mut matrices = vec![[0.0; 16]; self.q.len()];
                batch::fk_matrices_into(&self.robot, &self.tool0, &self.q, &mut matrices, Backend::Detected)?;
                drop(black_box(matrices));
            }
            "fk one" => {
                for q in self.q.iter().take(CALLS as usize) {
                    black_box(self.robot.fk(black_box(q)).rigid(&self.tool0));
                }
                return Ok(begun.elapsed().as_secs_f64() / f64::from(CALLS));
            }
            "ik warm" => drop(black_box(batch::solve(
                &solver,
                &self.targets,
                &self.seeds,
                Backend::Detected,
            )?)),
            "ik cold" => drop(black_box(batch::solve(
                &solver,
                &self.targets,
                &cold,
                Backend::Detected,
            )?)),
            "plan" => drop(black_box(plan(&Scenario::load("kitchen")?.job()?)?)),
            other => return Err(format!("no work is called '{other}'").into()),
        }
        Ok(begun.elapsed().as_secs_f64())
    }
}
