//! The arm: forward kinematics, Jacobian, and inverse kinematics warm, cold, nearest and in batches. The share of the targets
//! that is solved stands beside the name.
//!
//!     cargo bench --bench ik
#![allow(missing_docs)]

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion, Throughput};
use platewash::kinematics::batch;
use platewash::{Axes, IkSettings, IkSolver, RobotModel, ToolFrame};
use platewash_problems::ours;
use platewash_problems::problems::{AWAY_M, COUNT, Problems, THROUGH_M, configurations};
use platewash_problems::score::Score;
use platewash_problems::solver::Solvers;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use std::error::Error;
use std::hint::black_box;
use std::time::Duration;

/// Targets in a batch.
const BATCH: usize = 10_000;

/// Prepares our solvers for the problems.
type Prepare = for<'a> fn(&'a RobotModel, &Problems) -> Result<Solvers<'a>, Box<dyn Error>>;

fn main() -> Result<(), Box<dyn Error>> {
    // One thread, whatever the machine has.
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global()?;
    let robot = RobotModel::irb120()?;
    let through = Problems::spiral(&robot, THROUGH_M)?;
    let away = Problems::spiral(&robot, AWAY_M)?;
    let mut criterion = Criterion::default().configure_from_args();
    forward(&mut criterion, &robot)?;
    one_by_one(
        &mut criterion,
        &robot,
        "ik_warm, through the wrist singularity",
        &through,
        ours::warm,
    )?;
    one_by_one(&mut criterion, &robot, "ik_warm, away from it", &away, ours::warm)?;
    one_by_one(
        &mut criterion,
        &robot,
        "ik_nearest",
        &Problems::random_many(&robot)?,
        ours::nearest,
    )?;
    one_by_one(
        &mut criterion,
        &robot,
        "ik_cold",
        &Problems::random(&robot, COUNT)?,
        ours::cold,
    )?;
    in_batches(&mut criterion, &robot)?;
    criterion.final_summary();
    Ok(())
}

fn group<'a>(criterion: &'a mut Criterion, name: &str, units: usize) -> BenchmarkGroup<'a, WallTime> {
    let mut group = criterion.benchmark_group(name);
    group.throughput(Throughput::Elements(units as u64));
    group
        .warm_up_time(Duration::from_secs(1))
        .measurement_time(Duration::from_secs(3))
        .sample_size(20);
    group
}

/// Times are for [`COUNT`] configurations.
fn forward(criterion: &mut Criterion, robot: &RobotModel) -> Result<(), Box<dyn Error>> {
    let tool0 = robot.tool_frame(ToolFrame::Tool0)?;
    let configurations = configurations(robot, COUNT, &mut Pcg64::seed_from_u64(1));
    let mut group = group(criterion, "forward", COUNT);
    group.bench_function("all bodies", |b| {
        b.iter(|| {
            for q in &configurations {
                black_box(robot.fk(q));
            }
        });
    });
    group.bench_function("all bodies and Jacobian", |b| {
        b.iter(|| {
            for q in &configurations {
                let bodies = robot.fk(q);
                black_box((bodies.rigid(&tool0), bodies.jacobian(&tool0, Axes::Base)));
            }
        });
    });
    group.finish();
    Ok(())
}

/// Times are for all targets of the workload.
fn one_by_one(
    criterion: &mut Criterion,
    robot: &RobotModel,
    name: &str,
    problems: &Problems,
    prepare: Prepare,
) -> Result<(), Box<dyn Error>> {
    let mut group = group(criterion, name, problems.targets.len());
    for mut solver in prepare(robot, problems)? {
        let score = Score::of(solver.as_mut(), problems, robot)?;
        let id = BenchmarkId::new(solver.name(), solved(&score)?);
        group.bench_function(id, |b| {
            b.iter(|| {
                problems.run(solver.as_mut(), |_, answer| {
                    black_box(answer);
                });
            });
        });
    }
    group.finish();
    Ok(())
}

/// Times are for [`BATCH`] targets, each from a start at most 0.01 rad off, joint by joint.
fn in_batches(criterion: &mut Criterion, robot: &RobotModel) -> Result<(), Box<dyn Error>> {
    let problems = Problems::near(robot, BATCH)?;
    let starts = problems.starts()?;
    let solver = IkSolver::new(robot, robot.tool_frame(ToolFrame::Tool0)?, IkSettings::default())?;
    let mut answers = batch::solve(&solver, &problems.targets, starts, batch::Backend::Detected)?;
    let found = answers.iter().map(|answer| answer.as_ref().ok().map(|answer| answer.q));
    let score = Score::of_answers(found, &problems, robot)?;
    let mut group = group(criterion, "ik_batch", BATCH);
    group.bench_function(BenchmarkId::new("platewash `batch::solve`", solved(&score)?), |b| {
        b.iter(|| {
            black_box(batch::solve_into(
                &solver,
                &problems.targets,
                starts,
                &mut answers,
                batch::Backend::Detected,
            ))
        });
    });
    group.finish();
    Ok(())
}

/// What a time bought; an error for a solver whose answers are wrong.
fn solved(score: &Score) -> Result<String, Box<dyn Error>> {
    match score.wrong {
        0 => Ok(format!("solved {:.1} %", score.percent())),
        wrong => Err(format!("{wrong} of {} answers are wrong", score.count).into()),
    }
}
