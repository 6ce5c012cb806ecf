//! The arm: forward kinematics, Jacobian, and inverse kinematics beside the peers.
//!
//!     cargo bench -p platewash-benches --bench kinematics
#![allow(missing_docs, clippy::print_stdout)]

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion, Throughput};
use platewash_benches::interleaved;
use platewash_benches::problems::{COUNT, Problems, configurations};
use platewash_benches::score::Score;
use platewash_benches::solvers;
use platewash_kinematics::{Axes, RobotModel, ToolFrame};
use rand::SeedableRng;
use rand_pcg::Pcg64;
use std::error::Error;
use std::hint::black_box;
use std::time::Duration;

fn main() -> Result<(), Box<dyn Error>> {
    let robot = RobotModel::irb120()?;
    let warm = Problems::spiral(&robot)?;
    let cold = Problems::random(&robot)?;
    let mut criterion = Criterion::default().configure_from_args();
    forward(&mut criterion, &robot)?;
    inverse(&mut criterion, "ik_warm", &robot, &warm)?;
    inverse(&mut criterion, "ik_cold", &robot, &cold)?;
    criterion.final_summary();
    // `--test` and `--list` want no measurement.
    if !std::env::args().any(|a| a == "--test" || a == "--list") {
        for (title, problems) in [("ik_warm", &warm), ("ik_cold", &cold)] {
            let rows = interleaved::compare(&mut solvers::all(&robot, problems)?, problems, &robot)?;
            println!("{}", interleaved::table(title, &rows));
        }
    }
    Ok(())
}

fn group<'a>(criterion: &'a mut Criterion, name: &str) -> BenchmarkGroup<'a, WallTime> {
    let mut group = criterion.benchmark_group(name);
    group.throughput(Throughput::Elements(COUNT as u64));
    group
        .warm_up_time(Duration::from_secs(1))
        .measurement_time(Duration::from_secs(3))
        .sample_size(20);
    group
}

/// Times are for [`COUNT`] configurations.
fn forward(criterion: &mut Criterion, robot: &RobotModel) -> Result<(), Box<dyn Error>> {
    let tool0 = robot.tool_frame(ToolFrame::Tool0)?;
    let configurations = configurations(robot, &mut Pcg64::seed_from_u64(1));
    let mut group = group(criterion, "forward");
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

/// Times are for [`COUNT`] targets; the share of them that was solved stands in the name.
fn inverse(
    criterion: &mut Criterion,
    name: &str,
    robot: &RobotModel,
    problems: &Problems,
) -> Result<(), Box<dyn Error>> {
    let mut group = group(criterion, name);
    for mut solver in solvers::all(robot, problems)? {
        let score = Score::of(solver.as_mut(), problems, robot)?;
        let id = BenchmarkId::new(solver.name(), format!("solved {:.1} %", score.percent()));
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
