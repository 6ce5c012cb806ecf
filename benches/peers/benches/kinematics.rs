//! Forward and inverse kinematics beside the peers: all solvers take turns, and the tables say time and success.
//!
//!     cargo bench --manifest-path benches/peers/Cargo.toml
#![allow(missing_docs, clippy::print_stdout)]

use platewash_benches::interleaved::{self, ROUNDS, Turn};
use platewash_benches::plain_fk::PlainArm;
use platewash_benches::solvers::{self, IkGeo};
use platewash_kinematics::ik::analytic::AnalyticArm;
use platewash_kinematics::ik::{IkSettings, IkSolver};
use platewash_kinematics::rotation::RigidTransform;
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{JointVector, Pose, RobotModel, ToolFrame, batch};
use platewash_problems::problems::{AWAY_M, COUNT, MANY, Problems, THROUGH_M, configurations};
use platewash_problems::score::Score;
use platewash_problems::solver::Solvers;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

/// Configurations in a batch.
const BATCH: usize = 100_000;

fn main() -> Result<(), Box<dyn Error>> {
    let robot = RobotModel::irb120()?;
    println!("{}", forward_table(&robot)?);
    println!("{}", batch_table(&robot)?);
    let through = Problems::spiral(&robot, THROUGH_M)?;
    let away = Problems::spiral(&robot, AWAY_M)?;
    inverse(
        "ik_warm, through the wrist singularity",
        &robot,
        &through,
        solvers::warm,
        2,
    )?;
    inverse("ik_warm, away from it", &robot, &away, solvers::warm, 2)?;
    inverse(
        "ik_nearest",
        &robot,
        &Problems::random_many(&robot)?,
        solvers::nearest,
        1,
    )?;
    inverse("ik_cold", &robot, &Problems::random(&robot, COUNT)?, solvers::cold, 1)?;
    let ur5e = ur5e()?;
    let random = Problems::random_many(&ur5e)?;
    inverse("ik_nearest, UR5e", &ur5e, &random, solvers::nearest_three_parallel, 1)?;
    println!("{}", all_branches_table(&ur5e, &random)?);
    Ok(())
}

/// The arm of the test fixture with the lengths of a UR5e instead of those of a UR5.
fn ur5e() -> Result<RobotModel, Box<dyn Error>> {
    let text = include_str!("../../../crates/kinematics/tests/fixtures/ur5_lengths.urdf");
    let lengths = [
        ("0 0 0.089159", "0 0 0.1625"),
        ("-0.39225 0 0", "-0.3922 0 0"),
        ("0 0 0.10915", "0 0 0.1333"),
        ("0 0 0.09465", "0 0 0.0997"),
        ("0 0 0.0823", "0 0 0.0996"),
    ];
    let text = lengths
        .iter()
        .fold(text.to_owned(), |text, (from, to)| text.replace(from, to));
    Ok(RobotModel::from_urdf(&text, &MeshSource::none())?)
}

/// All branches of each target, joint limits not looked at.
fn all_branches_table(robot: &RobotModel, problems: &Problems) -> Result<String, Box<dyn Error>> {
    let arm = AnalyticArm::recognise(robot)?;
    let tool0 = robot.tool_frame(ToolFrame::Tool0)?;
    let body = |pose: &Pose| AnalyticArm::body_target(&tool0, &RigidTransform::from(pose));
    let targets: Vec<_> = problems.targets.iter().filter_map(body).collect();
    let ik_geo = IkGeo::three_parallel(robot, &problems.targets)?;
    let previous = JointVector::zeros();
    let turns = interleaved::turns(
        &mut [
            Box::new(|| {
                timed(targets.len(), || {
                    for target in &targets {
                        let _ = black_box(arm.branches(black_box(target), &previous));
                    }
                })
            }),
            Box::new(|| {
                timed(targets.len(), || {
                    for target in 0..targets.len() {
                        black_box(ik_geo.count(target));
                    }
                })
            }),
        ],
        1,
    );
    let mut text = format!("\nall branches, UR5e, {ROUNDS} interleaved rounds\n\n");
    text += "| solver | ns | `branches` / it |\n| --- | ---: | ---: |\n";
    for (name, Turn { median_ns, ratios }) in ["platewash `branches`", "ik-geo"].iter().zip(turns) {
        text += &format!("| {name} | {median_ns:.0} | {:.3} |\n", ratios[0]);
    }
    Ok(text)
}

/// Prepares the solvers for the problems.
type Prepare = for<'a> fn(&'a RobotModel, &Problems) -> Result<Solvers<'a>, Box<dyn Error>>;

/// Prints the table of one workload; the first `own` solvers are ours.
fn inverse(
    name: &str,
    robot: &RobotModel,
    problems: &Problems,
    prepare: Prepare,
    own: usize,
) -> Result<(), Box<dyn Error>> {
    let rows = interleaved::compare(&mut prepare(robot, problems)?, own, problems, robot)?;
    println!("{}", interleaved::table(name, &rows));
    Ok(())
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
    let q = configurations(robot, BATCH, &mut Pcg64::seed_from_u64(5));
    let problems = Problems::near(robot, BATCH).map_err(|error| error.to_string())?;
    let starts = problems.starts()?;
    let targets = &problems.targets;
    let solver = IkSolver::new(robot, tool0, IkSettings::default())?;
    let (mut positions, mut rotations) = (vec![[0.0; 3]; BATCH], vec![[0.0; 9]; BATCH]);
    let forward = interleaved::turns(
        &mut [
            Box::new(|| {
                timed(BATCH, || {
                    let done = batch::fk_into(
                        robot,
                        &tool0,
                        &q,
                        &mut positions,
                        &mut rotations,
                        batch::Backend::Detected,
                    );
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
    let mut answers = batch::solve(&solver, targets, starts, batch::Backend::Detected)?;
    let found = answers.iter().map(|answer| answer.as_ref().ok().map(|answer| answer.q));
    let solved = Score::of_answers(found, &problems, robot)?.solved;
    let inverse = interleaved::turns(
        &mut [
            Box::new(|| {
                timed(BATCH, || {
                    let done = batch::solve_into(&solver, targets, starts, &mut answers, batch::Backend::Detected);
                    let _ = black_box(done);
                })
            }),
            Box::new(|| {
                timed(BATCH, || {
                    for (target, start) in targets.iter().zip(starts) {
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
