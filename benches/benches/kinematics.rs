//! The arm: forward kinematics, Jacobian, and inverse kinematics beside the peers.
//!
//!     cargo bench -p platewash-benches --bench kinematics
#![allow(missing_docs, clippy::print_stdout)]

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion, Throughput};
use platewash_benches::interleaved::{self, ROUNDS, Turn};
use platewash_benches::plain_fk::PlainArm;
use platewash_benches::problems::{AWAY_M, COUNT, MANY, Problems, THROUGH_M, configurations};
use platewash_benches::score::{Score, errors};
use platewash_benches::solvers::{self, Solvers};
use platewash_kinematics::ik::{IkError, IkSettings, IkSolution, IkSolver};
use platewash_kinematics::rotation::Rigid;
use platewash_kinematics::{Axes, JointVector, Pose, RobotModel, ToolFrame, batch};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::error::Error;
use std::hint::black_box;
use std::time::{Duration, Instant};

/// Configurations in a batch.
const BATCH: usize = 100_000;

fn main() -> Result<(), Box<dyn Error>> {
    let robot = RobotModel::irb120()?;
    let workloads = [
        Workload::new(
            "ik_warm, through the wrist singularity",
            Problems::spiral(&robot, THROUGH_M)?,
            solvers::warm,
            2,
        ),
        Workload::new(
            "ik_warm, away from it",
            Problems::spiral(&robot, AWAY_M)?,
            solvers::warm,
            2,
        ),
        Workload::new("ik_nearest", Problems::random_many(&robot)?, solvers::nearest, 1),
        Workload::new("ik_cold", Problems::random(&robot, COUNT)?, solvers::cold, 1),
    ];
    let mut criterion = Criterion::default().configure_from_args();
    forward(&mut criterion, &robot)?;
    for workload in &workloads {
        inverse(&mut criterion, &robot, workload)?;
    }
    criterion.final_summary();
    // `--test` and `--list` want no measurement.
    if !std::env::args().any(|a| a == "--test" || a == "--list") {
        println!("{}", forward_table(&robot)?);
        println!("{}", batch_table(&robot)?);
        for Workload {
            name,
            problems,
            solvers,
            own,
        } in &workloads
        {
            let rows = interleaved::compare(&mut solvers(&robot, problems)?, *own, problems, &robot)?;
            println!("{}", interleaved::table(name, &rows));
        }
    }
    Ok(())
}

/// Prepares the solvers for the problems.
type Prepare = for<'a> fn(&'a RobotModel, &Problems) -> Result<Solvers<'a>, Box<dyn Error>>;

/// Problems and who solves them.
struct Workload {
    name: &'static str,
    problems: Problems,
    solvers: Prepare,
    /// How many of the solvers are ours.
    own: usize,
}

impl Workload {
    fn new(name: &'static str, problems: Problems, solvers: Prepare, own: usize) -> Self {
        Self {
            name,
            problems,
            solvers,
            own,
        }
    }
}

/// Our forward kinematics beside the same chain on the platform's sine and cosine, on [`MANY`] configurations.
fn forward_table(robot: &RobotModel) -> Result<String, Box<dyn Error>> {
    let tool0 = robot.tool_frame(ToolFrame::Tool0)?;
    let plain = PlainArm::default();
    let configurations = configurations(robot, MANY, &mut Pcg64::seed_from_u64(2));
    let turns = interleaved::turns(
        &mut [
            Box::new(|| {
                timed(MANY, || {
                    for q in &configurations {
                        black_box(robot.fk(black_box(q)).rigid(&tool0));
                    }
                })
            }),
            Box::new(|| {
                timed(MANY, || {
                    for q in &configurations {
                        black_box(plain.tool0(black_box(q)));
                    }
                })
            }),
        ],
        1,
    );
    let mut text = format!("\nforward to tool0, {ROUNDS} interleaved rounds\n\n");
    text += "| forward | ns | platewash / it |\n| --- | ---: | ---: |\n";
    let names = ["platewash", "the chain on the platform's sine and cosine"];
    for (name, Turn { median_ns, ratios }) in names.iter().zip(turns) {
        text += &format!("| {name} | {median_ns:.0} | {:.2} |\n", ratios[0]);
    }
    Ok(text)
}

/// Batches of [`BATCH`] configurations on one core beside one after the other; warm means that the start is 0.01 rad
/// or less from an answer, joint by joint.
fn batch_table(robot: &RobotModel) -> Result<String, Box<dyn Error>> {
    let one_core = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    one_core
        .install(|| batch_table_here(robot))
        .map_err(|error| error as Box<dyn Error>)
}

fn batch_table_here(robot: &RobotModel) -> Result<String, Box<dyn Error + Send + Sync>> {
    let tool0 = robot.tool_frame(ToolFrame::Tool0)?;
    let plain = PlainArm::default();
    let mut rng = Pcg64::seed_from_u64(5);
    let q = configurations(robot, BATCH, &mut rng);
    let targets: Vec<_> = q.iter().map(|q| robot.pose(q, &tool0)).collect();
    let near = |q: &JointVector| {
        robot
            .limits()
            .clamp(&q.map(|angle| angle + 0.02 * (rng.random::<f64>() - 0.5)))
    };
    let starts: Vec<_> = q.iter().map(near).collect();
    let solver = IkSolver::new(robot, tool0, IkSettings::default())?;
    let (mut positions, mut rotations) = (vec![[0.0; 3]; BATCH], vec![[0.0; 9]; BATCH]);
    let forward = interleaved::turns(
        &mut [
            Box::new(|| {
                timed(BATCH, || {
                    let done = batch::fk_into(robot, &tool0, &q, &mut positions, &mut rotations, batch::Path::Detected);
                    let _ = black_box(done);
                })
            }),
            Box::new(|| {
                timed(BATCH, || {
                    for q in &q {
                        black_box(robot.fk(black_box(q)).rigid(&tool0));
                    }
                })
            }),
            Box::new(|| {
                timed(BATCH, || {
                    for q in &q {
                        black_box(plain.tool0(black_box(q)));
                    }
                })
            }),
        ],
        1,
    );
    let mut answers = batch::solve(&solver, &targets, &starts, batch::Path::Detected)?;
    let right = |(answer, target): (&Result<IkSolution, IkError>, &Pose)| {
        let Ok(answer) = answer else { return false };
        let [m, rad] = errors(&Rigid::from(target), &plain.tool0(&answer.q));
        robot.limits().contain(&answer.q) && m.max(rad) <= 1.001e-6
    };
    let solved = answers.iter().zip(&targets).filter(|pair| right(*pair)).count();
    let inverse = interleaved::turns(
        &mut [
            Box::new(|| {
                timed(BATCH, || {
                    let done = batch::solve_into(&solver, &targets, &starts, &mut answers, batch::Path::Detected);
                    let _ = black_box(done);
                })
            }),
            Box::new(|| {
                timed(BATCH, || {
                    for (target, start) in targets.iter().zip(&starts) {
                        let _ = black_box(solver.solve(target, start));
                    }
                })
            }),
        ],
        1,
    );
    let mut text = format!("\nbatches of {BATCH} on one core, {ROUNDS} interleaved rounds\n\n");
    text += "| per configuration | ns | batch / it |\n| --- | ---: | ---: |\n";
    let names = [
        "forward, batch",
        "forward, one by one",
        "forward, the chain on the platform's sine and cosine",
        "warm inverse, batch",
        "warm inverse, one by one",
    ];
    for (name, Turn { median_ns, ratios }) in names.iter().zip(forward.into_iter().chain(inverse)) {
        text += &format!("| {name} | {median_ns:.0} | {:.3} |\n", ratios[0]);
    }
    text += &format!("\nwarm inverse, batch: {solved} of {BATCH} solved\n");
    Ok(text)
}

/// Time of one pass per unit \[ns\].
fn timed(units: usize, pass: impl FnOnce()) -> f64 {
    let start = Instant::now();
    pass();
    start.elapsed().as_secs_f64() * 1e9 / units as f64
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
    let configurations = configurations(robot, COUNT, &mut Pcg64::seed_from_u64(1));
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

/// Times are for all targets of the workload; the share of them that was solved stands in the name.
fn inverse(criterion: &mut Criterion, robot: &RobotModel, workload: &Workload) -> Result<(), Box<dyn Error>> {
    let Workload { name, problems, .. } = workload;
    let mut group = group(criterion, name);
    group.throughput(Throughput::Elements(problems.targets.len() as u64));
    for mut solver in (workload.solvers)(robot, problems)? {
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
