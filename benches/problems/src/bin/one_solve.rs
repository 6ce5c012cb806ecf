//! A number of solves for an instruction counter, after the same preparation whatever the number: the difference of two
//! runs is what one solve costs. `cargo xtask ledger` takes it.
//!
//! | first word | one solve is |
//! | --- | --- |
//! | `warm` | `IkSolver::solve` of the next point of a spiral from the last answer |
//! | `path` | one more point of `IkSolver::solve_path` |
//! | `cold` | `AnalyticArm::nearest` of a random pose from a random start |
//! | `cold-solve` | `IkSolver::solve` of the same |
//! | `fk-batch` | `batch::fk` of 1000 random configurations |
//! | `ik-batch` | `batch::solve` of 1000 poses from starts at most 0.01 rad off |
//!
//! `cold` calls [`one_case`] for each of its cases, by which callgrind can tell them apart.
#![allow(clippy::print_stdout)]

use platewash_kinematics::batch::{self, Backend};
use platewash_kinematics::ik::{IkSettings, IkSolver};
use platewash_kinematics::{JointVector, RobotModel, ToolFrame};
use platewash_problems::ours::{AnalyticIk, NumericIk, Path};
use platewash_problems::problems::{Problems, Seeds, THROUGH_M};
use platewash_problems::solver::Solver;
use std::error::Error;
use std::hint::black_box;

/// Random poses, the same in every run.
const CASES: usize = 10_000;

/// Configurations or poses in a batch.
const BATCH: usize = 1000;

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let which = words.next().unwrap_or_default();
    let count: usize = words.next().unwrap_or_default().parse()?;
    let robot = RobotModel::irb120()?;
    let spiral = Problems::spiral(&robot, THROUGH_M)?;
    let random = Problems::random(&robot, CASES)?;
    let solved = match which.as_str() {
        "warm" => run(&mut NumericIk::new(&robot, &spiral)?, &spiral, count),
        "path" => {
            let start = spiral.start();
            let mut some = spiral;
            some.targets.truncate(count);
            let answers = Path::new(&robot, &some)?.path(&start);
            answers.into_iter().flatten().flatten().count()
        }
        "cold" => run(&mut AnalyticIk::new(&robot, &random)?, &random, count),
        "cold-solve" => run(&mut NumericIk::new(&robot, &random)?, &random, count),
        "fk-batch" => {
            let near = Problems::near(&robot, BATCH)?;
            let configurations = near.starts()?;
            let frame = robot.tool_frame(ToolFrame::Tool0)?;
            let all = (0..count).map(|_| batch::fk(&robot, &frame, black_box(configurations), Backend::Detected).len());
            all.sum::<usize>() / BATCH
        }
        "ik-batch" => {
            let near = Problems::near(&robot, BATCH)?;
            let starts = near.starts()?;
            let solver = IkSolver::new(&robot, robot.tool_frame(ToolFrame::Tool0)?, IkSettings::default())?;
            let mut solved = 0;
            for _ in 0..count {
                let answers = batch::solve(&solver, black_box(&near.targets), starts, Backend::Detected)?;
                solved += usize::from(answers.iter().all(Result::is_ok));
            }
            solved
        }
        _ => return Err("one of warm, path, cold, cold-solve, fk-batch, ik-batch, and a number".into()),
    };
    println!("{solved} of {count} solved");
    Ok(())
}

fn run(solver: &mut dyn Solver, problems: &Problems, count: usize) -> usize {
    let mut last = problems.start();
    let mut solved = 0;
    for target in 0..count.min(problems.targets.len()) {
        let seed = match &problems.seeds {
            Seeds::LastAnswer(_) => last,
            Seeds::Given(seeds) => seeds[target],
        };
        let answer = one_case(solver, target, &seed);
        last = answer.unwrap_or(last);
        solved += usize::from(answer.is_some());
    }
    solved
}

/// One solve, and nothing else.
#[inline(never)]
fn one_case(solver: &mut dyn Solver, target: usize, seed: &JointVector) -> Option<JointVector> {
    black_box(solver.solve(black_box(target), black_box(seed)))
}
